"""Shared by the grammars of all networks: lines by number, fixed columns, components, peaks.

A grammar is a module of this folder with two functions: `recognises`, whether the first lines of a
file are its own, and `components`, all components of such a file in SI units. It reads each line
where it must be and refuses any other with the line, what was expected there, and a remedy.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation
from typing import NamedTuple

import numpy as np

from rockeom.motion.components import azimuth_and_vertical
from rockeom.motion.formats.text import Text, number_of, numbers_of, pythonic, short
from rockeom.motion.units import factor
from rockeom.numbers.checks import InputError

LONGEST_LINE = 2_000
"""Letters of the longest line of a network's file, so that no pattern takes long."""
LARGEST = 10**9
"""No file has as many values."""
AGAIN = "download the file again, or export it in this format"
"""Remedy where a line is not what the format has there."""


class Peak(NamedTuple):
    """Peak that a header states: as it is printed, its unit, and its line.

    digit : unit of the last digit of the values, where they have fewer digits than the peak.
    """

    text: str
    unit: str
    line: int
    digit: float = 0.0


@dataclass(frozen=True)
class Component:
    """Component of a file of a network.

    Parameters
    ----------
    acceleration : ndarray
        Accelerations (n,) [m/s2].
    dt : float
        Time step [s].
    name : str
        Direction as the file has it, such as "N28W", "E-W" or "Up".
    unit : str
        Unit of the accelerations in the file.
    line : int
        Line at which the component begins.
    azimuth : float, optional
        Azimuth, clockwise from north [degrees]; None where the file gives none.
    is_vertical : bool, optional
        Whether the file says that it is vertical.
    is_down : bool, optional
        Whether it is vertical and the file has it positive downwards.
    station : str, optional
        Station, as the file names it.
    event : str, optional
        Earthquake, as the file names it.
    peak : Peak, optional
        Peak that the header states of these accelerations.
    stage : str, optional
        Stage of processing, as the file names it, such as "corrected".
    """

    acceleration: np.ndarray
    dt: float
    name: str
    unit: str
    line: int
    azimuth: float | None = None
    is_vertical: bool = False
    station: str = ""
    event: str = ""
    peak: Peak | None = None
    is_down: bool = False
    stage: str = ""

    def upward(self) -> "Component":
        """Positive upwards, where it is vertical."""
        return replace(self, acceleration=-self.acceleration) if self.is_down else self

    def directed(self) -> "Component":
        """With azimuth and direction by its name, where the file has no field of its own."""
        direction, _ = direction_and_place(self.name)
        azimuth, is_vertical = azimuth_and_vertical(direction)
        is_down = is_vertical and direction[:1].upper() == "D"
        return replace(self, azimuth=azimuth, is_vertical=is_vertical, is_down=is_down)

    def along(self, page: "Page", line: int, azimuth: int | None, is_vertical: bool) -> "Component":
        """With the direction that a field states at a line; InputError where its name contradicts.

        azimuth : clockwise from north, 1 to 360 [degrees]; None where the field states none.
        """
        named = self.directed()
        if (azimuth and named.is_vertical) or (is_vertical and named.azimuth is not None):
            stated = f"an azimuth of {azimuth}" if azimuth else "a vertical component"
            raise page.error(line, f"the header states {stated}, and calls it {short(self.name)}")
        if is_vertical:
            return replace(named, is_vertical=True)
        return replace(named, azimuth=float(azimuth % 360)) if azimuth else named


def direction_and_place(name: str) -> tuple[str, str]:
    """The direction of a channel such as "Up - roof", and the place of the sensor behind it."""
    direction, *place = re.split(r"\s+-\s+|\s*;\s*|\s{2,}", name.strip(), maxsplit=1)
    return direction, " ".join(place).removeprefix("Location:").strip()


