"""A response of bodies on points, held against Newton-Euler mechanics written by hand.

Each check yields a line for each violation; its first words name the kind. The bounds:

- Within a step the velocities change by the integral of the accelerations that the contact forces
  of the mode give, and positions by that of the velocities. Closed points press, friction is within
  its bound and opposes the slip, open points are above their surface.
- At a landing the change of momentum is one of impulses at touching points that press, within the
  friction cone; a gap opens at least with e times the rate with which it closed, and no faster
  where the point presses. With e = 0 the kinetic energy does not grow (p' v+ <= 0; with friction
  and e > 0 Newton's law of restitution may give energy, and it is not bounded here).
- A rest (infinitely many landings at once) lasts no longer than 2 `rest_tolerance` sqrt(l/a), l the
  size of the structure and a the acceleration with which the gaps that come to rest close; or than
  the hops take that are lower than LOWEST l, which are hardly more than the rounding of a gap.
  Within it a velocity changes by no more than GENTLE accelerations in that time, and a position by
  its velocity in that time. What is closed after it neither opens nor sinks.
- A motion that is given up has no mode that fits its last state, or several with other
  accelerations: all patterns of open, sticking and slipping points are tried.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

import rockeom as rk
from rockeom.codes import LANDING, LZB, NEWTON, PAIRWISE, REST
from rockeom.integrator.schema import impact_law
from tests.mechanics import (
    OPEN,
    SENSE,
    STICK,
    At,
    Bar,
    Fit,
    Mechanics,
    Solved,
    distinct,
    impulses,
    motions,
)
from tests.soak.cases import Dice, is_even
from tests.soak.checks import FINEST, Record, finer, finite, joined, ordered, rest_of

Found = Iterator[str]

SLACK = -1
"""State of a tie that does not pull."""
UNDECIDED = (rk.Outcome.NO_SOLUTION, rk.Outcome.SEVERAL_SOLUTIONS)
LESS = 1000.0
"""By how much a state may be less accurate than the tolerance of a step says."""
NOISE = 1e-9
"""Relative rounding of forces and impulses of systems of equations as they occur here."""
GENTLE = 20.0
"""Impacts of a rest change a velocity by so many times the accelerations in its time: those of
gaps that all close within it, and what these do to other velocities."""
FAST = 100.0
"""No rest takes a landing so many times as fast as accelerations make one in its longest time."""
LOWEST = 1e-11
"""Hops lower than this part of the size of a structure may be summed, however long they take."""
LOST = 1e-13
"""Hops lower than this part of it are lost among rounding errors of a gap, and may end at once."""
STEPS = 80
"""So many steps of a motion are looked at, drawn by its seed."""
LONGEST_BALANCED = 4000
"""Steps of a motion whose energies are added up, at most."""
EVENTS, RESTS = 150, 60
"""And at so many events from the start, and so many rests."""
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(5)
NODES, WEIGHTS = 0.5 + 0.5 * _POINTS, 0.5 * _WEIGHTS
_POWERS = NODES[:, None] ** np.arange(8)


@dataclass(frozen=True)
class Told(Record):
    """A response with the mechanics of its structure."""

    by_hand: Mechanics = None  # type: ignore[assignment]

    @cached_property
    def columns(self) -> np.ndarray:
        """Columns of the coordinates in the states, in the order of the mechanics."""
        names = list(self.program.STATES)
        return np.array([names.index(name) for name in self.by_hand.coordinates])

    @cached_property
    def rates_of(self) -> np.ndarray:
        names = list(self.program.STATES)
        return np.array([names.index(f"{name}_dot") for name in self.by_hand.coordinates])

    def shaking(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Along and normal to the slope, with what its weight adds to that on level ground."""
        across, up = super().shaking(t)
        g, sin, cos = self.by_hand.gravity, math.sin(self.motion.slope), math.cos(self.motion.slope)
        if self.motion.ground_axes == "world":
            across, up = across * cos - up * sin, across * sin + up * cos
        return across - g * sin, up + g * (cos - 1.0)

    def at(self, y: np.ndarray) -> At:
        """Mechanics in states y (k, N)."""
        names = list(self.program.STATES)
        internal = {name: y[:, names.index(name)] for name in self.by_hand.internal}
        return self.by_hand.at(y[:, self.columns], y[:, self.rates_of], internal)

    @cached_property
    def loose(self) -> float:
        """Relative error that a state may have."""
        o = self.motion.options
        return LESS * max(o.rtol, FINEST)

    @cached_property
    def speed(self) -> float:
        """A velocity of the motion, to judge others by: the largest of its energies."""
        first = self.at(self.first)
        kinetic = first.kinetic().max(initial=0.0)
        mass = first.whole
        return math.sqrt(2 * kinetic / mass) + LESS * self.motion.options.atol / self.loose

    def step_of_rest(self, event: int) -> np.ndarray:
        """The step of a rest, if it takes any time: it goes from its state before in a line."""
        ends = np.flatnonzero(self.stop == self.times[event])
        return ends[(self.first[ends] == self.before[event]).all(axis=1)]

    @cached_property
    def rests(self) -> np.ndarray:
        found = np.zeros(len(self.start), bool)
        for event in np.flatnonzero(self.kinds == REST):
            found[self.step_of_rest(event)] = True
        return found

    def pattern(self, mode: int) -> tuple[int, ...]:
        """The states of the points."""
        return tuple(self.program.POINT_STATES[mode]) if self.by_hand.has_points else ()

    def elements(self, mode: int) -> tuple[int, ...]:
        """The states of struts or bars; of two springs that are no elements the name says it."""
        if hasattr(self.program, "ELEMENT_STATES"):
            return tuple(self.program.ELEMENT_STATES[mode])
        pressed = self.name(mode).partition("_")[0]
        return tuple(int(pressed in (foot, "both")) for foot in ("left", "right"))

    def name(self, mode: int) -> str:
        return self.program.MODES[mode]


