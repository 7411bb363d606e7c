"""`Prism` and `LeggedStatue`: starts, planar limits, symmetries, and what they refuse."""

import numpy as np
import pytest

import rockeom as rk
from tests.space.bodies import NAMES, oriented, spin_rate
from tests.space.cases import GRAVITY, TIGHT, Case

GROUND = ("", "transverse_", "vertical_")
EL_CENTRO = [rk.GroundMotion.from_library(f"El Centro 1940 {way}") for way in ("180", "270", "up")]
HERE = {name: name.split("_")[1] + "_" + name.split("_")[0] for name in NAMES.values()}
"""Names of a prism's corners by those of the tests' declarations."""


def shaking(*components: np.ndarray) -> list[rk.GroundMotion]:
    return [rk.GroundMotion.from_array(a, dt=0.02) for a in components]


def samples() -> list[np.ndarray]:
    """Four seconds of El Centro along x, y and upwards."""
    return [motion.acceleration(np.arange(0.0, 4.0, 0.02)) for motion in EL_CENTRO]


def prism(case: Case, **more) -> rk.Prism:
    sizes = {"width": 2 * case["b"], "depth": 2 * case["c"], "height": 2 * case["h"]}
    return rk.Prism(**sizes, mass=case["m"], gravity=GRAVITY, **more)


def statue(case: Case, **more) -> rk.LeggedStatue:
    feet = {name: tuple(map(float, place)) for name, place in case.given["feet"].items()}
    (height,) = {place[2] for place in feet.values()}
    return rk.LeggedStatue(
        feet={name: place[:2] for name, place in feet.items()}, centroid=(0.0, 0.0, -height),
        mass=case["mass"], inertia=np.array(case.given["inertia"], float), gravity=GRAVITY, **more,
    )  # fmt: skip


STARTS = ["prism_starts_edge", "prism_starts_edge_near_corner", "prism_edge_sticks_shaken"]


@pytest.mark.parametrize("name", [*STARTS, "statue_lifts_front"])
def test_from_a_state_shaken_the_feet_that_press_stay(name):
    case = Case(name)
    body = statue(case) if "feet" in case.given else prism(case)
    names = {n: n for n in case.given.get("feet", {})} or {k: HERE[v] for k, v in NAMES.items()}
    state = oriented(case.given["R"], case.given["omega"])
    pushed = [float(a) for a in case.given["ground_acceleration"]]
    motions = [rk.GroundMotion.from_array([a, a], dt=1e-3) for a in pushed]
    held = {f"{axis}_dot": 0.0 for axis in "xyz"}
    if "edge_sticks" in name:  # about the edge of two corners, which rest
        places = body.positions(state)
        arm = places["body"] - places["north_east"]
        rates = np.cross(np.array(case.given["omega"], float), arm)
        held = {f"{axis}_dot": rate for axis, rate in zip("xyz", rates, strict=True)}
    run = rk.simulate(
        body, motions[0], transverse=motions[1], vertical=motions[2], duration=1e-6,
        initial=state | held, options=TIGHT,
    )  # fmt: skip
    mode = run.final_mode
    presses = [names[k] for k, state_ in case.expected["states"].items() if state_ == "stick"]
    assert sorted(mode.replace("_idle", "").split("_")) == sorted("_".join(presses).split("_"))
    shaking = {f"{way}ground_acceleration": a for way, a in zip(GROUND, pushed, strict=True)}
    moves = body.accelerations(state | held, mode=mode, **shaking)
    forces = body.reactions(state | held, mode=mode, **shaking)
    case.agrees(
        acc_centroid=np.array([moves[axis] for axis in "xyz"]),
        alpha=spin_rate(state, moves),
    )
    for foot, normal in case.expected["normal"].items():
        assert forces[f"{names[foot]}_reaction"] == pytest.approx(float(normal), abs=1e-11)


@pytest.mark.parametrize(
    ("name", "leans"), [("edge_rocking_c", "roll"), ("diagonal_rocking_square_0.3", "")]
)
def test_a_prism_that_leans_in_a_plane_of_symmetry_rocks_as_the_block_of_that_plane(name, leans):
    case = Case(name)
    body = prism(case)
    alpha = float(case.expected["alpha" if leans else "alpha_diagonal"])
    tilt = 0.3 * alpha
    if leans:
        start = {"roll": tilt}
    else:
        c, s = np.cos(tilt), np.sin(tilt)
        u = np.array([-1.0, 1.0, 0.0]) / np.sqrt(2)  # the axis about which it turns
        cross = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
        start = oriented(np.eye(3) + s * cross + (1 - c) * cross @ cross)
    run = rk.simulate(body, rk.GroundMotion.none(1.0), initial=start, options=TIGHT)
    impact = run.impacts[0]
    kinetic = [body.energies(s)["kinetic_energy"] for s in (impact.before, impact.after)]
    case.agrees(quarter_period=impact.time, energy_ratio=kinetic[1] / kinetic[0])


