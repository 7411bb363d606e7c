"""Answers that were wrong without a word: equal steps, narrow laws, rests, borders of calls."""

import dataclasses
import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.codes import FULL
from rockeom.integrator.program import program
from tests.typical import S1


def column(stiffness=50e6):
    return rk.FlexibleStructure(**S1, stiffness=stiffness, damping=502.4)


def noise(seed, n, dt, peak):
    a = np.convolve(np.random.default_rng(seed).normal(size=n), np.ones(6) / 6, "same")
    return rk.GroundMotion.from_array(peak * a / np.abs(a).max(), dt)


def in_equal_steps(count):
    return rk.SolverOptions(steps_per_segment=count)


# -- equal steps that are too long


@pytest.mark.parametrize("count", [1, 2, 3, 5, 10, 100])
def test_block_set_in_motion_lands_however_few_steps_are_asked_for(count):
    """It turns back after 0.06 s and is stopped by the ground; a law of 14 s has few steps."""
    run = rk.simulate(
        rk.RigidBlock(half_width=0.0338, half_height=2.839),
        rk.GroundMotion.none(13.94),
        initial={"theta_dot": 0.00188},
        impact=rk.EnergyRatio(0),
        options=in_equal_steps(count),
    )
    assert run.outcome is rk.Outcome.CAME_TO_REST
    assert len(run.impacts) == 1
    assert run["theta"].min() >= -1e-12
    assert run["theta"].max() == pytest.approx(5.74222e-5, rel=1e-5)
    assert run.statistics["refined"] == (count < 50)


def test_equal_step_refused_at_a_coarse_tolerance_is_refined_like_any_other():
    """The rest of its law is controlled: no step of half the law is tried again and again."""
    run = rk.simulate(
        rk.RigidBlock(half_width=0.1, half_height=0.5),
        rk.GroundMotion.none(2.0),
        initial={"theta": 0.15},
        options=rk.SolverOptions(steps_per_segment=1, rtol=1e-6, atol=1e-8),
    )
    assert run.statistics["refined"] == 1
    assert np.diff(run.steps.span[:, 0])[0] < 0.3


@pytest.mark.parametrize("count", [1, 4])
def test_heavily_damped_springs_in_equal_steps(count):
    """Steps of 0.1 s and more, where an explicit method is stable to 0.01 s."""
    structure = rk.TwoSpringStructure(**S1, foundation_stiffness=550e3, foundation_damping=1e4)
    shaken = structure, rk.GroundMotion.single_sine(4, 0.5, duration=3)
    equal = rk.simulate(*shaken, options=in_equal_steps(count))
    controlled = rk.simulate(*shaken)
    assert equal.outcome is controlled.outcome is rk.Outcome.COMPLETED
    assert np.isfinite(equal.y).all()
    np.testing.assert_allclose(equal.end, controlled.end, atol=1e-8)
    assert equal.statistics["refined"] > 0


@pytest.mark.parametrize("speed", [1.5, 1.51, 1.52])
def test_block_thrown_to_the_ground_and_pulled_back_within_a_step_lies_there(speed):
    """It reaches the horizontal slowly, where a strong pull of the ground would turn it back."""
    thrown = {
        "structure": rk.RigidBlock(half_width=1.0, half_height=1.2),
        "motion": rk.GroundMotion.constant(60.0, 0.18, 0.3),
        "initial": {"theta": 1.5, "theta_dot": speed},
    }
    small = rk.simulate(**thrown, options=rk.SolverOptions(max_step=1e-3))
    assert small.end[0] == pytest.approx(math.pi / 2, abs=1e-12)
    for options in (rk.SolverOptions(), *map(in_equal_steps, (1, 2, 3, 4, 5))):
        run = rk.simulate(**thrown, options=options)
        assert run.outcome is rk.Outcome.OVERTURNED
        assert run.t[-1] == pytest.approx(small.t[-1], abs=1e-5)
        np.testing.assert_allclose(run.end, small.end, atol=1e-5)


def test_stiff_columns_in_equal_steps_and_in_lanes_end_as_controlled_ones():
    """Two periods of the column between two samples: the steps of a whole sample are worthless."""

    def case(stiffness, times):
        return rk.Case(column(stiffness), noise(3, 600, 0.01, times), impact=rk.Impulsive())

    over = {"stiffness": [5e6, 5e7, 2e8], "times": [2.0, 4.0, 6.0, 8.0, 10.0, 14.0]}
    controlled = rk.simulate_many(case, over)
    assert {"overturned", "came to rest"} <= set(controlled.outcome.values.ravel().tolist())
    for lanes in (False, True):
        equal = rk.simulate_many(
            case, over, options=in_equal_steps(1), sweep_options=rk.SweepOptions(lanes=lanes)
        )
        np.testing.assert_array_equal(equal.outcome, controlled.outcome)
        assert (equal.refined > 0).any()


def test_a_step_that_is_not_finite_ends_the_motion_within_max_steps():
    """A base without mass on dampers: rates near 1e20, and guards that are infinite."""
    structure = rk.TwoSpringStructure(
        mass=10.7, height=0.415, inertia=0, base_mass=0, base_height=0.035, base_inertia=4.04,
        half_width=0.65, foundation_stiffness=3.63e6, foundation_damping=877,
    )  # fmt: skip
    options = rk.SolverOptions(steps_per_segment=2, max_steps=20)
    run = rk.simulate(
        structure,
        rk.GroundMotion.none(0.357),
        vertical=rk.GroundMotion.constant(4.46, 2.8),
        options=options,
    )
    assert run.outcome in (rk.Outcome.STALLED, rk.Outcome.NOT_FINITE)


