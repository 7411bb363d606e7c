"""Ground that slopes: statics and motions against closed forms and an independent integration."""

import itertools
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

import rockeom as rk
from rockeom.drawing.animation import animate
from rockeom.motion.slope import slope_angle, turned
from rockeom.plots import draw_structure
from tests.refusals import refused, told
from tests.typical import S1, STIFFNESS, column, on_springs, oscillator, stack

G = 9.81
B, H = 0.1, 0.4
BLOCK = rk.RigidBlock(half_width=B, half_height=H)
ALPHA, R = math.atan2(B, H), math.hypot(B, H)
STILL = rk.GroundMotion.none(1.0)
TIGHT = rk.SolverOptions(rtol=1e-12, atol=1e-14)
SINE = rk.GroundMotion.single_sine(2.0, 0.5, duration=1.5)
NEW_SAMPLES = np.random.default_rng(3).standard_normal(76)
RECORD = rk.GroundMotion.from_array(2.0 * NEW_SAMPLES, 0.02)
UP = rk.GroundMotion.from_array(np.roll(NEW_SAMPLES, 7)[:51], 0.015)


HELD = rk.HeldBlock(width=2.0 * B, height=2.0 * H, mass=1.0, friction=1.0)
"""The same block on feet that may slide and bounce."""
BLOCKS = {
    "pinned": (BLOCK, rk.VelocityRatio(0.85), 0.85, 2.0),
    "held": (HELD, None, 1.0 - 1.5 * math.sin(ALPHA) ** 2, 1.4),  # later it lies, and slides
}
"""Impact law, ratio of the rates at an impact, and duration."""


def flat_held(friction: float) -> rk.HeldBlock:
    return rk.HeldBlock(width=2.0, height=0.2, mass=1.0, friction=friction)


def flat(friction: float) -> rk.SlidingBlock:
    """A block so flat that it only slides."""
    return rk.SlidingBlock(half_width=1.0, half_height=0.1, friction=friction, restitution=0.0)


@pytest.mark.parametrize("phi", [0.1, -0.2, 1e-3])
def test_uplift_and_overturning_of_a_block_on_a_slope(phi):
    left, right = BLOCK.on_slope(phi).uplift_accelerations
    assert right == pytest.approx(G * math.sin(ALPHA - phi) / math.cos(ALPHA), rel=1e-10)
    assert left == pytest.approx(G * math.sin(ALPHA + phi) / math.cos(ALPHA), rel=1e-10)
    sliding = rk.SlidingBlock(half_width=B, half_height=H, friction=0.5, restitution=0.0)
    for structure in (BLOCK, sliding):
        angles = structure.on_slope(phi).overturning_angles
        assert angles == pytest.approx((ALPHA + phi, ALPHA - phi), rel=1e-10)
    ways = ((-1.0, ALPHA + phi, left), (1.0, ALPHA - phi, right))
    for block, (side, angle, uplift) in itertools.product((BLOCK, HELD), ways):
        for part, falls in ((1.0 - 1e-9, False), (1.0 + 1e-9, True)):
            start = {"theta": side * part * angle}
            run = rk.simulate(block, rk.GroundMotion.none(9.0), slope=phi, initial=start)
            assert (run.outcome == "overturned" and not run.impacts) == falls
            told = any("beyond the overturning angle" in hint for hint in run.hints)
            assert told == (falls and block is BLOCK)
            push = rk.GroundMotion.constant(-side * part * uplift, 0.5)
            run = rk.simulate(block, push, slope=phi)
            assert bool(len(run.events)) == bool(np.any(side * run["theta"] > 0.0)) == falls


def test_uplift_overturning_and_the_start_of_elastic_structures_on_a_slope():
    phi, soft = 0.07, column(stiffness=2e5)
    level, sloping = soft.on_slope(0.0), soft.on_slope(phi)
    assert (sloping.stands, soft.on_slope(0.5).stands) == (True, False)
    expected = (level.overturning_angles[0] + phi, level.overturning_angles[1] - phi)
    assert sloping.overturning_angles == pytest.approx(expected, rel=1e-9)
    run = rk.simulate(column(), STILL, slope=phi)
    assert np.ptp(run["u"]) < 1e-15
    assert run["u"][0] == pytest.approx(S1["mass"] * G * math.sin(phi) / STIFFNESS, rel=1e-10)
    resting = rk.simulate(on_springs(), STILL, slope=phi)
    assert np.ptp(resting.y, axis=0).max() < 1e-15
    assert 0.0 < resting["theta"][0] < phi


