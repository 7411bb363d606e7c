"""Pages of text, tables and displayed equations, in LaTeX, in Markdown and for a terminal.

Text holds mathematics between dollar signs and code between backquotes.
"""

from __future__ import annotations

import html
import re
import textwrap
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count, groupby, takewhile
from typing import NamedTuple

from rockeom.symbolic.text.plain import greek_letter, mathematics

LINE = 70.0
"""Width of a line of mathematics on the page, in letters."""

BY_PART = 54.0
"""Width of a line that its name follows."""


@dataclass(frozen=True)
class Heading:
    level: int
    text: str


@dataclass(frozen=True)
class Table:
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class Part(NamedTuple):
    """Terms of an equation, with the sign before them, and what they are in words."""

    tex: str
    what: str


@dataclass(frozen=True)
class Display:
    """Displayed equations, one a line.

    parts : of lines, by which those are broken that do not fit the page. sources : of lines, where
    others have that equation.
    """

    lines: tuple[str, ...]
    parts: Mapping[str, tuple[Part, ...]] = field(default_factory=dict)
    sources: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of_parts(cls, equations: Iterable[Iterable[Part]]) -> Display:
        """Equations in parts."""
        parts = [tuple(equation) for equation in equations]
        lines = tuple(" ".join(part.tex for part in of_one) for of_one in parts)
        return cls(lines, dict(zip(lines, parts, strict=True)))


Block = Heading | Table | Display | str


# --- width


def _group(tex: str, start: int) -> int:
    """Index behind the braces that open at `start`."""
    depth = 0
    for i in range(start, len(tex)):
        depth += (tex[i] == "{") - (tex[i] == "}")
        if depth == 0:
            return i + 1
    raise ValueError(f"unbalanced braces in {tex!r}")


def width(tex: str) -> float:
    """Estimated width of mathematics, in letters."""
    while r"\frac" in tex:
        start = tex.index(r"\frac")
        middle = _group(tex, start + 5)
        end = _group(tex, middle)
        wider = max(tex[start + 6 : middle - 1], tex[middle + 1 : end - 1], key=width)
        tex = f"{tex[:start]}x{wider}{tex[end:]}"
    tex = re.sub(r"\\(d?dot|left|right|bigl|bigr|thinspace|tfrac|mathrm)(?![a-z])", "", tex)
    tex = re.sub(r"\\(sin|cos|tan|min|arctan)", r"\1,", tex)
    tex = re.sub(r"\\[a-z]+ ?", "x", tex)
    tex = re.sub(r"\^\{?[-+]\}?", "x", tex)
    small = sum(len(i.strip("{}")) for i in re.findall(r"[_^](\{[^{}]*\}|\w)", tex))
    wide = len(re.findall(r"[A-Zm]", tex)) + 3 * len(re.findall(r" [-+=] ", tex))
    return len(re.sub(r"[{}_^\s]", "", tex)) - 0.25 * small + 0.4 * wide


_MARKS = re.compile(r"\\left|\\right|\\begin|\\end|[\[({\])}]| [-+=/] ")


def _cuts(tex: str) -> Iterator[tuple[int, int]]:
    """(depth of brackets, index) of each sign before which a line may be broken."""
    depth = closed = 0
    for mark in _MARKS.finditer(tex):
        if mark[0] in ("{", r"\left", r"\begin"):
            closed += 1
        elif mark[0] in ("}", r"\right", r"\end"):
            closed -= 1
        elif mark[0] in "[(":
            depth += 1
        elif mark[0] in ")]":
            depth -= 1
        elif not closed:
            yield (-1 if "=" in mark[0] else depth), mark.start()


def broken(tex: str, limit: float) -> list[str]:
    """`tex` in lines of at most that width, broken before signs, outside brackets if possible."""
    lines = []
    while width(tex) > limit:
        sized = ((width(tex[:i]), d, -i) for d, i in _cuts(tex))
        fitting = takewhile(lambda cut: cut[0] <= limit, sized)
        cuts = [(d, i) for size, d, i in fitting if 0.4 * limit < size]
        if not cuts:
            break
        cut = -min(cuts)[1]
        lines.append(tex[:cut])
        tex = tex[cut + 1 :]
    return [*lines, tex]


# --- the three kinds of page


