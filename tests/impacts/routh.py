"""One contact with Coulomb's friction in the plane, followed in the normal impulse (Routh 1860).

While the contact slips, friction is -mu dP against the slip of that moment; where the slip stops it
sticks, mu G_tt >= |G_nt|, or turns. The rates are pieces of straight lines in P, and each of the
three restitutions ends them: by rates (Newton), by impulses (Poisson) or by work (Stronge 1990).
"""

import itertools
import math

import numpy as np

from tests.impacts.mechanics import Impact


def slopes(G: np.ndarray, sense: int, mu: float) -> tuple[np.ndarray, float]:
    """d(u, s)/dP and dQ/dP of a slip to one side, or of a contact that sticks: sense 0."""
    pull = -G[1, 0] / G[1, 1] if sense == 0 else -sense * mu
    return G[:, 0] + G[:, 1] * pull, pull


def after_stop(G: np.ndarray, mu: float) -> int:
    """The sense of the slip after a stop; 0 where friction holds it."""
    return 0 if mu * G[1, 1] >= abs(G[1, 0]) else int(math.copysign(1, G[1, 0]))


def pieces(G: np.ndarray, rates: np.ndarray, mu: float) -> list[tuple[float, np.ndarray, float]]:
    """(P at the start, slopes of the rates, dQ/dP) of each piece; infinite friction has no slip."""
    s = rates[1]
    if s == 0 or math.isinf(mu):
        return [(0.0, *slopes(G, after_stop(G, mu), mu))]
    first = slopes(G, int(math.copysign(1, s)), mu)
    found = [(0.0, *first)]
    if first[0][1] * s < 0:
        found.append((-s / first[0][1], *slopes(G, after_stop(G, mu), mu)))
    return found


def routh(problem: Impact, restitution: str = "energy") -> np.ndarray:
    """(P, Q) of a single contact. restitution : "speed", "impulse" or "energy"."""
    (mu,), (e,) = problem.friction, problem.restitution
    path = Path(problem.delassus, problem.rates, mu)
    compressed = path.impulse_at(0.0)
    if restitution == "speed":
        P = path.impulse_at(-e * problem.rates[0])
    elif restitution == "impulse":
        P = (1 + e) * compressed
    else:
        P = path.impulse_with_work(compressed, -(e**2) * path.work(0.0, compressed))
    return np.array([P, path.friction(P)])


class Path:
    """u, s and Q as functions of P."""

    def __init__(self, G: np.ndarray, rates: np.ndarray, mu: float) -> None:
        self.pieces, self.starts = pieces(G, rates, mu), [np.array(rates, float)]
        for (P0, slope, _), (P1, *_) in itertools.pairwise(self.pieces):
            self.starts.append(self.starts[-1] + slope * (P1 - P0))

    def bounds(self) -> list[float]:
        return [P for P, *_ in self.pieces[1:]] + [math.inf]

    def rates(self, P: float) -> np.ndarray:
        i = max(j for j, (P0, *_) in enumerate(self.pieces) if P >= P0)
        return self.starts[i] + self.pieces[i][1] * (P - self.pieces[i][0])

    def friction(self, P: float) -> float:
        return sum(
            pull * (min(P, end) - P0)
            for (P0, _, pull), end in zip(self.pieces, self.bounds(), strict=True)
            if P > P0
        )

    def work(self, start: float, stop: float) -> float:
        """Integral of u dP."""
        corners = [start, *(P for P in self.bounds() if start < P < stop), stop]
        return sum(
            (self.rates(a)[0] + self.rates(b)[0]) / 2 * (b - a)
            for a, b in itertools.pairwise(corners)
        )

    def impulse_at(self, u: float) -> float:
        """P at which the rate of the gap has grown to u, after a jam."""
        for (P0, slope, _), at, end in reversed(
            list(zip(self.pieces, self.starts, self.bounds(), strict=True))
        ):
            if slope[0] > 0 and at[0] <= u <= at[0] + slope[0] * (end - P0):
                return P0 + (u - at[0]) / slope[0]
        raise ValueError("the contact never leaves")

    def impulse_with_work(self, start: float, work: float) -> float:
        """P up to which the integral of u dP from the greatest compression on is the work."""
        for (P0, slope, _), end in zip(self.pieces, self.bounds(), strict=True):
            if end <= start:
                continue
            begin = max(P0, start)
            done, u = self.work(start, begin), self.rates(begin)[0]
            left = work - done
            root = math.sqrt(max(u * u + 2 * slope[0] * left, 0.0))
            P = begin + 2 * left / ((u + root) or 1.0)
            if end >= P:
                return P
        raise AssertionError
