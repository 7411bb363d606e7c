"""A statement of the thesis, what it is compared with, and the one rule that judges it.

A statement quotes the thesis and turns its words into limits on a number. A function finds that
number from independent evidence: a table or a data file, a closed form, a simulation with the
thesis's own inputs. Where an input is known within a range only, the function returns the range of
its result. The rule:

- holds: all that was found lies within the limits;
- differs: something lies outside, over the whole range of the inputs;
- open: the range lies on both sides of a limit, or an input is lost.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from decimal import Decimal
from enum import Enum
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.identification import fit
from rockeom.numbers.checks import InputError


class Verdict(Enum):
    """Verdict on a statement."""

    HOLDS = "holds"
    DIFFERS = "differs"
    OPEN = "open"


# --- limits


@dataclass(frozen=True, eq=False)
class Limits:
    """Numbers that a statement allows, both ends included.

    Parameters
    ----------
    low : ndarray
        Lower ends (n,), one for every number that the statement has.
    high : ndarray
        Upper ends (n,).
    unit : str
        Unit as on the page.
    why : str
        How the limits follow from the printed words.
    """

    low: np.ndarray
    high: np.ndarray
    unit: str
    why: str

    def __str__(self) -> str:
        ends = list(dict.fromkeys(map(_interval, zip(self.low, self.high, strict=True))))
        unit = f" {self.unit}" if self.unit else ""
        return f"{', '.join(ends)}{unit} ({self.why})"

    def judge(self, finding: Finding) -> Verdict:
        """The verdict on a finding; ValueError if the numbers are not as many as printed."""
        if finding.low.shape != self.low.shape:
            raise ValueError(f"{finding.low.size} numbers for {self.low.size} printed")
        if np.any((finding.high < self.low) | (finding.low > self.high)):
            return Verdict.DIFFERS
        inside = (finding.low >= self.low) & (finding.high <= self.high)
        return Verdict.HOLDS if np.all(inside) else Verdict.OPEN

    def excluding(self, finding: Finding) -> Limits:
        """The limits after the first printed number changed just beyond a finding."""
        width = 1e-9 * (1.0 + abs(finding.low[0]) + abs(finding.high[0]))
        up = finding.high[0] - self.low[0] + width
        down = finding.low[0] - self.high[0] - width
        by = up if math.isfinite(self.low[0]) else down
        change = np.zeros(self.low.shape)
        change[0] = by
        return replace(self, low=self.low + change, high=self.high + change)


def _interval(pair: tuple[float, float]) -> str:
    low, high = pair
    if low == high:
        return f"{low:g}"
    if math.isinf(high):
        return f"at least {low:g}"
    if math.isinf(low):
        return f"at most {high:g}"
    return f"{low:g} to {high:g}"


def near(value: ArrayLike, within: ArrayLike, unit: str = "", *, why: str) -> Limits:
    """Printed numbers (n,), each within a distance."""
    number, distance = np.broadcast_arrays(np.atleast_1d(np.asarray(value, float)), within)
    return Limits(number - distance, number + distance, unit, why)


def rounded(*numbers: str, unit: str = "", why: str = "half of the last digit") -> Limits:
    """Printed numbers as they are on the page, such as "0.720": each may be off by half a digit."""
    exact = [Decimal(number) for number in numbers]
    half = [float(Decimal("0.5").scaleb(int(x.as_tuple().exponent))) for x in exact]
    return near([float(x) for x in exact], half, unit, why=why)


def about(value: ArrayLike, unit: str = "", *, why: str) -> Limits:
    """Printed numbers (n,), each within 10 %; `why` is the word of the page, such as "roughly"."""
    return near(value, 0.1 * np.abs(value), unit, why=f"{why}: 10 %")


def between(low: ArrayLike, high: ArrayLike, unit: str = "", *, why: str) -> Limits:
    """A printed range, or one for each number (n,)."""
    first, last = (np.atleast_1d(np.asarray(end, float)) for end in (low, high))
    return Limits(first, last, unit, why)


def at_least(value: ArrayLike, unit: str = "", *, why: str) -> Limits:
    """Printed numbers that are exceeded or reached."""
    low = np.asarray(value, float)
    return between(low, np.full(low.shape, math.inf), unit, why=why)


def at_most(value: ArrayLike, unit: str = "", *, why: str) -> Limits:
    """Printed numbers that are not exceeded."""
    high = np.asarray(value, float)
    return between(np.full(high.shape, -math.inf), high, unit, why=why)


# --- evidence


class Origin(Enum):
    """Origin of what a statement is compared with."""

    PRINTED = "printed"  # another place of the thesis: a table, a list under a figure, a sentence
    DATA = "data"  # a data file: Table A-1, a recorded motion, a publication
    CLOSED_FORM = "closed form"  # an equation, evaluated or derived
    SIMULATION = "simulation"  # a motion integrated here


class Evidence(NamedTuple):
    """One side of a comparison.

    Parameters
    ----------
    origin : Origin
        Origin.
    name : str
        Name, such as "Table 4-2, run 5".
    """

    origin: Origin
    name: str

    def __str__(self) -> str:
        return f"{self.name} ({self.origin.value})"


def printed(name: str) -> Evidence:
    """Numbers printed elsewhere in the thesis: the table and its cell, the figure, the section."""
    return Evidence(Origin.PRINTED, name)


def data(name: str) -> Evidence:
    """A data file of the package, a recorded motion or a publication."""
    return Evidence(Origin.DATA, name)


def closed_form(name: str) -> Evidence:
    """An equation evaluated."""
    return Evidence(Origin.CLOSED_FORM, name)


def simulation(name: str) -> Evidence:
    """A motion integrated here."""
    return Evidence(Origin.SIMULATION, name)


class Finding(NamedTuple):
    """Finding of a comparison.

    Parameters
    ----------
    low : ndarray
        Lower ends (n,).
    high : ndarray
        Upper ends (n,), equal to the lower ones without a range.
    words : str
        Text with units.
    """

    low: np.ndarray
    high: np.ndarray
    words: str


def finding(value: ArrayLike, words: str) -> Finding:
    """One number for each printed one, (n,); ValueError if one is not a number."""
    values = np.atleast_1d(np.asarray(value, float))
    return _checked(values, values, words)


def ranging(values: ArrayLike, words: str) -> Finding:
    """The range of a number (m,), or of n numbers (m, n), over inputs known within limits only.

    `words` names what was varied, and how far.
    """
    every = np.asarray(values, float)
    return _checked(np.atleast_1d(every.min(axis=0)), np.atleast_1d(every.max(axis=0)), words)


def slope_of(r: np.ndarray, speed: np.ndarray, first: float) -> Finding:
    """The slope of ratios r (n,) against speeds (n,) [m/s] over half the width of its interval.

    first : a ratio to begin the fit with.
    """
    line = fit(lambda r, slope: r + slope * speed, r, {"r": first, "slope": 0.0})
    low, high = line.interval("slope")
    return finding(
        abs(low + high) / (high - low), f"slope {low:+.2f} to {high:+.2f} s/m with 95 % confidence"
    )


def unknown(words: str) -> Finding:
    """A text alone, where no number can be found, since an input is lost."""
    return Finding(np.empty(0), np.empty(0), words)


def _checked(low: np.ndarray, high: np.ndarray, words: str) -> Finding:
    if not (np.all(np.isfinite(low)) and np.all(np.isfinite(high))):
        raise ValueError(f"not a number among {low} to {high}: {words}")
    return Finding(low, high, words)


# --- statements


@dataclass(frozen=True, eq=False)
class Statement:
    """Statement of the thesis and the way to judge it.

    Parameters
    ----------
    place : str
        Section, table, figure or equation of the thesis.
    words : str
        Words there, quoted as far as that is possible.
    limits : Limits
        Numbers that the words allow.
    evidence : tuple of Evidence
        Data with which it is compared; of two, the agreement of one with the other is measured.
    find : callable
        Function that gives the finding.
    figure : str, optional
        Number of the figure that shows it; "" if none does.
    lost : str, optional
        Input without which it cannot be judged; "" if all are at hand.
    slip : bool, optional
        Whether the printed words are an error of the text, with the finding as the correction.
    """

    place: str
    words: str
    limits: Limits
    evidence: tuple[Evidence, ...]
    find: Callable[[], Finding]
    figure: str = field(default="", kw_only=True)
    lost: str = field(default="", kw_only=True)
    slip: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        origins = [one.origin for one in self.evidence]
        if not 1 <= len(origins) <= 2:
            raise ValueError(f"{self.place}: one or two pieces of evidence, not {len(origins)}")
        if origins == [Origin.SIMULATION, Origin.SIMULATION]:
            raise ValueError(
                f"{self.place}: both sides are simulated here, which says nothing of the thesis"
            )

    @property
    def function(self) -> str:
        """Full name of the function that finds the number, with its arguments if it has any."""
        if isinstance(self.find, partial):
            of, arguments = self.find.func, f"({', '.join(map(repr, self.find.args))})"
        else:
            of, arguments = self.find, ""
        return f"{of.__module__}.{of.__qualname__}{arguments}"

    def judged(self) -> Judgement:
        """The statement judged; open where a record that it needs is not at hand."""
        try:
            finding = self.find()
        except InputError as error:
            return Judgement(self, None, Verdict.OPEN, str(error))
        if self.lost:
            return Judgement(self, finding, Verdict.OPEN, f"{self.lost}; {finding.words}")
        return Judgement(self, finding, self.limits.judge(finding), finding.words)


@dataclass(frozen=True)
class Judgement:
    """Statement with its verdict.

    Parameters
    ----------
    statement : Statement
        Statement.
    finding : Finding
        Finding; None where it is open.
    verdict : Verdict
        Verdict.
    words : str
        Text of the finding, or of the input that is missing.
    """

    statement: Statement
    finding: Finding | None
    verdict: Verdict
    words: str

    @property
    def source(self) -> str:
        """Evidence that the statement was compared with, and the function that did it."""
        of = self.statement
        return f"{' against '.join(map(str, of.evidence))}, by {of.function}"


class Register:
    """The statements of one module, in their order; called, it adds one.

        statement = Register()

        @statement("4.5", "a drift of 1.5%", near(1.5, 0.05, "%", why="..."), printed("Table 4-2"))
        def largest_drift() -> Found: ...

    `find` of a statement is the decorated function, whose name is shown with the verdict.
    """

    def __init__(self) -> None:
        self.statements: list[Statement] = []

    def __call__(
        self, place: str, words: str, limits: Limits, *evidence: Evidence,
        figure: str = "", lost: str = "", slip: bool = False,
    ) -> Callable[[Callable[[], Finding]], Callable[[], Finding]]:  # fmt: skip
        def add(find: Callable[[], Finding]) -> Callable[[], Finding]:
            self.statements.append(
                Statement(place, words, limits, evidence, find, figure=figure, lost=lost, slip=slip)
            )
            return find

        return add
