"""Modes out of contacts: which modes there are, and the mode of each.

A mode is a state of each point (open, sticking, slipping to either side) and of each
element (off, on; elastic, yielding). Where points are closed or stuck the accelerations follow from

    M q'' = f + J_N^T lambda_N + J_T^T lambda_T,    gap'' = 0,    slip'' = 0 where it sticks,
    lambda_T = -mu sigma lambda_N where it slips,   sigma = +1 or -1, the sign of the slip rate.

Dependent coordinates, one for each constraint, are eliminated: q_D' = T q_I'. The rest of the
forces of contact vanishes under L, L^T (J_N^T - mu sigma J_T^T) = 0:

    L^T M T q_I'' = L^T (f - M tau),    q'' = T q_I'' + tau,

which is not symmetric where a point slips. Mirror images are one mode, written with the side
s; so are the two signs of a slip, sigma, and the states of an element, chi.

A closed point is frictionless where its law says so: lambda_T = 0, and slip'' is not constrained.
A point with friction that smooth contacts keep from slipping, such as a foot of a block at a smooth
stop, is frictionless, too, or has all its friction: statics leaves open what is between.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product
from typing import NamedTuple

import numpy as np
import sympy as sp

from rockeom.codes import FRICTIONLESS, MOST_MODES, OPEN, SLIP_LEFT, SLIP_RIGHT, STICK
from rockeom.symbolic.algebra import (
    SIDE,
    angles_in,
    brief,
    determinant,
    inverted,
    positive_below,
    rank,
    together,
    vanishes,
)
from rockeom.symbolic.beds import Combination, both, combinations_of
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.elements import switch_of
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.valid import repeated

SLIP = SLIP_RIGHT
"""In a pattern, which leaves the signs of slips open."""

VERBS = {STICK: "sticks", SLIP: "slips", FRICTIONLESS: "touches"}
"""Verbs by the state of a closed point in a pattern."""


def sign_of_slip(group: int) -> sp.Symbol:
    """sigma: +1 where the points of a group slip to the right, -1 where they slip to the left."""
    return sp.Symbol(rf"\sigma_{group}" if group else r"\sigma", real=True)


@dataclass(frozen=True)
class ContactMode:
    """A state of each point and of each element; `pattern` is its number in `Modes`."""

    name: str
    points: tuple[int, ...]
    elements: tuple[int, ...]
    pattern: int


@dataclass(frozen=True)
class Pattern:
    """The state of each point, SLIP of either sign, and the mode that moves, on a side s."""

    states: tuple[int, ...]
    mode: int
    side: int
    points: tuple[int, ...]
    """The point that plays the part of each of the mode's."""
    shared: tuple[int, ...]


class Start(NamedTuple):
    """Accelerations and forces, or rates and impulses, with which a mode begins.

    motion : by symbols of accelerations or rates. normal : by point; friction : of a group, by its
    first point.
    """

    motion: dict[sp.Symbol, sp.Expr]
    normal: dict[int, sp.Expr]
    friction: dict[int, sp.Expr]


