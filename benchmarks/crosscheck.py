"""The same motions by OpenSees, Exudyn and MuJoCo, beside ours and what is known in closed form.

`make crosscheck`, or `python -m benchmarks.crosscheck`. Each program integrates by a method of its
own with equal steps, each from its own model of the same structure: corotational finite elements, a
multibody system with constraints, and one in the coordinates of its joints. A program that is not
installed has a row that says so.
"""

from __future__ import annotations

import argparse
import importlib.util
import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.integrate import quad

import rockeom as rk
from benchmarks.report import scientific, table

# -- the motions ---------------------------------------------------------------------------------

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
RELEASE = 0.1  # rad
SPRUNG = rk.TwoSpringStructure(
    mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.10, base_inertia=1.37,
    half_width=0.285, foundation_stiffness=5e5, foundation_damping=0.0,
)  # fmt: skip
COLUMN = rk.FlexibleStructure(
    mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.10, base_inertia=1.37,
    half_width=0.285, stiffness=571.8e3, damping=0.0,
    support=rk.TwoSprings(stiffness=5e5, damping=0.0),
)  # fmt: skip
TILT = 0.05  # rad
FOLLOWED = 0.5  # s; the feet lift and land seven times in all
TIMES = np.linspace(0.01, FOLLOWED, 50)
TIGHT = rk.SolverOptions("DOP853", rtol=1e-12, atol=1e-14)
START, END = "<!-- table of crosscheck -->", "<!-- end of crosscheck -->"


def first_impact_exactly() -> float:
    """When the block that is let go comes upright [s], by quadrature of its energy.

    I_o theta'^2 / 2 = m g R (cos(alpha - theta_0) - cos(alpha - theta)), and theta goes as a square
    from theta_0, which takes the infinite slowness away from there.
    """
    alpha, r = BLOCK.alpha, math.hypot(BLOCK.half_width, BLOCK.half_height)
    inertia = r * r / 3.0 + r * r  # per mass, about a foot

    def slowness(s: float) -> float:
        fallen = RELEASE * s * s
        # cos(a) - cos(b) = 2 sin((a + b) / 2) sin((b - a) / 2), without cancellation
        drop = 2.0 * math.sin(alpha - RELEASE + 0.5 * fallen) * math.sin(0.5 * fallen)
        return 2.0 * RELEASE * s / math.sqrt(2.0 * BLOCK.gravity * r * drop / inertia)

    return quad(slowness, 0.0, 1.0, epsabs=1e-13, epsrel=1e-13)[0]


def first_impact_of_ours() -> float:
    run = rk.simulate(BLOCK, rk.GroundMotion.none(1.0), initial={"theta": RELEASE}, options=TIGHT)
    return run.impacts[0].time


def rotations_of_ours(structure: rk.Structure) -> np.ndarray:
    """At TIMES, after it was tilted and let go."""
    run = rk.simulate(
        structure, rk.GroundMotion.none(FOLLOWED), initial={"theta": TILT}, options=TIGHT
    )
    return run.at(TIMES)["theta"]


def crossing(t: np.ndarray, theta: np.ndarray, rate: np.ndarray) -> float:
    """When theta first falls to zero, by the cubic through both ends of the step [s]."""
    i = int(np.nonzero(theta <= 0.0)[0][0])
    h, a, b = t[i] - t[i - 1], theta[i - 1], theta[i]
    p, q = h * rate[i - 1], h * rate[i]
    roots = np.roots([2 * a - 2 * b + p + q, -3 * a + 3 * b - 2 * p - q, p, a])
    inside = [x.real for x in roots if abs(x.imag) < 1e-9 and -1e-9 <= x.real <= 1.0 + 1e-9]
    return float(t[i - 1] + h * min(inside))


# -- the programs --------------------------------------------------------------------------------


def opensees_springs(step: float) -> np.ndarray:
    return opensees(SPRUNG, step)


def opensees_column(step: float) -> np.ndarray:
    return opensees(COLUMN, step)


def opensees(structure: rk.Structure, step: float) -> np.ndarray:
    """Rotations at TIMES by the script that `rockeom export opensees` writes."""
    from rockeom.exports.opensees import script

    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / "model.py", Path(folder) / "rows.csv"
        motion = rk.GroundMotion.none(FOLLOWED)
        text = script(structure, motion, initial={"theta": TILT}, step=step, out=str(out))
        path.write_text(text, encoding="utf-8")
        done = subprocess.run(
            [sys.executable, path], env=environment(), capture_output=True, text=True
        )
        if not out.exists():
            raise ArithmeticError(f"OpenSees: {done.stderr.strip()[-300:]}")
        rows = np.loadtxt(out, delimiter=",", skiprows=1)
    return np.interp(TIMES, rows[:, 0], rows[:, 1])


