"""The thesis's equations in LaTeX, factors and terms in the order in which engineers write them."""

import re
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.latex import LatexPrinter

from rockeom.symbolic.write.notation import (
    ANGLE,
    BRACKET,
    DOTTED,
    FIELD,
    INERTIA,
    LENGTH,
    MASS,
    POSITION,
    RADIUS,
    STRENGTH,
    Notation,
    bracketed,
    product,
)
from rockeom.thesis.notation import NOTATION, PM

_GROUP_OF_UNIT = {
    "kg": MASS, "kg m2": INERTIA, "m/s2": FIELD, "N": STRENGTH, "N/m": STRENGTH, "m": LENGTH,
    "rad": POSITION,
}  # fmt: skip
_WORDS = {"sign": r"\operatorname{sgn}", "log": r"\ln", "exp": r"\exp"}
_KNOWN = ("sin", "cos", "tan", "arctan", "sinh", "cosh", "tanh", "arcsin", "arccos", "exp", "ln")


def written(relation: Any) -> str:
    """LaTeX of a relation or an expression of the thesis, without delimiters."""
    return _Printer().doprint(relation)


class _Printer(Notation):
    """The house's order of factors and terms, for symbols that have units but no model."""

    def __init__(self) -> None:
        LatexPrinter.__init__(self)
        self.unit = {entry.symbol: entry.unit for entry in NOTATION}
        self.moving: set[sp.Symbol] = set()

    def _rank(self, symbol: sp.Symbol) -> tuple[int, int]:
        if symbol == PM:
            return 0, 0
        if re.match(r"\\(d?dot|ddot)\b", symbol.name):
            return (FIELD if "_g" in symbol.name else DOTTED), 2 - symbol.name.startswith(r"\dd")
        group = _GROUP_OF_UNIT.get(self.unit.get(symbol, ""), POSITION)
        return (RADIUS if symbol.name.startswith("R") else group), 0

    def factor_key(self, factor: sp.Expr):
        base = factor.base if factor.is_Pow else factor
        if base.is_Symbol:
            rank = self._rank(base)
        elif base.is_number or isinstance(base, sp.sign):
            rank = (0, 1)
        elif base.is_Function:
            rank = (ANGLE, 0)
        else:
            rank = (BRACKET, 0)
        return *rank, sp.default_sort_key(factor)

    def term_key(self, term: sp.Expr):
        number, factors = product(term)
        symbols = {f.base if f.is_Pow else f for f in factors}
        ranks = [self._rank(x) for x in symbols if x.is_Symbol]
        dotted = sorted(rank[1] for rank in ranks if rank[0] == DOTTED)
        mass = min((str(x) for x in symbols if self.unit.get(x) in ("kg", "kg m2")), default="~")
        compound = any(f.args[0].is_Add for f in term.atoms(sp.Function) if f.args)
        turned = not _is_fixed(term) and mass == "~" and not dotted
        order = (not dotted, dotted, turned, bool(number < 0), mass, not compound, -len(factors))
        return *order, sp.default_sort_key(term)

    # --- signs and angles

    def doprint(self, expr: Any) -> str:
        return self._print(_with_angles(sp.sympify(expr), self))

    def _print_Add(self, expr: sp.Expr, order=None) -> str:
        """A term with the double sign as a plain factor has it between the terms."""
        plain = [t for t in expr.args if PM not in product(t)[1]]
        text = self._positive_first(self.sorted_terms(sp.Add(*plain, evaluate=False)))
        text = "" if not plain else text
        for term in expr.args:
            number, factors = product(term)
            if PM in factors:
                rest = sp.Mul(abs(number), *(f for f in factors if f != PM))
                sign = r"\mp" if number < 0 else r"\pm"
                text = f"{text} {sign} {self._print(rest)}".lstrip()
        return text

    def _print_Mul(self, expr: sp.Expr) -> str:
        number, factors = product(expr)
        if PM in factors:
            rest = sp.Mul(abs(number), *(f for f in factors if f != PM))
            sign = r"\mp" if number < 0 else r"\pm"
            return f"{sign} {self._print(rest)}"
        roots = [f for f in factors if f.is_Pow and abs(f.exp) == sp.Rational(1, 2)]
        if len(roots) > 1:
            return self._under_one_root(number, [f for f in factors if f not in roots], roots)
        if not number.is_finite or any(f.is_Float for f in factors):
            return LatexPrinter._print_Mul(self, expr)
        return super()._print_Mul(expr)

    def _under_one_root(
        self, number: sp.Rational, factors: list[sp.Expr], roots: list[sp.Expr]
    ) -> str:
        inside = sp.Mul(*(f**2 for f in roots))
        if any(f.is_number for f in roots):
            sign = "-" if number < 0 else ""
            inside, number = inside * number**2, sp.Integer(1)
        else:
            sign = ""
        root = rf"\sqrt{{{self._print(inside)}}}"
        outside = self._print(sp.Mul(number, *factors))
        return f"{sign}{root}" if outside == "1" else f"{sign}{outside} {root}"

    # --- what the pages of the engine do not need

    def _print_Relational(self, expr: Any) -> str:
        sign = {"==": "=", "!=": r"\neq", "<=": r"\leq", ">=": r"\geq"}.get(
            expr.rel_op, expr.rel_op
        )
        return f"{self._print(expr.lhs)} {sign} {self._print(expr.rhs)}"

    def _print_Piecewise(self, expr: sp.Piecewise) -> str:
        rows = []
        for value, condition in expr.args:
            words = r"\text{otherwise}" if condition == sp.true else self._print(condition)
            rows.append(rf"{self._print(value)} & {words}")
        return r"\begin{cases} " + r" \\ ".join(rows) + r" \end{cases}"

    def _print_MatrixBase(self, expr: Any) -> str:
        rows = [" & ".join(self._print(e) for e in expr.row(i)) for i in range(expr.rows)]
        return r"\begin{pmatrix} " + r" \\ ".join(rows) + r" \end{pmatrix}"

    def _print_AppliedUndef(self, expr: Any, exp: str | None = None) -> str:
        """A function that the thesis does not state: its name."""
        return self._print(sp.Symbol(expr.func.__name__)) + (f"^{{{exp}}}" if exp else "")

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        """Derivatives by time outside, as in Lagrange's equation; rates with a dot."""
        body, *rest = expr.args
        variables = sorted(rest, key=lambda pair: str(pair[0]) == "t")
        if isinstance(body, AppliedUndef) and len(rest) == 1 and str(rest[0][0]) == "t":
            return rf"\{'d' * int(rest[0][1])}ot{{{self._print(body)}}}"
        text = self._print(body)
        for variable, count in variables:
            d = "d" if str(variable) == "t" or len(body.free_symbols) < 2 else r"\partial"
            d = r"\partial" if isinstance(variable, (AppliedUndef, sp.Derivative)) else d
            power = f"^{count}" if count > 1 else ""
            bottom = f"{d} {self._print(variable)}{power}"
            if text.startswith(r"\frac") or not isinstance(body, AppliedUndef):
                text = (
                    rf"\frac{{{d}{power}}}{{{bottom}}} {bracketed(text) if body.is_Add else text}"
                )
            else:
                text = rf"\frac{{{d}{power} {text}}}{{{bottom}}}"
        return text

    def _print_Function(self, expr: sp.Function, exp: str | None = None) -> str:
        name = expr.func.__name__
        name = {"atan": r"\arctan", "asin": r"\arcsin", "acos": r"\arccos"}.get(name, name)
        name = _WORDS.get(name, name if name.startswith("\\") else rf"\{name}")
        if len(expr.args) != 1 or (name.lstrip("\\") not in _KNOWN and name not in _WORDS.values()):
            return LatexPrinter._print_Function(self, expr, exp)
        (inside,) = expr.args
        argument = self._print(inside)
        if not inside.is_Symbol or name in _WORDS.values():
            argument = bracketed(argument)
        power = f"^{{{exp}}}" if exp else ""
        return f"{name}{power} {argument}"

    _print_log = _print_sign = _print_Function


def _with_angles(expr: Any, printer: _Printer) -> Any:
    """sin(alpha -+ theta) where SymPy's own order gives -sin(+-theta - alpha)."""
    put = {}
    for f in expr.atoms(sp.sin, sp.cos, sp.tan):
        (angle,) = f.args
        signs = [product(t)[0] < 0 for t in sp.Add.make_args(angle) if _is_fixed(t)]
        if angle.is_Add and signs and all(signs):
            name = printer._print(sp.expand(-angle))
            put[f] = (1 if f.func == sp.cos else -1) * f.func(sp.Symbol(f"({name})"))
    return expr.subs(put) if put else expr


def _is_fixed(term: sp.Expr) -> bool:
    """Whether a term of an angle is one of the structure, not the rotation."""
    return not any(x == PM or x.name in ("theta", "x") for x in term.free_symbols)
