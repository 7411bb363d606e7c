"""An equation typed by a reader against the derived ones: equal, up to a factor, or where not.

Both are evaluated at random states with many digits. A factor may hold parameters alone: an
equation times cos(theta) has solutions that the derived one lacks.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace

import mpmath  # type: ignore[import-untyped]
import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.numbers.checks import InputError, InputTypeError, near, require_word
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.impulse import AFTER, BEFORE, at_impact
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.model import GROUND_X, GROUND_Y, NamedFunction
from rockeom.symbolic.reading.symbols import Symbols
from rockeom.symbolic.text.page import Display, to_markdown, to_text
from rockeom.symbolic.text.plain import mathematics
from rockeom.symbolic.text.shown import TEXT_WIDTH
from rockeom.symbolic.write.polar import polar_parameters

DIGITS = 40
"""Digits of the evaluation; of two expressions that are the same, more than thirty agree."""
SAME = mpmath.mpf("1e-25")
"""Relative difference of numbers that are the same."""
SAME_AS_TYPED = mpmath.mpf("1e-12")
"""The same where the equation holds decimal fractions, which are rounded."""
SAMPLES = 6
"""Random states, each with parameters of its own."""
RATIO_OF_VELOCITIES, RATIO_OF_ENERGIES = sp.symbols("e r", real=True)

_OF_THE_GROUND = {"x": GROUND_X, "u": GROUND_X, "y": GROUND_Y, "v": GROUND_Y}
"""Letters of the ground's displacement in the literature, and the acceleration."""
_GROUND = {"horizontal excitation": GROUND_X, "vertical excitation": GROUND_Y}


@dataclass(frozen=True, repr=False)
class Comparison:
    """Result of a comparison with derived equations; true where the typed equation holds.

    Parameters
    ----------
    row : str
        Name of the derived equation that is most alike: the coordinate of an equation of motion or
        of a momentum, or "r" or "e" for the ratio of energies or velocities at an impact.
    equal : bool
        Whether it is that equation, or a multiple of it.
    factor : sympy.Expr
        Typed equation over the derived one, left minus right-hand side of both; parameters alone.
    follows : bool
        Whether the equation holds in every motion, such as a combination of several derived ones.
    difference : dict of str to sympy.Expr
        Typed less `factor` times derived, by physical term, where they are not equal.
    """

    row: str
    equal: bool
    factor: sp.Expr
    follows: bool
    difference: Mapping[str, sp.Expr] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return self.follows

    def __repr__(self) -> str:
        return f"<Comparison: {str(self).partition(chr(10))[0]}>"

    def __str__(self) -> str:
        what = f"the derived equation of {self.row}"
        if self.equal and self.factor == 1:
            return f"Equal to {what}."
        if self.equal:
            return f"Equal to {what} times {mathematics(sp.latex(self.factor))}."
        if self.follows:
            return (
                "It holds in every motion, and is no derived equation times a factor of parameters "
                f"alone; the most alike is {what}."
            )
        times = "" if self.factor == 1 else f" times {mathematics(sp.latex(self.factor))}"
        rows = (rf"\text{{{name}}}: {sp.latex(x)}" for name, x in self.difference.items())
        shown = to_text([Display(tuple(rows))], TEXT_WIDTH)
        if {*self.difference} <= {*_GROUND}:
            shown += "Without these terms: ground=() for free motion, ground=('a_x',) for no a_y."
        return f"Unequal to {what}{times}. Typed less derived:\n{shown}".rstrip()

    def _repr_latex_(self) -> str:
        rows = (rf"\text{{{name}: }} {sp.latex(x)} = 0" for name, x in self.difference.items())
        shown = to_markdown([Display(tuple(rows))]) if self.difference else ""
        return f"{str(self).partition(chr(10))[0]}\n\n{shown}".strip()


@dataclass(frozen=True)
class _Derived:
    """Derived equations, row = 0 each, with what a typed one is compared by.

    solution : unknowns of the rows, accelerations or velocities after an impact, by their values.
    pivots : symbols in which all is linear, by whose coefficients a factor shows. side : see
    `_side`. terms : splits an equation into physical terms.
    """

    rows: Mapping[str, sp.Expr]
    solution: Mapping[sp.Symbol, sp.Expr]
    pivots: tuple[sp.Symbol, ...]
    moving: tuple[sp.Symbol, ...]
    rotation: sp.Symbol
    side: int | None
    terms: Callable[[sp.Expr], dict[str, sp.Expr]]


