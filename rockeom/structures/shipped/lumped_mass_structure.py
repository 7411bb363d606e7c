"""The rigid structure of two lumped masses, on any support."""

from rockeom.structures.shipped.declarations import lumped_mass_structure as declared
from rockeom.structures.supports import HeldStructure


class LumpedMassStructure(HeldStructure, declared.LumpedMassStructure):
    def of_base(self) -> tuple[float, float]:
        inertia = self.inertia + self.base_inertia + self.base_mass * self.base_height**2
        return self.base_mass + self.mass, inertia + self.mass * self.height**2
