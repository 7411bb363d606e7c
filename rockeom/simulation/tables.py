"""A response as tables in which every column has its name and its unit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from rockeom.codes import IMPACT, LANDING
from rockeom.numbers.checks import numbers
from rockeom.structures.units import in_udunits, time_unit

if TYPE_CHECKING:
    from rockeom.simulation.response import Response


def units(run: Response) -> dict[str, str]:
    """Unit of the time "t" and of all that `run[...]` knows."""
    return {"t": time_unit(run.structure.module)} | run.units


def in_words(name: str) -> str:
    """A quantity's name for the axis of a figure."""
    plain = name.removesuffix("_dot")
    return ("rate of " if plain != name else "") + plain.replace("_", " ")


def _told(unit: str, name: str) -> dict[str, str]:
    return {"units": in_udunits(unit), "long_name": name}


def of_time(run: Response, names: Sequence[str] | None, times: Any) -> xr.Dataset:
    """Quantities and the contact state over "time"."""
    if isinstance(names, str):
        raise ValueError(f"names is the word {names!r}: give a list of names")
    asked = tuple(run.states if names is None else names)
    if times is None:
        t, phase, values = run.t, run.phase, {name: run[name] for name in asked}
    else:
        t = numbers("times", times)
        if t.ndim != 1:
            raise ValueError(f"times has the shape {t.shape}: give one dimension, (n,)")
        values = run.at(t, names=asked)
        phase = np.array(run.structure.module.CONTACTS)[run.steps.at(t, "right")[1]]
    unit = units(run)
    found: dict[str, Any] = {
        name: ("time", values[name], _told(unit[name], in_words(name))) for name in asked
    }
    found["phase"] = "time", phase, {"long_name": "contact state"}
    time = "time", t, _told(unit["t"], "time")
    return xr.Dataset(found, coords={"time": time}, attrs=_about(run))


def _about(run: Response) -> dict[str, Any]:
    return {
        "model": run.structure.model,
        "motion": run.motion.name,
        "outcome": str(run.outcome),
        "duration": run.duration,
        "method": run.statistics["method"],
        **{name: run.statistics[name] for name in ("impact_law",) if name in run.statistics},
    }


def to_xarray(run: Response, names: Sequence[str] | None, times: Any) -> xr.Dataset:
    """See `Response.to_xarray`."""
    found = of_time(run, names, times)
    passed, kinds, states = run.passages
    of = np.isin(kinds[:, 0], (IMPACT, LANDING))
    contacts, unit = np.array(run.structure.module.CONTACTS), units(run)
    about = _told(unit["t"], "time of the impact")
    found["impact_time"] = "impact", passed[of], about
    points = np.array([impact.contact for impact in run.impacts], dtype=str)
    found["impact_contact"] = "impact", points, {"long_name": "points that landed"}
    for side, when in enumerate(("before", "after")):
        phase, about = contacts[kinds[of, 1 + side]], {"long_name": f"contact state {when}"}
        found[f"phase_{when}"] = "impact", phase, about
        for i, name in enumerate(run.states):
            about = _told(unit[name], f"{in_words(name)} {when} the impact")
            found[f"{name}_{when}"] = "impact", states[of, side, i], about
    return found
