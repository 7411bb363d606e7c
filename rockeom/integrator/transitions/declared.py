"""The sum of infinitely many impacts of structures with declared modes, and how they stand."""

import math

import numpy as np

from rockeom.codes import RATIO, UNEVEN
from rockeom.compiler.decorators import inlined
from rockeom.integrator.ground import ground_acceleration
from rockeom.integrator.provided import (
    N_STATES,
    ROTATION,
    ROTATION_RATE,
    SIDES,
    jump,
    rates,
    take_step,
)
from rockeom.integrator.tolerances import EPS, FADED
from rockeom.integrator.transitions.restitution import velocity_ratio_at


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


def time_to_rest(mode, y, p, law, ratio, impacts, ax, ay, tolerance, out):
    """(time, mode): when the infinitely many impacts to come will all have happened.

    Close to the end of a free rocking motion the flights between impacts are parabolas: a flight
    that leaves with gap rate v under the closing acceleration a lasts 2 v / a, and the impact
    map gives the v of the next. Their sum converges. Returns (inf, mode) while it is longer
    than `tolerance` in units of 1/sqrt(a), or while an acceleration opens the gap.

    impacts : how many there were. `out` gets the state in which the structure stands once the
    rotation has given to the other rates what flights and impacts give them; `stand` moves these
    through the time.
    """
    held = on_both_feet()
    if held < 0:
        return np.inf, mode
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
        rates(mode, w, p, ax, ay, out)
        a = -SIDES[mode] * out[ROTATION_RATE]
        if not a > 0.0:
            return np.inf, mode
        v = abs(w[ROTATION_RATE])
        flight = 2.0 * v / a
        total += flight
        if total > tolerance / math.sqrt(a):
            return np.inf, mode
        rates(held, w, p, ax, ay, smooth)
        for i in range(N_STATES):
            w[i] += flight * out[i]
            if i >= N_STATES // 2:
                kick[i] += flight * (out[i] - smooth[i])
        w[ROTATION] = 0.0
        # what is left of them counts by the speed that is left
        small = FADED * start
        alike = abs(a - a_before) * v <= small * a and abs(loss - last_loss) * v <= small
        if v <= EPS * start or turn == 999 or (pairs and turn > 2 and alike):
            # what a constant loss leaves of the two series of flights
            left = (1.0 - loss) * (1.0 - (last_loss if law == UNEVEN else loss))
            total += (last_flight + flight) * left / (1.0 - left)
            w[ROTATION_RATE] = 0.0
            if v > EPS * start:
                whole = 1.0 / (1.0 - (1.0 - loss) * v / start)  # all is in proportion to speeds
        mode = jump(
            mode,
            0,
            law,
            velocity_ratio_at(law, ratio, impacts + turn, w[ROTATION_RATE], p),
            w,
            p,
            out,
        )
        for i in range(N_STATES // 2, N_STATES):
            kick[i] += out[i] - w[i]
        if SIDES[mode] == 0.0:
            for i in range(N_STATES):
                out[i] = y[i] + whole * kick[i]
            out[ROTATION] = out[ROTATION_RATE] = 0.0
            return total, mode
        last_loss = loss
        loss = 1.0 - abs(out[ROTATION_RATE]) / v
        # one foot, or one impact, may lose next to nothing where the other does not
        least = max(loss, last_loss) if law == UNEVEN else loss
        if not least > 0.0 or flight > least * tolerance / math.sqrt(a):
            return np.inf, mode  # so little is lost that the end is far, or never comes
        for i in range(N_STATES):
            w[i] = out[i]
    return np.inf, mode


def stand(mode, t, h, y, p, ground, rtol, atol, k, y_new):
    """Move what still moves in full contact through the time h in which impacts faded.

    One step of the method, from y at t into y_new: so the work of the ground and of dampers in that
    time is theirs. k : scratch, the rates of a step. Returns whether its error is tolerable.
    """
    for i in range(N_STATES):
        y_new[i] = y[i]
    if h == 0.0:
        return True
    gx, gy = ground.x, ground.y
    rates(mode, y, p, ground_acceleration(gx, t), ground_acceleration(gy, t), k)
    error = take_step(mode, t, h, y, p, gx, gy, rtol, atol, k, y_new)
    y_new[ROTATION] = y_new[ROTATION_RATE] = 0.0
    return error <= 1.0
