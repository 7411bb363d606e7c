"""Forces of the ground on the feet."""

import sympy as sp

from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.fractions import cancelled
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import shaking

_IN_SPACE = ("horizontal_reaction", "transverse_reaction", "vertical_reaction")


def total_reaction(mode: Mode) -> tuple[sp.Expr, ...]:
    """Force of the ground on all feet along each axis, by Newton's second law."""
    *across, up = shaking(mode.bodies)
    field = (*across, up + mode.gravity)
    total = [sp.S.Zero] * (len(across) - 1) + [-sp.sympify(force) for force in mode.beside_feet]
    for body in mode.bodies:
        for i, e in enumerate(map(mode.approximated, body.position)):
            moved = rate(rate(e, mode.coordinates), mode.coordinates)
            total[i] += body.mass * (moved + field[i])
    return tuple(map(tidy, total))


def reactions(model: HybridModel, mode: Mode) -> dict[str, sp.Expr]:
    """Horizontal force, and vertical force at the left and the right foot, where there are feet.

    The horizontal force is the sum over both feet: in full contact statics leaves open how
    they share it. Expressions contain the accelerations of the mode's coordinates. In space the
    force is that of the whole base, along the three axes.
    """
    total = total_reaction(mode)
    if len(total) > 2:
        return dict(zip(_IN_SPACE, total, strict=True))
    horizontal, vertical = total
    feet = mode.feet
    if not feet:
        return {"horizontal_reaction": horizontal}
    if all(foot.force is not None for foot in feet.values()):
        left, right = feet["left"].force, feet["right"].force
    elif mode.has_side:
        left, right = vertical * (1 - SIDE) / 2, vertical * (1 + SIDE) / 2
    else:
        left = _force_of_held_foot(model, "left", "right")
        right = _force_of_held_foot(model, "right", "left")
    return {
        "horizontal_reaction": horizontal,
        "left_reaction": left,
        "right_reaction": right,
    }


def _force_of_held_foot(model: HybridModel, foot: str, pivot: str) -> sp.Expr:
    """Vertical force at a foot in full contact, by virtual work.

    Release the foot: the structure turns about the other one. The residual of the
    equation of that rotation at rest is the work of the force that held the foot.
    """
    turning = model.mode(pivot)
    side = turning.side_of(pivot)
    theta = model.rotation
    held = {theta.position: 0, theta.velocity: 0, theta.acceleration: 0}
    row = [c.name for c in turning.coordinates].index(theta.name)
    lacking = model.written_out(turning.equations.residual[row])
    lift = sp.diff(turning.approximated(turning.feet[foot].position[1]), theta.position)
    return cancelled((lacking / lift).subs(SIDE, side).subs(held))
