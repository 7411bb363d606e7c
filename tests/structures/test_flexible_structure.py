"""The flexible structure (Model C): full contact, impulsive impacts, one mode against SciPy."""

import functools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from tests.typical import DAMPING, FIRST_MOMENT, PIVOT_INERTIA, S1, STIFFNESS, TOTAL_MASS, column

GRAVITY = 9.81
THRESHOLD = GRAVITY * S1["half_width"] * TOTAL_MASS / FIRST_MOMENT
"""Static ground acceleration at which a foot lifts [m/s2]."""


# -- both feet down


def test_column_vibrates_in_full_contact_as_a_damped_oscillator():
    mass = S1["mass"]
    omega, xi = math.sqrt(STIFFNESS / mass), DAMPING / (2 * math.sqrt(STIFFNESS * mass))
    assert 2 * math.pi / omega == pytest.approx(0.092, abs=1e-4)  # thesis 5-1
    assert xi == pytest.approx(0.03, abs=1e-4)  # thesis 5-36
    run = rk.simulate(column(), rk.GroundMotion.none(1.0), initial={"u": 2e-4})
    assert set(run.mode) == {"both"}
    assert run.events == ()
    t = np.linspace(0, 1, 200)
    damped = omega * math.sqrt(1 - xi**2)
    phase = damped * t
    expected = (
        2e-4 * np.exp(-xi * omega * t) * (np.cos(phase) + xi * omega / damped * np.sin(phase))
    )
    np.testing.assert_allclose(run.at(t)["u"], expected, atol=1e-9 * 2e-4)


def slowly_to(peak):
    """Ground acceleration that takes ten seconds, a hundred periods of the column, to its peak."""
    return rk.GroundMotion.from_array([0.0, peak], dt=10.0)


def test_uplift_under_a_slow_acceleration_is_at_the_static_threshold():
    # u is not zero then: its weight acts at u, which lowers the threshold a little
    u = -S1["mass"] * THRESHOLD / STIFFNESS
    shifted = THRESHOLD + GRAVITY * S1["mass"] * u / FIRST_MOMENT
    assert shifted == pytest.approx(THRESHOLD, rel=2e-3)
    below = rk.simulate(column(), slowly_to(shifted * (1 - 5e-4)))
    assert below.events == ()
    above = rk.simulate(column(), slowly_to(shifted * (1 + 5e-4)))
    assert above.events[0].kind == "uplift"


def test_pushover_lifts_off_where_statics_says():
    """P-delta of the deformed column included; the rigid column's force is the limit."""
    rigid = GRAVITY * S1["half_width"] * TOTAL_MASS / S1["height"]
    (found,) = column(stiffness=STIFFNESS * 1e6).pushover([0.0])
    assert found == pytest.approx(rigid, rel=1e-6)
    (found,) = column().pushover([0.0])
    u = found / STIFFNESS
    expected = (rigid * S1["height"] - S1["mass"] * GRAVITY * u) / S1["height"]
    assert found == pytest.approx(expected, rel=1e-9)


# -- impacts


@pytest.mark.parametrize("side", [1, -1])
def test_impulsive_law_against_the_closed_form(side):
    """Angular momentum about the new pivot and m_e (u_dot + H_e theta_dot) are both conserved."""
    rng = np.random.default_rng(7)
    m_e, h_e, i_e = S1["mass"], S1["height"], S1["inertia"]
    m_b, h_b, i_b, b = (S1[k] for k in ("base_mass", "base_height", "base_inertia", "half_width"))
    for _ in range(50):
        state = {
            "u": rng.uniform(-0.02, 0.02),
            "theta_dot": -side * rng.uniform(0.01, 1.0),
            "u_dot": rng.uniform(-1, 1),
        }
        u = side * state["u"]
        ratio = (i_e + i_b + m_b * (h_b**2 - b**2) - m_e * (b**2 - u**2)) / (
            i_e + i_b + m_b * (h_b**2 + b**2) + m_e * (b + u) ** 2
        )
        mode, other = ("right", "left") if side == 1 else ("left", "right")
        after, follows = column().after_impact(state, mode, impact=rk.Impulsive())
        assert follows == other
        assert after["theta"] == 0.0
        assert after["u"] == state["u"]
        assert after["theta_dot"] == pytest.approx(ratio * state["theta_dot"], rel=1e-12)
        momentum = state["u_dot"] + h_e * state["theta_dot"]
        assert after["u_dot"] + h_e * after["theta_dot"] == pytest.approx(momentum, rel=1e-12)


