"""The structure on feet and a pad that the guide declares."""

from __future__ import annotations

import re
from pathlib import Path

GUIDE = Path(__file__).resolve().parents[2] / "docs" / "how-to" / "your-own-structure.md"


def test_the_structure_of_the_guide_is_declared_and_derived():
    text = GUIDE.read_text(encoding="utf-8").partition("## Feet that slide, bounce")[2]
    block = re.search(r"```python\n(.*?)```", text, re.DOTALL)[1]
    there: dict = {}
    exec(compile(block, str(GUIDE), "exec"), there)
    names = there["padded"].modes.names
    assert {"both_pad", "both_slides_right_pad", "right", "pad", "flight"} <= {*names}
    normal, friction = there["padded"].mode("right").forces
    assert len(normal) == len(friction) == 1


def test_the_block_with_bars_of_the_guide_is_its_block_that_slides_with_bars():
    """Declared as it is written there, behind the block that slides; each bar has three states."""
    text = GUIDE.read_text(encoding="utf-8")
    there: dict = {}
    for heading in (
        "## A block on feet that slide",
        "## Forces with a memory",
        "## Bars and tendons that yield",
    ):
        block = re.search(r"```python\n(.*?)```", text.partition(heading)[2], re.DOTALL)[1]
        exec(compile(block, heading, "exec"), there)
    barred, bare = there["barred"].modes.names, there["lopsided"].modes.names
    assert len(barred) == 9 * len(bare)
    assert {"right_bar_left_yields", "right_bar_both_yields_back", *bare} <= {*barred}
