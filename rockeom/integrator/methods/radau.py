"""An implicit method for stiff systems, and the text of its step: Radau IIA of order 5.

Ehle (1969); Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5 and IV.8. It is
collocation: a cubic through the state whose rate is that of the system at the Radau points. The
coefficients follow from this.

With coordinates q and velocities v, q' = v, only the velocities are unknown: where stage i has
v + w_i, it has q + h (c_i v + sum_j a_ij w_j). So 3 n equations for n coordinates are left,

    w_i = h sum_j a_ij acceleration_j,

and are solved by Newton's method with the Jacobian at the start of the step, Jq by coordinates
and Jv by velocities: its matrix is I - h a Jv - h^2 a^2 Jq, in blocks.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction
from functools import cache

import numpy as np

from rockeom.integrator.methods.tableau import Tableau, exact_solution, method_header


def _points() -> list[Fraction]:
    """The Radau points, zeros of (x^2 (x - 1)^3)'' = 2 (x - 1) (10 x^2 - 8 x + 1), to 40 digits."""
    with localcontext() as context:
        context.prec = 40
        root = Fraction(Decimal(6).sqrt())
    return [(4 - root) / 10, (4 + root) / 10, Fraction(1)]


def _weights(nodes: list[Fraction], values: list[Fraction]) -> list[Fraction]:
    """Weights with sum_j weights[j] * nodes[j]**k = values[k]."""
    powers = [[x**k for x in nodes] for k in range(len(nodes))]
    return [weight for (weight,) in exact_solution(powers, [[v] for v in values])]


@cache
def radau() -> Tableau:
    """Radau IIA of order 5 with the start as stage 0 and the new state as stage 4, too.

    The third stage is at the new state; stage 4 repeats it. The estimate of the error compares
    with the method of order 3 that has the weight g of stage 0 (the start), g the real eigenvalue
    of a: its three other weights follow from the quadrature conditions.
    """
    points = _points()
    inner = [_weights(points, [x**k / k for k in (1, 2, 3)]) for x in points]
    a = np.zeros((5, 5))
    a[1:4, 1:4] = [[float(v) for v in row] for row in inner]
    a[4] = a[3]
    values = np.linalg.eigvals(a[1:4, 1:4])
    g = float(values[np.argmin(abs(values.imag))].real)
    lower = _weights(points, [Fraction(1) - Fraction(g), Fraction(1, 2), Fraction(1, 3)])
    errors = np.array([g, *(float(v - w) for v, w in zip(lower, inner[2], strict=True)), 0.0])
    dense = np.zeros((5, 3))
    for j in range(3):  # weights of the integral to x: those of the powers of c have x**k / k
        power = _weights(points, [Fraction(int(k == j), k + 1) for k in range(3)])
        dense[1:4, j] = [float(v) for v in power]
    c = np.array([0.0, *map(float, points), 1.0])
    return Tableau("Radau", a, a[4, :4], c, (errors,), dense, 5, 3)


_STEP = '''

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
    """Solve m x = x by the factors of m."""
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


def differences(contact, y, p, ax, ay, w, f, other, jacobian):
    """Derivatives of the accelerations by the states, jacobian[i * N_STATES + j]."""
    for j in range(N_STATES):
        w[j] = y[j]
    for j in range(N_STATES):
        # far above rounding errors, far below all lengths in which a structure is not linear
        width = 1e-7 + 1e-6 * abs(y[j])
        above, below = y[j] + width, y[j] - width
        w[j] = above
        rates(contact, w, p, ax, ay, f)
        w[j] = below
        rates(contact, w, p, ax, ay, other)
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


def take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, y_new):
    """One step from y at t, into y_new. k: the rates at t, and those at the new state on return.

    Returns the norm of the estimated error, 1 at the tolerance, or inf where Newton's method
    does not converge.
    """
    w = k[W_AT : W_AT + SIZE]
    matrix = k[MATRIX_AT:ORDER_AT]
    order = k[ORDER_AT:RIGHT_AT]
    right = k[RIGHT_AT:JACOBIAN_AT]
    jacobian = k[JACOBIAN_AT:STATE_AT]
    state = k[STATE_AT:RATE_AT]
    rate = k[RATE_AT:OTHER_AT]
    other = k[OTHER_AT:ERROR_AT]
    error = k[ERROR_AT : ERROR_AT + N_STATES]

    ax, ay = ground_acceleration(gx, t), ground_acceleration(gy, t)
    for s in range(3):
        tau = t + STAGE_TIMES[s + 1] * h
        k[GROUND_X + s] = ground_acceleration(gx, tau)
        k[GROUND_Y + s] = ground_acceleration(gy, tau)
    differences(contact, y, p, ax, ay, state, rate, other, jacobian)

    # -- the stages, by Newton's method
    for s in range(3):
        for i in range(N):
            row = (s * N + i) * SIZE
            for r in range(3):
                for j in range(N):
                    m = h * A[s, r] * jacobian[i * N_STATES + N + j]
                    m += h * h * A_SQUARED[s, r] * jacobian[i * N_STATES + j]
                    matrix[row + r * N + j] = (1.0 if s == r and i == j else 0.0) - m
    regular = factor(matrix, SIZE, order)
    # far below the tolerance, but above rounding (IV.8.10)
    enough = max(10.0 * EPS / rtol, min(0.03, math.sqrt(rtol)))
    for i in range(SIZE):
        w[i] = 0.0
    converged = False
    last = np.inf
    for turn in range(MOST_TURNS):
        if not regular:
            break
        for s in range(3):
            stage_state(s, h, y, w, state)
            rates(contact, state, p, k[GROUND_X + s], k[GROUND_Y + s], rate)
            for r in range(3):
                for i in range(N):
                    share = h * A[r, s] * rate[N + i]
                    right[r * N + i] = share if s == 0 else right[r * N + i] + share
        for i in range(SIZE):
            right[i] -= w[i]
        solve(matrix, SIZE, order, right)
        total = 0.0
        for i in range(N):
            place = 1.0 / (atol[i] + rtol * max(abs(y[i]), abs(state[i])))
            speed = 1.0 / (atol[N + i] + rtol * max(abs(y[N + i]), abs(state[N + i])))
            for s in range(3):
                moved = 0.0
                for r in range(3):
                    moved += A[s, r] * right[r * N + i]
                moved *= h * place
                faster = speed * right[s * N + i]
                total += moved * moved + faster * faster
        size = math.sqrt(total / (2 * SIZE))
        for i in range(SIZE):
            w[i] += right[i]
        if not math.isfinite(size):
            break
        # what is left, from the pace so far; an update that no longer shrinks is a rounding
        # error, if it is below the tolerance
        if size == 0.0 or (turn > 0 and size < last and size * size <= enough * (last - size)):
            converged = True
            break
        if size >= last:
            converged = size <= 0.1
            break
        last = size
    for i in range(N):
        moved = y[N + i]
        for s in range(3):
            moved += A[2, s] * w[s * N + i]
        y_new[i] = y[i] + h * moved
        y_new[N + i] = y[N + i] + w[2 * N + i]
    rates(contact, y_new, p, k[GROUND_X + 2], k[GROUND_Y + 2], rate)
    for i in range(N_STATES):
        k[N_STAGES * N_STATES + i] = rate[i]
    if not converged:
        return np.inf

    # -- the error
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
        rates(contact, state, p, ax, ay, rate)
    return norm


def dense_output(contact, t, h, y, p, gx, gy, k, coefficients):
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
'''


def implicit_step_text(n: int) -> str:
    """Source of `take_step`, `dense_output` and the constants of Radau IIA, for n coordinates.

    The Jacobian is one of central differences, whose width depends on the size of a state only:
    a mirrored motion has the mirrored one, to the last bit. Nothing is kept between steps.

    The estimate of the error is passed through (I - h g J)^-1, which takes the stiff components
    out of it that the method damps anyhow; where it is above the tolerance, it is found once more
    with the rate at the start moved by it (IV.8.20), at the first try already.
    """
    method = radau()
    a = method.a[1:4, 1:4]
    errors = method.errors[0]
    dense = method.dense[1:4]
    inverse = np.linalg.inv(a)
    size = 3 * n
    # the rates of four stages and the new state, the ground, the rest as by the places below
    room = 4 * 2 * n + 6 + size * (size + 2) + 2 * n * n + 4 * 2 * n
    total = -(-room // (2 * n + 2))
    # N_ALL_STAGES : as many as give room for what stands in k
    return (
        method_header(method, 3, total)
        + f"""
