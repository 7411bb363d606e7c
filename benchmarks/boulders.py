"""Tests of a boulder on a shaking table, predicted in space and in the plane.

    python -m benchmarks.boulders fit FOLDER            # an hour; stores the outcomes that lack
    python -m benchmarks.boulders scores FOLDER --write docs/validation.md     # three minutes

FOLDER has the tests, see `rockeom.analysis.validation.BoulderTests`. `fit` simulates all tests
with each draw from the priors below, and stores the outcomes in boulders.json beside this file,
with the date; what is stored has nothing of the measurements. Draws that are stored stay: after a
change of the equations remove the file. `scores` simulates the first draws again to compare them,
weighs all by the tests of four folds to predict the fifth, and writes the tables and the picture of
docs/validation.md.

The unknowns of the tests, and their priors, were written down before the first score:

    direction against the axis of the table    uniform, of each specimen
    height within which the surface bears      uniform, 0.5 to 5 mm
    error of the scan, of each vertex          normal, its deviation uniform, 1 to 3 mm
    friction                                   feet never slip; `friction` compares 0.4 to 0.8
    mass                                       353.8 kg as stated, which no outcome depends on
    motion below 2 Hz                          of the displacement, see `BoulderTests.motion`

Each draw turns its surface onto the face on which it rests. Impacts do not rebound. The first model
stood on the corners of what bears, put into one plane ("level points"), and its planar block is an
`OffsetBlock` across its weakest edge, shaken along the weakest direction. After its scores were
seen, points got the heights that they have on the surface: the boulder rests on three, and leans
onto others. Nothing bears within a height there; the other priors are as before.
"""

from __future__ import annotations

import argparse
import datetime
import json
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import trimesh
from matplotlib import pyplot as plt
from scipy.spatial import ConvexHull

import rockeom as rk
from benchmarks import report
from rockeom import plots
from rockeom.analysis import validation
from rockeom.analysis.validation import BoulderTests
from rockeom.analysis.validation.boulder_tests import TREATMENTS
from rockeom.assessment.plane import planar_block
from rockeom.codes import MOST_POINTS_IN_SPACE
from rockeom.modelling.mesh import MeshBody, read_body, settled, support_points

MARKS = "<!-- tables of boulder -->", "<!-- end of boulder -->"
STORED = Path(__file__).with_suffix(".json")
SPECIMENS = ("specimen_1", "specimen_2")
MASS = 353.8  # kg, as stated
BEARING = (0.5e-3, 5e-3)  # m, of level points
RIGID = 1e-6  # m, height within which points bear that have heights of their own
SCAN_ERROR = (1e-3, 3e-3)  # m
FRICTION = (0.4, 0.8)
SEED = 582
DRAWS, FEW = 30, 3  # all; of other treatments
AGAIN = 2  # draws by which `scores` checks what is stored
WRONG = 0.1  # part of the tests that one draw is expected to get wrong, as the weights have it
ITERATIONS, FEWER = 2000, 300  # of the weights; of those of twins
TWINS = 0.15, 0.6  # share of the tests in which a draw falls that may stand for the boulder
METHOD = rk.SolverOptions(method="RK45")  # steps end at the samples anyway
ANGLES, SIZES = (3, 4, 5, 6, 8, 10, 12), (0.1, 0.2, 0.3, 0.4, 0.6)  # degrees, m, of the plane

WAYS = "space", "level", "plane"
NAMES = dict(zip(WAYS, ("space", "space, level points", "plane"), strict=True))
PAIRS = (
    ("space, nothing fitted", "space, level points, nothing fitted"),
    ("space, nothing fitted", "plane, nothing fitted"),
    ("space, nothing fitted", "discrete elements of others, stiffness chosen"),
    ("space, draws weighed", "plane, draws weighed"),
    ("space, draws weighed", "plane, two numbers chosen"),
    ("space, draws weighed", "discrete elements of others, stiffness chosen"),
)

Outcomes = dict[str, dict[str, np.ndarray]]
"""By a way of `WAYS` and specimen: whether draws overturn in tests (draws, n)."""


