"""The scripts of a page keep their types and their form, and its texts are in one table."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import rockeom as rk
from rockeom.browser.page import _IN_PLANE, _IN_SPACE, _SCRIPTS, _asset

HERE = Path(__file__).parent
ASSETS = Path(rk.__file__).parent / "browser" / "assets"
TOOLS = os.pathsep.join((str(HERE / "node_modules" / ".bin"), os.environ["PATH"]))
_MISSING = [tool for tool in ("npm", "tsc", "prettier") if not shutil.which(tool, path=TOOLS)]


@pytest.mark.skipif(
    bool(_MISSING),
    reason=f"no {', '.join(_MISSING)} here: `npm install --prefix tests/browser` gets both tools",
)
def test_scripts_are_typed_and_formatted():
    ran = subprocess.run(
        ["npm", "run", "--silent", "check"],
        cwd=HERE, env={**os.environ, "PATH": TOOLS}, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stdout + ran.stderr


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node here")
def test_functions_of_the_scripts_by_node():
    ran = subprocess.run(
        ["node", "--test", str(HERE / "scripts_test.js")],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert ran.returncode == 0, ran.stdout


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node here")
@pytest.mark.parametrize("own", [_IN_PLANE, _IN_SPACE], ids=["in the plane", "in space"])
def test_script_of_a_page_is_whole_without_its_comments(own):
    script = "\n".join(map(_asset, (*_SCRIPTS, *own)))
    assert not re.search(r"^\s*(//|\*|/\*\*.*\*/$)", script, re.MULTILINE)
    ran = subprocess.run(["node", "--check", "-"], input=script, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr


def test_scripts_are_those_of_a_page_and_of_a_widget():
    scripts = (*_SCRIPTS, *_IN_PLANE, *_IN_SPACE, "widget.js")
    assert sorted(scripts) == sorted(path.name for path in ASSETS.glob("*.js"))


def test_page_has_no_text_of_its_own():
    page, texts = ((ASSETS / name).read_text("utf-8") for name in ("page.html", "texts.js"))
    for name in re.findall(r'data-(?:text|label)="(\w+)"', page):
        assert f"\n  {name}: " in texts, name
    body = re.sub(r"<!--.*?-->|<[^>]*>", "", page)
    assert not body.strip()
