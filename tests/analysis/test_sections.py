"""Sections of motions, what they settle on and the basins of it, against closed forms and runs."""

import math

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, strategies as st

import rockeom as rk
from rockeom.analysis import dynamics
from rockeom.sweeps.results import Results

SQUAT = rk.NondimensionalBlock(alpha=math.atan(0.5))
PERIOD = 3.0
STARTS = [{"x": 0.1, "x_dot": 0.0}, {"x": -0.1, "x_dot": 0.2}]


def hogan(beta, last=40, phase=math.pi / 2):
    """The block of Figure 2-12 under beta cos(omega t), the ground moving for `last` periods."""
    motion = rk.GroundMotion.harmonic(
        SQUAT.alpha * beta, period=PERIOD, phase=phase, duration=last * PERIOD
    )
    return dynamics.StroboscopicMap(SQUAT, motion, PERIOD, impact=rk.VelocityRatio(0.5))


def test_looks_and_impacts_are_those_of_one_long_motion():
    """In a chaotic motion differences of 1e-12 grow, within a few cycles not far."""
    settling, cycles = 2, 6
    found = dynamics.poincare_sections(
        lambda beta: hogan(beta),
        over={"beta": [1.5, 3.3]},
        starts=STARTS,
        settling=settling,
        cycles=cycles,
        impacts=4,
    )
    assert found.strobe.dims == ("beta", "start", "look", "state")
    for beta in found.beta.values:
        for start, initial in enumerate(STARTS):
            one = hogan(beta)
            run = rk.simulate(
                SQUAT, one.motion, impact=one.impact, initial=initial, options=one.options
            )
            here = found.sel(beta=beta).isel(start=start)
            at = run.at(PERIOD * (settling + np.arange(cycles + 1)))
            np.testing.assert_allclose(here.strobe.sel(state="x"), at["x"], atol=1e-8)
            np.testing.assert_allclose(here.strobe.sel(state="x_dot"), at["x_dot"], atol=1e-8)
            kept = [
                e for e in run.impacts if settling * PERIOD < e.time < (settling + cycles) * PERIOD
            ]
            seen = here.dropna("impact")
            assert here.impact_count.sum() == len(kept) == seen.sizes["impact"]
            np.testing.assert_allclose(seen.impact_time, [e.time % PERIOD for e in kept], atol=1e-8)
            for side in ("before", "after"):
                rates = [getattr(e, side)["x_dot"] for e in kept]
                rate = seen.impact_state.sel(side=side, state="x_dot")
                np.testing.assert_allclose(rate, rates, atol=1e-8)


def test_motion_of_two_periods_gives_what_a_long_one_does():
    """It is settled cycle by cycle, and the end of its shaking is never reached."""
    starts = {"x": [-0.3, 0.1, 0.4], "x_dot": [-0.5, 0.0, 0.9]}
    long, short = (
        dynamics.poincare_sections(hogan(2.0, last), starts=starts, settling=5, cycles=3)
        for last in (40, 2)
    )
    assert (long.outcome == short.outcome).all()
    assert {"completed", "overturned"} == set(long.outcome.values.ravel().tolist())
    np.testing.assert_allclose(long.strobe, short.strobe, atol=1e-9)
    assert np.isnan(long.strobe.values[long.outcome.values == "overturned"]).all()


def test_period_of_the_ground_may_be_the_parameter():
    """Each motion is looked at in its own time."""

    def shaken(period):
        motion = rk.GroundMotion.harmonic(SQUAT.alpha, period=period, duration=9 * period)
        return dynamics.StroboscopicMap(SQUAT, motion, period)

    found = dynamics.poincare_sections(
        shaken, over={"period": [1.5, 2.0]}, starts=[{"x": 0.1}], settling=4, cycles=2
    )
    for period in (1.5, 2.0):
        one = shaken(period)
        run = rk.simulate(SQUAT, one.motion, initial={"x": 0.1}, options=one.options)
        at = run.at(period * np.arange(4, 7))
        here = found.sel(period=period, start=0).strobe
        np.testing.assert_allclose(here.sel(state="x"), at["x"], atol=1e-9)


def test_interrupted_sections_go_on_from_their_store(tmp_path, monkeypatch):
    """Two calls find what one does, to the last bit, and simulate no motion twice."""
    pytest.importorskip("zarr")
    how = {"starts": {"x": np.linspace(-1.0, 1.0, 30)}, "settling": 8, "cycles": 4, "impacts": 3}
    run, ran = Results.run, []

    def counted(self, batch, **others):
        if sum(ran) >= stop_at:
            raise KeyboardInterrupt
        ran.append(len(batch.rows))
        run(self, batch, **others)

    def found(**more):
        ran.clear()
        return dynamics.poincare_sections(hogan(2.5), **how, **more, threads=1), sum(ran)

    monkeypatch.setattr(Results, "run", counted)
    stop_at = math.inf
    whole, all_rows = found()
    stop_at = 60
    first, done = found(store=tmp_path / "sections")
    assert first.attrs["interrupted"] == 1
    assert np.isnan(first.strobe.values[..., -1, :]).all()
    stop_at = math.inf
    second, rest = found(store=tmp_path / "sections")
    assert second.identical(whole)
    assert 0 < done < done + rest == all_rows


