"""Slips of a wall on its foundation, from its uplifts and from the force of its tendon.

A wall that has slid by s is upright at a displacement s. Its uplifts and the force of its tendon
against the displacement are then the curves of before, shifted by s; thesis Figures 4-57 to 4-59.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.formulas.controlled_wall import Wall
from rockeom.analysis.identification.noise import COVERED, noise_level
from rockeom.numbers.checks import InputError, numbers, positive, require


class Slips(NamedTuple):
    """Shift of the origin of each half-cycle, from one crossing of upright to the next.

    Parameters
    ----------
    time : ndarray
        Middle of each half-cycle (n,) [s].
    shift : ndarray
        Shift (n,) [m].
    half_width : ndarray
        Half-width of the interval of the shift (n,) [m].
    """

    time: np.ndarray
    shift: np.ndarray
    half_width: np.ndarray

    @property
    def steps(self) -> np.ndarray:
        """Changes of the shift from one half-cycle to the next, the slips (n - 1,) [m]."""
        return np.diff(self.shift)

    @property
    def clear(self) -> np.ndarray:
        """Whether each slip is larger than the half-widths of both shifts (n - 1,)."""
        return np.abs(self.steps) > np.hypot(self.half_width[1:], self.half_width[:-1])


def slips_from_tendon_force(
    time: ArrayLike, displacement: ArrayLike, tendon_force: ArrayLike, wall: Wall
) -> Slips:
    """Shifts of the force of the tendon against the displacement.

    Parameters
    ----------
    time : array_like
        Times (n,) [s].
    displacement : array_like
        Displacements (n,) [m].
    tendon_force : array_like
        Forces of the tendon (n,) [N].
    wall : Wall
        Wall whose `Wall.tendon_force` is the curve.

    Returns
    -------
    Slips
        Shift of each half-cycle.

    Raises
    ------
    ValueError
        Where the record never passes upright.
    """
    return _slips("slips_from_tendon_force", time, displacement, tendon_force, wall.tendon_force)


def slips_from_uplifts(
    time: ArrayLike,
    displacement: ArrayLike,
    left_uplift: ArrayLike,
    right_uplift: ArrayLike,
    wall: Wall,
) -> Slips:
    """Shifts of the uplift of the edges against the displacement.

    Parameters
    ----------
    time : array_like
        Times (n,) [s].
    displacement : array_like
        Displacements (n,) [m].
    left_uplift : array_like
        Uplifts of the left edge (n,) [m].
    right_uplift : array_like
        Uplifts of the right edge (n,) [m].
    wall : Wall
        Wall whose `Wall.uplift` is the curve.

    Returns
    -------
    Slips
        Shift of each half-cycle.

    Raises
    ------
    ValueError
        Where the record never passes upright.

    Notes
    -----
    The difference of the uplifts is the rotation of the base, and counts.
    """
    where = "slips_from_uplifts"
    left, right = numbers(where, left_uplift=left_uplift, right_uplift=right_uplift)
    b = wall.half_width

    def difference(d: np.ndarray) -> np.ndarray:
        return wall.uplift(d, -b) - wall.uplift(d, b)

    return _slips(where, time, displacement, left - right, difference)


def _slips(
    where: str,
    time: ArrayLike,
    displacement: ArrayLike,
    measured: ArrayLike,
    curve: Callable[[np.ndarray], np.ndarray],
) -> Slips:
    from scipy.optimize import least_squares

    t, d, y = numbers(where, time=time, displacement=displacement, measured=measured)
    if t.ndim != 1 or not t.shape == d.shape == y.shape or len(t) < 16:
        raise InputError("time", of=where).wrong(
            f"has the shape {t.shape}, displacement {d.shape}, the other channel {y.shape}: give "
            "one value of each at 16 instants or more"
        )
    require(np.diff(t) > 0, where, "time", t[1:], "times must increase")
    # the larger half-cycles, between the changes of side of all but the middle of the trace
    beyond = np.flatnonzero(np.abs(d) > 0.1 * np.abs(d).max())
    edges = np.flatnonzero(np.diff(np.sign(d[beyond])) != 0) + 1
    runs = [run for run in np.split(beyond, edges) if len(run) >= 8]
    if len(runs) < 2:
        raise InputError("displacement", of=where).wrong("never passes upright: no half-cycle")
    sigma = max(noise_level(t, y), 1e-12 * float(np.abs(y).max()))
    sigma_d = noise_level(t, d)
    shifts, half_widths = [], []
    for run in runs:
        x, goal = d[run], y[run]

        def left_over(s: np.ndarray, x: np.ndarray = x, goal: np.ndarray = goal) -> np.ndarray:
            return (curve(x - s[0]) - goal) / sigma

        reach = 0.5 * float(np.abs(x).max())
        best = least_squares(left_over, [0.0], x_scale=reach, bounds=(-reach, reach))
        slope = best.jac[:, 0]
        # noise of both channels, and what the curve does not explain
        own = np.sqrt(np.mean(best.fun**2))
        each = max(np.sqrt(1 + np.mean(slope**2) * sigma_d**2), own)
        shifts.append(float(best.x[0]))
        half_widths.append(COVERED * float(each / np.sqrt(slope @ slope)))
    middles = np.array([t[run].mean() for run in runs])
    return Slips(middles, np.array(shifts), np.array(half_widths))


def rotation_centre_between_gauges(
    left: ArrayLike,
    right: ArrayLike,
    spacing: float,
    noise: float = 0.0,
):
    """Distance of the rotation centre from the left gauge; thesis 4-1, Figure 5-12.

    Parameters
    ----------
    left : array_like
        Readings of the left uplift gauge, positive upwards [m].
    right : array_like
        Readings of the right uplift gauge, positive upwards [m].
    spacing : float
        Distance of the gauges [m].
    noise : float, optional
        Standard deviation of each reading [m].

    Returns
    -------
    centre : float or ndarray
        Distance [m], in the shape of the readings, broadcast.
    half_width : float or ndarray
        Half-width of its interval at 95 % [m].

    Raises
    ------
    ValueError
        For a spacing that is not positive and a negative noise.

    Notes
    -----
    The base is straight: the distance is spacing u_L/(u_L - u_R). Where the readings differ by less
    than five standard deviations the rotation is too small for a centre, and both are NaN.
    """
    where = "rotation_centre_between_gauges"
    left, right = numbers(where, left=left, right=right)
    (length,) = positive(where, spacing=spacing)
    (sigma,) = numbers(where, noise=noise)
    require(sigma >= 0, where, "noise", sigma, "it must be zero or positive")
    left, right = np.broadcast_arrays(left, right)
    difference = left - right
    turned = np.abs(difference) > max(5 * np.sqrt(2) * float(sigma), 0.0)
    centre, half_width = np.full(left.shape, np.nan), np.full(left.shape, np.nan)
    np.divide(length * left, difference, out=centre, where=turned)
    # d(centre) = (spacing/difference**2) (u_L d(u_R) - u_R d(u_L))
    spread = COVERED * float(sigma) * length * np.hypot(left, right)
    np.divide(spread, difference**2, out=half_width, where=turned)
    return centre, half_width
