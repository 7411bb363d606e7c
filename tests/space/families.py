"""Random motions of bodies in space, by families: on feet, on a rim, columns that wobble.

A motion of a seed is the same whoever draws it, so that a violation is found again.
"""

from collections.abc import Sequence

import numpy as np

import rockeom as rk

MOST_STEPS = 300_000
"""Steps of a motion; those on feet with friction take 20 000 as a rule, and up to 80 000."""


def shaken(body, noise: Sequence[np.ndarray], start, **more) -> rk.Response:
    """A motion under samples of the three components, 0.02 s apart."""
    x, y, up = (rk.GroundMotion.from_array(samples, dt=0.02) for samples in noise)
    options = rk.SolverOptions(max_steps=MOST_STEPS)
    return rk.simulate(body, x, transverse=y, vertical=up, initial=start, options=options, **more)


def on_feet(
    seed: int, rubs: float = 0.0, bounces: bool = False
) -> tuple[rk.Response, float | None, float]:
    """A motion of a prism or a statue, the friction and the restitution of its feet.

    rubs : the most friction, where it may be overcome; else feet are smooth or never slip.
    bounces : whether the restitution is 0.5 in any case.
    """
    rng = np.random.default_rng(seed)
    smooth = bool(rng.random() < 0.5)
    restitution = 0.5 if (smooth and rng.random() < 0.3 and not rubs) or bounces else 0.0
    friction = 0.0 if smooth else None
    friction = rng.uniform(0.05, rubs) if rubs else friction
    height = rng.uniform(0.5, 2.0)
    laws = {"friction": friction, "restitution": restitution, "mass": rng.uniform(1.0, 1e3)}
    if rng.random() < 0.5:
        width, depth = rng.uniform(0.15, 0.8, 2) * height
        offsets = {"offset_x": 0.2 * width * rng.uniform(-1, 1), "offset_y": 0.0}
        body = rk.Prism(width=width, depth=depth, height=height, **offsets, **laws)
        size = min(width, depth) / height
    else:
        angles = np.sort(rng.uniform(0.0, 2.0, 3)) + np.array([0.0, 2.1, 4.2])
        radius = rng.uniform(0.15, 0.5) * height
        feet = {f"foot{i}": (radius * np.cos(a), radius * np.sin(a)) for i, a in enumerate(angles)}
        arms = rng.uniform(0.05, 0.5, (12, 3)) * height * rng.choice([-1, 1], (12, 3))
        tensor = sum(a @ a * np.eye(3) - np.outer(a, a) for a in arms) * laws["mass"] / 12
        middle = np.mean(list(feet.values()), axis=0)
        body = rk.LeggedStatue(feet=feet, centroid=(*middle, height / 2), inertia=tensor, **laws)
        size = radius / height
    start = {"yaw": rng.uniform(-3, 3)}
    if rng.random() < 0.7:
        start |= {"pitch": 0.3 * size * rng.normal(), "roll": 0.3 * size * rng.normal()}
        start |= {"yaw_dot": 0.2 * rng.normal(), "pitch_dot": 0.3 * size * rng.normal()}
        start = start if friction == 0 else {n: x for n, x in start.items() if "dot" not in n}
    peaks = 9.81 * size * np.array([1.5, 1.5, 1.0])
    noise = [a * rng.normal(size=150) for a in peaks]
    return shaken(body, noise, start, azimuth=rng.uniform(-3, 3)), friction, restitution


def on_a_rim(seed: int) -> rk.Response:
    """A motion of a cylinder that rolls on its rim, or slips freely, and may leave the ground."""
    rng = np.random.default_rng(seed)
    rolls, radius = bool(rng.random() < 0.5), rng.uniform(0.1, 0.4)
    body = rk.RollingCylinder(
        radius=radius, height=radius * rng.uniform(0.0, 8.0), mass=rng.uniform(1.0, 1e3),
        friction=None if rolls else 0,
    )  # fmt: skip
    lean = np.arctan2(radius, body.parameters()["centroid_height"])
    tilt = min(lean, 0.3) * rng.uniform(0.05, 0.6)
    direction, yaw = rng.uniform(-3, 3, 2)
    rates = {"precession": rng.normal(), "tilt_rate": 0.3 * rng.normal(), "spin": rng.normal()}
    start = body.on_rim(tilt, direction=direction, yaw=yaw, **rates)
    peaks = np.array([4.0, 4.0, rng.choice([3.0, 15.0])])
    return shaken(body, [a * rng.normal(size=100) for a in peaks], start)


def wobbling(seed: int) -> rk.Response:
    """A motion of a column or a podium, one in four in a plane, where rims strike."""
    rng = np.random.default_rng(seed)
    sizes = {"radius": rng.uniform(0.1, 0.6), "height": rng.uniform(0.5, 4.0)}
    if rng.random() < 0.7:
        body = rk.WobblingColumn(**sizes, top_radius=rng.uniform(0.0, 0.5), mass=100.0)
    else:
        body = rk.Podium(columns=3, slab_mass=rng.uniform(0.0, 1e3), **sizes, mass=100.0)
    plane, leans = bool(rng.random() < 0.25), bool(rng.random() < 0.6)
    peaks = 9.81 * np.tan(body.alpha) * np.array([1.5, 0.0 if plane else 1.5, 0.3])
    start = {"tilt": rng.uniform(0.05, 0.4) * body.alpha, "tilt_dot": 0.1 * rng.normal()}
    if not plane:
        start |= {"direction": rng.uniform(-3, 3), "direction_dot": rng.normal()}
    return shaken(body, [a * rng.normal(size=150) for a in peaks], start if leans else None)
