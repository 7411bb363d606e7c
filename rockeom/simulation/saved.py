"""Files of responses: the arrays of a response, and a text in JSON that names its parts.

A file is netCDF-4 and holds numbers and names, no code. `rockeom.exports.responses` reads it.
"""

import dataclasses
import hashlib
import io
import json
import os
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from rockeom.files import check_target, write
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import InputError, InputTypeError, described, installed_by, is_number
from rockeom.simulation.ground import MOTIONS
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.steps import Steps
from rockeom.structures.base import FixedBase, Structure
from rockeom.structures.classes import SHIPPED
from rockeom.structures.declared import DeclaredStructure
from rockeom.structures.impact_laws import LAWS, ImpactLaw
from rockeom.version import VERSION

FORMAT = 2
"""Format of the files; another one is refused."""

NAMES = {FixedBase: "fixed_base", SolverOptions: "options"} | {law: n for n, law in LAWS.items()}
"""Names of classes in files; a structure goes by its `model`, a support by its `kind`."""

DECLARED = "declared"


# -- encoding --------------------------------------------------------------------------------------


def _name(value: Any) -> str | None:
    """Name of a value's class in files; None for a class of the user's own."""
    if not type(value).__module__.startswith("rockeom."):
        return None
    if type(value) in NAMES:
        return NAMES[type(value)]
    if isinstance(value, Structure):
        shipped = not isinstance(value, DeclaredStructure) or value.model in SHIPPED
        return value.model if shipped else None
    return getattr(value, "kind", None)


def encode(what: str, value: Any) -> Any:
    """A value in the terms of JSON; raises TypeError for one of no class that a file may name."""
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, np.bool_ | np.integer):
        return value.item()
    if is_number(value):
        return float(value)
    if isinstance(value, tuple | list):
        return [encode(what, item) for item in value]
    if isinstance(value, DeclaredStructure):
        fields: Mapping[str, Any] = value.values
    elif dataclasses.is_dataclass(value):
        fields = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
    else:
        fields = {}
    encoded = {name: encode(f"{what}.{name}", item) for name, item in fields.items()}
    name = _name(value)
    if name is not None:
        return {"is": name, "of": encoded}
    if isinstance(value, DeclaredStructure):
        declared = {"is": DECLARED, "of": encoded, "name": value.model}
        return declared | {"source_hash": value.module.SOURCE_HASH}
    raise InputTypeError(what, value).says(
        f"{what} is {described(value)}, and files hold no code: save knows shipped, composed and "
        "declared structures, not classes of your own"
    )


def _encode_law(law: ImpactLaw | None) -> Any:
    if law is None or type(law) in LAWS.values():
        return encode("impact", law)
    name = type(law).__qualname__
    warn_caller(
        f"the impact law, a {name}, is of your own: the file has its name, and all of the "
        "response; to go on from it give the law again",
    )
    return {"not_saved": name}


# -- arrays ----------------------------------------------------------------------------------------

_VARIABLES: Mapping[str, tuple[str, str, str]] = {
    "step_span": ("step start_and_length", "start and length of each step of integration", "s"),
    "step_mode": ("step", "number of the mode in each step", ""),
    "step_powers": (
        "step power state",
        "coefficients of the states' polynomials of the part of a step gone", "",
    ),
    "sample_time": ("sample", "times of the samples", "s"),
    "sample_state": ("sample state", "states at the samples", ""),
    "sample_mode": ("sample", "number of the mode at the samples", ""),
    "extremes": ("quantity extreme", "minimum, maximum and their times, of each quantity", ""),
    "event_time": ("event", "times of impacts, uplifts and other events", "s"),
    "event_kind": (
        "event kind_before_after_guard", "kind, modes before and after, number of the guard", "",
    ),
    "event_state": ("event side state", "states before and after each event", ""),
    "end": ("state", "last state", ""),
    "motion_segments": ("motion_segments column", "motion segments", ""),
    "motion_samples": ("motion_samples", "motion samples", ""),
    "transverse_segments": ("transverse_segments column", "transverse segments", ""),
    "transverse_samples": ("transverse_samples", "transverse samples", ""),
    "vertical_segments": ("vertical_segments column", "vertical segments", ""),
    "vertical_samples": ("vertical_samples", "vertical samples", ""),
}  # fmt: skip
"""Dimensions, meaning and unit of each variable of a file."""
WHOLE_NUMBERS = {"step_mode", "sample_mode", "event_kind"}


