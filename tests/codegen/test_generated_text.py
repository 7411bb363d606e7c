"""The generated text itself: the same for everybody, self-contained, marked by its hash."""

import ast
import functools
import hashlib
import importlib
import inspect
import math
import operator
import os
import subprocess
import sys
from pathlib import Path
from typing import ClassVar

import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import check_generated, module_text, write_generated
from rockeom.codegen.names import WORDS, Names, is_own, names_in
from rockeom.codegen.operations import operations
from rockeom.codegen.printer import python
from rockeom.symbolic import SHIPPED
from tests.codegen.test_languages import STRAPPED
from tests.contact.declared import pulled_block
from tests.space.bodies import TRIPOD, model as on_feet
from tests.space.test_free_body import model as in_space, stone

STRUCTURES = pytest.mark.parametrize("name", rk.models())

WRITTEN = """
import sys, rockeom as rk
from rockeom.codegen import module_text
from rockeom.codegen.write import page_text
flexible = rk.derive("flexible_structure")
said = module_text(rk.derive("sliding_block")), page_text(flexible, module_text(flexible))
sys.stdout.buffer.write("\\f".join(said).encode())
"""


def text_of(name):
    """The module that simulations use."""
    return inspect.getsource(importlib.import_module(f"rockeom.generated.{name}"))


@STRUCTURES
def test_same_text_as_in_generated(name):
    """Each process has another hash seed, and with it another order of sets of symbols."""
    assert module_text(rk.derive(name)) == text_of(name)


