"""Text files of records: their bytes and lines, and the numbers in them.

A reader returns what the file says, in SI units, or raises `InputError`: it fills no gap, drops no
value and guesses no unit.

The bytes of a file are held once, and its lines are made one at a time. The time is in proportion
to the length of the file: no pattern here goes over the same letters again and again, and those of
the grammars, which do, see short lines only (`grammar.LONGEST_LINE`).
"""

from __future__ import annotations

import codecs
import io
import math
import os
import re
import stat
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from rockeom.motion.units import NAMES, factor, is_known
from rockeom.numbers.checks import FilePath, InputError, InputTypeError

# -- files ---------------------------------------------------------------------------------------

_LARGEST_FILE = 2**30  # bytes; three days of a thousand samples a second
_LONGEST_LINE = 2**20  # letters
_BLOCK = 2**20  # bytes read at once
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1f\x7f]")
_LINE_END = re.compile(rb"\r\n?|\n")

COMMENTS = ("#", "%")
_ROWS = 4096  # that are read at once
GET_AGAIN = "open the file in a text editor, and download or export it again"
_OTHER_QUANTITY = {".vt2": "velocity", ".dt2": "displacement"}


@dataclass(frozen=True)
class Text:
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
            yield [(number, line) for number, line in stripped if line and line[0] not in COMMENTS]


def opened(path: FilePath) -> Text:
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
        raise other_quantity(path, None, quantity, f"the name ends in {Path(path).suffix}")
    # A mark at the start, of UTF-8; an end of file under DOS.
    raw = _bytes(path).removeprefix(codecs.BOM_UTF8).rstrip(b"\x1a")
    if not raw or raw.isspace():
        raise InputError.at(path, None, f"the file is empty ({len(raw)} bytes)", GET_AGAIN)
    if junk := _CONTROL.search(raw):
        before = sum(1 for _ in _LINE_END.finditer(raw, 0, junk.start()))
        what = f"the file is not plain text (byte {junk[0][0]})"
        remedy = "unpack it if it is an archive, or export it as text (UTF-8)"
        raise InputError.at(path, 1 + before, what, remedy)
    text = Text(path, raw, _encoding(raw))
    for number, line in text.lines():
        if first := line.strip():
            if first.startswith("<"):
                what = f"this is a web page (HTML), not a record: {short(first)}"
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


class OtherQuantityError(InputError):
    """A record of velocity, displacement, spectra or counts, which a set leaves out and names."""


def other_quantity(path: FilePath, line: int | None, quantity: str, why: str) -> OtherQuantityError:
    what = f"this is a record of {quantity}, not of acceleration: {why}"
    return OtherQuantityError.at(
        path, line, what, "use the acceleration record of the station (.AT2, .ACC)"
    )


def cut(text: str) -> str:
    text = text.strip()
    return text if len(text) <= 60 else text[:57] + "..."


def short(text: str) -> str:
    return repr(cut(text))


# -- numbers -------------------------------------------------------------------------------------

# Stricter than float(), which takes "1_000"; and Fortran's D for an exponent, which it does not.
NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
# Fixed-width fields may stand without a blank between them; a sign after a digit starts a number.
_GLUED = re.compile(r"(?<=[0-9.])(?=[+-])")
_PLAIN = re.compile(r"[0-9+\-.e\n]*")  # of these letters float() takes what NUMBER takes


def looks_numeric(text: str) -> bool:
    return bool(NUMBER.fullmatch(text) or _NOT_FINITE.fullmatch(text))


def pythonic(text: str) -> str:
    """A number as Python writes it: "1e-3" for "1D-3"."""
    return text.lower().replace("d", "e")


def number_of(text: str, path: FilePath, line: int, what: str) -> float:
    """The finite number that `text` says; `what` names it in the error."""
    if not looks_numeric(text):
        remedy = "give plain numbers with a decimal point, or correct this line"
        raise InputError.at(path, line, f"{what} is {short(text)}, which is no number", remedy)
    value = float(pythonic(text)) if NUMBER.fullmatch(text) else math.nan
    if not math.isfinite(value):
        remedy = "take the record from its source again, or decide yourself what belongs here"
        raise InputError.at(path, line, f"{what} is {cut(text)}, not a finite number", remedy)
    return value


def numbers_of(fields: Sequence[str]) -> list[float] | None:
    """The finite numbers that stripped fields say, all at once; None where one says none.

    As `number_of`, which is slower and tells what is wrong.
    """
    text = pythonic("\n".join(fields))
    if not _PLAIN.fullmatch(text):
        return None
    try:
        found = [float(field) for field in text.split("\n")]
    except ValueError:
        return None
    return found if all(map(math.isfinite, found)) else None


def stated_factor(
    path: FilePath, line: int | None, in_file: str | None, asked: str | None, gravity: float
) -> float:
    """The factor to m/s2 from the units that the file or the caller states."""
    stated = asked if asked is not None else in_file
    if stated is None:
        remedy = f"say {{units}}, one of {', '.join(NAMES)}"
        what = "the file does not say its units of acceleration"
        raise InputError.at(path, None, what, remedy, "units")
    if in_file is not None and not is_known(in_file):
        what = f"the file states accelerations in {short(in_file)}, which is unknown"
        raise InputError.at(path, line, what, f"correct it to one of {', '.join(NAMES)}")
    found = factor(stated, gravity)
    if in_file is not None and factor(in_file, gravity) != found:
        what = f"the file states accelerations in {in_file!r}, the caller in {asked!r}"
        raise InputError.at(path, line, what, "leave {units} out, or correct the file", "units")
    return found


def glued(fields: Sequence[str], path: FilePath, line: int, before: int) -> list[float]:
    """The numbers of a line one by one, those that stand without a blank between them too."""
    parts = [
        part
        for field in fields
        for part in ([field] if looks_numeric(field) else _GLUED.split(field))
    ]
    return [number_of(part, path, line, f"sample {n}") for n, part in enumerate(parts, before + 1)]
