"""Forces of the ground on a block, from a record of its rotation; thesis section 3.2.3.

Between impacts they are those of 3-8 and 3-9. About an impact they depend on the sampling and
differentiation of the record more than on the impact: see `impact_forces_of_record`.
"""

from typing import Any, NamedTuple

import numpy as np

from rockeom.analysis.formulas.support_forces import block_reactions, block_reactions_at_impact
from rockeom.analysis.identification.noise import COVERED
from rockeom.analysis.identification.records import MeasuredRecord
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import not_negative, positive


class SupportForces(NamedTuple):
    """Forces of the ground on a block, (n,) each.

    Parameters
    ----------
    time : ndarray
        Time [s].
    horizontal : ndarray
        Horizontal force [N].
    vertical : ndarray
        Vertical force [N].
    horizontal_half_width : ndarray
        Half-width of the interval of confidence of the horizontal force at 95 % [N].
    vertical_half_width : ndarray
        Half-width of that of the vertical force [N].
    smooth : ndarray
        Whether no impact lies within the window of the derivatives, so that the forces are those of
        one foot. Elsewhere they are the trace of the jump of the angular velocity in the window.
    """

    time: np.ndarray
    horizontal: np.ndarray
    vertical: np.ndarray
    horizontal_half_width: np.ndarray
    vertical_half_width: np.ndarray
    smooth: np.ndarray


