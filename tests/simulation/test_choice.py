"""The method that a motion is given where none is named: no worse a result, in less work."""

import dataclasses

import numpy as np
import pytest

import rockeom as rk
from rockeom.simulation.case import Case
from rockeom.simulation.method_selection import chosen
from rockeom.structures.classes import SHIPPED
from tests.integrator.test_stiff import LIFTING, MASS, STIFF, on_springs
from tests.shipped import plain
from tests.typical import column

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
COLUMN = column()
SAMPLES = 4.0 * np.sin(0.005 * np.arange(1200.0)) * np.sin(0.08 * np.arange(1200.0))
CLOSE = rk.GroundMotion.from_array(SAMPLES, 0.005)
PULSE = rk.GroundMotion.single_sine(4.0, 1.0, duration=2.0)
LOOSE = rk.SolverOptions(rtol=1e-6, atol=1e-8)


def choice(structure, motion, options=None, **others):
    case = Case(structure, motion, **others)
    return chosen(structure, case.problem(), options or rk.SolverOptions()).method


# -- the rates that it goes by


@pytest.mark.parametrize("stiffness", [1e6, 1e9])
def test_decay_of_heave_on_dashpots_in_closed_form(stiffness):
    """m z'' + 2 c z' + 2 k z = 0, the larger root; rotation decays more slowly on these feet."""
    damping = 1e8
    root = np.sqrt(damping**2 - 2 * stiffness * MASS)
    motion, decay = on_springs(stiffness, damping).small_motion
    assert decay == pytest.approx((damping + root) / MASS, rel=1e-6)
    assert 0.0 < motion < 10.0  # it topples, slowly
    assert on_springs(stiffness, damping).fastest_damping >= decay


def test_vibration_of_a_stiff_spring_is_motion_and_no_decay():
    motion, decay = on_springs(1e9, 1e3).small_motion
    assert motion >= np.sqrt(2e9 / MASS) * 0.999
    assert decay < 10.0


def test_a_block_topples_at_its_frequency_parameter():
    """theta'' = -p^2 sin(alpha - theta) about upright."""
    assert BLOCK.fastest_damping == 0.0
    expected = BLOCK.frequency_parameter * np.sqrt(np.cos(BLOCK.alpha))
    assert BLOCK.small_motion == pytest.approx((expected, expected), rel=1e-6)


def test_a_structure_without_its_damper_hides_none_of_others():
    """Whether a model is damped is asked once: by all that it may have, not by what one has."""
    undamped = dataclasses.replace(COLUMN, damping=0.0)
    assert undamped.fastest_damping == 0.0
    assert COLUMN.fastest_damping > 1.0


# -- what is chosen


@pytest.mark.parametrize("name", SHIPPED)
def test_defaults_are_of_order_eight(name):
    structure = SHIPPED[name](**plain(name))
    for motion in (CLOSE, PULSE, rk.GroundMotion.none(10.0)):
        assert choice(structure, motion) == "DOP853"
        assert choice(structure, motion, rk.SolverOptions(steps_per_segment=1)) == "DOP853"


def test_a_loose_tolerance_is_of_order_five_only_under_close_samples():
    assert choice(BLOCK, CLOSE, LOOSE) == "RK45"
    assert choice(BLOCK, CLOSE, dataclasses.replace(LOOSE, rtol=1e-7)) == "DOP853"
    assert choice(BLOCK, PULSE, LOOSE) == "DOP853"
    assert choice(BLOCK, rk.GroundMotion.none(9.0), LOOSE, initial={"theta": 0.1}) == "DOP853"
    assert choice(COLUMN, CLOSE, LOOSE) == "DOP853"  # it vibrates at 68 rad/s and more
    assert choice(BLOCK, rk.GroundMotion.from_array(SAMPLES, 0.05), LOOSE) == "DOP853"
    many = dataclasses.replace(LOOSE, steps_per_segment=400)
    assert choice(BLOCK, PULSE, many) == "RK45"


