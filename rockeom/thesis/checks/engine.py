"""The derived counterpart of each equation of the thesis, by its number.

DERIVED[number] names the structure and a function (model, side) -> value, in the engine's
symbols: the value of the thesis's left side where that is a single symbol, the engine's left
minus right side of an equation of motion otherwise.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import sympy as sp

from rockeom.symbolic import RockingModel, derive
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.lagrange import body_velocity, kinetic_energy, rate
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.reactions import total_reaction
from rockeom.symbolic.statics import LOAD, equilibrium, pushover
from rockeom.symbolic.structures.two_spring import bilinear_pushover
from rockeom.thesis import comparison, notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks.check import Checks, Findings, derived, vanishes
from rockeom.thesis.comparison import ALPHA, BLOCK, PIER, SCALED, R, differences, normal_form
from rockeom.thesis.equation import Equation

MODE = {1: "right", -1: "left"}
THETA, THETA_D, THETA_DD = PIER["theta"], PIER["theta_dot"], PIER["theta_ddot"]
G, B = PIER["gravity"], PIER["half_width"]

Value = Any
"""An expression, or a column of them."""


@dataclass(frozen=True)
class Derived:
    """`value(model, side)` for the structure; `symbols(model, side)` gives further ones."""

    structure: str
    value: Callable[[RockingModel, int], Value | list[Value]]
    symbols: Callable[[RockingModel, int], dict] = lambda model, side: {}


@cache
def shipped(name: str) -> RockingModel:
    return derive(name)


def _values(number: str, side: int, model: RockingModel) -> tuple[list[Value], dict]:
    """The engine's values for the relations of an equation, and further symbols."""
    entry = DERIVED[number]
    value = entry.value(model, side)
    rows = value if isinstance(value, list) else [value] * len(EQUATIONS[number].right)
    return rows, entry.symbols(model, side)


@cache
def _values_of_shipped(number: str, side: int) -> tuple[list[Value], dict]:
    return _values(number, side, shipped(DERIVED[number].structure))


def compared(number: str, relations, side: int, model: RockingModel | None = None) -> Findings:
    """Thesis minus engine for each component of each relation."""
    values, symbols = (
        _values_of_shipped(number, side) if model is None else _values(number, side, model)
    )
    what = f"thesis minus engine, theta {'>' if side > 0 else '<'} 0"
    for relation, value in zip(relations, values, strict=True):
        for rest in differences(relation, value, side, symbols):
            yield vanishes(what, rest, normal_form)


# --- motion


def residual(model: RockingModel, side: int, row: int = 0) -> sp.Expr:
    """Left minus right side of an equation of motion; the thesis has no vertical shaking."""
    return model.equations(MODE[side]).residual[row].subs(GROUND_Y, 0)


def acceleration(model: RockingModel, side: int) -> sp.Expr:
    """Forcing over mass of a structure with one coordinate."""
    equations = model.equations(MODE[side])
    return (equations.forcing[0] / equations.mass_matrix[0, 0]).subs(GROUND_Y, 0)


def in_polar(expr: sp.Expr) -> sp.Expr:
    """The block by R and alpha; other structures as they are."""
    put = {BLOCK["half_width"]: R * sp.sin(ALPHA), BLOCK["height"]: R * sp.cos(ALPHA)}
    return expr.subs(put, simultaneous=True) if expr.has(BLOCK["height"]) else expr


def harmonic(expr: sp.Expr, unit) -> sp.Expr:
    """The ground acceleration of 2.5.1, in units in which gravity is `unit`."""
    return expr.subs(GROUND_X, ALPHA * th.beta * unit * sp.cos(th.omega * th.t))


def nondimensional(model: RockingModel, side: int) -> sp.Expr:
    return sp.expand(harmonic(residual(model, side), 1) / (SCALED["radius_ratio"] * ALPHA))


def slender_scaled(model: RockingModel, side: int) -> sp.Expr:
    """The block's moments by 2-10 to 2-12, in units of m g R alpha."""
    inertia, unit = model.equations(MODE[side]).mass_matrix[0, 0], BLOCK["mass"] * G * R
    put = {THETA: ALPHA * SCALED["x"], THETA_DD: ALPHA * SCALED["x_ddot"] * unit / inertia}
    moments = residual(model, side).subs(put, simultaneous=True)
    return harmonic(moments, G) / (unit * ALPHA)


# --- forces of the block


def centroid_acceleration(model: RockingModel, side: int, axis: int) -> sp.Expr:
    mode = model.mode(MODE[side])
    relative = rate(rate(mode.bodies[0].position[axis], mode.coordinates), mode.coordinates)
    return in_polar(relative.subs(SIDE, side)) + (GROUND_X, sp.Integer(0))[axis]


