"""A page of derived equations as text for a terminal."""

import re
import textwrap
import unicodedata

from rockeom.symbolic.write.page import Block, Display, Heading, Table, broken, greek_letter

_COMBINING = {"dot": "\u0307", "ddot": "\u0308"}
_RAISED = str.maketrans("0123456789+-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻")
_FUNCTIONS = ("sin", "cos", "tan", "arctan", "min", "max", "sgn")
_SILENT = ("left", "right", "bigl", "bigr", "displaystyle")
_SIGNS = {
    "pm": "±", "mp": "∓", "infty": "∞", "partial": "∂", "int": "∫", "cdot": "·", "to": "→",
    "leq": "≤", "geq": "≥", "neq": "≠", "ln": "ln ", "exp": "exp", "limits": "", "prime": "′",
}  # fmt: skip
_TOKEN = re.compile(r"\\[a-zA-Z]+|\\.|[{}^_]|\s+|.")


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
            case Display(lines):
                parts.append("\n".join(_equation(line, width) for line in lines))
            case str(text):
                parts.append(textwrap.fill(_prose(text), width))
    return "\n\n".join(parts) + "\n"


def mathematics(tex: str) -> str:
    """The mathematics of a page, LaTeX of few commands, in one line of plain text."""
    text = " ".join(_Reader(tex).until_end().split())
    return unicodedata.normalize("NFC", text)  # ü in one letter where there is one


def _prose(text: str, quote: str = "'") -> str:
    """Text with its mathematics between dollar signs and its code between backquotes."""
    return re.sub(r"\$([^$]*)\$", lambda m: mathematics(m[1]), text).replace("`", quote)


def _equation(tex: str, width: int) -> str:
    """Lines that fit: the widths by which `broken` goes are estimates for another typeface."""
    for limit in range(width, 20, -4):
        first, *rest = (mathematics(line) for line in broken(tex, limit))
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


class _Reader:
    """Reads LaTeX from left to right."""

    def __init__(self, tex: str) -> None:
        self.tokens = _TOKEN.findall(tex)[::-1]

    def until_end(self) -> str:
        text = ""
        while self.tokens and self.tokens[-1] != "}":
            text += self.item()
        return text

    def group(self) -> str:
        """The next group in braces, or the next item if there are none."""
        while self.tokens and self.tokens[-1].isspace():
            self.tokens.pop()
        if not self.tokens or self.tokens[-1] != "{":
            return self.item() if self.tokens else ""
        self.tokens.pop()
        text = self.until_end()
        self.tokens.pop()
        return text

    def item(self) -> str:
        token = self.tokens.pop()
        if token == "{":
            self.tokens.append(token)
            return self.group()
        if token == "_":
            return "_" + self.group()
        if token == "^":
            return _power(self.group())
        if token.startswith("\\"):
            return self.command(token[1:])
        return token

    def command(self, name: str) -> str:
        if name in _COMBINING:
            letters = self.group()
            return letters[:1] + _COMBINING[name] + letters[1:]
        if name in ("frac", "tfrac"):
            above, below = self.group(), self.group()
            return _quotient(above, below)
        if name == "sqrt":
            return f"√({self.group()})"
        if name in ("mathrm", "operatorname", "text", "mathcal"):
            return self.group()
        if name == "begin":
            return self.environment(self.group())
        if name in _SIGNS:
            return _SIGNS[name]
        if name in _FUNCTIONS:
            return self.function(name)
        if name in _SILENT:
            return ""
        if name in ("thinspace", "quad", ",", ";", " "):
            return " "
        return greek_letter(name)

    def environment(self, name: str) -> str:
        """Cases and columns in one line: { a if x; b if y }, (a; b)."""
        end = ["\\end", "{", *name, "}"]
        inside: list[str] = []
        while self.tokens and self.tokens[-len(end) :][::-1] != end:
            inside.append(self.tokens.pop())
        del self.tokens[-len(end) :]
        rows = [mathematics(row) for row in "".join(inside).split(r"\\")]
        joined = "; ".join(row.replace("&", " for " if name == "cases" else ", ") for row in rows)
        left, right = "{}" if name == "cases" else "()"
        return f"{left}{' '.join(joined.split())}{right}"

    def function(self, name: str) -> str:
        """sin θ, sin²θ or sin(α - s θ)."""
        power = ""
        if self.tokens and self.tokens[-1] == "^":
            self.tokens.pop()
            power = _power(self.group())
        if self.tokens and self.tokens[-1] == r"\left":
            self.tokens.pop()
        bracket = self.tokens and self.tokens[-1] in "(["
        return f"{name}{power}{'' if bracket else ' '}"


def _power(exponent: str) -> str:
    plain = all(ord(c) in _RAISED for c in exponent)
    return exponent.translate(_RAISED) if plain else f"^({exponent})"


def _quotient(above: str, below: str) -> str:
    if (above, below) == ("1", "2"):
        return "½"
    numerator = f"({above})" if re.search(r" [-+] ", _outside_brackets(above)) else above
    denominator = f"({below})" if " " in _outside_brackets(below) else below
    return f"{numerator}/{denominator}"


def _outside_brackets(text: str) -> str:
    text, found = text.strip(), 1
    while found:
        text, found = re.subn(r"[(\[][^()\[\]]*[)\]]", "()", text.replace("()", "."))
    return text
