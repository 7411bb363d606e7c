"""Accelerations and forces of contact from one system of equations, and states that fit a mode.

    M q'' - W lambda = f,    J q'' = -bias

of all closed points together, solved by numpy. From the generated module come M, f and the points'
gaps and rows alone, which `tests.contact.test_modes` compares with their declaration.
"""

from types import ModuleType
from typing import NamedTuple

import numpy as np

OPEN, STICK, SLIP_RIGHT, SLIP_LEFT = range(4)


class Points(NamedTuple):
    """Of each point: gap, rates, biases, and the rows J_N and J_T."""

    gap: np.ndarray
    gap_rate: np.ndarray
    slip_rate: np.ndarray
    gap_bias: np.ndarray
    slip_bias: np.ndarray
    normal: np.ndarray
    along: np.ndarray


def points(module: ModuleType, y: np.ndarray, p: np.ndarray) -> Points:
    n = module.N_STATES // 2
    out = np.zeros(module.N_POINTS * (5 + 2 * n))
    module.points(y, p, out)
    rows = out.reshape(module.N_POINTS, 5 + 2 * n)
    return Points(*rows[:, :5].T, rows[:, 5 : 5 + n], rows[:, 5 + n :])


def groups(module: ModuleType, mode: int) -> dict[int, list[int]]:
    """Closed points that share friction, by the first of them."""
    found: dict[int, list[int]] = {}
    for i, state in enumerate(module.POINT_STATES[mode]):
        if state != OPEN:
            found.setdefault(module.SHARED[mode][i], []).append(i)
    return found


def sign(state: int) -> float:
    return {SLIP_RIGHT: 1.0, SLIP_LEFT: -1.0}.get(state, 0.0)


def put_on(module: ModuleType, mode: int, y: np.ndarray, p: np.ndarray) -> np.ndarray:
    """The state nearest to y in which the closed gaps are closed, and what sticks does not slip."""
    y, n = y.copy(), module.N_STATES // 2
    states = np.array(module.POINT_STATES[mode])
    closed, stuck = np.flatnonzero(states != OPEN), np.flatnonzero(states == STICK)
    if len(closed) == 0:
        return y
    for _ in range(100):
        at = points(module, y, p)
        y[:n] -= np.linalg.lstsq(at.normal[closed], at.gap[closed], rcond=None)[0]
    at = points(module, y, p)
    rows = np.vstack([at.normal[closed], at.along[stuck]])
    y[n:] -= np.linalg.lstsq(rows, rows @ y[n:], rcond=1e-9)[0]
    return y


class Solved(NamedTuple):
    """accelerations (n,); normal forces (points,); friction of each group, by its first point."""

    accelerations: np.ndarray
    normal: np.ndarray
    friction: dict[int, float]
    condition: float


def solve(
    module: ModuleType, mode: int, y: np.ndarray, p: np.ndarray, ax: float, ay: float
) -> Solved:
    """Points of a group at different heights: their friction stands in one ratio to their N."""
    kappa: dict[int, float] = {}
    found = _solve(module, mode, y, p, ax, ay, kappa)
    for _ in range(200):  # where what they share moves the normal forces
        shared = {g: many for g, many in groups(module, mode).items() if len(many) > 1}
        new = {g: found.friction[g] / found.normal[many].sum() for g, many in shared.items()}
        if all(abs(new[g] - kappa.get(g, np.inf)) < 1e-15 for g in new):
            break
        kappa = new
        found = _solve(module, mode, y, p, ax, ay, kappa)
    return found


def _solve(module, mode, y, p, ax, ay, kappa) -> Solved:
    n, at = module.N_STATES // 2, points(module, y, p)
    matrix, forces = np.zeros(n * n), np.zeros(n)
    module.free_motion(y, p, ax, ay, mode, matrix, forces)
    laws = np.zeros(2 * module.N_POINTS)
    module.point_laws(p, laws)
    states = module.POINT_STATES[mode]
    closed = [i for i, state in enumerate(states) if state != OPEN]
    stuck = [g for g, many in groups(module, mode).items() if states[many[0]] == STICK]
    rows = [at.normal[i] for i in closed] + [at.along[i] for i in stuck]
    right = [-at.gap_bias[i] for i in closed] + [-at.slip_bias[i] for i in stuck]
    pushes = [at.normal[i] - laws[2 * i + 1] * sign(states[i]) * at.along[i]
              if sign(states[i]) else at.normal[i] for i in closed]  # fmt: skip
    pushes += [at.along[i] for i in stuck]
    # friction at its own height, less as much at that of the first
    for g in stuck:
        for i in groups(module, mode)[g]:
            pushes[closed.index(i)] = pushes[closed.index(i)] + kappa.get(g, 0.0) * (
                at.along[i] - at.along[g]
            )
    k = len(rows)
    system, known = np.zeros((n + k, n + k)), np.zeros(n + k)
    system[:n, :n], known[:n] = matrix.reshape(n, n), forces
    if k:
        system[:n, n:], system[n:, :n], known[n:] = -np.array(pushes).T, rows, right
    found = np.linalg.solve(system, known)
    normal = np.zeros(module.N_POINTS)
    normal[closed] = found[n : n + len(closed)]
    friction = dict(zip(stuck, found[n + len(closed) :], strict=True))
    for g, many in groups(module, mode).items():
        if g not in stuck:
            friction[g] = sum(-sign(states[i]) * laws[2 * i + 1] * normal[i] for i in many)
    return Solved(found[:n], normal, friction, float(np.linalg.cond(system)))
