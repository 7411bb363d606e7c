"""A record, an azimuth, and what a response says: tilt, its direction, the reserve, friction."""

import json

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import minimize_scalar

import rockeom as rk
from rockeom.cli import main
from rockeom.codes import IMPACT
from tests.space.bodies import oriented
from tests.space.test_standing import EL_CENTRO, TRIPOD

SIZES = {"width": 0.5, "depth": 0.7, "height": 3.0}
STATUE = rk.Prism(**SIZES, mass=2000.0)
RECORDING = 1.5 * rk.Recording("El Centro", (EL_CENTRO[0], EL_CENTRO[1]), EL_CENTRO[2])
TIGHT = rk.SolverOptions(method="DOP853", rtol=1e-12, atol=1e-15)
LEANS = {"pitch": 0.05, "roll": 0.02}
DT = 0.02
PUSH = 3.0 * np.sin(2 * np.pi * np.arange(0.0, 2.0, DT))
PUSH = PUSH * (np.arange(len(PUSH)) < 0.5 / DT)  # half a sine [m/s2]


def station(*azimuths: float, of_push: float) -> rk.Recording:
    """What a station records along azimuths while PUSH acts along another, clockwise from north."""
    return rk.Recording("station", tuple(
        rk.GroundMotion.from_array(
            PUSH * np.cos(np.radians(azimuth - of_push)), dt=DT, name=f"station {azimuth:03d}"
        )
        for azimuth in azimuths
    ))  # fmt: skip


def axis(tilt: float, direction: float) -> dict[str, float]:
    """The state of a body without yaw that leans in a direction along its axes."""
    c, s, d = np.cos(tilt), np.sin(tilt), direction
    turned = np.array([[np.cos(d), -np.sin(d), 0], [np.sin(d), np.cos(d), 0], [0, 0, 1]])
    leans = turned @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ turned.T
    yaw, pitch, roll = (oriented(leans)[name] for name in ("yaw", "pitch", "roll"))
    return {"yaw": yaw, "pitch": pitch, "roll": roll}


# -- records ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("azimuths", "turn"),
    [
        ((30, 120), -30.0),  # the push, at 60 degrees from north, is clockwise of the first
        ((120, 30), 60.0),
        ((240, 150), 180.0),
        ((330, 240), -90.0),
    ],
)
def test_a_push_along_the_axis_of_a_turned_statue_is_that_of_the_plane(azimuths, turn):
    run = rk.simulate(STATUE, station(*azimuths, of_push=60.0), azimuth=f"{turn} deg")
    block = rk.RigidBlock.from_dimensions(width=0.5, height=3.0)
    planar = rk.simulate(block, rk.GroundMotion.from_array(PUSH, dt=DT))
    assert run.extremes("roll").peak == pytest.approx(0.0, abs=1e-12)
    expected = planar.extremes("theta").peak
    assert abs(expected) > 0.01
    assert run.extremes("pitch").peak == pytest.approx(expected, rel=1e-9)
    first = run.at(0.4, names=["tilt_direction", "tilt"])
    assert abs(first["tilt_direction"]) == pytest.approx(np.pi)  # it lags behind the push
    ratio = planar.extremes("rotation_ratio")
    least = 1.0 - max(ratio.maximum, -ratio.minimum)
    assert run.extremes("reserve").minimum == pytest.approx(least, rel=1e-8)


def test_an_azimuth_is_a_yaw_through_idle_feet():
    """A foot that idled at rest slipped by rounding, was released, and the statue never fell."""
    x, y, up = (1.5 * motion for motion in EL_CENTRO)
    turned, yawed = (
        rk.simulate(STATUE, x, transverse=y, vertical=up, **at)
        for at in ({"azimuth": "60 deg"}, {"initial": {"yaw_degrees": 60.0}})
    )
    assert turned.outcome is yawed.outcome is rk.Outcome.OVERTURNED
    modes = [[event.mode_after for event in run.events] for run in (turned, yawed)]
    assert modes[0] == modes[1]
    np.testing.assert_allclose(turned.impacts.times, yawed.impacts.times, atol=1e-6)


def test_components_without_azimuths_are_counter_clockwise():
    x, y, up = (rk.GroundMotion.from_array(f * PUSH, dt=DT) for f in (1.0, 2.0, 0.5))
    run = rk.simulate(STATUE, rk.Recording("array", (x, y), up))
    np.testing.assert_array_equal(run.y, rk.simulate(STATUE, x, transverse=y, vertical=up).y)


