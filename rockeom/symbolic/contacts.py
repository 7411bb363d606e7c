"""A structure whose contacts are declared; `rockeom.symbolic.modes` derives its modes.

Bodies have positions in the coordinates of the FREE structure. A contact is a point with a gap and
a slip, functions of the coordinates, and a law; an element carries a force. Modes and transitions
follow from these.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from rockeom.codes import CONTACT_LAWS
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, require_word
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.elements import Element, Ending, Spring, Switching, switch_of
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    InternalVariable,
    Member,
    Parameter,
    Point,
    Tilt,
    shaking,
)


@explained.record()
@dataclass(frozen=True)
class Rigid:
    """Rigid contact: it opens, sticks or slips.

    Parameters
    ----------
    restitution : sympy.Expr, optional
        Restitution e, 0 to 1: the ratio of the rates of the gap after and before an impact of this
        point alone without friction. By "newton" that of any impact in which it presses, by
        "poisson" of impulses, by "lzb" and "pairwise" e^2 is that of the energy given back.
    friction : sympy.Expr, optional
        Coulomb's coefficient, the largest ratio of friction and normal force; None: it never slips;
        the number 0: a smooth contact, which is open or closed and never sticks.
    law : str, optional
        Impact law, "newton", "moreau", "poisson", "lzb" or "pairwise"; one for all contacts of a
        structure.
    stiffness : sympy.Expr, optional
        Relative stiffness of "lzb" and "pairwise"; ratios of it count.
    tangential : sympy.Expr, optional
        Restitution e_t of "moreau", 0 to 1; None: e.

    Raises
    ------
    ValueError
        For a law of another name, numbers out of their ranges, and `stiffness` or `tangential` with
        a law that has none.

    Notes
    -----
    At the points that touch v and w are the rates of gaps and slips, P and Q the impulses along
    them. In space "newton", where there is no restitution or no friction, and "moreau", with one
    restitution of gap and slips.

    * "newton": P >= 0, v after >= -e v before, one of them with equality; Q opposes the slip after
      the impact, ``|Q| <= friction P``. It gains no energy with e = 0, nor without friction; else
      it can.
    * "moreau": the same, where Q opposes w after + e_t w before (Moreau 1988). It gains no energy
      where all e and e_t are one number, nor without friction; else it can.
    * "poisson": all gaps that close come to rest together; e times the impulses of that are given
      back. Coulomb's law holds all through the impact, in which a slip may come to rest and turn
      (Routh 1860). It gains no energy where one point meets, nor without friction; with friction at
      several points it can.
    * "lzb": impulses grow as those of linear springs of relative `stiffness` k, by the law of Liu,
      Zhao and Brogliato (2008), dP_i/dP_j = sqrt(k_i E_i/(k_j E_j)), E the energy that a spring
      holds, of which e^2 is given back; friction as by "poisson". It never gains energy. A friction
      is needed, e is 0, or 0.001 and more, and one k at most 1e8 and (1e5 e)^2 times another.
    * "pairwise": impacts of single points by "lzb", one after the other: of the points that close
      the one of the greatest `stiffness`, of equal ones the fastest. It never gains energy.

    Examples
    --------
    >>> from rockeom.symbolic import Rigid
    >>> Rigid(restitution=0.8, friction=0.4, law="lzb").law
    'lzb'
    """

    restitution: sp.Expr = sp.S.Zero
    friction: sp.Expr | None = None
    law: str = "newton"
    stiffness: sp.Expr = sp.S.One
    tangential: sp.Expr | None = None

    def __post_init__(self) -> None:
        what = "law Rigid"
        friction = 0 if self.friction is None else self.friction
        tangential = 0 if self.tangential is None else self.tangential
        ratios = {"restitution": self.restitution, "tangential": tangential}
        given = ratios | {"friction": friction, "stiffness": self.stiffness}
        valid.expressions(what, **given)
        valid.not_negative(what, **given)
        for name, ratio in ratios.items():
            if (1 - sp.sympify(ratio)).is_negative:
                raise InputError(name, ratio, what).give("a ratio of rates, 0 to 1")
        require_word("law", self.law, CONTACT_LAWS, what)
        of_laws = ("stiffness", sp.S.One, "lzb", "pairwise"), ("tangential", None, "moreau")
        for name, without, *laws in of_laws:
            if getattr(self, name) != without and self.law not in laws:
                raise InputError(name, getattr(self, name), what).wrong(
                    f"is {getattr(self, name)}, and the law {self.law!r} has none: leave it out, "
                    f"or give law={' or '.join(map(repr, laws))}"
                )
        if sp.sympify(self.stiffness).is_zero:
            raise InputError("stiffness", self.stiffness, what).give("a positive one")
        if self.law == "lzb" and self.friction is None:
            raise InputError("friction", of=what).wrong(
                "is None, and law='lzb' follows the slip through an impact: give a coefficient of "
                "friction, or law='poisson' or 'pairwise'"
            )

    @property
    def frictionless(self) -> bool:
        """Whether friction is 0 whatever the parameters are."""
        return self.friction is not None and bool(sp.sympify(self.friction).is_zero)


@explained.record()
@dataclass(frozen=True)
class Pinned(Rigid):
    """Law of a pair of feet that open, and neither slip nor bounce at any force.

    A model on them is a rocking structure: the place of its base is no state, its modes are "left",
    "both" and "right", and impact laws are those by a ratio of rates, such as `AngularMomentum`.
    See `Model.reduced`.
    """

    restitution: sp.Expr = field(default=sp.S.Zero, init=False, repr=False)
    friction: sp.Expr | None = field(default=None, init=False, repr=False)
    law: str = field(default="newton", init=False, repr=False)
    stiffness: sp.Expr = field(default=sp.S.One, init=False, repr=False)
    tangential: sp.Expr | None = field(default=None, init=False, repr=False)


@explained.record()
@dataclass(frozen=True)
class Contact:
    """Point that may close.

    Parameters
    ----------
    name : str
        Name of the point, such as "left".
    gap : sympy.Expr
        Distance of the point from the surface, not negative.
    slip : sympy.Expr or tuple of (sympy.Expr, sympy.Expr)
        Tangential place, which grows to the right; in space along x and y.
    law : Rigid
        Contact law.
    side : int, optional
        -1 or 1 for a point of a mirrored pair, whose gap and slip contain s; else 0.
    place : tuple of (sympy.Expr, sympy.Expr), optional
        Place (x, y), next to the ground at rest; (slip, gap) if not given, as for a point above
        level ground. Sketches show it there.
    material : dict of sympy.Symbol to sympy.Expr, optional
        Of a point whose material changes, as that of a rim that rolls: symbols in `slip` that say
        where in its body the point is, each with its value, a function of the coordinates. Rates of
        the slip are those of the material, for which the symbols are constants.
    """

    name: str
    gap: sp.Expr
    slip: sp.Expr | tuple[sp.Expr, sp.Expr]
    law: Rigid
    side: int = 0
    place: Point | None = None
    material: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        what = f"contact {self.name!r}"
        valid.texts(what, name=self.name)
        valid.expressions(what, gap=self.gap)
        if isinstance(self.slip, tuple):
            valid.points(what, slip=self.slip)
        else:
            valid.expressions(what, slip=self.slip)
        if self.place is not None:
            valid.points(what, axes=(1 + len(self.slips),), place=self.place)
        if not isinstance(self.law, Rigid):
            raise ValueError(
                f"{what}: its law is {self.law!r}: give Rigid(restitution, friction) or Pinned(), "
                "both of rockeom.symbolic"
            )
        for symbol, value in self.material.items():
            valid.symbols(what, **{f"material {symbol}": symbol})
            valid.expressions(what, **{f"material {symbol}": value})

    @property
    def slips(self) -> tuple[sp.Expr, ...]:
        """Its slip; in space along x and y."""
        return tuple(map(self.now, self._declared_slips))

    @property
    def _declared_slips(self) -> tuple[sp.Expr, ...]:
        return self.slip if isinstance(self.slip, tuple) else (self.slip,)

    def now(self, expr: sp.Expr) -> sp.Expr:
        """Expression with the material that is at the point.

        Parameters
        ----------
        expr : sympy.Expr
            Expression that may hold symbols of `material`.

        Returns
        -------
        sympy.Expr
            Expression without them.
        """
        return expr.xreplace(dict(self.material)) if self.material else expr

    @property
    def followed(self) -> tuple[sp.Expr, ...]:
        """Gap and slip of a point of the material, which `now` makes that of the contact."""
        return tuple(at_side(e, self.side) for e in (self.gap, *self._declared_slips))

    def at(self, side: sp.Expr | int) -> tuple[sp.Expr, ...]:
        """Gap and slip, the side put in.

        Parameters
        ----------
        side : sympy.Expr or int
            Side, -1 or 1.

        Returns
        -------
        gap : sympy.Expr
            Gap.
        slip : sympy.Expr
            Slip; in space two.
        """
        return tuple(at_side(e, side) for e in (self.gap, *self.slips))

    @property
    def point(self) -> Point:
        """Its place."""
        place = (*self.slips, self.gap) if self.place is None else self.place
        return tuple(at_side(e, self.side) for e in place)


@dataclass(frozen=True)
class Force:
    """Force that always acts, along a displacement: its work is that of value d(displacement).

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    value : sympy.Expr or tuple
        Function of coordinates, velocities and internal variables, positive where it pushes the
        displacement to grow; or the components (F_x, F_y) of a force in the plane.
    displacement : sympy.Expr or tuple
        Function of the coordinates; or the place (x, y) of the point at which the force acts.

    Raises
    ------
    ValueError
        For anything but expressions, and where only one of both is a pair.
    """

    name: str
    value: sp.Expr | Point
    displacement: sp.Expr | Point

    def __post_init__(self) -> None:
        what = f"force {self.name!r}"
        valid.texts(what, name=self.name)
        if isinstance(self.value, tuple) or isinstance(self.displacement, tuple):
            valid.points(what, value=self.value, displacement=self.displacement)
        else:
            valid.expressions(what, value=self.value, displacement=self.displacement)

    @property
    def components(self) -> tuple[tuple[sp.Expr, sp.Expr], ...]:
        """(value, displacement) of each of its components, one or two."""
        if isinstance(self.value, tuple) and isinstance(self.displacement, tuple):
            return tuple(zip(self.value, self.displacement, strict=True))
        return ((self.value, self.displacement),)

    def on(self, position: sp.Symbol) -> sp.Expr:
        """The generalised force on a coordinate, by virtual work."""
        return sum((f * sp.diff(w, position) for f, w in self.components), sp.S.Zero)


@explained.calls()
def dead_load(name: str, force: sp.Expr, at: Point, turned: sp.Expr = sp.S.Zero) -> Force:
    """Force of constant size that presses on a point, such as the axial load by an actuator.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    force : sympy.Expr
        Size of the force [N], positive where it presses down.
    at : tuple of (sympy.Expr, sympy.Expr)
        Place (x, y) of the point.
    turned : sympy.Expr, optional
        Angle through which its direction has turned clockwise from straight down. Zero for a load
        that stays vertical, as of a weight on the point: its work is that of a potential, force
        times y. The rotation of the body for one that follows it, as of a jack that is fixed to it:
        in general its work depends on the path, and there is no potential.

    Returns
    -------
    Force
        Force.

    Raises
    ------
    ValueError
        For anything but expressions, and a point.

    Notes
    -----
    A force that points at an anchor is a `Spring` with an initial_force and no stiffness.

    Examples
    --------
    >>> import sympy as sp
    >>> from rockeom.symbolic import dead_load
    >>> N, h, theta = sp.symbols("N h theta")
    >>> dead_load("jack", N, (h * sp.sin(theta), h * sp.cos(theta)), turned=theta).on(theta)
    0
    """
    valid.expressions(f"force {name!r}", force=force, turned=turned)
    return Force(name, (-force * sp.sin(turned), -force * sp.cos(turned)), at)


@explained.calls()
def feet(
    *,
    gap: Callable[[sp.Expr], sp.Expr],
    slip: Callable[[sp.Expr], sp.Expr],
    law: Rigid,
    names: tuple[str, str] = ("left", "right"),
    place: Callable[[sp.Expr], Point] | None = None,
) -> tuple[Contact, Contact]:
    """Mirrored pair of contacts.

    Parameters
    ----------
    gap : callable
        Function of the side s, -1 at the left foot and 1 at the right, that gives the gap.
    slip : callable
        Function of the side that gives the slip.
    law : Rigid
        Contact law of both.
    names : tuple of (str, str), optional
        Names of the left and the right foot.
    place : callable, optional
        Function of the side that gives the place (x, y).

    Returns
    -------
    left : Contact
        Left foot.
    right : Contact
        Right foot.
    """
    left, right = names
    at = None if place is None else place(SIDE)
    return (
        Contact(left, gap(SIDE), slip(SIDE), law, -1, at),
        Contact(right, gap(SIDE), slip(SIDE), law, 1, at),
    )


@dataclass(frozen=True, kw_only=True)
class ContactDeclaration:
    """Bodies that are free to move but for contacts and elements; see `Model`, which checks it."""

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
    falls: Mapping[Coordinate | Tilt, sp.Expr] = field(default_factory=dict, hash=False)
    bounds: Mapping[str, sp.Expr] = field(default_factory=dict, hash=False)

    @cached_property
    def free(self) -> Mode:
        """The structure without its contacts and what switches, all coordinates free."""
        return Mode(
            {self.open_mode: 0},
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
    def axes(self) -> int:
        """Number of axes of a place: two in the plane, three in space."""
        return len(shaking(self.bodies))

    @property
    def by_code(self) -> bool:
        """Whether modes are numbers only, a digit for each point, as those of contacts in space."""
        return bool(self.contacts) and self.axes == 3

    @property
    def falling_coordinates(self) -> dict[Coordinate, sp.Expr]:
        """Coordinates of `falls`, each with the size at which it has overturned."""
        return {c: size for c, size in self.falls.items() if not isinstance(c, Tilt)}

    @property
    def limits(self) -> dict[str, sp.Expr]:
        """Functions that are positive until a motion ends: `bounds`, and behind them tilts."""
        tilts = {t.name: t.cosine - sp.cos(e) for t, e in self.falls.items() if isinstance(t, Tilt)}
        return {**self.bounds, **tilts}

    @property
    def open_mode(self) -> str:
        """Name of the mode in which nothing touches; "free" where nothing ever does."""
        return "flight" if self.contacts or self.switching else "free"

    @property
    def springs(self) -> tuple[Spring, ...]:
        """The `elements` that always act."""
        return tuple(e for e in self.elements if isinstance(e, Spring))

    @property
    def switching(self) -> tuple[Switching, ...]:
        """The `elements` that have states, of which modes are made."""
        return tuple(e for e in self.elements if not isinstance(e, Spring))

    @cached_property
    def endings(self) -> tuple[Mapping[int, tuple[Ending, ...]], ...]:
        """The endings of the states of each of `switching`."""
        return tuple(e.endings(self.coordinates) for e in self.switching)

    @cached_property
    def is_held_across(self) -> bool:
        """Whether an element or a force holds the whole structure horizontally.

        The horizontal force of the ground is then not that of the points alone.
        """
        places = [body.position for body in self.bodies]
        moves_all = [
            c
            for c in self.coordinates
            if all(
                sp.diff(x, c.position) == 1 and all(sp.diff(e, c.position) == 0 for e in others)
                for x, *others in places
            )
        ]
        across = [e.displacement for e in self.elements]
        across += [w for f in self.forces for _, w in f.components]
        return any(sp.diff(w, c.position) != 0 for w in across for c in moves_all)

    @property
    def _generalised_forces(self) -> tuple[sp.Expr, ...]:
        """The force on each coordinate, by virtual work."""
        return tuple(
            sum((f.on(c.position) for f in self.forces), sp.S.Zero) for c in self.coordinates
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
        """Integral of each internal variable, which is its velocity.

        So all states are places and velocities.
        """
        return tuple(
            Coordinate(
                sp.Dummy(real=True), z.symbol, z.rate, f"{z.name}_integral",
                "s" if z.unit == "-" else f"{z.unit} s", f"integral over time of {z.name}",
            )
            for z in self.internal
        )  # fmt: skip

    @property
    def states(self) -> tuple[str, ...]:
        """Places of coordinates, integrals of internal variables, and the rates of both."""
        names = [c.name for c in self.coordinates]
        integrals = [c.name for c in self.integrals]
        return (*names, *integrals, *(f"{n}_dot" for n in names), *(z.name for z in self.internal))

    @property
    def impact_law(self) -> str:
        """The impact law of all contacts, by its name."""
        return self.contacts[0].law.law if self.contacts else "newton"

    @property
    def has_pinned_feet(self) -> bool:
        """Whether a contact has the law `Pinned`."""
        return any(isinstance(c.law, Pinned) for c in self.contacts)