def on_contacts(r: Told) -> Found:
    """All that must hold of one response."""
    yield from finite(r)
    if r.run.outcome is rk.Outcome.NOT_FINITE:
        yield "not finite: so the motion ended"
        return
    yield from ordered(r)
    yield from joined(r)
    yield from started(r)
    yield from followed(r)
    yield from met(r)
    yield from rested(r)
    yield from snapped(r)
    yield from ended(r)


def worst(over: np.ndarray) -> list[int]:
    """Where it is largest, if that is above zero."""
    return [int(over.argmax())] if (over > 0.0).any() else []


# -- between events


def followed(r: Told) -> Found:
    """Steps: accelerations and velocities give what changes, contact forces are possible."""
    steps = np.flatnonzero(~r.rests & (r.length > 1e-13 * r.run.duration))
    if len(steps) > STEPS:
        rng = np.random.default_rng([r.motion.seed % 2**32, 1])
        steps = np.sort(rng.choice(steps, STEPS, replace=False))
    for mode in np.unique(r.mode[steps]):
        these = steps[r.mode[steps] == mode]
        yield from _followed(r, int(mode), these)


def _followed(r: Told, mode: int, steps: np.ndarray) -> Found:
    powers = r.run.steps.powers[steps]
    inside = np.einsum("xj,nji->nxi", _POWERS, powers)
    k, samples = len(steps), len(NODES)
    h = r.length[steps]
    t = r.start[steps][:, None] + h[:, None] * NODES
    ax, ay = (a.ravel() for a in r.shaking(t))
    at = r.at(inside.reshape(k * samples, -1))
    pattern = r.pattern(mode)
    elements = r.elements(mode)
    force = at.forces(ax, ay, elements)
    solved = at.solve(pattern, force)
    name = r.name(mode)

    def where(sample: int) -> str:
        return f"in {name} at {t.ravel()[sample]:.9g} s"

    # -- the integrals
    first, last = powers[:, 0], powers.sum(axis=1)
    v = at.states.v.reshape(k, samples, -1)
    a = solved.motion.reshape(k, samples, -1)
    moves = np.einsum("s,ksn->kn", WEIGHTS, v) * h[:, None]
    speeds_up = np.einsum("s,ksn->kn", WEIGHTS, a) * h[:, None]
    lacks = last[:, r.columns] - first[:, r.columns] - moves
    lacks_speed = last[:, r.rates_of] - first[:, r.rates_of] - speeds_up
    room = r.error(np.maximum(np.abs(first), np.abs(last)))
    largest = np.abs(a).max(axis=1) * h[:, None]
    room_speed = room[:, r.rates_of] + (r.loose + NOISE) * largest
    room_place = room[:, r.columns] + r.loose * np.abs(v).max(axis=1) * h[:, None]
    for what, lack, may in (
        ("rates", lacks, room_place), ("forces", lacks_speed, room_speed),
    ):  # fmt: skip
        over = np.abs(lack) / may
        if not (over <= 1.0).all():
            i, j = np.unravel_index(int(np.nanargmax(over)), over.shape)
            yield (
                f"{what}: {r.by_hand.coordinates[j]} changes by {lack[i, j]:.3g} more than its "
                f"{what} give in the step from {r.start[steps[i]]:.9g} s, {h[i]:.3g} s, in {name}: "
                f"{over[i, j]:.3g} of what may be"
            )
    yield from _possible(r, at, pattern, solved, ax, ay, where)
    yield from _pressed(r, at, elements, where)
    yield from _yielded(r, at, elements, steps, where)


def _possible(r: Told, at: At, pattern, solved: Solved, ax, ay, where) -> Found:
    """No tension, friction within its bound and against the slip, no sinking, no slip of sticks."""
    size, speed = r.by_hand.size, r.speed
    force = at.load(ax, ay) + np.abs(solved.pressed).max(axis=1, initial=0.0)
    room = (r.loose + 1e-7) * force
    gap_room = (r.loose + 1e-8) * size
    rate_room = (r.loose + 1e-8) * (speed + np.abs(at.rates).max(axis=(1, 2), initial=0.0))
    points = at.parts.points
    for column, i in enumerate(solved.normal):
        pull = -solved.pressed[:, column] - room
        for s in worst(pull):
            tension = -solved.pressed[s, column]
            yield f"tension: {points[i].name} pulls with {tension:.6g} N {where(s)}"
    for column, i in enumerate(solved.along):
        bound = at.bound(i, solved)
        over = np.abs(solved.friction[:, column]) - bound - room
        for s in worst(over):
            yield (
                f"friction: {points[i].name} needs {solved.friction[s, column]:.6g} N of "
                f"{bound[s]:.6g} N {where(s)}"
            )
    for i, state in enumerate(pattern):
        gap, rate = at.gaps[:, i], at.rates[:, i]
        if state == OPEN:
            sunk = -gap - gap_room
        else:
            sunk = np.abs(gap) - gap_room
            apart = np.abs(rate[:, 1]) - rate_room
            for s in worst(apart):
                yield (
                    f"constraint: the gap of closed {points[i].name} changes at {rate[s, 1]:.3g} "
                    f"m/s {where(s)}"
                )
        for s in worst(sunk):
            yield f"gap: that of {points[i].name} is {gap[s]:.6g} m {where(s)}"
        for s in worst(np.where(state == STICK, np.abs(rate[:, 0]) - rate_room, 0.0)):
            yield f"slip: {points[i].name} sticks and slips at {rate[s, 0]:.3g} m/s {where(s)}"
        if SENSE[state] and points[i].friction and (-SENSE[state] * rate[:, 0] > rate_room).any():
            s = int((-SENSE[state] * rate[:, 0]).argmax())
            yield f"slip: {points[i].name} slips the other way at {rate[s, 0]:.3g} m/s {where(s)}"


