"""`load`: a response out of the file that `rockeom.simulation.saved` wrote, to the last bit.

The names in a file are looked up among the classes known here, and their own constructors take the
numbers and words of the file: nothing in a file is run.
"""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from rockeom.files import check_path
from rockeom.modelling.boulder import Boulder
from rockeom.modelling.declared import class_of_model
from rockeom.modelling.facade import Facade
from rockeom.modelling.held_block import HeldBlock
from rockeom.modelling.isolated import IsolatedBlocks
from rockeom.modelling.named import FAMILIES, SUPPORTS
from rockeom.modelling.rolling import RollingCylinder
from rockeom.modelling.standing import LeggedStatue, Prism
from rockeom.modelling.wobbling import Podium, WobblingColumn
from rockeom.motion import GroundMotion
from rockeom.motion.slope import SLOPE
from rockeom.numbers import explained
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import InputError, InputTypeError, described, is_number
from rockeom.simulation.events import KINDS, EventColumns, Events
from rockeom.simulation.extremes import Extremes
from rockeom.simulation.outcome import Outcome
from rockeom.simulation.recorder import Samples
from rockeom.simulation.response import Response
from rockeom.simulation.saved import DECLARED, FORMAT, NAMES, WHOLE_NUMBERS, check_engine, checksum
from rockeom.simulation.steps import Steps
from rockeom.structures.base import FixedBase, Structure
from rockeom.structures.classes import SHIPPED
from rockeom.structures.declared import DeclaredStructure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.restraints import RESTRAINTS
from rockeom.version import VERSION

if TYPE_CHECKING:
    from rockeom.symbolic import Model, RockingModel

_READY = {
    one.model: one
    for one in (
        Boulder,
        Facade,
        HeldBlock,
        IsolatedBlocks,
        LeggedStatue,
        Podium,
        Prism,
        RollingCylinder,
        WobblingColumn,
    )
}
_OTHERS = {**_READY, **SUPPORTS, **RESTRAINTS, **{name: made for made, name in NAMES.items()}}
_MOST_COMPRESSED = 1032
"""The most bytes that one byte of a compressed file stands for (deflate)."""


@dataclasses.dataclass(frozen=True)
class LawNotSaved:
    """A placeholder of an impact law of the user's own, of which a file has the name alone."""

    name: str

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        raise InputError("impact").says(
            f"the impact law of this response was a {self.name}, a class that is not of rockeom "
            "and that files cannot hold: give it again, as impact="
        )


# -- decoding --------------------------------------------------------------------------------------


def _class(name: str) -> type | None:
    """The class that a file calls by this name, or None: no other is ever made."""
    if name in SHIPPED:
        return SHIPPED[name]
    return FAMILIES.get(name) or _OTHERS.get(name)


def _decode(file: _File, value: Any) -> Any:
    """The value that `encode` made this of."""
    if isinstance(value, list):
        return tuple(_decode(file, item) for item in value)
    if not isinstance(value, dict):
        return value
    fields = {name: _decode(file, item) for name, item in value["of"].items()}
    if value["is"] == DECLARED:
        return file.declared(value["name"], value["source_hash"], fields)
    cls = _class(value["is"])
    if cls is None:
        raise file.error(f"it names {value['is']!r}, which this rockeom, {VERSION}, has not")
    return cls(**fields)


def _decode_law(file: _File, value: Any) -> ImpactLaw | None:
    if isinstance(value, dict) and "not_saved" in value:
        return LawNotSaved(value["not_saved"])
    return _decode(file, value)


# -- files ---------------------------------------------------------------------------------------


