"""The controlled rocking wall of thesis chapter 4: three models of it, against closed forms."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.symbolic.structures.controlled_wall import controlled_wall_oscillator
from rockeom.thesis.wall_tests import energy_ratio_4_31, energy_ratio_4_36, energy_ratio_4_38
from tests.refusals import refused, refuses, told

WALL = analysis.Wall.thesis()
MEASURED = identification.FreeVibration.table_a1()
EXACT = rk.SolverOptions(rtol=1e-12, atol=1e-15)
H = WALL.height
RELEASE = -0.03041  # the first peak of Table A-1 [m]
LAWS = rk.EnergyRatioAtSpeed
STIFFER = WALL.mass / 1.06  # 4.8.1 raises F_k by 6 %


def oscillator(energy_ratio=1.0, **changes):
    return rk.ControlledWallOscillator.from_wall(WALL, energy_ratio, **changes)


@cache
def freed(structure, impact=None, displacement=RELEASE, duration=1.5):
    """From rest at a displacement of the height H."""
    start = (
        {"u": displacement} if "u" in structure.states else {"theta": np.arcsin(displacement / H)}
    )
    still = rk.GroundMotion.none(duration)
    return rk.simulate(structure, still, impact=impact, initial=start, options=EXACT)


def peaks(run):
    """(times, displacements at the height H) at which the wall turns back, the start included."""
    name = run.states[run.structure.module.ROTATION]
    t = np.linspace(0.0, run.t[-1], 20001)
    rate = run.at(t)[f"{name}_dot"]
    turns = t[:-1][rate[1:] * rate[:-1] < 0]
    for _ in range(6):  # Newton's method on the dense output
        h = 1e-6
        slope = (run.at(turns + h)[f"{name}_dot"] - run.at(turns - h)[f"{name}_dot"]) / (2 * h)
        turns = turns - run.at(turns)[f"{name}_dot"] / slope
    times = np.append(0.0, turns[turns > 1e-3])
    found = run.at(times)[name]
    return times, found if name == "u" else H * np.sin(found)


# --- statics


@pytest.mark.parametrize(
    "eccentricity", [0.0, 0.2], ids=["tendon in the middle", "eccentric tendon"]
)
def test_pushover_of_the_engine_is_the_restoring_force_of_the_closed_form(eccentricity):
    (tendon,) = WALL.tendons
    moved = formulas.Tendon(
        tendon.stiffness, tendon.initial_force, tendon.yield_force, eccentricity
    )
    wall = analysis.Wall(**{**vars(WALL), "tendons": (moved,)})
    displacements = np.concatenate([np.linspace(-0.08, -1e-4, 40), np.linspace(1e-4, 0.08, 40)])
    engine = rk.ControlledWallOscillator.from_wall(wall, 1.0).pushover(displacements)
    assert engine == pytest.approx(wall.restoring_force(displacements), rel=1e-12)


def test_pushover_rises_falls_and_rises_again_as_the_rotation_centre_moves_out():
    force = oscillator().pushover
    assert force(4.553e-3) == pytest.approx(25.01e3, abs=10)
    assert force(9.228e-3) == pytest.approx(19.48e3, abs=10)
    steps = np.array([-1e-4, 1e-4])
    assert (force(4.553e-3 + steps) < force(4.553e-3)).all()
    assert (force(9.228e-3 + steps) > force(9.228e-3)).all()
    assert WALL.yield_displacement() == pytest.approx(42.14e-3, abs=1e-5)
    slope = np.diff(force(np.array([42.0e-3, 42.1e-3, 42.2e-3, 42.3e-3])))
    assert slope[0] > 10 * abs(slope[2])  # the tendon yields


def test_two_eccentric_tendons_push_as_the_closed_form_says_and_unlike_to_both_sides():
    tendons = (
        formulas.Tendon(11.7e6, 40e3, 90e3, eccentricity=-0.3),
        formulas.Tendon(8.0e6, 60e3, 120e3, eccentricity=0.25),
    )
    wall = analysis.Wall(**{**vars(WALL), "tendons": tendons})
    values = oscillator().parameters()
    for name in ("tendon_stiffness", "initial_force", "yield_force", "eccentricity"):
        short = name.removeprefix("tendon_")
        del values[name]
        values |= {f"{name}_{i}": getattr(t, short) for i, t in enumerate(tendons, 1)}
    values |= {f"speed_limit_{i}": 1e9 for i in range(1, 4)}
    del values["speed_limit_4"]
    built = rk.structure(controlled_wall_oscillator(2), **values)
    m = built.module

    def force(displacement: float, mode: str) -> float:
        y, out = np.zeros(m.N_STATES), np.empty(m.N_STATES // 2)
        y[0] = displacement
        m.statics(m.MODES.index(mode), y, built.vector, 0.0, out)
        return out[0]

    for d in (0.004, 0.012):
        right, left = force(d, "right"), force(-d, "left")
        assert right == pytest.approx(float(wall.restoring_force(d)), rel=1e-12)
        assert left == pytest.approx(float(wall.restoring_force(-d)), rel=1e-12)
    # a rotation to the right stretches the tendon to the left more, and that is the stiffer one
    assert right > 1.05 * -left
    # at 40 mm to the right the left tendon yields, the right one does not
    extension = [wall.tendon_extension(0.04, i) for i in (0, 1)]
    reserve = [(t.yield_force - t.initial_force) / t.stiffness for t in tendons]
    assert extension[0] > reserve[0]
    assert extension[1] < reserve[1]
    yields = force(0.04, "right_yield_1")
    assert yields == pytest.approx(float(wall.restoring_force(0.04)), rel=1e-12)


# --- free motion without losses


@pytest.mark.parametrize(
    "structure", [oscillator(), rk.ControlledWall.thesis()], ids=["oscillator", "Lagrange"]
)
def test_energy_is_conserved_without_losses(structure):
    energy = freed(structure)["total_energy"]
    assert np.ptp(energy) < 1e-9 * energy[0]


@pytest.mark.parametrize(
    "structure", [rk.SubstituteGravityWall.thesis(), rk.SimplifiedSubstituteGravityWall.thesis()]
)
def test_substitute_gravity_gives_and_takes_the_work_of_its_weight(structure):
    """Kinetic energy against a quadrature of the moment, typed from 4-32 and 4-37."""
    migrates = type(structure) is rk.SubstituteGravityWall

    def moment(theta):
        d = H * np.sin(theta)
        b = WALL.half_width * (1 - np.exp(-((d / 3.551e-3) ** 2)) if migrates else 1.0)
        radius, alpha = np.hypot(b, WALL.centroid_height), np.arctan2(b, WALL.centroid_height)
        weight = WALL.mass * WALL.gravity + float(WALL.tendon_force(d))
        return weight * radius * np.sin(alpha - theta)

    run = freed(structure, rk.EnergyRatio(1.0))
    start = abs(run["theta"][0])
    times = np.linspace(0.01, 0.4, 12)
    state = run.at(times)
    for theta, rate in zip(np.abs(state["theta"]), state["theta_dot"], strict=True):
        work, _ = quad(moment, theta, start, epsabs=1e-10, epsrel=1e-12, limit=200)
        assert WALL.corner_inertia * rate**2 / 2 == pytest.approx(work, rel=1e-9, abs=1e-7)


def lagrangian_quarter_period(displacement):
    """Time to upright by the integral of energy, with positions and their slopes in numbers."""
    wall = rk.ControlledWall.thesis()

    def place(theta):
        b = (wall.half_width - wall.edge_distance) * (
            1 - np.exp(-((H * np.sin(theta) / wall.transition) ** 2))
        )
        x = b * (1 - np.cos(theta)) + wall.centroid_height * np.sin(theta)
        y = b * np.sin(theta) + wall.centroid_height * np.cos(theta)
        a = wall.anchor_height
        top = b * (1 - np.cos(theta)) + a * np.sin(theta), b * np.sin(theta) + a * np.cos(theta)
        return x, y, np.sqrt(top[0] ** 2 + top[1] ** 2) - a

    def slope(theta):
        """By a complex step, without differences."""
        x, y, _ = place(theta + 1e-30j)
        return x.imag / 1e-30, y.imag / 1e-30

    def potential(theta):
        _, y, extension = place(theta)
        force = wall.initial_force + wall.tendon_stiffness * extension
        return wall.mass * wall.gravity * y + force**2 / (2 * wall.tendon_stiffness)

    start = np.arcsin(displacement / H)

    def pace(phi):
        theta = start * np.cos(phi)
        dx, dy = slope(theta)
        inertia = wall.inertia + wall.mass * (dx**2 + dy**2)
        spare = potential(start) - potential(theta)
        return start * np.sin(phi) * np.sqrt(inertia / (2 * spare))

    nodes, weights = np.polynomial.legendre.leggauss(400)
    return float(
        sum(w * pace(np.pi / 4 * (1 + x)) for x, w in zip(nodes, weights, strict=True)) * np.pi / 4
    )


def test_wall_by_lagrange_comes_upright_when_the_integral_of_its_energy_says():
    run = freed(rk.ControlledWall.thesis())
    # near the release the quadrature loses digits in its difference of energies
    assert run.impacts[0].time == pytest.approx(lagrangian_quarter_period(-RELEASE), rel=5e-9)


def quarter_period(structure, displacement):
    """Time from rest to upright in ms, without losses."""
    law = rk.EnergyRatio(1.0) if structure.has_impacts else None
    for event in freed(structure, law, -displacement, 0.3).events:
        if event.kind == "impact" or (event.mode_before, event.mode_after) == (
            "left_near", "right",
        ):  # fmt: skip
            return 1e3 * event.time
    raise AssertionError("it does not come upright")


@pytest.mark.parametrize(
    ("displacement", "elastic", "full", "substitute", "simplified"),
    [
        (0.003, 28.01, 27.82, 40.36, 24.58),
        (0.010, 44.86, 44.91, 43.22, 42.18),
        (-RELEASE, 70.58, 70.72, 65.59, 65.48),
    ],
)
def test_what_the_models_of_the_thesis_leave_out(
    displacement, elastic, full, substitute, simplified
):
    """Quarter periods in ms. The oscillator, with M_e = m, is within 0.7 % of the full dynamics.

    Substitute gravity is not: its weight acts about a centre 508 mm out, while its tendon grows as
    about one 412 mm out, and it has no term with the rate at which that centre moves.
    """
    assert quarter_period(oscillator(), displacement) == pytest.approx(elastic, abs=0.01)
    assert quarter_period(rk.ControlledWall.thesis(), displacement) == pytest.approx(full, abs=0.01)
    moving, fixed = rk.SubstituteGravityWall.thesis(), rk.SimplifiedSubstituteGravityWall.thesis()
    assert quarter_period(moving, displacement) == pytest.approx(substitute, abs=0.01)
    assert quarter_period(fixed, displacement) == pytest.approx(simplified, abs=0.01)


@pytest.mark.parametrize(("mode", "pull"), [("both", 75.6e3), ("both_slack", 0.0)])
def test_feet_of_a_standing_wall_carry_its_weight_and_the_pull_of_a_tight_tendon(mode, pull):
    wall, forces = rk.SimplifiedSubstituteGravityWall.thesis(), np.empty(4)
    wall.module.reactions(wall.module.MODES.index(mode), np.zeros(4), wall.vector, 0, 0, forces)
    assert forces[1:3] == pytest.approx([(WALL.mass * WALL.gravity + pull) / 2] * 2)


def test_substitute_gravity_has_a_third_of_the_stiffness_near_upright():
    """There b ~ theta**2, so that the moment of (W + P) b lacks two thirds of d(b theta)/dtheta."""
    small = 2e-5
    moment = float(rk.SubstituteGravityWall.thesis().pushover(np.arcsin(small / H)))
    # the centroid's own descent is apart from that
    moment += (WALL.mass * WALL.gravity + 75.6e3) * WALL.centroid_height / H * small / H
    ratio = moment / float(oscillator().pushover(small))
    assert 3 * ratio * 0.412 / 0.508 == pytest.approx(1.0, rel=2e-2)


# --- yielding


@pytest.mark.parametrize(
    ("structure", "start"),
    [
        (oscillator(), {"u": 1e-6, "u_dot": 2.2}),
        (rk.ControlledWall.thesis(), {"theta": 1e-9, "theta_dot": 0.9}),
    ],
    ids=["oscillator", "Lagrange"],
)
def test_a_yield_excursion_costs_the_plastic_work_and_unloading_is_elastic(structure, start):
    run = rk.simulate(structure, rk.GroundMotion.none(0.5), initial=start, options=EXACT)
    passed = [(e.mode_before, e.mode_after) for e in run.events]
    assert passed[:2] == [("right", "right_yield"), ("right_yield", "right")]
    permanent = run.final["permanent_extension"]
    assert permanent > 0.015
    lost = run["total_energy"][0] - run["total_energy"][-1]
    assert lost == pytest.approx(structure.yield_force * permanent, rel=1e-9)
    # each sample lies on the elastic line, at yield, or is slack
    force, extension = run["tendon_force"], run["tendon_extension"]
    assert force.max() == pytest.approx(structure.yield_force, rel=1e-12)
    assert force.min() > -1e-3
    after = run.t > run.events[1].time + 1e-9
    line = structure.initial_force + structure.tendon_stiffness * (extension - permanent)
    assert np.maximum(line[after], 0.0) == pytest.approx(force[after], abs=1e-3)
    assert extension.max() - permanent == pytest.approx(
        (structure.yield_force - structure.initial_force) / structure.tendon_stiffness, rel=1e-9
    )
    assert (force[after] == 0).any()  # it has grown by more than its first extension


def test_a_wall_released_beyond_yield_has_been_pulled_there():
    run = freed(oscillator(), displacement=0.06, duration=0.3)
    beyond = WALL.tendon_extension(0.06) - (
        WALL.tendons[0].yield_extension - WALL.tendons[0].initial_extension
    )
    assert run.final["permanent_extension"] == pytest.approx(beyond, rel=1e-9)


# --- the oscillator's losses


@pytest.mark.parametrize("width", [3.551e-3, 1e-5], ids=["of the thesis", "narrow"])
def test_peaks_of_the_oscillator_are_those_of_the_closed_form(width):
    _, found = peaks(freed(oscillator(0.88, regularisation=width)))
    closed = formulas.peak_sequence(WALL.restoring_force, RELEASE, 0.88, width, len(found) - 1)
    assert len(found) > 12
    assert found == pytest.approx(closed, abs=1e-9)


def test_peaks_do_not_depend_on_the_effective_mass():
    _, heavy = peaks(freed(oscillator(0.88)))
    _, light = peaks(freed(oscillator(0.88, effective_mass=WALL.mass / 2)))
    assert light[: len(heavy)] == pytest.approx(heavy, abs=1e-9)


def test_a_ratio_held_in_a_passage_is_that_of_the_speed_without_losses():
    """From 25 mm: the release of Table A-1 is ill-conditioned under 4-31."""
    start = -0.025
    _, found = peaks(freed(oscillator(LAWS.equation_4_31()), displacement=start))
    expected = [start]
    for _ in found[1:]:
        speed = np.sqrt(2 * float(WALL.potential_energy(expected[-1])) / WALL.mass)
        r = float(energy_ratio_4_31(speed))
        expected.append(
            formulas.peak_sequence(WALL.restoring_force, expected[-1], r, 3.551e-3, 1)[1]
        )
    assert found == pytest.approx(expected, abs=1e-9)


def test_a_ratio_of_the_instant_is_another_law_than_one_held():
    _, held = peaks(freed(oscillator(LAWS.equation_4_31()), displacement=-0.025))
    _, instant = peaks(freed(oscillator(LAWS.equation_4_31(), held=False), displacement=-0.025))
    assert np.abs(held[:6] - instant[:6]).max() > 1e-4
    flat = LAWS(((0.2, 0.9, 0.0), (np.inf, 0.9, 0.0)))
    constant = peaks(freed(oscillator(0.9)))[1]
    for choice in (True, False):
        assert peaks(freed(oscillator(flat, held=choice)))[1] == pytest.approx(constant, abs=1e-9)


# --- shaking


def test_the_simplified_wall_lifts_off_at_one_acceleration_and_the_others_at_any():
    """The 11.1 m/s2 of 4.8.2; a wall that rocks about its centreline at first resists nothing."""
    threshold = WALL.uplift_acceleration()
    assert threshold == pytest.approx(11.1, abs=0.1)

    def moved(structure, acceleration):
        run = rk.simulate(structure, rk.GroundMotion.constant(acceleration, 0.05))
        return np.abs(run["theta"]).max()

    fixed, moving = rk.SimplifiedSubstituteGravityWall.thesis(), rk.SubstituteGravityWall.thesis()
    assert moved(fixed, 0.999 * threshold) == 0
    assert moved(fixed, 1.01 * threshold) > 0
    assert moved(moving, 0.1 * threshold) > 0


def test_shaking_drives_the_oscillator_by_its_mass_and_the_block_by_its_arm():
    """4-39; 4-40 with R cos(alpha - theta)/I_o."""
    found = oscillator(effective_mass=900.0).accelerations({}, ground_acceleration=2.0)
    assert found["u"] == pytest.approx(-2.0, rel=1e-12)
    wall, theta = rk.SubstituteGravityWall.thesis(), 0.01
    calm, shaken = (
        wall.accelerations({"theta": theta}, ground_acceleration=a)["theta"] for a in (0.0, 2.0)
    )
    b = WALL.half_width * (1 - np.exp(-((H * np.sin(theta) / 3.551e-3) ** 2)))
    radius, alpha = np.hypot(b, WALL.centroid_height), np.arctan2(b, WALL.centroid_height)
    arm = WALL.mass * radius * np.cos(alpha - theta) / WALL.corner_inertia
    assert shaken - calm == pytest.approx(-2.0 * arm, rel=1e-11)


# --- laws of impact that know the speed


def test_laws_of_the_thesis_are_those_of_the_closed_forms():
    for law, closed in (
        (LAWS.equation_4_31(), energy_ratio_4_31),
        (LAWS.equation_4_36(), energy_ratio_4_36),
        (LAWS.equation_4_38(), energy_ratio_4_38),
    ):
        for speed in (0.0, 0.1, 0.2999, 0.3, 0.3649, 0.365, 0.4, 0.47, 0.6, 0.78, 0.9):
            assert law.at(-speed) == pytest.approx(float(closed(speed)), rel=1e-15)


def test_each_impact_has_the_ratio_of_its_own_speed():
    wall = rk.SubstituteGravityWall.thesis()
    run = freed(wall, LAWS.equation_4_38())
    ratios = set()
    for impact in run.impacts:
        before, after = impact.before["theta_dot"], impact.after["theta_dot"]
        r = float(energy_ratio_4_38(H * before))
        assert (after / before) ** 2 == pytest.approx(r, rel=1e-13)
        ratios.add(round(r, 6))
    assert len(ratios) >= 3
    landing = {"theta_dot": run.impacts[0].before["theta_dot"]}
    after, _ = wall.after_impact(landing, run.impacts[0].mode_before, LAWS.equation_4_38())
    assert after["theta_dot"] == pytest.approx(run.impacts[0].after["theta_dot"], rel=1e-14)


def test_a_law_of_one_flat_piece_is_a_constant_energy_ratio():
    block = rk.RigidBlock(half_width=0.095, half_height=0.45)
    still, start = rk.GroundMotion.none(4.0), {"theta": 0.1}
    flat = LAWS(((np.inf, 0.8, 0.0),), height=0.9)
    runs = [
        rk.simulate(block, still, impact=law, initial=start) for law in (flat, rk.EnergyRatio(0.8))
    ]
    assert runs[0].final == runs[1].final
    assert runs[0].events.rest_time == runs[1].events.rest_time
    many = rk.simulate_many(
        lambda theta: rk.Case(block, still, impact=flat, initial={"theta": theta}),
        over={"theta": [0.1]},
        sweep_options=rk.SweepOptions(lanes=False),
    )
    assert many.final.sel(state="theta").item() == runs[0].final["theta"]


def test_bad_laws_and_walls_are_refused_with_the_remedy():
    with pytest.raises(ValueError, match=r"does not tell of which point.*height="):
        rk.simulate(
            rk.RigidBlock(half_width=0.095, half_height=0.45), rk.GroundMotion.none(1.0),
            impact=LAWS.equation_4_31(), initial={"theta": 0.1},
        )  # fmt: skip
    assert "last one be infinite" in told(LAWS, ((0.3, 0.85, 0.0),))
    assert refused(LAWS, ((0.3, 0.85, 1.0), (np.inf, 0.8, 0.0))) == ("pieces below 0.3 m/s", 1.15)
    with refuses("initial_force", 200000.0):
        replace(rk.ControlledWall.thesis(), initial_force=2e5)
    assert refused(rk.ControlledWallOscillator.thesis, 1.2) == ("energy_ratio", 1.2)


# --- the measured free vibration


def errors(run, count=13):
    """Root mean squares of the errors of the first peaks of Table A-1: (time [s], peak [m])."""
    times, found = peaks(run)
    measured = MEASURED.time[MEASURED.at_peak][:count], MEASURED.displacement[MEASURED.at_peak]
    return (
        float(np.sqrt(np.mean((times[:count] - measured[0]) ** 2))),
        float(np.sqrt(np.mean((found[:count] - measured[1][:count]) ** 2))),
    )


@pytest.mark.parametrize(
    ("structure", "law", "time", "peak"),
    [
        # with F_k raised by 6 %, as the thesis has it; without, times are 21.9 ms off
        (oscillator(0.88, effective_mass=STIFFER), None, 6e-3, 1.2e-3),
        (rk.SubstituteGravityWall.thesis(), LAWS.equation_4_38(), 9e-3, 1.5e-3),
    ],
    ids=["oscillator, r = 0.88", "substitute gravity, 4-38"],
)
def test_thirteen_measured_peaks_are_met(structure, law, time, peak):
    found = errors(freed(structure, law))
    assert found[0] < time
    assert found[1] < peak


def test_laws_of_different_length_go_together_in_an_ensemble():
    """One law's table is longer than the other's, and a plain ratio has none."""
    wall = rk.SimplifiedSubstituteGravityWall.thesis()
    at_speed = rk.EnergyRatioAtSpeed
    laws = [at_speed.equation_4_31(), at_speed.equation_4_36(), rk.EnergyRatio(0.88)]
    still, start = rk.GroundMotion.none(0.5), {"theta": -0.01}

    def case(law):
        return rk.Case(wall, still, impact=law, initial=start)

    together = rk.simulate_many(case, {"law": laws})
    for law, final in zip(laws, together.final.values, strict=True):
        alone = rk.simulate(wall, still, impact=law, initial=start)
        assert list(final) == [alone.final[name] for name in together.state.values]
