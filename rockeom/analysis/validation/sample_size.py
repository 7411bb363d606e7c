"""How many tests a claim needs: for a probability, a mean, a distribution."""

import math
from collections.abc import Callable

from scipy import stats

from rockeom.analysis.risk.fragility import proportion_interval
from rockeom.numbers.checks import positive, require

_MOST = 2**40


def sample_size_for_proportion(probability: float, width: float, level: float = 0.95) -> int:
    """Least number of tests after which a probability, such as of overturning, has an interval of a
    width.

    Parameters
    ----------
    probability : float
        Expected probability, 0.5 if nothing is known; 0 for a structure that never overturns.
    width : float
        Width from the lower to the upper bound of its interval.
    level : float, optional
        Level of the interval of `risk.proportion_interval`, which is calculated with n*probability
        occurrences.

    Returns
    -------
    int
        Number of tests.

    Raises
    ------
    ValueError
        For a probability that does not lie between 0 and 1, or such a width or level.

    Examples
    --------
    >>> from rockeom import analysis
    >>> analysis.validation.sample_size_for_proportion(0.0, 0.05)  # none overturned: at most 5 %
    72
    """
    where = "sample_size_for_proportion"
    require(0 <= probability <= 1, where, "probability", probability, "it lies between 0 and 1")
    require(0 < width < 1, where, "width", width, "it lies between 0 and 1")

    def narrow(n: int) -> bool:
        lower, upper = proportion_interval(n * probability, n, level)
        return bool(upper - lower <= width)

    return _least(where, narrow)


def sample_size_for_mean(
    difference: float, deviation: float, level: float = 0.95, power: float = 0.8
) -> int:
    """Least number of tests after which a wrong mean is seen to be wrong with a power.

    Parameters
    ----------
    difference : float
        Difference of the true mean peak from the simulated one [unit of the peaks].
    deviation : float
        Standard deviation, from test to test, of a measured peak less the mean of its simulations
        [unit of the peaks].
    level : float, optional
        Level of the interval of `compare_means` for (n, m) simulations, which then leaves out zero.
    power : float, optional
        Probability of that.

    Returns
    -------
    int
        Number of tests.

    Raises
    ------
    ValueError
        For a difference of zero, a deviation that is not positive, and a level or a power that does
        not lie between 0 and 1.

    Notes
    -----
    Power of Student's test, two-sided, by the noncentral t distribution: exact for normal
    differences.
    """
    where = "sample_size_for_mean"
    size, spread = positive(where, difference=abs(difference), deviation=deviation)
    _probabilities(where, level, power)

    def enough(n: int) -> bool:
        critical = stats.t.ppf(0.5 + 0.5 * level, n - 1)
        apart = stats.nct(n - 1, float(size / spread) * math.sqrt(n))
        return bool(apart.sf(critical) + apart.cdf(-critical) >= power)

    return _least(where, enough, first=2)


def sample_size_for_distribution(distance: float, level: float = 0.95, power: float = 0.8) -> int:
    """Number of tests after which a wrong distribution of peaks is seen to be wrong with a power.

    Parameters
    ----------
    distance : float
        Largest difference of the true distribution from the simulated one, of probabilities: 0.1 if
        60 % of the peaks stay below a rotation, and the model says 50 %.
    level : float, optional
        Level of the band of the measured distribution, `Ensemble.band`, which then leaves out that
        of a model with many simulations.
    power : float, optional
        Probability of that, at least.

    Returns
    -------
    int
        Number of tests.

    Raises
    ------
    ValueError
        For numbers that do not lie between 0 and 1.

    Notes
    -----
    ``((sqrt(ln(2/(1 - level))/2) + sqrt(ln(1/(1 - power))/2))/distance)**2``: of the width of the
    band, and of the inequality of Hoeffding at the rotation of the largest difference. Enough for
    any two distributions, and for the test of Kolmogorov and Smirnov, too; most need fewer.

    References
    ----------
    Hoeffding (1963), Journal of the American Statistical Association 58, 13-30.
    """
    where = "sample_size_for_distribution"
    require(0 < distance <= 1, where, "distance", distance, "it lies between 0 and 1")
    _probabilities(where, level, power)
    reach = math.sqrt(math.log(2 / (1 - level)) / 2) + math.sqrt(math.log(1 / (1 - power)) / 2)
    return math.ceil((reach / distance) ** 2)


def _probabilities(where: str, level: float, power: float) -> None:
    for name, value in (("level", level), ("power", power)):
        require(0.0 < value < 1.0, where, name, value, "it lies between 0 and 1, as 0.95")


def _least(where: str, enough: Callable[[int], bool], first: int = 1) -> int:
    """The least number from `first` on that is enough, of a condition that stays true."""
    high = first
    while not enough(high):
        high *= 2
        require(high < _MOST, where, "number", high, "no number of tests tells so little")
    low = max(high // 2, first - 1)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    return high
