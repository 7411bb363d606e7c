"""Impact laws of points that touch at once: closed forms, springs in time, energy, errors."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from rockeom.codes import CONTACT_LAWS
from rockeom.integrator.linking import linked
from rockeom.symbolic import Contact, Rigid, parameter

from .laws_alone import impulses

FOLLOWED = ("poisson", "lzb", "pairwise")
"""Laws that are followed through an impact, in which a slip may turn."""


class Landing:
    """A block on level feet, left and right, whose base is level: rates (x, y, theta) before."""

    def __init__(self, b, h, before, inertia=None):
        self.inertia = (b * b + h * h) / 3.0 if inertia is None else inertia
        self.before = np.asarray(before, float)
        self.feet = np.array([[0, 1, b], [1, 0, -h], [0, 1, -b], [1, 0, -h]], float)
        self.spread = self.feet.T / np.array([1.0, 1.0, self.inertia])[:, None]
        self.coupling = self.feet @ self.spread
        self.rates = self.feet @ self.before

    def after(self, law, e, mu, k=None):
        """Rates (x, y, theta) after it."""
        pairs = impulses(law, self.coupling, self.rates[::2], self.rates[1::2], e, mu, k)
        return self.before + self.spread @ np.column_stack(pairs).ravel()

    def energy(self, rates):
        return 0.5 * (rates[0] ** 2 + rates[1] ** 2 + self.inertia * rates[2] ** 2)


def rocking(b, h, theta_dot, inertia=None, sticks=False):
    """The landing of the left foot of a block that turns about the right one."""
    before = (h * theta_dot if sticks else 0.0, b * theta_dot, theta_dot)
    return Landing(b, h, before, inertia)


def random_landing(rng):
    """Feet of which one rests, or both close, slowly or fast."""
    b, h = rng.uniform(0.1, 1.0, 2)
    down, theta_dot = -rng.uniform(0.0, 1.0), rng.normal()
    down = min(down, -b * abs(theta_dot)) if rng.random() < 0.5 else -b * abs(theta_dot)
    return Landing(b, h, (rng.normal(), down, theta_dot), rng.uniform(0.02, 0.5))


@pytest.mark.parametrize("law", CONTACT_LAWS)
@pytest.mark.parametrize("friction", [0.0, 0.6])
def test_a_block_dropped_flat_stays_level(law, friction):
    """Both corners land at one instant, and bounce with e of the speed; neither is the first."""
    block = rk.structure(
        rk.derive("sliding_block", law=law), half_width=0.2, height=0.5, mass=1.0,
        inertia=0.29 / 3, friction=friction, restitution=0.5,
    )  # fmt: skip
    run = rk.simulate(block, rk.GroundMotion.none(0.4), initial={"y": 0.1})
    assert abs(run.extremes("theta").peak) < 1e-12
    falls = math.sqrt(2 * 0.1 * rk.RigidBlock(half_width=1, half_height=1).gravity)
    assert run.impacts[0].after["y_dot"] == pytest.approx(0.5 * falls, rel=1e-9)


# -- closed forms ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("law", "theta_dot"), [("poisson", 3.30460808), ("lzb", -0.49706), ("pairwise", -1.414)]
)
def test_a_second_corner_lands(law, theta_dot):
    """Without friction: Newton's law and Poisson's turn the block back, springs let it turn on."""
    after = rocking(0.5, 0.25, -4.1307601).after(law, 0.8, 0.0)
    assert after[2] == pytest.approx(theta_dot, abs=6e-4 if law == "pairwise" else 6e-6)


@pytest.mark.parametrize("law", FOLLOWED)
@pytest.mark.parametrize("b", [0.1, 0.5, 0.7])
def test_feet_that_stick_without_restitution_are_housners(law, b):
    h = 0.5
    landing = rocking(b, h, -1.3, sticks=True)
    square, inertia = h * h - b * b, landing.inertia
    ratio = max((inertia + square) / (inertia + h * h + b * b), 0.0)  # else both stay closed
    after = landing.after(law, 0.0, 30.0)
    assert after[2] == pytest.approx(-1.3 * ratio, abs=1e-11)


def of_routh(corner, e, mu, energetic):
    """(P, Q) of a single point (D_nn, D_nt, D_tt, v, w), w > 0, that slips, stops and sticks."""
    nn, nt, tt, v, w = corner
    slope = nn - mu * nt  # of v as it slips to the right, and the impulse that stops the slip
    stop = w / (mu * tt - nt)
    assert slope > 0.0
    assert abs(nt) <= mu * tt  # it sticks then
    sticks = nn - nt * nt / tt
    if v + slope * stop >= 0.0:  # it stops in expansion
        pressed = -v / slope
        work, at_stop = v * v / (2.0 * slope), v + slope * stop
        done = at_stop**2 / (2.0 * slope)
        rest = e * e * work - done
        last = (-at_stop + math.sqrt(at_stop**2 + 2.0 * sticks * rest)) / sticks
    else:
        at_stop = v + slope * stop
        pressed = stop - at_stop / sticks
        work = (v * v - at_stop**2) / (2.0 * slope) + at_stop**2 / (2.0 * sticks)
        last = (-at_stop + e * math.sqrt(2.0 * sticks * work)) / sticks
    total = stop + last if energetic else (1.0 + e) * pressed
    return total, -mu * stop - nt / tt * (total - stop)


@pytest.mark.parametrize("law", FOLLOWED)
@pytest.mark.parametrize("w", [0.05, 0.12])
def test_a_slip_stops_within_the_impact_of_one_corner(law, w):
    """Routh's method; the slip stops as the gap closes still, or as it opens."""
    nn, nt, tt, v, e, mu = 2.0, 0.5, 1.5, -1.0, 0.7, 0.45
    wanted = of_routh((nn, nt, tt, v, w), e, mu, law != "poisson")
    (found,), (along,) = impulses(law, [[nn, nt], [nt, tt]], [v], [w], e, mu)
    assert (found, along) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("law", FOLLOWED)