@pytest.mark.parametrize("factor", [1.0, 2.0])
def test_the_seed_of_a_synthetic_motion_is_no_azimuth(factor):
    one, other = (
        rk.GroundMotion.kanai_tajimi(0.01, duration=1.0, seed=seed).scaled(factor)
        for seed in (100, 190)
    )
    pair = rk.Recording("synthetic", (one, other))
    assert pair.in_space() == (one, other)
    assert len(rk.MotionSet([one, other]).recordings()) == 2
    turned = rk.Recording(
        "turned", tuple(pair.along(a).horizontal[0] for a in (0.3, 0.3 + np.pi / 2))
    )
    assert turned.in_space() == turned.horizontal


def test_the_network_azimuths_of_a_scaled_recording_still_count():
    first, second = RECORDING.in_space()
    np.testing.assert_allclose(second.samples, -1.5 * EL_CENTRO[1].samples, rtol=1e-15)
    assert first == RECORDING.horizontal[0]


@pytest.mark.parametrize("pulse", [True, False])
def test_a_pair_of_motions_is_turned_as_vectors_are(pulse):
    x = rk.GroundMotion.single_sine(3.0, 0.8, duration=2.0) if pulse else EL_CENTRO[0]
    y = None if pulse else rk.GroundMotion.from_array(PUSH, dt=DT)  # of another step and length
    run = rk.simulate(STATUE, x, transverse=y, azimuth=0.4, duration=1.5)
    t = np.arange(0.0, 1.5, 0.0137)
    along, across = x.acceleration(t), 0.0 if y is None else y.acceleration(t)
    names = ["ground_acceleration", "transverse_ground_acceleration"]
    turned = run.at(t, names=names)
    c, s = np.cos(0.4), np.sin(0.4)
    np.testing.assert_allclose(turned[names[0]], c * along + s * across, atol=1e-13)
    np.testing.assert_allclose(turned[names[1]], c * across - s * along, atol=1e-13)
    assert run.energy_balance().error < 1e-11


BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)
X = RECORDING.horizontal[0]


@pytest.mark.parametrize(
    ("structure", "motion", "more", "words"),
    [
        (STATUE, rk.Recording("one", (X,)), {}, "one horizontal component, and a structure in"),
        (STATUE, station(0, 45, of_push=0), {}, "two components at no right angle"),
        (STATUE, RECORDING, {"transverse": X}, "transverse is given along with the recording"),
        (STATUE, RECORDING, {"vertical": X}, "vertical is given along with the recording"),
        (STATUE, X, {"azimuth": "north"}, 'radians, or a text such as "30 deg"'),
        (STATUE, X, {"azimuth": np.inf}, "azimuth is inf"),
        (STATUE, X, {"initial": {"yaw_dot": 0.1}}, "leave x_dot, y_dot and yaw_dot out, or give"),
        (STATUE, X, {"impact": "newton"}, "leave impact= out; and give restitution= to Prism"),
        (BLOCK, X, {"azimuth": 0.3}, "RigidBlock moves in a plane: leave azimuth= out"),
        (BLOCK, RECORDING, {}, "a plane structure takes one"),
    ],
)
def test_what_leaves_the_directions_open_is_refused(structure, motion, more, words):
    with pytest.raises((ValueError, TypeError), match=words):
        rk.simulate(structure, motion, **more)


def test_no_impact_ends_a_mode_that_is_a_code_of_digits():
    assert not STATUE.has_impacts
    assert not any(IMPACT in kinds for kinds in STATUE.module.KINDS)


def test_two_formulas_on_a_turned_structure_are_refused():
    pulse = rk.GroundMotion.single_sine(3.0, 0.8, duration=2.0)
    with pytest.raises(ValueError, match="one of them is a formula"):
        rk.simulate(STATUE, pulse, transverse=pulse, azimuth=0.3)


# -- symmetries ------------------------------------------------------------------------------------


def times(*arguments, structure=STATUE, **more) -> np.ndarray:
    run = rk.simulate(structure, *arguments, options=TIGHT, **more)
    assert len(run.events) > 20
    return run.events.times[:20]


def test_an_azimuth_is_a_yaw_of_the_structure():
    turned = times(RECORDING, azimuth=0.7, initial=LEANS, duration=6.0)
    yawed = times(RECORDING, initial=LEANS | {"yaw": 0.7}, duration=6.0)
    np.testing.assert_allclose(turned, yawed, atol=1e-10)


