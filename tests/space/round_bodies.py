"""Newton's and Euler's laws for round bodies: on a free rim, and as columns that wobble."""

from collections.abc import Iterator

import numpy as np

import rockeom as rk
from tests.space.bodies import spin, spin_rate
from tests.space.mechanics import moments

GROUND = tuple(f"{way}ground_acceleration" for way in ("", "transverse_", "vertical_"))
CLOSED = 1e-8
"""[m] of a closed gap, which drifts in proportion to the tolerance of the integration."""
FORCE = ("rim_friction_x", "rim_friction_y", "rim_reaction")


def axis_of(state) -> np.ndarray:
    """The axis of the body, with all digits of a small tilt."""
    along, across = np.sin(state["pitch"]) * np.cos(state["roll"]), -np.sin(state["roll"])
    c, s = np.cos(state["yaw"]), np.sin(state["yaw"])
    up = np.cos(state["pitch"]) * np.cos(state["roll"])
    return np.array([c * along - s * across, s * along + c * across, up])


def vector(values, of: str = "") -> np.ndarray:
    return np.array([values[f"{axis}{of}"] for axis in "xyz"])


def inertia(body: rk.RollingCylinder, state) -> np.ndarray:
    """The tensor about the centroid, along the axes of the ground."""
    values, axis = body.parameters(), axis_of(state)
    across, along = values["inertia_across"], values["inertia_along"]
    return across * np.eye(3) + (along - across) * np.outer(axis, axis)


def arm_of(body: rk.RollingCylinder, state) -> np.ndarray:
    """From the centroid to the lowest point of the rim, by the axis alone."""
    axis = axis_of(state)
    down = axis[2] * axis - np.array([0.0, 0.0, 1.0])
    return body.radius * down / np.linalg.norm(down) - body.parameters()["centroid_height"] * axis


def velocity_of_rim(body: rk.RollingCylinder, state) -> np.ndarray:
    """That of the material at the lowest point."""
    return vector(state, "_dot") + np.cross(spin(state), arm_of(body, state))


def violations_on_a_rim(run: rk.Response) -> Iterator[str]:
    """A line for each law that a motion on a rim violates, at forty of its steps and in impacts."""
    if (error := run.energy_balance().error) > 1e-7:
        yield f"energy is off by {error:.1e}"
    if (lowest := run.extremes("rim_uplift").minimum) < -CLOSED:
        yield f"the rim is {lowest:.1e} m below the ground"
    yield from _unbalanced(run)
    for impact in run.impacts:
        yield from _wrong_impact(run.structure, impact)


def _unbalanced(run: rk.Response) -> Iterator[str]:
    """Times at which the motion is not by the laws of Newton and Euler."""
    body, rolls = run.structure, run.structure.friction is None
    weight, gaps = body.mass * body.gravity, run.at((now := moments(run)).t, names=["rim_uplift"])
    for i, (t, mode) in enumerate(zip(now.t, now.modes, strict=True)):
        state, moves = ({n: x[i] for n, x in of.items()} for of in (now.state, now.moves))
        force, omega, up = now.forces[i, 0], spin(state), gaps["rim_uplift"][i]
        lacking = force - body.mass * (vector(moves) + now.pushed[i]) - [0.0, 0.0, weight]
        tensor = inertia(body, state)
        turning = tensor @ spin_rate(state, moves) + np.cross(omega, tensor @ omega)
        torque = np.cross(arm_of(body, state), force) - turning
        largest = max(weight, np.abs(force).max())  # of a disk all but flat, a million weights
        if max(np.abs(lacking).max(), np.abs(torque).max()) > 1e-9 * largest:
            yield f"forces at {t:.4g} s in {mode} lack {lacking}, {torque}"
        slip, sticks = velocity_of_rim(body, state), rolls and mode == "rim"
        held = {"flight": slip[:0], "rim": slip if rolls else slip[2:]}.get(mode, slip[2:])
        if np.abs(held).max(initial=0.0) > 1e-7 or (not sticks and np.any(force[:2])):
            yield f"at {t:.4g} s in {mode} it slips at {slip} m/s, under {force}"
        if mode != "flight" and abs(up) > CLOSED:
            yield f"at {t:.4g} s in {mode} the rim is {up} m above the ground"


def _wrong_impact(body: rk.RollingCylinder, impact) -> Iterator[str]:
    """Each is without a rebound, and without a slip or without friction; or it just grazes."""
    before, after, momentum = impact.before, impact.after, body.mass * body.radius
    impulse = body.mass * (vector(after, "_dot") - vector(before, "_dot"))
    gained = inertia(body, after) @ spin(after) - inertia(body, before) @ spin(before)
    *slip, up = velocity_of_rim(body, after)
    up = min(up, 0.0) if not np.any(impulse) else up
    rolls = body.friction is None  # or is released, in the impact or by the forces after it
    none = min(impulse[:2] / body.mass, slip, key=np.linalg.norm) if rolls else impulse[:2]
    lacks = np.abs(np.cross(arm_of(body, after), impulse) - gained).max() / momentum
    if max(lacks, abs(up), np.abs(none).max()) > 1e-8 or impulse[2] < -1e-9 * momentum:
        yield f"impact at {impact.time:.6g} s: lacks {lacks}, rebounds at {up}, {none}, {impulse}"


def violations_wobbling(run: rk.Response) -> Iterator[str]:
    """The same of a column that wobbles: energy, rolling without twist, impacts in a plane."""
    of, values = run.structure, run.structure.parameters()
    if (error := run.energy_balance().error) > 1e-9:
        yield f"energy is off by {error:.1e}"
    for t in np.linspace(0.1, 0.9, 5) * run.t[-1]:
        state = run.at(t)
        places, axes = of.positions(state), of.rotations(state)["column"]
        touches, axis = places["contact"], axes[:, 2]
        base = places["column"] - values["centroid_height"] * axis
        # the same arc of the rim and of the circle on the ground has been rolled over
        twist = np.abs(axes.T @ (touches - base) - touches).max()
        off = abs(touches @ axis - of.radius * np.hypot(*axis[:2]))
        if twist > 1e-9 or off > 1e-12:
            yield f"at {t:.4g} s the rim has slipped by {twist}, {off} m"
    columns, slab = values.get("columns", 1), 4 * values.get("slab_mass", 0.0)
    up, across = values["centroid_height"] ** 2, of.radius**2
    mass, inert = columns * of.mass + slab, columns * values["inertia_xx"]
    ratio = max(inert + mass * (up - across), 0.0) / (inert + mass * (up + across))
    for impact in run.impacts:  # after that of a squat one it stays flat
        after = ratio * impact.before["tilt_dot"]
        if abs(impact.after["tilt_dot"] - after) > 1e-12 * abs(after):
            yield f"impact at {impact.time:.6g} s: {impact.after['tilt_dot']} in place of {after}"
