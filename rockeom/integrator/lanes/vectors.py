"""The work on all lanes at once, but for the step itself: the ground, the control of the error,
verdicts, and the move to the end of a step. `loop.py` says in which order.

This file is not imported. Each loop over the lanes holds the whole work of a lane in plain numbers
and without branches, at places that differ by constants: so the compiler makes vector instructions
of it. Loops over states, places and guards are written out round by round for the same reason.
"""

import math

import numpy as np

from rockeom.compiler.decorators import Floats, entry, inlined, unrolled
from rockeom.integrator.ground import sine
from rockeom.integrator.lanes.verdicts import (
    DOUBTFUL,
    REFUSED,
    REPEATED,
    STANDS,
    TURNS,
    judge_gap,
    quintic_of_scaled,
    scaled,
    turns_within,
)
from rockeom.integrator.polynomials import Ends
from rockeom.integrator.provided import (
    HELD_MODES,
    LANES,
    MOVES,
    N_GUARDS,
    N_PARAMETERS,
    N_PARTS,
    N_STATES,
    PARTS,
    PLACES,
    POWERS,
    QUARTIC,
    QUINTIC,
    ROOTS,
    ROTATION,
    SAMPLES_TO_BERNSTEIN,
    guards,
)
from rockeom.integrator.tolerances import CLEAR, EPS, LEAST_ERROR

N = N_STATES // 2
N_FUNCTIONS = N_GUARDS + N_PARTS

# Rows of the lanes' array z, each of one number a lane. One flat array, and places that differ by
# constants, leave the compiler no doubt that lanes are independent.
(
    Z_T, Z_H, Z_T_NEW,  # start, length and end of the step
    Z_LAST,  # end of the present segments of the ground
    Z_START_X, Z_END_X, Z_KIND_X, Z_X0, Z_X1, Z_X2, Z_X3,  # the ground's horizontal segment
    Z_START_Y, Z_END_Y, Z_KIND_Y, Z_Y0, Z_Y1, Z_Y2, Z_Y3,
    Z_LONGEST,  # step in full contact
    Z_EQUAL,  # length of equal steps, 0 where the error is controlled
    Z_MODE, Z_SIDE, Z_CLOSED,  # as in the loop
    Z_FALLEN,  # bound of the rotation
    Z_TAKEN,  # steps taken
    Z_LANDING,  # how often the step was repeated to end at an impact
    Z_VERDICT,  # what becomes of the step
    Z_ERROR,  # its estimated error, 1 at the tolerance
    Z_NEXT,  # step that the control of the error proposes, 0 if none
    Z_DAMP,  # what the last error damps the answer to the next one by
    Z_IMPACT, Z_FLIGHT,  # time of the last impact, and the parabola's length of the flight from it
) = (i * LANES for i in range(32))  # fmt: skip
Z_Q = 32 * LANES  # positions
Z_Q_NEW = Z_Q + N_STATES // 2 * LANES
Z_LEAST = Z_Q_NEW + N_STATES // 2 * LANES  # extremes of the states
Z_MOST = Z_LEAST + N_STATES * LANES
Z_P = Z_MOST + N_STATES * LANES
Z_K = Z_P + N_PARAMETERS * LANES  # rates of the states at the start of a step, and at its end
Z_K_NEW = Z_K + N_STATES * LANES
Z_AX = Z_K_NEW + N_STATES * LANES  # the ground at the stages of a step, or at its nodes
Z_AY = Z_AX + PLACES * LANES
Z_SIZE = Z_AY + PLACES * LANES


