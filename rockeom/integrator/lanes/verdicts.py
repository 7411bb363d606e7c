"""Verdicts on the step of a lane, by the quintics through both ends: what becomes of it, and where.

Without branches, so that the compiler makes vectors of them. A verdict on the gap is that of the
loop, see `rockeom.integrator.guards`. The start of a gap needs no margin here: it is a state, and
no place between states.
"""

import math

from rockeom.compiler.decorators import inlined
from rockeom.integrator.guards import changes_sign_once, stays_open
from rockeom.integrator.polynomials import Ends
from rockeom.integrator.tolerances import (
    CLEAR,
    EPS,
    PLACED_IN_LANES,
    RATE_TURN,
    SETTLED_EXTREME,
    SETTLED_IN_LANES,
    TURN_MISS,
)

DOUBTFUL, REFUSED, REPEATED, TURNS, STANDS, LANDED = 0.0, 1.0, 2.0, 3.0, 4.0, 5.0
"""Verdicts on a step; what has landed stands, too. One is refused where its error is too large."""

HOP, TURN_AT_END = 0.5, -1.0
"""Z_LANDING of a flight so short that its first step is to end at the next impact, and of a step
that is to end where a state has a new extreme."""


@inlined
def scaled(side, h, ends):
    """A coordinate to a side with its derivatives in units of the step."""
    return Ends(
        side * ends.q0, side * h * ends.v0, side * h * h * ends.a0,
        side * ends.q1, side * h * ends.v1, side * h * h * ends.a1,
    )  # fmt: skip


@inlined
def quintic_of_scaled(ends):
    """`quintic_through` of a coordinate that is scaled already, for several uses of that."""
    b1, b2 = ends.q0 + 0.2 * ends.v0, ends.q0 + 0.4 * ends.v0 + 0.05 * ends.a0
    b4, b3 = ends.q1 - 0.2 * ends.v1, ends.q1 - 0.4 * ends.v1 + 0.05 * ends.a1
    return ends.q0, b1, b2, b3, b4, ends.q1


@inlined
def judge_gap(t, h, left, side, closed, landing, upright, within, ends):
    """(verdict, length of the step when repeated) by the quintic through both ends of a step.

    If the gap clearly stays open, or has landed, the step stands. If it clearly closes once, where
    Newton's method finds, the step is repeated to there; one that was to end at the impact is
    corrected by what is left of the gap.

    left : the time to the end of the segment. upright : whether it has not overturned. within :
    whether no state has a new extreme inside.
    """
    of_step = scaled(side, h, ends)
    gap = quintic_of_scaled(of_step)
    x, converged = landing_place(closed, of_step)
    converged &= x * h > 8.0 * EPS * max(t, h)
    first, hop = landing <= 0.0, landing == HOP
    miss, speed = abs(h * of_step.q1), abs(of_step.v1)
    falls = (of_step.v1 < 0.0) & (miss < (0.1 if hop else 0.01) * h * speed)
    falls &= (not closed) | flies(gap)
    landed = falls & (miss <= max(PLACED_IN_LANES * h, 2.0 * EPS * (t + h)) * speed) & upright
    open_ = stays_open(gap, closed)
    closes = changes_sign_once(gap, closed, 0.0) & converged & (x < 1.0) & (not open_)
    again = falls & (landing < 4.0) & converged & (x * h < left) & (not landed)
    repeated = closes if first else again
    stands = (open_ & upright) if first else landed
    verdict = REFUSED if hop else DOUBTFUL
    verdict = REPEATED if repeated else verdict
    verdict = ((STANDS if first else LANDED) if within else TURNS) if stands else verdict
    return verdict, x * h if repeated else h


