"""`rockeom models`, `derive` and `generate`, and the command itself."""

import dataclasses
import io
import os
import re
import shlex
import subprocess
import sys
import unicodedata
from pathlib import Path

import pytest

import rockeom as rk
from rockeom import __version__
from rockeom.cli import _parser, main
from rockeom.cli.commands import HELP, OF_THESIS, command as command_of
from rockeom.codegen.write import write_generated
from rockeom.modelling.named import FAMILIES, SUPPORTS, parameters_of
from rockeom.structures.classes import SHIPPED
from rockeom.symbolic.text.plain import mathematics

COMMANDS = [name for name in HELP if name != "thesis"] + [f"thesis {name}" for name in OF_THESIS]


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "rockeom.cli", *arguments],
        capture_output=True,
        text=True,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    )


# --- the command


def test_alone_it_explains_itself(capsys):
    assert main([]) == 2
    text = capsys.readouterr().out
    assert text.startswith("usage: rockeom")
    for name in HELP:
        assert f"\n  {name} " in text
    assert len(text.splitlines()) <= 40


def test_the_group_of_the_thesis_lists_its_commands(capsys):
    assert main(["thesis"]) == 2
    text = capsys.readouterr().out
    for name in OF_THESIS:
        assert f"\n  {name} " in text


def test_a_command_on_the_thesis_without_its_group_is_named_with_it(capsys):
    with pytest.raises(SystemExit):
        main(["equations"])
    assert "no command 'equations' (did you mean thesis equations?)" in capsys.readouterr().err


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_each_command_says_what_it_does_and_gives_examples(name, capsys):
    with pytest.raises(SystemExit) as stopped:
        main([*name.split(), "--help"])
    assert stopped.value.code == 0
    text = capsys.readouterr().out
    assert "examples:" in text
    assert text.count(f"rockeom {name}") >= 3  # usage and examples
    assert max(map(len, text.splitlines())) <= 100


def test_version(capsys):
    with pytest.raises(SystemExit):
        main(["--version"])
    assert capsys.readouterr().out.strip() == f"rockeom {__version__}"


def test_unknown_command_names_the_known_ones(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["simulte"])
    assert stopped.value.code == 2
    assert "'simulte' (did you mean simulate?)" in capsys.readouterr().err


def test_bad_input_in_a_process_of_its_own():
    done = command("simulate", "rigid_block", "--free", "--duration", "1", "--set", "half_width=-1")
    assert done.returncode == 2
    assert done.stdout == ""
    assert "Traceback" not in done.stderr
    assert "half_height" in done.stderr


def test_reader_that_leaves_early_is_no_error():
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "w") as pipe:
        done = subprocess.run(
            [sys.executable, "-m", "rockeom.cli", "models"],
            stdout=pipe,
            stderr=subprocess.PIPE,
            text=True,
        )
    assert done.stderr == ""


def test_pipe_of_few_letters_gets_the_equations_all_the_same(monkeypatch):
    pipe = io.TextIOWrapper(io.BytesIO(), encoding="ascii")  # as Python opens one
    monkeypatch.setattr(sys, "stdout", pipe)
    assert main(["derive", "rigid_block"]) == 0
    pipe.flush()
    assert b"Equations of motion" in pipe.buffer.getvalue()


DOCS = Path(__file__).resolve().parents[2] / "docs"


def commands_of_pages() -> list[str]:
    """The lines of pages and of help texts that call the command."""
    blocks = [
        block
        for page in sorted(DOCS.rglob("*.md"))
        for block in re.findall(r"^```sh\n(.*?)^```", page.read_text("utf-8"), re.M | re.S)
    ]
    blocks += [command_of(name).EPILOG.partition("examples:\n")[2] for name in COMMANDS]
    joined = [re.sub(r"\s*\\\n\s*", " ", block) for block in blocks]
    lines = (line.strip() for block in joined for line in block.split("\n"))
    return list(dict.fromkeys(line for line in lines if line.startswith("rockeom ")))


@pytest.mark.parametrize("line", commands_of_pages())
def test_commands_of_pages_and_of_help_are_understood(line):
    words = shlex.split(re.split(r"\s{2,}| >", line)[0], comments=True)[1:]
    args, unknown = _parser(words).parse_known_args(words)
    assert args.run
    assert unknown == []


# --- models


