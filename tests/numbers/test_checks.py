"""One error of refused input, printed by each border in its own words."""

import argparse
import pickle
from types import SimpleNamespace

import numpy as np
import pytest

from rockeom.cli.errors import in_options
from rockeom.numbers.checks import InputError, InputTypeError, number, numbers, require
from tests.refusals import refused, refuses

PARSER = argparse.ArgumentParser()
for _flag in ("--record-length", "--pga", "--columns"):
    PARSER.add_argument(_flag)
TYPED = SimpleNamespace(parser=PARSER, set=["half_width=-1"])
MISSPELT = "Sliding: law is 'lbz' (did you mean lzb?): give one of lzb, newton"
WORDS = {
    "an option": (InputError("record_length", 0, "simulate").give("a positive number"),
        "simulate: record_length is 0: give a positive number",
        "--record-length is 0: give a positive number"),
    "another name": (InputError("time_column").wrong("is missing: name it by {time_column}"),
        "time_column is missing: name it by time_column=",
        "--columns is missing: name it by --columns"),
    "a parameter": (InputError("half_width", -1.0, "RigidBlock").give("a positive number"),
        "RigidBlock: half_width is -1: give a positive number",
        "--set half_width is -1: give a positive number"),
    "a value": (InputError("").says('it is still: give {pga:"0.4 g"}', "or scale the array"),
        'it is still: give pga="0.4 g"; or scale the array', "it is still: give --pga 0.4g"),
    "words": (InputError("law", "lbz", "Sliding").choose(["lzb", "newton"]), MISSPELT, MISSPELT),
    "a file": (InputError.at("r.txt", 3, "sample 8 is NaN", "see {columns} and {dt:0.01}"),
        "r.txt, line 3: sample 8 is NaN. Remedy: see columns= and dt=0.01.",
        "r.txt, line 3: sample 8 is NaN. Remedy: see --columns and dt=0.01."),
}  # fmt: skip


@pytest.mark.parametrize("name", WORDS)
def test_each_border_prints_the_fields_in_its_own_words(name):
    error, python, options = WORDS[name]
    assert (str(error), in_options(error, TYPED)) == (python, options)


def test_an_error_reaches_another_process_with_its_fields():
    """A value that cannot be sent goes as its words."""
    error = InputTypeError("motion", lambda t: t, "simulate").give("a ground motion")
    sent = pickle.loads(pickle.dumps(error))
    assert (str(sent), type(sent)) == (str(error), InputTypeError)
    assert (sent.argument, sent.bounds) == ("motion", "a ground motion")


def test_an_element_that_is_refused_is_named_by_its_place():
    assert refused(require, np.array([True, False]), "f", "x", [1.0, 2.0], "") == ("x[1]", 2.0)
    assert refused(numbers, "f", x=[[1.0, np.inf]]) == ("x[0, 1]", np.inf)
    with refuses("x", "1", kind=TypeError):
        number("x", "1")