@pytest.mark.parametrize("offset", [0.0, 0.04])
@pytest.mark.parametrize(("way", "half"), [("x", "width"), ("y", "depth")])
def test_shaken_along_an_axis_it_is_the_block_of_a_plane(way, half, offset):
    """Each event of `RigidBlock` or `OffsetBlock` under El Centro and its vertical component."""
    sizes = {"width": 0.5, "depth": 0.7}
    body = rk.Prism(**sizes, height=3.0, mass=1.0, **{f"offset_{way}": offset})
    planar = rk.RigidBlock.from_dimensions(width=sizes[half], height=3.0)
    if offset:
        planar = rk.OffsetBlock(half_width=sizes[half] / 2, half_height=1.5, offset=offset)
    along, up = EL_CENTRO[0], EL_CENTRO[2]
    motions = {"x": [along], "y": [rk.GroundMotion.none(along.duration), along]}[way]
    options = rk.SolverOptions(method="DOP853", rtol=1e-12, atol=1e-15)
    more = {"transverse": motions[1]} if way == "y" else {}
    run = rk.simulate(body, motions[0], vertical=up, options=options, **more)
    expected = rk.simulate(planar, along, vertical=up, options=options)
    times = run.impacts.times
    right = expected.impacts.times
    assert len(right) > 50
    np.testing.assert_allclose(times[:50], right[:50], atol=1e-9)
    angle = run.extremes("pitch" if way == "x" else "roll")
    assert abs(angle.peak) == pytest.approx(abs(expected.extremes("theta").peak), rel=1e-7)


def test_landings_from_corner_to_corner_end_on_the_edge_which_then_jams():
    """Hops too low to be followed leave no slip behind; the jam is that of the shared case."""
    body = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=1.0, gravity=GRAVITY)
    run = rk.simulate(body, 1.5 * EL_CENTRO[0], transverse=1.5 * EL_CENTRO[1], duration=12.0)
    (rest,) = (event for event in run.events if event.kind == "rest" and 2.9 < event.time < 3.5)
    assert (rest.mode_before, rest.mode_after) == ("north_west", "south_west_north_west")
    assert rest.after["yaw_dot"] == pytest.approx(0.0, abs=1e-15)
    jam = next(event for event in run.events if "released" in event.mode_after)
    assert jam.time == pytest.approx(11.4423, abs=1e-4)


def test_a_body_turned_by_any_yaw_moves_alike():
    """Shaken along two turned axes, with the structure turned as far."""
    body = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=1.0)
    turn, start = 0.7, {"pitch": 0.05, "roll": 0.02}
    x, y, up = samples()
    c, s = np.cos(turn), np.sin(turn)
    options = rk.SolverOptions(rtol=1e-12, atol=1e-15)
    times = []
    for yaw, along, across in ((0.0, x, y), (turn, c * x - s * y, s * x + c * y)):
        first, second, third = shaking(along, across, up)
        run = rk.simulate(
            body, first, transverse=second, vertical=third, initial=start | {"yaw": yaw},
            options=options,
        )  # fmt: skip
        times.append(run.events.times[:20])
    np.testing.assert_allclose(*times, atol=1e-10)


def test_a_body_seen_in_a_mirror_moves_as_its_image():
    body = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=1.0)
    x, y, up = samples()
    options = rk.SolverOptions(rtol=1e-12, atol=1e-15)
    times, ends = [], []
    for sign in (1.0, -1.0):  # y, yaw and roll change their signs
        first, second, third = shaking(x, sign * y, up)
        run = rk.simulate(
            body, first, transverse=second, vertical=third, options=options,
            initial={"pitch": 0.05, "roll": sign * 0.02, "yaw": sign * 0.3},
        )  # fmt: skip
        times.append(run.events.times[:20])
        ends.append([run.at(0.5)["pitch"], sign * run.at(0.5)["yaw"]])
    np.testing.assert_allclose(*times, atol=1e-10)
    np.testing.assert_allclose(*ends, atol=1e-10)


