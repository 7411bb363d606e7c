"""References of 30 digits, by means that share nothing with the integrator.

W1 is exact: quarter periods by quadrature, energies between impacts. The other motions are Taylor
series of high order in arithmetic of 36 digits, from equations of motion that were derived by hand;
roots are isolated by bounds on the series, then found by Newton's method. The endless impacts
before a rest are followed until 1e-18 s are left of them. The same series reproduce W1.

    python -m benchmarks.reference     writes benchmarks/reference.json
"""

import json
import sys
import time
from dataclasses import dataclass, field

import mpmath
import numpy as np
from mpmath import mp, mpf

from benchmarks import workloads as w

DIGITS = 36
mp.dps = DIGITS
STEP_ERROR = mpf(10) ** -34
REST = mpf(10) ** -18
ZERO = mpf(0)

Series = list  # of mpf, by powers of time

QUIET = np.array([[0.0, 1e4, 0.0, 0.0, 0.0, 0.0, 0.0]])
"""Ground that stands still, as a motion's table."""


def product(a: Series, b: Series, k: int) -> mpf:
    """Coefficient k of a b."""
    return mp.fdot(zip(a[: k + 1], b[k::-1], strict=True))


def rate(a: Series) -> Series:
    return [j * c for j, c in enumerate(a)][1:]


def at(a: Series, x: mpf) -> mpf:
    return mp.polyval(a[::-1], x)


# -- W1: quadrature and energy -------------------------------------------------------------------


def free_decay(p: mpf, alpha: mpf, ratio: mpf, peak: mpf, n: int) -> tuple[list, list]:
    """Times and rates of n impacts of theta'' = -p^2 sin(alpha - theta), from rest at a peak."""
    t, side, times, rates = ZERO, 1, [], []

    def quarter(peak: mpf) -> mpf:
        # theta = peak - u^2 takes the singularity of the turning point away
        def integrand(u: mpf) -> mpf:
            x = u * u / 2
            ratio = mpmath.sqrt(x / mpmath.sin(x)) if x else mpf(1)
            return mpmath.sqrt(2) * ratio / (p * mpmath.sqrt(mpmath.sin(alpha - peak + x)))

        return mp.quad(integrand, mp.linspace(0, mpmath.sqrt(peak), 5))

    for _ in range(n):
        reach = quarter(peak)
        t += reach
        speed = 2 * p * mpmath.sqrt(mpmath.sin(alpha - peak / 2) * mpmath.sin(peak / 2))
        times.append(t)
        rates.append(-side * speed)
        energy = (ratio * speed) ** 2 / 2  # = p^2 (cos(alpha - peak) - cos(alpha))
        peak = alpha - mpmath.acos(energy / p**2 + mpmath.cos(alpha))
        t += quarter(peak)
        side = -side
    return times, rates


# -- structures as series ------------------------------------------------------------------------


@dataclass
class Block:
    """theta'' = -p^2 (s sin(alpha - s theta) + a/g cos(alpha - s theta)): thesis 2-9."""

    p2: mpf
    alpha: mpf
    gravity: mpf
    ratio: mpf
    order: int = 24
    rate_at: int = 1

    @property
    def longest(self) -> mpf:
        """Longest step: short enough for one turning point at most."""
        return 1 / (5 * mpmath.sqrt(self.p2))

    def rocking(self, s: int, y: list, a: Series) -> list[Series]:
        n = self.order
        theta = [y[0], y[1]]
        angle = self.alpha - s * y[0]
        sine, cosine = [mpmath.sin(angle)], [mpmath.cos(angle)]
        turn = [-s * y[1]]  # rate of the angle, alpha - s theta
        for k in range(n - 1):
            pull = s * sine[k] + product(a, cosine, k) / self.gravity
            theta.append(-self.p2 * pull / ((k + 1) * (k + 2)))
            sine.append(product(turn, cosine, k) / (k + 1))
            cosine.append(-product(turn, sine, k) / (k + 1))
            turn.append(-s * (k + 2) * theta[k + 2])
        return [theta, rate(theta)]

    def upright(self, y: list, a: Series) -> list[Series]:
        zero = [ZERO] * (self.order + 1)
        return [zero, zero]

    def opening(self, s: int, states: list[Series], a: Series) -> Series:
        """A multiple of the acceleration with which side s opens, positive if it does."""
        sine, cosine = mpmath.sin(self.alpha), mpmath.cos(self.alpha)
        return [-s * c * cosine / self.gravity - (sine if k == 0 else 0) for k, c in enumerate(a)]

    def closing(self, s: int, y: list, a: mpf) -> mpf:
        return self.p2 * (mpmath.sin(self.alpha) + s * a * mpmath.cos(self.alpha) / self.gravity)


