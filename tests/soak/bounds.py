"""Programs that check every index, on random motions of every kind of structure."""

import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import rockeom as rk
from rockeom.compiler.machine import OutOfBoundsError
from rockeom.structures.base import Structure
from rockeom.sweeps.run import lanes_pay
from tests.contact import declared
from tests.contact.test_yielding import WALL, held_block, wall_with_bars
from tests.soak.cases import METHODS, MODELS, Dice, draw

Made = Callable[[Dice], Structure]


def _restitution(dice: Dice) -> float:
    return dice.one_of(0.0, 0.0, dice.between(0.02, 0.9))


def _rough(dice: Dice) -> dict[str, float]:
    return {"friction": dice.over(0.05, 1.5), "restitution": _restitution(dice)}


def _block(dice: Dice, **more: float) -> dict[str, float]:
    """Of a declared block, with what it stands on."""
    height = dice.between(0.5, 1.5)
    return {
        "mass": dice.over(0.5, 2.0), "height": height, "inertia": height**2 * dice.over(0.2, 0.7),
        "gravity": 9.81, **more,
    }  # fmt: skip


def _sliding_block(dice: Dice) -> Structure:
    b = dice.over(0.1, 1.0)
    return rk.SlidingBlock(half_width=b, half_height=b * dice.over(0.5, 6.0), **_rough(dice))


def _stacked_blocks(dice: Dice) -> Structure:
    lower, upper = (
        rk.RigidBlock(
            half_width=w, half_height=w * dice.over(0.8, 4.0), mass=dice.over(0.5, 2.0)
        )
        for w in (0.5, dice.between(0.1, 0.5))
    )  # fmt: skip
    return rk.StackedBlocks(lower=lower, upper=upper, restitution=_restitution(dice))


def _column(dice: Dice) -> dict[str, float]:
    """Two masses on a base that may slide or stand on springs."""
    height = dice.over(1.0, 10.0)
    return {
        "mass": dice.over(1e2, 1e4), "height": height, "inertia": dice.over(1.0, 1e3),
        "base_mass": dice.over(1e2, 1e4), "base_height": 0.1, "base_inertia": dice.over(1.0, 1e3),
        "half_width": height * dice.over(0.1, 1.0),
    }  # fmt: skip


def _springs(dice: Dice) -> dict[str, float]:
    return {"stiffness": dice.over(1e5, 1e7), "damping": dice.over(1e2, 1e5)}


def _shear_frame(dice: Dice) -> Structure:
    return rk.ShearFrame(
        masses=[2e4, 1.5e4], heights=[3.0, 6.0], stiffnesses=[2e7, 1.5e7], dampings=[1e5, 1e5],
        half_width=dice.between(0.7, 1.5), base_mass=1e4, base_inertia=5e3,
        support=rk.Sliding(**_rough(dice)),
    )  # fmt: skip


def _on_a_support(of: type, support: Callable[[Dice], object], **more: float) -> Made:
    return lambda dice: of(**_column(dice), **more, support=support(dice))


SPRING = {"stiffness": 1e6, "damping": 1e3}
STRUCTURES: dict[str, Made] = {
    "sliding_block": _sliding_block,
    "stacked_blocks": _stacked_blocks,
    "rocking_frame": lambda dice: rk.RockingFrame(
        columns=3, column_mass=1e3, half_width=dice.between(0.2, 0.6), half_height=2.0,
        beam_mass=dice.over(1e2, 1e5),
    ),
    "wall_with_frame": lambda dice: rk.WallWithFrame(
        mass=4e4, half_width=dice.between(0.5, 2.0), height=5.0, inertia=4e5, frame_mass=6e4,
        frame_stiffness=5e6, frame_damping=1e4, link_height=8.0,
        link_stiffness=dice.over(1e5, 4e7), link_damping=0.0,
    ),
    "unequal feet": lambda dice: rk.structure(
        declared.unequal_feet(),
        **_block(dice, **_rough(dice)),
        left_width=dice.between(0.2, 0.6), right_width=0.4, leg=0.05,
    ),
    "on a step": lambda dice: rk.structure(
        declared.on_a_step(),
        **_block(dice, **_rough(dice), half_width=dice.between(0.2, 0.6), step=0.1),
    ),
    "four feet and a pad": lambda dice: rk.structure(
        declared.four_feet(),
        **_block(dice, **_rough(dice)),
        half_width=dice.between(0.2, 0.6), stiffness=1e4, damping=10.0,
    ),
    "two springs": lambda dice: rk.structure(
        declared.two_springs(),
        **_block(dice),
        half_width=dice.between(0.2, 0.6), stiffness=2e3, damping=dice.between(0.0, 40.0),
    ),
    "pulled block": lambda dice: rk.structure(
        declared.pulled_block(), **_block(dice, **_rough(dice), stiffness=50.0, relaxation=0.8)
    ),
    "braced block": lambda dice: rk.structure(
        declared.braced_block(),
        **_block(dice, **_rough(dice)),
        half_width=0.3, stiffness=50.0, relaxation=0.8, attached=1.0,
    ),
    "block with bars": lambda dice: rk.structure(
        held_block(),
        **_block(dice, **_rough(dice), stiffness=50.0, strength=3.0, hardening=0.1, play=0.2),
    ),
    "wall with bars": lambda dice: rk.structure(
        wall_with_bars(), **(WALL | {"half_width": dice.between(0.5, 1.5)})
    ),
    "column on a sliding base": _on_a_support(
        rk.LumpedMassStructure, lambda dice: rk.Sliding(**_rough(dice))
    ),
    "flexible column on a sliding base": _on_a_support(
        rk.FlexibleStructure, lambda dice: rk.Sliding(**_rough(dice)), **SPRING
    ),
    "flexible column on two springs": _on_a_support(
        rk.FlexibleStructure, lambda dice: rk.TwoSprings(**_springs(dice)), **SPRING
    ),
    "column on springs guided at a foot": _on_a_support(
        rk.LumpedMassStructure, lambda dice: rk.TwoSprings(**_springs(dice), guided="foot")
    ),
    "column on a bed of springs": _on_a_support(
        rk.LumpedMassStructure, lambda dice: rk.Winkler(**_springs(dice), springs=4)
    ),
    "shear frame on a sliding base": _shear_frame,
}  # fmt: skip
"""Four that are shipped and contacts, elements and supports of every kind."""


