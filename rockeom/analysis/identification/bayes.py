"""Parameters from tests as probabilities: by Bayes' rule, with exact gradients through impacts.

    from scipy import stats

    tests = [identification.Observed.history(released, t, theta)]
    priors = {"left": stats.uniform(0.6, 0.4), "right": stats.uniform(0.6, 0.4),
              "half_width": stats.uniform(0.07, 0.03), "theta": stats.norm(0.13, 0.01),
              "noise": stats.loguniform(1e-5, 1e-2)}
    found = identification.posterior(tests, priors)
    found.map, found.laplace.interval("left"), found.log_evidence
    draws = found.sample(seed=1)  # by a Hamiltonian sampler, of the extra `bayes`
    draws.interval("left")

All searches are in the standard normal deviates of the priors, in which the prior is the same for
any parameter and no bound is met: of a parameter x with the distribution F, Phi(u) = F(x).
"""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Self

import numpy as np
from scipy.special import gammaln, log_ndtr, ndtri, stdtr

from rockeom.analysis.identification.fitting import CONFIDENCE
from rockeom.analysis.identification.observed import Observed, PredictedReadings
from rockeom.analysis.identification.sampling import Draws, Ridge, hamiltonian_draws
from rockeom.analysis.random_parameters import RandomParameters, in_words
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, require
from rockeom.numbers.dual import tangent_of, value_of

__all__ = ["Laplace", "Posterior", "model_probabilities", "posterior"]

REACH = 8.0
"""Deviates beyond which there is no density: the probability of them is 1e-15, and a value so near
the end of its prior is one with that end in floats."""
TRIALS = 8
"""Two to this power places of the prior are tried before the search for the mode."""
STARTS = 4
"""The best of them from which a search starts."""
SETTLED = 1e-2
"""Distance that the mode may still be off, in standard deviations."""
STEP = 1e-2
"""Step of the differences of gradients, in standard deviations."""
CLEAR = 1.0
"""Information of the tests, in parts of that of the prior, below which they tell less than it."""
REFUSED = "refused by the model"


class _Errors(NamedTuple):
    """Distribution of the errors of measurement over their scale: Student's, or normal for inf."""

    freedom: float

    def log_density(self, z: np.ndarray) -> np.ndarray:
        n = self.freedom
        if math.isinf(n):
            return -0.5 * z**2 - 0.5 * math.log(2 * math.pi)
        size = gammaln((n + 1) / 2) - gammaln(n / 2) - 0.5 * math.log(n * math.pi)
        return size - 0.5 * (n + 1) * np.log1p(z**2 / n)

    def slope(self, z: np.ndarray) -> np.ndarray:
        """Slope of -log_density."""
        n = self.freedom
        return z if math.isinf(n) else (n + 1) * z / (n + z**2)

    def log_tail(self, z: np.ndarray) -> np.ndarray:
        """Logarithm of the probability of an error beyond z."""
        return log_ndtr(-z) if math.isinf(self.freedom) else np.log(stdtr(self.freedom, -z))

    @property
    def information(self) -> tuple[float, float]:
        """Fisher's, of the place and of the logarithm of the scale."""
        n = self.freedom
        return (1.0, 2.0) if math.isinf(n) else ((n + 1) / (n + 3), 2 * n / (n + 3))


class _Parts(NamedTuple):
    """Log likelihood of each value (n,), its slopes and information by prediction and log scale."""

    value: np.ndarray
    by_prediction: np.ndarray
    by_log_scale: np.ndarray
    of_prediction: np.ndarray
    of_log_scale: np.ndarray

    @classmethod
    def of(cls, test: Observed, predicted: np.ndarray, scale: np.ndarray, law: _Errors) -> Self:
        seen = np.abs(test.measured) < test.limit
        z = np.where(seen, test.measured - predicted, 0.0) / scale
        side, place = np.sign(test.measured), law.information
        slope = law.slope(z)
        parts = [
            law.log_density(z) - np.log(scale),
            slope / scale,
            slope * z - 1.0,
            place[0] / scale**2,
            np.full(len(z), place[1]),
        ]
        if not seen.all():
            q = (test.limit - side * predicted) / scale
            tail = law.log_tail(q)
            hazard = np.exp(law.log_density(q) - tail)
            bend = np.maximum(hazard * (hazard - q), 0.0)
            beyond = [tail, side * hazard / scale, hazard * q, bend / scale**2, bend * q**2]
            parts = [np.where(seen, *of) for of in zip(parts, beyond, strict=True)]
        return cls(*parts)


