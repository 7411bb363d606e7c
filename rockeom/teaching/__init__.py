"""Answers to the exercises of a notebook: checked by their solutions, which stay closed."""

import math
from collections.abc import Mapping
from numbers import Real
from types import EllipsisType
from typing import Any

import sympy as sp

WITHIN = 0.01
"""Relative error within which a number is right: answers are rounded."""


class Exercises:
    """Solutions of the exercises of a notebook, by the number of the exercise.

    solutions : each a number, which an answer must meet within 1 %; or a SymPy expression, which
        it must equal whatever its symbols are.

        exercises = Exercises({1: 4, 2: 0.457})
        exercises.check(2, 0.46)  # prints "Exercise 2: 0.46 is right."

    Raises ValueError for the number of an exercise that has no solution here.
    """

    def __init__(self, solutions: Mapping[int, Any]) -> None:
        self._solutions = {number: sp.sympify(s) for number, s in solutions.items()}

    def check(self, number: int, answer: float | sp.Expr | EllipsisType = ...) -> None:
        """Print whether an answer is right; the dots are none."""
        if number not in self._solutions:
            numbers = ", ".join(map(str, self._solutions))
            raise ValueError(f"exercise {number} has no answer to check; there are {numbers}")
        print(f"Exercise {number}: {_verdict(answer, self._solutions[number])}")


def _verdict(answer: float | sp.Expr | EllipsisType, solution: sp.Expr) -> str:
    if answer is ...:
        return "write your answer in place of the dots."
    if not isinstance(answer, Real | sp.Expr):
        return f"{answer!r} is neither a number nor an expression of SymPy."
    if _equal(sp.sympify(answer), solution):
        return f"{answer} is right."
    near = {
        "It has the other sign": -solution,
        "It is in degrees, the solution in radians": solution * 180 / sp.pi,
        "It is the square of the solution: energies, or velocities?": solution**2,
        "It is the square root of the solution: energies, or velocities?": sp.sqrt(solution),
        "It is the reciprocal of the solution": 1 / solution if solution != 0 else sp.nan,
    }
    for remark, other in near.items():
        if other != solution and _equal(sp.sympify(answer), other):
            return f"{answer} is not right. {remark.rstrip('.')}."
    return f"{answer} is not right yet; the hint may help."


def _equal(answer: sp.Expr, solution: sp.Expr) -> bool:
    if answer.is_number and solution.is_number:
        here, there = complex(answer), complex(solution)
        return math.isclose(abs(here - there), 0.0, abs_tol=WITHIN * abs(there))
    return bool(sp.simplify(answer - solution) == 0)
