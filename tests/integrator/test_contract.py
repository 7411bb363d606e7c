"""The names that texts of programs take from one another are there, each with one home."""

import ast
import importlib
import io
import os
import subprocess
import sys
import tokenize
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

import rockeom as rk
from rockeom import codes
from rockeom.compiler.frontend import _BUILT_IN
from rockeom.compiler.modules import Modules, Refused, Text, parsed
from rockeom.compiler.printer import Program
from rockeom.integrator.linking import GLUE, LOOP, TANGENTS, linked
from rockeom.integrator.schema import PROVIDED

FOLDER = Path(rk.__file__).parent / "integrator"
TEXTS = {
    f"rockeom.integrator.{'.'.join(file.relative_to(FOLDER).with_suffix('').parts)}": file
    for file in sorted(FOLDER.rglob("*.py"))
}
TREES = {module: ast.parse(file.read_text()) for module, file in TEXTS.items()}
DECLARED = parsed(TEXTS[PROVIDED].read_text(), "provided.py").functions
TABLES = {node.target.id for node in TREES[PROVIDED].body if isinstance(node, ast.AnnAssign)}
PYTHON = {
    f"rockeom.integrator.{name}"
    for name in (
        "linking", "printing", "program", "schema", "texts", "methods.tableau", "methods.radau",
        "lanes.step",
    )
}  # fmt: skip
"""Modules that Python runs, to write texts and to link them."""
OF_PRINTER = {"value", "moving", "rate"}
"""Functions that numbers with derivatives are asked by; the printer has them."""


def imported(module: str) -> dict[str, str]:
    """Names that a module of the integrator imports from others, with these."""
    return {
        alias.name: str(node.module)
        for node in TREES[module].body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def test_every_provided_name_is_declared_and_every_declared_one_is_imported():
    wanted = {
        name for module in TREES for name, home in imported(module).items() if home == PROVIDED
    }
    of_pages = {"energies", "positions", "powers", "shapes", "statics", "elements"}
    assert wanted <= DECLARED.keys() | TABLES
    of_steps = {"EQUATIONS", "accelerations"}
    assert (DECLARED.keys() | TABLES) - wanted <= of_pages | of_steps


def test_every_name_that_is_imported_has_its_home_in_a_file_that_can_be_opened():
    for module in TREES:
        for name, home in imported(module).items():
            if home in TREES and home != PROVIDED:
                parts = parsed(TEXTS[home].read_text(), home)
                assert name in parts.functions or name in parts.constants, (module, name, home)
    assert not [*FOLDER.rglob("*.pyi")]
    assert not [file for file in TEXTS.values() if "if TYPE_CHECKING:\n    from rockeom.integrator"
                in file.read_text()]  # fmt: skip


@pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])
@pytest.mark.parametrize("name", rk.models())
def test_texts_define_what_is_declared_as_it_is_declared(name, method):
    generated = importlib.import_module(f"rockeom.generated.{name}")
    in_lanes = method != "Radau" and not getattr(generated, "N_POINTS", 0)
    for part in (LOOP, TANGENTS, *([GLUE] if in_lanes else [])):
        assert_as_declared(generated, method, part)


def assert_as_declared(generated, method, part):
    defined = defaultdict(list)
    for text in linked(generated, method, part).modules.provided[PROVIDED]:
        for function, tree in parsed(text.source, text.name).functions.items():
            defined[function].append([a.arg for a in tree.args.args])
    for function in defined.keys() & DECLARED.keys():
        (names,), declared = defined[function], DECLARED[function].args
        known = [a.arg for a in declared.args]
        if declared.vararg is not None:
            known += ["ax", "ay"]
            names = names[: len(known)]
        assert names == known, function
    assert {"rates", "guards", "take_step", "dense_output", "transition"} <= defined.keys()


def test_printer_defines_what_numbers_with_derivatives_are_asked_by():
    assert _BUILT_IN.keys() & DECLARED.keys() >= OF_PRINTER


def test_every_constant_and_function_of_the_integrator_has_one_home():
    homes = defaultdict(set)
    alternatives = "table", "search", "landings", "newton", "impacts", "radau_step"
    alternatives += "modes_by_code", "points_in_plane", "points_in_space"
    for module, file in TEXTS.items():
        if module in PYTHON or module == PROVIDED or module.endswith(alternatives):
            continue
        parts = parsed(file.read_text(), module)
        for name in {**parts.functions, **parts.constants}:
            homes[name].add(module)
    twice = {name: modules for name, modules in homes.items() if len(modules) > 1}
    assert not {name for name in twice if not name.startswith("__")}


def test_powers_of_ten_stand_among_the_tolerances_or_the_coefficients():
    of_series = {"3.1415926534682512", "1.2154201013012384e-10"}  # pi in parts, of the sine
    for module, file in TEXTS.items():
        if module.endswith(("tolerances", "coefficients", "tableau")):
            continue
        tokens = tokenize.generate_tokens(io.StringIO(file.read_text()).readline)
        numbers = {token.string for token in tokens if token.type == tokenize.NUMBER}
        assert not {number for number in numbers - of_series if "e" in number}, module


def test_a_name_with_two_homes_is_refused_with_both():
    texts = {
        "rockeom.one": Text("one.py", "def f(x):\n    return x\n", alone=True),
        "rockeom.two": Text("two.py", "\nf = 1\n", alone=True),
    }
    root = Text("root", "from rockeom.one import f\nfrom rockeom.two import g\n")
    with pytest.raises(Refused, match=r"f has two homes in one program: one.py, line 1, and two"):
        Program([root], Modules({}, texts.__getitem__))


def test_what_is_absent_is_an_error_where_it_is_used():
    head = (
        "from rockeom.provided import N, f\nfrom rockeom.compiler.decorators import entry\nM = N\n"
    )
    use = "@entry\ndef g(x: float) -> float:\n    return {}\n"
    nothing = Modules({"rockeom.provided": ()})
    assert Program([Text("text", head + use.format("x"))], nothing).entries.keys() == {"g"}
    for used in ("f(x)", "x + M"):
        with pytest.raises(Refused, match="text, line 6, in g"):
            Program([Text("text", head + use.format(used))], nothing)


def test_texts_become_machine_code_without_being_imported(tmp_path):
    """And nothing that Python imports asks for what is provided."""
    code = """
import sys, pkgutil, importlib
import rockeom as rk
rk.simulate(rk.RigidBlock(half_width=0.3, half_height=1.0), rk.GroundMotion.single_sine(5.0, 0.5))
for package in ("structures", "simulation", "sweeps", "browser", "exports", "codegen"):
    for module in pkgutil.iter_modules(importlib.import_module(f"rockeom.{package}").__path__):
        if module.name not in ("balance", "forces", "questions", "space", "verdict"):  # of pages
            importlib.import_module(f"rockeom.{package}.{module.name}")
own = {m for m in sys.modules if m.startswith("rockeom.integrator.")}
print(*sorted(m.removeprefix("rockeom.integrator.") for m in own))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True,
        env=os.environ | {"ROCKEOM_CACHE_DIR": str(tmp_path)},
    )  # fmt: skip
    assert done.stdout.split() == [
        "linking", "methods", "methods.coefficients", "methods.tableau", "printing", "program",
        "records", "schema", "texts", "transitions", "transitions.restitution",
    ]  # fmt: skip


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
