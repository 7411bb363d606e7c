"""Quantities of a motion by name, each evaluated where it is first asked for.

The compiled program evaluates the main ones: energies, reactions, displacements. The others follow
from the functions of the generated module: velocities and accelerations of places, forces and
deformations of elements, the forces of the ground on the whole structure, and works and losses.
"""

from collections.abc import Sequence
from functools import cache, cached_property, partial
from typing import Any

import numpy as np

from rockeom.integrator.program import Program, program
from rockeom.integrator.schema import GeneratedModule, ground_axes, in_space
from rockeom.numbers.checks import InputError, described, near
from rockeom.simulation.events import EventColumns
from rockeom.simulation.extremes import Extremes, extremes
from rockeom.simulation.ground import Ground
from rockeom.simulation.recorder import Samples
from rockeom.simulation.reserve import RATIO, rotation_ratio
from rockeom.simulation.steps import Evaluate, Rows, Steps
from rockeom.simulation.works import Works, names_of_losses, names_of_works
from rockeom.structures import evaluation
from rockeom.structures.base import Structure
from rockeom.structures.evaluation import OF_ELEMENT, elements, filled, motion_of_places
from rockeom.structures.positions import (
    RESERVE,
    has_barrier,
    names_of_leans,
    of_leans,
    places,
    positions_of,
    rotations_of,
    size_of_place,
    stands_on_feet,
)
from rockeom.structures.units import dimensioned, ground_accelerations, main_units

PLACES, ELEMENTS, BASE, WORKS, OF_ANGLE = "places", "elements", "base", "works", "of angle"
LEAN, OF_TILT = "lean", "of tilt"

_OF_PLACE = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s2"}
_OF_BASE = {"base_shear": "N", "overturning_moment": "N m"}


def _of_place(module: GeneratedModule) -> list[tuple[str, str]]:
    """(name, unit) of the quantities of a place: all axes of one after those of another."""
    return [
        ("rise" if (axis, what) == ("vertical", "displacement") else f"{prefix}{what}", unit)
        for what, unit in _OF_PLACE.items()
        for axis in ground_axes(module)
        for prefix in ("" if axis == "horizontal" else f"{axis}_",)
    ]


@cache
def families(module: GeneratedModule) -> dict[str, dict[str, str]]:
    """Units of the quantities besides the main ones, by name, of each family.

    A name that is one of the main ones stays with them.
    """
    taken = {*main_units(module)}
    of: dict[str, list[tuple[str, str]]] = {
        PLACES: [
            (f"{_word(place)}_{what}", unit)
            for place in module.POSITIONS
            for what, unit in _of_place(module)
        ],
        ELEMENTS: [
            (f"{name}_{what}", unit)
            for name in module.ELEMENT_NAMES
            for what, unit in OF_ELEMENT.items()
        ],
        BASE: [] if in_space(module) else [*_OF_BASE.items()],
        WORKS: [(name, "J") for name in (*names_of_works(module), *names_of_losses(module))],
        OF_ANGLE: [(RATIO, "-")],
        LEAN: [(name, "rad") for names in names_of_leans(module).values() for name in names],
        OF_TILT: [(RESERVE, "-")] * stands_on_feet(module),
    }
    families_of = {}
    for family, names in of.items():
        families_of[family] = dimensioned(module, {n: u for n, u in names if n not in taken})
        taken |= {*families_of[family]}
    return families_of


def units_of(module: GeneratedModule) -> dict[str, str]:
    """Unit of each quantity of a response, by name; "-" where it has none."""
    units_by_name = main_units(module)
    for units in families(module).values():
        units_by_name |= units
    return units_by_name


def _word(place: str) -> str:
    """The beginning of the names of the quantities of a place."""
    return place.replace(" ", "_")


