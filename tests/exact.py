"""Motions of blocks that are known without stepping: quadrature, hyperbolic functions, sums."""

import itertools
import math

import mpmath as mp
import numpy as np
from scipy.optimize import brentq

GRAVITY = 9.81

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(80)


class FreeBlock:
    """theta'' = -p^2 sin(alpha - theta): a rigid block on one edge, theta > 0.

    theta'^2 / 2 + p^2 cos(alpha - theta) is constant, so the time from a peak to the impact is an
    integral over theta and the speed at the impact a root.
    """

    def __init__(self, p, alpha):
        self.p, self.alpha = p, alpha

    def quarter(self, peak):
        """Time from rest at `peak` to the impact; theta = peak - u^2 takes the singularity away."""
        u = 0.5 * math.sqrt(peak) * (_NODES + 1)
        x = u**2 / 2
        # u / sqrt(sin(x)), regular at u = 0
        ratio = math.sqrt(2) / np.sqrt(np.sinc(x / np.pi))
        values = ratio / (self.p * np.sqrt(np.sin(self.alpha - peak + x)))
        return float(values @ _WEIGHTS) * 0.5 * math.sqrt(peak)

    def impact_energy(self, peak):
        """theta'^2 / 2 at the impact."""
        return 2 * self.p**2 * math.sin(self.alpha - peak / 2) * math.sin(peak / 2)

    def peak(self, energy):
        """Peak reached with theta'^2 / 2 = energy at the impact; Newton on a monotonic function."""
        peak = energy / (self.p**2 * math.sin(self.alpha))
        for _ in range(60):
            slope = self.p**2 * math.sin(self.alpha - peak)
            peak -= (self.impact_energy(peak) - energy) / slope
        return peak


class FreeSlenderBlock(FreeBlock):
    """theta'' = -p^2 (alpha - theta): thesis 2-3, quarter period 2-5."""

    def quarter(self, peak):
        return math.acosh(1 / (1 - peak / self.alpha)) / self.p

    def impact_energy(self, peak):
        return self.p**2 * peak * (self.alpha - peak / 2)

    def peak(self, energy):
        # alpha - sqrt(alpha^2 - c) without cancellation
        c = 2 * energy / self.p**2
        return c / (self.alpha + math.sqrt(self.alpha**2 - c))


def impact_times(block, peak, energy_ratio):
    """Every impact of a free decay from rest at `peak`: an endless series of times."""
    time = 0.0
    while True:
        time += block.quarter(peak)
        yield time
        peak = block.peak(energy_ratio * block.impact_energy(peak))
        time += block.quarter(peak)


def rest_time(block, peak, energy_ratio):
    """Limit of the impact times, summed until the sum no longer changes."""
    terms = [block.quarter(peak)]
    while terms[-1] > 1e-17 * terms[0]:
        peak = block.peak(energy_ratio * block.impact_energy(peak))
        terms.append(2 * block.quarter(peak))
    return math.fsum(terms)


class ShakenSlenderBlock:
    """Slender block under a ground acceleration that is linear between its samples.

    theta'' = p^2 (theta - s alpha - a/g), thesis 2-14 with time in seconds. As a is linear,
    w = theta - s alpha - a/g obeys w'' = p^2 w in each piece: cosh and sinh, exactly.
    """

    def __init__(self, p, alpha, velocity_ratio, acceleration, dt):
        self.p, self.alpha, self.e = p, alpha, velocity_ratio
        self.a, self.dt = np.asarray(acceleration) / GRAVITY, dt

    def piece(self, t0, side, theta, speed):
        """theta and theta' as functions of time from t0 to the next sample."""
        i = min(int(t0 / self.dt + 1e-9), len(self.a) - 2)
        slope = (self.a[i + 1] - self.a[i]) / self.dt
        a0 = self.a[i] + slope * (t0 - i * self.dt)
        w, w_dot = theta - side * self.alpha - a0, speed - slope

        def at(t):
            x = self.p * (t - t0)
            cosh, sinh = np.cosh(x), np.sinh(x)
            angle = w * cosh + w_dot / self.p * sinh + side * self.alpha + a0 + slope * (t - t0)
            return angle, w * self.p * sinh + w_dot * cosh + slope

        return at, (i + 1) * self.dt

    def lifts(self):
        """From full contact: the time of the uplift, and the side about which it turns."""
        sample = next(i for i, a in enumerate(np.abs(self.a)) if a > self.alpha)
        before, after = self.a[sample - 1 : sample + 1]
        side = -int(np.sign(after))
        uplift = self.dt * (sample - 1 + (-side * self.alpha - before) / (after - before))
        return uplift, side

    def follow(self, end, t, side, theta=0.0):
        """From rest at a time on a side: impact times (n,), state at `end`."""
        speed, impacts = 0.0, []
        while t < end:
            at, stop = self.piece(t, side, theta, speed)
            stop = min(stop, end)
            grid = np.linspace(t, stop, 200)[1:]
            inside = side * at(grid)[0] > 0
            if inside.all():
                (theta, speed), t = at(stop), stop
                continue
            k = int(np.argmin(inside))
            low = grid[k - 1] if k else t + 1e-9 * (stop - t)
            t = brentq(lambda x, at=at: at(x)[0], low, grid[k], xtol=1e-15)
            impacts.append(t)
            theta, speed, side = 0.0, self.e * at(t)[1], -side
        return np.array(impacts), (theta, speed)