class _Point(NamedTuple):
    """Logarithm of the posterior density of the deviates, its gradient, Fisher's information."""

    value: float
    gradient: np.ndarray
    information: np.ndarray


class _Density:
    """The posterior density of the deviates u (k,), not normalised, and what it was asked for.

    counts : of evaluations with gradients and without, and of outcomes that each test had.
    """

    def __init__(self, tests: tuple[Observed, ...], space: RandomParameters, law: _Errors) -> None:
        self.tests, self.space, self.law = tests, space, law
        self.counts: Counter[str] = Counter()
        self.refusal = ""
        self._last: tuple[bytes, _Point] = b"", self._nothing()

    def _nothing(self) -> _Point:
        k = len(self.space.names)
        return _Point(-math.inf, np.zeros(k), np.eye(k))

    def at(self, u: np.ndarray) -> _Point:
        """With gradient and information of the tests and the prior together."""
        key = u.tobytes()
        if self._last[0] != key:
            self._last = key, self._at(u)
        return self._last[1]

    def _at(self, u: np.ndarray) -> _Point:
        if not np.all(np.abs(u) < REACH):  # where a trajectory leaves every bound, or is lost
            return self._nothing()
        parameters: dict[str, Any] = self.space.duals(u)
        self.counts["gradients"] += 1
        predicted = self.predictions(parameters)
        return self._nothing() if predicted is None else self.joined(u, parameters, predicted)

    def predictions(self, parameters: Mapping[str, Any]) -> list[PredictedReadings] | None:
        """Predictions of all tests; None where one has no answer."""
        try:
            predicted = [test.predict(parameters) for test in self.tests]
        except ValueError as error:
            self.counts[REFUSED] += 1
            self.refusal = str(error)
            return None
        self.counts.update(one.outcome for one in predicted)
        return predicted if all(np.isfinite(one.values).all() for one in predicted) else None

    def joined(
        self, u: np.ndarray, parameters: Mapping[str, Any], predictions: Sequence[PredictedReadings]
    ) -> _Point:
        """The density by the predictions of all tests."""
        k = len(u)
        value, gradient, information = -0.5 * u @ u - 0.5 * k * math.log(2 * math.pi), -u, np.eye(k)
        for test, (predicted, along, _) in zip(self.tests, predictions, strict=True):
            along = along.reshape(len(predicted), -1)
            scale, log_along = _scales(test, parameters, k)
            parts = _Parts.of(test, predicted, scale, self.law)
            value += float(parts.value.sum())
            if along.shape[1] == k:
                gradient = gradient + parts.by_prediction @ along + parts.by_log_scale @ log_along
                information = information + (along.T * parts.of_prediction) @ along
                information += (log_along.T * parts.of_log_scale) @ log_along
        return _Point(value, gradient, information)


def _scales(test: Observed, parameters: Mapping[str, Any], k: int) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations of the readings of a test (n,), and derivatives of their logarithms."""
    scales = [(parameters[of] if isinstance(of, str) else of, n) for of, n in test.noise]
    number = [n for _, n in scales]
    plain = np.repeat([value_of(x) for x, _ in scales], number)
    along = np.repeat([tangent_of(x, k) for x, _ in scales], number, axis=0)
    return plain, along / plain[:, None]


@dataclass(frozen=True, eq=False)
class Laplace:
    """Posterior as a normal distribution of the deviates, with the curvature at its mode.

    Parameters
    ----------
    space : RandomParameters
        Parameters with their priors.
    deviates : ndarray
        Mode (k,) in standard normal deviates of the priors, in the order of `names`.
    deviate_covariance : ndarray
        Covariance of the deviates (k, k).
    log_evidence : float
        Logarithm of the marginal likelihood by this approximation, exact where the posterior is
        normal.
    """

    space: RandomParameters
    deviates: np.ndarray
    deviate_covariance: np.ndarray
    log_evidence: float

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.space.names

    def interval(self, name: str, confidence: float = CONFIDENCE) -> tuple[float, float]:
        """Central interval of a parameter with a probability, within the bounds of its prior.

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
        require(0 < confidence < 1, "Laplace.interval", "confidence", confidence, rule)
        row = dict(zip(self.names, range(len(self.names)), strict=True))[name]
        half = -float(ndtri(0.5 - 0.5 * confidence)) * math.sqrt(self.deviate_covariance[row, row])
        ends = np.tile(self.deviates, (2, 1))
        ends[:, row] += (-half, half)
        low, high = self.space.columns(ends)[row]
        return float(low), float(high)

    @property
    def covariance(self) -> np.ndarray:
        """(k, k) of the parameters, by their slopes at the mode, as that of a `Fit`."""
        slopes = [x.tangent.sum() for x in self.space.duals(self.deviates).values()]
        return self.deviate_covariance * np.outer(slopes, slopes)

    @property
    def standard_error(self) -> dict[str, float]:
        """Standard deviation of each parameter, by name."""
        return dict(zip(self.names, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))


