"""The scripts with which a visitor begins: short, formatted, one statement a line."""

import ast
import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

from tests.pages import cells, text_of

SHORT, WITH_DECLARATION = 15, 40
SCRIPTS = {
    "rocking-isolation.md": SHORT,  # a student with a bridge pier
    "teaching-hour.md": SHORT,  # a teacher's hour
    "will-it-overturn.md": SHORT,  # a statue, a rack, a shelf, a case on an upper floor
    "fragility.md": WITH_DECLARATION,  # the fragility of a frame that is declared
    "your-own-structure.md": WITH_DECLARATION,
}
"""Pages, and how long a script may be. The build of the documentation runs them."""


CELLS = {name: cells(text_of(f"docs/how-to/{name}")) for name in SCRIPTS}
ALL = [(page, i) for page in SCRIPTS for i in range(len(CELLS[page]))]


@pytest.mark.parametrize(("page", "i"), ALL)
def test_script_is_short_with_one_statement_a_line(page, i):
    script = CELLS[page][i]
    assert len(script.splitlines()) <= SCRIPTS[page]
    bodies = (n.body for n in ast.walk(ast.parse(script)) if hasattr(n, "body"))
    for statements in (body for body in bodies if isinstance(body, list)):
        lines = [statement.lineno for statement in statements]
        assert len({*lines}) == len(lines)


@pytest.mark.parametrize("page", SCRIPTS)
def test_first_script_is_complete(page):
    assert CELLS[page][0].startswith("import rockeom as rk\n")


def test_scripts_are_formatted(tmp_path):
    if not importlib.util.find_spec("ruff"):
        pytest.skip("ruff is not installed: pip install -e '.[dev]'")
    for page, i in ALL:
        path = tmp_path / f"{Path(page).stem.replace('-', '_')}_{i}.py"
        path.write_text(CELLS[page][i], encoding="utf-8")
    ruff = sys.executable, "-m", "ruff", "format", "--line-length", "100", "--diff"
    done = subprocess.run([*ruff, str(tmp_path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
