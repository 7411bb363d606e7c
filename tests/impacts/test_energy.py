"""No law gains where it is stated not to, and each that can gain has an example."""

import math

import numpy as np
import pytest

from tests.impacts.energy import (
    LAWS,
    block_on_unequal_feet,
    body_on_floor_and_wall,
    cannot_gain,
    count_gains,
    double_pendulum,
    landings,
    no_negative,
)
from tests.impacts.mechanics import block
from tests.impacts.springs import springs


def gains(problem, law):
    return [problem.gain(v) for v in LAWS[law](problem)]


@pytest.mark.parametrize("law", sorted(LAWS))
def test_no_gain_within_the_stated_range_over_random_landings(law):
    """`python -m tests.impacts` counts ten thousand."""
    inside, _ = count_gains(law, seed=8, count=120)
    assert inside.impacts >= 40
    assert inside.gains == 0


def test_newtons_law_gains_in_the_double_pendulum_and_springs_do_not():
    """Kane's puzzle (1984): friction turns the slip of the tip, and the energy grows by half."""
    pendulum = double_pendulum()
    (gain,) = gains(pendulum, "newton")
    assert math.isclose(gain, 0.587494686929845, rel_tol=1e-10)
    for law in ("moreau", "poisson, path", "springs", "pairwise"):
        (lost,) = gains(pendulum, law)
        assert lost < -0.4


def test_newtons_range_at_one_contact_is_a_ratio_of_the_delassus_matrix():
    """e^2 <= 1 - G_nt^2 / (G_nn G_tt): at most .246 for the pendulum."""
    G = double_pendulum().delassus
    limit = math.sqrt(1 - G[0, 1] ** 2 / (G[0, 0] * G[1, 1]))
    assert math.isclose(limit, 0.246162, abs_tol=1e-6)
    assert cannot_gain(double_pendulum(restitution=limit * (1 - 1e-9)), "newton")
    assert not cannot_gain(double_pendulum(restitution=limit * (1 + 1e-6)), "newton")


def test_newtons_range_of_a_block_on_level_feet_is_a_ratio_of_its_sides():
    """e^2 <= (b^2 + h^2) / (b^2 + 4 h^2)."""
    rng = np.random.default_rng(9)
    for b, h in rng.uniform(0.1, 1.0, (20, 2)):
        limit = math.sqrt((b * b + h * h) / (b * b + 4 * h * h))
        for factor, inside in ((1 - 1e-9, True), (1 + 1e-6, False)):
            problem = block(b, h, [0.3, -1.0, 0.1], friction=0.5, restitution=factor * limit)
            assert cannot_gain(problem, "newton") == inside


@pytest.mark.parametrize(
    ("law", "problem", "least"),
    [
        ("moreau", body_on_floor_and_wall, 7.0),
        ("poisson, two problems", block_on_unequal_feet, 0.05),
    ],
)
def test_laws_at_once_gain_with_unequal_restitutions_and_friction(law, problem, least):
    (gain,) = gains(problem(), law)
    assert gain > least
    assert not cannot_gain(problem(), law)
    for e in (0.0, 0.5, 1.0):
        equal = problem((e, e))
        assert cannot_gain(equal, law)
        assert all(gain < 1e-12 for gain in gains(equal, law))


def test_poissons_path_gains_even_with_equal_restitutions():
    """A plain block on level feet: the slip that stops within the impact is enough."""
    problem = block(0.25, 0.65, [-0.6, -1.4, -2.0], friction=0.5, restitution=1.0)
    (gain,) = gains(problem, "poisson, path")
    assert math.isclose(gain, 0.14125875821438, rel_tol=1e-9)
    (lost,) = gains(problem, "poisson, two problems")
    assert lost < 0


def test_simultaneous_laws_never_gain_without_friction_whatever_the_restitutions():
    rng = np.random.default_rng(10)
    for problem in landings(11, 60):
        e = rng.uniform(0.0, 1.0, len(problem.normal))
        smooth = problem.with_(friction=0.0, restitution=e)
        for law in ("newton", "moreau", "poisson, two problems", "poisson, path"):
            assert all(gain < 1e-12 for gain in gains(smooth, law))


def test_poissons_loss_without_friction_is_that_of_the_two_phases():
    """-P_c (G - E G E) P_c / 2 where no contact needs more than e times its compression."""
    e = np.array([0.9, 0.5])
    problem = block(0.3, 0.9, [0.0, -1.0, 0.0], restitution=e)
    G = problem.delassus[:2, :2]
    P_c = np.linalg.solve(G, -problem.rates[:2])
    expected = -0.5 * P_c @ (G - np.diag(e) @ G @ np.diag(e)) @ P_c
    assert no_negative(G - np.outer(e, e) * G)
    (gain,) = gains(problem, "poisson, two problems")
    kinetic = 0.5 * problem.velocity @ problem.mass @ problem.velocity
    assert math.isclose(gain * kinetic, expected, rel_tol=1e-12)


def test_springs_lose_their_share_of_what_each_has_stored():
    """Without friction, two feet in phase: 1 - e^2 of the kinetic energy."""
    problem = block(0.3, 0.9, [0.0, -1.0, 0.0], restitution=0.7)
    assert math.isclose(problem.gain(problem.after(springs(problem).impulses)), 0.49 - 1)