TRIPOD = {
    "feet": {"front": (0.02, 0.26), "left": (-0.24, -0.13), "right": (0.22, -0.11)},
    "centroid": (0.0, 0.0, 0.6), "mass": 300.0, "inertia": np.diag([50.0, 45.0, 12.0]),
}  # fmt: skip


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"feet": {"a": (0, 0), "b": (1, 0)}}, "give three or more"),
        ({"feet": {"a": (0, 0), "b": (1, 0), "c": (2, 0)}}, "are on one line"),
        ({"feet": [1.0]}, "a mapping of names to places"),
        ({"feet": {"a": (0, 0, 0, 0), "b": (1, 0), "c": (2, 0)}}, "foot 'a' is .*give 2 finite"),
        ({"feet": {"a": (0, 0, -0.01), "b": (1, 0), "c": (2, 0)}}, "have 'a' below the lowest"),
        ({"feet": {"a": (0, 0, "1"), "b": (1, 0), "c": (2, 0)}}, "foot 'a' is .*give 3 finite"),
        ({"feet": {"a": (0, 0, 0.01), "b": (1, 0), "c": (2, 0)}}, "have 2 of height 0: give three"),
        ({"centroid": (5.0, 5.0, 1.0)}, "not above the area between the feet"),
        ({"centroid": (0.0, 0.0)}, "give 3 finite numbers"),
        ({"inertia": np.diag([1.0, 1.0, 3.0])}, "which no masses have"),
        ({"inertia": [[1, 1, 0], [0, 1, 0], [0, 0, 1]]}, "not symmetric"),
        ({"inertia": np.ones((2, 2))}, r"a tensor \(3, 3\)"),
        ({"friction": -0.1}, "friction is -0.1"),
        ({"restitution": 2.0}, "a ratio of rates, 0 to 1"),
        ({"shape": 3}, r"shape is 3: give vertices, \[\(x, y, z\)"),
        ({"shape": ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 3)])}, "give vertices"),
    ],
)
def test_a_statue_that_cannot_stand_is_refused(changed, words):
    with pytest.raises(ValueError, match=words):
        rk.LeggedStatue(**TRIPOD | changed)


def test_a_prism_whose_centroid_is_beyond_its_base_is_refused():
    with pytest.raises(ValueError, match="not above the area between the feet"):
        rk.Prism(width=0.5, depth=0.7, height=3.0, mass=1.0, offset_x=0.26)


def test_a_yaw_is_no_size_of_a_prism():
    with pytest.raises(TypeError, match="Prism: unknown yaw_degrees"):
        rk.Prism(width=0.5, depth=0.7, height=3.0, mass=1.0, yaw_degrees=60.0)


def test_a_statue_is_kept_and_read_again(tmp_path):
    body = rk.LeggedStatue(**TRIPOD)
    run = rk.simulate(body, rk.GroundMotion.none(0.5), initial={"pitch": 0.05})
    run.save(tmp_path / "run.nc")
    read = rk.load(tmp_path / "run.nc")
    assert read.structure == body
    np.testing.assert_array_equal(read.y, run.y)
    assert "single ones needed" in run.summary()


def test_a_smooth_foot_among_those_that_stick_bears_its_part():
    """By the declaration: each contact has a law of its own."""
    case = Case("statue_one_smooth_foot_rest_stick")
    body = statue(case)
    forces = body.reactions({}, ground_acceleration=0.5, transverse_ground_acceleration=0.3)
    for foot, normal in case.expected["normal"].items():
        assert forces[f"{foot}_reaction"] == pytest.approx(float(normal), abs=1e-11)


@pytest.mark.parametrize("lean", [0.3, 0.2])
def test_a_body_that_falls_at_the_end_of_a_record_has_overturned_about_either_axis(lean):
    """It leans beyond its barrier, or short of it."""
    body = rk.Prism(width=0.5, depth=0.5, height=2.0, mass=100.0)
    falls = lean > body.overturning_tilts(0.0)
    for start in ({"pitch": lean}, {"roll": lean}, {"pitch": -lean}, {"roll": -lean}):
        run = rk.simulate(body, rk.GroundMotion.none(0.05), initial=start)
        assert run.overturned == ("tilt" if falls else "")
        assert ("and falls afterwards" in run.summary()) is bool(falls)
