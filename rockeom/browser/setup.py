"""The set-up of a case as a text: from the sliders to the numbers that the loop integrates.

A case is traced at some places of the sliders. Each way that it goes there is a function of the
text, which returns 0 where one of the conditions of the way fails. At thousands of places, spread
over the ranges of all sliders, the numbers are then compared with those of Python.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from rockeom.browser.controls import Controls
from rockeom.browser.places import (
    NUMBERS,
    OF_END,
    OF_FALLEN,
    OF_LAW,
    OF_MODE,
    OF_QUIET,
    OF_RATIO,
    OF_ROWS_T,
    OF_ROWS_X,
    OF_ROWS_Y,
    OF_SIZE,
)
from rockeom.browser.program import functions
from rockeom.browser.traced import (
    COMPARISONS,
    OWN,
    Condition,
    Lines,
    Node,
    Tape,
    UntracedError,
    node_of,
    number_text,
    plain,
    skeleton,
)
from rockeom.compiler.modules import Text
from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers.checks import InputError
from rockeom.simulation.case import Case, Problem
from rockeom.simulation.ground import COMPONENTS

PLACES = 2048
"""Places of the sliders at which a set-up is compared with Python's."""
MOST_WAYS = 48
LONG_TABLE = 8
"""Rows of a ground motion beyond which they are written by a loop."""
_NONE = np.empty(0)
NEAR = 1e-12
"""Relative difference that is left by elementary functions of our own."""


@dataclass(frozen=True)
class Way:
    """A function of the set-up, for the sliders that go this way. sizes : of p, and of the rows."""

    name: str
    text: str
    sizes: tuple[int, ...]

    def compiled(self, controls: int, states: int) -> Callable[[np.ndarray], Numbers | None]:
        """The way as machine code: its numbers, or None for sliders that go another one.

        Each is compiled by itself: the next one adds nothing to the time of those before.
        """
        text = Text(self.name, _HEAD + self.text + _CALLED.format(self.name))
        way = functions((text,))["way_at"]
        size, numbers, *rows = self.sizes
        x, t, y = (np.zeros((n, 7)) for n in rows)
        made = Numbers(np.zeros(states), np.zeros(size), x, t, y, np.zeros(numbers))
        bound = way.bound(np.zeros(controls), *made)

        def run(sliders: np.ndarray) -> Numbers | None:
            bound["sliders"] = sliders
            return made if bound() > 0 else None

        return run


class Numbers(NamedTuple):
    """A problem in arrays, of a text or of Python.

    numbers : see `places`, and the vertices of bodies in space whose surface depends on sliders.
    """

    y: np.ndarray
    p: np.ndarray
    horizontal: np.ndarray
    transverse: np.ndarray
    vertical: np.ndarray
    numbers: np.ndarray


@dataclass(frozen=True)
class Setup:
    """The ways of a case, which is a function of the values of the controls.

    varied : names of the bodies in space whose surface depends on sliders.
    """

    case: Callable[..., Case]
    controls: Controls
    module: GeneratedModule
    ways: list[Way] = field(default_factory=list)
    varied: list[str] = field(default_factory=list)
    _runs: list[Callable[[np.ndarray], Numbers | None]] = field(default_factory=list)

    @property
    def sizes(self) -> tuple[int, ...]:
        """Sizes of arrays that are enough for all ways: p, numbers, rows of the ground motions."""
        p, numbers, *rows = map(max, zip(*(way.sizes for way in self.ways), strict=True))
        return (p, numbers, *(max(n, 1) for n in rows))

    def vertices(self, case: Case) -> np.ndarray:
        """Coordinates of the surfaces that depend on sliders, one after the other."""
        of = [case.structure.solids[name].vertices.ravel() for name in self.varied]
        return np.concatenate([*of, np.empty(0)])

    @property
    def text(self) -> Text:
        """All ways, and `set_up`, which returns the number of the way that was gone, or -1."""
        tried = "".join(
            f"    if {way.name}({_ARGUMENTS}) > 0:\n        return {i}\n"
            for i, way in enumerate(self.ways)
        )
        ways = "".join(way.text for way in self.ways)
        last = f"def set_up({_ARGUMENTS}):\n{tried}    return -1\n"
        return Text("the set-up of the page", _HEAD + ways + last)

    def numbers(self, sliders: np.ndarray) -> Numbers | None:
        """The numbers of a case, until the next; None where no way that is known is gone."""
        for way in self.ways[len(self._runs) :]:
            self._runs.append(way.compiled(len(self.controls.of), len(self.module.STATES)))
        for run in self._runs:
            if (made := run(sliders)) is not None:
                return made
        return None