def _pressed(r: Told, at: At, elements, where) -> Found:
    """A spring and damper press only what touches them, and never pull."""
    for acts, strut in zip(elements, at.parts.struts, strict=False):
        push, above = at.push(strut), strut.place.value[:, 1]
        room = (r.loose + 1e-8) * r.by_hand.size
        force_room = strut.stiffness * room + strut.damping * r.loose * r.speed
        if acts and (above > room).any():
            s = int(above.argmax())
            yield (
                f"spring: {strut.name} presses with {push[s]:.6g} N, {above[s]:.3g} m above its "
                f"spring {where(s)}"
            )
        if acts and (push < -force_room).any():
            s = int(push.argmin())
            yield f"spring: {strut.name} pulls with {-push[s]:.6g} N {where(s)}"
        if not acts and ((above < -room) & (push > force_room)).any():
            s = int(np.where(above < -room, push, -np.inf).argmax())
            yield f"spring: {strut.name} should press with {push[s]:.6g} N {where(s)}"


def _yielded(r: Told, at: At, elements, steps: np.ndarray, where) -> Found:
    """A bar carries no more than its strength, and flows there alone, as its elongation does."""
    names = list(r.program.STATES)
    powers = r.run.steps.powers[steps]
    h, samples = r.length[steps], len(NODES)
    for state, bar in zip(elements, at.parts.bars, strict=False):
        if bar.tie is not None:
            yield from _tied(r, bar, state, where)
            if state == SLACK or math.isinf(bar.strength):
                continue
        j = names.index(f"{bar.name}_extension")
        driven = bar.tension - bar.hardening * bar.extension
        room = (r.loose + 1e-8) * (
            bar.strength + bar.stiffness * np.abs(bar.drawn) + bar.stiffness * 1e-9
        )
        over = np.abs(driven - state * bar.strength) - room
        if state == 0:  # a tie does not yield by pressure
            over = (driven if bar.tie else np.abs(driven)) - room - bar.strength
        for s in worst(over):
            yield (
                f"strength: {bar.name} carries {driven[s]:.6g} N of {bar.strength:.6g} N in state "
                f"{state} {where(s)}"
            )
        moves = powers[:, 1:, j].sum(axis=1)
        rate = np.einsum("kn,kn->k", bar.row, at.states.v)
        flows = rate * bar.stiffness / (bar.stiffness + bar.hardening) * abs(state)
        back = -state * rate - (r.loose + 1e-8) * (r.speed + np.abs(rate))
        for s in worst(back):
            yield f"flow: {bar.name} flows with {state}, at {rate[s]:.3g} m/s {where(s)}"
        lack = moves - flows.reshape(len(steps), samples) @ WEIGHTS * h
        may = r.loose * (np.abs(powers[:, 0, j]) + np.abs(rate).max() * h) + 1e-3 * r.loose
        if (np.abs(lack) > may).any():
            i = int(np.abs(lack).argmax())
            yield f"flow: {bar.name} grows by {lack[i]:.3g} m too much {where(i * samples)}"


def _tied(r: Told, bar: Bar, state: int, where) -> Found:
    """A tie pulls where it is drawn, and is whole within its limit."""
    slow = (r.loose + 1e-8) * (bar.tie.slack_length + np.abs(bar.drawn) + 1e-2 * r.by_hand.size)
    reached, limit, unit = _of_limit(bar)
    pulls = bar.tension if state == SLACK else -bar.tension
    wrong = np.where(bar.broken > 0.0, state != SLACK, pulls - bar.stiffness * slow)
    beyond = (1.0 - bar.broken) * (reached - limit - unit * slow)
    for what, over in (("should not pull", wrong), ("should have broken", beyond)):
        for s in worst(over):
            yield f"tie: {bar.name} {what} in state {state}, at {bar.tension[s]:.6g} N {where(s)}"


def _of_limit(bar: Bar) -> tuple[np.ndarray, float, float]:
    """What is to reach the limit of a tie, the limit, and by how much a metre changes the first."""
    ((name, limit),) = bar.tie.limits.items()
    if name == "energy":
        return bar.strength * bar.extension, limit, bar.strength
    return (bar.tension, limit, bar.stiffness) if name == "force" else (bar.drawn, limit, 1.0)


def snapped(r: Told) -> Found:
    """Ties break at their limits, for good; what they held is a loss of its own."""
    before, after = (r.at(y).parts.bars for y in (r.before, r.after))
    held, small = 0.0, r.loose + 1e-8
    for one, other in zip(before, after, strict=True):
        if one.tie is None:
            return
        if not np.isin([one.broken, other.broken], (0.0, 1.0)).all():
            yield f"break: {one.name} is neither whole nor broken at an event"
        breaks = np.flatnonzero(other.broken != one.broken)
        if len(breaks) > 1:
            yield f"break: {one.name} breaks {len(breaks)} times"
        reached, limit, unit = _of_limit(one)
        for i in breaks:
            held += 0.5 * one.force[i] ** 2 / one.stiffness
            held += 0.5 * one.hardening * one.extension[i] ** 2
            if abs(reached[i] - limit) > small * (limit + unit * r.by_hand.size):
                yield f"break: {one.name} at {reached[i]:.9g} of {limit:.9g}"
    told = r.run.energy_balance().breaks
    if abs(told - held) > small * (held + r.speed**2):
        yield f"break: the energy of ties that broke is {told:.9g} J, by hand {held:.9g} J"
    for name, most in switches(r).items():
        if most > 4:
            yield f"switches: {name} switches {most} times between two crests"


