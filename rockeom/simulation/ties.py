"""Ties of a motion: how far each was drawn, what it dissipated, and when it broke."""

from typing import NamedTuple, cast

import numpy as np

from rockeom.integrator.schema import GeneratedModule, SearchedModes
from rockeom.simulation.events import EventColumns
from rockeom.simulation.extremes import Extremes
from rockeom.structures.searched_modes import breaking

SLACK, YIELDS = -1, 1
"""States of a tie that does not pull, and of one that yields."""


class TieRecord(NamedTuple):
    """History of a tie in a motion.

    Parameters
    ----------
    largest_force : float
        Largest force [N].
    largest_elongation : float
        Largest elongation, that of a broken one included [m].
    dissipated : float
        Energy dissipated by yielding [J].
    broke_at : float or None
        Time at which it broke [s]; None for one that is whole.
    tightenings : int
        How often it drew tight after it had been slack.
    snatch_force : float
        Largest force, among the samples, between drawing tight and slackening or breaking [N]; zero
        where it never drew tight.
    """

    largest_force: float
    largest_elongation: float
    dissipated: float
    broke_at: float | None
    tightenings: int
    snatch_force: float

    def describe(self, name: str) -> str:
        """Sentence on the tie."""
        drawn = f"by up to {1e3 * self.largest_elongation:.3g} mm, {self.largest_force:.4g} N"
        if self.broke_at is None:
            return f"{name} held: it was drawn {drawn}."
        return f"{name} broke at {self.broke_at:.4g} s, at {self.largest_force:.4g} N."


class Samples(NamedTuple):
    """Times (n,) [s] and the force of a tie there (n,) [N]."""

    t: np.ndarray
    force: np.ndarray


def states_of(module: GeneratedModule, name: str) -> np.ndarray:
    """State of a tie in each mode (n,)."""
    of = cast(SearchedModes, module)
    return np.array(of.ELEMENT_STATES)[:, of.ELEMENTS.index(name)]


def tie_record(
    module: GeneratedModule,
    name: str,
    events: EventColumns,
    samples: Samples,
    largest: dict[str, Extremes],
    dissipated: float,
) -> TieRecord:
    """The record of a tie. events : of the motion; largest : of its force and its elongation."""
    of = cast(SearchedModes, module)
    states = states_of(module, name)
    before, after = states[events.kinds[:, 1]], states[events.kinds[:, 2]]
    own = before != after
    tightens, slackens = (events.times[own & (state == SLACK)] for state in (before, after))
    ends = np.append(slackens, np.inf)[np.searchsorted(slackens, tightens)]
    snatches = [
        samples.force[(samples.t >= first) & (samples.t <= last)].max(initial=0.0)
        for first, last in zip(tightens, ends, strict=True)
    ]
    broke = np.zeros(0)
    if name in breaking(of):
        whole = events.states[:, :, breaking(of)[name]]
        broke = events.times[whole[:, 1] > whole[:, 0]]
    return TieRecord(
        largest[f"{name}_force"].maximum, largest[f"{name}_elongation"].maximum, dissipated,
        float(broke[0]) if len(broke) else None, len(tightens),
        float(max(snatches, default=0.0)),
    )  # fmt: skip
