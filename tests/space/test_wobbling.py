"""Round columns that roll on their rims without twist, and a slab on four of them."""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import brentq

import rockeom as rk
from rockeom import plots
from rockeom.analysis import formulas
from rockeom.symbolic import Body, Contact, Model, Rigid, coordinate, parameter, space
from tests.refusals import told
from tests.space.cases import GRAVITY, TIGHT, Case, of_group

MASS, G = (
    parameter("m", "mass", "kg", "mass"),
    parameter("g", "gravity", "m/s2", "gravity"),
)


def column(case: Case) -> rk.WobblingColumn:
    height = max(2 * case["H"], 1e-40)  # a disc has none
    return rk.WobblingColumn(radius=case["b"], height=height, mass=case["m"], gravity=GRAVITY)


def podium(case: Case) -> rk.Podium:
    return rk.Podium(
        columns=int(case["columns"]), slab_mass=case["slab_mass"], radius=case["b"],
        height=2 * case["H"], mass=case["m"], gravity=GRAVITY,
    )  # fmt: skip


COLUMN = rk.WobblingColumn(radius=0.25, height=2.0, mass=3.0, gravity=GRAVITY)


@pytest.mark.parametrize("name", of_group("steady wobbling")[:-1])  # the last one rolls freely
def test_steady_wobbling_has_the_precession_and_the_forces_of_its_closed_form(name):
    case = Case(name)
    of = column(case)
    at, rate = {"tilt": float(case["tilt"]), "direction": 0.7}, case.right("precession_rate")
    falling = of.accelerations(at)["tilt"]
    state = at | {"direction_dot": rate}
    assert abs(of.accelerations(state)["tilt"]) < case.tolerance * abs(falling)
    along, across, up = of.reactions(state).values()
    case.agrees(
        contact_force_vertical=up, friction_needed=np.hypot(along, across) / up,
        energy=sum(of.energies(state).values()),
    )  # fmt: skip


def test_nutation_turns_at_its_least_tilt_and_comes_back_after_its_period():
    case = Case("restricted_nutation")
    start = {"tilt": case["tilt"], "direction_dot": case["precession_rate"]}
    motion, period = rk.GroundMotion.none(1.3), case.right("period")
    run = rk.simulate(column(case), motion, initial=start, options=TIGHT)
    after = run.at(period)
    case.agrees(
        least_tilt=run.extremes_of(["tilt"])["tilt"].minimum, energy=run["total_energy"][-1],
        precession_in_a_period=after["direction"],
    )  # fmt: skip
    assert after["tilt"] == pytest.approx(case["tilt"], rel=case.tolerance)
    assert abs(after["tilt_dot"]) < 1e-10
    assert run.energy_balance().error < 1e-12


def test_free_wobbling_is_that_of_40_digits():
    case = Case("restricted_free")
    names = {
        "tilt": "tilt", "direction": "contact_direction", "tilt_dot": "tilt_rate",
        "direction_dot": "precession_rate",
    }  # fmt: skip
    start = {state: case[given] for state, given in names.items()}
    of, motion = column(case), rk.GroundMotion.none(case["t_end"])
    run = rk.simulate(of, motion, initial=start, options=TIGHT)
    end = run.final
    case.agrees(
        tilt=end["tilt"], contact_direction=end["direction"], energy=run["total_energy"][-1],
        kinetic=run["kinetic_energy"][-1], potential=run["gravitational_energy"][-1],
        centroid=of.positions(end)["column"], body_axis=of.rotations(end)["column"][:, 2],
    )  # fmt: skip
    # about the diameter across the direction of the tilt, and without twist about the axis
    across = np.array([-np.sin(end["direction"]), np.cos(end["direction"]), 0.0])
    precession = np.array([0.0, 0.0, 1.0]) - of.rotations(end)["column"][:, 2]
    case.agrees(omega=end["tilt_dot"] * across + end["direction_dot"] * precession)


