"""The first fall of a polynomial through zero, from its Bernstein coefficients on [0, 1].

The coefficients bound the polynomial, and their changes of sign bound the number of its roots: so
no pair of roots is stepped over.
"""

import math

import numpy as np

from rockeom.compiler.decorators import inlined
from rockeom.integrator.provided import N_GUARDS, N_PARTS, SAMPLES_TO_BERNSTEIN
from rockeom.integrator.tolerances import (
    CLEAR,
    EPS,
    LOOK_BESIDE,
    NARROWEST,
    SAMPLED,
    SETTLED_FALL,
)

NEVER = 2.0  # a place behind the end of any step
MOST_PARTS = 4096  # of a polynomial that are looked at: seven roots need some 600


@inlined
def bernstein_at(b, at, x):
    """Value and slope at x of the polynomial with Bernstein coefficients b[at : at + 8].

    De Casteljau's scheme, written out.
    """
    a0, a1, a2, a3 = b[at], b[at + 1], b[at + 2], b[at + 3]
    a4, a5, a6, a7 = b[at + 4], b[at + 5], b[at + 6], b[at + 7]
    a0, a1, a2, a3 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2), a3 + x * (a4 - a3)
    a4, a5, a6 = a4 + x * (a5 - a4), a5 + x * (a6 - a5), a6 + x * (a7 - a6)
    a0, a1, a2 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2)
    a3, a4, a5 = a3 + x * (a4 - a3), a4 + x * (a5 - a4), a5 + x * (a6 - a5)
    a0, a1, a2 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2)
    a3, a4 = a3 + x * (a4 - a3), a4 + x * (a5 - a4)
    a0, a1 = a0 + x * (a1 - a0), a1 + x * (a2 - a1)
    a2, a3 = a2 + x * (a3 - a2), a3 + x * (a4 - a3)
    a0, a1, a2 = a0 + x * (a1 - a0), a1 + x * (a2 - a1), a2 + x * (a3 - a2)
    a0, a1 = a0 + x * (a1 - a0), a1 + x * (a2 - a1)
    return a0 + x * (a1 - a0), 7.0 * (a1 - a0)


def first_fall(b, at, grain, closed, noise, stack):
    """Smallest x in (0, 1] at which a polynomial falls through zero, or NEVER.

    b[at : at + 8] Bernstein coefficients on [0, 1]. Its coefficients bound a polynomial, and the
    number of their changes of sign bounds that of its roots: a part without change has no root, a
    part with one has one, other parts are halved. So no pair of roots is stepped over.

    grain : rounding error of a coefficient, relative to the largest.
    closed : the guard was closed at x = 0 (an event was just there); that root is no other event.
    noise : beside x = 0 coefficients below it are rounding errors.
    stack (640,) : scratch; ten places hold the coefficients of a part, its start and its width.
    """
    scale = size(b, at)
    if scale == 0.0:
        return NEVER
    opening = max(grain * scale, noise)
    noise = grain * scale
    for i in range(8):
        stack[i] = b[at + i]
    if closed:
        stack[0] = 0.0
    stack[8], stack[9] = 0.0, 1.0
    before = -1 if b[at] < -noise and not closed else 1  # sign before a part
    part = 0
    for _ in range(MOST_PARTS):
        if part < 0:
            break
        start, width = stack[part + 8], stack[part + 9]
        negligible = opening if start == 0.0 else noise
        changes = 0
        first = sign = 0
        for i in range(8):
            if abs(stack[part + i]) > negligible:
                new = 1 if stack[part + i] > 0.0 else -1
                if sign == 0:
                    first = new
                elif new != sign:
                    changes += 1
                sign = new
        decided = changes == 0 or width < NARROWEST
        ends = abs(stack[part + 7]) > negligible  # else the last change of sign may be none
        if first < 0 and before > 0 and decided:
            return start  # it falls exactly where this part begins
        if changes == 0:
            before = sign if sign != 0 else before
            part -= 10
        elif decided or (changes == 1 and first == before and ends):
            if first > 0:
                return start + width * fall(stack, part)
            before = sign  # begins below zero and rises
            part -= 10
        else:
            # halve: de Casteljau gives both halves at once; the lower one is looked at first
            lower = part + 10
            for n in range(7, -1, -1):
                stack[lower + 7 - n] = stack[part]
                for i in range(part, part + n):
                    stack[i] = 0.5 * (stack[i] + stack[i + 1])
            stack[lower + 8], stack[lower + 9] = start, 0.5 * width
            stack[part + 8], stack[part + 9] = start + 0.5 * width, 0.5 * width
            part = lower
    if part >= 0:
        return stack[part + 8]  # given up: the step is looked at again, shorter
    return NEVER if before > 0 or b[at] >= -noise else 0.0  # 0: below zero all along


