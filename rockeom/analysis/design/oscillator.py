"""An oscillator with any backbone or rule of hysteresis, and any damping (thesis 4.9.1.4).

    import rockeom as rk
    from rockeom.analysis import design

    wall = rk.analysis.Wall.thesis()
    softer = design.linear_start(wall.restoring_force, displacement=2e-3)
    viscous = design.ViscousDamping(4e3, below=5e-3)
    passages = design.PassageDamping(0.852, width=3.55e-3)
    oscillator = design.EquivalentOscillator(wall.mass, softer, (viscous, passages))
    record = rk.GroundMotion.from_library("El Centro 1940 180")
    run = oscillator.response(record)
    run.time, run.displacement  # s, m

The equation is M x'' + F_k(x) + F_D(x, x') = -M a_g, thesis 4-41. A backbone is a function of the
user's, not of symbols, so this oscillator is no declared structure: it is integrated here by the
classical method of order 4 with equal steps. Where the force has corners the error falls with the
square of the step: halve it to estimate the error. `ControlledWallOscillator` is the compiled
structure for the backbone of a wall.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.design.hysteresis import FlagRule, HysteresisRule
from rockeom.motion import GroundMotion
from rockeom.numbers.checks import (
    InputError,
    InputTypeError,
    described,
    not_negative,
    numbers,
    positive,
    require,
)
from rockeom.structures.base import Structure

Force = Callable[[np.ndarray], np.ndarray]
"""Displacements [m] to restoring forces [N], both (n,)."""

_SMALL = 1e-7
"""Step of the differences that give the tangent stiffness [m]."""


# --- backbones


def _check_force(where: str, force: Force | HysteresisRule) -> None:
    """Raise TypeError for the pushover of a structure, whose argument is a rotation."""
    if isinstance(getattr(force, "__self__", None), Structure):
        raise InputTypeError("force", force, where).wrong(
            f"is {described(force)}, a function of rotations [rad]: give one of displacements [m], "
            "as lambda u: structure.pushover(u / height)"
        )


def linear_start(force: Force, displacement: float) -> Force:
    """Backbone that starts with a straight line, as in the first trial of 4.9.1.4.

    Parameters
    ----------
    force : callable
        Force F_k [N] of displacements (n,) [m].
    displacement : float
        Displacement up to which the line goes, from the origin to the force there, on either side
        [m]; positive.

    Returns
    -------
    callable
        Force [N] of displacements (n,) [m].

    Raises
    ------
    ValueError
        For a displacement that is not positive.
    """
    _check_force("linear_start", force)
    (end,) = positive("linear_start", displacement=displacement)
    ends = np.array([-end, end])
    slopes = np.asarray(force(ends), dtype=float) / ends

    def straight(u: np.ndarray) -> np.ndarray:
        return np.where(np.abs(u) < end, np.where(u < 0, *slopes) * u, force(u))

    return straight


def tabulated(force: Force, largest: float, points: int = 4001) -> Force:
    """Backbone by straight lines between its points, which is faster for costly ones.

    Parameters
    ----------
    force : callable
        Force F_k [N] of displacements (n,) [m].
    largest : float
        Displacement up to which it is tabulated on either side [m]; beyond it the force stays.
    points : int, optional
        Number of points on both sides together, evenly apart.

    Returns
    -------
    callable
        Force [N] of displacements (n,) [m].

    Raises
    ------
    ValueError
        For a displacement that is not positive.
    """
    _check_force("tabulated", force)
    (end,) = positive("tabulated", largest=largest)
    table = np.linspace(-end, end, points)
    forces = np.asarray(force(table), dtype=float)
    return lambda u: np.interp(u, table, forces)


def bilinear_fit(force: Force, largest: float, points: int = 400) -> FlagRule:
    """Bilinear backbone nearest to another one, as in the third trial of 4.9.1.4.

    Parameters
    ----------
    force : callable
        Force F_k [N] of displacements (n,) [m].
    largest : float
        Displacement up to which the two agree [m].
    points : int, optional
        Number of points at which the sum of the squares of the differences is least.

    Returns
    -------
    FlagRule
        Rule without a flag, which loses nothing: its `FlagRule.backbone` is the force.

    Raises
    ------
    ValueError
        For a backbone that softens so much that it falls after yield.
    """
    from scipy.optimize import minimize_scalar  # takes long to import

    _check_force("bilinear_fit", force)
    (end,) = positive("bilinear_fit", largest=largest)
    u = end * np.arange(1, points + 1) / points
    wanted = np.asarray(force(u), dtype=float)

    def fitted(yields: float) -> tuple[np.ndarray, float]:
        basis = np.array([np.minimum(u, yields) / yields, np.maximum(u - yields, 0.0)]).T
        coefficients = np.linalg.lstsq(basis, wanted)[0]
        return coefficients, float(((basis @ coefficients - wanted) ** 2).sum())

    # the least of a scan first: the sum need not have one minimum only
    scanned = min(u[:-1], key=lambda y: fitted(y)[1])
    near = scanned + np.array([-1.0, 1.0]) * end / points
    bounds = (max(near[0], 1e-3 * end / points), min(near[1], end))
    yields = float(minimize_scalar(lambda y: fitted(y)[1], bounds=bounds, method="bounded").x)
    (strength, after), _ = fitted(yields)
    ratio = after * yields / strength
    rule = "the backbone falls: there is no bilinear one for it; give a smaller `largest`"
    require(ratio >= 0, "bilinear_fit", "force", ratio, rule)
    return FlagRule(float(strength), yields, float(ratio))


# --- damping


class Damping(Protocol):
    """Force against the motion of an oscillator that knows its stiffness."""

    def force(
        self, mass: float, u: np.ndarray, v: np.ndarray, tangent: Callable[[], np.ndarray]
    ) -> np.ndarray:
        """Force on the mass, against the motion.

        Parameters
        ----------
        mass : float
            Mass [kg].
        u : ndarray
            Displacements (n,) [m].
        v : ndarray
            Velocities (n,) [m/s].
        tangent : callable
            Function without arguments that gives the tangent stiffness (n,) [N/m].

        Returns
        -------
        ndarray
            Force (n,) [N].
        """
        ...


@dataclass(frozen=True)
class ViscousDamping:
    """Damping c x' below a displacement; the second and third trial of 4.9.1.4.

    Parameters
    ----------
    coefficient : float
        Coefficient c [N s/m].
    below : float, optional
        Size of the displacement below which it acts [m].
    """

    coefficient: float
    below: float = math.inf

    def __post_init__(self) -> None:
        not_negative("ViscousDamping", coefficient=self.coefficient)
        rule = "it must be positive, in metres"
        require(self.below > 0, "ViscousDamping", "below", self.below, rule)

    @classmethod
    def of_ratio(cls, ratio: float, mass: float, period: float, below: float = math.inf) -> Self:
        """Damping with the coefficient c = 4 pi xi M/T.

        Parameters
        ----------
        ratio : float
            Ratio xi of the critical damping.
        mass : float
            Mass M [kg].
        period : float
            Period T [s].
        below : float, optional
            Size of the displacement below which it acts [m].

        Returns
        -------
        ViscousDamping
            Viscous damping.

        Raises
        ------
        ValueError
            For numbers that are not positive.
        """
        ratio_, mass_, period_ = positive("ViscousDamping", ratio=ratio, mass=mass, period=period)
        return cls(float(4 * np.pi * ratio_ * mass_ / period_), below)

    def force(
        self, mass: float, u: np.ndarray, v: np.ndarray, tangent: Callable[[], np.ndarray]
    ) -> np.ndarray:
        """Force on the mass, against the motion.

        Parameters
        ----------
        mass : float
            Mass [kg].
        u : ndarray
            Displacements (n,) [m].
        v : ndarray
            Velocities (n,) [m/s].
        tangent : callable
            Function that gives the tangent stiffness; not called.

        Returns
        -------
        ndarray
            Force (n,) [N].
        """
        return np.where(np.abs(u) < self.below, self.coefficient * v, 0.0)


@dataclass(frozen=True)
class TangentDamping:
    """Damping in proportion to the tangent stiffness, a k_t x'; the fourth trial of 4.9.1.4.

    Parameters
    ----------
    factor : float
        Factor a [s]. Where the backbone falls there is no damping: k_t counts from zero.
    """

    factor: float

    def __post_init__(self) -> None:
        not_negative("TangentDamping", factor=self.factor)

    @classmethod
    def of_ratio(cls, ratio: float, period: float) -> Self:
        """Damping with the factor a = xi T/pi.

        Parameters
        ----------
        ratio : float
            Ratio xi of the critical damping.
        period : float
            Period T at which it is xi [s].

        Returns
        -------
        TangentDamping
            Damping in proportion to the tangent stiffness.

        Raises
        ------
        ValueError
            For numbers that are not positive.
        """
        ratio_, period_ = positive("TangentDamping", ratio=ratio, period=period)
        return cls(float(ratio_ * period_ / np.pi))

    def force(
        self, mass: float, u: np.ndarray, v: np.ndarray, tangent: Callable[[], np.ndarray]
    ) -> np.ndarray:
        """Force on the mass, against the motion.

        Parameters
        ----------
        mass : float
            Mass [kg].
        u : ndarray
            Displacements (n,) [m].
        v : ndarray
            Velocities (n,) [m/s].
        tangent : callable
            Function without arguments that gives the tangent stiffness (n,) [N/m].

        Returns
        -------
        ndarray
            Force (n,) [N].
        """
        return self.factor * np.maximum(tangent(), 0.0) * v


@dataclass(frozen=True)
class PassageDamping:
    """Loss at each passage through upright, by Dirac's delta of a width; thesis 4-27, 4-28.

    Parameters
    ----------
    energy_ratio : float or callable
        Energy ratio r of a passage: a number in (0, 1], or a function of the speeds (n,) [m/s] such
        as `energy_ratio_4_31`.
    width : float
        Width n of the smoothed delta [m].

    Notes
    -----
    The force is ``-M ln(sqrt(r))/(n sqrt(pi)) v**2 exp(-(x/n)**2) sgn(v)``.
    """

    energy_ratio: float | Callable[[np.ndarray], np.ndarray]
    width: float

    def __post_init__(self) -> None:
        positive("PassageDamping", width=self.width)
        if not callable(self.energy_ratio):
            (r,) = positive("PassageDamping", energy_ratio=self.energy_ratio)
            require(r <= 1, "PassageDamping", "energy_ratio", r, "more than 1 would add energy")

    def force(
        self, mass: float, u: np.ndarray, v: np.ndarray, tangent: Callable[[], np.ndarray]
    ) -> np.ndarray:
        """Force on the mass, against the motion.

        Parameters
        ----------
        mass : float
            Mass [kg].
        u : ndarray
            Displacements (n,) [m].
        v : ndarray
            Velocities (n,) [m/s].
        tangent : callable
            Function that gives the tangent stiffness; not called.

        Returns
        -------
        ndarray
            Force (n,) [N].
        """
        r = self.energy_ratio(np.abs(v)) if callable(self.energy_ratio) else self.energy_ratio
        gaussian = np.exp(-((u / self.width) ** 2)) / (self.width * math.sqrt(math.pi))
        return -mass * np.log(r) / 2 * gaussian * v * np.abs(v)


# --- the oscillator


class OscillatorResponse(NamedTuple):
    """Response of an equivalent oscillator to one motion or to m of them.

    Parameters
    ----------
    time : ndarray
        Instants (n,) [s].
    displacement : ndarray
        Displacement relative to the ground (n,) or (n, m) [m].
    velocity : ndarray
        Velocity relative to the ground (n,) or (n, m) [m/s].
    force : ndarray
        Restoring force (n,) or (n, m) [N].
    """

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    force: np.ndarray

    @property
    def peak(self) -> np.ndarray:
        """Largest size of the displacement of each motion [m]."""
        return np.abs(self.displacement).max(axis=0)


@dataclass(frozen=True)
class EquivalentOscillator:
    """Oscillator M x'' + F_k(x) + F_D(x, x') = -M a_g; thesis 4-41.

    Parameters
    ----------
    mass : float
        Mass M [kg].
    force : callable or HysteresisRule
        Restoring force F_k [N]: a function of displacements (n,) [m], such as
        `Wall.restoring_force`, or a `HysteresisRule`.
    damping : tuple of Damping, optional
        Dampings whose forces are added: none, one or several, such as `ViscousDamping`,
        `TangentDamping` and `PassageDamping`.

    Raises
    ------
    ValueError
        For a mass that is not positive.
    """

    mass: float
    force: Force | HysteresisRule
    damping: tuple[Damping, ...] = ()

    def __post_init__(self) -> None:
        positive("EquivalentOscillator", mass=self.mass)
        _check_force("EquivalentOscillator", self.force)
        if not callable(self.force) and not isinstance(self.force, HysteresisRule):
            raise InputError("force", self.force, "EquivalentOscillator").give(
                "a function of the displacement or a rule of hysteresis"
            )

    def response(
        self,
        motions: GroundMotion | Sequence[GroundMotion],
        *,
        initial: ArrayLike = (0.0, 0.0),
        duration: float | None = None,
        step: float = 1e-3,
    ) -> OscillatorResponse:
        """Motion under one or several ground motions, side by side.

        Parameters
        ----------
        motions : GroundMotion or sequence of GroundMotion
            One ground motion, or m of them, of which each has its column.
        initial : array_like, optional
            Displacement [m] and velocity [m/s] at the start.
        duration : float, optional
            Duration [s]; that of the longest motion if not given.
        step : float, optional
            Time step [s].

        Returns
        -------
        OscillatorResponse
            Displacements, velocities and forces, (n,) of one motion or (n, m).

        Raises
        ------
        ValueError
            For a step or a duration that is not positive.
        ArithmeticError
            Where the displacement is no longer finite.
        """
        several = [motions] if isinstance(motions, GroundMotion) else list(motions)
        (step_,) = positive("EquivalentOscillator.response", step=step)
        (start,) = numbers("EquivalentOscillator.response", initial=initial)
        end = max(m.duration for m in several) if duration is None else duration
        count = math.ceil(end / float(step_) * (1 - 1e-12))
        h, halves = float(step_), float(step_) / 2 * np.arange(2 * count + 1)
        ground = np.array([m.acceleration(halves) for m in several]).T
        u, v = (np.full(len(several), float(x)) for x in start)
        memory = self.force.start(len(several)) if isinstance(self.force, HysteresisRule) else None
        recorded = np.empty((3, count + 1, len(several)))
        recorded[:, 0] = u, v, self._restoring(memory, u)[0]
        for i in range(count):
            a_0, a_1, a_2 = ground[2 * i : 2 * i + 3]
            k1 = self._acceleration(memory, u, v, a_0)
            v2 = v + h / 2 * k1
            k2 = self._acceleration(memory, u + h / 2 * v, v2, a_1)
            v3 = v + h / 2 * k2
            k3 = self._acceleration(memory, u + h / 2 * v2, v3, a_1)
            v4 = v + h * k3
            k4 = self._acceleration(memory, u + h * v3, v4, a_2)
            u = u + h / 6 * (v + 2 * v2 + 2 * v3 + v4)
            v = v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            f, memory = self._restoring(memory, u)
            recorded[:, i + 1] = u, v, f
        if not np.isfinite(u).all():
            raise ArithmeticError(
                "EquivalentOscillator.response: the displacement is no longer finite: the step of "
                f"{h} s is too long, or the force does not pull back"
            )
        parts = recorded[..., 0] if isinstance(motions, GroundMotion) else recorded
        return OscillatorResponse(h * np.arange(count + 1), *parts)

    def _restoring(
        self, memory: np.ndarray | None, u: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray | None]:
        if isinstance(self.force, HysteresisRule):
            assert memory is not None
            return self.force.step(memory, u)
        return np.asarray(self.force(u)), None

    def _acceleration(
        self, memory: np.ndarray | None, u: np.ndarray, v: np.ndarray, ground: np.ndarray
    ) -> np.ndarray:
        force = self._restoring(memory, u)[0]

        def tangent() -> np.ndarray:
            ahead = _SMALL * np.where(v < 0, -1.0, 1.0)
            return (self._restoring(memory, u + ahead)[0] - force) / ahead

        against = sum((d.force(self.mass, u, v, tangent) for d in self.damping), start=force)
        return -ground - against / self.mass
