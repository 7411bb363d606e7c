"""Contact states of structures whose contacts may open, slide and bounce, from their states.

Their generated modules tell of each point the gap, the slip and how both move, see
`rockeom.integrator.transitions.searched`, where the loop asks the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from rockeom.codes import (
    FRICTIONLESS,
    IMPOSSIBLE,
    LANDING,
    LIFTING,
    NEVER_SLIPS,
    OPEN,
    SLIP_LEFT,
    SLIP_RIGHT,
    SLIPPING,
    STICK,
    STICKING,
    SWITCH,
)
from rockeom.integrator.schema import SEARCHED, angles, has_points
from rockeom.integrator.texts import text_of
from rockeom.numbers.batch import Differs, Many, values
from rockeom.numbers.dual import directions, tangent_of, value_of, with_tangent
from rockeom.numbers.functions import for_arrays, of_compounds

HAPPENED = {
    LANDING: "landing", LIFTING: "lifting", SLIPPING: "slip begins", STICKING: "slip ends",
}  # fmt: skip
"""What an event of a point is called."""

_CLOSED = 1e-9
"""Relative to the terms of a gap, or of a rate: what is smaller is none, in a motion."""


class Points:
    """The points of a structure in a state (N,): gap, gap_rate (m,), and Jacobians.

    normal, tangential (m, n) : derivatives of gap and slip by the coordinates. All have the further
    axes of states (..., N) in front.
    """

    def __init__(self, module: ModuleType, y: np.ndarray, p: np.ndarray) -> None:
        n, m = len(module.STATES) // 2, len(module.POINTS)
        told = _told(module, y, p)
        rows = told.reshape(*y.shape[:-1], m, 5 + 2 * n)
        self.module, self.y, self.p, self.told = module, y, p, told
        self.gap, self.gap_rate = rows[..., 0], rows[..., 1]
        self.normal, self.tangential = rows[..., 5 : 5 + n], rows[..., 5 + n :]
        place, motion = np.abs(y[..., :n, None]), np.abs(y[..., n:, None])
        self.size = (np.abs(self.normal) @ place)[..., 0] + 1e-300
        self.speed = (np.abs(self.normal) @ motion)[..., 0] + 1e-300

    @property
    def closed(self) -> np.ndarray:
        """(..., m) whether the gap of each point is none, but for rounding."""
        return np.abs(self.gap) <= _CLOSED * self.size

    def closed_beside(self, places: np.ndarray) -> np.ndarray:
        """(..., m) the same in a motion whose coordinates are as large as places (n,)."""
        return np.abs(self.gap) <= _CLOSED * np.maximum(self.size, np.abs(self.normal) @ places)

    def touching(self) -> Touching:
        """Which points touch in this state, one that is given, and how they slip."""
        m = len(self.module.POINTS)
        found = Touching(np.zeros(m, np.int64), np.zeros(m), np.zeros(m))
        if m:
            search, y, p = _searching(self.module), self.y.astype(float), self.p
            known = np.zeros(search["N_KNOWN"])
            search["all_known"](y, p, 0, known)  # its contact state matters to forces alone
            search["touching_points"](y, p, 0, known, found.near, found.slides)
            radius = [search["radius_of"](known, i) for i in range(m)]
            found.least_gap[:] = -search["GIVEN"] * np.maximum(self.size, radius)
        return found


class Touching(NamedTuple):
    """Of each point of a given state (m,)."""

    near: np.ndarray
    """1 where it touches."""
    slides: np.ndarray
    """The sign of its slip, 0 where it has none."""
    least_gap: np.ndarray
    """The lowest gap that the state may have, but for its errors [m]."""


def _told(module: ModuleType, y: np.ndarray, p: np.ndarray) -> np.ndarray:
    """What the module tells of its points in states (..., N), in one row of each."""
    columns = len(module.POINTS) * (5 + len(module.STATES))
    told = np.zeros((*y.shape[:-1], columns), np.result_type(y, p))
    if told.size:
        _fill(module, y.reshape(-1, y.shape[-1]), p, told.reshape(-1, told.shape[-1]))
    return told


def _fill(module: ModuleType, states: np.ndarray, p: np.ndarray, told: np.ndarray) -> None:
    """The rows of states (k, N) into told (k, ...); of many at once, the same bits, sooner."""
    if len(states) == 1:
        for_arrays(module, states, p).points(states[0], p, told[0])
        return
    out = np.zeros(told.shape[1], dtype=object)
    try:
        of_compounds(module).points(np.array([Many(c) for c in states.T], dtype=object), p, out)
    except Differs as ways:  # states that do not go the same way through it
        for part in ways.parts:
            rows = told[part]
            _fill(module, states[part], p, rows)
            told[part] = rows
        return
    for column, value in zip(told.T, out, strict=True):
        column[:] = values(value)


def landing_speeds(structure: Any, states: np.ndarray) -> np.ndarray:
    """(k,) speeds at which the fastest points of states (k, N) close their gaps [m/s]."""
    rates = Points(structure.module, states, structure.vector).gap_rate
    return np.maximum(-rates.min(axis=1, initial=np.inf), 0.0)


def standing(
    module: ModuleType, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    """The state with what is not named changed, so that the lowest points stand and do not slip.

    Coordinates that turn the structure stay as they are, and so does all where heights are named.
    """
    stands = _standing(module, value_of(y), value_of(p), named)
    if not (m := directions(y, p)):
        return stands
    # arrays of objects are not added in the order of numbers: the values are those of numbers
    return with_tangent(stands, tangent_of(_standing(module, y, p, named), m))


def _standing(
    module: ModuleType, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    y = y.astype(np.result_type(y, p))
    n = len(module.STATES) // 2
    free = np.array([name not in named for name in module.STATES])
    free &= np.tile(np.array(angles(module)) == 0.0, 2)
    y[:n] = _touching(module, y, p, np.flatnonzero(free[:n]))
    points = Points(module, y, p)
    down = points.closed
    if not down.any() or not free[n:].any():
        return y
    touching = np.flatnonzero(down)
    sticky = np.array(
        [any(row[i] == STICK for row in module.POINT_STATES) for i in range(len(down))]
    )
    choices = [touching, *(touching[i : i + 1] for i in range(len(touching)))]
    for held in choices:
        rows = np.vstack([points.normal[held], points.tangential[held[sticky[held]]]])
        moved = y.copy()
        lacking = rows @ y[n:]
        move = np.flatnonzero(free[n:])
        moved[n + move] -= _least_squares(rows[:, move], lacking)
        there = Points(module, moved, p)
        fits = np.abs(rows @ moved[n:]) <= _CLOSED * (np.abs(rows) @ np.abs(moved[n:]) + 1e-300)
        opens = there.gap_rate >= -_CLOSED * there.speed
        if fits[: len(held)].all() and opens[down].all():
            return moved
    return y


def _touching(module: ModuleType, y: np.ndarray, p: np.ndarray, free: np.ndarray) -> np.ndarray:
    """The coordinates (n,) with those of numbers `free` moved until the lowest points touch.

    Newton's method for all gaps that were the lowest one: the lower of two bodies moves the gaps
    of the upper one, so gaps that close one at a time do not stay closed.
    """
    y = y.copy()
    held: list[int] = []
    for _ in range(50):
        points = Points(module, y, p)
        if not len(points.gap):
            break
        gap, rounding = value_of(points.gap), 1e-15 * value_of(points.size)
        levers, lowest = points.normal[:, free], int(np.argmin(gap))
        if lowest not in held and (not held or gap[lowest] < -rounding[lowest]):
            if not value_of(levers[lowest]).any():
                break
            held = _joined(held, lowest, value_of(levers))
        done = bool((np.abs(gap[held]) <= rounding[held]).all())
        if done and y.dtype != object:  # a gap that is none has derivatives
            break
        # places that no gap depends on stay as they are, to the last bit; they have derivatives
        moves = np.full(len(free), True) if y.dtype == object else levers[held].any(axis=0)
        y[free[moves]] -= _least_squares(levers[held][:, moves], points.gap[held])
        if done:
            break
    return y[: len(module.STATES) // 2]


def _joined(held: list[int], lowest: int, levers: np.ndarray) -> list[int]:
    """The points held and the lowest one, which replaces one that cannot touch at the same time."""
    if held:
        share = np.linalg.lstsq(levers[held].T, levers[lowest], rcond=None)[0]
        lacking = levers[lowest] - share @ levers[held]
        if np.linalg.norm(lacking) <= _CLOSED * np.linalg.norm(levers[lowest]):
            replaced = int(np.argmax(share))
            held = [*held[:replaced], *held[replaced + 1 :]]
    return [*held, lowest]


def _least_squares(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The least x (n,) of those for which a x is nearest to b, of duals as well.

    Derivatives of the pseudoinverse: Golub and Pereyra (1973), where the rank of a stays.
    """
    plain, b_ = value_of(a), value_of(b)
    x = np.linalg.lstsq(plain, b_, rcond=None)[0]
    if not (m := directions(a, b)):
        return x
    da, db, inverse = tangent_of(a, m), tangent_of(b, m), np.linalg.pinv(plain)
    free = np.eye(len(x)) - inverse @ plain
    left = np.einsum("ijm,i->jm", da, b_ - plain @ x)
    drawn = np.einsum("ijm,i->jm", da, inverse.T @ x)
    along = inverse @ (db - np.einsum("ijm,j->im", da, x) + inverse.T @ left) + free @ drawn
    return with_tangent(x, along)


