"""What a structure declares, and what follows from it.

A structure is a set of bodies whose positions are known in each mechanism, that of a contact state
or of two that are mirror images. It declares those positions, its springs and its dampers;
the rest of this package derives equations of motion, impact maps, reactions and statics from them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import sympy as sp

from rockeom.symbolic import former, valid
from rockeom.symbolic.algebra import SIDE, at_side, truncated

if TYPE_CHECKING:
    from rockeom.symbolic.elements import Spring
    from rockeom.symbolic.evaluate import NumpyPhase
    from rockeom.symbolic.impulse import ImpulseMap
    from rockeom.symbolic.lagrange import Equations

Point = tuple[sp.Expr, sp.Expr]
"""A place (x, y)."""
Outline = tuple[Point, ...]

GROUND_X, GROUND_Y = sp.symbols("a_x a_y", real=True)
"""Horizontal and vertical ground acceleration [m/s2], positive to the right and upwards."""


@dataclass(frozen=True)
class Parameter:
    """A constant of a structure. It has no default: physics is never assumed silently."""

    symbol: sp.Symbol
    name: str
    unit: str
    meaning: str

    def __post_init__(self) -> None:
        what = f"parameter {self.name!r}"
        valid.symbols(what, symbol=self.symbol)
        valid.texts(what, unit=self.unit, meaning=self.meaning)


@dataclass(frozen=True)
class Definition:
    """A constant that follows from the parameters; equations are written with its symbol."""

    symbol: sp.Symbol
    name: str
    unit: str
    meaning: str
    value: sp.Expr

    def __post_init__(self) -> None:
        what = f"definition {self.name!r}"
        valid.symbols(what, symbol=self.symbol)
        valid.texts(what, name=self.name, unit=self.unit, meaning=self.meaning)
        valid.expressions(what, value=self.value)


@dataclass(frozen=True)
class NamedFunction:
    """A function of the coordinates that equations name instead of writing it out.

    symbol : a function such as b(theta), whose derivatives are then those of `value`; or a plain
        symbol, which Lagrange's equations take as a constant. `value` may contain the side, the
        parameters, and named functions that stand before it.
    """

    symbol: sp.Expr
    name: str
    unit: str
    meaning: str
    value: sp.Expr

    def __post_init__(self) -> None:
        what = f"function {self.name!r}"
        valid.expressions(what, symbol=self.symbol, value=self.value)
        valid.texts(what, name=self.name, unit=self.unit, meaning=self.meaning)
        valid.laws(what, symbol=self.symbol)


@dataclass(frozen=True)
class Coordinate:
    """A generalised coordinate with its velocity and acceleration symbols."""

    position: sp.Symbol
    velocity: sp.Symbol
    acceleration: sp.Symbol
    name: str
    unit: str
    meaning: str

    def __post_init__(self) -> None:
        what = f"coordinate {self.name!r}"
        valid.symbols(
            what, position=self.position, velocity=self.velocity, acceleration=self.acceleration
        )
        valid.texts(what, unit=self.unit, meaning=self.meaning)


@dataclass(frozen=True)
class InternalVariable:
    """A state of first order, with no coordinate behind it: its rate is a function of the states.

    Such as the force of a Maxwell element, or the place between its spring and its damper.
    """

    symbol: sp.Symbol
    name: str
    unit: str
    meaning: str

    def __post_init__(self) -> None:
        what = f"internal variable {self.name!r}"
        valid.symbols(what, symbol=self.symbol)
        valid.texts(what, unit=self.unit, meaning=self.meaning)

    @property
    def rate(self) -> sp.Symbol:
        """The symbol of its rate."""
        return sp.Symbol(rf"\dot{{{_tex(str(self.symbol))}}}", real=True)


@dataclass(frozen=True)
class Body:
    """A rigid body: `mass` at `position` (x, y), with rotary `inertia` about its centroid.

    `rotation` is the angle through which the body turns. `polar` names the radius R and the
    angle alpha that replace the half-width and the body's height where equations are shown
    in the form R sin(alpha - s theta): (half_width, height, R, alpha).

    outline : corners of what a sketch shows, from the centre in axes that turn with the body, see
    `rectangle`; none for a mass without a size. copies, apart : how many there are of a body that
    stands for several alike, side by side, and at which distance a sketch shows them.
    """

    name: str
    mass: sp.Expr
    position: Point
    inertia: sp.Expr = sp.S.Zero
    rotation: sp.Expr = sp.S.Zero
    polar: tuple[sp.Symbol, sp.Symbol, sp.Symbol, sp.Symbol] | None = None
    outline: Outline = ()
    copies: sp.Expr = sp.S.One
    apart: sp.Expr = sp.S.Zero

    def __post_init__(self) -> None:
        what = f"body {self.name!r}"
        valid.texts(what, name=self.name)
        valid.points(what, position=self.position)
        valid.expressions(what, mass=self.mass, inertia=self.inertia, rotation=self.rotation)
        valid.not_negative(what, mass=self.mass, inertia=self.inertia)
        valid.expressions(what, **{f"polar {x}": x for x in self.polar or ()})
        if isinstance(self.outline, list | tuple):
            object.__setattr__(self, "outline", tuple(self.outline))
        valid.corners(what, self.outline)
        valid.expressions(what, copies=self.copies, apart=self.apart)


GROUND = "ground"
"""What a member ends at that does not end at a body."""

MEMBERS = ("column", "cantilever", "rod", "tendon", "spring", "damper")


@dataclass(frozen=True)
class Member:
    """What a sketch shows between two bodies: no equation knows of it.

    kind : "column", which bends and whose ends turn with the bodies; "cantilever", the end of which
    turns freely; "rod", "tendon", "spring" or "damper", which are straight.
    start, end : names of the bodies, or "ground". start_at, end_at : where on them, from the centre
    in axes that turn with the body; on the ground from the origin.
    """

    kind: str
    start: str
    end: str
    start_at: Point = (sp.S.Zero, sp.S.Zero)
    end_at: Point = (sp.S.Zero, sp.S.Zero)

    def __post_init__(self) -> None:
        what = f"member from {self.start!r} to {self.end!r}"
        valid.known(what, "kind", self.kind, MEMBERS)
        valid.points(what, start_at=self.start_at, end_at=self.end_at)


@dataclass(frozen=True)
class Foot:
    """A point of the base that may touch the ground.

    `force` is the vertical force of the ground on the foot where a spring or damper gives it;
    None where the ground is rigid and the force is a constraint's. `sprung` : whether a sketch
    shows a spring and a damper under it.
    """

    position: tuple[sp.Expr, sp.Expr]
    force: sp.Expr | None = None
    sprung: bool = False

    def __post_init__(self) -> None:
        valid.points("foot", position=self.position)
        if self.force is not None:
            valid.expressions("foot", force=self.force)


@dataclass(frozen=True)
class Mechanism:
    """The mechanism that moves while the set of contacts does not change.

    contacts : side of each contact state that this mechanism serves. A rocking mechanism
        serves two, {"left": -1, "right": +1}, written once with the side s = sgn(theta).
    coordinates : those free to move; all others are held where they are.
    elements : springs and dampers by name, see `Spring`; what they store and lose is added to
        elastic_energy and dissipation. The names are the same in each mechanism.
    dissipation : Rayleigh's function, half the power lost.
    forces : generalised force on each coordinate, in their order, for what neither potential nor
        dissipation gives; its virtual work is forces . dq. Empty for none.
    feet : the "left" and the "right" foot.
    small : symbols taken as small of first order; energies are then truncated at second
        order, which gives the linearised equations. Impacts keep the exact geometry.
    quantities : what a response tells besides, by name: (unit, value) in "m" or "N". The names are
        the same in each mechanism.
    beside_feet : (horizontal, vertical) force of the ground on the structure elsewhere than at its
        feet, such as that of the columns of a frame beside a wall.
    """

    contacts: dict[str, int]
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

    def __post_init__(self) -> None:
        what = f"mechanism {'/'.join(map(str, self.contacts))}"
        object.__setattr__(self, "elements", tuple(self.elements))
        _are_springs(what, self.elements)
        valid.points(what, beside_feet=self.beside_feet)
        valid.texts(what, **{f"contact {c}": c for c in self.contacts})
        valid.symbols(what, **{f"small {x}": x for x in self.small})
        valid.expressions(
            what, gravity=self.gravity, elastic_energy=self.elastic_energy,
            dissipation=self.dissipation,
            **{f"force {i}": e for i, e in enumerate(self.forces)},
            **{f"quantity {name!r}": e for name, (_, e) in self.quantities.items()},
        )  # fmt: skip
        if self.load_point is not None:
            valid.points(what, load_point=self.load_point)

    @cached_property
    def equations(self) -> Equations:
        from rockeom.symbolic.lagrange import derive_equations

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
        """The expression to second order in what this mechanism takes as small; else as it is."""
        return truncated(expr, self.small, 2) if self.small else sp.sympify(expr)

    def quantities_in(self, unit: str) -> dict[str, sp.Expr]:
        return {name: e for name, (u, e) in self.quantities.items() if u == unit}

    @property
    def has_side(self) -> bool:
        return any(self.contacts.values())

    def side_of(self, contact: str) -> int:
        return self.contacts[contact]


def _are_springs(what: str, elements: Any) -> None:
    from rockeom.symbolic.elements import Spring

    for e in elements:
        if not isinstance(e, Spring):
            raise ValueError(
                f"{what}: elements holds {e!r}: give objects of Spring; what switches is declared "
                "in a Model"
            )


@dataclass(frozen=True)
class Transition:
    """The end of a contact state.

    kind : "impact": the gap of `source` closes and velocities jump; "uplift": the acceleration
        with which `target` would open turns positive; "switch": `guard` falls through zero and
        the state goes on unchanged.
    fallback : where an impact leads if its target could not open (the old foot does not lift).
    guard : positive inside `source`; smooth, or the Max of two that are.
    sets : positions of coordinates that a switch puts to a new value, a function of the state.
    reversible : whether the guard of the passage back is zero where this one happens.
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
        valid.symbols(what, **{f"what it sets, {x}": x for x in self.sets})
        valid.expressions(what, **{f"value of {x}": e for x, e in self.sets.items()})
        if self.guard is not None:
            valid.expressions(what, guard=self.guard)


