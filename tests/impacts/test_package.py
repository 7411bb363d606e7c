"""The package's laws of impact against the references of this folder."""

import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.symbolic import Rigid, parameter
from tests.contact.declared import FRICTION, RESTITUTION, on_points
from tests.impacts.against import by_package
from tests.impacts.energy import LAWS, cannot_gain, double_pendulum, landings
from tests.impacts.mechanics import Impact, balls, corner, impact, landing
from tests.impacts.pairwise import three_balls
from tests.impacts.poisson_path import poisson_path
from tests.impacts.shipped import LAWS_OF_PACKAGE, difference, land, random_landings
from tests.impacts.springs import springs


@pytest.mark.parametrize("law", sorted(LAWS_OF_PACKAGE))
def test_compiled_landings_are_those_of_the_reference(law):
    """The block on level feet, its old corner sliding or not, any e and friction."""
    for landed in random_landings(law, seed=12, count=40):
        assert landed is not None
        assert difference(law, landed) < 1e-10
        gain = landed.before.gain(landed.after)
        assert gain < 1e-12 or not cannot_gain(landed.before, LAWS_OF_PACKAGE[law])


@pytest.mark.parametrize(
    ("law", "ratio"),
    [
        ("newton", -0.8),
        ("moreau", -0.8),
        ("poisson", -0.8),
        ("lzb", 0.4970556989196844 / 4.1307601),
        ("pairwise", 1 - 3.6 * 2.4 / 3.4 * (1 - 1.8 * 1.4 / 3.4)),
    ],
)
def test_the_landing_on_the_second_corner(law, ratio):
    """half_width .5, half_height .25, e = .8, without friction: who turns the rotation round."""
    found = land(law, 0.5, 0.25, (0.0, -4.1307601), 0.0, 0.8)
    before, after = found.before.velocity[2], found.after[2]
    assert math.isclose(after / before, ratio, rel_tol=1e-10)


@pytest.mark.parametrize("law", sorted(LAWS_OF_PACKAGE))
def test_a_landing_on_the_other_corner_is_the_mirror_image(law):
    """The declared order of the feet does not count, by no law."""
    rng = np.random.default_rng(16)
    for _ in range(8):
        (b, h), slip, turning = rng.uniform(0.2, 1.0, 2), rng.normal(), -rng.uniform(0.5, 1.5)
        numbers = {"friction": rng.uniform(0.0, 1.0), "restitution": rng.uniform(0.1, 1.0)}
        on_left = land(law, b, h, (slip, turning), **numbers)
        on_right = land(law, b, h, (-slip, -turning), **numbers)
        scale = np.abs(on_left.before.rates).max()
        assert np.abs(on_left.after * [-1, 1, -1] - on_right.after).max() < 1e-10 * scale


