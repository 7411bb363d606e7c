"""Changes that help a structure to stand, each with its effect."""

import dataclasses
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy.special import stdtrit

from rockeom.analysis.risk.fragility import Estimate
from rockeom.assessment.statics import Statics, statics_of
from rockeom.assessment.trials import Conditions, Trials, scaled
from rockeom.integrator.schema import in_space
from rockeom.structures.base import Structure

WIDER = 0.05
"""Width that a wider base gains, half of it on each side [m]."""
LOWER = 0.1
"""Part of its height by which a centroid is lowered."""


class Remedy(NamedTuple):
    """Changed structure under the same conditions.

    Parameters
    ----------
    change : str
        Change in words.
    statics : Statics
        Uplift, sliding and restraint of the changed structure at rest.
    trials : Trials
        Outcomes of the changed structure at each intensity.
    gain : Estimate
        Decrease of the part of the motions that overturn, averaged over all intensities; None for
        less than two recordings.
    """

    change: str
    statics: Statics
    trials: Trials
    gain: Estimate | None


def remedies(
    structure: Structure, conditions: Conditions, before: Trials, level: float
) -> tuple[Remedy, ...]:
    """A wider base and a lower centroid, where the structure has such numbers."""
    changes = []
    for change, changed in _changed(structure):
        after = scaled(changed, conditions, level)
        gain = paired_gain(before, after, conditions.recordings, level)
        changes.append(Remedy(change, statics_of(changed, conditions.slope), after, gain))
    return tuple(changes)


def paired_gain(
    before: Trials, after: Trials, recordings: np.ndarray, level: float
) -> Estimate | None:
    """The decrease of the mean fraction that overturns by a change, and its interval.

    The unit is one recording, with all its motions at all m intensities that have both answers.
    Student's interval of the mean of their differences would be far too short where few recordings
    differ: the sum of squares has two more, of one intensity in either direction, 1/m.
    """
    both = before.answered & after.answered
    change = before.fell.astype(float) - after.fell
    each = [recordings == one for one in np.unique(recordings)]
    of_each = np.array([change[one][both[one]].mean() for one in each if both[one].any()])
    n = len(of_each)
    if n < 2:
        return None
    mean, step = of_each.mean(), 1.0 / change.shape[1]
    squares = np.square(of_each - mean).sum() + 2.0 * step**2
    reach = stdtrit(n - 1, 0.5 + 0.5 * level) * np.sqrt(squares / (n - 1) / n)
    return Estimate(float(mean), float(max(mean - reach, -1.0)), float(min(mean + reach, 1.0)))


def _changed(structure: Structure) -> Iterator[tuple[str, Structure]]:
    """Changed structures of the same mass and inertia, each with the change in words."""
    if hasattr(structure, "changed"):
        yield from structure.changed(WIDER, LOWER)
        return
    if not hasattr(structure, "__dataclass_fields__") or in_space(structure.module):
        return
    same: Any = structure
    names = structure.defaults()
    kept = {"inertia": structure.parameters()["inertia"]} if "inertia" in names else {}
    if "half_width" in names:
        wider = dataclasses.replace(same, half_width=same.half_width + WIDER / 2, **kept)
        yield f"A base {100 * WIDER:g} cm wider, half of it on each side", wider
    for name in {"half_height", "height"} & names.keys():
        lower = {name: (1 - LOWER) * getattr(structure, name)}
        yield f"A centroid {100 * LOWER:g} % lower", dataclasses.replace(same, **lower, **kept)