def _layout(lines: Sequence[str]) -> list[list[str]]:
    """Each equation in rows: aligned at = if all then fit the page, else broken before signs."""
    if all(" = " in line for line in lines):
        pairs = [line.split(" = ", 1) for line in lines]
        if max(width(a) for a, _ in pairs) + max(width(b) for _, b in pairs) + 3 < LINE:
            return [[f"{a} &= {b}"] for a, b in pairs]
    found: list[list[str]] = []
    for line in lines:
        sides = line.split(" = ", 1)
        if width(line) > LINE and width(sides[0]) > 0.4 * LINE:
            found.append(_rows([*broken(sides[0], LINE), *broken(f"= {sides[1]}", LINE)]))
        else:
            found.append(_rows(broken(line, LINE)))
    return found


def _rows(pieces: list[str]) -> list[str]:
    """Rows of an equation; a sign that opens one is no binary operator."""
    first, *more = pieces
    return [f"& {re.sub('^-', '{-}', first)}", *(rf"& \quad {piece}" for piece in more)]


def _by_part(parts: Iterable[Part]) -> list[str]:
    """Rows of an equation in its parts, with the name of each after its last row."""
    pieces = []
    for part in parts:
        *more, last = broken(part.tex, BY_PART)
        name = rf" && \scriptstyle\text{{{part.what}}}" if part.what else ""
        pieces += [*more, last + name]
    return _rows(pieces)


def _numbered(display: Display, tag: Callable[[str], str]) -> Iterator[str]:
    """Equations with a number each, those in parts apart from others, which may be wider.

    tag : what stands behind an equation, by its source.
    """
    for apart, group in groupby(
        display.lines, lambda line: width(line) > LINE and line in display.parts
    ):
        lines = list(group)
        shown = [_by_part(display.parts[x]) for x in lines] if apart else _layout(lines)
        equations = [
            " \\notag\\\\\n".join(rows) + tag(display.sources.get(line, ""))
            for line, rows in zip(lines, shown, strict=True)
        ]
        yield environment("align", equations)


def _markdown_text(text: str) -> str:
    """Text without HTML; in $mathematics$ no sign can open a tag either."""
    parts = re.split(r"(\$[^$]*\$)", text)
    return "".join(
        part.replace("<", r"\lt ") if i % 2 else html.escape(part, quote=False)
        for i, part in enumerate(parts)
    )


def to_markdown(blocks: list[Block], numbered: bool = False) -> str:
    """A page; the texts of a declaration are data and hold no HTML."""
    parts, numbers = [], count(1)

    def tag(source: str) -> str:
        return rf" \tag{{{next(numbers)}{source and ', '}{source}}}"

    for block in blocks:
        match block:
            case Heading(level, text):
                parts.append(f"{'#' * level} {_markdown_text(text)}")
            case Table(header, rows):
                table = [" | ".join(cells) for cells in (header, ("---",) * len(header))]
                table += [
                    " | ".join(_markdown_text(c).replace("|", r"\|") for c in cells)
                    for cells in rows
                ]
                parts.append("\n".join(f"| {line} |" for line in table))
            case Display() if numbered:
                shown = (text.replace("<", r"\lt ") for text in _numbered(block, tag))
                parts += [f"$$\n{text}\n$$" for text in shown]
            case Display(lines):
                broken_lines = [x.replace("<", r"\lt ") for each in _layout(lines) for x in each]
                parts.append(f"$$\n{environment('aligned', broken_lines)}\n$$")
            case str(text):
                parts.append(_markdown_text(text))
    return "\n\n".join(parts) + "\n"


def to_latex(blocks: list[Block]) -> str:
    """A complete article."""
    parts = []
    for block in blocks:
        match block:
            case Heading(1, text):
                parts.append(rf"\title{{{_latex_text(text)}}}\author{{}}\date{{}}\maketitle")
            case Heading(level, text):
                # names in code do not break: lines of a heading end where one of them does not fit
                parts.append(rf"\{'sub' * (level - 2)}section*{{\raggedright {_latex_text(text)}}}")
            case Table(header, rows):
                cells = [" & ".join(map(_latex_text, row)) + r" \\" for row in (header, *rows)]
                cells[0] += r" \hline"
                columns = f"@{{}}{'l' * (len(header) - 1)}p{{0.5\\textwidth}}@{{}}"
                table = [rf"\begin{{tabular}}{{{columns}}} \hline", *cells, r"\hline\end{tabular}"]
                parts.append("\n".join(table))
            case Display():
                parts += _numbered(block, _latex_tag)
            case str(text):
                parts.append(_latex_text(text))
    # an empty line before a display would open a paragraph of its own
    body = "\n\n".join(parts).replace("\n\n\\begin{align}", "\n\\begin{align}")
    return "\n".join([*_PREAMBLE, *_greek(body), r"\begin{document}", body, r"\end{document}", ""])