@pytest.mark.parametrize("flat", [flat, flat_held])
@pytest.mark.parametrize("phi", [0.3, -0.3])
def test_a_flat_block_slips_from_rest(phi, flat):
    mu, t = 0.25, np.linspace(0.05, 1.0, 20)
    run = rk.simulate(flat(mu), STILL, slope=phi)
    a = math.copysign(G * (math.sin(abs(phi)) - mu * math.cos(phi)), phi)
    assert run.at(t)["x"] == pytest.approx(0.5 * a * t**2, rel=1e-10)
    assert run.energy_balance().error < 1e-12
    assert "it slides downhill, since its friction, 0.25, is below 0.3093" in run.summary()
    assert rk.simulate(flat(0.31), STILL, slope=phi).outcome == "came to rest"
    case = rk.Case(flat(mu), STILL, slope=phi)
    slopes = rk.sensitivity(case, ["x at 1.0"], ["slope", "friction"])
    by_mu = -0.5 * G * math.cos(phi) * math.copysign(1.0, phi)
    by_phi = 0.5 * G * (math.cos(phi) + mu * math.sin(abs(phi)))
    assert slopes.derivatives[0] == pytest.approx((by_phi, by_mu), rel=1e-9)


@pytest.mark.parametrize("flat", [flat, flat_held])
@pytest.mark.parametrize("phi", [0.1, -0.15])
def test_drift_of_a_flat_block_in_each_cycle_of_a_square_wave(phi, flat):
    mu, size, period, cycles = 0.4, 4.0, 0.5, 4
    down, up = (G * (mu * math.cos(phi) - s * math.sin(abs(phi))) for s in (1.0, -1.0))
    assert down < size < up
    starts, way = 0.5 * period * np.arange(2 * cycles), math.copysign(1.0, phi)
    rows = np.zeros((len(starts), 7))
    rows[:, 0], rows[:, 1] = starts, starts + 0.5 * period
    rows[::2, 3], rows[1::2, 3] = -way * size, way * size
    run = rk.simulate(flat(mu), rk.GroundMotion(rows), slope=phi)
    drift = way * size * (size - down) * period**2 / (4.0 * (size + down))
    ends = run.at(period * np.arange(cycles + 1))["x"]
    assert np.diff(ends) == pytest.approx(np.full(cycles, drift), rel=1e-10)


MOTIONS = {
    "record": (RECORD, UP),
    "sine": (SINE, None),
    "Ricker": (rk.GroundMotion.ricker(2.0, 0.4, duration=1.6), None),
    "antisymmetric": (rk.GroundMotion.ricker(2.0, 0.4, 1.6, antisymmetric=True), None),
    "vertical sine": (rk.GroundMotion.constant(0.5, 1.2, 1.5), SINE),
}


def rocking(motion, vertical, phi, axes, theta, times, e):
    """Newton and Euler in level and upright axes: the block leans by psi from the vertical."""

    def ground(t):
        across = motion.acceleration(t)
        up = 0.0 if vertical is None else vertical.acceleration(t)
        return (across, up) if axes == "world" else turned(-phi, across, up)

    def rates(t, y, side):
        ax, az = ground(t)
        lean = ALPHA - side * (y[0] + phi)
        moment = -side * (az + G) * math.sin(lean) - ax * math.cos(lean)
        return y[1], moment / (4.0 / 3.0 * R)

    corners = np.concatenate([m.breakpoints for m in (motion, vertical) if m is not None])
    y, side, states, t = np.array([theta, 0.0]), math.copysign(1.0, theta), [], 0.0
    ends = np.unique(np.concatenate([corners, times]))
    for end in ends[(ends > 0.0) & (ends <= times[-1])]:
        while t < end:

            def lands(_, y, side):
                return y[0] * side

            lands.terminal, lands.direction = True, -1.0
            part = solve_ivp(
                rates, (t, end), y, "DOP853", events=lands, args=(side,), rtol=1e-12, atol=1e-14,
                max_step=0.05,
            )  # fmt: skip
            t, y = part.t[-1], part.y[:, -1].copy()
            if part.status == 1:
                y, side = np.array([0.0, e * y[1]]), -side
        if np.any(end == times):
            states.append(y)
    return np.array(states)


