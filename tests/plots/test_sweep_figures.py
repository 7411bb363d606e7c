"""Figures of sweeps: what stands in them is what the dataset says; no case is shown as another."""

import matplotlib as mpl
import numpy as np
import pytest
import xarray as xr

from rockeom.analysis.risk.fragility import fit_fragility, fragility_of
from rockeom.plots import (
    fragility_curve,
    incremental_dynamic_analysis,
    overturning_map,
    rocking_spectrum,
)
from rockeom.plots.sweeps import _CLASSES, _demands_at
from tests.drawing.test_pictures import drawn
from tests.refusals import refused, told

STANDS, FELL, NOT_RUN, STALLED = "completed", "overturned", "not run", "stalled"


def rgb(colour):
    return mpl.colors.to_rgb(colour)


# --- overturning map


def map_of(labels, impacts, **coords) -> xr.Dataset:
    dims = tuple(coords)
    found = xr.Dataset(
        {"outcome": (dims, np.array(labels)), "impacts": (dims, np.array(impacts))},
        coords=coords, attrs={"model": "rigid_block"},
    )  # fmt: skip
    for name, unit in (("frequency", "Hz"), ("amplitude", "m/s2")):
        if name in found.coords:
            found[name].attrs["units"] = unit
    return found


MAP = map_of(
    [[STANDS, STANDS, FELL, FELL], [FELL, FELL, FELL, NOT_RUN], [STANDS, "stalled", FELL, STANDS]],
    [[0, 4, 0, 1], [2, 3, 9, 0], [0, 1, 0, 0]],
    frequency=[1.0, 3.0, 2.0],
    amplitude=[1.0, 2.0, 4.0, 8.0],
)
KINDS = np.array([[0, 1, 5, 4], [3, 2, 2, 6], [0, 6, 5, 0]])


def test_map_shows_each_case_in_the_colour_of_its_class_at_its_place():
    (ax,) = drawn(overturning_map(MAP, x="frequency", y="amplitude")).axes
    mesh = next(c for c in ax.collections if isinstance(c, mpl.collections.QuadMesh))
    shown = np.asarray(mesh.get_facecolor())[:, :3].reshape(4, 3, 3)
    in_order = KINDS[[0, 2, 1]].T  # frequencies rise
    expected = np.array([rgb(colour) for _, colour in _CLASSES])[in_order]
    np.testing.assert_allclose(shown, expected)
    edges = mesh.get_coordinates()
    np.testing.assert_allclose(edges[0, :, 0], [0.5, 1.5, 2.5, 3.5])
    np.testing.assert_allclose(edges[:, 0, 1], [0.5, 1.5, 3.0, 6.0, 10.0])
    assert ax.get_xlabel() == "frequency [Hz]"
    assert ax.get_ylabel() == "amplitude [m/s2]"


def test_map_names_the_classes_that_it_has_and_crosses_out_what_has_no_answer():
    (ax,) = overturning_map(MAP, x="frequency", y="amplitude").axes
    named = [text.get_text() for text in ax.get_legend().get_texts()]
    assert named == [_CLASSES[kind][0] for kind in np.unique(KINDS)]
    (crossed,) = (c for c in ax.collections if c.get_hatch())
    assert len(crossed.get_paths()) == (KINDS == 6).sum()


def test_classes_can_be_told_apart_without_colours():
    grey = [np.dot([0.299, 0.587, 0.114], rgb(colour)) for _, colour in _CLASSES[:-1]]
    assert np.diff(grey).max() < -0.07


def test_cases_of_a_table_are_dots():
    table = MAP.stack(case=("frequency", "amplitude")).reset_index("case")
    (ax,) = drawn(overturning_map(table, x="frequency", y="amplitude")).axes
    (dots,) = ax.collections
    np.testing.assert_allclose(dots.get_offsets()[:, 0], np.repeat([1.0, 3.0, 2.0], 4))
    expected = [rgb(_CLASSES[kind][1]) for kind in KINDS.ravel()]
    np.testing.assert_allclose(dots.get_facecolor()[:, :3], expected)


