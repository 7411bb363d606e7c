"""Random prisms and statues under three components, against the laws of Newton and Euler."""

import numpy as np
import pytest

import rockeom as rk
from tests.space.mechanics import violations


def drawn(seed: int, rubs: bool = False) -> tuple[rk.Response, float | None, float]:
    """A motion, the friction and the restitution of its feet.

    rubs : whether there is friction that may be overcome; else feet are smooth or never slip.
    """
    rng = np.random.default_rng(seed)
    smooth = bool(rng.random() < 0.5)
    restitution = 0.5 if smooth and rng.random() < 0.3 and not rubs else 0.0
    friction = 0.0 if smooth else None
    friction = rng.uniform(0.05, 0.8) if rubs else friction
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
    motions = [rk.GroundMotion.from_array(a * rng.normal(size=150), dt=0.02) for a in peaks]
    run = rk.simulate(
        body, motions[0], transverse=motions[1], vertical=motions[2], initial=start,
        azimuth=rng.uniform(-3, 3), options=rk.SolverOptions(max_steps=300_000),
    )  # fmt: skip
    return run, friction, restitution


@pytest.mark.parametrize("seed", range(16))
def test_a_random_body_moves_by_the_laws_of_mechanics(seed):
    run, *laws = drawn(seed)
    assert run.outcome.value in ("completed", "overturned", "came to rest")
    assert not list(violations(run, *laws))
