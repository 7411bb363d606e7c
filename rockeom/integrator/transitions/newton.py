"""Newton's law of impact at the points that touch: all at once, friction by the slip after it.

The contract of an impact, as impacts.py fulfils it for the other laws. This text is joined behind
candidates.py, see `rockeom.integrator.program`.
"""

from rockeom.codes import AMBIGUOUS
from rockeom.compiler.decorators import inlined
from rockeom.integrator.ground import shaking_at
from rockeom.integrator.transitions.candidates import collide, slow_landing

__fused__ = False


@inlined
def landed(mode, near, y, p, ground, contact, out):
    """Change the velocities of out (N,) by the impact of the points of near (N_POINTS,).

    y : the state before it. Returns the mode that says of each point whether nothing presses it,
    so that it may leave, or whether it sticks; or IMPOSSIBLE, or AMBIGUOUS.
    """
    as_said = collide(mode, near, 0.0, contact, out)
    if as_said == AMBIGUOUS:  # not if all of them are as slow as bounces that come to an end
        shaking = shaking_at(ground, 0, 1)
        slowest = slow_landing(mode, near, y, p, shaking, contact)
        as_said = collide(mode, near, slowest, contact, out)
    return as_said
