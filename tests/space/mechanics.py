"""Newton's and Euler's laws for a body on feet, by which motions in space are checked.

Nothing of the derivation enters: forces at the feet are taken from the response, the angular
velocity from yaw, pitch and roll, and the rest is mechanics of one rigid body.
"""

from collections.abc import Iterator

import numpy as np
from scipy.optimize import nnls

import rockeom as rk
from tests.space.bodies import spin, spin_rate

CLOSE = 1e-7
"""Relative to the weight, its moment or the momentum: what rounding and event times leave."""
STILL = 1e-7
"""[m/s], and relative to the fastest foot: a foot that sticks moves by less."""
SLOW = 1e-7
"""[m/s] of slips that turn more slowly than they should: a force across them is left out."""


class Body:
    """The body of a `Prism` or `LeggedStatue` in a state: place, axes and spin."""

    def __init__(self, structure: rk.Prism | rk.LeggedStatue, state: dict[str, float]) -> None:
        values = structure.parameters()
        self.mass, self.gravity = values["mass"], values["gravity"]
        tensor = np.diag([values[f"inertia_{axes}"] for axes in ("xx", "yy", "zz")])
        for axes, i, j in (("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)):
            tensor[i, j] = tensor[j, i] = values.get(f"inertia_{axes}", 0.0)
        places = structure.positions(state, mode="flight")
        self.arms = {name: places[name] - places["body"] for name in structure.module.POINTS}
        axes = structure.rotations(state, mode="flight")["body"]
        self.tensor, self.spin = axes @ tensor @ axes.T, spin(state)
        self.velocity = np.array([state[f"{axis}_dot"] for axis in "xyz"])
        self.length = max(np.linalg.norm(arm) for arm in self.arms.values())

    @property
    def momentum(self) -> np.ndarray:
        """(6,) linear, and angular about the centroid."""
        return np.concatenate([self.mass * self.velocity, self.tensor @ self.spin])

    @property
    def energy(self) -> float:
        """Kinetic energy."""
        return float(self.momentum @ np.concatenate([self.velocity, self.spin])) / 2

    def wrench(self, foot: str) -> np.ndarray:
        """(6, 3) force and moment of unit forces at a foot."""
        x, y, z = self.arms[foot]
        return np.vstack([np.eye(3), [[0, -z, y], [z, 0, -x], [-y, x, 0]]])

    def velocity_of(self, foot: str) -> np.ndarray:
        return self.velocity + np.cross(self.spin, self.arms[foot])


def violations(run: rk.Response, friction: float | None, restitution: float = 0.0) -> Iterator[str]:
    """A line for each law that a motion violates; friction : None where feet never slip."""
    structure, feet = run.structure, run.structure.module.POINTS
    weight = structure.parameters()["mass"] * structure.parameters()["gravity"]
    if (error := run.energy_balance().error) > CLOSE:
        yield f"energy is off by {error:.1e}"
    for foot in feet:
        lowest = run.extremes(f"{foot}_uplift").minimum
        if lowest < -CLOSE * Body(structure, run.final).length:
            yield f"{foot} is {lowest:.1e} m below the ground"
        extreme = run.extremes(f"{foot}_reaction")
        # a step over events without end is a straight line, whose forces say nothing
        rests = [event.time for event in run.events if event.kind == "rest"]
        over = any(0.0 <= t - extreme.minimum_time < 1e-5 for t in rests)
        if extreme.minimum < -CLOSE * weight and not over:
            yield f"{foot} pulls by {-extreme.minimum:.1e} N"
    yield from _unbalanced(run, weight, friction)
    for impact in run.impacts:
        yield from _wrong_impact(run, impact, friction, restitution)


def _unbalanced(run: rk.Response, weight: float, friction: float | None) -> Iterator[str]:
    """Steps at whose start forces and accelerations are not those of Newton and Euler."""
    structure = run.structure
    rows = np.linspace(0, len(run.t) - 2, 40).astype(int)
    for row in np.unique(rows):
        t, mode = float(run.t[row]), str(run.mode[row])
        state = dict(zip(run.states, run.y[row].tolist(), strict=True))
        pushed = shaking_of(run, t)
        ways = ("", "transverse_", "vertical_")
        shaking = {f"{w}ground_acceleration": a for w, a in zip(ways, pushed, strict=True)}
        moves = structure.accelerations(state, mode=mode, **shaking)
        forces = structure.reactions(state, mode=mode, **shaking)
        body, total = Body(structure, state), np.zeros(6)
        for foot in body.arms:
            along = [forces[f"{foot}_friction_{axis}"] for axis in "xy"]
            total += body.wrench(foot) @ [*along, forces[f"{foot}_reaction"]]
            if (friction == 0 or foot not in mode) and np.any(along):
                yield f"friction at {foot} at {t:.6g} s"
        acceleration = np.array([moves[axis] for axis in "xyz"]) + pushed
        acceleration[2] += body.gravity
        gyroscopic = np.cross(body.spin, body.tensor @ body.spin)
        turning = body.tensor @ spin_rate(state, moves) + gyroscopic
        lacking = total - np.concatenate([body.mass * acceleration, turning])
        size = weight * np.array([1.0] * 3 + [body.length] * 3)
        lacking -= _across_slow_slips(body, mode, lacking)
        if (np.abs(lacking) > CLOSE * size).any():
            yield f"forces at {t:.6g} s in {mode} lack {lacking}"
        if friction:
            bearing = [foot for foot in body.arms if forces[f"{foot}_reaction"] > 0.0]
            slips = {foot: body.velocity_of(foot) for foot in body.arms}
            left = _left_by_friction(body, slips, bearing, total, friction)
            if left > CLOSE * max(weight, np.abs(total).max()):  # which may grow without bound
                yield f"friction at {t:.6g} s in {mode} lacks {left:.1e} N"


def shaking_of(run: rk.Response, t: float) -> list[float]:
    """Accelerations of the ground along the axes of a structure that is turned."""
    x, y, up = (float(motion.acceleration(t)) for motion in motions_of(run))
    cos, sin = np.cos(run.azimuth), np.sin(run.azimuth)
    return [cos * x + sin * y, cos * y - sin * x, up]


def motions_of(run: rk.Response) -> tuple[rk.GroundMotion, ...]:
    none = rk.GroundMotion.none(run.duration)
    return run.motion, run.transverse or none, run.vertical or none


def _across_slow_slips(body: Body, mode: str, lacking: np.ndarray) -> np.ndarray:
    """What of forces that lack (6,) is across slips that are slow, and in directions that are held.

    The acceleration across such a slip is less than its forces would give it.
    """
    columns, slow = [], False
    for foot in body.arms:
        wrench, velocity = body.wrench(foot), body.velocity_of(foot)
        speed = np.linalg.norm(velocity)
        if foot not in mode or f"{foot}_idle" in mode:
            continue
        columns.append(wrench[:, 2])
        if f"{foot}_slides" in mode and speed < SLOW:
            columns.append(wrench @ [-velocity[1], velocity[0], 0.0] / speed)
            slow = True
        elif f"{foot}_slides" not in mode and f"{foot}_released" not in mode:
            columns += [wrench[:, 0], wrench[:, 1]]
    if not slow:
        return np.zeros(6)
    matrix = np.array(columns).T
    return matrix @ np.linalg.lstsq(matrix, lacking, rcond=1e-9)[0]


def _wrong_impact(
    run: rk.Response, impact, friction: float | None, restitution: float
) -> Iterator[str]:
    """Impulses of feet give the change of momentum and no energy, and gaps open as e has it."""
    before, after = (Body(run.structure, s) for s in (impact.before, impact.after))
    named = f"{impact.contact}+{impact.mode_before}+{impact.mode_after}"
    touching = [foot for foot in before.arms if foot in named]
    gained = after.momentum - before.momentum
    scale = np.array([1.0] * 3 + [1 / before.length] * 3)
    size = np.abs(before.momentum * scale).max() + 1e-300
    leaves, arrives = ({foot: b.velocity_of(foot) for foot in b.arms} for b in (after, before))
    slips = {foot: leaves[foot] + restitution * arrives[foot] for foot in leaves}
    left = _left_by_friction(before, slips, touching, gained, friction)
    if after.energy > (1.0 + 1e-9) * before.energy:
        yield f"the energy grows {after.energy / before.energy:.9g} times at {impact.time:.6g} s"
    if left > 1e-6 * size:
        yield f"impulses at {impact.time:.6g} s lack {left / size:.1e} of the momentum"
    fastest = max(abs(velocity[2]) for velocity in arrives.values())
    met = [foot for foot in touching if foot in f"{impact.contact}+{impact.mode_after}"]
    for foot in met:
        falls, rises = arrives[foot][2], leaves[foot][2]
        if rises < -restitution * min(falls, 0.0) - 1e-9 * fastest - 1e-12:
            yield f"{foot} leaves at {rises:.3g} m/s after {falls:.3g} at {impact.time:.6g} s"


def _left_by_friction(
    body: Body, slips: dict[str, np.ndarray], feet: list[str], gained: np.ndarray,
    friction: float | None,
) -> float:  # fmt: skip
    """What of a change of momentum, or of forces, presses of feet and their friction cannot give.

    A foot that slips, by Moreau's law in an impact, has all of its friction against its slip; one
    that sticks has any in the cone, by 64 of its edges; where feet never slip, any.
    """
    columns, scale = [], np.array([1.0] * 3 + [1 / body.length] * 3)
    fastest = max(np.linalg.norm(slip) for slip in slips.values())
    for foot in feet:
        wrench, slip = body.wrench(foot), slips[foot][:2]
        speed = np.linalg.norm(slip)
        if not friction:
            columns.append(wrench[:, 2:])
            columns += [] if friction == 0 else [wrench[:, :2], -wrench[:, :2]]
        elif speed > STILL * (1.0 + fastest):
            columns.append(wrench @ np.array([[*(-friction * slip / speed), 1.0]]).T)
        else:
            turns = np.linspace(0, 2 * np.pi, 64, endpoint=False)
            edge = friction / np.cos(np.pi / 64)
            cone = np.vstack([edge * np.cos(turns), edge * np.sin(turns), np.ones(64)])
            columns.append(wrench @ cone)
    if not columns:
        return float(np.abs(gained * scale).max())
    return float(nnls(np.hstack(columns) * scale[:, None], gained * scale)[1])
