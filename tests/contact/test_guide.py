"""The structure on feet and a pad that the guide declares."""

from __future__ import annotations

import re
from pathlib import Path

from rockeom.codegen import module_text

GUIDE = Path(__file__).resolve().parents[2] / "docs" / "how-to" / "your-own-structure.md"


def test_the_structure_of_the_guide_is_declared_and_derived():
    text = GUIDE.read_text(encoding="utf-8").partition("## Feet that slide")[2]
    block = re.search(r"```python\n(.*?)```", text, re.DOTALL)[1]
    there: dict = {}
    exec(compile(block, str(GUIDE), "exec"), there)
    names = there["padded"].modes.names
    assert {"both_pad", "both_slides_right_pad", "right", "pad", "flight"} <= {*names}
    assert "def rates(contact, y, p, ax, ay, dy):" in module_text(there["padded"])
