"""Newton and Euler's equations of planar rigid bodies in contact, in arithmetic of many digits.

Each body has the coordinates of its centroid and its rotation, and nothing is eliminated: a contact
that sticks is two rows of a constraint, one that slides a row and a force of friction, and the
reactions are unknowns beside the accelerations. At thirty digits the constraints do not drift. The
method is that of Gragg, Bulirsch and Stoer, of order 24. Nothing of this comes from rockeom, which
derives its equations by Lagrange in the fewest coordinates and integrates them by Runge and Kutta.

Rotations are clockwise and positive, x is to the right and z up.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from mpmath import mp, mpf

Numbers = list  # of mpf
COLUMNS = 12  # of the extrapolation: order 24


@dataclass(frozen=True)
class Body:
    """mass [kg], inertia about the centroid [kg m2]; a state has x, z [m] and rotation [rad]."""

    mass: mpf
    inertia: mpf


@dataclass(frozen=True)
class Row:
    """A row of a constraint: coefficients of the accelerations, and the part of the velocities.

    pull : the same as coefficients of the reaction, where friction makes it another than `push`.
    """

    push: Numbers
    bias: mpf
    pull: Numbers | None = None


@dataclass
class State:
    t: mpf
    q: Numbers
    v: Numbers


@dataclass(frozen=True)
class Stage:
    """The equations between two events.

    rows : of the constraints, by the state; loads : generalized forces, by the state.
    """

    bodies: Sequence[Body]
    loads: Callable[[State], Numbers]
    rows: Callable[[State], list[Row]] = field(default=lambda state: [])

    def masses(self) -> Numbers:
        return [m for body in self.bodies for m in (body.mass, body.mass, body.inertia)]

    def accelerations(self, state: State) -> Numbers:
        return self.solved(state)[0]

    def solved(self, state: State) -> tuple[Numbers, Numbers]:
        """Accelerations and reactions: M a = loads + sum(reaction pull), push a + bias = 0."""
        masses, loads, rows = self.masses(), self.loads(state), self.rows(state)
        free = [f / m for f, m in zip(loads, masses, strict=True)]
        moved = [[p / m for p, m in zip(row.pull or row.push, masses, strict=True)] for row in rows]
        matrix = [[mp.fdot(row.push, one) for one in moved] for row in rows]
        reactions = solve(matrix, [-row.bias - mp.fdot(row.push, free) for row in rows])
        for reaction, one in zip(reactions, moved, strict=True):
            free = [a + reaction * b for a, b in zip(free, one, strict=True)]
        return free, reactions


def after_impact(bodies: Sequence[Body], rows: list[Row], v: Numbers) -> Numbers:
    """Velocities after an impact that closes the rows without restitution, by impulses in them."""
    masses = Stage(bodies, lambda state: []).masses()
    moved = [[p / m for p, m in zip(row.push, masses, strict=True)] for row in rows]
    matrix = [[mp.fdot(row.push, one) for one in moved] for row in rows]
    for impulse, one in zip(
        solve(matrix, [-mp.fdot(row.push, v) for row in rows]), moved, strict=True
    ):
        v = [a + impulse * b for a, b in zip(v, one, strict=True)]
    return v


def solve(matrix: list[Numbers], right: Numbers) -> Numbers:
    """Gauss's elimination with pivots."""
    n = len(right)
    a = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    for i in range(n):
        best = max(range(i, n), key=lambda k: abs(a[k][i]))
        a[i], a[best] = a[best], a[i]
        for k in range(i + 1, n):
            factor = a[k][i] / a[i][i]
            a[k] = [x - factor * y for x, y in zip(a[k], a[i], strict=True)]
    x = [mpf(0)] * n
    for i in reversed(range(n)):
        x[i] = (a[i][n] - mp.fdot(a[i][i + 1 : n], x[i + 1 :])) / a[i][i]
    return x


# -- what touches --------------------------------------------------------------------------------


def place(state: State, body: int, point: Numbers) -> tuple[mpf, mpf]:
    """A point of a body, given in its own axes, from its centroid: dx, dz."""
    sine, cosine = mp.sin(state.q[3 * body + 2]), mp.cos(state.q[3 * body + 2])
    x, z = point
    return x * cosine + z * sine, z * cosine - x * sine


def at_ground(state: State, body: int, point: Numbers, friction: mpf | None = None) -> list[Row]:
    """A point that sticks to the ground; or slides to the right on it, with a friction."""
    return between(state, body, point, None, point, friction)


