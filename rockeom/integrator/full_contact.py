"""A structure that stands and cannot move: how long it stays so."""

from rockeom.codes import LIFTING, SLIPPING, UPLIFT
from rockeom.compiler.decorators import inlined, unrolled
from rockeom.integrator.ground import ground_accelerations
from rockeom.integrator.provided import (
    AXES,
    N_PARTS,
    N_STATES,
    can_move,
    guards,
    guards_in,
    kind_of,
    side_of,
)
from rockeom.integrator.tolerances import STAYS_ON_FEET


@inlined
def cannot_move(mode, rate, y, p):
    """Whether a structure stands, at rest, and nothing but the loss of a contact may move it."""
    if N_PARTS > 0 or side_of(mode) != 0.0:
        return False
    for i in range(N_STATES):
        if rate[i] != 0.0:
            return False
    for n in range(guards_in(mode)):
        kind = kind_of(mode, n)
        if kind != UPLIFT and kind != LIFTING and kind != SLIPPING:
            return False
    return not can_move(mode, y, p)


@inlined
def stands_until(mode, t, end, y, p, ground, g):
    """Whether a structure that cannot move stays on both its feet while linear segments last.

    The accelerations with which its feet would lift are linear in those of the ground, so that
    both ends decide.
    """
    for axis in unrolled(range(AXES)):
        if ground[axis].row[2] != 0.0:
            return False
    for turn in range(2):
        tau = end if turn == 1 else t
        guards(mode, y, p, *ground_accelerations(ground, tau), g)
        size = 0.0
        for n in range(guards_in(mode)):
            size += abs(g[n])
        for n in range(guards_in(mode)):
            if not g[n] > STAYS_ON_FEET * size:
                return False
    return True
