"""`Tie`: a bar, strap, anchor or seam that pulls and does not press, and may yield and break."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import sympy as sp

from rockeom.numbers import explained
from rockeom.numbers.breaks import Break
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.symbolic import valid
from rockeom.symbolic.elements.states import Ending, broken_of, check_element, where_whole
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate, InternalVariable, Point, internal_variable

SLACK, ELASTIC, YIELDS = -1, 0, 1


@explained.record()
@dataclass(frozen=True)
class Tie:
    """Bar, strap, anchor or seam that pulls and does not press, and may yield and break.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    elongation : sympy.Expr
        Elongation w, a function of the coordinates, zero where it is assembled.
    stiffness : sympy.Expr
        Stiffness k [N/m].
    strength : sympy.Expr, optional
        Force at which it first yields [N]; infinity, the default, for one that stays elastic.
    hardening : sympy.Expr, optional
        Force H by which it yields more, a permanent extension [N/m]: the stiffness is k H/(k + H)
        while it flows; 0 for a force that stays.
    slack_length : sympy.Expr, optional
        Elongation at which it begins to pull [m].
    pretension : sympy.Expr, optional
        Force P [N] where the elongation is zero.
    breaks_at : Break, optional
        Limit at which it breaks, for good; None for one that never does.
    place : tuple of (sympy.Expr, sympy.Expr), optional
        Place (x, y) at which it pulls at the structure; a sketch shows it there.
    end : tuple of (sympy.Expr, sympy.Expr), optional
        Its other end (x, y); a sketch draws it from there.

    Raises
    ------
    ValueError
        For anything but expressions, and numbers out of their ranges.

    Notes
    -----
    Its force is T = P + k (w - s - z), s the slack length, and does work -T on the rise of w; it is
    slack where that is negative. z is the permanent extension, a state that the response has as
    `NAME_extension`. It rests, z' = 0, while T - H z is below the strength, and flows at the
    strength, z' = w' k/(k + H), until w turns back. A tie that has broken is slack for good:
    `NAME_broken`, 0 or 1, is a state of the response, and the energy that it held is `NAME_break`.

    Examples
    --------
    >>> import sympy as sp
    >>> from rockeom.symbolic import Break, Tie
    >>> w, k, F_u = sp.symbols("w k F_u")
    >>> strap = Tie("strap", w, k, breaks_at=Break(force=F_u))
    >>> strap.states
    (0, -1)
    """

    name: str
    elongation: sp.Expr
    stiffness: sp.Expr
    strength: sp.Expr = sp.oo
    hardening: sp.Expr = sp.S.Zero
    slack_length: sp.Expr = sp.S.Zero
    pretension: sp.Expr = sp.S.Zero
    breaks_at: Break | None = None
    place: Point | None = None
    end: Point | None = None

    symbol_of_force: ClassVar = "S"
    drawn: ClassVar = "tendon"
    outputs: ClassVar = ("force", "elongation")

    def __post_init__(self) -> None:
        what = f"element {self.name!r}"
        if not isinstance(self.breaks_at, Break | None):
            raise InputTypeError("breaks_at", self.breaks_at, what).give(
                "such as Break(force=F_u), Break(extension=w_u) or Break(energy=E_u)"
            )
        check_element(self, elongation=self.elongation, **self.limits)
        valid.not_negative(what, **self.limits)
        if not self.yields and (self.hardening != 0 or "energy" in self.limits):
            raise InputError("strength", self.strength, what).give(
                "a finite one, at which it yields, with hardening and with an energy at a break"
            )

    # -- what it can do

    @property
    def yields(self) -> bool:
        """Whether it has a strength."""
        return sp.sympify(self.strength) != sp.oo

    @property
    def limits(self) -> dict[str, sp.Expr]:
        """The limit at which it breaks, by its name; empty for one that never does."""
        return {} if self.breaks_at is None else self.breaks_at.limits

    @property
    def states(self) -> tuple[int, ...]:
        """Elastic; yielding; slack."""
        return (ELASTIC, YIELDS, SLACK) if self.yields else (ELASTIC, SLACK)

    @property
    def positive(self) -> frozenset[str]:
        """The `constants` that may not be zero."""
        return frozenset({"stiffness", "strength"} if self.yields else {"stiffness"})

    @cached_property
    def variable(self) -> InternalVariable:
        """The permanent extension."""
        return internal_variable(
            f"z_{self.name}", f"{self.name}_extension", "m", f"permanent extension of {self.name}"
        )

    @cached_property
    def broken(self) -> InternalVariable:
        """1 once it has broken, else 0."""
        return broken_of(self.name)

    @property
    def internal(self) -> tuple[InternalVariable, ...]:
        """Its internal variables: the permanent extension, and whether it has broken."""
        return (
            *((self.variable,) if self.yields else ()),
            *((self.broken,) if self.limits else ()),
        )

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
        every = {
            "stiffness": self.stiffness, "hardening": self.hardening,
            "slack_length": self.slack_length, "pretension": self.pretension,
        }  # fmt: skip
        return every | ({"strength": self.strength} if self.yields else {})

    # -- words

    def word(self, state: int) -> str | None:
        """End of a mode's name for a state, behind the element's; None for no word."""
        return {ELASTIC: None, YIELDS: "_yields", SLACK: "_slack"}[state]

    def meaning(self) -> str:
        """Meaning of chi."""
        flows = ", 1 while it yields" if self.yields else ""
        return f"0 while `{self.name}` is elastic{flows}, -1 while it is slack"

    def description(self) -> str:
        """The force and the ends of a state, in words."""
        driven = "its force"
        if sp.sympify(self.hardening) != 0:
            driven = f"its force less ${sp.latex(self.hardening * self.variable.symbol)}$"
        text = f"`{self.name}` pulls with this force, and carries no compression"
        if self.yields:
            text += (
                f"; it is elastic while {driven} is below ${sp.latex(sp.sympify(self.strength))}$, "
                "and yields then until its elongation turns back"
            )
        for name, limit in self.limits.items():
            of = {"energy": "dissipated energy"}.get(name, name)
            text += f"; it breaks for good where its {of} reaches ${sp.latex(sp.sympify(limit))}$"
        return f"{text}:"

    def ends(self) -> str:
        """The events that end its states, in words."""
        flows = "begins or ceases to yield, " if self.yields else ""
        breaks = ", or breaks" if self.limits else ""
        return f"`{self.name}` {flows}draws tight or slackens{breaks}"

    # -- forces and energies

    @property
    def _permanent(self) -> sp.Expr:
        return self.variable.symbol if self.yields else sp.S.Zero

    @property
    def _elastic(self) -> sp.Expr:
        drawn = self.elongation - self.slack_length - self._permanent
        return self.pretension + self.stiffness * drawn

    def _carries(self, chi: sp.Expr) -> sp.Expr:
        """0 where it is slack, else 1, by chi."""
        return 1 + chi * (1 - chi) / 2 if self.yields else 1 + chi

    def _flows(self, chi: sp.Expr) -> sp.Expr:
        """1 where it flows, by chi."""
        return chi * (chi + 1) / 2 if self.yields else sp.S.Zero

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
        rates: dict[InternalVariable, sp.Expr] = dict.fromkeys(self.internal, sp.S.Zero)
        if self.yields:
            share = sp.sympify(self.stiffness) / (self.stiffness + sp.sympify(self.hardening))
            rates[self.variable] = self._flows(chi) * share * rate(self.elongation, coordinates)
        return rates

    def settled(self, state: int) -> dict[InternalVariable, sp.Expr]:
        """Values of internal variables at the end of a state, free of rounding."""
        if state != YIELDS:
            return {}
        drawn = self.elongation - self.slack_length
        beyond = self.pretension + self.stiffness * drawn - self.strength
        return {self.variable: beyond / (self.stiffness + sp.sympify(self.hardening))}

    def energy(self, chi: sp.Expr) -> sp.Expr:
        """The energy that it stores in the state chi."""
        stored = self._carries(chi) * self._elastic**2 / (2 * self.stiffness)
        hardened = self.hardening * self._permanent**2 / 2
        return stored + (hardened * (1 - self.broken.symbol) if self.limits else hardened)

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost by yielding."""
        if not self.yields:
            return sp.S.Zero
        return chi * self.strength * self.rates(chi, coordinates)[self.variable]

    # -- what ends a state

    def endings(self, coordinates: tuple[Coordinate, ...]) -> Mapping[int, tuple[Ending, ...]]:
        """Endings by a rising elongation, by a falling one, and by the break behind them.

        Each is out of reach where it has broken, but that the slack state stays.
        """
        whole = self._whole
        rows: dict[int, tuple[Ending, ...]]
        if not self.yields:
            rows = {
                ELASTIC: (Ending((whole(self._elastic),), SLACK, 0),),
                SLACK: (Ending((-whole(self._elastic),), ELASTIC, 0),),
            }
        else:
            driven = self._elastic - self.hardening * self._permanent
            turning = rate(self.elongation, coordinates)
            half = sp.sympify(self.strength) / 2  # what flows does not fall so low: it turns first
            rows = {
                ELASTIC: (
                    Ending((self.strength - driven,), YIELDS),
                    Ending((whole(self._elastic),), SLACK, 1),
                ),
                YIELDS: (Ending((turning,), ELASTIC, 0), Ending((whole(driven - half),), ELASTIC)),
                SLACK: (
                    Ending((half - whole(self._elastic),), ELASTIC),
                    Ending((-whole(self._elastic),), ELASTIC, 1),
                ),
            }
        if self.limits:
            rows = {state: (*row, self._break(state)) for state, row in rows.items()}
        return rows

    def _whole(self, guard: sp.Expr) -> sp.Expr:
        """A guard that is positive where the tie pulls; negative where it has broken."""
        return where_whole(guard, self.broken, self._size) if self.limits else guard

    @property
    def _size(self) -> sp.Expr:
        """A force of the size of those at which it breaks."""
        ((name, limit),) = self.limits.items()
        if name == "force":
            return sp.sympify(limit)
        return self.stiffness * limit if name == "extension" else sp.sympify(self.strength)

    def _break(self, state: int) -> Ending:
        """The break of a state; a slack tie does not break."""
        ((name, limit),) = self.limits.items()
        reserve = {
            "force": limit - self._elastic,
            "extension": limit - self.elongation,
            "energy": limit - self.strength * self._permanent,
        }[name]
        if state == SLACK:
            reserve = self._size
        return Ending((reserve,), SLACK, sets=((self.broken, sp.S.One),))
