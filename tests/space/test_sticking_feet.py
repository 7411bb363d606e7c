"""Prisms on corners that never slip: forces, motions, impacts, and the corner that is released."""

import numpy as np
import pytest

import rockeom as rk
from tests.space.bodies import (
    NAMES,
    energy_ratio,
    impact_agrees,
    oriented,
    prism,
    spin,
    spin_rate,
)
from tests.space.cases import CASES, TIGHT, Case, of_group

GROUND = ("", "transverse_", "vertical_")
IMPACTS = [name for name in of_group("prism impact") if "sticking" in name]
MOTIONS = [name for name in CASES if name.startswith("corner_motion")]
FIRST_IMPACTS = [name for name in CASES if name.startswith("to_first_impact")]
SEQUENCES = [name for name in CASES if name.startswith("impact_sequence")]


def sticking(case: Case):
    return prism(case.given, friction=None)


@pytest.mark.parametrize("name", MOTIONS)
def test_a_prism_on_a_corner_moves_as_newton_and_euler_have_it(name):
    case = Case(name)
    block, foot = sticking(case), NAMES[case.given["corner"]]
    state = oriented(case.given["R"], case.given["omega"])
    of_ground = zip(GROUND, map(float, case.given["ground_acceleration"]), strict=True)
    shaking = {f"{way}ground_acceleration": value for way, value in of_ground}
    moves = block.accelerations(state, mode=foot, **shaking)
    forces = block.reactions(state, mode=foot, **shaking)
    force = [forces[f"{foot}_{of}"] for of in ("friction_x", "friction_y", "reaction")]
    case.agrees(
        alpha=spin_rate(state, moves),
        acc_centroid=np.array([moves[axis] for axis in "xyz"]),
        contact_force=np.array(force),
    )


@pytest.mark.parametrize("name", FIRST_IMPACTS)
def test_a_prism_falls_about_a_corner_until_another_lands(name):
    case = Case(name)
    block = sticking(case)
    run = rk.simulate(
        block, rk.GroundMotion.none(1.0), initial=oriented(case.given["R0"]), options=TIGHT
    )
    landing = run.impacts[0]
    assert landing.contact == NAMES[case.expected["landing"][0]]
    rotation = block.rotations(landing.before)["prism"]
    case.agrees(
        time=landing.time,
        body_axis=rotation[:, 2],
        body_x=rotation[:, 0],
        omega=spin(landing.before),
        v_centroid=np.array([landing.before[f"{axis}_dot"] for axis in "xyz"]),
    )


@pytest.mark.parametrize("name", IMPACTS)
def test_an_impact_of_corners_that_stick_leaves_the_velocities_of_the_one_set_that_fits(name):
    case = Case(name)
    impact_agrees(case, sticking(case))


@pytest.mark.parametrize("name", SEQUENCES)
def test_a_prism_wobbles_from_corner_to_corner(name):
    case = Case(name)
    block = sticking(case)
    run = rk.simulate(
        block, rk.GroundMotion.none(2.0), initial=oriented(case.given["R0"]), options=TIGHT
    )
    landings = run.impacts[: len(case.expected["times"])]
    corners = [NAMES[corner] for corner in case.expected["corners"]]
    assert [e.contact for e in landings] == corners[1:]
    case.agrees(
        times=np.array([e.time for e in landings]),
        energy_ratios=np.array([energy_ratio(block, e) for e in landings]),
    )


def jammed() -> tuple[Case, rk.Structure, dict[str, float], dict[str, float]]:
    """The case, its prism, its state on an edge, and the shaking at which a corner leaves."""
    case = Case("edge_leaves_corner_jam")
    block = sticking(case)
    rates = zip("xyz", map(float, case.given["v_centroid"]), strict=True)
    state = oriented(case.given["R"], case.given["omega"])
    state |= {f"{axis}_dot": rate for axis, rate in rates}
    shaking = {"ground_acceleration": case["ax"]}
    shaking["transverse_ground_acceleration"] = float(case.expected["ay"])
    return case, block, state, shaking


