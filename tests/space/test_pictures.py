"""Pictures of bodies in space: places, hidden faces, feet, tracks and the stability surface."""

import base64
import functools
import io
import re
import shutil
import subprocess
from importlib.util import find_spec
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from PIL import Image, ImageSequence

import rockeom as rk
from rockeom import plots
from rockeom.cli import main
from rockeom.codes import FRICTIONLESS, SLIP_RIGHT
from rockeom.drawing import film
from rockeom.drawing.animation import ground_displacement
from rockeom.drawing.plan import barrier_tilts
from rockeom.drawing.scene import LOOKS, VIEW, Scene, work_of
from rockeom.structures.positions import Solid, box, cylinder, lean_of, solid
from tests.space.cases import Case
from tests.space.test_standing import EL_CENTRO

PRISM = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0, offset_x=0.05)
FEET = {"front": (0.02, 0.26), "left": (-0.24, -0.13), "right": (0.22, -0.11)}
TRIPOD = rk.LeggedStatue(
    feet=FEET, centroid=(0.0, 0.0, 0.6), mass=300.0, inertia=np.diag([50.0, 45.0, 12.0])
)
LEANING = {"pitch": 0.15, "roll": -0.1, "yaw": 0.6}


@functools.cache
def shaken(body=PRISM, factor: float = 1.5) -> rk.Response:
    along, across, up = (factor * motion for motion in EL_CENTRO)
    return rk.simulate(body, along, transverse=across, vertical=up, duration=8.0)


def projected(points, azimuth: float, elevation: float) -> np.ndarray:
    """Places in the picture of a viewer at an azimuth and an elevation, by two rotations."""
    x, y, z = np.moveaxis(np.asarray(points, float), -1, 0)
    back = x * np.cos(azimuth) + y * np.sin(azimuth)
    return np.stack(
        [
            y * np.cos(azimuth) - x * np.sin(azimuth),
            z * np.cos(elevation) - back * np.sin(elevation),
        ],
        axis=-1,
    )


def marks(ax, look: str) -> np.ndarray:
    """(n, 2) places of the marks of feet of a look."""
    of = LOOKS[look]
    lines = [
        line for line in ax.lines
        if line.get_marker() == "o" and line.get_markersize() == of["ms"]
        and to_rgb(line.get_color()) == to_rgb(of["color"])
    ]  # fmt: skip
    return np.array([line.get_xydata()[0] for line in lines]).reshape(-1, 2)


def faces(ax) -> list[np.ndarray]:
    """Corners of all faces that are drawn, the last one above the others."""
    (of,) = (c for c in ax.collections if isinstance(c, PolyCollection))
    polygons = [np.unique(path.vertices[:-1], axis=0) for path in of.get_paths()]
    return [polygon for polygon in polygons if len(polygon) > 2]


# --- places


@pytest.mark.parametrize("view", [VIEW, (0.4, 0.9)])
def test_a_prism_is_drawn_where_its_corners_are(view):
    (ax,) = plots.draw_structure(PRISM, state=LEANING, view=view).axes
    at, turn = PRISM.positions(LEANING)["body"], PRISM.rotations(LEANING)["body"]
    ends = np.array([(-0.3, 0.2), (-0.35, 0.35), (-1.5, 1.5)])
    corners = np.array([ends[[0, 1, 2], k] for k in np.ndindex(2, 2, 2)]) @ turn.T + at
    shown = np.unique(np.vstack(faces(ax)).round(9), axis=0)
    for place in shown:  # each is a corner of the box, and one of them is behind it
        assert np.abs(projected(corners, *view) - place).max(axis=1).min() < 1e-8
    assert len(shown) == 7
    assert ax.get_aspect() == 1.0


