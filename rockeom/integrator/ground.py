"""The ground motion: accelerations by the segments of its table.

A segment is a row (start, end, kind, constants), see `rockeom.motion.segments`.
"""

import math

import numpy as np

from rockeom.codes import WITH_CONSTANT
from rockeom.compiler.decorators import inlined
from rockeom.generated.prelude import ROUNDER
from rockeom.integrator.provided import STAGE_TIMES
from rockeom.integrator.tolerances import JUMP_OF_GROUND


@inlined
def sine(x):
    """Sine, within 2.5e-16: its Taylor series about multiples of pi, of which odd ones turn it."""
    n = (x * 0.3183098861837907 + ROUNDER) - ROUNDER
    r = (x - n * 3.1415926534682512) - n * 1.2154201013012384e-10
    odd = n - 2.0 * ((0.5 * n + ROUNDER) - ROUNDER)
    z = r * r
    zz = z * z
    s0 = -1 / 6 + z * (1 / 120)
    s1 = -1 / 5040 + z * (1 / 362880)
    s2 = -1 / 39916800 + z * (1 / 6227020800)
    s3 = -1 / 1307674368000 + z * (1 / 355687428096000)
    s4 = -1 / 121645100408832000 + z * (1 / 51090942171709440000)
    s1 += zz * s2
    s3 += zz * s4
    return (1.0 - 2.0 * odd * odd) * (r + r * z * (s0 + zz * (s1 + zz * zz * s3)))


def pulse(row, t):
    """Ground acceleration at t by a curved law, see `ground_acceleration`."""
    if row[2] > WITH_CONSTANT:  # on ground that slopes
        return row[6] + curved(row, row[2] - WITH_CONSTANT, t)
    return curved(row, row[2], t)


def curved(row, kind, t):
    """Ground acceleration at t by the law of a kind."""
    tau = t - row[0]
    if kind == 1.0:  # sine
        return row[3] * sine(row[4] * tau + row[5])
    if kind == 4.0:
        return mavroeidis_papageorgiou(row, tau)
    # expm1, since the compiler would call exp for every law, just in case
    x = row[4] * (tau - row[5])
    if kind == 2.0:  # symmetric Ricker
        return row[3] * (1.0 - 2.0 * x * x) / (1.0 + math.expm1(x * x))
    return row[3] * x * (x * x - 3.0) / (1.0 + math.expm1(0.5 * x * x))


def mavroeidis_papageorgiou(row, tau):
    """Ground acceleration by the pulse of Mavroeidis and Papageorgiou: three sines."""
    ratio, angle, turn = row[6] / row[4], row[4] * tau + row[5], row[6] * tau
    beside = (1.0 + ratio) * sine(angle + turn) + (1.0 - ratio) * sine(angle - turn)
    return row[3] * (0.5 * beside - sine(angle))


@inlined
def ground_acceleration(row, t):
    """Ground acceleration at t by the law in a row of a motion's table."""
    if row[2] == 0.0:  # linear
        return row[3] + row[4] * (t - row[0])
    return pulse(row, t)


@inlined
def ground_accelerations(ground, t):
    """(ax, ay) by the segments that hold."""
    return ground_acceleration(ground.x, t), ground_acceleration(ground.y, t)


@inlined
def ground_at_stages(row, t, h, first, last, out, at):
    """Ground accelerations at the stages from `first` to before `last` of a step, to out[at + j].

    They do not wait for the state, so that the compiler may find several at once.
    """
    if row[2] == 0.0:
        start, change = row[3] + row[4] * (t - row[0]), row[4] * h
        for j in range(first, last):
            out[at + j] = start + STAGE_TIMES[j] * change
    else:
        ground_at_stages_of_a_pulse(row, t, h, first, last, out, at)


def ground_at_stages_of_a_pulse(row, t, h, first, last, out, at):
    if row[2] == 1.0:
        angle, turn, size = row[4] * (t - row[0]) + row[5], row[4] * h, row[3]
        for j in range(first, last):
            out[at + j] = size * sine(angle + STAGE_TIMES[j] * turn)
    else:
        for j in range(first, last):
            out[at + j] = pulse(row, t + STAGE_TIMES[j] * h)


QUIET = (0.0, np.inf, 0.0, 0.0, 0.0, 0.0, 0.0)
"""The row of ground that stands still."""


@inlined
def segment_at(table, n, t):
    """(n, row) of a motion's table that holds at t and after it, from row n on; quiet behind it."""
    while n < table.shape[0] and t >= table[n, 1]:
        n += 1
    if n == table.shape[0]:
        return n, QUIET
    return n, segment_of(table, n)


@inlined
def segment_of(table, n):
    return (
        table[n, 0], table[n, 1], table[n, 2], table[n, 3], table[n, 4], table[n, 5], table[n, 6]
    )  # fmt: skip


def segment_for(table, n, t):
    """As `segment_at`, but the very end of a motion still belongs to its last segment."""
    last = table.shape[0] - rows_after(table).shape[0] - 1
    if last >= 0 and t == table[last, 1]:
        return last, segment_of(table, last)
    return segment_at(table, n, t)


@inlined
def rows_after(table):
    """Rows of a table behind its motion: the one without end on ground that slopes, or none."""
    n = table.shape[0]
    return table[n - 1 :] if n > 0 and table[n - 1, 1] == np.inf else table[:0]


@inlined
def straight(gx, gy):
    """Whether the ground moves by a straight line, and not up or down; see full_contact_guards."""
    return gx[2] == 0.0 and gy[2] == 0.0 and gy[3] == 0.0 and gy[4] == 0.0


@inlined
def jumps(before, after):
    """Whether the ground's acceleration jumps between two laws, by more than rounding."""
    return not abs(after - before) <= JUMP_OF_GROUND * (abs(before) + abs(after))


@inlined
def sampling_step(row):
    """Largest step in which eight samples of a guard follow a segment of the ground.

    Only guards of uplift and of springs are sampled; in full contact nothing else may move, and
    the error of a step says nothing of the ground.
    """
    if row[2] == 0.0:
        return np.inf
    return (1.0 if row[2] == 1.0 else 0.5) / abs(row[4])