def switches(r: Told) -> dict[str, int]:
    """Of each tie, the most changes of its state from one crest of its elongation to the next.

    What stood still, such as a block between two slips, has come to a crest.
    A tie that hovers about its length as fast as rounding errors, such as an anchor under a foot at
    rest, may slacken and tighten again and again: these count for none.
    """
    powers, small, found = r.run.steps.powers, 1e-9 * r.speed, {}
    within = np.einsum("xj,nji->nxi", _POWERS, powers).reshape(-1, powers.shape[2])
    at = r.at(within), r.at(r.before)
    for i, bars in enumerate(zip(*(of.parts.bars for of in at), strict=True)):
        rate, of_event = (
            np.einsum("kn,kn->k", bar.row, x.states.v) for bar, x in zip(bars, at, strict=True)
        )
        then = np.append(rate[1:], 0.0)
        crests = (rate > -small) & (then < -small) | (np.abs(rate) < small) & (then > small)
        states = np.array(r.program.ELEMENT_STATES)[:, i]
        one, other = states[r.sources], states[r.targets]
        hovers = (one + other == SLACK) & (np.abs(of_event) < small)
        own = r.times[(one != other) & (r.times > 0.0) & ~hovers]
        last = (np.searchsorted(r.stop, own * (1.0 - 1e-15)) + 1) * len(NODES) - 1
        passages = (np.cumsum(crests) - crests)[np.minimum(last, len(crests) - 1)]
        found[bars[0].name] = int(np.bincount(passages).max(initial=0))
    return found


def continued(r: Told) -> Found:
    """A motion that goes on from `run.final` alone is the whole, where the same events follow."""
    m = replace(r.motion, options=finer(r.motion.options))
    at = m.motion.duration * Dice(m.seed, 2).between(0.1, 0.9)
    every, how = m.run(), {**m.arguments(), "duration": at, "options": m.options}
    rest = rest_of(m, at, initial=rk.simulate(m.structure, m.motion, **how).final)
    passed = [[e.mode_after for e in x.events if e.time > t] for x, t in ((rest, 0), (every, at))]
    if passed[0] != passed[1] or every.outcome in UNDECIDED or every.t[-1] < at:
        return  # other events, or none
    for name in every.states:
        apart = abs(rest.final[name] - every.final[name])
        if apart > 1e-6 * abs(every.extremes(name).peak) + 1e-7 * r.by_hand.size:
            yield f"continued: from the state at {at:.9g} s, {name} ends {apart:.3g} apart"


def started(r: Told) -> Found:
    """The reactions of the state at the start, asked of the structure: springs that touch press."""
    at = r.at(r.first[:1])
    if not at.parts.struts:
        return
    state = dict(zip(r.run.states, r.first[0].tolist(), strict=True))
    found = r.motion.structure.reactions(state)
    for strut in at.parts.struts:
        compressed, push = -float(strut.place.value[0, 1]), float(at.push(strut)[0])
        expected = max(push, 0.0) if compressed > 0.0 else 0.0
        room = 1e-9 * (abs(push) + strut.stiffness * r.by_hand.size)
        told = float(found[f"{strut.name}_reaction"])
        if abs(compressed) > 1e-12 * r.by_hand.size and abs(told - expected) > room:
            yield (
                f"start: {strut.name} has a reaction of {told:.6g} N, compressed by "
                f"{compressed:.3g} m it presses with {expected:.6g} N"
            )


# -- at events


def met(r: Told) -> Found:
    """Events: places stay; velocities change at landings alone, by impulses of touching points."""
    count = min(len(r.times), EVENTS)
    if not count:
        return
    kinds = r.kinds[:count]
    moved = r.after[:count] - r.before[:count]
    size = r.by_hand.size
    jump = np.abs(moved[:, r.columns]).max(axis=1)
    room = (r.loose + 1e-8) * (size + np.abs(r.before[:count][:, r.columns]).max(axis=1))
    for i in np.flatnonzero((kinds != REST) & (jump > room))[:1]:
        yield f"event place: at {r.times[i]:.9g} s a place jumps by {jump[i]:.3g}"
    faster = np.abs(moved[:, r.rates_of]).max(axis=1)
    room = (5 * r.loose + 1e-8) * (r.speed + np.abs(r.before[:count][:, r.rates_of]).max(axis=1))
    for i in np.flatnonzero((kinds != REST) & (kinds != LANDING) & (faster > room))[:1]:
        yield (
            f"event velocity: at {r.times[i]:.9g} s a velocity jumps by {faster[i]:.3g} without a "
            "landing"
        )
    landings = np.flatnonzero(kinds == LANDING)
    if not len(landings):
        return
    before, after = r.at(r.before[landings]), r.at(r.after[landings])
    # the points that were closed, and the one that lands, take part; others that are a hair above
    # their surface, or leave it, may have met it or not: those that are thrown down land afterwards
    takes_part = np.array([r.pattern(c) for c in r.sources[landings]]) != OPEN
    guards = r.run.events.columns[1][landings, 3]
    lands = [r.program.SUBJECTS[c][g] for c, g in zip(r.sources[landings], guards, strict=True)]
    takes_part[np.arange(len(landings)), lands] = True
    small = 1e-9 * np.sqrt(2 * before.kinetic() / before.whole)
    opened = np.array([r.pattern(c) for c in r.targets[landings]]) == OPEN
    later = opened & ~takes_part & (after.rates[:, :, 1] < -small[:, None])
    # what touches is put on its surface
    large = size + np.abs(after.states.q).max(axis=1)
    touching = (after.gaps <= 4e-14 * large[:, None]) & ~later
    for mask in np.unique(touching, axis=0):
        these = np.flatnonzero((touching == mask).all(axis=1))
        yield from _landed(r, landings[these], before[these], after[these], mask, takes_part[these])