def test_records_stand_on_an_axis_by_their_names():
    words = map_of([[STANDS, FELL], [FELL, FELL]], [[0, 1], [2, 0]],
                   record=["Kobe $5", "Tabas"], amplitude=[1.0, 2.0])  # fmt: skip
    (ax,) = drawn(overturning_map(words, x="record", y="amplitude")).axes
    assert [tick.get_text() for tick in ax.get_xticklabels()] == [r"Kobe \$5", "Tabas"]
    table = words.stack(case=("amplitude", "record")).reset_index("case")
    (ax,) = drawn(overturning_map(table, x="record", y="amplitude")).axes
    assert [tick.get_text() for tick in ax.get_xticklabels()] == [r"Kobe \$5", "Tabas"]
    np.testing.assert_allclose(ax.collections[0].get_offsets()[:, 0], [0, 1, 0, 1])


def test_map_of_more_names_asks_which_value():
    more = MAP.expand_dims(record=["a", "b"])
    with pytest.raises(ValueError, match=r"varies record \(2 values\).*isel\(record=0\)"):
        overturning_map(more, x="frequency", y="amplitude")
    drawn(overturning_map(more.isel(record=[1]), x="frequency", y="amplitude"))
    assert refused(overturning_map, MAP, x="period", y="amplitude") == ("name", "period")


def crossings(f, inside, names=("frequency", "amplitude")) -> xr.Dataset:
    """Where a grid's lines cross a circle about the middle of [0, 10] x [0, 10], as boundaries."""
    found = []
    for axis, name in enumerate(names):
        for line in f:
            reach = 3.3**2 - (line - 5) ** 2
            for sign in (-1, 1) if reach > 0 else ():
                at = [line, line]
                at[axis] = 5 + sign * np.sqrt(reach)
                found.append((*at, name, *((np.inf, inside) if sign < 0 else (inside, np.inf))))
    x, y, along, below, above = zip(*found, strict=True)
    columns = {"along": along, "below": below, "above": above}
    return xr.Dataset(
        {name: ("boundary", np.array(column)) for name, column in columns.items()},
        coords={names[0]: ("boundary", np.array(x)), names[1]: ("boundary", np.array(y))},
    )


def test_boundaries_that_enclose_a_region_are_drawn_as_a_closed_line():
    lines = np.linspace(0.0, 10.0, 12)
    size = (len(lines),) * 2
    sweep = map_of(np.full(size, STANDS), np.zeros(size, int), frequency=lines, amplitude=lines)
    found = crossings(lines, 1.0)
    figure = drawn(overturning_map(sweep, x="frequency", y="amplitude", boundaries=found))
    (drawn_lines,) = (
        c for c in figure.axes[0].collections if isinstance(c, mpl.collections.LineCollection)
    )
    segments = np.array(drawn_lines.get_segments())
    np.testing.assert_allclose(np.hypot(*(segments - 5).T), 3.3)
    ends, times = np.unique(segments.reshape(-1, 2).round(9), axis=0, return_counts=True)
    assert len(ends) == found.sizes["boundary"]
    assert (times == 2).all()
    assert np.hypot(*np.diff(segments, axis=1)[:, 0].T).max() < np.hypot(10 / 11, 10 / 11)
    with pytest.raises(ValueError, match="boundaries of a grid over 'amplitude' and 'frequency'"):
        overturning_map(
            sweep, x="amplitude", y="frequency", boundaries=found.drop_vars("amplitude")
        )


# --- rocking spectrum


def spectrum_of(alphas, peaks, labels) -> xr.Dataset:
    found = xr.Dataset(
        {
            "outcome": (("p", "alpha"), np.array(labels)),
            "peak": (("p", "alpha", "state"), np.array(peaks)[..., None]),
        },
        coords={"p": [2.0, 1.0, 3.0], "alpha": alphas, "state": ["theta"]},
    )
    found["p"].attrs["units"] = "rad/s"
    return found


