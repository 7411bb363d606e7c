"""Answers to exercises: right within rounding, near misses by name, solutions never shown."""

import math

import numpy as np
import pytest
import sympy as sp

from rockeom.teaching import Exercises

alpha = sp.Symbol("alpha", positive=True)
exercises = Exercises({1: 4, 2: 0.45678, 3: sp.cos(2 * alpha), 4: 0.81})


@pytest.mark.parametrize(
    ("number", "answer", "words"),
    [
        (1, 4, "4 is right."),
        (1, ..., "in place of the dots"),
        (1, 3, "not right yet"),
        (1, "four", "neither a number"),
        (2, 0.457, "is right."),
        (2, np.float32(0.457), "is right."),
        (2, -0.457, "other sign"),
        (2, math.degrees(0.457), "in degrees"),
        (2, 1 / 0.457, "reciprocal"),
        (3, sp.cos(alpha) ** 2 - sp.sin(alpha) ** 2, "is right."),
        (3, sp.cos(alpha), "not right yet"),
        (4, 0.9, "square root of the solution: energies"),
        (4, 0.656, "square of the solution: energies"),
    ],
)
def test_an_answer_is_judged_and_the_solution_not_shown(number, answer, words, capsys):
    exercises.check(number, answer)
    said = capsys.readouterr().out
    assert said.startswith(f"Exercise {number}: ")
    assert words in said
    assert "0.45678" not in said


def test_an_exercise_without_an_answer_is_named():
    with pytest.raises(ValueError, match="exercise 7 has no answer to check; there are 1, 2, 3, 4"):
        exercises.check(7, 1.0)