def test_a_corner_whose_normal_force_vanishes_is_still_pulled_along_the_ground():
    case, block, state, shaking = jammed()
    leaving, other = (NAMES[case.given[which]] for which in ("corner", "other"))
    forces = block.reactions(state, mode=f"{leaving}_{other}", **shaking)
    weight = 2 * 9.81
    assert abs(forces[f"{leaving}_reaction"]) < 1e-12 * weight
    # along the edge the share of each corner is a choice: across it, along x, it is not
    case.agrees(transverse_force_of_leaving_corner=forces[f"{leaving}_friction_x"])
    alone = block.accelerations(state, mode=other, **shaking)
    lifted = acceleration_of_corner(block, state, alone, leaving)
    assert lifted[2] < 0.0  # into the ground
    case.agrees(acceleration_of_it_when_released=lifted)


def acceleration_of_corner(block, state, moves, corner) -> np.ndarray:
    """That of the centroid, and those of turning about it."""
    places, turns = block.positions(state, mode="flight"), spin(state)
    arm = places[corner] - places["prism"]
    centroid = np.array([moves[axis] for axis in "xyz"])
    about = np.cross(spin_rate(state, moves), arm) + np.cross(turns, np.cross(turns, arm))
    return centroid + about


def test_a_corner_that_would_jam_is_released_until_it_opens_or_an_impact():
    case, block, state, shaking = jammed()
    leaving, other = (NAMES[case.given[which]] for which in ("corner", "other"))
    mode = f"{leaving}_released_{other}"
    if list(NAMES.values()).index(leaving) > list(NAMES.values()).index(other):
        mode = f"{other}_{leaving}_released"
    right = case.expected["by_the_rule"]
    forces = block.reactions(state, mode=mode, **shaking)
    tolerance = 1e-11 * 20
    np.testing.assert_allclose(
        forces[f"{leaving}_reaction"], float(right["normal_of_released_corner"]), atol=tolerance
    )
    sticks = [forces[f"{other}_{of}"] for of in ("friction_x", "friction_y", "reaction")]
    expected = np.array(right["force_of_sticking_corner"], float)
    np.testing.assert_allclose(sticks, expected, atol=tolerance)
    moves = block.accelerations(state, mode=mode, **shaking)
    np.testing.assert_allclose(
        spin_rate(oriented(case.given["R"], case.given["omega"]), moves),
        np.array(right["alpha"], float), atol=1e-11,
    )  # fmt: skip


def test_feet_that_were_released_stick_again_once_the_body_stands_on_them():
    """It slid on as on ice, and neither rocked again nor came to rest, whatever the shaking."""
    feet = {"a": (-0.095, 0.071), "b": (-0.008, -0.027), "c": (0.070, 0.046), "d": (0.054, 0.059)}
    rough, free = (
        rk.LeggedStatue(
            feet=feet, mass=354.0, centroid=(0.0, 0.0, 0.296), inertia=np.diag([18.0, 18.0, 12.0]),
            friction=friction,
        )
        for friction in (1.2, None)
    )  # fmt: skip
    shaking = 0.3 * rk.GroundMotion.from_library("El Centro 1940 180").trimmed(0.0, 8.0)
    slips, never = (rk.simulate(body, shaking) for body in (rough, free))
    assert slips.outcome is never.outcome is rk.Outcome.CAME_TO_REST
    released = [t for t, mode in zip(never.t, never.mode, strict=True) if "released" in str(mode)]
    assert min(released) > 2.9
    assert max(released) < 3.0
    peaks = [run.extremes("tilt").maximum for run in (slips, never)]
    assert peaks[1] == pytest.approx(peaks[0], rel=1e-9)
    last = [run.events[-1].time for run in (slips, never)]  # long after
    assert last[1] == pytest.approx(last[0], abs=1e-6)
    assert last[1] > 4.0
