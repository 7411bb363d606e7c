"""simulate_many with lanes: exact rocking, the scalar loop's results, bits that nothing changes."""

import importlib
import math
from threading import Event
from types import SimpleNamespace

import numpy as np
import pytest

import rockeom as rk
from rockeom.compiler.machine import Loaded, compiled
from rockeom.compiler.printer import Program as Printed
from rockeom.integrator.linking import GLUE, LOOP, VECTORS, linked
from rockeom.simulation.case import Problems
from rockeom.sweeps.cases import Batch
from rockeom.sweeps.results import Results
from rockeom.sweeps.run import lanes_pay
from tests.machine_code import plain as plain_functions
from tests.oracle.ways import flat
from tests.refusals import refused
from tests.sweeping import simulate_many
from tests.typical import S1, column, on_springs

STEP = rk.SolverOptions(steps_per_segment=1)


def record(n=1200, seed=1, dt=0.005):
    """Harmonics of random phases under an envelope, of peak 1 m/s2."""
    random = np.random.RandomState(seed)
    t = dt * np.arange(n)
    omega, phase = np.linspace(4.0, 30.0, 25), random.uniform(0.0, 2.0 * np.pi, 25)
    a = (np.sin(np.outer(t, omega) + phase) / np.sqrt(omega)).sum(axis=1)
    a *= np.sin(np.pi * t / t[-1]) ** 2
    return rk.GroundMotion.from_array(np.round(a / np.abs(a).max(), 6), dt)


RECORD = record().scaled(acceleration=4.0)
HEIGHTS, ANGLES = [0.25, 0.5, 1.0, 2.0, 4.0], [0.12, 0.16, 0.2, 0.24, 0.28, 0.32, 0.36]
OVER = {"height": HEIGHTS, "alpha": ANGLES}  # 35: no multiple of the lanes


def block(height, alpha):
    return rk.RigidBlock(half_width=height * math.tan(alpha), half_height=height)


def sprung(width=0.285, stiffness=5e5, damping=2e3):
    """On springs and dampers that only press: in each step a foot may lift or land."""
    return on_springs(half_width=width, foundation_stiffness=stiffness, foundation_damping=damping)


def many(case, over, options=STEP, **others):
    return simulate_many(case, over, options=options, lanes=True, impact_times=40, **others)


def both_ways(case, over, options=STEP):
    scalar = rk.simulate_many(
        case, over, options=options, impact_times=40, sweep_options=rk.SweepOptions(lanes=False)
    )
    return many(case, over, options), scalar


def assert_same(lanes, scalar, apart, final=1.0):
    """The same course of events; times and extremes differ by rounding, and by what it grew to."""
    for name in ("outcome", "final_mode", "impacts"):
        np.testing.assert_array_equal(lanes[name], scalar[name])
    np.testing.assert_allclose(lanes.impact_time, scalar.impact_time, rtol=0, atol=apart)
    np.testing.assert_allclose(lanes.final_time, scalar.final_time, rtol=0, atol=apart)
    for name in ("minimum", "maximum", "final"):
        size = np.abs(scalar[name]).max()
        np.testing.assert_allclose(lanes[name], scalar[name], rtol=0, atol=final * apart * size)


def reversed_(dataset, over):
    return dataset.isel({name: slice(None, None, -1) for name in over})


@pytest.fixture(scope="module")
def blocks():
    return many(lambda height, alpha: rk.Case(block(height, alpha), RECORD), OVER)


# -- against exact solutions ---------------------------------------------------------------------


