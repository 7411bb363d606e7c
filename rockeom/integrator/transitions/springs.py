"""The impact of points that touch by springs: the law of Liu, Zhao and Brogliato."""

import math
from typing import NamedTuple

import numpy as np

from rockeom.codes import NEVER_SLIPS
from rockeom.compiler.decorators import Floats, inlined
from rockeom.integrator.provided import N_POINTS
from rockeom.integrator.tolerances import (
    LEAST_SIZE,
    MORE_THAN_HELD,
    NOTHING_LEFT,
    SETTLED_SPRINGS,
    SOON,
    SPRING_ROUNDING,
)
from rockeom.integrator.transitions.friction import (
    choose,
    forces_with,
    friction_on_line,
    lines_of,
    slips_now,
)
from rockeom.integrator.transitions.points import COUPLING, LAWS, ROWS

__fused__ = False

ORDER = 14  # of the power series of springs
TERMS = ORDER + 1
PART = 0.5  # of a step of springs, times their highest frequency: 0.5**15 / 15! is no error
SAMPLES = 4  # in a step, between which a change of sign is looked for
MOST_STEPS = 200000  # of springs
# Curves that may fall through zero as springs move, of each point
RATE, FORCE, HELD, EASES, SLIP, MORE, LESS = range(7)


class Springs(NamedTuple):
    """Springs at points (N_POINTS,): stiffness, force, and what it grows by, see `grow`.

    loads : stiffness now, 0 where a point does not press. opens : -1 where its gap closes, else 1.
    size : of forces. omega : of frequencies. spread, pull (ROWS * N_POINTS) : all forces, and rates
    of change, by the force of each spring.
    """

    stiffness: Floats
    force: Floats
    loads: Floats
    opens: Floats
    size: float
    omega: float
    spread: Floats
    pull: Floats


def grow(m, stiffness, whole, contact):
    """Springs between the points that touch, until none presses; whether that comes to an end.

    In the time of the impact F' = -k v at a point whose gap closes at the rate v < 0, and
    F' = -k v / e**2 where it opens; velocities change by D F. So with E = F**2 / (2 k) of each
    point, dE = -v dP in compression, and dE = -v dP / e**2 in expansion, and

        dP_i / dP_j = F_i / F_j = (k_i / k_j)**(1/2) (E_i / E_j)**(1/2)

    which is the law of Liu, Zhao and Brogliato (Proc. R. Soc. A 464, 2008 and 465, 2009) with
    linear stiffness, eta = 1, and the energetic restitution e: each point gives back e**2 of the
    work that it took. Their law is singular where E_i = E_j = 0. Written in time it is regular: a
    point at rest begins to press as the others push it, which is the branch that carries load. With
    e = 0 the force drops as the gap no longer closes, to the least that keeps it from opening: that
    is a law of its own, not the limit of small e, by which the force would drop as far again.

    The sum of kinetic energy and of E falls by (1 / e**2 - 1) v dP in expansion, and by the work of
    friction; E is zero at both ends. So no impact gains energy.

    stiffness (N_POINTS,) : k, of which ratios count. whole : see `sizes_of`.
    """
    stiffest = quickest = 0.0
    for i in range(N_POINTS):
        if m.near[i] == 1:
            stiffest = max(stiffest, stiffness[i])
            quickest = max(quickest, stiffness[i] * contact[COUPLING + 2 * i * (ROWS + 1)])
    springs = Springs(
        stiffness, np.zeros(N_POINTS), np.zeros(N_POINTS), np.empty(N_POINTS),
        math.sqrt(whole * stiffest) + LEAST_SIZE, math.sqrt(quickest) + LEAST_SIZE,
        np.empty(ROWS * N_POINTS), np.empty(ROWS * N_POINTS),
    )  # fmt: skip
    lines_of(m, contact)
    steps = 0
    while steps < MOST_STEPS:
        if not act_now(m, springs, contact):
            return False
        if not presses(m, springs):
            return True
        spread_out(m, springs, contact)
        steps = move_on(m, springs, steps, contact)
    return False


def presses(m, springs):
    """Whether a point presses, or begins to."""
    some = False
    for i in range(N_POINTS):
        some = some or springs.force[i] > 0.0 or (springs.loads[i] > 0.0 and m.rate[2 * i] < 0.0)
    return some


