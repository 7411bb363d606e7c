"""Bodies on feet, as the cases of `cases.json` have them: structures, orientations and rates."""

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.symbolic import Model, Rigid, coordinate, parameter, space
from tests.space.cases import GRAVITY, TIGHT, Case

PLACE = [coordinate(x, x, "m", f"place along {x}") for x in "xyz"]
ANGLES = [
    coordinate(symbol, name, "rad", name)
    for symbol, name in (("psi", "yaw"), ("theta", "pitch"), ("phi", "roll"))
]
MASS, B, C, H, G = (
    parameter(symbol, name, unit, words)
    for symbol, name, unit, words in (
        ("m", "mass", "kg", "mass"),
        ("b", "half_width", "m", "half of the edge along x"),
        ("c", "half_depth", "m", "half of the edge along y"),
        ("h", "half_height", "m", "half of the height"),
        ("g", "gravity", "m/s2", "gravity"),
    )
)
FRAME = space.frame(*(c.position for c in ANGLES), origin=tuple(c.position for c in PLACE))
CORNERS = {
    f"{'east' if x > 0 else 'west'}_{'north' if y > 0 else 'south'}": (x, y)
    for x in (-1, 1)
    for y in (-1, 1)
}
NAMES = {f"({x:+d},{y:+d})": name for name, (x, y) in CORNERS.items()}
"""Names of corners by those of the cases."""
TRIPOD = {"one": (1, 1), "two": (-1, 1), "three": (0, -1)}


@cache
def model(
    name: str, corners: tuple[tuple[str, tuple[int, int]], ...], restitution=0, friction=0
) -> Model:
    """A prism on points, whose places are given in half edges."""
    b, c, h = (p.symbol for p in (B, C, H))
    feet = {foot: (x * b, y * c, -h) for foot, (x, y) in corners}
    return Model(
        name=name, title="Prism on feet", parameters=(MASS, B, C, H, G),
        coordinates=(*PLACE, *ANGLES), gravity=G.symbol, rotation=ANGLES[1],
        bodies=[space.box("prism", MASS.symbol, (2 * b, 2 * c, 2 * h), FRAME)],
        contacts=space.feet(FRAME, feet, Rigid(restitution=restitution, friction=friction)),
        falls=space.tilt(FRAME, sp.Rational(14, 10)),
    )  # fmt: skip


def prism(
    given: Mapping[str, float], corners: Mapping[str, tuple[int, int]] = CORNERS, restitution=0,
    friction=0,
):  # fmt: skip
    """The structure of a case, on smooth feet, or with friction=None on those that never slip."""
    declared = model(f"prism_on_{len(corners)}", tuple(corners.items()), restitution, friction)
    names = {"mass": "m", "half_width": "b", "half_depth": "c", "half_height": "h"}
    values = {name: float(given[letter]) for name, letter in names.items()}
    return rk.structure(declared, **values, gravity=GRAVITY)


def oriented(rotation: Sequence[Sequence[float]], spin=(0, 0, 0)) -> dict[str, float]:
    """Yaw, pitch and roll of R = Rz Ry Rx, and their rates by the angular velocity (ground)."""
    r = np.array(rotation, float)
    yaw, pitch = np.arctan2(r[1, 0], r[0, 0]), np.arctan2(-r[2, 0], np.hypot(r[2, 1], r[2, 2]))
    roll = np.arctan2(r[2, 1], r[2, 2])
    rates = np.linalg.solve(_axes(yaw, pitch), np.array(spin, float))
    names = ("yaw", "pitch", "roll")
    angles = dict(zip(names, map(float, (yaw, pitch, roll)), strict=True))
    return angles | {f"{n}_dot": float(x) for n, x in zip(names, rates, strict=True)}


def _axes(yaw, pitch) -> np.ndarray:
    """The axes about which yaw, pitch and roll turn, as columns (..., 3, 3)."""
    none = np.zeros_like(yaw)
    about_y = [-np.sin(yaw), np.cos(yaw), none]
    about_x = [np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), -np.sin(pitch)]
    return np.stack(
        [np.stack(axis, -1) for axis in ([none, none, none + 1.0], about_y, about_x)], -1
    )


