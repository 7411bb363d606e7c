"""States of first order: a Maxwell element between a wall and a block that rocks, slides and flies.

References are the closed form of a linear motion (a matrix exponential) and a motion about one foot
written by hand and integrated by scipy.
"""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import simpson, solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.codes import OPEN, STICK
from rockeom.integrator.texts import load_text
from rockeom.symbolic import Force, internal_variable
from tests.contact import declared

MASS, HEIGHT, INERTIA, GRAVITY, WIDTH = 2.0, 1.0, 0.7, 9.81, 0.3
STIFFNESS, RELAXATION = 50.0, 0.8


def braced(**changes):
    values = {
        "mass": MASS, "height": HEIGHT, "inertia": INERTIA, "gravity": GRAVITY, "friction": 0.4,
        "restitution": 0.0, "half_width": WIDTH, "stiffness": STIFFNESS, "relaxation": RELAXATION,
        "attached": HEIGHT,
    }  # fmt: skip
    return rk.structure(declared.braced_block(), **(values | changes))


def moved(start, duration: float, friction: float = 0.0) -> np.ndarray:
    """(x, x', z) after a time, of the mass alone that the element and a constant force pull."""
    matrix = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0 / MASS, friction / MASS],
            [0.0, STIFFNESS, -1.0 / RELAXATION, 0.0],
            [0.0, 0.0, 0.0, 0.0],
        ]
    )
    return (expm(duration * matrix) @ [*start, 1.0])[:3]


def test_a_mass_in_flight_moves_as_the_matrix_exponential_of_a_maxwell_element_says():
    """At the centroid the element does not turn the block: it falls as a point does."""
    start = {"x": 0.02, "y": 1.0, "theta": 0.0, "x_dot": 1.0, "y_dot": 0.0, "pull": 0.5}
    run = rk.simulate(braced(), rk.GroundMotion.none(0.4), initial=start, mode="flight")
    assert (run.outcome, len(run.events)) == (rk.Outcome.COMPLETED, 0)
    x, speed, pull = moved([0.02, 1.0, 0.5], 0.4)
    wanted = {
        "x": x, "x_dot": speed, "pull": pull, "theta": 0.0,
        "y": 1.0 - GRAVITY * 0.4**2 / 2, "y_dot": -GRAVITY * 0.4,
        # z' = k x' - z/tau, integrated once
        "pull_integral": RELAXATION * (STIFFNESS * (x - 0.02) - (pull - 0.5)),
    }  # fmt: skip
    for name, value in wanted.items():
        assert run.final[name] == pytest.approx(value, rel=1e-9, abs=1e-12), name


def test_a_sweep_of_a_block_on_one_point_is_its_single_motions():
    """Of four modes: so few that lanes would pay, if they could follow points."""
    values = {"mass": MASS, "height": HEIGHT, "inertia": INERTIA, "gravity": GRAVITY}
    values |= {"friction": 0.4, "restitution": 0.2, "stiffness": 50.0, "relaxation": 0.8}
    block, still = rk.structure(declared.pulled_block(), **values), rk.GroundMotion.none(0.5)

    def case(speed):
        return rk.Case(block, still, initial={"x_dot": speed, "theta": 0.1})

    speeds = [0.1, 0.5]
    together = rk.simulate_many(
        case, {"speed": speeds}, sweep_options=rk.SweepOptions(progress=False)
    )
    for speed in speeds:
        run = rk.simulate(block, still, initial=case(speed).initial)
        ends = together.sel(speed=speed)
        assert str(ends.outcome.item()) == str(run.outcome)
        assert ends.final.values.tolist() == [*run.final.values()]


def test_a_force_that_friction_holds_relaxes_and_moves_nothing():
    run = rk.simulate(braced(attached=0.0), rk.GroundMotion.none(2.0), initial={"pull": 7.0})
    assert not run.events
    assert set(run.mode) == {"both"}
    assert run["pull"] == pytest.approx(7.0 * np.exp(-run.t / RELAXATION), rel=1e-9)
    assert run["x"] == pytest.approx(np.zeros(len(run.t)), abs=1e-15)