def test_a_slip_turns_within_the_impact_of_one_corner(law):
    """Little friction does not hold it there: it slips back. Without restitution, where v = 0."""
    nn, nt, tt, v, w, mu = 2.0, 0.9, 1.5, -1.0, 0.1, 0.3
    stop = w / (mu * tt + nt)  # the slip is to the left, and both terms slow it
    left = v + (nn + mu * nt) * stop
    back = -left / (nn - mu * nt)
    pair = impulses(law, [[nn, nt], [nt, tt]], [v], [-w], 0.0, mu)
    assert np.ravel(pair) == pytest.approx([stop + back, mu * (stop - back)], rel=1e-12)


BALLS = np.array([[2.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 2.0, 0.0], [0, 0, 0, 1]])
"""D of three equal balls in a row, of mass 1: contacts 1-2 and 2-3."""


def balls_after(law, k):
    """Velocities after the first ball, of velocity 1, has met two at rest, e = 1."""
    (first, second), _ = impulses(law, BALLS, [-1.0, 0.0], [0.0, 0.0], 1.0, 0.0, k)
    return 1.0 - first, first - second, second


def test_three_balls():
    """Of stiffness ratio 0 they meet in pairs; infinite, the two at rest move as one; in between
    by springs in time: x_1'' = -2 x_1 + x_2, x_2'' = x_1 - 2 x_2 of frequencies 1 and sqrt(3).
    """
    assert balls_after("pairwise", 1.0) == pytest.approx((0.0, 0.0, 1.0), abs=1e-14)
    assert balls_after("lzb", [1e8, 1.0]) == pytest.approx((0.0, 0.0, 1.0), abs=1e-3)
    assert balls_after("lzb", [1.0, 1e6]) == pytest.approx((-1 / 3, 2 / 3, 2 / 3), abs=2e-3)
    root = math.sqrt(3.0)

    def x_1(t):
        return 0.5 * math.sin(t) + 0.5 / root * math.sin(root * t)

    low, high = 2.0, math.pi  # the first contact opens
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if x_1(middle) > 0.0 else (low, middle)
    x = 0.5 * math.sin(low) - 0.5 / root * math.sin(root * low)
    v_1 = 0.5 * math.cos(low) + 0.5 * math.cos(root * low)
    v_2 = 0.5 * math.cos(low) - 0.5 * math.cos(root * low)
    ends = math.hypot(v_2, math.sqrt(2.0) * x)  # the second contact, alone, gives back all
    second = (v_2 + ends) / 2.0  # its impulse from then on
    first_ball = balls_after("lzb", 1.0)
    gaps = first_ball[1] - first_ball[0], first_ball[2] - first_ball[1]
    assert gaps == pytest.approx((-v_1 - second, ends), rel=1e-11)


