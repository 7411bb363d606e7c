"""Rates at which neighbouring motions diverge: Lyapunov exponents of motions with impacts.

    import rockeom as rk
    from rockeom.analysis import dynamics

    block = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    shaking = rk.GroundMotion.harmonic(1.5, period=0.6, duration=1.2)
    stroboscope = dynamics.StroboscopicMap(block, shaking, period=0.6)
    spectrum = dynamics.lyapunov_spectrum(stroboscope, {"theta": 0.05}, cycles=500)
    spectrum.exponents, spectrum.standard_errors

The matrix A_k of the derivatives of the states, through impacts too, propagates a small difference
of two motions under the same shaking from one period to the next. n differences are propagated
together and made orthogonal once a period, A_k Q_k = Q_(k+1) R_k: the logarithms of the diagonal of
R_k are how much each direction grew, and their mean over time is the exponent (Benettin, Galgani,
Giorgilli and Strelcyn 1980, Meccanica 15, 9-20 and 21-30; at impacts Mueller 1995, Chaos, Solitons
& Fractals 5(9), 1671-1681). A positive exponent means that neighbouring motions diverge and none
can be predicted for long: chaos, if the motion stays bounded.
"""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.dynamics.orbits import StroboscopicMap
from rockeom.analysis.sweeps import STANDS
from rockeom.numbers.checks import InputError, require, whole_number
from rockeom.numbers.dual import Dual
from rockeom.simulation.case import Case
from rockeom.sweeps.tangents import tangents
from rockeom.sweeps.unfinished import Unfinished, part_for_users
from rockeom.sweeps.workers import Progress

BATCHES = 20
"""Number of batches of cycles; the scatter of their means is the error of the exponents."""

_NOISE = 1e-13
"""Growth in a cycle, in parts of that of the fastest direction, that is rounding alone."""


