"""Contacts without friction, compared with closed forms: ladder, stop and groove."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.symbolic import Body, Contact, Model, Rigid, parameter
from tests.contact.declared import (
    BLOCK,
    FRICTION,
    GRAVITY,
    LAW,
    MASS,
    RESTITUTION,
    THETA,
    X,
    Y,
    on_points,
    placed,
)

G = 9.81
SMOOTH = Rigid(restitution=RESTITUTION.symbol, friction=0)
LENGTH = parameter("l", "length", "m", "how high the point is that touches the wall")
WIDTH = parameter("b", "half_width", "m", "half of the base")
AWAY = parameter("d", "away", "m", "where the stop is")
SLOPE = parameter("alpha", "slope", "rad", "angle of the walls of the groove")
WITHOUT_FRICTION = tuple(p for p in BLOCK if p is not FRICTION)


@cache
def ladder(*, floor: Rigid = SMOOTH) -> Model:
    """On a floor, smooth or not, against a smooth wall to its left."""
    foot, top = placed((0, 0)), placed((0, LENGTH.symbol))
    block = WITHOUT_FRICTION if floor is SMOOTH else BLOCK
    return replace(
        on_points("ladder", {"foot": (0, 0)}, LENGTH, laws={"foot": floor}),
        parameters=(*block, LENGTH),
        contacts=(
            Contact("foot", gap=foot[1], slip=foot[0], law=floor),
            Contact("top", gap=top[0], slip=top[1], law=SMOOTH, place=top),
        ),
    )


@cache
def before_a_stop(*, feet: Rigid) -> Model:
    """A block, and a smooth stop to its right at a height."""
    corners = {"left": (-WIDTH.symbol, 0), "right": (WIDTH.symbol, 0)}
    laws = dict.fromkeys(corners, feet)
    block = on_points("before_a_stop", corners, WIDTH, AWAY, LENGTH, laws=laws)
    x, y = placed((WIDTH.symbol, LENGTH.symbol))
    stop = Contact("stop", gap=AWAY.symbol - x, slip=y, law=SMOOTH, place=(x, y))
    return replace(block, contacts=(*block.contacts, stop))


@cache
def in_a_groove() -> Model:
    """A disc on the two smooth walls of a groove; its place is that above the seat."""
    x, y, alpha = X.position, Y.position, SLOPE.symbol
    walls = {"left": 1, "right": -1}
    return Model(
        name="disc",
        title="A disc in a groove",
        parameters=(*(p for p in WITHOUT_FRICTION if p.name != "height"), SLOPE),
        coordinates=(X, Y, THETA),
        bodies=(Body("disc", MASS.symbol, (x, y), BLOCK[2].symbol, THETA.position),),
        gravity=GRAVITY.symbol,
        rotation=THETA,
        overturning=sp.Integer(1000),
        contacts=tuple(
            Contact(
                name,
                gap=y * sp.cos(alpha) + s * x * sp.sin(alpha),
                slip=x * sp.cos(alpha) - s * y * sp.sin(alpha),
                law=SMOOTH,
            )
            for name, s in walls.items()
        ),
    )


def of_ladder(length: float, lean: float) -> tuple[rk.Structure, dict[str, float]]:
    """A uniform rod, and its state at rest at an angle to the wall."""
    structure = rk.structure(
        ladder(), mass=12.0, height=length / 2, inertia=length**2, gravity=G, restitution=0.0,
        length=length,
    )  # fmt: skip
    return structure, {"theta": -lean, "x": length * np.sin(lean)}


def stopped(friction: float | None, **given) -> rk.Structure:
    """A block of mass 100 kg, whose centroid is 1 m high; friction None: on smooth feet."""
    model = before_a_stop(feet=SMOOTH if friction is None else LAW)
    size = {"half_width": 0.5, "height": 1.0, "length": 1.0, "away": 1.5, "restitution": 0.0}
    rubs = {"friction": 0.0 if friction is None else friction}
    return rk.structure(
        model, **size | {"mass": 100.0, "inertia": 40.0, "gravity": G} | rubs | given
    )


def lasts(start: float, end: float, length: float) -> float:
    """The time of a rod's fall on two smooth surfaces, by quadrature.

    Energy, m L^2 a'^2 / 6 = m g L (cos a0 - cos a) / 2, gives a'^2 = 3 g (cos a0 - cos a) / L.
    With a = a0 + u^2 the integrand of da / a' is smooth.
    """
    nodes, weights = np.polynomial.legendre.leggauss(40)
    most = np.sqrt(end - start)
    u = most * (nodes + 1) / 2
    speed = np.sqrt(3 * G / length * (np.cos(start) - np.cos(start + u * u)))
    return float(np.sum(weights * 2 * u / speed) * most / 2)


@pytest.mark.parametrize(("length", "lean"), [(2.0, 0.3), (5.0, 0.05), (0.7, 1.1)])
def test_a_ladder_leaves_a_smooth_wall_at_two_thirds_of_its_height(length, lean):
    """The wall's force m d2(L sin a / 2)/dt2 is zero where 3 cos a = 2 cos a0."""
    structure, initial = of_ladder(length, lean)
    leaves = np.arccos(2 / 3 * np.cos(lean))
    time = lasts(lean, leaves, length)
    run = rk.simulate(structure, rk.GroundMotion.none(1.05 * time), initial=initial)
    event = run.events[0]
    assert [e.contact for e in run.events] == ["top"]
    assert (event.kind, event.mode_before, event.mode_after) == ("lifting", "foot_top", "foot")
    assert event.time == pytest.approx(time, rel=1e-9)
    assert event.before["theta"] == pytest.approx(-leaves, rel=1e-9)
    rate = np.sqrt(3 * G / length * (np.cos(lean) - np.cos(leaves)))
    assert event.before["theta_dot"] == pytest.approx(-rate, rel=1e-9)
    # nothing pushes its centroid sideways then
    theta, speed = run["theta"][-1], run["theta_dot"][-1]
    sideways = run["x_dot"][-1] + length / 2 * np.cos(theta) * speed
    assert sideways == pytest.approx(length / 2 * np.cos(leaves) * rate, rel=1e-9)
    assert run.energy_balance().error < 1e-9