@dataclass(frozen=True, eq=False, repr=False)
class Posterior:
    """Probability of parameters after tests; made by `posterior`.

    Parameters
    ----------
    tests : tuple of Observed
        Measurements.
    space : RandomParameters
        Parameters with their priors.
    mode : ndarray
        Most likely deviates (k,).
    settled : bool
        Whether the search for the mode ended at one.
    density : object
        Density of the deviates, not normalised.
    """

    tests: tuple[Observed, ...]
    space: RandomParameters
    mode: np.ndarray
    settled: bool
    density: _Density

    @property
    def map(self) -> dict[str, float]:
        """Mode, by name: the most likely deviates of the priors, as values of the parameters.

        A mode depends on the scale on which densities are compared; on that of the deviates every
        prior is the same. For normal priors it is the mode of the parameters.
        """
        return self.space.values(self.mode)

    @property
    def counts(self) -> dict[str, int]:
        """How often all tests were predicted, up to now, and with which outcomes, by name.

        "simulations" counts those without derivatives, "gradients" those with them.
        """
        return dict(self.density.counts)

    def log_density(self, **values: float) -> float:
        """Logarithm of prior times likelihood, as a density of the deviates.

        Parameters
        ----------
        **values : float
            Values of the parameters, by name.

        Returns
        -------
        float
            Logarithm of the density, not normalised.
        """
        return self.density.at(self._deviates(values)).value

    def gradient(self, **values: float) -> dict[str, float]:
        """Derivatives of `log_density` by the deviates of each parameter.

        Parameters
        ----------
        **values : float
            Values of the parameters, by name.

        Returns
        -------
        dict of str to float
            Derivatives by name.
        """
        point = self.density.at(self._deviates(values))
        return dict(zip(self.space.names, point.gradient.tolist(), strict=True))

    def _deviates(self, values: Mapping[str, float]) -> np.ndarray:
        if {*values} != {*self.space.names}:
            raise InputError("values", [*values]).give(f"a value of each of {self.space.names}")
        pairs = zip(self.space.names, self.space.marginals, strict=True)
        u = np.array([_deviate(of, values[name]) for name, of in pairs])
        for name, x in zip(self.space.names, u, strict=True):
            require(np.isfinite(x), "log_density", name, values[name], "its prior excludes it")
        return u

    @cached_property
    def laplace(self) -> Laplace:
        """Normal approximation about the mode; its covariance by the derivatives of gradients.

        Raises ValueError where the density does not bend downwards in all directions there.
        """
        k = len(self.mode)
        scale = np.linalg.cholesky(np.linalg.inv(self.density.at(self.mode).information))
        bend = np.empty((k, k))
        for row, direction in enumerate(STEP * scale.T):
            up, down = (self.density.at(self.mode + s * direction).gradient for s in (1.0, -1.0))
            bend[row] = (down - up) @ scale / (2 * STEP)
        bend = 0.5 * (bend + bend.T)
        least = float(np.linalg.eigvalsh(bend)[0])
        if not least > 0.0:
            raise ValueError(
                f"laplace: the density does not fall off from {in_words(self.map)} in every "
                "direction: it has no peak there; use `sample`, or other starts"
            )
        covariance = scale @ np.linalg.inv(bend) @ scale.T
        size = np.linalg.slogdet(covariance)[1]
        value = self.density.at(self.mode).value
        evidence = value + 0.5 * (k * math.log(2 * math.pi) + size)
        return Laplace(self.space, self.mode, covariance, float(evidence))

    @property
    def log_evidence(self) -> float:
        """Logarithm of the marginal likelihood by Laplace's approximation.

        Its differences compare models of the same measurements, as `model_probabilities` does; it
        depends on the priors, a wider one lowers it.
        """
        return self.laplace.log_evidence

    @cached_property
    def undetermined(self) -> tuple[tuple[str, ...], ...]:
        """Combinations of parameters about which the tests tell less than the priors, by names.

        An interval along one of them is that of the prior. They follow from the eigenvectors of
        Fisher's information of the tests at the mode, in deviates: information of the prior is 1.
        """
        of_tests = self.density.at(self.mode).information - np.eye(len(self.mode))
        strength, ways = np.linalg.eigh(of_tests)
        return tuple(
            tuple(n for n, part in zip(self.space.names, way, strict=True) if abs(part) > 0.3)
            for s, way in zip(strength, ways.T, strict=True)
            if s < CLEAR
        )

    def sample(
        self, draws: int = 1000, *, chains: int = 2, warm_up: int = 200, seed: int = 0
    ) -> Draws:
        """Draws from the posterior by the No-U-Turn sampler of the package mici (extra `bayes`).

        Parameters
        ----------
        draws : int, optional
            Number of draws of each chain.
        chains : int, optional
            Number of chains. They begin scattered about the mode, by Laplace's approximation.
        warm_up : int, optional
            Number of draws before them that settle the step.
        seed : int, optional
            Seed of all; the same seed draws the same.

        Returns
        -------
        Draws
            Draws of the parameters, and the outcomes of the motions behind them.

        Raises
        ------
        ModuleNotFoundError
            Without mici and arviz-stats.
        RuntimeError
            Where the sampler stops before its last draw.
        ValueError
            For numbers of draws, chains or warm-up draws that are too small.

        Notes
        -----
        The axes of Laplace's approximation and the bend of its ridges are the coordinates of the
        chains, on which the distribution of the draws does not depend.

        A motion that overturns where the test did not, one that gives no answer, and a graze behind
        which there are no derivatives are places of the density as others: they are counted in
        `Draws.outcomes` and rejected or accepted by the density alone, which needs no gradient.
        """
        for name, value in (("draws", draws), ("chains", chains), ("warm_up", warm_up)):
            require(value >= 1, "sample", name, value, "give a whole number from 1 on")
        try:
            covariance = self.laplace.deviate_covariance
        except ValueError:  # no peak: the information is positive in any case
            covariance = np.linalg.inv(self.density.at(self.mode).information)
        before = Counter(self.density.counts)
        ridge = Ridge.of(lambda u: self.density.at(u)[:2], self.mode, covariance)
        u, diverging = hamiltonian_draws(ridge, draws, chains, warm_up, seed)
        counts = Counter(self.density.counts) - before
        values = dict(zip(self.space.names, self.space.columns(u), strict=True))
        return Draws(values, counts.pop("gradients"), dict(counts), diverging)

    def __repr__(self) -> str:
        return f"Posterior({in_words(self.map)})"

    def summary(self, confidence: float = CONFIDENCE) -> str:
        """Parameters in words, a line each, by Laplace's approximation.

        Parameters
        ----------
        confidence : float, optional
            Probability of the intervals, between 0 and 1.

        Returns
        -------
        str
            Text of several lines.
        """
        lines = [f"{100 * confidence:g} % intervals by Laplace's approximation:"]
        for (name, value), u in zip(self.map.items(), self.mode, strict=True):
            low, high = self.laplace.interval(name, confidence)
            far = f", {abs(u):.1f} standard deviations off its prior" if abs(u) > 3 else ""
            lines.append(f"{name} = {value:.5g}, {low:.5g} to {high:.5g}{far}")
        for names in self.undetermined:
            lines.append(f"the tests tell less than the priors about {' with '.join(names)}")
        if not self.settled:
            lines.append("the search for the mode did not settle")
        return "\n".join([*lines, f"log evidence {self.log_evidence:.2f}"])


