"""Hints at units, masses and friction that are hardly meant, and none where all is well."""

import json
import math
import re

import numpy as np
import pytest

import rockeom as rk
from rockeom.cli import main
from rockeom.plots import design_report
from tests.typical import column

BLOCK = rk.RigidBlock(half_width=0.2, half_height=1.0, mass=1000.0)
"""A ground acceleration of 1.962 m/s2 lifts it."""
PIER = rk.FlexibleStructure(
    mass=300e3, height=12.0, inertia=2e6, base_mass=40e3, base_height=0.5, base_inertia=60e3,
    half_width=1.5, stiffness=20e6, damping=250e3,
)  # fmt: skip
STILL = rk.GroundMotion.none(0.1)


def record(peak: float, **units: str) -> rk.GroundMotion:
    t = 0.01 * np.arange(300)
    return rk.GroundMotion.from_array(peak * np.sin(4.0 * t), 0.01, **units)


# -- motions that a tie decides


@pytest.mark.parametrize("structure", [BLOCK, PIER])
@pytest.mark.parametrize("across", [0.0, 1e-9])
def test_vertical_shaking_alone_lifts_both_feet_and_a_tie_decides(structure, across):
    horizontal = rk.GroundMotion.constant(across, 0.5)
    up = rk.GroundMotion.harmonic(14.0, period=0.5, duration=0.5)
    run = rk.simulate(structure, horizontal, vertical=up)
    ties = [h for h in run.hints if "both feet lift at once: it leans to the left" in h]
    assert len(ties) == (across == 0.0)
    assert run.events[0].mode_after == "left"


# -- ground motions in g


@pytest.mark.parametrize("structure", [BLOCK, PIER, column()])
def test_record_in_g_that_was_given_without_its_unit(structure):
    run = rk.simulate(structure, record(0.3))
    (hint,) = run.hints
    assert "0.3 m/s2" in hint
    assert 'units="g"' in hint
    assert f"Hint: {hint}" in run.summary()
    given = rk.simulate(structure, record(0.3, units="g"), duration=3.0, impact=rk.Impulsive())
    assert not any("meant in g" in hint for hint in given.hints)


def test_peak_in_g_that_a_motion_is_scaled_to():
    sine = rk.GroundMotion.single_sine(1.0, 0.5)
    (hint,) = rk.simulate(BLOCK, sine.scaled_to(0.4)).hints
    assert '0.4 g are 3.924 m/s2: scale it to a pga of "0.4 g"' in hint
    assert rk.simulate(BLOCK, sine.scaled_to(0.4 * 9.81)).hints == ()


def test_block_that_may_slide_is_asked_too():
    block = rk.SlidingBlock(half_width=0.2, half_height=1.0, friction=0.5, restitution=0.0)
    assert "meant in g" in rk.simulate(block, record(0.3)).hints[0]
    assert rk.simulate(block, record(1.5)).hints == ()


@pytest.mark.parametrize("peak", [0.01, 0.99, 1.5, 1.96, 2.5])
def test_weak_motion_that_could_be_meant_is_not_questioned(peak):
    """Noise of thousandths of g, and what comes near the acceleration that lifts the block."""
    assert rk.simulate(BLOCK, record(peak)).hints == ()


def test_quiet_ground_and_free_vibration_are_not_questioned():
    assert rk.simulate(BLOCK, STILL).hints == ()
    assert rk.simulate(BLOCK, record(0.3), initial={"theta": 0.05}).hints == ()


# -- lengths and dampings


@pytest.mark.parametrize(
    ("structure", "size"),
    [
        (rk.RigidBlock(half_width=95.0, half_height=450.0, mass=1.0), "900 m"),
        (rk.RigidBlock(half_width=95.0, half_height=0.45), "190 m"),
        (rk.SlenderBlock(radius=460.0, alpha=0.2), "m: were its lengths"),
        (rk.LumpedMassStructure(
            mass=122.6, height=1050.0, inertia=44.8, base_mass=45.6, base_height=100.0,
            base_inertia=1.37, half_width=285.0,
        ), "1050 m"),
    ],
)  # fmt: skip
def test_lengths_in_centimetres_or_millimetres(structure, size):
    (hint,) = structure.hints()
    assert size in hint
    assert "cm or mm" in hint