def _landed(
    r: Told, events: np.ndarray, before: At, after: At, touching: np.ndarray, takes_part: np.ndarray
) -> Found:
    pattern = [STICK if t else OPEN for t in touching]
    normal, along = before.held(pattern)
    points = before.parts.points
    along = [i for i in along if points[i].friction]
    v0, v1 = before.states.v, after.states.v
    given = np.einsum("kab,kb->ka", before.mass, v1 - v0)
    rows = [before.rows[:, i, 1] for i in normal] + [before.rows[:, i, 0] for i in along]

    def told(i: int) -> str:
        return f"landing at {r.times[events[i]]:.9g} s"

    speed = np.sqrt(2 * before.kinetic() / before.whole)
    speed = speed + 1e-6 * r.speed
    room = (r.loose + 1e-8) * speed
    if not rows:
        yield f"landing momentum: {told(0)}: no point touches"
        return
    j = np.stack(rows, axis=1)
    compliance = j @ np.linalg.solve(before.mass, np.swapaxes(j, 1, 2))
    changes = np.einsum("kra,ka->kr", j, v1 - v0)
    impulse = np.einsum("krs,ks->kr", np.linalg.pinv(compliance, rcond=1e-11), changes)
    left = given - np.einsum("kra,kr->ka", j, impulse)
    mobility = np.linalg.solve(before.mass, left[:, :, None])[:, :, 0]
    strange = np.sqrt(np.abs(np.einsum("ka,ka->k", left, mobility)))
    mass = before.whole
    for i in np.flatnonzero(strange > room * math.sqrt(mass))[:1]:
        yield (
            f"landing momentum: {told(i)}: velocities change by no impulses of touching points, by "
            f"{strange[i] / math.sqrt(mass):.3g} m/s"
        )
    judged = (r, events, before, after, touching, takes_part, normal, along)
    smooth = any(not points[i].friction for i in normal)
    open_share = _open_share(j[0]) if smooth else None
    if open_share is None:
        yield from _shared(*judged, impulse)
        return
    # a smooth contact keeps feet from slipping: some share of friction and its force must fit
    for e in range(len(events)):
        one = np.array([e])
        found = [
            list(_shared(r, events[one], before[one], after[one], touching, takes_part[one],
                         normal, along, share[None]))
            for share in _shares(impulse[e], open_share, normal, along, points)
        ]  # fmt: skip
        yield from min(found, key=len)


def _open_share(rows: np.ndarray) -> np.ndarray | None:
    """(r,) impulses that do nothing together, where rows (r, n) depend on one another."""
    u, sizes, _ = np.linalg.svd(rows)
    rank = int((sizes > 1e-9 * sizes[0]).sum())
    return u[:, -1] if rank == len(rows) - 1 else None


def _shares(
    impulse: np.ndarray, along_it: np.ndarray, normal: list[int], along: list[int], points
) -> Iterator[np.ndarray]:
    """Impulses that do the same where one of them, or what is left of a cone, is zero."""
    rows = [*np.eye(len(impulse))]
    for column, p in enumerate(along):
        cone = np.zeros(len(impulse))
        for c, other in enumerate(normal):
            if points[other].pair == points[p].pair:
                cone[c] = points[other].friction
        slides = np.eye(len(impulse))[len(normal) + column]
        rows += [cone + slides, cone - slides]
    for row in rows:
        if abs(row @ along_it) > 1e-9:
            yield impulse - (row @ impulse) / (row @ along_it) * along_it


def _shared(
    r: Told, events: np.ndarray, before: At, after: At, touching: np.ndarray,
    takes_part: np.ndarray, normal: list[int], along: list[int], impulse: np.ndarray,
) -> Found:  # fmt: skip
    """The laws of contact for given impulses of the points: (k, normal and along)."""

    def told(i: int) -> str:
        return f"landing at {r.times[events[i]]:.9g} s"

    points, mass, v1 = before.parts.points, before.whole, after.states.v
    speed = np.sqrt(2 * before.kinetic() / mass) + 1e-6 * r.speed
    room = (r.loose + 1e-8) * speed
    most = mass * speed
    room_i = (r.loose + 1e-7) * most
    pressed, friction = impulse[:, : len(normal)], impulse[:, len(normal) :]
    rate0 = before.rates
    rate1 = np.einsum("kmin,kn->kmi", before.rows, v1)
    for column, p in enumerate(normal):
        pull = -pressed[:, column] - room_i
        for i in np.flatnonzero(pull > 0)[:1]:
            yield (
                f"landing tension: {told(i)}: {points[p].name} pulls with "
                f"{-pressed[i, column]:.6g} N s"
            )
    for column, p in enumerate(along):
        bound = np.zeros(len(events))
        for c, other in enumerate(normal):
            if points[other].pair == points[p].pair:
                presses = pressed[:, c] > (room_i if math.isinf(points[other].friction) else 0.0)
                bound[presses] += points[other].friction * pressed[presses, c]
        over = np.abs(friction[:, column]) - bound - room_i
        if math.isinf(points[p].friction):  # it is held until its normal impulse is zero
            over[:] = 0.0
        for i in np.flatnonzero(over > 0)[:1]:
            yield (
                f"landing friction: {told(i)}: {points[p].name} needs {friction[i, column]:.6g} "
                f"N s, {bound[i]:.6g} N s there are"
            )
        if impact_law(r.program) != NEWTON:
            continue  # a slip may end, or turn, within the impact
        slip = rate1[:, p, 0]
        against = np.where(np.abs(slip) > room, np.copysign(bound, slip), 0.0)
        slips = (against != 0.0) & (np.abs(friction[:, column] + against) > room_i)
        for i in np.flatnonzero(slips)[:1]:
            yield (
                f"landing friction: {told(i)}: {points[p].name} slips at {slip[i]:.6g} m/s "
                f"after {friction[i, column]:.6g} N s of {bound[i]:.6g} N s"
            )
    if impact_law(r.program) != NEWTON:
        touching = np.zeros(len(touching), bool)
    for p in np.flatnonzero(touching):
        least = points[p].restitution * np.maximum(-rate0[:, p, 1], 0.0)
        slow = np.where(takes_part[:, p], least - rate1[:, p, 1] - room, 0.0)
        for i in np.flatnonzero(slow > 0)[:1]:
            yield (
                f"restitution: {told(i)}: {points[p].name} leaves at {rate1[i, p, 1]:.6g} m/s, "
                f"restitution asks for {least[i]:.6g} m/s"
            )
        if p in normal:
            presses = pressed[:, normal.index(p)] > room_i
            fast = rate1[:, p, 1] - least - room
            for i in np.flatnonzero(presses & (fast > 0))[:1]:
                yield (
                    f"restitution: {told(i)}: {points[p].name} presses and leaves at "
                    f"{rate1[i, p, 1]:.6g} m/s, restitution asks for {least[i]:.6g} m/s"
                )
    if not any(p.restitution for p in points) or impact_law(r.program) in (LZB, PAIRWISE):
        gain = 0.5 * np.einsum("ka,kab,kb->k", v1, before.mass, v1) - before.kinetic()
        for i in np.flatnonzero(gain > (r.loose + 1e-8) * mass * speed**2)[:1]:
            yield f"landing energy: {told(i)}: the kinetic energy grows by {gain[i]:.3g} J"


