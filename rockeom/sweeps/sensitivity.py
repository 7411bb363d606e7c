"""How much an answer of a simulation changes with each number that the simulation was given."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rockeom.codes import IMPACT, LANDING, REST
from rockeom.motion.segments import KIND, scaled
from rockeom.numbers import explained
from rockeom.numbers.checks import described, is_number, near
from rockeom.numbers.dual import Dual, directions, duals, tangent_of, value_of, with_tangent
from rockeom.numbers.functions import mathematics, of_compounds
from rockeom.simulation.case import Case, ground_table, parted
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.structures.base import Structure
from rockeom.structures.declared import DeclaredStructure
from rockeom.structures.evaluation import OF_ELEMENT
from rockeom.structures.impact_laws import EnergyRatio, VelocityRatio
from rockeom.structures.units import time_unit
from rockeom.sweeps.tangents import Tangents, of_problem

if TYPE_CHECKING:
    import pandas as pd

    from rockeom.motion import GroundMotion


@dataclass(frozen=True, repr=False)
class Sensitivity:
    """Answers of a simulation and their derivatives; printed as a table, with units.

    of : names of the n answers, values (n,) what they are; to : names of the k numbers that they
    are derived by, parameters (k,) what those are; derivatives (n, k), each in the unit of the
    answer over that of the number. units, parameter_units : of both, "" where none is known.
    tangents : the motion with its derivatives, whose `response` is that of the case.
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
        """(n, k) per cent by which each answer changes for each per cent of a number.

        d ln(value) / d ln(parameter); not finite where a value is zero.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.derivatives * self.parameters / self.values[:, None]

    def to_dataframe(self) -> pd.DataFrame:
        """The derivatives, a row for each of `of` and a column for each of `to`."""
        import pandas as pd

        return pd.DataFrame(self.derivatives, index=list(self.of), columns=list(self.to))

    def __repr__(self) -> str:
        answers = map(_with_unit, self.of, self.units)
        rows = [
            ["", "at", *answers],
            ["value", "", *map(_number, self.values)],
            *(
                [_with_unit(name, unit), _number(at), *map(_number, along)]
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


def _with_unit(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    first, *others = zip(row, widths, strict=True)
    return "  ".join([f"{first[0]:<{first[1]}}", *(f"{x:>{width}}" for x, width in others)])


@explained.calls()
def sensitivity(
    case: Case, of: Sequence[str], to: Sequence[str], options: SolverOptions | None = None
) -> Sensitivity:
    """Derivatives of answers of a simulation by any numbers of its case, at the cost of few runs.

    of : "peak theta", the largest size of it; "greatest theta" and "least theta"; "theta at 2.5",
        at a time [s]; "end theta"; "impact 3 time", and of the third impact (or "event 3", of
        `run.events`) "impact 3 theta_dot", before it, and "impact 3 theta_dot after"; "overturning
        time" and "rest time". Instead of theta any state, energy, displacement, or deformation,
        force and energy of an element, such as "storey_1_force".
    to : numbers that the structure was given, by their names, "masses[0]" for an item of a list
        and "support.stiffness" for one of its support; those of the law of impact, such as "r";
        "restitution", the ratio e of the rates of rotation, of a law of one ratio; "initial theta"
        of what `initial` names, or any state of a structure whose feet do not slip; "amplitude", a
        factor of the ground's acceleration, and "time_scale", one of its time, both of the vertical
        motion, too; "duration".
    options : as for `simulate`.

        block = rk.RigidBlock(half_width=0.1, half_height=0.4)
        case = rk.Case(block, rk.GroundMotion.single_sine(3.0, 0.8), impact=rk.VelocityRatio(0.9))
        print(rk.sensitivity(case, of=["peak theta"], to=["half_width", "restitution"]))

    They are the derivatives of the motion through all its events, see `tangents`: of a motion that
    does not overturn they do not tell how near it is to. Where an event grazes they are nan.
    Raises ValueError for names that are unknown, for an event that the motion has not, and what
    `tangents` raises; TypeError for a case that holds duals already.
    """
    _check_plain(case)
    wanted, given = _names("of", of), _names("to", to)
    knobs = _knobs(case)
    for name in given:
        if name not in knobs:
            raise ValueError(f"to: {_unknown(name, knobs)}")
    if "restitution" in given and len({"restitution", "r", "e"} & {*given}) > 1:
        raise ValueError("to: 'restitution' is the ratio of the law itself: name one of both")
    seeds = duals(**{f"x{i}": knobs[name].value for i, name in enumerate(given)})
    seeded = case
    for name, seed in zip(given, seeds.values(), strict=True):
        seeded = knobs[name].turn(seeded, seed)
    problem, along = parted(seeded.problem(), len(given))
    factors = {j: name for j, name in enumerate(given) if name in _FACTORS}
    if factors:
        along = along._replace(
            horizontal=_of_ground(case.motion, factors, len(given)),
            vertical=_of_ground(case.vertical, factors, len(given)),
        )
    motion = of_problem(seeded, problem, along, SolverOptions.of(options))
    answers = [answer(name, motion) for name in wanted]
    return Sensitivity(
        wanted,
        given,
        np.array([float(answer.value) for answer in answers]),
        np.array([float(seed.value) for seed in seeds.values()]),
        np.array([answer.tangent for answer in answers]) + 0.0,  # none is -0.0
        tuple(_unit_of(name, motion.response) for name in wanted),
        tuple(knobs[name].unit for name in given),
        motion,
    )


def _check_plain(case: Any) -> None:
    if not isinstance(case, Case):
        raise TypeError(f"case is {described(case)}: give a case, rk.Case(structure, motion)")
    if directions(*case.problem()):
        raise TypeError("the case holds duals already: give it to `rk.tangents`")


def _names(what: str, names: Sequence[str]) -> tuple[str, ...]:
    if isinstance(names, str) or not all(isinstance(name, str) for name in names):
        raise TypeError(f'{what} is {described(names)}: give a list of names, such as ["{names}"]')
    if not names or len({*names}) < len(names):
        raise ValueError(f"{what} is {described(names)}: give one name or more, each of them once")
    return tuple(names)


def _unknown(name: str, known: Mapping[str, Any]) -> str:
    return f"{name!r} is unknown{near(name, known)}; there are {', '.join(known)}"


# -- what is turned


Turn = Callable[[Case, Any], Case]
"""Makes a case with another number, such as a dual, in its place."""


class _Knob(NamedTuple):
    """A number of a case, with its unit."""

    value: float
    unit: str
    turn: Turn


def _knobs(case: Case) -> dict[str, _Knob]:
    """All numbers of a case by name; where a name is used twice it is the structure's."""
    return {
        **_of_time(case),
        **_of_start(case),
        **_of_law(case),
        **_of_structure(case.structure),
    }


