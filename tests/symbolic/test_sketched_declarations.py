"""What a sketch is told in a declaration: refused where it says nothing, and no equation knows."""

from dataclasses import replace

import pytest
import sympy as sp

from rockeom.codegen import module_text
from rockeom.symbolic import Body, Contact, Member, feet, rectangle
from tests.contact import declared

H, THETA, X = declared.HEIGHT.symbol, declared.THETA.position, declared.X.position
BLOCK = declared.block()
TIP = declared.on_points("on_a_tip", {"tip": (0, 0)})


def outlined(outline) -> Body:
    return replace(BLOCK, outline=outline)


WRONG = {
    "an outline that moves": (
        lambda: replace(TIP, bodies=(outlined(rectangle(X, H)),)),
        "of a corner of the outline of body 'block' contains the coordinate x",
    ),
    "an outline of two corners": (lambda: outlined([(0, 0), (1, 1)]), "give three corners"),
    "an outline of numbers": (lambda: outlined([0, 1, 2]), "give a point as"),
    "an outline of texts": (lambda: outlined([("0", 0), (1, 0), (1, 1)]), "number or a SymPy"),
    "a member to nothing": (
        lambda: replace(TIP, members=[Member("rod", "block", "blok")]),
        r"member: end is 'blok' \(did you mean",
    ),
    "a member of no kind": (lambda: Member("beam", "block", "ground"), "kind is 'beam'"),
    "no member": (lambda: replace(TIP, members=["rod"]), "give objects of Member"),
    "a member that grows": (
        lambda: replace(TIP, members=[Member("rod", "block", "ground", (0, THETA))]),
        "an end of the rod from 'block' to 'ground' contains the coordinate theta",
    ),
    "a body and a contact of one name": (
        lambda: replace(TIP, bodies=(replace(BLOCK, name="tip"),)),
        "tip is the name of two of its bodies, contacts and elements",
    ),
    "a body that is called as the load point": (
        lambda: replace(TIP, bodies=(replace(BLOCK, name="load"),)),
        "load is the name of two",
    ),
    "a place that is a text": (lambda: replace(TIP.contacts[0], place="here"), "place is 'here'"),
    "a place of velocities": (
        lambda: replace(
            TIP, contacts=(replace(TIP.contacts[0], place=(declared.X.velocity, sp.S.Zero)),)
        ),
        "x of the place of contact 'tip' contains the velocity",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_sketch_that_says_nothing_is_refused(name):
    declare, said = WRONG[name]
    with pytest.raises(ValueError, match=said):
        declare()


def test_no_equation_knows_of_a_sketch():
    """All that is compiled stands before it in the module, and is the same."""
    seen = replace(
        TIP,
        bodies=(outlined(rectangle(H / 3, H)),),
        members=[Member("rod", "block", "ground")],
        contacts=(replace(TIP.contacts[0], place=(X, H)),),
    )
    texts = (module_text(model).partition("\nNAME = ")[2] for model in (TIP, seen))
    bare, shown = (text.partition("def positions(")[0] for text in texts)
    told = ("FEET_OF", "CORNERS", "MEMBER", "POSITION_KINDS")
    rows = [
        [line for line in text.splitlines() if not line.startswith(told)] for text in (bare, shown)
    ]
    assert rows[0] == rows[1]
    assert bare != shown


def test_feet_have_places_of_both_sides():
    left, right = feet(
        gap=lambda s: declared.placed((s * H, 0))[1],
        slip=lambda s: declared.placed((s * H, 0))[0],
        law=declared.LAW,
        place=lambda s: (s * H + X, sp.S.One),
    )
    assert (left.point, right.point) == ((X - H, 1), (X + H, 1))
    alone = Contact("tip", sp.S.One, X, declared.LAW)
    assert alone.point == (X, 1)
