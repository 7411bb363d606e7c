"""MuJoCo: boxes on joints that keep them in the plane, and its own contacts, which are soft.

A contact is a spring and a damper in units of acceleration, regularised: `solref` sets its time
constant, two steps here, the shortest that MuJoCo allows, so that it stiffens as the step shortens.
A restitution is a damping ratio below one, found from that of a spring that does not pull; a bounce
lasts six steps of 0.01 s and more of shorter ones. The friction cone is elliptic, the method
Euler's, semi-implicit, of the first order; on springs without contacts, Runge and Kutta's.
"""

import math
from collections.abc import Mapping

import numpy as np

from benchmarks.engines.trace import Trace, ground

NAME, PACKAGE = "MuJoCo", "mujoco"
INSTALL = "pip install mujoco"
SETTINGS = "boxes, elliptic cones, impratio 100, solimp 0.99, time constant of 2 steps"
NO_SLIP = 1.0


def damping_ratio(restitution: float) -> float:
    """Damping ratio of a spring that does not pull whose mass leaves at this part of its speed."""
    low, high = 0.0, 1.0
    while high - low > 1e-12:
        z = 0.5 * (low + high)
        root = math.sqrt(1.0 - z * z)
        left = math.exp(-z / root * math.atan2(2.0 * z * root, 2.0 * z * z - 1.0))
        low, high = (z, high) if left > restitution else (low, z)
    return 0.5 * (low + high)


def solref(contact: Mapping, step: float) -> str:
    if not contact["restitution"]:
        return f"{2.0 * step!r} 1"
    ratio = damping_ratio(contact["restitution"])
    natural = 2.0 * step * (0.01 / step) ** (1 / 3)  # 1/frequency: shorter, and by more steps
    return f"{natural / ratio!r} {ratio!r}"


def body_of(body: Mapping, inside: str = "") -> str:
    joints = "".join(
        f'<joint name="{body["name"]}_{name}" type="{kind}" axis="{axis}"/>'
        for name, kind, axis in (
            ("x", "slide", "1 0 0"), ("z", "slide", "0 0 1"), ("turn", "hinge", "0 1 0")
        )
    )  # fmt: skip
    size = f"{body['half_width']!r} 0.5 {body['half_height']!r}"
    return (
        f'<body name="{body["name"]}">{joints}{_inertial(body)}'
        f'<geom name="{body["name"]}" type="box" size="{size}" contype="0" conaffinity="0"/>'
        f"{inside}</body>"
    )


def _inertial(body: Mapping, place: str = "0 0 0") -> str:
    return (
        f'<inertial pos="{place}" mass="{body["mass"]!r}" '
        f'diaginertia="{body["inertia"]!r} {body["inertia"]!r} {body["inertia"]!r}"/>'
    )


def column(base: Mapping, mass: Mapping, stiffness: float) -> str:
    """A mass that slides across the axis of its base, on a spring."""
    away = mass["z"] - base["z"], mass["x"] - base["x"]
    return body_of(
        base,
        f'<body name="mass" pos="0 0 {math.hypot(*away)!r}">'
        f'<joint type="slide" axis="1 0 0" stiffness="{stiffness!r}"/>{_inertial(mass)}</body>',
    )


def model_of(model: Mapping, step: float) -> str:
    if model["springs"] and model["springs"][0]["tension"]:
        (base, mass), (spring,) = model["bodies"], model["springs"]
        bodies = column(base, mass, spring["stiffness"])
    else:
        bodies = "".join(map(body_of, model["bodies"]))
    pairs = ""
    for contact in model["contacts"]:
        slip = NO_SLIP if contact["friction"] is None else contact["friction"]
        first, second = contact["bodies"]
        pairs += (
            f'<pair geom1="{first}" geom2="{second}" condim="{3 if slip else 1}" '
            f'friction="{slip!r} {slip!r} 0 0 0" solref="{solref(contact, step)}" '
            'solimp="0.99 0.99 0.001 0.5 2"/>'
        )
    return (
        f'<mujoco><option timestep="{step!r}" integrator="Euler" cone="elliptic" impratio="100" '
        'tolerance="1e-12" iterations="200"/>'
        '<worldbody><geom name="ground" type="plane" size="50 50 1" contype="0" conaffinity="0"/>'
        f"{bodies}</worldbody><contact>{pairs}</contact></mujoco>"
    )


def run(case: Mapping, step: float) -> Trace:
    import mujoco

    model = case["model"]
    if model["guides"] and not model["contacts"]:
        return guided(case, step)
    free = model["bodies"][: 1 if model["springs"] else None]
    compiled = mujoco.MjModel.from_xml_string(model_of(model, step))
    data, a = mujoco.MjData(compiled), ground(model)
    places = [
        [compiled.joint(f"{body['name']}_{name}").qposadr[0] for name in ("x", "z", "turn")]
        for body in free
    ]
    for body, at in zip(free, places, strict=True):
        data.qpos[at] = body["x"], body["z"], body["rotation"]
        data.qvel[at] = body["velocity"]
    n = round(case["duration"] / step)
    t, rows = np.arange(n + 1) * step, np.zeros((n + 1, len(free), 6))
    for i in range(n + 1):
        for k, at in enumerate(places):
            rows[i, k] = *data.qpos[at], *data.qvel[at]
        compiled.opt.gravity[:] = -a(i * step), 0.0, -model["gravity"]
        mujoco.mj_step(compiled, data)
    return Trace(t, {body["name"]: rows[:, k] for k, body in enumerate(free)})


def guided(case: Mapping, step: float) -> Trace:
    """A body on springs that do not pull: a slide and a hinge at the middle of its base.

    The springs are forces that MuJoCo asks for at each stage of a step of Runge and Kutta.
    """
    import mujoco

    model = case["model"]
    (body,), low = model["bodies"], model["bodies"][0]["half_height"]
    compiled = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{step!r}" integrator="RK4" '
        f'gravity="0 0 {-model["gravity"]!r}"/>'
        '<worldbody><body><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>'
        f"{_inertial(body, f'0 0 {low!r}')}</body></worldbody></mujoco>"
    )
    data = mujoco.MjData(compiled)
    data.qpos[:] = body["z"] - low * math.cos(body["rotation"]), body["rotation"]

    def press(_model, now) -> None:
        rise, turn = now.qpos
        for spring in model["springs"]:
            arm = spring["point"][0]
            force = spring["stiffness"] * max(arm * math.sin(turn) - rise, 0.0)
            now.qfrc_passive[0] += force
            now.qfrc_passive[1] -= force * arm * math.cos(turn)

    n = round(case["duration"] / step)
    rows = np.zeros((n + 1, 4))
    mujoco.set_mjcb_passive(press)
    try:
        for i in range(n + 1):
            rows[i] = *data.qpos, *data.qvel
            mujoco.mj_step(compiled, data)
    finally:
        mujoco.set_mjcb_passive(None)
    rise, turn, rise_rate, rate = rows.T
    sine, cosine = low * np.sin(turn), low * np.cos(turn)
    centroid = [sine, rise + cosine, turn, cosine * rate, rise_rate - sine * rate, rate]
    return Trace(np.arange(n + 1) * step, {body["name"]: np.column_stack(centroid)})
