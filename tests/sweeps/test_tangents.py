"""Derivatives carried through impacts, against what is found without any derivative.

Differences of tight integrations, extrapolated, are right to some 1e-12; closed forms to more.
"""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, example, given, settings, strategies as st

import rockeom as rk
from tests.differences import (
    TIGHT,
    Observed,
    OtherEventsError,
    differenced,
    run,
    size_of,
)
from tests.exact import slender_derivatives
from tests.sweeps.shaken_motions import MOTIONS, SLENDER, Shaken, shaken
from tests.typical import column

EVERY_MOTION = pytest.mark.parametrize("name", MOTIONS)


def tangents_of(motion, values, options=TIGHT):
    """With respect to all the numbers, one direction each, in their order."""
    return rk.tangents(motion(**rk.duals(**values)), options)


def between_events(response):
    """Times between the start, the events and the end, where these are not close together."""
    times = np.array([0.0, *(e.time for e in response.events), response.duration])
    far = np.diff(times) > 0.02 * response.duration
    return 0.5 * (times[1:] + times[:-1])[far]


def along(tangents, direction, times):
    """Derivatives of all that is observed along a direction (m,)."""
    t = tangents
    found = (t.event_times, t.before, t.after, t.end, t.at(times))
    return Observed(*(np.tensordot(part, direction, axes=(-1, 0)) for part in found))


def assert_same(found, reference, tolerance=1e-8):
    assert reference.error < tolerance, "the reference is not so good"
    for name, a, b in zip(Observed._fields, found, reference.derivative, strict=True):
        assert np.abs(a - b).max(initial=0.0) < tolerance * size_of(b), name


@EVERY_MOTION
def test_ten_impacts_by_every_number(name):
    """At the events and between them, by every parameter, the start, the law and the ground."""
    kind = MOTIONS[name]
    values = kind.until(10)
    found = tangents_of(kind.motion, values)
    times = between_events(found.response)
    for i, (number, value) in enumerate(values.items()):
        direction = np.zeros(len(values))
        direction[i] = value
        reference = differenced(kind.motion, values, {number: value}, times)
        assert_same(along(found, direction, times), reference)


@EVERY_MOTION
def test_the_motion_is_the_same_to_the_last_bit(name):
    kind = MOTIONS[name]
    values = kind.until(10)
    options = rk.SolverOptions()
    alone = run(kind.motion(**values), options)
    with_tangents = tangents_of(kind.motion, values, options).response
    assert with_tangents.events == alone.events
    np.testing.assert_array_equal(with_tangents.t, alone.t)
    np.testing.assert_array_equal(with_tangents.y, alone.y)
    assert with_tangents.end.tobytes() == alone.end.tobytes()


@settings(max_examples=15)
@given(st.data(), st.sampled_from(list(MOTIONS)), st.integers(1, 10))
def test_any_size_and_any_direction(data, name, impacts):
    """Numbers within a tenth of the typical ones, after one to ten impacts."""
    motion, typical = MOTIONS[name]
    factors = data.draw(st.lists(st.floats(0.9, 1.1), min_size=len(typical), max_size=len(typical)))
    sizes = {n: f * v for f, (n, v) in zip(factors, typical.items(), strict=True)}
    try:
        values = Shaken(motion, sizes).until(impacts)
    except LookupError:
        assume(False)
    parts = data.draw(st.lists(st.floats(-1.0, 1.0), min_size=len(values), max_size=len(values)))
    assume(any(abs(part) > 0.1 for part in parts))
    direction = np.array(parts) * list(values.values())
    found = tangents_of(motion, values)
    times = between_events(found.response)
    try:
        reference = differenced(motion, values, dict(zip(values, direction, strict=True)), times)
    except OtherEventsError:  # the order of events changes beside the motion
        assume(False)
    assume(reference.error < 1e-8)
    assert_same(along(found, direction, times), reference)


# -- what is known by hand ----------------------------------------------------------------------


