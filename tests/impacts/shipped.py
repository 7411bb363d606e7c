"""Landings of the block on level feet by the compiled package, and by the references."""

import math
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np

import rockeom as rk
from tests.impacts.energy import LAWS, cannot_gain
from tests.impacts.mechanics import Impact, block

LAWS_OF_PACKAGE = {
    "newton": "newton", "moreau": "moreau", "poisson": "poisson, path", "lzb": "springs",
    "pairwise": "pairwise",
}  # fmt: skip
"""The reference of each law."""


@cache
def model(law: str):
    return rk.derive("sliding_block", law=law)


class Landing(NamedTuple):
    """An impact as the package met it, and its velocities after it: x, y of the mass centre and the
    angular velocity."""

    before: Impact
    after: np.ndarray


def land(
    law: str, b: float, h: float, rates: tuple[float, float], friction: float, restitution: float
) -> Landing | None:
    """The first impact of a block that leans by 1e-4 on a corner, which is closed.

    rates : of the slip of that corner, and of the rotation: a negative one is about the right
    corner and lands on the left one, a positive one is the mirror image. None
    where there is no state after the impact.
    """
    slip, turning = rates
    theta = math.copysign(1e-4, -turning)
    pivot = math.copysign(b, -turning)
    inertia = (b * b + h * h) / 3
    structure = rk.structure(
        model(law), half_width=b, height=h, mass=1.0, inertia=inertia, friction=friction,
        restitution=restitution,
    )  # fmt: skip
    start = {
        "theta": theta, "theta_dot": turning, "x_dot": slip + pivot * math.sin(theta) * turning,
        "y": pivot * math.sin(theta), "y_dot": pivot * math.cos(theta) * turning,
    }  # fmt: skip
    run = rk.simulate(structure, rk.GroundMotion.none(3e-4 / abs(turning)), initial=start)
    if len(run.impacts) == 0:
        return None
    (event, *_) = run.impacts
    before, after = (
        np.array([s["x_dot"] + h * s["theta_dot"], s["y_dot"], s["theta_dot"]])
        for s in (event.before, event.after)
    )
    return Landing(block(b, h, before, friction=friction, restitution=restitution), after)


def random_landings(law: str, seed: int, count: int) -> Iterator[Landing | None]:
    rng = np.random.default_rng(seed)
    for i in range(count):
        b, h = rng.uniform(0.1, 1.0, 2)
        slip = rng.normal() if i % 2 else 0.0
        friction = rng.uniform(0.0, 1.2) if i % 3 else 0.0
        restitution = rng.uniform(0.05, 1.0) if i % 8 else float(rng.integers(2))
        turning = -rng.uniform(0.1, 0.7) * math.sqrt(9.81 / h)  # slow enough not to lift off
        yield land(law, b, h, (slip, turning), friction, restitution)


def difference(law: str, landing: Landing) -> float:
    """Of the velocities after it, from the nearest of the reference, over the largest before."""
    found = LAWS[LAWS_OF_PACKAGE[law]](landing.before)
    scale = np.abs(landing.before.rates).max()
    return min(float(np.abs(v - landing.after).max() / scale) for v in found)


def package_study(law: str, seed: int, count: int) -> Iterator[str]:
    """Lines of a table: inside and outside of the range without a gain."""
    changes: dict[bool, list[float]] = {True: [], False: []}
    apart, ended = {True: 0.0, False: 0.0}, 0
    for landing in random_landings(law, seed, count):
        if landing is None:
            ended += 1
            continue
        inside = cannot_gain(landing.before, LAWS_OF_PACKAGE[law])
        changes[inside].append(landing.before.gain(landing.after))
        apart[inside] = max(apart[inside], difference(law, landing))
    for inside, name in ((True, "inside"), (False, "outside")):
        found = changes[inside]
        if found:
            yield (
                f"{law:12s}{name:>9s}{len(found):9d}{sum(g > 1e-12 for g in found):7d}"
                f"{max(found):12.3e}{apart[inside]:12.1e}"
            )
    if ended:
        yield f"{law:12s}{ended} landings ended without a state after"