@former.names(phases="mechanisms", laws="functions", phase="mechanism")
@dataclass(frozen=True)
class RockingModel:
    """A structure: parameters, coordinates, mechanisms and the transitions between them.

    falls : further coordinates, each with the size at which the structure has fallen, as it has
    where the rotation reaches `overturning`. members : what a sketch shows between bodies.
    """

    name: str
    title: str
    parameters: tuple[Parameter, ...]
    coordinates: tuple[Coordinate, ...]
    mechanisms: tuple[Mechanism, ...]
    transitions: tuple[Transition, ...]
    rotation: Coordinate
    overturning: sp.Expr = sp.pi / 2
    definitions: tuple[Definition, ...] = ()
    rigid_velocity_ratio: sp.Expr | None = None
    reference: str = ""
    functions: tuple[NamedFunction, ...] = ()
    members: tuple[Member, ...] = ()
    falls: Mapping[Coordinate, sp.Expr] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        from rockeom.symbolic.check import check

        check(self)

    @property
    def reduced(self) -> RockingModel:
        """Itself: what a `Model` on pinned feet becomes."""
        return self

    @property
    def constants(self) -> dict[sp.Symbol, sp.Expr]:
        """Derived constants, each in terms of the parameters."""
        return {d.symbol: d.value for d in self.definitions}

    def written_out(self, expr: sp.Expr) -> sp.Expr:
        """The expression with all named functions and their derivatives in place of their names."""
        return _written_out(self.functions, sp.sympify(expr))

    def in_contact(self, expr: sp.Expr, contact: str) -> sp.Expr:
        """The expression written out for a contact state, its side put in as a number."""
        return at_side(self.written_out(expr), self.mechanism(contact).side_of(contact))

    @property
    def contacts(self) -> tuple[str, ...]:
        """Names of all contact states, in the order in which generated code numbers them."""
        names = [name for phase in self.mechanisms for name in phase.contacts]
        return tuple(sorted(names, key=lambda n: ("left" not in n, "both" not in n, n)))

    @property
    def states(self) -> tuple[str, ...]:
        names = [c.name for c in self.coordinates]
        return (*names, *(f"{n}_dot" for n in names))

    @property
    def has_impacts(self) -> bool:
        return any(t.kind == "impact" for t in self.transitions)

    def mechanism(self, contact: str) -> Mechanism:
        """The mechanism that serves a contact state ("left", "both", "right", "flight")."""
        for phase in self.mechanisms:
            if contact in phase.contacts:
                return phase
        raise KeyError(f"{self.name} has no contact state {contact!r}; it has {self.contacts}")

    def equations(self, contact: str) -> Equations:
        """Equations of motion of a contact state, its side put in as a number."""
        phase = self.mechanism(contact)
        return (
            phase.equations.at_side(phase.side_of(contact)) if phase.has_side else phase.equations
        )

    def impulse_map(self, source: str, target: str) -> ImpulseMap:
        """Velocities after the sudden passage from one contact state to another."""
        from rockeom.symbolic.impulse import derive_impulse_map

        if (source, target) not in self._impulse_maps:
            self._impulse_maps[source, target] = derive_impulse_map(self, source, target)
        return self._impulse_maps[source, target]

    @cached_property
    def _impulse_maps(self) -> dict[tuple[str, str], ImpulseMap]:
        """Those that have been asked for."""
        return {}

    @cached_property
    def velocity_ratio(self) -> sp.Expr | None:
        """Ratio of angular velocities at an impact of the structure taken as rigid."""
        from rockeom.symbolic.impulse import rigid_velocity_ratio

        if self.rigid_velocity_ratio is not None:
            return self.rigid_velocity_ratio
        impact = next((t for t in self.transitions if t.kind == "impact"), None)
        return None if impact is None else rigid_velocity_ratio(self, impact)

    def check_derived(self) -> None:
        """Raise ValueError where what follows from the declaration cannot be simulated."""
        from rockeom.symbolic.check import check_derived

        check_derived(self)

    def check_values(self, values: Mapping[str, float]) -> None:
        """Raise ValueError where these parameters, by name, give a body or a base no size."""
        from rockeom.symbolic.check import check_values

        check_values(self, values)

    def latex(self, form: str = "width") -> str:
        """A LaTeX document of the whole model; `form` is "width" (B, H) or "polar" (R, alpha)."""
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

    def _repr_latex_(self) -> str:
        from rockeom.symbolic.typeset import notebook_display

        return notebook_display(self)

    def lambdify(self) -> dict[str, NumpyPhase]:
        """Vectorised NumPy functions of every contact state, see `numpy_functions`."""
        from rockeom.symbolic.evaluate import numpy_functions

        return numpy_functions(self)