def act_now(m, springs, contact):
    """Choose the states of points from now on; whether forces fit.

    Points that rest, and those that have come to rest with e = 0, do as the forces a little later
    move them, by which friction is chosen, too.
    """
    force, soon = springs.force, SOON / springs.omega
    for i in range(N_POINTS):
        if abs(m.rate[2 * i]) <= NOTHING_LEFT * m.sizes[2 * i]:
            m.rate[2 * i] = 0.0
        if m.rate[2 * i] >= 0.0 and force[i] <= NOTHING_LEFT * springs.size:
            force[i] = 0.0
        m.acts[i] = 0
    which_act(m, springs, contact)
    for _ in range(4 * N_POINTS):
        for i in range(N_POINTS):
            m.given[i] = m.target[2 * i] = 0.0
            m.most[i] = force[i] if m.holds[i] == 1 else 0.0
            if m.acts[i] == 1 and m.holds[i] == 0:
                m.given[i] = max(force[i] - soon * springs.loads[i] * m.rate[2 * i], 0.0)
        if not choose(m, contact):
            return False
        if not (some_load(m, springs, soon, contact) or some_join(m, springs, contact)):
            break
    for i in range(N_POINTS):
        v = m.rate[2 * i] if m.rate[2 * i] != 0.0 else m.change[2 * i]
        springs.opens[i] = -1.0 if v < 0.0 and m.holds[i] == 0 else 1.0
        if m.holds[i] == 1:
            springs.loads[i] = 0.0
        elif m.acts[i] == 1:
            loads = stiffness_at(v, contact[LAWS + 2 * i], springs.stiffness[i])
            springs.loads[i] = loads if v < 0.0 or force[i] > 0.0 else 0.0
    return True


@inlined
def stiffness_at(v, e, k):
    """The stiffness of a spring that loads, v <= 0, or gives back."""
    return k if not v > 0.0 or e == 0.0 else k / (e * e)


def which_act(m, springs, contact):
    """Which points close, or press, or of `acts` rest and are pushed; and their springs."""
    slips_now(m)
    for i in range(N_POINTS):
        v, e = m.rate[2 * i], contact[LAWS + 2 * i]
        pressed = springs.force[i] > 0.0
        joined = m.acts[i] == 1 and v == 0.0
        acts = m.near[i] == 1 and (v < 0.0 or pressed or joined)
        m.acts[i] = 1 if acts else 0
        m.holds[i] = 1 if acts and v == 0.0 and pressed and e == 0.0 else 0
        springs.loads[i] = stiffness_at(v, e, springs.stiffness[i]) if acts else 0.0


def some_join(m, springs, contact):
    """Whether a point at rest is pushed by the forces, and is to press: it acts from now on."""
    starts = False
    for i in range(N_POINTS):
        if m.near[i] == 1 and m.acts[i] == 0 and m.rate[2 * i] == 0.0 and m.change[2 * i] < 0.0:
            m.acts[i], starts = 1, True
    if starts:
        which_act(m, springs, contact)
    return starts


def some_load(m, springs, soon, contact):
    """Whether a gap that is held with e = 0 closes instead: it would take a force that grows.

    Its point is no longer held then; the force of others that are held is set.
    """
    now, grows, held = np.zeros(N_POINTS), np.zeros(N_POINTS), np.empty(N_POINTS)
    some, closes, least = False, False, SPRING_ROUNDING * springs.size
    for i in range(N_POINTS):
        some = some or m.holds[i] == 1
        if m.acts[i] == 1 and m.holds[i] == 0:
            now[i] = springs.force[i]
            grows[i] = -springs.loads[i] * (m.rate[2 * i] + soon * m.change[2 * i])
    if not some:
        return False
    forces_with(m, now, m.target, contact)
    for i in range(N_POINTS):
        held[i] = m.force[2 * i] if m.unknown[2 * i] == 1 else 0.0
    forces_with(m, grows, m.target, contact)
    for i in range(N_POINTS):
        if m.holds[i] == 0:
            continue
        more = held[i] > (1.0 + MORE_THAN_HELD) * springs.force[i] + least
        rises = m.force[2 * i] > (MORE_THAN_HELD * held[i] + least) * springs.omega
        if more or (m.unknown[2 * i] == 1 and rises):
            m.holds[i], closes = 0, True
        springs.force[i] = min(springs.force[i], max(held[i], 0.0))
    if not closes:
        forces_with(m, m.given, m.target, contact)
    return closes


