"""Impact laws in which impulses grow, and Moreau's: the contract of newton.py for other laws.

Known are the rates v of gaps and w of slips, and D = J M^-1 J': impulses (P, Q) of normal forces
and friction change (v, w) by D times themselves, and places stay. But for Moreau's law, Coulomb's
holds at each instant of an impact, so that a slip may come to a stop in it, and turn (Routh). The
laws differ in normal forces:

    poisson   all gaps that close do so ever slower, in proportion; the impulses of that are given
              back, times e, see `press_and_give_back`
    lzb       springs of stiffness k as they load, and k / e**2 as they give back, see `grow`
    pairwise  single points one after the other, with the restitution of lzb, see `one_by_one`

This text is joined behind candidates.py, see `rockeom.integrator.program`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rockeom.codes import IMPOSSIBLE, LZB, MOREAU, NEVER_SLIPS, OPEN, PAIRWISE, POISSON
from rockeom.compiler.decorators import Floats, Ints, inlined, rolled

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.interface import (
        ELEMENT_STATES,
        IMPACT_LAW,
        N_ELEMENTS,
        N_POINTS,
        POINT_STATES,
        point_numbers,
    )
    from rockeom.integrator.transitions.candidates import FITS, fitting_states, sizes_of, squared
    from rockeom.integrator.transitions.points import (
        COUPLING,
        LAWS,
        N_COORDINATES,
        ROWS,
        SPREAD,
        eliminate,
        rate_of,
    )

ORDER = 14  # of the power series of springs
TERMS = ORDER + 1
PART = 0.5  # length of a step of springs, times their highest frequency: the error is 1e-17
SAMPLES = 4  # in a step, between which a change of sign is looked for
SOON = 1e-6  # parts of a step, after which the states of points are chosen
NOTHING_LEFT = 1e-12  # of velocities and forces: what is smaller is none
ROUNDING = 1e-13  # of theirs
MOST_STEPS = 200000  # of springs
MOST_PHASES = 100000  # phases, and impacts of single points
# Curves that may fall through zero as springs move, of each point
RATE, FORCE, HELD, EASES, SLIP, MORE, LESS = range(7)


class Meeting(NamedTuple):
    """Points that meet, and what they do at an instant of the impact.

    near (N_POINTS,) : 1 of those that touch. sizes : of `sizes_of`. rate, impulse (ROWS,) : now.
    slides (N_POINTS,) : signs of slips, 0 where there is none. first : see `lines_of`.
    holds (N_POINTS,) : 1 where a gap is held: the point presses, or leaves. acts : 1 where one may
    press. given : normal forces, besides those that hold a gap. target (ROWS,) : rates of change of
    the gaps that are held, and 0 of slips.
    unknown (ROWS,) : 1 of forces that are to be found, where points hold a gap or stick. sigma
    (N_POINTS,) : sign of the slip that friction opposes. force, change (ROWS,) : forces, and rates
    of change by them.
    """

    near: Ints
    sizes: Floats
    rate: Floats
    impulse: Floats
    slides: Floats
    first: Ints
    holds: Ints
    acts: Ints
    given: Floats
    target: Floats
    unknown: Ints
    sigma: Floats
    force: Floats
    change: Floats


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


def landed(mode, near, y, p, ground, known, out):
    """Change the velocities of out (N,) by the impact of the points of near (N_POINTS,).

    y : the state before it. Returns a mode in which all points are open, since after it their
    velocities alone say which of them leave, or stick; or IMPOSSIBLE, or AMBIGUOUS.
    """
    n = N_COORDINATES
    rate, impulse, numbers = np.empty(ROWS), np.zeros(ROWS), np.empty(N_POINTS)
    change, sizes = np.empty(N_COORDINATES), np.empty(ROWS + N_POINTS)
    for i in range(n):
        change[i] = out[n + i]
    whole = squared(known, change)
    sizes_of(whole, known, sizes)
    for r in range(ROWS):
        arriving, _ = rate_of(known, r, out, n)
        rate[r] = arriving if abs(arriving) > FITS * sizes[r] else 0.0
    point_numbers(p, numbers)
    found = mode
    if IMPACT_LAW == MOREAU:
        found = by_moreau(mode, near, whole, numbers, known, sizes, rate, change)
    else:
        if not impulses_grow(near, numbers, whole, known, sizes, rate, impulse):
            found = IMPOSSIBLE
        for i in range(n):
            change[i] = 0.0
            for r in range(ROWS):
                change[i] += known[SPREAD + i * ROWS + r] * impulse[r]
    if found < 0:
        return found
    for i in range(n):
        out[n + i] += change[i]
    return all_open(mode)


@inlined
def impulses_grow(near, numbers, whole, known, sizes, rate, impulse):
    """Whether an impact comes to an end; its impulses (ROWS,), and the rates (ROWS,) after it.

    numbers (N_POINTS,) : stiffness. whole, sizes : see `sizes_of`. known : laws and coupling of it.
    """
    m = Meeting(
        near, sizes, rate, impulse, np.empty(N_POINTS), np.empty(N_POINTS, np.int64),
        np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS, np.int64), np.zeros(N_POINTS),
        np.zeros(ROWS), np.zeros(ROWS, np.int64), np.empty(N_POINTS), np.empty(ROWS),
        np.empty(ROWS),
    )  # fmt: skip
    ends = False
    if IMPACT_LAW == POISSON:
        ends = press_and_give_back(m, known)
    if IMPACT_LAW == LZB:
        ends = grow(m, numbers, whole, known)
    if IMPACT_LAW == PAIRWISE:
        ends = one_by_one(m, numbers, known)
    return ends


def all_open(mode):
    """The mode in which all points are open, with the elements of another."""
    found = mode
    for candidate in range(len(POINT_STATES)):
        opens = True
        for i in range(N_POINTS):
            opens = opens and POINT_STATES[candidate][i] == OPEN
        for i in range(N_ELEMENTS):
            opens = opens and ELEMENT_STATES[candidate][i] == ELEMENT_STATES[mode][i]
        if opens:
            found = candidate
    return found


def by_moreau(mode, near, whole, along, known, sizes, rate, change):
    """Moreau's law: Signorini's and Coulomb's, of the velocities after it plus e times before.

    along (N_POINTS,) : e of slips; below zero that of gaps. change (n,) : of the velocities, on
    return. Returns a mode whose impulses fit, or IMPOSSIBLE, or AMBIGUOUS.
    """
    wanted, sliding = np.empty(ROWS), np.zeros(N_POINTS)
    fitting = np.empty(len(POINT_STATES), np.int64)
    for i in range(N_POINTS):
        e = known[LAWS + 2 * i]
        e_t = along[i] if along[i] >= 0.0 else e
        wanted[2 * i] = -rate[2 * i] - e * min(rate[2 * i], 0.0)
        wanted[2 * i + 1] = -(1.0 + e_t) * rate[2 * i + 1]
    fitting[0] = -1
    found, _ = fitting_states(
        mode, near, sliding, wanted, known, sizes, FITS, 1e-18 * whole, fitting, change
    )
    return found


# -- Coulomb's law at an instant of an impact ----------------------------------------------------


def slips_now(m):
    """The signs of the slips, 0 where they are none."""
    for i in range(N_POINTS):
        slip = m.rate[2 * i + 1]
        m.slides[i] = 0.0
        if m.near[i] == 1 and abs(slip) > NOTHING_LEFT * m.sizes[2 * i + 1]:
            m.slides[i] = 1.0 if slip > 0.0 else -1.0


def lines_of(m, known):
    """The first point that has the slip of each, such as level feet: they share their friction."""
    for i in range(N_POINTS):
        m.first[i] = i
        of_this = known[COUPLING + (2 * i + 1) * ROWS + 2 * i + 1]
        for back in range(i):
            j = i - 1 - back
            of_that = known[COUPLING + (2 * j + 1) * ROWS + 2 * j + 1]
            apart = of_this + of_that - 2.0 * known[COUPLING + (2 * i + 1) * ROWS + 2 * j + 1]
            if m.near[i] == 1 and m.near[j] == 1 and apart <= 1e-12 * (of_this + of_that):
                m.first[i] = j


def grip(lines, m, known):
    """Stop the slips of points that never slip, and may press, by infinite friction: at once.

    The normal impulse that goes with it is none. It may let others close faster than at the rates
    of lines (N_POINTS,), which press from now on, too.
    """
    a, held = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    for _ in range(N_POINTS):
        order, moves = 0, False
        for i in range(N_POINTS):
            if m.acts[i] == 1 and known[LAWS + 2 * i + 1] >= NEVER_SLIPS:
                held[order] = 2 * i + 1
                moves = moves or m.rate[2 * i + 1] != 0.0
                order += 1
        if not moves:
            break
        width = order + 1
        for r in range(order):
            for s in range(order):
                a[r * width + s] = known[COUPLING + held[r] * ROWS + held[s]]
            a[r * width + order] = -m.rate[held[r]]
        eliminate(a, order, width)
        for r in range(order):
            m.impulse[held[r]] += a[r * width + order]
            for s in range(ROWS):
                by = known[COUPLING + s * ROWS + held[r]]
                m.rate[s] += by * a[r * width + order]
        for r in range(order):
            m.rate[held[r]] = 0.0
        for i in range(N_POINTS):
            below = m.rate[2 * i] < lines[i] - NOTHING_LEFT * m.sizes[2 * i]
            m.acts[i] = 1 if m.near[i] == 1 and below else m.acts[i]


def combination(code, m, known):
    """Whether there is a combination of this number, of what points do that is not known.

    Those that hold a gap press or leave; those that do not slip stick or begin to slip.
    """
    left = code
    for i in range(N_POINTS):
        m.unknown[2 * i] = m.unknown[2 * i + 1] = 0
        m.sigma[i] = m.slides[i]
        if m.holds[i] == 1:
            half = int(0.5 * left)
            m.unknown[2 * i] = 1 - (left - 2 * half)
            left = half
        if m.first[i] != i:
            m.sigma[i] = m.sigma[m.first[i]]
        elif m.slides[i] == 0.0:
            friction = friction_on_line(i, m, known)
            choice = 0
            if 0.0 < friction < NEVER_SLIPS:
                third = int((left + 0.5) / 3.0)
                choice, left = left - 3 * third, third
            m.sigma[i] = 1.0 if choice == 1 else -1.0 if choice == 2 else 0.0
            m.unknown[2 * i + 1] = 1 if choice == 0 and friction > 0.0 else 0
    return left == 0


@inlined
def friction_on_line(point, m, known):
    """The largest coefficient of friction of points that share the slip of one and may press."""
    most = 0.0
    for j in range(N_POINTS):
        if m.first[j] == point and m.acts[j] == 1:
            most = max(most, known[LAWS + 2 * j + 1])
    return most


@inlined
def tie_of(point, m, known):
    """Friction in parts of the normal force of a point that slips; 0 of one that does not."""
    return -m.sigma[point] * known[LAWS + 2 * point + 1] if m.sigma[point] != 0.0 else 0.0


@rolled
def forces_with(m, given, target, known):
    """The forces, with which held gaps move at the rates of target (ROWS,), and points stick.

    given (N_POINTS,) : normal forces, besides those that hold a gap.
    """
    a, found = np.empty(ROWS * (ROWS + 1)), np.empty(ROWS, np.int64)
    order, force = 0, m.force
    for i in range(N_POINTS):
        force[2 * i] = given[i]
        force[2 * i + 1] = tie_of(i, m, known) * given[i]
    for r in range(ROWS):
        if m.unknown[r] == 1:
            found[order] = r
            order += 1
    width = order + 1
    for r in range(order):
        row = COUPLING + found[r] * ROWS
        for s in range(order):
            a[r * width + s] = known[row + found[s]]
            point = int(0.5 * found[s])
            if found[s] == 2 * point:
                a[r * width + s] += tie_of(point, m, known) * known[row + found[s] + 1]
        a[r * width + order] = target[found[r]]
        for s in range(ROWS):
            a[r * width + order] -= known[row + s] * force[s]
    eliminate(a, order, width)
    for r in range(order):
        more, point = a[r * width + order], int(0.5 * found[r])
        force[found[r]] += more
        if found[r] == 2 * point:
            force[found[r] + 1] += tie_of(point, m, known) * more
    for r in range(ROWS):
        m.change[r] = 0.0
        for s in range(ROWS):
            m.change[r] += known[COUPLING + r * ROWS + s] * force[s]


def bound_of(point, m, known):
    """The largest friction of the points that share the slip of one."""
    bound = 0.0
    for j in range(N_POINTS):
        if m.first[j] == point:
            bound += known[LAWS + 2 * j + 1] * max(m.force[2 * j], 0.0)
    return bound


def least_margin(m, known):
    """The least margin by which forces fit: they press, bound friction, and what leaves opens."""
    largest, least = 1e-300, np.inf
    for r in range(ROWS):
        largest = max(largest, abs(m.force[r]))
    for i in range(N_POINTS):
        normal, along = 2 * i, 2 * i + 1
        if m.holds[i] == 1 and m.unknown[normal] == 1:
            least = min(least, (m.force[normal] - m.given[i]) / largest)
        elif m.holds[i] == 1:
            size = known[COUPLING + normal * ROWS + normal] * largest + abs(m.target[normal])
            least = min(least, (m.change[normal] - m.target[normal]) / size)
        if m.first[i] != i or m.slides[i] != 0.0:
            continue
        if m.unknown[along] == 1 and friction_on_line(i, m, known) < NEVER_SLIPS:
            least = min(least, (bound_of(i, m, known) - abs(m.force[along])) / largest)
        elif m.sigma[i] != 0.0:
            size = known[COUPLING + along * ROWS + along] * largest
            least = min(least, m.sigma[i] * m.change[along] / size)
    return least


def choose(m, known):
    """Whether forces fit: those that fit best, by `least_margin`, and what they do, on return."""
    best, most, code = -1, -FITS, 0
    while combination(code, m, known):
        forces_with(m, m.given, m.target, known)
        margin = least_margin(m, known)
        if margin > most:
            best, most = code, margin
        if margin > 1e-3:
            break
        code += 1
    if best < 0:
        return False
    combination(best, m, known)
    forces_with(m, m.given, m.target, known)
    return True


# -- Poisson -------------------------------------------------------------------------------------


def press_and_give_back(m, known):
    """Poisson's law: compression to the end, then e times its impulses. Whether it comes to an end.

    s from 0 to 1 counts each. In compression gaps close at the rates (1 - s) times those before, or
    open; in expansion impulses grow by e times those of compression, and further where that would
    close a gap. Of one point that is Routh's method. Without friction the impulses are those of
    Glocker and Pfeiffer (1995), X in expansion that which makes X D X / 2 + v X least for
    X >= e P, and X = P would give back what compression P took: no energy is gained, whatever
    all e are. With friction at several points it can be.
    """
    closing = np.zeros(N_POINTS)
    for i in range(N_POINTS):
        m.acts[i] = 1 if m.near[i] == 1 and m.rate[2 * i] < 0.0 else 0
    lines_of(m, known)
    grip(closing, m, known)
    for i in range(N_POINTS):
        closing[i] = min(m.rate[2 * i], 0.0) if m.near[i] == 1 else 0.0
        m.given[i] = 0.0
    if not phase_of_poisson(m, closing, known):
        return False
    for i in range(N_POINTS):
        m.given[i] = known[LAWS + 2 * i] * m.impulse[2 * i]
        closing[i] = 0.0
    return phase_of_poisson(m, closing, known)


def phase_of_poisson(m, closing, known):
    """Compression, of gaps that close at first at rates of closing (N_POINTS,), or expansion."""
    s, lines = 0.0, np.empty(N_POINTS)
    for _ in range(MOST_PHASES):
        for i in range(N_POINTS):
            lines[i] = (1.0 - s) * closing[i]
            on = m.near[i] == 1 and m.rate[2 * i] <= lines[i] + NOTHING_LEFT * m.sizes[2 * i]
            m.acts[i] = 1 if on or m.given[i] > 0.0 else 0
        grip(lines, m, known)
        for i in range(N_POINTS):
            least = NOTHING_LEFT * m.sizes[2 * i]
            if m.rate[2 * i] < lines[i] - least:  # it closes faster, as others no longer slip
                closing[i] = m.rate[2 * i] / (1.0 - s)
                lines[i] = m.rate[2 * i]
            m.holds[i] = 1 if m.near[i] == 1 and m.rate[2 * i] <= lines[i] + least else 0
        slips_now(m)
        ahead = 1.0
        if not chosen_for(ahead, m, closing, known):
            # friction closes the gaps: they close faster until it has stopped the slip
            ahead = -1.0
            if not chosen_for(ahead, m, closing, known):
                return False
        lasts, stops = end_of_phase(s, ahead, m, closing)
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
def chosen_for(ahead, m, closing, known):
    """Whether forces fit where gaps close ever slower, or, ahead -1, faster."""
    for i in range(N_POINTS):
        m.target[2 * i] = -ahead * closing[i]
    return choose(m, known)


def end_of_phase(s, ahead, m, closing):
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


def one_by_one(m, stiffness, known):
    """Impacts of single points, until no gap closes; whether that comes to an end.

    The stiffest of the points that close is next; of those as stiff the one that closes fastest.
    """
    alone = np.zeros(N_POINTS, np.int64)
    single = m._replace(near=alone)
    for _ in range(MOST_PHASES):
        which = -1
        for i in range(N_POINTS):
            if m.near[i] == 0 or not m.rate[2 * i] < -NOTHING_LEFT * m.sizes[2 * i]:
                continue
            if which < 0 or stiffness[i] > stiffness[which]:
                which = i
            elif stiffness[i] == stiffness[which]:
                which = i if m.rate[2 * i] < (1.0 + 1e-9) * m.rate[2 * which] else which
        if which < 0:
            return True
        alone[which] = 1
        if not meet_alone(which, single, known):
            return False
        alone[which] = 0
    return False


def meet_alone(point, m, known):
    """The impact of one point, by Routh's method and the energetic restitution; whether it ends.

    Rates are linear in its normal impulse P as long as the slip keeps its state, so that the work
    taken, and given back, is quadratic: the impact ends where e**2 of the work has been given back.
    """
    row, e, energy = 2 * point, known[LAWS + 2 * point], 0.0
    lines = np.zeros(N_POINTS)
    for i in range(N_POINTS):
        m.first[i], m.holds[i], m.acts[i], m.given[i] = i, 0, m.near[i], float(m.near[i])
        m.target[2 * i] = 0.0
    for _ in range(MOST_PHASES):
        grip(lines, m, known)
        slips_now(m)
        if not choose(m, known):
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


# -- springs -------------------------------------------------------------------------------------


def grow(m, stiffness, whole, known):
    """Springs between the points that touch, until none presses; whether that comes to an end.

    In the time of the impact F' = -k v at a point whose gap closes at the rate v < 0, and
    F' = -k v / e**2 where it opens; velocities change by D F. So with E = F**2 / (2 k) of each
    point, dE = -v dP in compression, and dE = -v dP / e**2 in expansion, and

        dP_i / dP_j = F_i / F_j = (k_i / k_j)**(1/2) (E_i / E_j)**(1/2)

    which is the law of Liu, Zhao and Brogliato (Proc. R. Soc. A 464, 2008 and 465, 2009) with
    linear stiffness, eta = 1, and the energetic restitution e: each point gives back e**2 of the
    work that it took. Their law is singular where E_i = E_j = 0. Written in time it is regular: a
    point at rest begins to press as the others push it, which is the branch that carries load. With
    e = 0 the force drops as the gap no longer closes, to the least that keeps it from opening.

    The sum of kinetic energy and of E falls by (1 / e**2 - 1) v dP in expansion, and by the work of
    friction; E is zero at both ends. So no impact gains energy.

    stiffness (N_POINTS,) : k, of which ratios count. whole : see `sizes_of`.
    """
    stiffest = quickest = 0.0
    for i in range(N_POINTS):
        if m.near[i] == 1:
            stiffest = max(stiffest, stiffness[i])
            quickest = max(quickest, stiffness[i] * known[COUPLING + 2 * i * (ROWS + 1)])
    springs = Springs(
        stiffness, np.zeros(N_POINTS), np.zeros(N_POINTS), np.empty(N_POINTS),
        math.sqrt(whole * stiffest) + 1e-300, math.sqrt(quickest) + 1e-300,
        np.empty(ROWS * N_POINTS), np.empty(ROWS * N_POINTS),
    )  # fmt: skip
    lines_of(m, known)
    steps = 0
    while steps < MOST_STEPS:
        if not act_now(m, springs, known):
            return False
        if not presses(m, springs):
            return True
        spread_out(m, springs, known)
        steps = move_on(m, springs, steps, known)
    return False


def presses(m, springs):
    """Whether a point presses, or begins to."""
    some = False
    for i in range(N_POINTS):
        some = some or springs.force[i] > 0.0 or (springs.loads[i] > 0.0 and m.rate[2 * i] < 0.0)
    return some


def act_now(m, springs, known):
    """What points do from now on; whether forces fit.

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
    which_act(m, springs, known)
    for _ in range(4 * N_POINTS):
        for i in range(N_POINTS):
            m.given[i] = m.target[2 * i] = 0.0
            if m.acts[i] == 1 and m.holds[i] == 0:
                m.given[i] = max(force[i] - soon * springs.loads[i] * m.rate[2 * i], 0.0)
        if not choose(m, known):
            return False
        if not (some_load(m, springs, soon, known) or some_join(m, springs, known)):
            break
    for i in range(N_POINTS):
        v = m.rate[2 * i] if m.rate[2 * i] != 0.0 else m.change[2 * i]
        springs.opens[i] = -1.0 if v < 0.0 and m.holds[i] == 0 else 1.0
        if m.holds[i] == 1:
            force[i] = m.force[2 * i] if m.unknown[2 * i] == 1 else 0.0
            springs.loads[i] = 0.0
        elif m.acts[i] == 1:
            loads = stiffness_at(v, known[LAWS + 2 * i], springs.stiffness[i])
            springs.loads[i] = loads if v < 0.0 or force[i] > 0.0 else 0.0
    return True


