"""Values measured in a test, and the model that predicts them, for `posterior`.

    def released(left, right, half_width, theta): ...  # returns the Case of the test

    identification.Observed.history(released, t, theta_measured)
    identification.Observed.swings(released, peaks=peaks, crossing_times=crossings)

A record is compared at its own instants. The motion at a fixed time changes smoothly with its
parameters however many impacts come before it, so that their number does not matter; a motion that
overturns is held where it lies, so that its prediction stays continuous, and far from the record.
"""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.arguments import measured_swings
from rockeom.analysis.identification.swings_of_response import (
    quantity_tangents,
    swing_tangents,
    swings,
)
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, numbers, positive, require
from rockeom.numbers.dual import Dual, directions, tangent_of, value_of
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.outcome import Outcome
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.sweeps.case_numbers import function_of
from rockeom.sweeps.tangents import states_at, tangents

__all__ = ["Observed", "PredictedReadings"]

AS_MEASURED = "as measured"
OVERTURNS = "overturns, and the test did not"
STANDS = "stands, and the test overturned"
GRAZES = "no derivatives behind an impact that grazes"
FEWER = "fewer swings than the test"
NO_ANSWER = "no answer"
_ANSWERS = (Outcome.COMPLETED, Outcome.CAME_TO_REST, Outcome.OVERTURNED)
_STEP = 1e-4
"""Step of central differences, in parts of the change that one deviate makes."""


class PredictedReadings(NamedTuple):
    """Readings of a test that a model predicts.

    Parameters
    ----------
    values : ndarray
        Readings (n,), NaN where there is no answer.
    derivatives : ndarray
        Derivatives (n, m) along the directions of the duals that the model was called with, none of
        floats.
    outcome : str, optional
        "as measured", or how the motion differs from that of the test.
    """

    values: np.ndarray
    derivatives: np.ndarray
    outcome: str = AS_MEASURED


