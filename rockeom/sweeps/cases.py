"""The cases of a sweep: the values of each, and their making, one by one or many at once."""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers.batch import Differs, Many
from rockeom.numbers.checks import InputError, InputTypeError, described, is_number, number
from rockeom.simulation.case import Case, Problem, Problems, without_duals
from rockeom.structures.units import in_udunits
from rockeom.sweeps.case_numbers import OtherCase

FEW, MANY = 256, 2048
"""Cases in a batch at most; and where they are made at once and run within a second."""

LAST_FEW, LAST_MANY = 32, 256
"""The least number of cases in a batch, in the end, of both. A batch costs as much as some 60
pulses, since the lanes run empty behind it."""

WORTHWHILE = 12
"""Number of cases from which making them at once is faster than one by one."""

ROW = "case"
"""Name of the rows of a table."""


@dataclass(frozen=True)
class Cases:
    """The values that the names of a sweep have in each of its cases.

    values : of each name, those that occur.
    which : of a table, the places (n,) in `values` of what each row has, by name; None for a grid,
        whose cases are all combinations, those of the last name next to one another.
    attrs : of each name, what was given with its values, such as their units.
    """

    values: Mapping[str, Sequence[Any] | np.ndarray]
    which: Mapping[str, np.ndarray] | None = None
    attrs: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    @classmethod
    def of(cls, over: Any) -> Cases:
        """A grid of a mapping, a table of rows; raises TypeError or ValueError for neither."""
        if isinstance(over, Mapping) and not isinstance(over, xr.Dataset):
            return _grid(over)
        return _table(over)

    @property
    def dims(self) -> tuple[str, ...]:
        return tuple(self.values) if self.which is None else (ROW,)

    @property
    def shape(self) -> tuple[int, ...]:
        if self.which is None:
            return tuple(map(len, self.values.values()))
        return (len(next(iter(self.which.values()))),)

    @property
    def total(self) -> int:
        return math.prod(self.shape)

    def places(self, rows: np.ndarray) -> tuple[np.ndarray, ...]:
        """Places of the values of the rows, for each name."""
        if self.which is None:
            return np.unravel_index(rows, self.shape)
        return tuple(places[rows] for places in self.which.values())

    def named(self, row: int) -> dict[str, Any]:
        """The value of each name in one case."""
        places = (int(place[0]) for place in self.places(np.array([row])))
        return {name: self.values[name][i] for name, i in zip(self.values, places, strict=True)}

    def name(self, error: Exception, named: Mapping[str, Any]) -> None:
        """Let an error say by the values of each name, with their units, which case it is of."""
        units = {name: self.attrs.get(name, {}).get("units", "-") for name in named}
        values = {
            n: _short(v) + f" {units[n]}" * (is_number(v) and units[n] not in "-1")
            for n, v in named.items()
        }
        case = f"case {', '.join(f'{name} = {value}' for name, value in values.items())}"
        if isinstance(error, InputError):
            error.case = case
        elif error.args == (str(error),):
            error.args = (f"{case}: {error}",)
        else:  # one with a text of its own
            error.add_note(f"in the {case}")

    def part(self, rows: np.ndarray) -> Cases:
        """The table of some rows, which holds no values but theirs: small enough to be sent."""
        values, which = {}, {}
        for (name, of), place in zip(self.values.items(), self.places(rows), strict=True):
            used, which[name] = np.unique(place, return_inverse=True)
            values[name] = _packed([of[i] for i in used.tolist()])
        return Cases(values, which, self.attrs)

    def coordinates(self) -> dict[str, Any]:
        """The variables of a dataset that say what the cases are."""
        variables: dict[str, Any] = {}
        if self.which is not None:
            variables[ROW] = ROW, np.arange(self.total), {"long_name": "row of the table"}
        for name, values in self.values.items():
            distinct = labels(values)
            attrs = {"long_name": name.replace("_", " "), **self.attrs.get(name, {})}
            if self.which is None:
                variables[name] = name, distinct, attrs
            else:
                variables[name] = ROW, np.asarray(distinct)[self.which[name]], attrs
        return variables


