"""Structures as a user names them: physical parameters bound to a generated module."""

from __future__ import annotations

import dataclasses
import functools
import importlib
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import (
    TYPE_CHECKING,
    Any,
    ClassVar,
    NamedTuple,
    Protocol,
    Self,
    TypeVar,
    dataclass_transform,
)

import numpy as np

from rockeom.codes import IMPACT, UPLIFT
from rockeom.drawing.positions import Shapes, places, positions_of, rotations_of, shapes
from rockeom.integrator.schema import has_points
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import UnknownAttributeError, near, number, numbers, told
from rockeom.numbers.dual import directions, value_of
from rockeom.numbers.functions import for_arrays, isfinite, mathematics
from rockeom.structures import evaluation
from rockeom.structures.contact_modes import (
    by_forces,
    contact_of,
    drawn_out,
    named,
    standing,
)
from rockeom.structures.evaluation import at_states, filled
from rockeom.structures.impact_laws import (
    EnergyRatioAtSpeed,
    ImpactLaw,
    TabledLaw,
    check_law,
    default_law,
)
from rockeom.structures.pickled import made_of

if TYPE_CHECKING:
    from rockeom.structures.fixed_base import FixedBase


class Structure:
    """A rocking structure with its parameters.

    Methods take a state as a mapping of state names; what is not named is zero. The contact
    state follows from the state, or is named by `phase`.
    """

    model: ClassVar[str] = ""
    may_vanish: ClassVar[frozenset[str]] = frozenset()
    may_be_negative: ClassVar[frozenset[str]] = frozenset()
    not_numbers: ClassVar[frozenset[str]] = frozenset()
    of_each: ClassVar[Mapping[str, str]] = {}
    """Parameters that are lists, and what the generated module calls one of them, numbered."""
    pulled: ClassVar[str] = "it would have jumped"
    """What it means that the ground would have to pull a foot."""

    __getstate__ = made_of

    # -- what a subclass gives --------------------------------------------------------------

    def parameters(self) -> dict[str, float]:
        """The parameters of the model, by name, in SI units."""
        return {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}  # type: ignore[arg-type]

    @classmethod
    def defaults(cls) -> dict[str, Any]:
        """The names that the class takes, each with its default; `dataclasses.MISSING` for none."""
        return {f.name: f.default for f in dataclasses.fields(cls)}  # type: ignore[arg-type]

    @functools.cached_property
    def module(self) -> ModuleType:
        """The generated module."""
        return importlib.import_module(f"rockeom.generated.{self.model}")

    def _repr_html_(self) -> str:
        from rockeom.drawing.notebook import page_of_structure  # matplotlib

        return page_of_structure(self)

    if not TYPE_CHECKING:  # for type checkers an unknown attribute stays an error

        def __getattr__(self, name: str) -> Any:
            return _missing(self, name)

    # -- what follows -----------------------------------------------------------------------

    @functools.cached_property
    def vector(self) -> np.ndarray:
        """What compiled functions take as p: the parameters and constants prepared of them."""
        values = self.parameters()
        parameters = np.array([number(n, values[n]) for n in self.module.PARAMETERS])
        return self.module_for(parameters).prepare(parameters)

    def module_for(self, *arrays: np.ndarray) -> Any:
        """The generated module, for compounds where arrays hold such."""
        return for_arrays(self.module, *arrays)

    @property
    def states(self) -> tuple[str, ...]:
        return self.module.STATES

    @property
    def jumps_between_events(self) -> bool:
        """Whether a force may jump at a place where no contact state ends."""
        return False

    @functools.cached_property
    def rocks_on_rigid_ground(self) -> bool:
        """Whether the edges of the base are pivots, and full contact is a phase of its own."""
        m = self.module
        return "both" in m.MODES and UPLIFT in m.KINDS[m.MODES.index("both")]

    @functools.cached_property
    def stands_on_points(self) -> bool:
        """Whether its contacts may open, slide and bounce; its contact states are found then."""
        return has_points(self.module)

    @functools.cached_property
    def has_impacts(self) -> bool:
        """Whether an impact ends any contact state."""
        m = self.module
        return any(IMPACT in kinds[:n] for kinds, n in zip(m.KINDS, m.GUARDS, strict=True))

    @functools.cached_property
    def overturning_rotation(self) -> float:
        """Rotation at which the structure has fallen over, in the rotation's unit."""
        return number("overturning_rotation", self.module_for(self.vector).overturning(self.vector))

    @functools.cached_property
    def falls(self) -> dict[str, float]:
        """Size of each coordinate that may fall at which the structure has, the rotation first."""
        m = self.module_for(self.vector)
        bounds = {self.states[m.ROTATION]: self.overturning_rotation}
        for i in range(m.N_FALLS):
            size = number("falls", m.overturns_at(i, self.vector))
            bounds[self.states[m.FALLS[i]]] = size
        return bounds

    @functools.cached_property
    def velocity_ratio(self) -> float:
        """Ratio of the rates of rotation at an impact of the structure taken as rigid, 5-14."""
        return number("velocity_ratio", self.module_for(self.vector).velocity_ratio(self.vector))

    @functools.cached_property
    def fastest_damping(self) -> float:
        """A rate that no decay of small motion exceeds where springs push back [1/s].

        It is sooner found than `small_motion`: small where little is damped.
        """
        from rockeom.structures.linearised import fastest_damping

        return fastest_damping(self)

    @functools.cached_property
    def small_motion(self) -> tuple[float, float]:
        """(motion, decay) the fastest rates of small motion at rest in any contact state [1/s].

        Of the eigenvalues of the linearised equations: decay, the largest of those that die out
        within a radian; motion, the largest of the others, which vibrate or grow.
        """
        from rockeom.structures.linearised import fastest_rates

        return fastest_rates(self)

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """(N,) state vector of named values.

        Raises ValueError for unknown names or NaN, and TypeError for what is no mapping of numbers.
        """
        check_states("state", values, self)
        unknown = [n for n in values if n not in self.states]
        if unknown:
            raise ValueError(
                f"unknown state {', '.join(map(repr, unknown))}; {self.model} has "
                f"{', '.join(self.states)}"
            )
        y = [number(f"state {name}", values.get(name, 0.0)) for name in self.states]
        for name, value in zip(self.states, y, strict=True):
            if not isfinite(value):
                raise ValueError(f"state {name} is {value}: give a finite number")
        found = np.array(y)
        if has_points(self.module):
            stands = standing(self.module, found, self.vector, values)
            return drawn_out(self.module, self.model, stands, self.vector, values)
        return found

    def contact(self, y: np.ndarray, phase: str | None = None, towards: float = 0.0) -> int:
        """Number of the contact state of a state vector, or of the phase named.

        towards : sign of the rotation to come, where the state itself is upright and at rest.

        Raises ValueError for a state that fits no contact state, or not the phase named.
        """
        m, y = self.module, value_of(y)  # which contact state it is has no derivative
        if has_points(m):
            p = value_of(self.vector)
            return contact_of(m, self.model, y, p) if phase is None else named(m, phase)
        values = y.tolist()
        rotation, rate = values[m.ROTATION], values[m.ROTATION_RATE]
        if phase is not None:
            if not isinstance(phase, str):
                raise TypeError(f"phase is {told(phase)}: give one of {', '.join(m.MODES)}")
            if phase not in m.MODES:
                raise ValueError(f"no phase {phase!r}; {self.model} has {', '.join(m.MODES)}")
            number = m.MODES.index(phase)
            side = m.SIDES[number]
            turned = abs(rotation) > 1e-9  # an impact's state may be a rounding error off
            if self.rocks_on_rigid_ground and (
                (turned and side * rotation <= 0) or (side == 0 and rate != 0)
            ):
                name = m.STATES[m.ROTATION]
                raise ValueError(
                    f"the phase {phase!r} of {self.model} contradicts {name} = {rotation}, "
                    f"{name}_dot = {rate}: leave `phase` out, it follows from them"
                )
            # where each contact state leans to a side, all end upright
            over = -side * rotation > 1e-6 * self.overturning_rotation
            if all(m.SIDES) and over:
                raise ValueError(
                    f"the phase {phase!r} of {self.model} contradicts {_named(m.STATES, y)}: it "
                    "would have ended before; leave `phase` out, it follows from the state"
                )
            return number
        direction = rotation or rate
        if self.rocks_on_rigid_ground:
            fits = [
                c
                for c, side in enumerate(m.SIDES)
                if (side * direction > 0.0 if side else direction == 0.0)
            ]
            if len(fits) == 1:
                return fits[0]
        else:
            direction = direction or towards
            # springs on both sides may press whichever way it leans, unless all end upright
            away = [c for c, side in enumerate(m.SIDES) if side * direction < 0.0]
            fits = [c for c in range(len(m.SIDES)) if c not in away]
            fits.sort(key=lambda c: abs(m.SIDES[c]))  # the same order on both sides
            fits += [] if all(m.SIDES) else away
        leaning = y.copy()
        if rotation == 0.0:  # on the border of both sides: where it is about to go decides
            leaning[m.ROTATION] = mathematics.copysign(1e-200, direction) if direction else 0.0
        margins = {c: self._margin(c, leaning) for c in fits if not self._is_open(c, leaning)}
        for least in (0.0, -1.0):  # as it is, or where a rounding error hides that it is
            for number, margin in margins.items():
                if margin >= least:
                    return number
        raise ValueError(
            f"no phase of {self.model} holds {_named(m.STATES, y)}: each of "
            f"{', '.join(m.MODES[number] for number in margins)} would have ended before; "
            "correct the state"
        )

    def _under(self, ground: tuple[float, float], y: np.ndarray, phase: str | None) -> int:
        """Number of the contact state; where contacts may slide and open, forces decide, too."""
        contact = self.contact(y, phase)
        if phase is not None or not self.stands_on_points:
            return contact
        return by_forces(self.module, contact, y, self.vector, ground)

    def _is_open(self, contact: int, y: np.ndarray) -> bool:
        """Whether a spring that a contact state closes is open in a state.

        The guard that closes it is the larger of two, of a gap and of a force, and positive then. A
        damper alone holds no spring closed above its ground: its force would have fallen to zero
        before the gap opened.
        """
        m = self.module
        for target, back in zip(m.TARGETS[contact], m.REVERSE[contact], strict=True):
            if back >= 0 and m.PARTS[target][back] >= 0 and self._margins(target, y)[back] > 0.0:
                return True
        return False

    def _margin(self, contact: int, y: np.ndarray) -> float:
        """The lowest margin of a contact state, but for uplift, which is up to the ground.

        Of full contact it is that of the contact state to which it lifts: the same tendons hold it.
        """
        m, kinds = self.module, self.module.KINDS[contact]
        if kinds[0] == UPLIFT:
            upright = y.copy()
            upright[m.ROTATION] = 0.0
            return self._margin(m.TARGETS[contact][0], upright)
        margins = zip(self._margins(contact, y), kinds, strict=False)
        return min((margin for margin, kind in margins if kind != UPLIFT), default=0.0)

    def _margins(self, contact: int, y: np.ndarray) -> np.ndarray:
        """The guards of a contact state, each by how much it changes with the ninth digit of y.

        None is below zero inside the contact state, and none below -1 within rounding of it.
        """
        p = value_of(self.vector)
        m = self.module_for(y, p)

        def guards(state: np.ndarray) -> np.ndarray:
            g = np.zeros(m.N_GUARDS + m.N_PARTS, np.result_type(y, p))
            m.guards(contact, state, p, 0.0, 0.0, g)
            return g[: m.GUARDS[contact]]

        here = guards(y)
        if (here >= 0.0).all():
            return here
        doubt = np.full(len(here), 1e-300, here.dtype)
        for i, value in enumerate(y):
            nudged = y.copy()
            nudged[i] = value * (1.0 + 1e-9)
            doubt += np.abs(guards(nudged) - here)
        return here / doubt

    def accelerations(
        self,
        state: Mapping[str, Any],
        ground_acceleration: Any = 0.0,
        vertical_ground_acceleration: Any = 0.0,
        phase: str | None = None,
    ) -> dict[str, Any]:
        """Accelerations of the coordinates, by name [unit of the coordinate per s2].

        A state may hold arrays, as the accelerations of the ground [m/s2], of one shape or for
        NumPy to make of one; what is found has that shape. Where contacts may slide and open, and
        no phase is named, the contact state is that which the forces lead to: a block at rest
        slides under an acceleration that its friction cannot hold. Raises ValueError where they
        fit none, or several (Painleve).

        >>> block.accelerations({"theta": np.linspace(0.0, 0.1, 11)}, ground_acceleration=3.0)
        """
        at = self._at(state, phase, ground_acceleration, vertical_ground_acceleration)
        found = filled(self, "rates", self.module.N_STATES, at.contact, at.y, *at.ground)
        n = len(self.states) // 2
        return at.shaped(dict(zip(self.states[:n], found[n:], strict=True)))

    def absolute_accelerations(
        self,
        state: Mapping[str, Any],
        ground_acceleration: Any = 0.0,
        vertical_ground_acceleration: Any = 0.0,
        phase: str | None = None,
    ) -> dict[str, np.ndarray]:
        """Accelerations (..., 2) of the places of `positions`, with the ground's, by name [m/s2].

        The arguments are those of `accelerations`; of a motion see `run.places`.
        """
        at = self._at(state, phase, ground_acceleration, vertical_ground_acceleration)
        found = evaluation.accelerations(self, at.contact, at.y, *at.ground)
        return {name: value.reshape(*at.shape, 2) for name, value in found.items()}

    def velocities(
        self, state: Mapping[str, Any], phase: str | None = None
    ) -> dict[str, np.ndarray]:
        """Velocities (..., 2) of the places of `positions`, by name [m/s], relative to the ground.

        `run.places.velocities()` tells those of a motion.
        """
        at = self._at(state, phase)
        found = evaluation.velocities(self, at.contact, at.y)
        return {name: value.reshape(*at.shape, 2) for name, value in found.items()}

    def after_impact(
        self,
        state: Mapping[str, float],
        phase: str,
        impact: ImpactLaw | None = None,
        impact_number: int = 0,
    ) -> tuple[dict[str, float], str]:
        """State after the impact that closes `phase`, and the phase that follows.

        impact : `default_impact` if not given. impact_number : of the impact in its motion, from 0
        on, for a law that draws.
        Raises ValueError where the model has no impact in that phase.
        """
        m = self.module
        if self.stands_on_points:
            raise ValueError(
                f"{self.model} has a law of impact for each of its points: simulate it, its events "
                "tell the states before and after each landing"
            )
        y = self.state(state)
        contact = self.contact(y, phase)
        if m.KINDS[contact][0] != IMPACT or m.GUARDS[contact] == 0:
            raise ValueError(f"no impact ends the phase {phase!r} of {self.model}")
        law, ratio = self.law(impact)
        if isinstance(impact, TabledLaw):
            ratio = impact.velocity_ratio(self, float(y[m.ROTATION_RATE]), impact_number)
        out = np.empty_like(y)
        follows = m.jump(contact, 0, law, ratio, y, self.vector, out)
        return dict(zip(self.states, out.tolist(), strict=True)), m.MODES[follows]

    def law(self, impact: ImpactLaw | None) -> tuple[int, float]:
        """(law, ratio) for the compiled functions; None is `default_impact`.

        Raises ValueError where a law is given to a model without impacts, and TypeError for what
        is no law.
        """
        m = self.module
        if not self.has_impacts:
            if impact is not None and self.stands_on_points:
                raise ValueError(
                    f"{self.model} has a law of impact for each of its points, as it is declared; "
                    "leave `impact` out"
                )
            if impact is not None:
                raise ValueError(
                    f"{self.model} has no impacts, forces take their place; leave `impact` out"
                )
            return 0, 1.0
        chosen = default_law(m) if impact is None else impact
        check_law(chosen)
        return chosen.resolve(self.velocity_ratio, m.HAS_IMPULSIVE, self.model)

    @property
    def default_impact(self) -> ImpactLaw | None:
        """The impact law where none is named; None for a structure that takes no law.

        `Impulsive` where something besides the rotation moves at an impact, such as a column that
        bends, and the masses determine the impulses; `AngularMomentum` otherwise.
        """
        return default_law(self.module) if self.has_impacts else None

    def describe_impact(self, impact: ImpactLaw | None) -> str:
        """The impact law in words, and whether it is the default; empty where none applies."""
        if not self.has_impacts:
            return ""
        return repr(impact) if impact is not None else f"{self.default_impact!r}, by default"

    @property
    def speed_height(self) -> float | None:
        """Height of the point whose speed a law of impact means [m]; None if there is none."""
        return None

    def impact_table(self, impact: ImpactLaw | None) -> list[float]:
        """What the compiled loop reads behind the parameters, for a law that needs a table."""
        if isinstance(impact, TabledLaw) and impact.table_needed and self.has_impacts:
            return impact.table(self)
        return []

    @property
    def rocking_inertia(self) -> float:
        """Moment of inertia with which an impact finds the structure rocking [kg m2].

        Twice the kinetic energy upright on one foot, turning by 1 rad/s, the other rates zero.
        Raises TypeError for a structure whose rotation is no angle in time.
        """
        m, p = self.module_for(self.vector), self.vector
        if m.STATE_UNITS[m.ROTATION_RATE] != "rad/s":
            raise TypeError(
                f"the rate of {self.model} is in {m.STATE_UNITS[m.ROTATION_RATE]}: a loss of "
                "energy in joules says nothing of it; give an energy ratio"
            )
        y = np.zeros(len(m.STATES), p.dtype)
        y[m.ROTATION_RATE] = 1.0
        out = np.zeros(len(m.ENERGIES), p.dtype)
        m.energies(next(c for c, side in enumerate(m.SIDES) if side > 0), y, p, out)
        return 2.0 * out[m.ENERGIES.index("kinetic_energy")]

    def energies(self, state: Mapping[str, Any], phase: str | None = None) -> dict[str, Any]:
        """Kinetic, gravitational and elastic energy [J]; heights count from the ground.

        A state may hold arrays, of one shape or for NumPy to make of one; so has what is found.
        """
        at = self._at(state, phase)
        return at.shaped(at_states(self, "energies", at.contact, at.y))

    def reactions(
        self,
        state: Mapping[str, Any],
        ground_acceleration: Any = 0.0,
        vertical_ground_acceleration: Any = 0.0,
        phase: str | None = None,
    ) -> dict[str, Any]:
        """Horizontal force, and vertical force at each foot [N], of the ground on the structure.

        In full contact the horizontal force is the sum over both feet. The arguments are those of
        `accelerations`.
        """
        at = self._at(state, phase, ground_acceleration, vertical_ground_acceleration)
        return at.shaped(at_states(self, "reactions", at.contact, at.y, *at.ground))

    def elements(self, state: Mapping[str, Any], phase: str | None = None) -> dict[str, Any]:
        """Deformation [m], force [N] and stored energy [J] of each spring, damper and tendon.

        By name, such as "storey_1_force"; of what is pressed or shortened the deformation is
        positive where it was declared so. The arguments are those of `energies`.
        """
        at = self._at(state, phase)
        return at.shaped(evaluation.elements(self, at.contact, at.y))

    def positions(
        self, state: Mapping[str, Any], phase: str | None = None
    ) -> dict[str, np.ndarray]:
        """Places (..., 2) of bodies, feet and the load point, by name [m].

        x to the right and y upwards, in axes that move with the ground, from the origin of the
        declaration: the middle between the feet at rest, of shipped structures. A state may hold
        arrays, of one shape or for NumPy to make of one. Of a motion see `run.places`.
        """
        return positions_of(self.module, self._places(state, phase))

    def rotations(
        self, state: Mapping[str, Any], phase: str | None = None
    ) -> dict[str, np.ndarray]:
        """Angles (...) through which the bodies have turned, by name, clockwise [rad]."""
        return rotations_of(self.module, self._places(state, phase))

    def _places(self, state: Mapping[str, Any], phase: str | None) -> np.ndarray:
        """(..., m, 3) for a state, or many."""
        at = self._at(state, phase)
        return places(self.module, at.contact, at.y, self.vector).reshape(*at.shape, -1, 3)

    def _at(
        self,
        state: Mapping[str, Any],
        phase: str | None,
        *ground: Any,
    ) -> _Given:
        """A state, or many; where the ground's accelerations are given forces decide as well."""
        check_states("state", state, self)
        names = ("ground_acceleration", "vertical_ground_acceleration")
        shaken = [
            number(n, x) if np.ndim(x) == 0 else numbers(n, x)
            for n, x in zip(names, ground, strict=False)
        ]
        columns = np.broadcast_arrays(0.0, *state.values(), *shaken)[1:]
        shape = columns[0].shape if columns else ()
        rows = [*zip(*(column.ravel().tolist() for column in columns), strict=True)] or [()]
        y = np.array([self.state(dict(zip(state, row, strict=False))) for row in rows])
        shakes = [row[len(state) :] for row in rows]
        contact = [
            self._under(shake, one, phase) if ground else self.contact(one, phase)
            for one, shake in zip(y, shakes, strict=True)
        ]
        across = np.array(shakes, dtype=float).reshape(len(y), len(shaken)).T
        return _Given(shape, y, np.array(contact), tuple(across))

    @functools.cached_property
    def shapes(self) -> Shapes:
        """Outlines of its bodies and what joins them, as they were declared, for a sketch."""
        return shapes(self.module, self.vector)

    @functools.cached_property
    def uplift_acceleration(self) -> float | None:
        """Least horizontal ground acceleration, either way, at which a foot lifts [m/s2].

        The structure stands in equilibrium under it: a column has bent under an acceleration that
        grew slowly, and may lift earlier when it vibrates. For a block it is g tan(alpha). inf if
        none lifts it; None unless the structure stands on rigid ground.
        """
        if not self.rocks_on_rigid_ground:
            return None
        from rockeom.structures.statics import uplift_acceleration

        return uplift_acceleration(self)

    @property
    def slenderness(self) -> float | None:
        """Angle of the line from an edge to the centroid [rad]; None where the class has none."""
        return getattr(self, "alpha", None)

    def hints(self) -> tuple[str, ...]:
        """What about the parameters is allowed and hardly meant, a sentence each."""
        from rockeom.structures.plausible import damping, size

        return (*size(self), *damping(self))

    def fixed_base(self) -> FixedBase:
        """The same structure with feet that cannot lift, with its periods.

        It is simulated as any other, and has the same energies, forces and displacements.

        Raises ValueError for a structure without full contact on rigid ground, and for a rigid
        one, which has no degree of freedom left.

        >>> column = FlexibleStructure(
        ...     mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.1,
        ...     base_inertia=1.37, half_width=0.285, stiffness=571.8e3, damping=502.4,
        ... )
        >>> column.fixed_base().periods  # s
        array([0.09200...])
        """
        from rockeom.structures.fixed_base import FixedBase

        return FixedBase(self)

    def equilibrium(self, rotation: float) -> tuple[float, np.ndarray]:
        """(force, state) at rest under the force at the load point that holds a rotation [N].

        The state is a vector (N,) in the order of `states`. Raises ValueError where no equilibrium
        was found.
        """
        from rockeom.structures.statics import equilibrium

        return equilibrium(self, rotation)

    def pushover(self, rotations) -> np.ndarray:
        """Horizontal force at the load point that holds the structure at each rotation [N].

        rotations : any shape [rad]; the other coordinates are in equilibrium. At zero rotation
        of a structure on rigid ground this is the force at which it lifts to the right.
        Raises ValueError where no equilibrium was found.
        """
        from rockeom.structures.statics import pushover

        return pushover(self, rotations)


