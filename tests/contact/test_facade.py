"""Facades that turn about one edge, against an integration of one angle with bounces and a tie."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk

B, H, MASS, G = 0.3, 3.0, 7e3, 9.81
SIZE = {"thickness": 2 * B, "height": 2 * H, "mass": MASS}
ABOUT_EDGE = MASS * (4 * B**2 + 4 * H**2) / 12 + MASS * (B**2 + H**2)
FINE = rk.SolverOptions(rtol=1e-11, atol=1e-13)
SHAKING = rk.GroundMotion.harmonic(amplitude=1.8, period=0.9, duration=3.0)
TIE = {"at": (-B, 5.5), "to": (-2.3, 5.5), "stiffness": 2e5}


def moment(theta, thrust=0.0):
    """Moment outwards about the edge, of the weight and of a thrust at the top."""
    across = -B * np.cos(theta) + H * np.sin(theta)
    top = B * np.sin(theta) + 2 * H * np.cos(theta)  # of the middle of the top, above the edge
    return MASS * G * across + thrust * top


def own_motion(restitution, start, until, motion=None, thrust=0.0):
    """(theta, theta') at the end: each flight by itself, each landing by the ratio of speeds."""

    def rates(t, state):
        theta, speed = state
        ground = 0.0 if motion is None else float(motion.acceleration(t))
        up = B * np.sin(theta) + H * np.cos(theta)
        return [speed, (moment(theta, thrust) - MASS * ground * up) / ABOUT_EDGE]

    def lands(_, state):
        return state[0]

    lands.terminal, lands.direction = True, -1
    t, state = 0.0, np.array(start)
    while t < until:
        flight = solve_ivp(
            rates, (t, until), state, events=lands, rtol=1e-11, atol=1e-13, method="DOP853",
            max_step=0.02,
        )  # fmt: skip
        t, state = flight.t[-1], flight.y[:, -1]
        if flight.status == 1:
            state = np.array([1e-15, -restitution * state[1]])
    return state


@pytest.mark.parametrize("thrust", [0.0, 1e3])
def test_a_facade_bounces_from_its_transverse_walls(thrust):
    wall = rk.Facade(**SIZE, restitution=0.6, thrust=thrust)
    start = {"theta": 0.04, "theta_dot": 0.0}
    run = rk.simulate(wall, rk.GroundMotion.none(1.6), initial=start, options=FINE)
    assert sum(event.kind == "landing" for event in run.events) >= 1
    own = own_motion(0.6, [0.04, 0.0], 1.6, thrust=thrust)
    assert [run.final["theta"], run.final["theta_dot"]] == pytest.approx(own, rel=1e-6, abs=1e-8)


def test_a_shaken_facade_leaves_its_walls_at_its_threshold():
    run = rk.simulate(rk.Facade(**SIZE, restitution=0.3), SHAKING, options=FINE)
    first = next(event.time for event in run.events if event.kind == "lifting")
    assert float(SHAKING.acceleration(first)) == pytest.approx(-G * B / H, rel=1e-7)
    assert run["theta"].min() > -1e-12


def test_a_tie_of_limited_elongation_breaks_and_lets_the_facade_go():
    tie = rk.Strap(**TIE, pretension=2e3, breaks_at=rk.Break(extension=0.05))
    wall = rk.Facade(**SIZE, restraint=tie)
    start = {"theta": 0.0, "theta_dot": 0.5}
    run = rk.simulate(wall, rk.GroundMotion.none(1.0), initial=start, options=FINE)
    record = run.ties["strap"]
    assert record.broke_at is not None
    assert record.largest_force == pytest.approx(2e3 + 2e5 * 0.05, rel=1e-9)
    assert run.energy_balance().error < 1e-10
    held = rk.Facade(**SIZE, restraint=rk.Strap(**TIE, pretension=2e3))
    assert (
        rk.simulate(held, rk.GroundMotion.none(1.0), initial=start).ties["strap"].broke_at is None
    )
