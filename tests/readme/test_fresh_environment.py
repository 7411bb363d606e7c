"""README.md in an environment that its own words make, with no package more than they name."""

import os
import shlex
import subprocess
import sys
import venv
from pathlib import Path

import pytest

from tests.pages import ROOT, blocks

NO_INDEX = "No matching distribution", "Could not find a version", "connection", "Temporary failure"


def run(command: list[str], folder: Path, home: Path) -> subprocess.CompletedProcess[str]:
    """In the fresh environment, without what this process was told of other ones."""
    binaries = home / ("Scripts" if sys.platform == "win32" else "bin")
    passed = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONHOME")}
    path = os.pathsep.join([str(binaries), passed["PATH"]])
    return subprocess.run(
        [str(binaries / command[0]), *command[1:]],
        cwd=folder,
        env={**passed, "PATH": path, "MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def fresh(tmp_path_factory) -> Path:
    """An environment with what the pip line of README.md installs."""
    home = tmp_path_factory.mktemp("fresh") / "venv"
    venv.create(home, with_pip=True)
    (line,) = (line for block in blocks("sh") for line in block.splitlines() if "pip" in line)
    done = run([*shlex.split(line, comments=True), "--quiet"], ROOT, home)
    if done.returncode and any(word in done.stderr for word in NO_INDEX):
        pytest.skip(f"no package index: {done.stderr.strip().splitlines()[-1]}")
    assert done.returncode == 0, done.stderr
    return home


def test_examples_run_after_the_install_that_the_readme_prints(fresh, tmp_path):
    script = tmp_path / "readme.py"
    script.write_text("\n".join(blocks("python")), encoding="utf-8")
    done = run(["python", str(script)], tmp_path, fresh)
    assert done.returncode == 0, done.stderr
    assert "came to rest" in done.stdout
    lines = (line for block in blocks("sh") for line in block.splitlines())
    for command in (shlex.split(line) for line in lines if line.startswith("rockeom")):
        done = run(command, tmp_path, fresh)
        assert done.returncode == 0, done.stderr
