"""Readers of recorded accelerations: PEER .AT2 and columns of text.

A reader returns what the file says, in SI units, or raises `MotionError`: it fills no gap, drops no
value and guesses no unit.
"""

from __future__ import annotations

import csv
import math
import os
import re
from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rockeom.motion.errors import MotionError
from rockeom.motion.units import NAMES, factor, is_known

FilePath = str | os.PathLike[str]
Column = str | int


class Record(NamedTuple):
    """Accelerations (n,) [m/s2] at times 0, dt, 2 dt ... [s], with name and source."""

    acceleration: np.ndarray
    dt: float
    name: str
    source: str


# -- text and numbers ----------------------------------------------------------------------------

# Stricter than float(), which takes "1_000"; and Fortran's D for an exponent, which it does not.
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
# Fixed-width fields may stand without a blank between them; a sign after a digit starts a number.
_GLUED = re.compile(r"(?<=[\d.])(?=[+-])")
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")

_COMMENTS = ("#", "%")
_GET_AGAIN = "open the file in a text editor, and download or export it again"
_OTHER_QUANTITY = {".vt2": "velocity", ".dt2": "displacement"}


def read_lines(path: FilePath) -> list[str]:
    """The lines of a text file that can hold a record of acceleration.

    Raises MotionError for a file that is missing, empty, binary, a web page, or a PEER record of
    velocity or displacement by its name.
    """
    quantity = _OTHER_QUANTITY.get(Path(path).suffix.lower())
    if quantity:
        raise _other_quantity(path, None, quantity, f"the name ends in {Path(path).suffix}")
    try:
        raw = Path(path).read_bytes()
    except FileNotFoundError:
        remedy = f"check the path (relative paths start at {Path.cwd()})"
        raise MotionError.at(path, None, "there is no such file", remedy) from None
    except OSError as error:
        what = f"the file cannot be read ({error.strerror})"
        raise MotionError.at(path, None, what, "check the path and the permissions") from None
    raw = raw.removeprefix(b"\xef\xbb\xbf").rstrip(b"\x1a")  # UTF-8 mark; end of file under DOS
    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")  # names of stations in old headers
    if not text.strip():
        raise MotionError.at(path, None, f"the file is empty ({len(raw)} bytes)", _GET_AGAIN)
    # Not str.splitlines: it breaks at characters that a text editor does not count as line ends.
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for number, line in enumerate(lines, 1):
        if junk := _CONTROL.search(line):
            what = f"the file is not plain text (byte {ord(junk[0])})"
            remedy = "unpack it if it is an archive, or export it as text (UTF-8)"
            raise MotionError.at(path, number, what, remedy)
    first = next(number for number, line in enumerate(lines, 1) if line.strip())
    if lines[first - 1].lstrip().startswith("<"):
        what = f"this is a web page (HTML), not a record: {_short(lines[first - 1])}"
        remedy = "download the record itself; a site often sends its sign-in page instead"
        raise MotionError.at(path, first, what, remedy)
    return lines


def _other_quantity(path: FilePath, line: int | None, quantity: str, why: str) -> MotionError:
    what = f"this is a record of {quantity}, not of acceleration: {why}"
    return MotionError.at(
        path, line, what, "use the acceleration record (.AT2) of the same station"
    )


def _short(text: str) -> str:
    text = text.strip()
    return repr(text if len(text) <= 60 else text[:57] + "...")


def _looks_numeric(text: str) -> bool:
    return bool(_NUMBER.fullmatch(text) or _NOT_FINITE.fullmatch(text))


def _number(text: str, path: FilePath, line: int, what: str) -> float:
    """The finite number that `text` says; `what` names it in the error."""
    if not _looks_numeric(text):
        remedy = "give plain numbers with a decimal point, or correct this line"
        raise MotionError.at(path, line, f"{what} is {_short(text)}, which is no number", remedy)
    value = float(text.lower().replace("d", "e")) if _NUMBER.fullmatch(text) else math.nan
    if not math.isfinite(value):
        remedy = "take the record from its source again, or decide yourself what belongs here"
        raise MotionError.at(path, line, f"{what} is {text}, not a finite number", remedy)
    return value


