"""Indices that leave their array are reported by compiled programs, where they are checked."""

import threading

import numpy as np
import pytest

import rockeom as rk
from rockeom.compiler.machine import OutOfBoundsError
from rockeom.integrator import printing, program
from tests.machine_code import HEAD, functions

TEXT = (
    HEAD
    + """
TABLE = np.arange(6.0).reshape(2, 3)
STATES = ((0, 1, 2), (3, 4, 5))

def first(part):
    return part[0]

@entry
def read(a: Floats, i: int):
    return a[i]

@entry
def write(a: Floats, i: int):
    a[i] = 1.0

@entry
def change(a: Floats, i: int):
    a[i] += 1.0

@entry
def scratch(a: Floats, i: int):
    own = np.zeros(4)
    own[i] = 1.0
    return own[i]

@entry
def element(a: Floats, i: int):
    return TABLE[1][i]

@entry
def row(a: Floats, i: int):
    return TABLE[i][1]

@entry
def state(a: Floats, i: int):
    return STATES[i][i]

@entry
def from_here(a: Floats, i: int):
    return first(a[i:])

@entry
def fill(a: Floats, i: int):
    a[0:i] = 2.0

@entry
def backwards(a: Floats, i: int):
    return len(a[i:0])

@entry
def within_a_part(a: Floats, i: int):
    part = a[2:]
    return part[i]

@entry
def two_dimensions(a: Floats2, i: int, j: int):
    return a[i, j]

@entry
def last(a: Floats, i: int):
    return a[-1] + a[len(a) - 1]

@entry
def derivative(a: Duals, i: int):
    own = np.zeros(4)
    own[i] = a[0]
    return rate(own[i])
"""
)
FOUR = np.arange(4.0)
LEAVES = {  # index, size of what it leaves; size - 1 is the last that does not
    "read": (4, 4), "write": (4, 4), "change": (4, 4), "scratch": (4, 4), "element": (3, 3),
    "row": (2, 2), "state": (2, 2), "fill": (5, 4), "within_a_part": (2, 2), "from_here": (5, 4),
}  # fmt: skip


@pytest.fixture(scope="module")
def compiled():
    return functions(TEXT, bounds=True)


@pytest.fixture(scope="module")
def plain():
    return functions(TEXT)


def line_of(name: str, code: str) -> int:
    lines = TEXT.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(f"def {name}("))
    return next(i + 1 for i in range(start, len(lines)) if code in lines[i])


@pytest.mark.parametrize("name", LEAVES)
def test_an_index_beyond_its_array_is_reported_with_file_line_and_size(compiled, name):
    index, size = LEAVES[name]
    array, code = FOUR.copy(), {"fill": "0:i]", "from_here": "i:]"}.get(name, "[i]")
    said = (
        f"the test's text, line {line_of(name, code)}: index {index} is out of bounds for an axis"
    )
    with pytest.raises(OutOfBoundsError, match=f"{said} of size {size}"):
        compiled[name](array, index)
    assert issubclass(OutOfBoundsError, IndexError)
    np.testing.assert_array_equal(array[1:], FOUR[1:])  # nothing but its own numbers


@pytest.mark.parametrize("name", LEAVES)
@pytest.mark.parametrize("index", [-1, -(10**12), 10**12])
def test_a_computed_index_that_is_negative_or_far_away_is_a_fault_and_no_crash(
    compiled, name, index
):
    with pytest.raises(OutOfBoundsError, match=f"index {index} is out of bounds"):
        compiled[name](FOUR.copy(), index)


@pytest.mark.parametrize("name", LEAVES)
def test_an_index_within_its_array_is_no_fault(compiled, plain, name):
    for index in (0, 1):
        one, other = FOUR.copy(), FOUR.copy()
        assert compiled[name](one, index) == plain[name](other, index)
        np.testing.assert_array_equal(one, other)


def test_ends_of_slices_may_be_the_length_and_lie_in_order(compiled):
    array = FOUR.copy()
    compiled["fill"](array, 4)
    np.testing.assert_array_equal(array, 2.0)
    assert compiled["backwards"](array, 0) == 0
    with pytest.raises(OutOfBoundsError, match="index 1 is out of bounds for an axis of size 0"):
        compiled["backwards"](array, 1)
    with pytest.raises(OutOfBoundsError, match="index 0 is out of bounds for an axis of size 0"):
        compiled["from_here"](array, 4)  # of the empty part that is handed on


def test_each_dimension_has_its_own_size(compiled):
    array = np.arange(6.0).reshape(2, 3)
    assert compiled["two_dimensions"](array, 1, 2) == 5.0
    for i, j, said in ((0, 3, "index 3 .* size 3"), (2, 0, "index 2 .* size 2")):
        with pytest.raises(OutOfBoundsError, match=said):
            compiled["two_dimensions"](array, i, j)


def test_a_constant_negative_index_counts_from_the_end(compiled):
    assert compiled["last"](FOUR, 0) == 6.0
    with pytest.raises(OutOfBoundsError, match=r"index -1 .* size 0"):
        compiled["last"](np.empty(0), 0)


def test_numbers_with_derivatives_are_checked_where_they_lie(compiled):
    numbers = np.arange(17.0)[None]
    assert compiled["derivative"](numbers, 3) == 1.0
    with pytest.raises(OutOfBoundsError, match=r"index 4 .* size 4"):
        compiled["derivative"](numbers, 4)


def test_a_fault_is_raised_once_by_the_call_that_has_it(compiled):
    """Not by the next, nor by one of another thread at the same time."""
    with pytest.raises(OutOfBoundsError):
        compiled["read"](FOUR, 4)
    assert compiled["read"](FOUR, 3) == 3.0
    said: list[bool] = []

    def ask(index):
        for _ in range(200):
            try:
                compiled["read"](FOUR, index)
            except OutOfBoundsError:
                said.append(index == 4)
            else:
                said.append(index == 3)

    threads = [threading.Thread(target=ask, args=(i,)) for i in (3, 4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert said == [True] * 400


def test_programs_with_checks_have_a_name_and_a_hash_of_their_own(monkeypatch):
    """What is stored for one is never run for the other, and without the option nothing changes."""
    module = rk.RigidBlock(half_width=0.1, half_height=0.4).module
    plain, checked = (printing.printed(module, "DOP853", program.LOOP, b) for b in (False, True))
    assert "out_of_bounds" not in plain.ir()
    assert "@spare" not in plain.ir()
    assert "out_of_bounds" in checked.ir()
    keys = [program._key(module, "DOP853", program.LOOP, b) for b in (False, True)]
    assert keys[0][0] != keys[1][0]
    assert keys[0][1] != keys[1][1]
    without = program.revision(module, "DOP853")
    monkeypatch.setenv("ROCKEOM_CHECK_BOUNDS", "1")
    assert program.revision(module, "DOP853") != without
    monkeypatch.setenv("ROCKEOM_CHECK_BOUNDS", "0")
    assert program.revision(module, "DOP853") == without


def test_the_half_that_loops_share_is_the_same_with_checks():
    """Names of texts are in it that are the structure's own: only those that it wants."""
    texts = [
        printing.printed(block.module, "DOP853", program.LOOP, True).halves()[1]
        for block in (
            rk.RigidBlock(half_width=0.1, half_height=0.4),
            rk.SlenderBlock(alpha=0.2, radius=1.0),
        )
    ]
    assert texts[0] == texts[1]
