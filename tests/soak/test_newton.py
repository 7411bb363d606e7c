"""The checks by mechanics of their own: that mechanics is right, and a planted fault is noticed."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.codes import LANDING, REST
from rockeom.simulation.response import Outcome
from tests.mechanics import Mechanics, of_sliding_block, of_stack
from tests.soak.cases import Motion
from tests.soak.families import FAMILIES, drawn, family_of, first_of, model_of, spread
from tests.soak.newton import PRACTICAL, Told, on_contacts, switches

# -- the mechanics by hand: derivatives of places by differences


OF_EACH = {"feet": 3, "ties": 3, "practice": 6}
SOME = [first_of(f) + n for f in FAMILIES for n in range(OF_EACH.get(f, 2))]


@pytest.mark.parametrize("seed", SOME, ids=family_of)
def test_jacobians_and_biases_are_the_derivatives_of_places(seed):
    """Along q + v t + a t^2/2 a place has the velocity J v and the acceleration J a + bias."""
    by_hand = drawn(seed)[1]
    rng = np.random.default_rng(3)
    n = len(by_hand.coordinates)
    q, v, a = (rng.normal(size=n) * size for size in (0.3, 1.0, 1.0))
    step = 1e-3
    t = step * np.arange(-3, 4)[:, None]
    rest = {name: np.zeros(7) for name in by_hand.internal}
    moved = by_hand.at(q + v * t + a * t**2 / 2, v + a * t, rest)
    places = [body.centre for body in moved.parts.masses]
    places += [of.place for of in (*moved.parts.points, *moved.parts.struts)]
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60 / step
    second = np.array([2, -27, 270, -490, 270, -27, 2]) / 180 / step**2
    for place in places:
        jacobian, bias = place.jacobian[3], place.bias[3]
        np.testing.assert_allclose(jacobian @ v, first @ place.value, atol=1e-9)
        np.testing.assert_allclose(jacobian @ a + bias, second @ place.value, atol=1e-7)
    for bar in moved.parts.bars:
        np.testing.assert_allclose(bar.row[3] @ v, first @ bar.drawn, atol=1e-9)


def test_energy_of_a_falling_block_stays():
    """The mass matrix and the potential energy belong together: M a = f, and their sum stays."""
    by_hand = of_stack({
        "lower_half_width": 0.5, "lower_half_height": 1.0, "upper_half_width": 0.3,
        "upper_half_height": 0.7, "lower_mass": 3.0, "upper_mass": 2.0, "restitution": 0.0,
    })  # fmt: skip
    q, v = (np.random.default_rng(5).normal(size=(1, 6)) * size for size in (0.2, 1.0))
    at = by_hand.at(q, v)
    free = at.solve((0, 0, 0, 0), at.forces(0.0, 0.0)).motion
    step = 1e-5
    ends = [by_hand.at(q + s * v, v + s * free) for s in (-step, step)]
    power = (ends[1].kinetic() + ends[1].potential - ends[0].kinetic() - ends[0].potential) / step
    assert abs(power[0] / 2) < 1e-6


# -- responses that are right


@cache
def let_go(half_height: float, friction: float, restitution: float, **start: float) -> Told:
    """A block of half the width 0.3 m in free motion for 1.5 s."""
    sizes = {
        "half_width": 0.3, "half_height": half_height, "friction": friction,
        "restitution": restitution,
    }  # fmt: skip
    motion = Motion(
        0, rk.SlidingBlock(**sizes), rk.GroundMotion.none(1.5), None, None, start, None,
        rk.SolverOptions(),
    )  # fmt: skip
    return Told(motion, motion.run(), of_sliding_block(sizes))


def bounced() -> Told:
    """A block let go above the ground: it bounces, and comes to rest."""
    return let_go(0.6, 0.4, 0.5, theta=0.05, y=0.1, x_dot=0.3)


def rocked() -> Told:
    """A block let go leaning, on its right foot, and then on the other."""
    return let_go(1.0, 0.7, 0.0, theta=0.05)


def kinds(r: Told) -> set[str]:
    return {line.partition(":")[0] for line in on_contacts(r)}


def test_right_responses_have_no_violation():
    assert not list(on_contacts(bounced()))
    assert not list(on_contacts(rocked()))
    assert (bounced().kinds == REST).any()
    assert (rocked().kinds == LANDING).sum() > 2


def leans_on_ties(motion: Motion, by_hand: Mechanics) -> bool:
    """Whether it may be refused: it begins leaning, beyond the limit of a tie."""
    return "theta" in motion.initial and bool(getattr(by_hand, "ties", ()))


GOOD = {"blocks": 40, "stacks": 24, "feet": 24, "frames": 12, "springs": 30}
GOOD |= dict.fromkeys(PRACTICAL, 32)
"""Families, and the number of seeds of each of which the short form looks at those of DOP853."""


@pytest.mark.parametrize("family", GOOD)
def test_some_seeds_of_a_family(family):
    for seed in range(first_of(family) + 1, first_of(family) + GOOD[family]):
        motion, by_hand = drawn(seed)
        if motion.options.method == "DOP853" and not leans_on_ties(motion, by_hand):
            found = list(on_contacts(Told(motion, motion.run(), by_hand)))
            assert not found, (seed, *found)


@pytest.mark.parametrize("number", [301, 371, 549, 1653, 1687, 2935])
def test_a_block_that_meets_a_smooth_stop_as_a_foot_lands_or_leaves(number):
    """Feet that the stop keeps from slipping rub at an impact; one that leaves fast stays open."""
    motion, by_hand = drawn(first_of("smooth") + number)
    found = list(on_contacts(Told(motion, motion.run(), by_hand)))
    assert not [text for text in found if not text.startswith("given back")]


@pytest.mark.parametrize("number", [8, 96, 352, 356])
def test_bars_that_stop_to_yield_at_the_same_instant_do_not_take_turns(number):
    """Both are fixed to one block: where its rotation stops, the forces of both are at strength."""
    motion, by_hand = drawn(first_of("bars") + number)
    assert list(on_contacts(Told(motion, motion.run(), by_hand))) == []


WITHOUT_END = {
    "a block on smooth feet begins to slip again and again": 1_000_000_000_861,
    "a block on rough feet begins to slip again and again": 1_000_000_001_660,
    "blocks of a stack meet in turn until no impulses fit": 2_000_000_001_168,
    "three feet bounce, and slip ends between two landings": 3_000_000_002_176,
    "two feet of a frame land in turn": 4_000_000_000_625,
    "two bars yield in turn": 6_000_000_000_512,
    "two feet bounce, and slip ends between two landings": 6_000_000_001_656,
    "a foot that lands as its pads press leaves again and again": 6_000_000_002_003,
    "a stop is met again and again as a foot lands": 7_000_000_000_565,
    "a stop is met again and again before a faster landing": 7_000_000_028_473,
    "a point that leaves as slowly as rounding errors lands again and again": 2_000_000_005_023,
}
"""Seeds with events that had no end: chatter, a stall, or more impacts than other motions have."""

OUT_OF_ORDER = {
    "a bar yields back just before a slip ends": 6_000_000_010_702,
    "a pad touches just before a slip ends": 6_000_000_027_607,
    "a slow slip that only a faster landing could end": 7_000_000_015_899,
    "a fast landing within the sum of slow bounces": 2_000_000_028_523,
}
"""Seeds in which an event was taken after a later one, with a jump of place or velocity."""


@pytest.mark.parametrize("what", WITHOUT_END | OUT_OF_ORDER)
def test_events_end_and_come_in_their_order(what):
    motion, by_hand = drawn((WITHOUT_END | OUT_OF_ORDER)[what])
    told = Told(motion, motion.run(), by_hand)
    assert told.run.outcome in ("came to rest", "completed", "overturned")
    assert not list(on_contacts(told))


def test_a_seed_of_a_family_always_gives_the_same_motion():
    for seed in spread(21, 5, FAMILIES):
        assert str(drawn(seed)[0]) == str(drawn(seed)[0])
        assert family_of(seed) in FAMILIES
        assert model_of(seed) == model_of(seed + 6 * 1000)


# -- ties and slopes

TORN, YIELDED = 26, (17, 50, 770)
"""Seeds of a strap that breaks, and of one that goes through all of its states."""


def held(number: int) -> Told:
    motion, by_hand = drawn(first_of("ties") + number)
    return Told(motion, motion.run(), by_hand)


def test_a_tie_switches_four_times_at_most_between_two_crests_of_its_elongation():
    """It slackens, draws tight, yields, and unloads or breaks; `on_contacts` bounds all seeds."""
    assert [switches(held(number)) for number in YIELDED] == [{"strap": 4}] * len(YIELDED)


def test_wrong_ties_and_slopes_are_noticed():
    r, (tie,) = held(TORN), held(TORN).by_hand.ties
    names, modes = r.program.MODES, r.mode.copy()
    after = r.start >= r.run.ties["strap"].broke_at
    ends = [names[m].removesuffix("strap_slack").rstrip("_") or "flight" for m in modes[after]]
    modes[after] = [names.index(name) for name in ends]
    assert "tie" in kinds(r.altered(mode=modes))  # it pulls after it broke
    late = replace(tie, breaks_at=rk.Break(force=1.01 * tie.breaks_at.force))
    assert "break" in kinds(replace(r, by_hand=replace(r.by_hand, ties=(late,))))
    assert "forces" in kinds(replace(r, motion=replace(r.motion, slope=1e-3)))


# -- planted faults: the same responses, altered


def test_rest_that_swallows_a_motion_is_noticed():
    """All states are a straight line from 0.2 s before the end of the bounces on."""
    r = bounced()
    end = float(r.times[r.kinds == REST][-1])
    first = int(np.flatnonzero(r.start < end - 0.2)[-1])
    last = int(np.flatnonzero(r.start >= end)[0])
    powers = r.run.steps.powers[: first + 1].copy()
    powers[first, 1:] = 0.0
    powers[first, 1] = r.first[last] - powers[first, 0]
    span = r.run.steps.span[: first + 1].copy()
    span[first, 1] = end - span[first, 0]
    events = r.times < r.start[first]
    events[np.flatnonzero(r.kinds == REST)[-1]] = True
    states = r.run.events.columns[2][events].copy()
    states[-1, 0] = powers[first, 0]
    kept = {"powers": powers, "span": span, "mode": r.mode[: first + 1]}
    kept = {k: np.concatenate([v, getattr(r.run.steps, k)[last:]]) for k, v in kept.items()}
    found = kinds(
        r.altered(
            **kept, times=r.times[events], kinds=r.run.events.columns[1][events], states=states
        )
    )
    assert "long rest" in found


@pytest.mark.parametrize(
    ("coordinate", "shift", "word"), [(1, 5e-3, "rest reach"), (0, -5e-3, "rest place")]
)
def test_rest_that_moves_a_block_is_noticed(coordinate, shift, word):
    """In no time a foot comes down by 5 mm, or is so much further along than its velocities say."""
    states = bounced().run.events.columns[2].copy()
    states[np.flatnonzero(bounced().kinds == REST)[-1], 0, coordinate] += shift
    assert word in kinds(bounced().altered(states=states))


def test_straight_line_instead_of_a_step_is_noticed():
    powers = rocked().run.steps.powers.copy()
    longest = int(rocked().length.argmax())
    powers[longest, 1] = powers[longest, 1:].sum(axis=0)
    powers[longest, 2:] = 0.0
    assert {"rates", "forces"} & kinds(rocked().altered(powers=powers))


def test_motion_at_another_rate_than_the_velocities_say_is_noticed():
    """A place drifts, and its velocity does not."""
    powers = rocked().run.steps.powers.copy()
    longest = int(rocked().length.argmax())
    powers[longest:, 0, 0] += 1e-6 * np.arange(len(powers) - longest)
    powers[longest:, 1, 0] += 1e-6
    assert "rates" in kinds(rocked().altered(powers=powers))


def test_tension_is_noticed():
    """A foot that has left the ground is said to stick: it holds the block down."""
    r = rocked()
    names = r.program.MODES
    modes = r.mode.copy()
    modes[modes == names.index("right")] = names.index("both")
    found = kinds(r.altered(mode=modes))
    assert {"gap", "constraint"} <= found
    hung = r.altered(mode=np.full_like(modes, names.index("left")))
    assert {"tension", "friction", "gap"} & kinds(hung)


def test_friction_beyond_its_bound_is_noticed():
    """The same motion on ground with less friction than it needs."""
    slippery = replace(rocked().motion.structure, friction=0.1)
    smooth = of_sliding_block({
        "half_width": 0.3, "half_height": 1.0, "friction": 0.1, "restitution": 0.0,
    })  # fmt: skip
    motion = replace(rocked().motion, structure=slippery)
    found = kinds(Told(motion, rocked().run, smooth))
    assert {"friction", "landing friction"} <= found


def test_penetration_is_noticed():
    powers = bounced().run.steps.powers.copy()
    powers[:, 0, 1] -= 1e-5
    assert "gap" in kinds(bounced().altered(powers=powers))


@pytest.mark.parametrize("factor", [0.9, 1.1, -1.0])
def test_wrong_restitution_is_noticed(factor):
    """The velocities after a landing, less or more of them."""
    r = bounced()
    states = r.run.events.columns[2].copy()
    i = int(np.flatnonzero(r.kinds == LANDING)[0])
    states[i, 1, 3:] = states[i, 0, 3:] + factor * (states[i, 1, 3:] - states[i, 0, 3:])
    assert {"restitution", "landing momentum"} & kinds(r.altered(states=states))


def test_momentum_from_nowhere_is_noticed():
    states = bounced().run.events.columns[2].copy()
    i = int(np.flatnonzero(bounced().kinds == LANDING)[0])
    states[i, 1, 5] += 0.1
    assert {"landing momentum", "restitution"} & kinds(bounced().altered(states=states))


def test_velocity_that_jumps_without_a_landing_is_noticed():
    slid = first_of("blocks") + next(
        n for n in range(100) if len(slip_events(first_of("blocks") + n))
    )
    motion, by_hand = drawn(slid)
    r = Told(motion, motion.run(), by_hand)
    states = r.run.events.columns[2].copy()
    states[slip_events(slid)[0], 1, 3] += 1e-3
    assert "event velocity" in kinds(r.altered(states=states))


@cache
def slip_events(seed: int) -> np.ndarray:
    """The events of a motion that are no landings and no rests."""
    motion, _ = drawn(seed)
    of = motion.run().events.columns[1][:, 0]
    return np.flatnonzero((of != LANDING) & (of != REST))


@pytest.mark.parametrize("word", ["CHATTER", "STALLED", "TOO_MANY_IMPACTS", "NO_SOLUTION"])
def test_motion_given_up_where_a_mode_fits_is_noticed(word):
    r = rocked()
    step = int(r.length.argmax())
    steps = {k: getattr(r.run.steps, k)[: step + 1] for k in ("span", "mode", "powers")}
    events = r.times <= r.start[step]
    given_up = r.altered(
        **steps, times=r.times[events], kinds=r.run.events.columns[1][events],
        states=r.run.events.columns[2][events], end=r.last[step], outcome=Outcome[word],
    )  # fmt: skip
    assert str(Outcome[word]) in kinds(given_up)


def test_success_short_of_the_end_is_noticed():
    assert "end" in kinds(rocked().altered(duration=2.0))


def test_spring_that_presses_before_it_is_touched_is_noticed():
    """The mode in which all springs press, of a structure that leans."""
    seed = next(
        seed for seed in range(first_of("springs"), first_of("springs") + 200, 4)
        if drawn(seed)[0].initial.get("theta") and not drawn(seed)[0].initial.get("theta_dot")
    )  # fmt: skip
    motion, by_hand = drawn(seed)
    motion = replace(motion, options=rk.SolverOptions())
    r = Told(motion, motion.run(), by_hand)
    every = next(i for i, on in enumerate(r.program.ELEMENT_STATES) if all(on))
    found = kinds(r.altered(mode=np.full_like(r.mode, every)))
    assert "spring" in found