# -- springs in time ------------------------------------------------------------------------------


def by_springs(landing, e, k):
    """Rates after a landing without friction: bilinear springs, integrated in time."""
    coupling = landing.coupling[::2, ::2]
    v, force, total = landing.rates[::2].copy(), np.zeros(2), np.zeros(2)
    for _ in range(200):
        acting = coupling @ force
        closes = (v < -1e-11) | ((np.abs(v) <= 1e-11) & (acting < 0.0))
        active = closes | (force > 0.0)
        if not active.any():
            break
        stiff = np.where(active, np.where(closes, k, k / e**2), 0.0)

        def rates(_, z, stiff=stiff):
            return np.concatenate([coupling @ z[2:4], -stiff * z[:2], z[2:4]])

        events = []
        for i in range(2):
            events.append(lambda t, z, i=i, s=-1.0 if closes[i] else 1.0: s * z[i] + 1e-13)
            if active[i] and not closes[i]:
                events.append(lambda t, z, i=i: z[2 + i] + 1e-13)
        for event in events:
            event.terminal, event.direction = True, -1.0
        found = solve_ivp(
            rates, (0.0, 100.0), np.concatenate([v, force, np.zeros(2)]), method="DOP853",
            events=events, rtol=1e-12, atol=1e-14,
        )  # fmt: skip
        v, force, more = found.y[:2, -1], np.maximum(found.y[2:4, -1], 0.0), found.y[4:, -1]
        force[force < 1e-11] = 0.0
        total += more
    return landing.before + landing.spread[:, ::2] @ total


@pytest.mark.parametrize("seed", range(6))
def test_impulses_grow_as_those_of_springs_in_time(seed):
    rng = np.random.default_rng(seed)
    landing, e, k = random_landing(rng), rng.uniform(0.4, 1.0, 2), rng.uniform(0.3, 3.0, 2)
    after = landing.after("lzb", e, 0.0, k)
    np.testing.assert_allclose(after, by_springs(landing, e, k), atol=1e-8)


def test_a_slip_that_turns_and_turns_back_within_a_step_is_not_lost():
    """The rate that springs give whose motion in time is a sum of exponentials."""
    half_width, height = 0.8242213988807587, 0.20087511902614064
    left, slip = -8.062535379039, 0.02004716048779
    theta_dot = 0.5 * left / half_width
    before = (slip + height * theta_dot, 0.5 * left, theta_dot)
    landing = Landing(half_width, height, before)
    after = landing.after("lzb", 0.2614885914737449, 0.1780249489438728)
    assert after[2] == pytest.approx(-0.592909472617, abs=1e-11)


# -- what holds for all landings ------------------------------------------------------------------


@pytest.mark.parametrize("law", FOLLOWED)
def test_landings_lose_energy_and_open_gaps(law):
    """With friction, and restitution of each foot; by Poisson's law without friction."""
    rng = np.random.default_rng(1)
    for _ in range(60):
        landing, e = random_landing(rng), rng.choice([0.0, 0.05, 0.4, 1.0], 2)
        mu = 0.0 if law == "poisson" else rng.choice([0.0, 0.2, 0.8])
        after = landing.after(law, e, mu)
        before = landing.energy(landing.before)
        assert landing.energy(after) <= before * (1.0 + 1e-11)
        assert (landing.feet[::2] @ after).min() > -1e-10 * math.sqrt(before)


def test_poissons_law_may_gain_energy_with_friction_at_two_feet():
    landing = Landing(0.2195, 0.5996, (0.2076, -0.1666, 0.759), 0.04148)
    gained = landing.energy(landing.after("poisson", 1.0, 0.6)) / landing.energy(landing.before)
    assert gained > 1.2
    for law in ("lzb", "pairwise"):
        assert landing.energy(landing.after(law, 1.0, 0.6)) <= landing.energy(landing.before)


