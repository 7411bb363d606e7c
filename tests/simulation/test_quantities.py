"""Quantities that are found when they are asked for: against what is known by other ways."""

import functools
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy import linalg, signal

import rockeom as rk
from rockeom.numbers.functions import FUNCTIONS, mathematics
from rockeom.numbers.jet import Jet
from rockeom.simulation.quantities import _word, families, main_units
from rockeom.structures.classes import SHIPPED
from rockeom.structures.positions import places
from tests.refusals import refused
from tests.shipped import plain
from tests.typical import DAMPING, S1, STIFFNESS, TOTAL_MASS, column

TIGHT = rk.SolverOptions(rtol=1e-11, atol=1e-13)
_T = 0.01 * np.arange(300)
SHAKING = rk.GroundMotion.from_array(
    np.sin(9.0 * _T) * np.exp(-(((_T - 1.0) / 0.5) ** 2)) + 0.2 * np.sin(31.0 * _T), dt=0.01
)
BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.5, mass=20.0)
FRAME = rk.ShearFrame(
    masses=[2e4, 1e4], heights=[3.0, 6.5], stiffnesses=[2e7, 1e7], dampings=[1e5, 4e4],
    inertias=[1e4, 2e4], half_width=2.0, base_mass=3e4, base_height=0.3, base_inertia=1e4,
)  # fmt: skip


@functools.cache
def rocking():
    """The column that rocks, lands and comes to rest."""
    return rk.simulate(
        column(), SHAKING.scaled(6.0), vertical=SHAKING, impact=rk.Impulsive(), options=TIGHT
    )


@functools.cache
def sliding():
    block = rk.SlidingBlock(
        half_width=0.3, half_height=0.5, mass=20.0, friction=0.4, restitution=0.2
    )
    return rk.simulate(block, SHAKING.scaled(9.0), vertical=SHAKING.scaled(3.0), options=TIGHT)


@functools.cache
def bouncing():
    """A block that is dropped on a shaking ground, leaning."""
    block = rk.SlidingBlock(
        half_width=0.3, half_height=0.5, mass=20.0, friction=0.2, restitution=0.5
    )
    start = {"theta": 0.05, "y": 0.1, "x_dot": 0.5}
    return rk.simulate(block, SHAKING.scaled(3.0), initial=start, options=TIGHT)


# --- places


@pytest.mark.parametrize("make", [rocking, sliding], ids=["rocks", "slides"])
def test_velocities_and_accelerations_are_the_slopes_of_places(make):
    """By differences of the dense record, in all modes that are met for a while."""
    run = make()
    module, p = run.structure.module, run.structure.vector
    start, length = run.steps.span.T
    long = np.flatnonzero(length > 1e-3)
    assert len(np.unique(run.steps.mode[long])) > 2
    h = 2e-4

    def at(shift):
        x = (0.5 * length[long] + shift) / length[long]
        return places(module, run.steps.mode[long], run.steps.states(long, x), p)[:, :, :2]

    rows = run.steps.mode[long], run.steps.states(long, np.full(len(long), 0.5))
    t = start[long] + 0.5 * length[long]
    states = dict(zip(run.states, rows[1].T, strict=True))
    slope = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)
    bend = (16 * (at(h) + at(-h)) - (at(2 * h) + at(-2 * h)) - 30 * at(0.0)) / (12 * h**2)
    ground = np.column_stack([run.motion.acceleration(t), run.vertical.acceleration(t)])
    for number in np.unique(rows[0]):
        of = rows[0] == number
        mode = module.MODES[number]
        here = {name: value[of] for name, value in states.items()}
        if run.structure.rocks_on_rigid_ground and mode == "both":
            here = {name: value for name, value in here.items() if "theta" not in name}
        moved = run.structure.velocities(here, mode)
        felt = run.structure.absolute_accelerations(here, *ground[of].T, mode)
        for i, name in enumerate(module.POSITIONS):
            np.testing.assert_allclose(moved[name], slope[of, i], atol=1e-8)
            expected = bend[of, i] + ground[of]
            np.testing.assert_allclose(felt[name], expected, atol=2e-5 * np.abs(bend).max())


