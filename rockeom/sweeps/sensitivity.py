"""How much an answer of a simulation changes with each number that the simulation was given."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rockeom.codes import IMPACT, LANDING, REST
from rockeom.motion.segments import KIND, scaled
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, near
from rockeom.numbers.dual import (
    Dual,
    directions,
    duals,
    nominal,
    tangent_of,
    value_of,
    with_tangent,
)
from rockeom.numbers.functions import of_compounds
from rockeom.simulation.case import Case, check_case, parted
from rockeom.simulation.ground import COMPONENTS, PARTS, Ground
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.structures.evaluation import OF_ELEMENT
from rockeom.structures.positions import (
    RESERVE,
    names_of_leans,
    of_leans,
    size_of_place,
    stands_on_feet,
)
from rockeom.structures.units import time_unit, with_unit
from rockeom.sweeps.case_numbers import Number, numbers_named, numbers_of, with_numbers
from rockeom.sweeps.tangents import Tangents, of_problem

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, repr=False, eq=False)
class Sensitivity:
    """Results of a simulation and their derivatives; printed as a table, with units.

    Parameters
    ----------
    of : tuple of str
        Names of the n results.
    to : tuple of str
        Names of the k numbers by which they are derived.
    values : ndarray
        Results (n,).
    parameters : ndarray
        Numbers (k,).
    derivatives : ndarray
        Derivatives (n, k), each in the unit of the result over that of the number.
    units : tuple of str
        Units of the results, "" where none is known.
    parameter_units : tuple of str
        Units of the numbers, "" where none is known.
    tangents : Tangents
        Motion with its derivatives, whose `response` is that of the case.
    """

    of: tuple[str, ...]
    to: tuple[str, ...]
    values: np.ndarray
    parameters: np.ndarray
    derivatives: np.ndarray
    units: tuple[str, ...]
    parameter_units: tuple[str, ...]
    tangents: Tangents

    @property
    def elasticities(self) -> np.ndarray:
        """Per cent by which each result changes for each per cent of a number (n, k).

        d ln(value) / d ln(parameter); not finite where a value is zero.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.derivatives * self.parameters / self.values[:, None]

    def to_dataframe(self) -> pd.DataFrame:
        """Derivatives, a row for each of `of` and a column for each of `to`.

        Returns
        -------
        pandas.DataFrame
            Table of the derivatives.
        """
        import pandas as pd

        return pd.DataFrame(self.derivatives, index=list(self.of), columns=list(self.to))

    def __repr__(self) -> str:
        answers = map(with_unit, self.of, self.units)
        rows = [
            ["", "at", *answers],
            ["value", "", *map(_number, self.values)],
            *(
                [with_unit(name, unit), _number(at), *map(_number, along)]
                for name, unit, at, along in zip(
                    self.to, self.parameter_units, self.parameters, self.derivatives.T, strict=True
                )
            ),
        ]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = [_line(row, widths) for row in rows]
        return "\n".join([*lines, *([self.tangents.grazing] if self.tangents.grazing else [])])


def _number(x: float) -> str:
    return f"{x:.6g}"


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    first, *others = zip(row, widths, strict=True)
    return "  ".join([f"{first[0]:<{first[1]}}", *(f"{x:>{width}}" for x, width in others)])


