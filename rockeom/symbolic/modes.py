"""Modes out of contacts: which contact states there are, and the mechanism of each.

A contact state is a state of each point (open, sticking, slipping to either side) and of each
element (off, on). Where points are closed or stuck the accelerations follow from

    M q'' = f + J_N^T lambda_N + J_T^T lambda_T,    gap'' = 0,    slip'' = 0 where it sticks,
    lambda_T = -mu sigma lambda_N where it slips,   sigma = +1 or -1, the sign of the slip rate.

Dependent coordinates, one for each constraint, are eliminated: q_D' = T q_I'. What is left of the
forces of contact vanishes under L, L^T (J_N^T - mu sigma J_T^T) = 0:

    L^T M T q_I'' = L^T (f - M tau),    q'' = T q_I'' + tau,

which is not symmetric where a point slips. Mirror images are one mechanism, written with the side
s; so are the two signs of a slip, sigma, and the states of an element, chi = 0 or 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product

import numpy as np
import sympy as sp

from rockeom.contract import OPEN, SLIP_LEFT, SLIP_RIGHT, STICK
from rockeom.symbolic.algebra import SIDE, square_is, tidy
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.lagrange import rate

SLIP = SLIP_RIGHT
"""In an arrangement, which does not tell the signs of slips."""

MOST = 4096
"""Contact states of a structure."""


def sign_of_slip(group: int) -> sp.Symbol:
    """sigma: +1 where the points of a group slip to the right, -1 where they slip to the left."""
    return sp.Symbol(rf"\sigma_{group}" if group else r"\sigma", real=True)


def switch_of(element: int) -> sp.Symbol:
    """chi: 1 where an element is on, 0 where it is off."""
    return sp.Symbol(rf"\chi_{element}", real=True)


@dataclass(frozen=True)
class ContactState:
    """A state of each point and of each element; `arrangement` is its number in `Modes`."""

    name: str
    points: tuple[int, ...]
    elements: tuple[int, ...]
    arrangement: int


@dataclass(frozen=True)
class Arrangement:
    """Which points are open, stick or slip, and the mechanism that moves then, on a side s."""

    states: tuple[int, ...]
    mechanism: int
    side: int
    points: tuple[int, ...]
    """The point that plays the part of each of the mechanism's."""
    shared: tuple[int, ...]


