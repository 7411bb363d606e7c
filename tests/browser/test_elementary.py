"""Elementary functions of a page are near the exact ones, and the same in machine code."""

import math
import random
from types import FunctionType, SimpleNamespace

import numpy as np
import pytest
from mpmath import mp, mpf, workprec

from rockeom.browser import elementary
from rockeom.browser.program import portable
from rockeom.structures.base import generated_module

DRAW = random.Random(1)


def over(low: float, high: float) -> float:
    """Of either sign and any size from 10**low to 10**high."""
    return DRAW.choice((-1.0, 1.0)) * 10.0 ** DRAW.uniform(low, high)


ARGUMENTS = {
    "sin": lambda: DRAW.choice([DRAW.uniform(-7.0, 7.0), over(-8, 5)]),
    "cos": lambda: DRAW.choice([DRAW.uniform(-7.0, 7.0), over(-8, 5)]),
    "tan": lambda: DRAW.choice([DRAW.uniform(-7.0, 7.0), over(-8, 3)]),
    "exp": lambda: DRAW.uniform(-700.0, 705.0),
    "expm1": lambda: DRAW.choice([DRAW.uniform(-30.0, 30.0), over(-12, 0)]),
    "log": lambda: DRAW.choice([abs(over(-300, 300)), DRAW.uniform(0.3, 3.0)]),
    "log1p": lambda: DRAW.choice([abs(over(-12, 10)), DRAW.uniform(-0.99, 3.0)]),
    "atan": lambda: over(-6, 6),
    "asin": lambda: DRAW.uniform(-1.0, 1.0),
    "acos": lambda: DRAW.uniform(-1.0, 1.0),
    "sinh": lambda: over(-6, 2.5),
    "cosh": lambda: over(-6, 2.5),
    "tanh": lambda: over(-6, 1.5),
    "asinh": lambda: over(-6, 12),
    "acosh": lambda: 1.0 + abs(over(-6, 12)),
    "atanh": lambda: DRAW.uniform(-1.0, 1.0),
}


@pytest.mark.parametrize("name", ARGUMENTS)
def test_function_is_within_three_units_in_the_last_place(name):
    own, exact = getattr(elementary, f"own_{name}"), getattr(mp, name)
    with workprec(200):
        for _ in range(400):
            x = ARGUMENTS[name]()
            found, wanted = own(x), exact(mpf(x))
            assert abs(found - wanted) <= 3 * math.ulp(float(wanted)), x


def test_power_is_as_good_as_its_exponent_allows():
    with workprec(200):
        for _ in range(400):
            x, y = abs(over(-6, 6)), DRAW.uniform(-3.0, 3.0)
            wanted = mpf(x) ** mpf(y)
            room = 2 * (1 + abs(y * math.log(x))) * math.ulp(float(wanted))
            assert abs(elementary.own_pow(x, y) - wanted) <= room, (x, y)


@pytest.mark.parametrize(
    ("name", "x", "value"),
    [
        ("sin", 0.0, 0.0), ("cos", 0.0, 1.0), ("exp", 0.0, 1.0), ("expm1", 0.0, 0.0),
        ("log", 1.0, 0.0), ("exp", -800.0, 0.0), ("exp", 800.0, math.inf),
        ("log", 0.0, -math.inf), ("expm1", -50.0, -1.0), ("tanh", 50.0, 1.0), ("acos", 1.0, 0.0),
        ("log", math.inf, math.inf), ("cosh", 0.0, 1.0), ("sinh", 0.0, 0.0),
    ],
)  # fmt: skip
def test_ends_of_the_domain(name, x, value):
    assert getattr(elementary, f"own_{name}")(x) == value


def test_no_number_has_no_value():
    for name in ("sin", "cos", "exp", "expm1", "log", "log1p"):
        assert math.isnan(getattr(elementary, f"own_{name}")(math.nan))
    assert math.isnan(elementary.own_log(-1.0))


def test_a_power_of_two_is_exact():
    for n in (-1074, -1023, -1, 0, 1, 52, 1023):
        assert elementary.own_power_of_two(n) == math.ldexp(1.0, n)
    assert elementary.own_power_of_two(1024) == math.inf


def test_machine_code_calls_no_function_of_the_system():
    """Neither of the sines of a block nor of the logarithm in the force of an impact."""
    for name in ("rigid_block", "dirac_delta_block"):
        ir = portable(generated_module(name), "DOP853").ir
        declared = [line for line in ir.splitlines() if line.startswith("declare")]
        assert declared
        assert all("@llvm.fabs" in d or "@llvm.sqrt" in d or "@llvm.mem" in d for d in declared)


def test_equations_of_motion_have_the_bits_of_python():
    """The functions in Python and the printed ones are one text."""
    module = generated_module("rigid_block")
    program = portable(module, "DOP853").native(module)
    y, p = np.array([0.1, 0.2]), np.array(module.prepare(np.array([1.0, 0.1, 0.4, 0.05, 9.81])))
    t, states = np.array([0.0]), y.reshape(1, 2)
    energy = np.zeros((1, len(module.ENERGIES)))
    still, force = np.zeros((0, 7)), np.zeros((1, len(module.REACTIONS)))
    motion = np.zeros((1, len(module.KINEMATICS)))
    mode = module.MODES.index("right")
    program.evaluate(np.array([mode]), t, states, still, still, still, p, energy, force, motion)
    own = {"math": own_mathematics(), "np": np}
    wanted = np.zeros(len(module.ENERGIES))
    FunctionType(module.energies.__code__, vars(module) | own)(mode, y, p, wanted)
    assert energy[0].tobytes() == wanted.tobytes()


def own_mathematics():
    names = {n.removeprefix("own_"): f for n, f in vars(elementary).items() if n.startswith("own_")}
    return SimpleNamespace(**names, sqrt=math.sqrt)
