"""Bad input from Python: each error names what is wrong, where, and the remedy."""

import math
import re
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import rockeom as rk
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain
from tests.sweeping import simulate_many
from tests.typical import S1, column, on_springs

BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)
QUIET = rk.GroundMotion.none(1.0)


def raises(error, *words):
    """An error whose text contains all the words."""
    return pytest.raises(error, match="(?s)" + "".join(f"(?=.*{word})" for word in words))


# -- parameters


def block(**changes):
    return rk.RigidBlock(**({"half_width": 0.1, "half_height": 0.4} | changes))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: block(half_width=-0.1), ("half_width", "-0.1", "positive")),
        (lambda: block(half_width=0.0), ("half_width", "positive")),
        (lambda: block(half_width=math.nan), ("half_width", "nan", "finite")),
        (lambda: block(half_height=math.inf), ("half_height", "inf", "finite")),
        (lambda: column(damping=-1.0), ("damping", "-1", "zero or positive")),
        (lambda: rk.RigidBlock.from_frequency(p=2.0, alpha=1.6), ("1.6", "below pi/2", "alpha_d")),
        (lambda: rk.RigidBlock.from_frequency(p=-2.0, alpha=0.3), ("p is -2", "positive")),
    ],
)
def test_value_of_a_parameter(make, words):
    with raises(ValueError, *words):
        make()


def test_unknown_parameter_is_named_with_a_suggestion():
    with raises(TypeError, "RigidBlock", "half_hight", "did you mean half_height"):
        rk.RigidBlock(half_width=0.1, half_hight=0.4)


def test_all_missing_parameters_are_named_at_once():
    with raises(TypeError, "FlexibleStructure", "missing", "stiffness", "base_mass", "half_width"):
        rk.FlexibleStructure(mass=1.0, height=1.0, inertia=0.0, base_height=0.0, damping=0.0)


def test_unknown_structure_is_named_with_a_suggestion():
    with raises(ValueError, "flexible_structur", "did you mean flexible_structure"):
        rk.structure("flexible_structur")
    with raises(KeyError, "rigid_blok", "did you mean rigid_block"):
        rk.derive("rigid_blok")


# -- laws of impact


@pytest.mark.parametrize("law", [rk.EnergyRatio, rk.VelocityRatio])
@pytest.mark.parametrize("ratio", [1.0000001, -0.1, math.nan])
def test_restitution_outside_its_range(law, ratio):
    with raises(ValueError, "ratio", str(ratio), "between 0", "1"):
        law(ratio)


def test_impact_law_for_a_structure_without_impacts():
    with raises(ValueError, "two_spring_structure", "no impacts", "leave `impact` out"):
        rk.simulate(on_springs(), QUIET, impact=rk.EnergyRatio(0.8))


def test_impulsive_law_for_the_cart():
    cart = rk.TwoSpringCart(**S1, foundation_stiffness=550e3)
    with raises(ValueError, "two_spring_cart", "impulsive", "EnergyRatio"):
        rk.simulate(cart, QUIET, impact=rk.Impulsive())


def test_after_impact_in_a_mode_without_impact():
    with raises(ValueError, "no impact", "both"):
        BLOCK.after_impact({}, mode="both")


# -- states and modes


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_initial_state_that_is_not_finite(value):
    with raises(ValueError, "theta", str(value), "finite"):
        rk.simulate(BLOCK, QUIET, initial={"theta": value})


def test_unknown_state():
    with raises(ValueError, "unknown state", "phi", "theta, theta_dot"):
        rk.simulate(BLOCK, QUIET, initial={"phi": 0.1})


def test_unknown_mode():
    with raises(ValueError, "mode", "rihgt", "did you mean right", "left, both, right"):
        rk.simulate(BLOCK, QUIET, initial={"theta": 0.1}, mode="rihgt")


@pytest.mark.parametrize(
    ("initial", "mode"),
    [({"theta": 0.1}, "left"), ({"theta": 0.1}, "both"), ({"theta_dot": 0.1}, "both")],
)
def test_mode_that_contradicts_the_state(initial, mode):
    """A structure turned to the right does not stand on its left edge."""
    with raises(ValueError, mode, "theta"):
        rk.simulate(BLOCK, QUIET, initial=initial, mode=mode)


@pytest.mark.parametrize("theta", [math.pi / 2 + 1e-6, -2.0])
def test_start_beyond_overturning(theta):
    with raises(ValueError, "theta", "ground", "start below"):
        rk.simulate(BLOCK, QUIET, initial={"theta": theta})


