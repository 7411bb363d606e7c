"""Statements of the thesis with a number, each judged by the same rule.

    from rockeom.thesis import statements

    (one,) = statements.of_figure("2-22")
    one.judged().verdict                 # holds, differs or open
    statements.select("4.9.1", "4-20")   # of a section, a table or a figure
    statements.counts(one.judged() for one in statements.STATEMENTS)   # of all, in a minute

The statements are rows of `table.csv`: place, figure, quotation, limits, evidence, and the function
that finds the number. The modules here hold these functions, by subject; the rule that judges is in
`rockeom.thesis.statements.statement`. The equations have verdicts of their own, in
`rockeom.thesis.verify`.
"""

import csv
from collections import Counter
from collections.abc import Iterable
from importlib.resources import files

from rockeom.thesis.statements.statement import Judgement, Statement, Verdict, from_row

__all__ = ["STATEMENTS", "Judgement", "Statement", "Verdict", "counts", "of_figure", "select"]

_TABLE = files(__name__).joinpath("table.csv").read_text(encoding="utf-8")
STATEMENTS: tuple[Statement, ...] = tuple(map(from_row, csv.DictReader(_TABLE.splitlines())))
"""All statements, by chapter."""


def of_figure(number: str) -> tuple[Statement, ...]:
    """Statements that a figure shows, such as "4-20"."""
    return tuple(one for one in STATEMENTS if one.figure == number)


def select(*names: str) -> tuple[Statement, ...]:
    """Statements of figures ("4-20"), sections with their parts ("4.9") and tables ("Table 4-2").

    Capital letters make no difference. KeyError for a name without statements.
    """
    chosen: list[Statement] = []
    for name in names:
        asked = name.casefold()
        of_name = [one for one in STATEMENTS if asked == one.figure or _within(one.place, asked)]
        if not of_name:
            raise KeyError(
                f"no statement of {name!r}: name a section, 4.8.1, a figure, 4-20, or a table, "
                "Table 4-2"
            )
        chosen += [one for one in of_name if one not in chosen]
    return tuple(chosen)


def _within(place: str, name: str) -> bool:
    """Whether a place belongs to a section, a table or a figure; "4.9.1" belongs to "4.9"."""
    parts = [part.strip() for part in place.casefold().split(",")]
    return name == place.casefold() or any(p == name or p.startswith(f"{name}.") for p in parts)


def counts(judgements: Iterable[Judgement]) -> dict[Verdict, int]:
    """How many have each verdict."""
    counted = Counter(one.verdict for one in judgements)
    return {verdict: counted[verdict] for verdict in Verdict}
