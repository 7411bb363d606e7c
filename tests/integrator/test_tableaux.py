"""Runge-Kutta pairs: all order conditions, by rooted trees, and the order observed in motion."""

import itertools
import math
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.numeric.tableau import tableau

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

PLACES = np.linspace(0.11, 3.97, 37)


def shaken(name, **options):
    return rk.simulate(
        rk.RigidBlock.from_frequency(p=2.0, alpha=0.3),
        rk.GroundMotion.harmonic(0.5, period=2.0, phase=0.4, duration=4.0),
        impact=rk.VelocityRatio(0.9),
        initial={"theta": 0.12},
        options=rk.SolverOptions(method=name, **options),
    )


def observed(run):
    """Times of the impacts, rates after them, and states at places anywhere in steps."""
    return (
        np.array([impact.time for impact in run.impacts]),
        np.array([impact.after["theta_dot"] for impact in run.impacts]),
        np.array([*run.at(PLACES).values()]),
    )


@METHODS
def test_order_observed_through_impacts(name):
    """Equal steps without error control, of which each impact cuts one."""
    exact = observed(shaken("DOP853", rtol=1e-14, atol=1e-16))
    assert len(exact[0]) == 4
    counts = {"RK45": range(40, 160, 10), "DOP853": range(16, 40, 2)}[name]
    errors = [
        [
            np.sqrt(np.mean((found - expected) ** 2))
            for found, expected in zip(observed(shaken(name, steps_per_law=n)), exact, strict=True)
        ]
        for n in counts
    ]
    slopes = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    np.testing.assert_allclose(slopes, ORDER[name], atol=0.3)


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