@pytest.mark.parametrize("digits", [-1e-12, 0.0, 1e-12])
def test_the_last_state_of_a_motion_that_overturned_is_a_start(digits):
    initial = {"theta": math.pi / 2 * (1 + digits), "theta_dot": 0.1}
    assert rk.simulate(BLOCK, QUIET, initial=initial).outcome == "overturned"


# -- duration and options


@pytest.mark.parametrize("duration", [0, -1.0, math.nan, math.inf])
def test_duration(duration):
    with raises(ValueError, f"duration is {float(duration)} s", "finite and positive"):
        rk.simulate(BLOCK, QUIET, duration=duration)


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ({"method": "rk45"}, ("rk45", "DOP853", "did you mean RK45")),
        ({"rtol": 0.0}, ("rtol", "positive")),
        ({"rtol": 1e-16}, ("rtol", "1e-16", "1e-15")),
        ({"atol": -1e-9}, ("atol", "positive")),
        ({"max_step": math.nan}, ("max_step", "positive")),
        ({"max_impacts": 0}, ("max_impacts is 0", "whole number of at least 1")),
        ({"max_steps": 10.5}, ("max_steps is 10.5", "whole number of at least 1")),
        ({"max_steps": math.inf}, ("max_steps is inf", "whole number of at least 1")),
        ({"max_steps": 2**63}, ("max_steps is 9.22337e", "at most 9223372036854775807")),
        ({"max_impacts": 1e30}, ("max_impacts is 1e", "at most 9223372036854775807")),
        ({"steps_per_segment": -1}, ("steps_per_segment is -1", "whole number of at least 0")),
        ({"output_step": 0.0}, ("output_step", "positive")),
    ],
)
def test_options(option, words):
    with raises(ValueError, *words):
        rk.SolverOptions(**option)


def test_options_are_kept_as_the_compiled_loop_takes_them():
    """Else a loop is compiled anew for each kind of number."""
    options = rk.SolverOptions(rtol=np.float32(0.5), max_steps=1e6, steps_per_segment=np.int8(2))
    kept = options.rtol, options.max_steps, options.steps_per_segment
    assert kept == (0.5, 1_000_000, 2)
    assert list(map(type, kept)) == [float, int, int]


# -- arguments of another kind

SHAKE = rk.GroundMotion.from_array([0.0, 1.0, 0.0], dt=0.1)
PULSED = rk.Case(BLOCK, rk.GroundMotion.single_sine(3.0, 0.5))
SAMPLES = {
    "list": [0.0, 1.0, 0.0],
    "tuple": (0.0, 1.0),
    "array": np.array([0.0, 1.0, 0.0]),
    "array of one": np.array([0.9]),
    "series": pd.Series([0.0, 1.0, 0.0], index=[0.0, 0.1, 0.2]),
    "labelled array": xr.DataArray([0.0, 1.0], dims="t"),
}
OTHERS = SAMPLES | {
    "number": 0.9,
    "zero": 0,
    "truth": True,
    "word": "impulsive",
    "path": Path("quake.AT2"),
    "mapping": {"theta": 0.1},
    "no mapping": {},
    "class": rk.Impulsive,
    "structure": BLOCK,
    "class of structures": rk.RigidBlock,
    "motion": SHAKE,
    "class of motions": rk.GroundMotion,
    "law": rk.Impulsive(),
    "options": rk.SolverOptions(),
    "class of options": rk.SolverOptions,
    "function": rk.simulate,
    "case": rk.Case(BLOCK, QUIET),
    "nothing": None,
    "number of text": "0.9",
    "text without dimensions": np.array("0.9"),
    "decimal": Decimal("0.9"),
    "complex": 0.9j,
}
NUMBERS = {"number", "zero"}
MAPPINGS = {"mapping", "no mapping"}


def simulated(**changes):
    arguments = {"structure": BLOCK, "motion": SHAKE} | changes
    return rk.simulate(arguments.pop("structure"), arguments.pop("motion"), **arguments)


def swept(**changes):
    over = {"a": [1.0]}
    return rk.simulate_many(
        lambda a: rk.Case(**({"structure": BLOCK, "motion": SHAKE} | changes)), over
    )


ARGUMENTS = {
    "structure": {"structure"},
    "motion": {"motion"},
    "vertical": {"motion", "nothing"},
    "impact": {"law", "nothing"},
    "initial": {*MAPPINGS, "nothing"},
    "duration": {*NUMBERS, "nothing"},
    "mode": {"word", "number of text", "nothing"},
    "options": {"options", "nothing"},
}
"""What each argument may be, of the things above."""


