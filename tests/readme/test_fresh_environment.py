"""README.md in an environment that its own words make, with no package more than they name."""

import os
import shlex
import subprocess
import venv
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from tests.pages import blocks


def required(requirement: Requirement) -> dict[str, Distribution]:
    """What pip installs for a requirement, by name, of what is installed here."""
    chosen: dict[str, Distribution] = {}
    waiting = [requirement]
    while waiting:
        one = waiting.pop()
        chosen[one.name] = of = distribution(one.name)
        for line in of.requires or ():
            needed = Requirement(line)
            extras = [{"extra": extra} for extra in one.extras or ("",)]
            if not needed.marker or any(map(needed.marker.evaluate, extras)):
                waiting += [needed] if needed.name not in chosen or needed.extras else []
    return chosen


@pytest.fixture(scope="module")
def fresh(tmp_path_factory) -> Path:
    """The Python of an environment with what the pip line of README.md names, linked from here."""
    home = tmp_path_factory.mktemp("fresh")
    venv.create(home)
    (site,) = home.glob("lib/*/site-packages")
    (line,) = (line for block in blocks("sh") for line in block.splitlines() if "pip" in line)
    named = shlex.split(line, comments=True)[-1].replace(".[", "rockeom[")
    for of in required(Requirement(named)).values():
        for name in {file.parts[0] for file in of.files or ()} - {"..", "__pycache__"}:
            (site / name).symlink_to(of.locate_file(name))
    return home / "bin" / "python"


def test_examples_run_after_the_install_that_the_readme_prints(fresh, tmp_path):
    (tmp_path / "readme.py").write_text("\n".join(blocks("python")), encoding="utf-8")
    lines = (line for block in blocks("sh") for line in block.splitlines())
    commands = [shlex.split(line)[1:] for line in lines if line.startswith("rockeom")]
    main = ["-c", "from rockeom.cli import main; main()"]
    told = {name: x for name, x in os.environ.items() if not name.startswith("PYTHON")}
    for command in (["readme.py"], *([*main, *command] for command in commands)):
        done = subprocess.run(
            [fresh, *command], cwd=tmp_path, env=told | {"MPLBACKEND": "agg"},
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert "came to rest" in done.stdout or command[0] == "-c"
