"""Which modes a declaration has, and the equations of each: patterns of points, states, names."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np
import sympy as sp

from rockeom.codes import FRICTIONLESS, MOST_MODES, OPEN, SLIP_LEFT, SLIP_RIGHT, STICK
from rockeom.symbolic.algebra import SIDE, rank
from rockeom.symbolic.beds import Combination, both, combinations_of
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.modes.derived import DerivedMode
from rockeom.symbolic.modes.kinematics import SLIP, sign_of_slip
from rockeom.symbolic.valid import repeated


@dataclass(frozen=True)
class ContactMode:
    """A state of each point and of each element; `pattern` is its number in `Modes`."""

    name: str
    points: tuple[int, ...]
    elements: tuple[int, ...]
    pattern: int


@dataclass(frozen=True)
class Pattern:
    """The state of each point, SLIP of either sign, and the mode that moves, on a side s."""

    states: tuple[int, ...]
    mode: int
    side: int
    points: tuple[int, ...]
    """The point that plays the part of each of the mode's."""
    shared: tuple[int, ...]


@dataclass(frozen=True, repr=False)
class Modes:
    """All modes of a model, their patterns and equations."""

    states: tuple[ContactMode, ...]
    patterns: tuple[Pattern, ...]
    derived: tuple[DerivedMode, ...]

    def __repr__(self) -> str:
        return f"<Modes: {len(self.states)} by {len(self.derived)} sets of equations>"

    @property
    def standing(self) -> dict[sp.Symbol, sp.Expr]:
        """Positions at rest with as many points closed as may be."""
        first = self.derived[0]
        return {x: e.subs(first.leaning) for x, e in first.place.items()} | first.leaning

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the modes, in the order of their numbers."""
        return tuple(state.name for state in self.states)

    def signs_of(self, state: ContactMode) -> list[int]:
        """The sign of each slip of the state's mode."""
        pattern = self.patterns[state.pattern]
        groups = self.derived[pattern.mode].slipping
        ways = [state.points[pattern.points[group[0]]] for group in groups]
        return [1 if way == SLIP_RIGHT else -1 for way in ways]

    def signs(self, state: ContactMode) -> dict[sp.Symbol, int]:
        """The side and the signs of slips of a mode."""
        pattern = self.patterns[state.pattern]
        found = {SIDE: pattern.side} if self.mode_of(state).sided else {}
        slips = {sign_of_slip(i): sign for i, sign in enumerate(self.signs_of(state))}
        return found | slips

    def mode_of(self, state: ContactMode) -> DerivedMode:
        """The equations of motion of a mode."""
        return self.derived[self.patterns[state.pattern].mode]


def derive_modes(model: ContactDeclaration) -> Modes:
    """All modes of a model.

    Raises ValueError where statics does not tell how closed points share their forces, and where
    there are more than MOST_MODES.
    """
    patterns: list[Pattern] = []
    derived: list[DerivedMode] = []
    states: list[ContactMode] = []
    known: dict[tuple[int, ...], int] = {}
    mirror = _mirror(model)
    every = combinations_of(model.switching)
    for closed in _closed_sets(model):
        all_stuck = DerivedMode(model, _stuck(model, closed), False)
        groups, held = all_stuck.groups, all_stuck.held
        for kinds in product(*((FRICTIONLESS if g in held else STICK, SLIP) for g in groups)):
            if any(
                kind == SLIP and any(model.contacts[i].law.friction is None for i in group)
                for kind, group in zip(kinds, groups, strict=True)
            ):
                continue
            points = [FRICTIONLESS if i in closed else OPEN for i in range(len(model.contacts))]
            for kind, group in zip(kinds, groups, strict=True):
                for i in group:
                    points[i] = kind
            pattern = _pattern(model, tuple(points), groups, mirror, known, derived)
            patterns.append(pattern)
            mode = derived[pattern.mode]
            _ = mode.dependent  # raises where it cannot move or stand so
            _are_few(model, len(states) + 2 ** len(mode.slipping) * len(every))
            states += _states(model, pattern, mode, len(patterns) - 1, every)
    twice = repeated(state.name for state in states)
    if twice:
        raise ValueError(
            f"{model.name}: two modes would be called {twice[0]!r}: choose names of "
            "contacts and elements that do not make one another's"
        )
    return Modes(tuple(states), tuple(patterns), tuple(derived))


def _are_few(model: ContactDeclaration, number: int) -> None:
    if number > MOST_MODES:
        raise ValueError(
            f"{model.name}: its {len(model.contacts)} contacts and {len(model.switching)} elements "
            f"have more than {MOST_MODES} modes: declare fewer of them"
        )


