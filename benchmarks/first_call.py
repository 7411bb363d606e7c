"""What the first simulation in a new process costs: every structure with every method."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator

from rockeom.simulation.options import METHODS
from rockeom.structures.classes import SHIPPED
from tests.pages import declaration
from tests.shipped import plain

_TWO_MASSES = (
    "mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.1, base_inertia=1.37, "
    "half_width=0.285"
)
STRUCTURES = {
    "rigid_block": "rk.RigidBlock(half_width=0.095, half_height=0.45)",
    "slender_block": "rk.SlenderBlock.from_frequency(p=2.14, alpha=0.25)",
    "nondimensional_block": "rk.NondimensionalBlock(alpha=0.3)",
    "dirac_delta_block": "rk.DiracDeltaBlock(alpha=0.3, energy_ratio=0.7, regularisation=1e-3)",
    "lumped_mass_structure": f"rk.LumpedMassStructure({_TWO_MASSES})",
    "two_spring_structure": (
        f"rk.TwoSpringStructure({_TWO_MASSES}, foundation_stiffness=550e3, foundation_damping=3e3)"
    ),
    "two_spring_cart": f"rk.TwoSpringCart({_TWO_MASSES}, foundation_stiffness=550e3)",
    "uplifting_oscillator": (
        "rk.UpliftingOscillator(mass=122.6, height=1.05, half_width=0.285, stiffness=571.8e3, "
        "damping=502.4)"
    ),
    "flexible_structure": f"rk.FlexibleStructure({_TWO_MASSES}, stiffness=571.8e3, damping=502.4)",
    "controlled_wall": "rk.ControlledWall.thesis()",
    "flexible_controlled_wall": "rk.FlexibleControlledWall.thesis()",
    "controlled_wall_oscillator": "rk.ControlledWallOscillator.thesis(0.87)",
    "substitute_gravity_wall": "rk.SubstituteGravityWall.thesis()",
    "simplified_substitute_gravity_wall": "rk.SimplifiedSubstituteGravityWall.thesis()",
}
"""One of each kind that is shipped; of any other, by parameters about 1."""
for model in SHIPPED:
    STRUCTURES.setdefault(model, f"rk.structure({model!r}, **{plain(model)})")

FRAME = "two-storey frame of the README"

_PROGRAM = """
import {known}
import time
wall, processor = time.perf_counter(), time.process_time()
import rockeom as rk
{declaration}
structure = {structure}
motion = rk.GroundMotion.single_sine(amplitude=2.8, period=0.5, duration=2.0)
rk.simulate(structure, motion, options=rk.SolverOptions(method={method!r}))
print(time.perf_counter() - wall, time.process_time() - processor)
"""

Taken = tuple[float, float]
"""By the clock on the wall, and by the processor's [s]."""


def program(name: str, method: str) -> str:
    """A script that prints the times of its first simulation, above what it stands on.

    That is NumPy and what compiles, and SymPy for what is declared.
    """
    if name == FRAME:
        structure = (
            "rk.structure(two_storey, base_mass=10e3, mass_1=20e3, mass_2=20e3, height_1=3.5, "
            "height_2=7.0, stiffness_1=20e6, stiffness_2=20e6, damping_1=0.0, damping_2=0.0, "
            "half_width=1.2)"
        )
        known, declared = "numpy, llvmlite.binding, sympy", declaration()
    else:
        known, declared, structure = "numpy, llvmlite.binding", "", STRUCTURES[name]
    return _PROGRAM.format(known=known, declaration=declared, structure=structure, method=method)


def _new_process(text: str, folder: str) -> Taken:
    environment = os.environ | {"ROCKEOM_CACHE_DIR": folder}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # or each process compiles all modules
    done = subprocess.run(
        [sys.executable, "-c", text],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    wall, processor = map(float, done.stdout.split())
    return wall, processor


def measure(name: str, method: str, repeats: int) -> tuple[Taken, Taken]:
    """(first call ever, fastest first call of later processes): the cache empty, and filled."""
    text = program(name, method)
    with tempfile.TemporaryDirectory() as folder:
        ever = _new_process(text, folder)
        return ever, min((_new_process(text, folder) for _ in range(repeats)), key=lambda t: t[1])


def table(
    quick: bool, told: Callable[[str, str], None] = lambda *_: None
) -> Iterator[tuple[str, dict[str, tuple[Taken, Taken]]]]:
    """Each structure with its times by method; quick : of the default method only."""
    for name in (*STRUCTURES, FRAME):
        found = {}
        for method in METHODS[: 1 if quick else None]:
            told("first call", f"{name}, {method}")
            found[method] = measure(name, method, 2 if quick else 4)
        yield name, found


if __name__ == "__main__":
    for name, found in table("--quick" in sys.argv):
        for method, (ever, later) in found.items():
            print(
                f"{name:36} {method:7} first {ever[1]:6.2f} s, later {later[1]:6.3f} s "
                f"(by the wall {ever[0]:.2f}, {later[0]:.3f})",
                flush=True,
            )