class Mechanism:
    """What moves while some points are closed, some of which slip.

    states : of each point: OPEN, STICK or SLIP. sided : whether it is written with the side s.
    """

    def __init__(self, model: Model, states: tuple[int, ...], sided: bool) -> None:
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

    # -- the closed configuration ------------------------------------------------------------

    @cached_property
    def place(self) -> dict[sp.Symbol, sp.Expr]:
        """Positions that the closed gaps fix in closed form."""
        found: dict[sp.Symbol, sp.Expr] = {}
        gaps = [self._gaps[i] for i in self.closed]
        while gaps:
            for gap in gaps:
                fixed = self._fixed(gap)
                if fixed is not None:
                    break
            else:
                return found
            found = {x: brief(e.subs(fixed)) for x, e in found.items()} | fixed
            gaps = [e for gap in gaps if (e := brief(gap.subs(fixed))) != 0]
        return found

    def _fixed(self, gap: sp.Expr) -> dict[sp.Symbol, sp.Expr] | None:
        """The coordinate that a closed gap fixes, where it enters so that it can be told."""
        for x in self.q:
            slope = sp.diff(gap, x)
            if slope != 0 and not slope.free_symbols & set(self.q):
                return {x: brief(sp.expand(x - gap / slope))}
        free = [x for x in self.q if gap.has(x)]
        if len(free) == 1:
            (x,) = free
            sine, cosine = sp.Dummy(), sp.Dummy()
            linear = sp.expand(gap.subs({sp.sin(x): sine, sp.cos(x): cosine}))
            a, b = linear.coeff(sine), linear.coeff(cosine)
            if not linear.has(x) and a != 0 and sp.expand(linear - a * sine - b * cosine) == 0:
                return {x: -sp.atan(sp.cancel(b / a))}
        return None

    def here(self, expr: sp.Expr) -> sp.Expr:
        """An expression in the closed configuration, the rates those of this mechanism."""
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

    @cached_property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Closed points that share their friction: no motion that keeps them closed slips apart."""
        if not self.closed:
            return ()
        normal = sp.Matrix.vstack(*self.normal_rows.values())
        left = sp.zeros(self.n, 0) if normal.rows == self.n else _motions(normal, self._order)[2]
        groups: list[list[int]] = []
        for i in self.closed:
            for group in groups:
                difference = (self.slip_rows[i] - self.slip_rows[group[0]]) * left
                if all(brief(e) == 0 for e in difference):
                    group.append(i)
                    break
            else:
                groups.append([i])
        return tuple(map(tuple, groups))

    @cached_property
    def slipping(self) -> tuple[tuple[int, ...], ...]:
        return tuple(g for g in self.groups if self.states[g[0]] == SLIP)

    @cached_property
    def sticking(self) -> tuple[tuple[int, ...], ...]:
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
        dependent, independent, motions = _motions(matrix, self._order)
        return dependent, independent, motions, matrix

    @property
    def dependent(self) -> list[int]:
        return self._constraints[0]

    @property
    def independent(self) -> list[int]:
        return self._constraints[1]

    @property
    def motions(self) -> sp.Matrix:
        """T of q' = T q_I', (n, m)."""
        return self._constraints[2]

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
        still = {x: 0 for x in self.qdd}
        coordinates = self.model.coordinates
        bias = [rate(rate(f, coordinates), coordinates).subs(still) for f in functions]
        right = sp.Matrix([-self.here(b) for b in bias])
        matrix = self._constraints[3][:, self.dependent]
        found = _inverse(matrix) * right
        for i, d in enumerate(self.dependent):
            tau[d] = brief(found[i])
        return tau

    # -- motion ------------------------------------------------------------------------------

    @cached_property
    def _free(self) -> tuple[sp.Matrix, sp.Matrix]:
        """(M, f) of the free structure with its elements, in this mechanism's configuration."""
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
        inverse = _inverse(self.pushes[self.dependent, :])
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
        return not self.slipping

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
        found = (_inverse(self.pushes[self.dependent, :]) * here).applyfunc(brief)
        normal = dict(zip(self.closed, found, strict=False))
        friction: dict[int, sp.Expr] = {}
        for group in self.slipping:
            total = sum(self.friction(i) * normal[i] for i in group)
            friction[group[0]] = brief(-self.sigma(group[0]) * total)
        for k, group in enumerate(self.sticking):
            friction[group[0]] = found[len(self.closed) + k]
        return normal, friction

    def _acceleration(self, coordinate: int) -> sp.Expr:
        """Its symbol, or zero where nothing can move it."""
        held = coordinate in self.dependent and self.drift[coordinate] == 0
        if held and all(e == 0 for e in self.motions[coordinate, :]):
            return sp.S.Zero
        return self.qdd[coordinate]

    def slip_rate(self, group: tuple[int, ...]) -> sp.Expr:
        """Rate of slip of the points of a group."""
        return self.here((self.slip_rows[group[0]] * sp.Matrix(self.qd))[0])

    def gap(self, point: int) -> sp.Expr:
        """The gap of a point in this mechanism's configuration."""
        return brief(self._gaps[point].subs(self.place))


@dataclass(frozen=True)
class Modes:
    """All contact states of a model, their arrangements and mechanisms."""

    states: tuple[ContactState, ...]
    arrangements: tuple[Arrangement, ...]
    mechanisms: tuple[Mechanism, ...]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(state.name for state in self.states)

    def signs_of(self, state: ContactState) -> list[int]:
        """The sign of each slip of the state's mechanism."""
        arrangement = self.arrangements[state.arrangement]
        groups = self.mechanisms[arrangement.mechanism].slipping
        ways = [state.points[arrangement.points[group[0]]] for group in groups]
        return [1 if way == SLIP_RIGHT else -1 for way in ways]

    def signs(self, state: ContactState) -> dict[sp.Symbol, int]:
        """What the side and the signs of slips of the state's mechanism are."""
        arrangement = self.arrangements[state.arrangement]
        found = {SIDE: arrangement.side} if self.mechanism_of(state).sided else {}
        slips = {sign_of_slip(i): sign for i, sign in enumerate(self.signs_of(state))}
        return found | slips

    def mechanism_of(self, state: ContactState) -> Mechanism:
        return self.mechanisms[self.arrangements[state.arrangement].mechanism]