def test_same_text_and_page_in_every_process():
    """One that has derived nothing else, and whose hash seed, the order of sets, is not drawn."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "PYTHONHASHSEED": "12345"}
    done = subprocess.run(
        [sys.executable, "-c", WRITTEN], env=environment, capture_output=True, check=True
    )
    text, page = done.stdout.decode().split("\f")
    assert text == text_of("sliding_block")
    module = importlib.import_module("rockeom.generated.flexible_structure")
    assert page == Path(module.__file__).with_suffix(".md").read_text(encoding="utf-8")


class Counted(float):
    """A number that counts its operations, in the order of the columns of a page."""

    counts: ClassVar[list[int]] = []


def counting(kind, operation):
    def counted(*numbers):
        Counted.counts[kind] += 1
        return Counted(operation(*map(float, numbers)))

    return counted


for kind, signs in enumerate((("add", "sub"), ("mul",), ("truediv",))):
    for sign in signs:
        whole = getattr(operator, sign)
        setattr(Counted, f"__{sign}__", counting(kind, whole))
        setattr(Counted, f"__r{sign}__", counting(kind, lambda a, b, of=whole: of(b, a)))
Counted.__pow__ = lambda x, n: functools.reduce(operator.mul, [x] * n)
Counted.__neg__ = lambda x: Counted(-float(x))


COUNTED = [
    ("rigid_block", "accelerations_left_right", "`left`, `right`"),
    ("flexible_structure", "accelerations_both", "`both`"),
    ("sliding_block", "rates_right_slips", "where right slips, or its mirror image"),
    ("stacked_blocks", "rates_right_sticks", "where right sticks, or its mirror image"),
]


@pytest.mark.parametrize(("name", "function", "where"), COUNTED)
def test_operations_of_a_page_are_those_that_numbers_count(name, function, where, monkeypatch):
    module = importlib.import_module(f"rockeom.generated.{name}")
    functions = [counting(3, math.sin), counting(3, math.cos)]
    monkeypatch.setattr(module, "sine_cosine", lambda x: tuple(f(x) for f in functions))
    called = getattr(module, function)
    monkeypatch.setattr(Counted, "counts", [0, 0, 0, 0])
    constants = [Counted(0.1 * i + 1) for i in range(200)]
    given = dict.fromkeys(inspect.signature(called).parameters, Counted(0.3)) | {"p": constants}
    called(**given)
    (row,) = (
        r for r in operations(rk.derive(name).hybrid, text_of(name))[-1].rows if where == r[0]
    )
    assert row[1:] == tuple(map(str, Counted.counts))


@STRUCTURES
def test_module_imports_only_math_numpy_marks_and_prelude(name):
    imported = set()
    for node in ast.walk(ast.parse(text_of(name))):
        if isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            imported.add(node.module)
    assert {"rockeom.compiler.decorators", "rockeom.generated.prelude"} <= imported
    assert imported <= {"math", "numpy", "rockeom.compiler.decorators", "rockeom.generated.prelude"}


def bound_in(text):
    """Names that a module binds for all of its functions."""
    bound = set()
    for statement in ast.parse(text).body:
        if isinstance(statement, ast.FunctionDef):
            bound.add(statement.name)
        elif not isinstance(statement, ast.Expr):  # a docstring
            bound |= names_in(ast.unparse(statement))
    return bound


@STRUCTURES
def test_all_that_a_module_binds_is_kept_from_users_names(name):
    """Its header and its sine and cosine, too, which stand outside the text that is checked."""
    modes = importlib.import_module(f"rockeom.generated.{name}").MODES
    numbers = {Names().of_mode(mode) for mode in modes}
    bound = bound_in(text_of(name))
    assert {"SOURCE_HASH", "RATIO", "N_FALLS", "inlined", "STATES", "rates"} <= bound
    assert [word for word in bound - numbers if not is_own(word)] == []


def test_no_name_is_kept_from_users_that_is_never_written():
    bouncing = rk.derive("sliding_block", law="moreau")
    on_three = on_feet("prism_on_3", tuple(TRIPOD.items()))
    declared = map(module_text, (pulled_block(), bouncing, in_space(stone()), on_three))
    texts = [*map(text_of, rk.models()), *declared, inspect.getsource(STRAPPED.module)]
    written = set().union(*map(names_in, texts))
    x = sp.Symbol("x")
    for declared in (sp.Min(x, 1), -sp.oo):
        written |= names_in(python(declared))
    assert sorted(WORDS - written) == ["__debug__"]  # to which Python assigns nothing


@STRUCTURES
def test_module_carries_the_hash_of_its_content_and_of_the_prelude(name):
    text = text_of(name)
    digest = importlib.import_module(f"rockeom.generated.{name}").SOURCE_HASH
    # what stands below the line of the hash
    body = text.partition(f'SOURCE_HASH = "{digest}"\n')[2]
    assert hashlib.sha256((text_of("prelude") + body).encode()).hexdigest().startswith(digest)
    assert len(digest) >= 16
    assert "do not edit" in ast.get_docstring(ast.parse(text))


def test_hand_edit_is_shown_and_mended(tmp_path, monkeypatch):
    # One structure is enough for the mechanism; `rockeom generate --check` compares all.
    some = {"nondimensional_block": SHIPPED["nondimensional_block"]}
    monkeypatch.setattr("rockeom.codegen.write.SHIPPED", some)
    folder = tmp_path / "generated"
    write_generated(folder)
    assert check_generated(folder) == ""

    edited = folder / "nondimensional_block.py"
    text = edited.read_text(encoding="utf-8")
    assert "ROTATION = 0\n" in text
    edited.write_text(text.replace("ROTATION = 0\n", "ROTATION = 1\n"), encoding="utf-8")
    (folder / "nondimensional_block.md").unlink()
    (folder / "forgotten.py").write_text("")

    diff = check_generated(folder)
    assert "-ROTATION = 1\n+ROTATION = 0\n" in diff
    assert "nondimensional_block.py" in diff
    assert "nondimensional_block.md" in diff
    assert "forgotten.py" in diff

    (folder / "forgotten.py").unlink()
    assert {path.name for path in write_generated(folder)} == {
        "nondimensional_block.py",
        "nondimensional_block.md",
    }
    assert check_generated(folder) == ""
