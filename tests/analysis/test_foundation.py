"""Mats on springs that only press: closed forms against springs counted one by one."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import rockeom as rk
from rockeom.analysis.formulas import foundation
from tests.refusals import refused

WEIGHT, B, BED, SPRING, SPACING = 3.0e5, 1.4, 2.5e7, 4.0e7, 0.8
ROTATIONS = np.array([-0.05, -1e-4, 0.0, 1e-3, 3.06e-3, 3.07e-3, 0.02, 0.3])
GROUND = {"shear_modulus": 2.0e7, "poisson_ratio": 0.3, "density": 1800.0}


def settled(force, reach):
    """Settlement of the mat's centre at which the springs bear the weight."""
    return brentq(lambda w: force(w) - WEIGHT, -reach, reach, xtol=1e-15, rtol=1e-15)


# -- moment and rotation


@pytest.mark.parametrize("rotation", ROTATIONS)
def test_winkler_bed_against_quadrature_over_its_springs(rotation):
    def pressed(power, settlement):
        edge = np.clip(-settlement / rotation, -B, B) if rotation else B
        return quad(
            lambda x: BED * max(settlement + rotation * x, 0.0) * x**power,
            -B, B, points=[edge], epsabs=1e-6, epsrel=1e-12, limit=200,
        )[0]  # fmt: skip

    w = settled(lambda w: pressed(0, w), 1.0 + 2 * abs(rotation) * B)
    found = foundation.winkler_moment(rotation, WEIGHT, BED, B)
    assert found == pytest.approx(pressed(1, w), rel=1e-8, abs=1e-7 * WEIGHT * B)


@pytest.mark.parametrize("rotation", ROTATIONS)
def test_two_springs_one_by_one(rotation):
    places = np.array([-SPACING, SPACING])

    def forces(w):
        return SPRING * np.maximum(w + rotation * places, 0.0)

    w = settled(lambda w: forces(w).sum(), 1.0)
    found = foundation.two_spring_moment(rotation, WEIGHT, SPRING, SPACING)
    assert found == pytest.approx((forces(w) * places).sum(), rel=1e-10, abs=1e-9 * WEIGHT)


def test_two_springs_of_the_engine_bear_the_same_moment():
    """Model B: the pushover's moment, less that of the leaning weight."""
    rigid = rk.TwoSpringStructure(
        mass=2.0e4, height=5.0, inertia=0.0, base_mass=0.0, base_height=0.0, base_inertia=0.0,
        half_width=SPACING, foundation_stiffness=SPRING, foundation_damping=0.0,
    )  # fmt: skip
    weight = 2.0e4 * rigid.gravity
    rotations = np.array([1e-5, 1e-3, 0.01])
    leaning = weight * 5.0 * np.tan(rotations)
    found = rigid.pushover(rotations) * 5.0 + leaning
    expected = foundation.two_spring_moment(rotations, weight, SPRING, SPACING)
    np.testing.assert_allclose(found, expected, rtol=2e-4)  # the exact one has sin(theta)


def test_uplift_is_where_the_curves_bend():
    theta = foundation.winkler_uplift_rotation(WEIGHT, BED, B)
    moment = foundation.winkler_moment(theta * np.array([1 - 1e-9, 1 + 1e-9]), WEIGHT, BED, B)
    np.testing.assert_allclose(moment, WEIGHT * B / 3, rtol=1e-8)
    step = 1e-6 * theta
    around = theta + step * np.array([-2, -1, 1, 2])
    m = foundation.winkler_moment(around, WEIGHT, BED, B)
    assert m[1] - m[0] == pytest.approx(m[3] - m[2], rel=1e-4)  # no kink in the bed's curve
    theta = foundation.two_spring_uplift_rotation(WEIGHT, SPRING, SPACING)
    assert foundation.two_spring_moment(theta, WEIGHT, SPRING, SPACING) == WEIGHT * SPACING


def test_stiff_ground_is_the_limit_of_the_others():
    rotation = np.array([-0.02, 0.001])
    rigid = foundation.rigid_moment(rotation, WEIGHT, B)
    np.testing.assert_allclose(foundation.winkler_moment(rotation, WEIGHT, 1e18, B), rigid, 1e-4)
    np.testing.assert_allclose(foundation.two_spring_moment(rotation, WEIGHT, 1e18, B), rigid)
    assert foundation.rigid_moment(0.0, WEIGHT, B) == 0.0


