"""States of events are states of the structure: everything may be asked of them, and motions start
there."""

from functools import cache

import pytest

import rockeom as rk
from rockeom.codes import IMPOSSIBLE
from rockeom.structures import searched_modes

from .declared import four_feet

SIZE = {"lower_half_width": 0.5, "lower_half_height": 0.5, "lower_mass": 1000.0}
UPPER = {"upper_half_width": 0.3, "upper_half_height": 0.6, "upper_mass": 500.0}
LOOSE = rk.SolverOptions(method="RK45", rtol=1e-6)


@cache
def declared():
    return rk.structure(
        four_feet(),
        mass=2.0, height=0.8, inertia=0.5, gravity=9.81, friction=0.4, restitution=0.3,
        half_width=1.0, stiffness=1e3, damping=1e2,
    )  # fmt: skip


def block(**given):
    return rk.SlidingBlock(
        **{"half_width": 0.3, "half_height": 1.0, "friction": 0.3, "restitution": 0.0} | given
    )


def stack(**given):
    return rk.StackedBlocks(**SIZE | UPPER | given)


MOTIONS = {
    "block leans": (lambda: block(restitution=0.0), {"theta": 0.2}, None),
    "block bounces": (lambda: block(restitution=0.5), {"y": 0.05, "theta": 0.1}, None),
    "block slides": (lambda: block(restitution=0.0), {"x_dot": 1.0, "theta": -0.1}, None),
    "block leans, loosely": (lambda: block(restitution=0.0), {"theta": 0.2}, LOOSE),
    "stack leans": (stack, {"phi": 0.25}, None),
    "both blocks lean": (stack, {"theta": 0.1, "phi": -0.2}, None),
    "stack bounces": (lambda: stack(restitution=0.1), {"phi": 0.1}, None),
    "stack leans, loosely": (stack, {"phi": 0.2}, LOOSE),
    "four feet": (declared, {"y": 0.05, "theta": 0.1}, None),
    "four feet, loosely": (declared, {"y": 0.05, "x_dot": 0.5}, LOOSE),
}


@pytest.mark.parametrize("name", MOTIONS)
def test_a_state_of_an_event_is_given_back(name):
    made, initial, options = MOTIONS[name]
    structure = made()
    still = rk.GroundMotion.none(2.0)
    run = rk.simulate(structure, still, initial=initial, options=options)
    assert run.events
    for event in run.events[:: 1 + len(run.events) // 12]:
        for state in (event.before, event.after):
            structure.positions(state)
            structure.energies(state)
            structure.reactions(state)
            structure.accelerations(state)
            rk.simulate(structure, rk.GroundMotion.none(1e-3), initial=state, options=options)


@pytest.mark.parametrize("name", ["block leans", "block slides", "stack leans", "both blocks lean"])
def test_a_motion_goes_on_from_its_events_as_it_did(name):
    made, initial, options = MOTIONS[name]
    structure = made()
    run = rk.simulate(structure, rk.GroundMotion.none(2.0), initial=initial, options=options)
    times = [event.time for event in run.events] + [run.t[-1]]
    apart = [(b - a, event) for a, b, event in zip(times, times[1:], run.events, strict=False)]
    long = [(span, event) for span, event in apart if span > 1e-3]
    assert long
    for span, event in long[:8]:
        later = min(0.9 * span, 0.05)
        again = rk.simulate(structure, rk.GroundMotion.none(later), initial=event.after)
        for i, (state, expected) in enumerate(run.at(event.time + later).items()):
            assert again.end[i] == pytest.approx(expected, rel=1e-6, abs=1e-7), state


def test_slow_motion_of_a_structure_at_rest_is_its_whole_motion():
    slides = block()
    mode = slides.mode_number(slides.state({"x_dot": 1e-6}))
    assert slides.module.MODES[mode] == "both_slides_right"


@pytest.mark.parametrize("state", [{"y": -1e-4}, {"x_dot": 1.0, "y": 0.0}])
def test_a_state_that_contradicts_the_contacts_of_a_stack_is_refused(state):
    whole = dict.fromkeys(stack().states, 0.0) | state
    with pytest.raises(ValueError, match=r"gap|no mode"):
        stack().positions(whole)


def test_stacks_without_a_solution_are_not_said_to_have_friction():
    with pytest.raises(ValueError, match=r"never slip.*declare friction") as refused:
        by_forces_that_fit_none(stack())
    assert "less friction" not in str(refused.value)


def test_blocks_without_a_solution_are_said_to_have_too_much_friction():
    with pytest.raises(ValueError, match=r"with much friction jam.*declare less"):
        by_forces_that_fit_none(block())


def by_forces_that_fit_none(structure):
    """As if none fitted: no state is known in which a structure of plausible friction has none."""
    module, y = structure.module, structure.state({})
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(searched_modes._searching(module), "fits_by_forces", lambda *_: IMPOSSIBLE)
        searched_modes.mode_under_forces(module, 0, y, structure.vector, (0.0, 0.0))
