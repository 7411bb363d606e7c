"""The method of a motion, chosen by its work where the user names none.

It is DOP853, of order 8, unless one of two things says otherwise.

Samples: steps end at the samples of a record. Where these lie so close that even a step of order 5
errs less than a loose tolerance allows, a better step is of no use: RK45 takes half the stages.
Elsewhere it gains nothing. In free decays it is up to a fifth faster at a relative tolerance above
1e-5, with errors 10 to 400 times as large, and slower than DOP853 at equal errors.

Stability: an explicit step is bound by the fastest decay, though it be over in no time. Where such
steps would be many, and many times those that accuracy asks of an implicit method, it is Radau.

Both are judged by small motion at rest, see `Structure.small_motion`.
"""

from typing import NamedTuple

import numpy as np

from rockeom.simulation.case import Problem
from rockeom.simulation.options import SolverOptions
from rockeom.structures.base import Structure


class Choice(NamedTuple):
    """A method, and a few words on why it is this one."""

    method: str
    because: str


DEFAULT = Choice("DOP853", "suits most work")

LOOSE = 1e-6
"""Relative tolerance from which on order 5 may do."""

STABLE = 7.0
"""Length of an explicit step that stability bounds, times the rate of the decay, as measured."""

IMPLICIT = 8.0
"""Radau's steps while a motion turns by 1 rad or grows e-fold, times the fourth root of rtol: the
most that were counted on springs from which a structure lifts off."""

MANY, FAR = 20_000, 4.0
"""Explicit steps, and their number over that of implicit ones, from which on they are too many.
Fewer take no longer than a blink, and less than compiling another method."""


def chosen(structure: Structure, problem: Problem, options: SolverOptions) -> Choice:
    """The method that the user names, or else the one that suits this motion."""
    if options.method is not None:
        return Choice(options.method, "named")
    tables = problem.horizontal, problem.transverse, problem.vertical
    segments = max(map(len, tables)) * max(options.steps_per_segment, 1)
    rtol, end = options.rtol, problem.end
    if end * structure.fastest_damping > STABLE * MANY:
        motion, decay = structure.small_motion
        explicit = end * decay / STABLE
        implicit = max(segments, IMPLICIT * end * motion * rtol**-0.25)
        if explicit > MANY and explicit > FAR * implicit:
            return Choice("Radau", f"stability would bound explicit steps by {decay:.1e} 1/s")
    if segments and rtol >= LOOSE:
        ends = (row[1] if row[1] < np.inf else row[0] for table in tables for row in table[-1:])
        step = max(ends) / segments
        if step * max(structure.small_motion) <= rtol**0.2:
            return Choice("RK45", "order 5 does for samples so close at this tolerance")
    return DEFAULT