def first(n, series):
    return np.array(list(itertools.islice(series, n)))


class SlenderBlockUnderSine:
    """Slender block on one edge after the other under A sin(omega t), to mpmath's precision.

    theta'' = p^2 (theta - s alpha - a/g) with p^2 = m g R/(I + m R^2). A motion of it is
    s alpha + c a/g with c = p^2/(p^2 + omega^2); what is added to it goes with cosh and sinh.
    """

    def __init__(
        self, *, mass, radius, alpha, inertia, gravity, theta, theta_dot, e, amplitude, period,
        duration,
    ):  # fmt: skip
        self.p = mp.sqrt(mass * gravity * radius / (inertia + mass * radius**2))
        self.alpha, self.e, self.omega = alpha, e, 2 * mp.pi / period
        self.size = amplitude / gravity * self.p**2 / (self.p**2 + self.omega**2)
        self.start, self.end = (theta, theta_dot), duration

    def flight(self, t0, side, theta, theta_dot):
        """theta and theta' as functions of time, of the motion that has these at t0."""
        p, omega, lean = self.p, self.omega, side * self.alpha
        w = theta - lean - self.size * mp.sin(omega * t0)
        w_dot = theta_dot - self.size * omega * mp.cos(omega * t0)

        def angle(t):
            x = p * (t - t0)
            added = w * mp.cosh(x) + w_dot / p * mp.sinh(x)
            return added + lean + self.size * mp.sin(omega * t)

        def rate(t):
            x = p * (t - t0)
            added = w * p * mp.sinh(x) + w_dot * mp.cosh(x)
            return added + self.size * omega * mp.cos(omega * t)

        return angle, rate

    def follow(self, near):
        """Impact times (k,), states (k, 2) before and after each, state (2,) at the end.

        near (k,) : about where the impacts are; Newton's method finds them from there.
        """
        t, side, state = mp.mpf(0), 1 if self.start[0] > 0 else -1, self.start
        times, before, after = [], [], []
        for guess in near:
            angle, rate = self.flight(t, side, *state)
            t = mp.mpf(guess)
            while abs(move := angle(t) / rate(t)) > mp.eps * 1e3:
                t -= move
            times.append(t)
            before.append((mp.mpf(0), rate(t)))
            side, state = -side, (mp.mpf(0), self.e * rate(t))
            after.append(state)
        angle, rate = self.flight(t, side, *state)
        return times, before, after, (angle(self.end), rate(self.end))


def slender_derivatives(values, near):
    """Derivatives of `SlenderBlockUnderSine.follow` by each of its numbers, the last axis.

    Differences over a step of 1e-15 in fifty digits are exact to thirty.
    """
    with mp.workdps(50):
        given = {name: mp.mpf(value) for name, value in values.items()}

        def moved(name, part):
            changed = given | {name: given[name] * (1 + part)}
            return [np.array(f) for f in SlenderBlockUnderSine(**changed).follow(near)]

        step = mp.mpf(10) ** -15
        columns = [
            [(a - b) / (2 * step * given[name]) for a, b in zip(*pair, strict=True)]
            for name in given
            for pair in [(moved(name, step), moved(name, -step))]
        ]
        names = ("event_times", "before", "after", "end")
        stacked = (np.stack(rows, axis=-1).astype(float) for rows in zip(*columns, strict=True))
        return dict(zip(names, stacked, strict=True))
