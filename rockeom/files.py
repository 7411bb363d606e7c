"""Files that are written whole or not at all.

Every file of a user is written here. The bytes go to a temporary file in the same folder, which
then replaces the one that was there; so a full disk, an error or an end of the process leaves the
old file as it was.
"""

import os
import stat
import time
from contextlib import suppress
from pathlib import Path

from rockeom.numbers.checks import FilePath, require, require_type

TEMPORARY = ".rockeom.{}.tmp"
_DAY = 86400.0  # s
_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


def in_text(path: str | os.PathLike[str]) -> Path:
    """A path as a text names it: where it is not UTF-8, its bytes are letters of Latin-1."""
    try:
        os.fspath(path).encode()
    except UnicodeEncodeError:
        return Path(os.fsencode(path).decode("latin-1"))
    return Path(path)


def check_path(path: FilePath) -> None:
    """Raise TypeError for what is no path of a file, ValueError for an empty one."""
    require_type("path", path, str | os.PathLike, "the path of a file, as text or pathlib.Path")
    require(bool(os.fspath(path)), "", "path", path, "name a file")


def check_target(path: str | os.PathLike[str]) -> Path:
    """The file behind a path and its links, which may not exist yet.

    Raises OSError where no file can be written there: the folder is missing, the path is a folder,
    a pipe, a socket or a device, or the file is read-only. To be called before long work.
    """
    check_path(path)
    target = Path(os.path.realpath(path))
    if not target.parent.is_dir():
        folder = Path(path).parent if not os.path.islink(path) else target.parent
        raise FileNotFoundError(f"{path}: there is no folder {folder}; make it first")
    try:
        mode = os.stat(path).st_mode  # not of `target`: /dev/stdout may lead to no path
    except FileNotFoundError:
        return target
    if not stat.S_ISREG(mode):
        kind = _KINDS.get(stat.S_IFMT(mode), "not a file")
        raise FileExistsError(f"{path} is {kind}, which is not replaced: name a file")
    if not os.access(target, os.W_OK):
        raise PermissionError(f"{path} is read-only: name another file, or allow writing to it")
    return target


def write(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write text, in UTF-8, or bytes to a file; an existing file is replaced and keeps its mode.

    Raises OSError with the path where that fails: an existing file is then as it was.
    """
    target = check_target(path)
    remove_leftovers(target.parent, TEMPORARY.format("*"))
    temporary = target.with_name(TEMPORARY.format(os.urandom(8).hex()))
    try:
        with open(temporary, "xb") as file:
            file.write(content.encode("utf-8") if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())
        with suppress(FileNotFoundError):
            os.chmod(temporary, stat.S_IMODE(target.stat().st_mode))
        os.replace(temporary, target)
    except OSError as error:
        text = f"it cannot be written: {error.strerror}"
        raise OSError(error.errno, text, os.fspath(path)) from error
    finally:
        with suppress(OSError):
            temporary.unlink()


def remove_leftovers(folder: Path, pattern: str) -> None:
    """Files of processes that were killed while they wrote, a day ago or longer."""
    with suppress(OSError):
        for temporary in folder.glob(pattern):
            with suppress(OSError):
                if temporary.lstat().st_mtime < time.time() - _DAY:
                    temporary.unlink()
