"""Round bodies on their rims: forces, the can that passes flat, Euler's disc, landings."""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import brentq

import rockeom as rk
from rockeom.symbolic import Model, Rigid, space
from tests.space.bodies import ANGLES, FRAME, MASS, PLACE, B, G, H, oriented, spin, spin_rate
from tests.space.cases import GRAVITY, TIGHT, Case, of_group
from tests.space.round_bodies import (
    FORCE,
    GROUND,
    axis_of,
    inertia,
    vector,
    violations_on_a_rim,
)

ROLLING = [name for name in of_group("rolling on a rim") if "omega" in Case(name).given][:4]
STEADY, CAN = of_group("steady wobbling"), of_group("the can")


def cylinder(case: Case, **more) -> rk.RollingCylinder:
    return rk.RollingCylinder(
        radius=case["b"], height=2 * case["H"], mass=float(case.given["m"]), gravity=GRAVITY, **more
    )


def leaning(axis, omega, x=None) -> dict[str, float]:
    """A state of an axis (3,) and an angular velocity, with this x axis or one across y."""
    axis = np.array(axis, float)
    x = np.cross([0.0, 1.0, 0.0], axis) if x is None else np.array(x, float)
    x /= np.linalg.norm(x)
    return oriented(np.array([x, np.cross(axis, x), axis]).T, omega)


def tilt_of(state) -> float:
    return float(np.arctan2(np.hypot(*axis_of(state)[:2]), axis_of(state)[2]))


@pytest.mark.parametrize("name", ROLLING)
def test_a_rim_that_rolls_has_the_forces_of_newton_and_euler(name):
    case = Case(name)
    body, state = cylinder(case), leaning(case.given["body_axis"], case.given["omega"])
    shaking = dict(zip(GROUND, map(float, case.given["ground_acceleration"]), strict=True))
    moves = body.accelerations(state, mode="rim", **shaking)
    forces = body.reactions(state, mode="rim", **shaking)
    along, across, up = (forces[name] for name in FORCE)
    case.agrees(
        alpha=spin_rate(state, moves), acc_centroid=vector(moves),
        contact_force=np.array([along, across, up]), friction_needed=np.hypot(along, across) / up,
    )  # fmt: skip
    energy, momentum = body.energies(state), inertia(body, state) @ spin(state)
    case.agrees(
        kinetic=energy["kinetic_energy"], potential=energy["gravitational_energy"],
        vertical_angular_momentum_about_centroid=momentum[2],
    )  # fmt: skip


def test_a_shaken_column_rolls_as_in_40_digits():
    case = Case("rolling_shaken_2s")
    given = {"ax": "0.75 sin 4t", "ay": "-0.5 sin(3t+0.5)", "az": "0.25 sin 6t"}
    assert given.items() <= case.given.items()
    x, y, up = (
        rk.GroundMotion.harmonic(size, angular_frequency=rate, phase=phase, duration=case["t_end"])
        for size, rate, phase in ((0.75, 4.0, 0.0), (-0.5, 3.0, 0.5), (0.25, 6.0, 0.0))
    )
    start = leaning(*(case.given[of] for of in ("body_axis", "omega", "body_x")))
    start |= dict(zip("xy", map(float, case.given["centroid"]), strict=True))
    body = cylinder(case)
    run = rk.simulate(body, x, transverse=y, vertical=up, initial=start, options=TIGHT)
    end, turned = run.final, body.rotations(run.final)["body"]
    case.agrees(
        body_axis=turned[:, 2], body_x=turned[:, 0], omega=spin(end),
        centroid=vector(end), contact_point=body.positions(end)["rim"][:2],
        kinetic=run["kinetic_energy"][-1], potential=run["gravitational_energy"][-1],
        energy=run["total_energy"][-1], contact_force=np.array([run[name][-1] for name in FORCE]),
    )  # fmt: skip
    assert run.energy_balance().error < 1e-13


@pytest.mark.parametrize("name", STEADY)
def test_steady_wobbling_is_a_motion_of_a_free_rim(name):
    """Its angular velocity turns with the precession, and so does the way of the centroid."""
    case, rate = Case(name), Case(name).right("precession_rate")
    at_rest = "centroid" in case.given  # Euler's disc as Moffatt has it
    spins = -rate * np.cos(case["tilt"]) if at_rest else None
    body = cylinder(case)
    start = body.on_rim(case["tilt"], direction=0.7, precession=rate, spin=spins, yaw=-0.4)
    moves, forces = body.accelerations(start, mode="rim"), body.reactions(start, mode="rim")
    along, across, up = (forces[name] for name in FORCE)
    case.agrees(contact_force_vertical=up, energy=sum(body.energies(start).values()))
    turning = np.cross([0.0, 0.0, rate], spin(start))
    size = np.abs(turning).max() + np.linalg.norm(spin(start)) ** 2
    np.testing.assert_allclose(spin_rate(start, moves), turning, atol=case.tolerance * size)
    size, needed = np.linalg.norm(spin(start)), np.hypot(along, across) / up
    case.agrees(**{"omega_size": size} if at_rest else {"friction_needed": needed})
    assert at_rest == (needed < 1e-12)


