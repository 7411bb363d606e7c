"""The motion of a floor: that of the ground, filtered by an elastic building.

import rockeom as rk

record = rk.GroundMotion.from_library("El Centro 1940 180")
floor = rk.floor_motion(record, periods=[0.6, 0.2], height=0.75)
rk.simulate(rk.RigidBlock(half_width=0.2, half_height=0.8), floor)
"""

import math
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.recording import Recording
from rockeom.motion.spectra import oscillator_history
from rockeom.numbers import explained
from rockeom.numbers.checks import (
    InputError,
    array_of,
    described,
    finite_number,
    positive_number,
    require,
)

_PER_PERIOD = 32
"""Samples in the shortest period, at least: lines between them miss its peaks by half a percent."""
_FADED = 0.01
"""Part of the vibration in the first mode that is left when the motion ends."""


Shaking = TypeVar("Shaking", GroundMotion, Recording)


@explained.calls(period="periods=", damping="damping_ratio=")
def floor_motion(
    record: Shaking,
    periods: ArrayLike,
    *,
    height: float = 1.0,
    damping_ratio: float = 0.05,
    participation: ArrayLike | None = None,
) -> Shaking:
    """Absolute acceleration of a floor of an elastic building, as a record.

    Parameters
    ----------
    record : GroundMotion or Recording
        Horizontal motion of the ground below the building, or a recording; the building moves
        vertically as the ground does.
    periods : array_like
        Periods of the modes of the building (n,), or one number, the longest first [s].
    height : float, optional
        Height of the floor, as a part of the height of the building, from 0 to 1, the roof.
    damping_ratio : float, optional
        Damping ratio of all modes, above 0 and below 1.
    participation : array_like, optional
        Participation Gamma_i phi_i of each mode on this floor (n,); those of a building of another
        kind than the default, and without height.

    Returns
    -------
    GroundMotion or Recording
        Record of the floor, sampled 32 times in the shortest period or more, linear between; it
        goes on after the record of the ground until one percent of the vibration in the first mode
        is left.

    Raises
    ------
    InputError
        For values that are not in these ranges, for periods that do not fall, for another number of
        participations than of periods, and for a vertical record.

    Notes
    -----
    By modal superposition, a = (1 - sum Gamma_i phi_i) a_g + sum Gamma_i phi_i a_i, in which a_i is
    the absolute acceleration of an oscillator with period and damping of mode i; the first term is
    that of modes without a period here, which follow the ground. The default is the uniform shear
    building, Gamma_i phi_i = 4/((2 i - 1) pi) sin((2 i - 1) pi height/2), whose periods go as 1,
    1/3, 1/5. The oscillators are integrated exactly. The mass of whatever stands on the floor is
    neglected.

    References
    ----------
    Miranda and Taghavi (2005), Journal of Structural Engineering 131(2), 203-211, with the shear
    beam of their continuous models; Chopra, Dynamics of Structures, chapters 13 and 17.

    Examples
    --------
    >>> import rockeom as rk
    >>> record = rk.GroundMotion.kanai_tajimi(0.01, duration=10.0, seed=1)
    >>> roof = rk.floor_motion(record, periods=0.5)  # s, by one mode
    >>> roof.peak > record.peak
    True

    Other floors and buildings::

        rk.floor_motion(record, periods=[0.6, 0.2, 0.12], height=0.5)
        rk.floor_motion(record, periods=[0.6, 0.2], participation=[0.9, 0.3])
    """
    if not isinstance(record, GroundMotion | Recording):
        raise InputError("record", record).give("a GroundMotion or a Recording")
    of_modes = _periods(periods)
    xi, z = positive_number("damping_ratio", damping_ratio), finite_number("height", height)
    require(xi < 1.0, "", "damping_ratio", xi, "give a part of the critical one, such as 0.05")
    if not 0.0 <= z <= 1.0:
        raise InputError("height", z).give("a part of the height of the building, from 0 to 1")
    shares = _participation(participation, len(of_modes), z)
    where = f"floor at {z:g} of the height" if participation is None else "floor"
    if isinstance(record, GroundMotion):
        return _of_modes(record, of_modes, xi, shares, where)
    floors = (_of_modes(one, of_modes, xi, shares, where) for one in record.horizontal)
    return replace(record, horizontal=tuple(floors))


def _of_modes(
    record: GroundMotion, periods: np.ndarray, xi: float, shares: np.ndarray, where: str
) -> GroundMotion:
    """The motion of a floor to which modes contribute these shares."""
    require(not record.is_vertical, "", "record", record.name, "give a horizontal component")
    ground = _refined(record, periods, xi)
    assert ground.samples is not None
    assert ground.dt is not None
    a = (1.0 - shares.sum()) * ground.samples
    for period, share in zip(periods.tolist(), shares.tolist(), strict=True):
        omega, one = 2.0 * math.pi / period, oscillator_history(ground, period, xi)
        a -= share * (2.0 * xi * omega * one.velocity + omega**2 * one.displacement)
    made = GroundMotion.from_array(a, ground.dt, name=f"{record.name}, {where}")
    of = f"T {', '.join(f'{t:.3g}' for t in periods)} s, damping {xi:g}"
    return replace(made, source=f"{record.source}, {where}, {of}")


def _periods(periods: ArrayLike) -> np.ndarray:
    """(n,) positive periods that fall [s]."""
    found = np.atleast_1d(array_of("periods", periods))
    if found.ndim != 1 or not len(found) or not (np.isfinite(found) & (found > 0.0)).all():
        raise InputError("periods", found.tolist()).give("positive numbers, one for each mode")
    if (np.diff(found) >= 0.0).any():
        raise InputError("periods", found.tolist()).give("the longest first")
    return found


def _participation(given: ArrayLike | None, modes: int, height: float) -> np.ndarray:
    """(n,) Gamma_i phi_i on the floor; those of the uniform shear building if none are given."""
    if given is None:
        beta = (2.0 * np.arange(modes) + 1.0) * (math.pi / 2.0)
        return 2.0 / beta * np.sin(beta * height)
    found = np.atleast_1d(array_of("participation", given))
    if found.shape != (modes,) or not np.isfinite(found).all():
        raise InputError("participation", given).wrong(
            f"is {described(given)} for {modes} period(s): give a number for each"
        )
    if height != 1.0:
        raise InputError("participation").says(
            "height and participation exclude one another: participation says where the floor is"
        )
    return found


def _refined(record: GroundMotion, periods: np.ndarray, damping_ratio: float) -> GroundMotion:
    """The record in steps that are short for all modes, and quiet until the first has faded."""
    step = float(periods[-1]) / _PER_PERIOD
    dt = step if record.dt is None else record.dt / math.ceil(record.dt / step * (1.0 - 1e-12))
    fades = -math.log(_FADED) * float(periods[0]) / (2.0 * math.pi * damping_ratio)
    quiet = np.zeros(math.ceil(fades / dt))  # behind the last sample, whatever its value
    return GroundMotion.from_array(np.append(record.sampled(dt)[1], quiet), dt)