@inlined
def stiffness_at(v, e, k):
    """The stiffness of a spring that loads, v <= 0, or gives back."""
    return k if not v > 0.0 or e == 0.0 else k / (e * e)


def which_act(m, springs, known):
    """Which points close, or press, or of `acts` rest and are pushed; and their springs."""
    slips_now(m)
    for i in range(N_POINTS):
        v, e = m.rate[2 * i], known[LAWS + 2 * i]
        pressed = springs.force[i] > 0.0
        joined = m.acts[i] == 1 and v == 0.0
        acts = m.near[i] == 1 and (v < 0.0 or pressed or joined)
        m.acts[i] = 1 if acts else 0
        m.holds[i] = 1 if acts and v == 0.0 and pressed and e == 0.0 else 0
        springs.loads[i] = stiffness_at(v, e, springs.stiffness[i]) if acts else 0.0


def some_join(m, springs, known):
    """Whether a point at rest is pushed by the forces, and is to press: it acts from now on."""
    found = False
    for i in range(N_POINTS):
        if m.near[i] == 1 and m.acts[i] == 0 and m.rate[2 * i] == 0.0 and m.change[2 * i] < 0.0:
            m.acts[i], found = 1, True
    if found:
        which_act(m, springs, known)
    return found


def some_load(m, springs, soon, known):
    """Whether a gap that is held with e = 0 closes instead: it would take a force that grows.

    Its point is no longer held then. Forces and rates of change are those of the points that are.
    """
    held, grows, found = np.empty(N_POINTS), np.empty(N_POINTS), False
    for i in range(N_POINTS):
        v = m.rate[2 * i] + soon * m.change[2 * i]
        grows[i] = -springs.loads[i] * v if m.given[i] > 0.0 else 0.0
        held[i] = m.force[2 * i]
        found = found or m.holds[i] == 1
    if not found:
        return False
    found = False
    forces_with(m, grows, m.target, known)
    for i in range(N_POINTS):
        if m.holds[i] == 0 or m.unknown[2 * i] == 0:
            continue
        least = ROUNDING * springs.size
        more = held[i] > (1.0 + 1e-5) * springs.force[i] + least
        if more or m.force[2 * i] > 1e-9 * held[i] * springs.omega + least * springs.omega:
            m.holds[i], found = 0, True
            springs.force[i] = min(springs.force[i], held[i])
    if not found:
        forces_with(m, m.given, m.target, known)
    return found