def test_arrays_broadcast():
    moments = foundation.winkler_moment(np.zeros((3, 1)) + 0.01, WEIGHT, [BED, 2 * BED], B)
    assert moments.shape == (3, 2)
    assert moments[0, 1] > moments[0, 0]


# -- coefficients of Table 2-2


def test_circular_mat_has_both_stiffnesses_of_the_half_space():
    mat = foundation.circular_mat(radius=2.0, **GROUND)
    g, nu, rho, radius = 2.0e7, 0.3, 1800.0, 2.0
    assert 2 * mat.stiffness == pytest.approx(4 * g * radius / (1 - nu))
    assert mat.rotational_stiffness == pytest.approx(8 * g * radius**3 / (3 * (1 - nu)))
    # Lysmer's analogue, 3.4 R^2 sqrt(rho G)/(1 - nu)
    assert 2 * mat.damping == pytest.approx(3.4 * radius**2 * np.sqrt(rho * g) / (1 - nu))


def test_springs_of_a_rectangular_mat_have_both_stiffnesses_of_its_winkler_bed():
    """The table's springs at b/sqrt(3): its K_z B_f has not even their dimension."""
    half_width = 1.5
    mat = foundation.rectangular_mat(half_width, 3.0, shape_factor=2.2, **GROUND)
    assert 2 * mat.stiffness == pytest.approx(2.0e7 / 0.7 * 2.2 * np.sqrt(3.0 * 6.0))
    bed = foundation.winkler_stiffness(mat.vertical_stiffness, half_width)
    turning = quad(lambda x: bed * x * x, -half_width, half_width)[0]
    assert mat.rotational_stiffness == pytest.approx(turning)
    again = foundation.winkler_stiffness_from_rotation(mat.rotational_stiffness, half_width)
    assert again == pytest.approx(bed)


def test_damping_of_a_rectangular_mat_is_that_of_the_circle_of_its_area():
    half_width, half_length = 1.5, 3.0
    radius = np.sqrt(4 * half_width * half_length / np.pi)
    mat = foundation.rectangular_mat(half_width, half_length, shape_factor=2.2, **GROUND)
    circle = foundation.circular_mat(radius, **GROUND)
    assert mat.damping == pytest.approx(circle.damping)


def test_similar_mats_scale_with_their_size():
    """Stiffness with the length, damping with the area: the dimensions of the coefficients."""
    one, two = (foundation.rectangular_mat(1.5 * f, 3.0 * f, 2.2, **GROUND) for f in (1.0, 2.0))
    assert two.stiffness / one.stiffness == pytest.approx(2.0)
    assert two.damping / one.damping == pytest.approx(4.0)
    assert two.half_spacing / one.half_spacing == pytest.approx(2.0)


def test_no_winkler_bed_has_both_stiffnesses_of_a_half_space():
    """Under a circle a bed of that vertical stiffness turns with K_z R^2/4; the half-space 2/3."""
    mat = foundation.circular_mat(radius=2.0, **GROUND)
    per_area = mat.vertical_stiffness / (np.pi * 2.0**2)
    turning = quad(lambda r: per_area * np.pi * r**3, 0.0, 2.0)[0]
    assert mat.rotational_stiffness / turning == pytest.approx(8 / 3)


# -- bad input


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: foundation.circular_mat(2.0, 2e7, 0.6, 1800.0), "poisson_ratio"),
        (lambda: foundation.circular_mat(-2.0, 2e7, 0.3, 1800.0), "radius"),
        (lambda: foundation.winkler_moment(np.nan, 1.0, 1.0, 1.0), "rotation"),
        (lambda: foundation.two_spring_moment(0.1, 1.0, 0.0, 1.0), "stiffness"),
    ],
)
def test_what_cannot_be_is_named(call, message):
    assert refused(call)[0] == message


def test_figure_of_the_three_interfaces():
    figures = pytest.importorskip("rockeom.thesis.figures")
    rigid, springs, bed = figures.FIGURES["2-8"]().axes[0].lines[:3]
    theta, moment = bed.get_xdata(), bed.get_ydata()
    up = theta > 1
    np.testing.assert_allclose(  # Yim and Chopra: M/M_up = 3 - 2 sqrt(theta_up/theta)
        3 * moment[up], 3 - 2 / np.sqrt(theta[up]), rtol=1e-12
    )
    assert np.all(rigid.get_ydata()[1:] == 1.0)
    first = theta <= 1
    np.testing.assert_allclose(springs.get_ydata()[first], moment[first], rtol=1e-12)
