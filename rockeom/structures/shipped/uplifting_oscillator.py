"""Closed forms of the uplifting oscillator."""

from __future__ import annotations

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.structures.parameters import check_values
from rockeom.structures.shipped.declarations import uplifting_oscillator as declared


class UpliftingOscillator(declared.UpliftingOscillator):
    @classmethod
    def from_frequency(
        cls,
        angular_frequency: float,
        damping_ratio: float,
        height: float,
        half_width: float,
        mass: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
    ) -> UpliftingOscillator:
        """Oscillator whose column on a fixed base has a frequency and a damping ratio.

        Parameters
        ----------
        angular_frequency : float
            Angular frequency on a fixed base [rad/s].
        damping_ratio : float
            Part of critical damping on a fixed base.
        height : float
            Height of the mass above the base [m].
        half_width : float
            Half of the distance between the feet [m].
        mass : float, optional
            Mass [kg].
        gravity : float, optional
            Acceleration of gravity [m/s2].

        Returns
        -------
        UpliftingOscillator
            Oscillator.

        Raises
        ------
        ValueError
            For numbers that are not positive.
        """
        values = {"angular_frequency": angular_frequency, "damping_ratio": damping_ratio}
        values["mass"] = mass
        check_values("UpliftingOscillator", values, frozenset({"damping_ratio"}))
        return cls(
            mass=mass,
            height=height,
            half_width=half_width,
            stiffness=mass * angular_frequency**2,
            damping=2 * damping_ratio * angular_frequency * mass,
            gravity=gravity,
        )
