"""The comparison of bits notices what it is there for."""

import numpy as np

from tests.golden.__main__ import difference

MOTION = {"t": np.array([0.0, 1.0, np.nan]), "mode": np.array(["left", "right"])}


def test_equal_bits_have_no_difference():
    assert difference(MOTION, {name: array.copy() for name, array in MOTION.items()}) == ""


def test_last_bits_lengths_words_and_missing_arrays_differ():
    last_bit = MOTION | {"t": np.array([0.0, np.nextafter(1.0, 2.0), np.nan])}
    assert difference(MOTION, last_bit) == "t by 2.22e-16, of 1"
    assert difference(MOTION, MOTION | {"t": np.array([-0.0, 1.0, np.nan])}).startswith("t by 0")
    assert difference(MOTION, MOTION | {"t": MOTION["t"][:2]}).startswith("t (3,) (2,)")
    assert difference(MOTION, MOTION | {"mode": np.array(["left", "rigid"])})
    assert difference(MOTION, {"t": MOTION["t"]}) == "mode only before"