@explained.calls()
@dataclass(frozen=True, eq=False)
class Observed:
    """Values measured in a test, their noise, and the model that predicts them.

    Made by `history`, `swings` or `formula`.

    Parameters
    ----------
    model : callable
        Function of parameters, by name, that returns `PredictedReadings`.
    measured : ndarray
        Measured values (n,).
    noise : tuple of (float or str, int)
        Pairs of a standard deviation, or the name of the parameter that it is, and the number of
        values that have it, in turn.
    limit : float, optional
        Readings at or beyond it, on either side, say only that the value is.
    takes : tuple of str, optional
        Names of the parameters of the model; None where it takes all.
    exact : bool, optional
        Whether the model calculates with `rk.Dual`; central differences replace its derivatives
        otherwise.
    """

    model: Any
    measured: np.ndarray
    noise: tuple[tuple[float | str, int], ...]
    limit: float = np.inf
    takes: tuple[str, ...] | None = None
    exact: bool = True

    @classmethod
    def history(
        cls, case: Case | Callable[..., Case], time: ArrayLike, values: ArrayLike, *,
        quantity: str = "theta", noise: float | str = "noise", limit: float = np.inf,
        options: SolverOptions | None = None,
    ) -> Self:  # fmt: skip
        """Record, sample by sample: of a free vibration or of a shaken structure.

        Parameters
        ----------
        case : Case or callable
            A `Case`, of whose numbers the parameters are some, as in `simulate_many`; or a function
            of the parameters, by name, that returns one and calculates with `rk.Dual`; its
            arguments with a default are no parameters.
        time : array_like
            Times (n,) [s], increasing, in the time of the case.
        values : array_like
            Readings (n,) in the unit of `quantity`.
        quantity : str, optional
            A state or another quantity that `rk.sensitivity` knows.
        noise : float or str, optional
            Standard deviation of a reading, in the unit of the quantity, or the name of the
            parameter that it is. The errors of readings are independent: from a filtered record
            take samples so far apart that they are.
        limit : float, optional
            A reading at or beyond it says only that the value is, on that side; for the end of a
            sensor's range, or for a test that overturned: readings after the fall are infinite
            then, and the limit is a rotation from which no structure returns.
        options : SolverOptions, optional
            Choices of the integration.

        Returns
        -------
        Observed
            Readings with their model.

        Raises
        ------
        ValueError
            For readings that are not numbers, infinite ones without a limit, and times that do not
            increase.

        Examples
        --------
        With a function `released` of the parameters and a `MeasuredRecord`::

            Observed.history(released, record.time, record["theta"])
        """
        where = "Observed.history"
        (t,) = numbers(where, time=time)
        read = np.asarray(values, dtype=float)
        if t.ndim != 1 or not t.size or t.shape != read.shape:
            raise InputError("values", of=where).wrong(
                f"has the shape {read.shape}, time has {t.shape}: give one reading for each instant"
            )
        require(np.diff(t) > 0, where, "time", t[1:], "times must increase")
        require(t[0] >= 0.0, where, "time", t[0], "the case begins at 0 s: count from there")
        require(~np.isnan(read), where, "values", read, "leave out instants without a reading")
        rule = "an infinite reading needs a limit, beyond which the value is known to lie"
        require(np.isfinite(read) | np.isfinite(limit), where, "values", read, rule)
        require(limit > 0, where, "limit", limit, "it is a size, and positive")
        fell = bool(abs(read[-1]) >= limit)
        model = _History(case, t, quantity, fell, options)
        return cls(model, read, _noises(where, (noise, len(t))), float(limit), _takes(case))

    @classmethod
    def swings(
        cls, case: Case | Callable[..., Case], *, peaks: ArrayLike | None = None,
        peak_times: ArrayLike | None = None, crossing_times: ArrayLike | None = None,
        quantity: str = "theta", noise: float | str = "noise",
        time_noise: float | str = "time_noise", release_time: str | None = None,
        options: SolverOptions | None = None,
    ) -> Self:  # fmt: skip
        """Peaks and crossings of a free vibration, where there is no record of all of it.

        Parameters
        ----------
        case : Case or callable
            Case or function of the parameters, as for `history`.
        peaks : array_like, optional
            Peaks (n,), signed, in the unit of `quantity`, one on each side in turn, the release
            first.
        peak_times : array_like, optional
            Times of the peaks (n,) [s], from the release on, or from another instant where there is
            a `release_time`.
        crossing_times : array_like, optional
            Times of the crossings (n,) [s], likewise. Any of the three may be left out.
        quantity : str, optional
            A state or another quantity that `rk.sensitivity` knows.
        noise : float or str, optional
            Standard deviation of the peaks, or the name of the parameter that it is.
        time_noise : float or str, optional
            Standard deviation of the times [s], or the name of the parameter that it is.
        release_time : str, optional
            Name of the parameter that says when the structure was released.
        options : SolverOptions, optional
            Choices of the integration.

        Returns
        -------
        Observed
            Readings with their model.

        Raises
        ------
        ValueError
            Where nothing was measured.

        Notes
        -----
        Noise of a record enlarges the peaks that are read off it. The release is a reading as
        others: make the start of the case a parameter; one that is set to that reading seems to be
        without error, and lowers a noise that is unknown.

        A structure that decays by impacts has infinitely many swings, of which these are the first;
        their number does not change with the parameters. Records of shaken structures are compared
        by `history`.
        """
        where = "Observed.swings"
        offered = {"peaks": peaks, "peak_times": peak_times, "crossing_times": crossing_times}
        values = measured_swings(where, offered)
        pairs = [(noise if name == "peaks" else time_noise, len(x)) for name, x in values.items()]
        takes = _takes(case)
        if release_time is not None and takes is not None:
            takes = (*takes, release_time)
        lengths = {name: len(x) for name, x in values.items()}
        model = SwingsOfCase(case, lengths, quantity, release_time, options)
        return cls(
            model, np.concatenate(list(values.values())), _noises(where, *pairs), takes=takes
        )

    @classmethod
    def formula(
        cls, model: Callable[..., Any], values: ArrayLike, *, noise: float | str = "noise"
    ) -> Self:
        """Values that a formula predicts.

        Parameters
        ----------
        model : callable
            Function of the parameters, by name, that returns a value for each measured one.
        values : array_like
            Measured values (n,).
        noise : float or str, optional
            Standard deviation, or the name of the parameter that it is.

        Returns
        -------
        Observed
            Values with their model.

        Raises
        ------
        ValueError
            For values that are not numbers.

        Examples
        --------
        With measured `peaks` and `quarter_periods`::

            Observed.formula(lambda k, c: k * np.sqrt(peaks) + c, quarter_periods)
        """
        where = "Observed.formula"
        (y,) = numbers(where, values=values)
        require(y.ndim == 1 and y.size > 0, where, "values", y, "give a list of values")
        return cls(_Formula(model, len(y)), y, _noises(where, (noise, len(y))), takes=_takes(model))

    def taking(self, names: tuple[str, ...]) -> Self:
        """The same with a model that takes some parameters, where it names none itself.

        Parameters
        ----------
        names : tuple of str
            Names of the parameters.

        Returns
        -------
        Observed
            The same readings.
        """
        if self.takes is not None:
            return self
        model = self.model
        if not isinstance(model, _Formula):
            release = getattr(model, "release_time", None)
            of_case = tuple(name for name in names if name != release)
            model = model._replace(case=function_of(model.case, of_case))
        return replace(self, model=model, takes=names)

    def predict(self, parameters: Mapping[str, Any]) -> PredictedReadings:
        """Prediction by parameters.

        Parameters
        ----------
        parameters : dict of str to float or Dual
            Numbers or duals by name, some of which may be of other tests.

        Returns
        -------
        PredictedReadings
            Predicted readings with their derivatives.
        """
        own = {name: parameters[name] for name in self.takes or ()}
        m = directions(*parameters.values())
        if m and not self.exact:
            return self._by_differences(own, m)
        prediction: PredictedReadings = self.model(**own)
        if directions(*own.values()) == m:
            return prediction
        return prediction._replace(derivatives=np.zeros((len(self.measured), m)))  # none moves it

    def _by_differences(self, own: Mapping[str, Any], m: int) -> PredictedReadings:
        plain = {name: value_of(x) for name, x in own.items()}
        along = np.zeros((len(self.measured), m))
        for name, x in own.items():
            h = _STEP * np.linalg.norm(x.tangent)
            if h > 0.0:
                low, high = (self.model(**plain | {name: plain[name] + s}) for s in (-h, h))
                along += np.outer((high.values - low.values) / (2 * h), x.tangent)
        prediction: PredictedReadings = self.model(**plain)
        return prediction._replace(derivatives=along)


