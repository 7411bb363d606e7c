"""The names that are bound when a program is built: each program has others behind them.

The compiler takes this module for the texts that a program is built with. A name that none of them
defines is an error only where a function uses it. Python itself runs no function of this file.
"""

from typing import Any

import numpy as np

from rockeom.compiler.decorators import Floats, Floats2
from rockeom.integrator.records import Arrays, Case, Ground, Motion, Recorder, Rest, Step

Int = int | np.int64
Float = float | np.float64
Shaking = tuple[float, ...]
"""The accelerations of the ground, one along each of the axes."""
Gap = tuple[float, float, float, float, float, float]
"""Bernstein coefficients of a gap, see `gap_at_ends`."""

# -- a generated module: the structure. `shaking` stands for ax, ay, and in space for ax, ay, az.

AXES: int
DIRECTIONS: int  # in which a point moves: along its gap, and its slips
RETURNS_SLIPS: bool  # whether impacts turn slips round, times the restitution
STILL: Shaking  # the accelerations of ground that stands still
N_STATES: int
N_GUARDS: int
N_PARTS: int
N_POINTS: int
N_BOUNDS_OF_DECLARATION: int
FIRST_BOUND: int
CONTACT_SIZE: int
N_ELEMENTS: int
ROTATION: int
ROTATION_RATE: int
N_FALLS: int
FEET_OF: tuple[tuple[int, ...], ...]
POSITIONS: tuple[str, ...]
FALLS: tuple[int, ...]
SIDES: tuple[float, ...]
GUARDS: tuple[int, ...]
KINDS: tuple[tuple[int, ...], ...]
TARGETS: tuple[tuple[int, ...], ...]
REVERSE: tuple[tuple[int, ...], ...]
PARTS: tuple[tuple[int, ...], ...]
POINT_STATES: tuple[tuple[int, ...], ...]
ELEMENT_STATES: tuple[tuple[int, ...], ...]
SHARED: tuple[tuple[int, ...], ...]
SUBJECTS: tuple[tuple[int, ...], ...]
IMPACT_LAW: int
LOCALISED: bool
FULL_CONTACT: int

EQUATIONS: tuple[int, ...]


def rates(mode: Int, y: Floats, p: Floats, *shaking_and_dy: Any) -> None: ...
def opening_acceleration(mode: Int, y: Floats, p: Floats, *shaking: Float) -> float: ...
def guards(mode: Int, y: Floats, p: Floats, *shaking_and_g: Any) -> None: ...
def full_contact_guards(y: Floats, p: Floats, ax: Float, g: Floats) -> None: ...
def jump(
    mode: Int, guard: Int, law: Int, ratio: Float, y: Floats, p: Floats, out: Floats
) -> int: ...
def energies(mode: Int, y: Floats, p: Floats, out: Floats) -> None: ...
def reactions(mode: Int, y: Floats, p: Floats, *shaking_and_out: Any) -> None: ...
def powers(mode: Int, y: Floats, p: Floats, *shaking_and_out: Any) -> None: ...
def statics(mode: Int, y: Floats, p: Floats, load: Float, out: Floats) -> None: ...
def kinematics(mode: Int, y: Floats, p: Floats, out: Floats) -> None: ...
def positions(mode: Int, y: Floats, p: Floats, out: Floats) -> None: ...
def elements(mode: Int, y: Floats, p: Floats, out: Floats) -> None: ...
def shapes(p: Floats, out: Floats) -> None: ...
def overturns_at(number: Int, p: Floats) -> float: ...


# -- of one whose contacts may open, slide and bounce


def free_motion(y: Floats, p: Floats, *shaking_mode_matrix_forces: Any) -> None: ...
def points(y: Floats, p: Floats, out: Floats) -> None: ...
def point_laws(p: Floats, out: Floats) -> None: ...
def point_numbers(p: Floats, out: Floats) -> None: ...


# -- of the printer: numbers with derivatives


def value(x: Float) -> float: ...
def moving(x: Float, rate: Float) -> float: ...
def rate(x: Float) -> float: ...


ANGLES: tuple[float, ...]

# -- the contract of an impact: transitions/newton.py, or transitions/impacts.py


def landed(
    mode: Int, near: Floats, y: Floats, p: Floats, ground: Floats, contact: Floats, out: Floats
) -> int: ...


# -- the contract of modes: transitions/modes_by_table.py

N_MODES: int
N_CANDIDATES: int
EXTRA_CANDIDATES: int
FIRST_FITS: bool
BENT: bool
MOST_FITTING: int
SMOOTH: int


def guards_in(mode: Int) -> int: ...
def kind_of(mode: Int, guard: Int) -> int: ...
def is_tilt(mode: Int, guard: Int) -> bool: ...
def subject_of(mode: Int, guard: Int) -> int: ...
def target_of(mode: Int, guard: Int) -> int: ...
def reverse_of(mode: Int, guard: Int) -> int: ...
def part_of(mode: Int, guard: Int) -> int: ...
def side_of(mode: Int) -> float: ...
def point_state(mode: Int, point: Int) -> int: ...
def without(mode: Int, point: Int) -> int: ...
def element_state(mode: Int, element: Int) -> int: ...
def shares_with(mode: Int, point: Int) -> int: ...


