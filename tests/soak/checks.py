"""What must hold for every motion, whatever the structure, the ground, the start and the options.

`on_record` looks at one response; the others compare it with a second one. Each check yields a line
for each violation. Bounds follow from the tolerances of the run: a state may be wrong by SLACK
times what a step is allowed, and an energy or a gap by what such an error makes of it.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np

import rockeom as rk
from rockeom.codes import IMPACT, REST, SWITCH, UPLIFT
from rockeom.motion.segments import END, START, begun_later
from rockeom.sweeps.run import lanes_pay
from tests.soak.cases import Dice, Motion, draw, is_even, other_side
from tests.soak.physics import Physics, physics
from tests.soak.tangents import wrong_tangents
from tests.sweeping import simulate_many

EPS = np.finfo(float).eps
SLACK = 1000.0
"""By how much a step may be less accurate than its estimated error says."""
SMOOTH = 20_000.0
"""The same of Radau's estimate, which is of order 3 and leaves out what is damped."""
NARROW = 5000.0
"""The same of structures with forces in narrow places, or a law of impact with kinks: steps were
seen that are a thousand times less accurate."""
FINEST = 1e-11
"""Below this relative tolerance rounding errors are as large."""
COARSE = {"DOP853": 1e-7, "RK45": 1e-7, "Radau": 1e-3}
"""Relative error from which on an equal step is refined, as in the loop."""
FINISHED = {"completed", "came to rest", "overturned"}
LIMITS = {"stalled", "too many impacts"}
"""Outcomes of motions that take as many steps, or impacts, as are allowed."""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(8)
NODES, WEIGHTS = 0.5 + 0.5 * _POINTS, 0.5 * _WEIGHTS
_POWERS = NODES[:, None] ** np.arange(8)

Found = Iterator[str]