@inlined
def landing_place(closed, ends):
    """(place, whether it is settled): where a gap closes in a step, by three steps of Newton.

    It is a root of the quintic through both ends, or of its quotient by the place where the gap
    begins at zero; the first guess is that of the parabola with the same ends and first slope.
    """
    q0, v0, a0, q1, v1, a1 = ends.q0, ends.v0, ends.a0, ends.q1, ends.v1, ends.a1
    c3 = 10.0 * (q1 - q0) - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1
    c4 = -15.0 * (q1 - q0) + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1
    c5 = 6.0 * (q1 - q0) - 3.0 * (v0 + v1) - 0.5 * a0 + 0.5 * a1
    bend = q1 - q0 - v0
    above, below = 2.0 * q0, math.sqrt(max(v0 * v0 - 4.0 * q0 * bend, 0.0)) - v0
    x = (-v0 if closed else above) / (bend if closed else below)
    e0, e1, e2 = v0 if closed else q0, 0.5 * a0 if closed else v0, c3 if closed else 0.5 * a0
    e3, e4, e5 = c4 if closed else c3, c5 if closed else c4, 0.0 if closed else c5
    move = 0.0
    for _ in range(3):
        value = e0 + x * (e1 + x * (e2 + x * (e3 + x * (e4 + x * e5))))
        slope = e1 + x * (2.0 * e2 + x * (3.0 * e3 + x * (4.0 * e4 + x * (5.0 * e5))))
        move = value / slope
        x = x - move
    return x, abs(move) < SETTLED_IN_LANES


@inlined
def flies(gap):
    """Whether a gap that is closed at both ends of a step is clearly open in between."""
    _, b1, b2, b3, b4, _ = gap
    doubt = CLEAR * max(max(abs(b1), abs(b2)), max(abs(b3), abs(b4)))
    return (b1 > doubt) & (b2 > doubt) & (b3 > doubt) & (b4 > doubt)


@inlined
def turns_within(h, ends, least_known, most_known, slowest, fastest):
    """The opposite of `widens` for one coordinate and its rate.

    One that turns at an end of the step may miss it by a little: that makes an error of its square.
    """
    of_step = scaled(1.0, h, ends)
    v0, a0, v1, a1 = of_step.v0, of_step.a0, of_step.v1, of_step.a1
    soon, late = v0 + (1 / 3) * a0, v1 - (1 / 3) * a1
    miss = TURN_MISS * max(abs(v0), abs(v1))
    up = (v0 >= -miss) & (soon >= -miss) & (late >= -miss) & (v1 >= -miss)
    down = (v0 <= miss) & (soon <= miss) & (late <= miss) & (v1 <= miss)
    _, b1, b2, b3, b4, _ = quintic_of_scaled(of_step)
    d1, d2, d3 = v0 + 0.25 * a0, 5.0 * (b3 - b2), v1 - 0.25 * a1
    least, most = min(d1, min(d2, d3)), max(d1, max(d2, d3))
    margin = CLEAR * (most - least)
    miss = max(TURN_MISS * (most - least), RATE_TURN * h * (fastest - slowest))
    faster = (d1 >= v0 - miss) & (d2 >= d1) & (d3 >= d2) & (v1 >= d3 - miss)
    slower = (d1 <= v0 + miss) & (d2 <= d1) & (d3 <= d2) & (v1 <= d3 + miss)
    rate = least - margin >= min(h * slowest, min(v0, v1))
    rate &= most + margin <= max(h * fastest, max(v0, v1))
    least, most = min(min(b1, b2), min(b3, b4)), max(max(b1, b2), max(b3, b4))
    margin = CLEAR * (most - least)
    inside = (least - margin >= least_known) & (most + margin <= most_known)
    return (rate | faster | slower) & (up | down | inside)


@inlined
def slope_root(c0, c1, c2, c3, c4):
    """Where on [0, 1] a quartic in Bernstein form, of other signs at its ends, is zero."""
    low, high = 0.0, 1.0
    x = c0 / (c0 - c4)
    for _ in range(12):
        y = 1.0 - x
        b0, b1, b2, b3 = y * c0 + x * c1, y * c1 + x * c2, y * c2 + x * c3, y * c3 + x * c4
        b0, b1, b2 = y * b0 + x * b1, y * b1 + x * b2, y * b2 + x * b3
        b0, b1 = y * b0 + x * b1, y * b1 + x * b2
        value, slope = y * b0 + x * b1, 4.0 * (b1 - b0)
        if value * c0 > 0.0:
            low = x
        else:
            high = x
        move = -value / slope
        x += move
        if abs(move) < SETTLED_EXTREME:
            break
        if not low < x < high:
            x = 0.5 * (low + high)
    return x