def test_podium_wobbles_steadily_with_its_closed_form():
    case = Case("podium_steady_0.15")
    of = podium(case)
    state = {"tilt": case["tilt"], "direction_dot": case.right("precession_rate")}
    falling = of.accelerations({"tilt": case["tilt"]})["tilt"]
    assert abs(of.accelerations(state)["tilt"]) < case.tolerance * abs(falling)
    tilting = of.energies({"tilt": case["tilt"], "tilt_dot": 1.0})["kinetic_energy"]
    turning = of.energies({"tilt": case["tilt"], "direction_dot": 1.0})["kinetic_energy"]
    case.agrees(tilt_inertia=2 * tilting, precession_inertia=2 * turning)


CAN = {0.1: 199.848582, 0.01: 198.589813, 0.001: 198.410499, 0.0001: 198.387224}
"""Turn of the point of contact [deg] by the precession at rest [rad/s]; quadrature, six digits."""


@pytest.mark.parametrize("precession", CAN)
def test_a_can_passes_flat_and_turns_its_contact_by_more_than_half_a_turn(precession):
    can = rk.WobblingColumn(mass=0.35, radius=0.033, height=0.12, gravity=GRAVITY)
    start = {"tilt": 0.3 * np.arctan2(33, 60), "direction_dot": precession}
    run = rk.simulate(can, rk.GroundMotion.none(0.2), initial=start, options=TIGHT)
    again = brentq(lambda t: run.at(t)["tilt_dot"], 0.15, 0.2, xtol=1e-15)  # upright in between
    assert run.at(again)["tilt"] == pytest.approx(start["tilt"], rel=1e-9)
    assert np.degrees(run.at(again)["direction"]) == pytest.approx(CAN[precession], abs=6e-7)
    limit = np.degrees(formulas.turn_of_contact(0.35, 0.033, 0.06, can.parameters()["inertia_xx"]))
    assert limit == pytest.approx(198.383978, abs=5e-7)
    assert 0 < CAN[precession] - limit < 33 * precession**0.5


def shaken(of, case: Case, turned: float = 0.0) -> rk.Response:
    """The podium under the three components of its case, the whole turned about the vertical."""
    given = {"ax": "0.75 sin 4t", "ay": "-0.5 sin(3t+0.5)", "az": "0.25 sin 6t"}
    assert given.items() <= case.given.items()
    end = case["t_end"]
    first, second, up = (
        rk.GroundMotion.harmonic(size, angular_frequency=rate, phase=phase, duration=end)
        for size, rate, phase in ((0.75, 4.0, 0.0), (-0.5, 3.0, 0.5), (0.25, 6.0, 0.0))
    )
    along, across = (first, second) if turned == 0.0 else (second, -first)  # by -90 degrees
    start = {
        "tilt": case["tilt"], "direction": case["contact_direction"] + turned,
        "direction_dot": case["precession_rate"],
    }  # fmt: skip
    return rk.simulate(of, along, transverse=across, vertical=up, initial=start, options=TIGHT)


def test_podium_under_three_components_is_that_of_40_digits():
    case = Case("podium_shaken_1.5s")
    run = shaken(podium(case), case)
    end = run.final
    slab = [run[f"slab_{way}"][-1] for way in ("displacement", "transverse_displacement", "rise")]
    case.agrees(
        tilt=end["tilt"], contact_direction=end["direction"], tilt_rate=end["tilt_dot"],
        precession_rate=end["direction_dot"], slab_displacement=np.array(slab),
    )  # fmt: skip
    assert run.energy_balance().error < 1e-12


def test_turned_podium_has_a_turned_motion():
    case = Case("podium_shaken_1.5s")
    of = podium(case)
    run, turned = shaken(of, case), shaken(of, case, -np.pi / 2)
    assert turned.final["direction"] + np.pi / 2 == pytest.approx(run.final["direction"], rel=1e-11)
    assert turned.final["tilt"] == pytest.approx(run.final["tilt"], rel=1e-11)
    forces = ("horizontal_reaction", "transverse_reaction", "vertical_reaction")
    along, across, up = (run[name][-1] for name in forces)
    turned_by_hand = [across, -along, up]
    np.testing.assert_allclose([turned[n][-1] for n in forces], turned_by_hand, rtol=1e-9)