@pytest.mark.parametrize("argument", ARGUMENTS)
@pytest.mark.parametrize("ask", [simulated, swept])
def test_argument_of_another_kind_is_named(ask, argument):
    if ask is swept and argument == "options":
        return  # it is none of a case
    for kind in set(OTHERS) - ARGUMENTS[argument]:
        words = rf"^(case a = 1: )?(\w+ and )?{argument} (is|are) "
        with pytest.raises(TypeError, match=words) as caught:
            ask(**{argument: OTHERS[kind]})
        text = str(caught.value)
        assert any(remedy in text for remedy in (": give ", ": name ", "comes first"))
        assert len(text) < 300


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: simulated(impact=0.9),
            ("impact is 0.9", "EnergyRatio(0.9)", "VelocityRatio(0.9)"),
        ),
        (lambda: simulated(impact="impulsive"), ("impact is 'impulsive'", "rk.Impulsive()")),
        (
            lambda: simulated(impact=rk.Impulsive),
            ("impact is the class Impulsive", "rk.Impulsive()"),
        ),
        (lambda: simulated(options={"rtol": 1e-8}), ("options is a dict", "rk.SolverOptions(rtol")),
        (lambda: simulated(motion=SAMPLES["list"]), ("motion is a list", "from_array(values, dt)")),
        (
            lambda: simulated(motion=SAMPLES["series"]),
            ("motion is a Series of shape (3,)", "from_arr"),
        ),
        (
            lambda: simulated(motion="quake.AT2"),
            ("motion is 'quake.AT2'", "GroundMotion.read(path)"),
        ),
        (lambda: simulated(motion=None), ("motion is None", "GroundMotion.none(duration)")),
        (
            lambda: simulated(vertical=SAMPLES["array"]),
            ("vertical is a ndarray of shape", "from_array"),
        ),
        (lambda: rk.simulate(SHAKE, BLOCK), ("structure and motion are swapped", "first")),
        (
            lambda: simulated(structure=rk.RigidBlock),
            ("structure is the class RigidBlock", "half_width="),
        ),
        (lambda: simulated(initial=0.1), ("initial is 0.1", "{'theta': 0.01}")),
        (lambda: simulated(initial={"theta": "0.1"}), ("state theta is '0.1'", "give a number")),
        (lambda: simulated(initial={"theta": [0.1]}), ("state theta is a list", "give a number")),
        (lambda: simulated(initial={0: 0.1}), ("unknown state 0", "theta")),
        (lambda: simulated(duration="10"), ("duration is '10'", "give a number")),
        (lambda: simulated(mode=1), ("is 1", "left, both, right")),
        (
            lambda: rk.RigidBlock(0.1, 0.4),
            ("RigidBlock takes its parameters by name, and 0.1", "half_width (Half of the"),
        ),
        (lambda: rk.RigidBlock.from_frequency("2", 0.3), ("RigidBlock: p is '2'", "give a number")),
        (lambda: rk.EnergyRatio("0.9"), ("energy ratio r is '0.9'", "give a number")),
        (lambda: rk.VelocityRatio([0.9]), ("velocity ratio e is a list", "give a number")),
        (
            lambda: rk.EnergyRatioAtSpeed(0.9),
            ("pieces of an energy ratio are 0.9", "three numbers"),
        ),
        (lambda: rk.EnergyRatioAtSpeed(((math.inf, 0.9),)), ("pieces", "three numbers")),
        (lambda: rk.EnergyRatioAtSpeed(((math.inf, "0.9", 0),)), ("pieces", "three numbers")),
        (lambda: rk.ControlledWall.from_wall("thesis"), ("wall is 'thesis'", "Wall.thesis()")),
        (
            lambda: rk.ControlledWallOscillator.thesis("0.9"),
            ("ControlledWallOscillator: energy_ratio is '0.9'", "give a number"),
        ),
        (
            lambda: rk.ControlledWallOscillator.thesis(0.9, held="no"),
            ("held is 'no'", "True or False"),
        ),
    ],
)
def test_what_a_mistaken_call_is_told(call, words):
    with pytest.raises((TypeError, ValueError)) as caught:
        call()
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize("kind", sorted(set(OTHERS) - NUMBERS))
def test_parameter_that_is_no_number(kind):
    """A word is no number, whatever it says: 0.1 and "0.1" are told apart."""
    with raises(TypeError, "RigidBlock: mass is ", "give a number in SI units"):
        block(mass=OTHERS[kind])


