"""The motions whose bits are compared: each structure, method and contact law under two records,
sweeps with and without lanes, and derivatives.

python -m tests.golden.motions FOLDER [PART]    writes arrays of those whose name has PART
"""

import sys
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

import rockeom as rk
from rockeom.codes import CONTACT_LAWS
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain
from tests.typical import S1, column, on_springs

METHODS = ("DOP853", "RK45", "Radau")
LAWS = {
    "ratio": rk.EnergyRatio(0.8),
    "speed": rk.EnergyLossAtSpeed.equation_3_17(),
    "impulsive": rk.Impulsive(),
}
"""Impact laws of structures whose feet do not slide."""
PIER = {
    "mass": 3e5, "height": 12.0, "inertia": 2e6, "base_mass": 4e4, "base_height": 0.5,
    "base_inertia": 6e4, "half_width": 1.5, "stiffness": 20e6, "damping": 25e4,
}  # fmt: skip
SIZED = {
    "two_spring_structure": on_springs,
    "two_spring_cart": partial(rk.TwoSpringCart, **S1, foundation_stiffness=550e3),
    "uplifting_oscillator": partial(rk.UpliftingOscillator.from_frequency, 20.0, 0.02, 1.0, 0.3),
    "flexible_structure": column,
    "controlled_wall": rk.ControlledWall.thesis,
    "flexible_controlled_wall": rk.FlexibleControlledWall.thesis,
    "controlled_wall_oscillator": partial(rk.ControlledWallOscillator.thesis, 0.85),
    "substitute_gravity_wall": rk.SubstituteGravityWall.thesis,
}
"""Structures that numbers about 1 do not make rock."""
PEAKS = {"sliding_block": 12.0, "two_spring_structure": 4.0, "two_spring_cart": 3.0}
"""PGA [m/s2] of structures of which nothing tells when they move."""
SUPPORTS = {
    "springs": rk.TwoSprings(stiffness=3e8, damping=2e6),
    "bed": rk.Winkler(stiffness=2e7, damping=2e5, springs=5),
}

Arrays = dict[str, np.ndarray]
Build = Callable[[], rk.Structure]


def structures() -> Iterator[tuple[str, Build]]:
    """Each shipped structure, those on other supports, and those with each law of contacts."""
    for name in SHIPPED:
        yield name, SIZED.get(name) or partial(SHIPPED[name], **plain(name))
    for name, support in SUPPORTS.items():
        yield f"pier on {name}", partial(rk.FlexibleStructure, **PIER, support=support)
    for law in CONTACT_LAWS:
        feet = rk.Sliding(friction=0.5, restitution=0.2, law=law)
        yield f"pier on feet, {law}", partial(rk.FlexibleStructure, **PIER, support=feet)
        yield f"sliding block, {law}", partial(block_with, law)


def block_with(law: str) -> rk.Structure:
    """A block on feet that slide and bounce by a law of contacts."""
    return rk.structure(
        rk.derive("sliding_block", law=law),
        half_width=0.5, height=1.0, mass=1.0, inertia=0.5, friction=0.4, restitution=0.3,
    )  # fmt: skip


def records(structure: rk.Structure) -> dict[str, tuple[rk.GroundMotion, rk.GroundMotion | None]]:
    """A measured record, and a synthetic one with a vertical component, that make it move."""
    peak = PEAKS.get(structure.model) or 1.6 * (structure.uplift_acceleration or 5.0)
    measured = rk.GroundMotion.from_library("El Centro 1940 180").scaled_to(pga=peak)
    drawn, vertical = (
        rk.GroundMotion.kanai_tajimi(0.02, duration=8.0, seed=seed) for seed in (1, 2)
    )
    return {
        "El Centro": (measured, None),
        "synthetic": (drawn.scaled_to(pga=peak), vertical.scaled_to(pga=0.3 * peak)),
    }


def cases(structure: rk.Structure) -> dict[str, rk.Case]:
    """A motion under each record; under the synthetic one from a lean."""
    turning = structure.states[structure.module.ROTATION]
    lean = {turning: 0.2 * min(structure.overturning_rotation, 0.3)}
    return {
        name: rk.Case(
            structure, motion, vertical=vertical, initial=lean if vertical else None, duration=8.0
        )
        for name, (motion, vertical) in records(structure).items()
    }


def response(build: Build, record: str, method: str, law: str = "") -> Arrays:
    """Samples, events and the outcome."""
    case = cases(build())[record]
    run = rk.simulate(
        case.structure, case.motion, impact=LAWS.get(law), vertical=case.vertical,
        initial=case.initial, duration=case.duration, options=rk.SolverOptions(method=method),
    )  # fmt: skip
    events = run.events.columns
    return {
        "t": run.t, "y": run.y, "mode": run.mode, "outcome": np.array(str(run.outcome)),
        "event times": events.times, "event kinds": events.kinds, "event states": events.states,
    }  # fmt: skip


def sweep(build: Build, lanes: bool) -> Arrays:
    """Twelve amplitudes of the synthetic record."""
    table = rk.simulate_many(
        cases(build())["synthetic"], {"scale": np.linspace(0.3, 1.6, 12)},
        sweep_options=rk.SweepOptions(progress=False, lanes=lanes, threads=1),
    )  # fmt: skip
    return {str(name): table[name].values for name in table.data_vars}


def derivatives(build: Build) -> Arrays:
    """Of a motion by the rotation at its start."""
    structure = build()
    case = cases(structure)["synthetic"]
    start = rk.duals(**case.initial)
    tangents = rk.tangents(rk.Case(structure, case.motion, initial=start, duration=3.0))
    return {
        "end": tangents.end, "event times": tangents.event_times, "before": tangents.before,
        "after": tangents.after,
    }  # fmt: skip


def motions() -> Iterator[tuple[str, Callable[[], Arrays]]]:
    """Names, and what makes the arrays."""
    for name, build in structures():
        for method in METHODS:
            for record in ("El Centro", "synthetic"):
                yield f"{name}, {method}, {record}", partial(response, build, record, method)
        yield f"{name}, sweep", partial(sweep, build, lanes=False)
        yield f"{name}, sweep in lanes", partial(sweep, build, lanes=True)
        yield f"{name}, derivatives", partial(derivatives, build)
    for name, build in structures():
        for law in LAWS if name in ("rigid_block", "flexible_structure") else ():
            for method in METHODS:
                yield f"{name}, {method}, {law}", partial(response, build, "synthetic", method, law)


def main(folder: str, part: str = "") -> None:
    for number, (name, make) in enumerate(motions()):
        if part not in name:
            continue
        try:
            arrays = make()
        except ValueError as error:  # what a structure refuses is a result, too
            arrays = {"refused": np.array(str(error))}
        np.savez(Path(folder) / f"{number}.npz", name=np.array(name), **arrays)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(*sys.argv[1:])
