"""Elastic structures under records with default options: no impact gains energy.

    python -m tests.soak --energy 20000

Ordinary structures of engineering, on feet that lift, are shaken so that they rock. The impact law
is left to the default. Kinetic energies before and after each impact are compared.
"""

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache

import rockeom as rk
from rockeom.codes import IMPACT
from rockeom.structures.base import Structure
from rockeom.structures.evaluation import at_states
from tests.soak.cases import Dice

ROUNDING = 1e-11
"""Part of the kinetic energy that an impact may seem to gain."""
ELASTIC = ("flexible_structure", "shear_frame", "uplifting_oscillator", "wall_with_frame")
RECORDS = (
    "El Centro 1940 180",
    "Corralitos 0",
    "Pacoima 164",
    "Rinaldi 032",
    "Nishi-Akashi NIS000",
)


@cache
def record(name: str) -> rk.GroundMotion:
    return rk.GroundMotion.from_library(name)


def elastic(dice: Dice) -> Structure:
    """A structure that bends, of a height from 2 to 40 m and a period from .05 to 2 s."""
    if dice.chance(0.01):  # whose motions take long
        return rk.FlexibleControlledWall.thesis(damping_ratio=dice.between(0.0, 0.1))
    model = dice.one_of(*ELASTIC)
    height, mass = dice.over(2.0, 40.0), dice.over(1e3, 1e6)
    half_width = height * dice.over(0.05, 0.5)
    rate, ratio = 2.0 * math.pi / dice.over(0.05, 2.0), dice.between(0.0, 0.1)
    if model == "uplifting_oscillator":
        return rk.UpliftingOscillator.from_frequency(
            rate, ratio, height=height, half_width=half_width, mass=mass
        )
    if model == "wall_with_frame":
        stiffness = mass * rate**2
        return rk.WallWithFrame(
            mass=mass, half_width=half_width, height=0.5 * height, inertia=mass * height**2 / 12,
            frame_mass=mass, frame_stiffness=stiffness, link_height=height,
            frame_damping=2.0 * ratio * rate * mass, link_damping=ratio * rate * mass,
            link_stiffness=dice.over(0.1, 10.0) * stiffness,
        )  # fmt: skip
    base = {
        "base_mass": mass * dice.between(0.05, 1.0), "half_width": half_width,
        "base_height": 0.05 * height,
    }  # fmt: skip
    if model == "shear_frame":
        n = dice.one_of(1, 2, 3)
        frame = rk.ShearFrame(
            masses=[mass / n] * n, heights=[(i + 1) * height / n for i in range(n)],
            stiffnesses=[mass / n * (n * rate) ** 2] * n, dampings=[0.0] * n, **base,
        )  # fmt: skip
        return frame.damped(ratio) if ratio else frame
    return rk.FlexibleStructure(
        mass=mass, height=height, inertia=dice.one_of(0.0, 0.02 * mass * height**2),
        base_inertia=base["base_mass"] * half_width**2 / 3, stiffness=mass * rate**2,
        damping=2.0 * ratio * rate * mass, **base,
    )  # fmt: skip


def drawn(seed: int) -> rk.Case:
    """A structure under a record whose peak is once to eight times what lifts it slowly."""
    dice = Dice(seed, 0, *b"energy")
    structure = elastic(dice)
    lifts = structure.uplift_acceleration or 9.81 * dice.over(0.05, 0.5)
    motion = record(dice.one_of(*RECORDS)).scaled(time=dice.over(0.3, 3.0))
    return rk.Case(structure, motion.scaled_to(lifts * dice.over(1.0, 8.0)))


@dataclass
class Gains:
    """Of many seeds: runs by model, impacts, and seeds whose impacts gained energy.

    largest : of an impact, the kinetic energy gained in that before it.
    """

    runs: Counter = field(default_factory=Counter)
    impacts: int = 0
    gained: list[int] = field(default_factory=list)
    largest: float = -math.inf
    at: int = -1

    def __str__(self) -> str:
        models = ", ".join(f"{n:,} {model}" for model, n in sorted(self.runs.items()))
        lines = [
            f"{sum(self.runs.values()):,} runs: {models}",
            f"{self.impacts:,} impacts; the largest relative gain is {self.largest:.2g}, seed "
            f"{self.at}",
            f"{len(self.gained)} runs with an impact that gained energy",
        ]
        return "\n".join(lines + [f"seeds {self.gained[:20]}"] * bool(self.gained))


def gains_of(seeds: Iterable[int]) -> Gains:
    """The kinetic energy that impacts of these seeds gained."""
    found = Gains()
    for seed in seeds:
        case = drawn(seed)
        run = rk.simulate(case.structure, case.motion)
        found.runs[case.structure.model] += 1
        _, kinds, states = run.events.columns
        hits = kinds[:, 0] == IMPACT
        m, p = case.structure.module, case.structure.vector
        before, after = (  # by the module itself, which is not what was compiled
            at_states(m, p, "energies", kinds[hits, 1 + i], states[hits, i]) for i in (0, 1)
        )
        gained = after["kinetic_energy"] / before["kinetic_energy"] - 1.0
        found.impacts += len(gained)
        worst = float(gained.max(initial=-math.inf))
        if worst > found.largest:
            found.largest, found.at = worst, seed
        if worst > ROUNDING or len(run.impacts.energy_gains):
            found.gained.append(seed)
    return found