class Column:
    """The two masses in axes that turn with the base; see benchmarks/c/flexible_structure.c."""

    order, rate_at, longest = 30, 2, mpf(1) / 20

    def __init__(self, values: dict[str, float]) -> None:
        v = {name: mpf(value) for name, value in values.items()}
        self.m, self.H, self.B, self.g = v["mass"], v["height"], v["half_width"], v["gravity"]
        m_b, H_b = v["base_mass"], v["base_height"]
        self.m_b = m_b
        self.J = v["inertia"] + v["base_inertia"] + m_b * (H_b**2 + self.B**2)
        self.S = self.m * self.H + m_b * H_b
        self.k, self.c = v["stiffness"] / self.m, v["damping"] / self.m
        # angular momentum of the rigid structure about the new foot: thesis 5-14
        inertia = self.J + self.m * self.H**2 - m_b * self.B**2
        B2 = (self.m + m_b) * self.B**2
        self.ratio = (inertia - B2) / (inertia + B2)

    def rocking(self, s: int, y: list, a: Series) -> list[Series]:
        theta, u, theta_dot, u_dot = ([c] for c in y)
        sine, cosine = [mpmath.sin(y[0])], [mpmath.cos(y[0])]
        beside = [y[1] - s * self.B]
        across, square, swing, inertia, theta_ddot = [], [], [], [], []
        for k in range(self.order):
            along = self.g * sine[k] - product(a, cosine, k)
            across.append(self.g * cosine[k] + product(a, sine, k))
            square.append(product(theta_dot, theta_dot, k))
            swing.append(product(u_dot, theta_dot, k))
            F = product(beside, square, k) + along - self.k * u[k] - self.c * u_dot[k]
            offset = [self.m * b for b in beside]
            offset[0] -= s * self.m_b * self.B
            turning = (
                self.S * along
                + product(offset, across, k)
                - 2 * self.m * product(beside, swing, k)
                - self.m * self.H * F
            )
            inertia.append(self.m * product(beside, beside, k) + (self.J if k == 0 else 0))
            # the quotient of two series
            taken = product([*theta_ddot, ZERO], inertia, k)
            theta_ddot.append((turning - taken) / inertia[0])
            u_ddot = F - self.H * theta_ddot[k]
            theta.append(theta_dot[k] / (k + 1))
            u.append(u_dot[k] / (k + 1))
            theta_dot.append(theta_ddot[k] / (k + 1))
            u_dot.append(u_ddot / (k + 1))
            beside.append(u[k + 1])
            sine.append(product(theta_dot, cosine, k) / (k + 1))
            cosine.append(-product(theta_dot, sine, k) / (k + 1))
        return [theta, u, theta_dot, u_dot]

    def upright(self, y: list, a: Series) -> list[Series]:
        u, u_dot = [y[1]], [y[3]]
        for k in range(self.order):
            u.append(u_dot[k] / (k + 1))
            u_dot.append((-a[k] - self.k * u[k] - self.c * u_dot[k]) / (k + 1))
        zero = [ZERO] * (self.order + 1)
        return [zero, u, zero, u_dot]

    def opening(self, s: int, states: list[Series], a: Series) -> Series:
        _, u, _, u_dot = states
        found = []
        for k in range(len(a)):
            offset = self.m * u[k] - (s * (self.m + self.m_b) * self.B if k == 0 else 0)
            F = -a[k] - self.k * u[k] - self.c * u_dot[k]
            found.append(s * (self.g * offset - self.S * a[k] - self.m * self.H * F))
        return found

    def closing(self, s: int, y: list, a: mpf) -> mpf:
        pull = self.opening(s, [[c] for c in y], [a])[0]
        return -pull / (self.J + self.m * (y[1] - s * self.B) ** 2)


# -- roots ---------------------------------------------------------------------------------------


