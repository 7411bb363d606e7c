"""Bodies in space on feet with Coulomb's friction: states, slips that begin, turn and end."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize

import rockeom as rk
from rockeom.codes import BEARS
from rockeom.generated.numeric_modes import FIRST_LEVER, PLACE_VALUES, least_friction
from rockeom.symbolic import Rigid, space
from tests.space import bodies
from tests.space.bodies import CORNERS, NAMES, oriented, spin_rate
from tests.space.cases import GRAVITY, TIGHT, Case, of_group
from tests.space.families import on_feet
from tests.space.mechanics import violations
from tests.space.test_standing import EL_CENTRO, GROUND, HERE, TRIPOD, prism, samples, statue

PRECISE = rk.SolverOptions(method="DOP853", rtol=1e-11, atol=1e-14)
LAST_DIGITS = rk.SolverOptions(method="DOP853", rtol=1e-15, atol=1e-18)
STILL = rk.GroundMotion.none(2.0)
BEGUN = 3e-7
"""Relative: by what forces and accelerations differ once a slip has begun, with 1e-8 m/s."""
LOW = {"width": 1.0, "depth": 1.4, "height": 0.8, "mass": 2.0}
FEET = ("south_west", "south_east", "north_east", "north_west")


def different_feet(case: Case) -> rk.Structure:
    """The statue of a case whose feet have each a coefficient of friction, by its declaration."""
    number, frame = bodies.sp.Float, bodies.FRAME
    tensor = bodies.sp.Matrix(case.given["inertia"]).applyfunc(number)
    contacts = []
    for name, place in case.given["feet"].items():
        mu = case.given["mu"][name]
        law = Rigid(restitution=0, friction=number(mu) if float(mu) else 0)
        contacts += space.feet(frame, {name: tuple(map(number, place))}, law)
    model = bodies.Model(
        name="different_feet", title="Statue on feet that rub differently", contacts=contacts,
        parameters=(bodies.MASS, bodies.G), coordinates=(*bodies.PLACE, *bodies.ANGLES),
        bodies=[space.body("body", bodies.MASS.symbol, tensor, frame)], gravity=bodies.G.symbol,
        rotation=bodies.ANGLES[1], falls=space.tilt(frame, bodies.sp.Rational(14, 10)),
    )  # fmt: skip
    return rk.structure(model, mass=case["mass"], gravity=GRAVITY)


def begun(case: Case):
    """Acceleration, that of turning, forces and mode as a case begins, and the names of its feet.

    Its velocity is given at the centroid or at a foot.
    """
    friction, names = case.given["mu"], {k: HERE[v] for k, v in NAMES.items()}
    if "feet" not in case.given:
        body = prism(case, friction=float(friction))
    else:
        names, values = {name: name for name in friction}, set(friction.values())
        body = different_feet(case) if values - {max(values)} else None
        body = body or statue(case, friction=float(max(values)))
    state, turns = oriented(case.given["R"], case.given["omega"]), case.given["omega"]
    velocity = np.array(case.given.get("v_centroid", (0, 0, 0)), float)
    for foot, of_foot in case.given.get("v_of_foot", case.given.get("v_of_corner", {})).items():
        places = body.positions(state, mode="flight")
        arm = places[names[foot]] - places["body"]
        velocity = np.array(of_foot, float) - np.cross(np.array(turns, float), arm)
    state |= {f"{axis}_dot": float(v) for axis, v in zip("xyz", velocity, strict=True)}
    given = case.given.get("ground_acceleration", [case.given.get(a, 0) for a in ("ax", "ay")])
    pushed = [*map(float, given), 0.0][:3]
    motions = [rk.GroundMotion.from_array([a, a], dt=1e-3) for a in pushed]
    run = rk.simulate(
        body, motions[0], transverse=motions[1], vertical=motions[2], duration=1e-9,
        initial=state,
    )  # fmt: skip
    first, mode = dict(zip(run.states, run.y[0].tolist(), strict=True)), str(run.mode[0])
    ground = {f"{way}ground_acceleration": a for way, a in zip(GROUND, pushed, strict=True)}
    moves = body.accelerations(first, mode=mode, **ground)
    forces = body.reactions(first, mode=mode, **ground)
    ways = ("friction_x", "friction_y", "reaction")
    force = {foot: np.array([forces[f"{n}_{w}"] for w in ways]) for foot, n in names.items()}
    return np.array([moves[x] for x in "xyz"]), spin_rate(first, moves), force, mode, names


def off(value, right) -> float:
    """How far values are from those expected, relative to the largest of these, 1 at least."""
    right = np.array(right, float)
    return np.abs(value - right).max() / max(np.abs(right).max(), 1.0)


@pytest.mark.parametrize("name", of_group("friction states"))
def test_feet_open_stick_and_slip_as_coulomb_has_it(name):
    """The flat prism that spins, too: its normal forces are those without torsion."""
    case = Case(name)
    acceleration, turning, forces, mode, names = begun(case)
    right = {key.replace("_without_torsion", ""): value for key, value in case.expected.items()}
    normals = right.get("normal") or right["normals"]
    states = right.get("states", dict.fromkeys(normals, "slip"))
    bound = BEGUN if "onset" in states.values() else 1e-12
    assert off(acceleration, right.get("acc_centroid") or right["acc"]) < bound
    assert off(turning, right.get("alpha") or [0, 0, right["yaw_acceleration"]]) < bound
    for foot, state in states.items():
        assert (names[foot] in mode) == (state != "open")
        assert (f"{names[foot]}_slides" in mode) == (state in ("slip", "onset"))
        assert off(forces[foot][2], normals[foot]) < bound
    assert all(off(forces[foot], force) < bound for foot, force in right.get("force", {}).items())


@pytest.mark.parametrize("part", [0.3, 0.95, 1.05])
@pytest.mark.parametrize("name", of_group("start of rocking or sliding"))
def test_a_prism_slides_first_below_the_critical_friction_and_rocks_above(name, part):
    """Under a ground acceleration that grows slowly in one direction."""
    case = Case(name)
    friction, turn = part * case.right("mu_critical"), np.radians(case["direction_deg"])
    due = min(case.right("rocking_acceleration"), friction * GRAVITY)
    way = np.array([np.cos(turn), np.sin(turn)])
    x, y = (rk.GroundMotion.from_array([0.0, a], dt=1.0) for a in 2 * due * way)
    run = rk.simulate(prism(case, friction=friction), x, transverse=y, duration=0.51, options=TIGHT)
    first = next(event for event in run.events if event.kind != "idle")
    assert first.time == pytest.approx(0.5, abs=1e-12)
    if part < 1.0:
        assert first.kind == "slip begins"
        assert first.mode_after.count("slides") + first.mode_before.count("idle") == 4
        speed = due * (0.51**2 - 0.25) - friction * GRAVITY * 0.01
        velocity = [run.final["x_dot"], run.final["y_dot"]]
        np.testing.assert_allclose(velocity, -speed * way, atol=2e-8)
    else:
        edge = ["south_west", "north_west" if "x" in case.expected["about"] else "south_east"]
        assert (first.kind, first.mode_after) == ("lifting", "_".join(edge))


@pytest.mark.parametrize("friction", [0.05, 0.6])
def test_a_flat_prism_that_is_pushed_slides_as_far_as_its_speed_has_it(friction):
    start = {"x_dot": -0.3, "y_dot": 0.4, "yaw": 0.3}
    run = rk.simulate(rk.Prism(**LOW, friction=friction), STILL, initial=start)
    assert [event.kind for event in run.events] == ["slip ends"]
    far = 0.5**2 / (2 * friction * GRAVITY)
    np.testing.assert_allclose([run.final["x"], run.final["y"]], [-0.6 * far, 0.8 * far], rtol=1e-9)
    assert run.events[0].time == pytest.approx(2 * far / 0.5, rel=1e-8)


def test_a_flat_prism_slides_under_steady_acceleration_and_stops_after_the_ground():
    """The ground accelerates for a second; both have one velocity after a/(mu g) of them."""
    push, holds = np.array([3.0, -1.5]), 0.2 * GRAVITY
    size = np.linalg.norm(push)
    x, y = (rk.GroundMotion.from_array([a, a], dt=1.0) for a in push)
    run = rk.simulate(rk.Prism(**LOW, friction=0.2), x, transverse=y, duration=3.0, options=PRECISE)
    begins, ends = run.events
    assert (begins.kind, ends.kind, begins.time) == ("slip begins", "slip ends", 0.0)
    speed, way = size - holds, -push / size
    velocity = [run.at(0.8)["x_dot"], run.at(0.8)["y_dot"]]
    np.testing.assert_allclose(velocity, 0.8 * speed * way, atol=2e-8)
    assert ends.time == pytest.approx(size / holds, abs=1e-7)
    far = speed / 2 + speed**2 / (2 * holds)
    np.testing.assert_allclose([run.final["x"], run.final["y"]], far * way, atol=1e-7)


def test_a_flat_prism_that_spins_stops_where_newton_euler_and_coulomb_have_it():
    """Four corners, whose normal forces are linear in the place; by scipy."""
    b, c, h, mass, friction = 0.5, 0.7, 0.4, 2.0, 0.2
    inertia, arms = mass * (b * b + c * c) / 3, np.array([*CORNERS.values()]) * [b, c]

    def rates(t, y):
        turn = np.array([[np.cos(y[2]), -np.sin(y[2])], [np.sin(y[2]), np.cos(y[2])]])
        at = arms @ turn.T
        slips = y[3:5] + y[5] * np.column_stack([-at[:, 1], at[:, 0]])
        rubs = -friction * slips / np.linalg.norm(slips, axis=1)[:, None]
        planes = np.column_stack([np.ones(4), at])
        moments = np.column_stack([np.ones(4), at + h * rubs])  # about x and y, at z = -h
        normal = planes @ np.linalg.solve(moments.T @ planes, [mass * GRAVITY, 0.0, 0.0])
        forces = normal[:, None] * rubs
        couple = (at[:, 0] * forces[:, 1] - at[:, 1] * forces[:, 0]).sum()
        return np.concatenate([y[3:], forces.sum(axis=0) / mass, [couple / inertia]])

    def stops(t, y):
        return np.linalg.norm(y[3:]) - 1e-6

    stops.terminal = True
    start = {"x": 0.0, "y": 0.0, "yaw": 0.4, "x_dot": 0.5, "y_dot": 0.2, "yaw_dot": 1.0}
    more = {"rtol": 1e-11, "atol": 1e-13, "dense_output": True, "events": stops}
    path = solve_ivp(rates, (0, 2), [*start.values()], method="DOP853", **more)
    run = rk.simulate(rk.Prism(**LOW, friction=friction), STILL, initial=start, options=PRECISE)
    for t in (0.05, 0.1, 0.15):
        np.testing.assert_allclose([run.at(t)[name] for name in start], path.sol(t), atol=1e-9)
    place = [run.final[name] for name in ("x", "y", "yaw")]
    np.testing.assert_allclose(place, path.y[:3, -1], atol=1e-8)
    assert run.events[-1].time == pytest.approx(path.t[-1], abs=1e-6)


@pytest.mark.parametrize("way", ["x", "y"])
@pytest.mark.parametrize(
    ("sizes", "friction", "end"), [((0.8, 0.6), 0.15, 12.0), ((0.5, 1.5), 0.35, 5.6)]
)
def test_shaken_along_an_axis_it_is_the_sliding_block(way, sizes, friction, end):
    """50 events under El Centro and its vertical component, twice as strong.

    The second also rocks, so that errors grow: they are compared with what a change of its height
    by 1e-14 m does, which is 1e-7 s in the end. Slips begin with a velocity by the tolerance.
    """
    width, height = sizes
    base = {"width": width, "depth": 1.1} if way == "x" else {"width": 1.1, "depth": width}
    more = {"mass": 1.0, "friction": friction}
    body = rk.Prism(**base, height=height, **more)
    planar, higher = (
        rk.SlidingBlock.from_dimensions(width=width, height=h, restitution=0.0, **more)
        for h in (height, height + 1e-14)
    )
    along, up = 2 * EL_CENTRO[0], 2 * EL_CENTRO[2]
    none, options = rk.GroundMotion.none(along.duration), {"duration": end, "options": LAST_DIGITS}
    first, second = (along, none) if way == "x" else (none, along)
    run = rk.simulate(body, first, transverse=second, vertical=up, **options)
    right, moved = (rk.simulate(block, along, vertical=up, **options) for block in (planar, higher))
    # the corners of an edge begin and end their slips one after the other in the same instant, but
    # for the time in which a slip has some velocity
    anew = np.diff(run.events.times, prepend=-1.0) > 1e-8
    events = [event for event, new in zip(run.events, anew, strict=True) if new][:50]
    kinds = [event.kind.replace("turns", "ends") for event in events]
    assert kinds == [event.kind for event in right.events[:50]]
    assert "slip begins" in kinds
    times = right.events.times[:50]
    late = np.abs([event.time for event in events] - times)
    grows = np.maximum.accumulate(np.abs(moved.events.times[:50] - times))
    assert (late <= np.maximum(100 * grows, 1e-11)).all()
    places, feet = body.positions(run.at(3.0)), planar.positions(right.at(3.0))
    assert places["south_west"]["xy".index(way)] == pytest.approx(feet["left"][0], abs=1e-11)


def least_part(places, normal, along, friction) -> float:
    """By `least_friction`, of a body that moves in the plane; along (m, 2) : in any share."""
    m, told = len(places), np.zeros((len(places), FIRST_LEVER + 12))
    # and in another coordinate, of which slips know nothing but rounding errors
    rounding = 1e-17 * np.sin(1e3 * places.sum(axis=1))
    told[:, FIRST_LEVER + 4 : FIRST_LEVER + 8] = [
        [1, 0, -y, e] for (_, y), e in zip(places, rounding, strict=True)
    ]
    told[:, FIRST_LEVER + 8 :] = [[0, 1, x, -e] for (x, _), e in zip(places, rounding, strict=True)]
    mode = sum(BEARS * PLACE_VALUES[i] for i in range(m))
    laws, share = np.column_stack([np.zeros(m), friction]), np.column_stack([normal, along])
    known = np.concatenate([told.ravel(), laws.ravel()])
    return least_friction(mode, 4, m, 0, known, share.ravel(), np.zeros(8))


def least_part_by_scipy(places, normal, along, friction) -> float:
    """The least t of which all |T| <= t mu N for forces of the same sum and moment."""
    acts, (x, y) = np.zeros((3, 2 * len(places))), places.T
    acts[0, ::2], acts[1, 1::2], acts[2, ::2], acts[2, 1::2] = 1.0, 1.0, -y, x
    bears, size = np.repeat(normal > 0.0, 2), np.abs(along).max()
    bound, forces = (friction * normal)[normal > 0.0] / size, along.ravel() / size
    rules = [
        {"type": "eq", "fun": lambda v: acts[:, bears] @ v[1:] - acts @ forces},
        {"type": "ineq", "fun": lambda v: v[0] * bound - np.hypot(v[1::2], v[2::2])},
    ]
    more = {"constraints": rules, "options": {"ftol": 1e-13, "maxiter": 500}}
    starts = [[9.0, *(forces[bears] + np.cos(i + np.arange(bears.sum())))] for i in range(4)]
    found = [minimize(lambda v: v[0], start, **more) for start in starts]
    return min(each.fun for each in found if each.success)


@pytest.mark.parametrize(("count", "idle"), [(2, 0), (3, 0), (5, 0), (3, 1), (4, 1), (5, 2)])
def test_the_least_friction_is_that_of_the_best_share(count, idle):
    """idle : how many points bear nothing, though the share has friction of theirs."""
    for seed in range(5):
        rng = np.random.default_rng([count, seed])
        case = rng.normal(size=(count, 2)), rng.uniform(0.1, 2, count), rng.normal(size=(count, 2))
        case[1][count - idle :] = -1e-12
        friction = rng.uniform(0.1, 0.9, count)
        right = least_part_by_scipy(*case, friction)
        assert least_part(*case, friction) == pytest.approx(right, rel=1e-6)


@pytest.mark.parametrize("count", [2, 3, 4, 8])
def test_the_least_friction_where_points_turn_about_one_that_needs_less(count):
    """All but the first slip about it, with 0.8 of their friction; no share needs less."""
    for seed in range(6):
        rng = np.random.default_rng([count, seed])
        places, normal = rng.normal(size=(count, 2)), rng.uniform(0.1, 2, count)
        friction, arms = rng.uniform(0.1, 0.9, count), (places - places[0])[1:]
        turning = np.column_stack([-arms[:, 1], arms[:, 0]])
        turning /= np.linalg.norm(turning, axis=1)[:, None]
        along = (friction * normal)[:, None] * np.vstack([[0.3, 0.4], 0.8 * turning])
        pull = rng.normal() * arms[0]  # another share: two points pull at one another
        along[0], along[1] = along[0] + pull, along[1] - pull
        assert least_part(places, normal, along, friction) == pytest.approx(0.8, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "turn", "mirror"),
    [("prism", 0.7, 1), ("prism", 0.0, -1), ("statue", np.pi / 2, 1), ("statue", -2.4, 1)],
)
def test_a_body_that_rubs_moves_alike_turned_by_any_yaw_and_in_a_mirror(name, turn, mirror):
    x, y, up = (1.2 * a for a in samples())
    c, s = np.cos(turn), np.sin(turn)
    body = rk.Prism(width=0.5, depth=0.7, height=1.4, mass=1.0, friction=0.28)
    runs, body = [], body if name == "prism" else rk.LeggedStatue(**TRIPOD, friction=0.2)
    for yaw, sign, components in ((0.0, 1, (x, y)), (turn, mirror, (c * x - s * y, s * x + c * y))):
        pushed = (components[0], sign * components[1], up)
        first, second, third = (rk.GroundMotion.from_array(a, dt=0.02) for a in pushed)
        run = rk.simulate(
            body, first, transverse=second, vertical=third, duration=2.3, options=LAST_DIGITS,
            initial={"pitch": 0.01, "roll": sign * 0.004, "yaw": yaw},
        )  # fmt: skip
        events = [event for event in run.events if event.kind not in ("idle", "slip turns")][:20]
        runs.append(([e.kind for e in events], [e.time for e in events], run.at(2.0)))
    (kinds, times, state), (kinds_there, times_there, image) = runs
    assert kinds_there == kinds
    assert "slip begins" in kinds
    assert len(times) == 20
    np.testing.assert_allclose(times_there, times, atol=1e-10)
    right = [c * state["x"] - s * state["y"], mirror * (s * state["x"] + c * state["y"])]
    right.append(mirror * state["yaw"] + turn)
    np.testing.assert_allclose([image[n] for n in ("x", "y", "yaw")], right, atol=1e-9)


def test_a_foot_that_bears_alone_slips_before_its_load_vanishes():
    """Friction is overcome before there is none, in a time that a step may pass over."""
    run, *_ = on_feet(204930, rubs=1.5)
    lifts = [event.mode_before for event in run.events if event.kind == "lifting"]
    assert len(lifts) >= 10
    assert all("slides" in mode for mode in lifts)


@pytest.mark.parametrize("seed", [17, 19, 22, 25, 26, 30, 31, 34, 36, 46, 56, 69, 126])
def test_a_random_body_that_rubs_moves_by_the_laws_of_mechanics(seed):
    run, *laws = on_feet(seed, rubs=0.8)
    assert run.outcome.value in ("completed", "overturned", "came to rest")
    assert any(event.kind.startswith("slip") for event in run.events)
    assert not list(violations(run, *laws))


@pytest.mark.parametrize(
    ("width", "height", "start"),
    [
        (0.3, 1.5, {"pitch": -0.3, "roll": 0.02, "x_dot": 1.0}),
        (0.8, 0.8, {"pitch": 0.1, "x_dot": 0.5}),
        (0.2, 2.0, {"x_dot": 0.5, "y_dot": 0.2}),
    ],
)
def test_a_slip_that_jams_from_the_start_ends_by_an_impact(width, height, start):
    """No force fits: friction of 2.5 presses a corner down more than it lifts it (Painleve)."""
    body = rk.Prism(width=width, depth=0.5, height=height, mass=1.0, friction=2.5)
    run = rk.simulate(body, STILL, initial=start)
    assert run.outcome in (rk.Outcome.OVERTURNED, rk.Outcome.CAME_TO_REST)
    assert (run.events[0].kind, run.events[0].time) == ("landing", 0.0)
    assert not list(violations(run, 2.5))


def test_slow_slips_take_no_more_steps_than_others():
    """They turn within nanoseconds, which had taken millions of steps."""
    run, *_ = on_feet(6002560, rubs=0.8)
    assert run.outcome is rk.Outcome.OVERTURNED
    assert len(run.t) < 30_000


def test_the_last_steps_of_a_slip_do_not_halve_towards_its_end():
    """They did once a step had come near it: a third of all steps were shorter than 1 ns."""
    body, (x, y, up) = rk.Prism(width=0.5, depth=0.7, height=2.0, mass=1.0, friction=0.3), EL_CENTRO
    start = {"pitch": 0.03, "roll": -0.04}
    run = rk.simulate(body, x, transverse=y, vertical=up, duration=3.0, initial=start)
    ends = np.array([event.time for event in run.events if event.kind == "slip ends"])
    begins = run.steps.span[:, :1]
    assert len(ends) == 3
    assert ((ends - 1e-9 < begins) & (begins < ends)).sum(0).max() < 5


@pytest.mark.parametrize(("speed", "part"), [(1e-5, 1.0), (1.01e-7, 1.0), (1e-9, 0.01)])
def test_a_slip_turns_as_coulomb_has_it_but_for_the_slowest(speed, part):
    """dw/dt = -a - mu g w/|w|, across which one of 1e-9 m/s turns as one of 1e-7 m/s would."""
    body, push, mode = rk.Prism(**LOW, friction=0.3), (0.3, 1.1, 0.0), "_slides_east_".join(FEET)
    shaking = {f"{way}ground_acceleration": a for way, a in zip(GROUND, push, strict=True)}
    moves = body.accelerations({"x_dot": speed}, mode=f"{mode}_slides_east", **shaking)
    assert moves["x"] == pytest.approx(-push[0] - 0.3 * GRAVITY, rel=1e-12)
    assert moves["y"] == pytest.approx(-part * push[1], rel=1e-12 if part == 1.0 else 0.5)


def test_feet_that_would_have_to_hold_too_much_may_slide_by_their_friction():
    low = rk.Prism(width=1.0, depth=1.4, height=0.8, mass=2.0, centroid_height=0.2)
    hints = rk.simulate(low, 4 * EL_CENTRO[0]).summary()
    assert "or let them slide, by their coefficient of friction" in hints


@pytest.mark.parametrize(("seed", "offset", "aside"), [(601, 0.0, 0.0), (607, 0.05, 1e-3)])
def test_both_corners_of_an_edge_that_is_shaken_across_slip_alike(seed, offset, aside):
    """Neither turns about the other, but for what shakes along the edge; a motion in the plane."""
    noise = [rk.GroundMotion.kanai_tajimi(0.01, duration=2.5, seed=s) for s in (seed, seed + 400)]
    along, across = (motion.scaled_to(pga="0.8 g") for motion in noise)
    sizes = {"width": 0.5, "height": 2.0, "mass": 100.0, "friction": 0.3}
    body = rk.Prism(depth=0.7, offset_x=offset, **sizes)
    run = rk.simulate(body, along, transverse=aside * across)
    assert run.outcome in (rk.Outcome.COMPLETED, rk.Outcome.OVERTURNED)
    if not offset:
        planar = rk.SlidingBlock.from_dimensions(restitution=0.0, **sizes)
        right = rk.simulate(planar, along)
        assert run.outcome is right.outcome
        assert abs(run.extremes("pitch").peak) == pytest.approx(
            abs(right.extremes("theta").peak), rel=1e-4
        )


def test_a_body_begins_to_slide_as_a_whole_while_one_of_its_feet_lifts():
    """Friction suffices until the force of a corner is all but zero, in a step that has both."""
    run, *laws = on_feet(7112450, rubs=1.5)
    assert run.outcome.value == "completed"
    assert not list(violations(run, *laws))