@pytest.mark.parametrize("impacts", [1, 10])
def test_slender_block_to_twelve_digits(impacts):
    """Against the piecewise exact motion in forty digits, by all its numbers."""
    kind = SLENDER
    values = kind.until(impacts)
    found = tangents_of(kind.motion, values, TIGHT)
    exact = slender_derivatives(values, [i.time for i in found.response.impacts])
    for name, part in exact.items():
        mine = getattr(found, name)
        # relative to each number, as sizes are: derivatives by 0.05 and by 300 count alike
        error = np.abs(mine - part) * np.abs(list(values.values()))
        size = np.abs(part * list(values.values())).max()
        assert error.max() < 1e-12 * max(1.0, size), name


def saltations(tangents, rates_around):
    """(k, N, N): at each event what multiplies differences of states at a fixed time.

    At the passage, which moves by tau, a state differs by its rate times tau more.
    """
    t = tangents
    found = []
    for tau, before, after, (old, new) in zip(
        t.event_times, t.before, t.after, rates_around, strict=True
    ):
        left, right = before - np.outer(old, tau), after - np.outer(new, tau)
        found.append(right @ np.linalg.inv(left))
    return np.array(found)


def test_saltation_matrix_of_a_block():
    """[[e, 0], [(a+ - e a-)/v-, e]], the accelerations those of Housner's block upright."""
    b, h, g, e, amplitude, period = 0.1, 0.45, 9.81, 0.9, 0.6, 0.8
    values = MOTIONS["block"].until(5)
    start = rk.duals(theta=values["theta"], theta_dot=values["theta_dot"])
    found = rk.tangents(MOTIONS["block"].motion(**values | start), TIGHT)
    alpha, radius = np.arctan2(b, h), np.hypot(b, h)

    def acceleration(side, t):
        ground = amplitude * np.sin(2 * np.pi * t / period) / g
        return -0.75 * g / radius * (side * np.sin(alpha) + np.cos(alpha) * ground)

    expected, rates = [], []
    for impact in found.response.impacts:
        v = impact.before["theta_dot"]
        side = -np.sign(v)  # on which it leaned until now
        a, a_after = acceleration(side, impact.time), acceleration(-side, impact.time)
        rates.append(((v, a), (e * v, a_after)))
        expected.append([[e, 0.0], [(a_after - e * a) / v, e]])
    assert len(expected) == 5
    np.testing.assert_allclose(saltations(found, rates), expected, rtol=0, atol=1e-10)


ROUNDINGS = 50
"""Bound on the error of a determinant: so many roundings of the largest of its two products.

Each step rounds the products a d and b c of the tangents [[a, b], [c, d]] and keeps their
difference. Where these have grown, the error is that of the products, and what later impacts take
they take of both. Of 4,200 random motions the largest error was 6 roundings."""


@settings(max_examples=20)
@example("block", 4, 0.9, 0.82421875, 1.140625)  # the products are 3e6 times their difference
@given(
    st.sampled_from(["block", "lumped"]), st.integers(0, 10), st.floats(0.3, 0.9),
    st.floats(0.0, 1.0), st.floats(0.3, 2.0),
)  # fmt: skip
def test_what_impacts_leave_of_an_area_of_the_phase_plane(name, impacts, lean, amplitude, period):
    """Between impacts it is kept (Liouville); each leaves the part e of it twice, r once."""
    kind = MOTIONS[name]
    changes = {"theta": lean * 0.2, "amplitude": amplitude, "period": period}
    try:
        values = kind.until(impacts, **changes) if impacts else kind.values | changes
    except LookupError:
        assume(False)
    values.setdefault("duration", 0.05)
    start = rk.duals(theta=values["theta"], theta_dot=values["theta_dot"])
    found = rk.tangents(kind.motion(**values | start), TIGHT)
    speeds = [i.after["theta_dot"] / i.before["theta_dot"] for i in found.response.impacts]
    expected = np.prod(np.square(speeds))
    (a, b), (c, d) = np.abs(found.at(np.linspace(0.0, found.response.duration, 101))).T
    rounding = np.finfo(float).eps * (a * d + b * c).max()
    assert np.linalg.det(found.end) == pytest.approx(expected, rel=0, abs=ROUNDINGS * rounding)