@pytest.mark.parametrize("axes", ["slope", "world"])
@pytest.mark.parametrize("name", MOTIONS)
@pytest.mark.parametrize("which", BLOCKS)
def test_rocking_on_a_slope_is_that_of_an_independent_integration(name, axes, which):
    (motion, vertical), phi, (block, law, e, duration) = MOTIONS[name], 0.06, BLOCKS[which]
    case = rk.Case(
        block, motion, law, {"theta": 0.08}, duration, vertical, slope=phi, ground_axes=axes
    )
    run = rk.simulate(case, options=TIGHT)
    assert len(run.impacts) >= 2
    times = np.arange(0.1, run.t[-1], 0.1)
    known = rocking(motion, vertical, phi, axes, 0.08, times, e)
    found = run.at(times)
    assert found["theta"] == pytest.approx(known[:, 0], abs=1e-9)
    assert found["theta_dot"] == pytest.approx(known[:, 1], abs=1e-8)
    assert run.energy_balance().error < 1e-9
    shears = run.at(times, names=["base_shear", "horizontal_reaction"])
    assert shears["base_shear"] == pytest.approx(shears["horizontal_reaction"], rel=1e-8)
    of_many = rk.simulate_many(case, {"slope": np.linspace(0.04, phi, 12)}, options=TIGHT)
    peak = of_many.peak.sel(state="theta").values[-1]
    assert peak == pytest.approx(abs(run.extremes("theta").peak), rel=1e-12)


@pytest.mark.parametrize("slope", [-0.1, 0.0])
def test_derivatives_by_slope_and_by_factors_of_the_motions_on_a_slope(slope):
    case = rk.Case(on_springs(), RECORD, vertical=UP, slope=slope, ground_axes="world")
    names, step = ["slope", "scale", "time_scale"], 1e-6
    found = rk.sensitivity(case, ["theta at 1.0"], names, TIGHT).derivatives[0]

    def theta(slope=0.0, scale=0.0, time_scale=0.0):
        moved = [m.scaled(1.0 + scale, time=1.0 + time_scale) for m in (RECORD, UP)]
        one = replace(case, motion=moved[0], vertical=moved[1], slope=case.slope + slope)
        return rk.simulate(one, options=TIGHT).at(1.0)["theta"]

    for name, derivative in zip(names, found, strict=True):
        central = (theta(**{name: step}) - theta(**{name: -step})) / (2.0 * step)
        assert derivative == pytest.approx(central, rel=1e-5)


@pytest.mark.parametrize("make", [column, on_springs, stack, oscillator])
def test_a_slope_acts_as_constant_accelerations_of_level_ground(make):
    phi, times = 0.05, np.linspace(0.1, 1.4, 14)
    motions = [RECORD * 1.5, RECORD * 0.3]
    run = rk.simulate(make(), motions[0], vertical=motions[1], slope=phi, options=TIGHT)
    constants = -G * math.sin(phi), G * (math.cos(phi) - 1.0)
    across, up = (
        rk.GroundMotion.from_array(motion.samples + x, 0.02)
        for motion, x in zip(motions, constants, strict=True)
    )
    start = {name: float(x) for name, x in run.at(0.0).items()}
    level = rk.simulate(make(), across, vertical=up, initial=start, options=TIGHT)
    for name, values in level.at(times).items():
        assert run.at(times)[name] == pytest.approx(values, abs=1e-9 * np.abs(level[name]).max())
    assert len(run.events)


def test_a_fall_after_the_end_is_that_on_the_slope():
    start, short = {"theta": ALPHA - 0.03}, rk.GroundMotion.none(0.05)
    for slope, outcome in ((0.05, "overturned"), (0.0, "completed"), (-0.05, "completed")):
        case = rk.Case(BLOCK, short, initial=start, slope=slope)
        assert rk.simulate(case).outcome == outcome
        assert set(rk.simulate_many(case, {"time_scale": [1.0] * 12}).outcome.values) == {outcome}


def test_a_slope_of_zero_changes_no_bit():
    for structure in (BLOCK, column(), stack()):
        runs = [rk.simulate(structure, SINE * 2.0, **how) for how in ({}, {"slope": "0 deg"})]
        assert runs[0].y.tobytes() == runs[1].y.tobytes()