def test_a_run_tells_of_places_what_states_tell():
    run = rocking()
    felt, moved = run.places.accelerations(), run.places.velocities()
    assert set(felt) == set(moved) == set(run.places.positions())
    np.testing.assert_array_equal(run["superstructure_acceleration"], felt["superstructure"][:, 0])
    np.testing.assert_array_equal(run["base_vertical_velocity"], moved["base"][:, 1])
    np.testing.assert_allclose(run["load_displacement"], run["displacement"], atol=1e-14)
    np.testing.assert_allclose(run["left_rise"], run["left_uplift"], atol=1e-14)
    i = len(run.t) // 2
    state = {name: float(run[name][i]) for name in run.states}
    ground = run["ground_acceleration"][i], run["vertical_ground_acceleration"][i]
    one = run.structure.absolute_accelerations(state, *ground, mode=run.mode[i])
    np.testing.assert_allclose(one["base"], felt["base"][i], rtol=1e-12, atol=1e-12)


SMALL = st.floats(-0.2, 0.2)


@settings(max_examples=25)
@given(st.lists(st.tuples(SMALL, SMALL, SMALL, SMALL), min_size=2, max_size=5))
def test_arrays_of_states_tell_what_each_state_does(rows):
    theta, u, rate, ground = np.array(rows).T
    states = {"theta": theta, "u": u, "theta_dot": rate}
    structure = column()
    for told, alone in (
        (structure.energies(states), lambda s, a: structure.energies(s)),
        (structure.elements(states), lambda s, a: structure.elements(s)),
        (
            structure.accelerations(states, ground_acceleration=ground),
            lambda s, a: structure.accelerations(s, ground_acceleration=a),
        ),
        (
            structure.reactions(states, vertical_ground_acceleration=ground),
            lambda s, a: structure.reactions(s, vertical_ground_acceleration=a),
        ),
    ):
        for i in range(len(rows)):
            state = {name: float(value[i]) for name, value in states.items()}
            expected = alone(state, float(ground[i]))
            assert {name: value[i] for name, value in told.items()} == expected


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_rates_of_a_function_are_its_slopes(name):
    of = FUNCTIONS[name].f
    x, v, a, h = np.array([0.3, 0.7]), 0.4, -0.9, 1e-3
    x = x + 1.5 if name == "acosh" else x
    found = getattr(mathematics, name)(Jet(x, v, a))
    at = [of(x + v * t + 0.5 * a * t**2) for t in (-h, 0.0, h)]
    np.testing.assert_allclose(found.value, at[1], rtol=1e-15)
    np.testing.assert_allclose(found.first, (at[2] - at[0]) / (2 * h), atol=1e-5)
    np.testing.assert_allclose(found.second, (at[2] - 2 * at[1] + at[0]) / h**2, atol=1e-5)