# -- what is drawn -------------------------------------------------------------------------------


class Draw(NamedTuple):
    """A boulder from the priors, on points of their heights, and on level ones."""

    boulder: rk.Boulder
    level: rk.Boulder
    azimuth: float  # rad, of its x from the axis of the table
    plane: rk.OffsetBlock | rk.RigidBlock
    friction: float

    def case(self, way: str, motion: rk.GroundMotion) -> rk.Case:
        if way == "plane":
            return rk.Case(self.plane, motion)
        return rk.Case(self.boulder if way == "space" else self.level, motion, azimuth=self.azimuth)


def draw(surface: MeshBody, specimen: str, number: int) -> Draw:
    """The draw of a number; draws of two numbers, or specimens, are independent."""
    rng = np.random.default_rng([SEED, SPECIMENS.index(specimen), number])
    azimuth, bearing = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(*BEARING)
    error, friction = rng.uniform(*SCAN_ERROR), rng.uniform(*FRICTION)
    outward = trimesh.Trimesh(surface.vertices, surface.faces, process=False).vertex_normals
    moved = surface.vertices + outward * rng.normal(0.0, error, len(outward))[:, None]
    body = settled(surface._replace(vertices=moved))
    boulder, level = (
        rk.Boulder(
            feet=feet, mass=body.mass, centroid=tuple(body.centroid.tolist()), inertia=body.inertia
        )
        for feet in (support_points(body, RIGID, "draw"), level_points(body, bearing))
    )
    return Draw(boulder, level, azimuth, planar_block(level)[0], friction)


def level_points(body: MeshBody, bearing: float) -> dict[str, tuple[float, float]]:
    """Corners of what bears at rest; of more than eight those whose loss takes least area go."""
    hull = body.vertices[ConvexHull(body.vertices).vertices]
    plan = hull[hull[:, 2] - hull[:, 2].min() <= bearing, :2] + body.centroid[:2]
    corners = plan[ConvexHull(plan).vertices]
    while len(corners) > MOST_POINTS_IN_SPACE:
        (ax, ay), (bx, by) = ((corners - np.roll(corners, turn, axis=0)).T for turn in (1, -1))
        corners = np.delete(corners, np.abs(ax * by - ay * bx).argmin(), axis=0)
    return {f"point_{i + 1}": (x, y) for i, (x, y) in enumerate(corners.tolist())}


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


@cache
def motions_of(tests: BoulderTests, treatment: str = "joined") -> rk.MotionSet:
    return rk.MotionSet(tests.motion(i, treatment) for i in range(len(tests.tests)))


def simulated(tests: BoulderTests, treatment: str, way: str, draws: Sequence[int]) -> dict:
    """Outcomes (draws, n) of draws in one way, by specimen."""
    motions, found = motions_of(tests, treatment), {}
    for specimen in SPECIMENS:
        surface, rows = read_body(tests.surfaces[specimen], MASS, None, 1.0), []
        for number in draws:
            drawn, started = draw(surface, specimen, number), time.perf_counter()
            rows.append(overturned(drawn.case(way, motions[0]), motions))
            said = f"draw {number}: {time.perf_counter() - started:.0f} s"
            print(f"{treatment}, {way}, {specimen}, {said}", file=sys.stderr)
        found[specimen] = np.array(rows)
    return found


def with_friction(tests: BoulderTests, draws: Sequence[int], every: int) -> tuple[int, int]:
    """(outcomes that change, of how many) where feet may slip, of each so many tests."""
    motions = rk.MotionSet(tests.motion(i) for i in range(0, len(tests.tests), every))
    changed = number = 0
    for specimen in SPECIMENS:
        surface = read_body(tests.surfaces[specimen], MASS, None, 1.0)
        for drawn in (draw(surface, specimen, i) for i in draws):
            never = drawn.case("space", motions[0])
            slips = replace(drawn.boulder, friction=drawn.friction)
            rubs = rk.Case(slips, motions[0], azimuth=drawn.azimuth)
            apart = overturned(never, motions) != overturned(rubs, motions)
            changed, number = changed + int(apart.sum()), number + len(apart)
    return changed, number


