"""Structures of contacts and elements: the class that users declare."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import sympy as sp

from rockeom.numbers import explained
from rockeom.numbers.checks import require_word
from rockeom.symbolic.checks.common import naming
from rockeom.symbolic.checks.contacts import check_items
from rockeom.symbolic.checks.declaration import check
from rockeom.symbolic.contacts import Contact, ContactDeclaration, Rigid
from rockeom.symbolic.hybrid import HybridModel, Search
from rockeom.symbolic.model import Outline
from rockeom.symbolic.modes.derived import DerivedMode
from rockeom.symbolic.modes.every import Modes
from rockeom.symbolic.parts import mechanics
from rockeom.symbolic.pinned import reduced
from rockeom.symbolic.rocking import Declared, RockingModel

_LISTS = ("parameters", "coordinates", "bodies", "contacts", "elements", "forces", "members")


@explained.attributes(
    equations='mode("NAME").mass_matrix and .forcing',
    impulse_map='mode("NAME").impact',
    mass_matrix='mode("NAME").mass_matrix',
    forcing='mode("NAME").forcing',
)
@explained.calls()
@dataclass(frozen=True, kw_only=True, repr=False)
class Model(Declared, ContactDeclaration):
    """Structure that is free to move but for its contacts and elements.

    On a pair of `Pinned()` feet it is a rocking structure, see `reduced`.

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
    bodies : tuple of Body
        Rigid bodies with mass.
    gravity : sympy.Expr
        Symbol or value of the acceleration of gravity.
    rotation : Coordinate
        Coordinate that overturns, positive clockwise, at `overturning`.
    contacts : tuple of Contact, optional
        Points that may touch.
    elements : tuple of Spring, Damper, Tie, Unilateral or Yielding, optional
        Elements that carry forces: a `Spring` always, others by their states.
    elastic_energy : sympy.Expr, optional
        Elastic energy of springs that always act and need no name; that of each `Spring` is added.
    dissipation : sympy.Expr, optional
        Rayleigh's function of dampers that always act and need no name; that of each `Spring` is
        added.
    forces : tuple of Force, optional
        Other forces that always act, each by its work along a displacement.
    rates : dict of InternalVariable to sympy.Expr, optional
        Rate dz/dt of each internal variable z, a function of coordinates, velocities and internal
        variables. Forces and the elastic energy may depend on these, whose slope by a coordinate is
        a force; its slope by z is none. An impact leaves them as they are, and so does statics. A
        response has its integral over time, too, `z_integral`, which acts on nothing.
    overturning : sympy.Expr, optional
        Size of the rotation at which the structure has overturned.
    load_point : tuple of (sympy.Expr, sympy.Expr), optional
        Place (x, y) of a pushover's force, whose displacement a response has.
    reference : str, optional
        Source of the equations.
    members : tuple of Member, optional
        Lines of a sketch.
    falls : dict of Coordinate or Tilt to sympy.Expr, optional
        Further coordinates that overturn, each with the size at which it has, {coordinate: size}; a
        body in space by its tilt, see `space.tilt`.
    bounds : dict of str to sympy.Expr, optional
        Where the declaration holds: functions of the coordinates, positive within, by name. A
        motion ends where one falls through zero, with the outcome "out of bounds". Bodies that
        touch nothing need one, such as ``{"flat": theta}`` of a column that leans.

    Raises
    ------
    ValueError
        For a declaration that cannot be meant; the message names the item and the remedy.
    """

    @classmethod
    def from_mechanics(
        cls,
        bodies: Iterable[Any],
        coordinates: Mapping[sp.Expr, mechanics.Words],
        *,
        frame: Any,
        origin: Any,
        parameters: Mapping[sp.Symbol, mechanics.Words],
        gravity: sp.Expr,
        rotation: sp.Expr,
        contacts: Mapping[str, tuple[Any, Rigid]] | Iterable[Contact] = (),
        outlines: Mapping[Any, Outline] | None = None,
        **declared: Any,
    ) -> Self:
        """Model of bodies of `sympy.physics.mechanics` that move in one plane.

        Positions follow from the points, rotations from the orientation of the frames; velocities
        and generalised speeds that were set are not used.

        Parameters
        ----------
        bodies : iterable of RigidBody or Particle
            Bodies, each a RigidBody or a Particle, with mass, mass centre and central inertia about
            z. Their potential energy is that of springs; the weight follows from `gravity`.
        coordinates : dict
            (name, unit, meaning) of each of the `dynamicsymbols` in which points and frames are
            written, ``{theta: ("theta", "rad", "rotation, positive clockwise")}``.
        frame : sympy.physics.mechanics.ReferenceFrame
            Frame that rests on the ground, x to the right and y upwards. The ground's acceleration
            is an argument of `simulate`.
        origin : sympy.physics.mechanics.Point
            Point that rests on the ground.
        parameters : dict
            (name, unit, meaning) of each symbol, ``{m: ("mass", "kg", "mass")}``.
        gravity : sympy.Expr
            Acceleration of gravity [m/s2], positive; it acts along -y.
        rotation : sympy.Expr
            The one of `coordinates` that overturns.
        contacts : dict or iterable of Contact, optional
            Points above level ground, y = 0, with their laws, ``{"left": (Point, Rigid())}``; or
            objects of `Contact`, such as those of `feet`.
        outlines : dict, optional
            Corners in a sketch, {body: corners}, from the mass centre, in axes that are x and y
            where all coordinates are zero.
        **declared : object
            Other arguments of `Model`, of which `name` and `title` are needed. They may contain the
            coordinates, as may `contacts`; a Point gives a place.

        Returns
        -------
        Model
            Model.

        Raises
        ------
        ValueError
            For motions out of the plane or from a point that moves, for functions of time that are
            no coordinates, and for symbols that `parameters` lacks; the message names the item and
            the remedy.

        Examples
        --------
        With bodies, points and frames of `sympy.physics.mechanics`::

            Model.from_mechanics(
                [block], {x: ("x", "m", "place"), y: ("y", "m", "height"), theta: ...},
                name="block", title="A block", frame=N, origin=O, rotation=theta, gravity=g,
                parameters={m: ("mass", "kg", "mass"), ...},
                contacts={"left": (A, Rigid()), "right": (B, Rigid())},
            )
        """
        name = declared.get("name", "model")
        declared |= {"gravity": gravity, "rotation": rotation}
        with naming(name):
            writer = mechanics.Writer(name, coordinates, frame, origin)
            items = writer.declaration(bodies, parameters, contacts, outlines or {}, declared)
        return cls(**items)

    def __repr__(self) -> str:
        return f"<Model {self.name!r} of {', '.join(c.name for c in self.coordinates)}>"

    def __post_init__(self) -> None:
        for name in _LISTS:
            object.__setattr__(self, name, tuple(getattr(self, name)))
        check_items(self)
        check(self._searched)
        _ = self.reduced

    @cached_property
    def reduced(self) -> Self | RockingModel:
        """The model itself, or with pinned feet the model of the coordinates that they leave free.

        That is a RockingModel with equations of its own, such as
        `model.reduced.equations("right")`.
        """
        return reduced(self) if self.has_pinned_feet else self

    @property
    def hybrid(self) -> HybridModel:
        """The model that is generated and simulated."""
        return self._searched if self.reduced is self else self.reduced.hybrid

    @cached_property
    def _searched(self) -> HybridModel:
        return HybridModel(
            self.name,
            self.title,
            self.parameters,
            self.coordinates,
            (self.free,),
            (),
            self.rotation,
            self.overturning,
            reference=self.reference,
            members=self.members,
            falls=self.falling_coordinates,
            search=Search(self),
        )

    @property
    def modes(self) -> Modes:
        """The modes and their equations, derived.

        Raises ValueError where statics leaves open how closed points share their forces, where
        there are too many modes, and where feet are pinned: see `reduced`.
        """
        search = self.hybrid.search
        if search is None:
            raise ValueError(
                f"{self.name}: with pinned feet its modes are "
                f"{', '.join(self.hybrid.mode_names)}: see `model.reduced`, such as "
                '`model.reduced.equations("right")`'
            )
        if search.of.by_code:
            raise ValueError(
                f"{self.name}: its modes are solved as numbers, in `rockeom.structure(...)`: see "
                "`model.free.equations`, to which each contact adds its force times the slopes "
                "of its gap"
            )
        return search.modes

    def mode(self, name: str) -> DerivedMode:
        """Equations of a mode, such as "right_slides_left".

        Parameters
        ----------
        name : str
            Name of the mode.

        Returns
        -------
        DerivedMode
            Equations.

        Raises
        ------
        ValueError
            If there is none of that name; the message names the modes.
        """
        require_word("mode", name, self.modes.names, self.name)
        return self.modes.mode_of(self.modes.states[self.modes.names.index(name)])
