"""What cannot be meant is refused, by a text that names the item and the remedy."""

from dataclasses import replace

import pytest
import sympy as sp

import rockeom as rk
from rockeom.symbolic import Body, Contact, Model, Rigid, Unilateral, feet, parameter
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.modes.kinematics import sign_of_slip
from tests.contact import declared
from tests.refusals import refused, refuses

B = parameter("b", "half_width", "m", "half of the width")
WIDTH = B.symbol
X, Y, THETA = declared.X, declared.Y, declared.THETA
FEET = feet(
    gap=lambda s: declared.placed((s * WIDTH, 0))[1],
    slip=lambda s: declared.placed((s * WIDTH, 0))[0],
    law=declared.LAW,
)


def block(**changes) -> Model:
    what = {
        "name": "declared_block", "title": "A block", "parameters": (*declared.BLOCK, B),
        "coordinates": (X, Y, THETA), "bodies": (declared.block(),),
        "gravity": declared.GRAVITY.symbol, "rotation": THETA, "contacts": FEET,
    }  # fmt: skip
    return Model(**(what | changes))


def point(name: str, x, y, **more) -> Contact:
    across, up = declared.placed((x, y))
    return Contact(name, **({"gap": up, "slip": across, "law": declared.LAW} | more))


def counterclockwise(x, y):
    theta = THETA.position
    return (
        X.position + x * sp.cos(theta) - y * sp.sin(theta),
        Y.position + x * sp.sin(theta) + y * sp.cos(theta),
    )


LEFT, RIGHT = FEET
ON_LEFT, ON_RIGHT = point("left", -WIDTH, 0), point("right", WIDTH, 0)
SPRING = Unilateral("pad", -Y.position, sp.Symbol("mu", positive=True))

REFUSED = {
    "nothing touches": ({"contacts": ()}, "nothing touches"),
    "no masses": ({"bodies": ()}, "no bodies"),
    "a point declared twice": (
        {"contacts": (ON_LEFT, replace(ON_RIGHT, gap=ON_LEFT.gap))}, "have the same gap",
    ),
    "one name for two points": (
        {"contacts": (ON_LEFT, replace(ON_RIGHT, name="left"))}, "declared twice: left",
    ),
    "a point and an element of one name": (
        {"elements": (replace(SPRING, name="left"),)}, "declared twice",
    ),
    "a gap that nothing changes": (
        {"contacts": (replace(ON_LEFT, gap=WIDTH),)}, "the gap of contact 'left' is b",
    ),
    "a slip that nothing changes": (
        {"contacts": (replace(ON_LEFT, slip=sp.S.Zero),)}, "the slip of contact 'left' is 0",
    ),
    "a gap with a rate": (
        {"contacts": (replace(ON_LEFT, gap=ON_LEFT.gap + Y.velocity),)},
        "gap of contact 'left' contains the velocity",
    ),
    "an unknown symbol": (
        {"contacts": (replace(ON_LEFT, gap=ON_LEFT.gap + sp.Symbol("z")),)},
        "undeclared symbols z",
    ),
    "friction that moves": (
        {"contacts": (replace(ON_LEFT, law=Rigid(friction=Y.position**2)),)},
        "friction of contact 'left' contains the coordinate",
    ),
    "one foot of a mirrored pair": ({"contacts": (LEFT,)}, "no other point is its image"),
    "a side that no pair has": (
        {"contacts": (replace(LEFT, side=0),)}, "declare both by `feet",
    ),
    "a side of its own": (
        {"contacts": (replace(ON_LEFT, side=-1), ON_RIGHT)}, "no other point is its image",
    ),
    "a body that turns against its rotation": (
        {
            "bodies": (replace(
                declared.block(), position=counterclockwise(0, declared.HEIGHT.symbol)
            ),),
            "contacts": tuple(
                Contact(name, counterclockwise(x, 0)[1], counterclockwise(x, 0)[0], declared.LAW)
                for name, x in (("left", -WIDTH), ("right", WIDTH))
            ),
        },
        "and the point does not",
    ),
    "no body that turns": (
        {"bodies": (Body("block", declared.MASS.symbol, (X.position, Y.position)),)},
        "no body turns with the rotation 'theta'",
    ),
    "a rotation that is none": (
        {"rotation": replace(THETA, name="phi")}, "is not in `coordinates`",
    ),
    "a symbol of the derivation": (
        {"parameters": (*declared.BLOCK, replace(B, symbol=sign_of_slip(0)))}, "is reserved for",
    ),
    "the side as a parameter": (
        {"parameters": (*declared.BLOCK, replace(B, symbol=SIDE))}, "is reserved for the side",
    ),
    "a compression that nothing changes": (
        {"elements": (replace(SPRING, compression=WIDTH),)}, "which no coordinate changes",
    ),
    "text for a contact": ({"contacts": ("left", "right")}, "contacts holds 'left'"),
}  # fmt: skip