def test_free_rocking_of_the_slender_block():
    """Impact times of the linear equation, in inverse hyperbolic cosines (Housner, 1963)."""
    p, alpha, ratio = 2.0, 0.2, 0.93
    slender = rk.SlenderBlock.from_frequency(p=p, alpha=alpha)
    quiet = rk.GroundMotion.from_array(np.zeros(8001), 0.005)
    starts = np.linspace(0.1, 0.95, 21)
    found = many(
        lambda start: rk.Case(
            slender, quiet, impact=rk.VelocityRatio(ratio), initial={"theta": start * alpha}
        ),
        {"start": starts},
    )
    phi, time = starts.copy(), np.zeros(len(starts))
    for n in range(8):
        quarter = np.arccosh(1.0 / (1.0 - phi)) / p
        time += quarter if n == 0 else 2.0 * quarter
        np.testing.assert_allclose(found.impact_time[:, n], time, rtol=1e-13)
        phi = 1.0 - np.sqrt(1.0 - ratio**2 * (1.0 - (1.0 - phi) ** 2))
    assert set(found.outcome.values.tolist()) == {"came to rest"}


def test_uplift_where_the_ground_exceeds_g_tan_alpha():
    """Ground acceleration rises in straight lines; a block stays until it is g tan(alpha)."""
    limit = 9.81 * math.tan(0.2)
    ramp = rk.GroundMotion.from_array(limit * np.linspace(0.0, 2.0, 41), 0.05)
    found = many(
        lambda duration: rk.Case(block(0.5, 0.2), ramp, duration=duration),
        {"duration": [0.4, 0.99, 1.0 - 1e-9, 1.001, 1.1, 1.5]},
    )
    np.testing.assert_array_equal(found.final_mode, ["both"] * 3 + ["left"] * 3)
    assert (found.final.values[:3] == 0.0).all()
    # just after, the rotation is that of a moment that grows in proportion to time
    rock = block(0.5, 0.2)
    growth = rock.frequency_parameter**2 * limit * math.cos(0.2) / 9.81
    np.testing.assert_allclose(found.final.values[3, 0], -growth * 1e-9 / 6.0, rtol=1e-3)


# -- against the scalar loop ---------------------------------------------------------------------


def test_blocks_as_one_by_one(blocks):
    one_by_one = rk.simulate_many(
        lambda height, alpha: rk.Case(block(height, alpha), RECORD),
        OVER,
        options=STEP,
        impact_times=40,
        sweep_options=rk.SweepOptions(lanes=False),
    )
    outcomes = set(blocks.outcome.values.ravel().tolist())
    assert {"overturned", "came to rest"} <= outcomes
    assert blocks.impacts.values.max() > 100
    assert_same(blocks, one_by_one, 1e-9)


def test_amplitudes_up_to_overturning():
    tall = block(1.0, 0.2)
    over = {"times": np.linspace(0.2, 3.0, 29)}
    lanes, scalar = both_ways(lambda times: rk.Case(tall, RECORD.scaled(times)), over)
    fell = lanes.outcome == "overturned"
    assert 3 < fell.sum() < 26
    assert (lanes.final_time.values[fell] < 6.0).any()  # not only behind the record
    assert_same(lanes, scalar, 1e-8)


@pytest.mark.parametrize(
    "impact",
    [rk.AngularMomentum(), rk.Impulsive(), rk.VelocityRatio(0.8)],
    ids=lambda law: type(law).__name__,
)
def test_flexible_structures(impact):
    """They vibrate on both feet, and rock; the impulsive law may end rocking at once."""
    over = {"half_width": [0.2, 0.25, 0.285], "stiffness": [2e5, 5.718e5, 1e6]}
    lanes, scalar = both_ways(
        lambda half_width, stiffness: rk.Case(
            column(half_width=half_width, stiffness=stiffness), RECORD, impact=impact
        ),
        over,
    )
    assert (lanes.impacts > 10).any()
    np.testing.assert_array_equal(lanes.outcome, scalar.outcome)
    # in the first impacts nothing has grown
    np.testing.assert_allclose(
        lanes.impact_time[..., :15], scalar.impact_time[..., :15], rtol=0, atol=1e-9
    )
    np.testing.assert_allclose(lanes.maximum, scalar.maximum, rtol=1e-6)