FEW = spectrum_of(
    [0.1, 0.2],
    [[0.05, 0.04], [0.02, 0.01], [1.7, 0.08]],
    [[STANDS, STANDS], [STANDS, STANDS], [FELL, STALLED]],
)


def test_spectrum_divides_by_the_slenderness_and_has_no_number_for_who_overturned():
    (ax,) = drawn(rocking_spectrum(FEW, x="p", by="alpha", alpha="alpha")).axes
    lines = [line for line in ax.lines if line.get_label() in ("0.1", "0.2")]
    np.testing.assert_allclose(lines[0].get_xdata(), [1.0, 2.0, 3.0])
    np.testing.assert_allclose(lines[0].get_ydata(), [0.2, 0.5, np.nan])
    np.testing.assert_allclose(lines[1].get_ydata(), [0.05, 0.2, np.nan])
    assert lines[0].get_linestyle() != lines[1].get_linestyle()
    fallen = [tuple(line.get_xdata()) for line in ax.lines if line.get_marker() == "^"]
    assert fallen == [(3.0,), (), ()]  # the last is the legend's
    assert r"\alpha$ [-]" in ax.get_ylabel()
    assert ax.get_xlabel() == "p [rad/s]"


def test_one_line_and_many_and_many_of_words():
    (ax,) = drawn(rocking_spectrum(FEW.isel(alpha=0), x="p", alpha=0.1)).axes
    np.testing.assert_allclose(ax.lines[0].get_ydata(), [0.2, 0.5, np.nan])
    many = FEW.isel(alpha=np.zeros(9, int)).assign_coords(alpha=np.linspace(0.1, 0.2, 9))
    figure = drawn(rocking_spectrum(many, x="p", by="alpha", alpha="alpha"))
    assert figure.axes[1].get_ylabel() == "alpha"  # a scale of colours
    words = many.rename(alpha="record").assign_coords(record=list("abcdefghi"))
    (ax,) = drawn(rocking_spectrum(words, x="p", by="record", alpha=0.2)).axes
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["each record", "overturned"]


def test_fractiles_of_a_spectrum_count_who_overturned_as_more_than_any_rotation():
    """Of 0.01 to 0.10 at one period, and there the last three overturn; 80 % of them is a gap."""
    parts = (0.5, 0.7, 0.8)
    peaks = np.arange(1, 11) / 100
    labels = [[STANDS] * 7 + [FELL] * 3, [STANDS] * 10, [STANDS] * 10]
    sweep = spectrum_of(np.arange(10) / 100 + 0.1, [peaks] * 3, labels)
    figure = drawn(rocking_spectrum(sweep, x="p", by="alpha", alpha=0.1, fractiles=parts))
    lines = {line.get_label(): line.get_ydata() for line in figure.axes[0].lines}
    for part, expected in zip(parts, (0.5, 0.7, np.nan), strict=True):
        found = dict(zip([1.0, 2.0, 3.0], lines[f"{100 * part:.0f} % of them"], strict=True))
        assert found[2.0] == pytest.approx(expected, nan_ok=True)
        assert found[1.0] == found[3.0] == pytest.approx(10 * part / 10)


# --- fragility and incremental dynamic analysis


def records(labels, peaks=None, names=("a", "b", "c")) -> xr.Dataset:
    labels = np.array(labels)
    peaks = 0.01 * np.arange(labels.size).reshape(labels.shape) if peaks is None else peaks
    found = xr.Dataset(
        {
            "outcome": (("record", "pga"), labels),
            "peak": (("record", "pga", "state"), np.asarray(peaks)[..., None]),
        },
        coords={"record": list(names), "pga": [1.0, 2.0, 3.0, 4.0], "state": ["theta"],
                "state_unit": ("state", ["rad"])},
    )  # fmt: skip
    found["pga"].attrs.update(units="m/s2", long_name="peak ground acceleration")
    return found


