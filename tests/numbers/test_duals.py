"""Duals through structures, laws of impact, ground motions and starts: the bits, the derivatives.

Derivatives are compared with differences of the same numbers found without any dual.
"""

import math
import operator

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.numbers.dual import nominal
from rockeom.numbers.functions import FUNCTIONS, mathematics
from rockeom.simulation.case import Case, parted
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain

BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)
EL_CENTRO = np.sin(np.arange(80.0)) * np.arange(80.0)  # longer than what is gone through by rows

sizes = st.floats(0.3, 3.0)


def in_numbers(problem):
    """The numbers of a problem, by name."""
    shown = problem._asdict() | {"p": problem.p()}
    return {name: np.asarray(value, dtype=float) for name, value in shown.items()}


def assert_carried(of, values, rtol=1e-6):
    """`of` makes a problem of numbers by name: its bits and derivatives are carried by duals."""
    problem, along = parted(of(**rk.duals(**values)))
    alone = in_numbers(of(**values))
    for name, value in in_numbers(problem).items():
        assert value.tobytes() == alone[name].tobytes(), name
    for j, (name, value) in enumerate(values.items()):
        h = 1e-5 * max(abs(value), 0.1)
        sides = [in_numbers(of(**(values | {name: value + step}))) for step in (h, -h)]
        for field, found in along._asdict().items():
            there, back = (side[field] for side in sides)
            with np.errstate(invalid="ignore"):  # a limit of speeds is infinite
                expected = (there - back) / (2.0 * h)
            known = np.isfinite(expected)
            size = np.abs(alone[field][known]).max(initial=1.0)
            np.testing.assert_allclose(
                found[..., j][known], expected[known], rtol, 100 * rtol * size, err_msg=field
            )


def assert_structure_carried(name, start):
    whole = {p for p, sign in signs(name).items() if sign == "n"}
    given = {n: value for n, value in plain(name).items() if n not in whole}
    fixed = {n: value for n, value in plain(name).items() if n in whole}

    def of(**numbers):
        structure = SHIPPED[name](**fixed, **{n: numbers[n] for n in given})
        motion = rk.GroundMotion.single_sine(2.0, 0.7)
        return Case(structure, motion, initial={n: numbers[n] for n in start}).problem()

    assert_carried(of, given | start, rtol=1e-5)
    assert nominal(SHIPPED[name](**fixed, **rk.duals(**given))) == SHIPPED[name](**fixed, **given)


def signs(name):
    module = SHIPPED[name](**plain(name)).module
    return dict(zip(module.PARAMETERS, module.PARAMETER_SIGNS, strict=True))


@pytest.mark.parametrize("name", SHIPPED)
def test_every_structure_carries_the_derivatives_of_parameters_and_start(name):
    module = SHIPPED[name](**plain(name)).module
    rotation = module.STATES[module.ROTATION]
    assert_structure_carried(name, {rotation: 0.03})
    assert_structure_carried(name, {rotation: -0.02, f"{rotation}_dot": 0.1})


MOTIONS = {
    "harmonic": lambda a, t: rk.GroundMotion.harmonic(a, duration=3 * t, frequency=1 / t, phase=t),
    "cosine": lambda a, t: rk.GroundMotion.single_cosine(a, t),
    "half sine": lambda a, t: rk.GroundMotion.half_sine(a, t, duration=5 * t),
    "Ricker": lambda a, t: rk.GroundMotion.ricker(a, t),
    "antisymmetric Ricker": lambda a, t: rk.GroundMotion.ricker(a, t, antisymmetric=True),
    "Mavroeidis-Papageorgiou": lambda a, t: rk.GroundMotion.mavroeidis_papageorgiou(a, t, 2.0 + t),
    "pulse": lambda a, t: rk.GroundMotion.constant(a, t, total_duration=2 * t),
    "none": lambda a, t: rk.GroundMotion.none(t + 0.0 * a),
    "record": lambda a, t: rk.GroundMotion.from_array(EL_CENTRO * a * 0.01, 0.01 * t),
    "scaled record": lambda a, t: rk.GroundMotion.from_array(EL_CENTRO, 0.01).scaled(a * 0.1, t),
    "mirrored": lambda a, t: -rk.GroundMotion.ricker(1.0, 1.0).scaled(a, t).padded_by(t),
    "turned": lambda a, t: rk.GroundMotion.from_array([0.0, a, 1.0], 0.1).rotated(
        rk.GroundMotion.from_array([1.0, 0.0, a], 0.1), t
    ),
    "to a peak": lambda a, t: rk.GroundMotion.from_array([0.0, t, -a], 0.1).scaled_to(a),
}


