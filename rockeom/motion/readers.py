"""Readers of records: accelerations (PEER .AT2, columns of text) and the channels of a test.

A reader returns what the file says, in SI units, or raises `InputError`: it fills no gap, drops no
value and guesses no unit.

The bytes of a file are held once, and its lines are made one at a time. The time is in proportion
to the length of the file: no pattern here goes over the same letters again and again.
"""

from __future__ import annotations

import codecs
import csv
import io
import math
import os
import re
import stat
from array import array
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Context, Decimal, InvalidOperation
from itertools import chain, islice
from pathlib import Path
from typing import NamedTuple

import numpy as np

from rockeom.files import in_text
from rockeom.motion import components
from rockeom.motion.units import CHANNEL_UNITS, NAMES, channel_factor, factor, is_known
from rockeom.numbers.checks import (
    FilePath,
    InputError,
    InputTypeError,
    described,
    is_number,
    positive_number,
)

Column = str | int


class Channels(NamedTuple):
    """Channels of a test, (n,) each, in SI units, at start, start + dt ... [s]."""

    start: float
    dt: float
    values: dict[str, np.ndarray]
    name: str


class Record(NamedTuple):
    """Accelerations (n,) [m/s2] at times 0, dt, 2 dt ... [s], with name and source.

    is_vertical : whether the file says so, see `components`.
    """

    acceleration: np.ndarray
    dt: float
    name: str
    source: str
    is_vertical: bool = False


def read(
    path: FilePath,
    units: str | None,
    gravity: float,
    name: str | None,
    is_at2: bool | None = None,
) -> Record:
    """A PEER record or two columns of time and acceleration.

    is_at2 : which of both the file is; by its name or by its header if not given. A record has the
    old ("4000 0.01 NPTS, DT") or the new ("NPTS=, DT=") header.
    """
    text = _open(path)
    if is_at2 is None:
        is_at2 = Path(path).suffix.lower() == ".at2" or _last_header_line(_head(text)) is not None
    return (_at2 if is_at2 else _columns)(text, units, gravity, name)


def read_csv(
    path: FilePath,
    time_column: Column | None,
    acceleration_column: Column | None,
    dt: float | None,
    units: str | None,
    gravity: float,
    name: str | None,
    layout: str | None = None,
) -> Record:
    """Two columns out of several, each named by its heading or its number (the first is 0).

    dt : the time step [s] in place of a column of times; a file of one column has none to name.
    layout : "columns", "wrapped" for values that run on from one column to the next, or None, which
    refuses what looks like these.
    """
    if layout not in (None, "columns", "wrapped"):
        raise InputError("layout", layout).so('choose "columns" or "wrapped"')
    table = _table(_open(path))
    if (time_column is None) == (dt is None):
        what = "time_column and dt are both given, or neither"
        remedy = "give the column of the times, or the time step [s] of a file without one"
        raise InputError.at(path, None, what, remedy, "dt")
    if layout == "wrapped":
        if dt is None or acceleration_column is not None:
            what = "a wrapped layout has no columns to name"
            raise InputError.at(path, None, what, "give {dt}, and no column", "layout")
        return _record(
            table, positive_number("dt", dt), 0, units, gravity, name, _in_sequence(table)
        )
    if layout is None and dt is not None and not table.names and _runs_on(table):
        what = f"its {len(table.first)} columns look like one sequence of values, line by line"
        remedy = 'say {layout:"wrapped"} if it is one, or {layout:"columns"} if each is a channel'
        raise InputError.at(path, table.first_line, what, remedy, "layout")
    if acceleration_column is None and (len(table.first) > 1 or dt is None):
        what = f"no column of {len(table.first)} is named as that of the acceleration"
        raise InputError.at(
            path, table.first_line, what, "name it by {acceleration_column}", "acceleration_column"
        )
    acceleration = 0 if acceleration_column is None else _column(table, acceleration_column)
    time = positive_number("dt", dt) if time_column is None else _column(table, time_column)
    return _record(table, time, acceleration, units, gravity, name)