def test_a_face_that_looks_away_is_not_drawn_and_the_nearest_is_drawn_last():
    for elevation, count in ((0.0, 2), (0.5, 3)):  # without the top, and with it
        (ax,) = plots.draw_structure(PRISM, view=(-0.9, elevation)).axes
        assert len(faces(ax)) == count
    podium = _Two(width=0.5, depth=0.5, height=1.0, mass=1.0)
    (ax,) = plots.draw_structure(podium, view=(0.0, 0.3)).axes  # from the side of x
    heights = [np.ptp(face[:, 1]) for face in faces(ax)]
    assert heights[-1] == pytest.approx(np.cos(0.3))  # the face of the box in front
    np.testing.assert_allclose(cylinder(0.3, 2.0).centres[:48, 2], 0.0, atol=1e-12)  # its sides


class _Two(rk.Prism):
    """A box and one behind it, nearer in the list."""

    @property
    def solids(self):
        front, behind = box(0.5, 0.5, 1.0), box(0.5, 0.5, 2.0, (-3.0, 0.0, 0.0))
        faces = np.vstack([front.faces, behind.faces + 8])
        return {"body": Solid(np.vstack([front.vertices, behind.vertices]), faces)}


def test_a_statue_of_no_known_shape_has_legs_and_a_plate():
    (ax,) = plots.draw_structure(TRIPOD, view=VIEW).axes
    centre = projected((0.0, 0.0, 0.6), *VIEW)
    feet = projected([(*place, 0.0) for place in FEET.values()], *VIEW)
    lines = [line.get_xydata() for line in ax.lines if len(line.get_xdata()) == 2]
    for foot in feet:
        assert any(np.allclose(line, [centre, foot], atol=1e-12) for line in lines)
    np.testing.assert_allclose(marks(ax, "bears"), feet, atol=1e-12)


def test_feet_show_what_they_do_and_the_one_behind_is_pale():
    state = PRISM.state({"roll": 0.1})  # onto the edge of the south
    scene, ax = Scene(PRISM, state, PRISM.mode_number(state)), Figure().add_subplot()
    scene.draw(ax)
    of = PRISM.positions({"roll": 0.1})
    south, north = ("south_west", "south_east"), ("north_east", "north_west")
    for look, names in (("bears", south), ("open", north)):
        places = projected([of[name] for name in names], *VIEW)
        np.testing.assert_allclose(np.sort(marks(ax, look), axis=0), np.sort(places, axis=0))
    pale = [line.get_xydata()[0] for line in ax.lines if (line.get_alpha() or 1.0) < 1.0]
    np.testing.assert_allclose(pale, [projected(of["north_west"], *VIEW)], atol=1e-12)
    mode = PRISM.module.MODES.index("south_west_south_east_idle_north_east")
    assert Scene(PRISM, state, mode).feet["south_east"] == "idle"
    rubbing = SimpleNamespace(POINTS=("one", "two"), POINT_STATES=[(SLIP_RIGHT, FRICTIONLESS)])
    assert [work_of(rubbing, foot, 0) for foot in rubbing.POINTS] == ["slides", "bears"]


@pytest.mark.parametrize(
    ("body", "faces", "volume"),
    [
        (box(0.5, 0.7, 3.0, (0.1, 0.0, 0.2)), 6, 0.5 * 0.7 * 3.0),
        (cylinder(0.3, 2.0), 50, 24 * np.sin(np.pi / 24) * 0.09 * 2.0),
        (cylinder(0.3, 2.0, 0.1, 0.8), 50, 24 * np.sin(np.pi / 24) * (0.09 + 0.03 + 0.01) * 2 / 3),
        (solid([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
               [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]), 4, 1 / 6),
    ],
)  # fmt: skip
def test_surfaces_look_outward(body, faces, volume):
    """By the divergence of the place, which is three times the volume."""
    corners = body.vertices[body.faces]
    areas = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1) / 2
    assert np.einsum("ij,ij", corners[:, 0], areas) / 3 == pytest.approx(volume, rel=1e-12)
    assert len(body.faces) == faces
    ends, _, sharp = body.edges
    assert len(body.vertices) - len(ends) + len(body.faces) == 2  # Euler
    assert sharp.any()


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"view": (0.0, -0.2)}, "the elevation, 0 to 1.57"),
        ({"view": (0.0,)}, "the azimuth from which to look"),
        ({"slope": 0.1}, "ground in space is level"),
    ],
)
def test_a_view_from_below_and_a_slope_are_refused(asked, words):
    with pytest.raises(ValueError, match=words):
        plots.draw_structure(PRISM, **asked)


