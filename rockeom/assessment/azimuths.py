"""Azimuths of a structure in space: from which direction does it fall?"""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from rockeom.analysis.risk.fragility import proportion_interval
from rockeom.assessment.remedies import paired_gain
from rockeom.assessment.trials import Conditions, Trials
from rockeom.assessment.words import percent
from rockeom.integrator.schema import in_space
from rockeom.motion.slope import azimuth_angle
from rockeom.numbers.checks import InputError, is_number
from rockeom.structures.base import Structure

STEP = 0.25 * math.pi
"""Distance of azimuths, where none are given [rad]."""

_OF_X = "Azimuth of its x axis from the first component"
_MOST = 360
"""Azimuths by number: not more, a degree apart."""
_SAME = 1e-9
"""[rad] Azimuths that differ less are one."""


class AtAzimuth(NamedTuple):
    """Number of recordings that overturn a structure turned to an azimuth.

    Parameters
    ----------
    azimuth : float
        Azimuth of the structure [rad].
    overturned : ndarray
        Number of recordings that overturn it, at each PGA (m,).
    number : ndarray
        Number of recordings with an answer (m,).
    lower : ndarray
        Lower bounds of the probability of overturning (m,), Clopper and Pearson's. At each PGA the
        bounds of all azimuths hold together with the probability that is the level.
    upper : ndarray
        Upper bounds (m,).
    """

    azimuth: float
    overturned: np.ndarray
    number: np.ndarray
    lower: np.ndarray
    upper: np.ndarray


def azimuths_of(structure: Structure, given: Any) -> tuple[float, ...]:
    """The azimuths of `assess` [rad]; none in the plane.

    Raises InputError for what is no azimuth, for one that is there twice, and in the plane.
    """
    if not in_space(structure.module):
        if given is not None:
            raise InputError("azimuths", given, "assess").so("it moves in a plane: leave them out")
        return ()
    sector = getattr(structure, "symmetry_angle", 2.0 * math.pi)
    if given is None:
        given = max(round(sector / STEP), 1)
    if is_number(given):
        if not (1 <= given <= _MOST and given == int(given)):
            raise InputError("azimuths", given, "assess").give(
                f'how many, 1 to {_MOST}, or angles such as "30 deg"',
                python='as in azimuths=["0 deg", "30 deg"]',
            )
        return tuple((sector * np.arange(int(given)) / given).tolist()) if sector else (0.0,)
    one = isinstance(given, str) or not isinstance(given, Iterable)
    found = tuple(
        float(azimuth_angle(x, "azimuths", "assess")) for x in ([given] if one else given)
    )
    apart = np.sort(np.mod(found, 2.0 * math.pi))
    apart = np.diff(apart, append=apart[:1] + 2.0 * math.pi)  # the last one from the first, too
    if not found or (apart < _SAME).any():
        raise InputError("azimuths", given, "assess").give("one azimuth or more, each once")
    return found


def by_azimuth(trials: Trials, conditions: Conditions, level: float) -> tuple[AtAzimuth, ...]:
    """The outcomes at each azimuth; level : at which the intervals of all of them hold together."""
    n, answers = len(conditions.azimuths), []
    for i, azimuth in enumerate(conditions.azimuths):
        fell, number = (of[i::n].sum(axis=0) for of in (trials.fell, trials.answered))
        known = np.maximum(number, 1)  # with none at all the lower bound is 0
        lower, upper = proportion_interval(fell, known, 1.0 - (1.0 - level) / n)
        answers.append(AtAzimuth(azimuth, fell, number, lower, np.where(number, upper, 1.0)))
    return tuple(answers)


def in_words(
    answers: tuple[AtAzimuth, ...], trials: Trials, conditions: Conditions, level: float
) -> str:
    """Where it falls most and least, and how far the difference is known; "" for one azimuth.

    The interval is that of `paired_gain`, at a level at which those of all pairs hold together: the
    two azimuths are chosen by what they differ in.
    """
    n, falls = len(answers), [int(one.overturned.sum()) for one in answers]
    if n < 2 or not any(falls):
        return ""
    most, least = int(np.argmax(falls)), int(np.argmin(falls))
    number = trials.fell.size // n
    if falls[most] == falls[least]:
        alike = f"it falls in {falls[most]} of {number} scaled motions"
        return f"{_OF_X}: {alike} at each of {n} azimuths."
    first, last = (f"{in_degrees(answers[i].azimuth)}, in {falls[i]}" for i in (most, least))
    said = f"{_OF_X}: it falls most at {first} of {number} scaled motions, and least"
    pair = [(trials.fell[i::n], trials.answered[i::n]) for i in (most, least)]
    before, after = (trials._replace(fell=fell, answered=answered) for fell, answered in pair)
    of_pairs = 1.0 - (1.0 - level) / math.comb(n, 2)
    more = paired_gain(before, after, conditions.recordings[::n], of_pairs)
    if more is None:
        return f"{said} at {last}."
    measured = "; no measurable difference" * (more.lower <= 0.0)
    known = f"interval of the difference {percent(more.lower)} to {percent(more.upper)}"
    known = f"{percent(level)} {known}, for all pairs of azimuths at once"
    return f"{said} at {last}{measured} ({known})."


def alone(structure: Structure, conditions: Conditions) -> str:
    """The one azimuth of an answer that others may change; "" for several, and for round ones."""
    if len(conditions.azimuths) != 1 or getattr(structure, "symmetry_angle", 1.0) == 0.0:
        return ""
    return in_degrees(conditions.azimuths[0])


def in_degrees(azimuth: float) -> str:
    return f"{math.degrees(azimuth):.4g} degrees"
