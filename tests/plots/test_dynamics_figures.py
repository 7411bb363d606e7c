"""Sections, bifurcation diagrams, basins and the separatrix: what is drawn is what was found."""

from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

import rockeom as rk
from rockeom.analysis import dynamics
from rockeom.plots import (
    basins_of_attraction,
    bifurcation_diagram,
    plot_phase_portrait,
    poincare_section,
)
from tests.refusals import refused, refuses

STATES = ["theta", "theta_dot"]


def drawn(figure):
    figure.draw_without_rendering()
    assert plt.get_fignums() == []
    return figure


def sections(*dims, starts="start", sizes=(2,), looks=3, impacts=2, seed=1):
    """Sections full of different numbers."""
    rng = np.random.default_rng(seed)
    found = xr.Dataset(
        {
            "outcome": (dims, np.full(sizes, "completed")),
            "strobe": ((*dims, "look", "state"), rng.random((*sizes, looks, 2))),
            "impact_time": ((*dims, "impact"), rng.random((*sizes, impacts)), {"units": "s"}),
            "impact_state": (
                (*dims, "impact", "side", "state"), rng.random((*sizes, impacts, 2, 2)),
            ),
        },
        {
            "state": STATES,
            "state_unit": ("state", ["rad", "rad/s"]),
            "side": ["before", "after"],
        },
        {"starts": starts},
    )  # fmt: skip
    return found.assign_coords(theta=("start", np.arange(found.sizes.get("start", 0)) / 10))


def dots(ax):
    return [line for line in ax.lines if line.get_marker() == "." and len(line.get_xdata())]


def test_section_has_a_dot_for_each_look_in_the_colour_of_its_start():
    found = sections("start", sizes=(3,))
    (ax,) = drawn(poincare_section(found, x="theta", y="theta_dot")).axes
    assert len({line.get_color() for line in dots(ax)}) == 3
    for line, start in zip(dots(ax), found.strobe, strict=True):
        np.testing.assert_array_equal(line.get_xydata(), start)
    assert [t.get_text() for t in ax.get_legend().get_texts()][1] == r"from $\theta$ = 0.1"
    assert ax.get_xlabel() == r"$\theta$ [rad]"
    assert ax.get_ylabel() == r"$\dot{\theta}$ [rad/s]"


@pytest.mark.parametrize("side", ["before", "after"])
def test_section_at_impacts_shows_when_and_how_fast(side):
    found = sections("start", sizes=(1,))
    figure = drawn(poincare_section(found, x="impact_time", y="theta_dot", at=side))
    (line,) = dots(figure.axes[0])
    assert line.get_xdata().tolist() == found.impact_time.values.ravel().tolist()
    expected = found.impact_state.sel(side=side, state="theta_dot").values.ravel()
    assert line.get_ydata().tolist() == expected.tolist()
    assert f"{side} an impact [rad/s]" in figure.axes[0].get_ylabel()


def branch_of(values, rows, stable, bifurcations=()):
    """As `dynamics.orbit_branch` finds it, of orbits of as many cycles as a row is long."""
    orbits = [
        SimpleNamespace(
            states=STATES, mirror=None, looks=np.column_stack([row, row]),
            at_impacts=lambda name, row=row: 10.0 * np.asarray(row),
        )
        for row in rows
    ]  # fmt: skip
    marks = [SimpleNamespace(kind=k, value=values[i], orbit=orbits[i]) for k, i in bifurcations]
    return SimpleNamespace(
        values=np.array(values), stable=np.array(stable), orbits=orbits, bifurcations=marks
    )


