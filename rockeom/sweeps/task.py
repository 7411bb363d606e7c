"""`Task`: what is done with each case of a sweep."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers.checks import InputError, array_of, whole_number
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.sweeps.cases import Cases, Source


@dataclass(frozen=True, eq=False)
class Task:
    """All that another process must know of a sweep but the values of its cases.

    options : with the method named. revision : of the structure and the loop, which must be the
    same wherever the work is done. Others as of `simulate_many`.

    Raises TypeError or ValueError for what cannot be kept of a case.
    """

    case: Callable[..., Case]
    options: SolverOptions
    lanes: bool
    impact_times: int
    impact_states: bool
    quantities: Sequence[str]
    times: np.ndarray
    revision: str

    def __post_init__(self) -> None:
        count = whole_number("impact_times", self.impact_times, 0)
        object.__setattr__(self, "impact_times", count)
        if self.impact_states and not count:
            raise InputError("impact_states").wrong(
                "needs impact_times, the number of impacts to keep: it is 0"
            )
        if isinstance(self.quantities, str):
            raise InputError("quantities", self.quantities).give("a list of names")
        object.__setattr__(self, "quantities", tuple(self.quantities))
        times = array_of("times", self.times)
        object.__setattr__(self, "times", times)
        if times.size and not self.quantities:
            raise InputError("times").wrong("is given, but no `quantities` whose history is wanted")
        if not np.all(times >= 0.0):
            raise InputError("times", times.min()).give("times from 0 on, in seconds")

    @property
    def needs_responses(self) -> bool:
        """Whether each case is made and simulated by itself, with its whole response."""
        return bool(self.quantities or self.impact_states)

    def source(self, cases: Cases, module: GeneratedModule, **how: Any) -> Source:
        """The maker of the cases; cases with whole responses are made one by one."""
        return Source(self.case, cases, module=module, arrays=not self.needs_responses, **how)
