"""What falls: several coordinates of one structure, each with its own bound."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.simulation.response import fall_is_judged
from rockeom.structures import searched_modes
from rockeom.symbolic import SHIPPED, Rigid, parameter
from rockeom.symbolic.parts.supports import X
from tests.contact import declared
from tests.refusals import refused
from tests.typical import stack

STACK = rk.StackedBlocks(
    lower=rk.RigidBlock(half_width=0.3, half_height=1.0, mass=10.0),
    upper=rk.RigidBlock(half_width=0.2, half_height=0.4),
)
STILL = rk.GroundMotion.none(4.0)
STARTS = {
    "theta": {"theta": 1.5, "phi": 1.45},  # the lower one, the upper one leans back on it
    "phi": {"phi": 0.6},  # the upper one alone
}


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("fallen", STARTS)
def test_stack_has_fallen_when_either_of_its_blocks_has(fallen, side):
    start = {name: side * value for name, value in STARTS[fallen].items()}
    run = rk.simulate(STACK, STILL, initial=start)
    assert run.outcome is rk.Outcome.OVERTURNED
    assert run.overturned == fallen
    assert run.final[fallen] == pytest.approx(side * math.pi / 2, rel=1e-12)
    (other,) = set(STARTS) - {fallen}
    assert abs(run.final[other]) < 1.5
    assert f"The structure fell over. {fallen} is " in run.summary()


def test_stack_that_has_fallen_cannot_start():
    assert refused(rk.simulate, STACK, STILL, initial={"theta": 1.6, "phi": 0.1}) == ("theta", 1.6)


def test_a_sweep_counts_both_blocks_as_fallen():
    def case(theta, phi):
        return rk.Case(STACK, STILL, initial={"theta": theta, "phi": phi})

    found = rk.simulate_many(case, over={"theta": [0.0, 1.5], "phi": [0.0, 1.45]})
    assert found.outcome.sel(theta=1.5, phi=1.45).item() == "overturned"
    assert found.outcome.sel(theta=0.0, phi=0.0).item() == "came to rest"


def test_upright_structure_has_not_overturned():
    run = rk.simulate(STACK, STILL)
    assert run.overturned == ""
    assert "phi is" not in run.summary()


@cache
def on_a_table():
    """A block that falls where it has slid off the table, at a distance to either side."""
    reach = parameter("r", "reach", "m", "distance of the table's edge")
    model = SHIPPED["sliding_block"]()
    return replace(
        model,
        name="block_on_a_table",
        parameters=(*model.parameters, reach),
        falls={X: reach.symbol},
    )


@pytest.mark.parametrize("towards", [-1.0, 1.0])
def test_block_slides_off_a_table_when_a_uniform_acceleration_has_carried_it_there(towards):
    block = rk.structure(
        on_a_table(), mass=900.0, half_width=0.5, height=0.4, inertia=123.0, friction=0.2,
        restitution=0.0, reach=0.7,
    )  # fmt: skip
    pushed = 3.0 - 0.2 * 9.81
    run = rk.simulate(block, rk.GroundMotion.constant(-3.0 * towards, 4.0))
    assert run.outcome is rk.Outcome.OVERTURNED
    assert run.overturned == "x"
    assert run.t[-1] == pytest.approx(math.sqrt(2 * 0.7 / pushed), rel=1e-9)
    assert run.final["x"] == pytest.approx(towards * 0.7, rel=1e-9)
    assert block.falls == {"theta": math.pi / 2, "x": 0.7}


def test_one_bound_alone_is_written_as_ever():
    assert rk.RigidBlock(half_width=0.1, half_height=0.4).module.N_FALLS == 0
    assert not hasattr(rk.RigidBlock(half_width=0.1, half_height=0.4).module, "overturns_at")


WRONG = {
    "the rotation": ({declared.THETA: sp.pi / 2}, "'theta': name coordinates besides the rotation"),
    "no coordinate": ({"phi": sp.pi / 2}, "'phi': name coordinates"),
    "a list": ([declared.X], "give a mapping"),
    "a negative size": ({declared.X: -1}, "size of 'x' is -1: it must be positive"),
    "a coordinate": ({declared.X: declared.Y.position}, "size at which 'x' has over.* contains"),
    "a text": ({declared.X: "1"}, "give a number or a SymPy expression"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_fall_is_refused(name):
    falls, said = WRONG[name]
    with pytest.raises(ValueError, match=said):
        replace(declared.on_points("falling", {"tip": (0, 0)}), falls=falls)


def test_final_state_is_on_the_bound_where_the_motion_is_cut():
    run = rk.simulate(STACK, STILL, initial=STARTS["theta"])
    assert run.t[-1] < 1.0
    np.testing.assert_array_less(np.abs(run["theta"][:-1]), math.pi / 2)


# -- motions without a solution: a fall where a body is far beyond its balance and turns outward

ALPHA = math.atan(0.2)


@cache
def never_slips():
    """A block of 0.2 x 1.0 m on feet that never slip."""
    model = SHIPPED["sliding_block"]()
    model = replace(
        model,
        name="block_that_never_slips",
        parameters=tuple(p for p in model.parameters if p.name not in ("friction", "restitution")),
        contacts=tuple(replace(c, law=Rigid()) for c in model.contacts),
    )
    return rk.structure(model, mass=1.0, half_width=0.1, height=0.5, inertia=0.26 / 3)


def test_a_pinned_twin_falls_wherever_a_motion_without_a_solution_counts_as_a_fall():
    judged, twin = 0, rk.RigidBlock(half_width=0.1, half_height=0.5, mass=1.0)
    for seed in range(8):
        motion = rk.GroundMotion.kanai_tajimi(0.02, duration=15.0, seed=seed).scaled_to(4.5)
        run = rk.simulate(never_slips(), motion)
        assert run.outcome in ("overturned", "completed", "came to rest")
        if not fall_is_judged(run):
            continue
        judged += 1
        theta, rate = run.final["theta"], run.final["theta_dot"]
        assert abs(theta) > 2.0 * ALPHA
        assert theta * rate > 0.0
        assert "It is judged to fall: no mode fits any more" in run.summary()
        rest = motion.trimmed(run.t[-1], motion.duration)
        goes_on = rk.simulate(twin, rest, initial={"theta": theta, "theta_dot": rate})
        assert goes_on.outcome is rk.Outcome.OVERTURNED
    assert judged >= 3


def test_no_fall_of_a_stack_is_left_out_of_its_fragility():
    """Of these motions seven ended without a solution, the upper block beyond 1 rad."""
    statue = stack()
    records = [rk.GroundMotion.kanai_tajimi(0.02, duration=15.0, seed=i) for i in range(8)]
    over = {"motion": records, "pga": [5.0, 7.0]}
    found = rk.simulate_many(rk.Case(statue, records[0]), over=over).outcome.values.astype(str)
    assert "no solution" not in found
    fallen = {(i, pga) for i, pga in np.argwhere(found == "overturned").tolist()}
    runs = [rk.simulate(statue, records[i].scaled_to([5.0, 7.0][pga])) for i, pga in fallen]
    judged = [run for run in runs if fall_is_judged(run)]
    assert judged
    for run in judged:
        leans = run.final["phi"] - run.final["theta"]
        turns = run.final["phi_dot"] - run.final["theta_dot"]
        assert abs(leans) > 2.0 * math.atan(0.3)
        assert leans * turns > 0.0


@pytest.mark.parametrize(("turned", "rate"), [(1.98, 2.0), (2.02, -2.0)])
def test_a_body_near_its_balance_or_on_its_way_back_has_not_fallen_without_a_solution(turned, rate):
    block = never_slips()
    tips = searched_modes._searching(block.module)["tips_over"]
    for side in (-1.0, 1.0):
        angle = side * turned * ALPHA
        assert not tips(block.state({"theta": angle, "theta_dot": side * rate}), block.vector)
    assert tips(block.state({"theta": 2.02 * ALPHA, "theta_dot": 2.0}), block.vector)


def test_a_block_comes_back_from_less_than_twice_its_balance():
    """The case that the guide to limits names."""
    block = rk.RigidBlock(half_width=0.1, half_height=0.5)
    run = rk.simulate(block, rk.GroundMotion.single_sine(3.898, 1.0, duration=20.0))
    assert run.outcome is rk.Outcome.CAME_TO_REST
    assert abs(run.extremes("theta").peak) / ALPHA == pytest.approx(1.665, abs=0.001)


def test_a_judged_fall_has_no_time_of_overturning_to_differentiate():
    motion = rk.GroundMotion.kanai_tajimi(0.02, duration=15.0, seed=1).scaled_to(4.5)
    with pytest.raises(ValueError, match="there is no overturning time"):
        rk.sensitivity(rk.Case(never_slips(), motion), ["overturning time"], ["half_width"])