def test_half_a_turn_of_a_prism_names_its_corners_anew():
    turned = times(
        RECORDING, azimuth="180 deg", initial={n: -x for n, x in LEANS.items()}, duration=6.0
    )
    np.testing.assert_allclose(turned, times(RECORDING, initial=LEANS, duration=6.0), atol=1e-10)


def test_a_model_at_scale_moves_as_slowly_as_the_root_of_its_size():
    size = 2.5
    slower = np.sqrt(size)
    large = rk.Prism(**{name: size * x for name, x in SIZES.items()}, mass=1.0)
    scaled = times(
        RECORDING.scaled(time=slower), structure=large, azimuth=0.7, initial=LEANS,
        duration=6.0 * slower,
    )  # fmt: skip
    right = times(RECORDING, azimuth=0.7, initial=LEANS, duration=6.0)
    np.testing.assert_allclose(scaled / slower, right, atol=1e-10)


def test_weight_is_a_rise_of_the_ground():
    heavy = rk.Prism(**SIZES, mass=2000.0, gravity=STATUE.gravity + 2.0)
    x, y = RECORDING.in_space()
    up = RECORDING.vertical
    rising = rk.GroundMotion.from_array(up.samples + 2.0, dt=up.dt)
    more = {"transverse": y, "azimuth": 0.7, "initial": LEANS, "duration": 6.0}
    right = times(x, structure=heavy, vertical=up, **more)
    np.testing.assert_allclose(times(x, vertical=rising, **more), right, atol=1e-10)


# -- the lean and the barrier ----------------------------------------------------------------------

TABLE = {  # four legs, of which one stands out; the centroid is off their middle
    "feet": {"a": (0.4, 0.3), "b": (-0.2, 0.35), "c": (-0.3, -0.25), "d": (0.2, -0.2)},
    "centroid": (0.03, 0.02, 0.9), "mass": 50.0, "inertia": np.diag([9.0, 8.0, 6.0]),
}  # fmt: skip
ROUND = {  # three feet, and three outside that touch as it leans
    "feet": {
        "a": (0.18, 0.02), "b": (-0.1, 0.16), "c": (-0.12, -0.15),
        "d": (0.3, 0.05, 0.015), "e": (-0.17, 0.28, 0.02), "f": (-0.2, -0.26, 0.01),
    },
    "centroid": (0.0, 0.0, 0.6), "mass": 300.0, "inertia": np.diag([50.0, 45.0, 12.0]),
}  # fmt: skip
BODIES = {
    "prism": STATUE,
    "off its centre": rk.Prism(**SIZES, mass=1.0, offset_x=0.1, offset_y=-0.2, centroid_height=1.1),
    "tripod": rk.LeggedStatue(**TRIPOD),
    "table": rk.LeggedStatue(**TABLE),
    "round": rk.LeggedStatue(**ROUND),
}


def weight_over(body, tilt: float, direction: float) -> float:
    """Gravitational energy of a body that stands at rest on its lowest foot [J]."""
    return body.energies(axis(tilt, direction))["gravitational_energy"]


@pytest.mark.parametrize("name", BODIES)
def test_the_barrier_is_where_the_weight_is_highest(name):
    body = BODIES[name]
    for direction in np.linspace(-3.0, 3.0, 9):
        highest = minimize_scalar(
            lambda tilt, d=direction: -weight_over(body, tilt, d), bounds=(0.01, 1.2),
            method="bounded", options={"xatol": 1e-9},
        )  # fmt: skip
        (tilt,) = body.overturning_tilts(direction)
        assert highest.x == pytest.approx(tilt, abs=1e-6)


def test_feet_above_the_centroid_are_no_barrier_and_rounding_is_no_height():
    (level,) = BODIES["tripod"].overturning_tilts(0.3)
    high = TRIPOD["feet"] | {"high": (-0.5, 0.0, 0.7), "as_high": (0.5, 0.0, 0.6)}
    raised = rk.LeggedStatue(**TRIPOD | {"feet": high})
    assert raised.overturning_tilts(0.3) == pytest.approx([level])
    rounded = {name: (*at, rise) for (name, at), rise in zip(
        TRIPOD["feet"].items(), (0.3 - 0.1 - 0.2, 0.0, 3e-17), strict=True)}  # fmt: skip
    flat = rk.LeggedStatue(**TRIPOD | {"feet": rounded})
    assert flat.overturning_tilts(0.3) == pytest.approx([level])