def spread_out(m, springs, known):
    """All forces, and rates of change, by the force of each spring."""
    for j in range(N_POINTS):
        for i in range(N_POINTS):
            m.given[i] = 1.0 if i == j and m.holds[i] == 0 and springs.loads[i] > 0.0 else 0.0
        forces_with(m, m.given, m.target, known)
        for r in range(ROWS):
            springs.spread[r * N_POINTS + j] = m.force[r]
            springs.pull[r * N_POINTS + j] = m.change[r]


def move_on(m, springs, steps, known):
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
    limits_of(m, springs, known, least)
    while event < 0 and steps < MOST_STEPS:
        steps += 1
        series_of(m, springs, series)
        curves_of(m, springs, series, known, curves)
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


def limits_of(m, springs, known, least):
    """How far below zero rounding may take each curve of `curves_of`; inf of what is none."""
    for i in range(N_POINTS):
        at, size, holds = 7 * i, springs.size, m.holds[i] == 1 and m.unknown[2 * i] == 1
        for c in range(7):
            least[at + c] = np.inf
        if m.near[i] == 0:
            continue
        if holds:
            least[at + HELD] = ROUNDING * size
            least[at + EASES] = ROUNDING * size * springs.omega
        else:
            least[at + RATE] = ROUNDING * m.sizes[2 * i]
        if springs.loads[i] > 0.0 and springs.opens[i] > 0.0:
            least[at + FORCE] = ROUNDING * size
        if m.first[i] == i and m.sigma[i] != 0.0:
            least[at + SLIP] = ROUNDING * m.sizes[2 * i + 1]
        elif m.unknown[2 * i + 1] == 1 and friction_on_line(i, m, known) < NEVER_SLIPS:
            least[at + MORE] = least[at + LESS] = ROUNDING * size


