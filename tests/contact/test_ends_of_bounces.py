"""Bounces that end, and what must not end with them: chatter, rests and missing modes.

The motions are held against Newton-Euler mechanics by hand (`tests.soak.newton`), which knows no
generated module.
"""

import numpy as np
import pytest

import rockeom as rk
from rockeom.codes import OPEN
from rockeom.structures.searched_modes import Points
from tests.mechanics import of_sliding_block, of_stack
from tests.soak.cases import Motion
from tests.soak.newton import Told, lost, on_contacts

STILL = rk.GroundMotion.none
ENDED = {"came to rest", "overturned", "completed"}


def stack(lower: tuple[float, float, float], upper: tuple[float, float, float], e: float = 0.0):
    """Half widths, half heights and masses of two blocks on one another."""
    (b1, h1, m1), (b2, h2, m2) = lower, upper
    return rk.StackedBlocks(
        lower_half_width=b1, lower_half_height=h1, lower_mass=m1,
        upper_half_width=b2, upper_half_height=h2, upper_mass=m2, restitution=e,
    )  # fmt: skip


def violations(run: rk.Response, by_hand, options: rk.SolverOptions) -> list[str]:
    motion = Motion(0, run.structure, run.motion, None, None, {}, None, options)
    return list(on_contacts(Told(motion, run, by_hand)))


def test_upper_block_that_lands_with_restitution_does_not_shake_the_lower_one_by_rounding():
    """The lower block's rates are some 5e-17 m/s after the landing: its feet have not left."""
    run = rk.simulate(
        stack((0.5, 0.5, 1000.0), (0.2, 0.6, 500.0), 0.2), STILL(10.0), initial={"phi": 0.2}
    )
    assert run.outcome == "came to rest"


def test_feet_of_a_frame_that_land_in_turn_come_to_full_contact():
    """Their intervals shrink by 0.22 a pair; the sum converges, and both reactions press."""
    frame = rk.ShearFrame(
        masses=[2e4, 1.5e4], heights=[3.0, 6.0], stiffnesses=[2e7, 1.5e7], dampings=[1e5, 1e5],
        half_width=1.0, base_mass=1e4, base_inertia=5e3,
        support=rk.Sliding(friction=0.5, restitution=0.2),
    )  # fmt: skip
    for amplitude in np.linspace(6.6, 6.75, 16):
        run = rk.simulate(frame, rk.GroundMotion.single_sine(amplitude, 0.23, duration=4.0))
        assert run.outcome in ENDED


def test_block_on_slippery_ground_ends_bounces_lost_among_rounding_errors():
    block = rk.SlidingBlock(half_width=0.491, half_height=1.481, friction=0.06, restitution=0.9)
    start = {"theta": -0.07, "y": 0.2343419380427286, "x_dot": -0.66, "theta_dot": -0.2}
    options = rk.SolverOptions()
    run = rk.simulate(block, STILL(6.0), initial=start, options=options)
    assert run.outcome in ENDED
    given = {
        "half_width": 0.491, "half_height": 1.481, "mass": 1.0, "inertia": None,
        "friction": 0.06, "restitution": 0.9,
    }  # fmt: skip
    assert violations(run, of_sliding_block(given), options) == []


def test_stack_that_has_all_but_come_to_rest_comes_to_rest():
    """All rates are below 2.4e-13 where full contact of all four points fits."""
    slow = stack((0.5, 0.5, 1000.0), (0.3, 0.6, 500.0))
    run = rk.simulate(slow, STILL(20.0), initial={"phi": 0.25})
    assert run.outcome == "came to rest"


def test_rest_bridges_no_more_than_its_tolerance():
    """A flight whose gap opened by rounding alone took 0.28 s, through which phi moved on.

    Positions between the ends of each rest follow from the velocities there.
    """
    run = rk.simulate(
        stack((0.5, 1.2, 2.0), (0.4, 0.9, 1.0), 0.03), STILL(4.0),
        initial={"theta": 0.11, "phi": 0.07},
    )  # fmt: skip
    rests = [(a, b) for a, b in zip(run.events, run.events[1:], strict=False) if b.kind == "rest"]
    assert rests
    for landing, rest in rests:
        lasts = rest.time - landing.time
        assert lasts < 1e-5
        for name in ("theta", "phi"):
            moved = rest.after[name] - landing.after[name]
            fastest = max(abs(landing.after[f"{name}_dot"]), abs(rest.after[f"{name}_dot"]))
            assert abs(moved) <= 1.01 * lasts * fastest + 1e-12


@pytest.mark.parametrize("tilt", [0.35, 0.3, -0.33])
def test_foot_that_begins_to_slip_goes_on_at_a_coarse_tolerance(tilt):
    """The event comes early or late by the error of a step: the fit of a mode must allow for it."""
    block = rk.SlidingBlock(half_width=0.3, half_height=1.0, friction=0.5, restitution=0.0)
    coarse = rk.SolverOptions(method="RK45", rtol=1e-6)
    run = rk.simulate(block, STILL(5.0), initial={"theta": tilt}, options=coarse)
    fine = rk.simulate(block, STILL(5.0), initial={"theta": tilt})
    assert run.outcome == fine.outcome


