"""Structures and supports from the numbers of engineering practice: periods, sections, soils."""

import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas

SOIL = {"shear_modulus": 30e6, "poisson_ratio": 0.3}
SIZE = {
    "mass": 200e3, "height": 10.0, "inertia": 0.0, "base_mass": 80e3, "base_height": 0.5,
    "base_inertia": 60e3, "half_width": 2.5,
}  # fmt: skip


def test_a_structure_has_the_period_and_the_damping_that_it_was_made_of():
    held = rk.FlexibleStructure.from_period(0.5, damping_ratio=0.05, **SIZE).fixed_base()
    assert held.periods == pytest.approx([0.5], rel=1e-9)
    assert held.damping_ratios == pytest.approx([0.05], rel=1e-9)
    with pytest.raises(ValueError, match=r"damping_ratio is 5: .* critical .* 0.05 for 5 %"):
        rk.FlexibleStructure.from_period(0.5, damping_ratio=5, **SIZE)


def test_a_cantilever_bends_by_the_integral_of_its_curvature():
    modulus, moment, length = 30e9, 0.0108, 6.0
    x = np.linspace(0.0, length, 20001)
    bent = np.trapezoid((length - x) ** 2, x) / (modulus * moment)  # principle of virtual work
    found = formulas.cantilever_stiffness(modulus, moment, length)
    assert found == pytest.approx(1 / bent, rel=1e-7)
    sheared = formulas.cantilever_stiffness(modulus, moment, length, shear_flexibility=1e-9)
    assert 1 / sheared == pytest.approx(bent + length * 1e-9, rel=1e-7)


@pytest.mark.parametrize("turned", [False, True])
def test_a_footing_has_the_stiffness_of_fema_356(turned):
    """Figure 4-4, surface stiffness: whole sides, B the lesser, rounded to two digits."""
    b, length = 2.0, 3.0
    half = (0.5 * length, 0.5 * b) if turned else (0.5 * b, 0.5 * length)
    found = formulas.rectangular_footing(*half, **SOIL)
    unit = SOIL["shear_modulus"] * b / 0.7
    assert found.vertical == pytest.approx(unit * (1.55 * (length / b) ** 0.75 + 0.8), rel=1e-9)
    about_y = unit * b**2 * (0.47 * (length / b) ** 2.4 + 0.034)
    about_x = unit * b**2 * (0.4 * (length / b) + 0.1)
    assert found.rotational == pytest.approx(about_y if turned else about_x, rel=0.01)


def test_a_square_footing_is_about_as_stiff_as_the_disc_of_its_area_or_its_inertia():
    """Boussinesq's and Borowicka's closed forms of a rigid disc, exact."""
    side = 2.0
    found = formulas.rectangular_footing(1.0, 1.0, **SOIL)
    by_area = formulas.circular_mat(side / math.sqrt(math.pi), density=1800.0, **SOIL)
    by_inertia = formulas.circular_mat((side**4 / (3 * math.pi)) ** 0.25, density=1800.0, **SOIL)
    assert found.vertical == pytest.approx(by_area.vertical_stiffness, rel=0.05)
    assert found.rotational == pytest.approx(by_inertia.rotational_stiffness, rel=0.02)


FOOTING = {"half_width": 1.2, "half_length": 2.0, "damping": 0.0}


@pytest.mark.parametrize("springs", [2, 5, 11])
def test_springs_of_a_soil_have_the_stiffness_of_the_footing(springs):
    footing = formulas.rectangular_footing(1.2, 2.0, **SOIL)
    places = 1.2 * np.linspace(-1.0, 1.0, springs)

    def bed(**given):
        if springs == 2:
            return rk.TwoSprings.from_soil(**FOOTING, **given)
        return rk.Winkler.from_soil(springs=springs, **FOOTING, **given)

    by_rotation, by_heave = bed(**SOIL), bed(match="heave", **SOIL)
    assert by_rotation.stiffness * (places**2).sum() == pytest.approx(footing.rotational)
    assert by_heave.stiffness * springs == pytest.approx(footing.vertical)
    elastic = {"youngs_modulus": 2 * 1.3 * SOIL["shear_modulus"], "poisson_ratio": 0.3}
    assert bed(**elastic).stiffness == pytest.approx(by_rotation.stiffness)


def test_a_structure_on_soil_turns_by_the_stiffness_of_its_footing():
    soil = rk.TwoSprings.from_soil(half_width=2.5, half_length=3.0, damping=0.0, **SOIL)
    pier = rk.FlexibleStructure.from_period(0.5, damping_ratio=0.0, support=soil, **SIZE)
    tilt = 1e-7
    weights = 9.81 * (SIZE["mass"] * SIZE["height"] + SIZE["base_mass"] * SIZE["base_height"])
    footing = formulas.rectangular_footing(2.5, 3.0, **SOIL)
    stiffness = 200e3 * (2 * math.pi / 0.5) ** 2
    force = pier.pushover(tilt)
    bent = SIZE["mass"] * 9.81 * force / stiffness  # the moment of the weight on a bent column
    assert force * SIZE["height"] + bent == pytest.approx(
        (footing.rotational - weights) * tilt, rel=1e-3
    )


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"youngs_modulus": 80e6}, "one of shear_modulus and youngs_modulus"),
        ({"shear_modulus": None}, "one of shear_modulus and youngs_modulus"),
        ({"poisson_ratio": 0.7}, "poisson_ratio is 0.7"),
        ({"match": "sliding"}, "rotation"),
        ({"half_width": -1.0}, "half_width is -1.0"),
        ({"damping": -1.0}, "damping is -1.0"),
    ],
)
def test_a_soil_that_cannot_be_is_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        rk.TwoSprings.from_soil(**(FOOTING | SOIL | wrong))
