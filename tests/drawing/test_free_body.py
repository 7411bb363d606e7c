"""Pieces of free-body diagrams: where they stand, not how they look."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from rockeom.plots import free_body as fb, use_style


@pytest.fixture
def ax():
    return Figure().subplots()


def points(ax):
    """(n, 2) vertices of all lines."""
    return np.vstack([line.get_xydata() for line in ax.lines])


def test_positive_rotation_is_clockwise():
    (up,) = fb.turned((1.0, 2.0), about=(1.0, 0.0), angle=np.pi / 2)
    np.testing.assert_allclose(up, (3.0, 0.0), atol=1e-15)


def test_rotation_keeps_distances():
    corners = np.array([(-1.0, 0.0), (1.0, 0.0), (1.0, 4.0)])
    turned = fb.turned(corners, (1.0, 0.0), 0.3)
    np.testing.assert_allclose(
        np.linalg.norm(turned - corners[1], axis=1), np.linalg.norm(corners - corners[1], axis=1)
    )
    np.testing.assert_allclose(turned[1], corners[1])


@pytest.mark.parametrize(("first", "second"), [((-1, 0.2), (-1, -0.2)), ((-1, -0.2), (-1, 0.2))])
def test_angle_is_the_smaller_one_also_across_the_negative_axis(ax, first, second):
    fb.angle(ax, (0, 0), first, second, 0.5)
    arc = points(ax)
    np.testing.assert_allclose(np.hypot(*arc.T), 0.5)
    assert arc[:, 0].max() < 0
    assert np.sign(arc[0, 1]) == np.sign(first[1])
    assert np.sign(arc[-1, 1]) == np.sign(second[1])


def test_spring_reaches_both_ends_and_is_as_wide_as_asked(ax):
    start, end = np.array([1.0, 1.0]), np.array([4.0, 5.0])
    fb.spring(ax, start, end, 0.4)
    xy = points(ax)
    for place in (start, end):
        assert np.linalg.norm(xy - place, axis=1).min() < 1e-12
    along = (end - start) / 5.0
    across = (xy - start) @ np.array([-along[1], along[0]])
    assert across.max() == pytest.approx(0.2)
    assert across.min() == pytest.approx(-0.2)


def test_dimension_line_is_moved_to_the_left_of_its_direction(ax):
    fb.dimension(ax, (0, 0), (2, 0), "L", shift=0.5)
    assert {tuple(p) for p in points(ax)} == {(0, 0), (2, 0), (0, 0.5), (2, 0.5)}


def test_arrow_counts_for_the_limits_of_the_axes(ax):
    fb.arrow(ax, (0, 0), (10, -20), "mg")
    assert ax.dataLim.x1 == 10
    assert ax.dataLim.y0 == -20


def test_no_length_no_direction(ax):
    with pytest.raises(ValueError, match="same point"):
        fb.spring(ax, (1, 2), (1, 2), 0.1)
    with pytest.raises(ValueError, match="same point"):
        fb.dimension(ax, (1, 2), (1, 2), "L")


def test_unknown_place_of_a_label(ax):
    with pytest.raises(ValueError, match=r"tip.*tail.*middle"):
        fb.arrow(ax, (0, 0), (1, 0), "F", label_at="end")


def test_style_reaches_pyplot_and_can_be_undone():
    before = mpl.rcParams["axes.spines.top"]
    with mpl.rc_context():
        use_style()
        assert mpl.rcParams["axes.spines.top"] is False
        assert mpl.rcParams["axes.prop_cycle"].by_key()["color"][0] == fb.LINES[0]
    assert mpl.rcParams["axes.spines.top"] == before
