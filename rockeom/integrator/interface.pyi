"""What the loop and the lanes ask for by name of the texts that are joined before them.

Nobody imports this: `rockeom.integrator.program` joins the texts, and these names are those of the
generated module and of the method's step.
"""

import numpy as np

from rockeom.compiler.decorators import Floats, Floats2, Ints

Int = int | np.int64
Float = float | np.float64
Row = tuple[float, float, float, float, float, float, float]
"""A law of the ground: start, end, kind, and its constants, see `rockeom.motion.segments`."""

# -- a generated module: the structure

N_STATES: int
N_GUARDS: int
N_PARTS: int
N_POINTS: int
N_ELEMENTS: int
ROTATION: int
ROTATION_RATE: int
N_FALLS: int
FALLS: tuple[int, ...]
SIDES: tuple[float, ...]
GUARDS: tuple[int, ...]
KINDS: tuple[tuple[int, ...], ...]
TARGETS: tuple[tuple[int, ...], ...]
CLOSED: tuple[tuple[int, ...], ...]
PARTS: tuple[tuple[int, ...], ...]
POINT_STATES: tuple[tuple[int, ...], ...]
ELEMENT_STATES: tuple[tuple[int, ...], ...]
SHARED: tuple[tuple[int, ...], ...]
SUBJECTS: tuple[tuple[int, ...], ...]
NARROW: bool
HELD: int

ROUNDER: float

def rates(contact: Int, y: Floats, p: Floats, ax: Float, ay: Float, dy: Floats) -> None: ...
def opening_acceleration(contact: Int, y: Floats, p: Floats, ax: Float, ay: Float) -> float: ...
def guards(contact: Int, y: Floats, p: Floats, ax: Float, ay: Float, g: Floats) -> None: ...
def held_guards(y: Floats, p: Floats, ax: Float, g: Floats) -> None: ...
def jump(
    contact: Int, guard: Int, law: Int, ratio: Float, y: Floats, p: Floats, out: Floats
) -> Int: ...
def energies(contact: Int, y: Floats, p: Floats, out: Floats) -> None: ...
def reactions(contact: Int, y: Floats, p: Floats, ax: Float, ay: Float, out: Floats) -> None: ...
def kinematics(contact: Int, y: Floats, p: Floats, out: Floats) -> None: ...
def overturns_at(number: Int, p: Floats) -> float: ...

# -- of one whose contacts may open, slide and bounce

def free_motion(
    y: Floats, p: Floats, ax: Float, ay: Float, contact: Int, matrix: Floats, forces: Floats
) -> None: ...
def points(y: Floats, p: Floats, out: Floats) -> None: ...
def point_laws(p: Floats, out: Floats) -> None: ...
def sine_cosine(x: Float) -> tuple[float, float]: ...

# -- of the printer: numbers with derivatives

def value(x: Float) -> float: ...
def moving(x: Float, rate: Float) -> float: ...
def rate(x: Float) -> float: ...

# -- loop.py

def sine(x: Float) -> float: ...
def row_at(table: Floats2, n: Int, t: Float) -> tuple[Int, Row]: ...
def row_of(table: Floats2, n: Int) -> Row: ...
def cannot_move(contact: Int, rate: Floats, y: Floats, p: Floats) -> bool: ...
def ratio_at(law: Int, ratio: Float, impact: Int, y: Floats, p: Floats) -> float: ...
def time_to_rest(
    contact: Int, y: Floats, p: Floats, law: Int, ratio: Float, impacts: Int, ax: Float, ay: Float,
    tolerance: Float, w: Floats, out: Floats, kick: Floats,
) -> tuple[float, int]: ...  # fmt: skip
def stand(
    contact: Int, t: Float, h: Float, y: Floats, p: Floats, gx: Row, gy: Row, rtol: Float,
    atol: Floats, k: Floats, y_new: Floats,
) -> bool: ...  # fmt: skip

# -- contacts.py

def but_for_rounding(sum_: Float, size: Float) -> float: ...
def is_closed(touching: Int, i: Int) -> bool: ...

ANGLES: tuple[float, ...]
N_COORDINATES: int
POINT: int
ROW: int
ROWS: int
MATRIX: int
COUPLING: int
LAWS: int
N_KNOWN: int
GRAIN: float
FITS: float
SIGN_OF: tuple[float, ...]

