"""A block that lands on contact springs: the closed form against Housner's and integration."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp

import rockeom as rk
from benchmarks import opensees_restitution
from rockeom.analysis import formulas
from tests.refusals import refused, refuses

PAGE = Path(__file__).resolve().parents[2] / "docs" / "how-to" / "restitution-in-opensees.md"
BLOCK = {"half_width": 0.1, "half_height": 0.4, "mass": 1000.0, "gravity": 9.81}
PEAK = 0.3 * math.atan(0.25)  # rad
TALL = {"half_width": 0.1, "half_height": 1.0, "mass": 200.0, "gravity": 9.81}


def springs(block, softness, zeta, peak=PEAK):
    """(stiffness, damping) by the rotation at uplift over the peak, and the damping ratio."""
    m = block["mass"]
    k = m * block["gravity"] / (2 * block["half_width"] * softness * peak)
    return k, zeta * math.sqrt(2 * k * m)


def settled_foot(block, stiffness):
    """Compression of the foot on which the block falls from rest: its centroid falls, too."""
    b, h, m = block["half_width"], block["half_height"], block["mass"]
    upright = m * (b**2 + h**2) / 3 + m * h**2
    return m * block["gravity"] / (1 + m * b**2 / upright) / stiffness


def ratio_of_peaks(block, peak, following):
    alpha = math.atan2(block["half_width"], block["half_height"])
    return formulas.energy_ratios_from_peaks([peak, following], alpha)[0]


def simulated(block, stiffness, damping, peak):
    """r of the first landing on the springs that press and never pull, by rk.simulate."""
    b, h, m, g = block.values()
    structure = rk.TwoSpringStructure(
        mass=m, height=h, inertia=m * (b**2 + h**2) / 3, base_mass=0.0, base_height=0.0,
        base_inertia=0.0, half_width=b, foundation_stiffness=stiffness,
        foundation_damping=damping, gravity=g,
    )  # fmt: skip
    heave = b * math.sin(peak) - settled_foot(block, stiffness) + m * g / (2 * stiffness)
    start = {"theta": peak, "heave": heave}
    run = rk.simulate(structure, rk.GroundMotion.none(1.0), initial=start)
    return ratio_of_peaks(block, peak, run.extremes("theta").minimum)


def integrated(block, stiffness, damping, peak):
    """r of the first landing where dampers pull as long as their foot is below the ground.

    Newton and Euler's equations of the block, whose base's middle moves up and down alone.
    """
    b, h, m, g = block.values()
    inertia = m * (b**2 + h**2) / 3

    def rates(_t, state):
        v, theta, v_dot, rate = state
        sine, cosine = math.sin(theta), math.cos(theta)
        force, moment = -m * g + m * h * cosine * rate**2, m * g * h * sine
        for side in (-1, 1):
            gap = v - side * b * sine
            if gap < 0:
                press = -stiffness * gap - damping * (v_dot - side * b * cosine * rate)
                force, moment = force + press, moment - side * b * cosine * press
        mass = np.array([[m, -m * h * sine], [-m * h * sine, m * h**2 + inertia]])
        return [v_dot, rate, *np.linalg.solve(mass, [force, moment])]

    def turns(t, state):
        return state[3] if t > 0.02 else -1.0

    turns.terminal, turns.direction = True, 1
    start = [b * math.sin(peak) - settled_foot(block, stiffness), peak, 0.0, 0.0]
    found = solve_ivp(
        rates, (0, 3), start, "LSODA", events=turns, rtol=1e-8, atol=1e-11, max_step=2e-3
    )
    return ratio_of_peaks(block, peak, found.y_events[0][0][1])


@pytest.mark.parametrize("pulls", [False, True])
@pytest.mark.parametrize("block", [BLOCK, TALL])
def test_stiff_springs_lose_what_housners_impact_loses(block, pulls):
    alpha = math.atan2(block["half_width"], block["half_height"])
    expected = formulas.energy_ratio_of_block(alpha)
    for zeta in (0.3, 1.0, 3.0):
        errors = [
            formulas.energy_ratio_on_contact_springs(
                *springs(block, softness, zeta), peak_rotation=PEAK / 4, pulls=pulls, **block
            )
            - expected
            for softness in (1e-8, 1e-10, 1e-12)
        ]
        assert abs(errors[-1]) < 1e-4
        if pulls:  # the damper that holds the old foot down acts as 1/N
            np.testing.assert_allclose(np.divide(errors[1:], errors[:-1]), 0.1, rtol=0.15)


@pytest.mark.parametrize(
    ("block", "softness", "zeta", "error"),
    [
        (BLOCK, 0.05, 0.3, 4e-3),
        (BLOCK, 0.01, 1.0, 1e-3),
        (BLOCK, 0.001, 3.0, 5e-4),
        (TALL, 0.01, 0.2, 1e-4),
    ],
)
def test_contacts_that_never_pull_against_simulation(block, softness, zeta, error):
    peak = 0.3 * math.atan2(block["half_width"], block["half_height"])
    k, c = springs(block, softness, zeta, peak)
    expected = simulated(block, k, c, peak)
    found = formulas.energy_ratio_on_contact_springs(k, c, peak_rotation=peak, pulls=False, **block)
    assert found == pytest.approx(expected, abs=error)
    rigid = formulas.energy_ratio_of_block(math.atan2(block["half_width"], block["half_height"]))
    assert abs(expected - rigid) > error / 2  # the loss is not simply Housner's


@pytest.mark.parametrize(
    ("softness", "zeta", "error"), [(0.05, 0.1, 2e-3), (0.01, 1.0, 1e-3), (0.002, 3.0, 2e-3)]
)
def test_dampers_that_pull_against_integration(softness, zeta, error):
    k, c = springs(BLOCK, softness, zeta)
    found = formulas.energy_ratio_on_contact_springs(k, c, peak_rotation=PEAK, **BLOCK)
    assert found == pytest.approx(integrated(BLOCK, k, c, PEAK), abs=error)


@pytest.mark.parametrize("wanted", [0.75, 0.80, 0.85])
def test_springs_for_a_ratio_have_it(wanted):
    found = formulas.contact_springs_for_energy_ratio(wanted, peak_rotation=PEAK, **BLOCK)
    assert found.energy_ratio == pytest.approx(wanted, abs=1e-9)
    assert integrated(BLOCK, found.stiffness, found.damping, PEAK) == pytest.approx(
        wanted, abs=2e-3
    )
    assert integrated(BLOCK, found.stiffness, found.damping, PEAK / 2) == pytest.approx(
        found.energy_ratio_at_half_peak, abs=2e-3
    )
    weight = BLOCK["mass"] * BLOCK["gravity"]
    uplift = formulas.two_spring_uplift_rotation(weight, found.stiffness, BLOCK["half_width"])
    assert found.uplift_rotation == pytest.approx(uplift)
    assert found.uplift_rotation == pytest.approx(PEAK / 100)
    fastest = max(abs(np.roots([BLOCK["mass"], 2 * found.damping, 2 * found.stiffness])))
    assert found.time_step == pytest.approx(0.1 / fastest)
    alpha = math.atan(0.25)
    assert found.rigid_energy_ratio == pytest.approx(formulas.energy_ratio_of_block(alpha))


@given(
    length=st.floats(0.01, 100.0), mass=st.floats(0.01, 100.0), time=st.floats(0.1, 10.0),
    softness=st.floats(1e-4, 1e-2), zeta=st.floats(0.1, 2.0), pulls=st.booleans(),
)  # fmt: skip
@settings(max_examples=20, deadline=None)
def test_ratio_depends_on_no_unit(length, mass, time, softness, zeta, pulls):
    k, c = springs(BLOCK, softness, zeta)
    expected = formulas.energy_ratio_on_contact_springs(
        k, c, peak_rotation=PEAK, pulls=pulls, **BLOCK
    )
    scaled = {
        "half_width": 0.1 * length, "half_height": 0.4 * length,
        "mass": 1000.0 * mass, "gravity": 9.81 * length / time**2,
    }  # fmt: skip
    found = formulas.energy_ratio_on_contact_springs(
        k * mass / time**2, c * mass / time, peak_rotation=PEAK, pulls=pulls, **scaled
    )
    assert found == pytest.approx(expected, rel=1e-6)


def test_more_damping_loses_more_and_shapes_broadcast():
    k, _ = springs(BLOCK, 0.01, 1.0)
    ratios = formulas.energy_ratio_on_contact_springs(
        k, k * np.geomspace(1e-4, 1e-2, 9), peak_rotation=[[PEAK], [PEAK / 2]], **BLOCK
    )
    assert ratios.shape == (2, 9)
    assert (np.diff(ratios) < 0).all()


def test_inertia_is_that_of_a_rectangle_if_not_given():
    k, c = springs(BLOCK, 0.01, 1.0)
    given_one, none = (
        formulas.energy_ratio_on_contact_springs(k, c, peak_rotation=PEAK, **BLOCK, **more)
        for more in ({"inertia": 1000.0 * 0.17 / 3}, {})
    )
    assert given_one == pytest.approx(none, rel=1e-9)
    slighter = formulas.energy_ratio_on_contact_springs(
        1e15, 1e9, peak_rotation=PEAK, inertia=10.0, **BLOCK
    )
    rigid = formulas.energy_ratio_of_block(
        math.atan(0.25), inertia=10.0, mass=1000.0, radius=math.hypot(0.1, 0.4)
    )
    assert slighter == pytest.approx(rigid, abs=1e-3)


def test_old_foot_that_stays_down_has_no_ratio():
    soft = springs(BLOCK, 0.9, 0.5)
    held = springs(BLOCK, 0.01, 200.0)
    for pair in (soft, held):
        found = formulas.energy_ratio_on_contact_springs(*pair, peak_rotation=PEAK, **BLOCK)
        assert math.isnan(found)


def test_mistakes_say_what_is_reached():
    def wanted(r, **more):
        return formulas.contact_springs_for_energy_ratio(
            r, **{"peak_rotation": PEAK, **BLOCK, **more}
        )

    assert refused(wanted, 0.95) == ("energy_ratio", 0.95)
    assert refused(wanted, 0.7, pulls=False) == ("energy_ratio", 0.7)
    assert refused(wanted, 0.8, uplift_rotation=1.0) == ("uplift_rotation", 1.0)
    assert refused(wanted, 0.8, uplift_rotation=0.99 * PEAK)[0] == "uplift_rotation"
    assert refused(wanted, 0.8, peak_rotation=0.3) == ("peak_rotation", 0.3)
    assert refused(wanted, 0.8, half_width=0.6) == ("half_width", 0.6)
    with refuses("stiffness", -1.0):
        formulas.energy_ratio_on_contact_springs(-1.0, 0.0, peak_rotation=PEAK, **BLOCK)


def test_table_of_opensees_expects_what_the_formula_gives_and_has_it():
    _, _, rest = PAGE.read_text(encoding="utf-8").partition(opensees_restitution.START)
    lines = rest.partition(opensees_restitution.END)[0].strip().splitlines()[2:]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert len(rows) == len(opensees_restitution.ways())
    gaps = [row for row in rows if row[0] == opensees_restitution.GAP]
    for name, softness, zeta, step, expected, measured, _follow in gaps:
        way = opensees_restitution.Way(name, float(softness), float(zeta), float(step))
        found = formulas.energy_ratio_on_contact_springs(
            way.stiffness, way.damping, peak_rotation=PEAK, **BLOCK
        )
        assert float(expected) == pytest.approx(found, abs=5e-4)  # three digits of zeta
        assert float(measured) == pytest.approx(found, abs=0.006 if way.step <= 0.1 else 0.02)


def test_table_without_opensees_says_how_to_install_it(monkeypatch):
    monkeypatch.setattr(opensees_restitution.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(SystemExit, match="pip install openseespy"):
        opensees_restitution.main([])
