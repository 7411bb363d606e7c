"""Energy: constant without damping, never made at an impact."""

import functools

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from tests.typical import FOUNDATION_STIFFNESS, S1, by_model, column, every_structure, on_springs

TIGHT = rk.SolverOptions(rtol=1e-13, atol=1e-15, output_step=0.01)
LOSSLESS = {
    "rigid_block": {"theta": 0.1},
    "slender_block": {"theta": 0.1},
    "nondimensional_block": {"x": 0.4},
    "lumped_mass_structure": {"theta": 0.03},
    "flexible_structure": {"theta": 0.03, "u": 0.002},
    "two_spring_structure": {"theta": 0.03, "heave_dot": 0.1},
    "two_spring_cart": {"u": 0.03},
}
STRUCTURES = pytest.mark.parametrize("structure", every_structure(), ids=by_model)


def excess_energy(run):
    """Energy above that of the structure standing still, and the largest of it."""
    s = run.structure
    mode = "both" if "both" in s.module.MODES else "both_right"
    rest = sum(s.energies({}, mode=mode).values())
    energy = run["total_energy"] - rest
    return energy, np.abs(energy).max()


@functools.cache
def without_loss(structure):
    """Free for 100 s, by impacts that keep the velocity."""
    law = rk.VelocityRatio(1.0) if structure.model != "two_spring_structure" else None
    return rk.simulate(
        structure,
        rk.GroundMotion.none(100.0),
        impact=law,
        initial=LOSSLESS[structure.model],
        options=TIGHT,
    )


@STRUCTURES
def test_energy_is_constant_between_impacts_over_100_s(structure):
    run = without_loss(structure)
    assert run.outcome is rk.Outcome.COMPLETED
    assert len(run.events) > 20
    energy, scale = excess_energy(run)
    # an impact of the flexible structure by a prescribed ratio may change energy: start anew
    start = np.searchsorted(run.t, [0.0, *(event.time for event in run.impacts)], side="right")
    for first, last in zip(start, [*start[1:] - 1, len(run.t)], strict=True):
        piece = energy[first:last]
        if len(piece):
            assert np.ptp(piece) <= 1e-9 * scale


@pytest.mark.parametrize(
    "structure", [s for s in every_structure() if s.model != "flexible_structure"], ids=by_model
)
def test_lossless_impacts_keep_the_energy_of_a_rigid_structure(structure):
    run = without_loss(structure)
    energy, scale = excess_energy(run)
    assert np.ptp(energy) <= 1e-9 * scale


# -- at an impact

WITH_IMPACTS = [s for s in every_structure() if s.model != "two_spring_structure"]
NUMBERS = st.floats(-5, 5).map(lambda x: x if abs(x) > 1e-140 else 0.0)
"""Nothing so small that its square, in an energy, underflows: that rounds up as well as down."""


def change_at_impact(structure, side, state, law):
    """Kinetic energies before and after the impact that closes a side."""
    m = structure.module
    mode = next(
        c
        for c, s, kinds, n in zip(m.MODES, m.SIDES, m.KINDS, m.GUARDS, strict=True)
        if s == side and n and kinds[0] == 0
    )
    rotation, rate = m.STATES[m.ROTATION], m.STATES[m.ROTATION_RATE]
    state = state | {rotation: 0.0, rate: -side * abs(state[rate])}
    after, follows = structure.after_impact(state, mode, impact=law)
    return (
        structure.energies(state, mode=mode)["kinetic_energy"],
        structure.energies(after, mode=follows)["kinetic_energy"],
    )


def a_state(structure, values):
    return dict(zip(structure.states, values, strict=False))


@settings(max_examples=200)
@given(
    structure=st.sampled_from([s for s in WITH_IMPACTS if s.model != "flexible_structure"]),
    law=st.one_of(
        st.just(rk.AngularMomentum()),
        st.builds(rk.EnergyRatio, st.floats(0, 1)),
        st.builds(rk.VelocityRatio, st.floats(0, 1)),
    ),
    side=st.sampled_from([-1, 1]),
    values=st.lists(NUMBERS, min_size=2, max_size=2),
)
def test_impact_of_a_rigid_structure_takes_the_prescribed_share(structure, law, side, values):
    before, after = change_at_impact(structure, side, a_state(structure, values), law)
    ratio = {
        rk.EnergyRatio: lambda: law.r,
        rk.VelocityRatio: lambda: law.e**2,
        rk.AngularMomentum: lambda: structure.velocity_ratio**2,
    }[type(law)]()
    assert ratio <= 1
    assert after == pytest.approx(ratio * before, rel=1e-12, abs=1e-200)


