"""Cases of spatial rocking with numbers of 18 digits: `cases.json`.

Newton-Euler in 40 digits (Gragg, Bulirsch and Stoer), compared with Lagrange's equations in two
sets of coordinates to 8e-36. Axes are x, y horizontal and z up; places are relative to the ground;
gravity is 9.81 m/s2. Tolerances are relative to the largest number of a vector.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np

import rockeom as rk

GRAVITY = 9.81
TIGHT = rk.SolverOptions(rtol=1e-13, atol=1e-15)
CASES: dict[str, dict[str, Any]] = {
    case["name"]: case
    for case in json.loads(Path(__file__).with_name("cases.json").read_text(encoding="utf-8"))
}


def of_group(*groups: str) -> list[str]:
    """Names of the cases of some groups."""
    return [name for name, case in CASES.items() if case["group"] in groups]


class Case:
    """A case: what is given by name, and `right`, what is to follow."""

    def __init__(self, name: str) -> None:
        case = CASES[name]
        self.given = {**case["parameters"], **case["inputs"]}
        self.expected, self.tolerance = case["expected"], float(case["tolerance"])

    def __getitem__(self, name: str) -> float:
        return float(self.given[name])

    def right(self, name: str) -> Any:
        """A number or a vector that is to follow."""
        value = self.expected[name]
        return np.array(value, float) if isinstance(value, list) else float(value)

    def agrees(self, **values: Any) -> None:
        """Assert that values are those expected, relative to the largest number of a vector."""
        for name, value in values.items():
            right = self.right(name)
            assert np.shape(value) == np.shape(right)
            size = np.abs(right).max() or 1.0
            error = np.abs(np.asarray(value) - right).max() / size
            assert error <= self.tolerance, f"{name}: {value}, and {right} is right ({error:.1e})"
