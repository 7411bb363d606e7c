"""Poisson's law with Coulomb's friction at every moment of the impact, on several contacts.

In compression the rates of all gaps that close go to zero together, u >= (1 - a) min(u-, 0), while
a goes from 0 to 1; in expansion each contact receives e times its impulse of compression at a
uniform rate, and more where its gap would close. In between rates are straight lines, and a piece
ends where a slip stops or a contact is reached. For one contact this is Routh's path.
"""

import itertools
import math

import numpy as np

from tests.impacts.mechanics import Impact

SMALL = 1e-11


class NoPieceError(Exception):
    """No piece goes on."""


def poisson_path(problem: Impact) -> np.ndarray:
    """(P, Q)."""
    m = len(problem.normal)
    closing = np.minimum(problem.rates[:m], 0.0)
    size = np.abs(problem.rates).max()
    rates, first = _follow(problem, problem.rates.copy(), closing, np.zeros(m), size)
    _, second = _follow(problem, rates, np.zeros(m), problem.restitution * first[:m], size)
    return first + second


def _follow(problem, rates, closing, given, size) -> tuple[np.ndarray, np.ndarray]:
    """Rates and impulses at a = 1, of a compression (given = 0) or an expansion (closing = 0)."""
    m, total, a = len(problem.normal), np.zeros(len(rates)), 0.0
    for _ in range(1000):
        gaps = rates[:m] - (1 - a) * closing
        gaps = np.where(np.abs(gaps) < SMALL * size, 0.0, gaps)
        slips = np.where(np.abs(rates[m:]) < SMALL * size, 0.0, rates[m:])
        for direction in (1.0, -1.0):  # backwards where friction jams
            p = _piece(problem, gaps, slips, direction * -closing, given)
            if p is not None:
                break
        else:
            raise NoPieceError
        change = problem.delassus @ p
        lengths = [(1 - a) if direction > 0 else math.inf]
        approach = change[:m] + direction * closing
        lengths += [-x / dx for x, dx in zip(gaps, approach, strict=True) if x > 0 > dx]
        lengths += [-x / dx for x, dx in zip(slips, change[m:], strict=True) if x * dx < 0]
        length = min(lengths)
        if math.isinf(length):  # a jam that no stop of a slip ends
            raise NoPieceError
        rates, total, a = rates + change * length, total + p * length, a + direction * length
        if a >= 1 - 1e-14:
            return rates, total
    raise NoPieceError


def _piece(problem, gaps, slips, lift, given) -> np.ndarray | None:
    """d(P, Q)/da of the one pattern that goes on."""
    G, m = problem.delassus, len(problem.normal)
    active = [i for i in range(m) if gaps[i] <= 0]
    senses = [(0, 1, -1) if s == 0 else (int(np.sign(s)),) for s in slips]
    for loaded in itertools.product((True, False), repeat=len(active)):
        for sense in itertools.product(*senses):
            press = [i for i, yes in zip(active, loaded, strict=True) if yes]
            p = _solve(problem, G, press, sense, lift, given)
            if p is None:
                continue
            change, scale = G @ p, np.abs(p).max() + 1e-300
            good = all(p[i] >= given[i] - SMALL * scale for i in press)
            good &= all(
                change[i] - lift[i] >= -SMALL * np.abs(change).max(initial=1e-300)
                for i in active if i not in press
            )  # fmt: skip
            for j, how in enumerate(sense):
                touching = [i for i in range(m) if problem.slips_with[i] == j and p[i] > 0]
                if how == 0:
                    good &= (
                        abs(p[m + j])
                        <= sum(problem.friction[i] * p[i] for i in touching) + SMALL * scale
                    )
                elif slips[j] == 0:
                    good &= how * change[m + j] >= -SMALL * np.abs(change).max(initial=1e-300)
            if good:
                return p
    return None


def _solve(problem, G, press, sense, lift, given) -> np.ndarray | None:
    m, r = len(problem.normal), len(G)
    coupling, unknown, fixed = np.eye(r), list(press), np.zeros(r)
    fixed[:m] = given
    for j, how in enumerate(sense):
        touching = [i for i in range(m) if problem.slips_with[i] == j]
        if how == 0:
            if any(i in press or given[i] > 0 for i in touching):
                unknown.append(m + j)
            continue
        for i in touching:
            if math.isinf(problem.friction[i]):
                if i in press or given[i] > 0:
                    return None
                continue
            coupling[m + j, i] = -how * problem.friction[i]
    fixed = coupling @ fixed
    extra = np.zeros(r)
    if unknown:
        effect = (G @ coupling)[np.ix_(unknown, unknown)]
        if np.linalg.cond(effect) > 1e12:
            return None
        target = np.concatenate([lift, np.zeros(r - m)])
        extra[unknown] = np.linalg.solve(effect, (target - G @ fixed)[unknown])
    return coupling @ extra + fixed