@pytest.mark.parametrize(
    "value",
    [0.5, Fraction(1, 2), np.float32(0.5), np.float64(0.5), np.array(0.5), xr.DataArray(0.5)],
)
def test_numbers_of_every_make_are_taken(value):
    structure = block(half_width=value)
    assert structure.vector.tolist() == block(half_width=0.5).vector.tolist()
    assert structure.state({"theta": value}).tolist() == [0.5, 0.0]
    assert rk.EnergyRatio(value).r == 0.5
    assert rk.Case(structure, QUIET, duration=value).problem().end == 0.5


@pytest.mark.parametrize(
    "option",
    [
        "rtol",
        "atol",
        "max_step",
        "rest_tolerance",
        "max_impacts",
        "max_steps",
        "steps_per_segment",
        "output_step",
    ],
)
@pytest.mark.parametrize("value", ["1", [1.0], True, {}, np.ones(2), rk.SolverOptions])
def test_option_that_is_no_number(option, value):
    with raises(TypeError, f"{option} is ", "number"):
        rk.SolverOptions(**{option: value})


METHODS = {
    "accelerations": lambda state, **others: BLOCK.accelerations(state, **others),
    "energies": lambda state, **others: BLOCK.energies(state, **others),
    "reactions": lambda state, **others: BLOCK.reactions(state, **others),
    "after_impact": lambda state, **others: BLOCK.after_impact(
        state, **({"mode": "right"} | others)
    ),
    "state": lambda state: BLOCK.state(state),
}


@pytest.mark.parametrize("method", METHODS)
def test_method_asked_of_what_is_no_state(method):
    for kind in set(OTHERS) - MAPPINGS:
        with raises(TypeError, "state is ", "name the states, as in {'theta': 0.01}"):
            METHODS[method](OTHERS[kind])


@pytest.mark.parametrize(
    ("method", "argument", "value"),
    [
        ("accelerations", "ground_acceleration", "1.2"),
        ("accelerations", "ground_acceleration", rk.RigidBlock),
        ("accelerations", "vertical_ground_acceleration", SHAKE),
        ("reactions", "ground_acceleration", {"horizontal": 1.2}),
        ("reactions", "vertical_ground_acceleration", None),
        ("reactions", "mode", 1),
        ("energies", "mode", ["right"]),
        ("after_impact", "mode", np.array(["right"])),
        ("after_impact", "impact", 0.9),
        ("after_impact", "impact", rk.Impulsive),
    ],
)
def test_method_with_an_argument_of_another_kind(method, argument, value):
    with raises(TypeError, f"{argument} is ", "give"):
        METHODS[method]({"theta_dot": -0.1}, **{argument: value})


@pytest.mark.parametrize("structure", [BLOCK, on_springs(), rk.ControlledWall.thesis()])
def test_pushover_at_what_is_no_rotation(structure):
    with raises(TypeError, "rotations is '0.1', which is no number"):
        structure.pushover("0.1")
    with raises(TypeError, re.escape("rotations[1] is '0.1', which is no number")):
        structure.pushover([0.1, "0.1"])
    with raises(ValueError, "rotations hold nan", "finite"):
        structure.pushover([0.1, math.nan])


# -- sweeps