def read_channels(
    path: FilePath,
    units: Mapping[str, str],
    channels: Sequence[str] | None,
    time_column: Column,
    gravity: float,
) -> Channels:
    """Several columns of a table with a heading, each by its name without its unit.

    units : of the columns whose heading states none in brackets. channels : which to read, all
    but the time if None.
    """
    table = _table(_open(path))
    if not table.names:
        remedy = "write a first line with a name for each column, such as time (s), theta (deg)"
        raise InputError.at(path, None, "the columns have no names", remedy)
    time = _column(
        table, time_column if isinstance(time_column, int) else _full(table, time_column)
    )
    bare = [_BRACKETED.sub("", name).strip() for name in table.names]
    wanted = [n for i, n in enumerate(bare) if i != time] if channels is None else list(channels)
    places, times = {name: i for i, name in enumerate(bare)}, Counter(bare)
    for name in (*wanted, *units):
        if times[name] != 1 or places[name] == time:
            known = ", ".join(_short(n) for i, n in enumerate(bare) if i != time)
            what = f"no single channel is called {described(name)}; the names are {known}"
            raise InputError.at(path, table.header_line, what, "use one of these names")
    columns = {places[name]: name for name in wanted}
    if len(columns) < len(wanted):
        what = f"a channel is named twice in {wanted}"
        raise InputError.at(path, table.header_line, what, "name each once")
    factors = [_channel_factor(table, i, n, units.get(n), gravity) for i, n in columns.items()]
    start, dt, values = _sampled(table, time, columns)
    scaled = {n: v * f for n, v, f in zip(wanted, values, factors, strict=True)}
    return Channels(start, dt, scaled, in_text(path).stem)


def _full(table: _Table, name: str) -> str:
    """The heading that is called `name` without its unit, or `name` itself."""
    found = [n for n in table.names if _BRACKETED.sub("", n).strip() == name]
    return found[0] if len(found) == 1 else name


def _channel_factor(
    table: _Table, column: int, name: str, asked: str | None, gravity: float
) -> float:
    """The factor to SI of a channel, from its heading or from the caller."""
    path, line = table.text.path, table.header_line
    in_file = _unit_in_heading(table, column)
    stated = asked if asked is not None else in_file
    known = ", ".join(CHANNEL_UNITS)
    if stated is None:
        remedy = f"say units={{{name!r}: ...}} with one of {known}, or leave the channel out"
        raise InputError.at(path, line, f"nothing says the unit of {_short(name)}", remedy, "units")
    if not isinstance(stated, str) or (found := channel_factor(stated, gravity)) is None:
        what = f"the unit of {_short(name)} is {described(stated)}, which is unknown"
        raise InputError.at(path, line, what, f"give one of {known}", "units")
    if in_file is not None and asked is not None and channel_factor(in_file, gravity) != found:
        what = f"the heading states {_short(name)} in {in_file!r}, the caller in {asked!r}"
        raise InputError.at(
            path, line, what, "leave it out of {units}, or correct the file", "units"
        )
    return found


# -- files ---------------------------------------------------------------------------------------

_LARGEST_FILE = 2**30  # bytes; three days of a thousand samples a second
_LONGEST_LINE = 2**20  # letters
_BLOCK = 2**20  # bytes read at once
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1f\x7f]")
_LINE_END = re.compile(rb"\r\n?|\n")

_COMMENTS = ("#", "%")
_ROWS = 4096  # that are read at once
_GET_AGAIN = "open the file in a text editor, and download or export it again"
_OTHER_QUANTITY = {".vt2": "velocity", ".dt2": "displacement"}


@dataclass(frozen=True)
class _Text:
    """The bytes of a text file, and its lines as often as they are wanted."""

    path: FilePath
    raw: bytes
    encoding: str

    def lines(self) -> Iterator[tuple[int, str]]:
        """Lines with their numbers, from 1 on.

        They end as a text editor has it; str.splitlines breaks at other characters, too.
        """
        file = io.TextIOWrapper(io.BytesIO(self.raw), self.encoding)
        for number, line in enumerate(file, 1):
            if len(line) > _LONGEST_LINE:
                what = f"a line of {len(line)} letters, where {_LONGEST_LINE} are the most"
                raise InputError.at(self.path, number, what, "break it into shorter lines")
            yield number, line

    def content(self) -> Iterator[list[tuple[int, str]]]:
        """Lines that are neither blank nor comments, stripped, some thousand at once."""
        lines = self.lines()
        while block := list(islice(lines, _ROWS)):
            stripped = [(number, line.strip()) for number, line in block]
            yield [(number, line) for number, line in stripped if line and line[0] not in _COMMENTS]