@pytest.mark.parametrize("kind", MOTIONS)
def test_every_ground_motion_carries_those_of_its_numbers(kind):
    make = MOTIONS[kind]
    for vertical in (False, True):
        motions = {"vertical": make} if vertical else {}

        def of(a, t, others=motions):
            shown = {name: other(a, t) for name, other in others.items()}
            return Case(BLOCK, make(a, t), initial={"theta": 0.01}, **shown).problem()

        assert_carried(of, {"a": 2.0, "t": 0.7})
    numbers = rk.duals(a=2.0, t=0.7)
    assert nominal(make(**numbers)) == make(2.0, 0.7)
    assert repr(make(**numbers)) == repr(make(2.0, 0.7))


LAWS = {
    "energy ratio": lambda a, b: rk.EnergyRatio(a * b),
    "energy ratio of each foot": lambda a, b: rk.EnergyRatio(left=a, right=b),
    "velocity ratio": lambda a, b: rk.VelocityRatio(a * b),
    "at speed": lambda a, b: rk.EnergyRatioAtSpeed(
        ((a, b, 0.0), (math.inf, 0.8, 0.01 * a)), height=b
    ),
    "loss": lambda a, b: rk.EnergyLossAtSpeed(left=(0.0, 0.01 * a, 0.0), right=(0.0, b, 0.02)),
    "each": lambda a, b: rk.EnergyRatioByImpact([a, a * b]),
    "drawn": lambda a, b: rk.RandomEnergyRatio([a, b, 0.9], seed=3),
    "angular momentum": lambda a, b: rk.AngularMomentum(),
}


@pytest.mark.parametrize("kind", LAWS)
def test_every_law_of_impact_carries_those_of_its_numbers(kind):
    def of(a, b):
        block = rk.RigidBlock(half_width=a * b, half_height=2.0 + b)
        motion = rk.GroundMotion.none(1.0)
        return Case(block, motion, impact=LAWS[kind](a, b), initial={"theta": 0.01}).problem()

    assert_carried(of, {"a": 0.7, "b": 0.8})


def test_a_duration_carries_its_derivative():
    assert_carried(
        lambda t: Case(BLOCK, rk.GroundMotion.none(5.0), duration=t * t).problem(), {"t": 1.3}
    )


def test_parts_of_structures_are_made_nominal():
    x = rk.duals(k=1e6, m=2.0)
    on_springs = rk.LumpedMassStructure(
        mass=x["m"], height=1.0, inertia=1.0, base_mass=1.0, base_height=0.1, base_inertia=0.1,
        half_width=0.3, support=rk.TwoSprings(stiffness=x["k"], damping=0.0),
    )  # fmt: skip
    found = nominal(on_springs)
    assert found.support == rk.TwoSprings(stiffness=1e6, damping=0.0)
    assert type(found.support.stiffness) is type(found.mass) is float
    assert nominal(found) is found


# --- the numbers themselves


