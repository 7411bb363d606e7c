"""Texts of modules: those of this package, generated ones, and modules made from a text."""

import hashlib
import linecache
import sys
from types import ModuleType
from typing import Any


def digest(*texts: str) -> str:
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:20]


def source(generated: Any) -> str:
    """The text of a module: of its file, or as `load_text` was given it."""
    return "".join(linecache.getlines(str(generated.__file__)))


def load_text(name: str, text: str) -> ModuleType:
    """A module of a generated text; the same text gives the same module."""
    module_name = f"rockeom_{name}_{digest(name, text)}"
    if module_name not in sys.modules:
        module = ModuleType(module_name)
        module.__file__ = f"<{module_name}>"
        lines = text.splitlines(keepends=True)
        linecache.cache[module.__file__] = len(text), None, lines, module.__file__
        exec(compile(text, module.__file__, "exec"), vars(module))
        sys.modules[module_name] = module
    return sys.modules[module_name]
