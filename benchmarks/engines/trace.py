"""A motion in samples, and the numbers that are read from it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

X, Z, ROTATION, X_RATE, Z_RATE, RATE = range(6)
FALLEN = 1.2  # rad; no block of the suite comes back from there


class UnsupportedError(Exception):
    """A case that a program cannot state; the message says why."""


@dataclass(frozen=True)
class Trace:
    """t (n,) [s]; bodies: name to (n, 6) of x, z, rotation and their rates, as in the cases."""

    t: np.ndarray
    bodies: Mapping[str, np.ndarray]


def ground(model: Mapping) -> Callable[[float], float]:
    """Acceleration of the ground of a model [m/s2], by time [s]."""
    motion = model["ground_motion"]
    if motion is None:
        return lambda t: 0.0
    end = motion.get("end")
    end = math.inf if end is None else end
    if motion["kind"] == "sine":
        size, frequency = motion["amplitude"], motion["angular_frequency"]
        return lambda t: size * math.sin(frequency * t) if t < end else 0.0
    powers = motion["coefficients"][::-1]
    return lambda t: float(np.polyval(powers, t)) if t < end else 0.0


# -- measures ------------------------------------------------------------------------------------


def measured(trace: Trace, measure: Mapping) -> float | None:
    """The number that a measure asks for; None where the motion does not have it."""
    rows = trace.bodies[measure["body"]]
    return MEASURES[measure["what"]](trace.t, rows, measure)


def crossing(t: np.ndarray, y: np.ndarray, slope: np.ndarray, level: float, n: int = 1):
    """Step and time in which y passes through a level for the n-th time, by a cubic in the step."""
    y = y - level
    passes = np.nonzero((y[:-1] > 0) != (y[1:] > 0))[0]
    passes = passes[passes > 0]
    if len(passes) < n:
        return None
    i = int(passes[n - 1])
    h, a, b = t[i + 1] - t[i], y[i], y[i + 1]
    p, q = h * slope[i], h * slope[i + 1]
    roots = np.roots([2 * a - 2 * b + p + q, -3 * a + 3 * b - 2 * p - q, p, a])
    inside = [x.real for x in roots if abs(x.imag) < 1e-9 and -1e-9 <= x.real <= 1 + 1e-9]
    return i, float(t[i] + h * min(inside, default=a / (a - b)))


def _zero(t, rows, measure):
    found = crossing(t, rows[:, ROTATION], rows[:, RATE], 0.0, measure["n"])
    return found and found[1]


def _rate_before_zero(t, rows, measure):
    """On a line through two samples: a soft contact may act on the last one before it."""
    found = crossing(t, rows[:, ROTATION], rows[:, RATE], 0.0, measure["n"])
    return found and _before(t, rows, *found)


def _before(t, rows, i: int, when: float) -> float | None:
    if i < 2:
        return None
    slope = (rows[i - 1, RATE] - rows[i - 2, RATE]) / (t[i - 1] - t[i - 2])
    return float(rows[i - 1, RATE] + (when - t[i - 1]) * slope)


def _at(column: int, slope: int | None):
    def value(t, rows, measure):
        """By the cubic through the ends of its step, where the rate is known."""
        when = measure["time"]
        if when > t[-1] + 1e-9:
            return None
        i = min(max(int(np.searchsorted(t, when)) - 1, 0), len(t) - 2)
        h = t[i + 1] - t[i]
        s = (when - t[i]) / h
        a, b = rows[i, column], rows[i + 1, column]
        if slope is None:
            return float(a + s * (b - a))
        p, q = h * rows[i, slope], h * rows[i + 1, slope]
        return float(a + s * (p + s * (-3 * a + 3 * b - 2 * p - q + s * (2 * a - 2 * b + p + q))))

    return value


def _time_of_rotation(t, rows, measure):
    found = crossing(t, rows[:, ROTATION], rows[:, RATE], measure["rotation"])
    return found and found[1]


def _rate_at_rotation(t, rows, measure):
    found = crossing(t, rows[:, ROTATION], rows[:, RATE], measure["rotation"])
    return found and _before(t, rows, *found)


def _peak(t, rows, measure):
    """The first largest rotation to a side."""
    turn, rate = measure["sign"] * rows[:, ROTATION], measure["sign"] * rows[:, RATE]
    tops = np.nonzero((rate[:-1] > 0) & (rate[1:] <= 0) & (turn[:-1] > 0.02))[0]
    return float(measure["sign"] * turn[tops[0] : tops[0] + 2].max()) if len(tops) else None


def _landing(t, rows, measure):
    """When the centroid is first pushed up after it fell freely."""
    pushed = np.diff(rows[:, Z_RATE]) > 0
    starts = np.nonzero(pushed[1:] & ~pushed[:-1])[0] + 1
    return float(t[starts[measure["n"] - 1]]) if len(starts) >= measure["n"] else None


def _lowest(t, rows, measure):
    """How far the centroid comes below a height, by the parabola in which it turns."""
    rate = rows[:, Z_RATE]
    turns = np.nonzero((rate[:-1] < 0) & (rate[1:] >= 0))[0]
    if not len(turns):
        return None
    i = int(turns[0])
    part = rate[i] / (rate[i] - rate[i + 1])
    fallen = 0.5 * (t[i + 1] - t[i]) * part * rate[i]
    return float(measure["height"] - rows[i, Z] - fallen)


MEASURES = {
    "zero_of_rotation": _zero,
    "rate_before_zero": _rate_before_zero,
    "rotation": _at(ROTATION, RATE),
    "rate": _at(RATE, None),
    "x": _at(X, X_RATE),
    "x_rate": _at(X_RATE, None),
    "time_of_rotation": _time_of_rotation,
    "rate_at_rotation": _rate_at_rotation,
    "peak": _peak,
    "landing": _landing,
    "lowest": _lowest,
}
"""By what a measure asks for; "threshold_duration" is a bisection of motions, see the runners."""


# -- a case by a program -------------------------------------------------------------------------

Run = Callable[[Mapping, float], Trace]


def numbers(run: Run, case: Mapping, step: float) -> dict[str, float | None]:
    """All that is measured of a case, by the name of its quantity."""
    asked = {q["name"]: q["measure"] for q in case["quantities"] if q["measure"]}
    thresholds = {k: m for k, m in asked.items() if m["what"] == "threshold_duration"}
    found: dict[str, float | None] = {
        name: threshold(run, case, step, measure) for name, measure in thresholds.items()
    }
    if len(thresholds) < len(asked):
        trace = run(case, step)
        if not all(np.isfinite(rows).all() for rows in trace.bodies.values()):
            raise ArithmeticError("the motion is not finite")
        found |= {
            name: measured(trace, measure)
            for name, measure in asked.items()
            if name not in thresholds
        }
    return found


def threshold(run: Run, case: Mapping, step: float, measure: Mapping) -> float | None:
    """The shortest duration of a pulse that overturns, by bisection to a quarter of the step."""

    def falls(duration: float) -> bool:
        motion = {**case["model"]["ground_motion"], "end": duration}
        model = {**case["model"], "ground_motion": motion}
        rows = run({**case, "model": model}, step).bodies[measure["body"]]
        return bool((np.abs(rows[:, ROTATION]) > FALLEN).any())

    low, high = measure["between"]
    if falls(low) or not falls(high):
        return None
    while high - low > max(0.25 * step, 1e-4):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return 0.5 * (low + high)