@pytest.mark.parametrize("law", FOLLOWED)
def test_the_order_of_points_and_the_unit_of_velocity_do_not_matter(law):
    rng, turned = np.random.default_rng(2), np.array([2, 3, 0, 1])
    for _ in range(10):
        landing, e, k = random_landing(rng), rng.uniform(0.1, 0.9, 2), rng.uniform(0.5, 2.0, 2)
        d, (v, w) = landing.coupling, (landing.rates[::2], landing.rates[1::2])
        found = np.array(impulses(law, d, v, w, e, 0.3, k))
        other = np.array(
            impulses(law, d[np.ix_(turned, turned)], v[::-1], w, e[::-1], 0.3, k[::-1])
        )
        faster = np.array(impulses(law, d, 7.0 * v, 7.0 * w, e, 0.3, k))
        np.testing.assert_allclose(other[0, ::-1], found[0], atol=1e-11)
        assert other[1].sum() == pytest.approx(found[1].sum(), abs=1e-11)
        np.testing.assert_allclose(faster, 7.0 * found, atol=1e-10)


# -- motions --------------------------------------------------------------------------------------


def block(law, **given):
    size = {"half_width": 0.5, "height": 0.4, "mass": 1.0, "inertia": 0.41 / 3.0}
    contact = {"friction": 0.3, "restitution": 0.6}
    return rk.structure(rk.derive("sliding_block", law=law), **size | contact | given)


@pytest.mark.parametrize("law", ["lzb", "moreau"])
def test_a_block_let_go_comes_to_rest(law):
    run = rk.simulate(block(law), rk.GroundMotion.none(4.0), initial={"theta": 0.25})
    balance = run.energy_balance()
    assert run.outcome is rk.Outcome.CAME_TO_REST
    assert balance.error < 1e-10
    assert f"Impact law: {law}. The impacts lost" in run.summary()
    assert balance.impact_gains == run.impacts.energy_gains.sum() == 0.0


def test_a_landing_in_a_motion_is_that_of_the_law_alone():
    """Its states are those of the base's centre, below the centroid."""
    event = rk.simulate(block("lzb"), rk.GroundMotion.none(1.0), initial={"theta": 0.25}).impacts[0]
    x, y, theta = (event.before[f"{name}_dot"] for name in ("x", "y", "theta"))
    after = Landing(0.5, 0.4, (x + 0.4 * theta, y, theta)).after("lzb", 0.6, 0.3)
    found = [event.after[f"{name}_dot"] for name in ("x", "y", "theta")]
    assert abs(event.before["theta"]) < 1e-12
    assert found == pytest.approx([after[0] - 0.4 * after[2], after[1], after[2]], abs=1e-10)


def test_derivatives_are_those_of_differences_through_impacts():
    still, start = rk.GroundMotion.none(0.8), {"theta": 0.25}
    answers, step = ["impact 1 theta_dot after", "impact 4 theta_dot"], 1e-5
    case = rk.Case(block("lzb"), still, initial=start)
    found = rk.sensitivity(case, of=answers, to=["friction", "restitution"])
    for column, (name, value) in enumerate({"friction": 0.3, "restitution": 0.6}.items()):
        ends = [
            [run.impacts[0].after["theta_dot"], run.impacts[3].before["theta_dot"]]
            for x in (value - step, value + step)
            for run in [rk.simulate(block("lzb", **{name: x}), still, initial=start)]
        ]
        slopes = (np.array(ends[1]) - np.array(ends[0])) / (2.0 * step)
        np.testing.assert_allclose(found.derivatives[:, column], slopes, rtol=1e-5)


# -- texts and errors -----------------------------------------------------------------------------


