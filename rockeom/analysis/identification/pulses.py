"""The pulse in a near-fault record: the pulse of a model closest to the ground's velocity.

    import rockeom as rk
    from rockeom.analysis import identification

    record = rk.GroundMotion.from_library("near field pulse El Centro Array #6 230")
    fit = identification.fit_pulse(record)
    fit.period, fit.velocity, fit.misfit  # s, m/s, -
    rk.simulate(block, fit.motion)

For given period, envelope and centre the velocity of a pulse is linear in the cosine and the sine
of its phase angle. A search over periods, envelopes and all centres at once (a convolution) finds
the best of them, from which least squares continue.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion import GroundMotion
from rockeom.motion.segments import ANTISYMMETRIC_RICKER_PEAK, END, START, cut
from rockeom.numbers.checks import InputError, positive, require, require_word

PULSE_MODELS = ("mavroeidis_papageorgiou", "ricker", "antisymmetric_ricker")
"""The models of `fit_pulse`."""

_GAMMAS = (1.1, 1.3, 1.6, 2.0, 2.5, 3.2, 4.0)
_GAMMA_BOUNDS = 1.01, 6.0
_SAMPLES = 40  # in the shortest period, at least; a pulse needs no more
_PERIODS = 40
_STARTS = 3
"""Number of best places of the search from which least squares continue."""


@dataclass(frozen=True)
class PulseFit:
    """Pulse of a model closest to the velocity of a motion.

    Parameters
    ----------
    model : str
        Name of the model.
    velocity : float
        Amplitude of the velocity [m/s]; for a Ricker wavelet the largest velocity, and negative
        where that is.
    period : float
        Period [s].
    centre : float
        Time of the centre [s].
    gamma : float
        Oscillatory character of Mavroeidis and Papageorgiou's pulse, else NaN.
    phase : float
        Phase angle of Mavroeidis and Papageorgiou's pulse [rad], else NaN.
    misfit : float
        Root of the mean square of the residual velocity, over that of the motion.
    motion : GroundMotion
        Pulse at its place, as long as the motion.
    """

    model: str
    velocity: float
    period: float
    centre: float
    gamma: float
    phase: float
    misfit: float
    motion: GroundMotion


def fit_pulse(
    motion: GroundMotion,
    model: str = "mavroeidis_papageorgiou",
    *,
    periods: tuple[float, float] | None = None,
) -> PulseFit:
    """Pulse that leaves the least square of the velocity of a motion.

    Parameters
    ----------
    motion : GroundMotion
        Motion with a velocity, of any kind; a record that drifts should be
        `GroundMotion.baseline_corrected`.
    model : str, optional
        "mavroeidis_papageorgiou", "ricker" or "antisymmetric_ricker".
    periods : tuple of (float, float), optional
        Shortest and longest period of the search [s]; if not given, 0.3 s (or twenty samples of a
        record, if that is more) and half of the duration.

    Returns
    -------
    PulseFit
        Pulse with its parameters and its misfit.

    Raises
    ------
    ValueError
        For another model, impossible periods, and a motion without velocity.

    Notes
    -----
    The amplitude, the period and the centre are fitted, and the phase angle and gamma (1.01 to 6)
    where a model has them. Times before the motion and after it count as zero velocity.

    References
    ----------
    Mavroeidis and Papageorgiou, Bulletin of the Seismological Society of America 93 (2003)
    1099-1131.
    """
    where = "fit_pulse"
    require_word("model", model, PULSE_MODELS, where)
    if periods is None:
        periods = max(0.3, 20 * (motion.dt or 0.0)), 0.5 * motion.duration
    (band,) = positive(where, periods=periods)
    if band.shape != (2,) or band[0] >= band[1]:
        raise InputError("periods", periods, where).give("a shorter and a longer one [s]")
    longest = motion.duration
    require(band <= longest, where, "periods", band, f"the motion lasts {longest:g} s: give less")
    t = np.linspace(0.0, longest, math.ceil(_SAMPLES * longest / band[0]) + 1)
    v = motion.velocity(t)
    require(bool(np.abs(v).max() > 0.0), where, "motion", motion, "it has no velocity to fit")
    gammas = _GAMMAS if model == PULSE_MODELS[0] else (1.0,)
    fits = [_polished(model, t, v, place, band) for place in _searched(model, t, v, band, gammas)]
    left, (period, centre, gamma) = min(fits, key=lambda fit: fit[0])
    weights = _weights(model, t, v, period, centre, gamma)[0]
    return _told(motion, model, period, centre, gamma, weights, left)


def _shapes(model: str, x: np.ndarray, period: float, gamma: float) -> np.ndarray:
    """Velocities (k, n) of size 1 that make a pulse, at times x (n,) [s] from its centre."""
    if model == "mavroeidis_papageorgiou":
        half = 0.5 * gamma * period
        envelope = np.where(np.abs(x) < half, 0.5 * (1.0 + np.cos(np.pi / half * x)), 0.0)
        angle = 2.0 * np.pi / period * x
        return envelope * np.stack([np.cos(angle), -np.sin(angle)])
    if model == "ricker":  # the largest of y exp(-y**2) is at 1/sqrt(2)
        y = np.pi / period * x
        return (math.sqrt(2.0 * math.e) * y * np.exp(-(y**2)))[None]
    y = 2.0 * np.pi / (math.sqrt(3.0) * period) * x
    return ((1.0 - y**2) * np.exp(-0.5 * y**2))[None]


def _weights(
    model: str, t: np.ndarray, v: np.ndarray, period: float, centre: float, gamma: float
) -> tuple[np.ndarray, np.ndarray]:
    """The best weights (k,) of the shapes, and what is left of the velocity (n,)."""
    shapes = _shapes(model, t - centre, period, gamma)
    weights = np.linalg.lstsq(shapes.T, v, rcond=None)[0]
    return weights, v - weights @ shapes


def _searched(
    model: str,
    t: np.ndarray,
    v: np.ndarray,
    band: np.ndarray,
    gammas: ArrayLike,
) -> list[tuple[float, float, float]]:
    """(period, centre, gamma) of the best places; of each period and gamma the best centre.

    Even and odd shapes are at right angles: what they take from the square of the velocity adds up.
    """
    from scipy.signal import fftconvolve  # takes long to import

    starts = []
    step = t[1] - t[0]
    for period in np.geomspace(band[0], band[1], _PERIODS):
        for gamma in np.atleast_1d(gammas):
            half = 0.5 * gamma if model == "mavroeidis_papageorgiou" else 2.0
            reach = math.ceil(half * period / step)
            x = step * np.arange(-reach, reach + 1)
            shapes = _shapes(model, x, period, gamma)
            taken = sum(
                fftconvolve(v, one[::-1])[reach : reach + len(v)] ** 2 / (one @ one)
                for one in shapes
            )
            taken = np.where(t < _lead(model, period, gamma), 0.0, taken)
            best = int(np.argmax(taken))
            starts.append((taken[best], (float(period), float(t[best]), float(gamma))))
    starts.sort(key=lambda one: -one[0])
    return [place for _, place in starts[:_STARTS]]


def _lead(model: str, period: float, gamma: float) -> float:
    """Time [s] from the start of a motion to the earliest centre: a wavelet may lose its tail."""
    return 0.5 * gamma * period if model == "mavroeidis_papageorgiou" else 0.0


def _polished(
    model: str, t: np.ndarray, v: np.ndarray, place: tuple[float, float, float], band: np.ndarray
) -> tuple[float, tuple[float, float, float]]:
    """The misfit, and the period, centre and gamma of least squares from a place on."""
    from scipy.optimize import least_squares  # takes long to import

    free = 3 if model == "mavroeidis_papageorgiou" else 2
    low = np.array([band[0], 0.0, _GAMMA_BOUNDS[0]])[:free]
    high = np.array([band[1], t[-1], _GAMMA_BOUNDS[1]])[:free]

    def placed(x: np.ndarray) -> tuple[float, float, float]:
        """From the period, the time beyond the earliest centre, and gamma."""
        period, late, gamma = (float(one) for one in (*x, *place[free:]))
        return period, late + _lead(model, period, gamma), gamma

    def left(x: np.ndarray) -> np.ndarray:
        return _weights(model, t, v, *placed(x))[1]

    period, centre, gamma = place
    start = np.array([period, centre - _lead(model, period, gamma), gamma])[:free]
    optimum = least_squares(left, np.clip(start, low, high), bounds=(low, high), x_scale="jac")
    return math.sqrt(float(optimum.fun @ optimum.fun) / float(v @ v)), placed(optimum.x)


def _told(
    motion: GroundMotion,
    model: str,
    period: float,
    centre: float,
    gamma: float,
    weights: np.ndarray,
    misfit: float,
) -> PulseFit:
    """The fit in the words of its model."""
    phase = math.nan
    if model == "mavroeidis_papageorgiou":
        velocity = float(np.hypot(*weights))
        phase = float(np.arctan2(weights[1], weights[0]))
        pulse = GroundMotion.mavroeidis_papageorgiou(
            velocity, period, gamma, phase, duration=gamma * period
        )
    else:
        velocity, gamma = float(weights[0]), math.nan
        pulse = _wavelet(model, velocity, period)
    start = centre - 0.5 * pulse.duration
    if model == "mavroeidis_papageorgiou":
        start = max(start, 0.0)  # but for rounding it is
    placed = _placed(pulse, start, motion.duration)
    source = f"fitted to the velocity of {motion.name or 'a motion'}, misfit {misfit:.3g}"
    placed = replace(placed, source=source)
    return PulseFit(model, velocity, period, centre, gamma, phase, misfit, placed)


def _wavelet(model: str, velocity: float, period: float) -> GroundMotion:
    """A Ricker wavelet by its largest velocity [m/s], which may be negative."""
    if model == "ricker":
        amplitude = velocity * math.sqrt(2.0 * math.e) * math.pi / period
    else:
        rate = 2.0 * math.pi / (math.sqrt(3.0) * period)
        amplitude = velocity * rate * ANTISYMMETRIC_RICKER_PEAK
    return GroundMotion.ricker(
        amplitude, period, duration=4.0 * period, antisymmetric=model != "ricker"
    )


def _placed(pulse: GroundMotion, start: float, duration: float) -> GroundMotion:
    """A pulse that begins at a time [s], within a motion of a duration [s]."""
    rows = pulse.segments.copy()
    rows[:, [START, END]] += start
    if start > 0.0:
        quiet = np.zeros((1, rows.shape[1]))
        quiet[0, END] = start
        rows = np.vstack([quiet, rows])
    moved = replace(pulse, segments=cut(rows, 0.0, duration))
    return moved.padded_to(max(duration, moved.duration))
