"""Rigid lumped-mass structure on two compression-only springs (thesis Model B, 5.3.2)."""

from dataclasses import dataclass
from functools import cache, partial

import sympy as sp

from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Body, Definition, Member, coordinate, rectangle
from rockeom.symbolic.parts.superstructures import (
    BASE_MASS,
    GRAVITY,
    HALF_WIDTH,
    HEIGHT,
    MASS,
    MAY_VANISH,
    ROTATION,
    rigid,
)
from rockeom.symbolic.parts.supports import (
    FEET,
    FOUNDATION_DAMPING,
    FOUNDATION_STIFFNESS,
    HEAVE,
    foot_springs,
    level,
    moved,
    pressing,
    sprung,
    ways,
)
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel
from rockeom.symbolic.statics import holding_force
from rockeom.symbolic.structures.lumped_mass import lumped_mass_structure


@shipped(place=6, may_vanish=MAY_VANISH)
def two_spring_structure() -> RockingModel:
    """The exact dynamics: rotation and heave, the centre of the base guided vertically.

    Each foot presses on a spring and a damper that cannot pull: the force is
    k_f delta + c_f delta' while both the compression delta and that sum are positive. `heave`
    counts from the settled position. The elastic energy is that of the springs that press: a
    damped foot lifts off a spring that is still compressed.
    """
    of, b = rigid(), HALF_WIDTH.symbol
    place = moved((sp.S.Zero, level(of, 2)))  # settled as in thesis 5-16
    edge = -place((SIDE * b, sp.S.Zero))[1]  # compression under the edge of side s
    compression = {foot: at_side(edge, side) for foot, side in FEET.items()}
    forces = {foot: at_side(pressing(edge, of), side) for foot, side in FEET.items()}
    inside = {foot: pressing(edge, of) * (1 + side * SIDE) / 2 for foot, side in FEET.items()}
    near_and_far = {"right": edge, "left": edge.subs(SIDE, -SIDE)}

    mode = partial(sprung, of, place)

    return RockingModel(
        name="two_spring_structure",
        title="Rigid lumped-mass structure on two compression-only springs (Model B)",
        parameters=(*of.parameters, FOUNDATION_STIFFNESS, FOUNDATION_DAMPING),
        coordinates=(ROTATION, HEAVE),
        modes=(
            mode({"both": 0}, forces, foot_springs(compression, compression.values(), False)),
            mode(dict(FEET), inside, foot_springs(near_and_far, [edge])),
            mode({"flight": 0}, {}, foot_springs(compression, (), False)),
        ),
        transitions=(
            *ways("both", "right", compression["left"], of),
            *ways("both", "left", compression["right"], of),
            *ways("left", "flight", compression["left"], of),
            *ways("right", "flight", compression["right"], of),
        ),
        rotation=ROTATION,
        members=of.members,
        reference="thesis 5.3.2, derived exactly instead of 5-15",
    )


@dataclass(frozen=True)
class BilinearPushover:
    """Force against displacement, linear until a foot lifts and linear from there to overturning.

    contact_stiffness : thesis 5-25, the tangent of the exact curve [N/m]
    lift_off : displacement at which a foot lifts, thesis 5-23 [m]
    lift_off_force : force on fixed pivots at that rotation, thesis 5-32 [N]
    overturning : displacement at which the force has fallen to zero, see 5-33 [m]
    """

    contact_stiffness: sp.Expr
    lift_off: sp.Expr
    lift_off_force: sp.Expr
    overturning: sp.Expr