def _open(path: FilePath) -> _Text:
    """A text file that can hold a record of acceleration.

    Raises InputError for a file that is missing, empty, binary, a web page, or a PEER record of
    velocity or displacement by its name, and TypeError for what is no path.
    """
    if not isinstance(path, str | os.PathLike) or isinstance(os.fspath(path), bytes):
        raise InputTypeError("path", path).give(
            "the path of a file, as text or pathlib.Path; GroundMotion.from_array takes numbers"
        )
    quantity = _OTHER_QUANTITY.get(Path(path).suffix.lower())
    if quantity:
        raise _other_quantity(path, None, quantity, f"the name ends in {Path(path).suffix}")
    # A mark at the start, of UTF-8; an end of file under DOS.
    raw = _bytes(path).removeprefix(codecs.BOM_UTF8).rstrip(b"\x1a")
    if not raw or raw.isspace():
        raise InputError.at(path, None, f"the file is empty ({len(raw)} bytes)", _GET_AGAIN)
    if junk := _CONTROL.search(raw):
        before = sum(1 for _ in _LINE_END.finditer(raw, 0, junk.start()))
        what = f"the file is not plain text (byte {junk[0][0]})"
        remedy = "unpack it if it is an archive, or export it as text (UTF-8)"
        raise InputError.at(path, 1 + before, what, remedy)
    text = _Text(path, raw, _encoding(raw))
    for number, line in text.lines():
        if first := line.strip():
            if first.startswith("<"):
                what = f"this is a web page (HTML), not a record: {_short(first)}"
                remedy = "download the record itself; a site often sends its sign-in page instead"
                raise InputError.at(path, number, what, remedy)
            break
    return text


def _bytes(path: FilePath) -> bytes:
    """The text of a file; raises InputError where it cannot be read, is too long or no file."""
    most = _LARGEST_FILE // _BLOCK
    try:
        with open(path, "rb", opener=_open_at_once) as file:
            is_file = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            if is_file:
                blocks = list(islice(iter(lambda: file.read(_BLOCK), b""), most + 1))
    except FileNotFoundError:
        remedy = f"check the path (relative paths start at {Path.cwd()})"
        raise InputError.at(path, None, "there is no such file", remedy) from None
    except OSError as error:
        what = f"the file cannot be read ({error.strerror})"
        raise InputError.at(path, None, what, "check the path and the permissions") from None
    except ValueError as error:  # a zero byte in the path, or half of a letter
        remedy = "give the path as the file system has it"
        raise InputError.at(path, None, f"no file has such a name ({error})", remedy) from None
    if not is_file:
        what = "this is a pipe or a device, not a file"
        raise InputError.at(path, None, what, "write the record to a file, and give that")
    if len(blocks) > most:
        what = f"the file holds more than {_LARGEST_FILE} bytes"
        raise InputError.at(path, None, what, "cut it into records of one earthquake each")
    return b"".join(blocks)


