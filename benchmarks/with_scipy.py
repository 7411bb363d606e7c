"""The workloads by scipy.integrate.solve_ivp.

One call from an impact, an uplift or a sample of the record to the next, with terminal events
that have a direction, in plain floats. The endless impacts before a rest end at a threshold: slower
than `rest` [rad/s] and with the gap closing, contact is full. There the block waits for a closed
form of its uplift; the column's vibration is integrated up to an event.
"""

import functools
import math
from collections.abc import Callable
from math import cos, sin

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks import by_hand, workloads as w
from benchmarks.by_hand import AHEAD, BLOCK, COLUMN, CREEP, Block, Law

Ground = Callable[[float], float]


def _event(function: Callable, direction: float = -1.0, terminal: bool = True) -> Callable:
    function.direction, function.terminal = direction, terminal
    return function


class Rocking:
    """A structure's arcs, its impacts, and the largest |rotation|."""

    def __init__(self, structure, method: str, rtol: float, rest: float) -> None:
        self.structure, self.method, self.rtol, self.rest = structure, method, rtol, rest
        self.column = structure is COLUMN
        self.side = 0.0
        self.y = [0.0] * (4 if self.column else 2)
        self.times: list[float] = []
        self.rates: list[float] = []
        self.largest, self.fell, self.crests = 0.0, False, False

    def _solve(
        self, f: Callable, span: tuple, y: list, events: list, whole: bool = False, **options
    ):
        if whole:  # spares the search for a first step
            options["first_step"] = span[1] - span[0]
        solution = solve_ivp(
            f, span, y, self.method, events=events, rtol=self.rtol, atol=1e-2 * self.rtol, **options
        )
        if solution.status < 0:
            raise ArithmeticError(solution.message)
        return solution

    def arc(self, ground: Ground | None, t: float, end: float, begin: float, **options) -> float:
        """Rock from t to an impact, a fall or the end; times count from `begin`."""
        s, structure = self.side, self.structure

        if self.column:

            def f(t, y):
                theta, u, theta_dot, u_dot = y.tolist()
                a = ground(t)
                both = structure.rates(s, theta, u, theta_dot, u_dot, a, sin, cos)
                return theta_dot, u_dot, *both

        elif ground is None:
            p2, tilt = structure.p2, s * structure.alpha

            def f(_, y):
                theta, rate = y.tolist()
                return rate, p2 * sin(theta - tilt)

        else:
            p2, tilt, p2_g = structure.p2, s * structure.alpha, structure.p2 / structure.gravity

            def f(t, y):
                theta, rate = y.tolist()
                angle = theta - tilt
                return rate, p2 * sin(angle) - p2_g * ground(t) * cos(angle)

        events = [_event(lambda _, y: s * y[0])]
        if self.crests:
            events.append(_event(lambda _, y: 0.5 * math.pi - s * y[0]))
            events.append(_event(lambda _, y: y[1], 0.0, terminal=False))
        solution = self._solve(f, (t, end), self.y, events, **options)
        t = float(solution.t[-1])
        self.y = solution.y[:, -1].tolist()
        if self.crests:
            crests = [abs(y[0]) for y in solution.y_events[2]]
            self.largest = max(self.largest, abs(self.y[0]), *crests)
            self.fell = len(solution.t_events[1]) > 0
        if len(solution.t_events[0]):
            self._impact(ground, t, begin)
        return t

    def _impact(self, ground: Ground | None, t: float, begin: float) -> None:
        y, at = self.y, self.structure.rate_at
        self.times.append(begin + t)
        self.rates.append(y[at])
        self.side = -self.side
        y[at] *= self.structure.ratio
        y[0] = AHEAD * y[at]
        if abs(y[at]) < self.rest:
            a = 0.0 if ground is None else ground(t)
            if self.structure.closes(self.side, y, a):
                self.side = 0.0

    def vibrate(self, ground: Ground, t: float, end: float, **options) -> float:
        """The column in full contact, until a side opens."""
        u, u_dot = self.y[1], self.y[3]
        opening, opened = self.structure.opening, 0.0
        for s in (-1.0, 1.0):  # by the beginning of a law, or by the impact
            if opening(s, u, u_dot, ground(t)) > 0.0:
                opened = s
        if opened == 0.0:
            upright = self.structure.upright

            def f(t, y):
                u, u_dot = y.tolist()
                return u_dot, upright(u, u_dot, ground(t))

            events = [
                _event(lambda t, y, s=s: -opening(s, y[0], y[1], ground(t))) for s in (-1.0, 1.0)
            ]
            solution = self._solve(f, (t, end), [u, u_dot], events, **options)
            t = float(solution.t[-1])
            u, u_dot = solution.y[:, -1].tolist()
            for s, found in zip((-1.0, 1.0), solution.t_events, strict=True):
                if len(found):
                    opened = s
        self.side = opened
        self.y = [AHEAD * CREEP * opened, u, CREEP * opened, u_dot]
        return t

    def follow(self, law: Law | None, t: float, end: float, begin: float, **options) -> float:
        """Over a law of the ground, None for rest; t counts from the start of the law."""
        ground = None
        if law is not None:
            _, _, kind, c0, c1, c2 = law
            ground = (lambda t: c0 + c1 * t) if kind == 0.0 else (lambda t: c0 * sin(c1 * t + c2))
        while t < end and not self.fell:
            if self.side == 0.0:
                if self.column:
                    t = self.vibrate(ground, t, end, **options)
                    continue
                t = math.inf if law is None else self.structure.uplift(law, t)
                if t >= end:
                    break
                self.side = -math.copysign(1.0, ground(t))
                self.y = [AHEAD * CREEP * self.side, CREEP * self.side]
            t = self.arc(ground, t, end, begin, **options)
        return t

    def impacts(self) -> w.Impacts:
        return w.Impacts(np.array(self.times), np.array(self.rates))


