"""Small changes of the thesis, drawn at random: python -m tests.thesis.changes [--seed N].

Each change is one that a slip of the hand could make, of one of five classes: a printed number, a
unit, a threshold, a quotation, a verdict. It is made in a copy of the project, whose tests of the
thesis run then: one of them must fail. What none notices is printed, and how many were noticed by
class. `shared` must lie beside the project, as for the tests of the quotations.
"""

import argparse
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from tests.shared import FOLDER

PROJECT = Path(__file__).resolve().parent.parent.parent
THESIS = PROJECT / "rockeom" / "thesis"
TESTS = "test_approved.py test_tables.py test_dimensions.py test_statements.py test_equations.py"
QUICK = "approved or printed_cells or printed_numbers or quotation or statement_is"
"""Tests that run first, since they take no time."""


class Piece(NamedTuple):
    """A piece of a file that may change."""

    path: Path
    start: int
    text: str


class Change(NamedTuple):
    """A piece of a file of the project, and what stands there instead."""

    kind: str
    of: Piece
    new: str

    def __str__(self) -> str:
        path, start, old = self.of
        line = path.read_text(encoding="utf-8").count("\n", 0, start) + 1
        return f"{self.kind}: {path.relative_to(PROJECT)}:{line}: {old!r} -> {self.new!r}"


def pieces(path: Path, pattern: str) -> Iterator[Piece]:
    """The first group of each match of a pattern in a file."""
    text = path.read_text(encoding="utf-8")
    for match in re.finditer(pattern, text, re.MULTILINE):
        if match[1].strip():
            yield Piece(path, match.start(1), match[1])


def cells(column: str) -> Iterator[Piece]:
    """Cells of a column of the table of statements."""
    path, cell = THESIS / "statements" / "table.csv", r'(?:"(?:[^"]|"")*"|[^",\n]*)'
    columns = path.read_text(encoding="utf-8").partition("\n")[0].split(",")
    before = f"(?:{cell},){{{columns.index(column)}}}"
    every = pieces(path, rf"^{before}({cell})(?:,|$)")
    yield from (one for one in every if one.text != column)


def another_digit(piece: str, draw: random.Random) -> str:
    """One digit is another."""
    place = draw.choice([i for i, x in enumerate(piece) if x.isdigit()])
    digit = draw.choice([x for x in "0123456789" if x != piece[place]])
    return piece[:place] + digit + piece[place + 1 :]


def another_unit(piece: str, draw: random.Random) -> str:
    return draw.choice(
        [x for x in ("mm", "m", "kN", "N", "rad", "s", "Hz", "%", "J") if x != piece]
    )


def another_letter(piece: str, draw: random.Random) -> str:
    """One letter is another, or a word is left out."""
    words = piece.split(" ")
    if len(words) > 3 and draw.random() < 0.5:
        del words[draw.randrange(1, len(words) - 1)]
        return " ".join(words)
    place = draw.choice([i for i, x in enumerate(piece) if x.isalnum()])
    letter = draw.choice([x for x in "aeiou" if x != piece[place]])
    return piece[:place] + letter + piece[place + 1 :]


def another_decision(piece: str, draw: random.Random) -> str:
    """A side of a limit is the other, an input is not lost, a correction or a choice is none."""
    return {"<=": ">=", ">=": "<=", "assumption=": "remark=", "undetermined=": "remark="}.get(
        piece, ""
    )


EQUATIONS = [*THESIS.glob("chapter_?.py"), THESIS / "section_2_6.py", *THESIS.glob("appendix_?.py")]


TABLES = [*sorted((THESIS / "data").glob("*.csv")), PROJECT / "rockeom/analysis/data/table_a1.csv"]


def printed_numbers() -> Iterator[Piece]:
    for path in TABLES:
        yield from pieces(path, r"(?:^|,)(-?\d[\d.]*)(?=,|$)")
    for path in EQUATIONS:
        yield from pieces(path, r"(?<![\w.\"-])(\d+\.\d+)")


def units() -> Iterator[Piece]:
    yield from cells("unit")
    for path in TABLES:
        yield from pieces(path, r"\[([^\]\n]+)\]")
    yield from pieces(THESIS / "notation.py", r'^(?:\w+ = )?\w+\(r?"[^"]+", (?:\d, \d, )?"([^"]+)"')


def verdicts() -> Iterator[Piece]:
    yield from (one for one in cells("lost") if one.text)
    yield from (one for one in cells("correction") if one.text)
    yield from pieces(THESIS / "statements" / "table.csv", r",([<>]=) ")
    for path in EQUATIONS:
        yield from pieces(path, r"\b((?:assumption|undetermined)=)")


def thresholds() -> Iterator[Piece]:
    yield from (one for one in cells("limits") if re.search(r"\d", one.text))
    for path in sorted((THESIS / "checks").glob("*.py")):
        yield from pieces(path, r"^[A-Z_]+ = (\d[\d.e-]*)$")


CLASSES: dict[str, tuple[Callable[[], Iterator[Piece]], Callable[[str, random.Random], str]]] = {
    "printed number": (printed_numbers, another_digit),
    "unit": (units, another_unit),
    "threshold": (thresholds, another_digit),
    "quotation": (lambda: cells("quotation"), another_letter),
    "verdict": (verdicts, another_decision),
}


def drawn(seed: int, number: int) -> Iterator[Change]:
    """Changes, as many of each class."""
    draw = random.Random(seed)
    there = {kind: list(of()) for kind, (of, _) in CLASSES.items()}
    for n in range(number):
        kind = list(CLASSES)[n % len(CLASSES)]
        piece = draw.choice(there[kind])
        yield Change(kind, piece, CLASSES[kind][1](piece.text, draw))


def fails(copy: Path) -> bool:
    """Whether a test of the thesis fails in a copy of the project."""
    run = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
    run += [f"tests/thesis/{name}" for name in TESTS.split()]
    tries = ([*run, "-k", QUICK], run)
    return any(
        subprocess.run(t, cwd=copy, capture_output=True, check=False).returncode for t in tries
    )


def noticed(change: Change, copy: Path) -> bool:
    """Whether a test fails in a copy of the project with a change."""
    (of, start, old), path = change.of, copy / change.of.path.relative_to(PROJECT)
    text = of.read_text(encoding="utf-8")
    path.write_text(text[:start] + change.new + text[start + len(old) :], encoding="utf-8")
    failed = fails(copy)
    path.write_text(text, encoding="utf-8")
    return failed


def copied(folder: Path) -> Path:
    """A copy of the project whose tests pass, in a folder."""
    copy = folder / "project"
    for name in ("rockeom", "generated", "tests"):
        shutil.copytree(PROJECT / name, copy / name)
    shutil.copy(PROJECT / "pyproject.toml", copy)
    (folder / "shared").symlink_to(FOLDER)
    if fails(copy):
        raise SystemExit("tests of the thesis fail without any change")
    return copy


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seed", type=int, default=54)
    parser.add_argument("--number", type=int, default=200)
    asked = parser.parse_args()
    seen: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        copy = copied(Path(folder))
        for change in drawn(asked.seed, asked.number):
            if noticed(change, copy):
                seen[change.kind] += 1
            else:
                print(f"survives: {change}", flush=True)
    print(", ".join(f"{kind} {seen[kind]}" for kind in CLASSES), f"of {asked.number} noticed")
    return int(sum(seen.values()) < asked.number)


if __name__ == "__main__":
    raise SystemExit(main())
