"""Round bodies that roll on their rims: forces, the can that passes flat, Euler's disc, landings."""

from collections.abc import Iterator

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import brentq, minimize_scalar

import rockeom as rk
from rockeom.symbolic import Model, Rigid, space
from tests.space.bodies import ANGLES, FRAME, G, MASS, PLACE, B, H, oriented, spin, spin_rate
from tests.space.cases import GRAVITY, TIGHT, Case, of_group

GROUND = ("", "transverse_", "vertical_")
FORCE = ("rim_friction_x", "rim_friction_y", "rim_reaction")
ROLLING = [n for n in of_group("rolling on a rim") if n not in ("planar_limit_cylinder", "rolling_shaken_2s")]  # fmt: skip
STEADY, CAN = of_group("steady wobbling"), of_group("the can")


def cylinder(case: Case, **more) -> rk.RollingCylinder:
    return rk.RollingCylinder(
        radius=case["b"], height=2 * case["H"], mass=float(case.given["m"]), gravity=GRAVITY, **more
    )


def leaning(axis, omega) -> dict[str, float]:
    """The state of an axis (3,) and an angular velocity, its yaw being 0.3."""
    c, s = np.cos(0.3), np.sin(0.3)
    x, y, z = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ np.array(axis, float)
    pitch, roll = np.arctan2(x, z), -np.arcsin(y)
    turned = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    tilted = [[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]]
    rolled = [[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]]
    return oriented(turned @ tilted @ rolled, omega)


def axis_of(state) -> np.ndarray:
    """The axis of the body, with all digits of a small tilt."""
    along, across = np.sin(state["pitch"]) * np.cos(state["roll"]), -np.sin(state["roll"])
    c, s = np.cos(state["yaw"]), np.sin(state["yaw"])
    up = np.cos(state["pitch"]) * np.cos(state["roll"])
    return np.array([c * along - s * across, s * along + c * across, up])


def tilt_of(state) -> float:
    return float(np.arctan2(np.hypot(*axis_of(state)[:2]), axis_of(state)[2]))


def inertia(body: rk.RollingCylinder, state) -> np.ndarray:
    """The tensor about the centroid, along the axes of the ground."""
    values, axis = body.parameters(), axis_of(state)
    across, along = values["inertia_across"], values["inertia_along"]
    return across * np.eye(3) + (along - across) * np.outer(axis, axis)


