"""Chopra and Yim's oscillator (thesis 2-7, 2-8): closed forms, and the exact structure."""

import math

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import brentq

import rockeom as rk
from rockeom.analysis import formulas
from rockeom.symbolic.model import GROUND_X, GROUND_Y

OMEGA, XI, H, B, G = 56.10, 0.03, 1.0, 0.3, 9.81
R = math.hypot(B, H)
U_C = G * B / (OMEGA**2 * H)
"""Static deformation at which a foot lifts."""


def oscillator(gravity=G, damping_ratio=XI):
    return rk.UpliftingOscillator.from_frequency(
        angular_frequency=OMEGA,
        damping_ratio=damping_ratio,
        height=H,
        half_width=B,
        mass=3.0,
        gravity=gravity,
    )


def exact(gravity=G):
    """The same structure with exact kinematics and P-delta."""
    same = oscillator(gravity).parameters()
    nothing = ("inertia", "base_mass", "base_height", "base_inertia")
    return rk.FlexibleStructure(**same, **dict.fromkeys(nothing, 0.0))


# -- the equations


@pytest.mark.parametrize("side", [1, -1])
def test_flexural_equation_while_uplifted_is_that_of_the_thesis(side):
    """2-7 with 2-8, the rotation eliminated; the ground shakes horizontally."""
    model = rk.derive("uplifting_oscillator")
    theta, u = model.coordinates
    m, h, b, k, c, g = (p.symbol for p in model.parameters)
    mode = "right" if side == 1 else "left"
    equations = model.equations(mode)
    _, found = equations.mass_matrix.LUsolve(equations.forcing.subs(GROUND_Y, 0))

    omega, xi = sp.sqrt(k / m), c / (2 * sp.sqrt(k * m))
    ratio = sp.sqrt(b**2 + h**2) / b
    frequency, damping = omega * ratio, xi * ratio  # 2-8
    printed = -(GROUND_X - side * g * h / b)
    printed += -2 * damping * frequency * u.velocity - frequency**2 * u.position
    assert sp.simplify(found - printed) == 0
    assert not found.has(theta.position, theta.velocity)


def test_mode_of_the_uplifted_column_has_the_frequency_and_damping_of_the_thesis():
    """2-8 by the eigenvalues of the generated equations; the rotation itself has no stiffness."""
    structure = oscillator()

    def rates(state, mode="right"):
        found = structure.accelerations(state, mode=mode)
        return np.array([found["theta"], found["u"]])

    base = {"theta": 0.01, "u": 0.0}
    step = 2.0**-7
    columns = [
        (rates(base | {name: base.get(name, 0.0) + step}) - rates(base)) / step
        for name in structure.states
    ]
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [np.array(columns).T]])
    values = sorted(np.linalg.eigvals(matrix), key=lambda z: z.imag)
    mode = values[-1]
    frequency = formulas.uplifted_frequency(OMEGA, B, H)
    assert abs(mode) == pytest.approx(frequency, rel=1e-9)
    assert -mode.real / abs(mode) == pytest.approx(formulas.uplifted_damping(XI, B, H), rel=1e-9)
    np.testing.assert_allclose(np.abs(values[1:3]), 0.0, atol=1e-5 * frequency)


# -- uplift


def test_static_uplift_is_at_the_critical_deformation():
    structure = oscillator()
    (force,) = structure.pushover([0.0])
    assert force / structure.stiffness == pytest.approx(U_C, rel=1e-12)
    assert pytest.approx(formulas.uplift_displacement(OMEGA, B, H)) == U_C
    for factor, moves in ((1 - 1e-9, False), (1 + 1e-9, True)):
        run = rk.simulate(oscillator(), rk.GroundMotion.none(0.01), initial={"u": factor * U_C})
        assert bool(run.events) is moves


def test_damped_column_lifts_a_foot_when_spring_and_damper_reach_the_moment_of_the_weight():
    structure = oscillator()
    speed = 3 * U_C * OMEGA
    run = rk.simulate(structure, rk.GroundMotion.none(0.05), initial={"u_dot": speed})
    damped = OMEGA * math.sqrt(1 - XI**2)

    def lacking(t):
        u = speed / damped * np.exp(-XI * OMEGA * t) * np.sin(damped * t)
        rate = speed * np.exp(-XI * OMEGA * t) * np.cos(damped * t) - XI * OMEGA * u
        return OMEGA**2 * u + 2 * XI * OMEGA * rate - G * B / H

    uplift = run.events[0]
    assert (uplift.kind, uplift.mode_after) == ("uplift", "right")
    assert uplift.time == pytest.approx(brentq(lacking, 0, 0.02, xtol=1e-14), rel=1e-9)


# -- motion


