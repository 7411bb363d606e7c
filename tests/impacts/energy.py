"""Energy of the laws of impact: random landings, the ranges without a gain, and gains outside.

The work of impulses p = (P, Q) that act together is p (w- + w+) / 2, w = (u, s) (Kelvin). With
xi = w+ + e w- of each direction, e_t = 0 for Newton's friction, and D = diag((1 - e)/(1 + e)),

    p (w- + w+) / 2 = sum p xi / (1 + e) - p (D G + G D) p / 4,    p xi <= 0,

so that Newton's and Moreau's laws cannot gain where D G + G D has no negative eigenvalue. Without
friction they never do, by sum P (1 - e) u- / 2. Poisson's expansion without friction is the least
kinetic energy for P_r >= e P_c, and P_r = P_c would give that before the impact: no gain for any e.
With friction by its two problems it cannot gain where G - E G E has no negative eigenvalue.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tests.impacts.mechanics import Impact, corner, impact, landing
from tests.impacts.pairwise import pairwise
from tests.impacts.poisson_path import NoPieceError, poisson_path
from tests.impacts.simultaneous import moreau, newton, poisson
from tests.impacts.springs import springs


def pairs_by_stiffness(problem: Impact) -> np.ndarray:
    """Velocities after single impacts, that of the stiffest closing contact first."""
    return pairwise(problem, list(np.argsort(-problem.stiffness, kind="stable")))[0]


LAWS = {
    "newton": lambda problem: [problem.after(p) for p in newton(problem)],
    "moreau": lambda problem: [problem.after(p) for p in moreau(problem)],
    "poisson, two problems": lambda problem: [problem.after(p) for p in poisson(problem)],
    "poisson, path": lambda problem: [problem.after(poisson_path(problem))],
    "springs": lambda problem: [problem.after(springs(problem).impulses)],
    "springs, gaps followed": lambda problem: [
        problem.after(springs(problem, "followed").impulses)
    ],
    "pairwise": lambda problem: [pairs_by_stiffness(problem)],
}  # fmt: skip
"""Velocities after an impact by the references, all of them where several fit."""


def cannot_gain(problem: Impact, law: str) -> bool:
    """Whether the law, in the range of this impact, is stated not to gain."""
    G, e, m = problem.delassus, problem.restitution, len(problem.normal)
    if not problem.friction.any() or law.startswith(("springs", "pairwise")):
        return True
    of_slips = np.array([
        e[[i for i in range(m) if problem.slips_with[i] == j]].max() for j in range(len(G) - m)
    ])  # fmt: skip
    if law == "newton":
        of_slips = 0 * of_slips
    both = np.concatenate([e, of_slips])
    if law == "poisson, path":
        return m == 1
    if law.startswith("poisson"):
        return no_negative(G - np.outer(both, both) * G)
    D = (1 - both) / (1 + both)
    return no_negative(D[:, None] * G + G * D)


def no_negative(matrix: np.ndarray) -> bool:
    return bool(np.linalg.eigvalsh(matrix).min() >= -1e-12 * np.abs(matrix).max())


# --- random landings


def landings(seed: int, count: int) -> Iterator[Impact]:
    """Rectangles that land on a second corner, the first closed and sliding or not, and, each
    fourth, on a single corner; stiffnesses of the two corners up to some tens apart."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        b, h = rng.uniform(0.1, 1.0, 2)
        numbers = {
            "restitution": rng.uniform(0.05, 1.0) if i % 8 else float(rng.integers(2)),
            "friction": rng.uniform(0.0, 1.2) if i % 3 else 0.0,
        }
        if i % 4 == 3:
            found = corner(b, h, rng.uniform(-1.5, 1.5), rng.normal(size=3), **numbers)
            if found.rates[0] > 0:
                found = found.with_velocity(-found.velocity)
        else:
            found = landing(b, h, -rng.uniform(0.5, 5.0), **numbers)
            found = found.with_(stiffness=np.exp(rng.normal(size=2)))
            if i % 2:
                found = found.with_velocity(found.velocity + np.array([rng.normal(), 0.0, 0.0]))
        yield found


class Count(NamedTuple):
    """Impacts within a law's range, those without a solution, gains, and the largest change of
    energy over that before."""

    impacts: int
    undecided: int
    gains: int
    largest: float


def count_gains(law: str, seed: int, count: int) -> tuple[Count, Count]:
    """Inside the range in which the law is stated not to gain, and outside."""
    changes: dict[bool, list[float]] = {True: [], False: []}
    undecided = {True: 0, False: 0}
    for problem in landings(seed, count):
        inside = cannot_gain(problem, law)
        try:
            after = LAWS[law](problem)
        except NoPieceError:
            after = []
        undecided[inside] += not after
        changes[inside] += [problem.gain(v) for v in after]
    inside_, outside = (
        Count(len(x), undecided[k], sum(g > 1e-12 for g in x), max(x, default=math.nan))
        for k, x in changes.items()
    )
    return inside_, outside


# --- examples of a gain


def double_pendulum(restitution: float = 0.5, friction: float = 0.5) -> Impact:
    """Kane's: two uniform rods of 1 m and 1 kg, 20 and 30 degrees from the vertical, turning at
    -0.1 and -0.2 rad/s, whose tip meets the ground."""
    a, b = math.radians(20), math.radians(30)
    c = math.cos(a - b)
    return impact(
        [[4 / 3, c / 2], [c / 2, 1 / 3]], [-0.1, -0.2], [[math.sin(a), math.sin(b)]],
        [[math.cos(a), math.cos(b)]], friction=friction, restitution=restitution,
    )  # fmt: skip


def body_on_floor_and_wall(restitution: tuple[float, float] = (1.0, 0.0)) -> Impact:
    """A body of 1 kg and .32 kg m2 with one point on a steep wall and one on a floor, friction 1.2.

    Directions 66 and -5 degrees from the vertical, points (-.81, -.85) and (-.96, -.43) m from its
    mass centre, which moves with (-1.7, -.7) m/s and turns clockwise at .5 rad/s.
    """
    normal, slip = [], []
    for x, y, degrees in ((-0.81, -0.85, 66), (-0.96, -0.43, -5)):
        s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
        normal.append([s, c, -s * y + c * x])
        slip.append([c, -s, -c * y - s * x])
    return impact(
        np.diag([1.0, 1.0, 0.32]), [-1.7, -0.7, -0.5], normal, slip, friction=1.2,
        restitution=restitution,
    )  # fmt: skip


def block_on_unequal_feet(restitution: tuple[float, float] = (1.0, 0.0)) -> Impact:
    """A block of half-width .95 m and half-height .35 m, one foot lower by .8 m, friction 1."""
    b, h, d = 0.95, 0.35, 0.8
    return impact(
        np.diag([1.0, 1.0, (b * b + h * h) / 3]), [-0.5, -1.7, -1.1], [[0, 1, b], [0, 1, -b]],
        [[1, 0, -h], [1, 0, -h - d]], friction=1.0, restitution=restitution,
    )  # fmt: skip