def spread_out(m, springs, contact):
    """All forces, and rates of change, by the force of each spring."""
    for j in range(N_POINTS):
        for i in range(N_POINTS):
            m.given[i] = 1.0 if i == j and m.holds[i] == 0 and springs.loads[i] > 0.0 else 0.0
        forces_with(m, m.given, m.target, contact)
        for r in range(ROWS):
            springs.spread[r * N_POINTS + j] = m.force[r]
            springs.pull[r * N_POINTS + j] = m.change[r]


def move_on(m, springs, steps, contact):
    """Steps of the springs, up to where a point does something else; the number of steps so far."""
    series = np.empty((N_POINTS + ROWS) * TERMS)
    curves, least = np.empty(7 * N_POINTS * TERMS), np.empty(7 * N_POINTS)
    fastest, event = 0.0, -1
    for i in range(N_POINTS):
        row = 0.0
        for j in range(N_POINTS):
            row += abs(springs.pull[2 * i * N_POINTS + j]) * springs.loads[j]
        fastest = max(fastest, row)
    h = PART / math.sqrt(fastest) if fastest > 0.0 else PART / springs.omega
    limits_of(m, springs, contact, least)
    while event < 0 and steps < MOST_STEPS:
        steps += 1
        series_of(m, springs, series)
        curves_of(m, springs, series, contact, curves)
        event, t = falls_first(h, curves, least)
        put_at(t, m, springs, series)
    point = int((event + 0.5) / 7.0)
    kind = event - 7 * point
    if kind == RATE:
        m.rate[2 * point] = 0.0
    elif kind in (FORCE, HELD):
        springs.force[point] = 0.0
    elif kind == SLIP:
        for i in range(N_POINTS):
            if m.first[i] == point:
                m.rate[2 * i + 1] = 0.0
    return steps


def put_at(t, m, springs, series):
    """Rates, forces and impulses at a time of the power series; what is held stays zero."""
    for r in range(ROWS):
        m.rate[r] = value_at(series, (N_POINTS + r) * TERMS, t)
        for j in range(N_POINTS):
            by = springs.spread[r * N_POINTS + j]
            m.impulse[r] += by * integral_to(series, j * TERMS, t)
    for i in range(N_POINTS):
        springs.force[i] = 0.0
        if m.holds[i] == 0:
            springs.force[i] = max(value_at(series, i * TERMS, t), 0.0)
        elif m.unknown[2 * i] == 1:
            m.rate[2 * i] = 0.0
            for j in range(N_POINTS):
                by = springs.spread[2 * i * N_POINTS + j]
                springs.force[i] += by * value_at(series, j * TERMS, t)
        if m.unknown[2 * m.first[i] + 1] == 1:
            m.rate[2 * i + 1] = 0.0


def series_of(m, springs, series):
    """The power series of the forces of springs, then of all rates, from now on."""
    for j in range(N_POINTS):
        series[j * TERMS] = springs.force[j] if m.holds[j] == 0 else 0.0
    for r in range(ROWS):
        series[(N_POINTS + r) * TERMS] = m.rate[r]
    for k in range(ORDER):
        part = 1.0 / (k + 1.0)
        for j in range(N_POINTS):
            v = series[(N_POINTS + 2 * j) * TERMS + k]
            series[j * TERMS + k + 1] = -part * springs.loads[j] * v
        for r in range(ROWS):
            change = 0.0
            for j in range(N_POINTS):
                change += springs.pull[r * N_POINTS + j] * series[j * TERMS + k]
            series[(N_POINTS + r) * TERMS + k + 1] = part * change


def limits_of(m, springs, contact, least):
    """How far below zero rounding may take each curve of `curves_of`; inf of what is none."""
    for i in range(N_POINTS):
        at, size, holds = 7 * i, springs.size, m.holds[i] == 1 and m.unknown[2 * i] == 1
        for c in range(7):
            least[at + c] = np.inf
        if m.near[i] == 0:
            continue
        if holds:
            least[at + HELD] = SPRING_ROUNDING * size
            least[at + EASES] = SPRING_ROUNDING * size * springs.omega
        else:
            least[at + RATE] = SPRING_ROUNDING * m.sizes[2 * i]
        if springs.loads[i] > 0.0 and springs.opens[i] > 0.0:
            least[at + FORCE] = SPRING_ROUNDING * size
        if m.first[i] == i and m.sigma[i] != 0.0:
            least[at + SLIP] = SPRING_ROUNDING * m.sizes[2 * i + 1]
        elif m.unknown[2 * i + 1] == 1 and friction_on_line(i, m, contact) < NEVER_SLIPS:
            least[at + MORE] = least[at + LESS] = SPRING_ROUNDING * size