_ARGUMENTS = "sliders, y, p, horizontal, transverse, vertical, numbers"
_OWN = ", ".join(f"own_{name}" for name in OWN)
_HEAD = f"""import math

import numpy as np

from rockeom.browser.elementary import {_OWN}
from rockeom.compiler.decorators import Floats, Floats2, entry


"""
_CALLED = """

@entry
def way_at(
    sliders: Floats, y: Floats, p: Floats, horizontal: Floats2, transverse: Floats2,
    vertical: Floats2, numbers: Floats,
) -> int:
    return {}(sliders, y, p, horizontal, transverse, vertical, numbers)
"""


@np.errstate(divide="raise", invalid="raise")  # a division by zero is refused as other numbers are
def setup_of(case: Callable[..., Case], controls: Controls) -> Setup:
    """The set-up of a case for all values of its controls.

    Raises UntracedError where a page could not repeat what the case does, or where at one of the
    places it gives other numbers than Python.
    """
    first = case(**controls.named(controls.start))
    first.problem()  # a first case that cannot be is for the caller to mend
    setup = Setup(case, controls, first.structure.module)
    for place in controls.combinations():
        _go(setup, place)
    for place in (*controls.special(), *controls.spread(PLACES)):
        _compare(setup, place)
    return setup


def _go(setup: Setup, place: np.ndarray) -> bool:
    """Add the way that the case goes at a place; False where Python refuses the case there."""
    named = setup.controls.named(place)
    try:
        case = setup.case(**named)
        case.problem()
    except (ValueError, ArithmeticError):
        return False
    if case.structure.module is not setup.module:
        raise UntracedError(
            f"a page has the equations of one structure, and the case is a {setup.module.NAME} or "
            f"a {case.structure.module.NAME}: make a page of each"
        )
    if len(setup.ways) == MOST_WAYS:
        raise UntracedError(
            f"the case goes more than {MOST_WAYS} ways: narrow the ranges of the sliders"
        )
    setup.ways.append(_way(setup, place, len(setup.ways)))
    return True


def _compare(setup: Setup, place: np.ndarray) -> None:
    """Raise UntracedError where the numbers of the set-up are not those of Python.

    Where no known way is gone, the case is traced.
    """
    made, named = setup.numbers(place), setup.controls.named(place)
    try:
        case = setup.case(**named)
        wanted = case.problem()
    except (ValueError, ArithmeticError) as error:
        if made is not None:
            raise UntracedError(
                f"a page would show the case at {named}, which is refused: {error}; let no slider "
                "reach there"
            ) from None
        return
    if made is None:
        _go(setup, place)
        made = setup.numbers(place)
    if made is None:
        raise UntracedError(f"the way that the case goes at {named} is not gone there again")
    if (wrong := difference(made, wanted, setup.vertices(case))) is not None:
        raise UntracedError(
            f"at {named} {wrong} of the page is not that of Python: a number was taken from a "
            "slider in a way that is not recorded"
        )