# by stages and, in the dense output, powers of x from the first
A = np.array({a.tolist()!r})
A_SQUARED = np.array({(a @ a).tolist()!r})
DENSE_PLACE = np.array({dense.tolist()!r})  # from velocities
DENSE_VELOCITY = np.array({(inverse.T @ dense).tolist()!r})  # from their increments w
G = {float(errors[0])!r}
ERROR_PLACE = np.array({errors[1:4].tolist()!r})
ERROR_VELOCITY = np.array({(inverse.T @ errors[1:4]).tolist()!r})

N = N_STATES // 2
SIZE = 3 * N

# Places in k: the rates at the start, increments w of the velocities, the rates at the end
W_AT = N_STATES
GROUND_X = 4 * N_STATES
GROUND_Y = GROUND_X + 3
MATRIX_AT = GROUND_Y + 3
ORDER_AT = MATRIX_AT + SIZE * SIZE
RIGHT_AT = ORDER_AT + SIZE
JACOBIAN_AT = RIGHT_AT + SIZE
STATE_AT = JACOBIAN_AT + N * N_STATES
RATE_AT = STATE_AT + N_STATES
OTHER_AT = RATE_AT + N_STATES
ERROR_AT = OTHER_AT + N_STATES

MOST_TURNS = 12  # of Newton's method
{_STEP}"""
    )
