"""Ties of a structure under records: which break, at which intensity, and which breaks first."""

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rockeom.analysis.sweeps import FALLS
from rockeom.assessment.trials import Conditions, Trials, case_of, simulated
from rockeom.assessment.words import in_g
from rockeom.simulation.simulate import simulate
from rockeom.structures.base import Structure

STRETCH = 1e-3
"""Extension of a strap under the force that holds the structure still, over its height."""


class TieAnswer(NamedTuple):
    """Number of motions in which a tie breaks.

    Parameters
    ----------
    name : str
        Name of the tie.
    broken : tuple of int
        Number of motions in which it breaks, at each PGA.
    first : int
        Number of those at the lowest PGA at which any tie breaks in which it breaks first.
    """

    name: str
    broken: tuple[int, ...]
    first: int


def tie_answers(
    structure: Structure, conditions: Conditions, broken: dict[str, np.ndarray]
) -> tuple[TieAnswer, ...]:
    """The answer of each tie; broken : whether each motion broke it at each PGA (n, m)."""
    first = Counter[str]()
    counts = {name: of_tie.sum(axis=0) for name, of_tie in broken.items()}  # (m,) each
    levels = np.flatnonzero(sum(counts.values()))
    if len(levels):
        lowest = levels[0]
        motions = np.flatnonzero(np.any([one[:, lowest] for one in broken.values()], axis=0))
        first = _first(structure, conditions, motions, float(conditions.levels[lowest]))
    return tuple(
        TieAnswer(name, tuple(count.tolist()), first[name]) for name, count in counts.items()
    )


def _first(
    structure: Structure, conditions: Conditions, motions: np.ndarray, pga: float
) -> Counter[str]:
    """How often each tie breaks first under motions that are scaled to a PGA."""
    tried, first = simulated(structure, conditions), Counter[str]()
    for i in motions:
        run = simulate(case_of(tried, conditions.motions[i].scaled_to(pga), conditions))
        first[next(event.contact for event in run.events if event.kind == "break")] += 1
    return first


class StrapTrial(NamedTuple):
    """A strap that holds a structure at rest, under motions at the highest PGA.

    Parameters
    ----------
    stiffness : float
        Stiffness of the strap [N/m].
    force : float
        Largest force of one [N].
    overturned : int
        Number of motions that overturn the structure all the same.
    number : int
        Number of motions.
    """

    stiffness: float
    force: float
    overturned: int
    number: int


def strap_trial(
    structure: Structure, conditions: Conditions, height: float, force: float
) -> StrapTrial | None:
    """Motions of a structure with a strap alone; None of one that is strapped by statics alone.

    height : of the strap [m]; force : that holds the structure still [N].
    """
    strapped = getattr(structure, "strapped", None)
    if strapped is None or not conditions.motions:
        return None
    stiffness, top = force / (STRETCH * height), float(conditions.levels[-1])
    held = strapped(height, stiffness)
    runs = [simulate(case_of(held, one.scaled_to(top), conditions)) for one in conditions.motions]
    forces = [f"{one.name}_force" for one in held.restraint]
    largest = max(one.maximum for run in runs for one in run.extremes_of(forces).values())
    fell = sum(run.outcome == FALLS for run in runs)
    return StrapTrial(stiffness, largest, fell, len(runs))


def in_words(answers: Sequence[TieAnswer], trials: Trials, conditions: Conditions) -> str:
    """Which tie breaks first, from which PGA on the others do, and what follows.

    Empty where none can break.
    """
    if not answers:
        return ""
    levels, motions = conditions.levels.tolist(), len(conditions.motions)
    any_broken = np.any([*trials.broken.values()], axis=0)
    if not any_broken.any():
        return f"Restraints: none breaks up to a PGA of {in_g(levels[-1])}."
    lowest = int(np.flatnonzero(any_broken.any(axis=0))[0])
    said = []
    for one in sorted(answers, key=lambda one: -one.first):
        j = next((j for j, n in enumerate(one.broken) if n), None)
        if j is None:
            said.append(f"{one.name} holds")
            continue
        of = f"in {one.broken[j]} of {motions} at a PGA of {in_g(levels[j])}"
        firsts = f", first in {one.first}" if j == lowest else ""
        said.append(f"{one.name} breaks {of}{firsts}")
    counted = any_broken & trials.answered
    follows = (
        f"{(trials.fell & counted).sum()} of {counted.sum()} scaled motions in which one breaks"
    )
    return f"Restraints: {'; '.join(said)}. Overturning follows in {follows}."
