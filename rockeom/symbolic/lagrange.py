"""Lagrange's equations of one mode, each physical part under its own name.

    d/dt dT/dq' - dT/dq + dV/dq + dF/dq' = Q        (thesis D-5)

The ground's acceleration enters by d'Alembert forces -m a at each mass (thesis D-16), which is
the same as measuring positions from the moving ground and letting gravity be g + a_y.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Protocol

import sympy as sp

from rockeom.symbolic.algebra import at_side, slopes, tidy
from rockeom.symbolic.model import GROUND_X, GROUND_Y, Body, Coordinate


class Moving(Protocol):
    """Masses, springs, dampers and forces from which equations of motion follow; see `Mode`."""

    @property
    def coordinates(self) -> tuple[Coordinate, ...]: ...
    @property
    def bodies(self) -> tuple[Body, ...]: ...
    @property
    def gravity(self) -> sp.Expr: ...
    @property
    def forces(self) -> tuple[sp.Expr, ...]: ...
    @property
    def stored_energy(self) -> sp.Expr: ...
    @property
    def dissipation_function(self) -> sp.Expr: ...
    def approximated(self, expr: sp.Expr) -> sp.Expr: ...


@dataclass(frozen=True)
class Equations:
    """Equations M q'' + velocity + gravity + stiffness + damping = excitation + force.

    Parameters
    ----------
    mass_matrix : sympy.Matrix
        Mass matrix M (n, n).
    velocity : sympy.Matrix
        Terms of the velocities squared (n, 1).
    gravity : sympy.Matrix
        Terms of gravity (n, 1).
    stiffness : sympy.Matrix
        Terms of the elastic energy (n, 1).
    damping : sympy.Matrix
        Terms of the dissipation (n, 1).
    excitation : sympy.Matrix
        Terms of the ground's acceleration (n, 1).
    force : sympy.Matrix
        Generalised forces (n, 1).
    kinetic_energy : sympy.Expr
        Kinetic energy from which the equations were derived.
    gravitational_energy : sympy.Expr
        Gravitational energy.
    elastic_energy : sympy.Expr
        Elastic energy.
    """

    mass_matrix: sp.Matrix
    velocity: sp.Matrix
    gravity: sp.Matrix
    stiffness: sp.Matrix
    damping: sp.Matrix
    excitation: sp.Matrix
    force: sp.Matrix
    kinetic_energy: sp.Expr
    gravitational_energy: sp.Expr
    elastic_energy: sp.Expr

    @property
    def forcing(self) -> sp.Matrix:
        """The right-hand side of M q'' = forcing."""
        forces = self.excitation + self.force
        return forces - self.velocity - self.gravity - self.stiffness - self.damping

    def at_side(self, side: int) -> Equations:
        """Same equations, the side s put in as a number.

        Parameters
        ----------
        side : int
            Side, -1 or 1.

        Returns
        -------
        Equations
            Equations.
        """
        return self.map(lambda expr: at_side(expr, side))

    def map(self, change) -> Equations:
        """The same equations with `change` applied to every entry."""
        values = {}
        for f in fields(self):
            value = getattr(self, f.name)
            values[f.name] = (
                value.applyfunc(change) if isinstance(value, sp.MatrixBase) else change(value)
            )
        return Equations(**values)

    def residual(self, coordinates: tuple[Coordinate, ...]) -> sp.Matrix:
        """Left minus right-hand side; zero along a motion.

        Parameters
        ----------
        coordinates : tuple of Coordinate
            Coordinates.

        Returns
        -------
        sympy.Matrix
            Residual (n, 1).
        """
        n = len(coordinates)
        accelerations = sp.Matrix(n, 1, [c.acceleration for c in coordinates])
        return self.mass_matrix * accelerations - self.forcing


def rate(expr: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
    """Time derivative of a function of coordinates and velocities."""
    pairs = [(c.position, c.velocity) for c in coordinates]
    return _along(expr, pairs + [(c.velocity, c.acceleration) for c in coordinates])


def _along(expr: sp.Expr, rates: list[tuple[sp.Symbol, sp.Symbol]]) -> sp.Expr:
    """Rate of an expression, by those of some symbols; of many, few are in each expression."""
    expr = sp.sympify(expr)
    there = expr.free_symbols
    known = {x: x_dot for x, x_dot in rates if x in there}
    found = zip(slopes(expr, known), known.values(), strict=True)
    return sum((slope * x_dot for slope, x_dot in found), sp.Integer(0))


def body_velocity(
    body: Body, coordinates: tuple[Coordinate, ...]
) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """(x', y', angular velocity) of a body relative to the ground."""
    x, y = body.position
    return tuple(rate(e, coordinates) for e in (x, y, sp.sympify(body.rotation)))


def kinetic_energy(mode: Moving) -> sp.Expr:
    total = sp.Integer(0)
    for body in mode.bodies:
        vx, vy, turning = body_velocity(body, mode.coordinates)
        total += body.mass * (vx**2 + vy**2) / 2 + body.inertia * turning**2 / 2
    return total


def derive_equations(mode: Moving) -> Equations:
    """Lagrange's equations of a mode from the positions, springs and dampers it declares."""
    q = [c.position for c in mode.coordinates]
    qd = [c.velocity for c in mode.coordinates]

    kinetic = tidy(mode.approximated(kinetic_energy(mode)))
    weight = mode.approximated(sum(b.mass * mode.gravity * b.position[1] for b in mode.bodies))
    shaking = mode.approximated(
        sum(b.mass * (GROUND_X * b.position[0] + GROUND_Y * b.position[1]) for b in mode.bodies)
    )
    elastic = mode.approximated(mode.stored_energy)

    def gradient(expr: sp.Expr, by) -> sp.Matrix:
        return sp.Matrix([tidy(e) for e in slopes(expr, by)]).reshape(len(by), 1)

    momenta = slopes(kinetic, qd)
    shares = [slopes(p, qd) for p in momenta]
    mass_matrix = sp.Matrix(len(q), len(q), lambda i, j: tidy(shares[i][j]))
    # dp/dt without its acceleration terms, less dT/dq
    rates = list(zip(q, qd, strict=True))
    velocity = sp.Matrix(
        [
            tidy(_along(p, rates) - slope)
            for p, slope in zip(momenta, slopes(kinetic, q), strict=True)
        ]
    ).reshape(len(q), 1)
    return Equations(
        mass_matrix=mass_matrix,
        velocity=velocity,
        gravity=gradient(weight, q),
        stiffness=gradient(elastic, q),
        damping=gradient(mode.dissipation_function, qd),
        excitation=-gradient(shaking, q),
        force=sp.Matrix(mode.forces or [0] * len(q)).reshape(len(q), 1),
        kinetic_energy=kinetic,
        gravitational_energy=tidy(weight),
        elastic_energy=elastic,
    )
