"""A page with sliders for each structure of the gallery, written next to the built pages."""

from pathlib import Path

import gallery

import rockeom as rk
from rockeom.structures.classes import SHIPPED
from rockeom.sweeps.case_numbers import of_structure

MOST = 3
"""Numbers of the structure that a page moves, besides the amplitude of the pulse."""


def explorer_of(name: str) -> rk.Explorer:
    """The page of a shipped structure: its example in the gallery, shaken by a pulse."""
    structure, _ = gallery.sketched(name)
    of_time = "m/s2" in structure.module.PARAMETER_UNITS  # or times and accelerations have no unit
    amplitude = structure.uplift_acceleration or (3.5 if of_time else 0.3)
    period = 0.8 if of_time else 2.0
    most = 5.0 * amplitude
    while most < 20.0 * amplitude and not _overturns(structure, most, period):
        most *= 2.0
    case = rk.Case(
        structure, rk.GroundMotion.single_sine(1.5 * amplitude, period, duration=10.0 * period)
    )
    numbers = [
        (full.removeprefix("structure."), number.value)
        for full, number in of_structure(structure).items()
        if number.value and number.value > 0.0 and number.smooth and "gravity" not in full
    ]
    sliders = {
        "amplitude": (0.2 * amplitude, most, 1.5 * amplitude),
        **{n: (0.6 * x, 1.6 * x, x) for n, x in numbers[:MOST]},
    }
    return rk.explorer(case, sliders, f"{SHIPPED[name].__name__} under a pulse")


def _overturns(structure: rk.Structure, amplitude: float, period: float) -> bool:
    """Whether a pulse overturns it, so that the map of its page shows both fates."""
    pulse = rk.GroundMotion.single_sine(amplitude, period, duration=10.0 * period)
    return str(rk.simulate(structure, pulse).outcome) == "overturned"


def write(outdir: Path) -> None:
    """Write the pages of all structures."""
    folder = outdir / gallery.EXPLORERS
    folder.mkdir(parents=True, exist_ok=True)
    for name in SHIPPED:
        explorer_of(name).save(folder / f"{name}.html")
