"""Modes of structures whose contacts may open, slide and bounce, from their states.

Their generated modules give the gap and the slip of each point and how both move. The search among
the modes is that of the loop, `rockeom/integrator/transitions/candidates.py`. The functions that
`rockeom.structures.modes` lists are those of `rockeom.structures.declared_modes`, too.
"""

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from rockeom import codes
from rockeom.compiler.modules import Modules, as_python, module_text
from rockeom.generated.numeric_modes import slips_in
from rockeom.integrator.linking import texts_of_modes
from rockeom.integrator.schema import (
    PROVIDED,
    GeneratedModule,
    SearchedModes,
    angles,
    is_by_code,
    still_ground,
)
from rockeom.numbers.batch import Differs, Many, values
from rockeom.numbers.checks import InputError
from rockeom.numbers.dual import directions, tangent_of, value_of, with_tangent
from rockeom.numbers.functions import for_arrays, of_compounds
from rockeom.numbers.mode_codes import code_of, rows_of
from rockeom.structures.declared_modes import number_of
from rockeom.structures.statics import Equilibrium, balanced

HAPPENED = {
    codes.LANDING: "landing", codes.LIFTING: "lifting",
    codes.SLIPPING: "slip begins", codes.STICKING: "slip ends", codes.BOUND: "bound",
}  # fmt: skip
"""Words for the events of a point, and of a bound."""

_CLOSED = 1e-9
"""Relative to the terms of a gap, or of its rate: smaller ones are zero, in a motion."""
_LANDED = 1e-13
"""The same of a gap that an impact has closed, as far as rounding lets it."""


class Contacts(NamedTuple):
    """The points in a state, (m,) each."""

    closed: np.ndarray
    """1 where it is closed."""
    slides: np.ndarray
    """The sign of its slip, 0 where it has none."""
    least_gap: np.ndarray
    """The lowest gap that the state may have, but for its errors [m]."""


class Points:
    """The points of a structure in a state (N,): gap, gap_rate (m,), and Jacobians.

    normal (m, n), tangential (m, 1, n), in space (m, 2, n) : derivatives of gap and slips by the
    coordinates. All have the further axes of states (..., N) in front.
    """

    def __init__(self, module: SearchedModes, y: np.ndarray, p: np.ndarray) -> None:
        n, m, axes = len(module.STATES) // 2, len(module.POINTS), _directions(module)
        rows = _of_points(module, y, p).reshape(*y.shape[:-1], m, _size_of_point(module))
        levers = rows[..., 1 + 2 * axes :]
        self.module, self.y, self.p = module, y, p
        self.gap, self.gap_rate = rows[..., 0], rows[..., 1]
        self.normal = levers[..., :n]
        self.tangential = levers[..., n:].reshape(*levers.shape[:-1], axes - 1, n)
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

    def contacts(self) -> Contacts:
        """The points that are closed in a state of a user, and how they slip."""
        m, kind = len(self.module.POINTS), np.result_type(self.y, self.p, 0.0)
        contacts = Contacts(np.zeros(m, np.int64), np.zeros(m), np.zeros(m, kind))
        if m:
            search = _searching(self.module, kind.hasobject)
            y, p, of_contacts = self.y.astype(kind), self.p, np.zeros(search["CONTACT_SIZE"], kind)
            search["contact_data"](y, p, 0, of_contacts)  # its mode matters to forces alone
            search["closed_points"](y, p, 0, of_contacts, contacts.closed, contacts.slides)
            for i, size in enumerate(self.size):
                radius = search["radius_of"](of_contacts, i)
                contacts.least_gap[i] = -search["GIVEN"] * np.maximum(size, radius)
        return contacts


def _directions(module: SearchedModes) -> int:
    """How many directions a point has: along its gap, and its slips."""
    return 3 if is_by_code(module) else 2


