"""A script for OpenSeesPy of a structure on two springs that press and never pull.

The frame is of corotational elements, so that rotations may be of any size; what is rigid here is
a very stiff element there. The base's centre is guided vertically, as in `TwoSpringStructure` and
in `FlexibleStructure` on `TwoSprings`.
"""

import textwrap
from collections.abc import Mapping
from string import Template

import numpy as np

from rockeom.motion import GroundMotion
from rockeom.numbers.checks import InputError, number, require
from rockeom.structures.base import Structure
from rockeom.structures.parameters import named_states
from rockeom.version import VERSION

_BODY = Template('''
# Nodes: 1 the middle of the base, 2 and 3 its feet, 4 and 5 the masses, 6 and 7 the ground
half_weight = (mass + base_mass) * gravity / 2
settled = -half_weight / foundation_stiffness
places = {1: (0.0, 0.0), 2: (-half_width, 0.0), 3: (half_width, 0.0), 4: (0.0, base_height),
          5: (0.0, height)}
sine, cosine = math.sin(theta), math.cos(theta)


def turned(x, y, theta):
    """A place when the base has turned clockwise."""
    return x * math.cos(theta) + y * math.sin(theta), y * math.cos(theta) - x * math.sin(theta)


ops.wipe()
ops.model("basic", "-ndm", 2, "-ndf", 3)
for node, place in places.items():
    ops.node(node, *place)
ops.node(6, -half_width, 0.0)
ops.node(7, half_width, 0.0)
ops.fix(1, 1, 0, 0)
ops.fix(6, 1, 1, 1)
ops.fix(7, 1, 1, 1)
ops.mass(4, base_mass, base_mass, base_inertia + $inertia)
ops.mass(5, mass, mass, $top_inertia)

# Elements: what is rigid is stiff enough to bend by less than 1e-9 m; what turns is corotational
stiff = 1e6 * foundation_stiffness
ops.geomTransf("Corotational", 1)
for element, (one, other) in enumerate([(1, 2), (1, 3), (1, 4)], 1):
    ops.element("elasticBeamColumn", element, one, other, 1.0, stiff, 1.0, 1)
$column
# Springs of the foundation, which press and never pull; a node's x is that of the ground
ops.uniaxialMaterial("ENT", 1, foundation_stiffness)
for element, (ground, foot) in {5: (6, 2), 6: (7, 3)}.items():
    ops.element("zeroLength", element, ground, foot, "-mat", 1, "-dir", 2)

# Weight, and the ground's acceleration as it is read: linear between its samples
ops.timeSeries("Constant", 1)
ops.pattern("Plain", 1, 1)
ops.load(4, 0.0, -base_mass * gravity, 0.0)
ops.load(5, 0.0, -mass * gravity, 0.0)
if accelerations:
    ops.timeSeries("Path", 2, "-dt", apart, "-values", *accelerations)
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)

# The start: displacements, and the accelerations with which the motion begins
for node, place in places.items():
    along = u if node == 5 else 0.0
    x, y = turned(place[0] + along, place[1], theta)
    rate = theta_ddot
    ddot = (y * rate, -x * rate + heave_ddot, -rate)
    if node == 5:
        ddot = (ddot[0] + cosine * u_ddot, ddot[1] - sine * u_ddot, -rate)
    bent = 1.5 * along / height
    start = (x - place[0], y - place[1] + settled + heave, -(theta + bent))
    for direction in (1, 2, 3):
        if (node, direction) != (1, 1):
            ops.setNodeDisp(node, direction, start[direction - 1], "-commit")
            ops.setNodeAccel(node, direction, ddot[direction - 1], "-commit")

ops.constraints("Plain")
ops.numberer("RCM")
ops.system("BandGeneral")
ops.test("NormDispIncr", 1e-12, 50)
ops.algorithm("Newton")
ops.integrator("Newmark", 0.5, 0.25)  # of constant acceleration: no numerical damping
ops.analysis("Transient")


def state():
    """(theta, heave, u) of now."""
    turn = -ops.nodeDisp(1, 3)
    middle = ops.nodeDisp(1, 2)
    x, y = ops.nodeDisp(5, 1), height + ops.nodeDisp(5, 2) - middle
    return turn, middle - settled, x * math.cos(turn) - y * math.sin(turn)


rows = [(0.0, *state())]
for i in range(1, round(duration / step) + 1):
    if ops.analyze(1, step) != 0:
        sys.exit(f"no equilibrium was found at {i * step} s: make the step smaller")
    if i % every == 0:
        rows.append((i * step, *state()))
with open(out, "w", encoding="utf-8") as file:
    file.write("t,theta,heave$of_u\\n")
    file.writelines(",".join(map(repr, row[:$columns])) + "\\n" for row in rows)
print(f"wrote {out}: {len(rows)} rows")
''')

