"""Animations: bodies are where the generated module puts them, at the time that is said."""

import functools
import io

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

import rockeom as rk
from rockeom.drawing.animation import ground_displacement
from rockeom.plots import animate
from tests.contact import declared

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
PULSE = rk.GroundMotion.single_sine(2.8, 0.5, 3.0)


@functools.cache
def rocking() -> rk.Response:
    return rk.simulate(BLOCK, PULSE, vertical=PULSE.scaled(acceleration=0.3))


@functools.cache
def of_a_declared_structure() -> rk.Response:
    """A block on feet of which the right one stands on a step."""
    stepped = rk.structure(
        declared.on_a_step(), mass=900.0, inertia=540.0, gravity=9.81, friction=0.8,
        restitution=0.2, height=1.0, half_width=0.4, step=0.2,
    )  # fmt: skip
    return rk.simulate(stepped, rk.GroundMotion.single_sine(6.0, 0.6, 0.8))


def frame(animation, i):
    """The axes of a frame."""
    ax = Figure().add_subplot()
    animation.draw(i, ax)
    return ax


def marks(ax, **look):
    """(n, 2) places of single marks with this look."""
    lines = [line for line in ax.lines if len(line.get_xdata()) == 1]
    chosen = [
        line.get_xydata()[0]
        for line in lines
        if all(getattr(line, f"get_{name}")() == value for name, value in look.items())
    ]
    return np.array(chosen).reshape(-1, 2)


def positions(structure, mode, y):
    """Places by name, of the generated function itself."""
    m = structure.module
    out = np.empty(3 * len(m.POSITIONS))
    m.positions(mode, y.tolist(), structure.vector, out)
    return dict(zip(m.POSITIONS, out.reshape(-1, 3)[:, :2], strict=True))


# --- where things are


@pytest.mark.parametrize("run", [rocking, of_a_declared_structure])
def test_frames_at_random_states_show_what_the_generated_module_says(run):
    """Every mass and every foot, in any state and mode."""
    run = run()
    structure, rng = run.structure, np.random.default_rng(8)
    animation = run.animate(end=0.2)
    animation.states = rng.normal(scale=0.2, size=animation.states.shape)
    animation.modes = rng.integers(len(structure.module.MODES), size=len(animation))
    for i, (mode, y) in enumerate(zip(animation.modes, animation.states, strict=True)):
        shown = marks(frame(animation, i))
        kinds = structure.module.POSITION_KINDS
        for at, kind in zip(positions(structure, mode, y).values(), kinds, strict=True):
            if kind not in ("load", "massless"):
                assert np.abs(shown - at).max(axis=1).min() < 1e-12


@pytest.mark.parametrize("run", [rocking, of_a_declared_structure])
def test_frame_shows_the_response_at_its_time(run):
    run = run()
    animation = run.animate(start=0.1, end=0.7, frames_per_second=10)
    np.testing.assert_allclose(animation.times, np.arange(0.1, 0.7001, 0.1))
    for i, t in enumerate(animation.times):
        state = np.array([*run.at(t).values()])
        _, modes = run.steps.at(np.array([t]), "right")
        expected = positions(run.structure, int(modes[0]), state)["block"]
        assert np.abs(marks(frame(animation, i)) - expected).max(axis=1).min() < 1e-12
        assert f"t = {t:.2f} s" in animation.title(i)


def test_corners_of_the_block_are_turned_about_its_foot():
    """By the matrix of a rotation, in a state of the motion."""
    run = rocking()
    animation = run.animate(start=1.0, end=1.2)
    (patch,) = frame(animation, 0).patches
    theta = float(run.at(1.0)["theta"])
    pivot = np.array([np.sign(theta) * 0.095, 0.0])
    cos, sin = np.cos(theta), np.sin(theta)
    corners = np.array([(-0.095, 0), (0.095, 0), (0.095, 0.9), (-0.095, 0.9)]) - pivot
    expected = pivot + corners @ np.array([[cos, -sin], [sin, cos]])
    for corner in patch.get_xy():
        assert np.abs(expected - corner).max(axis=1).min() < 1e-12


def test_nothing_leaves_the_picture_and_scales_are_equal():
    animation = of_a_declared_structure().animate()
    for i in range(0, len(animation), 3):
        ax = frame(animation, i)
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
        shown = marks(ax)
        assert np.all((shown > (left, low)) & (shown < (right, high)))
        assert ax.get_aspect() == 1.0


# --- the ground


def test_ground_moves_by_the_integral_of_its_acceleration():
    """Of a sine a sin(w t): (a/w)(t - sin(w t)/w), and it stands still once that is over."""
    w, a = 2 * np.pi / 0.5, 2.8
    t = np.linspace(0.0, 0.5, 37)
    expected = a / w * (t - np.sin(w * t) / w)
    np.testing.assert_allclose(ground_displacement(PULSE, t), expected, atol=1e-12)
    record = rk.GroundMotion.from_array([0.0, 3.0, -1.0, 0.5], 0.2)
    after = ground_displacement(record, np.array([0.7, 5.0]))
    assert after[0] == after[1]
    fine = np.linspace(0.0, 0.6, 60001)
    v = np.concatenate([[0], np.cumsum(np.diff(fine) * record.acceleration(fine[:-1] + 5e-6))])
    x = np.sum(np.diff(fine) * (v[1:] + v[:-1]) / 2)
    assert after[0] == pytest.approx(x, rel=1e-8)