def force(model: RockingModel, side: int, axis: int) -> sp.Expr:
    total = total_reaction(model.mode(MODE[side]))[axis]
    return in_polar(total.subs({SIDE: side, GROUND_Y: 0}))


def rectangular(expr: sp.Expr) -> sp.Expr:
    return expr.subs(BLOCK["inertia"], BLOCK["mass"] * R**2 / 3)


def slender_start(side: int) -> sp.Expr:
    """Angular acceleration of the slender rectangular block at theta = 0, as in 3-10."""
    at_impact = {THETA: 0, GROUND_X: 0}
    return rectangular(acceleration(shipped("slender_block"), side).subs(at_impact))


def force_at_impact(
    model: RockingModel, side: int, axis: int, start: Callable[[int], sp.Expr] = slender_start
) -> sp.Expr:
    """Force next to an impact, with the angular acceleration that the motion starts with."""
    exact = force(model, side, axis).subs({THETA: 0, GROUND_X: 0})
    return exact.subs(THETA_DD, start(side))


def resting_force(model: RockingModel, side: int, axis: int) -> sp.Expr:
    return force_at_impact(model, side, axis).subs(THETA_D, 0)


# --- impact


def impulse(model: RockingModel, side: int):
    return model.impulse_map(MODE[side], MODE[-side])


def energy_ratio(model: RockingModel, side: int) -> sp.Expr:
    assert model.velocity_ratio is not None  # all that rock on rigid ground have one
    return model.velocity_ratio**2


# --- statics of the two springs


def settled(model: RockingModel) -> sp.Expr:
    """Compression of a spring in equilibrium without a load."""
    mode = model.mode("both")
    upright = {c.position: 0 for c in mode.coordinates if c is model.rotation}
    turning, heaving = (row.subs({**upright, LOAD: 0}) for row in equilibrium(mode))
    (heave,) = (c.position for c in mode.coordinates if c is not model.rotation)
    (at,) = sp.solve(heaving, heave)
    foot = mode.feet["right"].position
    assert turning.subs(heave, at) == 0
    return -foot[1].subs({**upright, heave: at})


def foot_force(model: RockingModel, foot: str) -> sp.Expr:
    """Static force of a spring at a rotation with both pressed, the vertical motion condensed."""
    mode = model.mode("both")
    (heave,) = (c for c in mode.coordinates if c is not model.rotation)
    row = [c.name for c in mode.coordinates].index(heave.name)
    (at,) = sp.solve(equilibrium(mode)[row], heave.position)
    still = {c.velocity: 0 for c in mode.coordinates}
    force = mode.feet[foot].force
    assert force is not None
    return force.subs({**still, heave.position: at})


def lift_off_sine(model: RockingModel) -> sp.Expr:
    """sin(theta) at which the left spring's force has fallen to zero."""
    sine = sp.Dummy("sine")
    (at,) = sp.solve(foot_force(model, "left").subs(sp.sin(THETA), sine), sine)
    return at


def first_stiffness(model: RockingModel) -> sp.Expr:
    """dP/dtheta of the exact pushover at the upright position."""
    return sp.diff(pushover(model, "both"), THETA).subs(THETA, 0)


def displacement(model: RockingModel, side: int) -> sp.Expr:
    point = model.mode("both").load_point
    assert point is not None
    return point[0]


def centroid(model: RockingModel, side: int) -> list[sp.Expr]:
    """Height, angle at the pivot and distance from it of the centroid of all bodies."""
    bodies = model.mode("right").bodies
    total = sum(b.mass for b in bodies)
    upright = {SIDE: 1, THETA: 0}
    x, y = (sum(b.mass * b.position[i] for b in bodies) / total for i in (0, 1))
    x, y = (sp.cancel(sp.expand(e).subs(upright)) for e in (x, y))
    return [y, sp.atan((B - x) / y), sp.sqrt((B - x) ** 2 + y**2)]


def falling_branch(model: RockingModel, side: int) -> list[sp.Expr]:
    cart = shipped("two_spring_cart")
    # the sine and the cosine of an arctangent: its root is R_c / H_c
    top = bilinear_pushover().overturning.replace(
        lambda e: e.is_Pow and abs(e.exp) == sp.Rational(1, 2),
        lambda e: (th.R_c / comparison.TO_ENGINE[th.H_c]) ** (2 * e.exp),
    )
    return [top, cart.equations("right").elastic_forces[0]]


def cart_forces(model: RockingModel, side: int) -> dict:
    mass = sum(b.mass for b in model.mode(MODE[side]).bodies)
    return {th.k_u: model.equations(MODE[side]).elastic_forces[0], th.P_t: -mass * GROUND_X}


