"""Modes by their numbers in tables: what a generated module's tables say of each.

The contract of modes, as modes_by_code.py fulfils it for those whose number is a code of digits.
"""

from rockeom.compiler.decorators import inlined
from rockeom.integrator.provided import (
    ELEMENT_STATES,
    GUARDS,
    KINDS,
    PARTS,
    POINT_STATES,
    REVERSE,
    SHARED,
    SIDES,
    SUBJECTS,
    TARGETS,
)

N_MODES = N_CANDIDATES = MOST_FITTING = len(SIDES)
EXTRA_CANDIDATES = 0
FIRST_FITS = False  # whether of several candidates that move differently the first one follows
BENT = False  # whether a guard bends so much in a step that its slope is not that of a polynomial


@inlined
def guards_in(mode):
    """The number of guards of a mode."""
    return GUARDS[mode]


@inlined
def kind_of(mode, guard):
    """The kind of event with which a guard of a mode ends it."""
    return KINDS[mode][guard]


@inlined
def is_tilt(mode, guard):
    """No guard is the tilt of a body: that overturns by its rotation."""
    return False


@inlined
def subject_of(mode, guard):
    """The point of a guard, or its element, numbered behind the points."""
    return SUBJECTS[mode][guard]


@inlined
def target_of(mode, guard):
    """The mode to which a guard leads."""
    return TARGETS[mode][guard]


@inlined
def reverse_of(mode, guard):
    """The guard of the mode that follows by which it leads back, or -1."""
    return REVERSE[mode][guard]


@inlined
def part_of(mode, guard):
    """The place of the two parts of a guard that is the larger of both, or -1."""
    return PARTS[mode][guard]


@inlined
def side_of(mode):
    """The side to which a structure leans in a mode, 0 where it stands or the mode has none."""
    return SIDES[mode]


@inlined
def without(mode, point):
    """The mode itself: none follows by its number."""
    return mode


@inlined
def point_state(mode, point):
    """The state of a point in a mode."""
    return POINT_STATES[mode][point]


@inlined
def element_state(mode, element):
    """The state of an element in a mode."""
    return ELEMENT_STATES[mode][element]


@inlined
def shares_with(mode, point):
    """The first of the points with which a point shares its friction in a mode."""
    return SHARED[mode][point]