def _open_at_once(path: str, flags: int) -> int:
    """Opened without waiting: a pipe would wait for a program that writes to it."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _encoding(raw: bytes) -> str:
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"  # names of stations in old headers
    return "utf-8"


def _other_quantity(path: FilePath, line: int | None, quantity: str, why: str) -> InputError:
    what = f"this is a record of {quantity}, not of acceleration: {why}"
    return InputError.at(path, line, what, "use the acceleration record (.AT2) of the same station")


def _cut(text: str) -> str:
    text = text.strip()
    return text if len(text) <= 60 else text[:57] + "..."


def _short(text: str) -> str:
    return repr(_cut(text))


# -- numbers -------------------------------------------------------------------------------------

# Stricter than float(), which takes "1_000"; and Fortran's D for an exponent, which it does not.
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
# Fixed-width fields may stand without a blank between them; a sign after a digit starts a number.
_GLUED = re.compile(r"(?<=[0-9.])(?=[+-])")
_PLAIN = re.compile(r"[0-9+\-.e\n]*")  # of these letters float() takes what _NUMBER takes


def _looks_numeric(text: str) -> bool:
    return bool(_NUMBER.fullmatch(text) or _NOT_FINITE.fullmatch(text))


def _pythonic(text: str) -> str:
    """A number as Python writes it: "1e-3" for "1D-3"."""
    return text.lower().replace("d", "e")


def _number(text: str, path: FilePath, line: int, what: str) -> float:
    """The finite number that `text` says; `what` names it in the error."""
    if not _looks_numeric(text):
        remedy = "give plain numbers with a decimal point, or correct this line"
        raise InputError.at(path, line, f"{what} is {_short(text)}, which is no number", remedy)
    value = float(_pythonic(text)) if _NUMBER.fullmatch(text) else math.nan
    if not math.isfinite(value):
        remedy = "take the record from its source again, or decide yourself what belongs here"
        raise InputError.at(path, line, f"{what} is {_cut(text)}, not a finite number", remedy)
    return value


def _numbers(fields: Sequence[str]) -> list[float] | None:
    """The finite numbers that stripped fields say, all at once; None where one says none.

    As `_number`, which is slower and tells what is wrong.
    """
    text = _pythonic("\n".join(fields))
    if not _PLAIN.fullmatch(text):
        return None
    try:
        found = [float(field) for field in text.split("\n")]
    except ValueError:
        return None
    return found if all(map(math.isfinite, found)) else None


def _factor(
    path: FilePath, line: int | None, in_file: str | None, asked: str | None, gravity: float
) -> float:
    """The factor to m/s2 from the units that the file or the caller states."""
    stated = asked if asked is not None else in_file
    if stated is None:
        remedy = f"say {{units}}, one of {', '.join(NAMES)}"
        what = "the file does not say its units of acceleration"
        raise InputError.at(path, None, what, remedy, "units")
    if in_file is not None and not is_known(in_file):
        what = f"the file states accelerations in {_short(in_file)}, which is unknown"
        raise InputError.at(path, line, what, f"correct it to one of {', '.join(NAMES)}")
    found = factor(stated, gravity)
    if in_file is not None and factor(in_file, gravity) != found:
        what = f"the file states accelerations in {in_file!r}, the caller in {asked!r}"
        raise InputError.at(path, line, what, "leave {units} out, or correct the file", "units")
    return found


# -- PEER .AT2 -----------------------------------------------------------------------------------

_OLD_STEP_LINE = re.compile(r"\bNPTS\s*,\s*DT\b", re.IGNORECASE)
_NPTS = re.compile(r"\bNPTS\s*=\s*([^\s,]*)", re.IGNORECASE)
_DT = re.compile(rf"\bDT\s*=\s*({_NUMBER.pattern}|[^\s,]*)\s*([a-z]*)", re.IGNORECASE)
_UNITS = re.compile(r"\bIN\s+UNITS?\s+OF\s+([A-Za-z][\w/*^]*)", re.IGNORECASE)
_QUANTITY = re.compile(r"\b(VELOCITY|DISPLACEMENT)\s+TIME\s+(?:SERIES|HISTORY)\b", re.IGNORECASE)
_HEADER_LINES = 50  # far more than any header; a file without NPTS in them is no PEER record


def _head(text: _Text) -> list[str]:
    """The first lines, in which a header ends."""
    return [line for _, line in islice(text.lines(), _HEADER_LINES)]


def _at2(text: _Text, units: str | None, gravity: float, name: str | None) -> Record:
    path, head = text.path, _head(text)
    last = _last_header_line(head)
    if last is None:
        what = f"no line with NPTS and DT among the first {len(head)}"
        remedy = "a PEER record has one; two columns are read from a file whose name ends otherwise"
        error = InputError.at(path, None, what, remedy)
        raise error.so(remedy, "GroundMotion.from_columns reads them under any name")
    header = head[: last - 1]
    for number, line in enumerate(header, 1):
        if found := _QUANTITY.search(line):
            raise _other_quantity(path, number, found[1].lower(), f"the header says {_short(line)}")
    npts, dt = _npts_and_dt(path, last, head[last - 1])

    stated = [(n, found[1]) for n, line in enumerate(header, 1) if (found := _UNITS.search(line))]
    unit_line, in_file = stated[-1] if stated else (None, None)
    to_si = _factor(path, unit_line, in_file, units, gravity)

    samples = array("d")
    for number, line in islice(text.lines(), last, None):
        if fields := line.split():
            samples.extend(_numbers(fields) or _glued(fields, path, number, len(samples)))
    if str(len(samples)) != npts:
        what = f"NPTS says {_cut(npts)} values, but the file holds {len(samples)}"
        remedy = "the file is cut short or edited; download it again or correct NPTS"
        raise InputError.at(path, last, what, remedy)

    titled = len(header) >= 2 and unit_line != 2 and header[1].strip()
    title = " ".join(header[1].split()) if titled else in_text(path).stem
    source = f"{in_text(path).name}, line 2: {title}" if titled else in_text(path).name
    is_vertical = components.is_vertical(components.name_of(path), title if titled else "", header)
    return Record(np.array(samples) * to_si, dt, name or title, source, is_vertical)


def _glued(fields: Sequence[str], path: FilePath, line: int, before: int) -> list[float]:
    """The numbers of a line one by one, those that stand without a blank between them too."""
    parts = [
        part
        for field in fields
        for part in ([field] if _looks_numeric(field) else _GLUED.split(field))
    ]
    return [_number(part, path, line, f"sample {n}") for n, part in enumerate(parts, before + 1)]


def _last_header_line(head: Sequence[str]) -> int | None:
    for number, line in enumerate(head, 1):
        comment = line.lstrip().startswith(_COMMENTS)
        if not comment and (_NPTS.search(line) or _old_npts_and_dt(line)):
            return number
    return None


def _old_npts_and_dt(text: str) -> list[str] | None:
    """The two words before "NPTS, DT"; None for another line."""
    found = _OLD_STEP_LINE.search(text)
    words = text[: found.start()].rstrip(" \t,:").replace(",", " ").split() if found else []
    return words if len(words) == 2 else None


def _npts_and_dt(path: FilePath, line: int, text: str) -> tuple[str, float]:
    """Number of values, in plain digits, and time step [s] of the last line of the header."""
    if (npts_found := _NPTS.search(text)) is not None:
        dt_found = _DT.search(text)
        npts = npts_found[1]
        dt_text, dt_unit = (dt_found[1], dt_found[2].lower()) if dt_found else ("", "")
    else:
        old = _old_npts_and_dt(text)
        assert old is not None  # one of both, or this were not the last line of the header
        npts, dt_text, dt_unit = *old, ""
    if not (npts.isascii() and npts.isdecimal()):
        what = f"NPTS is {_short(npts)} in {_short(text)}, not a whole number"
        raise InputError.at(path, line, what, "correct the header or download the record again")
    dt = _number(dt_text, path, line, "DT") if _NUMBER.fullmatch(dt_text) else 0.0
    if dt <= 0.0:
        missing = f"DT is missing: no number follows it in {_short(text)}"
        what = f"DT is {_cut(dt_text)} s, not positive" if _NUMBER.fullmatch(dt_text) else missing
        remedy = "write the time step in seconds, as in DT= .0100 SEC"
        raise InputError.at(path, line, what, remedy)
    if dt_unit not in ("", *_SECONDS):
        what = f"DT is in {_short(dt_unit)} in {_short(text)}"
        raise InputError.at(path, line, what, "write the time step in seconds")
    return npts.lstrip("0") or "0", dt


# -- columns of text -----------------------------------------------------------------------------

_SECONDS = ("s", "sec", "secs", "second", "seconds")
_OTHER_TIMES = ("ms", "msec", "millisecond", "milliseconds", "min", "minutes", "h", "hours")
# A letter before any digit, or one that is in no number: "E" and "0deg", not "0,5E-03" or "***".
_NAME = re.compile(r"[^\d+\-.]*[^\W\d_]|.*[^\W\d_eEdD]")
_BRACKETED = re.compile(r"[\[(]([^\[\]()]+)[\])]")
_NAME_WITH_UNIT = re.compile(r"[^\s\[(]+(?:\s*[\[(][^\[\]()]*[\])])?")
_EXACT = Context(prec=28)  # not the caller's
_FROM_CSV = "see GroundMotion.from_csv"
_WRAPPED = '; {dt:0.01} and {layout:"wrapped"} read values that run on'


_Block = list[tuple[int, list[str]]]


@dataclass(frozen=True)
class _Table:
    """Rows of a text file behind its line of names, if there is one; all have one width."""

    text: _Text
    delimiter: str | None
    header_line: int | None
    names: list[str]
    first_line: int
    first: list[str]

    def blocks(self) -> Iterator[_Block]:
        """Rows of fields with the numbers of their lines, some thousand at once."""
        path, width = self.text.path, len(self.first)
        for block in self.text.content():
            rows = [
                (number, _fields(path, number, line, self.delimiter))
                for number, line in block
                if number >= self.first_line
            ]
            for number, row in rows:
                if len(row) != width:
                    what = f"{len(row)} columns, where line {self.first_line} has {width}"
                    remedy = "complete this line, or write comments behind #"
                    remedy += "" if self.names else _WRAPPED
                    raise InputError.at(path, number, what, remedy)
            if rows:
                yield rows

    def row(self, n: int) -> tuple[int, list[str]]:
        """Row n, counted from 0, with the number of its line."""
        return next(islice(chain.from_iterable(self.blocks()), n, None))


def _columns(text: _Text, units: str | None, gravity: float, name: str | None) -> Record:
    table = _table(text)
    width = len(table.first)
    if width < 2:
        what, remedy = "one column, where two are needed", "for accelerations alone give {dt:0.01}"
        raise InputError.at(text.path, table.first_line, what, remedy, "dt").so(remedy, _FROM_CSV)
    if width > 2:
        what = f"{width} columns ({_short(' | '.join(table.first))}), where two are needed"
        remedy = (
            "name the columns of time and acceleration by {time_column}, and write numbers with a "
        )
        remedy += "decimal point" if table.names else f"decimal point{_WRAPPED}"
        error = InputError.at(text.path, table.first_line, what, remedy, "time_column")
        raise error.so(remedy, _FROM_CSV)
    return _record(table, 0, 1, units, gravity, name)


def _table(text: _Text) -> _Table:
    path, head = text.path, _head(text)
    if last := _last_header_line(head):
        what = f"this is the header of a PEER record: {_short(head[last - 1])}"
        remedy = "let its name end in .AT2"
        raise InputError.at(path, last, what, remedy).so(remedy, "or take GroundMotion.from_at2")
    start = list(islice(chain.from_iterable(text.content()), 2))  # a heading perhaps, and a row
    if not start:
        raise InputError.at(path, None, "the file holds nothing but comments", _GET_AGAIN)
    # The second holds numbers for certain; a heading may hold commas of its own.
    delimiter = next((d for d in ";," if d in start[-1][1]), None)

    names: list[str] = []
    header_line = None
    number, line = start[0]
    first = _fields(path, number, line, delimiter)
    if any(first) and all(not f or (_NAME.match(f) and not _looks_numeric(f)) for f in first):
        header_line, names = number, _names(path, number, line, delimiter)
        if len(start) < 2:
            raise InputError.at(path, number, "no numbers follow the heading", _GET_AGAIN)
        number, line = start[1]
        first = _fields(path, number, line, delimiter)
    return _Table(text, delimiter, header_line, names, number, first)


def _fields(path: FilePath, number: int, line: str, delimiter: str | None) -> list[str]:
    if delimiter is None:
        return line.split()
    fields = line.split(delimiter)
    if '"' in line:  # fields that may hold the delimiter
        tight = re.sub(rf'"\s+{delimiter}', f'"{delimiter}', line)
        reader = csv.reader([tight], delimiter=delimiter, skipinitialspace=True, strict=True)
        try:
            fields = next(reader)
        except csv.Error as error:
            what = f"the fields of {_short(line)} cannot be told apart ({error})"
            remedy = f"write plain numbers with {delimiter!r} between them, without quotes"
            raise InputError.at(path, number, what, remedy) from None
    fields = [field.strip() for field in fields]
    return fields[:-1] if len(fields) > 1 and not fields[-1] else fields


def _names(path: FilePath, number: int, line: str, delimiter: str | None) -> list[str]:
    if delimiter is not None:
        return _fields(path, number, line, delimiter)
    if "\t" in line:
        return [name.strip() for name in re.split(r"\t+", line)]
    return _NAME_WITH_UNIT.findall(line)


def _column(table: _Table, wanted: Column) -> int:
    path, width = table.text.path, len(table.first)
    if is_number(wanted) and wanted == int(wanted):
        if 0 <= (index := int(wanted)) < width:
            return index
        what = f"column {wanted} does not exist: there are {width}"
        raise InputError.at(path, table.first_line, what, f"count from 0 to {width - 1}", "column")
    if table.names.count(str(wanted)) == 1:
        return table.names.index(str(wanted))
    known = ", ".join(map(_short, table.names[:20])) or "none: the file has no heading"
    if len(table.names) > 20:
        known += f", and {len(table.names) - 20} more"
    what = f"no single column is called {described(wanted)}; the names are {known}"
    remedy = "use one of these names, or the column's number (the first is 0)"
    raise InputError.at(path, table.header_line, what, remedy)


def _record(
    table: _Table,
    time: int | float,
    acceleration: int,
    units: str | None,
    gravity: float,
    name: str | None,
    values: np.ndarray | None = None,
) -> Record:
    """time : the number of its column, or the time step [s] as a float.

    values : the accelerations (n,), if they are not those of a column.
    """
    path = table.text.path
    in_file = _unit_in_heading(table, acceleration)
    in_file = in_file if in_file is not None and is_known(in_file) else None
    to_si = _factor(path, table.header_line, in_file, units, gravity)
    if isinstance(time, float):
        start, dt = 0.0, time
        a = _values(table, acceleration) if values is None else values
    else:
        start, dt, (a,) = _sampled(table, time, {acceleration: "acceleration"})
    source = in_text(path).name
    if start != 0.0:
        source += f", whose time {start:g} s is the start of the motion"
    header = [line for _, line in islice(table.text.lines(), table.first_line - 1)]
    if len(table.names) == len(table.first):
        heading = _BRACKETED.sub("", table.names[acceleration]).strip()
        header.insert(0, f"component: {components.split(heading)[1]}")
    file_name = components.name_of(path)
    is_vertical = components.is_vertical(file_name, header=header)
    return Record(a * to_si, dt, name or file_name, source, is_vertical)


def _values(table: _Table, column: int) -> np.ndarray:
    """The numbers (n,) of a column."""
    values = array("d")
    for block in table.blocks():
        values.extend(_of_block(table, block, column, "acceleration", len(values)))
    return np.array(values)


def _of_block(table: _Table, block: _Block, column: int, what: str, before: int) -> list[float]:
    """The numbers of a column in a block, after so many before; `what` names them in an error."""
    return _numbers([row[column] for _, row in block]) or [  # one by one, which tells the line
        _number(row[column], table.text.path, line, f"{what} of sample {n}")
        for n, (line, row) in enumerate(block, before + 1)
    ]


def _in_sequence(table: _Table) -> np.ndarray:
    """The numbers (n,) of all rows, one after the other; the last row may be shorter."""
    values, path = array("d"), table.text.path
    for line, text in chain.from_iterable(table.text.content()):
        if line < table.first_line:
            continue
        if len(values) % len(table.first):
            what = f"{len(values)} values stand above, and the first line has {len(table.first)}"
            raise InputError.at(path, line, what, "complete the line above")
        fields = _fields(path, line, text, table.delimiter)
        values.extend(_numbers(fields) or _glued(fields, path, line, len(values)))
    return np.array(values)


def _runs_on(table: _Table) -> bool:
    """Whether numbers change less from column to column than from row to row."""
    rows = [_numbers(row) for _, row in chain.from_iterable(table.blocks())]
    if len(table.first) == 1 or None in rows:
        return False
    x = np.array(rows)
    across, down = np.abs(np.diff(x.ravel())), np.abs(np.diff(x, axis=0))
    return len(x) == 1 or bool(across.mean() < down.mean())


def _sampled(
    table: _Table, time: int, columns: Mapping[int, str]
) -> tuple[float, float, list[np.ndarray]]:
    """(first time [s], step [s], values (n,) of each column) of a table with an even time column.

    columns : number of a column -> what an error calls it.
    """
    path = table.text.path
    time_unit = _unit_in_heading(table, time)
    if time_unit is not None and time_unit.lower() in _OTHER_TIMES:
        what = f"time is in {time_unit!r}"
        raise InputError.at(path, table.header_line, what, "convert the time column to seconds")

    called = {time: "time"} | dict(columns)
    found = {column: array("d") for column in called}
    last_digits, leading = array("q"), array("q")
    ends: list[Decimal] = []
    for block in table.blocks():
        for c, what in called.items():
            found[c].extend(_of_block(table, block, c, what, len(found[c])))
        for line, row in block:
            exact = _decimal(path, line, row[time])
            last_digits.append(int(exact.as_tuple().exponent))
            leading.append(exact.adjusted())
            ends[1:] = [exact]
    t = np.array(found[time])
    if len(t) < 2:
        what = "one sample, where a record needs two or more"
        raise InputError.at(path, table.first_line, what, _GET_AGAIN)
    mean = _EXACT.divide(_EXACT.subtract(*reversed(ends)), len(t) - 1)
    dt = float(mean)  # 0.02, not 0.019999999999999997
    digit = _last_printed_digit(np.array(last_digits), np.array(leading))
    _check_steps(table, time, t, dt, digit)
    return float(t[0]), dt, [np.array(found[c]) for c in columns]


def _decimal(path: FilePath, line: int, text: str) -> Decimal:
    """A finite time as it is printed."""
    try:
        return Decimal(_pythonic(text), _EXACT)
    except InvalidOperation:  # "0E99999999999999999999"
        what = f"time is {_cut(text)}, whose exponent no time has"
        raise InputError.at(path, line, what, "write the time in seconds, as 0.01") from None


def _unit_in_heading(table: _Table, column: int) -> str | None:
    """The words in brackets behind a column's name, as in "time (s)"."""
    if len(table.names) != len(table.first):
        return None
    found = _BRACKETED.search(table.names[column])
    return found[1].strip() if found else None


