"""The check of a declaration, when a model is made: names, symbols, expressions, references.

Each check raises ValueError, which names the declaration, the item and the remedy.
"""

import re
from collections.abc import Collection, Mapping, Set

import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.compiler.types import MATH
from rockeom.numbers.checks import InputError, require_word
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.checks.common import (
    ACCELERATIONS,
    INTERNAL,
    PLACES,
    RATES,
    RESPONSE,
    SHAKING,
    SIDED,
    WORDS,
    Expressions,
    ModelError,
    Names,
    naming,
)
from rockeom.symbolic.checks.contacts import (
    check_contacts,
    check_places,
    expressions_of_contacts,
    names_of_contacts,
)
from rockeom.symbolic.checks.modes import (
    check_modes,
    check_transitions,
    expressions_of_modes,
    names_of_modes,
)
from rockeom.symbolic.hybrid import SOURCED, HybridModel
from rockeom.symbolic.model import GROUND, Coordinate, Member
from rockeom.symbolic.outputs import LOAD_POINT, names_of
from rockeom.symbolic.statics import LOAD
from rockeom.symbolic.valid import repeated


def check(model: HybridModel) -> None:
    """Names, symbols, expressions and references of a declaration."""
    with naming(model.name):
        ratio = model.rigid_velocity_ratio
        valid.expressions(
            str(model.name), overturning=model.overturning,
            rigid_velocity_ratio=1 if ratio is None else ratio,
        )  # fmt: skip
        search = model.search
        _names(model, names_of_modes(model) if search is None else names_of_contacts(search.of))
        _distinct_symbols(model)
        if search is None:
            check_modes(model)
            _contents(model, expressions_of_modes(model))
            check_transitions(model)
        else:
            check_contacts(search.of)
            _contents(model, expressions_of_contacts(search.of))
            check_places(search.of)


def _names(model: HybridModel, names: Names) -> None:
    """Refuse names that Python, a file or a response cannot have, and those that stand twice."""
    valid.name("model", model.name)
    if not model.name.isascii():
        raise ModelError("a file is called by the model's name: write it in ASCII")
    valid.texts(model.name, title=model.title, reference=model.reference)
    for of, source in model.sources.items():
        require_word("sources", of, [*(c.name for c in model.coordinates), *SOURCED], model.name)
        if not isinstance(source, str) or re.search(r"[^\w ,.;:()/-]|_", source):
            raise InputError(f"sources of {of}", source, model.name).give(
                'a text of letters, digits and punctuation, such as "thesis 2-9"'
            )
    items = [(f"parameter {p.symbol}", p.name) for p in model.parameters]
    items += [(f"coordinate {c.position}", c.name) for c in model.coordinates]
    for item, name in (*items, *names.items):
        valid.name(f"{model.name}: {item}", name)
    of_states = [p.name for p in model.parameters] + list(model.states)
    for row in (of_states, *names.distinct):
        if repeated(row):
            twice = ", ".join(repeated(row))
            raise ModelError(f"declared twice: {twice}; give each a name of its own")
    taken = ", ".join(sorted(RESPONSE & names.chosen))
    if taken:
        raise ModelError(f"every response calls something else {taken}: choose another name")


def _distinct_symbols(model: HybridModel) -> None:
    """Each symbol means one thing."""
    symbols = [p.symbol for p in model.parameters] + [d.symbol for d in model.definitions]
    symbols += [s for c in model.coordinates for s in (c.position, c.velocity, c.acceleration)]
    symbols += [f.symbol for f in model.functions]
    symbols += [x for z in model.internal for x in (z.symbol, z.rate)]
    twice = repeated(symbols)
    if twice:
        raise ModelError(
            f"the symbol {', '.join(twice)} is declared twice, with two meanings: "
            "give each parameter, coordinate and internal variable a symbol of its own",
        )
    reserved = {
        SIDE: "the side, sgn(theta)",
        LOAD: "the load of a pushover",
    } | dict.fromkeys(model.shaking, "an acceleration of the ground")
    for symbol in reserved.keys() & set(symbols):
        raise ModelError(f"the symbol {symbol} is reserved for {reserved[symbol]}: choose another")


def _contents(model: HybridModel, expressions: Expressions) -> None:
    """Sketches, and the symbols of all expressions."""
    _sketched(model)
    known = _kinds(model)
    for item, expr, kinds in (*expressions, *_common_expressions(model)):
        _content(model, known, item, sp.sympify(expr), kinds)


def _kinds(model: HybridModel) -> dict[sp.Basic, str]:
    """Kind of each symbol and function of a declaration; "" for constants."""
    kinds: dict[sp.Basic, str] = {p.symbol: "" for p in model.parameters}
    kinds |= {d.symbol: "" for d in model.definitions}
    for c in model.coordinates:
        kinds |= {c.position: PLACES, c.velocity: RATES, c.acceleration: ACCELERATIONS}
    kinds |= dict.fromkeys([SIDE, *model.switches], SIDED)
    kinds |= dict.fromkeys(model.shaking, SHAKING)
    for f in model.functions:
        kinds[f.symbol if f.symbol.is_Symbol else f.symbol.func] = PLACES
    kinds |= {z.symbol: INTERNAL for z in model.internal}
    return kinds


