"""The references themselves: springs in time against closed forms, energies, limits."""

import math

import numpy as np
import pytest

from tests.impacts.energy import landings
from tests.impacts.mechanics import balls, corner, landing
from tests.impacts.pairwise import pairwise, three_balls, two_balls
from tests.impacts.poisson_path import poisson_path
from tests.impacts.routh import Path, routh
from tests.impacts.simultaneous import moreau, newton, poisson
from tests.impacts.springs import springs


def corners(seed, count):
    return [problem for problem in landings(seed, 4 * count) if len(problem.normal) == 1]


def ways_of_slip(problem):
    """Of one contact: whether friction pulls it in first, and what the slip does."""
    (mu,), G = problem.friction, problem.delassus
    path = Path(G, problem.rates, mu)
    turns = len(path.pieces) > 1
    end = path.rates(routh(problem)[0])[1]
    return path.pieces[0][1][0] < 0, "slips on" if not turns or end * problem.rates[1] > 0 else (
        "sticks" if abs(end) < 1e-12 else "turns"
    )


def test_springs_at_one_contact_are_rouths_method_with_energetic_restitution():
    """Through slip that goes on, stops and turns."""
    ways = set()
    for problem in corners(3, 120):
        found, expected = springs(problem).impulses, routh(problem)
        assert np.allclose(found, expected, rtol=1e-12, atol=1e-13)
        ways.add(ways_of_slip(problem))
    assert {way for _, way in ways} == {"slips on", "sticks", "turns"}


def test_a_contact_that_jams_is_pulled_in_until_its_slip_stops():
    """A slender rod that slides, leaning forwards, on rough ground: friction compresses it."""
    rod = corner(0.02, 1.0, 0.7, [2.0, -0.5, 0.0], friction=1.5, restitution=0.5)
    jams, way = ways_of_slip(rod)
    if not jams:
        rod = corner(0.02, 1.0, 0.7, [-2.0, -0.5, 0.0], friction=1.5, restitution=0.5)
        jams, way = ways_of_slip(rod)
    assert jams
    assert way in ("sticks", "turns")
    assert np.allclose(springs(rod).impulses, routh(rod), rtol=1e-12)
    assert np.allclose(poisson_path(rod), routh(rod, "impulse"), rtol=1e-12)


def test_poissons_path_at_one_contact_is_rouths_method():
    for problem in corners(4, 120):
        assert np.allclose(poisson_path(problem), routh(problem, "impulse"), rtol=1e-12, atol=1e-13)


def test_restitutions_of_one_contact_are_one_where_slip_does_not_stop():
    smooth = corner(0.3, 0.8, 0.4, [0.3, -1.0, 0.2], restitution=0.7)
    u, _ = smooth.rates
    P = -(1 + 0.7) * u / smooth.delassus[0, 0]
    for kind in ("speed", "impulse", "energy"):
        assert np.allclose(routh(smooth, kind), [P, 0.0], rtol=1e-14)
    for law in (newton, moreau, poisson):
        (found,) = law(smooth)
        assert np.allclose(found, [P, 0.0], rtol=1e-14)


def test_elastic_springs_without_friction_keep_the_energy():
    for problem in landings(5, 24):
        elastic = problem.with_(restitution=1.0, friction=0.0)
        for gaps in ("forgotten", "followed"):
            assert abs(elastic.gain(elastic.after(springs(elastic, gaps).impulses))) < 1e-12


def test_two_balls_exchange_momentum():
    problem = balls([1.0, 3.0], [2.0, -0.5], restitution=0.6)
    expected = two_balls(1.0, 3.0, 2.0, -0.5, 0.6)
    assert np.allclose(problem.after(springs(problem).impulses), expected, rtol=1e-14)


@pytest.mark.parametrize("e", [(1.0, 1.0), (0.8, 0.5)])
def test_three_balls_are_pairs_for_a_soft_last_contact_and_a_pair_for_a_stiff_one(e):
    """The first ball meets two at rest. Their contact much softer: it is loaded when the first
    impact is over. Much stiffer: both move as one, and the restitution is that of the first."""
    masses, ratio = [1.0, 2.0, 0.7], 1e-4
    soft = balls(masses, [1.0, 0.0, 0.0], restitution=e, stiffness=[1.0, ratio])
    after = soft.after(springs(soft).impulses)
    assert np.allclose(after, three_balls(masses, 1.0, e), atol=3 * ratio)
    assert not np.allclose(after, three_balls(masses, 1.0, e), atol=1e-6)
    first, both = two_balls(masses[0], masses[1] + masses[2], 1.0, 0.0, e[0])
    stiff = balls(masses, [1.0, 0.0, 0.0], restitution=e, stiffness=[1.0, 1 / ratio])
    assert np.allclose(stiff.after(springs(stiff).impulses), [first, both, both], atol=0.01)


def test_three_equal_balls_on_equal_springs():
    """Velocities by the two frequencies of the row, in closed form up to the first contact that
    opens; known values of the literature to the digits it gives."""
    row = balls([1.0, 1.0, 1.0], [1.0, 0.0, 0.0], restitution=1.0)
    after = row.after(springs(row).impulses)
    slow, fast = 1.0, math.sqrt(3.0)

    def force(t):  # of the contact of the first pair, over the spring's constant
        return 0.5 * (math.sin(slow * t) / slow + math.sin(fast * t) / fast)

    low, high = 2.0, 3.1  # it opens first
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if force(middle) > 0 else (low, middle)
    first = 1 - 0.5 * ((1 - math.cos(slow * low)) / slow**2 + (1 - math.cos(fast * low)) / fast**2)
    assert math.isclose(after[0], first, rel_tol=1e-12)
    assert np.allclose(after, [-0.13, 0.15, 0.98], atol=5e-3)  # Nguyen and Brogliato (2014)


def test_gaps_followed_or_forgotten_differ_only_where_a_contact_closes_again():
    same = different = 0
    for problem in landings(7, 40):
        a, b = springs(problem), springs(problem, "followed")
        again = any(
            before.contacts[i] == "open" and after.contacts[i] == "loads"
            for before, after in zip(a.modes, a.modes[1:], strict=False)
            for i in range(len(problem.normal))
        )
        if np.allclose(a.impulses, b.impulses, rtol=1e-10):
            same += 1
        else:
            different += 1
            assert again
    assert same > 20


def test_pairs_without_restitution_come_to_rest_in_a_series():
    """A wide block: each corner's impact presses the other, less by (G_12 / G_11)^2 each time."""
    wide = landing(1.0, 0.2, -1.0, friction=math.inf, restitution=0.0)
    after, count = pairwise(wide, (0, 1))
    assert np.abs(wide.normal @ after).max() < 1e-13
    G = wide.delassus
    condensed = G[:2, :2] - np.outer(G[:2, 2], G[2, :2]) / G[2, 2]
    ratio = abs(condensed[0, 1] / condensed[0, 0])
    assert abs(count - math.log(1e-14) / math.log(ratio)) < 3
