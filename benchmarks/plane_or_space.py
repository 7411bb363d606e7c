"""Forty objects and thirty recordings: probability of overturning by plane and by space.

    python -m benchmarks.plane_or_space --write docs/how-to/is-the-plane-enough.md   # minutes
    python -m benchmarks.plane_or_space --read ...     # writes the page from plane_or_space.json

Recordings and intensities are of the library of rockeom, with the extra `records`. An object is
shaken at one PGA, the geometric mean of both horizontal components: that at which its planar block
overturns under 60 % of 24 other recordings, which have more of
pulses. Ten of the objects are simulated once more, one motion
after the other, by another method at a tighter tolerance.
"""

import argparse
import datetime
import json
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

import rockeom as rk
from benchmarks.practice_objects import OBJECTS, Object
from benchmarks.practice_page import cells, draw, whole
from benchmarks.report import written
from rockeom.analysis.sweeps import ANSWERS, FALLS, outcome_labels
from rockeom.assessment import plane
from rockeom.assessment.azimuths import azimuths_of
from rockeom.assessment.remedies import paired_gain
from rockeom.assessment.trials import Conditions, Trials, by_parts, case_of
from rockeom.motion.units import STANDARD_GRAVITY

STORED = Path(__file__).with_suffix(".json")
FIGURE = Path(__file__).parents[1] / "docs" / "images" / "plane_or_space.png"
LEVEL, PART = 0.95, 0.6
FAST = rk.SolverOptions(method="RK45")
"""Steps end at the samples of the records: the lower order needs hardly more of them."""
TIGHT = rk.SolverOptions(method="DOP853", rtol=1e-11, atol=1e-13)
AGAIN = OBJECTS[::4]
MARKS = "<!-- table of plane and space -->", "<!-- end of plane and space -->"
NEAR = np.linspace(0.99, 1.01, 21)
"""Factors of a motion, by one of which an outcome changes that has its boundary near."""
EACH = 18
"""Every so many outcomes that agree are asked whether theirs is near, too."""
THREE = {
    "El Centro 1940": ("imperial_valley_02_1940_el_centro_array_9", "180", "270", "up"),
    "Corralitos 1989": ("loma_prieta_1989_corralitos", "0", "90", "up"),
    "Sylmar County 1994": ("northridge_05_1994_sylmar_county_hospital_grounds", "90", "360", "up"),
    "Pacoima 1971": ("san_fernando_1971_pacoima_dam_upper_left_abut", "164", "254", "dwn"),
}
OTHERS = "Irpinia", "Erzican", "Gazli", "Nahanni, Canada, 1985, Site 1"
"""Near-field recordings of earthquakes of which the far field has none."""
QUIET = rk.SweepOptions(progress=False)


def recordings() -> tuple[list[rk.Recording], list[rk.Recording]]:
    """The thirty, and the 24 others by which intensities are chosen."""
    found = []
    for name, (words, *components) in THREE.items():
        x, y, up = (rk.GroundMotion.from_library(f"{words}_{one}") for one in components)
        found.append(rk.Recording(name, (x, y), -up if components[-1] == "dwn" else up))
    near = rk.MotionSet.from_library("near field").recordings()
    more = [one for one in near if one.name.startswith(OTHERS)]
    found += [*map(_even, rk.MotionSet.from_library("far field").recordings()), *more]
    return found, [one for one in near if one not in more]


def _even(one: rk.Recording) -> rk.Recording:
    """Zeros follow the shorter component, such as Abbar's, 7 s shorter than the other."""
    longest = max(one.horizontal, key=lambda component: component.duration)
    t = np.arange(round(longest.duration / longest.dt) + 1) * longest.dt
    components = (
        each if each.duration == longest.duration
        else rk.GroundMotion.from_array(
            np.where(t <= each.duration, each.acceleration(np.minimum(t, each.duration)), 0.0),
            dt=longest.dt, name=each.name,
        )
        for each in one.horizontal
    )  # fmt: skip
    return rk.Recording(one.name, tuple(components), one.vertical)