def _noises(where: str, *pairs: tuple[float | str, int]) -> tuple[tuple[float | str, int], ...]:
    for of, _ in pairs:
        if not isinstance(of, str):
            positive(where, noise=of)
    return pairs


def _takes(function: Any) -> tuple[str, ...] | None:
    """Names of the arguments of a function; None of a case, and of one that takes any name."""
    if isinstance(function, Case):
        return None
    arguments = inspect.signature(function).parameters.values()
    if any(a.kind is a.VAR_KEYWORD for a in arguments):
        return None
    return tuple(a.name for a in arguments if a.default is a.empty)


# -- models


class _History(NamedTuple):
    """A quantity of the motion of a case at fixed times; fell : whether that of the test did."""

    case: Any
    time: np.ndarray
    quantity: str
    fell: bool
    options: SolverOptions | None

    def __call__(self, **parameters: Any) -> PredictedReadings:
        made = self.case(**parameters)
        m = directions(*parameters.values())
        along = np.zeros((len(self.time), m))
        if not m:
            run = simulate(**vars(made), options=self.options)
        elif self.quantity in made.structure.states:
            run, states = states_at(made, self.time, self.options)
            along = states[:, run.states.index(self.quantity)]
        else:
            carried = tangents(made, self.options)
            run = carried.response
            inside = self.time <= run.t[-1]
            of_quantity = quantity_tangents(carried, self.quantity, self.time[inside])
            along[inside] = of_quantity[:, :-1]
        end = float(run.steps.span[-1].sum())
        if run.outcome is Outcome.COMPLETED and end < self.time[-1] * (1 - 1e-12):
            raise InputError("case").says(
                f"the case ends at {end:.6g} s, the record at {self.time[-1]:.6g} s: let it last "
                "as long as the record"
            )
        values = _values(run, self.quantity, np.minimum(self.time, end))
        return _answer(run, values, along, self._mismatch(run, end))

    def _mismatch(self, run: Response, end: float) -> str:
        falls = run.outcome is Outcome.OVERTURNED and end < self.time[-1]
        if falls and not self.fell:
            return OVERTURNS
        return STANDS if self.fell and run.outcome is not Outcome.OVERTURNED else AS_MEASURED