@cache
def bilinear_pushover() -> BilinearPushover:
    """The thesis's closed form k(u), from the exact statics of springs and of fixed pivots."""
    springs, pivots = two_spring_structure(), lumped_mass_structure()
    theta, v = ROTATION.position, HEAVE.position
    at_rest = {theta: 0, v: 0, ROTATION.velocity: 0, HEAVE.velocity: 0}
    lever = HEIGHT.symbol  # u = H_e theta for small rotations
    left = sp.sympify(springs.mode("both").feet["left"].force)
    lift_off_rotation = sp.factor(-left.subs(at_rest) / sp.diff(left, theta).subs(at_rest))
    on_pivot = sp.factor(holding_force(pivots, "right"))
    cosine, sine = (sp.expand(sp.numer(on_pivot)).coeff(f(theta)) for f in (sp.cos, sp.sin))
    upright = sp.atan(sp.cancel(-cosine / sine))  # centroid above the pivot
    x = at_side(pivots.mode("right").bodies[0].position[0], 1)  # of the superstructure
    return BilinearPushover(
        contact_stiffness=sp.cancel(
            sp.diff(holding_force(springs, "both"), theta).subs(theta, 0) / lever
        ),
        lift_off=lift_off_rotation * lever,
        lift_off_force=on_pivot.subs(theta, lift_off_rotation),
        overturning=(x - x.subs(theta, 0)).subs(theta, upright),
    )


@shipped(place=7, may_vanish=MAY_VANISH)
def two_spring_cart() -> RockingModel:
    """The thesis's equivalent cart 5-15: one displacement u and the closed form k(u).

    Each passage through u = 0 is an impact with the restitution of the structure on fixed
    pivots (5-14).
    """
    u = coordinate("u", "u", "m", "horizontal displacement of the superstructure")
    x = u.position
    curve = bilinear_pushover()
    stiffness = _constant(
        "k_0",
        "contact_stiffness",
        "N/m",
        "stiffness with both feet down, 5-25",
        curve.contact_stiffness,
    )
    lift_off = _constant("u_l", "lift_off", "m", "displacement at lift-off, 5-23", curve.lift_off)
    force = _constant(
        "P_l", "lift_off_force", "N", "force on fixed pivots there, 5-32", curve.lift_off_force
    )
    top = _constant("u_o", "top", "m", "displacement of zero force, 5-33", curve.overturning)
    k0, ul, pl, uo = (d.symbol for d in (stiffness, lift_off, force, top))
    beyond = SIDE * x - ul
    lifted = k0 * ul**2 / 2 + pl * beyond - pl / (uo - ul) * beyond**2 / 2
    b, mass = HALF_WIDTH.symbol, MASS.symbol + BASE_MASS.symbol
    cart = Body("cart", mass, (x, sp.Integer(0)), outline=rectangle(b, 0, b))

    def mode(contacts: dict[str, int], energy: sp.Expr) -> Mode:
        return Mode(contacts, (u,), (cart,), GRAVITY.symbol, energy, load_point=cart.position)

    def lifts(side: int, pressed: str, lifted: str) -> tuple[Transition, Transition]:
        inside = ul - side * x
        return (
            Transition(pressed, lifted, "switch", inside),
            Transition(lifted, pressed, "switch", -inside),
        )

    return RockingModel(
        name="two_spring_cart",
        title="Equivalent cart of the structure on two springs (Model B as printed)",
        parameters=(*rigid().parameters, FOUNDATION_STIFFNESS),
        coordinates=(u,),
        modes=(
            mode({"both_left": -1, "both_right": 1}, k0 * x**2 / 2),
            mode({"left": -1, "right": 1}, lifted),
        ),
        transitions=(
            Transition("both_left", "both_right", "impact", -x),
            Transition("both_right", "both_left", "impact", x),
            *lifts(-1, "both_left", "left"),
            *lifts(1, "both_right", "right"),
        ),
        rotation=u,
        members=(Member("spring", "ground", "cart", (-3 * b, b / 2), (-b, b / 2)),),
        overturning=HALF_WIDTH.symbol + HEIGHT.symbol,
        definitions=(stiffness, lift_off, force, top),
        rigid_velocity_ratio=lumped_mass_structure().velocity_ratio,
        reference="thesis 5-15, 5-25, 5-33",
        sources={"u": "thesis 5-15"},
    )


def _constant(symbol: str, name: str, unit: str, meaning: str, value: sp.Expr) -> Definition:
    return Definition(sp.Symbol(symbol, positive=True), name, unit, meaning, value)