def coupled(seed: int, count: int):
    """Two contacts of a body or several, gaps and slips coupled in all ways."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        n = int(rng.integers(4, 7))
        root = rng.normal(size=(n, n))
        normal, slip, velocity = (
            rng.normal(size=(2, n)),
            rng.normal(size=(2, n)),
            rng.normal(size=n),
        )
        normal *= -np.sign(normal @ velocity)[:, None]
        yield impact(
            root @ root.T + 0.1 * np.eye(n), velocity, normal, slip,
            friction=rng.uniform(0.0, 1.0, 2), restitution=rng.uniform(0.3, 1.0, 2),
            stiffness=np.exp(rng.normal(size=2)),
        )  # fmt: skip


def apart(problem: Impact, first: np.ndarray, second: np.ndarray) -> float:
    rates = problem.delassus @ (first - second)
    return float(np.abs(rates).max() / np.abs(problem.rates).max())


@pytest.mark.parametrize(("law", "reference"), [("lzb", springs), ("poisson", poisson_path)])
def test_impulses_of_coupled_contacts_are_those_of_the_reference(law, reference):
    for problem in coupled(13, 6):
        expected = reference(problem)
        expected = getattr(expected, "impulses", expected)
        assert apart(problem, by_package(problem, law), expected) < 1e-10


@pytest.mark.parametrize("law", ["lzb", "poisson"])
def test_laws_that_solve_at_once_do_not_depend_on_the_order_of_contacts(law):
    for problem in coupled(14, 3):
        swap = [1, 0]
        swapped = impact(
            problem.mass, problem.velocity, problem.normal[swap], problem.slip[swap],
            friction=problem.friction[swap], restitution=problem.restitution[swap],
            stiffness=problem.stiffness[swap],
        )  # fmt: skip
        found = by_package(swapped, law)[[1, 0, 3, 2]]
        assert apart(problem, by_package(problem, law), found) < 1e-10


def test_springs_follow_a_slip_that_turns_for_an_instant():
    """Seven modes into the impact the slip stops, turns, and is stopped again within a thousandth
    of the duration, when the second foot opens."""
    b, h = 0.8242213988807587, 0.20087511902614064
    numbers = {"friction": 0.1780249489438728, "restitution": 0.2614885914737449}
    rates = [-8.062535379039, 0.02004716048779]  # of the new foot's gap, and of the slip
    turning = rates[0] / (2 * b)
    problem = landing(b, h, turning, **numbers)
    problem = problem.with_velocity(problem.velocity + np.array([rates[1], 0.0, 0.0]))
    motion = springs(problem)
    assert [mode.slips[0] for mode in motion.modes] == [1, -1, -1, -1, -1, -1, 1, 1, -1, -1]
    assert apart(problem, by_package(problem, "lzb"), motion.impulses) < 1e-10


def test_springs_without_restitution_of_coupled_contacts():
    for problem in coupled(17, 6):
        plastic = problem.with_(restitution=0.0)
        assert apart(plastic, by_package(plastic, "lzb"), springs(plastic).impulses) < 1e-10


def test_a_force_that_jams_does_not_grow_at_once_to_hold_a_gap():
    """Friction closes the first gap as its force grows: the least that would hold it is above the
    force that there is, and a force that drops finds none, so that it goes to zero."""
    delassus = np.array(
        [[3.7821859532419793, 2.7743644951680255, -7.082301077691892, -1.9091186281103554],
         [2.7743644951680255, 3.356141468514347, -6.185794359641757, -2.3632859265732837],
         [-7.082301077691893, -6.185794359641761, 18.06859237439247, 7.253748602378667],
         [-1.9091186281103556, -2.3632859265732833, 7.253748602378664, 4.402602507080579]]
    )  # fmt: skip
    rates = np.array(
        [-1.5285722158455655, -3.6065577135698543, -1.967509486057274, -1.9362624057644287]
    )
    problem = impact(
        np.linalg.inv(0.5 * (delassus + delassus.T)), rates, np.eye(4)[:2], np.eye(4)[2:],
        friction=np.array([1.341201880726362, 0.8532896073472065]), restitution=np.zeros(2),
        stiffness=np.array([1.0632967841242784, 8.52703046622882]),
    )  # fmt: skip
    found = by_package(problem, "lzb")
    assert apart(problem, found, springs(problem).impulses) < 1e-9
    soft = problem.with_(restitution=1e-3)  # the limit of small e, as no point loads again
    assert apart(problem, found, springs(soft).impulses) < 2e-3


def test_pairs_of_three_balls_are_typed_two_by_two():
    masses, e = [1.0, 2.0, 0.7], [0.8, 0.5]
    row = balls(masses, [1.0, 0.0, 0.0], restitution=e)
    assert np.allclose(
        row.after(by_package(row, "pairwise")), three_balls(masses, 1.0, e), atol=1e-12
    )


def test_springs_of_three_balls_from_soft_to_stiff():
    for ratio in (1e-2, 1.0, 30.0):
        row = balls(
            [1.0, 2.0, 0.7], [1.0, 0.0, 0.0], restitution=[0.8, 0.5], stiffness=[1.0, ratio]
        )
        assert apart(row, by_package(row, "lzb"), springs(row).impulses) < 1e-10


@pytest.mark.parametrize("law", ["lzb", "poisson", "pairwise"])
def test_laws_that_follow_the_slip_do_not_gain_in_the_double_pendulum(law):
    pendulum = double_pendulum()
    (expected,) = LAWS[LAWS_OF_PACKAGE[law]](pendulum)
    after = pendulum.after(by_package(pendulum, law))
    assert np.allclose(after, expected, rtol=1e-12)
    assert pendulum.gain(after) < -0.4


def test_single_corners_slip_stop_and_turn_as_by_rouths_method():
    for problem in landings(15, 80):
        if len(problem.normal) == 1:
            for law in ("lzb", "poisson", "pairwise"):
                (expected,) = LAWS[LAWS_OF_PACKAGE[law]](problem)
                found = problem.after(by_package(problem, law))
                assert np.allclose(found, expected, rtol=1e-10, atol=1e-11)


def gains_of_a_cube(tangential: float | None) -> np.ndarray:
    """Energies [J] gained by a cube that falls on a corner, by Moreau's law: the landing of the
    guide on contacts, which gains by Newton's."""
    b = parameter("b", "half_width", "m", "half of the width of the base")
    law = Rigid(RESTITUTION.symbol, FRICTION.symbol, law="moreau", tangential=tangential)
    feet = {"left": (-b.symbol, 0), "right": (b.symbol, 0)}
    model = on_points("cube", feet, b, laws=dict.fromkeys(feet, law))
    cube = rk.structure(
        model, mass=1.0, height=0.4, half_width=0.4, inertia=(0.4**2 + 0.4**2) / 3, friction=0.6,
        restitution=0.9,
    )  # fmt: skip
    start = {
        "theta": -0.1, "theta_dot": -1.5, "y": 0.4 * math.sin(0.1), "x_dot": 0.477, "y_dot": -0.24
    }  # fmt: skip
    return np.array(
        rk.simulate(cube, rk.GroundMotion.none(1e-3), initial=start).impacts.energy_gains
    )


def test_moreaus_law_gains_with_a_tangential_restitution_of_its_own_and_says_so():
    """With none it is Newton's law. The mirror image of the cube lands on its right corner."""
    c, s = 0.4 * math.cos(0.1), 0.4 * math.sin(0.1)
    velocity = [-(0.477 - 1.5 * c), -0.24 - 1.5 * s, 1.5]
    mirrored = corner(0.4, 0.4, 0.1, velocity, friction=0.6, restitution=0.9)
    (expected,) = (mirrored.gain(after) for after in LAWS["newton"](mirrored))
    kinetic = 0.5 * mirrored.velocity @ mirrored.mass @ mirrored.velocity
    assert expected > 0.2
    assert np.allclose(gains_of_a_cube(0.0), [expected * kinetic], rtol=1e-10)
    assert len(gains_of_a_cube(None)) == 0