def test_uneven_feet_are_as_level_ones_where_they_are_level_and_as_none_where_they_never_touch():
    inner = {name: at for name, at in ROUND["feet"].items() if len(at) == 2}
    lean = axis(0.08, 0.5)
    for feet, rise in ((inner, 0.3), (ROUND["feet"], 0.0)):
        level = {name: at[:2] for name, at in feet.items()}
        raised = {
            name: (*at[:2], rise if len(at) > 2 else 0.0) for name, at in ROUND["feet"].items()
        }
        one, other = (
            rk.simulate(
                rk.LeggedStatue(**ROUND | {"feet": places}), RECORDING, initial=lean, duration=0.3,
                options=rk.SolverOptions(rtol=1e-11, atol=1e-13),
            )
            for places in (level, raised)
        )  # fmt: skip
        assert len(one.events) == len(other.events) > 0
        for name in ("pitch", "roll", "yaw"):
            np.testing.assert_allclose(one[name][-1], other[name][-1], atol=1e-9)


def test_the_stability_surface_of_a_prism_is_its_closed_form():
    b, c, h = (SIZES[name] / 2 for name in ("width", "depth", "height"))
    d = np.linspace(-np.pi, np.pi, 37)
    right = np.arctan((b * np.abs(np.cos(d)) + c * np.abs(np.sin(d))) / h)
    np.testing.assert_allclose(STATUE.overturning_tilts(d), right, rtol=1e-14)


@pytest.mark.parametrize("name", sorted(BODIES.keys() - {"round"}))
def test_the_saddle_is_over_the_edge_nearest_to_the_centroid(name):
    body = BODIES[name]
    places = body.positions({})
    feet = np.array([(places[foot] - places["body"])[:2] for foot in body.module.POINTS])
    edges = []  # distances and directions of lines through feet, all others on one side
    for i, j in np.ndindex(len(feet), len(feet)):
        normal = np.array([feet[j] - feet[i]]) @ [[0.0, -1.0], [1.0, 0.0]]
        beyond = (feet - feet[i]) @ normal[0]
        if i != j and beyond.max() <= 1e-12:
            distance = feet[i] @ normal[0] / np.linalg.norm(normal)
            edges.append((distance, np.arctan2(*normal[0, ::-1])))
    d = np.linspace(-np.pi, np.pi, 3601)
    height = (places["body"] - places[body.module.POINTS[0]])[2]
    saddle = np.arctan(min(edges)[0] / height)
    assert body.overturning_tilts(d).min() >= saddle
    assert body.overturning_tilts(min(edges)[1]) == pytest.approx(saddle)


@pytest.mark.parametrize("name", BODIES)
def test_a_body_with_less_energy_than_the_saddle_stays_up(name):
    """Let go beside the barrier over its lowest edge, to either side."""
    body = BODIES[name]
    d = np.linspace(-np.pi, np.pi, 3601)
    tilts = body.overturning_tilts(d)
    lowest = d[tilts.argmin()]
    still = rk.GroundMotion.none(10.0)
    for part, outcome in ((0.98, False), (1.02, True)):
        run = rk.simulate(body, still, initial=axis(part * tilts.min(), lowest))
        assert (run.outcome.value == "overturned") is outcome
        assert run["reserve"][0] == pytest.approx(1.0 - part, abs=1e-3)


def test_a_body_over_its_corner_may_fall_over_the_edge_beside_it():
    corner = np.arctan2(0.35, 0.25) - 0.1  # nearer to the east, the lower edge
    (tilt,) = STATUE.overturning_tilts(corner)
    run = rk.simulate(STATUE, rk.GroundMotion.none(20.0), initial=axis(0.98 * tilt, corner))
    assert run.outcome.value == "overturned"
    assert run["reserve"][0] == pytest.approx(0.02)


def test_the_lean_is_that_of_the_axis(tmp_path):
    run = rk.simulate(STATUE, RECORDING, azimuth=0.5, initial=LEANS | {"yaw": 0.3}, duration=4.0)
    (turned,) = run.places.rotations().values()
    up = turned[:, :, 2]
    tilted = run["tilt"] > 1e-6
    np.testing.assert_allclose(np.cos(run["tilt"]), up[:, 2], atol=1e-15)
    size = np.hypot(up[:, 0], up[:, 1])
    for part, of in zip((up[:, 0], up[:, 1]), (np.cos, np.sin), strict=True):
        right = part[tilted] / size[tilted]
        np.testing.assert_allclose(of(run["tilt_direction"][tilted]), right, atol=1e-9)
    table = run.to_xarray(["tilt", "tilt_direction", "reserve", "yaw"])
    assert (table.tilt.units, table.reserve.units) == ("rad", "1")
    assert run.to_dataframe(["reserve"]).reserve.min() < 1.0
    run.save(tmp_path / "run.nc")
    read = rk.load(tmp_path / "run.nc")
    assert read.azimuth == 0.5
    for name in ("tilt", "reserve", "transverse_ground_acceleration"):
        np.testing.assert_array_equal(read[name], run[name])
    assert read.summary() == run.summary()


