"""Planar answer and that in space: the block of the weakest edge, and whether it was safe."""

import math
from typing import Any, NamedTuple

import numpy as np

from rockeom.analysis.risk.fragility import Estimate
from rockeom.analysis.sweeps import ANSWERS, FALLS, outcome_labels
from rockeom.assessment.azimuths import in_degrees
from rockeom.assessment.remedies import paired_gain
from rockeom.assessment.statics import weakest_edge
from rockeom.assessment.trials import Conditions, Trials, case_of, own_friction, simulated
from rockeom.assessment.words import percent
from rockeom.motion.recording import Recording
from rockeom.simulation.case import Case
from rockeom.structures.base import Structure
from rockeom.structures.positions import bodies, feet_at_rest, has_barrier
from rockeom.structures.shipped.offset_block import OffsetBlock
from rockeom.structures.shipped.rigid_block import RigidBlock
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many

_ALIKE = 1e-9
"""Relative difference of the distances of two edges that is rounding."""


class InPlane(NamedTuple):
    """Planar answer for a body in space, under the stronger component of each recording.

    Parameters
    ----------
    block : Structure
        Planar block of the weakest edge.
    azimuth : float
        Azimuth of its plane, from x of the body [rad].
    fell : ndarray
        Whether it overturned (n, ways, m) under each of n recordings at each of m PGA, by the way
        in which the component acts: one of a symmetric block, else both.
    answered : ndarray
        Whether these motions have an answer (n, ways, m).
    share : float
        Share of these motions that overturn, a recording as one; NaN without an answer.
    share_in_space : float
        Share of the motions in space that do.
    more : Estimate
        Share in space less that in the plane, with its interval; None for less than two recordings.
    missed : int
        Number of falls in space under what leaves the block standing.
    """

    block: Structure
    azimuth: float
    fell: np.ndarray
    answered: np.ndarray
    share: float
    share_in_space: float
    more: Estimate | None
    missed: int

    def at(self, i: int) -> str:
        """Its falls at the PGA number i, in words."""
        fell, answered = self.fell[:, :, i], self.answered[:, :, i]
        return f"{int((fell & answered).sum())} of {int(answered.sum())}"


def planar_block(structure: Structure) -> tuple[Structure, float]:
    """The block that leans over the weakest edge of a body in space, and the azimuth to which.

    It has the body's mass and moment of inertia about that edge's direction. To its right is the
    weakest edge, to its left the farthest foot that bears at rest.
    """
    edge, values = weakest_edge(structure), structure.parameters()
    x, y = -math.sin(edge.azimuth), math.cos(edge.azimuth)  # along the edge
    xx, xy = values["inertia_xx"], values.get("inertia_xy", 0.0)
    yy = values.get("inertia_yy", xx)  # a round column has one
    inertia = xx * x**2 + yy * y**2 + 2.0 * xy * x * y
    sizes = {
        "half_width": (edge.arm + edge.behind) / 2,
        "half_height": edge.height,
        "mass": values["mass"],
        "inertia": inertia,
        "gravity": values["gravity"],
    }
    if math.isclose(edge.arm, edge.behind, rel_tol=_ALIKE):
        return RigidBlock(**sizes), edge.azimuth
    return OffsetBlock(**sizes, offset=(edge.behind - edge.arm) / 2), edge.azimuth


def in_plane(
    structure: Structure, conditions: Conditions, trials: Trials, level: float
) -> InPlane | None:
    """The planar answer; None for a structure in the plane, for a slab on columns, for feet of
    different heights, and for a declared body whose mass and inertia have other names.

    trials : of the body in space; level : of the interval.
    """
    turns, names = len(conditions.azimuths), structure.parameters().keys()
    single = turns and len({*bodies(structure.module)} - {"contact"}) == 1
    if not single or not {"mass", "inertia_xx", "gravity"} <= names:
        return None
    if has_barrier(structure) and not feet_at_rest(structure).bear.all():
        return None
    block, azimuth = planar_block(structure)
    flat = conditions._replace(azimuths=(), friction=own_friction(structure))
    tried = simulated(block, flat)

    def case(motion: Recording, way: float, pga: float) -> Case:
        return case_of(tried, stronger(motion.scaled_to(pga), way), flat)

    ways = (1.0,) if isinstance(block, RigidBlock) else (1.0, -1.0)
    over: dict[str, Any] = {"motion": conditions.motions[::turns], "way": ways}
    over["pga"] = conditions.levels
    labels = outcome_labels(simulate_many(case, over, sweep_options=SweepOptions(progress=False)))
    fell, answered = labels.values == FALLS, np.isin(labels.values, [*ANSWERS])
    return InPlane(block, azimuth, fell, answered, *_compared(trials, fell, answered, turns, level))


def stronger(motion: Recording, way: float) -> Recording:
    """The horizontal component with the larger peak, with the vertical one; way : its sign."""
    one = max(motion.horizontal, key=lambda component: component.peak)
    return Recording(one.name, (way * one,), motion.vertical)


def _compared(
    trials: Trials, fell: np.ndarray, answered: np.ndarray, turns: int, level: float
) -> tuple[float, float, Estimate | None, int]:
    """Both shares, their difference, and falls in space alone; turns : number of azimuths.

    They are of what has an answer in space and in the plane.
    """
    n = len(fell)
    of_ways = (fell & answered).sum(axis=1) / np.maximum(answered.sum(axis=1), 1)
    part, known = (np.repeat(x, turns, axis=0) for x in (of_ways, answered.any(axis=1)))
    beside = trials._replace(fell=part, answered=known)
    both = (trials.answered & known).reshape(n, -1)
    number, has = both.sum(axis=1), both.any(axis=1)
    shares = [
        float(((x.reshape(n, -1) * both).sum(axis=1)[has] / number[has]).mean())
        if has.any()
        else math.nan
        for x in (part, trials.fell)
    ]
    missed = int((trials.fell & trials.answered & known & (part == 0.0)).sum())
    more = paired_gain(trials, beside, np.repeat(np.arange(n), turns), level)
    return shares[0], shares[1], more, missed


def in_words(answer: InPlane | None, trials: Trials, level: float) -> str:
    """Both shares, and whether the planar one was safe; "" without a planar answer."""
    if answer is None or math.isnan(answer.share):
        return ""
    where = f"towards {in_degrees(answer.azimuth)} from its x axis, under the stronger component"
    where += " of each recording"
    said = f"Plane: the planar block of its weakest edge, {where}, overturns in"
    falls = int((trials.fell & trials.answered).sum())
    if not (falls or answer.fell.any()):
        return f"{said} none of the scaled motions, as the body does in space."
    said += f" {percent(answer.share)} of the scaled motions, the body in space in"
    said += f" {percent(answer.share_in_space)}"
    if answer.missed:
        said += f"; {answer.missed} of its {falls} falls are under recordings that leave the block"
        said += " standing"
    return f"{said}. {_judged(answer.more, level)}"


def _judged(more: Estimate | None, level: float) -> str:
    """Whether the planar answer was safe, by the share in space less that in the plane."""
    if more is None:
        return "Whether the planar answer was safe does not follow from one recording."
    value, low, high = (f"{percent(abs(x))} {'fewer' if x < 0.0 else 'more'}" for x in more)
    between = f"{percent(level)} interval {low} to {high}"
    if more.lower <= 0.0 <= more.upper:
        return f"No measurable difference says whether the planar answer was safe ({between})."
    verdict = "not safe" if more.lower > 0.0 else "safe"
    return f"The planar answer was {verdict}: in space {value} of them overturn ({between})."