_SYNONYMS = {
    "p": "frequency_parameter",
    "R": "radius",
    "r": "velocity_ratio",
    "e": "velocity_ratio",
    "m": "mass",
    "g": "gravity",
    "b": "half_width",
    "B": "half_width",
    "h": "half_height",
    "H": "half_height",
    "width": "2 * half_width",
    "height": "2 * half_height",
    "k": "stiffness",
    "c": "damping",
    "I": "inertia",
    "mu": "friction",
    "name": "model",
}
"""Symbols and names that people try first, and the attributes that they mean."""


def _missing(structure: Structure, name: str) -> Any:
    """Raise AttributeError for an attribute that a structure lacks.

    A property that itself raised AttributeError is evaluated again, so that its own error is seen.
    """
    if hasattr(type(structure), name):
        return object.__getattribute__(structure, name)
    message = f"{type(structure).__name__!r} object has no attribute {name!r}"
    if name.startswith("_"):
        raise AttributeError(message)
    raise UnknownAttributeError(message, name, structure, _SYNONYMS)


def _named(states: tuple[str, ...], y: np.ndarray) -> str:
    """A state in words, without what is zero."""
    shown = [f"{name} = {value:g}" for name, value in zip(states, y.tolist(), strict=True) if value]
    return ", ".join(shown) or "the state at rest"


