"""Closed contacts: the configuration in which all gaps of a mode are zero."""

from functools import cached_property

import sympy as sp

from rockeom.codes import OPEN
from rockeom.symbolic.algebra import SIDE, angles_in, brief, vanishes
from rockeom.symbolic.contacts import ContactDeclaration


class ClosedContacts:
    """The points that are closed in a mode, and the positions that they fix.

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
        self.gaps = [gap for gap, _ in both]
        self.slips = [slip for _, slip in both]

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
        gaps = [self.gaps[i] for i in self.closed]
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

    def same(self, expr: sp.Expr) -> bool:
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
        for j in self.order:
            slope = sp.diff(expr, self.q[j])
            if slope != 0 and not slope.free_symbols & set(self.q):
                return self.q[j]
        return None

    @property
    def order(self) -> list[int]:
        """Coordinates as they are eliminated, the rotation last."""
        rotation = self.model.coordinates.index(self.model.rotation)
        return [j for j in range(self.n) if j != rotation] + [rotation]
