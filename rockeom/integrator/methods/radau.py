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


def constants_text(n: int) -> str:
    """Source of the constants of Radau IIA for n coordinates; radau_step.py has the functions.

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
    # N_ALL_STAGES : as many as give room for the contents of k. That of a third axis, of 3 numbers,
    # is in the further one that each stage has there
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
"""
    )