# -- rests


def rested(r: Told) -> Found:
    """Infinitely many landings at once: no longer, and no more, than `rest_tolerance` allows."""
    rests = np.flatnonzero(r.kinds == REST)[:RESTS]
    if not len(rests):
        return
    size, tolerance = r.by_hand.size, r.motion.options.rest_tolerance
    before, after = r.at(r.before[rests]), r.at(r.after[rests])
    began = r.times[rests].copy()
    for i, e in enumerate(rests):
        began[i] = min(r.start[r.step_of_rest(e)], default=began[i])
    ax, ay = r.shaking(began)
    lasts = r.times[rests] - began
    for i, e in enumerate(rests):
        source, target = r.pattern(r.sources[e]), r.pattern(r.targets[e])
        one, two = before[np.array([i])], after[np.array([i])]
        solved = one.solve(source, one.forces(ax[i], ay[i]))
        yield from _rested(
            r, one, two, source, target, solved, float(lasts[i]), float(r.times[e]),
            abs(ax[i]) + abs(ay[i]), tolerance, size,
        )  # fmt: skip


def _rested(
    r: Told, one: At, two: At, source, target, solved: Solved, lasts: float, time: float,
    ground: float, tolerance: float, size: float,
) -> Found:  # fmt: skip
    names = [p.name for p in one.parts.points]
    where = f"rest at {time:.9g} s"
    landed = [i for i in range(len(names)) if source[i] == OPEN and target[i] != OPEN]
    closing = [-float(one.rows[0, i, 1] @ solved.motion[0] + one.biases[0, i, 1]) for i in landed]
    # -- its time
    by_themselves = [a for a in closing if a > 0.0]
    slowest = max(min(by_themselves, default=one.of.gravity), 0.05 * one.of.gravity)
    e = max(p.restitution for p in one.parts.points)
    hops = math.sqrt(8.0 * LOWEST) / max(1.0 - e, 1e-3)
    longest = 2.0 * (tolerance + hops) * math.sqrt(size / slowest)
    if lasts > longest + 1e-14 * time:
        yield (
            f"long rest: {where}: it takes {lasts:.3g} s, {longest:.3g} s may be (gaps close with "
            f"{', '.join(f'{a:.3g}' for a in closing)} m/s2)"
        )
    # -- velocities and places
    speed = float(np.abs(one.rates[0]).max()) + float(np.sqrt(2 * one.kinetic()[0] / sum(
        b.mass for b in one.parts.masses
    )))  # fmt: skip
    hard = one.of.gravity + ground + speed**2 / size + abs(max(closing, default=0.0))
    # a length of rotations is the size
    turns = np.array([size if n in ("theta", "phi") else 1.0 for n in one.of.coordinates])
    v0, v1 = one.states.v[0] * turns, two.states.v[0] * turns
    q0, q1 = one.states.q[0] * turns, two.states.q[0] * turns
    rounding = (1e-7 + 1e-3 * r.loose) * (speed + r.speed)
    falls = float(np.maximum(-one.rates[0, landed, 1], 0.0).max(initial=0.0))
    falls = min(falls, FAST * tolerance * math.sqrt(size * hard))  # a faster landing is an impact
    most = GENTLE * (hard * lasts + falls) + rounding
    most += GENTLE * math.sqrt(2.0 * LOST * size * hard)  # of hops that end among rounding errors
    gap_room = 1e-9 * size + 1e-3 * r.loose * size
    reach = lasts * float(np.abs(one.rates[0, landed, 1]).max(initial=0.0))
    reach += GENTLE * hard * lasts**2 + gap_room
    for i in landed:
        if one.gaps[0, i] > reach:
            yield (
                f"rest reach: {where}: {names[i]} is closed after {lasts:.3g} s from a gap of "
                f"{one.gaps[0, i]:.3g} m, its rate is {one.rates[0, i, 1]:.3g} m/s"
            )
    for j in np.flatnonzero(np.abs(v1 - v0) > most)[:1]:
        yield (
            f"rest velocity: {where}: the velocity of {one.of.coordinates[j]} changes by "
            f"{(v1 - v0)[j]:.6g} m/s in {lasts:.3g} s, {most:.3g} m/s may be"
        )
    room = (most + np.abs(v1 - v0)) * lasts + 1e-12 * np.abs(q0)
    room += (1e-10 + 1e-2 * r.loose) * size
    lack = q1 - q0 - 0.5 * lasts * (v0 + v1)
    for j in np.flatnonzero(np.abs(lack) > room)[:1]:
        yield (
            f"rest place: {where}: {one.of.coordinates[j]} moves by {(q1 - q0)[j]:.6g} "
            f"in {lasts:.3g} s, its rates give {(q1 - q0 - lack)[j]:.6g}"
        )
    near = [
        STICK if target[i] != OPEN or source[i] != OPEN or one.gaps[0, i] <= reach else OPEN
        for i in range(len(names))
    ]
    yield from _pushed_in_rest(r, one, two, solved, near, lasts, most, where)
    # -- what bounces comes back within it, and what is closed stays so
    fast = one.rates[0, landed, 1] - most  # others that come down may bring it back
    for i in np.flatnonzero(fast > 0)[:1]:
        leaves = one.rates[0, landed[i], 1]
        yield f"rest bounce: {where}: {names[landed[i]]} leaves at {leaves:.6g} m/s"
    for i, state in enumerate(target):
        gap, rate = two.gaps[0, i], two.rates[0, i]
        if gap < -gap_room or (state != OPEN and gap > gap_room):
            yield f"rest gap: {where}: the gap of {names[i]} is {gap:.3g} m after it"
        if state != OPEN and abs(rate[1]) > 1e-9 * speed + rounding:
            yield f"rest gap: {where}: the gap of {names[i]} changes at {rate[1]:.3g} m/s after it"
        if state == STICK and abs(rate[0]) > 1e-9 * speed + rounding:
            yield f"rest slip: {where}: {names[i]} sticks and slips at {rate[0]:.3g} m/s after it"
    gained = float((two.kinetic() + two.potential - one.kinetic() - one.potential)[0])
    mass = one.whole
    may = mass * (speed + most) * (hard * lasts + rounding) + 1e-12 * abs(float(one.potential[0]))
    may += GENTLE * mass * hard * float(np.maximum(-one.gaps[0], 0.0).max())  # put on the ground
    if gained > may:
        yield f"rest energy: {where}: the energy grows by {gained:.3g} J in {lasts:.3g} s"


