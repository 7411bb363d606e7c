"""Motions of a structure under records, as they were recorded and scaled to intensities."""

import math
import re
from collections import Counter
from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.risk.fragility import (
    Estimate,
    Fragility,
    fit_fragility,
    proportion_interval,
    proportion_interval_by_group,
)
from rockeom.analysis.sweeps import ANSWERS, FALLS, outcome_labels
from rockeom.motion.recording import Recording
from rockeom.simulation.case import Case
from rockeom.simulation.reserve import rotation_ratio
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.positions import RESERVE, TILT, has_barrier
from rockeom.structures.searched_modes import breaking
from rockeom.structures.shipped.rigid_block import RigidBlock
from rockeom.structures.shipped.sliding_block import SlidingBlock
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many

QUIET = 10.0
"""Time that is followed after a record [s]: who overturns may do so after the shaking."""
OF_CURVE, OF_TAILS = 6, 8
"""Least numbers of recordings of a curve with its median, and of the rest of its probabilities.

With fewer the intervals hold the truth less often than they say, see `benchmarks/assessment.py`.
"""
_WIDEST = 10.0
"""Ratio of the ends of an interval of a PGA that says too little."""
_PLACE = re.compile(r"x(_\d+)?")
"""Names of the coordinates of feet that slide."""
_LIFTED = 1e-9  # rad; less is rounding


class Conditions(NamedTuple):
    """Conditions under which structures are compared.

    Parameters
    ----------
    motions : tuple of Recording
        Motions (n), one horizontal component each, with the vertical one if there is one; in space
        whole recordings, each for each azimuth.
    recordings : ndarray
        Number of the recording of each motion (n,), the same for all motions of one event at one
        station.
    levels : ndarray
        PGA that each is scaled to (m,) [m/s2].
    friction : float
        Coefficient of friction below the feet; None where it is unknown.
    impact : ImpactLaw
        Impact law; None for the default.
    both_ways : bool, optional
        Whether each record is among the motions twice, the second time reversed.
    left_out : tuple of str, optional
        Names of vertical components, which were not used.
    pga_given : object, optional
        PGA as the user wrote it.
    slope : float, optional
        Slope of the ground [rad].
    azimuths : tuple of float, optional
        Azimuths of a structure in space [rad], those of a recording next to one another.
    """

    motions: tuple[Recording, ...]
    recordings: np.ndarray
    levels: np.ndarray
    friction: float | None
    impact: ImpactLaw | None
    both_ways: bool = False
    left_out: tuple[str, ...] = ()
    pga_given: Any = None
    slope: float = 0.0
    azimuths: tuple[float, ...] = ()

    @property
    def vertical_peak(self) -> float:
        """The largest vertical acceleration, with all scaled to the highest level [m/s2]."""
        shaken = [(one.vertical.peak, one.horizontal[0]) for one in self.motions if one.vertical]
        return float(self.levels[-1]) * max((up / one.peak for up, one in shaken), default=0.0)


class UnderRecord(NamedTuple):
    """Effect of a record, as it was recorded or scaled, by a sweep that was finished.

    Parameters
    ----------
    name : str
        Name of the record.
    peak : float
        Peak ground acceleration [m/s2].
    outcome : str
        Outcome of the motion.
    rotation : float
        Largest rotation of any body [rad].
    part : float
        Rotation over the overturning angle, in space tilt over that of the barrier, NaN where that
        is unknown.
    room : float
        Room outside the place before that its base, sliding, and its top, leaning, take up at most
        [m]; NaN where it overturned or feet do not slide.
    displacement : float
        Displacement from that place, in the end [m]; NaN likewise.
    body : str
        Body that turned furthest in the end.
    broken : tuple of str
        Ties that broke.
    """

    name: str
    peak: float
    outcome: str
    rotation: float
    part: float
    room: float
    displacement: float
    body: str
    broken: tuple[str, ...] = ()

    @property
    def lifts(self) -> bool:
        return self.rotation > _LIFTED

    @property
    def fell(self) -> bool:
        return self.outcome == FALLS

    @property
    def answered(self) -> bool:
        return self.outcome in ANSWERS


