"""Runge-Kutta pairs: all order conditions, by rooted trees, and the order observed in motion."""

import itertools
import math
import subprocess
import sys
from functools import cache

import numpy as np
import pytest
from scipy import integrate

import rockeom as rk
from rockeom.compiler.modules import Text, as_python
from rockeom.integrator.methods import coefficients
from rockeom.integrator.methods.tableau import step_text, tableau

METHODS = pytest.mark.parametrize("name", ["RK45", "DOP853"])
ORDER = {"RK45": 5, "DOP853": 8}
DENSE_ORDER = {"RK45": 4, "DOP853": 7}
ERROR_ORDERS = {"RK45": [4], "DOP853": [5, 3]}


# -- order conditions: one for every rooted tree (Butcher)


@cache
def trees(order):
    """All rooted trees of so many vertices, each the sorted tuple of its branches."""
    if order == 1:
        return ((),)
    found = set()
    for first in range(1, order):
        for branch, rest in itertools.product(trees(first), trees(order - first)):
            found.add(tuple(sorted((branch, *rest))))
    return tuple(sorted(found))


def vertices(tree):
    return 1 + sum(vertices(branch) for branch in tree)


def density(tree):
    """gamma(t): product over all vertices of the vertices above each, itself counted."""
    return vertices(tree) * math.prod(density(branch) for branch in tree)


def stage_values(tree, a):
    """Elementary weight of every stage (m,): prod over branches of a @ weight of the branch."""
    value = np.ones(len(a))
    for branch in tree:
        value = value * (a @ stage_values(branch, a))
    return value


def worst(weights, a, order, x=1.0):
    """Largest lack of the conditions up to `order` for y(t + x h) = y + h weights @ k."""
    lacks = [
        weights @ stage_values(tree, a) - x**n / density(tree)
        for n in range(1, order + 1)
        for tree in trees(n)
    ]
    return max(map(abs, lacks))


def test_rooted_trees_are_as_many_as_known():
    assert [len(trees(n)) for n in range(1, 9)] == [1, 1, 2, 4, 9, 20, 48, 115]


@METHODS
def test_every_order_condition(name):
    method = tableau(name)
    s = method.stages
    assert method.order == ORDER[name]
    assert worst(method.b, method.a[:s, :s], ORDER[name]) < 1e-13
    # and not one order more: the check can fail
    assert worst(method.b, method.a[:s, :s], ORDER[name] + 1) > 1e-6


