"""Cases made at once: the bits of one by one, for every structure, motion, start and law."""

import dataclasses
import math
import operator
import re
import time

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.numbers.batch import Differs, Many
from rockeom.numbers.functions import mathematics
from rockeom.simulation.case import Case, Problems
from rockeom.structures.classes import SHIPPED
from rockeom.sweeps.cases import Cases, Source
from tests.interrupts import interrupted_at
from tests.shipped import plain
from tests.sweeping import one_by_one
from tests.typical import S1

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
RECORD = rk.GroundMotion.from_array(np.sin(0.3 * np.arange(60.0)), dt=0.02)
STILL = rk.GroundMotion.none(3.0)
sine = rk.GroundMotion.single_sine


def source(case, over, arrays=True, chunk=10**6):
    values = {name: list(v) for name, v in over.items()}
    first = case(**{name: v[0] for name, v in values.items()})
    return Source(case, Cases(values), chunk, first.structure.module, arrays)


def in_bits(problems: Problems):
    """What each case is given to the compiled loop, in bytes; tables without those of others."""
    tables = {"horizontal": "h_rows", "transverse": "t_rows", "vertical": "v_rows"}
    found = []
    for i in range(len(problems.end)):
        row = []
        for name, values in problems._asdict().items():
            if name in tables:
                first, last = getattr(problems, tables[name])[i]
                row.append(values[first:last].tobytes())
            elif name not in tables.values():
                row.append((values.dtype.str, values[i].tobytes()))
        found.append(row)
    return found


def assert_same_bits(case, over, at_once=True):
    """at_once : whether so many go the same way that none need be made by itself."""
    parts = list(source(case, over))
    rows = np.concatenate([part.rows for part in parts])
    (alone,) = source(case, over, arrays=False)
    assert sorted(rows.tolist()) == alone.rows.tolist()
    expected = in_bits(alone.problems)
    for part in parts:
        assert in_bits(part.problems) == [expected[row] for row in part.rows]
    if at_once:
        assert not any(part.cases for part in parts)


def spaced(low, high, n, seed=0):
    """n numbers with all their digits."""
    return np.sort(np.random.default_rng(seed).uniform(low, high, n))


# -- structures

WALL = rk.ControlledWall.thesis().parameters()
FLEXIBLE_WALL = rk.FlexibleControlledWall.thesis().parameters()
GRAVITY_WALL = rk.SubstituteGravityWall.thesis().parameters()
OSCILLATOR = {
    field.name: getattr(rk.ControlledWallOscillator.thesis(0.85), field.name)
    for field in dataclasses.fields(rk.ControlledWallOscillator)
}
SPRINGS = {"foundation_stiffness": 550e3}
STRUCTURES = {
    "rigid_block": lambda x: rk.RigidBlock(half_width=0.1 * x, half_height=0.4),
    "of inertia": lambda x: rk.RigidBlock(
        half_width=0.1, half_height=0.4, mass=x, inertia=0.05 * x
    ),
    "of frequency": lambda x: rk.RigidBlock.from_frequency(p=2.0 * x, alpha=0.2 * x),
    "slender_block": lambda x: rk.SlenderBlock.from_frequency(p=2.0 * x, alpha=0.2 / x),
    "nondimensional_block": lambda x: rk.NondimensionalBlock(alpha=0.2 * x),
    "dirac_delta_block": lambda x: rk.DiracDeltaBlock(
        alpha=0.2, energy_ratio=x / 2, regularisation=1e-2 * x
    ),
    "lumped_mass_structure": lambda x: rk.LumpedMassStructure(**S1 | {"base_mass": 40.0 * x}),
    "two_spring_structure": lambda x: rk.TwoSpringStructure(
        **S1 | SPRINGS, foundation_damping=1e3 * x
    ),
    "two_spring_cart": lambda x: rk.TwoSpringCart(**S1 | {"foundation_stiffness": 5e5 * x}),
    "uplifting_oscillator": lambda x: rk.UpliftingOscillator.from_frequency(20 * x, 0.02, 1.0, 0.3),
    "flexible_structure": lambda x: rk.FlexibleStructure(**S1, stiffness=5e5 * x, damping=500.0),
    "controlled_wall": lambda x: rk.ControlledWall(**WALL | {"mass": WALL["mass"] * x}),
    "flexible_controlled_wall": lambda x: rk.FlexibleControlledWall(
        **FLEXIBLE_WALL | {"stiffness": FLEXIBLE_WALL["stiffness"] * x}
    ),
    "substitute_gravity_wall": lambda x: rk.SubstituteGravityWall(
        **GRAVITY_WALL | {"initial_force": 50e3 * x}
    ),
    "simplified_substitute_gravity_wall": lambda x: rk.SimplifiedSubstituteGravityWall(
        **GRAVITY_WALL | {"height": 2.0 * x}
    ),
    "controlled_wall_oscillator": lambda x: rk.structure(
        "controlled_wall_oscillator", **OSCILLATOR | {"regularisation": 1e-3 * x}
    ),
}


