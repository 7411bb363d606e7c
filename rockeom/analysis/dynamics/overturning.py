"""Overturning by a family of motions, and the boundaries at which the fate changes, exactly.

    import numpy as np
    import rockeom as rk
    from rockeom import analysis
    from rockeom.analysis import dynamics

    pulse = dynamics.dimensionless_pulses(rk.RigidBlock(half_width=1.0, half_height=8.0))
    grid = {"frequency": np.linspace(0.5, 8, 76), "amplitude": np.linspace(0.5, 8, 76)}
    sweep = rk.simulate_many(pulse, grid)
    borders = analysis.overturning_boundaries(pulse, sweep)
    rk.plots.overturning_map(sweep, x="frequency", y="amplitude", boundaries=borders)

The fate of a motion is the number of impacts before the structure overturns: 0, 1, 2, ...; it is
infinite where it never does. Zhang and Makris (2001), Journal of Engineering Mechanics 127(5),
473-483, found that a block overturns without an impact or after some, and that between the two it
may survive a pulse that is stronger than one that overturns it.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import slenderness
from rockeom.analysis.sweeps import ANSWERS, FALLS, check_finished, outcome_labels
from rockeom.motion import GroundMotion
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, positive
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.structures.base import Structure
from rockeom.structures.classes import RigidBlock
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many
from rockeom.sweeps.unfinished import Unfinished, part_for_users
from rockeom.sweeps.workers import Progress

MOST = 3
"""Number of impacts before overturning from which on fates are not distinguished by default."""


def impacts_before_overturning(sweep: xr.Dataset, most: int | None = None) -> xr.DataArray:
    """Number of impacts of each case of a sweep before it overturned: its fate, 0, 1, 2, ...

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset of `simulate_many`.
    most : int, optional
        This number stands for itself and all above it; all numbers if not given.

    Returns
    -------
    xarray.DataArray
        Fates in the shape of the sweep; inf for a case that never overturns, NaN for one without an
        answer.

    Raises
    ------
    ValueError
        As `outcome_labels` does.

    References
    ----------
    Zhang and Makris (2001).
    """
    labels = outcome_labels(sweep)
    impacts = sweep["impacts"].astype(float)
    answered = labels.isin(ANSWERS)
    return impacts.clip(max=most).where(labels == FALLS, np.inf).where(answered)


# --- families of pulses


def dimensionless_pulses(
    structure: Structure,
    pulse: Callable[[float, float], GroundMotion] = GroundMotion.single_sine,
    *,
    impact: ImpactLaw | None = None,
    p: float | None = None,
    acceleration: float | None = None,
) -> Callable[[float, float], Case]:
    """Function of a sweep over pulses in the units of a structure: (frequency, amplitude).

    Parameters
    ----------
    structure : Structure
        Structure that the pulses shake.
    pulse : callable, optional
        Function that makes a motion of an amplitude [m/s2] and a period [s], as
        `GroundMotion.single_sine` and `GroundMotion.ricker` do.
    impact : ImpactLaw, optional
        Impact law, as for `simulate`.
    p : float, optional
        Unit of the frequencies [rad/s], omega_p/p = 2 pi/(p period); the structure's
        `frequency_parameter` if not given.
    acceleration : float, optional
        Unit of the amplitudes [m/s2]; the structure's `uplift_acceleration`, g tan(alpha) of a
        block, if not given.

    Returns
    -------
    callable
        Function of frequency and amplitude, both dimensionless, that makes a `Case`.

    Raises
    ------
    ValueError
        Where the structure has no p or uplift acceleration of its own: then give them.

    Notes
    -----
    The numbers of a block depend on these two, on its slenderness and on its restitution alone.

    References
    ----------
    Zhang and Makris (2001).
    """
    where = "dimensionless_pulses"
    if p is None:
        p = getattr(structure, "frequency_parameter", None)
    if acceleration is None:
        acceleration = structure.uplift_acceleration
    rate = _unit(where, structure, "p", p)
    least = _unit(where, structure, "acceleration", acceleration)

    def case(frequency: float, amplitude: float) -> Case:
        """A pulse of `frequency` [p] and `amplitude` [acceleration]."""
        return Case(structure, pulse(amplitude * least, 2.0 * math.pi / (rate * frequency)), impact)

    return case


def _unit(function: str, structure: Structure, name: str, value: float | None) -> float:
    """The value given, or else that of a structure."""
    if value is None or not math.isfinite(value):
        raise InputError(name, None, function).give(f"it: {structure.model} has none")
    return float(positive(function, **{name: value})[0])


# --- where the fate changes


@part_for_users
@explained.calls()
def overturning_boundaries(
    case: Case | Callable[..., Case],
    sweep: xr.Dataset,
    along: str | Sequence[str] = (),
    *,
    accuracy: float = 1e-6,
    most: int = MOST,
    options: SolverOptions | None = None,
    threads: int | None = None,
    progress: bool | None = None,
) -> xr.Dataset:
    """Places between the cases of a sweep where the number of impacts before overturning changes.

    Parameters
    ----------
    case : Case or callable
        Case or function of the sweep.
    sweep : xarray.Dataset
        Grid of `simulate_many`; or a previous result of this function, to continue after an
        interrupt or with a finer accuracy.
    along : str or sequence of str, optional
        Names of the sweep along which neighbours are compared; all that hold numbers if not given.
    accuracy : float, optional
        Accuracy of each value, in parts of it.
    most : int, optional
        This number of impacts and all above it are one fate.
    options : SolverOptions, optional
        Choices of the integration, the defaults if not given: the sweep may be rougher. Cases next
        to a boundary are simulated again with these.
    threads : int, optional
        Number of threads, as for `SweepOptions`.
    progress : bool, optional
        Whether a line on stderr shows the progress; where stderr is a terminal if not given.

    Returns
    -------
    xarray.Dataset
        Dataset over "boundary": a coordinate of each name of the sweep, `along`, and low and high,
        between which the fate changes along that name from `below` to `above`. The coordinate is
        their middle. An interval with a case without an answer stays as long as it is. A keyboard
        interrupt returns what there is, with ``attrs["interrupted"]`` 1.

    Raises
    ------
    ValueError
        For a sweep that is no grid or was not run to its end, and for names that hold no numbers.

    Notes
    -----
    Between neighbours of different fates the interval is halved until it is as short as asked for,
    all of them at once; a third fate makes two intervals of one. A window that is narrower than the
    sweep's spacing, and lies between neighbours of the same fate, remains undetected.

    Examples
    --------
    >>> import numpy as np
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> def case(amplitude):
    ...     return rk.Case(block, rk.GroundMotion.single_sine(amplitude, 0.8, duration=6.0))
    >>> sweep = rk.simulate_many(case, {"amplitude": np.linspace(2.5, 4.5, 5)})  # m/s2
    >>> borders = analysis.overturning_boundaries(case, sweep, accuracy=1e-3)
    >>> len(borders.amplitude) > 0
    True
    """
    (parts,) = positive("overturning_boundaries", accuracy=accuracy)
    quiet = SweepOptions(threads=threads, progress=False)
    fates = _Fates(case, most, {"options": options, "sweep_options": quiet})
    if "low" in sweep and sweep["low"].dims == (_DIM,):
        brackets = _Brackets.of(sweep)
    else:
        check_finished("overturning_boundaries", sweep)
        brackets = _neighbours(sweep, _along(sweep, along), fates)
    return _halved(brackets, float(parts), fates, progress)


@dataclass(frozen=True)
class _Fates:
    """Finds the fates of some cases."""

    case: Case | Callable[..., Case]
    most: int
    how: Mapping[str, Any]

    def __call__(self, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        """(n,) of the values (n,) of each name."""
        table = xr.Dataset({name: ("row of a table", values) for name, values in columns.items()})
        sweep = simulate_many(self.case, table, **self.how)
        return impacts_before_overturning(sweep, self.most).values


_DIM = "boundary"
_NUMBERS = "low", "high", "below", "above"


@dataclass(frozen=True)
class _Brackets:
    """n intervals between neighbours along one name, in each of which the fate changes.

    at : the values (n,) of every name, that of the interval's own name standing for nothing.
    along (n,) : the interval's own name. low, high (n,) : its ends; below, above (n,) : the fates
    there.
    """

    at: Mapping[str, np.ndarray]
    along: np.ndarray
    low: np.ndarray
    high: np.ndarray
    below: np.ndarray
    above: np.ndarray

    @classmethod
    def of(cls, boundaries: xr.Dataset) -> _Brackets:
        """The intervals of a previous result."""
        at = {str(name): boundaries[name].values for name in boundaries.coords}
        return cls(at, boundaries["along"].values, *(boundaries[name].values for name in _NUMBERS))

    @classmethod
    def joined(cls, some: Sequence[_Brackets]) -> _Brackets:
        at = {name: np.concatenate([one.at[name] for one in some]) for name in some[0].at}
        others = ("along", *_NUMBERS)
        return cls(at, *(np.concatenate([getattr(one, n) for one in some]) for n in others))

    def __len__(self) -> int:
        return len(self.low)

    def __getitem__(self, which: np.ndarray) -> _Brackets:
        at = {name: values[which] for name, values in self.at.items()}
        return _Brackets(at, *(getattr(self, name)[which] for name in ("along", *_NUMBERS)))

    @property
    def middle(self) -> np.ndarray:
        return self.low + 0.5 * (self.high - self.low)

    def with_middles(self) -> dict[str, np.ndarray]:
        """The values of every name in the middles of the intervals."""
        own = {name: self.along == name for name in self.at}
        return {
            name: np.where(own[name], self.middle, values) if own[name].any() else values
            for name, values in self.at.items()
        }

    def halves(self, fates: np.ndarray) -> _Brackets:
        """The halves in which the fate changes, by the fates (n,) in the middles."""
        lower = replace(self, high=self.middle, above=fates)
        upper = replace(self, low=self.middle, below=fates)
        return _Brackets.joined([lower[fates != self.below], upper[fates != self.above]])

    def narrower(self, accuracy: float) -> np.ndarray:
        """(n,) whether each is as narrow as `accuracy`, or as rounding permits."""
        size = np.maximum(np.abs(self.low), np.abs(self.high))
        between = (self.low < self.middle) & (self.middle < self.high)
        return (self.high - self.low <= accuracy * size) | ~between

    def dataset(self, interrupted: bool) -> xr.Dataset:
        """A dataset in the order of the names' values."""
        at = self.with_middles()
        order = np.lexsort([*reversed(at.values()), self.along])
        columns = {name: (_DIM, getattr(self, name)[order]) for name in ("along", *_NUMBERS)}
        coordinates = {name: (_DIM, values[order]) for name, values in at.items()}
        return xr.Dataset(columns, coordinates, {"interrupted": int(interrupted)})