def test_rocking_on_one_foot_against_the_closed_form():
    """u is a damped oscillator about its static value; R^2 theta + H u falls freely."""
    theta_0, u_0 = 0.0146, U_C
    run = rk.simulate(
        oscillator(), rk.GroundMotion.none(1.0), initial={"theta": theta_0, "u": u_0},
        impact=rk.Impulsive(),
    )  # fmt: skip
    frequency, damping = OMEGA * R / B, XI * R / B
    settled = G * H / B / frequency**2
    damped = frequency * math.sqrt(1 - damping**2)

    def deformation(t):
        decay = np.exp(-damping * frequency * t)
        turning = np.cos(damped * t) + damping * frequency / damped * np.sin(damped * t)
        return settled + (u_0 - settled) * decay * turning

    def rotation(t):
        return theta_0 - G * B * t**2 / (2 * R**2) - H * (deformation(t) - u_0) / R**2

    impact = brentq(rotation, 0.05, 0.2, xtol=1e-14)
    assert run.impacts[0].time == pytest.approx(impact, rel=1e-9)
    t = np.linspace(0, impact, 200)
    found = run.at(t, side="left")
    np.testing.assert_allclose(found["u"], deformation(t), atol=1e-9 * u_0)
    np.testing.assert_allclose(found["theta"], rotation(t), atol=1e-9 * theta_0)


@pytest.mark.parametrize("mode", ["left", "right"])
def test_impulsive_impact_ends_in_full_contact(mode):
    """The mass keeps its horizontal velocity; the vertical one is lost with its energy."""
    side = 1 if mode == "right" else -1
    before = {"u": 0.4 * U_C, "theta_dot": -0.2 * side, "u_dot": 0.03}
    structure = oscillator()
    after, follows = structure.after_impact(before, mode, impact=rk.Impulsive())
    assert follows == "both"
    assert after["theta_dot"] == 0.0
    assert after["u_dot"] == pytest.approx(0.03 + H * before["theta_dot"], rel=1e-14)
    lost = (
        structure.energies(before, mode)["kinetic_energy"]
        - structure.energies(after, follows)["kinetic_energy"]
    )
    assert lost == pytest.approx(structure.mass * (B * 0.2) ** 2 / 2, rel=1e-12)


def test_angular_momentum_of_the_rigid_structure():
    """A point mass on a massless base: e = cos(2 alpha)."""
    assert oscillator().velocity_ratio == pytest.approx(math.cos(2 * math.atan(B / H)), rel=1e-14)


def test_energy_is_lost_at_impacts_only_where_nothing_damps():
    structure = oscillator(damping_ratio=0.0)
    run = rk.simulate(
        structure, rk.GroundMotion.none(1.0), initial={"theta": 0.015, "u": U_C},
        impact=rk.Impulsive(),
    )  # fmt: skip
    lost = sum(structure.mass * (B * e.before["theta_dot"]) ** 2 / 2 for e in run.impacts)
    energy = run["total_energy"]
    assert len(run.impacts) > 4
    assert energy[0] - energy[-1] == pytest.approx(lost, rel=1e-7)


@pytest.mark.parametrize("law", [rk.Impulsive(), rk.AngularMomentum()], ids=["impulse", "e"])
def test_mirrored_motion_is_the_mirror_image_to_the_last_bit(law):
    rng = np.random.default_rng(3)
    motion = rk.GroundMotion.from_array(rng.normal(scale=4.0, size=60), dt=0.02)
    run = rk.simulate(oscillator(), motion, impact=law)
    image = rk.simulate(oscillator(), -motion, impact=law)
    assert len(run.impacts) > 3
    for name in run.states:
        np.testing.assert_array_equal(image[name], -run[name])


# -- the limit of small rotations


def response(structure, scale):
    """(theta, u) over the scale, under a scaled shaking from a scaled start."""
    rng = np.random.default_rng(5)
    record = rk.GroundMotion.from_array(scale * rng.normal(scale=3.0, size=40), dt=0.02)
    run = rk.simulate(
        structure, record, initial={"theta": 0.01 * scale}, impact=rk.Impulsive(),
        options=rk.SolverOptions(atol=1e-12 * scale),
    )  # fmt: skip
    assert len(run.impacts) > 2
    found = run.at(np.linspace(0, 0.78, 300))
    return np.array([found["theta"], found["u"]]) / scale


def test_response_is_in_proportion_to_shaking_and_gravity():
    """A homogeneous system of first degree: with its weight scaled as well, all displacements."""
    scale = 2.0**-10
    np.testing.assert_allclose(
        response(oscillator(scale * G), scale), response(oscillator(), 1.0), rtol=0, atol=1e-12
    )


def test_exact_structure_tends_to_it_as_rotations_become_small():
    """Its difference falls with the rotation: that of the first order is P-delta."""
    limit = response(oscillator(), 1.0)
    far, near = (
        np.abs(response(exact(scale * G), scale) - limit).max(axis=1) / np.abs(limit).max(axis=1)
        for scale in (1e-2, 1e-3)
    )
    assert (near < 1e-2).all()
    np.testing.assert_allclose(far / near, 10.0, rtol=0.1)


def test_figure_of_the_thesis_alternates_about_the_critical_deformation():
    figures = pytest.importorskip("rockeom.thesis.figures")
    _, bottom = figures.FIGURES["2-6"]().axes
    line = bottom.lines[0]
    t, u = line.get_xdata(), line.get_ydata()
    # before each of the first impacts the column has come to rest near u_c of its side
    assert u[np.searchsorted(t, 0.10)] == pytest.approx(1.0, abs=0.15)
    assert u[np.searchsorted(t, 0.29)] == pytest.approx(-1.0, abs=0.15)