def test_squat_block_has_two_orbits_of_16_cycles_that_are_mirror_images():
    """At 3.25, a window between chaotic motions, all that stands ends on one of two orbits.

    The equations do not change with the signs of x, x' and the ground, half a period later: the
    mirror image of what one orbit is then belongs to the other.
    """
    stroboscope = hogan(3.25, 3000)
    starts = {"x": np.linspace(-0.4, 0.8, 5), "x_dot": np.linspace(-0.8, 0.4, 5)}
    found = dynamics.poincare_sections(stroboscope, starts=starts, settling=2500, cycles=32)
    basins = dynamics.basins(found, tolerance=1e-6)
    assert basins.orbit_cycles.values.tolist() == [16, 16]
    shares = dynamics.basin_stability(basins)
    assert shares["number"].sel(fate="not periodic") == 0
    assert shares["number"].sum() == 25
    assert shares["number"].sel(fate="overturned") == (found.outcome == "overturned").sum()
    looks = basins.strobe.stack(start=("x", "x_dot")).transpose("start", "look", "state").values
    one, other = (looks[basins.fate.values.ravel() == orbit][0, :16] for orbit in (1, 2))
    run = rk.simulate(
        SQUAT, stroboscope.motion, impact=stroboscope.impact, options=stroboscope.options,
        initial=dict(zip(("x", "x_dot"), one[0], strict=True)), duration=PERIOD / 2,
    )  # fmt: skip
    assert np.abs(run.end + other).max(axis=1).min() < 1e-5
    assert np.abs(run.end + one).max(axis=1).min() > 0.01


def made_up(looks, outcome="completed"):
    """Sections of one state: looks (n, k) at n motions."""
    looks = np.asarray(looks, dtype=float)[..., None]
    return xr.Dataset(
        {
            "outcome": ("start", np.broadcast_to(outcome, len(looks))),
            "strobe": (("start", "look", "state"), looks),
        },
        {"state": ["x"]},
        {"starts": "start"},
    )


@given(
    cycles=st.lists(st.integers(1, 5), min_size=1, max_size=4),
    shifts=st.lists(st.integers(0, 4), min_size=6, max_size=6),
)
def test_orbits_are_told_apart_by_their_looks_wherever_a_motion_is_on_them(cycles, shifts):
    """Orbit i of k cycles visits i + 1/k, i + 2/k and so on, in turn."""
    sets = [i + np.arange(1, k + 1) / k for i, k in enumerate(cycles)]
    rows = [np.resize(s, 60)[shift:][:21] for s in sets for shift in shifts]
    basins = dynamics.basins(made_up(rows))
    assert sorted(basins.orbit_cycles.values) == sorted(cycles)
    fate = basins.fate.values.reshape(len(cycles), len(shifts))
    assert (fate == fate[:, :1]).all()
    assert len({*fate[:, 0]}) == len(cycles)


def test_what_is_no_orbit_has_a_fate_of_its_own():
    x = [0.3]
    for _ in range(20):
        x.append(4 * x[-1] * (1 - x[-1]))  # the logistic map, chaotic
    nothing = np.full(21, np.nan)
    basins = dynamics.basins(
        made_up(
            [x, np.ones(21), nothing, nothing],
            ["completed", "came to rest", "overturned", "stalled"],
        )
    )
    assert basins.fate.values.tolist() == [0, 1, -1, -2]
    shares = dynamics.basin_stability(basins)
    assert shares.attrs["starts"] == 3
    assert shares["share"].sel(fate="overturned") == pytest.approx(1 / 3)


def test_bounds_of_basin_stability_are_those_of_wilson():
    """Brown, Cai and DasGupta (2001), Statistical Science 16, 101-133, equation 4."""
    n, k = 200, 30
    rows = [np.ones(9)] * k + [np.full(9, 2.0)] * (n - k)
    shares = dynamics.basin_stability(dynamics.basins(made_up(rows)))
    z = 1.959963984540054
    for fate, part in (("orbit 1", 1 - k / n), ("orbit 2", k / n)):
        centre = (part + z**2 / (2 * n)) / (1 + z**2 / n)
        reach = z / (1 + z**2 / n) * math.sqrt(part * (1 - part) / n + z**2 / (4 * n**2))
        assert shares["low"].sel(fate=fate) == pytest.approx(centre - reach)
        assert shares["high"].sel(fate=fate) == pytest.approx(centre + reach)


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"starts": {"y": [0.1]}}, ValueError, "starts has 'y': give one of x, x_dot"),
        ({"starts": {"x": ["a"]}}, ValueError, r"starts\['x'\]"),
        ({"over": [1.0]}, TypeError, "over is .1\\.0.: give names"),
        ({"over": {"x": [1.0]}}, ValueError, "'x' is a name of both `over` and `starts`"),
        ({"over": {"beta": [1.0]}}, TypeError, "stroboscope is"),
        ({"cycles": 0}, ValueError, "cycles is 0"),
    ],
)
def test_what_cannot_be_followed_is_refused(change, error, message):
    how = {"starts": {"x": [0.1]}, "settling": 0, "cycles": 1} | change
    stroboscope = (lambda x: hogan(x)) if "x" in how.get("over", ()) else hogan(2.0)
    with pytest.raises(error, match=message):
        dynamics.poincare_sections(stroboscope, **how)


def test_maps_of_several_models_are_refused():
    slender = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    motion = rk.GroundMotion.harmonic(1.0, period=0.5, duration=1.0)
    maps = {0: hogan(2.0), 1: dynamics.StroboscopicMap(slender, motion, 0.5)}
    with pytest.raises(ValueError, match="slender_block comes after nondimensional_block"):
        dynamics.poincare_sections(lambda key: maps[key], over={"key": [0, 1]}, starts={"x": [0.1]})


def test_basins_of_several_maps_are_refused():
    several = made_up(np.ones((2, 5))).expand_dims(beta=[1.0, 2.0])
    with pytest.raises(ValueError, match=r"vary beta as well.*sections.isel\(beta=0\)"):
        dynamics.basins(several)
    assert dynamics.basins(several.isel(beta=0)).fate.values.tolist() == [1, 1]
