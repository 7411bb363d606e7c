"""Impact times against arithmetic with forty digits, at the tightest tolerances."""

import itertools
from decimal import Decimal, localcontext

import mpmath as mp
import numpy as np
import pytest

import rockeom as rk
from benchmarks.reference_cases.independent import free_rocking
from tests.typical import DAMPING, S1, STIFFNESS

GRAVITY = 9.81


@pytest.fixture(autouse=True)
def forty_digits():
    with mp.workdps(40), localcontext(prec=40):
        yield


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
    width, height = mp.mpf(0.095), mp.mpf(0.45)
    p = mp.sqrt(3 * mp.mpf(GRAVITY) / (4 * mp.hypot(width, height)))
    exact, _ = free_rocking(mp.atan2(width, height), p, mp.mpf(e), mp.mpf(release), 20)
    errors = [abs(i.time - t) for i, t in zip(run.impacts, exact, strict=False)]
    assert len(errors) == 20
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
    place = mp.findroot(lambda x: in_binary(function(in_decimals(x))), start, solver="anderson")
    return in_decimals(place)


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


def column_impacts(column, ratio, samples, dt, count):
    """Times and rates before each impact, from rest under a record linear between its samples.

    Steps of 5 ms leave an error of 1e-30: shorter ones change nothing more.
    """
    state, side, impacts, t, dt = [Decimal(0)] * 4, 0, [], Decimal(0), Decimal(dt)
    for n, (a, b) in enumerate(itertools.pairwise(Decimal(v) for v in samples)):

        def ground(t, a=a, b=b, n=n):
            return a + (b - a) * (t / dt - n)

        while t < (n + 1) * dt and len(impacts) < count:
            step = min(Decimal(5) / 1000, (n + 1) * dt - t)
            step, state, foot = cut_at_event(column, ground, side, t, state, step)
            t += step
            if foot and side:
                impacts.append((t, *state[2:]))
                state = [Decimal(0), state[1], Decimal(ratio) * state[2], state[3]]
            side = foot or side
    return impacts


def test_flexible_column_under_a_record():
    """From full contact through the uplift: three impacts that leave u' as it is.

    The reference cases have the released column, by the impulsive law.
    """
    samples, ratio, dt = 5.0 * np.sin(1.3 * np.arange(13)), 0.9, 0.1
    exact = column_impacts(Column(), ratio, samples, dt, 3)
    run = rk.simulate(
        rk.FlexibleStructure(**COLUMN, gravity=GRAVITY),
        rk.GroundMotion.from_array(samples, dt),
        impact=rk.VelocityRatio(ratio),
        options=rk.SolverOptions(rtol=1e-14, atol=1e-17),
    )
    assert len(exact) == 3
    for impact, (time, theta_dot, u_dot) in zip(run.impacts[:3], exact, strict=True):
        assert abs(Decimal(impact.time) - time) < 1e-12
        assert abs(Decimal(impact.before["theta_dot"]) - theta_dot) < 1e-12
        assert abs(Decimal(impact.before["u_dot"]) - u_dot) < 1e-11
