"""A page is one file that runs by itself, and its motions are those of `rk.simulate`."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import rockeom as rk
from rockeom.browser import setup
from rockeom.browser.page import ENTRIES
from rockeom.cli import main
from tests.contact.test_facade import SIZE as FACADE, TIE
from tests.contact.test_isolated_blocks import BLOCK as ON_BASE, isolated
from tests.drawing.test_held_structures import strapped
from tests.shipped import plain

ASSETS = Path(rk.__file__).parent / "browser" / "assets"
PULSE = rk.GroundMotion.half_sine(4.0, 0.8, duration=5.0)
BLOCK = rk.Case(rk.RigidBlock(half_width=0.15, half_height=0.6), PULSE)
SLIDERS = {"half_width": (0.05, 0.4), "amplitude": (0.5, 8.0), "initial theta": (-0.2, 0.2, 0.0)}


@pytest.fixture(scope="module")
def page():
    return rk.explorer(BLOCK, SLIDERS, title="A <b>statue</b> </script>")


def data_of(text: str) -> dict:
    return json.loads(re.search(r'id="data">(.*?)</script>', text, re.DOTALL)[1])


def test_page_is_one_small_file_that_asks_for_nothing(page, tmp_path):
    path = page.save(tmp_path / "block.html")
    text = path.read_text("utf-8")
    assert path.stat().st_size < 100e3
    loaded = text.replace("http://www.w3.org/2000/svg", "")  # a name
    assert not re.search(r"https?://|src=|<link|import\(|fetch\(", loaded)
    assert "<!-- " not in text


def test_title_and_names_are_escaped(page):
    assert "<b>statue" not in page.html
    assert page.html.count("</script>") == 2  # of the data and of the code
    assert data_of(page.html)["of"]["title"] == "A <b>statue</b> </script>"


def test_sliders_have_the_units_and_values_of_the_case(page):
    sliders = page.description()["sliders"]
    assert [s["unit"] for s in sliders] == ["m", "m/s2", "rad"]
    assert [s["start"] for s in sliders] == [0.15, 4.0, 0.0]


def test_no_script_is_long():
    for path in ASSETS.glob("*.js"):
        assert len(path.read_text("utf-8").splitlines()) <= 300, path.name


@pytest.mark.parametrize(
    ("sliders", "message"),
    [
        ({}, "0 sliders and 0 menus: give a slider or more, and at most 12 of both"),
        ({"half_width": (0.4, 0.1)}, "from 0.4 to 0.1"),
        ({"half_width": (0.1, 0.4, 0.9)}, "first 0.9"),
        ({"half_width": (0.1, float("inf"))}, "two finite"),
        ({"half_wdth": (0.1, 0.4)}, "'half_wdth', which is unknown .did you mean half_width"),
    ],
)
def test_sliders_that_cannot_be_are_refused(sliders, message):
    with pytest.raises(ValueError, match=message):
        rk.explorer(BLOCK, sliders)


WIDTH = {"half_width": (0.1, 0.4)}


@pytest.mark.parametrize(
    ("given", "more", "message"),
    [
        ((BLOCK.structure, WIDTH), {}, "give a case, or a function of the sliders"),
        ((BLOCK, {"half_width": 0.1}), {}, r"slider 'half_width' is 0.1: give \(lowest, highest\)"),
        ((BLOCK, {"half_width": (0.1, 0.4, 0.2, 3)}), {}, "rk.Slider.lowest, highest, first, unit"),
        ((BLOCK, ["half_width"]), {}, "sliders is ..half_width..: give it by names, as {.half"),
        ((BLOCK, WIDTH), {"menus": ["impact"]}, "menus is ..impact..: give it by names"),
        ((BLOCK, WIDTH), {"presets": {"a": 0.2}}, "preset 'a' is 0.2: give it by names"),
        ((BLOCK, WIDTH), {"questions": ["Why?"]}, "questions is .*: give a list of rk.Question"),
        ((BLOCK, WIDTH), {"questions": rk.Question("Why?", {})}, "questions is Question"),
    ],
)
def test_arguments_of_another_kind_are_refused_by_their_names(given, more, message):
    with pytest.raises(TypeError, match=message):
        rk.explorer(*given, **more)


def test_a_title_may_be_the_name_of_a_file_that_is_not_utf_8(page):
    assert rk.explorer(BLOCK, WIDTH, os.fsdecode(b"r\xe9cord")).heading == "r\ufffdcord"


STOREY = {
    "masses": [20e3], "heights": [3.5], "stiffnesses": [2e7], "dampings": [12e4],
    "half_width": 1.2, "base_mass": 10e3, "base_inertia": 5e4,
}  # fmt: skip
STRUCTURES = {
    "frame of three storeys": rk.ShearFrame(
        masses=[20e3] * 3, heights=[3.5, 7.0, 10.5], stiffnesses=[2e7] * 3, dampings=[12e4] * 3,
        half_width=2.0, base_mass=10e3, base_inertia=5e3,
    ),
    "sliding block": rk.SlidingBlock(
        half_width=0.1, half_height=0.4, friction=0.5, restitution=0.1
    ),
    "stacked blocks": rk.StackedBlocks(**plain("stacked_blocks")),
    "frame on a bed": rk.ShearFrame(
        **STOREY, support=rk.Winkler(springs=5, stiffness=4e6, damping=1e5)
    ),
    "frame on sliding feet": rk.ShearFrame(
        **STOREY, support=rk.Sliding(friction=0.3, restitution=0.1)
    ),
    "block with a strap that breaks": strapped(1e3),
    "facade with a tie": rk.Facade(**FACADE, restraint=rk.Strap(**TIE)),
    "block on an isolated base": isolated(ON_BASE),
}  # fmt: skip


OWN = {rk.HeldBlock: "width", rk.Facade: "thickness", rk.IsolatedBlocks: "isolator_damping"}


@pytest.mark.parametrize("structure", STRUCTURES.values(), ids=STRUCTURES)
def test_frames_and_structures_whose_contacts_open_have_a_page(structure):
    name = OWN.get(type(structure), "gravity")
    low, high = (factor * getattr(structure, name) for factor in (0.95, 1.05))
    page = rk.explorer(rk.Case(structure, PULSE), {"amplitude": (1.0, 5.0), name: (low, high)})
    assert all(same for _, same in page._motions())
    assert ("forces" in page.entries) == bool(getattr(structure, "restraint", ()))


def test_motions_of_a_page_are_those_of_simulate(page):
    """In machine code, which has the bits of the page."""
    found = list(page._motions())
    assert len(found) >= 6
    assert all(same for _, same in found)


def test_jupyter_shows_it_in_a_frame_without_a_network(page):
    shown = page._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!doctype html&gt;')
    assert "allow-same-origin" not in shown


def test_program_exports_what_a_page_calls(page):
    assert set(page.description()["entries"]) == {*ENTRIES, "balance", "uplift_and_friction"}


def test_a_page_waits_for_no_large_library():
    """scipy.stats and xarray took a third of the time of a page."""
    code = (
        "import sys, rockeom as rk; rk.explorer; print({'scipy.stats', 'xarray'} & {*sys.modules})"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "set()"


def test_command_makes_a_page(tmp_path, capsys):
    path = tmp_path / "block.html"
    words = "explore rigid_block --set half_width=0.15 half_height=0.6 --pulse half-sine"
    words += " amplitude=4 period=0.8 --vary half_width=0.05..0.4 --out"
    assert main([*words.split(), str(path)]) == 0
    assert "open it in a browser" in capsys.readouterr().out
    assert data_of(path.read_text("utf-8"))["of"]["structure"] == "RigidBlock"


def test_command_varies_full_dimensions(tmp_path):
    words = "explore rigid_block --set width=0.3 height=1.2 centroid_height=0.5 --pulse half-sine"
    words += " amplitude=4 period=0.8 --vary width=0.1..0.8 amplitude=0.5..8 --out"
    assert main([*words.split(), str(tmp_path / "block.html")]) == 0
    sliders = data_of((tmp_path / "block.html").read_text("utf-8"))["of"]["sliders"]
    assert [(s["name"], s["start"], s["unit"]) for s in sliders] == [
        ("width", 0.3, "m"), ("amplitude", 4.0, "m/s2"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("vary", "out", "message"),
    [
        ("half_width=0.1", "a.html", "write lowest..highest"),
        ("half_width=0.1..b", "a.html", "write lowest..highest"),
        ("half_width=0.1..0.4", "a.txt", "ends in .html"),
        ("width=0.1..0.4", "a.html", "--set has no height: write --set width="),
        ("wdth=0.1..0.4", "a.html", "'wdth', which is unknown"),
    ],
)
def test_command_refuses_what_cannot_be_a_page(vary, out, message, tmp_path, capsys):
    words = "explore rigid_block --set half_width=0.15 half_height=0.6 --free --duration 5 --vary"
    assert main([*words.split(), vary, "--out", str(tmp_path / out)]) != 0
    assert message in capsys.readouterr().err
    assert not (tmp_path / out).exists()


def test_command_says_why_there_is_no_page(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(setup, "MOST_WAYS", 0)
    words = "explore sliding_block --set half_width=0.15 half_height=0.6 friction=0.4"
    words += " restitution=0.1 --free --duration 5 --vary half_width=0.1..0.2 --out"
    assert main([*words.split(), str(tmp_path / "a.html")]) == 2
    assert "more than 0 ways: narrow the ranges" in capsys.readouterr().err
