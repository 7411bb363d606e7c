"""What the build writes into the pages: equations of the thesis, its tables, help texts, lists.

A line ``<!-- equations 2 -->`` in a page is replaced by the entries of chapter 2, and so on; see
`fill`. Whatever is said of an equation was decided while the page was made, by its checks.
"""

import contextlib
import io
import re
from collections.abc import Callable, Iterable
from functools import cache
from importlib import import_module
from pathlib import Path

import notebooks
import sympy as sp
from matplotlib.figure import Figure

from rockeom import thesis
from rockeom.analysis.groups import defined
from rockeom.drawing.style import save_figure
from rockeom.thesis.figures import FIGURES, NOT_DRAWN
from rockeom.thesis.side_by_side import TextTable, side_by_side
from rockeom.thesis.statements import STATEMENTS, Judgement, counts
from rockeom.thesis.tables import TABLES
from rockeom.thesis.typeset import written

PLACE = re.compile(r"^<!-- (\w+)(?: ((?:thesis )?[\w.]+))? -->$", re.MULTILINE)
PAGES = {c: f"chapter-{c}" for c in "2345"} | {c: f"appendix-{c.lower()}" for c in "BD"}
SYMBOLS = {s.symbol.name for s in thesis.NOTATION if isinstance(s.symbol, sp.Symbol)}
PICTURES = Path(__file__).parent / "_build" / "figures"
LONGEST_REST = 300  # characters of LaTeX; a longer remainder tells a reader nothing


def writers() -> dict[str, Callable[..., str]]:
    """What is written in the places of pages, by the word that a place names."""
    import derived  # which are written with what is here
    import gallery

    return {
        "overview": overview,
        "structures": gallery.reference,
        "analysis": analysis,
        "equations": equations,
        "symbols": symbols,
        "tables": tables,
        "figures": figures,
        "statements": statements,
        "help": help_text,
        "gallery": gallery.gallery,
        "notebooks": notebooks.cards,
        "derived": derived.cards,
    }


def fill(app, docname: str, source: list[str]) -> None:
    """Replace the places in the text of a page (Sphinx's event ``source-read``)."""
    known = writers()

    def text(found: re.Match) -> str:
        word, argument = found.groups()
        return known[word](*([argument] if argument else []))

    source[0] = PLACE.sub(text, source[0])


# --- the equations


@cache
def report() -> thesis.Report:
    return thesis.verify()


def overview() -> str:
    """How many equations have each verdict, what is wrong as printed, and all of them."""
    decisions = report().decisions
    counted = [[badge(verdict), str(n)] for verdict, n in report().counts.items()]
    wrong = [
        f"- [{d.equation.number}]({_page(d.equation)}#{_anchor(d.equation)}), "
        f"{plain(d.equation.meaning)}. {plain(d.equation.reason)}"
        for d in decisions
        if d.verdict is thesis.Verdict.ERRATUM
    ]
    every = [
        [
            f"[{d.equation.number}]({_page(d.equation)}#{_anchor(d.equation)})",
            plain(d.equation.meaning),
            d.equation.kind.value,
            badge(d.verdict),
        ]
        for d in decisions
    ]
    return "\n\n".join(
        [
            table(["verdict", "equations"], counted),
            "## Wrong as printed",
            "\n".join(wrong),
            "## All equations",
            table(["", "meaning", "kind", "verdict"], every),
        ]
    )


def equations(chapter: str) -> str:
    """The entries of a chapter, under the sections of the thesis."""
    parts = []
    section = None
    for decision in report().decisions:
        if decision.equation.chapter != chapter:
            continue
        if decision.equation.section != section:
            section = decision.equation.section
            parts.append(f"## {f'Section {section}' if section[0].isdigit() else section}")
        parts.append(entry(decision))
    return "\n\n".join(parts)