class _Given(NamedTuple):
    """States y (n, N) that stand for arrays of a shape, their contact states, and the ground's
    accelerations, (n,) each."""

    shape: tuple[int, ...]
    y: np.ndarray
    contact: np.ndarray
    ground: tuple[np.ndarray, ...]

    def shaped(self, found: Mapping[str, np.ndarray]) -> dict[str, Any]:
        """(n,) by name in the shape, numbers of a single state."""
        if not self.shape:
            return {name: float(value[0]) for name, value in found.items()}
        return {name: value.reshape(self.shape) for name, value in found.items()}


S = TypeVar("S", bound=Structure)


class ParameterError(TypeError):
    """Parameters that a structure lacks or does not know, or that are given without their name."""


def check_states(what: str, values: Any, structure: Structure) -> None:
    """Raise TypeError for what is no mapping of names of states."""
    if not (type(values) is dict or isinstance(values, Mapping)):  # most are, and it is faster
        example = f"{{{structure.states[0]!r}: 0.01}}"
        raise TypeError(f"{what} is {told(values)}: name the states, as in {example}")


def check_names(what: str, required: set[str], known: set[str], given: set[str]) -> None:
    """Raise ParameterError naming all that is missing and all that is unknown, with the remedy."""
    missing = sorted(required - given)
    unknown = sorted(given - known)
    if not missing and not unknown:
        return
    text = []
    if missing:
        text.append(f"missing {', '.join(missing)}")
    text += [f"unknown {name}{near(name, known)}" for name in unknown]
    raise ParameterError(
        f"{what}: {'; '.join(text)}. Its parameters are {', '.join(sorted(known))}"
    )