@settings(max_examples=40)
@given(st.floats(0.2, 3.0), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
def test_jets_calculate_as_numbers_do(x, v, a):
    def of(t):
        q = x + v * t + 0.5 * a * t * t
        return (2.0 - q) / (1.0 + q**2) + abs(-q) * 3.0**q - q**0.5 / 4.0 + q**q

    q = Jet(np.array([x]), np.array([v]), np.array([a]))
    t = Jet(np.zeros(1), np.ones(1), np.zeros(1))
    found, other = of(0.0 * q + t), of(t)
    by_parts = (2.0 - q) / (1.0 + q**2) + abs(-q) * 3.0**q - q**0.5 / 4.0 + q**q
    for one in (found, other):
        np.testing.assert_allclose(by_parts.value, one.value, rtol=1e-12)
        np.testing.assert_allclose(by_parts.first, one.first, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(by_parts.second, one.second, rtol=1e-9, atol=1e-8)


# --- elements and the base


@settings(max_examples=30)
@given(
    SMALL, *[st.floats(-0.05, 0.05)] * 2, *[st.floats(-1.0, 1.0)] * 3, *[st.floats(-5.0, 5.0)] * 2
)
def test_storeys_carry_what_is_above_them(theta, u_1, u_2, rate, v_1, v_2, ax, ay):
    """d'Alembert: masses above times absolute acceleration and gravity, across the turned axis."""
    state = {
        "theta": theta, "u_1": u_1, "u_2": u_2, "theta_dot": rate, "u_1_dot": v_1, "u_2_dot": v_2,
    }  # fmt: skip
    if abs(theta) < 1e-3:
        state |= {"theta": 0.0, "theta_dot": 0.0}
    felt = FRAME.absolute_accelerations(state, ax, ay)
    carried = FRAME.elements(state)
    across = np.array([np.cos(state["theta"]), -np.sin(state["theta"])])
    above = np.zeros(2)
    for i in (2, 1):
        above += FRAME.masses[i - 1] * (felt[f"floor {i}"] + [0.0, FRAME.gravity])
        force = carried[f"storey_{i}_force"]
        assert force == pytest.approx(-above @ across, rel=1e-9, abs=1e-6)
    drift = carried["storey_2_deformation"]
    assert drift == u_2 - u_1
    assert carried["storey_2_energy"] == pytest.approx(1e7 * drift**2 / 2)
    assert carried["storey_2_force"] == pytest.approx(1e7 * drift + 4e4 * (v_2 - v_1), abs=1e-6)


@pytest.mark.parametrize("make", [rocking, sliding], ids=["rocks", "slides"])
def test_base_shear_and_moment_are_those_of_the_forces_on_the_feet(make):
    run = make()
    shear = run["base_shear"]
    scale = np.abs(shear).max()
    np.testing.assert_allclose(shear, run["horizontal_reaction"], atol=1e-9 * scale)
    places = run.places.positions()
    left, right = (places[foot][:, 0] for foot in ("left", "right"))
    middle = 0.5 * (left + right) if run.structure.has_landings else 0.0
    # where a foot is lifted no force acts on it
    moment = run["right_reaction"] * (right - middle) + run["left_reaction"] * (left - middle)
    np.testing.assert_allclose(run["overturning_moment"], moment, atol=1e-8 * scale)


def test_moment_at_the_base_is_the_one_that_is_known():
    run = rocking()
    found, known = run.extremes("overturning_moment"), run.support.base_moment
    assert found.maximum == pytest.approx(known.maximum, rel=1e-9)
    assert found.minimum == pytest.approx(known.minimum, rel=1e-9)


def test_a_linear_oscillator_feels_what_lsim_says():
    held = column().fixed_base()
    run = rk.simulate(held, SHAKING, options=TIGHT)
    m, k, c = S1["mass"], STIFFNESS, DAMPING
    rates, told = [[0.0, 1.0], [-k / m, -c / m]], [[k, c], [-k / m, -c / m]]
    system = signal.StateSpace(rates, [[0.0], [-1.0]], told, np.zeros((2, 1)))
    t = SHAKING.dt * np.arange(len(SHAKING.samples))
    _, (force, felt), _ = (x.T for x in signal.lsim(system, SHAKING.samples, t))
    found = run.at(t, names=("column_force", "superstructure_acceleration", "column_loss"))
    np.testing.assert_allclose(found["column_force"], force, atol=1e-8 * np.abs(force).max())
    told = found["superstructure_acceleration"]
    np.testing.assert_allclose(told, felt, atol=1e-8 * np.abs(felt).max())
    fine = np.linspace(0.0, t[-1], 300001)
    slow = np.trapezoid(c * run.at(fine, names=("u_dot",))["u_dot"] ** 2, fine)
    assert found["column_loss"][-1] == pytest.approx(slow, rel=1e-7)


# --- works and impulses


@pytest.mark.parametrize("name", SHIPPED)
def test_energy_of_every_structure_is_accounted_for(name):
    structure = SHIPPED[name](**plain(name))
    gravity = structure.parameters().get("gravity", 1.0)
    run = rk.simulate(
        structure, SHAKING.scaled(1.5 * gravity), vertical=SHAKING.scaled(0.3 * gravity)
    )
    balance = run.energy_balance()
    assert balance.error < 1e-9
    assert balance.input != 0.0


def test_balance_of_a_structure_in_which_nothing_moves_has_no_error():
    """Springs that settle by rounding alone."""
    rng = np.random.default_rng(5)
    springs = SHIPPED["two_spring_structure"]
    structure = springs(**plain("two_spring_structure", lambda: float(rng.uniform(0.5, 2.0))))
    run = rk.simulate(structure, rk.GroundMotion.none(2.0))
    balance = run.energy_balance()
    assert 0.0 < abs(balance.gained) < 1e-12
    largest = max(abs(run[f"{kind}_energy"]).max() for kind in ("gravitational", "elastic"))
    assert balance.error == pytest.approx(abs(balance.gained) / largest, rel=1e-6)


@pytest.mark.parametrize("make", [rocking, sliding, bouncing], ids=["rocks", "slides", "bounces"])
def test_works_and_losses_make_the_energy_at_any_time(make):
    run = make()
    assert any(event.kind == "rest" for event in run.events) or make is sliding
    given_, lost = run["ground_work"], run["damping_loss"] + run["friction_loss"]
    energy = run["total_energy"] - run["total_energy"][0]
    balance = given_ - lost - run["impact_loss"] - energy
    assert np.abs(balance).max() < 1e-9 * max(np.abs(given_).max(), run["kinetic_energy"].max())
    for name in ("damping_loss", "friction_loss", "impact_loss"):
        assert np.diff(run[name]).min() >= -1e-9 * (1.0 + run[name][-1])
    told = run.energy_balance()
    assert told.input == pytest.approx(given_[-1], rel=1e-12)
    assert told.impacts == pytest.approx(run["impact_loss"][-1], rel=1e-9)
    if make is not rocking:
        assert told.friction == run["friction_loss"][-1] > 0.1 * told.input
    else:
        assert told.damping == pytest.approx(run["column_loss"][-1], rel=1e-12)


def test_friction_of_a_block_that_only_slides_is_weight_times_way():
    block = rk.SlidingBlock(
        half_width=1.0, half_height=0.2, mass=3.0, friction=0.3, restitution=0.0
    )
    run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"x_dot": 1.5})
    way = run["block_displacement"][-1]
    assert way == pytest.approx(1.5**2 / (2 * 0.3 * block.gravity), rel=1e-9)
    lost = run["friction_loss"]
    assert lost[-1] == pytest.approx(0.3 * 3.0 * block.gravity * way, rel=1e-9)
    assert run.energy_balance().gained == pytest.approx(-lost[-1], rel=1e-9)


