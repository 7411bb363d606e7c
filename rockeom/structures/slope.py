"""Structures at rest on ground that slopes: where they stand, lift a foot, and overturn."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from rockeom.integrator.schema import in_space
from rockeom.motion.slope import weight_on
from rockeom.numbers.checks import InputError
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import for_arrays
from rockeom.structures import statics
from rockeom.structures.evaluation import gravity_of
from rockeom.structures.modes import modes_of

ModeOf = Callable[[np.ndarray], int]
_MOST_STEPS = 50
_STEP = 1e-7
"""Change of a coordinate by which accelerations are derived [m or rad]: half of the digits."""
_SETTLED = 2e-16
"""Relative change of a step that is rounding."""
_AT_REST = 1e-9
"""Part of the first acceleration that may be left of it by rounding where nothing moves."""


class OnSlope(NamedTuple):
    """Structure at rest on ground that falls to the right where the slope is positive.

    Parameters
    ----------
    slope : float
        Slope [rad].
    uplift_accelerations : tuple of (float, float) or None
        Accelerations of the ground along the slope (left, right) at which the structure starts to
        lean there [m/s2], as `Structure.uplift_accelerations` on level ground; below zero where it
        leans without any.
    overturning_angles : tuple of (float, float) or None
        Rotations from the slope's normal (left, right) beyond which it does not come back, as
        `Structure.overturning_angles`; 0 to a side to which it leans by itself.
    """

    slope: float
    uplift_accelerations: tuple[float, float] | None
    overturning_angles: tuple[float, float] | None

    @property
    def stands(self) -> bool | None:
        """Whether it stands without shaking, if its feet do not slide; None where unknown."""
        if self.uplift_accelerations is None:
            return None
        return min(self.uplift_accelerations) > 0.0


def on_slope(structure: Any, slope: float) -> OnSlope:
    """See `Structure.on_slope`; slope [rad]."""
    if slope and in_space(structure.module):
        raise InputError("slope", slope).says(
            f"{type(structure).__name__} moves in space, and its ground is level: leave it out"
        )
    uplifts, angles = uplift_accelerations(structure, slope), overturning_angles(structure, slope)
    return OnSlope(slope, uplifts, angles)


def uplift_accelerations(structure: Any, slope: float) -> tuple[float, float] | None:
    """The accelerations of `OnSlope` alone."""
    level = structure.uplift_accelerations
    if slope == 0.0 or level is None:
        return level
    m, p = structure.module, structure.vector
    return statics.uplift_accelerations(m, p, weight_on(slope, gravity_of(m, p)))


def overturning_angles(structure: Any, slope: float) -> tuple[float, float] | None:
    """The angles of `OnSlope` alone."""
    if slope == 0.0:
        return structure.overturning_angles
    if not structure.has_overturning_angles:
        return None
    weight = weight_on(slope, gravity_of(structure.module, structure.vector))
    uplifts = uplift_accelerations(structure, slope) or (1.0, 1.0)
    left, right = (
        _overturning_angle(structure, weight, side) if uplift > 0.0 else 0.0
        for side, uplift in zip((-1.0, 1.0), uplifts, strict=True)
    )
    return left, right


def _overturning_angle(structure: Any, weight: tuple[float, float], side: float) -> float:
    """Size of the rotation to a side from which the structure at rest turns neither way."""
    m, p = structure.module, structure.vector
    others = [i for i in range(m.N_STATES // 2) if i != m.ROTATION]
    if structure.has_landings:  # a rigid body, which its edge holds
        if len(others) > 2:
            return math.nan
        others = []
    try:
        lean = standing_on(structure, structure.state({}), weight)[m.ROTATION]
    except InputError:
        return math.nan
    leans = _mode_of(structure, side)

    def turns_back(rotation: float) -> tuple[float, np.ndarray]:
        y = structure.state({m.STATES[m.ROTATION]: lean + rotation})
        rest = _at_rest(structure, y, weight, others, leans)
        return -_accelerations(m, leans(rest), rest, p, weight)[m.ROTATION], rest

    farthest = side * structure.overturning_rotation
    return side * float(lean) + statics.overturning_angle(turns_back, farthest)


def standing_on(structure: Any, y: np.ndarray, weight: tuple[Any, Any]) -> np.ndarray:
    """The state (N,) in which a structure stands still under the weight on a slope, from state y.

    Coordinates that are free in the mode of that state, such as that of an elastic column, are in
    equilibrium. weight : of `rockeom.motion.slope.weight_on`. Raises InputError where there is none
    that is stable.
    """
    mode_of = _mode_of(structure, -math.copysign(1.0, value_of(weight[0])))
    if structure.rocks_on_rigid_ground or structure.has_landings:
        standing = mode_of(y)  # what is held there stays held
        mode_of = lambda _: standing  # noqa: E731
    units = structure.module.STATE_UNITS[: len(y) // 2]
    free = [i for i, unit in enumerate(units) if unit != "s s"]  # the time of a push goes on
    try:
        return _at_rest(structure, y, weight, free, mode_of)
    except ValueError:
        raise InputError("initial", of=structure.model).says(
            f"{structure.model} has no stable equilibrium on the slope near its state at zero: "
            "give {initial}, the state in which it starts"
        ) from None


def _mode_of(structure: Any, side: float) -> ModeOf:
    """Finds the mode of a state, which turns to a side where it is upright."""
    m, p = structure.module, value_of(structure.vector)
    return lambda y: modes_of(m).mode_of(m, y, p, lambda: side)


def _at_rest(
    structure: Any, y: np.ndarray, weight: tuple[Any, Any], free: list[int], mode_of: ModeOf
) -> np.ndarray:
    """The state with coordinates that do not accelerate, by Newton's method; ValueError: none.

    Coordinates that cannot move stay. Derivatives follow from the last step.
    """
    m, p, plain = structure.module, structure.vector, value_of(y).copy()
    of_weight = value_of(weight[0]), value_of(weight[1])

    def lacking(state: np.ndarray) -> np.ndarray:
        return _accelerations(m, mode_of(state), state, value_of(p), of_weight)[free]

    varies = np.result_type(y, p, type(weight[0])).hasobject  # with derivatives
    first = largest = np.abs(lacking(plain)).max(initial=0.0)
    if first == 0.0 and not varies:
        return y
    for _ in range(_MOST_STEPS):
        missing = lacking(plain)
        largest = np.abs(missing).max()
        moved = plain + _STEP * np.eye(len(y))[free]
        slopes = np.column_stack([lacking(state) - missing for state in moved]) / _STEP
        inverse = np.linalg.pinv(slopes)
        change = inverse @ missing
        plain[free] -= change
        if not np.abs(change).max() > _SETTLED * np.abs(plain).max():
            break
    rates = np.linalg.eigvals(slopes)
    if not largest <= _AT_REST * first or rates.real.max() > _STEP * np.abs(rates).max():
        raise ValueError("no stable equilibrium")
    if varies:
        moving = plain + (y - value_of(y))
        left = _accelerations(m, mode_of(plain), moving, p, weight)[free]
        plain = moving.astype(object)
        plain[free] -= inverse @ left
    return plain


def _accelerations(
    m: Any, mode: int, y: np.ndarray, p: np.ndarray, weight: tuple[Any, Any]
) -> np.ndarray:
    """(n,) accelerations of the coordinates."""
    rates = np.zeros(len(y), np.result_type(y, p, type(weight[0])))
    for_arrays(m, y, p, rates).rates(mode, y, p, *weight, rates)
    return rates[len(y) // 2 :]
