"""Newton's and Euler's laws for a body on feet, by which motions in space are checked.

Nothing of the derivation enters: forces at the feet are taken from the response, axes and spin of
the body from yaw, pitch and roll, its feet from the declaration, and the rest is mechanics of one
rigid body. States are checked many at once.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import nnls

import rockeom as rk
from rockeom.codes import REST
from rockeom.simulation.events import EventColumns, Events
from rockeom.simulation.extremes import CHUNK, SHORTEST, Search
from tests.space.bodies import rotation, spin, spin_rate

CLOSE = 1e-7
"""Relative to the weight, its moment or the momentum: what rounding and event times leave."""
STILL = 1e-7
"""[m/s], and relative to the fastest foot: a foot that sticks moves by less."""
SLOW = 1e-7
"""[m/s] of slips that turn more slowly than they should: a force across them is left out."""
HOP = 5e-6
"""[m/s] of hops of 1e-12 m, which are lost among the digits of places: they end at once."""
LAST_SLIP = 5e-5
"""[m/s] of slips that end with bounces, which are no faster."""
FIRST_SLIP = 2e-8
"""[m/s] with which slips begin, as friction then has a direction."""
OPEN, BEARS, SLIDES, RELEASED, IDLES = range(5)


def arms_of(structure: rk.Prism | rk.LeggedStatue) -> np.ndarray:
    """(m, 3) from the centroid to the feet, along the axes of the body."""
    if isinstance(structure, rk.LeggedStatue):
        feet = np.array([dict(structure.feet)[name] for name in structure.module.POINTS])
        return np.column_stack([feet, np.zeros(len(feet))]) - structure.centroid
    half = np.array([structure.width, structure.depth]) / 2
    corners = [
        (1 - 2 * ("west" in name), 1 - 2 * ("south" in name)) for name in structure.module.POINTS
    ]
    base = corners * half - [structure.offset_x, structure.offset_y]
    return np.column_stack([base, np.full(len(base), -structure.parameters()["centroid_height"])])


class Body:
    """The body of a `Prism` or `LeggedStatue` in a state, or in many (...): axes, arms and spin."""

    def __init__(self, structure: rk.Prism | rk.LeggedStatue, state: Mapping[str, Any]) -> None:
        values = structure.parameters()
        self.mass, self.gravity = values["mass"], values["gravity"]
        tensor = np.diag([values[f"inertia_{axes}"] for axes in ("xx", "yy", "zz")])
        for axes, i, j in (("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)):
            tensor[i, j] = tensor[j, i] = values.get(f"inertia_{axes}", 0.0)
        self.feet, own = structure.module.POINTS, arms_of(structure)
        axes = rotation(state)
        self.arms = own @ np.swapaxes(axes, -1, -2)  # (..., m, 3)
        self.tensor, self.spin = axes @ tensor @ np.swapaxes(axes, -1, -2), spin(state)
        self.place = np.stack([state[axis] for axis in "xyz"], -1)
        self.velocity = np.stack([state[f"{axis}_dot"] for axis in "xyz"], -1)
        self.length = float(np.linalg.norm(own, axis=1).max())
        turning = np.squeeze(self.tensor @ self.spin[..., None], -1)
        self.momentum = np.concatenate([self.mass * self.velocity, turning], -1)
        """(..., 6) linear, and angular about the centroid."""
        self.energy = (self.momentum * np.concatenate([self.velocity, self.spin], -1)).sum(-1) / 2
        """Kinetic energy."""
        self.velocities = self.velocity[..., None, :] + np.cross(self.spin[..., None, :], self.arms)
        """(..., m, 3) of the feet."""
        self.heights = self.place[..., 2:] + self.arms[..., 2]
        """(..., m) of the feet above the ground."""

    def velocity_of(self, foot: str) -> np.ndarray:
        return self.velocities[..., self.feet.index(foot), :]


def wrench(arm: np.ndarray) -> np.ndarray:
    """(6, 3) force and moment about the centroid of unit forces at the end of an arm."""
    x, y, z = arm
    return np.vstack([np.eye(3), [[0, -z, y], [z, 0, -x], [-y, x, 0]]])


def states_of(modes: Sequence[str], feet: Sequence[str]) -> np.ndarray:
    """(n, m) state of each foot in modes, by their names."""
    return np.array([_states(mode, feet) for mode in modes]).reshape(len(modes), len(feet))


@cache
def _states(mode: str, feet: tuple[str, ...]) -> list[int]:
    ends = {"": BEARS, "_slides": SLIDES, "_released": RELEASED, "_idle": IDLES}
    return [max([OPEN, *(x for end, x in ends.items() if foot + end in mode)]) for foot in feet]


def violations(run: rk.Response, friction: float | None, restitution: float = 0.0) -> Iterator[str]:
    """A line for each law that a motion violates; friction : None where feet never slip."""
    structure, feet = run.structure, run.structure.module.POINTS
    weight = structure.parameters()["mass"] * structure.parameters()["gravity"]
    length = Body(structure, run.final).length
    if (error := run.energy_balance().error) > CLOSE:
        yield f"energy is off by {error:.1e}"
    for foot, (height, force) in zip(feet, _least(run).T, strict=True):
        if height < -CLOSE * length:  # perhaps: the extremes are found more exactly
            height = run.extremes(f"{foot}_uplift").minimum
        if height < -CLOSE * length:
            yield f"{foot} is {height:.1e} m below the ground"
        if force < -CLOSE * weight:
            lowest = run.extremes(f"{foot}_reaction")
            if lowest.minimum < -CLOSE * weight:
                yield from _pulls(run, foot, lowest.minimum_time, weight)
    yield from _unbalanced(run, weight, friction)
    yield from _wrong_impacts(run, friction, restitution)
    yield from _wrong_rests(run, friction)


def _least(run: rk.Response) -> np.ndarray:
    """(2, m) least height and force of each foot, or less.

    At nine places of each step, and where parabolas through three of them turn.
    """
    names, found = [f"{foot}_reaction" for foot in run.structure.module.POINTS], []
    search = Search.within(run.steps, run._quantities.columns([*run.states, *names]))
    short = run.steps.span[:, 1] < SHORTEST  # of these the ends count
    for places, steps in ((2, np.flatnonzero(short)), (9, np.flatnonzero(~short))):
        for first in range(0, len(steps), CHUNK):
            some = steps[first : first + CHUNK]
            x = np.tile(np.linspace(0.0, 1.0, places), len(some))
            values = search.at(np.repeat(some, places), x)[1].reshape(len(some), places, -1)
            state = dict(zip(run.states, np.moveaxis(values, -1, 0), strict=False))
            both = np.stack([Body(run.structure, state).heights, values[..., len(run.states) :]])
            found += [both.min((1, 2)), _turning(both).min((1, 2), initial=np.inf)]
    return np.min(found, axis=0)


def _turning(values: np.ndarray) -> np.ndarray:
    """Least values of parabolas through three places of values (2, n, k, m); inf of others."""
    before, here, after = values[:, :, :-2], values[:, :, 1:-1], values[:, :, 2:]
    with np.errstate(all="ignore"):
        bend, slope = before - 2.0 * here + after, (after - before) / 2.0
        turns = (bend > 0.0) & (np.abs(slope) < bend)
        return np.where(turns, here - slope**2 / (2.0 * bend), np.inf)


def _pulls(run: rk.Response, foot: str, lowest: float, weight: float) -> Iterator[str]:
    """Where a foot pulls, but for where forces say nothing.

    A step over events without end is a straight line, and the direction of a slow slip is not known
    between the ends of steps. lowest : time of the least force.
    """
    rests, times = run.events.columns.of(REST).times, np.unique(np.append(run.t, lowest))
    rests = np.append(rests, np.inf)
    for side in ("left", "right"):
        y, numbers = run.steps.at(times, side)
        body = Body(run.structure, dict(zip(run.states, y.T, strict=True)))
        feet = states_of([run.structure.module.MODES[i] for i in numbers], body.feet)
        slow = (feet == SLIDES) & (np.linalg.norm(body.velocities[..., :2], axis=-1) < SLOW)
        over = rests[np.searchsorted(rests, times)] - times < 1e-5
        force = run.at(times, side, [f"{foot}_reaction"])[f"{foot}_reaction"]
        least = np.argmin(np.where(over | slow.any(-1), 0.0, force))
        if force[least] < -CLOSE * weight and not (over | slow.any(-1))[least]:
            yield f"{foot} pulls by {-force[least]:.1e} N at {times[least]:.6g} s"


class Moments(NamedTuple):
    """A motion at n times: names of modes, states by name, forces (n, m, 3) at m feet, the shaking
    (n, 3), and accelerations by name of the coordinate.
    """

    t: np.ndarray
    modes: list[str]
    state: dict[str, np.ndarray]
    forces: np.ndarray
    pushed: np.ndarray
    moves: dict[str, np.ndarray]


def moments(run: rk.Response, most: int = 40) -> Moments:
    """A motion at times of its samples."""
    module = run.structure.module
    t = np.unique(run.t[np.linspace(0, len(run.t) - 2, most).astype(int)])
    y, numbers = run.steps.at(t, "right")
    ways = ("friction_x", "friction_y", "reaction")
    names = [f"{foot}_{way}" for foot in module.POINTS for way in ways]
    forces = np.stack([*run.at(t, names=names).values()], -1).reshape(len(t), -1, 3)
    pushed, rates = shaking_of(run, t), np.empty_like(y)
    for number, now, shaking, rate in zip(numbers.tolist(), y, pushed.tolist(), rates, strict=True):
        module.rates(number, now, run.structure.vector, *shaking, rate)
    modes, state = [module.MODES[i] for i in numbers], dict(zip(run.states, y.T, strict=True))
    moves = dict(zip(run.states, rates.T[len(run.states) // 2 :], strict=False))
    return Moments(t, modes, state, forces, pushed, moves)


def _unbalanced(run: rk.Response, weight: float, friction: float | None) -> Iterator[str]:
    """Times at which forces and accelerations are not those of Newton and Euler, or feet slip."""
    t, modes, state, forces, pushed, moves = moments(run)
    body, feet = Body(run.structure, state), states_of(modes, run.structure.module.POINTS)
    yield from _let_go(body, feet, t, friction)
    acceleration = np.stack([moves[axis] for axis in "xyz"], -1) + pushed
    acceleration[:, 2] += body.gravity
    gyroscopic = np.cross(body.spin, (body.tensor @ body.spin[..., None])[..., 0])
    turning = (body.tensor @ spin_rate(state, moves)[..., None])[..., 0] + gyroscopic
    needed = np.concatenate([body.mass * acceleration, turning], -1)
    total = np.concatenate([forces.sum(1), np.cross(body.arms, forces).sum(1)], -1)
    scale = np.array([1.0] * 3 + [body.length] * 3)
    for i, (lacks, force) in enumerate(zip(total - needed, forces, strict=True)):
        size = max(weight, np.abs(force).max()) * scale  # which grow beyond all bounds in a jam
        if (np.abs(lacks) > CLOSE * size).any():
            lacks = _but_across_slow_slips(body, i, feet[i], lacks, np.abs(total[i]).max())
            if (np.abs(lacks) > CLOSE * size).any():
                yield f"forces at {t[i]:.6g} s in {modes[i]} lack {lacks}"
        if np.any(force[(friction == 0) | (feet[i] == OPEN), :2]):
            yield f"friction at {t[i]:.6g} s in {modes[i]}"
        if friction:
            bears = np.flatnonzero(force[:, 2] > 0.0)
            left = _left_by_friction(body, i, body.velocities[i], bears, total[i], friction)
            if left > CLOSE * max(weight, np.abs(total[i]).max()):  # which may grow without bound
                yield f"friction at {t[i]:.6g} s in {modes[i]} lacks {left:.1e} N"


def _let_go(body: Body, feet: np.ndarray, t: np.ndarray, friction: float | None) -> Iterator[str]:
    """Times at which feet that are closed leave the ground, or slip though they stick."""
    fastest = 1.0 + np.linalg.norm(body.velocities, axis=-1).max(-1)
    sticks = (feet == BEARS) & (friction != 0)
    for what, error, held in (
        ("is off the ground by", np.abs(body.heights) / body.length, feet != OPEN),
        ("leaves the ground at", np.abs(body.velocities[..., 2]) / fastest[:, None], feet != OPEN),
        ("slips at", np.linalg.norm(body.velocities[..., :2], axis=-1) / fastest[:, None], sticks),
    ):
        for i, foot in np.argwhere(held & (error > CLOSE)):
            yield f"{body.feet[foot]} {what} {error[i, foot]:.1e} at {t[i]:.6g} s"


def shaking_of(run: rk.Response, t: np.ndarray) -> np.ndarray:
    """(n, 3) accelerations of the ground along the axes of a structure that is turned."""
    x, y, up = (motion.acceleration(t) for motion in motions_of(run))
    cos, sin = np.cos(run.azimuth), np.sin(run.azimuth)
    return np.stack([cos * x + sin * y, cos * y - sin * x, up], -1)


def motions_of(run: rk.Response) -> tuple[rk.GroundMotion, ...]:
    none = rk.GroundMotion.none(run.duration)
    return run.motion, run.transverse or none, run.vertical or none


def _but_across_slow_slips(
    body: Body, i: int, feet: np.ndarray, lacks: np.ndarray, largest: float
) -> np.ndarray:
    """Forces that lack (6,) but for what is across slips that are slow, and in held directions.

    The acceleration across such a slip is less than its forces would give it. Its direction has
    rounding errors, by which forces that are as large as the largest turn.
    """
    columns, slowest = [], np.inf
    for arm, velocity, state in zip(body.arms[i], body.velocities[i], feet, strict=True):
        speed = np.linalg.norm(velocity)
        if state in (OPEN, IDLES):
            continue
        columns.append(wrench(arm)[:, 2])
        if state == SLIDES and speed < SLOW:
            columns.append(wrench(arm) @ [-velocity[1], velocity[0], 0.0] / speed)
            slowest = min(slowest, speed)
        elif state == BEARS:
            columns += [*wrench(arm)[:, :2].T]
    if slowest == np.inf:
        return lacks
    matrix = np.array(columns).T
    left = lacks - matrix @ np.linalg.lstsq(matrix, lacks, rcond=1e-9)[0]
    return np.sign(left) * np.maximum(np.abs(left) - 1e-15 / slowest * largest, 0.0)


def _wrong_impacts(run: rk.Response, friction: float | None, restitution: float) -> Iterator[str]:
    """Impulses of feet give the change of momentum and no energy, and gaps open as e has it."""
    module, (t, kinds, _) = run.structure.module, run.impacts.columns
    if not len(t):
        return
    (before, after), feet = _sides(run, run.impacts), module.POINTS
    gained, scale = after.momentum - before.momentum, np.array([1.0] * 3 + [1 / before.length] * 3)
    begins = FIRST_SLIP if friction else 1e-150
    small = 1e-6 * np.abs(before.momentum * scale).max(-1) + begins * before.mass
    arrives, leaves = before.velocities, after.velocities
    slips = leaves + restitution * arrives
    most = (1.0 + 1e-9) * before.energy + before.mass * begins**2
    for i in np.flatnonzero(after.energy > most):
        yield f"the energy grows {after.energy[i] / before.energy[i]:.9g} times at {t[i]:.6g} s"
    was, follows = (states_of([module.MODES[i] for i in kinds[:, k]], feet) for k in (1, 2))
    lands = np.arange(len(feet)) == kinds[:, 3:]
    beside = (before.heights < 1e-9 * before.length) & (arrives[..., 2] < 0.0) & ~lands
    some = np.flatnonzero((beside & (follows == OPEN)).any(-1))  # which may land, too
    events = Events(run.structure, EventColumns(*(column[some] for column in run.impacts.columns)))
    lands[some] |= states_of([event.contact for event in events], feet) != OPEN
    closed = lands | (follows != OPEN)
    touches = closed | (was != OPEN)
    for i, touching in enumerate(touches):
        left = _left_by_friction(before, i, slips[i], np.flatnonzero(touching), gained[i], friction)
        if left > small[i]:
            yield f"impulses at {t[i]:.6g} s lack {left / before.mass:.1e} m/s"
    falls, fastest = arrives[..., 2], np.linalg.norm(arrives, axis=-1).max(-1, keepdims=True)
    digits = 1e-9 * np.abs(falls).max(-1, keepdims=True) + 5e-11 * fastest
    least = -restitution * np.minimum(falls, 0.0)
    low, high = leaves[..., 2] < least - digits - begins, leaves[..., 2] > least + digits + begins
    alone = touches & (touches.sum(-1, keepdims=True) == 1) & (falls < 0.0)
    for i, foot in np.argwhere(alone & high):
        rises, fell = leaves[i, foot, 2], falls[i, foot]
        yield f"{feet[foot]} alone leaves at {rises:.3g} m/s after {fell:.3g} at {t[i]:.6g} s"
    for i, foot in np.argwhere(closed & low):
        others = np.flatnonzero(touches[i] & (np.arange(len(feet)) != foot))
        left = _left_by_friction(before, i, slips[i], others, gained[i], friction)
        if left > small[i] or follows[i, foot] != OPEN:  # or it lands a moment later
            rises, fell = leaves[i, foot, 2], falls[i, foot]
            yield f"{feet[foot]} leaves at {rises:.3g} m/s after {fell:.3g} at {t[i]:.6g} s"


def _sides(run: rk.Response, events: Events) -> list[Body]:
    """The bodies before and after events."""
    sides = np.moveaxis(events.columns.states, -1, 0)
    return [Body(run.structure, dict(zip(run.states, sides[..., k], strict=True))) for k in (0, 1)]


def _wrong_rests(run: rk.Response, friction: float | None) -> Iterator[str]:
    """Events without end: impulses in the cones of feet near the ground, and no energy."""
    rests = Events(run.structure, run.events.columns.of(REST))
    if not len(rests):
        return
    before, after = _sides(run, rests)
    start, length = run.steps.span.T
    step = np.searchsorted(start + length, rests.times)  # it lasts as long as the events
    begins = run.steps.states(step, np.zeros(len(step)))
    whole = (rests.columns.states[:, 0] == begins).all(-1)
    lasts = np.where(whole, length[step], 0.0)
    force = -before.mass * (
        shaking_of(run, rests.times - lasts / 2) + before.gravity * np.eye(3)[2]
    )
    gained, scale = after.momentum - before.momentum, np.array([1.0] * 3 + [1 / before.length] * 3)
    gained[:, :3] -= force * lasts[:, None]
    work = (force * (after.place - before.place)).sum(-1)
    size = np.abs(before.momentum * scale).max(-1)
    near, slow = before.heights < 1e-5 * before.length, LAST_SLIP if friction else HOP
    for i, t in enumerate(rests.times):
        slips = np.zeros_like(before.velocities[i])  # of any direction on the way
        left = _left_by_friction(before, i, slips, np.flatnonzero(near[i]), gained[i], friction)
        if left > max(1e-6 * size[i], before.mass * slow):
            yield f"impulses of the rest at {t:.6g} s lack {left / before.mass:.1e} m/s"
        if after.energy[i] > before.energy[i] * (1.0 + 1e-6) + work[i] + before.mass * slow**2:
            yield f"the energy grows over the rest at {t:.6g} s"


def _left_by_friction(
    body: Body, i: int, slips: np.ndarray, feet: np.ndarray, gained: np.ndarray,
    friction: float | None,
) -> float:  # fmt: skip
    """What of a change of momentum, or of forces, presses of feet and their friction cannot give.

    A foot that slips, by Moreau's law in an impact, has all of its friction against its slip; one
    that sticks has any in the cone, by eight edges in it or by 64 around it; where feet never slip,
    any. i : of the body. slips (m, 3), feet : those that touch.
    """
    scale, left = np.array([1.0] * 3 + [1 / body.length] * 3), np.inf
    speeds = np.linalg.norm(slips[:, :2], axis=-1)
    still = speeds <= STILL * (1.0 + np.linalg.norm(slips, axis=-1).max())
    if not len(feet):
        return float(np.abs(gained * scale).max())
    for edges, size in ((8, 1.0), (64, 1.0 / np.cos(np.pi / 64))):
        columns = []
        for foot in feet:
            of_foot, slip = wrench(body.arms[i, foot]), slips[foot, :2]
            if not friction:
                columns.append(of_foot[:, 2:])
                columns += [] if friction == 0 else [of_foot[:, :2], -of_foot[:, :2]]
            elif not still[foot]:
                columns.append(of_foot @ np.array([[*(-friction * slip / speeds[foot]), 1.0]]).T)
            else:
                turns = np.linspace(0, 2 * np.pi, edges, endpoint=False)
                around = size * friction * np.array([np.cos(turns), np.sin(turns)])
                columns.append(of_foot @ np.vstack([around, np.ones(edges)]))
        left = float(nnls(np.hstack(columns) * scale[:, None], gained * scale)[1])
        if left < 1e-9 * np.abs(gained * scale).max() or not (friction and still[feet].any()):
            break
    return left