def guard_noise(
    contact: Int, index: Int, y: Floats, p: Floats, ax: Float, ay: Float, h: Float, b: Floats,
    stride: Int,
) -> float: ...  # fmt: skip
def longest_turn(y: Floats) -> float: ...
def fall_within(
    contact: Int, t: Float, h: Float, y: Floats, y_new: Floats, k: Floats, end: Int, p: Floats,
    gx: Row, gy: Row, w: Floats, samples: Floats,
    sampled: bool, touching: Int, hop: Int,
) -> tuple[int, float]: ...  # fmt: skip
def only_hop(
    contact: Int, touching: Int, y: Floats, p: Floats, dy: Floats
) -> tuple[int, float]: ...
def to_landing(contact: Int, guard: Int, y: Floats, p: Floats, dy: Floats) -> float: ...
def is_rounding(contact: Int, guard: Int, y: Floats, p: Floats) -> bool: ...
def end_closed(contact: Int, samples: Floats) -> bool: ...
def shaking(row: Row, t: Float) -> float: ...
def pass_on(
    contact: Int, guard: Int, h: Float, y: Floats, p: Floats, ax: Float, ay: Float,
    later_x: Float, later_y: Float, tau: Float, rtol: Float, known: Floats, out: Floats,
) -> tuple[Int, Int]: ...  # fmt: skip
def still_closed(before: Int, follows: Int, guard: Int, closed: Int, touching: Int) -> Int: ...
def meet(
    contact: Int, guard: Int, near: Ints, y: Floats, p: Floats, ax: Float, ay: Float,
    later_x: Float, later_y: Float, tau: Float, rtol: Float, known: Floats, out: Floats,
) -> tuple[Int, Int]: ...  # fmt: skip
def is_smooth(point: Int) -> bool: ...
def go_on_as(
    contact: Int, ends: bool, near: Ints, sliding: Floats, y: Floats, p: Floats, ax: Float,
    ay: Float, later_x: Float, later_y: Float, tau: Float, rtol: Float, known: Floats,
    sizes: Floats,
) -> Int: ...  # fmt: skip
def without_forces(
    y: Floats, p: Floats, ax: Float, ay: Float, contact: Int, known: Floats, wanted: Floats,
    sizes: Floats,
) -> float: ...  # fmt: skip
def all_known(y: Floats, p: Floats, contact: Int, known: Floats) -> None: ...
def put_on(rows: Ints, wanted: Floats, first: Int, known: Floats, y: Floats) -> None: ...
def rate_of(told: Floats, row: Int, y: Floats, first: Int) -> tuple[float, float]: ...
def gap_rounding(told: Floats, y: Floats) -> float: ...
def radius_of(known: Floats, point: Int) -> float: ...
def acceleration_of(told: Floats, row: Int, dy: Floats) -> float: ...
def collide(contact: Int, near: Ints, slowest: Float, known: Floats, y: Floats) -> Int: ...
def through_mass(matrix: Floats, b: Floats, width: Int) -> None: ...
def squared(known: Floats, x: Floats) -> float: ...
def fits_by_forces(contact: Int, y: Floats, p: Floats, ax: Float, ay: Float) -> Int: ...
def nothing_moves(contact: Int, y: Floats, p: Floats) -> bool: ...
def held_upright(contact: Int, y: Floats, p: Floats) -> bool: ...

# -- bounces.py

def time_of_bounces(
    contact: Int,
    y: Floats,
    p: Floats,
    ax: Float,
    ay: Float,
    tolerance: Float,
    rtol: Float,
    known: Floats,
    out: Floats,
) -> tuple[float, int]: ...
def step_over(
    contact: Int, y: Floats, p: Floats, ax: Float, ay: Float, tolerance: Float, longest: Float,
    fits: bool, rtol: Float, known: Floats, out: Floats,
) -> tuple[float, int]: ...  # fmt: skip

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
    contact: Int, t: Float, h: Float, y: Floats, p: Floats, gx: Row, gy: Row, rtol: Float,
    atol: Floats, k: Floats, y_new: Floats,
) -> float: ...  # fmt: skip
def dense_output(
    contact: Int, t: Float, h: Float, y: Floats, p: Floats, gx: Row, gy: Row, k: Floats,
    coefficients: Floats,
) -> None: ...  # fmt: skip

# -- the step of all lanes

LANES: int
N_PARAMETERS: int
PLACES: int
STAGE_PLACES: Floats
NODE_PLACES: Floats
DAMPING: float
GAP_SIDES: tuple[float, ...]

def shake_lanes(z: Floats, times: Floats) -> None: ...
def bend_x_lanes(z: Floats, times: Floats) -> None: ...
def bend_y_lanes(z: Floats, times: Floats) -> None: ...
def control_lanes(z: Floats) -> None: ...
def step_lanes(z: Floats, rtol: Float, tolerances: Floats) -> None: ...
def judge_lanes(z: Floats, coarse: Float) -> None: ...
def judge_held_lanes(z: Floats, coarse: Float) -> None: ...
def accept_lanes(z: Floats) -> None: ...