def _factor(
    path: FilePath, line: int | None, in_file: str | None, asked: str | None, gravity: float
) -> float:
    """The factor to m/s2 from the units that the file or the caller states."""
    stated = asked if asked is not None else in_file
    if stated is None:
        remedy = f"say units=, one of {', '.join(NAMES)}"
        raise MotionError.at(path, None, "the file does not say its units of acceleration", remedy)
    if in_file is not None and not is_known(in_file):
        what = f"the file states accelerations in {in_file!r}, which is unknown"
        raise MotionError.at(path, line, what, f"correct it to one of {', '.join(NAMES)}")
    found = factor(stated, gravity)
    if in_file is not None and factor(in_file, gravity) != found:
        what = f"the file states accelerations in {in_file!r}, the caller in {asked!r}"
        raise MotionError.at(path, line, what, "leave units= out, or correct the file")
    return found


# -- PEER .AT2 -----------------------------------------------------------------------------------

_OLD_STEP_LINE = re.compile(r"\s*(\S+)[\s,]+(\S+?)[\s,:]+NPTS\s*,\s*DT\b", re.IGNORECASE)
_NPTS = re.compile(r"\bNPTS\s*=\s*([^\s,]*)", re.IGNORECASE)
_DT = re.compile(rf"\bDT\s*=\s*({_NUMBER.pattern}|[^\s,]*)\s*([a-z]*)", re.IGNORECASE)
_UNITS = re.compile(r"\bIN\s+UNITS?\s+OF\s+([A-Za-z][\w/*^]*)", re.IGNORECASE)
_QUANTITY = re.compile(r"\b(VELOCITY|DISPLACEMENT)\s+TIME\s+(?:SERIES|HISTORY)\b", re.IGNORECASE)
_HEADER_LINES = 50  # far more than any header; a file without NPTS in them is no PEER record


def is_at2(path: FilePath, lines: Sequence[str]) -> bool:
    """Whether a file is a PEER record, by its name or by its header."""
    return Path(path).suffix.lower() == ".at2" or _last_header_line(lines) is not None


def read_at2(path: FilePath, units: str | None, gravity: float, name: str | None) -> Record:
    """A PEER record, with the old ("4000 0.01 NPTS, DT") or the new ("NPTS=, DT=") header."""
    lines = read_lines(path)
    last = _last_header_line(lines)
    if last is None:
        what = f"no line with NPTS and DT among the first {min(len(lines), _HEADER_LINES)}"
        remedy = "a PEER record has one; read two columns with GroundMotion.from_columns"
        raise MotionError.at(path, None, what, remedy)
    header = lines[: last - 1]
    for number, line in enumerate(header, 1):
        if found := _QUANTITY.search(line):
            raise _other_quantity(path, number, found[1].lower(), f"the header says {_short(line)}")
    npts, dt = _npts_and_dt(path, last, lines[last - 1])

    stated = [(n, found[1]) for n, line in enumerate(header, 1) if (found := _UNITS.search(line))]
    unit_line, in_file = stated[-1] if stated else (None, None)
    to_si = _factor(path, unit_line, in_file, units, gravity)

    acceleration: list[float] = []
    for number, line in enumerate(lines[last:], last + 1):
        for token in line.split():
            fields = [token] if _looks_numeric(token) else _GLUED.split(token)
            for field in fields:
                what = f"sample {len(acceleration) + 1}"
                acceleration.append(_number(field, path, number, what))
    if len(acceleration) != npts:
        what = f"NPTS says {npts} values, but the file holds {len(acceleration)}"
        remedy = "the file is cut short or edited; download it again or correct NPTS"
        raise MotionError.at(path, last, what, remedy)

    titled = len(header) >= 2 and unit_line != 2 and header[1].strip()
    title = " ".join(header[1].split()) if titled else Path(path).stem
    source = f"{Path(path).name}, line 2: {title}" if titled else Path(path).name
    return Record(np.array(acceleration) * to_si, dt, name or title, source)


