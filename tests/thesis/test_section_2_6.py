"""The impact as a force, beyond the checks of single equations."""

import pytest

from rockeom.thesis import EQUATIONS, notation as th
from rockeom.thesis.checks import section_2_6 as impact


def test_printed_force_overturns_the_block_of_figure_2_16():
    """With the minus the first impact adds energy, and the second throws it over."""
    (printed,) = EQUATIONS["2-27"].printed
    gain = float(impact.velocity_left(printed.rhs, 1).subs(th.r, impact.ENERGY_RATIO)) ** 2
    assert gain == pytest.approx(1 / impact.ENERGY_RATIO)
    assert (
        impact.potential(impact.RELEASE) * gain
        < impact.potential(1)
        < impact.potential(impact.RELEASE) * gain**2
    )


def test_function_of_the_velocity_without_its_sign_speeds_up_the_way_back():
    """2-26 as it stands is for one direction only: for the other it gives 1/r."""
    g = impact.right("2-26")
    forth, back = impact.velocity_left(g, 1), impact.velocity_left(g, -1)
    assert forth * back == 1
    assert forth == impact.velocity_left(impact.right("2-27"), -1)


def test_peaks_of_figure_2_16():
    assert impact.peaks_with_impacts(3)[1:] == pytest.approx([0.267, 0.184, 0.129], abs=5e-4)