def _grid(over: Mapping[Any, Any]) -> Cases:
    _check_names([*over])
    for name, values in over.items():
        one = isinstance(values, str) or getattr(values, "ndim", 1) == 0
        if one or not isinstance(values, Iterable):
            raise InputTypeError(f"over[{name!r}]", values).give("a list of values")
    lists = {name: _listed(values) for name, values in over.items()}
    _check_not_empty(lists)
    return Cases(lists, None, _attrs(over))


def _table(over: Any) -> Cases:
    if isinstance(over, list | tuple) and all(isinstance(row, Mapping) for row in over):
        columns = _of_rows(over)
    else:
        names = _column_names(over)
        _check_names(names)
        columns = {name: _listed(over[name]) for name in names}
    _check_not_empty(columns)
    if ROW in columns:
        raise InputError("over", ROW).so("rows have this name: give the column another one")
    values, which = {}, {}
    for name, column in columns.items():
        if all(is_number(value) for value in column):
            values[name], which[name] = column, np.arange(len(column))
        else:
            values[name], which[name] = _distinct(column)
    return Cases(values, which, _attrs(over) if isinstance(over, xr.Dataset) else {})


def _column_names(over: Any) -> list[Any]:
    """Columns of a dataset over one dimension, a DataFrame or a structured array."""
    if isinstance(over, xr.Dataset):
        dims = {variable.dims for variable in over.data_vars.values()}
        if any(len(of) != 1 for of in dims) or len(dims) > 1:
            raise InputError("over").wrong(
                f"is a dataset over {', '.join(map(str, over.sizes)) or 'nothing'}: a table of "
                "cases has one dimension in all its variables, that of its rows"
            )
        return [*over.data_vars]
    if getattr(over, "columns", None) is not None:
        return [*over.columns]
    if getattr(getattr(over, "dtype", None), "names", None) and np.ndim(over) == 1:
        return [*over.dtype.names]
    raise InputTypeError("over", over).give(
        'names with their values, as in {"frequency": [0.5, 1.0, 2.0]}, or a table with a case in '
        "each row, as a DataFrame or a list of dicts"
    )


def _of_rows(over: Sequence[Mapping[Any, Any]]) -> dict[str, list[Any]]:
    names = [*over[0]] if over else []
    _check_names(names)
    for i, row in enumerate(over):
        if {*row} != {*names}:
            raise InputError(f"over[{i}]").says(
                f"over[{i}] has {', '.join(map(str, row)) or 'no names'}, and over[0] has "
                f"{', '.join(map(str, names))}: give all rows of a table the same names"
            )
    return {name: [row[name] for row in over] for name in names}


def _check_names(names: list[Any]) -> None:
    for name in names:
        if not isinstance(name, str):
            raise InputTypeError("over", name).give("names of arguments of the function")
        if names.count(name) > 1:
            raise InputError("over", name).so("several columns have this name: rename all but one")


def _check_not_empty(found: Mapping[str, list[Any]]) -> None:
    if not found or not all(found.values()):
        raise InputError("over").wrong("is empty: give at least one name with at least one value")


def _listed(values: Iterable[Any]) -> list[Any]:
    return list(values.values if isinstance(values, xr.DataArray) else values)


def _attrs(over: Mapping[Any, Any]) -> dict[str, Mapping[str, Any]]:
    return {name: v.attrs for name, v in over.items() if isinstance(v, xr.DataArray)}


def _distinct(column: list[Any]) -> tuple[list[Any], np.ndarray]:
    """The objects of a column, each once, and which of them each row has."""
    places: dict[Any, int] = {}
    values: list[Any] = []
    which = np.empty(len(column), dtype=np.int64)
    for row, value in enumerate(column):
        key = value if isinstance(value, str) else id(value)
        if key not in places:
            places[key] = len(values)
            values.append(value)
        which[row] = places[key]
    return values, which


def _packed(values: list[Any]) -> list[Any] | np.ndarray:
    """The same values in few bytes, of the same types."""
    return np.array(values) if {*map(type, values)} == {np.float64} else values


