"""`assess`: will it overturn?

import rockeom as rk

rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, mass=400.0)
answer = rk.assess(rack, "records", pga=["0.2 g", "0.4 g", "0.6 g"], friction=0.5)
print(answer)
answer.save("rack.html")
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockeom.analysis.sweeps import FALLS
from rockeom.assessment.remedies import remedies
from rockeom.assessment.result import Assessment
from rockeom.assessment.statics import statics_of
from rockeom.assessment.trials import (
    Conditions,
    UnderRecord,
    as_recorded,
    can_slide,
    case_of,
    scaled,
)
from rockeom.motion import GroundMotion, MotionError
from rockeom.motion.motion_set import MotionSet
from rockeom.motion.recording import Recording
from rockeom.motion.units import acceleration
from rockeom.numbers import explained
from rockeom.numbers.arguments import not_negative, positive, require
from rockeom.numbers.checks import described
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw

Records = GroundMotion | Recording | Iterable[GroundMotion | Recording] | str | os.PathLike[str]

MULTIPLES = (1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0)
"""PGA in uplift accelerations, where none is given."""


@explained.calls()
def assess(
    structure: Structure,
    records: Records,
    *,
    pga: float | str | Sequence[float | str] | None = None,
    friction: float | None = None,
    impact: ImpactLaw | None = None,
    level: float = 0.95,
) -> Assessment:
    """Will it overturn? A verdict in words, with the numbers behind it and a page.

        rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, mass=400.0)
        answer = rk.assess(rack, records, pga=["0.2 g", "0.4 g", "0.6 g"], friction=0.5)
        print(answer)
        answer.save("rack.html")
        answer.pga_at(0.05)  # m/s2, with its interval

    structure : rigid or elastic, on rigid ground that its feet may leave.
    records : a MotionSet, a list of motions or recordings, one of them, a file, or a folder of .AT2
        files. Each horizontal component is a record by itself; those of `Recording`, such as of
        `motions.recordings()`, shake vertically, too. Vertical components that are no part of a
        recording are left out, and named.
    pga : peak ground accelerations that each record is scaled to, numbers [m/s2] or texts such as
        "0.4 g"; eight from 1.25 to 6 times the one that lifts a foot, if not given.
    friction : coefficient of friction below the feet. With it a rigid block with the default law of
        impact is simulated as one that slides; of other structures it is compared with what not
        sliding needs. Without it sliding is not judged.
    impact : as in `simulate`.
    level : of the intervals of confidence, between 0 and 1.

    Each record is simulated as it was recorded and scaled to each PGA, and ten seconds longer. The
    result has the acceleration that lifts a foot, whether it slides before, the fraction of records
    that overturn it at each PGA with the interval of Clopper and Pearson (1934), a lognormal
    fragility curve of maximum likelihood (Baker 2015) with a covariance by record (Liang and Zeger
    1986), the PGA at 5 % and 50 % by the delta method, changes that help with their figures, and
    assumptions. No record, or each, that overturns it is an answer, too.

    Raises ValueError for a structure whose feet do not lift from rigid ground and for values that
    cannot be; TypeError and MotionError for what is no structure or no records.
    """
    if not isinstance(structure, Structure):
        raise TypeError(
            f"assess: structure is {described(structure)}: give a structure, such as "
            "rk.RigidBlock.from_dimensions(width=0.6, height=2.0)"
        )
    require(0.0 < level < 1.0, "assess", "level", level, "it lies between 0 and 1, as 0.95")
    if friction is not None:
        not_negative("assess", friction=friction)
    statics = statics_of(structure)
    given = _given(records)
    alone = [one.name for one in given if isinstance(one, GroundMotion) and one.is_vertical]
    pairs = [(i, pair) for i, one in enumerate(given) for pair in _in_plane(one)]
    conditions = Conditions(
        tuple(pair for _, pair in pairs),
        tuple(i for i, _ in pairs),
        _levels(pga, statics.uplift_acceleration),
        friction,
        impact,
    )
    found = as_recorded(structure, conditions)
    return Assessment(
        structure,
        conditions,
        level,
        statics,
        found,
        scaled(structure, conditions, level),
        remedies(structure, conditions, level),
        _furthest(structure, conditions, found),
        tuple(alone),
    )


def _given(records: Any) -> tuple[GroundMotion | Recording, ...]:
    """The motions and recordings of a set, a list, a file or a folder."""
    if isinstance(records, str | os.PathLike):
        if Path(records).is_file():
            return (GroundMotion.read(records),)
        try:
            return tuple(MotionSet.from_folder(records))
        except MotionError as error:
            raise MotionError(
                f"{error}; other files of a folder are read by "
                f'rk.MotionSet.from_folder({os.fspath(records)!r}, pattern="*.txt", units="g")'
            ) from None
    if isinstance(records, GroundMotion | Recording):
        return (records,)
    given = tuple(records) if isinstance(records, Iterable) else ()
    if not given or not all(isinstance(one, GroundMotion | Recording) for one in given):
        raise TypeError(
            f"assess: records is {described(records)}: give ground motions, such as "
            'rk.MotionSet.from_folder("records"), [rk.GroundMotion.read("one.at2")], or a folder'
        )
    return given


def _in_plane(one: GroundMotion | Recording) -> tuple[Recording, ...]:
    """A recording of one horizontal component for each; none for a vertical motion."""
    if isinstance(one, Recording):
        return one.in_plane()
    return () if one.is_vertical else (Recording(one.name, (one,)),)


def _levels(pga: Any, threshold: float) -> np.ndarray:
    """(m,) PGA to scale to, rising [m/s2]."""
    if pga is None:
        return threshold * np.array(MULTIPLES)
    one = isinstance(pga, str) or np.ndim(pga) == 0
    given = [acceleration("pga", value) for value in ([pga] if one else pga)]
    (levels,) = positive("assess", pga=given)
    require(levels.size, "assess", "pga", levels.size, "give one intensity or more")
    return np.unique(levels)


def _furthest(
    structure: Structure, conditions: Conditions, found: tuple[UnderRecord, ...]
) -> Response | None:
    """Response to the record that turned it furthest and did not overturn it."""
    standing = [i for i, one in enumerate(found) if one.outcome != FALLS]
    if not standing or can_slide(structure, conditions):
        return None
    motion = conditions.motions[max(standing, key=lambda i: found[i].rotation)]
    case = case_of(structure, motion, conditions.impact)
    return simulate(
        structure, case.motion, impact=case.impact, duration=case.duration, vertical=case.vertical
    )