LARGEST = 1e50
"""The largest size of a parameter: its sixth power is a number, and that of its inverse."""


def check_values(
    what: str,
    values: Mapping[str, float | None],
    may_vanish: frozenset[str],
    may_be_negative: frozenset[str] = frozenset(),
    largest: float = LARGEST,
) -> None:
    """Raise ValueError for a parameter that is not positive and finite, TypeError for no number.

    Where allowed it may be zero, or any finite number. largest : the size beyond which a parameter
    is refused; one that must be positive is no smaller than its inverse.
    """
    for name, value in values.items():
        if value is None:
            continue
        given = number(f"{what}: {name}", value, "give a number in SI units")
        allowed = given >= 0 if name in may_vanish else given > 0
        if name in may_be_negative:
            if not isfinite(given):
                raise ValueError(f"{what}: {name} is {value}: it must be finite")
        elif not (isfinite(given) and allowed):
            wanted = "zero or positive" if name in may_vanish else "positive"
            raise ValueError(f"{what}: {name} is {value}: it must be finite and {wanted}")
        signless = name in may_vanish or name in may_be_negative
        if abs(given) > largest or not (signless or given >= 1.0 / largest):
            limits = f"beyond {largest:g}" if abs(given) > 1.0 else f"below {1.0 / largest:g}"
            raise ValueError(
                f"{what}: {name} is {value}, {limits}, so that products of it leave the range of "
                "numbers: give it in SI units"
            )


_WRITTEN: dict[str, type[Structure]] = {}
"""The classes of shipped structures that are written here, by the name of the model."""


@dataclass_transform(kw_only_default=True, frozen_default=True)
def _structure_class(cls: type[S]) -> type[S]:
    """A frozen dataclass by keyword whose constructor explains what is wrong."""
    dataclass(frozen=True, kw_only=True)(cls)
    defaults = cls.defaults()
    known = set(defaults)
    required = {name for name, default in defaults.items() if default is dataclasses.MISSING}
    plain: Any = cls.__init__

    @functools.wraps(plain)
    def init(self: Structure, *unnamed: Any, **values: Any) -> None:
        if unnamed:
            raise ParameterError(_unnamed(cls.__name__, unnamed[0], known))
        check_names(cls.__name__, required, known, set(values))
        numbers = {name: v for name, v in values.items() if name not in cls.not_numbers}
        check_values(cls.__name__, numbers, cls.may_vanish, cls.may_be_negative)
        plain(self, **values)

    setattr(cls, "__init__", init)  # noqa: B010
    if "model" in vars(cls):
        _WRITTEN[cls.model] = cls
    return cls


def _unnamed(what: str, value: Any, known: Iterable[str]) -> str:
    return (
        f"{what} takes its parameters by name, and {told(value)} has none. "
        f"Its parameters are {', '.join(sorted(known))}"
    )


def _inertia_hints(mass: float, radius: float, inertia: float | None) -> tuple[str, ...]:
    """Of a centroid at the middle of a rectangle and an inertia that no body within it has."""
    most = mass * radius**2
    if inertia is None or inertia <= most * (1 + 1e-12):
        return ()
    return (
        f"inertia is {inertia:.4g} kg m2 about the centroid; a body of this size has at most "
        f"m R**2 = {most:.4g} kg m2, with all its mass at the corners.",
    )


@_structure_class
class RigidBlock(Structure):
    """Housner's rigid block on rigid ground, any size of rotation.

    half_width, half_height [m]; mass [kg]; inertia about the centroid [kg m2], that of a
    homogeneous rectangle if not given; gravity [m/s2]. The centroid stands at half_height.
    """

    model: ClassVar[str] = "rigid_block"
    may_vanish = frozenset({"inertia"})
    half_width: float
    half_height: float
    mass: float = 1.0
    inertia: float | None = None
    gravity: float = STANDARD_GRAVITY

    @classmethod
    def from_frequency(
        cls,
        p: float,
        alpha: float,
        mass: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
        **others: float,
    ) -> Self:
        """The homogeneous rectangular block of frequency parameter p [rad/s] and angle alpha [rad].

        p**2 = m g R/I_o = 3 g/(4 R). others : the parameters that are left.
        """
        check_values(cls.__name__, {"p": p, "alpha": alpha, "gravity": gravity}, frozenset())
        if not alpha < math.pi / 2:
            raise ValueError(f"{cls.__name__}: alpha is {alpha}: it must be below pi/2")
        radius = 0.75 * gravity / p**2
        return cls(
            half_width=radius * mathematics.sin(alpha),
            half_height=radius * mathematics.cos(alpha),
            mass=mass,
            gravity=gravity,
            **others,
        )

    @property
    def alpha(self) -> float:
        """Angle of the line from an edge to the centroid, from the vertical [rad]."""
        return mathematics.atan2(self.half_width, self.half_height)

    @property
    def radius(self) -> float:
        """Distance of the centroid from an edge, R [m]."""
        return mathematics.hypot(self.half_width, self.half_height)

    @property
    def frequency_parameter(self) -> float:
        """p = sqrt(m g R/I_o) [rad/s]."""
        values = self.parameters()
        pivot_inertia = values["inertia"] + self.mass * self.radius**2
        return mathematics.sqrt(self.mass * self.gravity * self.radius / pivot_inertia)

    def hints(self) -> tuple[str, ...]:
        return (*super().hints(), *_inertia_hints(self.mass, self.radius, self.inertia))

    def parameters(self) -> dict[str, float]:
        inertia = self.mass * self.radius**2 / 3 if self.inertia is None else self.inertia
        return {
            "mass": self.mass,
            "half_width": self.half_width,
            "height": self.half_height,
            "inertia": inertia,
            "gravity": self.gravity,
        }


@_structure_class
class SlidingBlock(RigidBlock):
    """The rigid block on feet that open, stick, slip and bounce, any size of rotation.

    friction : its coefficient at each foot; restitution : the ratio of the rates of a foot's gap
    after and before it lands, 0 to 1. All else is that of `RigidBlock`. States are the place x and
    the height y of the base's centre [m], theta [rad], and their rates.
    """

    model: ClassVar[str] = "sliding_block"
    may_vanish = frozenset({"inertia", "friction", "restitution"})
    friction: float
    restitution: float

    def __post_init__(self) -> None:
        check_restitution("SlidingBlock", self.restitution)

    def parameters(self) -> dict[str, float]:
        return super().parameters() | {"friction": self.friction, "restitution": self.restitution}


def _of_blocks(cls: type[S]) -> type[S]:
    """Lets a class of two blocks take each as a `RigidBlock`, too."""
    plain: Any = cls.__init__

    @functools.wraps(plain)
    def init(
        self: Structure,
        *unnamed: Any,
        lower: RigidBlock | None = None,
        upper: RigidBlock | None = None,
        **values: Any,
    ) -> None:
        for name, block in (("lower", lower), ("upper", upper)):
            if block is None:
                continue
            if type(block) is not RigidBlock:
                raise TypeError(f"{cls.__name__}: {name} is {told(block)}: give a RigidBlock")
            if values.setdefault("gravity", block.gravity) != block.gravity:
                raise ValueError(
                    f"{cls.__name__}: gravity is {values['gravity']}, and {block.gravity} of the "
                    f"{name} block: give both blocks the same"
                )
            for part in _OF_A_BLOCK:
                if f"{name}_{part}" in values:
                    raise ParameterError(
                        f"{cls.__name__}: {name}_{part} is given, and so is {name}: leave one out"
                    )
                values[f"{name}_{part}"] = getattr(block, part)
        plain(self, *unnamed, **values)

    setattr(cls, "__init__", init)  # noqa: B010
    return cls


