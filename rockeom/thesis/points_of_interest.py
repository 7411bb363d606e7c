"""Peaks of a noisy trace by the window score of section 3.2, and by SciPy's peak finder."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.identification.records import MeasuredRecord
from rockeom.numbers.checks import InputError, numbers, positive


class PointsOfInterest(NamedTuple):
    """Peaks of a trace, and the crossings between them.

    Parameters
    ----------
    peaks : ndarray
        Numbers of the samples of the peaks.
    crossings : ndarray
        Times of the crossings between them [s].
    """

    peaks: np.ndarray
    crossings: np.ndarray


def importance_scores(values: ArrayLike, window: int) -> np.ndarray:
    """How often each sample is the largest or the smallest of a window that slides over a trace.

    Parameters
    ----------
    values : array_like
        Trace (n,).
    window : int
        Number of samples in the window.

    Returns
    -------
    ndarray
        Whole numbers (n,).

    Notes
    -----
    On a slope the samples take turns and have about one each; a peak is that of all windows that
    pass over it. Each window gives one point to its largest sample and one to its smallest, to the
    first of equal ones.

    References
    ----------
    Thesis section 3.2, Figure 3-4; there 500 samples, half a second.
    """
    where = "importance_scores"
    (x,) = numbers(where, values=values)
    if x.ndim != 1 or not 3 <= window <= len(x):
        raise InputError("window", window, where).give(f"from 3 to {len(x)} samples")
    windows = np.lib.stride_tricks.sliding_window_view(x, int(window))
    starts = np.arange(len(windows))
    points = np.concatenate([starts + windows.argmax(axis=1), starts + windows.argmin(axis=1)])
    return np.bincount(points, minlength=len(x))


def points_by_score(
    record: MeasuredRecord, channel: str, window: float = 0.5, threshold: float = 0.5
) -> PointsOfInterest:
    """Peaks by `importance_scores`, as thesis section 3.2 finds them.

    Parameters
    ----------
    record : MeasuredRecord
        Record.
    channel : str
        Channel of the trace.
    window : float, optional
        Window [s].
    threshold : float, optional
        Score from which a sample is a peak, as a part of the window: the user's choice in the
        thesis.

    Returns
    -------
    PointsOfInterest
        Peaks and crossings.

    Notes
    -----
    A half-cycle that is shorter than threshold times the window is hidden by its higher neighbours:
    small rocking is fast, and ends unseen.
    """
    (width,) = positive("points_by_score", window=window)
    (part,) = positive("points_by_score", threshold=threshold)
    samples = round(float(width) / record.step)
    scores = importance_scores(record[channel], samples)
    peaks = np.flatnonzero(scores > part * samples)
    return PointsOfInterest(peaks, _crossings(record, channel, peaks))


def points_by_prominence(
    record: MeasuredRecord, channel: str, prominence: float | None = None
) -> PointsOfInterest:
    """Peaks of both sides by scipy.signal.find_peaks.

    Parameters
    ----------
    record : MeasuredRecord
        Record.
    channel : str
        Channel of the trace.
    prominence : float, optional
        Height by which the trace falls on both sides of a peak before it rises above it, in the
        unit of the channel; ten standard deviations of its noise if not given.

    Returns
    -------
    PointsOfInterest
        Peaks and crossings.

    Notes
    -----
    No window hides short half-cycles; a flat, noisy start is no peak.
    """
    from scipy.signal import find_peaks

    x = record[channel]
    if prominence is None:
        prominence = 10 * record.noise[channel].level
    (least,) = positive("points_by_prominence", prominence=prominence)
    both = [find_peaks(s * x, height=0.0, prominence=float(least))[0] for s in (1, -1)]
    peaks = np.sort(np.concatenate(both))
    return PointsOfInterest(peaks, _crossings(record, channel, peaks))


def _crossings(record: MeasuredRecord, channel: str, peaks: np.ndarray) -> np.ndarray:
    """Times at which a channel is zero, straight between samples, between peaks of both sides.

    Noise makes several; the middle one counts.
    """
    t, x = record.time, record[channel]
    times = []
    for i, j in pairwise(peaks.tolist()):
        if x[i] * x[j] >= 0:
            continue
        changes = i + np.flatnonzero(x[i:j] * x[i + 1 : j + 1] <= 0)
        k = changes[len(changes) // 2]
        times.append(t[k] - x[k] * (t[k + 1] - t[k]) / (x[k + 1] - x[k]))
    return np.array(times)