def _arrays(made: Mapping[str, Any]) -> dict[str, np.ndarray]:
    record = made["record"]
    if isinstance(record, Steps):
        fields: tuple[Any, ...] = record.span, record.mode, record.powers
        arrays = dict(zip(("step_span", "step_mode", "step_powers"), fields, strict=True))
    else:
        fields = record.t, record.y, record.mode
        arrays = dict(zip(("sample_time", "sample_state", "sample_mode"), fields, strict=True))
        rows = [dataclasses.astuple(one) for one in record.extremes.values()]
        arrays["extremes"] = np.array(rows)
    names = ("event_time", "event_kind", "event_state")
    arrays |= zip(names, made["events"].columns, strict=True)
    arrays["end"] = made["end"]
    for name in MOTIONS:
        if (motion := made[name]) is not None:
            arrays[f"{name}_segments"] = motion.segments
            if motion.samples is not None:
                arrays[f"{name}_samples"] = motion.samples
    return arrays


def checksum(definition: str, arrays: Mapping[str, np.ndarray]) -> str:
    digest = hashlib.sha256(definition.encode())
    for name, array in sorted(arrays.items()):
        digest.update(f"\0{name} {array.shape}\0".encode())
        digest.update(np.ascontiguousarray(array).data)
    return digest.hexdigest()


# -- files -----------------------------------------------------------------------------------------


OTHER_FORMATS = (".csv", ".txt", ".dat", ".xlsx", ".json", ".mat", ".npz", ".pkl", ".png", ".pdf")
"""Endings that promise another file than that of a response."""


def save(path: str | os.PathLike[str], made: Mapping[str, Any]) -> None:
    """Write the fields of a response, by name, to a file; see `Response.save`."""
    check_engine()
    check_target(path)
    ending = Path(path).suffix.lower()
    if ending in OTHER_FORMATS:
        raise InputError("path", path).says(
            f"{path}: a response is saved as netCDF, not as {ending}: name the file .nc, or write "
            "the quantities as a table, run.to_dataframe().to_csv(path)"
        )
    arrays = _arrays(made)
    definition = json.dumps(_definition(made))
    file = xr.Dataset(
        {name: (_VARIABLES[name][0].split(), array, _attrs(name)) for name, array in arrays.items()}
        | {"definition": ((), definition)},
        attrs={
            "title": f"Response of {type(made['structure']).__name__}: {made['outcome']}",
            "rockeom_format": FORMAT,
            "rockeom_version": VERSION,
            "checksum": checksum(definition, arrays),
        },
    )
    write(path, _netcdf(file, arrays))


def _netcdf(dataset: xr.Dataset, arrays: Mapping[str, np.ndarray]) -> bytes:
    """The bytes of a file, made in memory: HDF5 ends the process where a disk is full."""
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    # without a value that stands for a missing one: NaN is what it is
    encoding = {name: {"_FillValue": None} for name in arrays}
    made = io.BytesIO()
    with h5netcdf.File(made, "w") as file:
        dataset.dump_to_store(H5NetCDFStore(file), encoding=encoding)
    return made.getvalue()


_OF_MOTION = ("name", "source", "dt", "is_vertical")


def _definition(made: Mapping[str, Any]) -> dict[str, Any]:
    module, record = made["structure"].module, made["record"]
    return {
        "structure": encode("structure", made["structure"]),
        "source_hash": module.SOURCE_HASH,
        "states": module.STATES,
        "modes": [*module.MODES],
        "impact": _encode_law(made["impact"]),
        "options": encode("options", made["options"]),
        "outcome": str(made["outcome"]),
        "duration": encode("duration", made["duration"]),
        "slope": made["slope"],
        "azimuth": made["azimuth"],
        "ground_axes": made["ground_axes"],
        "statistics": {name: encode(name, value) for name, value in made["statistics"].items()},
        "quantities": None if isinstance(record, Steps) else list(record.extremes),
        **{
            name: made[name] and {field: getattr(made[name], field) for field in _OF_MOTION}
            for name in MOTIONS
        },
    }


def _attrs(name: str) -> dict[str, str]:
    _, about, unit = _VARIABLES[name]
    return {"long_name": about} | ({"units": unit} if unit else {})


def check_engine() -> None:
    if find_spec("h5netcdf") is None or find_spec("h5py") is None:
        raise ModuleNotFoundError(
            "responses are saved and loaded with h5netcdf, which is not installed. Remedy: "
            f"{installed_by('files')}."
        )