@settings(max_examples=50, deadline=None)
@given(sizes, sizes)
def test_duals_calculate_as_numbers_do(x, y):
    def of(x, y):
        found = (2.0 - x) / (y + x**2) + abs(-x) * 3.0**y - x**0.5 / 4.0 + x**y - 1.0 / y
        found = found + mathematics.hypot(x, y) * mathematics.atan2(x, -y)
        return found + mathematics.copysign(x, -y) + np.float64(2.0) * np.sin(x) - (y - 1)

    found = of(*rk.duals(x=x, y=y).values())
    h = 1e-6
    expected = [
        (of(x + h, y) - of(x - h, y)) / (2 * h),
        (of(x, y + h) - of(x, y - h)) / (2 * h),
    ]
    assert float(found.value) == of(x, y)
    np.testing.assert_allclose(found.tangent, expected, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_functions_of_duals_have_the_bits_of_numbers(name):
    function, x = getattr(mathematics, name), 1.3 if name == "acosh" else 0.3
    found = function(rk.Dual(x, [2.0, 0.0]))
    assert float(found.value) == getattr(math, name)(x)
    slope = (function(x + 1e-6) - function(x - 1e-6)) / 2e-6
    np.testing.assert_allclose(found.tangent, [2.0 * slope, 0.0], rtol=1e-8)


@given(sizes, sizes)
def test_duals_are_compared_by_value(x, y):
    one, other = rk.duals(x=x, y=y).values()
    for name in ("lt", "le", "gt", "ge", "eq", "ne"):
        how = getattr(operator, name)
        assert how(one, other) is how(one, y) is how(x, other) is how(x, y)


def test_what_does_not_move_moves_nothing_where_a_slope_is_infinite():
    root = mathematics.sqrt(rk.Dual(0.0, [0.0, 1.0]))
    np.testing.assert_array_equal(root.tangent, [0.0, np.inf])


def test_an_array_of_numbers_calculates_with_a_dual():
    x = rk.Dual(3.0, [1.0, 0.0])
    for found in (x * np.array([1.0, 2.0]), np.array([1.0, 2.0]) * x):
        assert [float(e.value) for e in found] == [3.0, 6.0]
        assert [e.tangent.tolist() for e in found] == [[1.0, 0.0], [2.0, 0.0]]


# --- no derivative is lost in silence


X = rk.Dual(0.1, [1.0, 0.0])


@pytest.mark.parametrize(
    ("lose", "error", "said"),
    [
        (lambda: float(X), TypeError, "take its `.value`"),
        (lambda: math.sin(X), TypeError, "take its `.value`"),
        (lambda: np.array([0.0, X]).astype(float), TypeError, "take its `.value`"),
        (lambda: mathematics.floor(X), TypeError, "the derivative of floor is not known"),
        (lambda: {X: 1.0}, TypeError, "unhashable"),
        (lambda: hash(rk.RigidBlock(half_width=X, half_height=0.4)), TypeError, "unhashable"),
        (lambda: hash(rk.GroundMotion.single_sine(X, 1.0)), TypeError, "unhashable"),
        (lambda: X + rk.Dual(1.0, [1.0]), ValueError, "of 2 and of 1 directions"),
        (lambda: rk.Dual(0.1, 1.0), ValueError, "tangent has the shape"),
        (lambda: rk.Dual("a", [1.0]), TypeError, "value is 'a'"),
        (lambda: rk.Dual(X, [1.0]), TypeError, "give a plain number"),
        (lambda: rk.duals(mass="heavy"), TypeError, "value is 'heavy'"),
        (
            lambda: SHIPPED["rocking_frame"](**(plain("rocking_frame") | {"columns": X})),
            TypeError,
            "columns is a dual",
        ),
        (lambda: rk.Winkler(stiffness=1.0, damping=0.0, springs=X), ValueError, "springs is 0.1"),
        (
            lambda: rk.simulate(BLOCK, rk.GroundMotion.none(1.0), initial={"theta": X}),
            TypeError,
            "rk.tangents",
        ),
        (
            lambda: rk.simulate_many(
                lambda r: Case(
                    BLOCK, rk.GroundMotion.none(1.0), impact=rk.EnergyRatio(left=r * X, right=r)
                ),
                {"r": [0.5, 0.6]},
                sweep_options=rk.SweepOptions(progress=False),
            ),
            TypeError,
            "rk.tangents",
        ),
        (lambda: rk.RigidBlock(half_width=-X, half_height=0.4), ValueError, "half_width is -0.1"),
    ],
)
def test_a_derivative_is_not_lost_in_silence(lose, error, said):
    with pytest.raises(error, match=said):
        lose()