@lru_cache(maxsize=4096)  # the same guards and energies are asked for in many contact states
def _written_out(laws: tuple[NamedFunction, ...], expr: sp.Expr) -> sp.Expr:
    for law in reversed(laws):
        if law.symbol.is_Symbol:
            expr = expr.xreplace({law.symbol: law.value})
            continue
        (of,) = law.symbol.args
        calls = expr.atoms(law.symbol.func)
        if not calls:
            continue
        rates = [d for d in expr.atoms(sp.Derivative) if d.expr == law.symbol]
        put = {d: sp.diff(law.value, *d.variables) for d in rates}
        for at in calls:
            put[at] = law.value.subs(of, at.args[0])
        expr = expr.xreplace(put)
    return expr.doit() if expr.has(sp.Subs) else expr


def coordinate(symbol: str, name: str, unit: str, meaning: str) -> Coordinate:
    """A coordinate; its velocity and acceleration are typeset with one and two dots."""
    return Coordinate(
        sp.Symbol(symbol, real=True),
        sp.Symbol(rf"\dot{{{_tex(symbol)}}}", real=True),
        sp.Symbol(rf"\ddot{{{_tex(symbol)}}}", real=True),
        name,
        unit,
        meaning,
    )


def internal_variable(symbol: str, name: str, unit: str, meaning: str) -> InternalVariable:
    """An internal variable, of either sign."""
    return InternalVariable(sp.Symbol(symbol, real=True), name, unit, meaning)


