"""The examples of README.md, and the structures that a guide declares."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


GUIDE = (ROOT / "docs" / "how-to" / "your-own-structure.md").read_text(encoding="utf-8")


def blocks(language: str, text: str = TEXT) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)


def declaration() -> str:
    """The text that declares a model by the name two_storey."""
    (found,) = (block for block in blocks("python", GUIDE) if "two_storey = " in block)
    return found


def two_storey():
    """The model that the guide declares."""
    names: dict = {}
    exec(declaration(), names)
    return names["two_storey"]
