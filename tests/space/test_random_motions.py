"""Random prisms, statues and columns under three components, against the laws of mechanics."""

import pytest

from tests.space.families import on_feet, wobbling
from tests.space.mechanics import violations
from tests.space.round_bodies import violations_wobbling


# each body, on each kind of feet, from rest and pushed; `python -m tests.space.soak` has the others
@pytest.mark.parametrize("seed", [0, 1, 2, 3, 4, 8, 9, 11, 12])
def test_a_random_body_moves_by_the_laws_of_mechanics(seed):
    run, *laws = on_feet(seed)
    assert run.outcome.value in ("completed", "overturned", "came to rest")
    assert not list(violations(run, *laws))


@pytest.mark.parametrize("seed", range(12))
def test_a_random_column_wobbles_by_the_laws_of_mechanics(seed):
    """From rest or pushed; some in a plane, where rims strike."""
    run = wobbling(seed)
    assert run.outcome.value in ("completed", "overturned")
    assert not list(violations_wobbling(run))
