"""One compiled program for each structure and method, kept on disk between processes.

The generated module, the text of a step and the loop are joined into one self-contained file in
the user's cache. Its name contains the hash of all that its text follows from: a changed
structure, method or loop gives another file, so what was compiled for an old text is never used
for a new one, and no file is ever overwritten.
"""

from __future__ import annotations

import gc
import hashlib
import importlib.util
import inspect
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from types import ModuleType
from typing import Any

_PREAMBLE = '''"""{name} with {method}: equations, step and loop in one text. Made by rockeom."""

import math

import numpy as np

'''


def cache_folder() -> Path:
    """Where compiled programs are kept: $ROCKEOM_CACHE_DIR, or the system's place for caches."""
    chosen = os.environ.get("ROCKEOM_CACHE_DIR")
    if chosen:
        return Path(chosen)
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA", str(Path.home() / "AppData" / "Local"))
        return Path(base) / "rockeom" / "cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "rockeom"
    return Path(os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache"))) / "rockeom"


def load_text(name: str, text: str) -> ModuleType:
    """Import a module from its text, through a file of the cache named by its content."""
    return _load(name, _digest(text), lambda: text)


def _digest(*sources: str) -> str:
    return hashlib.sha256("\0".join(sources).encode()).hexdigest()[:20]


def _load(name: str, digest: str, text: Callable[[], str]) -> ModuleType:
    """The same by the digest of what a text is made of; it is asked for if there is no file yet."""
    module_name = f"rockeom_{name}_{digest}"
    if module_name in sys.modules:
        return sys.modules[module_name]
    folder = cache_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        path = _store(folder / f"{module_name}.py", text)
    except OSError:  # a read-only home: compile for this process only
        path = _store(Path(tempfile.mkdtemp(prefix="rockeom-")) / f"{module_name}.py", text)
    spec = importlib.util.spec_from_file_location(module_name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[module_name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[module_name]
        raise
    return module


def _store(path: Path, text: Callable[[], str]) -> Path:
    """Write the file whole or not at all, so that processes may race for it."""
    if not path.exists():
        handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "w", encoding="utf-8") as f:
            f.write(text())
        os.replace(temporary, path)
    return path


@cache
def _own(name: str) -> str:
    """Text of a file beside this one."""
    return (files("rockeom.numeric") / name).read_text(encoding="utf-8")


@cache
def program(generated: ModuleType, method: str, lanes: bool = False) -> ModuleType:
    """The module with `integrate` and `evaluate` for a generated module and a method's name.

    lanes : with `integrate_lanes`, too.
    """
    if lanes and method == "Radau":
        raise ValueError("lanes know no implicit method: choose 'DOP853' or 'RK45'")
    equations = inspect.getsource(generated)
    # all that the joined text follows from; SciPy holds the coefficients of the methods
    digest = _digest(
        equations, method, _own("loop.py"), _own("tableau.py"), _own("specialise.py"),
        version("scipy"), *(_own(name) for name in ("lanes.py", "lanes_text.py") if lanes),
        *(_own(name) for name in ("implicit.py",) if method == "Radau"),
    )  # fmt: skip

    def text() -> str:
        from rockeom.numeric.tableau import step_text, tableau  # SciPy takes a while to import

        # only the entries of the loop are called from Python and stored
        n = generated.N_STATES // 2
        if method == "Radau":
            from rockeom.numeric.implicit import implicit_step_text

            step = implicit_step_text(n)
        else:
            step = step_text(tableau(method), n)
        inner = "njit(no_cpython_wrapper=True, no_cfunc_wrapper=True, "
        parts: tuple[str, ...] = (
            _PREAMBLE.format(name=generated.NAME, method=method),
            equations.replace("njit(cache=True, **", "njit(**").replace("njit(", inner),
            step,
            "\n\n",
            _own("loop.py"),
        )
        if lanes:
            from rockeom.numeric.lanes_text import lanes_text

            parts += (lanes_text(tableau(method), generated), "\n\n", _own("lanes.py"))
        return "".join(parts)

    module = _load(f"{generated.NAME}_{method.lower()}{'_lanes' * lanes}", digest, text)
    _UNSAID[module.__name__] = f"{generated.NAME} with {method}{' in lanes' * lanes}"
    _listen()
    return module


_UNSAID: dict[str, str] = {}
"""Programs of whose compilation nothing was said yet, and how each is called."""


@cache
def _listen() -> None:
    """From now on, say on stderr that a program is compiled, the first time for each.

    numba itself tells when it compiles and does not find the result on disk. It compiles one
    function at a time, whatever the number of threads, and within it those that it calls.
    """
    from numba.core import event

    class Announcement(event.Listener):
        outermost: Any = None
        started = 0.0

        def on_start(self, event: Any) -> None:
            dispatcher = event.data["dispatcher"]
            name = _UNSAID.pop(dispatcher.py_func.__module__, None)
            if name is not None:
                self.outermost, self.started = dispatcher, time.monotonic()
                _say(f"rockeom: compiling {name}, once on this machine ...")

        def on_end(self, event: Any) -> None:
            if event.data["dispatcher"] is self.outermost:
                self.outermost, took = None, time.monotonic() - self.started
                _say(f" {took:.0f} s\n" if took > 1.0 else "\n")

    event.register("numba:compile", Announcement())


def _say(text: str) -> None:
    if sys.stderr is not None:  # as of a program without a console
        sys.stderr.write(text)
        sys.stderr.flush()


@contextmanager
def compiling(entry: Any) -> Iterator[None]:
    """Around the first call of an entry: garbage, of which a compiler makes much, waits."""
    if entry.signatures or not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
