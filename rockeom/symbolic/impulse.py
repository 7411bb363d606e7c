"""Velocities after a sudden change of contact, by the impulsive form of Lagrange's equations.

Over an impact positions stay and only impulses act. The impulse at a new support does no work
in any motion of the mode that follows, so the momentum in the directions of that mode is
conserved:

    M+ q'+ = sum_i (m_i J+_i^T v-_i + I_i w+_i^T w-_i)

with J+ the Jacobian of body i in the mode after the impact. For a rigid block this is the
conservation of angular momentum about the new pivot (Housner 1963; thesis 2-6, 5-14). With
full contact after the impact the impulses of both feet drop out.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.algebra import SIDE, at_side, determinant, slopes, tidy
from rockeom.symbolic.fractions import cancelled
from rockeom.symbolic.lagrange import body_velocity, inertia
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import Coordinate
from rockeom.symbolic.text.shown import Shown

AFTER, BEFORE = "+", "-"


def at_impact(coordinate: Coordinate, when: str) -> sp.Symbol:
    """The velocity just AFTER or BEFORE an impact."""
    return sp.Symbol(f"{coordinate.velocity}^{{{when}}}", real=True)


class OnSide(NamedTuple):
    """A mode on one of its sides, -1, 0 or 1."""

    mode: Mode
    side: int


@dataclass(frozen=True, repr=False)
class ImpulseMap(Shown):
    """Impulse map M+ q'+ = momentum(q, q'-), for the coordinates free after the change.

    The side s, where there is one, is that of the mode before the change.

    Parameters
    ----------
    coordinates : tuple of Coordinate
        Coordinates free after the change.
    mass_matrix : sympy.Matrix
        Matrix M+ (n, n).
    momentum : sympy.Matrix
        Momentum (n, 1).
    """

    coordinates: tuple[Coordinate, ...]
    mass_matrix: sp.Matrix
    momentum: sp.Matrix

    def velocities(self) -> sp.Matrix:
        """Velocities after the change in closed form, by Cramer's rule.

        Returns
        -------
        sympy.Matrix
            Velocities (n, 1).

        Raises
        ------
        ValueError
            If the mass matrix is singular: a direction without mass.
        """

        def of(column: int, by: sp.Matrix) -> sp.Expr:
            left, right = self.mass_matrix[:, :column], self.mass_matrix[:, column + 1 :]
            return determinant(sp.Matrix.hstack(left, by, right).as_immutable())

        whole = determinant(self.mass_matrix.as_immutable())
        if whole == 0:
            raise ValueError(f"the mass matrix after the change is singular: {self.mass_matrix}")
        n = len(self.coordinates)
        return sp.Matrix(n, 1, lambda i, _: sp.factor(of(i, self.momentum) / whole))

    def at_side(self, side: int) -> ImpulseMap:
        """Same map, the side s put in as a number.

        Parameters
        ----------
        side : int
            Side, -1 or 1.

        Returns
        -------
        ImpulseMap
            Map.
        """

        def put(m: sp.Matrix) -> sp.Matrix:
            return m.subs(SIDE, side)

        return ImpulseMap(self.coordinates, put(self.mass_matrix), put(self.momentum))

    def equation_lines(self) -> list[str]:
        """LaTeX of each row; velocities with a plus are those just after the change."""
        after = sp.Matrix([at_impact(c, AFTER) for c in self.coordinates])
        rows = zip((self.mass_matrix * after) if after else after, self.momentum, strict=True)
        return [f"{sp.latex(a)} = {sp.latex(b)}" for a, b in rows]

    def __repr__(self) -> str:
        return f"<ImpulseMap to {', '.join(str(c.velocity) for c in self.coordinates) or 'rest'}>"

    def equals(self, other: ImpulseMap) -> bool:
        """Whether both are the same for the same coordinates, term by term.

        Parameters
        ----------
        other : ImpulseMap
            Other map.

        Returns
        -------
        bool
            Whether they are.
        """
        if self.coordinates != other.coordinates:
            return False
        differences = [*(self.mass_matrix - other.mass_matrix), *(self.momentum - other.momentum)]
        return all(tidy(d) == 0 for d in differences)


def momentum(mode: Mode) -> tuple[sp.Expr, ...]:
    """Momentum of all bodies along each axis, relative to the ground.

    Its gain over a change of contact is the impulse of the ground on both feet together.
    """
    total = [sp.Integer(0)] * len(mode.bodies[0].position)
    for body in mode.bodies:
        velocity = body_velocity(body, mode.coordinates)
        total = [p + body.mass * v for p, v in zip(total, velocity, strict=False)]
    return tuple(map(tidy, total))


def derive_impulse_map(
    before: OnSide,
    after: OnSide,
    rotation: Coordinate,
    written_out: Callable[[sp.Expr], sp.Expr],
) -> ImpulseMap:
    """The map from one mode to another at the closed gap, where the rotation is zero.

    written_out : writes an expression without the names of functions.
    """
    # written for the side s of the source; the opposite edge is the target's
    flip = {SIDE: SIDE * before.side * after.side} if after.mode.has_side else {}
    closed = {rotation.position: 0}
    rates = [c.velocity for c in after.mode.coordinates]
    n = len(rates)
    mass_matrix, momentum = sp.zeros(n, n), sp.zeros(n, 1)
    for i, body in enumerate(before.mode.bodies):
        leaving = body_velocity(after.mode.bodies[i], after.mode.coordinates)
        jacobian = sp.Matrix([slopes(e, rates) for e in leaving]).reshape(len(leaving), n)
        jacobian = jacobian.subs(flip, simultaneous=True).subs(closed)
        arriving = body_velocity(body, before.mode.coordinates).subs(closed)
        mass_matrix += jacobian.T * inertia(body) * jacobian
        momentum += jacobian.T * inertia(body) * arriving

    def written(m: sp.Matrix) -> sp.Matrix:
        return m.applyfunc(lambda e: tidy(written_out(e).subs(closed)))

    return ImpulseMap(after.mode.coordinates, written(mass_matrix), written(momentum))


def rigid_velocity_ratio(
    impact: ImpulseMap, coordinates: Iterable[Coordinate], rotation: Coordinate, side: int
) -> sp.Expr:
    """Ratio of angular velocities after and before the impact of the structure held rigid.

    All coordinates but the rotation are frozen at zero, and the conservation of angular momentum
    about the new pivot is left, thesis 2-6 (its square root) and 5-14. side : before the impact.
    """
    frozen: dict[sp.Expr, sp.Expr] = {}
    for c in coordinates:
        if c != rotation:
            frozen |= {c.position: sp.S.Zero, c.velocity: sp.S.Zero}
    row = [c.name for c in impact.coordinates].index(rotation.name)
    ratio = impact.momentum[row].xreplace(frozen) / (
        impact.mass_matrix[row, row].xreplace(frozen) * rotation.velocity
    )
    return at_side(_shortest(ratio), side)


@lru_cache(maxsize=256)  # needed again by the checks of a declaration, and for each side
def _shortest(ratio: sp.Expr) -> sp.Expr:
    ratio = cancelled(ratio)
    parts = sp.fraction(ratio)
    if not all(map(_has_no_factors, parts)):
        return sp.factor(tidy(ratio))
    # as `factor` writes it, which takes long to find nothing among many parameters
    signs = [1 if sp.Poly(e).LC() > 0 else -1 for e in parts]
    over, under = (s * e for s, e in zip(signs, parts, strict=True))
    return sp.Mul(signs[0] * signs[1], over, 1 / under)


def _has_no_factors(expr: sp.Expr) -> bool:
    """Whether a sum of products cannot be factored: it contains a symbol once, and by itself."""
    counts = Counter(x for term in expr.args for x in term.free_symbols)
    alone = (x for term in expr.args for x in (term, -term) if x.is_Symbol)
    return expr.is_Add and expr.is_polynomial() and any(counts[x] == 1 for x in alone)