def test_a_force_above_friction_draws_the_block_until_it_sticks():
    """It slides to the left, friction to the right, until its velocity is zero; then z relaxes."""
    run = rk.simulate(braced(attached=0.0), rk.GroundMotion.none(2.0), initial={"pull": 10.0})
    friction = 0.4 * MASS * GRAVITY
    stop = brentq(lambda t: moved([0.0, 0.0, 10.0], t, friction)[1], 1e-3, 1.0, xtol=1e-14)
    x, _, pull = moved([0.0, 0.0, 10.0], stop, friction)
    begins, event = run.events
    assert (begins.time, begins.kind) == (0.0, "slip begins")
    assert (event.kind, event.mode_before, event.mode_after) == (
        "slip ends", "both_slides_left", "both",
    )  # fmt: skip
    assert event.time == pytest.approx(stop, rel=1e-9)
    assert event.before["pull"] == event.after["pull"] == pytest.approx(pull, rel=1e-9)
    assert run.final["x"] == pytest.approx(x, rel=1e-9)
    relaxed = pull * np.exp((stop - 2.0) / RELAXATION)
    assert run.final["pull"] == pytest.approx(relaxed, rel=1e-9)


ANCHOR = 2.0 * HEIGHT
ROCKING = {"theta": 0.1, "pull": 0.5}


def rocking():
    """From leaning on the right foot, which never slips, through several landings."""
    block = braced(friction=5.0, attached=ANCHOR)
    options = rk.SolverOptions(output_step=1e-3)
    return rk.simulate(block, rk.GroundMotion.none(3.0), initial=ROCKING, options=options)


def test_a_block_on_one_foot_rocks_as_the_equation_written_by_hand():
    """Angular momentum about the foot, the element's lever from the place of its anchor."""
    about_foot = INERTIA + MASS * (WIDTH**2 + HEIGHT**2)

    def motion(_t, y):
        turned, speed, pull = y
        lever = WIDTH * np.sin(turned) + ANCHOR * np.cos(turned)
        weight = MASS * GRAVITY * (WIDTH * np.cos(turned) - HEIGHT * np.sin(turned))
        return [
            speed,
            -(weight + pull * lever) / about_foot,
            STIFFNESS * lever * speed - pull / RELAXATION,
        ]

    def upright(_t, y):
        return y[0]

    upright.terminal = True
    reference = solve_ivp(
        motion, (0.0, 10.0), [0.1, 0.0, 0.5], "DOP853", events=upright, rtol=1e-12, atol=1e-13
    )
    landing = rocking().events[0]
    assert (landing.kind, landing.mode_before) == ("landing", "right")
    assert landing.time == pytest.approx(reference.t[-1], rel=1e-9)
    found = [landing.before["theta_dot"], landing.before["pull"]]
    assert found == pytest.approx(reference.y[1:, -1], rel=1e-9)


def test_energy_goes_into_the_spring_and_the_damper_and_a_landing_asks_neither():
    """z**2/(2 k) is stored and z**2/(k tau) lost a second; z goes on over a landing bit by bit."""
    run = rocking()
    landings = [e for e in run.events if e.kind == "landing"][:4]
    assert {e.mode_after for e in landings} == {"left", "right"}
    energy = run["kinetic_energy"] + run["gravitational_energy"]
    energy += run["pull"] ** 2 / (2.0 * STIFFNESS)
    lost = run["pull"] ** 2 / (STIFFNESS * RELAXATION)
    times = [0.0, *(e.time for e in landings)]
    for start, end in pairwise(times):
        first = np.searchsorted(run.t, start, "right") - 1
        last = np.searchsorted(run.t, end, "left")
        between = slice(first, last + 1)
        taken = simpson(lost[between], x=run.t[between])
        assert energy[first] - energy[last] == pytest.approx(taken, abs=1e-10)
        assert taken > 1e-3
    for event in landings:
        assert event.before["pull"] == event.after["pull"] != 0.0
        assert event.after["theta_dot"] != event.before["theta_dot"]


def test_the_energy_balance_counts_what_the_force_of_an_element_took():
    """What its spring has stored is no energy of the declaration: it is with what the damper lost.

    Both together are the work done on the element, by the equations of its two parts.
    """
    run = rocking()
    balance = rk.analysis.energy_balance(run)
    stored = (run.final["pull"] ** 2 - ROCKING["pull"] ** 2) / (2.0 * STIFFNESS)
    lost = 0.0
    for start, end in pairwise(np.unique([0.0, *(e.time for e in run.events), run.t[-1]])):
        t = np.linspace(start, end, 201)  # the force goes on over events, and its rate jumps
        lost += simpson(run.at(t)["pull"] ** 2, x=t) / (STIFFNESS * RELAXATION)
    assert balance.damping == pytest.approx(stored + lost, rel=1e-8)
    assert balance.error < 1e-10


