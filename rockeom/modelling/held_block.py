"""`HeldBlock`: a statue, rack or parapet that straps, anchors or putty hold until they break."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterator
from typing import Any, ClassVar

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.parameters import check_contact_law
from rockeom.structures.restraints import Strap, attach, kinds_of, parameters_of
from rockeom.structures.shipped.offset_block import OffsetBlock


class HeldBlock(StructureWithFields):
    """Rigid block whose feet open, stick, slip and bounce, held until its restraints break.

    The states are the place `x` and the height `y` of the middle of the base [m], `theta` [rad],
    their rates, and of each tie its permanent extension and whether it has broken.

    Parameters
    ----------
    width : float
        Width of the base [m].
    height : float
        Height of the whole block [m].
    mass : float
        Mass [kg].
    friction : float
        Coefficient of friction at each foot.
    restitution : float, optional
        Ratio of the rates of a foot's gap after and before it lands alone, 0 to 1.
    centroid_height : float, optional
        Height of the centroid above the base [m]; half of the height if not given.
    centroid_offset : float, optional
        Place of the centroid to the right of the middle of the base [m].
    inertia : float, optional
        Moment of inertia about the centroid [kg m2]; that of a homogeneous rectangle if not given.
    corner_radius : float, optional
        Radius of the lower corners, which roll [m].
    base_radius : float, optional
        Radius of a round base, on which the block rolls [m]; None for a flat one. A block that
        comes to the edge of its round base counts as overturned.
    wall_gap : float, optional
        Gap between the block and a smooth wall on its right, which its upper corner may strike [m].
        One that slides there upright would strike with its whole face, which is not modelled.
    wall_restitution : float, optional
        Ratio of the speeds after and before the corner strikes the wall, 0 to 1.
    restraint : sequence of Strap or Anchor, optional
        Restraints.
    loads : sequence of Push, optional
        Forces of time.
    contact_law : str, optional
        Impact law of feet that touch, as of `Sliding`.
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For numbers out of their ranges, corners wider than the base, and rounded corners of a round
        base.

    Notes
    -----
    The equations of each set of restraints are derived at their first use (some seconds, once on a
    machine).

    Examples
    --------
    >>> import rockeom as rk
    >>> statue = rk.HeldBlock(
    ...     width=0.5, height=1.8, mass=300.0, friction=0.5,
    ...     restraint=rk.Strap(at=(-0.2, 1.6), to=(-0.6, 1.6), stiffness=2e5),
    ... )  # m, m, kg, -, N/m
    >>> statue.states[:3]
    ('x', 'y', 'theta')
    """

    model: ClassVar[str] = "held_block"
    arguments: ClassVar = {"half_width": "width", "full_height": "height"}
    may_vanish = frozenset(
        {"friction", "restitution", "corner_radius", "centroid_offset", "wall_restitution"}
    )
    may_be_negative = frozenset({"centroid_offset"})
    not_numbers = frozenset({"restraint", "loads", "contact_law"})
    width: float
    height: float
    mass: float
    friction: float
    restitution: float = 0.0
    centroid_height: float | None = None
    centroid_offset: float = 0.0
    inertia: float | None = None
    corner_radius: float = 0.0
    base_radius: float | None = None
    wall_gap: float | None = None
    wall_restitution: float = 0.0
    restraint: Any = ()
    loads: Any = ()
    contact_law: str = "newton"
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        attach(self)
        check_contact_law("HeldBlock", self.restitution, self.contact_law)
        check_contact_law("HeldBlock", self.wall_restitution, self.contact_law)
        if self.base_radius is not None and self.corner_radius:
            raise InputError("corner_radius", self.corner_radius, "HeldBlock").so(
                "a round base has no corners: leave one of both out"
            )
        if self.base_radius is not None and not self.base_radius >= self.width / 2:
            raise InputError("base_radius", self.base_radius, "HeldBlock").give(
                f"half of the width, {self.width / 2:g} m, or more"
            )
        if not self.corner_radius < self.width / 2:
            raise InputError("corner_radius", self.corner_radius, "HeldBlock").give(
                f"less than half of the width, {self.width / 2:g} m"
            )
        if not abs(self.centroid_offset) < self.width / 2 - self.corner_radius:
            raise InputError("centroid_offset", self.centroid_offset, "HeldBlock").give(
                "a place between the feet, or it falls by itself"
            )

    @property
    def derivation(self) -> dict[str, Any]:
        return (
            kinds_of(*self.restraint, *self.loads)
            | ({} if self._corners == "sharp" else {"corners": self._corners})
            | ({} if self.wall_gap is None else {"wall": True})
            | ({} if self.contact_law == "newton" else {"law": self.contact_law})
        )

    @property
    def full_height(self) -> float:
        """Height of the whole block [m]."""
        return self.height

    @property
    def unrestrained(self) -> OffsetBlock | None:
        if self.base_radius is not None:
            return None
        values = self.parameters()
        return OffsetBlock(
            half_width=self.width / 2 - self.corner_radius, half_height=values["centroid_height"],
            offset=self.centroid_offset, mass=self.mass, inertia=values["inertia"],
            gravity=self.gravity,
        )  # fmt: skip

    def changed(self, wider: float, lower: float) -> Iterator[tuple[str, HeldBlock]]:
        """Blocks of the same mass and inertia with another base and centroid, and the change.

        Parameters
        ----------
        wider : float
            Width that the base gains [m].
        lower : float
            Part of its height by which the centroid is lowered.

        Yields
        ------
        tuple of (str, HeldBlock)
            Change in words, and the changed block.
        """
        own = dataclasses.replace(self, inertia=self.parameters()["inertia"])
        base = dataclasses.replace(own, width=self.width + wider)
        yield f"A base {100 * wider:g} cm wider, half of it on each side", base
        height = (1.0 - lower) * self.parameters()["centroid_height"]
        yield (
            f"A centroid {100 * lower:g} % lower",
            dataclasses.replace(own, centroid_height=height),
        )

    def strapped(self, height: float, stiffness: float) -> HeldBlock:
        """The block with a strap to either side, and no other restraint.

        Parameters
        ----------
        height : float
            Height of the straps, which are as long as the base is wide [m].
        stiffness : float
            Stiffness of each [N/m].

        Returns
        -------
        HeldBlock
            Strapped block.
        """
        straps = [
            Strap(
                at=(side * self.width / 2, height), to=(1.5 * side * self.width, height),
                stiffness=stiffness, name=f"strap_{name}",
            )
            for side, name in ((-1, "left"), (1, "right"))
        ]  # fmt: skip
        return dataclasses.replace(self, restraint=straps)

    @property
    def _corners(self) -> str:
        if self.base_radius is not None:
            return "round base"
        return "rounded" if self.corner_radius else "sharp"

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module of these restraints and corners."""
        return module_of(self.model, **self.derivation)

    def parameters(self) -> dict[str, float]:
        inertia = self.mass * (self.width**2 + self.height**2) / 12
        values = {
            "mass": self.mass,
            "half_width": self.width / 2,
            "centroid_height": self.height / 2
            if self.centroid_height is None
            else self.centroid_height,
            "centroid_offset": self.centroid_offset,
            "full_height": self.height,
            "inertia": inertia if self.inertia is None else self.inertia,
            "gravity": self.gravity,
            "friction": self.friction,
            "restitution": self.restitution,
        }
        if self.corner_radius:
            values["corner_radius"] = self.corner_radius
        if self.base_radius is not None:
            values["base_radius"] = self.base_radius
        if self.wall_gap is not None:
            values |= {"wall_gap": self.wall_gap, "wall_restitution": self.wall_restitution}
        return values | parameters_of(*self.restraint, *self.loads)