def test_what_stands_still_stays_where_it_is_in_the_picture():
    """The limits of the axes move against the ground, in both directions."""
    run = rocking()
    animation = run.animate(frames_per_second=10)
    moved = ground_displacement(PULSE, animation.times)
    np.testing.assert_allclose(animation.ground, np.column_stack([moved, 0.3 * moved]), atol=1e-12)
    for i in (0, 4, 20):
        ax = frame(animation, i)
        line = next(line for line in ax.lines if line.get_color() == "0.45")
        at = ax.transLimits.transform(line.get_xydata())
        start = frame(animation, 0)
        first = next(line for line in start.lines if line.get_color() == "0.45")
        np.testing.assert_allclose(at, start.transLimits.transform(first.get_xydata()), atol=1e-9)
    assert not run.animate(end=0.5, ground=False).ground.any()


# --- pivots and impacts


def test_foot_on_the_ground_is_the_pivot_and_the_one_that_lands_is_marked():
    run = rocking()
    hit = run.impacts[0]
    animation = run.animate(start=hit.time - 0.16, end=hit.time + 0.5)
    pivots, stars = [], []
    for i in range(len(animation)):
        ax = frame(animation, i)
        pivots.append(marks(ax, marker="o", markersize=5.5))
        stars.append(marks(ax, marker="*"))
    side = {"left": -0.095, "right": 0.095}
    for t, on, landed in zip(animation.times, pivots, stars, strict=True):
        foot = hit.mode_before if t < hit.time else hit.mode_after
        np.testing.assert_allclose(on, [[side[foot], 0.0]], atol=1e-12)
        if 0.0 <= t - hit.time < 0.2:
            np.testing.assert_allclose(landed, [[side[hit.mode_after], 0.0]], atol=1e-12)
        else:
            assert not len(landed)
    assert animation.title(0).endswith(", 0 impacts")
    assert animation.title(len(animation) - 1).endswith(", 1 impact")


def test_point_that_lands_is_marked_by_its_name():
    run = of_a_declared_structure()
    hit = next(impact for impact in run.impacts if impact.contact in ("left", "right"))
    animation = run.animate(start=hit.time, end=min(hit.time + 0.1, run.t[-1]))
    state, mode = animation.states[0], int(animation.modes[0])
    (star,) = marks(frame(animation, 0), marker="*")
    np.testing.assert_allclose(star, positions(run.structure, mode, state)[hit.contact])


# --- files and notebooks


@pytest.mark.parametrize(
    ("asked", "frames", "lasts"),
    [
        ({"end": 0.2, "frames_per_second": 20.0}, 5, 0.25),
        ({"end": 0.2, "frames_per_second": 30.0}, 7, 7 / 30),
        ({"end": 0.05, "frames_per_second": 20.0, "speed": 0.25}, 5, 0.25),
    ],
)
def test_gif_has_as_many_frames_as_said_and_runs_as_long(tmp_path, asked, frames, lasts):
    path = tmp_path / "block.gif"
    animation = rocking().animate(path, **asked)
    assert len(animation) == frames
    assert animation.frames_per_second == pytest.approx(asked["frames_per_second"])
    with Image.open(path) as image:
        assert image.n_frames == frames
        shown = []
        for i in range(frames):
            image.seek(i)
            shown.append(image.info["duration"])
        assert sum(shown) == pytest.approx(1000 * lasts, abs=5.01)
        size = image.size
    first = Image.open(io.BytesIO(animation.frames[0]))
    assert first.size == size


def test_page_has_all_frames_and_asks_for_nothing_else(tmp_path):
    path = tmp_path / "block.html"
    named = rk.GroundMotion(PULSE.segments, name='<script>alert("$")</script>')
    animation = rk.simulate(BLOCK, named).animate(path, end=0.2)
    text = path.read_text(encoding="utf-8")
    assert text.startswith("<!doctype html>")
    assert text.count("iVBORw0KGgo") == len(animation) + 1  # every PNG begins so; the first twice
    assert "http" not in text.replace("&", "")
    assert "<script>alert" not in text
    assert "&lt;script&gt;alert(&quot;$&quot;)" in text
    assert text.count("<script>") == text.count("</script>") == 1
    assert animation._repr_html_().count("<img") == 1


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"start": -1.0}, "within the response"),
        ({"start": 2.0, "end": 1.0}, "start before end"),
        ({"end": 99.0}, "from 0 to 3 s"),
        ({"speed": 0.0}, "speed is 0.0"),
        ({"frames_per_second": float("inf")}, "frames_per_second is inf"),
        ({"speed": 1e-3}, r"60001 frames are more than 2000.*speed=0.03"),
        ({"path": "block.avi", "end": 0.1}, r"block.avi.*\.gif, \.html or \.mp4"),
    ],
)
def test_what_cannot_be_shown_is_told_with_a_remedy(asked, message):
    with pytest.raises(ValueError, match=message):
        animate(rocking(), **asked)


def test_structure_in_pure_numbers_stays_above_its_ground():
    block = rk.NondimensionalBlock(alpha=0.2)
    run = rk.simulate(block, rk.GroundMotion.single_sine(0.4, 3.0))
    animation = run.animate(end=2.0)
    assert not animation.ground.any()
    assert animation.title(0) == "t = 0.00, 0 impacts"
