"""Radau IIA, for stiff systems: its coefficients, its order, and what it is for."""

import itertools

import numpy as np
import pytest

import rockeom as rk
from rockeom.integrator.methods.radau import radau
from tests.refusals import refuses

from .test_tableaux import of_impacts, shaken, slopes, stage_values, trees, worst

TWO_MASSES = {
    "mass": 500.0, "height": 1.5, "inertia": 100.0, "base_mass": 300.0, "base_height": 0.2,
    "base_inertia": 20.0, "half_width": 0.4,
}  # fmt: skip
MASS = TWO_MASSES["mass"] + TWO_MASSES["base_mass"]


def on_springs(stiffness, damping):
    return rk.TwoSpringStructure(
        **TWO_MASSES, foundation_stiffness=stiffness, foundation_damping=damping
    )


def options(rtol, atol=None, method="Radau", **others):
    return rk.SolverOptions(
        method=method, rtol=rtol, atol=rtol * 1e-2 if atol is None else atol, **others
    )


# -- coefficients


def test_every_order_condition():
    method = radau()
    a, b = method.a[:4, :4], method.b
    assert worst(b, a, 5) < 1e-14
    assert worst(b, a, 6) > 1e-6  # and not one order more: the check can fail


def test_coefficients_are_those_of_the_book():
    """Hairer and Wanner, table IV.5.6 and the estimate of the error (IV.8.19)."""
    root = np.sqrt(6)
    a = radau().a[1:4, 1:4]
    book = [
        [(88 - 7 * root) / 360, (296 - 169 * root) / 1800, (-2 + 3 * root) / 225],
        [(296 + 169 * root) / 1800, (88 + 7 * root) / 360, (-2 - 3 * root) / 225],
        [(16 - root) / 36, (16 + root) / 36, 1 / 9],
    ]
    np.testing.assert_allclose(a, book, rtol=0, atol=1e-16)
    g, *others = radau().errors[0][:4]
    assert g == pytest.approx((6 + 81 ** (1 / 3) - 9 ** (1 / 3)) / 30, rel=1e-14)
    by_increments = np.linalg.solve(a.T, others)
    np.testing.assert_allclose(
        by_increments, g / 3 * np.array([-13 - 7 * root, -13 + 7 * root, -1]), rtol=1e-13
    )


def test_error_estimate_is_of_order_three():
    method = radau()
    full, a = method.errors[0], method.a
    lacks = [max(abs(full @ stage_values(t, a)) for t in trees(n)) for n in (1, 2, 3, 4)]
    assert max(lacks[:3]) < 1e-14
    assert lacks[3] > 1e-3


@pytest.mark.parametrize("x", [0.1, 0.5, 0.81, 1.0])
def test_dense_output_is_of_order_three(x):
    method = radau()
    assert worst(method.dense @ x ** np.arange(1, 4), method.a, 3, x) < 1e-14


def test_stable_for_all_decays_and_stiff_ones_vanish():
    """|R(z)| <= 1 on the imaginary axis, R(-inf) = 0; R(z) = det(I - z a + z 1 b)/det(I - z a)."""
    a, b = radau().a[1:4, 1:4], radau().b[1:4]

    def growth(z):
        return 1 + z * b @ np.linalg.solve(np.eye(3) - z * a, np.ones(3))

    assert max(abs(growth(1j * y)) for y in np.logspace(-3, 6, 200)) <= 1 + 1e-13
    assert abs(growth(-1e8)) < 1e-7


# -- order and tolerance, in motion


def test_order_observed_through_impacts():
    """Equal steps without error control: times of the impacts, and rates after them."""
    exact = of_impacts(shaken("DOP853", rtol=1e-14, atol=1e-16))
    assert len(exact[0]) == 7

    def found(n):
        return of_impacts(shaken("Radau", rtol=1e-13, atol=1e-15, steps_per_segment=n))

    np.testing.assert_allclose(slopes(range(30, 120, 6), found, exact), 5, atol=0.3)


