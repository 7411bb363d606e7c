"""Controlled rocking walls: their parameters, their tendon, and their equilibrium."""

from collections.abc import Mapping

import numpy as np

from rockeom.numbers.checks import InputError, InputTypeError, number
from rockeom.numbers.dual import value_of
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.declared_modes import margin
from rockeom.structures.shipped.tendoned_wall import Wall


def of_wall(what: str, wall: Wall) -> dict[str, float]:
    """The parameters that all classes of walls share, of a wall with one tendon."""
    if not isinstance(wall, Wall):
        raise InputTypeError("wall", wall).give("a wall, such as rockeom.analysis.Wall.thesis()")
    if len(wall.tendons) != 1:
        raise InputError("wall", wall).says(
            f"{what} has one tendon, the wall has {len(wall.tendons)}: for several derive a model, "
            "rockeom.symbolic.controlled_wall"
        )
    (tendon,) = wall.tendons
    return wall.parameters_with(tendon)


class RockingWall(StructureWithFields):
    """A wall whose tendon is elastic, yields, or is slack."""

    def __post_init__(self) -> None:
        what, values = type(self).__name__, self.parameters()
        for name, most in (("initial_force", "yield_force"), ("edge_distance", "half_width")):
            if not values[name] < values[most]:
                raise InputError(name, values[name], what).hold(
                    f"it must be below {most}, {values[most]}"
                )

    @property
    def speed_height(self) -> float:
        """Height of the point whose speed impact laws mean [m]."""
        return self.parameters()["height"]

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """State vector of named values; beyond yield on the way back the tendon has been drawn out.

        Parameters
        ----------
        values : dict of str to float
            Values of states by name; others are zero. A permanent_extension that is not named is
            then the one that leaves the yield force.

        Returns
        -------
        ndarray
            State (N,).

        Raises
        ------
        ValueError
            For unknown names, NaN, and a state that no rotation has.
        """
        y = super().state(values)
        self.check_reach(y)
        if "permanent_extension" in values:
            return y
        y = y.astype(np.result_type(y, self.vector))
        m, parameters = self.module, self.parameters()
        side = "left" if (y[m.ROTATION] or y[m.ROTATION_RATE]) < 0 else "right"
        beyond = self._elastic_force(side, y) - parameters["yield_force"]
        if beyond > 0.0:
            yielding = m.MODES.index(f"{side}_yield")
            if margin(m, value_of(self.vector), yielding, y) < 0.0:
                extension = beyond / parameters["tendon_stiffness"]
                y[m.STATES.index("permanent_extension")] = extension
        return y

    def check_reach(self, y: np.ndarray) -> None:
        """Check that a rotation has a state.

        Parameters
        ----------
        y : ndarray
            State (N,).

        Raises
        ------
        ValueError
            For a state that no rotation has.
        """

    def _elastic_force(self, side: str, y: np.ndarray) -> float:
        """Force of the tendon [N], if it neither yields nor is slack."""
        m = self.module_for(y, self.vector)
        forces = np.empty(len(m.REACTIONS), np.result_type(y, self.vector))
        m.reactions(m.MODES.index(side), y, self.vector, 0.0, 0.0, forces)
        return number("tendon_force", forces[m.REACTIONS.index("tendon_force")])

    def pushover(self, rotations) -> np.ndarray:
        """Force at the load point that holds the wall at each rotation, or displacement.

        Parameters
        ----------
        rotations : array_like
            Values of the model's first state, any shape. Each is reached from upright by a growing
            rotation: a tendon that yields has its yield force.

        Returns
        -------
        ndarray
            Force [N], in the shape of the rotations.

        Raises
        ------
        ValueError
            Where there is no equilibrium.
        """
        return super().pushover(rotations)

    def equilibrium(self, rotation: float) -> tuple[float, np.ndarray]:
        m = self.module
        y = np.zeros(m.N_STATES)
        y[m.ROTATION] = rotation
        side = "left" if rotation < 0 else "right"
        elastic, yield_force = self._elastic_force(side, y), self.parameters()["yield_force"]
        mode = "_yield" if elastic > yield_force else "_slack" if elastic < 0 else ""
        return self.load(m.MODES.index(side + mode), y), y

    def load(self, mode: int, y: np.ndarray) -> float:
        """Force with which the rotation of a state is in equilibrium.

        Parameters
        ----------
        mode : int
            Number of the mode.
        y : ndarray
            State (N,).

        Returns
        -------
        float
            Force at the load point [N].
        """
        row = self.module.ROTATION
        none = self.lacking(mode, y, 0.0)[row]
        load = 1.0 + abs(none)  # the digits of one newton might be lost next to the other forces
        return float(load * (none / (none - self.lacking(mode, y, load)[row])))

    def lacking(self, mode: int, y: np.ndarray, load: float) -> np.ndarray:
        """Force that each coordinate lacks of equilibrium under a load.

        Parameters
        ----------
        mode : int
            Number of the mode.
        y : ndarray
            State (N,).
        load : float
            Force at the load point [N].

        Returns
        -------
        ndarray
            Forces (n,) [N].
        """
        out = np.empty(len(y) // 2)
        self.module.statics(mode, y, self.vector, load, out)
        return out
