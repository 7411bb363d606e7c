"""README.md and the pages, their code as it is run, and the structures that a guide declares."""

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]


def text_of(path: str) -> str:
    """The text of a page of the repository."""
    return (ROOT / path).read_text(encoding="utf-8")


README = text_of("README.md")
GUIDE = text_of("docs/how-to/your-own-structure.md")


def blocks(language: str, text: str = README) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)


def cells(text: str) -> list[str]:
    """The code of a page that the build runs."""
    return blocks(r"\{code-cell\} ipython3", text)


def names_of(scripts: Iterable[str]) -> dict[str, Any]:
    """The names that scripts leave, run in their order."""
    names: dict[str, Any] = {}
    for script in scripts:
        exec(compile(script, "page", "exec"), names)
    return names


def declaration() -> str:
    """The text that declares a model by the name two_storey."""
    (block,) = (block for block in blocks("python", GUIDE) if "two_storey = " in block)
    return block


def two_storey():
    """The model that the guide declares."""
    return names_of([declaration()])["two_storey"]