def test_models_lists_all_within_the_width_of_a_page(capsys):
    assert main(["models"]) == 0
    lines = capsys.readouterr().out.splitlines()
    for name in rk.models():
        (line,) = (line for line in lines if line.startswith(f"{name} "))
        assert line.split()[1:]
    assert max(map(len, lines)) <= 120


@pytest.mark.parametrize("name", SHIPPED)
def test_model_explains_every_parameter_that_set_takes(name, capsys):
    assert main(["models", name]) == 0
    text = capsys.readouterr().out
    assert f"equations    rockeom derive {name}; with a drawing in generated/{name}.md\n" in text
    assert f"states       {', '.join(rk.derive(name).states)}\n" in text
    declared = {p.name: p for p in rk.derive(name).parameters}
    for taken, default in SHIPPED[name].defaults().items():
        if taken in ("support", "restraint", "loads", "full_height"):  # no number of the equations
            continue
        (line,) = (line for line in text.splitlines() if line.startswith(f"{taken} "))
        parameter = declared.get(taken) or declared["height"]
        assert parameter.meaning in line
        assert f" {parameter.unit} " in line
        assert ("required" in line) == (default is dataclasses.MISSING)


def test_models_lists_families_and_what_they_stand_on(capsys):
    assert main(["models"]) == 0
    text = capsys.readouterr().out
    for family in FAMILIES:
        assert f"\n{family} " in text
    assert "shear_frame takes storeys=N" in text
    assert "stacked_blocks, lumped_mass_structure, flexible_structure, shear_frame take a" in text
    for support in SUPPORTS:
        for parameter in parameters_of(support):
            (line,) = (x for x in text.splitlines() if x.split()[:1] == [f"support={support}"])
            assert f"{parameter}=" in line


def test_models_explains_a_family_by_lists_and_what_its_support_takes(capsys):
    assert main(["models", "shear_frame", "storeys=1", "support=sliding"]) == 0
    text = capsys.readouterr().out
    assert "equations    rockeom derive shear_frame storeys=1 support=sliding\n" in text
    for name in rk.ShearFrame.defaults():
        if name not in ("support", "restraint", "loads"):
            assert sum(line.startswith(f"{name} ") for line in text.splitlines()) == 1
    assert "x, y, theta, u_1, x_dot" in text
    assert "masses        kg     required    mass of floor 1, 2, ...: a list" in text
    assert "friction        -     coefficient of friction at each foot" in text


def test_unknown_model(capsys):
    assert main(["models", "flexible"]) == 2
    said = capsys.readouterr()
    assert "'flexible'" in said.err
    assert "flexible_structure" in said.err
    assert said.out == ""


# --- derive


def test_derived_block_is_housner_s(capsys, monkeypatch):
    """Thesis 2-2, as one would write it on a blackboard."""
    monkeypatch.setenv("COLUMNS", "100")
    assert main(["derive", "rigid_block", "--form", "polar"]) == 0
    text = unicodedata.normalize("NFC", capsys.readouterr().out)
    equation = "(m R² + I_g) θ̈ + s m g R sin(α - s θ) = -m ẍ_g R cos(α - s θ)"
    assert unicodedata.normalize("NFC", equation) in text
    assert "m  " in text
    assert "half_width" in text


@pytest.mark.parametrize(
    ("tex", "plain"),
    [
        (r"\tfrac{1}{2} k u^2", "½ k u²"),
        (r"\frac{a + b}{2 B}", "(a + b)/(2 B)"),
        (r"\frac{m g \sin(\alpha - \theta)}{\cos(\alpha - \theta)}", "m g sin(α - θ)/cos(α - θ)"),
        (r"\frac{a}{b}", "a/b"),
        (r"\cos^2\theta \thinspace \dot{\theta}", "cos² θ θ̇"),
        (r"\ddot x_g", "ẍ_g"),
        (r"N_{\mathrm{left}}", "N_left"),
        (r"\dot{u}^{+}", "u̇⁺"),
        (r"\dot{u_{1}}", "u̇_1"),
        (r"k \left[\frac{a}{b} - v\right]^2", "k [a/b - v]²"),
        (r"\arctan\left(\frac{B}{H}\right)", "arctan(B/H)"),
        (r"\sqrt{B^2 + H^2}", "√(B² + H²)"),
        (r"x^{n}", "x^(n)"),
        (r"\operatorname{sgn} \theta", "sgn θ"),
    ],
)
def test_plain_mathematics(tex, plain):
    assert mathematics(tex) == unicodedata.normalize("NFC", plain)


