"""Attributes that a structure or the package lacks: the error offers the one that was meant."""

import copy
import operator
import pickle

import pytest

import rockeom as rk
import rockeom.symbolic
from rockeom.structures.parameters import SYNONYMS
from tests.typical import column

BLOCK = rk.RigidBlock(half_width=0.2, half_height=1.0)


@pytest.mark.parametrize(
    ("owner", "name", "meant"),
    [
        (BLOCK, "m", "mass"),
        (BLOCK, "width", "2 * half_width"),
        (BLOCK, "half_heigth", "half_height"),
        (BLOCK, "uplift_accelaration", "uplift_acceleration"),
        (rk, "Rigidblock", "RigidBlock"),
        (rk, "simulte", "simulate"),
        (rk, "Block", "RigidBlock"),
    ],
)
def test_unknown_attribute_offers_the_one_that_was_meant(owner, name, meant):
    assert not hasattr(owner, name)
    with pytest.raises(AttributeError) as caught:
        getattr(owner, name)
    assert f"has no attribute {name!r} (did you mean {meant}?)" in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))  # as a pool of processes hands it on
    assert type(again) is AttributeError
    assert str(again) == str(caught.value)


def test_symbol_of_which_the_structure_has_nothing_is_not_offered():
    block = rk.NondimensionalBlock(alpha=0.2)
    for name in ("k", "mu", "xyzzy"):
        with pytest.raises(AttributeError) as caught:
            getattr(block, name)
        assert "did you mean" not in str(caught.value)


def test_every_synonym_leads_somewhere():
    sliding = rk.SlidingBlock(half_width=0.2, half_height=1.0, friction=0.5, restitution=0.0)
    offset = rk.OffsetBlock(half_width=0.2, half_height=1.0, offset=0.05)
    known = {*dir(sliding), *dir(column()), *dir(offset)}
    assert {meant.split(" ")[-1] for meant in SYNONYMS.values()} <= known
    for meant in rk._SYNONYMS.values():
        operator.attrgetter(meant.removeprefix("rockeom."))(rk)
    assert not set(rk._SYNONYMS) & set(dir(rk))


def test_probing_for_attributes_searches_nothing(monkeypatch):
    """`hasattr`, copies, pickles and notebooks ask for names that are not there all the time."""

    def searched(*_):
        raise AssertionError("a name was searched")

    monkeypatch.setattr("rockeom.numbers.explained.near", searched)
    for owner in (BLOCK, rk):
        for name in ("m", "_repr_png_", "_ipython_canary_method_should_not_exist_", "__array__"):
            assert not hasattr(owner, name)
    assert copy.deepcopy(BLOCK) == copy.copy(BLOCK) == pickle.loads(pickle.dumps(BLOCK)) == BLOCK


def test_a_property_that_fails_says_why_itself():
    class Broken(rk.RigidBlock):
        @property
        def answer(self):
            return self.vector.nonsense

    with pytest.raises(AttributeError, match="object has no attribute 'nonsense'"):
        _ = Broken(half_width=0.2, half_height=1.0).answer
