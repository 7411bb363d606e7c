"""Prisms and tripods on feet without friction: forces, landings, impacts, the end of bounces."""

import numpy as np
import pytest

import rockeom as rk
from tests.space.bodies import CORNERS, NAMES, TRIPOD, oriented, prism, spin, spin_rate
from tests.space.cases import CASES, GRAVITY, Case, of_group

TIGHT = rk.SolverOptions(rtol=1e-13, atol=1e-15)
IMPACTS = [name for name in of_group("prism impact") if "frictionless" in name]
IMPACTS += ["smooth_impact_S_dir20"]


def started(case: Case, rotation: str, spin=(0, 0, 0)) -> dict[str, float]:
    return oriented(case.given[rotation], spin)


def energy_ratio(block, impact) -> float:
    """Kinetic energy after an impact over that before."""
    after, before = (block.energies(s)["kinetic_energy"] for s in (impact.after, impact.before))
    return after / before


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
    block = prism(case.given)
    velocity = dict(zip(("x_dot", "y_dot", "z_dot"), map(float, case.given["v_centroid"])))
    state = started(case, "R", case.given["omega"]) | velocity
    run = rk.simulate(block, rk.GroundMotion.none(1e-3), initial=state, options=TIGHT)
    impact = run.impacts[0]
    assert impact.time < 1e-9
    after = impact.after
    case.agrees(
        omega_after=spin(after),
        v_centroid_after=np.array([after[f"{x}_dot"] for x in "xyz"]),
        energy_ratio=energy_ratio(block, impact),
    )


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
