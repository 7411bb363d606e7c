"""`assess`: will it overturn?

import rockeom as rk

rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, mass=400.0)
answer = rk.assess(rack, "records", pga=["0.2 g", "0.4 g", "0.6 g"], friction=0.5)
print(answer)
answer.save("rack.html")
"""

import os
from collections.abc import Iterable, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from rockeom.assessment.azimuths import azimuths_of
from rockeom.assessment.comparison import Checks, checks_at
from rockeom.assessment.plane import in_plane
from rockeom.assessment.remedies import remedies
from rockeom.assessment.result import Assessment
from rockeom.assessment.statics import is_symmetric, statics_of
from rockeom.assessment.ties import tie_answers
from rockeom.assessment.trials import Conditions, as_recorded, own_friction, scaled
from rockeom.motion import GroundMotion
from rockeom.motion.components import split
from rockeom.motion.ground_motion import every_component
from rockeom.motion.motion_set import MotionSet
from rockeom.motion.recording import Recording
from rockeom.motion.recordings import chosen, recordings
from rockeom.motion.slope import slope_angle
from rockeom.motion.units import acceleration
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, not_negative, positive, require
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
    units_checked: bool = False,
    checks: Checks | None = None,
    slope: float | str = 0.0,
    azimuths: int | Sequence[float | str] | None = None,
) -> Assessment:
    """Assess whether a structure overturns: a verdict in words, with the numbers behind it and a
    page.

    Parameters
    ----------
    structure : Structure
        Structure, rigid or elastic, on rigid ground that its feet may leave, or `StackedBlocks`, of
        which the fall of either block counts. In space a body on feet, such as `Prism`, or a column
        that wobbles.
    records : MotionSet or sequence or path_like
        A MotionSet, a list of motions or recordings, one of them, a file, or a folder of files of
        networks. Each horizontal component is a record by itself; those of one recording by their
        headers, or by their names as "ELC-180" and "ELC-270", count as one in the intervals. Those
        of `Recording`, such as of ``motions.recordings()``, shake vertically, too. Vertical
        components that are no part of a recording are left out, and named. In space recordings
        shake with all their components, of which two are horizontal; motions are grouped into
        recordings by their headers or names, as by `MotionSet.recordings`.
    pga : float or str or sequence of float or str, optional
        Peak ground accelerations that each record is scaled to, numbers [m/s2] or texts such as
        "0.4 g"; eight from 1.25 to 6 times the one that lifts a foot, if not given. In space
        the PGA of a recording is the geometric mean of both horizontal components.
    friction : float, optional
        Coefficient of friction below the feet. With it a rigid block with the default impact law is
        simulated as one that slides; of other structures it is compared with what not sliding
        needs. Without it sliding is not judged.
    impact : ImpactLaw, optional
        Impact law, as for `simulate`.
    level : float, optional
        Level of the intervals of confidence, between 0 and 1.
    units_checked : bool, optional
        Whether there is a verdict though lengths, gravity or intensities look as if in another
        unit; the `questions` of the result say which.
    checks : callable, optional
        Function of the PGA [m/s2] that returns checks of codes, as those of `analysis.standards`;
        the answer and its page show them next to the motions of the records at each PGA.
    slope : float or str, optional
        Slope of the ground, a number [rad] or a text such as "5 deg" or "1 in 20"; the records act
        along it and normal to it, in both directions.
    azimuths : int or sequence of float or str, optional
        Azimuths of a structure in space, as of `simulate`: numbers [rad] or texts such as "30 deg",
        or how many, at even distances. If not given, each 45 degrees. Those by number stop where a
        structure is as at the first one: a `Prism` whose centroid is in its middle after half a
        turn, a round column at once. The verdict names an azimuth that is the only one.

    Returns
    -------
    Assessment
        Acceleration that lifts a foot, whether the structure slides before, and the fraction that
        overturns at each PGA with the interval of Clopper and Pearson (1934) by recording. From six
        recordings on it has a lognormal fragility curve of maximum likelihood (Baker 2015) with its
        PGA at 50 %, from eight on that at 5 %, as `fit_fragility` says; changes that help with
        their figures; and assumptions. No record, or each, that overturns it is an answer, too.
        In space the fraction is that of recordings and azimuths, and `azimuths` has it for each;
        `plane` has the planar answer, and `findings` say whether that was safe.

    Raises
    ------
    ValueError
        For a structure whose feet do not lift from rigid ground and for values that cannot be.
    TypeError
        For anything but a structure, or records.
    InputError
        For a motion that is there twice, and for files that cannot be read.

    Notes
    -----
    Each record is simulated as it was recorded and scaled to each PGA, and ten seconds longer; of a
    structure without symmetry, such as `OffsetBlock`, in both directions. A keyboard interrupt
    gives no answer.

    In space a recording counts by the part of the azimuths at which it overturns the structure, and
    the interval is Clopper and Pearson's of the sum of these parts, as if so many recordings had
    done it. Where the azimuths of a recording agree it is the exact one; for all parts with two
    values, of 2 to 44 recordings, it holds the truth more often (``tests/space/test_assess.py``).

    The planar answer is that of the block of the weakest edge, of the same mass and moment of
    inertia, under the component of each recording with the larger peak and the vertical one, by
    the same factor as in space; where the edge opposite is farther away, in both directions. It was
    safe, or not, where the interval of the difference of the fractions leaves out zero. A planar
    block does not bounce; where its edges are at different distances it does not slide, either.

    References
    ----------
    Clopper and Pearson (1934), Biometrika 26, 404-413; Baker (2015), Earthquake Spectra 31(1),
    579-599.

    Examples
    --------
    >>> import rockeom as rk
    >>> rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, mass=400.0)  # m, kg
    >>> records = [rk.GroundMotion.kanai_tajimi(0.02, duration=8.0, seed=s) for s in range(3)]
    >>> answer = rk.assess(rack, rk.MotionSet(records), pga=["0.4 g", "0.8 g"])
    >>> print(answer.title)
    Will it overturn? RigidBlock under 3 records

    More of the answer::

        print(answer)
        answer.save("rack.html")
        answer.pga_at(0.05)  # m/s2, with its interval
    """
    if not isinstance(structure, Structure):
        raise InputTypeError("structure", structure, "assess").give(
            "a structure, such as rk.RigidBlock.from_dimensions(width=0.6, height=2.0)"
        )
    require(0.0 < level < 1.0, "assess", "level", level, "it lies between 0 and 1, as 0.95")
    if friction is not None:
        not_negative("assess", friction=friction)
    own = own_friction(structure)
    if own is not None and friction not in (None, own):
        raise InputError("friction", friction, "assess").wrong(
            f"is {friction:g}, and {own:g} in the structure: leave it out"
        )
    friction = own if friction is None else friction
    angle = float(slope_angle(slope))
    if angle and friction is not None and friction <= abs(np.tan(angle)):
        raise InputError("slope", slope, "assess").so(
            f"it slides on it at a friction of {friction}"
        )
    statics = statics_of(structure, angle)
    turns = azimuths_of(structure, azimuths)
    given = _given(records, "all" if turns else "horizontal")
    motions = by_recording(() if turns else given)
    both_ways = not turns and (angle != 0.0 or not is_symmetric(structure))
    conditions = Conditions(
        *(_in_space(given, len(turns)) if turns else _in_plane(motions, both_ways)),
        _levels(pga, statics.uplift_acceleration),
        friction,
        impact,
        both_ways,
        tuple(one.name for one in motions if isinstance(one, GroundMotion)),
        pga,
        angle,
        turns,
    )
    of_codes = checks_at(checks, conditions.levels)
    recorded = as_recorded(structure, conditions)
    trials = scaled(structure, conditions, level)
    changed = remedies(structure, conditions, trials, level)
    return Assessment(
        structure, conditions, level, statics, recorded, trials, changed, units_checked, of_codes,
        tie_answers(structure, conditions, trials.broken),
        in_plane(structure, conditions, trials, level),
    )  # fmt: skip