class DerivedMode:
    """The equations of motion while some points are closed, some of which slip.

    states : of each point: OPEN, STICK, SLIP or FRICTIONLESS. sided : whether it is written with
        the side s.
    """

    def __init__(self, model: ContactDeclaration, states: tuple[int, ...], sided: bool) -> None:
        self.model, self.states, self.sided = model, states, sided
        self.n = len(model.coordinates)
        self.q = [c.position for c in model.coordinates]
        self.qd = [c.velocity for c in model.coordinates]
        self.qdd = [c.acceleration for c in model.coordinates]
        self.closed = tuple(i for i, state in enumerate(states) if state != OPEN)
        sides = [c.side * SIDE if sided else c.side for c in model.contacts]
        both = [c.at(side) for c, side in zip(model.contacts, sides, strict=True)]
        self._gaps = [gap for gap, _ in both]
        self._slips = [slip for _, slip in both]

    def __repr__(self) -> str:
        points = zip(self.model.contacts, self.states, strict=True)
        words = [f"{c.name} {VERBS[x]}" for c, x in points if x != OPEN]
        return f"<DerivedMode of {self.model.name!r}: {', '.join(words) or 'nothing is closed'}>"

    # -- the closed configuration ------------------------------------------------------------

    @property
    def place(self) -> dict[sp.Symbol, sp.Expr]:
        """Positions that the closed gaps fix, as they are put into equations."""
        return self._closing[0]

    @property
    def leaning(self) -> dict[sp.Symbol, sp.Expr]:
        """Angles at which closed gaps hold it: equations keep their symbols, and are shorter."""
        return self._closing[1]

    @property
    def left_open(self) -> list[sp.Expr]:
        """Closed gaps that these leave open: none where all can be closed together."""
        return self._closing[2]

    @cached_property
    def _closing(
        self,
    ) -> tuple[dict[sp.Symbol, sp.Expr], dict[sp.Symbol, sp.Expr], list[sp.Expr]]:
        place: dict[sp.Symbol, sp.Expr] = {}
        leaning: dict[sp.Symbol, sp.Expr] = {}
        gaps = [self._gaps[i] for i in self.closed]
        while gaps:
            fixed = next(filter(None, map(self._fixed, gaps)), None)
            if fixed is None:
                break
            if any(e.has(sp.atan) for e in fixed.values()):
                leaning |= fixed
            else:
                place = {x: brief(e.subs(fixed)) for x, e in place.items()} | fixed
            gaps = [e for gap in gaps if not vanishes(e := brief(gap.subs(fixed)))]
        return place, leaning, gaps

    def _same(self, expr: sp.Expr) -> bool:
        """Whether an expression vanishes in the closed configuration."""
        return vanishes(brief(expr.subs(self.leaning)))

    def _fixed(self, gap: sp.Expr) -> dict[sp.Symbol, sp.Expr] | None:
        """The coordinate that a closed gap fixes, where the gap can be solved for it.

        That is linear, or as an angle whose sine and cosine alone make the gap; it is then the
        one about which the structure stands upright.
        """
        x = self._linear(gap)
        if x is not None:
            return {x: brief(sp.expand(x - gap / sp.diff(gap, x)))}
        angles = angles_in(gap)
        if len(angles) != 1:
            return None
        (angle,) = angles
        sine, cosine = sp.Dummy(), sp.Dummy()
        linear = sp.expand(gap.subs({sp.sin(angle): sine, sp.cos(angle): cosine}))
        a, b = linear.coeff(sine), linear.coeff(cosine)
        x = self._linear(angle)
        if x is None or a == 0 or sp.expand(linear - a * sine - b * cosine) != 0:
            return None
        lacking = angle + sp.atan(sp.cancel(b / a))
        return {x: sp.expand(x - lacking / sp.diff(angle, x))}

    def _linear(self, expr: sp.Expr) -> sp.Symbol | None:
        """The first coordinate in which an expression is linear, its slope a constant."""
        for j in self._order:
            slope = sp.diff(expr, self.q[j])
            if slope != 0 and not slope.free_symbols & set(self.q):
                return self.q[j]
        return None

    def here(self, expr: sp.Expr) -> sp.Expr:
        """An expression in the closed configuration, the rates those of this mode."""
        return brief(sp.sympify(expr).xreplace(self.velocity).subs(self.place))

    # -- constraints -------------------------------------------------------------------------

    def _rows(self, functions: list[sp.Expr]) -> list[sp.Matrix]:
        return [
            sp.Matrix(1, self.n, [brief(sp.diff(f, x).subs(self.place)) for x in self.q])
            for f in functions
        ]

    @cached_property
    def normal_rows(self) -> dict[int, sp.Matrix]:
        """J_N of each closed point, (1, n)."""
        rows = self._rows([self._gaps[i] for i in self.closed])
        return dict(zip(self.closed, rows, strict=True))

    @cached_property
    def slip_rows(self) -> dict[int, sp.Matrix]:
        """J_T of each closed point, (1, n)."""
        rows = self._rows([self._slips[i] for i in self.closed])
        return dict(zip(self.closed, rows, strict=True))

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Closed points that share their friction: no motion that keeps them closed slips apart."""
        return self._groups[0] + self.held

    @property
    def held(self) -> tuple[tuple[int, ...], ...]:
        """The `groups` that smooth contacts keep from slipping."""
        return self._groups[1]

    @cached_property
    def _groups(self) -> tuple[tuple[tuple[int, ...], ...], tuple[tuple[int, ...], ...]]:
        rough = [i for i in self.closed if not self.model.contacts[i].law.frictionless]
        if not rough:
            return (), ()
        left = self._left_by(self.closed)
        held = [i for i in rough if all(self._same(e) for e in self.slip_rows[i] * left)]
        if held and len(rough) == len(self.closed):
            raise self._undetermined()
        free = self._grouped([i for i in rough if i not in held], left)
        return free, self._grouped(held, self._left_by(rough)) if held else ()

    def _left_by(self, points: Iterable[int]) -> sp.Matrix:
        """T of the motions that keep points closed."""
        return self._motions(sp.Matrix.vstack(*(self.normal_rows[i] for i in points)))[2]

    def _grouped(self, points: list[int], left: sp.Matrix) -> tuple[tuple[int, ...], ...]:
        """Points that slip alike in the motions T."""
        groups: list[list[int]] = []
        for i in points:
            for group in groups:
                difference = (self.slip_rows[i] - self.slip_rows[group[0]]) * left
                if all(self._same(e) for e in difference):
                    group.append(i)
                    break
            else:
                groups.append([i])
        return tuple(map(tuple, groups))

    @property
    def rubbing(self) -> tuple[tuple[int, ...], ...]:
        """The `groups` that have friction here."""
        return tuple(g for g in self.groups if self.states[g[0]] != FRICTIONLESS)

    @cached_property
    def slipping(self) -> tuple[tuple[int, ...], ...]:
        """The `groups` whose points slip."""
        return tuple(g for g in self.groups if self.states[g[0]] == SLIP)

    @cached_property
    def sticking(self) -> tuple[tuple[int, ...], ...]:
        """The `groups` whose points stick."""
        return tuple(g for g in self.groups if self.states[g[0]] == STICK)

    def sigma(self, point: int) -> sp.Expr:
        """The sign with which a point slips, 0 where it does not."""
        for i, group in enumerate(self.slipping):
            if point in group:
                return sign_of_slip(i)
        return sp.S.Zero

    def friction(self, point: int) -> sp.Expr:
        """The coefficient of friction of a point that may slip."""
        mu = self.model.contacts[point].law.friction
        return sp.S.Zero if mu is None else sp.sympify(mu)

    @property
    def _order(self) -> list[int]:
        """Coordinates as they are eliminated, the rotation last."""
        rotation = self.model.coordinates.index(self.model.rotation)
        return [j for j in range(self.n) if j != rotation] + [rotation]

    @cached_property
    def _constraints(self) -> tuple[list[int], list[int], sp.Matrix, sp.Matrix]:
        """(dependent, independent, T (n, m), A of all constraints)."""
        rows = [*self.normal_rows.values(), *(self.slip_rows[g[0]] for g in self.sticking)]
        if not rows:
            return [], list(range(self.n)), sp.eye(self.n), sp.zeros(0, self.n)
        matrix = sp.Matrix.vstack(*rows)
        return *self._motions(matrix), matrix

    @property
    def dependent(self) -> list[int]:
        """Places of the coordinates that the closed points determine."""
        return self._constraints[0]

    @property
    def independent(self) -> list[int]:
        """Places of the coordinates that are free to move."""
        return self._constraints[1]

    @property
    def motions(self) -> sp.Matrix:
        """T of q' = T q_I', (n, m)."""
        return self._constraints[2]

    def _motions(self, matrix: sp.Matrix) -> tuple[list[int], list[int], sp.Matrix]:
        """(dependent, independent, T): what A q' = 0 leaves free."""
        dependent = self._dependent(matrix)
        independent = [j for j in range(self.n) if j not in dependent]
        share = -inverted(matrix[:, dependent]) * matrix[:, independent]
        motions = sp.zeros(self.n, len(independent))
        for k, i in enumerate(independent):
            motions[i, k] = 1
            for row, d in enumerate(dependent):
                motions[d, k] = brief(share[row, k])
        return dependent, independent, motions

    def _dependent(self, matrix: sp.Matrix) -> list[int]:
        """Columns to eliminate: coordinates of known place, and the simplest divisor.

        Raises ValueError where the rows depend on one another.
        """
        used = [j for j in self._order if any(e != 0 for e in matrix[:, j])]
        best: tuple[tuple[int, int, int], list[int]] | None = None
        for columns in combinations(used, matrix.rows):
            divisor = determinant(matrix[:, list(columns)].as_immutable(), brief)
            if self._same(divisor):
                continue
            known = sum(self.q[j] in self.place or self.q[j] in self.leaning for j in columns)
            moving = len(divisor.free_symbols & set(self.q))
            cost = -known, moving, int(sp.count_ops(divisor))
            if best is None or cost < best[0]:
                best = cost, sorted(columns)
        if best is None:
            raise self._undetermined()
        return best[1]

    def _undetermined(self) -> ValueError:
        names = ", ".join(self.model.contacts[i].name for i in self.closed)
        return ValueError(
            f"{self.model.name}: with {names} closed statics leaves the friction open: no motion "
            "along the contacts is free; give friction=0, or springs (Unilateral), where gaps hold "
            "a point"
        )

    @cached_property
    def velocity(self) -> dict[sp.Symbol, sp.Expr]:
        """Rates of the dependent coordinates."""
        free = sp.Matrix([self.qd[i] for i in self.independent])
        rates = self.motions * free if self.independent else sp.zeros(self.n, 1)
        return {self.qd[d]: brief(rates[d]) for d in self.dependent}

    @cached_property
    def drift(self) -> sp.Matrix:
        """tau of q'' = T q_I'' + tau, (n, 1)."""
        tau = sp.zeros(self.n, 1)
        if not self.dependent:
            return tau
        functions = [self._gaps[i] for i in self.closed]
        functions += [self._slips[g[0]] for g in self.sticking]
        still = dict.fromkeys(self.qdd, 0)
        coordinates = self.model.coordinates
        bias = [rate(rate(f, coordinates), coordinates).subs(still) for f in functions]
        right = sp.Matrix([-self.here(b) for b in bias])
        matrix = self._constraints[3][:, self.dependent]
        found = inverted(matrix) * right
        for i, d in enumerate(self.dependent):
            tau[d] = brief(found[i])
        return tau

    # -- motion ------------------------------------------------------------------------------

    @cached_property
    def _free(self) -> tuple[sp.Matrix, sp.Matrix]:
        """(M, f) of the free structure with its elements, in this mode's configuration."""
        matrix, forces = free_motion(self.model)
        return matrix.applyfunc(self.here), forces.applyfunc(self.here)

    @cached_property
    def pushes(self) -> sp.Matrix:
        """W: directions of the forces of contact, normals first, (n, constraints)."""
        columns = [
            (row - self.friction(i) * self.sigma(i) * self.slip_rows[i]).T
            for i, row in self.normal_rows.items()
        ]
        columns += [self.slip_rows[g[0]].T for g in self.sticking]
        return sp.Matrix.hstack(*columns) if columns else sp.zeros(self.n, 0)

    @cached_property
    def balances(self) -> sp.Matrix:
        """L with L^T W = 0, (n, m); T where nothing slips."""
        if not self.slipping:
            return self.motions
        found = sp.zeros(self.n, len(self.independent))
        inverse = inverted(self.pushes[self.dependent, :])
        for j, i in enumerate(self.independent):
            found[i, j] = 1
            row = -self.pushes[i, :] * inverse
            for k, d in enumerate(self.dependent):
                found[d, j] = brief(row[k])
        return found

    @cached_property
    def mass_matrix(self) -> sp.Matrix:
        """L^T M T, (m, m)."""
        return (self.balances.T * self._free[0] * self.motions).applyfunc(brief)

    @cached_property
    def forcing(self) -> sp.Matrix:
        """L^T (f - M tau), (m, 1)."""
        matrix, forces = self._free
        return (self.balances.T * (forces - matrix * self.drift)).applyfunc(brief)

    @property
    def symmetric(self) -> bool:
        """Whether the mass matrix is symmetric: no friction enters it."""
        return not self.slipping or not self.independent

    # -- forces ------------------------------------------------------------------------------

    @cached_property
    def forces(self) -> tuple[dict[int, sp.Expr], dict[int, sp.Expr]]:
        """(normal force of each closed point, friction of each group by its first point).

        They contain the accelerations of all coordinates. The friction is that of all points of
        the group together, positive to the right.
        """
        if not self.closed:
            return {}, {}
        matrix, forces = self._free
        lacking = matrix * sp.Matrix([self._acceleration(i) for i in range(self.n)]) - forces
        here = sp.Matrix([lacking[d] for d in self.dependent])
        found = (inverted(self.pushes[self.dependent, :]) * here).applyfunc(brief)
        normal = dict(zip(self.closed, found, strict=False))
        friction = {g[0]: found[len(self.closed) + k] for k, g in enumerate(self.sticking)}
        for group in self.sticking:
            normal = self._at_their_heights(group, normal, friction[group[0]])
        for group in self.slipping:
            total = sum(self.friction(i) * normal[i] for i in group)
            friction[group[0]] = brief(-self.sigma(group[0]) * total)
        return normal, friction

    def _at_their_heights(
        self, group: tuple[int, ...], normal: dict[int, sp.Expr], friction: sp.Expr
    ) -> dict[int, sp.Expr]:
        """Normal forces where friction acts at each point of a group, not at the first alone.

        Statics determines only the sum of the friction. All points mobilise the same fraction of
        their normal forces, as they do when they slip: F_i = kappa N_i.
        """
        first = self.slip_rows[group[0]]
        apart = {i: (self.slip_rows[i] - first).applyfunc(brief) for i in group}
        if all(self._same(e) for row in apart.values() for e in row):
            return normal
        rows = sp.Matrix.vstack(*self.normal_rows.values())
        columns = self._dependent(rows)
        inverse = inverted(rows[:, columns])
        shares = {
            i: dict(zip(self.closed, (row[:, columns] * inverse).applyfunc(brief), strict=True))
            for i, row in apart.items()
        }
        alike = len({self.model.contacts[i].law.friction for i in group}) == 1
        lacking = [sum((c[j] for j in group), sp.S.Zero) for c in shares.values()]
        # what would press on points that slip would change the motion, too
        lacking += [c[j] for c in shares.values() for j in self.closed if self.sigma(j) != 0]
        if not alike or not all(map(self._same, lacking)):
            names = ", ".join(self.model.contacts[i].name for i in group)
            raise ValueError(
                f"{self.model.name}: how {names} share their friction follows neither from statics "
                "nor from one coefficient of friction at level points: give them one coefficient, "
                "or one height, or springs"
            )
        kappa = friction / sum(normal[i] for i in group)
        matrix = sp.Matrix(
            len(group), len(group),
            lambda j, i: (1 if i == j else 0) + kappa * shares[group[i]][group[j]],
        )  # fmt: skip
        solved = inverted(matrix) * sp.Matrix([normal[j] for j in group])
        inside = dict(zip(group, solved, strict=True))
        outside = {
            j: normal[j] - kappa * sum(shares[i][j] * inside[i] for i in group)
            for j in self.closed
            if j not in group
        }
        return {j: inside[j] if j in group else outside[j] for j in self.closed}

    def _acceleration(self, coordinate: int) -> sp.Expr:
        """Its symbol, or zero where nothing can move it."""
        held = coordinate in self.dependent and self.drift[coordinate] == 0
        if held and all(e == 0 for e in self.motions[coordinate, :]):
            return sp.S.Zero
        return self.qdd[coordinate]

    @cached_property
    def rebound(self) -> sp.Matrix:
        """u of q'+ = T q_I'+ + u, (n, n), times q'-: each closed gap opens e times as it closed.

        Only gaps that were closing rebound; of others the rate was zero.
        """
        found = sp.zeros(self.n, self.n)
        if not self.dependent:
            return found
        rows = [
            -sp.sympify(self.model.contacts[i].law.restitution) * row
            for i, row in self.normal_rows.items()
        ]
        rows += [sp.zeros(1, self.n) for _ in self.sticking]
        matrix = self._constraints[3][:, self.dependent]
        solved = (inverted(matrix) * sp.Matrix.vstack(*rows)).applyfunc(brief)
        for k, d in enumerate(self.dependent):
            found[d, :] = solved[k, :]
        return found

    @cached_property
    def kept_momentum(self) -> sp.Matrix:
        """K of L^T M T q_I'+ = K q'-, (m, n): what impulses at its points leave as it is.

        They press as the points are closed and slip as they slip AFTER the impact, all at once.
        """
        matrix = self._free[0]
        return (self.balances.T * matrix * (sp.eye(self.n) - self.rebound)).applyfunc(brief)

    def landing(
        self, before: Mapping[sp.Symbol, sp.Expr], place: Mapping[sp.Symbol, sp.Expr]
    ) -> Start:
        """Rates after an impact that ends in this mode, and the impulses of contact.

        before : rates by their symbols, those not named zero. It is what follows where no normal
        impulse pulls, friction stays within its cone, slips have their signs and gaps open.
        """
        put = {x: sp.sympify(before.get(x, 0)) for x in self.qd}
        old = sp.Matrix([put[x] for x in self.qd])

        def here(m: sp.Matrix) -> sp.Matrix:
            return m.applyfunc(lambda e: brief(e.subs(place)))

        free = here(self.kept_momentum) * old
        matrix = here(self.mass_matrix)
        new = here(self.rebound) * old
        if matrix.rows:
            new += here(self.motions) * inverted(matrix) * free
        pushes = here(self._free[0]) * (new - old)
        impulses = sp.zeros(0, 1)
        if self.dependent:
            inverse = inverted(here(self.pushes[self.dependent, :]))
            impulses = inverse * pushes.extract(self.dependent, [0])
        normal = dict(zip(self.closed, map(together, impulses), strict=False))
        stuck = [together(e) for e in impulses[len(self.closed) :]]
        friction = {g[0]: e for g, e in zip(self.sticking, stuck, strict=True)}
        for group in self.slipping:
            total = sum(self.friction(i) * normal[i] for i in group)
            friction[group[0]] = -self.sigma(group[0]) * total
        rates = dict(zip(self.qd, map(together, new), strict=True))
        return Start(rates, normal, friction)

    def from_rest(self, place: Mapping[sp.Symbol, sp.Expr]) -> Start:
        """Beginning of this mode from rest at given positions, in closed form.

        Accelerations of all coordinates, normal forces and friction are quotients; where the
        friction is less than friction can be, and no normal force negative, it is what begins.
        """
        still = dict(place) | dict.fromkeys(self.qd, sp.S.Zero)
        matrix, forcing, drift = (
            m.applyfunc(lambda e: brief(e.subs(still)))
            for m in (self.mass_matrix, self.forcing, self.drift)
        )
        motions = self.motions.applyfunc(lambda e: brief(e.subs(still)))
        m = matrix.rows
        divisor = determinant(matrix.as_immutable(), brief)
        above = sp.Matrix(
            m, 1,
            lambda i, _: brief(
                sum(
                    (-1) ** (i + j)
                    * determinant(matrix.minor_submatrix(j, i).as_immutable(), brief)
                    * forcing[j]
                    for j in range(m)
                )
            ),
        )  # fmt: skip
        every = (motions * above if m else sp.zeros(self.n, 1)) + drift * divisor

        def quotient(expr: sp.Expr) -> sp.Expr:
            expr = sp.expand(brief(expr.subs(still)))
            alone = expr.subs(dict.fromkeys(self.qdd, 0))
            moved = sum(sp.diff(expr, a) * e for a, e in zip(self.qdd, every, strict=True))
            return positive_below(sp.cancel(brief(alone * divisor + moved) / divisor))

        normal, friction = self.forces
        return Start(
            dict(zip(self.qdd, map(quotient, self.qdd), strict=True)),
            {i: quotient(e) for i, e in normal.items()},
            {i: quotient(e) for i, e in friction.items()},
        )

    def slip_rate(self, group: tuple[int, ...]) -> sp.Expr:
        """Rate of slip of the points of a group."""
        return self.here((self.slip_rows[group[0]] * sp.Matrix(self.qd))[0])

    def gap(self, point: int) -> sp.Expr:
        """The gap of a point in this mode's configuration."""
        return brief(self._gaps[point].subs(self.place))


