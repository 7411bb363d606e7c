"""Dead loads that stay vertical and that follow: stability of two bars, and work around a circuit.

H. Ziegler, Die Stabilitätskriterien der Elastomechanik, Ing.-Arch. 20 (1952) 49-56: two hinged bars
under a load that follows the upper one flutter, and never buckle.
"""

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom import analysis
from rockeom.symbolic import (
    Body,
    Force,
    Model,
    Spring,
    Unilateral,
    coordinate,
    dead_load,
    parameter,
    rocking_structure,
    turned,
)
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.parts.walls import wall_on_bed

LOWER = coordinate("a", "lower", "rad", "rotation of the lower bar, clockwise")
UPPER = coordinate("b", "upper", "rad", "rotation of the upper bar, clockwise")
MASS = parameter("m", "mass", "kg", "mass at the upper end; twice of it at the hinge")
LENGTH = parameter("l", "length", "m", "length of each bar")
STIFFNESS = parameter("k", "stiffness", "N m", "stiffness of each hinge")
FORCE = parameter("N", "axial_force", "N", "load on the upper end")
m, length, k, force = (p.symbol for p in (MASS, LENGTH, STIFFNESS, FORCE))


def two_bars(following: bool) -> Model:
    """Ziegler's bars, with masses 2 m at the hinge and m at the end."""
    hinge = turned((0, length), (0, 0), LOWER.position)
    bar = turned((0, length), (0, 0), UPPER.position)
    end = hinge[0] + bar[0], hinge[1] + bar[1]
    return Model(
        name="two_bars",
        title="Two hinged bars under a load",
        parameters=(MASS, LENGTH, STIFFNESS, FORCE),
        coordinates=(LOWER, UPPER),
        bodies=(
            Body("middle", 2 * m, hinge, rotation=LOWER.position),
            Body("end", m, end, rotation=UPPER.position),
        ),
        gravity=sp.S.Zero,
        rotation=LOWER,
        elements=(
            Spring("foot", LOWER.position, k),
            Spring("hinge", UPPER.position - LOWER.position, k),
            Unilateral("stop", hinge[0] - length, k),
        ),
        forces=(dead_load("load", force, end, UPPER.position if following else sp.S.Zero),),
    )


def squares_of_frequencies(following: bool, load: float) -> np.ndarray:
    """Of small motions, with m = l = k = 1."""
    equations = two_bars(following).free.equations
    q = [LOWER.position, UPPER.position]
    at = {x: 0 for c in (LOWER, UPPER) for x in (c.position, c.velocity)}
    values = {m: 1, length: 1, k: 1, force: load}
    restoring = equations.gravity_forces + equations.elastic_forces - equations.applied_forces
    stiffness = restoring.jacobian(q).subs(at).subs(values)
    mass = equations.mass_matrix.subs(at).subs(values)
    return np.linalg.eigvals(np.array(mass.inv() * stiffness, dtype=float))


def test_bars_under_a_load_that_follows_flutter_at_zieglers_load():
    critical = 7 / 2 - np.sqrt(2)
    assert np.isreal(squares_of_frequencies(True, critical - 1e-6)).all()
    assert (squares_of_frequencies(True, critical - 1e-6) > 0).all()
    assert not np.isreal(squares_of_frequencies(True, critical + 1e-6)).any()


def test_bars_under_a_load_that_stays_vertical_buckle():
    critical = (3 - np.sqrt(5)) / 2
    assert min(squares_of_frequencies(False, critical - 1e-6)) > 0
    assert min(squares_of_frequencies(False, critical + 1e-6)) < 0


@pytest.mark.parametrize("following", [True, False])
def test_work_of_a_load_around_a_circuit_vanishes_only_if_it_does_not_follow(following):
    """By the curl of the generalised forces, the work around a small circuit over its area."""
    lower, upper = two_bars(following).free.forces
    curl = sp.diff(upper, LOWER.position) - sp.diff(lower, UPPER.position)
    expected = force * length * sp.cos(UPPER.position - LOWER.position) if following else 0
    assert sp.simplify(curl - expected) == 0