# -- a rotation centre that moves out within a tenth of a millimetre


@pytest.mark.parametrize(("transition", "rtol"), [(1e-4, 1e-10), (3e-4, 1e-8)])
def test_wall_with_a_narrow_transition_keeps_its_energy(transition, rtol):
    """The restoring force sets in within 0.3 mm of upright; no step may pass over it unseen."""
    wall = dataclasses.replace(rk.ControlledWall.thesis(), transition=transition)
    rest = sum(wall.energies({}, mode="right").values())
    for theta in (0.002, 0.005, 0.009):
        run = rk.simulate(
            wall,
            rk.GroundMotion.none(5.0),
            initial={"theta": theta},
            impact=rk.VelocityRatio(1.0),
            options=rk.SolverOptions(rtol=rtol),
        )
        energy = run["total_energy"] - rest
        assert np.ptp(energy) <= 3e-6 * energy[0]


# -- while infinitely many impacts fade


def missing_energy(run):
    """Energy at the end that work, damping and events leave unexplained [J]; and their sum.

    The ground's work is that on masses which the ground carries along, by their velocities; Gauss'
    rule on the polynomials of the steps.
    """
    s = run.structure
    nodes, weights = np.polynomial.legendre.leggauss(6)
    x, weights = (nodes + 1) / 2, weights / 2
    work = damping = 0.0
    for (t, h), mode, powers in zip(run.steps.span, run.steps.mode, run.steps.powers, strict=True):
        theta, u, theta_dot, u_dot = np.polynomial.polynomial.polyval(x, powers)
        b = run.structure.module.SIDES[mode] * s.half_width
        top = u_dot * np.cos(theta) - (u - b) * np.sin(theta) * theta_dot
        top += s.height * np.cos(theta) * theta_dot
        base = b * np.sin(theta) * theta_dot + s.base_height * np.cos(theta) * theta_dot
        pushed = run.motion.acceleration(t + h * x) * (s.mass * top + s.base_mass * base)
        work -= h * weights @ pushed
        damping += h * weights @ (s.damping * u_dot**2)

    def energy(values, mode):
        return sum(s.energies(dict(zip(s.states, values, strict=True)), mode).values())

    lost = sum(
        energy(e.before.values(), e.mode_before) - energy(e.after.values(), e.mode_after)
        for e in run.events
    )
    start = energy(run.steps.powers[0, 0], run.mode[0])
    end = energy(run.end, run.mode[-1])
    return end - start - (work - damping - lost), abs(work) + damping + lost


@pytest.mark.parametrize(
    ("stiffness", "impact"),
    [(571.8e3, rk.VelocityRatio(0.3)), (50e6, rk.VelocityRatio(0.3)), (571.8e3, rk.Impulsive())],
    ids=["soft", "stiff", "impulsive"],
)
def test_energy_balance_through_many_rests(stiffness, impact):
    """The column goes on vibrating and the ground shaking while the base comes to rest."""
    run = rk.simulate(column(stiffness), noise(2, 1200, 0.005, 12.0), impact=impact)
    rests = sum(event.kind == "rest" for event in run.events)
    assert rests >= 1
    missing, moved = missing_energy(run)
    assert abs(missing) <= 3e-11 * moved * rests


# -- "chatter" where the motion goes on


def test_tendon_stops_yielding_at_a_turning_point_with_an_implicit_method():
    """The wall turns at a rate of rounding, and its tendon's force falls with the square of time.

    The dense output of Radau has an error there that is larger than that.
    """
    wall = rk.SubstituteGravityWall.thesis()
    for times in (18.0, 24.0, 30.0):
        motion = noise(4, 400, 0.02, times)
        runs = [
            rk.simulate(wall, motion, options=rk.SolverOptions(method=method, rtol=rtol))
            for method, rtol in (("Radau", 1e-7), ("DOP853", 1e-10))
        ]
        assert runs[0].outcome is runs[1].outcome
        assert any(event.mode_before.endswith("yield") for event in runs[0].events)


# -- records of steps that are full, anywhere


@pytest.mark.parametrize("room", [3, 4, 5, 7])
def test_a_loop_that_stops_to_empty_its_records_goes_on_to_the_last_bit(room):
    """Also where it stops at the very end of a law, and the ground's acceleration jumps."""
    jumps = rk.GroundMotion.from_array(np.array([3.0, -3.0, 4.0, -5.0, 2.0, 6.0]), dt=0.2)
    table = jumps.segments.copy()
    table[:, 4] = 0.0  # steps instead of slopes
    structure = rk.RigidBlock(half_width=0.1, half_height=0.4)
    compiled = program(structure.module, "DOP853")
    found = []
    for steps in (1000, room):
        status = np.array([1, -1, 0, 0, 0, 1, 1, 0, 0, 0])
        clock, y, rate = np.zeros(4), np.zeros(2), np.zeros(2)
        code = FULL
        while code == FULL:
            status[7:9] = 0
            code = compiled.integrate(
                status, clock, y, rate, 1.5, table, table[:0], table[:0], structure.vector, 0, 0.8,
                1e-10, np.full(2, 1e-12), math.inf, 0, 1.5, 1e-6, 1000, 10_000,
                np.empty((steps, 2)), np.empty(steps, np.int64), np.empty((steps, 8, 2)),
                np.empty(99), np.empty((99, 4), np.int64), np.empty((99, 2, 2)),
                np.empty((0, 2)), np.zeros(compiled.SCRATCH),
            )  # fmt: skip
        found.append((code, *y, *clock[:1], *status[:4]))
    assert found[0] == found[1]
