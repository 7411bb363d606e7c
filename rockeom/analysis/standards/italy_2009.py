"""Italian instructions of 2009: a part of a masonry building that turns as a kinematic chain.

The text was not at hand. Second-hand are the form of the linear check and its factor q = 2, and the
factors 0.4 of the non-linear one.
"""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.standards.check import (
    Check,
    Shaking,
    check_block,
    non_negative,
    peak_acceleration,
    spectral_displacement,
)
from rockeom.motion.scaling import Acceleration
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, array_of, positive_number, require
from rockeom.structures.classes import RigidBlock

_SOURCE = "Italian instructions of 2009, second-hand"
_ULTIMATE = _SECANT = 0.4
_DAMPING = 0.05


@dataclass(frozen=True, eq=False)
class KinematicChain:
    """Rigid parts that turn together, as the Italian instructions describe a wall that gives way.

    Parameters
    ----------
    multiplier : float
        Part alpha0 of the weights that, as horizontal forces, lets the chain move.
    weights : array_like
        Weights P (n,) [N].
    displacements : array_like
        Horizontal virtual displacements d of the weights (n,), of any scale.
    confidence_factor : float, optional
        Confidence factor FC.
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Notes
    -----
    ``M* = (sum P d)**2/(g sum P d**2)``, ``e* = g M*/sum P``, ``a0* = alpha0 g/(e* FC)``, so that
    the base shear of the participating mass is that of all weights, ``M* a0* = alpha0 sum P``.

    By virtual work, derived here, rigid ground moves a rigid chain from ``alpha0 g`` on, whatever
    its parts. With several parts a0* exceeds that by 1/e*, with one they agree.
    """

    multiplier: float
    weights: ArrayLike
    displacements: ArrayLike
    confidence_factor: float = 1.0
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        for name in ("multiplier", "confidence_factor", "gravity"):
            positive_number(name, getattr(self, name), "KinematicChain")
        p, d = self._rows()
        if p.ndim != 1 or p.shape != d.shape or not p.size:
            raise InputError("weights", of="KinematicChain").wrong(
                f"have the shape {p.shape} and displacements {d.shape}: give one of each for a part"
            )
        require((p > 0.0) & np.isfinite(p), "KinematicChain", "weights", p, "give positive weights")
        require(np.isfinite(d), "KinematicChain", "displacements", d, "give finite numbers")
        rule = "give those of the direction that is checked, positive on the whole"
        require(bool(p @ d > 0.0), "KinematicChain", "displacements", d, rule)

    def _rows(self) -> tuple[np.ndarray, np.ndarray]:
        return array_of("weights", self.weights), array_of("displacements", self.displacements)

    @classmethod
    def from_block(cls, block: RigidBlock, confidence_factor: float = 1.0) -> Self:
        """Chain of a block that turns about an edge: alpha0 is b/h.

        Parameters
        ----------
        block : RigidBlock
            Block.
        confidence_factor : float, optional
            Confidence factor FC.

        Returns
        -------
        KinematicChain
            Chain with one weight, so that e* is 1.

        Raises
        ------
        InputError
            For another structure.
        """
        check_block("KinematicChain.from_block", block)
        slender = float(block.half_width / block.half_height)
        weight = float(block.mass * block.gravity)
        return cls(slender, [weight], [1.0], confidence_factor, float(block.gravity))

    @property
    def mass(self) -> float:
        """Participating mass M* [kg]."""
        p, d = self._rows()
        return float((p @ d) ** 2 / (self.gravity * (p @ d**2)))

    @property
    def mass_fraction(self) -> float:
        """Participating mass over the whole, e*."""
        return float(self.gravity * self.mass / self._rows()[0].sum())

    @property
    def activation(self) -> float:
        """Spectral acceleration a0* of the instructions, at which the chain moves [m/s2]."""
        return self.multiplier * self.gravity / (self.mass_fraction * self.confidence_factor)