def case_of(name: str, dice: Dice) -> rk.Case:
    """A motion of the soak where it draws such a structure, else one under a record of noise."""
    if name in MODELS:
        count = len(MODELS)
        return draw(MODELS.index(name) + count * int(dice.between(0, 1e6))).case()
    structure = STRUCTURES[name](dice)
    values = 9.81 * dice.over(0.02, 1.5) * dice.rng.normal(size=60)
    motion = rk.GroundMotion.from_array(values, dice.over(0.01, 0.08))
    initial = {}
    for state in structure.states:
        if dice.chance(0.3) and state.removesuffix("_dot") in ("x", "theta", "phi", "u"):
            initial[state] = (0.1 if "_dot" in state else 0.03) * dice.between(-1.0, 1.0)
    vertical = motion.scaled(0.5) if dice.chance(0.3) else None
    return rk.Case(structure, motion, initial=initial, vertical=vertical)


def faults(name: str, seed: int) -> Iterator[str]:
    """Indices that leave their arrays, in a motion, a sweep of it and its derivatives."""
    dice = Dice(seed, 7, *name.encode())
    method = METHODS[seed % len(METHODS)]
    options = rk.SolverOptions(method=method, rtol=1e-8, max_impacts=300, max_steps=20_000)
    try:
        case = case_of(name, dice)
        run = rk.simulate(
            case.structure, case.motion, impact=case.impact, initial=case.initial,
            vertical=case.vertical, mode=case.mode, options=options,
        )  # fmt: skip
        for quantity in run.names:
            _ = run[quantity]
        lanes = method != "Radau" and lanes_pay(case.structure.module)
        rk.simulate_many(
            lambda scale: replace(case, motion=case.motion.scaled(scale)),
            over={"scale": [1.0, dice.between(0.5, 2.0)]}, options=options,
            impact_times=3, impact_states=True,
            sweep_options=rk.SweepOptions(progress=False, lanes=lanes),
        )  # fmt: skip
        if dice.chance(0.5):
            shaken = case.motion.scaled(rk.Dual(1.0, [1.0]))
            rk.tangents(replace(case, motion=shaken), options)
    except OutOfBoundsError as error:
        yield str(error)
    except ValueError:  # a start or a derivative that is refused
        return


@contextmanager
def checked() -> Iterator[None]:
    """Programs that are asked for meanwhile check every index; other processes see it, too."""
    before = os.environ.get("ROCKEOM_CHECK_BOUNDS")
    os.environ["ROCKEOM_CHECK_BOUNDS"] = "1"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        if before is None:
            del os.environ["ROCKEOM_CHECK_BOUNDS"]
        else:
            os.environ["ROCKEOM_CHECK_BOUNDS"] = before


def searched(names: list[str], seeds: range) -> list[str]:
    """Faults of structures, each told once, with the first seed that has it."""
    found: dict[str, str] = {}
    for name in names:
        for seed in seeds:
            for fault in faults(name, seed):
                found.setdefault(f"{name}: {fault}", f"seed {seed}")
    return [f"{fault} ({seed})" for fault, seed in found.items()]
