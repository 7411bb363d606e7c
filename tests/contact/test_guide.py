"""The structure on feet and a pad that the guide declares."""

from tests.pages import GUIDE, blocks, names_of


def first_below(heading: str) -> str:
    """The first script below a heading."""
    return blocks("python", GUIDE.partition(heading)[2])[0]


def test_the_structure_of_the_guide_is_declared_and_derived():
    there = names_of([first_below("## Feet that slide, bounce")])
    names = there["padded"].modes.names
    assert {"both_pad", "both_slides_right_pad", "right", "pad", "flight"} <= {*names}
    normal, friction = there["padded"].mode("right").forces
    assert len(normal) == len(friction) == 1


def test_the_block_with_bars_of_the_guide_is_its_block_that_slides_with_bars():
    """Declared as it is written there, behind the block that slides; each bar has three states."""
    headings = (
        "## A block on feet that slide",
        "## Forces with a memory",
        "## Bars and tendons that yield",
    )
    there = names_of(map(first_below, headings))
    barred, bare = there["barred"].modes.names, there["lopsided"].modes.names
    assert len(barred) == 9 * len(bare)
    assert {"right_bar_left_yields", "right_bar_both_yields_back", *bare} <= {*barred}
