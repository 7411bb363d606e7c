"""The block that slides, rocks, bounces and flies: closed forms, and the reference by hand."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from scipy.optimize import brentq

import rockeom as rk
from rockeom.simulation.events import Event
from tests.exact import FreeBlock

from . import closed_forms as exact
from .cases import ALPHA, LEANING, SHAKEN, P, leaning, leaning_motion
from .reference import Block, UndecidedError, followers, held, landings, one

G = 9.81
SIZES = st.floats(0.1, 3.0)
STILL = rk.GroundMotion.none(2.0)


def structure(block: Block) -> rk.Structure:
    return rk.SlidingBlock(
        half_width=block.b, half_height=block.h, friction=block.friction,
        restitution=block.restitution, mass=block.mass, inertia=block.about_centre,
        gravity=block.gravity,
    )  # fmt: skip


def times(run: rk.Response, kind: str) -> list[float]:
    return [e.time for e in run.events if e.kind == kind]


# -- the start from rest --------------------------------------------------------------------


def started(block: Block, across: float, up: float) -> tuple[str, dict[str, float]]:
    """The mode that follows at once, and the accelerations there."""
    run = rk.simulate(
        structure(block),
        rk.GroundMotion.constant(across, 1e-6),
        vertical=rk.GroundMotion.constant(up, 1e-6),
    )
    mode = run.mode[-1]
    return mode, structure(block).accelerations({}, across, up, mode=mode)


def assert_starts_as_by_hand(b, h, mu, a, up):
    for side in (1.0, -1.0):
        _, found = started(Block(b, h, mu), side * a, up)
        by_hand = exact.start(a, G + up, b, h, mu)
        expected = np.array([side * by_hand.x, by_hand.y, side * by_hand.theta])
        scale = max(1.0, np.abs(expected).max())
        np.testing.assert_allclose(
            [found["x"], found["y"], found["theta"]], expected, atol=1e-12 * scale,
            err_msg=by_hand.motion,
        )  # fmt: skip


@settings(max_examples=40)
@given(b=SIZES, h=SIZES, mu=st.floats(0.02, 1.2), a=st.floats(0.0, 40.0), up=st.floats(-5.0, 5.0))
def test_a_block_at_rest_starts_as_by_hand(b, h, mu, a, up):
    g = G + up
    assume(abs(a - mu * g) > 1e-6 and abs(a - b / h * g) > 1e-6)
    assume(abs(mu - exact.critical_friction(a, g, b, h)) > 1e-6 and abs(mu - b / h) > 1e-6)
    assert_starts_as_by_hand(b, h, mu, a, up)


@pytest.mark.parametrize(
    ("b", "h", "mu", "a", "what"),
    [
        (0.4, 1.0, 0.7, 0.399 * G, "rest"),
        (0.4, 1.0, 0.3, 0.299 * G, "rest"),
        (0.4, 1.0, 0.3, 0.301 * G, "slide"),
        (0.4, 1.0, 0.399, 3.0 * G, "slide"),
        (0.4, 1.0, 0.401, 0.405 * G, "slide-rock"),
        (0.4, 1.0, 0.7, 0.401 * G, "rock"),
        (0.4, 1.0, 0.7, 3.0 * G, "slide-rock"),
    ],
)
def test_each_start_is_met(b, h, mu, a, what):
    assert exact.start(a, G, b, h, mu).motion == what
    assert_starts_as_by_hand(b, h, mu, a, 0.0)


@pytest.mark.parametrize("a", [4.5, 8.0, 30.0])
def test_a_block_rocks_from_the_critical_friction_on(a):
    b, h = 0.4, 1.0
    critical = exact.critical_friction(a, G, b, h)
    for mu, slides in ((critical - 1e-7, True), (critical + 1e-7, False)):
        block = Block(b, h, mu)
        _, found = started(block, a, 0.0)
        # the left foot, about which it turns: x - b cos, slips to the left if at all
        assert (found["x"] < -1e-9) == slides
        assert found["theta"] < 0


def test_a_slide_rock_presses_with_what_was_found_by_hand():
    b, h, mu, a = 0.4, 1.0, 0.6, 15.0
    block = Block(b, h, mu, mass=3.0)
    by_hand = exact.start(a, G, b, h, mu)
    assert by_hand.motion == "slide-rock"
    mode, _ = started(block, a, 0.0)
    forces = structure(block).reactions({}, a, mode=mode)
    assert forces["left_reaction"] == pytest.approx(3.0 * by_hand.normal, rel=1e-12)
    assert forces["left_friction"] == pytest.approx(3.0 * by_hand.friction, rel=1e-12)
    assert forces["right_reaction"] == pytest.approx(0.0, abs=1e-12)
    assert forces["horizontal_reaction"] == pytest.approx(3.0 * by_hand.friction, rel=1e-12)


# -- sliding flat ---------------------------------------------------------------------------

FLAT = Block(0.4, 0.5, 0.2)


def test_a_half_sine_slips_a_block_once_by_what_was_found_by_hand():
    grip, period = FLAT.friction * G, 0.8
    omega, amplitude = 2 * math.pi / 0.8, 2.5 * grip
    begins = math.asin(1 / 2.5) / omega
    pulse = period / 2
    # x'' = -a(t) + mu g, from rest, until the slip rate is zero
    rate = amplitude / omega * (-1 - math.cos(omega * begins)) + grip * (pulse - begins)
    ends = pulse - rate / grip
    slip = (
        -amplitude / omega**2 * math.sin(omega * begins)
        - amplitude / omega * math.cos(omega * begins) * (pulse - begins)
        + 0.5 * grip * (pulse - begins) ** 2
        - 0.5 * rate**2 / grip
    )
    motion = rk.GroundMotion.half_sine(amplitude, period, duration=3.0)
    for side in (1.0, -1.0):
        run = rk.simulate(structure(FLAT), motion.scaled(acceleration=side))
        assert [e.kind for e in run.events] == ["slip begins", "slip ends"]
        assert {e.contact for e in run.events} == {"left+right"}
        np.testing.assert_allclose([e.time for e in run.events], [begins, ends], atol=1e-9)
        assert run.final["x"] == pytest.approx(side * slip, abs=1e-9)
        assert run["left_slip"][-1] - run["left_slip"][0] == pytest.approx(side * slip, abs=1e-9)
        assert str(run.outcome) == "came to rest"
        assert not run["theta"].any()


@pytest.mark.parametrize("more", [0.999, 1.001])
def test_a_sine_lets_a_block_stick_in_every_half_cycle_up_to_a_limit(more):
    grip, period, cycles = FLAT.friction * G, 0.5, 6
    amplitude = more * grip * math.sqrt(1 + math.pi**2 / 4)
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=cycles * period)
    run = rk.simulate(structure(FLAT), motion)
    omega, first = 2 * math.pi / period, times(run, "slip begins")[0]
    assert first == pytest.approx(math.asin(grip / amplitude) / omega, abs=1e-9)
    sticks = (run.mode == run.mode[0]) & (run.t > first + 1e-9)
    if more > 1:
        assert not sticks.any()
        return

    def rate(t):
        gained = amplitude / omega * (math.cos(omega * t) - math.cos(omega * first))
        return gained + grip * (t - first)

    stops = brentq(rate, period / 4, period, xtol=1e-15)
    halves = np.arange(2 * cycles) * period / 2
    begins, ends = times(run, "slip begins"), times(run, "slip ends")
    np.testing.assert_allclose(begins, first + halves, atol=1e-9)
    kept = stops + halves < cycles * period
    np.testing.assert_allclose(ends[: kept.sum()], (stops + halves)[kept], atol=1e-9)


def test_feet_under_a_sliding_block_share_its_weight_as_by_hand():
    run = rk.simulate(structure(FLAT), STILL, initial={"x_dot": 3.0}, duration=0.1)
    arm = FLAT.friction * FLAT.h / FLAT.b
    left, right = run["left_reaction"], run["right_reaction"]
    np.testing.assert_allclose(right / left, (1 + arm) / (1 - arm), rtol=1e-12)
    np.testing.assert_allclose(left + right, G, rtol=1e-12)
    np.testing.assert_allclose(run["left_friction"], -FLAT.friction * left, rtol=1e-12)
    np.testing.assert_allclose(run["horizontal_reaction"], -FLAT.friction * G, rtol=1e-12)


# -- flight and bounces ---------------------------------------------------------------------


def test_a_flight_is_the_parabola_of_the_mass_centre():
    block = Block(0.3, 0.8, 0.5)
    start = {"x": 0.1, "y": 1.0, "theta": 0.2, "x_dot": 0.7, "y_dot": 2.5, "theta_dot": 1.2}
    place = block.at(**start).parts.masses[0].centre
    q, v = place.value[0], place.jacobian[0] @ [0.7, 2.5, 1.2]

    def centre(t):
        t = np.asarray(t)
        return q[0] + v[0] * t, q[1] + v[1] * t - 0.5 * G * t * t, 0.2 + 1.2 * t

    def gap(t):
        _, y, theta = centre(t)
        return y - block.h * np.cos(theta) - block.b * abs(np.sin(theta))

    lands = brentq(gap, 0.3, 1.2, xtol=1e-15)
    run = rk.simulate(structure(block), STILL, initial=start, duration=1.5)
    assert times(run, "landing")[0] == pytest.approx(lands, abs=1e-10)
    t = np.linspace(0.0, 0.999 * lands, 50)
    at, (x, y, theta) = run.at(t), centre(t)
    np.testing.assert_allclose(at["theta"], theta, atol=1e-12)
    np.testing.assert_allclose(at["x"], x - block.h * np.sin(theta), atol=1e-10)
    np.testing.assert_allclose(at["y"], y - block.h * np.cos(theta), atol=1e-10)
    lifts = run.at(t, names=["left_uplift", "right_uplift", "left_reaction", "right_friction"])
    np.testing.assert_allclose(lifts["right_uplift"], gap(t), atol=1e-10)
    np.testing.assert_array_equal(lifts["left_reaction"], 0.0)
    np.testing.assert_array_equal(lifts["right_friction"], 0.0)


def test_a_flat_block_bounces_to_its_end_and_slides_on_as_by_hand():
    e, mu, fall, along = 0.6, 0.1, 0.5, 2.0
    block = Block(0.4, 0.5, mu, restitution=e)
    speed, lands = math.sqrt(2 * G * fall), math.sqrt(2 * fall / G)
    n = np.arange(8)
    landings = lands + 2 * speed / G * e * (1 - e**n) / (1 - e)
    over = lands + 2 * speed / G * e / (1 - e)
    # each impact takes mu (1 + e) v; between them the block flies on at a constant rate
    lost = mu * (1 + e) * speed / (1 - e)
    stops = over + (along - lost) / (mu * G)
    infinite = np.arange(400)
    rates = along - mu * (1 + e) * speed * (1 - e ** (infinite + 1)) / (1 - e)
    slip = along * lands + np.sum(rates * 2 * speed / G * e ** (infinite + 1))
    slip += 0.5 * (along - lost) ** 2 / (mu * G)
    for side in (1.0, -1.0):
        start = {"y": fall, "x_dot": side * along}
        run = rk.simulate(structure(block), STILL, initial=start, duration=stops + 0.3)
        first = next(event for event in run.events if event.kind == "landing")
        assert first.contact == "left+right"
        assert first.after["y_dot"] == pytest.approx(e * speed, rel=1e-10)
        assert first.after["x_dot"] == pytest.approx(
            side * (along - mu * (1 + e) * speed), rel=1e-10
        )
        np.testing.assert_allclose(times(run, "landing")[:8], landings, atol=1e-9)
        assert np.abs(run["theta"]).max() < 1e-12
        rises = run["y"]
        assert rises[run.t > over + 1e-5].max() < 1e-12
        assert rises[(run.t > over - 1e-2) & (run.t < over)].max() > 1e-6
        assert times(run, "slip ends")[-1] == pytest.approx(stops, abs=1e-8)
        assert run.final["x"] == pytest.approx(side * slip, abs=1e-8)


def test_a_flat_block_that_lands_on_rough_ground_turns():
    block = Block(0.5, 0.8, 0.7, restitution=0.4)
    run = rk.simulate(structure(block), STILL, initial={"y": 0.2, "x_dot": 5.0}, duration=0.25)
    first = next(event for event in run.events if event.kind == "landing")
    assert first.after["theta_dot"] > 0.1
    assert_lands_as_the_reference(block, first)


# -- a corner lands -------------------------------------------------------------------------


def assert_lands_as_the_reference(block: Block, event: Event) -> None:
    at = block.at(**event.before)
    after = np.concatenate([at.states.q[0], one(landings(at)).motion])
    scale = max(abs(value) for value in event.before.values())
    np.testing.assert_allclose(list(event.after.values()), after, rtol=1e-6, atol=1e-8 * scale)


@pytest.mark.parametrize("alpha", [0.15, 0.25, 0.4])
@pytest.mark.parametrize("e", [0.0, 0.3])
@pytest.mark.parametrize("more", [0.5, 0.999, 1.001, 3.0])
def test_a_corner_lands_as_by_hand(alpha, e, more):
    """The old corner sticks until then: it turns so fast that it hardly needs friction."""
    mu = more * exact.sticking_friction(alpha)
    block = Block(math.sin(alpha), math.cos(alpha), mu, e)
    rate = math.sqrt(0.75 * G * math.cos(alpha))
    for side in (1.0, -1.0):
        start = {"theta": side * 1e-3, "theta_dot": -side * rate}
        run = rk.simulate(structure(block), STILL, initial=start, duration=0.01)
        event = next(event for event in run.events if event.kind == "landing")
        assert event.contact == ("left" if side > 0 else "right")
        assert event.before["x_dot"] == pytest.approx(0.0, abs=1e-10)
        ratio = event.after["theta_dot"] / event.before["theta_dot"]
        assert ratio == pytest.approx(exact.landing_ratio(alpha, mu, e), rel=1e-9)
        # at theta = 0 the foot that landed slips as the base's centre does
        assert (abs(event.after["x_dot"]) < 1e-10) == (more > 1)


@settings(max_examples=40)
@given(
    b=SIZES, h=SIZES, mu=st.floats(0.0, 1.3), e=st.sampled_from([0.0, 0.0, 0.5]),
    mass=st.floats(0.1, 10.0), rounder=st.floats(0.3, 3.0), theta=st.floats(-1.0, 1.0),
    along=st.floats(-2, 2), up=st.floats(-2, 1), rate=st.floats(-2, 2),
)  # fmt: skip
def test_every_landing_is_that_of_the_reference_and_without_restitution_gains_no_energy(
    b, h, mu, e, mass, rounder, theta, along, up, rate
):
    inertia = rounder * mass * (b * b + h * h) / 3
    block = Block(b, h, mu, e, mass=mass, inertia=inertia)
    y = 0.05 + b * abs(math.sin(theta))
    start = {"theta": theta, "y": y, "x_dot": along, "y_dot": up, "theta_dot": rate}
    run = rk.simulate(structure(block), STILL, initial=start, duration=0.6)
    seen = 0
    for event in [event for event in run.events if event.kind == "landing"][:20]:
        at = block.at(**event.before)
        gap, rates = at.gaps[0], at.rates[0, :, 1]
        if e == 0.0:
            assert block.at(**event.after).kinetic()[0] <= at.kinetic()[0] * (1 + 1e-12)
        # a corner 7e-12 m above the ground lands a moment later
        clear = np.all((np.abs(gap) < 1e-12) | (gap > 1e-6))
        if clear and rates[np.abs(gap) < 1e-12].min() < -1e-3:
            seen += 1
            try:
                assert_lands_as_the_reference(block, event)
            except UndecidedError:
                continue
    assume(seen)


# -- whole motions --------------------------------------------------------------------------


@pytest.fixture(scope="module")
def leaning_run():
    return rk.simulate(structure(leaning()), STILL, initial={"theta": LEANING}, duration=4.5)


def test_a_leaning_block_slides_and_rocks_as_the_reference(leaning_run):
    run, reference = leaning_run, leaning_motion()
    landings = reference.times("landing")[:6]
    np.testing.assert_allclose(times(run, "landing")[:6], landings, atol=1e-8)
    np.testing.assert_allclose(landings[:2], [1.0702656, 2.2916414], atol=5e-8)
    for kind, published in (
        ("slip begins", [0.9681553, 2.1685834]),
        ("slip ends", [1.3452220, 2.6924774]),
    ):
        found = [e.time for e in run.events if e.kind == kind and e.time < 2.9]
        np.testing.assert_allclose(found, published, atol=5e-8)
        np.testing.assert_allclose(found, reference.times(kind)[:2], atol=1e-9)


def test_a_landing_that_sticks_and_slips_at_once_is_one_event(leaning_run):
    near = [e for e in leaning_run.events if abs(e.time - 2.2916414) < 1e-6]
    assert "landing" in {e.kind for e in near}
    assert not {"slip begins", "slip ends"} & {e.kind for e in near}


def test_a_leaning_block_comes_to_rest_where_the_reference_does(leaning_run):
    run, block = leaning_run, leaning()
    assert str(run.outcome) == "came to rest"
    assert run.events.rest_time == pytest.approx(4.0119, abs=1e-4)
    # from where its centre was when it stood upright on the same foot
    slip = run.final["x"] - run["x"][0] + block.b * (1 - math.cos(LEANING))
    assert slip == pytest.approx(-0.04592, abs=5e-6)


def test_forces_and_slips_are_those_of_the_reference(leaning_run):
    run, reference = leaning_run, leaning_motion()
    shift = run["x"][0]  # the reference starts with the base's centre at 0
    for t in (0.3, 1.0, 1.2, 1.5, 2.25, 2.5, 3.0):
        pattern, state = reference.at(t)
        forces, gap = held(state, pattern), state.gaps[0]
        at = {name: float(value) for name, value in run.at(t, names=run.names).items()}
        base = reference.named(t)
        for name in ("y", "theta", "x_dot", "y_dot", "theta_dot"):
            assert at[name] == pytest.approx(base[name], abs=1e-7), name
        assert at["x"] - shift == pytest.approx(base["x"], abs=1e-7)
        for i, foot in enumerate(("left", "right")):
            assert at[f"{foot}_uplift"] == pytest.approx(gap[i], abs=1e-7)
            assert at[f"{foot}_reaction"] == pytest.approx(forces.normal[i], abs=1e-6)
            assert at[f"{foot}_friction"] == pytest.approx(forces.friction[i], abs=1e-6)
        assert at["horizontal_reaction"] == pytest.approx(forces.friction.sum(), abs=1e-6)


def test_energy_falls_by_the_work_of_friction_and_at_landings_alone(leaning_run):
    total = leaning_run["total_energy"]
    assert np.diff(total).max() < 1e-9 * total[0]
    stuck = leaning_run.t < 0.968
    np.testing.assert_allclose(total[stuck], total[0], rtol=1e-9)


def test_the_other_foot_gives_the_mirrored_motion(leaning_run):
    image = rk.simulate(structure(leaning()), STILL, initial={"theta": -LEANING}, duration=4.5)
    np.testing.assert_array_equal(image.t, leaning_run.t)
    np.testing.assert_array_equal(image["theta"], -leaning_run["theta"])
    np.testing.assert_array_equal(image["x"], -leaning_run["x"])
    np.testing.assert_array_equal(image["y"], leaning_run["y"])


def test_with_much_friction_it_is_the_pinned_block():
    run = rk.simulate(structure(leaning(5.0)), STILL, initial={"theta": LEANING}, duration=5.2)
    pinned, peak, t, landings = FreeBlock(P, ALPHA), LEANING, 0.0, []
    for _ in range(5):
        t += pinned.quarter(peak)
        landings.append(t)
        ratio = 1 - 1.5 * math.sin(ALPHA) ** 2
        peak = pinned.peak(ratio**2 * pinned.impact_energy(peak))
        t += pinned.quarter(peak)
    np.testing.assert_allclose(times(run, "landing")[:5], landings, atol=1e-8)
    assert not times(run, "slip begins")


@pytest.mark.parametrize("name", SHAKEN)
def test_a_shaken_block_moves_as_the_reference(name):
    case = SHAKEN[name]
    block, reference = case.block, case.motion
    across, up = (
        rk.GroundMotion.single_sine(amplitude, period, duration=2.0)
        for amplitude, period in (case.across, case.up)
    )
    run = rk.simulate(structure(block), across, vertical=up, duration=case.end)
    found = {kind: times(run, kind)[:2] for kind in ("landing", "lifting", "slip begins")}
    assert reference.times("landing")
    for kind in ("landing", "slip begins"):
        np.testing.assert_allclose(found[kind], reference.times(kind)[:2], atol=1e-7)
    for t in np.linspace(0.05, 1.0, 12) * case.end:
        at = run.at(t)
        for state, value in reference.named(t).items():
            # where infinitely many bounces end, the reference is the coarser one
            assert float(at[state]) == pytest.approx(value, abs=2e-5), (state, t)


# -- no motion, or several ------------------------------------------------------------------


def test_painleve_a_flat_block_that_slides_over_rough_ground_has_no_motion():
    b, h = 0.5, 1.0
    bound = exact.painleve_friction(b, h)
    for side in (1.0, -1.0):
        rough, tripping = (
            rk.simulate(structure(Block(b, h, mu)), STILL, initial={"x_dot": side}, duration=0.01)
            for mu in (bound + 0.01, bound - 0.01)
        )
        assert str(rough.outcome) == "no solution"
        assert rough.t[-1] == pytest.approx(0.0, abs=1e-12)
        assert str(tripping.outcome) == "completed"
        assert side * tripping.final["theta"] > 0


@pytest.mark.parametrize("width", [0.25, 0.5, 1.0, 2.0])
def test_painleve_takes_a_friction_of_four_thirds_whatever_the_block(width):
    """At a foot from which the line to the centroid leans by atan(1/2): 1 + 4 t**2 = 3 mu t."""
    way = math.copysign(1.0, width - 0.7)  # to where the line leans so, and that of the slip
    sliding = {"theta": math.atan(width) - way * math.atan(0.5), "x_dot": way}
    size = {"half_width": 0.4 * width, "half_height": 0.4, "restitution": 0.0}
    rk.SlidingBlock(**size, friction=1.33).accelerations(sliding)
    with pytest.raises(ValueError, match=r"no mode .* jam"):
        rk.SlidingBlock(**size, friction=1.34).accelerations(sliding)


def test_a_landing_that_slips_all_through_its_impact_has_slid():
    block = rk.SlidingBlock(half_width=0.2, half_height=0.6, friction=0.3, restitution=0.5)
    run = rk.simulate(block, rk.GroundMotion.none(0.12), initial={"y": 0.05, "x_dot": 3.0})
    assert len(run.impacts) >= 1
    assert not len(run.support.sliding)
    assert "It slid in impacts alone: impulses reached the friction at left+right." in run.summary()
    sticks = rk.simulate(block, rk.GroundMotion.none(0.12), initial={"y": 0.05})
    assert "It did not slide" in sticks.summary()


def test_painleve_a_block_that_slides_and_turns_fast_has_two_motions():
    block = Block(0.5, 1.0, 1.5)
    for side in (1.0, -1.0):
        start = {"theta": side * 0.1, "theta_dot": side * 4.0, "x_dot": side * 8.0}
        with pytest.raises(UndecidedError, match="several"):
            one(followers(block.at(**start)))
        run = rk.simulate(structure(block), STILL, initial=start, duration=0.1)
        assert str(run.outcome) == "several solutions"
        assert run.t[-1] == pytest.approx(0.0, abs=1e-12)


def test_a_landing_that_gains_energy_under_this_law_is_told():
    block = Block(1.1242, 0.6693, 0.8437, restitution=0.9, mass=2.0)
    start = {"theta": 0.3, "x_dot": -0.2027, "y_dot": -0.1845, "theta_dot": 0.3103}
    at = block.at(**start)
    gained = (at.kinetic(one(landings(at)).motion) - at.kinetic())[0]
    assert gained > 0.01
    start["y"] = block.b * math.sin(0.3) + 1e-9
    run = rk.simulate(structure(block), STILL, initial=start, duration=0.01)
    assert run.impacts.energy_gains[0] == pytest.approx(gained, rel=1e-6)
    assert "1 of 1 impacts gained kinetic energy" in run.summary()
    case = rk.Case(run.structure, STILL, initial=start, duration=0.01)
    sweep = rk.simulate_many(lambda row: case, over={"row": [0]})
    assert sweep.impact_gains.item() == 1
    assert sweep.impact_energy_gained.item() == pytest.approx(gained, rel=1e-6)


@pytest.mark.parametrize("slenderness", [1e-7, 1e-6, 1e-5, 1e-4, 1e-2])
def test_slender_block_rocks_as_on_pinned_feet(slenderness):
    """Its gaps are compared with their own terms: 1e-14 m is no rounding error of 1e-14 m."""
    start, still = {"theta": 0.5 * slenderness}, rk.GroundMotion.none(3.0)
    feet = rk.SlidingBlock(half_width=slenderness, half_height=1.0, friction=0.5, restitution=0.0)
    pinned = rk.RigidBlock(half_width=slenderness, half_height=1.0)
    on_feet, on_pins = (rk.simulate(block, still, initial=start) for block in (feet, pinned))
    assert len(on_feet.impacts) == len(on_pins.impacts) == 3
    np.testing.assert_allclose(on_feet.impacts.times, on_pins.impacts.times, rtol=1e-7)


@pytest.mark.parametrize("slenderness", [1e-8, 1e-10, 1e-16])
def test_feet_too_close_for_rounding_errors_are_told(slenderness):
    block = rk.SlidingBlock(half_width=slenderness, half_height=1.0, friction=0.5, restitution=0.0)
    run = rk.simulate(block, rk.GroundMotion.none(3.0), initial={"theta": 0.5 * slenderness})
    assert run.outcome is rk.Outcome.SEVERAL_SOLUTIONS
    assert "1e-7" in run.outcome.sentence


@pytest.mark.parametrize("tilt", [1e-15, 1e-12, 1e-9, 1e-6])
def test_no_tilt_of_an_ordinary_block_counts_as_standing(tilt):
    """It falls back as -b g t^2 / 2 about its foot: in sqrt(2 tilt I_o / (m g b))."""
    b, h = 0.2, 1.0
    block = rk.SlidingBlock(half_width=b, half_height=h, friction=0.5, restitution=0.0)
    run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"theta": tilt})
    falls = math.sqrt(2 * tilt * 4 / 3 * (b * b + h * h) / (block.gravity * b))
    assert run.impacts[0].time == pytest.approx(falls, rel=1e-5)
