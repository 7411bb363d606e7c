"""The rigid structure on two compression-only springs (Model B, exactly) and the thesis's cart."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import rockeom as rk
from tests.typical import (
    FIRST_MOMENT,
    FOUNDATION_STIFFNESS,
    PIVOT_INERTIA,
    S1,
    TOTAL_MASS,
    on_springs,
)

GRAVITY = 9.81
WEIGHT = TOTAL_MASS * GRAVITY
HALF_WIDTH, HEIGHT = S1["half_width"], S1["height"]
CENTRE_INERTIA = PIVOT_INERTIA - TOTAL_MASS * HALF_WIDTH**2
"""About the centre of the base, I_C [kg m2]."""
SETTLEMENT = WEIGHT / (2 * FOUNDATION_STIFFNESS)  # thesis 5-16
LIFT_OFF = math.asin(SETTLEMENT / HALF_WIDTH)  # thesis 5-22, exact


# -- statics


def test_settled_structure_is_at_rest():
    structure = on_springs()
    assert structure.accelerations({}) == pytest.approx({"theta": 0.0, "heave": 0.0}, abs=1e-12)
    forces = structure.reactions({})
    assert forces["left_reaction"] == pytest.approx(WEIGHT / 2, rel=1e-12)
    assert forces["right_reaction"] == pytest.approx(WEIGHT / 2, rel=1e-12)
    # a settled spring stores what the weight did not lose elsewhere
    expected = FOUNDATION_STIFFNESS * SETTLEMENT**2
    assert structure.energies({})["elastic_energy"] == pytest.approx(expected, rel=1e-12)


def test_pushover_with_both_feet_down():
    """Exact for a base centre guided vertically; 5-25 differs by sin for tan and nothing else."""
    theta = np.linspace(0, 0.999 * LIFT_OFF, 20)
    found = on_springs().pushover(theta)
    springs = 2 * FOUNDATION_STIFFNESS * HALF_WIDTH**2
    weight = GRAVITY * FIRST_MOMENT
    exact = (springs * np.sin(theta) - weight * np.tan(theta)) / HEIGHT
    np.testing.assert_allclose(found, exact, rtol=1e-9, atol=1e-9)

    linear = (springs - weight) / HEIGHT**2 * (HEIGHT * np.sin(theta))  # 5-25
    explained = weight * (np.tan(theta) - np.sin(theta)) / HEIGHT
    np.testing.assert_allclose(linear - found, explained, atol=1e-8)
    assert 0 < (linear - found).max() < 3.1e-4  # N of 441 N


def test_pushover_on_one_foot():
    """Exact for a guided centre; 5-31, of a guided foot, differs by its longer lever alone."""
    theta = np.linspace(1.001 * LIFT_OFF, 0.3, 20)
    found = on_springs().pushover(theta)
    exact = (WEIGHT * HALF_WIDTH - GRAVITY * FIRST_MOMENT * np.tan(theta)) / HEIGHT
    np.testing.assert_allclose(found, exact, rtol=1e-9)

    sin, cos = np.sin(theta), np.cos(theta)
    centroid = FIRST_MOMENT / TOTAL_MASS
    printed = (WEIGHT * HALF_WIDTH * cos - WEIGHT * centroid * sin) / (  # 5-31
        HEIGHT * cos + HALF_WIDTH * sin
    )
    lever = HEIGHT / (HEIGHT + HALF_WIDTH * np.tan(theta))
    np.testing.assert_allclose(printed, found * lever, rtol=1e-9)


def test_pushover_is_odd_and_continuous_at_lift_off():
    structure = on_springs()
    below, above = structure.pushover([LIFT_OFF * (1 - 1e-9), LIFT_OFF * (1 + 1e-9)])
    assert below == pytest.approx(above, rel=1e-6)
    assert structure.pushover([-0.02]) == pytest.approx(-structure.pushover([0.02]), rel=1e-9)


def test_cart_follows_the_printed_pushover():
    """Stiffness 5-25 up to 5-23, then the line 5-33 to overturning."""
    cart = rk.TwoSpringCart(**S1, foundation_stiffness=FOUNDATION_STIFFNESS)
    springs = 2 * FOUNDATION_STIFFNESS * HALF_WIDTH**2
    stiffness = (springs - GRAVITY * FIRST_MOMENT) / HEIGHT**2

    def restoring(u):
        mode = "both_right" if u < u_crit else "right"
        return -TOTAL_MASS * cart.accelerations({"u": u}, mode=mode)["u"]

    u_crit = HEIGHT * WEIGHT / (2 * FOUNDATION_STIFFNESS * HALF_WIDTH)
    assert restoring(0.5 * u_crit) == pytest.approx(0.5 * stiffness * u_crit, rel=1e-12)
    theta = u_crit / HEIGHT
    centroid = FIRST_MOMENT / TOTAL_MASS
    lifted = (
        WEIGHT
        * (HALF_WIDTH * math.cos(theta) - centroid * math.sin(theta))
        / (  # 5-32
            HEIGHT * math.cos(theta) + HALF_WIDTH * math.sin(theta)
        )
    )
    assert restoring(u_crit * (1 + 1e-12)) == pytest.approx(lifted, rel=1e-9)
    # no force where the centroid stands above the pivot
    upright = math.atan2(HALF_WIDTH, centroid)
    u_top = HALF_WIDTH * (1 - math.cos(upright)) + HEIGHT * math.sin(upright)
    assert restoring(u_top) == pytest.approx(0.0, abs=1e-9 * WEIGHT)
    middle = (u_crit + u_top) / 2
    assert restoring(middle) == pytest.approx(lifted / 2, rel=1e-9)


# -- dynamics with both feet down


def test_small_motions_with_both_feet_down():
    """Two uncoupled damped oscillators: (2 k B^2 - g S, I_C) and (2 k, m)."""
    damping = 3e3
    rocking = 2 * FOUNDATION_STIFFNESS * HALF_WIDTH**2 - GRAVITY * FIRST_MOMENT
    matrix = np.array(
        [
            [0, 0, 1, 0],
            [0, 0, 0, 1],
            [-rocking / CENTRE_INERTIA, 0, -2 * damping * HALF_WIDTH**2 / CENTRE_INERTIA, 0],
            [0, -2 * FOUNDATION_STIFFNESS / TOTAL_MASS, 0, -2 * damping / TOTAL_MASS],
        ]
    )
    start = np.array([1e-7, 1e-6, 0.0, 0.0])
    run = rk.simulate(
        on_springs(foundation_damping=damping),
        rk.GroundMotion.none(1.0),
        initial={"theta": start[0], "heave": start[1]},
    )
    assert set(run.mode) == {"both"}
    t = np.linspace(0, 1, 80)
    exact = np.array([expm(matrix * s) @ start for s in t]).T
    found = run.at(t)
    np.testing.assert_allclose(found["theta"], exact[0], atol=1e-5 * start[0])
    np.testing.assert_allclose(found["heave"], exact[1], atol=1e-5 * start[1])


# -- lift-off, flight, touch-down


def test_structure_thrown_straight_up_bounces_for_ever():
    """theta = 0: springs while pressed, a parabola while not; every time is known."""
    speed = 1.0
    omega = math.sqrt(2 * FOUNDATION_STIFFNESS / TOTAL_MASS)
    lift = math.asin(omega * SETTLEMENT / speed) / omega
    leaving = math.sqrt(speed**2 - (omega * SETTLEMENT) ** 2)
    flight = 2 * leaving / GRAVITY
    pressed = math.pi / omega + 2 * lift
    expected = np.cumsum([lift, flight, pressed, flight, pressed])

    run = rk.simulate(
        on_springs(foundation_damping=0.0), rk.GroundMotion.none(2.0), initial={"heave_dot": speed}
    )
    assert run.outcome is rk.Outcome.COMPLETED
    found = [e.time for e in run.events if "flight" in (e.mode_before, e.mode_after)]
    # both feet leave and land at once: the passage through one foot takes no time
    np.testing.assert_allclose(found[:5], expected, rtol=1e-9)
    top = run.at(lift + flight / 2)
    assert top["heave"] == pytest.approx(SETTLEMENT + leaving**2 / (2 * GRAVITY), rel=1e-9)
    assert not run["theta"].any()


def test_tilted_structure_lifts_off_flies_and_lands():
    structure = on_springs(foundation_damping=0.0)
    run = rk.simulate(
        structure, rk.GroundMotion.none(1.0), initial={"theta": 0.03, "heave_dot": 0.1}
    )
    passages = {(e.mode_before, e.mode_after) for e in run.events}
    assert {("right", "flight"), ("flight", "right"), ("right", "both")} <= passages
    assert {("both", "left"), ("both", "right")} & passages
    # a foot presses if and only if its spring is shorter than when unloaded
    for foot, side in (("left", -1), ("right", 1)):
        shortening = SETTLEMENT - run["heave"] + side * HALF_WIDTH * np.sin(run["theta"])
        expected = FOUNDATION_STIFFNESS * np.maximum(shortening, 0)
        np.testing.assert_allclose(run[f"{foot}_reaction"], expected, atol=1e-6 * WEIGHT)
    # nothing but gravity acts in flight
    flying = run.mode == "flight"
    assert flying.any()
    assert not run["left_reaction"][flying].any()
    assert not run["right_reaction"][flying].any()


def test_damped_foot_never_pulls():
    run = rk.simulate(
        on_springs(foundation_damping=2e4),
        rk.GroundMotion.single_sine(8.0, period=0.4, duration=2.0),
    )
    assert "flight" in run.mode or "left" in run.mode
    for foot in ("left", "right"):
        assert run[f"{foot}_reaction"].min() > -1e-6 * WEIGHT
    assert not run.support.lost_contact


# -- towards rigid ground


def on_rigid_ground(release, t):
    """Rotation of the structure on rigid ground, its base centre guided vertically.

    The guide makes the inertia depend on the rotation, I(theta) below; each impact is 5-14's.
    """
    ratio = rk.LumpedMassStructure(**S1).velocity_ratio
    vertical = TOTAL_MASS * HALF_WIDTH**2
    found = np.empty_like(t)
    start, state, side = 0.0, [release, 0.0], 1
    while start < t[-1]:

        def rates(_, y, side=side):
            sin, cos = math.sin(y[0]), math.cos(y[0])
            coupling = 2 * side * FIRST_MOMENT * HALF_WIDTH
            inertia = CENTRE_INERTIA + vertical * cos**2 - coupling * sin * cos
            slope = -2 * vertical * sin * cos - coupling * (cos**2 - sin**2)
            moment = side * WEIGHT * HALF_WIDTH * cos - GRAVITY * FIRST_MOMENT * sin
            return [y[1], -(slope * y[1] ** 2 / 2 + moment) / inertia]

        def closed(_, y):
            return y[0]

        closed.terminal, closed.direction = True, -side
        piece = solve_ivp(
            rates, (start, t[-1]), state, "DOP853",
            events=closed, dense_output=True, rtol=1e-10, atol=1e-12,
        )  # fmt: skip
        covered = (t >= start) & (t <= piece.t[-1])
        found[covered] = piece.sol(t[covered])[0]
        start, state, side = piece.t[-1], [0.0, ratio * piece.y[1, -1]], -side
    return found


def on_stiff_springs(release, t, factor):
    """Rotation on springs `factor` times as stiff, critically damped for the heave."""
    stiffness = FOUNDATION_STIFFNESS * factor
    damping = 2 * math.sqrt(stiffness * TOTAL_MASS / 2)
    structure = on_springs(foundation_stiffness=stiffness, foundation_damping=damping)
    heave = HALF_WIDTH * math.sin(release) - WEIGHT / (2 * stiffness)
    run = rk.simulate(
        structure, rk.GroundMotion.none(t[-1]), initial={"theta": release, "heave": heave}
    )
    return run.at(t)["theta"]


def test_stiff_springs_approach_rigid_ground():
    """Critical damping makes touch-downs plastic: the limit has the restitution of 5-14."""
    release, t = 0.02, np.linspace(0, 1, 300)
    rigid = on_rigid_ground(release, t)
    errors = [
        np.abs(on_stiff_springs(release, t, factor) - rigid).max() / release
        for factor in (1e2, 1e3, 1e4)
    ]
    assert errors[1] < errors[0] / 5
    assert errors[2] < errors[1] / 5
    assert errors[2] < 1e-3


def test_stiff_springs_approach_the_lumped_mass_structure_for_small_rotations():
    """Fixed pivots and a guided centre differ by a share S B/I_O of the rotation."""
    release, t = 0.005, np.linspace(0, 0.35, 200)
    pivots = rk.simulate(
        rk.LumpedMassStructure(**S1), rk.GroundMotion.none(0.35), initial={"theta": release}
    )
    errors = [
        np.abs(on_stiff_springs(release, t, factor) - pivots.at(t)["theta"]).max() / release
        for factor in (1e2, 1e3, 1e4)
    ]
    assert errors[2] < errors[1] < errors[0]
    assert errors[2] < 5e-3
