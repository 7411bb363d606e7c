"""Statues and boulders of meshes: against a box and a tetrahedron, and what is no body."""

import sys

import numpy as np
import pytest
import trimesh

import rockeom as rk
from rockeom.codes import MOST_POINTS_IN_SPACE
from rockeom.drawing.plan import barrier_tilts
from rockeom.modelling import mesh
from rockeom.structures.positions import box

SIZE = (0.5, 0.7, 3.0)
AT = np.array([0.2, -0.1, 0.4])
FEET = {"front": (0.2, 0.2), "left": (0.0, -0.4), "right": (0.4, -0.4)}
DENSITY = 2000.0


def triangles(solid) -> np.ndarray:
    """(n, 3) numbers of vertices of a surface whose faces are convex."""
    rows = [(f[0], f[i], f[i + 1]) for f in solid.faces.tolist() for i in range(1, len(f) - 1)]
    return np.array([row for row in rows if len({*row}) == 3])


def written(path, vertices, faces):
    """A mesh in a file of the format of its ending; "ascii.stl" in words."""
    kind = "stl_ascii" if path.name == "ascii.stl" else path.suffix[1:].lower()
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    mesh.export(path, file_type=kind, **({"digits": 17} if kind == "obj" else {}))
    return path


def boxed(path):
    body = box(*SIZE, AT)
    return written(path, body.vertices, triangles(body))


@pytest.mark.parametrize("name", ["ascii.stl", "binary.stl", "body.obj", "body.ply", "BODY.PLY"])
def test_a_box_of_each_format_has_the_inertia_of_a_prism(name, tmp_path):
    prism = rk.Prism(width=SIZE[0], depth=SIZE[1], height=SIZE[2], mass=np.prod(SIZE) * DENSITY)
    statue = rk.LeggedStatue.from_mesh(boxed(tmp_path / name), density=DENSITY, feet=FEET)
    rel = 1e-12 if name.endswith("obj") else 1e-6  # the others are of single precision
    values = prism.parameters()
    assert statue.mass == pytest.approx(prism.mass, rel=rel)
    np.testing.assert_allclose(statue.centroid, [*AT[:2], SIZE[2] / 2], rtol=rel)
    moments = [values[f"inertia_{axes}"] for axes in ("xx", "yy", "zz")]
    np.testing.assert_allclose(statue.inertia, np.diag(moments), rtol=rel, atol=rel * 1e3)
    vertices = statue.solids["body"].vertices
    np.testing.assert_allclose(vertices.max(axis=0), np.array(SIZE) / 2, rtol=rel)


