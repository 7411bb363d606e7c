"""Structures whose feet cannot lift, beside linear oscillators solved by SciPy."""

import numpy as np
import pytest
from scipy import signal

import rockeom as rk
from tests.typical import DAMPING, S1, STIFFNESS, TOTAL_MASS, column, on_springs

SHAKING = rk.GroundMotion.from_array(
    5.0 * np.sin(0.3 * np.arange(400)) * np.exp(-np.arange(400) / 150.0), 0.005, name="shaking"
)


def linear_response(motion):
    """Deformation, its rate and total acceleration of the column, exact for straight pieces."""
    matrices = [
        [[0.0, 1.0], [-STIFFNESS / S1["mass"], -DAMPING / S1["mass"]]],
        [[0.0], [-1.0]],
        [[1.0, 0.0], [0.0, 1.0], [-STIFFNESS / S1["mass"], -DAMPING / S1["mass"]]],
        [[0.0], [0.0], [0.0]],
    ]
    t = motion.dt * np.arange(len(motion.samples))
    _, found, _ = signal.lsim(signal.StateSpace(*matrices), motion.samples, t)
    return t, found.T


def test_period_and_damping_are_those_of_the_column():
    """Thesis 5-1 and 5-36: k follows from 0.092 s, c is 3 % of critical damping."""
    held = column().fixed_base()
    assert held.periods == pytest.approx([2 * np.pi * np.sqrt(S1["mass"] / STIFFNESS)], rel=1e-12)
    assert held.periods == pytest.approx([0.092], abs=5e-5)
    assert held.damping_ratios == pytest.approx([0.03], abs=5e-6)


def test_response_and_forces_are_those_of_a_linear_oscillator():
    run = rk.simulate(column().fixed_base(), SHAKING)
    t, (u, u_dot, total) = linear_response(SHAKING)
    found = run.at(
        t, names=("u", "u_dot", "displacement", "theta", *run.structure.module.REACTIONS)
    )
    assert found["u"] == pytest.approx(u, abs=1e-9 * np.abs(u).max())
    assert found["u_dot"] == pytest.approx(u_dot, abs=1e-9 * np.abs(u_dot).max())
    assert np.array_equal(found["displacement"], found["u"])
    assert not found["theta"].any()
    base = S1["base_mass"] * SHAKING.samples
    shear = S1["mass"] * total + base
    assert found["horizontal_reaction"] == pytest.approx(shear, abs=1e-8 * np.abs(shear).max())
    weight = found["left_reaction"] + found["right_reaction"]
    assert weight == pytest.approx(np.full(len(t), TOTAL_MASS * 9.81), rel=1e-12)
    # about the middle of the base; the weight of the superstructure has moved by u
    moment = S1["half_width"] * (found["right_reaction"] - found["left_reaction"])
    by_hand = -S1["mass"] * S1["height"] * total - S1["base_height"] * base
    by_hand += S1["mass"] * 9.81 * u
    assert moment == pytest.approx(by_hand, abs=1e-8 * np.abs(by_hand).max())


def test_feet_that_would_lift_are_pulled_and_that_is_said():
    assert np.abs(SHAKING.samples).max() > column().uplift_acceleration
    run = rk.simulate(column().fixed_base(), SHAKING)
    assert run.support.never_lifted
    assert run.events == ()
    assert run.extremes("left_reaction").minimum < 0
    assert run.support.lost_contact
    assert "it has to be held down" in run.support.describe()
    assert "lifts it" not in run.summary()


def test_structure_that_stays_in_full_contact_responds_as_if_it_were_held():
    weak = SHAKING.scaled_to(0.1 * column().uplift_acceleration)
    free, held = (rk.simulate(s, weak) for s in (column(), column().fixed_base()))
    assert free.support.never_lifted
    t = np.linspace(0.0, weak.duration, 500)
    assert free.at(t)["u"] == pytest.approx(held.at(t)["u"], abs=1e-9 * np.abs(held["u"]).max())
    assert held.structure.rocking == free.structure


def test_wall_with_an_elastic_column_has_the_period_of_the_thesis():
    """T_fixed = 0.0428 s, section 4.7."""
    wall = rk.FlexibleControlledWall.thesis(damping_ratio=0.05)
    assert wall.fixed_base().periods == pytest.approx([0.0428], rel=1e-9)
    assert wall.fixed_base().damping_ratios == pytest.approx([0.05], rel=1e-9)


def test_oscillator_of_chopra_and_yim_has_its_frequency():
    given = {"height": 1.0, "half_width": 0.3, "damping_ratio": 0.02}
    held = rk.UpliftingOscillator.from_frequency(20.0, **given).fixed_base()
    assert held.periods == pytest.approx([2 * np.pi / 20.0], rel=1e-9)
    assert held.damping_ratios == pytest.approx([0.02], rel=1e-9)
    assert held.fixed_base() is held


@pytest.mark.parametrize(
    ("structure", "words"),
    [
        (rk.RigidBlock(half_width=0.1, half_height=0.4), "no degree of freedom left"),
        (rk.LumpedMassStructure(**S1), "no degree of freedom left"),
        (rk.SimplifiedSubstituteGravityWall.thesis(), "no degree of freedom left"),
        (rk.ControlledWall.thesis(), "no full contact"),
        (on_springs(), "no full contact"),
    ],
    ids=lambda x: getattr(x, "model", ""),
)
def test_structure_that_cannot_bend_on_held_feet_is_refused(structure, words):
    with pytest.raises(ValueError, match=words):
        structure.fixed_base()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"impact": rk.Impulsive()}, "has no impacts: leave `impact` out"),
        ({"initial": {"theta": 0.01}}, "theta is 0.01: it is held at zero"),
        ({"initial": {"theta_dot": -1.0}}, "theta_dot is -1.0: it is held at zero"),
        ({"mode": "left"}, "'left'"),
    ],
)
def test_what_a_held_base_cannot_do_is_refused(arguments, words):
    with pytest.raises(ValueError, match=words):
        rk.simulate(column().fixed_base(), SHAKING, **arguments)


def test_pushover_of_a_base_that_cannot_turn_is_refused():
    with pytest.raises(ValueError, match="does not turn"):
        column().fixed_base().pushover([0.01])
