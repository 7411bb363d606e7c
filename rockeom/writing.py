"""Files that are written whole or not at all: the one home of every `save` and `--out`."""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_TEMPORARY = ".rockeom.{}.tmp"
_DAY = 86400.0  # s


@contextmanager
def written_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A path to write to; the file written there replaces that at `path` in one step.

    The temporary file keeps the suffix, by which some libraries choose a format.

    Raises FileNotFoundError without the folder, OSError where `path` is no regular file (a device,
    a pipe, a socket, a folder), and the error of a full disk with the path as a note. The old file
    is then still there.
    """
    target = Path(os.path.realpath(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(f"{path}: there is no folder {target.parent}")
    check_replaceable(path)
    remove_leftovers(target.parent, _TEMPORARY.format("*") + "*")
    temporary = target.with_name(_TEMPORARY.format(os.urandom(8).hex()) + target.suffix)
    try:
        yield temporary
        with open(temporary, "rb+") as file:
            os.fsync(file.fileno())
        os.replace(temporary, target)
    except OSError as error:
        error.add_note(f"{path} was not written")
        raise
    finally:
        with suppress(FileNotFoundError):
            temporary.unlink()


def check_replaceable(path: str | os.PathLike[str]) -> None:
    """Raises OSError where `path` is there and no regular file."""
    with suppress(FileNotFoundError):
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise OSError(f"{path} is no regular file: give the name of a file to write or replace")


def remove_leftovers(folder: Path, pattern: str) -> None:
    """Removes files of processes that were killed while they wrote, a day ago or longer."""
    with suppress(OSError):
        for temporary in folder.glob(pattern):
            with suppress(OSError):
                if temporary.lstat().st_mtime < time.time() - _DAY:
                    temporary.unlink()
