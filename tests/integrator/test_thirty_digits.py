"""Impact times against arithmetic with forty digits, at the tightest tolerances."""

import functools
import itertools
from decimal import Decimal, localcontext

import mpmath as mp
import numpy as np
import pytest

import rockeom as rk
from tests.typical import DAMPING, S1, STIFFNESS

GRAVITY = 9.81


@pytest.fixture(autouse=True)
def forty_digits():
    with mp.workdps(40), localcontext(prec=40):
        yield


@functools.cache  # both methods are compared with the same
def free_impacts(half_width, half_height, release, e, count):
    """Of the non-linear block from rest at `release`: energy is constant in flight.

    With psi = alpha - theta, psi'^2 = 4 p^2 sin((psi + psi_0)/2) sin((psi - psi_0)/2).
    """
    width, height = mp.mpf(half_width), mp.mpf(half_height)
    alpha, radius = mp.atan2(width, height), mp.hypot(width, height)
    p = mp.sqrt(3 * mp.mpf(GRAVITY) / (4 * radius))

    def quarter(top):
        def slowness(psi):
            return 1 / mp.sqrt(4 * mp.sin((psi + top) / 2) * mp.sin((psi - top) / 2))

        return mp.quad(slowness, [top, alpha]) / p  # tanh-sinh: the root at `top` does no harm

    top = alpha - mp.mpf(release)
    times = [quarter(top)]
    while len(times) < count:
        top = mp.acos(mp.cos(alpha) + (mp.cos(top) - mp.cos(alpha)) * mp.mpf(e) ** 2)
        times.append(times[-1] + 2 * quarter(top))
    return times


@pytest.mark.parametrize("method", ["DOP853", "RK45"])
def test_free_decay_of_the_block(method):
    """A block 0.19 x 0.90 m from 0.9 alpha: twenty impacts."""
    block = rk.RigidBlock(half_width=0.095, half_height=0.45, gravity=GRAVITY)
    release, e = 0.9 * block.alpha, 0.93
    run = rk.simulate(
        block,
        rk.GroundMotion.none(12.0),
        impact=rk.VelocityRatio(e),
        initial={"theta": release},
        options=rk.SolverOptions(method=method, rtol=1e-14, atol=1e-17),
    )
    exact = free_impacts(0.095, 0.45, release, e, 20)
    errors = [abs(i.time - t) for i, t in zip(run.impacts, exact, strict=False)]
    assert len(errors) == 20
    assert max(errors) < 1e-12


def shaken_impacts(p, alpha, e, samples, dt, theta):
    """Of the slender block released at `theta` > 0 under a record linear between its samples.

    w = theta - s alpha - a/g obeys w'' = p^2 w in each piece: cosh and sinh.
    """
    p, alpha, e, dt = (mp.mpf(v) for v in (p, alpha, e, dt))
    a = [mp.mpf(v) / mp.mpf(GRAVITY) for v in samples]
    impacts, t, speed, side, theta = [], mp.mpf(0), mp.mpf(0), 1, mp.mpf(theta)
    while t < dt * (len(a) - 1):
        n = int(mp.floor(t / dt + mp.mpf(10) ** -30))
        slope = (a[n + 1] - a[n]) / dt
        now = a[n] + slope * (t - n * dt)
        w, w_dot = theta - side * alpha - now, speed - slope

        def angle(x, w=w, w_dot=w_dot, now=now, slope=slope, side=side):
            turned = w * mp.cosh(p * x) + w_dot / p * mp.sinh(p * x)
            return turned + side * alpha + now + slope * x

        length = (n + 1) * dt - t
        grid = [length * k / 50 for k in range(1, 51)]
        crossed = next((k for k, x in enumerate(grid) if side * angle(x) <= 0), None)
        if crossed is not None:
            low = grid[crossed - 1] if crossed else grid[0] / 1000
            length = mp.findroot(angle, (low, grid[crossed]), solver="anderson")
        theta = angle(length)
        speed = w * p * mp.sinh(p * length) + w_dot * mp.cosh(p * length) + slope
        t += length
        if crossed is not None:
            impacts.append(t)
            theta, speed, side = mp.mpf(0), e * speed, -side
    return impacts


