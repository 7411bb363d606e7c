"""Impact laws in which impulses grow, and Moreau's: the contract of newton.py for other laws.

Known are the rates v of gaps and w of slips, and D = J M^-1 J': impulses (P, Q) of normal forces
and friction change (v, w) by D times themselves, and places stay. But for Moreau's law, Coulomb's
holds at each instant of an impact, so that a slip may come to a stop in it, and turn (Routh). The
laws differ in normal forces:

    poisson   all gaps that close do so ever slower, in proportion; the impulses of that are given
              back, times e, see `press_and_give_back`
    lzb       springs of stiffness k as they load, and k / e**2 as they give back, see `grow`
    pairwise  single points one after the other, with the restitution of lzb; those that are alike
              together, see `one_by_one`
"""

import math

import numpy as np

from rockeom.codes import IMPOSSIBLE, LZB, MOREAU, OPEN, PAIRWISE, POISSON
from rockeom.compiler.decorators import inlined
from rockeom.integrator.provided import (
    IMPACT_LAW,
    N_ELEMENTS,
    N_MODES,
    N_POINTS,
    element_state,
    point_numbers,
    point_state,
)
from rockeom.integrator.tolerances import FITS, NOTHING_LEFT, SAME_LANDING_RATE, SAME_VELOCITIES
from rockeom.integrator.transitions.candidates import change_by, fitting_states, sizes_of, squared
from rockeom.integrator.transitions.friction import Meeting, choose, grip, lines_of, slips_now
from rockeom.integrator.transitions.points import LAWS, N_COORDINATES, ROWS, SPREAD, rate_of
from rockeom.integrator.transitions.springs import grow

__fused__ = False

MOST_STAGES = 100000  # of an impact, and impacts of single points in one


def landed(mode, near, y, p, ground, contact, out):
    """Change the velocities of out (N,) by the impact of the points of near (N_POINTS,).

    y : the state before it. Returns a mode in which all points are open, since after it their
    velocities alone say which of them leave, or stick; or IMPOSSIBLE, or AMBIGUOUS.
    """
    n = N_COORDINATES
    rate, impulse, numbers = np.empty(ROWS), np.zeros(ROWS), np.empty(N_POINTS)
    change, sizes = np.empty(N_COORDINATES), np.empty(ROWS + N_POINTS)
    for i in range(n):
        change[i] = out[n + i]
    whole = squared(contact, change)
    sizes_of(whole, contact, sizes)
    for r in range(ROWS):
        arriving, _ = rate_of(contact, r, out, n)
        rate[r] = arriving if abs(arriving) > FITS * sizes[r] else 0.0
    point_numbers(p, numbers)
    follows = mode
    if IMPACT_LAW == MOREAU:
        follows = by_moreau(mode, near, whole, numbers, contact, sizes, rate, change)
    else:
        if not impulses_grow(near, numbers, whole, contact, sizes, rate, impulse):
            follows = IMPOSSIBLE
        for i in range(n):
            change[i] = 0.0
            for r in range(ROWS):
                change[i] += contact[SPREAD + i * ROWS + r] * impulse[r]
    if follows < 0:
        return follows
    for i in range(n):
        out[n + i] += change[i]
    return all_open(mode)


@inlined
def impulses_grow(near, numbers, whole, contact, sizes, rate, impulse):
    """Whether an impact comes to an end; its impulses (ROWS,), and the rates (ROWS,) after it.

    numbers (N_POINTS,) : stiffness. whole, sizes : see `sizes_of`. contact : its laws and coupling.
    """
    m = Meeting(
        near, sizes, rate, impulse, np.empty(N_POINTS), np.empty(N_POINTS, np.int64),
        np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS),
        np.zeros(ROWS), np.zeros(ROWS, np.int64), np.empty(N_POINTS), np.empty(ROWS),
        np.empty(ROWS), np.zeros(N_POINTS),
    )  # fmt: skip
    ends = False
    if IMPACT_LAW == POISSON:
        ends = press_and_give_back(m, contact)
    if IMPACT_LAW == LZB:
        ends = grow(m, numbers, whole, contact)
    if IMPACT_LAW == PAIRWISE:
        ends = one_by_one(m, numbers, whole, contact)
    return ends


def all_open(mode):
    """The mode in which all points are open, with the elements of another."""
    follows = mode
    for candidate in range(N_MODES):
        opens = True
        for i in range(N_POINTS):
            opens = opens and point_state(candidate, i) == OPEN
        for i in range(N_ELEMENTS):
            opens = opens and element_state(candidate, i) == element_state(mode, i)
        if opens:
            follows = candidate
    return follows