@pytest.mark.parametrize(
    ("returned", "words"),
    [
        (BLOCK, ("returned RigidBlock", "rk.Case(structure, motion)")),
        (None, ("returned None", "rk.Case(structure, motion)")),
        ((BLOCK, SHAKE), ("returned a tuple", "rk.Case(structure, motion)")),
        (rk.Case, ("returned the class Case", "rk.Case(structure, motion)")),
    ],
)
def test_sweep_whose_function_returns_no_case(returned, words):
    with raises(TypeError, *map(re.escape, words)):
        rk.simulate_many(lambda a: returned, over={"a": [1.0, 2.0]})


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"case": rk.Case(BLOCK, SHAKE)}, ValueError, ("over: 'a' is unknown", "half_width")),
        ({"case": BLOCK}, TypeError, ("case is RigidBlock", "function", "lambda a")),
        ({"case": lambda b: None}, TypeError, ("over has a", "takes others", "missing b")),
        ({"over": [1.0, 2.0]}, TypeError, ("over is a list", "frequency")),
        ({"over": None}, TypeError, ("over is None", "frequency")),
        ({"over": {1: [1.0]}}, TypeError, ("over has the name 1", "argument")),
        ({"over": {"a": 1.0}}, TypeError, ("over has a = 1.0", "list of values")),
        ({"over": {"a": np.array(1.0)}}, TypeError, ("over has a = ", "list of values")),
        ({"over": {"a": "El Centro"}}, TypeError, ("over has a = 'El Centro'", "list of values")),
        (
            {"case": PULSED, "over": {"frequency": [1, 0]}},
            ValueError,
            ("frequency is 0: give a pos",),
        ),
        ({"case": PULSED, "over": {"amplitude": [1, 10**400]}}, ValueError, ("amplitude is inf",)),
        ({"over": {}}, ValueError, ("`over` is empty",)),
        ({"over": {"a": []}}, ValueError, ("`over` is empty",)),
        ({"options": {"rtol": 1e-8}}, TypeError, ("options is a dict", "SolverOptions")),
        ({"options": rk.SolverOptions}, TypeError, ("options is the class SolverOptions",)),
        ({"threads": "2"}, TypeError, ("threads is '2'", "whole number of at least 1")),
        ({"threads": 1.5}, ValueError, ("threads is 1.5", "whole number of at least 1")),
        ({"chunk": 0}, ValueError, ("chunk is 0", "whole number of at least 1")),
        ({"impact_times": -1}, ValueError, ("impact_times is -1", "at least 0")),
        ({"impact_times": "3"}, TypeError, ("impact_times is '3'", "at least 0")),
        ({"quantities": ["theta"], "times": ["0.1"]}, TypeError, ("times.* is '0.1'", "no number")),
    ],
)
def test_sweep_with_an_argument_of_another_kind(changes, error, words):
    arguments = {"case": lambda a: rk.Case(BLOCK, SHAKE), "over": {"a": [1.0]}, "threads": 1}
    with raises(error, *words):
        simulate_many(**(arguments | changes))


# -- questions to a response


def test_unknown_quantity_of_a_response():
    run = rk.simulate(BLOCK, QUIET, initial={"theta": 0.05})
    with raises(KeyError, "drift", "theta", "total_energy", "displacement"):
        run["drift"]


def test_times_outside_a_response():
    run = rk.simulate(BLOCK, QUIET, initial={"theta": 0.05})
    with raises(ValueError, "reach from 2.0 to 2.0 s, the response from 0.0 to 1.0 s"):
        run.at(2.0)
    with raises(ValueError, "side", "middle", "'left' or 'right'"):
        run.at(0.5, side="middle")


def test_wrong_states_and_parameters_of_lambdified_functions():
    mode = rk.derive("rigid_block").lambdify()["right"]
    values = {"mass": 1.0, "half_width": 0.1, "height": 0.4, "inertia": 0.1, "gravity": 9.81}
    with raises(ValueError, "3 rows", "theta, theta_dot"):
        mode.energies([0.1, 0.0, 0.0], values)
    with raises(ValueError, "missing: height", "unknown: hight"):
        mode.energies([0.1, 0.0], {("hight" if k == "height" else k): v for k, v in values.items()})


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", SHIPPED)
def test_a_parameter_of_any_size_is_used_or_refused_by_name(name):
    """No error of arithmetic comes through from the products that the equations make of it."""
    still = rk.GroundMotion.none(1.0)
    values = plain(name)
    for parameter in values.keys() - {"columns"}:  # which are counted
        for size in (1e-320, 1e-200, 1e-51, 1e-50, 1e50, 1e51, 1e200):
            said = ""
            try:
                structure = SHIPPED[name](**(values | {parameter: size}))
                _ = structure.vector, structure.small_motion
                rk.Case(structure, still).problem()
            except ValueError as error:
                said = f"{error}"
            assert said != "math domain error"


def test_parameters_that_leave_the_range_of_numbers_are_named_with_the_remedy():
    with raises(ValueError, "RigidBlock: half_width is 1e", "beyond 1e", "SI units"):
        rk.RigidBlock(half_width=1e155, half_height=1.0)
    with raises(ValueError, "TwoSprings: stiffness is 1e-200, below 1e-50", "SI units"):
        rk.TwoSprings(stiffness=1e-200, damping=0.0)


@pytest.mark.parametrize("u", [2.0, -3.0, 1e200])
def test_a_displacement_beyond_the_height_of_a_wall_is_refused_by_name(u):
    wall = SHIPPED["controlled_wall_oscillator"](
        **(plain("controlled_wall_oscillator") | {"height": 2.0})
    )
    with raises(ValueError, "state u is", "beyond the height of 2 m"):
        rk.simulate(wall, QUIET, initial={"u": u})