class Quantities:
    """All quantities of a motion by name, at any times, and their extremes within the steps.

    method : of the program that integrated the motion, which evaluates its main quantities, too.
    record : of the motion; None before it begins. events : of the motion, which works need.
    """

    def __init__(
        self, structure: Structure, ground: Ground, method: str,
        record: Steps | Samples | None = None, events: EventColumns | None = None,
    ) -> None:  # fmt: skip
        self.structure, self.ground, self.method = structure, ground, method
        self.record, self.events = record, events
        self.families = dict(families(structure.module))
        if not structure.has_overturning_angles:
            del self.families[OF_ANGLE]
        if not has_barrier(structure):
            del self.families[OF_TILT]
        self.units = main_units(structure.module)
        for units in self.families.values():
            self.units |= units
        self.main_names = tuple(main_units(structure.module))
        # those of samples were found with them
        self.extremes = dict(record.extremes) if isinstance(record, Samples) else {}

    @cached_property
    def program(self) -> Program:
        """The machine code that integrated the motion; compiled again where it is not cached."""
        return program(self.structure.module, self.method)

    def steps(self, needs_them: str) -> Steps:
        """The dense record; raises ValueError where only samples were kept."""
        if isinstance(self.record, Steps):
            return self.record
        raise InputError("keep").says(
            f"{needs_them} needs every step of the motion, and of this one only samples were kept: "
            'simulate it with keep="all"'
        )

    def family(self, name: Any) -> str:
        """The family of a quantity, "" for main ones; raises KeyError for an unknown name."""
        if name in self.main_names:
            return ""
        for family, units in self.families.items():
            if name in units:
                return family
        if not isinstance(name, str):
            raise KeyError(
                f"{described(name)} is no quantity: name one, such as {self.main_names[0]!r}"
            )
        hint = near(name, self.units)
        raise KeyError(f"no quantity {name!r}{hint}; there are {', '.join(self.units)}")

    def of_family(self, family: str, rows: Rows) -> dict[str, Any]:
        """All quantities of a family, (n,) each by name; times do not fall."""
        t, y, mode = rows
        if not family:
            return dict(zip(self.structure.states, y.T, strict=True)) | self.of_program(rows)
        if family == WORKS:
            return self.works.at(rows)
        if family == OF_ANGLE:
            rotation = y[:, self.structure.module.ROTATION]
            return {RATIO: rotation_ratio(self.structure, rotation, self.ground.slope)}
        if family in (LEAN, OF_TILT):
            return self._of_lean(y, mode)
        if family == ELEMENTS:
            return elements(self.structure.module, self.structure.vector, mode, y)
        if family == PLACES:
            return _places(
                self.structure, mode, y, self.ground.accelerations(t), self.ground.weight
            )
        return _base(self.structure, mode, y, *self.ground.accelerations(t))

    def _of_lean(self, y: np.ndarray, mode: np.ndarray) -> dict[str, Any]:
        """The tilt of each body in space and its direction; the reserve where there is one."""
        m, p = self.structure.module, self.structure.vector
        poses = filled(m, p, "positions", size_of_place(m) * len(m.POSITIONS), mode, y)
        return of_leans(m, poses.reshape(len(m.POSITIONS), -1, len(y)))

    def of_program(self, rows: Rows) -> dict[str, Any]:
        """The main quantities but for the states, at times that do not fall."""
        return _of_program(self.program, self.structure, self.ground, rows)

    def columns(self, names: Sequence[str]) -> Evaluate:
        """The function that gives quantities (n, m) at times, states and modes (n,)."""
        states = self.structure.states
        wanted = sorted({self.family(name) for name in names if name not in states})

        def columns(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
            quantities: dict[str, Any] = dict(zip(states, y.T, strict=True))
            for family in wanted:
                quantities |= self.of_family(family, Rows(t, y, mode))
            return np.column_stack([quantities[name] for name in names])

        return columns

    def at(self, times: np.ndarray, side: str, names: Sequence[str]) -> dict[str, np.ndarray]:
        """Quantities at times (n,) in any order, by name."""
        states = self.structure.states
        wanted = {self.family(name) for name in names if name not in states}
        values, mode = self.steps("at").at(times, side)
        quantities: dict[str, Any] = {n: values[:, i] for i, n in enumerate(states)}
        order = np.argsort(times, kind="stable")
        for family in sorted(wanted):
            rows = Rows(times[order], np.ascontiguousarray(values[order]), mode[order])
            for name, row in self.of_family(family, rows).items():
                quantities[name] = np.empty(times.size)
                quantities[name][order] = row
        return quantities

    def extremes_of(self, names: Sequence[str]) -> dict[str, Extremes]:
        """Extremes within the steps; those of a family are searched together."""
        missing: dict[str, list[str]] = {}
        for name in names:
            family = self.family(name)
            if name not in self.extremes:
                missing.setdefault(family, []).append(name)
        for some in missing.values():
            steps = self.steps(f"what {', '.join(some)} was at most")
            self.extremes.update(zip(some, extremes(steps, self.columns(some)), strict=True))
        return {name: self.extremes[name] for name in names}

    @cached_property
    def works(self) -> Works:
        """Works and losses since the start."""
        assert self.events is not None
        ground, steps = self.ground.accelerations, self.steps("the work")
        forces = partial(_of_program, self.program, self.structure, self.ground)  # and no cycle
        return Works(self.structure, ground, forces, steps, self.events)


def _of_program(p: Program, structure: Structure, ground: Ground, rows: Rows) -> dict[str, Any]:
    t, y, mode = rows
    tables = (p.ENERGIES, p.REACTIONS, p.KINEMATICS)
    values = [np.empty((len(t), len(names))) for names in tables]
    p.evaluate(mode, t, y, *ground.tables, structure.vector, *values)
    quantities = {
        name: value[:, i]
        for names, value in zip(tables, values, strict=True)
        for i, name in enumerate(names)
    }
    quantities["total_energy"] = values[0].sum(axis=1)
    names = ground_accelerations(structure.module)
    return quantities | dict(zip(names, ground.shaking(t), strict=True))


# -- places -------------------------------------------------------------------------------------


def _places(
    structure: Structure, mode: np.ndarray, y: np.ndarray, ground: tuple[Any, ...],
    weight: tuple[float, ...],
) -> dict[str, np.ndarray]:  # fmt: skip
    """ground : accelerations as equations take them; weight : the part of the weight in them."""
    quantities: dict[str, np.ndarray] = {}
    moved = motion_of_places(structure.module, structure.vector, mode, y, *ground)
    added = [of_both - of_weight for of_both, of_weight in zip(ground, weight, strict=True)]
    n = len(added)
    at_rest = _at_rest(structure)
    names = _of_place(structure.module)
    for i, place in enumerate(structure.module.POSITIONS):
        at, velocity, acceleration = moved[:, i, :n]
        apart = [x - at_rest[i, j] for j, x in enumerate(at)]
        shaken = [x + a for x, a in zip(acceleration, added, strict=True)]
        named = zip(names, (*apart, *velocity, *shaken), strict=True)
        quantities |= {f"{_word(place)}_{what}": value for (what, _), value in named}
    return quantities


def _at_rest(structure: Structure) -> np.ndarray:
    """(m, k) of places where all states are zero."""
    m = structure.module
    (at,) = places(m, np.zeros(1, int), np.zeros((1, m.N_STATES)), structure.vector)
    return at  # upright alike in any mode


class Places:
    """Places of bodies, feet and the load point at each sample, by name.

    They are in the axes of `Structure.positions`, which move with the ground.

    Parameters
    ----------
    structure : Structure
        Structure.
    ground : Ground
        Motion of the ground.
    rows : Rows
        Samples.
    """

    def __init__(self, structure: Structure, ground: Ground, rows: Rows) -> None:
        self._structure, self._ground, self._rows = structure, ground, rows

    @cached_property
    def _found(self) -> np.ndarray:
        structure, (_, y, mode) = self._structure, self._rows
        return places(structure.module, mode, y, structure.vector)

    def positions(self) -> dict[str, np.ndarray]:
        """Positions.

        Returns
        -------
        dict of str to ndarray
            Positions (n, 2), in space (n, 3), by name [m].
        """
        return positions_of(self._structure.module, self._found)

    def rotations(self) -> dict[str, np.ndarray]:
        """Angles through which the bodies have turned, clockwise.

        Returns
        -------
        dict of str to ndarray
            Angles (n,) by name [rad]; in space matrices (n, 3, 3), from axes of the body to
            those of the ground.
        """
        return rotations_of(self._structure.module, self._found)

    def velocities(self) -> dict[str, np.ndarray]:
        """Velocities.

        Returns
        -------
        dict of str to ndarray
            Velocities (n, 2), in space (n, 3), by name [m/s].
        """
        _, y, mode = self._rows
        return evaluation.velocities(self._structure.module, self._structure.vector, mode, y)

    def accelerations(self) -> dict[str, np.ndarray]:
        """Absolute accelerations, with those of the ground.

        Returns
        -------
        dict of str to ndarray
            Accelerations (n, 2), in space (n, 3), by name [m/s2].
        """
        t, y, mode = self._rows
        accelerations = evaluation.accelerations(
            self._structure.module, self._structure.vector, mode, y, *self._ground.accelerations(t)
        )
        weight = np.array(self._ground.weight)
        return {name: of_place - weight for name, of_place in accelerations.items()}


# -- the ground ---------------------------------------------------------------------------------


def _base(
    structure: Structure, mode: np.ndarray, y: np.ndarray, ax: np.ndarray, ay: np.ndarray
) -> dict[str, np.ndarray]:
    """The forces by the momentum and the angular momentum of all bodies (d'Alembert)."""
    m = structure.module
    bodies = sum(kind in ("body", "massless") for kind in m.POSITION_KINDS)
    moved = motion_of_places(structure.module, structure.vector, mode, y, ax, ay)
    masses = filled(structure.module, structure.vector, "masses", 2 * bodies + 1, mode, y)
    gravity = masses[-1]
    shear, moment = np.zeros(len(y)), np.zeros(len(y))
    middle = _middle(m, moved[0])
    for i in range(bodies):
        mass, inertia = masses[2 * i], masses[2 * i + 1]
        x, height, _ = moved[0, i]
        accx, accy, turning = moved[2, i]
        across, up = mass * (accx + ax), mass * (accy + ay + gravity)
        shear += across
        moment += (x - middle) * up - height * across - inertia * turning
    return {"base_shear": shear, "overturning_moment": moment}


def _middle(module: GeneratedModule, places: np.ndarray) -> Any:
    """Place of the middle of the base along the ground, where the base slides."""
    feet = [
        i
        for i, (name, kind) in enumerate(zip(module.POSITIONS, module.POSITION_KINDS, strict=True))
        if kind == "foot" and f"{name}_slip" in module.KINEMATICS
    ]
    return places[feet, 0].mean(axis=0) if feet else 0.0