def test_every_argument_of_a_case():
    """Vertical record, durations on both sides of the record's, start, mode and law."""
    full = {
        "impact": rk.VelocityRatio(0.85),
        "initial": {"theta": 0.05, "theta_dot": 0.1},
        "duration": 3.0025,
        "vertical": record(seed=2, dt=0.007).scaled(acceleration=2.0),
        "mode": "right",
    }
    cases = {"all": full, "longer": full | {"duration": 8.0}, "longest": full | {"duration": 20.0}}
    cases |= {f"no {key}": {k: v for k, v in full.items() if k != key} for key in full}
    weak = RECORD.scaled(0.6)
    lanes, scalar = both_ways(
        lambda which: rk.Case(block(0.6, 0.2), weak, **cases[which]), {"which": list(cases)}
    )
    assert_same(lanes, scalar, 1e-9)
    # each argument but the mode, which the state tells, has changed something
    parts = (lanes.final_time.values[:, None], lanes.final.values, lanes.impact_time.values)
    assert len({row.tobytes() for row in np.hstack(parts)}) == len(cases) - 1


@pytest.mark.parametrize(
    "options",
    [
        rk.SolverOptions(steps_per_segment=3),
        rk.SolverOptions(steps_per_segment=1, max_step=0.002),
        rk.SolverOptions(steps_per_segment=2, method="RK45"),
    ],
    ids=["three steps", "max_step", "RK45"],
)
def test_options_of_steps(options):
    """Behind an impact the scalar loop's steps begin anew; so only the method's error differs."""
    lanes, scalar = both_ways(
        lambda alpha: rk.Case(block(1.0, alpha), RECORD), {"alpha": ANGLES[1:]}, options
    )
    apart = 1e-4 if options.method == "RK45" else 1e-7
    np.testing.assert_array_equal(lanes.outcome, scalar.outcome)
    np.testing.assert_allclose(
        lanes.impact_time[..., :8], scalar.impact_time[..., :8], rtol=0, atol=apart
    )


MOTIONS = {
    "sine": rk.GroundMotion.single_sine(3.0, period=0.6, duration=5.0),
    "cosine": rk.GroundMotion.single_cosine(2.6, period=0.8, duration=5.0),
    "harmonic": rk.GroundMotion.harmonic(2.4, frequency=1.3, duration=5.0, phase=0.4),
    "wavelet": rk.GroundMotion.ricker(3.0, 0.4, duration=5.0),
    "other wavelet": rk.GroundMotion.ricker(3.0, 0.5, duration=5.0, antisymmetric=True),
    "near-fault pulse": rk.GroundMotion.mavroeidis_papageorgiou(0.4, 0.8, 1.6, 0.3, duration=5.0),
    "record": record(n=900),
    "constant": rk.GroundMotion.constant(2.5, 0.4, 5.0),
}