def _check_steps(
    table: _Table, column: int, times: np.ndarray, dt: float, digit: np.ndarray
) -> None:
    """Raise InputError where the step of a time column is not even.

    times : (n,) [s]; dt : their mean step [s]; digit : (n,) unit of the last digit of each.

    Printed times are rounded: steps of 1/256 s read 0.004, 0.004, 0.003 with three decimals. So a
    time may lie off the even grid, and a step off the mean, by one unit of the last printed digit,
    and by what such a unit at the end does to the mean. That excuse ends where the digits are as
    coarse as a third of the step, because a missing sample could hide behind it. Times that went
    through single precision carry noise of their own: a hundredth of a step is always allowed.
    """
    path = table.text.path

    def row(n: int) -> tuple[int, str]:
        line, fields = table.row(n)
        return line, fields[column]

    steps = np.diff(times)
    for n in np.flatnonzero(steps <= 0)[:1]:
        (before, earlier), (line, text) = row(n), row(n + 1)
        what = f"time {_cut(text)} s does not come after {_cut(earlier)} s of line {before}"
        remedy = "give increasing times, printed with enough digits, of one record only"
        raise InputError.at(path, line, what, remedy)

    allowed = np.where(digit < dt / 3, np.maximum(digit, 0.01 * dt), 0.01 * dt)
    of_mean = max(allowed[0], allowed[-1]) / len(steps)
    of_step = np.maximum(allowed[1:], allowed[:-1]) + of_mean
    index = np.arange(len(times))
    off_grid = np.abs(times - times[0] - dt * index) / (allowed + of_mean * index)
    if (np.abs(steps - dt) <= of_step).all() and (off_grid <= 1.0).all():
        return

    # The mean is spoilt by what is wrong, the median is not.
    usual = float(np.median(steps))
    beyond = np.abs(steps - usual) > np.maximum(of_step, 0.01 * usual)
    if beyond.any():
        n = int(np.argmax(beyond)) + 1
        line, text = row(n)
        found = f"the step to {_cut(text)} s is {steps[n - 1]:.6g} s, the usual step {usual:.6g} s"
    else:  # no step stands out, but they drift
        n = int(np.argmax(off_grid))
        line, text = row(n)
        before, after = steps[:n].mean(), steps[n:].mean()
        found = f"up to {_cut(text)} s the mean step is {before:.6g} s, after it {after:.6g} s"
    what = f"the time column is not uniform: {found}"
    remedy = "resample to a uniform step"
    raise InputError.at(path, line, what, remedy).so(remedy, "numpy.interp does, for from_array")


