"""Intervals of an assessment hold the truth as often as they say: simulation with known truth."""

import numpy as np
import pytest

from benchmarks.assessment import LEVEL, Setting, by_capacity, study


@pytest.mark.parametrize(("n", "correlation"), [(3, 0.0), (8, 1.0), (12, 1.0), (12, 0.5)])
def test_what_is_printed_covers_at_its_level(n, correlation):
    counts = study(*by_capacity(Setting(n, correlation, 0.5, (0.6, 0.9, 1.2, 1.6))), 100)
    of_curve = {"band", "PGA at 50 %"} if n > 3 else set()
    assert {"fraction", "gain"} | of_curve <= counts.keys()
    for name, (number, held, _) in counts.items():
        if name != "no curve":
            assert held >= LEVEL - 3.0 * np.sqrt(LEVEL * (1.0 - LEVEL) / number), name