@explained.calls()
def posterior(
    tests: Observed | Sequence[Observed],
    priors: Mapping[str, Any],
    *,
    degrees_of_freedom: float = math.inf,
    seed: int = 0,
) -> Posterior:
    """Posterior of parameters from one test or several.

    Parameters
    ----------
    tests : Observed or sequence of Observed
        `Observed.history`, `Observed.swings` or `Observed.formula`; parameters of the same name are
        the same in all of them.
    priors : dict of str to distribution
        Prior of each parameter, noises among them, by name: a continuous distribution of
        scipy.stats, frozen; they are independent.
    degrees_of_freedom : float, optional
        Degrees of freedom of Student's distribution of the errors of readings, for records with
        outliers, and noise is its scale then; the normal distribution if not given.
    seed : int, optional
        Seed of the places at which the search for the mode starts.

    Returns
    -------
    Posterior
        Mode, intervals and draws of the parameters.

    Raises
    ------
    ValueError
        For priors that lack a parameter or have one that no test takes, for a noise that may be
        negative, and where the model fails at the medians of the priors.

    Notes
    -----
    The mode is that of a trust region on exact gradients and Fisher's information, from the best of
    256 places of the priors. Motions that overturn unlike the test, or do not answer, have a low
    density, or none, and are counted (`Posterior.counts`); no reading is left out.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy import stats
    >>> import rockeom as rk
    >>> from rockeom.analysis import identification
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> def released(r, theta):
    ...     return rk.Case(block, rk.GroundMotion.none(2.0), rk.EnergyRatio(r), {"theta": theta})
    >>> t = np.linspace(0.02, 1.5, 75)  # s
    >>> record = rk.simulate(released(0.85, 0.08)).at(t)["theta"]
    >>> record += np.random.default_rng(1).normal(0.0, 1e-3, len(t))  # rad
    >>> tests = identification.Observed.history(released, t, record, noise=1e-3)
    >>> priors = {"r": stats.uniform(0.5, 0.5), "theta": stats.norm(0.08, 0.01)}
    >>> posterior = identification.posterior(tests, priors)
    >>> low, high = posterior.laplace.interval("r", 0.95)
    >>> bool(low < 0.85 < high), round(posterior.laplace.standard_error["r"], 4)
    (True, 0.0009)
    """
    require(
        degrees_of_freedom > 0, "posterior", "degrees_of_freedom", degrees_of_freedom,
        "give a positive number, or math.inf for normal errors",
    )  # fmt: skip
    every = (tests,) if isinstance(tests, Observed) else tuple(tests)
    space = RandomParameters.of("posterior", priors, "priors")
    density = _Density(_checked(every, space), space, _Errors(float(degrees_of_freedom)))
    mode, settled = _mode(density, seed)
    return Posterior(density.tests, space, mode, settled, density)