ROUND = [
    rk.WobblingColumn(radius=0.25, height=2.0, mass=3.0, top_radius=0.1),
    rk.Podium(columns=4, slab_mass=20.0, radius=0.25, height=2.0, mass=3.0),
    rk.RollingCylinder(radius=0.25, height=2.0, mass=3.0, centroid_height=0.8),
    rk.RollingCylinder(radius=0.25, height=0.0, mass=3.0),
]


@pytest.mark.parametrize("body", ROUND)
def test_a_round_body_is_drawn_on_its_rim(body):
    state = body.on_rim(0.2) if isinstance(body, rk.RollingCylinder) else {"tilt": 0.2}
    places, turns = body.positions(state), body.rotations(state)
    heights = {
        name: (surface.vertices @ turns[name].T + places[name])[:, 2]
        for name, surface in body.solids.items()
    }
    *slab, column = heights.values()
    assert column.min() == pytest.approx(0.0, abs=1e-9)  # towards x, where the polygon is round
    for above in slab:
        assert above.min() == pytest.approx(column.max(), abs=1e-9)
    (ax,) = plots.draw_structure(body).axes  # flat, or where it cannot be, leaning
    assert len(faces(ax)) > 0
    assert "sketch" in body._repr_html_()


# --- films


def test_the_ground_of_a_film_moves_along_the_axes_of_a_turned_statue():
    run = rk.simulate(PRISM, EL_CENTRO[0], azimuth="90 deg", duration=3.0)
    made = run.animate(start=2.0, end=2.5)
    moved = np.zeros((len(made), 3))
    moved[:, 1] = -ground_displacement(run.motion, made.times)
    np.testing.assert_allclose(made.ground, projected(moved, *VIEW), atol=1e-12)
    labels = [line.get_label() for line in run.plot().axes[0].lines]
    assert labels == ["horizontal", "transverse"]


def test_frames_of_a_film_in_space_show_the_response_at_their_time(tmp_path):
    run = shaken()
    made = run.animate(tmp_path / "prism.gif", start=4.0, end=4.5, frames_per_second=10)
    assert (tmp_path / "prism.gif").stat().st_size > 1000
    motions = run.motion, run.transverse, run.vertical
    moved = np.transpose([ground_displacement(motion, made.times) for motion in motions])
    np.testing.assert_allclose(made.ground, projected(moved, *VIEW), atol=1e-12)
    for i, t in enumerate(made.times):
        ax = Figure().add_subplot()
        made.draw(i, ax)
        state = {name: float(value) for name, value in run.at(t).items()}
        at = PRISM.positions(state)
        feet = [marks(ax, look) for look in LOOKS]
        for name in PRISM.module.POINTS:
            place = projected(at[name], *VIEW)
            assert np.abs(np.vstack(feet) - place).max(axis=1).min() < 1e-9
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
        for face in faces(ax):
            assert (face > (left, low)).all()
            assert (face < (right, high)).all()


def pictures_in(path) -> list[np.ndarray]:
    """Frames of a file, in colours."""
    if path.suffix == ".mp4":
        show = [film.ffmpeg(), "-loglevel", "error", "-i", str(path)]
        show += ["-f", "image2pipe", "-c:v", "png", "-"]
        data = subprocess.run(show, capture_output=True, check=True).stdout
        frames = [b"\x89PNG" + one for one in data.split(b"\x89PNG")[1:]]
    elif path.suffix == ".html":
        (listed,) = re.findall(r"const frames = \[(.*)\];", path.read_text(encoding="utf-8"))
        frames = [base64.b64decode(one) for one in re.findall(r'"([^"]*)"', listed)]
    else:
        with Image.open(path) as whole:
            return [np.asarray(one.convert("RGB"), int) for one in ImageSequence.Iterator(whole)]
    return [np.asarray(Image.open(io.BytesIO(one)).convert("RGB"), int) for one in frames]


