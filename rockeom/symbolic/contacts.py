"""A structure whose contacts are declared: its modes are derived, see `rockeom.symbolic.modes`.

Bodies have positions in the coordinates of the FREE structure. A contact is a point with a gap and
a slip, functions of the coordinates, and a law; an element carries a force. Nothing is said of
modes or of what leads from one to another.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import sympy as sp

from rockeom.symbolic import former, valid
from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.elements import (
    Element,
    Passage,
    Spring,
    Switching,
    Unilateral as Unilateral,
    switch_of,
)
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    Definition,
    InternalVariable,
    Mechanism,
    Member,
    NamedFunction,
    Parameter,
    Point,
    RockingModel,
)

if TYPE_CHECKING:
    from rockeom.symbolic.modes import DerivedMechanism, Modes


@dataclass(frozen=True)
class Rigid:
    """A rigid contact: it opens, sticks or slips.

    restitution : Newton's, the ratio of the rates of the gap after and before an impact, 0 to 1.
    friction : Coulomb's, the largest ratio of friction and normal force; None: it never slips;
        the number 0: a smooth contact, which is open or closed and never sticks.
    """

    restitution: sp.Expr = sp.S.Zero
    friction: sp.Expr | None = None

    def __post_init__(self) -> None:
        friction = 0 if self.friction is None else self.friction
        valid.expressions("law Rigid", restitution=self.restitution, friction=friction)
        valid.not_negative("law Rigid", restitution=self.restitution, friction=friction)
        if (1 - sp.sympify(self.restitution)).is_negative:
            raise ValueError(
                f"law Rigid: restitution is {self.restitution}: give the ratio of rates after and "
                "before an impact, 0 to 1"
            )

    @property
    def frictionless(self) -> bool:
        """Whether friction is 0 whatever the parameters are."""
        return self.friction is not None and bool(sp.sympify(self.friction).is_zero)


@dataclass(frozen=True)
class Pinned(Rigid):
    """The law of a pair of feet that open, and neither slip nor bounce, whatever happens.

    A model on them is a rocking structure: the place of its base is no state, contact states are
    "left", "both" and "right", and laws of impact are those by a ratio of rates, such as
    `AngularMomentum`. See `Model.reduced`.
    """

    restitution: sp.Expr = field(default=sp.S.Zero, init=False, repr=False)
    friction: sp.Expr | None = field(default=None, init=False, repr=False)


@dataclass(frozen=True)
class Contact:
    """A point that may touch.

    gap : its distance, not negative. slip : its tangential place, which grows to the right.
    side : of a point of a mirrored pair, whose gap and slip contain s: -1 or 1; else 0.
    place : where it is, (x, y), beside the ground at rest; (slip, gap) if not given, as of a point
    above level ground. Sketches show it there.
    """

    name: str
    gap: sp.Expr
    slip: sp.Expr
    law: Rigid
    side: int = 0
    place: Point | None = None

    def __post_init__(self) -> None:
        what = f"contact {self.name!r}"
        valid.texts(what, name=self.name)
        valid.expressions(what, gap=self.gap, slip=self.slip)
        if self.place is not None:
            valid.points(what, place=self.place)
        if not isinstance(self.law, Rigid):
            raise ValueError(
                f"{what}: its law is {self.law!r}: give Rigid(restitution, friction) or Pinned(), "
                "both of rockeom.symbolic"
            )

    def at(self, side: sp.Expr | int) -> tuple[sp.Expr, sp.Expr]:
        """(gap, slip), the side put in."""
        return at_side(self.gap, side), at_side(self.slip, side)

    @property
    def point(self) -> Point:
        """Where it is."""
        x, y = (self.slip, self.gap) if self.place is None else self.place
        return at_side(x, self.side), at_side(y, self.side)


@dataclass(frozen=True)
class Force:
    """A force that always acts, along a displacement: its work is that of value * d(displacement).

    value : a function of coordinates, velocities and internal variables, positive where it pushes
        the displacement, a function of the coordinates, to grow.
    """

    name: str
    value: sp.Expr
    displacement: sp.Expr

    def __post_init__(self) -> None:
        what = f"force {self.name!r}"
        valid.texts(what, name=self.name)
        valid.expressions(what, value=self.value, displacement=self.displacement)


def feet(
    *,
    gap: Callable[[sp.Expr], sp.Expr],
    slip: Callable[[sp.Expr], sp.Expr],
    law: Rigid,
    names: tuple[str, str] = ("left", "right"),
    place: Callable[[sp.Expr], Point] | None = None,
) -> tuple[Contact, Contact]:
    """A mirrored pair: gap and slip of the side s, which is -1 at the left foot, 1 at the right."""
    left, right = names
    at = None if place is None else place(SIDE)
    return (
        Contact(left, gap(SIDE), slip(SIDE), law, -1, at),
        Contact(right, gap(SIDE), slip(SIDE), law, 1, at),
    )


_LISTS = ("parameters", "coordinates", "bodies", "contacts", "elements", "forces", "members")


@former.names(phases="mechanisms", laws="functions")
@dataclass(frozen=True, kw_only=True)
class Model:
    """A structure that is free to move but for its contacts and elements.

    contacts, elements : what touches, and what carries forces: a `Spring` always, others by their
        states.
    rotation : the coordinate that overturns, positive clockwise, at `overturning`.
    falls : further coordinates that do, each with the size at which it has, {coordinate: size}.
    elastic_energy, dissipation : of springs and dampers that always act and need no name; those of
        each `Spring` are added.
    forces : others that always act, each by its work along a displacement.
    rates : of each internal variable z, dz/dt, a function of coordinates, velocities and internal
        variables. These may stand in forces and in the elastic energy, whose slope by a coordinate
        is a force; its slope by z is none. An impact leaves them as they are, and so does statics.
        Beside z a response tells of its integral over time, `z_integral`, which acts on nothing.
    load_point : place of a pushover's force, whose displacement a response tells.
    members : what a sketch shows between bodies.

    On a pair of `Pinned()` feet it is a rocking structure, see `reduced`.

    Raises ValueError, naming the item and the remedy, for a declaration that cannot be meant.
    """

    name: str
    title: str
    parameters: tuple[Parameter, ...]
    coordinates: tuple[Coordinate, ...]
    bodies: tuple[Body, ...]
    gravity: sp.Expr
    rotation: Coordinate
    contacts: tuple[Contact, ...] = ()
    elements: tuple[Element, ...] = ()
    elastic_energy: sp.Expr = sp.S.Zero
    dissipation: sp.Expr = sp.S.Zero
    forces: tuple[Force, ...] = ()
    rates: Mapping[InternalVariable, sp.Expr] = field(default_factory=dict, hash=False)
    overturning: sp.Expr = sp.pi / 2
    load_point: Point | None = None
    reference: str = ""
    members: tuple[Member, ...] = ()
    falls: Mapping[Coordinate, sp.Expr] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        from rockeom.symbolic.check_contacts import check

        for name in _LISTS:
            object.__setattr__(self, name, tuple(getattr(self, name)))
        check(self)
        _ = self.reduced

    @cached_property
    def reduced(self) -> Model | RockingModel:
        """What is generated and simulated: the model itself, or with pinned feet what is left.

        That is a RockingModel, whose coordinates are those that a pinned foot leaves free. It tells
        of its own equations, such as `model.reduced.equations("right")`.
        """
        if not any(isinstance(c.law, Pinned) for c in self.contacts):
            return self
        from rockeom.symbolic.pinned import reduced

        return reduced(self)

    @cached_property
    def free(self) -> Mechanism:
        """The structure without its contacts and what switches, all coordinates free."""
        return Mechanism(
            {"flight": 0},
            self.coordinates,
            self.bodies,
            self.gravity,
            self.elastic_energy,
            self.dissipation,
            load_point=self.load_point,
            forces=self._generalised_forces,
            elements=self.springs,
        )

    @property
    def springs(self) -> tuple[Spring, ...]:
        """Those of `elements` that always act."""
        return tuple(e for e in self.elements if isinstance(e, Spring))

    @property
    def switching(self) -> tuple[Switching, ...]:
        """Those of `elements` that have states, of which contact states are made."""
        return tuple(e for e in self.elements if not isinstance(e, Spring))

    @cached_property
    def passages(self) -> tuple[Mapping[int, tuple[Passage, ...]], ...]:
        """Those that end the states of each of `switching`."""
        return tuple(e.passages(self.coordinates) for e in self.switching)

    @property
    def _generalised_forces(self) -> tuple[sp.Expr, ...]:
        """That on each coordinate, by virtual work."""
        return tuple(
            sum((f.value * sp.diff(f.displacement, c.position) for f in self.forces), sp.S.Zero)
            for c in self.coordinates
        )

    @cached_property
    def internal(self) -> dict[InternalVariable, sp.Expr]:
        """All internal variables with their rates: those of `rates`, and those of elements."""
        found = dict(self.rates)
        for i, element in enumerate(self.switching):
            found |= element.rates(switch_of(i), self.coordinates)
        return found

    @cached_property
    def integrals(self) -> tuple[Coordinate, ...]:
        """Of each internal variable: its integral, as whose velocity it is integrated.

        So all states are places and velocities, and the integrator knows no others.
        """
        return tuple(
            Coordinate(
                sp.Dummy(real=True), z.symbol, z.rate, f"{z.name}_integral",
                "s" if z.unit == "-" else f"{z.unit} s", f"integral over time of {z.name}",
            )
            for z in self.internal
        )  # fmt: skip

    @cached_property
    def modes(self) -> Modes:
        """The contact states and their mechanisms, derived.

        Raises ValueError where statics does not tell how closed points share their forces, where
        there are too many contact states, and where feet are pinned: see `reduced`.
        """
        from rockeom.symbolic.modes import derive_modes

        if isinstance(self.reduced, RockingModel):
            raise ValueError(
                f"{self.name}: with pinned feet its contact states are "
                f"{', '.join(self.reduced.contacts)}: see `model.reduced`, such as "
                '`model.reduced.equations("right")`'
            )
        return derive_modes(self)

    def mode(self, name: str) -> DerivedMechanism:
        """The mechanism that moves in a contact state, such as "right_slides_left".

        Raises ValueError, naming the contact states, if there is none of that name.
        """
        valid.known(self.name, "contact state", name, self.modes.names)
        return self.modes.mechanism_of(self.modes.states[self.modes.names.index(name)])

    @property
    def states(self) -> tuple[str, ...]:
        names = [c.name for c in self.coordinates]
        integrals = [c.name for c in self.integrals]
        return (*names, *integrals, *(f"{n}_dot" for n in names), *(z.name for z in self.internal))

    def check_derived(self) -> None:
        """Raise ValueError where what follows from the declaration cannot be simulated."""
        from rockeom.symbolic.check_contacts import check_derived

        if isinstance(self.reduced, RockingModel):
            self.reduced.check_derived()
        else:
            check_derived(self)

    def check_values(self, values: Mapping[str, float]) -> None:
        """Raise ValueError where these parameters, by name, give a body or a base no size."""
        from rockeom.symbolic.check import check_values

        check_values(self.reduced, values)

    def latex(self, form: str = "width") -> str:
        """A LaTeX document of the whole model; in two forms where feet are pinned."""
        from rockeom.symbolic.typeset import latex_document

        return latex_document(self, form)

    def markdown(self) -> str:
        """The same equations as a Markdown page."""
        from rockeom.symbolic.typeset import markdown_page

        return markdown_page(self)

    def code(self, language: str) -> str:
        """What is simulated, as the text of one self-contained file: "c" (C99) or "matlab".

        Equations of motion, guards, impact map, energies and more of every contact state, with
        arguments and units told in it; MATLAB's runs in Octave as well. See `rockeom export`.
        Raises ValueError for another language.
        """
        from rockeom.exports import code_of_model

        return code_of_model(self, language)

    # what is asked of a model whichever way it was declared

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.free,)

    @property
    def constants(self) -> dict[sp.Symbol, sp.Expr]:
        return {}

    @property
    def definitions(self) -> tuple[Definition, ...]:
        return ()

    @property
    def functions(self) -> tuple[NamedFunction, ...]:
        return ()

    @property
    def velocity_ratio(self) -> None:
        return None

    def in_contact(self, expr: sp.Expr, contact: str) -> sp.Expr:
        return sp.sympify(expr)

    def written_out(self, expr: sp.Expr) -> sp.Expr:
        return sp.sympify(expr)