def labels(values: Sequence[Any] | np.ndarray) -> list[Any]:
    """Numbers and words label themselves, other objects by their names, or else by number.

    A name that several objects have is numbered.
    """
    if all(isinstance(v, (str, int, float, np.number)) for v in values):
        return list(values)
    names = [_name(v) for v in values]
    return _told_apart(names) if all(names) else list(range(len(names)))


def _short(value: Any) -> str:
    """A value in an error: a number with the digits that tell it apart, an object by its name."""
    return f"{number('value', value):.6g}" if is_number(value) else _name(value) or described(value)


def _name(value: Any) -> str:
    """Name of a motion, a structure or another object; a word or number is its own."""
    if isinstance(value, str) or is_number(value):
        return str(value)
    name = getattr(value, "name", None) or getattr(value, "model", None)
    return name if isinstance(name, str) else ""


def _told_apart(names: list[str]) -> list[str]:
    repeated = {name for name, times in Counter(names).items() if times > 1}
    taken, numbers, labels = {*names}, Counter[str](), []
    for name in names:
        label = name
        while name in repeated and label in taken:
            numbers[name] += 1
            label = f"{name} ({numbers[name]})"
        taken.add(label)
        labels.append(label)
    return labels


def sweep_of(case: Case, cases: Cases) -> tuple[OtherCase, Cases]:
    """The function of a sweep by names, and its cases, whose values know their units."""
    other = OtherCase(case, tuple(cases.values))
    units = {name: {"units": in_udunits(n.unit)} for name, n in other.numbers.items() if n.unit}
    if "restitution" in units:
        units["restitution"]["long_name"] = "coefficient of restitution e"
    attrs = {name: {**units.get(name, {}), **cases.attrs.get(name, {})} for name in cases.values}
    return other, replace(cases, attrs=attrs)


def first_of(case: Callable[..., Case], cases: Cases) -> Case:
    """The first of some cases, which tells the structure of all."""
    named = cases.named(0)
    try:
        return made(case, named)
    except Exception as error:
        cases.name(error, named)
        raise


def made(case: Callable[..., Case], named: Mapping[str, Any]) -> Case:
    """The case that the function makes of one value of each name; TypeError for anything else."""
    one = case(**named)
    if not isinstance(one, Case):
        raise InputTypeError("case", one).says(
            f"the function of the sweep returned {described(one)}: let it return a case, "
            "rk.Case(structure, motion)"
        )
    return one


class Batch(NamedTuple):
    """Cases that a thread runs at a time, and their rows in the results.

    cases : where they were made one by one; else none. of : the cases of which these are some.
    """

    rows: np.ndarray
    problems: Problems
    cases: list[Case]
    of: Cases | None = None