# --- Model C


def from_pivot(model: RockingModel, side: int, body: int) -> sp.Matrix:
    x, y = model.mode(MODE[side]).bodies[body].position
    return sp.Matrix([x - SIDE * B, y]).subs(SIDE, side)


def velocity(model: RockingModel, side: int, body: int) -> sp.Matrix:
    mode = model.mode(MODE[side])
    moving = body_velocity(mode.bodies[body], mode.coordinates)
    return moving[:2, :].subs(SIDE, side)


def kinetic(model: RockingModel, side: int, *bodies: int) -> sp.Expr:
    """Kinetic energy of some bodies, of all if none is named."""
    mode = model.mode(MODE[side])
    moving = tuple(mode.bodies[i] for i in bodies) or mode.bodies
    return in_polar(kinetic_energy(replace(mode, bodies=moving)).subs(SIDE, side))


def raised(model: RockingModel, side: int, theta: sp.Expr = THETA) -> sp.Expr:
    """Gravitational energy at a rotation, above that of the upright structure."""
    energy = in_polar(model.equations(MODE[side]).gravitational_energy)
    return energy.subs(THETA, theta) - energy.subs(THETA, 0)


def potential(model: RockingModel, side: int) -> sp.Expr:
    equations = model.equations(MODE[side])
    return equations.gravitational_energy + equations.elastic_energy


def lagrangian(model: RockingModel, side: int) -> sp.Expr:
    return model.equations(MODE[side]).kinetic_energy - potential(model, side)


def energies(model: RockingModel, side: int) -> dict:
    return {
        th.T: kinetic(model, side),
        th.T_e: kinetic(model, side, 0),
        th.T_b: kinetic(model, side, 1),
        th.V: potential(model, side),
    }


def excitation(model: RockingModel, side: int) -> sp.Matrix:
    return model.equations(MODE[side]).excitation_forces.subs(GROUND_Y, 0)


def moved(model: RockingModel, side: int) -> sp.Matrix:
    """Displacement of the superstructure from its upright position."""
    now = from_pivot(model, side, 0)
    return now - now.subs({THETA: 0, PIER["u"]: 0})


# --- the first-order form of Model C

STATES = {
    th.y_1: PIER["u"], th.y_2: PIER["u_dot"], th.y_3: THETA, th.y_4: THETA_D,
    th.y_1d: PIER["u_dot"], th.y_2d: PIER["u_ddot"], th.y_3d: THETA_D, th.y_4d: THETA_DD,
}  # fmt: skip


def coefficients(model: RockingModel, side: int) -> dict:
    """f_1 and f_2 of D-29, and the states."""
    inertia = model.equations(MODE[side]).mass_matrix
    return {**STATES, th.f_1: inertia[0, 1], th.f_2: inertia[0, 0]}


def rows(model: RockingModel, side: int) -> list:
    """Values that the rows of D-28 state: rates of u and theta, and residuals of the others."""
    return [PIER["u_dot"], residual(model, side, 1), THETA_D, residual(model, side, 0)]


def _of(structure: str, value, *arguments) -> Derived:
    return Derived(structure, lambda model, side: value(model, side, *arguments))


BLOCK_MODEL, MODEL_A, MODEL_C = "rigid_block", "lumped_mass_structure", "flexible_structure"
SPRINGS = "two_spring_structure"