def environment() -> dict[str, str]:
    """That of this process; the wheel of OpenSees finds its libraries only where it is told."""
    spec = importlib.util.find_spec("openseespylinux")
    if spec is None or not spec.submodule_search_locations:
        return dict(os.environ)
    folder = os.path.join(next(iter(spec.submodule_search_locations)), "lib")
    known = os.environ.get("LD_LIBRARY_PATH")
    return {**os.environ, "LD_LIBRARY_PATH": f"{folder}:{known}" if known else folder}


def exudyn_block(step: float) -> float:
    """A body in the plane on a revolute joint at its foot; the trapezoidal rule."""
    mbs, _system = _exudyn_plane()
    inertia, b, h = BLOCK.parameters()["inertia"], BLOCK.half_width, BLOCK.half_height
    sine, cosine = math.sin(RELEASE), math.cos(RELEASE)
    x, y = h * sine - b * cosine, b * sine + h * cosine
    node, body = _exudyn_body(mbs, BLOCK.mass, inertia, (x, y), -RELEASE, BLOCK.gravity)
    ground = mbs.AddObject({"objectType": "Ground", "referencePosition": [0, 0, 0]})
    at_ground = _marker(mbs, ground, [0, 0, 0])
    at_body = _marker(mbs, body, [b, -h, 0])
    mbs.AddObject({"objectType": "JointRevolute2D", "markerNumbers": [at_ground, at_body]})
    rows = _exudyn_run(mbs, node, step, 0.6)
    return crossing(rows[:, 0], -rows[:, 1] + RELEASE, -rows[:, 2])


def exudyn_springs(step: float) -> np.ndarray:
    """A body in the plane, guided at its base, on springs that press and never pull."""
    s, k = SPRUNG, SPRUNG.foundation_stiffness
    mbs, _system = _exudyn_plane()
    mass, centroid, inertia = _rigid_whole()
    settled = -mass * s.gravity / (2 * k)
    x, y = centroid * math.sin(TILT), centroid * math.cos(TILT) + settled
    node, body = _exudyn_body(mbs, mass, inertia, (x, y), -TILT, s.gravity)
    ground = mbs.AddObject({"objectType": "Ground", "referencePosition": [0, 0, 0]})

    def press(_mbs, _t, _item, displacement, *_):
        return [0.0, k * min(displacement[1], 0.0), 0.0]

    for side in (-1, 1):
        foot = _marker(mbs, body, [side * s.half_width, -centroid, 0])
        below = _marker(mbs, ground, [0, 0, 0])
        mbs.AddObject(
            {
                "objectType": "ConnectorCartesianSpringDamper",
                "markerNumbers": [below, foot],
                "stiffness": [0, k, 0],
                "springForceUserFunction": press,
            }
        )
    middle = _marker(mbs, body, [0, -centroid, 0], rigid=True)
    mbs.AddObject(
        {
            "objectType": "JointPrismatic2D",
            "markerNumbers": [middle, _marker(mbs, ground, [0, 0, 0], rigid=True)],
            "axisMarker0": [0, 1, 0],
            "normalMarker1": [1, 0, 0],
            "constrainRotation": False,
        }
    )
    rows = _exudyn_run(mbs, node, step, FOLLOWED)
    return np.interp(TIMES, rows[:, 0], -rows[:, 1] + TILT)


def _rigid_whole() -> tuple[float, float, float]:
    """Mass, height of the centroid and inertia about it, of both masses as one."""
    s = SPRUNG
    mass = s.mass + s.base_mass
    centroid = (s.mass * s.height + s.base_mass * s.base_height) / mass
    inertia = s.inertia + s.base_inertia
    inertia += s.mass * (s.height - centroid) ** 2 + s.base_mass * (centroid - s.base_height) ** 2
    return mass, centroid, inertia


def _exudyn_plane():
    import exudyn as exu

    exu.config.printToConsole = False
    system = exu.SystemContainer()
    return system.AddSystem(), system


