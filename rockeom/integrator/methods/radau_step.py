"""The step of Radau IIA of order 5, for structures of any number of coordinates.
Its constants are those that `radau.constants_text` writes.
"""

import math

import numpy as np

from rockeom.compiler.decorators import unrolled
from rockeom.integrator.ground import ground_accelerations, shaking_at
from rockeom.integrator.provided import (
    A_SQUARED,
    AXES,
    DENSE_PLACE,
    DENSE_VELOCITY,
    ERROR_PLACE,
    ERROR_VELOCITY,
    N_STAGES,
    N_STATES,
    STAGE_TIMES,
    A,
    G,
    rates,
)
from rockeom.integrator.tolerances import EPS, JACOBIAN_STEP, LEAST_JACOBIAN_STEP

N = N_STATES // 2
SIZE = 3 * N
MOST_TURNS = 12  # of Newton's method

# Places in k: the rates at the start, increments w of the velocities, the rates at the end
W_AT = N_STATES
GROUND = 4 * N_STATES  # at each stage
MATRIX_AT = GROUND + 3 * AXES
ORDER_AT = MATRIX_AT + SIZE * SIZE
RIGHT_AT = ORDER_AT + SIZE
JACOBIAN_AT = RIGHT_AT + SIZE
STATE_AT = JACOBIAN_AT + N * N_STATES
RATE_AT = STATE_AT + N_STATES
OTHER_AT = RATE_AT + N_STATES
ERROR_AT = OTHER_AT + N_STATES


def factor(m, size, order):
    """Triangular factors of m (size * size,) with partial pivoting, in its place.

    False where it is singular or not finite.
    """
    for c in range(size):
        best = c
        for r in range(c + 1, size):
            if abs(m[r * size + c]) > abs(m[best * size + c]):
                best = r
        order[c] = best
        if best != c:
            for j in range(size):
                m[c * size + j], m[best * size + j] = m[best * size + j], m[c * size + j]
        pivot = m[c * size + c]
        if not 0.0 < abs(pivot) < np.inf:
            return False
        for r in range(c + 1, size):
            share = m[r * size + c] / pivot
            m[r * size + c] = share
            if share != 0.0:
                for j in range(c + 1, size):
                    m[r * size + j] -= share * m[c * size + j]
    return True


def solve(m, size, order, x):
    """Solve m x = b by the factors of m: x is b, and becomes the solution."""
    for c in range(size):
        best = int(order[c])
        x[c], x[best] = x[best], x[c]
    for r in range(1, size):
        for c in range(r):
            x[r] -= m[r * size + c] * x[c]
    for r in range(size - 1, -1, -1):
        for c in range(r + 1, size):
            x[r] -= m[r * size + c] * x[c]
        x[r] /= m[r * size + r]


def differences(mode, y, p, shaking, w, f, other, jacobian):
    """Derivatives of the accelerations by the states, jacobian[i * N_STATES + j]."""
    for j in range(N_STATES):
        w[j] = y[j]
    for j in range(N_STATES):
        # far above rounding errors, far below all lengths in which a structure is not linear
        width = LEAST_JACOBIAN_STEP + JACOBIAN_STEP * abs(y[j])
        above, below = y[j] + width, y[j] - width
        w[j] = above
        rates(mode, w, p, *shaking, f)
        w[j] = below
        rates(mode, w, p, *shaking, other)
        w[j] = y[j]
        for i in range(N):
            jacobian[i * N_STATES + j] = (f[N + i] - other[N + i]) / (above - below)


def stage_state(s, h, y, w, state):
    """The state at a stage, from the increments w (3 * N,) of the velocities."""
    for i in range(N):
        moved = STAGE_TIMES[s + 1] * y[N + i]
        for j in range(3):
            moved += A[s, j] * w[j * N + i]
        state[i] = y[i] + h * moved
        state[N + i] = y[N + i] + w[s * N + i]


def take_step(mode, t, h, y, p, ground, rtol, atol, k, y_new):
    """One step from y at t, into y_new. k: the rates at t, and those at the new state on return.

    Returns the norm of the estimated error, 1 at the tolerance, or inf where Newton's method
    does not converge.
    """
    w, rate = k[W_AT : W_AT + SIZE], k[RATE_AT:OTHER_AT]
    shaking = ground_accelerations(ground, t)
    for s in range(3):
        at_stage = ground_accelerations(ground, t + STAGE_TIMES[s + 1] * h)
        for axis in unrolled(range(AXES)):
            k[GROUND + 3 * axis + s] = at_stage[axis]
    differences(
        mode, y, p, shaking, k[STATE_AT:RATE_AT], rate, k[OTHER_AT:ERROR_AT],
        k[JACOBIAN_AT:STATE_AT],
    )  # fmt: skip
    converged = solve_stages(mode, h, y, p, rtol, atol, k)
    for i in range(N):
        moved = y[N + i]
        for s in range(3):
            moved += A[2, s] * w[s * N + i]
        y_new[i] = y[i] + h * moved
        y_new[N + i] = y[N + i] + w[2 * N + i]
    rates(mode, y_new, p, *shaking_at(k, GROUND + 2, 3), rate)
    for i in range(N_STATES):
        k[N_STAGES * N_STATES + i] = rate[i]
    if not converged:
        return np.inf
    return error_norm(mode, h, y, p, shaking, rtol, atol, k, y_new)