def test_impulses_at_impacts_of_a_block_by_hand():
    """About the left foot the centroid sinks before, about the right one it rises afterwards."""
    run = rk.simulate(BLOCK, rk.GroundMotion.none(3.0), initial={"theta": -0.15})
    told = run.impacts.impulses()
    assert told.shape == (len(run.impacts), 2)
    for (across, up), impact in zip(told, run.impacts, strict=True):
        before, after = impact.before["theta_dot"], impact.after["theta_dot"]
        assert across == pytest.approx(20.0 * 0.5 * (after - before), rel=1e-12)
        assert up == pytest.approx(20.0 * 0.1 * (abs(after) + abs(before)), rel=1e-12)
    first = run.impacts[0]
    sides = [run.at(first.time, side, ("impact_loss", "theta_dot")) for side in ("left", "right")]
    inertia = BLOCK.rocking_inertia
    kept = [one["impact_loss"] + inertia * one["theta_dot"] ** 2 / 2 for one in sides]
    assert sides[0]["impact_loss"] == 0.0
    assert kept[0] == pytest.approx(kept[1], rel=1e-9)
    lost = run["impact_loss"][-1]
    kinetic = [i.before["theta_dot"] ** 2 - i.after["theta_dot"] ** 2 for i in run.impacts]
    assert lost == pytest.approx(sum(kinetic) * inertia / 2, rel=1e-9)


# --- names


def test_what_is_asked_for_by_name_has_a_unit_and_extremes():
    run = rocking()
    assert set(run.units) == set(run.names)
    assert run.units["base_shear"] == "N"
    assert run.units["overturning_moment"] == "N m"
    assert run.units["column_loss"] == run.units["ground_work"] == "J"
    assert run.units["load_acceleration"] == "m/s2"
    for name in ("superstructure_acceleration", "column_force", "impact_loss", "base_shear"):
        values, found = run[name], run.extremes(name)
        assert found.minimum <= values.min()
        assert found.maximum >= values.max()
        assert found.peak == pytest.approx(run.at(found.peak_time, names=(name,))[name], rel=1e-6)
    fresh = rk.simulate(column(), SHAKING.scaled(3.0), duration=0.2)
    _ = fresh["theta"], fresh.names, fresh.units
    assert set(fresh._outputs) <= {""}
    assert "works" not in vars(fresh)
    with pytest.raises(KeyError, match="no quantity 'column_strain'"):
        fresh.extremes("column_strain")
    without = rk.simulate(rk.NondimensionalBlock(alpha=0.3), rk.GroundMotion.none(0.1))
    assert set(without.units.values()) == {"-"}