@pytest.mark.parametrize("side", [1, -1])
def test_old_foot_that_cannot_lift_stays_down(side):
    """A squat structure: the closed form's ratio is negative, so full contact follows."""
    squat = column(half_width=0.9, inertia=5.0)
    state = {"u": 0.003, "theta_dot": -side * 0.2, "u_dot": 0.1}
    mode = "right" if side == 1 else "left"
    after, follows = squat.after_impact(state, mode, impact=rk.Impulsive())
    assert follows == "both"
    assert after["theta_dot"] == 0.0
    assert after["u"] == state["u"]
    momentum = state["u_dot"] + S1["height"] * state["theta_dot"]
    assert after["u_dot"] == pytest.approx(momentum, rel=1e-13)

    run = rk.simulate(
        squat, rk.GroundMotion.none(0.5), impact=rk.Impulsive(), initial={"theta": side * 0.01}
    )
    assert run.impacts[0].mode_after == "both"
    at = run.impacts[0].time
    assert run.at(at + 1e-6)["u_dot"] == pytest.approx(run.impacts[0].after["u_dot"], abs=1e-3)


def test_rigid_column_recovers_the_restitution_of_the_rigid_structure():
    """Held at u = 0, u_dot = 0 by its own pivot's momentum: thesis 5-14."""
    e = column().velocity_ratio
    assert e == rk.LumpedMassStructure(**S1).velocity_ratio
    assert e**2 == pytest.approx(0.7399, abs=1e-4)
    lost = 2 * S1["half_width"] ** 2 * TOTAL_MASS
    assert e == pytest.approx(1 - lost / PIVOT_INERTIA, rel=1e-14)


# -- the motion of one rocking mode


@functools.cache
def numpy_modes():
    return rk.derive("flexible_structure").lambdify()


@pytest.mark.parametrize("vertical", [False, True])
def test_rocking_mode_against_another_integrator(vertical):
    """DOP853 of SciPy on the lambdified equations, up to just before the first impact."""
    structure = column()
    initial = {"theta": 0.05, "u": 0.002, "theta_dot": 0.1, "u_dot": -0.05}
    horizontal = rk.GroundMotion.harmonic(2.0, period=0.3, duration=1.0)
    lifting = rk.GroundMotion.harmonic(1.5, period=0.21, duration=1.0) if vertical else None
    run = rk.simulate(structure, horizontal, vertical=lifting, initial=initial)
    end = run.impacts[0].time * 0.999
    assert end > 0.2
    mode, parameters = numpy_modes()["right"], structure.parameters()

    def rates(t, y):
        ay = lifting.acceleration(t) if vertical else 0.0
        return mode.rates(y, parameters, horizontal.acceleration(t), ay)

    t = np.linspace(0, end, 60)
    reference = solve_ivp(
        rates, (0, end), list(initial.values()), "DOP853", t, rtol=1e-12, atol=1e-13
    )
    found = run.at(t)
    for name, expected in zip(run.states, reference.y, strict=True):
        np.testing.assert_allclose(found[name], expected, atol=1e-8, err_msg=name)


def test_both_methods_agree():
    """Order 5 and order 8 through the impacts of a shaken column."""
    motion = rk.GroundMotion.harmonic(4.5, period=0.5, duration=3.0)
    runs = [
        rk.simulate(
            column(),
            motion,
            impact=rk.Impulsive(),
            options=rk.SolverOptions(method=method, rtol=1e-11, atol=1e-13),
        )
        for method in ("DOP853", "RK45")
    ]
    times = [[impact.time for impact in run.impacts] for run in runs]
    assert len(times[0]) > 8
    np.testing.assert_allclose(*times, rtol=1e-10)


def test_flexible_column_ceases_to_rock_earlier_than_the_rigid_one():
    """Figures 5-22 and 5-38: by about half a second."""
    release = {"theta": 0.0275}
    motion = rk.GroundMotion.none(6.0)
    law = rk.AngularMomentum()
    rigid = rk.simulate(rk.LumpedMassStructure(**S1), motion, impact=law, initial=release)
    flexible = rk.simulate(column(), motion, impact=law, initial=release)

    def rocks_until(run):
        """Last time at which a foot is a twentieth of a millimetre up."""
        uplift = np.maximum(run["left_uplift"], run["right_uplift"])
        return run.t[np.flatnonzero(uplift > 5e-5)[-1]]

    assert 0.3 < rocks_until(rigid) - rocks_until(flexible) < 0.8
