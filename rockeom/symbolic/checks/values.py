"""Values of parameters: masses, widths and contact laws that no structure has.

Each check raises ValueError, which names the declaration, the item and the remedy.
"""

from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations
from typing import NamedTuple

import sympy as sp

from rockeom.codes import LEAST_RESTITUTION as LEAST
from rockeom.symbolic.checks.common import ModelError, naming
from rockeom.symbolic.checks.derived import first_name
from rockeom.symbolic.contacts import Contact
from rockeom.symbolic.elements import Element
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode

FLAT = sp.Rational(1, 10**12)
"""A part of the second moments of a body: rounding errors make that of a flat one negative."""


def _extents(inertia: sp.ImmutableMatrix) -> Iterator[sp.Expr]:
    """The principal minors of the second moments of masses with an inertia tensor.

    Integrals of x**2, x y and so on over the mass: sums of squares, whatever the axes.
    """
    moments = inertia.trace() * (sp.S.Half + FLAT) * sp.eye(3) - inertia
    for size in (1, 2, 3):
        for rows in combinations(range(3), size):
            yield moments.extract(rows, rows).det()


def check_values(model: HybridModel, values: Mapping[str, float]) -> None:
    """Masses must not be negative, and the left foot stands to the left of the right one."""
    with naming(model.name):
        put = {p.symbol: sp.Float(float(values[p.name])) for p in model.parameters}
        for size in sizes(model):
            found = size.value.xreplace(put)
            if found > 0 or (found == 0 and size.may_vanish):
                continue
            given = ", ".join(f"{name} = {values[name]}" for name in size.parameters)
            raise ModelError(f"{size.what} is {float(found):g} with {given}: {size.remedy}")


class Size(NamedTuple):
    """A value that must be positive, or not negative where it may vanish."""

    what: str
    value: sp.Expr
    may_vanish: bool
    parameters: tuple[str, ...]
    remedy: str


def sizes(model: HybridModel) -> tuple[Size, ...]:
    """Masses, moments of inertia, widths and contact laws that parameters alone determine."""
    symbols = {p.symbol: p.name for p in model.parameters}

    def size(what: str, value: sp.Expr, may_vanish: bool, remedy: str) -> Size:
        value = sp.sympify(value).xreplace(model.constants)
        names = tuple(n for symbol, n in symbols.items() if symbol in value.free_symbols)
        return Size(what, value, may_vanish, names, remedy)

    def of_mode(mode: Mode) -> Iterator[Size]:
        for b in mode.bodies:
            of = f"of body {b.name!r}"
            yield size(f"the mass {of}", b.mass, True, "it must not be negative")
            if len(b.position) == 2:
                remedy = "it must not be negative"
                yield size(f"the moment of inertia {of}", b.inertia, True, remedy)
                continue
            for value in _extents(b.inertia):
                remedy = "no masses have such a tensor: none of its principal moments may be above "
                remedy += "the sum of the other two"
                yield size(
                    f"a principal minor of the second moments of mass {of}", value, True, remedy
                )
        if mode.feet:
            left, right = (sp.sympify(mode.feet[f].position[0]) for f in ("left", "right"))
            width = model.in_mode((right - left).subs(upright), first_name(mode))
            remedy = "the left foot must stand to the left of the right one"
            yield size("the distance of the feet", width, False, remedy)

    def of_points(points: Iterable[Contact]) -> Iterator[Size]:
        for c in points:
            at = f"of contact {c.name!r}"
            law = c.law
            yield size(f"1 less the restitution {at}", 1 - law.restitution, True, "give 0 to 1")
            if law.stiffness != 1:
                yield size(f"the stiffness {at}", law.stiffness, False, "give a positive one")
            if law.tangential is not None:
                yield size(f"the tangential {at}", law.tangential, True, "give 0 to 1")
                yield size(f"1 less the tangential {at}", 1 - law.tangential, True, "give 0 to 1")
            if law.friction is not None:
                yield size(f"the friction {at}", law.friction, True, "it must not be negative")
            if law.law == "lzb":
                e, remedy = sp.sympify(law.restitution), f"with 'lzb' give 0, or {LEAST:g} and more"
                yield size(f"e (e - {LEAST:g}) {at}", e * (e - LEAST), True, remedy)
                for k in dict.fromkeys(other.law.stiffness for other in points if other.law != law):
                    apart = 1e8 * k - law.stiffness, e**2 * (1e10 * e**2 * k - law.stiffness)
                    remedy = "give at most 1e8 times another stiffness, and (1e5 e)**2 times"
                    yield size(f"the reserve of stiffness {at}", sp.Min(*apart), True, remedy)
            if c.side:
                width = c.side * (c.at(c.side)[1] - c.at(-c.side)[1]).subs(upright)
                remedy = "the point of side -1 must stand to the left of that of side 1"
                yield size(f"the width {at}", width, False, remedy)

    def of_elements(elements: Iterable[Element]) -> Iterator[Size]:
        for e in elements:
            for what, value in e.constants.items():
                at = f"the {what} of element {e.name!r}"
                remedy = "give a positive one" if what in e.positive else "it must not be negative"
                yield size(at, value, what not in e.positive, remedy)

    upright = {c.position: 0 for c in model.coordinates}
    every = dict.fromkeys(found for mode in model.modes for found in of_mode(mode))
    if model.search is not None:
        of = model.search.of
        every |= dict.fromkeys((*of_points(of.contacts), *of_elements(of.elements)))
    return tuple(found for found in every if found.value.free_symbols <= symbols.keys())
