"""The mode that some closed points make, from its kinematics to its impacts."""

from collections.abc import Mapping
from functools import cached_property

import sympy as sp

from rockeom.codes import FRICTIONLESS, OPEN, STICK
from rockeom.symbolic.modes.balance import Balance
from rockeom.symbolic.modes.impact import Impact
from rockeom.symbolic.modes.kinematics import SLIP, Kinematics
from rockeom.symbolic.modes.start import Start, from_rest

VERBS = {STICK: "sticks", SLIP: "slips", FRICTIONLESS: "touches"}
"""Verbs by the state of a closed point in a pattern."""


class DerivedMode(Kinematics):
    """The equations of motion while some points are closed, some of which slip.

    balance : its equations of motion and the forces of its contacts. impact : what an impact leaves
    that ends in it.
    """

    def __repr__(self) -> str:
        points = zip(self.model.contacts, self.states, strict=True)
        words = [f"{c.name} {VERBS[x]}" for c, x in points if x != OPEN]
        return f"<DerivedMode of {self.model.name!r}: {', '.join(words) or 'nothing is closed'}>"

    @cached_property
    def balance(self) -> Balance:
        return Balance(self)

    @cached_property
    def impact(self) -> Impact:
        return Impact(self.balance)

    @property
    def mass_matrix(self) -> sp.Matrix:
        """M of M q_I'' = f, of the coordinates that are free, (m, m)."""
        return self.balance.mass_matrix

    @property
    def forcing(self) -> sp.Matrix:
        """f of M q_I'' = f, (m, 1)."""
        return self.balance.forcing

    @property
    def forces(self) -> tuple[dict[int, sp.Expr], dict[int, sp.Expr]]:
        """Normal forces by point, and friction by the first point of each group."""
        return self.balance.forces

    def from_rest(self, place: Mapping[sp.Symbol, sp.Expr]) -> Start:
        """Its beginning from rest at given positions, in closed form."""
        return from_rest(self.balance, place)