@pytest.mark.parametrize("kind", [".gif", ".html", ".mp4"])
def test_files_of_a_film_in_space_show_its_frames(kind, tmp_path):
    if kind == ".mp4" and not shutil.which("ffmpeg") and not find_spec("imageio_ffmpeg"):
        pytest.skip("there is no ffmpeg here: pip install imageio-ffmpeg")
    made = shaken().animate(tmp_path / f"prism{kind}", start=4.0, end=4.5, frames_per_second=6)
    shown = pictures_in(tmp_path / f"prism{kind}")
    assert len(shown) == len(made) == 4
    for frame, data in zip(shown, made.frames, strict=True):
        drawn = np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), int)
        height, width, _ = drawn.shape
        assert np.abs(frame[:height, :width] - drawn).mean() < 3.0  # of 255
    apart = [np.abs(one - shown[0]).mean() for one in shown[1:]]
    assert min(apart) > 0.3


def test_a_film_between_two_samples_has_its_tilt():
    run = shaken()
    start = float(run.t[run.t > 4.0][0]) + 1e-6
    made = run.animate(start=start, end=start + 1.1e-5, frames_per_second=2e5)
    assert len(made.frames) == len(made) == 3


def test_the_command_draws_a_film_from_a_view(tmp_path, capsys):
    body, path = "--set width=0.5 depth=0.7 height=3.0 mass=2000", tmp_path / "prism.html"
    start = "--free --duration 1 --end 0.1 --initial pitch=0.1 roll=0.05 --frames-per-second 10"
    asked = f"animate prism {body} {start} --view -30deg 20deg --out"
    assert main([*asked.split(), str(path)]) == 0
    body = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)
    run = rk.simulate(body, rk.GroundMotion.none(1.0), initial={"pitch": 0.1, "roll": 0.05})
    view = tuple(np.radians([-30.0, 20.0]).tolist())
    run.animate(tmp_path / "same.html", end=0.1, frames_per_second=10, view=view)
    for shown, same in zip(*map(pictures_in, sorted(tmp_path.iterdir())), strict=True):
        np.testing.assert_array_equal(shown, same)
    block = "rigid_block --free --duration 1 --set half_width=0.1 half_height=0.4 --out b.gif"
    assert main(["animate", *block.split(), "--view", "30deg", "20deg"]) == 2
    assert "it moves in a plane: leave it out" in capsys.readouterr().err


# --- tilt, tracks and histories


def test_the_stability_surface_of_a_prism_is_that_of_its_half_edges():
    body = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=1.0)
    d = np.linspace(-np.pi, np.pi, 37)
    expected = (0.25 * np.abs(np.cos(d)) + 0.35 * np.abs(np.sin(d))) / 1.5
    np.testing.assert_allclose(np.tan(barrier_tilts(body, "body", d)), expected, rtol=1e-12)
    case, corner = Case("stability_surface_90"), Case("balance_on_corner_A")
    sizes = {"width": 2 * case["b"], "depth": 2 * case["c"], "height": 2 * case["h"]}
    body = rk.Prism(**sizes, mass=case["m"])
    towards = np.array([np.pi / 2, corner.right("direction")])
    onto_edge, onto_corner = barrier_tilts(body, "body", towards)
    case.agrees(overturning_tilt=onto_edge)
    corner.agrees(tilt=onto_corner)


def test_a_statue_balances_where_its_centroid_is_above_an_edge_or_a_foot():
    """Towards an edge by the angle of that plane; a body of no feet by the rim of its base."""
    for first, second in (("front", "left"), ("left", "right"), ("right", "front")):
        a, b = np.array(FEET[first]), np.array(FEET[second])
        across = np.array([b[1] - a[1], a[0] - b[0]]) / np.hypot(*(b - a))
        out = np.arctan2(*across[::-1])
        (angle,) = barrier_tilts(TRIPOD, "body", np.array([out]))
        assert np.tan(angle) == pytest.approx(abs(across @ a) / 0.6, rel=1e-12)