def _exudyn_body(mbs, mass, inertia, place, angle, gravity):
    node = mbs.AddNode(
        {
            "nodeType": "RigidBody2D",
            "referenceCoordinates": [*place, angle],
            "initialCoordinates": [0.0, 0.0, 0.0],
            "initialVelocities": [0.0, 0.0, 0.0],
        }
    )
    body = mbs.AddObject(
        {
            "objectType": "RigidBody2D",
            "nodeNumber": node,
            "mass": mass,
            "inertia": inertia,
        }
    )
    weight = mbs.AddMarker({"markerType": "BodyMass", "bodyNumber": body})
    mbs.AddLoad(
        {"loadType": "MassProportional", "markerNumber": weight, "loadVector": [0, -gravity, 0]}
    )
    return node, body


def _marker(mbs, body, place, rigid=False):
    kind = "BodyRigid" if rigid else "BodyPosition"
    return mbs.AddMarker({"markerType": kind, "bodyNumber": body, "localPosition": place})


def _exudyn_run(mbs, node, step, duration) -> np.ndarray:
    """(n, 3): time, turned so far, rate."""
    import exudyn as exu

    kept = {"sensorType": "Node", "nodeNumber": node, "storeInternal": True, "writeToFile": False}
    what = exu.OutputVariableType
    angle, rate = (
        mbs.AddSensor({**kept, "outputVariableType": of})
        for of in (what.Coordinates, what.Coordinates_t)
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.verboseMode = 0
    # the trapezoidal rule; constraints on velocities, whose forces do not oscillate
    settings.timeIntegration.generalizedAlpha.useNewmark = True
    settings.timeIntegration.generalizedAlpha.useIndex2Constraints = True
    settings.timeIntegration.newton.relativeTolerance = 1e-10
    settings.timeIntegration.newton.absoluteTolerance = 1e-12
    settings.solution.sensors.writePeriod = step
    settings.solution.file.write = False
    mbs.SolveDynamic(settings)
    angles, rates = mbs.GetSensorStoredData(angle), mbs.GetSensorStoredData(rate)
    return np.column_stack([angles[:, 0], angles[:, 3], rates[:, 3]])


def mujoco_block(step: float) -> float:
    """A hinge at the foot, in one coordinate; Runge and Kutta's method of order 4."""
    import mujoco

    p = BLOCK.parameters()
    model, data = _mujoco(
        step, BLOCK.gravity,
        '<joint name="turn" type="hinge" axis="0 1 0"/>',
        BLOCK.mass, p["inertia"], (-BLOCK.half_width, BLOCK.half_height),
    )  # fmt: skip
    data.qpos[0] = RELEASE
    rows = [(0.0, data.qpos[0], 0.0)]
    while data.qpos[0] > 0.0:
        mujoco.mj_step(model, data)
        rows.append((data.time, data.qpos[0], data.qvel[0]))
    return crossing(*np.array(rows).T)


def mujoco_springs(step: float) -> np.ndarray:
    """A slide and a hinge; the springs are forces that it asks for at each stage of a step."""
    import mujoco

    s, k = SPRUNG, SPRUNG.foundation_stiffness
    mass, centroid, inertia = _rigid_whole()
    model, data = _mujoco(
        step, s.gravity,
        '<joint name="heave" type="slide" axis="0 0 1"/>'
        '<joint name="turn" type="hinge" axis="0 1 0"/>',
        mass, inertia, (0.0, centroid),
    )  # fmt: skip
    data.qpos[:] = (-mass * s.gravity / (2 * k), TILT)

    def press(_model, now) -> None:
        y, theta = now.qpos
        for side in (-1, 1):
            arm = side * s.half_width
            force = k * max(arm * math.sin(theta) - y, 0.0)
            now.qfrc_passive[0] += force
            now.qfrc_passive[1] -= force * arm * math.cos(theta)

    mujoco.set_mjcb_passive(press)
    try:
        rows = [(0.0, TILT)]
        for _ in range(round(FOLLOWED / step)):
            mujoco.mj_step(model, data)
            rows.append((data.time, data.qpos[1]))
    finally:
        mujoco.set_mjcb_passive(None)
    t, theta = np.array(rows).T
    return np.interp(TIMES, t, theta)


def _mujoco(step, gravity, joints, mass, inertia, centroid):
    import mujoco

    x, z = centroid
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><option timestep="{step!r}" integrator="RK4" gravity="0 0 {-gravity!r}"/>
        <worldbody><body>{joints}<inertial pos="{x!r} 0 {z!r}" mass="{mass!r}"
        diaginertia="{inertia!r} {inertia!r} {inertia!r}"/></body></worldbody></mujoco>"""
    )
    return model, mujoco.MjData(model)


# -- the table -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Way:
    """A motion by a program.

    needs : the package, and how it is installed; run : what is compared, by the step.
    """

    motion: str
    program: str
    needs: tuple[str, str]
    steps: tuple[float, ...]
    run: Callable[[float], float | np.ndarray]


OPENSEES = ("openseespy", "pip install openseespy==3.7.1.2, on Python 3.11")
EXUDYN = ("exudyn", "pip install exudyn")
MUJOCO = ("mujoco", "pip install mujoco")
FREE, SPRINGS = "block: first impact [s]", "two springs: rotation [rad]"
ELASTIC = "column on springs: rotation [rad]"
WAYS = (
    Way(FREE, "Exudyn", EXUDYN, (1e-2, 1e-3, 1e-4), exudyn_block),
    Way(FREE, "MuJoCo", MUJOCO, (1e-2, 1e-3, 1e-4), mujoco_block),
    Way(SPRINGS, "OpenSees", OPENSEES, (1e-3, 1e-4, 2.5e-5), opensees_springs),
    Way(SPRINGS, "Exudyn", EXUDYN, (1e-3, 1e-4), exudyn_springs),
    Way(SPRINGS, "MuJoCo", MUJOCO, (1e-3, 1e-4, 2.5e-5), mujoco_springs),
    Way(ELASTIC, "OpenSees", OPENSEES, (1e-3, 1e-4, 2.5e-5), opensees_column),
)
NOT_INSTALLED = "not installed"
HEAD = ("motion", "program", "step [s]", "error", "order")


def missing(way: Way) -> bool:
    return importlib.util.find_spec(way.needs[0]) is None


def rows_of(way: Way, expected: float | np.ndarray) -> list[tuple[str, ...]]:
    """Its errors by step, and the order from one step to the next."""
    if missing(way):
        return [(way.motion, way.program, "", NOT_INSTALLED, "")]
    rows: list[tuple[str, ...]] = []
    last: tuple[float, float] | None = None
    for step in way.steps:
        try:
            error = float(np.abs(way.run(step) - expected).max())
        except Exception as failure:  # a program may have changed, or lack a library here
            print(f"{way.program}: {' '.join(str(failure).split())}", file=sys.stderr)
            rows.append((way.motion, way.program, f"{step:g}", "failed", ""))
            continue
        order = math.log(last[1] / error) / math.log(last[0] / step) if last and error else None
        rows.append(
            (
                way.motion,
                way.program,
                f"{step:g}",
                scientific(error),
                "" if order is None else f"{order:.1f}",
            )
        )
        last = step, error
    return rows


def all_rows(ways: Sequence[Way] = WAYS) -> list[tuple[str, ...]]:
    """The whole table, ours first."""
    exactly = first_impact_exactly()
    ours = abs(first_impact_of_ours() - exactly)
    said = scientific(ours) if ours > 1e-15 else "below 1e-15"
    rows: list[tuple[str, ...]] = [(FREE, "rockeom", "rtol 1e-12", said, "")]
    structures = {SPRINGS: SPRUNG, ELASTIC: COLUMN}
    expected: dict[str, float | np.ndarray] = {FREE: exactly}
    for way in ways:
        if way.motion not in expected and not missing(way):
            expected[way.motion] = rotations_of_ours(structures[way.motion])
        rows += rows_of(way, expected.get(way.motion, math.nan))
    return rows


def remedies() -> list[str]:
    """What to do about the programs that are not installed."""
    lacking = {way.program: way.needs[1] for way in WAYS if missing(way)}
    return [f"{program} is not installed: {remedy}." for program, remedy in lacking.items()]


def written(text: str, page: str) -> str:
    """A page with the table between its marks; raises ValueError where it has none."""
    before, start, rest = page.partition(START)
    _, end, after = rest.partition(END)
    if not start or not end:
        raise ValueError(f"the page has no {START} and {END} between which the table stands")
    return f"{before}{START}\n\n{text}\n\n{END}{after}"


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.crosscheck", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of crosscheck.md")
    parser.add_argument("--write", type=Path, help="a page that has the table between its marks")
    arguments = parser.parse_args(argv)
    text = "\n\n".join([table(HEAD, all_rows()), *remedies()])
    print(text)
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "crosscheck.md").write_text(text + "\n", encoding="utf-8")
    if arguments.write:
        page = arguments.write.read_text(encoding="utf-8")
        arguments.write.write_text(written(text, page), encoding="utf-8")


if __name__ == "__main__":
    main()
