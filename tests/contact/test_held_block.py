"""Blocks held by putty, with rounded corners or an eccentric centroid."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from tests.refusals import told

SIZE = {"width": 0.5, "height": 1.8, "mass": 300.0, "friction": 3.0}
PULSE = rk.GroundMotion.single_sine(amplitude=3.0, period=0.8, duration=2.0)
FINE = rk.SolverOptions(rtol=1e-11, atol=1e-12)


def test_a_block_that_nothing_holds_is_the_sliding_block():
    held = rk.simulate(rk.HeldBlock(**SIZE), PULSE)
    free = rk.simulate(
        rk.SlidingBlock(
            half_width=0.25, half_height=0.9, mass=300.0, friction=3.0, restitution=0.0
        ),
        PULSE,
    )
    for name, value in free.final.items():
        assert held.final[name] == pytest.approx(value, rel=1e-8, abs=1e-9)


@pytest.mark.parametrize("theta", [0.03, -0.03])
def test_a_rounded_corner_rolls(theta):
    """One angle, by the kinetic and potential energy of a rolling arc, differentiated by steps."""
    r, b, h, mass = 0.08, 0.25, 0.9, 300.0
    inertia = mass * (0.5**2 + 1.8**2) / 12
    side = np.sign(theta)

    def centroid(
        angle,
    ):  # the arc's centre moves as it rolls; the centroid turns clockwise about it
        across, up = -side * (b - r), h - r
        return np.array([
            r * angle + across * np.cos(angle) + up * np.sin(angle),
            r - across * np.sin(angle) + up * np.cos(angle),
        ])  # fmt: skip

    def derivatives(angle, step=1e-4):
        before, at, after = (centroid(angle + k * step) for k in (-1, 0, 1))
        return (after - before) / (2 * step), (after - 2 * at + before) / step**2

    def rates(_, state):
        first, second = derivatives(state[0])
        effective = mass * first @ first + inertia
        forces = -mass * first @ second * state[1] ** 2 - mass * 9.81 * first[1]
        return [state[1], forces / effective]

    start, until = {"theta": theta, "theta_dot": side * 0.6}, 0.1
    own = solve_ivp(rates, (0.0, until), [*start.values()], rtol=1e-10, atol=1e-12).y[:, -1]
    block = rk.HeldBlock(**SIZE, corner_radius=r)
    run = rk.simulate(block, rk.GroundMotion.none(until), initial=start, options=FINE)
    assert len(run.events) == 0
    assert [run.final["theta"], run.final["theta_dot"]] == pytest.approx(own, rel=1e-6)


@pytest.mark.parametrize(("factor", "lifts"), [(0.999, False), (1.001, True)])
def test_an_eccentric_block_lifts_where_its_lever_arm_ends(factor, lifts):
    block = rk.HeldBlock(**SIZE, centroid_offset=0.05)
    # the ground accelerates to the left: the block leans to the right, about the nearer foot
    threshold = 9.81 * (0.25 - 0.05) / 0.9
    push = rk.GroundMotion.constant(acceleration=-factor * threshold, duration=0.2)
    run = rk.simulate(block, push)
    assert (abs(run["theta"]).max() > 0.0) == lifts


def test_putty_holds_until_its_force_is_reached():
    def under(force):
        putty = rk.Anchor.pair(stiffness=1e6, breaks_at=rk.Break(force=force))
        return rk.simulate(rk.HeldBlock(**SIZE, restraint=putty), PULSE)

    free = rk.simulate(rk.HeldBlock(**SIZE), PULSE)
    weak, strong = under(100.0), under(300.0)
    assert [*weak.ties] == ["anchor_left", "anchor_right"]
    assert min(record.broke_at for record in weak.ties.values()) > free.events.times[0]
    assert [record.largest_force for record in weak.ties.values()] == pytest.approx([100.0] * 2)
    assert [record.broke_at for record in strong.ties.values()] == [None, None]
    assert abs(strong["theta"]).max() < abs(free["theta"]).max()


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"corner_radius": 0.25}, "give less than half of the width, 0.25 m"),
        ({"centroid_offset": 0.25}, "give a place between the feet"),
        ({"corner_radius": 0.02, "base_radius": 2.0}, "a round base has no corners"),
        ({"restraint": 3}, "restraint is 3"),
        ({"restitution": 1.5}, "restitution"),
    ],
)
def test_a_block_that_cannot_be_is_refused(values, words):
    assert words in told(rk.HeldBlock, **(SIZE | values))


PUSHES = {"constant": 1.0, "half sine": 2 / np.pi, "falling": 0.5, "gust": 0.5}


@pytest.mark.parametrize("shape", PUSHES)
def test_a_push_of_time_has_its_impulse(shape):
    """The block slides without friction: its speed is the impulse over its mass."""
    push = rk.Push(at=(0.0, 0.9), force=-90.0, duration=0.3, start=0.2, shape=shape)
    block = rk.HeldBlock(**(SIZE | {"friction": 0.0}), loads=push)
    run = rk.simulate(block, rk.GroundMotion.none(1.0), options=FINE)
    switches = [event.time for event in run.events if event.contact == "push"]
    assert switches == pytest.approx([0.2, 0.5], abs=1e-8)
    assert run.final["x_dot"] == pytest.approx(-90.0 * 0.3 * PUSHES[shape] / 300.0, rel=1e-9)
    assert run.energy_balance().error < 1e-10


@pytest.mark.parametrize("until", [0.1, 0.2, 0.3, 0.5])
def test_a_push_goes_on_where_a_motion_continues(until):
    push = rk.Push(at=(0.0, 0.9), force=-90.0, duration=0.3, start=0.2, shape="constant")
    block = rk.HeldBlock(**(SIZE | {"friction": 0.0}), loads=push)
    first = rk.simulate(block, rk.GroundMotion.none(until))
    rest = rk.simulate(block, rk.GroundMotion.none(1.0 - until), initial=first.final)
    assert rest.final["x_dot"] == pytest.approx(-90.0 * 0.3 / 300.0, rel=1e-9)


def test_a_mode_in_which_a_push_acts_before_its_time_is_refused():
    push = rk.Push(at=(0.0, 0.9), force=-90.0, duration=0.3, start=0.2, shape="constant")
    block = rk.HeldBlock(**(SIZE | {"friction": 0.0}), loads=push)
    mode = "both_slides_left_push_acts"
    said = told(rk.simulate, block, rk.GroundMotion.none(0.1), mode=mode)
    assert "contradicts push_time = 0: leave the mode out" in said
    rk.simulate(block, rk.GroundMotion.none(0.1), mode=mode, initial={"push_time": 0.3})


def test_a_push_needs_friction_at_the_feet():
    push = rk.Push(at=(0.0, 0.3), force=500.0, duration=0.4, shape="falling")
    run = rk.simulate(rk.HeldBlock(**SIZE, loads=push), rk.GroundMotion.none(1.0))
    assert run.support.friction_demand == pytest.approx(500.0 / (300.0 * 9.81), rel=1e-6)
    again = rk.simulate(run.structure, rk.GroundMotion.none(0.1), initial=run.final)
    assert again["push_force"].max() == 0.0  # its time goes on


def test_a_strap_takes_from_the_friction_at_the_feet():
    strap = rk.Strap(at=(0.25, 1.6), to=(0.6, 1.6), stiffness=1e5, pretension=100.0)
    block = rk.HeldBlock(**SIZE, restraint=strap)
    run = rk.simulate(block, rk.GroundMotion.none(0.1))
    assert run.support.friction_demand == pytest.approx(100.0 / (300.0 * 9.81), rel=1e-6)


def test_a_round_base_rolls_with_the_period_of_its_closed_form():
    """Small rocking about upright: T = 2 pi sqrt((I + m h^2)/(m g (R - h)))."""
    h, radius = 0.4, 1.0
    block = rk.HeldBlock(**(SIZE | {"height": 2 * h}), base_radius=radius)
    inertia = block.parameters()["inertia"] + 300.0 * h**2
    period = 2 * np.pi * np.sqrt(inertia / (300.0 * 9.81 * (radius - h)))
    start = {"theta": 1e-4}
    run = rk.simulate(block, rk.GroundMotion.none(period), initial=start, options=FINE)
    assert run.final["theta"] == pytest.approx(1e-4, rel=1e-6)
    assert run.at(period / 2)["theta"] == pytest.approx(-1e-4, rel=1e-6)


def centroid_velocity(state):
    """Of a block whose base has its middle at x, y: velocity (across, up) of the centroid."""
    c, s = 0.9 * np.cos(state["theta"]), 0.9 * np.sin(state["theta"])
    return state["x_dot"] + c * state["theta_dot"], state["y_dot"] - s * state["theta_dot"]


def corner_speed(state):
    """Speed of the upper right corner towards the wall."""
    up = 1.8 * np.cos(state["theta"]) - 0.25 * np.sin(state["theta"])
    return state["x_dot"] + up * state["theta_dot"]


def test_a_block_that_leans_strikes_the_wall_with_its_upper_corner():
    block = rk.HeldBlock(**SIZE, wall_gap=0.1, wall_restitution=0.3)
    start = {"theta": 0.02, "theta_dot": 0.8}
    run = rk.simulate(block, rk.GroundMotion.none(0.3), initial=start, options=FINE)
    assert not any("beyond the wall" in hint for hint in run.hints)
    first = next(event for event in run.events if event.kind == "landing")
    assert first.contact == "wall"
    theta, x = first.before["theta"], first.before["x"]
    y = first.before["y"]
    assert x + 0.25 * np.cos(theta) + 1.8 * np.sin(theta) == pytest.approx(0.35, abs=1e-9)
    assert y == pytest.approx(0.25 * np.sin(theta), abs=1e-9)
    # a smooth impulse on a free body: the foot, which it lifts, takes none
    arm = 0.9 * np.cos(theta) - 0.25 * np.sin(theta)  # height of the corner above the centroid
    inertia = 300.0 * (0.5**2 + 1.8**2) / 12
    impulse = 1.3 * corner_speed(first.before) / (1 / 300.0 + arm**2 / inertia)
    assert corner_speed(first.after) == pytest.approx(-0.3 * corner_speed(first.before))
    spin = first.before["theta_dot"] - impulse * arm / inertia
    assert first.after["theta_dot"] == pytest.approx(spin, rel=1e-9)
    across, up = centroid_velocity(first.before)
    assert centroid_velocity(first.after) == pytest.approx((across - impulse / 300.0, up))
    # the ground cannot pull: the foot leaves it, and the block is struck as a free body
    mass, inertia = (run.structure.parameters()[name] for name in ("mass", "inertia"))
    arm = 1.8 * np.cos(theta) - 0.25 * np.sin(theta)
    arm -= 0.9 * np.cos(theta)  # of the corner above the centroid
    centroid = first.before["x_dot"] + 0.9 * np.cos(theta) * first.before["theta_dot"]
    corner = centroid + arm * first.before["theta_dot"]
    impulse = 1.3 * corner / (1 / mass + arm**2 / inertia)
    own = first.before["theta_dot"] - impulse * arm / inertia
    assert first.after["theta_dot"] == pytest.approx(own, rel=1e-9)
    assert first.mode_after == "flight"


def test_a_lower_corner_beyond_the_wall_is_told():
    block = rk.HeldBlock(**(SIZE | {"friction": 0.0}), wall_gap=0.05)
    run = rk.simulate(block, rk.GroundMotion.none(0.07), initial={"x_dot": 1.0, "theta": -0.02})
    beyond = (run["x"] + 0.25 * np.cos(run["theta"])).max() - 0.3
    (hint,) = (hint for hint in run.hints if "beyond the wall" in hint)
    assert f"up to {1e3 * beyond:.3g} mm beyond the wall" in hint


def test_a_round_base_that_slides_says_so():
    block = rk.HeldBlock(**(SIZE | {"friction": 0.05}), base_radius=1.0)
    run = rk.simulate(block, PULSE)
    assert run.support.friction_demand == pytest.approx(0.05)
    assert "It slid for" in run.summary()
