"""What the figures of records find of the thesis's statements."""

import pytest

from rockeom.thesis.figures import FIGURES


@pytest.mark.parametrize(
    ("number", "verdicts"),
    [
        ("3-22", ["holds"]),  # the printed peaks lie on 3-17 and 3-18, by foot
        ("4-51", ["holds", "holds", "holds"]),  # the three regimes of the wall
        ("5-10", ["differs"]),  # on rubber the printed peaks decay hardly faster than on steel
        ("5-16", ["open", "holds"]),
    ],
)
def test_verdicts(number, verdicts):
    assert [one.verdict for one in FIGURES[number].drawn().statements] == verdicts
