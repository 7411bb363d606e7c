"""An .mp4 film of a response: where ffmpeg is, and where it is not."""

import importlib.util
import shutil

import pytest

import rockeom as rk
from rockeom.drawing import film

BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)


@pytest.fixture(scope="module")
def run():
    return rk.simulate(BLOCK, rk.GroundMotion.none(1.0), initial={"theta": 0.1})


@pytest.mark.skipif(
    shutil.which("ffmpeg") is None and importlib.util.find_spec("imageio_ffmpeg") is None,
    reason="there is no ffmpeg here: pip install imageio-ffmpeg",
)
def test_film_is_an_mp4_of_all_frames(run, tmp_path):
    path = tmp_path / "block.mp4"
    run.animate(path, end=0.3)
    data = path.read_bytes()
    assert data[4:8] == b"ftyp"
    assert b"avc1" in data
    assert len(data) > 2000


def test_without_ffmpeg_the_error_says_how_to_get_it_before_a_frame_is_drawn(
    run, tmp_path, monkeypatch
):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    monkeypatch.setattr("rockeom.drawing.animation.Animation.draw", None)
    with pytest.raises(FileNotFoundError, match=r"pip install imageio-ffmpeg.*\.gif or \.html"):
        run.animate(tmp_path / "block.mp4")
    assert not [*tmp_path.iterdir()]


def test_what_ffmpeg_says_is_passed_on(monkeypatch):
    monkeypatch.setattr(film, "ffmpeg", lambda: shutil.which("false") or "/bin/false")
    with pytest.raises(OSError, match=r"ffmpeg could not make the film.*\.gif"):
        film.mp4([b"no picture"], 20.0)
