"""Overturning angles and the separatrix of a structure in the plane, as a page asks for them.

This text is joined to others, see `rockeom.browser.page`.
"""

import math

import numpy as np

from rockeom.browser.places import OF_FALLEN
from rockeom.compiler.decorators import Floats, Floats2, entry
from rockeom.integrator.provided import (
    N_MODES,
    N_STATES,
    ROTATION,
    ROTATION_RATE,
    energies,
    side_of,
    statics,
)


@entry
def balance(p: Floats, numbers: Floats, angles: Floats, separatrix: Floats2):
    """The overturning angles (2,) to the left and right, 0 where none is found.

    separatrix (2, n) : of one coordinate, rotations and the rates there with which a free motion
    just comes to the overturning angle of its side.
    """
    y = np.empty(N_STATES)
    half = separatrix.shape[1] // 2
    for k in range(2):
        side, fallen = 2.0 * k - 1.0, numbers[OF_FALLEN]
        mode = only_mode(side)
        angles[k] = 0.0
        if min(mode, only_mode(0.0)) >= 0 and fallen < np.inf:
            angles[k] = overturning_angle(mode, side, fallen, y, p)
        if N_STATES > 2 or angles[k] == 0.0:
            continue
        most = potential(mode, side * angles[k], 0.0, y, p)
        for i in range(half):
            part = 1.0 - i / (half - 1.0) if k == 0 else i / (half - 1.0)
            rotation = side * part * min(1.5 * angles[k], fallen)
            low = potential(mode, rotation, 0.0, y, p)
            of_rate = potential(mode, rotation, 1.0, y, p) - low
            at = k * half + i
            separatrix[0, at] = rotation
            separatrix[1, at] = math.sqrt(max(most - low, 0.0) / of_rate)


def only_mode(side):
    """The mode on a side, -1 where there is none or elements make several of it."""
    only = -1
    for mode in range(N_MODES):
        if side_of(mode) == side:
            if only >= 0:
                return -1
            only = mode
    return only


def potential(mode, rotation, rate, y, p):
    """Energy of one coordinate at a rotation and a rate."""
    energy = np.empty(3)
    y[ROTATION], y[ROTATION_RATE] = rotation, rate
    energies(mode, y, p, energy)
    return energy[0] + energy[1] + energy[2]


def overturning_angle(mode, side, fallen, y, p):
    """The rotation at which nothing drives the structure back, 0 if it is not below `fallen`."""
    for i in range(N_STATES):
        y[i] = 0.0
    low, high, falls = 0.0, 0.0, False
    for i in range(1, 65):
        high = fallen * i / 64
        if side * held_back(mode, side * high, y, p) <= 0.0:
            falls = True
            break
        low = high
    if not falls:
        return 0.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        if side * held_back(mode, side * middle, y, p) <= 0.0:
            high = middle
        else:
            low = middle
    return high


def held_back(mode, rotation, y, p):
    """Moment against a rotation, the other coordinates in equilibrium, each in turn by Newton."""
    lack, ahead = np.empty(N_STATES // 2), np.empty(N_STATES // 2)
    y[ROTATION] = rotation
    for _ in range(12):
        for j in range(N_STATES // 2):
            if j == ROTATION:
                continue
            statics(mode, y, p, 0.0, lack)
            y[j] += 1e-6
            statics(mode, y, p, 0.0, ahead)
            y[j] -= 1e-6 + 1e-6 * lack[j] / (ahead[j] - lack[j])
    statics(mode, y, p, 0.0, lack)
    return lack[ROTATION]