def test_diagram_draws_dots_of_all_starts_and_branches_over_them():
    found = sections("start", "beta", sizes=(2, 4)).assign_coords(beta=[1.0, 2.0, 3.0, 4.0])
    found["beta"].attrs["units"] = "m/s2"
    branch = branch_of(
        [1.0, 2.0, 3.0, 4.0], [[0.3, 0.1], [0.1, 0.3], [0.4, 0.2], [0.2]],
        [True, True, False, False], [("period doubling", 2), ("period doubling", 1)],
    )  # fmt: skip
    for at, factor in (("period", 1.0), ("before", 10.0)):
        figure = drawn(bifurcation_diagram(found, x="beta", y="theta", at=at, branches=[branch]))
        (ax,) = figure.axes
        first, second = dots(ax)
        assert len(first.get_xdata()) == 4 * (3 if at == "period" else 2)
        values = found.strobe if at == "period" else found.impact_state.sel(side="before")
        at_two = second.get_ydata()[second.get_xdata() == 2.0]
        expected = values.sel(state="theta", beta=2.0).isel(start=1)
        assert sorted(at_two) == sorted(expected.values.ravel().tolist())
        solid = [li.get_ydata() / factor for li in ax.lines if li.get_linestyle() == "-"]
        dashed = [li.get_ydata() / factor for li in ax.lines if li.get_linestyle() == "--"]
        nan = np.nan  # in order of size, so that a line goes on where impacts change theirs
        np.testing.assert_allclose(solid, [[0.1, 0.1, nan, nan], [0.3, 0.3, nan, nan]])
        np.testing.assert_allclose(dashed, [[nan, 0.1, 0.2, 0.2], [nan, 0.3, 0.4, nan]])
        texts = [t.get_text() for t in ax.get_legend().get_texts()]
        assert texts.count("period doubling") == 1
        assert ax.get_xlabel() == "beta [m/s2]"


def test_branches_are_not_drawn_where_they_are_not_known():
    found = sections("start", "beta", sizes=(2, 2)).assign_coords(beta=[1.0, 2.0])
    branch = branch_of([1.0, 2.0], [[0.1], [0.2]], [True, True])
    with refuses("branches"):
        bifurcation_diagram(found, x="beta", y="theta", at="after", branches=[branch])
    branch.orbits[0].mirror = np.ones(2)
    with refuses("branches"):
        bifurcation_diagram(found, x="beta", y="theta", branches=[branch])


def test_what_sections_do_not_hold_is_told():
    found = sections("start", "beta", sizes=(2, 2)).assign_coords(beta=[1.0, 2.0])
    with pytest.raises(ValueError, match=r"vary beta as well.*isel\(beta=0\)"):
        poincare_section(found, x="theta", y="theta_dot")
    assert refused(bifurcation_diagram, found, x="beta", y="u") == ("state", "u")
    assert refused(bifurcation_diagram, found, x="beta", y="theta", at="impact") == ("at", "impact")
    with pytest.raises(ValueError, match="the sections have no impacts"):
        bifurcation_diagram(found.drop_vars("impact_state"), x="beta", y="theta", at="after")
    assert refused(bifurcation_diagram, found, x="gamma", y="theta") == ("name", "gamma")
    with pytest.raises(ValueError, match=r"no fates: give analysis.dynamics.basins\(sections\)"):
        basins_of_attraction(found, x="theta", y="theta_dot")


def basins():
    """A grid of 3 by 2 starts: two orbits, one of them of two cycles, one fallen, one chaotic."""
    looks = np.empty((3, 2, 5, 2))
    looks[0], looks[1] = 1.0, np.resize([2.0, 3.0], 5)[:, None]
    looks[2, 0], looks[2, 1] = np.nan, np.array([0.0, 7.0, 1.0, 5.0, 2.0])[:, None]
    outcome = np.array([["completed"] * 2, ["completed"] * 2, ["overturned", "completed"]])
    return dynamics.basins(
        xr.Dataset(
            {
                "outcome": (STATES, outcome),
                "strobe": ((*STATES, "look", "state"), looks),
            },
            {
                "theta": [0.2, 0.1, 0.3], "theta_dot": [-1.0, 1.0], "state": STATES,
                "state_unit": ("state", ["rad", "rad/s"]),
            },
            {"starts": " ".join(STATES)},
        )
    )  # fmt: skip


