"""Quantities of a motion with their derivatives, out of those of its states and parameters."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rockeom.dual import Dual, tangent_of
from rockeom.mathematics import of_compounds
from rockeom.numeric.states import filled
from rockeom.numeric.tangents import Tangents


@dataclass(frozen=True)
class Varied:
    """A state or one of the kinematics of a motion, such as "displacement".

    along (P, m) : derivatives of the parameters of the structure, prepared.
    """

    found: Tangents
    along: np.ndarray
    name: str

    @classmethod
    def of(cls, found: Tangents, name: str) -> Varied:
        """Raises ValueError, naming what there is, for a quantity that is none of these."""
        structure = found.response.structure
        known = (*structure.states, *structure.module.KINEMATICS)
        if name not in known:
            raise ValueError(
                f"{name!r} has no derivatives of its own: choose of {', '.join(known)}"
            )
        return cls(found, found._motion.along.p[: len(structure.vector)], name)

    def at(self, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(n, m) derivatives at fixed times (n,) [s], and (n,) by time; behind an event at one."""
        run = self.found.response
        y, contact = run.steps.at(times, "right")
        by = np.concatenate([self.found.at(times), self._rates(times, y, contact)], axis=2)
        if self.name in run.states:
            of = by[:, run.states.index(self.name)]
        else:
            of = np.array([self._of_states(*row) for row in zip(contact, y, by, strict=True)])
        return of[:, :-1], of[:, -1]

    @cached_property
    def peak(self) -> Dual:
        """The value of largest size.

        Where it is largest its rate is zero, so that its derivative is that at a fixed time. A rate
        may be largest where it jumps; there it is that of the passage, which moves.
        """
        run = self.found.response
        best = run.extremes(self.name)
        if self.name in run.states:
            row, (times, _, states) = run.states.index(self.name), run.passages
            here = np.abs(times - best.peak_time)[:, None] <= 1e-9 * run.duration
            same = np.abs(states[..., row] - best.peak) <= 1e-9 * abs(best.peak)
            sides = np.stack([self.found.before, self.found.after], axis=1)
            for k, side in np.argwhere(here & same):
                return Dual(best.peak, sides[k, side, row])
        return Dual(best.peak, self.at(np.array([best.peak_time]))[0][0])

    def _rates(self, times: np.ndarray, y: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """(n, N, 1)."""
        run = self.found.response
        ground = [
            np.zeros(len(times)) if motion is None else motion.acceleration(times)
            for motion in (run.motion, run.vertical)
        ]
        size = run.structure.module.N_STATES
        return filled(run.structure, "rates", size, contact, y, *ground).T[..., None]

    def _of_states(self, contact: int, y: np.ndarray, by: np.ndarray) -> np.ndarray:
        """(m + 1,) derivatives of one of the kinematics at a state y (N,), whose are by (N, m + 1).

        The last direction is time, in which the parameters stand still.
        """
        structure = self.found.response.structure
        module, m = structure.module, by.shape[1]
        still = np.zeros((len(self.along), 1))
        p = _duals(structure.vector, np.concatenate([self.along, still], axis=1))
        out = np.empty(len(module.KINEMATICS), dtype=object)
        of_compounds(module).kinematics(int(contact), _duals(y, by), p, out)
        return tangent_of(out, m)[module.KINEMATICS.index(self.name)]


def _duals(values: np.ndarray, along: np.ndarray) -> np.ndarray:
    found = np.empty(len(values), dtype=object)
    found[:] = [Dual(float(x), of) for x, of in zip(values, along, strict=True)]
    return found
