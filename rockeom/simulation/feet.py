"""The friction that single feet in space need, however those on one edge share it."""

import numpy as np

from rockeom.simulation.extremes import extremes
from rockeom.simulation.quantities import Quantities

_NONE = 1e-9
"""Relative to the largest pressing force: a smaller force is rounding."""
_OF_FOOT = ("friction_x", "friction_y", "reaction", "slip_x", "slip_y")
_FLIES = 1e9
"""The ratio of pressing to holding of feet that need to hold nothing."""


def least_friction(quantities: Quantities, feet: list[str], until: float) -> float:
    """Least coefficient with which none of the feet that never slip would have, up to a time [s].

    It is |T|/N for a foot that holds alone. Two on an edge may share the force along it in any way
    that fits the friction of both. For more it is that of all together. inf where a foot presses
    on nothing and yet has to hold.
    """
    columns = quantities.columns([f"{foot}_{of}" for of in _OF_FOOT for foot in feet])
    steps = quantities.steps("what single feet had to hold")
    none = _NONE * abs(quantities.extremes_of(["vertical_reaction"])["vertical_reaction"].peak)

    at_rest = quantities.structure.positions({})  # from which slips count
    middle = np.array([at_rest[foot][:2] for foot in feet])

    def pressing_over_holding(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
        x, across, up, *at = columns(t, y, mode).reshape(len(t), 5, -1).transpose(1, 0, 2)
        forces, places = np.stack([x, across], axis=-1), np.stack(at, axis=-1) + middle
        holds = np.hypot(x, across) > none
        ratio = _over(np.where(holds, up, 0.0).sum(axis=1), forces.sum(axis=1), none)
        rows = np.flatnonzero(holds.sum(axis=1) == 2)
        if len(rows):
            pair = np.argsort(~holds[rows], axis=1, kind="stable")[:, :2]
            both = rows[:, None], pair
            ratio[rows] = _of_edge(forces[both], up[both], places[both], none)
        return ratio[:, None]

    (ratio,) = extremes(steps, pressing_over_holding, until)
    return 1.0 / ratio.minimum if ratio.minimum > _NONE else np.inf


def _over(up: np.ndarray, force: np.ndarray, none: float) -> np.ndarray:
    """Pressing forces (n,) over the sizes of forces (n, 2) along the ground."""
    size = np.hypot(*force.T)
    return np.where(size > none, up / np.maximum(size, none), _FLIES)


def _of_edge(forces: np.ndarray, up: np.ndarray, places: np.ndarray, none: float) -> np.ndarray:
    """Pressing over holding (n,) of two feet, by the share of the force along their line.

    forces, places (n, 2, 2), up (n, 2) : of both. A part s may go from one to the other. The lesser
    ratio of both is largest where that of one is, or where they are equal: at the roots of a s**2 +
    2 b s + c.
    """
    line = places[:, 1] - places[:, 0]
    line /= np.linalg.norm(line, axis=1)[:, None]
    along = np.einsum("nij,nj->ni", forces, line)
    squares, (first, second) = (forces**2).sum(axis=2), (up**2).T
    a, b = second - first, second * along[:, 0] + first * along[:, 1]
    c = second * squares[:, 0] - first * squares[:, 1]
    with np.errstate(all="ignore"):
        root = -(b + np.copysign(np.sqrt(b * b - a * c), b))
        shares = np.nan_to_num([-along[:, 0], along[:, 1], root / a, c / root], posinf=0, neginf=0)
    of_both = (
        np.minimum(
            _over(up[:, 0], forces[:, 0] + s[:, None] * line, none),
            _over(up[:, 1], forces[:, 1] - s[:, None] * line, none),
        )
        for s in shares
    )
    return np.max(list(of_both), axis=0)