def test_dense_output_observed():
    """Of order four between the steps: one more than it has for rates that are not smooth."""
    places = np.linspace(0.01, 0.65, 37)  # before the first impact
    exact = (np.array([*shaken("DOP853", rtol=1e-14, atol=1e-16).at(places).values()]),)

    def found(n):
        run = shaken("Radau", rtol=1e-13, atol=1e-15, steps_per_segment=n)
        return (np.array([*run.at(places).values()]),)

    np.testing.assert_allclose(slopes(range(30, 120, 6), found, exact), 4, atol=0.3)


def test_error_follows_the_tolerance():
    exact = of_impacts(shaken("DOP853", rtol=1e-14, atol=1e-16))
    errors = []
    for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
        times, _ = of_impacts(shaken("Radau", rtol=rtol, atol=rtol * 1e-2))
        errors.append(np.abs(times - exact[0]).max())
    assert errors[-1] < 1e-11
    assert all(later < earlier / 10 for earlier, later in itertools.pairwise(errors))


@pytest.mark.parametrize("theta", [0.1, 0.29])
def test_steps_in_which_newton_fails_are_cut(theta):
    """Equal steps, far too long: what is recorded has the block's rate at the Radau points."""
    p, alpha, duration = 2.0, 0.3, 2.0
    run = rk.simulate(
        rk.RigidBlock.from_frequency(p=p, alpha=alpha),
        rk.GroundMotion.none(duration),
        initial={"theta": theta},
        options=options(1e-8, steps_per_segment=1),
    )
    assert run.steps.span[0, 1] < duration
    c = radau().c[1:4]
    for (_, h), powers in zip(run.steps.span, run.steps.powers, strict=True):
        place, velocity = (np.polynomial.Polynomial(powers[:, i]) for i in range(2))
        expected = -(p**2) * np.sin(np.sign(place(0.5)) * alpha - place(c))
        np.testing.assert_allclose(velocity.deriv()(c) / h, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("structure", "impact"),
    [
        (rk.RigidBlock.from_frequency(p=2.14, alpha=0.25), None),
        (rk.FlexibleStructure(**TWO_MASSES, stiffness=6e5, damping=500.0), rk.Impulsive()),
    ],
    ids=["rigid_block", "flexible_structure"],
)
def test_free_decay_through_impacts(structure, impact):
    """The times of the first impacts, against an explicit method."""
    runs = [
        rk.simulate(
            structure,
            rk.GroundMotion.none(4.0),
            impact=impact,
            initial={"theta": 0.1},
            options=options(rtol, method=method),
        )
        for method, rtol in (("DOP853", 1e-13), ("Radau", 1e-9))
    ]
    explicit, implicit = ([e.time for e in run.impacts[:6]] for run in runs)
    assert len(explicit) == 6
    np.testing.assert_allclose(implicit, explicit, rtol=0, atol=1e-8)


# -- stiff systems


@pytest.mark.parametrize(
    ("stiffness", "damping", "rtol", "worst_error", "most_steps"),
    [
        (1e9, 1e4, 1e-8, 1e-9, None),
        (1e9, 3e6, 1e-8, 1e-10, 2000),
        (1e12, 1e11, 1e-8, 1e-10, 500),  # rates of 10 and 2.5e8 1/s: in 0.3 s
    ],
    ids=["vibrates", "creeps", "creeps_in_oil"],
)
def test_heave_on_springs_in_closed_form(stiffness, damping, rtol, worst_error, most_steps):
    """m z'' + 2 c z' + 2 k z = 0 from rest, a fraction of the settlement above it."""
    start = 1.0 / stiffness
    root = np.sqrt(complex(damping**2 - 2 * stiffness * MASS))
    # the slow one as a quotient: the difference would cancel
    exponents = np.array([-2 * stiffness / (damping + root), -(damping + root) / MASS])
    factors = np.linalg.solve(np.array([np.ones(2), exponents]), [start, 0.0])
    duration = min(0.3, 10 / abs(exponents[0].real))
    run = rk.simulate(
        on_springs(stiffness, damping),
        rk.GroundMotion.none(duration),
        initial={"heave": start},
        options=options(rtol, rtol * 1e-2 * start),
    )
    assert not run.events
    t = run.steps.span[:, 0]
    exact = (factors @ np.exp(np.outer(exponents, t))).real
    assert np.abs(run.at(t)["heave"] - exact).max() < worst_error * start
    if most_steps:
        assert run.statistics["steps"] < most_steps