OPTIONS = rk.SolverOptions(rtol=1e-12, atol=1e-15)
EL_CENTRO = [rk.GroundMotion.from_library(f"El Centro 1940 {way}") for way in ("180", "270", "up")]


def test_shaken_along_x_a_column_is_the_block_of_its_plane():
    """Each event under El Centro from rest, with impacts onto the opposite rim."""
    block = rk.RigidBlock(
        half_width=0.25, half_height=1.0, mass=3.0, gravity=GRAVITY,
        inertia=COLUMN.parameters()["inertia_xx"],
    )  # fmt: skip
    x, up = 1.5 * EL_CENTRO[0], 1.5 * EL_CENTRO[2]
    runs = [rk.simulate(of, x, vertical=up, options=OPTIONS) for of in (COLUMN, block)]
    times = [run.impacts.times[:50] for run in runs]
    assert len(times[1]) == 50
    np.testing.assert_allclose(*times, atol=1e-9)
    peaks = [run.extremes_of([n])[n].peak for run, n in zip(runs, ("tilt", "theta"), strict=True)]
    assert abs(peaks[0]) == pytest.approx(abs(peaks[1]), rel=1e-9)
    assert COLUMN.uplift_acceleration == pytest.approx(block.uplift_acceleration, rel=1e-12)
    slower = rk.simulate(COLUMN, x, impact=rk.VelocityRatio(0.8), options=OPTIONS).impacts[0]
    assert slower.after["tilt_dot"] == pytest.approx(0.8 * slower.before["tilt_dot"])


@pytest.mark.parametrize("scale", [1.0, 1.5])
def test_from_rest_a_column_lifts_with_the_first_push_that_can_and_leans_away_from_it(scale):
    x, y, up = (scale * motion for motion in EL_CENTRO)
    run = rk.simulate(COLUMN, x, transverse=y, vertical=up, options=OPTIONS)

    def lifts(t: float | np.ndarray) -> float | np.ndarray:
        size = np.hypot(x.acceleration(t), y.acceleration(t))
        return size * 1.0 - (GRAVITY + up.acceleration(t)) * 0.25

    early = np.arange(0.0, 3.0, 1e-4)
    first = early[np.argmax(lifts(early) > 0.0)]
    time = brentq(lifts, first - 1e-4, first, xtol=1e-14)
    assert run.events[0].time == pytest.approx(time, abs=1e-11)
    away = np.array([-x.acceleration(time), -y.acceleration(time)])
    leaning = run.at(time + 0.02)
    angle = leaning["direction"] + (np.pi if leaning["tilt"] < 0 else 0.0)
    assert away @ [np.cos(angle), np.sin(angle)] > 0.99 * np.hypot(*away)
    assert run.energy_balance().error < 1e-12
    assert not len(run.impacts)  # it precesses, and passes flat


def test_from_rest_a_column_finds_the_push_within_a_sine_of_many_periods():
    x = rk.GroundMotion.harmonic(2.0, angular_frequency=20.0, phase=0.0, duration=10.0)
    y = rk.GroundMotion.harmonic(1.6, angular_frequency=13.0, phase=0.7, duration=10.0)
    run = rk.simulate(COLUMN, x, transverse=y)
    time = brentq(
        lambda t: np.hypot(x.acceleration(t), y.acceleration(t)) - GRAVITY / 4, 0.05, 0.07
    )
    assert run.events[0].time == pytest.approx(time, abs=1e-9)
    away = np.arctan2(-y.acceleration(time), -x.acceleration(time))
    assert run.y[0][1] == pytest.approx(away, abs=1e-9)