def test_what_impacts_leave_of_a_volume_of_the_space_of_states():
    """Of a column without damping, in coordinates and momenta: an impact takes e of the rotation's
    rate, and of how fast it is passed. Momenta are M(q) q', and M is another for each foot."""
    e, start = 0.8, {"theta": 0.1, "u": 0.002, "theta_dot": 0.03, "u_dot": -0.02}
    structure = column(damping=0.0, stiffness=3e4)
    shaking = rk.GroundMotion.harmonic(0.6, period=0.8, duration=5.0)
    case = rk.Case(structure, shaking, rk.VelocityRatio(e), rk.duals(**start), 1.25)
    found = rk.tangents(case, TIGHT)
    impacts = found.response.impacts
    assert len(impacts) >= 3

    def inertia(mode, state):
        """Determinant of M, by the kinetic energy at rates of one coordinate and of both."""
        y, energy = np.array([state[n] for n in structure.states]), np.empty(3)

        def kinetic(theta_dot, u_dot):
            y[2:] = theta_dot, u_dot
            number = structure.module.MODES.index(mode)
            structure.module.energies(number, y, structure.vector, energy)
            return energy[0]

        one, other = kinetic(1.0, 0.0), kinetic(0.0, 1.0)
        return 4 * one * other - (kinetic(1.0, 1.0) - one - other) ** 2

    end = dict(zip(structure.states, found.response.end, strict=True))
    flights = [start, *(i.after for i in impacts)], [*(i.before for i in impacts), end]
    modes = [impacts[0].mode_before, *(i.mode_after for i in impacts)]
    expected = e ** (2 * len(impacts))
    for leaves, lands, mode in zip(*flights, modes, strict=True):
        expected *= inertia(mode, leaves) / inertia(mode, lands)
    assert np.linalg.det(found.end) == pytest.approx(expected, rel=1e-9)


def test_half_a_period_of_a_symmetric_orbit():
    """One impact in it, no damping: the map to the mirror image has the determinant e^2."""
    e, period = 0.8, 0.6
    block = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    shaking = rk.GroundMotion.harmonic(2.5, period=period, duration=100.0)

    def map_over(state, duration=0.5 * period):
        start = rk.duals(theta=state[0], theta_dot=state[1])
        case = rk.Case(block, shaking, rk.VelocityRatio(e), start, duration)
        return rk.tangents(case, TIGHT)

    state = np.array(map_over([0.1, 0.0], 40 * period).response.end)
    for _ in range(5):  # Newton's method for y(T/2) = -y(0)
        found = map_over(state)
        lacks = found.response.end + state
        state = state - np.linalg.solve(found.end + np.eye(2), lacks)
    assert np.abs(lacks).max() < 1e-12
    assert len(found.response.impacts) == 1
    assert np.linalg.det(-found.end) == pytest.approx(e**2, rel=1e-11)


@pytest.mark.parametrize(
    "options",
    [
        rk.SolverOptions(method="Radau", rtol=1e-10, atol=1e-13),
        rk.SolverOptions(steps_per_segment=40),
    ],
    ids=["Radau", "equal steps"],
)
def test_whatever_the_steps(options):
    """The motion's derivatives are those of its steps, as accurate as they are."""
    values = SLENDER.until(5)
    found = tangents_of(SLENDER.motion, values, options)
    exact = slender_derivatives(values, [i.time for i in found.response.impacts])
    for name, part in exact.items():
        error = np.abs(getattr(found, name) - part) * list(values.values())
        assert error.max() < 1e-6, name