@explained.calls()
def load(
    path: str | os.PathLike[str], structure: Structure | RockingModel | Model | None = None
) -> Response:
    """Response in a file of `Response.save`: all of its properties give the same bits.

    Parameters
    ----------
    path : path_like
        File.
    structure : Structure or RockingModel or Model, optional
        For a response of a structure that you declared, the declaration again, or a structure made
        of it: files hold no code. Its equations must be those of the simulation.

    Returns
    -------
    Response
        Response.

    Raises
    ------
    FileNotFoundError
        Where there is no file.
    ValueError
        For a file that is no response, is damaged or of another format, and for a declaration that
        is missing or another.
    ModuleNotFoundError
        Without the extra `files`.

    Warns
    -----
    UserWarning
        Where this version of rockeom has other equations for a shipped structure than that which
        wrote the file.

    Notes
    -----
    Machine code is read from the cache or compiled where a property asks for it.

    Examples
    --------
    >>> import rockeom as rk
    >>> run = rk.load("block.nc")  # doctest: +SKIP
    >>> run.extremes("theta"), run.impacts, run.at([1.0, 2.0])  # doctest: +SKIP
    """
    if not (
        structure is None or isinstance(structure, Structure) or hasattr(structure, "check_values")
    ):
        raise InputTypeError("structure", structure).give("a declaration, or a structure of it")
    check_path(path)
    if not os.path.exists(path):
        raise FileNotFoundError(
            f"{path}: there is no such file; relative paths start at {Path.cwd()}"
        )
    check_engine()
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

    def __init__(self, path: Path, model: Any) -> None:
        self.path, self.declaration = path, model
        self.asked = False  # whether it has a declared structure
        attrs, self.arrays = _read(path)
        self.definition_text = str(self.arrays.pop("definition", ""))
        format_ = attrs.get("rockeom_format", 0)
        if not (is_number(format_) and format_ > 0):
            raise self.error("it was not written by `run.save(path)`")
        self.version = str(attrs.get("rockeom_version"))
        if format_ != FORMAT:
            raise self.error(
                f"it is a response in format {format_}, which another version of rockeom wrote "
                f"({self.version}), and this one, {VERSION}, reads format {FORMAT}: simulate "
                "again and save that response"
            )
        if attrs.get("checksum") != checksum(self.definition_text, self.arrays):
            raise self.error("it is damaged: its checksum is not that of what it holds")

    def error(self, text: str) -> ValueError:
        return ValueError(f"{self.path} cannot be loaded: {text}")

    def array(self, name: str, *shape: int | None) -> np.ndarray:
        """An array of the shape, None for any length; raises ValueError for another."""
        values, dtype = self.arrays[name], np.int64 if name in WHOLE_NUMBERS else np.float64
        fits = len(values.shape) == len(shape) and all(
            wanted in (None, n) for n, wanted in zip(values.shape, shape, strict=True)
        )
        if not fits or values.dtype != dtype:
            raise self.error(f"{name} is {values.dtype} of shape {values.shape}, not {shape}")
        return np.ascontiguousarray(values)

    def check_below(self, name: str, numbers: np.ndarray, bound: int) -> None:
        """Raise ValueError for numbers of something of which there are `bound`."""
        if numbers.size and not (numbers.min() >= 0 and numbers.max() < bound):
            raise self.error(f"{name} reaches from {numbers.min()} to {numbers.max()}")

    def declared(self, name: str, source_hash: str, values: dict[str, float]) -> Structure:
        """A structure of the declaration that was given; raises ValueError where it is another."""
        self.asked, model = True, self.declaration
        if isinstance(model, FixedBase):  # of the declared one
            model = model.rocking
        if model is None:
            raise self.error(
                f"its structure {name!r} was declared by its user, and files hold no code: give "
                "the declaration, rk.load(path, structure=model)"
            )
        cls = type(model) if isinstance(model, Structure) else class_of_model(model)
        made = cls(**values) if issubclass(cls, DeclaredStructure) else None
        there = vars(cls)["module"].SOURCE_HASH if made is not None else None
        if there != source_hash:
            raise self.error(
                f"what is derived from the structure {name!r} has the hash {source_hash} there, "
                f"and what is given has {there or 'none'}: give the declaration that was simulated "
                f"(by rockeom {self.version}; this is {VERSION})"
            )
        assert made is not None
        if isinstance(model, Structure) and model != made:
            raise self.error(f"its structure is {made!r}, and {model!r} is given")
        return made

    def structure(self, definition: Mapping[str, Any]) -> Structure:
        made = _decode(self, definition["structure"])
        if self.declaration is not None and not self.asked and made != self.declaration:
            raise self.error(
                f"its structure is {made!r}, and {described(self.declaration)} is given"
            )
        module = made.module
        names = (definition["states"], definition["modes"])
        if names != (list(module.STATES), list(module.MODES)):
            raise self.error(
                f"{made.model} of rockeom {self.version} had other states or modes than "
                f"it has in this one, {VERSION}"
            )
        if definition["source_hash"] != module.SOURCE_HASH:
            warn_caller(
                f"{self.path}: the equations of {made.model} were written by rockeom "
                f"{self.version}, and differ in this one, {VERSION}: what is not in the file "
                "follows from those of now",
            )
        return made

    def motion(self, name: str, about: Mapping[str, Any] | None) -> GroundMotion | None:
        if about is None:
            return None
        samples = self.array(f"{name}_samples", None) if about["dt"] is not None else None
        segments = self.array(f"{name}_segments", None, 7)
        return GroundMotion(
            segments, about["name"], about["source"], about["dt"], samples, about["is_vertical"]
        )

    def record(self, n: int, n_modes: int, quantities: list[str] | None) -> Steps | Samples:
        if quantities is None:
            span = self.array("step_span", None, 2)
            modes = self.array("step_mode", len(span))
            self.check_below("step_mode", modes, n_modes)
            return Steps(span, modes, self.array("step_powers", len(span), 8, n))
        t = self.array("sample_time", None)
        modes = self.array("sample_mode", len(t))
        self.check_below("sample_mode", modes, n_modes)
        rows = self.array("extremes", len(quantities), 4).tolist()
        extremes = {name: Extremes(*row) for name, row in zip(quantities, rows, strict=True)}
        return Samples(t, self.array("sample_state", len(t), n), modes, extremes)

    def response(self) -> Response:
        definition = json.loads(self.definition_text)
        structure = self.structure(definition)
        n, n_modes = len(structure.states), len(structure.module.MODES)
        times = self.array("event_time", None)
        kinds = self.array("event_kind", len(times), 4)
        self.check_below("event_kind", kinds[:, 0], len(KINDS))
        self.check_below("event_kind", kinds[:, 1:3], n_modes)
        states = self.array("event_state", len(times), 2, n)
        motion = self.motion("motion", definition["motion"])
        if motion is None:
            raise self.error("it has no ground motion")
        return Response(
            structure=structure,
            motion=motion,
            vertical=self.motion("vertical", definition["vertical"]),
            impact=_decode_law(self, definition["impact"]),
            options=_decode(self, definition["options"]),
            outcome=Outcome(definition["outcome"]),
            duration=definition["duration"],
            statistics=definition["statistics"],
            record=self.record(n, n_modes, definition["quantities"]),
            events=Events(structure, EventColumns(times, kinds, states)),
            end=self.array("end", n),
            slope=definition.get("slope", 0.0),
            ground_axes=definition.get("ground_axes", SLOPE),
            transverse=self.motion("transverse", definition.get("transverse")),
            azimuth=definition.get("azimuth", 0.0),
        )


def _read(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Attributes and arrays of a netCDF file; raises ValueError for what is none."""
    if path.exists() and not path.is_file():  # a pipe is waited for
        raise InputError("path", path).says(
            f"{path} cannot be loaded: it is a folder, a pipe or a device, not a file"
        )
    try:
        with xr.open_dataset(path, engine="h5netcdf", decode_cf=False, phony_dims="sort") as data:
            size = path.stat().st_size
            if data.nbytes > _MOST_COMPRESSED * size:
                raise ValueError(f"{data.nbytes} bytes of arrays cannot lie in {size} bytes")
            return dict(data.attrs), {str(n): v.values for n, v in data.variables.items()}
    except (FileNotFoundError, PermissionError, MemoryError):
        raise
    except Exception as error:
        raise InputError("path", path).says(
            f"{path} cannot be loaded: it is no file of a response, or was cut off: {error}"
        ) from None
