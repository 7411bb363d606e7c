"""Combinations of states that the elements of a structure may have.

The displacements of springs in a row are linear along it, d_i = d_0 + t_i (d_1 - d_0), whatever the
structure does. So the springs with closed gaps are those on one side of a place in the row; where
damping over stiffness is the same for all, so are those whose forces k d + c d' do not pull, and
those that press, which are in both sets, are neighbours: n (n + 1)/2 + 1 sets of 2^n. An end of the
set is the first to open, and a neighbour of an end the first to close.
"""

from collections.abc import Sequence
from itertools import chain, product
from math import prod

import sympy as sp

from rockeom.symbolic.elements import Switching, Unilateral

Combination = tuple[int, ...]


def rows_of(elements: Sequence[Switching]) -> list[tuple[int, ...]]:
    """Numbers of the elements in each row, in their order along it; others are rows of one."""
    rows: list[list[int]] = []
    for i, element in enumerate(elements):
        for row in rows:
            if _place(elements, row, element) is not None:
                row.append(i)
                break
        else:
            rows.append([i])

    return [
        tuple(sorted(row, key=lambda i: _place(elements, row, elements[i]) or 0)) for row in rows
    ]


def combinations_of(elements: Sequence[Switching]) -> dict[Combination, list[str]]:
    """All combinations of states that elements may have, the first states first, and their words.

    The words are those of which a mode's name is made.
    """
    rows = rows_of(elements)
    found = []
    for chosen in product(*(_of_row(elements, row) for row in rows)):
        states = dict(zip(chain(*rows), chain(*chosen), strict=True))
        found.append(tuple(states[i] for i in range(len(elements))))
    order = [{state: k for k, state in enumerate(e.states)} for e in elements]
    found.sort(key=lambda c: [places[x] for places, x in zip(order, c, strict=True)])
    return {combination: _words(elements, rows, combination) for combination in found}


def number_of_combinations(elements: Sequence[Switching]) -> int:
    """Number of them."""
    sizes = [(len(row), len(elements[row[0]].states)) for row in rows_of(elements)]
    return prod(states if n == 1 else n * (n + 1) // 2 + 1 for n, states in sizes)


def both(names: Sequence[str]) -> str:
    """The names of points in one word, a left and a right one of one kind as both."""
    if len(names) == 2:
        left, right = names
        kind = left.removesuffix("left")
        if (left, right) == (f"{kind}left", f"{kind}right"):
            return f"{kind}both"
    return "_".join(names)


def _words(
    elements: Sequence[Switching], rows: Sequence[Sequence[int]], combination: Combination
) -> list[str]:
    """The names of elements by what they do; of three or more neighbours the first and the last."""
    names = {i: element.name for i, element in enumerate(elements)}
    for row in rows:
        pressed = [i for i in row if combination[i] == 1]
        if len(row) > 1 and len(pressed) > 2:
            names[min(pressed)] = f"{names[pressed[0]]}_to_{names[pressed[-1]]}"
            for i in sorted(pressed)[1:]:
                del names[i]
    by_word: dict[str, list[str]] = {}
    for i, name in names.items():
        word = elements[i].word(combination[i])
        if word is not None:
            by_word.setdefault(word, []).append(name)
    return [both(of) + word for word, of in by_word.items()]


def _of_row(elements: Sequence[Switching], row: Sequence[int]) -> list[Combination]:
    n = len(row)
    if n == 1:
        return [(state,) for state in elements[row[0]].states]
    pressed = [(first, end) for first in range(n) for end in range(first + 1, n + 1)]
    return [(0,) * n, *((0,) * a + (1,) * (z - a) + (0,) * (n - z) for a, z in pressed)]


def _place(
    elements: Sequence[Switching], row: Sequence[int], element: Switching
) -> sp.Rational | None:
    """t of an element in a row, whose first two have 0 and 1; None where it does not fit there."""
    first, second = elements[row[0]], elements[row[:2][-1]]
    if element is first:
        return sp.S.Zero
    if not (isinstance(first, Unilateral) and isinstance(element, Unilateral)):
        return None
    uneven = first.stiffness * element.damping - element.stiffness * first.damping
    if first.stiffness == 0 or sp.expand(uneven) != 0:
        return None
    apart = sp.expand(element.displacement - first.displacement)
    if len(row) == 1:
        return None if apart == 0 else sp.S.One
    ratio = sp.cancel(apart / sp.expand(second.displacement - first.displacement))
    return ratio if ratio.is_Rational else None
