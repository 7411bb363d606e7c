"""Quarter periods: elliptic integrals of many digits, simulations, and the limits between them."""

import math

import mpmath as mp
import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas
from tests.refusals import refused


def quadrature(theta_0, alpha, p):
    """Time of the fall by the integral of dtheta/theta_dot, 30 digits."""
    with mp.workdps(40):
        t0, al = mp.mpf(theta_0), mp.mpf(alpha)

        # theta = theta_0 - u**2 takes away the singularity at the turning point
        def integrand(u):
            x = u**2 / 2
            # theta_dot**2 = 2 p**2 (cos(alpha - theta_0) - cos(alpha - theta)), as a product
            return 2 * u / mp.sqrt(4 * mp.sin(al - t0 + x) * mp.sin(x))

        return mp.quad(integrand, mp.linspace(0, mp.sqrt(t0), 5)) / mp.mpf(p)


def elliptic(theta_0, alpha, p):
    """The same by Legendre's integrals, 30 digits after their cancellation."""
    with mp.workdps(60):
        t0, al = mp.mpf(theta_0), mp.mpf(alpha)
        k = mp.cos((al - t0) / 2)
        return (mp.ellipk(k**2) - mp.ellipf(mp.asin(mp.cos(al / 2) / k), k**2)) / mp.mpf(p)


@pytest.mark.parametrize("alpha", [0.01, 0.2, 1.0, 1.5])
@pytest.mark.parametrize("ratio", [1e-3, 0.3, 0.95])
def test_nonlinear_block_against_quadrature(alpha, ratio):
    theta_0 = ratio * alpha
    exact = quadrature(theta_0, alpha, 3.0)
    assert formulas.exact_quarter_period(theta_0, alpha, 3.0) == pytest.approx(
        float(exact), rel=2e-15, abs=0
    )


@pytest.mark.parametrize("alpha", [0.05, 0.2, 1.0, 1.5])
def test_nonlinear_block_from_tiny_rotations_to_the_balance(alpha):
    peaks = np.array([1e-8, 1e-6, 0.5 * alpha, *(alpha * (1 - 10.0**-n) for n in (3, 6, 9, 12))])
    exact = [float(elliptic(peak, alpha, 2.0)) for peak in peaks]
    np.testing.assert_allclose(formulas.exact_quarter_period(peaks, alpha, 2.0), exact, rtol=1e-15)


@pytest.mark.parametrize("ratio", [1e-12, 1e-8, 1e-3, 0.49, 0.51, 1 - 1e-6, 1 - 1e-12])
def test_slender_block_keeps_all_digits(ratio):
    with mp.workdps(40):
        exact = float(mp.acosh(1 / (1 - mp.mpf(ratio))) / 2)
    assert formulas.quarter_period(ratio, 2.0) == pytest.approx(exact, rel=1e-15, abs=0)
    assert formulas.rocking_period(ratio, 2.0) == 4 * formulas.quarter_period(ratio, 2.0)


def test_first_impact_of_simulations():
    p, alpha, release = 2.14, 0.25, 0.2
    quiet = rk.GroundMotion.none(3.0)
    impacts = [
        rk.simulate(kind.from_frequency(p=p, alpha=alpha), quiet, initial={"theta": release})
        .impacts[0]
        .time
        for kind in (rk.RigidBlock, rk.SlenderBlock)
    ]
    assert impacts[0] == pytest.approx(formulas.exact_quarter_period(release, alpha, p), rel=1e-9)
    assert impacts[1] == pytest.approx(formulas.quarter_period(release / alpha, p), rel=1e-9)


def test_slender_formula_of_a_slender_block_and_how_far_it_is_off():
    slender = np.array([1e-4, 1e-3])
    np.testing.assert_allclose(
        formulas.exact_quarter_period(0.4 * slender, slender, 1.0),
        formulas.quarter_period(0.4, 1.0),
        rtol=1e-6,
    )
    # The block of chapter 3: too short by sqrt(alpha/sin(alpha)) for small rotations, less above.
    alpha = math.atan2(0.095, 0.4549)
    ratios = np.linspace(1e-6, 0.999, 200)
    short = 1 - formulas.quarter_period(ratios, 1.0) / formulas.exact_quarter_period(
        ratios * alpha, alpha, 1.0
    )
    assert short[0] == pytest.approx(1 - math.sqrt(math.sin(alpha) / alpha), rel=1e-4)
    assert short.max() == short[0] < 0.0036
    assert short.min() > 0


def test_no_rotation_takes_no_time_and_arrays_broadcast():
    assert formulas.quarter_period(0.0, 2.0) == 0
    assert formulas.exact_quarter_period(0.0, 0.2, 2.0) == 0
    times = formulas.exact_quarter_period([[0.05], [0.1]], [0.15, 0.2, 0.3], 2.0)
    assert times.shape == (2, 3)
    assert times[1, 2] == formulas.exact_quarter_period(0.1, 0.3, 2.0)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: formulas.quarter_period([0.5, 1.0], 2.0), "amplitude_ratio[1]"),
        (lambda: formulas.rocking_period(-0.1, 2.0), "amplitude_ratio"),
        (lambda: formulas.quarter_period(0.5, 0.0), "p"),
        (lambda: formulas.exact_quarter_period(0.2, 0.2, 2.0), "theta_0"),
        (lambda: formulas.exact_quarter_period(0.2, 2.0, 2.0), "alpha"),
        (lambda: formulas.exact_quarter_period(math.nan, 0.3, 2.0), "theta_0"),
        (lambda: formulas.quarter_period("half", 2.0), "amplitude_ratio"),
    ],
)
def test_impossible_input_is_refused(call, message):
    assert refused(call)[0] == message
