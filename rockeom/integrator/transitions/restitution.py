"""The ratio of velocities at an impact on the feet, of all programs and of Python itself.

Nothing that is provided for a program is used here.
"""

import math

import numpy as np

from rockeom.codes import TABULATED
from rockeom.compiler.decorators import inlined


@inlined
def velocity_ratio_at(law, ratio, impact, rate, p):
    """Ratio e of the angular velocities after and before an impact; `ratio`, unless tabulated.

    impact : its number in the motion. rate : of rotation before it, negative where the left foot
    lands. p : the table at its end, see `rockeom.structures.impact_laws.Table`.
    """
    return tabulated_velocity_ratio(impact, rate, p) if law >= TABULATED else ratio


def tabulated_velocity_ratio(impact, rate, p):
    """e = sqrt(r) by the table at the end of p; NaN where an impact would give energy."""
    r = tabulated_energy_ratio(impact, rate, p)
    if p[-1] != 0.0:
        r = min(max(r, 0.0), 1.0)
    return math.sqrt(r) if r <= 1.0 else np.nan


def tabulated_energy_ratio(impact, rate, p):
    """Ratio r of the kinetic energies of rocking, by the table at the end of p.

    The rows of the left foot come first, then as many of the right one, the number of rows of a
    foot, their columns, and whether r is bounded. A row of one column is r of one impact; behind
    the last row the first one follows. A row of four holds up to a limit of the rate: that limit,
    r at no rate, its slope, and what is divided by the rate.
    """
    rows, columns = int(p[-3]), int(p[-2])
    first = p.shape[0] - 3 - (rows if rate > 0.0 else 2 * rows) * columns
    if columns == 1:
        return p[first + impact - rows * int(impact / rows)]
    speed = abs(rate)
    for _ in range(rows - 1):
        if speed < p[first]:
            break
        first += 4
    r = p[first + 1] + p[first + 2] * speed
    if p[first + 3] != 0.0:
        r += p[first + 3] / speed
    return r
