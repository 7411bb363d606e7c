"""Blocks on an isolated base, against integrations of the base and one angle."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from tests.refusals import told

B, H, MASS, BASE, G = 0.25, 0.9, 300.0, 600.0, 9.81
BLOCK = rk.RigidBlock(half_width=B, half_height=H, mass=MASS)
ISOLATOR = {"base_mass": BASE, "period": 1.6, "damping_ratio": 0.1}
FINE = rk.SolverOptions(rtol=1e-11, atol=1e-12)
SINE = rk.GroundMotion.harmonic(amplitude=2.0, period=1.1, duration=3.0)


def isolated(*blocks: rk.RigidBlock, **changes) -> rk.IsolatedBlocks:
    return rk.IsolatedBlocks.from_period(blocks, **(ISOLATOR | {"friction": 5.0} | changes))


def test_blocks_that_stand_move_with_the_base():
    omega, xi, weak = 2 * np.pi / 1.6, 0.1, SINE.scaled(0.4)
    run = rk.simulate(isolated(BLOCK), weak, options=FINE)
    assert abs(run["theta"]).max() == 0.0
    own = solve_ivp(
        lambda t, s: [s[1], -2 * xi * omega * s[1] - omega**2 * s[0] - float(weak.acceleration(t))],
        (0.0, 3.0), [0.0, 0.0], rtol=1e-11, atol=1e-13, max_step=0.01,
    ).y[:, -1]  # fmt: skip
    assert [run.final["u"], run.final["u_dot"]] == pytest.approx(own, rel=1e-6)


SMALL = rk.RigidBlock(half_width=0.15, half_height=0.6, mass=90.0)


@pytest.mark.parametrize("blocks", [(BLOCK,), (BLOCK, SMALL)], ids=["one", "two"])
def test_blocks_rock_on_their_base_as_newton_and_euler_have_it(blocks):
    """Each turns about its right foot, which moves with the base."""
    base, n = isolated(*blocks), len(blocks)
    k, c = base.isolator_stiffness, base.isolator_damping
    b, h, m, inertia = np.array(
        [(x.half_width, x.half_height, x.mass, x.parameters()["inertia"]) for x in blocks]
    ).T

    def rates(t, state):
        u, theta, v, speed = state[0], state[1 : n + 1], state[n + 1], state[n + 2 :]
        cos, sin = np.cos(theta), np.sin(theta)
        # the centroid from the foot: (-b cos + h sin, b sin + h cos)
        across, up = -b * cos + h * sin, b * sin + h * cos
        ground = float(SINE.acceleration(t))
        mass = np.diag([m.sum() + BASE, *(inertia + m * (across**2 + up**2))])
        mass[0, 1:] = mass[1:, 0] = m * up
        pushed = -k * u - c * v - (m.sum() + BASE) * ground + (m * across * speed**2).sum()
        forces = [pushed, *(m * G * across - m * ground * up)]
        return [v, *speed, *np.linalg.solve(mass, forces)]

    names = ["u", *(["theta"] if n == 1 else ["theta_1", "theta_2"])]
    names += [f"{name}_dot" for name in names]
    at_first = dict(zip(names, [0.0, *[0.08, 0.06][:n], 0.1, *[0.2, 0.1][:n]], strict=True))
    run = rk.simulate(base, SINE, initial=at_first, duration=0.2, options=FINE)
    assert len(run.events) == 0
    own = solve_ivp(rates, (0.0, 0.2), [*at_first.values()], rtol=1e-11, atol=1e-13).y[:, -1]
    assert [run.final[name] for name in names] == pytest.approx(own, rel=1e-7)


def test_two_blocks_on_one_base_are_one_where_they_are_alike():
    """Two blocks of half the mass move as one of the whole."""
    half = rk.RigidBlock(half_width=B, half_height=H, mass=MASS / 2)
    start = {"theta_1": 0.05, "theta_2": 0.05}
    one = rk.simulate(isolated(BLOCK), SINE, initial={"theta": 0.05}, duration=0.3, options=FINE)
    two = rk.simulate(isolated(half, half), SINE, initial=start, duration=0.3, options=FINE)
    for name in ("theta_1", "theta_2"):
        assert two.final[name] == pytest.approx(one.final["theta"], rel=1e-7, abs=1e-9)
    assert two.final["u"] == pytest.approx(one.final["u"], rel=1e-7)


@pytest.mark.parametrize("blocks", [[], [1], "ab"])
def test_blocks_that_are_none_are_refused(blocks):
    values = {"base_mass": 1.0, "isolator_stiffness": 1.0, "isolator_damping": 0.0}
    error = told(rk.IsolatedBlocks, blocks=blocks, friction=0.5, **values)
    assert "RigidBlocks" in error


def test_gravity_is_that_of_the_blocks():
    moon = rk.RigidBlock(half_width=B, half_height=H, mass=MASS, gravity=1.62)
    assert "give that of the blocks, 1.62 m/s2" in told(isolated, moon)
    with pytest.raises(rk.InputError, match="RigidBlocks"):
        rk.IsolatedBlocks.from_period(None, base_mass=1.0, period=1.0, damping_ratio=0.1)
