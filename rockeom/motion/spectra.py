"""Elastic response spectra of a ground motion, exact to rounding for every kind of motion.

    import rockeom as rk

    motion = rk.GroundMotion.from_library("El Centro 1940 180")
    spectrum = motion.response_spectrum(periods=[0.2, 0.5, 1.0, 2.0], damping_ratio=0.05)
    spectrum.displacement, spectrum.pseudo_acceleration  # m, m/s2
    spectrum.plot()

The oscillator is u'' + 2 xi omega u' + omega**2 u = -a_g, at rest at time zero. With the complex
lambda = -xi omega + i omega sqrt(1 - xi**2), z = u' - conj(lambda) u obeys z' = lambda z - a_g, one
equation of first order. Under a record, which is linear between its samples, it is solved exactly
from sample to sample (Nigam and Jennings 1969); under an analytic motion Gauss's rule with eight
places integrates each step.
"""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion import segments as pieces
from rockeom.numbers import explained
from rockeom.numbers.checks import InputTypeError, not_negative, positive, require
from rockeom.numbers.functions import gauss_rule
from rockeom.numbers.pictures import picture

_PER_PERIOD = 16
"""Steps in a period, at least: no peak between two turns of the velocity is passed over then."""

_PARTS = 8
"""Parts of a step that may hold the largest value, each searched for a turn."""


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Largest responses of elastic oscillators to a motion, (n,) each, within the steps too.

    Parameters
    ----------
    periods : ndarray
        Periods [s].
    damping_ratio : float
        Damping ratio of all oscillators.
    displacement : ndarray
        Displacement relative to the ground [m].
    velocity : ndarray
        Velocity relative to the ground [m/s].
    acceleration : ndarray
        Absolute acceleration [m/s2].
    name : str, optional
        Name of the motion.
    """

    periods: np.ndarray
    damping_ratio: float
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    name: str = ""

    @property
    def pseudo_velocity(self) -> np.ndarray:
        """omega times the displacement [m/s]."""
        return 2 * np.pi / self.periods * self.displacement

    @property
    def pseudo_acceleration(self) -> np.ndarray:
        """omega**2 times the displacement [m/s2]: the spring's force for each unit of mass."""
        return (2 * np.pi / self.periods) ** 2 * self.displacement

    def plot(self, **kwargs: Any) -> Any:
        """Draw pseudo-acceleration, velocity and displacement; see `plots.plot_spectra`.

        Parameters
        ----------
        **kwargs : object
            Further arguments of `plots.plot_spectra`.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.
        """
        return picture("plot_spectra", [self], **kwargs)


class OscillatorHistory(NamedTuple):
    """Motion of an oscillator relative to the ground.

    Parameters
    ----------
    time : ndarray
        Times (n,) [s].
    displacement : ndarray
        Displacements (n,) [m].
    velocity : ndarray
        Velocities (n,) [m/s].
    """

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray


@explained.calls(damping="damping_ratio=", T="periods=", xi="damping_ratio=")
def response_spectrum(
    motion: pieces.Motion, periods: ArrayLike, damping_ratio: float = 0.05
) -> ResponseSpectrum:
    """Elastic response spectrum of a motion, also by ``motion.response_spectrum``.

    Parameters
    ----------
    motion : GroundMotion
        Motion of any kind.
    periods : array_like
        Periods of the oscillators, (n,) or a number [s].
    damping_ratio : float, optional
        Damping ratio xi in [0, 1).

    Returns
    -------
    ResponseSpectrum
        Displacement, velocity and acceleration of each oscillator.

    Raises
    ------
    ValueError
        For a period that is not positive and for a damping ratio outside [0, 1).

    Notes
    -----
    The largest values are those within the steps, and after the end of the motion, when the
    oscillator is free, too.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> spectrum = analysis.response_spectrum(pulse, periods=[0.2, 0.5, 1.0])  # s
    >>> spectrum.acceleration.round(2)  # m/s2
    array([5.68, 7.89, 2.74])
    """
    if not hasattr(type(motion), "segments") and not hasattr(motion, "segments"):
        raise InputTypeError("motion", motion).give(
            "a ground motion, such as rk.GroundMotion.from_array(values, dt)"
        )
    (periods,) = positive("response_spectrum", periods=np.atleast_1d(periods))
    xi = _damping("response_spectrum", damping_ratio)
    found = np.array([_oscillator(motion, float(t), xi).largest() for t in periods.ravel()])
    u, v, a = found.T.reshape(3, *periods.shape)
    return ResponseSpectrum(periods, xi, u, v, a, motion.name)


