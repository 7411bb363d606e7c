"""Forty objects that stand free, for `benchmarks.plane_or_space`: sizes, and why each is there.

Sizes are of such objects as one meets, none is a survey. No foot slips.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

import rockeom as rk

Place = tuple[float, float]
_NAMES = "one", "two", "three", "four", "five", "six", "seven", "eight"
"""Names of feet: as few declarations as there are numbers of feet."""


class Object(NamedTuple):
    """An object, its structure, its size in words, and why it is among the forty."""

    name: str
    structure: rk.Structure
    size: str
    reason: str


def prism(name: str, sizes: Sequence[float], mass: float, reason: str, **others: float) -> Object:
    """A block; sizes : width, depth and height [m]."""
    width, depth, height = sizes
    body = rk.Prism(width=width, depth=depth, height=height, mass=mass, **others)
    centroid = body.parameters()["centroid_height"]
    off = body.offset_x, body.offset_y
    size = f"{width:g} × {depth:g} × {height:g} m"
    size += f", centroid at {centroid:g} m" * (centroid != height / 2)
    size += f", off by {off[0]:g} and {off[1]:g} m" * any(off)
    return Object(name, body, f"{size}; {mass:g} kg", reason)


def column(name: str, sizes: Sequence[float], mass: float, reason: str, **others: float) -> Object:
    """A round body; sizes : radius of its base, and height [m]."""
    radius, height = sizes
    body = rk.WobblingColumn(radius=radius, height=height, mass=mass, **others)
    centroid = body.parameters()["centroid_height"]
    size = f"base of radius {radius:g} m, {height:g} m high, centroid at {centroid:.3g} m"
    return Object(name, body, f"{size}; {mass:g} kg", reason)


def on_feet(
    name: str, feet: Sequence[Place], sizes: Sequence[float], mass: float, reason: str,
    centroid: tuple[float, float, float],
) -> Object:  # fmt: skip
    """A body on feet (x, y) [m]; sizes : of the box that has its moments of inertia [m]."""
    squares = np.square(sizes)
    inertia = mass / 12.0 * np.diag(squares.sum() - squares)
    named: Mapping[str, Place] = dict(zip(_NAMES, feet, strict=False))
    body = rk.LeggedStatue(feet=named, centroid=centroid, mass=mass, inertia=inertia)
    at = ", ".join(f"{x:g}" for x in centroid)
    box = " × ".join(f"{x:g}" for x in sizes)
    size = f"{len(feet)} feet, centroid at ({at}) m, inertia of {box} m; {mass:g} kg"
    return Object(name, body, size, reason)


def ring(number: int, radius: float, first: float = 0.0) -> list[Place]:
    """Places of feet at even distances on a circle; first : azimuth of the first one [degrees]."""
    angles = np.radians(first + 360.0 / number * np.arange(number))
    return [(round(radius * np.cos(a), 4), round(radius * np.sin(a), 4)) for a in angles]


def corners(width: float, depth: float) -> list[Place]:
    """Places of four feet."""
    x, y = width / 2, depth / 2
    return [(-x, -y), (x, -y), (x, y), (-x, y)]


_STATUES = [
    prism("marble figure", (0.50, 0.55, 1.80), 850.0, "nearly square plinth", centroid_height=0.85),
    prism("kouros", (0.40, 0.45, 2.00), 700.0, "slender, nearly square"),
    prism("herm", (0.28, 0.28, 1.60), 310.0, "square: two equal edges", centroid_height=0.90),
    prism("seated figure", (0.60, 0.80, 1.50), 900.0, "heavy at the back", offset_y=-0.10,
          centroid_height=0.70),
    prism("relief slab", (0.22, 1.10, 1.50), 800.0, "a plate: one weak direction"),
    on_feet("equestrian bronze", [(0.75, 0.0), (-0.65, -0.28), (-0.65, 0.28)], (1.9, 0.6, 1.6),
            900.0, "three hooves, long and narrow", (0.0, 0.0, 1.30)),
    on_feet("striding bronze", corners(0.50, 0.34), (0.4, 0.4, 1.7), 240.0,
            "centroid towards a corner", (0.06, 0.05, 0.95)),
    on_feet("discus thrower", ring(3, 0.30), (0.6, 0.4, 1.5), 180.0, "three points, off the middle",
            (0.05, 0.03, 0.80)),
    on_feet("statuette", ring(3, 0.055), (0.09, 0.09, 0.30), 4.0, "small, on three feet",
            (0.0, 0.0, 0.15)),
]  # fmt: skip

_FURNITURE = [
    prism("server rack", (0.60, 1.00, 2.00), 700.0, "weak one way only", centroid_height=0.95),
    prism("filing cabinet", (0.46, 0.62, 1.32), 120.0, "open drawers are its front",
          offset_y=0.06),
    prism("bookcase", (0.90, 0.30, 2.00), 220.0, "flat, heavy in front", offset_y=0.02),
    prism("wardrobe", (1.20, 0.60, 2.10), 180.0, "twice as wide as deep"),
    prism("refrigerator", (0.60, 0.65, 1.80), 80.0, "nearly square", centroid_height=0.85),
    prism("longcase clock", (0.50, 0.28, 2.10), 60.0, "heavy at the top", centroid_height=1.15),
    prism("display case", (0.60, 0.60, 1.60), 140.0, "square, heavy at the top",
          centroid_height=1.00),
    prism("vending machine", (0.90, 0.80, 1.83), 350.0, "centroid off both middles", offset_x=0.05,
          offset_y=0.08),
]  # fmt: skip

_STONES = [
    prism("gravestone", (0.60, 0.12, 0.90), 170.0, "a plate"),
    prism("thick gravestone", (0.50, 0.25, 1.00), 330.0, "twice as wide as thick"),
    prism("grave pillar", (0.35, 0.35, 1.20), 380.0, "square"),
    prism("obelisk", (0.60, 0.60, 3.20), 1900.0, "square, tapered", centroid_height=1.25),
    prism("stone cross", (0.55, 0.32, 2.10), 520.0, "heavy at the top", centroid_height=1.15),
    prism("runestone", (0.90, 0.30, 2.20), 1500.0, "off its middle both ways", offset_x=0.08,
          offset_y=0.03),
]  # fmt: skip

_ROUND = [
    column("marble column", (0.30, 3.00), 2250.0, "round, b/H of 1/5"),
    column("temple column", (0.75, 6.50), 28000.0, "large", top_radius=0.60),
    column("milestone", (0.28, 1.80), 1150.0, "round, stocky"),
    column("round pedestal", (0.22, 1.05), 420.0, "round, stockier"),
    column("gas cylinder", (0.115, 1.50), 65.0, "round, slender"),
    column("amphora", (0.07, 0.60), 9.0, "narrow foot below a wide body",
           centroid_height=0.33, inertia_xx=0.30, inertia_zz=0.12),
    column("vase", (0.06, 0.35), 2.5, "small", centroid_height=0.17),
]  # fmt: skip

_BOULDERS = [
    on_feet("boulder on three points", [(0.42, 0.05), (-0.25, 0.33), (-0.20, -0.36)],
            (1.1, 0.9, 1.2), 1900.0, "as few points as can be", (0.0, 0.0, 0.62)),
    on_feet("boulder on four points", [(0.40, -0.22), (0.34, 0.30), (-0.36, 0.26), (-0.30, -0.31)],
            (1.2, 1.0, 1.5), 2700.0, "no two edges alike", (0.03, -0.02, 0.78)),
    on_feet("balanced rock", [(0.30, -0.12), (0.22, 0.20), (-0.12, 0.26), (-0.30, 0.02),
                              (-0.08, -0.26)],
            (1.3, 1.1, 1.9), 3600.0, "five points, slender", (0.02, 0.01, 1.05)),
]  # fmt: skip

_EQUIPMENT = [
    prism("museum pedestal", (0.40, 0.40, 1.10), 70.0, "square, a bust on top",
          centroid_height=0.75),
    on_feet("analyser", corners(0.62, 0.50), (0.7, 0.6, 1.3), 160.0, "four feet, off the middle",
            (0.05, 0.04, 0.70)),
    on_feet("cryostat", corners(0.50, 0.50), (0.6, 0.6, 1.5), 210.0, "round on four feet",
            (0.0, 0.0, 0.80)),
    on_feet("centrifuge", ring(3, 0.28), (0.5, 0.5, 0.7), 95.0, "three feet", (0.0, 0.0, 0.45)),
    on_feet("microscope", corners(0.22, 0.30), (0.2, 0.3, 0.45), 14.0, "heavy at the back",
            (0.0, -0.04, 0.24)),
    on_feet("infusion stand", ring(5, 0.30, 90.0), (0.25, 0.25, 1.7), 9.0, "five feet",
            (0.0, 0.0, 0.75)),
    on_feet("telescope", ring(3, 0.50, 30.0), (0.5, 0.5, 1.2), 38.0, "high on three legs",
            (0.04, 0.0, 1.15)),
]  # fmt: skip

OBJECTS: Sequence[Object] = [*_STATUES, *_FURNITURE, *_STONES, *_ROUND, *_BOULDERS, *_EQUIPMENT]