class Page:
    """Lines of a text file by their numbers, from 1 on."""

    def __init__(self, text: Text) -> None:
        self.path = text.path
        self.lines = [line.rstrip("\n") for _, line in text.lines()]
        for number, line in enumerate(self.lines, 1):
            if len(line) > LONGEST_LINE:
                raise self.error(number, f"{len(line)} letters, where {LONGEST_LINE} are the most")

    def __len__(self) -> int:
        return len(self.lines)

    def error(self, line: int | None, what: str, remedy: str = AGAIN) -> InputError:
        """The error of a line."""
        return InputError.at(self.path, line, what, remedy)

    def line(self, number: int, what: str) -> str:
        """A line; `what` names it where the file ends before it."""
        if number > len(self.lines):
            raise self.error(
                len(self.lines), f"the file ends here, where {what} is expected in line {number}"
            )
        return self.lines[number - 1]

    def match(self, number: int, pattern: str, what: str) -> re.Match[str]:
        """The match of a pattern in a line that should give `what`."""
        text = self.line(number, what)
        found = re.search(pattern, text, re.IGNORECASE)
        if not found:
            raise self.error(number, f"the line says {short(text)}, and should give {what}")
        return found

    def find(
        self, pattern: str, what: str, first: int = 1, last: int | None = None
    ) -> tuple[int, re.Match[str]]:
        """The one line among some in which a pattern is found, and what it finds."""
        last = len(self.lines) if last is None else min(last, len(self.lines))
        found = [
            (n, m)
            for n in range(first, last + 1)
            if (m := re.search(pattern, self.lines[n - 1], re.IGNORECASE))
        ]
        if len(found) != 1:
            there = f"{len(found)} lines do" if found else "none does"
            raise self.error(
                found[1][0] if found else None,
                f"one of the lines {first} to {last} should give {what}: {there}",
            )
        return found[0]

    def whole(self, number: int, text: str, what: str) -> int:
        """A positive whole number of a line."""
        digits = text.strip()
        is_whole = digits.isascii() and digits.isdecimal() and len(digits) < len(str(LARGEST))
        if not (is_whole and int(digits) > 0):
            raise self.error(number, f"{what} is {short(text)}, not a positive whole number")
        return int(digits)

    def count(self, number: int, rate: float, duration: float) -> int:
        """The number of values of a rate [1/s] and a duration [s]."""
        if not rate * duration < LARGEST:
            raise self.error(number, f"{rate:g} values a second for {duration:g} s are too many")
        return round(rate * duration)

    def positive(self, number: int, text: str, what: str) -> float:
        """A positive number of a line."""
        value = number_of(text.strip(), self.path, number, what)
        if value <= 0:
            raise self.error(number, f"{what} is {short(text)}, not positive")
        return value

    def fixed(
        self, first: int, count: int, columns: Sequence[int], what: str, blank: int = 0
    ) -> tuple[np.ndarray, int]:
        """Numbers in fixed columns, `columns` wide, line by line, and the line after the last.

        count : how many numbers. blank : blanks at the right of each. The last line has what is
        left. A field that is empty, holds a tab or is cut short is refused.
        """
        fields: list[str] = []
        lines: list[int] = []
        number = first
        while len(fields) < count:
            text = self.line(number, f"{what} {len(fields) + 1} of {count}").rstrip(" ")
            here = columns[: count - len(fields)]
            width = sum(here) - blank
            if len(text) != width or "\t" in text:
                tab = ", and a tab" if "\t" in text else ""
                raise self.error(
                    number,
                    f"{len(text)} characters{tab}, where {len(here)} {what}s in fixed columns have "
                    f"{width}",
                )
            start = 0
            for wide in here:
                fields.append(text[start : start + wide].strip(" "))
                lines.append(number)
                start += wide
            number += 1
        return self.numbers(fields, lines, what), number

    def numbers(self, fields: list[str], lines: list[int], what: str) -> np.ndarray:
        """The numbers (n,) of fields, each of a line."""
        values = numbers_of(fields)
        if values is None:
            for n, (field, line) in enumerate(zip(fields, lines, strict=True), 1):
                number_of(field, self.path, line, f"{what} {n}")
        return np.array(values)

    def ends(self, number: int) -> None:
        """Refuse anything but blank lines from a line on."""
        for n in range(number, len(self.lines) + 1):
            if self.lines[n - 1].strip():
                raise self.error(
                    n, f"{short(self.lines[n - 1])} follows the last value of the record",
                    "give a file of one record, or correct the number of values in its header",
                )  # fmt: skip


_FORTRAN = re.compile(
    r"\(?(?:1p,?(?=\d*\(?[ed]))?(\d{0,3})\(?(?:es|[fegd])(\d\d?)\.\d+(?:e\d+)?\)*",
    re.IGNORECASE,
)
"""One kind of column, times a number; 1P leaves fields with an exponent as they are."""


def columns_of(page: Page, line: int, text: str) -> list[int]:
    """Widths of the columns of a FORTRAN format such as "(8F10.3)", which a line states."""
    found = _FORTRAN.fullmatch(text.replace(" ", ""))
    if not found or not int(found[2]) or not int(found[1] or 1):
        what = f"the format is {short(text)}, not such as (8F10.3)"
        raise page.error(line, what, "export the record with columns of one kind")
    return [int(found[2])] * int(found[1] or 1)


def checked(page: Page, one: Component, gravity: float) -> Component:
    """A component whose largest acceleration is the stated one; InputError else.

    Half a unit of the last printed digit is allowed.
    """
    if one.peak is None:
        return one
    text, unit, line, digit = one.peak
    stated = abs(number_of(text, page.path, line, "the stated peak"))
    to_si = factor(unit, gravity)
    try:
        exponent = int(Decimal(pythonic(text)).as_tuple().exponent)
    except InvalidOperation:  # "1E-99999999999999999999"
        raise page.error(line, f"the stated peak is {short(text)}, which no file prints") from None
    last = 10.0 ** (exponent if stated else min(exponent, 0))  # "0E400" has no digit there
    own = float(np.abs(one.acceleration).max()) / to_si
    if abs(own - stated) > 0.5 * max(last, digit) + 1e-9 * stated:
        raise page.error(
            line,
            f"the stated peak of {one.name} is {text} {unit}, and the values reach {own:.6g}",
            "take the file again; in Python stated_peak=False reads it all the same",
        )
    return one


def in_si(values: np.ndarray, unit: str, gravity: float) -> np.ndarray:
    """Accelerations [m/s2] of values in a unit."""
    return values * factor(unit, gravity)


def each_until(page: Page, read: Callable[[int], tuple[Component | None, int]]) -> list[Component]:
    """All components of a file, each read from a line on, up to the line after its end.

    None stands for a block that is passed over.
    """
    found, first = [], 1
    while any(line.strip() for line in page.lines[first - 1 :]):
        one, first = read(first)
        if one is not None:
            found.append(one)
    return found