def _common_expressions(model: HybridModel) -> Expressions:
    """Overturning, ends of members, and sizes at which coordinates overturn."""
    yield "overturning", model.overturning, ""
    for m in model.members:
        for at in (*m.start_at, *m.end_at):
            yield f"an end of the {m.kind} from {m.start!r} to {m.end!r}", at, ""
    for c, size in model.falls.items():
        yield f"size at which {c.name!r} has overturned", size, ""


def _sketched(model: HybridModel) -> None:
    """Each place has a name of its own; members end at bodies; `falls` holds coordinates."""
    twice = repeated(names_of(model))
    if twice:
        raise ModelError(
            f"{', '.join(twice)} is the name of two of its bodies, contacts and elements, and the "
            f"load point, which is called {LOAD_POINT!r}: give each a name of its own",
        )
    bodies = [b.name for b in model.bodies]
    for m in model.members:
        if not isinstance(m, Member):
            raise ModelError(f"members holds {m!r}: give objects of Member")
        for item, name in (("start", m.start), ("end", m.end)):
            require_word(item, name, (*bodies, GROUND), f"{model.name}: member")
    if not isinstance(model.falls, Mapping):
        raise ModelError(f"falls is {model.falls!r}: give a mapping, {{coordinate: size}}")
    for c, size in model.falls.items():
        if not isinstance(c, Coordinate) or c not in model.coordinates or c == model.rotation:
            others = [c.name for c in model.coordinates if c != model.rotation]
            raise ModelError(
                f"falls holds {getattr(c, 'name', c)!r}: name coordinates besides the rotation, of "
                f"which there are {', '.join(others) or 'none'}",
            )
        valid.expressions(f"{model.name}: falls", **{c.name: size})
        if sp.sympify(size).is_nonpositive:
            raise ModelError(f"falls: the size of {c.name!r} is {size}: it must be positive")


def _content(
    model: HybridModel, known: Mapping[sp.Basic, str], item: str, expr: sp.Expr, kinds: str
) -> None:
    named = item.startswith("function")
    _has_functions(model, item, expr, _COMPILED | {"Piecewise"} if named else _COMPILED)
    used = expr.free_symbols | {f.func for f in expr.atoms(AppliedUndef)}
    unknown = sorted(str(x) for x in used if x not in known)
    if unknown:
        names = {str(x) for x in known}
        hint = (
            "; a declared one of that name has other assumptions: use its `.symbol` or `.position`"
            if names & set(unknown)
            else ""
        )
        raise ModelError(
            f"{item} contains undeclared symbols {', '.join(unknown)}: add them to `parameters` "
            f"or `coordinates`{hint}",
        )
    for x in sorted(used, key=str):
        if known[x] not in kinds:
            raise ModelError(
                f"{item} contains {WORDS[known[x]]} {x}, which it must not: it is a function of "
                + (", ".join(["the parameters", *(WORDS[k] for k in kinds)])),
            )
    by = RATES if item.startswith("dissipation") else PLACES
    steep = expr.has(sp.Abs, sp.Heaviside, sp.Max, sp.Min)
    steep = steep or ("energy" in item and _has_roots(expr, used))
    if steep and not named and (by == RATES or RATES not in kinds):
        _has_slopes(model, item, expr, {x for x in used if known[x] == by})


_COMPILED = frozenset({*MATH, "Abs", "Heaviside", "Max", "Min"})
"""Functions of an expression that a program has."""
_NEXT_TO = sp.Rational(1, 10**9)  # exact, since cosines are rounded to 1 there
_REMEDY = "write it with Max or tanh, or declare an element: Spring, Tie, Unilateral or Yielding"


def _has_functions(model: HybridModel, item: str, expr: sp.Expr, compiled: Collection[str]) -> None:
    for f in expr.atoms(sp.Function) - expr.atoms(AppliedUndef):
        if type(f).__name__ not in compiled:
            raise ModelError(f"{item} contains {f}, which cannot be compiled: {_REMEDY}")


def _has_roots(expr: sp.Expr, moving: Set[sp.Basic]) -> bool:
    return any(
        power.exp.is_integer is False and power.base.free_symbols & moving
        for power in expr.atoms(sp.Pow)
    )


def _has_slopes(model: HybridModel, item: str, expr: sp.Expr, moving: Set[sp.Basic]) -> None:
    """Refuse a slope that cannot be compiled, or that jumps at the closed configuration."""
    for x in sorted(moving, key=str):
        slope = sp.diff(expr, x)
        _has_functions(model, f"the slope of {item} by {x}", slope, _COMPILED)
        closed = {s: int(s not in moving) for s in slope.free_symbols - {x}}
        before, after = (sp.N(slope.subs({**closed, x: place})) for place in (-_NEXT_TO, _NEXT_TO))
        jump = abs(after - before)
        if jump.is_number and jump > 1e-6:
            raise ModelError(f"{item} has a kink where {x} is zero, {expr}: {_REMEDY}")
