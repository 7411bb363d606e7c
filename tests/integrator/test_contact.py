"""Passages between modes: uplift, rest, re-uplift, and their order in time."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

import rockeom as rk
from tests.typical import (
    FIRST_MOMENT,
    FOUNDATION_STIFFNESS,
    S1,
    TOTAL_MASS,
    by_model,
    column,
)

ALPHA, GRAVITY = 0.25, 9.81
BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=ALPHA)
LUMPED = rk.LumpedMassStructure(**S1)
THRESHOLDS = [
    (BLOCK, GRAVITY * math.tan(ALPHA)),
    (rk.SlenderBlock.from_frequency(p=2.14, alpha=ALPHA), GRAVITY * ALPHA),
    (rk.NondimensionalBlock(alpha=ALPHA), math.tan(ALPHA)),  # in units of g
    (LUMPED, GRAVITY * S1["half_width"] * TOTAL_MASS / FIRST_MOMENT),
]
RIGID = pytest.mark.parametrize(
    ("structure", "threshold"), THRESHOLDS, ids=[by_model(s) for s, _ in THRESHOLDS]
)


def ramp(rate, duration=1.0):
    return rk.GroundMotion.from_array([0.0, rate * duration], dt=duration)


@RIGID
@pytest.mark.parametrize("direction", [1, -1])
def test_uplift_when_a_ramp_crosses_the_threshold(structure, threshold, direction):
    run = rk.simulate(structure, ramp(direction * 3 * threshold))
    first = run.events[0]
    assert first.kind == "uplift"
    assert first.time == pytest.approx(1 / 3, rel=1e-14)
    # ground accelerating to the right leaves the structure behind: it leans to the left
    assert (first.mode_before, first.mode_after) == ("both", "left" if direction > 0 else "right")
    before = run.t < first.time
    assert before.any()
    assert not run.y[before].any()


@RIGID
def test_acceleration_just_below_the_threshold_never_lifts(structure, threshold):
    run = rk.simulate(structure, rk.GroundMotion.constant((1 - 1e-9) * threshold, duration=50.0))
    assert run.events == ()
    assert not run.y.any()


@RIGID
def test_acceleration_just_above_the_threshold_lifts_and_overturns(structure, threshold):
    run = rk.simulate(structure, rk.GroundMotion.constant((1 + 1e-6) * threshold, duration=50.0))
    (event,) = run.events
    assert (event.time, event.kind, event.mode_after) == (0.0, "uplift", "left")
    assert run.outcome is rk.Outcome.OVERTURNED
    rotation = run.states[0]
    assert run[rotation][-1] == pytest.approx(-structure.overturning_rotation, rel=1e-9)
    assert run.t[-1] < 50.0
    assert np.all(np.diff(run[rotation]) <= 0)


SMOOTH = {
    "half sine": lambda peak: rk.GroundMotion.half_sine(peak, period=2.0),
    "fast sine": lambda peak: rk.GroundMotion.harmonic(peak, period=0.05, duration=2.0),
    "Ricker": lambda peak: rk.GroundMotion.ricker(peak, period=0.5),
    "antisymmetric Ricker": lambda peak: rk.GroundMotion.ricker(
        peak, period=0.5, antisymmetric=True
    ),
    "Mavroeidis-Papageorgiou": lambda peak: rk.GroundMotion.mavroeidis_papageorgiou(
        1.0, period=0.5, gamma=1.2, phase=0.4
    ).scaled_to(peak),
}
MOTIONS = pytest.mark.parametrize("motion_of", SMOOTH.values(), ids=SMOOTH)


@MOTIONS
@pytest.mark.parametrize("excess", [1e-3, 0.05, 1.0])
def test_uplift_under_a_smooth_pulse_is_where_it_crosses_the_threshold(motion_of, excess):
    """A block at rest has no motion whose error would keep steps short: none must be too long."""
    threshold = GRAVITY * math.tan(ALPHA)
    motion = motion_of((1 + excess) * threshold)
    run = rk.simulate(BLOCK, motion)

    def lacking(t):
        return threshold - abs(float(motion.acceleration(t)))

    t = np.linspace(0, motion.shaking_ends, 200_001)
    after = int(np.argmax(np.abs(motion.acceleration(t)) > threshold))
    crossing = brentq(lacking, t[after - 1], t[after], xtol=1e-15)
    assert run.events[0].kind == "uplift"
    assert run.events[0].time == pytest.approx(crossing, rel=1e-9)
    assert run.outcome is not rk.Outcome.CHATTER


@MOTIONS
def test_a_smooth_pulse_that_stays_just_below_the_threshold_never_lifts(motion_of):
    run = rk.simulate(BLOCK, motion_of((1 - 1e-6) * GRAVITY * math.tan(ALPHA)))
    assert run.events == ()


def test_rest_then_uplift_again():
    """A pulse, rest, and another pulse the other way: the same motion mirrored."""
    pulse, gap, dt = np.array([0.0, 1.5, 1.5, 0.0, 0.0]), 40, 0.1
    a = 3.0 * np.concatenate([pulse, np.zeros(gap * 10), -pulse, np.zeros(gap * 10)])
    run = rk.simulate(BLOCK, rk.GroundMotion.from_array(a, dt), impact=rk.VelocityRatio(0.7))
    rests = [e.time for e in run.events if e.kind == "rest"]
    uplifts = [e.time for e in run.events if e.kind == "uplift"]
    assert len(rests) == len(uplifts) == 2
    assert uplifts[0] < rests[0] < uplifts[1] < rests[1]
    shift = dt * (len(pulse) + gap * 10)
    assert uplifts[1] - uplifts[0] == pytest.approx(shift, rel=1e-12)
    assert rests[1] - rests[0] == pytest.approx(shift, rel=1e-9)
    t = np.linspace(uplifts[0], rests[0], 50)
    np.testing.assert_allclose(run.at(t + shift)["theta"], -run.at(t)["theta"], atol=1e-8)


def test_an_impact_without_loss_on_shaking_ground_goes_on_rocking():
    """Full contact must not be entered from an impact that leaves speed."""
    motion = rk.GroundMotion.harmonic(2.0, period=0.8, duration=8.0)
    run = rk.simulate(BLOCK, motion, impact=rk.VelocityRatio(0.99), initial={"theta": 0.1})
    assert {(e.mode_before, e.mode_after) for e in run.impacts} <= {
        ("left", "right"),
        ("right", "left"),
    }
    assert len(run.impacts) > 5


@pytest.mark.parametrize("stiffness", [2e4, 571.8e3])
def test_uplift_of_a_flexible_structure_is_where_a_foot_ceases_to_press(stiffness):
    """From rest, under a ramp that is fast for the column: the foot's force is what is zero."""
    run = rk.simulate(column(stiffness=stiffness), ramp(60.0, duration=0.2))
    first = run.events[0]
    assert first.kind == "uplift"
    force = column(stiffness=stiffness).reactions(first.before, 60.0 * first.time, mode="both")
    assert abs(force["right_reaction"]) < 1e-9 * TOTAL_MASS * GRAVITY
    assert force["left_reaction"] == pytest.approx(TOTAL_MASS * GRAVITY, rel=1e-9)
    # and it pressed until then
    standing = run.mode == "both"
    assert run["right_reaction"][standing].min() > -1e-9 * TOTAL_MASS * GRAVITY


