"""The response: samples, dense output, events, outcomes, words."""

import copy
import pickle
import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import design, dynamics, identification, risk
from tests.exact import FreeBlock
from tests.typical import column

P, ALPHA = 2.14, 0.25
BLOCK = rk.RigidBlock.from_frequency(p=P, alpha=ALPHA)


@pytest.fixture(scope="module")
def decay():
    return rk.simulate(
        BLOCK, rk.GroundMotion.none(6.0), impact=rk.VelocityRatio(0.9), initial={"theta": 0.2}
    )


def test_both_sides_of_an_impact(decay):
    impact = decay.impacts[2]
    before = decay.at(impact.time, side="left")
    after = decay.at(impact.time, side="right")
    assert before["theta_dot"] == pytest.approx(impact.before["theta_dot"], rel=1e-10)
    assert after["theta_dot"] == pytest.approx(impact.after["theta_dot"], rel=1e-10)
    assert after["theta_dot"] == pytest.approx(0.9 * before["theta_dot"], rel=1e-10)
    assert abs(before["theta"]) < 1e-14
    assert abs(after["theta"]) < 1e-14


def test_samples_hold_an_impact_twice(decay):
    assert np.all(np.diff(decay.t) >= 0)
    twice = decay.t[1:][np.diff(decay.t) == 0]
    assert set(twice) == {impact.time for impact in decay.impacts}
    for impact in decay.impacts:
        before, after = np.flatnonzero(decay.t == impact.time)
        assert decay.mode[before] == impact.mode_before
        assert decay.mode[after] == impact.mode_after
        assert decay["theta_dot"][before] == pytest.approx(impact.before["theta_dot"], rel=1e-12)
        assert decay["theta_dot"][after] == pytest.approx(impact.after["theta_dot"], rel=1e-12)


def test_dense_output_is_as_good_as_the_steps(decay):
    """Between samples: against the exact time at which the first fall passes an angle."""
    block = FreeBlock(P, ALPHA)
    first = decay.impacts[0].time
    t = np.linspace(0.01, 0.99, 40) * first
    found = decay.at(t)
    energy = found["theta_dot"] ** 2 / 2 + P**2 * np.cos(ALPHA - found["theta"])
    np.testing.assert_allclose(energy, P**2 * np.cos(ALPHA - 0.2), rtol=1e-10)
    assert first == pytest.approx(block.quarter(0.2), rel=1e-10)
    # and where the samples are, dense output gives them back
    inside = np.diff(decay.t, append=np.inf) > 0
    np.testing.assert_allclose(
        decay.at(decay.t[inside])["theta"], decay["theta"][inside], atol=1e-13
    )


def test_shape_of_dense_output(decay):
    assert decay.at(1.0)["theta"].shape == ()
    assert decay.at(np.full((3, 2), 1.0))["theta"].shape == (3, 2)
    assert set(decay.at(1.0)) == set(decay.states)


def test_samples_reach_from_start_to_end_at_the_spacing_asked_for():
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(2.0),
        initial={"theta": 0.1},
        options=rk.SolverOptions(output_step=0.01),
    )
    assert run.t[0] == 0.0
    assert run.t[-1] == 2.0
    assert np.diff(run.t).max() <= 0.01 * (1 + 1e-9)


def test_every_named_quantity_has_a_value_a_sample(decay):
    for name in decay.names:
        assert decay[name].shape == decay.t.shape
        assert np.isfinite(decay[name]).all()
    np.testing.assert_allclose(
        decay["total_energy"], decay["kinetic_energy"] + decay["gravitational_energy"]
    )
    assert decay.final["theta"] == pytest.approx(decay["theta"][-1], rel=1e-12)
    leaning = decay.mode == "right"
    np.testing.assert_allclose(
        decay["left_uplift"][leaning],
        2 * BLOCK.half_width * np.sin(decay["theta"][leaning]),
        atol=1e-14,
    )
    assert not decay["right_uplift"][leaning].any()


def test_ground_acceleration_of_the_samples():
    motion = rk.GroundMotion.harmonic(1.0, period=0.5, duration=1.0)
    lifting = rk.GroundMotion.harmonic(0.5, period=0.3, duration=1.0)
    run = rk.simulate(BLOCK, motion, vertical=lifting, initial={"theta": 0.05})
    np.testing.assert_allclose(
        run["ground_acceleration"], np.sin(2 * np.pi * run.t / 0.5), atol=1e-12
    )
    np.testing.assert_allclose(
        run["vertical_ground_acceleration"], 0.5 * np.sin(2 * np.pi * run.t / 0.3), atol=1e-12
    )