def _size_of_point(module: SearchedModes) -> int:
    """How many numbers `points` of the module tells of each: gap, rates, biases and rows."""
    return 1 + _directions(module) * (2 + len(module.STATES) // 2)


def _of_points(module: SearchedModes, y: np.ndarray, p: np.ndarray) -> np.ndarray:
    """The values of `points` of the module in states (..., N), in one row of each."""
    columns = len(module.POINTS) * _size_of_point(module)
    rows = np.zeros((*y.shape[:-1], columns), np.result_type(y, p))
    if rows.size:
        _fill(module, y.reshape(-1, y.shape[-1]), p, rows.reshape(-1, rows.shape[-1]))
    return rows


def _fill(module: SearchedModes, states: np.ndarray, p: np.ndarray, every: np.ndarray) -> None:
    """The rows of states (k, N) into every (k, ...); of many at once, the same bits, sooner."""
    if len(states) == 1:
        try:
            for_arrays(module, states, p).points(states[0], p, every[0])
        except ZeroDivisionError:
            raise InputError("state", of=module.NAME).says(
                "no point is the lowest in this state, as of a round base that lies flat: give one "
                "in which it leans"
            ) from None
        return
    out = np.zeros(every.shape[1], dtype=object)
    try:
        of_compounds(module).points(np.array([Many(c) for c in states.T], dtype=object), p, out)
    except Differs as ways:  # states that do not go the same way through it
        for part in ways.parts:
            rows = every[part]
            _fill(module, states[part], p, rows)
            every[part] = rows
        return
    for column, value in zip(every.T, out, strict=True):
        column[:] = values(value)


def landing_speeds(module: SearchedModes, p: np.ndarray, states: np.ndarray) -> np.ndarray:
    """(k,) speeds at which the fastest points of states (k, N) close their gaps [m/s]."""
    rates = Points(module, states, p).gap_rate
    return np.maximum(-rates.min(axis=1, initial=np.inf), 0.0)


def completed(
    module: SearchedModes, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    """The state with what is not named put so that the structure can be in it.

    The lowest points stand and do not slip; elements that yield are drawn out.
    """
    y = drawn_out(module, standing(module, y, p, named), p, named)
    check_ties(module, value_of(y), value_of(p))
    return y


def standing(
    module: SearchedModes, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
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
    module: SearchedModes, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    y = y.astype(np.result_type(y, p))
    n = len(module.STATES) // 2
    free = np.array([name not in named for name in module.STATES])
    free &= np.tile(np.array(angles(module)) == 0.0, 2)
    y[:n] = _lowered(module, y, p, np.flatnonzero(free[:n]))
    points = Points(module, y, p)
    down = points.closed
    if not down.any() or not free[n:].any():
        return y
    closed = np.flatnonzero(down)
    sticky = _may_stick(module)
    choices = [closed, *(closed[i : i + 1] for i in range(len(closed)))]
    for held in choices:
        rows = np.vstack([points.normal[held], *points.tangential[held[sticky[held]]]])
        moved = y.copy()
        lacking = rows @ y[n:]
        move = np.flatnonzero(free[n:])
        moved[n + move] -= _least_squares(rows[:, move], lacking)
        there = Points(module, moved, p)
        fits = np.abs(rows @ moved[n:]) <= _CLOSED * (np.abs(rows) @ np.abs(moved[n:]) + 1e-300)
        opens = there.gap_rate[down] >= -_CLOSED * there.speed[down]
        if fits[: len(held)].all() and opens.all():
            return moved
    return y


def _may_stick(module: Any) -> np.ndarray:
    """(m,) whether each point sticks in some mode."""
    m = len(module.POINTS)
    if is_by_code(module):
        return np.array([not module.SMOOTH >> i & 1 for i in range(m)])
    return (np.reshape(module.POINT_STATES, (-1, m)) == codes.STICK).any(axis=0)


def _lowered(module: SearchedModes, y: np.ndarray, p: np.ndarray, free: np.ndarray) -> np.ndarray:
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
        share = _least_squares(levers[held].T, levers[lowest])
        lacking = levers[lowest] - share @ levers[held]
        if lacking @ lacking <= _CLOSED**2 * (levers[lowest] @ levers[lowest]):
            replaced = int(np.argmax(share))
            held = [*held[:replaced], *held[replaced + 1 :]]
    return [*held, lowest]


def _least_squares(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The least x (n,) of those for which a x is nearest to b, of compounds as well.

    Derivatives of the pseudoinverse: Golub and Pereyra (1973), where the rank of a stays.
    """
    plain, b_ = value_of(a), value_of(b)
    if object in (plain.dtype, b_.dtype):
        return _least_of_compounds(plain, b_)
    x = np.linalg.lstsq(plain, b_, rcond=None)[0]
    if not (m := directions(a, b)):
        return x
    da, db, inverse = tangent_of(a, m), tangent_of(b, m), np.linalg.pinv(plain)
    free = np.eye(len(x)) - inverse @ plain
    left = np.einsum("ijm,i->jm", da, b_ - plain @ x)
    drawn = np.einsum("ijm,i->jm", da, inverse.T @ x)
    along = inverse @ (db - np.einsum("ijm,j->im", da, x) + inverse.T @ left) + free @ drawn
    return with_tangent(x, along)


def _least_of_compounds(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """`_least_squares` by operations of numbers: x is a sum of the directions of the rows of a.

    Raises TypeError for the numbers of many cases, each of which LAPACK would round otherwise.
    """
    if any(isinstance(x, Many) for x in (*a.flat, *b)):
        raise TypeError("cases whose states are to be completed are made one by one")
    rows = _orthonormal(a)
    columns = rows @ a.T  # (r, k), of full rank
    across = _orthonormal(columns)
    of_rows = np.zeros(len(rows), dtype=object)
    for i in reversed(range(len(rows))):  # across @ columns.T is triangular
        of_rows[i] = across[i] @ (b - of_rows @ columns) / (across[i] @ columns[i])
    return of_rows @ rows


def _orthonormal(rows: np.ndarray) -> np.ndarray:
    """(r, n) directions of rows (k, n), by Gram and Schmidt; not of those that others span."""
    basis: list[np.ndarray] = []
    for row in rows:
        left = row
        for other in (*basis, *basis):  # the second time removes what rounding left
            left = left - (other @ left) * other
        if left @ left > _CLOSED**2 * (row @ row):
            basis.append(left / np.sqrt(left @ left))
    return np.array(basis, dtype=object).reshape(-1, rows.shape[1])


@cache
def breaking(module: GeneratedModule) -> dict[str, int]:
    """The ties that may break, with the place of the state that says whether they have."""
    names = getattr(module, "ELEMENTS", ())
    return {
        name: module.STATES.index(f"{name}_broken")
        for name in names
        if f"{name}_broken" in module.STATES
    }


def slipping(module: SearchedModes, modes: np.ndarray) -> np.ndarray:
    """(n,) whether points slip with friction in modes (n,) whose numbers are codes of digits."""
    numbers = np.unique(modes)
    slips = [slips_in(number, len(module.POINTS)) for number in numbers.tolist()]
    return np.isin(modes, numbers[np.array(slips, bool)])


def drawn_out(
    module: SearchedModes, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any]
) -> np.ndarray:
    """The state, what is beyond the strength of an element that yields being drawn out there.

    Raises ValueError where a permanent extension is named that leaves more than the strength.
    """
    places = {name: f"{name}_extension" for name in module.ELEMENTS}
    broken = {name for name, i in breaking(module).items() if value_of(y)[i] == 1.0}
    places = {name: z for name, z in places.items() if z in module.STATES and name not in broken}
    if not places:
        return y
    free = (codes.OPEN,) * len(module.POINTS)  # its guards hold anywhere
    mode = _with_elements(module, free, value_of(y), value_of(p))
    y = y.astype(np.result_type(y, p))
    m = for_arrays(module, y)
    drawn, moved = y.copy(), np.zeros(len(module.KINEMATICS), y.dtype)
    for guard in range(module.GUARDS[mode]):
        if module.KINDS[mode][guard] == codes.SWITCH:
            m.jump(mode, guard, 0, 0.0, drawn.copy(), p, drawn)
    m.kinematics(mode, y, p, moved)
    for name, z in places.items():
        i = module.STATES.index(z)
        size = abs(drawn[i]) + abs(moved[module.KINEMATICS.index(f"{name}_elongation")])
        if z not in named:
            y[i] = _DRAWN * drawn[i]
        elif abs(drawn[i] - y[i]) > _BEYOND * size:
            raise InputError(z, y[i], module.NAME).says(
                f"{z} is {y[i]:g} in this state, which leaves more than the strength: give "
                f"{drawn[i]:.6g}, or leave it out"
            )
    return y


def check_ties(module: SearchedModes, y: np.ndarray, p: np.ndarray) -> None:
    """Raise InputError for a tie that is neither whole nor broken, or whole beyond its limit."""
    ties = breaking(module)
    for name, i in ties.items():
        if y[i] not in (0.0, 1.0):
            raise InputError(f"{name}_broken", y[i], module.NAME).give("0, or 1 once it has broken")
    if not ties:
        return
    free = (codes.OPEN,) * len(module.POINTS)  # its guards hold anywhere
    _, elastic = _by_elements(module, free)
    for name, i in ties.items():
        mode = elastic[module.ELEMENTS.index(name)][0]
        guards, upright = (_guards(module, mode, state, p) for state in (y, np.zeros(len(y))))
        beyond = np.flatnonzero((guards < -_AT_LIMIT * np.abs(upright))[: module.GUARDS[mode]])
        if y[i] == 0.0 and any(_after(module, mode, guard, y, p)[i] for guard in beyond.tolist()):
            raise InputError(f"{name}_broken", 0, module.NAME).says(
                f"{name} is whole in this state, and beyond the limit at which it breaks: give "
                f"{name}_broken=1, or another state"
            )


def check_bounds(module: SearchedModes, y: np.ndarray, p: np.ndarray) -> None:
    """Raise InputError for a state at a bound of the declaration, or beyond."""
    mode = 0
    guards = _guards(module, mode, y, p)
    others = len(module.POINTS) + len(module.ELEMENTS)
    for i, kind in enumerate(module.KINDS[mode]):
        if kind == codes.BOUND and not guards[i] > 0.0:
            place = module.SUBJECTS[mode][i] - others
            name = getattr(module, "BOUNDS", ())[place]
            if place >= getattr(module, "N_BOUNDS_OF_DECLARATION", math.inf):
                raise InputError("initial", of=module.NAME).says(
                    f"it has overturned in this state, by its {name}: give one in which it stands"
                )
            raise InputError("initial", of=module.NAME).says(
                f"the bound {name!r} is {guards[i]:g} in this state: give one in which it is above "
                "zero"
            )


def _after(
    module: SearchedModes, mode: int, guard: int, y: np.ndarray, p: np.ndarray
) -> np.ndarray:
    """The state after an event of an element."""
    after = y.copy()
    module.jump(mode, guard, 0, 0.0, y, p, after)
    return after


_AT_LIMIT = 1e-9
"""Relative: a state just before a break may be beyond the limit by the rounding of its event."""
_BEYOND = 1e-4
"""Relative: an extension is integrated while it grows, to the tolerance of a motion."""
_DRAWN = 1.0 + 4e-13
"""Further than rounding tells: just below its strength an element is elastic, whatever comes."""


def mode_of(
    module: SearchedModes, y: np.ndarray, p: np.ndarray, towards: Callable[[], float] = float
) -> int:
    """Number of the mode of a state.

    Raises ValueError where a point is below what it stands on, and where no mode fits.
    """
    y, p = value_of(y), value_of(p)
    points = Points(module, y, p)
    closed, slides, least_gap = points.contacts()
    states = []
    for i, name in enumerate(module.POINTS):
        if points.gap[i] < least_gap[i]:
            raise InputError(name, points.gap[i], module.NAME).says(
                f"the gap of {name} is {points.gap[i]:g} in this state: it must not be negative; "
                "leave the heights out, they follow from the rest"
            )
        if not closed[i]:
            states.append(codes.OPEN)
        elif slides[i] == 0.0:
            states.append(codes.STICK)
        else:
            states.append(codes.SLIP_RIGHT if slides[i] > 0.0 else codes.SLIP_LEFT)
    if is_by_code(module):
        return _code_of(module, points, closed, slides, p)
    points_as = _smoothed(module, tuple(states))
    if points_as not in module.POINT_STATES:
        described = ", ".join(
            f"{name} {_WORDS[state]}" for name, state in zip(module.POINTS, states, strict=True)
        )
        raise InputError("state").says(
            f"{module.NAME} has no mode in which {described}: correct the state"
        )
    return _with_elements(module, points_as, y, p)


def _code_of(
    module: Any, points: Points, closed: np.ndarray, slides: np.ndarray, p: np.ndarray
) -> int:
    """The number of the mode of a structure in space, by the states of its points."""
    digits, friction = [], friction_of(module, p)
    for i, name in enumerate(module.POINTS):
        digit = codes.BEARS if closed[i] else codes.OPEN
        if closed[i] and slides[i] != 0.0 and not module.SMOOTH >> i & 1:
            if friction[i] >= codes.NEVER_SLIPS:
                raise InputError("state").says(
                    f"{name} of {module.NAME}, which never slips, does at these initial rates: "
                    "leave x_dot, y_dot and yaw_dot out, or give the structure friction="
                )
            x, y = points.tangential[i] @ points.y[len(module.STATES) // 2 :]
            digit = codes.SLIPS + round(math.atan2(y, x) / (math.pi / 2)) % 4
        digits.append(digit)
    return code_of(digits)


def _smoothed(module: SearchedModes, states: tuple[int, ...]) -> tuple[int, ...]:
    """The states of points with those that are frictionless where the same points are closed."""
    for row in module.POINT_STATES:
        smooth = tuple(
            codes.FRICTIONLESS if a == codes.FRICTIONLESS and b else b
            for a, b in zip(row, states, strict=True)
        )
        if smooth == row:
            return row
    return states


_WORDS = {
    codes.OPEN: "is open", codes.STICK: "sticks",
    codes.SLIP_RIGHT: "slips right", codes.SLIP_LEFT: "slips left",
}  # fmt: skip


def named_mode(module: SearchedModes, mode: Any, y: np.ndarray, p: np.ndarray) -> int:
    """Number of the mode named; raises TypeError or ValueError where there is none.

    InputError, too, where a tie that has broken would pull in it.
    """
    number = number_of(module, mode)
    _check_clocks(module, number, value_of(y), value_of(p))
    for name, i in breaking(module).items():
        if (
            value_of(y)[i] == 1.0
            and module.ELEMENT_STATES[number][module.ELEMENTS.index(name)] >= 0
        ):
            raise InputError("mode", mode, module.NAME).says(
                f"the mode {mode!r} contradicts {name}_broken = 1: {name} pulls in it; leave the "
                "mode out"
            )
    return number


def _check_clocks(module: SearchedModes, mode: int, y: np.ndarray, p: np.ndarray) -> None:
    """Raise InputError for a push that acts in a mode before it begins, or rests while it acts."""
    fits = _with_elements(module, module.POINT_STATES[mode], y, p)
    guards = _guards(module, fits, y, p)
    for i, name in enumerate(module.ELEMENTS):
        subject = len(module.POINTS) + i
        margin = min(
            g for g, of in zip(guards, module.SUBJECTS[fits], strict=False) if of == subject
        )
        differ = module.ELEMENT_STATES[mode][i] != module.ELEMENT_STATES[fits][i]
        if f"{name}_time" in module.STATES and differ and margin > _ON_TIME:
            raise InputError("mode", module.MODES[mode], module.NAME).says(
                f"the mode {module.MODES[mode]!r} contradicts {name}_time = "
                f"{y[module.STATES.index(f'{name}_time')]:g}: leave the mode out"
            )


_ON_TIME = 1e-9
"""Time to the start or the end of a push at which both modes fit [s]: rounding."""


def mode_under_forces(
    module: SearchedModes, mode: int, y: np.ndarray, p: np.ndarray, ground: tuple[float, ...]
) -> int:
    """The mode in which a state goes on, by the forces under a ground acceleration.

    mode : that of the state alone. Raises ValueError where forces fit none, or several that move
    differently.
    """
    if not len(module.POINTS):
        return mode
    with np.errstate(all="ignore"):  # candidates that fit no forces, as in machine code
        follows = _searching(module)["fits_by_forces"](mode, y, p, ground)
    if follows < 0:
        none = "no" if follows == codes.IMPOSSIBLE else "more than one"
        raise InputError("state").says(
            f"{none} mode of {module.NAME} fits the forces in this state, since "
            f"{assumption(module, p)}: or give another state"
        )
    return follows


def assumption(module: Any, p: np.ndarray) -> str:
    """The assumption that fails where no mode fits, or several, and the remedy."""
    if (friction_of(module, p) >= codes.NEVER_SLIPS).all():
        return "its contacts never slip: declare friction for them, or a restitution of 0"
    return "rigid bodies with much friction jam (Painleve): declare less, or springs under the feet"


def friction_of(module: Any, p: np.ndarray) -> np.ndarray:
    """(m,) the coefficient of friction of each point; NEVER_SLIPS of one that never does."""
    # restitution and friction of each point
    rows = np.zeros(2 * len(module.POINTS), np.result_type(p, 0.0))
    module.point_laws(p, rows)
    return rows[1::2]


def equilibrium(module: SearchedModes, p: np.ndarray, rotation: float) -> Equilibrium:
    """(force, state) of points that may open: they stick, and give the forces that are needed."""
    m = module
    n = m.N_STATES // 2
    if len(m.POINTS):
        rotation = rotation or 1e-12  # upright it is the force at which it lifts, to the right
    upright = _state(m, p, {m.STATES[m.ROTATION]: rotation})
    held = _held(m, p, upright)
    places = [i for i in range(n - getattr(m, "N_INTERNAL", 0)) if i != m.ROTATION]
    free = [i for i in places if not np.any(held[:, i])]
    tied = [i for i in places if i not in free]

    def state(unknown: np.ndarray) -> np.ndarray:
        named = {m.STATES[i]: x for i, x in zip(free, unknown, strict=True)}
        return _as_it_stood(m, p, _state(m, p, {m.STATES[m.ROTATION]: rotation, **named}))

    def statics(y: np.ndarray, load: float) -> np.ndarray:
        """Residuals of rotation and free coordinates: virtual work, the tied ones moving along."""
        lacking = np.empty(n)
        m.statics(mode_of(m, y, p), y, p, load, lacking)
        rows = _held(m, p, y)
        moving = [m.ROTATION, *free]
        along = -np.linalg.lstsq(rows[:, tied], rows[:, moving], rcond=None)[0]
        return lacking[moving] + along.T @ lacking[tied]

    forces = np.zeros(len(m.REACTIONS))
    m.reactions(mode_of(m, upright, p), upright, p, *still_ground(m), forces)
    force, y = balanced(state, statics, len(free), noise=1e-12 * np.abs(forces).sum())
    if not np.isfinite(force):
        raise ValueError(f"no equilibrium of {m.NAME} at rotation {rotation}")
    return force, y


def _state(m: SearchedModes, p: np.ndarray, named: Mapping[str, float]) -> np.ndarray:
    """(N,) state of named values."""
    return completed(m, np.array([named.get(name, 0.0) for name in m.STATES]), p, named)


def _as_it_stood(m: SearchedModes, p: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The state moved along, so that the closed points are where they stood upright."""
    closed, rows = _holding(m, p, y)
    slips = [m.KINEMATICS.index(f"{m.POINTS[i]}_slip") for i in np.flatnonzero(closed)]
    moved = []
    for state in (y, _state(m, p, {})):
        out = np.empty(len(m.KINEMATICS))
        m.kinematics(mode_of(m, state, p), state, p, out)
        moved.append(out[slips])
    lacking = np.concatenate([np.zeros(len(slips)), moved[1] - moved[0]])
    level = np.flatnonzero(np.array(angles(m)) == 0.0)
    y = y.copy()
    y[level] += np.linalg.lstsq(rows[:, level], lacking, rcond=None)[0]
    return y


def _held(m: SearchedModes, p: np.ndarray, y: np.ndarray) -> np.ndarray:
    """(k, n) the directions in which the closed points of a state hold it."""
    return _holding(m, p, y)[1]


def _holding(m: SearchedModes, p: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(m,) whether each point is closed in a state, and (k, n) the directions in which they hold.

    Those of all gaps stand before those of all slips.
    """
    points = Points(m, y, p)
    closed = points.contacts().closed == 1
    return closed, np.vstack([points.normal[closed], *points.tangential[closed]])


@cache
def _searching(module: SearchedModes, compounds: bool = False) -> dict[str, Any]:
    """The functions that search for modes, as plain Python, for a generated module.

    compounds : numbers may be such, in those functions of them that find closed points.
    """
    own = vars(of_compounds(module) if compounds else module)
    modules = Modules({PROVIDED: tuple(texts_of_modes(module))})
    texts = modules.closure([module_text("rockeom.integrator.transitions.newton")])
    names = as_python(texts, own | {"ANGLES": angles(module)})
    if compounds:  # their globals: what the texts import is for numbers
        names.update(math=own["math"], np=own["np"], max=np.maximum, min=np.minimum)
    return names


def _guards(module: SearchedModes, mode: int, y: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Guards of a mode where the ground does not accelerate."""
    values = np.zeros(module.N_GUARDS + module.N_PARTS, np.result_type(y, p))
    for_arrays(module, y, p).guards(mode, y, p, *still_ground(module), values)
    return values


def _with_elements(
    module: SearchedModes, points: tuple[int, ...], y: np.ndarray, p: np.ndarray
) -> int:
    """The mode with these states of points whose elements are as in a motion.

    An element is open, or elastic, as long as the guard of that state is positive: only its fall
    closes it, or makes it yield. A damper alone holds no spring closed above its ground: its force
    would have fallen to zero before the gap opened.
    """
    fits, each = _by_elements(module, points)
    values: dict[int, np.ndarray] = {}

    def margin(mode: int, element: int) -> float:
        if mode not in values:
            values[mode] = _guards(module, mode, y, p)
        subject = len(module.POINTS) + element
        guards = zip(values[mode], module.SUBJECTS[mode], strict=False)
        return min((g for g, of in guards if of == subject), default=0.0)

    wanted = []
    for i, modes in enumerate(each):
        margins = {state: margin(mode, i) for state, mode in modes.items()}
        best = max(margins, key=lambda state: min(margins[state], 0.0))
        wanted.append(0 if margins.get(0, 0.0) > 0.0 else best)
    if tuple(wanted) in fits:
        return fits[tuple(wanted)]
    # springs of a row at the same instant of closing, but for rounding
    nearest = min(fits, key=lambda states: sum(a != b for a, b in zip(states, wanted, strict=True)))
    return fits[nearest]


@cache
def _by_elements(
    module: SearchedModes, points: tuple[int, ...]
) -> tuple[dict[tuple[int, ...], int], tuple[dict[int, int], ...]]:
    """Modes by the states of their elements, and of each element one for each state.

    First those where all have their first states, and their last: two whose guards tell all.
    """
    every = zip(module.POINT_STATES, module.ELEMENT_STATES, strict=True)
    fits: dict[tuple[int, ...], int] = {}
    for c, (of_points, states) in enumerate(every):
        if of_points == points:
            fits.setdefault(states, c)
    each: tuple[dict[int, int], ...] = tuple({} for _ in module.ELEMENTS)
    rows = [*fits]
    for states in (rows[0], rows[-1], *rows):
        for of, state in zip(each, states, strict=True):
            of.setdefault(state, fits[states])
    return fits, each


def subjects(
    module: SearchedModes, events: np.ndarray, states: np.ndarray, p: np.ndarray
) -> list[str]:
    """The points, or the element, of each event, joined by "+" where several have it at once.

    events (k, 4) : kind, modes before and after, number of the guard. states (k, 2, N) : before and
    after it.
    """
    names = [""] * len(events)
    landed = _landed(module, events, states, p)
    for i, (kind, mode, _, guard) in enumerate(events.tolist()):
        if guard < 0:
            continue
        number = module.SUBJECTS[mode][guard]
        if number >= len(module.POINTS):
            others = (*module.ELEMENTS, *getattr(module, "BOUNDS", ()))
            names[i] = others[number - len(module.POINTS)]
            continue
        several = [number]
        if kind == codes.LANDING:
            several = sorted({number, *np.flatnonzero(landed[i]).tolist()})
        elif kind in (codes.SLIPPING, codes.STICKING):
            shared, closed = module.SHARED[mode], module.POINT_STATES[mode]
            several = [j for j, first in enumerate(shared) if first == shared[number]]
            several = [j for j in several if closed[j] != codes.OPEN]
        names[i] = "+".join(module.POINTS[j] for j in several)
    return names


def _landed(
    module: SearchedModes, events: np.ndarray, states: np.ndarray, p: np.ndarray
) -> dict[int, np.ndarray]:
    """Which points (m,) landed, by the number of the event, a landing."""
    landings = np.flatnonzero(events[:, 0] == codes.LANDING)
    if not len(landings):
        return {}
    before, after = (Points(module, states[landings, side], p) for side in (0, 1))
    met = (before.gap_rate < -_CLOSED * before.speed) & (after.gap_rate >= -_CLOSED * before.speed)
    opened = rows_of(module.POINT_STATES, events[landings, 1]) == codes.OPEN
    # the impact puts what lands on the ground; others may turn back in flight, however close
    near = after.gap <= _LANDED * after.size.max(axis=1, keepdims=True)
    return dict(zip(landings.tolist(), met & opened & near, strict=True))
