"""Closed forms of Housner's block."""

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
        """Homogeneous rectangular block of a frequency parameter and a slenderness.

        Parameters
        ----------
        p : float
            Frequency parameter [rad/s], ``p**2 = m g R/I_o = 3 g/(4 R)``.
        alpha : float
            Slenderness, atan(half_width/half_height) [rad].
        mass : float, optional
            Mass [kg].
        gravity : float, optional
            Acceleration of gravity [m/s2].
        **others : float
            Other parameters of the class, by name.

        Returns
        -------
        RigidBlock
            Block.

        Raises
        ------
        ValueError
            For numbers that are not positive, and a slenderness outside (0, pi/2).

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)  # rad/s, rad
        >>> round(block.radius, 3)  # m
        1.607
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
        """Block of full dimensions, as one measures them.

        The block keeps its height as `full_height`, for a strap and for words.

        Parameters
        ----------
        width : float
            Width of the whole block [m].
        height : float
            Height of the whole block [m].
        centroid_height : float, optional
            Height of the centroid above the base [m]; half the height if not given.
        offset : float, optional
            Distance of the centroid to the right of the middle of the base [m]; a block with one is
            an `OffsetBlock`, which overturns at another angle on each side.
        mass : float, optional
            Mass m [kg].
        inertia : float, optional
            Moment of inertia about the centroid [kg m2]; ``m (width**2 + height**2)/12``, that of
            the homogeneous rectangle, if not given.
        gravity : float, optional
            Acceleration of gravity [m/s2].
        **others : float
            Other parameters of the class, by name, such as `friction` of a `SlidingBlock`.

        Returns
        -------
        RigidBlock or OffsetBlock
            Block.

        Raises
        ------
        ValueError
            For a centroid that is not inside the block and above its base.

        Notes
        -----
        With the centroid off the middle the inertia is an estimate: the inertia about a foot is for
        three quarters that of the centroid's distance, so that an error of 20 % changes p by 2.5 %.

        Examples
        --------
        >>> import rockeom as rk
        >>> rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, centroid_height=0.8)  # m
        >>> rack.alpha  # rad
        0.3587...
        >>> statue = rk.RigidBlock.from_dimensions(width=0.6, height=1.8, offset=0.05)  # m
        >>> statue.overturning_angles  # rad, to the left and to the right
        (0.3708..., 0.2709...)
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
