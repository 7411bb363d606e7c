"""Bullet by PyBullet: boxes with its own contacts, solved as velocities by projected Gauss-Seidel.

Contacts are rigid, their penetration is corrected over some steps. The method is Euler's,
semi-implicit. Nothing keeps the boxes in the plane but their symmetry. A coefficient of a contact
is the product of those of both bodies.
"""

import math
from collections.abc import Mapping

import numpy as np

from benchmarks.engines.trace import Trace, UnsupportedError, ground

NAME, PACKAGE = "Bullet", "pybullet"
INSTALL = "pip install pybullet"
SETTINGS = "boxes, 200 iterations, no sleeping, no damping"
NO_SLIP = 1.0
DEPTH = 0.5  # m, half of the boxes across the plane


def run(case: Mapping, step: float) -> Trace:
    import pybullet as bullet

    model = case["model"]
    if model["springs"]:
        raise UnsupportedError("springs and guides are not built here")
    client = bullet.connect(bullet.DIRECT)
    try:
        bullet.setTimeStep(step)
        bullet.setPhysicsEngineParameter(
            numSolverIterations=200, solverResidualThreshold=1e-14, restitutionVelocityThreshold=0.0
        )
        handles = _bodies(bullet, model)
        return _followed(bullet, model, handles, case["duration"], step)
    finally:
        bullet.disconnect(client)


def _bodies(bullet, model: Mapping) -> list[int]:
    slip = model["contacts"][0]["friction"]
    slip = NO_SLIP if slip is None else slip
    plain = {
        "lateralFriction": math.sqrt(slip), "rollingFriction": 0.0, "spinningFriction": 0.0,
        "restitution": math.sqrt(model["contacts"][0]["restitution"]), "linearDamping": 0.0,
        "angularDamping": 0.0,
    }  # fmt: skip
    floor = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_PLANE))
    bullet.changeDynamics(floor, -1, **plain)
    handles = []
    for body in model["bodies"]:
        sizes = [body["half_width"], DEPTH, body["half_height"]]
        handle = bullet.createMultiBody(
            body["mass"],
            bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=sizes),
            basePosition=[body["x"], 0.0, body["z"]],
            baseOrientation=bullet.getQuaternionFromEuler([0.0, body["rotation"], 0.0]),
        )
        bullet.changeDynamics(handle, -1, localInertiaDiagonal=[body["inertia"]] * 3, **plain)
        across, up, spin = body["velocity"]
        bullet.resetBaseVelocity(handle, [across, 0.0, up], [0.0, spin, 0.0])
        handles.append(handle)
    return handles


def _followed(bullet, model: Mapping, handles: list[int], duration: float, step: float) -> Trace:
    a = ground(model)
    n = round(duration / step)
    rows = np.zeros((n + 1, len(handles), 6))
    for i in range(n + 1):
        for k, handle in enumerate(handles):
            place, turn = bullet.getBasePositionAndOrientation(handle)
            speed, spin = bullet.getBaseVelocity(handle)
            angle = 2.0 * math.atan2(turn[1], turn[3])
            angle = math.remainder(angle, 2.0 * math.pi)
            rows[i, k] = place[0], place[2], angle, speed[0], speed[2], spin[1]
        bullet.setGravity(-a(i * step), 0.0, -model["gravity"])
        bullet.stepSimulation()
    names = [body["name"] for body in model["bodies"]]
    return Trace(np.arange(n + 1) * step, {name: rows[:, k] for k, name in enumerate(names)})
