"""Forces of a mode in space, as numeric modes solve for them, by dense linear algebra."""

import numpy as np
import pytest
from scipy.linalg import null_space

import rockeom as rk
from rockeom.codes import BEARS, RELEASED, SLIPS
from rockeom.generated.numeric_modes import (
    FIRST_BIAS,
    FIRST_LEVER,
    PLACE_VALUES,
    motion_in_code,
)

N, M, FRICTION, MASS = 6, 4, 0.45, 2000.0


def held_rows(digits: np.ndarray) -> list[tuple[int, int]]:
    """(point, direction) of the rows that a mode holds."""
    count = {BEARS: 3, RELEASED: 1, SLIPS: 1, SLIPS + 1: 1}
    return [(i, k) for i, digit in enumerate(digits) for k in range(count.get(digit, 0))]


def leaning(rng, digits: np.ndarray) -> tuple[np.ndarray, ...]:
    """M (36,), f (6,), what points tell, and laws, of a prism whose held rows are at rest."""
    body = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=MASS, friction=FRICTION)
    m, p = body.module, body.vector
    y = rng.normal(0.0, [1, 1, 1, 2, 0.1, 0.1, 1, 1, 1, 1, 1, 1])
    matrix, forces, told = np.empty(N * N), np.empty(N), np.empty(M * (FIRST_LEVER + 3 * N))
    laws = np.empty(2 * M)
    m.points(y, p, told)
    levers = told.reshape(M, -1)[:, FIRST_LEVER:].reshape(M, 3, N)
    j = np.array([levers[i, k] for i, k in held_rows(digits)]).reshape(-1, N)
    free = null_space(j, rcond=1e-9)
    y[N:] = free @ (free.T @ y[N:])
    m.points(y, p, told)
    for point in np.flatnonzero(digits >= SLIPS):  # one that cannot move slips, too, and not slowly
        slip = told.reshape(M, -1)[point, 2:4]
        if np.hypot(*slip) < 1e-6:
            slip[:] = np.eye(2)[digits[point] - SLIPS]
    m.free_motion(y, p, *rng.normal(0.0, 3.0, 3), 0, matrix, forces)
    m.point_laws(p, laws)
    return matrix, forces, told, laws


def friction_row(of_point: np.ndarray, digit: int) -> np.ndarray:
    """(6,) by which the friction of a point that slips acts, for each newton that it bears."""
    slip, axis = of_point[2:4], np.eye(2)[digit - SLIPS]
    along = slip / np.hypot(*slip) if slip.any() else axis
    return -FRICTION * np.sign(along @ axis) * along @ of_point[FIRST_LEVER + N :].reshape(2, N)


@pytest.mark.parametrize("seed", range(30))
def test_forces_are_the_least_that_hold_the_rows_of_a_mode(seed):
    """Newton's equations with J x + bias = 0; forces J z, with friction against each slip."""
    rng = np.random.default_rng(seed)
    digits = rng.choice([0, BEARS, RELEASED, *([] if seed % 2 else [SLIPS, SLIPS + 1])], M)
    matrix, forces, told, laws = leaning(rng, digits)
    mode = sum(int(digit) * PLACE_VALUES[i] for i, digit in enumerate(digits))
    x, share = np.empty(N), np.empty(3 * M)
    motion_in_code(mode, N, M, 0, matrix, forces, np.concatenate([told, laws]), x, share)

    of, held = told.reshape(M, -1), held_rows(digits)
    j = np.array([of[i, FIRST_LEVER + k * N :][:N] for i, k in held]).reshape(-1, N)
    bias = np.array([of[i, FIRST_BIAS + k] for i, k in held])
    rubs = [friction_row(of[i], digits[i]) if digits[i] >= SLIPS else np.zeros(N) for i, _ in held]
    k, m = j + np.array(rubs).reshape(-1, N), matrix.reshape(N, N)
    forces, share, m = forces / MASS, share / MASS, m / MASS  # all of one size
    whole = np.block([[m, -k.T @ j], [j, np.zeros((len(j), N))]])
    right = np.concatenate([forces, -bias])
    solution, *_ = np.linalg.lstsq(whole, right, rcond=1e-11)
    np.testing.assert_allclose(whole @ solution, right, atol=1e-8 * np.abs(right).max())
    np.testing.assert_allclose(x, solution[:N], rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(
        share[[3 * i + k for i, k in held]], j @ solution[N:], rtol=1e-8, atol=1e-8
    )
    for i in np.flatnonzero(digits >= SLIPS):
        friction = share[3 * i + 1 : 3 * i + 3]
        assert np.hypot(*friction) == pytest.approx(FRICTION * abs(share[3 * i]))


@pytest.mark.parametrize("seed", range(8))
def test_stages_add_up_the_rows_that_points_tell(seed):
    """J'J and -J' bias of the rows that are held, above the diagonal: without `points`."""
    rng = np.random.default_rng(seed)
    body = rk.LeggedStatue(
        feet={"a": (0.4, 0.1), "b": (-0.3, 0.4), "c": (-0.2, -0.5)}, centroid=(0.02, 0.03, 0.9),
        mass=80.0, inertia=np.diag([30.0, 25.0, 9.0]), friction=None,
    )  # fmt: skip
    y, told, g = rng.normal(0.0, 0.5, 2 * N), np.empty(3 * (FIRST_LEVER + 3 * N)), np.empty(N * 7)
    free, equations = (np.empty(N * N), np.empty(N)), (np.empty(N * N), np.empty(N))
    states = rng.integers(0, 3, 3)  # open, without friction, held along the ground
    rows = np.repeat(states[:, None], 3, axis=1) > [0, 1, 1]
    body.module.points(y, body.vector, told)
    body.module.free_motion(y, body.vector, 1.0, 2.0, 3.0, 0, *free)
    held = rows.ravel().astype(np.int64)
    body.module.equations(y, body.vector, 1.0, 2.0, 3.0, 0, held, *equations, g)
    told = told.reshape(3, -1)
    j, bias = told[:, FIRST_LEVER:].reshape(9, N)[rows.ravel()], told[:, FIRST_BIAS:FIRST_LEVER]
    both = np.column_stack([j.T @ j, -j.T @ bias[rows]])
    np.testing.assert_allclose(g.reshape(N, 7), np.triu(both), atol=1e-13)
    for alone, together in zip(free, equations, strict=True):
        np.testing.assert_allclose(together, alone, rtol=1e-13, atol=1e-13)
