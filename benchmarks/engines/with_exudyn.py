"""Exudyn: bodies in the plane, contacts and springs as forces that this file gives it.

It has no contact of a box with the ground. A corner that is below the ground gets a spring and a
damper, critically damped, in which the block's mass would swing in 8 pi steps, so that the contact
stiffens as the step shortens; a corner without slip has the same spring to the place where it
belongs, and friction is tanh(velocity/1e-4 m/s) times the coefficient. The method is Runge and
Kutta's of order 4 with contacts, and with guides the trapezoidal rule, constraints on velocities.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np

from benchmarks.engines.trace import Trace, UnsupportedError, ground

NAME, PACKAGE = "Exudyn", "exudyn"
INSTALL = "pip install exudyn"
SETTINGS = "penalty forces at the corners, critically damped, sqrt(mass/k) of 4 steps"
STEPS, SLOW = 4.0, 1e-4  # sqrt(mass/k) in steps; m/s
FORCE = Callable[..., list[float]]


def run(case: Mapping, step: float) -> Trace:
    model = case["model"]
    if len(model["bodies"]) > 1:
        raise UnsupportedError("contacts between bodies are not built here")
    if any(contact["restitution"] for contact in model["contacts"]):
        raise UnsupportedError("a restitution is not built here")
    mbs, _system = plane()
    (body,) = model["bodies"]
    node, handle = add_body(mbs, body, model["gravity"], ground(model))
    floor = mbs.AddObject({"objectType": "Ground", "referencePosition": [0, 0, 0]})
    for spring in model["springs"]:
        connect(mbs, floor, handle, spring["point"], pressing(spring["stiffness"]))
    if model["guides"]:
        guide(mbs, floor, handle, body["half_height"])
    for contact in model["contacts"]:
        for point in corners(body):
            force = touching(body, point, contact["friction"], step)
            connect(mbs, floor, handle, point, force)
    rows = solved(mbs, node, step, case["duration"], explicit=bool(model["contacts"]))
    rows[:, 1:4] += body["x"], body["z"], -body["rotation"]
    rows[:, [3, 6]] *= -1.0  # its rotations are anticlockwise
    return Trace(rows[:, 0], {body["name"]: rows[:, 1:]})


def corners(body: Mapping) -> list[list[float]]:
    b, h = body["half_width"], body["half_height"]
    return [[-b, -h], [b, -h], [b, h], [-b, h]]


def pressing(stiffness: float) -> FORCE:
    """An upright spring that presses and does not pull."""

    def force(_mbs, _t, _item, displacement, *_) -> list[float]:
        return [0.0, stiffness * min(displacement[1], 0.0), 0.0]

    return force


def touching(body: Mapping, point: list[float], friction: float | None, step: float) -> FORCE:
    mass = body["mass"]
    stiffness = mass / (STEPS * step) ** 2
    damping = 2.0 * math.sqrt(stiffness * mass)
    home = point[0]  # where a corner of the base stands that does not slip

    def force(_mbs, _t, _item, displacement, velocity, *_) -> list[float]:
        press = -stiffness * displacement[1] - damping * velocity[1]
        if displacement[1] >= 0.0 or press <= 0.0:
            return [0.0, 0.0, 0.0]
        if friction is None:
            across = stiffness * (displacement[0] - home) + damping * velocity[0]
        else:
            across = friction * press * math.tanh(velocity[0] / SLOW)
        return [across, -press, 0.0]

    return force


# -- the parts of a system -----------------------------------------------------------------------


def plane():
    import exudyn as exu

    exu.config.printToConsole = False
    system = exu.SystemContainer()
    return system.AddSystem(), system


def add_body(mbs, body: Mapping, gravity: float, shaking: Callable[[float], float] | None = None):
    """Its node and itself, under gravity and in the frame of the ground."""
    across, up, spin = body["velocity"]
    node = mbs.AddNode(
        {
            "nodeType": "RigidBody2D",
            "referenceCoordinates": [body["x"], body["z"], -body["rotation"]],
            "initialCoordinates": [0.0, 0.0, 0.0],
            "initialVelocities": [across, up, -spin],
        }
    )
    handle = mbs.AddObject(
        {
            "objectType": "RigidBody2D",
            "nodeNumber": node,
            "mass": body["mass"],
            "inertia": body["inertia"],
        }
    )
    weight = mbs.AddMarker({"markerType": "BodyMass", "bodyNumber": handle})
    load = {"loadType": "MassProportional", "markerNumber": weight, "loadVector": [0, -gravity, 0]}
    if shaking is not None:
        load["loadVectorUserFunction"] = lambda _mbs, t, _load: [-shaking(t), -gravity, 0.0]
    mbs.AddLoad(load)
    return node, handle


def marker(mbs, body, place, rigid=False):
    kind = "BodyRigid" if rigid else "BodyPosition"
    return mbs.AddMarker({"markerType": kind, "bodyNumber": body, "localPosition": place})


def connect(mbs, floor, body, point: list[float], force: FORCE) -> None:
    """A force between the origin of the ground and a point of a body."""
    mbs.AddObject(
        {
            "objectType": "ConnectorCartesianSpringDamper",
            "markerNumbers": [marker(mbs, floor, [0, 0, 0]), marker(mbs, body, [*point, 0])],
            "springForceUserFunction": force,
        }
    )


def guide(mbs, floor, body, low: float) -> None:
    """The middle of the base moves straight up and down."""
    mbs.AddObject(
        {
            "objectType": "JointPrismatic2D",
            "markerNumbers": [
                marker(mbs, body, [0, -low, 0], rigid=True),
                marker(mbs, floor, [0, 0, 0], rigid=True),
            ],
            "axisMarker0": [0, 1, 0],
            "normalMarker1": [1, 0, 0],
            "constrainRotation": False,
        }
    )


def solved(mbs, node, step: float, duration: float, explicit: bool = False) -> np.ndarray:
    """(n, 7): time, and x, z and rotation since the start, and their rates, by its own signs."""
    import exudyn as exu

    kept = {"sensorType": "Node", "nodeNumber": node, "storeInternal": True, "writeToFile": False}
    kinds = exu.OutputVariableType
    places, rates = (
        mbs.AddSensor({**kept, "outputVariableType": kind})
        for kind in (kinds.Coordinates, kinds.Coordinates_t)
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
    kinds = exu.DynamicSolverType
    mbs.SolveDynamic(settings, solverType=kinds.RK44 if explicit else kinds.GeneralizedAlpha)
    places, rates = mbs.GetSensorStoredData(places), mbs.GetSensorStoredData(rates)
    return np.column_stack([places[:, :4], rates[:, 1:4]])