def packed(outcomes: Mapping[str, np.ndarray]) -> dict[str, list[str]]:
    """Outcomes of specimens as text: a hexadecimal number a draw."""
    return {
        name: [np.packbits(row).tobytes().hex() for row in rows] for name, rows in outcomes.items()
    }


def fit(tests: BoulderTests, draws: int) -> None:
    """Store the outcomes of draws that are not yet stored, after each of them."""
    stored = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    numbers = {("joined", way): draws for way in WAYS}
    numbers |= {(treatment, "space"): FEW for treatment in TREATMENTS if treatment != "joined"}
    for (treatment, way), number in numbers.items():
        rows = stored.setdefault(treatment, {}).setdefault(way, {name: [] for name in SPECIMENS})
        for i in range(len(rows[SPECIMENS[0]]), number):
            for name, texts in packed(simulated(tests, treatment, way, [i])).items():
                rows[name] += texts
            stored |= {
                "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
                "rockeom": rk.__version__, "tests": len(tests.tests),
                "priors": {
                    "azimuth [rad]": (0.0, 2.0 * np.pi), "scan error [m]": SCAN_ERROR,
                    "bearing height of level points [m]": BEARING, "friction": FRICTION,
                    "seed": SEED,
                },
            }  # fmt: skip
            STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")
    if "friction" not in stored:
        stored["friction"] = with_friction(tests, range(FEW), 20)
        STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")


def unpacked(stored: Mapping, n: int) -> Outcomes:
    """The outcomes of n tests that `packed` has stored."""

    def bits(text: str) -> np.ndarray:
        return np.unpackbits(np.frombuffer(bytes.fromhex(text), np.uint8))[:n].astype(bool)

    return {
        way: {name: np.array([bits(text) for text in texts]) for name, texts in of.items()}
        for way, of in stored.items()
    }


# -- predictions of each fold by the others ------------------------------------------------------


def chosen(choices: np.ndarray, observed: np.ndarray, folds: np.ndarray) -> np.ndarray:
    """Outcomes (n,) by the choice (k, n) that is right most often on the other folds; the first."""
    right = choices == observed
    best = {f: int(np.argmax(right[:, folds != f].mean(axis=1))) for f in np.unique(folds)}
    return choices[[best[f] for f in folds], np.arange(len(folds))].astype(float)


def weighed(
    outcomes: np.ndarray, observed: np.ndarray, folds: np.ndarray, iterations: int = ITERATIONS
) -> np.ndarray:
    """Probabilities (n,) by draws (k, n) with the weights that suit the other folds best.

    A draw is wrong about a test with the probability WRONG. Weights of the mixture make the
    outcomes of the other folds most likely (Yao and others 2018, stacking), by the algorithm of
    expectation and maximisation, from equal ones.
    """
    states = np.where(outcomes, 1.0 - WRONG, WRONG)
    likely = np.where(outcomes == observed, 1.0 - WRONG, WRONG)
    found = np.empty(outcomes.shape[1])
    for fold in np.unique(folds):
        of_others, weights = likely[:, folds != fold], np.full(len(likely), 1.0 / len(likely))
        for _ in range(iterations):
            parts = weights[:, None] * of_others
            weights = (parts / parts.sum(axis=0)).mean(axis=1)
        found[folds == fold] = weights @ states[:, folds == fold]
    return found


def by_velocity(motions: Sequence[rk.GroundMotion]) -> np.ndarray:
    """Outcomes (k, n) by a threshold of the peak velocity, halfway between those of the tests."""
    peaks = np.array([motion.peak_velocity for motion in motions])
    ordered = np.unique(peaks)
    return peaks > ((ordered[1:] + ordered[:-1]) / 2)[:, None]