@settings(max_examples=30)
@given(
    amplitude=st.floats(0.5, 12.0),
    period=st.floats(0.1, 2.0),
    e=st.floats(0.3, 1.0),
    flexible=st.booleans(),
)
def test_events_follow_one_another_in_order(amplitude, period, e, flexible):
    """Each event starts in the mode in which the one before it ended."""
    structure = column() if flexible else BLOCK
    motion = rk.GroundMotion.single_sine(amplitude, period=period, duration=6.0)
    run = rk.simulate(structure, motion, impact=rk.VelocityRatio(e))
    assert np.all(np.diff(run.t) >= 0)
    times = [event.time for event in run.events]
    assert times == sorted(times)
    for before, after in itertools.pairwise(run.events):
        assert before.mode_after == after.mode_before
    assert run.events == () or run.events[0].mode_before == "both"
    # never on the wrong side
    side = {"left": -1, "both": 0, "right": 1}
    sign = np.array([side[name] for name in run.mode])
    assert np.all(run["theta"] * sign >= -1e-12)
    assert not run["theta"][sign == 0].any()
    for event in run.impacts:
        assert event.before["theta"] == pytest.approx(0.0, abs=1e-12)
        assert event.after["theta"] == 0.0
        assert event.before["theta_dot"] * side[event.mode_before] <= 0