def free_motion(model: Model) -> tuple[sp.Matrix, sp.Matrix]:
    """(M, f) of M q'' = f without forces of contact; an element acts by its chi."""
    equations = model.free.equations
    forces = equations.forcing
    for i, element in enumerate(model.elements):
        press = switch_of(i) * press_of(model, i)
        for j, c in enumerate(model.coordinates):
            forces[j] -= press * sp.diff(element.compression, c.position)
    return equations.mass_matrix, forces


def press_of(model: Model, element: int) -> sp.Expr:
    """k d + c d' of an element."""
    e = model.elements[element]
    return e.stiffness * e.compression + e.damping * rate(e.compression, model.coordinates)


# --- which there are


def derive_modes(model: Model) -> Modes:
    """All contact states of a model.

    Raises ValueError where statics does not tell how closed points share their forces, and where
    there are more than MOST.
    """
    arrangements: list[Arrangement] = []
    mechanisms: list[Mechanism] = []
    states: list[ContactState] = []
    known: dict[tuple[int, ...], int] = {}
    mirror = _mirror(model)
    for closed in _closed_sets(model):
        groups = Mechanism(model, _stuck(model, closed), False).groups
        for kinds in product((STICK, SLIP), repeat=len(groups)):
            if any(
                kind == SLIP and any(model.contacts[i].law.friction is None for i in group)
                for kind, group in zip(kinds, groups, strict=True)
            ):
                continue
            pattern = [OPEN] * len(model.contacts)
            for kind, group in zip(kinds, groups, strict=True):
                for i in group:
                    pattern[i] = kind
            arrangement = _arrangement(model, tuple(pattern), groups, mirror, known, mechanisms)
            arrangements.append(arrangement)
            mechanism = mechanisms[arrangement.mechanism]
            states += _states(model, arrangement, mechanism, len(arrangements) - 1)
            if len(states) > MOST:
                raise ValueError(
                    f"{model.name}: its {len(model.contacts)} contacts and {len(model.elements)} "
                    f"elements have more than {MOST} contact states: declare fewer of them"
                )
    return Modes(tuple(states), tuple(arrangements), tuple(mechanisms))


