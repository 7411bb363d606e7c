"""A declaration as a hash: what is derived from it is kept under it."""

import copy
import os
import subprocess
import sys
from pathlib import Path

import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import declaration_digest
from rockeom.compiler.sources import sources
from rockeom.generated import prelude
from rockeom.symbolic.structures.flexible import flexible_structure


def test_same_declaration_has_the_same_hash():
    assert declaration_digest(flexible_structure()) == declaration_digest(flexible_structure())


def changed(value, **fields):
    """A copy with other fields, whatever a check of the whole would say of it."""
    other = copy.copy(value)
    for name, field in fields.items():
        object.__setattr__(other, name, field)
    return other


def test_every_part_of_a_declaration_counts():
    """Expressions, what symbols are assumed to be, texts, the order, and what is left out."""
    model = flexible_structure()
    mode, parameter, transition = model.modes[0], model.parameters[0], model.transitions[0]
    of_any_sign = sp.Symbol(parameter.symbol.name)
    others = [
        changed(model, title="Another"),
        changed(model, reference="elsewhere"),
        changed(model, overturning=sp.pi / 3),
        changed(model, rigid_velocity_ratio=sp.Rational(1, 2)),
        changed(model, parameters=(changed(parameter, unit="t"), *model.parameters[1:])),
        changed(model, parameters=(changed(parameter, symbol=of_any_sign), *model.parameters[1:])),
        changed(model, parameters=model.parameters[::-1]),
        changed(model, modes=(changed(mode, gravity=2 * mode.gravity), *model.modes[1:])),
        changed(model, modes=(changed(mode, small=(sp.Symbol("x"),)), *model.modes[1:])),
        changed(model, transitions=(changed(transition, kind="x"), *model.transitions[1:])),
        changed(model, transitions=model.transitions[:-1]),
    ]
    assert len({declaration_digest(other) for other in (model, *others)}) == 1 + len(others)


def test_functions_of_one_name_differ_by_what_is_assumed_of_them():
    model = rk.derive("controlled_wall")
    law = model.functions[0]
    (of,) = law.symbol.args
    other = changed(law, symbol=sp.Function(law.symbol.func.__name__, positive=True)(of))
    assert declaration_digest(changed(model, functions=(other, *model.functions[1:]))) != (
        declaration_digest(model)
    )


LOADED = """
import sys, rockeom, rockeom.numbers.explained  # these change no text
before = set(sys.modules)
import rockeom.codegen, rockeom.symbolic
for name in set(sys.modules) - before:
    if name.startswith("rockeom."):
        print(sys.modules[name].__file__)
"""


def test_every_file_that_derives_or_writes_counts():
    """Among them the numbers of guards and laws, which the text has from another package."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, "-c", LOADED], env=environment, capture_output=True, text=True, check=True
    )
    loaded = {Path(line) for line in done.stdout.splitlines()}
    assert {"codes.py", "lagrange.py", "declared.py"} <= {path.name for path in loaded}
    assert loaded | {Path(prelude.__file__)} <= set(sources())


def test_what_has_no_lasting_meaning_has_no_hash():
    with pytest.raises(TypeError, match="no text, number or expression"):
        declaration_digest(changed(flexible_structure(), title=object()))
