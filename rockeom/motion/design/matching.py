"""Records whose response spectrum is a given one: a random start, and matching in the time domain.

A start is stationary noise whose power spectral density goes with the response spectrum, times an
envelope (Gasparini and Vanmarcke 1976, Simulated earthquake motions compatible with prescribed
response spectra, MIT R76-4). Wavelets are then added to it, or to a record, that bring the largest
response of each of many oscillators to its target (Al Atik and Abrahamson 2010, Earthquake Spectra
26, 601-617).
"""

import math
from typing import NamedTuple

import numpy as np

from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.spectra import largest_displacement

_APART = 1.2
"""Relative distance of neighbouring periods, over the damping ratio."""
_CLOSE = 0.07
"""Largest relative difference from the target at which the rounds end."""
_ROUNDS = 15
_COUPLING = 0.6
"""Part of the response to the wavelets of other periods that a round accounts for. Neighbours
answer nearly alike: with all of it the rounds diverge, with 0.8 at 2 % of damping."""
_BASELINE = 5  # degree of the polynomial of the displacement that each round subtracts
_PEAK_FACTOR = 3.0
"""Largest response over its standard deviation, of the start alone."""


class Target(NamedTuple):
    """Pseudo-accelerations (n,) [m/s2] at periods (n,) [s], for a damping ratio.

    peak : largest acceleration of the ground [m/s2], at which each round cuts the record.
    """

    periods: np.ndarray
    accelerations: np.ndarray
    damping_ratio: float
    peak: float = math.inf


def periods(first: float, last: float, damping_ratio: float) -> np.ndarray:
    """Periods of oscillators from the first to the last [s], 6 % apart at 5 % of damping.

    Their resonances overlap, and the more the damping, the fewer tell something of their own.
    """
    ratio = 1.0 + _APART * damping_ratio
    found = np.geomspace(first, last, math.ceil(math.log(last / first) / math.log(ratio)) + 1)
    found[[0, -1]] = first, last  # without rounding
    return found


def noise(target: Target, n: int, dt: float, generator: np.random.Generator) -> np.ndarray:
    """Stationary noise (n,) [m/s2] dt [s] apart, of random phase angles, roughly compatible.

    Its density G obeys S_a**2/r**2 = omega G (pi/(4 xi) - 1) + the integral of G up to omega, with
    the peak factor r: the variance of the response of a lightly damped oscillator (Vanmarcke 1976).
    """
    m = 1 << (2 * n - 1).bit_length()
    omega = 2.0 * np.pi * np.fft.rfftfreq(m, dt)
    ends = 2.0 * np.pi / target.periods[[-1, 0]]
    band = np.flatnonzero((omega >= ends[0]) & (omega <= ends[1]))
    variance = np.interp(2.0 * np.pi / omega[band], target.periods, target.accelerations) ** 2
    variance /= _PEAK_FACTOR**2
    width, density, below = omega[1], np.zeros(len(band)), 0.0
    resonance = omega[band] * (math.pi / (4.0 * target.damping_ratio) - 1.0)
    for i in range(len(band)):
        density[i] = max(variance[i] - below, 0.0) / resonance[i]
        below += density[i] * width
    amplitudes = np.zeros(len(omega), complex)
    phases = generator.uniform(0.0, 2.0 * np.pi, len(band))
    amplitudes[band] = np.sqrt(2.0 * density * width) * np.exp(1j * phases)
    return np.fft.irfft(0.5 * m * amplitudes, m)[:n]


def matched(samples: np.ndarray, dt: float, target: Target) -> np.ndarray:
    """Accelerations with the spectrum of the target, by wavelets added to `samples` (m,) [m/s2].

    The ground is at rest after each round. The rounds end where all differences are small; if they
    do not become so, the best is returned.
    """
    least, best = np.inf, samples
    for _ in range(_ROUNDS):
        samples = _at_rest(np.clip(samples, -target.peak, target.peak), dt)
        time, response = _largest(samples, dt, target)
        error = float(np.abs(np.abs(response) / target.accelerations - 1.0).max())
        if error < least:
            least, best = error, samples
        if error < _CLOSE:
            break
        missing = np.sign(response) * target.accelerations - response
        samples = samples + _adjustment(dt * np.arange(len(samples)), time, missing, target)
    return best


def _at_rest(samples: np.ndarray, dt: float) -> np.ndarray:
    """A record less its baseline, and less the line that leaves a velocity or a displacement."""
    motion = GroundMotion.from_array(samples, dt).baseline_corrected(_BASELINE, "displacement")
    assert motion.samples is not None
    t = motion.duration
    ends = np.array([motion.velocity(t), motion.displacement(t)])
    level, slope = np.linalg.solve([[t, t**2 / 2], [t**2 / 2, t**3 / 6]], ends)
    return motion.samples - level - slope * dt * np.arange(len(samples))


def _largest(samples: np.ndarray, dt: float, target: Target) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] of the largest responses, and these as pseudo-accelerations with sign [m/s2]."""
    xi = target.damping_ratio
    found = [largest_displacement(samples, dt, t, xi) for t in target.periods.tolist()]
    time, displacement = np.array(found).T
    return time, (2.0 * np.pi / target.periods) ** 2 * displacement


def _adjustment(t: np.ndarray, time: np.ndarray, missing: np.ndarray, target: Target) -> np.ndarray:
    """Accelerations (m,) at times t (m,) whose responses at `time` (n,) are what is missing (n,).

    A sum of cosines at the damped frequencies with Gaussian tapers of 1.178 f**-0.93 s, a quarter
    of a period before the response, which then has a peak in time (Al Atik and Abrahamson 2010).
    Velocity and displacement of the ground hardly drift by it.
    """
    omega, xi = 2.0 * np.pi / target.periods[:, None], target.damping_ratio
    damped = omega * math.sqrt(1.0 - xi**2)
    taper = 1.178 * target.periods[:, None] ** 0.93
    since = np.maximum(time[:, None] - t, 0.0)
    responses = np.exp(-xi * omega * since) * np.sin(damped * since)
    responses *= -(t[1] - t[0]) * omega**2 / damped
    local = t - time[:, None] + math.atan2(math.sqrt(1.0 - xi**2), xi) / damped
    wavelets = np.cos(damped * local) * np.exp(-((local / taper) ** 2))
    coupling = responses @ wavelets.T
    own = np.diag(coupling).copy()
    coupling *= _COUPLING
    np.fill_diagonal(coupling, own)
    return np.asarray(np.linalg.solve(coupling, missing) @ wavelets)
