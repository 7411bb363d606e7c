"""Places of bodies and feet in a state, and what a sketch shows of them.

Nothing of it stands in a compiled program: it is plain Python that nothing else calls.
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from rockeom.codegen.text import Text
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.model import Mechanism
from rockeom.symbolic.places import bodies_of, places

Columns = tuple[str, ...]


def positions(text: Text) -> dict[str, Columns]:
    """Add both functions; returns the tables that name what they fill `out` with."""
    return _positions(text) | _shapes(text)


def _positions(text: Text) -> dict[str, Columns]:
    def targets(mechanism: Mechanism) -> dict[str, sp.Expr]:
        return _into_out(e for place in places(text.model, mechanism).values() for e in place[1:])

    signature = "positions(contact, y, p, out)"
    doc = "Place x, y [m] and clockwise rotation [rad] of each of POSITIONS into out, one by one."
    if isinstance(text.model, Model):
        text.function(signature, doc, text.evaluate("positions", targets(text.model.free), "    "))
    else:
        text.by_phase(
            signature,
            doc,
            lambda mechanism, indent: text.evaluate("positions", targets(mechanism), indent),
        )
    shown = places(text.model, text.model.mechanisms[0])
    return {
        "POSITIONS": tuple(shown),
        "POSITION_KINDS": tuple(place.kind for place in shown.values()),
    }


def _shapes(text: Text) -> dict[str, Columns]:
    bodies, members = bodies_of(text.model), text.model.members
    several = [b for b in bodies if b.copies != 1]
    found = [
        *(e for b in bodies for corner in b.outline for e in corner),
        *(e for m in members for e in (*m.start_at, *m.end_at)),
        *(e for b in several for e in (b.copies, b.apart)),
    ]
    text.function(
        "shapes(p, out)",
        """Corners of bodies and ends of members [m], from the centres of bodies in their axes.

    Into out (x, y), in the order of CORNERS and MEMBER_ENDS, and then the number and the distance
    of each of COPIES.""",
        text.evaluate("shapes", _into_out(found), "    ") or ["    pass"],
    )
    return {
        "CORNERS": tuple(b.name for b in bodies for _ in b.outline),
        "MEMBERS": tuple(m.kind for m in members),
        "MEMBER_ENDS": tuple(name for m in members for name in (m.start, m.end)),
        "COPIES": tuple(b.name for b in several),
    }


def _into_out(values: Iterable[sp.Expr]) -> dict[str, sp.Expr]:
    return {f"out[{i}]": sp.sympify(e) for i, e in enumerate(values)}
