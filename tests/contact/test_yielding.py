"""Bars and tendons that yield: an element's states switch, its permanent extension is a state.

References are closed forms: an elastic, perfectly plastic oscillator in free flow, a tendon that
goes slack, and the moments of a wall on one of its feet.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.symbolic import Force, Model, Pinned, Rigid, Tie, Unilateral, Yielding, feet, parameter
from tests.contact import declared
from tests.refusals import refused

K = parameter("k", "stiffness", "N/m", "stiffness of a bar")
STRENGTH = parameter("f_y", "strength", "N", "force at which a bar yields")
HARDENING = parameter("k_h", "hardening", "N/m", "hardening of a bar")
PLAY = parameter("l", "play", "m", "how far the tendon moves before it pulls")
PULLED = declared.block().position[0]
"""Of the centroid: what pulls there does not turn the block, which falls meanwhile."""


def bar(**changes) -> Yielding:
    given = {"stiffness": K.symbol, "strength": STRENGTH.symbol, "hardening": HARDENING.symbol}
    return Yielding(**({"name": "bar", "elongation": PULLED} | given | changes))


@cache
def held_block() -> Model:
    """A block with a bar, and with a tendon that pulls once it has moved by the play."""
    of = declared.on_points("held_block", {"tip": (0, 0)}, K, STRENGTH, HARDENING, PLAY)
    tendon = Tie("tendon", PULLED, 100, 8, slack_length=PLAY.symbol)
    return replace(of, elements=(bar(), tendon))


MASS, STIFFNESS, YIELD = 2.0, 50.0, 3.0
FREQUENCY = np.sqrt(STIFFNESS / MASS)


def in_flight(duration: float, start, **changes):
    """The block in free fall, its base's centre a thousand metres up."""
    values = {
        "mass": MASS, "height": 1.0, "inertia": 0.7, "gravity": 9.81, "friction": 0.4,
        "restitution": 0.0, "stiffness": STIFFNESS, "strength": YIELD, "hardening": 0.0,
        "play": 9.0,
    }  # fmt: skip
    block = rk.structure(held_block(), **(values | changes))
    return rk.simulate(block, rk.GroundMotion.none(duration), initial={"y": 1e3, **start})


def switches(run):
    return [(e.contact, e.mode_before, e.mode_after) for e in run.events]


def test_an_elastic_perfectly_plastic_oscillator_has_the_permanent_set_of_its_closed_form():
    """It yields at x = f/k, is stopped by the force alone, and swings about the set then."""
    speed = 1.5
    yields = np.arcsin(YIELD / STIFFNESS * FREQUENCY / speed) / FREQUENCY
    flows = speed * np.cos(FREQUENCY * yields)
    stops = yields + MASS * flows / YIELD
    left = MASS * flows**2 / (2.0 * YIELD)
    run = in_flight(stops + 0.4, {"x_dot": speed})
    assert switches(run) == [
        ("bar", "tendon_slack", "bar_yields_tendon_slack"),
        ("bar", "bar_yields_tendon_slack", "tendon_slack"),
    ]
    assert [e.time for e in run.events] == pytest.approx([yields, stops], rel=1e-9)
    assert run.final["bar_extension"] == pytest.approx(left, rel=1e-9)
    assert run.final["x"] == pytest.approx(
        left + YIELD / STIFFNESS * np.cos(FREQUENCY * 0.4), rel=1e-9
    )
    between = (run.t > yields + 1e-9) & (run.t < stops - 1e-9)
    assert run["bar_force"][between] == pytest.approx(np.full(between.sum(), YIELD), rel=1e-12)
    assert run["bar_elongation"] == pytest.approx(run["x"], abs=1e-15)
    balance = rk.analysis.energy_balance(run)
    assert balance.damping == pytest.approx(YIELD * left, rel=1e-9)
    assert balance.error < 1e-10