def parameter(symbol: str, name: str, unit: str, meaning: str) -> Parameter:
    """A positive parameter."""
    return Parameter(sp.Symbol(symbol, positive=True), name, unit, meaning)


def _tex(symbol: str) -> str:
    return sp.latex(sp.Symbol(symbol))


def rectangle(half_width: sp.Expr, below: sp.Expr, above: sp.Expr | None = None) -> Outline:
    """The corners of a rectangle that reaches `below` and `above` a body's centre, or as far."""
    low, high = -sp.sympify(below), sp.sympify(below if above is None else above)
    b = sp.sympify(half_width)
    return (-b, low), (b, low), (b, high), (-b, high)


def turned(point, about, angle) -> tuple[sp.Expr, sp.Expr]:
    """`point` (x, y) turned clockwise through `angle` about the point `about`."""
    point = tuple(point)
    valid.points("turned", point=point, about=tuple(about))
    dx, dy = sp.sympify(point[0]) - about[0], sp.sympify(point[1]) - about[1]
    cos, sin = sp.cos(angle), sp.sin(angle)
    return about[0] + dx * cos + dy * sin, about[1] - dx * sin + dy * cos


def rocking_structure(
    *,
    name: str,
    title: str,
    parameters: Iterable[Parameter],
    coordinates: Iterable[Coordinate],
    bodies,
    half_width: sp.Expr,
    gravity: sp.Expr,
    rotation_angle: sp.Expr | None = None,
    elastic_energy: sp.Expr = sp.S.Zero,
    dissipation: sp.Expr = sp.S.Zero,
    load_on: str | None = None,
    beside_feet: tuple[sp.Expr, sp.Expr] = (sp.S.Zero, sp.S.Zero),
    small: tuple[sp.Symbol, ...] = (),
    overturning: sp.Expr = sp.pi / 2,
    reference: str = "",
    members: Iterable[Member] = (),
    elements: Iterable[Spring] = (),
) -> RockingModel:
    """A structure that rocks about the two edges of its base on rigid ground.

    `bodies(pivot)` gives the bodies when the structure turns about `pivot`; the first
    coordinate is the rotation, positive clockwise, about the right edge. Full contact is the
    same structure with the rotation held at zero. `beside_feet` and `elements` are as in
    `Mechanism`.

    It stands beside a `Model` on `Pinned()` feet, which becomes the same by `on_pinned_feet`, and
    makes none itself: its bodies know the foot, and may stand where no free coordinates put them.
    So does a beam on the corners opposite the pressed feet, which changes them; a frame that the
    ground carries beside a wall, whose place no foot moves; and positions of first order.
    """
    coordinates = tuple(coordinates)
    if not coordinates:
        raise ValueError(f"{name}: it has no coordinates: declare the rotation, first")
    rotation = coordinates[0]
    angle = rotation.position if rotation_angle is None else rotation_angle
    valid.expressions(
        str(name), half_width=half_width, gravity=gravity, rotation_angle=angle,
        elastic_energy=elastic_energy, dissipation=dissipation,
    )  # fmt: skip
    valid.points(str(name), beside_feet=beside_feet)
    if sp.sympify(half_width).is_nonpositive:
        raise ValueError(f"{name}: half_width is {half_width}: it must be positive")
    pivot = (SIDE * half_width, sp.Integer(0))
    turning = tuple(bodies(pivot))
    if not turning:
        raise ValueError(f"{name}: it has no bodies: declare the masses")
    load = turning[0].name if load_on is None else load_on
    valid.known(str(name), "load_on", load, [b.name for b in turning])
    edges = {"left": (-half_width, sp.Integer(0)), "right": (half_width, sp.Integer(0))}
    return on_pinned_feet(
        Mechanism(
            dict(SIDES),
            coordinates,
            turning,
            gravity,
            sp.sympify(elastic_energy),
            sp.sympify(dissipation),
            {k: Foot(turned(edge, pivot, angle)) for k, edge in edges.items()},
            next(b.position for b in turning if b.name == load),
            small,
            beside_feet=beside_feet,
            elements=tuple(elements),
        ),
        rotation,
        name=name,
        title=title,
        parameters=tuple(parameters),
        overturning=overturning,
        reference=reference,
        members=tuple(members),
    )