def compared(
    model: HybridModel, equation: sp.Expr | sp.Eq, mode: str, ground: Collection[str],
    values: Mapping[str, sp.Expr | float],
) -> Comparison:  # fmt: skip
    """An equation against the equations of motion of a mode; see `RockingModel.compare`."""
    equations = model.equations(mode).map(lambda e: _written_out(model, e, mode))
    names = [c.name for c in model.mode(mode).coordinates]
    if not names:
        raise InputError("mode", mode, "compare").so("no coordinate moves in it")
    ground = (ground,) if isinstance(ground, str) else ground or ()
    for name in ground:
        require_word("ground", name, ("a_x", "a_y"), "compare")
    absent = {x: 0 for x in (GROUND_X, GROUND_Y) if str(x) not in ground}
    for c in (c for c in model.coordinates if c.name not in names):
        absent |= {c.velocity: 0, c.acceleration: 0}
    solution = zip(equations.accelerations, equations.rhs()[len(names) :], strict=True)
    gravity = sorted(model.mode(mode).gravity.free_symbols, key=str)
    derived = _Derived(
        dict(zip(names, equations.residual.subs(absent), strict=True)),
        {x: e.subs(absent) for x, e in solution},
        (*equations.accelerations, *(x for x in _GROUND.values() if x not in absent), *gravity),
        tuple(x for c in model.coordinates for x in (c.position, c.velocity)),
        model.rotation.position,
        _side(model, mode),
        lambda e: _terms_of_motion(e, equations, gravity),
    )
    typed = _typed(equation, _names(model), model, mode).subs(absent)
    return _judged(*_with_values(derived, typed, model, mode, values))


def compared_at_impact(
    model: HybridModel, equation: sp.Expr | sp.Eq, source: str, target: str,
    values: Mapping[str, sp.Expr | float],
) -> Comparison:  # fmt: skip
    """An equation against an impulse map, and the ratios of the structure held rigid."""
    impulse = model.impulse_map(source, target)
    after = [at_impact(c, AFTER) for c in impulse.coordinates]
    momenta = impulse.mass_matrix * sp.Matrix(after) - impulse.momentum
    ratio = model.velocity_ratio
    ratios: dict[sp.Symbol, sp.Expr] = {}
    if ratio is not None and ratio is not sp.nan:
        ratios = {RATIO_OF_VELOCITIES: ratio, RATIO_OF_ENERGIES: ratio**2}
    names = {str(x): x for x in ratios} | _names(model)
    for c, x in zip(impulse.coordinates, after, strict=True):
        names |= {f"{c.name}_dot_after": x, _plain(str(x)): x}
    for c in model.coordinates:
        names |= {f"{c.name}_dot_before": c.velocity, _plain(str(at_impact(c, BEFORE))): c.velocity}
    unknowns = (*after, *ratios)
    rates = tuple(c.velocity for c in model.coordinates)
    derived = _Derived(
        {c.name: row for c, row in zip(impulse.coordinates, momenta, strict=True)}
        | {str(x): x - value for x, value in ratios.items()},
        dict(zip(after, impulse.velocities(), strict=True)) | ratios,
        unknowns,
        (*(c.position for c in model.coordinates), *rates),
        model.rotation.position,
        _side(model, source),
        lambda e: _linear_terms(e, {str(x): x for x in (*unknowns, *rates)}),
    )
    typed = _typed(equation, names, model, source).subs(model.rotation.position, 0)
    return _judged(*_with_values(derived, typed, model, source, values))


def _with_values(
    derived: _Derived, typed: sp.Expr, model: HybridModel, mode: str,
    values: Mapping[str, sp.Expr | float],
) -> tuple[_Derived, sp.Expr]:  # fmt: skip
    """Derived equations and a typed one, with values of parameters in both."""
    symbols, put = {p.name: p.symbol for p in model.parameters}, {}
    for name, value in values.items():
        require_word("values", name, symbols, "compare")
        number = sp.Number(value) if isinstance(value, int | float) else value
        put[symbols[name]] = _typed(number, _names(model), model, mode)
    rows = {name: row.subs(put) for name, row in derived.rows.items()}
    solution = {x: e.subs(put) for x, e in derived.solution.items()}
    return replace(derived, rows=rows, solution=solution), typed.subs(put)


def _written_out(model: HybridModel, expr: sp.Expr, mode: str) -> sp.Expr:
    """An expression in a mode, in states and parameters alone."""
    expr = model.in_mode(expr, mode)
    for symbol, value in reversed(model.constants.items()):
        expr = expr.xreplace({symbol: value})
    return expr


