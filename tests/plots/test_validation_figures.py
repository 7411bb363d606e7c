"""Figures of statistical validation show the numbers that they are given."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection

from rockeom import plots
from rockeom.analysis.validation import Ensemble, calibration_of
from tests.refusals import refused


def test_a_distribution_ends_below_one_by_the_part_that_overturned():
    peaks = np.array([0.0, 0.02, 0.1, 0.3, np.nan])
    one = Ensemble(peaks, np.isnan(peaks))
    figure = plots.peak_distributions({"wall $1$": one}, limit=0.2, level=0.5)
    (ax,) = figure.axes
    (line,) = ax.lines
    assert line.get_drawstyle() == "steps-post"
    assert line.get_xdata().tolist() == [0.0, 0.02, 0.1, 0.2]
    assert line.get_ydata().tolist() == pytest.approx([0.2, 0.4, 0.6, 0.6])
    band = ax.collections[0].get_paths()[0].vertices
    reach = np.sqrt(np.log(4.0) / 10)
    assert band[:, 1].max() == pytest.approx(0.6 + reach)
    assert band[:, 1].min() == 0.0  # 0.2 - reach is less
    assert ax.get_xlim() == (0.0, 0.2)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [
        r"wall \$1\$ (5, assumed independent)"
    ]


def test_without_a_limit_the_axis_ends_at_the_largest_peak():
    one, other = Ensemble([0.1, 0.4]), Ensemble([[0.2], [np.nan]], [[False], [True]])
    figure = plots.peak_distributions({"A": one, "B": other})
    assert figure.axes[0].get_xlim() == (0.0, 0.4)
    for ensembles in ({}, {str(i): one for i in range(7)}):
        assert refused(plots.peak_distributions, ensembles)[0] == "ensembles"
    assert refused(plots.peak_distributions, {"A": Ensemble([np.nan], [True])}) == ("limit", 0.0)


def test_a_reliability_diagram_has_a_dot_an_interval_and_a_range_for_each_bin():
    p = np.repeat([0.1, 0.5, 0.9], 8)
    found = calibration_of(np.arange(24) % 8 < 8 * p - 0.5, p, bins=3)
    (ax,) = plots.reliability_diagram(found).axes
    dots = next(line for line in ax.lines if line.get_marker() == "o")
    np.testing.assert_allclose(
        dots.get_xydata(), np.column_stack([found.probability, found.frequency])
    )
    ranges, intervals = (
        np.array([path.vertices[:, 1] for path in lines.get_paths()])
        for lines in ax.collections
        if isinstance(lines, LineCollection)
    )
    np.testing.assert_allclose(
        ranges, np.column_stack([found.expected_lower, found.expected_upper])
    )
    np.testing.assert_allclose(intervals, np.column_stack([found.lower, found.upper]))
    assert {text.get_text() for text in ax.texts} == {"8"}
    assert ax.get_title() == f"24 tests, p = {found.p_value:.2g}\nassumes independent tests"


def test_a_dot_of_campaigns_has_no_interval_of_independent_tests():
    p, rng = np.repeat([0.2, 0.8], 8), np.random.default_rng(0)
    found = calibration_of(rng.random(16) < p, p, outcomes=rng.random((16, 60)) < p[:, None])
    (ax,) = plots.reliability_diagram(found).axes
    assert sum(isinstance(lines, LineCollection) for lines in ax.collections) == 1  # the ranges
    assert ax.get_title().endswith("\nby 60 campaigns")
    peaks = Ensemble(rng.random((5, 40)))
    legend = plots.peak_distributions({"all": peaks}).axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["all (5 x 40)"]
