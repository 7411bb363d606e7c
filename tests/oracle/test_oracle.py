"""Machine code beside Python itself: two structures here, and all of them by `make oracle`."""

import numpy as np
import pytest

import rockeom as rk
from tests.machine_code import functions
from tests.oracle.ways import (
    ROUNDING,
    by_numba,
    by_numpy,
    differences,
    flat,
    printed,
    python,
    run,
)
from tests.typical import S1

STRUCTURES = {
    "flexible structure": rk.FlexibleStructure(**S1, stiffness=571.8e3, damping=502.4),
    "controlled wall": rk.ControlledWall.thesis(),
}


@pytest.mark.parametrize("structure", STRUCTURES.values(), ids=STRUCTURES)
def test_functions_of_a_structure_have_the_bits_of_python(structure):
    module = structure.module
    plain, machine = python(module, "DOP853"), printed(module)
    assert not differences(module, structure.vector, plain, machine, seeds=30)


def test_numpy_functions_numba_and_machine_code_give_the_same_rates():
    """All structures: `make oracle`, and tests/codegen/test_generated_functions.py."""
    structure = STRUCTURES["flexible structure"]
    module, vector = structure.module, structure.vector
    machine = printed(module)
    jitted = {"ask_rates": by_numba(module)["ask_rates"]}
    arrays = by_numpy(module, rk.derive(rk.FlexibleStructure))
    assert not differences(module, vector, jitted, machine, seeds=30)
    assert not differences(module, vector, arrays, machine, seeds=30, ulps=ROUNDING)


def test_contraction_changes_last_digits_only():
    structure = STRUCTURES["flexible structure"]
    one, other = printed(structure.module), printed(structure.module, contract=True)
    assert not differences(structure.module, structure.vector, one, other, seeds=30, ulps=64.0)


@pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])
def test_whole_motions_have_the_bits_of_python(method):
    """Steps, events and dense output of the loop, each operation rounded by itself."""
    structure = STRUCTURES["flexible structure"]
    plain = python(structure.module, method)
    machine = functions("", structure.module, method, contract=False)
    size = plain["SCRATCH"]
    one = run(flat(plain["integrate"]), structure, size, 0.5, method)
    other = run(machine["integrate"], structure, size, 0.5, method)
    assert one[0] == other[0]
    assert len(one[5].nonzero()[0]) >= 2  # events
    for a, b in zip(one[1:], other[1:], strict=True):
        np.testing.assert_array_equal(a, b)


def test_a_wrong_number_is_noticed():
    """The questions reach the functions: one that is changed is told."""
    structure = STRUCTURES["flexible structure"]
    module = structure.module
    plain = python(module, "DOP853")
    assert "ask_rates" in plain
    right = plain["ask_rates"]

    def wrong(mode, y, p, ax, ay, out):
        right(mode, y, p, ax, ay, out)
        out[1] = np.nextafter(out[1], np.inf)

    found = differences(module, structure.vector, {**plain, "ask_rates": wrong}, printed(module), 2)
    assert found
    assert all("ask_rates" in line for line in found)
