"""Overturning maps and their boundaries, beside the exact motion of the slender block."""

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics, formulas
from rockeom.motion import STANDARD_GRAVITY as GRAVITY
from tests.typical import S1

from .exact_slender import exact_fates

SLENDER = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
SPEED_RATIO = 0.9
PULSE = dynamics.dimensionless_pulses(SLENDER, impact=rk.VelocityRatio(SPEED_RATIO), p=2.0)

GRID = {"frequency": np.linspace(1.0, 6.0, 41), "amplitude": np.linspace(0.8, 8.0, 37)}


@pytest.fixture(scope="module")
def sweep():
    return rk.simulate_many(PULSE, GRID)


@pytest.fixture(scope="module")
def boundaries(sweep):
    return analysis.overturning_boundaries(PULSE, sweep, accuracy=1e-8)


def test_slender_block_under_sines_meets_the_fates_of_its_exact_motion(sweep):
    found = dynamics.impacts_before_overturning(sweep, most=3).values
    w, a = (grid.ravel() for grid in np.meshgrid(*GRID.values(), indexing="ij"))
    exact = exact_fates(w, a, SPEED_RATIO).reshape(found.shape)
    assert {0.0, 1.0, np.inf} <= set(exact.ravel())
    np.testing.assert_array_equal(found, exact)


def test_boundaries_of_the_slender_block_enclose_those_of_its_exact_motion(boundaries):
    assert set(boundaries.along.values) == {"frequency", "amplitude"}
    assert ((boundaries.high - boundaries.low) <= 1e-8 * boundaries.high).all()
    for end, fate in (("low", "below"), ("high", "above")):
        at = {
            name: np.where(boundaries.along == name, boundaries[end], boundaries[name])
            for name in GRID
        }
        exact = exact_fates(at["frequency"], at["amplitude"], SPEED_RATIO)
        np.testing.assert_array_equal(boundaries[fate].values, exact)


def test_least_half_sine_that_overturns_is_housners():
    pulse = dynamics.dimensionless_pulses(
        SLENDER, rk.GroundMotion.half_sine, impact=rk.VelocityRatio(SPEED_RATIO), p=2.0
    )
    over = {"frequency": [0.5, 1.0, 2.0, 4.0], "amplitude": np.linspace(0.9, 8.0, 72)}
    sweep = rk.simulate_many(pulse, over)
    found = analysis.overturning_boundaries(pulse, sweep, "amplitude", accuracy=1e-9)
    least = dynamics.minimum_overturning(found, "frequency", "amplitude")
    half = np.pi / (2.0 * least.frequency.values)
    exact = formulas.overturning_half_sine(half, 0.2, 2.0) / (GRAVITY * 0.2)
    np.testing.assert_allclose(least, exact, rtol=3e-9)
    assert (least.impacts == 0).all()


# --- an interval in which more happens, an interrupt, cases without an answer


def tall(amplitude):
    """The block of Figure 2-13 [g]."""
    block = rk.RigidBlock(half_width=1.0, half_height=8.0)
    pulse = rk.GroundMotion.single_sine(amplitude * GRAVITY, 2.192)
    return rk.Case(block, pulse, impact=rk.EnergyRatio(0.954))


def coarse(*amplitudes):
    return rk.simulate_many(tall, {"amplitude": amplitudes})


def test_safe_window_is_found_between_two_fates_if_a_half_falls_into_it():
    """Between 0.4506 g, one impact, and 0.4556 g, none, the middle stands."""
    found = analysis.overturning_boundaries(tall, coarse(0.4506, 0.4556))
    assert found.below.values.tolist() == [1.0, np.inf]
    assert found.above.values.tolist() == [np.inf, 0.0]
    assert found.attrs["interrupted"] == 0


def test_boundaries_go_on_to_a_finer_accuracy():
    whole = analysis.overturning_boundaries(tall, coarse(0.1, 0.3, 0.453))
    finer = analysis.overturning_boundaries(tall, whole, accuracy=1e-10)
    assert ((finer.low >= whole.low) & (finer.high <= whole.high)).all()
    assert (finer.high - finer.low <= 1e-10 * finer.high).all()


