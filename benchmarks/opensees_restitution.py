"""Restitution of a rocking block in OpenSees: by the contact, its stiffness and damping, the step.

`python -m benchmarks.opensees_restitution`, with openseespy 3.7.1.2 on Python 3.11. A block is let
go from a tilt. Its rotations at rest between landings give the ratio r of the energies by which a
landing divides them, beside the r that `energy_ratio_on_contact_springs` expects. Five contacts:

    ViscoelasticGap   a spring and a damper that act while the foot is down
    ENT               a spring that presses, without damper
    ENT, HHT          the same, integrated by Hilber, Hughes and Taylor's method with its alpha
    ENT + dashpot     a spring that presses, and a dashpot that never lets go
    zeroLengthContact2D   springs that press, and springs sideways up to a friction of 1

The middle of the base is guided vertically, except on the last, where the friction holds it.
"""

import argparse
import importlib.util
import math
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from benchmarks.engines.with_opensees import environment
from benchmarks.report import table
from rockeom.analysis import formulas

HALF_WIDTH, HALF_HEIGHT, MASS, GRAVITY = 0.1, 0.4, 1000.0, 9.81
WEIGHT, INERTIA = MASS * GRAVITY, MASS * (HALF_WIDTH**2 + HALF_HEIGHT**2) / 3
ALPHA = math.atan2(HALF_WIDTH, HALF_HEIGHT)
RELEASE = 0.3 * ALPHA
START, END = "<!-- table of opensees_restitution -->", "<!-- end of opensees_restitution -->"


class Way(NamedTuple):
    """A row of the table.

    softness : rotation at uplift over that of the release. step : in shortest time constants of
    the heave. alpha : of HHT. sideways : stiffness of zeroLengthContact2D over the normal one.
    """

    contact: str
    softness: float
    damping_ratio: float
    step: float = 0.1
    alpha: float = 1.0
    sideways: float = 1.0

    @property
    def stiffness(self) -> float:
        return WEIGHT / (2 * HALF_WIDTH * self.softness * RELEASE)

    @property
    def frequency(self) -> float:
        """Of the heave on both feet [rad/s]."""
        return math.sqrt(2 * self.stiffness / MASS)

    @property
    def damping(self) -> float:
        return self.damping_ratio * MASS * self.frequency

    @property
    def seconds(self) -> float:
        zeta = max(self.damping_ratio, 1.0)
        return self.step / (self.frequency * (zeta + math.sqrt(zeta**2 - 1)))


GAP, ENT, HHT, DASHPOT = "ViscoelasticGap", "ENT", "ENT, HHT", "ENT + dashpot"
CONTACT = "zeroLengthContact2D"
BLOCK = {"half_width": HALF_WIDTH, "half_height": HALF_HEIGHT, "mass": MASS, "gravity": GRAVITY}


def ways() -> list[Way]:
    """The rows: springs for a wanted r first."""
    wanted = [
        formulas.contact_springs_for_energy_ratio(r, peak_rotation=RELEASE, **BLOCK)
        for r in (0.75, 0.80, 0.85)
    ]
    return [
        *(Way(GAP, 0.01, springs.damping_ratio) for springs in wanted),
        *(Way(GAP, s, z) for s in (1e-2, 1e-3, 1e-4) for z in (0.1, 0.5, 1.0, 3.0)),
        *(Way(GAP, 1e-3, 1.0, step) for step in (1.0, 0.3, 0.03)),
        *(Way(ENT, 1e-3, 0.0, step) for step in (1.0, 0.1)),
        *(Way(HHT, 1e-3, 0.0, step, 0.67) for step in (1.0, 0.1)),
        *(Way(DASHPOT, 1e-3, z) for z in (0.001, 0.01, 0.1)),
        *(Way(CONTACT, 1e-3, 0.0, 0.03, sideways=ratio) for ratio in (0.1, 1.0, 10.0, 100.0)),
    ]


HEAD = ("contact", "uplift/release", "zeta", "step", "r expected", "r", "r that follow")