def passage_and_rest(run: rk.Response) -> list[float]:
    """The times of the least tilt, in passing flat, and of the largest one behind it."""

    def rises(t: float) -> float:
        s = run.at(t)
        across = np.cos(s["pitch"]) * np.sin(s["roll"]) * s["roll_dot"]
        return across + np.sin(s["pitch"]) * np.cos(s["roll"]) * s["pitch_dot"]

    times = np.linspace(0.0, run.t[-1], 400)[1:]
    turns = np.flatnonzero(np.diff(np.sign([rises(t) for t in times])))[:2]
    return [brentq(rises, times[i], times[i + 1], xtol=1e-15) for i in turns]


def turn_of_contact(run: rk.Response, until: float) -> float:
    """Degrees through which the point of contact turns, in between steps of the motion."""
    axes = np.array([axis_of(run.at(t)) for t in (*run.t[run.t < until], until)])
    directions = np.unwrap(np.arctan2(axes[:, 1], axes[:, 0]))
    return float(np.degrees(directions[-1] - directions[0]))


@pytest.mark.parametrize("name", CAN)
def test_a_can_passes_flat_and_turns_its_contact(name):
    case = Case(name)
    smooth, rate = "smooth" in name, case["precession_rate"]
    can = cylinder(case, friction=0 if smooth else None)
    spins = -rate * np.cos(case["tilt"]) if smooth else case["spin"]  # smooth: none about the axis
    start = can.on_rim(case["tilt"], direction=0.4, precession=rate, spin=spins)
    run = rk.simulate(can, rk.GroundMotion.none(0.2), initial=start, options=TIGHT)
    passes, again = passage_and_rest(run)
    case.agrees(turn_of_contact_point_deg=turn_of_contact(run, again))
    assert tilt_of(run.at(again)) == pytest.approx(case["tilt"], rel=1e-11)
    assert run.energy_balance().error < 1e-11
    end = run.at(again)
    if smooth:
        case.agrees(least_tilt=tilt_of(run.at(passes)))
    else:
        case.agrees(time=again, spin_about_axis=spin(end) @ axis_of(end))


def test_a_column_that_leans_in_a_plane_is_a_pendulum_until_it_lies_flat():
    case = Case("planar_limit_cylinder")
    body = cylinder(case)
    about_rim = 2 * body.energies(body.on_rim(0.1, tilt_rate=1.0))["kinetic_energy"]
    turning_back = body.mass * GRAVITY * np.hypot(case["b"], case["H"])
    case.agrees(I0=about_rim, p=np.sqrt(turning_back / about_rim))
    still, start = rk.GroundMotion.none(3.0), body.on_rim(0.1, direction=0.3)
    run = rk.simulate(body, still, initial=start, options=TIGHT)
    assert run.outcome is rk.Outcome.OUT_OF_BOUNDS
    assert "The bound is 'flat'." in run.summary()
    block = rk.RigidBlock(
        half_width=case["b"], half_height=case["H"], mass=body.mass, gravity=GRAVITY,
        inertia=body.parameters()["inertia_across"],
    )  # fmt: skip
    rocking = rk.simulate(block, run.motion, initial={"theta": 0.1}, options=TIGHT)
    assert run.events[-1].time == pytest.approx(rocking.impacts[0].time, abs=1e-8)
    # with the least precession it passes, by the turn that the case has for none
    for friction, turn in ((None, "rolling"), (0, "smooth")):
        passing = cylinder(case, friction=friction)
        start = passing.on_rim(0.1, precession=1e-5, spin=None if friction is None else -1e-5)
        run = rk.simulate(passing, still, initial=start, options=TIGHT)
        expected = case.right(f"turn_of_contact_{turn}_deg")
        assert turn_of_contact(run, passage_and_rest(run)[1]) == pytest.approx(expected, abs=2e-3)


def test_a_smooth_rim_keeps_momentum_energy_and_spin():
    body = rk.RollingCylinder(radius=0.2, height=0.5, mass=3.0, friction=0)
    start = body.on_rim(0.2, precession=2.0, tilt_rate=0.5, spin=1.5) | {"x_dot": 0.3, "y_dot": 0.1}
    run = rk.simulate(body, rk.GroundMotion.none(2.0), initial=start, options=TIGHT)
    kept = [
        [(inertia(body, s) @ spin(s))[2], spin(s) @ axis_of(s), s["x_dot"], s["y_dot"]]
        for s in (run.at(0.0), run.at(1.0), run.final)
    ]
    np.testing.assert_allclose(kept[1:], [kept[0]] * 2, rtol=1e-10)
    assert run.energy_balance().error < 1e-11


