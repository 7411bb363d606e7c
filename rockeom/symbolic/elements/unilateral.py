"""`Unilateral`: a spring and damper that press and do not pull."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic.elements.states import Ending, check_element
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, InternalVariable, Point


@explained.record()
@dataclass(frozen=True)
class Unilateral:
    """Spring and damper that press, k d + c d', while d and that sum are positive.

    It closes where both have become positive, and opens where the sum falls to zero: it never
    presses above its ground, however fast the structure comes down.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    compression : sympy.Expr
        Compression d, a function of the coordinates; the force does work -(k d + c d') on its rise.
    stiffness : sympy.Expr
        Stiffness k [N/m].
    damping : sympy.Expr, optional
        Coefficient c [N s/m].
    place : tuple of (sympy.Expr, sympy.Expr), optional
        Place (x, y) at which it presses on the structure; a sketch shows it there, above the
        ground.
    """

    name: str
    compression: sp.Expr
    stiffness: sp.Expr
    damping: sp.Expr = sp.S.Zero
    place: Point | None = None

    states: ClassVar = (1, 0)
    symbol_of_force: ClassVar = "N"
    outputs: ClassVar = ("reaction", "uplift")
    """Names in a response of its force, and of its displacement with the other sign."""
    positive: ClassVar = frozenset[str]()
    """The `constants` that may not be zero."""
    internal: ClassVar[tuple[InternalVariable, ...]] = ()

    def __post_init__(self) -> None:
        check_element(self, compression=self.compression)

    @property
    def drawn(self) -> str:
        """Kind of its place, which a sketch shows."""
        return "spring_and_damper" if self.damping != 0 else "spring"

    @property
    def displacement(self) -> sp.Expr:
        """The displacement on whose rise the force does work, the negative of both."""
        return self.compression

    @property
    def output_displacement(self) -> sp.Expr:
        """The second of `outputs`."""
        return -self.compression

    @property
    def constants(self) -> dict[str, sp.Expr]:
        """Its constants by name, which must not be negative."""
        return {"stiffness": self.stiffness, "damping": self.damping}

    def word(self, state: int) -> str | None:
        """End of a mode's name for a state, behind the element's; None for no word."""
        return "" if state else None

    def meaning(self) -> str:
        """Meaning of chi."""
        return f"1 while `{self.name}` presses, else 0"

    def description(self) -> str:
        """The force and the ends of a state, in words."""
        return f"`{self.name}` presses with this force, while it and the compression are positive:"

    def ends(self) -> str:
        """The events that end its states, in words."""
        return f"`{self.name}` begins or ceases to press"

    def _press(self, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        return self.stiffness * self.compression + self.damping * rate(
            self.compression, coordinates
        )

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return chi * self._press(coordinates)

    def still_force(self, chi: sp.Expr) -> sp.Expr:
        """The force where nothing moves."""
        return chi * self.stiffness * self.compression

    def rates(
        self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]
    ) -> dict[InternalVariable, sp.Expr]:
        """Rates of its internal variables in the state chi."""
        return {}

    def settled(self, state: int) -> dict[InternalVariable, sp.Expr]:
        """Values of internal variables at the end of a state, free of rounding."""
        return {}

    def energy(self, chi: sp.Expr) -> sp.Expr:
        """The energy that it stores in the state chi."""
        return chi * self.stiffness * self.compression**2 / 2

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost."""
        return chi * self.damping * rate(self.compression, coordinates) ** 2

    def endings(self, coordinates: tuple[Coordinate, ...]) -> Mapping[int, tuple[Ending, ...]]:
        """Endings of each state; all states have as many."""
        press = self._press(coordinates)
        return {
            1: (Ending((press,), 0, 0),),
            0: (Ending((-self.stiffness * self.compression, -press), 1, 0),),
        }