def test_a_bar_that_hardens_yields_back_and_loses_its_strength_times_what_flows():
    """Kinematic hardening: the forces at which it yields lie twice the strength apart."""
    hardening = 20.0
    run = in_flight(6.0, {"x_dot": 4.0}, hardening=hardening)
    flows = [e for e in run.events if "bar_yields" in e.mode_after]
    ends = [e for e in run.events if "bar_yields" in e.mode_before]
    assert len(flows) >= 3
    sides = ["back" in e.mode_after for e in flows]
    assert sides == [i % 2 == 1 for i in range(len(flows))]
    for event, back in zip(flows, sides, strict=True):
        z = event.before["bar_extension"]
        force = STIFFNESS * (event.before["x"] - z)
        assert force - hardening * z == pytest.approx(-YIELD if back else YIELD, rel=1e-9)
    for event in ends:
        assert event.before["x_dot"] == pytest.approx(0.0, abs=1e-12)
        assert event.after["bar_extension"] == pytest.approx(
            event.before["bar_extension"], rel=1e-9
        )
    extensions = [0.0, *(e.after["bar_extension"] for e in ends), run.final["bar_extension"]]
    balance = rk.analysis.energy_balance(run)
    assert balance.damping == pytest.approx(YIELD * np.abs(np.diff(extensions)).sum(), rel=1e-8)
    assert balance.error < 1e-9


def test_a_tendon_is_slack_until_its_play_is_gone_and_again_below_its_permanent_extension():
    """The bar gives next to nothing here. Slack, the block moves on at one speed."""
    play, stiffness, strength, speed = 0.25, 100.0, 8.0, 2.0
    run = in_flight(3.0, {"x_dot": speed}, strength=1e-9, play=play)
    events = [e for e in run.events if e.contact == "tendon"]
    frequency = np.sqrt(stiffness / MASS)
    pulls = play / speed
    yields = pulls + np.arcsin(strength / stiffness * frequency / speed) / frequency
    flows = speed * np.cos(frequency * (yields - pulls))
    stops = yields + MASS * flows / strength
    slack = stops + np.pi / (2.0 * frequency)
    assert [e.time for e in events] == pytest.approx([pulls, yields, stops, slack], rel=1e-7)
    assert "tendon_slack" in events[-1].mode_after
    left = MASS * flows**2 / (2.0 * strength)
    assert run.final["tendon_extension"] == pytest.approx(left, rel=1e-7)
    after = run.t > slack
    back = -strength / stiffness * frequency
    assert run["x_dot"][after] == pytest.approx(np.full(after.sum(), back), rel=1e-7)
    assert not run["tendon_force"][after].any()


def test_what_starts_beyond_its_strength_has_been_drawn_out_there():
    run = in_flight(0.3, {"x": 0.2, "x_dot": 0.1})
    drawn = 0.2 - YIELD / STIFFNESS
    assert run["bar_extension"][0] == pytest.approx(drawn, rel=1e-12)
    stops = MASS * 0.1 / YIELD
    end = 0.2 + 0.1 * stops / 2.0
    assert run.events[-1].time == pytest.approx(stops, rel=1e-9)
    assert run.final["x"] == pytest.approx(
        end + YIELD / STIFFNESS * (np.cos((0.3 - stops) * FREQUENCY) - 1.0), rel=1e-9
    )


def test_an_extension_that_leaves_more_than_the_strength_is_refused():
    assert refused(in_flight, 0.3, {"x": 0.2, "bar_extension": 0.05}) == ("bar_extension", 0.05)


@cache
def barred_at_two_points() -> Model:
    """A block on one point, with a bar there and another beside it."""
    of = declared.on_points("barred_at_two_points", {"tip": (0, 0)}, K, STRENGTH)
    beside = declared.placed((1, 0))[1], declared.placed((0, -sp.Rational(1, 100)))[1]
    bars = (Yielding(f"bar_{i}", up, K.symbol, STRENGTH.symbol) for i, up in enumerate(beside))
    return replace(of, elements=tuple(bars))


def test_bars_that_start_drawn_out_let_the_motion_begin():
    """At their strength, rounding said of each at each step whether it was elastic."""
    rng = np.random.default_rng(5)
    for _ in range(30):
        block = rk.structure(
            barred_at_two_points(), mass=1000.0, height=3.0, inertia=3300.0, gravity=9.81,
            friction=0.5, restitution=0.0, stiffness=2e7 * 10 ** rng.uniform(-2, 1),
            strength=2e4 * 10 ** rng.uniform(-2, 1),
        )  # fmt: skip
        start = {"theta": rng.uniform(-0.02, 0.02), "theta_dot": rng.uniform(-0.5, 0.5)}
        start["y"] = rng.uniform(0.2, 0.6)
        options = rk.SolverOptions(max_steps=3000)
        run = rk.simulate(block, rk.GroundMotion.none(0.05), initial=start, options=options)
        assert run.t[-1] == 0.05
        assert run.energy_balance().error < 1e-9


