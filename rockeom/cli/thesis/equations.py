"""``rockeom thesis equations``: the equations of the thesis."""

import argparse
import textwrap

from rockeom import thesis
from rockeom.cli.errors import UsageError
from rockeom.cli.text.terminal import listing, width
from rockeom.modelling.named import FAMILIES
from rockeom.structures.classes import SHIPPED
from rockeom.symbolic.text.page import Block, Display, Heading, Table, to_text
from rockeom.thesis.typeset import written

DESCRIPTION = """\
List the numbered equations of Ma's thesis (2010), or show some of them: as printed, as corrected
where that is wrong, what it means, how it is derived, and the verdict of its checks.
"""
EPILOG = """\
examples:
  rockeom thesis equations                          all of them, a line each
  rockeom thesis equations --chapter 5 --verdict wrong
  rockeom thesis equations 5-34                     one, with its checks run
  rockeom thesis equations 2-9 D-23 --latex         for a paper: the forms that are right

rockeom thesis verify runs the checks of all equations.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "numbers", nargs="*", metavar="NUMBER", help="such as 5-34; all if left out"
    )
    parser.add_argument("--chapter", metavar="N", help="list those of chapter 2, 3, 4, 5, B or D")
    parser.add_argument(
        "--kind", metavar="WORDS", help='list those of a kind: "equation of motion"'
    )
    parser.add_argument("--verdict", metavar="WORDS", help='list those of a verdict: "wrong"')
    parser.add_argument("--latex", action="store_true", help="LaTeX, with the right forms only")


def run(args: argparse.Namespace) -> int:
    filters = [n for n in ("chapter", "kind", "verdict") if getattr(args, n)]
    if args.numbers and filters:
        raise UsageError(f"numbers and --{filters[0]} do not go together: leave one out")
    for name in args.numbers:
        if name in SHIPPED or name in FAMILIES:
            raise UsageError(
                f"{name} is a structure: rockeom derive {name} shows its equations; here are the "
                "numbered ones of the thesis, such as 5-34"
            )
    chosen = [thesis.equation(n) for n in args.numbers] or _filtered(args)
    if args.latex:
        for one in chosen:
            print(_latex(one))
    elif args.numbers:
        columns = width()
        print("\n\n".join(_shown(thesis.decide(one.number), columns) for one in chosen))
    else:
        print(_list(chosen))
    return 0


def _filtered(args: argparse.Namespace) -> list[thesis.Equation]:
    chosen = list(thesis.EQUATIONS.values())
    if args.chapter:
        chapters = sorted({e.chapter for e in chosen})
        if args.chapter.upper() not in chapters:
            raise UsageError(f"--chapter {args.chapter}: there are {', '.join(chapters)}")
        chosen = [e for e in chosen if e.chapter == args.chapter.upper()]
    for name, members, value in (
        ("kind", thesis.Kind, lambda e: e.kind),
        ("verdict", thesis.Verdict, thesis.claim),
    ):
        words = (getattr(args, name) or "").lower()
        if words:
            meanings = [m.value for m in members]
            if not any(words in k for k in meanings):
                raise UsageError(f"--{name} {words}: there are {'; '.join(meanings)}")
            chosen = [e for e in chosen if words in value(e).value]
    if not chosen:
        raise UsageError("no equation is all of that: leave one of the filters out")
    return chosen


def _list(chosen: list[thesis.Equation]) -> str:
    rows = [("", "VERDICT", "WHAT IT STATES")]
    rows += [(e.number, thesis.claim(e).value, e.meaning) for e in chosen]
    return f"{listing(rows)}\n\n{len(chosen)} equations; rockeom thesis equations NUMBER shows one."


def _shown(decision: thesis.Decision, columns: int) -> str:
    one = decision.equation
    blocks: list[Block] = [Heading(1, f"{one.number}  {one.meaning}")]
    where = one.section if one.section.startswith("App") else f"section {one.section}"
    blocks.append(f"{one.kind.value.capitalize()}, {where}: {decision.verdict.value}.")
    if one.printed:
        blocks += ["As printed:", Display(tuple(one.lines("printed")))]
    if one.corrected is not None:
        blocks += ["As it should be:", Display(tuple(one.lines("corrected"))), one.reason]
    if one.excess:
        blocks += ["Printed minus right:", Display(tuple(one.excess_lines))]
    if one.domain:
        blocks.append(f"The printed form is right where {one.domain.words}.")
    blocks += [text for text in (one.assumption, one.fitted, one.remark, one.undetermined) if text]
    blocks += ["Symbols:", Table(("", "", ""), _symbols(one))]
    blocks.append("Decided by:")
    text = to_text(blocks, columns)
    lines = []
    for check in decision.checks:
        error = f" Error: {check.error}." if check.error else ""
        lines.append(_point(f"{check.means.value}: {check.route}.{error}", columns))
    passed = sum(f.holds for f in decision.findings)
    lines.append(_point(f"{passed} of {len(decision.findings)} comparisons hold.", columns))
    for failed in (f for f in decision.against if not f.holds):
        rest = str(failed.rest)
        rest = rest if len(rest) <= 160 else f"{rest[:150]} ..."
        lines.append(_point(f"the printed form fails: {failed.what}: {rest}", columns))
    if decision.why:
        lines.append(_point(f"FAILED: {decision.why}", columns))
    return text + "\n" + "\n".join(lines)


def _symbols(one: thesis.Equation) -> tuple[tuple[str, ...], ...]:
    rows = []
    for symbol in one.symbols:
        meaning = thesis.entry(symbol, one.chapter)
        unit = "" if meaning.unit == "1" else meaning.unit
        rows.append((f"${written(symbol)}$", unit, meaning.meaning))
    return tuple(rows)


def _point(text: str, columns: int) -> str:
    return textwrap.fill(text, columns, initial_indent="  ", subsequent_indent="    ")


def _latex(one: thesis.Equation) -> str:
    row = r" \\" + "\n  "
    body = row.join(one.lines())
    inside = body if len(one.right) == 1 else f"\\begin{{gathered}}\n  {body}\n\\end{{gathered}}"
    return (
        f"\\begin{{equation}} % {one.meaning}\n  {inside} \\tag{{{one.number}}}\n\\end{{equation}}"
    )