def _pushed_in_rest(
    r: Told, one: At, two: At, solved: Solved, near, lasts: float, most: float, where: str
) -> Found:
    """The momentum that a rest gives is that of forces, and of impulses at points that were near.

    most : a velocity that may be gained within it [m/s].
    """
    normal, along = one.held(near)
    mass = one.whole
    rows = [one.rows[0, i, 1] for i in normal] + [one.rows[0, i, 0] for i in along]
    # less what the mode before it does, whose forces are among these impulses
    given = one.mass[0] @ (two.states.v[0] - one.states.v[0] - lasts * solved.motion[0])
    j = np.array(rows)
    mobility = np.linalg.inv(one.mass[0])
    impulse = np.linalg.pinv(j @ mobility @ j.T, rcond=1e-11) @ (j @ mobility @ given)
    left = given - j.T @ impulse
    strange = math.sqrt(max(float(left @ mobility @ left), 0.0))
    room = 0.01 * math.sqrt(mass) * most
    if strange > room:
        yield (
            f"rest momentum: {where}: velocities change by no impulses of what touches: "
            f"{strange / math.sqrt(mass):.3g} m/s, {room / math.sqrt(mass):.3g} may be"
        )
    pulls = -float(impulse[: len(normal)].min(initial=0.0))
    hold = mass * most
    if pulls > hold:
        yield f"rest momentum: {where}: a point pulls with {pulls:.3g} N s, {hold:.3g} may be"


def lost(r: Told) -> Found:
    """What no impact, friction or element has lost, slow bounces have: a rest takes no more."""
    rests = int((r.kinds == REST).sum())
    plain = not (r.by_hand.internal or r.at(r.first[:1]).parts.struts)
    if not (rests and plain and len(r.start) < LONGEST_BALANCED):
        return
    balance, impacts = r.run.energy_balance(), r.run.impacts
    left = balance.impacts - impacts.energy_loss + impacts.energy_gains.sum()
    whole = r.by_hand.at(r.before[:1, r.columns], r.before[:1, r.rates_of]).whole
    slow = _slow(r)
    room = rests * GENTLE * whole * (r.speed + slow) * slow
    room += (r.loose + 1e-8) * len(r.start) * max(*map(abs, balance[:4]), whole * r.speed**2)
    if abs(left) > room:
        yield f"rest energy: {left:.3g} J are lost beside impacts, {room:.3g} J may be"


def _slow(r: Told) -> float:
    """A velocity that a rest may take [m/s]."""
    ground = max(one.peak for one in (r.motion.motion, r.motion.vertical) if one is not None)
    hard = r.by_hand.gravity + ground + r.speed**2 / r.by_hand.size
    return r.motion.options.rest_tolerance * math.sqrt(r.by_hand.size * hard)


def swept(r: Told) -> Found:
    """A sweep has the peaks of the motion, those beside events included."""
    case = r.motion.case()
    table = rk.simulate_many(
        case, {"scale": [1.0]}, options=r.motion.options,
        sweep_options=rk.SweepOptions(progress=False, lanes=False),
    )  # fmt: skip
    for name in r.run.states:
        peak, swept_peak = abs(r.run.extremes(name).peak), float(table.peak.sel(state=name)[0])
        room = _slow(r) if name.endswith("_dot") else 100 * r.motion.options.atol  # of rests
        if abs(peak - swept_peak) > 1e-6 * peak + room:
            yield f"sweep: the peak of {name} is {swept_peak:.9g}, that of the motion {peak:.9g}"


def mirrored_impacts(r: Told) -> Found:
    """The first impacts of the mirrored motion of a symmetric structure are the mirror images.

    Those as slow as a rest may be follow one another in any order.
    """
    landings = np.flatnonzero(r.kinds == LANDING)[:3]
    events = r.motion.mirrored().run().events.columns
    others = events.states[events.kinds[:, 0] == LANDING, 1]
    sides = np.array([1.0 if is_even(name) else -1.0 for name in r.run.states])
    for k, i in enumerate(landings):
        scale = np.abs(r.after[i]).max() + r.speed
        if np.abs(r.after[i] - r.before[i]).max() < _slow(r):
            return
        same = len(others) > k and np.allclose(
            others[k] * sides, r.after[i], rtol=0.0, atol=(100 * r.loose + 1e-7) * scale
        )
        if not same:
            yield f"mirror: the landing at {r.times[i]:.9g} s is no mirror image of that mirrored"
            return