def test_only_structures_with_another_law_have_its_text():
    def texts(module):
        roots, modules, _ = linked(module, "DOP853")
        return {Path(text.name).stem for text in modules.closure(roots)}

    plain = block("newton").module
    assert not hasattr(plain, "IMPACT_LAW")
    assert not {"impacts", "friction", "springs"} & texts(plain)
    for law in ("moreau", "lzb"):
        module = block(law).module
        assert CONTACT_LAWS[law] == module.IMPACT_LAW
        assert {"impacts", "friction", "springs"} <= texts(module)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"law": "lbz"}, "law Rigid: law is 'lbz' (did you mean"),
        ({"restitution": -0.1}, "law Rigid: restitution is -0.1: it is"),
        ({"restitution": 1.2, "law": "poisson"}, "law Rigid: restitution is 1.2: give a"),
        ({"friction": -0.1, "law": "pairwise"}, "law Rigid: friction is -0.1: it is"),
        ({"law": "lzb"}, "friction is None, and law='lzb' follows the slip"),
        ({"stiffness": 2.0}, "law Rigid: stiffness is 2.0, and the"),
        ({"law": "pairwise", "stiffness": 0}, "stiffness is 0: give a positive one"),
        ({"law": "lzb", "friction": 0.2, "tangential": 0.5}, "tangential is 0.5, and the law"),
        ({"law": "moreau", "tangential": 1.5}, "law Rigid: tangential is 1.5: give a"),
    ],
)
def test_a_law_that_cannot_be(given, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        Rigid(**given)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"law": "lbz"}, "Sliding: law is 'lbz' (did you mean lzb?): give the impact law"),
        ({"law": 3}, "Sliding: law is 3: give the impact law"),
        ({"restitution": 1.2}, "Sliding: restitution is 1.2: give the ratio"),
        ({"restitution": 1e-4, "law": "lzb"}, "Sliding: restitution is 0.0001: with law='lzb'"),
        ({"friction": -0.1}, "Sliding: friction is -0.1: it must be finite and zero or positive"),
    ],
)
def test_a_support_that_cannot_be(given, said):
    with pytest.raises(ValueError, match=re.escape(said)):
        rk.Sliding(**{"friction": 0.3, "restitution": 0.5} | given)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"restitution": 1e-6}, "with 'lzb' give 0, or 0.001 and more"),
        ({"ratio": 1.1e8}, "at most 1e8 times another stiffness, and (1e5 e)**2 times"),
        ({"ratio": 0.9e-8}, "at most 1e8 times another stiffness"),
        ({"ratio": 1.1e6, "restitution": 0.01}, "(1e5 e)**2 times"),
        ({"ratio": 1e8}, ""),
        ({"ratio": 1e8, "restitution": 0.0}, ""),
        ({"ratio": 1e6, "restitution": 0.01}, ""),
    ],
)
def test_parameters_that_springs_at_points_cannot_have_are_refused(given, said):
    """With more their steps come to no end, which was said to be jamming."""
    model = rk.derive("sliding_block", law="lzb")
    ratio = parameter("k", "ratio", "-", "stiffness in parts of the other foot's")
    feet = (Contact(c.name, *c.at(c.side), c.law) for c in model.contacts)
    left, right = (
        replace(c, law=replace(c.law, stiffness=k))
        for c, k in zip(feet, (1, ratio.symbol), strict=True)
    )
    model = replace(
        model, name="uneven_springs", contacts=(left, right), parameters=(*model.parameters, ratio)
    )
    values = {"mass": 1.0, "half_width": 0.3, "height": 0.6, "inertia": 0.15, "friction": 0.3}
    values |= {"gravity": 9.81, "restitution": 0.5, "ratio": 1.0} | given
    if not said:
        return model.check_values(values)
    with pytest.raises(ValueError, match=re.escape(said)):
        model.check_values(values)


def test_points_that_meet_have_one_law():
    model = rk.derive("sliding_block", law="poisson")
    first, second = model.contacts
    other = replace(second, law=replace(second.law, law="newton"))
    with pytest.raises(ValueError, match="points that meet at once have one law"):
        replace(model, contacts=(first, other))


def test_a_law_of_pinned_feet_is_refused_with_what_to_give_in_its_place():
    with pytest.raises(ValueError, match=r"rk\.Sliding\(\.\.\., law='lzb'\)"):
        rk.simulate(block("lzb"), rk.GroundMotion.none(0.1), impact=rk.VelocityRatio(0.9))


def test_laws_that_are_followed_are_not_exported():
    from rockeom.exports.code import code

    with pytest.raises(ValueError, match="the impact law 'lzb', which is not written"):
        code(block("lzb").module, "c")
    assert "impact" in code(block("moreau").module, "c")