@dataclass(frozen=True)
class Record:
    """A response as arrays: n steps, m passages, N states.

    mode (n,), times (m,), kinds (m,), sources and targets (m,), before and after (m, N).
    """

    motion: Motion
    run: rk.Response

    def altered(self, **changes) -> Self:
        """With other arrays: span, mode, powers, times, kinds, states; and end, outcome, duration.

        Such a response is wrong, and a check must notice it.
        """
        run = self.run
        of_steps = {k: changes.pop(k) for k in ("span", "mode", "powers") if k in changes}
        columns = {k: changes.pop(k) for k in ("times", "kinds", "states") if k in changes}
        events = replace(run.events, columns=run.events.columns._replace(**columns))
        other = replace(run, record=replace(run.steps, **of_steps), events=events, **changes)
        return replace(self, run=other)

    @cached_property
    def program(self):
        return self.run.structure.module

    @cached_property
    def physics(self) -> Physics:
        return physics(self.motion.structure.model)

    @cached_property
    def p(self) -> np.ndarray:
        values = self.motion.structure.parameters()
        return np.array([float(values[n]) for n in self.program.PARAMETERS])

    @cached_property
    def start(self) -> np.ndarray:
        return self.run.steps.span[:, 0]

    @cached_property
    def length(self) -> np.ndarray:
        return self.run.steps.span[:, 1]

    @cached_property
    def stop(self) -> np.ndarray:
        return self.start + self.length

    @property
    def mode(self) -> np.ndarray:
        return self.run.steps.mode

    @property
    def times(self) -> np.ndarray:
        return self.run.events.columns[0]

    @property
    def kinds(self) -> np.ndarray:
        return self.run.events.columns[1][:, 0]

    @property
    def sources(self) -> np.ndarray:
        return self.run.events.columns[1][:, 1]

    @property
    def targets(self) -> np.ndarray:
        return self.run.events.columns[1][:, 2]

    @property
    def before(self) -> np.ndarray:
        return self.run.events.columns[2][:, 0]

    @property
    def after(self) -> np.ndarray:
        return self.run.events.columns[2][:, 1]

    @cached_property
    def first(self) -> np.ndarray:
        """(n, N) state at the start of each step."""
        return self.run.steps.powers[:, 0]

    @cached_property
    def last(self) -> np.ndarray:
        return self.run.steps.powers.sum(axis=1)

    @cached_property
    def inside(self) -> np.ndarray:
        """(n, 8, N) states at the nodes of each step."""
        return np.einsum("xj,nji->nxi", _POWERS, self.run.steps.powers)

    @cached_property
    def ground(self) -> tuple[np.ndarray, np.ndarray]:
        """(n, 8) accelerations at the nodes of each step."""
        return self.shaking(self.start[:, None] + self.length[:, None] * NODES)

    def shaking(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Accelerations of the ground at times of any shape."""
        vertical = self.motion.vertical
        ay = np.zeros(np.shape(t)) if vertical is None else vertical.acceleration(t)
        return self.motion.motion.acceleration(t), ay

    @cached_property
    def rests(self) -> np.ndarray:
        """(n,) whether a step stands for infinitely many impacts."""
        ends = self.times[self.kinds == REST]
        return np.isin(self.stop, ends) if len(ends) else np.zeros(len(self.start), bool)

    @property
    def slack(self) -> float:
        if self.motion.options.method == "Radau":
            return SMOOTH
        return NARROW if self.program.LOCALISED else SLACK

    @property
    def closed_gap(self) -> float:
        """By how much feet may miss the ground, as the loop has it (CLOSED_GAP)."""
        return 1e-12 * self.motion.structure.overturning_rotation

    def error(self, y: np.ndarray) -> np.ndarray:
        """(n, N) what each of the states y (n, N) may be wrong by."""
        o = self.motion.options
        size = np.abs(y)
        coarser = max(1.0, COARSE[o.method] / o.rtol) if o.steps_per_segment else 1.0
        return self.slack * coarser * (o.atol + max(o.rtol, FINEST) * size)

    def energies(self, mode: np.ndarray, y: np.ndarray) -> np.ndarray:
        """(3, n) of states (n, N) in modes (n,)."""
        out = np.empty((3, len(y)))
        for c in np.unique(mode):
            at = mode == c
            out[:, at] = self.physics.energies(c, y[at].T, self.p)
        return out

    def energy_error(self, mode: np.ndarray, y: np.ndarray) -> np.ndarray:
        """(n,) what the energy may be wrong by, for states that are."""
        total = self.energies(mode, y)
        error = 2000 * EPS * np.abs(total).sum(axis=0)
        total = total.sum(axis=0)
        for i, step in enumerate(self.error(y).T):
            moved = y.copy()
            moved[:, i] += step
            error += np.abs(self.energies(mode, moved).sum(axis=0) - total)
        return error


# -- one response


def on_record(r: Record) -> Found:
    yield from finite(r)
    yield from ordered(r)
    yield from joined(r)
    yield from passages(r)
    yield from guarded(r)
    yield from balanced(r)
    yield from ended(r)
    yield from gave_up(r)


def finite(r: Record) -> Found:
    """No number is NaN or infinite, unless the outcome says so."""
    if r.run.outcome is rk.Outcome.NOT_FINITE:
        return
    steps = r.run.steps
    for what, values in (
        ("steps", steps.span), ("states", steps.powers), ("final state", r.run.end),
        ("event times", r.times), ("events", r.run.events.columns[2]),
    ):  # fmt: skip
        if not np.isfinite(values).all():
            yield f"not finite: {what} of a motion that {r.run.outcome}"


def ordered(r: Record) -> Found:
    """Time goes on without gaps, and each mode follows from the one before."""
    grain = 8 * EPS * max(float(r.stop[-1]), 0.0) + 1e-300
    if abs(r.start[0]) > 0.0:
        yield f"time: the first step begins at {r.start[0]}"
    if not (r.length > 0).all():
        yield "time: a step without length"
    gap = np.abs(r.start[1:] - r.stop[:-1])
    if len(gap) and gap.max() > grain:
        yield f"time: a gap of {gap.max():.3g} s at {r.stop[int(gap.argmax())]:.9g} s"
    if len(r.times) and (np.diff(r.times) < 0).any():
        yield "time: events not in order"
    wrong = np.flatnonzero(r.sources[1:] != r.targets[:-1])
    if len(wrong):
        i = wrong[0] + 1
        names = r.program.MODES
        yield (
            f"modes: the event at {r.times[i]:.9g} s leaves {names[r.sources[i]]}, the one before "
            f"leads to {names[r.targets[i - 1]]}"
        )


def joined(r: Record) -> Found:
    """Each step begins where the step or event before it has ended."""
    names = np.array(r.program.MODES)
    # events happen at the start of a step, to the last bit; those at the end have none after them
    at = np.searchsorted(r.times, r.start[1:], side="left")
    until = np.searchsorted(r.times, r.start[1:], side="right")
    into, out_of = np.arange(1, len(r.start)), np.arange(len(r.start) - 1)
    # where time stands still for some steps, their order and that of events is not told
    tied = (r.start[1:] == r.start[:-1]) | (r.start[1:] == np.append(r.start[2:], -1.0))
    plain = (at == until) & ~r.rests[1:] & ~tied
    rounding = 2000 * EPS * np.abs(r.run.steps.powers).max(axis=1)[:-1]
    for kind, these, state, mode, target_state, target in (
        ("the step", plain, r.last[out_of], r.mode[out_of], r.first[into], r.mode[into]),
        *(() if not len(r.times) else (
            ("the event", (at < until) & ~r.rests[:-1] & ~tied, r.last[out_of], r.mode[out_of],
             r.before[np.minimum(at, len(r.times) - 1)],
             r.sources[np.minimum(at, len(r.times) - 1)]),
            ("the step after the event", (at < until) & ~r.rests[1:] & ~tied, r.after[until - 1],
             r.targets[until - 1], r.first[into], r.mode[into]),
        )),
    ):  # fmt: skip
        room = r.error(state) / r.slack + 1e-9 * np.abs(state) + rounding
        off = these & (np.abs(target_state - state) > room).any(axis=1)
        if off.any():
            yield f"joined: {kind} at {r.start[into[off][0]]:.9g} s begins from another state"
        off = these & (mode != target)
        if off.any():
            i = int(np.flatnonzero(off)[0])
            yield (
                f"joined: {kind} at {r.start[into[i]]:.9g} s begins in {names[target[i]]}, "
                f"what is before it ends in {names[mode[i]]}"
            )


def passages(r: Record) -> Found:
    """What an event may change of the state, and where it may happen."""
    if not len(r.times):
        return
    m = r.program
    half, rotation = m.N_STATES // 2, m.ROTATION
    moved = r.after - r.before
    rate = half + rotation
    error = r.error(r.before)
    names = np.array(m.MODES)
    sides = np.array(m.SIDES)

    def told(i: int) -> str:
        return f"at {r.times[i]:.9g} s from {names[r.sources[i]]} to {names[r.targets[i]]}"

    impact, rest = r.kinds == IMPACT, r.kinds == REST
    room = np.maximum(error[:, rotation], r.closed_gap)
    for i in np.flatnonzero(impact & (np.abs(r.before[:, rotation]) > room))[:1]:
        yield f"impact {told(i)}: the gap is {r.before[i, rotation]:.6g}, not closed"
    closing = sides[r.sources] * r.before[:, rate]
    # where a gap closes at its turning point, what it may be wrong by makes a speed
    bend = np.abs(r.last[:, rate] - r.first[:, rate]) / r.length
    with np.errstate(invalid="ignore"):
        bend = np.nanmax(np.where(r.length > 1e-12 * r.stop[-1], bend, 0.0), initial=0.0)
    fast = error[:, rate] + np.sqrt(2 * bend * error[:, rotation])
    for i in np.flatnonzero(impact & (closing > fast))[:1]:
        yield f"impact {told(i)}: the gap opens with {closing[i]:.6g}"
    opening = sides[r.targets] * r.after[:, rate]
    for i in np.flatnonzero(impact & (opening < 0.0))[:1]:
        yield f"impact {told(i)}: the new gap closes with {opening[i]:.6g}"
    others = [i for i in range(half) if i != rotation]
    may_set = [i for i in others if m.STATES[i] in ("permanent_extension", "passage_speed")]
    fixed = [i for i in others if i not in may_set]
    for i in np.flatnonzero(~rest & (np.abs(moved[:, fixed]) > 0.0).any(axis=1))[:1]:
        yield f"event {told(i)}: a position jumps"
    switch = (r.kinds == SWITCH) | (r.kinds == UPLIFT)
    still = [i for i in range(m.N_STATES) if i not in may_set]
    for i in np.flatnonzero(switch & (np.abs(moved[:, still]) > 0.0).any(axis=1))[:1]:
        yield f"event {told(i)}: a {['', 'n uplift', ' switch'][r.kinds[i]]} changes the state"
    for i in np.flatnonzero(rest & ((sides[r.targets] != 0) | (r.after[:, rate] != 0.0)))[:1]:
        if sides[r.targets[i]] != 0:
            yield f"rest {told(i)}: not in full contact"

    # energy: an impact takes, or leaves it; a switch leaves it
    old, new = r.energies(r.sources, r.before), r.energies(r.targets, r.after)
    floor = 1e-12 * np.abs(old).sum(axis=0) + r.energy_error(r.sources, r.before) * impact
    gained = (new - old).sum(axis=0)
    gives = "u" in m.STATES[1:half] and not isinstance(r.motion.impact, rk.Impulsive)
    if isinstance(r.motion.structure, rk.OffsetBlock):  # of another inertia about each foot
        gives = isinstance(r.motion.impact, rk.VelocityRatio)
    if not gives:
        for i in np.flatnonzero(impact & (gained > floor))[:1]:
            yield f"impact {told(i)}: the energy grows by {gained[i]:.3g} from {old[:, i]}"
    if r.motion.structure.model != "two_spring_structure":
        floor = 1e-11 * np.abs(old).sum(axis=0) + r.energy_error(r.sources, r.before)
        # a mode that is named, and is over, is left at once: its energy was that of the name
        named = (r.times == 0.0) & (r.motion.mode is not None)
        for i in np.flatnonzero(switch & ~named & (np.abs(gained) > floor))[:1]:
            yield f"event {told(i)}: the energy changes by {gained[i]:.3g} J of {old[:, i]}"


def guarded(r: Record) -> Found:
    """Every guard of the mode is positive inside each step: nothing is penetrated."""
    ax, ay = r.ground
    names = r.program.MODES
    for c in np.unique(r.mode):
        steps = np.flatnonzero((r.mode == c) & ~r.rests)
        y = r.inside[steps].reshape(-1, r.program.N_STATES)
        if not len(y):
            continue
        gx, gy = ax[steps].ravel(), ay[steps].ravel()
        g = r.physics.guards(c, y.T, r.p, gx, gy)
        doubtful = np.flatnonzero((g < 0.0).any(axis=0))
        if not len(doubtful):
            continue
        y, gx, gy, g = y[doubtful], gx[doubtful], gy[doubtful], g[:, doubtful]
        room = 1e-12 * np.abs(g)
        wrong = r.error(y)
        rotation = r.program.ROTATION
        wrong[:, rotation] = np.maximum(wrong[:, rotation], r.closed_gap)
        for i, step in enumerate(wrong.T):
            moved = y.copy()
            moved[:, i] += step
            room += np.abs(r.physics.guards(c, moved.T, r.p, gx, gy) - g)
        for dx, dy in ((1.0, 0.0), (0.0, 1.0)):
            shaken = r.physics.guards(c, y.T, r.p, gx + dx, gy + dy) - g
            room += r.slack * 1e-13 * np.abs(shaken) * (1.0 + np.abs(gx) + np.abs(gy))
        beyond = -g - room
        if (beyond > 0.0).any():
            guard, at = np.unravel_index(int(beyond.argmax()), beyond.shape)
            step = steps[doubtful[at] // len(NODES)]
            kind = ("gap", "uplift", "switch")[r.program.KINDS[c][guard]]
            yield (
                f"guard: the {kind} that ends {names[c]} is {g[guard, at]:.3g} (may be "
                f"{-room[guard, at]:.3g}) inside the step from {r.start[step]:.9g} s, "
                f"{r.length[step]:.3g} s"
            )


def balanced(r: Record) -> Found:
    """Energy changes in each step by the work of the ground, of dampers and of other forces."""
    ax, ay = r.ground
    n = len(r.start)
    work = np.empty((2, n, len(NODES)))
    for c in np.unique(r.mode):
        steps = np.flatnonzero(r.mode == c)
        y = r.inside[steps].reshape(-1, r.program.N_STATES).T
        found = r.physics.power(c, y, r.p, ax[steps].ravel(), ay[steps].ravel())
        work[:, steps] = found.reshape(2, len(steps), -1)
    work = work @ WEIGHTS * r.length
    old, new = r.energies(r.mode, r.first), r.energies(r.mode, r.last)
    lacks = (new - old).sum(axis=0) - work.sum(axis=0)
    room = np.maximum(r.energy_error(r.mode, r.first), r.energy_error(r.mode, r.last))
    room += 1e-13 * np.abs(work).sum(axis=0)
    if "substitute" in r.motion.structure.model:
        # forces that no energy belongs to: their work follows from the dense output
        room *= 20.0
    with np.errstate(invalid="ignore"):
        ratio = np.where(r.rests, 0.0, np.abs(lacks) / room)
    for i in np.flatnonzero(ratio > 1.0):  # is it the power that has a narrow peak in the step?
        lacks[i] = (new - old).sum(axis=0)[i] - _work_in_parts(r, i)
        ratio[i] = abs(lacks[i]) / room[i]
    if len(ratio) and ratio.max() > 1.0:
        i = int(ratio.argmax())
        yield (
            f"energy: {lacks[i]:.3g} J from nothing in the step from {r.start[i]:.9g} s, "
            f"{r.length[i]:.3g} s, in {r.program.MODES[r.mode[i]]}: {ratio[i]:.3g} of what "
            f"may be, {abs(lacks[i]) / max(np.abs(new[:, i]).max(), 1e-300):.3g} of the energy"
        )
    yield from _rests(r)


def _work_in_parts(r: Record, step: int, parts: int = 64) -> float:
    """What all forces do in a step, looked at in many places."""
    x = ((np.arange(parts)[:, None] + NODES) / parts).ravel()
    y = x[:, None] ** np.arange(8) @ r.run.steps.powers[step]
    t = r.start[step] + r.length[step] * x
    vertical = r.motion.vertical
    ay = np.zeros(t.shape) if vertical is None else vertical.acceleration(t)
    power = r.physics.power(r.mode[step], y.T, r.p, r.motion.motion.acceleration(t), ay)
    return float(power.sum(axis=0) @ np.tile(WEIGHTS, parts) / parts * r.length[step])


def _rests(r: Record) -> Found:
    """Over infinitely many impacts energy changes by the work done, less what they take.

    The event tells what they took. By a law that prescribes the ratio of the rates of rotation,
    that is the sum of a series of impacts with the other rates as they are; by the impulsive law
    they give nothing.
    """
    m = r.program
    _, ratio = r.motion.structure.law(r.motion.impact)
    half, rotation = m.N_STATES // 2, m.ROTATION
    ax, ay = r.ground
    for e in np.flatnonzero(r.kinds == REST)[:20]:
        start = r.before[e]
        if e and r.kinds[e - 1] == IMPACT and r.targets[e - 1] == r.sources[e]:
            start = r.after[e - 1]
        steps = np.flatnonzero(r.rests & (r.stop == r.times[e]))
        work = doubt = 0.0
        if len(steps):
            i = int(steps[0])
            power = r.physics.power(r.mode[i], r.inside[i].T, r.p, ax[i], ay[i])
            work = float((power.sum(axis=0) @ WEIGHTS) * r.length[i])
            # the rates change in this time, and the step has them all changed from its beginning
            both = np.array([start, r.first[i]])
            power = r.physics.power(r.mode[i], both.T, r.p, ax[i, [0, 0]], ay[i, [0, 0]])
            doubt = abs(np.diff(power.sum(axis=0))[0]) * r.length[i]
            modes = np.array([r.sources[e], r.targets[e]])
            early = -np.diff(r.energies(modes, both).sum(axis=0))[0]
            upright = start.copy()
            upright[half + rotation] = 0.0
            both[0] = upright
            given = np.diff(r.energies(modes[[1, 1]], both).sum(axis=0))[0]
            jump = np.abs(r.first[i] - start)[:half]
            jump[rotation] = 0.0
            room = r.error(start[None])[0, :half] / r.slack + 1e-12 * np.abs(start[:half])
            if (jump > room).any():
                yield f"rest at {r.times[e]:.9g} s: a position jumps by {jump.max():.3g}"
        modes = r.sources[e], r.targets[e], r.sources[e], r.targets[e]
        states = np.array([start, r.after[e], r.before[e], r.after[e]])
        total = r.energies(np.array(modes), states).sum(axis=0)
        lost, told = total[0] + work - total[1], total[2] - total[3]
        error = r.energy_error(r.targets[[e]], r.after[[e]])[0] + 0.03 * abs(lost) + 2 * doubt
        if len(steps):  # what the impacts give to the other rates, and take again
            error += abs(early - told) + 0.03 * abs(given)
        where = f"rest at {r.times[e]:.9g} s: {lost:.9g} J are lost"
        if abs(lost - told) > error:
            yield f"{where}, the event tells {told:.9g}; {error:.3g} may be"
        impulsive = isinstance(r.motion.impact, rk.Impulsive)
        least, most = 0.0 if impulsive else -math.inf, math.inf
        others = [i for i in range(half, m.N_STATES) if i != half + rotation]
        steady = np.abs(r.after[e] - r.before[e])[others] <= 1e-2 * np.abs(r.before[e][others])
        if not impulsive and 0.0 <= ratio < 1.0 and steady.all():
            least = most = _taken(r, start, int(r.sources[e]), ratio, rotation, half + rotation)
            error += 0.03 * abs(most)  # the other rates change a little
        if not least - error <= lost <= most + error:
            yield f"{where}, but impacts take {least:.9g} to {most:.9g}; {error:.3g} may be"


def _taken(r: Record, start: np.ndarray, mode: int, ratio: float, rotation: int, rate: int):
    """What a series of impacts takes, the rates of the other coordinates as they are [J]."""
    m = r.program
    n = 1 if ratio == 0.0 else min(math.ceil(-40.0 / math.log(ratio)), 100_000)
    speed = abs(start[rate]) * ratio ** np.arange(n + 1.0)
    other = next(
        c for c, side in enumerate(m.SIDES)
        if side == -m.SIDES[mode] and m.MODES[c] == other_side(m.MODES[mode])
    )  # fmt: skip
    sides = m.SIDES[mode] * (-1.0) ** np.arange(n)
    modes = np.where(sides == m.SIDES[mode], mode, other)
    states = np.repeat(start[None], n, axis=0)
    states[:, rotation] = 0.0
    states[:, rate] = -sides * speed[:-1]
    before = r.energies(modes, states).sum(axis=0)
    states[:, rate] = -sides * speed[1:]
    after = r.energies(np.where(modes == mode, other, mode), states).sum(axis=0)
    return float((before - after).sum())


def ended(r: Record) -> Found:
    """The outcome is that of the last state."""
    m, run = r.program, r.run
    rotation = m.ROTATION
    fallen = r.motion.structure.overturning_rotation
    end = r.stop[-1]
    if len(r.times):
        end = max(end, r.times[-1])
    whole = abs(end - run.duration) <= 8 * EPS * run.duration
    went_on = run.outcome in (rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST)
    if run.outcome is rk.Outcome.STALLED:
        return  # in the middle of an event
    if went_on and not whole:
        yield f"end: {run.outcome} at {end:.9g} s of {run.duration:.9g} s"
    turned = abs(run.end[rotation])
    near = abs(turned - fallen) <= 1e-6 * fallen + r.error(run.end[None])[0, rotation]
    if run.outcome is rk.Outcome.OVERTURNED and not whole and not near:
        yield f"end: overturned at {end:.9g} s with a rotation of {turned:.6g} below {fallen:.6g}"
    if went_on and not turned < fallen * (1 + 1e-9):
        yield f"end: {run.outcome} with a rotation of {turned:.6g} beyond {fallen:.6g}"
    inside = np.abs(r.inside[..., rotation]).max(axis=1)
    over = np.flatnonzero(inside > fallen + 2 * r.error(r.first)[:, rotation])
    if len(over):
        i = int(over[0])
        yield (
            f"end: a rotation of {inside[i]:.9g} beyond {fallen:.9g} in the step from "
            f"{r.start[i]:.9g} s, and the motion goes on"
        )
    if len(r.times) and r.times[-1] >= end:
        if (run.end != r.after[-1]).any():
            yield "end: the final state is not that after the last event"
    elif went_on or run.outcome is rk.Outcome.OVERTURNED:
        error = r.error(r.last[-1:])[0] / r.slack + 1e-9 * np.abs(r.last[-1])
        error += 2000 * EPS * np.abs(r.run.steps.powers[-1]).max(axis=0)
        if (np.abs(run.end - r.last[-1]) > error).any():
            yield "end: the final state is not that of the last step"


def gave_up(r: Record) -> Found:
    """No motion is given up that default options follow to its end.

    Except for as many steps, of a length to be seen, as its options allow.
    """
    words = rk.Outcome.CHATTER, rk.Outcome.STALLED, rk.Outcome.NOT_FINITE
    if r.run.outcome not in words:
        return
    crawls = r.run.outcome is not rk.Outcome.STALLED or r.length[-1] < 1e-10 * r.run.duration
    o = r.motion.options
    free = rk.SolverOptions(max_impacts=o.max_impacts, max_steps=5 * o.max_steps)
    if crawls and free != o:
        default = replace(r.motion, options=free).run()
        if default.outcome not in words:
            yield f"gave up: {r.run.outcome} at {r.stop[-1]:.9g} s, by default {default.outcome}"


# -- compared with another


def mirrored(r: Record) -> Found:
    """Left and right exchanged: the same numbers to the last bit, with other signs."""
    m = r.program
    vertical = r.motion.vertical
    rigid_ground = r.motion.structure.rocks_on_rigid_ground
    if vertical is not None and rigid_ground and vertical.peak >= _gravity(r.motion.structure):
        return  # both feet would lift at once, which no mode describes
    twin = r.motion.mirrored()
    image = Record(twin, twin.run())
    names = m.MODES
    if image.run.outcome is not r.run.outcome:
        yield f"mirror: {r.run.outcome}, its image {image.run.outcome}"
        return
    apart = np.diff(r.times) / np.maximum(r.times[1:], 1e-300)
    if ((apart > 0.0) & (apart < 1e-12)).any():
        return  # two feet at once, but for rounding: which one is first is not told
    swapped = np.array([names.index(other_side(n)) if other_side(n) in names else i
                        for i, n in enumerate(names)])  # fmt: skip
    a = _chains(r, np.arange(len(names)))
    b = _chains(image, swapped)
    if a != b:
        first = next(
            (i for i, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b))
        )
        told = [
            f"{x[first][0]!r} {names[x[first][2]]} to {names[x[first][3]]}"
            if first < len(x)
            else "none"
            for x in (a, b)
        ]
        yield f"mirror: event {first} of {len(a)} is {told[0]}, of {len(b)} in the image {told[1]}"
        return
    signs = np.array([1.0 if is_even(n) else -1.0 for n in m.STATES])
    if len(r.start) != len(image.start) or (r.start != image.start).any():
        yield "mirror: other steps"
    elif (r.first != signs * image.first).any() or (r.run.end != signs * image.run.end).any():
        yield "mirror: other states"


def _chains(r: Record, names: np.ndarray) -> list[tuple]:
    """(time, kinds, first source, last target) of the events, those of one moment together.

    Both feet may lift, or land, at once: then it is all the same which is called the first.
    """
    found: list[tuple] = []
    for t, k, s, e in zip(r.times, r.kinds, names[r.sources], names[r.targets], strict=True):
        if found and found[-1][0] == t and found[-1][1] == k == SWITCH:
            found[-1] = (t, k, found[-1][2], e)
        else:
            found.append((t, k, s, e))
    return found


def _gravity(structure) -> float:
    return float(structure.parameters().get("gravity", 1.0))


def cut(r: Record) -> Found:
    """Cut in two and continued from the final state and mode: the whole motion.

    How much a small error grows is measured by a third motion, which continues from a state moved
    by what a step is allowed (or under ground scaled by as much, where nothing moves at the cut):
    the bound is 1e-9 of the largest state, and thirty times that. What steps err by later may grow
    more; so both are made again with a thousandth of the tolerance (1e-13 at least), and a
    difference that does not become smaller is none of steps.
    """
    line, apart = _apart(r)
    o = r.motion.options
    if apart is not None:
        motion = replace(r.motion, options=finer(o))
        again, still = _apart(Record(motion, motion.run()))
        if not again or (still is not None and (still <= 0.1 * apart).all()):
            return
    if line:
        yield line


def finer(o: rk.SolverOptions) -> rk.SolverOptions:
    """A thousandth of the tolerance, as far as rounding errors allow."""
    part = max(1e-3, 1e-13 / o.rtol)
    return replace(o, rtol=part * o.rtol, atol=part * o.atol, max_steps=20 * o.max_steps)


def _apart(r: Record) -> tuple[str, np.ndarray | None]:
    """What is wrong with a motion in two parts, if anything, and how far apart the ends are."""
    dice = Dice(r.motion.seed, 0, 2)
    run, m = r.run, r.program
    if run.outcome not in (rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST):
        return "", None
    if r.motion.options.steps_per_segment:
        return "", None  # another length of the laws, and so of the steps
    at = run.duration * dice.between(0.05, 0.95)
    first = rk.simulate(
        r.motion.structure, r.motion.motion, **r.motion.arguments(), duration=at,
        options=r.motion.options,
    )  # fmt: skip
    if not math.isclose(first.steps.span[-1].sum(), at, rel_tol=1e-12):
        if first.outcome in (rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST):
            return f"cut: {first.outcome} at {first.steps.span[-1].sum():.9g} s of {at:.9g} s", None
        return "", None
    events = first.events.columns[0]
    mode = first.steps.mode[-1]
    if len(events) and events[-1] >= first.steps.span[-1].sum():
        mode = first.events.columns[1][-1, 2]

    def rest(state: np.ndarray, scale: float = 1.0) -> rk.Response:
        initial = dict(zip(m.STATES, state.tolist(), strict=True))
        return rest_of(r.motion, at, scale, initial=initial, mode=m.MODES[mode])

    second = rest(first.end)
    o = r.motion.options
    largest = np.abs(r.first).max(axis=0)
    grown = np.zeros(len(largest))
    turned = (
        m.ROTATION if m.SIDES[mode] == 0.0 and r.motion.structure.rocks_on_rigid_ground else None
    )
    for sign in (1.0, -1.0):
        moved = first.end + sign * (o.atol + o.rtol * np.abs(first.end)) * np.where(
            first.end != 0, 1.0, 0.0
        )
        if turned is not None:
            moved[turned] = moved[turned + len(moved) // 2] = 0.0
        try:
            twin = rest(moved, 1.0 if moved.any() else 1.0 + sign * o.rtol)
        except ValueError:
            return "", None  # so near to an impact that it is moved below the ground
        if twin.outcome is not second.outcome or len(twin.events.columns[0]) != len(
            second.events.columns[0]
        ):
            return "", None  # any error decides
        grown = np.maximum(grown, np.abs(twin.end - second.end))
    bound = 1e-9 * largest + 30 * r.slack / SLACK * (grown + o.rtol * largest + o.atol)
    if (bound > 1e-3 * largest + 1000 * o.atol).any():
        return "", None
    if second.outcome is rk.Outcome.STALLED:
        return "", None  # a tolerance of rounding errors' size: as many steps as were allowed
    if second.outcome is not run.outcome:
        return f"cut at {at!r} s: {second.outcome}, the whole {run.outcome}", None
    apart = np.abs(second.end - run.end)
    if not (apart > bound).any():
        return "", None
    i = int(np.flatnonzero(apart > bound)[0])
    return (
        f"cut at {at!r} s: {m.STATES[i]} ends at {second.end[i]!r}, the whole at "
        f"{run.end[i]!r}; {bound[i]:.3g} may be"
    ), apart


def rest_of(m: Motion, at: float, scale: float = 1.0, **start: Any) -> rk.Response:
    """The motion from a time on, from another start, on ground that is scaled."""
    whole = m.motion.duration
    how = {**m.arguments(), **start, "duration": whole - at}
    how["vertical"] = None if m.vertical is None else later(m.vertical, at, whole)
    ground = later(m.motion, at, whole).scaled(scale)
    return rk.simulate(m.structure, ground, **how, options=m.options)


def later(motion: rk.GroundMotion, t: float, duration: float) -> rk.GroundMotion:
    """The rest of a motion from time t on."""
    laws = motion.segments[motion.segments[:, END] > t]
    if not len(laws):
        return rk.GroundMotion.none(duration - t)
    laws = begun_later(laws, np.maximum(t - laws[:, START], 0.0))
    laws[:, : END + 1] -= t
    laws[0, START] = 0.0
    return rk.GroundMotion(laws)


def many(r: Record) -> Found:
    """Without lanes `simulate_many` has the bits of `simulate`, however the work is shared out."""
    motions = [r.motion, *(draw(r.motion.seed, sibling) for sibling in range(1, 5))]
    ends = []
    kept = []
    for motion in motions:
        try:
            run = motion.run()
        except ValueError:
            continue
        kept.append(motion)
        ends.append((str(run.outcome), sum(run.events.columns[1][:, 0] == IMPACT), run.end))
    reverse = list(range(len(kept)))[::-1]
    for order, how in (
        (reverse[::-1], {"threads": 1, "chunk": 256}),
        (reverse, {"threads": 2, "chunk": 2}),
    ):
        data = simulate_many(
            lambda n: kept[n].case(),
            over={"n": order},
            options=r.motion.options,
            progress=False,
            lanes=False,
            **how,
        )
        for i, n in enumerate(order):
            outcome, impacts, end = ends[n]
            same = str(data.outcome.values[i]) == outcome and int(data.impacts.values[i]) == impacts
            same = same and np.array_equal(data.final.values[i], end, equal_nan=True)
            if not same:
                yield (
                    f"many: sibling {n} with {how} is {data.outcome.values[i]} after "
                    f"{int(data.impacts.values[i])} impacts, alone {outcome} after {impacts}, or "
                    "its state differs"
                )
                return


def lanes(r: Record) -> Found:
    """Lanes give the same bits in any order, and what equal or controlled steps give without them.

    Equal steps are taken under lines, controlled or equal ones under all laws of the ground. As far
    as that is determined: twins whose shaking and start differ by 1e-9 say by how much the end may
    differ, and whether the outcome may; by a millionth, that of controlled steps.
    """
    seed = r.motion.seed
    if not lanes_pay(r.program) or r.motion.options.method == "Radau":
        return
    yield from _in_lanes(r, Dice(seed, 0, 4).one_of(1, 2, 3, 5), linear=True)
    yield from _in_lanes(r, Dice(seed, 0, 5).one_of(0, 0, 0, 3, 20), linear=False)


def _in_lanes(r: Record, steps: int, linear: bool) -> Found:
    seed, options, kept = r.motion.seed, replace(r.motion.options, steps_per_segment=steps), []
    for sibling in range(9):
        motion = draw(seed, sibling, linear=linear)
        try:
            motion.case().problem()
        except ValueError:
            continue
        kept.append(motion)

    fast = _many(kept, True, options, threads=1)
    other = _many(kept[::-1], True, options, threads=2, chunk=3).isel(n=slice(None, None, -1))
    for name in fast.data_vars:
        a, b = fast[name].values, other[name].values
        same = a == b if a.dtype.kind in "USO" else (a == b) | (np.isnan(a) & np.isnan(b))
        if not same.all():
            yield f"lanes: another order gives another {name}"
            return
    controlled = replace(options, steps_per_segment=0)
    for i, motion in enumerate(kept):
        outcome, free = str(fast.outcome.values[i]), replace(motion, options=controlled)
        adaptive = free.run().outcome
        if _another(outcome, adaptive, free):
            yield (
                f"lanes: sibling {i} with {options.steps_per_segment} steps is {outcome}, with "
                f"controlled ones {adaptive}"
            )
    roomier = replace(
        options, max_impacts=10 * options.max_impacts, max_steps=20 * options.max_steps
    )
    for i, (line, off) in _beside(kept, options).items():
        if off is None and (not _beside([kept[i]], roomier) or _undecided(kept[i], options)):
            continue  # a limit that one way of landing just meets, or a millionth decides it
        if off is not None:
            again = _beside([kept[i]], finer(options)).get(0)
            if again is None or (again[1] is not None and (again[1] <= 0.1 * off).all()):
                continue  # errors of steps, which become smaller
        yield f"lanes: sibling {i} with {options.steps_per_segment} steps {line}"


def _undecided(motion: Motion, options: rk.SolverOptions) -> bool:
    """Whether some of twins within a millionth have another outcome than others."""
    twins = [nearly(motion, factor) for factor in np.linspace(1 - 1e-6, 1 + 1e-6, 41)]
    return len(set(_many(twins, False, options).outcome.values.tolist())) > 1


def _many(motions: list[Motion], lanes: bool, options: rk.SolverOptions, **how):
    return simulate_many(
        lambda n: motions[n].case(), over={"n": range(len(motions))}, options=options,
        progress=False, lanes=lanes, **how,
    )  # fmt: skip


def _beside(
    motions: list[Motion], options: rk.SolverOptions
) -> dict[int, tuple[str, np.ndarray | None]]:
    """What of motions in lanes is not as without them, and how far apart the ends are.

    An outcome is determined if twins have it, too; that of a limit (of steps, of impacts) only if
    they end beside each other.
    """
    fast = _many(motions, True, options, threads=1)
    near = [[nearly(motion, 1 + s) for motion in motions] for s in (0.0, -1e-9, 1e-9)]
    plain, *twins = (_many(those, False, options, threads=1) for those in near)
    found = {}
    for i in range(len(motions)):
        outcome, of_lanes = str(plain.outcome.values[i]), str(fast.outcome.values[i])
        if any(str(t.outcome.values[i]) != outcome for t in twins) or outcome not in FINISHED:
            continue
        end = plain.final.values[i]
        grown = np.max([np.abs(t.final.values[i] - end) for t in twins], axis=0)
        of_states = [v.values[i] for v in plain.data_vars.values() if "state" in v.dims]
        largest = np.abs(of_states).max(axis=0)
        bound = max(1e-8, 10 * options.rtol) * largest + 30 * grown + 100 * options.atol
        determined = (bound < 1e-3 * largest).all()
        if of_lanes != outcome and (determined or of_lanes not in LIMITS):
            found[i] = f"is {of_lanes}, without lanes {outcome}", None
        if of_lanes != outcome or outcome == "overturned" or not determined:
            continue
        off = np.abs(fast.final.values[i] - end)
        if (off > bound).any():
            n = int(np.flatnonzero(off > bound)[0])
            found[i] = (
                f"ends with {fast.state.values[n]} = {fast.final.values[i][n]!r}, without lanes "
                f"{end[n]!r}; {bound[n]:.3g} may be",
                off,
            )
    return found


def nearly(motion: Motion, factor: float) -> Motion:
    """The same with all shaking and the start multiplied."""
    vertical = motion.vertical
    return replace(
        motion,
        motion=motion.motion.scaled(acceleration=factor),
        vertical=vertical and vertical.scaled(acceleration=factor),
        initial={k: factor * v for k, v in motion.initial.items()},
    )


def equal(r: Record) -> Found:
    """Equal steps have the outcome of controlled ones, where a millionth does not decide it."""
    options = r.motion.options
    free = replace(r.motion, options=replace(options, steps_per_segment=0))
    if options.steps_per_segment:
        fixed, adaptive = r.run.outcome, free.run().outcome
    else:
        steps = Dice(r.motion.seed, 0, 3).one_of(1, 2, 3, 5, 10)
        fixed = replace(r.motion, options=replace(options, steps_per_segment=steps)).run().outcome
        adaptive = r.run.outcome
    if _another(str(fixed), adaptive, free):
        yield f"equal steps: {fixed}, with controlled ones {adaptive}"


def _another(outcome: str, adaptive: rk.Outcome, motion: Motion) -> bool:
    """Whether an outcome is not that of controlled steps, where a millionth does not decide it.

    It does where it changes the outcome, or the rotation at the end by a hundredth of the largest
    one, or its time.
    """
    if outcome == str(adaptive):
        return False
    if {outcome, str(adaptive)} & LIMITS:
        return False
    runs = [nearly(motion, factor).run() for factor in (1 - 1e-6, 1 + 1e-6)]
    if any(run.outcome is not adaptive for run in runs):
        return False
    turned = np.ptp([run.end[run.structure.module.ROTATION] for run in runs])
    ended = np.ptp([run.steps.span[-1].sum() for run in runs])
    largest = max(
        np.abs(run.steps.powers[:, 0, run.structure.module.ROTATION]).max() for run in runs
    )
    return turned <= 0.01 * largest and ended <= 0.01 * motion.motion.duration


def tangents(r: Record) -> Found:
    """Derivatives against differences, of the motion at tight tolerances."""
    yield from wrong_tangents(r.motion)


COMPARED: dict[str, tuple[float, Callable[[Record], Found]]] = {
    "mirror": (0.2, mirrored),
    "cut": (0.1, cut),
    "many": (0.05, many),
    "lanes": (0.02, lanes),
    "equal": (0.1, equal),
    "tangents": (0.02, tangents),
}
"""Checks that need more runs, each with the share of seeds that it is made for."""