SIDES = {"left": -1, "right": 1}
"""The side of the foot about which a structure rocks, by its name."""


def on_pinned_feet(rocking: Mechanism, rotation: Coordinate, **described: Any) -> RockingModel:
    """A structure on two feet that neither slip nor bounce, by its mechanism on one of them.

    rocking : about the foot of the side s; the places of both feet are in it. As it leans to the
    side on which it stands the other foot rises, and where it comes upright both feet are on the
    ground: that is the impact, and what holds then is the same mechanism, the rotation at zero.
    Either foot may lift from there.

    Raises ValueError where the feet do not rise and land so.
    """
    from rockeom.symbolic.check import check_turning

    check_turning(described["name"], rocking, rotation)
    full = _upright(rocking, rotation)
    (both,) = full.contacts
    opposite = dict(zip(SIDES, reversed(SIDES), strict=True))
    return RockingModel(
        coordinates=rocking.coordinates,
        mechanisms=(rocking, full),
        transitions=(
            *(
                Transition(foot, opposite[foot], "impact", side * rotation.position, both)
                for foot, side in SIDES.items()
            ),
            *(Transition(both, foot, "uplift") for foot in SIDES),
        ),
        rotation=rotation,
        **described,
    )


def _upright(rocking: Mechanism, rotation: Coordinate) -> Mechanism:
    """The mechanism on both feet: that on one of them, the rotation held at zero."""
    held = {rotation.position: 0}

    def hold(expr) -> sp.Expr:
        return at_side(sp.sympify(expr).subs(held), 1)

    def still(expr) -> sp.Expr:
        return sp.sympify(expr).subs({rotation.velocity: 0, **held})

    def point(place: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        return hold(place[0]), hold(place[1])

    load = rocking.load_point
    return Mechanism(
        {"both": 0},
        tuple(c for c in rocking.coordinates if c != rotation),
        tuple(
            replace(b, position=point(b.position), rotation=hold(b.rotation), polar=None)
            for b in rocking.bodies
        ),
        rocking.gravity,
        sp.sympify(rocking.elastic_energy).subs(held),
        still(rocking.dissipation),
        {name: Foot(point(foot.position)) for name, foot in rocking.feet.items()},
        None if load is None else point(load),
        rocking.small,
        beside_feet=(still(rocking.beside_feet[0]), still(rocking.beside_feet[1])),
        elements=tuple(e.changed(hold) for e in rocking.elements),
    )