_OF_A_BLOCK = ("half_width", "half_height", "mass", "inertia")


@_of_blocks
@_structure_class
class StackedBlocks(Structure):
    """Two rigid blocks on one another, whose corners open and close; none of them slips.

    lower, upper : two of `RigidBlock`, the upper no wider than the lower one, under one gravity; or
    the parameters of each, such as lower_half_width. restitution : the ratio of the rates of a gap
    after and before a corner lands, 0 to 1. States are x, y [m] and theta [rad] of the lower
    block's base; xi and eta [m] of the upper block's base along and above the lower one's top, and
    its rotation phi [rad]; and their rates.
    """

    model: ClassVar[str] = "stacked_blocks"
    may_vanish = frozenset({"restitution", "lower_inertia", "upper_inertia"})
    lower_half_width: float
    lower_half_height: float
    upper_half_width: float
    upper_half_height: float
    lower_mass: float = 1.0
    upper_mass: float = 1.0
    lower_inertia: float | None = None
    upper_inertia: float | None = None
    restitution: float = 0.0
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        check_restitution("StackedBlocks", self.restitution)
        if self.upper_half_width > self.lower_half_width:
            raise ValueError(
                f"StackedBlocks: upper_half_width is {self.upper_half_width} and lower_half_width "
                f"{self.lower_half_width}: corners that hang over are not modelled, give an upper "
                "block that is no wider"
            )

    def _block(self, which: str) -> RigidBlock:
        parts = {part: getattr(self, f"{which}_{part}") for part in _OF_A_BLOCK}
        return RigidBlock(gravity=self.gravity, **parts)

    @property
    def lower(self) -> RigidBlock:
        return self._block("lower")

    @property
    def upper(self) -> RigidBlock:
        return self._block("upper")

    def parameters(self) -> dict[str, float]:
        values = {"gravity": self.gravity, "restitution": self.restitution}
        for which, block in (("lower", self.lower), ("upper", self.upper)):
            of = block.parameters()
            values |= {f"{which}_{n}": of[n] for n in ("mass", "half_width", "inertia")}
            values[f"{which}_half_height"] = of["height"]
        return values

    def hints(self) -> tuple[str, ...]:
        return (*self.lower.hints(), *self.upper.hints())


def check_restitution(what: str, restitution: float) -> None:
    """Raise ValueError for a ratio of rates above one, which would give energy."""
    if restitution > 1:
        raise ValueError(
            f"{what}: restitution is {restitution}: give the ratio of rates after and before a "
            "landing, 0 to 1"
        )


@_structure_class
class SlenderBlock(Structure):
    """The linearised block of thesis 2-3 and 2-14, for small rotations and small alpha.

    radius R [m] from an edge to the centroid, alpha [rad]; inertia about the centroid [kg m2],
    m R**2/3 if not given.
    """

    model: ClassVar[str] = "slender_block"
    may_vanish = frozenset({"inertia"})
    radius: float
    alpha: float
    mass: float = 1.0
    inertia: float | None = None
    gravity: float = STANDARD_GRAVITY

    @classmethod
    def from_frequency(
        cls, p: float, alpha: float, mass: float = 1.0, gravity: float = STANDARD_GRAVITY
    ) -> SlenderBlock:
        """The rectangular block of frequency parameter p [rad/s] and angle alpha [rad]."""
        check_values("SlenderBlock", {"p": p, "alpha": alpha, "gravity": gravity}, frozenset())
        return cls(radius=0.75 * gravity / p**2, alpha=alpha, mass=mass, gravity=gravity)

    def hints(self) -> tuple[str, ...]:
        return (*super().hints(), *_inertia_hints(self.mass, self.radius, self.inertia))

    def parameters(self) -> dict[str, float]:
        inertia = self.mass * self.radius**2 / 3 if self.inertia is None else self.inertia
        return {
            "mass": self.mass,
            "radius": self.radius,
            "alpha": self.alpha,
            "inertia": inertia,
            "gravity": self.gravity,
        }


@_structure_class
class NondimensionalBlock(Structure):
    """The block in x = theta/alpha and time p t, thesis 2-13; accelerations in units of g.

    alpha [rad]; radius_ratio m R**2/I_o, 3/4 for a homogeneous rectangle.
    """

    model: ClassVar[str] = "nondimensional_block"
    alpha: float
    radius_ratio: float = 0.75

    def hints(self) -> tuple[str, ...]:
        if 0.5 <= self.radius_ratio <= 1:
            return ()
        return (
            f"radius_ratio is {self.radius_ratio:.4g}; m R**2/I_o of a block lies between 1/2, all "
            "its mass at the corners, and 1, all of it at the centroid.",
        )


@_structure_class
class DiracDeltaBlock(Structure):
    """The slender block in x = theta/alpha and time p t, its impacts forces (thesis 2-29).

    alpha [rad]; energy_ratio r, that of the kinetic energies after and before an impact, as in
    `EnergyRatio`; regularisation n, the width in x over which an impact is spread. As n falls to
    zero the response becomes that of `SlenderBlock`, with an error in proportion to n.
    Accelerations are in units of g; alpha matters to shaking only. There are no jumps of the
    velocity: `impacts` is empty, `events` holds the passages between "left_core" and "right_core".
    Tolerances must be below n.
    """

    model: ClassVar[str] = "dirac_delta_block"
    alpha: float
    energy_ratio: float
    regularisation: float

    def __post_init__(self) -> None:
        if self.energy_ratio > 1:
            raise ValueError(
                f"DiracDeltaBlock: energy_ratio is {self.energy_ratio}: above 1 impacts would "
                "give energy"
            )


@_structure_class
class _TwoMasses(Structure):
    """What the structures of a superstructure and a base share.

    mass, base_mass [kg] at height, base_height [m]; inertia, base_inertia about their own
    centroids [kg m2]; half_width [m] half of the distance between the feet; gravity [m/s2].
    """

    may_vanish = frozenset(
        {"inertia", "base_mass", "base_height", "base_inertia", "damping", "foundation_damping"}
    )
    mass: float
    height: float
    inertia: float
    base_mass: float
    base_height: float
    base_inertia: float
    half_width: float
    gravity: float = STANDARD_GRAVITY


class Support:
    """What the base of a structure stands on: how it may move, and what holds it.

    Those that there are stand in `rockeom.modelling.composed`.
    """

    def parameters(self) -> dict[str, float]:
        """Its parameters, by the names that they have in the generated module, in SI units."""
        return {}

    def module(self, superstructure: str, **arguments: int) -> ModuleType:
        """The generated module of a superstructure that stands on it."""
        raise NotImplementedError

    def check_base(self, what: str, mass: float, inertia: float) -> None:
        """Raise ValueError where a base that this support leaves free has no mass or inertia."""


def check_support(what: str, support: Any, mass: float, inertia: float) -> None:
    """Raise TypeError for what is no support, and ValueError for a base that it cannot carry.

    mass [kg], inertia [kg m2] : of all that moves with the base as one body, about its sole's
    middle.
    """
    if support is None:
        return
    if not isinstance(support, Support):
        raise TypeError(
            f"{what}: support is {told(support)}: give what the base stands on, such as rk.Pinned()"
        )
    support.check_base(what, mass, inertia)


@_structure_class
class _Supported(_TwoMasses):
    """Two masses that stand on any support."""

    not_numbers = frozenset({"support"})
    support: Any = None  # a Support: of any type, that all others may be given as ** of numbers

    def __post_init__(self) -> None:
        mass, inertia = self._of_base()
        check_support(type(self).__name__, self.support, mass, inertia)

    def _of_base(self) -> tuple[float, float]:
        """(mass, inertia) of all that moves with the base as one body."""
        inertia = self.inertia + self.base_inertia + self.base_mass * self.base_height**2
        return self.base_mass, inertia

    @functools.cached_property
    def module(self) -> ModuleType:
        """The generated module, of this support."""
        return self.support.module(self.model) if self.support else super().module

    def parameters(self) -> dict[str, float]:
        values = super().parameters()
        del values["support"]
        return values | (self.support.parameters() if self.support else {})


