"""Write the generated modules, or compare them with what would be written."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from pathlib import Path

from rockeom.codegen.module import module_text
from rockeom.symbolic import SHIPPED

GENERATED = Path(__file__).resolve().parents[2] / "generated"
"""The folder of a checkout; an installed package holds the files in rockeom/generated."""


def expected_files() -> Iterator[tuple[str, str]]:
    """(file name, text) of all that stands in `generated/`: a module and a page a structure."""
    for name, build in SHIPPED.items():
        model = build()
        yield f"{name}.py", module_text(model)
        yield f"{name}.md", model.markdown()


def write_generated(folder: Path = GENERATED) -> list[Path]:
    """Write every generated file and return the paths of those that changed."""
    folder.mkdir(exist_ok=True)
    changed = []
    for name, text in expected_files():
        path = folder / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            changed.append(path)
    return changed


def check_generated(folder: Path = GENERATED) -> str:
    """The differences between `generated/` and what the derivation gives, as one diff.

    Empty if there are none. Files that nothing generates are differences too.
    """
    diffs: list[str] = []
    names = set()
    for name, text in expected_files():
        names.add(name)
        path = folder / name
        found = path.read_text(encoding="utf-8") if path.exists() else ""
        if found != text:
            diffs += difflib.unified_diff(
                found.splitlines(keepends=True),
                text.splitlines(keepends=True),
                f"generated/{name}",
                f"derived/{name}",
            )
    for path in sorted(folder.glob("*.*")):
        if path.suffix in {".py", ".md"} and path.name not in names:
            diffs.append(f"generated/{path.name}: nothing generates this file\n")
    return "".join(diffs)