def support_forces_of_record(
    record: MeasuredRecord,
    *,
    mass: float,
    alpha: float,
    radius: float,
    window: float,
    channel: str = "theta",
    degree: int = 4,
    gravity: float = STANDARD_GRAVITY,
    ground_acceleration: str | None = None,
) -> SupportForces:
    """Forces on a block from its recorded rotation, by differentiation; thesis 3-8 and 3-9.

    Parameters
    ----------
    record : MeasuredRecord
        Record as measured.
    mass : float
        Mass of the block [kg].
    alpha : float
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : float
        Distance R from an edge to the centroid [m].
    window : float
        Window of the derivatives [s], as in `MeasuredRecord.with_derivatives`.
    channel : str, optional
        Channel of the rotation [rad].
    degree : int, optional
        Degree of the polynomial of the derivatives.
    gravity : float, optional
        Acceleration of gravity [m/s2].
    ground_acceleration : str, optional
        Channel of the ground's acceleration [m/s2]; still ground if not given.

    Returns
    -------
    SupportForces
        Forces at each sample. The half-widths are those of the record's noise, propagated through
        the derivatives.

    Raises
    ------
    KeyError
        For an unknown channel.
    ValueError
        For a window of too few samples, and numbers that are not positive.

    Notes
    -----
    The misfit of the polynomial adds to the half-widths: a window of a third of the shortest
    half-cycle of interest or less keeps it small.
    """
    where = "support_forces_of_record"
    positive(where, mass=mass, window=window)
    derived = record.with_derivatives(channel, window, degree)
    theta, rate, second = (derived[channel + end] for end in ("", "_dot", "_ddot"))
    sigma = [derived.noise[channel + end].level for end in ("", "_dot", "_ddot")]
    side = np.where(theta >= 0, 1.0, -1.0)
    ground = np.zeros_like(theta) if ground_acceleration is None else record[ground_acceleration]

    def forces(x: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
        # a rotation that passes upright by noise still belongs to its foot
        return np.array(
            block_reactions(
                side * np.maximum(side * x, 0.0), v, a, mass=mass, alpha=alpha, radius=radius,
                ground_acceleration=ground, gravity=gravity, side=side,
            )
        )  # fmt: skip

    values = forces(theta, rate, second)
    # a straight window is symmetric: errors of the rate and of the second derivative are
    # uncorrelated; that of the rotation counts for next to nothing
    steps = np.diag(np.where(np.array(sigma) > 0, sigma, 1e-9))
    changes = [forces(theta + h[0], rate + h[1], second + h[2]) - values for h in steps]
    half_widths = COVERED * np.sqrt(sum(np.square(c) for c in changes))
    crossings = np.flatnonzero(side[1:] != side[:-1])
    reach = round(window / record.step / 2) + 1
    smooth = np.ones(len(theta), dtype=bool)
    for k in crossings:
        smooth[max(k - reach, 0) : k + reach + 2] = False
    edge = reach - 1  # there the polynomial is one-sided, and noisier than stated
    smooth[:edge] = smooth[len(smooth) - edge :] = False
    (h, v), (h_width, v_width) = values, half_widths
    return SupportForces(record.time, h, v, h_width, v_width, smooth)


class ImpactForces(NamedTuple):
    """Bounds of the force of each impact by a record, (n,) each; see `impact_forces_of_record`.

    Parameters
    ----------
    time : ndarray
        Time of the impact [s].
    speed : ndarray
        Angular velocity before it [rad/s], positive where the right foot lands.
    horizontal : ndarray
        Largest horizontal force about the impact, by size [N].
    vertical : ndarray
        Largest vertical force about the impact, by size [N].
    magnitude : ndarray
        Size of both [N].
    angle : ndarray
        Angle of both from the vertical [rad].
    baseline_horizontal : ndarray
        Horizontal force on the block just before (3-11) [N].
    baseline_vertical : ndarray
        Vertical force on the block just before (3-12) [N].
    expected_horizontal : ndarray
        Trace, over the baseline, that a jump of the angular velocity without duration has in the
        window [N].
    expected_vertical : ndarray
        The same of the vertical force [N].
    """

    time: np.ndarray
    speed: np.ndarray
    horizontal: np.ndarray
    vertical: np.ndarray
    magnitude: np.ndarray
    angle: np.ndarray
    baseline_horizontal: np.ndarray
    baseline_vertical: np.ndarray
    expected_horizontal: np.ndarray
    expected_vertical: np.ndarray


def impact_forces_of_record(
    record: MeasuredRecord,
    *,
    mass: float,
    alpha: float,
    radius: float,
    window: float,
    channel: str = "theta",
    degree: int = 4,
    gravity: float = STANDARD_GRAVITY,
    radius_ratio: float = 0.75,
) -> ImpactForces:
    """Largest forces about each impact of a free block; thesis Figures 3-15 and 3-16.

    Parameters
    ----------
    record : MeasuredRecord
        Record as measured.
    mass : float
        Mass of the block [kg].
    alpha : float
        Slenderness: angle of the line from an edge to the centroid, from the vertical [rad].
    radius : float
        Distance R from an edge to the centroid [m].
    window : float
        Window of the derivatives [s], as in `MeasuredRecord.with_derivatives`.
    channel : str, optional
        Channel of the rotation [rad].
    degree : int, optional
        Degree of the polynomial of the derivatives.
    gravity : float, optional
        Acceleration of gravity [m/s2].
    radius_ratio : float, optional
        Ratio m R**2/I_o, for the baseline.

    Returns
    -------
    ImpactForces
        Forces about each impact.

    Raises
    ------
    KeyError
        For an unknown channel.
    ValueError
        As `support_forces_of_record`.

    Notes
    -----
    They are no impact forces but lower bounds of them. An impact changes the angular velocity by dv
    within less than a sample, and the derivative spreads that over its window: an acceleration of
    dv times `kink_gain`, for any force. Half the window doubles it. A record of the rotation alone
    shows the part 1 - e of the vertical impulse m R sin(alpha) (1 + e) v: the other part, which
    reverses the fall of the centroid, is in no derivative of the rotation. The expected values are
    those of such a jump; the excess of a record may be the impact's own.
    """
    support = support_forces_of_record(
        record, mass=mass, alpha=alpha, radius=radius, window=window, channel=channel,
        degree=degree, gravity=gravity,
    )  # fmt: skip
    crossings, before, after = _rates_at_crossings(record, channel).T
    side = -np.sign(before)  # of the foot it stands on before
    shape: dict[str, Any] = {"mass": mass, "alpha": alpha, "radius": radius, "gravity": gravity}
    horizontal, vertical = np.empty(len(before)), np.empty(len(before))
    for n, instant in enumerate(crossings):
        near = np.abs(record.time - instant) <= window / 2
        h, v = support.horizontal[near], support.vertical[near]
        horizontal[n], vertical[n] = h[np.argmax(np.abs(h))], v[np.argmax(np.abs(v))]
    base_h, base_v = block_reactions_at_impact(before, side, radius_ratio=radius_ratio, **shape)
    spike = np.abs(after - before) * kink_gain(record.step, window, degree) * mass * radius
    return ImpactForces(
        time=crossings,
        speed=before,
        horizontal=horizontal,
        vertical=vertical,
        magnitude=np.hypot(horizontal, vertical),
        angle=np.arctan2(np.abs(horizontal), vertical),
        baseline_horizontal=base_h,
        baseline_vertical=base_v,
        expected_horizontal=spike * np.cos(alpha),
        expected_vertical=spike * np.sin(alpha),
    )


def kink_gain(step: float, window: float, degree: int = 4) -> float:
    """Largest second derivative that a jump of the rate by 1 leaves at the bend.

    Parameters
    ----------
    step : float
        Time between samples [s].
    window : float
        Window of the derivatives [s], as in `MeasuredRecord.with_derivatives`.
    degree : int, optional
        Degree of the polynomial of the derivatives.

    Returns
    -------
    float
        Gain [1/s], the larger one of a bend at a sample and of a bend between two.

    Raises
    ------
    ValueError
        For a step or a window that is not positive.
    """
    where = "kink_gain"
    positive(where, step=step, window=window)
    not_negative(where, degree=degree)
    n = 4 * (round(window / step) + 2)
    largest = 0.0
    for place in np.linspace(0.0, 1.0, 9):
        t = step * (np.arange(2 * n + 1) - n - place)
        bend = MeasuredRecord(t, {"x": np.maximum(t, 0.0)}, {"x": 0.0})
        largest = max(largest, float(np.max(bend.with_derivatives("x", window, degree)["x_ddot"])))
    return largest


def _rates_at_crossings(record: MeasuredRecord, channel: str) -> np.ndarray:
    """(n, 3) of each crossing: its time, and the rate just before and just after it.

    Each rate is that of the cubic through the half of the way to the next peak of its side.
    """
    t, x = record.time, record[channel]
    at = record.free_vibration(channel).time
    crossings = []
    for peak, instant, next_peak in zip(at[:-2:2], at[1:-1:2], at[2::2], strict=True):
        rates = []
        for start, end in (
            (instant - (instant - peak) / 2, instant),
            (instant, instant + (next_peak - instant) / 2),
        ):
            near = (t > start) & (t < end)
            enough = near.sum() >= 6
            rates.append(np.polyfit(t[near] - instant, x[near], 3)[2] if enough else np.nan)
        crossings.append((instant, *rates))
    rows = np.array(crossings).reshape(-1, 3)
    return rows[np.isfinite(rows).all(axis=1)]