def by_two_numbers(motions: rk.MotionSet) -> np.ndarray:
    """Outcomes (k, n) of rigid blocks in the plane of some slendernesses and sizes."""
    rows = []
    for angle in np.radians(ANGLES):
        for size in SIZES:
            block = rk.RigidBlock(
                half_width=size * np.sin(angle), half_height=size * np.cos(angle), mass=MASS
            )
            rows.append(overturned(rk.Case(block, motions[0]), motions))
    return np.array(rows)


def predictions(tests: BoulderTests, outcomes: Outcomes) -> dict[str, dict]:
    """Probabilities of overturning (n,) of each specimen, by each way of predicting."""
    motions = motions_of(tests)
    peaks, blocks = by_velocity(list(motions)), by_two_numbers(motions)
    found: dict[str, dict] = {}
    for name in SPECIMENS:
        fell, folds = tests.overturned[name], tests.folds
        others = np.array(list(tests.of_others[name].values()))
        found[name] = {
            "one threshold of the peak velocity, chosen": chosen(peaks, fell, folds),
            "discrete elements of others, stiffness chosen": chosen(others, fell, folds),
            "plane, two numbers chosen": chosen(blocks, fell, folds),
        }
        for way in reversed(WAYS):
            found[name] |= by_draws(NAMES[way], outcomes[way][name], fell, folds)
    return found


def by_draws(
    of: str, outcomes: np.ndarray, observed: np.ndarray, folds: np.ndarray, iterations=ITERATIONS
) -> dict[str, np.ndarray]:
    """Probabilities (n,) by draws (k, n) of a model, alike and weighed."""
    return {
        f"{of}, nothing fitted": outcomes.mean(axis=0),
        f"{of}, draws weighed": weighed(outcomes, observed, folds, iterations),
    }


# -- the page ------------------------------------------------------------------------------------


def right(probability: np.ndarray, fell: np.ndarray) -> np.ndarray:
    return (probability > 0.5) == fell


def scores(probability: np.ndarray, fell: np.ndarray) -> tuple[float, float]:
    """Share that is right, and mean score of Brier."""
    brier = validation.brier_score(fell, probability).mean()
    return float(right(probability, fell).mean()), float(brier)


def table_of_scores(tests: BoulderTests, found: Mapping) -> str:
    head = ("prediction", "", *(f"{what} {i + 1}" for i in (0, 1) for what in ("right", "Brier")))
    rows = []
    for way in found[SPECIMENS[0]]:
        cells = []
        for name in SPECIMENS:
            cells += [f"{x:.3f}" for x in scores(found[name][way], tests.overturned[name])]
        rows.append((way, "", *cells))
    return report.table(head, rows)


def table_of_pairs(tests: BoulderTests, found: Mapping) -> str:
    """The first of each pair less the second, both specimens together."""
    fell = np.concatenate([tests.overturned[name] for name in SPECIMENS])
    records = np.concatenate([tests.records] * len(SPECIMENS))
    head = ("first", "second", "right", "p, McNemar", "Brier")
    rows = []
    for ways in PAIRS:
        one, two = (np.concatenate([found[name][way] for name in SPECIMENS]) for way in ways)
        correct = [right(p, fell) for p in (one, two)]
        scores = [validation.brier_score(fell, p) for p in (one, two)]
        cells = [
            f"{d.value:+.3f} ({d.lower:+.3f} to {d.upper:+.3f})"
            for d in (
                validation.paired_difference(*correct, records),
                validation.paired_difference(*scores, records),
            )
        ]
        p_value = validation.disagreement(*correct).p_value
        rows.append((*ways, cells[0], f"{p_value:.2g}", cells[1]))
    return report.table(head, rows)


def table_of_twins(tests: BoulderTests, outcomes: Outcomes) -> str:
    """Scores of a boulder that is one of the draws, predicted by the others: means over such."""
    head = ("a draw in place of the boulder", "")
    head += tuple(f"{what} {i + 1}" for i in (0, 1) for what in ("draws", "right", "Brier"))
    cells: dict[str, list[str]] = {}
    for name in SPECIMENS:
        for said, pairs in scores_of_twins(outcomes, name, tests.folds).items():
            numbers = [f"{len(pairs)}", *(f"{x:.3f}" for x in np.mean(pairs, axis=0))]
            cells[said] = cells.get(said, []) + numbers
    return report.table(head, [(said, "", *row) for said, row in cells.items()])


