"""A sweep on disk, in chunks that are each there or pending: the same call does what is missing.

It is a zarr group with an array of each kind of result, a row a case. The outcome of a chunk is
written last; where it was not, its numbers read as zero, which stands for pending. Files are
written next to their place and then moved, so a process that is killed leaves no half of one. Each
chunk has a file in each array, also where it holds nothing but zeros or nan: a file that is missing
is lost, and its chunk is pending. Each file has a checksum, so that a bit that has changed is an
error and no result. The group "labels" has the coordinates, its attribute all else that a dataset
says of the numbers.
"""

import hashlib
import math
import os
import shutil
import sys
import uuid
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import xarray as xr

from rockeom.compiler.locks import lock_held_by_forks
from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import InputError, installed_by, is_number
from rockeom.numbers.mode_codes import ModeNames
from rockeom.sweeps.cases import Cases, Source, labels as labels_of
from rockeom.sweeps.dataset import FLAGS, PENDING, Labels, Sweep, dataset, flags_of, outcomes_of
from rockeom.sweeps.results import NOT_RUN, Results
from rockeom.sweeps.task import Task

FORMAT = 3
"""Format of the files; another one is refused."""

SPREAD = 16
"""Cases, from the first to the last, that tell the function of a sweep from another one."""

_DIMS = {
    "peaks": ("case", "side", "state"), "final": ("case", "state"), "times": ("case", "impact"),
    "extremes": ("case", "side", "quantity"), "histories": ("case", "quantity", "time"),
    "impact_states": ("case", "impact", "side", "state"), "gains": ("case", "gain"),
}  # fmt: skip