@explained.calls()
def sensitivity(
    case: Case, of: Sequence[str], to: Sequence[str], options: SolverOptions | None = None
) -> Sensitivity:
    """Derivatives of results of a simulation by any numbers of its case, at the cost of few runs.

    Parameters
    ----------
    case : Case
        Case.
    of : sequence of str
        Names of the results: "peak theta", the largest size of it; "greatest theta" and "least
        theta"; "theta at 2.5", at a time [s]; "end theta"; "impact 3 time", and of the third impact
        (or "event 3", of ``run.events``) "impact 3 theta_dot", before it, and "impact 3 theta_dot
        after"; "overturning time" and "rest time". Instead of theta any state, energy,
        displacement, or deformation, force and energy of an element, such as "storey_1_force"; in
        space "tilt", "tilt_direction" and "reserve".
    to : sequence of str
        Names of the numbers: arguments of the structure, "masses[0]" for an item of a list and
        "support.stiffness" for one of its support; those of a pulse, "amplitude" and "period" or
        "frequency"; those of the impact law, such as "r"; "restitution", the ratio e of the angular
        velocities, of a law of one ratio; "initial theta" of a state that `initial` names, or any
        state of a structure whose feet do not slip; "scale", a factor of the ground's acceleration,
        and "time_scale", one of its time, both of the vertical motion, too; "duration"; "azimuth"
        of a structure in space. A name that two parts have is one of "structure.height" and
        "impact.height".
    options : SolverOptions, optional
        Choices of the integration; the defaults if not given.

    Returns
    -------
    Sensitivity
        Results and derivatives. Derivatives are NaN where an event grazes.

    Raises
    ------
    ValueError
        For names that are unknown, for an event that the motion has not, and as `tangents` does.
    TypeError
        For a case that holds duals already.

    Notes
    -----
    They are the derivatives of the motion through all its events, see `tangents`: those of a motion
    that does not overturn do not tell how near it is to overturning.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> case = rk.Case(block, pulse, impact=rk.VelocityRatio(0.9))
    >>> slopes = rk.sensitivity(case, of=["peak theta"], to=["half_width", "restitution"])
    >>> slopes.derivatives.shape
    (1, 2)
    """
    _check_plain(case)
    wanted, varied = _names("of", of), _names("to", to)
    numbers = _numbers(case, varied)
    seeds = duals(**{f"x{i}": number.value or 0.0 for i, number in enumerate(numbers)})
    pairs = list(zip(numbers, seeds.values(), strict=True))
    seeded = with_numbers(case, [(n, seed) for n, seed in pairs if not n.factor])
    problem, along = parted(seeded.problem(), len(varied))
    of_factors = [(j, number) for j, number in enumerate(numbers) if number.factor]
    if of_factors:
        for part, table in _of_ground(nominal(seeded.ground), of_factors, len(varied)).items():
            along = along._replace(**{part: getattr(along, part) + table})
    motion = of_problem(seeded, problem, along, SolverOptions.of(options))
    answers = [answer(name, motion) for name in wanted]
    return Sensitivity(
        wanted,
        varied,
        np.array([float(answer.value) for answer in answers]),
        np.array([float(seed.value) for seed in seeds.values()]),
        np.array([answer.tangent for answer in answers]) + 0.0,  # none is -0.0
        tuple(_unit_of(name, motion.response) for name in wanted),
        tuple(number.unit for number in numbers),
        motion,
    )


def _check_plain(case: Any) -> None:
    check_case(case)
    if directions(*case.problem()):
        raise InputTypeError("case").says("the case holds duals already: give it to `rk.tangents`")


def _names(what: str, names: Sequence[str]) -> tuple[str, ...]:
    if isinstance(names, str) or not all(isinstance(name, str) for name in names):
        raise InputTypeError(what, names).give(f'a list of names, such as ["{names}"]')
    if not names or len({*names}) < len(names):
        raise InputError(what, names).give("one name or more, each of them once")
    return tuple(names)


def _numbers(case: Case, names: Sequence[str]) -> list[Number]:
    """The numbers of these names, of those that have a value and a derivative."""
    smooth = {name: n for name, n in numbers_of(case).items() if n.smooth and n.value is not None}
    return numbers_named("to", names, smooth, case.structure)


_TINY = 1e-100
_FACTORS = {"scale": (_TINY * 1j, 0.0), "time_scale": (0.0, _TINY * 1j)}
"""Additions to the factors of the ground's acceleration and time, to derive by them: imaginary
parts so small that their squares vanish (Lyness and Moler 1967). Records have thousands of rows."""


def _of_ground(
    ground: Ground, of_factors: Sequence[tuple[int, Number]], m: int
) -> dict[str, np.ndarray]:
    """(rows, 7, m) derivatives of the tables by factors of the motions, which are some directions.

    of_factors : the direction and the number of each.
    """
    derivatives = [np.zeros((m, *table.shape)) for table in ground.tables]
    for j, number in of_factors:
        acceleration, time = _FACTORS[number.factor]
        moved = (
            scaled(table, 1.0 + acceleration, 1.0 + time)
            if number.part in ("case", PARTS.get(name, name))
            else table
            for name, table in ground.level_tables.items()
        )
        for derivative, table in zip(derivatives, ground.tables_of(*moved), strict=True):
            derivative[j] = table.imag / _TINY
    parts = (np.moveaxis(derivative, 0, -1) for derivative in derivatives)
    return dict(zip(COMPONENTS, parts, strict=True))


# -- quantities by name


def answer(name: str, tangents: Tangents) -> Dual:
    """An answer with its derivatives; its name as of `sensitivity`, which says what is raised."""
    motion = _Moving(tangents)
    for pattern, asked in _ANSWERS.items():
        if match := re.fullmatch(pattern, name):
            return asked(motion, *match.groups())
    if name in ("number of impacts", "number of events", "outcome"):
        raise InputError("of", name).says(
            f"the {name} has no derivative: it stays or it jumps. The time of an impact has, as "
            '"impact 3 time"'
        )
    raise InputError("of", name).choose(_EXAMPLES)


