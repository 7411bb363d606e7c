"""The numbers that stand for words wherever parts of a program meet, each in its only home.

A generated module, the step of a method, the loop, lanes and Python take them from here.
`rockeom/integrator/provided.py` declares the functions that differ from program to program.
"""

import numpy as np

# How a motion ended
(
    COMPLETED, CAME_TO_REST, OVERTURNED, TOO_MANY_IMPACTS, STALLED, CHATTER, NOT_FINITE,
    NO_SOLUTION, SEVERAL_SOLUTIONS, OUT_OF_BOUNDS,
) = range(10)  # fmt: skip
OUTCOMES = {
    COMPLETED: "completed",
    CAME_TO_REST: "came to rest",
    OVERTURNED: "overturned",
    TOO_MANY_IMPACTS: "too many impacts",
    STALLED: "stalled",
    CHATTER: "chatter",
    NOT_FINITE: "not finite",
    NO_SOLUTION: "no solution",
    SEVERAL_SOLUTIONS: "several solutions",
    OUT_OF_BOUNDS: "out of bounds",
}
"""The word of each outcome, in `rockeom.simulation.response.Outcome`, in sweeps and in files."""

GRAZES, OTHER_WAY = 1, 2
"""Why derivatives are not carried on: the time of an event is not known, or what followed it is not
found again."""

FULL = 10  # it has not: the records must be emptied before the loop goes on, or a turn is over

# Kinds of guards, by the event that ends a mode; and the end of infinitely many impacts, a kind of
# event without a guard
IMPACT, UPLIFT, SWITCH, REST = range(4)
KIND_OF = {"impact": IMPACT, "uplift": UPLIFT, "switch": SWITCH}

# and of those of a point that may open, slide and bounce: its gap closes, its normal force falls to
# zero, its friction reaches the bound, its slip comes to a stop
LANDING, LIFTING, SLIPPING, STICKING = range(4, 8)

BOUND = 8  # kind of the guard beyond which a declaration does not hold

STEPPED_OVER = -2
"""In place of the guard of a REST that is a step over events without end, see `step_over`."""

# States of such a point, and results where no mode follows, or several may
# (one that is closed without friction slips or not, as the rest of the structure moves it; an idle
# one touches and bears nothing, since others bear the load without it)
OPEN, STICK, SLIP_RIGHT, SLIP_LEFT, FRICTIONLESS, IDLE_POINT = range(6)
DIGITS_OF_STATES = range(8)
_, BEARS, IDLES, RELEASED, SLIPS = DIGITS_OF_STATES[:5]
"""Digits of a point in the number of a mode of a structure in space: 0 where it is open.

It bears, sticking unless it is smooth; it is idle; it is released, since it would have to slip and
never does, and bears without friction; or it slips, with a digit more for each quarter turn from x
of the axis that is nearest to the direction in which it does.
"""
MOST_POINTS_IN_SPACE = 8
IMPOSSIBLE, AMBIGUOUS, NO_MORE = -1, -2, -3

# Verdicts on a step in which no guard is known to fall
STAYS_OPEN, UNCLEAR = -1, -2

MOST_DIGITS = 52
"""Digits of a number that says which guards of a mode are closed: as a float it is exact."""

MOST_MODES = 4096
"""Modes of a structure whose contacts may open, slide and bounce, or whose elements switch."""

NEVER_SLIPS = 1e300
"""The coefficient of friction of a point that never does."""

NEWTON, MOREAU, POISSON, LZB, PAIRWISE = range(5)
CONTACT_LAWS = {
    "newton": NEWTON, "moreau": MOREAU, "poisson": POISSON, "lzb": LZB, "pairwise": PAIRWISE,
}  # fmt: skip
"""The impact laws of points, by their names."""

LEAST_RESTITUTION = 1e-3
"""The least above zero with springs, LZB."""

ENERGY_ROUNDING = 1e-9
"""An impact gains energy where the kinetic energy grows by more than this part of itself."""

# Impact laws prescribe the ratio of the angular velocities; or the directions in which momentum is
# conserved; or the ratio of the kinetic energies, in a table by the speed alone; or in one by which
# an impact may lose next to nothing where the next one, on the other foot, loses much
RATIO, IMPULSIVE, TABULATED, UNEVEN = range(4)

# The status of a motion, with which `integrate` goes on, by columns of `status`
(
    MODE,
    CLOSED,  # the guard that is closed now, or -1
    IMPACTS,  # so far
    STEPS,  # steps so far, with those refused
    IDLE,  # events since time last moved
    GUARD_DUE,  # 1 where a guard may be due
    RATE_STALE,  # 1 where the rate must be found again
    STEPS_KEPT,  # in the record, since it was emptied
    EVENTS_KEPT,
    REFINED,  # segments in which equal steps would have been too long
) = range(10)
AT_THE_START = np.array([0, -1, 0, 0, 0, 1, 1, 0, 0, 0])
AT_THE_START.flags.writeable = False
"""The status of a motion that begins in mode 0."""

# and of `clock`: time, the next step (0: unknown), the error of the last step (0: of none), the end
# of the segment whose equal steps are refined (0: of none)
TIME, NEXT_STEP, LAST_ERROR, REFINED_TO = range(4)

WITH_CONSTANT = 4.0
"""Added to the kind of a segment that is a sine or a wavelet plus a constant acceleration, its last
constant: such rows have programs on ground that slopes, and no motion."""
