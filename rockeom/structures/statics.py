"""The pushover curve, solved numerically: any structure, any number of other coordinates."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from rockeom.integrator.schema import GeneratedModule, in_space
from rockeom.numbers.checks import InputError, array_of

Equilibrium = tuple[float, np.ndarray]
"""(force, state): the force at the load point [N] that holds a state (N,)."""


def pushover(equilibrium: Callable[[float], Equilibrium], rotations) -> np.ndarray:
    """Force at the load point in equilibrium at each rotation; see Structure.pushover."""
    rotations = angles(rotations)
    forces = np.empty(rotations.shape)
    for index in np.ndindex(rotations.shape):
        forces[index] = equilibrium(float(rotations[index]))[0]
    return forces


_GROWTH = 1.5
"""Ratio of the rotations at which the loss of equilibrium is sought."""


def overturning_angle(equilibrium: Callable[[float], Equilibrium], farthest: float) -> float:
    """Size of the rotation at which the holding force falls to zero, inf where it does not.

    farthest : the rotation up to which it is sought, with the sign of its side. nan where no
    equilibrium was found.
    """

    def holds(part: float) -> float:
        """The force against which the structure stands, at a part of the farthest rotation."""
        return math.copysign(1.0, farthest) * equilibrium(part * farthest)[0]

    try:
        above, below = 0.0, 1e-3
        while below < 1.0 and holds(below) > 0.0:
            above, below = below, min(_GROWTH * below, 1.0)
        if below == 1.0 and holds(1.0) > 0.0:
            return math.inf
        return float(abs(farthest) * _root(holds, above, below))
    except ValueError:
        return math.nan


def _root(function: Callable[[float], float], a: float, b: float) -> float:
    """Where a function of different signs at a and b is zero, by the Illinois method."""
    at_a, at_b = function(a), function(b)
    for _ in range(100):
        if abs(b - a) <= 1e-13 * abs(b) or at_b == 0.0:
            break
        c = b - at_b * (b - a) / (at_b - at_a)
        at_c = function(c)
        if at_b * at_c < 0.0:
            a, at_a = b, at_b
        else:
            at_a *= 0.5
        b, at_b = c, at_c
    return b


def angles(rotations) -> np.ndarray:
    """Rotations as finite floats; raises TypeError or ValueError where one is none."""
    values = array_of("rotations", rotations)
    if not np.isfinite(values).all():
        raise InputError("rotations", values[~np.isfinite(values)][0]).give("finite numbers")
    return values


def balanced(
    state: Callable[[np.ndarray], np.ndarray],
    statics: Callable[[np.ndarray, float], np.ndarray],
    unknowns: int,
    noise: float = 0.0,
) -> Equilibrium:
    """(force, state) in equilibrium; nan where none was found.

    state : of the unknowns; statics : the forces that a state under a load lacks of equilibrium,
    first in the equation that gives the load, that of the rotation where the load acts on it.
    noise : the forces that rounding leaves where large ones balance [N].
    """

    def lacking(unknown: np.ndarray) -> tuple[np.ndarray, float]:
        """The forces that the other equations lack under the load that satisfies the first."""
        y = state(unknown)
        none = statics(y, 0.0)
        load = 1.0 + abs(none[0])  # one newton might be lost next to the other forces
        with_load = statics(y, load)
        with np.errstate(all="ignore"):  # a structure without a load point has none
            share = none[0] / (none[0] - with_load[0])
            return (none + share * (with_load - none))[1:], share * load

    at = np.zeros(unknowns)
    if not unknowns:
        return lacking(at)[1], state(at)
    from scipy import optimize  # slow to import, and needed here alone

    # a metre may be too much or next to nothing: each unknown is counted in the distance at which
    # its own stiffness would restore equilibrium, and each equation likewise
    missing = lacking(at)[0]
    missing[np.abs(missing) <= noise] = 0.0
    small = 1e-6 * np.eye(unknowns)
    stiffness = [
        abs(lacking(e)[0][i] - lacking(-e)[0][i]) / 2e-6 or 1.0 for i, e in enumerate(small)
    ]
    length = np.abs(missing) / stiffness
    length[length <= (1e-6 * length.max() if noise else 0.0)] = length.max() or 1.0
    root = optimize.root(
        lambda x: lacking(length * x)[0] / (stiffness * length),
        at,
        method="hybr",
        options={"xtol": 1e-13},
    )
    at = length * root.x
    left = np.abs(root.fun)
    done = (left <= 1e-8) | (left * stiffness * length <= noise)
    return (lacking(at)[1] if done.all() else np.nan), state(at)


def uplift_accelerations(
    module: GeneratedModule, p: np.ndarray, weight: tuple[float, float] = (0.0, 0.0)
) -> tuple[float, float]:
    """Sizes of ground accelerations at which a structure on rigid ground leans (left, right).

    The force on the opposite foot vanishes there. weight : further accelerations, those of a slope;
    it leans by itself to a side whose acceleration is below zero.

    Unknown are the acceleration and the coordinates that are free in full contact. Their equations
    are linear, but for small terms: Newton's method from rest. In space nothing moves there, and
    the acceleration is that along the direction of the state at rest.
    """
    m = module
    if in_space(m):
        return _leans(m, p, -1.0, weight), _leans(m, p, 1.0, weight)
    n = m.N_STATES // 2
    mode = m.MODES.index("both")
    free = [i for i in range(n) if i != m.ROTATION]
    steps = np.array([1.0, *(1e-3 for _ in free)])

    def lacking(unknown: np.ndarray, foot: int) -> np.ndarray:
        y, rates, forces = np.zeros(2 * n), np.zeros(2 * n), np.zeros(len(m.REACTIONS))
        y[free] = unknown[1:]
        across, up = unknown[0] + weight[0], weight[1]
        m.rates(mode, y, p, across, up, rates)
        m.reactions(mode, y, p, across, up, forces)
        return np.array([forces[foot], *rates[[n + i for i in free]]])

    def lifts(foot: int, way: float) -> float:
        unknown = np.zeros(1 + len(free))
        for _ in range(50):
            value = lacking(unknown, foot)
            slopes = np.transpose(
                [(lacking(unknown + h, foot) - value) / h.max() for h in np.diag(steps)]
            )
            # a coordinate that is held has no equation, and stays
            moves: np.ndarray = np.abs(slopes).max(axis=1) > 0.0
            moves[0] = True
            change = np.zeros_like(unknown)
            try:
                change[moves] = np.linalg.solve(slopes[np.ix_(moves, moves)], -value[moves])
            except np.linalg.LinAlgError:
                return math.inf  # all its mass is on the ground
            unknown += change
            if abs(change[0]) <= 1e-13 * abs(unknown[0]):
                break
        return way * float(unknown[0])

    left, right = (
        lifts(m.REACTIONS.index(f"{foot}_reaction"), way)
        for foot, way in (("right", 1.0), ("left", -1.0))
    )
    return left, right


def _leans(m: Any, p: np.ndarray, side: float, weight: tuple[float, float]) -> float:
    """Size of the first component of the ground at which a gap opens: by a straight line."""
    mode, rest = m.SIDES.index(side), np.zeros(m.N_STATES)
    opens = [
        float(m.opening_acceleration(mode, rest, p, weight[0] - side * a, 0.0, weight[1]))
        for a in (0.0, 1.0)
    ]
    return opens[0] / (opens[0] - opens[1])
