"""Responses in files, from which the same responses are made again, to the last bit.

A file is netCDF-4: the arrays of a response, and a text in JSON that names what it was made of.
What a file names is looked up among the classes that are known here, and made of numbers and words
by their own constructors: nothing in a file is run.
"""

from __future__ import annotations

import dataclasses
import hashlib
import io
import json
import os
import warnings
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rockeom import __version__
from rockeom.files import check_target, write
from rockeom.modelling.declared import class_of_model
from rockeom.modelling.named import FAMILIES, SUPPORTS
from rockeom.motion import GroundMotion
from rockeom.numbers.checks import installed_by, is_number, told
from rockeom.simulation.extremes import Extremes
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.recorder import Samples
from rockeom.simulation.response import KINDS, Outcome, Response
from rockeom.simulation.steps import Steps
from rockeom.structures.classes import SHIPPED, DeclaredStructure, Structure
from rockeom.structures.fixed_base import FixedBase
from rockeom.structures.impact_laws import (
    AngularMomentum,
    EnergyLossAtSpeed,
    EnergyRatio,
    EnergyRatioAtSpeed,
    ImpactLaw,
    Impulsive,
    RandomEnergyRatio,
    VelocityRatio,
)

if TYPE_CHECKING:
    import xarray as xr

    from rockeom.symbolic import Model, RockingModel

FORMAT = 1
"""Of the files: one of a higher format is refused. Who changes it must still read the lower ones.
"""

LAWS = {
    law.__name__: law
    for law in (
        AngularMomentum, EnergyLossAtSpeed, EnergyRatio, EnergyRatioAtSpeed, Impulsive,
        RandomEnergyRatio, VelocityRatio,
    )
}  # fmt: skip
"""Laws of impact that a file may name."""

_OTHERS = {"fixed_base": FixedBase, "options": SolverOptions, **SUPPORTS, **LAWS}
_DECLARED = "declared"
_MOST_COMPRESSED = 1032
"""The most bytes that one byte of a compressed file stands for (deflate)."""


@dataclasses.dataclass(frozen=True)
class LawNotSaved:
    """Stands for a law of impact of the user's own, of which a file has the name alone."""

    name: str

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        raise ValueError(
            f"the law of impact of this response was a {self.name}, a class that is not of rockeom "
            "and that files cannot hold: give it again, as impact="
        )


# -- what a response is made of, as JSON knows it ------------------------------------------------


def _class(name: str) -> type | None:
    """The class that a file calls by this name, or None: no other is ever made."""
    if name in SHIPPED:
        return SHIPPED[name]
    return FAMILIES.get(name) or _OTHERS.get(name)


def _name(value: Any) -> str | None:
    """What a file calls a value's class, or None where it may not."""
    known = {made: name for name, made in _OTHERS.items()}.get(type(value))
    if known is None and isinstance(value, Structure):
        known = value.model
    return known if known is not None and _class(known) is type(value) else None


def _told(what: str, value: Any) -> Any:
    """A value as JSON knows it; raises TypeError for what is of no class that a file may name."""
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, np.bool_ | np.integer):
        return value.item()
    if is_number(value):
        return float(value)
    if isinstance(value, tuple | list):
        return [_told(what, item) for item in value]
    if isinstance(value, DeclaredStructure):
        given: Mapping[str, Any] = value.values
    elif dataclasses.is_dataclass(value):
        given = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
    else:
        given = {}
    fields = {name: _told(f"{what}.{name}", item) for name, item in given.items()}
    name = _name(value)
    if name is not None:
        return {"is": name, "of": fields}
    if isinstance(value, DeclaredStructure):
        told_ = {"is": _DECLARED, "of": fields, "name": value.model}
        return told_ | {"source_hash": value.module.SOURCE_HASH}
    raise TypeError(
        f"{what} is {told(value)}, and files hold no code: save knows shipped, composed and "
        "declared structures, not classes of your own"
    )


def _made(file: _File, value: Any) -> Any:
    """What `_told` was told of."""
    if isinstance(value, list):
        return tuple(_made(file, item) for item in value)
    if not isinstance(value, dict):
        return value
    fields = {name: _made(file, item) for name, item in value["of"].items()}
    if value["is"] == _DECLARED:
        return file.declared(value["name"], value["source_hash"], fields)
    found = _class(value["is"])
    if found is None:
        raise file.error(f"it names {value['is']!r}, which this rockeom, {__version__}, has not")
    return found(**fields)


