"""Places of the bodies and feet of a structure, and of the parts that a sketch shows.

A generated module tells both; here they get their names. Places are (x, y) in axes that move with
the ground, x to the right and y upwards, from the origin of the declaration; in space (x, y, z), z
upwards.
"""

from typing import Any, NamedTuple

import numpy as np

from rockeom.integrator.schema import ground_axes, in_space

BODIES = ("body", "massless")
"""Kinds of what turns: the places of all others are points."""
NO_FEET = ("load", "tendon", "damper", "push", "end", *BODIES)
"""Kinds of what is no contact and no spring under the structure."""


class Member(NamedTuple):
    """A member between two bodies, a body and the "ground", or the two ends of an element.

    kind : "column", "cantilever", "rod", "tendon", "spring", "damper" or "wall". start_at, end_at
    (2,) : where it ends, from the centre of the body in axes that turn with it; on the ground from
    the origin [m].
    """

    kind: str
    start: str
    end: str
    start_at: np.ndarray
    end_at: np.ndarray


class Copies(NamedTuple):
    """How a body that represents several is drawn.

    Parameters
    ----------
    number : int
        Number of bodies, side by side.
    apart : float
        Distance between them in the sketch [m].
    """

    number: int
    apart: float


class Shapes(NamedTuple):
    """Outlines and members of a structure, as it was declared, for sketches.

    Parameters
    ----------
    outlines : dict of str to ndarray
        Corners (k, 2) of each body that has a size, by name, from its centre in axes that turn with
        it [m].
    members : tuple of Member
        Lines that join bodies.
    copies : dict of str to Copies
        Copies of bodies that represent several.
    """

    outlines: dict[str, np.ndarray]
    members: tuple[Member, ...]
    copies: dict[str, Copies]


def size_of_place(module: Any) -> int:
    """Numbers of a place: x, y and the angle; in space x, y, z and the matrix of the rotation."""
    return 12 if in_space(module) else 3


def places(module: Any, modes: np.ndarray, states: np.ndarray, p: np.ndarray) -> np.ndarray:
    """(n, m, k) places and rotations of POSITIONS, in states (n, N) of modes (n,)."""
    size = size_of_place(module)
    out = np.empty((len(states), size * len(module.POSITIONS)))
    for mode, y, row in zip(modes.tolist(), states.tolist(), out, strict=True):
        module.positions(mode, y, p, row)
    return out.reshape(len(states), -1, size)


def positions_of(module: Any, poses: np.ndarray) -> dict[str, np.ndarray]:
    """Places (..., 2), in space (..., 3), by name, of the values (..., m, k) of `places`."""
    axes = len(ground_axes(module))
    return {name: poses[..., i, :axes] for i, name in enumerate(module.POSITIONS)}


def rotations_of(module: Any, poses: np.ndarray) -> dict[str, np.ndarray]:
    """Rotations of the bodies, by name, (...); in space their matrices (..., 3, 3)."""
    kinds = zip(module.POSITIONS, module.POSITION_KINDS, strict=True)
    bodies = {name: poses[..., i, :] for i, (name, kind) in enumerate(kinds) if kind in BODIES}
    if in_space(module):
        return {name: of[..., 3:].reshape(*of.shape[:-1], 3, 3) for name, of in bodies.items()}
    return {name: of[..., 2] for name, of in bodies.items()}


def legs(structure: Any, mode: int, y: np.ndarray) -> list[tuple[int, int]]:
    """Bodies without an outline or a member, each with the feet at which a drawing joins them.

    Places among the positions. A foot belongs to a body from which its distance stays where all
    coordinates move.
    """
    m, drawn, pairs = structure.module, structure.shapes, []
    joined = {name for member in drawn.members for name in (member.start, member.end)}
    moved = np.array([y, y + 0.01 * np.arange(1, len(y) + 1)])
    at = places(m, np.array([mode, mode]), moved, structure.vector)[..., : len(ground_axes(m))]
    for i, j in np.ndindex(len(m.POSITIONS), len(m.POSITIONS)):
        body, lengths = m.POSITIONS[i], np.hypot.reduce(at[:, i] - at[:, j], axis=1)
        alone = m.POSITION_KINDS[i] in BODIES and body not in {*joined, *drawn.outlines}
        foot = m.POSITION_KINDS[j] not in NO_FEET
        if alone and foot and abs(lengths[1] - lengths[0]) <= 1e-9 * lengths[0]:
            pairs.append((i, j))
    return pairs


def shapes(module: Any, p: np.ndarray) -> Shapes:
    """Outlines and members of a structure with parameters and constants p."""
    corners, ends = len(module.CORNERS), len(module.MEMBER_ENDS)
    out = np.empty(2 * (corners + ends + len(module.COPIES)))
    module.shapes(p, out)
    points = out.reshape(-1, 2)
    owners = np.array(module.CORNERS, dtype=str)
    at = points[corners : corners + ends]
    names = module.MEMBER_ENDS
    return Shapes(
        {name: points[:corners][owners == name] for name in dict.fromkeys(module.CORNERS)},
        tuple(
            Member(kind, names[2 * i], names[2 * i + 1], at[2 * i], at[2 * i + 1])
            for i, kind in enumerate(module.MEMBERS)
        ),
        {
            name: Copies(round(number), float(apart))
            for name, (number, apart) in zip(module.COPIES, points[corners + ends :], strict=True)
        },
    )
