"""The sum of infinitely many impacts of structures with declared modes, and how they stand."""

import math
from typing import NamedTuple

import numpy as np

from rockeom.codes import RATIO, UNEVEN
from rockeom.compiler.decorators import inlined
from rockeom.integrator.ground import ground_accelerations
from rockeom.integrator.provided import (
    N_MODES,
    N_STATES,
    ROTATION,
    ROTATION_RATE,
    jump,
    rates,
    side_of,
    take_step,
)
from rockeom.integrator.tolerances import EPS, FADED
from rockeom.integrator.transitions.restitution import velocity_ratio_at

MOST_FLIGHTS_TO_REST = 1000


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
    for mode in range(N_MODES):
        if side_of(mode) == 0.0:
            held = mode
    return held


class RockingFlight(NamedTuple):
    """A flight between two impacts on both sides of a motion that fades.

    time : it lasts. a : the acceleration that closes its gap. loss : the part of the velocity that
    the impact before it took.
    """

    time: float
    a: float
    loss: float


def time_to_rest(mode, y, p, law, ratio, impacts, shaking, tolerance, out):
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
    w, kick, smooth = np.empty(N_STATES), np.zeros(N_STATES), np.empty(N_STATES)
    for i in range(N_STATES):
        w[i] = y[i]
    start, total, loss, whole = abs(y[ROTATION_RATE]), 0.0, 1.0, 1.0
    # the flight to come, and the two before it: to the other side, and to the same one
    this, last = RockingFlight(0.0, 0.0, np.inf), RockingFlight(np.inf, np.inf, np.inf)
    pairs = True  # of flights to both sides are complete
    for turn in range(MOST_FLIGHTS_TO_REST):
        before, last = last, this
        pairs = not pairs
        rates(mode, w, p, *shaking, out)
        a, v = -side_of(mode) * out[ROTATION_RATE], abs(w[ROTATION_RATE])
        if not a > 0.0:
            return np.inf, mode
        this = RockingFlight(2.0 * v / a, a, loss)
        total += this.time
        if total > tolerance / math.sqrt(a):
            return np.inf, mode
        rates(held, w, p, *shaking, smooth)
        fly_to_impact(this.time, out, smooth, w, kick)
        series = pairs and turn > 2 and flights_are_geometric(this, last, before, v, FADED * start)
        if v <= EPS * start or turn == MOST_FLIGHTS_TO_REST - 1 or series:
            left = left_of_series(loss, last.loss if law == UNEVEN else loss)
            total += (last.time + this.time) * left
            w[ROTATION_RATE] = 0.0
            if v > EPS * start:
                # all that the impacts give is in proportion to the velocities that they take
                whole = 1.0 / (1.0 - (1.0 - loss) * v / start)
        passed = velocity_ratio_at(law, ratio, impacts + turn, w[ROTATION_RATE], p)
        mode = jump(mode, 0, law, passed, w, p, out)
        for i in range(N_STATES // 2, N_STATES):
            kick[i] += out[i] - w[i]
        if side_of(mode) == 0.0:
            for i in range(N_STATES):
                out[i] = y[i] + whole * kick[i]
            out[ROTATION] = out[ROTATION_RATE] = 0.0
            return total, mode
        loss = 1.0 - abs(out[ROTATION_RATE]) / v
        # one foot, or one impact, may lose next to nothing where the other does not
        least = max(loss, this.loss) if law == UNEVEN else loss
        if not least > 0.0 or this.time > least * tolerance / math.sqrt(a):
            return np.inf, mode  # so little is lost that the end is far, or never comes
        for i in range(N_STATES):
            w[i] = out[i]
    return np.inf, mode


@inlined
def fly_to_impact(time, rate, smooth, w, kick):
    """Move a state w (N,) to its next impact, and add to kick what the rotation gives to rates.

    rate, smooth (N,) : the rates of the state, and those on both feet.
    """
    for i in range(N_STATES):
        w[i] += time * rate[i]
        if i >= N_STATES // 2:
            kick[i] += time * (rate[i] - smooth[i])
    w[ROTATION] = 0.0


@inlined
def flights_are_geometric(this, last, before, v, small):
    """Whether flights shrink by one ratio: what is left of changes counts by the speed v left."""
    same_acceleration = abs(this.a - before.a) * v <= small * this.a
    return same_acceleration and abs(this.loss - last.loss) * v <= small


@inlined
def left_of_series(loss, other_loss):
    """The sum of all pairs of flights to come, in units of the last pair, for constant losses."""
    ratio = (1.0 - loss) * (1.0 - other_loss)
    return ratio / (1.0 - ratio)


def stand(mode, t, h, y, p, ground, rtol, atol, k, y_new):
    """Move what still moves in full contact through the time h in which impacts faded.

    One step of the method, from y at t into y_new: so the work of the ground and of dampers in that
    time is theirs. k : scratch, the rates of a step. Returns whether its error is tolerable.
    """
    for i in range(N_STATES):
        y_new[i] = y[i]
    if h == 0.0:
        return True
    rates(mode, y, p, *ground_accelerations(ground, t), k)
    error = take_step(mode, t, h, y, p, ground, rtol, atol, k, y_new)
    y_new[ROTATION] = y_new[ROTATION_RATE] = 0.0
    return error <= 1.0