class AtIntensity(NamedTuple):
    """Number of motions, scaled to a PGA, that lift a foot and that overturn.

    Parameters
    ----------
    pga : float
        Peak ground acceleration [m/s2].
    lifted : int
        Number of motions that lift a foot.
    overturned : int
        Number of motions that overturn.
    number : int
        Number of motions with an answer.
    lower : float
        Lower bound of the probability of overturning, Clopper and Pearson's by recording; in space
        of the parts of the azimuths, summed over recordings.
    upper : float
        Upper bound.
    room : float
        Largest room of those that stand [m]; NaN where there are none or feet do not slide.
    """

    pga: float
    lifted: int
    overturned: int
    number: int
    lower: float
    upper: float
    room: float


class Trials(NamedTuple):
    """Motions (n, m) at each intensity, and the curve or the reason why there is none.

    Parameters
    ----------
    fell : ndarray
        Whether each motion overturned (n, m).
    answered : ndarray
        Whether each motion has an answer (n, m).
    intensities : tuple of AtIntensity
        Counts at each intensity.
    fragility : Fragility
        Fragility curve; None without one.
    no_curve : str
        Reason why there is none.
    bodies : dict of str to int
        Number of falls by the body that fell.
    without_answer : dict of str to int
        Number of other outcomes by their names.
    broken : dict of str to ndarray
        Whether each motion broke a tie (n, m), by the names of the ties that may break.
    """

    fell: np.ndarray
    answered: np.ndarray
    intensities: tuple[AtIntensity, ...]
    fragility: Fragility | None
    no_curve: str
    bodies: dict[str, int]
    without_answer: dict[str, int]
    broken: dict[str, np.ndarray]


def can_slide(structure: Structure, conditions: Conditions) -> bool:
    """Whether sliding is simulated: of feet that slide, or a rigid block on the default law."""
    slides = conditions.friction is not None and conditions.impact is None
    return slides and (type(structure) is RigidBlock or own_friction(structure) is not None)


def own_friction(structure: Structure) -> float | None:
    """The friction of feet that slide in the structure itself; None where they do not."""
    support = getattr(structure, "support", None)
    return getattr(structure if support is None else support, "friction", None)


def simulated(structure: Structure, conditions: Conditions) -> Structure:
    """The structure itself, or the same block on feet that slide and do not bounce."""
    if type(structure) is not RigidBlock or not can_slide(structure, conditions):
        return structure
    assert conditions.friction is not None
    values = {f.name: getattr(structure, f.name) for f in fields(structure)}
    values["inertia"] = structure.parameters()["inertia"]
    return SlidingBlock(**values, friction=conditions.friction, restitution=0.0)


def as_recorded(structure: Structure, conditions: Conditions) -> tuple[UnderRecord, ...]:
    """The effect of each record as it was recorded."""
    return tuple(one for (one,) in under(structure, conditions, None))


def scaled(structure: Structure, conditions: Conditions, level: float) -> Trials:
    """Outcomes under each record scaled to each intensity; level : of the intervals."""
    levels = conditions.levels
    rows = under(structure, conditions, levels)
    every = [one for row in rows for one in row]
    fell, answered = (
        np.array(which, dtype=bool).reshape(len(rows), len(levels))
        for which in ([one.fell for one in every], [one.answered for one in every])
    )
    return Trials(
        fell,
        answered,
        tuple(
            _at(conditions, pga, column, level)
            for pga, column in zip(levels.tolist(), zip(*rows, strict=True), strict=False)
        ),
        *fitted(conditions, fell, answered),
        Counter(one.body for one in every if one.fell),
        Counter(one.outcome for one in every if not one.answered),
        {
            name: np.reshape([name in one.broken for one in every], fell.shape)
            for name in breaking(structure.module)
        },
    )


