"""Random prisms, statues and columns under three components, against the laws of mechanics."""

from dataclasses import replace

import numpy as np
import pytest

from tests.space.families import on_feet, wobbling
from tests.space.mechanics import violations
from tests.space.round_bodies import violations_wobbling


@pytest.mark.parametrize("seed", range(16))
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


def _faster(run, by):
    """The motion with all rates larger, between events and after them."""
    powers, states = run.record.powers.copy(), run.events.columns.states.copy()
    rates = np.s_[..., len(run.states) // 2 :]
    powers[rates] *= 1.0 + by
    states[:, 1][rates] *= 1.0 + by
    columns = run.events.columns._replace(states=states)
    return replace(run, record=replace(run.record, powers=powers)), replace(
        run, events=type(run.events)(run.structure, columns)
    )


@pytest.mark.parametrize("seed", [11, 15])
def test_laws_of_mechanics_notice_what_is_wrong_by_little(seed):
    run, friction, restitution = on_feet(seed, rubs=1.5, bounces=True)
    between, after = _faster(run, 1e-5)
    assert "energy" in " ".join(violations(between, friction, restitution))
    assert "impulses" in " ".join(violations(after, friction, restitution))
    assert "lacks" in " ".join(violations(run, 0.999 * friction, restitution))
    assert "leaves" in " ".join(violations(run, friction, restitution + 1e-3))