def scores_of_twins(outcomes: Outcomes, specimen: str, folds: np.ndarray) -> dict[str, list]:
    """Scores by the other draws, of each draw that may stand for the boulder."""
    found: dict[str, list[tuple[float, float]]] = {}
    space = outcomes["space"][specimen]
    for k in (k for k, fell in enumerate(space) if TWINS[0] < fell.mean() < TWINS[1]):
        others = np.arange(len(space)) != k
        for way in ("space", "plane"):
            of_others = outcomes[way][specimen][others]
            for said, p in by_draws(way, of_others, space[k], folds, FEWER).items():
                found.setdefault(said, []).append(scores(p, space[k]))
    return found


def picture(tests: BoulderTests, found: Mapping, path: Path) -> None:
    """Reliability diagrams of both specimens, with nothing fitted and with draws weighed."""
    plots.use_style()
    figure, axes = plt.subplots(2, 2, figsize=(9.2, 8.6), layout="constrained")
    for row, name in zip(axes, SPECIMENS, strict=True):
        for ax, way in zip(row, ("space, nothing fitted", "space, draws weighed"), strict=True):
            calibration = validation.calibration_of(tests.overturned[name], found[name][way])
            plots.reliability_diagram(calibration, ax=ax)
            ax.set_title(f"{name.replace('_', ' ')}: {way}", fontsize=9)
    figure.savefig(path, dpi=110)


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.boulders", description=__doc__)
    parser.add_argument("work", choices=("fit", "scores"))
    parser.add_argument("folder", type=Path, help="folder of the tests")
    parser.add_argument("--write", type=Path, help="a page that has the tables between its marks")
    parser.add_argument("--draws", type=int, default=DRAWS, help="of `fit`")
    given = parser.parse_args(argv)
    tests = BoulderTests.from_folder(given.folder)
    if given.work == "fit":
        fit(tests, given.draws)
        return
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    outcomes = unpacked(stored["joined"], len(tests.tests))
    apart = 0
    for way in WAYS:
        again = simulated(tests, "joined", way, range(AGAIN))
        apart += sum(int((again[n] != outcomes[way][n][:AGAIN]).sum()) for n in SPECIMENS)
    print(f"{apart} of {6 * AGAIN * len(tests.tests)} outcomes are not as stored", file=sys.stderr)
    found = predictions(tests, outcomes)
    lines = [
        table_of_scores(tests, found), table_of_pairs(tests, found),
        table_of_twins(tests, outcomes), treated(tests, stored),
    ]  # fmt: skip
    print(*lines, sep="\n\n")
    if given.write:
        picture(tests, found, given.write.parent / "images" / "boulder_reliability.png")
        page = given.write.read_text(encoding="utf-8")
        given.write.write_text(report.written("\n\n".join(lines), page, MARKS), "utf-8")


def treated(tests: BoulderTests, stored: Mapping) -> str:
    """Shares by the treatment of the motion below 2 Hz, with the same draws, and by friction."""
    head = ("motion below 2 Hz", "", *(f"right {i + 1}" for i in (0, 1)), "outcomes that differ")
    joined = unpacked(stored["joined"], len(tests.tests))["space"]
    rows = []
    for treatment in TREATMENTS:
        of = unpacked(stored[treatment], len(tests.tests))["space"]
        shares = [right(of[n][:FEW].mean(axis=0), tests.overturned[n]).mean() for n in SPECIMENS]
        apart = np.mean([(of[name][:FEW] != joined[name][:FEW]).mean() for name in SPECIMENS])
        rows.append((treatment, "", *(f"{share:.3f}" for share in shares), f"{apart:.3f}"))
    changed, number = stored["friction"]
    said = f"Feet with the friction of their draw change {changed} of {number} outcomes."
    return f"{report.table(head, rows)}\n\n{said}"


if __name__ == "__main__":
    main()
