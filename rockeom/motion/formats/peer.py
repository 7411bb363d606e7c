"""PEER: .AT2, accelerations of one component, as NGA-West and NGA-East give them."""

from __future__ import annotations

import re
from array import array
from collections.abc import Sequence
from itertools import islice

import numpy as np

from rockeom.files import in_text
from rockeom.motion import components
from rockeom.motion.formats.text import (
    COMMENTS,
    NUMBER,
    Text,
    cut,
    glued,
    looks_numeric,
    number_of,
    numbers_of,
    other_quantity,
    short,
    stated_factor,
)  # fmt: skip
from rockeom.motion.record import Record
from rockeom.motion.units import factor, is_known
from rockeom.numbers.checks import FilePath, InputError

SECONDS = ("s", "sec", "secs", "second", "seconds")
_HEADER_LINES = 50  # far more than any header; a file without NPTS in them is no PEER record


def head_of(text: Text) -> list[str]:
    """The first lines, in which a header ends."""
    return [line for _, line in islice(text.lines(), _HEADER_LINES)]


_OLD_STEP_LINE = re.compile(r"\bNPTS\s*,\s*DT\b", re.IGNORECASE)
_NPTS = re.compile(r"\bNPTS\s*=\s*([^\s,]*)", re.IGNORECASE)
_DT = re.compile(rf"\bDT\s*=\s*({NUMBER.pattern}(?=[\s,a-z]|$)|[^\s,]*)\s*([a-z]*)", re.IGNORECASE)
_UNITS = re.compile(r"\bIN\s+UNITS?\s+OF\s+([A-Za-z][\w/*^]*)", re.IGNORECASE)
_OTHER_UNITS = re.compile(
    r"\bUNITS?\s*[:=]\s*\(?([A-Za-z][\w/*^]*)|"
    r"\bACC[A-Z.]*\b[^()]*?(?:\bIN\s+|[(\[]\s*)([A-Za-z][\w/*^]*)",
    re.IGNORECASE,
)
"""Units as other writers state them: "UNITS: G", "ACCELERATION IN G", "Acceleration (g)"."""
_WHOLE = re.compile(r"([0-9]+)\.0*")
"""A number of values as Fortran's reals print it: "103."."""
_QUANTITY = re.compile(
    r"\b(VELOCITY|DISPLACEMENT)\s+TIME\s+(?:SERIES|HISTORY)\b|"
    r"^\s*(VELOCITY|DISPLACEMENT)\s*(?:\bIN\b|[(\[])",
    re.IGNORECASE,
)


def read_at2(text: Text, units: str | None, gravity: float, name: str | None) -> Record:
    path, head = text.path, head_of(text)
    last = last_header_line(head)
    if last is None:
        what = f"no line with NPTS and DT among the first {len(head)}"
        remedy = "a PEER record has one; two columns are read from a file whose name ends otherwise"
        error = InputError.at(path, None, what, remedy)
        raise error.so(remedy, "GroundMotion.from_columns reads them under any name")
    header = head[: last - 1]
    for number, line in enumerate(header, 1):
        if found := _QUANTITY.search(line):
            raise other_quantity(
                path, number, (found[1] or found[2]).lower(), f"the header says {short(line)}"
            )
    npts, dt = _npts_and_dt(path, last, head[last - 1])

    stated = [(n, unit) for n, line in enumerate(header, 1) if (unit := _unit(line))]
    unit_line, in_file = stated[-1] if stated else (None, None)
    factors = {factor(unit, gravity) for _, unit in stated if is_known(unit)}
    if len(factors) > 1:
        what = f"the header states several units, {', '.join(unit for _, unit in stated)}"
        raise InputError.at(path, unit_line, what, "correct the header")
    to_si = stated_factor(path, unit_line, in_file, units, gravity)

    samples = array("d")
    for number, line in islice(text.lines(), last, None):
        if fields := line.split():
            samples.extend(numbers_of(fields) or glued(fields, path, number, len(samples)))
    if str(len(samples)) != npts:
        what = f"NPTS says {cut(npts)} values, but the file holds {len(samples)}"
        remedy = "the file is cut short or edited; download it again or correct NPTS"
        raise InputError.at(path, last, what, remedy)

    titled = len(header) >= 2 and unit_line != 2 and header[1].strip()
    title = " ".join(header[1].split()) if titled else in_text(path).stem
    source = f"{in_text(path).name}, line 2: {title}" if titled else in_text(path).name
    is_vertical = components.is_vertical(components.name_of(path), title if titled else "", header)
    return Record(np.array(samples) * to_si, dt, name or title, source, is_vertical)


def is_header_of(head: Sequence[str]) -> bool:
    """Whether lines are a header of PEER with numbers below it, and no prose that names NPTS."""
    last = last_header_line(head)
    below = next((line.split() for line in head[last:] if line.split()), []) if last else []
    return bool(below) and looks_numeric(below[0])


def _unit(line: str) -> str | None:
    """The unit that a line of the header states; one in other words must be known."""
    if found := _UNITS.search(line):
        return found[1]
    other = _OTHER_UNITS.search(line)
    unit = (other[1] or other[2]) if other else None
    return unit if unit is not None and is_known(unit) else None


def last_header_line(head: Sequence[str]) -> int | None:
    for number, line in enumerate(head, 1):
        comment = line.lstrip().startswith(COMMENTS)
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
        npts = whole[1] if (whole := _WHOLE.fullmatch(npts_found[1])) else npts_found[1]
        dt_text, dt_unit = (dt_found[1], dt_found[2].lower()) if dt_found else ("", "")
    else:
        old = _old_npts_and_dt(text)
        assert old is not None  # one of both, or this were not the last line of the header
        npts, dt_text, dt_unit = *old, ""
    if not (npts.isascii() and npts.isdecimal()):
        what = f"NPTS is {short(npts)} in {short(text)}, not a whole number"
        raise InputError.at(path, line, what, "correct the header or download the record again")
    dt = number_of(dt_text, path, line, "DT") if NUMBER.fullmatch(dt_text) else 0.0
    if dt <= 0.0:
        missing = f"DT is missing: no number follows it in {short(text)}"
        what = f"DT is {cut(dt_text)} s, not positive" if NUMBER.fullmatch(dt_text) else missing
        remedy = "write the time step in seconds, as in DT= .0100 SEC"
        raise InputError.at(path, line, what, remedy)
    if dt_unit not in ("", *SECONDS):
        what = f"DT is in {short(dt_unit)} in {short(text)}"
        raise InputError.at(path, line, what, "write the time step in seconds")
    return npts.lstrip("0") or "0", dt