@entry
def shake_lanes(z: Floats, times: Floats):
    """The ground at some times of a step, by linear segments."""
    c = np.empty(PLACES)
    for j in unrolled(range(PLACES)):
        c[j] = times[j]
    for lane in range(LANES):
        t, h = z[Z_T + lane], z[Z_H + lane]
        start_x, x0, x1 = z[Z_START_X + lane], z[Z_X0 + lane], z[Z_X1 + lane]
        start_y, y0, y1 = z[Z_START_Y + lane], z[Z_Y0 + lane], z[Z_Y1 + lane]
        for j in unrolled(range(PLACES)):
            tau = t + c[j] * h
            z[Z_AX + j * LANES + lane] = x0 + x1 * (tau - start_x)
            z[Z_AY + j * LANES + lane] = y0 + y1 * (tau - start_y)


@inlined
def bend(z, times, starts, kinds, sizes, grounds):
    """The ground along an axis, whose rows these are, of lanes whose segment is a sine."""
    c = np.empty(PLACES)
    for j in unrolled(range(PLACES)):
        c[j] = times[j]
    for lane in range(LANES):
        t, h, start = z[Z_T + lane], z[Z_H + lane], z[starts + lane]
        size, rate, angle = z[sizes + lane], z[sizes + LANES + lane], z[sizes + 2 * LANES + lane]
        bent = z[kinds + lane] == 1.0
        for j in unrolled(range(PLACES)):
            wave = size * sine(rate * (t + c[j] * h - start) + angle)
            z[grounds + j * LANES + lane] = wave if bent else z[grounds + j * LANES + lane]


@entry
def bend_x_lanes(z: Floats, times: Floats):
    """`shake_lanes` of lanes whose horizontal segment is a sine; others keep what they have."""
    bend(z, times, Z_START_X, Z_KIND_X, Z_X0, Z_AX)


@entry
def bend_y_lanes(z: Floats, times: Floats):
    """The same of the vertical ground."""
    bend(z, times, Z_START_Y, Z_KIND_Y, Z_Y0, Z_AY)


@entry
def control_lanes(z: Floats):
    """The next step of each lane by proportional-integral control, as in the loop.

    A step that is cut, or is to end at an impact, says nothing of it unless it is refused. Powers
    are products of roots.
    """
    for lane in range(LANES):
        h, error, last = z[Z_H + lane], max(z[Z_ERROR + lane], LEAST_ERROR), z[Z_DAMP + lane]
        equal = z[Z_EQUAL + lane] > 0.0
        root, when_refused, when_taken, damp = error, 1.0, 1.0, 1.0
        for k in unrolled(range(ROOTS)):
            root = math.sqrt(root)
            when_refused *= root if POWERS[0][k] else 1.0
            when_taken *= root if POWERS[1][k] else 1.0
            damp *= root if POWERS[2][k] else 1.0
        refused = (error > 1.0) & ~equal
        cut, first = z[Z_T_NEW + lane] >= z[Z_LAST + lane], z[Z_LANDING + lane] == 0.0
        tells = (error <= 1.0) & first & ~cut & ~equal
        factor = (0.9 if refused else 0.9 * last) / (when_refused if refused else when_taken)
        factor = max(0.1 if refused else 0.2, factor)
        z[Z_NEXT + lane] = h * min(5.0, factor) if refused | tells else z[Z_NEXT + lane]
        z[Z_DAMP + lane] = damp if tells else last


@inlined
def ends_of(z, i, lane):
    """A coordinate of a lane at both ends of its step."""
    return Ends(
        z[Z_Q + i * LANES + lane],
        z[Z_K + i * LANES + lane],
        z[Z_K + (N + i) * LANES + lane],
        z[Z_Q_NEW + i * LANES + lane],
        z[Z_K_NEW + i * LANES + lane],
        z[Z_K_NEW + (N + i) * LANES + lane],
    )


@inlined
def no_state_turns(z, h, lane):
    """Whether no state of a lane has a new extreme within its step."""
    within = True
    for i in unrolled(range(N)):
        within &= turns_within(
            h,
            ends_of(z, i, lane),
            z[Z_LEAST + i * LANES + lane],
            z[Z_MOST + i * LANES + lane],
            z[Z_LEAST + (N + i) * LANES + lane],
            z[Z_MOST + (N + i) * LANES + lane],
        )
    return within


