"""The workloads by heyoka, as somebody who knows it would write them.

Adaptive Taylor series, compiled before the clock starts, in unrolled code (its compact mode takes
longer here; fast_math gains nothing). The ground's law is in parameters. An impact is a terminal
event whose callback turns the motion round, so that one call of propagate_until passes a whole
law. The endless impacts before a rest end at a threshold: slower than `rest` [rad/s] and with the
gap closing, contact is full. There the block waits for a closed form of its uplift; the column's
vibration is integrated up to an event.

Raises ImportError where heyoka is not installed.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import heyoka as hy
import numpy as np

from benchmarks import by_hand, workloads as w
from benchmarks.by_hand import AHEAD, COLUMN, CREEP, Law


class _Callback:
    def __deepcopy__(self, _: object) -> _Callback:
        return self  # heyoka copies callbacks; these are read and changed from outside


class Impact(_Callback):
    """Terminal event: writes the impact down, turns the motion round, and stops it at rest."""

    def __init__(self, structure, rest: float) -> None:
        self.structure, self.rate_at, self.ratio = structure, structure.rate_at, structure.ratio
        self.rest = rest
        self.most = math.inf
        self.law: Law
        self.restart()

    def restart(self) -> None:
        self.times: list[float] = []
        self.rates: list[float] = []

    def attach(self, integrator) -> None:
        self.integrator, self.y, self.par = integrator, integrator.state, integrator.pars

    def __call__(self, *_: object) -> bool:
        y, par = self.y, self.par
        t, rate = self.integrator.time, y[self.rate_at]
        self.times.append(self.law[0] + t)
        self.rates.append(rate)
        side = -par[0]
        rate *= self.ratio
        par[0], y[0], y[self.rate_at] = side, AHEAD * rate, rate
        if -self.rest < rate < self.rest:
            a = by_hand.acceleration(self.law, t)
            if self.structure.closes(side, y, a):
                par[0] = 0.0  # both feet
                return False
        return len(self.times) < self.most

    def impacts(self) -> w.Impacts:
        return w.Impacts(np.array(self.times), np.array(self.rates))


class Overturning(_Callback):
    """Terminal event that stops the motion, and says so."""

    happened = False

    def __call__(self, *_: object) -> bool:
        self.happened = True
        return False


class Crest(_Callback):
    """Event at a turning point: the largest |rotation| so far."""

    largest = 0.0

    def __call__(self, integrator, t: float, _: object) -> None:
        self.largest = max(self.largest, abs(integrator.update_d_output(t)[0]))


def _falls(guard, callback=None):
    """Event where a guard falls through zero; its direction, not a cooldown, tells it from the
    last one."""
    more = {} if callback is None else {"callback": callback}
    return hy.t_event(guard, direction=hy.event_direction.negative, cooldown=0.0, **more)


# -- the block -----------------------------------------------------------------------------------

QUIET, LINE, SINE = -1, 0, 1
PARAMETERS = {QUIET: 1, LINE: 3, SINE: 4}  # the side, then the numbers of the law


class Rocking:
    """The block's integrator for one kind of law; its time counts from the start of the law."""

    def __init__(
        self, tolerance: float, rest: float, kind: int, block=by_hand.BLOCK, crests: bool = False
    ) -> None:
        theta, rate = hy.make_vars("theta", "rate")
        side, c0, c1, c2 = (hy.par[i] for i in range(4))
        a = {QUIET: None, LINE: c0 + c1 * hy.time, SINE: c0 * hy.sin(c1 * hy.time + c2)}[kind]
        self.block, self.kind = block, kind
        self.impact, self.overturning, self.crest = Impact(block, rest), Overturning(), Crest()
        events, others = [_falls(side * theta, self.impact)], {}
        if crests:
            events.append(_falls(0.5 * math.pi - side * theta, self.overturning))
            others["nt_events"] = [hy.nt_event(rate, self.crest)]
        self.integrator = hy.taylor_adaptive(
            [(theta, rate), (rate, block.rate(side, theta, a, hy.sin, hy.cos))],
            [0.0, 0.0],
            pars=[0.0] * PARAMETERS[kind],
            tol=tolerance,
            t_events=events,
            **others,
        )
        self.impact.attach(self.integrator)
        self.y, self.par = self.integrator.state, self.integrator.pars

    def start(self, theta: float = 0.0, rate: float = 0.0, side: float = 0.0) -> None:
        self.y[:] = theta, rate
        self.par[0] = side
        self.impact.restart()
        self.overturning.happened, self.crest.largest = False, 0.0

    def follow(self, law: Law, t: float = 0.0) -> None:
        """From t to the end of the law, or until it overturned, or the last impact asked for."""
        integrator, y, par = self.integrator, self.y, self.par
        end = law[1] - law[0]
        self.impact.law = law
        par[1:] = law[3 : 2 + len(par)]
        while t < end:
            if par[0] == 0.0:
                t = self.block.uplift(law, t)
                if t >= end:
                    return
                par[0] = side = -math.copysign(1.0, by_hand.acceleration(law, t))
                y[0], y[1] = AHEAD * CREEP * side, CREEP * side
            integrator.time = t
            integrator.propagate_until(end)
            t = integrator.time
            if self.overturning.happened or len(self.impact.times) >= self.impact.most:
                return


def _quiet(end: float) -> Law:
    return (0.0, end, 0.0, 0.0, 0.0, 0.0)


def free_decay(tolerance: float, rest: float) -> Callable[[], w.Impacts]:
    block = Rocking(tolerance, rest, QUIET)
    block.impact.most = w.N_IMPACTS

    def run() -> w.Impacts:
        block.start(w.RELEASE, 0.0, 1.0)
        block.follow(_quiet(100.0))
        return block.impact.impacts()

    return run


