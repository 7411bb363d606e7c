"""Supports of a base: its motions, and the forces on it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from inspect import signature
from typing import Any

import sympy as sp

from rockeom.numbers.checks import InputTypeError, require, require_word
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.contact_model import Model
from rockeom.symbolic.contacts import Rigid, feet
from rockeom.symbolic.elements import Spring, Unilateral
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Foot, Parameter, coordinate, parameter, turned
from rockeom.symbolic.parts.restraints import attachments
from rockeom.symbolic.parts.superstructures import (
    GRAVITY,
    HALF_WIDTH,
    ROTATION,
    Place,
    Point,
    Superstructure,
)
from rockeom.symbolic.rocking import RockingModel, rocking_structure

FOUNDATION_STIFFNESS = parameter("k_f", "foundation_stiffness", "N/m", "stiffness of each spring")
FOUNDATION_DAMPING = parameter("c_f", "foundation_damping", "N s/m", "damping of each spring")
FREE_ROTATION = replace(ROTATION, meaning="rotation, positive clockwise")
HEAVE = coordinate("v", "heave", "m", "rise of the base's centre above its settled position")
X = coordinate("x", "x", "m", "place of the base's centre, positive to the right")
Y = coordinate("y", "y", "m", "height of the base's centre above the ground")
FRICTION = Parameter(
    sp.Symbol("mu", nonnegative=True), "friction", "-", "coefficient of friction at each foot"
)
RESTITUTION = Parameter(
    sp.Symbol("e_n", nonnegative=True),
    "restitution",
    "-",
    "ratio of the rates of a gap after and before an impact",
)


def pinned(
    of: Superstructure,
    title: str = "",
    reference: str = "",
    sources: Mapping[str, str] | None = None,
) -> RockingModel:
    """A model on feet that may lift, and neither slide nor bounce."""
    theta = ROTATION.position
    return rocking_structure(
        name=of.name,
        title=title or f"{of.title} on rigid ground",
        parameters=of.parameters,
        coordinates=(ROTATION, *of.coordinates),
        bodies=lambda pivot: of.bodies(lambda point: turned(point, pivot, theta), theta),
        half_width=HALF_WIDTH.symbol,
        gravity=GRAVITY.symbol,
        elastic_energy=of.elastic_energy,
        dissipation=of.dissipation,
        reference=reference,
        sources=sources or {},
        members=of.members,
        elements=of.elements,
    )


def two_springs(of: Superstructure, guided: str = "centre") -> Model | RockingModel:
    """A model on a spring and a damper under each foot, which press and never pull.

    guided : what moves up and down alone, the base's "centre", or the "foot" to whose side it
    leans.
    """
    require_word("guided", guided, ("centre", "foot"), of.name)
    if guided == "foot":
        return _guided_at_the_foot(of)
    return replace(
        winkler(of, 2), name=f"{of.name}_on_two_springs", title=f"{of.title} on two springs"
    )


def winkler(of: Superstructure, springs: int) -> Model:
    """A model on a bed of equal springs and dampers, equally far apart, which press and never pull.

    The outer two stand at the feet, and the base's centre is guided vertically.
    """
    valid.counts(of.name, springs=springs)
    require(springs >= 2, of.name, "springs", springs, "give two or more")
    theta, place = ROTATION.position, moved((sp.S.Zero, level(of, springs)))
    last = springs - 1
    names = ["left", *(f"spring_{i}" for i in range(2, springs)), "right"]
    places = [HALF_WIDTH.symbol * sp.Rational(2 * i - last, last) for i in range(springs)]
    bodies = of.about_the_middle(place, theta)
    return Model(
        name=f"{of.name}_on_{springs}_springs",
        title=f"{of.title} on a bed of {springs} springs",
        parameters=(*of.parameters, FOUNDATION_STIFFNESS, FOUNDATION_DAMPING),
        coordinates=(ROTATION, HEAVE, *of.coordinates),
        bodies=bodies,
        gravity=GRAVITY.symbol,
        rotation=ROTATION,
        elements=tuple(
            Unilateral(
                name, -place((x, sp.S.Zero))[1],
                FOUNDATION_STIFFNESS.symbol, FOUNDATION_DAMPING.symbol, place((x, sp.S.Zero)),
            )
            for name, x in zip(names, places, strict=True)
        )
        + of.elements,
        elastic_energy=of.elastic_energy,
        dissipation=of.dissipation,
        load_point=bodies[0].position,
        members=of.members,
    )  # fmt: skip


def sliding(
    of: Superstructure, law: str = "newton", attached: Sequence[tuple[str, str, bool, str]] = ()
) -> Model:
    """A model on feet that open, stick, slip and bounce on rigid ground.

    law : as of `Rigid`. attached : kinds of its ties and pushes.
    """
    place = moved((X.position, Y.position))
    ties = attachments(attached, place, lambda point: point)
    bodies = of.about_the_middle(place, ROTATION.position)
    return Model(
        name=f"sliding_{of.name}",
        title=f"{of.title} on feet that slide",
        parameters=(*of.parameters, FRICTION, RESTITUTION, *ties.parameters),
        coordinates=(X, Y, FREE_ROTATION, *of.coordinates),
        bodies=bodies,
        gravity=GRAVITY.symbol,
        rotation=FREE_ROTATION,
        contacts=feet(
            gap=lambda s: place((s * HALF_WIDTH.symbol, sp.S.Zero))[1],
            slip=lambda s: place((s * HALF_WIDTH.symbol, sp.S.Zero))[0],
            law=Rigid(restitution=RESTITUTION.symbol, friction=FRICTION.symbol, law=law),
        ),
        elements=of.elements + ties.elements,
        elastic_energy=of.elastic_energy,
        dissipation=of.dissipation,
        load_point=bodies[0].position,
        members=of.members,
    )


SUPPORTS: Mapping[str, Callable[..., Model | RockingModel]] = {
    "pinned": lambda of: pinned(of),
    "two_springs": two_springs,
    "winkler": winkler,
    "sliding": sliding,
}


def standing(of: Superstructure, support: str, **details: Any) -> Model | RockingModel:
    """A superstructure on a support by its name, the details those of the support's function."""
    require_word("support", support, SUPPORTS, of.name)
    try:
        signature(SUPPORTS[support]).bind(of, **details)
    except TypeError as error:
        names = [*signature(SUPPORTS[support]).parameters][1:]
        takes = ", ".join(f"{n}=" for n in names) or "nothing"
        raise InputTypeError("support", support, of.name).says(
            f"on the support {support!r} {error}: besides its own arguments it takes {takes}"
        ) from None
    return SUPPORTS[support](of, **details)


