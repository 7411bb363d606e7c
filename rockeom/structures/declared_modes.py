"""Modes of structures whose modes were declared, from their states.

The functions are those of `rockeom.structures.searched_modes`, too; `modes_of` in
`rockeom.structures.modes` gives the file that a module needs.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from rockeom.codes import UPLIFT
from rockeom.integrator.schema import GeneratedModule, is_by_code, still_ground
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import for_arrays, mathematics
from rockeom.structures.statics import Equilibrium, balanced


def completed(
    module: GeneratedModule, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    """The state y: what is not named is zero."""
    return y


def mode_of(
    module: GeneratedModule, y: np.ndarray, p: np.ndarray, towards: Callable[[], float] = float
) -> int:
    """Number of the mode of a state.

    towards : gives the sign of the rotation to come where the state is upright and at rest. Raises
    ValueError for a state that fits no mode.
    """
    m, p = module, value_of(p)
    rotation, rate = y[m.ROTATION], y[m.ROTATION_RATE]
    direction = rotation or rate
    if rocks_on_rigid_ground(m):
        fits = [
            c
            for c, side in enumerate(m.SIDES)
            if (side * direction > 0.0 if side else direction == 0.0)
        ]
        if len(fits) == 1:
            return fits[0]
    else:
        direction = direction or towards()
        # springs on both sides may press whichever way it leans, unless all end upright
        away = [c for c, side in enumerate(m.SIDES) if side * direction < 0.0]
        fits = [c for c in range(len(m.SIDES)) if c not in away]
        fits.sort(key=lambda c: abs(m.SIDES[c]))  # the same order on both sides
        fits += [] if all(m.SIDES) else away
    leaning = y.copy()
    if rotation == 0.0:  # on the border of both sides: where it is about to go decides
        leaning[m.ROTATION] = mathematics.copysign(1e-200, direction) if direction else 0.0
    margins = {c: margin(m, p, c, leaning) for c in fits if not _is_open(m, p, c, leaning)}
    for least in (0.0, -1.0):  # as it is, or where a rounding error hides that it is
        for number, value in margins.items():
            if value >= least:
                return number
    raise InputError("state").says(
        f"no mode of {m.NAME} holds {state_in_words(m.STATES, y)}: each of "
        f"{', '.join(m.MODES[number] for number in margins)} would have ended before; correct the "
        "state"
    )


def named_mode(module: GeneratedModule, mode: Any, y: np.ndarray, p: np.ndarray) -> int:
    """Number of the mode named; raises ValueError where the state contradicts it."""
    m, number = module, number_of(module, mode)
    values = y.tolist()
    rotation, rate = values[m.ROTATION], values[m.ROTATION_RATE]
    side = m.SIDES[number]
    turned = abs(rotation) > 1e-9  # an impact's state may be a rounding error off
    if rocks_on_rigid_ground(m) and (
        (turned and side * rotation <= 0) or (side == 0 and rate != 0)
    ):
        name = m.STATES[m.ROTATION]
        raise InputError("mode", mode).says(
            f"the mode {mode!r} of {m.NAME} contradicts {name} = {rotation}, {name}_dot = {rate}: "
            "leave `mode` out, it follows from them"
        )
    # where each mode leans to a side, all end upright
    if all(m.SIDES) and -side * rotation > 1e-6 * m.overturning(value_of(p)):
        raise InputError("mode", mode).says(
            f"the mode {mode!r} of {m.NAME} contradicts {state_in_words(m.STATES, y)}: it would "
            "have ended before; leave `mode` out, it follows from the state"
        )
    return number


def mode_under_forces(
    module: GeneratedModule,
    mode: int,
    y: np.ndarray,
    p: np.ndarray,
    ground: tuple[float, ...],
) -> int:
    """The mode itself: it follows from the state, whatever the forces are."""
    return mode


def equilibrium(module: GeneratedModule, p: np.ndarray, rotation: float) -> Equilibrium:
    """(force, state) of equilibrium in the mode that is consistent with it."""
    m = module
    side = -1.0 if rotation < 0 else 1.0
    if rocks_on_rigid_ground(m):
        return _in_mode(m, p, m.MODES.index("right" if side > 0 else "left"), rotation)
    for mode, count in enumerate(m.GUARDS):
        if m.SIDES[mode] * side < 0:
            continue
        force, y = _in_mode(m, p, mode, rotation)
        g = np.zeros(m.N_GUARDS + m.N_PARTS)
        m.guards(mode, y, p, *still_ground(m), g)
        if np.isfinite(force) and g[:count].min() >= -1e-9 * max(1.0, np.abs(g[:count]).max()):
            return force, y
    raise ValueError(f"no equilibrium of {m.NAME} at rotation {rotation}")


def _in_mode(m: GeneratedModule, p: np.ndarray, mode: int, rotation: float) -> Equilibrium:
    """(force, state): the rotation given, the load and the other coordinates unknown; nan: none."""
    n = m.N_STATES // 2
    others = [i for i in range(n) if i != m.ROTATION]

    def state(unknown: np.ndarray) -> np.ndarray:
        y = np.zeros(m.N_STATES)
        y[m.ROTATION] = rotation
        y[others] = unknown
        return y

    def every(y: np.ndarray, load: float) -> np.ndarray:
        lacking = np.empty(n)
        m.statics(mode, y, p, load, lacking)
        return lacking

    upright = state(np.zeros(len(others)))
    acts = every(upright, 1.0 + abs(every(upright, 0.0)[m.ROTATION])) - every(upright, 0.0)
    # the equation that gives the load is one in which it stands
    loaded = m.ROTATION if acts[m.ROTATION] else int(np.abs(acts).argmax())
    rows = [loaded, *(i for i in range(n) if i != loaded)]

    def statics(y: np.ndarray, load: float) -> np.ndarray:
        return every(y, load)[rows]

    return balanced(state, statics, len(others))


def subjects(
    module: GeneratedModule, events: np.ndarray, states: np.ndarray, p: np.ndarray
) -> list[str]:
    """Empty for each event: a name of its mode says all of it."""
    return [""] * len(events)


def number_of(module: GeneratedModule, mode: Any) -> int:
    """Number of the mode of a name; raises TypeError or ValueError where there is none."""
    if not isinstance(mode, str):
        raise InputTypeError("mode", mode).choose(module.MODES)
    if mode not in module.MODES:
        error = InputError("mode", mode, module.NAME)
        if is_by_code(module):
            touching = "_".join(getattr(module, "POINTS", ())[:2])
            raise error.give(f"the names of the points that touch, such as {touching!r}")
        raise error.choose(module.MODES)
    return module.MODES.index(mode)


def rocks_on_rigid_ground(module: GeneratedModule) -> bool:
    """Whether the edges of the base are pivots, and full contact is a mode of its own."""
    m = module
    return "both" in m.MODES and UPLIFT in m.KINDS[m.MODES.index("both")]


def state_in_words(states: tuple[str, ...], y: np.ndarray) -> str:
    """A state in words, without what is zero."""
    shown = [f"{name} = {value:g}" for name, value in zip(states, y.tolist(), strict=True) if value]
    return ", ".join(shown) or "the state at rest"


def margin(module: GeneratedModule, p: np.ndarray, mode: int, y: np.ndarray) -> float:
    """The lowest margin of a mode, but for uplift, which is up to the ground.

    Full contact has that of the mode to which it lifts: the same tendons hold it.
    """
    kinds = module.KINDS[mode]
    if kinds[0] == UPLIFT:
        upright = y.copy()
        upright[module.ROTATION] = 0.0
        return margin(module, p, module.TARGETS[mode][0], upright)
    values = zip(_margins(module, p, mode, y), kinds, strict=False)
    return min((value for value, kind in values if kind != UPLIFT), default=0.0)


def _is_open(module: GeneratedModule, p: np.ndarray, mode: int, y: np.ndarray) -> bool:
    """Whether a spring that a mode closes is open in a state.

    The guard that closes it is the larger of two, of a gap and of a force, and positive then. A
    damper alone holds no spring closed above its ground: its force would have fallen to zero
    before the gap opened.
    """
    m = module
    return any(
        back >= 0 and m.PARTS[target][back] >= 0 and _margins(m, p, target, y)[back] > 0.0
        for target, back in zip(m.TARGETS[mode], m.REVERSE[mode], strict=True)
    )


def _margins(module: GeneratedModule, p: np.ndarray, mode: int, y: np.ndarray) -> np.ndarray:
    """The guards of a mode, each by how much it changes with the ninth digit of y.

    None is below zero inside the mode, and none below -1 within rounding of it.
    """
    m = for_arrays(module, y, p)

    def guards(state: np.ndarray) -> np.ndarray:
        g = np.zeros(m.N_GUARDS + m.N_PARTS, np.result_type(y, p))
        m.guards(mode, state, p, *still_ground(m), g)
        return g[: m.GUARDS[mode]]

    here = guards(y)
    if (here >= 0.0).all():
        return here
    doubt = np.full(len(here), 1e-300, here.dtype)
    for i, value in enumerate(y):
        if y.dtype != object and value == 0.0:  # it has no ninth digit
            continue
        nudged = y.copy()
        nudged[i] = value * (1.0 + 1e-9)
        doubt += np.abs(guards(nudged) - here)
    return here / doubt
