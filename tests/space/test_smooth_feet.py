"""Prisms and tripods on feet without friction: forces, landings, impacts, the end of bounces."""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import nnls

import rockeom as rk
from rockeom.symbolic import Model, Rigid, Spring, internal_variable, space
from rockeom.symbolic.model import Tilt
from tests.space.bodies import (
    ANGLES,
    CORNERS,
    FRAME,
    MASS,
    NAMES,
    PLACE,
    TRIPOD,
    G,
    energy_ratio,
    impact_agrees,
    model,
    on_feet,
    oriented,
    prism,
    spin,
    spin_rate,
)  # fmt: skip
from tests.space.cases import GRAVITY, TIGHT, Case, of_group

IMPACTS = [name for name in of_group("prism impact") if "frictionless" in name]
IMPACTS += ["smooth_impact_S_dir20"]
HALF = sp.Rational(1, 2)


def started(case: Case, rotation: str, spin=(0, 0, 0)) -> dict[str, float]:
    return oriented(case.given[rotation], spin)


def test_a_prism_at_rest_on_a_smooth_corner_presses_and_turns_as_newton_and_euler_have_it():
    case = Case("smooth_corner_rest_A_dir30")
    block, state = prism(case.given), started(case, "R")
    mode = NAMES[case.given["corner"]]
    found = block.accelerations(state, mode=mode)
    at_rest = dict.fromkeys(("yaw_dot", "pitch_dot", "roll_dot"), 0.0)
    case.agrees(
        normal_force=block.reactions(state, mode=mode)[f"{mode}_reaction"],
        alpha=spin_rate(state | at_rest, found),
        centroid_height=block.positions(state)["prism"][2],
    )


def test_a_prism_falls_about_a_smooth_corner_until_another_lands():
    case = Case("smooth_to_first_impact_S_dir20")
    block = prism(case.given)
    run = rk.simulate(block, rk.GroundMotion.none(0.2), initial=started(case, "R0"), options=TIGHT)
    assert run.events[0].mode_before == NAMES[case.given["corner"]]
    landing = next(e for e in run.events if e.kind == "landing")
    assert landing.contact == NAMES[case.expected["landing"][0]]
    before = landing.before
    rotation = block.rotations(before)["prism"]
    case.agrees(
        time=landing.time,
        centroid_height=before["z"],
        centroid_vertical_velocity=before["z_dot"],
        body_axis=rotation[:, 2],
        body_x=rotation[:, 0],
        omega=spin(before),
    )


@pytest.mark.parametrize("name", IMPACTS)
def test_an_impact_of_smooth_corners_leaves_the_velocities_of_the_one_set_that_fits(name):
    case = Case(name)
    impact_agrees(case, prism(case.given))


def test_a_tripod_lands_on_one_foot_after_the_other():
    case = Case("smooth_tripod_sequence")
    block = prism(case.given, TRIPOD)
    run = rk.simulate(block, rk.GroundMotion.none(1.0), initial=started(case, "R0"), options=TIGHT)
    landings = run.impacts[: len(case.expected["times"])]
    assert [e.contact for e in landings] == case.expected["lands"]
    case.agrees(
        times=[e.time for e in landings],
        energy_ratios=[energy_ratio(block, e) for e in landings],
        omega_after=[spin(e.after) for e in landings],
        body_axis=[block.rotations(e.after)["prism"][:, 2] for e in landings],
    )
    assert run.outcome.name == "COMPLETED"


# -- more feet than three: idle ones, and how they share the load ----------------------------------


def shares(places: np.ndarray, mass: float) -> np.ndarray:
    """Forces of least squares without tension under a body at rest, by its statics alone."""
    rows = np.vstack([np.ones(len(places)), places.T])
    forces, _ = nnls(
        np.vstack([1e6 * rows, np.eye(len(places))]),
        np.concatenate([1e6 * np.array([mass * GRAVITY, 0.0, 0.0]), np.zeros(len(places))]),
    )
    return forces


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.1, 0.05), (0.15, 0.25), (0.24, 0.1)])
def test_feet_share_the_load_as_equal_springs_and_those_that_would_pull_are_idle(offset):
    """An uneven pentagon under a centroid that is not above its middle."""
    places = np.array([(0.4, 0.1), (0.15, 0.5), (-0.35, 0.3), (-0.3, -0.4), (0.25, -0.45)])
    feet = {f"f{i}": (*(place - offset).tolist(), -1.0) for i, place in enumerate(places)}
    statue = on_feet(feet)
    run = rk.simulate(statue, rk.GroundMotion.none(0.1))
    bears = np.array([run[f"{name}_reaction"][-1] for name in feet])
    right = shares(places - offset, 2.0)
    np.testing.assert_allclose(bears, right, atol=1e-6 * right.max())
    idle = [name for name, force in zip(feet, right, strict=True) if force < 1e-9]
    assert [name for name in feet if f"{name}_idle" in run.final_mode] == idle
    np.testing.assert_allclose(run.final["z"], 1.0, rtol=1e-15)


def test_an_idle_foot_bears_again_where_the_load_comes_back():
    """Springs along x and y pull at a height: the load moves along the diagonal of a square.

    By 0.8 of the way to a foot and back, as cos(2 t): beyond a half the foot behind would pull.
    """
    feet = {f"f{i}": (x, y, -1.0) for i, (x, y) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)])}
    at = FRAME.at((0, 0, 0.8 * 2 * GRAVITY / 8))
    springs = [Spring(f"to_{axis}", at[i], stiffness=sp.Integer(8)) for i, axis in enumerate("xy")]
    statue = on_feet(feet, springs)
    run = rk.simulate(
        statue, rk.GroundMotion.none(3.0), initial={"x": 1.0, "y": 1.0}, options=TIGHT
    )
    turns = [np.arccos(0.625), np.pi - np.arccos(0.625)]
    times = np.array([*turns, turns[0] + np.pi, turns[1] + np.pi]) / 2
    assert [e.kind for e in run.events] == ["idle", *["bears again", "idle"] * 2]
    assert [e.contact for e in run.events] == ["f0", "f0", "f2", "f2", "f0"]
    np.testing.assert_allclose(run.events.times, [0.0, *times], atol=1e-12)
    np.testing.assert_allclose(run["vertical_reaction"], 2 * GRAVITY, rtol=1e-12)


