"""Equations in the radius R and the angle alpha of each body, as the thesis writes them.

B = R sin(alpha),  H = R cos(alpha)
"""

from dataclasses import replace

import sympy as sp

from rockeom.symbolic.algebra import SIDE, angles_in, square_is, tidy
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import Body, Coordinate, Parameter


def has_polar_form(mode: Mode) -> bool:
    return any(body.polar for body in mode.bodies)


def in_polar_form(mode: Mode) -> Equations:
    """The mode's equations with R and alpha of each body instead of half-width and height.

    Raises ValueError if none of its bodies names its R and alpha.
    """
    if not has_polar_form(mode):
        raise ValueError(
            f"no polar form of mode {', '.join(mode.sides)}: none of its bodies names a "
            'radius and an angle (`polar`); use form="width"'
        )
    equations = polar_mode(mode).equations
    return equations.map(lambda e: compound_angles(e, mode.coordinates))


def polar_mode(mode: Mode) -> Mode:
    """The same mode, its bodies placed by R and alpha."""
    bodies = tuple(_polar_body(body) for body in mode.bodies)
    loaded = [b.position for b in mode.bodies].index(mode.load_point) if mode.load_point else 0
    return replace(mode, bodies=bodies, load_point=mode.load_point and bodies[loaded].position)


def _polar_body(body: Body) -> Body:
    if body.polar is None:
        return body
    half_width, height, radius, alpha = body.polar
    put = {half_width: radius * sp.sin(alpha), height: radius * sp.cos(alpha)}
    x, y = (e.subs(put, simultaneous=True) for e in body.position)
    return replace(body, position=(x, y))


def polar_parameters(model: HybridModel) -> tuple[tuple[Parameter, sp.Expr], ...]:
    """R and alpha of each body, each with its value in half-width and height."""
    found: dict[sp.Symbol, tuple[Parameter, sp.Expr]] = {}
    for body in (b for mode in model.modes for b in mode.bodies):
        if body.polar is None:
            continue
        b, h, radius, alpha = body.polar
        where = f"of the {body.name}'s centroid from the pivot"
        found[radius] = (
            Parameter(radius, str(radius), "m", f"distance {where}"),
            sp.sqrt(b**2 + h**2),
        )
        found[alpha] = (
            Parameter(alpha, str(alpha), "rad", "angle of that line from the vertical"),
            sp.atan(b / h),
        )
    return tuple(found.values())


def polar_model(model: HybridModel) -> HybridModel:
    """The same structure, the bodies of its rocking modes placed by R and alpha."""
    return replace(
        model,
        parameters=(*model.parameters, *(p for p, _ in polar_parameters(model))),
        modes=tuple(polar_mode(mode) for mode in model.modes),
    )


def compound_angles(expr: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
    """Products of sines and cosines of a fixed and a turning angle as sin(alpha - s theta).

    With S and C, sine and cosine of alpha - s theta, sin(alpha) = S cos(theta) + s C sin(theta)
    and cos(alpha) = C cos(theta) - s S sin(theta). Squares give cos(2 alpha). Either is kept only
    where it makes `expr` shorter.
    """
    moving = {c.position for c in coordinates}
    angles = angles_in(expr)
    for fixed in (a for a in angles if not a.free_symbols & moving):
        for turning in (a for a in angles if a.free_symbols & moving):
            both, others = sp.Integer(0), sp.Integer(0)
            for term in sp.Add.make_args(sp.expand(expr)):
                if {fixed, turning} <= set(angles_in(term)):
                    both += term
                else:
                    others += term
            sine, cosine = sp.Dummy("S"), sp.Dummy("C")
            sin, cos = sp.sin(turning), sp.cos(turning)
            put = {
                sp.sin(fixed): sine * cos + SIDE * cosine * sin,
                sp.cos(fixed): cosine * cos - SIDE * sine * sin,
            }
            joint = tidy(both.subs(put))
            if len(sp.Add.make_args(joint)) < len(sp.Add.make_args(both)):
                angle = fixed - SIDE * turning
                expr = others + joint.subs({sine: sp.sin(angle), cosine: sp.cos(angle)})
    for fixed in (a for a in angles if not a.free_symbols & moving):
        double = sp.cos(2 * fixed)
        put = {sp.sin(fixed) ** 2: (1 - double) / 2, sp.cos(fixed) ** 2: (1 + double) / 2}
        doubled = sp.expand(sp.expand(expr).subs(put))
        if len(sp.Add.make_args(doubled)) < len(sp.Add.make_args(sp.expand(expr))):
            expr = doubled
    return square_is(sp.expand(expr), SIDE, sp.Integer(1))
