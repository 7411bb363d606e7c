"""Linear springs at the contacts of rigid bodies, integrated in time through an impact.

While a spring of stiffness k is compressed its force grows by k times the speed, while it extends
it falls by k/e^2 times the speed, and so e^2 of the energy comes back (Stronge's restitution). In
each mode the motion is x' = A x, whose solution is an exponential, and a mode ends where a linear
function of x falls through zero: no step, no regularisation, no tolerance but that of a root. In
the time that the impact takes places do not change, and velocities alone enter.

A contact that has opened closes again either as soon as its gap shrinks (gaps="forgotten": the
impact takes no time, and a force is a function of the energy in the spring, as in the law of Liu,
Zhao and Brogliato 2008), or where it has come back to the place at which it opened
(gaps="followed": springs as they are).
"""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from tests.impacts.mechanics import Impact

OPEN, LOADS, UNLOADS, HELD, LOWERED = "open", "loads", "unloads", "held", "lowered"
"""A contact without force; one whose force grows; falls; without restitution, at rest, its force
falls at once to one that holds it there, and then falls on (held) or grows (lowered)."""
STICKS, FREE = 0, None
"""A slip that friction stops, and one without friction; 1 and -1 are slip to either side."""
ZERO, REST = 1e-11, 1e-13
TERMS = 26  # of the exponential, over half a radian of the fastest contact: exact
GRID = np.linspace(0.0, 1.0, 9)[:, None] ** np.arange(TERMS)


class Mode(NamedTuple):
    """What each contact and each slip does."""

    contacts: tuple[str, ...]
    slips: tuple[int | None, ...]


class Motion(NamedTuple):
    """impulses (m + g,) and rates (m + g,) after the impact, its modes in their order, and the
    largest energy in all springs."""

    impulses: np.ndarray
    rates: np.ndarray
    modes: list[Mode]
    stored: float


class UndecidedError(Exception):
    """No mode goes on, or several do."""