def test_forces_on_the_rim_turn_the_column_and_a_torque_keeps_its_twist():
    """Euler's law by differences of the momentum; the torque works in no motion of the model.

    Those turn about the diameter across the lean, and about the difference of vertical and axis.
    """
    x, y, up = (1.5 * motion for motion in EL_CENTRO)
    run = rk.simulate(COLUMN, x, transverse=y, vertical=up, duration=8.0, options=OPTIONS)
    values, vertical = COLUMN.parameters(), np.array([0.0, 0.0, 1.0])
    tensor = np.diag([values["inertia_xx"]] * 2 + [values["inertia_zz"]])

    def across(state) -> np.ndarray:
        return np.array([-np.sin(state["direction"]), np.cos(state["direction"]), 0.0])

    def momentum(t: float) -> np.ndarray:
        state = run.at(t)
        axes = COLUMN.rotations(state)["column"]
        spin = state["tilt_dot"] * across(state)
        spin += state["direction_dot"] * (vertical - axes[:, 2])
        return axes @ tensor @ axes.T @ spin

    for t in (3.004, 4.104, 5.304, 6.704, 7.704):
        rate, state = (momentum(t + 1e-5) - momentum(t - 1e-5)) / 2e-5, run.at(t)
        places, axis = COLUMN.positions(state), COLUMN.rotations(state)["column"][:, 2]
        along, crosswise, upwards = (float(motion.acceleration(t)) for motion in (x, y, up))
        forces = COLUMN.reactions(
            state, along, upwards, transverse_ground_acceleration=crosswise
        ).values()
        moment = np.cross(places["contact"] - places["column"], list(forces)[:3])
        torque, size = rate - moment, np.abs(moment).max()
        assert abs(torque @ across(state)) < 1e-6 * size
        assert abs(torque @ (vertical - axis)) < 1e-6 * size
        assert np.abs(torque).max() > 1e-3 * size


def test_a_column_that_the_ground_would_have_to_pull_says_so():
    start = {"tilt": 0.1, "direction_dot": 0.5}
    falls, none = rk.GroundMotion.constant(-10.5, 0.2), rk.GroundMotion.none(0.2)
    runs = [rk.simulate(COLUMN, none, vertical=up, initial=start) for up in (falls, none)]
    assert [run.support.lost_contact for run in runs] == [True, False]
    assert "Its vertical reaction turned negative: it would have jumped." in runs[0].summary()
    assert "negative" not in runs[1].summary()


def test_a_podium_in_a_plane_loses_what_the_opposite_rims_leave_of_its_momentum():
    of = podium(Case("podium_steady_0.15"))
    b, h, across = 0.25, 1.0, of.parameters()["inertia_xx"]
    before = 4 * (across + 3.0 * (h**2 - b**2)) + 4 * 20.0 * (h**2 - b**2)
    after = 4 * (across + 3.0 * (h**2 + b**2)) + 4 * 20.0 * (h**2 + b**2)
    assert of.velocity_ratio == pytest.approx(before / after, rel=1e-14)
    run = rk.simulate(of, rk.GroundMotion.none(3.0), initial={"tilt": 0.1}, options=TIGHT)
    impact = run.impacts[0]
    assert impact.after["tilt_dot"] == pytest.approx(before / after * impact.before["tilt_dot"])
    assert of.uplift_acceleration == pytest.approx(GRAVITY * b / h)


