"""A block lands on its second corner while the first is still closed: by each law, by hand."""

import math

import mpmath
import numpy as np
import pytest

from tests.impacts.energy import LAWS, pairs_by_stiffness
from tests.impacts.mechanics import Impact, landing
from tests.impacts.simultaneous import moreau, newton, poisson
from tests.impacts.springs import springs

RATE = -4.1307601  # rad/s


def rotation(problem: Impact, law: str) -> float:
    (after,) = LAWS[law](problem)
    return float(after[2])


@pytest.fixture(scope="module")
def smooth() -> Impact:
    """The rectangle of half-width .5 m and half-height .25 m, e = .8, without friction."""
    return landing(0.5, 0.25, RATE, restitution=0.8)


@pytest.mark.parametrize("law", ["newton", "moreau", "poisson, two problems", "poisson, path"])
def test_simultaneous_laws_turn_the_rotation_round(smooth, law):
    assert math.isclose(rotation(smooth, law), -0.8 * RATE, rel_tol=1e-12)
    (after,) = LAWS[law](smooth)
    assert abs(smooth.normal[1] @ after) < 1e-12  # the old corner stays


@pytest.mark.parametrize("law", ["springs", "springs, gaps followed"])
def test_equal_springs_keep_the_sense_of_rotation(smooth, law):
    assert math.isclose(rotation(smooth, law), -0.4970556989196844, rel_tol=1e-12)
    (after,) = LAWS[law](smooth)
    assert (smooth.normal @ after > 1.6).all()


def test_pairs_in_either_order_are_the_branch_on_which_the_old_corner_waits(smooth):
    """The new corner's impact first, the old one's next: the false branch of the springs."""
    u, g, off = 2 * 0.5 * RATE, smooth.delassus[0, 0], smooth.delassus[0, 1]
    first = -1.8 * u / g
    second = -1.8 * off * first / g
    expected = RATE + 0.5 / smooth.mass[2, 2] * (first - second)
    assert math.isclose(expected, -1.413892, abs_tol=1e-6)
    assert math.isclose(rotation(smooth, "pairwise"), expected, rel_tol=1e-12)
    swapped = smooth.with_(stiffness=[1.0, 2.0])
    assert np.allclose(pairs_by_stiffness(swapped), pairs_by_stiffness(smooth), rtol=1e-12)


def landing_in_digits(e: float, digits: int = 30) -> mpmath.mpf:
    """The rotation after the landing from the solution of each of its four modes.

    Both load; the new corner unloads; it has opened; the old corner unloads, too.
    """
    with mpmath.workdps(digits):
        one, b, h, w = (
            mpmath.mpf(1),
            mpmath.mpf("0.5"),
            mpmath.mpf("0.25"),
            mpmath.mpf("-4.1307601"),
        )
        inertia = (b**2 + h**2) / 3
        G = mpmath.matrix([[one + b**2 / inertia, one - b**2 / inertia]] * 2)
        G[1, 0], G[1, 1] = G[0, 1], G[0, 0]
        x = mpmath.matrix([2 * b * w, 0, 0, 0])  # rates, then forces, k = 1
        new, old = one, one
        for index, falls in ((0, False), (2, True), (1, False), (3, True)):  # what ends a mode
            A = mpmath.zeros(4)
            A[0:2, 2:4] = G
            A[2, 0], A[3, 1] = -new, -old

            def quantity(t, A=A, x=x, index=index):
                return (mpmath.expm(A * t) * x)[index]

            t = step = mpmath.mpf("0.1")
            while (quantity(t) > 0) if falls else (quantity(t) < 0):
                t += step
            t = mpmath.findroot(quantity, (t - step, t), solver="anderson", verify=False)
            x = mpmath.expm(A * t) * x
            if index == 0:
                new = 1 / mpmath.mpf(e) ** 2
            elif index == 2:  # the new corner opens
                new, x[2] = mpmath.mpf(0), mpmath.mpf(0)
            elif index == 1:
                old = 1 / mpmath.mpf(e) ** 2
        return (x[0] - x[1]) / (2 * b)


def test_the_landing_in_thirty_digits(smooth):
    in_digits = landing_in_digits(mpmath.mpf("0.8"))
    assert abs(rotation(smooth, "springs") - in_digits) < 1e-13


@pytest.mark.parametrize("law", ["springs", "springs, gaps followed"])
def test_a_much_stiffer_old_corner_is_a_pivot_and_a_softer_one_waits(smooth, law):
    """Stiff: the old corner holds its place, and the new one alone bounces on the condensed mass.
    Soft: it is loaded when the new corner has left, which is one pair after the other."""
    soft = smooth.with_(stiffness=[1.0, 1e-6])
    assert math.isclose(rotation(soft, law), rotation(smooth, "pairwise"), abs_tol=1e-4)
    stiff = smooth.with_(stiffness=[1.0, 1e4])
    (after,) = LAWS[law](stiff)
    assert math.isclose(after[2], -0.8 * RATE, abs_tol=0.02)


# --- feet that stick: Housner's ratio, or rest


def housner(b: float, h: float) -> float:
    inertia = (b * b + h * h) / 3
    return (inertia + h * h - b * b) / (inertia + h * h + b * b)


STICKING = {"friction": math.inf, "restitution": 0.0}


@pytest.mark.parametrize("law", sorted(LAWS))
@pytest.mark.parametrize(("b", "h"), [(0.25, 1.0), (1.0, 0.72), (1.0, 0.70), (1.0, 0.2)])
def test_without_restitution_every_law_gives_housners_ratio_or_rest(law, b, h):
    """The new foot's impulse lifts the old one where I + m h^2 > m b^2, h/b > 1/sqrt(2) of a
    rectangle, and then no law presses it; else both are pressed until both rest."""
    problem = landing(b, h, -1.0, **STICKING)
    expected = housner(b, h)
    assert (expected > 0) == (h / b > math.sqrt(0.5))
    assert math.isclose(rotation(problem, law), -max(expected, 0.0), abs_tol=1e-11)


@pytest.mark.parametrize("law", ["newton", "moreau", "poisson, two problems", "springs"])
def test_with_restitution_a_slender_block_bounces_from_its_new_foot_alone(law):
    """Each law agrees as long as the old foot is not pressed; none gives Housner's ratio."""
    e, b, h = 0.5, 0.25, 1.0
    problem = landing(b, h, -1.0, friction=math.inf, restitution=e)
    (after,) = LAWS[law](problem)
    assert math.isclose(problem.normal[0] @ after, e * 2 * b, rel_tol=1e-12)
    lost = (1 + e) * (1 - housner(b, h))
    assert math.isclose(after[2], -(1 - lost), rel_tol=1e-11)


def test_small_restitution_leaves_a_slender_block_in_a_slow_hop_and_a_wide_one_at_rest():
    """The wide block's feet load and unload infinitely often, ever less, where e is small."""
    slender, wide = (
        springs(landing(b, h, -1.0, friction=math.inf, restitution=0.01))
        for b, h in ((0.25, 1.0), (1.0, 0.2))
    )
    assert math.isclose(slender.rates[0], 0.01 * 0.5, rel_tol=1e-12)
    assert np.abs(wide.rates).max() < 1e-12
    assert len(wide.modes) > 20


def test_laws_that_solve_at_once_agree_without_friction(smooth):
    for e in (0.0, 0.3, 1.0):
        problem = smooth.with_(restitution=e)
        first, second, third = (problem.after(law(problem)[0]) for law in (newton, moreau, poisson))
        assert np.allclose(first, second, atol=1e-12)
        assert np.allclose(first, third, atol=1e-12)