def scaled(name, x):
    """A shipped structure with all its parameters times x, but for whole numbers."""
    return rk.structure(
        name,
        **{n: 2 if n == "columns" else value * x for n, value in plain(name).items()},
    )


KNOWN = {make(1.0).model for make in STRUCTURES.values()}
ON_POINTS = {"sliding_block", "stacked_blocks"}  # whose modes are searched one by one
for model in SHIPPED:
    if model not in KNOWN | ON_POINTS:
        STRUCTURES[model] = lambda x, name=model: scaled(name, x)


@pytest.mark.parametrize("name", STRUCTURES)
def test_structures_at_rest_and_released(name):
    """Parameters, ratio of an impact, bound of the rotation, mode at the start."""
    make = STRUCTURES[name]
    structure = make(1.0)
    first = structure.states[structure.module.ROTATION]
    size = 0.1 * structure.overturning_rotation
    over = {"x": spaced(0.6, 1.4, 12), "a": spaced(0.3, 2.0, 3)}
    assert_same_bits(lambda x, a: Case(make(x), sine(-a, 0.5, duration=1.0)), over)
    assert_same_bits(lambda x, a: Case(make(x), sine(a, 0.5), vertical=sine(a, 0.3)), over)
    for side in (-1.0, 1.0):
        assert_same_bits(
            lambda x, a, s=side: Case(make(x), STILL, initial={first: s * a * size}),
            over,
            at_once=False,
        )


def test_thousands_of_blocks():
    """So many that one in a thousand that is rounded otherwise is met."""

    def case(size, slenderness):
        block = rk.RigidBlock(half_width=size * slenderness, half_height=size, mass=300.0)
        return Case(block, sine(0.9 * size, 0.5 / slenderness))

    assert_same_bits(case, {"size": spaced(0.1, 2.0, 80), "slenderness": spaced(0.1, 0.5, 50)})


# -- motions, starts and laws

MOTIONS = {
    "half_sine": lambda a, t: rk.GroundMotion.half_sine(a, t),
    "single_sine": lambda a, t: sine(a, t, duration=4.0),
    "single_cosine": lambda a, t: rk.GroundMotion.single_cosine(a, t, duration=2.0 + t),
    "harmonic": lambda a, t: rk.GroundMotion.harmonic(a, duration=3.0, frequency=1 / t, phase=a),
    "by period": lambda a, t: rk.GroundMotion.harmonic(a, duration=10 * t, period=t),
    "ricker": lambda a, t: rk.GroundMotion.ricker(a, t),
    "near fault": lambda a, t: rk.GroundMotion.mavroeidis_papageorgiou(0.1 * a, t, 1.0 + t, a),
    "antisymmetric": lambda a, t: rk.GroundMotion.ricker(a, t, antisymmetric=True, duration=9.0),
    "constant": lambda a, t: rk.GroundMotion.constant(a, t, total_duration=3.0),
    "none": lambda a, t: rk.GroundMotion.none(t),
    "scaled": lambda a, t: sine(2.0, 0.5).scaled(acceleration=a, time=t),
    "mirrored": lambda a, t: -sine(a, t),
    "padded": lambda a, t: rk.GroundMotion.ricker(a, t).padded_by(1.0).scaled(1.0, t),
    "negative": lambda a, t: sine(-a, t),
}


@pytest.mark.parametrize("name", MOTIONS)
def test_motions(name):
    make = MOTIONS[name]
    over = {"a": spaced(0.5, 6.0, 20), "t": spaced(0.3, 1.5, 12)}
    assert_same_bits(lambda a, t: Case(BLOCK, make(a, t)), over)
    assert_same_bits(lambda a, t: Case(BLOCK, RECORD, vertical=make(a, t), duration=t), over)


