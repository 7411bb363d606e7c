"""Which springs press in a state that a user gives: those whose gaps are closed and do not pull.

The reference is the gap of each spring by hand: above its spring a foot carries nothing, however
fast it comes down.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.symbolic import Model, Unilateral
from tests.contact import declared

STIFFNESS, DAMPING, HALF_WIDTH = 1e6, 5e4, 0.5
MASS, BASE_MASS, GRAVITY = 1e3, 500.0, 9.81
WEIGHT = (MASS + BASE_MASS) * GRAVITY


def lumped(support) -> rk.LumpedMassStructure:
    return rk.LumpedMassStructure(
        mass=MASS, height=2.0, inertia=0.0, base_mass=BASE_MASS, base_height=0.0,
        base_inertia=100.0, half_width=HALF_WIDTH, gravity=GRAVITY, support=support,
    )  # fmt: skip


@cache
def on_rubber() -> Model:
    """A block on three pads that differ in stiffness and damping, at different heights."""
    of = declared.two_springs()
    v, theta = declared.Y.position, declared.THETA.position
    pads = ((-1, 1, 1, 0), (sp.Rational(1, 5), 2, 3, 1), (1, 3, 0, -1))
    k, c, b = (p.symbol for p in of.parameters[-3:])
    centre = v - declared.MASS.symbol * declared.GRAVITY.symbol / (2 * k)
    return Model(
        name="on_rubber", title="A block on three pads", parameters=of.parameters,
        coordinates=of.coordinates, bodies=of.bodies, gravity=of.gravity, rotation=of.rotation,
        elements=tuple(
            Unilateral(
                f"pad_{i}", -(centre - x * b * sp.sin(theta) + sp.Rational(d, 500)),
                stiff * k, damped * c,
            )
            for i, (x, stiff, damped, d) in enumerate(pads)
        ),
    )  # fmt: skip


def bed(n: int) -> tuple:
    """(place across, height when heave is zero, stiffness, damping) of each spring of a bed."""
    return tuple(
        (x, -WEIGHT / (n * STIFFNESS), STIFFNESS, DAMPING)
        for x in np.linspace(-HALF_WIDTH, HALF_WIDTH, n)
    )


def two_spring_structure() -> rk.TwoSpringStructure:
    return rk.TwoSpringStructure(
        mass=MASS, height=2.0, inertia=0.0, base_mass=BASE_MASS, base_height=0.0,
        base_inertia=100.0, half_width=HALF_WIDTH, gravity=GRAVITY,
        foundation_stiffness=STIFFNESS, foundation_damping=DAMPING,
    )  # fmt: skip


def rubber():
    return rk.structure(
        on_rubber(), mass=MASS + BASE_MASS, height=1.0, inertia=400.0, gravity=GRAVITY,
        stiffness=STIFFNESS, damping=DAMPING, half_width=HALF_WIDTH,
    )  # fmt: skip


SPRINGS = {"stiffness": STIFFNESS, "damping": DAMPING}
LEVEL = -WEIGHT / (2.0 * STIFFNESS)
CASES = {
    "two springs": (lambda: lumped(rk.TwoSprings(**SPRINGS)), bed(2)),
    "two springs, guided at the foot": (
        lambda: lumped(rk.TwoSprings(**SPRINGS, guided="foot")), bed(2),
    ),
    "a bed of four": (lambda: lumped(rk.Winkler(**SPRINGS, springs=4)), bed(4)),
    "the shipped structure": (two_spring_structure, bed(2)),
    "declared pads": (
        rubber,
        (
            (-HALF_WIDTH, LEVEL, STIFFNESS, DAMPING),
            (0.2 * HALF_WIDTH, LEVEL + 1.0 / 500.0, 2 * STIFFNESS, 3 * DAMPING),
            (HALF_WIDTH, LEVEL - 1.0 / 500.0, 3 * STIFFNESS, 0.0),
        ),
    ),
}  # fmt: skip


@cache
def made(case: str):
    return CASES[case][0]()


def forces(springs, theta: float, heave: float, theta_dot: float, heave_dot: float):
    """(force, energy) of each spring: it presses where its gap is closed, and never pulls."""
    found = []
    for x, level, k, c in springs:
        gap = level + heave - x * np.sin(theta)
        force = -k * gap - c * (heave_dot - x * np.cos(theta) * theta_dot)
        presses = gap <= 0.0 and force >= 0.0
        found.append((force, k * gap**2 / 2.0) if presses else (0.0, 0.0))
    return np.array(found)


@pytest.mark.parametrize("case", CASES)
@settings(max_examples=150, deadline=None)
@given(
    st.floats(-0.06, 0.06), st.floats(-0.03, 0.05), st.floats(-1.0, 1.0), st.floats(-0.5, 0.5)
)  # fmt: skip
def test_a_spring_presses_only_where_its_gap_is_closed(case, theta, heave, theta_dot, heave_dot):
    structure, springs = made(case), CASES[case][1]
    up = structure.states[1]
    state = {"theta": theta, up: heave, "theta_dot": theta_dot, f"{up}_dot": heave_dot}
    wanted = forces(springs, theta, heave, theta_dot, heave_dot)
    of = structure.reactions(state)
    found = [value for name, value in of.items() if name != "horizontal_reaction"]
    assert found == pytest.approx(wanted[:, 0], rel=1e-9, abs=1e-6)
    stored = structure.energies(state)["elastic_energy"]
    assert stored == pytest.approx(wanted[:, 1].sum(), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("case", CASES)
def test_a_motion_starts_and_goes_on_with_the_springs_that_press(case):
    """A foot comes down on its spring: it begins to press as the gap closes, not before."""
    structure, springs = made(case), CASES[case][1]
    up = structure.states[1]
    initial = {"theta": 0.03, up: 0.012, "theta_dot": -0.6, f"{up}_dot": -0.1}
    options = rk.SolverOptions(output_step=1e-3)
    run = rk.simulate(structure, rk.GroundMotion.none(0.3), initial=initial, options=options)
    assert run.outcome is rk.Outcome.COMPLETED
    rates = run["theta_dot"], run[f"{up}_dot"]
    wanted = np.array(
        [forces(springs, *of)[:, 0] for of in zip(run["theta"], run[up], *rates, strict=True)]
    )
    names = [name for name in structure.module.REACTIONS if name != "horizontal_reaction"]
    found = np.array([run[name] for name in names]).T
    between = np.ones(len(run.t), dtype=bool)
    for event in run.events:  # of two equal instants the one before an event, and that after it
        between &= np.abs(run.t - event.time) > 1e-9
    assert (wanted[between] == 0.0).any()
    assert (wanted[between] > 0.0).any()
    assert found[between] == pytest.approx(wanted[between], rel=1e-7, abs=1e-3)