def rotation(state: Mapping[str, Any]) -> np.ndarray:
    """R = Rz(yaw) Ry(pitch) Rx(roll), (..., 3, 3) of a state, or of many."""
    angles = [np.asarray(state[name]) for name in ("yaw", "pitch", "roll")]
    product = np.eye(3)
    for angle, (i, j) in zip(angles, ((0, 1), (2, 0), (1, 2)), strict=True):
        turn = np.zeros((*angle.shape, 3, 3)) + np.eye(3)
        turn[..., i, i] = turn[..., j, j] = np.cos(angle)
        turn[..., j, i] = np.sin(angle)
        turn[..., i, j] = -turn[..., j, i]
        product = product @ turn
    return product


def spin(state: Mapping[str, Any]) -> np.ndarray:
    """The angular velocity along the axes of the ground (..., 3), of a state, or of many."""
    rates = np.stack([state[f"{name}_dot"] for name in ("yaw", "pitch", "roll")], -1)
    return (_axes(state["yaw"], state["pitch"]) @ rates[..., None])[..., 0]


def spin_rate(state: Mapping[str, Any], accelerations: Mapping[str, Any]) -> np.ndarray:
    """The angular acceleration along the axes of the ground, of a state, or of many."""
    yaw, pitch = state["yaw"], state["pitch"]
    rates = [state[f"{name}_dot"] for name in ("yaw", "pitch", "roll")]
    s, c, s_p, c_p = np.sin(yaw), np.cos(yaw), np.sin(pitch), np.cos(pitch)
    none = np.zeros_like(yaw)
    about_y = rates[0] * np.array([-c, -s, none])
    about_x = rates[0] * c_p * np.array([-s, c, none]) - rates[1] * np.array(
        [c * s_p, s * s_p, c_p]
    )
    turning = about_y * rates[1] + about_x * rates[2]
    found = np.stack([accelerations[n] for n in ("yaw", "pitch", "roll")], -1)
    return np.moveaxis(turning, 0, -1) + (_axes(yaw, pitch) @ found[..., None])[..., 0]


def on_feet(feet: Mapping[str, Sequence[float]], elements=(), restitution=0, **more):
    """A body of 2 kg whose tensor is the same about all axes, on smooth feet in its frame."""
    body = space.body("body", MASS.symbol, MASS.symbol * sp.eye(3) / 2, FRAME)
    places = {name: tuple(map(sp.Float, place)) for name, place in feet.items()}
    declared = Model(
        name="body_on_feet", title="Body on smooth feet", parameters=(MASS, G),
        coordinates=(*PLACE, *ANGLES), gravity=G.symbol, rotation=ANGLES[1], bodies=[body],
        contacts=space.feet(FRAME, places, Rigid(restitution=restitution, friction=0)),
        elements=elements, falls=space.tilt(FRAME, sp.Rational(14, 10)), **more,
    )  # fmt: skip
    return rk.structure(declared, mass=2.0, gravity=GRAVITY)


def energy_ratio(block, impact) -> float:
    """Kinetic energy after an impact over that before."""
    after, before = (block.energies(s)["kinetic_energy"] for s in (impact.after, impact.before))
    return after / before


def impact_agrees(case: Case, block) -> None:
    """Check the impact with which a motion begins against the velocities and the loss of a case."""
    rates = zip("xyz", map(float, case.given["v_centroid"]), strict=True)
    state = oriented(case.given["R"], case.given["omega"])
    state |= {f"{axis}_dot": rate for axis, rate in rates}
    run = rk.simulate(block, rk.GroundMotion.none(1e-3), initial=state, options=TIGHT)
    impact = run.impacts[0]
    assert impact.time < 1e-9
    case.agrees(
        omega_after=spin(impact.after),
        v_centroid_after=np.array([impact.after[f"{axis}_dot"] for axis in "xyz"]),
        energy_ratio=energy_ratio(block, impact),
    )
