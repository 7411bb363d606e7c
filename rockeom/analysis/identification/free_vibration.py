"""A free vibration, measured or computed: peaks, quarter periods, losses, rotation centre.

from rockeom.analysis import identification

measured = identification.FreeVibration.table_a1()
measured.restitution(rk.ControlledWall.thesis())  # of each passage, by the energies of a structure

record = identification.FreeVibration.from_samples(t, displacement, acceleration=a)
record.quarter_periods()
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass, fields
from importlib.resources import files
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.formulas.controlled_wall import Wall
from rockeom.analysis.formulas.damping import damping_from_decrement
from rockeom.analysis.identification.energies import (
    Energies,
    energies_of_states,
    equilibrium_states,
)
from rockeom.analysis.identification.noise import noise_level
from rockeom.numbers.checks import InputError, not_negative, numbers, positive, require

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

    from rockeom.structures.base import Structure


class QuarterPeriods(NamedTuple):
    """Times from a peak to the next crossing.

    Parameters
    ----------
    peak : ndarray
        Signed peak (n,) [m].
    time : ndarray
        Time between the two (n,) [s].
    """

    peak: np.ndarray
    time: np.ndarray


class CycleDamping(NamedTuple):
    """Damping ratio of each cycle.

    Parameters
    ----------
    peak : ndarray
        First peak of each cycle, signed [m].
    ratio : ndarray
        Damping ratio of the cycle.
    """

    peak: np.ndarray
    ratio: np.ndarray


class Restitution(NamedTuple):
    """Loss of energy at each crossing of upright, (n,) each.

    Parameters
    ----------
    energy_ratio : ndarray
        Ratio r of the energies after and before it.
    speed : ndarray
        Speed at the crossing [m/s].
    peak_before : ndarray
        Peak displacement before it [m].
    """

    energy_ratio: np.ndarray
    speed: np.ndarray
    peak_before: np.ndarray


@dataclass(frozen=True, eq=False)
class FreeVibration:
    """Peaks of a free vibration and the crossings between them, as in thesis Table A-1.

    Each array has the shape (n,), in the order of time; peaks and crossings alternate. Not each
    record has those that are optional.

    Parameters
    ----------
    at_peak : ndarray
        Which instants are peaks; the others are crossings.
    time : ndarray
        Time [s].
    displacement : ndarray
        Displacement [m].
    velocity : ndarray
        Velocity [m/s].
    acceleration : ndarray
        Acceleration [m/s2].
    tendon_force : ndarray, optional
        Force of the tendon [N].
    left_uplift : ndarray, optional
        Uplift of the left edge of the base, positive upwards [m].
    right_uplift : ndarray, optional
        Uplift of the right edge of the base, positive upwards [m].
    centre_from_edge : ndarray, optional
        Distance of the rotation centre as a table states it [m].
    reading : ndarray, optional
        How legible the row of a table was.
    """

    at_peak: np.ndarray
    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    tendon_force: np.ndarray | None = None
    left_uplift: np.ndarray | None = None
    right_uplift: np.ndarray | None = None
    centre_from_edge: np.ndarray | None = None
    reading: np.ndarray | None = None

    def __post_init__(self) -> None:
        shape = np.shape(self.time)
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None and np.shape(value) != shape:
                raise InputError(field.name, of="FreeVibration").says(
                    f"{field.name} has the shape {np.shape(value)}, time has {shape}: give one "
                    "value for each peak and crossing"
                )
        if np.any(self.at_peak[1:] == self.at_peak[:-1]):
            raise InputError("at_peak", of="FreeVibration").wrong("must alternate")
        require(
            np.diff(self.time) > 0, "FreeVibration", "time", self.time[1:], "times must increase"
        )

    @classmethod
    def table_a1(cls) -> FreeVibration:
        """Thesis Table A-1: test run 5 of the wall of chapter 4, 23 peaks and 22 crossings.

        Returns
        -------
        FreeVibration
            Free vibration with all that the table has.

        Notes
        -----
        Crossings are the instants without acceleration. centre_from_edge is the distance from the
        uplift gauge, 30 mm outside the edge. `reading` of a row: "clean" as scanned; "repaired", of
        a single possible reading, in which the scan has a slash for a 7; "guessed", where a cell is
        put back from the rows around it. rockeom/analysis/data/table_a1.csv has what was scanned.
        """
        text = files("rockeom.analysis").joinpath("data/table_a1.csv").read_text("utf-8")
        rows = list(csv.DictReader(text.splitlines()))

        def column(name: str, unit: float = 1.0) -> np.ndarray:
            return np.array([float(row[name]) for row in rows]) * unit

        return cls(
            at_peak=np.array([row["event"] == "peak" for row in rows]),
            time=column("time [s]"),
            displacement=column("displacement [mm]", 1e-3),
            velocity=column("velocity [m/s]"),
            acceleration=column("acceleration [m/s2]"),
            tendon_force=column("tendon force [kN]", 1e3),
            left_uplift=column("left uplift [mm]", 1e-3),
            right_uplift=column("right uplift [mm]", 1e-3),
            centre_from_edge=column("rotation centre [mm]", 1e-3),
            reading=np.array([row["reading"] for row in rows]),
        )

    @classmethod
    def from_samples(
        cls,
        time: ArrayLike,
        displacement: ArrayLike,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        tendon_force: ArrayLike | None = None,
        left_uplift: ArrayLike | None = None,
        right_uplift: ArrayLike | None = None,
        *,
        smallest: float | None = None,
        crossing: str = "displacement",
    ) -> FreeVibration:
        """Peaks and crossings of a sampled record, between samples by cubic splines.

        Parameters
        ----------
        time : array_like
            Times (samples,) [s], increasing.
        displacement : array_like
            Displacements (samples,) from upright [m].
        velocity : array_like, optional
            Velocities (samples,) [m/s]; the derivative of the displacement's spline if not given.
        acceleration : array_like, optional
            Accelerations (samples,) [m/s2]; the second derivative if not given.
        tendon_force : array_like, optional
            Forces of the tendon (samples,) [N].
        left_uplift : array_like, optional
            Uplifts of the left edge (samples,) [m].
        right_uplift : array_like, optional
            Uplifts of the right edge (samples,) [m].
        smallest : float, optional
            Displacement [m] at which the record has swung to the other side; noise about upright is
            below it, and a half-cycle with a smaller peak is not one. It follows from the record,
            by `resolved_floor`, if not given.
        crossing : str, optional
            "displacement", where that is zero, or "acceleration", as in the thesis, whose wall
            slid, so that a zero displacement is not upright. With losses spread over the
            displacement the acceleration vanishes up to some mm before upright.

        Returns
        -------
        FreeVibration
            Peaks and crossings in turn.

        Raises
        ------
        ValueError
            Where nothing turns back, for times that do not increase, and for a gap in the samples
            (NaN).

        Notes
        -----
        A record that begins at rest has its first peak there, within one sample; a last half-cycle
        that does not turn back, by more than `smallest`, has none.
        """
        from scipy.interpolate import CubicSpline  # takes long to import

        offered = {
            "displacement": displacement,
            "velocity": velocity,
            "acceleration": acceleration,
            "tendon_force": tendon_force,
            "left_uplift": left_uplift,
            "right_uplift": right_uplift,
        }
        where = "FreeVibration.from_samples"
        t, channels = _sampled(
            where, time, {name: value for name, value in offered.items() if value is not None}
        )
        x = channels["displacement"]
        if smallest is None:
            smallest = resolved_floor(t, x)
        (floor,) = not_negative(where, smallest=smallest)
        if crossing not in ("displacement", "acceleration"):
            raise InputError("crossing", crossing, where).so("displacement or acceleration")

        splines = {name: CubicSpline(t, values) for name, values in channels.items()}
        path = splines["displacement"]
        splines.setdefault("velocity", path.derivative())
        splines.setdefault("acceleration", path.derivative(2))
        peaks = _peaks(t, x, path, float(floor))
        if not peaks:
            raise InputError("displacement", of=where).wrong(f"has no peak above {floor} m")
        zeros = splines[crossing].roots(discontinuity=False, extrapolate=False)
        at = _with_crossings(where, peaks, zeros, crossing)
        return cls(
            at_peak=np.arange(len(at)) % 2 == 0,
            time=at,
            **{name: spline(at) for name, spline in splines.items()},
        )

    def quarter_periods(self) -> QuarterPeriods:
        """Times from each peak to the crossing after it; thesis Figure 4-13.

        Returns
        -------
        QuarterPeriods
            Peaks and times.
        """
        starts = np.flatnonzero(self.at_peak[:-1])
        return QuarterPeriods(self.displacement[starts], np.diff(self.time)[starts])

    def damping_ratios(self) -> CycleDamping:
        """Damping of each cycle, from a peak to the next one of its side; thesis 5-7, Figure 5-16.

        Returns
        -------
        CycleDamping
            Damping ratios by the formula of small damping, `damping_from_decrement`; negative where
            the motion grew.
        """
        peaks = self.displacement[self.at_peak]
        return CycleDamping(peaks[:-2], damping_from_decrement(peaks[:-2], peaks[2:]))

    def energies(self, structure: Wall | Structure, quantity: str = "displacement") -> Energies:
        """Energies of a structure at each peak and crossing, above upright; thesis 4-18 to 4-20.

        Parameters
        ----------
        structure : Wall or Structure
            Any structure, by its own energies, in its states of equilibrium at the displacements of
            the record, with the velocities of the record; see `static_energy`.
        quantity : str, optional
            Quantity of the structure that the record calls displacement: its rotation, "theta", or
            one of a response that grows with it; of a `Wall`, Figure 4-29, the displacement at its
            height H. Where the record has the force of the wall's only tendon, the elastic energy
            is that of the measured force.

        Returns
        -------
        Energies
            Energies (n,) [J].

        Raises
        ------
        ValueError
            For a measured force beyond yield and for several tendons.
        """
        if not isinstance(structure, Wall):
            return _energies_of(structure, quantity, self.displacement, self.velocity)
        wall = structure
        if self.tendon_force is None:
            elastic = wall.elastic_energy(self.displacement)
        elif len(wall.tendons) == 1:
            elastic = wall.tendons[0].energy_at_force(self.tendon_force)
        else:
            raise InputError("wall", of="FreeVibration.energies").says(
                f"one tendon_force does not determine the energies of {len(wall.tendons)} tendons: "
                "leave it out of the record"
            )
        return Energies(
            wall.gravity_energy(self.displacement),
            elastic,
            wall.kinetic_energy(self.displacement, self.velocity),
        )

    def restitution(
        self, structure: Wall | Structure, quantity: str = "displacement"
    ) -> Restitution:
        """Apparent coefficients of restitution, between successive peaks; thesis Figure 4-30.

        Parameters
        ----------
        structure : Wall or Structure
            Structure, as in `energies`.
        quantity : str, optional
            Quantity of the structure that the record calls displacement, as in `energies`.

        Returns
        -------
        Restitution
            Energy ratios r of the total energies at the peaks after and before each crossing, and
            the speeds at the crossings.

        Raises
        ------
        ValueError
            As `energies`.

        See Also
        --------
        Impacts : Energy ratios with their uncertainty.
        """
        peaks = np.flatnonzero(self.at_peak)
        total = self.energies(structure, quantity).total[peaks]
        speed = np.abs(self.velocity[peaks[:-1] + 1])
        return Restitution(total[1:] / total[:-1], speed, self.displacement[peaks[:-1]])

    def rotation_centre(self, half_width: float) -> np.ndarray:
        """Distance of the rotation centre from the pressed edge, from the uplifts; thesis 4-1, 4-2.

        Parameters
        ----------
        half_width : float
            Half of the width of the base, B [m].

        Returns
        -------
        ndarray
            Distance (n,) [m], NaN where the uplifts are equal.

        Raises
        ------
        ValueError
            For a record without uplifts, and a half-width that is not positive.

        Notes
        -----
        Where the base is straight it is 2 B u/(u - u'), u the uplift of the pressed edge, mostly
        negative, and u' that of the other; negative where both are positive. The pressed edge is
        that of the smaller uplift.
        """
        if self.left_uplift is None or self.right_uplift is None:
            raise InputError("record", of="FreeVibration.rotation_centre").says(
                "the record has no uplifts: give both"
            )
        (b,) = positive("FreeVibration.rotation_centre", half_width=half_width)
        pressed = np.minimum(self.left_uplift, self.right_uplift)
        difference = pressed - np.maximum(self.left_uplift, self.right_uplift)
        centre = np.full(difference.shape, np.nan)
        return np.divide(2 * b * pressed, difference, out=centre, where=difference != 0)


def _energies_of(
    structure: Structure, quantity: str, value: np.ndarray, rate: np.ndarray
) -> Energies:
    """Energies of a structure that passes its states of equilibrium, by values of a quantity."""
    y = equilibrium_states(structure, value, quantity)
    step = 1e-6 * np.abs(value).max()
    above, below = (equilibrium_states(structure, value + h, quantity) for h in (step, -step))
    half = structure.module.N_STATES // 2
    moving = y.copy()
    moving[:, half:] = rate[:, None] * (above - below)[:, :half] / (2 * step)
    # the states of equilibrium determine the mode of a tendon; upright, the direction of motion
    turned = y[:, structure.module.ROTATION] != 0
    states = np.where(turned[:, None], y, moving)
    modes = np.array([structure.mode_number(state) for state in states], dtype=int)
    return energies_of_states(structure, moving, modes)


def resolved_floor(time: ArrayLike, displacement: ArrayLike, noise: float | None = None) -> float:
    """Smallest peak that a record of free vibration resolves, in its unit.

    Parameters
    ----------
    time : array_like
        Times (n,) [s].
    displacement : array_like
        Displacements (n,) from upright, in any unit.
    noise : float, optional
        Standard deviation of the noise; `noise_level` of the record if not given.

    Returns
    -------
    float
        Smallest peak, in the unit of the displacement.

    Notes
    -----
    It is the larger of two: five standard deviations, which noise exceeds once in two million
    samples; and the peak of the largest half-cycle of fewer than six samples, whose height they do
    not show. A record without noise thus ends where rocking becomes too fast for it, and one that
    is at rest for most of its time needs no `smallest`.
    """
    t, x = numbers("resolved_floor", time=time, displacement=displacement)
    if noise is None:
        noise = noise_level(t, x) if len(t) >= 8 else 0.0
    floor = _CLEAR * float(noise)
    index, starts = _half_cycles(x, floor)
    for i, j in pairwise(starts):
        if 0 < j - i < _RESOLVED and index[i] > 0:  # what the start cuts off says nothing
            floor = max(floor, float(np.abs(x[index[i:j]]).max()))
    return floor


_CLEAR = 5.0  # standard deviations
_RESOLVED = 6  # samples


def _sampled(
    where: str, time: ArrayLike, channels: Mapping[str, ArrayLike]
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Times (n,) and channels (n,) as arrays; ValueError for other shapes, or times in disorder."""
    t, *arrays = numbers(where, time=time, **channels)
    named = dict(zip(channels, arrays, strict=True))
    for name, values in named.items():
        if values.shape != t.shape or t.ndim != 1 or len(t) < 4:
            raise InputError(name, of=where).wrong(
                f"has the shape {values.shape}, time has {t.shape}: give one value for each of at "
                "least 4 instants"
            )
    rule = "times must increase: drop one of two equal instants"
    require(np.diff(t) > 0, where, "time", t[1:], rule)
    return t, named


def _with_crossings(where: str, peaks: list[float], zeros: np.ndarray, signal: str) -> np.ndarray:
    """Times of the peaks and of the crossings between them; zeros : all those of the signal.

    Noise makes several zeros near a crossing; the middle one counts.
    """
    instants = [peaks[0]]
    for before, after in pairwise(peaks):
        between = zeros[(zeros > before) & (zeros < after)]
        if not len(between):
            raise ValueError(
                f"{where}: {signal} has no zero between the peaks at {before} and {after} s"
            )
        instants += [float(between[len(between) // 2]), after]
    return np.array(instants)


def _half_cycles(x: np.ndarray, floor: float) -> tuple[np.ndarray, np.ndarray]:
    """Samples further than `floor` from upright, and where among them each change of side is."""
    index = np.flatnonzero(np.abs(x) > floor)
    changes = np.flatnonzero(np.diff(np.sign(x[index]))) + 1
    return index, np.concatenate(([0], changes, [len(index)]))


def _peaks(t: np.ndarray, x: np.ndarray, path: CubicSpline, floor: float) -> list[float]:
    """Times of the extremes between changes of side, until a half-cycle stays below `floor`."""
    index, starts = _half_cycles(x, floor)
    if not len(index):
        return []
    turning = path.derivative().roots(discontinuity=False, extrapolate=False)
    peaks = []
    for i, j in pairwise(starts):
        first, last = index[i], index[j - 1]
        k = first + int(np.argmax(np.abs(x[first : last + 1])))
        if k == 0:
            if _begins_at_rest(t, x, path, floor):  # or else it began on its way back
                peaks.append(float(t[0]))
            continue
        if j == len(index) and np.abs(x[k]) - np.abs(x[-1]) <= floor:
            break  # it has not turned back
        near = turning[(turning >= t[k - 1]) & (turning <= t[k + 1])]
        values = np.abs(path(near))
        peaks.append(float(near[np.argmax(values)]) if len(near) else float(t[k]))
    return peaks


def _begins_at_rest(t: np.ndarray, x: np.ndarray, path: CubicSpline, floor: float) -> bool:
    """Whether a record that begins at its peak has no velocity there, within a sample or noise.

    A velocity v says that the peak was higher by v**2/(2 a). Under noise both are those of a cubic
    through the first samples, and a height that noise hides is none.
    """
    if np.abs(path(t[0], 1)) <= np.abs(path(t[0], 2)) * (t[1] - t[0]):
        return True
    fallen = np.flatnonzero(np.abs(x) < 0.7 * np.abs(x[0]))
    n = int(fallen[0]) if len(fallen) else len(t)
    if n < _RESOLVED:
        return False
    _, half, rate, _ = np.polyfit(t[:n] - t[0], x[:n], 3)
    return bool(rate**2 <= 4 * np.abs(half) * floor / _CLEAR)


def coefficient_of_determination(measured: ArrayLike, predicted: ArrayLike) -> float:
    """R2 of a prediction, ``1 - sum((y - f)**2)/sum((y - mean(y))**2)``.

    Parameters
    ----------
    measured : array_like
        Measured values y (n,).
    predicted : array_like
        Predicted values f (n,).

    Returns
    -------
    float
        Coefficient; negative where the mean predicts better.

    Raises
    ------
    ValueError
        Where all measured values are the same.
    """
    where = "coefficient_of_determination"
    measured, predicted = numbers(where, measured=measured, predicted=predicted)
    spread = float(np.sum((measured - np.mean(measured)) ** 2))
    require(spread != 0.0, where, "measured", measured, "one value has no spread to explain")
    return 1 - float(np.sum((measured - predicted) ** 2)) / spread
