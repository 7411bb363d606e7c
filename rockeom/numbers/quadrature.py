"""Integrals of functions of arrays."""

from collections.abc import Callable

import numpy as np

from rockeom.numbers.functions import gauss_rule


def integral(
    function: Callable[[np.ndarray], np.ndarray], a: float, b: float, tolerance: float = 1e-13
) -> float:
    """Integral from a to b by Gauss-Legendre panels, halved until it stays.

    tolerance : of the integral of the absolute value.
    """
    nodes, weights = gauss_rule(16)
    previous, panels = np.inf, 4
    while panels <= 2**14:
        edges = np.linspace(a, b, panels + 1)
        half = np.diff(edges)[:, None] / 2
        terms = function(edges[:-1, None] + half * (1 + nodes)) * half * weights
        value = float(terms.sum())
        if abs(value - previous) <= tolerance * np.abs(terms).sum():
            return value
        previous, panels = value, 2 * panels
    raise ArithmeticError(f"the integral from {a} to {b} does not settle: is the integrand finite?")