def block(ops, way: Way) -> None:
    """The tilted block on its settled right foot."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    places = {1: (0.0, 0.0), 2: (-HALF_WIDTH, 0.0), 3: (HALF_WIDTH, 0.0), 4: (0.0, HALF_HEIGHT)}
    for node, place in places.items():
        ops.node(node, *place)
    ops.mass(4, MASS, MASS, INERTIA)
    ops.geomTransf("Corotational", 1)
    for element, other in enumerate((2, 3, 4), 1):
        ops.element("elasticBeamColumn", element, 1, other, 1.0, 1e6 * way.stiffness, 1.0, 1)
    contacts(ops, way, {2: places[2], 3: places[3]})
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(4, 0.0, -WEIGHT, 0.0)
    sine, cosine = math.sin(RELEASE), math.cos(RELEASE)
    upright = INERTIA + MASS * HALF_HEIGHT**2
    pressed = WEIGHT / (1 + MASS * HALF_WIDTH**2 / upright)  # the centroid is falling
    heave = HALF_WIDTH * sine - pressed / way.stiffness
    for node, (x, y) in places.items():
        start = (x * (cosine - 1) + y * sine, heave + y * (cosine - 1) - x * sine, -RELEASE)
        for direction in (2, 3) if node == 1 else (1, 2, 3):
            ops.setNodeDisp(node, direction, start[direction - 1], "-commit")


def contacts(ops, way: Way, feet: dict[int, tuple[float, float]]) -> None:
    """A contact under each foot, and the guide of the base."""
    if way.contact == GAP:
        ops.uniaxialMaterial(GAP, 1, way.stiffness, way.damping, -0.0)
    else:
        ops.uniaxialMaterial("ENT", 2, way.stiffness)
        ops.uniaxialMaterial("Elastic", 3, 0.0, way.damping)
        ops.uniaxialMaterial("Parallel", 1, 2, 3)
    normal, sideways = way.stiffness, way.sideways * way.stiffness
    for foot, place in feet.items():
        element = ground = foot + 4
        ops.node(ground, *place)
        ops.fix(ground, 1, 1, 1)
        if way.contact == CONTACT:
            ops.element(CONTACT, element, foot, ground, normal, sideways, 1.0, "-normal", 0.0, 1.0)
        else:
            ops.element("zeroLength", element, ground, foot, "-mat", 1, "-dir", 2)
    if way.contact != CONTACT:
        ops.fix(1, 1, 0, 0)


def analysis(ops, way: Way) -> None:
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", max(1e-12, 1e-6 * WEIGHT / way.stiffness), 50)
    ops.algorithm("Newton")
    if way.contact == HHT:
        ops.integrator("HHT", way.alpha)
    else:
        ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def advance(ops, step: float, halvings: int = 8) -> bool:
    """One step, in halves where there is no equilibrium, as the contact opens or closes in it."""
    if ops.analyze(1, step) == 0:
        return True
    return halvings > 0 and all(advance(ops, step / 2, halvings - 1) for _ in range(2))


def ratios(ops, way: Way, landings: int = 4) -> list[float]:
    """r of the landings by the peaks between them, of 2 s at most; none where the block rests."""
    block(ops, way)
    analysis(ops, way)
    side, peaks = 1, [RELEASE]  # the last is of a swing that goes on
    for _ in range(round(2.0 / way.seconds)):
        if len(peaks) > landings + 1 or not advance(ops, way.seconds):
            break
        theta = -ops.nodeDisp(1, 3)
        if theta * side < 0:
            side = -side
            peaks.append(0.0)
        peaks[-1] = max(peaks[-1], abs(theta))
    return list(formulas.energy_ratios_from_peaks(peaks[:-1], ALPHA)) if len(peaks) > 2 else []


def row(ops, way: Way) -> tuple[str, ...]:
    expected = "none"
    if way.contact == GAP:
        r = formulas.energy_ratio_on_contact_springs(
            way.stiffness, way.damping, peak_rotation=RELEASE, **BLOCK
        )
        expected = f"{r:.4f}"
    found = [f"{r:.4f}" for r in ratios(ops, way)] or ["rests"]
    more = {HHT: f" {way.alpha:g}", CONTACT: f", Kt {way.sideways:g} Kn"}
    name = way.contact + more.get(way.contact, "")
    return (
        name, f"{way.softness:g}", f"{way.damping_ratio:.3g}", f"{way.step:g}",
        expected, found[0], ", ".join(r[:5] for r in found[1:]),
    )  # fmt: skip


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.opensees_restitution")
    parser.add_argument("--write", type=Path, help="a page that has the table between its marks")
    parser.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args(argv)
    if importlib.util.find_spec("openseespy") is None:
        raise SystemExit("OpenSees is not installed: pip install openseespy==3.7.1.2, Python 3.11")
    if arguments.inside:
        import openseespy.opensees as ops

        print(table(HEAD, [row(ops, way) for way in ways()]))
        return
    # the wheel finds its libraries only by an environment that it is started with
    command = [sys.executable, "-m", "benchmarks.opensees_restitution", "--inside"]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr.strip()[-500:])
    text = "\n".join(line for line in done.stdout.splitlines() if line.startswith("|"))
    print(text)
    if arguments.write:
        before, _, rest = arguments.write.read_text(encoding="utf-8").partition(START)
        after = rest.partition(END)[2]
        page = f"{before}{START}\n\n{text}\n\n{END}{after}"
        arguments.write.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