def entry(decision: thesis.Decision) -> str:
    """One equation: its forms, its verdict, and what led to it."""
    one = decision.equation
    parts = [
        f"({_anchor(one)})=\n### {one.number}",
        f"{badge(decision.verdict)} {plain(_sentence(one.meaning))} "
        f"*{one.kind.value.capitalize()}.*",
    ]
    if one.is_erratum:
        parts += ["As printed:", displayed(one.lines("printed")), "As it should be:"]
    parts.append(displayed(one.lines()))
    if one.excess:
        parts += ["Printed minus right:", displayed(one.excess_lines)]
    if one.domain:
        parts.append(f"The printed form is right where {plain(one.domain.words)}.")
    texts = one.reason, one.assumption, one.fitted, one.remark
    parts += [plain(_sentence(text)) for text in texts if text]
    if one.undetermined:
        parts.append(f"Left open by the text: {plain(_sentence(one.undetermined))}")
    parts += [f"- {_route(check)}" for check in decision.checks]
    if one.is_erratum:
        parts += [_failure(finding) for finding in decision.against if not finding.holds]
    if decision.why:
        parts.append(f"**{plain(_sentence(decision.why))}**")
    return "\n\n".join(parts)


def _route(check: thesis.Check) -> str:
    text = f"{check.means.value.capitalize()}: {plain(_sentence(check.route))}"
    return f"{text} Error: {plain(_sentence(check.error))}" if check.error else text


def _failure(finding: thesis.Finding) -> str:
    """What is left of the printed form of an erratum where it should vanish."""
    rest = finding.rest
    if isinstance(rest, float | sp.Number):
        left = f"{float(rest):.3g}"
    elif isinstance(rest, sp.Basic | sp.MatrixBase):
        left = f"${written(rest)}$"
    else:
        left = plain(rest) if isinstance(rest, str) else ""
    text = f"- Fails as printed: {plain(finding.what)}"
    return f"{text}, leaves {left}" if 0 < len(left) <= LONGEST_REST else text


def symbols(chapter: str) -> str:
    """The symbols of a chapter's equations, with units and meanings."""
    used = {s for e in thesis.EQUATIONS.values() if e.chapter == chapter for s in e.symbols}
    rows = [
        [f"${sp.latex(s)}$", plain(entry.unit), plain(entry.meaning)]
        for s in sorted(used, key=lambda s: s.name.lstrip("\\").lower())
        for entry in [thesis.entry(s, chapter)]
    ]
    return table(["symbol", "unit", "meaning"], rows)


def displayed(lines: Iterable[str]) -> str:
    """Lines of LaTeX as one display, aligned to the left."""
    return "$$\\begin{aligned} " + r" \\ ".join(f"& {x}" for x in lines) + " \\end{aligned}$$"


def badge(verdict: thesis.Verdict) -> str:
    return f"[{verdict.value}]{{.verdict .{verdict.name.lower()}}}"


def _page(one: thesis.Equation) -> str:
    return f"{PAGES[one.chapter]}.md"


def _anchor(one: thesis.Equation) -> str:
    return f"equation-{one.number.lower()}"


# --- the tables


def tables() -> str:
    """Each printed table, its computed columns beside the printed ones."""
    return "\n\n".join(shown(one) for number in TABLES for one in side_by_side(number))


def shown(one: TextTable) -> str:
    return "\n\n".join(
        [
            f"## {plain(one.heading)}",
            plain(_sentence(one.title)),
            table([plain(c) for c in one.columns], [[plain(c) for c in row] for row in one.rows]),
            *(f"- {plain(remark)}" for remark in one.remarks),
        ]
    )


# --- the figures, and what the thesis says of them


@cache
def drawn(number: str) -> Figure:
    """A figure, drawn once for all pages."""
    return FIGURES[number]()