_RIGID_COLUMN = """\
ops.element("elasticBeamColumn", 4, 4, 5, 1.0, stiff, 1.0, 1)
"""
_ELASTIC_COLUMN = """\
# A column whose end pushed sideways has the stiffness here; what the weight takes of it as the end
# moves on an arc, where rockeom's moves across the column, is put on top
bending = (stiffness + mass * gravity / height) * height**3 / 3
ops.element("elasticBeamColumn", 4, 1, 5, 1.0, stiff, bending / stiff, 1)
if damping:
    ops.region(1, "-ele", 4, "-rayleigh", 0.0, damping / stiffness, 0.0, 0.0)
"""


def script(
    structure: Structure,
    motion: GroundMotion,
    *,
    initial: Mapping[str, float] | None = None,
    duration: float | None = None,
    step: float = 1e-4,
    out: str = "",
) -> str:
    """Text of a stand-alone script for OpenSeesPy 3.7 that simulates a structure.

    Parameters
    ----------
    structure : Structure
        A `TwoSpringStructure`, or a `FlexibleStructure` on `TwoSprings`.
    motion : GroundMotion
        Horizontal ground motion; a record is written as it is, a pulse by samples `step` apart.
    initial : dict of str to float, optional
        Rotation, heave and, for a flexible one, u at the start [rad, m]; rates are zero.
    duration : float, optional
        Duration [s]; that of the motion if not given.
    step : float, optional
        Step of Newmark's method [s].
    out : str, optional
        File of comma-separated values that the script writes; the structure's name and
        ``_opensees.csv`` if not given.

    Returns
    -------
    str
        Text of the script.

    Raises
    ------
    ValueError
        For another structure, for feet with dampers, for states that it does not take and for
        numbers that are not positive.

    Notes
    -----
    The error of a rigid structure is of the second order in the step. The column of the flexible
    one is an elastic beam there, whose end moves on an arc, which rockeom's does not: upright the
    stiffness that this costs is added, and away from it the two differ by the order of u/height.
    Its damping is proportional to its stiffness.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom.exports.opensees import script
    >>> structure = rk.TwoSpringStructure(
    ...     mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.1,
    ...     base_inertia=1.37, half_width=0.285, foundation_stiffness=5e5, foundation_damping=0.0,
    ... )
    >>> text = script(structure, rk.GroundMotion.none(1.0), initial={"theta": 0.05})
    """
    values, elastic = _values(structure)
    if values.pop("foundation_damping") != 0.0:
        raise InputError("structure", of=type(structure).__name__).says(
            "OpenSees has no spring and damper that press together and never pull: give feet "
            "without dampers, foundation_damping=0"
        )
    state = _initial_state(structure, initial or {}, elastic)
    step = _positive("step", step)
    lasts = _positive("duration", motion.duration if duration is None else duration)
    samples, spacing = _samples(motion, lasts, step)
    first = float(motion.acceleration(0.0))
    started = structure.accelerations(state, ground_acceleration=first)
    numbers = {
        **values,
        **{"u": 0.0, "u_ddot": 0.0},
        **state,
        **{f"{name}_ddot": started[name] for name in state},
        "duration": lasts,
        "step": step,
        "apart": spacing,
    }
    body = _BODY.substitute(
        inertia="inertia" if elastic else "0.0",
        top_inertia="0.0" if elastic else "inertia",
        column=_ELASTIC_COLUMN if elastic else _RIGID_COLUMN,
        of_u=",u" if elastic else "",
        columns=4 if elastic else 3,
    )
    description = [
        f"{type(structure).__name__} of rockeom {VERSION}, for OpenSeesPy 3.7.",
        "",
        "pip install openseespy==3.7.1.2 (Python 3.11; 3.8 wants Python 3.12). Where the import",
        "lacks a library, put the folder openseespylinux/lib next to it on LD_LIBRARY_PATH.",
        "",
        "SI units: kg, m, s, N, rad; theta is clockwise, heave counts from the settled position,",
        "and u is that of the upper mass across the column.",
    ]
    lines = [
        '"""' + "\n".join(description) + '\n"""',
        "",
        "import math",
        "import sys",
        "",
        "import openseespy.opensees as ops",
        "",
        *(f"{name} = {value!r}" for name, value in numbers.items()),
        f"every = {max(1, round(lasts / step / 2000))}  # steps between rows",
        f"out = {(out or f'{structure.model}_opensees.csv')!a}",
        *_list("accelerations", samples),
    ]
    return "\n".join(lines) + "\n" + body


