"""One compiled program for each structure and method, kept on disk between processes.

The generated module, the text of a step and the loop are joined into one self-contained file in
the user's cache. Its name contains the hash of its content: a changed structure, method or loop
gives another file, so what was compiled for an old text is never used for a new one, and no
file is ever overwritten.
"""

from __future__ import annotations

import hashlib
import importlib.util
import inspect
import os
import sys
import tempfile
from functools import cache
from importlib.resources import files
from pathlib import Path
from types import ModuleType

from rockeom.numeric.tableau import step_text, tableau

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
    digest = hashlib.sha256(text.encode()).hexdigest()[:20]
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


def _store(path: Path, text: str) -> Path:
    """Write the file whole or not at all, so that processes may race for it."""
    if not path.exists():
        handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "w", encoding="utf-8") as f:
            f.write(text)
        os.replace(temporary, path)
    return path


@cache
def _loop_text() -> str:
    return (files("rockeom.numeric") / "loop.py").read_text(encoding="utf-8")


@cache
def program(generated: ModuleType, method: str) -> ModuleType:
    """The module with `integrate` and `evaluate` for a generated module and a method's name."""
    # only the entries of the loop are stored: what they call is part of their code
    equations = inspect.getsource(generated).replace("njit(cache=True, ", "njit(")
    parts = (
        _PREAMBLE.format(name=generated.NAME, method=method),
        equations,
        step_text(tableau(method)),
        "\n\n",
        _loop_text(),
    )
    return load_text(f"{generated.NAME}_{method.lower()}", "".join(parts))
