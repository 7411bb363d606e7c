"""The flexible structure of two masses, on any support."""

import math
from typing import Any, Self

from rockeom.numbers.checks import InputError
from rockeom.structures.parameters import check_values
from rockeom.structures.shipped.declarations import flexible_structure as declared
from rockeom.structures.supports import HeldStructure


class FlexibleStructure(HeldStructure, declared.FlexibleStructure):
    @classmethod
    def from_period(
        cls, period: float, damping_ratio: float, *, mass: float, **others: Any
    ) -> Self:
        """Structure whose column has a period and a damping ratio on a fixed base.

        Parameters
        ----------
        period : float
            Period T with the base held [s].
        damping_ratio : float
            Part zeta of critical damping, such as 0.05, with the base held.
        mass : float
            Mass m of the superstructure [kg].
        **others : float
            Other parameters of the class, by name.

        Returns
        -------
        FlexibleStructure
            Structure with k = m (2 pi/T)^2 and c = 2 zeta m 2 pi/T.

        Raises
        ------
        ValueError
            For a damping ratio of one or more, which may be meant in percent.

        Notes
        -----
        From the section of a column: ``analysis.formulas.cantilever_stiffness(E, I, L)`` is k, and
        T = 2 pi sqrt(m/k).

        Examples
        --------
        >>> import rockeom as rk
        >>> pier = rk.FlexibleStructure.from_period(
        ...     0.5, damping_ratio=0.05, mass=200e3, height=10.0, inertia=0.0, base_mass=80e3,
        ...     base_height=0.5, base_inertia=60e3, half_width=2.5,
        ... )
        >>> pier.fixed_base().periods  # s
        array([0.5...])
        """
        name = f"{cls.__name__}.from_period"
        values = {"period": period, "damping_ratio": damping_ratio, "mass": mass}
        check_values(name, values, frozenset({"damping_ratio"}))
        if damping_ratio >= 1:
            raise InputError("damping_ratio", damping_ratio, name).give(
                "a part of critical damping, such as 0.05 for 5 %"
            )
        omega = 2 * math.pi / period
        return cls(
            mass=mass, stiffness=mass * omega**2, damping=2 * damping_ratio * mass * omega, **others
        )

    def of_base(self) -> tuple[float, float]:
        inertia = self.inertia + self.base_inertia + self.base_mass * self.base_height**2
        return self.base_mass, inertia
