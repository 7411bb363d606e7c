"""A statement of the thesis, what it is compared with, and the one rule that judges it.

A statement quotes the thesis and turns its words into limits on a number. A function finds that
number from independent evidence: a table or a data file, a closed form, a simulation with the
thesis's own inputs. Where an input is known within a range only, the function returns the range of
its result. The rule:

- holds: all that was found lies within the limits;
- differs: something lies outside, over the whole range of the inputs;
- open: the range lies on both sides of a limit, or an input is lost.

A range, a share or a mean of more tests than are printed is open. A trend or a difference is judged
on those that are printed, where they decide it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from enum import Enum
from importlib import import_module
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
        Lower ends (n,), one for every number that the statement has, or one for all, (1,).
    high : ndarray
        Upper ends (n,) or (1,).
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
        if finding.low.size != self.low.size and (self.low.size > 1 or finding.low.size == 0):
            raise ValueError(f"{finding.low.size} numbers for {self.low.size} printed")
        if np.any((finding.high < self.low) | (finding.low > self.high)):
            return Verdict.DIFFERS
        inside = (finding.low >= self.low) & (finding.high <= self.high)
        return Verdict.HOLDS if np.all(inside) else Verdict.OPEN


def _interval(pair: tuple[float, float]) -> str:
    low, high = pair
    if low == high:
        return f"{low:g}"
    if math.isinf(high):
        return f"at least {low:g}"
    if math.isinf(low):
        return f"at most {high:g}"
    return f"{low:g} to {high:g}"


_ITEM = re.compile(
    r"(?P<sign>[<>]?=)? ?(?P<first>-?[\d.e-]+)"
    r"(?: to (?P<last>-?[\d.e-]+))?(?: \+- (?P<off>[\d.e-]+)(?P<percent> %)?)?"
)


def limits(text: str, unit: str = "", why: str = "") -> Limits:
    """Limits as the table writes them, one for each printed number, with commas between them.

    "0.720" allows half of its last digit, "5 +- 0.5" and "5, 7 +- 10 %" a distance, "0.72 to 0.97"
    a range, ">= 20", "<= 0.8" one side, and "= 2" nothing else. Limits of one number hold for all
    that are found.

    ValueError for a text that is none of these.
    """
    items = [_ITEM.fullmatch(item) for item in text.split(", ")]
    if None in items:
        raise ValueError(f"limits {text!r}: neither a number, a range nor a side")
    ends = [_ends(item, items[-1]) for item in items if item and items[-1]]
    low, high = np.array(ends).T
    return Limits(low, high, unit, why)


def _ends(item: re.Match[str], last: re.Match[str]) -> tuple[float, float]:
    """Both ends of one item; a distance behind the last item is that of all."""
    number = float(item["first"])
    if item["sign"]:
        return {
            "=": (number, number), ">=": (number, math.inf), "<=": (-math.inf, number),
        }[item["sign"]]  # fmt: skip
    if item["last"]:
        return number, float(item["last"])
    of = item if item["off"] else last
    if of["off"]:
        distance = float(of["off"]) * (abs(number) / 100 if of["percent"] else 1.0)
    else:
        distance = float(Decimal("0.5").scaleb(int(Decimal(item["first"]).as_tuple().exponent)))
    return number - distance, number + distance


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


def evidence(text: str) -> tuple[Evidence, ...]:
    """Evidence as the table writes it, "closed form: 2-6 | printed: Table 2-1"; ValueError else."""
    pairs = (one.partition(": ") for one in text.split(" | "))
    return tuple(Evidence(Origin(origin), name) for origin, _, name in pairs)


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
    """Statement of the thesis and the way to judge it: a row of the table.

    Parameters
    ----------
    place : str
        Section, table, figure or equation of the thesis.
    figure : str
        Number of the figure that shows it; "" if none does.
    words : str
        Words there, quoted; "..." stands for words left out.
    scan : str
        The same words as the scanned text has them where it is garbled; "" where it is not.
    limits : Limits
        Numbers that the words allow.
    evidence : tuple of Evidence
        Data with which it is compared; of two, the agreement of one with the other is measured.
    lost : str
        Input without which it cannot be judged; "" if all are at hand.
    correction : str
        What should stand there, where the printed words are an error of the text; "" else.
    function : str
        Function that gives the finding, of a module of `rockeom.thesis.statements`, with its
        arguments if it has any: "chapter_4_runs.peaks_of_run(1; SDOF)".
    """

    place: str
    figure: str
    words: str
    scan: str
    limits: Limits
    evidence: tuple[Evidence, ...]
    lost: str
    correction: str
    function: str

    def __post_init__(self) -> None:
        origins = [one.origin for one in self.evidence]
        if not 1 <= len(origins) <= 2:
            raise ValueError(f"{self.place}: one or two pieces of evidence, not {len(origins)}")
        if origins == [Origin.SIMULATION, Origin.SIMULATION]:
            raise ValueError(
                f"{self.place}: both sides are simulated here, which says nothing of the thesis"
            )

    def find(self) -> Finding:
        """The finding of its function."""
        name, _, arguments = self.function.removesuffix(")").partition("(")
        module, _, function = name.rpartition(".")
        of = getattr(import_module(f"rockeom.thesis.statements.{module}"), function)
        return of(*filter(None, arguments.split("; ")))

    def judged(self) -> Judgement:
        """The statement judged; open where a record that it needs is not at hand."""
        try:
            finding = self.find()
        except InputError as error:
            return Judgement(self, None, Verdict.OPEN, str(error))
        if self.lost:
            return Judgement(self, finding, Verdict.OPEN, f"{self.lost}; {finding.words}")
        return Judgement(self, finding, self.limits.judge(finding), finding.words)


def from_row(row: Mapping[str, str]) -> Statement:
    """A statement of a row of the table; ValueError that names its place if it cannot be read."""
    try:
        return Statement(
            place=row["place"],
            figure=row["figure"],
            words=row["quotation"],
            scan=row["scan"],
            limits=limits(row["limits"], row["unit"], row["why"]),
            evidence=evidence(row["evidence"]),
            lost=row["lost"],
            correction=row["correction"],
            function=row["function"],
        )
    except ValueError as error:
        raise ValueError(f"{row['place']}, {row['function']}: {error}") from None


@dataclass(frozen=True)
class Judgement:
    """Statement with its verdict.

    Parameters
    ----------
    statement : Statement
        Statement.
    finding : Finding
        Finding; None where a record is missing.
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

    @property
    def conclusion(self) -> str:
        """The verdict, and the right words where the printed ones are an error of the text."""
        right = self.statement.correction
        return self.verdict.value + (f", an error of the text; right: {right}" if right else "")