@entry
def judge_lanes(z: Floats, coarse: float):
    """The verdict on the step of each rocking lane; the length of one to be repeated.

    One with an error above its bound, `coarse` for an equal step, is refused, or doubtful if it is
    an equal one; as one that is not finite.
    """
    for lane in range(LANES):
        t, h, side = z[Z_T + lane], z[Z_H + lane], z[Z_SIDE + lane]
        closed, landing = z[Z_CLOSED + lane] == 0.0, z[Z_LANDING + lane]
        rotation = ends_of(z, ROTATION, lane)
        upright, within = abs(rotation.q1) < z[Z_FALLEN + lane], no_state_turns(z, h, lane)
        verdict, new_h = judge_gap(
            t, h, z[Z_LAST + lane] - t, side, closed, landing, upright, within, rotation
        )
        error, equal = z[Z_ERROR + lane], z[Z_EQUAL + lane] > 0.0
        refused = (error > 1.0) & (error < np.inf) & (h > 64.0 * EPS * t) & ~equal
        verdict = verdict if error <= (coarse if equal else 1.0) else DOUBTFUL
        z[Z_VERDICT + lane] = REFUSED if refused else verdict
        z[Z_H + lane] = h if refused else new_h


@inlined
def state_at_nodes(b, h, states):
    """The state at each node of a step, into `states`, by the quintics of its coordinates.

    The first and the last node are the ends of the step.
    """
    for i in unrolled(range(N)):
        if MOVES[i]:
            states[0, i], states[0, N + i] = b[0, i], 5.0 * ((b[1, i] - b[0, i]) / h)
            states[7, i], states[7, N + i] = b[5, i], 5.0 * ((b[5, i] - b[4, i]) / h)
            for m in unrolled(range(1, 7)):
                place = QUINTIC[m, 0] * b[0, i]
                rate = 5.0 * QUARTIC[m, 0] * ((b[1, i] - b[0, i]) / h)
                for j in unrolled(range(1, 6)):
                    place += QUINTIC[m, j] * b[j, i]
                for j in unrolled(range(1, 5)):
                    rate += 5.0 * QUARTIC[m, j] * ((b[j + 1, i] - b[j, i]) / h)
                states[m, i], states[m, N + i] = place, rate
        else:
            for m in unrolled(range(8)):
                states[m, i] = states[m, N + i] = 0.0


@inlined
def clearly_open_in_lanes(samples, f):
    """Whether the polynomial through the samples of a function clearly stays above zero."""
    most = abs(samples[0, f])
    for m in unrolled(range(1, 8)):
        most = max(most, abs(samples[m, f]))
    is_open = (samples[0, f] > CLEAR * most) & (samples[7, f] > CLEAR * most)
    for j in unrolled(range(1, 7)):
        coefficient = SAMPLES_TO_BERNSTEIN[j, 0] * samples[0, f]
        for m in unrolled(range(1, 8)):
            coefficient += SAMPLES_TO_BERNSTEIN[j, m] * samples[m, f]
        is_open &= coefficient > CLEAR * most
    return is_open


@inlined
def all_stay_open(mode, samples):
    """`stays_held` of the loop, by samples of all guards; the larger of two parts counts."""
    held = True
    for guard in unrolled(range(N_GUARDS)):
        clear = clearly_open_in_lanes(samples, guard)
        for place in unrolled(range(N_GUARDS, N_FUNCTIONS, 2)):
            in_parts = False
            for c in unrolled(HELD_MODES):
                if PARTS[c][guard] == place:
                    in_parts |= mode == c
            either = clearly_open_in_lanes(samples, place)
            either |= clearly_open_in_lanes(samples, place + 1)
            clear = either if in_parts else clear
        held &= clear
    return held


