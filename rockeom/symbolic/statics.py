"""Equilibrium under a horizontal force at the load point, and the pushover curve."""

from typing import NamedTuple

import sympy as sp
from sympy.simplify.fu import TR10i
from sympy.solvers.solveset import NonlinearError

from rockeom.symbolic.algebra import tidy
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode

LOAD = sp.Symbol("P", real=True)
"""Horizontal force at the load point [N], positive to the right."""


def equilibrium(mode: Mode) -> sp.Matrix:
    """dV/dq - Q - P dx/dq, (n, 1): zero in equilibrium under the force P at the load point.

    Q are the declared forces at rest. Without a load point, dV/dq - Q.
    """
    eq = mode.equations
    at_rest = {c.velocity: 0 for c in mode.coordinates}
    lacking = eq.gravity_forces + eq.elastic_forces - eq.applied_forces.subs(at_rest)
    if mode.load_point is None:
        return lacking
    x = mode.approximated(mode.load_point[0])
    lever = [sp.diff(x, c.position) for c in mode.coordinates]
    return lacking - LOAD * sp.Matrix(lever).reshape(len(lever), 1)


class SmallRotations(NamedTuple):
    """K q + constant - lever P, each (n, .): equilibrium to first order in the coordinates.

    K has the moments of forces that the rotation moves, P-delta.
    """

    stiffness: sp.Matrix
    constant: sp.Matrix
    lever: sp.Matrix


def small_rotations(mode: Mode) -> SmallRotations:
    """`equilibrium` to first order in the coordinates, the load acting on the upright structure."""
    rows = equilibrium(mode)
    q = [c.position for c in mode.coordinates]
    upright = dict.fromkeys(q, 0)
    unloaded = rows.subs(LOAD, 0)
    return SmallRotations(
        unloaded.jacobian(q).subs(upright), unloaded.subs(upright), -rows.diff(LOAD).subs(upright)
    )


def pushover(model: HybridModel, name: str) -> sp.Expr:
    """The force P that holds the structure at a rotation, as a quotient in lowest terms.

    See `holding_force`, of which laws are left as they are: of functions nothing is known that
    could make it simpler.
    """
    force = sp.together(holding_force(model, name))
    if model.functions:
        return force
    above, below = map(tidy, sp.fraction(force))
    # sin(a) cos(b) + cos(a) sin(b) = sin(a + b), and its like
    above, below = map(TR10i, sp.fraction(sp.factor(above / below)))
    return above / below


def holding_force(model: HybridModel, name: str) -> sp.Expr:
    """The force P that holds the structure at a rotation, the other coordinates condensed.

    Raises NotImplementedError where the condensation has no closed form that is unique (the
    other coordinates enter non-linearly); the numeric pushover solves these. Raises ValueError
    for a mode that does not rotate.
    """
    mode = model.mode(name)
    if model.rotation not in mode.coordinates:
        raise ValueError(f"{model.name} does not rotate in the mode {name!r}")
    rows = [mode.put(e, name) for e in equilibrium(mode)]
    names = [c.name for c in mode.coordinates]
    turning = rows.pop(names.index(model.rotation.name))
    others = [c.position for c in mode.coordinates if c != model.rotation]
    if others:
        try:
            (others_at,) = sp.linsolve(rows, others)
        except (ValueError, NonlinearError) as e:
            raise NotImplementedError(f"{model.name}: no unique closed form") from e
        turning = turning.subs(dict(zip(others, others_at, strict=True)))
    if not turning.has(LOAD):
        raise ValueError(f"{model.name} declares no load point in {name!r}")
    if sp.diff(turning, LOAD, 2) != 0:
        raise NotImplementedError(f"{model.name}: the force enters non-linearly")
    slope = sp.diff(turning, LOAD)
    return -turning.subs(LOAD, 0) / slope
