r"""LaTeX of derived equations as text for a terminal: θ̈ for \ddot{\theta}."""

import re
import unicodedata

_COMBINING = {"dot": "\u0307", "ddot": "\u0308"}
_RAISED = str.maketrans("0123456789+-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻")
_FUNCTIONS = ("sin", "cos", "tan", "arctan", "min", "max", "sgn")
_SILENT = ("left", "right", "bigl", "bigr", "displaystyle")
_SIGNS = {
    "pm": "±", "mp": "∓", "infty": "∞", "partial": "∂", "int": "∫", "cdot": "·", "to": "→",
    "leq": "≤", "geq": "≥", "neq": "≠", "ln": "ln ", "exp": "exp", "limits": "", "prime": "′",
}  # fmt: skip
_TOKEN = re.compile(r"\\[a-zA-Z]+|\\.|[{}^_]|\s+|.")


def mathematics(tex: str) -> str:
    """The mathematics of a page, LaTeX of few commands, in one line of plain text."""
    text = " ".join(_Reader(tex).until_end().split())
    text = re.sub(rf"\b({'|'.join(_FUNCTIONS)}) \(", r"\1(", text)  # as SymPy brackets arguments
    text = re.sub(r" +\)", ")", text)
    return unicodedata.normalize("NFC", text)  # ü in one letter where there is one


def greek_letter(name: str) -> str:
    """The letter that TeX calls by a name, or the name itself where there is none."""
    case = "SMALL" if name.islower() else "CAPITAL"
    try:
        return unicodedata.lookup(f"GREEK {case} LETTER {name.upper().replace('LAMBDA', 'LAMDA')}")
    except KeyError:
        return name


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
