"""Lyapunov exponents through impacts: contraction, multipliers, pairs of motions, statistics."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.analysis import dynamics
from rockeom.cli.demo import COLUMN
from tests.refusals import refuses

SQUAT = rk.NondimensionalBlock(alpha=math.atan(0.5))
PERIOD, RESTITUTION = 3.0, 0.5


def hogan(beta, last=2):
    """The block of Figure 2-12 under beta cos(omega t), the ground moving for `last` periods."""
    motion = rk.GroundMotion.harmonic(
        SQUAT.alpha * beta, period=PERIOD, phase=math.pi / 2, duration=last * PERIOD
    )
    return dynamics.StroboscopicMap(SQUAT, motion, PERIOD, impact=rk.VelocityRatio(RESTITUTION))


def settled(beta, x=0.1, x_dot=0.0, cycles=2500):
    found = dynamics.poincare_sections(
        hogan(beta, cycles + 2), starts={"x": [x], "x_dot": [x_dot]}, settling=cycles, cycles=1
    )
    return found.strobe.values[0, 0, -1]


def pair(stroboscope, start, cycles, apart=1e-7):
    """(c,) logarithm of how much the distance of two motions grew in each cycle.

    They begin with a distance in the first state, and the second is brought back to the first one's
    side each time (Benettin, Galgani and Strelcyn 1976, Physical Review A 14, 2338-2345).
    """
    found, one = [], np.asarray(start)
    other = one + apart * np.eye(len(one))[0]
    for _ in range(cycles):
        one, other = (stroboscope.points(at, 1)[1] for at in (one, other))
        distance = np.linalg.norm(other - one)
        found.append(math.log(distance / apart))
        other = one + apart / distance * (other - one)
    return np.array(found)


def test_sum_of_exponents_is_the_mean_contraction_of_the_impacts():
    """Between impacts a block without damping keeps areas of its plane, an impact takes e**2."""
    spectrum = dynamics.lyapunov_spectrum(hogan(3.3), {"x": 0.1}, cycles=40, settling=0)
    run = rk.simulate(
        SQUAT, hogan(3.3, 41).motion, impact=rk.VelocityRatio(RESTITUTION),
        initial={"x": 0.1}, duration=40 * PERIOD,
    )  # fmt: skip
    mean = 2 * math.log(RESTITUTION) * len(run.impacts) / (40 * PERIOD)
    assert spectrum.exponents.sum() == pytest.approx(mean, rel=1e-9)


def test_two_motions_part_as_the_largest_exponent_says():
    """In chaos, over the same cycles; the difference of two motions has an error of its length."""
    start, cycles = settled(3.3, cycles=100), 60
    spectrum = dynamics.lyapunov_spectrum(hogan(3.3), start, cycles=cycles, settling=0)
    grown = pair(hogan(3.3), start, cycles)
    np.testing.assert_allclose(spectrum.growth[:, 0], grown, atol=2e-4)
    assert spectrum.exponents[0] == pytest.approx(grown.mean() / PERIOD, abs=1e-5)


def test_two_motions_of_a_structure_that_bends_near_each_other_as_its_spectrum_says():
    column = rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4)
    shaking = rk.GroundMotion.harmonic(4.0, period=0.5, duration=1.0)
    stroboscope = dynamics.StroboscopicMap(column, shaking, period=0.5)
    start = stroboscope.points({"theta": 0.05}, 5)[-1]
    spectrum = dynamics.lyapunov_spectrum(stroboscope, start, cycles=20, settling=0)
    np.testing.assert_allclose(spectrum.growth[:, 0], pair(stroboscope, start, 20), atol=1e-3)
    assert spectrum.exponents.shape == (4,)


def test_squat_block_is_chaotic_beside_a_cycle_of_three_periods():
    """At 3.242 the start decides between chaos and a cycle that coexists; the signs tell."""
    cycle = settled(3.242, 1 / 3, -1 / 3)
    quiet = dynamics.lyapunov_spectrum(hogan(3.242), cycle, cycles=60, settling=12)
    wild = dynamics.lyapunov_spectrum(hogan(3.242), settled(3.242, cycles=500), cycles=200)
    assert quiet.bounds()[1][0] < 0 < wild.bounds()[0][0]
    assert quiet.dimension == 0.0
    assert 1.0 < wild.dimension < 2.0


def test_largest_exponent_is_positive_just_where_looks_do_not_repeat_themselves():
    """Through the cascade, in windows of 16 and 10 cycles, and in the chaos between them."""
    values = [3.22, 3.24, 3.25, 3.265, 3.3]
    found = dynamics.poincare_sections(
        lambda beta: hogan(beta, 5002), over={"beta": values}, starts={"x": [0.1]},
        settling=5000, cycles=64,
    )  # fmt: skip
    cycles = []
    for beta in values:
        one = dynamics.basins(found.sel(beta=beta), tolerance=1e-6)
        cycles.append(int(one.orbit_cycles[0]) if one.fate > 0 else 0)
        at = found.strobe.sel(beta=beta).values[0, -1]
        low, high = dynamics.lyapunov_spectrum(hogan(beta), at, cycles=320, settling=5).bounds()
        assert low[0] > 0 if cycles[-1] == 0 else high[0] < 0
    assert cycles == [4, 0, 16, 10, 0]


def test_exponents_of_a_cycle_are_the_logarithms_of_its_multipliers():
    """At 3.25, in a window between chaotic motions: a cycle of 16 periods."""
    cycle = settled(3.25)
    spectrum = dynamics.lyapunov_spectrum(hogan(3.25), cycle, cycles=64, settling=16)
    orbit = hogan(3.25).orbit(cycle, cycles=16)
    assert orbit.stable
    multiplier = abs(orbit.multipliers[0])  # the other one is less than rounding errors of it
    expected = math.log(multiplier) / (16 * PERIOD)
    assert spectrum.exponents[0] == pytest.approx(expected, rel=1e-4)
    contraction = 4 * math.log(RESTITUTION) / PERIOD
    assert spectrum.exponents.sum() == pytest.approx(contraction, rel=1e-12)


def test_two_calls_give_what_one_does():
    stroboscope = hogan(3.3)
    whole = dynamics.lyapunov_spectrum(stroboscope, {"x": 0.1}, cycles=50, settling=5)
    half = dynamics.lyapunov_spectrum(stroboscope, {"x": 0.1}, cycles=25, settling=5)
    both = dynamics.lyapunov_spectrum(stroboscope, half, cycles=25)
    np.testing.assert_array_equal(both.growth, whole.growth)
    np.testing.assert_array_equal(both.state, whole.state)
    with refuses("initial"):
        dynamics.lyapunov_spectrum(
            dynamics.StroboscopicMap(SQUAT, stroboscope.motion, PERIOD, states=("x",)), half
        )


def test_cycle_in_which_the_block_comes_to_rest_forgets_where_it_began():
    """The ground is too weak to lift it again."""
    spectrum = dynamics.lyapunov_spectrum(hogan(0.5), {"x": 0.1}, cycles=20, settling=10)
    assert (spectrum.exponents == -np.inf).all()
    assert spectrum.dimension == 0.0


def test_block_that_falls_has_no_exponents():
    with pytest.raises(ArithmeticError, match=r"no cycle 1 from .*fell over"):
        dynamics.lyapunov_spectrum(hogan(3.3), {"x": 0.9, "x_dot": 0.9}, cycles=20)


# --- statistics


def spectrum_of(growth, period=1.0):
    growth = np.asarray(growth, dtype=float)
    n = growth.shape[1]
    return dynamics.LyapunovSpectrum(tuple("xyzw"[:n]), period, growth, np.zeros(n), "", np.eye(n))


def test_bounds_hold_the_mean_of_growth_that_hangs_on_the_cycle_before():
    """19 of 20, of an autoregressive process whose variance of the mean is known."""
    rng, persistence, cycles = np.random.default_rng(5), 0.7, 3000
    hits, errors = 0, []
    noise = rng.standard_normal((cycles + 100, 300))
    for k in range(1, len(noise)):
        noise[k] += persistence * noise[k - 1]
    for column in noise[100:].T:
        spectrum = spectrum_of(column[:, None] + 0.2, period=2.0)
        low, high = spectrum.bounds(0.95)
        hits += bool(low[0] <= 0.1 <= high[0])
        errors.append(spectrum.standard_errors[0])
    assert 0.91 <= hits / 300 <= 0.98
    exact = 1.0 / (1.0 - persistence) / math.sqrt(cycles) / 2.0
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(exact, rel=0.08)


@settings(max_examples=40)
@given(st.lists(st.floats(-3.0, 3.0), min_size=1, max_size=4))
def test_dimension_lies_where_the_sum_of_the_exponents_passes_zero(means):
    """Interpolated between the whole numbers, the sum of that many exponents is zero."""
    spectrum = spectrum_of(np.tile(means, (20, 1)))
    sums = np.concatenate([[0.0], np.cumsum(spectrum.exponents)])
    if sums.min() < 0:
        at = np.interp(spectrum.dimension, np.arange(len(sums)), sums)
        assert at == pytest.approx(0.0, abs=1e-12)
    else:
        assert spectrum.dimension == len(means)


def test_exponents_are_ordered_and_keep_their_own_errors():
    rng = np.random.default_rng(2)
    growth = np.column_stack([-1.0 + 0.0 * rng.random(100), 1.0 + rng.standard_normal(100)])
    spectrum = spectrum_of(growth)
    assert spectrum.exponents[0] > 0.5
    assert spectrum.exponents[1] == -1.0
    assert spectrum.standard_errors[0] > 0.05
    assert spectrum.standard_errors[1] < 1e-12
    assert "100 cycles of 1>" in repr(spectrum)