ROUTES: dict[str, dict[str, Derived]] = {
    "equation of motion by Lagrange's equations": {
        "2-2": Derived(BLOCK_MODEL, lambda m, s: in_polar(residual(m, s)).subs(GROUND_X, 0)),
        "2-3": Derived("slender_block", lambda m, s: residual(m, s).subs(GROUND_X, 0)),
        "2-9": Derived(BLOCK_MODEL, lambda m, s: in_polar(residual(m, s))),
        "2-13": _of("nondimensional_block", nondimensional),
        "2-14": _of("slender_block", slender_scaled),
        "2-17": Derived(
            "slender_block",
            lambda m, s: slender_scaled(m, s).subs(th.beta, 0) - th.F_delta,
            lambda m, s: {th.F_delta: th.F_delta},
        ),
        "5-9 5-10 5-11": _of(MODEL_A, acceleration),
        "5-15": Derived("two_spring_cart", residual, cart_forces),
        "5-34 D-19 D-23 D-25": _of(MODEL_C, residual, 0),
        "5-35 D-20 D-24 D-26": _of(MODEL_C, residual, 1),
        "D-28": Derived(MODEL_C, rows, coefficients),
    },
    "impact by the impulsive form of Lagrange's equations": {
        "2-6": Derived(BLOCK_MODEL, lambda m, s: in_polar(energy_ratio(m, s))),
        "5-12": Derived(MODEL_A, lambda m, s: impulse(m, s).momentum[0]),
        "5-13": Derived(MODEL_A, lambda m, s: impulse(m, s).mass_matrix[0, 0] * THETA_D),
        "5-14": _of(MODEL_A, energy_ratio),
    },
    "positions of the masses, differentiated": {
        "3-6": _of(BLOCK_MODEL, centroid_acceleration, 0),
        "3-7": _of(BLOCK_MODEL, centroid_acceleration, 1),
        "5-18": _of(SPRINGS, displacement),
        "5-30": _of(MODEL_A, centroid),
        "5-37": _of(MODEL_C, moved),
        "D-1 D-21": _of(MODEL_C, from_pivot, 0),
        "D-2 D-22": _of(MODEL_C, from_pivot, 1),
        "D-3": _of(MODEL_C, velocity, 0),
        "D-4": _of(MODEL_C, velocity, 1),
    },
    "force of the ground on the accelerated masses": {
        "3-8": _of(BLOCK_MODEL, force, 0),
        "3-9": _of(BLOCK_MODEL, force, 1),
        "3-10": Derived("slender_block", lambda m, s: slender_start(s)),
        "3-11": _of(BLOCK_MODEL, force_at_impact, 0),
        "3-12": _of(BLOCK_MODEL, force_at_impact, 1),
        "3-14": _of(BLOCK_MODEL, resting_force, 0),
        "3-15": _of(BLOCK_MODEL, resting_force, 1),
    },
    "equilibrium, the vertical motion condensed": {
        "5-16": Derived(SPRINGS, lambda m, s: settled(m)),
        "5-17": Derived(SPRINGS, lambda m, s: m.mode("flight").equations.gravity_forces[1]),
        "5-22": Derived(SPRINGS, lambda m, s: lift_off_sine(m)),
        "5-23": Derived(
            SPRINGS, lambda m, s: displacement(m, s).subs(sp.sin(THETA), lift_off_sine(m))
        ),
        "5-24 5-28": Derived(SPRINGS, lambda m, s: first_stiffness(m) * THETA),
        "5-25 5-27": Derived(
            SPRINGS, lambda m, s: bilinear_pushover().contact_stiffness * PIER["u"]
        ),
        "5-26 5-29": Derived(SPRINGS, lambda m, s: first_stiffness(m) * lift_off_sine(m)),
        "5-31": Derived(MODEL_A, lambda m, s: pushover(m, MODE[s])),
        "5-32": Derived(
            MODEL_A, lambda m, s: pushover(m, "right").subs(THETA, lift_off_sine(shipped(SPRINGS)))
        ),
        "5-33": _of(MODEL_A, falling_branch),
    },
    "energies and generalised forces of the positions": {
        "3-1": _of(BLOCK_MODEL, kinetic),
        "3-2": _of(BLOCK_MODEL, raised),
        "5-3": _of(MODEL_A, raised),
        "5-8": Derived(MODEL_A, lambda m, s: m.equations(MODE[s]).mass_matrix[0, 0]),
        "D-6": Derived(MODEL_C, lagrangian, energies),
        "D-7": Derived(MODEL_C, kinetic, energies),
        "D-8 D-11": _of(MODEL_C, kinetic, 0),
        "D-12": _of(MODEL_C, kinetic, 1),
        "D-13": _of(MODEL_C, potential),
        "D-14": _of(MODEL_C, lagrangian),
        "D-15": Derived(MODEL_C, lambda m, s: m.mode(MODE[s]).dissipation_function),
        "D-16": Derived(MODEL_C, lambda m, s: list(excitation(m, s))),
        "D-17": Derived(MODEL_C, lambda m, s: excitation(m, s)[0]),
        "D-18": Derived(MODEL_C, lambda m, s: excitation(m, s)[1]),
        "D-29": Derived(MODEL_C, lambda m, s: list(coefficients(m, s).values())[-2:], coefficients),
    },
}

DERIVED = {
    number: entry
    for entries in ROUTES.values()
    for numbers, entry in entries.items()
    for number in numbers.split()
}
"""The counterpart of each equation, by its number."""


def _find(equation: Equation, *relations: sp.Eq) -> Findings:
    for side in equation.sides:
        yield from compared(equation.number, relations, side)


CHECKS: Checks = {
    number: derived(f"{route}: {entry.structure}", _find)
    for route, entries in ROUTES.items()
    for numbers, entry in entries.items()
    for number in numbers.split()
}