# -- states that fit no mode, or another than is named

WALLS = [
    rk.ControlledWall.thesis(),
    rk.FlexibleControlledWall.thesis(),
    rk.SubstituteGravityWall.thesis(),
    rk.SimplifiedSubstituteGravityWall.thesis(),
    rk.ControlledWallOscillator.thesis(0.9),
]


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.model)
@pytest.mark.parametrize("side", [-1, 1])
def test_wall_beyond_yield_on_its_way_back_has_drawn_its_tendon_out(wall, side):
    """The tendon keeps its yield force, and it is on the side on which the wall leans."""
    q = wall.states[0]
    far = 0.05 if q == "theta" else 0.12
    state = {q: side * far, f"{q}_dot": -side * 0.1}
    assert wall.reactions(state)["tendon_force"] == pytest.approx(wall.yield_force, rel=1e-12)
    mode = wall.module.MODES[wall.mode_number(wall.state(state))]
    assert mode.startswith("right" if side > 0 else "left")
    mirrored = {name: -value for name, value in state.items()}
    assert wall.accelerations(state)[q] == -wall.accelerations(mirrored)[q]
    assert sum(wall.energies(state).values()) == sum(wall.energies(mirrored).values())
    with pytest.raises(ValueError, match=r"no mode of .* holds"):
        wall.accelerations(state | {"permanent_extension": 0.0})
    # outwards it still yields
    outwards = {q: side * far, f"{q}_dot": side * 0.1}
    assert wall.module.MODES[wall.mode_number(wall.state(outwards))].endswith("yield")


@pytest.mark.parametrize(
    ("structure", "state", "mode"),
    [
        (WALLS[0], {"theta": -0.02}, "right"),
        (WALLS[0], {"theta": -0.02}, "right_slack"),
        (rk.TwoSpringCart(**S1, foundation_stiffness=FOUNDATION_STIFFNESS), {"u": -0.2}, "right"),
    ],
    ids=lambda value: value if isinstance(value, str) else None,
)
def test_mode_whose_impact_is_over_is_refused(structure, state, mode):
    with pytest.raises(ValueError, match=f"the mode '{mode}' of {structure.model} contradicts"):
        rk.simulate(structure, rk.GroundMotion.none(1.0), initial=state, mode=mode)


def test_upright_structure_begins_on_the_side_to_which_it_will_go():
    """Mirrored, no passage more and no bit other: a sine is zero where it begins, and half-way."""
    structures = [
        rk.DiracDeltaBlock(alpha=0.2, energy_ratio=0.8, regularisation=1e-3),
        rk.TwoSpringCart(**S1, foundation_stiffness=FOUNDATION_STIFFNESS),
        WALLS[0],
        WALLS[4],
    ]
    motions = [
        (rk.GroundMotion.single_sine, (4.0, 0.5)),
        (rk.GroundMotion.harmonic, (0.4, None, 2.0)),
        (rk.GroundMotion.ricker, (3.0, 0.4)),
    ]
    for structure in structures:
        for make, (amplitude, *rest) in motions:
            cases = []
            for sign in (1, -1):
                motion = (
                    make(sign * amplitude, frequency=2.0, duration=2.0)
                    if rest[0] is None
                    else make(sign * amplitude, *rest)
                )
                cases.append(rk.Case(structure, motion).problem())
            names = [structure.module.MODES[case.mode] for case in cases]
            assert {name.split("_")[0] for name in names} in ({"left", "right"}, {"both"})
            assert names[0] != names[1]
