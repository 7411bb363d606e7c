"""Impacts of feet that rub: Moreau's law, in 40 digits, in energy, at its limits."""

import numpy as np
import pytest

import rockeom as rk
from tests.space import impacts_in_digits
from tests.space.bodies import energy_ratio, spin
from tests.space.cases import TIGHT
from tests.space.families import on_feet
from tests.space.mechanics import Body, violations
from tests.space.test_standing import TRIPOD

STILL = rk.GroundMotion.none(1e-3)


def struck(impact: impacts_in_digits.Impact):
    """The impact with which the motion of a body on such feet begins; others stay open."""
    laws = {"friction": impact.friction, "restitution": impact.restitution, "mass": impact.mass}
    if len(impact.arms) == 3:
        feet = {f"foot{i}": tuple(arm[:2]) for i, arm in enumerate(impact.arms)}
        height = -impact.arms[0][2]
        tensor = np.diag(impact.principal)
        body = rk.LeggedStatue(feet=feet, centroid=(0.0, 0.0, height), inertia=tensor, **laws)
    else:
        b, c, height = np.abs(impact.arms[0])
        moments = {f"inertia_{a}{a}": x for a, x in zip("xyz", impact.principal, strict=True)}
        body = rk.Prism(
            width=2 * b, depth=2 * c, height=2 * height, centroid_height=height, **moments, **laws
        )
    run = rk.simulate(body, STILL, initial=impact.state, options=TIGHT)
    assert run.impacts[0].time < 1e-9
    return run.impacts[0], body


@pytest.mark.parametrize("name", impacts_in_digits.IMPACTS)
def test_feet_that_rub_leave_an_impact_as_coulomb_and_moreau_have_it(name):
    impact = impacts_in_digits.IMPACTS[name]
    right, ratio = impacts_in_digits.velocities_after(impact)
    struck_, body = struck(impact)
    after = np.array([*(struck_.after[f"{axis}_dot"] for axis in "xyz"), *spin(struck_.after)])
    right = np.array([float(x) for x in right])
    np.testing.assert_allclose(after, right, rtol=0.0, atol=1e-12 * np.abs(right).max())
    assert energy_ratio(body, struck_) == pytest.approx(float(ratio), rel=1e-12)


def test_of_several_outcomes_of_an_impact_the_one_in_which_more_feet_stay_and_stick_follows():
    ratios = [impacts_in_digits.velocities_after(one)[1] for one in impacts_in_digits.OF_THREE]
    impact, body = struck(impacts_in_digits.OF_THREE[0])
    before, after = Body(body, impact.before), Body(body, impact.after)
    for foot in ("foot1", "foot2"):
        star = after.velocity_of(foot) + 0.5 * before.velocity_of(foot)
        np.testing.assert_allclose(star, 0.0, atol=1e-13)
    assert min(abs(energy_ratio(body, impact) - float(ratio)) for ratio in ratios) > 0.005


def test_a_foot_that_never_slips_leaves_with_its_whole_velocity_turned_round():
    """It bounces on one foot, e = 0.5: gap and slips of it shrink alike until it rests."""
    statue = rk.LeggedStatue(**TRIPOD, restitution=0.5)
    start = {"pitch": 0.1, "roll": 0.05, "x_dot": 5e-4, "y_dot": 3e-4, "z_dot": -1e-3}
    run = rk.simulate(statue, STILL, initial=start, options=TIGHT)
    for impact in run.impacts[:4]:
        states = (impact.after, impact.before)
        after, before = (Body(statue, state).velocity_of("right") for state in states)
        np.testing.assert_allclose(after, -0.5 * before, atol=1e-15)
    (rest,) = (event for event in run.events if event.kind == "rest")
    assert (rest.mode_before, rest.mode_after) == ("flight", "right")


@pytest.mark.parametrize(
    ("seed", "rubs"), [*((s, True) for s in (3, 5, 7, 16, 33)), *((s, False) for s in (4, 7, 9))]
)
def test_a_random_body_that_bounces_moves_by_the_laws_of_mechanics(seed, rubs):
    """Feet with friction, or that never slip, and e = 0.5; no impact gives energy."""
    run, *laws = on_feet(seed, rubs=1.5 * rubs, bounces=True)
    assert run.outcome.value in ("completed", "overturned")
    assert len(run.impacts) > 100
    assert not list(violations(run, *laws))


def test_a_slip_whose_force_grows_beyond_all_bounds_ends_by_an_impact():
    """Painleve's jam: the force is a/sqrt(t' - t), and no step is short enough to come to t'."""
    run, *laws = on_feet(55, rubs=1.5, bounces=True)
    came = [Body(run.structure, i.before).velocity_of(i.contact) for i in run.impacts]
    rubbed = [np.hypot(*v[:2]) if abs(v[2]) < 1e-13 else 0.0 for v in came]
    jam = run.impacts[int(np.argmax(rubbed))]  # of those whose gap was closed
    rows = (run.t < jam.time - 1e-13) & (run.t > jam.time - 1e-11)
    squares = run[f"{jam.contact}_reaction"][rows] ** 2 * (jam.time - run.t[rows])
    assert rows.sum() > 5
    np.testing.assert_allclose(squares, squares[0], rtol=0.02)
    slips = [Body(run.structure, x).velocity_of(jam.contact) for x in (jam.before, jam.after)]
    np.testing.assert_allclose(slips[1], -0.5 * slips[0], atol=1e-12)
    assert not list(violations(run, *laws))


@pytest.mark.parametrize("seed", [7000210, 7007450])
def test_an_edge_whose_corners_slip_apart_is_followed_where_sweeps_go_round_in_circles(seed):
    """Friction of 1.3: sweeps over impulses let one corner open and close without end."""
    run, *laws = on_feet(seed, rubs=1.5)
    assert run.outcome.value == "overturned"
    assert not list(violations(run, *laws))