def test_a_method_that_is_named_is_taken():
    run = rk.simulate(STIFF, rk.GroundMotion.none(0.01), options=rk.SolverOptions("DOP853"))
    assert run.statistics["method"] == "DOP853"
    assert run.statistics["chosen"] == "named"


# -- and that it is no worse


def test_heavily_damped_springs_are_given_an_implicit_method():
    """A twentieth of the explicit steps, and an error below what is asked of both."""
    exact = rk.simulate(STIFF, LIFTING, options=rk.SolverOptions("DOP853", 1e-12, 1e-14))
    explicit = rk.simulate(STIFF, LIFTING, options=rk.SolverOptions("DOP853", 1e-8, 1e-10))
    found = rk.simulate(STIFF, LIFTING, options=rk.SolverOptions(rtol=1e-8, atol=1e-10))
    assert found.statistics["method"] == "Radau"
    assert "stability" in found.statistics["chosen"]
    assert explicit.statistics["steps"] > 20 * found.statistics["steps"]
    t = np.linspace(0.0, 2.0, 401)
    for name, true in exact.at(t).items():
        assert np.abs(found.at(t)[name] - true).max() < 1e-6 * np.abs(true).max()


def test_springs_in_oil_do_not_stall():
    """Rates of 10 and 2.5e8 1/s: explicitly, 10^8 steps in three seconds."""
    stiffness, damping = 1e12, 1e11
    start = 1.0 / stiffness
    run = rk.simulate(
        on_springs(stiffness, damping),
        rk.GroundMotion.none(3.0),
        initial={"heave": start},
        options=rk.SolverOptions(rtol=1e-8, atol=1e-10 * start),
    )
    assert run.statistics["method"] == "Radau"
    assert run.statistics["steps"] < 2000
    t = np.linspace(0.0, 1.0, 50)
    slow = 2 * stiffness / (damping + np.sqrt(damping**2 - 2 * stiffness * MASS))
    np.testing.assert_allclose(run.at(t)["heave"], start * np.exp(-slow * t), atol=1e-6 * start)


def test_order_five_keeps_a_loose_tolerance():
    exact = rk.simulate(BLOCK, CLOSE, options=rk.SolverOptions("DOP853", 1e-13, 1e-15))
    found = rk.simulate(BLOCK, CLOSE, options=LOOSE)
    assert found.statistics["method"] == "RK45"
    assert len(exact.impacts) > 3
    t = np.linspace(0.0, CLOSE.duration, 301)
    true = exact.at(t)["theta"]
    assert np.abs(found.at(t)["theta"] - true).max() < LOOSE.rtol * np.abs(true).max()
    firm = [i.time for i in exact.impacts if abs(i.before["theta_dot"]) > 0.02]
    times = np.array([i.time for i in found.impacts])
    assert all(np.abs(times - time).min() < LOOSE.rtol for time in firm)


# -- sweeps


def test_a_sweep_chooses_by_its_first_case():
    stiff = rk.simulate_many(
        lambda damping: rk.Case(on_springs(1e9, damping), LIFTING),
        {"damping": [1e8, 2e8]},
        options=LOOSE,
        impact_times=0,
    )
    assert stiff.attrs["method"] == "Radau"
    assert "first case" in stiff.attrs["chosen"]
    for damping in stiff.damping.values:
        alone = rk.simulate(on_springs(1e9, damping), LIFTING, options=LOOSE)
        assert alone.statistics["method"] == "Radau"
        assert stiff.final.sel(damping=damping).values.tolist() == [*alone.final.values()]


def test_a_first_case_that_cannot_be_is_told_with_its_values():
    with pytest.raises(ValueError, match=r"case theta = 3: .*lies on the ground"):
        rk.simulate_many(
            lambda theta: rk.Case(BLOCK, PULSE, initial={"theta": theta}), {"theta": [3.0, 0.1]}
        )