def _side(model: HybridModel, mode: str) -> int | None:
    """The sign of the rotation in a mode, 0 where it is held; None where it may have either."""
    of = model.mode(mode)
    return of.side_of(mode) or (None if model.rotation in of.coordinates else 0)


# --- what was typed


def _plain(name: str) -> str:
    """A name of a symbol without the marks of LaTeX."""
    return name.translate(dict.fromkeys(map(ord, "\\{}, ")))


def _names(model: HybridModel) -> dict[str, sp.Expr]:
    """Meanings of a reader's symbols, by letter and by name, in parameters of the model."""
    names: dict[str, sp.Expr] = {}
    for name, symbol in Symbols.of(model).items():
        names |= {_plain(str(symbol)): symbol, name: symbol}
    for c in model.coordinates:
        letter = _plain(str(c.position))
        names |= {f"{letter}_dot": c.velocity, f"{letter}_ddot": c.acceleration}
        names |= {f"{letter}'": c.velocity, f"{letter}''": c.acceleration}
    for letter, acceleration in _OF_THE_GROUND.items():
        names |= dict.fromkeys(
            (f"{letter}_g_ddot", f"ddot{letter}_g", f"{letter}_g''"), acceleration
        )
    for f in model.functions:
        names |= {_plain(str(f.symbol)): f.symbol} if f.symbol.is_Symbol else {}
    shapes = {str(p.symbol): value for p, value in polar_parameters(model)}
    return shapes | _of_the_pivot(model, shapes) | names


def _of_the_pivot(model: HybridModel, shapes: Mapping[str, sp.Expr]) -> dict[str, sp.Expr]:
    """I_o, the moment of inertia about the pivot, and p of a block, where they are constants."""
    mode = next((mode for mode in model.modes if model.rotation in mode.coordinates), None)
    if mode is None:
        return {}
    row = mode.coordinates.index(model.rotation)
    inertia = tidy(model.written_out(mode.equations.mass_matrix[row, row]))
    if inertia.free_symbols & {SIDE, *(c.position for c in model.coordinates)}:
        return {}
    if "R" not in shapes:
        return {"I_o": inertia}
    (body,) = mode.bodies
    return {"I_o": inertia, "p": sp.sqrt(body.mass * mode.gravity * shapes["R"] / inertia)}


def _typed(
    equation: sp.Expr | sp.Eq, names: Mapping[str, sp.Expr], model: HybridModel, mode: str
) -> sp.Expr:
    """Left minus right-hand side of an equation, in symbols of the model."""
    sides = equation.args if isinstance(equation, sp.Equality) else (equation, sp.S.Zero)
    if not all(isinstance(side, sp.Expr) and not side.is_Matrix for side in sides):
        raise InputTypeError("equation", equation, "compare").give(
            "an expression of SymPy, which is then zero, or an sympy.Eq"
        )
    expr = sides[0] - sides[1]
    expr = _without_functions(expr, model.functions)
    for rate in sorted(expr.atoms(sp.Derivative), key=str):
        if not rate.atoms(AppliedUndef) and not rate.expr.has(*rate.variables):
            raise InputError("equation", of="compare").says(
                f"{rate} is a rate of plain symbols: write it out, with theta_ddot, or take "
                "dynamicsymbols"
            )
    expr = expr.doit()
    times = sorted({str(x) for call in expr.atoms(AppliedUndef) for x in call.args})
    if len(times) > 1 or not all(map(str.isidentifier, times)):
        raise InputError("equation", of="compare").says(
            f"its functions are of {', '.join(times)}: write all of them at one time t"
        )
    side = _side(model, mode)
    q = model.rotation.position
    put: dict[sp.Expr, sp.Expr] = {SIDE: sp.sign(q) if side is None else sp.Integer(side)}
    rates = {rate: sp.Dummy() for rate in expr.atoms(sp.Derivative)}
    others = expr.xreplace(rates).atoms(AppliedUndef, sp.Symbol) - {*rates.values()}
    for item in sorted(others | rates.keys(), key=str):
        if _in_time(item):
            put[item] = _meant(_name_in_time(item), names)
        elif item.is_Symbol and item.name != "s" and not _is_time(item, expr):
            put[item] = _meant(item.name, names)
    put |= {x: put[SIDE] for x in expr.atoms(sp.Symbol) if x.name == "s"}
    expr = expr.xreplace({x: put[x] for x in sorted(put, key=sp.count_ops, reverse=True)})
    expr = _written_out(model, expr, mode)
    if side is not None:
        expr = expr.subs({sp.sign(q): side, sp.Abs(q): side * q})
    if not _is_finite(expr):
        raise _not_finite()
    return expr