def test_a_pair_is_added_in_one_file():
    """All that asks for a method by its name finds it: Dormand and Prince's by another."""
    code = """
from rockeom.integrator.methods import coefficients
coefficients.PAIRS["Prince"] = coefficients.RK45
import rockeom as rk
import rockeom.generated.rigid_block as module
from rockeom.integrator.linking import GLUE, LOOP
from rockeom.integrator.printing import printed
assert rk.SolverOptions(method="Prince").method == "Prince"
for part in (LOOP, GLUE):
    one, other = (printed(module, m, part).ir() for m in ("Prince", "RK45"))
    assert one == other
try:
    rk.SolverOptions(method="Dormand")
except ValueError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    wanted = "method is 'Dormand': choose 'DOP853', 'RK45', 'Prince' or 'Radau'"
    assert done.stdout.strip() == wanted


@METHODS
def test_coefficients_are_those_of_scipy_to_the_last_bit(name):
    ours = vars(getattr(coefficients, name))
    names = [key for key in ours if key[0].isalpha()]
    assert len(names) >= 5
    for key in names:
        theirs = np.asarray(getattr(getattr(integrate, name), key))
        assert np.asarray(ours[key]).tobytes() == theirs.tobytes(), key


@METHODS
def test_method_is_explicit_and_ends_with_the_rate_of_the_new_state(name):
    method = tableau(name)
    assert not np.triu(method.a).any()
    s = method.stages
    np.testing.assert_array_equal(method.a[s, :s], method.b)
    np.testing.assert_allclose(method.a.sum(axis=1), method.c, atol=1e-14)
    assert (method.c[0], method.c[s]) == (0.0, 1.0)


@METHODS
def test_error_estimates_vanish_up_to_their_order(name):
    """The weights are differences to methods of lower order: trees up to it give zero."""
    method = tableau(name)
    s = method.stages + 1
    for weights, order in zip(method.errors, ERROR_ORDERS[name], strict=True):
        full = np.zeros(s)
        full[: len(weights)] = weights
        lack = [
            max(abs(full @ stage_values(tree, method.a[:s, :s])) for tree in trees(n))
            for n in range(1, order + 2)
        ]
        assert max(lack[:-1]) < 1e-13
        assert lack[-1] > 1e-6
    assert method.error_order == max(
        {"RK45": 4, "DOP853": 7}[name], min(ERROR_ORDERS[name])
    )  # of DOP853's combination of the two


@METHODS
@pytest.mark.parametrize("x", [0.1, 0.37, 0.5, 0.81, 1.0])
def test_every_order_condition_of_the_dense_output(name, x):
    method = tableau(name)
    weights = method.dense @ x ** np.arange(1, method.degree + 1)
    assert worst(weights, method.a, DENSE_ORDER[name], x) < 1e-13


@METHODS
def test_dense_output_meets_both_ends_with_their_rates(name):
    method = tableau(name)
    s = method.stages
    np.testing.assert_allclose(method.dense.sum(axis=1)[:s], method.b, atol=1e-13)
    np.testing.assert_allclose(method.dense.sum(axis=1)[s:], 0, atol=1e-13)
    slopes = method.dense * np.arange(1, method.degree + 1)
    first, last = np.eye(len(method.c))[[0, s]]
    np.testing.assert_allclose(slopes[:, 0], first, atol=1e-12)
    np.testing.assert_allclose(slopes.sum(axis=1), last, atol=1e-11)


# -- order in motion, through impacts
#
# DOP853 fulfils the conditions of order nine to a few per cent. Its error is therefore small, and
# of clear order eight only where steps are short, p h < 0.3 or so. Longer steps, and motions in
# which those of order eight nearly cancel, show other slopes.

PLACES = np.linspace(0.11, 3.97, 37)
COUNTS = {"RK45": range(60, 240, 6), "DOP853": range(16, 60)}


@pytest.mark.parametrize("angle", [90, 120, 150, 180])
@pytest.mark.parametrize("name", ["DOP853", "RK45"])
def test_no_decay_or_vibration_is_wrong_unseen(name, angle):
    """Of q'' = lambda q', the estimate bounds the error of every step that is stable.

    The fifth-order estimate of DOP853 alone vanishes at h lambda = -5.65, where the step is wrong
    by a quarter of the mode.
    """
    tolerance, h, z = 1e-9, 0.01, 0j

    def accelerations(mode, q0, q1, v0, v1, p, ax, ay):
        """Of the mode in two real coordinates: its real and its imaginary part."""
        rate = z / h
        return rate.real * v0 - rate.imag * v1, rate.imag * v0 + rate.real * v1

    step = {
        "np": np, "math": math, "N_STATES": 4, "accelerations": accelerations,
        "ground_at_stages": lambda *ground: None, "FULL_CONTACT": -1,
        "shaking_at": lambda *places: (0.0, 0.0),
    }  # fmt: skip
    as_python([Text("step", step_text(tableau(name), 2))], step)
    k, y = np.zeros(4 * step["N_ALL_STAGES"] + 99), np.array([0.0, 0.0, 1.0, 0.0])
    new, atol = np.zeros(4), np.full(4, tolerance)
    for size in np.linspace(1.0, 6.5, 1101):
        z = size * np.exp(1j * np.radians(angle))
        k[2:4] = (z / h).real, (z / h).imag
        told = step["take_step"](0, 0.0, h, y, None, (), 0.0, atol, k, new)
        wrong = abs(complex(new[2], new[3]) - np.exp(z))
        if np.hypot(new[2], new[3]) < 1.0:
            assert wrong / tolerance < 5.0 * told, size


def shaken(name, **options):
    """Seven impacts in 4 s."""
    return rk.simulate(
        rk.RigidBlock.from_frequency(p=1.7, alpha=0.3),
        rk.GroundMotion.harmonic(0.4, period=1.8, phase=3.6, duration=4.0),
        impact=rk.VelocityRatio(0.86),
        initial={"theta": 0.11},
        options=rk.SolverOptions(method=name, **options),
    )


def of_impacts(run):
    """Times of the impacts, and rates after them."""
    return (
        np.array([impact.time for impact in run.impacts]),
        np.array([impact.after["theta_dot"] for impact in run.impacts]),
    )


def observed(run):
    """The same, and states at places anywhere in steps."""
    return *of_impacts(run), np.array([*run.at(PLACES).values()])


def slopes(counts, found, exact):
    """Observed order of each quantity: least squares through the errors of all counts of steps."""
    errors = [
        [np.sqrt(np.mean((f - e) ** 2)) for f, e in zip(found(n), exact, strict=True)]
        for n in counts
    ]
    return -np.polyfit(np.log(counts), np.log(errors), 1)[0]


@METHODS
def test_order_observed_through_impacts(name):
    """Equal steps without error control, of which each impact cuts one."""
    exact = observed(shaken("DOP853", rtol=1e-14, atol=1e-16))
    assert len(exact[0]) == 7
    orders = slopes(COUNTS[name], lambda n: observed(shaken(name, steps_per_segment=n)), exact)
    np.testing.assert_allclose(orders, ORDER[name], atol=0.3)


def test_symmetric_flights_keep_energy_to_one_order_more():
    """DOP853 on a freely rocking slender block, in closed form: times to order 8, rates to 9.

    The leading error of a method of even order is odd in time: what the energy loses on the way
    up it regains on the way down, and the rates at the impacts are those of the energy.
    """
    p, alpha, theta, e = 2.0, 0.25, 0.24, 0.95
    rates = p * math.sqrt(theta * (2 * alpha - theta)) * e ** np.arange(1, 5)
    flights = 2 / p * np.arctanh(rates / (p * alpha))
    first = math.acosh(alpha / (alpha - theta)) / p
    exact = first + np.array([0.0, *np.cumsum(flights[:-1])]), rates * [-1, 1, -1, 1]

    def found(n):
        return of_impacts(
            rk.simulate(
                rk.SlenderBlock.from_frequency(p=p, alpha=alpha),
                rk.GroundMotion.none(exact[0][-1] + 0.05),
                impact=rk.VelocityRatio(e),
                initial={"theta": theta},
                options=rk.SolverOptions(method="DOP853", steps_per_segment=n),
            )
        )

    orders = slopes(range(34, 80), found, exact)
    np.testing.assert_allclose(orders, (8, 9), atol=0.3)


@METHODS
def test_error_follows_the_tolerance(name):
    """Not of an order, but in proportion: no tolerance is a dead letter."""
    exact = observed(shaken("DOP853", rtol=1e-14, atol=1e-16))
    errors = []
    for rtol in (1e-5, 1e-7, 1e-9, 1e-11):
        run = observed(shaken(name, rtol=rtol, atol=rtol * 1e-2))
        errors.append(np.abs(run[2] - exact[2]).max())
    assert errors[-1] < 1e-9
    assert all(later < earlier / 10 for earlier, later in itertools.pairwise(errors))


@METHODS
def test_equal_steps_in_each_law_and_control_behind_the_motion(name):
    """Five steps from sample to sample; behind the last one, the usual control."""
    block = rk.RigidBlock.from_frequency(p=2.0, alpha=0.3)
    motion = rk.GroundMotion.from_array([0.0, 1.0, -2.0, 1.0, 0.5], dt=0.1)
    arguments = {"initial": {"theta": 0.2}, "duration": 4.0}
    fixed = rk.SolverOptions(method=name, steps_per_segment=5)
    run = rk.simulate(block, motion, options=fixed, **arguments)
    first_impact = run.impacts[0].time
    assert first_impact > 0.4
    shaken = run.steps.span[run.steps.span[:, 0] < 0.4 - 1e-9]
    np.testing.assert_allclose(shaken[:, 1], 0.02, rtol=1e-12)
    assert len(shaken) == 20
    controlled = rk.simulate(block, motion, **arguments)
    assert len(run.impacts) == len(controlled.impacts)
    assert first_impact == pytest.approx(controlled.impacts[0].time, rel=1e-6)
