"""Similar structures and equivalent laws respond alike."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from tests.typical import S1, by_model, column

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25, mass=300.0)


@settings(max_examples=15)
@given(factor=st.floats(0.2, 5.0), alpha=st.floats(0.1, 0.5), amplitude=st.floats(1.05, 3.0))
def test_similar_blocks_respond_alike_in_scaled_time(factor, alpha, amplitude):
    """The same shape and shaking, all times in units of 1/p (Housner's scale effect)."""
    p = 2.0
    motion = rk.GroundMotion.single_sine(amplitude * 9.81 * np.tan(alpha), period=2.0, duration=3.0)
    small, large = (
        rk.simulate(
            rk.RigidBlock.from_frequency(p=p / f, alpha=alpha),
            motion.scaled(time=f),
            options=rk.SolverOptions(rtol=1e-13, atol=1e-15),
        )
        for f in (1, factor)
    )
    t = np.linspace(0, 0.9 * min(small.t[-1], large.t[-1] / factor), 100)
    np.testing.assert_allclose(
        large.at(t * factor)["theta"], small.at(t)["theta"], atol=1e-6 * alpha
    )
    assert small.outcome is large.outcome


def test_nondimensional_block_is_the_block_in_other_units():
    p, alpha = 2.14, 0.25
    motion = rk.GroundMotion.harmonic(0.35 * 9.81, period=0.5, duration=4.0)
    block = rk.simulate(rk.RigidBlock.from_frequency(p=p, alpha=alpha), motion)
    scaled = rk.simulate(
        rk.NondimensionalBlock(alpha=alpha), motion.scaled(acceleration=1 / 9.81, time=p)
    )
    assert len(block.impacts) > 2
    t = np.linspace(0, 3.9, 200)
    np.testing.assert_allclose(scaled.at(p * t)["x"] * alpha, block.at(t)["theta"], atol=1e-8)


@pytest.mark.parametrize("structure", [BLOCK, column()], ids=by_model)
def test_energy_ratio_is_the_square_of_the_velocity_ratio(structure):
    runs = [
        rk.simulate(structure, rk.GroundMotion.none(2.0), impact=law, initial={"theta": 0.05})
        for law in (rk.EnergyRatio(0.81), rk.VelocityRatio(0.9))
    ]
    assert len(runs[0].impacts) > 2
    a, b = ([event.time for event in run.impacts[:10]] for run in runs)
    np.testing.assert_allclose(a, b, rtol=1e-10)


def test_angular_momentum_is_the_law_if_none_is_given():
    motion = rk.GroundMotion.none(5.0)
    default = rk.simulate(BLOCK, motion, initial={"theta": 0.1})
    named = rk.simulate(BLOCK, motion, impact=rk.AngularMomentum(), initial={"theta": 0.1})
    np.testing.assert_array_equal(default.y, named.y)


def test_a_very_stiff_column_is_a_rigid_one():
    """The rigid lumped-mass response is the limit; the impulsive law's too, as 5-14 is its."""
    motion = rk.GroundMotion.half_sine(5.0, period=0.6, duration=0.9)
    rigid = rk.simulate(rk.LumpedMassStructure(**S1), motion)
    t = np.linspace(0, 0.9, 100)
    errors = []
    for factor in (1e2, 1e4):
        stiff = column(stiffness=571.8e3 * factor, damping=502.4 * factor**0.5 * 20)
        run = rk.simulate(stiff, motion, impact=rk.Impulsive())
        errors.append(np.abs(run.at(t)["theta"] - rigid.at(t)["theta"]).max())
    size = np.abs(rigid["theta"]).max()
    assert errors[1] < errors[0] / 10
    assert errors[1] < 1e-3 * size