def oscillator_history(
    motion: pieces.Motion, period: float, damping_ratio: float = 0.05
) -> OscillatorHistory:
    """Response of an elastic oscillator at the samples of a motion, exact there.

    Parameters
    ----------
    motion : GroundMotion
        Motion of any kind.
    period : float
        Period of the oscillator [s].
    damping_ratio : float, optional
        Damping ratio xi in [0, 1).

    Returns
    -------
    OscillatorHistory
        Displacements and velocities.

    Raises
    ------
    ValueError
        For a period that is not positive and for a damping ratio outside [0, 1).

    Notes
    -----
    Samples are divided where they are further apart than a sixteenth of the period; an analytic
    motion is, so that no step is longer than that and none straddles a break.
    """
    (t,) = positive("oscillator_history", period=period)
    xi = _damping("oscillator_history", damping_ratio)
    one = _oscillator(motion, float(t), xi)
    return OscillatorHistory(one.times, one.u, one.v)


def largest_displacement(
    samples: np.ndarray, dt: float, period: float, damping_ratio: float
) -> tuple[float, float]:
    """Time [s] and value [m] of the largest displacement under a record, with its sign.

    samples (n,) [m/s2] dt [s] apart. Between the steps of the oscillator by a parabola, to some
    1e-3 of the value; the time is that of the step.
    """
    one = _UnderRecord(period, damping_ratio, samples, dt)
    u = one.u
    at = int(np.abs(u).argmax())
    value = float(u[at])
    if 0 < at < len(u) - 1:
        slope, bend = 0.5 * (u[at + 1] - u[at - 1]), u[at + 1] - 2.0 * u[at] + u[at - 1]
        value -= float(0.5 * slope**2 / bend) if bend else 0.0
    return float(one.times[at]), value


def _damping(where: str, value: float) -> float:
    (xi,) = not_negative(where, damping_ratio=value)
    require(xi.ndim == 0, where, "damping_ratio", value, "give one number")
    require(xi < 1, where, "damping_ratio", xi, "from 1 on nothing vibrates: give less")
    return float(xi)


