"""The hybrid model: modes with equations and outputs, and the transitions between them.

Every declaration lowers to it. Modes and transitions are declared (`modes`, `transitions`), or
derived from contacts and found by a search (`search`). The checks of what follows, the page and
the generated code are written from it alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Protocol

import sympy as sp

from rockeom.numbers.mode_codes import ModeNames
from rockeom.symbolic import model
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.elements import switch_of
from rockeom.symbolic.fractions import cancelled
from rockeom.symbolic.impulse import ImpulseMap, OnSide, derive_impulse_map, rigid_velocity_ratio
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.modes.every import Modes, derive_modes

SOURCED = ("energy_ratio", "impact", "horizontal_reaction", "vertical_reaction")
"""Equations besides those of motion that may have a source of their own."""


@dataclass(frozen=True)
class Search:
    """Contacts and elements whose modes are derived; an event leads to the mode that fits.

    A mode fits where no force or impulse pulls, and friction is within its bound.
    """

    of: ContactDeclaration

    @property
    def names(self) -> Sequence[str]:
        """Names of all modes, in the order of their numbers."""
        if self.of.by_code:
            return ModeNames([c.name for c in self.of.contacts])
        return self.modes.names

    @cached_property
    def modes(self) -> Modes:
        """All modes, derived once.

        Raises ValueError where statics leaves open how closed points share their forces, and where
        there are too many modes.
        """
        return derive_modes(self.of)


class Lowers(Protocol):
    """A declaration, which lowers to a hybrid model; or that model."""

    @property
    def hybrid(self) -> HybridModel:
        """The model that is generated and simulated."""


@dataclass(frozen=True, repr=False)
class HybridModel:
    """Structure: parameters, coordinates, modes and the transitions between them.

    Parameters
    ----------
    name : str
        Name of the model, in small letters, which its generated module has.
    title : str
        Title, in words.
    parameters : tuple of Parameter
        Constants of the model, made by `parameter`.
    coordinates : tuple of Coordinate
        Generalised coordinates, made by `coordinate`.
    modes : tuple of Mode
        Declared modes; of a search, the structure without contacts.
    transitions : tuple of Transition
        Transitions between the modes.
    rotation : Coordinate
        Coordinate that overturns.
    overturning : sympy.Expr, optional
        Size of the rotation at which the structure has overturned.
    definitions : tuple of Definition, optional
        Symbols that stand for expressions of the parameters.
    rigid_velocity_ratio : sympy.Expr, optional
        Ratio of the angular velocities at an impact of the rigid structure; derived if not given.
    reference : str, optional
        Source of the equations.
    functions : tuple of NamedFunction, optional
        Named functions in the equations.
    members : tuple of Member, optional
        Lines of a sketch between bodies.
    falls : dict of Coordinate to sympy.Expr, optional
        Further coordinates, each with the size at which the structure has overturned, as it has
        where the rotation reaches `overturning`.
    sources : dict of str to str, optional
        Sources of single equations, such as "thesis 2-9": of an equation of motion under the name
        of its coordinate, of others under "energy_ratio", "impact" and the names of reactions.
    """

    name: str
    title: str
    parameters: tuple[model.Parameter, ...]
    coordinates: tuple[model.Coordinate, ...]
    modes: tuple[Mode, ...]
    transitions: tuple[Transition, ...]
    rotation: model.Coordinate
    overturning: sp.Expr = sp.pi / 2
    definitions: tuple[model.Definition, ...] = ()
    rigid_velocity_ratio: sp.Expr | None = None
    reference: str = ""
    functions: tuple[model.NamedFunction, ...] = ()
    members: tuple[model.Member, ...] = ()
    falls: Mapping[model.Coordinate, sp.Expr] = field(default_factory=dict, hash=False)
    sources: Mapping[str, str] = field(default_factory=dict, hash=False)
    search: Search | None = None

    @property
    def hybrid(self) -> HybridModel:
        """Itself; that of a declaration which lowers to it."""
        return self

    def __repr__(self) -> str:
        moving = ", ".join(c.name for c in self.coordinates)
        return f"<{type(self).__name__} {self.name!r} of {moving}>"

    # -- names and states ----------------------------------------------------------------------

    @property
    def mode_names(self) -> Sequence[str]:
        """Names of all modes, in the order in which generated code numbers them."""
        if self.search is not None:
            return self.search.names
        names = [name for mode in self.modes for name in mode.names]
        return tuple(sorted(names, key=lambda n: ("left" not in n, "both" not in n, n)))

    @property
    def is_by_code(self) -> bool:
        """Whether the number of a mode has a digit for each point, and modes are not listed."""
        return self.search is not None and self.search.of.by_code

    @property
    def internal(self) -> Mapping[model.InternalVariable, sp.Expr]:
        """Internal variables with their rates."""
        return {} if self.search is None else self.search.of.internal

    @property
    def integrated(self) -> tuple[model.Coordinate, ...]:
        """The coordinates, and the integral of each internal variable behind them."""
        return self.coordinates + (() if self.search is None else self.search.of.integrals)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states: the coordinates, then their rates."""
        if self.search is not None:
            return self.search.of.states
        names = [c.name for c in self.coordinates]
        return (*names, *(f"{n}_dot" for n in names))

    @property
    def switches(self) -> tuple[sp.Symbol, ...]:
        """The symbols of states of elements."""
        if self.search is None:
            return tuple(switch.symbol for switch in self.modes[0].switches)
        return tuple(switch_of(i) for i in range(len(self.search.of.switching)))

    @property
    def shaking(self) -> tuple[sp.Symbol, ...]:
        """Accelerations of the ground, horizontal ones first: two in the plane, three in space."""
        return model.shaking(self.bodies if self.modes else ())

    @property
    def bodies(self) -> tuple[model.Body, ...]:
        """The same in all modes but for where they are."""
        return self.modes[0].bodies

    # -- expressions ---------------------------------------------------------------------------

    @property
    def constants(self) -> dict[sp.Symbol, sp.Expr]:
        """Derived constants, each in terms of the parameters."""
        return {d.symbol: d.value for d in self.definitions}

    def written_out(self, expr: sp.Expr) -> sp.Expr:
        """Expression with all named functions and their derivatives in place of their names.

        Parameters
        ----------
        expr : sympy.Expr
            Expression.

        Returns
        -------
        sympy.Expr
            Expression in states and parameters.
        """
        return _written_out(self.functions, sp.sympify(expr))

    def in_mode(self, expr: sp.Expr, name: str) -> sp.Expr:
        """Expression written out for a mode, its side and its switches put in as numbers.

        Parameters
        ----------
        expr : sympy.Expr
            Expression.
        name : str
            Name of the mode.

        Returns
        -------
        sympy.Expr
            Expression in states and parameters.
        """
        return self.mode(name).put(self.written_out(expr), name)

    # -- equations -----------------------------------------------------------------------------

    def mode(self, name: str) -> Mode:
        """Declared mode of a name, such as "left", "both" or "right".

        Parameters
        ----------
        name : str
            Name of the mode.

        Returns
        -------
        Mode
            Mode.

        Raises
        ------
        KeyError
            If there is none of that name; the message names all modes.
        """
        for mode in self.modes:
            if name in mode.sides:
                return mode
        raise KeyError(f"{self.name} has no mode {name!r}; it has {', '.join(self.mode_names)}")

    def equations(self, name: str) -> Equations:
        """Equations of motion of a mode, its side and its switches put in as numbers.

        Parameters
        ----------
        name : str
            Name of the mode.

        Returns
        -------
        Equations
            Mass matrix, forces and other parts of the equations.

        Raises
        ------
        KeyError
            If there is no mode of that name.
        """
        mode = self.mode(name)
        whole = not mode.has_side and not mode.switches
        return mode.equations if whole else mode.equations.map(lambda e: mode.put(e, name))

    @property
    def has_impacts(self) -> bool:
        """Whether an impact ends any declared mode."""
        return any(t.kind == "impact" for t in self.transitions)

    def impulse_map(self, source: str, target: str) -> ImpulseMap:
        """Velocities after the sudden change from one mode to another.

        Parameters
        ----------
        source : str
            Name of the mode before.
        target : str
            Name of the mode after.

        Returns
        -------
        ImpulseMap
            Velocities after as functions of the state before.

        Raises
        ------
        KeyError
            If there is no mode of one of the names.
        """
        return self.sided_impulse_map(source, target).at_side(self.mode(source).side_of(source))

    def sided_impulse_map(self, source: str, target: str) -> ImpulseMap:
        """Same as `impulse_map`, one form for both sides, with the side s of the mode before.

        Parameters
        ----------
        source : str
            Name of the mode before.
        target : str
            Name of the mode after.

        Returns
        -------
        ImpulseMap
            Velocities after as functions of the state before and of s.

        Raises
        ------
        KeyError
            If there is no mode of one of the names.
        """
        if (source, target) not in self._impulse_maps:
            before, after = (
                OnSide(self.mode(x), self.mode(x).side_of(x)) for x in (source, target)
            )
            self._impulse_maps[source, target] = derive_impulse_map(
                before, after, self.rotation, self.written_out
            )
        return self._impulse_maps[source, target]

    @cached_property
    def _impulse_maps(self) -> dict[tuple[str, str], ImpulseMap]:
        """The impulse maps that have been derived."""
        return {}

    @cached_property
    def velocity_ratio(self) -> sp.Expr | None:
        """Ratio of angular velocities at an impact of the rigid structure.

        None without impacts, NaN where a rigid body's centroid is nearer to one foot: each foot has
        its own ratio there, and the impulse maps give both.
        """
        if self.rigid_velocity_ratio is not None:
            return self.rigid_velocity_ratio
        impacts = [t for t in self.transitions if t.kind == "impact"]
        if not impacts:
            return None
        ratio = self.velocity_ratio_at(impacts[0])
        if len(self.coordinates) > 1:  # checks refuse different ratios
            return ratio
        others = (self.velocity_ratio_at(t) for t in impacts[1:])
        return ratio if all(cancelled(other - ratio) == 0 for other in others) else sp.nan

    def velocity_ratio_at(self, impact: Transition) -> sp.Expr:
        """Ratio of angular velocities, derived for one impact.

        Parameters
        ----------
        impact : Transition
            Transition with an impact.

        Returns
        -------
        sympy.Expr
            Ratio.
        """
        return rigid_velocity_ratio(
            self.sided_impulse_map(impact.source, impact.target),
            self.coordinates,
            self.rotation,
            self.mode(impact.source).side_of(impact.source),
        )


@lru_cache(maxsize=4096)  # the same guards and energies are needed in many modes
def _written_out(functions: tuple[model.NamedFunction, ...], expr: sp.Expr) -> sp.Expr:
    for function in reversed(functions):
        if function.symbol.is_Symbol:
            expr = expr.xreplace({function.symbol: function.value})
            continue
        (of,) = function.symbol.args
        calls = expr.atoms(function.symbol.func)
        if not calls:
            continue
        rates = [d for d in expr.atoms(sp.Derivative) if d.expr == function.symbol]
        put = {d: sp.diff(function.value, *d.variables) for d in rates}
        for at in calls:
            put[at] = function.value.subs(of, at.args[0])
        expr = expr.xreplace(put)
    return expr.doit() if expr.has(sp.Subs) else expr
