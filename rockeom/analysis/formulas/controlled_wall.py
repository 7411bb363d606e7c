"""The wall of thesis chapter 4 as formulas, and the oscillator that its losses make of it.

    from rockeom import analysis

    wall = analysis.Wall.thesis()
    wall.restoring_force(0.03), wall.tendon_force(0.03)  # N, at 30 mm

Its tendons and its rotation centre, too, are of `rockeom.structures.shipped.tendoned_wall`.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import InputError, numbers, positive, require
from rockeom.numbers.quadrature import integral
from rockeom.structures.shipped.tendoned_wall import (
    DissipationLimit,
    RotationCentre,
    Tendon,
    TendonPath,
    Wall,
)

__all__ = ["DissipationLimit", "RotationCentre", "Tendon", "TendonPath", "Wall", "peak_sequence"]


def peak_sequence(
    restoring_force: Callable[[np.ndarray], np.ndarray],
    first_peak: float,
    energy_ratio: ArrayLike,
    width: float,
    passages: int | None = None,
) -> np.ndarray:
    """Successive peaks of the oscillator with Dirac-delta damping; thesis 4-27 with 4-28.

    Parameters
    ----------
    restoring_force : callable
        Force F_k [N] as a function of an array of displacements [m], such as
        `Wall.restoring_force`; it pulls towards zero.
    first_peak : float
        Displacement at rest, not zero [m].
    energy_ratio : array_like
        Energy ratio r, 0 < r <= 1, one for all passages or one for each (passages,).
    width : float
        Width n of the smoothed delta [m].
    passages : int, optional
        Number of passages; that of the ratios if not given.

    Returns
    -------
    ndarray
        Peaks (passages + 1,) [m], `first_peak` first.

    Raises
    ------
    ValueError
        Where the force does not pull towards zero, and for numbers that cannot be.

    Notes
    -----
    The oscillator is M x'' + F_k(x) + F_D = 0 with ``F_D = -M ln(sqrt(r))/(n sqrt(pi)) v**2
    exp(-(x/n)**2) sgn(v)``; since ln(sqrt(r)) < 0 it opposes the motion, which 4-28, without the
    minus, does not. For v > 0, with ``w = v**2`` and the Gaussian ``delta(x) = exp(-(x/n)**2)/(n
    sqrt(pi))`` of unit area, x'' = (dw/dx)/2 makes this linear in w::

        dw/dx - ln(r) delta(x) w = -2 F_k(x)/M

    Phi(x) = (1 + erf(x/n))/2, the integral of delta up to x, gives the integrating factor
    ``r**(-Phi)``: ``d(w r**(-Phi))/dx = -(2/M) F_k r**(-Phi)``. Between two peaks w goes from 0 to
    0, so that the next peak x1 after x0 < 0 satisfies::

        integral from x0 to x1 of F_k(x) r**(-Phi(x)) dx = 0

    No mass is in it. The way back is its mirror image, with Phi(-x). Without F_k, w would be
    multiplied by r on the whole: r is the ratio of the kinetic energies of a passage. The integral
    is accurate to 1e-13 of its size.
    """
    where = "peak_sequence"
    (start,) = numbers(where, first_peak=first_peak)
    require(start != 0, where, "first_peak", start, "an oscillator at rest stays: give a peak")
    (n,) = positive(where, width=width)
    (ratios,) = positive(where, energy_ratio=energy_ratio)
    require(ratios <= 1, where, "energy_ratio", ratios, "more than 1 would add energy")
    require(passages is None or passages >= 0, where, "passages", passages, "give 0 or more")
    if passages is None and not ratios.ndim:
        raise InputError("passages", of=where).wrong("is missing: give how many, or one r for each")
    if ratios.ndim > 1 or (ratios.ndim and passages not in (None, len(ratios))):
        raise InputError("energy_ratio", of=where).wrong(
            f"has the shape {ratios.shape}: give one number, or one for each of the passages"
        )
    peaks = [float(start)]
    for r in np.broadcast_to(ratios, ratios.shape or (passages,)):
        peaks.append(_next_peak(restoring_force, peaks[-1], float(r), float(n)))
    return np.array(peaks)


def _next_peak(force: Callable, start: float, r: float, n: float) -> float:
    from scipy.optimize import brentq  # both take long to import
    from scipy.special import erf

    towards = -np.sign(start)

    def integrand(s: np.ndarray) -> np.ndarray:
        """Along the motion, s = x sgn(v)."""
        return towards * force(towards * s) * r ** (-(1 + erf(s / n)) / 2)

    # the Gaussian is spent within the core, so that panels of its size are not needed outside
    core = min(6 * n, abs(start))
    gained = integral(integrand, -abs(start), -core) + integral(integrand, -core, 0.0)
    through = gained + integral(integrand, 0.0, core)

    def balance(s: float) -> float:
        if s < core:
            return gained + integral(integrand, 0.0, s)
        return through + integral(integrand, core, s)

    far = abs(start)
    if not gained < 0 or not force(np.array(-start)) * towards > 0:
        raise InputError("restoring_force", of="peak_sequence").wrong(
            f"does not pull from {start} m towards zero: give a force of the sign of the "
            "displacement"
        )
    while balance(far) < 0:  # only a force that is no odd function lets a peak grow
        far *= 2
        if far > 1e3 * abs(start):
            raise ValueError(f"peak_sequence: the motion from {start} m is not turned back")
    return float(towards * brentq(balance, 0.0, far, xtol=1e-15, rtol=1e-14))