def test_coarse_map_of_a_sliding_block_has_the_outcomes_of_a_fine_one():
    """Of 400 pulses 193 had no mode that fitted at the tolerance of maps."""
    rng = np.random.default_rng(4)
    pulses = {"a": rng.uniform(1.0, 9.0, 60), "t": rng.uniform(0.3, 1.5, 60)}
    block = rk.SlidingBlock(half_width=0.3, half_height=1.0, friction=0.5, restitution=0.0)

    def outcomes(options: rk.SolverOptions) -> list[str]:
        return [
            str(
                rk.simulate(
                    block, rk.GroundMotion.single_sine(a, t, duration=5.0), options=options,
                    keep="samples",
                ).outcome
            )
            for a, t in zip(pulses["a"], pulses["t"], strict=True)
        ]  # fmt: skip

    coarse = outcomes(rk.SolverOptions(method="RK45", rtol=1e-6))
    assert set(coarse) <= ENDED
    fine = outcomes(rk.SolverOptions())
    assert sum(a != b for a, b in zip(coarse, fine, strict=True)) <= 1


def test_stacks_under_records_do_not_chatter():
    """From rest, with and without restitution; where never to slip has no solution, it is said."""
    record = rk.GroundMotion.from_library("El Centro 1940 180")
    rng = np.random.default_rng(1)
    for number in range(16):
        e = 0.0 if number % 2 else rng.uniform(0.02, 0.7)
        b, h = rng.uniform(0.3, 0.8), rng.uniform(0.4, 1.5)
        lower = (b, h, rng.uniform(0.5, 3.0))
        upper = (b * rng.uniform(0.3, 1.0), rng.uniform(0.3, 1.5), rng.uniform(0.3, 2.0))
        run = rk.simulate(stack(lower, upper, e), record.scaled_to(peak=rng.uniform(2.0, 8.0)))
        assert run.outcome in ENDED | {"no solution", "several solutions"}


def test_contact_that_ends_gives_way_to_the_one_that_moves_on():
    """A corner lifts while its friction is not zero: the accelerations jump, and one mode lasts."""
    given = {
        "lower_half_width": 0.5, "lower_half_height": 1.0, "lower_mass": 2.0,
        "upper_half_width": 0.35, "upper_half_height": 0.9, "upper_mass": 1.0, "restitution": 0.0,
    }  # fmt: skip
    options = rk.SolverOptions()
    for tilt in np.linspace(0.02, 0.3, 15):
        run = rk.simulate(
            rk.StackedBlocks(**given), STILL(2.0), initial={"theta": tilt, "phi": -0.5 * tilt},
            options=options,
        )  # fmt: skip
        found = violations(run, of_stack(given | {"lower_inertia": None, "upper_inertia": None}),
                           options)  # fmt: skip
        assert [v for v in found if "where one mode fits" in v] == []


def test_closed_points_of_a_rest_are_closed():
    """No point that flies high is put on the ground at the end of the bounces of another."""
    run = rk.simulate(
        stack((0.5, 1.2, 2.0), (0.4, 0.9, 1.0), 0.03), STILL(4.0),
        initial={"theta": 0.11, "phi": 0.07},
    )  # fmt: skip
    module, p = run.structure.module, run.structure.vector
    for event in run.events:
        if event.kind != "rest":
            continue
        before, after = (
            np.array([state[name] for name in run.structure.states])
            for state in (event.before, event.after)
        )
        closed = np.array(module.POINT_STATES[module.MODES.index(event.mode_after)]) != OPEN
        assert Points(module, before, p).gap[closed].max(initial=0.0) < 1e-9
        assert np.abs(Points(module, after, p).gap[closed]).max(initial=0.0) < 1e-14


def test_a_fast_landing_beside_a_rest_is_an_impact():
    """The upper corner throws `right`, 1.7e-14 m above the ground, down at 15 m/s.

    The bounces of the upper corner end at once, and take none of that: 250 of 764 J.
    """
    blocks = stack(
        (1.110456554463027, 0.3430782029258869, 0.1884001270725435),
        (0.6924810865050224, 0.3643968977823345, 6.955596978526995),
    )
    record = rk.GroundMotion.from_array([-4.247665745289613, 7.66835225024107], 0.29391352976431)
    start = {"theta": 0.2785153343050582, "theta_dot": -6.699896303106207}
    options = rk.SolverOptions(rtol=1e-12, atol=1e-14)
    run = rk.simulate(
        blocks, record, vertical=rk.GroundMotion.half_sine(-4.017, 0.27268384, duration=3.0),
        initial=start | {"phi_dot": 4.686176583199955}, duration=0.027, options=options,
    )  # fmt: skip
    landings = [(round(impact.time, 7), impact.contact) for impact in run.impacts]
    assert landings == [
        (0.0250103, "upper_right"), (0.0253259, "right"), (0.0253259, "upper_right"),
        (0.0253259, "right"), (0.0253259, "upper_right"),
    ]  # fmt: skip
    motion = Motion(0, blocks, record, run.vertical, None, {}, None, options)
    told = Told(motion, run, of_stack(blocks.parameters()))
    assert list(on_contacts(told)) == [] == list(lost(told))


def test_a_point_that_turns_back_in_flight_did_not_land():
    """A bar that turns little falls on its right corner; the left one, 1e-11 m up, is thrown up."""
    block = {"half_width": 0.2, "half_height": 0.5, "friction": 0.0, "restitution": 1.0}
    block["inertia"] = 1.0
    tilt = 1e-11 / 0.4
    run = rk.simulate(
        rk.SlidingBlock(**block), STILL(1e-3),
        initial={"theta": tilt, "y": 0.2 * tilt + 1e-3, "y_dot": -2.0, "theta_dot": 0.0},
    )  # fmt: skip
    assert run.impacts[0].contact == "right"