def test_a_tetrahedron_in_millimetres_by_closed_form(tmp_path):
    """The integrals of a tetrahedron: its centroid is the mean of the corners, and the second
    moments about the origin are V/20 (sum of x x' over the corners + 16 of the centroid)."""
    corners = np.array([(0.0, 0.0, 0.0), (1.2, 0.1, 0.0), (0.2, 1.0, 0.0), (0.4, 0.3, 0.9)])
    path = written(tmp_path / "t.obj", 1e3 * corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    feet = {"one": (0.0, 0.0), "two": (1.2, 0.1), "three": (0.2, 1.0)}
    statue = rk.LeggedStatue.from_mesh(path, mass=80.0, scale=1e-3, feet=feet, restitution=0.3)
    centre = corners.mean(axis=0)
    second = 80.0 / 20 * (corners.T @ corners + 16 * np.outer(centre, centre))
    second -= 80.0 * np.outer(centre, centre)
    np.testing.assert_allclose(statue.centroid, centre, rtol=1e-12)
    np.testing.assert_allclose(
        statue.inertia, np.trace(second) * np.eye(3) - second, rtol=1e-10, atol=1e-10
    )
    assert (statue.mass, statue.restitution) == (80.0, 0.3)


def test_a_box_in_coordinates_of_a_map_has_its_own_inertia(tmp_path):
    """About the origin its moments are so large that rounding leaves nothing of its own."""
    at = np.array([512_345.5, 4_123_456.25, 1234.5])
    body = box(*SIZE)
    path = written(tmp_path / "map.obj", body.vertices + at, triangles(body))
    boulder = rk.Boulder.from_mesh(path, mass=700.0)
    right = 700.0 / 12 * np.diag([np.square(SIZE).sum() - side**2 for side in SIZE])
    np.testing.assert_allclose(boulder.inertia, right, rtol=1e-7, atol=1e-5)
    np.testing.assert_allclose(boulder.centroid, [*at[:2], SIZE[2] / 2], rtol=1e-9)


def test_a_boulder_stands_on_the_corners_of_its_lowest_points(tmp_path):
    """A box of which one lower corner is 3 mm high stands on the others and leans onto it."""
    body = box(0.6, 0.8, 0.5)
    vertices = body.vertices.copy()
    vertices[0, 2] += 0.003
    path = written(tmp_path / "block.ply", vertices, triangles(body))
    three, four = (
        rk.Boulder.from_mesh(path, mass=500.0, bearing_height=at) for at in (0.002, 0.005)
    )
    assert [len(place) for _, place in four.feet] == [2] * 4
    places = sorted(np.round([place for _, place in three.feet], 12).tolist())
    rises = np.array([0.001, 0.0, 0.0, 0.0])
    right = np.column_stack([vertices[:4, :2], rises])  # its lower corners
    np.testing.assert_allclose(places, sorted(np.round(right, 12).tolist()), atol=1e-8)
    assert four.centroid[2] == pytest.approx(0.25, abs=2e-3)
    run = rk.simulate(four, rk.GroundMotion.none(0.2), initial={"pitch": 0.02})
    assert run.outcome is rk.Outcome.CAME_TO_REST


def test_a_round_base_has_the_eight_points_that_take_most_area(tmp_path):
    trimesh.creation.cone(1.0, 1.0, sections=24).export(tmp_path / "cone.obj")
    cone = rk.Boulder.from_mesh(tmp_path / "cone.obj", mass=10.0)
    assert len(cone.feet) == MOST_POINTS_IN_SPACE
    least = barrier_tilts(cone, "body", np.linspace(0, 2 * np.pi, 721)).min()
    assert np.tan(least) == pytest.approx(np.cos(np.pi / 6) / 0.25)  # its sides: 30 and 60 degrees


def test_a_fine_round_base_with_a_fine_surface_has_its_points_at_once(tmp_path):
    """A column of 400 corners, chamfered below: it rests on the inner ring, leans onto another."""
    inner, outer, depth = 0.2, 0.3, 0.01
    profile = [(0, 0), (inner, 0), (outer, depth), (outer, 1.0), (0, 1.0)]
    trimesh.creation.revolve(profile, sections=400).export(tmp_path / "column.ply")
    column = rk.Boulder.from_mesh(tmp_path / "column.ply", mass=10.0, bearing_height=1e-6)
    places = np.array([(*place, 0.0)[:3] for _, place in column.feet])
    at_rest = places[places[:, 2] == 0.0]
    np.testing.assert_allclose(np.hypot(*at_rest[:, :2].T), inner, rtol=1e-4)
    higher = places[places[:, 2] > 0.0]
    np.testing.assert_allclose(np.hypot(*higher[:, :2].T), outer, rtol=1e-4)
    np.testing.assert_allclose(higher[:, 2], depth, rtol=1e-3)
    assert len(at_rest) >= 3
    assert len(higher) >= 2


def test_a_base_of_many_corners_on_one_side_keeps_the_far_one(tmp_path):
    """Half a circle of forty corners and a tip, below whose side the centroid is."""
    around = np.linspace(np.pi / 2, 3 * np.pi / 2, 40)
    base = np.vstack([0.2 * np.column_stack([np.cos(around), np.sin(around)]), [(0.5, 0.0)]])
    top = np.array([(x, y, 0.4) for x in (0.05, 0.6) for y in (-0.2, 0.2)])
    body = trimesh.convex.convex_hull(np.vstack([np.column_stack([base, 0.0 * base[:, 0]]), top]))
    body.export(tmp_path / "tip.ply")
    boulder = rk.Boulder.from_mesh(tmp_path / "tip.ply", mass=10.0)
    assert max(place[0] for _, place in boulder.feet) == pytest.approx(0.5, abs=1e-6)


def test_a_boulder_rolls_on_its_points_as_on_its_surface(tmp_path):
    """An ellipsoid of half axes a: its centroid is sqrt(sum (a n)^2) above ground of normal n."""
    ball = trimesh.creation.icosphere(subdivisions=4)
    ball.apply_scale([0.5, 0.4, 0.2])
    ball.export(tmp_path / "pebble.ply")
    pebble = rk.Boulder.from_mesh(
        tmp_path / "pebble.ply", mass=100.0, bearing_height=1e-4, settle=True
    )
    assert len(pebble.feet) == MOST_POINTS_IN_SPACE
    points = np.array([(*place, 0.0)[:3] for _, place in pebble.feet]) - pebble.centroid
    for tilt in np.radians([1.0, 3.0, 6.0, 8.0]):
        for d in np.linspace(0.0, 6.0, 13):
            n = np.array([np.sin(tilt) * np.cos(d), np.sin(tilt) * np.sin(d), np.cos(tilt)])
            right = np.linalg.norm(n * [0.5, 0.4, 0.2])
            assert -(points @ n).min() == pytest.approx(right, rel=0.03)


def test_a_fine_surface_is_drawn_coarser_and_keeps_its_size(tmp_path):
    trimesh.creation.icosphere(subdivisions=4).export(tmp_path / "ball.ply")
    feet = {"one": (0.3, 0.0), "two": (-0.2, 0.3), "three": (-0.2, -0.3)}
    statue = rk.LeggedStatue.from_mesh(tmp_path / "ball.ply", mass=10.0, feet=feet)
    shown = statue.solids["body"]
    assert 5120 > 3000 >= len(shown.faces) > 500
    np.testing.assert_allclose(np.linalg.norm(shown.vertices, axis=1), 1.0, atol=0.06)
    assert np.trace(np.array(statue.inertia)) == pytest.approx(3 * 0.4 * 10.0, rel=1e-2)


def test_a_statue_of_a_mesh_is_kept_and_read_again(tmp_path):
    boulder = rk.Boulder.from_mesh(boxed(tmp_path / "box.stl"), density=DENSITY)
    run = rk.simulate(boulder, rk.GroundMotion.none(0.1), initial={"pitch": 0.02})
    run.save(tmp_path / "run.nc")
    read = rk.load(tmp_path / "run.nc").structure
    assert read == boulder
    assert isinstance(read, rk.Boulder)
    assert "<surface of 12 faces>" in repr(read)
    np.testing.assert_array_equal(read.solids["body"].faces, boulder.solids["body"].faces)


def broken(faces: np.ndarray, how: str) -> np.ndarray:
    turned = faces[:, ::-1]
    return {"open": faces[1:], "inside out": turned}.get(how, np.vstack([turned[:1], faces[1:]]))


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("open", r"is not closed, 3 of its 18 edges .* Remedy: close its holes"),
        ("inside out", "is inside out, .* Remedy: flip its normals"),
        ("one face turned", "recompute normals outward"),
    ],
)
@pytest.mark.parametrize("ending", ["stl", "obj"])
def test_a_mesh_that_bounds_no_body_is_refused(how, words, ending, tmp_path):
    body = box(*SIZE)
    path = written(tmp_path / f"bad.{ending}", body.vertices, broken(triangles(body), how))
    with pytest.raises(rk.InputError, match=words) as refused:
        rk.LeggedStatue.from_mesh(path, mass=1.0, feet=FEET)
    assert str(refused.value).startswith(str(path))
    assert refused.value.file == path