def test_duration_cuts_a_motion_short_and_adds_quiet_to_it():
    pulse = rk.GroundMotion.single_sine(4.0, period=0.5, duration=0.5)
    long = rk.simulate(BLOCK, pulse, duration=2.0)
    short = rk.simulate(BLOCK, pulse, duration=0.3)
    assert (long.t[-1], short.t[-1]) == (2.0, 0.3)
    t = np.linspace(0, 0.3, 20)
    np.testing.assert_allclose(short.at(t)["theta"], long.at(t)["theta"], atol=1e-10)
    assert not long["ground_acceleration"][long.t > 0.5].any()


# -- outcomes


def test_too_many_impacts():
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(100.0),
        impact=rk.VelocityRatio(1.0),
        initial={"theta": 0.1},
        options=rk.SolverOptions(max_impacts=5),
    )
    assert run.outcome is rk.Outcome.TOO_MANY_IMPACTS
    assert run.t[-1] < 100.0
    assert run.t[-1] == pytest.approx(run.impacts[-1].time)
    assert "max_impacts" in run.outcome.sentence


def test_too_many_steps():
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(100.0),
        initial={"theta": 0.1},
        options=rk.SolverOptions(max_steps=20, max_step=0.01),
    )
    assert run.outcome is rk.Outcome.STALLED
    assert run.t[-1] < 100.0


def test_overturned_is_falling_not_passing_the_balance():
    """Released just beyond alpha it falls; pushed just below the top it comes back."""
    falls = rk.simulate(BLOCK, rk.GroundMotion.none(60.0), initial={"theta": ALPHA * 1.0001})
    assert falls.outcome is rk.Outcome.OVERTURNED
    assert falls["theta"][-1] == pytest.approx(np.pi / 2, rel=1e-9)
    comes_back = rk.simulate(BLOCK, rk.GroundMotion.none(60.0), initial={"theta": ALPHA * 0.9999})
    assert comes_back.outcome is rk.Outcome.CAME_TO_REST
    # from 1.3 alpha with the speed that just carries it over the top, or not
    enough = P * np.sqrt(2 * (1 - np.cos(0.3 * ALPHA)))
    for share, outcome in ((1.01, rk.Outcome.CAME_TO_REST), (0.99, rk.Outcome.OVERTURNED)):
        initial = {"theta": ALPHA * 1.3, "theta_dot": -share * enough}
        pushed = rk.simulate(BLOCK, rk.GroundMotion.none(60.0), initial=initial)
        assert pushed.outcome is outcome


@pytest.mark.parametrize(("release", "fallen"), [(1.01, True), (0.99, False)])
def test_run_that_ends_while_the_structure_is_high_says_whether_it_will_fall(release, fallen):
    """The energy at the end decides once the shaking is over, even before it lies down."""
    run = rk.simulate(BLOCK, rk.GroundMotion.none(0.1), initial={"theta": ALPHA * release})
    assert run.t[-1] == 0.1
    assert run.outcome is (rk.Outcome.OVERTURNED if fallen else rk.Outcome.COMPLETED)


def test_outcome_of_a_flexible_structure_that_stands_is_rest():
    run = rk.simulate(column(), rk.GroundMotion.none(12.0), initial={"theta": 0.01})
    assert run.mode[-1] == "both"
    assert run.outcome is rk.Outcome.CAME_TO_REST


def test_summary_says_what_happened(decay):
    text = decay.summary()
    assert "RigidBlock" in text
    assert str(decay.outcome) in text
    assert f"{len(decay.impacts)} impacts" in text
    assert "0.2 rad" in text
    assert decay.support.describe() in text
    assert "completed" in repr(decay)

    rested = rk.simulate(
        BLOCK, rk.GroundMotion.none(20.0), impact=rk.VelocityRatio(0.9), initial={"theta": 0.2}
    )
    assert "10.65 s" in rested.summary()
    assert "came to rest" in rested.summary()


def test_events_of_a_flexible_structure_hold_all_states():
    run = rk.simulate(column(), rk.GroundMotion.none(1.0), initial={"theta": 0.03})
    impact = run.impacts[0]
    assert set(impact.before) == set(impact.after) == set(run.states)
    assert impact.before["u"] == impact.after["u"]
    assert (impact.mode_before, impact.mode_after) == ("right", "left")


@pytest.mark.parametrize("part", [-1, 0, 1])
def test_duration_that_rounding_makes_shorter_than_the_shaking_is_its_end(part):
    """Of a block at rest: 0.3 - 0.1 is not 0.2."""
    motion = rk.GroundMotion.single_sine(0.01, period=0.2, duration=0.2)
    duration = np.nextafter(0.2, part) if part else 0.2
    assert rk.simulate(BLOCK, motion, duration=duration).outcome is rk.Outcome.CAME_TO_REST
    half = rk.simulate(BLOCK, motion, duration=0.1)
    assert half.outcome is rk.Outcome.COMPLETED  # the ground shakes on


