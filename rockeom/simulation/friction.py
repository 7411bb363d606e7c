"""What friction a motion without sliding needed, of forces and of impulses."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from rockeom.codes import IMPACT, LANDING
from rockeom.integrator.schema import has_points
from rockeom.simulation.extremes import Extremes, extremes
from rockeom.structures.contact_modes import Points

if TYPE_CHECKING:
    from rockeom.simulation.response import Response, Steps


def meets_ground(module: ModuleType) -> bool:
    """Whether feet meet rigid ground in impacts."""
    return has_points(module) or {"impact", "uplift"} <= {kind for *_, kind in module.TRANSITIONS}


def surfaces(module: ModuleType) -> dict[str, tuple[int, ...]]:
    """The points that rub on the same, by their names joined by "+": numbers of points.

    Points are of one surface where a contact state lets them share their friction.
    """
    if not has_points(module):
        return {}
    first = list(range(len(module.POINTS)))
    for shared in module.SHARED:
        for i, j in enumerate(shared):
            first = [first[j] if f == first[i] else f for f in first]
    found = [tuple(i for i, f in enumerate(first) if f == one) for one in dict.fromkeys(first)]
    return {"+".join(module.POINTS[i] for i in points): points for points in found}


def least_coefficient(
    steps: Steps,
    forces: Callable[..., np.ndarray],
    across: Extremes,
    pressing: Extremes,
    until: float,
    may_fly: bool,
) -> float:
    """Largest |across|/pressing of two forces, found within the steps.

    forces : gives both (n, 2) at times, states and contact states (n,); across, pressing : their
    extremes. until : when they cease to matter [s]. inf where nothing presses, but for a force
    across; 0 for one that flies all the time.
    """
    none = 1e-9 * abs(pressing.peak)  # what is no force, but rounding
    if (may_fly and pressing.peak == 0.0) or abs(across.peak) <= none:
        return 0.0

    def pressing_over_across(t, y, contact) -> np.ndarray:
        along, normal = forces(t, y, contact).T
        ratio = normal / np.maximum(np.abs(along), none)
        ratio[(np.abs(along) <= none) & (np.abs(normal) <= none)] = 1e9  # in flight
        return ratio[:, None]

    # this ratio passes zero smoothly where the other one is infinite
    (ratio,) = extremes(steps, pressing_over_across, until)
    if not math.isfinite(ratio.minimum):
        return math.nan
    return 1.0 / ratio.minimum if ratio.minimum > 1e-9 else math.inf


def _of_impulse(across: float, up: float) -> float:
    return abs(across) / up if up > 0.0 else math.inf


def of_impulses(run: Response) -> float:
    """Largest |horizontal|/vertical impulse of the ground, which all masses gain."""
    momentum, p = run.program.momentum, run.structure.vector
    _, kinds, states = run.passages
    largest = 0.0
    before, after = np.zeros(2), np.zeros(2)
    for (kind, old, new, _), (arriving, leaving) in zip(kinds, states, strict=True):
        if kind not in (IMPACT, LANDING):
            continue
        momentum(old, arriving, p, before)
        momentum(new, leaving, p, after)
        across, up = (after - before).tolist()
        # in the smallest impacts of a vibrating structure the difference is rounding
        if math.hypot(across, up) > 1e-9 * math.hypot(*before, *after):
            largest = max(largest, _of_impulse(across, up))
    return largest


def of_point_impulses(run: Response, groups: Sequence[tuple[int, ...]]) -> list[float]:
    """Largest |tangential|/normal impulse at the landings, on the points of each group together.

    Out of M (v+ - v-) = J_N' P_N + J_T' P_T at the points that touch.
    """
    module, p = run.structure.module, run.structure.vector
    n = module.N_STATES // 2
    _, kinds, states = run.passages
    landed = kinds[:, 0] == LANDING
    landings = states[landed]
    largest = [0.0] * len(groups)
    if not len(landings):
        return largest
    points = Points(module, landings[:, 0], p)
    # beside where the motion goes: at a landing all coordinates may be none, but for rounding
    closed = points.closed_beside(np.fmax.reduce(np.abs(run.y[:, :n])))
    matrix, forces = np.empty(n * n), np.empty(n)
    for (arriving, leaving), near, normal, along, contact in zip(
        landings, closed, points.normal, points.tangential, kinds[landed, 1], strict=True
    ):
        module.free_motion(arriving, p, 0.0, 0.0, contact, matrix, forces)
        gained = matrix.reshape(n, n) @ (leaving[n:] - arriving[n:])
        rows = np.vstack([normal[near], along[near]])
        (at,) = np.nonzero(near)
        pressed, rubbed = np.zeros(len(near)), np.zeros(len(near))
        found = np.linalg.lstsq(rows.T, gained, rcond=1e-12)[0]
        pressed[at], rubbed[at] = found[: len(at)], found[len(at) :]
        whole = np.abs(found).sum()
        for i, group in enumerate(map(list, groups)):
            across, up = float(rubbed[group].sum()), float(pressed[group].sum())
            if math.hypot(across, up) > 1e-9 * whole:
                largest[i] = max(largest[i], _of_impulse(across, up))
    return largest