def by_moreau(mode, near, whole, along, contact, sizes, rate, change):
    """Moreau's law: Signorini's and Coulomb's, of the velocities after it plus e times before.

    along (N_POINTS,) : e of slips; below zero that of gaps. change (n,) : of the velocities, on
    return. Returns a mode whose impulses fit, or IMPOSSIBLE, or AMBIGUOUS.
    """
    wanted, impulse, sliding = np.empty(ROWS), np.empty(ROWS), np.zeros(N_POINTS)
    fitting = np.empty(N_MODES, np.int64)
    for i in range(N_POINTS):
        e = contact[LAWS + 2 * i]
        e_t = along[i] if along[i] >= 0.0 else e
        wanted[2 * i] = -rate[2 * i] - e * min(rate[2 * i], 0.0)
        wanted[2 * i + 1] = -(1.0 + e_t) * rate[2 * i + 1]
    follows, _ = fitting_states(
        mode, -1, 0, near, sliding, wanted, contact, sizes, FITS, SAME_VELOCITIES * whole,
        fitting, impulse,
    )  # fmt: skip
    if follows >= 0:
        change_by(impulse, contact, change)
    return follows


# -- Poisson -------------------------------------------------------------------------------------


def press_and_give_back(m, contact):
    """Poisson's law: compression to the end, then e times its impulses. Whether it comes to an end.

    s from 0 to 1 counts each. In compression gaps close at the rates (1 - s) times those before, or
    open; in expansion impulses grow by e times those of compression, and further where that would
    close a gap. With one point that is Routh's method. Without friction the impulses are those of
    Glocker and Pfeiffer (1995), X in expansion that which makes X D X / 2 + v X least for
    X >= e P, and X = P would give back what compression P took: no energy is gained, whatever
    all e are. With friction at several points it can be.
    """
    closing = np.zeros(N_POINTS)
    for i in range(N_POINTS):
        m.acts[i] = 1 if m.near[i] == 1 and m.rate[2 * i] < 0.0 else 0
    lines_of(m, contact)
    grip(closing, m, contact)
    for i in range(N_POINTS):
        closing[i] = min(m.rate[2 * i], 0.0) if m.near[i] == 1 else 0.0
        m.given[i] = 0.0
    if not stage_of_poisson(m, closing, contact):
        return False
    for i in range(N_POINTS):
        m.given[i] = contact[LAWS + 2 * i] * m.impulse[2 * i]
        closing[i] = 0.0
    return stage_of_poisson(m, closing, contact)


def stage_of_poisson(m, closing, contact):
    """Compression, of gaps that close at first at rates of closing (N_POINTS,), or expansion."""
    s, lines = 0.0, np.empty(N_POINTS)
    for _ in range(MOST_STAGES):
        for i in range(N_POINTS):
            lines[i] = (1.0 - s) * closing[i]
            on = m.near[i] == 1 and m.rate[2 * i] <= lines[i] + NOTHING_LEFT * m.sizes[2 * i]
            m.acts[i] = 1 if on or m.given[i] > 0.0 else 0
        grip(lines, m, contact)
        for i in range(N_POINTS):
            least = NOTHING_LEFT * m.sizes[2 * i]
            if m.rate[2 * i] < lines[i] - least:  # it closes faster, as others no longer slip
                closing[i] = m.rate[2 * i] / (1.0 - s)
                lines[i] = m.rate[2 * i]
            m.holds[i] = 1 if m.near[i] == 1 and m.rate[2 * i] <= lines[i] + least else 0
        slips_now(m)
        ahead = 1.0
        if not chosen_for(ahead, m, closing, contact):
            # friction closes the gaps: they close faster until it has stopped the slip
            ahead = -1.0
            if not chosen_for(ahead, m, closing, contact):
                return False
        lasts, stops = end_of_stage(s, ahead, m, closing)
        if not lasts < np.inf:
            return False
        s = s + ahead * lasts if stops >= 0 else 1.0
        for r in range(ROWS):
            m.impulse[r] += lasts * m.force[r]
            m.rate[r] += lasts * m.change[r]
        for i in range(N_POINTS):
            if stops == 2 * i or (m.holds[i] == 1 and m.unknown[2 * i] == 1):
                m.rate[2 * i] = (1.0 - s) * closing[i]
            if stops == 2 * i + 1 or m.unknown[2 * i + 1] == 1:
                m.rate[2 * i + 1] = 0.0
        if stops < 0:
            return True
    return False


@inlined
def chosen_for(ahead, m, closing, contact):
    """Whether forces fit where gaps close ever slower, or, ahead -1, faster."""
    for i in range(N_POINTS):
        m.target[2 * i] = -ahead * closing[i]
    return choose(m, contact)