def test_column_that_does_not_move_would_vibrate():
    """Nothing errs in steps of any length while nothing moves; yet a small push would be felt."""
    structure = column(damping=0.0)
    case = rk.Case(structure, rk.GroundMotion.none(3.0), initial=rk.duals(u=0.0, u_dot=0.0))
    found = rk.tangents(case)
    assert found.response.steps.span[:, 1].max() > 0.1
    times = np.linspace(0.0, 3.0, 7)
    omega = np.sqrt(structure.stiffness / structure.mass)
    cosine, sine = np.cos(omega * times), np.sin(omega * times)
    expected = np.array([[cosine, sine / omega], [-omega * sine, cosine]])
    place = [structure.states.index(name) for name in ("u", "u_dot")]
    mine = np.moveaxis(found.at(times)[:, place], 0, -1)
    np.testing.assert_allclose(mine, expected, rtol=0, atol=1e-8 * omega)


# -- events that are no impacts at speed ---------------------------------------------------------


def assert_as_differences(motion, values, names=()):
    """All that is told of a motion, by some of its numbers (by all if none is named)."""
    names = names or tuple(values)
    found = rk.tangents(motion(**values | rk.duals(**{n: values[n] for n in names})), TIGHT)
    assert not found.grazing
    times = between_events(found.response)
    for direction, name in zip(np.eye(len(names)), names, strict=True):
        size = values[name] or 1.0
        reference = differenced(motion, values, {name: size}, times)
        assert_same(along(found, size * direction, times), reference)
    return found


def test_rest_of_a_slender_block_released():
    """When infinitely many impacts are over, by the release and the loss: their sum is known."""
    alpha, p = 0.2, 2.0

    def motion(peak, e):
        block = rk.SlenderBlock.from_frequency(p=p, alpha=alpha, gravity=9.81)
        still = rk.GroundMotion.none(20.0)
        return rk.Case(block, still, impact=rk.VelocityRatio(e), initial={"theta": peak})

    values = {"peak": 0.08, "e": 0.8}
    found = rk.tangents(motion(**rk.duals(**values)), TIGHT)
    rest = found.response.events[-1]
    assert rest.kind == "rest"

    def rest_time(peak, e):
        """Quarter periods 2-5, two of each hop; the energy of each is e^2 that of the last."""
        total, lean = mp.mpf(0), 1 - peak / mp.mpf(alpha)
        for hop in range(400):
            total += (2 if hop else 1) * mp.acosh(1 / lean) / p
            lean = mp.sqrt(1 - (1 - lean**2) * e**2)
        return total

    with mp.workdps(40):
        exact = {n: mp.mpf(v) for n, v in values.items()}
        assert rest.time == pytest.approx(float(rest_time(**exact)), rel=1e-12)
        by = [
            mp.diff(lambda x, name=name: rest_time(**exact | {name: x}), value)
            for name, value in exact.items()
        ]
    np.testing.assert_allclose(found.event_times[-1], np.array(by, float), rtol=1e-10)
    assert not found.end.any()  # it stands


def test_rest_of_a_shaken_structure_whose_mass_swings_on():
    """Impacts of a flexible structure fade to full contact, where its mass still moves."""

    def motion(theta, u, e, amplitude, stiffness, half_width, duration):
        sizes = {"stiffness": stiffness, "half_width": half_width}
        return shaken(
            column(**sizes), rk.VelocityRatio(e), amplitude, 0.7, duration, theta=theta, u=u
        )

    values = {"theta": 0.03, "u": 0.001, "e": 0.3, "amplitude": 0.4, "stiffness": 5e4,
              "half_width": 0.285, "duration": 1.2}  # fmt: skip
    found = assert_as_differences(motion, values)
    assert "rest" in [e.kind for e in found.response.events]