def _values(run: Response, quantity: str, times: np.ndarray) -> np.ndarray:
    if quantity in run.states:  # without the samples of a whole response
        return run.steps.at(times, "right")[0][:, run.states.index(quantity)]
    return run.at(np.minimum(times, run.t[-1]), names=(quantity,))[quantity]


def _answer(
    run: Response, values: np.ndarray, along: np.ndarray, mismatch: str
) -> PredictedReadings:
    """A prediction whose lost derivatives are zero, and whose values are nan without an answer."""
    if run.outcome not in _ANSWERS:
        return PredictedReadings(np.full(len(values), np.nan), np.zeros(along.shape), NO_ANSWER)
    lost = ~np.isfinite(along)
    if lost.any() and mismatch == AS_MEASURED:
        mismatch = GRAZES
    return PredictedReadings(values, np.where(lost, 0.0, along), mismatch)


class SwingsOfCase(NamedTuple):
    """The swings of a case; lengths : how many of each kind were measured, by their names."""

    case: Any
    lengths: dict[str, int]
    quantity: str
    release_time: str | None
    options: SolverOptions | None

    def __call__(self, **parameters: Any) -> PredictedReadings:
        m = directions(*parameters.values())
        shift = parameters.pop(self.release_time) if self.release_time else 0.0
        made, number = self.case(**parameters), max(self.lengths.values())
        if m:
            swing, by = swing_tangents(made, self.quantity, number, self.options)
            moved = tangent_of(shift, m)
            along = self._chosen(by.peak, by.peak_time + moved, by.crossing_time + moved)
        else:
            run = simulate(**vars(made), options=self.options)
            swing = swings(run, self.quantity, number)
            along = np.zeros((sum(self.lengths.values()), 0))
        late = value_of(shift)
        values = self._chosen(swing.peak, swing.peak_time + late, swing.crossing_time + late)
        fewer = not swing.peak.all()
        return PredictedReadings(values, along, FEWER if fewer else AS_MEASURED)

    def _chosen(self, *columns: np.ndarray) -> np.ndarray:
        rows = dict(zip(("peaks", "peak_times", "crossing_times"), columns, strict=True))
        return np.concatenate([rows[name][:length] for name, length in self.lengths.items()])


class _Formula(NamedTuple):
    """A function of the parameters that returns a number of values."""

    function: Callable[..., Any]
    number: int

    def __call__(self, **parameters: Any) -> PredictedReadings:
        found = np.asarray(self.function(**parameters))
        if found.shape != (self.number,):
            raise InputError("model").says(
                f"the formula returned the shape {found.shape}, measured is ({self.number},): "
                "return one value for each that was measured"
            )
        m = directions(*(x for x in parameters.values() if isinstance(x, Dual)))
        return PredictedReadings(np.asarray(value_of(found), float), tangent_of(found, m))
