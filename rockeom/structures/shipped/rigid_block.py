"""Closed forms of Housner's block."""

from __future__ import annotations

from typing import Self

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError
from rockeom.numbers.degrees import accepts_degrees
from rockeom.numbers.functions import mathematics
from rockeom.structures.parameters import check_slenderness, check_values
from rockeom.structures.shipped.blocks import Block
from rockeom.structures.shipped.declarations import rigid_block as declared
from rockeom.structures.shipped.offset_block import OffsetBlock


class RigidBlock(Block, declared.RigidBlock):
    full_height: float | None = None

    @classmethod
    @accepts_degrees("alpha")
    def from_frequency(
        cls,
        p: float,
        alpha: float,
        mass: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
        **others: float,
    ) -> Self:
        """The homogeneous rectangular block of frequency parameter p [rad/s] and angle alpha [rad].

        p**2 = m g R/I_o = 3 g/(4 R). others : the parameters that are left.
        """
        check_values(cls.__name__, {"p": p, "alpha": alpha, "gravity": gravity})
        check_slenderness(cls.__name__, alpha)
        radius = 0.75 * gravity / p**2
        return cls(
            half_width=radius * mathematics.sin(alpha),
            half_height=radius * mathematics.cos(alpha),
            mass=mass,
            gravity=gravity,
            **others,
        )

    @classmethod
    def from_dimensions(
        cls,
        *,
        width: float,
        height: float,
        centroid_height: float | None = None,
        offset: float = 0.0,
        mass: float = 1.0,
        inertia: float | None = None,
        gravity: float = STANDARD_GRAVITY,
        **others: float,
    ) -> Self | OffsetBlock:
        """The block of these full dimensions, as one measures them.

        width, height : of the whole block [m]. centroid_height : above the base [m]; half the
        height if not given. offset : of the centroid, to the right of the middle of the base [m];
        a block with one is an `OffsetBlock`, which overturns at another angle on each side.
        mass [kg], inertia : about the centroid [kg m2], gravity [m/s2]. others : the parameters
        that are left, such as `friction` of a `SlidingBlock`.

        The inertia is m (width**2 + height**2)/12 if not given: that of the homogeneous rectangle.
        With the centroid off the middle it is an estimate: the inertia about a foot is for three
        quarters that of the centroid's distance, so that an error of 20 % changes p by 2.5 %.
        The block keeps its height as `full_height`, for a strap and for words.

        >>> rack = RigidBlock.from_dimensions(width=0.6, height=2.0, centroid_height=0.8)
        >>> rack.alpha  # rad
        0.3587...
        >>> statue = RigidBlock.from_dimensions(width=0.6, height=1.8, offset=0.05)
        >>> statue.overturning_angles  # rad, to the left and to the right
        (0.3712..., 0.2709...)

        Raises ValueError for a centroid that is not inside the block and above its base.
        """
        name = cls.__name__
        check_values(name, {"width": width, "height": height})
        check_values(name, {"offset": offset}, may_be_negative=frozenset({"offset"}))
        up = 0.5 * height if centroid_height is None else centroid_height
        check_values(name, {"centroid_height": up})
        if not up < height:
            raise InputError("centroid_height", centroid_height, name).wrong(
                f"is {centroid_height} and height {height}: give the height of the centroid above "
                "the base, within the block [m]"
            )
        if not abs(offset) < 0.5 * width:
            raise InputError("offset", offset, name).wrong(
                f"is {offset} and width {width}: the centroid must be above the base; give its "
                "distance from the middle of the base [m], positive to the right"
            )
        size = dict(half_width=0.5 * width, half_height=up, mass=mass, gravity=gravity, **others)
        size["full_height"] = height
        if inertia is None and (offset or centroid_height is not None):
            check_values(name, {"mass": mass})
            inertia = mass * (width**2 + height**2) / 12
        if not offset:
            return cls(inertia=inertia, **size)
        if cls is not RigidBlock:
            raise InputError("offset", offset, name).so(
                f"a {name} has its centroid above the middle of its base; take "
                "RigidBlock.from_dimensions, or declare a Model whose feet slide"
            )
        return OffsetBlock(offset=offset, inertia=inertia, **size)

    @property
    def alpha(self) -> float:
        """Angle of the line from an edge to the centroid, from the vertical [rad]."""
        return mathematics.atan2(self.half_width, self.half_height)

    @property
    def radius(self) -> float:
        """Distance of the centroid from an edge, R [m]."""
        return mathematics.hypot(self.half_width, self.half_height)
