"""`Yielding`: a bar that is elastic up to a strength to either side, and then yields."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic.elements.states import Ending, check_element
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, InternalVariable, Point, internal_variable


@explained.record()
@dataclass(frozen=True)
class Yielding:
    """Bar that is elastic up to a strength in tension and compression, and then yields.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    elongation : sympy.Expr
        Elongation w, a function of the coordinates.
    stiffness : sympy.Expr
        Stiffness k [N/m].
    strength : sympy.Expr
        Force at which it first yields [N].
    hardening : sympy.Expr, optional
        Force H by which it yields more, a permanent extension [N/m]: the stiffness is k H/(k + H)
        while it flows (kinematic hardening); 0 for a force that stays, as of a friction slider with
        a stated stiffness.

    Notes
    -----
    Its force is k (w - z), in tension positive, and does work -k (w - z) on the rise of w; z is the
    permanent extension, a state that the response has as `NAME_extension`. It rests, z' = 0, while
    ``|k (w - z) - H z| < strength``, and flows at the strength, z' = w' k/(k + H), until w turns
    back. A state beyond the strength that names no permanent extension is one where it has been
    drawn out. A `Tie` carries no compression.
    """

    name: str
    elongation: sp.Expr
    stiffness: sp.Expr
    strength: sp.Expr
    hardening: sp.Expr = sp.S.Zero

    states: ClassVar = (0, 1, -1)
    """Elastic; flowing as it grows longer; flowing as it grows shorter."""
    symbol_of_force: ClassVar = "S"
    outputs: ClassVar = ("force", "elongation")
    positive: ClassVar = frozenset({"stiffness", "strength"})
    place: ClassVar[Point | None] = None
    """None: a sketch shows members in its place."""
    drawn: ClassVar = ""
    variable: InternalVariable = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        check_element(self, elongation=self.elongation)
        z = internal_variable(
            f"z_{self.name}", f"{self.name}_extension", "m", f"permanent extension of {self.name}"
        )
        object.__setattr__(self, "variable", z)

    @property
    def internal(self) -> tuple[InternalVariable, ...]:
        """Its internal variable, the permanent extension."""
        return (self.variable,)

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
        return {
            "stiffness": self.stiffness, "strength": self.strength, "hardening": self.hardening,
        }  # fmt: skip

    def word(self, state: int) -> str | None:
        """End of a mode's name for a state, behind the element's; None for no word."""
        if state == 0:
            return None
        return "_yields" if state > 0 else "_yields_back"

    def meaning(self) -> str:
        """Meaning of chi."""
        yields = "1 while it yields in tension, -1 while it yields in compression"
        return f"0 while `{self.name}` is elastic, {yields}"

    def description(self) -> str:
        """The force and the ends of a state, in words."""
        range_ = f"below ${sp.latex(sp.sympify(self.strength))}$"
        driven = "its force"
        if sp.sympify(self.hardening) != 0:
            back = sp.latex(self.hardening * self.variable.symbol)
            driven = f"its force less ${back}$"
        return (
            f"`{self.name}` pulls with this force; it is elastic while {driven} is {range_}, and "
            "yields then until its elongation turns back to either side:"
        )

    def ends(self) -> str:
        """The events that end its states, in words."""
        return f"`{self.name}` begins or ceases to yield or yields in compression"

    @property
    def _elastic(self) -> sp.Expr:
        return self.stiffness * (self.elongation - self.variable.symbol)

    def still_force(self, chi: sp.Expr) -> sp.Expr:
        """The force where nothing moves."""
        return self._elastic

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return self.still_force(chi)

    def rates(
        self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]
    ) -> dict[InternalVariable, sp.Expr]:
        """Rates of its internal variables in the state chi."""
        share = sp.sympify(self.stiffness) / (self.stiffness + sp.sympify(self.hardening))
        return {self.variable: chi**2 * share * rate(self.elongation, coordinates)}

    def settled(self, state: int) -> dict[InternalVariable, sp.Expr]:
        """Values of internal variables at the end of a state, free of rounding."""
        if state == 0:
            return {}
        beyond = self.stiffness * self.elongation - state * self.strength
        return {self.variable: beyond / (self.stiffness + sp.sympify(self.hardening))}

    def energy(self, chi: sp.Expr) -> sp.Expr:
        """The energy that it stores in the state chi."""
        z = self.variable.symbol
        return self._elastic**2 / (2 * self.stiffness) + self.hardening * z**2 / 2

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost by yielding."""
        (flow,) = self.rates(chi, coordinates).values()
        return chi * self.strength * flow

    def endings(self, coordinates: tuple[Coordinate, ...]) -> Mapping[int, tuple[Ending, ...]]:
        """The first ends what a rising elongation ends, the second what a falling one does."""
        driven = self._elastic - self.hardening * self.variable.symbol
        turning = rate(self.elongation, coordinates)
        half = sp.sympify(self.strength) / 2  # what flows does not fall so low: it turns first
        reaches, turns = Ending((self.strength - driven,), 1), Ending((turning,), 0, 0)
        return {
            0: (reaches, Ending((self.strength + driven,), -1)),
            1: (turns, Ending((driven - half,), 0)),
            -1: (Ending((-driven - half,), 0), Ending((-turning,), 0, 1)),
        }
