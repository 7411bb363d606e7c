"""The notebooks of derivations/: each runs, its assertions hold, and Jupyter can open it."""

import ast
import functools
import gc
import re
import runpy
import sys
from pathlib import Path

import jupytext
import matplotlib as mpl
import matplotlib.pyplot as plt
import nbformat
import pytest

from tests.test_words import WORDS, prose, uses

FOLDER = Path(__file__).parents[2] / "derivations"
NOTEBOOKS = pytest.mark.parametrize("path", sorted(FOLDER.glob("*.py")), ids=lambda path: path.stem)

read = functools.cache(jupytext.read)  # tests do not change it


def test_there_are_notebooks():
    assert FOLDER.is_dir()
    assert list(FOLDER.glob("*.py"))


@NOTEBOOKS
@pytest.mark.filterwarnings("error::RuntimeWarning")  # a nan drawn or compared by oversight
def test_runs_and_draws(path, monkeypatch, capsys):
    shown = []

    def show(*args, **kwargs):
        for number in plt.get_fignums():
            figure = plt.figure(number)
            figure.canvas.draw()
            shown.append(figure)
        plt.close("all")

    monkeypatch.setattr(plt, "show", show)
    monkeypatch.chdir(FOLDER)
    backend = mpl.get_backend()
    plt.switch_backend("Agg")
    try:
        with mpl.rc_context():
            runpy.run_path(str(path))
            assert not plt.get_fignums(), "a figure is drawn and not shown"
    finally:
        plt.close("all")
        plt.switch_backend(backend)
    assert shown
    assert all(figure.axes for figure in shown)
    shown.clear()
    gc.collect()  # a notebook's figures and what it simulated hold one another: 10 to 20 MB each
    gc.freeze()  # what SymPy remembers need not be looked through after the next one


@NOTEBOOKS
def test_jupyter_can_open_it(path):
    notebook = read(path)
    nbformat.validate(notebook)
    kinds = {cell.cell_type for cell in notebook.cells}
    assert kinds == {"markdown", "code"}
    assert notebook.metadata.kernelspec.language == "python"
    assert jupytext.writes(notebook, fmt="py:percent").endswith(
        path.read_text().split("\n\n", 1)[1]
    )


@NOTEBOOKS
def test_teaches(path):
    """A title, aims, exercises with hints, captions, and a check of its own."""
    notebook = read(path)
    prose = [cell.source for cell in notebook.cells if cell.cell_type == "markdown"]
    headings = re.findall(r"^(#+ .+)$", "\n".join(prose), re.MULTILINE)
    assert headings[0].startswith("# ")
    assert sum(heading.startswith("# ") for heading in headings) == 1
    assert headings[1] == "## Aims"
    assert headings[-1] == "## Exercises"
    exercises = "\n".join(prose).split("## Exercises")[1]
    assert len(re.findall(r"^\d+\. ", exercises, re.MULTILINE)) >= 3
    assert exercises.count("*Hint:") >= 3

    code = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "code")
    tree = list(ast.walk(ast.parse(code)))
    assert any(isinstance(node, ast.Assert) for node in tree)
    figures = sum(isinstance(n, ast.Attribute) and n.attr == "show" for n in tree)
    captions = re.findall(r"^\*Figure (\d+)\.", "\n".join(prose), re.MULTILINE)
    assert captions == [str(n + 1) for n in range(figures)]


LEVELS = ("first course", "graduate", "research")


@NOTEBOOKS
def test_header_says_for_whom_and_how_long_it_is(path):
    """The list of notebooks is made of it; but for it, all headers are the same."""
    told = read(path).metadata["rockeom"]
    assert set(told) == {"figure", "level", "minutes"}
    assert told["level"] in LEVELS
    assert 10 <= told["minutes"] <= 120
    assert f"*Figure {told['figure']}." in path.read_text()
    header = path.read_text().split("\n\n", 1)[0]
    assert re.sub(r"(figure|level|minutes): .*", r"\1:", header) == HEADER


HEADER = """\
# ---
# jupyter:
#   jupytext:
#     notebook_metadata_filter: rockeom
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
#   rockeom:
#     figure:
#     level:
#     minutes:
# ---"""


