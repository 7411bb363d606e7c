"""The flexible structure of two masses, on any support."""

from __future__ import annotations

from rockeom.structures.shipped.declarations import flexible_structure as declared
from rockeom.structures.supports import SupportedStructure


class FlexibleStructure(SupportedStructure, declared.FlexibleStructure):
    def of_base(self) -> tuple[float, float]:
        inertia = self.inertia + self.base_inertia + self.base_mass * self.base_height**2
        return self.base_mass, inertia