def test_the_summary_has_azimuth_tilt_direction_and_reserve():
    run = rk.simulate(STATUE, RECORDING, azimuth="30 deg", initial=LEANS, duration=4.0)
    tilt, reserve = run.extremes("tilt"), run.extremes("reserve").minimum
    text = run.summary()
    assert "at an azimuth of 0.5236 rad (30 degrees)" in text
    assert f"Largest tilt: {tilt.maximum:.4g} rad" in text
    assert f"at {tilt.maximum_time:.4g} s" in text
    assert f"Reserve: {100 * reserve:.3g} %." in text
    samples = rk.simulate(STATUE, RECORDING, duration=1.0, keep="samples")
    assert "Largest |pitch|" in samples.summary()  # whose extremes were found with the samples


def test_bodies_that_nothing_but_feet_hold_have_a_reserve():
    with pytest.raises(ValueError, match="not one body on level feet in space"):
        BLOCK.overturning_tilts(0.0)
    assert "reserve" not in rk.simulate(BLOCK, rk.GroundMotion.none(1.0)).names


# -- friction --------------------------------------------------------------------------------------


def test_in_a_plane_single_feet_need_what_all_need():
    run = rk.simulate(STATUE, RECORDING.horizontal[0], vertical=RECORDING.vertical, duration=8.0)
    demand = run.support.friction_demand
    assert demand > 0.1
    assert run.support.foot_friction_demand == pytest.approx(demand, rel=1e-9)


def test_single_feet_share_a_force_along_their_edge_as_they_can():
    """Against all shares, in steps, at each sample."""
    run = rk.simulate(STATUE, RECORDING, azimuth=0.5, duration=3.3)
    feet = STATUE.module.POINTS
    forces = np.array([[run[f"{foot}_friction_{x}"] for x in "xy"] for foot in feet])
    normal = np.array([run[f"{foot}_reaction"] for foot in feet])
    places = np.array([run.places.positions()[foot][:, :2].T for foot in feet])
    needed = [0.0]
    for k in np.flatnonzero((np.hypot(*forces.transpose(1, 0, 2)) > 1e-3).sum(axis=0) < 3):
        i, *other = np.flatnonzero(np.hypot(*forces[:, :, k].T) > 1e-3)
        if not other:
            needed.append(np.hypot(*forces[i, :, k]) / normal[i, k])
            continue
        (j,) = other
        line = places[j, :, k] - places[i, :, k]
        shares = np.linspace(-3e3, 3e3, 6001)[:, None] * line / np.linalg.norm(line)
        of_both = (
            np.hypot(*(forces[i, :, k] + shares).T) / normal[i, k],
            np.hypot(*(forces[j, :, k] - shares).T) / normal[j, k],
        )
        needed.append(np.maximum(*of_both).min())
    assert run.support.foot_friction_demand == pytest.approx(max(needed), rel=2e-2)
    assert max(needed) > 1.2 * run.support.friction_demand


def test_a_foot_that_jams_could_be_held_by_no_friction():
    run = rk.simulate(STATUE, RECORDING, duration=20.0)
    assert any(event.kind == "released" for event in run.events)
    assert run.support.foot_friction_demand == np.inf
    assert "none would have held single ones" in run.summary()


# -- sweeps and derivatives ------------------------------------------------------------------------


def test_a_sweep_over_azimuths_and_recordings_is_its_motions():
    weaker = 0.8 * RECORDING
    case = rk.Case(STATUE, RECORDING, duration=4.0, initial=LEANS)
    sweep = rk.simulate_many(
        case, over={"motion": [RECORDING, weaker], "azimuth_degrees": [0.0, 40.0]},
        quantities=["tilt", "reserve"],
    )  # fmt: skip
    assert sweep.azimuth_degrees.units == "degree"
    for i, recording in enumerate((RECORDING, weaker)):
        for j, azimuth in enumerate(("0 deg", "40 deg")):
            run = rk.simulate(
                STATUE, recording, azimuth=azimuth, duration=4.0, initial=LEANS
            )  # fmt: skip
            least = sweep.minimum_quantity[i, j].sel(quantity="reserve")
            assert float(least) == run.extremes("reserve").minimum


