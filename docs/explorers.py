"""A page with sliders for each structure of the gallery, and of bodies in space.

They are written next to the built pages.
"""

import dataclasses
import tempfile
from pathlib import Path
from typing import Any

import gallery
import numpy as np
import trimesh

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


_DEGREE = np.pi / 180
_PROFILE = [  # radius and height of a statue of 1.7 m on its plinth [m]
    (0.0, 0.0), (0.3, 0.0), (0.3, 0.12), (0.26, 0.15), (0.22, 0.4), (0.17, 0.62), (0.16, 0.75),
    (0.19, 0.95), (0.21, 1.12), (0.18, 1.25), (0.09, 1.33), (0.08, 1.38), (0.11, 1.46),
    (0.12, 1.54), (0.09, 1.64), (0.0, 1.7),
]  # fmt: skip


def _scanned() -> rk.LeggedStatue:
    """A statue of marble by its mesh."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "statue.stl")
        trimesh.creation.revolve(_PROFILE, sections=72).export(file)
        feet = {"one": (0.2, 0.0), "two": (-0.1, 0.17), "three": (-0.1, -0.17)}  # m
        return rk.LeggedStatue.from_mesh(file, density=2700.0, feet=feet)  # kg/m3


_STATUE = _scanned()


def _statue(azimuth: Any, amplitude: Any, period: Any, feet: Any) -> rk.Case:
    """A statue on four feet under a pulse."""
    ways = {"east": (1, 0), "north": (0, 1), "west": (-1, 0), "south": (0, -1)}
    at = {name: (feet * x, 1.2 * feet * y) for name, (x, y) in ways.items()}
    statue = dataclasses.replace(_STATUE, feet=at)
    pulse = rk.GroundMotion.single_sine(amplitude, period, duration=6.0)
    return rk.Case(statue, pulse, azimuth=azimuth * _DEGREE)


def _column(direction: Any, amplitude: Any, period: Any, tilt: Any, radius: Any) -> rk.Case:
    """A column that leans under a pulse along x."""
    column = rk.WobblingColumn(radius=radius, height=4.0, mass=8000.0)  # m, kg
    pulse = rk.GroundMotion.single_sine(amplitude, period, duration=6.0)
    start = {"tilt": tilt * _DEGREE, "direction": direction * _DEGREE}
    return rk.Case(column, pulse, initial=start)


def _can(tilt: Any, precession: Any, spin: Any, radius: Any, height: Any) -> rk.Case:
    """A can that is let go on its rim."""
    can = rk.RollingCylinder(radius=radius, height=height, mass=0.35)  # m, kg
    start = can.on_rim(tilt * _DEGREE, precession=precession, spin=spin - precession)
    return rk.Case(can, rk.GroundMotion.none(2.0), initial=start)


_AZIMUTH = rk.Slider(0.0, 180.0, 25.0, "°")
_PULSE = {
    "amplitude": rk.Slider(0.5, 8.0, 3.0, "m/s2"),
    "period": rk.Slider(0.3, 2.0, 0.8, "s", "period of the pulse"),
}
_TILT = rk.Slider(1.0, 30.0, 12.0, "°", "tilt at first")
_RADIUS = rk.Slider(0.02, 0.06, 0.033, "m")
IN_SPACE = {
    "statue": (
        "A statue on four feet under a pulse",
        _statue,
        {"azimuth": _AZIMUTH, **_PULSE,
         "feet": rk.Slider(0.1, 0.24, 0.18, "m", "half of the base along x")},
    ),
    "wobbling_column": (
        "A column that wobbles under a pulse",
        _column,
        {"direction": rk.Slider(0.0, 180.0, 60.0, "°", "direction to which it leans at first"),
         **_PULSE, "tilt": rk.Slider(0.5, 6.0, 2.0, "°", "tilt at first"),
         "radius": rk.Slider(0.3, 0.8, 0.5, "m")},
    ),
    "can": (
        "A can let go on its rim",
        _can,
        {"tilt": _TILT, "precession": rk.Slider(0.1, 5.0, 0.5, "rad/s"),
         "spin": rk.Slider(-20.0, 20.0, 0.0, "rad/s", "spin about its axis, beyond rolling"),
         "radius": _RADIUS, "height": rk.Slider(0.05, 0.2, 0.12, "m")},
    ),
}  # fmt: skip
"""Title, case and sliders of the pages of bodies in space, to which the guides lead."""


def in_space(name: str) -> rk.Explorer:
    """The page of a body in space."""
    title, case, sliders = IN_SPACE[name]
    return rk.explorer(case, sliders, title)


def write(outdir: Path) -> None:
    """Write the pages of all structures."""
    folder = outdir / gallery.EXPLORERS
    folder.mkdir(parents=True, exist_ok=True)
    for name in SHIPPED:
        explorer_of(name).save(folder / f"{name}.html")
    for name in IN_SPACE:
        in_space(name).save(folder / f"{name}.html")