@dataclass(frozen=True)
class Modes:
    """All modes of a model, their patterns and equations."""

    states: tuple[ContactMode, ...]
    patterns: tuple[Pattern, ...]
    derived: tuple[DerivedMode, ...]

    @property
    def standing(self) -> dict[sp.Symbol, sp.Expr]:
        """Positions at rest with as many points closed as may be."""
        first = self.derived[0]
        return {x: e.subs(first.leaning) for x, e in first.place.items()} | first.leaning

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the modes, in the order of their numbers."""
        return tuple(state.name for state in self.states)

    def signs_of(self, state: ContactMode) -> list[int]:
        """The sign of each slip of the state's mode."""
        pattern = self.patterns[state.pattern]
        groups = self.derived[pattern.mode].slipping
        ways = [state.points[pattern.points[group[0]]] for group in groups]
        return [1 if way == SLIP_RIGHT else -1 for way in ways]

    def signs(self, state: ContactMode) -> dict[sp.Symbol, int]:
        """The side and the signs of slips of a mode."""
        pattern = self.patterns[state.pattern]
        found = {SIDE: pattern.side} if self.mode_of(state).sided else {}
        slips = {sign_of_slip(i): sign for i, sign in enumerate(self.signs_of(state))}
        return found | slips

    def mode_of(self, state: ContactMode) -> DerivedMode:
        """The equations of motion of a mode."""
        return self.derived[self.patterns[state.pattern].mode]