def _last_header_line(lines: Sequence[str]) -> int | None:
    for number, line in enumerate(lines[:_HEADER_LINES], 1):
        comment = line.lstrip().startswith(_COMMENTS)
        if not comment and (_NPTS.search(line) or _OLD_STEP_LINE.match(line)):
            return number
    return None


def _npts_and_dt(path: FilePath, line: int, text: str) -> tuple[int, float]:
    """Number of values and time step [s] that the last line of the header states."""
    if (npts_found := _NPTS.search(text)) is not None:
        dt_found = _DT.search(text)
        npts_text = npts_found[1]
        dt_text, dt_unit = (dt_found[1], dt_found[2].lower()) if dt_found else ("", "")
    else:
        old = _OLD_STEP_LINE.match(text)
        assert old is not None  # one of both, or this were not the last line of the header
        npts_text, dt_text, dt_unit = old[1], old[2], ""
    if not npts_text.isdecimal():
        what = f"NPTS is {_short(npts_text)} in {_short(text)}, not a whole number"
        raise MotionError.at(path, line, what, "correct the header or download the record again")
    if not _NUMBER.fullmatch(dt_text):
        what = f"DT is missing: no number follows it in {_short(text)}"
        raise MotionError.at(
            path, line, what, "write the time step in seconds, as in DT= .0100 SEC"
        )
    dt = _number(dt_text, path, line, "DT")
    if dt <= 0:
        what = f"DT is {dt_text} s, not positive"
        raise MotionError.at(
            path, line, what, "write the time step in seconds, as in DT= .0100 SEC"
        )
    if dt_unit not in ("", *_SECONDS):
        what = f"DT is in {dt_unit!r} in {_short(text)}"
        raise MotionError.at(path, line, what, "write the time step in seconds")
    return int(npts_text), dt


# -- columns of text -----------------------------------------------------------------------------