def test_rough_sweep_is_corrected_beside_its_boundaries():
    sweep = coarse(0.1, 0.17, 0.3, 0.4)
    wrong = sweep.copy(deep=True)
    wrong["outcome"][2] = "completed"  # at 0.3 g, as if the tolerance had been too large
    found = analysis.overturning_boundaries(tall, wrong)
    assert found.identical(analysis.overturning_boundaries(tall, sweep))


def test_no_answer_is_no_fate_and_no_boundary():
    sweep = coarse(0.1, 0.3)
    sweep["outcome"][0] = "stalled"
    fates = dynamics.impacts_before_overturning(sweep)
    assert np.isnan(fates[0])
    assert fates[1] == 1
    assert not analysis.overturning_boundaries(tall, sweep).sizes["boundary"]


def test_whole_numbers_that_are_not_looked_along_stay_whole():
    def frame(columns, amplitude):
        assert isinstance(columns, int | np.integer)
        return tall(amplitude / columns)

    sweep = rk.simulate_many(frame, {"columns": [1, 2], "amplitude": [0.1, 0.3, 0.6]})
    found = analysis.overturning_boundaries(frame, sweep, "amplitude", accuracy=1e-9)
    onset = found.isel(boundary=np.flatnonzero(np.isinf(found.below)))
    first, second = (float(onset.amplitude[onset.columns == n].min()) for n in (1, 2))
    assert second == pytest.approx(2 * first, rel=1e-9)


# --- what cannot be asked for


def test_what_is_no_grid_of_numbers_is_refused():
    words = rk.simulate_many(
        lambda pulse, amplitude: tall(amplitude), {"pulse": ["a", "b"], "amplitude": [0.1, 0.3]}
    )
    with pytest.raises(ValueError, match="'pulse': the sweep is to be a grid over names that hold"):
        analysis.overturning_boundaries(tall, words, "pulse")
    found = analysis.overturning_boundaries(lambda pulse, amplitude: tall(amplitude), words)
    assert found.pulse.values.tolist() == ["a", "b"]
    table = rk.simulate_many(tall, [{"amplitude": 0.1}, {"amplitude": 0.3}])
    with pytest.raises(ValueError, match="it is over case"):
        analysis.overturning_boundaries(tall, table)
    with pytest.raises(ValueError, match="accuracy is 0"):
        analysis.overturning_boundaries(tall, coarse(0.1, 0.3), accuracy=0)


def test_structure_without_a_frequency_parameter_asks_for_one():
    with pytest.raises(ValueError, match="lumped_mass_structure has no p of its own: give p"):
        dynamics.dimensionless_pulses(rk.LumpedMassStructure(**S1))


def test_spectrum_of_overturning_asks_for_names_it_has(boundaries):
    with pytest.raises(ValueError, match="no 'period'; they have frequency, amplitude"):
        dynamics.minimum_overturning(boundaries, "period", "amplitude")
    stands = analysis.overturning_boundaries(tall, coarse(0.01, 0.02))
    with pytest.raises(ValueError, match="nothing that stands overturns along amplitude"):
        dynamics.minimum_overturning(stands, "amplitude", "amplitude")


# --- rocking spectra


def test_block_as_large_as_its_period_rocks_as_that_block_does():
    motions = [rk.GroundMotion.single_sine(a, 0.8, duration=6.0) for a in (2.5, 4.0)]
    sweep = analysis.rocking_spectrum(motions, [3.0, 4.0], 0.2)
    assert sweep.sizes["motion"] == 2
    block = rk.RigidBlock.from_frequency(p=np.pi / 2, alpha=0.2)
    run = rk.simulate(block, motions[1])
    found = sweep.isel(motion=1).sel(period=4.0, alpha=0.2)
    peak = max(abs(run.extremes("theta").maximum), abs(run.extremes("theta").minimum))
    assert float(found.peak.sel(state="theta")) == pytest.approx(peak, rel=1e-7)
    with pytest.raises(ValueError, match=r"periods\[1\] is -1.0: it must be positive"):
        analysis.rocking_spectrum(motions, [3.0, -1.0], 0.2)
