"""What the parts of a program ask of one another is there, under the name that is declared."""

import ast
import importlib
import inspect
from pathlib import Path

import numpy as np
import pytest

import rockeom as rk
from rockeom import codes
from rockeom.compiler.frontend import _BUILT_IN
from rockeom.integrator.program import JOINED, texts
from rockeom.integrator.schema import POINT_TEXTS
from rockeom.integrator.texts import text_of

DECLARED = ast.parse((Path(rk.__file__).parent / "integrator" / "interface.pyi").read_text())
FUNCTIONS = {
    node.name: [a.arg for a in node.args.args]
    for node in DECLARED.body
    if isinstance(node, ast.FunctionDef)
}
TABLES = {node.target.id for node in DECLARED.body if isinstance(node, ast.AnnAssign)}
OF_POINTS = {
    "N_ELEMENTS", "POINT_STATES", "ELEMENT_STATES", "SHARED", "SUBJECTS", "ANGLES", "free_motion",
    "points", "point_laws", "landed", "FEET_OF",
}  # fmt: skip
"""What only modules have whose modes are found; the loop asks no other for them."""
OF_LAWS = {"IMPACT_LAW", "point_numbers"}
"""What those of them have whose points have another impact law than Newton's."""
OF_TABLES = {"jump", "full_contact_guards"}
"""What they do not have, in turn."""
OF_FALLS = {"FALLS", "overturns_at"}
"""What only those have of which several coordinates may fall."""
TABLE, *SEARCH = (
    {
        node.name: [a.arg for a in node.args.args]
        for node in ast.parse(text_of(f"integrator/transitions/{name}.py")).body
        if isinstance(node, ast.FunctionDef)
    }
    for name in ("table", "search", "landings")
)
OF_CONTRACT = FUNCTIONS.keys() & TABLE.keys()
"""What the loop asks of transitions, whichever way they are found."""
OF_PRINTER = {"value", "moving", "rate"}
"""What numbers with derivatives are asked by."""


@pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])
@pytest.mark.parametrize("name", rk.models())
def test_generated_modules_and_steps_define_what_the_loop_asks_for(name, method):
    generated = importlib.import_module(f"rockeom.generated.{name}")
    lanes = method != "Radau"
    joined = {"__name__": "joined"}
    for text in texts(generated, method, lanes):
        if text.name not in JOINED or text.name in POINT_TEXTS:
            exec(compile(text.source, text.name, "exec"), joined)
    of_lanes = {f for f in FUNCTIONS if f.endswith("_lanes")}
    elsewhere = OF_PRINTER | OF_CONTRACT | (OF_TABLES if joined["N_POINTS"] else OF_POINTS)
    elsewhere |= OF_LAWS | (set() if joined["N_FALLS"] else OF_FALLS)
    for function in FUNCTIONS.keys() - elsewhere - (set() if lanes else of_lanes):
        assert [*inspect.signature(joined[function]).parameters] == FUNCTIONS[function]
    tables = {"LANES", "N_PARAMETERS", "PLACES", "STAGE_PLACES", "NODE_PLACES", "DAMPING"}
    tables.add("GAP_SIDES")
    tables = set() if lanes else tables
    contract = {"MOST_IDLE", "QUIET_STEPS", "EXTRAPOLATES", "Gap"}
    assert TABLES - elsewhere - contract - tables <= joined.keys()


def test_a_table_and_a_search_of_transitions_fulfil_one_contract():
    search = SEARCH[0] | SEARCH[1]
    assert len(OF_CONTRACT) == 15
    for function in OF_CONTRACT:
        assert TABLE[function] == search[function] == FUNCTIONS[function]


def test_printer_defines_what_numbers_with_derivatives_are_asked_by():
    for function in OF_PRINTER:
        assert function in _BUILT_IN


def test_every_name_that_is_declared_is_asked_for():
    asked = set()
    for name in (*JOINED, "browser/questions.py"):
        asked |= {n.id for n in ast.walk(ast.parse(text_of(name))) if isinstance(n, ast.Name)}
    assert FUNCTIONS.keys() | TABLES <= asked


def test_outcomes_are_numbered_as_the_loop_numbers_them():
    for number, outcome in enumerate(rk.Outcome):
        assert getattr(codes, outcome.name) == number
    assert len(rk.Outcome) == codes.FULL


def test_kinds_and_laws_are_those_of_the_generated_modules():
    for name in rk.models():
        m = importlib.import_module(f"rockeom.generated.{name}")
        assert (m.RATIO, m.IMPULSIVE) == (codes.RATIO, codes.IMPULSIVE)
        for mode, kinds in zip(m.MODES, m.KINDS, strict=True):
            leaving = [codes.KIND_OF[k] for source, _, k in m.TRANSITIONS if source == mode]
            assert [*kinds[: len(leaving)]] == leaving


def test_a_motion_begins_without_a_past():
    begins = codes.AT_THE_START
    assert begins[codes.CLOSED] == -1
    assert begins[codes.GUARD_DUE] == begins[codes.RATE_STALE] == 1
    assert np.count_nonzero(begins) == 3
    with pytest.raises(ValueError, match="read-only"):
        begins[0] = 1