@pytest.mark.parametrize("change", [{"gravity": 981.0}, {"gravity": 1.0}, {"friction": 60.0}])
def test_gravity_in_another_unit_and_friction_in_percent(change):
    size = {"half_width": 0.2, "half_height": 0.6, "friction": 1.5, "restitution": 0.0}
    assert rk.SlidingBlock(**size).hints() == ()
    (hint,) = rk.SlidingBlock(**size | change).hints()
    ((name, value),) = change.items()
    assert hint.startswith(f"{name} is {value:g}")


def test_damping_ratio_that_was_given_for_a_damping():
    values = column().parameters()
    typed = rk.FlexibleStructure(**values | {"damping": 0.05})
    (hint,) = typed.hints()
    times = float(re.findall(r"takes (\S+) times", hint)[0])
    mended = rk.FlexibleStructure(**values | {"damping": 0.05 * times})
    assert mended.fixed_base().damping_ratios[0] == pytest.approx(0.05, rel=5e-3)
    frame = rk.ShearFrame(
        masses=[2e4], heights=[3.0], stiffnesses=[2e7], dampings=[0.05], half_width=1.0,
        base_mass=1e4,
    )  # fmt: skip
    assert "damping ratio" in frame.hints()[0]


def test_damping_ratio_that_was_given_for_the_dampers_of_a_foundation():
    """Two springs under a mass: heave has the damping ratio 2 c / (2 sqrt(2 k m))."""
    k, m = 1e6, 1.5e3

    def hints(c):
        return rk.LumpedMassStructure(
            mass=1e3, height=2.0, inertia=0.0, base_mass=m - 1e3, base_height=0.0,
            base_inertia=100.0, half_width=0.5, support=rk.TwoSprings(stiffness=k, damping=c),
        ).hints()  # fmt: skip

    (hint,) = hints(0.05)
    assert hint.startswith("foundation_damping is 0.05 N s/m")
    told = float(re.findall(r"is about (\S+) N s/m", hint)[0])
    assert told == pytest.approx(0.05 * math.sqrt(2 * k * m), rel=0.5)
    assert hints(told) == () == hints(0.0)


@pytest.mark.parametrize(
    "structure",
    [
        BLOCK,
        PIER,
        column(),
        rk.RigidBlock(half_width=4.0, half_height=24.0),
        rk.RigidBlock(half_width=1e-3, half_height=5e-3),
        rk.NondimensionalBlock(alpha=0.2),
        rk.UpliftingOscillator.from_frequency(10.0, 0.0, 5.0, 1.0),  # undamped, as is meant
        rk.UpliftingOscillator.from_frequency(10.0, 0.002, 5.0, 1.0),
        rk.FlexibleControlledWall.thesis(),
    ],
)
def test_plausible_structures_are_not_questioned(structure):
    assert structure.hints() == ()


# -- masses at their default, where forces are reported


def test_report_and_files_say_that_forces_are_those_of_a_kilogram(tmp_path, capsys):
    sizes = {"half_width": 0.2, "half_height": 1.0}
    kilogram, given = (
        design_report(rk.RigidBlock(**sizes, **mass), [rk.GroundMotion.half_sine(3.0, 0.3)])
        for mass in ({}, {"mass": 1000.0})
    )
    assert "shear [N/kg]" in kilogram.columns
    assert "shear [kN]" in given.columns
    shear = kilogram.columns.index("shear [N/kg]")
    assert float(kilogram.rows[0][shear]) == pytest.approx(float(given.rows[0][shear]), 1e-3)
    assert "base shear [N/kg]" in {ax.get_xlabel() for ax in kilogram.figures().axes}
    assert any("mass is at the default" in sentence for sentence in kilogram.assumptions)
    assert not any("mass" in sentence and "default" in sentence for sentence in given.assumptions)

    arguments = "rigid_block --pulse single-sine amplitude=3 period=0.5 --set half_width=0.2"
    command = ["simulate", *arguments.split(), "half_height=1.0", "--out", str(tmp_path)]
    for more, said in (([], True), (["mass=1000"], False)):
        where = command.index("--out")
        assert main([*command[:where], *more, *command[where:]]) == 0
        capsys.readouterr()
        hints = json.loads((tmp_path / "summary.json").read_text())["hints"]
        assert any("mass is at the default" in hint for hint in hints) == said