class Springs:
    """x = (u, s, F, P, Q, gap) of an impact, and its modes."""

    def __init__(self, problem: Impact, gaps: str = "forgotten") -> None:
        self.problem, self.follow = problem, {"followed": True, "forgotten": False}[gaps]
        self.m, self.g = len(problem.normal), len(problem.slip)
        m, r = self.m, self.m + self.g
        self.r, self.size = r, 2 * r + 2 * m
        self.u, self.s = slice(0, m), slice(m, r)
        self.F, self.impulse = slice(r, r + m), slice(r + m, 2 * r + m)
        self.gap = slice(2 * r + m, 2 * r + 2 * m)
        matrix = problem.delassus
        scale = np.sqrt(np.diag(matrix)[:m] * problem.stiffness).max()
        self.k = problem.stiffness / scale**2  # the fastest contact alone has the frequency 1
        self.G = matrix

    def start(self) -> np.ndarray:
        x = np.zeros(self.size)
        x[: self.r] = self.problem.rates
        return x

    def touching(self, slip: int) -> list[int]:
        return [i for i in range(self.m) if self.problem.slips_with[i] == slip]

    def forces(self, mode: Mode) -> np.ndarray:
        """(r, size): normal and friction forces of a mode as linear functions of x."""
        m, r = self.m, self.r
        z, unknown = np.zeros((r, self.size)), []
        coupling = np.eye(r)  # from chosen forces to all: slip adds friction to a normal force
        for j, sense in enumerate(mode.slips):
            if sense in (1, -1):
                for i in self.touching(j):
                    coupling[m + j, i] = -sense * self.problem.friction[i]
            if sense == STICKS:
                unknown.append(m + j)
        for i, state in enumerate(mode.contacts):
            if state in (LOADS, UNLOADS):
                z[i, self.F.start + i] = 1.0
            if state == HELD:
                unknown.append(i)
        if unknown:  # rates that stay zero
            effect = self.G @ coupling
            z[unknown] = -np.linalg.solve(effect[np.ix_(unknown, unknown)], effect[unknown] @ z)
        return coupling @ z

    def matrix(self, mode: Mode) -> np.ndarray:
        """A of x' = A x."""
        A, z = np.zeros((self.size, self.size)), self.forces(mode)
        A[: self.r] = self.G @ z
        A[self.impulse] = z
        for i, state in enumerate(mode.contacts):
            if state in (LOADS, UNLOADS):
                e = 1.0 if state == LOADS else self.problem.restitution[i]
                A[self.F.start + i, i] = -self.k[i] / e**2
            if state == OPEN and self.follow:
                A[self.gap.start + i, i] = 1.0
        for i, state in enumerate(mode.contacts):
            if state == HELD:  # the force is a combination of others, and its rate of theirs
                A[self.F.start + i] = z[i] @ A
        return A

    def conditions(self, mode: Mode) -> np.ndarray:
        """Rows c: a mode goes on as long as all c x >= 0."""
        rows, z = [], self.forces(mode)
        unit = np.eye(self.size)
        for i, state in enumerate(mode.contacts):
            if state == OPEN:
                rows.append(unit[self.gap.start + i if self.follow else i])
            elif state == LOADS:
                rows.append(-unit[i])
            elif state == UNLOADS:
                rows += [unit[i], unit[self.F.start + i]]
            else:
                rows += [z[i], -z[i] @ self.matrix(mode)]
        for j, sense in enumerate(mode.slips):
            if sense in (1, -1):
                rows.append(sense * unit[self.m + j])
            elif sense == STICKS:
                mu = self.problem.friction
                pressed = [i for i in self.touching(j) if mode.contacts[i] != OPEN]
                if not np.isinf(mu[pressed]).any():
                    limit = mu[pressed] @ z[pressed]
                    rows += [limit - z[self.m + j], limit + z[self.m + j]]
        return np.array(rows)

    def candidates(self, x: np.ndarray) -> Iterator[Mode]:
        """Modes that the signs of x leave."""
        states = []
        for i in range(self.m):
            u, force, e = x[i], x[self.F.start + i], self.problem.restitution[i]
            if force == 0:
                away = x[self.gap.start + i] > 0 or u > 0
                states.append((OPEN,) if away else (LOADS,) if u < 0 else (OPEN, LOADS))
            elif e > 0:
                states.append((LOADS,) if u < 0 else (UNLOADS,) if u > 0 else (LOADS, UNLOADS))
            else:
                states.append((LOADS,) if u < 0 else (LOADS, HELD, LOWERED, OPEN))
        for contacts in itertools.product(*states):
            slips = []
            for j in range(self.g):
                pressed = [i for i in self.touching(j) if contacts[i] != OPEN]
                smooth = not any(self.problem.friction[i] for i in pressed)
                stuck = any(math.isinf(self.problem.friction[i]) for i in pressed)
                s = x[self.m + j]
                slips.append(
                    (FREE,) if smooth else (STICKS,) if stuck
                    else (STICKS, 1, -1) if s == 0 else (int(np.sign(s)),)
                )  # fmt: skip
            for chosen in itertools.product(*slips):
                yield Mode(contacts, chosen)

    def enter(self, x: np.ndarray, mode: Mode) -> tuple[np.ndarray, Mode]:
        """x, less forces that fall at once, of contacts without restitution, and what follows."""
        x, first, then = x.copy(), list(mode.contacts), list(mode.contacts)
        for i, state in enumerate(mode.contacts):
            if state == OPEN:
                x[self.F.start + i] = 0.0
            if state == LOWERED:
                first[i], then[i] = HELD, LOADS
        held = [i for i, state in enumerate(first) if state == HELD]
        at_once = self.forces(mode._replace(contacts=tuple(first))) @ x
        x[[self.F.start + i for i in held]] = at_once[held]
        return x, mode._replace(contacts=tuple(then))

    def choose(self, x: np.ndarray) -> tuple[Mode, np.ndarray]:
        """The mode that goes on: each condition is positive, or its first derivative that is not 0.

        Several can fit where they are one motion: the first serves when all move alike.
        """
        fits = []
        for candidate in self.candidates(x):
            entered, mode = self.enter(x, candidate)
            if any(
                state == HELD and not entered[self.F.start + i] > ZERO * x[self.F.start + i]
                for i, state in enumerate(mode.contacts)
            ):
                continue
            if np.any((entered[self.F] < 0) | (entered[self.F] > x[self.F] * (1 + ZERO))):
                continue
            series, A = [entered], self.matrix(mode)
            for _ in range(2 * self.r):
                series.append(A @ series[-1])
            moving = np.abs(np.array(series)[:, : self.r + self.m])
            sizes = np.append(moving[0, self.F].max(), moving[1:].max(axis=1)) + 1e-300
            rows = self.conditions(mode)
            values = np.array(series) @ rows.T / sizes[:, None]
            snapped = np.abs(rows).sum(axis=1) == 1  # a rate or a force, which is zero or is not
            values[0, snapped] = np.sign(values[0, snapped])
            if all(first_sign(column) >= 0 for column in values.T):
                fits.append((mode, entered, A @ entered))
        if not fits:
            raise UndecidedError("no mode")
        most = max(entered[self.F].sum() for _, entered, _ in fits)  # the first on its way down
        fits = [fit for fit in fits if fit[1][self.F].sum() >= most * (1 - 1e-9)]
        motions = np.array([rate[: self.r] for *_, rate in fits])
        if np.ptp(motions, axis=0).max(initial=0.0) > 1e-7 * (1e-300 + np.abs(motions).max()):
            raise UndecidedError(f"several modes: {[mode for mode, *_ in fits]}")
        return fits[0][:2]

    def active(self, x: np.ndarray) -> float:
        """The largest speed, or force as a speed, of contacts that are pressed or close."""
        pressed = (x[self.F] > 0) | (x[self.u] < 0)
        forces = np.diag(self.G)[: self.m] * x[self.F]
        return float(np.maximum(np.abs(x[self.u]) * pressed, forces).max())

    def snap(self, x: np.ndarray) -> np.ndarray:
        """Rates and forces that are zero up to rounding, as zeros."""
        x, small = x.copy(), ZERO * self.active(x)
        for part in (slice(0, self.r), self.F):
            x[part] = np.where(np.abs(x[part]) < small, 0.0, x[part])
        return x

    def run(self, most: int = 20000) -> Motion:
        x, modes, stored = self.start(), [], 0.0
        speed = np.abs(x[: self.r]).max()
        for _ in range(most):
            if self.active(x) < REST * speed:  # nothing left, or infinitely many modes to rest
                return Motion(x[self.impulse], x[: self.r], modes, stored)
            mode, x = self.choose(self.snap(x))
            modes.append(mode)
            x = self.advance(x, mode)
            stored = max(stored, float((x[self.F] ** 2 / (2 * self.k)).sum()))
        raise UndecidedError("endless")

    def advance(self, x: np.ndarray, mode: Mode) -> np.ndarray:
        """x where the mode ends: the first root of its conditions."""
        if all(state == OPEN for state in mode.contacts):  # flight, up to the first gap that closes
            return self.fly(x, mode)
        A, rows = self.matrix(mode), self.conditions(mode)
        h = 0.5 / max(np.abs(np.linalg.eigvals(A)).max(), 1e-9)
        powers = [np.eye(self.size)]
        for k in range(1, TERMS):
            powers.append(powers[-1] @ A * (h / k))
        series = np.array(powers)  # x(t) is the sum of series[k] x (t / h)^k
        leaving = rows @ x <= ZERO * np.abs(x[: self.r + self.m]).max()
        for _ in range(10**6):
            terms = series @ x
            ends = {}
            for i, polynomial in enumerate(rows @ terms.T):
                t = first_root(polynomial, bool(leaving[i]))
                if t is not None:
                    ends[i] = t
            if ends:
                t = min(ends.values())
                x = t ** np.arange(TERMS) @ terms
                for i, end in ends.items():
                    where = np.flatnonzero(rows[i])
                    if end <= t + 1e-12 and len(where) == 1:  # a rate, a force or a gap
                        x[where] = 0.0
                return self.exact_zeros(x, mode)
            x, leaving = terms.sum(axis=0), np.zeros(len(rows), bool)
        raise UndecidedError("a mode without end")

    def fly(self, x: np.ndarray, mode: Mode) -> np.ndarray:
        """x where the first gap of an open contact has closed."""
        times = [-x[self.gap][i] / u for i, u in enumerate(x[self.u]) if u < 0]
        x = x + self.matrix(mode) @ x * min(times)
        x[self.gap] = np.where(np.abs(x[self.gap]) < 1e-14 * max(times), 0.0, x[self.gap])
        return x

    def exact_zeros(self, x: np.ndarray, mode: Mode) -> np.ndarray:
        """x whose constrained rates are zero without the rounding of the steps."""
        for i, state in enumerate(mode.contacts):
            if state == HELD:
                x[i] = 0.0
        for j, sense in enumerate(mode.slips):
            if sense == STICKS:
                x[self.m + j] = 0.0
        return x