# -- the contract of points that touch: transitions/points_in_plane.py

SIGN_OF: tuple[float, ...]


def is_smooth(point: Int) -> bool: ...
def candidate_of(
    number: Int, extra: Int, mode: Int, near: Floats, sliding: Floats, wanted: Floats,
    contact: Floats, impulse: Floats,
) -> int: ...  # fmt: skip
def impulses_of(candidate: Int, wanted: Floats, contact: Floats, impulse: Floats) -> None: ...
def margin_of(
    candidate: Int, near: Floats, sliding: Floats, wanted: Floats, contact: Floats, sizes: Floats,
    impulse: Floats, least_of_all: Float,
) -> float: ...  # fmt: skip
def slips_begin(mode: Int, sliding: Floats) -> bool: ...
def aim_slips(
    mode: Int, sliding: Floats, wanted: Floats, contact: Floats, motion: Floats
) -> bool: ...
def begin_slips(
    mode: Int, sliding: Floats, wanted: Floats, speed: Float, contact: Floats, y: Floats
) -> None: ...
def stops(kind: Int, point: Int, subject: Int, mode: Int, slip: Float) -> bool: ...
def slides_end(near: Floats, sliding: Floats, contact: Floats) -> bool: ...
def held_upright(mode: Int, y: Floats, p: Floats) -> bool: ...
def tips_over(y: Floats, p: Floats) -> bool: ...


# -- the contract of transitions: transitions/table.py, or transitions/search.py

QUIET_STEPS: bool
EXTRAPOLATES: bool


def initial_mode_is_one(mode: Int, y: Floats, p: Floats, shaking: Shaking) -> bool: ...
def longest_turn(y: Floats) -> float: ...
def jammed(
    motion: Motion, guard: Int, ground: Ground, case: Case, a: Arrays
) -> tuple[int, int]: ...
def just_closed(closed: Int, i: Int) -> bool: ...
def grain_of(
    mode: Int, index: Int, shaking: Shaking, h: Float, b: Floats, stride: Int, case: Case,
    a: Arrays,
) -> float: ...  # fmt: skip
def can_move(mode: Int, y: Floats, p: Floats) -> bool: ...
def standing(mode: Int, y: Floats, p: Floats) -> bool: ...
def free_flight(
    mode: Int, closed: Int, t: Float, y: Floats, p: Floats, k: Floats
) -> tuple[int, float]: ...
def hop_ends(
    motion: Motion, ground: Ground, step: Step, gap: Gap, case: Case, a: Arrays
) -> bool: ...
def without_hop(step: Step) -> Step: ...
def certain_event(
    motion: Motion, ground: Ground, step: Step, gap: Gap, case: Case, a: Arrays
) -> tuple[Int, Float, bool, bool]: ...
def time_to_landing(motion: Motion, step: Step, case: Case, a: Arrays) -> float: ...
def is_rounding(mode: Int, guard: Int, y: Floats, p: Floats) -> bool: ...
def transition(
    motion: Motion,
    ground: Ground,
    guard: Int,
    h: Float,
    end: Float,
    case: Case,
    a: Arrays,
    recorder: Recorder,
) -> tuple[Motion, Rest]: ...
def zeno_time(
    motion: Motion, ground: Ground, end: Float, case: Case, a: Arrays
) -> tuple[Motion, Rest]: ...
def through_rest(
    motion: Motion, ground: Ground, rest: Rest, case: Case, a: Arrays, recorder: Recorder
) -> tuple[Int, bool]: ...


# -- the step of a method

N_STAGES: int
N_ALL_STAGES: int
STAGE_TIMES: Floats
ERROR_EXPONENT: float
COARSE: float
SAMPLES_TO_BERNSTEIN: Floats2
POWERS_TO_BERNSTEIN: Floats2
NODES: Floats
QUINTIC: Floats2
QUARTIC: Floats2


def take_step(
    mode: Int, t: Float, h: Float, y: Floats, p: Floats, ground: Ground, rtol: Float,
    atol: Floats, k: Floats, y_new: Floats,
) -> float: ...  # fmt: skip
def dense_output(
    mode: Int, t: Float, h: Float, y: Floats, p: Floats, ground: Ground, k: Floats,
    coefficients: Floats,
) -> None: ...  # fmt: skip


# -- and the constants of Radau, of which radau_step.py is the step

A: Floats2
A_SQUARED: Floats2
DENSE_PLACE: Floats2
DENSE_VELOCITY: Floats2
G: float
ERROR_PLACE: Floats
ERROR_VELOCITY: Floats

# -- the step of all lanes

LANES: int
N_PARAMETERS: int
PLACES: int
STAGE_PLACES: Floats
NODE_PLACES: Floats
ROOTS: int
POWERS: tuple[tuple[bool, ...], ...]
DAMPING: float
GAP_SIDES: tuple[float, ...]
HELD_MODES: tuple[int, ...]
MOVES: tuple[bool, ...]


def step_lanes(z: Floats, rtol: Float, tolerances: Floats) -> None: ...
