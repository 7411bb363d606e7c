"""The impact law where none is named, and the energy that impacts gain by any law."""

import dataclasses
import functools
import json
import math

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.cli import main
from rockeom.plots import design_report
from rockeom.symbolic import Body, coordinate, parameter, rocking_structure, turned
from tests.soak.energy import gains_of
from tests.typical import by_model, column, every_structure

PIER = rk.FlexibleStructure(
    mass=1.2e6, height=11.0, inertia=4.8e6, half_width=3.0, base_mass=2e5, base_height=0.75,
    base_inertia=6.375e5, stiffness=1.2e6 * (2 * math.pi / 0.94) ** 2,
    damping=2 * 0.05 * 1.2e6 * 2 * math.pi / 0.94,
)  # fmt: skip
"""A bridge pier of 1,200 t at 11 m with a period of 0.94 s and 5 % damping."""


@functools.cache
def pacoima():
    return rk.GroundMotion.from_library("Pacoima 164").scaled_to(5.0)


@functools.cache
def shaken(law):
    return rk.simulate(PIER, pacoima(), impact=law)


def jacobian(pier, mode, u):
    """(5, n) of both velocities of the mass and of the base, and of the rotation, upright."""
    b = {"left": -1, "right": 1, "both": 0}[mode] * pier.half_width
    turning = np.array([pier.height, b - u, pier.base_height, b, 1.0])
    bending = np.array([1.0, 0.0, 0.0, 0.0, 0.0])
    return np.column_stack([turning * (mode != "both"), bending])


WEIGHTS = np.diag([PIER.mass] * 2 + [PIER.base_mass] * 2 + [PIER.inertia + PIER.base_inertia])


def kinetic(mode, state):
    """Of the pier upright, by the velocities of its masses."""
    v = jacobian(PIER, mode, state["u"]) @ [state["theta_dot"], state["u_dot"]]
    return 0.5 * v @ WEIGHTS @ v


def swinging_block():
    """A block in which a mass hangs that swings: it has no spring, and is not rigid either."""
    m, h, b, g, w, c, a = (
        parameter(name, name, unit, name)
        for name, unit in (
            ("mass", "kg"), ("half_height", "m"), ("half_width", "m"), ("gravity", "m/s2"),
            ("hung", "kg"), ("length", "m"), ("height", "m"),
        )
    )  # fmt: skip
    theta = coordinate("theta", "theta", "rad", "rotation of the block")
    phi = coordinate("phi", "phi", "rad", "swing relative to the block")

    def bodies(pivot):
        hook = turned((0, a.symbol), pivot, theta.position)
        angle = theta.position + phi.position
        return (
            Body(
                "block", m.symbol, turned((0, h.symbol), pivot, theta.position),
                m.symbol * (b.symbol**2 + h.symbol**2) / 3, theta.position,
            ),
            Body(
                "hung", w.symbol,
                (hook[0] - c.symbol * sp.sin(angle), hook[1] - c.symbol * sp.cos(angle)),
            ),
        )  # fmt: skip

    return rocking_structure(
        name="swinging_block", title="A block in which a mass swings",
        parameters=(m, h, b, g, w, c, a), coordinates=(theta, phi), bodies=bodies,
        half_width=b.symbol, gravity=g.symbol,
    )  # fmt: skip


@functools.cache
def bending():
    """One of each kind whose impacts move something besides the rotation."""
    return {
        "column": column(),
        "oscillator": rk.UpliftingOscillator.from_frequency(20.0, 0.02, height=1.5, half_width=0.4),
        "frame": rk.ShearFrame(
            masses=[20e3, 15e3], heights=[3.5, 7.0], stiffnesses=[20e6, 15e6],
            dampings=[120e3, 90e3], half_width=1.2, base_mass=10e3,
        ),
        "wall": rk.WallWithFrame(
            mass=4e4, half_width=1.0, height=4.0, inertia=3e5, frame_mass=1e5,
            frame_stiffness=2e7, frame_damping=6e4, link_height=8.0, link_stiffness=1e8,
            link_damping=1e5,
        ),
        "declared": rk.structure(
            swinging_block(), mass=900.0, half_height=1.0, half_width=0.4, gravity=9.81,
            hung=300.0, length=0.7, height=1.6,
        ),
    }  # fmt: skip