def test_tilt_and_its_direction_are_those_of_the_axis():
    for tilt, way in ((1e-9, 2.0), (0.3, -2.5), (1.4, 0.1)):
        state = {"pitch": np.arctan(np.tan(tilt) * np.cos(way))}
        state["roll"] = -np.arcsin(np.sin(tilt) * np.sin(way))
        lean = lean_of(PRISM.rotations(state | {"yaw": 0.4})["body"].ravel())
        assert lean.tilt == pytest.approx(tilt, rel=1e-9)
        assert lean.azimuth == pytest.approx(way + 0.4, abs=1e-9)


def test_tilt_is_drawn_against_its_direction_seen_from_the_body():
    """A body that leans along its own x does so at any yaw, and the base stays where it is."""
    lines = []
    for yaw in (0.0, 1.2):
        run = rk.simulate(
            PRISM, rk.GroundMotion.none(0.4), initial={"pitch": 0.05, "roll": 0.02, "yaw": yaw}
        )
        figure = plots.plot_tilt(run)
        figure.draw_without_rendering()
        (ax,) = figure.axes
        (line,) = (line for line in ax.lines if line.get_label() == "tilt [rad]")
        lines.append(line.get_xydata())
        way, tilt = line.get_xydata()[0]
        leans = tilt * np.cos(way), tilt * np.sin(way)
        assert leans == pytest.approx((0.05, -0.02), rel=1e-2)
    np.testing.assert_allclose(*(line[:50] for line in lines), atol=1e-4)


def test_tracks_of_smooth_feet_are_as_long_as_the_ground_has_moved_below_them():
    smooth = rk.LeggedStatue(
        feet=FEET, centroid=(0, 0, 0.6), mass=300.0, inertia=np.diag([50.0, 45.0, 12.0]), friction=0
    )
    pulse = rk.GroundMotion.single_sine(1.0, 0.5, 1.0)
    run = rk.simulate(smooth, pulse, transverse=2 * pulse)
    far = -ground_displacement(pulse, run.t[-1:])[0] * np.array([1.0, 2.0])
    (ax,) = plots.plot_tracks(run).axes
    for name, place in FEET.items():
        (dots,) = (x for x in ax.lines if str(x.get_label()).startswith(name))
        np.testing.assert_allclose(dots.get_xydata()[0], place, atol=1e-12)
        assert f"{1e3 * np.hypot(*far):.3g} mm on the ground" in dots.get_label()
    ends = [line.get_xydata()[-1] for line in ax.lines if line.get_linewidth() == 2.2]
    for end in ends:
        assert min(np.hypot(*(end - far - place)) for place in FEET.values()) < 1e-9


def test_history_in_space_has_tilt_yaw_uplifts_and_contacts():
    run = shaken()
    figure = run.plot()
    figure.draw_without_rendering()
    labels = [ax.get_ylabel().split("\n")[0] for ax in figure.axes]
    assert labels == ["ground", "tilt", "yaw", "uplift", "landing speed", "contact"]
    tilt = run["tilt"]
    np.testing.assert_array_equal(figure.axes[1].lines[0].get_ydata(), tilt)
    assert [len(figure.axes[i].lines) for i in (3, -1)] == [4, 0]
    lanes = [label.get_text() for label in figure.axes[-1].get_yticklabels()]
    assert lanes == ["south west", "south east", "north east", "north west"]


def test_plan_and_polar_plot_ask_for_what_they_need():
    block = rk.RigidBlock(half_width=0.1, half_height=0.4)
    planar = rk.simulate(block, rk.GroundMotion.none(0.1), initial={"theta": 0.1})
    for draw in (plots.plot_tracks, plots.plot_tilt):
        with pytest.raises(rk.InputError, match="moves in a plane"):
            draw(planar)
    with pytest.raises(rk.InputError, match="body is 'head'"):
        plots.plot_tilt(shaken(), body="head")
    with pytest.raises(TypeError, match="polar axes"):
        plots.plot_tilt(shaken(), ax=Figure().add_subplot())
    ax = Figure().add_subplot(projection="polar")
    plots.plot_tilt(shaken(), ax=ax)
    assert ax.lines