def case_of(
    structure: Structure, motion: Recording, conditions: Conditions, azimuth: float = 0.0
) -> Case:
    """The structure under a motion and quiet time after it."""
    impact, slope = conditions.impact, conditions.slope
    *across, vertical = *motion.horizontal, motion.vertical
    end = max(one.duration for one in (*across, vertical) if one is not None) + QUIET
    if conditions.azimuths:
        shaken: Any = motion  # which is all components
        return Case(structure, shaken, impact, duration=end, azimuth=azimuth)
    return Case(structure, across[0], impact, duration=end, vertical=vertical, slope=slope)


def peak_of(motion: Recording) -> float:
    """The PGA of a motion [m/s2]: of two components their geometric mean, as it is scaled."""
    peaks = [one.peak for one in motion.horizontal]
    return peaks[0] if len(peaks) == 1 else float(np.sqrt(np.prod(peaks)))


def under(
    structure: Structure, conditions: Conditions, levels: np.ndarray | None
) -> list[tuple[UnderRecord, ...]]:
    """(n, 1) effects of motions as they were recorded, or (n, m) scaled to levels.

    A keyboard interrupt is raised: nothing is concluded from a part of the motions.
    """
    motions, tried = conditions.motions, simulated(structure, conditions)
    if not motions:
        return []

    def case(motion: Recording, pga: float | None = None, azimuth: float = 0.0) -> Case:
        return case_of(tried, motion if pga is None else motion.scaled_to(pga), conditions, azimuth)

    turns = conditions.azimuths
    leans = levels is None and has_barrier(structure)  # quantities take longer than the motions
    over: dict[str, Any] = {"motion": motions[:: len(turns) or 1]}
    over |= ({"azimuth": turns} if turns else {}) | ({} if levels is None else {"pga": levels})
    quiet, quantities = SweepOptions(progress=False), (TILT, RESERVE) if leans else ()
    sweep = simulate_many(case, over, quantities=quantities, sweep_options=quiet)
    labels = outcome_labels(sweep).values
    room = displacement = np.full(labels.shape, np.nan)
    coordinates = _tilts(structure) if turns else [*structure.falls]
    turned = sweep[["peak", "final"]].sel(state=coordinates)
    rotation, part = _rotation(sweep, structure, turned["peak"], conditions.slope)
    if can_slide(structure, conditions) and not turns:
        places = [name for name in tried.module.STATES if _PLACE.fullmatch(name)]
        base, displacement = (
            np.where(labels == FALLS, np.nan, abs(sweep[name].sel(state=places)).max("state"))
            for name in ("peak", "final")
        )
        room = base + height_of(structure)[0] * np.sin(rotation)
    bodies = np.array([""] * len(coordinates) if turns else _bodies(structure))
    body = bodies[abs(turned["final"]).argmax("state").values]
    columns = [
        x.reshape(len(motions), -1) for x in (labels, rotation, part, room, displacement, body)
    ]
    at = [f", at {math.degrees(azimuth):.4g} degrees" for azimuth in turns] or [""]
    names = [(one.name or "a ground motion") + at[i % len(at)] for i, one in enumerate(motions)]
    ties = {
        name: sweep["final"].sel(state=f"{name}_broken").values.reshape(len(motions), -1) == 1.0
        for name in breaking(tried.module)
    }
    return [
        tuple(
            UnderRecord(names[i], peak, *(x[i, j].item() for x in columns))._replace(
                broken=tuple(name for name, broken in ties.items() if broken[i, j])
            )
            for j, peak in enumerate([peak_of(motion)] if levels is None else levels.tolist())
        )
        for i, motion in enumerate(motions)
    ]


def height_of(structure: Structure) -> tuple[float, str]:
    """The height of a structure [m], and in words; nan where it is not known."""
    if full := getattr(structure, "full_height", None):
        return full, "its full height"
    half = getattr(structure, "half_height", np.nan)
    return 2.0 * half, "twice the height of the centroid"