# -- falls, files, derivatives, declarations -------------------------------------------------------


def leaning(**more):
    return {"pitch": 0.05, "roll": 0.02} | more


def block(half_width: float = 0.25):
    return prism({"m": 2, "b": half_width, "c": 0.35, "h": 1.5})


def test_a_prism_that_falls_over_a_corner_ends_at_its_tilt():
    statue = block()
    run = rk.simulate(statue, rk.GroundMotion.none(9.0), initial=leaning(pitch=0.2, roll=0.3))
    assert run.outcome is rk.Outcome.OVERTURNED
    assert (run.events[-1].kind, run.events[-1].contact) == ("bound", "tilt")
    axis = statue.rotations(run.final)["prism"][:, 2]
    assert np.arccos(axis[2]) == pytest.approx(1.4, abs=1e-9)
    assert "Its tilt reached that at which it has overturned." in run.summary()
    assert run.energy_balance().error < 1e-9


def test_a_response_in_space_is_read_from_its_file_as_it_was(tmp_path):
    statue = block()
    run = rk.simulate(statue, rk.GroundMotion.none(1.0), initial=leaning())
    run.save(tmp_path / "run.nc")
    read = rk.load(tmp_path / "run.nc", structure=model("prism_on_4", tuple(CORNERS.items())))
    np.testing.assert_array_equal(read.y, run.y)
    assert (read.mode == run.mode).all()


def test_derivatives_pass_through_the_landings_of_smooth_corners():
    motions = [rk.GroundMotion.from_library(f"El Centro 1940 {way}") for way in ("180", "270")]

    def case(half_width):
        return rk.Case(
            block(half_width), motions[0], transverse=motions[1], initial=leaning(), duration=0.6
        )

    of = ["end pitch", "end yaw", "impact 3 time"]
    slopes = rk.sensitivity(case(0.25), of=of, to=["half_width"], options=TIGHT)
    step, ends = 1e-6, []
    for half_width in (0.25 + 1e-6, 0.25 - 1e-6):
        c = case(half_width)
        run = rk.simulate(
            c.structure, c.motion, transverse=c.transverse, initial=c.initial, duration=0.6,
            options=TIGHT,
        )  # fmt: skip
        ends.append([run.final["pitch"], run.final["yaw"], run.impacts[2].time])
    assert len(run.impacts) > 3
    expected = (np.array(ends[0]) - ends[1]) / (2 * step)
    np.testing.assert_allclose(np.ravel(slopes.derivatives), expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"law": Rigid(friction=0, law="poisson")}, "a slip turns within an impact in space"),
        ({"law": Rigid(HALF)}, "with which Newton's law may gain energy: give law='moreau'"),
        ({"law": Rigid(HALF, 0.3, "moreau", tangential=HALF)}, "leave `tangential` out"),
        ({"places": {f"f{i}": (i, i * i, -1) for i in range(9)}}, "declare at most 8 in space"),
        ({"falls": {Tilt("tilt", sp.Integer(1)): sp.Integer(2)}}, "give an angle between 0 and pi"),
        ({"falls": "tilt"}, "give a mapping"),
    ],
)
def test_points_in_space_that_cannot_be_simulated_are_refused(changed, words):
    places = changed.get("places", {f"f{i}": (i, i * i, -1) for i in range(3)})
    with pytest.raises(ValueError, match=words):
        Model(
            name="stone", title="Stone", parameters=(MASS, G), coordinates=(*PLACE, *ANGLES),
            gravity=G.symbol, rotation=ANGLES[1],
            bodies=[space.body("stone", MASS.symbol, MASS.symbol * sp.eye(3), FRAME)],
            contacts=space.feet(FRAME, places, changed.get("law", Rigid(friction=0))),
            falls=changed.get("falls", {}),
        )  # fmt: skip


def test_what_is_not_for_space_says_so():
    statue = block()
    with pytest.raises(ValueError, match="moves in space, and a pushover in the plane"):
        statue.pushover([0.1])
    with pytest.raises(ValueError, match="names of the points that touch"):
        rk.simulate(statue, rk.GroundMotion.none(1.0), mode="left")
    with pytest.raises(ValueError, match="it has overturned in this state, by its tilt"):
        rk.simulate(statue, rk.GroundMotion.none(1.0), initial={"roll": 1.45})
    with pytest.raises(ValueError, match="its modes are solved as numbers"):
        model("prism_on_4", tuple(CORNERS.items())).mode("flight")


def test_an_internal_variable_follows_its_rate_beside_points_in_space():
    z = internal_variable("q", "charge", "-", "a number that fades")
    feet = {"a": (0.5, 0.4, -1.0), "b": (-0.5, 0.4, -1.0), "c": (0.0, -0.5, -1.0)}
    statue = on_feet(feet, rates={z: -2 * z.symbol})
    run = rk.simulate(statue, rk.GroundMotion.none(1.0), initial={"charge": 3.0}, options=TIGHT)
    assert run.final["charge"] == pytest.approx(3.0 * np.exp(-2.0), rel=1e-11)
    np.testing.assert_allclose(run["vertical_reaction"], 2 * GRAVITY, rtol=1e-12)
