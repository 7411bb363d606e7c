"""`Pulse`: a force of time, such as a gust, a blast or the blow of a vehicle."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import sympy as sp

from rockeom.numbers import explained
from rockeom.numbers.checks import require_word
from rockeom.symbolic.elements.states import Ending, check_element
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, InternalVariable, Point, internal_variable

OVER, WAITS, ACTS = -1, 0, 1
SHAPES: Mapping[str, Callable[[sp.Expr], sp.Expr]] = {
    "constant": lambda part: sp.S.One,
    "half sine": lambda part: sp.sin(sp.pi * part),
    "falling": lambda part: 1 - part,
    "gust": lambda part: (1 - sp.cos(2 * sp.pi * part)) / 2,
}
"""Force over its largest value, by the part of the duration that has passed."""


@explained.record()
@dataclass(frozen=True)
class Pulse:
    """Force of time along a displacement: it begins, lasts, and is over.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    pushed : sympy.Expr
        Displacement along which it pushes, a function of the coordinates.
    force_peak : sympy.Expr
        Largest force [N].
    start : sympy.Expr
        Time at which it begins [s].
    duration : sympy.Expr
        Duration [s].
    shape : str, optional
        "constant", "half sine", "falling" as of a blast, or "gust", 1 - cos.
    place : tuple of (sympy.Expr, sympy.Expr), optional
        Place (x, y) at which it pushes to the right; a sketch shows it there.

    Raises
    ------
    ValueError
        For anything but expressions, numbers that are not positive, and another shape.

    Notes
    -----
    Its time is a state of the response, `NAME_time`, which begins at zero with a motion and goes on
    with ``initial=run.final``.
    """

    name: str
    pushed: sp.Expr
    force_peak: sp.Expr
    start: sp.Expr
    duration: sp.Expr
    shape: str = "half sine"
    place: Point | None = None

    drawn: ClassVar = "push"
    states: ClassVar = (WAITS, ACTS, OVER)
    symbol_of_force: ClassVar = "S"
    outputs: ClassVar = ("force", "elongation")
    positive: ClassVar = frozenset({"force_peak", "duration"})

    def __post_init__(self) -> None:
        check_element(self, pushed=self.pushed)
        require_word("shape", self.shape, SHAPES, f"element {self.name!r}")

    @cached_property
    def clock(self) -> InternalVariable:
        """Time since the motion began."""
        return internal_variable(f"t_{self.name}", f"{self.name}_time", "s", f"time of {self.name}")

    @property
    def internal(self) -> tuple[InternalVariable, ...]:
        """Its internal variable, the time."""
        return (self.clock,)

    @property
    def displacement(self) -> sp.Expr:
        """The displacement on whose rise the force does negative work."""
        return -self.pushed

    @property
    def output_displacement(self) -> sp.Expr:
        """The displacement that a response has by its name."""
        return self.pushed

    @property
    def constants(self) -> dict[str, sp.Expr]:
        """Its constants by name, which must not be negative."""
        return {"force_peak": self.force_peak, "start": self.start, "duration": self.duration}

    def word(self, state: int) -> str | None:
        """End of a mode's name for a state, behind the element's; None for no word."""
        return {WAITS: None, ACTS: "_acts", OVER: "_over"}[state]

    def meaning(self) -> str:
        """Meaning of chi."""
        return f"0 before `{self.name}`, 1 while it acts, -1 when it is over"

    def description(self) -> str:
        """The force and the ends of a state, in words."""
        return f"`{self.name}` pushes with this force, from its start on and for its duration:"

    def ends(self) -> str:
        """The events that end its states, in words."""
        return f"`{self.name}` begins or is over"

    def still_force(self, chi: sp.Expr) -> sp.Expr:
        """The force where nothing moves."""
        part = (self.clock.symbol - self.start) / self.duration
        return chi * (chi + 1) / 2 * self.force_peak * SHAPES[self.shape](part)

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return self.still_force(chi)

    def rates(
        self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]
    ) -> dict[InternalVariable, sp.Expr]:
        """Rates of its internal variables in the state chi."""
        return {self.clock: sp.S.One}

    def settled(self, state: int) -> dict[InternalVariable, sp.Expr]:
        """Values of internal variables at the end of a state, free of rounding."""
        return {}

    def energy(self, chi: sp.Expr) -> sp.Expr:
        """The energy that it stores in the state chi."""
        return sp.S.Zero

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost: the negative of the work that it does."""
        return -self.still_force(chi) * rate(self.pushed, coordinates)

    def endings(self, coordinates: tuple[Coordinate, ...]) -> Mapping[int, tuple[Ending, ...]]:
        """Its start and its end; it is over where that has passed."""
        begins, ends = self.start, self.start + self.duration
        t = self.clock.symbol
        return {
            WAITS: (Ending((begins - t,), ACTS),),
            ACTS: (Ending((ends - t,), OVER, 0),),
            OVER: (Ending((t - ends,), ACTS, 0),),
        }