def _values(structure: Structure) -> tuple[dict[str, float], bool]:
    """Parameters by the names of the script, and whether its column is elastic."""
    values = structure.parameters()
    if structure.model == "two_spring_structure":
        return values, False
    support = getattr(structure, "support", None)
    if structure.model in ("flexible_structure", "lumped_mass_structure"):
        if support is None or type(support).__name__ != "TwoSprings":
            raise InputError("support", support).says(
                f"{type(structure).__name__} stands on rigid ground or a bed, and a finite-element "
                "model rocks on springs: give it the support two_springs with foundation_damping 0",
                "support=rk.TwoSprings(stiffness=..., damping=0)",
            )
        if support.guided != "centre":
            raise InputError("guided", support.guided, "TwoSprings").so(
                'OpenSees is given the base guided at its "centre" alone'
            )
        return values, structure.model == "flexible_structure"
    raise InputError("structure").says(
        f"{type(structure).__name__} is not written for OpenSees: give a TwoSpringStructure, or a "
        "FlexibleStructure or LumpedMassStructure on TwoSprings"
    )


def _initial_state(
    structure: Structure, initial: Mapping[str, float], elastic: bool
) -> dict[str, float]:
    """Rotation, heave and u at the start."""
    initial = named_states("initial", initial, structure.module)
    places = ("theta", "heave", *(("u",) if elastic else ()))
    for name in initial:
        if name not in places:
            raise InputError(name, of="initial").wrong(
                f"is not written for OpenSees, which starts at rest: give {', '.join(places)}"
            )
    return {name: float(initial.get(name, 0.0)) for name in places}


def _positive(name: str, value: float) -> float:
    size = number(name, value)
    require(np.isfinite(size) and size > 0.0, "", name, value, "it must be finite and positive")
    return size


def _samples(motion: GroundMotion, duration: float, step: float) -> tuple[list[float], float]:
    """(accelerations, spacing): those of a record, or at the steps; none where all is still."""
    samples, dt = getattr(motion, "samples", None), getattr(motion, "dt", None)
    if samples is not None and dt:
        return np.asarray(samples).tolist(), float(dt)
    if not motion.peak:
        return [], step
    t = np.arange(round(duration / step) + 1) * step
    return np.asarray(motion.acceleration(t)).tolist(), step


def _list(name: str, values: list[float]) -> list[str]:
    """A list of numbers, wrapped."""
    if not values:
        return [f"{name} = []"]
    words = textwrap.wrap(", ".join(map(repr, values)), 92, break_on_hyphens=False)
    return [f"{name} = [  # m/s2, every `apart` seconds", *(f"    {line}" for line in words), "]"]