def test_many_azimuths_at_once_are_those_one_by_one():
    azimuths = np.linspace(0.0, 3.0, 14)
    case = rk.Case(STATUE, RECORDING, duration=2.0, initial=LEANS)
    sweep = rk.simulate_many(case, over={"azimuth": azimuths})
    for azimuth, peak in zip(azimuths, sweep.peak.sel(state="roll").values, strict=True):
        run = rk.simulate(STATUE, RECORDING, azimuth=azimuth, duration=2.0, initial=LEANS)
        assert abs(run.extremes("roll").peak) == pytest.approx(peak, rel=1e-9)


NUMBERS = {"azimuth": 0.5, "width": 0.5, "scale": 1.0, "initial roll": 0.02}
RESULTS = ("tilt at 2.0", "tilt_direction at 2.0", "least reserve", "end yaw", "impact 3 time")


@pytest.mark.parametrize("laws", [{}, {"friction": 0.0}, {"friction": 0.0, "restitution": 0.4}])
def test_derivatives_through_impacts_are_those_of_differences(laws):
    def case(azimuth, width, scale, roll):
        body = rk.Prism(width=width, depth=0.7, height=3.0, mass=2000.0, **laws)
        start = {"pitch": 0.05, "roll": roll}
        return rk.Case(body, scale * RECORDING, azimuth=azimuth, initial=start, duration=2.5)

    def results(**changed):
        run = rk.simulate(case(*(NUMBERS | changed).values()), options=TIGHT)
        at = run.at(2.0, names=["tilt", "tilt_direction"])
        reserve = run.extremes("reserve").minimum
        found = at["tilt"], at["tilt_direction"], reserve, run.final["yaw"], run.impacts[2].time
        return np.array(found, float)

    slopes = rk.sensitivity(case(*NUMBERS.values()), of=RESULTS, to=[*NUMBERS], options=TIGHT)
    np.testing.assert_allclose(slopes.values, results(), rtol=1e-9, atol=1e-12)
    h = 1e-6
    differences = np.array([
        (results(**{n: x + h}) - results(**{n: x - h})) / (2 * h) for n, x in NUMBERS.items()
    ]).T  # fmt: skip
    largest = np.abs(differences).max(axis=1, keepdims=True)
    np.testing.assert_allclose(slopes.derivatives / largest, differences / largest, atol=1e-4)


def test_derivatives_pass_uplift_idle_feet_jams_corners_and_rest():
    def case(width):
        body = rk.Prism(width=width, depth=0.7, height=3.0, mass=2000.0)
        return rk.Case(
            body, 1.5 * rk.Recording("El Centro", EL_CENTRO[:2], EL_CENTRO[2]), duration=4.0
        )

    kinds = {event.kind for event in rk.simulate(case(0.5), options=TIGHT).events}
    assert {"idle", "lifting", "landing", "released", "rest"} <= kinds
    slopes = rk.sensitivity(
        case(0.5), of=["end tilt", "end yaw", "tilt at 0.5"], to=["width"], options=TIGHT
    )
    h = 1e-6
    ends = [rk.simulate(case(0.5 + x), options=TIGHT) for x in (h, -h)]
    tilts, yaws = ([run.at(4.0, names=[n])[n] for run in ends] for n in ("tilt", "yaw"))
    right = [(tilts[0] - tilts[1]) / (2 * h), (yaws[0] - yaws[1]) / (2 * h), 0.0]
    np.testing.assert_allclose(slopes.derivatives[:, 0], right, rtol=1e-3)


def test_what_has_no_derivative_is_refused():
    case = rk.Case(STATUE, RECORDING, duration=1.0, initial=LEANS)
    with pytest.raises(ValueError, match="there are derivatives of"):
        rk.sensitivity(case, of=["peak north_east_reaction"], to=["azimuth"])


def test_derivatives_of_a_motion_in_which_a_slip_turns_are_refused():
    """They were wrong by a fifth, or NaN, at the end of a slip."""
    body = rk.Prism(width=0.5, depth=0.7, height=2.0, mass=1000.0, friction=0.3)
    case = rk.Case(body, 2 * RECORDING, azimuth=0.4, initial=LEANS, duration=0.39)
    with pytest.raises(ValueError, match=r"a point slips from 0.* s, in mode .*Take differences"):
        rk.sensitivity(case, of=["end tilt"], to=["azimuth"])


