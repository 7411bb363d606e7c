"""A structure: physical parameters bound to a generated module, and what follows from both."""

from __future__ import annotations

import dataclasses
import functools
import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, cast

import numpy as np

from rockeom.codes import IMPACT
from rockeom.integrator.schema import (
    GeneratedModule,
    has_landings,
    in_space,
    is_by_code,
    name_of_law,
)
from rockeom.integrator.transitions.restitution import velocity_ratio_at
from rockeom.motion.slope import slope_angle
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, array_of, near, number
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import for_arrays, isfinite
from rockeom.numbers.pictures import picture
from rockeom.structures import declared_modes, evaluation, linearised, modal, plausible, statics
from rockeom.structures.impact_laws import ImpactLaw, TabulatedLaw, check_law, default_law
from rockeom.structures.modes import modes_of
from rockeom.structures.parameters import OF_DERIVATION, SYNONYMS, named_states
from rockeom.structures.pickled import made_of
from rockeom.structures.positions import (
    Shapes,
    Solid,
    barriers,
    has_barrier,
    places,
    positions_of,
    rotations_of,
    shapes,
)
from rockeom.structures.slope import OnSlope, on_slope
from rockeom.structures.units import ground_accelerations


def generated_module(name: str) -> GeneratedModule:
    """The module that was generated for a shipped structure."""
    return cast(GeneratedModule, importlib.import_module(f"rockeom.generated.{name}"))