@pytest.mark.parametrize("steps", [0, 40], ids=["controlled", "equal"])
@pytest.mark.parametrize(
    "make",
    [lambda x: block(0.6, x), lambda x: column(half_width=x + 0.07)],
    ids=["block", "column"],
)
def test_every_law_of_the_ground_and_both_ways_of_stepping(make, steps):
    """Horizontal and vertical motions of every kind, side by side in the lanes."""
    options = rk.SolverOptions(steps_per_segment=steps)
    over = {"motion": list(MOTIONS), "vertical": [None, "harmonic", "wavelet"], "x": [0.18, 0.22]}
    lanes, scalar = both_ways(
        lambda motion, vertical, x: rk.Case(
            make(x), MOTIONS[motion], vertical=None if vertical is None else MOTIONS[vertical]
        ),
        over,
        options,
    )
    assert (scalar.impacts > 10).sum() > 15
    np.testing.assert_array_equal(lanes.outcome, scalar.outcome)
    np.testing.assert_allclose(
        lanes.impact_time[..., :6], scalar.impact_time[..., :6], rtol=1e-9, atol=1e-9
    )
    for name in ("minimum", "maximum"):
        np.testing.assert_allclose(lanes[name], scalar[name], rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("steps", [0, 2], ids=["controlled", "equal"])
def test_structures_on_springs(steps):
    """They change their mode where a spring presses no more; some fall, some fly."""
    motions = MOTIONS | {"strong": RECORD.scaled(1.2), "far": MOTIONS["sine"].scaled(2.2)}
    over = {"motion": list(motions), "width": [0.2, 0.26, 0.3], "damping": [0.0, 3e3]}

    def case(motion, width, damping):
        vertical = MOTIONS["harmonic"] if width == 0.26 else None
        return rk.Case(sprung(width, damping=damping), motions[motion], vertical=vertical)

    options = rk.SolverOptions(steps_per_segment=20 * steps if steps else 0)
    lanes, scalar = both_ways(case, over, options)
    np.testing.assert_array_equal(lanes.outcome, scalar.outcome)
    assert {"overturned", "completed"} <= set(lanes.outcome.values.ravel().tolist())
    stands = (scalar.outcome != "overturned").values
    np.testing.assert_array_equal(lanes.final_mode.values[stands], scalar.final_mode.values[stands])
    for name in ("minimum", "maximum", "final"):
        size = np.abs(scalar[name].values[stands]).max(axis=0)
        off = np.abs(lanes[name].values - scalar[name].values)[stands]
        assert (np.median(off, axis=0) < 1e-8 * size).all()
        assert (off < 1e-5 * size).all()
    backwards = many(case, {name: values[::-1] for name, values in over.items()}, options)
    assert lanes.identical(reversed_(backwards, over))


@pytest.mark.parametrize("steps", [0, 3], ids=["controlled", "equal"])
def test_blocks_that_rock_beyond_an_eighth_of_a_turn(steps):
    """Wide ones; lanes know no such angle, and the loop goes on with them at its own pace."""
    wide = {"alpha": [1.1, 1.3], "theta": [0.3, 0.7, 0.78, 0.79, 0.85]}
    options = rk.SolverOptions(steps_per_segment=steps, max_steps=3000)
    motion = record(n=800).scaled(3.0)
    lanes, scalar = both_ways(
        lambda alpha, theta: rk.Case(
            block(1.0, alpha), motion, impact=rk.VelocityRatio(0.95), initial={"theta": theta}
        ),
        wide,
        options,
    )
    assert (lanes.maximum.values[..., 0] > 0.8).any()
    assert (lanes.impacts > 1).all()
    assert "stalled" not in lanes.outcome.values
    np.testing.assert_array_equal(lanes.outcome, scalar.outcome)
    np.testing.assert_allclose(
        lanes.impact_time[..., :5], scalar.impact_time[..., :5], rtol=0, atol=1e-9
    )


def test_short_flights_that_end_beside_a_jump_of_the_ground():
    """A flight is taken for a parabola, whose end is corrected: beyond a jump it is another one."""
    random = np.random.RandomState(7)
    rows = np.zeros((80, 7))
    rows[:, 1] = np.cumsum(random.uniform(0.01, 0.05, 80))
    rows[1:, 0], rows[:, 3] = rows[:-1, 1], random.uniform(-0.6, 0.6, 80)
    rows[:, 4] = random.uniform(-40.0, 40.0, 80)
    jumps = rk.GroundMotion(rows)
    over = {"theta": np.geomspace(1e-4, 0.02, 600)}
    lanes, scalar = both_ways(
        lambda theta: rk.Case(block(0.5, 0.2), jumps, initial={"theta": theta}), over, None
    )
    assert (scalar.impacts > 10).sum() > 400
    np.testing.assert_allclose(
        lanes.impact_time[:, :12], scalar.impact_time[:, :12], rtol=1e-9, atol=1e-9
    )


def test_too_many_impacts_and_steps():
    quiet = rk.GroundMotion.from_array(np.zeros(2001), 0.005)
    over = {"theta": np.linspace(0.02, 0.15, 18)}

    def case(theta):
        return rk.Case(block(0.5, 0.2), quiet, initial={"theta": theta})

    few = many(case, over, rk.SolverOptions(steps_per_segment=1, max_impacts=5))
    assert set(few.outcome.values.tolist()) == {"too many impacts"}
    assert (few.impacts == 6).all()
    assert np.isfinite(few.impact_time.values).sum(axis=1).tolist() == [6] * 18
    np.testing.assert_array_equal(few.final_time, few.impact_time[:, 5])
    short = many(case, over, rk.SolverOptions(steps_per_segment=1, max_steps=40))
    assert set(short.outcome.values.tolist()) == {"stalled"}
    assert (short.final_time < 0.21).all()


# -- bits ----------------------------------------------------------------------------------------


def test_order_and_neighbours_change_no_bit(blocks):
    """Backwards, and one by one, each among others that have another record."""
    over = {name: values[::-1] for name, values in OVER.items()}
    backwards = many(lambda height, alpha: rk.Case(block(height, alpha), RECORD), over)
    assert blocks.identical(reversed_(backwards, over))
    other = record(n=700, seed=5, dt=0.01).scaled(acceleration=6.0)
    for height in HEIGHTS[::2]:
        for alpha in ANGLES[::3]:
            mixed = many(
                lambda place, height=height, alpha=alpha: rk.Case(
                    block(height, alpha) if place == 2 else block(0.3 + 0.1 * place, 0.2),
                    RECORD if place == 2 else other,
                ),
                {"place": range(5)},
            )
            alone = blocks.sel(height=height, alpha=alpha)
            for name in ("outcome", "impacts", "final_time", "maximum", "minimum", "final"):
                np.testing.assert_array_equal(mixed[name][2], alone[name])
            np.testing.assert_array_equal(mixed.impact_time[2], alone.impact_time)


def test_order_of_flexible_structures_changes_no_bit():
    over = {"half_width": np.linspace(0.2, 0.3, 19)}
    forwards = many(lambda half_width: rk.Case(column(half_width=half_width), RECORD), over)
    over = {"half_width": over["half_width"][::-1]}
    backwards = many(lambda half_width: rk.Case(column(half_width=half_width), RECORD), over)
    assert forwards.identical(reversed_(backwards, over))


@pytest.mark.parametrize("make", [lambda x: block(1.0, x), lambda x: column(half_width=x + 0.1)],
                         ids=["block", "flexible"])  # fmt: skip
def test_mirror_changes_no_bit(make):
    found = many(
        lambda value, sign: rk.Case(make(value), RECORD.scaled(sign)),
        {"value": np.linspace(0.12, 0.3, 9), "sign": [1.0, -1.0]},
    )
    right, left = found.sel(sign=1.0), found.sel(sign=-1.0)
    assert (right.impacts > 10).any()
    for name in ("outcome", "impacts", "final_time", "impact_time"):
        np.testing.assert_array_equal(right[name], left[name])
    np.testing.assert_array_equal(right.maximum, -left.minimum)
    np.testing.assert_array_equal(right.minimum, -left.maximum)
    np.testing.assert_array_equal(right.final, -left.final)


class Called:
    """A function of Python that is bound to its arguments as those of machine code are."""

    def __init__(self, function):
        self.function = function

    def __call__(self, *given):
        return self.function(*given)

    def bound(self, *given):
        return Bound(self.function, list(given))


class Bound:
    def __init__(self, function, given):
        self.function, self.given = function, given

    def __setitem__(self, name, value):
        assert name == "first"
        self.given[0] = value

    def __call__(self):
        return self.function(*self.given)


WAVELET = rk.GroundMotion.ricker(3.0, 0.3, duration=1.5)
STARTS = {
    "block": [
        rk.Case(block(0.5, 0.2), motion, vertical=vertical, initial={"theta": theta})
        for motion, vertical, theta in (
            (rk.GroundMotion.single_sine(6.0, period=0.8, duration=1.5), None, 0.0),
            (WAVELET, rk.GroundMotion.harmonic(2.0, frequency=2.0, duration=1.5), 0.05),
            (rk.GroundMotion.none(1.0), None, -0.03),
        )
    ],
    "springs": [  # each foot has lifted and landed by 0.95 s
        rk.Case(sprung(), WAVELET, duration=1.0),
        rk.Case(sprung(), MOTIONS["sine"], duration=0.3),
    ],
}


@pytest.mark.parametrize("which", STARTS)
def test_vectors_have_the_bits_of_plain_python(which):
    """Machine code that rounds every operation by itself, and the same texts run by Python."""
    module = STARTS[which][0].structure.module
    problems = [case.problem() for case in STARTS[which]]
    codes, entries, spaces = [], {}, {}
    for part in (LOOP, VECTORS, GLUE):
        roots, modules, _ = linked(module, "RK45", part)
        printed = Printed(roots, modules, contract=False)
        codes.append(compiled(printed.ir(), part == VECTORS))
        entries |= printed.entries
        spaces[part] = plain_functions(module, "RK45", part)
        if part == GLUE:  # each part calls the others' entries
            of_vectors = [name for name in entries if name.endswith("_lanes")]
            spaces[GLUE] |= {n: spaces[VECTORS][n] for n in of_vectors if n != "integrate_lanes"}
    plain = spaces[GLUE]
    found = []
    names = ("integrate_lanes", "integrate_many")
    of_python = {name: flat(plain[name]) for name in names}
    for functions in (Loaded(codes[0], entries, *codes[1:]).functions, of_python):
        sizes = {name: plain[name] for name in ("Z_SIZE", "W_SIZE")}
        calls = {name: Called(functions[name]) for name in names}
        part = Batch(np.arange(len(problems)), Problems.of(problems), [])
        results = Results.empty(len(problems), module.N_STATES, 20)
        with np.errstate(all="ignore"):
            solver = rk.SolverOptions(rtol=1e-7)
            results.integrate(part, SimpleNamespace(**calls, **sizes), solver, Event(), True)
        found.append(results)
    by_vectors, by_python = found
    assert np.isfinite(by_vectors.final).all()
    assert (by_vectors.peaks[:, 1] > 0.0).any()
    assert which != "block" or by_vectors.impacts.max() > 5
    for name in ("outcome", "impacts", "times", "peaks", "final", "final_time"):
        np.testing.assert_array_equal(getattr(by_vectors, name), getattr(by_python, name))


# -- where lanes serve, and what they refuse -----------------------------------------------------


def test_lanes_serve_where_they_are_not_asked_for():
    """By structure and method alone: one case has the bits that it has among many."""
    starts = np.linspace(0.02, 0.15, 20)

    def case(theta):
        return rk.Case(block(0.5, 0.2), MOTIONS["sine"], initial={"theta": theta})

    by_default = rk.simulate_many(case, {"theta": starts}, impact_times=40)
    assert by_default.identical(many(case, {"theta": starts}, None))
    one = rk.simulate_many(case, {"theta": starts[7:8]}, impact_times=40)
    for name in by_default.data_vars:
        np.testing.assert_array_equal(one[name][0], by_default[name][7])
    run = rk.simulate(block(0.5, 0.2), MOTIONS["sine"], initial={"theta": starts[7]})
    by_itself = rk.simulate_many(
        case, {"theta": starts[7:8]}, sweep_options=rk.SweepOptions(lanes=False)
    )
    assert by_itself.final.values[0].tolist() == [*run.final.values()]


def test_structures_whose_contact_changes_too_often_are_refused():
    cart = rk.TwoSpringCart(**S1, foundation_stiffness=1e6)
    assert refused(many, lambda n: rk.Case(cart, RECORD), {"n": [1]}) == ("lanes", True)
    assert {name for name in rk.models() if not lanes_pay(module_of(name))} == {
        "controlled_wall", "controlled_wall_oscillator", "dirac_delta_block",
        "flexible_controlled_wall", "simplified_substitute_gravity_wall", "sliding_block",
        "stacked_blocks", "substitute_gravity_wall", "two_spring_cart",
    }  # fmt: skip


def module_of(name):
    return importlib.import_module(f"rockeom.generated.{name}")
