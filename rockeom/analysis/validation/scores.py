"""Proper scores of predictions: in expectation none is better than the true distribution's."""

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.validation.ensembles import Ensemble
from rockeom.numbers.checks import InputError, numbers, require


def brier_score(overturned: ArrayLike, probability: ArrayLike) -> np.ndarray:
    """Brier score (outcome - probability)^2 of each test, whose mean is the score; smaller is
    better.

    Parameters
    ----------
    overturned : array_like
        True or False (n,), the measured outcome; it counts as 1 or 0.
    probability : array_like
        Predicted probability (n,), such as `Ensemble.overturning_probability`, or one for all.

    Returns
    -------
    ndarray
        Scores (n,).

    Raises
    ------
    ValueError
        For a probability that does not lie between 0 and 1.

    References
    ----------
    Brier (1950), Monthly Weather Review 78(1), 1-3.
    """
    fell, p = numbers("brier_score", overturned=overturned, probability=probability)
    rule = "give True or False, the outcome of one test"
    require((fell == 0) | (fell == 1), "brier_score", "overturned", fell, rule)
    require((p >= 0) & (p <= 1), "brier_score", "probability", p, "it lies between 0 and 1")
    return (fell - p) ** 2


def crps(measured: Ensemble, simulated: Ensemble, *, limit: float | None = None) -> np.ndarray:
    """Continuous ranked probability score of each test; smaller is better.

    Parameters
    ----------
    measured : Ensemble
        Measured peaks x (n,).
    simulated : Ensemble
        Simulated peaks (n, m), m of each test, whose empirical distribution F is the prediction; or
        (m,), which predicts all tests alike.
    limit : float, optional
        Limit up to which peaks count, as in `Ensemble.censored`: needed where a motion overturned.

    Returns
    -------
    ndarray
        Scores (n,) [unit of the peaks].

    Raises
    ------
    ValueError
        Where the limit is missing, and for other shapes.

    Notes
    -----
    The score is the integral of ``(F(y) - [x <= y])**2`` over y from 0 to the limit: that of the
    peaks min(x, limit), an overturned motion at the limit. It is proper, the threshold-weighted
    form of Gneiting and Ranjan (2011), with the weight 1 below the limit and 0 above; the distance
    above the limit, which an overturned motion does not have, costs nothing. It is calculated as
    ``mean |x - y| - mean |y - y'|/2`` over the simulated peaks (Gneiting and Raftery 2007); m
    motions in place of a distribution add ``mean |y - y'|/(2 m)``: compare models of equal m.

    References
    ----------
    Gneiting and Ranjan (2011), Journal of Business & Economic Statistics 29(3), 411-422; Gneiting
    and Raftery (2007), Journal of the American Statistical Association 102, 359-378.

    Examples
    --------
    >>> import numpy as np
    >>> from rockeom.analysis import validation
    >>> measured = validation.Ensemble([0.1, np.nan], [False, True])  # rad
    >>> simulated = validation.Ensemble([[0.1, 0.1], [0.1, 0.2]])
    >>> validation.crps(measured, simulated, limit=0.25).round(4)  # rad
    array([0.   , 0.075])
    """
    x, y = measured.censored(limit), np.sort(simulated.censored(limit), axis=-1)
    if x.ndim != 1 or y.ndim > 2 or (y.ndim == 2 and len(y) != len(x)):
        raise InputError("measured", of="crps").wrong(
            f"has the shape {x.shape}, simulated {y.shape}: give (n,) peaks and (n, m), m peaks of "
            "each of these tests, or (m,) of none in particular"
        )
    m = y.shape[-1]
    spread = y @ (2.0 * np.arange(m) + 1.0 - m) / m**2  # mean |y - y'|/2, of sorted peaks
    return np.abs(x[:, None] - y).mean(axis=1) - spread