def pga_of(structure: rk.Structure, others: Sequence[rk.Recording]) -> float:
    """The PGA at which 60 % of other recordings overturn the planar block [m/s2], two digits."""
    block, _ = plane.planar_block(structure)
    edge = plane.weakest_edge(structure)
    levels = STANDARD_GRAVITY * edge.arm / edge.height * np.geomspace(1.1, 16.0, 14)
    flat = Conditions((), np.zeros(0), levels, None, None)

    def case(motion: rk.Recording, way: float, pga: float) -> rk.Case:
        return case_of(block, plane.stronger(motion.scaled_to(pga), way), flat)

    over = {"motion": others, "way": _ways(block), "pga": levels}
    labels = outcome_labels(rk.simulate_many(case, over, sweep_options=QUIET)).values
    share = np.maximum.accumulate((labels == FALLS).mean(axis=(0, 1)))
    pga = float(np.interp(PART, share, levels)) / STANDARD_GRAVITY
    return STANDARD_GRAVITY * float(f"{pga:.2g}")


def _ways(block: rk.Structure) -> tuple[float, ...]:
    return (1.0,) if isinstance(block, rk.RigidBlock) else (1.0, -1.0)


def assessed(one: Object, given: Sequence[rk.Recording], pga: float) -> dict[str, Any]:
    """Falls of an object in space and in the plane, shares with intervals, and the difference."""
    turns = azimuths_of(one.structure, None)
    numbers = np.repeat(np.arange(len(given)), len(turns))
    conditions = Conditions(
        tuple(given[i] for i in numbers), numbers, np.array([pga]), None, None, azimuths=turns
    )
    scaled = [motion.scaled_to(pga) for motion in given]

    def case(motion: rk.Recording, azimuth: float) -> rk.Case:
        return case_of(one.structure, motion, conditions, azimuth)

    began = time.process_time()
    over = {"motion": scaled, "azimuth": turns}
    sweep = rk.simulate_many(case, over, options=FAST, sweep_options=QUIET)
    seconds = (time.process_time() - began) / len(numbers)
    labels = outcome_labels(sweep).values
    fell, answered = (x.reshape(-1, 1) for x in (labels == FALLS, np.isin(labels, [*ANSWERS])))
    trials = Trials(fell, answered, (), None, "", {}, {}, {})
    flat = plane.in_plane(one.structure, conditions, trials, LEVEL)
    assert flat is not None
    assert flat.more is not None
    known = answered[:, 0]
    turned = _turned(one, scaled, turns, flat)
    beside = paired_gain(trials, trials._replace(fell=turned, answered=answered), numbers, LEVEL)
    assert beside is not None
    by_azimuth = [int((labels[:, i] == FALLS).sum()) for i in range(len(turns))]
    return {
        "name": one.name, "pga": pga / STANDARD_GRAVITY, "turns": len(turns),
        "space": flat.share_in_space,
        "interval": by_parts(fell[known, 0], numbers[known], LEVEL),
        "plane": flat.share, "plane without loss": without_loss(one, conditions, trials),
        "more": list(flat.more), "missed": flat.missed,
        "turned": float(turned.mean()), "more than turned": list(beside),
        "by azimuth": by_azimuth, "azimuths": np.degrees(turns).tolist(),
        "answered": int(answered.sum()), "seconds": seconds,
        "falls": "".join(map(str, [*fell.astype(int).ravel(), *flat.fell.astype(int).ravel()])),
    }  # fmt: skip


def without_loss(one: Object, conditions: Conditions, trials: Trials) -> float | None:
    """Share of falls of the planar block of a round object, which loses no energy in space."""
    if not isinstance(one.structure, rk.WobblingColumn):
        return None
    elastic = conditions._replace(impact=rk.EnergyRatio(1.0))
    flat = plane.in_plane(one.structure, elastic, trials, LEVEL)
    assert flat is not None
    return flat.share


def _turned(
    one: Object, scaled: Sequence[rk.Recording], turns: Sequence[float], flat: plane.InPlane
) -> np.ndarray:
    """Falls of the planar block (n, 1), turned with the body, each under its own component."""
    conditions = Conditions((), np.zeros(0), np.zeros(0), None, None)

    def case(motion: rk.Recording, azimuth: float) -> rk.Case:
        whole = rk.Recording(motion.name, motion.in_space(), motion.vertical)
        return case_of(flat.block, whole.along(azimuth + flat.azimuth), conditions)

    round_ones = np.linspace(0.0, np.pi, 4, endpoint=False)  # along which a round body may lean
    several = turns if len(turns) > 1 else round_ones.tolist()
    over = {"motion": scaled, "azimuth": several}
    fell = outcome_labels(rk.simulate_many(case, over, sweep_options=QUIET)).values == FALLS
    return fell.astype(float).reshape(-1, 1) if len(turns) > 1 else fell.mean(axis=1)[:, None]