def free_decay(method: str, rtol: float, rest: float) -> Callable[[], w.Impacts]:
    def run() -> w.Impacts:
        rocking = Rocking(BLOCK, method, rtol, rest)
        rocking.side, rocking.y, t = 1.0, [w.RELEASE, 0.0], 0.0
        while len(rocking.times) < w.N_IMPACTS:
            t = rocking.arc(None, t, 100.0, 0.0)
        return rocking.impacts()

    return run


def under_record(structure, method: str, rtol: float, rest: float) -> Callable[[], w.Impacts]:
    laws = by_hand.laws(w.record())

    def run() -> w.Impacts:
        rocking = Rocking(structure, method, rtol, rest)
        for law in laws:
            rocking.follow(law, 0.0, law[1] - law[0], law[0], whole=True)
        return rocking.impacts()

    return run


def over_samples(method: str, rtol: float, rest: float) -> Callable[[], w.Impacts]:
    """The block under the record: one call an arc, in steps no longer than the samples' spacing.

    Fewer calls, but behind an impact the steps straddle the samples, where the acceleration has a
    kink.
    """
    laws, dt = by_hand.laws(w.record()), w.TIME_STEP
    starts, slopes = [law[3] for law in laws], [law[4] for law in laws]

    def ground(t: float) -> float:
        i = min(int(t / dt), len(laws) - 1)
        return starts[i] + slopes[i] * (t - i * dt)

    def run() -> w.Impacts:
        rocking = Rocking(BLOCK, method, rtol, rest)
        t, end = 0.0, laws[-1][1]
        while t < end:
            if rocking.side != 0.0:
                t = rocking.arc(ground, t, end, 0.0, max_step=dt)
                continue
            i = int(t / dt + 1e-9)  # t may be the sample's own time
            lifts = i * dt + BLOCK.uplift(laws[i], max(t - i * dt, 0.0)) if i < len(laws) else end
            if lifts >= (i + 1) * dt:
                t = (i + 1) * dt
                continue
            t = lifts
            rocking.side = -math.copysign(1.0, ground(t))
            rocking.y = [AHEAD * CREEP * rocking.side, CREEP * rocking.side]
        return rocking.impacts()

    return run


def pulses(method: str, rtol: float, rest: float) -> Callable[[], tuple[np.ndarray, np.ndarray]]:
    """Outcome and peak of every pulse of the thinned grid."""
    shaking = [by_hand.laws(motion)[0] for motion in w.pulses(w.PULSE_STRIDE)]

    def one(law: Law) -> tuple[bool, float]:
        rocking = Rocking(BLOCK, method, rtol, rest)
        rocking.crests = True
        rocking.follow(law, 0.0, law[1], 0.0)
        rocking.follow(None, law[1], w.PULSE_END, 0.0)
        largest, t = rocking.largest, w.PULSE_END
        if rocking.side != 0.0 and not rocking.fell:
            rocking.arc(None, t, 1e3 * w.PULSE_END, 0.0)  # to a fall or a return
        return rocking.fell, largest

    def run() -> tuple[np.ndarray, np.ndarray]:
        fell, peaks = zip(*map(one, shaking), strict=True)
        return np.array(fell), np.array(peaks)

    return run


def bifurcation(method: str, rtol: float, rest: float) -> Callable[[], dict[float, np.ndarray]]:
    """The amplitudes of the reference alone."""
    block: Block = by_hand.DRIVEN
    motions = {float(a): by_hand.laws(w.shaking(a))[0] for a in w.REFERENCE_AMPLITUDES}

    def one(law: Law) -> np.ndarray:
        rocking = Rocking(block, method, rtol, rest)
        rocking.follow(law, 0.0, law[1], 0.0)
        found = rocking.impacts()
        return w.kept(w.Impacts(found.times, found.rates / block.alpha))

    return lambda: {a: one(law) for a, law in motions.items()}


RUNS = {
    "W1": free_decay,
    "W2": functools.partial(under_record, BLOCK),
    "W3": functools.partial(under_record, COLUMN),
    "W4": pulses,
    "W5": bifurcation,
}
"""Workload -> (method, relative tolerance, threshold of rest [rad/s]) -> what runs it."""
