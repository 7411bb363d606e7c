"""The ground motions: accelerations by the segments of their tables.

A segment is a row (start, end, kind, constants), see `rockeom.motion.segments`. There are as many
motions as axes, two in the plane and three in space, and the last is the vertical one. `shaking`,
here and elsewhere, is the tuple of their accelerations at one time.
"""

import math

import numpy as np

from rockeom.codes import WITH_CONSTANT
from rockeom.compiler.decorators import everywhere, inlined, unrolled
from rockeom.generated.prelude import ROUNDER
from rockeom.integrator.provided import AXES, N_ALL_STAGES, STAGE_TIMES
from rockeom.integrator.records import Segment
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
    """The accelerations of the ground by the segments that hold."""
    return tuple(ground_acceleration(ground[axis].row, t) for axis in unrolled(range(AXES)))


@everywhere
def shaking_at(k, first, apart):
    """The accelerations of the ground, kept in an array at these distances from one another."""
    if AXES == 3:
        return k[first], k[first + apart], k[first + 2 * apart]
    else:
        return k[first], k[first + apart]


@inlined
def ground_at_stages(ground, t, h, first, last, out, at):
    """Ground accelerations at the stages from `first` to before `last` of a step.

    Those at stage j go to out[at + j], those along the next axis as far behind as there are stages.
    """
    for axis in unrolled(range(AXES)):
        motion_at_stages(ground[axis].row, t, h, first, last, out, at + axis * N_ALL_STAGES)


@inlined
def motion_at_stages(row, t, h, first, last, out, at):
    """The same along one axis.

    They do not wait for the state, so that the compiler may find several at once.
    """
    if row[2] == 0.0:
        start, change = row[3] + row[4] * (t - row[0]), row[4] * h
        for j in range(first, last):
            out[at + j] = start + STAGE_TIMES[j] * change
    else:
        pulse_at_stages(row, t, h, first, last, out, at)


def pulse_at_stages(row, t, h, first, last, out, at):
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
def tables(case):
    """The tables of the ground's motions, also those of a record with derivatives."""
    if AXES == 3:
        return case.horizontal, case.transverse, case.vertical
    else:
        return case.horizontal, case.vertical


@inlined
def ground_at(t, case):
    """The segments that hold at a time."""
    motions = tables(case)
    return tuple(segment_at(motions[axis], 0, t) for axis in unrolled(range(AXES)))


@inlined
def ground_from(ground, t, case):
    """The segments that hold at t and after it, from these on."""
    motions = tables(case)
    return tuple(
        segment_at(motions[axis], ground[axis].number, t) for axis in unrolled(range(AXES))
    )


@inlined
def first_end(ground):
    """When the first of the segments ends."""
    return min(*tuple(ground[axis].row[1] for axis in unrolled(range(AXES))))


@inlined
def segment_at(table, n, t):
    """The segment of a table that holds at t and after it, from row n on; quiet behind it."""
    while n < table.shape[0] and t >= table[n, 1]:
        n += 1
    if n == table.shape[0]:
        return Segment(n, QUIET)
    return Segment(n, segment_of(table, n))


@inlined
def segment_of(table, n):
    return (
        table[n, 0], table[n, 1], table[n, 2], table[n, 3], table[n, 4], table[n, 5], table[n, 6]
    )  # fmt: skip


def segment_for(table, n, t):
    """As `segment_at`, but the very end of a motion still belongs to its last segment."""
    last = table.shape[0] - rows_after(table).shape[0] - 1
    if last >= 0 and t == table[last, 1]:
        return Segment(last, segment_of(table, last))
    return segment_at(table, n, t)


@inlined
def rows_after(table):
    """Rows of a table behind its motion: the one without end on ground that slopes, or none."""
    n = table.shape[0]
    return table[n - 1 :] if n > 0 and table[n - 1, 1] == np.inf else table[:0]


@inlined
def straight(ground):
    """Whether the ground moves by a straight line along its first axis, and not along others.

    See full_contact_guards.
    """
    line = ground[0].row[2] == 0.0
    for axis in unrolled(range(1, AXES)):
        row = ground[axis].row
        line = line and row[2] == 0.0 and row[3] == 0.0 and row[4] == 0.0
    return line


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