NAMES = ("column", "oscillator", "frame", "wall", "declared")
unit = st.floats(-1.0, 1.0)


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(NAMES), st.lists(unit, min_size=6, max_size=6), st.booleans())
def test_no_landing_of_a_structure_that_bends_gains_energy_by_default(name, values, right):
    structure = bending()[name]
    n = len(structure.states) // 2
    state = {
        x: 0.02 * v if i < n else v
        for i, (x, v) in enumerate(zip(structure.states, values, strict=False))
    }
    turning = 0.05 + abs(values[0])
    state |= {"theta": 0.0, "theta_dot": -turning if right else turning}
    mode = "right" if right else "left"
    after, follows = structure.after_impact(state, mode)
    before = structure.energies(state, mode=mode)["kinetic_energy"]
    left = structure.energies(after, mode=follows)["kinetic_energy"]
    assert left <= before * (1 + 1e-12)


@pytest.mark.parametrize(("half_width", "mode"), [(3.0, "both"), (1.0, "left")])
def test_landing_projects_the_velocities_on_the_motions_that_follow(half_width, mode):
    """M q'+ = J+' m v-, of both masses by hand: a stocky pier stands on both feet then."""
    pier = dataclasses.replace(PIER, half_width=half_width)
    u, start = 0.03, np.array([-0.12, 0.2])  # theta_dot, u_dot
    new = jacobian(pier, mode, u)
    arriving = jacobian(pier, "right", u) @ start
    expected = np.linalg.lstsq(WEIGHTS**0.5 @ new, WEIGHTS**0.5 @ arriving, rcond=None)[0]
    after, follows = pier.after_impact({"u": u, "theta_dot": start[0], "u_dot": start[1]}, "right")
    assert follows == mode
    np.testing.assert_allclose([after["theta_dot"], after["u_dot"]], expected, rtol=1e-10)


@pytest.mark.parametrize("law", [None, rk.AngularMomentum(), rk.EnergyRatio(0.8)])
def test_energy_that_impacts_of_a_pier_gain_and_lose(law):
    """By the velocities of its masses; none gains by default, a third of a megajoule otherwise."""
    run = shaken(law)
    energies = np.array(
        [[kinetic(i.mode_before, i.before), kinetic(i.mode_after, i.after)] for i in run.impacts]
    )
    change = np.diff(energies)[:, 0]
    gains = change[change > 1e-9 * energies[:, 0]]
    np.testing.assert_allclose(run.impacts.energy_gains, gains, rtol=1e-9)
    assert run.impacts.energy_loss == pytest.approx(-change[change < 0].sum(), rel=1e-9)
    said = f"{len(gains)} of {len(change)} impacts gained kinetic energy, {gains.sum():.4g} J"
    if law is None:
        assert not len(gains)
        assert "gained" not in run.summary()
        assert "Impact law: Impulsive(), by default." in run.summary()
    else:
        assert len(gains) > 40
        assert gains.sum() > 2e5
        assert said in run.summary()
        assert any(said in hint for hint in run.hints)
        assert f"Impact law: {law}. The impacts lost" in run.summary()


@pytest.mark.parametrize("lanes", [True, False])
def test_sweep_counts_impacts_that_gain_energy(lanes):
    laws = [None, rk.AngularMomentum(), rk.EnergyRatio(0.8), rk.Impulsive()]
    found = rk.simulate_many(
        lambda law: rk.Case(PIER, pacoima(), laws[law]),
        {"law": range(len(laws))},
        sweep_options=rk.SweepOptions(lanes=lanes),
    )
    assert found.attrs["impact_law"] == "Impulsive(), by default, of the first case"
    runs = [shaken(law) for law in laws]
    gains = [run.impacts.energy_gains for run in runs]
    assert found.impact_gains.values.tolist() == [len(of_run) for of_run in gains]
    np.testing.assert_allclose(
        found.impact_energy_gained, [of_run.sum() for of_run in gains], rtol=1e-6
    )
    assert found.impact_energy_gained.attrs["units"] == "J"
    assert found.peak.sel(law=0).values.tolist() == found.peak.sel(law=3).values.tolist()