def end_of_stage(s, ahead, m, closing):
    """(how long, row) until a slip stops, or a gap closes as those held do; row -1: neither."""
    lasts, stops = 1.0 - s if ahead > 0.0 else np.inf, -1
    for i in range(N_POINTS):
        if m.near[i] == 0:
            continue
        above = m.rate[2 * i] - (1.0 - s) * closing[i]
        falls = -(m.change[2 * i] + ahead * closing[i])
        if m.holds[i] == 0 and falls > 0.0 and above < lasts * falls:
            lasts, stops = above / falls, 2 * i
        slip, slows = abs(m.rate[2 * i + 1]), -m.slides[i] * m.change[2 * i + 1]
        if m.slides[i] != 0.0 and slows > 0.0 and slip < lasts * slows:
            lasts, stops = slip / slows, 2 * i + 1
    return lasts, stops


# -- pairs ---------------------------------------------------------------------------------------


def one_by_one(m, stiffness, whole, contact):
    """Impacts of single points, until no gap closes; whether that comes to an end.

    The stiffest of the points that close is next; of those as stiff the one that closes fastest.
    Points that are alike in both meet together, as springs do: any order of them would tell left
    from right where nothing else does.
    """
    next_ = np.zeros(N_POINTS, np.int64)
    apart = m._replace(near=next_)
    for _ in range(MOST_STAGES):
        which = next_point(m, stiffness)
        if which < 0:
            return True
        alike = 0
        for i in range(N_POINTS):
            closes = (
                m.near[i] == 1 and m.rate[2 * i] <= (1.0 - SAME_LANDING_RATE) * m.rate[2 * which]
            )
            next_[i] = 1 if closes and stiffness[i] == stiffness[which] else 0
            alike += next_[i]
        if alike == 1 and not meet_alone(which, apart, contact):
            return False
        if alike > 1 and not grow(apart, stiffness, whole, contact):
            return False
    return False


def next_point(m, stiffness):
    """The stiffest of the points that close, of those as stiff the fastest; -1 where none does."""
    which = -1
    for i in range(N_POINTS):
        if m.near[i] == 0 or not m.rate[2 * i] < -NOTHING_LEFT * m.sizes[2 * i]:
            continue
        stiffer = which < 0 or stiffness[i] > stiffness[which]
        if stiffer or (stiffness[i] == stiffness[which] and m.rate[2 * i] < m.rate[2 * which]):
            which = i
    return which


def meet_alone(point, m, contact):
    """The impact of one point, by Routh's method and the energetic restitution; whether it ends.

    Rates are linear in its normal impulse P as long as the slip keeps its state, so that the work
    taken, and given back, is quadratic: the impact ends where e**2 of the work has been given back.
    """
    row, e, energy = 2 * point, contact[LAWS + 2 * point], 0.0
    lines = np.zeros(N_POINTS)
    for i in range(N_POINTS):
        m.first[i], m.holds[i], m.acts[i], m.given[i] = i, 0, m.near[i], float(m.near[i])
        m.target[2 * i] = 0.0
    for _ in range(MOST_STAGES):
        grip(lines, m, contact)
        slips_now(m)
        if not choose(m, contact):
            return False
        v, a, slip = m.rate[row], m.change[row], m.rate[row + 1]
        opens = v > 0.0 or (v == 0.0 and a > 0.0)
        part = e * e if opens else 1.0  # dE = -v dP / part
        if opens and part * energy == 0.0:
            return True
        spent, ends = np.inf, -1
        if opens and v * v + 2.0 * a * part * energy >= 0.0:
            spent = 2.0 * part * energy / (v + math.sqrt(v * v + 2.0 * a * part * energy))
        lasts = -v / a if v * a < 0.0 else np.inf
        if lasts < np.inf:
            ends = row
        slows = -m.slides[point] * m.change[row + 1]
        if m.slides[point] != 0.0 and slows > 0.0 and abs(slip) < lasts * slows:
            lasts, ends = abs(slip) / slows, row + 1
        done = spent <= lasts
        lasts = min(lasts, spent)
        if not lasts < np.inf:
            return False
        energy = max(energy - lasts * (v + 0.5 * a * lasts) / part, 0.0)
        for r in range(ROWS):
            m.impulse[r] += lasts * m.force[r]
            m.rate[r] += lasts * m.change[r]
        if m.unknown[row + 1] == 1:
            m.rate[row + 1] = 0.0
        if done:
            return True
        m.rate[ends] = 0.0
    return False