@dataclass(frozen=True, eq=False)
class LyapunovSpectrum:
    """Lyapunov exponents of a motion under periodic shaking, and their errors.

    Parameters
    ----------
    states : tuple of str
        Names of the n states that are followed.
    period : float
        Period of the ground [s].
    growth : ndarray
        Logarithm (c, n) of how much each direction grew in each of c cycles; -inf where a cycle
        forgets it, as one in which the structure comes to rest or into full contact does.
    state : ndarray
        State (n,) of the motion after the cycles.
    mode : str
        Mode of the motion after the cycles.
    directions : ndarray
        Orthogonal directions after the cycles, in the columns (n, n); a call can continue from
        there.
    interrupted : bool, optional
        Whether a keyboard interrupt came before the last of the cycles.
    """

    states: tuple[str, ...]
    period: float
    growth: np.ndarray
    state: np.ndarray
    mode: str
    directions: np.ndarray
    interrupted: bool = False

    @property
    def cycles(self) -> int:
        """Number of periods of the ground over which the growth is averaged."""
        return len(self.growth)

    @property
    def exponents(self) -> np.ndarray:
        """(n,) mean growth over time, the largest first [1/s, or 1 over the structure's time]."""
        return -np.sort(-self.growth.mean(axis=0)) / self.period

    @property
    def standard_errors(self) -> np.ndarray:
        """Standard errors (n,) of the `exponents`, by the means of 20 batches of cycles [1/s].

        NaN for an exponent of -inf. A cycle is correlated with the one before, long batches hardly
        are (Law 2015, Simulation Modeling and Analysis, 9.5.3). The error says how much the mean of
        so many cycles of a motion that has settled varies; not whether it has.
        """
        order = np.argsort(-self.growth.mean(axis=0), kind="stable")
        batches = np.array_split(self.growth[:, order], min(BATCHES, self.cycles))
        means = np.array([batch.mean(axis=0) for batch in batches])
        with np.errstate(invalid="ignore"):
            return means.std(axis=0, ddof=1) / np.sqrt(len(means)) / self.period

    def bounds(self, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Confidence bounds of each exponent, by Student's t.

        Parameters
        ----------
        level : float, optional
            Confidence level, between 0 and 1.

        Returns
        -------
        lower : ndarray
            Lower bounds (n,) [1/s].
        upper : ndarray
            Upper bounds (n,) [1/s].

        Raises
        ------
        ValueError
            For a level that does not lie between 0 and 1.
        """
        from scipy.stats import t  # takes long to import

        require(0.0 < level < 1.0, "bounds", "level", level, "it lies between 0 and 1, as 0.95")
        reach = t.ppf(0.5 + 0.5 * level, min(BATCHES, self.cycles) - 1) * self.standard_errors
        return self.exponents - reach, self.exponents + reach

    @property
    def dimension(self) -> float:
        """Dimension of the attractor in a section, by the conjecture of Kaplan and Yorke.

        It is j plus the sum of the first j exponents over the size of the next one, j being as
        large as that sum is not negative. Source: Farmer, Ott and Yorke (1983), Physica D 7,
        153-180.
        """
        exponents = self.exponents
        sums = np.concatenate([[0.0], np.cumsum(exponents)])
        j = int(np.flatnonzero(sums >= 0.0)[-1])
        return float(j if j == len(exponents) else j + sums[j] / abs(exponents[j]))

    def __repr__(self) -> str:
        pairs = zip(self.exponents, self.standard_errors, strict=True)
        told_of = ", ".join(f"{value:.4g} +- {error:.2g}" for value, error in pairs)
        cycles = f"{self.cycles} cycles of {self.period:.6g}{', interrupted' * self.interrupted}"
        return f"<LyapunovSpectrum: {told_of}, {cycles}>"


@part_for_users
def lyapunov_spectrum(
    stroboscope: StroboscopicMap,
    initial: Mapping[str, float] | ArrayLike | LyapunovSpectrum,
    *,
    cycles: int = 1000,
    settling: int = 100,
    progress: bool | None = None,
) -> LyapunovSpectrum:
    """All Lyapunov exponents of the motion from a start, of any structure, with their errors.

    Parameters
    ----------
    stroboscope : StroboscopicMap
        Structure and its shaking, of which the states that it follows are varied; a mirrored map,
        too, is followed over whole periods.
    initial : dict of str to float or array_like or LyapunovSpectrum
        States at the start, by name or in the order of `StroboscopicMap.states`; or a spectrum of a
        previous call, which is continued: two calls for 500 cycles give the same as one for 1000,
        to the last bit.
    cycles : int, optional
        Number of periods of the mean, twenty or more.
    settling : int, optional
        Number of periods before them, in which the motion settles and the directions turn to where
        they grow; none where a spectrum is continued.
    progress : bool, optional
        Whether a line on stderr shows the progress; where stderr is a terminal if not given.

    Returns
    -------
    LyapunovSpectrum
        Exponents with their errors. A keyboard interrupt ends the work early, once twenty cycles
        are done, and returns the spectrum so far, which says so and can be continued.

    Raises
    ------
    ArithmeticError
        Where a motion ends before its cycle does, as one that overturns, and where it grazes, so
        that no derivative exists.
    ValueError
        For fewer than twenty cycles.

    Notes
    -----
    The motion continues from period to period in its mode. The sum of the exponents is the mean
    rate at which volumes of states grow: of a block without damping only impacts reduce them,
    ``e**2`` each. In the plane of the states of a block there are two; the direction of time, whose
    exponent is zero, is not among them.
    """
    cycles = whole_number("cycles", cycles, BATCHES)
    settling = whole_number("settling", settling, 0)
    motion, growth = _start(stroboscope, initial), []
    if isinstance(initial, LyapunovSpectrum):
        settling, growth = 0, [*initial.growth]
    shown = sys.stderr.isatty() if progress is None else progress
    spectrum = partial(LyapunovSpectrum, stroboscope.states, stroboscope.period)
    with Progress(settling + cycles, shown, "cycles") as line:
        try:
            for k in range(settling + cycles):
                motion, grown = _cycle(stroboscope, motion, k)
                if k >= settling:
                    growth.append(grown)
                line.add(1)
        except KeyboardInterrupt:
            if len(growth) < BATCHES:
                raise
            raise Unfinished(spectrum(np.array(growth), *motion, interrupted=True)) from None
    return spectrum(np.array(growth), *motion)


class _Motion(NamedTuple):
    """The state of a motion, and the directions that are propagated with it."""

    state: np.ndarray
    mode: str
    directions: np.ndarray


def _start(
    stroboscope: StroboscopicMap, initial: Mapping[str, float] | ArrayLike | LyapunovSpectrum
) -> _Motion:
    """The state where the motion begins; raises ValueError for a spectrum of another map."""
    if not isinstance(initial, LyapunovSpectrum):
        names = stroboscope.states
        if isinstance(initial, Mapping):  # what is not named may follow from the rest
            whole = stroboscope.structure.state(initial)
            initial = whole[[stroboscope.structure.states.index(name) for name in names]]
        return _Motion(stroboscope.points(initial, 0)[0], "", np.eye(len(names)))
    if initial.states != stroboscope.states or initial.period != stroboscope.period:
        raise InputError("initial", of="lyapunov_spectrum").wrong(
            f"is a spectrum of {', '.join(initial.states)} and a period of {initial.period} s: "
            "continue it with the map of the call that returned it"
        )
    return _Motion(initial.state, initial.mode, initial.directions)


def _cycle(one: StroboscopicMap, motion: _Motion, k: int) -> tuple[_Motion, np.ndarray]:
    """The motion a period later, and the growth of each direction."""
    start: dict[str, Any] = {
        name: Dual(float(value), along)
        for name, value, along in zip(one.states, motion.state, _free(one, motion), strict=True)
    }
    case = Case(one.structure, one.motion, one.impact, start, one.period, mode=motion.mode or None)
    propagated = tangents(case, one.options)
    run = propagated.response
    if run.outcome not in STANDS:
        raise ArithmeticError(
            f"lyapunov_spectrum: no cycle {k + 1} from {motion.state}: {run.outcome.sentence}"
        )
    if propagated.grazing:
        raise ArithmeticError(f"lyapunov_spectrum: cycle {k + 1}: {propagated.grazing}")
    rows = [run.states.index(name) for name in one.states]
    directions, grown = np.linalg.qr(propagated.end[rows])
    stretched = np.abs(np.diag(grown))
    stretched[stretched < _NOISE * stretched.max()] = 0.0
    with np.errstate(divide="ignore"):
        growth = np.log(stretched)
    return _Motion(run.end[rows], run.final_mode, directions), growth


def _free(one: StroboscopicMap, motion: _Motion) -> np.ndarray:
    """(n, n) the directions that contacts leave free: no rotation in full contact."""
    free = motion.directions.copy()
    if one.structure.rocks_on_rigid_ground and motion.mode == "both":
        m = one.structure.module
        at_rest = m.STATES[m.ROTATION], m.STATES[m.ROTATION_RATE]
        free[[name in at_rest for name in one.states]] = 0.0
    return free