def difference(made: Numbers, wanted: Problem, vertices: np.ndarray = _NONE) -> str | None:
    """The first part of a problem in which two set-ups differ by more than rounding, in words."""
    p, tables = wanted.p(), (wanted.horizontal, wanted.transverse, wanted.vertical)
    exact = (wanted.mode, wanted.law, *map(len, tables), len(p))
    places = (OF_MODE, OF_LAW, OF_ROWS_X, OF_ROWS_T, OF_ROWS_Y, OF_SIZE)
    if tuple(int(made.numbers[i]) for i in places) != exact:
        return "the mode, the impact law or the length of a table"
    ratio = 0.0 if math.isnan(wanted.ratio) else wanted.ratio
    rest = np.array([ratio, wanted.fallen, wanted.end, wanted.quiet_from])
    pairs = {
        "the initial state": (made.y, wanted.y0),
        "the parameters": (made.p[: len(p)], p),
        "the ground motion": (made.horizontal[: len(tables[0])], wanted.horizontal),
        "the transverse ground motion": (made.transverse[: len(tables[1])], wanted.transverse),
        "the vertical ground motion": (made.vertical[: len(tables[2])], wanted.vertical),
        "the shape": (made.numbers[NUMBERS : NUMBERS + len(vertices)], vertices),
        "the ratio of the impacts, the bound of overturning or the duration": (
            made.numbers[[OF_RATIO, OF_FALLEN, OF_END, OF_QUIET]], rest,
        ),
    }  # fmt: skip
    for words, (a, b) in pairs.items():
        if a.tobytes() == b.tobytes():  # in a hundredth of the time
            continue
        scale = np.abs(b).max(initial=0.0, where=np.isfinite(b))
        if not np.allclose(a, b, rtol=NEAR, atol=NEAR * scale, equal_nan=True):
            return words
    return None


# --- the text of a way


def _way(setup: Setup, place: np.ndarray, number: int) -> Way:
    tape = Tape()
    case = setup.case(**setup.controls.traced(tape, place))
    if not case.ground.is_level:
        raise InputError("slope", of="explorer").says(
            "a page has level ground: leave {slope} out, and simulate the case in Python"
        )
    try:
        problem = case.problem()
    except UntracedError:
        raise
    except TypeError as error:
        raise UntracedError(
            f"{case.structure.model} takes a slider in a way that is not recorded: {error}"
        ) from error
    solids = case.structure.solids
    setup.varied[:] = [name for name, of in solids.items() if of.vertices.dtype == object]
    vertices = setup.vertices(case)
    lines = Lines()
    tables = _conditions(lines, list(tape.conditions), number)
    p = [*problem.vector, *problem.table]
    for i, x in enumerate(problem.y0):
        lines.lines.append(f"y[{i}] = {lines.name(node_of(x))}")
    for i, x in enumerate(p):
        lines.lines.append(f"p[{i}] = {lines.name(node_of(x))}")
    for name in COMPONENTS:
        tables += _table(lines, name, getattr(problem, name), number)
    ratio = 0.0 if math.isnan(plain(problem.ratio)) else problem.ratio
    rows = tuple(len(getattr(problem, name)) for name in COMPONENTS)
    numbers = (
        problem.mode, problem.law, ratio, problem.fallen, problem.end, problem.quiet_from, *rows,
        len(p), *vertices,
    )  # fmt: skip
    for i, x in enumerate(numbers):
        lines.lines.append(f"numbers[{i}] = {lines.name(node_of(x))}")
    body = "\n".join(f"    {line}" for line in [*lines.lines, "return 1"])
    name = f"way_{number}"
    head = f"def {name}({_ARGUMENTS}):\n"
    return Way(name, "".join([*tables, head, body, "\n\n\n"]), (len(p), len(numbers), *rows))