# -- sets and files of recordings ------------------------------------------------------------------


def peer_file(path, title: str, values) -> None:
    lines = [
        "PEER NGA STRONG MOTION DATABASE RECORD",
        title,
        "ACCELERATION TIME SERIES IN UNITS OF G",
    ]
    lines += [f"NPTS= {len(values)}, DT= {DT:.4f} SEC", *(f"{x:.9E}" for x in values)]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Files of two stations, in the names of which there is no azimuth, as their titles have it."""
    place = tmp_path_factory.mktemp("records")
    for number, station in ((1, "STA"), (2, "STB")):
        for end, component in (("-hor1", "180"), ("-hor2", "270"), ("-UP", "UP")):
            values = number * 0.02 * np.roll(PUSH, len(component) + number)
            title = f"Somewhere, 1/1/2001, {station}, {component}"
            peer_file(place / f"RSN{number}_QUAKE_{station}{end}.AT2", title, values)
    return place


def test_a_folder_gives_recordings_whose_titles_tell_which_way_they_turn(folder):
    one, other = rk.MotionSet.from_folder(folder, components="all").recordings()
    for recording in (one, 2.0 * other):
        first, second = recording.in_space()
        assert first.name[0] != "-"
        assert second.name[0] == "-"  # 270 is clockwise of 180
        np.testing.assert_array_equal(-second.samples, recording.horizontal[1].samples)
    again = rk.Recording("mirrored before", one.in_space(), one.vertical)
    assert again.in_space() == one.in_space()


def test_a_recording_of_the_library_is_that_of_its_components():
    recording = rk.Recording.from_library("El Centro 1940")
    assert {*recording.horizontal} == {*EL_CENTRO[:2]}
    assert recording.vertical == EL_CENTRO[2]
    with pytest.raises(rk.InputError, match="several recordings"):
        rk.Recording.from_library("El Centro")


def test_a_sweep_joins_no_components_of_different_recordings(folder):
    motions = rk.MotionSet.from_folder(folder, components="all")
    case = rk.Case(STATUE, motions.recordings()[0])
    with pytest.raises(rk.InputError, match=r"MotionSet.recordings\(\)"):
        rk.simulate_many(case, over={"motion": motions})


def test_a_store_of_a_sweep_in_space_is_read_as_it_was_made(tmp_path, folder):
    recordings = rk.MotionSet.from_folder(folder, components="all").recordings()
    case = rk.Case(STATUE, recordings[0], initial=LEANS, duration=1.0)
    over = {"motion": recordings, "azimuth_degrees": [0.0, 40.0]}
    plain = rk.simulate_many(case, over=over, quantities=["reserve"])
    for _ in range(2):  # made, and read
        stored = rk.simulate_many(
            case, over=over, quantities=["reserve"],
            sweep_options=rk.SweepOptions(store=tmp_path / "store"),
        )  # fmt: skip
        assert stored.identical(plain)
    plain.to_netcdf(tmp_path / "sweep.nc")
    with xr.open_dataset(tmp_path / "sweep.nc") as read:
        assert read.motion.values.tolist() == [one.name for one in recordings]
        np.testing.assert_array_equal(read.minimum_quantity, plain.minimum_quantity)
        np.testing.assert_array_equal(read.final_mode, plain.final_mode)


# -- on the command line ---------------------------------------------------------------------------

SET = ["--set", "width=0.5", "depth=0.7", "height=3.0", "mass=2000"]


def command(capsys, *words) -> tuple[int, str]:
    code = main([str(word) for word in words])
    said = capsys.readouterr()
    return code, " ".join((said.out + said.err).split())


def test_simulate_takes_all_components_of_files_and_of_the_library(folder, tmp_path, capsys):
    files = [folder / f"RSN1_QUAKE_STA{end}.AT2" for end in ("-hor1", "-hor2", "-UP")]
    more = ["--azimuth", "40deg", "--pga", "0.3g", "--out", tmp_path / "out", "--format", "npz"]
    code, said = command(capsys, "simulate", "prism", *SET, "--motion", *files, *more)
    assert code == 0
    assert "at an azimuth of 0.6981 rad (40 degrees)" in said
    recording = rk.Recording.read(*files)
    run = rk.simulate(STATUE, recording.scaled_to(pga="0.3 g"), azimuth="40 deg")
    assert f"Largest tilt: {run.extremes('tilt').maximum:.4g} rad" in said
    with np.load(tmp_path / "out" / "response.npz") as written:
        assert written["tilt"].max() == pytest.approx(run["tilt"].max(), rel=1e-6)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert summary["azimuth"] == pytest.approx(np.radians(40.0))
    assert summary["transverse"]["name"].startswith("-RSN1")
    assert summary["reserve"]["reserve"] == pytest.approx(run.extremes("reserve").minimum)
    more = ["--record", "El", "Centro", "1940", "--duration", "2", "--acceleration-scale", "1.5"]
    code, said = command(capsys, "simulate", "prism", *SET, *more)
    assert code == 0
    run = rk.simulate(STATUE, RECORDING, duration=2.0)
    assert f"Largest tilt: {run.extremes('tilt').maximum:.4g} rad" in said


def test_columns_of_text_are_x_y_and_upwards(tmp_path, capsys):
    files = [tmp_path / f"{name}.txt" for name in "xyz"]
    for k, file in enumerate(files):
        np.savetxt(file, (k + 1) * PUSH)
    more = ["--motion", *files, "--dt", DT, "--units", "m/s2"]
    code, said = command(capsys, "simulate", "prism", *SET, *more)
    x, y, up = (rk.GroundMotion.from_array((k + 1) * PUSH, dt=DT) for k in range(3))
    run = rk.simulate(STATUE, x, transverse=y, vertical=up)
    assert code == 0
    assert f"Largest tilt: {run.extremes('tilt').maximum:.4g} rad" in said


def test_sweep_and_assess_turn_the_structure(folder, tmp_path, capsys):
    files = [folder / f"RSN2_QUAKE_STB{end}.AT2" for end in ("-hor1", "-hor2", "-UP")]
    more = ["--pga", "0.3g", "--over", "azimuth_degrees=0,40,80", "--out", tmp_path / "sweep"]
    code, said = command(capsys, "sweep", "prism", *SET, "--motion", *files, *more)
    assert code == 0
    rows = (tmp_path / "sweep" / "sweep.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0].endswith("largest tilt [rad],least reserve")
    recording = rk.Recording.read(*files).scaled_to(pga="0.3 g")
    run = rk.simulate(STATUE, recording, azimuth="40 deg")
    assert float(rows[2].split(",")[-1]) == pytest.approx(run.extremes("reserve").minimum)
    assert (tmp_path / "sweep" / "sweep.png").exists()
    more = ["--pga", "0.3g", "--azimuths", "0deg", "40deg"]
    code, said = command(capsys, "assess", "prism", *SET, "--motion", folder, *more)
    assert code == 0
    assert "under 2 records" in said
    assert "at 2 azimuths, from 0 degrees to 40 degrees" in said
    assert "Vertical shaking: that of 4 of 4 motions" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("simulate prism SET --record El Centro 1940 --azimuth 30", '--azimuth is \'30\''),
        ("assess prism SET --records El Centro 1940 --pga 0.3g --azimuths north",
         "rockeom assess: --azimuths is 'north'"),
        ("simulate rigid_block BLOCK --record El Centro 1940 180 --azimuth 30deg",
         "RigidBlock moves in a plane: leave --azimuth out"),
        ("simulate rigid_block BLOCK --motion a.at2 b.at2", "--motion has 2 files"),
        ("simulate prism SET --record El Centro 1940 --slope 5deg", "its ground is level"),
        ("assess prism SET --records El Centro 1940 180 --pga 0.3g", "takes two: add the other"),
        ("assess rigid_block BLOCK --records El Centro 1940 180 --azimuths 4",
         "it moves in a plane: leave them out"),
    ],
)  # fmt: skip
def test_commands_say_what_to_type_instead(words, said, capsys):
    block = ["--set", "half_width=0.25", "half_height=1.5"]
    typed = [w for word in words.split() for w in {"SET": SET, "BLOCK": block}.get(word, [word])]
    code, printed = command(capsys, *typed)
    assert code == 2
    assert said in printed


def test_models_explains_a_prism_in_few_lines(capsys):
    code, _ = command(capsys, "models")
    assert code == 0
    assert main(["models", "prism"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) < 160
    for name in rk.Prism.defaults():
        assert sum(line.startswith(f"{name} ") for line in lines) == 1
