"""Quantities of a motion that no program calculates: what is asked for is found, and nothing else.

By name, of any structure, out of the functions of its generated module: velocities and
accelerations of its places, what its elements do, the forces of the ground on the whole of it, and
the works and losses since the motion began.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rockeom.codes import IMPACT, LANDING, REST
from rockeom.integrator.schema import has_points
from rockeom.numbers.functions import gauss_rule
from rockeom.structures.evaluation import (
    OF_ELEMENT,
    at_states,
    elements,
    filled,
    jets,
    motion_of_places,
)
from rockeom.structures.units import dimensioned, main_units

if TYPE_CHECKING:
    from rockeom.simulation.response import Response
    from rockeom.structures.classes import Structure

Rows = tuple[np.ndarray, np.ndarray, np.ndarray]
"""times (n,), states (n, N) and contact states (n,)."""

PLACES, ELEMENTS, BASE, WORKS = "places", "elements", "base", "works"

_OF_PLACE = {
    "displacement": "m", "rise": "m", "velocity": "m/s", "vertical_velocity": "m/s",
    "acceleration": "m/s2", "vertical_acceleration": "m/s2",
}  # fmt: skip
_OF_BASE = {"base_shear": "N", "overturning_moment": "N m"}
_WORKS = ("ground_work", "damping_loss", "force_work", "friction_loss")


@cache
def families(module: ModuleType) -> dict[str, dict[str, str]]:
    """Units of all that is told besides, by name, of each family.

    A name that is told already is that of the state or output.
    """
    known = {*main_units(module)}
    of: dict[str, list[tuple[str, str]]] = {
        PLACES: [
            (f"{_word(place)}_{what}", unit)
            for place in module.POSITIONS
            for what, unit in _OF_PLACE.items()
        ],
        ELEMENTS: [
            (f"{name}_{what}", unit)
            for name in module.ELEMENT_NAMES
            for what, unit in OF_ELEMENT.items()
        ],
        BASE: [*_OF_BASE.items()],
        WORKS: [(name, "J") for name in (*_works(module), "impact_loss")],
    }
    found = {}
    for family, names in of.items():
        found[family] = dimensioned(module, {n: u for n, u in names if n not in known})
        known |= {*found[family]}
    return found


def units_of(module: ModuleType) -> dict[str, str]:
    """Unit of each quantity of a response, by name; "-" where it has none."""
    found = main_units(module)
    for units in families(module).values():
        found |= units
    return found


def _works(module: ModuleType) -> tuple[str, ...]:
    return (*_WORKS, *(f"{name}_loss" for name in module.ELEMENT_NAMES))


def _word(place: str) -> str:
    """What quantities of a place are called by."""
    return place.replace(" ", "_")


def evaluated(run: Response, family: str, rows: Rows) -> dict[str, np.ndarray]:
    """All of a family, (n,) each by name."""
    t, y, contact = rows
    ground = _ground(run)(t)
    if family == WORKS:
        return run.works.at(rows)
    if family == ELEMENTS:
        return elements(run.structure, contact, y)
    of = _places if family == PLACES else _base
    return of(run.structure, contact, y, *ground)


def _ground(run: Response) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """The accelerations of the ground at times (n,), across and up."""
    motion, vertical = run.motion, run.vertical

    def at(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        across = np.asarray(motion.acceleration(t))
        return across, np.zeros(len(t)) if vertical is None else vertical.acceleration(t)

    return at


# -- places -------------------------------------------------------------------------------------


def _places(
    structure: Structure, contact: np.ndarray, y: np.ndarray, ax: np.ndarray, ay: np.ndarray
) -> dict[str, np.ndarray]:
    found: dict[str, np.ndarray] = {}
    moved = motion_of_places(structure, contact, y, ax, ay)
    at_rest = _at_rest(structure)
    for i, place in enumerate(structure.module.POSITIONS):
        (x, rise, _), (vx, vy, _), (accx, accy, _) = moved[:, i]
        of = (x - at_rest[i, 0], rise - at_rest[i, 1], vx, vy, accx + ax, accy + ay)
        name = _word(place)
        found |= {f"{name}_{what}": value for what, value in zip(_OF_PLACE, of, strict=True)}
    return found


def _at_rest(structure: Structure) -> np.ndarray:
    """(m, 3) of places where all states are zero."""
    m = structure.module
    y = np.zeros(m.N_STATES)
    out = np.empty(3 * len(m.POSITIONS))
    contact = 0 if has_points(m) else structure.contact(y)  # on which places of points depend not
    m.positions(contact, y, structure.vector, out)
    return out.reshape(-1, 3)


# -- the ground ---------------------------------------------------------------------------------


def _base(
    structure: Structure, contact: np.ndarray, y: np.ndarray, ax: np.ndarray, ay: np.ndarray
) -> dict[str, np.ndarray]:
    """By the momentum and the angular momentum of all bodies (d'Alembert)."""
    m = structure.module
    bodies = sum(kind in ("body", "massless") for kind in m.POSITION_KINDS)
    moved = motion_of_places(structure, contact, y, ax, ay)
    told = filled(structure, "masses", 2 * bodies + 1, contact, y)
    gravity = told[-1]
    shear, moment = np.zeros(len(y)), np.zeros(len(y))
    middle = _middle(m, moved[0])
    for i in range(bodies):
        mass, inertia = told[2 * i], told[2 * i + 1]
        x, height, _ = moved[0, i]
        accx, accy, turning = moved[2, i]
        across, up = mass * (accx + ax), mass * (accy + ay + gravity)
        shear += across
        moment += (x - middle) * up - height * across - inertia * turning
    return {"base_shear": shear, "overturning_moment": moment}


def _middle(module: ModuleType, places: np.ndarray) -> Any:
    """Where the middle of the base is along the ground, of what slides along it."""
    feet = [i for i, kind in enumerate(module.POSITION_KINDS) if kind == "foot"]
    if not (has_points(module) and feet):
        return 0.0
    return places[feet, 0].mean(axis=0)


# -- impacts ------------------------------------------------------------------------------------


def impulses(run: Response) -> np.ndarray:
    """(k, 2) horizontal and vertical impulse of the ground at each of `run.impacts` [N s].

    What the momentum of all bodies gains.
    """
    _, kinds, states = run.passages
    hits = np.isin(kinds[:, 0], (IMPACT, LANDING))
    before, after = (
        filled(run.structure, "momentum", 2, kinds[hits, 1 + i], states[hits, i]) for i in (0, 1)
    )
    return (after - before).T


# -- works --------------------------------------------------------------------------------------

_CHUNK = 2048  # steps at once, so that memory is bounded


class EnergyBalance(NamedTuple):
    """Where the energy of a response came from and went, in joules.

    input : work of the shaking on the masses, seen from the ground that moves. damping : lost in
    dampers and by yielding, less the work of forces that are declared by themselves (`Force`).
    impacts : lost at impacts, and in springs that are let go while they are drawn. gained : energy
    at the end less that at the start. friction : lost where points slide.
    error : what input - damping - friction - impacts - gained leaves, over the largest of them and
    of the kinetic energy.
    """

    input: float
    damping: float
    impacts: float
    gained: float
    error: float
    friction: float = 0.0


class Works:
    """Works and losses of a motion since it began, by quadrature over its steps.

    What is lost at impacts is how much less energy there is behind them. In the time in which
    infinitely many of them bring a structure on points to rest, it is what no other loss explains.
    """

    def __init__(self, run: Response) -> None:
        # not the response, which keeps these: what holds one another waits for the garbage
        self.structure, self.ground, self.steps = run.structure, _ground(run), run.steps
        self.names = _works(run.structure.module)
        starts, lengths = self.steps.span.T
        n = len(starts)
        of_steps = [
            self._within(np.arange(i, min(i + _CHUNK, n)), np.ones(min(_CHUNK, n - i)))
            for i in range(0, n, _CHUNK)
        ]
        self.table = np.zeros((n + 1, len(self.names)))
        np.cumsum(np.concatenate(of_steps), axis=0, out=self.table[1:])
        every = np.arange(n)
        self.first, self.last = (
            self._energy(self.steps.states(every, np.full(n, x)), self.steps.contact)
            for x in (0.0, 1.0)
        )
        times, kinds, states = run.passages
        ends = starts + lengths
        self.rests = np.isin(ends, times[kinds[:, 0] == REST]) & has_points(run.structure.module)
        lost = np.zeros(n + 1)
        seams = np.flatnonzero(np.isin(starts[1:], times)) + 1
        lost[seams] = self.last[seams - 1] - self.first[seams]
        self.end = self.last[-1]
        if len(times) and times[-1] >= ends[-1]:
            self.end = self._energy(states[-1:, 1], kinds[-1:, 2])[0]
            lost[n] = self.last[-1] - self.end
        inside = np.zeros(n + 1)
        resting = np.flatnonzero(self.rests)
        inside[resting + 1] = self._unexplained(
            np.diff(self.table, axis=0)[resting], self.last[resting] - self.first[resting]
        )
        self.impacts = np.cumsum(lost + inside)

    def _energy(self, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
        return filled(self.structure, "energies", 3, contact, y).sum(axis=0)

    @staticmethod
    def _unexplained(work: np.ndarray, gained: np.ndarray) -> np.ndarray:
        ground, damping, force, friction = work[:, :4].T
        return ground - damping + force - friction - gained

    def _within(self, index: np.ndarray, x: np.ndarray) -> np.ndarray:
        """(n, m) works from the start of steps to places x in [0, 1] of them."""
        start, length = self.steps.span[index].T
        nodes, weights = gauss_rule()  # a step has degree 7, and its square degree 14
        places = 0.5 * np.multiply.outer(x, 1.0 + nodes)
        t = start[:, None] + places * length[:, None]
        every = np.repeat(index, len(nodes))
        y = self.steps.states(every, places.ravel())
        powers = self._powers(t.ravel(), y, self.steps.contact[every])
        parts = 0.5 * np.multiply.outer(x * length, weights)
        return np.einsum("ij,kij->ik", parts, powers.reshape(len(self.names), *parts.shape))

    def _powers(self, t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """(m, n), in the order of the names."""
        structure, ground = self.structure, self.ground(t)
        module, n = structure.module, len(structure.module.ELEMENT_NAMES)
        told = filled(structure, "powers", 3, contact, y, *ground)
        lost = filled(structure, "elements", 4 * n, contact, y).reshape(n, 4, len(t))[:, 3]
        friction = np.zeros((1, len(t)))
        if has_points(module):
            rates = filled(structure, "rates", module.N_STATES, contact, y, *ground)
            size = len(module.KINEMATICS)
            slips = jets(structure, "kinematics", size, contact, y, rates)[1]
            forces = at_states(structure, "reactions", contact, y, *ground)
            for point in module.POINTS:
                rate = slips[module.KINEMATICS.index(f"{point}_slip")]
                friction[0] -= forces[f"{point}_friction"] * rate
        return np.concatenate([told, friction, lost])

    def at(self, rows: Rows) -> dict[str, np.ndarray]:
        """All of them at times, states and contact states, (n,) each by name."""
        t, y, contact = rows
        starts, lengths = self.steps.span.T
        index = np.clip(np.searchsorted(starts, t, side="right") - 1, 0, len(starts) - 1)
        # the state before a jump is the end of the step before
        seam = np.flatnonzero((t == starts[index]) & (index > 0))
        there = self.steps.states(index[seam], np.zeros(len(seam)))
        before = self.steps.states(index[seam] - 1, np.ones(len(seam)))
        away, near = (np.abs(y[seam] - one).max(axis=1, initial=0.0) for one in (there, before))
        of_before = contact[seam] == self.steps.contact[index[seam] - 1]
        of_after = contact[seam] == self.steps.contact[index[seam]]
        index[seam[(near < away) | ((near == away) & of_before & ~of_after)]] -= 1
        x = np.clip((t - starts[index]) / lengths[index], 0.0, 1.0)
        within = np.concatenate(
            [
                self._within(index[i : i + _CHUNK], x[i : i + _CHUNK])
                for i in range(0, len(t), _CHUNK)
            ]
            or [np.empty((0, len(self.names)))]
        )
        found = dict(zip(self.names, (self.table[index] + within).T, strict=True))
        impacts = self.impacts[index].copy()
        rests = np.flatnonzero(self.rests[index])
        gained = self._energy(y[rests], contact[rests]) - self.first[index[rests]]
        impacts[rests] += self._unexplained(within[rests], gained)
        return found | {"impact_loss": impacts}

    def balance(self) -> EnergyBalance:
        """Of the whole motion."""
        ground, damping, force, friction = self.table[-1, :4].tolist()
        impacts, gained = float(self.impacts[-1]), float(self.end - self.first[0])
        lost = damping - force
        left = ground - lost - friction - impacts - gained
        kinetic = filled(
            self.structure, "energies", 3, self.steps.contact, self.steps.powers[:, 0]
        )[0]
        largest = max(*map(abs, (ground, lost, friction, impacts, gained)), float(kinetic.max()))
        error = abs(left) / largest if largest else 0.0
        return EnergyBalance(ground, lost, impacts, gained, error, friction)
