"""The reasons given where no contact state fits are those of the structure's own contacts."""

from __future__ import annotations

import pytest

import rockeom as rk
from rockeom.contract import AMBIGUOUS, IMPOSSIBLE
from rockeom.numeric import contact_states

SIZES = {"half_width": 0.5, "half_height": 1.0}
STACK = rk.StackedBlocks(lower=rk.RigidBlock(**SIZES), upper=rk.RigidBlock(**SIZES))
BLOCK = rk.SlidingBlock(**SIZES, friction=1.5, restitution=0.0)


@pytest.mark.parametrize(("follows", "many"), [(IMPOSSIBLE, "no"), (AMBIGUOUS, "more than one")])
def test_contacts_that_never_slip_are_not_blamed_for_their_friction(monkeypatch, follows, many):
    search = {"fits_by_forces": lambda *_: follows}
    monkeypatch.setattr(contact_states, "_searching", lambda _: search)
    with pytest.raises(ValueError, match="its contacts never slip") as told:
        contact_states.by_forces(STACK.module, 0, None, None, (0.0, 0.0))
    assert str(told.value).startswith(f"{many} contact state of stacked_blocks fits")
    assert "less friction" not in str(told.value)
    with pytest.raises(ValueError, match=r"Painleve.: give less friction"):
        contact_states.by_forces(BLOCK.module, 0, None, None, (0.0, 0.0))


def test_a_jammed_block_is_refused_by_its_friction():
    with pytest.raises(ValueError, match="no contact state of sliding_block fits the forces"):
        BLOCK.accelerations({"x_dot": 0.2})


def test_the_outcome_speaks_of_both_kinds_of_contacts():
    sentence = rk.Outcome.NO_SOLUTION.sentence
    assert "so much friction" not in sentence
    assert "never slip" in sentence
    assert "Painleve" in sentence