def model_probabilities(posteriors: Mapping[str, Posterior]) -> dict[str, float]:
    """Probability of each of several models after the same tests, by their marginal likelihoods.

    Parameters
    ----------
    posteriors : dict of str to Posterior
        Posteriors by the names of the models, each as likely as the others beforehand.

    Returns
    -------
    dict of str to float
        Probabilities of a sum of 1, by name.

    Raises
    ------
    ValueError
        For posteriors of other measurements, which do not compare.

    Notes
    -----
    A model with more parameters gains by no more than what the tests say for them; wider priors
    lose.
    """
    found = list(posteriors.values())
    require(bool(found), "", "posteriors", posteriors, "give those that are compared")
    readings = [np.concatenate([test.measured for test in one.tests]) for one in found]
    for name, other in zip(posteriors, readings, strict=True):
        if not np.array_equal(readings[0], other):
            raise InputError(name, of="model_probabilities").wrong(
                f"is of other measurements than {next(iter(posteriors))}: evidence compares models "
                "of the same readings"
            )
    logs = np.array([one.log_evidence for one in found])
    parts = np.exp(logs - logs.max())
    return dict(zip(posteriors, (parts / parts.sum()).tolist(), strict=True))


# -- the search for the mode


def _checked(tests: tuple[Observed, ...], space: RandomParameters) -> tuple[Observed, ...]:
    """The tests with the parameters that they take, all of which the priors have."""
    if not tests:
        raise InputError("tests", of="posterior").wrong("is empty: give what was measured")
    noises = {of for test in tests for of, _ in test.noise if isinstance(of, str)}
    for name in (name for name in space.names if name in noises):
        low = space.marginals[space.names.index(name)].support()[0]
        rule = "a standard deviation is positive: give a prior such as stats.loguniform(1e-5, 1e-2)"
        require(low >= 0.0, "posterior", f"priors[{name!r}]", low, rule)
    others = tuple(name for name in space.names if name not in noises)
    bound = tuple(test.taking(others) for test in tests)
    taken = noises | {name for test in bound for name in test.takes or ()}
    if lacks := sorted(taken - {*space.names}):
        raise InputError("priors", of="posterior").wrong(
            f"lack {', '.join(lacks)}: give a distribution of each; a number that is known belongs "
            "into the model, as in lambda r: model(r, half_width=0.1)"
        )
    if unused := [name for name in space.names if name not in taken]:
        raise InputError("priors", of="posterior").wrong(
            f"have {', '.join(unused)}, which no test takes: the tests take "
            f"{', '.join(sorted(taken))}"
        )
    return tuple(_tried(test, space) for test in bound)