def test_uplift_of_a_block_under_a_ramp():
    """Without speed, when the ground's acceleration passes g tan(alpha); then it rocks."""
    ramp = rk.GroundMotion.from_array([0.0, 3.0, 0.0, 0.0], dt=0.5)

    def motion(half_width, half_height, gravity, factor, duration):
        block = rk.RigidBlock(half_width=half_width, half_height=half_height, gravity=gravity)
        shaking = ramp.scaled(acceleration=factor)
        return rk.Case(block, shaking, impact=rk.VelocityRatio(0.9), duration=duration)

    values = {"half_width": 0.1, "half_height": 0.45, "gravity": 9.81, "factor": 0.88,
              "duration": 1.1}  # fmt: skip
    found = assert_as_differences(motion, values)
    uplift = found.response.events[0]
    time = 9.81 * 0.1 / 0.45 / (6.0 * 0.88)  # where 6 t factor = g b/h
    assert (uplift.kind, uplift.time) == ("uplift", pytest.approx(time, rel=1e-12))
    by_hand = [time / 0.1, -time / 0.45, time / 9.81, -time / 0.88, 0.0]
    np.testing.assert_allclose(found.event_times[0], by_hand, rtol=1e-11, atol=1e-12)


def test_uplift_of_a_column_that_sways():
    """From full contact, where the mass moves, through uplifts and impacts."""

    def motion(amplitude, period, stiffness, damping, half_width, duration):
        sizes = {"stiffness": stiffness, "damping": damping, "half_width": half_width}
        return shaken(column(**sizes), rk.Impulsive(), amplitude, period, duration)

    values = {"amplitude": 4.0, "period": 0.7, "stiffness": 3e4, "damping": 502.4,
              "half_width": 0.285, "duration": 1.1}  # fmt: skip
    found = assert_as_differences(motion, values)
    assert {"uplift", "impact"} <= {e.kind for e in found.response.events}


def test_ground_whose_corners_move():
    """A pulse that begins and ends with a jump of the acceleration, its end by its period."""

    def motion(amplitude, period, theta):
        block = rk.RigidBlock(half_width=0.1, half_height=0.45)
        pulse = rk.GroundMotion.single_cosine(amplitude, period, duration=1.5)
        return rk.Case(block, pulse, impact=rk.VelocityRatio(0.9), initial={"theta": theta})

    assert_as_differences(motion, {"amplitude": 1.2, "period": 0.5, "theta": 0.05})


def test_record_whose_time_is_stretched():
    """Every sample is a corner that moves."""
    samples = 2.5 * np.sin(1.3 * np.arange(21))

    def motion(factor, time, duration):
        block = rk.RigidBlock(half_width=0.1, half_height=0.45)
        record = rk.GroundMotion.from_array(samples, dt=0.1).scaled(factor, time)
        return rk.Case(block, record, impact=rk.VelocityRatio(0.9), duration=duration)

    found = assert_as_differences(motion, {"factor": 1.1, "time": 0.9, "duration": 1.1})
    assert len(found.response.impacts) >= 2


def test_both_motions_of_the_ground():
    """Each with an amplitude of its own."""

    def motion(horizontal, vertical, duration):
        block = rk.RigidBlock(half_width=0.1, half_height=0.45)
        sines = [rk.GroundMotion.harmonic(a, period=t, duration=5.0)
                 for a, t in ((horizontal, 0.8), (vertical, 0.3))]  # fmt: skip
        return rk.Case(
            block, sines[0], impact=rk.AngularMomentum(), initial={"theta": 0.1},
            vertical=sines[1], duration=duration,
        )  # fmt: skip

    found = assert_as_differences(motion, {"horizontal": 0.5, "vertical": 1.0, "duration": 1.7})
    assert found.response.impacts


def test_time_of_overturning():
    """A slender block under a constant acceleration falls as cosh tells; then it lies."""
    p, alpha, g = 2.0, 0.2, 9.81

    def case(acceleration, slenderness):
        radius = 0.75 * g / p**2
        block = rk.SlenderBlock(radius=radius, alpha=slenderness, gravity=g)
        return rk.Case(block, rk.GroundMotion.constant(acceleration, 20.0))

    a = 1.5 * g * alpha
    found = rk.tangents(case(**rk.duals(acceleration=a, slenderness=alpha)), TIGHT)
    assert found.response.outcome is rk.Outcome.OVERTURNED
    fallen, driven = np.pi / 2, a / g - alpha  # |theta| = driven (cosh(p t) - 1)
    time = np.arccosh(1 + fallen / driven) / p
    by_driven = -fallen / driven**2 / (p * np.sinh(p * time))
    assert found.response.t[-1] == pytest.approx(time, rel=1e-11)
    np.testing.assert_allclose(found.end_time, [by_driven / g, -by_driven], rtol=1e-10)
    # at that time, which does not move, it has fallen so much further
    further = np.array([np.cosh(p * time) - 1, p * np.sinh(p * time)])
    np.testing.assert_allclose(found.end, np.outer(further, [-1 / g, 1]), rtol=1e-10)


