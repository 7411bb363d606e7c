"""Guards of a contact state on both feet, where they are sums of the state and the ground's motion.

What would lift a foot is an acceleration, out of M a = f. But for the factor that M gives, which is
positive, it is often a sum of the states and of the ground's acceleration, each by a constant: in a
step, in which these are polynomials, so is that sum then, and its coefficients are known at once.
"""

from __future__ import annotations

import sympy as sp

from rockeom.codegen.guards import outgoing
from rockeom.codegen.solve import by_states, eliminate
from rockeom.codegen.text import Text
from rockeom.symbolic.algebra import at_side
from rockeom.symbolic.model import GROUND_Y


def held(text: Text) -> int:
    """Add `held_guards`; returns the contact state that it is for, -1 if there is none."""
    found = {c: sums for c in text.model.contacts if (sums := _sums(text, c))}
    contact = next(iter(found)) if len(found) == 1 else None
    sums = found[contact] if contact else []
    text.function(
        "held_guards(y, p, ax, g)",
        """Guards of the contact state HELD into g, each divided by what is positive.

    Sums of the states and ax, while there is no vertical shaking.""",
        text.evaluate("guards", {f"g[{i}]": e for i, e in enumerate(sums)}, "    ", hoist=True)
        or ["    pass"],
        "@inlined",
    )
    return text.model.contacts.index(contact) if contact else -1


def _sums(text: Text, contact: str) -> list[sp.Expr]:
    """The guards of a contact state as such sums; none where one of them is no such sum.

    A structure of one coordinate does not move on both feet.
    """
    leaving = outgoing(text.model, contact)
    if text.n < 2 or any(t.kind != "uplift" or t.guard is not None for t in leaving):
        return []
    found = [_sum(text, t.target) for t in leaving]
    return [e for e in found if e is not None] if None not in found else []


def _sum(text: Text, rocking: str) -> sp.Expr | None:
    """What keeps the gap of a rocking contact state closed, as such a sum, if it is one."""
    model = text.model
    phase = model.mechanism(rocking)
    rotation = phase.coordinates.index(model.rotation)
    eq = phase.equations
    M, F = eq.mass_matrix.copy(), eq.forcing.copy()
    left, _ = eliminate(text, M, F)
    if not left:  # all of M is constant
        F = eq.mass_matrix.adjugate() * eq.forcing
    elif left != [rotation]:
        return None
    closed = {model.rotation.position: 0, model.rotation.velocity: 0, GROUND_Y: 0}
    side = phase.side_of(rocking)
    opens = sp.expand(at_side(model.written_out(F[rotation]), side).subs(closed))
    return by_states(text, -side * opens)
