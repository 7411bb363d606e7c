"""How an engineer writes an expression: order of factors and terms, common factors, line breaks.

Factors: sign s, masses, inertia, gravity or ground acceleration, stiffnesses, lengths,
coordinates, radii, brackets, sines and cosines, velocities, accelerations. Terms: by
accelerations, velocities, ground acceleration and gravity; within each, mass by mass.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.latex import LatexPrinter

from rockeom.symbolic.algebra import SIDE, square_is, tidy
from rockeom.symbolic.fractions import expanded, over_one_denominator
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.impulse import AFTER, BEFORE, at_impact
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import GROUND_ACCELERATIONS
from rockeom.symbolic.text.page import LINE, Part, width
from rockeom.symbolic.write.polar import compound_angles

GROUND = {a: rf"\ddot {axis}_g" for a, axis in zip(GROUND_ACCELERATIONS, "xyz", strict=True)}
MASS, INERTIA, FIELD, STRENGTH, LENGTH, POSITION, RADIUS, BRACKET, ANGLE, DOTTED = range(1, 11)


class Notation(LatexPrinter):
    """LaTeX of expressions of one mode; a `model` adds its units and all its coordinates."""

    def __init__(self, mode: Mode, model: HybridModel | None = None) -> None:
        super().__init__()
        self._collected: dict[sp.Expr, list[sp.Expr]] = {}  # counted first, and then written
        coordinates = model.coordinates if model else mode.coordinates
        unit = {p.symbol: p.unit for p in model.parameters} if model else {}
        self.coordinates = coordinates
        self.positions = [c.position for c in coordinates]
        self.moving = set(self.positions)
        heavy = [x for x in unit if unit[x] in ("kg", "kg m2")]
        for body in mode.bodies:
            heavy += _symbols([body.mass]) + [e for e in sp.Matrix([[body.inertia]]) if e.is_Symbol]
        heavy = list(dict.fromkeys(heavy))
        masses = set(_symbols(b.mass for b in mode.bodies))
        self.masses = [x for x in heavy if x in masses or unit.get(x) == "kg"]
        self.dotted = [c.acceleration for c in coordinates]
        for c in coordinates:
            self.dotted += [c.velocity, at_impact(c, AFTER), at_impact(c, BEFORE)]
        field = [*GROUND_ACCELERATIONS, *_symbols([mode.gravity])]
        self.leaders = [*self.dotted, *field]
        self.heavy = {x: i for i, x in enumerate(heavy)}
        places = [b.position for b in mode.bodies] + [f.position for f in mode.feet.values()]
        levers = [sp.diff(e, q) for place in places for e in place for q in self.positions]
        radii = {body.polar[2] for body in mode.bodies if body.polar}
        groups = [
            (DOTTED, self.dotted),
            (POSITION, self.positions),
            (MASS, self.masses),
            (FIELD, field),
            (INERTIA, heavy),
            (RADIUS, sorted(radii, key=str)),
            (LENGTH, [*_symbols(levers), *(x for x in unit if unit[x] == "m")]),
        ]
        self.rank = {SIDE: (0, 0)}
        for group, symbols in groups:
            for i, x in enumerate(symbols):
                self.rank.setdefault(x, (group, i))

    # --- order

    def factor_key(self, factor: sp.Expr):
        base = factor.base if factor.is_Pow else factor
        if base.is_Symbol:
            rank = self._rank(base)
        elif base.is_number:
            rank = (0, 0)
        elif base.is_Function:
            rank = (ANGLE, 0)
        elif base.has(sp.Function) or not (self._weighed(base) or self._constant(base)):
            rank = (BRACKET, 0)
        else:  # such a sum stands where its first symbol would
            rank = min(self._rank(x) for x in base.free_symbols - {SIDE})
        return *rank, sp.default_sort_key(factor)

    def _constant(self, expr: sp.Expr) -> bool:
        return not expr.free_symbols & self.moving

    def _weighed(self, expr: sp.Expr) -> bool:
        return all(set(self.masses) & t.free_symbols for t in sp.Add.make_args(expr))

    def _rank(self, symbol: sp.Symbol) -> tuple[int, int]:
        return self.rank.get(symbol, (STRENGTH, 0))

    def term_key(self, term: sp.Expr):
        number, factors = product(term)
        symbols = {f.base if f.is_Pow else f for f in factors}
        dots = [i for i, x in enumerate(self.dotted) if x in symbols]
        mass = min((self.heavy[x] for x in symbols if x in self.heavy), default=len(self.heavy))
        turning = [f for f in term.atoms(sp.Function) if f.free_symbols & self.moving]
        # sin(alpha - s theta), then cos(theta), then sin(theta), then what does not turn
        kinds = {sp.cos: 1, sp.sin: 2}
        kind = min((0 if f.args[0].is_Add else kinds.get(f.func, 3) for f in turning), default=3)
        last = bool(symbols & self.moving) if kind < 3 else bool(number < 0)
        order = (not dots, dots, mass, kind, last, SIDE in symbols, len(factors))
        return *order, sp.default_sort_key(term)

    def sorted_terms(self, expr: sp.Expr) -> list[sp.Expr]:
        return sorted(sp.Add.make_args(expr), key=self.term_key)

    # --- common factors

    def terms(self, expr: sp.Expr) -> list[sp.Expr]:
        """The terms of `expr`, collected as stated above; their sum is `expr`."""
        if expr not in self._collected:
            self._collected[expr] = self._terms(expr)
        return self._collected[expr]

    def _terms(self, expr: sp.Expr) -> list[sp.Expr]:
        expr = square_is(expanded(expr), SIDE, sp.Integer(1))
        expr = _oriented(compound_angles(expr, self.coordinates), self.moving)
        leaders = [x for x in self.leaders if expr.has(x) and expr.is_polynomial(x)]
        if not leaders:
            return self._grouped(expr, sp.Integer(1))
        found = []
        for lead, part in _by_powers(expr, leaders):
            one_bracket = lead.free_symbols & set(self.dotted)
            found += self._joined(part, lead) if one_bracket else self._grouped(part, lead)
        return found

    def _grouped(self, expr: sp.Expr, lead: sp.Expr) -> list[sp.Expr]:
        """Terms with masses, mass by mass unless a sum of masses can be put in brackets."""
        parts = dict.fromkeys((*self.masses, None), sp.Integer(0))
        for term in sp.Add.make_args(expr):
            parts[next((m for m in self.masses if term.has(m)), None)] += term
        light = parts.pop(None)
        heavy = sum(parts.values(), sp.Integer(0))
        _, bracket = self._factored(heavy)
        few = len(sp.Add.make_args(bracket)) <= len(self.masses)
        if few and self._constant(bracket):
            parts = {None: heavy}
        springs = [light]
        if self._factored(light)[0].is_Number and not self._turns(light):
            springs = [light.coeff(q) * q for q in self.positions]
            springs = [*springs, sp.expand(light - sum(springs))]
        return [t for part in (*parts.values(), *springs) if part for t in self._joined(part, lead)]

    def _joined(self, expr: sp.Expr, lead: sp.Expr) -> list[sp.Expr]:
        outer, bracket = self._factored(expr)
        if bracket == 1:
            return [outer * lead]
        if outer * lead in (1, -1):
            return self.sorted_terms(sp.expand(outer * lead * bracket))
        return [sp.Mul(outer * lead, bracket, evaluate=False)]

    def _factored(self, expr: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
        """(common factor, bracket with as few s and minus signs as it can)."""
        if any(p.exp.is_negative and p.base.is_Add for p in expr.atoms(sp.Pow)):
            expr = _together(expr)
        number, factors = product(_gcd_terms(expr))
        bracket = next((f for f in factors if f.is_Add), sp.Integer(1))
        outer = number * sp.Mul(*(f for f in factors if f is not bracket))
        terms = self.sorted_terms(bracket)
        if len(terms) > 2 and self._constant(bracket) and _may_be_power(terms):
            sign, square = sp.factor(bracket).as_coeff_Mul()
            if square.is_Pow:
                return outer * sign * square, sp.Integer(1)
        with_side = sum(SIDE in product(t)[1] for t in terms)
        compound = any(f.args[0].has(SIDE) for f in terms[0].atoms(sp.Function))
        if 2 * with_side + compound > len(terms):
            bracket = square_is(sp.expand(SIDE * bracket), SIDE, sp.Integer(1))
            outer *= SIDE
        terms = self.sorted_terms(bracket)
        negative = [product(term)[0] < 0 for term in terms]
        if self._turns(terms[0]):
            flip = negative[0]
        else:  # a plain sum may begin with any term: no minus before it if one is positive
            flip = any(negative) if product(outer)[0] < 0 else all(negative)
        return (-outer, -bracket) if flip else (outer, bracket)

    def _turns(self, expr: sp.Expr) -> bool:
        return any(f.free_symbols & self.moving for f in expr.atoms(sp.Function))

    # --- LaTeX

    def write(self, expr: sp.Expr) -> str:
        """A sum, collected."""
        return self.sum([self._print(t) for t in self.terms(expr)])

    def plain(self, expr: sp.Expr) -> str:
        """An expression as it stands."""
        return self._print(expr)

    def quotient(self, expr: sp.Expr) -> str:
        """A rational expression, numerator and denominator collected."""
        expr = expr.replace(sp.tan, lambda a: sp.sin(a) / sp.cos(a))
        above, below = map(tidy, sp.fraction(over_one_denominator(expr)))
        if product(self.terms(below)[0])[0] < 0:
            above, below = -above, -below
        terms = self.terms(above)
        if below == 1:
            return self._positive_first(terms)
        sign = "-" if all(product(t)[0] < 0 for t in terms) else ""
        terms = self.terms(-above) if sign else terms
        top, bottom = self._positive_first(terms), self.write(below)
        if max(width(top), width(bottom)) > LINE - 8:  # a line that can be broken
            return f"{sign}{bracketed(top)} / {bracketed(bottom)}"
        return rf"{sign}\frac{{{top}}}{{{bottom}}}"

    @staticmethod
    def sum(terms: list[str]) -> str:
        """Terms joined by their signs; 0 if there are none."""
        text = terms[0] if terms else "0"
        for term in terms[1:]:
            text += f" {_signed(term)}"
        return text

    def equation(
        self,
        row: Mapping[sp.Symbol, sp.Expr],
        resisting: Mapping[str, sp.Expr],
        acting: Mapping[str, sp.Expr],
        pushes: Iterable[str] = (),
    ) -> list[Part]:
        """An equation of motion in its physical parts, those that are zero left out.

        row : of the mass matrix, by accelerations. resisting, acting : forces on the left and on
        the right, by what they are. pushes : LaTeX of forces of contact, on the right.
        """
        inertia = self.sum([self.write(m * a) for a, m in row.items() if m != 0])
        left = [(inertia, "inertia"), *((self.write(e), x) for x, e in resisting.items() if e != 0)]
        right = [(self.write(e), x) for x, e in acting.items() if e != 0]
        right += [(self.sum(list(pushes)), "contact forces")] if pushes else []
        left = left[1:] if inertia == "0" and left[1:] else left
        parts = [Part(_signed(tex) if i else tex, what) for i, (tex, what) in enumerate(left)]
        if not right:
            return [*parts[:-1], Part(f"{parts[-1].tex} = 0", parts[-1].what)]
        signed = [Part(_signed(tex) if i else f"= {tex}", x) for i, (tex, x) in enumerate(right)]
        return [*parts, *signed]

    def _print_Add(self, expr: sp.Expr, order=None) -> str:
        return self._positive_first(self.sorted_terms(expr))

    def _positive_first(self, terms: list[sp.Expr]) -> str:
        texts = [self._print(t) for t in terms]
        first = next((i for i, text in enumerate(texts) if text[0] != "-"), 0)
        return self.sum([texts.pop(first), *texts])

    def _print_Rational(self, expr: sp.Rational) -> str:
        return self._print_Mul(expr)

    _print_Half = _print_Rational

    def _print_Mul(self, expr: sp.Expr) -> str:
        number, factors = product(expr)
        below = [1 / f for f in factors if f.is_Pow and f.exp.is_negative]
        above = [f for f in factors if not (f.is_Pow and f.exp.is_negative)]
        sign = "-" if number < 0 else ""
        p, q = abs(number.p), number.q
        if below:
            return rf"{sign}\frac{{{self._alone(p, above)}}}{{{self._alone(q, below)}}}"
        if q != 1:
            row = f" {self._row(1, above)}" if above else ""
            return rf"{sign}\tfrac{{{p}}}{{{q}}}{row}"
        return sign + self._row(p, above)

    def _alone(self, number: int, factors: list[sp.Expr]) -> str:
        """A product above or below a fraction bar, where a lone sum needs no brackets."""
        lone = number == 1 and len(factors) == 1
        return self._print(factors[0]) if lone else self._row(number, factors)

    def _row(self, number: int, factors: list[sp.Expr]) -> str:
        texts = [str(number)] if number != 1 or not factors else []
        for factor in sorted(factors, key=self.factor_key):
            text = self._print(factor)
            if texts and self.factor_key(factor)[0] == DOTTED and texts[-1][-1] not in ")]":
                # keeps what follows out of the argument of a sine
                texts += [r"\thinspace"] if re.match(r"\\(sin|cos|tan)", texts[-1]) else []
            texts.append(bracketed(text) if factor.is_Add else text)
        return " ".join(texts)

    def _print_Pow(self, expr: sp.Expr) -> str:
        if expr.exp.is_negative:
            return self._print_Mul(expr)
        if expr.base.is_Add and expr.exp.is_Integer:
            return f"{bracketed(self._print(expr.base))}^{self._print(expr.exp)}"
        return re.sub(r"\^\{(\w)\}$", r"^\1", super()._print_Pow(expr))

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        name = GROUND.get(expr) or super()._print_Symbol(expr)
        return re.sub(r"_\{(\w)\}", r"_\1", name)

    def _law(self, function: sp.Expr, primes: int = 0) -> str:
        """A function of the coordinate by its name, with a prime for each derivative."""
        return self._print(sp.Symbol(function.func.__name__)) + "'" * primes

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        if isinstance(expr.expr, AppliedUndef):
            return self._law(expr.expr, expr.derivative_count)
        return super()._print_Derivative(expr)

    def _print_Function(self, expr: sp.Function, exp: str | None = None) -> str:
        name = {"atan": r"\arctan"}.get(expr.func.__name__, rf"\{expr.func.__name__}")
        if len(expr.args) > 1 or name[1:] not in ("sin", "cos", "tan", "arctan"):
            if isinstance(expr, AppliedUndef):
                return self._law(expr) + (f"^{exp}" if exp else "")
            return super()._print_Function(expr, exp)
        argument = self._print(expr.args[0])
        if not expr.args[0].is_Symbol:
            argument = bracketed(argument)
        power = f"^{exp}" if exp else ""
        return f"{name}{power} {argument}" if argument[0].isalpha() else f"{name}{power}{argument}"

    def _print_Abs(self, expr: sp.Expr, exp: str | None = None) -> str:
        return f"|{self._print(expr.args[0])}|" + (f"^{exp}" if exp else "")

    def _print_Max(self, expr: sp.Expr, exp: str | None = None) -> str:
        arguments = sorted(expr.args, key=sp.default_sort_key)
        power = f"^{exp}" if exp else ""
        return rf"\max({', '.join(self._print(a) for a in arguments)}){power}"


def _signed(tex: str) -> str:
    """A term behind others."""
    return f"- {tex[1:]}" if tex.startswith("-") else f"+ {tex}"


def _symbols(expressions) -> list[sp.Symbol]:
    """Free symbols in order of appearance, those of one expression by name."""
    found: dict[sp.Symbol, None] = {}
    for expr in expressions:
        free = sp.sympify(expr).free_symbols
        found |= dict.fromkeys(sorted(free, key=sp.default_sort_key))
    return list(found)


_gcd_terms = lru_cache(maxsize=4096)(sp.gcd_terms)  # needed again by each form of a page


def product(expr: sp.Expr) -> tuple[sp.Rational, list[sp.Expr]]:
    """(number, other factors), through products nested to keep a bracket together."""
    number: sp.Rational = sp.Integer(1)
    factors: list[sp.Expr] = []
    for factor in sp.Mul.make_args(expr):
        if factor.is_Rational:
            number *= factor
        elif factor.is_Mul:
            inner, more = product(factor)
            number, factors = number * inner, factors + more
        else:
            factors.append(factor)
    return number, factors


def _may_be_power(terms: Sequence[sp.Expr]) -> bool:
    """Whether a sum of these may be a power of another: it is none where a factor occurs once.

    To factor it tells for certain, and takes long to find that there is nothing.
    """
    highest: dict[sp.Expr, sp.Expr] = {}
    for term in terms:
        for base, n in term.as_powers_dict().items():
            highest[base] = max(n, highest.get(base, n))
    return any(base.is_Add for base in highest) or all(
        n != 1 for base, n in highest.items() if not base.is_number
    )


def _by_powers(expr: sp.Expr, leaders: Sequence[sp.Symbol]) -> list[tuple[sp.Expr, sp.Expr]]:
    """Products of powers of the leaders, the highest first, and what each is multiplied by.

    As `sp.Poly(expr, *leaders).terms()` gives them, which seeks a field for the coefficients first.
    """
    parts: dict[tuple[int, ...], list[sp.Expr]] = {}
    for term in sp.Add.make_args(expr):
        held = term.as_powers_dict()
        powers = tuple(int(held.get(x, 0)) for x in leaders)
        alone = sp.Mul(*(base**n for base, n in held.items() if base not in leaders))
        parts.setdefault(powers, []).append(alone)
    return [
        (
            sp.Mul(*(x**n for x, n in zip(leaders, powers, strict=True))),
            _together(sp.Add(*parts[powers])),
        )
        for powers in sorted(parts, reverse=True)
    ]


def _together(expr: sp.Expr) -> sp.Expr:
    """A sum of quotients over one denominator, and the numerator as a sum again."""
    if not any(p.exp.is_negative for p in expr.atoms(sp.Pow)):
        return expr
    above, below = sp.fraction(over_one_denominator(expr))
    return expanded(above) / below


def _oriented(expr: sp.Expr, moving: set[sp.Symbol]) -> sp.Expr:
    """Write sin(alpha - s theta) where SymPy's own order gives -sin(s theta - alpha)."""
    put = {}
    for f in expr.atoms(sp.sin, sp.cos, sp.tan):
        (angle,) = f.args
        fixed = [t for t in sp.Add.make_args(angle) if not t.free_symbols & moving]
        if angle.is_Add and fixed and all(product(t)[0] < 0 for t in fixed):
            sign = 1 if f.func == sp.cos else -1
            put[f] = sign * sp.Function(f.func.__name__)(-angle)
    return expr.subs(put) if put else expr


def bracketed(text: str) -> str:
    if r"\frac" in text:
        left, right = "[]" if "(" in text else "()"
        return rf"\left{left}{text}\right{right}"
    if "[" in text:
        return rf"\bigl({text}\bigr)"
    return f"[{text}]" if "(" in text else f"({text})"
