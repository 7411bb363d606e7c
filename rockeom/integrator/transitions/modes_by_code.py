"""Modes whose number is a code of digits, one for the state of each point: modes in space.

The contract of modes, as modes_by_table.py fulfils it for those that a table lists. Guards of
points come first, then those of bounds.
"""

from rockeom.codes import (
    BEARS,
    BOUND,
    FRICTIONLESS,
    IDLE_POINT,
    IDLES,
    LANDING,
    LIFTING,
    OPEN,
    SLIP_RIGHT,
    SLIPPING,
    STICK,
    STICKING,
)
from rockeom.compiler.decorators import inlined
from rockeom.generated.numeric_modes import PLACE_VALUES, digit_of, is_smooth_by, slips_by
from rockeom.integrator.provided import (
    FIRST_BOUND,
    N_BOUNDS_OF_DECLARATION,
    N_GUARDS,
    N_POINTS,
    SMOOTH,
)

N_MODES = 0  # whose guards of elements have rounding errors of their own: no element switches
N_CANDIDATES = 2 * 3**N_POINTS  # see points_in_space.py
EXTRA_CANDIDATES = 2 * N_POINTS  # by how many points are released, and whether those would pull
FIRST_FITS = True  # of several candidates that move differently the first: more points closed
BENT = True  # guards of sticking bend in a step: their slope is not that of a polynomial
MOST_FITTING = 64  # candidates that move alike


@inlined
def guards_in(mode):
    """The number of guards of a mode."""
    return N_GUARDS


@inlined
def point_of(guard):
    """The point of a guard: first come those of gaps, then twice those of slips."""
    point = guard if guard < N_POINTS else guard - N_POINTS
    return point if point < N_POINTS else point - N_POINTS


@inlined
def kind_of(mode, guard):
    """The kind of event with which a guard of a mode ends it."""
    if guard >= FIRST_BOUND:
        return BOUND
    digit = digit_of(mode, point_of(guard))
    if guard >= N_POINTS:
        return STICKING if slips_by(digit) else SLIPPING
    return LANDING if digit == OPEN else LIFTING


@inlined
def is_tilt(mode, guard):
    """Whether a guard is the tilt at which a body has overturned: those are the last ones."""
    return guard >= FIRST_BOUND + N_BOUNDS_OF_DECLARATION


@inlined
def subject_of(mode, guard):
    """The point of a guard, or its bound, numbered behind the points."""
    return point_of(guard) if guard < FIRST_BOUND else guard - FIRST_BOUND + N_POINTS


@inlined
def target_of(mode, guard):
    """No guard leads to a certain mode."""
    return -1


@inlined
def reverse_of(mode, guard):
    """No guard leads back."""
    return -1


@inlined
def part_of(mode, guard):
    """No guard is the larger of two."""
    return -1


@inlined
def side_of(mode):
    """No mode has a side."""
    return 0.0


@inlined
def without(mode, point):
    """The mode in which a point is open."""
    return mode - digit_of(mode, point) * PLACE_VALUES[point]


@inlined
def point_state(mode, point):
    """The state of a point in a mode; a released one has no friction."""
    digit = digit_of(mode, point)
    if digit == IDLES:
        return IDLE_POINT
    if slips_by(digit):
        return SLIP_RIGHT
    if digit == BEARS and not is_smooth_by(SMOOTH, point):
        return STICK
    return OPEN if digit == OPEN else FRICTIONLESS


@inlined
def element_state(mode, element):
    """No element switches."""
    return 0


@inlined
def shares_with(mode, point):
    """The point itself: none shares friction."""
    return point
