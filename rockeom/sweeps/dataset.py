"""The labelled dataset of a sweep."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from rockeom.codes import OUTCOMES
from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, near
from rockeom.numbers.mode_codes import rows_of
from rockeom.numbers.pictures import picture
from rockeom.simulation.quantities import units_of
from rockeom.structures.units import in_udunits, time_unit
from rockeom.sweeps.cases import ROW, Cases
from rockeom.sweeps.results import NOT_RUN, Results
from rockeom.sweeps.task import Task

PENDING = 0
"""The flag of a case that was not run; those of outcomes follow, in the order of `OUTCOMES`."""

_LABELS = ("not run", *OUTCOMES.values())
FLAGS = {
    "flag_values": np.arange(len(_LABELS), dtype=np.int8),
    "flag_meanings": " ".join(label.replace(" ", "_") for label in _LABELS),
}
"""Meaning of the numbers of outcomes, by the CF conventions (section 3.5, flags)."""


def flags_of(outcome: np.ndarray) -> np.ndarray:
    """The flags of outcomes, of the numbers that results have."""
    return (outcome - NOT_RUN + PENDING).astype(np.int8)


def outcomes_of(flags: np.ndarray) -> np.ndarray:
    """The other way round."""
    return flags.astype(np.int64) - PENDING + NOT_RUN


_MEANT = {
    "overturned": "outcome == 'overturned'",
    "fallen": "outcome == 'overturned'",
    "outcomes": "outcome",
    "results": "outcome",
    "max": "maximum",
    "min": "minimum",
    "plot": "rk.plots.overturning_map(sweep, x=..., y=...)",
}
"""Names that people ask a sweep for, and what to write for each."""


class Sweep(xr.Dataset):
    """Dataset of `simulate_many`, an `xarray.Dataset`. Jupyter shows it with a count of outcomes.

    Parameters
    ----------
    data_vars : dict, optional
        Variables, as for `xarray.Dataset`.
    coords : dict, optional
        Coordinates, as for `xarray.Dataset`.
    attrs : dict, optional
        Attributes, as for `xarray.Dataset`.
    """

    __slots__ = ()

    if not TYPE_CHECKING:  # for type checkers an unknown attribute stays an error

        def __getattr__(self, name: str) -> Any:
            try:
                return super().__getattr__(name)
            except AttributeError:
                message = f"{type(self).__name__!r} object has no attribute {name!r}"
                if name.startswith("_"):
                    raise
            raise explained.UnknownAttributeError(message, name, self._offers)

    def __getitem__(self, key: Any) -> Any:
        try:
            return super().__getitem__(key)
        except KeyError:
            if not isinstance(key, str) or key in self.variables:
                raise
            offers = self._offers()
        hint = near(key, offers, offers)
        there = ", ".join(map(str, self.variables))
        raise KeyError(f"the sweep has no variable {key!r}{hint}; there are {there}")

    def _offers(self) -> dict[str, str]:
        """Names that people ask a sweep for, and what to write for each."""
        of_names = {
            str(name): f'{peak}.sel({dim}="{name}")'
            for dim, peak in (("quantity", "peak_quantity"), ("state", "peak"))
            if dim in self.coords
            for name in np.atleast_1d(self[dim].values).tolist()
        }
        own = {name: name for name in explained.public_names(self)}
        return {**of_names, **_MEANT, **own, **{str(name): str(name) for name in self.variables}}

    def _repr_html_(self) -> str:
        return picture("page_of_sweep", self)


def dataset(results: Results, labels: Labels, interrupted: bool) -> Sweep:
    """All results of the cases, in one go: a dataset is slow to make."""
    variables, coordinates = labels.variables(results)
    return Sweep(variables, coordinates, {**labels.attrs, "interrupted": int(interrupted)})


def check_names(task: Task, cases: Cases, labels: Labels) -> None:
    """Raises ValueError for a name in `over` that the dataset has for something else."""
    row = replace(labels, dims=(ROW,), shape=(1,), coordinates={})
    variables, coordinates = row.variables(Results.of(task, 1, len(labels.states)))
    variables |= coordinates
    own = {*variables}.union(*(variable[0] for variable in variables.values())) - {ROW}
    for name in cases.values:
        if name in own:
            raise InputError("over", name).says(
                f"over has the name {name!r}, by which the dataset calls its own results: give the "
                "argument of the function another name"
            )


_COORDINATES = ("state", "state_unit", "quantity", "quantity_unit", "time", "side")


@dataclass(frozen=True)
class Labels:
    """Names, units and coordinates of results, all in words and numbers that a file can hold.

    dims, shape : of the cases. states, modes, quantities : their names. times [s] : of the history.
    units : of states, quantities and energies, by name. seconds : unit of times. attrs : of the
    dataset. coordinates : (dimensions, values, attributes) of each.
    """

    dims: Sequence[str]
    shape: Sequence[int]
    states: Sequence[str]
    modes: Sequence[str]
    quantities: Sequence[str]
    times: Sequence[float]
    units: Mapping[str, str]
    seconds: str
    attrs: Mapping[str, Any]
    coordinates: Mapping[str, Any]

    @classmethod
    def of(
        cls, task: Task, cases: Cases, module: GeneratedModule, attrs: Mapping[str, Any]
    ) -> Labels:
        units = {name: in_udunits(unit) for name, unit in units_of(module).items()}
        return cls(
            cases.dims, cases.shape, module.STATES, module.MODES, task.quantities,
            task.times.tolist(), units, in_udunits(time_unit(module)), attrs, cases.coordinates(),
        )  # fmt: skip

    def variables(self, results: Results) -> tuple[dict[str, Any], dict[str, Any]]:
        """All variables by name, and the coordinates."""
        variables = self.named("state", self.states) | self.of_cases(results)
        if results.times.size:
            variables["impact_time"] = self.shaped(
                results.times, "time of the impact", "impact", units=self.seconds
            )
        if results.impact_states.size:
            variables["side"] = ("side",), ["before", "after"], {"long_name": "side of the impact"}
            variables["impact_state"] = self.shaped(
                results.impact_states, "state at the impact", "impact", "side", "state",
                **self.one_unit(self.states),
            )  # fmt: skip
        if self.quantities:
            variables |= self.named("quantity", self.quantities) | self.extremes(
                results.extremes, "quantity", self.quantities, "_quantity"
            )
        if self.times:
            variables["time"] = ("time",), self.times, {"long_name": "time", "units": self.seconds}
            variables["history"] = self.shaped(
                results.histories, "history", "quantity", "time", **self.one_unit(self.quantities)
            )
        named = {name: variables.pop(name) for name in _COORDINATES if name in variables}
        return variables, {**named, **self.coordinates}

    def of_cases(self, results: Results) -> dict[str, Any]:
        """Variables that the compiled loop gives of every case."""
        ran = results.outcome != NOT_RUN
        flags = flags_of(results.outcome)
        modes = np.where(ran, rows_of(self.modes, np.where(ran, results.mode, 0)), "")
        gains, gained = results.gains[:, 0].astype(np.int64), results.gains[:, 1]
        states = self.states
        peaks = np.where(ran[:, None, None], results.peaks, np.nan)
        final = np.where(ran[:, None], results.final, np.nan)
        return {
            "outcome": self.shaped(np.array(_LABELS)[flags], "outcome"),
            "outcome_flag": self.shaped(flags, "outcome", **FLAGS),
            "final_time": self.shaped(results.final_time, "time at the end", units=self.seconds),
            "final_mode": self.shaped(modes, "mode at the end"),
            "impacts": self.shaped(results.impacts, "number of impacts", units="1"),
            "impact_gains": self.shaped(gains, "number of impacts that gained energy", units="1"),
            "impact_energy_gained": self.shaped(
                np.where(ran, gained, np.nan),
                "kinetic energy gained at impacts",
                units=self.units["kinetic_energy"],
            ),
            "refined": self.shaped(
                results.refined, "number of segments with refined steps", units="1"
            ),
            **self.extremes(peaks, "state", states),
            "final": self.shaped(final, "value at the end", "state", **self.one_unit(states)),
        }

    def shaped(self, values: np.ndarray, name: str, *others: str, **attrs: Any) -> Any:
        """A variable over the cases, and over other dimensions."""
        shape = (*self.shape, *values.shape[1:])
        return (*self.dims, *others), values.reshape(shape), {"long_name": name, **attrs}

    def extremes(
        self, values: np.ndarray, dim: str, names: Sequence[str], ending: str = ""
    ) -> dict[str, Any]:
        """Peak, maximum and minimum of (n, 2, m) minima and maxima."""
        unit = self.one_unit(names)
        low, high = values[:, 0], values[:, 1]
        peak = np.maximum(np.abs(low), np.abs(high))
        return {
            f"peak{ending}": self.shaped(peak, "largest absolute value", dim, **unit),
            f"maximum{ending}": self.shaped(high, "maximum", dim, **unit),
            f"minimum{ending}": self.shaped(low, "minimum", dim, **unit),
        }

    def one_unit(self, names: Sequence[str]) -> dict[str, str]:
        """The unit of all of them, if it is one."""
        units = {self.units.get(name) for name in names}
        return {"units": unit} if len(units) == 1 and (unit := units.pop()) else {}

    def named(self, dim: str, names: Sequence[str]) -> dict[str, Any]:
        """Names and units along a dimension."""
        of_each = [self.units.get(name, "") for name in names]
        return {
            dim: ((dim,), list(names), {"long_name": f"name of the {dim}"}),
            f"{dim}_unit": ((dim,), of_each, {"long_name": f"unit of the {dim}"}),
        }