def _stuck(model: ContactDeclaration, closed: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(STICK if i in closed else OPEN for i in range(len(model.contacts)))


def _mirror(model: ContactDeclaration) -> list[int]:
    """The point on the other side of each, itself where it has none."""
    found = []
    for i, c in enumerate(model.contacts):
        image = [
            j
            for j, o in enumerate(model.contacts)
            if c.side and (o.gap, o.slip, o.law, o.side) == (c.gap, c.slip, c.law, -c.side)
        ]
        found.append(image[0] if image else i)
    return found


def _closed_sets(model: ContactDeclaration) -> list[tuple[int, ...]]:
    """Sets of points that may be closed together, the largest first, made of those of one less."""
    sets: list[list[tuple[int, ...]]] = [[()]]
    while sets[-1]:
        smaller = set(sets[-1])
        larger = [
            (*closed, i)
            for closed in sets[-1]
            for i in range(max(closed, default=-1) + 1, len(model.contacts))
            if all((*closed[:k], *closed[k + 1 :], i) in smaller for k in range(len(closed)))
        ]
        sets.append([closed for closed in larger if _may_close(model, closed)])
        _are_few(model, sum(map(len, sets)))
    return [closed for some in reversed(sets) for closed in some]


def _may_close(model: ContactDeclaration, closed: tuple[int, ...]) -> bool:
    """Whether points may be closed together, whatever the parameters are."""
    if len(closed) < 2:
        return True
    mode = DerivedMode(model, _stuck(model, closed), False)
    if any(not gap.free_symbols & set(mode.q) for gap in mode.left_open):
        return False  # but for parameters that happen to make them meet
    matrix = sp.Matrix.vstack(*mode.normal_rows.values())
    if rank(matrix.subs(mode.leaning)) == len(closed):
        return True
    if mode.left_open and not _meet(mode):
        return False
    names = ", ".join(model.contacts[i].name for i in closed)
    raise ValueError(
        f"{model.name}: {names} may close at once, and statics leaves open how they share "
        "their forces: leave out those between others, or declare them as springs (Unilateral)"
    )


def _meet(mode: DerivedMode) -> bool:
    """Whether all closed gaps can be zero at once, at random parameters."""
    rng = np.random.default_rng(2)
    gaps = sp.Matrix(mode.left_open)
    places = [x for x in mode.q if gaps.has(x)]
    given = sorted(gaps.free_symbols - set(places), key=str)
    put = {x: sp.Float(rng.uniform(0.5, 1.5)) for x in given}
    value = sp.lambdify(places, gaps.subs(put).doit(), modules="math")
    slope = sp.lambdify(places, gaps.jacobian(places).subs(put), modules="math")
    x = rng.uniform(-0.1, 0.1, len(places))
    for _ in range(100):
        slopes = np.array(slope(*x), dtype=float)
        x = x - np.linalg.lstsq(slopes, np.array(value(*x), dtype=float).ravel(), rcond=None)[0]
    return bool(np.abs(np.array(value(*x), dtype=float)).max() < 1e-9)


def _pattern(
    model: ContactDeclaration,
    pattern: tuple[int, ...],
    groups: tuple[tuple[int, ...], ...],
    mirror: list[int],
    known: dict[tuple[int, ...], int],
    derived: list[DerivedMode],
) -> Pattern:
    """The pattern of some states of points, its mode one of those before or new."""
    points = tuple(range(len(pattern)))
    image = tuple(pattern[mirror[i]] for i in points)
    shared = tuple(next((g[0] for g in groups if i in g), i) for i in points)
    # written for the right side, where there is one
    written = image if _leans(model, pattern, image) < 0 else pattern
    if written not in known:
        known[written] = len(derived)
        derived.append(DerivedMode(model, written, image != pattern))
    if written == pattern:
        return Pattern(pattern, known[written], 1, points, shared)
    return Pattern(pattern, known[written], -1, tuple(mirror), shared)


def _leans(model: ContactDeclaration, pattern: tuple[int, ...], image: tuple[int, ...]) -> int:
    """The side of the first closed point that is not closed in the image alike."""
    for i, (state, other) in enumerate(zip(pattern, image, strict=True)):
        if state != other and state != OPEN:
            return model.contacts[i].side
    return 1


def _states(
    model: ContactDeclaration,
    pattern: Pattern,
    mode: DerivedMode,
    number: int,
    of_elements: Mapping[Combination, list[str]],
) -> Iterator[ContactMode]:
    groups = [tuple(sorted(pattern.points[i] for i in g)) for g in mode.groups]
    slips = [g for g in groups if pattern.states[g[0]] == SLIP]
    smooth = _pairs(model, [i for i, s in enumerate(pattern.states) if s == FRICTIONLESS])
    for signs in product((SLIP_RIGHT, SLIP_LEFT), repeat=len(slips)):
        ways = dict(zip(slips, signs, strict=True))
        points = list(pattern.states)
        for group, sign in ways.items():
            for i in group:
                points[i] = sign
        states_of = {g: ways.get(g, STICK) for g in groups} | dict.fromkeys(smooth, FRICTIONLESS)
        of_points = _words(model, {g: states_of[g] for g in sorted(states_of)})
        for elements, words in of_elements.items():
            name = "_".join([*of_points, *words]) or model.open_mode
            yield ContactMode(name, tuple(points), elements, number)


def _pairs(model: ContactDeclaration, points: list[int]) -> list[tuple[int, ...]]:
    """Frictionless points, of which a left and a right one of one kind have one name."""
    found: list[tuple[int, ...]] = []
    for i in points:
        names = [model.contacts[j].name for j in (*found[-1], i)] if found else []
        if len(names) == 2 and both(names) != "_".join(names):
            found[-1] += (i,)
        else:
            found.append((i,))
    return found


def _words(model: ContactDeclaration, groups: Mapping[tuple[int, ...], int]) -> list[str]:
    """Words of a mode's name: closed points, and directions of slips."""
    slides = {SLIP_RIGHT: "_slides_right", SLIP_LEFT: "_slides_left"}
    return [
        both([model.contacts[i].name for i in group]) + slides.get(state, "")
        for group, state in groups.items()
    ]
