"""Sources of a generated module, besides its declaration: known without loading SymPy."""

import hashlib
from functools import cache
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def sources() -> list[Path]:
    """The files that derive and write, and those of the numbers that are written."""
    folders = (ROOT / "symbolic", ROOT / "codegen")
    files = sorted(f for folder in folders for f in folder.rglob("*.py"))
    compiler = (ROOT / "compiler" / f"{name}.py" for name in ("__init__", "sources", "types"))
    numbers = (ROOT / "numbers" / f"{name}.py" for name in ("breaks", "mode_codes"))
    parts = (ROOT / "generated" / f"{name}.py" for name in ("prelude", "numeric_modes"))
    return [ROOT / "codes.py", *numbers, *parts, *compiler, *files]


def digest(*parts: str) -> str:
    """Hash of what is declared, of SymPy and of the derivation."""
    whole = "\0".join([version("sympy"), _derivation(), *parts])
    return hashlib.sha256(whole.encode("utf-8", "surrogatepass")).hexdigest()[:20]


@cache
def _derivation() -> str:
    """Hash of the sources."""
    whole = hashlib.sha256()
    for file in sources():
        whole.update(file.relative_to(ROOT).as_posix().encode() + b"\0" + file.read_bytes())
    return whole.hexdigest()
