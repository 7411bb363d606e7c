"""Indices of whole programs: with every check on, motions, lanes and derivatives leave no array."""

from dataclasses import replace

import pytest

import rockeom as rk
from rockeom.compiler.machine import OutOfBoundsError
from rockeom.integrator import linking, program
from tests.soak import bounds

FAULT = "rockeom.integrator.transitions.points_in_plane"


@pytest.mark.parametrize("name", ["nondimensional_block", "stacked_blocks", "sliding_block"])
def test_no_index_leaves_its_array_in_motions_lanes_and_derivatives(name):
    with bounds.checked():
        assert bounds.searched([name], range(0, 4, 3)) == []


def test_a_planted_read_beyond_the_scratch_of_a_stack_is_found(monkeypatch):
    """The one that these programs once had: of a foot's friction, in the row behind the last."""
    right = linking.module_text(FAULT)
    wrong = replace(right, source=right.source.replace("row + friction[s]", "row + unknown[s] + 1"))
    assert wrong != right
    own = linking.module_text
    monkeypatch.setattr(linking, "module_text", lambda name: wrong if name == FAULT else own(name))
    program._of_parts.cache_clear()
    line = wrong.source[: wrong.source.index("row + unknown[s] + 1")].count("\n") + 1
    stack = rk.StackedBlocks(
        lower=rk.RigidBlock(half_width=0.5, half_height=1.0),
        upper=rk.RigidBlock(half_width=0.3, half_height=0.6),
    )
    motion = rk.GroundMotion.single_sine(5.0, 0.5)
    said = f"points_in_plane.py, line {line}: index 224 is out of bounds for an axis of size 224"
    try:
        with bounds.checked(), pytest.raises(OutOfBoundsError, match=said):
            rk.simulate(stack, motion)
    finally:
        program._of_parts.cache_clear()
