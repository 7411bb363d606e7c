"""Motions of a page have the bits of machine code in every browser that is installed."""

import shutil

import numpy as np
import pytest

import rockeom as rk

from .browsers import BROWSERS, motions, native, random_places

PULSE = rk.GroundMotion.half_sine(4.0, 0.8, duration=5.0)
PAGES = {
    "block": rk.explorer(
        rk.Case(rk.RigidBlock(half_width=0.15, half_height=0.6), PULSE),
        {"half_width": (0.05, 0.4), "amplitude": (0.5, 8.0)},
    ),
    "block that slides": rk.explorer(
        rk.Case(
            rk.SlidingBlock(half_width=0.1, half_height=0.4, friction=0.3, restitution=0.1), PULSE
        ),
        {"friction": (0.1, 0.6), "amplitude": (0.5, 8.0)},
    ),
    "prism": rk.explorer(
        rk.Case(rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2e3), PULSE, azimuth=0.5),
        {"azimuth": (0.0, 1.5), "amplitude": (0.5, 8.0)},
    ),
}


@pytest.mark.parametrize("browser", BROWSERS)
@pytest.mark.parametrize("page", PAGES.values(), ids=PAGES)
def test_motions_have_the_bits_of_machine_code(page, browser):
    if not shutil.which(browser):
        pytest.skip(f"{browser} is not installed")
    places = random_places(page, 20)
    of_machine = native(page)
    for place, motion in zip(places, motions(page, places, browser), strict=True):
        wanted = of_machine(place)
        assert motion.outcome == motion.recorded == wanted["outcome"]
        np.testing.assert_array_equal(np.array(motion.readings, float), wanted["readings"])