class Store:
    """The arrays on disk, compared with those in memory.

    size : cases in a chunk. written (m,) : whether each chunk is there.
    """

    def __init__(self, path: Path, group: Any, results: Results) -> None:
        import zarr

        self.path, self.results = path, results
        self.arrays = _not_empty(results)
        lost = [name for name in self.arrays if name not in group]
        if lost:
            raise InputError("store", path).says(
                f"{str(path / lost[0])!r} is missing: the store is damaged, give another one"
            )
        with zarr.config.set({"array.write_empty_chunks": True}):
            self.on_disk = {name: group[name] for name in self.arrays}
        for name, array in self.arrays.items():
            if self.on_disk[name].shape != array.shape:
                raise InputError("store", path).says(
                    f"{str(path / name)!r} has the shape {self.on_disk[name].shape}, not "
                    f"{array.shape}: the store is damaged, give another one"
                )
        self.size: int = self.on_disk["outcome"].chunks[0]
        self.written = np.zeros(-(-len(results.outcome) // self.size), dtype=bool)

    def read(self) -> None:
        """All chunks that are there, into memory."""
        n = len(self.results.outcome)
        ran = self._read("outcome") != PENDING
        whole = np.logical_and.reduceat(ran, np.arange(0, n, self.size))
        self.written[:] = [whole[chunk] and self._is_there(chunk) for chunk in range(len(whole))]
        there = np.repeat(self.written, self.size)[:n]
        for name, array in self.arrays.items():
            stored = self._read(name)[there]
            array[there] = outcomes_of(stored) if name == "outcome" else stored

    def keep(self, rows: np.ndarray) -> None:
        """Write the chunks that are complete with these rows."""
        for chunk in np.unique(rows // self.size).tolist():
            of = slice(chunk * self.size, (chunk + 1) * self.size)
            outcome = self.results.outcome[of]
            if self.written[chunk] or (outcome == NOT_RUN).any():
                continue
            for name, array in self.arrays.items():
                if name != "outcome":
                    self.on_disk[name][of] = array[of]
            self.on_disk["outcome"][of] = flags_of(outcome)
            self.written[chunk] = True

    def _is_there(self, chunk: int) -> bool:
        """Whether a chunk has its file in each array."""
        for name, array in self.on_disk.items():
            key = array.metadata.encode_chunk_key((chunk,) + (0,) * (array.ndim - 1))
            if not (self.path / name / key).is_file():
                return False
        return True

    def _read(self, name: str) -> np.ndarray:
        try:
            return self.on_disk[name][:]
        except Exception as error:
            error.add_note(
                f"a file of {self.path / name} cannot be read: remove the files of its chunk from "
                f"{self.path / 'outcome'} and {self.path / name}, and the call makes it again"
            )
            raise


def _not_empty(results: Results) -> dict[str, np.ndarray]:
    return {name: array for name, array in results.arrays().items() if array.size}


def open_sweep(path: str | os.PathLike[str]) -> Sweep:
    """Dataset of a sweep that a store holds, as `simulate_many` returns it.

    Parameters
    ----------
    path : path_like
        Folder of the store. Neither the function of the sweep nor its structure are needed, and a
        sweep may still be under way: cases that are not there yet are "not run",
        ``attrs["interrupted"]`` is 1.

    Returns
    -------
    Sweep
        Dataset of the sweep.

    Raises
    ------
    ModuleNotFoundError
        Without zarr.
    ValueError
        For a folder that is no store of a sweep. A chunk whose checksum says that it has changed
        raises the error of zarr.

    Examples
    --------
    With a function `case` and its values `over`::

        rk.simulate_many(case, over, sweep_options=rk.SweepOptions(store="map.zarr"))
        sweep = rk.open_sweep("map.zarr")
    """
    path = Path(path)
    group = _group(path, "r")
    about: Any = group.attrs["labels"]
    named = xr.open_zarr(path, group="labels", consolidated=False).load().variables
    coordinates = {}
    for name in about["coordinates"]:
        array, here = group["labels"][name], named[name]
        if array.nchunks_initialized < array.nchunks:
            raise InputError("store", path).says(
                f"{str(path / 'labels' / name)!r} lacks a file: the store is damaged"
            )
        values = here.values.tolist() if here.dtype.kind in "OT" else here.values
        coordinates[name] = here.dims, values, here.attrs
    if isinstance(about["modes"], dict):
        about = about | {"modes": ModeNames(about["modes"]["points"])}
    labels = Labels(**about | {"coordinates": coordinates})
    facts: Any = group.attrs["rockeom_sweep"]
    results = Results.empty(
        math.prod(labels.shape), len(labels.states), int(facts["impact_times"]),
        facts["impact_states"] == "True", len(labels.quantities), len(labels.times),
    )  # fmt: skip
    Store(path, group, results).read()
    return dataset(results, labels, bool((results.outcome == NOT_RUN).any()))


def _zarr() -> Any:
    try:
        import zarr
    except ModuleNotFoundError:
        raise ModuleNotFoundError(
            "a sweep is kept on disk by zarr, which is not installed. Remedy: "
            f"{installed_by('store')}."
        ) from None
    return zarr


def _group(path: Path, mode: str) -> Any:
    """The group of a store; raises ValueError for anything else, and for another format."""
    zarr = _zarr()
    try:
        group = zarr.open_group(str(path), mode=mode)
        form = dict(group.attrs["rockeom_sweep"])["format"]
    except Exception as error:
        raise InputError("store", path).so("it is no store of a sweep") from error
    if form != str(FORMAT):
        raise InputError("store", path).says(
            f"{str(path)!r} is a sweep in format {form}, which another version of rockeom wrote, "
            f"and this one reads format {FORMAT}: remove it, or give another path, and sweep again"
        )
    if "labels" not in group.attrs:
        raise InputError("store", path).says(
            f"{str(path)!r} lacks its labels: the store is damaged, give another one"
        )
    return group


@contextmanager
def opened(
    path: str | os.PathLike[str],
    definition: Mapping[str, str],
    labels: Labels,
    results: Results,
    chunk: int,
) -> Iterator[Store]:
    """The store of a sweep at a path, made where there is none, for this process alone.

    Its arrays are read into `results`. chunk : of a new one, the number of cases in a chunk.

    Raises ModuleNotFoundError without zarr, ValueError for what is no store or that of another
    sweep, RuntimeError while another process writes to it.
    """
    path = Path(path)
    if not path.exists():
        _make(path, definition, labels, results, chunk)
    group = _group(path, "r+")
    _check_same(path, group.attrs["rockeom_sweep"], definition)
    with _alone(path):
        store = Store(path, group, results)
        store.read()
        yield store


def _make(
    path: Path, definition: Mapping[str, str], labels: Labels, results: Results, chunk: int
) -> None:
    """An empty store; it is there when it is whole."""
    zarr = _zarr()
    beside = path.with_name(f"{path.name}.{uuid.uuid4().hex}.partial")
    coordinates = labels.variables(results)[1]
    about = {**vars(labels), "coordinates": [*coordinates]}
    if isinstance(labels.modes, ModeNames):  # far too many, made of few words
        about["modes"] = {"points": labels.modes.points}
    seconds: dict[str, Any] = {"units": labels.seconds}
    flags = {name: np.asarray(value).tolist() for name, value in FLAGS.items()}
    of = {"outcome": flags, "final_time": seconds, "times": seconds}
    how = {"compressors": zarr.codecs.ZstdCodec(level=0, checksum=True)}
    try:
        attributes = {"rockeom_sweep": dict(definition), "labels": about}
        group = zarr.create_group(str(beside), zarr_format=3, attributes=attributes)
        for name, array in _not_empty(results).items():
            group.create_array(
                name, shape=array.shape, dtype=np.int8 if name == "outcome" else array.dtype,
                chunks=(min(chunk, len(array)), *array.shape[1:]),
                fill_value=np.nan if array.dtype == float else 0,
                dimension_names=_DIMS.get(name, ("case",)), attributes=of.get(name, {}), **how,
            )  # fmt: skip
        named = xr.Dataset(coords=coordinates)
        texts = {n: v.astype(str) for n, v in named.variables.items() if v.dtype.kind in "OU"}
        words = {n: v.astype(object) for n, v in texts.items()}
        encoding = dict.fromkeys(named.variables, how)
        named.assign_coords(words).to_zarr(
            beside, group="labels", consolidated=False, encoding=encoding, write_empty_chunks=True
        )
        beside.rename(path)
    except OSError:  # another process was faster: what it has made is looked at like any other
        if not path.exists():
            raise
    finally:
        shutil.rmtree(beside, ignore_errors=True)


# -- the definition ------------------------------------------------------------------------------


def definition(task: Task, cases: Cases, module: GeneratedModule) -> dict[str, str]:
    """A sweep in words and hashes, by which a store refuses another one.

    Functions cannot be compared, but what they make can: the numbers of the first case, the last
    and some between, and of one case of each object among the values.
    """
    facts = {
        "format": str(FORMAT),
        "structure": module.NAME,
        "equations and loop": task.revision,
        "cases": f"a {'grid' if cases.which is None else 'table'} of "
        + " x ".join(map(str, cases.shape)),
        "names": ", ".join(cases.values),
        "impact_times": str(task.impact_times),
        "impact_states": str(bool(task.impact_states)),
        "quantities": ", ".join(task.quantities),
        "times": str(np.asarray(task.times, dtype=float).tolist()),
        "lanes": str(task.lanes),
    }
    facts |= {name: repr(value) for name, value in asdict(task.options).items()}
    for name, values in cases.values.items():
        which = () if cases.which is None else (cases.which[name],)
        facts[f"values of {name}"] = _hash(_of_values(values), *which)
    source = task.source(cases, module, chunk=None)
    facts["what the function makes"] = _hash(*_problems(source, _sample(cases)))
    return facts


def _of_values(values: Sequence[Any] | np.ndarray) -> np.ndarray | str:
    """Identity of values: numbers and words themselves, names of other objects."""
    if {*map(type, values)} <= {float, np.float64}:
        return np.array(values)
    plain = all(isinstance(value, str) or is_number(value) for value in values)
    return repr([(type(v).__name__, v) for v in values] if plain else labels_of(values))


def _sample(cases: Cases) -> np.ndarray:
    """Rows: some from the first to the last, and the first of each object."""
    spread = np.linspace(0, cases.total - 1, SPREAD).astype(int)
    places_in = [spread]
    every = cases.places(np.arange(cases.total))
    for values, places in zip(cases.values.values(), every, strict=True):
        if not all(isinstance(value, str) or is_number(value) for value in values):
            places_in.append(np.unique(places, return_index=True)[1])
    return np.unique(np.concatenate(places_in))


def _problems(source: Source, rows: np.ndarray) -> Iterator[np.ndarray]:
    """The numbers of some cases, as the compiled loop takes them."""
    for point in zip(*(place.tolist() for place in source.cases.places(rows)), strict=True):
        _, problem = source.made(point)
        yield from (np.asarray(numbers, dtype=float) for numbers in problem)


def _hash(*parts: np.ndarray | str) -> str:
    digest = hashlib.sha256()
    for part in parts:
        if isinstance(part, str):
            part = np.frombuffer(part.encode(), dtype=np.uint8)
        digest.update(f"{part.dtype.str} {part.shape} ".encode())
        digest.update(np.ascontiguousarray(part).tobytes())
    return digest.hexdigest()[:20]


def _check_same(path: Path, there: Mapping[str, str], here: Mapping[str, str]) -> None:
    differ = [
        f"{name} ({there.get(name, 'none')} there, {here.get(name, 'none')} here)"
        for name in {**here, **there}
        if there.get(name) != here.get(name)
    ]
    if differ:
        raise InputError("store", path).says(
            f"{str(path)!r} holds another sweep: {'; '.join(differ)}. Give another store, or "
            "remove this one to begin again"
        )


# -- one process at a time -----------------------------------------------------------------------

_HELD: set[Path] = set()
_TURN = lock_held_by_forks()


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """The store for this process, and in it for who asks first; however it ends, it is let go.

    The lock is on a file among those of an array, where zarr looks at none that it does not know.
    """
    busy = RuntimeError(
        f"{str(path)!r} is being written by another sweep: wait until it has ended, or give "
        "another store"
    )
    key = path.resolve()
    with _TURN:
        if key in _HELD:
            raise busy
        _HELD.add(key)
    try:
        with (path / "outcome" / ".lock").open("ab") as file:
            try:
                _lock(file)
            except (BlockingIOError, PermissionError):
                raise busy from None
            except OSError as error:
                warn_caller(
                    f"{str(path)!r} cannot be locked ({error}): see to it that no other process "
                    "writes to it",
                )
            yield
    finally:
        with _TURN:
            _HELD.discard(key)


if sys.platform == "win32":
    import msvcrt

    def _lock(file: BinaryIO) -> None:
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(file: BinaryIO) -> None:
        """A lock that forked workers do not inherit, and that goes with its process."""
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