def larger_falls(b, part, closed, noise, stack):
    """(place, part): where the larger of two polynomials first falls through zero, and which it is.

    b : the Bernstein coefficients of both begin at 8 * part and 8 * (part + 1); its last eight
        places are scratch. Each may fall and rise while the other holds the guard open.
    """
    p = 0.0
    risen = -1.0  # where the guard opens that begins below zero
    open_ = part if b[8 * part] >= b[8 * part + 8] else part + 1
    rest = 8 * (N_GUARDS + N_PARTS)
    if not closed and not starts_open(b, 8 * open_):
        open_ = 2 * part + 1 - open_
        if not starts_open(b, 8 * open_):
            p = NEVER
            for i in range(part, part + 2):
                for j in range(8):
                    b[rest + j] = -b[8 * i + j]
                x = first_fall(b, rest, SAMPLED, False, 0.0, stack)
                if x < p:
                    p, open_ = x, i
            if p == NEVER:
                return 0.0, open_
            risen = p
    for _ in range(32):  # two polynomials of degree seven cross zero 14 times
        part_from(b, 8 * open_, p, rest)
        touches = (closed and p == 0.0) or p == risen
        x = first_fall(b, rest, SAMPLED, touches, noise if p == 0.0 else 0.0, stack)
        if x == NEVER:
            return NEVER, open_
        p += (1.0 - p) * x
        other = 2 * part + 1 - open_
        if bernstein_at(b, 8 * other, p)[0] <= SAMPLED * size(b, 8 * other):
            return p, open_
        open_ = other
    return p, open_


def rises_first(b, at, noise):
    """Whether a polynomial beside zero is above it where it is first more than noise."""
    x = LOOK_BESIDE
    for _ in range(20):
        value, _ = bernstein_at(b, at, x)
        if abs(value) > noise:
            return value > 0.0
        x *= 2.0
    return True


def starts_open(b, at):
    """Whether a polynomial is positive at zero, or opens there."""
    noise = SAMPLED * size(b, at)
    for i in range(8):
        if abs(b[at + i]) > noise:
            return b[at + i] > 0.0
    return False


def part_from(b, at, x, to):
    """Bernstein coefficients b[to : to + 8] on [x, 1] of a polynomial."""
    for i in range(8):
        b[to + i] = b[at + i]
    for n in range(7, 0, -1):
        for i in range(n):
            b[to + i] += x * (b[to + i + 1] - b[to + i])


def size(b, at):
    largest = 0.0
    for i in range(8):
        largest = max(largest, abs(b[at + i]))
    return largest


def fall(b, at):
    """The single fall through zero on [0, 1], by Newton's method within a bracket."""
    low, high = 0.0, 1.0
    # start from the parabola with the same ends and slope: a hop is nearly one
    rise = 7.0 * (b[at + 1] - b[at])
    bend = b[at] + rise - b[at + 7]
    x = 0.5
    if bend > 0.0 and b[at] >= 0.0:
        x = (rise + math.sqrt(rise * rise + 4.0 * bend * b[at])) / (2.0 * bend)
    if not 0.0 < x < 1.0:
        x = 0.5
    for n in range(200):
        value, slope = bernstein_at(b, at, x)
        if value > 0.0:
            low = x
        else:
            high = x
        step = -value / slope if slope < 0.0 else np.inf
        x += step
        if abs(step) <= SETTLED_FALL or high - low <= 2.0 * EPS:
            break  # the error left is about the square of that
        if not low < x < high or n % 8 == 7:
            x = 0.5 * (low + high)
    return min(max(x, low), high)


def clearly_open(b, at):
    """Whether a guard of eight samples b[at : at + 8] stays open, far above a quintic's error.

    All coefficients of its polynomial are positive then by a margin.
    """
    least, most = np.inf, 0.0
    for i in range(8):
        value = 0.0
        for m in range(8):
            value += SAMPLES_TO_BERNSTEIN[i, m] * b[at + m]
        least, most = min(least, value), max(most, abs(value))
    return CLEAR * most < least < np.inf  # no samples that are not numbers