def test_slender_block_under_a_record():
    p, alpha, e, dt = 2.0, 0.25, 0.9, 0.125
    samples = 0.1 * GRAVITY * np.sin(np.arange(25) ** 1.3)
    run = rk.simulate(
        rk.SlenderBlock.from_frequency(p=p, alpha=alpha, gravity=GRAVITY),
        rk.GroundMotion.from_array(samples, dt),
        impact=rk.VelocityRatio(e),
        initial={"theta": 0.05},
        options=rk.SolverOptions(rtol=1e-14, atol=1e-17),
    )
    exact = shaken_impacts(p, alpha, e, samples, dt, 0.05)
    assert len(exact) >= 4
    assert len(run.impacts) == len(exact)
    errors = [abs(i.time - t) for i, t in zip(run.impacts, exact, strict=True)]
    assert max(errors) < 1e-12


# -- the flexible column: extrapolation of Gragg's rule to order 24, in decimals, which are fast

COLUMN = S1 | {"stiffness": STIFFNESS, "damping": DAMPING}


def sine_cosine(angle):
    """Of a small angle, by their series."""
    terms = [Decimal(1)]
    while abs(terms[-1]) > Decimal("1e-42"):
        terms.append(terms[-1] * angle / len(terms))
    return sum(terms[1::4]) - sum(terms[3::4]), sum(terms[0::4]) - sum(terms[2::4])


def root(function, start):
    """Where a function of a decimal is zero, between two places or near them."""
    found = mp.findroot(lambda x: in_binary(function(in_decimals(x))), start, solver="anderson")
    return in_decimals(found)


def in_decimals(x):
    return Decimal(mp.nstr(x, 40))


def in_binary(x):
    return mp.mpf(str(x))


class Column:
    """Newton's laws for the two masses, written in axes that turn with the base about a foot.

    A point (x, y) of these axes has the acceleration (x'' + theta'' y - theta'^2 x,
    -2 theta' x' - theta'' x - theta'^2 y). States are theta, u, theta', u'; `side` is 1 on the
    right foot, -1 on the left one and 0 on both.
    """

    def __init__(self, gravity=GRAVITY):
        value = {name: Decimal(v) for name, v in COLUMN.items()}
        self.m, self.m_b = value["mass"], value["base_mass"]
        self.y, self.y_b, self.width = value["height"], value["base_height"], value["half_width"]
        self.k, self.c, self.g = value["stiffness"], value["damping"], Decimal(gravity)
        self.inertia = value["inertia"] + value["base_inertia"]

    def moment(self, x, x_b, before, before_b):
        """Angular momentum about a foot at unit rate of rotation about the foot of `before`."""
        mass = self.m * x * before
        return mass + self.m_b * (x_b * before_b + self.y_b**2) + self.inertia

    def rates(self, side, a, state):
        theta, u, theta_dot, u_dot = state
        spring = self.k * u + self.c * u_dot
        if side == 0:
            return [Decimal(0), u_dot, Decimal(0), -a - spring / self.m]
        sine, cosine = sine_cosine(theta)
        along, across = self.g * sine - a * cosine, -self.g * cosine - a * sine
        x, x_b = u - side * self.width, -side * self.width
        theta_ddot = (
            self.y * spring
            - self.m * x * (theta_dot**2 * self.y + 2 * theta_dot * u_dot + across)
            + self.m_b * (along * self.y_b - across * x_b)
        ) / self.moment(x, x_b, x, x_b)
        u_ddot = along + theta_dot**2 * x - spring / self.m - theta_ddot * self.y
        return [theta_dot, u_dot, theta_ddot, u_ddot]

    def impulse(self, side, state):
        """After landing from `side` on the other foot, whose impulse has no moment about it.

        Nor does an impulse act on the mass along the base.
        """
        _, u, theta_dot, u_dot = state
        old, new, b = u - side * self.width, u + side * self.width, side * self.width
        after = theta_dot * self.moment(new, b, old, -b) / self.moment(new, b, new, b)
        return after, u_dot + self.y * (theta_dot - after)