def test_statics_leaves_an_internal_variable_as_it_is():
    """At no force of the element the pushover is the rigid block's."""
    turned = np.array([0.05, 0.1, 0.2])
    arm = WIDTH * np.cos(turned) - HEIGHT * np.sin(turned)
    lever = HEIGHT * np.cos(turned) + WIDTH * np.sin(turned)
    found = braced(friction=5.0).pushover(turned)
    assert found == pytest.approx(MASS * GRAVITY * arm / lever, rel=1e-12)


# -- in what way it is declared ---------------------------------------------------------------

K, TAU, PULL, LIFT = declared.K, declared.TAU, declared.PULL, declared.LIFT
PLACE = internal_variable("zeta", "place", "m", "what the damper has moved")
COORDINATES = (declared.X, declared.Y, declared.THETA)


def on_a_tip(**changes):
    """The block on one point, nothing but its weight acting, and what is changed."""
    return replace(declared.pulled_block(), **({"forces": (), "rates": {}} | changes))


def test_a_maxwell_element_is_one_by_its_force_and_by_the_place_of_its_damper():
    """z = k (w - zeta): a force with a rate, and an energy k (w - zeta)**2/2 move alike."""
    spring = LIFT - PLACE.symbol
    by_energy = on_a_tip(
        elastic_energy=K.symbol * spring**2 / 2, rates={PLACE: spring / TAU.symbol}
    )
    assert (by_energy.states[3], by_energy.states[-1]) == ("place_integral", "place")
    models = declared.pulled_block(), by_energy
    force, energy = (load_text(m.name, module_text(m)) for m in models)
    assert (*energy.STATE_UNITS[3::4], *force.STATE_UNITS[3::4]) == ("m s", "m", "N s", "N")
    rng, symbols = np.random.default_rng(5), [c.position for c in COORDINATES]
    at = sp.lambdify([*symbols, *(p.symbol for p in by_energy.parameters)], LIFT)
    for mode in range(len(force.MODES)):
        values = rng.uniform(0.5, 1.5, len(force.PARAMETERS))
        y, ground = rng.normal(0.0, 0.4, 8), rng.normal(0.0, 1.0, 2)
        if force.POINT_STATES[mode][0] != OPEN:
            y[1] = y[5] = 0.0
        if force.POINT_STATES[mode][0] == STICK:
            y[4] = 0.0
        pulled = y.copy()
        pulled[7] = values[-2] * (at(*y[:3], *values) - y[7])
        one, other, told = np.zeros(8), np.zeros(8), np.zeros(3)
        energy.rates(mode, y, energy.prepare(values), *ground, one)
        force.rates(mode, pulled, force.prepare(values), *ground, other)
        assert other[:3] == pytest.approx(one[:3], rel=1e-12)
        assert other[4:7] == pytest.approx(one[4:7], rel=1e-9, abs=1e-12)
        assert (one[3], other[3]) == (y[7], pulled[7])
        speed = (pulled[7] + other[7] * values[-1]) / (values[-2] * values[-1])
        assert values[-2] * (speed - one[7]) == pytest.approx(other[7], rel=1e-12)
        energy.energies(mode, y, energy.prepare(values), told)
        assert told[2] == pytest.approx(pulled[7] ** 2 / (2 * values[-2]), rel=1e-12)


def test_the_page_shows_the_rate_and_the_force():
    text = declared.pulled_block().markdown()
    assert "| $z$ | `pull` | N |" in text
    assert r"Q_{\mathrm{element}} &= -z,\quad w_{\mathrm{element}} = h \cos\theta + y" in text
    _, _, rates = text.partition("## Internal variables")
    (equation,) = re.findall(r"\\dot\{z\} &= (.*)", rates)
    assert set(equation.split()) >= {"k", r"\dot{y}", r"\dot{\theta}", r"\frac{z}{\tau}"}


