"""The same motions by OpenSees, Exudyn and MuJoCo, beside ours and what is known in closed form.

`make crosscheck`, or `python -m benchmarks.crosscheck`. Each program integrates by a method of its
own with equal steps, each from its own model of the same structure: corotational finite elements, a
multibody system with constraints, and one in the coordinates of its joints. A program that is not
installed has a row that says so. Here bodies turn in joints and on springs; `benchmarks.engines`
gives the programs contacts.
"""

import argparse
import importlib.util
import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import ModuleType

import numpy as np
from scipy.integrate import quad

import rockeom as rk
from benchmarks import report
from benchmarks.engines import case, trace, with_exudyn, with_mujoco, with_opensees
from benchmarks.engines.with_opensees import sprung
from benchmarks.report import scientific, table

# -- the motions ---------------------------------------------------------------------------------

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
RELEASE = 0.1  # rad
SPRINGS_CASE = case("two-springs")
SPRUNG = sprung(SPRINGS_CASE)
COLUMN = rk.FlexibleStructure(
    mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.10, base_inertia=1.37,
    half_width=0.285, stiffness=571.8e3, damping=0.0,
    support=rk.TwoSprings(stiffness=5e5, damping=0.0),
)  # fmt: skip
TILT = SPRINGS_CASE["parameters"]["rotation"]["value"]  # rad
FOLLOWED = SPRINGS_CASE["duration"]  # s; the feet lift and land seven times in all
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
    """When theta first passes through zero [s]."""
    found = trace.crossing(t, theta, rate, 0.0)
    if found is None:
        raise ArithmeticError("the block does not come upright")
    return found[1]


# -- the programs --------------------------------------------------------------------------------


def opensees_springs(step: float) -> np.ndarray:
    return by_engine(with_opensees, step)


def exudyn_springs(step: float) -> np.ndarray:
    return by_engine(with_exudyn, step)


def mujoco_springs(step: float) -> np.ndarray:
    return by_engine(with_mujoco, step)


def by_engine(engine: ModuleType, step: float) -> np.ndarray:
    """Rotations at TIMES by a runner of the reference cases."""
    motion = engine.run(SPRINGS_CASE, step)
    return np.interp(TIMES, motion.t, motion.bodies["block"][:, trace.ROTATION])


def opensees_column(step: float) -> np.ndarray:
    rows = with_opensees.rows_of(COLUMN, {"theta": TILT}, FOLLOWED, step)
    return np.interp(TIMES, rows[:, 0], rows[:, 1])


def exudyn_block(step: float) -> float:
    """A body in the plane on a revolute joint at its foot; the trapezoidal rule."""
    mbs, _system = with_exudyn.plane()
    b, h = BLOCK.half_width, BLOCK.half_height
    sine, cosine = math.sin(RELEASE), math.cos(RELEASE)
    body = {
        "x": h * sine - b * cosine, "z": b * sine + h * cosine, "rotation": RELEASE,
        "velocity": (0.0, 0.0, 0.0), "mass": BLOCK.mass, "inertia": BLOCK.parameters()["inertia"],
    }  # fmt: skip
    node, handle = with_exudyn.add_body(mbs, body, BLOCK.gravity)
    ground = mbs.AddObject({"objectType": "Ground", "referencePosition": [0, 0, 0]})
    markers = [
        with_exudyn.marker(mbs, ground, [0, 0, 0]), with_exudyn.marker(mbs, handle, [b, -h, 0]),
    ]  # fmt: skip
    mbs.AddObject({"objectType": "JointRevolute2D", "markerNumbers": markers})
    rows = with_exudyn.solved(mbs, node, step, 0.6)
    return crossing(rows[:, 0], -rows[:, 3] + RELEASE, -rows[:, 6])


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


OPENSEES, EXUDYN, MUJOCO = (
    (engine.PACKAGE, engine.INSTALL) for engine in (with_opensees, with_exudyn, with_mujoco)
)
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


written = partial(report.written, marks=(START, END))


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