@settings(max_examples=300)
@given(
    inertia=st.floats(0, 50),
    half_width=st.floats(0.05, 3.0),
    side=st.sampled_from([-1, 1]),
    values=st.lists(NUMBERS, min_size=4, max_size=4),
)
def test_impulsive_law_never_makes_energy(inertia, half_width, side, values):
    """Slender or squat, deformed and vibrating anyhow, whichever mode follows."""
    structure = column(inertia=inertia, half_width=half_width)
    before, after = change_at_impact(structure, side, a_state(structure, values), rk.Impulsive())
    assert after <= before * (1 + 1e-12)


@settings(max_examples=100)
@given(
    side=st.sampled_from([-1, 1]),
    law=st.sampled_from([rk.AngularMomentum(), rk.EnergyRatio(0.5), rk.VelocityRatio(0.9)]),
    theta_dot=st.floats(1e-3, 2.0),
)
def test_prescribed_ratio_takes_energy_from_a_column_at_rest_in_itself(side, law, theta_dot):
    state = {"theta": 0.0, "u": 0.0, "theta_dot": theta_dot, "u_dot": 0.0}
    before, after = change_at_impact(column(), side, state, law)
    assert after <= before


def test_prescribed_ratio_may_make_energy_in_a_vibrating_column():
    """The thesis's rule leaves u_dot alone: the part m_e H_e theta_dot u_dot of the energy shrinks.

    Where that part is negative, taking speed away adds energy. The impulsive law does not.
    """
    state = {"theta": 0.0, "u": 0.0, "theta_dot": -0.1, "u_dot": 1.0}
    before, after = change_at_impact(column(), 1, state, rk.AngularMomentum())
    e, m = column().velocity_ratio, S1["mass"]
    inertia = 2 * column().energies({"theta_dot": 1.0}, mode="right")["kinetic_energy"]
    gain = (e**2 - 1) / 2 * inertia * 0.1**2 + (1 - e) * m * S1["height"] * 0.1 * 1.0
    assert gain > 0
    assert after - before == pytest.approx(gain, rel=1e-12)


# -- in whole runs


@settings(max_examples=25)
@given(
    structure=st.sampled_from(WITH_IMPACTS),
    e=st.floats(0, 1),
    amplitude=st.floats(0.05, 0.9),
)
def test_free_motion_never_gains_energy(structure, e, amplitude):
    rotation = structure.states[0]
    release = {
        "rigid_block": 0.25, "slender_block": 0.25, "nondimensional_block": 1.0,
        "lumped_mass_structure": 0.3, "flexible_structure": 0.3, "two_spring_cart": 0.3,
    }[structure.model]  # fmt: skip
    law = rk.Impulsive() if structure.model == "flexible_structure" else rk.VelocityRatio(e)
    run = rk.simulate(
        structure,
        rk.GroundMotion.none(20.0),
        impact=law,
        initial={rotation: amplitude * release},
        options=TIGHT,
    )
    energy, scale = excess_energy(run)
    assert np.diff(energy).max() <= 1e-8 * scale
    assert energy.min() >= -1e-8 * scale


@settings(max_examples=15)
@given(
    damping=st.floats(0, 2e4),
    theta=st.floats(-0.1, 0.1),
    heave_dot=st.floats(-1.0, 1.5),
)
def test_free_motion_on_springs_never_gains_energy(damping, theta, heave_dot):
    """A foot that leaves a damped spring compressed leaves its energy in the spring: count it."""
    structure = on_springs(foundation_damping=damping)
    run = rk.simulate(
        structure,
        rk.GroundMotion.none(5.0),
        initial={"theta": theta, "heave_dot": heave_dot},
        options=TIGHT,
    )
    mass = S1["mass"] + S1["base_mass"]
    settlement = mass * structure.gravity / (2 * FOUNDATION_STIFFNESS)
    tilt = S1["half_width"] * np.sin(run["theta"])
    springs = sum(
        FOUNDATION_STIFFNESS / 2 * np.maximum(settlement - run["heave"] + side * tilt, 0) ** 2
        for side in (-1, 1)
    )
    energy = run["kinetic_energy"] + run["gravitational_energy"] + springs
    rounding = 1e-12 * abs(energy[0])
    assert np.diff(energy).max() <= 1e-8 * run["kinetic_energy"].max() + rounding
