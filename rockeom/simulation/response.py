"""The response of a structure, and how it ended."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from types import ModuleType
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from rockeom import codes
from rockeom.codes import (
    ENERGY_ROUNDING,
    IMPACT,
    KIND_OF,
    LANDING,
    OUTCOMES,
    REST,
    SLIP_LEFT,
    SLIP_RIGHT,
)
from rockeom.integrator.program import Program, program
from rockeom.simulation.case import ground_table
from rockeom.simulation.extremes import Extremes, extremes, last_crest
from rockeom.simulation.friction import (
    least_coefficient,
    meets_ground,
    of_impulses,
    of_point_impulses,
    surfaces,
)
from rockeom.simulation.plausible import friction, shaking
from rockeom.simulation.recorder import ALL, SAMPLES, Passages, Samples, Steps
from rockeom.structures import evaluation
from rockeom.structures.contact_modes import HAPPENED, subjects
from rockeom.structures.impact_laws import Impulsive
from rockeom.structures.pickled import made_of
from rockeom.structures.positions import places, positions_of, rotations_of
from rockeom.structures.units import is_dimensionless, main_units

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from rockeom.motion import GroundMotion
    from rockeom.simulation.options import SolverOptions
    from rockeom.simulation.quantities import EnergyBalance, Works
    from rockeom.structures.classes import Structure
    from rockeom.structures.impact_laws import ImpactLaw


class Outcome(StrEnum):
    """How a motion ended: the word that sweeps hold, and a `sentence` that explains it."""

    sentence: str

    def __new__(cls, word: str, sentence: str = "") -> Self:
        outcome = str.__new__(cls, word)
        outcome._value_ = word
        outcome.sentence = sentence
        return outcome

    COMPLETED = OUTCOMES[codes.COMPLETED], "The motion was followed to the end of the duration."
    CAME_TO_REST = OUTCOMES[codes.CAME_TO_REST], "The structure stands at rest in full contact."
    OVERTURNED = OUTCOMES[codes.OVERTURNED], "The structure fell over."
    TOO_MANY_IMPACTS = (
        OUTCOMES[codes.TOO_MANY_IMPACTS],
        "More impacts happened than max_impacts allows.",
    )
    STALLED = (
        OUTCOMES[codes.STALLED],
        "The step became too small or the steps too many: loosen rtol, or look for a stiff part.",
    )
    CHATTER = (
        OUTCOMES[codes.CHATTER],
        "Contact states followed one another without time going on.",
    )
    NOT_FINITE = (
        OUTCOMES[codes.NOT_FINITE],
        "The state became infinite or not a number: check the parameters.",
    )
    NO_SOLUTION = (
        OUTCOMES[codes.NO_SOLUTION],
        "No contact state fits the forces: rigid bodies with much friction jam (Painleve); where "
        "contacts never slip, no combination of open and closed ones fits: declare friction for "
        "them, or restitution 0.",
    )
    SEVERAL_SOLUTIONS = (
        OUTCOMES[codes.SEVERAL_SOLUTIONS],
        "Several contact states fit the forces, with different motions, as rigid bodies with much "
        "friction have (Painleve), or those whose contacts never slip: declare less friction, or "
        "friction where there is none declared.",
    )


@dataclass(frozen=True)
class Impact:
    """One passage from a contact state to another.

    kind : "impact"; "uplift"; "switch" (a foot leaves or meets a spring); "rest" (the limit of
        infinitely many impacts). Of contacts that may open and slide: "landing", "lifting",
        "slip begins", "slip ends".
    before, after : the states on both sides, by name.
    contact : the name of the point that landed, lifted or slipped, or of the element that switched;
        of several at once joined by "+", such as "left+right". Empty where the phases tell all.
    """

    time: float
    kind: str
    phase_before: str
    phase_after: str
    before: dict[str, float]
    after: dict[str, float]
    contact: str = ""


def _quantities() -> ModuleType:
    """Only who asks for more than programs tell waits for it to be imported."""
    from rockeom.simulation import quantities

    return quantities


KINDS = (*KIND_OF, "rest", *HAPPENED.values())

MEASURABLE = 1e-3
"""Rate of rotation above which an impact is counted by itself [rad/s, or the rotation's unit/s]."""


@dataclass(frozen=True)
class Response:
    """What a structure did under a ground motion.

    t (n,) [s], y (n, d) states in the order of `states`, phase (n,) names of contact states.
    Where a velocity jumps t holds the instant twice, before and after. `run["theta"]` gives a
    column of y, or any of `names`: energies [J], reactions [N], displacement and uplifts [m],
    accelerations of the ground [m/s2], and of places, elements and works what `units` tells.

    `save` keeps it in a file, `rk.load` brings it back; it can be pickled and copied.
    """

    structure: Structure
    motion: GroundMotion
    vertical: GroundMotion | None
    impact: ImpactLaw | None
    options: SolverOptions
    outcome: Outcome
    duration: float
    statistics: dict[str, Any]
    record: Steps | Samples
    end: np.ndarray
    passages: Passages

    __getstate__ = made_of

    @cached_property
    def program(self) -> Program:
        """The machine code by which it was found, found or compiled again where it is not there."""
        return program(self.structure.module, self.statistics["method"])

    @property
    def tables(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows (m, 7) of the horizontal and the vertical motion of the ground."""
        return ground_table(self.motion), ground_table(self.vertical)

    @property
    def output_step(self) -> float:
        """Largest spacing of the samples [s]."""
        return self.options.output_step or self.duration / 4000

    @property
    def keeps(self) -> str:
        """What was kept of the motion: "all" or "samples", see `simulate`."""
        return ALL if isinstance(self.record, Steps) else SAMPLES

    @property
    def steps(self) -> Steps:
        """The dense record; raises ValueError where only samples were kept."""
        return self._steps_for("steps")

    def _steps_for(self, what: str) -> Steps:
        if isinstance(self.record, Steps):
            return self.record
        raise ValueError(
            f"{what} needs every step of the motion, and of this one only samples were kept: "
            'simulate it with keep="all"'
        )

    @cached_property
    def _samples(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        if isinstance(self.record, Samples):
            return self.record.t, self.record.y, self.record.contact
        return self.record.samples(self.output_step)

    @property
    def t(self) -> np.ndarray:
        """(n,) times of the samples [s]; the instant of a jump stands twice."""
        return self._samples[0]

    @property
    def y(self) -> np.ndarray:
        """(n, d) states, columns in the order of `states`."""
        return self._samples[1]

    @property
    def contact(self) -> np.ndarray:
        """(n,) number of the contact state."""
        return self._samples[2]

    @cached_property
    def events(self) -> tuple[Impact, ...]:
        """All passages between contact states, in time order."""
        names, (times, kinds, states) = self.structure.module.CONTACTS, self.passages
        who = subjects(self.structure.module, kinds, states, self.structure.vector)
        return tuple(
            Impact(
                float(time),
                KINDS[kind],
                names[before],
                names[after],
                dict(zip(self.states, pair[0].tolist(), strict=True)),
                dict(zip(self.states, pair[1].tolist(), strict=True)),
                of,
            )
            for time, (kind, before, after, _), pair, of in zip(
                times, kinds, states, who, strict=True
            )
        )

    @property
    def states(self) -> tuple[str, ...]:
        return self.structure.states

    @property
    def names(self) -> tuple[str, ...]:
        """All that `run[...]` knows: `main_names`, and what is found when it is asked for."""
        return tuple(self.units)

    @property
    def main_names(self) -> tuple[str, ...]:
        """States, energies, forces, displacements and the ground: what tables of a run hold."""
        return tuple(main_units(self.structure.module))

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each of `names`, such as "m/s2"; "-" throughout without dimensions."""
        return _quantities().units_of(self.structure.module)

    def positions(self) -> dict[str, np.ndarray]:
        """Places (n, 2) of bodies, feet and the load point at each sample, by name [m].

        In the axes of `Structure.positions`, which move with the ground.
        """
        return positions_of(self.structure.module, self._places)

    def velocities(self) -> dict[str, np.ndarray]:
        """Velocities (n, 2) of the same, by name [m/s], in axes that move with the ground."""
        return evaluation.velocities(self.structure, self.contact, self.y)

    def accelerations(self) -> dict[str, np.ndarray]:
        """Absolute accelerations (n, 2) of the same, with the ground's, by name [m/s2]."""
        t = self.t
        vertical = 0.0 if self.vertical is None else self.vertical.acceleration(t)
        horizontal = self.motion.acceleration(t)
        return evaluation.accelerations(self.structure, self.contact, self.y, horizontal, vertical)

    def impulses(self) -> np.ndarray:
        """(k, 2) horizontal and vertical impulse of the ground at each of `impacts` [N s].

        On all feet together: what the momentum of all bodies gains.
        """
        return _quantities().impulses(self)

    def energy_balance(self) -> EnergyBalance:
        """Works and losses by quadrature of the motion, beside the energy of its states [J].

        The error tells how well the motion was integrated.

        >>> run.energy_balance().error < 1e-9
        """
        return self.works.balance()

    @cached_property
    def works(self) -> Works:
        """Works and losses since the start, which `run["ground_work"]` and the like tell."""
        return _quantities().Works(self)

    def rotations(self) -> dict[str, np.ndarray]:
        """Angles (n,) through which the bodies have turned, by name, clockwise [rad]."""
        return rotations_of(self.structure.module, self._places)

    @cached_property
    def _places(self) -> np.ndarray:
        return places(self.structure.module, self.contact, self.y, self.structure.vector)

    @property
    def phase(self) -> np.ndarray:
        """(n,) name of the contact state at each sample."""
        return np.array(self.structure.module.CONTACTS)[self.contact]

    @property
    def impacts(self) -> tuple[Impact, ...]:
        """The impacts, in time order; `events` holds uplifts and other passages too.

        Of contacts that may open and slide each landing is one.
        """
        return tuple(e for e in self.events if e.kind in ("impact", HAPPENED[LANDING]))

    @property
    def rest_time(self) -> float | None:
        """When infinitely many impacts had come to their end for the last time [s], or None."""
        times, kinds, _ = self.passages
        rests = times[kinds[:, 0] == REST]
        return float(rests[-1]) if len(rests) else None

    def __getitem__(self, name: str) -> np.ndarray:
        if name in self.states:
            return self.y[:, self.states.index(name)]
        family = self._family(name)
        if family not in self._outputs:
            self._outputs[family] = self._valued(family, self.t, self.y, self.contact)
        return self._outputs[family][name]

    @cached_property
    def _outputs(self) -> dict[str, Mapping[str, np.ndarray]]:
        """Those that have been asked for, by family."""
        return {}

    def _family(self, name: str) -> str:
        """To which a quantity belongs; "" for what the program tells.

        Raises KeyError for an unknown name.
        """
        if name in self.main_names:
            return ""
        for family, units in _quantities().families(self.structure.module).items():
            if name in units:
                return family
        raise KeyError(f"no quantity {name!r}; there are {', '.join(self.names)}")

    def _valued(
        self, family: str, t: np.ndarray, y: np.ndarray, contact: np.ndarray
    ) -> dict[str, Any]:
        """All of a family in states y (n, N), at times t (n,) that do not fall."""
        if not family:
            return dict(zip(self.states, y.T, strict=True)) | self._evaluated(t, y, contact)
        return _quantities().evaluated(self, family, (t, y, contact))

    def _evaluated(self, t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> dict[str, Any]:
        """What follows from the states y (n, N), at times t (n,) that do not fall."""
        p = self.program
        n = len(t)
        tables = (p.ENERGIES, p.REACTIONS, p.KINEMATICS)
        values = [np.empty((n, len(names))) for names in tables]
        p.evaluate(contact, t, y, *self.tables, self.structure.vector, *values)
        found = {
            name: value[:, i]
            for names, value in zip(tables, values, strict=True)
            for i, name in enumerate(names)
        }
        found["total_energy"] = values[0].sum(axis=1)
        found["ground_acceleration"] = self.motion.acceleration(t)
        found["vertical_ground_acceleration"] = (
            np.zeros(n) if self.vertical is None else self.vertical.acceleration(t)
        )
        return found

    def at(
        self, times, side: str = "right", names: Sequence[str] | None = None
    ) -> dict[str, np.ndarray]:
        """States at the given times [s], each with the shape of `times`, from the dense output.

        side : "left" or "right", which one where a velocity jumps. names : of the states, or of
        any other quantities of the response.
        Raises ValueError for times outside the response and where only samples were kept, KeyError
        for an unknown name.
        """
        steps = self._steps_for("at")
        if side not in ("left", "right"):
            raise ValueError(f"side is {side!r}: choose 'left' or 'right'")
        times = np.asarray(times, dtype=float)
        flat = times.ravel()
        if flat.size and (flat.min() < self.t[0] or flat.max() > self.t[-1]):
            raise ValueError(
                f"times reach from {flat.min()} to {flat.max()} s, the response from "
                f"{self.t[0]} to {self.t[-1]} s"
            )
        names = self.states if names is None else names
        wanted = {self._family(name) for name in names if name not in self.states}
        values, contact = steps.at(flat, side)
        found: dict[str, Any] = {n: values[:, i] for i, n in enumerate(self.states)}
        order = np.argsort(flat, kind="stable")
        for family in sorted(wanted):
            y = np.ascontiguousarray(values[order])
            for name, row in self._valued(family, flat[order], y, contact[order]).items():
                found[name] = np.empty(flat.size)
                found[name][order] = row
        return {name: found[name].reshape(times.shape) for name in names}

    @cached_property
    def overturned(self) -> str:
        """Name of the coordinate that has fallen, such as the rotation; empty if none has.

        Of a motion that was followed to the end of its duration, and falls in what comes after it,
        the one that is nearest to where it has fallen.
        """
        if self.outcome is not Outcome.OVERTURNED:
            return ""
        final = self.final
        parts = {name: abs(final[name]) / size for name, size in self.structure.falls.items()}
        return max(parts, key=lambda name: parts[name])

    @property
    def final(self) -> dict[str, float]:
        """The last state, by name."""
        return dict(zip(self.states, self.end.tolist(), strict=True))

    @property
    def final_phase(self) -> str:
        """Name of the contact state at the end.

        With it and `final` a motion goes on; `impact` and `options` are what it was simulated with.

            rk.simulate(run.structure, aftershock, initial=run.final, phase=run.final_phase)
        """
        _, kinds, _ = self.passages
        contact = kinds[-1, 2] if len(kinds) else self.contact[0]
        return self.structure.module.CONTACTS[contact]

    def extremes(self, name: str) -> Extremes:
        """Least and greatest value of any of `names`, found within the steps, and their times.

        They do not depend on `output_step`. Raises KeyError for an unknown name.
        """
        return self.extremes_of([name])[name]

    def extremes_of(self, names: Sequence[str]) -> dict[str, Extremes]:
        """`extremes` of several quantities, of which those that belong together are found at once.

        Raises KeyError for an unknown name.
        """
        missing: dict[str, list[str]] = {}
        for name in names:
            family = self._family(name)
            if name not in self._extremes:
                missing.setdefault(family, []).append(name)
        for family, some in missing.items():
            together = some if family else self.main_names  # all of them in no more time
            steps = self._steps_for(f"what {', '.join(some)} was at most")
            found = extremes(steps, self._columns(together))
            self._extremes.update(zip(together, found, strict=True))
        return {name: self._extremes[name] for name in names}

    @cached_property
    def _extremes(self) -> dict[str, Extremes]:
        """Those that have been asked for; of samples those that were found with them."""
        return dict(self.record.extremes) if isinstance(self.record, Samples) else {}

    def told_of_steps(self) -> tuple[tuple[str, ...], Callable[..., np.ndarray]]:
        """Names of the quantities whose extremes are kept with samples, and their values."""
        return self.main_names, self._columns(self.main_names)

    def _columns(self, names: Sequence[str]) -> Callable[..., np.ndarray]:
        """The function that gives quantities (n, m) at times, states and contact states (n,)."""
        wanted = sorted({self._family(name) for name in names})

        def columns(t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
            found: dict[str, np.ndarray] = {}
            for family in wanted:
                found |= self._valued(family, t, y, contact)
            return np.column_stack([found[name] for name in names])

        return columns

    def impacts_above(self, rate: float = MEASURABLE) -> tuple[Impact, ...]:
        """The impacts before which the structure turned faster than `rate`, in time order.

        rate : [rad/s], or the unit of the rotation over that of time; 0.001 rad/s is 1 mm/s at a
        metre from the foot. Before it comes to rest a structure has endlessly many smaller ones,
        whose number depends on the last digit of everything.
        """
        name = self.states[self.structure.module.ROTATION_RATE]
        return tuple(impact for impact in self.impacts if abs(impact.before[name]) > rate)

    # -- what the ground had to give --------------------------------------------------------

    @cached_property
    def _support(self) -> tuple[Extremes, ...] | None:
        """Extremes of the horizontal, left, right and whole vertical force while they matter.

        None without feet. See `_support_ends`.
        """
        if "left_reaction" not in self.structure.module.REACTIONS:
            return None
        steps = self._steps_for("what the feet had to bear (friction_demand, lost_contact)")

        def forces(t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
            found = self._feet(t, y, contact)
            return np.column_stack([found, found[:, 1] + found[:, 2]])

        return tuple(extremes(steps, forces, self._support_ends))

    @property
    def _feet(self) -> Callable[..., np.ndarray]:
        return self._columns(("horizontal_reaction", "left_reaction", "right_reaction"))

    @cached_property
    def _support_ends(self) -> float:
        """When the forces on the feet cease to matter [s].

        The last fall of a structure that overturned is left out, from its highest point on:
        nothing could stop it then.
        """
        if self.outcome is not Outcome.OVERTURNED:
            return math.inf
        return last_crest(self.steps, self._columns(("gravitational_energy",)))

    @cached_property
    def base_moment(self) -> Extremes | None:
        """Extremes of the moment of the ground's forces about the middle of the base [N m].

        The force on the right less that on the left, times the distance at which they act: half
        the distance of the feet, or that of a rotation centre that moves. None unless the structure
        stands on rigid ground and has a `half_width`.
        """
        arm = self.structure.parameters().get("half_width")
        moves = "rotation_centre" in self.names
        if arm is None or not (moves or self.structure.rocks_on_rigid_ground):
            return None
        names = ("left_reaction", "right_reaction", *("rotation_centre",) * moves)
        forces = self._columns(names)

        def moment(t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
            left, right, *centre = forces(t, y, contact).T
            return ((centre[0] if moves else arm) * (right - left))[:, None]

        return extremes(self._steps_for("base_moment"), moment)[0]

    @cached_property
    def friction_demand(self) -> float:
        """Largest |horizontal|/vertical force that not sliding needed, found within the steps.

        The vertical force is that on both feet together. inf where there was none, but a horizontal
        one: then no friction suffices. nan without feet. Impulses are in `impact_friction_demand`;
        the last fall of a structure that overturned is in neither.
        """
        if self._support is None:
            return math.nan
        horizontal, _, _, vertical = self._support

        def forces(t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
            across, left, right = self._feet(t, y, contact).T
            return np.column_stack([across, left + right])

        return least_coefficient(
            self.steps, forces, horizontal, vertical, self._support_ends,
            self.structure.stands_on_points,
        )  # fmt: skip

    @cached_property
    def impact_friction_demand(self) -> float:
        """Largest |horizontal|/vertical impulse of the ground at an impact.

        The impulse on both feet together, which is what the momentum of all masses gains. inf where
        it had to pull; 0 without impacts; nan where no foot meets rigid ground in an impact.
        """
        if not meets_ground(self.structure.module):
            return math.nan
        return of_impulses(self)

    @cached_property
    def friction_demands(self) -> dict[str, tuple[float, float]]:
        """What `friction_demand` and `impact_friction_demand` are, of each of several surfaces.

        By the names of the points that rub on it, such as "upper_left+upper_right": of forces, and
        of impulses at landings. Empty for structures whose contacts cannot open and slide.
        """
        found = surfaces(self.structure.module)
        if len(found) == 1 and self._support is not None:
            return dict.fromkeys(found, (self.friction_demand, self.impact_friction_demand))
        impulses = of_point_impulses(self, list(found.values()))
        names = self.structure.module.POINTS if found else ()
        return {
            surface: (self._demand_of([names[i] for i in points]), impulse)
            for (surface, points), impulse in zip(found.items(), impulses, strict=True)
        }

    def _demand_of(self, points: Sequence[str]) -> float:
        columns = self._columns(
            [f"{name}_{what}" for what in ("friction", "reaction") for name in points]
        )

        def forces(t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
            return columns(t, y, contact).reshape(len(t), 2, -1).sum(axis=2)

        across, pressing = extremes(self.steps, forces, self._support_ends)
        return least_coefficient(self.steps, forces, across, pressing, self._support_ends, True)

    @cached_property
    def sliding(self) -> np.ndarray:
        """(k, 2) starts and ends of the spans of time in which a point slides [s].

        Empty where contacts cannot slide.
        """
        if not self.structure.stands_on_points:
            return np.empty((0, 2))
        times, kinds, _ = self.passages
        states = self.structure.module.POINT_STATES
        slides = np.array([not {SLIP_RIGHT, SLIP_LEFT}.isdisjoint(row) for row in states])
        edges = np.concatenate([self.t[:1], times, self.t[-1:]])
        of = slides[np.concatenate([self.contact[:1], kinds[:, 2]])]
        spans = np.column_stack([edges[:-1], edges[1:]])
        return spans[of & (spans[:, 1] > spans[:, 0])]

    @cached_property
    def impact_energy_gains(self) -> np.ndarray:
        """(k,) kinetic energy gained at each impact that gained some [J]; of most motions empty.

        An impact gains energy where the kinetic energy grows by more than 1e-9 of itself. On a
        structure that bends every impact law but `Impulsive` can do so; on feet that slide the
        algebraic law, with friction and a restitution above zero. A motion that depends on such
        impacts is not to be trusted.
        """
        before, after = self._impact_energies
        return (after - before)[after > before * (1.0 + ENERGY_ROUNDING)]

    @cached_property
    def impact_energy_loss(self) -> float:
        """Kinetic energy lost at all `impacts` together [J]; gains at others are not deducted."""
        before, after = self._impact_energies
        return float(np.maximum(before - after, 0.0).sum())

    @cached_property
    def _impact_energies(self) -> np.ndarray:
        """(2, k) kinetic energy before and after each of `impacts` [J]."""
        times, kinds, states = self.passages
        hits = np.isin(kinds[:, 0], (IMPACT, LANDING))
        sides = (
            self._evaluated(times[hits], np.ascontiguousarray(states[hits, i]), kinds[hits, 1 + i])
            for i in (0, 1)
        )
        return np.stack([side["kinetic_energy"] for side in sides])

    @cached_property
    def lost_contact(self) -> bool:
        """Whether the ground would have had to pull a foot: the model's assumption failed then."""
        if self._support is None:
            return False
        _, left, right, vertical = self._support
        weight = max(abs(vertical.peak), 1e-300)
        return bool(min(left.minimum, right.minimum) < -1e-9 * weight)

    def assumptions(self) -> str:
        """How far the assumptions of no sliding and no lost contact held, in words."""
        if self.keeps == SAMPLES:
            return (
                "Only samples were kept: the forces that friction and contact had to bear, which "
                "are found within the steps, are not known."
            )
        if self._support is None:
            return "The model has no feet: it says nothing of sliding or contact."
        if self.structure.stands_on_points:
            return self._slides()
        text = self._friction()
        if self.lost_contact:
            return f"{text} A foot's vertical reaction turned negative: {self.structure.pulled}."
        return text + " No foot's vertical reaction turned negative."

    def _slides(self) -> str:
        """Of contacts that may slide: for how long they did."""
        spans = self.sliding
        slid = np.diff(spans).sum()
        if slid > 1e-12 * self.duration:
            text = f"It slid for {slid:.4g} s, the first time at {spans[0, 0]:.4g} s."
        else:
            demands = self.friction_demands
            needed = [
                f"{max(pair):.3g}" + f" at {surface}" * (len(demands) > 1)
                for surface, pair in demands.items()
            ] or [f"{max(self.friction_demand, self.impact_friction_demand):.3g}"]
            text = (
                f"It did not slide: that needed a friction coefficient of {' and '.join(needed)}."
            )
        return text

    def _friction(self) -> str:
        forces, impulses = self.friction_demand, self.impact_friction_demand
        if math.isnan(forces):
            return "The forces on the feet are not finite: they say nothing of sliding."
        if math.isinf(forces):
            text = (
                "No friction coefficient would have kept it from sliding: the ground pressed no "
                "foot while a horizontal force was needed."
            )
        else:
            text = f"Not sliding needed a friction coefficient of at least {forces:.3g}."
        if math.isinf(impulses):
            return text + " None suffices for the impulses at its impacts."
        return text + f" The impulses at its impacts needed {impulses:.3g}." * (impulses > 0)

    @property
    def hints(self) -> tuple[str, ...]:
        """Plausible mistakes in the structure, its start, its ground motion and its impacts."""
        start, p = self.y[0], self.structure.module
        found = (*self.structure.hints(), *shaking(self), *friction(self), *self._gained())
        if self.motion.is_vertical:
            name = self.motion.name
            found += (
                f"The horizontal ground motion is the vertical component of a record, {name}.",
            )
        if not (self.structure.rocks_on_rigid_ground and start[p.ROTATION]):
            return found
        around = np.array([start, start])
        around[:, p.ROTATION] *= 1.0 - 1e-6, 1.0 + 1e-6
        energy = self._evaluated(np.zeros(2), around, self.contact[[0, 0]])
        potential = energy["gravitational_energy"] + energy["elastic_energy"]
        if potential[1] >= potential[0]:
            return found
        name, unit = self.states[p.ROTATION], p.STATE_UNITS[p.ROTATION]
        text = f"The initial {name}, {start[p.ROTATION]:.4g} {unit}, lies beyond the balance"
        alpha = self.structure.slenderness if unit == "rad" else None
        text += "" if alpha is None else f", alpha = {alpha:.4g} rad"
        return (*found, f"{text}: released at rest it falls over.")

    def _gained(self) -> list[str]:
        """Of impacts that gained energy: how many, how much, and which law gains none."""
        gains = self.impact_energy_gains
        if not len(gains):
            return []
        text = (
            f"{len(gains)} of {len(self.impacts)} impacts gained kinetic energy, "
            f"{self._energy(gains.sum())} in all"
        )
        if self.structure.stands_on_points:
            return [f"{text}, which friction with a restitution above zero can cause."]
        text += f", by {self.statistics.get('impact_law', 'their law')}."
        exact = isinstance(self.structure.default_impact, Impulsive)
        return [text + " Impulsive() conserves the momenta, and gains none." * exact]

    def _energy(self, value: float) -> str:
        """With its unit, where it has one."""
        return f"{value:.4g}" + " J" * (not is_dimensionless(self.structure.module))

    @property
    def never_lifted(self) -> bool:
        """Whether both feet stood on rigid ground all the time."""
        sides = np.array(self.structure.module.SIDES)
        return self.structure.rocks_on_rigid_ground and not sides[self.contact].any()

    def _uplift(self) -> list[str]:
        """Of a motion that never lifted, at which acceleration of the ground it would."""
        threshold = self.structure.uplift_acceleration if self.never_lifted else None
        if threshold is None or math.isinf(threshold):
            return []
        unit = "g" if is_dimensionless(self.structure.module) else "m/s2"
        return [
            f"It never lifted off. A ground acceleration that grows slowly lifts it at "
            f"{threshold:.4g} {unit}; here the largest was {self.motion.peak:.4g} {unit}."
        ]

    def _impact_law(self) -> list[str]:
        """By which law the structure landed, and what all impacts took."""
        law = self.statistics.get("impact_law")
        if not law or not len(self.impacts):
            return []
        lost = self._energy(self.impact_energy_loss)
        return [f"Impact law: {law}. The impacts lost {lost} of kinetic energy in all."]

    def _which(self) -> str:
        """What fell, where several coordinates may."""
        if not self.overturned or len(self.structure.falls) == 1:
            return ""
        name = self.overturned
        unit = self.structure.module.STATE_UNITS[self.states.index(name)]
        return f" {name} is {self.final[name]:.4g} {unit}."

    def impacts_in_words(self) -> str:
        """How many impacts there were, and how many of them were faster than MEASURABLE."""
        n = len(self.impacts)
        unit = self.structure.module.STATE_UNITS[self.structure.module.ROTATION_RATE]
        faster = f", {len(self.impacts_above())} of them faster than {MEASURABLE:g} {unit}"
        return f"{n} impacts{faster if n else ''}"

    def summary(self) -> str:
        """The response in words."""
        rotation = self.states[self.structure.module.ROTATION]
        unit = self.structure.module.STATE_UNITS[self.structure.module.ROTATION]
        largest = self.extremes(rotation)
        lines = [
            f"{type(self.structure).__name__} under {self.motion.name or 'a ground motion'}, "
            f"{self.t[-1]:.6g} s of {self.duration:.6g} s.",
            f"Outcome: {self.outcome}. {self.outcome.sentence}{self._which()}",
            f"Largest |{rotation}|: {abs(largest.peak):.4g} {unit} at {largest.peak_time:.4g} s; "
            f"{self.impacts_in_words()}.",
        ]
        lines += self._impact_law()
        lines += self._uplift()
        if self.rest_time is not None:
            lines.append(f"Infinitely many impacts came to an end at {self.rest_time:.9g} s.")
        return "\n".join([*lines, self.assumptions(), *(f"Hint: {hint}" for hint in self.hints)])

    # -- what lasts -----------------------------------------------------------------------------

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all of the response to a file, from which `rk.load` makes the same one again.

        path : of a netCDF-4 file, which is written whole or not at all; one that is there is
        replaced. It takes the extra `files`, see the README.

        Files hold numbers and names, no code. Of a structure that you declared the file has the
        parameters and a hash: `rk.load` is given the declaration again. Of a law of impact of your
        own it has the name alone, of which a warning tells; it is not needed but to go on.

        Raises TypeError for a structure of a class of your own, ModuleNotFoundError without the
        extra, and OSError where the file cannot be written.

            run.save("block.nc")
            run = rk.load("block.nc")
        """
        from rockeom.exports.responses import save

        save(self, path)

    def to_xarray(self, names: Sequence[str] | None = None, times: Any = None) -> xr.Dataset:
        """Quantities over "time" and impacts over "impact", each with its unit and its long name.

        names : of the quantities, the states if not given. times (n,) : [s], by the dense record;
        if not given those of the samples, which have the instant of a jump twice.

        `phase` is the name of the contact state; impact_time [s], impact_contact, and states and
        phase before and after each impact, such as theta_dot_before. Raises KeyError for an unknown
        name, and ValueError for times outside the response.

            run.to_xarray(["theta", "displacement"]).theta.plot()
        """
        from rockeom.simulation.tables import to_xarray

        return to_xarray(self, names, times)

    def to_dataframe(self, names: Sequence[str] | None = None, times: Any = None) -> pd.DataFrame:
        """Quantities and the phase, a column each, over the time [s]; arguments as `to_xarray`.

        run.to_dataframe(times=np.arange(0, 5, 0.01)).to_csv("block.csv")
        """
        from rockeom.simulation.tables import of_time

        return of_time(self, names, times).to_dataframe()

    def plot(self, **kwargs):
        """A figure of rotation, displacement, uplift and impacts; see rockeom.plots."""
        from rockeom.plots import plot_response

        return plot_response(self, **kwargs)

    def animate(self, path=None, **kwargs):
        """The motion drawn to scale, frame by frame: a .gif or .html file, or in Jupyter.

        path : of the file, if one is wanted. Others as in `rockeom.plots.animate`.
        """
        from rockeom.plots import animate

        return animate(self, path, **kwargs)

    def _ipython_key_completions_(self) -> list[str]:
        """What IPython offers after `run["`."""
        return list(self.names)

    def _repr_html_(self) -> str:
        from rockeom.plots.notebook import html_of

        return html_of(self)

    def __repr__(self) -> str:
        return f"<Response: {self.outcome}, {self.duration:.6g} s, {self.impacts_in_words()}>"