def figures() -> str:
    """Each figure with its conventions, and those that cannot be drawn."""
    parts = []
    PICTURES.mkdir(parents=True, exist_ok=True)
    for number, one in FIGURES.items():
        save_figure(drawn(number), PICTURES / f"{number}.png", dpi=110)
        head, _, rest = one.text.partition("\n")
        parts += [
            f"(figure-{number.lower()})=\n## Figure {number}",
            f"**{plain(_sentence(head))}** *Drawn from: {one.source.value}.*",
            f"![Figure {number}: {plain(one.title)}](_build/figures/{number}.png)",
            *(plain(" ".join(p.split())) for p in rest.split("\n\n") if p.strip()),
        ]
        if of_it := [one for one in judgements() if one.statement.figure == number]:
            parts.append(_judged(of_it))
    if NOT_DRAWN:
        rows = [[plain(cell) for cell in row] for row in NOT_DRAWN.items()]
        parts += ["## Not drawn", table(["figure", "why"], rows)]
    return "\n\n".join(parts)


@cache
def judgements() -> tuple[Judgement, ...]:
    """Every statement of the thesis judged, once for all pages."""
    return tuple(one.judged() for one in STATEMENTS)


def statements() -> str:
    """The statements with a number by chapter, and how many have each verdict."""
    kinds = {
        "statements": [one for one in judgements() if not one.statement.correction],
        "errors of the text": [one for one in judgements() if one.statement.correction],
    }
    rows = [
        [kind, *(str(n) for n in counts(of_kind).values()), str(len(of_kind))]
        for kind, of_kind in kinds.items()
    ]
    parts = [table(["", *(verdict.value for verdict in counts(())), "all"], rows)]
    for kind, of_kind in kinds.items():
        parts += [f"## {kind.capitalize()}", _judged(of_kind, sources=True)]
    return "\n\n".join(parts)


def _judged(judged: Iterable[Judgement], sources: bool = False) -> str:
    """A table of judgements; with `sources`, of the evidence, the figure and the function too."""
    head = ["where", "printed", "allows", "found", "verdict", *["compared with"] * sources]
    rows = []
    for one in judged:
        of = one.statement
        where = plain(of.place)
        if sources and of.figure:
            where += f" ([Figure {of.figure}](figures.md#figure-{of.figure.lower()}))"
        cells = (of.words, str(of.limits), one.words, one.conclusion, *[one.source] * sources)
        rows.append([where, *map(plain, cells)])
    return table(head, rows)


# --- the reference of formulas and procedures


def analysis(module: str) -> str:
    """What a module of `rockeom.analysis` is for, its functions, and the classes that they use."""
    of = import_module(f"rockeom.analysis.{module}")
    group = module.partition(".")[0]
    names = sorted(defined(of), key=lambda name: isinstance(getattr(of, name), type))
    lines = [
        f".. auto{'class' if isinstance(getattr(of, name), type) else 'function'}:: "
        f"rockeom.analysis.{group}.{name}"
        for name in names
    ]
    purpose = plain((of.__doc__ or "").partition("\n\n")[0].replace("\n", " "))
    return "\n".join([purpose, "", "```{eval-rst}", *lines, "```"])


# --- the command line


def help_text(command: str | None = None) -> str:
    """What ``rockeom [COMMAND] --help`` prints."""
    from rockeom.cli import main

    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.suppress(SystemExit):
        main([*(command or "").split(), "--help"])
    return f"```text\n{printed.getvalue().rstrip()}\n```"


# --- Markdown


def table(head: list[str], rows: Iterable[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def plain(text: str) -> str:
    """Text in which nothing but backticks is markup."""
    pieces = re.split(r"(`[^`]*`)", text)
    pieces[::2] = [re.sub(r"([\\*_|<>$\[\]#])", r"\\\1", piece) for piece in pieces[::2]]
    return "".join(pieces)


def _sentence(text: str) -> str:
    """With a capital letter and a full stop; a symbol at the start stays small."""
    first = text.split(" ", 1)[0]
    if first.isalpha() and first not in SYMBOLS:
        text = text[0].upper() + text[1:]
    return text if text.endswith((".", "?", "!")) else f"{text}."