@pytest.mark.parametrize("seed", range(8))
def test_a_rim_that_is_shaken_off_the_ground_lands_by_the_laws_of_mechanics(seed):
    rng, rolls = np.random.default_rng(seed), seed % 2 == 1
    body = rk.RollingCylinder(
        radius=rng.uniform(0.1, 0.4), height=rng.uniform(0.2, 2.0), mass=3.0,
        friction=None if rolls else 0,
    )  # fmt: skip
    peaks = (3.0, 3.0, 15.0)
    x, y, up = (rk.GroundMotion.from_array(a * rng.normal(size=100), dt=0.02) for a in peaks)
    direction, precession, spins = rng.uniform(0, 6), rng.normal(), rng.normal()
    start = body.on_rim(0.1, direction=direction, precession=precession, spin=spins)
    run = rk.simulate(body, x, transverse=y, vertical=up, initial=start)
    assert run.outcome.value in ("completed", "overturned")
    assert not list(violations_on_a_rim(run))
    assert run.impacts
    freed = sum(e.mode_after == "rim_released" != e.mode_before for e in run.events)
    assert (f" {freed} times its rim" in run.summary()) == (freed > 0)
    needed = (run.support.foot_friction_demand, run.support.friction_demand)
    assert needed[0] == (needed[1] if rolls else pytest.approx(np.nan, nan_ok=True))


def test_turned_about_the_vertical_it_moves_alike():
    body, turn = rk.RollingCylinder(radius=0.25, height=2.0, mass=3.0), 0.7
    a = rk.GroundMotion.from_array(np.sin(np.arange(100)), dt=0.02)
    none, ends = rk.GroundMotion.none(a.duration), []
    for angle, yaw in ((0.0, 0.0), (turn, 0.0), (turn, 1.9)):
        start = body.on_rim(0.1, direction=0.2 + angle, precession=0.5, yaw=yaw)
        motions = [np.cos(angle) * a, np.sin(angle) * a] if angle else [a, none]
        run = rk.simulate(body, motions[0], transverse=motions[1], initial=start, options=TIGHT)
        c, s = np.cos(angle), np.sin(angle)
        axis = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ axis_of(run.final)
        ends.append([*axis, np.hypot(run.final["x"], run.final["y"]), run.final["z"]])
    np.testing.assert_allclose(ends[1:], [ends[0]] * 2, rtol=1e-10)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"friction": 0.3}, "a rim that slips with friction is not modelled"),
        ({"inertia_along": 5.0, "inertia_across": 1.0}, "no round body has more than twice"),
    ],
)
def test_a_round_body_that_cannot_be_is_refused(changed, words):
    with pytest.raises(ValueError, match=words):
        rk.RollingCylinder(**{"radius": 0.2, "height": 1.0, "mass": 3.0} | changed)


def test_a_state_that_lies_flat_is_refused():
    body = rk.RollingCylinder(radius=0.2, height=1.0, mass=3.0)
    with pytest.raises(ValueError, match="no point is the lowest in this state"):
        rk.simulate(body, rk.GroundMotion.none(1.0))
    for tilt in (0.0, 1.5):
        with pytest.raises(ValueError, match="an angle above zero"):
            body.on_rim(tilt)


@pytest.mark.parametrize(
    ("friction", "bounds", "words"),
    [(sp.S.Half, space.flat(FRAME), "rolls without slip"), (None, {}, "bounds=space.flat")],
)
def test_a_rim_with_friction_or_without_a_bound_is_refused(friction, bounds, words):
    body = space.cylinder("body", MASS.symbol, B.symbol, 2 * H.symbol, FRAME)
    rim = space.rim(FRAME, B.symbol, Rigid(friction=friction), (0, 0, -H.symbol))
    with pytest.raises(ValueError, match=words):
        Model(
            name="rim", title="Rim", parameters=(MASS, B, H, G), coordinates=(*PLACE, *ANGLES),
            gravity=G.symbol, rotation=ANGLES[1], bodies=[body], contacts=[rim], bounds=bounds,
        )  # fmt: skip


def test_a_rolling_motion_is_kept_and_read_again(tmp_path):
    body = rk.RollingCylinder(radius=0.2, height=1.0, mass=3.0)
    run = rk.simulate(body, rk.GroundMotion.none(0.5), initial=body.on_rim(0.05, precession=0.3))
    run.save(tmp_path / "run.nc")
    read = rk.load(tmp_path / "run.nc")
    assert read.structure == body
    np.testing.assert_array_equal(read.y, run.y)
