"""Restitution at each impact of a free rocking test, from the peaks before and after it.

    from rockeom.analysis import identification

    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
    found = identification.Impacts.of_record(record, block, threshold=6.0)    # J
    found.energy_ratio, found.half_width, found.foot, found.speed
    found.at_foot("left").mean()

Between two impacts the structure keeps its energy, so that r is the ratio of its potential energies
at both peaks: thesis 3-3, 3-16 and 5-4. The energies are the structure's own, of any structure.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.formulas.restitution import spring_energy
from rockeom.analysis.identification.energies import (
    Energies,
    energies_of_states,
    equilibrium_states,
)
from rockeom.analysis.identification.free_vibration import coefficient_of_determination
from rockeom.analysis.identification.noise import COVERED, Noise
from rockeom.analysis.identification.records import MeasuredRecord
from rockeom.numbers.arguments import not_negative, numbers, require
from rockeom.structures.evaluation import at_states

if TYPE_CHECKING:
    from rockeom.structures.base import Structure


def _rotation_of(structure: Structure) -> str:
    return structure.states[structure.module.ROTATION]


def _speed(structure: Structure, y: np.ndarray, energy: float) -> float:
    """Angular velocity upright, before the impact, of a structure released at a peak."""
    m = structure.module
    moving = structure.state({m.STATES[m.ROTATION_RATE]: 1.0})[None]
    mode = np.array([structure.mode_number(y)])
    energies = at_states(m, structure.vector, "energies", mode, moving)
    kinetic = float(energies["kinetic_energy"][0])
    return float(-np.sign(y[m.ROTATION]) * np.sqrt(energy / kinetic))


# --- peaks, and their standard deviations


class Peaks(NamedTuple):
    """Peaks of a channel.

    Parameters
    ----------
    time : ndarray
        Times (n,) [s].
    value : ndarray
        Values with their sign (n,), in the unit of the channel.
    deviation : ndarray
        Standard deviations of the values (n,).
    """

    time: np.ndarray
    value: np.ndarray
    deviation: np.ndarray


def fitted_peaks(
    record: MeasuredRecord, channel: str, smallest: float | None = None, reach: float = 0.5
) -> Peaks:
    """Peaks of a free vibration, each of the polynomial of degree 4 that fits it best.

    Parameters
    ----------
    record : MeasuredRecord
        Record of a free vibration that counts from upright.
    channel : str
        Channel of the record.
    smallest : float, optional
        Displacement at which the record has swung to the other side, as in
        `MeasuredRecord.free_vibration`.
    reach : float, optional
        Part of a half-cycle, about its middle, over which the polynomial is fitted.

    Returns
    -------
    Peaks
        Peaks, with deviations by the noise of the record, or by the residuals of the polynomial
        where they are larger.
    """
    free = record.free_vibration(channel, smallest)
    t, x, noise = record.time, record[channel], record.noise[channel]
    at, quarters = free.time, np.diff(free.time)
    rows = []
    for i in np.flatnonzero(free.at_peak):
        # between crossings a half-cycle is the same forward and backward, about its peak
        before = at[i - 1] if i else at[i] - quarters[0]
        after = at[i + 1] if i + 1 < len(at) else at[i] + quarters[-1]
        middle = (before + after) / 2
        near = np.abs(t - middle) <= reach * (after - before) / 2
        rows.append(_fitted_peak(t[near], x[near], noise, at[i], free.displacement[i]))
    return Peaks(*(np.array(column) for column in zip(*rows, strict=True)))


class PeakChange(NamedTuple):
    """Effect of a filter on peaks, (n,) each.

    Parameters
    ----------
    time : ndarray
        Time [s].
    before : ndarray
        Height before the filter, in the unit of the channel.
    after : ndarray
        Height after it.
    deviation : ndarray
        Standard deviation of the height before.
    """

    time: np.ndarray
    before: np.ndarray
    after: np.ndarray
    deviation: np.ndarray


def low_pass_on_peaks(
    record: MeasuredRecord,
    channel: str,
    cutoff: float,
    order: int = 4,
    smallest: float | None = None,
) -> PeakChange:
    """Peaks of a free vibration before and after `MeasuredRecord.low_pass`.

    Parameters
    ----------
    record : MeasuredRecord
        Record of a free vibration.
    channel : str
        Channel of the record.
    cutoff : float
        Cutoff frequency of the filter [Hz].
    order : int, optional
        Order of the filter.
    smallest : float, optional
        Displacement at which the record has swung to the other side, as in
        `MeasuredRecord.free_vibration`.

    Returns
    -------
    PeakChange
        Heights before, by `fitted_peaks`, and after, the largest sample about each peak.

    Notes
    -----
    A peak of rocking is round, an impact a bend of the trace: the filter hardly lowers a peak whose
    half-cycle is long against 1/cutoff, and rounds the bends. It lowers a peak at the start of a
    record, too.
    """
    peaks = fitted_peaks(record, channel, smallest)
    filtered = record.low_pass(cutoff, order)[channel]
    middles = (peaks.time[1:] + peaks.time[:-1]) / 2
    parts = np.split(filtered, np.searchsorted(record.time, middles))
    after = [part[np.argmax(part * np.sign(x))] for part, x in zip(parts, peaks.value, strict=True)]
    return PeakChange(peaks.time, peaks.value, np.array(after), peaks.deviation)


_DOUBT = 4.0  # standard deviations of the residual's own scatter


def _fitted_peak(
    t: np.ndarray, x: np.ndarray, noise: Noise, guess: float, value: float
) -> tuple[float, float, float]:
    """(time, value, standard deviation) of the extreme of the polynomial that fits samples."""
    degree = 4 if len(t) >= 10 else 2
    if len(t) < degree + 2:
        return guess, value, noise.level
    scale = max(t[-1] - guess, guess - t[0])
    powers = np.vander((t - guess) / scale, degree + 1, increasing=True)
    weights = np.linalg.pinv(powers)
    best = np.polynomial.Polynomial(weights @ x)
    turning = best.deriv().roots()
    turning = turning[np.abs(turning.imag) < 1e-9].real
    lowest, highest = (t[0] - guess) / scale, (t[-1] - guess) / scale
    at = np.append(turning[(turning >= lowest) & (turning <= highest)], [lowest, highest])
    at = at[np.argmax(np.abs(best(at)))]
    deviation = noise.of_sum(at ** np.arange(degree + 1) @ weights)
    left = x - powers @ best.coef
    free = len(t) - degree - 1
    unexplained = np.sqrt(left @ left / free)
    if unexplained > noise.level * (1 + _DOUBT / np.sqrt(2 * free)):
        grown = Noise.white(unexplained).of_sum(at ** np.arange(degree + 1) @ weights)
        deviation = max(deviation, grown)
    return float(guess + scale * at), float(best(at)), deviation


# --- impacts


class Mean(NamedTuple):
    """Mean energy ratio of several impacts.

    Parameters
    ----------
    energy_ratio : float
        Mean of r.
    half_width : float
        Half-width of its interval of confidence at 95 %.
    scatter : float
        Standard deviation of r.
    number : int
        Number of impacts.
    """

    energy_ratio: float
    half_width: float
    scatter: float
    number: int


class EnergyLossFit(NamedTuple):
    """Energy lost at an impact as a polynomial of its speed; thesis 3-17 and 3-18.

    A call with speeds [rad/s] returns the change of energy [J], negative where it is lost.

    Parameters
    ----------
    coefficients : ndarray
        Coefficients (k,) of speed, speed^2, ... [J/(rad/s)^n].
    deviations : ndarray
        Standard deviations of these (k,).
    r_squared : float
        Coefficient of determination.
    """

    coefficients: np.ndarray
    deviations: np.ndarray
    r_squared: float

    def __call__(self, speed: ArrayLike) -> np.ndarray:
        (v,) = numbers("EnergyLossFit", speed=speed)
        return np.polynomial.polynomial.polyval(v, np.append(0.0, self.coefficients))


@dataclass(frozen=True, eq=False)
class Impacts:
    """Impacts of a free rocking test in the order of time, (n,) each.

    Parameters
    ----------
    time : ndarray
        Time between the two peaks [s].
    foot : ndarray
        "left" or "right", the foot that lands.
    speed : ndarray
        Angular velocity just before, of the energy before [rad/s]; positive where the right foot
        lands.
    peak_before : ndarray
        Rotation, or value of the measured quantity, at the peak before.
    peak_after : ndarray
        Rotation, or value of the measured quantity, at the peak after.
    energy_before : ndarray
        Energy above upright at the peak before [J].
    energy_after : ndarray
        Energy above upright at the peak after [J].
    half_width : ndarray
        Half-width of the interval about `energy_ratio` in which it lies with 95 %, by the noise
        alone; 0 where none was stated.
    """

    time: np.ndarray
    foot: np.ndarray
    speed: np.ndarray
    peak_before: np.ndarray
    peak_after: np.ndarray
    energy_before: np.ndarray
    energy_after: np.ndarray
    half_width: np.ndarray

    @classmethod
    def of_record(
        cls,
        record: MeasuredRecord,
        structure: Structure,
        channel: str | None = None,
        *,
        quantity: str | None = None,
        threshold: float = 0.0,
        rotational_stiffness: float = 0.0,
        smallest: float | None = None,
    ) -> Impacts:
        """Impacts by the peaks of a channel of a record, as `of_peaks`.

        Parameters
        ----------
        record : MeasuredRecord
            Record as measured; each peak is fitted, which needs no filter, and the noise of the
            record gives the intervals.
        structure : Structure
            Structure of the test.
        channel : str, optional
            Channel; "theta", or as the structure calls its rotation, if not given.
        quantity : str, optional
            Quantity that the channel has measured, as in `of_peaks`.
        threshold : float, optional
            Impacts with less energy before them are left out [J].
        rotational_stiffness : float, optional
            Stiffness of an elastic rotational spring [N m/rad]; thesis 3-16.
        smallest : float, optional
            Displacement at which the record has swung to the other side, as in
            `MeasuredRecord.free_vibration`.

        Returns
        -------
        Impacts
            Impacts in the order of time.

        Raises
        ------
        ValueError
            As `of_peaks`.
        """
        peaks = fitted_peaks(record, channel or _rotation_of(structure), smallest)
        return cls.of_peaks(
            peaks.time,
            peaks.value,
            structure,
            quantity=quantity,
            deviation=peaks.deviation,
            threshold=threshold,
            rotational_stiffness=rotational_stiffness,
        )

    @classmethod
    def of_peaks(
        cls,
        time: ArrayLike,
        peaks: ArrayLike,
        structure: Structure,
        *,
        quantity: str | None = None,
        deviation: ArrayLike = 0.0,
        threshold: float = 0.0,
        rotational_stiffness: float = 0.0,
    ) -> Impacts:
        """Impacts by successive peaks: r = U_after/U_before by the structure's own energies.

        Parameters
        ----------
        time : array_like
            Times of the peaks (n,) [s].
        peaks : array_like
            Rotations of the structure on both sides in turn, signed (n,) [rad], or values of the
            quantity.
        structure : Structure
            Structure of the test.
        quantity : str, optional
            Quantity of the peaks, if not the rotation: "displacement" of the load point or another
            that grows with the rotation, as in `static_energy`.
        deviation : array_like, optional
            Standard deviation of the peaks, (n,) or one for all.
        threshold : float, optional
            Impacts with less energy before them are left out [J]; r is a ratio, and its error grows
            as the energy falls. Thesis section 3.2.4 uses 6 J for its block.
        rotational_stiffness : float, optional
            Stiffness of an elastic rotational spring [N m/rad]; thesis 3-16.

        Returns
        -------
        Impacts
            Impacts in the order of time.

        Raises
        ------
        ValueError
            For fewer than two peaks, peaks that do not change side, and a peak at or beyond the
            balance of the structure.
        """
        where = "Impacts.of_peaks"
        t, x = numbers(where, time=time, peaks=peaks)
        (sigma,) = not_negative(where, deviation=deviation)
        (least,) = not_negative(where, threshold=threshold)
        if x.ndim != 1 or len(x) < 2 or t.shape != x.shape:
            raise ValueError(
                f"{where}: time has the shape {t.shape}, peaks has {x.shape}: give one time for "
                "each of at least two peaks"
            )
        rule = "successive peaks lie on both sides in turn"
        require(x[1:] * x[:-1] < 0, where, "peaks", x[1:], rule)

        def energy(y: np.ndarray) -> np.ndarray:
            spring = spring_energy(y[:, structure.module.ROTATION], rotational_stiffness)
            return energies_of_states(structure, y).total + spring

        h = 1e-4 * np.abs(x)
        below, y, above = (
            equilibrium_states(structure, x + step, quantity) for step in (-h, 0.0, h)
        )
        u, slope = energy(y), (energy(above) - energy(below)) / (2 * h)
        unit = "radians" if quantity is None else "SI units"
        rule = f"a free structure turns back before its balance; give {unit}"
        require((u > 0) & (np.sign(x) * slope > 0), where, "peaks", x, rule)
        relative = np.broadcast_to(sigma, x.shape) * slope / u
        ratio = u[1:] / u[:-1]
        half_width = COVERED * ratio * np.hypot(relative[1:], relative[:-1])
        counted = u[:-1] >= least
        speed = [_speed(structure, a, b) for a, b in zip(y[:-1], u[:-1], strict=True)]
        impacts = cls(
            time=(t[1:] + t[:-1]) / 2,
            foot=np.where(x[1:] > 0, "right", "left"),
            speed=np.array(speed),
            peak_before=x[:-1],
            peak_after=x[1:],
            energy_before=u[:-1],
            energy_after=u[1:],
            half_width=half_width,
        )
        return impacts.select(counted)

    @property
    def energy_ratio(self) -> np.ndarray:
        """r, the ratio of the energies after and before each impact; may exceed 1."""
        return self.energy_after / self.energy_before

    @property
    def energy_change(self) -> np.ndarray:
        """Energy after less energy before [J]; negative where it is lost."""
        return self.energy_after - self.energy_before

    def __len__(self) -> int:
        return len(self.time)

    def select(self, chosen: ArrayLike) -> Impacts:
        """Some of the impacts.

        Parameters
        ----------
        chosen : array_like
            Mask (n,) or numbers of impacts.

        Returns
        -------
        Impacts
            Selected impacts.
        """
        rows = np.asarray(chosen)
        return Impacts(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})

    def at_foot(self, foot: str) -> Impacts:
        """Impacts in which one of the feet lands.

        Parameters
        ----------
        foot : str
            "left" or "right".

        Returns
        -------
        Impacts
            Impacts of this foot.

        Raises
        ------
        ValueError
            For another foot.
        """
        if foot not in ("left", "right"):
            raise ValueError(f"Impacts.at_foot: foot is {foot!r}: left or right")
        return self.select(self.foot == foot)

    @staticmethod
    def together(several: list[Impacts]) -> Impacts:
        """Impacts of several tests, one after the other.

        Parameters
        ----------
        several : list of Impacts
            Impacts of each test.

        Returns
        -------
        Impacts
            Impacts of all tests.
        """
        names = [f.name for f in fields(Impacts)]
        return Impacts(**{n: np.concatenate([getattr(s, n) for s in several]) for n in names})

    def mean(self) -> Mean:
        """Mean of r with its interval, and how it scatters.

        Returns
        -------
        Mean
            Mean, interval, scatter and number.

        Raises
        ------
        ValueError
            Where there is no impact.

        Notes
        -----
        Where the noise explains the scatter (99 % of chi-squared) each counts by its accuracy, and
        the interval is that of the noise. Else the ratios themselves differ, or no noise was
        stated: all count alike, and the interval is that of their scatter (Student's t). Impacts of
        one foot share no peak; of both feet they do, and then it is somewhat too wide.
        """
        from scipy.stats import chi2, t

        r, n = self.energy_ratio, len(self)
        if not n:
            raise ValueError("Impacts.mean: there is no impact: lower the threshold")
        scatter = float(np.std(r, ddof=1)) if n > 1 else 0.0
        sigma = self.half_width / COVERED
        if np.all(sigma > 0):
            weights = sigma**-2 / np.sum(sigma**-2)
            mean = float(weights @ r)
            if n == 1 or np.sum(((r - mean) / sigma) ** 2) <= chi2.ppf(0.99, n - 1):
                return Mean(mean, float(COVERED * np.sqrt(weights**2 @ sigma**2)), scatter, n)
        half_width = float(t.ppf(0.975, n - 1) * scatter / np.sqrt(n)) if n > 1 else np.inf
        return Mean(float(np.mean(r)), half_width, scatter, n)

    def cumulative(self) -> tuple[np.ndarray, np.ndarray]:
        """Cumulative distribution of r; thesis Figure 3-20.

        Returns
        -------
        r : ndarray
            Sorted r (n,).
        part : ndarray
            Part of the impacts with no more (n,).
        """
        return np.sort(self.energy_ratio), np.arange(1, len(self) + 1) / len(self)

    def histogram(self, width: float = 0.01) -> tuple[np.ndarray, np.ndarray]:
        """Histogram of r in classes of equal width; thesis Figure 3-19.

        Parameters
        ----------
        width : float, optional
            Width of a class.

        Returns
        -------
        edges : ndarray
            Edges of the k classes (k + 1,).
        counts : ndarray
            Number of impacts in each (k,).
        """
        r = self.energy_ratio
        first, last = np.floor(r.min() / width), np.floor(r.max() / width) + 1
        edges = width * np.arange(first, last + 1)
        return edges, np.histogram(r, edges)[0]

    def energy_loss_fit(self, degree: int = 3) -> EnergyLossFit:
        """Least squares of the change of energy on speed, speed^2, ...; thesis 3-17, 3-18.

        Parameters
        ----------
        degree : int, optional
            Highest power of the speed.

        Returns
        -------
        EnergyLossFit
            Coefficients with their deviations.

        Raises
        ------
        ValueError
            For fewer impacts than degree + 1.

        Notes
        -----
        There is no constant: no energy is lost without speed.
        """
        if len(self) < degree + 1:
            raise ValueError(
                f"Impacts.energy_loss_fit: {len(self)} impacts do not determine a polynomial of "
                f"degree {degree}: lower it, or join impacts of more tests"
            )
        powers = np.vander(self.speed, degree + 1, increasing=True)[:, 1:]
        loss = self.energy_change
        coefficients = np.linalg.lstsq(powers, loss, rcond=None)[0]
        left = loss - powers @ coefficients
        variance = left @ left / max(len(loss) - degree, 1)
        deviations = np.sqrt(variance * np.diag(np.linalg.inv(powers.T @ powers)))
        return EnergyLossFit(
            coefficients, deviations, coefficient_of_determination(loss, powers @ coefficients)
        )


# --- energy in the course of a record


def record_energies(record: MeasuredRecord, structure: Structure) -> Energies:
    """Energies of a structure at each sample of a record, above those upright.

    Thesis 3-1, 3-2, Figure 3-9.

    Parameters
    ----------
    record : MeasuredRecord
        Channels named as the structure's states, at least the rotation and its rate, such as theta
        and theta_dot (`MeasuredRecord.with_derivatives`); states that it lacks count as zero.
    structure : Structure
        Structure of the test.

    Returns
    -------
    Energies
        Energies (n,) each [J]. Each sample counts as on the foot of its side.

    Raises
    ------
    ValueError
        Where the rotation or its rate is missing.
    """
    m = structure.module
    rotation, rate = m.STATES[m.ROTATION], m.STATES[m.ROTATION_RATE]
    missing = [n for n in (rotation, rate) if n not in record.channels]
    if missing:
        raise ValueError(
            f"record_energies: the record has no {', '.join(missing)}: add it, the rate by "
            f"with_derivatives({rotation!r})"
        )
    y = np.zeros((len(record.time), m.N_STATES))
    for i, name in enumerate(m.STATES):
        if name in record.channels:
            y[:, i] = record[name]
    small = 1e-3 * structure.overturning_rotation
    left, right = (structure.mode_number(structure.equilibrium(x)[1]) for x in (-small, small))
    return energies_of_states(structure, y, np.where(y[:, m.ROTATION] >= 0, right, left))


class RotationalSpring(NamedTuple):
    """Rotational spring fitted to a record.

    Parameters
    ----------
    stiffness : float
        Stiffness [N m/rad].
    deviation : float
        Standard deviation of the stiffness [N m/rad].
    of_half_cycles : ndarray
        Stiffness of each half-cycle (n,) [N m/rad].
    """

    stiffness: float
    deviation: float
    of_half_cycles: np.ndarray


def fitted_rotational_spring(
    record: MeasuredRecord,
    structure: Structure,
    channel: str | None = None,
    count: int | None = None,
) -> RotationalSpring:
    """Rotational spring with which the total energy is most constant between impacts; thesis 3-4.

    Parameters
    ----------
    record : MeasuredRecord
        Record of a free vibration, as in `record_energies`.
    structure : Structure
        Structure of the test.
    channel : str, optional
        Channel of the rotation, as in `Impacts.of_record`.
    count : int, optional
        Number of half-cycles, from the first; all if not given.

    Returns
    -------
    RotationalSpring
        Stiffness of all half-cycles and of each.

    Raises
    ------
    ValueError
        For fewer than two half-cycles.

    Notes
    -----
    The stiffness of a half-cycle is that of the straight line through the energy against theta^2/2,
    without the samples near the impacts and at the release. The mean weights them by the spread of
    theta^2, and its deviation is that of their scatter.
    """
    channel = channel or _rotation_of(structure)
    free = record.free_vibration(channel)
    crossings = free.time[~free.at_peak]
    total = record_energies(record, structure).total
    spring = np.square(record[channel]) / 2
    stiffness, weight = [], []
    for start, end in list(pairwise(crossings))[:count]:
        margin = 0.1 * (end - start)
        inside = (record.time > start + margin) & (record.time < end - margin)
        s = spring[inside] - spring[inside].mean()
        stiffness.append(-(s @ total[inside]) / (s @ s))
        weight.append(s @ s)
    k, w = np.array(stiffness), np.array(weight)
    if len(k) < 2:
        raise ValueError(
            f"fitted_rotational_spring: {len(k)} half-cycles between crossings of {channel}: give "
            "a record with at least two"
        )
    mean = float(np.average(k, weights=w))
    part = w / w.sum()
    deviation = float(np.sqrt(np.sum(part**2 * (k - mean) ** 2) * len(k) / (len(k) - 1)))
    return RotationalSpring(mean, deviation, k)


def rotational_stiffness_from_excess(excess_energy: ArrayLike, rotation: ArrayLike):
    """Stiffness of the spring that holds an excess of energy at a rotation; from thesis 3-4.

    Parameters
    ----------
    excess_energy : array_like
        Excess of energy E [J].
    rotation : array_like
        Rotation theta at which it occurs [rad].

    Returns
    -------
    float or ndarray
        Stiffness 2 E/theta^2 [N m/rad], as in thesis section 3.2.2, in the shape of both,
        broadcast.

    Raises
    ------
    ValueError
        For a rotation of zero.
    """
    where = "rotational_stiffness_from_excess"
    energy, theta = numbers(where, excess_energy=excess_energy, rotation=rotation)
    require(theta != 0, where, "rotation", theta, "upright a spring holds no energy")
    return 2 * energy / theta**2