def extrapolated(rates, t, state, h):
    """State after a step h: the error of Gragg's rule has even powers of 1/n alone."""
    rows, counts = [], range(2, 26, 2)
    for j, n in enumerate(counts):
        step = h / n
        last = state
        now = [y + step * r for y, r in zip(state, rates(t, state), strict=True)]
        for i in range(1, n):
            slope = rates(t + i * step, now)
            last, now = now, [y + 2 * step * r for y, r in zip(last, slope, strict=True)]
        row = [now]
        for i in range(j):
            factor = (Decimal(n) / counts[j - 1 - i]) ** 2 - 1
            pairs = zip(row[i], rows[-1][i], strict=True)
            row.append([new + (new - old) / factor for new, old in pairs])
        rows.append(row)
    return rows[-1][-1]


def cut_at_event(column, ground, side, t, state, step):
    """(step, state, foot): cut where the gap closes or a foot (1 or -1) lifts, else foot is 0."""

    def at(h):
        return extrapolated(lambda t, y: column.rates(side, ground(t), y), t, state, h)

    def opening(foot, h, later):
        return foot * column.rates(foot, ground(t + h), later)[2]

    later = at(step)
    if side:
        if side * later[0] > 0:
            return step, later, 0
        event = -side
        step = root(lambda h: at(h)[0], (in_binary(step / 1000), in_binary(step)))
    else:
        event = next((foot for foot in (-1, 1) if opening(foot, step, later) > 0), 0)
        if not event:
            return step, later, 0
        step = root(lambda h: opening(event, h, at(h)), (mp.mpf(0), in_binary(step)))
    return step, at(step), event


def column_impacts(column, land, samples, dt, state, side, count):
    """Times and rates before each impact, under a record linear between its samples.

    land(side, state) gives the rates theta', u' after an impact. Steps of 5 ms leave an error of
    1e-30: shorter ones change nothing more.
    """
    state, found, t, dt = [Decimal(v) for v in state], [], Decimal(0), Decimal(dt)
    for n, (a, b) in enumerate(itertools.pairwise(Decimal(v) for v in samples)):

        def ground(t, a=a, b=b, n=n):
            return a + (b - a) * (t / dt - n)

        while t < (n + 1) * dt and len(found) < count:
            step = min(Decimal(5) / 1000, (n + 1) * dt - t)
            step, state, foot = cut_at_event(column, ground, side, t, state, step)
            t += step
            if foot and side:
                found.append((t, *state[2:]))
                after = land(side, state)
                assert after[0] * state[2] > 0  # it goes on to the other side
                state = [Decimal(0), state[1], *after]
            side = foot or side
    return found


def check_column(law, land, samples, dt, start):
    """Three impacts by the law as `land` does it, from a rotation at rest."""
    column = Column()
    exact = column_impacts(
        column, lambda *at: land(column, *at), samples, dt, [start, 0, 0, 0], int(start > 0), 3
    )
    run = rk.simulate(
        rk.FlexibleStructure(**COLUMN, gravity=GRAVITY),
        rk.GroundMotion.from_array(samples, dt),
        impact=law,
        initial={"theta": start},
        options=rk.SolverOptions(rtol=1e-14, atol=1e-17),
    )
    assert len(exact) == 3
    for impact, (time, theta_dot, u_dot) in zip(run.impacts[:3], exact, strict=True):
        assert abs(Decimal(impact.time) - time) < 1e-12
        assert abs(Decimal(impact.before["theta_dot"]) - theta_dot) < 1e-12
        assert abs(Decimal(impact.before["u_dot"]) - u_dot) < 1e-11


def test_flexible_column_released():
    """From rest at 0.05 rad, straight: three impacts by the impulsive law."""
    check_column(rk.Impulsive(), Column.impulse, [0.0, 0.0], dt=1.0, start=0.05)


def test_flexible_column_under_a_record():
    """From full contact through the uplift: three impacts that leave u' as it is."""
    samples, ratio = 5.0 * np.sin(1.3 * np.arange(13)), 0.9
    check_column(
        rk.VelocityRatio(ratio),
        lambda column, side, y: (Decimal(ratio) * y[2], y[3]),
        samples, dt=0.1, start=0.0,
    )  # fmt: skip