@NOTEBOOKS
def test_every_exercise_has_a_solution_that_is_closed_and_checked(path):
    notebook = read(path)
    cells = notebook.cells
    (last,) = (n for n, cell in enumerate(cells) if "## Exercises" in cell.source)
    exercises = re.findall(r"^(\d+)\. ", cells[last].source.split("## Exercises")[1], re.MULTILINE)
    solutions, checks, *answers = cells[last + 1 :]
    closed = r"<details><summary>Solution (\d+)</summary>\n\n(?:(?!<).+\n|\n)+</details>"
    assert re.findall(closed, solutions.source) == exercises
    assert checks.metadata["tags"] == ["hide-cell"]
    assert checks.source.startswith("# the solutions, checked\n")
    asserted = [n for n in ast.walk(ast.parse(checks.source)) if isinstance(n, ast.Assert)]
    assert len(asserted) >= len(exercises)
    for cell in answers:  # of the student, by the number of the exercise
        first, *rest = cell.source.splitlines()
        numbers = [re.match(r"exercises\.check\((\d+), \.\.\.\)  # \S", line)[1] for line in rest]
        assert first == "# your answers"
        assert numbers == sorted(set(numbers) & set(exercises))
    assert len(answers) == ("Exercises(" in checks.source)


@NOTEBOOKS
def test_code_that_only_draws_or_checks_solutions_is_collapsed_in_pages_and_in_jupyterlab(path):
    for cell in read(path).cells:
        if cell.cell_type != "code":
            continue
        tree = list(ast.walk(ast.parse(cell.source)))
        names = {node.id for node in tree if isinstance(node, ast.Name)}
        asserts = any(isinstance(node, ast.Assert) for node in tree)
        only_draws = ".show()" in cell.source and not asserts and not names & {"rk", "analysis"}
        collapsed = bool({"hide-input", "hide-cell"} & set(cell.metadata.get("tags", ())))
        assert collapsed or not only_draws, cell.source
        assert collapsed == cell.metadata.get("jupyter", {}).get("source_hidden", False)


@NOTEBOOKS
def test_needs_no_package_besides_those_that_rockeom_needs(path):
    code = "\n".join(cell.source for cell in read(path).cells if cell.cell_type == "code")
    tree = list(ast.walk(ast.parse(code)))
    imported = {name.name for node in tree if isinstance(node, ast.Import) for name in node.names}
    imported |= {node.module for node in tree if isinstance(node, ast.ImportFrom)}
    needed = {"matplotlib", "numpy", "rockeom", "scipy", "sympy", *sys.stdlib_module_names}
    assert {name.split(".")[0] for name in imported} <= needed


MEANT = ("What", "Of(", r"\A", "phase", "passage")
"""Parts of banned phrases that a notebook may say: questions, phases of the shaking, passages
through upright."""


@NOTEBOOKS
def test_prose_says_it_in_the_words_of_the_field(path):
    cells = read(path).cells
    texts = [
        re.sub(r"\$[^$]*\$|`[^`]*`", "...", c.source) for c in cells if c.cell_type == "markdown"
    ]
    texts += [text for c in cells if c.cell_type == "code" for text in prose(c.source)]
    for banned in WORDS["prose"]:
        if not any(part in banned["phrase"] for part in MEANT):
            found = [use for text in texts for use in uses(banned, " ".join(text.split()))]
            assert not found, banned["say"]


@NOTEBOOKS
def test_numbered_equations_and_links(path):
    """Numbers rise from 1 without gaps, and every link leads to a notebook that exists."""
    notebook = read(path)
    prose = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    tags = re.findall(r"\\tag\{(\d+)\}", prose)
    assert tags == [str(n + 1) for n in range(len(tags))]
    assert prose.count("$$") % 2 == 0
    for target in re.findall(r"\]\(([^)#]+)\)", prose):
        assert target.startswith("http") or (FOLDER / target).exists(), target


@NOTEBOOKS
def test_no_line_of_a_formula_is_taken_for_an_item_of_a_list(path):
    """One that begins with a sign and a blank is one, and the formula is torn."""
    for cell in read(path).cells:
        before = ""
        for line in cell.source.splitlines() if cell.cell_type == "markdown" else ():
            item = re.match(r"\s*[-+*] ", line)
            assert not (item and before.count("$") % 2), line
            before += line