def test_a_sweep_keeps_what_is_asked_for():
    names = ["superstructure_acceleration", "column_force", "ground_work"]
    found = rk.simulate_many(
        lambda scale: rk.Case(column(), SHAKING.scaled(scale)),
        over={"scale": [6.0]},
        quantities=names,
        sweep_options=rk.SweepOptions(lanes=False),
    )
    run = rk.simulate(column(), SHAKING.scaled(6.0))
    for name in names:
        kept = float(found.peak_quantity.sel(quantity=name).squeeze())
        assert kept == pytest.approx(abs(run.extremes(name).peak), rel=1e-12)


@pytest.mark.parametrize("name", SHIPPED)
def test_no_quantity_of_a_structure_hides_another(name):
    module = SHIPPED[name](**plain(name)).module
    told = [n for units in families(module).values() for n in units]
    assert len(told) == len(set(told))
    assert all(n.isidentifier() for n in told)


def test_the_guide_names_all_that_a_frame_can_be_asked_for():
    page = (Path(__file__).resolve().parents[2] / "docs/how-to/quantities.md").read_text("utf-8")
    named = re.findall(r"`([\w]+)`", "".join(line for line in page.split("\n") if line[:1] == "|"))
    told = {
        name.replace("PLACE", place).replace("ELEMENT", element)
        for name in named
        for place in (*map(_word, FRAME.module.POSITIONS), "")
        for element in (*FRAME.module.ELEMENT_NAMES, "")
    }
    asked = [*main_units(FRAME.module)]
    asked += [name for units in families(FRAME.module).values() for name in units]
    states = {*FRAME.states, "displacement"}
    assert sorted({*asked} - told - states) == []


# --- modes


def test_modes_of_a_frame_are_those_of_its_matrices():
    masses = np.diag(FRAME.masses)
    k_1, k_2 = FRAME.stiffnesses
    stiffness = np.array([[k_1 + k_2, -k_2], [-k_2, k_2]])
    squares, shapes = linalg.eigh(stiffness, masses)
    held = FRAME.fixed_base()
    told = np.array([held.mode_shapes["u_1"], held.mode_shapes["u_2"]])
    undamped = rk.ShearFrame(**{**vars_of(FRAME), "dampings": [0.0, 0.0]}).fixed_base()
    np.testing.assert_allclose(undamped.periods, 2 * np.pi / np.sqrt(squares), rtol=1e-9)
    np.testing.assert_allclose(told, shapes / shapes[np.abs(shapes).argmax(0), [0, 1]], rtol=1e-6)
    effective = (shapes.T @ masses @ np.ones(2)) ** 2
    np.testing.assert_allclose(held.effective_masses, effective, rtol=1e-6)
    assert held.effective_masses.sum() == pytest.approx(3e4, rel=1e-9)
    assert column().fixed_base().effective_masses == pytest.approx([TOTAL_MASS - 45.6])


def vars_of(frame):
    return {name: getattr(frame, name) for name in frame.defaults()}


def test_rayleigh_damping_gives_the_ratios_asked_for():
    damped = FRAME.damped(0.03)
    ratios = damped.fixed_base().damping_ratios
    periods = damped.fixed_base().periods
    assert ratios[0] == pytest.approx(0.03, rel=1e-8)
    assert ratios[1] == pytest.approx(0.03 * periods[0] / periods[1], rel=1e-8)
    assert FRAME.damped(0.03, mode=2).fixed_base().damping_ratios[1] == pytest.approx(0.03)
    both = rk.rayleigh_damping([0.5, 0.1], [0.02, 0.05])
    np.testing.assert_allclose(both.ratio([0.5, 0.1]), [0.02, 0.05], rtol=1e-12)
    assert rk.rayleigh_damping(0.5, 0.02).alpha == 0.0
    for periods, ratios, said in (
        ([0.5, 0.5], [0.02, 0.02], r"periods is \[0\.5, 0\.5\]: give those of"),
        ([0.5, 0.2, 0.1], [0.02] * 3, "give two of each"),
        ([-0.5], [0.02], "positive"),
    ):
        with pytest.raises(ValueError, match=said):
            rk.rayleigh_damping(periods, ratios)
    assert refused(FRAME.damped, 0.02, mode=3) == ("mode", 3)


def test_an_impact_at_once_is_a_loss_of_the_balance():
    block = rk.SlidingBlock(half_width=0.2, half_height=0.6, friction=0.5, restitution=0.0, mass=50)
    run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"y_dot": -1.0})
    balance = run.energy_balance()
    assert balance.impacts == run.impacts.energy_loss == -balance.gained == 25.0
    assert balance.error == 0.0
