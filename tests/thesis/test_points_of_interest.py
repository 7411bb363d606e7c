"""Peaks of a noisy trace by the window score of section 3.2, and by SciPy."""

from itertools import pairwise

import numpy as np

from rockeom import analysis
from rockeom.thesis.points_of_interest import (
    importance_scores,
    points_by_prominence,
    points_by_score,
)

T = np.arange(0.0, 4.0, 0.001)


def rocking(sigma=2e-4, seed=0):
    """A trace whose half-cycles shorten as they shrink, like that of Figure 3-3."""
    ends = np.cumsum([0.0, 0.6, 0.5, 0.42, 0.35, 0.29, 0.24, 0.2, 0.16, 0.13])
    x = np.zeros(len(T))
    for n, (a, b) in enumerate(pairwise(ends)):
        inside = (a <= T) & (b > T)
        x[inside] = (-1) ** n * (b - a) ** 2 * np.sin(np.pi * (T[inside] - a) / (b - a))
    return ends, analysis.MeasuredRecord(
        T, {"x": x + np.random.default_rng(seed).normal(0.0, sigma, len(T))}
    )


def test_a_peak_scores_the_windows_that_pass_over_it_and_a_slope_about_one():
    triangle = np.concatenate([np.arange(20.0), np.arange(20.0, -1.0, -1.0)])
    scores = importance_scores(triangle, 9)
    assert scores[20] == 9
    assert np.all(scores[9:12] == 2)  # once the largest of a window, once the smallest
    assert scores.sum() == 2 * (len(triangle) - 9 + 1)


def test_window_score_misses_small_rocking_that_scipy_finds():
    """Both find the large peaks; a window of half a second hides half-cycles of a quarter."""
    ends, record = rocking()
    middles = (ends[1:] + ends[:-1]) / 2
    scored = points_by_score(record, "x")
    found = points_by_prominence(record, "x")
    assert len(found.peaks) == len(middles)
    np.testing.assert_allclose(T[found.peaks], middles, atol=0.03)
    np.testing.assert_allclose(found.crossings, ends[1:-1], atol=5e-3)
    both = np.isin(scored.peaks, found.peaks)
    assert both[:3].all()
    assert len(scored.peaks) < len(found.peaks) + 3
    narrower = points_by_score(record, "x", window=0.15, threshold=0.6)
    assert set(found.peaks[:6]) <= set(narrower.peaks)