def _told_law(law: ImpactLaw | None) -> Any:
    if law is None or type(law) in LAWS.values():
        return _told("impact", law)
    name = type(law).__qualname__
    warnings.warn(
        f"the law of impact, a {name}, is of your own: the file has its name, and all that the "
        "response is; to go on from it give the law again",
        stacklevel=5,
    )
    return {"not_saved": name}


def _made_law(file: _File, value: Any) -> ImpactLaw | None:
    if isinstance(value, dict) and "not_saved" in value:
        return LawNotSaved(value["not_saved"])
    return _made(file, value)


# -- arrays --------------------------------------------------------------------------------------

_DIMS: Mapping[str, tuple[str, ...]] = {
    "step_span": ("step", "start_and_length"),
    "step_contact": ("step",),
    "step_powers": ("step", "power", "state"),
    "sample_time": ("sample",),
    "sample_state": ("sample", "state"),
    "sample_contact": ("sample",),
    "extremes": ("quantity", "extreme"),
    "passage_time": ("passage",),
    "passage_kind": ("passage", "kind_before_after_guard"),
    "passage_state": ("passage", "side", "state"),
    "end": ("state",),
    **{
        f"{motion}_{what}": (f"{motion}_{what}", "column")[: 2 - (what == "samples")]
        for motion in ("motion", "vertical")
        for what in ("segments", "samples")
    },
}
_WHOLE_NUMBERS = {"step_contact", "sample_contact", "passage_kind"}
_ABOUT = {
    "step_span": ("start and length of each step of integration", "s"),
    "step_contact": ("number of the contact state in each step", ""),
    "step_powers": ("coefficients of the states' polynomials of the part of a step gone", ""),
    "sample_time": ("times of the samples", "s"),
    "sample_state": ("states at the samples", ""),
    "sample_contact": ("number of the contact state at the samples", ""),
    "extremes": ("minimum, maximum and their times, of each quantity", ""),
    "passage_time": ("times of impacts, uplifts and other passages", "s"),
    "passage_kind": ("kind, contact states before and after, number of the guard", ""),
    "passage_state": ("states before and after each passage", ""),
    "end": ("last state", ""),
}


def _arrays(run: Response) -> dict[str, np.ndarray]:
    record = run.record
    if isinstance(record, Steps):
        fields: tuple[Any, ...] = record.span, record.contact, record.powers
        found = dict(zip(("step_span", "step_contact", "step_powers"), fields, strict=True))
    else:
        fields = record.t, record.y, record.contact
        found = dict(zip(("sample_time", "sample_state", "sample_contact"), fields, strict=True))
        rows = [dataclasses.astuple(one) for one in record.extremes.values()]
        found["extremes"] = np.array(rows)
    passages = ("passage_time", "passage_kind", "passage_state")
    found |= zip(passages, run.passages, strict=True)
    found["end"] = run.end
    for name, motion in (("motion", run.motion), ("vertical", run.vertical)):
        if motion is not None:
            found[f"{name}_segments"] = motion.segments
            if motion.samples is not None:
                found[f"{name}_samples"] = motion.samples
    return found


def _checksum(definition: str, arrays: Mapping[str, np.ndarray]) -> str:
    found = hashlib.sha256(definition.encode())
    for name, array in sorted(arrays.items()):
        found.update(f"\0{name} {array.shape}\0".encode())
        found.update(np.ascontiguousarray(array).data)
    return found.hexdigest()


# -- files ---------------------------------------------------------------------------------------


def save(run: Response, path: str | os.PathLike[str]) -> None:
    """See `Response.save`."""
    _check_engine()
    check_target(path)
    import xarray as xr

    arrays = _arrays(run)
    definition = json.dumps(_definition(run))
    found = xr.Dataset(
        {name: (_DIMS[name], array, _attrs(name)) for name, array in arrays.items()}
        | {"definition": ((), definition)},
        attrs={
            "title": f"Response of {type(run.structure).__name__}: {run.outcome}",
            "rockeom_format": FORMAT,
            "rockeom_version": __version__,
            "checksum": _checksum(definition, arrays),
        },
    )
    write(path, _netcdf(found, arrays))


def _netcdf(found: xr.Dataset, arrays: Mapping[str, np.ndarray]) -> bytes:
    """The bytes of a file, made in memory: HDF5 ends the process where a disk is full."""
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    # without a value that stands for a missing one: NaN is what it is
    encoding = {name: {"_FillValue": None} for name in arrays}
    made = io.BytesIO()
    with h5netcdf.File(made, "w") as file:
        found.dump_to_store(H5NetCDFStore(file), encoding=encoding)
    return made.getvalue()