def _conditions(lines: Lines, conditions: list[Condition], number: int) -> list[str]:
    """Write the lines that leave a way where a condition fails; returns the constants they read.

    Conditions that differ in their numbers alone, such as of every sample of a record, are a loop.
    """
    alike: dict[Any, list[tuple[Condition, list[float]]]] = {}
    for one in conditions:
        numbers: list[float] = []
        shapes = tuple(skeleton(x, numbers) for x in (one.left, one.right))
        alike.setdefault((one.comparison, one.holds, shapes), []).append((one, numbers))
    constants = []
    for k, ((comparison, holds, shapes), rows) in enumerate(alike.items()):
        if len(rows) <= LONG_TABLE:
            for one, _ in rows:
                text = f"{lines.name(one.left)} {COMPARISONS[comparison]} {lines.name(one.right)}"
                lines.lines += [f"if {'not ' if holds else ''}({text}):", "    return 0"]
            continue
        texts, read = _varied(np.array([row for _, row in rows]), f"CONDITION_{number}_{k}")
        constants += read
        of = iter(texts)
        left, right = (_expression(lines, shape, of) for shape in shapes)
        text = f"({left}) {COMPARISONS[comparison]} ({right})"
        lines.lines += [
            f"for i in range({len(rows)}):",
            f"    if {'not ' if holds else ''}({text}):", "        return 0",
        ]  # fmt: skip
    return constants


def _varied(data: np.ndarray, name: str) -> tuple[list[str], list[str]]:
    """The numbers of many rows as expressions of row i, and the constants that these read."""
    constants, texts = [], []
    for k, values in enumerate(data.T):
        if (values == values[0]).all():
            texts.append(number_text(values[0]))
            continue
        if (step := values[1] - values[0]) > 0.0:  # equal times, of a record
            first = round(values[0] / step)
            if (values == step * (first + np.arange(len(values)))).all():
                texts.append(f"{number_text(step)} * float(i + {first})")
                continue
        constants.append(f"{name}_{k} = np.array({values.tolist()!r})\n")
        texts.append(f"{name}_{k}[i]")
    return texts, constants


def _table(lines: Lines, name: str, table: np.ndarray, number: int) -> list[str]:
    """Write the lines that fill a ground motion; returns the constants that they read.

    Rows that follow one another and whose operations are the same are a loop. Raises UntracedError
    where most of many are not.
    """
    if len(table) <= LONG_TABLE:
        return _rows(lines, name, table, 0)
    alike = [[_shape(x) for x in row] for row in table]
    starts = [0, *(i for i in range(1, len(table)) if alike[i] != alike[i - 1]), len(table)]
    if len(starts) > LONG_TABLE:
        raise UntracedError("the rows of the ground motion are not all calculated alike")
    constants = []
    for start, end in itertools.pairwise(starts):
        if end - start <= LONG_TABLE:
            _rows(lines, name, table[start:end], start)
            continue
        inside = []
        for j, column in enumerate(table[start:end].T):
            text, read = _column(lines, column, f"{name.upper()}_{number}_{start}_{j}")
            constants += read
            inside.append(f"    {name}[i{f' + {start}' if start else ''}, {j}] = {text}")
        lines.lines += [f"for i in range({end - start}):", *inside]
    return constants


def _rows(lines: Lines, name: str, table: np.ndarray, start: int) -> list[str]:
    """Write rows one by one, from number start on; they read no constants."""
    for (i, j), x in np.ndenumerate(table):
        lines.lines.append(f"{name}[{start + i}, {j}] = {lines.name(node_of(x))}")
    return []


def _shape(x: Any) -> Any:
    return skeleton(node_of(x), [])


def _column(lines: Lines, column: np.ndarray, name: str) -> tuple[str, list[str]]:
    """A column of many rows, whose operations are the same, as an expression of its row i."""
    of_rows: list[list[float]] = [[] for _ in column]
    shapes = {skeleton(node_of(x), row) for x, row in zip(column, of_rows, strict=True)}
    (shape,) = shapes
    texts, constants = _varied(np.array(of_rows), name)
    return _expression(lines, shape, iter(texts)), constants


def _expression(lines: Lines, shape: Any, texts: Iterator[str]) -> str:
    """An expression of a skeleton, with texts for its numbers."""
    if shape is None:
        return next(texts)
    if isinstance(shape, Node):
        return lines.name(shape)
    operation, *of = shape
    return lines.expression(operation, [f"({_expression(lines, x, texts)})" for x in of])