STIFF = on_springs(1e9, 1e8)
LIFTING = rk.GroundMotion.single_sine(4.0, 1.0, duration=2.0)


def stiff_run(method, rtol, motion=LIFTING, **others):
    return rk.simulate(STIFF, motion, options=options(rtol, method=method), **others)


def test_heavily_damped_springs_that_lift_off():
    """A rate of 2.5e5 1/s: explicit steps are bound to it; both errors stay below 1e-6."""
    t = np.linspace(0.0, 2.0, 401)
    exact = np.array([*stiff_run("DOP853", 1e-12).at(t).values()])
    steps = {}
    for method in ("DOP853", "Radau"):
        run = stiff_run(method, 1e-8)
        assert len(run.events) > 10
        error = np.abs(np.array([*run.at(t).values()]) - exact)
        assert (error.max(axis=1) < 1e-6 * np.abs(exact).max(axis=1)).all()
        steps[method] = run.statistics["steps"]
    assert steps["DOP853"] > 20 * steps["Radau"]


def test_error_follows_the_tolerance_on_stiff_springs():
    t = np.linspace(0.0, 2.0, 401)
    exact = stiff_run("DOP853", 1e-12).at(t)["theta"]
    errors = [
        np.abs(stiff_run("Radau", rtol).at(t)["theta"] - exact).max()
        for rtol in (1e-6, 1e-8, 1e-10)
    ]
    assert errors[-1] < 1e-12
    assert all(later < earlier / 10 for earlier, later in itertools.pairwise(errors))


def test_mirror_image_to_the_last_bit():
    run, image = (
        stiff_run("Radau", 1e-7, motion, initial={"theta": tilt})
        for motion, tilt in ((LIFTING, 1e-5), (-LIFTING, -1e-5))
    )
    assert len(run.events) > 10
    np.testing.assert_array_equal(image.t, run.t)
    for name in run.states:
        even = name.startswith("heave")
        np.testing.assert_array_equal(image[name], run[name] if even else -run[name])


# -- one method among others


def test_motions_of_an_ensemble_are_those_by_themselves():
    """They share the scratch of a step: nothing in it may reach from one motion to the next."""
    block = rk.RigidBlock.from_frequency(p=2.0, alpha=0.3)

    def case(amplitude):
        motion = rk.GroundMotion.single_sine(amplitude, 1.2, duration=4.0)
        return rk.Case(block, motion, rk.VelocityRatio(0.9), {"theta": 0.1})

    amplitudes = [1.5, 3.0, 2.0]
    many = rk.simulate_many(
        case,
        over={"amplitude": amplitudes},
        impact_times=3,
        options=options(1e-8),
        sweep_options=rk.SweepOptions(threads=1),
    )
    for n, amplitude in enumerate(amplitudes):
        alone = case(amplitude)
        run = rk.simulate(
            block, alone.motion, impact=alone.impact, initial=alone.initial, options=options(1e-8)
        )
        times = [impact.time for impact in run.impacts[:3]]
        assert len(times) == 3
        np.testing.assert_array_equal(many["impact_time"].values[n], times)


def test_lanes_know_no_implicit_method():
    block = rk.RigidBlock.from_frequency(p=2.0, alpha=0.3)
    motion = rk.GroundMotion.from_array(np.zeros(20), 0.1)
    with refuses("lanes", True):
        rk.simulate_many(
            lambda theta: rk.Case(block, motion, initial={"theta": theta}),
            over={"theta": [0.1]},
            options=options(1e-8, steps_per_segment=1),
            sweep_options=rk.SweepOptions(lanes=True),
        )