def test_impacts_that_gain_are_known_of_a_motion_of_which_only_samples_are_kept():
    run = rk.simulate(PIER, pacoima(), impact=rk.AngularMomentum(), keep="samples")
    assert len(run.impacts.energy_gains) == len(shaken(rk.AngularMomentum()).impacts.energy_gains)
    assert "impacts gained kinetic energy" in run.summary()


# -- one default for every way to ask


@pytest.mark.parametrize("name", NAMES)
def test_structure_that_bends_lands_by_momentum_whoever_asks(name):
    structure = bending()[name]
    start = {"theta": 0.5 * math.atan(structure.uplift_acceleration / 9.81)}
    still = rk.GroundMotion.none(1.5)
    run = rk.simulate(structure, still, initial=start)
    named = rk.simulate(structure, still, impact=rk.Impulsive(), initial=start)
    assert run.impacts
    np.testing.assert_array_equal(run.y, named.y)
    assert run.statistics["impact_law"] == "Impulsive(), by default"
    assert named.statistics["impact_law"] == "Impulsive()"
    first = run.impacts[0]
    after, _ = structure.after_impact(first.before, first.mode_before)
    assert after["theta_dot"] == pytest.approx(first.after["theta_dot"], rel=1e-12)
    case = rk.Case(structure, still, initial=start)
    sweep = rk.simulate_many(lambda i: case, {"i": [0]}, sweep_options=rk.SweepOptions(lanes=False))
    assert sweep.final.values[0].tolist() == list(run.final.values())
    if name == "column":
        case = rk.Case(structure, still, initial=rk.duals(**start))
        np.testing.assert_array_equal(rk.tangents(case).response.y, run.y)


@pytest.mark.parametrize(
    "structure", [s for s in every_structure() if s.model != "flexible_structure"], ids=by_model
)
def test_structure_that_only_turns_keeps_its_law_and_its_bits(structure):
    if not structure.has_impacts:
        assert structure.default_impact is None
        assert not structure.describe_impact(None)
        return
    start = {structure.states[0]: 0.2 * structure.overturning_rotation}
    runs = [
        rk.simulate(structure, rk.GroundMotion.none(2.0), impact=law, initial=start)
        for law in (None, rk.AngularMomentum())
    ]
    np.testing.assert_array_equal(runs[0].y, runs[1].y)
    assert runs[0].statistics["impact_law"] == "AngularMomentum(), by default"
    assert not len(runs[0].impacts.energy_gains)


def test_wall_whose_centre_does_not_jump_lands_without_a_change():
    """b(0) = 0: both sides turn about one point, and no law has anything to change."""
    wall = rk.FlexibleControlledWall.thesis(damping_ratio=0.02)
    state = {"u": 0.01, "theta_dot": -0.3, "u_dot": 0.2}
    after, _ = wall.after_impact(state, "right")
    assert after["theta_dot"] == pytest.approx(-0.3, rel=1e-12)
    run = rk.simulate(wall, rk.GroundMotion.none(1.0), initial={"theta": 0.01, "u": 0.02})
    assert run.impacts
    assert not len(run.impacts.energy_gains)


def test_report_and_command_line_name_the_default_and_the_gains(tmp_path, capsys):
    page = design_report(PIER, [pacoima()])
    assert dict(page.facts)["law of impact"] == "Impulsive(), by default"
    assert not any("gained energy" in said for said in page.assumptions)
    page = design_report(PIER, [pacoima()], impact=rk.AngularMomentum())
    assert any("gained energy under 1 of 1 records" in said for said in page.assumptions)
    values = [f"{name}={value!r}" for name, value in PIER.parameters().items()]
    asked = ["simulate", "flexible_structure", "--record", "Pacoima 164", "--set", *values]
    assert main([*asked, "--out", str(tmp_path)]) == 0
    assert "Impact law: impulsive, by default." in capsys.readouterr().out
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["impact"] == "Impulsive()"
    assert summary["statistics"]["impact_law"] == "Impulsive(), by default"
    for model, law in (("flexible_structure", "impulsive"), ("rigid_block", "angular-momentum")):
        assert main(["models", model]) == 0
        assert f"; if not given, {law}" in capsys.readouterr().out


def test_some_random_structures_that_bend_gain_no_energy_under_records():
    found = gains_of(range(40))
    assert found.impacts > 100
    assert not found.gained, found
