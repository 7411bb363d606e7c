"""A step in which guards are said to stay open: none of them falls in it."""

import numpy as np
import pytest

from rockeom.numeric.program import _own

TEXT = {"N_STATES": 2, "N_POINTS": 1, "GUARDS": (1,), "shaking": lambda _row, t: t}
exec(_own("contacts.py"), TEXT)


def at(cubic, t):
    return cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]))


def certified(cubic, touching):
    """Of a guard that is a cubic of time, in a step from 0 to 1."""

    def guards(_contact, _y, _p, t, _ay, g):
        g[0] = at(cubic, t)

    TEXT["guards"] = guards
    still = np.zeros(2)
    return TEXT["stays_within"](
        0, 0.0, 1.0, still, still, np.zeros(4), 2, None, None, None, np.zeros(2), np.zeros(1),
        np.zeros(4), False, touching,
    )  # fmt: skip


@pytest.mark.parametrize("closed", [False, True])
def test_no_cubic_that_falls_is_said_to_stay_open(closed):
    """Cubics of all shapes, of which those from a closed guard may open and fall again."""
    rng, told = np.random.default_rng(5), 0
    places = np.linspace(0.0, 1.0, 2001)[1:]
    for _ in range(4000):
        cubic = rng.normal(size=4) * 10.0 ** rng.uniform(-2.0, 1.0, 4)
        cubic[0] = 0.0 if closed else abs(cubic[0])
        if certified(cubic, 1 if closed else -1):
            told += 1
            assert at(cubic, places).min() > 0.0, cubic
    assert told > 100


def test_coordinates_move_by_their_mass():
    """Against numpy; what has no inertia stays."""
    rng, n = np.random.default_rng(6), 4
    text = {"N_STATES": 2 * n, "N_POINTS": 1}
    exec(_own("contacts.py"), text)
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