# -- a wall that a tendon brings back upright, and bars at its feet that lose energy

B = parameter("b", "half_width", "m", "half of the width of the wall")
TENDON = parameter("k_t", "tendon_stiffness", "N/m", "stiffness of the tendon")
FORCE = parameter("f_t", "initial_force", "N", "force in the tendon upright")


@cache
def wall_with_bars() -> Model:
    """A wall on feet that never slip, a tendon in its axis, a yielding bar at each foot."""
    place = declared.placed
    top = place((0, 2 * declared.HEIGHT.symbol))
    length = 2 * declared.HEIGHT.symbol
    stretch = sp.sqrt(top[0] ** 2 + top[1] ** 2) - length
    of = declared.on_points("wall_with_bars", {"tip": (0, 0)}, B, K, STRENGTH, TENDON, FORCE)
    return replace(
        of,
        parameters=tuple(p for p in of.parameters if p not in (declared.FRICTION,)),
        contacts=feet(
            gap=lambda s: place((s * B.symbol, 0))[1],
            slip=lambda s: place((s * B.symbol, 0))[0],
            law=Rigid(restitution=declared.RESTITUTION.symbol, friction=None),
        ),
        elements=tuple(
            Yielding(f"bar_{name}", place((s * B.symbol, 0))[1], K.symbol, STRENGTH.symbol)
            for name, s in (("left", -1), ("right", 1))
        ),
        elastic_energy=FORCE.symbol * stretch + TENDON.symbol * stretch**2 / 2,
    )


WALL = {
    "mass": 1000.0, "height": 3.0, "inertia": 3300.0, "gravity": 9.81, "restitution": 0.0,
    "half_width": 1.0, "stiffness": 2e7, "strength": 2e4, "tendon_stiffness": 2e6,
    "initial_force": 6e4,
}  # fmt: skip


def test_a_wall_with_yielding_bars_has_the_loop_of_a_flag_and_comes_back_upright():
    """On the right foot the left bar pulls as it rises and presses as it comes down.

    Its moment, of the accelerations of the wall, is that of weight and tendon with the bar's
    strength added on the way up and taken off on the way down. It stays above zero.
    """
    wall = rk.structure(wall_with_bars(), **WALL)
    options = rk.SolverOptions(output_step=1e-4)
    run = rk.simulate(wall, rk.GroundMotion.none(1.0), initial={"theta_dot": 0.4}, options=options)
    landing = next(e for e in run.events if e.kind == "landing")
    assert landing.mode_before == "right_bar_left_yields_back"
    swing = slice(0, int(np.searchsorted(run.t, landing.time)))
    theta, mode = run["theta"][swing], np.array(run.mode[swing])
    m, h, b = WALL["mass"], WALL["height"], WALL["half_width"]
    corner = b * np.array([1.0 - np.cos(theta), np.sin(theta)])  # of the base's centre
    top = corner + 2.0 * h * np.array([np.sin(theta), np.cos(theta)])
    size = np.hypot(*top)
    pull = WALL["initial_force"] + WALL["tendon_stiffness"] * (size - 2.0 * h)
    lever = top[1] * b / size  # of the line to the anchor about the right foot
    weight = m * 9.81 * (b * np.cos(theta) - h * np.sin(theta))
    bar = WALL["strength"] * 2.0 * b * np.cos(theta)
    about_foot = WALL["inertia"] + m * (b**2 + h**2)
    angular = np.array(
        [
            wall.accelerations({name: run[name][i] for name in run.states}, mode=mode[i])["theta"]
            for i in range(len(theta))
        ]
    )
    moment = -about_foot * angular
    up, down = mode == "right_bar_left_yields", mode == "right_bar_left_yields_back"
    assert min(up.sum(), down.sum()) > 100
    assert moment[up] == pytest.approx((weight + pull * lever + bar)[up], rel=1e-9)
    assert moment[down] == pytest.approx((weight + pull * lever - bar)[down], rel=1e-9)
    assert moment[down].min() > 0.0
    # area of the loop: the bar's strength times what it has flowed, which the balance tells, too
    ends = [e for e in run.events if "_yields" in e.mode_before and e.time <= landing.time]
    drawn = ends[0].after["bar_left_extension"]
    back = drawn - landing.before["bar_left_extension"]
    area = WALL["strength"] * (drawn + back)
    rise = 2.0 * b * np.sin(theta.max())
    assert drawn == pytest.approx(rise - WALL["strength"] / WALL["stiffness"], rel=1e-6)
    energy = sum(
        run[name][swing] for name in ("kinetic_energy", "gravitational_energy", "elastic_energy")
    )
    assert energy[0] - landing_energy(wall, landing) == pytest.approx(area, rel=1e-7)
    assert rk.analysis.energy_balance(run).error < 1e-8


