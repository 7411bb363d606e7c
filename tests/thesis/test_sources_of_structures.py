"""Numbers of the thesis beside the equations of shipped structures."""

import re

import pytest
import sympy as sp

from rockeom.symbolic import SHIPPED, derive
from rockeom.thesis import EQUATIONS
from rockeom.thesis.checks import CHECKS
from rockeom.thesis.checks.engine import DERIVED, MODEL_C, residual
from rockeom.thesis.equation import Kind
from rockeom.thesis.verification import claim

NUMBERED = [
    (name, of, number)
    for name in SHIPPED
    for of, source in derive(name).hybrid.sources.items()
    for number in source.removeprefix("thesis ").split(", ")
]

MOTION = (Kind.MOTION, Kind.APPROXIMATION)
KINDS = dict.fromkeys(("energy_ratio", "impact"), (Kind.RESTITUTION,))
KINDS |= dict.fromkeys(("horizontal_reaction", "vertical_reaction"), (Kind.CLOSED_FORM,))


@pytest.mark.parametrize(("name", "of", "number"), NUMBERED)
def test_a_check_of_the_catalogue_decides_the_equation_from_that_structure(name, of, number):
    equation, checks = EQUATIONS[number], CHECKS[number]
    assert equation.kind in KINDS.get(of, MOTION)
    assert claim(equation).passes
    routes = [check.route for check in (checks if isinstance(checks, tuple) else (checks,))]
    assert any(re.search(rf"\b{name}\b", route) for route in routes)


@pytest.mark.parametrize(("row", "of"), [(0, "theta"), (1, "u")])
def test_numbers_of_the_flexible_structure_stand_beside_their_coordinates(row, of):
    model = derive(MODEL_C)
    numbers = [n for name, at, n in NUMBERED if (name, at) == (MODEL_C, of)]
    assert len(numbers) == 2
    for number in numbers:
        assert sp.expand(DERIVED[number].value(model, 1) - residual(model, 1, row)) == 0
