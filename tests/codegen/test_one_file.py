"""A structure is added in one file: in a copy of the package, from a declaration to a response."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rockeom as rk
from rockeom.symbolic.registry import shipped

ROOT = Path(__file__).resolve().parents[2]

RING = '''
"""A hollow ring on a flat base, all of its mass at one distance from its centroid."""

from rockeom.symbolic.model import Body, coordinate, parameter, turned
from rockeom.symbolic.rocking import rocking_structure
from rockeom.symbolic.registry import shipped

MASS = parameter("m", "mass", "kg", "mass")
RADIUS = parameter("r", "radius", "m", "distance of the mass from the centroid")
HALF_WIDTH = parameter("B", "half_width", "m", "half of the width of the base")
SHIFT = parameter("d", "narrower", "m", "by which the base has worn on either side")
GRAVITY = parameter("g", "gravity", "m/s2", "acceleration of gravity")
ROTATION = coordinate("theta", "theta", "rad", "rotation, positive clockwise")


@shipped
def hollow_ring():
    m, r, theta = MASS.symbol, RADIUS.symbol, ROTATION.position

    def bodies(pivot):
        return [Body("ring", m, turned((0, r), pivot, theta), m * r**2, theta)]

    return rocking_structure(
        name="hollow_ring", title="Hollow ring on rigid ground",
        parameters=(MASS, RADIUS, HALF_WIDTH, SHIFT, GRAVITY), coordinates=(ROTATION,),
        bodies=bodies, half_width=HALF_WIDTH.symbol - SHIFT.symbol, gravity=GRAVITY.symbol,
    )
'''

USED = """
import pickle, sys
import numpy as np
import rockeom as rk
from rockeom.cli import main

ring = rk.HollowRing(mass=3.0, radius=0.5, half_width=0.15, narrower=0.05)
assert "HollowRing" in rk.__all__ and "HollowRing" in dir(rk)
assert ring == rk.structure("hollow_ring", **ring.parameters()) == pickle.loads(pickle.dumps(ring))
assert (ring.radius, ring.gravity) == (0.5, 9.81)
assert "Half of the width of the base [m]" in rk.HollowRing.__doc__
print(ring)
for wrong in ({"radius": 0.5}, {"mass": -3.0}, {"half_width": 0.05}):
    try:
        rk.HollowRing(**{"mass": 3.0, "half_width": 0.15, "narrower": 0.05} | wrong)
    except (TypeError, ValueError) as error:
        print(error)
    try:
        rk.HollowRing(**ring.parameters() | wrong)
    except ValueError as error:
        print(error)
assert main(["models", "hollow_ring"]) == 0
assert main([
    "simulate", "hollow_ring", "--free", "--duration", "2", "--initial", "theta=0.1",
    *(w for k, v in ring.parameters().items() for w in ("--set", f"{k}={v}")),
]) == 0
run = rk.simulate(ring, rk.GroundMotion.none(2.0), initial={"theta": 0.1})
np.save("theta.npy", run.at(np.linspace(0.0, 2.0, 101))["theta"])
print(run.summary())
assert not {"sympy", "rockeom.symbolic", "rockeom.codegen"} & set(sys.modules)
"""


def python(folder: Path, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_hollow_ring_of_one_new_file_is_derived_generated_and_simulated(tmp_path):
    for name in ("rockeom", "generated"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("*.pyc.*"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    added = tmp_path / "rockeom" / "symbolic" / "structures" / "hollow_ring.py"
    added.write_text(RING, encoding="utf-8")

    # the lists of all, and the module and page of the one that is new: nothing else changes
    wrote = python(tmp_path, "-m", "rockeom.cli", "generate", "hollow_ring").split("\n")
    names = (
        "generated/shipped_structures.py",
        "rockeom/structures/shipped/declarations/hollow_ring.py",
        "rockeom/structures/classes.py", "generated/hollow_ring.py", "generated/hollow_ring.md",
    )  # fmt: skip
    assert wrote == [*(f"wrote {name}" for name in names), ""]
    for there in (ROOT / "generated").glob("*.*"):
        if there.name != "shipped_structures.py":
            assert (tmp_path / "generated" / there.name).read_bytes() == there.read_bytes()

    said = python(tmp_path, "-c", USED)
    assert "HollowRing(mass=3.0, radius=0.5, half_width=0.15, narrower=0.05, gravity=9.81)" in said
    assert "HollowRing: missing radius" in said
    assert "HollowRing: mass is -3.0: it must be finite and positive" in said
    assert "the distance of the feet is 0 with half_width = 0.05, narrower = 0.05" in said
    assert "rockeom.HollowRing(...)" in said

    # a ring's inertia is all that tells it from a block
    block = rk.RigidBlock(half_width=0.1, half_height=0.5, mass=3.0, inertia=3.0 * 0.5**2)
    run = rk.simulate(block, rk.GroundMotion.none(2.0), initial={"theta": 0.1})
    assert len(run.impacts) > 2
    assert said.count(f" {len(run.impacts)} impacts,") == 2  # on the command line and in Python
    np.testing.assert_allclose(
        np.load(tmp_path / "theta.npy"), run.at(np.linspace(0, 2, 101))["theta"], rtol=0, atol=1e-9
    )


def test_two_files_that_declare_one_name_are_told():
    def rigid_block():
        raise NotImplementedError

    with pytest.raises(ValueError, match="two structures are called rigid_block"):
        shipped(rigid_block)


def test_order_of_lists_is_that_of_the_declarations():
    """Every list of all, by what derives and by what simulates."""
    from rockeom.structures.classes import SHIPPED

    assert [*SHIPPED] == [*rk.models()]
    assert [cls.__name__ for cls in SHIPPED.values()] == [*rk._classes()]
    assert rk.models()[:2] == ("rigid_block", "slender_block")