def test_records_share_their_table_where_they_are_scaled_alike():
    """A record is scaled for each factor, not for each case."""
    calls = []

    def case(width, factor):
        calls.append(1)
        return Case(rk.RigidBlock(half_width=width, half_height=0.4), RECORD.scaled(factor))

    over = {"width": spaced(0.05, 0.15, 30), "factor": [0.5, 1.0, 2.0]}
    parts = list(source(case, over))
    assert len(parts) == 3
    assert all(len(part.problems.horizontal) == len(RECORD.segments) for part in parts)
    assert len(calls) <= 2 + 3 * (1 + 3)  # the first case, all at once, and of each part four
    assert_same_bits(case, over)
    # each by its own factor
    assert_same_bits(
        lambda factor: Case(BLOCK, RECORD.scaled_to(factor)),
        {"factor": spaced(1.0, 4.0, 300)},
        at_once=False,
    )


LAWS = {
    "energy": rk.EnergyRatio,
    "velocity": rk.VelocityRatio,
    "speed": lambda r: rk.EnergyRatioAtSpeed(((0.3, r, 0.1), (math.inf, r / 2, 0.0)), height=0.4),
    "height": lambda r: rk.EnergyRatioAtSpeed(((0.3, 0.8, 0.1), (math.inf, 0.7, 0.0)), height=r),
    "foot": lambda r: rk.EnergyRatio(left=r, right=0.9),
    "loss": lambda r: rk.EnergyLossAtSpeed(left=(0.0, r, 0.1), right=(r, 0.0, 0.0)),
    "none": lambda r: None,
    "impulsive": lambda r: rk.Impulsive(),
}


@pytest.mark.parametrize("name", LAWS)
def test_laws_of_impact(name):
    over = {"r": spaced(0.2, 0.8, 60), "mass": spaced(1.0, 9.0, 3)}

    def case(r, mass):
        block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=mass)
        return Case(block, STILL, LAWS[name](r), initial={"theta": 0.1 * r})

    assert_same_bits(case, over)


def test_starts_of_all_signs():
    """Each sign of the rotation, or of the rate where it is upright, is a way of its own."""
    over = {"theta": np.linspace(-0.2, 0.2, 31), "rate": np.linspace(-0.5, 0.5, 31)}
    assert over["theta"][15] == over["rate"][15] == 0.0

    def case(theta, rate):
        return Case(BLOCK, STILL, initial={"theta": theta, "theta_dot": rate}, duration=1 + theta)

    assert_same_bits(case, over, at_once=False)
    parts = list(source(case, over))
    assert sum(len(part.cases) for part in parts) == 1  # upright and at rest
    assert {int(part.problems.mode[0]) for part in parts} == {0, 1, 2}


# -- functions of the caller


