"""Every equation, its verdict and all that is said of it, as somebody last read and approved them.

    python -m tests.thesis.test_approved        writes data/equations.csv

The digest is that of `described`.
"""

import hashlib
from dataclasses import fields
from pathlib import Path

from rockeom.thesis import CHECKS, EQUATIONS, NOTATION, Equation, claim, entry

APPROVED = Path(__file__).parent / "data" / "equations.csv"


def described(one: Equation) -> str:
    """All that the catalogue holds of an equation."""
    formulas = {"printed", "restored", "correction"}
    lines = [one.kind.value]
    lines += [f"{f.name}: {getattr(one, f.name)}" for f in fields(one) if f.name not in formulas]
    lines += [*(one.lines("printed") if one.printed else ()), *one.lines(), *one.excess_lines]
    for symbol in one.symbols:
        of = entry(symbol, one.chapter)
        lines.append(f"{symbol} [{of.unit}]: {of.meaning}")
    lines += [f"{check.means}: {check.route} {check.error}" for check in CHECKS[one.number]]
    return "\n".join(lines)


def listing() -> str:
    rows = ["number,verdict,digest\n"]
    for number, one in EQUATIONS.items():
        digest = hashlib.sha256(described(one).encode()).hexdigest()[:12]
        rows.append(f"{number},{claim(one).name.lower()},{digest}\n")
    symbols = "\n".join(
        f"{one.symbol} [{one.unit}] {one.chapters}: {one.meaning}" for one in NOTATION
    )
    rows.append(f"notation,,{hashlib.sha256(symbols.encode()).hexdigest()[:12]}\n")
    return "".join(rows)


def test_equations_and_their_verdicts_are_those_that_were_approved():
    assert listing().splitlines() == APPROVED.read_text(encoding="utf-8").splitlines()


if __name__ == "__main__":
    APPROVED.write_text(listing(), encoding="utf-8")