def _along(sweep: xr.Dataset, asked: str | Sequence[str]) -> list[str]:
    """The names along which neighbours are compared."""
    where = "overturning_boundaries"
    dims = [str(name) for name in impacts_before_overturning(sweep).dims]
    grid = [name for name in dims if name != "case" and name in sweep.coords]
    there = [name for name in grid if sweep[name].dtype.kind in "iuf"]
    names = [asked] if isinstance(asked, str) else list(asked) or there
    for name in names or ["none"]:
        if name not in there:
            raise InputError("along", name, where).so(
                "the sweep is to be a grid over names that hold numbers; it is over "
                f"{', '.join(dims)}"
            )
    taken = {"along", *_NUMBERS}.intersection(dims)
    if taken:
        raise InputError("over", min(taken), where).says(
            f"the sweep calls a name {min(taken)!r}: give it another one"
        )
    return names


def _neighbours(sweep: xr.Dataset, along: Sequence[str], fates: _Fates) -> _Brackets:
    """Intervals between neighbours whose fates differ, as `fates` finds them too."""
    ordered = sweep.sortby(list(along))
    there = impacts_before_overturning(ordered, fates.most)
    values = {str(name): ordered[name].values for name in there.dims}
    known_fates, sure = there.values.copy(), np.zeros(there.shape, dtype=bool)
    while True:
        pairs = [(name, *_differ(known_fates, list(values).index(name))) for name in along]
        ends = np.concatenate([end for _, *both in pairs for end in both])
        ends = np.unique(ends[~sure[tuple(ends.T)]], axis=0)
        if not len(ends):
            return _Brackets.joined([_of_pairs(values, known_fates, *pair) for pair in pairs])
        places = tuple(ends.T)
        known_fates[places] = fates(
            {n: v[i] for (n, v), i in zip(values.items(), places, strict=True)}
        )
        sure[places] = True