def _last_printed_digit(last_digits: np.ndarray, leading: np.ndarray) -> np.ndarray:
    """Unit of the last digit (n,) of printed numbers, whether decimals or digits are fixed.

    last_digits, leading : (n,) powers of ten of the last and of the first digit of each. A single
    number does not tell, "1" may stand for 1.00; so the file's largest numbers of decimals and of
    significant digits count together.
    """
    digits = (leading - last_digits).max()
    with np.errstate(over="ignore"):
        return 10.0 ** np.maximum(last_digits.min(), leading - digits).astype(float)


# -- tables of tests -----------------------------------------------------------------------------


@dataclass(frozen=True)
class TextTable:
    """Cells of a table of words and numbers with a heading, as they are written.

    names : of the columns, without the units that stand behind them in brackets, and their places.
    rows : the number of the line of each row, and its cells.
    """

    names: Mapping[str, int]
    rows: tuple[tuple[int, list[str]], ...]
    _table: _Table

    def error(self, row: int | None, what: str, remedy: str) -> InputError:
        """The error of a row, or of the heading."""
        line = self._table.header_line if row is None else self.rows[row][0]
        return InputError.at(self._table.text.path, line, what, remedy)

    def text(self, row: int, name: str) -> str:
        """The cell of a row below a name, without blanks around it."""
        return self.rows[row][1][self.names[name]]

    def number(self, row: int, name: str) -> float:
        """The finite number of a cell."""
        line, cells = self.rows[row]
        cell = cells[self.names[name]]
        return _number(cell, self._table.text.path, line, f"{name} of row {row + 1}")

    def factor(self, name: str, asked: str | None, gravity: float) -> float:
        """The factor to SI of a column, from its heading or from the caller."""
        return _channel_factor(self._table, self.names[name], name, asked, gravity)