class _Moving:
    """A motion with its derivatives, asked for quantities at places of it."""

    def __init__(self, tangents: Tangents) -> None:
        self.found, self.path = tangents, tangents.motion
        self.run, self.along = tangents.response, tangents.along
        self.p = with_tangent(self.run.structure.vector, tangents.parameters)
        self.module = self.run.structure.module
        self.m = tangents.end.shape[-1]

    def of(self, name: str, mode: int, y: np.ndarray, along: np.ndarray) -> Dual:
        """A quantity of a state (N,) with derivatives (N, m)."""
        return _dual(quantity_of(self.module, name, mode, with_tangent(y, along), self.p), self.m)

    def at_event(self, name: str, k: int, after: bool) -> Dual:
        _, kinds, states = self.run.events.columns
        along = self.found.after[k] if after else self.found.before[k]
        return self.of(name, int(kinds[k, 2 if after else 1]), states[k, int(after)], along)

    def at_time(self, name: str, t: float) -> Dual:
        y, modes = self.run.steps.at(np.array([t]), "right")
        return self.of(name, int(modes[0]), y[0], self.found.at([t])[0])

    def at_corner(self, name: str, corner: Dual) -> Dual:
        """The value at a corner of the ground motion, a time that moves."""
        t = float(np.nextafter(value_of(corner), 0.0))
        y, modes = self.run.steps.at(np.array([t]), "left")
        along = self.found.at([t])[0] + np.outer(self.path.rates(t), tangent_of(corner, self.m))
        return self.of(name, int(modes[0]), y[0], along)

    def at_end(self, name: str) -> Dual:
        run = self.run
        along = self.found.end
        last = self.path.last_time
        if self.path.falls:
            along = along + np.outer(self.path.rates(last), self.found.end_time)
        modes = run.steps.at(np.array([last]), "left")[1]
        return self.of(name, int(modes[0]), run.end, along)

    def rate(self, name: str, t: float) -> float:
        """Rate of a quantity up to a time."""
        y, modes = self.run.steps.at(np.array([t]), "left")
        moving = with_tangent(y[0], self.path.rates(t)[:, None])
        x = quantity_of(self.module, name, int(modes[0]), moving, self.run.structure.vector)
        return float(_dual(x, 1).tangent[0])

    def corner(self, t: float, tolerance: float) -> Dual | None:
        """When there is a corner of the ground's motion that moves, within a tolerance."""
        for name in COMPONENTS:
            rows, along = getattr(self.path.problem, name), getattr(self.along, name)
            times, moves = rows[:, :KIND].ravel(), along[:, :KIND].reshape(-1, self.m)
            for i in np.flatnonzero((np.abs(times - t) <= tolerance) & moves.any(axis=1)):
                return Dual(float(times[i]), moves[i])
        return None

    def event(self, what: str, number: str) -> int:
        """Number among all events of the n-th impact, or of the n-th event."""
        kinds = self.run.events.columns[1][:, 0]
        every = np.ones(len(kinds), dtype=bool)
        some = np.flatnonzero(np.isin(kinds, (IMPACT, LANDING)) if what == "impact" else every)
        if not 1 <= int(number) <= len(some):
            raise InputError("of", f"{what} {number}").give(f"a number from 1 to {len(some)}")
        return int(some[int(number) - 1])


def _dual(x: Any, m: int) -> Dual:
    return Dual(float(value_of(x)), tangent_of(x, m))


def quantity_of(module: Any, name: str, mode: int, y: np.ndarray, p: np.ndarray) -> Any:
    """A quantity of a state y (N,) of duals, with the parameters p, by the equations; a number.

    name : of a state, a displacement, an energy, or of what an element does. Raises ValueError for
    any other.
    """
    function, first, last = _told(module, name)
    if not function:
        return y[first]
    out = np.zeros(_SIZES[function](module), dtype=object)
    getattr(of_compounds(module), function)(mode, y, p, out)
    if function == "positions":
        with np.errstate(all="ignore"):  # upright a direction, and its derivatives, are NaN
            return of_leans(module, out.reshape(len(module.POSITIONS), -1))[name]
    return sum(out[first:last])


_SIZES: dict[str, Callable[[Any], int]] = {
    "kinematics": lambda m: len(m.KINEMATICS),
    "energies": lambda m: len(m.ENERGIES),
    "elements": lambda m: 4 * len(m.ELEMENT_NAMES),
    "positions": lambda m: size_of_place(m) * len(m.POSITIONS),
}


