"""Forces of a mode: its equations of motion, and the forces of its contacts."""

from functools import cached_property

import sympy as sp

from rockeom.symbolic.algebra import brief, inverted
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.elements import switch_of
from rockeom.symbolic.modes.kinematics import Kinematics


def free_motion(model: ContactDeclaration) -> tuple[sp.Matrix, sp.Matrix]:
    """(M, f) of M q'' = f without forces of contact; an element acts by its chi."""
    equations = model.free.equations
    forces = equations.forcing
    for i, element in enumerate(model.switching):
        force = force_of(model, i)
        for j, c in enumerate(model.coordinates):
            forces[j] -= force * sp.diff(element.displacement, c.position)
    return equations.mass_matrix, forces


def force_of(model: ContactDeclaration, element: int) -> sp.Expr:
    """The force of an element, by its chi."""
    return model.switching[element].force(switch_of(element), model.coordinates)


class Balance:
    """Masses and forces in the motions that a mode's contacts leave it.

    of : how it may move.
    """

    def __init__(self, of: Kinematics) -> None:
        self.of = of

    @cached_property
    def free(self) -> tuple[sp.Matrix, sp.Matrix]:
        """(M, f) of the free structure with its elements, in this mode's configuration."""
        matrix, forces = free_motion(self.of.model)
        return matrix.applyfunc(self.of.here), forces.applyfunc(self.of.here)

    @cached_property
    def pushes(self) -> sp.Matrix:
        """W: directions of the forces of contact, normals first, (n, constraints)."""
        columns = [
            (row - self.of.friction(i) * self.of.sigma(i) * self.of.slip_rows[i]).T
            for i, row in self.of.normal_rows.items()
        ]
        columns += [self.of.slip_rows[g[0]].T for g in self.of.sticking]
        return sp.Matrix.hstack(*columns) if columns else sp.zeros(self.of.n, 0)

    @cached_property
    def balances(self) -> sp.Matrix:
        """L with L^T W = 0, (n, m); T where nothing slips."""
        if not self.of.slipping:
            return self.of.motions
        rows = sp.zeros(self.of.n, len(self.of.independent))
        inverse = inverted(self.pushes[self.of.dependent, :])
        for j, i in enumerate(self.of.independent):
            rows[i, j] = 1
            row = -self.pushes[i, :] * inverse
            for k, d in enumerate(self.of.dependent):
                rows[d, j] = brief(row[k])
        return rows

    @cached_property
    def mass_matrix(self) -> sp.Matrix:
        """L^T M T, (m, m)."""
        return (self.balances.T * self.free[0] * self.of.motions).applyfunc(brief)

    @cached_property
    def forcing(self) -> sp.Matrix:
        """L^T (f - M tau), (m, 1)."""
        matrix, forces = self.free
        return (self.balances.T * (forces - matrix * self.of.drift)).applyfunc(brief)

    @property
    def symmetric(self) -> bool:
        """Whether the mass matrix is symmetric: no friction enters it."""
        return not self.of.slipping or not self.of.independent

    @cached_property
    def forces(self) -> tuple[dict[int, sp.Expr], dict[int, sp.Expr]]:
        """(normal force of each closed point, friction of each group by its first point).

        They contain the accelerations of all coordinates. The friction is that of all points of
        the group together, positive to the right.
        """
        if not self.of.closed:
            return {}, {}
        matrix, forces = self.free
        lacking = matrix * sp.Matrix([self._acceleration(i) for i in range(self.of.n)]) - forces
        here = sp.Matrix([lacking[d] for d in self.of.dependent])
        solved = (inverted(self.pushes[self.of.dependent, :]) * here).applyfunc(brief)
        normal = dict(zip(self.of.closed, solved, strict=False))
        friction = {g[0]: solved[len(self.of.closed) + k] for k, g in enumerate(self.of.sticking)}
        for group in self.of.sticking:
            normal = self._at_their_heights(group, normal, friction[group[0]])
        for group in self.of.slipping:
            total = sum(self.of.friction(i) * normal[i] for i in group)
            friction[group[0]] = brief(-self.of.sigma(group[0]) * total)
        return normal, friction

    def _at_their_heights(
        self, group: tuple[int, ...], normal: dict[int, sp.Expr], friction: sp.Expr
    ) -> dict[int, sp.Expr]:
        """Normal forces where friction acts at each point of a group, not at the first alone.

        Statics determines only the sum of the friction. All points mobilise the same fraction of
        their normal forces, as they do when they slip: F_i = kappa N_i.
        """
        first = self.of.slip_rows[group[0]]
        apart = {i: (self.of.slip_rows[i] - first).applyfunc(brief) for i in group}
        if all(self.of.same(e) for row in apart.values() for e in row):
            return normal
        rows = sp.Matrix.vstack(*self.of.normal_rows.values())
        columns = self.of.eliminated(rows)
        inverse = inverted(rows[:, columns])
        shares = {
            i: dict(zip(self.of.closed, (row[:, columns] * inverse).applyfunc(brief), strict=True))
            for i, row in apart.items()
        }
        alike = len({self.of.model.contacts[i].law.friction for i in group}) == 1
        lacking = [sum((c[j] for j in group), sp.S.Zero) for c in shares.values()]
        # what would press on points that slip would change the motion, too
        lacking += [c[j] for c in shares.values() for j in self.of.closed if self.of.sigma(j) != 0]
        if not alike or not all(map(self.of.same, lacking)):
            model = self.of.model
            names = ", ".join(model.contacts[i].name for i in group)
            raise ValueError(
                f"{model.name}: how {names} share their friction follows neither from statics nor "
                "from one coefficient of friction at level points: give them one coefficient, "
                "or one height, or springs"
            )
        kappa = friction / sum(normal[i] for i in group)
        matrix = sp.Matrix(
            len(group), len(group),
            lambda j, i: (1 if i == j else 0) + kappa * shares[group[i]][group[j]],
        )  # fmt: skip
        solved = inverted(matrix) * sp.Matrix([normal[j] for j in group])
        inside = dict(zip(group, solved, strict=True))
        outside = {
            j: normal[j] - kappa * sum(shares[i][j] * inside[i] for i in group)
            for j in self.of.closed
            if j not in group
        }
        return {j: inside[j] if j in group else outside[j] for j in self.of.closed}

    def _acceleration(self, coordinate: int) -> sp.Expr:
        """Its symbol, or zero where nothing can move it."""
        held = coordinate in self.of.dependent and self.of.drift[coordinate] == 0
        if held and all(e == 0 for e in self.of.motions[coordinate, :]):
            return sp.S.Zero
        return self.of.qdd[coordinate]