def read_table(path: FilePath) -> TextTable:
    """A table of words and numbers, whose first line names its columns.

    Raises InputError for a file without such a line, for two columns of one name, and for a row
    that has more or fewer cells than names.
    """
    table = _table(_open(path))
    names = Counter(_BRACKETED.sub("", name).strip() for name in table.names)
    if not names or table.header_line is None:
        remedy = "write a first line with a name for each column, such as test, peak (deg), outcome"
        raise InputError.at(path, None, "the columns have no names", remedy)
    for name, times in names.items():
        if not name or times > 1:
            what = f"{times} column(s) are called {_short(name)}"
            raise InputError.at(path, table.header_line, what, "give each a name of its own")
    rows = []
    for number, line in chain.from_iterable(table.text.content()):
        if number <= table.header_line:
            continue
        cells = _fields(path, number, line, table.delimiter)
        if len(cells) == len(names) - 1:
            cells.append("")  # a last cell that is empty
        if len(cells) != len(names):
            what = f"{len(cells)} cells, where the heading has {len(names)}"
            remedy = "complete this line; put what holds a comma in double quotes"
            raise InputError.at(path, number, what, remedy)
        rows.append((number, cells))
    width = replace(table, first=[""] * len(names))  # as the heading has it
    return TextTable({name: i for i, name in enumerate(names)}, tuple(rows), width)
