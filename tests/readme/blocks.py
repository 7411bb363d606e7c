"""The examples of README.md."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", TEXT, flags=re.MULTILINE | re.DOTALL)


def two_storey():
    """The model that the README declares."""
    (declaration,) = (block for block in blocks("python") if "two_storey = " in block)
    names: dict = {}
    exec(declaration, names)
    return names["two_storey"]
