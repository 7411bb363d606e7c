"""How a motion ended: one word for a single motion, for sweeps, in files and in compiled code."""

import copy
import json
import pickle

import numpy as np
import pytest

import rockeom as rk
from rockeom import codes

BLOCK = rk.RigidBlock(half_width=0.2, half_height=1.0)
SHAKEN = {"completed": 2.4, "overturned": 9.0}
"""Amplitudes of a pulse of one second [m/s2], by the outcome within two seconds."""


def _run(amplitude, **options):
    return rk.simulate(BLOCK, rk.GroundMotion.single_sine(amplitude, 1.0), duration=2.0, **options)


@pytest.mark.parametrize("word", SHAKEN)
def test_the_outcome_of_one_motion_compares_with_words_as_that_of_a_sweep_does(word):
    run = _run(SHAKEN[word])
    swept = rk.simulate_many(
        lambda a: rk.Case(BLOCK, rk.GroundMotion.single_sine(a, 1.0), duration=2.0),
        over={"a": [SHAKEN[word]]},
    )
    assert run.outcome == word == swept.outcome.item()
    assert (swept.outcome == run.outcome).all()
    assert (run.outcome == "overturned") == bool(run.overturned)


def test_each_outcome_is_its_word_in_every_use():
    for number, outcome in enumerate(rk.Outcome):
        word = codes.OUTCOMES[number]
        assert getattr(codes, outcome.name) == number
        assert outcome == word
        assert word == outcome
        assert hash(outcome) == hash(word)
        assert {outcome: 1}[word] == {word: 1}[outcome] == 1
        assert (str(outcome), f"{outcome}", f"{outcome:>20}") == (word, word, word.rjust(20))
        assert repr(outcome) == f"<Outcome.{outcome.name}: {word!r}>"
        assert rk.Outcome(word) is outcome is rk.Outcome[outcome.name]
        assert pickle.loads(pickle.dumps(outcome)) is outcome is copy.deepcopy(outcome)
        assert json.loads(json.dumps(outcome)) == np.array([outcome]).item() == word
        assert outcome.sentence.endswith(".")
        assert outcome.sentence != word
    assert len({outcome.sentence for outcome in rk.Outcome}) == len(codes.OUTCOMES)


def test_a_word_that_is_no_outcome_equals_none():
    assert "fell over" not in list(rk.Outcome)
    with pytest.raises(ValueError, match="fell over"):
        rk.Outcome("fell over")


def test_a_file_holds_the_word_and_gives_the_outcome_back(tmp_path):
    run = rk.simulate(BLOCK, rk.GroundMotion.none(1.0))
    run.save(tmp_path / "run.nc")
    assert rk.load(tmp_path / "run.nc").outcome is run.outcome is rk.Outcome.CAME_TO_REST
    assert type(run.to_xarray().attrs["outcome"]) is str
