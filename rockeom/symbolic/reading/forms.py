"""Equations of motion in the forms of the literature: polar, small, slender, without dimensions."""

from collections.abc import Callable
from dataclasses import replace

import sympy as sp

from rockeom.numbers.checks import InputError, require_word
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import GROUND_X, GROUND_Y, coordinate
from rockeom.symbolic.write.polar import in_polar_form, polar_mode

SCALED = coordinate("x", "x", "-", "rotation over alpha")


def _small_rotation(mode: Mode) -> Equations:
    """Equations of first order in coordinates and velocities, of any alpha and ground motion."""
    states = (x for c in mode.coordinates for x in (c.position, c.velocity))
    return replace(mode, small=tuple(states)).equations


def _slender(mode: Mode) -> Equations:
    """Equations of first order in alpha and the horizontal acceleration, too."""
    angles = tuple(dict.fromkeys(b.polar[3] for b in mode.bodies if b.polar))
    states = (x for c in mode.coordinates for x in (c.position, c.velocity))
    return replace(polar_mode(mode), small=(*states, *angles, GROUND_X)).equations


def _nondimensional(mode: Mode) -> Equations:
    """Equation of a block in x = theta/alpha and p t, the ground's acceleration in units of g.

    Divided by m g R alpha; energies by m g R alpha**2. Source: thesis 2-10 to 2-13.
    """
    bodies = [body for body in mode.bodies if body.polar]
    if len(bodies) != 1 or len(mode.coordinates) != 1 or len(mode.bodies) != 1:
        raise InputError("form", "nondimensional").says(
            "the form without dimensions is that of a block, which has one radius R and one alpha: "
            'take rk.derive(rk.RigidBlock), or another form, such as "small"'
        )
    (body,), (theta,), g = bodies, mode.coordinates, mode.gravity
    assert body.polar is not None
    *_, radius, alpha = body.polar
    moment = body.mass * g * radius
    polar = in_polar_form(mode)
    p = sp.sqrt(moment / polar.mass_matrix[0, 0])
    put = {
        theta.position: alpha * SCALED.position,
        theta.velocity: alpha * p * SCALED.velocity,
        GROUND_X: g * GROUND_X,
        GROUND_Y: g * GROUND_Y,
    }

    def over(divisor: sp.Expr) -> Callable[[sp.Expr], sp.Expr]:
        return lambda e: sp.expand(sp.cancel(e.subs(put, simultaneous=True) / divisor))

    forces = polar.map(over(moment * alpha))
    energies = polar.map(over(moment * alpha**2))
    return replace(
        forces,
        q=sp.Matrix([SCALED.position]),
        u=sp.Matrix([SCALED.velocity]),
        accelerations=sp.Matrix([SCALED.acceleration]),
        mass_matrix=(polar.mass_matrix * alpha * p**2 / (moment * alpha)).applyfunc(sp.cancel),
        kinetic_energy=energies.kinetic_energy,
        gravitational_energy=energies.gravitational_energy,
        elastic_energy=energies.elastic_energy,
    )


FORMS: dict[str, Callable[[Mode], Equations]] = {
    "polar": in_polar_form,
    "small": _small_rotation,
    "slender": _slender,
    "nondimensional": _nondimensional,
}


def in_form(model: HybridModel, name: str, form: str) -> Equations:
    """Equations of a mode in one of `FORMS`, its side and its switches put in."""
    require_word("form", form, ("width", *FORMS))
    mode = model.mode(name)
    return FORMS[form](mode).map(lambda e: mode.put(e, name))