def _definition(run: Response) -> dict[str, Any]:
    module = run.structure.module
    return {
        "structure": _told("structure", run.structure),
        "source_hash": module.SOURCE_HASH,
        "states": module.STATES,
        "contacts": module.CONTACTS,
        "impact": _told_law(run.impact),
        "options": _told("options", run.options),
        "outcome": str(run.outcome),
        "duration": _told("duration", run.duration),
        "statistics": {name: _told(name, value) for name, value in run.statistics.items()},
        "quantities": None if isinstance(run.record, Steps) else list(run.record.extremes),
        **{
            name: motion
            and {
                "name": motion.name,
                "source": motion.source,
                "dt": motion.dt,
                "is_vertical": motion.is_vertical,
            }
            for name, motion in (("motion", run.motion), ("vertical", run.vertical))
        },
    }


def _attrs(name: str) -> dict[str, str]:
    about, unit = _ABOUT.get(name, (name.replace("_", " "), ""))
    return {"long_name": about} | ({"units": unit} if unit else {})


def _check_engine() -> None:
    if find_spec("h5netcdf") is None or find_spec("h5py") is None:
        raise ModuleNotFoundError(
            "responses are saved and loaded with h5netcdf, which is not installed. Remedy: "
            f"{installed_by('files')}."
        )


def load(
    path: str | os.PathLike[str], structure: Structure | RockingModel | Model | None = None
) -> Response:
    """The response in a file of `Response.save`: all of its properties give the same bits.

    structure : of a response of a structure that you declared, the declaration again, or a
        structure made of it: files hold no code. What was derived from it must be what was derived
        from the one before.

    Machine code is found or compiled where a property asks for it. Where this version of rockeom
    has other equations for a shipped structure than that which wrote the file, a warning says so.

    Raises FileNotFoundError where there is no file; ValueError, with its name, for a file that is
    no response, is damaged or of a newer format, and for a declaration that is missing or another;
    and ModuleNotFoundError without the extra `files`.

        run = rk.load("block.nc")
        run.extremes("theta"), run.impacts, run.at([1.0, 2.0])
    """
    if not (
        structure is None or isinstance(structure, Structure) or hasattr(structure, "check_values")
    ):
        raise TypeError(f"structure is {told(structure)}: give a declaration, or a structure of it")
    _check_engine()
    file = _File(Path(path), structure)
    try:
        return file.response()
    except RecursionError:
        raise file.error("its description is nested deeper than any that was saved") from None
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise file.error(f"it is not as files of responses are: {error!r}") from error
    except ValueError as error:
        if str(path) not in str(error):  # of a constructor
            error.add_note(f"in the file {path}")
        raise