def curves_of(m, springs, series, known, curves):
    """The power series of what ends a phase as it falls below zero.

    Of each point: how fast its gap closes still, or opens; its force; that which holds its gap, and
    how fast that falls; its slip; the friction that it could have on either side.
    """
    for i in range(N_POINTS):
        for k in range(TERMS):
            at, force = 7 * i * TERMS + k, springs_at(2 * i, springs, series, k)
            friction, bound, eases = springs_at(2 * i + 1, springs, series, k), 0.0, 0.0
            for j in range(N_POINTS):
                by = springs.spread[2 * i * N_POINTS + j]
                eases += by * springs.loads[j] * series[(N_POINTS + 2 * j) * TERMS + k]
                if m.first[j] == i and known[LAWS + 2 * j + 1] < NEVER_SLIPS:
                    bound += known[LAWS + 2 * j + 1] * springs_at(2 * j, springs, series, k)
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
        at, before, then = c * TERMS, 0.0, curves[c * TERMS]
        for i in range(SAMPLES + 1):
            t = h * (i / SAMPLES) if i > 0 else SOON * h
            now = value_at(curves, at, t)
            if now < -least[c]:
                where = before if i > 0 else t
                if then > 0.0:
                    where = root_between(curves, at, before, t)
                if where < first:
                    event, first = c, where
                break
            before, then = t, now
    return event, first


def root_between(curves, at, low, high):
    """Where a curve falls through zero between two times, to the last digits."""
    above, below, t = low, high, 0.5 * (low + high)
    for _ in range(60):
        slope, value = 0.0, value_at(curves, at, t)
        above, below = (t, below) if value > 0.0 else (above, t)
        for back in range(ORDER):
            k = ORDER - back
            slope = slope * t + k * curves[at + k]
        newton = t - value / slope if slope != 0.0 else above
        inside = above <= newton <= below
        done = inside and abs(newton - t) <= 1e-15 * high
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
def integral_to(series, at, t):
    """Its integral from now to a time."""
    value = 0.0
    for back in range(TERMS):
        k = ORDER - back
        value = value * t + series[at + k] / (k + 1.0)
    return value * t
