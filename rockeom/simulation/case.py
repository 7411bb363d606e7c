"""One motion of one structure: the arguments of `simulate`, and the same as numbers."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, NamedTuple, Self

import numpy as np

from rockeom.codes import WITH_CONSTANT
from rockeom.integrator.schema import has_points, in_space
from rockeom.motion import GroundMotion
from rockeom.motion.recording import Recording
from rockeom.motion.segments import LINEAR, within
from rockeom.motion.slope import AXES, SLOPE, azimuth_angle, slope_angle
from rockeom.numbers import explained
from rockeom.numbers.batch import values
from rockeom.numbers.checks import InputError, InputTypeError, number, require, require_type
from rockeom.numbers.dual import directions, tangent_of, value_of
from rockeom.numbers.functions import isfinite
from rockeom.simulation.ground import COMPONENTS, Ground, ground_of
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.parameters import named_states
from rockeom.structures.searched_modes import check_bounds
from rockeom.structures.slope import standing_on


class Problem(NamedTuple):
    """A case as the compiled loop takes it.

    mode : number of the mode at the start; y0 (N,) the state there.
    vector : the parameters; table : additions of an impact law to them; law, ratio : of the
        impacts; fallen : overturning angle.
    horizontal, transverse, vertical : segments (m, 7) of the ground motions; end [s];
    quiet_from : time from which the ground stands still [s].
    """

    mode: int
    y0: np.ndarray
    vector: np.ndarray
    table: list[float]
    law: int
    ratio: float
    fallen: float
    horizontal: np.ndarray
    transverse: np.ndarray
    vertical: np.ndarray
    end: float
    quiet_from: float

    def p(self, width: int = 0) -> np.ndarray:
        """The parameters with the table behind them, which is read from its end; a new array.

        The loop moves parameters and puts them back, to learn the noise of a guard: motions that
        run at the same time must not share them.
        width : of the widest table of several cases, so that all have rows of one length.
        """
        if not (self.table or width):
            return self.vector.copy()
        return np.concatenate([self.vector, np.zeros(max(width - len(self.table), 0)), self.table])


class Problems(NamedTuple):
    """n cases as the compiled loop takes them, each an item of the first axis; see `Problem`.

    p (n, m) : the parameters, the table of an impact law behind them.
    horizontal, transverse, vertical (k, 7) : the tables of all, those of a case from h_rows[i, 0]
        to h_rows[i, 1], as t_rows and v_rows tell of the others.
    """

    mode: np.ndarray
    y0: np.ndarray
    p: np.ndarray
    law: np.ndarray
    ratio: np.ndarray
    fallen: np.ndarray
    horizontal: np.ndarray
    h_rows: np.ndarray
    transverse: np.ndarray
    t_rows: np.ndarray
    vertical: np.ndarray
    v_rows: np.ndarray
    end: np.ndarray
    quiet_from: np.ndarray

    @classmethod
    def of(cls, cases: list[Problem]) -> Self:
        """One case after the other."""
        widest = max(len(q.table) for q in cases)
        return cls(
            np.array([q.mode for q in cases]),
            np.array([q.y0 for q in cases]),
            np.array([q.p(widest) for q in cases]),
            np.array([q.law for q in cases]),
            np.array([q.ratio for q in cases]),
            np.array([q.fallen for q in cases]),
            *_stacked([q.horizontal for q in cases]),
            *_stacked([q.transverse for q in cases]),
            *_stacked([q.vertical for q in cases]),
            np.array([q.end for q in cases]),
            np.array([q.quiet_from for q in cases]),
        )

    @classmethod
    def of_many(cls, problem: Problem, n: int) -> Self:
        """n cases out of one problem whose numbers hold all of theirs."""

        def spread(x: Any) -> np.ndarray:
            return np.broadcast_to(values(x), n).copy()

        def columns(x: np.ndarray) -> np.ndarray:
            stacked = np.empty((n, *x.shape))
            for place, item in np.ndenumerate(x):
                stacked[:, *place] = values(item)
            return stacked

        def tables(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            if x.dtype != object:  # one for all
                return x, np.tile([0, len(x)], (n, 1))
            first = len(x) * np.arange(n)
            return columns(x).reshape(-1, x.shape[1]), np.stack([first, first + len(x)], axis=1)

        q = problem
        return cls(
            spread(q.mode), columns(q.y0), columns(q.p()), spread(q.law), spread(q.ratio),
            spread(q.fallen), *tables(q.horizontal), *tables(q.transverse), *tables(q.vertical),
            spread(q.end), spread(q.quiet_from),
        )  # fmt: skip

    def bits(self, places: Iterable[int]) -> list[list[tuple[str, bytes]]]:
        """The numbers of some of the cases, to compare them with others."""
        return [[(x.dtype.str, x.tobytes()) for x in self._numbers(i)] for i in places]

    def _numbers(self, i: int) -> Iterator[np.ndarray]:
        yield self.horizontal[slice(*self.h_rows[i])]
        yield self.transverse[slice(*self.t_rows[i])]
        yield self.vertical[slice(*self.v_rows[i])]
        yield from (x[i] for name, x in self._asdict().items() if name not in _OF_TABLES)


_OF_TABLES = {*COMPONENTS, "h_rows", "t_rows", "v_rows"}


class ProblemTangents(NamedTuple):
    """Derivatives of the numbers of a `Problem` along m directions.

    y0 (N, m); p (len(problem.p()), m), those of the table behind those of the parameters; ratio,
    fallen, end, quiet_from (m,); horizontal, transverse, vertical (rows, 7, m).
    """

    y0: np.ndarray
    p: np.ndarray
    ratio: np.ndarray
    fallen: np.ndarray
    horizontal: np.ndarray
    transverse: np.ndarray
    vertical: np.ndarray
    end: np.ndarray
    quiet_from: np.ndarray


def without_duals(problem: Problem) -> Problem:
    """The problem; raises TypeError where its numbers have derivatives, which would be lost."""
    if directions(*problem):
        raise InputTypeError("case").says(
            "the case holds duals, and a simulation has no derivatives: give it to `rk.tangents`, "
            "or simulate it with the `.value` of each"
        )
    return problem


def parted(problem: Problem, m: int | None = None) -> tuple[Problem, ProblemTangents]:
    """A problem of duals as one of floats, and its derivatives.

    m : how many directions there are; those of the duals if not given, 0 where there are none.
    The floats are those, to the last bit, of the case without derivatives.
    """
    q = problem
    p, table = q.p(), np.array(q.table)
    m = directions(*q) if m is None else m
    values = {name: value_of(x) for name, x in q._asdict().items()}
    values["table"] = value_of(table).tolist()
    tangents = {
        name: tangent_of(p if name == "p" else getattr(q, name), m)
        for name in ProblemTangents._fields
    }
    return Problem(**values), ProblemTangents(**tangents)


def _stacked(tables: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """(rows, first and last of each table); a table that several cases share is stacked once."""
    places: dict[int, tuple[int, int]] = {}
    parts: list[np.ndarray] = []
    n = 0
    for table in tables:
        if id(table) not in places:
            places[id(table)] = n, n + len(table)
            parts.append(table)
            n += len(table)
    return np.concatenate(parts), np.array([places[id(table)] for table in tables])


_ROUNDING = 1e-12
"""Relative to the accelerations at the start: a rotation that is slower comes from rounding."""
AT_THE_END = 1e-9
"""So far beyond the bound of overturning, relative to it, may be the last state of a motion."""


@explained.attributes(simulate="rk.simulate(case)", run="rk.simulate(case)")
@explained.calls(
    restitution="impact=rk.VelocityRatio(e)",
    options="them to rk.simulate or rk.simulate_many",
    theta='initial={"theta": ...}',
)
@dataclass(frozen=True)
class Case:
    """Structure, its ground motion and start; the arguments are those of `simulate`.

    Parameters
    ----------
    structure : Structure
        Structure that is shaken.
    motion : GroundMotion
        Horizontal ground motion. A recording becomes its components here.
    impact : ImpactLaw, optional
        Impact law; `Structure.default_impact` if not given.
    initial : dict of str to float, optional
        Values of states by name [rad, m, rad/s, m/s]; others are zero.
    duration : float, optional
        Duration [s]; the motion's own if not given.
    vertical : GroundMotion, optional
        Vertical ground motion.
    mode : str, optional
        Name of the mode at the start, where the state leaves it open.
    slope : float or str, optional
        Slope of the ground, a number [rad] or a text such as "5 deg" or "1 in 20".
    ground_axes : str, optional
        Axes of the ground motions, "slope" or "world".
    transverse : GroundMotion, optional
        Second horizontal ground motion, at a right angle counter-clockwise from the first one seen
        from above, of a structure in space.
    azimuth : float or str, optional
        Azimuth of the x axis of a structure in space from the first horizontal ground motion,
        counter-clockwise seen from above: a number [rad] or a text such as "30 deg".

    Raises
    ------
    TypeError
        For anything but a structure, a ground motion or a mapping of states.
    InputError
        For a slope that is none, or not between -90 and 90 degrees, or below a structure in space,
        and for a transverse motion or an azimuth of one in the plane.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> case = rk.Case(block, pulse, impact=rk.EnergyRatio(0.8), initial={"theta": 0.02})  # rad
    >>> print(rk.simulate(case).outcome)
    completed
    """

    structure: Structure
    motion: GroundMotion
    impact: ImpactLaw | None = None
    initial: Mapping[str, float] | None = None
    duration: float | None = None
    vertical: GroundMotion | None = None
    mode: str | None = None
    slope: Any = 0.0
    ground_axes: str = SLOPE
    transverse: GroundMotion | None = None
    azimuth: Any = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "slope", slope_angle(self.slope))
        object.__setattr__(self, "azimuth", azimuth_angle(self.azimuth))
        axes = self.ground_axes
        require(axes in AXES, "", "ground_axes", axes, f"choose {' or '.join(map(repr, AXES))}")
        swapped: tuple[object, object] = self.structure, self.motion
        if isinstance(swapped[0], GroundMotion) and isinstance(swapped[1], Structure):
            raise InputTypeError("structure").says(
                "structure and motion are swapped: the structure comes first"
            )
        if not isinstance(self.structure, Structure):
            raise InputTypeError("structure", self.structure).give(
                "a structure, such as rk.RigidBlock(half_width=0.1, half_height=0.4) or "
                "rk.structure(model, ...)"
            )
        motion: object = self.motion
        if isinstance(motion, Recording):
            self._take_components(motion)
        _check_motion("motion", self.motion)
        for name in ("transverse", "vertical"):
            if getattr(self, name) is not None:
                _check_motion(name, getattr(self, name))
        self._check_space()
        if self.initial is not None:
            initial = named_states("initial", self.initial, self.structure.module)
            object.__setattr__(self, "initial", initial)

    def _check_space(self) -> None:
        """Raise InputError for a slope in space, and in the plane for what only space has."""
        name, spatial = type(self.structure).__name__, in_space(self.structure.module)
        given_of = {"transverse": self.transverse is not None, "azimuth": self.azimuth != 0.0}
        for argument in [] if spatial else [one for one, is_given in given_of.items() if is_given]:
            raise InputError(argument).says(f"{name} moves in a plane: leave {{{argument}}} out")
        if spatial and not self.ground.is_level:
            raise InputError("slope", self.slope).says(
                f"{name} moves in space, and its ground is level: leave the slope out"
            )

    def _take_components(self, recording: Recording) -> None:
        """The motions of a recording; raises TypeError where it leaves open which."""
        for name in ("vertical", "transverse"):
            if getattr(self, name) is not None:
                raise InputTypeError(name).wrong(
                    f"is given along with the recording {recording.name!r}: leave it out, or give "
                    "recording.horizontal[0] as motion"
                )
        object.__setattr__(self, "vertical", recording.vertical)
        if in_space(self.structure.module):
            for name, motion in zip(("motion", "transverse"), recording.in_space(), strict=True):
                object.__setattr__(self, name, motion)
            return
        if len(recording.horizontal) > 1:
            raise InputTypeError("motion", recording).says(
                f"the recording {recording.name!r} has two horizontal components, and a plane "
                "structure takes one: give one of recording.in_plane(), or recording.along(angle)"
            )
        object.__setattr__(self, "motion", recording.horizontal[0])

    @cached_property
    def ground(self) -> Ground:
        """The ground motions on the slope."""
        return ground_of(self)

    def problem(self) -> Problem:
        """Case in numbers.

        Returns
        -------
        Problem
            Parameters, segments of the ground motion, initial state and mode.

        Raises
        ------
        ValueError
            For a state or a duration that cannot be.
        """
        structure, motion, ground = self.structure, self.motion, self.ground
        named = {} if self.initial is None else self.initial
        y0 = structure.started(structure.state(named), named, ground)
        if self.initial is None and not ground.is_level:
            y0 = standing_on(structure, y0, ground.weight)
        for name, fallen in structure.falls.items():
            value = y0[structure.states.index(name)]
            if abs(value) > fallen * (1.0 + AT_THE_END):
                unit = structure.module.STATE_UNITS[structure.states.index(name)]
                degrees = f", or give degrees as {name}_degrees" if unit == "rad" else ""
                raise InputError(name, value).says(
                    f"initial {name} is {value}: the structure lies on the ground from {fallen:.6g}"
                    f" on; start below{degrees}"
                )
        if has_points(structure.module):
            check_bounds(structure.module, value_of(y0), value_of(structure.vector))
        end = motion.duration if self.duration is None else number("duration", self.duration)
        require(isfinite(end) and end > 0, "", "duration", end, "it must be finite and positive")
        law, ratio = structure.law(self.impact)
        quiet = ground.quiet_from
        if abs(quiet - end) <= 1e-12 * abs(end):
            quiet = end  # a duration that is a difference of others is so but for rounding
        return Problem(
            mode=structure.mode_number(y0, self.mode, partial(self._about_to_turn, y0)),
            y0=y0,
            vector=structure.vector,
            table=structure.impact_table(self.impact),
            law=law,
            ratio=ratio,
            fallen=structure.overturning_rotation,
            **ground.tables._asdict(),
            end=end,
            quiet_from=quiet,
        )

    def _about_to_turn(self, y0: np.ndarray) -> float:
        """Sign of the rotation to come from upright and at rest, by the equations; 0 if none is.

        Weight or springs may turn a structure, too, that shaking does not. Those of both sides are
        added: what only one of them has is its support. Where nothing but rounding turns it yet,
        the first push of the ground will.
        """
        structure, y0 = self.structure, value_of(y0)
        p = value_of(structure.vector)
        m = structure.module_for(y0, p)
        tables = self.ground.tables
        across, *others = (getattr(tables, name) for name in self.ground.motions)
        shaking = [next(_pushes(table), 0.0) for table in others]
        first = next((push for push in _pushes(across) if push != 0.0), 0.0)
        turn, size, rate = 0.0, 0.0, np.zeros(len(y0), np.result_type(y0, p))
        for side in (-1.0, 1.0):
            mode = structure.mode_number(y0, None, partial(float, side))
            m.rates(mode, y0, p, next(_pushes(across)), *shaking, rate)
            turn += rate[m.ROTATION_RATE]
            size += sum(map(abs, rate[len(y0) // 2 :]))
        return (np.sign(turn) if abs(turn) > _ROUNDING * size else 0.0) or -np.sign(first)


def check_case(case: Any) -> None:
    """Raise TypeError for anything but a case."""
    require_type("case", case, Case, "a case, rk.Case(structure, motion)")


def _check_motion(name: str, motion: Any) -> None:
    if not isinstance(motion, GroundMotion):
        raise InputTypeError(name, motion).give(
            "a ground motion, such as GroundMotion.from_array(values, dt) of accelerations, "
            "GroundMotion.read(path) of a file, or GroundMotion.none(duration) of no shaking"
        )


def _pushes(table: np.ndarray) -> Iterator[float]:
    """The ground acceleration of each segment, a thousandth of its own time behind its start.

    Neither at the start, where a sine is zero, nor in its middle, where it may be so again.
    """
    for row in table:
        start, end, kind, c0, c1, c2, c3 = row.tolist()
        curved = kind != LINEAR and c1 != 0.0
        tau = 1e-3 * min(end - start, 1.0 / abs(c1) if curved else 1e9)
        shape = kind - WITH_CONSTANT if kind > WITH_CONSTANT else kind
        constant = 0.0 if shape == kind else c3
        yield value_of(within(shape, c0, c1, c2, c3, tau) + constant)
