"""A mode, whose bodies have known positions, and the transitions between modes.

A `Mode` serves one set of closed contacts, or two that are mirror images. From its bodies, springs
and dampers follow its equations of motion.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import NamedTuple, Self

import sympy as sp

from rockeom.numbers.checks import InputError
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import at_side, truncated
from rockeom.symbolic.elements import Spring
from rockeom.symbolic.lagrange import Equations, derive_equations
from rockeom.symbolic.model import Body, Coordinate, Foot


class Switch(NamedTuple):
    """A number in equations that serve several states of an element: 1 in some modes, else 0.

    meaning : in words, when it is 1. on : names of those modes.
    """

    symbol: sp.Symbol
    meaning: str
    on: tuple[str, ...]


@dataclass(frozen=True, repr=False)
class Mode:
    """Bodies, springs and dampers while the same contacts stay closed.

    Parameters
    ----------
    sides : dict of str to int
        Side of each mode that these equations serve. A rocking mode serves two, {"left": -1,
        "right": +1}, written once with `SIDE`, s = sgn(theta).
    coordinates : tuple of Coordinate
        Coordinates free to move; all others stay where they are.
    bodies : tuple of Body
        Rigid bodies with mass.
    gravity : sympy.Expr
        Symbol or value of the acceleration of gravity.
    elastic_energy : sympy.Expr, optional
        Elastic energy besides that of the elements.
    dissipation : sympy.Expr, optional
        Rayleigh's function, half the power lost, besides that of the elements.
    feet : dict of str to Foot, optional
        The "left" and the "right" foot.
    load_point : tuple of (sympy.Expr, sympy.Expr), optional
        Point (x, y) of the load of a pushover.
    small : tuple of sympy.Symbol, optional
        Symbols that are small of first order; energies are then truncated at second order, which
        gives the linearised equations. Impacts keep the exact geometry.
    forces : tuple of sympy.Expr, optional
        Generalised force on each coordinate, in their order, for everything that neither potential
        nor dissipation gives; its virtual work is forces . dq. Empty for none.
    quantities : dict of str to tuple of (str, sympy.Expr), optional
        Further quantities of a response, by name: (unit, value) in "m" or "N". The names are the
        same in each mode.
    beside_feet : tuple of (sympy.Expr, sympy.Expr), optional
        Force (horizontal, vertical) of the ground on the structure elsewhere than at its feet, such
        as that of the columns of a frame next to a wall.
    elements : tuple of Spring, optional
        Springs and dampers by name, see `Spring`; their energies and losses are added to
        elastic_energy and dissipation. The names are the same in each mode.
    switches : tuple of Switch, optional
        Numbers, 1 in some of the modes and 0 in the others, by which the equations serve several
        states of an element.
    """

    sides: dict[str, int]
    coordinates: tuple[Coordinate, ...]
    bodies: tuple[Body, ...]
    gravity: sp.Expr
    elastic_energy: sp.Expr = sp.S.Zero
    dissipation: sp.Expr = sp.S.Zero
    feet: dict[str, Foot] = field(default_factory=dict)
    load_point: tuple[sp.Expr, sp.Expr] | None = None
    small: tuple[sp.Symbol, ...] = ()
    forces: tuple[sp.Expr, ...] = ()
    quantities: Mapping[str, tuple[str, sp.Expr]] = field(default_factory=dict)
    beside_feet: tuple[sp.Expr, sp.Expr] = (sp.S.Zero, sp.S.Zero)
    elements: tuple[Spring, ...] = ()
    switches: tuple[Switch, ...] = ()

    def __post_init__(self) -> None:
        what = f"mode {'/'.join(map(str, self.sides))}"
        object.__setattr__(self, "elements", tuple(self.elements))
        _are_springs(what, self.elements)
        valid.points(what, beside_feet=self.beside_feet)
        valid.texts(what, **{f"mode {c}": c for c in self.sides})
        valid.symbols(what, **{f"small {x}": x for x in self.small})
        valid.expressions(
            what, gravity=self.gravity, elastic_energy=self.elastic_energy,
            dissipation=self.dissipation,
            **{f"force {i}": e for i, e in enumerate(self.forces)},
            **{f"quantity {name!r}": e for name, (_, e) in self.quantities.items()},
        )  # fmt: skip
        if self.load_point is not None:
            valid.points(what, load_point=self.load_point)

    def __repr__(self) -> str:
        moving = ", ".join(c.name for c in self.coordinates) or "nothing"
        return f"<Mode {', '.join(self.sides)}: {moving} moves>"

    @cached_property
    def equations(self) -> Equations:
        """The equations of motion, derived once."""
        return derive_equations(self)

    @cached_property
    def stored_energy(self) -> sp.Expr:
        """Elastic energy of all that is declared."""
        return sum((e.energy() for e in self.elements), sp.sympify(self.elastic_energy))

    @cached_property
    def dissipation_function(self) -> sp.Expr:
        """Rayleigh's, of all that is declared."""
        parts = (e.dissipation(self.coordinates) for e in self.elements)
        return sum(parts, sp.sympify(self.dissipation))

    def approximated(self, expr: sp.Expr) -> sp.Expr:
        """Expression to second order in the small symbols of this mode; else as it is.

        Parameters
        ----------
        expr : sympy.Expr
            Expression.

        Returns
        -------
        sympy.Expr
            Expression.
        """
        return truncated(expr, self.small, 2) if self.small else sp.sympify(expr)

    def quantities_in(self, unit: str) -> dict[str, sp.Expr]:
        """Further quantities that have a unit.

        Parameters
        ----------
        unit : str
            Unit, "m" or "N".

        Returns
        -------
        dict of str to sympy.Expr
            Expressions by name.
        """
        return {name: e for name, (u, e) in self.quantities.items() if u == unit}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the modes that these equations serve."""
        return tuple(self.sides)

    @property
    def has_side(self) -> bool:
        """Whether the equations are written with the side s."""
        return any(self.sides.values())

    def side_of(self, name: str) -> int:
        """Side of one of the modes that these equations serve.

        Parameters
        ----------
        name : str
            Name of the mode.

        Returns
        -------
        int
            -1, 0 or 1.
        """
        return self.sides[name]

    def states_of(self, name: str) -> list[int]:
        """Number of each switch in one of the modes that these equations serve.

        Parameters
        ----------
        name : str
            Name of the mode.

        Returns
        -------
        list of int
            0 or 1 for each switch.
        """
        return [int(name in switch.on) for switch in self.switches]

    def put(self, expr: sp.Expr, name: str) -> sp.Expr:
        """Expression in one of the modes: its side and its switches put in as numbers.

        Parameters
        ----------
        expr : sympy.Expr
            Expression.
        name : str
            Name of the mode.

        Returns
        -------
        sympy.Expr
            Expression.
        """
        return at_side(self._switched(expr, name), self.side_of(name))

    def _switched(self, expr: sp.Expr, name: str) -> sp.Expr:
        states = zip(self.switches, self.states_of(name), strict=True)
        numbers = {switch.symbol: sp.Integer(on) for switch, on in states}
        return sp.sympify(expr).xreplace(numbers)

    def of_each_state(self) -> list[Self]:
        """Equations of motion once for each state of the switches, these put in as numbers.

        Returns
        -------
        list of Mode
            Modes without switches.
        """
        served: dict[tuple[int, ...], dict[str, int]] = {}
        for name, side in self.sides.items():
            served.setdefault(tuple(self.states_of(name)), {})[name] = side
        if len(served) == 1:
            return [self]
        modes = [replace(self, sides=sides, switches=()) for sides in served.values()]
        for mode in modes:
            of = partial(self._switched, name=mode.names[0])
            vars(mode)["equations"] = self.equations.map(of)  # not derived once more
        return modes


def _are_springs(what: str, elements: tuple[Spring, ...]) -> None:
    for e in elements:
        if not isinstance(e, Spring):
            raise InputError("elements", of=what).wrong(
                f"holds {e!r}: give objects of Spring; what switches is declared in a Model"
            )


@dataclass(frozen=True)
class Transition:
    """End of a mode.

    Parameters
    ----------
    source : str
        Name of the mode that ends.
    target : str
        Name of the mode that follows.
    kind : str
        "impact": the gap of `source` closes and velocities jump; "uplift": the acceleration with
        which `target` would open turns positive; "switch": `guard` falls through zero and the state
        stays as it is.
    guard : sympy.Expr, optional
        Guard, positive inside `source`; smooth, or the Max of two that are.
    fallback : str, optional
        Name of the mode after an impact whose target could not open (the old foot does not lift).
    reference : str, optional
        Source of the equations.
    sets : dict of sympy.Symbol to sympy.Expr, optional
        Positions of coordinates that a switch puts to a new value, a function of the state.
    reversible : bool, optional
        Whether the guard of the transition back is zero where this one happens.
    """

    source: str
    target: str
    kind: str
    guard: sp.Expr | None = None
    fallback: str | None = None
    reference: str = ""
    sets: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)
    reversible: bool = True

    def __post_init__(self) -> None:
        what = f"transition {self.source!r} -> {self.target!r}"
        valid.symbols(what, **{f"value set of {x}": x for x in self.sets})
        valid.expressions(what, **{f"value of {x}": e for x, e in self.sets.items()})
        if self.guard is not None:
            valid.expressions(what, guard=self.guard)