@pytest.mark.parametrize(("friction", "stands"), [(0.27, True), (0.23, False)])
def test_a_ladder_stands_on_a_rough_floor_where_friction_is_half_its_lean(friction, stands):
    """The wall bears m g tan(a) / 2, and so does the friction, at most mu m g: here 0.25 m g."""
    structure = rk.structure(
        ladder(floor=LAW), mass=12.0, height=1.0, inertia=4.0, gravity=G, restitution=0.0,
        length=2.0, friction=friction,
    )  # fmt: skip
    lean = np.arctan(0.5)
    initial = {"theta": -lean, "x": 2.0 * np.sin(lean)}
    run = rk.simulate(structure, rk.GroundMotion.none(0.5), initial=initial)
    moved = abs(run["theta"][-1] - run["theta"][0])
    assert (moved < 1e-12) if stands else (moved > 1e-3)
    if stands:
        at = structure.reactions(initial)
        assert at["top_reaction"] == pytest.approx(3.0 * G)
        assert at["foot_friction"] == pytest.approx(-3.0 * G)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("friction", [None, 0.1])
def test_a_block_rebounds_from_a_smooth_stop(friction, restitution):
    """From 1 m away at 3 m/s, at the height of its centroid; friction slows it both ways."""
    structure = stopped(friction, restitution=restitution)
    slows = 2 * G * (friction or 0.0)
    run = rk.simulate(structure, rk.GroundMotion.none(2.0), initial={"x_dot": 3.0})
    landing = next(e for e in run.events if e.kind == "landing")
    arrives = np.sqrt(9.0 - slows)
    assert landing.contact == "stop"
    assert landing.time == pytest.approx(2.0 / (3.0 + arrives), rel=1e-10)
    assert landing.before["x_dot"] == pytest.approx(arrives, rel=1e-10)
    assert landing.after["x_dot"] == pytest.approx(-restitution * arrives, abs=1e-10)
    assert np.abs(run["theta"]).max() < 1e-12
    if restitution == 0.0:
        assert np.abs(run["x"][-1] - 1.0) < 1e-12
    if friction is None:
        back = restitution * arrives * (2.0 - landing.time)
        assert run["x"][-1] == pytest.approx(1.0 - back, abs=1e-9)