def _without_functions(expr: sp.Expr, functions: Collection[NamedFunction]) -> sp.Expr:
    """An expression with functions such as b(theta), also of theta(t), in place of their names."""
    for function in reversed([f for f in functions if f.symbol.args]):
        (of,), name = function.symbol.args, function.symbol.name
        for call in sorted(expr.atoms(AppliedUndef), key=str):
            if call.name == name and getattr(call.args[0], "name", None) == of.name:
                expr = expr.subs(call, function.value.subs(of, call.args[0]))
    return expr


def _in_time(item: sp.Basic) -> bool:
    function = item.expr if isinstance(item, sp.Derivative) else item
    return isinstance(function, AppliedUndef)


def _is_time(symbol: sp.Symbol, expr: sp.Expr) -> bool:
    return any(symbol in f.args for f in expr.atoms(AppliedUndef))


def _name_in_time(item: sp.Basic) -> str:
    """The name of a function of time, or of its first or second derivative."""
    if not isinstance(item, sp.Derivative):
        return str(item.func)
    return f"{item.expr.func}_{'d' * item.derivative_count}ot"


def _is_finite(expr: sp.Expr) -> bool:
    return not expr.has(sp.nan, sp.zoo, sp.oo)


def _not_finite() -> InputError:
    text = "the equation is not finite in this mode: multiply by what it divides by"
    return InputError("equation", of="compare").says(text)


def _meant(name: str, names: Mapping[str, sp.Expr]) -> sp.Expr:
    if _plain(name) not in names:
        raise InputError("equation", of="compare").says(
            f"the model has no symbol {name!r}{near(name, names)}: there are {', '.join(names)}"
        )
    return names[_plain(name)]


# --- the comparison


def _judged(derived: _Derived, typed: sp.Expr) -> Comparison:
    numbers = _Numbers(derived, typed)
    unknowns = typed.free_symbols & derived.solution.keys()
    rows = {n: e for n, e in derived.rows.items() if e.free_symbols & unknowns} or derived.rows
    tried = []
    for name, row in rows.items():
        for factor in _factors(typed, row, derived):
            if numbers.same(typed, factor, row):
                return Comparison(name, True, _short(factor), True)
            tried.append((name, row, factor))
    if numbers.solved_by_every_motion(typed):
        return Comparison(tried[0][0], False, _short(tried[0][2]), True)
    terms = {row: derived.terms(row) for _, row, _ in tried}
    mine = derived.terms(typed)
    if not all(map(_is_finite, mine.values())):  # it has no value at rest
        mine, terms = {"equation": typed}, {row: {"equation": row} for row in terms}
    name, row, factor = min(tried, key=lambda of: len(numbers.unlike(mine, of[2], terms[of[1]])))
    factor = _short(factor)
    difference = numbers.unlike(mine, factor, terms[row])
    short = {term: min((e, tidy(e)), key=sp.count_ops) for term, e in difference.items()}
    return Comparison(name, False, factor, False, short)


def _short(factor: sp.Expr) -> sp.Expr:
    return sp.factor(sp.simplify(factor))


def _factors(typed: sp.Expr, row: sp.Expr, derived: _Derived) -> Iterator[sp.Expr]:
    """1, and what else a typed equation may be times a derived one, by coefficients of pivots."""
    moving = (*derived.moving, *derived.solution, GROUND_X, GROUND_Y)
    still = dict.fromkeys(moving, sp.S.Zero)
    yield sp.S.One
    for x in derived.pivots:
        over, under = (sp.diff(e, x).subs(still) for e in (typed, row))
        if over != 0 and under != 0 and over != under and _is_finite(over):
            yield over / under