@_structure_class
class LumpedMassStructure(_Supported):
    """Rigid structure of two lumped masses (thesis Model A).

    mass, base_mass [kg] at height, base_height [m]; inertia, base_inertia about their own
    centroids [kg m2]; half_width [m] half of the distance between the feet; gravity [m/s2].
    support : what the base stands on, rk.Pinned() on rigid ground if not given.
    """

    model: ClassVar[str] = "lumped_mass_structure"

    def _of_base(self) -> tuple[float, float]:
        mass, inertia = super()._of_base()
        return mass + self.mass, inertia + self.mass * self.height**2


@_structure_class
class TwoSpringStructure(_TwoMasses):
    """Model B exactly: the rigid structure on two compression-only springs and dampers.

    foundation_stiffness [N/m] and foundation_damping [N s/m] of each foot; else as
    LumpedMassStructure. The base's centre is guided vertically; `heave` counts from the settled
    position. The elastic energy is that of the springs that press: a damped foot lifts off a
    spring that is still compressed.
    """

    model: ClassVar[str] = "two_spring_structure"
    foundation_stiffness: float
    foundation_damping: float


@_structure_class
class TwoSpringCart(_TwoMasses):
    """Model B as the thesis has it: a cart on the closed-form k(u), 5-15, 5-25 and 5-33.

    foundation_stiffness [N/m] of each foot; else as LumpedMassStructure.
    """

    model: ClassVar[str] = "two_spring_cart"
    foundation_stiffness: float


@_structure_class
class FlexibleStructure(_Supported):
    """Flexible structure of two masses (thesis Model C).

    As LumpedMassStructure, with the column's stiffness [N/m] and damping [N s/m].
    """

    model: ClassVar[str] = "flexible_structure"
    stiffness: float
    damping: float


@_structure_class
class UpliftingOscillator(Structure):
    """Flexible structure of one mass on a massless base, small displacements (thesis 2-7).

    The oscillator of Chopra and Yim (1985): mass [kg], a point at height [m]; half_width [m] half
    of the distance between the feet; stiffness [N/m] and damping [N s/m] of the column; gravity
    [m/s2]. Without P-delta it never overturns. By `Impulsive` each impact ends in full contact.
    The base has no weight to keep it down: `lost_contact` says whether a foot would have jumped.
    """

    model: ClassVar[str] = "uplifting_oscillator"
    may_vanish = frozenset({"damping"})
    mass: float
    height: float
    half_width: float
    stiffness: float
    damping: float
    gravity: float = STANDARD_GRAVITY

    @classmethod
    def from_frequency(
        cls,
        angular_frequency: float,
        damping_ratio: float,
        height: float,
        half_width: float,
        mass: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
    ) -> UpliftingOscillator:
        """The one whose column on a fixed base has this angular frequency [rad/s] and damping.

        damping_ratio : of critical damping; height, half_width [m]; mass [kg].
        """
        given = {"angular_frequency": angular_frequency, "damping_ratio": damping_ratio}
        given["mass"] = mass
        check_values("UpliftingOscillator", given, frozenset({"damping_ratio"}))
        return cls(
            mass=mass,
            height=height,
            half_width=half_width,
            stiffness=mass * angular_frequency**2,
            damping=2 * damping_ratio * angular_frequency * mass,
            gravity=gravity,
        )


class TendonedWall(Protocol):
    """What the classes of walls ask of a wall, a `rockeom.analysis.Wall`, to be made from it."""

    @property
    def mass(self) -> float: ...
    @property
    def height(self) -> float: ...
    @property
    def half_width(self) -> float: ...
    @property
    def centroid_height(self) -> float: ...
    @property
    def corner_inertia(self) -> float: ...
    @property
    def fixed_base_period(self) -> float: ...
    @property
    def gravity(self) -> float: ...
    @property
    def rotation_centre(self) -> Any: ...
    @property
    def tendons(self) -> tuple[Any, ...]: ...
    def moment_of_inertia(self, detached_length: Any) -> Any: ...


