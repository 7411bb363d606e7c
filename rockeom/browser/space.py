"""The way of a body in space and of its axis, as a page asks for them besides the motion.

This text is joined to others, see `rockeom.browser.page`.
"""

import numpy as np

from rockeom.browser.written import BODY
from rockeom.compiler.decorators import Floats, Floats2, Ints, entry
from rockeom.integrator.provided import POSITIONS, positions

SIZE = 12
"""Numbers of a place in space: x, y, z and the matrix of the rotation, row by row."""


@entry
def leans(states: Floats2, modes: Ints, p: Floats, spacing: Floats, out: Floats2):
    """Where the body is at the samples of a motion, as `motion` has left it.

    out (8, n) : its place x, y, z; its axis along x, y, z of the ground; and the vertical along x
    and y of the body.
    """
    places = np.empty(SIZE * len(POSITIONS))
    for i in range(int(spacing[1])):
        positions(modes[i], states[i], p, places)
        at = places[SIZE * BODY : SIZE * BODY + SIZE]
        for k in range(3):
            out[k, i], out[3 + k, i] = at[k], at[5 + 3 * k]
        out[6, i], out[7, i] = at[9], at[10]