def stage_matrix(h, jacobian, matrix):
    """I - h a Jv - h^2 a^2 Jq, of all stages."""
    for s in range(3):
        for i in range(N):
            row = (s * N + i) * SIZE
            for r in range(3):
                for j in range(N):
                    m = h * A[s, r] * jacobian[i * N_STATES + N + j]
                    m += h * h * A_SQUARED[s, r] * jacobian[i * N_STATES + j]
                    matrix[row + r * N + j] = (1.0 if s == r and i == j else 0.0) - m


def solve_stages(mode, h, y, p, rtol, atol, k):
    """Find the increments w of the velocities by Newton's method; whether it converges."""
    w, matrix, order = k[W_AT : W_AT + SIZE], k[MATRIX_AT:ORDER_AT], k[ORDER_AT:RIGHT_AT]
    right, state, rate = k[RIGHT_AT:JACOBIAN_AT], k[STATE_AT:RATE_AT], k[RATE_AT:OTHER_AT]
    stage_matrix(h, k[JACOBIAN_AT:STATE_AT], matrix)
    regular = factor(matrix, SIZE, order)
    # far below the tolerance, but above rounding (IV.8.10)
    enough = max(10.0 * EPS / rtol, min(0.03, math.sqrt(rtol)))
    for i in range(SIZE):
        w[i] = 0.0
    if not regular:
        return False
    last = np.inf
    for turn in range(MOST_TURNS):
        for s in range(3):
            stage_state(s, h, y, w, state)
            rates(mode, state, p, *shaking_at(k, GROUND + s, 3), rate)
            for r in range(3):
                for i in range(N):
                    share = h * A[r, s] * rate[N + i]
                    right[r * N + i] = share if s == 0 else right[r * N + i] + share
        for i in range(SIZE):
            right[i] -= w[i]
        solve(matrix, SIZE, order, right)
        size = size_of_change(h, y, state, rtol, atol, right)
        for i in range(SIZE):
            w[i] += right[i]
        if not math.isfinite(size):
            return False
        # what is left, from the pace so far; an update that no longer shrinks is a rounding
        # error, if it is below the tolerance
        if size == 0.0 or (turn > 0 and size < last and size * size <= enough * (last - size)):
            return True
        if size >= last:
            return size <= 0.1
        last = size
    return False


def size_of_change(h, y, state, rtol, atol, change):
    """The norm of a change of the increments (3 * N,), 1 at the tolerance."""
    total = 0.0
    for i in range(N):
        place = 1.0 / (atol[i] + rtol * max(abs(y[i]), abs(state[i])))
        speed = 1.0 / (atol[N + i] + rtol * max(abs(y[N + i]), abs(state[N + i])))
        for s in range(3):
            moved = 0.0
            for r in range(3):
                moved += A[s, r] * change[r * N + i]
            moved *= h * place
            faster = speed * change[s * N + i]
            total += moved * moved + faster * faster
    return math.sqrt(total / (2 * SIZE))


def error_norm(mode, h, y, p, shaking, rtol, atol, k, y_new):
    """The norm of the estimated error, 1 at the tolerance; inf where its matrix is singular."""
    w, jacobian = k[W_AT : W_AT + SIZE], k[JACOBIAN_AT:STATE_AT]
    matrix, order, right = k[MATRIX_AT:ORDER_AT], k[ORDER_AT:RIGHT_AT], k[RIGHT_AT:JACOBIAN_AT]
    state, rate, other = k[STATE_AT:RATE_AT], k[RATE_AT:OTHER_AT], k[OTHER_AT:ERROR_AT]
    error = k[ERROR_AT : ERROR_AT + N_STATES]
    g = h * G
    for i in range(N):
        for j in range(N):
            m = g * jacobian[i * N_STATES + N + j] + g * g * jacobian[i * N_STATES + j]
            matrix[i * N + j] = (1.0 if i == j else 0.0) - m
    if not factor(matrix, N, order):
        return np.inf
    for i in range(N):
        error[i] = 0.0
        rate[N + i] = k[N + i]
    norm = np.inf
    for attempt in range(2):
        for i in range(N):
            place = 0.0
            speed = g * rate[N + i]
            for s in range(3):
                place += ERROR_PLACE[s] * w[s * N + i]
                speed += ERROR_VELOCITY[s] * w[s * N + i]
            # the velocity at the start adds to nothing in the first attempt
            other[i] = h * place + (g * error[N + i] if attempt == 1 else 0.0)
            right[i] = speed
        for i in range(N):
            for j in range(N):
                right[i] += g * jacobian[i * N_STATES + j] * other[j]
        solve(matrix, N, order, right)
        total = 0.0
        for i in range(N):
            error[i] = other[i] + g * right[i]
            error[N + i] = right[i]
        for i in range(N_STATES):
            e = error[i] / (atol[i] + rtol * max(abs(y[i]), abs(y_new[i])))
            total += e * e
        norm = math.sqrt(total / N_STATES)
        if not 1.0 <= norm < np.inf or attempt == 1:
            break
        for i in range(N_STATES):
            state[i] = y[i] + error[i]
        rates(mode, state, p, *shaking, rate)
    return norm


def dense_output(mode, t, h, y, p, ground, k, coefficients):
    """Coefficients (8 * N,) of the powers of x = (time - t)/h over the step just taken."""
    for i in range(N_STATES):
        coefficients[i] = y[i]
        for j in range(1, 8):
            coefficients[j * N_STATES + i] = 0.0
    for i in range(N):
        coefficients[N_STATES + i] = h * y[N + i]
        for j in range(3):
            at = (j + 1) * N_STATES + i
            for s in range(3):
                w = k[W_AT + s * N + i]
                coefficients[at] += h * DENSE_PLACE[s, j] * w
                coefficients[at + N] += DENSE_VELOCITY[s, j] * w
