"""Lagrange's equations of one mode, each physical part under its own name.

    d/dt dT/dq' - dT/dq + dV/dq + dF/dq' = Q        (thesis D-5)

The ground's acceleration enters by d'Alembert forces -m a at each mass (thesis D-16), which is
the same as measuring positions from the moving ground and letting gravity be g plus the vertical
acceleration.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from typing import Protocol

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic.algebra import at_side, slopes, tidy
from rockeom.symbolic.model import GROUND_ACCELERATIONS, Body, Coordinate, shaking
from rockeom.symbolic.text.shown import Shown

TIME = sp.Symbol("t")
"""The time of SymPy's `dynamicsymbols`."""


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


@explained.attributes(
    M="mass_matrix", f="forcing", eom="residual", velocity="velocity_forces",
    gravity="gravity_forces", stiffness="elastic_forces", damping="damping_forces",
    excitation="excitation_forces", force="applied_forces", forces="forcing",
    K='K of model.linearize("both")', C='C of model.linearize("both")', coordinates="q",
    potential_energy="gravitational_energy", qdd="accelerations",
)  # fmt: skip
@dataclass(frozen=True, repr=False)
class Equations(Shown):
    """Equations of motion, forces that resist on the left and forces that act on the right.

        M q'' + velocity + damping + gravity + elastic = excitation + applied   (forces)

    Names and signs of `q`, `u`, `mass_matrix`, `forcing`, `mass_matrix_full`, `forcing_full` and
    `rhs` are those of `sympy.physics.mechanics.LagrangesMethod`.

    Parameters
    ----------
    q : sympy.Matrix
        Coordinates that are free (n, 1).
    u : sympy.Matrix
        Their velocities q' (n, 1).
    accelerations : sympy.Matrix
        Their accelerations q'' (n, 1).
    mass_matrix : sympy.Matrix
        Mass matrix M (n, n).
    velocity_forces : sympy.Matrix
        Terms of the velocities squared, centrifugal and Coriolis (n, 1).
    gravity_forces : sympy.Matrix
        Slopes of the gravitational energy (n, 1).
    elastic_forces : sympy.Matrix
        Slopes of the elastic energy (n, 1).
    damping_forces : sympy.Matrix
        Slopes of Rayleigh's dissipation function (n, 1).
    excitation_forces : sympy.Matrix
        Forces of the ground's acceleration, on the right-hand side (n, 1).
    applied_forces : sympy.Matrix
        Generalised forces that were declared, on the right-hand side (n, 1).
    kinetic_energy : sympy.Expr
        Kinetic energy from which the equations were derived.
    gravitational_energy : sympy.Expr
        Gravitational energy.
    elastic_energy : sympy.Expr
        Elastic energy.

    Examples
    --------
    >>> import rockeom as rk
    >>> equations = rk.derive("rigid_block").equations("right")
    >>> equations.mass_matrix
    Matrix([[B**2*m + H**2*m + I_g]])
    >>> equations.gravity_forces
    Matrix([[B*g*m*cos(theta) - H*g*m*sin(theta)]])
    """

    q: sp.Matrix
    u: sp.Matrix
    accelerations: sp.Matrix
    mass_matrix: sp.Matrix
    velocity_forces: sp.Matrix
    gravity_forces: sp.Matrix
    elastic_forces: sp.Matrix
    damping_forces: sp.Matrix
    excitation_forces: sp.Matrix
    applied_forces: sp.Matrix
    kinetic_energy: sp.Expr
    gravitational_energy: sp.Expr
    elastic_energy: sp.Expr

    @property
    def forcing(self) -> sp.Matrix:
        """The right-hand side f of M q'' = f (n, 1)."""
        forces = self.excitation_forces + self.applied_forces
        forces -= self.velocity_forces + self.gravity_forces
        return forces - self.elastic_forces - self.damping_forces

    @property
    def mass_matrix_full(self) -> sp.Matrix:
        """Matrix of [q', q''] in the equations of first order (2 n, 2 n)."""
        return sp.diag(sp.eye(len(self.q)), self.mass_matrix)

    @property
    def forcing_full(self) -> sp.Matrix:
        """The right-hand side of mass_matrix_full [q', q''] = forcing_full (2 n, 1)."""
        return self.u.col_join(self.forcing)

    def rhs(self) -> sp.Matrix:
        """Rates [q', q''] of the states, solved for (2 n, 1).

        Returns
        -------
        sympy.Matrix
            Rates.
        """
        return self.u.col_join(self.mass_matrix.LUsolve(self.forcing))

    @property
    def residual(self) -> sp.Matrix:
        """Left minus right-hand side, M q'' - f; zero along a motion (n, 1)."""
        return self.mass_matrix * self.accelerations - self.forcing

    def equation_lines(self) -> list[str]:
        """LaTeX of each equation, left and right of the sign of equality as above."""
        inertial = self.mass_matrix * self.accelerations if self.q else self.q
        acting = self.excitation_forces + self.applied_forces
        rows = zip(inertial - self.forcing + acting, acting, strict=True)
        return [f"{sp.latex(left)} = {sp.latex(right)}" for left, right in rows]

    def __repr__(self) -> str:
        return f"<Equations of motion of {', '.join(map(str, self.q)) or 'no coordinate'}>"

    def dynamic(self, t: sp.Symbol = TIME) -> Equations:
        """Same equations in functions of time, as `sympy.physics.mechanics` writes them.

        Parameters
        ----------
        t : sympy.Symbol, optional
            Time; that of `dynamicsymbols` if not given.

        Returns
        -------
        Equations
            Equations in q(t), its derivatives, and the accelerations of the ground such as a_x(t).
        """
        motion = [*self.q, *GROUND_ACCELERATIONS]
        put: dict[sp.Expr, sp.Expr] = {x: sp.Function(str(x))(t) for x in motion}
        for x, *rates in zip(self.q, self.u, self.accelerations, strict=True):
            put |= {rate: put[x].diff(t, order) for order, rate in enumerate(rates, 1)}
        return self.map(lambda expr: expr.xreplace(put))

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

    def map(self, change: Callable[[sp.Expr], sp.Expr]) -> Equations:
        """The same equations with `change` applied to every entry."""
        values = {}
        for f in fields(Equations):
            value = getattr(self, f.name)
            values[f.name] = (
                value.applyfunc(change) if isinstance(value, sp.MatrixBase) else change(value)
            )
        return Equations(**values)


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


