"""Tests of a boulder on a shaking table, predicted in space and in the plane.

    python -m benchmarks.boulders fit FOLDER                        # an hour; stores its outcomes
    python -m benchmarks.boulders scores FOLDER --write docs/validation.md   # ten minutes

FOLDER has the tests, see `rockeom.analysis.validation.BoulderTests`. `fit` simulates all tests with
each draw from the priors below, and stores the outcomes in boulders.json beside this file, with
the date; what is stored has nothing of the measurements. `scores` simulates the first draws again,
weighs the stored ones by the tests of four folds to predict the fifth, and writes the tables and
the picture of docs/validation.md.

What is not known of the tests, and its prior, was written down before the first score:

    direction against the axis of the table    uniform, of each specimen
    height within which the surface bears      uniform, 0.5 to 5 mm
    error of the scan, of each vertex          normal, its deviation uniform, 1 to 3 mm
    friction                                   feet never slip; `friction` compares 0.4 to 0.8
    mass                                       353.8 kg as stated, which no outcome depends on
    motion below 2 Hz                          of the displacement, see `BoulderTests.motion`

Each draw turns its surface onto the face on which it rests. Impacts do not rebound. In the plane
the same draw is an `OffsetBlock` across its weakest edge, shaken along the weakest direction.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh

import rockeom as rk
from rockeom.analysis.validation import BoulderTests
from rockeom.modelling.mesh import MeshBody, read_body, settled, support_points

STORED = Path(__file__).with_suffix(".json")
SPECIMENS = ("specimen_1", "specimen_2")
MASS = 353.8  # kg, as stated
BEARING = (0.5e-3, 5e-3)  # m
SCAN_ERROR = (1e-3, 3e-3)  # m
FRICTION = (0.4, 0.8)
SEED = 582
DRAWS, MORE_DRAWS = 30, 120
WRONG = 0.1  # part of the tests that one draw is expected to get wrong, as the weights have it
METHOD = rk.SolverOptions(method="RK45")  # steps end at the samples anyway
ANGLES, SIZES = (3, 4, 5, 6, 8, 10, 12), (0.1, 0.2, 0.3, 0.4, 0.6)  # degrees, m, of the plane


# -- what is drawn -------------------------------------------------------------------------------


class Draw(NamedTuple):
    """A boulder from the priors."""

    boulder: rk.Boulder
    plane: rk.OffsetBlock
    azimuth: float  # rad
    friction: float


def draw(surface: MeshBody, specimen: str, number: int) -> Draw:
    """The draw of a number; draws of two numbers, or specimens, are independent."""
    rng = np.random.default_rng([SEED, SPECIMENS.index(specimen), number])
    azimuth, bearing = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(*BEARING)
    error, friction = rng.uniform(*SCAN_ERROR), rng.uniform(*FRICTION)
    outward = trimesh.Trimesh(surface.vertices, surface.faces, process=False).vertex_normals
    moved = surface.vertices + outward * rng.normal(0.0, error, len(outward))[:, None]
    body = settled(surface._replace(vertices=moved))
    feet = support_points(body, bearing, "draw")
    boulder = rk.Boulder(
        feet=feet, mass=body.mass, centroid=tuple(body.centroid.tolist()), inertia=body.inertia
    )
    return Draw(boulder, weakest(boulder), azimuth, friction)


def weakest(boulder: rk.Boulder) -> rk.OffsetBlock:
    """The block in the plane across the edge nearest to the centroid."""
    feet = np.array([place for _, place in boulder.feet]) - boulder.centroid[:2]
    edges = np.roll(feet, -1, axis=0) - feet
    normals = np.column_stack([edges[:, 1], -edges[:, 0]])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    nearest = np.argmin((normals * feet).sum(axis=1))
    across = feet @ normals[nearest]
    x, y = normals[nearest]
    inertia = np.array([-y, x, 0.0]) @ np.asarray(boulder.inertia) @ np.array([-y, x, 0.0])
    middle = (across.max() + across.min()) / 2
    return rk.OffsetBlock(
        half_width=np.ptp(across) / 2, half_height=boulder.centroid[2], offset=-middle,
        mass=boulder.mass, inertia=float(inertia),
    )  # fmt: skip


# -- outcomes ------------------------------------------------------------------------------------


def overturned(case: rk.Case, motions: rk.MotionSet) -> np.ndarray:
    """Whether each motion overturns the structure of a case (n,)."""
    how = rk.SweepOptions(threads=2, progress=False)
    found = rk.simulate_many(case, {"motion": motions}, options=METHOD, sweep_options=how)
    outcomes = found["outcome"].to_numpy()
    if odd := set(np.unique(outcomes)) - {"overturned", "completed", "came to rest"}:
        counts = {name: int((outcomes == name).sum()) for name in odd}
        print(f"  {type(case.structure).__name__}: {counts} count as standing", file=sys.stderr)
    return outcomes == "overturned"


def simulated(tests: BoulderTests, treatment: str, draws: Sequence[int]) -> dict:
    """Outcomes (draws, n) of each specimen, in space and in the plane."""
    motions = rk.MotionSet(tests.motion(i, treatment) for i in range(len(tests.tests)))
    found: dict = {"space": {}, "plane": {}}
    for specimen in SPECIMENS:
        surface = read_body(tests.surfaces[specimen], MASS, None, 1.0)
        space, plane = [], []
        for number in draws:
            drawn = draw(surface, specimen, number)
            print(f"{specimen}, draw {number}: {len(drawn.boulder.feet)} points", file=sys.stderr)
            case = rk.Case(drawn.boulder, motions[0], azimuth=drawn.azimuth)
            space.append(overturned(case, motions))
            plane.append(overturned(rk.Case(drawn.plane, motions[0]), motions))
        found["space"][specimen], found["plane"][specimen] = np.array(space), np.array(plane)
    return found