def _given(records: Any, components: str) -> tuple[GroundMotion | Recording, ...]:
    """The motions and recordings of a set, a list, a file or a folder.

    components : of files.
    """
    if isinstance(records, str | os.PathLike):
        if Path(records).is_file():
            every = {one.name: one for one in every_component(records)}
            wanted = every if len(every) == 1 else chosen(every, components, os.fspath(records))
            return tuple(wanted.values())
        try:
            return tuple(MotionSet.from_folder(records, components=components))
        except InputError as error:
            if "\n" in error.remedy:  # files that cannot be read
                raise
            raise error.so(
                f"{error.remedy}; other files of a folder are read by rk.MotionSet.from_folder("
                f'{os.fspath(records)!r}, pattern="*.txt", units="g")'
            ) from None
    if isinstance(records, GroundMotion | Recording):
        return (records,)
    given = tuple(records) if isinstance(records, Iterable) else ()
    if not given or not all(isinstance(one, GroundMotion | Recording) for one in given):
        raise InputTypeError("records", records, "assess").give(
            'ground motions, such as rk.MotionSet.from_folder("records"), '
            '[rk.GroundMotion.read("one.at2")], or a folder'
        )
    return given


def by_recording(
    motions: Iterable[GroundMotion | Recording],
) -> tuple[GroundMotion | Recording, ...]:
    """Recordings, of horizontal motions also those of one station and event, or of one name.

    Vertical motions stay as they are.
    """
    members: dict[str | int, list[GroundMotion]] = {}
    whole: list[GroundMotion | Recording] = []
    for i, one in enumerate(motions):
        if isinstance(one, Recording) or one.is_vertical:
            whole.append(one)
            continue
        name, component = split(one.name)
        stated = one.origin.recording if one.origin is not None else ""
        members.setdefault(stated or (name if component else i), []).append(one)
    for alike in members.values():
        whole += _whole(alike) or [Recording(one.name, (one,)) for one in alike]
    return tuple(whole)


