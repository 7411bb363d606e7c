"""The examples of README.md."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", TEXT, flags=re.MULTILINE | re.DOTALL)


def declaration() -> str:
    """The text that declares a model by the name two_storey."""
    (found,) = (block for block in blocks("python") if "two_storey = " in block)
    return found


def two_storey():
    """The model that the README declares."""
    names: dict = {}
    exec(declaration(), names)
    return names["two_storey"]
