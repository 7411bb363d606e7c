"""Impacts that end in a mode: the rates after them, and the impulses of its contacts."""

from collections.abc import Mapping
from functools import cached_property

import sympy as sp

from rockeom.symbolic.algebra import brief, inverted, together
from rockeom.symbolic.modes.balance import Balance
from rockeom.symbolic.modes.start import Start


class Impact:
    """Rebound and impulses in the motions that a mode's contacts leave it.

    balance : of its forces; of, how it may move.
    """

    def __init__(self, balance: Balance) -> None:
        self.balance, self.of = balance, balance.of

    @cached_property
    def rebound(self) -> sp.Matrix:
        """u of q'+ = T q_I'+ + u, (n, n), times q'-: each closed gap opens e times as it closed.

        Only gaps that were closing rebound; of others the rate was zero.
        """
        opened = sp.zeros(self.of.n, self.of.n)
        if not self.of.dependent:
            return opened
        rows = [
            -sp.sympify(self.of.model.contacts[i].law.restitution) * row
            for i, row in self.of.normal_rows.items()
        ]
        rows += [sp.zeros(1, self.of.n) for _ in self.of.sticking]
        matrix = self.of.constraints[3][:, self.of.dependent]
        solved = (inverted(matrix) * sp.Matrix.vstack(*rows)).applyfunc(brief)
        for k, d in enumerate(self.of.dependent):
            opened[d, :] = solved[k, :]
        return opened

    @cached_property
    def kept_momentum(self) -> sp.Matrix:
        """K of L^T M T q_I'+ = K q'-, (m, n): what impulses at its points leave as it is.

        They press as the points are closed and slip as they slip AFTER the impact, all at once.
        """
        lost = sp.eye(self.of.n) - self.rebound
        return (self.balance.balances.T * self.balance.free[0] * lost).applyfunc(brief)

    def landing(
        self, before: Mapping[sp.Symbol, sp.Expr], place: Mapping[sp.Symbol, sp.Expr]
    ) -> Start:
        """Rates after an impact that ends in this mode, and the impulses of contact.

        before : rates by their symbols, those not named zero. It is what follows where no normal
        impulse pulls, friction stays within its cone, slips have their signs and gaps open.
        """
        put = {x: sp.sympify(before.get(x, 0)) for x in self.of.qd}
        old = sp.Matrix([put[x] for x in self.of.qd])

        def here(m: sp.Matrix) -> sp.Matrix:
            return m.applyfunc(lambda e: brief(e.subs(place)))

        free = here(self.kept_momentum) * old
        matrix = here(self.balance.mass_matrix)
        new = here(self.rebound) * old
        if matrix.rows:
            new += here(self.of.motions) * inverted(matrix) * free
        pushes = here(self.balance.free[0]) * (new - old)
        impulses = sp.zeros(0, 1)
        if self.of.dependent:
            inverse = inverted(here(self.balance.pushes[self.of.dependent, :]))
            impulses = inverse * pushes.extract(self.of.dependent, [0])
        normal = dict(zip(self.of.closed, map(together, impulses), strict=False))
        stuck = [together(e) for e in impulses[len(self.of.closed) :]]
        friction = {g[0]: e for g, e in zip(self.of.sticking, stuck, strict=True)}
        for group in self.of.slipping:
            total = sum(self.of.friction(i) * normal[i] for i in group)
            friction[group[0]] = -self.of.sigma(group[0]) * total
        rates = dict(zip(self.of.qd, map(together, new), strict=True))
        return Start(rates, normal, friction)
