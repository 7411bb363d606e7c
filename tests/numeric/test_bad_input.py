"""Bad input from Python: each error names what is wrong, where, and the remedy."""

import math

import pytest

import rockeom as rk

from .structures import S1, column, on_springs

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
        (lambda: block(half_width="wide"), ("half_width", "wide", "number")),
        (lambda: column(damping=-1.0), ("damping", "-1", "zero or positive")),
        (lambda: rk.RigidBlock.from_frequency(p=2.0, alpha=1.6), ("alpha", "1.6", "below pi/2")),
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
    with raises(KeyError, "rigid_blok", "rigid_block"):
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


def test_after_impact_in_a_phase_without_impact():
    with raises(ValueError, "no impact", "both"):
        BLOCK.after_impact({}, phase="both")


# -- states and phases


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_initial_state_that_is_not_finite(value):
    with raises(ValueError, "theta", str(value), "finite"):
        rk.simulate(BLOCK, QUIET, initial={"theta": value})


def test_unknown_state():
    with raises(ValueError, "unknown state", "phi", "theta, theta_dot"):
        rk.simulate(BLOCK, QUIET, initial={"phi": 0.1})


def test_unknown_phase():
    with raises(ValueError, "phase", "rihgt", "left, both, right"):
        rk.simulate(BLOCK, QUIET, initial={"theta": 0.1}, phase="rihgt")


@pytest.mark.parametrize(
    ("initial", "phase"),
    [({"theta": 0.1}, "left"), ({"theta": 0.1}, "both"), ({"theta_dot": 0.1}, "both")],
)
def test_phase_that_contradicts_the_state(initial, phase):
    """A structure turned to the right does not stand on its left edge."""
    with raises(ValueError, phase, "theta"):
        rk.simulate(BLOCK, QUIET, initial=initial, phase=phase)


@pytest.mark.parametrize("theta", [math.pi / 2, -2.0])
def test_start_beyond_overturning(theta):
    with raises(ValueError, "theta", "ground", "start below"):
        rk.simulate(BLOCK, QUIET, initial={"theta": theta})


# -- duration and options


@pytest.mark.parametrize("duration", [0, -1.0, math.nan, math.inf])
def test_duration(duration):
    with raises(ValueError, "duration", "finite and positive"):
        rk.simulate(BLOCK, QUIET, duration=duration)


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ({"method": "RK4"}, ("RK4", "DOP853", "RK45")),
        ({"rtol": 0.0}, ("rtol", "positive")),
        ({"rtol": 1e-16}, ("rtol", "1e-16", "1e-15")),
        ({"atol": -1e-9}, ("atol", "positive")),
        ({"max_step": math.nan}, ("max_step", "positive")),
        ({"max_impacts": 0}, ("max_impacts", "positive")),
        ({"output_step": 0.0}, ("output_step", "positive")),
    ],
)
def test_options(option, words):
    with raises(ValueError, *words):
        rk.SolverOptions(**option)


# -- questions to a response


def test_unknown_quantity_of_a_response():
    run = rk.simulate(BLOCK, QUIET, initial={"theta": 0.05})
    with raises(KeyError, "drift", "theta", "total_energy", "displacement"):
        run["drift"]


def test_times_outside_a_response():
    run = rk.simulate(BLOCK, QUIET, initial={"theta": 0.05})
    with raises(ValueError, "2", "1"):
        run.at(2.0)
    with raises(ValueError, "side", "middle", "'left' or 'right'"):
        run.at(0.5, side="middle")


def test_wrong_states_and_parameters_of_lambdified_functions():
    phase = rk.derive("rigid_block").lambdify()["right"]
    values = {"mass": 1.0, "half_width": 0.1, "height": 0.4, "inertia": 0.1, "gravity": 9.81}
    with raises(ValueError, "3 rows", "theta, theta_dot"):
        phase.energies([0.1, 0.0, 0.0], values)
    with raises(ValueError, "missing: height", "unknown: hight"):
        phase.energies(
            [0.1, 0.0], {("hight" if k == "height" else k): v for k, v in values.items()}
        )