class _Numbers:
    """Values of expressions at random states, those of all parameters positive."""

    def __init__(self, derived: _Derived, typed: sp.Expr) -> None:
        self.derived, self.typed = derived, typed
        self.bound = SAME_AS_TYPED if typed.has(sp.Float) else SAME
        every = [typed, *derived.rows.values(), *derived.solution.values()]
        symbols = set().union(*(e.free_symbols for e in every)) | {*derived.solution}
        self.symbols = sorted(symbols, key=str)
        rng = np.random.default_rng(5)
        self._values: dict[sp.Expr, list[mpmath.mpf]] = {}
        self.samples = [self._sample(rng) for _ in range(SAMPLES)]

    def _sample(self, rng: np.random.Generator) -> dict[sp.Symbol, mpmath.mpf]:
        values = {x: mpmath.mpf(rng.uniform(0.2, 0.9)) for x in self.symbols}
        signed = {*self.derived.moving, *self.derived.solution, GROUND_X, GROUND_Y}
        values |= {x: values[x] * int(rng.choice([-1, 1])) for x in self.symbols if x in signed}
        q = self.derived.rotation
        if q in values and self.derived.side is not None:
            values[q] = abs(values[q]) * self.derived.side
        return values

    def of(self, expr: sp.Expr) -> list[mpmath.mpf]:
        """Values of an expression in the samples."""
        if expr not in self._values:
            self._values[expr] = self.at(expr, self.samples)
        return self._values[expr]

    def at(self, expr: sp.Expr, samples: Iterable[Mapping[sp.Symbol, mpmath.mpf]]) -> list:
        names = {x: sp.Symbol(f"x{i}") for i, x in enumerate(self.symbols)}
        function = sp.lambdify([*names.values()], expr.xreplace(names), modules="mpmath")
        with mpmath.workdps(DIGITS), suppress(ZeroDivisionError):
            return [function(*(sample[x] for x in self.symbols)) for sample in samples]
        raise _not_finite()

    def same(self, one: sp.Expr, factor: sp.Expr, other: sp.Expr) -> bool:
        """Whether an expression is a factor times another one, whatever their symbols are.

        To rounding of the typed equation, in which both are a term or all of it.
        """
        values = zip(*map(self.of, (one, factor, other, self.typed)), strict=True)
        with mpmath.workdps(DIGITS):
            return all(abs(a - f * b) <= self.bound * abs(size) for a, f, b, size in values)

    def unlike(
        self, mine: Mapping[str, sp.Expr], factor: sp.Expr, theirs: Mapping[str, sp.Expr]
    ) -> dict[str, sp.Expr]:
        """Terms that differ from those of a derived equation times a factor, and by what."""
        difference = {}
        for term in {**mine, **theirs}:
            a, b = (terms.get(term, sp.S.Zero) for terms in (mine, theirs))
            if not self.same(a, factor, b):
                difference[term] = a - factor * b
        return difference

    def solved_by_every_motion(self, typed: sp.Expr) -> bool:
        """Whether an equation holds where the derived ones do.

        Raises InputError for one that holds whatever its symbols are.
        """
        sizes = [abs(x) for x in self.of(typed)]
        if max(sizes) < self.bound:
            text = "the equation holds whatever its symbols are: it is an identity, 0 = 0"
            raise InputError("equation", of="compare").says(text)
        solved = [dict(sample) for sample in self.samples]
        for x, value in self.derived.solution.items():
            for sample, number in zip(solved, self.of(value), strict=True):
                sample[x] = number
        values = self.at(typed, solved)
        return all(abs(x) <= self.bound * size for x, size in zip(values, sizes, strict=True))


# --- physical terms


def _linear_terms(expr: sp.Expr, by: Mapping[str, sp.Symbol]) -> dict[str, sp.Expr]:
    """Terms of an expression that is linear in some symbols, and the rest."""
    terms = {}
    for name, x in by.items():
        without = expr.subs(x, 0)
        if expr.has(x) and _is_finite(without):
            linear = x * sp.diff(expr, x)
            terms[name] = expr - without if linear.free_symbols & {*by.values()} - {x} else linear
            expr = without
    return terms | ({"rest": expr} if expr != 0 else {})


def _terms_of_motion(
    expr: sp.Expr, equations: Equations, gravity: list[sp.Symbol]
) -> dict[str, sp.Expr]:
    pairs = zip(equations.q, equations.accelerations, strict=True)
    inertial = {f"inertia of {q}": x for q, x in pairs}
    terms = _linear_terms(expr, inertial | _GROUND)
    still = dict.fromkeys((*equations.accelerations, GROUND_X, GROUND_Y), sp.S.Zero)
    rest = expr.subs(still)
    weightless = rest.subs(dict.fromkeys(gravity, sp.S.Zero))
    resting = weightless.subs(dict.fromkeys(equations.u, sp.S.Zero))
    back = weightless.subs({x: -x for x in equations.u}, simultaneous=True)
    terms.pop("rest", None)
    return terms | {
        "gravity": rest - weightless,
        "springs and forces": resting,
        "damping": (weightless - back) / 2,
        "velocities squared": (weightless + back) / 2 - resting,
    }