def test_a_truncated_cone_is_a_column_of_its_own_centroid_and_inertia():
    cone = rk.WobblingColumn(radius=0.3, top_radius=0.0, height=1.2, mass=80.0).parameters()
    assert cone["inertia_zz"] == pytest.approx(3 / 10 * 80 * 0.3**2)
    assert cone["inertia_xx"] == pytest.approx(80 * (3 / 20 * 0.3**2 + 3 / 80 * 1.2**2))
    assert cone["centroid_height"] == pytest.approx(0.3)
    cylinder = COLUMN.parameters()
    assert cylinder["inertia_xx"] == pytest.approx(3.0 * (0.25**2 / 4 + 2.0**2 / 12), rel=1e-14)
    assert cylinder["inertia_zz"] == pytest.approx(3.0 * 0.25**2 / 2, rel=1e-14)
    z = (np.arange(100000) + 0.5) / 100000  # slices of one with another top
    area = (0.3 - 0.2 * z) ** 2
    mass = 80.0 * area / area.sum()
    low = mass @ z * 1.2 / 80.0
    vase = rk.WobblingColumn(radius=0.3, top_radius=0.1, height=1.2, mass=80.0).parameters()
    assert vase["centroid_height"] == pytest.approx(low, rel=1e-8)
    across = mass @ (area / 4 + (1.2 * z - low) ** 2)
    assert vase["inertia_xx"] == pytest.approx(across, rel=1e-8)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"radius": 0.0}, "radius is 0"),
        ({"top_radius": -0.1}, "top_radius is -0.1"),
        ({"centroid_height": -0.1}, "centroid_height is -0.1"),
        ({"centroid_height": 2.1}, "of at most its own, 2 m"),
        ({"inertia_xx": 1.0, "inertia_zz": 2.5}, "which no masses have"),
    ],
)
def test_a_column_that_cannot_be_is_refused(changed, words):
    assert words in told(
        rk.WobblingColumn, **{"radius": 0.25, "height": 2.0, "mass": 3.0} | changed
    )


def test_podiums_and_procedures_that_cannot_be_are_refused():
    sizes = {"slab_mass": 20.0, "radius": 0.25, "height": 2.0, "mass": 3.0}
    assert "whole number" in told(rk.Podium, columns=2.5, **sizes)
    case = rk.Case(COLUMN, EL_CENTRO[0], transverse=EL_CENTRO[1])
    assert "its ground is level" in told(COLUMN.on_slope, 0.1)
    assert "takes two: add the other one" in told(rk.assess, COLUMN, [EL_CENTRO[0]])
    assert "has no derivative" in told(rk.sensitivity, case, ["end tilt"], ["radius"])


def test_a_column_is_kept_and_read_again_and_swept(tmp_path):
    motion, across = EL_CENTRO[0], EL_CENTRO[1]
    run = rk.simulate(COLUMN, motion, transverse=across, duration=4.0)
    run.save(tmp_path / "run.nc")
    read = rk.load(tmp_path / "run.nc")
    assert read.structure == COLUMN
    np.testing.assert_array_equal(read.y, run.y)
    case = rk.Case(COLUMN, motion, transverse=across, duration=4.0)
    sweep = rk.simulate_many(case, {"scale": [1.0, 1.5]})
    for k, scale in enumerate((1.0, 1.5)):  # each leans its own way first
        alone = rk.simulate(COLUMN, scale * motion, transverse=scale * across, duration=4.0)
        assert float(sweep["final"][k, 0]) == pytest.approx(alone.final["tilt"], rel=1e-6)


def test_a_declared_column_without_an_impact_ends_where_it_comes_flat():
    """By a bound: its coordinates have no other side."""
    b, half = (parameter(n, n, "m", n) for n in ("b", "H"))
    tilt = coordinate("theta", "tilt", "rad", "tilt of the axis")
    direction = coordinate("psi", "direction", "rad", "azimuth of the point of contact")
    at = space.wobble(tilt.position, direction.position, b.symbol)
    body = space.cylinder("column", MASS.symbol, b.symbol, 2 * half.symbol, at, (0, 0, half.symbol))
    declared = Model(
        name="leaning_column", title="Column on its rim", parameters=(MASS, b, half, G),
        coordinates=(tilt, direction), bodies=[body], gravity=G.symbol, rotation=tilt,
        bounds={"flat": tilt.position},
    )  # fmt: skip
    of = rk.structure(declared, mass=3.0, b=0.25, H=1.0, gravity=GRAVITY)
    run = rk.simulate(of, rk.GroundMotion.none(3.0), initial={"tilt": 0.1}, options=TIGHT)
    assert run.outcome is rk.Outcome.OUT_OF_BOUNDS
    assert "It reached a bound of its declaration" in run.summary()
    assert "The bound is 'flat'." in run.summary()
    striking = rk.simulate(COLUMN, run.motion, initial={"tilt": 0.1}, options=TIGHT)
    assert run.events[-1].time == pytest.approx(striking.impacts[0].time, rel=1e-12)
    said = told(rk.simulate, of, run.motion, initial={"direction_dot": 1.0})
    assert "the bound 'flat' is 0 in this state" in said