def italy_2009_linear(
    chain: KinematicChain, ground_acceleration: Acceleration, *, q: float = 2.0
) -> Check:
    """Linear check of a chain that stands on the ground, by the Italian instructions of 2009.

    Parameters
    ----------
    chain : KinematicChain
        Chain.
    ground_acceleration : float or str
        Peak acceleration a_g S on the soil, a number [m/s2] or a text with its unit.
    q : float, optional
        Behaviour factor.

    Returns
    -------
    Check
        Demand ``a_g S/q`` and capacity a0* [m/s2].

    Raises
    ------
    InputError
        For numbers that cannot be.

    See Also
    --------
    italy_2009_aloft : That of a chain higher up.

    Notes
    -----
    Form and q are second-hand; the text was not at hand. A rigid chain of several parts moves
    before a0*, see `KinematicChain`.
    """
    where = "italy_2009_linear"
    shaking = peak_acceleration(where, "ground_acceleration", ground_acceleration)
    return _linear("Italy 2009, linear", chain, shaking, positive_number("q", q, where))


def italy_2009_aloft(
    chain: KinematicChain,
    spectral_acceleration: Acceleration,
    *,
    height_ratio: float,
    participation: float,
    q: float = 2.0,
) -> Check:
    """Linear check of a chain above the ground, by the Italian instructions of 2009.

    Parameters
    ----------
    chain : KinematicChain
        Chain.
    spectral_acceleration : float or str
        Elastic spectrum S_e(T1) at the first period of the building, a number [m/s2] or a text with
        its unit.
    height_ratio : float
        psi = Z/H, the height of the chain's hinge over that of the building, between 0 and 1.
    participation : float
        Participation factor gamma of the first mode.
    q : float, optional
        Behaviour factor.

    Returns
    -------
    Check
        Demand ``S_e(T1) psi gamma/q`` and capacity a0* [m/s2].

    Raises
    ------
    InputError
        For numbers that cannot be.

    Notes
    -----
    Form, psi and q are second-hand; the text was not at hand. Near the ground the demand vanishes
    with psi: check such a chain by `italy_2009_linear`, too.
    """
    where = "italy_2009_aloft"
    shaking = peak_acceleration(where, "spectral_acceleration", spectral_acceleration)
    psi = non_negative(where, "height_ratio", height_ratio)
    require(psi <= 1.0, where, "height_ratio", psi, "give at most 1, that of the top")
    gamma = positive_number("participation", participation, where)
    demand = shaking * psi * gamma
    return _linear("Italy 2009, aloft", chain, demand, positive_number("q", q, where))


def _linear(name: str, chain: KinematicChain, shaking: float, q: float) -> Check:
    demand, capacity = shaking / q, chain.activation
    verdict = "not satisfied" if demand > capacity else "satisfied"
    return Check(name, "acceleration over q", demand, capacity, "m/s2", verdict, _SOURCE)


def italy_2009_nonlinear(
    chain: KinematicChain, ultimate_displacement: float, shaking: Shaking
) -> Check:
    """Non-linear check of a chain on the ground, by the Italian instructions of 2009.

    Parameters
    ----------
    chain : KinematicChain
        Chain.
    ultimate_displacement : float
        Spectral displacement d0* at which the chain resists no more [m]; for a block its half-width
        b, since the centroid is above the edge there.
    shaking : GroundMotion or callable or DesignSpectrum
        Horizontal motion; or a function of period [s] and damping ratio that gives the displacement
        [m]; or a `DesignSpectrum`. The damping is 5 %.

    Returns
    -------
    Check
        Demand S_De(T_s) and capacity d_u [m].

    Raises
    ------
    InputError
        For numbers that cannot be, and a spectrum without the period T_s.

    Notes
    -----
    ``a* = a0* (1 - d/d0*)``, ``d_u = 0.4 d0*``, ``d_s = 0.4 d_u``, ``T_s = 2 pi sqrt(d_s/a_s)``
    with a_s = a*(d_s), and the check is ``d_u >= S_De(T_s)``. Both factors 0.4 are second-hand; the
    text was not at hand. A chain aloft needs a spectrum of its floor, which is left out.
    """
    where = "italy_2009_nonlinear"
    largest = positive_number("ultimate_displacement", ultimate_displacement, where)
    capacity = _ULTIMATE * largest
    secant = _SECANT * capacity
    force = chain.activation * (1.0 - secant / largest)
    period = 2.0 * math.pi * math.sqrt(secant / force)
    demand = spectral_displacement(shaking, period, _DAMPING)
    verdict = "not satisfied" if demand > capacity else "satisfied"
    name = "Italy 2009, non-linear"
    return Check(name, "displacement", demand, capacity, "m", verdict, _SOURCE)