def test_a_stop_holds_feet_that_rub_without_their_friction():
    """Pushed to it by half of g: all of it is the stop's; away from it, all is friction."""
    structure = stopped(0.7, length=0.6)
    beside = {"x": 1.0}
    pushed = structure.reactions(beside, ground_acceleration=-0.3 * G)
    assert pushed["stop_reaction"] == pytest.approx(30.0 * G)
    assert pushed["left_friction"] == pushed["right_friction"] == 0.0
    pulled = structure.reactions(beside, ground_acceleration=0.3 * G)
    assert pulled["stop_reaction"] == 0.0
    assert pulled["left_friction"] + pulled["right_friction"] == pytest.approx(30.0 * G)


def test_a_block_stands_at_a_high_stop_by_its_friction():
    """Without friction the stop would turn it about its right foot; with all of it, it stands."""
    structure = stopped(0.2, half_width=0.3, away=0.3, length=1.8)
    run = rk.simulate(structure, rk.GroundMotion.from_array(np.full(101, -4.0), 0.01))
    assert all(np.abs(run[name]).max() == 0.0 for name in run.states)
    at = structure.reactions({}, ground_acceleration=-4.0)
    friction = at["left_friction"] + at["right_friction"]
    assert abs(friction) == pytest.approx(0.2 * 100.0 * G)
    assert at["stop_reaction"] == pytest.approx(400.0 - 20.0 * G)
    assert at["left_reaction"] > 0.0


@pytest.mark.parametrize("slope", [0.2, np.pi / 4, 1.2])
def test_a_disc_stays_in_a_smooth_groove(slope):
    """Each wall bears m g / (2 cos a), and m a_x / (2 sin a) more or less; a spin lasts."""
    disc = rk.structure(
        in_a_groove(), mass=3.0, inertia=0.1, gravity=G, restitution=0.5, slope=slope
    )
    run = rk.simulate(disc, rk.GroundMotion.none(1.0), initial={"theta_dot": 2.0})
    assert not run.events
    assert np.abs(run["x"]).max() == np.abs(run["y"]).max() == 0.0
    assert run["theta"][-1] == pytest.approx(2.0)
    ax = 0.5 * G * np.tan(slope)
    at = disc.reactions({}, ground_acceleration=ax)
    weight, push = 3.0 * G / (2 * np.cos(slope)), 3.0 * ax / (2 * np.sin(slope))
    assert at["left_reaction"] == pytest.approx(weight + push)
    assert at["right_reaction"] == pytest.approx(weight - push)


@pytest.mark.parametrize("restitution", [0.0, 0.4])
def test_no_friction_as_a_number_is_that_of_a_parameter_of_zero(restitution):
    initial = {"theta": 0.15, "x_dot": 0.4}
    given = {"restitution": restitution, "away": 100.0}
    motion = rk.GroundMotion.none(1.5)
    by_number = rk.simulate(stopped(None, **given), motion, initial=initial)
    by_value = rk.simulate(stopped(0.0, **given), motion, initial=initial)
    for name in ("x", "y", "theta"):
        np.testing.assert_allclose(by_number[name][-1], by_value[name][-1], atol=1e-8)
