"""The place on disk where compiled programs are kept between processes.

A file from here is run as machine code, so a file counts only if it is whole (its first line
tells which program follows, its length and its SHA-256) and if nobody but this user can have
written it. Any other file is made again and replaced. Where nothing can be stored (a full disk, a
read-only home, a folder that is gone), each process compiles for itself, and nothing is raised.
"""

import hashlib
import os
import stat
import sys
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path

from rockeom.files import remove_leftovers


def cache_folder() -> Path:
    """Where compiled programs are kept: $ROCKEOM_CACHE_DIR, or the system's place for caches."""
    chosen = os.environ.get("ROCKEOM_CACHE_DIR")
    if chosen:
        return Path(chosen)
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
        return Path(base) / "rockeom" / "cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "rockeom"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "rockeom"


def kept(name: str, digest: str, make: Callable[[], bytes]) -> bytes:
    """The bytes stored under name and digest; made, and stored if that can be done, if none are.

    digest : a hash of all that the bytes follow from; the name is for who looks into the folder.

    Raises ValueError for other than letters, digits and underscores in name or digest, and what
    `make` raises; nothing on account of the disk.
    """
    key = f"rockeom_{name}_{digest}"
    if not key.isidentifier():
        raise ValueError(
            f"the program {key!r} cannot be stored: its name and digest must consist of letters, "
            "digits and underscores"
        )
    folder = _folder()
    if folder is None:
        return make()
    # ASCII: not every system takes every letter in the name of a file, or so many bytes of them
    path = os.path.join(folder, key.encode("ascii", "ignore").decode() + ".compiled")
    code = _read(path, key)
    if code is None:
        code = make()
        remove_leftovers(folder, "rockeom_*.compiled.*.tmp")
        _write(path, _head(key, code), code)
    return code


def _folder() -> Path | None:
    """The folder, there and safe to use, or None; who may write into it chooses what is run."""
    try:
        folder = cache_folder().absolute()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        # Through links: a cache on another disk is common, and what counts is who may write there.
        state = folder.stat()
    except (OSError, RuntimeError):  # a deleted current folder, a file in the way; no home
        return None
    danger = _danger(state)
    if danger is None:
        return folder
    _warn_once(
        f"rockeom: the cache folder {folder} {danger}; what it holds is run as code, so nothing "
        "is read from it or stored in it, and each process compiles again. Set ROCKEOM_CACHE_DIR "
        "to a folder that only you can write to or, if this one is yours, run "
        f"`chmod go-w '{folder}'`"
    )
    return None


def _danger(state: os.stat_result) -> str | None:
    """Other users who can have written a file with this state, if any.

    On Windows owner and mode tell nothing: there the user's own folder is trusted unseen.
    """
    if sys.platform == "win32":
        return None
    if state.st_uid != os.geteuid():
        return f"belongs to another user (number {state.st_uid}; you are {os.geteuid()})"
    if state.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        return f"may be written to by others (mode {stat.S_IMODE(state.st_mode):o})"
    return None


@cache
def _warn_once(text: str) -> None:
    warnings.warn(text, RuntimeWarning, stacklevel=2)


def _head(key: str, payload: bytes) -> bytes:
    """The first line of a file. With the key: a whole file under another's name is foreign."""
    sha = hashlib.sha256(payload).hexdigest()
    return f"rockeom program, 1: {key}, {len(payload)} bytes, SHA-256 {sha}\n".encode()


def _read(path: str, key: str) -> bytes | None:
    """The stored code, or None; looked at and read through one opening of the file."""
    try:
        with open(path, "rb", opener=_open_itself) as f:
            state = os.fstat(f.fileno())
            if not stat.S_ISREG(state.st_mode):
                return None
            danger = _danger(state)
            if danger is not None:
                _warn_once(
                    f"rockeom: the compiled program {path} {danger}; it would be run as code, so "
                    "it is not used, but made again and replaced"
                )
                return None
            head, payload = f.readline(), f.read()
    except OSError:
        return None
    return payload if head == _head(key, payload) else None


def _open_itself(path: str, flags: int) -> int:
    """Open the file, not what a link points to: no link was stored here, so one is foreign.

    A pipe in its place must not wait for a writer. (Windows has neither flag.)
    """
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))


def _open_privately(path: str, flags: int) -> int:
    return os.open(path, flags, 0o600)


def _write(path: str, *parts: bytes) -> None:
    """Write the file whole or not at all, so that processes may race for it."""
    temporary = f"{path}.{os.urandom(8).hex()}.tmp"
    try:
        with open(temporary, "xb", opener=_open_privately) as f:
            f.writelines(parts)
        os.replace(temporary, path)
    except OSError:
        pass  # a full disk or a read-only folder: the next process makes it again
    finally:
        # A Ctrl-C that waits is raised after the next call, so that call is the removal itself
        # (`suppress` would be one before it).
        try:  # noqa: SIM105
            os.unlink(temporary)
        except OSError:
            pass  # it is in its place, or never was