_SECONDS = ("s", "sec", "secs", "second", "seconds")
_OTHER_TIMES = ("ms", "msec", "millisecond", "milliseconds", "min", "minutes", "h", "hours")
# A letter before any digit, or one that is in no number: "E" and "0deg", not "0,5E-03" or "***".
_NAME = re.compile(r"[^\d+\-.]*[^\W\d_]|.*[^\W\d_eEdD]")
_BRACKETED = re.compile(r"[\[(]\s*([^\])]+?)\s*[\])]")
_NAME_WITH_UNIT = re.compile(r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?")


class _Table(NamedTuple):
    """Rows of a text file with the numbers of their lines, and the line of names before them."""

    path: FilePath
    header_line: int | None
    names: list[str]
    lines: list[int]
    rows: list[list[str]]


def read_columns(path: FilePath, units: str | None, gravity: float, name: str | None) -> Record:
    """Two columns: time and acceleration."""
    table = _table(path)
    width = len(table.rows[0])
    if width < 2:
        remedy = "for accelerations alone use GroundMotion.from_array(acceleration, dt)"
        raise MotionError.at(path, table.lines[0], "one column, where two are needed", remedy)
    if width > 2:
        what = f"{width} columns ({_short(' | '.join(table.rows[0]))}), where two are needed"
        remedy = (
            "name the columns of time and acceleration with GroundMotion.from_csv, "
            "and write numbers with a decimal point"
        )
        raise MotionError.at(path, table.lines[0], what, remedy)
    return _record(table, 0, 1, units, gravity, name)


def read_csv(
    path: FilePath,
    time_column: Column,
    acceleration_column: Column,
    units: str | None,
    gravity: float,
    name: str | None,
) -> Record:
    """Two columns out of several, each named by its heading or its number (the first is 0)."""
    table = _table(path)
    time, acceleration = (_column(table, wanted) for wanted in (time_column, acceleration_column))
    return _record(table, time, acceleration, units, gravity, name)


def _table(path: FilePath) -> _Table:
    lines = read_lines(path)
    if last := _last_header_line(lines):
        what = f"this is the header of a PEER record: {_short(lines[last - 1])}"
        raise MotionError.at(path, last, what, "read it with GroundMotion.from_at2")
    content = [
        (number, line.strip())
        for number, line in enumerate(lines, 1)
        if line.strip() and not line.lstrip().startswith(_COMMENTS)
    ]
    if not content:
        raise MotionError.at(path, None, "the file holds nothing but comments", _GET_AGAIN)
    # The last line holds numbers for certain; the heading may hold commas of its own.
    delimiter = next((d for d in ";," if d in content[-1][1]), None)

    names: list[str] = []
    header_line = None
    first = _fields(content[0][1], delimiter)
    if any(first) and all(_is_name(field) or not field for field in first):
        header_line, heading = content.pop(0)
        names = _names(heading, delimiter)
    if not content:
        raise MotionError.at(path, header_line, "no numbers follow the heading", _GET_AGAIN)
    rows = [_fields(line, delimiter) for _, line in content]
    for (number, _), row in zip(content, rows, strict=True):
        if len(row) != len(rows[0]):
            what = f"{len(row)} columns, where line {content[0][0]} has {len(rows[0])}"
            remedy = "complete this line, or write comments behind #"
            raise MotionError.at(path, number, what, remedy)
    return _Table(path, header_line, names, [number for number, _ in content], rows)


def _is_name(field: str) -> bool:
    return bool(_NAME.match(field)) and not _looks_numeric(field)


def _fields(line: str, delimiter: str | None) -> list[str]:
    if delimiter is None:
        return line.split()
    fields = [field.strip() for field in next(csv.reader([line], delimiter=delimiter))]
    return fields[:-1] if len(fields) > 1 and not fields[-1] else fields


def _names(line: str, delimiter: str | None) -> list[str]:
    if delimiter is None and "\t" in line:
        return [name.strip() for name in re.split(r"\t+", line)]
    return _NAME_WITH_UNIT.findall(line) if delimiter is None else _fields(line, delimiter)


def _column(table: _Table, wanted: Column) -> int:
    width = len(table.rows[0])
    if isinstance(wanted, int) and not isinstance(wanted, bool):
        if 0 <= wanted < width:
            return wanted
        what, line = f"column {wanted} does not exist: there are {width}", table.lines[0]
        raise MotionError.at(table.path, line, what, f"count from 0 to {width - 1}")
    if table.names.count(str(wanted)) == 1:
        return table.names.index(str(wanted))
    known = ", ".join(map(repr, table.names)) or "none: the file has no heading"
    what = f"no single column is called {wanted!r}; the names are {known}"
    remedy = "use one of these names, or the column's number (the first is 0)"
    raise MotionError.at(table.path, table.header_line, what, remedy)


def _record(
    table: _Table,
    time: int,
    acceleration: int,
    units: str | None,
    gravity: float,
    name: str | None,
) -> Record:
    path = table.path
    time_unit, in_file = (_unit_in_heading(table, column) for column in (time, acceleration))
    if time_unit is not None and time_unit.lower() in _OTHER_TIMES:
        what = f"time is in {time_unit!r}"
        raise MotionError.at(path, table.header_line, what, "convert the time column to seconds")
    in_file = in_file if in_file is not None and is_known(in_file) else None
    to_si = _factor(path, table.header_line, in_file, units, gravity)

    times, values = [], []
    for sample, (line, row) in enumerate(zip(table.lines, table.rows, strict=True), 1):
        times.append(_number(row[time], path, line, f"time of sample {sample}"))
        values.append(_number(row[acceleration], path, line, f"acceleration of sample {sample}"))
    if len(times) < 2:
        what = "one sample, where a record needs two or more"
        raise MotionError.at(path, table.lines[0], what, _GET_AGAIN)
    dt = _time_step(path, table.lines, np.array(times), [row[time] for row in table.rows])
    source = Path(path).name
    if times[0] != 0.0:
        source += f", whose time {times[0]:g} s is the start of the motion"
    return Record(np.array(values) * to_si, dt, name or Path(path).stem, source)


def _unit_in_heading(table: _Table, column: int) -> str | None:
    """What stands in brackets behind a column's name, as in "time (s)"."""
    if len(table.names) != len(table.rows[0]):
        return None
    found = _BRACKETED.search(table.names[column])
    return found[1] if found else None


def _time_step(
    path: FilePath, lines: Sequence[int], times: np.ndarray, texts: Sequence[str]
) -> float:
    """The even step [s] of a time column.

    Printed times are rounded: steps of 1/256 s read 0.004, 0.004, 0.003 with three decimals. So a
    time may lie off the even grid, and a step off the mean, by one unit of the last printed digit,
    and by what such a unit at the end does to the mean. That excuse ends where the digits are as
    coarse as a third of the step, because a missing sample could hide behind it. Times that went
    through single precision carry noise of their own: a hundredth of a step is always allowed.
    """
    steps = np.diff(times)
    for n in np.flatnonzero(steps <= 0)[:1]:
        what = f"time {texts[n + 1]} s does not come after {texts[n]} s of line {lines[n]}"
        remedy = "give increasing times, printed with enough digits, of one record only"
        raise MotionError.at(path, lines[n + 1], what, remedy)

    exact = [Decimal(text.lower().replace("d", "e")) for text in texts]
    dt = float((exact[-1] - exact[0]) / (len(exact) - 1))  # 0.02, not 0.019999999999999997
    digit = _last_printed_digit(exact)
    allowed = np.where(digit < dt / 3, np.maximum(digit, 0.01 * dt), 0.01 * dt)
    of_mean = max(allowed[0], allowed[-1]) / len(steps)
    of_step = np.maximum(allowed[1:], allowed[:-1]) + of_mean
    index = np.arange(len(times))
    off_grid = np.abs(times - times[0] - dt * index) / (allowed + of_mean * index)
    if (np.abs(steps - dt) <= of_step).all() and (off_grid <= 1.0).all():
        return dt

    # The mean is spoilt by what is wrong, the median is not.
    usual = float(np.median(steps))
    beyond = np.abs(steps - usual) > np.maximum(of_step, 0.01 * usual)
    if beyond.any():
        n = int(np.argmax(beyond)) + 1
        found = f"the step to {texts[n]} s is {steps[n - 1]:.6g} s, the usual step {usual:.6g} s"
    else:  # no step stands out, but they drift
        n = int(np.argmax(off_grid))
        before, after = steps[:n].mean(), steps[n:].mean()
        found = f"up to {texts[n]} s the mean step is {before:.6g} s, after it {after:.6g} s"
    what = f"the time column is not uniform: {found}"
    remedy = "resample to a uniform step (numpy.interp) and use GroundMotion.from_array"
    raise MotionError.at(path, lines[n], what, remedy)


def _last_printed_digit(numbers: Sequence[Decimal]) -> np.ndarray:
    """Unit of the last digit (n,) of printed numbers, whether decimals or digits are fixed.

    A single number does not tell, "1" may stand for 1.00; so the file's largest number of
    decimals and of significant digits are taken together.
    """
    decimals = max(-int(number.as_tuple().exponent) for number in numbers)
    digits = max(len(number.as_tuple().digits) for number in numbers)
    exponents = [max(-decimals, number.adjusted() - digits + 1) for number in numbers]
    return 10.0 ** np.array(exponents, dtype=float)
