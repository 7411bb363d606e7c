"""What is said of guards in a step by four samples of each, and the equations of an event."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockeom.codes import LANDING, LIFTING, STAYS_OPEN, UNCLEAR
from tests.machine_code import plain_texts

N = 2
TEXT = plain_texts(
    "transitions.modes_by_table", "transitions.landings", N_STATES=2, N_STAGES=1,
    N_POINTS=1, N_GUARDS=N, N_PARTS=0, GUARDS=(1, 2),
    KINDS=((LANDING, LANDING), (LANDING, LIFTING)), SIDES=(0.0, 0.0),
)  # fmt: skip


def at(cubic, t):
    return cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]))


def said(cubics, closed, mode=0, hop=-1):
    """Of guards that are cubics of time, in a step from 0 to 1."""

    def guards_at(_mode, t, _y, _p, _ground, g):
        for i, cubic in enumerate(cubics):
            g[i] = at(cubic, t)

    TEXT["guards_at"] = guards_at
    still = np.zeros(2)
    motion = SimpleNamespace(mode=mode, t=0.0, closed=closed)
    arrays = SimpleNamespace(y=still, y_new=still, k=np.zeros(4), w=np.zeros(2), b=np.zeros(4 * N))
    step, case = SimpleNamespace(h=1.0), SimpleNamespace(p=None)
    return TEXT["fall_within"](motion, None, step, False, hop, case, arrays)


def random_cubics(closed):
    """Of all shapes; those from a closed guard may open and fall again."""
    rng = np.random.default_rng(5)
    for _ in range(4000):
        cubic = rng.normal(size=4) * 10.0 ** rng.uniform(-2.0, 1.0, 4)
        cubic[0] = 0.0 if closed else abs(cubic[0])
        yield cubic


@pytest.mark.parametrize("closed", [False, True])
def test_no_cubic_that_falls_is_said_to_stay_open(closed):
    told = 0
    places = np.linspace(0.0, 1.0, 2001)[1:]
    for cubic in random_cubics(closed):
        if said([cubic], 1 if closed else -1)[0] == STAYS_OPEN:
            told += 1
            assert at(cubic, places).min() > 0.0, cubic
    assert told > 100


@pytest.mark.parametrize("closed", [False, True])
def test_a_cubic_that_is_said_to_fall_does_so_there_and_nowhere_else(closed):
    told = 0
    for cubic in random_cubics(closed):
        guard, place = said([cubic], 1 if closed else -1)
        if guard == 0:
            told += 1
            roots = np.roots(cubic[::-1])
            roots = roots[abs(roots.imag) < 1e-12].real
            roots = roots[(roots > (1e-9 if closed else 0.0)) & (roots <= 1.0)]
            assert len(roots) == 1, cubic
            assert place == pytest.approx(roots[0], abs=1e-9)
            assert cubic[1] + place * (2.0 * cubic[2] + 3.0 * place * cubic[3]) < 0.0
    assert told > 40


def test_a_landing_is_told_only_where_nothing_else_ends_the_state():
    opens, falls = (0.0, 1.0, -1.0, 0.0), (0.3, -1.0, 0.0, 0.0)
    assert said([opens], 1, hop=0) == (0, 1.0)
    assert said([falls], -1) == (0, pytest.approx(0.3))
    away = (1.0, 0.1, 0.0, 0.0)
    assert said([opens, away], 1, mode=1, hop=0) == (0, 1.0)
    for mode in (0, 1):  # another gap closes, or a force vanishes
        TEXT["GUARDS"] = (2, 2)
        assert said([opens, falls], 1, mode, hop=0)[0] == UNCLEAR
        assert said([falls, (0.6, -1.0, 0.0, 0.0)], -1, mode)[0] == UNCLEAR
    TEXT["GUARDS"] = (1, 2)


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_equations_of_an_event(order):
    """Against numpy; where two say the same, by one of the solutions."""
    rng = np.random.default_rng(order)
    text = plain_texts("transitions.points", N_STATES=4, N_POINTS=2, N_GUARDS=1, N_PARTS=0)
    for turn in range(100):
        root = rng.normal(size=(order, order if turn % 2 else max(order - 1, 1)))
        matrix = root @ root.T
        right = matrix @ rng.normal(size=order)
        rows = np.column_stack([matrix, right]).ravel()
        text["eliminate"](rows, order, order + 1)
        found = rows.reshape(order, -1)[:, -1]
        np.testing.assert_allclose(matrix @ found, right, atol=1e-8 * abs(right).max())


def test_coordinates_move_by_their_mass():
    """Against numpy; what has no inertia stays."""
    rng, n = np.random.default_rng(6), 4
    text = plain_texts("transitions.points", N_STATES=2 * n, N_POINTS=1, N_GUARDS=1, N_PARTS=0)
    solve = text["through_mass"]
    for _ in range(50):
        root = rng.normal(size=(n, n))
        mass, b = root @ root.T + 0.1 * np.eye(n), rng.normal(size=(n, 3))
        found = b.ravel().copy()
        solve(mass.ravel(), found, 3)
        np.testing.assert_allclose(found.reshape(n, 3), np.linalg.solve(mass, b), rtol=1e-9)
    found = np.ones(n)
    solve(np.diag([2.0, 0.0, 4.0, 1.0]).ravel(), found, 1)
    np.testing.assert_array_equal(found, [0.5, 0.0, 0.25, 1.0])