HELD = {PULL: -PULL.symbol}
REFUSED = {
    "a coordinate's rate": ({"rates": {declared.X: sp.S.Zero}}, "holds the coordinate 'x'"),
    "a symbol": ({"rates": {PULL.symbol: sp.S.Zero}}, "internal_variable"),
    "no mapping": ({"rates": [PULL]}, "give a mapping"),
    "text": ({"rates": {PULL: "-z"}}, "the rate of 'pull' is '-z'"),
    "an unknown symbol": (
        {"rates": {PULL: sp.Symbol("q") - PULL.symbol}}, "rate of 'pull' contains undeclared .* q",
    ),
    "an acceleration": (
        {"rates": {PULL: declared.X.acceleration}}, "rate of 'pull' contains the acceleration",
    ),
    "a variable without a rate": (
        {"forces": [Force("element", PULL.symbol, declared.X.position)]}, "undeclared symbols z",
    ),
    "a symbol of two things": (
        {"rates": {replace(PULL, symbol=K.symbol): sp.S.Zero}}, "the symbol k is declared twice",
    ),
    "a name of two things": (
        {"rates": {replace(PULL, name="stiffness"): sp.S.Zero}}, "declared twice: stiffness",
    ),
    "the name of an integral": (
        {"rates": {PULL: sp.S.Zero, replace(PLACE, name="pull_integral"): sp.S.Zero}},
        "declared twice: pull_integral",
    ),
    "a name that is none": ({"rates": {replace(PULL, name="z 1"): sp.S.Zero}}, "underscores"),
    "a gap with a memory": (
        {
            "rates": HELD,
            "contacts": [
                replace(c, gap=c.gap + PULL.symbol) for c in on_a_tip().contacts
            ],
        },
        "gap of contact 'tip' contains the internal variable z",
    ),
    "a force that nothing moves": (
        {"forces": [Force("element", K.symbol, TAU.symbol)]}, "the force does no work",
    ),
    "a displacement with a rate": (
        {"forces": [Force("element", K.symbol, declared.X.velocity)]},
        "displacement of force 'element' contains the velocity",
    ),
    "text for a force": ({"forces": ["element"]}, "forces holds 'element'"),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_a_declaration_is_refused(what):
    changes, told = REFUSED[what]
    with pytest.raises(ValueError, match=told):
        on_a_tip(**changes)


# -- other memories than that of a Maxwell element


def test_radiation_into_the_ground_and_the_speed_of_the_last_passage_are_smooth_rates():
    """A cone's memory of the base's velocity, and a mean of the rotation's that forgets.

    z1' = (y' - z1)/tau presses with k tau z1 beside the weight; z2' = (|theta'| - z2)/tau. The
    rates of all states are those of the equations, which are linear in flight.
    """
    y, k, tau = declared.Y, K.symbol, TAU.symbol
    memory = internal_variable("z_1", "memory", "m/s", "velocity that the ground remembers")
    speed = internal_variable("z_2", "passage_speed", "rad/s", "speed of the last passages")
    model = on_a_tip(
        forces=[Force("radiated", -k * tau * memory.symbol, y.position)],
        rates={
            memory: (y.velocity - memory.symbol) / tau,
            speed: (sp.Abs(declared.THETA.velocity) - speed.symbol) / tau,
        },
    )
    module = load_text(model.name, module_text(model))
    values = dict(zip(module.PARAMETERS, np.full(len(module.PARAMETERS), 0.4), strict=True))
    values |= {"mass": MASS, "stiffness": STIFFNESS, "relaxation": RELAXATION}
    p = module.prepare(np.array([values[n] for n in module.PARAMETERS]))
    state = {"y": 1.0, "y_dot": 0.7, "memory": 0.3, "passage_speed": 0.2, "theta_dot": -0.5}
    given = np.array([state.get(n, 0.0) for n in module.STATES])
    found = np.zeros(len(given))
    module.rates(module.MODES.index("flight"), given, p, 0.0, 0.0, found)
    rate = dict(zip(module.STATES, found, strict=True))
    assert rate["memory"] == pytest.approx((0.7 - 0.3) / RELAXATION, rel=1e-14)
    assert rate["passage_speed"] == pytest.approx((0.5 - 0.2) / RELAXATION, rel=1e-14)
    # at theta = 0 the spin lifts the centroid's height h by -h theta'^2 alone: M y'' as a point's
    pressed = -values["gravity"] - STIFFNESS * RELAXATION * 0.3 / MASS
    assert rate["y_dot"] == pytest.approx(pressed + values["height"] * 0.25, rel=1e-12)
