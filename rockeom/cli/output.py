"""A response as words, tables and JSON."""

import csv
import io
import json
import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rockeom.files import write
from rockeom.integrator.schema import in_space
from rockeom.motion import GroundMotion
from rockeom.simulation.events import MEASURABLE
from rockeom.simulation.plausible import forces
from rockeom.simulation.reserve import reserve_of
from rockeom.simulation.response import Response
from rockeom.simulation.tables import units_with_time
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.positions import DIRECTION, RESERVE, TILT
from rockeom.structures.slope import uplift_accelerations
from rockeom.structures.units import main_units
from rockeom.version import VERSION


def in_words(run: Response) -> str:
    """The summary of the response, with its largest displacement and uplifts."""
    head, tail = (lines := run.summary().split("\n"))[:3], lines[3:]
    law = str(run.statistics.get("impact_law", "")).partition(", by default")[0]
    return "\n".join([*head, *_lengths(run), *tail]).replace(law or "\0", as_option(law))


def as_option(law: str) -> str:
    """An impact law as --impact takes it: "energy-ratio=0.8" for "EnergyRatio(r=0.8)"."""
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", "-", law.partition("(")[0]).lower()
    values = ",".join(re.findall(r"=([^,)]+)", law))
    return f"{name}={values}" if values else name


def _lengths(run: Response) -> list[str]:
    factor, unit = (
        (1e3, "mm") if units_with_time(run.structure.module, run.units)["t"] == "s" else (1.0, "-")
    )
    lines = []
    if "displacement" in run.names:
        x, t = peak(run, "displacement")
        lines.append(
            f"Largest displacement of the load point: {x * factor:.4g} {unit} at {t:.4g} s."
        )
    if "left_uplift" in run.names:
        left, right = (run.extremes(f"{f}_uplift").maximum * factor for f in ("left", "right"))
        lines.append(f"Largest uplift: left foot {left:.4g} {unit}, right foot {right:.4g} {unit}.")
    return lines


def peak(run: Response, name: str) -> tuple[float, float]:
    """The value of largest size with its sign, and its time [s]."""
    extremes = run.extremes(name)
    return extremes.peak, extremes.peak_time


def write_csv(run: Response, path: Path) -> None:
    """Time, mode and all quantities, headed by names with units.

    The instant of a jump has two rows, before and after.
    """
    unit = units_with_time(run.structure.module, run.units)
    names = _columns(run)
    columns = [run.t, *(run[name] for name in names)]
    header = [
        f"t [{unit['t']}]",
        "mode",
        *(f"{name} [{unit[name]}]" for name in names),
    ]
    rows = (
        [f"{t:.12g}", mode, *(f"{value:.12g}" for value in values)]
        for mode, (t, *values) in zip(run.mode, zip(*columns, strict=True), strict=True)
    )
    write(path, csv_of([header, *rows]))


def _columns(run: Response) -> list[str]:
    """Names of the quantities that are written."""
    names = [*main_units(run.structure.module)]
    leans = (TILT, DIRECTION, RESERVE) if in_space(run.structure.module) else ()
    return [*names, *(name for name in leans if name in run.units and name not in names)]


def csv_of(rows: Iterable[Iterable[Any]]) -> str:
    """Rows as the text of a CSV."""
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue()


def write_npz(run: Response, path: Path) -> None:
    """The same as arrays by name, in the units of the CSV; read with numpy.load."""
    columns: dict[str, Any] = {name: run[name] for name in _columns(run)}
    made = io.BytesIO()
    np.savez_compressed(made, t=run.t, mode=run.mode, **columns)
    write(path, made.getvalue())


def write_json(
    run: Response, law: ImpactLaw | None, initial: Mapping[str, float], path: Path
) -> None:
    """The simulation and its outcome, for other programs."""
    text = json.dumps(_summary(run, law, initial), indent=2, ensure_ascii=False, allow_nan=False)
    write(path, text + "\n")


def _summary(run: Response, law: ImpactLaw | None, initial: Mapping[str, float]) -> dict[str, Any]:
    unit = units_with_time(run.structure.module, run.units)
    peaks, uplifts = {}, uplift_accelerations(run.structure, run.slope)
    for name in main_units(run.structure.module):
        value, time = peak(run, name)
        peaks[name] = {"value": _number(value), "time": time, "unit": unit[name]}
    return {
        "rockeom": VERSION,
        "structure": {"name": run.structure.model, "parameters": run.structure.parameters()},
        "motion": _motion(run.motion),
        "vertical": None if run.vertical is None else _motion(run.vertical),
        **(_in_space(run) if in_space(run.structure.module) else {}),
        "impact": repr(law or run.structure.default_impact) if run.structure.has_impacts else None,
        "initial": dict(initial),
        "outcome": str(run.outcome),
        "sentence": run.outcome.sentence,
        "duration": run.duration,
        "slope": run.slope,
        "ground_axes": run.ground_axes,
        "end": float(run.t[-1]),
        "peaks": peaks,
        "reserve": _reserve(run),
        "impacts": len(run.impacts),
        "impacts_above": {"rate": MEASURABLE, "number": len(run.impacts.above())},
        "uplifts": sum(e.kind == "uplift" for e in run.events),
        "rest_time": run.events.rest_time,
        "friction_demand": _number(run.support.friction_demand),
        "impact_friction_demand": _number(run.support.impact_friction_demand),
        "lost_contact": run.support.lost_contact,
        "assumptions": run.support.describe(),
        "never_lifted": run.support.never_lifted,
        "uplift_acceleration": _number(min(uplifts) if uplifts else None),
        "hints": [*run.hints, *forces(run.structure)],
        "statistics": run.statistics,
    }


def _in_space(run: Response) -> dict[str, Any]:
    """The ground in space, and how far the structure leaned."""
    across = None if run.transverse is None else _motion(run.transverse)
    tilt = dict(zip(("value", "time"), peak(run, TILT), strict=True))
    return {"transverse": across, "azimuth": run.azimuth, "tilt": tilt | {"unit": "rad"}}


def _reserve(run: Response) -> dict[str, Any] | None:
    """The largest theta/alpha, its side, and the part of the overturning angle that was left."""
    if RESERVE in run.units:
        least = run.extremes(RESERVE)
        return {"reserve": max(least.minimum, 0.0), "time": least.minimum_time}
    rotation = run.extremes(run.states[run.structure.module.ROTATION])
    reserve = reserve_of(run.structure, rotation, run.slope)
    return None if reserve is None else {**reserve._asdict(), "reserve": reserve.reserve}


def _motion(motion: GroundMotion) -> dict[str, Any]:
    return {name: getattr(motion, name) for name in ("name", "source", "duration", "peak")}


def _number(value: float | None) -> float | None:
    """JSON knows no NaN and no infinity; `assumptions` says in words what they mean."""
    return value if value is not None and math.isfinite(value) else None
