"""Feet that are pinned: the structure on them in the coordinates that are left.

Two coordinates of the free structure, such as the place of its base, are eliminated by the foot on
which it stands: its gap is zero, and its slip is where it stood upright. The rest turns about
that foot, and `rockeom.symbolic.rocking.on_pinned_feet` derives its modes.
"""

from collections.abc import Mapping
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.algebra import SIDE, at_side, tidy
from rockeom.symbolic.checks.common import ModelError, naming
from rockeom.symbolic.contacts import ContactDeclaration, Pinned
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import Coordinate, Foot, Point
from rockeom.symbolic.rocking import SIDES, RockingModel, on_pinned_feet

_OR_DERIVE = (
    "; or give feet the law Rigid(restitution=0, friction=None), which never slips and has all "
    "modes derived"
)


class _Closed(NamedTuple):
    """Coordinates that the pinned foot of the side s eliminates.

    coordinates : both that go. left : those that stay. share : of slip and gap by those that go,
    (2, 2), constant. put : positions and velocities of those that go, by their symbols.
    """

    coordinates: tuple[Coordinate, Coordinate]
    left: tuple[Coordinate, ...]
    share: sp.Matrix
    put: Mapping[sp.Symbol, sp.Expr]

    def __call__(self, expr: sp.Expr) -> sp.Expr:
        return sp.sympify(expr).xreplace(self.put)

    def point(self, place: Point) -> Point:
        return tidy(self(place[0])), tidy(self(place[1]))


def reduced(model: ContactDeclaration) -> RockingModel:
    """The rocking structure that a model on a pair of pinned feet is.

    Raises ValueError, naming the item and the remedy, where its contacts are no such pair, and
    where the coordinates that the feet leave do not move them as they must.
    """
    with naming(model.name, _OR_DERIVE):
        _a_pair(model)
        closed = _closed(model)
        places = {c.name: c.at(c.side) for c in model.contacts}
        feet = {name: closed.point((slip, gap)) for name, (gap, slip) in places.items()}
        _stand(model, closed, feet)
        _follow(model, closed)
    rocking = Mode(
        dict(SIDES),
        closed.left,
        tuple(replace(b, position=closed.point(b.position)) for b in model.bodies),
        model.gravity,
        closed(model.elastic_energy),
        closed(model.dissipation),
        {name: Foot(feet[name]) for name in SIDES},
        None if model.load_point is None else closed.point(model.load_point),
        beside_feet=_beside(model, closed),
        elements=tuple(e.changed(closed.__call__) for e in model.springs),
    )
    return on_pinned_feet(
        rocking,
        model.rotation,
        name=model.name,
        title=model.title,
        parameters=model.parameters,
        overturning=model.overturning,
        reference=model.reference,
        members=model.members,
        falls=model.falling_coordinates,
    )


def _a_pair(model: ContactDeclaration) -> None:
    others = [c.name for c in model.contacts if not isinstance(c.law, Pinned)]
    names = ", ".join(c.name for c in model.contacts)
    if others:
        raise ModelError(
            f"of its contacts {names} not all are Pinned(), {', '.join(others)} have another law: "
            "pinned feet are a pair, and stand alone",
        )
    if model.switching:
        raise ModelError(
            f"the element {model.switching[0].name!r} stands next to pinned feet: declare a spring "
            "that never leaves as a Spring",
        )
    beside = [f"the force {f.name!r}" for f in model.forces]
    beside += [f"the internal variable {z.name!r}" for z in model.rates]
    if beside:
        raise ModelError(
            f"{beside[0]} stands next to pinned feet: forces there are those of springs and "
            "dampers, and of `elastic_energy` and `dissipation`",
        )
    if sorted(c.side for c in model.contacts) != [-1, 1]:
        raise ModelError(
            f"its pinned contacts are {names}: two feet, left and right, may be pinned, declared "
            "both by `feet(...)`",
        )
    wrong = [c.name for c in model.contacts if SIDES.get(c.name) != c.side]
    if wrong:
        raise ModelError(f"its pinned feet are called {names}: call them left and right")