def body_velocity(body: Body, coordinates: tuple[Coordinate, ...]) -> sp.Matrix:
    """Velocity of the centroid relative to the ground, and behind it that of the rotation.

    Its last entry is the clockwise rate in the plane; in space the last three are the angular
    velocity along the axes of the body.
    """
    centroid = [rate(e, coordinates) for e in body.position]
    if not isinstance(body.rotation, sp.MatrixBase):
        return sp.Matrix([*centroid, rate(sp.sympify(body.rotation), coordinates)])
    turning = body.rotation.T * body.rotation.applyfunc(lambda e: rate(e, coordinates))
    return sp.Matrix([*centroid, *map(tidy, (turning[2, 1], turning[0, 2], turning[1, 0]))])


def inertia(body: Body) -> sp.Matrix:
    """Matrix of mass and moments of inertia by the entries of `body_velocity`."""
    return sp.diag(*[body.mass] * len(body.position), body.inertia)


def kinetic_energy(mode: Moving) -> sp.Expr:
    total = sp.Integer(0)
    for body in mode.bodies:
        velocity = body_velocity(body, mode.coordinates)
        total += (velocity.T * inertia(body) * velocity)[0] / 2
    return total


def derive_equations(mode: Moving) -> Equations:
    """Lagrange's equations of a mode from the positions, springs and dampers it declares."""
    q = [c.position for c in mode.coordinates]
    qd = [c.velocity for c in mode.coordinates]

    kinetic = tidy(mode.approximated(kinetic_energy(mode)))
    weight = mode.approximated(sum(b.mass * mode.gravity * b.position[-1] for b in mode.bodies))
    ground = shaking(mode.bodies)
    moved = mode.approximated(
        sum(
            b.mass * sum(a * x for a, x in zip(ground, b.position, strict=True))
            for b in mode.bodies
        )
    )
    elastic = mode.approximated(mode.stored_energy)

    def column(entries: Iterable[sp.Expr]) -> sp.Matrix:
        return sp.Matrix(len(q), 1, list(entries))

    def gradient(expr: sp.Expr, by: list[sp.Symbol]) -> sp.Matrix:
        return column(map(tidy, slopes(expr, by)))

    momenta = slopes(kinetic, qd)
    shares = [slopes(p, qd) for p in momenta]
    mass_matrix = sp.Matrix(len(q), len(q), lambda i, j: tidy(shares[i][j]))
    # dp/dt without its acceleration terms, less dT/dq
    rates = list(zip(q, qd, strict=True))
    velocity = column(
        tidy(_along(p, rates) - slope) for p, slope in zip(momenta, slopes(kinetic, q), strict=True)
    )
    return Equations(
        q=column(q),
        u=column(qd),
        accelerations=column(c.acceleration for c in mode.coordinates),
        mass_matrix=mass_matrix,
        velocity_forces=velocity,
        gravity_forces=gradient(weight, q),
        elastic_forces=gradient(elastic, q),
        damping_forces=gradient(mode.dissipation_function, qd),
        excitation_forces=-gradient(moved, q),
        applied_forces=column(mode.forces or [0] * len(q)),
        kinetic_energy=kinetic,
        gravitational_energy=tidy(weight),
        elastic_energy=elastic,
    )
