"""Motions of a structure under records, as they were recorded and scaled to intensities."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockeom.analysis.risk.fragility import Fragility, fit_fragility, proportion_interval
from rockeom.analysis.sweeps import FALLS, STANDS, outcome_labels
from rockeom.motion.recording import Recording
from rockeom.simulation.case import Case
from rockeom.simulation.reserve import rotation_ratio
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.shipped.rigid_block import RigidBlock
from rockeom.structures.shipped.sliding_block import SlidingBlock
from rockeom.sweeps.dataset import Sweep
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many

QUIET = 10.0
"""Time that is followed after a record [s]: who overturns may do so after the shaking."""
_LIFTED = 1e-9  # rad; less is rounding


class Conditions(NamedTuple):
    """The conditions under which structures are compared.

    motions (n) : one horizontal component each, with the vertical one if it was given.
    stations (n) : a number for each, the same for both components of a recording.
    levels (m,) : PGA that each is scaled to [m/s2].
    friction : below the feet [-]; None where it is not known.
    impact : law of impact; None for the default.
    """

    motions: tuple[Recording, ...]
    stations: tuple[int, ...]
    levels: np.ndarray
    friction: float | None
    impact: ImpactLaw | None


class UnderRecord(NamedTuple):
    """A record as it was recorded, and its effect.

    peak : PGA [m/s2]. rotation : largest [rad]. part : of the overturning angle, nan where it is
    not known. slip : distance from the place before, in the end [m]; nan where it overturned or
    feet do not slide.
    """

    name: str
    peak: float
    outcome: str
    rotation: float
    part: float
    slip: float

    @property
    def lifts(self) -> bool:
        return self.rotation > _LIFTED


class AtIntensity(NamedTuple):
    """Number of records, scaled to a PGA [m/s2], that lift a foot and that overturn.

    number : of records with an answer. lower, upper : interval of confidence of the probability of
    overturning, Clopper and Pearson's. slip : largest distance from the place before, in the end,
    of those that stand [m]; nan where there are none or feet do not slide.
    """

    pga: float
    lifted: int
    overturned: int
    number: int
    lower: float
    upper: float
    slip: float


class Trials(NamedTuple):
    """Outcomes at each intensity, and the fragility curve or the reason why there is none."""

    intensities: tuple[AtIntensity, ...]
    fragility: Fragility | None
    no_curve: str
    unanswered: int


def can_slide(structure: Structure, conditions: Conditions) -> bool:
    """Whether sliding is simulated: that of a rigid block with the default law of impact."""
    known = conditions.friction is not None and conditions.impact is None
    return known and type(structure) is RigidBlock


def simulated(structure: Structure, conditions: Conditions) -> Structure:
    """The structure itself, or the same block on feet that slide and do not bounce."""
    if conditions.friction is None or not can_slide(structure, conditions):
        return structure
    assert isinstance(structure, RigidBlock)
    return SlidingBlock(
        half_width=structure.half_width,
        half_height=structure.half_height,
        mass=structure.mass,
        inertia=structure.parameters()["inertia"],
        gravity=structure.gravity,
        friction=conditions.friction,
        restitution=0.0,
    )


def as_recorded(structure: Structure, conditions: Conditions) -> tuple[UnderRecord, ...]:
    """The effect of each record as it was recorded."""
    motions = conditions.motions
    if not motions:
        return ()
    sweep = _sweep(structure, conditions, None)
    theta = structure.module.STATES[structure.module.ROTATION]
    left, right = (sweep[name].sel(state=theta).values for name in ("minimum", "maximum"))
    parts = _parts(structure, left, right)
    labels = outcome_labels(sweep).values
    slips = np.where(labels == FALLS, np.nan, _slips(structure, conditions, sweep))
    largest = np.maximum(right, -left) + 0.0
    columns = (column.tolist() for column in (labels, largest, parts, slips))
    rows = zip(motions, *columns, strict=True)
    return tuple(
        UnderRecord(
            motion.name or "a ground motion",
            motion.horizontal[0].peak,
            outcome,
            rotation,
            part,
            slip,
        )
        for motion, outcome, rotation, part, slip in rows
    )


def scaled(structure: Structure, conditions: Conditions, level: float) -> Trials:
    """Outcomes under each record scaled to each intensity; level : of the intervals."""
    if not conditions.motions:
        return Trials((), None, "there is no horizontal record", 0)
    sweep = _sweep(structure, conditions, conditions.levels)
    theta = structure.module.STATES[structure.module.ROTATION]
    labels = outcome_labels(sweep).values
    fell, lifted = labels == FALLS, sweep["peak"].sel(state=theta).values > _LIFTED
    known = fell | np.isin(labels, STANDS)
    counts = known.sum(axis=0), fell.sum(axis=0), (lifted & known).sum(axis=0)
    slips = np.where(fell, np.nan, _slips(structure, conditions, sweep))
    farthest = [max(column[~np.isnan(column)], default=np.nan) for column in slips.T]
    rows = []
    columns = (np.asarray(column).tolist() for column in (conditions.levels, *counts, farthest))
    for pga, n, hits, up, slip in zip(*columns, strict=True):
        lower, upper = proportion_interval(hits, n, level) if n else (0.0, 1.0)
        rows.append(AtIntensity(pga, up, hits, n, float(lower), float(upper), slip))
    curve, reason = _fitted(conditions, fell, known)
    return Trials(tuple(rows), curve, reason, int((~known).sum()))


def case_of(structure: Structure, motion: Recording, impact: ImpactLaw | None) -> Case:
    """The structure under a motion and quiet time after it."""
    horizontal, vertical = motion.horizontal[0], motion.vertical
    longest = max(one.duration for one in (horizontal, vertical) if one is not None)
    return Case(structure, horizontal, impact, duration=longest + QUIET, vertical=vertical)


def _sweep(structure: Structure, conditions: Conditions, levels: np.ndarray | None) -> Sweep:
    """(n,) motions as they were recorded, or (n, m) scaled to levels."""
    tried = simulated(structure, conditions)

    def case(motion: Recording, pga: float | None = None) -> Case:
        return case_of(tried, motion if pga is None else motion.scaled_to(pga), conditions.impact)

    over = {"motion": conditions.motions} | ({} if levels is None else {"pga": levels})
    return simulate_many(case, over, sweep_options=SweepOptions(progress=False))


def _slips(structure: Structure, conditions: Conditions, sweep: Sweep) -> np.ndarray:
    """Distances from the place before, in the end [m]; nan where feet do not slide."""
    if not can_slide(structure, conditions):
        return np.full(sweep["outcome"].shape, np.nan)
    return np.abs(sweep["final"].sel(state="x").values)


def _parts(structure: Structure, smallest: np.ndarray, largest: np.ndarray) -> np.ndarray:
    """Largest rotations over the overturning angle of their side; nan where there is none."""
    if structure.overturning_angles is None:
        return np.full(len(largest), np.nan)
    left, right = (rotation_ratio(structure, one) for one in (smallest, largest))
    return np.maximum(-left, right) + 0.0


def _fitted(
    conditions: Conditions, fell: np.ndarray, known: np.ndarray
) -> tuple[Fragility | None, str]:
    """The curve of outcomes (n, m), or the reason why there is none."""
    station = np.broadcast_to(np.array(conditions.stations)[:, None], fell.shape)
    pga = np.broadcast_to(conditions.levels, fell.shape)
    if not fell[known].any():
        return None, "no record overturns it: add higher intensities"
    if fell[known].all():
        return None, "every record overturns it at each intensity: add lower ones"
    if len(set(conditions.stations)) == 1:
        return None, "one record says nothing of others: give several"
    try:
        curve = fit_fragility(
            pga[known], fell[known], left_out=int((~known).sum()), group=station[known]
        )
    except ValueError as error:
        if "falls" in str(error):
            return None, "fewer records overturn it at higher intensities: give more records"
        where = "between" if fell[:, -1].all() else "higher"
        return None, (
            "too few intensities at which some records overturn it and others do not: add some "
            f"{where}"
        )
    return curve, ""