def _stuck(model: Model, closed: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(STICK if i in closed else OPEN for i in range(len(model.contacts)))


def _mirror(model: Model) -> list[int]:
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


def _closed_sets(model: Model) -> Iterator[tuple[int, ...]]:
    """Sets of points that may be closed together, the largest first."""
    points = range(len(model.contacts))
    for k in reversed(range(len(model.contacts) + 1)):
        for closed in combinations(points, k):
            if _may_close(model, closed):
                yield closed


def _may_close(model: Model, closed: tuple[int, ...]) -> bool:
    """Whether points may be closed together, whatever the parameters are."""
    if len(closed) < 2:
        return True
    mechanism = Mechanism(model, _stuck(model, closed), False)
    matrix = sp.Matrix.vstack(*mechanism.normal_rows.values())
    return _rank(matrix) == len(closed)


def _arrangement(
    model: Model,
    pattern: tuple[int, ...],
    groups: tuple[tuple[int, ...], ...],
    mirror: list[int],
    known: dict[tuple[int, ...], int],
    mechanisms: list[Mechanism],
) -> Arrangement:
    """The arrangement of a pattern, its mechanism one that is known or new."""
    points = tuple(range(len(pattern)))
    image = tuple(pattern[mirror[i]] for i in points)
    shared = tuple(next((g[0] for g in groups if i in g), i) for i in points)
    # written for the right side, where there is one
    written = image if _leans(model, pattern, image) < 0 else pattern
    if written not in known:
        known[written] = len(mechanisms)
        mechanisms.append(Mechanism(model, written, image != pattern))
    if written == pattern:
        return Arrangement(pattern, known[written], 1, points, shared)
    return Arrangement(pattern, known[written], -1, tuple(mirror), shared)


def _leans(model: Model, pattern: tuple[int, ...], image: tuple[int, ...]) -> int:
    """The side of the first closed point that is not closed in the image alike."""
    for i, (state, other) in enumerate(zip(pattern, image, strict=True)):
        if state != other and state != OPEN:
            return model.contacts[i].side
    return 1


def _states(
    model: Model, arrangement: Arrangement, mechanism: Mechanism, number: int
) -> Iterator[ContactState]:
    groups = [tuple(arrangement.points[i] for i in g) for g in mechanism.slipping]
    for signs in product((SLIP_RIGHT, SLIP_LEFT), repeat=len(groups)):
        points = list(arrangement.states)
        for sign, group in zip(signs, groups, strict=True):
            for i in group:
                points[i] = sign
        for elements in product((1, 0), repeat=len(model.elements)):
            name = _name(model, points, elements, groups, signs)
            yield ContactState(name, tuple(points), elements, number)


def _name(model: Model, points, elements, groups, signs) -> str:
    """What a contact state is called: by what touches, and what slips where."""
    every = [c.name for c in model.contacts] + [e.name for e in model.elements]
    down = [c.name for c, state in zip(model.contacts, points, strict=True) if state != OPEN]
    down += [e.name for e, on in zip(model.elements, elements, strict=True) if on]
    if sorted(every) == ["left", "right"] and len(down) == 2:
        name = "both"
    else:
        name = "_".join(down) or "flight"
    closed = sum(state != OPEN for state in points)
    for group, sign in zip(groups, signs, strict=True):
        way = "right" if sign == SLIP_RIGHT else "left"
        which = "" if len(group) == closed else f"_{model.contacts[group[0]].name}"
        name += f"{which}_slides_{way}"
    return name


# --- algebra


def brief(expr: sp.Expr) -> sp.Expr:
    """`tidy`, and the square of a sign of slip is 1."""
    expr = tidy(expr)
    for symbol in sorted(expr.free_symbols, key=str):
        if str(symbol).startswith(r"\sigma"):
            expr = square_is(expr, symbol, sp.S.One)
    return expr


def _motions(matrix: sp.Matrix, order: list[int]) -> tuple[list[int], list[int], sp.Matrix]:
    """(dependent, independent, T): what A q' = 0 leaves free."""
    dependent = _dependent(matrix, order)
    n = matrix.cols
    independent = [j for j in range(n) if j not in dependent]
    share = -_inverse(matrix[:, dependent]) * matrix[:, independent]
    motions = sp.zeros(n, len(independent))
    for k, i in enumerate(independent):
        motions[i, k] = 1
        for row, d in enumerate(dependent):
            motions[d, k] = brief(share[row, k])
    return dependent, independent, motions


def _dependent(matrix: sp.Matrix, order: list[int]) -> list[int]:
    """Columns to eliminate, those with the simplest determinant, the first in `order` if alike."""
    rows = matrix.rows
    used = [j for j in order if any(e != 0 for e in matrix[:, j])]
    best: tuple[tuple[int, int], list[int]] | None = None
    for columns in combinations(used, rows):
        found = brief(matrix[:, list(columns)].det())
        if found == 0:
            continue
        cost = (len(found.free_symbols), int(sp.count_ops(found)))
        if best is None or cost < best[0]:
            best = cost, sorted(columns)
    if best is None:
        raise ValueError("constraints that depend on one another")
    return best[1]


def _inverse(matrix: sp.Matrix) -> sp.Matrix:
    """By determinants: entries are short."""
    if matrix.rows == 0:
        return matrix
    determinant = brief(matrix.det())
    adjugate = matrix.adjugate().applyfunc(brief)
    return adjugate.applyfunc(lambda e: sp.cancel(e / determinant) if e != 0 else e)


def _rank(matrix: sp.Matrix) -> int:
    """Rank at random values of all symbols."""
    rng = np.random.default_rng(1)
    symbols = sorted(matrix.free_symbols, key=str)
    put = {x: sp.Float(rng.uniform(0.5, 1.5)) for x in symbols}
    found = np.array(matrix.subs(put).tolist(), dtype=float)
    return int(np.linalg.matrix_rank(found, tol=1e-9))