@pytest.mark.parametrize(
    ("name", "text", "asked", "words"),
    [
        ("a.ply", "words", {"mass": 1.0}, r"cannot be read \(.*ply file"),
        ("a.stl", "words", {"mass": 1.0}, "has no faces"),
        ("a.step", "", {"mass": 1.0}, "is no mesh by its name. Remedy: give one of stl, obj, ply"),
        ("a.obj", "", {}, "neither mass nor density is given: give one, mass= or density="),
        ("a.obj", "", {"mass": 1.0, "density": 1.0}, "mass and density are both given: give one"),
        ("a.obj", "", {"mass": -1.0}, "mass is -1: give a positive number"),
        ("a.obj", "", {"mass": 1.0, "scale": 0.0}, "scale is 0: give a positive number"),
    ],
)
def test_a_file_that_is_no_mesh_and_numbers_of_none_are_refused(name, text, asked, words, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(rk.InputError, match=words):
        rk.Boulder.from_mesh(tmp_path / name, **asked)


def test_a_boulder_on_its_tip_asks_for_a_greater_height(tmp_path):
    corners = [(0, 0, 0), (1, 0, 1), (0, 1, 1), (-1, -1, 1)]
    path = written(tmp_path / "tip.obj", corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    for height, words in ((0.005, "within which 1 points .* give more"), (0, "a positive height")):
        with pytest.raises(rk.InputError, match=f"bearing_height is {height}.*{words}"):
            rk.Boulder.from_mesh(path, mass=1.0, bearing_height=height)


def test_without_trimesh_the_remedy_is_told(tmp_path, monkeypatch):
    path = boxed(tmp_path / "box.obj")
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ModuleNotFoundError, match=r"trimesh, which is not installed.*\[mesh\]"):
        mesh.read_body(path, 1.0, None, 1.0)
    with pytest.raises(FileNotFoundError, match="there is no such file"):
        mesh.read_body(tmp_path / "none.stl", 1.0, None, 1.0)