def test_what_a_function_does_with_a_value():
    """Branches, numbers asked for one by one, whole numbers, words and motions."""
    motions = {"record": RECORD, "still": STILL}
    calls = []

    def case(n, x, word, motion):
        calls.append(1)
        width = (
            0.1 + 0.01 * math.sin(x) + 1e-3 * n**2 + 1e-4 * 2**n + 1e-4 * (n % 3) + 1e-4 * (x // 2)
        )
        if x > 1.3 and n != 2:
            width += 0.01
        start = {"theta": 0.05 * np.tan(width)} if x < 2.5 else {"theta": -0.01 * round(x)}
        law = rk.EnergyRatio([0.7, 0.8, 0.9][n % 3] if word == "given" else np.exp(-x))
        block = rk.RigidBlock(half_width=width, half_height=max(0.4, x / 5))
        return Case(block, motions[motion] if word == "given" else sine(x, 0.5), law, start)

    over = {
        "n": range(5), "x": np.linspace(1.0, 3.0, 12), "word": ["given", "other"],
        "motion": ["record", "still"],
    }  # fmt: skip
    assert_same_bits(case, over, at_once=False)
    # a motion itself, and no function that needs a number by itself
    motions, calls = [RECORD, STILL], []

    def other(x, motion):
        calls.append(1)
        return Case(rk.RigidBlock(half_width=0.1 * np.sqrt(x), half_height=0.4), motion)

    over = {"x": np.linspace(1.0, 3.0, 1000), "motion": motions}
    assert len(list(source(other, over))) == 2
    assert len(calls) <= 2 + 2 * (1 + 3)
    assert_same_bits(other, over)


def test_a_result_that_no_case_has_is_not_taken():
    """What cannot be told of many at once is asked of each: an array, a table of the caller's."""
    record = {0.5: RECORD, 1.0: RECORD.scaled(2.0), 1.5: -RECORD}

    def case(x, y):
        shaken = rk.GroundMotion.from_array(np.sin(np.linspace(0.0, 9.0 * y, 20)), dt=0.1)
        return Case(BLOCK, record[x], vertical=shaken)

    over = {"x": [0.5, 1.0, 1.5], "y": spaced(0.5, 2.0, 20)}
    assert_same_bits(case, over, at_once=False)

    def named(x):
        try:  # as a hasty caller writes it
            return Case(BLOCK, record[float(f"{x:.1f}")].scaled(1.0 / mathematics.log(x)))
        except Exception:
            return Case(BLOCK, STILL)

    assert_same_bits(named, {"x": [*np.repeat([0.5, 1.0, 1.5], 20)]}, at_once=False)
    assert_same_bits(named, {"x": [*np.linspace(-1.0, 1.0, 41)]}, at_once=False)


WRONG = {
    "negative": (lambda x: Case(rk.RigidBlock(half_width=x, half_height=0.4), STILL), "positive"),
    "fallen": (lambda x: Case(BLOCK, STILL, initial={"theta": 2.0 - 2 * x}), "lies on the ground"),
    "infinite": (lambda x: Case(BLOCK, sine(1.0, 1 / x)), "finite|division"),
    "no period": (lambda x: Case(BLOCK, sine(1.0, x)), "positive"),
    "too short": (lambda x: Case(BLOCK, sine(1.0, 1.0, duration=1.0 + x)), "longer"),
    "ratio": (
        lambda x: Case(BLOCK, STILL, rk.EnergyRatio(0.4 + x)),
        "EnergyRatio: r is",
    ),
    "state": (lambda x: Case(BLOCK, STILL, initial={"tehta": x}), "unknown state"),
    "mode": (lambda x: Case(BLOCK, STILL, initial={"theta": x}, mode="right"), "contradicts"),
    "model": (
        lambda x: Case(BLOCK if x > 0 else rk.NondimensionalBlock(alpha=0.2), STILL),
        "each model",
    ),
    "no case": (lambda x: Case(BLOCK, STILL) if x > 0 else None, "returned None"),
    "overflow": (lambda x: Case(BLOCK, sine(1e300 * (0.5 - x), 1.0).scaled(1e300)), "NaN or inf"),
    "own": (lambda x: {True: Case(BLOCK, STILL)}[x > -0.3], "False"),
}


@pytest.mark.parametrize("name", WRONG)
@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:overflow")
def test_error_is_that_of_the_case(name):
    """Its words, and which case it is: the same as if each were made by itself."""
    case, words = WRONG[name]
    over = {"x": np.linspace(0.5, -0.5, 41), "copy": range(2)}
    told = []
    for arrays in (False, True):
        with pytest.raises(Exception, match=words) as caught:
            list(source(lambda x, copy: case(x), over, arrays, chunk=30))
        told.append((caught.type, str(caught.value), *getattr(caught.value, "__notes__", [])))
    assert told[0] == told[1]
    assert re.search(r"case x = [-.\d]+, copy = 0", " ".join(told[0][1:]))


# -- whole sweeps


def shaken(frequency, amplitude):
    return Case(BLOCK, sine(2.4 * amplitude, 1 / frequency, duration=6.0), rk.VelocityRatio(0.9))


OVER = {"frequency": spaced(0.4, 2.5, 11), "amplitude": [*spaced(0.8, 6.0, 6), 1, 2]}


@settings(max_examples=10)
@given(threads=st.integers(1, 3), chunk=st.one_of(st.none(), st.integers(1, 100)))
def test_dataset_is_that_of_one_by_one(threads, chunk):
    how = rk.SweepOptions(threads=threads, chunk=chunk)
    at_once = rk.simulate_many(shaken, OVER, impact_times=5, sweep_options=how)
    assert at_once.identical(rk.simulate_many(one_by_one(shaken), OVER, impact_times=5))


def test_quantities_are_asked_of_each_case():
    over = {"frequency": OVER["frequency"][:4], "amplitude": OVER["amplitude"][2:6]}
    asked = {"quantities": ["displacement"], "times": [0.5]}
    found = rk.simulate_many(shaken, over, **asked)
    assert found.outcome.identical(rk.simulate_many(shaken, over).outcome)
    single = shaken(over["frequency"][1], over["amplitude"][2])
    response = rk.simulate(single.structure, single.motion, impact=single.impact)
    assert found.peak_quantity[1, 2, 0] == abs(response.extremes("displacement").peak)


SLIDES = rk.SlidingBlock(half_width=0.2, half_height=0.6, friction=0.4, restitution=0.3)
PIER = rk.FlexibleStructure(**S1, stiffness=571.8e3, damping=502.4)


@pytest.mark.parametrize("lanes", [None, False])
@pytest.mark.parametrize("structure", [SLIDES, PIER], ids=lambda structure: structure.model)
def test_peaks_beside_impacts_are_those_of_the_motion(structure, lanes):
    """No step may begin or end with the velocities just after an impact but the next one."""
    case = Case(structure, sine(4.0, 0.5, duration=3.0))
    how = rk.SweepOptions(progress=False, lanes=lanes)
    table = rk.simulate_many(case, {"scale": [0.8, 1.0, 1.2]}, sweep_options=how)
    for i, scale in enumerate((0.8, 1.0, 1.2)):
        run = rk.simulate(structure, case.motion.scaled(acceleration=scale))
        peaks = [abs(run.extremes(name).peak) for name in run.states]
        np.testing.assert_allclose(table.peak.values[i], peaks, rtol=1e-6, atol=1e-12)


def test_lanes_take_cases_made_at_once():
    over = {"size": spaced(0.3, 2.0, 9), "slenderness": spaced(0.12, 0.3, 3)}

    def case(size, slenderness):
        block = rk.RigidBlock(half_width=size * slenderness, half_height=size)
        return Case(block, RECORD.scaled(5.0))

    how = {
        "options": rk.SolverOptions(steps_per_segment=1), "impact_times": 5,
        "sweep_options": rk.SweepOptions(lanes=True),
    }  # fmt: skip
    at_once = rk.simulate_many(case, over, **how)
    assert at_once.identical(rk.simulate_many(one_by_one(case), over, **how))


def test_interrupt_of_a_sweep_of_arrays():
    # the first case; then of each 22 all at once and three alone
    interrupted = interrupted_at(1 + 2 * (1 + 3) + 1, shaken)
    how = rk.SweepOptions(chunk=22, threads=1)
    found = rk.simulate_many(interrupted, OVER, sweep_options=how)
    assert found.attrs["interrupted"] == 1
    assert int((found.outcome != "not run").sum()) == 44


# -- functions that are no functions of their arguments alone

TALL = {"amplitude": spaced(1.0, 6.0, 60)}


def pulsed(amplitude):
    return Case(BLOCK, sine(amplitude, 0.8, duration=3.0))


def test_a_function_that_draws_at_random_is_called_for_each_case():
    def drawn(rng, calls):
        def case(amplitude):
            calls.append(type(amplitude))
            return pulsed(amplitude * rng.uniform(0.9, 1.1))

        return case

    calls = []
    rk.simulate_many(drawn(np.random.default_rng(1), calls), TALL)
    assert calls.count(Many) == 1
    assert len(calls) >= 60
    # a function that looks at the type of a number
    typed = lambda amplitude: pulsed(2.0 if isinstance(amplitude, Many) else amplitude)  # noqa: E731
    found = rk.simulate_many(typed, TALL)
    assert found.identical(rk.simulate_many(one_by_one(pulsed), TALL))


def test_most_cases_alone_and_all_are():
    """A function that asks for single numbers is not tried again and again."""
    calls = []

    def case(amplitude):
        calls.append(amplitude)
        return pulsed(float(amplitude))

    over = {"amplitude": spaced(1.0, 6.0, 300)}
    assert len(list(source(case, over, chunk=50))) == 6
    assert sum(type(x) is Many for x in calls) == 1


def test_branches_within_the_values():
    def case(amplitude):
        return pulsed(amplitude if amplitude < 2.0 or amplitude > 2.3 else 0.5 * amplitude)

    assert_same_bits(case, {"amplitude": spaced(1.0, 6.0, 400)}, at_once=False)


def test_cases_cost_little_when_they_are_made_at_once():
    """Against one by one, in time of the processor, the least of some turns."""

    def blocks(size, amplitude):
        return Case(rk.RigidBlock(half_width=0.2 * size, half_height=size), sine(amplitude, 0.5))

    over = {"size": spaced(0.2, 2.0, 100), "amplitude": spaced(1.0, 3.0, 100)}
    few = {"size": over["size"][:10], "amplitude": over["amplitude"][:10]}

    def cost(over, arrays):
        started = time.process_time()
        n = sum(len(part.rows) for part in source(blocks, over, arrays, chunk=2048))
        return (time.process_time() - started) / n

    turns = [(cost(over, True), cost(few, False)) for _ in range(5)]
    at_once, alone = np.min(turns, axis=0)
    assert at_once < alone / 10


# -- many numbers as one

NUMBERS = st.floats(-50.0, 50.0).filter(lambda x: x == 0.0 or abs(x) > 1e-3)
BINARY = [
    operator.add, operator.sub, operator.mul, operator.truediv, operator.floordiv, operator.mod,
    operator.pow, operator.lt, operator.le, operator.eq, operator.ne, operator.ge, operator.gt,
    np.maximum, np.minimum, np.hypot, np.arctan2, mathematics.hypot, mathematics.atan2, max,
]  # fmt: skip
UNARY = [
    operator.neg, operator.abs, operator.pos, np.sin, np.cos, np.tan, np.sqrt, np.exp, np.cbrt,
    np.deg2rad, np.sign, mathematics.sin, mathematics.cos, mathematics.exp, mathematics.sqrt,
    mathematics.floor, lambda x: x**2, lambda x: x**3, lambda x: x**-2, lambda x: 2**x,
    lambda x: x**0.5, lambda x: 1.5 * x + np.float64(2.0) / x - x % 3, bool, float, round, hash,
    lambda x: f"{x:.3g}", lambda x: 1.0 if x > 0.0 else -x, math.sin,
    lambda x: [*"abc"][int(x) % 3],
]  # fmt: skip


def outcome(function, point):
    """A number or a truth in Python, told apart to the last bit; or what is raised."""
    try:
        x = function(*point)
    except Exception as error:
        return type(error)
    x = x.item() if isinstance(x, np.generic) else x
    if isinstance(x, complex):  # of Python's numbers; of NumPy's it is none
        return "nan"
    return x.hex() if isinstance(x, float) else x


def each(function, n, *columns):
    """What a function makes of many: those that go one way together, until all are done."""
    found, waiting = [None] * n, [np.arange(n)]
    while waiting:
        rows = waiting.pop()
        points = [[c[row] if isinstance(c, np.ndarray) else c for c in columns] for row in rows]
        parts = [rows]
        try:
            if len(rows) > 1:
                with np.errstate(divide="raise", over="raise", invalid="raise"):
                    made = function(
                        *(Many(c[rows]) if isinstance(c, np.ndarray) else c for c in columns)
                    )
                points = [
                    [made.values[i] if isinstance(made, Many) else made] for i in range(len(rows))
                ]
                for row, point in zip(rows, points, strict=True):
                    found[row] = outcome(lambda x: x, point)
                continue
        except Differs as ways:
            parts = [rows[part] for part in ways.parts]
        except Exception:  # of one of them
            parts = [rows[i : i + 1] for i in range(len(rows))]
        if len(parts) > 1:
            assert sorted(np.concatenate(parts).tolist()) == rows.tolist()
            waiting += parts
        else:
            (found[rows[0]],) = (outcome(function, point) for point in points)
    return found


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@settings(max_examples=200)
@given(
    data=st.data(),
    numbers=st.lists(NUMBERS, min_size=1, max_size=6),
    whole=st.booleans(),
)
def test_many_numbers_calculate_as_each_of_them(data, numbers, whole):
    column = Many.of([int(x) for x in numbers] if whole else numbers).values
    function = data.draw(st.sampled_from(BINARY + UNARY))
    ways = [[column]]
    if function in BINARY:
        other = np.array(data.draw(st.lists(NUMBERS, min_size=len(column), max_size=len(column))))
        ways = [[column, other], [other, column], [column, other[0]], [other[0], column]]
    for columns in ways:
        points = [
            [c[i] if isinstance(c, np.ndarray) else c for c in columns] for i in range(len(column))
        ]
        expected = [outcome(function, point) for point in points]
        assert each(function, len(points), *columns) == expected


# -- how many at a time


@pytest.mark.parametrize(("pause", "sizes"), [(0.0, {256, 2048}), (0.2, {256})])
def test_only_cases_that_run_fast_are_run_by_thousands(pause, sizes):
    """Whoever waits, interrupts or is killed loses little."""
    many = Source(pulsed, Cases({"amplitude": spaced(1.0, 6.0, 5000)}), None, BLOCK.module, True)
    found = []
    for part in many:
        found.append(len(part.rows))
        time.sleep(pause)
        if len(found) == 3:
            break
    assert found[0] == 256
    assert {*found} == sizes