def test_cells_of_basins_stand_where_their_starts_do():
    found = basins()
    (ax,) = drawn(basins_of_attraction(found, x="theta", y="theta_dot")).axes
    (mesh,) = ax.collections
    shades = mesh.to_rgba(mesh.get_array()).reshape(2, 3, 4)
    for i, theta in enumerate([0.1, 0.2, 0.3]):  # in order, as the axis is
        for j, rate in enumerate([-1.0, 1.0]):
            fate = found.fate.sel(theta=theta, theta_dot=rate).item()
            same = (shades == shades[j, i]).all(axis=2)
            there = fate == found.fate.sortby("theta").values.T
            np.testing.assert_array_equal(same, there)
    texts = [t.get_text() for t in ax.get_legend().get_texts()]
    assert texts == [
        "overturned, 16.7 %", "not periodic, 16.7 %", "orbit of 1 cycle, 33.3 %",
        "orbit of 2 cycles, 33.3 %",
    ]  # fmt: skip
    marks = [line.get_xdata().tolist() for line in ax.lines]
    assert sorted(map(sorted, marks)) == [[1.0], [2.0, 3.0]]
    assert ax.get_ylabel() == r"initial $\dot{\theta}$ [rad/s]"


def test_table_of_starts_is_drawn_as_dots():
    found = basins().stack(start=STATES, create_index=False).assign_attrs(starts="start")
    found = found.transpose("start", ...)
    (ax,) = drawn(basins_of_attraction(found, x="theta", y="theta_dot")).axes
    places = ax.collections[0].get_offsets()
    np.testing.assert_array_equal(places, np.column_stack([found.theta, found.theta_dot]))


# --- separatrix


def separatrix(ax):
    return [
        li.get_xydata() for li in ax.lines if li.get_linestyle() == "--" and len(li.get_xdata())
    ]


def test_separatrix_of_a_slender_block_is_made_of_straight_lines():
    """theta' = p (alpha - |theta|), the stable and unstable lines of the balance."""
    block = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"theta": 0.1})
    sides = separatrix(drawn(plot_phase_portrait(run, separatrix=True)).axes[0])
    assert len(sides) == 2
    for theta, rate in (side.T for side in sides):
        np.testing.assert_allclose(np.abs(rate), 2.0 * (0.2 - np.abs(theta)), atol=1e-5)
        assert np.abs(theta).max() == pytest.approx(0.2, abs=1e-5)


def test_separatrix_parts_what_falls_from_what_comes_back():
    """A nonlinear block pushed a little to both sides of it, without losses on the way."""
    block = rk.RigidBlock(half_width=0.2, half_height=0.6)
    still = rk.GroundMotion.none(20.0)
    run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"theta": 0.1})
    side, _ = separatrix(drawn(plot_phase_portrait(run, separatrix=True)).axes[0])
    theta, rate = side[500]
    assert theta > 0
    assert rate > 0
    for factor, falls in ((1.0001, True), (0.9999, False)):
        pushed = {"theta": theta, "theta_dot": factor * rate}
        ended = rk.simulate(block, still, initial=pushed).outcome
        assert (ended == "overturned") is falls


def test_what_has_no_separatrix_in_the_plane_says_so():
    wall = rk.ControlledWall.thesis()
    run = rk.simulate(wall, rk.GroundMotion.none(0.1), initial={"theta": 0.01})
    assert refused(plot_phase_portrait, run, separatrix=True) == ("separatrix", True)
    assert refused(plot_phase_portrait, [])[0] == "runs"


def test_several_motions_have_a_colour_each():
    block = rk.RigidBlock(half_width=0.2, half_height=0.6)
    still = rk.GroundMotion.none(1.0)
    runs = [rk.simulate(block, still, initial={"theta": at}) for at in (0.05, 0.1, 0.2)]
    (ax,) = drawn(plot_phase_portrait(runs)).axes
    starts = [line for line in ax.lines if line.get_marker() == "o"]
    assert [line.get_xdata()[0] for line in starts] == [0.05, 0.1, 0.2]
    assert len({line.get_color() for line in starts}) == 3
