"""`rockeom export`: files for C, MATLAB and OpenSees, and what is told where there is none."""

import ast
import importlib.util
import subprocess
import sys

import numpy as np
import pytest

import rockeom as rk
from benchmarks.crosscheck import FOLLOWED, SPRUNG, TILT, TIMES, rotations_of_ours
from benchmarks.engines.with_opensees import environment
from rockeom import __version__
from rockeom.cli import main
from rockeom.exports import code_of_model
from rockeom.exports.opensees import script
from tests.refusals import refused

MASSES = (
    "mass=122.6", "height=1.05", "inertia=44.8", "base_mass=45.6", "base_height=0.1",
    "base_inertia=1.37", "half_width=0.285",
)  # fmt: skip
ON_SPRINGS = ("--set", *MASSES, "foundation_stiffness=5e5", "foundation_damping=0")
FREE = ("--free", "--duration", "0.5")


def test_c_and_matlab_are_written_by_the_name_of_the_structure(tmp_path, capsys):
    for language, ending in (("c", "c"), ("matlab", "m")):
        assert main(["export", language, "rigid_block", "--out", str(tmp_path / "new")]) == 0
        path = tmp_path / "new" / f"rigid_block.{ending}"
        assert capsys.readouterr().out == f"wrote {path}\n"
        text = path.read_text(encoding="utf-8")
        for told in (f"rockeom {__version__}", "Source: ", "[kg m2]", "moment of inertia"):
            assert told in text
    assert main(["export", "c", "rigid_block", "--out", str(tmp_path / "mine.c")]) == 0
    assert (tmp_path / "mine.c").read_bytes() == (tmp_path / "new" / "rigid_block.c").read_bytes()


def test_shipped_structures_are_written_without_deriving_them(tmp_path):
    lines = (
        "import sys; from rockeom.cli import main",
        f"main(['export', 'c', 'rigid_block', '--out', {str(tmp_path)!r}])",
        "assert not {'sympy', 'rockeom.codegen'} & set(sys.modules)",
    )
    subprocess.run([sys.executable, "-c", "\n".join(lines)], check=True, capture_output=True)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("c", "rigid_blok"), "did you mean rigid_block"),
        (("c", "rigid_block", "--free"), "--free is for opensees"),
        (("c", "rigid_block", "--set", "mass=3"), "--set is for opensees"),
        (("matlab", "rigid_block", "--out", "block.m"), "which is called rigid_block.m"),
        (("c", "rigid_block", "--out", "nowhere/block.c"), "there is no folder nowhere"),
        (("opensees", "two_spring_structure", *ON_SPRINGS), "needs a ground motion"),
        (("opensees", "two_spring_structure", "storeys=2"), "write it behind --set"),
        (
            ("opensees", "rigid_block", *FREE, "--set", "half_width=0.1", "half_height=0.4"),
            "give a TwoSpringStructure",
        ),
        (
            ("opensees", "lumped_mass_structure", *FREE, "--set", *MASSES),
            "the support two_springs with foundation_damping 0",
        ),
        (
            ("opensees", "two_spring_structure", *FREE, *ON_SPRINGS[:-1], "foundation_damping=3e3"),
            "give feet without dampers, foundation_damping=0",
        ),
        (
            ("opensees", "two_spring_structure", *FREE, *ON_SPRINGS, "--initial", "theta_dot=1"),
            "theta_dot is not written for OpenSees",
        ),
        (
            ("opensees", "two_spring_structure", *FREE, *ON_SPRINGS, "--step", "0"),
            "--step is 0: it must be finite and positive",
        ),
    ],
)
def test_what_cannot_be_written_is_told_with_the_remedy(
    arguments, told, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    assert main(["export", *arguments]) == 2
    assert told in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_model_is_written_in_two_languages_and_in_no_other():
    model = rk.derive("slender_block")
    assert "slender_block_rates(" in code_of_model(model, "c")
    assert "function m = slender_block()" in code_of_model(model, "matlab")
    assert refused(code_of_model, model, "matlap") == ("language", "matlap")
    assert refused(code_of_model, model, 3) == ("language", 3)


def test_opensees_script_is_handed_the_record_as_it_is(tmp_path, capsys):
    record = tmp_path / "record.txt"
    np.savetxt(record, np.column_stack([0.02 * np.arange(50), np.sin(0.3 * np.arange(50))]))
    arguments = ["--motion", str(record), "--units", "m/s2", "--out", str(tmp_path)]
    assert main(["export", "opensees", "two_spring_structure", *ON_SPRINGS, *arguments]) == 0
    text = (tmp_path / "two_spring_structure_opensees.py").read_text(encoding="utf-8")
    tree = ast.parse(text)
    values = {
        node.targets[0].id: ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and not any(map(_is_name, ast.walk(node.value)))
    }
    assert (values["mass"], values["foundation_stiffness"]) == (122.6, 5e5)
    np.testing.assert_allclose(values["apart"], 0.02, rtol=1e-12)
    np.testing.assert_allclose(values["accelerations"], np.sin(0.3 * np.arange(50)), atol=1e-12)


def _is_name(node):
    return isinstance(node, (ast.Name, ast.Call))


@pytest.mark.parametrize(("step", "within"), [(1e-3, 2e-4), (1e-4, 2e-5)])
def test_opensees_meets_the_rotations_of_a_structure_let_go_on_two_springs(step, within, tmp_path):
    if importlib.util.find_spec("openseespy") is None:
        pytest.skip("OpenSees is not installed: pip install openseespy==3.7.1.2, on Python 3.11")
    motion, out = rk.GroundMotion.none(FOLLOWED), tmp_path / "rows.csv"
    path = tmp_path / "model.py"
    text = script(SPRUNG, motion, initial={"theta": TILT}, step=step, out=str(out))
    path.write_text(text, encoding="utf-8")
    subprocess.run([sys.executable, path], env=environment(), check=True, capture_output=True)
    rows = np.loadtxt(out, delimiter=",", skiprows=1)
    theta = np.interp(TIMES, rows[:, 0], rows[:, 1])
    assert np.abs(theta - rotations_of_ours(SPRUNG)).max() < within
