"""Structures of contacts and elements: the class that users declare."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic import valid
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


@explained.attributes()
@explained.calls()
@dataclass(frozen=True, kw_only=True)
class Model(Declared, ContactDeclaration):
    """A structure that is free to move but for its contacts and elements.

    contacts, elements : what touches, and what carries forces: a `Spring` always, others by their
        states.
    rotation : the coordinate that overturns, positive clockwise, at `overturning`.
    falls : further coordinates that do, each with the size at which it has, {coordinate: size}.
    elastic_energy, dissipation : of springs and dampers that always act and need no name; those of
        each `Spring` are added.
    forces : others that always act, each by its work along a displacement.
    rates : of each internal variable z, dz/dt, a function of coordinates, velocities and internal
        variables. Forces and the elastic energy may depend on these, whose slope by a coordinate
        is a force; its slope by z is none. An impact leaves them as they are, and so does statics.
        A response has its integral over time, too, `z_integral`, which acts on nothing.
    load_point : place of a pushover's force, whose displacement a response has.
    members : what a sketch shows between bodies.

    On a pair of `Pinned()` feet it is a rocking structure, see `reduced`.

    Raises ValueError, naming the item and the remedy, for a declaration that cannot be meant.
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
    ) -> Model:
        """A model of bodies of `sympy.physics.mechanics` that move in one plane.

        Positions follow from the points, rotations from the orientation of the frames; velocities
        and generalised speeds that were set are not used.

        bodies : each a RigidBody or a Particle, with mass, mass centre and central inertia about
            z. Their potential energy is that of springs; the weight follows from `gravity`.
        coordinates : (name, unit, meaning) of each of the `dynamicsymbols` in which points and
            frames are written, {theta: ("theta", "rad", "rotation, positive clockwise")}.
        frame, origin : a ReferenceFrame and a Point that rest on the ground, x to the right and y
            upwards. The ground's acceleration is given to `simulate`.
        parameters : (name, unit, meaning) of each symbol, {m: ("mass", "kg", "mass")}.
        gravity : its acceleration [m/s2], positive; it acts along -y.
        rotation : the one of `coordinates` that overturns.
        contacts : points above level ground, y = 0, with their laws, {"left": (Point, Rigid())};
            or objects of `Contact`, such as those of `feet`.
        outlines : what a sketch shows, {body: corners}, from the mass centre, in axes that are x
            and y where all coordinates are zero.
        declared : the other arguments of `Model`, of which `name` and `title` are needed. They may
            contain the coordinates, as may `contacts`; a Point gives a place.

        Raises ValueError, naming the item and the remedy, for what moves out of the plane or from
        a point that moves, for functions of time that are no coordinates, and for symbols that
        `parameters` lacks.

            Model.from_mechanics(
                [block], {x: ("x", "m", "place"), y: ("y", "m", "height"), theta: ...},
                name="block", title="A block", frame=N, origin=O, rotation=theta, gravity=g,
                parameters={m: ("mass", "kg", "mass"), ...},
                contacts={"left": (A, Rigid()), "right": (B, Rigid())},
            )
        """
        writer = mechanics.Writer(declared.get("name", "model"), coordinates, frame, origin)
        declared |= {"gravity": gravity, "rotation": rotation}
        return cls(**writer.declaration(bodies, parameters, contacts, outlines or {}, declared))

    def __post_init__(self) -> None:
        for name in _LISTS:
            object.__setattr__(self, name, tuple(getattr(self, name)))
        check_items(self)
        check(self._searched)
        _ = self.reduced

    @cached_property
    def reduced(self) -> Model | RockingModel:
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
            falls=self.falls,
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
        return search.modes

    def mode(self, name: str) -> DerivedMode:
        """The equations of a mode, such as "right_slides_left".

        Raises ValueError, naming the modes, if there is none of that name.
        """
        valid.known(self.name, "mode", name, self.modes.names)
        return self.modes.mode_of(self.modes.states[self.modes.names.index(name)])