def moved(centre: Point) -> Place:
    """Places of points of the base when it has turned and its centre has moved."""

    def place(point: Point) -> Point:
        x, y = turned(point, (sp.S.Zero, sp.S.Zero), ROTATION.position)
        return x + centre[0], y + centre[1]

    return place


def level(of: Superstructure, springs: int) -> sp.Expr:
    """Height of the base's centre above the tops of the unloaded springs."""
    return HEAVE.position - of.weight / (springs * FOUNDATION_STIFFNESS.symbol)


def foot_springs(
    compressions: Mapping[str, sp.Expr], pressed: Iterable[sp.Expr], mirrored: bool = True
) -> tuple[Spring, ...]:
    """A spring and a damper under each foot, which act where their compression is in `pressed`.

    compressions : by foot; where `mirrored`, those of the side s = 1, written with s.
    """
    k, c = FOUNDATION_STIFFNESS.symbol, FOUNDATION_DAMPING.symbol
    down = [*pressed]
    return tuple(
        Spring(
            foot, d, k if d in down else sp.S.Zero, c if d in down else sp.S.Zero,
            mirrored={"left": "right", "right": "left"}[foot] if mirrored else "",
        )
        for foot, d in compressions.items()
    )  # fmt: skip


def pressing(compression: sp.Expr, of: Superstructure) -> sp.Expr:
    """Force of the spring and the damper under a foot."""
    k, c = FOUNDATION_STIFFNESS.symbol, FOUNDATION_DAMPING.symbol
    return k * compression + c * rate(compression, (ROTATION, HEAVE, *of.coordinates))


