"""How a mode may move: its constraints, the motions they leave, and what slips together."""

from collections.abc import Iterable
from functools import cached_property
from itertools import combinations

import sympy as sp

from rockeom.codes import FRICTIONLESS, SLIP_RIGHT, STICK
from rockeom.symbolic.algebra import brief, determinant, inverted
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.modes.closed import ClosedContacts

SLIP = SLIP_RIGHT
"""In a pattern, which leaves the signs of slips open."""


def sign_of_slip(group: int) -> sp.Symbol:
    """sigma: +1 where the points of a group slip to the right, -1 where they slip to the left."""
    return sp.Symbol(rf"\sigma_{group}" if group else r"\sigma", real=True)


class Kinematics(ClosedContacts):
    """Constraints of the closed points, coordinates that they leave free, and rates of slip."""

    def here(self, expr: sp.Expr) -> sp.Expr:
        """An expression in the closed configuration, the rates those of this mode."""
        return brief(sp.sympify(expr).xreplace(self.velocity).subs(self.place))

    def _rows(self, functions: list[sp.Expr]) -> list[sp.Matrix]:
        return [
            sp.Matrix(1, self.n, [brief(sp.diff(f, x).subs(self.place)) for x in self.q])
            for f in functions
        ]

    @cached_property
    def normal_rows(self) -> dict[int, sp.Matrix]:
        """J_N of each closed point, (1, n)."""
        rows = self._rows([self.gaps[i] for i in self.closed])
        return dict(zip(self.closed, rows, strict=True))

    @cached_property
    def slip_rows(self) -> dict[int, sp.Matrix]:
        """J_T of each closed point, (1, n)."""
        rows = self._rows([self.slips[i] for i in self.closed])
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
        held = [i for i in rough if all(self.same(e) for e in self.slip_rows[i] * left)]
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
                if all(self.same(e) for e in difference):
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

    @cached_property
    def constraints(self) -> tuple[list[int], list[int], sp.Matrix, sp.Matrix]:
        """(dependent, independent, T (n, m), A of all constraints)."""
        rows = [*self.normal_rows.values(), *(self.slip_rows[g[0]] for g in self.sticking)]
        if not rows:
            return [], list(range(self.n)), sp.eye(self.n), sp.zeros(0, self.n)
        matrix = sp.Matrix.vstack(*rows)
        return *self._motions(matrix), matrix

    @property
    def dependent(self) -> list[int]:
        """Places of the coordinates that the closed points determine."""
        return self.constraints[0]

    @property
    def independent(self) -> list[int]:
        """Places of the coordinates that are free to move."""
        return self.constraints[1]

    @property
    def motions(self) -> sp.Matrix:
        """T of q' = T q_I', (n, m)."""
        return self.constraints[2]

    def _motions(self, matrix: sp.Matrix) -> tuple[list[int], list[int], sp.Matrix]:
        """(dependent, independent, T): what A q' = 0 leaves free."""
        dependent = self.eliminated(matrix)
        independent = [j for j in range(self.n) if j not in dependent]
        share = -inverted(matrix[:, dependent]) * matrix[:, independent]
        motions = sp.zeros(self.n, len(independent))
        for k, i in enumerate(independent):
            motions[i, k] = 1
            for row, d in enumerate(dependent):
                motions[d, k] = brief(share[row, k])
        return dependent, independent, motions

    def eliminated(self, matrix: sp.Matrix) -> list[int]:
        """Columns to eliminate: coordinates of known place, and the simplest divisor.

        Raises ValueError where the rows depend on one another.
        """
        used = [j for j in self.order if any(e != 0 for e in matrix[:, j])]
        best: tuple[tuple[int, int, int], list[int]] | None = None
        for columns in combinations(used, matrix.rows):
            divisor = determinant(matrix[:, list(columns)].as_immutable(), brief)
            if self.same(divisor):
                continue
            placed = sum(self.q[j] in self.place or self.q[j] in self.leaning for j in columns)
            moving = len(divisor.free_symbols & set(self.q))
            cost = -placed, moving, int(sp.count_ops(divisor))
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
        functions = [self.gaps[i] for i in self.closed]
        functions += [self.slips[g[0]] for g in self.sticking]
        still = dict.fromkeys(self.qdd, 0)
        coordinates = self.model.coordinates
        bias = [rate(rate(f, coordinates), coordinates).subs(still) for f in functions]
        right = sp.Matrix([-self.here(b) for b in bias])
        matrix = self.constraints[3][:, self.dependent]
        solved = inverted(matrix) * right
        for i, d in enumerate(self.dependent):
            tau[d] = brief(solved[i])
        return tau

    def slip_rate(self, group: tuple[int, ...]) -> sp.Expr:
        """Rate of slip of the points of a group."""
        return self.here((self.slip_rows[group[0]] * sp.Matrix(self.qd))[0])

    def gap(self, point: int) -> sp.Expr:
        """The gap of a point in this mode's configuration."""
        return brief(self.gaps[point].subs(self.place))