def test_latex_markdown_and_code_are_those_of_the_model(capsys):
    model = rk.derive("rigid_block")
    for option, expected in {
        "--latex": model.latex(),
        "--markdown": model.markdown(),
    }.items():
        assert main(["derive", "rigid_block", option]) == 0
        assert capsys.readouterr().out == expected
    assert main(["derive", "rigid_block", "--code"]) == 0
    code = capsys.readouterr().out
    compile(code, "rigid_block.py", "exec")
    assert 'NAME = "rigid_block"' in code


def test_a_family_on_a_support_is_derived_by_its_arguments(capsys):
    """What `rk.derive` gives for the same, and all its equations in plain text."""
    said = ["shear_frame", "storeys=2", "support=winkler", "springs=3"]
    model = rk.derive("shear_frame", storeys=2, support="winkler", springs=3)
    assert main(["derive", *said, "--markdown"]) == 0
    assert capsys.readouterr().out == model.markdown()
    assert main(["derive", *said]) == 0
    assert capsys.readouterr().out.startswith("Shear frame of 2 storeys on a bed of 3 springs\n")


def test_derive_into_a_file(tmp_path, capsys):
    path = tmp_path / "block.tex"
    assert main(["derive", "rigid_block", "--latex", "--form", "polar", "--out", str(path)]) == 0
    assert capsys.readouterr().out == ""
    assert path.read_text(encoding="utf-8") == rk.derive("rigid_block").latex("polar")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["rigid_blok"], ["rigid_blok", "did you mean rigid_block?"]),
        (["rigid_block", "--code", "--form", "polar"], ["--form polar", "--code", "leave"]),
        (["rigid_block", "--out", "no/such/folder/x"], ["no/such/folder/x", "there is no folder"]),
        (["shear_frame"], ["missing storeys", "It takes storeys; optional: support"]),
        (["shear_frame", "storeys=two"], ["storeys is 'two'", "whole number"]),
        (["shear_frame", "3"], ["3: write name=value, as in storeys=3"]),
        (["rigid_block", "storeys=3"], ["unknown storeys", "It takes nothing"]),
        (["flexible_structure", "support=winklr"], ["'winklr'", "did you mean winkler?"]),
        (["flexible_structure", "support=winkler"], ["'springs'", "it takes springs="]),
        (["flexible_structure", "support=pinned", "title=x"], ["'title'", "takes nothing"]),
    ],
)
def test_derive_of_what_cannot_be_derived(arguments, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["derive", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    for word in words:
        assert word in said.err


# --- generate


@pytest.fixture
def generated(tmp_path, monkeypatch):
    """A folder generated/ of a structure, up to date."""
    from rockeom.codegen import write

    monkeypatch.setattr(write, "SHIPPED", {"rigid_block": write.SHIPPED["rigid_block"]})
    folder = tmp_path / "generated"
    monkeypatch.setattr(write, "GENERATED", folder)
    write_generated(folder)
    return folder


def test_hand_edit_fails_the_check_with_the_difference_and_generate_mends_it(generated, capsys):
    assert main(["generate", "--check"]) == 0
    edited = generated / "rigid_block.py"
    text = edited.read_text(encoding="utf-8")
    edited.write_text(text.replace("N_STATES = 2\n", "N_STATES = 3\n"), encoding="utf-8")
    capsys.readouterr()

    assert main(["generate", "--check"]) == 1
    said = capsys.readouterr()
    assert "-N_STATES = 3\n+N_STATES = 2\n" in said.out
    assert "generated/rigid_block.py" in said.out
    assert "make generated" in said.err
    assert "N_STATES = 3" in edited.read_text(encoding="utf-8")  # a check changes nothing

    assert main(["generate"]) == 0
    assert capsys.readouterr().out == "wrote generated/rigid_block.py\n"
    assert edited.read_text(encoding="utf-8") == text
    assert main(["generate"]) == 0
    assert "up to date" in capsys.readouterr().out


def test_generate_outside_a_checkout_writes_nothing(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "site-packages" / "generated"
    monkeypatch.setattr("rockeom.codegen.write.GENERATED", folder)
    assert main(["generate"]) == 2
    assert "clone" in capsys.readouterr().err
    assert not folder.exists()
