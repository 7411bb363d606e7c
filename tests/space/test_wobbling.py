"""Round columns that roll on their rims without twist, and a slab on four of them."""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import brentq

import rockeom as rk
from rockeom import plots
from rockeom.symbolic import Body, Contact, Model, Rigid, coordinate, parameter, space
from tests.refusals import told
from tests.space.cases import GRAVITY, TIGHT, Case, of_group

MASS, RADIUS, HEIGHT, SLAB, G = (
    parameter(symbol, name, unit, words)
    for symbol, name, unit, words in (
        ("m", "mass", "kg", "mass of a column"),
        ("b", "radius", "m", "radius of a column"),
        ("H", "half_height", "m", "half of the height of a column"),
        ("M", "slab_mass", "kg", "mass of the slab"),
        ("g", "gravity", "m/s2", "gravity"),
    )
)
TILT = coordinate("theta", "tilt", "rad", "tilt of the axis")
DIRECTION = coordinate("psi", "direction", "rad", "azimuth of the point of contact")
CENTROID = (0, 0, HEIGHT.symbol)


def rolling() -> space.Frame:
    return space.wobble(TILT.position, DIRECTION.position, RADIUS.symbol)


def model(name: str, bodies: list[Body], *more: rk.symbolic.Parameter) -> Model:
    return Model(
        name=name, title="Columns on their rims", parameters=(MASS, RADIUS, HEIGHT, *more, G),
        coordinates=(TILT, DIRECTION), bodies=bodies, gravity=G.symbol, rotation=TILT,
        bounds={"flat": TILT.position},
    )  # fmt: skip


@pytest.fixture(scope="module")
def column():
    body = space.cylinder(
        "column", MASS.symbol, RADIUS.symbol, 2 * HEIGHT.symbol, rolling(), CENTROID
    )
    return model("wobbling_column", [body])


@pytest.fixture(scope="module")
def disc():
    across = MASS.symbol * RADIUS.symbol**2 / 4
    body = space.body("disc", MASS.symbol, sp.diag(across, across, 2 * across), rolling())
    return model("wobbling_disc", [body])


@pytest.fixture(scope="module")
def podium():
    """The slab lies on the rims opposite those on the ground: it moves by twice the centroids."""
    frame, columns = rolling(), []
    place = frame.at(CENTROID)
    for i in range(4):
        columns.append(
            space.cylinder(
                f"column_{i}", MASS.symbol, RADIUS.symbol, 2 * HEIGHT.symbol, frame, CENTROID
            )
        )
    slab = Body("slab", SLAB.symbol, tuple(2 * x for x in place))
    return model("podium", [*columns, slab], SLAB)


def structure(of: Model, case: Case, **more: float):
    half_height = max(case["H"], 1e-300)  # a disc has none
    return rk.structure(
        of, mass=case["m"], radius=case["b"], half_height=half_height, gravity=GRAVITY, **more
    )


@pytest.mark.parametrize("name", of_group("steady wobbling")[:-1])  # the last one rolls freely
def test_steady_wobbling_has_the_precession_and_the_forces_of_its_closed_form(name, column, disc):
    case = Case(name)
    of = structure(disc if "disc" in name else column, case)
    at, rate = {"tilt": float(case["tilt"]), "direction": 0.7}, case.right("precession_rate")
    falling = of.accelerations(at)["tilt"]
    state = at | {"direction_dot": rate}
    assert abs(of.accelerations(state)["tilt"]) < case.tolerance * abs(falling)
    along, across, up = of.reactions(state).values()
    case.agrees(
        contact_force_vertical=up, friction_needed=np.hypot(along, across) / up,
        energy=sum(of.energies(state).values()),
    )  # fmt: skip


def test_nutation_turns_at_its_least_tilt_and_comes_back_after_its_period(column):
    case = Case("restricted_nutation")
    start = {"tilt": case["tilt"], "direction_dot": case["precession_rate"]}
    motion, period = rk.GroundMotion.none(1.3), case.right("period")
    run = rk.simulate(structure(column, case), motion, initial=start, options=TIGHT)
    after = run.at(period)
    case.agrees(
        least_tilt=run.extremes_of(["tilt"])["tilt"].minimum, energy=run["total_energy"][-1],
        precession_in_a_period=after["direction"],
    )  # fmt: skip
    assert after["tilt"] == pytest.approx(case["tilt"], rel=case.tolerance)
    assert abs(after["tilt_dot"]) < 1e-10
    assert run.energy_balance().error < 1e-12


def test_free_wobbling_is_that_of_40_digits(column):
    case = Case("restricted_free")
    names = {
        "tilt": "tilt", "direction": "contact_direction", "tilt_dot": "tilt_rate",
        "direction_dot": "precession_rate",
    }  # fmt: skip
    start = {state: case[given] for state, given in names.items()}
    of, motion = structure(column, case), rk.GroundMotion.none(case["t_end"])
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