def bits(run):
    return [
        np.ascontiguousarray(a).tobytes()
        for a in (run.t, run.y, run._rows.mode, run.end, *run.events.columns, run["left_reaction"])
    ]


def test_a_response_keeps_its_numbers_whatever_is_simulated_next():
    """Arrays in which motions are integrated are used again, and not those of a response."""
    first = rk.simulate(BLOCK, rk.GroundMotion.none(6.0), initial={"theta": 0.2})
    before = bits(first)
    # another start, law with a table behind the parameters, ground and duration; two at once
    law = rk.EnergyRatioAtSpeed(((0.3, 0.9, 0.0), (np.inf, 0.8, 0.0)), height=1.0)
    shaking = rk.GroundMotion.from_array(4.0 * np.sin(np.arange(3000.0)), dt=0.01)  # 3000 steps

    def other(_):
        return rk.simulate(BLOCK, shaking, impact=law, vertical=shaking, duration=31.0)

    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(other, range(6)))
    assert found[0].statistics["steps"] > 3000
    assert all(bits(run) == bits(found[0]) for run in found)
    assert bits(rk.simulate(BLOCK, rk.GroundMotion.none(6.0), initial={"theta": 0.2})) == before
    # what is computed only when it is asked for
    for name in ("_rows", "_outputs"):
        vars(first).pop(name)
    assert bits(first) == before


@pytest.mark.parametrize("impact", [None, rk.EnergyRatioAtSpeed(((np.inf, 0.8, 0.0),), height=1.0)])
def test_motions_of_one_structure_share_no_parameters(impact):
    """The loop changes them for a moment, and threads may run a structure at the same time."""
    problem = rk.Case(BLOCK, rk.GroundMotion.none(1.0), impact=impact).problem()
    assert not np.shares_memory(problem.p(), BLOCK.vector)
    assert not np.shares_memory(problem.p(), problem.p())


# -- quantities as attributes


def test_quantities_are_attributes_and_names_of_the_response(decay):
    assert decay.time is decay.t
    for name in decay.names:
        np.testing.assert_array_equal(getattr(decay, name), decay[name])
    assert {"theta", "left_uplift", "time", "summary"} <= {*dir(decay)}
    assert tuple(decay) == decay.names
    assert "theta" in decay
    assert "drift" not in decay


def test_attribute_of_a_response_wins_over_a_quantity_of_that_name(decay):
    assert decay.final == pytest.approx(dict(zip(decay.states, decay.y[-1], strict=True)))
    assert decay.structure is BLOCK


def test_a_response_is_copied_and_pickled_with_its_attributes(decay):
    for again in (copy.copy(decay), copy.deepcopy(decay), pickle.loads(pickle.dumps(decay))):
        np.testing.assert_array_equal(again.theta_dot, decay["theta_dot"])


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("tetha", "theta"),
        ("displacment", "displacement"),
        ("left_uplfit", "left_uplift"),
        ("to_csv", "to_dataframe().to_csv(path)"),
        ("max", "extremes(name)"),
        ("summery", "summary"),
        ("friction_demand", "support.friction_demand"),
        ("positions", "places.positions"),
    ],
)
def test_unknown_attribute_of_a_response_offers_the_one_that_was_meant(decay, name, meant):
    assert not hasattr(decay, name)
    with pytest.raises(AttributeError, match=re.escape(f"(did you mean {meant}?)")):
        getattr(decay, name)


def test_case_is_simulated_as_its_parts_and_a_response_equals_itself_alone():
    motion = rk.GroundMotion.single_sine(4.0, 0.5, duration=3.0)
    parts = {
        "impact": rk.EnergyRatio(0.8), "initial": {"theta": 0.01}, "duration": 4.0,
        "vertical": motion.scaled(0.3), "mode": "right",
    }  # fmt: skip
    first, again = rk.simulate(BLOCK, motion, **parts), rk.simulate(rk.Case(BLOCK, motion, **parts))
    np.testing.assert_array_equal(first.y, again.y)
    assert first.t[-1] == 4.0
    assert first == first
    assert first != again
    assert len({first, again, first}) == 2


def test_results_that_hold_arrays_equal_themselves_alone():
    """Python would compare the arrays, and ask for the truth of many."""
    of_branches = dynamics.OrbitBranch, dynamics.PeriodicOrbit
    of_analyses = design.FemaComparison, identification.Fit, risk.FirstOrder
    for cls in (rk.Response, rk.Sensitivity, rk.Tangents, *of_branches, *of_analyses):
        assert cls.__eq__ is object.__eq__