PRACTICAL = ("ties", "practice", "slopes")
POINTED = ("blocks", "stacks", "feet", "frames", "bars", "smooth", "laws", "loads", *PRACTICAL)
SYMMETRIC = ("blocks", "stacks", "frames", "laws", "loads")
SOMETIMES = {
    "lost": (0.2, POINTED, lost),
    "swept": (0.05, POINTED, swept),
    "mirrored": (0.2, SYMMETRIC, mirrored_impacts),
    "continued": (0.3, PRACTICAL, continued),
}
"""Checks that take other motions or quadratures: the share of seeds, the families, the check."""


# -- states of events


def given_back(r: Told) -> Found:
    """A state of an event is one of the structure: it has positions, and a motion starts there."""
    if not len(r.times):
        return
    structure, dice = r.motion.structure, np.random.default_rng([r.motion.seed % 2**32, 2])
    events = dice.choice(len(r.times), min(len(r.times), 3), replace=False)
    names = list(r.run.states)
    for i in np.sort(events):
        for which, y in (("before", r.before[i]), ("after", r.after[i])):
            state = dict(zip(names, y.tolist(), strict=True))
            try:
                structure.positions(state)
                rk.simulate(
                    structure, rk.GroundMotion.none(1e-3), initial=state, options=r.motion.options
                )
            except ValueError as error:
                yield f"given back: {which} the event at {r.times[i]:.9g} s: {error}"


# -- the end


def ended(r: Told) -> Found:
    """The outcome is that of the last state; a motion is given up only where no mode fits."""
    run = r.run
    last = float(r.stop[-1])
    if len(r.times):
        last = max(last, float(r.times[-1]))
    whole = abs(last - run.duration) <= 1e-12 * run.duration
    word = str(run.outcome)
    if run.outcome in (rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST) and not whole:
        yield f"end: {word} at {last:.9g} s of {run.duration:.9g} s"
    bounds = r.motion.structure.falls
    names = list(r.program.STATES)
    angles = {name: abs(run.end[names.index(name)]) / bound for name, bound in bounds.items()}
    if run.outcome is rk.Outcome.OVERTURNED and not whole and max(angles.values()) < 1 - 1e-6:
        yield from _undecided(r, word, last)  # a fall without a solution
    if run.outcome is rk.Outcome.CAME_TO_REST:
        yield from _stands(r)
    if run.outcome in (
        rk.Outcome.CHATTER, rk.Outcome.STALLED, rk.Outcome.TOO_MANY_IMPACTS,
    ):  # fmt: skip
        yield f"{word}: at {last:.9g} s"
    if run.outcome in UNDECIDED:
        yield from _undecided(r, word, last)


def _stands(r: Told) -> Found:
    """What came to rest is at rest, and its contact forces hold it."""
    at = r.at(r.run.end[None])
    height = max(float(b.centre.value[0, 1]) for b in at.parts.masses)
    speed = float(np.sqrt(2 * at.kinetic()[0] / at.whole))
    if speed > 1e-4 * math.sqrt(at.of.gravity * height):  # a billionth of the potential energy
        yield f"end: came to rest with a velocity of {speed:.3g} m/s"


def _undecided(r: Told, word: str, last: float) -> Found:
    """No solution, or several: so say all patterns of the last state."""
    at = r.at(r.run.end[None])
    ax, ay = (float(a[0]) for a in r.shaking(np.array([last])))
    margin = max(1e-6, 1e-2 * r.loose)
    everywhere: list[Fit] = []
    last_mode = r.targets[-1] if len(r.times) and r.times[-1] >= last else r.mode[-1]
    closed = np.array(r.pattern(last_mode)) != OPEN
    # whether a point touches that is as near as rounding, or has just left, is not decided
    beside = np.flatnonzero(~closed & (at.gaps[0] <= 1e-7 * r.by_hand.size))
    for count in range(2 ** len(beside)):
        touching = closed.copy()
        touching[[i for k, i in enumerate(beside) if count >> k & 1]] = True
        fits = modes_that_fit(at, ax, ay, touching, r.speed, margin)
        apart = distinct([fit for fit in fits if _lasts(r, fit, last)])
        if len(apart) != 1:
            return
        everywhere += apart
    if len(distinct(everywhere)) == 1:
        names = [p.name for p in at.parts.points]
        words = ("open", "sticks", "slips to the right", "slips to the left")
        states = [f"{n} {words[s]}" for n, s in zip(names, apart[0].pattern, strict=True)]
        yield f"{word}: at {last:.9g} s, where one mode fits: {', '.join(states)}"


def _lasts(r: Told, fit: Fit, last: float) -> bool:
    """Whether the points of a pattern still press a little later, as they and the ground move."""
    at = fit.at
    tau = 1e-4 * math.sqrt(at.of.size / at.of.gravity)
    ax, ay = (float(a[0]) for a in r.shaking(np.array([last + tau])))
    q, v = at.states.q, at.states.v
    moved = q + tau * v + 0.5 * tau**2 * fit.motion
    later = at.of.at(moved, v + tau * fit.motion, at.states.internal)
    solved = later.solve(fit.pattern, later.forces(ax, ay))
    scale = 1e-9 * float(later.load(ax, ay))
    return not (solved.pressed < -scale).any()


def modes_that_fit(
    at: At, ax: float, ay: float, touching: np.ndarray, speed: float, margin: float
) -> list[Fit]:
    """Patterns of one state whose forces fit; none where velocities after a landing are not one.

    touching : of each point, whether it does. margin : of forces and accelerations, by which a
    pattern may miss, ten times that of velocities.
    """
    size = at.of.size
    small = 0.1 * margin * (speed + math.sqrt(at.of.gravity * size) * 1e-6)
    closing = touching & (at.rates[0, :, 1] < -small)
    if closing.any():
        after = distinct(impulses(at, touching, small))
        if len(after) != 1:
            return []
        at = at.of.at(at.states.q, after[0].solved.motion, at.states.internal)
    near = touching & (at.rates[0, :, 1] <= small)
    return motions(at, near, (ax, ay), small, margin)
