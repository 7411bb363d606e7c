"""Newton's, Moreau's and Poisson's law on all contacts at once: every pattern is tried.

Each law is one or two problems of the same kind. Impulses R >= 0 and Q, and final rates w + e w-,

    0 <= R  _|_  xi_n >= 0,    |Q| <= mu (P0 + R),  Q against xi_t,    xi = xi_0 + G (R, Q),

which a pattern (each contact loaded or not, each slip stopped or to one side) makes linear.
"""

import itertools
import math

import numpy as np

from tests.impacts.mechanics import Impact

SMALL = 1e-11


def complementary(
    problem: Impact, free: np.ndarray, floor: np.ndarray | None = None
) -> list[np.ndarray]:
    """All (R, Q) of the problem above with different xi; free : xi_0, floor : P0."""
    G, m, g = problem.delassus, len(problem.normal), len(problem.slip)
    floor = np.zeros(m) if floor is None else floor
    touching = [[i for i in range(m) if problem.slips_with[i] == j] for j in range(g)]
    found: list[np.ndarray] = []
    size = np.abs(free).max() + 1e-300
    for loaded in itertools.product((False, True), repeat=m):
        for senses in itertools.product((0, 1, -1), repeat=g):
            p = solve(problem, G, free, floor, loaded, senses, touching)
            if p is None:
                continue
            xi = free + G @ p
            if fits(problem, p, xi, floor, loaded, senses, touching, size) and not any(
                np.abs(G @ (p - q)).max() < 1e-9 * size for q in found
            ):
                found.append(p)
    return found


def solve(problem, G, free, floor, loaded, senses, touching) -> np.ndarray | None:
    """Impulses of a pattern; None where it has none or infinitely many."""
    m, r = len(problem.normal), len(free)
    coupling, fixed = np.eye(r), np.zeros(r)
    unknown = [i for i in range(m) if loaded[i]]
    for j, sense in enumerate(senses):
        if sense:
            for i in touching[j]:
                if math.isinf(problem.friction[i]):
                    return None
                coupling[m + j, i] = -sense * problem.friction[i]
                fixed[m + j] += -sense * problem.friction[i] * floor[i]
        elif any(loaded[i] or floor[i] > 0 for i in touching[j]):
            unknown.append(m + j)
    p = np.zeros(r)
    if unknown:
        effect = (G @ coupling)[np.ix_(unknown, unknown)]
        if np.linalg.cond(effect) > 1e12:
            return None
        p[unknown] = np.linalg.solve(effect, -(free + G @ fixed)[unknown])
    return coupling @ p + fixed


def fits(problem, p, xi, floor, loaded, senses, touching, size) -> bool:
    m, scale = len(problem.normal), np.abs(p).max() + np.abs(floor).max() + 1e-300
    for i in range(m):
        if p[i] < -SMALL * scale or xi[i] < -SMALL * size:
            return False
    for j, sense in enumerate(senses):
        if sense and sense * xi[m + j] < -SMALL * size:
            return False
        limit = sum(problem.friction[i] * (floor[i] + p[i]) for i in touching[j] if floor[i] + p[i])
        if not sense and abs(p[m + j]) > limit + SMALL * scale:
            return False
    return True


def newton(problem: Impact) -> list[np.ndarray]:
    """(P, Q): u+ >= -e u-, equal where it takes an impulse; friction against the last slip."""
    return complementary(problem, problem.rates + returned(problem, [0.0] * len(problem.slip)))


def moreau(problem: Impact) -> list[np.ndarray]:
    """(P, Q): as Newton's, with friction against s+ + e s-: one restitution for both directions.

    Contacts of one slip need one restitution for this form.
    """
    e_t = []
    for j in range(len(problem.slip)):
        of_slip = {problem.restitution[i] for i, k in enumerate(problem.slips_with) if k == j}
        assert len(of_slip) == 1 or not problem.friction.any(), "split the slip"
        e_t.append(max(of_slip))
    return complementary(problem, problem.rates + returned(problem, e_t))


def returned(problem: Impact, e_t: list[float]) -> np.ndarray:
    """e times the rates before; of a gap that opens none."""
    rates, m = problem.rates, len(problem.normal)
    return np.concatenate([problem.restitution * np.minimum(rates[:m], 0.0), e_t * rates[m:]])


def poisson(problem: Impact) -> list[np.ndarray]:
    """(P, Q): compression up to u = 0, then e times its impulses or more (Glocker and Pfeiffer)."""
    G, m, found = problem.delassus, len(problem.normal), []
    for first in complementary(problem, problem.rates):
        floor = problem.restitution * first[:m]
        base = np.concatenate([floor, np.zeros(len(problem.slip))])
        middle = problem.rates + G @ (first + base)
        found += [first + base + second for second in complementary(problem, middle, floor)]
    return found
