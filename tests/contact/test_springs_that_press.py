"""Which springs press in a state that a user gives: those whose gaps are closed and do not pull.

The reference is the gap of each spring by hand: above its spring a foot carries nothing, however
fast it comes down.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

import rockeom as rk
from rockeom.symbolic import Model, Unilateral
from tests.contact import declared
from tests.refusals import refused

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


def bed(n: int, softer: float = 1.0) -> tuple:
    """(place across, height when heave is zero, stiffness, damping) of each spring of a bed."""
    k, c = STIFFNESS / softer, DAMPING / softer
    return tuple((x, -WEIGHT / (n * k), k, c) for x in np.linspace(-HALF_WIDTH, HALF_WIDTH, n))


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
    "a bed of twelve": (
        lambda: lumped(rk.Winkler(stiffness=STIFFNESS / 6, damping=DAMPING / 6, springs=12)),
        bed(12, 6.0),
    ),
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


@pytest.mark.parametrize("tilt", [0.0, 1e-15, 1e-9])
def test_a_bed_that_falls_flat_is_pressed_and_left_by_all_springs_at_once(tilt):
    """Free fall, then a damped oscillator on all springs until the bed would have to pull."""
    n = 12
    k, c, m = n * STIFFNESS / 6, n * 1e4 / 6, MASS + BASE_MASS
    of = made("a bed of twelve")
    structure = replace(of, support=replace(of.support, damping=1e4 / 6))
    touch = WEIGHT / k  # above the settled position
    height = touch + 0.04
    run = rk.simulate(
        structure, rk.GroundMotion.none(0.4), initial={"theta": tilt, "heave": height}
    )
    lands = np.sqrt(2.0 * 0.04 / GRAVITY)
    decay, frequency = c / (2.0 * m), np.sqrt(k / m - (c / (2.0 * m)) ** 2)
    a, b = touch, (decay * touch - GRAVITY * lands) / frequency

    def heave(t):
        return np.exp(-decay * t) * (a * np.cos(frequency * t) + b * np.sin(frequency * t))

    def rate(t):
        turned = -a * np.sin(frequency * t) + b * np.cos(frequency * t)
        return frequency * np.exp(-decay * t) * turned - decay * heave(t)

    def force(t):
        return k * (touch - heave(t)) - c * rate(t)

    leaves = lands + brentq(force, np.pi / (2.0 * frequency), 1.4 * np.pi / frequency, xtol=1e-15)
    times = np.array([e.time for e in run.events])
    assert times[:n] == pytest.approx(np.full(n, lands), rel=1e-7)
    assert times[n : 2 * n] == pytest.approx(np.full(n, leaves), rel=1e-7)
    left = heave(leaves - lands) + rate(leaves - lands) * (0.4 - leaves)
    if len(times) == 2 * n:
        assert run.final["heave"] == pytest.approx(left - GRAVITY / 2 * (0.4 - leaves) ** 2)
    assert run.final["theta"] == pytest.approx(0.0, abs=10 * tilt + 1e-15)


def test_more_springs_than_there_are_sets_for_are_refused_when_the_bed_is_named():
    assert rk.Winkler(springs=90, **SPRINGS).springs == 90
    assert refused(rk.Winkler, springs=91, **SPRINGS) == ("springs", 91)
    with pytest.raises(ValueError, match="100 elements have 5051 combinations"):
        rk.derive("lumped_mass_structure", support="winkler", springs=100)