class _Oscillator:
    """One oscillator, at rest when the accelerations begin.

    times (n,) [s]; z (n,) complex, u (n,) [m] and v (n,) [m/s] there; pushes (2, n - 1) : -a_g at
    the start and at the end of each step [m/s2].
    """

    times: np.ndarray
    z: np.ndarray
    pushes: np.ndarray

    def __init__(self, period: float, xi: float) -> None:
        omega = 2 * math.pi / period
        self.rate = omega * complex(-xi, math.sqrt(1 - xi**2))

    @property
    def u(self) -> np.ndarray:
        return self.z.imag / self.rate.imag

    @property
    def v(self) -> np.ndarray:
        return self.z.real + self.rate.real * self.u

    # -- what the push of the ground does in a step, which each kind of motion knows

    def after(self, k: np.ndarray, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """z and the push -a_g [m/s2] at a time (m,) [s] after the start of each of the steps k."""
        raise NotImplementedError

    # -- the largest values

    def largest(self) -> np.ndarray:
        """Largest |u| [m], |u'| [m/s] and |u'' + a_g| [m/s2], (3,).

        Each is the real part of a complex number c times z: its rate is that of c z'. They are
        looked for at the ends of the steps, within those that may exceed them, and afterwards.
        """
        u = -1j / self.rate.imag
        v = 1.0 + self.rate.real * u
        absolute = abs(self.rate) ** 2 * u - 2.0 * self.rate.real * v
        c = np.array([[u], [v], [absolute]])
        length = np.diff(self.times)
        ends = np.abs((c * self.z).real)
        best = ends.max(axis=1)
        first = np.abs(self._rate(c, self.z[:-1], self.pushes[0]))
        last = np.abs(self._rate(c, self.z[1:], self.pushes[1]))
        # a parabola exceeds the higher end by half of this at most
        reach = 0.5 * np.minimum(first, last) * length
        highest = np.maximum(ends[:, :-1], ends[:, 1:]) + reach
        which, near = np.nonzero(highest >= best[:, None])
        place, values = self._turns(c[which, 0], near, length[near])
        np.maximum.at(best, which[place], values)
        return np.maximum(best, self._afterwards(c[:, 0]))

    def _turns(
        self, c: np.ndarray, k: np.ndarray, length: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Sizes of Re(c z) where its rate vanishes within steps k (m,), and the places in k."""
        at = np.linspace(0.0, 1.0, _PARTS + 1)[:, None] * length
        z, push = self.after(np.tile(k, _PARTS + 1), at.ravel())
        rates = self._rate(c, z.reshape(at.shape), push.reshape(at.shape))
        part, place = np.nonzero(rates[:-1] * rates[1:] < 0)
        low, width, c, k = at[part, place], length[place] / _PARTS, c[place], k[place]
        first, last = rates[part, place], rates[part + 1, place]
        bend = (last - first) / width
        time = low - first / bend
        # what is left is some 1e-6 of the part, and its square is what a largest value feels
        change = self._rate(c, *self.after(k, time)) / bend
        time = np.clip(time - change, low, low + width)
        return place, np.abs((c * self.after(k, time)[0]).real)

    def _rate(self, c: np.ndarray, z: np.ndarray, push: np.ndarray) -> np.ndarray:
        return (c * (self.rate * z + push)).real

    def _afterwards(self, c: np.ndarray) -> np.ndarray:
        """The first peaks of the free vibration after the motion: where Re(c lambda z) vanishes."""
        z = self.z[-1]
        angle = (0.5 * math.pi - np.angle(c * self.rate * z)) % math.pi
        return np.abs((c * z * np.exp(self.rate * angle / self.rate.imag)).real)


class _UnderRecord(_Oscillator):
    """Oscillators under accelerations (n,) [m/s2] that are linear between samples dt apart [s]."""

    def __init__(self, period: float, xi: float, samples: np.ndarray, dt: float) -> None:
        super().__init__(period, xi)
        parts = math.ceil(dt * _PER_PERIOD / period * (1 - 1e-12))
        if parts > 1:
            at = np.arange(parts * (len(samples) - 1) + 1) / parts
            samples, dt = np.interp(at, np.arange(len(samples)), samples), dt / parts
        self.dt, self.push = dt, -np.asarray(samples, dtype=float)
        self.pushes = np.stack([self.push[:-1], self.push[1:]])
        growth, first, last = self._step(dt)
        gained = np.zeros(len(self.push), complex)
        gained[1:] = first * self.push[:-1] + last * self.push[1:]
        self.times, self.z = dt * np.arange(len(self.push)), _recursion(growth, gained)

    def _step(self, time):
        """Factor of z in a step, and those of the push at its start and at its end."""
        w = np.asarray(self.rate * time)
        grown = np.expm1(w)
        near = np.abs(w) < 1e-2
        safe = np.where(near, 1.0, w)
        # (e**w - 1)/w and (e**w - 1 - w)/w**2, by their series where they cancel
        one = np.where(near, 1 + w / 2 * (1 + w / 3 * (1 + w / 4 * (1 + w / 5))), grown / safe)
        series = (1 + w / 3 * (1 + w / 4 * (1 + w / 5 * (1 + w / 6)))) / 2
        two = np.where(near, series, (grown / safe - 1) / safe)
        return 1 + grown, time * (one - two), time * two

    def after(self, k, time):
        start = self.push[k]
        push = start + (self.push[k + 1] - start) / self.dt * time
        growth, first, last = self._step(time)
        return growth * self.z[k] + first * start + last * push, push


class _UnderSegments(_Oscillator):
    """Oscillators under analytic segments (n, 7), each in equal steps."""

    def __init__(self, period: float, xi: float, segments: np.ndarray) -> None:
        super().__init__(period, xi)
        length = segments[:, pieces.END] - segments[:, pieces.START]
        curved = segments[:, pieces.KIND] != pieces.LINEAR
        fastest = np.where(curved, segments[:, pieces.C1] + segments[:, pieces.C3], 0.0)
        least = np.maximum(_PER_PERIOD / period, _PER_PERIOD / (2 * math.pi) * fastest)
        parts = np.ceil(length * least * (1 - 1e-12)).astype(int)
        self.rows = np.repeat(segments, parts, axis=0)
        nodes, weights = gauss_rule()
        z, begin, pushes = [np.zeros(1, complex)], [], []
        for row, n, step in zip(segments, parts, length / parts, strict=True):
            start = step * np.arange(n)
            at = 0.5 * step * (1.0 + nodes)
            factors = 0.5 * step * weights * np.exp(self.rate * (step - at))
            gained = factors @ self._push(row, start + at[:, None])
            into = np.append(z[-1][-1], gained)
            z.append(_recursion(np.exp(self.rate * step), into)[1:])
            pushes.append(self._push(row, np.stack([start, start + step])))
            begin.append(start)
        self.begin = np.concatenate(begin)  # local times of the steps' starts
        self.times = np.append(self.rows[:, pieces.START] + self.begin, segments[-1, pieces.END])
        self.z, self.pushes = np.concatenate(z), np.concatenate(pushes, axis=1)

    @staticmethod
    def _push(row: np.ndarray, tau: np.ndarray) -> np.ndarray:
        return -pieces.of_row(pieces.within, row, tau)

    def after(self, k, time):
        nodes, weights = gauss_rule()
        at = 0.5 * time * (1.0 + nodes[:, None])
        rows = self.rows[k]
        pushes = -pieces.acceleration(np.tile(rows, (len(at), 1)), (self.begin[k] + at).ravel())
        grown = np.exp(self.rate * (time - at)) * pushes.reshape(at.shape)
        z = np.exp(self.rate * time) * self.z[k] + 0.5 * time * (weights @ grown)
        return z, -pieces.acceleration(rows, self.begin[k] + time)


def _oscillator(motion: pieces.Motion, period: float, xi: float) -> _Oscillator:
    if motion.samples is not None and motion.dt is not None:
        return _UnderRecord(period, xi, motion.samples, motion.dt)
    return _UnderSegments(period, xi, motion.segments)


def _recursion(growth: complex, gained: np.ndarray) -> np.ndarray:
    """z (n,) of z[k] = growth z[k - 1] + gained[k]."""
    from scipy.signal import lfilter  # takes long to import

    return lfilter([1.0], [1.0, -growth], gained)