SWEEP = records([
    [STANDS, STANDS, FELL, FELL],
    [STANDS, FELL, STANDS, FELL],
    [STANDS, STANDS, STALLED, STANDS],
])  # fmt: skip


def test_fragility_curve_shows_the_fit_its_bounds_and_the_fractions():
    (ax,) = drawn(fragility_curve(SWEEP, intensity="pga", level=0.8)).axes
    curve = fragility_of(SWEEP, intensity="pga")
    line = next(line for line in ax.lines if line.get_label() == "maximum likelihood")
    np.testing.assert_allclose(line.get_ydata(), curve.probability(line.get_xdata()))
    dots = next(line for line in ax.lines if line.get_label() == "observed")
    np.testing.assert_allclose(dots.get_xydata(), [[1, 0], [2, 1 / 3], [3, 0.5], [4, 2 / 3]])
    (band,) = ax.collections
    corners = band.get_paths()[0].vertices
    low, high = curve.bounds(line.get_xdata()[200], 0.8)
    there = corners[np.isclose(corners[:, 0], line.get_xdata()[200])]
    assert {*np.round(there[:, 1], 12)} == {*np.round([low, high], 12)}
    assert "80 % confidence" in band.get_label()
    assert ax.get_xlabel() == "peak ground acceleration [m/s2]"
    fit = f"median {curve.median:.4g} m/s2, dispersion {curve.dispersion:.3g}"
    first, *rest = ax.get_title().split("\n")
    assert first == f"{fit}, 11 motions counted as independent"
    assert " ".join(rest) == curve.not_counted


def test_curve_fitted_elsewhere_is_drawn_alike():
    curve = fit_fragility([0.2, 0.4, 0.6, 0.8], [1, 4, 9, 10], 10)
    (ax,) = drawn(fragility_curve(curve, intensity="S_a [g]")).axes
    assert ax.get_xlabel() == "S a [g]"
    assert ax.get_ylabel() == "probability of exceedance [-]"


def test_a_limit_is_named_with_its_unit():
    (ax,) = drawn(fragility_curve(SWEEP, intensity="pga", demand="theta", limit=0.06)).axes
    assert "|theta|\nreaches 0.06 rad" in ax.get_ylabel()


def test_each_record_is_a_line_that_leaves_the_numbers_where_it_overturns():
    (ax,) = drawn(incremental_dynamic_analysis(SWEEP, intensity="pga")).axes
    thin = [line.get_xydata() for line in ax.lines if line.get_linewidth() == 0.6]
    edge = ax.get_xlim()[1]
    assert len(thin) == 3
    np.testing.assert_allclose(thin[0], [[0, 1], [0.01, 2], [edge, 3], [edge, 4]])
    np.testing.assert_allclose(thin[1], [[0.04, 1], [edge, 2], [0.06, 3], [edge, 4]])
    np.testing.assert_allclose(thin[2][:, 0], [0.08, 0.09, np.nan, 0.11])
    assert max(ax.get_xticks()) < edge / 1.1  # no number where none is meant
    said = {text.get_text(): text for text in ax.texts}
    assert {"overturned", "a", "b"} == set(said)
    assert ax.get_title() == f"1 without an answer (1 {STALLED}): in no fractile"
    assert said["b"].xy == (edge, 2.0)
    assert ax.get_xlabel() == "largest |theta| [rad]"


def test_records_that_look_alike_are_told_apart():
    """By long names with the same beginning, by large numbers, and with any letters."""
    for names in (["a" * 30 + end for end in "xyz"], [10001, 10002, 10003], ["$1", "$2", "$3"]):
        ax = incremental_dynamic_analysis(SWEEP.assign_coords(record=names), intensity="pga").axes[
            0
        ]
        assert sum(line.get_linewidth() == 0.6 for line in ax.lines) == 3
        drawn(ax.figure)
    assert {r"\$1", r"\$2"} <= {text.get_text() for text in ax.texts}