def _told(module: Any, name: str) -> tuple[str, int, int]:
    """The function of the module that tells a quantity, "" of a state, and from where to where."""
    places = {state: ("", i, i + 1) for i, state in enumerate(module.STATES)}
    for function in ("kinematics", "energies"):
        for i, quantity in enumerate(getattr(module, function.upper())):
            places[quantity] = function, i, i + 1
    places["total_energy"] = "energies", 0, len(module.ENERGIES)
    for i, element in enumerate(module.ELEMENT_NAMES):
        for k, part in enumerate(OF_ELEMENT, 4 * i):
            places[f"{element}_{part}"] = "elements", k, k + 1
    leans = [name for names in names_of_leans(module).values() for name in names]
    for quantity in [*leans, *[RESERVE] * stands_on_feet(module)]:
        places.setdefault(quantity, ("positions", 0, 0))
    if name not in places:
        raise InputError("of", name).says(
            f"there are derivatives of {', '.join(places)}: {name!r} is none of them"
            f"{near(name, places)}"
        )
    return places[name]


def _extreme(motion: _Moving, which: str, name: str) -> Dual:
    """An extreme, which moves with its event, or the ground's corner, or stands still in time."""
    _told(motion.module, name)  # before steps are searched
    of = motion.run.extremes(name)
    sided = which == "greatest" or (which == "peak" and of.maximum >= -of.minimum)
    t, value = (of.maximum_time, of.maximum) if sided else (of.minimum_time, of.minimum)
    bound = motion.run.structure.falls.get(name, math.inf)
    if motion.path.falls and abs(value) >= bound * (1.0 - 1e-9):
        raise InputError("of", name).says(
            f"{which} {name} is {bound:.4g}, at which the motion ends as overturned, whatever the "
            'numbers are, and has no derivatives: ask for "overturning time"'
        )
    tolerance = 1e-7 * float(np.max(motion.run.steps.span[:, 1]))
    there = np.flatnonzero(np.abs(motion.run.events.columns[0] - t) <= tolerance)
    places = [motion.at_event(name, k, after) for k in there.tolist() for after in (False, True)]
    if motion.path.last_time - t <= tolerance:
        places.append(motion.at_end(name))
    if places:
        extreme = min(places, key=lambda x: abs(float(x.value) - value))
    elif (corner := motion.corner(t, tolerance)) is not None:
        extreme = motion.at_corner(name, corner)
    else:
        extreme = motion.at_time(name, _where_it_turns(motion, name, t, tolerance))
    return -extreme if which == "peak" and value < 0.0 else extreme


def _where_it_turns(motion: _Moving, name: str, t: float, tolerance: float) -> float:
    """The time of an extreme, which its value tells to half of the digits, by that of its rate."""
    rate, h = motion.rate(name, t), 1e3 * tolerance
    within = h < t < motion.path.last_time - h
    bend = (motion.rate(name, t + h) - motion.rate(name, t - h)) / (2.0 * h) if within else 0.0
    moved = -rate / bend if bend else 0.0
    return t + moved if abs(moved) <= tolerance else t


def _at_time(motion: _Moving, name: str, time: str) -> Dual:
    t = float(time)
    if not 0.0 <= t <= motion.path.last_time:
        raise InputError("of", time).says(
            f"{name} at {time}: the motion is known from 0 to {motion.path.last_time:.6g} s"
        )
    return motion.at_time(name, t)


def _of_event(motion: _Moving, what: str, number: str, name: str, side: str | None) -> Dual:
    k = motion.event(what, number)
    if name == "time":
        return Dual(float(motion.run.events.columns[0][k]), motion.found.event_times[k])
    return motion.at_event(name, k, side is not None)


def _overturning_time(motion: _Moving) -> Dual:
    if not motion.path.falls:
        raise InputError("of").says(
            f"there is no overturning time: within its duration the motion {motion.run.outcome}"
        )
    return Dual(motion.path.last_time, motion.found.end_time)


def _rest_time(motion: _Moving) -> Dual:
    times, kinds, _ = motion.run.events.columns
    rests = np.flatnonzero(kinds[:, 0] == REST)
    if not len(rests):
        raise InputError("of", "rest time").so("no limit of infinitely many impacts was met")
    return Dual(float(times[rests[-1]]), motion.found.event_times[rests[-1]])


_NUMBER = r"(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)"
_ANSWERS: dict[str, Callable[..., Dual]] = {
    r"(peak|least|greatest) (\w+)": _extreme,
    r"overturning time": _overturning_time,
    r"rest time": _rest_time,
    r"end (\w+)": _Moving.at_end,
    r"(impact|event) (\d+) (\w+)( after)?": _of_event,
    rf"(\w+) at {_NUMBER}": _at_time,
}
_EXAMPLES = (
    "peak theta", "greatest theta", "least theta", "theta at 2.5", "end theta", "impact 3 time",
    "impact 3 theta_dot", "impact 3 theta_dot after", "event 3 time", "overturning time",
    "rest time",
)  # fmt: skip


def _unit_of(name: str, run: Response) -> str:
    units = run.units
    if re.search(r"\btime$", name):
        return time_unit(run.structure.module)
    return next((units[word] for word in name.split() if word in units), "")
