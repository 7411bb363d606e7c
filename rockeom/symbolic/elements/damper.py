"""`Damper`: a damper of limited stroke, at whose end it breaks."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic.elements.states import Ending, broken_of, check_element, where_whole
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, InternalVariable, Point

GONE, ACTS = -1, 0


@explained.record()
@dataclass(frozen=True)
class Damper:
    """Damper of limited stroke, at whose end it breaks.

    A damper that meets a stop there is a `Spring` with a damping and no stiffness, and a
    `Unilateral` on either side, whose compression is the elongation less the stroke.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    elongation : sympy.Expr
        Elongation w, a function of the coordinates, zero in the middle of its stroke.
    damping : sympy.Expr
        Coefficient c [N s/m].
    stroke : sympy.Expr
        Elongation to either side at which it breaks [m].
    place : tuple of (sympy.Expr, sympy.Expr), optional
        Place (x, y) at which it acts on the structure; a sketch shows it there.
    end : tuple of (sympy.Expr, sympy.Expr), optional
        Its other end (x, y); a sketch draws it from there.

    Raises
    ------
    ValueError
        For anything but expressions, and numbers that are not positive.

    Notes
    -----
    Its force is c w', and none once it has broken: `NAME_broken`, 0 or 1, is a state of the
    response.
    """

    name: str
    elongation: sp.Expr
    damping: sp.Expr
    stroke: sp.Expr
    place: Point | None = None
    end: Point | None = None

    drawn: ClassVar = "damper"
    states: ClassVar = (ACTS, GONE)
    symbol_of_force: ClassVar = "S"
    outputs: ClassVar = ("force", "elongation")
    positive: ClassVar = frozenset({"damping", "stroke"})

    def __post_init__(self) -> None:
        check_element(self, elongation=self.elongation)

    @cached_property
    def broken(self) -> InternalVariable:
        """1 once it has broken, else 0."""
        return broken_of(self.name)

    @property
    def internal(self) -> tuple[InternalVariable, ...]:
        """Its internal variable, whether it has broken."""
        return (self.broken,)

    @property
    def displacement(self) -> sp.Expr:
        """The displacement on whose rise the force does negative work."""
        return self.elongation

    @property
    def output_displacement(self) -> sp.Expr:
        """The displacement that a response has by its name."""
        return self.elongation

    @property
    def constants(self) -> dict[str, sp.Expr]:
        """Its constants by name, which must not be negative."""
        return {"damping": self.damping, "stroke": self.stroke}

    def word(self, state: int) -> str | None:
        """End of a mode's name for a state, behind the element's; None for no word."""
        return "_gone" if state == GONE else None

    def meaning(self) -> str:
        """Meaning of chi."""
        return f"0 while `{self.name}` acts, -1 once it has broken"

    def description(self) -> str:
        """The force and the ends of a state, in words."""
        stroke = sp.latex(sp.sympify(self.stroke))
        return f"`{self.name}` resists with this force; it breaks where it is drawn by ${stroke}$:"

    def ends(self) -> str:
        """The events that end its states, in words."""
        return f"`{self.name}` breaks"

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return (1 + chi) * self.damping * rate(self.elongation, coordinates)

    def still_force(self, chi: sp.Expr) -> sp.Expr:
        """The force where nothing moves."""
        return sp.S.Zero

    def rates(
        self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]
    ) -> dict[InternalVariable, sp.Expr]:
        """Rates of its internal variables in the state chi."""
        return {self.broken: sp.S.Zero}

    def settled(self, state: int) -> dict[InternalVariable, sp.Expr]:
        """Values of internal variables at the end of a state, free of rounding."""
        return {}

    def energy(self, chi: sp.Expr) -> sp.Expr:
        """The energy that it stores in the state chi."""
        return sp.S.Zero

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost."""
        return (1 + chi) * self.damping * rate(self.elongation, coordinates) ** 2

    def endings(self, coordinates: tuple[Coordinate, ...]) -> Mapping[int, tuple[Ending, ...]]:
        """The ends of its stroke to either side."""
        sides = (self.stroke - self.elongation, self.stroke + self.elongation)
        gone = (2 * self.broken.symbol - 1) * self.stroke  # out of reach while it is whole
        breaks = ((self.broken, sp.S.One),)
        whole = (where_whole(e, self.broken, self.stroke) for e in sides)
        return {
            ACTS: tuple(Ending((e,), GONE, sets=breaks) for e in whole),
            GONE: tuple(Ending((gone,), ACTS) for _ in sides),
        }