def first_fall(series: Series, h: mpf, closed: int) -> mpf | None:
    """First root in (0, h] of a series that is positive just after 0, with `closed` roots at 0."""
    scaled = [c * h**j for j, c in enumerate(series)][closed:]
    values = np.array([float(c) for c in scaled])
    values = values / np.abs(values).max()
    parts = [(0.0, 1.0)]
    while parts:
        low, high = parts.pop()
        middle, radius = 0.5 * (low + high), 0.5 * (high - low)
        shifted = _shift(values, middle) * radius ** np.arange(len(values))
        size = np.abs(shifted)
        if size[0] > size[1:].sum():
            continue
        if size[1] > (np.arange(2, len(size)) * size[2:]).sum():  # monotonic
            ends = np.polyval(values[::-1], [low, high])
            if not (ends[0] > 0.0 >= ends[1]):
                continue
            x = mpf(middle)
            for _ in range(60):
                step = at(scaled, x) / at(rate(scaled), x)
                x -= step
                if abs(step) < mpf(10) ** -(DIGITS - 2):
                    break
            if 0 < x <= 1:
                return x * h
            continue
        if radius < 1e-12:
            raise ArithmeticError("two roots that cannot be told apart")
        parts += [(middle, high), (low, middle)]
    return None


def _shift(values: np.ndarray, x: float) -> np.ndarray:
    """Coefficients about x, by repeated synthetic division."""
    out = values.copy()
    for i in range(len(out) - 1):
        for j in range(len(out) - 2, i - 1, -1):
            out[j] += x * out[j + 1]
    return out


# -- motions -------------------------------------------------------------------------------------


def ground(row: np.ndarray, t: mpf, n: int) -> Series:
    """Series at t of a row of a motion's table: a line or a sine."""
    start, _, kind, c0, c1, c2, _ = (mpf(float(x)) for x in row)
    tau = t - start
    if kind == 0:
        return [c0 + c1 * tau, c1] + [ZERO] * (n - 1)
    out, factor = [], c0
    for k in range(n + 1):
        out.append(factor * mpmath.sin(c1 * tau + c2 + k * mp.pi / 2))
        factor *= c1 / (k + 1)
    return out


@dataclass
class Motion:
    """What happened: impacts with the rates before them, largest |rotation|, the end."""

    times: list = field(default_factory=list)
    rates: list = field(default_factory=list)
    peak: mpf = ZERO
    fell: bool = False
    side: int = 0
    y: list = field(default_factory=list)


def follow(structure, table: np.ndarray, y: list, side: int, impacts: int | None = None) -> Motion:
    """The motion over a table of ground laws, or until so many impacts."""
    motion = Motion(side=side, y=[mpf(c) for c in y])
    for row in table:
        t, end = mpf(float(row[0])), mpf(float(row[1]))
        while t < end:
            t = _advance(structure, row, t, end, motion)
            if motion.fell or len(motion.times) == impacts:
                return motion
    return motion


def _advance(structure, row: np.ndarray, t: mpf, end: mpf, motion: Motion) -> mpf:
    """One step, to its event if there is one; changes the motion, returns the time reached."""
    n, s, y, v = structure.order, motion.side, motion.y, structure.rate_at
    a = ground(row, t, n)
    states = structure.rocking(s, y, a) if s else structure.upright(y, a)
    h = min(end - t, structure.longest)
    last = max(abs(c) for series in [*states, a] for c in series[n - 1 : n + 1])
    if last:
        h = min(h, (STEP_ERROR / last) ** (mpf(1) / n))

    if s == 0:
        falls = []
        for side in (-1, 1):
            guard = [-c for c in structure.opening(side, states, a)]
            if guard[0] < 0:
                falls.append((ZERO, side))
            elif (x := first_fall(guard, h, 0)) is not None:
                falls.append((x, side))
        if falls:
            h, motion.side = min(falls)
        motion.y = [at(state, h) for state in states]
        return t + h

    gap = [s * c for c in states[0]]
    closed = 0
    while closed < 3 and abs(gap[closed]) * h**closed < mpf(10) ** -28 * max(
        abs(c) * h**j for j, c in enumerate(gap)
    ):
        closed += 1
    x = first_fall(gap, h, closed)
    if x is not None:
        h = x
    motion.y = [at(state, h) for state in states]
    if (y[v] > 0) != (motion.y[v] > 0):
        speed = states[v] if y[v] > 0 else [-c for c in states[v]]
        crest = first_fall(speed, h, 0) if y[v] != 0 else None
        if crest is not None:
            motion.peak = max(motion.peak, abs(at(states[0], crest)))
    motion.peak = max(motion.peak, abs(motion.y[0]))
    motion.fell = abs(motion.y[0]) >= mp.pi / 2
    if x is not None:
        _impact(structure, row, t + h, motion)
    return t + h