@_structure_class
class _ControlledWall(Structure):
    """What the models of a controlled rocking wall share; see `ControlledWall`."""

    may_vanish = frozenset({"edge_distance", "initial_force"})
    may_be_negative = frozenset({"eccentricity"})
    mass: float
    height: float
    half_width: float
    edge_distance: float
    transition: float
    tendon_stiffness: float
    initial_force: float
    yield_force: float
    eccentricity: float = 0.0
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        what = type(self).__name__
        if not self.initial_force < self.yield_force:
            raise ValueError(
                f"{what}: initial_force is {self.initial_force}: it must be below yield_force, "
                f"{self.yield_force}"
            )
        if not self.edge_distance < self.half_width:
            raise ValueError(
                f"{what}: edge_distance is {self.edge_distance}: it must be below half_width, "
                f"{self.half_width}"
            )

    @classmethod
    def _of_wall(cls, wall: TendonedWall) -> dict[str, float]:
        """The shared parameters of a wall of `rockeom.analysis`."""
        if isinstance(wall, type) or not hasattr(wall, "tendons"):
            raise TypeError(
                f"wall is {told(wall)}: give a wall, such as rockeom.analysis.Wall.thesis()"
            )
        if len(wall.tendons) != 1:
            raise ValueError(
                f"{cls.__name__} has one tendon, the wall has {len(wall.tendons)}: for several "
                "derive a model, rockeom.symbolic.controlled_wall"
            )
        (tendon,) = wall.tendons
        return {
            "mass": wall.mass,
            "height": wall.height,
            "half_width": wall.half_width,
            "edge_distance": wall.rotation_centre.C2,
            "transition": wall.rotation_centre.epsilon,
            "tendon_stiffness": tendon.stiffness,
            "initial_force": tendon.initial_force,
            "yield_force": tendon.yield_force,
            "eccentricity": tendon.eccentricity,
            "gravity": wall.gravity,
        }

    @property
    def speed_height(self) -> float:
        return self.height

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """(N,) state vector; beyond yield on the way back the tendon has been drawn out.

        A permanent_extension that is not given is then that which leaves the yield force.
        """
        y = super().state(values)
        self._check_reach(y)
        if "permanent_extension" in values:
            return y
        y = y.astype(np.result_type(y, self.vector))
        m = self.module
        side = "left" if (y[m.ROTATION] or y[m.ROTATION_RATE]) < 0 else "right"
        beyond = self._elastic_force(side, y) - self.yield_force
        if beyond > 0.0:
            yielding = m.MODES.index(f"{side}_yield")
            if self._margin(yielding, y) < 0.0:
                y[m.STATES.index("permanent_extension")] = beyond / self.tendon_stiffness
        return y

    def _check_reach(self, y: np.ndarray) -> None:
        """Raise ValueError for a state that no rotation has."""

    def _elastic_force(self, side: str, y: np.ndarray) -> float:
        """Force of the tendon [N], if it neither yields nor is slack."""
        m = self.module_for(y, self.vector)
        forces = np.empty(len(m.REACTIONS), np.result_type(y, self.vector))
        m.reactions(m.MODES.index(side), y, self.vector, 0.0, 0.0, forces)
        return number("tendon_force", forces[m.REACTIONS.index("tendon_force")])

    def pushover(self, rotations) -> np.ndarray:
        """Force at the load point that holds the wall at each rotation, or displacement [N].

        rotations : any shape, in the unit of the model's first state. Each is reached from upright
        by a growing rotation: a tendon that yields has its yield force.
        """
        return super().pushover(rotations)

    def equilibrium(self, rotation: float) -> tuple[float, np.ndarray]:
        m = self.module
        y = np.zeros(m.N_STATES)
        y[m.ROTATION] = rotation
        side = "left" if rotation < 0 else "right"
        elastic = self._elastic_force(side, y)
        state = "_yield" if elastic > self.yield_force else "_slack" if elastic < 0 else ""
        return self._load(m.MODES.index(side + state), y), y

    def _load(self, contact: int, y: np.ndarray) -> float:
        """The force with which the rotation of a state is in equilibrium [N]."""
        row = self.module.ROTATION
        none = self._lacking(contact, y, 0.0)[row]
        load = 1.0 + abs(none)  # the digits of one newton might be lost beside the other forces
        return float(load * (none / (none - self._lacking(contact, y, load)[row])))

    def _lacking(self, contact: int, y: np.ndarray, load: float) -> np.ndarray:
        """What each coordinate lacks of equilibrium under a load [N]."""
        out = np.empty(len(y) // 2)
        self.module.statics(contact, y, self.vector, load, out)
        return out


@_structure_class
class ControlledWall(_ControlledWall):
    """A rigid wall held by an unbonded tendon, by Lagrange's equations with no term dropped.

    mass [kg] of all that moves; height H [m] of the point whose displacement Delta counts;
    half_width B of the base [m]. The rotation centre moves out
    with Delta to edge_distance [m] from the edge, over the displacement transition epsilon [m]:
    b = (B - edge_distance) (1 - exp(-(Delta/epsilon)**2)), thesis 4-8. tendon_stiffness [N/m],
    initial_force and yield_force [N]; eccentricity [m] of the tendon from the centreline, positive
    to the right; gravity [m/s2].

    The tendon is elastic, yields, or is slack: a contact state each. The state
    `permanent_extension` is put to its new value when yielding ends. A wall that starts at rest
    beyond yield has been pulled there. `tendon_force`, `tendon_extension` and `rotation_centre` are
    quantities of a response.

    centroid_height [m]; inertia [kg m2] about the centroid; anchor_height [m] of the tendon's
    anchor in the wall above its base, anchor_depth [m] of that in the foundation below it; the
    tendon is straight between them.

    The rotation centre passes the centreline with the wall upright, so that no velocity jumps
    there: without a law of impact no energy is lost.
    """

    model: ClassVar[str] = "controlled_wall"
    may_vanish = _ControlledWall.may_vanish | {"inertia", "anchor_depth"}
    centroid_height: float
    inertia: float
    anchor_height: float
    anchor_depth: float

    @classmethod
    def from_wall(cls, wall: TendonedWall, anchor_distance: float = 3.1) -> ControlledWall:
        """The wall of `rockeom.analysis`; anchor_distance of the tendon's anchors [m].

        The lower anchor is put at the base. The inertia about the centroid is that of 4-19 when
        the wall turns about its centreline.
        """
        shared = cls._of_wall(wall)
        about_base = float(wall.moment_of_inertia(wall.half_width))
        return cls(
            **shared,
            centroid_height=wall.centroid_height,
            inertia=about_base - wall.mass * wall.centroid_height**2,
            anchor_height=anchor_distance,
            anchor_depth=0.0,
        )

    @classmethod
    def thesis(cls, initial_force: float = 75.6e3) -> ControlledWall:
        """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N]."""
        from rockeom.analysis import Wall

        return cls.from_wall(Wall.thesis(initial_force))


@_structure_class
class FlexibleControlledWall(_ControlledWall):
    """The wall of `ControlledWall` that bends on its base while it rocks (thesis 4.7).

    All that is above the base line turns with the base through theta and moves across the wall's
    axis by u [m], against the stiffness k [N/m] and the damping [N s/m]: on a base that cannot turn
    its period is 2 pi sqrt(mass/k). The displacement of a response and the load of a pushover are
    those of the point at height H of the bent wall. The rotation centre and the tendon follow the
    rotation of the base, Delta = H sin(theta): the anchor in the wall lies on the axis of the wall
    unbent. At 30 mm of the thesis's wall that leaves out 0.1 % of the force that bends it.

    A wall that turns about its centreline resists no small rotation. It then vibrates as one on a
    hinge, (1 + m H_c**2/I)**(1/2) times as fast as on a base that cannot turn. No velocity jumps
    where it comes upright. Else as ControlledWall.
    """

    model: ClassVar[str] = "flexible_controlled_wall"
    may_vanish = _ControlledWall.may_vanish | {"anchor_depth", "damping"}
    centroid_height: float
    inertia: float
    anchor_height: float
    anchor_depth: float
    stiffness: float
    damping: float

    @classmethod
    def from_wall(
        cls,
        wall: TendonedWall,
        fixed_base_period: float | None = None,
        damping_ratio: float = 0.0,
        anchor_distance: float = 3.1,
    ) -> FlexibleControlledWall:
        """The wall of `rockeom.analysis`; fixed_base_period [s] is its own if not given.

        damping_ratio : of critical damping, on a fixed base. anchor_distance [m] and the inertia as
        in `ControlledWall`.
        """
        rigid = ControlledWall.from_wall(wall, anchor_distance)
        period = wall.fixed_base_period if fixed_base_period is None else fixed_base_period
        given = {"fixed_base_period": period, "damping_ratio": damping_ratio}
        check_values(cls.__name__, given, frozenset({"damping_ratio"}))
        frequency = 2 * math.pi / period
        return cls(
            **rigid.parameters(),
            stiffness=rigid.mass * frequency**2,
            damping=2 * damping_ratio * frequency * rigid.mass,
        )

    @classmethod
    def thesis(
        cls, initial_force: float = 75.6e3, damping_ratio: float = 0.0
    ) -> FlexibleControlledWall:
        """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N]."""
        from rockeom.analysis import Wall

        return cls.from_wall(Wall.thesis(initial_force), damping_ratio=damping_ratio)

    def fixed_base(self) -> FixedBase:
        """The wall on a base that cannot turn: its mass at centroid_height on the elastic column.

        The tendon then keeps its force, which bends nothing; the forces on the feet are those of
        weight and shaking alone.
        """
        return FlexibleStructure(
            mass=self.mass,
            height=self.centroid_height,
            inertia=self.inertia,
            base_mass=0.0,
            base_height=0.0,
            base_inertia=0.0,
            half_width=self.half_width,
            gravity=self.gravity,
            stiffness=self.stiffness,
            damping=self.damping,
        ).fixed_base()

    def _load(self, contact: int, y: np.ndarray) -> float:
        """As for the rigid wall; u of the state is put to its own equilibrium."""
        u = self.states.index("u")
        last = math.inf
        for _ in range(50):  # each time the error falls by about m g/(k H)
            load = super()._load(contact, y)
            change = self._lacking(contact, y, load)[u] / self.stiffness
            y[u] -= change
            if abs(change) <= 1e-14 * abs(y[u]):
                return load
            if abs(change) > last:  # where it does not fall, there is one kilometres away
                break
            last = abs(change)
        raise ValueError(
            f"no equilibrium of {self.model} at rotation {y[self.module.ROTATION]}: its stiffness, "
            f"{self.stiffness}, hardly holds its weight upright"
        )


@_structure_class
class SubstituteGravityWall(_ControlledWall):
    """The wall as Housner's block, its tendon's force a weight (thesis 4-37, 4-40).

    centroid_height [m]; pivot_inertia I_o [kg m2] about the rotation centre, taken as constant.
    The moments are about B (1 - exp(-(Delta/epsilon)**2)) from the centreline (4-37); the extension
    of the tendon is that of b (4-16). The work of its weight is no stored energy, and
    `elastic_energy` is zero. Else as ControlledWall.
    """

    model: ClassVar[str] = "substitute_gravity_wall"
    centroid_height: float
    pivot_inertia: float

    @classmethod
    def from_wall(cls, wall: TendonedWall) -> Self:
        """The wall of `rockeom.analysis`, its inertia that about a corner."""
        return cls(
            **cls._of_wall(wall),
            centroid_height=wall.centroid_height,
            pivot_inertia=wall.corner_inertia,
        )

    @classmethod
    def thesis(cls, initial_force: float = 75.6e3) -> Self:
        """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N]."""
        from rockeom.analysis import Wall

        return cls.from_wall(Wall.thesis(initial_force))


@_structure_class
class SimplifiedSubstituteGravityWall(SubstituteGravityWall):
    """A `SubstituteGravityWall` whose moments are about the edges of the base (thesis 4-32).

    Only the tendon's extension knows of the rotation centre that moves (4-16). The wall lifts off
    when the ground acceleration exceeds (m g + P) B/(m H_c).
    """

    model: ClassVar[str] = "simplified_substitute_gravity_wall"


@_structure_class
class ControlledWallOscillator(_ControlledWall):
    """The wall as an elastic oscillator whose losses are a force (thesis 4-27 to 4-31, 4-39).

    regularisation n [m], the width in Delta of a passage; energy_ratio r, that of the kinetic
    energies after and before a passage: a number, or an `EnergyRatioAtSpeed`. held : whether its
    speed is, for a whole passage, that with which the wall would come upright without losses from
    where it turned back; else it is the speed of the instant, and r changes within a passage.
    effective_mass M_e [kg], `mass` if not given; the 6 % by which 4.8.1 raises F_k are those of
    effective_mass = mass/1.06. The energies are those of 4-18 and 4-20, without P-delta. Else as
    ControlledWall.

    The state `u` is Delta [m]; there are no jumps of the velocity and `impacts` is empty. The
    elastic energy holds that of gravity. Tolerances must be below n.
    """

    model: ClassVar[str] = "controlled_wall_oscillator"
    not_numbers = frozenset({"energy_ratio", "held"})
    regularisation: float
    energy_ratio: float | EnergyRatioAtSpeed
    held: bool = True
    effective_mass: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.held, bool | np.bool_):
            raise TypeError(
                f"ControlledWallOscillator: held is {told(self.held)}: give True or False"
            )
        if not isinstance(self.energy_ratio, EnergyRatioAtSpeed):
            if not 0 < number(f"{type(self).__name__}: energy_ratio", self.energy_ratio) <= 1:
                raise ValueError(
                    f"ControlledWallOscillator: energy_ratio is {self.energy_ratio}: it must lie "
                    "between 0 and 1"
                )
        elif len(self.energy_ratio.pieces) > 4:
            raise ValueError(
                f"ControlledWallOscillator: energy_ratio has {len(self.energy_ratio.pieces)} "
                "pieces: at most 4"
            )

    @classmethod
    def from_wall(
        cls,
        wall: TendonedWall,
        energy_ratio: float | EnergyRatioAtSpeed,
        held: bool = True,
        regularisation: float | None = None,
        effective_mass: float | None = None,
    ) -> ControlledWallOscillator:
        """The wall of `rockeom.analysis`; regularisation is its epsilon if not given, as in 4.8."""
        return cls(
            **cls._of_wall(wall),
            regularisation=regularisation or wall.rotation_centre.epsilon,
            energy_ratio=energy_ratio,
            held=held,
            effective_mass=effective_mass,
        )

    @classmethod
    def thesis(
        cls,
        energy_ratio: float | EnergyRatioAtSpeed,
        initial_force: float = 75.6e3,
        held: bool = True,
    ) -> ControlledWallOscillator:
        """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N]."""
        from rockeom.analysis import Wall

        return cls.from_wall(Wall.thesis(initial_force), energy_ratio, held)

    @property
    def jumps_between_events(self) -> bool:
        """Where the ratio follows the speed of the instant, in pieces that need not meet."""
        law = self.energy_ratio
        return not self.held and isinstance(law, EnergyRatioAtSpeed) and len(law.pieces) > 1

    def parameters(self) -> dict[str, float]:
        values = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        law = values.pop("energy_ratio")
        pieces = law.pieces if isinstance(law, EnergyRatioAtSpeed) else ((math.inf, law, 0.0),)
        for i, (limit, r, slope) in enumerate((*pieces, *pieces[-1:] * (4 - len(pieces))), 1):
            values[f"energy_ratio_{i}" if i > 1 else "energy_ratio"] = r
            values[f"energy_ratio_slope_{i}"] = slope
            values[f"speed_limit_{i}"] = limit
        mass = values["effective_mass"]
        values["held"] = float(self.held)
        return values | {"effective_mass": self.mass if mass is None else mass}

    def _check_reach(self, y: np.ndarray) -> None:
        if not abs(y[0]) < self.height:
            raise ValueError(
                f"state u is {y[0]}, beyond the height of {self.height:.6g} m: u/height is the "
                "sine of the rotation"
            )

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """(N,) state vector; a passage_speed that is not given is that of the energy there is."""
        y = super().state(values)
        if "passage_speed" not in values:
            y = y.astype(np.result_type(y, self.vector))
            upright = np.zeros_like(y)
            upright[1] = y[1]
            m = self.module_for(y, self.vector)
            energy = np.empty((2, len(m.ENERGIES)), np.result_type(y, self.vector))
            for at, row in zip((y, upright), energy, strict=True):
                m.energies(self.contact(at), at, self.vector, row)
            kinetic = max(number("energy", energy[0].sum() - energy[1].sum()), 0.0)
            y[m.STATES.index("passage_speed")] = mathematics.sqrt(
                2 * kinetic / self.parameters()["effective_mass"]
            )
        return y


