"""Impact laws, and the sum of infinitely many impacts, of structures with declared modes.

This text is joined to others, see `rockeom.integrator.program`.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import AT_SPEED, BY_FOOT, BY_NUMBER, RATIO
from rockeom.compiler.decorators import inlined

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.bernstein import EPS
    from rockeom.integrator.ground import ground_acceleration
    from rockeom.integrator.interface import (
        N_STATES,
        ROTATION,
        ROTATION_RATE,
        SIDES,
        jump,
        rates,
        take_step,
    )


@inlined
def ratio_at(law, ratio, impact, y, p):
    """Ratio of the rates of rotation at an impact from the state y; `ratio`, unless tabled.

    impact : its number in the motion.
    """
    return ratio if law < AT_SPEED else tabled_ratio(law, impact, y, p)


def tabled_ratio(law, impact, y, p):
    """The ratio by the table at the end of p, that of the left foot before the right one's.

    The left foot lands where the rotation falls. AT_SPEED: the energy ratio in pieces of the rate,
    rows of limit, value at zero and slope, and their number. BY_FOOT: of each foot the energy ratio
    at no rate, its slope, and what is divided by the rate. BY_NUMBER: of each foot the ratio of
    each impact, and their number, behind which they begin anew.
    """
    speed = abs(y[ROTATION_RATE])
    if law == BY_FOOT:
        end = p.shape[0] if y[ROTATION_RATE] > 0.0 else p.shape[0] - 3
        energy = p[end - 3] + p[end - 2] * speed
        if p[end - 1] != 0.0:
            energy += p[end - 1] / speed
        return math.sqrt(min(max(energy, 0.0), 1.0))
    rows = int(p[-1])
    if law == BY_NUMBER:
        row = p.shape[0] - 1 - (rows if y[ROTATION_RATE] > 0.0 else 2 * rows)
        return p[row + impact - rows * int(impact / rows)]
    row = p.shape[0] - 1 - 3 * rows
    for _ in range(rows - 1):
        if speed < p[row]:
            break
        row += 3
    energy = p[row + 1] + p[row + 2] * speed
    return math.sqrt(energy) if energy <= 1.0 else np.nan


@inlined
def may_fade(side, y, rate, law, ratio, tolerance):
    """Whether the flight after an impact is short enough for `time_to_rest` to be finite."""
    a, v = -side * rate[ROTATION_RATE], abs(y[ROTATION_RATE])
    longest = tolerance * (1.0 - ratio) if law == RATIO else tolerance
    return a > 0.0 and 4.0 * v * v <= 1.001 * longest * longest * a


@inlined
def on_both_feet():
    """The mode in which the rotation is zero, or -1."""
    held = -1
    for mode in range(len(SIDES)):
        if SIDES[mode] == 0.0:
            held = mode
    return held


def time_to_rest(contact, y, p, law, ratio, impacts, ax, ay, tolerance, out):
    """(time, contact): when the infinitely many impacts to come will all have happened.

    Close to the end of a free rocking motion the flights between impacts are parabolas: a flight
    that leaves with gap rate v under the closing acceleration a lasts 2 v / a, and the impact
    map gives the v of the next. Their sum converges. Returns (inf, contact) while it is longer
    than `tolerance` in units of 1/sqrt(a), or while an acceleration opens the gap.

    impacts : how many there were. `out` gets the state in which the structure stands once the
    rotation has given to the other rates what flights and impacts give them; `stand` moves these
    through the time.
    """
    held = on_both_feet()
    if held < 0:
        return np.inf, contact
    w, kick, smooth = np.empty(N_STATES), np.empty(N_STATES), np.empty(N_STATES)
    for i in range(N_STATES):
        w[i] = y[i]
        kick[i] = 0.0
    total = flight = a = 0.0
    start = abs(y[ROTATION_RATE])
    loss = whole = 1.0
    last_flight = last_a = last_loss = np.inf  # of the flight before, to the other side
    pairs = True  # of flights to one side and the other are complete
    for turn in range(1000):
        a_before, last_a, last_flight = last_a, a, flight
        pairs = not pairs
        rates(contact, w, p, ax, ay, out)
        a = -SIDES[contact] * out[ROTATION_RATE]
        if not a > 0.0:
            return np.inf, contact
        v = abs(w[ROTATION_RATE])
        flight = 2.0 * v / a
        total += flight
        if total > tolerance / math.sqrt(a):
            return np.inf, contact
        rates(held, w, p, ax, ay, smooth)
        for i in range(N_STATES):
            w[i] += flight * out[i]
            if i >= N_STATES // 2:
                kick[i] += flight * (out[i] - smooth[i])
        w[ROTATION] = 0.0
        # what is left of them counts by the speed that is left
        small = 1e-13 * start
        alike = abs(a - a_before) * v <= small * a and abs(loss - last_loss) * v <= small
        if v <= EPS * start or turn == 999 or (pairs and turn > 2 and alike):
            # what a constant loss leaves of the two series of flights
            left = (1.0 - loss) * (1.0 - (last_loss if law > AT_SPEED else loss))
            total += (last_flight + flight) * left / (1.0 - left)
            w[ROTATION_RATE] = 0.0
            if v > EPS * start:
                whole = 1.0 / (1.0 - (1.0 - loss) * v / start)  # all is in proportion to speeds
        contact = jump(contact, 0, law, ratio_at(law, ratio, impacts + turn, w, p), w, p, out)
        for i in range(N_STATES // 2, N_STATES):
            kick[i] += out[i] - w[i]
        if SIDES[contact] == 0.0:
            for i in range(N_STATES):
                out[i] = y[i] + whole * kick[i]
            out[ROTATION] = out[ROTATION_RATE] = 0.0
            return total, contact
        last_loss = loss
        loss = 1.0 - abs(out[ROTATION_RATE]) / v
        # one foot, or one impact, may lose next to nothing where the other does not
        least = max(loss, last_loss) if law > AT_SPEED else loss
        if not least > 0.0 or flight > least * tolerance / math.sqrt(a):
            return np.inf, contact  # so little is lost that the end is far, or never comes
        for i in range(N_STATES):
            w[i] = out[i]
    return np.inf, contact


def stand(contact, t, h, y, p, ground, rtol, atol, k, y_new):
    """Move what still moves in full contact through the time h in which impacts faded.

    One step of the method, from y at t into y_new: so the work of the ground and of dampers in that
    time is theirs. k : scratch, the rates of a step. Returns whether its error is tolerable.
    """
    for i in range(N_STATES):
        y_new[i] = y[i]
    if h == 0.0:
        return True
    gx, gy = ground.x, ground.y
    rates(contact, y, p, ground_acceleration(gx, t), ground_acceleration(gy, t), k)
    error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new)
    y_new[ROTATION] = y_new[ROTATION_RATE] = 0.0
    return error <= 1.0