def _whole(alike: list[GroundMotion]) -> tuple[Recording, ...]:
    """The recording of two components; none for names that tell of more, as "seed 100" to 130.

    Raises InputError where the files of a network tell of more.
    """
    is_stated = alike[0].origin is not None
    try:
        return recordings(alike, "") if is_stated or len(alike) == 2 else ()
    except InputError:
        if is_stated:
            raise
        return ()


def _in_plane(
    records: Sequence[GroundMotion | Recording], both_ways: bool
) -> tuple[tuple[Recording, ...], np.ndarray]:
    """Recordings of one horizontal component, and the number of the recording of each (n,).

    both_ways : whether each is there reversed, too, with the same vertical component. Raises
    InputError for a motion that is given twice: it would count as two.
    """
    pairs = [
        (pair, number)
        for number, one in enumerate(records)
        for pair in (one.in_plane() if isinstance(one, Recording) else ())
    ]
    _check_once(pair for pair, _ in pairs)
    ways = [(one, _reversed(one)) if both_ways else (one,) for one, _ in pairs]
    numbers = np.repeat(np.array([number for _, number in pairs], dtype=int), 1 + both_ways)
    return tuple(chain.from_iterable(ways)), numbers


def _in_space(
    given: Sequence[GroundMotion | Recording], turns: int
) -> tuple[tuple[Recording, ...], np.ndarray]:
    """Recordings, each for each of some azimuths, and their numbers (n,).

    Motions are grouped by their headers or names. Raises InputError for a motion that is given
    twice, and where a component is missing.
    """
    whole = [one for one in given if isinstance(one, Recording)]
    whole += recordings([one for one in given if isinstance(one, GroundMotion)], "")
    for one in whole:
        one.in_space()  # two at right angles, or it says so
    _check_once(whole)
    numbers = np.repeat(np.arange(len(whole)), turns)
    return tuple(whole[i] for i in numbers), numbers


def _check_once(motions: Iterable[Recording]) -> None:
    """Raise InputError for a motion that is there twice: it would count as two."""
    found: dict[bytes, Recording] = {}
    for one in motions:
        table = b"".join(motion.segments.tobytes() for motion in one.horizontal)
        if table in found:
            raise InputError("records", of="assess").wrong(
                f"has one motion twice, as {found[table].name!r} and as {one.name!r}: give "
                "each once"
            )
        found[table] = one


def _reversed(one: Recording) -> Recording:
    """The recording with its horizontal component in the other direction."""
    return Recording(f"{one.name}, reversed", (-one.horizontal[0],), one.vertical)


def _levels(pga: Any, threshold: float) -> np.ndarray:
    """(m,) PGA to scale to, rising [m/s2]."""
    if pga is None:
        return threshold * np.array(MULTIPLES)
    one = isinstance(pga, str) or np.ndim(pga) == 0
    peaks = [acceleration("pga", value) for value in ([pga] if one else pga)]
    (levels,) = positive("assess", pga=peaks)
    if not levels.size:
        raise InputError("pga", of="assess").wrong("is empty: give one intensity or more")
    return np.unique(levels)