def _tried(test: Observed, space: RandomParameters) -> Observed:
    """A test, by central differences where its model does not calculate with duals."""
    medians = np.zeros(len(space.names))
    try:
        test.predict(space.values(medians))
        test.predict(space.duals(medians))
    except ValueError as error:
        at = ", ".join(f"{name} = {x:.6g}" for name, x in space.values(medians).items())
        raise ValueError(f"posterior: at the medians of the priors, {at}: {error}") from error
    except (TypeError, AttributeError):
        return Observed(test.model, test.measured, test.noise, test.limit, test.takes, exact=False)
    return test


def _deviate(marginal: Any, x: float) -> float:
    """The standard normal deviate of a value."""
    upper = marginal.sf(x) < 0.5  # each tail from its own end
    return float(-ndtri(marginal.sf(x)) if upper else ndtri(marginal.cdf(x)))


def _mode(density: _Density, seed: int) -> tuple[np.ndarray, bool]:
    """The most likely deviates, and whether they are a peak, to `SETTLED`."""
    from scipy.optimize import minimize  # takes long to import
    from scipy.stats import qmc

    k = len(density.space.names)
    places = ndtri(qmc.Sobol(k, seed=seed).random(2**TRIALS).clip(1e-6, 1 - 1e-6))
    scored = _scored(density, np.array([np.zeros(k), *places]))
    scored.sort(key=lambda pair: -pair[0])
    if scored[0][0] == -math.inf:
        raise ValueError(
            f"posterior: the model has no answer anywhere in the priors {density.refusal}"
        )
    best, top = scored[0][1], -math.inf
    for value, start in scored[:STARTS]:
        if value == -math.inf:
            break
        optimum = minimize(
            lambda u: -density.at(u).value, start, method="trust-exact",
            jac=lambda u: -density.at(u).gradient, hess=lambda u: density.at(u).information,
            options={"gtol": 1e-6, "maxiter": 100},
        )  # fmt: skip
        if -optimum.fun > top:
            best, top = optimum.x, -optimum.fun
    point = density.at(best)
    off = math.sqrt(float(point.gradient @ np.linalg.solve(point.information, point.gradient)))
    return best, off < SETTLED


def _scored(density: _Density, places: np.ndarray) -> list[tuple[float, np.ndarray]]:
    """Log densities at places (n, k), with noises replaced by the misfits of the readings there."""
    density.counts["simulations"] += len(places)
    predictions = [density.predictions(of) for of in density.space.each(places)]
    moved = np.array(
        [
            u if of is None else _with_misfits(density, u, of)
            for u, of in zip(places, predictions, strict=True)
        ]
    )
    return [
        (-math.inf if of is None else density.joined(u, parameters, of).value, u)
        for u, parameters, of in zip(moved, density.space.each(moved), predictions, strict=True)
    ]


def _with_misfits(
    density: _Density, u: np.ndarray, predictions: Sequence[PredictedReadings]
) -> np.ndarray:
    """A place u (k,), its noises replaced by the misfits of the readings there."""
    u = u.copy()
    for row, (name, marginal) in enumerate(
        zip(density.space.names, density.space.marginals, strict=True)
    ):
        misfits = [
            rest
            for test, one in zip(density.tests, predictions, strict=True)
            for rest in _misfits(test, one, name)
        ]
        if misfits:
            rms = math.sqrt(float(np.mean(np.concatenate(misfits) ** 2)))
            u[row] = np.clip(_deviate(marginal, rms), -3.0, 3.0)
    return u


def _misfits(test: Observed, prediction: PredictedReadings, name: str) -> list[np.ndarray]:
    """Misfits of the readings of a test whose noise is the parameter of that name."""
    ends = np.cumsum([n for _, n in test.noise])
    left = [
        (test.measured[end - n : end], prediction.values[end - n : end])
        for (of, n), end in zip(test.noise, ends, strict=True)
        if of == name
    ]
    return [(y - f)[np.abs(y) < test.limit] for y, f in left if (np.abs(y) < test.limit).any()]