@pytest.mark.parametrize("name", ROLLING)
def test_a_rim_that_rolls_has_the_forces_of_newton_and_euler(name):
    case = Case(name)
    body, state = cylinder(case), leaning(case.given["body_axis"], case.given["omega"])
    of_ground = zip(GROUND, map(float, case.given["ground_acceleration"]), strict=True)
    shaking = {f"{way}ground_acceleration": value for way, value in of_ground}
    moves = body.accelerations(state, mode="rim", **shaking)
    forces = body.reactions(state, mode="rim", **shaking)
    along, across, up = (forces[name] for name in FORCE)
    case.agrees(
        alpha=spin_rate(state, moves), acc_centroid=np.array([moves[axis] for axis in "xyz"]),
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
    axis, body_x = (np.array(case.given[of], float) for of in ("body_axis", "body_x"))
    start = oriented(np.array([body_x, np.cross(axis, body_x), axis]).T, case.given["omega"])
    start |= dict(zip("xy", map(float, case.given["centroid"]), strict=True))
    body = cylinder(case)
    run = rk.simulate(body, x, transverse=y, vertical=up, initial=start, options=TIGHT)
    end, turned = run.final, body.rotations(run.final)["body"]
    case.agrees(
        body_axis=turned[:, 2], body_x=turned[:, 0], omega=spin(end),
        centroid=np.array([end[axis] for axis in "xyz"]),
        contact_point=body.positions(end)["rim"][:2], kinetic=run["kinetic_energy"][-1],
        potential=run["gravitational_energy"][-1], energy=run["total_energy"][-1],
        contact_force=np.array([run[name][-1] for name in FORCE]),
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
    if at_rest:
        case.agrees(omega_size=np.linalg.norm(spin(start)))
        assert np.hypot(along, across) < 1e-12 * up
    else:
        case.agrees(friction_needed=np.hypot(along, across) / up)


def next_rest(run: rk.Response) -> float:
    """The time at which the tilt is largest again, behind the first passage."""

    def rises(t: float) -> float:
        s = run.at(t)
        across = np.cos(s["pitch"]) * np.sin(s["roll"]) * s["roll_dot"]
        return across + np.sin(s["pitch"]) * np.cos(s["roll"]) * s["pitch_dot"]

    times = np.linspace(0.0, run.t[-1], 400)[1:]
    rising = np.array([rises(t) for t in times])
    last = np.flatnonzero((rising[:-1] > 0) & (rising[1:] <= 0))[0]
    return brentq(rises, times[last], times[last + 1], xtol=1e-15)


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
    again = next_rest(run)
    case.agrees(turn_of_contact_point_deg=turn_of_contact(run, again))
    assert tilt_of(run.at(again)) == pytest.approx(case["tilt"], rel=1e-11)
    assert run.energy_balance().error < 1e-11
    if not smooth:
        end = run.at(again)
        case.agrees(time=again, spin_about_axis=spin(end) @ axis_of(end))
        return
    tilts = [tilt_of(s) for s in map(run.at, run.t[run.t < again])]
    step = int(np.argmin(tilts))
    least = minimize_scalar(
        lambda t: tilt_of(run.at(t)), bounds=run.t[[step - 1, step + 1]], method="bounded",
        options={"xatol": 1e-16},
    )  # fmt: skip
    case.agrees(least_tilt=least.fun)


def test_a_column_that_leans_in_a_plane_is_a_pendulum_until_it_lies_flat():
    case = Case("planar_limit_cylinder")
    body = cylinder(case)
    moving = body.on_rim(0.1, direction=0.3, tilt_rate=1.0)
    about_rim = 2 * body.energies(moving)["kinetic_energy"]
    alpha = np.arctan2(case["b"], case["H"])
    stiffness = body.mass * GRAVITY * np.hypot(case["b"], case["H"])
    case.agrees(I0=about_rim, alpha=alpha, p=np.sqrt(stiffness / about_rim))
    run = rk.simulate(
        body, rk.GroundMotion.none(3.0), initial=body.on_rim(0.1, direction=0.3), options=TIGHT
    )
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
        run = rk.simulate(passing, rk.GroundMotion.none(2.5), initial=start, options=TIGHT)
        expected = case.right(f"turn_of_contact_{turn}_deg")
        assert turn_of_contact(run, next_rest(run)) == pytest.approx(expected, abs=2e-3)


def test_a_smooth_rim_keeps_momentum_energy_and_spin():
    body = rk.RollingCylinder(radius=0.2, height=0.5, mass=3.0, friction=0)
    start = body.on_rim(0.2, precession=2.0, tilt_rate=0.5, spin=1.5) | {"x_dot": 0.3, "y_dot": 0.1}
    run = rk.simulate(body, rk.GroundMotion.none(2.0), initial=start, options=TIGHT)
    kept = []
    for state in (run.at(0.0), run.at(1.0), run.final):
        momentum = inertia(body, state) @ spin(state)
        kept.append([momentum[2], spin(state) @ axis_of(state), state["x_dot"], state["y_dot"]])
    np.testing.assert_allclose(kept[1:], [kept[0]] * 2, rtol=1e-10)
    assert run.energy_balance().error < 1e-11


def wrongs(run: rk.Response) -> Iterator[str]:
    """What of a motion is not by the laws of Newton and Euler, at forty of its steps."""
    body, rolls = run.structure, run.structure.friction is None
    weight = body.mass * body.gravity
    motions = (run.motion, run.transverse, run.vertical)
    for row in np.unique(np.linspace(0, len(run.t) - 2, 40).astype(int)):
        state, mode = dict(zip(run.states, run.y[row].tolist(), strict=True)), str(run.mode[row])
        pushed = [float(motion.acceleration(run.t[row])) for motion in motions]
        shaking = {f"{w}ground_acceleration": a for w, a in zip(GROUND, pushed, strict=True)}
        moves = body.accelerations(state, mode=mode, **shaking)
        forces = body.reactions(state, mode=mode, **shaking)
        force, omega = np.array([forces[name] for name in FORCE]), spin(state)
        arm, velocity = arm_of(body, state), np.array([state[f"{axis}_dot"] for axis in "xyz"])
        tensor = inertia(body, state)
        lacking = force - body.mass * (np.array([moves[a] for a in "xyz"]) + pushed)
        lacking[2] -= weight
        turning = tensor @ spin_rate(state, moves) + np.cross(omega, tensor @ omega)
        torque = np.cross(arm, force) - turning
        if max(np.abs(lacking).max(), np.abs(torque).max()) > 1e-9 * weight:
            yield f"forces at {run.t[row]:.4g} s in {mode} lack {lacking}, {torque}"
        slip, touches = velocity + np.cross(omega, arm), mode != "flight"
        held = slip if rolls and mode == "rim" else slip[2:] if touches else slip[:0]
        if held.size and np.abs(held).max() > 1e-7:
            yield f"the rim moves at {slip} m/s at {run.t[row]:.4g} s in {mode}"
        if (not rolls or mode != "rim") and np.any(force[:2]):
            yield f"friction at {run.t[row]:.4g} s in {mode}"


def arm_of(body: rk.RollingCylinder, state) -> np.ndarray:
    """From the centroid to the lowest point of the rim, by the axis alone."""
    axis = axis_of(state)
    down = axis[2] * axis - np.array([0.0, 0.0, 1.0])
    return body.radius * down / np.linalg.norm(down) - body.parameters()["centroid_height"] * axis


@pytest.mark.parametrize("seed", range(8))
def test_a_rim_that_is_shaken_off_the_ground_lands_by_the_laws_of_mechanics(seed):
    rng = np.random.default_rng(seed)
    rolls = seed % 2 == 1
    sizes = {"radius": rng.uniform(0.1, 0.4), "height": rng.uniform(0.2, 2.0), "mass": 3.0}
    body = rk.RollingCylinder(**sizes, friction=None if rolls else 0)
    x, y, up = (
        rk.GroundMotion.from_array(a * rng.normal(size=100), dt=0.02) for a in (3.0, 3.0, 15.0)
    )
    start = body.on_rim(0.1, direction=rng.uniform(0, 6), precession=rng.normal(), spin=rng.normal())
    run = rk.simulate(body, x, transverse=y, vertical=up, initial=start)
    assert run.outcome.value in ("completed", "overturned")
    assert run.impacts and not list(wrongs(run))
    assert run.energy_balance().error < 1e-9
    assert run.extremes("rim_uplift").minimum > -1e-9
    for impact in run.impacts:
        before, after = impact.before, impact.after
        arm, gained = arm_of(body, after), {}
        rates = [np.array([s[f"{axis}_dot"] for axis in "xyz"]) for s in (before, after)]
        impulse = body.mass * (rates[1] - rates[0])
        gained = inertia(body, after) @ spin(after) - inertia(body, before) @ spin(before)
        np.testing.assert_allclose(np.cross(arm, impulse), gained, atol=1e-8)
        leaves = rates[1] + np.cross(spin(after), arm)
        assert impulse[2] >= 0.0 and leaves[2] > -1e-9
        if rolls and impact.mode_after == "rim":
            np.testing.assert_allclose(leaves, 0.0, atol=1e-9)


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
        ({"radius": 0.0}, "radius"),
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
