"""The largest response over a range of restitution: a procedure of design (thesis 4.9.1.4).

    import rockeom as rk
    from rockeom.analysis import design

    block = rk.RigidBlock(half_width=1.0, half_height=5.0)
    records = [rk.GroundMotion.from_library("El Centro 1940 180").scaled_to(peak=3.5)]
    found = design.restitution_envelope(block, records, ratios=[0.80, 0.85, 0.90, 0.95])
    found.envelope  # the largest |theta| over all r, for each record

The thesis proposes it where r is unknown, and rejects it: the peak is no slowly varying function of
r (Figure 4-71). `conservative` is the part of the analyses that reach a known response.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.sweeps import ANSWERS, FALLS
from rockeom.motion import GroundMotion
from rockeom.numbers.checks import InputError, positive, require, require_word
from rockeom.simulation.case import Case
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import EnergyRatio
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many


@dataclass(frozen=True, eq=False)
class RestitutionEnvelope:
    """Peaks over restitution and motion.

    Parameters
    ----------
    ratios : ndarray
        Energy ratios r (n,).
    motions : tuple of str
        Names of the motions, m of them.
    peaks : ndarray
        Largest absolute value (n, m) of the state, in its unit; infinite where the structure
        overturned.
    state : str
        Name of the state.
    overturned : ndarray
        Whether the structure overturned (n, m).
    """

    ratios: np.ndarray
    motions: tuple[str, ...]
    peaks: np.ndarray
    state: str
    overturned: np.ndarray

    @property
    def envelope(self) -> np.ndarray:
        """(m,) the largest peak over all ratios."""
        return self.peaks.max(axis=0)

    @property
    def governing(self) -> np.ndarray:
        """(m,) the ratio r that has the largest peak."""
        return self.ratios[self.peaks.argmax(axis=0)]

    def conservative(self, reference: ArrayLike) -> np.ndarray:
        """Part of the analyses whose peak exceeds a reference.

        Parameters
        ----------
        reference : array_like
            Reference in the unit of the state, one for each motion (m,) or one for all.

        Returns
        -------
        ndarray
            Part of the n ratios (m,), for each motion.
        """
        return (self.peaks > np.asarray(reference, dtype=float)).mean(axis=0)


def restitution_envelope(
    structure: Structure | Callable[[float, GroundMotion], Case],
    motions: Sequence[GroundMotion],
    ratios: ArrayLike,
    *,
    state: str | None = None,
) -> RestitutionEnvelope:
    """Peaks of a structure for each energy ratio r and each ground motion.

    Parameters
    ----------
    structure : Structure or callable
        Structure, whose impact law is then EnergyRatio(r), or a function that makes the `Case` of r
        and a motion, where r enters in another way, as in `ControlledWallOscillator`.
    motions : sequence of GroundMotion
        Ground motions, with enough quiet time at the end to overturn in.
    ratios : array_like
        Energy ratios r (n,) in (0, 1].
    state : str, optional
        State whose peaks are kept; the first one of the structure if not given.

    Returns
    -------
    RestitutionEnvelope
        Peaks (n, m), and which analyses overturned.

    Raises
    ------
    ValueError
        For a ratio outside (0, 1], an unknown state and a motion without an answer, such as one
        that stalled.
    """
    where = "restitution_envelope"
    (r,) = positive(where, ratios=np.atleast_1d(ratios))
    require(r <= 1, where, "ratios", r, "more than 1 would add energy")

    def case(ratio: float, motion: int) -> Case:
        if isinstance(structure, Structure):
            return Case(structure, motions[motion], EnergyRatio(ratio))
        return structure(ratio, motions[motion])

    over = {"ratio": [float(one) for one in r], "motion": range(len(motions))}
    sweep = simulate_many(case, over=over, sweep_options=SweepOptions(progress=False))
    names = [str(one) for one in sweep["state"].values]
    state = names[0] if state is None else state
    require_word("state", state, names, where)
    outcome = sweep.outcome.values
    lost = np.argwhere(~np.isin(outcome, ANSWERS))
    if len(lost):
        i, j = lost[0]
        raise InputError("motions", of=where).says(
            f"{len(lost)} of {outcome.size} motions give no answer, so no largest one is known: "
            f"with r = {r[i]:g} {motions[j].name!r} ends {str(outcome[i, j])!r} at "
            f"{sweep.final_time.values[i, j]:.4g} s: leave it out, or change the structure"
        )
    overturned = outcome == FALLS
    peaks = np.where(overturned, np.inf, sweep.peak.sel(state=state).values)
    return RestitutionEnvelope(r, tuple(m.name for m in motions), peaks, state, overturned)