def test_fractiles_count_who_overturned_as_more_than_any_demand():
    """Of one to a hundred, in hundredths: the 16th, 50th and 84th; the last twenty overturn."""
    n = 100
    peaks = np.tile(np.arange(1, n + 1)[:, None] / 100.0, (1, 4))
    labels = np.full((n, 4), STANDS, dtype="U16")
    labels[80:, 2:] = FELL
    sweep = records(labels, peaks, names=[f"r{i}" for i in range(n)])
    (ax,) = drawn(incremental_dynamic_analysis(sweep, intensity="pga")).axes
    thick = {line.get_label()[:4]: line.get_xdata() for line in ax.lines if line.get_lw() == 1.8}
    edge = ax.get_xlim()[1]
    np.testing.assert_allclose(thick["16 %"], [0.16] * 4)
    np.testing.assert_allclose(thick["50 %"], [0.5] * 4)
    np.testing.assert_allclose(thick["84 %"], [0.84, 0.84, edge])


def test_records_may_have_intensities_of_their_own():
    """Three records, scaled to peaks, whose spectral accelerations are 1, 1.5 and 2 times these."""
    ratio = xr.DataArray([1.0, 1.5, 2.0], dims="record")
    peaks = 0.01 * np.outer(ratio, [1.0, 2.0, 3.0, 4.0])
    sweep = records(np.full((3, 4), STANDS), peaks)
    sweep = sweep.assign_coords(sa=sweep.pga * ratio)
    (ax,) = drawn(incremental_dynamic_analysis(sweep, intensity="sa")).axes
    thin = [line.get_xydata() for line in ax.lines if line.get_linewidth() == 0.6]
    np.testing.assert_allclose(thin[2], [[0.02, 2], [0.04, 4], [0.06, 6], [0.08, 8]])
    for line in (line for line in ax.lines if line.get_linewidth() == 1.8):
        np.testing.assert_allclose(line.get_xdata(), 0.01 * line.get_ydata())  # of all records
        assert line.get_ydata().tolist() == [2.0, 3.0, 4.0]  # and where all of them are
    assert ax.get_ylim()[1] > 8.0


def test_fragility_against_an_intensity_of_each_record():
    sweep = SWEEP.assign_coords(sa=SWEEP.pga * xr.DataArray([1.0, 1.5, 2.0], dims="record"))
    curve = fragility_of(sweep, intensity="sa")
    by_hand = fit_fragility(
        [1, 2, 3, 4, 1.5, 3, 4.5, 6, 2, 4, 8], [0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 0]
    )
    assert curve.median == pytest.approx(by_hand.median)
    assert curve.dispersion == pytest.approx(by_hand.dispersion)


def test_demand_between_two_intensities_of_a_record():
    im, demand = np.array([1.0, 2.0, 4.0, 6.0]), np.array([0.1, 0.3, np.inf, np.nan])
    found = _demands_at(np.array([1.0, 1.5, 2.0, 3.0, 4.0, 6.0]), im, demand)
    np.testing.assert_allclose(found, [0.1, 0.2, 0.3, np.inf, np.inf, np.nan])


def test_table_of_cases_needs_the_name_of_its_records():
    table = SWEEP.stack(case=("record", "pga")).reset_index("case")
    assert "give record=" in told(incremental_dynamic_analysis, table, intensity="pga")
    one = incremental_dynamic_analysis(table, intensity="pga", record="record").axes[0]
    other = incremental_dynamic_analysis(SWEEP, intensity="pga").axes[0]
    for mine, line in zip(one.lines, other.lines, strict=True):
        np.testing.assert_array_equal(mine.get_xydata(), line.get_xydata())
    nothing = records(np.full((3, 4), FELL))
    with pytest.raises(ValueError, match="no case has one: all fell, or gave no"):
        incremental_dynamic_analysis(nothing, intensity="pga")