def between(
    state: State, body: int, point: Numbers, other: int | None, at: Numbers,
    friction: mpf | None = None,
) -> list[Row]:  # fmt: skip
    """A point of a body that sticks to a point of another, or to the ground."""
    n = len(state.q)
    across, up, bias_x, bias_z = [mpf(0)] * n, [mpf(0)] * n, mpf(0), mpf(0)
    ends = [(1, body, point)] if other is None else [(1, body, point), (-1, other, at)]
    for sign, of, where in ends:
        dx, dz = place(state, of, where)
        across[3 * of], across[3 * of + 2] = mpf(sign), sign * dz
        up[3 * of + 1], up[3 * of + 2] = mpf(sign), -sign * dx
        square = state.v[3 * of + 2] ** 2
        bias_x -= sign * dx * square
        bias_z -= sign * dz * square
    if friction is None:
        return [Row(across, bias_x), Row(up, bias_z)]
    rubbed = [z - friction * x for x, z in zip(across, up, strict=True)]
    return [Row(up, bias_z, rubbed)]


# -- integration ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Solver:
    """step : the longest [s]; digits : of the error of each step, relative to the state."""

    step: mpf
    digits: int

    def advanced(self, stage: Stage, state: State, h: mpf) -> State:
        """The state after h, by extrapolation of modified midpoints; h is halved where needed."""
        table: list[list[Numbers]] = []
        for k in range(COLUMNS):
            n = 2 * (k + 1)
            row = [_midpoints(stage, state, h, n)]
            for j in range(1, k + 1):
                factor = mpf(1) / ((mpf(n) / (2 * (k - j + 1))) ** 2 - 1)
                row.append(
                    [
                        new + factor * (new - old)
                        for new, old in zip(row[j - 1], table[k - 1][j - 1], strict=True)
                    ]
                )
            table.append(row)
            if k > 3:
                apart = max(
                    abs(x - y) / (1 + abs(x)) for x, y in zip(row[-1], row[-2], strict=True)
                )
                if apart < mpf(10) ** -self.digits:
                    half = len(state.q)
                    return State(state.t + h, row[-1][:half], row[-1][half:])
        middle = self.advanced(stage, state, h / 2)
        return self.advanced(stage, middle, h / 2)

    def until(
        self, stage: Stage, state: State, guards: Sequence[Callable[[State], mpf]], end: mpf
    ) -> tuple[State, int | None]:
        """On to the first guard that falls through zero, or to the end; and which guard it was."""
        while state.t < end:
            h = min(self.step, end - state.t)
            later = self.advanced(stage, state, h)
            falls = [
                (self._root(stage, state, guard, h), i)
                for i, guard in enumerate(guards)
                if guard(later) < 0 <= guard(state)
            ]
            if falls:
                first, which = min(falls)
                return self.advanced(stage, state, first), which
            state = later
        return state, None

    def _root(self, stage: Stage, state: State, guard: Callable[[State], mpf], h: mpf) -> mpf:
        """Where a guard falls within h: bisection to find the neighbourhood, then secants."""
        low, high = h / 2**30, h  # a guard that starts at zero falls later

        def value(x: mpf) -> mpf:
            return guard(self.advanced(stage, state, x))

        for _ in range(4):
            middle = (low + high) / 2
            low, high = (middle, high) if value(middle) >= 0 else (low, middle)
        a, b, at_a, at_b = low, high, value(low), value(high)
        for _ in range(60):
            if at_b == at_a:
                break
            a, b, at_a = b, b - at_b * (b - a) / (at_b - at_a), at_b
            if abs(b - a) < mpf(10) ** (3 - self.digits) * h:
                break
            at_b = value(b)
        return b


def _midpoints(stage: Stage, state: State, h: mpf, n: int) -> Numbers:
    """Gragg's modified midpoints: n steps over h, smoothed."""
    step = h / n

    def rates(t: mpf, y: Numbers) -> Numbers:
        half = len(y) // 2
        now = State(t, y[:half], y[half:])
        return [*now.v, *stage.accelerations(now)]

    before = [*state.q, *state.v]
    now = [y + step * f for y, f in zip(before, rates(state.t, before), strict=True)]
    for i in range(1, n):
        f = rates(state.t + i * step, now)
        before, now = now, [y + 2 * step * r for y, r in zip(before, f, strict=True)]
    f = rates(state.t + h, now)
    return [(a + b + step * r) / 2 for a, b, r in zip(now, before, f, strict=True)]