def _closed(model: ContactDeclaration) -> _Closed:
    """The first two coordinates that the gap and the slip of a foot fix, wherever it leans."""
    gap, slip = model.contacts[0].at(SIDE)
    positions = {c.position for c in model.coordinates}
    upright = dict.fromkeys(positions, 0)
    heights = {c.name: tidy(c.at(c.side)[0].subs(upright)) for c in model.contacts}
    if any(height != 0 for height in heights.values()):
        found = ", ".join(f"{height} of {name!r}" for name, height in heights.items())
        raise ModelError(
            f"where all coordinates are zero the gaps of its pinned feet are {found}: both must "
            "stand on the ground there, at one height",
        )
    others = [c for c in model.coordinates if c != model.rotation]
    for pair in combinations(others, 2):
        share = sp.Matrix([[tidy(sp.diff(e, c.position)) for c in pair] for e in (slip, gap)])
        if share.free_symbols & {*positions, SIDE} or tidy(share.det()) == 0:
            continue
        away = {c.position: 0 for c in pair}
        lacking = sp.Matrix([slip.subs(upright) - slip.subs(away), -gap.subs(away)])
        places = [tidy(e) for e in share.LUsolve(lacking)]
        left = tuple(c for c in model.coordinates if c not in pair)
        put = {c.position: e for c, e in zip(pair, places, strict=True)}
        put |= {c.velocity: rate(e, left) for c, e in zip(pair, places, strict=True)}
        return _Closed(pair, left, share, put)
    raise ModelError(
        "no two coordinates are fixed by the gap and the slip of a pinned foot: declare the place "
        "of the base by two, in which both are linear, besides the rotation",
    )


def _stand(model: ContactDeclaration, closed: _Closed, feet: Mapping[str, Point]) -> None:
    """Whichever foot is pinned, where the rotation is zero the other is where it stood too."""
    theta = model.rotation.position
    upright = {c.position: 0 for c in model.coordinates}
    left, right = (at_side(feet[foot][0], 1).subs(upright) for foot in ("left", "right"))
    if tidy(right - left).is_nonpositive:
        raise ModelError(
            f"upright its left foot is at {tidy(left)} and the right one at {tidy(right)}: their "
            "slip must be their place along the ground, which grows to the right",
        )
    for c in model.contacts:
        there = (c.at(c.side)[1].subs(upright), sp.S.Zero)
        for item, place, stood in zip(("slip", "gap"), feet[c.name], there, strict=True):
            here = at_side(place, -c.side)
            others = [x for x in closed.left if x != model.rotation]
            moved = [x.name for x in others if here.has(x.position)]
            if moved:
                raise ModelError(
                    f"with the other foot pinned the {item} of the {c.name} one changes with "
                    f"{', '.join(moved)}: under pinned feet the rotation alone may move it",
                )
            if tidy(here.subs(theta, 0) - stood) != 0:
                raise ModelError(
                    f"where {model.rotation.name!r} is zero and the other foot pinned, the {item} "
                    f"of the {c.name} one is {tidy(here.subs(theta, 0))} instead of {stood}: "
                    "measure the rotation from where both feet stand",
                )


def _follow(model: ContactDeclaration, closed: _Closed) -> None:
    """All masses are on the feet: they are carried along where the feet are."""
    for b in model.bodies:
        carried = sp.Matrix(
            [[tidy(sp.diff(e, c.position)) for c in closed.coordinates] for e in b.position]
        )
        given = (b.mass, b.inertia, b.rotation)
        of_place = any(sp.sympify(e).has(c.position) for e in given for c in closed.coordinates)
        if of_place or any(tidy(e) != 0 for e in carried - closed.share):
            names = " and ".join(c.name for c in closed.coordinates)
            raise ModelError(
                f"{names} do not move body {b.name!r} as they move the pinned feet: their ground "
                "is level and carries all masses",
            )


def _beside(model: ContactDeclaration, closed: _Closed) -> Point:
    """Force of the ground where springs and dampers reach it, elsewhere than at the feet."""
    stored, lost = model.free.stored_energy, model.free.dissipation_function
    slopes = [sp.diff(stored, c.position) + sp.diff(lost, c.velocity) for c in closed.coordinates]
    right, up = (tidy(closed(-e)) for e in sp.Matrix(1, 2, slopes) * closed.share.inv())
    return right, up
