"""The labelled dataset of a sweep."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np
import xarray as xr

from rockeom.codes import OUTCOMES
from rockeom.simulation.quantities import units_of
from rockeom.structures.units import in_udunits, time_unit
from rockeom.sweeps.cases import ROW, Cases
from rockeom.sweeps.results import NOT_RUN, Kept

PENDING = 0
"""The flag of a case that was not run; those of outcomes follow, in the order of `OUTCOMES`."""

_LABELS = ("not run", *OUTCOMES.values())
FLAGS = {
    "flag_values": np.arange(len(_LABELS), dtype=np.int8),
    "flag_meanings": " ".join(label.replace(" ", "_") for label in _LABELS),
}
"""What the numbers of outcomes mean, by the CF conventions (section 3.5, flags)."""


def flags_of(outcome: np.ndarray) -> np.ndarray:
    """The flags of outcomes, of the numbers that results have."""
    return (outcome - NOT_RUN + PENDING).astype(np.int8)


def outcomes_of(flags: np.ndarray) -> np.ndarray:
    """The other way round."""
    return flags.astype(np.int64) - PENDING + NOT_RUN


class Sweep(xr.Dataset):
    """The dataset of `simulate_many`. Jupyter shows it with a count of outcomes."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        from rockeom.drawing.notebook import page_of_sweep  # matplotlib

        return page_of_sweep(self)


def dataset(kept: Kept, cases: Cases, module: ModuleType) -> Sweep:
    """All that is kept of the cases, in one go: a dataset is slow to make."""
    found = _variables(kept, cases.dims, cases.shape, module)
    coordinates = {name: found.pop(name) for name in _COORDINATES if name in found}
    return Sweep(found, coords=coordinates | cases.coordinates())


def check_names(cases: Cases, row: Kept, module: ModuleType) -> None:
    """Raises ValueError for a name in `over` that the dataset has for something else.

    row : what would be kept of one case.
    """
    found = _variables(row, (ROW,), (1,), module)
    own = {*found}.union(*(variable[0] for variable in found.values())) - {ROW}
    for name in cases.values:
        if name in own:
            raise ValueError(
                f"over has the name {name!r}, by which the dataset calls what it keeps: give the "
                "argument of the function another name"
            )


_COORDINATES = ("state", "state_unit", "quantity", "quantity_unit", "time", "side")


def _variables(
    kept: Kept, dims: tuple[str, ...], shape: tuple[int, ...], module: ModuleType
) -> dict[str, Any]:
    """Each with its dimensions, values and attributes."""
    r, asked = kept.results, kept.asked
    ran = r.outcome != NOT_RUN
    units = {name: in_udunits(unit) for name, unit in units_of(module).items()}
    seconds = in_udunits(time_unit(module))

    def shaped(a: np.ndarray, name: str, *others: str, **attrs: Any) -> Any:
        return (*dims, *others), a.reshape(shape + a.shape[1:]), {"long_name": name, **attrs}

    def of_states(a: np.ndarray, name: str) -> Any:
        return shaped(np.where(ran[:, None], a, np.nan), name, "state", **one_of(module.STATES))

    def of_quantities(a: np.ndarray, name: str, *others: str) -> Any:
        return shaped(a, name, "quantity", *others, **one_of(asked.quantities))

    def one_of(names: Sequence[str]) -> dict[str, str]:
        """The unit of all of them, if it is one."""
        found = {units.get(name) for name in names}
        return {"units": unit} if len(found) == 1 and (unit := found.pop()) else {}

    def named(dim: str, names: Sequence[str]) -> dict[str, Any]:
        of_each = [units.get(name, "") for name in names]
        return {
            dim: ((dim,), list(names), {"long_name": f"name of the {dim}"}),
            f"{dim}_unit": ((dim,), of_each, {"long_name": f"unit of the {dim}"}),
        }

    labels, phases = np.array(_LABELS), np.array([*module.CONTACTS, ""])
    flags = flags_of(r.outcome)
    found = named("state", module.STATES) | {
        "outcome": shaped(labels[flags], "outcome"),
        "outcome_flag": shaped(flags, "outcome", **FLAGS),
        "final_time": shaped(r.final_time, "time at the end", units=seconds),
        "final_mode": shaped(phases[np.where(ran, r.contact, -1)], "contact state at the end"),
        "impacts": shaped(r.impacts, "number of impacts", units="1"),
        "impact_gains": shaped(
            r.gains[:, 0].astype(np.int64), "number of impacts that gained energy", units="1"
        ),
        "impact_energy_gained": shaped(
            np.where(ran, r.gains[:, 1], np.nan),
            "kinetic energy gained at impacts",
            units=units["kinetic_energy"],
        ),
        "refined": shaped(r.refined, "number of segments with refined steps", units="1"),
        "peak": of_states(_largest(r.peaks), "largest absolute value"),
        "maximum": of_states(r.peaks[:, 1], "maximum"),
        "minimum": of_states(r.peaks[:, 0], "minimum"),
        "final": of_states(r.final, "value at the end"),
    }
    if r.times.shape[1]:
        found["impact_time"] = shaped(r.times, "time of the impact", "impact", units=seconds)
    if asked.impacts.size:
        found["side"] = ("side",), ["before", "after"], {"long_name": "side of the impact"}
        found["impact_state"] = shaped(
            asked.impacts, "state at the impact", "impact", "side", "state", **one_of(module.STATES)
        )
    if asked.quantities:
        of = asked.extremes
        found |= named("quantity", asked.quantities) | {
            "peak_quantity": of_quantities(_largest(of), "largest absolute value"),
            "maximum_quantity": of_quantities(of[:, 1], "maximum"),
            "minimum_quantity": of_quantities(of[:, 0], "minimum"),
        }
    if asked.times.size:
        found["time"] = ("time",), asked.times, {"long_name": "time", "units": seconds}
        found["history"] = of_quantities(asked.histories, "history", "time")
    return found


def _largest(extremes: np.ndarray) -> np.ndarray:
    """(n, m): the larger of the sizes of two extremes (n, 2, m); NumPy reduces slowly over two."""
    return np.maximum(np.abs(extremes[:, 0]), np.abs(extremes[:, 1]))