def test_wall_under_a_load_that_follows_keeps_the_energy_balance_and_its_period():
    """The axial force settles the bed by N/(n k), about which the wall heaves with n k and m."""
    mass, stiffness, load = 1000.0, 2e7, 40e3
    wall = rk.structure(
        wall_on_bed(2), mass=mass, height=0.6, inertia=200.0, half_width=0.5, gravity=9.81,
        axial_force=load, shear_span=1.2, foundation_stiffness=stiffness, strength=45e3,
    )  # fmt: skip
    settled = (mass * 9.81 + load) / (2 * stiffness)
    period = 2 * np.pi * np.sqrt(mass / (2 * stiffness))
    still = rk.GroundMotion.none(period)
    run = rk.simulate(wall, still, initial={"heave": -0.5 * settled})
    half = np.interp(period / 2, run.t, run["heave"])
    assert half == pytest.approx(-1.5 * settled, rel=1e-4)
    assert run.final["heave"] == pytest.approx(-0.5 * settled, rel=1e-6)

    shaken = rk.GroundMotion.single_sine(20.0, 0.3, 0.6)
    run = rk.simulate(wall, shaken, initial={"heave": -settled})
    assert any("slack" in mode for mode in run.mode)
    assert any("yields" in mode for mode in run.mode)
    assert abs(analysis.energy_balance(run).error) < 1e-8


def test_load_that_stays_vertical_on_a_rocking_block_is_a_spring_without_stiffness():
    """Moments about the corner: P y = (m g + N) x of the top, with the weight in its middle."""
    theta = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
    half_width = parameter("B", "half_width", "m", "half of the width")
    height, gravity = (
        parameter("h", "height", "m", "height"),
        parameter("g", "gravity", "m/s2", "gravity"),
    )
    b, h = half_width.symbol, height.symbol

    def top(pivot):
        return turned((0, h), pivot, theta.position)

    foot = (SIDE * b, sp.S.Zero)
    model = rocking_structure(
        name="pressed_block",
        title="A block under a dead load",
        parameters=(MASS, half_width, height, gravity, FORCE),
        coordinates=(theta,),
        bodies=lambda pivot: [Body("block", m, top(pivot), m * h**2, theta.position)],
        elements=[Spring("load", top(foot)[1], initial_force=force)],
        half_width=b,
        gravity=gravity.symbol,
    )
    block = rk.structure(
        model, mass=100.0, half_width=0.3, height=1.2, gravity=9.81, axial_force=5e3
    )
    angle = 0.1
    x = 0.3 * np.cos(angle) - 1.2 * np.sin(angle)
    y = 1.2 * np.cos(angle) + 0.3 * np.sin(angle)
    assert block.pushover(angle) == pytest.approx((981.0 + 5e3) * x / y, rel=1e-12)


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (lambda: dead_load("jack", "N", (0, 1)), "force 'jack': force is 'N': give a number or a"),
        (lambda: dead_load("jack", force, length), "displacement is l: give a point as"),
        (lambda: dead_load("jack", force, (0, 1), "theta"), "turned is 'theta'"),
        (lambda: Force("jack", (0, force), length), "displacement is l: give a point as"),
        (lambda: Force("jack", force, (0, length)), "value is N: give a point as"),
        (lambda: wall_on_bed(8), "its 8 elements have 6561 combinations of states"),
        (lambda: wall_on_bed(0), "springs is 0: give a whole number"),
    ],
)
def test_what_is_no_load_is_refused(declare, message):
    with pytest.raises(ValueError, match=message):
        declare()


def test_a_page_shows_both_components_of_a_load():
    page = two_bars(True).markdown()
    assert page.count(r"Q_{\mathrm{load}} &= ") == 2


def test_a_load_that_moves_with_nothing_is_refused():
    with pytest.raises(ValueError, match=r"the displacement of force 'jack' is .* does no work"):
        Model(
            name="fixed", title="A load on the ground", parameters=(MASS, LENGTH),
            coordinates=(LOWER,), gravity=sp.S.Zero, rotation=LOWER,
            bodies=(Body("bar", m, turned((0, length), (0, 0), LOWER.position),
                         rotation=LOWER.position),),
            elements=(Unilateral("stop", LOWER.position, length),),
            forces=(dead_load("jack", m, (sp.S.Zero, length)),),
        )  # fmt: skip