def test_bounces_to_rest_of_a_sliding_block():
    """A foot lands, bounces a few times and stays, at a restitution of its own."""
    sliding = MOTIONS["sliding"].motion
    values = MOTIONS["sliding"].values | {"restitution": 0.1, "duration": 0.5}
    found = assert_as_differences(sliding, values, ("half_width", "theta", "restitution"))
    kinds = [e.kind for e in found.response.events]
    assert {"landing", "rest", "slip ends"} <= set(kinds)
    assert kinds.count("landing") > 2


# -- where there is no derivative ----------------------------------------------------------------


def pushed_up(factor):
    """A slender block that sinks from rest, and that the ground pushes up before, or after, it
    lands."""
    block = rk.SlenderBlock.from_frequency(p=4.0, alpha=0.2, gravity=9.81)
    ramp = rk.GroundMotion.from_array([0.0, -1.0], dt=1.0).scaled(acceleration=factor)
    return rk.Case(block, ramp, impact=rk.VelocityRatio(0.9), initial={"theta": 0.02}, duration=0.3)


def lands_at(factor, near):
    """When it lands, exactly; theta - alpha - a/g goes with cosh and sinh."""
    slope = factor / mp.mpf(9.81)

    def angle(t):
        w = mp.mpf(0.02) - mp.mpf(0.2)
        return w * mp.cosh(4 * t) + slope / 4 * mp.sinh(4 * t) + mp.mpf(0.2) - slope * t

    return mp.findroot(angle, (near, near * (1 - mp.mpf(10) ** -9)), tol=mp.mpf(10) ** -76)


@pytest.fixture(scope="module")
def grazing_factor():
    """The largest with which it lands."""
    low, high = 10.0, 80.0
    while (middle := 0.5 * (low + high)) not in (low, high):
        low, high = (middle, high) if run(pushed_up(middle)).impacts else (low, middle)
    return low


def test_grazing_is_told_and_no_large_number(grazing_factor):
    """It lands without speed; by a shade more it does not, and then there are derivatives."""
    for options in (TIGHT, None):
        found = rk.tangents(pushed_up(**rk.duals(factor=grazing_factor)), options)
        if not found.response.impacts:
            continue  # of other options, it is another factor
        assert "impact" in found.grazing
        for part in (found.event_times, found.before, found.after, found.end, found.at([0.25])):
            assert np.isnan(part).all()
        assert np.isfinite(found.at([0.05])).all()
    missed = rk.tangents(pushed_up(**rk.duals(factor=np.nextafter(grazing_factor, 99.0))), TIGHT)
    assert not missed.grazing
    by_hand = -0.3 / 9.81 + np.sinh(4 * 0.3) / 4 / 9.81
    assert missed.end[0] == pytest.approx([by_hand], rel=1e-9)


def test_beside_grazing_derivatives_are_right_or_not_told(grazing_factor):
    told = 0
    for digits in range(1, 16):
        factor = grazing_factor * (1 - 10.0**-digits)
        found = rk.tangents(pushed_up(**rk.duals(factor=factor)), TIGHT)
        mine = found.event_times[0, 0]
        with mp.workdps(40):
            near = mp.mpf(found.response.impacts[0].time)
            step = mp.mpf(factor) * mp.mpf(10) ** -22
            pair = [lands_at(factor + s, near) for s in (step, -step)]
            exact = float((pair[0] - pair[1]) / (2 * step))
        assert np.isnan(mine) == bool(found.grazing)
        if not found.grazing:
            told += 1
            assert mine == pytest.approx(exact, rel=0.05)
    assert told >= 5