def _latex_tag(source: str) -> str:
    """The number, which LaTeX counts, and the source after it."""
    return rf" \stepcounter{{equation}}\tag{{\theequation, {source}}}" if source else ""


_PREAMBLE = (
    r"\documentclass[11pt,a4paper]{article}",
    r"\usepackage[margin=25mm]{geometry}",
    r"\usepackage{amsmath}",
    r"\emergencystretch=6em",  # for lists of names, which no hyphen breaks
    r"\setlength{\parindent}{0pt}\setlength{\parskip}{6pt}\allowdisplaybreaks",
)
_ESCAPED = {c: rf"\{c}" for c in "{}#$%&_"} | {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "²": r"\textsuperscript{2}",
    "³": r"\textsuperscript{3}",
}


def _latex_text(text: str) -> str:
    """Plain text escaped; $mathematics$ and `code` kept as such."""
    parts = []
    for part in re.split(r"(\$[^$]*\$|`[^`]*`)", text):
        if part.startswith("$") and part.endswith("$") and len(part) > 1:
            parts.append(part)
        else:
            escaped = "".join(_ESCAPED.get(c, c) for c in part.strip("`"))
            parts.append(rf"\texttt{{{escaped}}}" if part.startswith("`") else escaped)
    return "".join(parts)


def _greek(text: str) -> list[str]:
    """Declarations of the Greek letters in names and meanings, which LaTeX does not know."""
    found = []
    for name in _GREEK.split():
        if (char := greek_letter(name)) in text:
            code = f"{ord(char):04X}"
            found.append(rf"\DeclareUnicodeCharacter{{{code}}}{{\ensuremath{{\{name}}}}}")
    return found


_GREEK = """alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma
tau upsilon phi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega"""


def environment(name: str, lines: list[str]) -> str:
    return "\n".join([rf"\begin{{{name}}}", " \\\\\n".join(lines), rf"\end{{{name}}}"])


def to_text(blocks: list[Block], width: int) -> str:
    """Headings underlined, tables in columns, one equation a paragraph; lines up to `width`."""
    parts = []
    for block in blocks:
        match block:
            case Heading(level, text):
                shown = _prose(text, quote="")
                parts.append(f"{shown}\n{'=-.'[min(level, 3) - 1] * len(shown)}")
            case Table(_, rows):
                parts.append(_table(rows, width))
            case Display(lines, _, sources):
                equations = [_equation(x, width, sources.get(x, "")) for x in lines]
                parts.append("\n".join(equations))
            case str(text):
                parts.append(textwrap.fill(_prose(text), width))
    return "\n\n".join(parts) + "\n"


def _prose(text: str, quote: str = "'") -> str:
    """Text with its mathematics between dollar signs and its code between backquotes."""
    return re.sub(r"\$([^$]*)\$", lambda m: mathematics(m[1]), text).replace("`", quote)


def _equation(tex: str, width: int, source: str) -> str:
    """Lines that fit: the widths by which `broken` goes are estimates for another typeface."""
    for limit in range(width, 20, -4):
        first, *rest = (mathematics(line) for line in broken(tex, limit))
        rest += [f"({source})"] if source else []
        lines = [f"  {first}", *(f"      {line}" for line in rest)]
        if max(map(_letters, lines)) <= width:
            break
    return "\n".join(lines)


def _table(rows: tuple[tuple[str, ...], ...], width: int) -> str:
    """The last column takes what the others leave."""
    cells = [tuple(_prose(cell, quote="") for cell in row) for row in rows]
    widths = [max(map(_letters, column)) for column in zip(*cells, strict=True)][:-1]
    lines = []
    for *short, last in cells:
        start = "  " + "".join(
            c + " " * (w + 2 - _letters(c)) for c, w in zip(short, widths, strict=True)
        )
        room = max(width - _letters(start), 20)
        first, *rest = textwrap.wrap(last, room) or [""]
        lines += [(start + first).rstrip(), *(" " * _letters(start) + line for line in rest)]
    return "\n".join(lines)


def _letters(text: str) -> int:
    """Columns on a terminal: a dot above a letter takes none."""
    return sum(not unicodedata.combining(c) for c in text)