class DeclaredStructure(Structure):
    """A structure whose class is made of what its generated module says; see `class_of`.

    Its parameters, whatever they are called, are those of the model; none has a default but
    gravity. Those whose name is no other's are attributes.
    """

    module: ModuleType  # of the class
    slenderness = None  # a parameter `alpha` may be anything

    def __init__(self, /, *unnamed: Any, **given: Any) -> None:
        known = set(self.module.PARAMETERS)
        if unnamed:
            raise ParameterError(_unnamed(self.model, unnamed[0], known))
        defaults = {n: v for n, v in self.defaults().items() if v is not dataclasses.MISSING}
        check_names(self.model, known, known, set(defaults | given))
        values = {
            name: number(f"{self.model}: {name}", value, "give a number in SI units")
            for name, value in (defaults | given).items()
        }
        signs = dict(zip(self.module.PARAMETERS, self.module.PARAMETER_SIGNS, strict=True))
        signed = frozenset(name for name, sign in signs.items() if sign == "+-")
        # what products a declaration has is not known
        check_values(self.model, values, frozenset(known), signed, largest=math.inf)
        for name in (name for name, sign in signs.items() if sign == "n"):
            if directions(values[name]):
                raise TypeError(f"{self.model}: {name} is a dual: whole numbers have no derivative")
            if not (values[name] >= 1 and values[name] % 1 == 0):
                raise ValueError(
                    f"{self.model}: {name} is {values[name]:g}: give a whole number of at least 1"
                )
        self.values = {name: values[name] for name in self.module.PARAMETERS}
        self._check_sizes()

    def _check_sizes(self) -> None:
        """Raise ValueError where the parameters give a body or a base no size."""
        rows, parameters = self.module.SIZES, np.array(list(self.values.values()))
        found = np.empty(len(rows), parameters.dtype)
        self.module_for(parameters).sizes(parameters, found)
        for size, (what, may_vanish, names, remedy) in zip(found, rows, strict=True):
            if not (size > 0 or (size == 0 and may_vanish)):
                given = ", ".join(f"{name} = {self.values[name]}" for name in names)
                raise ValueError(f"{self.model}: {what} is {float(size):g} with {given}: {remedy}")

    @classmethod
    def defaults(cls) -> dict[str, Any]:
        return {
            name: STANDARD_GRAVITY if name == "gravity" else dataclasses.MISSING
            for name in vars(cls)["module"].PARAMETERS
        }

    def parameters(self) -> dict[str, float]:
        return dict(self.values)

    def __getattr__(self, name: str) -> Any:
        if name in (values := vars(self).get("values", {})):
            return values[name]
        return _missing(self, name)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{n}={v!r}' for n, v in self.values.items())})"

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other)["values"] == self.values

    def __hash__(self) -> int:
        return hash((type(self), *self.values.values()))


@functools.cache
def class_of(module: ModuleType) -> type[DeclaredStructure]:
    """The class of the structures of a generated module."""
    rows = zip(module.PARAMETERS, module.PARAMETER_UNITS, module.PARAMETER_MEANINGS, strict=True)
    title = (module.__doc__ or "").partition("\n")[0]
    told = "\n".join(f"{name} : {meaning} [{unit}]" for name, unit, meaning in rows)
    return type(
        module.CLASS,
        (DeclaredStructure,),
        {
            "__doc__": f"{title}\n\n{told}\n",
            "__module__": __name__,
            "model": module.NAME,
            "module": module,
        },
    )


class _Shipped(Mapping[str, type[Structure]]):
    """Classes of the shipped structures by the name of the model, in the order of lists.

    One that is written here is that; of all others the class is made of the generated module.
    """

    def __getitem__(self, model: str) -> type[Structure]:
        if model not in _classes():
            raise KeyError(model)
        if model in _WRITTEN:
            return _WRITTEN[model]
        return class_of(importlib.import_module(f"rockeom.generated.{model}"))

    def __iter__(self) -> Iterator[str]:
        return iter(_classes())

    def __len__(self) -> int:
        return len(_classes())


def _classes() -> dict[str, str]:
    """Names of the classes of the shipped structures, by the name of the model."""
    return importlib.import_module("rockeom.generated.shipped_structures").SHIPPED


SHIPPED: Mapping[str, type[Structure]] = _Shipped()


def __getattr__(name: str) -> Any:
    """The class of a shipped structure that is not written here."""
    if name[:1].isupper():
        for model, of_model in _classes().items():
            if name == of_model:
                return SHIPPED[model]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
