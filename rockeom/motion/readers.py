"""Readers of records: accelerations (PEER .AT2, columns of text) and the channels of a test.

A reader returns what the file says, in SI units, or raises `InputError`: it fills no gap, drops no
value and guesses no unit.

The bytes of a file are held once, and its lines are made one at a time. The time is in proportion
to the length of the file: no pattern here goes over the same letters again and again.
"""

from __future__ import annotations

import csv
import re
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
from rockeom.motion.formats import grammar_of, read_components
from rockeom.motion.formats.peer import head_of, is_header_of, last_header_line, read_at2
from rockeom.motion.formats.text import (
    GET_AGAIN,
    Text,
    cut,
    glued,
    looks_numeric,
    number_of,
    numbers_of,
    opened,
    pythonic,
    short,
    stated_factor,
)  # fmt: skip
from rockeom.motion.record import Origin, Record
from rockeom.motion.units import CHANNEL_UNITS, channel_factor, is_known
from rockeom.numbers.checks import FilePath, InputError, described, is_number, positive_number

Column = str | int


class Channels(NamedTuple):
    """Channels of a test, (n,) each, in SI units, at start, start + dt ... [s]."""

    start: float
    dt: float
    values: dict[str, np.ndarray]
    name: str


def is_recognised(path: FilePath) -> bool:
    """Whether a file is one of a network or of PEER; False for one that cannot be read as text."""
    try:
        text = opened(path)
        return grammar_of(text) is not None or is_header_of(head_of(text))
    except InputError:
        return False


def read_file(
    path: FilePath, units: str | None, gravity: float, stated_peak: bool = True
) -> list[Record]:
    """All components of a file of a network, or the one of a PEER record or of two columns."""
    text = opened(path)
    every = read_components(text, gravity, stated_peak)
    if every is None:
        return [read(path, units, gravity, None)]
    if units is not None:
        what = f"its format states the unit, {every[0].unit}"
        raise InputError.at(path, None, what, "leave {units} out", "units")
    name = components.name_of(path)
    (one, *others) = every
    if not others and one.azimuth is None and not one.is_vertical:  # the name of the file may tell
        every = [replace(one, is_vertical=components.is_vertical(name))]
    directions = [one.name for one in every]
    named = [
        f"{name}, {f'{n} ' * (directions.count(of) > 1)}{of}" for n, of in enumerate(directions, 1)
    ]
    return [
        Record(
            one.acceleration, one.dt, name if len(every) == 1 else own_name,
            f"{in_text(path).name}, {one.name} at {one.station}"
            + (", turned positive upwards" if one.is_down else ""), one.is_vertical,
            Origin(one.station, " ".join(one.event.split()), one.name, one.azimuth, one.stage),
        )
        for one, own_name in zip(every, named, strict=True)
    ]  # fmt: skip


def one_component(path: FilePath, records: list[Record], component: str | float | None) -> Record:
    """The record of a component: by its name, its number from 1 on, or its azimuth [degrees]."""
    if component is None and len(records) == 1:
        return records[0]
    listed = ", ".join(
        f"{n} {one.component or 'without a name'}" for n, one in enumerate(records, 1)
    )
    if component is None:
        what = f"it holds {len(records)} components: {listed}"
        remedy = "choose one by {component}"
        error = InputError.at(path, None, what, remedy, "component")
        raise error.so(remedy, "rk.Recording.read reads all")
    found = [one for one in records if _letters(one.component) == _letters(str(component))]
    number = _whole(component)
    if not found and number is not None:
        numbered = records[number - 1 : number] if number > 0 else []
        found = numbered or [one for one in records if one.azimuth == number % 360]
    if len(found) != 1:
        what = f"{len(found)} of its components are {described(component)}: {listed}"
        remedy = "give {component} as a number" + " or name" * (not found)
        raise InputError.at(path, None, what, remedy, "component")
    return found[0]


def _letters(direction: str) -> str:
    """A direction by its letters and digits: "E-W" and "ew" are one."""
    return "".join(filter(str.isalnum, direction.lower()))


def _whole(component: str | float) -> int | None:
    """The whole number that a component is given by; a text may hold it."""
    if isinstance(component, str):
        return int(component) if component.strip().isdecimal() else None
    return int(component) if is_number(component) and float(component).is_integer() else None


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
    text = opened(path)
    if is_at2 is None:
        is_at2 = Path(path).suffix.lower() == ".at2" or last_header_line(head_of(text)) is not None
    return (read_at2 if is_at2 else _columns)(text, units, gravity, name)


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
    table = _table(opened(path))
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
    table = _table(opened(path))
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
            known = ", ".join(short(n) for i, n in enumerate(bare) if i != time)
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
        raise InputError.at(path, line, f"nothing says the unit of {short(name)}", remedy, "units")
    if not isinstance(stated, str) or (found := channel_factor(stated, gravity)) is None:
        what = f"the unit of {short(name)} is {described(stated)}, which is unknown"
        raise InputError.at(path, line, what, f"give one of {known}", "units")
    if in_file is not None and asked is not None and channel_factor(in_file, gravity) != found:
        what = f"the heading states {short(name)} in {in_file!r}, the caller in {asked!r}"
        raise InputError.at(
            path, line, what, "leave it out of {units}, or correct the file", "units"
        )
    return found