class Structure(metaclass=explained.Constructors):
    """Rocking structure with its parameters.

    Methods take a state as a mapping of state names to values; states that are not named are zero.
    An angle may be named in degrees: ``{"theta_degrees": 5}``. The mode follows from the state, or
    is named by `mode`.
    """

    model: ClassVar[str] = ""
    of_each: ClassVar[Mapping[str, str]] = {}
    """Parameters that are lists, and what the generated module calls one of them, numbered."""
    pulled: ClassVar[str] = "it would have jumped"
    """The meaning of a force by which the ground would have to pull a foot, in words."""

    __getstate__ = made_of

    # -- given by a subclass --------------------------------------------------------------

    def parameters(self) -> dict[str, float]:
        """Parameters of the model, by name, in SI units.

        Returns
        -------
        dict of str to float
            Values by name.
        """
        raise NotImplementedError

    @classmethod
    def defaults(cls) -> dict[str, Any]:
        """Names of the arguments of the class, each with its default.

        Returns
        -------
        dict of str to object
            Defaults by name; ``dataclasses.MISSING`` for none.
        """
        return {f.name: f.default for f in dataclasses.fields(cls)}  # type: ignore[arg-type]

    @property
    def derivation(self) -> dict[str, Any]:
        """Arguments of `rockeom.derive` besides the name of the model, such as its storeys."""
        return {}

    def parameter_at(self, path: tuple[Any, ...]) -> str:
        """Parameter of the equations that a number of the structure is.

        Parameters
        ----------
        path : tuple
            Name of an attribute; behind it the place in a list, or an attribute of that.

        Returns
        -------
        str
            Name of the parameter; "" where none is.
        """
        (name, *inside) = path
        if inside:
            return f"{self.of_each[name]}_{inside[0] + 1}" if name in self.of_each else ""
        return name if name in self.module.PARAMETERS else ""

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module."""
        return generated_module(self.model)

    def _repr_html_(self) -> str:
        return picture("page_of_structure", self)

    if not TYPE_CHECKING:  # for type checkers an unknown attribute stays an error

        def __getattr__(self, name: str) -> Any:
            return missing(self, name)

    # -- for all structures ------------------------------------------------------------------------

    @functools.cached_property
    def vector(self) -> np.ndarray:
        """The parameters, and the constants prepared of them: p of compiled functions."""
        values = self.parameters()
        parameters = np.array([number(n, values[n]) for n in self.module.PARAMETERS])
        return self.module_for(parameters).prepare(parameters)

    def module_for(self, *arrays: np.ndarray) -> Any:
        """Generated module, for compounds where arrays hold such.

        Parameters
        ----------
        *arrays : ndarray
            Arrays of numbers, or of compounds such as duals.

        Returns
        -------
        module
            Generated module.
        """
        return for_arrays(self.module, *arrays)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states: the coordinates, then their rates."""
        return self.module.STATES

    @property
    def jumps_between_events(self) -> bool:
        """Whether a force may jump at a place where no mode ends."""
        return False

    @functools.cached_property
    def rocks_on_rigid_ground(self) -> bool:
        """Whether the edges of the base are pivots, and full contact is a mode of its own."""
        return declared_modes.rocks_on_rigid_ground(self.module)

    @property
    def unrestrained(self) -> Structure | None:
        """The structure without what holds it, on feet that neither slide nor bounce.

        Its statics are those of a structure of which something else may break, slip or move. None
        for a structure whose own statics are known, and where there is no such structure.
        """
        return None

    @functools.cached_property
    def has_impacts(self) -> bool:
        """Whether an impact ends any mode."""
        m = self.module
        if is_by_code(m):  # eight to the power of its points are too many to look at: points land
            return False
        return any(IMPACT in kinds[:n] for kinds, n in zip(m.KINDS, m.GUARDS, strict=True))

    @functools.cached_property
    def has_landings(self) -> bool:
        """Whether points land, each by its own impact law, and may slide."""
        return has_landings(self.module)

    @property
    def has_overturning_angles(self) -> bool:
        """Whether it has `overturning_angles`: it rocks, and its contacts do nothing else."""
        return not self.has_landings

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
        """Ratio of the angular velocities at an impact of the rigid structure, 5-14.

        NaN where each foot has its own, see `OffsetBlock`.
        """
        return number("velocity_ratio", self.module_for(self.vector).velocity_ratio(self.vector))

    @functools.cached_property
    def fastest_damping(self) -> float:
        """Rate that no decay of small motion exceeds where springs push back [1/s].

        It costs less than `small_motion`: small where little is damped.
        """
        return linearised.fastest_damping(self.module, self.vector, self.parameters())

    @functools.cached_property
    def small_motion(self) -> tuple[float, float]:
        """Fastest rates (motion, decay) of small motion at rest in any mode [1/s].

        Eigenvalues of the linearised equations: decay is the largest of those that die out within a
        radian, motion the largest of the others, which vibrate or grow.
        """
        return linearised.fastest_rates(self.module, self.vector)

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """State vector of named values.

        Parameters
        ----------
        values : dict of str to float
            Values of states by name; others are zero.

        Returns
        -------
        ndarray
            State (N,).

        Raises
        ------
        ValueError
            For unknown names or NaN.
        TypeError
            For anything but a mapping to numbers.
        """
        values = named_states("state", values, self.module)
        unknown = [n for n in values if n not in self.states]
        known = [*self.states, *(f"{n}_degrees" for n in self.states)]
        if unknown:
            raise InputError("state", unknown).says(
                f"unknown state {', '.join(f'{n!r}{near(n, known)}' for n in unknown)}: "
                f"{self.model} has {', '.join(self.states)}"
            )
        y = [number(name, values.get(name, 0.0), "state") for name in self.states]
        for name, value in zip(self.states, y, strict=True):
            if not isfinite(value):
                raise InputError(name, value, "state").give("a finite number")
        return modes_of(self.module).completed(self.module, np.array(y), self.vector, values)

    def started(self, y0: np.ndarray, named: Mapping[str, Any], ground: Any) -> np.ndarray:
        """State with which a motion starts: what is not named may follow from the ground's motion.

        Parameters
        ----------
        y0 : ndarray
            State (N,) of the values named.
        named : dict of str to float
            Those values.
        ground : Ground
            Motions of the ground.

        Returns
        -------
        ndarray
            State (N,).
        """
        return y0

    def mode_number(
        self, y: np.ndarray, mode: str | None = None, towards: Callable[[], float] = float
    ) -> int:
        """Number of the mode of a state vector, or of the mode named.

        Parameters
        ----------
        y : ndarray
            State (N,).
        mode : str, optional
            Name of the mode; by default it follows from the state.
        towards : callable, optional
            Function that gives the sign of the rotation to come where the state is upright and at
            rest.

        Returns
        -------
        int
            Number of the mode.

        Raises
        ------
        ValueError
            For a state that fits no mode, or not the mode named.
        """
        m, y = self.module, value_of(y)  # which mode it is has no derivative
        if mode is not None:
            return modes_of(m).named_mode(m, mode, y, self.vector)
        return modes_of(m).mode_of(m, y, self.vector, towards)

    def _shaking(self, along: Any, across: Any, up: Any) -> tuple[Any, ...]:
        """Accelerations of the ground in the order of the module's arguments."""
        if in_space(self.module):
            return along, 0.0 if across is None else across, up
        if across is not None:
            raise InputError("transverse_ground_acceleration", across, self.module.NAME).says(
                f"{self.module.NAME} moves in one plane, and takes no transverse acceleration"
            )
        return along, up

    def _under(self, ground: tuple[float, ...], y: np.ndarray, mode: str | None) -> int:
        """Number of the mode; where contacts may slide and open, forces decide, too."""
        m, number = self.module, self.mode_number(y, mode)
        if mode is not None:
            return number
        return modes_of(m).mode_under_forces(m, number, y, self.vector, ground)

    def accelerations(
        self,
        state: Mapping[str, Any],
        ground_acceleration: Any = 0.0,
        vertical_ground_acceleration: Any = 0.0,
        mode: str | None = None,
        transverse_ground_acceleration: Any = None,
    ) -> dict[str, Any]:
        """Accelerations of the coordinates.

        A state may hold arrays, as the accelerations of the ground, of one shape or for NumPy to
        make of one.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        ground_acceleration : float or ndarray, optional
            Horizontal acceleration of the ground [m/s2].
        vertical_ground_acceleration : float or ndarray, optional
            Vertical acceleration of the ground, upwards [m/s2].
        mode : str, optional
            Name of the mode; by default it follows from the state. Where contacts may slide and
            open it is then the one that the forces lead to: a block at rest slides under an
            acceleration that its friction cannot hold.
        transverse_ground_acceleration : float or ndarray, optional
            Second horizontal acceleration of the ground, of a structure in space [m/s2].

        Returns
        -------
        dict of str to float or ndarray
            Accelerations by the name of the coordinate [unit of the coordinate per s2], in the
            shape of the arrays.

        Raises
        ------
        ValueError
            Where the forces fit no mode, or several (Painleve), and for unknown states.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> block.accelerations({"theta": 0.05}, ground_acceleration=2.0)["theta"]  # rad/s2
        -7.0264...
        """
        shaking = ground_acceleration, transverse_ground_acceleration, vertical_ground_acceleration
        at = self._at(state, mode, *shaking)
        m, p = self.module, self.vector
        rates = evaluation.filled(m, p, "rates", m.N_STATES, at.modes, at.y, *at.ground)
        n = len(self.states) // 2
        return at.shaped(dict(zip(self.states[:n], rates[n:], strict=True)))

    def absolute_accelerations(
        self,
        state: Mapping[str, Any],
        ground_acceleration: Any = 0.0,
        vertical_ground_acceleration: Any = 0.0,
        mode: str | None = None,
        transverse_ground_acceleration: Any = None,
    ) -> dict[str, np.ndarray]:
        """Accelerations of the places of `positions`, with the ground's.

        Those of a motion are in ``run.places``.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        ground_acceleration : float or ndarray, optional
            Horizontal acceleration of the ground [m/s2].
        vertical_ground_acceleration : float or ndarray, optional
            Vertical acceleration of the ground, upwards [m/s2].
        mode : str, optional
            Name of the mode, as for `accelerations`.
        transverse_ground_acceleration : float or ndarray, optional
            Second horizontal acceleration of the ground, of a structure in space [m/s2].

        Returns
        -------
        dict of str to ndarray
            Accelerations (..., 2) to the right and up by name, in space (..., 3) [m/s2].

        Raises
        ------
        ValueError
            As `accelerations`.
        """
        shaking = ground_acceleration, transverse_ground_acceleration, vertical_ground_acceleration
        at = self._at(state, mode, *shaking)
        values = evaluation.accelerations(self.module, self.vector, at.modes, at.y, *at.ground)
        return {name: of.reshape(*at.shape, of.shape[-1]) for name, of in values.items()}

    def velocities(
        self, state: Mapping[str, Any], mode: str | None = None
    ) -> dict[str, np.ndarray]:
        """Velocities of the places of `positions`, relative to the ground.

        Those of a motion are in ``run.places``.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        mode : str, optional
            Name of the mode; by default it follows from the state.

        Returns
        -------
        dict of str to ndarray
            Velocities (..., 2) to the right and up by name, in space (..., 3) [m/s].

        Raises
        ------
        ValueError
            For unknown states.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> block.velocities({"theta": 0.1, "theta_dot": 0.5})["block"].round(3)  # m/s
        array([0.204, 0.03 ])
        """
        at = self._at(state, mode)
        values = evaluation.velocities(self.module, self.vector, at.modes, at.y)
        return {name: of.reshape(*at.shape, of.shape[-1]) for name, of in values.items()}

    def after_impact(
        self,
        state: Mapping[str, float],
        mode: str,
        impact: ImpactLaw | None = None,
        impact_number: int = 0,
    ) -> tuple[dict[str, float], str]:
        """State after the impact that ends a mode, and the mode that follows.

        Parameters
        ----------
        state : dict of str to float
            Values of states before the impact by name; others are zero.
        mode : str
            Name of the mode before the impact.
        impact : ImpactLaw, optional
            Impact law; `default_impact` if not given.
        impact_number : int, optional
            Number of the impact in its motion, from 0 on, for an impact law that draws.

        Returns
        -------
        after : dict of str to float
            States after the impact by name.
        mode : str
            Name of the mode that follows.

        Raises
        ------
        ValueError
            Where the model has no impact in that mode.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> law = rk.VelocityRatio(0.9)
        >>> after, mode = block.after_impact({"theta_dot": -0.5}, mode="right", impact=law)  # rad/s
        >>> after["theta_dot"], mode
        (-0.45, 'left')
        """
        m, p = self.module, self.vector
        if self.has_landings:
            raise InputError("impact").says(
                f"{self.model} has an impact law for each of its points: simulate it, its events "
                "hold the states before and after each landing"
            )
        y = self.state(state)
        number = self.mode_number(y, mode)
        if m.KINDS[number][0] != IMPACT or m.GUARDS[number] == 0:
            raise InputError("mode", mode).says(f"no impact ends the mode {mode!r} of {self.model}")
        law, ratio = self.law(impact)
        table = np.array(self.impact_table(impact), float)
        ratio = velocity_ratio_at(law, ratio, impact_number, float(y[m.ROTATION_RATE]), table)
        out = np.empty_like(y)
        follows = m.jump(number, 0, law, ratio, y, p, out)
        return dict(zip(self.states, out.tolist(), strict=True)), m.MODES[follows]

    def law(self, impact: ImpactLaw | None) -> tuple[int, float]:
        """Impact law for the compiled functions.

        Parameters
        ----------
        impact : ImpactLaw
            Impact law; None is `default_impact`.

        Returns
        -------
        code : int
            Code of the law.
        ratio : float
            Ratio of the angular velocities after and before an impact.

        Raises
        ------
        ValueError
            Where a law is given to a model without impacts.
        TypeError
            For anything but an impact law.
        """
        m = self.module
        if not self.has_impacts:
            if impact is not None and is_by_code(m) and hasattr(self, "restitution"):
                raise InputError("impact", impact).says(
                    f"{self.model} has a restitution for its points: leave {{impact}} out",
                    f"and give restitution= to {type(self).__name__}",
                )
            if impact is not None and self.has_landings:
                raise InputError("impact", impact).says(
                    f"{self.model} has an impact law for its points, as it is declared: leave "
                    "{impact} out",
                    "and give law= to the support, rk.Sliding(..., law='lzb'), or to the "
                    "contacts, Rigid(..., law='lzb')",
                )
            if impact is not None:
                raise InputError("impact", impact).says(
                    f"{self.model} has no impacts, forces take their place: leave {{impact}} out"
                )
            return 0, 1.0
        chosen = default_law(m) if impact is None else impact
        check_law(chosen)
        if isinstance(chosen, TabulatedLaw) and not isfinite(self.velocity_ratio):
            raise InputError("impact", chosen, self.model).wrong(
                "is a ratio of kinetic energies; its feet are not equally far from the centroid, "
                "so that it gives different ratios of angular velocities at each: give a ratio of "
                "velocities, or leave {impact} out"
            )
        return chosen.resolve(self.velocity_ratio, m.HAS_IMPULSIVE, self.model)

    @property
    def default_impact(self) -> ImpactLaw | None:
        """Impact law where none is named; None for a structure that takes no impact law.

        `Impulsive` where something besides the rotation moves at an impact, such as a column that
        bends, and the masses determine the impulses; `AngularMomentum` otherwise.
        """
        return default_law(self.module) if self.has_impacts else None

    def describe_impact(self, impact: ImpactLaw | None) -> str:
        """Impact law in words, and whether it is the default.

        Parameters
        ----------
        impact : ImpactLaw
            Impact law; None is `default_impact`.

        Returns
        -------
        str
            Text; empty where none applies. That of contacts is their law's name, see
            `rockeom.symbolic.Rigid`; empty for Newton's.
        """
        if not self.has_impacts:
            return name_of_law(self.module)
        return repr(impact) if impact is not None else f"{self.default_impact!r}, by default"

    @property
    def speed_height(self) -> float | None:
        """Height of the point whose speed an impact law means [m]; None if there is none."""
        return None

    def impact_table(self, impact: ImpactLaw | None) -> list[float]:
        """Table of an impact law, which the compiled loop reads behind the parameters.

        Parameters
        ----------
        impact : ImpactLaw
            Impact law; None is `default_impact`.

        Returns
        -------
        list of float
            Numbers of the table.
        """
        if isinstance(impact, TabulatedLaw) and impact.table_needed and self.has_impacts:
            return impact.table(self).numbers()
        return []

    @property
    def rocking_inertia(self) -> float:
        """Moment of inertia of the structure that rocks at an impact [kg m2].

        Twice the kinetic energy upright on one foot, turning by 1 rad/s, the other rates zero.
        Raises TypeError for a structure whose rotation is no angle in time.
        """
        m, p = self.module_for(self.vector), self.vector
        if m.STATE_UNITS[m.ROTATION_RATE] != "rad/s":
            raise InputTypeError("impact").says(
                f"the rate of {self.model} is in {m.STATE_UNITS[m.ROTATION_RATE]}: a loss of "
                "energy in joules says nothing of it; give an energy ratio"
            )
        y = np.zeros(len(m.STATES), p.dtype)
        y[m.ROTATION_RATE] = 1.0
        out = np.zeros(len(m.ENERGIES), p.dtype)
        m.energies(next(c for c, side in enumerate(m.SIDES) if side > 0), y, p, out)
        return 2.0 * out[m.ENERGIES.index("kinetic_energy")]

    def energies(self, state: Mapping[str, Any], mode: str | None = None) -> dict[str, Any]:
        """Kinetic, gravitational and elastic energy; heights count from the ground.

        A state may hold arrays, of one shape or for NumPy to make of one; so has the result.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        mode : str, optional
            Name of the mode; by default it follows from the state.

        Returns
        -------
        dict of str to float or ndarray
            "kinetic_energy", "gravitational_energy" and "elastic_energy" [J].

        Raises
        ------
        ValueError
            For unknown states.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
        >>> energies = block.energies({"theta": 0.05, "theta_dot": 0.2})  # rad, rad/s
        >>> round(energies["kinetic_energy"], 3)  # J
        1.36
        """
        at = self._at(state, mode)
        return at.shaped(self._values("energies", at))

    def reactions(
        self,
        state: Mapping[str, Any],
        ground_acceleration: Any = 0.0,
        vertical_ground_acceleration: Any = 0.0,
        mode: str | None = None,
        transverse_ground_acceleration: Any = None,
    ) -> dict[str, Any]:
        """Horizontal force, and vertical force at each foot, of the ground on the structure.

        In full contact the horizontal force is the sum over both feet.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        ground_acceleration : float or ndarray, optional
            Horizontal acceleration of the ground [m/s2].
        vertical_ground_acceleration : float or ndarray, optional
            Vertical acceleration of the ground, upwards [m/s2].
        mode : str, optional
            Name of the mode, as for `accelerations`.
        transverse_ground_acceleration : float or ndarray, optional
            Second horizontal acceleration of the ground, of a structure in space [m/s2].

        Returns
        -------
        dict of str to float or ndarray
            Forces by name [N].

        Raises
        ------
        ValueError
            As `accelerations`.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
        >>> forces = block.reactions({"theta": 0.05}, ground_acceleration=2.0)  # N
        >>> forces["left_reaction"]
        0.0
        """
        shaking = ground_acceleration, transverse_ground_acceleration, vertical_ground_acceleration
        at = self._at(state, mode, *shaking)
        return at.shaped(self._values("reactions", at))

    def elements(self, state: Mapping[str, Any], mode: str | None = None) -> dict[str, Any]:
        """Deformation, force and stored energy of each spring, damper and tendon.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        mode : str, optional
            Name of the mode; by default it follows from the state.

        Returns
        -------
        dict of str to float or ndarray
            Deformations [m], forces [N] and energies [J] by name, such as "storey_1_force". The
            deformation of an element that is pressed or shortened is positive where it was declared
            so.

        Raises
        ------
        ValueError
            For unknown states.
        """
        at = self._at(state, mode)
        return at.shaped(evaluation.elements(self.module, self.vector, at.modes, at.y))

    def positions(self, state: Mapping[str, Any], mode: str | None = None) -> dict[str, np.ndarray]:
        """Places of bodies, feet and the load point.

        Those of a motion are in ``run.places``. A state may hold arrays, of one shape or for NumPy
        to make of one.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        mode : str, optional
            Name of the mode; by default it follows from the state.

        Returns
        -------
        dict of str to ndarray
            Places (..., 2) by name [m]: x to the right and y upwards, in space (..., 3), z
            upwards, in axes that move with the ground, from the origin of the declaration: the
            middle between the feet at rest, for shipped structures.

        Raises
        ------
        ValueError
            For unknown states.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> block.positions({"theta": 0.1})["block"].round(3)  # m
        array([0.04 , 0.408])
        """
        return positions_of(self.module, self._places(state, mode))

    def rotations(self, state: Mapping[str, Any], mode: str | None = None) -> dict[str, np.ndarray]:
        """Angles through which the bodies have turned.

        Parameters
        ----------
        state : dict of str to float or ndarray
            Values of states by name; others are zero.
        mode : str, optional
            Name of the mode; by default it follows from the state.

        Returns
        -------
        dict of str to ndarray
            Angles (...) by name, clockwise [rad]; in space matrices (..., 3, 3), from axes of the
            body to those of the ground.

        Raises
        ------
        ValueError
            For unknown states.
        """
        return rotations_of(self.module, self._places(state, mode))

    def _places(self, state: Mapping[str, Any], mode: str | None) -> np.ndarray:
        """(..., m, k) for a state, or many."""
        at = self._at(state, mode)
        of_states = places(self.module, at.modes, at.y, self.vector)
        return of_states.reshape(*at.shape, *of_states.shape[1:])

    def _values(self, function: str, at: _States) -> dict[str, np.ndarray]:
        return evaluation.at_states(self.module, self.vector, function, at.modes, at.y, *at.ground)

    def _at(self, state: Mapping[str, Any], mode: str | None, *shaking: Any) -> _States:
        """A state, or many; where the ground's accelerations are given forces decide as well.

        shaking : the accelerations along, across and up, or none.
        """
        ground = self._shaking(*shaking) if shaking else ()
        state = named_states("state", state, self.module)
        names = ground_accelerations(self.module)
        shaken = [
            number(n, x) if np.ndim(x) == 0 else array_of(n, x)
            for n, x in zip(names, ground, strict=False)
        ]
        columns = np.broadcast_arrays(0.0, *state.values(), *shaken)[1:]
        shape = columns[0].shape if columns else ()
        rows = [*zip(*(column.ravel().tolist() for column in columns), strict=True)] or [()]
        y = np.array([self.state(dict(zip(state, row, strict=False))) for row in rows])
        shakes = [row[len(state) :] for row in rows]
        modes = [
            self._under(shake, one, mode) if ground else self.mode_number(one, mode)
            for one, shake in zip(y, shakes, strict=True)
        ]
        across = np.array(shakes, dtype=float).reshape(len(y), len(shaken)).T
        return _States(shape, y, np.array(modes), tuple(across))

    @functools.cached_property
    def shapes(self) -> Shapes:
        """Outlines of its bodies and what joins them, as they were declared, for a sketch."""
        return shapes(self.module, self.vector)

    @functools.cached_property
    def solids(self) -> Mapping[str, Solid]:
        """Surfaces of its bodies in space, by name, for pictures; bodies without one have legs."""
        return {}

    @property
    def uplift_acceleration(self) -> float | None:
        """Least horizontal ground acceleration, either way, at which a foot lifts [m/s2].

        The structure is in equilibrium under it: a column has bent under an acceleration that grew
        slowly, and may lift earlier when it vibrates. For a block it is g tan(alpha). inf if none
        lifts it; None unless the structure stands on rigid ground.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> round(block.uplift_acceleration, 4)  # m/s2, g tan(alpha)
        2.4525
        """
        return None if self.uplift_accelerations is None else min(self.uplift_accelerations)

    @functools.cached_property
    def uplift_accelerations(self) -> tuple[float, float] | None:
        """Sizes (left, right) of the ground accelerations at which it starts to lean there [m/s2].

        To the left it leans under an acceleration of the ground to the right, and the other way
        round. They differ where the centroid is off the middle; the lesser one is
        `uplift_acceleration`, which says more.
        """
        if not self.rocks_on_rigid_ground:
            return None
        return statics.uplift_accelerations(self.module, self.vector)

    @functools.cached_property
    def overturning_angles(self) -> tuple[float, float] | None:
        """Rotations (left, right) beyond which it does not come back by itself, in their unit.

        alpha of a block on both sides; of others the rotation at which the force of `pushover` has
        fallen to zero, inf where it has not up to `overturning_rotation`. None where contacts may
        open otherwise than by rocking, NaN where there is no equilibrium.
        """
        if not self.has_overturning_angles:
            return None
        left, right = (
            statics.overturning_angle(self.equilibrium, side * self.overturning_rotation)
            for side in (-1.0, 1.0)
        )
        return left, right

    def overturning_tilts(self, directions) -> np.ndarray:
        """Tilts beyond which a body on feet in space does not come back by itself.

        The barrier of its weight as it leans in a direction at rest: tan tilt = s/h, of the
        distance s in that direction and the depth h below the centroid of the foot above which the
        centroid is highest: the farthest one, where feet are level. Where they are not, it may come
        to rest between a lower barrier and this one. Feet above the centroid do not count.

        Parameters
        ----------
        directions : array_like
            Directions of the lean (n,) along the axes of the body, counter-clockwise from its x
            seen from above [rad].

        Returns
        -------
        ndarray
            Tilts (n,) [rad]. The least of all directions is over an edge: a body that leans over a
            corner below its barrier may fall over an edge next to it.

        Raises
        ------
        InputError
            For a structure that is not one body on three level feet, or more, in space.

        Examples
        --------
        >>> import rockeom as rk
        >>> statue = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)  # m, kg
        >>> statue.overturning_tilts([0.0, 0.9]).round(3)  # rad
        array([0.165, 0.279])
        """
        if not has_barrier(self):
            raise InputError("directions").says(
                f"{type(self).__name__} is not one body on level feet in space: "
                "overturning_angles has those of one in the plane"
            )
        return barriers(self, np.atleast_1d(array_of("directions", directions)))

    def on_slope(self, slope: float | str) -> OnSlope:
        """Statics of the structure on ground that slopes.

        Parameters
        ----------
        slope : float or str
            Slope, a number [rad] or a text such as "5 deg" or "1 in 20"; the ground falls to the
            right where it is positive.

        Returns
        -------
        OnSlope
            Accelerations that lift a foot and overturning angles, from the slope's normal.

        Raises
        ------
        ValueError
            For a slope that is none.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> on_slope = block.on_slope("5 deg")
        >>> left, right = on_slope.uplift_accelerations  # m/s2, uphill and downhill
        >>> round(left, 4), round(right, 4)
        (3.2982, 1.5882)
        >>> on_slope.stands
        True
        """
        return on_slope(self, number("slope", slope_angle(slope)))

    @property
    def slenderness(self) -> float | None:
        """Angle of the line from an edge to the centroid [rad]; None where the class has none."""
        return getattr(self, "alpha", None)

    def hints(self) -> tuple[str, ...]:
        """Questions about parameters that are allowed and hardly meant.

        Returns
        -------
        tuple of str
            A sentence each.
        """
        m, p = self.module, self.vector
        return plausible.parameters(m, p) if p.dtype == float else ()

    def fixed_base(self) -> FixedBase:
        """Same structure with feet that cannot lift, with its periods.

        It is simulated as any other, and has the same energies, forces and displacements.

        Returns
        -------
        FixedBase
            Structure on a fixed base.

        Raises
        ------
        ValueError
            For a structure without full contact on rigid ground, and for a rigid one, which has no
            degree of freedom left.

        Examples
        --------
        >>> import rockeom as rk
        >>> column = rk.FlexibleStructure(
        ...     mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.1,
        ...     base_inertia=1.37, half_width=0.285, stiffness=571.8e3, damping=502.4,
        ... )
        >>> column.fixed_base().periods  # s
        array([0.09200...])
        """
        return FixedBase(self)

    def equilibrium(self, rotation: float) -> tuple[float, np.ndarray]:
        """State at rest under the force at the load point that holds a rotation.

        Parameters
        ----------
        rotation : float
            Rotation [rad].

        Returns
        -------
        force : float
            Force at the load point [N].
        state : ndarray
            State (N,) in the order of `states`.

        Raises
        ------
        ValueError
            Where there is no equilibrium.
        """
        if in_space(self.module):
            raise InputError("structure", of=self.model).says(
                "it moves in space, and a pushover in the plane: simulate it"
            )
        return modes_of(self.module).equilibrium(self.module, self.vector, rotation)

    def pushover(self, rotations) -> np.ndarray:
        """Horizontal force at the load point that holds the structure at rotations.

        Parameters
        ----------
        rotations : array_like
            Rotations [rad], any shape; the other coordinates are in equilibrium.

        Returns
        -------
        ndarray
            Force [N], in the shape of the rotations. At zero rotation of a structure on rigid
            ground it is the force at which the structure lifts to the right.

        Raises
        ------
        ValueError
            Where there is no equilibrium.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
        >>> block.pushover([0.0, 0.1, 0.2]).round(0)  # N, at the centroid
        array([736., 430., 132.])
        """
        return statics.pushover(self.equilibrium, rotations)