def _impact(structure, row: np.ndarray, t: mpf, motion: Motion) -> None:
    v = structure.rate_at
    motion.times.append(t)
    motion.rates.append(motion.y[v])
    motion.y[0] = ZERO
    motion.y[v] *= structure.ratio
    motion.side = -motion.side
    closing = structure.closing(motion.side, motion.y, ground(row, t, 0)[0])
    if closing > 0 and 2 * abs(motion.y[v]) / (closing * (1 - structure.ratio)) < REST:
        motion.y[v] = ZERO
        motion.side = 0


# -- the workloads -------------------------------------------------------------------------------


def block() -> Block:
    B, H, g = mpf(w.BLOCK.half_width), mpf(w.BLOCK.half_height), mpf(w.BLOCK.gravity)
    alpha, R = mpmath.atan(B / H), mpmath.hypot(B, H)
    return Block(3 * g / (4 * R), alpha, g, 1 - mpf(3) / 2 * mpmath.sin(alpha) ** 2)


def driven_block() -> Block:
    return Block(mpf(1), mpf(w.DRIVEN.alpha), mpf(1), mpf(w.DRIVEN_RATIO))


def text(values: list) -> list[str]:
    return [mpmath.nstr(x, 30) for x in values]


def free_decay_of_the_block() -> dict:
    b = block()
    peak = mpf(float(w.RELEASE))
    times, rates = free_decay(mpmath.sqrt(b.p2), b.alpha, b.ratio, peak, w.N_IMPACTS)
    by_series = follow(b, QUIET, [peak, 0], 1, w.N_IMPACTS)
    worst = max(abs(x - y) for x, y in zip(times, by_series.times, strict=True))
    if worst > mpf(10) ** -29:
        raise ArithmeticError(f"quadrature and series differ by {mpmath.nstr(worst, 3)} s")
    return {"times": text(times), "rates": text(rates)}


def under_the_record(structure: Block | Column, n: int, least: float) -> dict:
    motion = follow(structure, w.record().segments, [0] * n, 0)
    firm = [i for i, v in enumerate(motion.rates) if abs(v) > least]
    return {
        "times": text([motion.times[i] for i in firm]),
        "rates": text([motion.rates[i] for i in firm]),
        "impacts": len(motion.times),
        "peak": text([motion.peak])[0],
        "final": text(motion.y),
    }


def peaks_under_pulses() -> dict:
    b = block()
    peaks: list[str | None] = []
    for pulse in w.pulses(w.PULSE_STRIDE):
        motion = follow(b, pulse.segments, [0, 0], 0)
        # what still rocks at the end falls, or comes back to an impact
        fell = motion.fell or (motion.side and follow(b, QUIET, motion.y, motion.side, 1).fell)
        peaks.append(None if fell else text([motion.peak])[0])
    return {"peaks": peaks}


def cycles_of_the_driven_block() -> dict:
    """The speeds at the crossings of one period of the motion, the last one last."""
    structure = driven_block()
    cycles = {}
    for amplitude in w.REFERENCE_AMPLITUDES:
        motion = follow(structure, w.shaking(amplitude).segments, [0, 0], 0)
        speeds = [v / structure.alpha for v in motion.rates]
        period = next(n for n in range(2, 99, 2) if abs(speeds[-1] - speeds[-1 - n]) < 1e-12)
        cycles[repr(float(amplitude))] = text(speeds[-period:])
    return {"cycles": cycles}


REFERENCES = {
    "W1": free_decay_of_the_block,
    "W2": lambda: under_the_record(block(), 2, w.FIRM["W2"]),
    "W3": lambda: under_the_record(Column(w.COLUMN.parameters()), 4, w.FIRM["W3"]),
    "W4": peaks_under_pulses,
    "W5": cycles_of_the_driven_block,
}


def main() -> None:
    known = json.loads(w.REFERENCE.read_text("utf-8")) if w.REFERENCE.exists() else {}
    for name in sys.argv[1:] or w.WORKLOADS:
        started = time.perf_counter()
        known[name] = REFERENCES[name]()
        print(f"{name}: {time.perf_counter() - started:.0f} s", flush=True)
        w.REFERENCE.write_text(json.dumps(known, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
