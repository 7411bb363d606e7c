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

KINDS = dict.fromkeys(("energy_ratio", "impact"), (Kind.RESTITUTION,))
KINDS |= dict.fromkeys(("horizontal_reaction", "vertical_reaction"), (Kind.CLOSED_FORM,))


@pytest.mark.parametrize(("name", "of", "number"), NUMBERED)
def test_a_check_of_the_catalogue_decides_the_equation_from_that_structure(name, of, number):
    equation, checks = EQUATIONS[number], CHECKS[number]
    assert equation.kind in KINDS.get(of, (Kind.MOTION, Kind.APPROXIMATION))
    assert claim(equation).passes
    routes = [check.route for check in (checks if isinstance(checks, tuple) else (checks,))]
    assert any(re.search(rf"\b{name}\b", route) for route in routes)
    if name == MODEL_C:  # whose equations are two
        row = [c.name for c in derive(name).coordinates].index(of)
        stated = DERIVED[number].value(derive(name), 1)
        assert sp.expand(stated - residual(derive(name), 1, row)) == 0