def curves_of(m, springs, series, contact, curves):
    """The power series of what ends a mode as it falls below zero.

    They are of each point: how fast its gap closes still, or opens; its force; that which holds its
    gap, and how fast that falls; its slip; the friction that it could have on either side.
    """
    for i in range(N_POINTS):
        for k in range(TERMS):
            at, force = 7 * i * TERMS + k, springs_at(2 * i, springs, series, k)
            friction, bound, eases = springs_at(2 * i + 1, springs, series, k), 0.0, 0.0
            for j in range(N_POINTS):
                by = springs.spread[2 * i * N_POINTS + j]
                eases += by * springs.loads[j] * series[(N_POINTS + 2 * j) * TERMS + k]
                if m.first[j] == i and contact[LAWS + 2 * j + 1] < NEVER_SLIPS:
                    bound += contact[LAWS + 2 * j + 1] * springs_at(2 * j, springs, series, k)
            curves[at + RATE * TERMS] = springs.opens[i] * series[(N_POINTS + 2 * i) * TERMS + k]
            curves[at + FORCE * TERMS] = series[i * TERMS + k]
            curves[at + HELD * TERMS] = force
            curves[at + EASES * TERMS] = eases
            curves[at + SLIP * TERMS] = m.sigma[i] * series[(N_POINTS + 2 * i + 1) * TERMS + k]
            curves[at + MORE * TERMS] = bound - friction
            curves[at + LESS * TERMS] = bound + friction


def springs_at(row, springs, series, k):
    """The k-th term of the force of a row, by those of the springs."""
    total = 0.0
    for j in range(N_POINTS):
        total += springs.spread[row * N_POINTS + j] * series[j * TERMS + k]
    return total


def falls_first(h, curves, least):
    """(curve, time) of the first curve that falls below zero in a step h; (-1, h): none does."""
    event, first = -1, h
    for c in range(7 * N_POINTS):
        if not least[c] < np.inf:
            continue
        at, before, then, fell = (
            c * TERMS,
            0.0,
            curves[c * TERMS],
            slope_of_series(curves, c * TERMS, 0.0),
        )
        for i in range(SAMPLES + 1):
            t = h * (i / SAMPLES) if i > 0 else SOON * h
            now, rises = value_at(curves, at, t), slope_of_series(curves, at, t)
            if now >= -least[c] and fell < 0.0 < rises:  # it may dip below zero between the two
                lowest = turn_between(curves, at, before, t)
                now = min(now, value_at(curves, at, lowest))
                t = lowest if now < -least[c] else t
            if now < -least[c]:
                where = before if i > 0 else t
                if then > 0.0:
                    where = root_between(curves, at, before, t)
                if where < first:
                    event, first = c, where
                break
            before, then, fell = t, now, rises
    return event, first


def turn_between(curves, at, low, high):
    """Where a curve is lowest between two times, at which it falls, and rises."""
    falls, rises = low, high
    for _ in range(40):
        t = 0.5 * (falls + rises)
        falls, rises = (t, rises) if slope_of_series(curves, at, t) < 0.0 else (falls, t)
    return 0.5 * (falls + rises)


def root_between(curves, at, low, high):
    """Where a curve falls through zero between two times, to the last digits."""
    above, below, t = low, high, 0.5 * (low + high)
    for _ in range(60):
        slope, value = slope_of_series(curves, at, t), value_at(curves, at, t)
        above, below = (t, below) if value > 0.0 else (above, t)
        newton = t - value / slope if slope != 0.0 else above
        inside = above <= newton <= below
        done = inside and abs(newton - t) <= SETTLED_SPRINGS * high
        t = newton if inside else 0.5 * (above + below)
        if done:
            break
    return t


@inlined
def value_at(series, at, t):
    """A power series at a time."""
    value = 0.0
    for back in range(TERMS):
        value = value * t + series[at + ORDER - back]
    return value


@inlined
def slope_of_series(series, at, t):
    """Its slope."""
    slope = 0.0
    for back in range(ORDER):
        k = ORDER - back
        slope = slope * t + k * series[at + k]
    return slope


@inlined
def integral_to(series, at, t):
    """Its integral from now to a time."""
    value = 0.0
    for back in range(TERMS):
        k = ORDER - back
        value = value * t + series[at + k] / (k + 1.0)
    return value * t