def free_motion(model: ContactDeclaration) -> tuple[sp.Matrix, sp.Matrix]:
    """(M, f) of M q'' = f without forces of contact; an element acts by its chi."""
    equations = model.free.equations
    forces = equations.forcing
    for i, element in enumerate(model.switching):
        force = force_of(model, i)
        for j, c in enumerate(model.coordinates):
            forces[j] -= force * sp.diff(element.displacement, c.position)
    return equations.mass_matrix, forces


def force_of(model: ContactDeclaration, element: int) -> sp.Expr:
    """The force of an element, by its chi."""
    return model.switching[element].force(switch_of(element), model.coordinates)


# --- which there are


def derive_modes(model: ContactDeclaration) -> Modes:
    """All modes of a model.

    Raises ValueError where statics does not tell how closed points share their forces, and where
    there are more than MOST_MODES.
    """
    patterns: list[Pattern] = []
    derived: list[DerivedMode] = []
    states: list[ContactMode] = []
    known: dict[tuple[int, ...], int] = {}
    mirror = _mirror(model)
    every = combinations_of(model.switching)
    for closed in _closed_sets(model):
        all_stuck = DerivedMode(model, _stuck(model, closed), False)
        groups, held = all_stuck.groups, all_stuck.held
        for kinds in product(*((FRICTIONLESS if g in held else STICK, SLIP) for g in groups)):
            if any(
                kind == SLIP and any(model.contacts[i].law.friction is None for i in group)
                for kind, group in zip(kinds, groups, strict=True)
            ):
                continue
            points = [FRICTIONLESS if i in closed else OPEN for i in range(len(model.contacts))]
            for kind, group in zip(kinds, groups, strict=True):
                for i in group:
                    points[i] = kind
            pattern = _pattern(model, tuple(points), groups, mirror, known, derived)
            patterns.append(pattern)
            mode = derived[pattern.mode]
            _ = mode.dependent  # raises where it cannot move or stand so
            _are_few(model, len(states) + 2 ** len(mode.slipping) * len(every))
            states += _states(model, pattern, mode, len(patterns) - 1, every)
    twice = repeated(state.name for state in states)
    if twice:
        raise ValueError(
            f"{model.name}: two modes would be called {twice[0]!r}: choose names of "
            "contacts and elements that do not make one another's"
        )
    return Modes(tuple(states), tuple(patterns), tuple(derived))


