"""Motions from numbers by name, whose derivatives the tests compare; one of each kind of structure.

All are shaken by a sine from a rotation on. Every argument may be a `Dual`.
"""

import dataclasses
import math
from typing import Any, NamedTuple

import rockeom as rk
from tests.differences import Motion, run
from tests.typical import DAMPING, S1, STIFFNESS

GRAVITY = 9.81


def shaken(
    structure: Any, law: Any, amplitude: Any, period: Any, duration: Any, **initial: Any
) -> rk.Case:
    shaking = rk.GroundMotion.harmonic(amplitude, period=period, duration=100.0)
    return rk.Case(structure, shaking, impact=law, initial=initial, duration=duration)


def block(theta, theta_dot, e, amplitude, period, duration, **sizes):
    return shaken(
        rk.RigidBlock(**sizes), rk.VelocityRatio(e), amplitude, period, duration,
        theta=theta, theta_dot=theta_dot,
    )  # fmt: skip


def slender(theta, theta_dot, e, amplitude, period, duration, **sizes):
    return shaken(
        rk.SlenderBlock(**sizes), rk.VelocityRatio(e), amplitude, period, duration,
        theta=theta, theta_dot=theta_dot,
    )  # fmt: skip


def lumped(theta, theta_dot, r_left, r_right, amplitude, period, duration, **sizes):
    """Each foot loses energy by a ratio of its own."""
    return shaken(
        rk.LumpedMassStructure(**sizes), rk.EnergyRatio(left=r_left, right=r_right), amplitude,
        period, duration, theta=theta, theta_dot=theta_dot,
    )  # fmt: skip


def flexible(theta, u, amplitude, period, duration, **sizes):
    """By the impulsive law, whose map depends on the deformation."""
    return shaken(
        rk.FlexibleStructure(**sizes), rk.Impulsive(), amplitude, period, duration,
        theta=theta, u=u,
    )  # fmt: skip


def sliding(theta, theta_dot, amplitude, period, duration, **sizes):
    return shaken(
        rk.SlidingBlock(**sizes), None, amplitude, period, duration,
        theta=theta, theta_dot=theta_dot,
    )  # fmt: skip


def wall(theta, r, slope, amplitude, period, duration, **sizes):
    """What an impact leaves of the energy depends on its speed."""
    return shaken(
        rk.ControlledWall(**sizes), rk.EnergyRatioAtSpeed(((math.inf, r, slope),)), amplitude,
        period, duration, theta=theta,
    )  # fmt: skip


class Shaken(NamedTuple):
    """A motion and its typical numbers, but for the duration."""

    motion: Motion
    values: dict[str, float]

    def until(self, impacts: int, longest: float = 20.0, **changes: float) -> dict[str, float]:
        """The numbers, changed, with a duration that ends between an impact and what follows it.

        Raises LookupError where the motion has no such impact.
        """
        values = self.values | changes
        events = run(self.motion(**values, duration=longest), rk.SolverOptions()).events
        struck = [i for i, e in enumerate(events) if e.kind in ("impact", "landing")]
        if len(struck) < impacts or struck[impacts - 1] + 1 == len(events):
            raise LookupError(f"{len(struck)} impacts in {longest} s")
        last = struck[impacts - 1]
        return values | {"duration": 0.5 * (events[last].time + events[last + 1].time)}


_GROUND = {"gravity": GRAVITY, "amplitude": 0.6, "period": 0.8}
_BLOCK = {"half_width": 0.1, "half_height": 0.45, "mass": 300.0} | _GROUND
_THESIS_WALL = rk.ControlledWall.thesis()

MOTIONS = {
    "block": Shaken(block, _BLOCK | {"theta": 0.1, "theta_dot": 0.05, "e": 0.9}),
    "lumped": Shaken(
        lumped, S1 | _GROUND | {"theta": 0.1, "theta_dot": 0.05, "r_left": 0.8, "r_right": 0.75}
    ),
    "flexible": Shaken(
        flexible,
        S1 | _GROUND | {"stiffness": STIFFNESS / 20, "damping": DAMPING, "theta": 0.1, "u": 0.002},
    ),
    "sliding": Shaken(
        sliding,
        _BLOCK
        | {"half_height": 0.3, "friction": 0.25, "restitution": 0.0, "amplitude": 1.6}
        | {"theta": 0.1, "theta_dot": 0.05},
    ),
    "wall": Shaken(
        wall,
        {f.name: getattr(_THESIS_WALL, f.name) for f in dataclasses.fields(_THESIS_WALL)}
        | {"eccentricity": 0.01, "anchor_depth": 0.1, "gravity": GRAVITY, "transition": 0.02}
        | {"theta": 0.01, "r": 0.865, "slope": 0.0441, "amplitude": 0.5, "period": 0.9},
    ),
}

SLENDER = Shaken(
    slender,
    {"mass": 300.0, "radius": 0.46, "alpha": 0.22, "inertia": 20.0, "gravity": GRAVITY}
    | {"theta": 0.1, "theta_dot": 0.05, "e": 0.93, "amplitude": 0.6, "period": 0.8},
)
"""Whose motion is known in closed form."""