def drawn_out(
    module: ModuleType, model: str, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    """The state, what is beyond the strength of an element that yields being drawn out there.

    Raises ValueError where a permanent extension is named that leaves more than the strength.
    """
    places = {name: f"{name}_extension" for name in module.ELEMENTS}
    places = {name: z for name, z in places.items() if z in module.STATES}
    if not places:
        return y
    free = (OPEN,) * len(module.POINTS)  # its guards hold anywhere
    contact = _with_elements(module, free, value_of(y), value_of(p))
    y = y.astype(np.result_type(y, p))
    m = for_arrays(module, y)
    drawn, told = y.copy(), np.zeros(len(module.KINEMATICS), y.dtype)
    for guard in range(module.GUARDS[contact]):
        if module.KINDS[contact][guard] == SWITCH:
            m.jump(contact, guard, 0, 0.0, drawn.copy(), p, drawn)
    m.kinematics(contact, y, p, told)
    for name, z in places.items():
        i = module.STATES.index(z)
        size = abs(drawn[i]) + abs(told[module.KINEMATICS.index(f"{name}_elongation")])
        if z not in named:
            y[i] = drawn[i]
        elif abs(drawn[i] - y[i]) > _BEYOND * size:
            raise ValueError(
                f"{model}: {z} is {y[i]:g} in this state, which leaves more than the strength: "
                f"give {drawn[i]:.6g}, or leave it out"
            )
    return y


_BEYOND = 1e-4
"""Relative: an extension is integrated while it grows, to the tolerance of a motion."""


def contact_of(module: ModuleType, model: str, y: np.ndarray, p: np.ndarray) -> int:
    """Number of the contact state of a state vector.

    Raises ValueError where a point is below what it stands on, and where no contact state fits.
    """
    y, p = value_of(y), value_of(p)
    points = Points(module, y, p)
    touching, slides, least_gap = points.touching()
    states = []
    for i, name in enumerate(module.POINTS):
        if points.gap[i] < least_gap[i]:
            raise ValueError(
                f"{model}: the gap of {name} is {points.gap[i]:g} in this state: it must not be "
                "negative; leave the heights out, they follow from the rest"
            )
        if not touching[i]:
            states.append(OPEN)
        elif slides[i] == 0.0:
            states.append(STICK)
        else:
            states.append(SLIP_RIGHT if slides[i] > 0.0 else SLIP_LEFT)
    points_as = _smoothed(module, tuple(states))
    if points_as not in module.POINT_STATES:
        told = ", ".join(
            f"{name} {_WORDS[state]}" for name, state in zip(module.POINTS, states, strict=True)
        )
        raise ValueError(f"{model} has no contact state in which {told}: correct the state")
    return _with_elements(module, points_as, y, p)


def _smoothed(module: ModuleType, states: tuple[int, ...]) -> tuple[int, ...]:
    """The states of points with those that are frictionless where the same points are closed."""
    for row in module.POINT_STATES:
        smooth = tuple(
            FRICTIONLESS if a == FRICTIONLESS and b else b for a, b in zip(row, states, strict=True)
        )
        if smooth == row:
            return row
    return states


_WORDS = {OPEN: "is open", STICK: "sticks", SLIP_RIGHT: "slips right", SLIP_LEFT: "slips left"}


def by_forces(
    module: ModuleType, contact: int, y: np.ndarray, p: np.ndarray, ground: tuple[float, float]
) -> int:
    """The contact state in which a state goes on, by the forces under a ground acceleration.

    contact : that which the state itself tells of. Raises ValueError where forces fit none, or
    several that move differently.
    """
    if not len(module.POINTS):
        return contact
    follows = _searching(module)["fits_by_forces"](contact, y, p, *ground)
    if follows < 0:
        none = "no" if follows == IMPOSSIBLE else "more than one"
        if never_slips(module, p):
            raise ValueError(
                f"the contacts of {module.NAME} never slip, and with that {none} combination of "
                "open and closed contacts fits the forces in this state: declare friction for "
                "them, or give another state"
            )
        raise ValueError(
            f"{none} contact state of {module.NAME} fits the forces in this state (Painleve): give "
            "less friction, or another state"
        )
    return follows


def never_slips(module: ModuleType, p: np.ndarray) -> bool:
    """Whether no contact of a structure ever slips, whatever friction that takes."""
    laws = np.zeros(2 * len(module.POINTS))
    module.point_laws(p, laws)
    return bool((laws[1::2] >= NEVER_SLIPS).all())


@cache
def _searching(module: ModuleType) -> dict[str, Any]:
    """The functions that search for contact states, as plain Python, for a generated module."""
    found = dict(vars(module)) | {"ANGLES": angles(module)}
    exec(compile(text_of(SEARCHED), SEARCHED, "exec"), found)
    return found


def _with_elements(
    module: ModuleType, points: tuple[int, ...], y: np.ndarray, p: np.ndarray
) -> int:
    """The contact state with these states of points whose elements are as in a motion.

    An element is open, or elastic, as long as the guard of that state is positive: only its fall
    closes it, or makes it yield. A damper alone holds no spring closed above its ground: its force
    would have fallen to zero before the gap opened.
    """
    fits, each = _by_elements(module, points)
    values: dict[int, np.ndarray] = {}

    def margin(contact: int, element: int) -> float:
        if contact not in values:
            values[contact] = np.zeros(module.N_GUARDS + module.N_PARTS)
            module.guards(contact, y, p, 0.0, 0.0, values[contact])
        subject = len(module.POINTS) + element
        guards = zip(values[contact], module.SUBJECTS[contact], strict=False)
        return min((g for g, of in guards if of == subject), default=0.0)

    wanted = []
    for i, contacts in enumerate(each):
        margins = {state: margin(contact, i) for state, contact in contacts.items()}
        best = max(margins, key=lambda state: min(margins[state], 0.0))
        wanted.append(0 if margins.get(0, 0.0) > 0.0 else best)
    if tuple(wanted) in fits:
        return fits[tuple(wanted)]
    # springs of a row at the same instant of closing, but for rounding
    nearest = min(fits, key=lambda states: sum(a != b for a, b in zip(states, wanted, strict=True)))
    return fits[nearest]


@cache
def _by_elements(
    module: ModuleType, points: tuple[int, ...]
) -> tuple[dict[tuple[int, ...], int], tuple[dict[int, int], ...]]:
    """Contact states by the states of their elements, and of each element one for each state.

    First those where all have their first states, and their last: two whose guards tell all.
    """
    every = zip(module.POINT_STATES, module.ELEMENT_STATES, strict=True)
    fits = {states: c for c, (of, states) in enumerate(every) if of == points}
    each: tuple[dict[int, int], ...] = tuple({} for _ in module.ELEMENTS)
    rows = [*fits]
    for states in (rows[0], rows[-1], *rows):
        for of, state in zip(each, states, strict=True):
            of.setdefault(state, fits[states])
    return fits, each


def named(module: ModuleType, phase: Any) -> int:
    """Number of the contact state named; raises TypeError or ValueError where it is none."""
    if not isinstance(phase, str):
        raise TypeError(f"phase is {phase!r}: give one of {', '.join(module.MODES)}")
    if phase not in module.MODES:
        raise ValueError(f"no phase {phase!r}; {module.NAME} has {', '.join(module.MODES)}")
    return module.MODES.index(phase)


def subjects(
    module: ModuleType, passages: np.ndarray, states: np.ndarray, p: np.ndarray
) -> list[str]:
    """The points, or the element, of each event, joined by "+" where several have it at once.

    passages (k, 4) : kind, contact states before and after, number of the guard. states (k, 2, N) :
    before and after it.
    """
    found = [""] * len(passages)
    if not has_points(module):
        return found
    landed = _landed(module, passages, states, p)
    for i, (kind, contact, _, guard) in enumerate(passages.tolist()):
        if guard < 0:
            continue
        number = module.SUBJECTS[contact][guard]
        if number >= len(module.POINTS):
            found[i] = module.ELEMENTS[number - len(module.POINTS)]
            continue
        several = [number]
        if kind == LANDING:
            several = sorted({number, *np.flatnonzero(landed[i]).tolist()})
        elif kind in (SLIPPING, STICKING):
            shared, closed = module.SHARED[contact], module.POINT_STATES[contact]
            several = [j for j, first in enumerate(shared) if first == shared[number]]
            several = [j for j in several if closed[j] != OPEN]
        found[i] = "+".join(module.POINTS[j] for j in several)
    return found


def _landed(
    module: ModuleType, passages: np.ndarray, states: np.ndarray, p: np.ndarray
) -> dict[int, np.ndarray]:
    """Which points (m,) landed, by the number of the event, a landing."""
    landings = np.flatnonzero(passages[:, 0] == LANDING)
    if not len(landings):
        return {}
    before, after = (Points(module, states[landings, side], p) for side in (0, 1))
    met = (before.gap_rate < -_CLOSED * before.speed) & (after.gap_rate >= -_CLOSED * before.speed)
    opened = np.array(module.POINT_STATES)[passages[landings, 1]] == OPEN
    near = after.gap <= 1e-6 * np.abs(before.gap_rate)  # it did not only turn back in flight
    return dict(zip(landings.tolist(), met & opened & near, strict=True))