def _are_few(model: ContactDeclaration, number: int) -> None:
    if number > MOST_MODES:
        raise ValueError(
            f"{model.name}: its {len(model.contacts)} contacts and {len(model.switching)} elements "
            f"have more than {MOST_MODES} modes: declare fewer of them"
        )


def _stuck(model: ContactDeclaration, closed: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(STICK if i in closed else OPEN for i in range(len(model.contacts)))


def _mirror(model: ContactDeclaration) -> list[int]:
    """The point on the other side of each, itself where it has none."""
    found = []
    for i, c in enumerate(model.contacts):
        image = [
            j
            for j, o in enumerate(model.contacts)
            if c.side and (o.gap, o.slip, o.law, o.side) == (c.gap, c.slip, c.law, -c.side)
        ]
        found.append(image[0] if image else i)
    return found


def _closed_sets(model: ContactDeclaration) -> list[tuple[int, ...]]:
    """Sets of points that may be closed together, the largest first, made of those of one less."""
    sets: list[list[tuple[int, ...]]] = [[()]]
    while sets[-1]:
        smaller = set(sets[-1])
        larger = [
            (*closed, i)
            for closed in sets[-1]
            for i in range(max(closed, default=-1) + 1, len(model.contacts))
            if all((*closed[:k], *closed[k + 1 :], i) in smaller for k in range(len(closed)))
        ]
        sets.append([closed for closed in larger if _may_close(model, closed)])
        _are_few(model, sum(map(len, sets)))
    return [closed for some in reversed(sets) for closed in some]


def _may_close(model: ContactDeclaration, closed: tuple[int, ...]) -> bool:
    """Whether points may be closed together, whatever the parameters are."""
    if len(closed) < 2:
        return True
    mode = DerivedMode(model, _stuck(model, closed), False)
    if any(not gap.free_symbols & set(mode.q) for gap in mode.left_open):
        return False  # but for parameters that happen to make them meet
    matrix = sp.Matrix.vstack(*mode.normal_rows.values())
    if rank(matrix.subs(mode.leaning)) == len(closed):
        return True
    if mode.left_open and not _meet(mode):
        return False
    names = ", ".join(model.contacts[i].name for i in closed)
    raise ValueError(
        f"{model.name}: {names} may close at once, and statics leaves open how they share "
        "their forces: leave out those between others, or declare them as springs (Unilateral)"
    )


def _meet(mode: DerivedMode) -> bool:
    """Whether all closed gaps can be zero at once, at random parameters."""
    rng = np.random.default_rng(2)
    gaps = sp.Matrix(mode.left_open)
    places = [x for x in mode.q if gaps.has(x)]
    given = sorted(gaps.free_symbols - set(places), key=str)
    put = {x: sp.Float(rng.uniform(0.5, 1.5)) for x in given}
    value = sp.lambdify(places, gaps.subs(put).doit(), modules="math")
    slope = sp.lambdify(places, gaps.jacobian(places).subs(put), modules="math")
    x = rng.uniform(-0.1, 0.1, len(places))
    for _ in range(100):
        slopes = np.array(slope(*x), dtype=float)
        x = x - np.linalg.lstsq(slopes, np.array(value(*x), dtype=float).ravel(), rcond=None)[0]
    return bool(np.abs(np.array(value(*x), dtype=float)).max() < 1e-9)


def _pattern(
    model: ContactDeclaration,
    pattern: tuple[int, ...],
    groups: tuple[tuple[int, ...], ...],
    mirror: list[int],
    known: dict[tuple[int, ...], int],
    derived: list[DerivedMode],
) -> Pattern:
    """The pattern of some states of points, its mode one of those before or new."""
    points = tuple(range(len(pattern)))
    image = tuple(pattern[mirror[i]] for i in points)
    shared = tuple(next((g[0] for g in groups if i in g), i) for i in points)
    # written for the right side, where there is one
    written = image if _leans(model, pattern, image) < 0 else pattern
    if written not in known:
        known[written] = len(derived)
        derived.append(DerivedMode(model, written, image != pattern))
    if written == pattern:
        return Pattern(pattern, known[written], 1, points, shared)
    return Pattern(pattern, known[written], -1, tuple(mirror), shared)


def _leans(model: ContactDeclaration, pattern: tuple[int, ...], image: tuple[int, ...]) -> int:
    """The side of the first closed point that is not closed in the image alike."""
    for i, (state, other) in enumerate(zip(pattern, image, strict=True)):
        if state != other and state != OPEN:
            return model.contacts[i].side
    return 1


def _states(
    model: ContactDeclaration,
    pattern: Pattern,
    mode: DerivedMode,
    number: int,
    of_elements: Mapping[Combination, list[str]],
) -> Iterator[ContactMode]:
    groups = [tuple(sorted(pattern.points[i] for i in g)) for g in mode.groups]
    slips = [g for g in groups if pattern.states[g[0]] == SLIP]
    smooth = _pairs(model, [i for i, s in enumerate(pattern.states) if s == FRICTIONLESS])
    for signs in product((SLIP_RIGHT, SLIP_LEFT), repeat=len(slips)):
        ways = dict(zip(slips, signs, strict=True))
        points = list(pattern.states)
        for group, sign in ways.items():
            for i in group:
                points[i] = sign
        states_of = {g: ways.get(g, STICK) for g in groups} | dict.fromkeys(smooth, FRICTIONLESS)
        of_points = _words(model, {g: states_of[g] for g in sorted(states_of)})
        for elements, words in of_elements.items():
            name = "_".join([*of_points, *words]) or "flight"
            yield ContactMode(name, tuple(points), elements, number)


def _pairs(model: ContactDeclaration, points: list[int]) -> list[tuple[int, ...]]:
    """Frictionless points, of which a left and a right one of one kind have one name."""
    found: list[tuple[int, ...]] = []
    for i in points:
        names = [model.contacts[j].name for j in (*found[-1], i)] if found else []
        if len(names) == 2 and both(names) != "_".join(names):
            found[-1] += (i,)
        else:
            found.append((i,))
    return found


def _words(model: ContactDeclaration, groups: Mapping[tuple[int, ...], int]) -> list[str]:
    """Words of a mode's name: closed points, and directions of slips."""
    slides = {SLIP_RIGHT: "_slides_right", SLIP_LEFT: "_slides_left"}
    return [
        both([model.contacts[i].name for i in group]) + slides.get(state, "")
        for group, state in groups.items()
    ]