@dataclass(frozen=True)
class Source:
    """Makes the cases batch by batch, when they are needed, so that none wait in memory.

    arrays : whether the function is tried for many cases at once. The result counts where the
        first, the middle and the last case are, to the bit, those of calls for each; once most of
        some cases had to be made one by one, all others are.
    rows : of the cases to make; all of them if None.
    """

    case: Callable[..., Case]
    cases: Cases
    chunk: int | None
    module: GeneratedModule
    arrays: bool
    threads: int = 1
    rows: np.ndarray | None = None

    @property
    def total(self) -> int:
        return self.cases.total if self.rows is None else len(self.rows)

    def __iter__(self) -> Iterator[Batch]:
        first, total, arrays = 0, self.total, self.arrays
        ends, started = [0], time.monotonic()
        while first < total:
            ran = ends[-self.threads] if len(ends) >= self.threads else 0  # others are under way
            many = arrays and ran > MANY * self.threads * (time.monotonic() - started)
            end = min(first + self.size(total - first, many), total)
            rows = np.arange(first, end) if self.rows is None else self.rows[first:end]
            alone = 0
            for batch in self.together(rows) if arrays else map(self.one_by_one, [rows]):
                alone += len(batch.cases)
                yield batch
            arrays &= 2 * alone <= len(rows)
            first = end
            ends.append(end)

    def size(self, left: int, many: bool) -> int:
        """How many cases a thread takes of those that are left; many : whether they run fast.

        Half of its share at first and ever fewer, but not so few that there are many parts. Cases
        may take ten times as long as others, and those that do often come last: whoever finds no
        more waits for the last part of another.
        """
        if self.chunk is not None:
            return self.chunk
        least, most = (LAST_MANY, MANY) if many else (LAST_FEW, FEW)
        if self.threads == 1:
            return most
        half = 2 * self.threads
        return max(min(left // half, most), min(least, -(-self.total // half)))

    def one_by_one(self, rows: np.ndarray) -> Batch:
        points = zip(*(place.tolist() for place in self.cases.places(rows)), strict=True)
        pairs = [self.made(point) for point in points]
        problems = Problems.of([q for _, q in pairs])
        return Batch(rows, problems, [case for case, _ in pairs], self.cases)

    def together(self, rows: np.ndarray) -> Iterator[Batch]:
        """Cases that go the same way, at once; raises the error of the first that cannot be."""
        try:
            yield from self.alike(rows)
        except Exception:  # of a case, but of which?
            for some in _few(rows):
                self.one_by_one(some)
            raise

    def alike(self, rows: np.ndarray) -> Iterator[Batch]:
        waiting, alone = [rows], []
        while waiting:
            rows, problems = waiting.pop(), None
            try:
                if len(rows) >= WORTHWHILE:
                    problems = self.checked(rows)
            except Differs as ways:
                waiting += [rows[part] for part in reversed(ways.parts)]
                continue
            except Exception:  # a case that raises it says so, if there is one
                problems = None
            if problems is None:
                alone.append(rows)
            else:
                yield Batch(rows, problems, [])
        if alone:
            yield from map(self.one_by_one, _few(np.sort(np.concatenate(alone))))

    def checked(self, rows: np.ndarray) -> Problems | None:
        """Cases at once; None where they are not those that are made of each value alone."""
        problems = self.at_once(rows)
        some = [0, len(rows) // 2, -1]
        alone = self.one_by_one(rows[some]).problems
        return problems if problems.bits(some) == alone.bits(range(3)) else None

    def at_once(self, rows: np.ndarray) -> Problems:
        """Raises Differs where the rows do not all go the same way, or what one of them would."""
        named: dict[str, Any] = {}
        places = self.cases.places(rows)
        for (name, values), place in zip(self.cases.values.items(), places, strict=True):
            if name in self.numbers:
                named[name] = Many(self.numbers[name][place])
            else:
                named[name] = values[Many(place).one()]
        with np.errstate(divide="raise", over="raise", invalid="raise"):
            _, problem = self.problem(named)
            return Problems.of_many(problem, len(rows))

    @cached_property
    def numbers(self) -> dict[str, np.ndarray]:
        """The values of those names that have numbers only."""
        return {
            name: Many.of(list(values)).values
            for name, values in self.cases.values.items()
            if all(is_number(value) for value in values)
        }

    def made(self, point: tuple[int, ...]) -> tuple[Case, Problem]:
        """One case and its numbers; what goes wrong in making it says which one it was."""
        values = self.cases.values.items()
        named = {name: v[i] for (name, v), i in zip(values, point, strict=True)}
        try:
            return self.problem(named)
        except Exception as error:
            self.cases.name(error, named)
            raise

    def problem(self, named: Mapping[str, Any]) -> tuple[Case, Problem]:
        case = made(self.case, named)
        if case.structure.module is not self.module:
            name, first = case.structure.module.NAME, self.module.NAME
            others = f"another {name}, of other equations," if name == first else f"a {name}"
            raise InputError("case").says(
                f"a case is {others} than the first one, a {first}: simulate each model by itself"
            )
        return case, without_duals(case.problem())


def _few(rows: np.ndarray) -> list[np.ndarray]:
    return np.split(rows, range(FEW, len(rows), FEW))