@entry
def judge_held_lanes(z: Floats, coarse: float):
    """The verdict on the step of each lane in other modes: it stands where they last.

    Guards are sampled at the nodes of the step; one that a mode has not is open.
    """
    b, states = np.empty((6, N)), np.empty((8, N_STATES))
    p, y, g = np.empty(N_PARAMETERS), np.empty(N_STATES), np.empty(N_FUNCTIONS)
    samples = np.empty((8, N_FUNCTIONS))
    for lane in range(LANES):
        mode = z[Z_MODE + lane] if len(HELD_MODES) > 1 else HELD_MODES[0]
        h = z[Z_H + lane]
        for i in unrolled(range(N_PARAMETERS)):
            p[i] = z[Z_P + i * LANES + lane]
        for i in unrolled(range(N)):
            quintic = quintic_of_scaled(scaled(1.0, h, ends_of(z, i, lane)))
            for j in unrolled(range(6)):
                b[j, i] = quintic[j]
        state_at_nodes(b, h, states)
        for m in unrolled(range(8)):
            for i in unrolled(range(N_STATES)):
                y[i] = states[m, i]
            ax, ay = z[Z_AX + m * LANES + lane], z[Z_AY + m * LANES + lane]
            for c in unrolled(HELD_MODES):
                for f in unrolled(range(N_FUNCTIONS)):
                    g[f] = 1.0
                guards(c, y, p, ax, ay, g)
                for f in unrolled(range(N_FUNCTIONS)):
                    samples[m, f] = g[f] if c == HELD_MODES[0] or mode == c else samples[m, f]
        held = all_stay_open(mode, samples) & (z[Z_SIDE + lane] == 0.0)
        held &= abs(z[Z_Q_NEW + ROTATION * LANES + lane]) < z[Z_FALLEN + lane]
        held &= z[Z_ERROR + lane] <= (coarse if z[Z_EQUAL + lane] > 0.0 else 1.0)
        stands = STANDS if no_state_turns(z, h, lane) else TURNS
        z[Z_VERDICT + lane] = stands if held else z[Z_VERDICT + lane]


@entry
def accept_lanes(z: Floats):
    """Move the lanes whose step stands to its end."""
    for lane in range(LANES):
        stands = z[Z_VERDICT + lane] >= STANDS
        repeated = z[Z_VERDICT + lane] == REPEATED
        t, h = z[Z_T + lane], z[Z_H + lane]
        z[Z_T + lane] = z[Z_T_NEW + lane] if stands else t
        z[Z_T_NEW + lane] = t + h if repeated else z[Z_T_NEW + lane]
        landing = z[Z_LANDING + lane]
        kept = landing if z[Z_VERDICT + lane] == TURNS else 0.0
        z[Z_LANDING + lane] = max(landing, 0.0) + 1.0 if repeated else kept
        z[Z_CLOSED + lane] = -1.0 if stands else z[Z_CLOSED + lane]
        z[Z_TAKEN + lane] = z[Z_TAKEN + lane] + 1.0
        # both are read before one is chosen: a number that one case alone reads makes a branch
        for i in unrolled(range(N)):
            old, new = z[Z_Q + i * LANES + lane], z[Z_Q_NEW + i * LANES + lane]
            z[Z_Q + i * LANES + lane] = new if stands else old
        for i in unrolled(range(N_STATES)):
            old, new = z[Z_K + i * LANES + lane], z[Z_K_NEW + i * LANES + lane]
            z[Z_K + i * LANES + lane] = new if stands else old
        for i in unrolled(range(N_STATES)):
            state = z[Z_Q + i * LANES + lane] if i < N else z[Z_K + (i - N) * LANES + lane]
            z[Z_LEAST + i * LANES + lane] = min(z[Z_LEAST + i * LANES + lane], state)
            z[Z_MOST + i * LANES + lane] = max(z[Z_MOST + i * LANES + lane], state)