# -- columns of text -----------------------------------------------------------------------------

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

    text: Text
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


def _columns(text: Text, units: str | None, gravity: float, name: str | None) -> Record:
    table = _table(text)
    width = len(table.first)
    if width < 2:
        what, remedy = "one column, where two are needed", "for accelerations alone give {dt:0.01}"
        raise InputError.at(text.path, table.first_line, what, remedy, "dt").so(remedy, _FROM_CSV)
    if width > 2:
        what = f"{width} columns ({short(' | '.join(table.first))}), where two are needed"
        remedy = (
            "name the columns of time and acceleration by {time_column}, and write numbers with a "
        )
        remedy += "decimal point" if table.names else f"decimal point{_WRAPPED}"
        error = InputError.at(text.path, table.first_line, what, remedy, "time_column")
        raise error.so(remedy, _FROM_CSV)
    return _record(table, 0, 1, units, gravity, name)


def _table(text: Text) -> _Table:
    path, head = text.path, head_of(text)
    if last := last_header_line(head):
        what = f"this is the header of a PEER record: {short(head[last - 1])}"
        remedy = "let its name end in .AT2"
        raise InputError.at(path, last, what, remedy).so(remedy, "or take GroundMotion.from_at2")
    start = list(islice(chain.from_iterable(text.content()), 2))  # a heading perhaps, and a row
    if not start:
        raise InputError.at(path, None, "the file holds nothing but comments", GET_AGAIN)
    # The second holds numbers for certain; a heading may hold commas of its own.
    delimiter = next((d for d in ";," if d in start[-1][1]), None)

    names: list[str] = []
    header_line = None
    number, line = start[0]
    first = _fields(path, number, line, delimiter)
    if any(first) and all(not f or (_NAME.match(f) and not looks_numeric(f)) for f in first):
        header_line, names = number, _names(path, number, line, delimiter)
        if len(start) < 2:
            raise InputError.at(path, number, "no numbers follow the heading", GET_AGAIN)
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
            what = f"the fields of {short(line)} cannot be told apart ({error})"
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
    known = ", ".join(map(short, table.names[:20])) or "none: the file has no heading"
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
    to_si = stated_factor(path, table.header_line, in_file, units, gravity)
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
    return numbers_of([row[column] for _, row in block]) or [  # one by one, which tells the line
        number_of(row[column], table.text.path, line, f"{what} of sample {n}")
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
        values.extend(numbers_of(fields) or glued(fields, path, line, len(values)))
    return np.array(values)


def _runs_on(table: _Table) -> bool:
    """Whether numbers change less from column to column than from row to row."""
    rows = [numbers_of(row) for _, row in chain.from_iterable(table.blocks())]
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
        raise InputError.at(path, table.first_line, what, GET_AGAIN)
    mean = _EXACT.divide(_EXACT.subtract(*reversed(ends)), len(t) - 1)
    dt = float(mean)  # 0.02, not 0.019999999999999997
    digit = _last_printed_digit(np.array(last_digits), np.array(leading))
    _check_steps(table, time, t, dt, digit)
    return float(t[0]), dt, [np.array(found[c]) for c in columns]


def _decimal(path: FilePath, line: int, text: str) -> Decimal:
    """A finite time as it is printed."""
    try:
        return Decimal(pythonic(text), _EXACT)
    except InvalidOperation:  # "0E99999999999999999999"
        what = f"time is {cut(text)}, whose exponent no time has"
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
        what = f"time {cut(text)} s does not come after {cut(earlier)} s of line {before}"
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
        found = f"the step to {cut(text)} s is {steps[n - 1]:.6g} s, the usual step {usual:.6g} s"
    else:  # no step stands out, but they drift
        n = int(np.argmax(off_grid))
        line, text = row(n)
        before, after = steps[:n].mean(), steps[n:].mean()
        found = f"up to {cut(text)} s the mean step is {before:.6g} s, after it {after:.6g} s"
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
        return number_of(cell, self._table.text.path, line, f"{name} of row {row + 1}")

    def factor(self, name: str, asked: str | None, gravity: float) -> float:
        """The factor to SI of a column, from its heading or from the caller."""
        return _channel_factor(self._table, self.names[name], name, asked, gravity)


def read_table(path: FilePath) -> TextTable:
    """A table of words and numbers, whose first line names its columns.

    Raises InputError for a file without such a line, for two columns of one name, and for a row
    that has more or fewer cells than names.
    """
    table = _table(opened(path))
    names = Counter(_BRACKETED.sub("", name).strip() for name in table.names)
    if not names or table.header_line is None:
        remedy = "write a first line with a name for each column, such as test, peak (deg), outcome"
        raise InputError.at(path, None, "the columns have no names", remedy)
    for name, times in names.items():
        if not name or times > 1:
            what = f"{times} column(s) are called {short(name)}"
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
