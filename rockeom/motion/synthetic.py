"""Random ground motions: stationary filtered white noise, and its envelopes over time."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import InputError, array_of, positive_number, require, whole_number

Filter = tuple[float, float]
"""Angular frequency [rad/s] and damping ratio of an oscillator."""


@dataclass(frozen=True)
class JenningsEnvelope:
    """Envelope ``(t/rise)**2``, then 1, then ``exp(-decay (t - until))``.

    Parameters
    ----------
    rise : float
        End of the rise [s].
    until : float
        End of the strong part [s].
    decay : float
        Decay [1/s].

    Raises
    ------
    InputError
        For values that are not positive, and for `until` before `rise`.

    References
    ----------
    Jennings, Housner and Tsai, Simulated earthquake motions (1968).
    """

    rise: float
    until: float
    decay: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            positive_number(name, value)
        if self.until < self.rise:
            raise InputError("until", self.until).wrong(
                f"is {self.until:g} s, before the end of the rise, {self.rise:g} s: give more"
            )

    def __call__(self, t: np.ndarray) -> np.ndarray:
        """The envelope (n,) at times t (n,) [s]."""
        return np.minimum(t / self.rise, 1.0) ** 2 * np.exp(
            -self.decay * np.maximum(t - self.until, 0.0)
        )


@dataclass(frozen=True)
class ShinozukaSatoEnvelope:
    """Envelope exp(-decay t) - exp(-rise t), divided by its largest value.

    Parameters
    ----------
    decay : float
        Decay [1/s].
    rise : float
        Rise [1/s], larger than the decay.

    Raises
    ------
    InputError
        For values that are not positive, and for a rise not above the decay.

    References
    ----------
    Shinozuka and Sato, Journal of the Engineering Mechanics Division 93 (1967) 11-40.
    """

    decay: float
    rise: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            positive_number(name, value)
        if self.rise <= self.decay:
            raise InputError("rise", self.rise).wrong(
                f"is {self.rise:g} 1/s, not above the decay, {self.decay:g} 1/s: give more"
            )

    def __call__(self, t: np.ndarray) -> np.ndarray:
        """The envelope (n,) at times t (n,) [s]."""
        peak = math.log(self.rise / self.decay) / (self.rise - self.decay)
        return self._at(t) / self._at(peak)

    def _at(self, t):
        return np.exp(-self.decay * t) - np.exp(-self.rise * t)


def spectral_density(
    omega: ArrayLike, spectral_intensity: float, ground: Filter, high_pass: Filter | None = None
) -> np.ndarray:
    """Power spectral density [m2/s3] of Kanai and Tajimi, or Clough and Penzien, at omega [rad/s].

    Over angular frequencies of both signs: its integral over all is the variance.

    spectral_intensity : S_0 [m2/s3]. ground, high_pass : angular frequency [rad/s] and damping
    ratio of each filter; without the second it is that of Kanai and Tajimi.
    """
    w = np.asarray(omega, dtype=float)
    r, xi = w / ground[0], ground[1]
    passed = (1.0 + (2.0 * xi * r) ** 2) / ((1.0 - r**2) ** 2 + (2.0 * xi * r) ** 2)
    if high_pass is not None:
        q, xi = w / high_pass[0], high_pass[1]
        passed = passed * q**4 / ((1.0 - q**2) ** 2 + (2.0 * xi * q) ** 2)
    return spectral_intensity * passed


class Noise(NamedTuple):
    """Accelerations (n,) [m/s2] dt [s] apart, with the name and the source of their motion."""

    samples: np.ndarray
    dt: float
    name: str
    source: str


def noise(
    model: str,
    spectral_intensity: float,
    ground: Filter,
    high_pass: Filter | None,
    duration: float,
    seed: int,
    envelope: Callable[[np.ndarray], ArrayLike] | None,
    dt: float,
) -> Noise:
    """See `GroundMotion.kanai_tajimi` and `GroundMotion.clough_penzien`."""
    s_0 = positive_number("spectral_intensity", spectral_intensity)
    length = positive_number("duration", duration)
    dt, start = positive_number("dt", dt), whole_number("seed", seed, 0)
    n = round(length / dt) + 1
    require(n >= 2, "", "dt", dt, f"give a step shorter than the duration, {length:g} s")
    a = _stationary(n, dt, s_0, ground, high_pass, start)
    if envelope is not None:
        a = a * factors(envelope, dt * np.arange(n))
    filters = "; ".join(f"{w:g} rad/s, {xi:g}" for w, xi in filter(None, (ground, high_pass)))
    source = f"{model}, S0 {s_0:g} m2/s3, filters {filters}"
    return Noise(a, dt, f"{model}, seed {start}", source)


def _stationary(
    n: int, dt: float, intensity: float, ground: Filter, high_pass: Filter | None, seed: int
) -> np.ndarray:
    """(n,) accelerations [m/s2]: cosines and sines with Gaussian amplitudes.

    Their sum is periodic; twice the time is made and half of it kept, so that the end does not know
    the start.
    """
    m = 1 << (2 * n - 1).bit_length()
    omega = 2.0 * np.pi * np.fft.rfftfreq(m, dt)
    variance = spectral_density(omega, intensity, ground, high_pass) * omega[1]
    # of each sine and cosine both signs of omega; at both ends of the band there is but one cosine
    size = np.sqrt(variance / 2.0)
    cosine, sine = np.random.default_rng(seed).standard_normal((2, len(omega)))
    amplitudes = size * (cosine - 1j * sine)
    amplitudes[[0, -1]] = np.sqrt(variance[[0, -1]]) * cosine[[0, -1]]
    return np.fft.irfft(m * amplitudes, m)[:n]


def factors(envelope: Callable[[np.ndarray], ArrayLike], t: np.ndarray) -> np.ndarray:
    """An envelope (n,) at times t (n,) [s]; raises InputError for what is none."""
    if not callable(envelope):
        raise InputError("envelope", envelope).give(
            "a function of times, such as JenningsEnvelope(rise=2.0, until=10.0, decay=0.3)"
        )
    found = array_of("envelope(t)", envelope(t))
    if found.shape != t.shape:
        raise InputError("envelope").says(
            f"the envelope returned the shape {found.shape} for {len(t)} times: return one number "
            "for each"
        )
    return found
