"""Closed forms of the linearised block."""

from __future__ import annotations

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.degrees import accepts_degrees
from rockeom.structures.parameters import check_values
from rockeom.structures.shipped.blocks import Block
from rockeom.structures.shipped.declarations import slender_block as declared


class SlenderBlock(Block, declared.SlenderBlock):
    @classmethod
    @accepts_degrees("alpha")
    def from_frequency(
        cls, p: float, alpha: float, mass: float = 1.0, gravity: float = STANDARD_GRAVITY
    ) -> SlenderBlock:
        """Rectangular block of a frequency parameter and a slenderness.

        Parameters
        ----------
        p : float
            Frequency parameter [rad/s].
        alpha : float
            Slenderness [rad].
        mass : float, optional
            Mass [kg].
        gravity : float, optional
            Acceleration of gravity [m/s2].

        Returns
        -------
        SlenderBlock
            Block.

        Raises
        ------
        ValueError
            For numbers that are not positive.
        """
        check_values("SlenderBlock", {"p": p, "alpha": alpha, "gravity": gravity})
        return cls(radius=0.75 * gravity / p**2, alpha=alpha, mass=mass, gravity=gravity)