def test_podium_wobbles_steadily_with_its_closed_form(podium):
    case = Case("podium_steady_0.15")
    of = structure(podium, case, slab_mass=case["slab_mass"])
    state = {"tilt": case["tilt"], "direction_dot": case.right("precession_rate")}
    falling = of.accelerations({"tilt": case["tilt"]})["tilt"]
    assert abs(of.accelerations(state)["tilt"]) < case.tolerance * abs(falling)
    tilting = of.energies({"tilt": case["tilt"], "tilt_dot": 1.0})["kinetic_energy"]
    turning = of.energies({"tilt": case["tilt"], "direction_dot": 1.0})["kinetic_energy"]
    case.agrees(tilt_inertia=2 * tilting, precession_inertia=2 * turning)


CAN = {0.1: 199.848582, 0.01: 198.589813, 0.001: 198.410499, 0.0001: 198.387224}
"""Turn of the point of contact [deg] by the precession at rest [rad/s]; quadrature, six digits."""


@pytest.mark.parametrize("precession", CAN)
def test_a_can_passes_flat_and_turns_its_contact_by_more_than_half_a_turn(precession, column):
    can = rk.structure(column, mass=0.35, radius=0.033, half_height=0.06, gravity=GRAVITY)
    start = {"tilt": 0.3 * np.arctan2(33, 60), "direction_dot": precession}
    run = rk.simulate(can, rk.GroundMotion.none(0.2), initial=start, options=TIGHT)
    again = brentq(lambda t: run.at(t)["tilt_dot"], 0.15, 0.2, xtol=1e-15)  # upright in between
    assert run.at(again)["tilt"] == pytest.approx(start["tilt"], rel=1e-9)
    assert np.degrees(run.at(again)["direction"]) == pytest.approx(CAN[precession], abs=6e-7)
    # the limit of no precession: I_1 + m H^2 about the diameter of the base, m b^2 the rest
    across = 0.033**2 / 4 + 0.06**2 / 3 + 0.06**2
    limit = 180 * np.sqrt(1 + 0.033**2 / across)
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


def test_podium_under_three_components_is_that_of_40_digits(podium):
    case = Case("podium_shaken_1.5s")
    run = shaken(structure(podium, case, slab_mass=case["slab_mass"]), case)
    end = run.final
    slab = [run[f"slab_{way}"][-1] for way in ("displacement", "transverse_displacement", "rise")]
    case.agrees(
        tilt=end["tilt"], contact_direction=end["direction"], tilt_rate=end["tilt_dot"],
        precession_rate=end["direction_dot"], slab_displacement=np.array(slab),
    )  # fmt: skip
    assert run.energy_balance().error < 1e-12


def test_turned_podium_has_a_turned_motion(podium):
    case = Case("podium_shaken_1.5s")
    of = structure(podium, case, slab_mass=case["slab_mass"])
    run, turned = shaken(of, case), shaken(of, case, -np.pi / 2)
    assert turned.final["direction"] + np.pi / 2 == pytest.approx(run.final["direction"], rel=1e-11)
    assert turned.final["tilt"] == pytest.approx(run.final["tilt"], rel=1e-11)
    forces = ("horizontal_reaction", "transverse_reaction", "vertical_reaction")
    along, across, up = (run[name][-1] for name in forces)
    turned_by_hand = [across, -along, up]
    np.testing.assert_allclose([turned[n][-1] for n in forces], turned_by_hand, rtol=1e-9)


def test_a_column_without_precession_ends_where_it_comes_flat(column):
    """It would strike the opposite rim, an impact that its coordinates do not have."""
    of = rk.structure(column, mass=3.0, radius=0.25, half_height=1.0, gravity=GRAVITY)
    run = rk.simulate(of, rk.GroundMotion.none(3.0), initial={"tilt": 0.1}, options=TIGHT)
    assert run.outcome is rk.Outcome.OUT_OF_BOUNDS
    assert "It reached a bound of its declaration" in run.summary()
    assert "The bound is 'flat'." in run.summary()
    # until then it rocks in a plane, as a block of the same moment of inertia
    block = rk.RigidBlock(
        half_width=0.25, half_height=1.0, mass=3.0, inertia=3.0 * (0.25**2 / 4 + 1 / 3),
        gravity=GRAVITY,
    )  # fmt: skip
    rocking = rk.simulate(block, run.motion, initial={"theta": 0.1}, options=TIGHT)
    assert run.events[-1].time == pytest.approx(rocking.impacts[0].time, rel=1e-12)
    assert run.final["tilt_dot"] == pytest.approx(rocking.impacts[0].before["theta_dot"], rel=1e-12)
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


def test_a_column_of_no_known_shape_is_drawn_by_its_axis(column):
    of = rk.structure(column, mass=3.0, radius=0.25, half_height=1.0, gravity=GRAVITY)
    run = rk.simulate(of, rk.GroundMotion.none(0.1), initial={"tilt": 0.1})
    (ax,) = plots.draw_structure(of, state={"tilt": 0.1}, view=(-np.pi / 2, 0.0)).axes
    place = of.positions({"tilt": 0.1})["column"]
    (axis,) = (line for line in ax.lines if line.get_linewidth() == 1.8)
    np.testing.assert_allclose(axis.get_xydata()[0], place[[0, 2]], atol=1e-12)
    np.testing.assert_allclose(axis.get_xydata()[1, 1], 0.0, atol=1e-12)
    assert len(run.animate(end=0.1)) == 3
    assert "tilt" in run.plot().axes[0].get_ylabel()