def _of_structure(structure: Structure) -> dict[str, _Knob]:
    module = structure.module
    signs = dict(zip(module.PARAMETERS, module.PARAMETER_SIGNS, strict=True))
    units = dict(zip(module.PARAMETERS, module.PARAMETER_UNITS, strict=True))
    return {
        name: _Knob(value, units.get(structure.parameter_at(path), ""), _turned("structure", path))
        for name, path, value in _numbers(_made_of(structure))
        if signs.get(name) != "n"  # whole ones
    }


def _of_law(case: Case) -> dict[str, _Knob]:
    law: Any = case.impact
    if not is_dataclass(law):
        return {}
    knobs = {
        name: _Knob(value, "-" if len(path) == 1 and name != "height" else "", turn)
        for name, path, value in _numbers(_made_of(law))
        if name != "seed"
        for turn in [_turned("impact", path)]
    }
    ratio = law.e if isinstance(law, VelocityRatio) else None
    if isinstance(law, EnergyRatio) and law.r is not None:
        ratio = float(mathematics.sqrt(law.r))
    if ratio is not None:
        knobs["restitution"] = _Knob(ratio, "-", lambda of, e: replace(of, impact=VelocityRatio(e)))
    return knobs


def _of_start(case: Case) -> dict[str, _Knob]:
    structure, initial = case.structure, dict(case.initial or {})
    named = initial if structure.has_landings else structure.states
    units = dict(zip(structure.states, structure.module.STATE_UNITS, strict=True))

    def turn(name: str) -> Turn:
        return lambda of, x: replace(of, initial={**(of.initial or {}), name: x})

    return {
        f"initial {name}": _Knob(float(initial.get(name, 0.0)), units[name], turn(name))
        for name in named
    }


def _of_time(case: Case) -> dict[str, _Knob]:
    duration = case.motion.duration if case.duration is None else case.duration
    unit = time_unit(case.structure.module)
    return {
        **{name: _Knob(1.0, "-", lambda of, _: of) for name in _FACTORS},
        "duration": _Knob(float(duration), unit, lambda of, x: replace(of, duration=x)),
    }


_TINY = 1e-100
_FACTORS = {"amplitude": (_TINY * 1j, 0.0), "time_scale": (0.0, _TINY * 1j)}
"""Additions to the factors of the ground's acceleration and time, to derive by them: imaginary
parts so small that their squares vanish (Lyness and Moler 1967). Records have thousands of rows."""


def _of_ground(motion: GroundMotion | None, factors: Mapping[int, str], m: int) -> np.ndarray:
    """(rows, 7, m) derivatives of a motion's table by its factors, which are some directions."""
    table = ground_table(motion)
    derivatives = np.zeros((m, *table.shape))
    for j, name in factors.items():
        acceleration, time = _FACTORS[name]
        derivatives[j] = scaled(table, 1.0 + acceleration, 1.0 + time).imag / _TINY
    return np.moveaxis(derivatives, 0, -1)


# -- a number within what something was made of

_Path = tuple[Any, ...]