def test_what_is_changed_here_is_right_otherwise():
    assert block().modes.names == rk.derive("sliding_block").modes.names
    assert block(contacts=[ON_LEFT, ON_RIGHT], elements=[SPRING]).contacts == (ON_LEFT, ON_RIGHT)


@pytest.mark.parametrize("what", REFUSED)
def test_a_declaration_is_refused(what):
    changes, told = REFUSED[what]
    with pytest.raises(ValueError, match=told):
        block(**changes)


def test_three_feet_in_line_are_refused():
    """Statics leaves open what each of them carries."""
    between = point("middle", 0, 0)
    with pytest.raises(ValueError, match="left, right, middle may close at once"):
        _ = block(contacts=(ON_LEFT, ON_RIGHT, between)).modes
    # a little shorter it never touches with both of the others
    shorter = point("middle", 0, WIDTH / 10)
    closed = {
        tuple(map(bool, s.points))
        for s in block(contacts=(ON_LEFT, ON_RIGHT, shorter)).modes.states
    }
    assert {(True, True, False), (True, False, True), (False, False, True)} <= closed
    assert (True, True, True) not in closed


def test_names_that_make_one_another_s_are_refused():
    points = (point("a", -WIDTH, 0), point("b", WIDTH, 0), point("a_b", 0, WIDTH / 10))
    with pytest.raises(ValueError, match="two modes would be called 'a_b'"):
        _ = block(contacts=points).modes
    with pytest.raises(ValueError, match="two modes would be called 'flight'"):
        _ = block(contacts=(replace(ON_LEFT, name="flight"), ON_RIGHT)).modes


def test_a_point_between_two_walls_is_refused():
    """Where friction holds it cannot be told: its slip is given by the gaps."""
    wedge = (
        Contact("floor", Y.position, X.position, declared.LAW),
        Contact("wall", X.position, Y.position, declared.LAW),
    )
    with pytest.raises(ValueError, match="with floor, wall closed statics leaves"):
        _ = block(contacts=wedge).modes


@pytest.mark.parametrize(
    ("law", "told"),
    [
        ({"restitution": 1.5}, "restitution"),
        ({"restitution": -0.1}, "restitution"),
        ({"friction": -0.1}, "friction"),
        ({"friction": "0.1"}, "friction"),
    ],
)
def test_a_law_is_refused(law, told):
    assert refused(Rigid, **law)[0] == told


def test_a_mode_that_is_none_is_refused():
    with refuses("mode", "right_slide_left"):
        rk.derive("sliding_block").mode("right_slide_left")


@pytest.mark.parametrize(
    ("wrong", "told"),
    [({"restitution": 1.2}, "restitution"), ({"friction": -0.1}, "friction"),
     ({"half_width": 0.0}, "half_width")],
)  # fmt: skip
def test_the_values_of_a_declared_structure_are_refused(wrong, told):
    values = {"mass": 1.0, "height": 1.0, "inertia": 0.5, "gravity": 9.81, "friction": 0.3,
              "restitution": 0.0, "half_width": 0.2}  # fmt: skip
    with pytest.raises(ValueError, match=told):
        block().check_values(values | wrong)
