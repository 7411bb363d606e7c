"""Drake: a discrete plant on planar joints, its corners spheres of 1e-6 m, contacts by SAP.

Drake finds one point between a box and a half space, the deepest, and so each corner is given a
small sphere. Contacts are springs and dampers, here so stiff that the solver replaces them by the
stiffest that suits the step. Its restitution depends on the mass and the stiffness at a contact and
cannot be prescribed.
"""

from collections.abc import Mapping

import numpy as np

from benchmarks.engines.trace import Trace, UnsupportedError, ground

NAME, PACKAGE = "Drake", "pydrake"
INSTALL = "pip install drake"
SETTINGS = "spheres of 1e-6 m at the corners, SAP, stiffness 1e9 N/m, relaxation time of 1 step"
NO_SLIP, STIFFNESS, RADIUS = 1.0, 1e9, 1e-6


def run(case: Mapping, step: float) -> Trace:
    from pydrake.all import Simulator

    model = case["model"]
    if model["springs"]:
        raise UnsupportedError("springs and guides are not built here")
    if model["contacts"][0]["restitution"]:
        raise UnsupportedError("a restitution cannot be prescribed")
    friction = model["contacts"][0]["friction"]
    builder, plant, material = above_ground(step, model["gravity"], friction)
    joints = _bodies(plant, model, material)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    for joint, body in zip(joints, model["bodies"], strict=True):
        across, up, spin = body["velocity"]
        joint.set_translation(context, [body["x"], body["z"]])
        joint.set_rotation(context, -body["rotation"])
        joint.set_translational_velocity(context, [across, up])
        joint.set_angular_velocity(context, -spin)
    return _followed(plant, simulator, context, joints, case, step)


def above_ground(step: float, gravity: float, friction: float | None, stiffness: float = STIFFNESS):
    """Builder, plant with a half space below z = -RADIUS, and the material of all that touches."""
    from pydrake.all import (
        AddContactMaterial,
        AddMultibodyPlantSceneGraph,
        ContactModel,
        CoulombFriction,
        DiagramBuilder,
        DiscreteContactApproximation,
        HalfSpace,
        ProximityProperties,
        RigidTransform,
    )

    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, step)
    plant.set_contact_model(ContactModel.kPoint)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -gravity])
    slip, material = NO_SLIP if friction is None else friction, ProximityProperties()
    AddContactMaterial(0.0, stiffness, CoulombFriction(slip, slip), material)
    material.AddProperty("material", "relaxation_time", step)
    plant.RegisterCollisionGeometry(
        plant.world_body(), RigidTransform([0.0, 0.0, -RADIUS]), HalfSpace(), "ground", material
    )
    return builder, plant, material


def _bodies(plant, model: Mapping, material) -> list:
    from pydrake.all import (
        Box,
        FixedOffsetFrame,
        PlanarJoint,
        RigidTransform,
        RotationMatrix,
        SpatialInertia,
        Sphere,
        UnitInertia,
    )

    # a plane whose first axis is x and whose second is z: rotations in it are anticlockwise
    upright = RigidTransform(RotationMatrix(np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])))
    whole = plant.AddFrame(FixedOffsetFrame("plane", plant.world_frame(), upright))
    hit = {contact["bodies"][1] for contact in model["contacts"]}
    joints = []
    for body in model["bodies"]:
        name, b, h = body["name"], body["half_width"], body["half_height"]
        unit = body["inertia"] / body["mass"]
        inertia = SpatialInertia(body["mass"], [0.0, 0.0, 0.0], UnitInertia(unit, unit, unit))
        link = plant.AddRigidBody(name, inertia)
        frame = plant.AddFrame(FixedOffsetFrame(f"{name}_plane", link.body_frame(), upright))
        joints.append(plant.AddJoint(PlanarJoint(name, whole, frame, [0.0, 0.0, 0.0])))
        if name in hit:
            faces = Box(2 * (b - RADIUS), 1.0, 2 * (h - RADIUS))
            plant.RegisterCollisionGeometry(link, RigidTransform(), faces, f"{name}_box", material)
        for i, (x, z) in enumerate([(-b, -h), (b, -h), (-b, h), (b, h)]):
            if name not in hit or z < 0:
                at = RigidTransform([x, 0.0, z])
                plant.RegisterCollisionGeometry(link, at, Sphere(RADIUS), f"{name}_{i}", material)
    return joints


def _followed(plant, simulator, context, joints, case: Mapping, step: float) -> Trace:
    model = case["model"]
    a, n = ground(model), round(case["duration"] / step)
    shaking = model["ground_motion"] is not None
    forces = plant.get_applied_generalized_force_input_port()
    masses = np.zeros(plant.num_velocities())
    for joint, body in zip(joints, model["bodies"], strict=True):
        masses[joint.velocity_start()] = body["mass"]
    rows = np.zeros((n + 1, len(joints), 6))
    for i in range(n + 1):
        for k, joint in enumerate(joints):
            place, speed = joint.get_translation(context), joint.get_translational_velocity(context)
            turn, spin = joint.get_rotation(context), joint.get_angular_velocity(context)
            rows[i, k] = *place, -turn, *speed, -spin
        if shaking:
            forces.FixValue(context, -masses * a(i * step))
        if i < n:
            simulator.AdvanceTo((i + 1) * step)
    names = [body["name"] for body in model["bodies"]]
    return Trace(np.arange(n + 1) * step, {name: rows[:, k] for k, name in enumerate(names)})
