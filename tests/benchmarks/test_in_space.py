"""The section on bodies in space of the page has what was measured, and operations are counted."""

import json

import pytest

from benchmarks import in_space, plane_by_numbers
from tests.pages import text_of

PAGE = text_of("docs/benchmarks.md")


def test_page_has_the_figures_that_are_kept():
    found = json.loads(in_space.STORED.read_text(encoding="utf-8"))
    assert in_space.written(in_space.whole(found), PAGE) == PAGE


def test_page_without_marks_is_refused():
    with pytest.raises(ValueError, match="no <!-- tables of space -->"):
        in_space.written("tables", "a page")


def test_counted_operations_are_those_of_the_text():
    """Those of the block that rocks on one foot, on the page of its structure."""
    line = next(
        line
        for line in text_of("generated/sliding_block.md").splitlines()
        if line.startswith("| where right sticks, or its mirror image")
    )
    expected = sum(map(int, line.strip("| ").split(" | ")[1:]))
    trial = plane_by_numbers.TRIALS[0]
    assert plane_by_numbers.operations(trial, trial.structure)["rates"] == expected


def test_block_on_numeric_modes_moves_as_in_the_plane():
    trial = plane_by_numbers.TRIALS[0]
    motion = 2.0 * trial.motion.trimmed(0.0, 15.0)
    runs = [
        in_space.rk.simulate(structure, motion)
        for structure in (trial.structure, plane_by_numbers.numeric(trial))
    ]
    flat, lifted = ([event.time for event in run.events] for run in runs)
    assert len(flat) > 10
    assert lifted == pytest.approx(flat, abs=1e-8)


def test_prism_of_other_programs_has_the_moments_of_ours():
    case, prism = in_space._shaken(1.0), in_space.PRISM
    assert [case.mass * each for each in case.moments] == pytest.approx(
        [prism.parameters()[f"inertia_{axis}"] for axis in ("xx", "yy", "zz")]
    )
    assert case.ground(in_space.np.array([2.0])).shape == (1, 3)