def ways(down: str, up: str, compression: sp.Expr, of: Superstructure) -> tuple[Transition, ...]:
    """Transitions between two modes, in one of which a spring presses.

    It does where the compression and the force are positive: k d > 0 and k d + c d' > 0.
    """
    force = pressing(compression, of)
    lands = sp.Max(-FOUNDATION_STIFFNESS.symbol * compression, -force)
    return Transition(down, up, "switch", force), Transition(up, down, "switch", lands)


def sprung(
    of: Superstructure,
    place: Place,
    sides: dict[str, int],
    forces: Mapping[str, sp.Expr],
    springs: tuple[Spring, ...],
) -> Mode:
    """A mode on springs under the feet. forces : of those that press, by foot."""
    bodies = of.about_the_middle(place, ROTATION.position)
    return Mode(
        sides,
        (ROTATION, HEAVE, *of.coordinates),
        bodies,
        GRAVITY.symbol,
        of.elastic_energy,
        of.dissipation,
        feet={
            foot: Foot(
                place((s * HALF_WIDTH.symbol, sp.S.Zero)), forces.get(foot, sp.S.Zero), sprung=True
            )
            for foot, s in FEET.items()
        },
        load_point=bodies[0].position,
        elements=(*of.elements, *springs),
    )


def _guided_at_the_foot(of: Superstructure) -> RockingModel:
    """Two springs, and the foot to whose side the base leans moves up and down alone.

    Where the base comes upright the guide changes its foot: no velocity jumps there.
    """
    theta, b = ROTATION.position, HALF_WIDTH.symbol
    place = moved((SIDE * b * (1 - sp.cos(theta)), level(of, 2)))
    # under the foot on the side to which it leans, and under the other
    near, far = (-place((s * b, sp.S.Zero))[1] for s in (SIDE, -SIDE))

    def mode(sides: dict[str, int], *pressed: sp.Expr) -> Mode:
        inside, leaning = (pressing(e, of) if e in pressed else sp.S.Zero for e in (near, far))
        forces = {
            foot: inside * (1 + s * SIDE) / 2 + leaning * (1 - s * SIDE) / 2
            for foot, s in FEET.items()
        }
        springs = foot_springs({"right": near, "left": far}, pressed)
        return sprung(of, place, sides, forces, springs)

    def transitions(foot: str, other: str, side: int) -> list[Transition]:
        both, none, raised = f"both_{foot}", f"flight_{foot}", f"{other}_leaning_{foot}"
        inside, leaning = (at_side(e, side) for e in (near, far))
        upright = {
            both: f"both_{other}",
            foot: f"{foot}_leaning_{other}",
            none: f"flight_{other}",
            raised: other,
        }
        return [
            *ways(both, foot, leaning, of),
            *ways(both, raised, inside, of),
            *ways(foot, none, inside, of),
            *ways(raised, none, leaning, of),
            *(Transition(a, z, "switch", side * theta) for a, z in upright.items()),
        ]

    return RockingModel(
        name=f"{of.name}_on_two_foot_guided_springs",
        title=f"{of.title} on two springs, guided at the foot",
        parameters=(*of.parameters, FOUNDATION_STIFFNESS, FOUNDATION_DAMPING),
        coordinates=(ROTATION, HEAVE, *of.coordinates),
        modes=(
            mode({"both_left": -1, "both_right": 1}, near, far),
            mode({"left": -1, "right": 1}, near),
            mode({"right_leaning_left": -1, "left_leaning_right": 1}, far),
            mode({"flight_left": -1, "flight_right": 1}),
        ),
        transitions=(*transitions("left", "right", -1), *transitions("right", "left", 1)),
        rotation=ROTATION,
        members=of.members,
    )


FEET = {"left": -1, "right": 1}