def _differ(fates: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, d) of neighbours along an axis whose fates are known and differ."""
    first = np.take(fates, range(fates.shape[axis] - 1), axis)
    second = np.take(fates, range(1, fates.shape[axis]), axis)
    low = np.argwhere((first != second) & ~np.isnan(first) & ~np.isnan(second))
    return low, low + (np.arange(fates.ndim) == axis)


def _of_pairs(
    values: Mapping[str, np.ndarray],
    fates: np.ndarray,
    name: str,
    low: np.ndarray,
    high: np.ndarray,
) -> _Brackets:
    at = {n: v[i] for (n, v), i in zip(values.items(), low.T, strict=True)}
    ends = (values[name][i[:, list(values).index(name)]].astype(float) for i in (low, high))
    both = (fates[tuple(i.T)] for i in (low, high))
    return _Brackets(at, np.full(len(low), name), *ends, *both)


def _halved(
    brackets: _Brackets, accuracy: float, fates: _Fates, progress: bool | None
) -> xr.Dataset:
    """All intervals as narrow as `accuracy`, or as they were at an interrupt."""
    ended: list[_Brackets] = []
    shown = sys.stderr.isatty() if progress is None else progress
    with Progress(_halvings(brackets, accuracy), shown) as bar:
        try:
            while len(brackets):
                narrow = brackets.narrower(accuracy)
                ended, brackets = [*ended, brackets[narrow]], brackets[~narrow]
                if len(brackets):
                    middle_fates = fates(brackets.with_middles())
                    bar.add(len(middle_fates))
                    lost = np.isnan(middle_fates)
                    halves = brackets[~lost].halves(middle_fates[~lost])
                    ended, brackets = [*ended, brackets[lost]], halves
        except KeyboardInterrupt:
            part = _Brackets.joined([*ended, brackets])
            raise Unfinished(part.dataset(True)) from None
    return _Brackets.joined([*ended, brackets]).dataset(False)


def _halvings(brackets: _Brackets, accuracy: float) -> int:
    """Number of motions to simulate, if no interval becomes two."""
    size = accuracy * np.maximum(np.abs(brackets.low), np.abs(brackets.high))
    return int(np.ceil(np.log2((brackets.high - brackets.low) / size)).clip(0).sum())


def minimum_overturning(boundaries: xr.Dataset, x: str, y: str) -> xr.DataArray:
    """Least `y` at which a structure overturns, at each `x`: the spectrum of overturning.

    Parameters
    ----------
    boundaries : xarray.Dataset
        Dataset of `overturning_boundaries`, searched along y.
    x : str
        Name of a coordinate.
    y : str
        Name of the other coordinate.

    Returns
    -------
    xarray.DataArray
        y over x, with the number of impacts before overturning as a coordinate. An x without a
        boundary between standing and overturning is missing: nothing of the sweep overturned there,
        or all of it did. Windows of overturning that the sweep missed are missing here.

    Raises
    ------
    ValueError
        For a name that is not there, where there is no boundary along y, and for boundaries whose
        search was interrupted.

    References
    ----------
    Zhang and Makris (2001).

    Examples
    --------
    With `borders` of `overturning_boundaries`::

        dynamics.minimum_overturning(borders, x="frequency", y="amplitude")
    """
    if boundaries.attrs.get("interrupted"):
        raise InputError("boundaries", of="minimum_overturning").says(
            "the search for the boundaries was interrupted: give them to overturning_boundaries, "
            "which continues from there"
        )
    for name in (x, y):
        if name not in boundaries.coords:
            raise InputError("boundaries", name, "minimum_overturning").says(
                f"the boundaries have no {name!r}: they have "
                f"{', '.join(map(str, boundaries.coords))}"
            )
    onset = (boundaries["along"] == y) & np.isinf(boundaries["below"])
    if not onset.any():
        raise InputError("boundaries", of="minimum_overturning").says(
            f"nothing that stands overturns along {y}"
        )
    onsets = boundaries.isel({_DIM: np.flatnonzero(onset.values)})
    order = np.lexsort([onsets[y].values, onsets[x].values])
    at, first = np.unique(onsets[x].values[order], return_index=True)
    least = order[first]
    return xr.DataArray(
        onsets[y].values[least], {x: at, "impacts": (x, onsets["above"].values[least])}, [x], y
    )


# --- how far blocks rock


@part_for_users
@explained.calls()
def rocking_spectrum(
    motions: GroundMotion | Sequence[GroundMotion],
    periods: ArrayLike,
    alpha: ArrayLike,
    *,
    impact: ImpactLaw | None = None,
    **how: Any,
) -> xr.Dataset:
    """Homogeneous blocks of many sizes under a motion, or each of a set of motions.

    Parameters
    ----------
    motions : GroundMotion or sequence of GroundMotion
        One ground motion or several.
    periods : array_like
        Periods 2 pi/p of the blocks [s], p = sqrt(3 g/(4 R)).
    alpha : array_like
        Slenderness of the blocks, one or several [rad].
    impact : ImpactLaw, optional
        Impact law, as for `simulate`.
    **how : object
        Arguments of `simulate_many`, such as ``options`` and ``sweep_options``.

    Returns
    -------
    xarray.Dataset
        Dataset of `simulate_many` over motion, period and alpha.

    Raises
    ------
    ValueError
        For an impossible period or angle.

    References
    ----------
    Makris and Konstantinidis (2003), Earthquake Engineering and Structural Dynamics 32(2), 265-289.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> pulse = rk.GroundMotion.ricker(4.0, 0.6)  # m/s2, s
    >>> sweep = analysis.rocking_spectrum(pulse, periods=[2.0, 4.0], alpha=0.3)  # s, rad
    >>> dict(sweep.sizes)["period"]
    2

    A set of records, drawn::

        far_field = rk.MotionSet.from_library("far field")
        sweep = analysis.rocking_spectrum(far_field, np.linspace(0.5, 8.0, 100), alpha=0.3)
        rk.plots.rocking_spectrum(
            sweep, x="period", by="motion", alpha="alpha", fractiles=(0.16, 0.5, 0.84)
        )
    """
    where = "rocking_spectrum"
    lengths, angles = positive(where, periods=np.ravel(periods))[0], slenderness(where, alpha)

    def case(motion: GroundMotion, period: float, alpha: float) -> Case:
        block = RigidBlock.from_frequency(p=2.0 * math.pi / period, alpha=alpha)
        return Case(block, motion, impact)

    over = {
        "motion": [motions] if isinstance(motions, GroundMotion) else motions,
        "period": _labelled(lengths, "period 2π/p", "s"),
        "alpha": _labelled(np.ravel(angles), "slenderness", "rad"),
    }
    try:
        return simulate_many(case, over, **how)
    except Unfinished as interrupt:
        raise Unfinished(interrupt.part) from None


def _labelled(values: np.ndarray, name: str, unit: str) -> xr.DataArray:
    return xr.DataArray(values, dims=["value"], attrs={"long_name": name, "units": unit})