def _rotation(sweep: Any, structure: Structure, peak: Any, slope: float) -> tuple[Any, Any]:
    """The largest rotation of each motion, and that over the overturning angle or the barrier.

    peak : of the coordinates that turn; of bodies in space the tilt, where the sweep has it.
    """
    if "maximum_quantity" in sweep:
        rotation = sweep["maximum_quantity"].sel(quantity=TILT).values
        return rotation, 1.0 - sweep["minimum_quantity"].sel(quantity=RESERVE).values
    rotation = peak.max("state").values
    if structure.overturning_angles is None:
        return rotation, np.full(rotation.shape, np.nan)
    theta = structure.module.STATES[structure.module.ROTATION]
    ratios = (
        rotation_ratio(structure, sweep[name].sel(state=theta).values, slope)
        for name in ("minimum", "maximum")
    )
    return rotation, np.maximum(*map(np.abs, ratios))


def _tilts(structure: Structure) -> list[str]:
    """The coordinates of a structure in space that turn with a tilt."""
    units = zip(structure.states, structure.module.STATE_UNITS, strict=True)
    names = [name for name, unit in units if unit == "rad" and name != "yaw"]
    return [TILT] if TILT in names else names


def _bodies(structure: Structure) -> list[str]:
    """The body that turns with each coordinate of `falls`; no names where there is but one."""
    if len(structure.falls) == 1:
        return [""]
    angles = [structure.rotations({name: 0.1}) for name in structure.falls]
    return [next((name for name, angle in one.items() if angle), "") for one in angles]


def _at(
    conditions: Conditions, pga: float, column: tuple[UnderRecord, ...], level: float
) -> AtIntensity:
    """The motions scaled to one intensity."""
    rows = [i for i, one in enumerate(column) if one.answered]
    answered = [column[i] for i in rows]
    fell = [one.fell for one in answered]
    lower, upper = 0.0, 1.0
    if rows:
        by_group = by_parts if conditions.azimuths else proportion_interval_by_group
        lower, upper = by_group(fell, conditions.recordings[rows], level)
    room = max((one.room for one in answered if one.room >= 0.0), default=np.nan)
    lifted = sum(one.lifts for one in answered)
    return AtIntensity(pga, lifted, sum(fell), len(rows), lower, upper, room)


def by_parts(fell: ArrayLike, recording: np.ndarray, level: float) -> tuple[float, float]:
    """Bounds of a probability by the part of the motions of each recording that fell.

    Clopper and Pearson's of the sum of the parts, as if so many recordings had fallen: that of
    recordings all or none of whose motions fall, which spread the most of all with such a mean.
    How often it holds the truth is in ``benchmarks/azimuths.py``.
    """
    hits = np.array(fell, dtype=float)
    parts = [hits[recording == one].mean() for one in np.unique(recording)]
    lower, upper = proportion_interval(min(sum(parts), len(parts)), len(parts), level)
    return float(lower), float(upper)


def fitted(
    conditions: Conditions, fell: np.ndarray, answered: np.ndarray
) -> tuple[Fragility | None, str]:
    """The curve of outcomes (n, m), or the reason why there is none."""
    recording = np.broadcast_to(conditions.recordings[:, None], fell.shape)[answered]
    pga = np.broadcast_to(conditions.levels, fell.shape)[answered]
    hits = fell[answered]
    if not hits.size:
        return None, "there is no motion with an answer"
    if not hits.any():
        return None, "no record overturns it: add higher intensities"
    if hits.all():
        return None, "every record overturns it at each intensity: add lower ones"
    if (n := len(np.unique(recording))) < OF_CURVE:
        return None, f"its intervals hold for {OF_CURVE} recordings or more, and there are {n}"
    try:
        return fit_fragility(pga, hits, left_out=int((~answered).sum()), group=recording), ""
    except ValueError as error:
        if "falls" in str(error):
            return None, "not more records overturn it at higher intensities: give more records"
        where = "between" if fell[:, -1].all() else "higher"
        return None, (
            "too few intensities at which some records overturn it and others do not: add some "
            f"{where}"
        )


def pga_of(curve: Fragility | None, probability: float, level: float) -> Estimate | None:
    """The PGA at a probability; None where its interval says too little or too much."""
    if curve is None or (curve.groups < OF_TAILS and probability != 0.5):
        return None
    estimate = curve.quantile(probability, level)
    return estimate if estimate.upper < _WIDEST * estimate.lower else None
