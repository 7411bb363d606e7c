"""Formulas of thesis chapter 4 for the wall of its tests: gauges, quarter periods, restitution.

The numbers in them were fitted to that wall, so that they serve no other.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import not_negative, numbers, positive, require
from rockeom.structures.impact_laws import EnergyRatioAtSpeed


class EdgeUplifts(NamedTuple):
    """Uplifts at both edges of a wall.

    Parameters
    ----------
    left : ndarray
        Uplift of the left edge [m].
    right : ndarray
        Uplift of the right edge [m].
    centre_from_left_gauge : ndarray
        Place without uplift, from the left gauge [m].
    """

    left: np.ndarray
    right: np.ndarray
    centre_from_left_gauge: np.ndarray


def corrected_uplifts(
    left: ArrayLike, right: ArrayLike, spacing: float = 1.076, overhang: float = 0.030
) -> EdgeUplifts:
    """Uplifts at the edges of a wall whose gauges stand outside it; thesis 4-1 to 4-4.

    Parameters
    ----------
    left : array_like
        Readings u_L of the left gauge, positive upwards [m].
    right : array_like
        Readings u_R of the right gauge, positive upwards [m].
    spacing : float, optional
        Distance of the gauges [m]; that of the thesis if not given.
    overhang : float, optional
        Distance of each gauge beyond the edge [m]; that of the thesis if not given.

    Returns
    -------
    EdgeUplifts
        Uplifts, in the shape of the readings, broadcast.

    Notes
    -----
    The base stays straight, so that x = spacing u_L/(u_L - u_R) and u'_L = u_L (x - overhang)/x =
    u_L - overhang (u_L - u_R)/spacing. 4-1 has the absolute values instead, the same for readings
    of opposite signs; for two of the same sign the base has no point without uplift, and x lies
    outside. Without a rotation x is NaN.
    """
    where = "corrected_uplifts"
    left, right = numbers(where, left=left, right=right)
    positive(where, spacing=spacing)
    not_negative(where, overhang=overhang)
    require(2 * overhang < spacing, where, "overhang", overhang, "less than half the spacing")
    difference = left - right
    centre = np.full(np.shape(difference), np.nan)
    np.divide(spacing * left, difference, out=centre, where=difference != 0)
    change = difference * overhang / spacing
    return EdgeUplifts(left - change, right + change, centre)


def quarter_period_fit(displacement: ArrayLike):
    """Quarter period of the wall of chapter 4, fitted to Table A-1; thesis 4-5.

    Parameters
    ----------
    displacement : array_like
        Displacement D of the peak [m], any shape.

    Returns
    -------
    float or ndarray
        Quarter period ``0.505 acosh(1/(1 - |D|/5.155 m)) + 0.01 s`` [s], in the shape of the
        displacement.

    Raises
    ------
    ValueError
        From 5.155 m on.
    """
    (size,) = numbers("quarter_period_fit", displacement=np.abs(displacement))
    require(size < 5.155, "quarter_period_fit", "displacement", size, "the fit ends at 5.155 m")
    return 0.505 * np.arccosh(1 / (1 - size / 5.155)) + 0.01


def back_calculated_force(
    mass: ArrayLike, acceleration: ArrayLike, ground_acceleration: ArrayLike = 0.0
):
    """Restoring force at an instant without velocity, -M_e (a_g + a); thesis 4-42.

    Parameters
    ----------
    mass : array_like
        Effective mass M_e [kg].
    acceleration : array_like
        Acceleration a relative to the ground [m/s2].
    ground_acceleration : array_like, optional
        Acceleration a_g of the ground [m/s2].

    Returns
    -------
    float or ndarray
        Force [N], in the shape of all arguments, broadcast.
    """
    where = "back_calculated_force"
    (mass,) = positive(where, mass=mass)
    a, a_g = numbers(where, acceleration=acceleration, ground_acceleration=ground_acceleration)
    return -mass * (a_g + a)


def harmonic_force(
    time: ArrayLike, mass: ArrayLike, amplitude: ArrayLike, frequency: ArrayLike = 8.0
):
    """Effective force of a harmonic ground acceleration, -M_e Z sin(2 pi f t); thesis 4-43.

    Parameters
    ----------
    time : array_like
        Time t [s].
    mass : array_like
        Effective mass M_e [kg].
    amplitude : array_like
        Amplitude Z [m/s2], from 5.7 to 6.3 in Figure 4-73.
    frequency : array_like, optional
        Frequency f [Hz]; 16 pi t in 4-43 is 8 Hz.

    Returns
    -------
    float or ndarray
        Force [N], in the shape of all arguments, broadcast.
    """
    where = "harmonic_force"
    time, amplitude = numbers(where, time=time, amplitude=amplitude)
    mass, frequency = positive(where, mass=mass, frequency=frequency)
    return -mass * amplitude * np.sin(2 * np.pi * frequency * time)


# --- the ratio of kinetic energies after and before a passage, as a function of the speed


def energy_ratio_4_31(velocity: ArrayLike):
    """Energy ratio r of the equivalent oscillator, fitted cycle by cycle; thesis 4-31.

    Parameters
    ----------
    velocity : array_like
        Velocity, either sign [m/s], any shape.

    Returns
    -------
    float or ndarray
        Energy ratio, in the shape of the velocity.

    Notes
    -----
    It jumps at 0.3, 0.47 and 0.78 m/s, where the thesis leaves it open; the value there is that of
    the faster band.
    """
    (speed,) = numbers("energy_ratio_4_31", velocity=np.abs(velocity))
    return _by_speed(speed, EnergyRatioAtSpeed.equation_4_31())


def energy_ratio_4_36(velocity: ArrayLike):
    """Energy ratio r of the substitute-gravity wall about its corners; thesis 4-36, as printed.

    Parameters
    ----------
    velocity : array_like
        Velocity v, either sign [m/s], any shape.

    Returns
    -------
    float or ndarray
        Energy ratio ``0.0441 |v| + 0.865``, in the shape of the velocity.

    Raises
    ------
    ValueError
        Where r exceeds 1.

    Notes
    -----
    The text wants 0.88 for large and 0.91 for small speeds, which is the other way round.
    """
    (speed,) = numbers("energy_ratio_4_36", velocity=np.abs(velocity))
    r = _by_speed(speed, EnergyRatioAtSpeed.equation_4_36())
    rule = "the fit would add energy, r > 1: it is for speeds up to 1 m/s"
    require(r <= 1, "energy_ratio_4_36", "velocity", speed, rule)
    return r


def energy_ratio_4_38(velocity: ArrayLike):
    """Energy ratio r of the substitute-gravity wall whose centre of rotation moves; thesis 4-38.

    Parameters
    ----------
    velocity : array_like
        Velocity before the impact, either sign [m/s], any shape.

    Returns
    -------
    float or ndarray
        Energy ratio, in the shape of the velocity.

    Notes
    -----
    It jumps at 0.47 and 0.78 m/s; the value there is that of the faster band.
    """
    (speed,) = numbers("energy_ratio_4_38", velocity=np.abs(velocity))
    return _by_speed(speed, EnergyRatioAtSpeed.equation_4_38())


def _by_speed(speed: np.ndarray, law: EnergyRatioAtSpeed) -> np.ndarray:
    slower = [speed < limit for limit, _, _ in law.pieces]  # the last limit is infinite
    return np.select(slower, [r + slope * speed for _, r, slope in law.pieces])
