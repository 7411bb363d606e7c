"""Contacts that take their impulses one after the other, each as if it were alone."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tests.impacts.mechanics import Impact
from tests.impacts.routh import routh


def alone(problem: Impact, i: int) -> Impact:
    """One contact of several, and its slip."""
    return replace(
        problem, normal=problem.normal[[i]], slip=problem.slip[[problem.slips_with[i]]],
        friction=problem.friction[[i]], restitution=problem.restitution[[i]],
        stiffness=problem.stiffness[[i]], slips_with=(0,),
    )  # fmt: skip


def pairwise(
    problem: Impact, order: Sequence[int], restitution: str = "energy", most: int = 100_000
) -> tuple[np.ndarray, int]:
    """Velocities after, and the number of single impacts.

    Again and again the first contact of the order that closes takes its whole impulse. What is
    left below 1e-14 of the first speed counts as zero: without restitution the impacts can be
    infinitely many.
    """
    v, least = problem.velocity.copy(), 1e-14 * np.abs(problem.rates).max()
    for count in range(most):
        closing = [i for i in order if problem.normal[i] @ v < -least]
        if not closing:
            return v, count
        single = alone(replace(problem, velocity=v), closing[0])
        v = single.after(routh(single, restitution))
    raise RuntimeError("endless")


def two_balls(m1: float, m2: float, v1: float, v2: float, e: float) -> tuple[float, float]:
    """Velocities after an impact of two balls."""
    common = (m1 * v1 + m2 * v2) / (m1 + m2)
    return common - e * m2 * (v1 - v2) / (m1 + m2), common + e * m1 * (v1 - v2) / (m1 + m2)


def three_balls(masses: Sequence[float], v: float, e: Sequence[float]) -> list[float]:
    """The first ball meets two at rest, pair by pair: the limit of a soft last contact."""
    m, now = masses, [v, 0.0, 0.0]
    while True:
        for i in (0, 1):
            if now[i] - now[i + 1] > 1e-14 * abs(v):
                now[i : i + 2] = two_balls(m[i], m[i + 1], now[i], now[i + 1], e[i])
                break
        else:
            return now