def test_a_block_that_slides_out_of_its_room_ends_at_the_wall():
    m, g = MASS.symbol, G.symbol
    x, y, theta = (coordinate(n, n, u, n) for n, u in (("x", "m"), ("y", "m"), ("theta", "rad")))
    block = Body("block", m, (x.position, y.position), m, theta.position)
    foot = Contact(
        "foot", y.position, x.position, Rigid(restitution=0, friction=sp.Rational(1, 10))
    )
    sliding = Model(
        name="sliding_mass", title="Mass that slides", parameters=(MASS, G),
        coordinates=(x, y, theta), bodies=[block], contacts=[foot], gravity=g, rotation=theta,
        bounds={"wall": 1 - x.position},
    )  # fmt: skip
    of = rk.structure(sliding, mass=2.0, gravity=10.0)
    run = rk.simulate(of, rk.GroundMotion.none(3.0), initial={"x_dot": 2.0})
    assert run.outcome is rk.Outcome.OUT_OF_BOUNDS
    assert run.events[-1].contact == "wall"
    assert run.final["x"] == pytest.approx(1.0, rel=1e-12)
    assert run.events[-1].time == pytest.approx(2.0 - 2.0**0.5, rel=1e-12)  # 2 t - t^2/2 = 1
    slower = rk.simulate(of, rk.GroundMotion.none(3.0), initial={"x_dot": 1.2})
    assert slower.final["x"] == pytest.approx(0.72, rel=1e-9)


def test_a_column_of_no_known_shape_is_drawn_by_its_axis():
    of = rk.structure(rk.derive("wobbling_column"), **COLUMN.parameters())
    run = rk.simulate(of, rk.GroundMotion.none(0.1), initial={"tilt": 0.1})
    (ax,) = plots.draw_structure(of, state={"tilt": 0.1}, view=(-np.pi / 2, 0.0)).axes
    place = of.positions({"tilt": 0.1})["column"]
    (axis,) = (line for line in ax.lines if line.get_linewidth() == 1.8)
    np.testing.assert_allclose(axis.get_xydata()[0], place[[0, 2]], atol=1e-12)
    np.testing.assert_allclose(axis.get_xydata()[1, 1], 0.0, atol=1e-12)
    assert len(run.animate(end=0.1)) == 3
    assert "tilt" in run.plot().axes[0].get_ylabel()


def test_a_column_falls_after_the_motion_where_its_energy_is_above_that_at_any_tilt_ahead():
    """Energy and moment of momentum about the vertical stay: a potential of the tilt is left."""
    p = COLUMN.parameters()
    tilts = np.linspace(1e-4, 1.2, 20000)
    s, c = np.sin(tilts), np.cos(tilts)
    across = (p["mass"] * (p["radius"] * (1 - c) + p["centroid_height"] * s) ** 2
              + p["inertia_xx"] * s**2 + p["inertia_zz"] * (1 - c) ** 2)  # fmt: skip
    lift = p["mass"] * GRAVITY * (p["radius"] * s + p["centroid_height"] * c)
    rng, fell = np.random.default_rng(5), 0
    for _ in range(40):
        at = {"tilt": rng.uniform(0.02, 0.2), "tilt_dot": rng.uniform(-0.6, 0.6)}
        at["direction_dot"] = rng.uniform(0.05, 3.0)
        energies = COLUMN.energies(at)
        momentum = at["direction_dot"] * np.interp(at["tilt"], tilts, across)
        ahead = (lift + momentum**2 / (2 * across))[tilts >= at["tilt"]].max()
        above = energies["kinetic_energy"] + energies["gravitational_energy"] - ahead
        run = rk.simulate(COLUMN, rk.GroundMotion.none(1e-3), initial=at)
        assert (run.outcome.value == "overturned") == (above > 0.0), (at, above)
        fell += above > 0.0
    assert 5 < fell < 35
