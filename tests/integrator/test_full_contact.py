"""What the loop knows of a structure that moves on both its feet, and of how it comes to stand.

Its functions are run as plain Python, and compared with the guards, rates and jumps of the
generated module alone.
"""

import functools
import math

import numpy as np
import pytest
from scipy.interpolate import BPoly
from scipy.optimize import brentq

from tests.oracle.ways import python
from tests.typical import column, oscillator

COLUMN = column()
OSCILLATOR = oscillator()
STRUCTURES = pytest.mark.parametrize(
    "structure", [COLUMN, OSCILLATOR], ids=["flexible_structure", "uplifting_oscillator"]
)
QUIET = (0.0, math.inf, 0.0, 0.0, 0.0, 0.0, 0.0)


@functools.cache
def loop(structure):
    """All functions of a program as Python runs them."""
    return python(structure.module, "DOP853")


def constants(structure):
    m = structure.module
    return m.prepare(np.array([float(structure.parameters()[name]) for name in m.PARAMETERS]))


def stays(structure, h, ends, gx, gy=QUIET):
    """Whether the loop calls a step in full contact open, from (y, acceleration) at both ends."""
    f = loop(structure)
    (y, at_start), (y_new, at_end) = ends
    a = f["arrays_of"](y, np.zeros(4), np.zeros(f["SCRATCH"]))
    a.y_new[:], a.k[3], a.k[f["N_STAGES"] * 4 + 3] = y_new, at_start, at_end
    case = f["Case"](*[None] * len(f["Case"]._fields))._replace(p=constants(structure))
    return f["stays_held"](
        f["FULL_CONTACT"], 0.0, h, tuple(f["Segment"](0, row) for row in (gx, gy)), case, a
    )


def least_guard(structure, h, ends, line):
    """The smallest guard at 200 places of the quintic through both ends."""
    m = structure.module
    (y, a), (y_new, a_new) = ends
    path = BPoly.from_derivatives([0.0, h], [[y[1], y[3], a], [y_new[1], y_new[3], a_new]])
    slope, g, p = path.derivative(), np.zeros(2), constants(structure)
    found = []
    for t in np.linspace(0.0, h, 200):
        y = np.array([0.0, path(t), 0.0, slope(t)])
        m.guards(m.FULL_CONTACT, y, p, line[3] + line[4] * t, 0.0, g)
        found += [*g]
    return min(found)


def moved(ends, by):
    """The same step with the column bent further."""
    return [(y + np.array([0.0, by, 0.0, 0.0]), a) for y, a in ends]


@STRUCTURES
def test_step_in_which_a_foot_barely_lifts_is_not_called_open(structure):
    random = np.random.default_rng(11)
    limit = structure.half_width * 9.81 * structure.mass / structure.stiffness / structure.height
    for _ in range(20):
        h = random.uniform(0.004, 0.02)
        u = np.polynomial.Polynomial(random.uniform(-0.2, 0.2, 4) * limit / h ** np.arange(4))
        v = u.deriv()
        ends = [(np.array([0.0, u(t), 0.0, v(t)]), v.deriv()(t)) for t in (0.0, h)]
        law = (0.0, 1.0, 0.0, random.uniform(-4, 4), random.uniform(-200, 200), 0.0, 0.0)

        def least(by, h=h, ends=ends, law=law):
            return least_guard(structure, h, moved(ends, by), law)

        lifts = brentq(least, 0.0, 5.0 * limit)
        assert not stays(structure, h, moved(ends, 1.001 * lifts), law)
        assert stays(structure, h, moved(ends, 0.2 * lifts), law)


