"""The prism in space by MuJoCo and Drake, shaken along three axes, with nothing of rockeom in it.

Contacts are as in with_mujoco.py and with_drake.py, stiffer for the greater mass. The ground's
acceleration acts as a force on the centroid, sampled before the motion, so that no Python runs
within it: MuJoCo's `rollout` and Drake's simulator take all steps by themselves.
"""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from benchmarks.engines.with_drake import RADIUS, above_ground
from benchmarks.engines.with_mujoco import solref

NO_SLIP = 2.0  # coefficient of friction
STIFFNESS = 1e15  # N/m; with 1e9, as for light blocks, two tons bounce on steps of 1e-4 s
AT_ONCE = 100_000  # steps of MuJoCo of which all states are held
FALLEN = 1.4  # rad

Motion = tuple[np.ndarray, np.ndarray, float]
"""Times (n,) [s], tilts (n,) [rad], and seconds of the processor."""


@dataclass(frozen=True)
class Shaken:
    """A prism of half sizes (b, c, h) [m], and what shakes it.

    ground : acceleration (n, 3) [m/s2] at times (n,) [s]. It is linear between samples.
    """

    half_sizes: tuple[float, float, float]
    mass: float
    gravity: float
    ground: Callable[[np.ndarray], np.ndarray]
    sample: float
    duration: float

    @property
    def moments(self) -> tuple[float, float, float]:
        """Principal moments over the mass [m2]."""
        b, c, h = self.half_sizes
        return (c * c + h * h) / 3, (b * b + h * h) / 3, (b * b + c * c) / 3


def tilts(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Angle of the axis from the vertical by two components of the quaternion."""
    return 2.0 * np.arcsin(np.minimum(1.0, np.hypot(x, y)))


def by_mujoco(case: Shaken, step: float) -> Motion:
    import mujoco
    from mujoco import rollout

    (b, c, h), m = case.half_sizes, case.mass
    moments = " ".join(repr(m * each) for each in case.moments)
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step!r}" integrator="Euler" cone="elliptic" impratio="100" '
        f'tolerance="1e-12" iterations="200" gravity="0 0 {-case.gravity!r}"/>'
        '<worldbody><geom name="ground" type="plane" size="50 50 1" contype="0" conaffinity="0"/>'
        f'<body pos="0 0 {h!r}"><freejoint/>'
        f'<inertial pos="0 0 0" mass="{m!r}" diaginertia="{moments}"/>'
        f'<geom name="prism" type="box" size="{b!r} {c!r} {h!r}" contype="0" conaffinity="0"/>'
        '</body></worldbody><contact><pair geom1="ground" geom2="prism" condim="3" '
        f'friction="{NO_SLIP!r} {NO_SLIP!r} 0 0 0" solref="{solref({"restitution": 0}, step)}" '
        'solimp="0.99 0.99 0.001 0.5 2"/></contact></mujoco>'
    )
    data = mujoco.MjData(model)
    whole = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.empty(mujoco.mj_stateSize(model, whole))
    mujoco.mj_getState(model, data, state, whole)
    parts, taken, warm = [(np.zeros(1), np.zeros(1))], 0.0, None
    for times in _pieces(case.duration, step):
        force = np.zeros((1, len(times), 6))
        force[0, :, :3] = -m * case.ground(times)
        started = time.process_time()
        states, _ = rollout.rollout(
            model, [data], state[None], force, initial_warmstart=warm,
            control_spec=int(mujoco.mjtState.mjSTATE_QFRC_APPLIED),
        )  # fmt: skip
        taken += time.process_time() - started
        state, warm = states[0, -1].copy(), data.qacc_warmstart[None].copy()
        parts.append((states[0, :, 0], tilts(states[0, :, 5], states[0, :, 6])))
        if parts[-1][1].max() > FALLEN:
            break
    t, tilt = (np.concatenate(part) for part in zip(*parts, strict=True))
    return t, tilt, taken


def _pieces(duration: float, step: float) -> Iterator[np.ndarray]:
    steps = round(duration / step)
    for first in range(0, steps, AT_ONCE):
        yield step * np.arange(first, min(first + AT_ONCE, steps))


def by_drake(case: Shaken, step: float) -> Motion:
    """Its states are kept each millisecond."""
    from pydrake.all import (
        LogVectorOutput,
        PiecewisePolynomial,
        RigidTransform,
        Simulator,
        TrajectorySource,
    )

    builder, plant, material = above_ground(step, case.gravity, NO_SLIP, STIFFNESS)
    link = _link(plant, case, material)
    plant.Finalize()
    times = case.sample * np.arange(round(case.duration / case.sample) + 1)
    forces = np.zeros((6, len(times)))
    forces[3:] = -case.mass * case.ground(times).T
    source = builder.AddSystem(TrajectorySource(PiecewisePolynomial.FirstOrderHold(times, forces)))
    builder.Connect(source.get_output_port(), plant.get_applied_generalized_force_input_port())
    log = LogVectorOutput(plant.get_state_output_port(), builder, publish_period=1e-3)
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, link, RigidTransform([0.0, 0.0, case.half_sizes[2]]))
    simulator.Initialize()
    started = time.process_time()
    for second in np.arange(1.0, case.duration + 1.0):
        simulator.AdvanceTo(min(second, case.duration))
        x, y = plant.GetPositions(context)[1:3]
        if tilts(x, y) > FALLEN:
            break
    taken = time.process_time() - started
    kept = log.FindLog(simulator.get_context())
    return kept.sample_times(), tilts(kept.data()[1], kept.data()[2]), taken


def _link(plant, case: Shaken, material):
    """The prism, its corners small spheres as in with_drake.py."""
    from pydrake.all import RigidTransform, SpatialInertia, Sphere, UnitInertia

    inertia = SpatialInertia(case.mass, [0.0, 0.0, 0.0], UnitInertia(*case.moments))
    link, (b, c, h) = plant.AddRigidBody("prism", inertia), case.half_sizes
    for i, (x, y) in enumerate([(-b, -c), (b, -c), (b, c), (-b, c)]):
        corner = RigidTransform([x, y, -h])
        plant.RegisterCollisionGeometry(link, corner, Sphere(RADIUS), f"corner_{i}", material)
    return link


PROGRAMS = {
    "MuJoCo": ("mujoco", "mujoco", by_mujoco), "Drake": ("pydrake", "drake", by_drake),
}  # fmt: skip
"""Package as Python imports it, as pip installs it, and the runner."""