# -- an independent run


def again(rows: Sequence[Mapping[str, Any]], given: Sequence[rk.Recording]) -> dict[str, Any]:
    """Ten objects once more, motion by motion; outcomes that differ, and how many are near.

    Near is their boundary, and that of some of those that agree.
    """
    first = {row["name"]: row for row in rows}
    with ThreadPoolExecutor(2) as threads:
        found = list(threads.map(lambda one: _again(one, first[one.name], given), AGAIN))
    return {key: [one[key] for one in found] for key in found[0]}


def _again(one: Object, row: Mapping[str, Any], given: Sequence[rk.Recording]) -> dict[str, Any]:
    """Outcomes of one object by `TIGHT`, in space and in the plane, compared with those before."""
    turns, (block, _) = azimuths_of(one.structure, None), plane.planar_block(one.structure)
    space = Conditions((), np.zeros(0), np.zeros(0), None, None, azimuths=turns)
    flat, pga = space._replace(azimuths=()), STANDARD_GRAVITY * row["pga"]

    def in_space(motion: rk.Recording, azimuth: float) -> rk.Case:
        return case_of(one.structure, motion, space, azimuth)

    def in_plane(motion: rk.Recording, way: float) -> rk.Case:
        return case_of(block, plane.stronger(motion, way), flat)

    scaled = [motion.scaled_to(pga) for motion in given]
    cases: list[tuple[Any, rk.Recording, float]] = []
    cases += [(in_space, motion, turn) for motion in scaled for turn in turns]
    cases += [(in_plane, motion, way) for motion in scaled for way in _ways(block)]
    before = [letter == "1" for letter in row["falls"]]
    agree = [_falls(*case) == fell for case, fell in zip(cases, before, strict=True)]
    differ = [case for case, same in zip(cases, agree, strict=True) if not same]
    asked = [case for case, same in zip(cases, agree, strict=True) if same][::EACH]
    return {
        "name": one.name, "motions": len(cases), "differ": len(differ),
        "near": sum(_is_near(*case) for case in differ),
        "asked": len(asked), "near of asked": sum(_is_near(*case) for case in asked),
    }  # fmt: skip


def _is_near(make: Callable[[Any, float], rk.Case], motion: rk.Recording, how: float) -> bool:
    """Whether a factor of the motion within 1 % changes the outcome."""
    falls = _falls(make, motion, how)
    return any(_falls(make, k * motion, how) != falls for k in NEAR)


def _falls(make: Callable[[Any, float], rk.Case], motion: rk.Recording, how: float) -> bool:
    return rk.simulate(make(motion, how), options=TIGHT).outcome.value == FALLS


def measured() -> dict[str, Any]:
    """All that the page says."""
    given, others = recordings()
    rows, began = [], time.time()
    for one in OBJECTS:
        rows.append(assessed(one, given, pga_of(one.structure, others)))
        print(f"{time.time() - began:4.0f} s  {' | '.join(cells(rows[-1]))}", file=sys.stderr)
    middle = time.time()
    return {
        "date": datetime.date.today().isoformat(),
        "recordings": len(given),
        "objects": rows,
        "again": again(rows, given),
        "minutes": [(middle - began) / 60.0, (time.time() - middle) / 60.0],
    }


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.plane_or_space")
    parser.add_argument("--read", action="store_true", help="measure nothing")
    parser.add_argument("--write", type=Path, help="a page that has the tables between its marks")
    arguments = parser.parse_args(argv)
    if not arguments.read:
        STORED.write_text(json.dumps(measured(), indent=1) + "\n", encoding="utf-8")
    found = json.loads(STORED.read_text(encoding="utf-8"))
    print(text := whole(found))
    if arguments.write:
        draw(found["objects"], FIGURE)
        page = arguments.write.read_text(encoding="utf-8")
        arguments.write.write_text(written(text, page, MARKS), encoding="utf-8")


if __name__ == "__main__":
    main()