def test_motion_without_forces_says_nothing_of_the_mass():
    assert rk.simulate(rk.RigidBlock(half_width=0.2, half_height=1.0), record(3.0)).hints == ()


# -- friction


def test_friction_that_hardly_any_surface_has():
    stocky = rk.RigidBlock(half_width=1.0, half_height=1.0, mass=1.0)
    pushed = rk.GroundMotion.constant(9.0, 0.5)  # below g tan(alpha): it slides before it rocks
    run = rk.simulate(stocky, pushed)
    (hint,) = run.hints
    assert run.support.friction_demand == pytest.approx(9.0 / 9.81, rel=1e-9)
    assert f"friction coefficient of {9.0 / 9.81:.3g}" in hint
    assert f"Hint: {hint}" in run.summary()
    enough = rk.simulate(stocky, rk.GroundMotion.constant(0.79 * 9.81, 0.5))
    assert enough.hints == ()


@pytest.mark.parametrize(("ratio", "rough"), [(0.7, True), (0.8, False)])
def test_impulse_that_needs_more_friction_than_the_forces(ratio, rough):
    """The centroid's velocity changes by h (1 - e) across and b (1 + e) up, times the rate."""
    run = rk.simulate(
        BLOCK, rk.GroundMotion.none(2.0), initial={"theta": 0.05}, impact=rk.VelocityRatio(ratio)
    )
    needed = 1.0 / 0.2 * (1.0 - ratio) / (1.0 + ratio)
    assert run.support.impact_friction_demand == pytest.approx(needed, rel=1e-9)
    assert any(f"friction coefficient of {needed:.3g}" in hint for hint in run.hints) == rough


def test_no_friction_helps_where_no_foot_is_pressed():
    """The ground falls away faster than g while it shakes."""
    falling = rk.GroundMotion.half_sine(-12.0, 0.1)
    run = rk.simulate(BLOCK, rk.GroundMotion.half_sine(1.0, 0.1), vertical=falling)
    (hint,) = run.hints
    assert hint.startswith("No friction coefficient would have kept it from sliding:")


def test_upper_block_of_a_stack_that_never_slips_is_asked_too():
    """At rest the upper block needs the ratio of both accelerations, as the lower one does."""
    block = rk.RigidBlock(half_width=1.0, half_height=0.5, mass=1e3)
    stack = rk.StackedBlocks(lower=block, upper=rk.RigidBlock(half_width=1.0, half_height=0.1))
    run = rk.simulate(stack, rk.GroundMotion.constant(8.5, 0.2))
    assert list(run.support.friction_demands) == ["left+right", "upper_left+upper_right"]
    (hint,) = run.hints
    assert f"friction coefficient of {8.5 / 9.81:.3g}" in hint


def test_feet_that_are_held_down_are_not_asked():
    resonant = rk.GroundMotion.harmonic(3.0, frequency=1.0 / 0.092, duration=0.6)
    run = rk.simulate(column().fixed_base(), resonant)
    assert run.support.friction_demand > 0.8
    assert run.hints == ()


def test_feet_that_slide_and_records_of_samples_are_not_asked():
    block = rk.SlidingBlock(half_width=1.0, half_height=1.0, friction=1.5, restitution=0.0)
    pushed = rk.GroundMotion.constant(9.0, 0.5)
    assert rk.simulate(block, pushed).hints == ()
    stocky = rk.RigidBlock(half_width=1.0, half_height=1.0, mass=1.0)
    assert rk.simulate(stocky, pushed, keep="samples").hints == ()


def test_report_counts_the_records_that_need_too_much_friction():
    stocky = rk.RigidBlock(half_width=1.0, half_height=1.0, mass=1e3)
    motions = [rk.GroundMotion.constant(a, 0.5) for a in (1.0, 8.5, 9.0)]
    page = design_report(stocky, motions)
    assert any(sentence.startswith("Under 2 of them") for sentence in page.assumptions)
    page = design_report(stocky, motions[:1])
    assert not any("rough concrete" in sentence for sentence in page.assumptions)
    assert math.isclose(page.results[0].run.support.friction_demand, 1.0 / 9.81)