def test_a_response_keeps_its_slope(tmp_path):
    how = {"vertical": UP, "slope": "1 in 20", "ground_axes": "world"}
    run = rk.simulate(column(), RECORD, **how)
    run.save(tmp_path / "run.nc")
    names = ["ground_acceleration", "left_reaction", "base_shear"]
    for again in (rk.load(tmp_path / "run.nc"), pickle.loads(pickle.dumps(run))):
        assert (again.slope, again.ground_axes) == (slope_angle("1 in 20"), "world")
        assert all(again[name].tobytes() == run[name].tobytes() for name in names)
    along, _ = turned(run.slope, RECORD.acceleration(run.t), UP.acceleration(run.t))
    assert run["ground_acceleration"] == pytest.approx(along)
    few = rk.simulate(column(), RECORD, keep="samples", **how).extremes("left_reaction")
    assert few.maximum == pytest.approx(run.extremes("left_reaction").maximum, rel=1e-9)


def test_a_slope_on_which_nothing_can_stand():
    run = rk.simulate(BLOCK, STILL, slope=0.3)
    assert (run.outcome, BLOCK.on_slope(0.3).overturning_angles[1]) == ("overturned", 0.0)
    assert "it cannot stand: it turns downhill about its edge" in run.summary()


FACADE = rk.Facade(thickness=2.0 * B, height=2.0 * H, mass=50.0)
STRAP = rk.Strap(at=(-B, H), to=(-2.0 * B, H), stiffness=1e6)


@pytest.mark.parametrize(
    ("structure", "slope", "hints"),
    [(HELD, 0.3, 1), (HELD, 0.2, 0), (replace(HELD, wall_gap=0.1), 0.2, 0), (FACADE, -0.2, 0),
     (replace(HELD, friction=0.1), 0.2, 1), (replace(HELD, friction=0.1, restraint=STRAP), 0.2, 0)],
)  # fmt: skip
def test_what_slides_or_turns_on_a_slope_is_told_and_what_is_held_is_not(structure, slope, hints):
    run = rk.simulate(structure, STILL, slope=slope)
    assert sum("it cannot stand" in hint for hint in run.hints) == hints
    slid = "x" in run.states and bool(run["x"][-1] > 1e-3)
    assert (run.outcome == "overturned" or slid) == bool(hints)


@pytest.mark.parametrize(
    ("text", "angle"),
    [("5 deg", math.radians(5)), ("-5degrees", -math.radians(5)), ("0.1 rad", 0.1),
     ("1 in 20", math.atan(0.05)), ("-1 in 20", -math.atan(0.05)), (0.2, 0.2)],
)  # fmt: skip
def test_slopes_as_texts(text, angle):
    assert slope_angle(text) == pytest.approx(angle, rel=1e-15)


@pytest.mark.parametrize("slope", ["5", "5 %", "1 in 0", "flat", 2.0, "95 deg", math.nan])
def test_slopes_that_are_none(slope):
    assert refused(rk.Case, BLOCK, STILL, slope=slope)[0] == "slope"


def test_what_a_slope_does_not_know_is_refused_by_name():
    pulse = rk.GroundMotion.mavroeidis_papageorgiou(1.0, 0.5, 2.0, 0.0)
    assert "resampled" in told(rk.simulate, BLOCK, pulse, slope=0.1)
    level = {"vertical": RECORD, "slope": 0.1, "ground_axes": "world"}
    assert "resampled" in told(rk.simulate, BLOCK, SINE, **level)
    page = rk.explorer(rk.Case(BLOCK, SINE, slope=0.1), {"half_width": (0.1, 0.2)})
    assert "level ground" in told(lambda: page.html)
    assert refused(rk.Case, BLOCK, SINE, ground_axes="upright")[0] == "ground_axes"


def surface(figure: Figure) -> float:
    """The slope of the ground's surface as drawn [rad], positive where it falls to the right."""
    ax = figure.axes[0]
    ground = next(x for x in ax.lines if len(x.get_ydata()) == 2 and not np.ptp(x.get_ydata()))
    ends = (ground.get_transform() - ax.transData).transform(ground.get_xydata())
    return -math.atan2(*np.diff(ends, axis=0)[0][::-1])


def test_pictures_are_drawn_on_the_slope():
    assert surface(draw_structure(BLOCK, slope="10 deg")) == pytest.approx(math.radians(10.0))
    run = rk.simulate(BLOCK, SINE, slope="10 deg", initial={"theta": 0.02})
    figure = Figure()
    animate(run, end=0.2).draw(0, figure.add_subplot())
    assert surface(figure) == pytest.approx(math.radians(10.0))
    assert "on a slope of 10 degrees" in run.plot().get_suptitle()
