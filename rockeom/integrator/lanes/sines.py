"""Sine and cosine without branches, for the step of lanes in place of the prelude's.

This file is not imported.
"""

import math

import numpy as np

from rockeom.compiler.decorators import inlined


@inlined
def sine_cosine(x):
    """Sine and cosine up to an eighth of a turn; not a number beyond, where the loop goes on.

    It has no branches, so that all modes share what they have of it.
    """
    r = x if abs(x) <= math.pi / 4 else np.nan
    z = r * r
    zz = z * z
    s0 = -1 / 6 + z * (1 / 120)
    s1 = -1 / 5040 + z * (1 / 362880)
    s2 = -1 / 39916800 + z * (1 / 6227020800)
    c0 = 1 / 24 - z * (1 / 720)
    c1 = 1 / 40320 - z * (1 / 3628800)
    c2 = 1 / 479001600 - z * (1 / 87178291200)
    s1 += zz * (s2 - zz * (1 / 1307674368000))
    c1 += zz * (c2 + zz * (1 / 20922789888000))
    return r + r * z * (s0 + zz * s1), 1.0 - (0.5 * z - zz * (c0 + zz * c1))
