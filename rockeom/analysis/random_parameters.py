"""Independent random parameters, and the same as standard normal deviates.

A deviate u of a parameter x is the normal number of the same probability, Phi(u) = F(x). With it
every distribution is the normal one, whatever its range: reliability and identification search and
sample there.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from scipy.special import ndtr

from rockeom.numbers.checks import InputError, require
from rockeom.numbers.dual import Dual


@dataclass(frozen=True)
class RandomParameters:
    """Independent random parameters as standard normal deviates u (..., k)."""

    names: tuple[str, ...]
    marginals: tuple[Any, ...]

    @classmethod
    def of(cls, where: str, random: Mapping[str, Any], argument: str = "random") -> Self:
        """argument : of the function `where`, that holds the distributions, for its errors."""
        require(bool(random), where, argument, {}, "give a distribution of each parameter")
        for name, marginal in random.items():
            if not all(hasattr(marginal, part) for part in ("ppf", "isf", "logpdf")):
                raise InputError(argument, of=where).wrong(
                    f"has {name} = {marginal!r}: give a continuous distribution with its "
                    "parameters, such as scipy.stats.norm(0.1, 0.01), and let the function that "
                    "takes it have the numbers that are known"
                )
        return cls(tuple(random), tuple(random.values()))

    def columns(self, u: np.ndarray) -> list[np.ndarray]:
        """Values of each parameter; each tail from its own end, so that none loses its digits."""
        return [
            np.where(x > 0, of.isf(ndtr(-x)), of.ppf(ndtr(x)))
            for of, x in zip(self.marginals, np.moveaxis(u, -1, 0), strict=True)
        ]

    def table(self, u: np.ndarray) -> np.ndarray:
        """Rows for `simulate_many`, of deviates u (n, k)."""
        rows = np.empty(len(u), dtype=[(name, float) for name in self.names])
        for name, column in zip(self.names, self.columns(u), strict=True):
            rows[name] = column
        return rows

    def each(self, u: np.ndarray) -> list[dict[str, float]]:
        """Values by name, of each of the deviates u (n, k)."""
        rows = np.transpose(self.columns(u)).tolist()
        return [dict(zip(self.names, row, strict=True)) for row in rows]

    def values(self, u: np.ndarray) -> dict[str, float]:
        """Values by name, of deviates u (k,)."""
        values = (
            of.isf(ndtr(-x)) if x > 0 else of.ppf(ndtr(x))
            for of, x in zip(self.marginals, u, strict=True)
        )
        return dict(zip(self.names, map(float, values), strict=True))

    def duals(self, u: np.ndarray) -> dict[str, Dual]:
        """Values by name with their derivatives by u, of deviates u (k,)."""
        values = self.values(u)
        log_density = -0.5 * u**2 - 0.5 * math.log(2 * math.pi)
        slopes = [
            math.exp(of_u - of.logpdf(x))
            for of_u, of, x in zip(log_density, self.marginals, values.values(), strict=True)
        ]
        return {
            name: Dual(x, direction)
            for (name, x), direction in zip(values.items(), np.diag(slopes), strict=True)
        }


def in_words(values: Mapping[str, float]) -> str:
    """Parameters with their values."""
    return ", ".join(f"{name} = {x:.6g}" for name, x in values.items())