class _File:
    """A file that is read, and the declaration that was given with it."""

    def __init__(self, path: Path, given: Any) -> None:
        self.path, self.given = path, given
        self.asked = False  # whether it has a declared structure
        attrs, self.arrays = _read(path)
        self.definition_text = str(self.arrays.pop("definition", ""))
        format_ = attrs.get("rockeom_format", 0)
        if not (is_number(format_) and format_ > 0):
            raise self.error("it was not written by `run.save(path)`")
        self.version = str(attrs.get("rockeom_version"))
        if format_ > FORMAT:
            raise self.error(
                f"its format is {format_}, of rockeom {self.version}; this rockeom, {__version__}, "
                f"reads formats up to {FORMAT}: install a newer one"
            )
        if attrs.get("checksum") != _checksum(self.definition_text, self.arrays):
            raise self.error("it is damaged: its checksum is not that of what it holds")

    def error(self, text: str) -> ValueError:
        return ValueError(f"{self.path} cannot be loaded: {text}")

    def array(self, name: str, *shape: int | None) -> np.ndarray:
        """An array of the shape, None for any length; raises ValueError for another."""
        found, dtype = self.arrays[name], np.int64 if name in _WHOLE_NUMBERS else np.float64
        fits = len(found.shape) == len(shape) and all(
            wanted in (None, n) for n, wanted in zip(found.shape, shape, strict=True)
        )
        if not fits or found.dtype != dtype:
            raise self.error(f"{name} is {found.dtype} of shape {found.shape}, not {shape}")
        return np.ascontiguousarray(found)

    def check_below(self, name: str, numbers: np.ndarray, bound: int) -> None:
        """Raise ValueError for numbers of something of which there are `bound`."""
        if numbers.size and not (numbers.min() >= 0 and numbers.max() < bound):
            raise self.error(f"{name} reaches from {numbers.min()} to {numbers.max()}")

    def declared(self, name: str, source_hash: str, values: dict[str, float]) -> Structure:
        """A structure of the declaration that was given; raises ValueError where it is another."""
        self.asked, given = True, self.given
        if isinstance(given, FixedBase):  # of the declared one
            given = given.rocking
        if given is None:
            raise self.error(
                f"its structure {name!r} was declared by its user, and files hold no code: give "
                "the declaration, rk.load(path, structure=model)"
            )
        found = type(given) if isinstance(given, Structure) else class_of_model(given)
        made = found(**values) if issubclass(found, DeclaredStructure) else None
        there = vars(found)["module"].SOURCE_HASH if made is not None else None
        if there != source_hash:
            raise self.error(
                f"what is derived from the structure {name!r} has the hash {source_hash} there, "
                f"and what is given has {there or 'none'}: give the declaration that was simulated "
                f"(by rockeom {self.version}; this is {__version__})"
            )
        assert made is not None
        if isinstance(given, Structure) and given != made:
            raise self.error(f"its structure is {made!r}, and {given!r} is given")
        return made

    def structure(self, definition: Mapping[str, Any]) -> Structure:
        made = _made(self, definition["structure"])
        if self.given is not None and not self.asked and made != self.given:
            raise self.error(f"its structure is {made!r}, and {told(self.given)} is given")
        module = made.module
        names = (definition["states"], definition["contacts"])
        if names != (list(module.STATES), list(module.CONTACTS)):
            raise self.error(
                f"{made.model} of rockeom {self.version} had other states or contact states than "
                f"it has in this one, {__version__}"
            )
        if definition["source_hash"] != module.SOURCE_HASH:
            warnings.warn(
                f"{self.path}: the equations of {made.model} were written by rockeom "
                f"{self.version}, and differ in this one, {__version__}: what is not in the file "
                "follows from those of now",
                stacklevel=4,
            )
        return made

    def motion(self, name: str, about: Mapping[str, Any] | None) -> GroundMotion | None:
        if about is None:
            return None
        samples = self.array(f"{name}_samples", None) if about["dt"] is not None else None
        segments = self.array(f"{name}_segments", None, 7)
        is_vertical = bool(about.get("is_vertical", False))  # files before it was known
        return GroundMotion(
            segments, about["name"], about["source"], about["dt"], samples, is_vertical
        )

    def record(self, n: int, contacts: int, quantities: list[str] | None) -> Steps | Samples:
        if quantities is None:
            span = self.array("step_span", None, 2)
            contact = self.array("step_contact", len(span))
            self.check_below("step_contact", contact, contacts)
            return Steps(span, contact, self.array("step_powers", len(span), 8, n))
        t = self.array("sample_time", None)
        contact = self.array("sample_contact", len(t))
        self.check_below("sample_contact", contact, contacts)
        rows = self.array("extremes", len(quantities), 4).tolist()
        extremes = {name: Extremes(*row) for name, row in zip(quantities, rows, strict=True)}
        return Samples(t, self.array("sample_state", len(t), n), contact, extremes)

    def response(self) -> Response:
        definition = json.loads(self.definition_text)
        structure = self.structure(definition)
        n, contacts = len(structure.states), len(structure.module.CONTACTS)
        times = self.array("passage_time", None)
        kinds = self.array("passage_kind", len(times), 4)
        self.check_below("passage_kind", kinds[:, 0], len(KINDS))
        self.check_below("passage_kind", kinds[:, 1:3], contacts)
        motion = self.motion("motion", definition["motion"])
        if motion is None:
            raise self.error("it has no ground motion")
        return Response(
            structure=structure,
            motion=motion,
            vertical=self.motion("vertical", definition["vertical"]),
            impact=_made_law(self, definition["impact"]),
            options=_made(self, definition["options"]),
            outcome=Outcome(definition["outcome"]),
            duration=definition["duration"],
            statistics=definition["statistics"],
            record=self.record(n, contacts, definition["quantities"]),
            end=self.array("end", n),
            passages=(times, kinds, self.array("passage_state", len(times), 2, n)),
        )


def _read(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Attributes and arrays of a netCDF file; raises ValueError for what is none."""
    import xarray as xr

    if path.exists() and not path.is_file():  # a pipe is waited for
        raise ValueError(f"{path} cannot be loaded: it is a folder, a pipe or a device, not a file")
    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_cf=False) as found:
            size = path.stat().st_size
            if found.nbytes > _MOST_COMPRESSED * size:
                raise ValueError(f"{found.nbytes} bytes of arrays cannot lie in {size} bytes")
            return dict(found.attrs), {str(n): v.values for n, v in found.variables.items()}
    except (FileNotFoundError, PermissionError, MemoryError):
        raise
    except Exception as error:
        raise ValueError(
            f"{path} cannot be loaded: it is no file of a response, or was cut off: {error}"
        ) from None