@STRUCTURES
def test_guard_that_is_nearly_closed_all_along_is_looked_at(structure):
    held, line = [(np.zeros(4), 0.0)] * 2, (0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    lifts = brentq(lambda by: least_guard(structure, 0.01, moved(held, by), line), 0.0, 0.1)
    assert not stays(structure, 0.01, moved(held, 0.999 * lifts), line)
    assert stays(structure, 0.01, moved(held, 0.99 * lifts), line)


def test_ground_that_lifts_within_a_step_is_seen_whatever_its_law():
    held = [(np.zeros(4), 0.0)] * 2
    line = (0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert stays(COLUMN, 0.01, held, line)
    # down faster than it falls, in the middle of the step only, or at its end
    assert not stays(COLUMN, 0.01, held, line, (0.0, 1.0, 1.0, -20.0, math.pi / 0.01, 0.0, 0.0))
    assert not stays(COLUMN, 0.01, held, line, (0.0, 1.0, 0.0, 0.0, -2000.0, 0.0, 0.0))
    assert not stays(COLUMN, 0.01, held, line, (0.0, 1.0, 0.0, -20.0, 0.0, 0.0, 0.0))
    size = 1.1 * 9.81 * 0.285 * (122.6 + 45.6) / (45.6 * 0.10)  # lifts a stiff column's base
    assert not stays(COLUMN, 0.01, held, (0.0, 1.0, 1.0, size, math.pi / 0.01, 0.0, 0.0))
    assert not stays(COLUMN, 0.01, held, (0.0, 1.0, 0.0, 0.0, 100.0 * size, 0.0, 0.0))
    assert not stays(COLUMN, 0.01, [held[0], (np.full(4, math.nan), math.nan)], line)


@STRUCTURES
@pytest.mark.parametrize("law", [(0.0, 1.0, 0.0, 0.7, 30.0, 0.0, 0.0), (0.0, 1.0, 1.0, 2, 9, 0, 0)])
def test_step_on_both_feet_is_the_step_of_every_mode(structure, law):
    f = dict(loop(structure))
    random = np.random.default_rng(5)
    names = f["take_step"].__globals__
    ground = f["Segment"](0, law), f["Segment"](0, QUIET)
    for _ in range(5):
        y = np.array([0.0, random.uniform(-1e-3, 1e-3), 0.0, random.uniform(-0.3, 0.3)])
        found = []
        for held in (f["FULL_CONTACT"], -1):
            k, y_new = np.zeros(f["SCRATCH"]), np.zeros(4)
            structure.module.rates(f["FULL_CONTACT"], y, constants(structure), 0.7, 0.0, k)
            names["FULL_CONTACT"] = held
            error = f["take_step"](
                f["FULL_CONTACT"], 0.0, 0.004, y, constants(structure), ground, 1e-10,
                np.full(4, 1e-12), k, y_new,
            )  # fmt: skip
            found.append([error, *y_new, *k])
        names["FULL_CONTACT"] = f["FULL_CONTACT"]
        assert found[0] == found[1]


@pytest.mark.parametrize("ratio", [0.05, 0.8, 0.97])
def test_time_to_rest_is_that_of_all_flights_one_by_one(ratio):
    f, m, p = loop(COLUMN), COLUMN.module, constants(COLUMN)
    random = np.random.default_rng(3)
    finite = 0
    for _ in range(40):
        speed = 10.0 ** random.uniform(-4.0, -1.5)
        u, u_dot, ax = random.uniform(-1.0, 1.0, 3) * [5e-4, 0.05, 2.0]
        right = m.MODES.index("right")
        y = np.array([0.0, u, speed, u_dot])
        rate, out = np.zeros(4), np.zeros(4)
        m.rates(right, y, p, ax, 0.0, rate)
        rests, _ = f["time_to_rest"](right, y, p, 0, ratio, 0, (ax, 0.0), 1e-2, out)
        assert math.isinf(rests) or f["may_fade"](1.0, y, rate, 0, ratio, 1e-2)
        if math.isinf(rests):
            continue
        finite += 1
        assert rests == pytest.approx(flights(m, p, right, y, ratio, ax), rel=1e-12)
    assert finite > 5


def flights(m, p, mode, y, ratio, ax):
    """Time of the flights between impacts, each a parabola, until their speeds are nothing."""
    total, y, rate, after = 0.0, y.copy(), np.zeros(4), np.zeros(4)
    start = abs(y[2])
    while abs(y[2]) > 1e-18 * start:
        m.rates(mode, y, p, ax, 0.0, rate)
        flight = -2.0 * y[2] / rate[2]
        total += flight
        y += flight * rate
        y[0] = 0.0
        mode = m.jump(mode, 0, m.RATIO, ratio, y, p, after)
        y[:] = after
    return total
