"""Draws from a posterior by a Hamiltonian sampler, whose package is the extra `bayes`."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Any, Self

import numpy as np

from rockeom.analysis.identification.fitting import CONFIDENCE
from rockeom.numbers.checks import installed_by, require

__all__ = ["Draws"]

DEEPEST = 8
"""A trajectory has at most two to this power steps."""
ACCEPTED = 0.8
"""Part of the proposals that the step is to let pass."""


@dataclass(frozen=True, eq=False)
class Draws:
    """Parameters drawn from a posterior.

    Parameters
    ----------
    values : dict of str to ndarray
        Values (chains, draws) of each parameter, by name.
    gradients : int
        Number of evaluations of the tests, each a motion with its derivatives.
    outcomes : dict of str to int
        How often the tests were predicted with each outcome, warm-up included.
    diverging : int
        Number of trajectories that met a density too steep for the step; more than a few say that
        the draws lack a part of the posterior.
    """

    values: dict[str, np.ndarray]
    gradients: int
    outcomes: dict[str, int]
    diverging: int

    def interval(self, name: str, confidence: float = CONFIDENCE) -> tuple[float, float]:
        """Central interval of a parameter with a probability.

        Parameters
        ----------
        name : str
            Name of the parameter.
        confidence : float, optional
            Probability of the interval, between 0 and 1.

        Returns
        -------
        low : float
            Lower end, in the unit of the parameter.
        high : float
            Upper end.

        Raises
        ------
        KeyError
            For an unknown name.
        ValueError
            For a confidence beyond 0 to 1.
        """
        rule = "give one such as .95"
        require(0 < confidence < 1, "Draws.interval", "confidence", confidence, rule)
        ends = (0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence)
        low, high = np.quantile(self.values[name], ends)
        return float(low), float(high)

    @property
    def mean(self) -> dict[str, float]:
        """Mean of each parameter, by name."""
        return {name: float(x.mean()) for name, x in self.values.items()}

    @property
    def standard_deviation(self) -> dict[str, float]:
        """Standard deviation of each parameter, by name."""
        return {name: float(x.std()) for name, x in self.values.items()}

    @property
    def effective_number(self) -> dict[str, float]:
        """Independent draws that are worth as much, of each parameter (Vehtari et al. 2021)."""
        return self._by_name("ess")

    @property
    def rhat(self) -> dict[str, float]:
        """Disagreement of the chains, of each parameter: 1, to 0.01 (Vehtari et al. 2021)."""
        return self._by_name("rhat")

    def _by_name(self, what: str) -> dict[str, float]:
        _, stats = _packages()
        of = getattr(stats, what)
        return {n: float(of(x, chain_axis=0, draw_axis=1)) for n, x in self.values.items()}

    def rows(self, number: int) -> np.ndarray:
        """Rows for `simulate_many`: draws at equal distances.

        Parameters
        ----------
        number : int
            Number of rows.

        Returns
        -------
        ndarray
            Structured array (number,) with a field of each parameter.

        Raises
        ------
        ValueError
            For more rows than there are draws.
        """
        total = next(iter(self.values.values())).size
        rule = f"there are {total} draws"
        require(1 <= number <= total, "Draws.rows", "number", number, rule)
        chosen = np.linspace(0, total - 1, number).astype(int)
        rows = np.empty(number, dtype=[(name, float) for name in self.values])
        for name, x in self.values.items():
            rows[name] = x.ravel()[chosen]
        return rows

    def summary(self, confidence: float = CONFIDENCE) -> str:
        """Parameters in words, a line each.

        Parameters
        ----------
        confidence : float, optional
            Probability of the intervals, between 0 and 1.

        Returns
        -------
        str
            Text of several lines.
        """
        chains, draws = next(iter(self.values.values())).shape
        lines = [f"{100 * confidence:g} % intervals of {chains} chains of {draws} draws:"]
        for name, mean in self.mean.items():
            low, high = self.interval(name, confidence)
            worth = f"worth {self.effective_number[name]:.0f} draws, R-hat {self.rhat[name]:.3f}"
            lines.append(f"{name} = {mean:.5g}, {low:.5g} to {high:.5g}; {worth}")
        outcomes = ", ".join(f"{word}: {n}" for word, n in self.outcomes.items())
        lines.append(f"{self.gradients} gradients; {outcomes}; {self.diverging} diverging")
        return "\n".join(lines)


_Density = Callable[[np.ndarray], tuple[float, np.ndarray]]
"""Logarithm of a density and its gradient, at a place (k,)."""


@dataclass(frozen=True, eq=False)
class Ridge:
    """Coordinates v of a density about its mode, in which it is nearly the standard normal one.

    A place is mode + axes (v + bends[v, v]/2). axes (k, k) : principal axes of the normal
    approximation, the longest first, by their standard deviations. bends (k, k, k) : of each axis
    along longer ones. A product that the tests determine well and its factors badly, as of the
    energy ratios of two feet, makes a ridge that is bent, on which steps would be short. Each axis
    is moved by a function of longer ones alone: that keeps volumes, and the density as it is.
    """

    density: _Density
    mode: np.ndarray
    axes: np.ndarray
    bends: np.ndarray

    @classmethod
    def of(cls, density: _Density, mode: np.ndarray, covariance: np.ndarray) -> Self:
        """Bends follow from gradients one standard deviation to both sides of the mode."""
        k = len(mode)
        size, ways = np.linalg.eigh(covariance)
        axes = ways[:, ::-1] * np.sqrt(size[::-1])
        here = density(mode)[1] @ axes

        def second(v: np.ndarray) -> np.ndarray:
            sides = (density(mode + axes @ x)[1] @ axes for x in (v, -v))
            return np.sum([*sides, -2.0 * here], axis=0)

        unit = np.eye(k)
        along = [second(v) for v in unit]
        bends = np.zeros((k, k, k))
        for a, b in combinations_with_replacement(range(k), 2):
            both = along[a]
            if a != b:
                both = second((unit[a] + unit[b]) / math.sqrt(2)) - 0.5 * (along[a] + along[b])
            bends[b + 1 :, a, b] = bends[b + 1 :, b, a] = both[b + 1 :]
        return cls(density, mode, axes, bends)

    def places(self, v: np.ndarray) -> np.ndarray:
        """Places of coordinates v, both (..., k)."""
        bent = 0.5 * np.einsum("iab,...a,...b->...i", self.bends, v, v)
        return self.mode + (v + bent) @ self.axes.T

    def at(self, v: np.ndarray) -> tuple[float, np.ndarray]:
        """Logarithm of the density and its gradient by v (k,)."""
        value, gradient = self.density(self.places(v))
        slope = gradient @ self.axes
        return value, slope + slope @ (self.bends @ v)


def hamiltonian_draws(
    ridge: Ridge, draws: int, chains: int, warm_up: int, seed: int
) -> tuple[np.ndarray, int]:
    """Draws (chains, draws, k) of the places of a density, and how many trajectories diverged."""
    mici, _ = _packages()
    density, k = ridge.at, len(ridge.mode)

    def slope(v: np.ndarray) -> tuple[np.ndarray, float]:
        value, gradient = density(v)
        return -gradient, -value

    rng = np.random.default_rng(seed)
    system = mici.systems.EuclideanMetricSystem(
        neg_log_dens=lambda v: -density(v)[0], grad_neg_log_dens=slope
    )
    sampler = mici.samplers.DynamicMultinomialHMC(
        system, mici.integrators.LeapfrogIntegrator(system), rng, max_tree_depth=DEEPEST
    )
    sampled = sampler.sample_chains(
        warm_up, draws, [_start(density, k, rng) for _ in range(chains)],
        adapters=[mici.adapters.DualAveragingStepSizeAdapter(ACCEPTED)],
        trace_funcs=[lambda state: {"v": state.pos}], monitor_stats=[], display_progress=False,
    )  # fmt: skip
    coordinates = np.array(sampled.traces["v"])
    if np.isnan(coordinates).any():  # the sampler catches an interrupt, its other rows stay empty
        raise KeyboardInterrupt
    diverging = sum(int(np.sum(of)) for of in sampled.statistics["diverging"])
    return ridge.places(coordinates), diverging


def _start(density: _Density, k: int, rng: np.random.Generator) -> np.ndarray:
    """A scattered place with a density that a chain can leave; the mode where none is found."""
    top = density(np.zeros(k))[0]
    for _ in range(20):
        v = rng.standard_normal(k)
        if density(v)[0] > top - 10.0 * k:
            return v
    return np.zeros(k)


def _packages() -> tuple[Any, Any]:
    """The sampler, and the statistics of its chains."""
    try:
        import mici
        from arviz_stats.base import array_stats
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            f"sampling needs {error.name}, which is not installed. Remedy: {installed_by('bayes')}."
        ) from None
    return mici, array_stats