def missing(structure: Structure, name: str) -> Any:
    """Raise AttributeError for an attribute that a structure lacks; see `explained.missing`."""
    return explained.missing(structure, name, lambda: _synonyms(structure))


def _synonyms(structure: Structure) -> dict[str, str]:
    """Synonyms that lead to an attribute of this structure."""
    attributes = {*dir(structure)}
    own = {name: meant for name, meant in SYNONYMS.items() if meant.split(" ")[-1] in attributes}
    return OF_DERIVATION | own


class _States(NamedTuple):
    """States y (n, N) that stand for arrays of a shape, their modes, and the ground's
    accelerations, (n,) each."""

    shape: tuple[int, ...]
    y: np.ndarray
    modes: np.ndarray
    ground: tuple[np.ndarray, ...]

    def shaped(self, values: Mapping[str, np.ndarray]) -> dict[str, Any]:
        """(n,) by name in the shape, numbers of a single state."""
        if not self.shape:
            return {name: float(value[0]) for name, value in values.items()}
        return {name: value.reshape(self.shape) for name, value in values.items()}


@dataclass(frozen=True)
class FixedBase(Structure):
    """Structure with feet that cannot lift; `Structure.fixed_base` makes it.

    Its forces on the feet may pull: ``run.extremes("left_reaction").minimum`` is the force by which
    the ground has to hold. There are no impacts, and no rotation.

    Parameters
    ----------
    rocking : Structure
        Structure that rocks.

    Raises
    ------
    ValueError
        For a structure without full contact on rigid ground, and for one that cannot move in it.
    """

    pulled: ClassVar[str] = "it has to be held down"
    rocking: Structure

    def __post_init__(self) -> None:
        if not self.rocking.rocks_on_rigid_ground:
            raise ValueError(
                f"{self.rocking.model} has no full contact on rigid ground, in which its feet "
                "could be held: take a FlexibleStructure, a FlexibleControlledWall or a structure "
                "of your own"
            )
        if not self._free.any():
            raise ValueError(
                f"{self.rocking.model} is rigid: it has no degree of freedom left once its feet "
                "are held; take a structure with an elastic column, such as FlexibleStructure"
            )

    @functools.cached_property
    def module(self) -> GeneratedModule:
        return modal.held(self.rocking.module)

    @property
    def model(self) -> str:  # type: ignore[override]
        return self.module.NAME

    def parameters(self) -> dict[str, float]:
        """Parameters of the structure that rocks.

        Returns
        -------
        dict of str to float
            Values by name.
        """
        return self.rocking.parameters()

    def parameter_at(self, path: tuple[Any, ...]) -> str:
        return self.rocking.parameter_at(path[1:])

    @property
    def has_impacts(self) -> bool:
        return False

    @property
    def uplift_accelerations(self) -> None:
        """None: nothing lifts it."""
        return None

    def hints(self) -> tuple[str, ...]:
        return self.rocking.hints()

    def fixed_base(self) -> FixedBase:
        """Structure itself.

        Returns
        -------
        FixedBase
            Structure itself.
        """
        return self

    def mode_number(
        self, y: np.ndarray, mode: str | None = None, towards: Callable[[], float] = float
    ) -> int:
        """Full contact; raises ValueError for a state that is turned, or for another mode."""
        m = self.module
        held = [m.STATES[i] for i in np.flatnonzero(~self._free) if y[i] != 0.0]
        if held:
            raise InputError(held[0], y[m.STATES.index(held[0])]).so("it is held at zero")
        if mode not in (None, modal.FULL_CONTACT):
            raise InputError("mode", mode, self.model).so("its feet stay on the ground")
        return m.MODES.index(modal.FULL_CONTACT)

    def law(self, impact: ImpactLaw | None) -> tuple[int, float]:
        """Raises ValueError for an impact law: there are no impacts."""
        if impact is not None:
            raise InputError("impact", impact, self.model).so("it has no impacts: leave it out")
        return 0, 1.0

    @property
    def has_overturning_angles(self) -> bool:
        return False

    def pushover(self, rotations) -> np.ndarray:
        """Refuse: the structure has no rotation by which it could be pushed.

        Parameters
        ----------
        rotations : array_like
            Rotations.

        Returns
        -------
        ndarray
            Nothing.

        Raises
        ------
        ValueError
            Always.
        """
        raise ValueError(f"{self.model} does not turn: ask the pushover of the one that rocks")

    @functools.cached_property
    def _free(self) -> np.ndarray:
        """(N,) whether a state may differ from zero in full contact."""
        return modal.free_states(self.rocking.module, self.rocking.vector)

    @functools.cached_property
    def _modal(self) -> modal.Modal:
        return modal.Modal(self.module, self.vector, self._free)

    @property
    def periods(self) -> np.ndarray:
        """(n,) periods of its undamped modes, of small motion about rest, longest first [s]."""
        return self._modal.periods

    @property
    def mode_shapes(self) -> dict[str, np.ndarray]:
        """Displacement of each coordinate in each undamped mode (n,), in the order of `periods`.

        The largest of a mode is 1. ``rockeom models NAME`` explains the coordinates: u_i of a frame
        is the displacement of floor i relative to the base.
        """
        return self._modal.shapes_by_name

    @property
    def effective_masses(self) -> np.ndarray:
        """Mass that the ground shakes in each mode (n,) [kg], in the order of `periods`.

        ``(phi' M r)**2/(phi' M phi)``, of a horizontal acceleration of the ground. Their sum is the
        mass of all that moves relative to a fixed base. Source: A. K. Chopra, Dynamics of
        Structures, section 13.2.
        """
        return self._modal.effective_masses

    @property
    def damping_ratios(self) -> np.ndarray:
        """(n,) parts of critical damping of the modes, in the order of `periods`."""
        return self._modal.damping_ratios
