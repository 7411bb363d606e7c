"""Quantities of a motion as tables in which every column has its name and its unit."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers.mode_codes import rows_of
from rockeom.simulation.events import Impacts
from rockeom.structures.units import in_udunits, time_unit


def units_with_time(module: GeneratedModule, units: Mapping[str, str]) -> dict[str, str]:
    """Unit of the time "t" and of all quantities."""
    return {"t": time_unit(module)} | dict(units)


def in_words(name: str) -> str:
    """A quantity's name for the axis of a figure."""
    plain = name.removesuffix("_dot")
    return ("rate of " if plain != name else "") + plain.replace("_", " ")


def _attributes(unit: str, name: str) -> dict[str, str]:
    return {"units": in_udunits(unit), "long_name": name}


def over_time(
    times: np.ndarray, modes: np.ndarray, values: Mapping[str, np.ndarray], units: Mapping[str, str]
) -> xr.Dataset:
    """Quantities (n,) by name and names of the modes (n,) over "time" (n,)."""
    variables: dict[str, Any] = {
        name: ("time", of_name, _attributes(units[name], in_words(name)))
        for name, of_name in values.items()
    }
    variables["mode"] = "time", modes, {"long_name": "mode"}
    return xr.Dataset(variables, coords={"time": ("time", times, _attributes(units["t"], "time"))})


def over_impacts(impacts: Impacts, units: Mapping[str, str]) -> dict[str, Any]:
    """Variables over "impact": times, points, modes and states before and after."""
    times, kinds, states = impacts.columns
    points = np.array([impact.contact for impact in impacts], dtype=str)
    variables: dict[str, Any] = {
        "impact_time": ("impact", times, _attributes(units["t"], "time of the impact")),
        "impact_contact": ("impact", points, {"long_name": "points that landed"}),
    }
    for side, when in enumerate(("before", "after")):
        modes = rows_of(impacts.structure.module.MODES, kinds[:, 1 + side])
        variables[f"mode_{when}"] = "impact", modes, {"long_name": f"mode {when}"}
        for i, name in enumerate(impacts.structure.states):
            about = _attributes(units[name], f"{in_words(name)} {when} the impact")
            variables[f"{name}_{when}"] = "impact", states[:, side, i], about
    return variables