def first_sign(values: np.ndarray, small: float = 1e-9) -> int:
    """The sign of the first value that is not zero."""
    for value in values:
        if abs(value) > small:
            return int(np.sign(value))
    return 0


def first_root(polynomial: np.ndarray, leaves: bool) -> float | None:
    """The first t in (0, 1] at which a polynomial falls through zero, if there is one.

    leaves : it is zero at 0 and grows first.
    """
    values, slopes = GRID @ polynomial, GRID[:, :-1] @ (polynomial[1:] * np.arange(1, TERMS))

    def at(t: float) -> float:
        return float(polynomial @ t ** np.arange(TERMS))

    def slope(t: float) -> float:
        return float((polynomial[1:] * np.arange(1, TERMS)) @ t ** np.arange(TERMS - 1))

    start, steps = 0.0, np.linspace(0.0, 1.0, len(GRID))
    if leaves:
        start = next((t for t in 0.125 * 0.5 ** np.arange(45) if at(t) > 0), 0.125)
    for i in range(1, len(GRID)):
        low, end = max(start, steps[i - 1]), steps[i]
        if values[i] > 0:
            if not (slopes[i - 1] < 0 < slopes[i]) or slope(low) >= 0:
                continue
            end = brentq(slope, low, end, xtol=1e-15)
            if at(end) > 0:
                continue
        if at(low) <= 0:
            return float(low)
        return float(brentq(at, low, end, xtol=1e-16, rtol=1e-15))
    return None


def springs(problem: Impact, gaps: str = "forgotten") -> Motion:
    """The impact by springs, integrated in time."""
    return Springs(problem, gaps).run()