def test_the_pushover_of_a_wall_with_bars_draws_them_out():
    """Weight, tendon and the raised bar at its strength, about the foot, over the load's height.

    The foot stays where it stood upright: the tendon's anchor is fixed to the ground.
    """
    wall = rk.structure(wall_with_bars(), **WALL)
    turned = np.array([0.01, 0.02, -0.02])
    size = np.abs(turned)
    m, h, b = WALL["mass"], WALL["height"], WALL["half_width"]
    across, up = (
        b * (1 - np.cos(size)) + 2 * h * np.sin(size),
        b * np.sin(size) + 2 * h * np.cos(size),
    )
    length = np.hypot(across, up)
    pull = WALL["initial_force"] + WALL["tendon_stiffness"] * (length - 2 * h)
    moment = m * 9.81 * (b * np.cos(size) - h * np.sin(size)) + pull * up * b / length
    moment += WALL["strength"] * 2.0 * b * np.cos(size)
    lever = h * np.cos(size) + b * np.sin(size)
    assert wall.pushover(turned) == pytest.approx(np.sign(turned) * moment / lever, rel=1e-9)


def landing_energy(wall, landing) -> float:
    return sum(wall.energies(landing.before, mode=landing.mode_before).values())


BESIDE = {
    "element 'bar_left'": {},
    "force 'push'": {"elements": (), "forces": (Force("push", 1, PULLED),)},
    "internal variable 'pull'": {"elements": (), "rates": {declared.PULL: -declared.PULL.symbol}},
}


@pytest.mark.parametrize("what", BESIDE)
def test_what_pinned_feet_have_no_place_for_is_refused_with_the_law_that_has(what):
    """Bars that yield, forces and internal variables: their equations would lack them."""
    pinned = tuple(replace(c, law=Pinned()) for c in wall_with_bars().contacts)
    with pytest.raises(ValueError, match=rf"{what}.*Rigid\(restitution=0, friction=None"):
        replace(wall_with_bars(), contacts=pinned, **BESIDE[what])


def test_the_page_shows_the_force_the_states_and_the_rate():
    text = held_block().markdown()
    assert "| $z_{bar}$ | `bar_extension` | m | permanent extension of bar |" in text
    assert "0 while `bar` is elastic, 1 while it yields in tension, -1" in text
    assert "-1 while it is slack" in text
    assert r"S_{\mathrm{bar}} &= k (h \sin\theta + x - z_{bar})" in text
    assert "it is elastic while its force less $k_{h} z_{bar}$ is below $f_{y}$" in text
    assert r"\dot{z_{bar}} &=" in text
    assert "`bar` begins or ceases to yield or yields in compression" in text


def test_elements_that_yield_and_that_press_stand_in_one_model():
    of = replace(
        held_block(), elements=(*held_block().elements, Unilateral("pad", -PULLED, K.symbol))
    )
    names = of.modes.names
    assert len(names) == 4 * 3 * 3 * 2  # the tip is open, sticks, or slips to either side
    assert "tip_bar_yields_tendon_slack_pad" in names


REFUSED = {
    "no strength": ({"strength": sp.S.Zero}, "'bar': strength is 0: give a positive one"),
    "a negative one": ({"strength": -STRENGTH.symbol}, "element 'bar': strength is -f_y: it is"),
    "a spring of no stiffness": ({"stiffness": 0}, "stiffness is 0: give a positive one"),
    "text": ({"elongation": "x"}, "elongation is 'x'"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_bar_is_refused(what):
    changes, told = REFUSED[what]
    with pytest.raises(ValueError, match=told):
        bar(**changes)


def test_a_bar_that_nothing_stretches_and_a_name_twice_are_refused():
    with pytest.raises(ValueError, match="element 'bar' is l, which no coordinate changes"):
        replace(held_block(), elements=(bar(elongation=PLAY.symbol),))
    with pytest.raises(ValueError, match="declared twice: bar"):
        replace(held_block(), elements=(bar(), bar()))


def test_a_strength_of_zero_is_refused_where_it_is_given():
    module = module_text(held_block())
    assert "the strength of element 'bar'" in module
