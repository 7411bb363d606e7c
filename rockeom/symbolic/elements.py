"""Elements that carry forces, by name: springs and dampers, and what switches between states.

A state of an element is a number, its chi, with which its force, the rate of its internal variable
and its energy are written once for all. An ending ends a state: its guard falls through zero. A
`Spring` has one state, and its chi has no meaning. Elements add forces to a mode, and change
none of its constraints.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, NamedTuple, Self

import sympy as sp

from rockeom.numbers import explained
from rockeom.numbers.checks import require
from rockeom.symbolic import valid
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, InternalVariable, Point, internal_variable


def switch_of(element: int) -> sp.Symbol:
    """chi: the state of an element, a number."""
    return sp.Symbol(rf"\chi_{element}", real=True)


class Ending(NamedTuple):
    """End of a state of an element.

    Parameters
    ----------
    guard : tuple of sympy.Expr
        Guards, positive inside the state; of two, the larger counts.
    target : int
        Number of the state that follows.
    back : int, optional
        Number of the target's ending whose guard is zero then, if any.
    """

    guard: tuple[sp.Expr, ...]
    target: int
    back: int | None = None


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
        what = f"element {self.name!r}"
        valid.texts(what, name=self.name)
        if self.place is not None:
            valid.points(what, place=self.place)
        valid.expressions(
            what, compression=self.compression, stiffness=self.stiffness, damping=self.damping
        )
        valid.not_negative(what, stiffness=self.stiffness, damping=self.damping)

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


@explained.record()
@dataclass(frozen=True)
class Yielding:
    """Bar or tendon that is elastic up to a strength, and then yields.

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
        while it flows; 0 for a force that stays.
    slack : bool, optional
        Whether it carries no compression, and is slack where w < z; else it yields in compression,
        too (kinematic hardening).

    Notes
    -----
    Its force is k (w - z), in tension positive, and does work -k (w - z) on the rise of w; z is the
    permanent extension, a state that the response has as `NAME_extension`. It rests, z' = 0, while
    ``|k (w - z) - H z| < strength``, and flows at the strength, z' = w' k/(k + H), until w turns
    back. A state beyond the strength that names no permanent extension is one where it has been
    drawn out.
    """

    name: str
    elongation: sp.Expr
    stiffness: sp.Expr
    strength: sp.Expr
    hardening: sp.Expr = sp.S.Zero
    slack: bool = False
    initial_force: sp.Expr = sp.S.Zero

    states: ClassVar = (0, 1, -1)
    """Elastic; flowing as it grows longer; flowing as it grows shorter, or slack."""
    symbol_of_force: ClassVar = "S"
    outputs: ClassVar = ("force", "elongation")
    positive: ClassVar = frozenset({"stiffness", "strength"})
    place: ClassVar[Point | None] = None
    """None: a sketch shows members in its place."""
    variable: InternalVariable = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        what = f"element {self.name!r}"
        valid.texts(what, name=self.name)
        valid.expressions(
            what, elongation=self.elongation, initial_force=self.initial_force, **self.constants
        )
        valid.not_negative(what, **self.constants)
        for item in sorted(self.positive):
            if sp.sympify(getattr(self, item)).is_zero:
                raise ValueError(
                    f"{what}: its {item} is zero: give a positive one, or leave it out"
                )
        require(isinstance(self.slack, bool), what, "slack", self.slack, "give True or False")
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
        back = "_slack" if self.slack else "_yields_back"
        return "_yields" if state > 0 else back

    def meaning(self) -> str:
        """Meaning of chi."""
        back = "is slack" if self.slack else "yields in compression"
        return f"0 while `{self.name}` is elastic, 1 while it yields in tension, -1 while it {back}"

    def description(self) -> str:
        """The force and the ends of a state, in words."""
        range_ = f"below ${sp.latex(sp.sympify(self.strength))}$"
        driven = "its force"
        if sp.sympify(self.hardening) != 0:
            back = sp.latex(self.hardening * self.variable.symbol)
            driven = f"its force less ${back}$"
        back = ", and carries no compression" if self.slack else " to either side"
        return (
            f"`{self.name}` pulls with this force; it is elastic while {driven} is {range_}, and "
            f"yields then until its elongation turns back{back}:"
        )

    def ends(self) -> str:
        """The events that end its states, in words."""
        back = "or slackens" if self.slack else "or yields in compression"
        return f"`{self.name}` begins or ceases to yield {back}"

    @property
    def _elastic(self) -> sp.Expr:
        return self.initial_force + self.stiffness * (self.elongation - self.variable.symbol)

    def _carries(self, chi: sp.Expr) -> sp.Expr:
        """0 where it is slack, else 1, by chi."""
        return 1 + chi * (1 - chi) / 2 if self.slack else sp.S.One

    def _flows(self, chi: sp.Expr) -> sp.Expr:
        """1 where it flows, by chi."""
        return chi * (chi + 1) / 2 if self.slack else chi**2

    def still_force(self, chi: sp.Expr) -> sp.Expr:
        """The force where nothing moves."""
        return self._carries(chi) * self._elastic

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return self.still_force(chi)

    def rates(
        self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]
    ) -> dict[InternalVariable, sp.Expr]:
        """Rates of its internal variables in the state chi."""
        share = sp.sympify(self.stiffness) / (self.stiffness + sp.sympify(self.hardening))
        return {self.variable: self._flows(chi) * share * rate(self.elongation, coordinates)}

    def settled(self, state: int) -> dict[InternalVariable, sp.Expr]:
        """Values of internal variables at the end of a state, free of rounding."""
        if state == 0 or (state < 0 and self.slack):
            return {}
        beyond = self.initial_force + self.stiffness * self.elongation - state * self.strength
        return {self.variable: beyond / (self.stiffness + sp.sympify(self.hardening))}

    def energy(self, chi: sp.Expr) -> sp.Expr:
        """The energy that it stores in the state chi."""
        z = self.variable.symbol
        stored = self._elastic**2 / (2 * self.stiffness)
        return self._carries(chi) * stored + self.hardening * z**2 / 2

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
        if self.slack:
            return {
                0: (reaches, Ending((self._elastic,), -1, 1)),
                1: (turns, Ending((driven - half,), 0)),
                -1: (Ending((half - self._elastic,), 0), Ending((-self._elastic,), 0, 1)),
            }
        return {
            0: (reaches, Ending((self.strength + driven,), -1)),
            1: (turns, Ending((driven - half,), 0)),
            -1: (Ending((-driven - half,), 0), Ending((-turning,), 0, 1)),
        }


@explained.record()
@dataclass(frozen=True)
class Spring:
    """Spring and damper that always act: a storey's columns, a bearing, a tendon that is tight.

    The force is P + k d + c d', positive where it resists that the deformation d grows. The elastic
    energy and the dissipation of the structure follow from it, and a response has it by name:
    NAME_deformation, NAME_force, NAME_energy and NAME_loss.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    deformation : sympy.Expr
        Deformation d, a function of the coordinates, on whose rise the force does work -(P + k d +
        c d').
    stiffness : sympy.Expr, optional
        Stiffness k [N/m].
    damping : sympy.Expr, optional
        Coefficient c [N s/m].
    initial_force : sympy.Expr, optional
        Force P [N], of either sign, where d is zero. Its energy is the one that it gives back when
        it is let loose.
    mirrored : str, optional
        Name where s = -1 in a mode that is written with the side s, if not the same.

    Raises
    ------
    ValueError
        For anything but expressions, and for a negative stiffness or damping.

    Examples
    --------
    >>> import sympy as sp
    >>> from rockeom.symbolic import Spring
    >>> u_1, u_2, k_2, c_2 = sp.symbols("u_1 u_2 k_2 c_2")
    >>> storey = Spring("storey_2", u_2 - u_1, stiffness=k_2, damping=c_2)
    """

    name: str
    deformation: sp.Expr
    stiffness: sp.Expr = sp.S.Zero
    damping: sp.Expr = sp.S.Zero
    initial_force: sp.Expr = sp.S.Zero
    mirrored: str = ""

    positive: ClassVar = frozenset[str]()

    def __post_init__(self) -> None:
        what = f"element {self.name!r}"
        valid.texts(what, name=self.name, mirrored=self.mirrored)
        valid.expressions(
            what, deformation=self.deformation, initial_force=self.initial_force, **self.constants
        )
        valid.not_negative(what, **self.constants)

    @property
    def constants(self) -> dict[str, sp.Expr]:
        """Its constants by name, which must not be negative."""
        return {"stiffness": self.stiffness, "damping": self.damping}

    @property
    def displacement(self) -> sp.Expr:
        """The displacement on whose rise the force does negative work."""
        return self.deformation

    @property
    def output_displacement(self) -> sp.Expr:
        """The displacement that a response has by its name."""
        return self.deformation

    def called(self, side: int) -> str:
        """Its name on a side, -1, 0 or 1."""
        return self.mirrored or self.name if side < 0 else self.name

    def changed(self, change: Callable[[sp.Expr], sp.Expr]) -> Self:
        """It in other coordinates."""
        return replace(self, deformation=change(sp.sympify(self.deformation)))

    def still_force(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        """The force where nothing moves."""
        return self.initial_force + self.stiffness * self.deformation

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return self.still_force(chi) + self.damping * rate(self.deformation, coordinates)

    def energy(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        """The energy that it stores in the state chi."""
        if self.initial_force == 0:
            return self.stiffness * sp.sympify(self.deformation) ** 2 / 2
        if self.stiffness == 0:
            return self.initial_force * self.deformation
        return self.still_force(chi) ** 2 / (2 * self.stiffness)

    def dissipation(self, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Its part of Rayleigh's function, half the power lost in its damper."""
        return self.damping * rate(self.deformation, coordinates) ** 2 / 2

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost."""
        return 2 * self.dissipation(coordinates)


Switching = Unilateral | Yielding
Element = Spring | Switching
