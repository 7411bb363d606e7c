"""The verdicts of all statements as they were last reviewed: `data/statements.csv`.

A row has the digest of a statement (place, quotation, limits, unit, evidence ...), its verdict and
the numbers of its finding. After a change that is meant

    python -m tests.thesis.pins

writes the file anew, and the difference is what to review.
"""

import csv
import hashlib
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from rockeom.thesis.statements import STATEMENTS, Judgement
from rockeom.thesis.statements.statement import Finding, Statement

PATH = Path(__file__).parent / "data" / "statements.csv"


class Pin(NamedTuple):
    """One row: `found` has the ends of each number, with blanks between numbers."""

    function: str
    digest: str
    verdict: str
    found: str


def digest(one: Statement) -> str:
    """Digest of all that a statement says and is judged by."""
    parts = (
        one.place, one.figure, one.words, one.scan, one.lost, one.correction, one.limits.unit,
        one.limits.why, one.limits.low.tolist(), one.limits.high.tolist(), one.evidence,
    )  # fmt: skip
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:8]


def numbers(finding: Finding | None) -> str:
    """The numbers of a finding to six digits, a range as "low:high"."""
    if finding is None:
        return "no record"
    pairs = zip(finding.low, finding.high, strict=True)
    return " ".join(f"{a:.6g}" if a == b else f"{a:.6g}:{b:.6g}" for a, b in pairs)


def pin(one: Judgement) -> Pin:
    """The row of a judgement."""
    of = one.statement
    return Pin(of.function, digest(of), one.verdict.value, numbers(one.finding))


def pinned() -> list[Pin]:
    """The rows, in the order of the statements."""
    with PATH.open(encoding="utf-8", newline="") as file:
        return [Pin(*row) for row in csv.reader(file)][1:]


def write(judgements: Iterable[Judgement]) -> None:
    """Write the file."""
    with PATH.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Pin._fields)
        writer.writerows(map(pin, judgements))


if __name__ == "__main__":
    write(one.judged() for one in STATEMENTS)