def block_under_record(tolerance: float, rest: float) -> Callable[[], w.Impacts]:
    block, laws = Rocking(tolerance, rest, LINE), by_hand.laws(w.record())

    def run() -> w.Impacts:
        block.start()
        par, impact, limit = block.par, block.impact, block.block.limit
        integrator, until = block.integrator, block.integrator.propagate_until
        for law in laws:
            start, end, _, c0, c1, _ = law
            length = end - start
            if par[0] != 0.0:
                # nearly always: no more than this is left of a sample
                impact.law, par[1], par[2], integrator.time = law, c0, c1, 0.0
                until(length)
                if par[0] == 0.0:
                    block.follow(law, integrator.time)
            elif not (-limit <= c0 <= limit and -limit <= c0 + c1 * length <= limit):
                block.follow(law)
        return impact.impacts()

    return run


def pulses(tolerance: float, rest: float) -> Callable[[], tuple[np.ndarray, np.ndarray]]:
    """Outcome and peak of every pulse of the thinned grid."""
    shaken = Rocking(tolerance, rest, SINE, crests=True)
    free = Rocking(tolerance, rest, QUIET, crests=True)
    pulses = [by_hand.laws(motion)[0] for motion in w.pulses(w.PULSE_STRIDE)]

    def one(law: Law) -> tuple[bool, float]:
        shaken.start()
        shaken.follow(law)
        side, largest = shaken.par[0], shaken.crest.largest
        if shaken.overturning.happened or side == 0.0:
            return shaken.overturning.happened, largest
        free.start(*shaken.y, side)
        free.follow(_quiet(w.PULSE_END - law[1]))
        largest = max(largest, free.crest.largest)
        if not free.overturning.happened and free.par[0] != 0.0:
            largest = max(largest, abs(free.y[0]))
            free.impact.most = len(free.impact.times) + 1
            free.follow(_quiet(1e3 * w.PULSE_END))  # to a fall or a return
            free.impact.most = math.inf
        return free.overturning.happened, largest

    def run() -> tuple[np.ndarray, np.ndarray]:
        fell, peaks = zip(*map(one, pulses), strict=True)
        return np.array(fell), np.array(peaks)

    return run


def bifurcation(tolerance: float, rest: float) -> Callable[[], dict[float, np.ndarray]]:
    """The amplitudes of the reference alone."""
    block = Rocking(tolerance, rest, SINE, by_hand.DRIVEN)
    motions = {float(a): by_hand.laws(w.shaking(a))[0] for a in w.REFERENCE_AMPLITUDES}

    def one(law: Law) -> np.ndarray:
        block.start()
        block.follow(law)
        found = block.impact.impacts()
        return w.kept(w.Impacts(found.times, found.rates / by_hand.DRIVEN.alpha))

    return lambda: {a: one(law) for a, law in motions.items()}


# -- the column ----------------------------------------------------------------------------------


def column_under_record(tolerance: float, rest: float) -> Callable[[], w.Impacts]:
    theta, u, theta_dot, u_dot = hy.make_vars("theta", "u", "theta_dot", "u_dot")
    side, a = hy.par[0], hy.par[1] + hy.par[2] * hy.time
    theta_ddot, u_ddot = COLUMN.rates(side, theta, u, theta_dot, u_dot, a, hy.sin, hy.cos)
    impact = Impact(COLUMN, rest)
    rocking = hy.taylor_adaptive(
        [(theta, theta_dot), (u, u_dot), (theta_dot, theta_ddot), (u_dot, u_ddot)],
        [0.0] * 4,
        pars=[0.0] * 3,
        tol=tolerance,
        t_events=[_falls(side * theta, impact)],
    )
    impact.attach(rocking)
    a = hy.par[0] + hy.par[1] * hy.time
    upright = hy.taylor_adaptive(
        [(u, u_dot), (u_dot, COLUMN.upright(u, u_dot, a))],
        [0.0, 0.0],
        pars=[0.0, 0.0],
        tol=tolerance,
        t_events=[_falls(-COLUMN.opening(s, u, u_dot, a)) for s in (-1.0, 1.0)],
    )
    lifted = {hy.taylor_outcome(-1): -1.0, hy.taylor_outcome(-2): 1.0}
    laws = by_hand.laws(w.record())
    y, par, z, z_par = rocking.state, rocking.pars, upright.state, upright.pars
    rock, vibrate = rocking.propagate_until, upright.propagate_until

    def run() -> w.Impacts:
        y[:], par[:], z[:] = 0.0, 0.0, 0.0
        impact.restart()
        for law in laws:
            start, end, _, c0, c1, _ = impact.law = law
            length, t = end - start, 0.0
            while t < length:
                if par[0] != 0.0:
                    par[1], par[2], rocking.time = c0, c1, t
                    rock(length)
                    t = rocking.time
                    if par[0] == 0.0:
                        z[0], z[1] = y[1], y[3]
                    continue
                opened = 0.0
                for s in (-1.0, 1.0):  # by the beginning of a law, or by the impact
                    if COLUMN.opening(s, z[0], z[1], c0 + c1 * t) > 0.0:
                        opened = s
                if opened == 0.0:
                    z_par[0], z_par[1], upright.time = c0, c1, t
                    opened = lifted.get(vibrate(length)[0], 0.0)
                    t = upright.time
                if opened != 0.0:
                    par[0] = opened
                    y[:] = AHEAD * CREEP * opened, z[0], CREEP * opened, z[1]
        return impact.impacts()

    return run


RUNS = {
    "W1": free_decay,
    "W2": block_under_record,
    "W3": column_under_record,
    "W4": pulses,
    "W5": bifurcation,
}
"""Workload -> (tolerance, threshold of rest [rad/s]) -> what runs it."""