def _made_of(x: Any) -> dict[str, Any]:
    """The arguments of a structure, a support or a law, by name."""
    if isinstance(x, DeclaredStructure):
        return x.parameters()
    return {field.name: getattr(x, field.name) for field in fields(x)}


def _numbers(values: Mapping[str, Any]) -> Iterator[tuple[str, _Path, float]]:
    """(name, path, value) of each number in values, in lists and in supports among them."""
    for name, value in values.items():
        yield from _numbers_at(name, (name,), value)


def _numbers_at(name: str, path: _Path, value: Any) -> Iterator[tuple[str, _Path, float]]:
    if is_number(value) and np.isfinite(value):
        yield name, path, float(value)
    elif isinstance(value, tuple | list):
        for i, item in enumerate(value):
            yield from _numbers_at(f"{name}[{i}]", (*path, i), item)
    elif is_dataclass(value) and not isinstance(value, type):
        for field, item in _made_of(value).items():
            if not isinstance(item, int):  # how many there are of something
                yield from _numbers_at(f"{name}.{field}", (*path, field), item)


def _put(value: Any, path: _Path, x: Dual) -> Any:
    """The same with x at a path."""
    if not path:
        return x
    first, rest = path[0], path[1:]
    if isinstance(value, tuple | list):
        return tuple(_put(item, rest, x) if i == first else item for i, item in enumerate(value))
    return _remade(value, path, x)


def _remade(value: Any, path: _Path, x: Dual) -> Any:
    """A structure, a support or a law made anew with x at a path."""
    made = _made_of(value)
    return type(value)(**{**made, path[0]: _put(made[path[0]], path[1:], x)})


def _turned(part: str, path: _Path) -> Turn:
    return lambda case, x: replace(case, **{part: _remade(getattr(case, part), path, x)})


# -- quantities and parameters by name


def answer(name: str, found: Tangents) -> Dual:
    """An answer with its derivatives; its name as of `sensitivity`, which says what is raised."""
    motion = _Moving(found)
    for pattern, asked in _ANSWERS.items():
        if match := re.fullmatch(pattern, name):
            return asked(motion, *match.groups())
    if name in ("number of impacts", "number of events", "outcome"):
        raise ValueError(
            f"of: the {name} has no derivative: it stays or it jumps. The time of an impact has, "
            'as "impact 3 time"'
        )
    raise ValueError(f"of: {name!r} is unknown; there are {', '.join(_EXAMPLES)}")


class _Moving:
    """A motion with its derivatives, asked for quantities at places of it."""

    def __init__(self, found: Tangents) -> None:
        self.found, self.path = found, found.motion
        self.run, self.along = found.response, found.along
        self.p = with_tangent(self.run.structure.vector, found.parameters)
        self.module = self.run.structure.module
        self.m = found.end.shape[-1]

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
        tables = ground_table(self.run.motion), ground_table(self.run.vertical)
        for rows, along in zip(tables, (self.along.horizontal, self.along.vertical), strict=True):
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
            raise ValueError(
                f"of: there is no {what} {number}: the motion has {len(some)} {what}s, from 1 on"
            )
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
    return sum(out[first:last])


_SIZES: dict[str, Callable[[Any], int]] = {
    "kinematics": lambda m: len(m.KINEMATICS),
    "energies": lambda m: len(m.ENERGIES),
    "elements": lambda m: 4 * len(m.ELEMENT_NAMES),
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
    if name not in places:
        raise ValueError(
            f"of: there are derivatives of {', '.join(places)}: {name!r} is none of them"
            f"{near(name, places)}"
        )
    return places[name]


def _extreme(motion: _Moving, which: str, name: str) -> Dual:
    """An extreme, which moves with its event, or the ground's corner, or stands still in time."""
    _told(motion.module, name)  # before steps are searched
    of = motion.run.extremes(name)
    sided = which == "greatest" or (which == "peak" and of.maximum >= -of.minimum)
    t, value = (of.maximum_time, of.maximum) if sided else (of.minimum_time, of.minimum)
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
        raise ValueError(
            f"of: {name} at {time}: the motion is known from 0 to {motion.path.last_time:.6g} s"
        )
    return motion.at_time(name, t)


def _of_event(motion: _Moving, what: str, number: str, name: str, side: str | None) -> Dual:
    k = motion.event(what, number)
    if name == "time":
        return Dual(float(motion.run.events.columns[0][k]), motion.found.event_times[k])
    return motion.at_event(name, k, side is not None)


def _overturning_time(motion: _Moving) -> Dual:
    if not motion.path.falls:
        raise ValueError(
            f"of: there is no overturning time: within its duration the motion {motion.run.outcome}"
        )
    return Dual(motion.path.last_time, motion.found.end_time)


def _rest_time(motion: _Moving) -> Dual:
    times, kinds, _ = motion.run.events.columns
    rests = np.flatnonzero(kinds[:, 0] == REST)
    if not len(rests):
        raise ValueError("of: there is no rest time: no limit of infinitely many impacts was met")
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
