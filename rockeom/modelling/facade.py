"""`Facade`: a wall that turns about its outer edge and leans on transverse walls."""

from __future__ import annotations

import dataclasses
import functools
from typing import Any, ClassVar

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.parameters import check_contact_law
from rockeom.structures.restraints import Strap, attach, kinds_of, parameters_of


class Facade(StructureWithFields):
    """Facade that turns outwards about its outer edge, and meets transverse walls as it comes back.

    The state is `theta` [rad], positive outwards, to the right. The edge neither slides nor lifts,
    and the transverse walls are a smooth stop at the inner face.

    Parameters
    ----------
    thickness : float
        Thickness [m].
    height : float
        Height of the wall [m].
    mass : float
        Mass [kg].
    restitution : float, optional
        Ratio of the speeds after and before it meets the transverse walls, 0 to 1.
    thrust : float, optional
        Horizontal thrust of a roof or a vault, outwards [N].
    thrust_height : float, optional
        Height at which the thrust acts [m]; the top if not given.
    inertia : float, optional
        Moment of inertia about the centroid [kg m2]; that of a homogeneous rectangle if not given.
    restraint : sequence of Strap, optional
        Ties to the walls behind: to the left of the inner face.
    loads : sequence of Push, optional
        Forces of time.
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For numbers out of their ranges.

    References
    ----------
    AlShawa and others (2019), Earthquake Engineering and Structural Dynamics.

    Examples
    --------
    >>> import rockeom as rk
    >>> tie = rk.Strap(
    ...     at=(-0.3, 5.5), to=(-2.3, 5.5), stiffness=2e7, strength=3e4,
    ...     breaks_at=rk.Break(extension=0.05),
    ... )  # m, m, N/m, N
    >>> wall = rk.Facade(thickness=0.6, height=6.0, mass=7e3, restitution=0.4, restraint=tie)
    >>> wall.states[:1]
    ('theta',)
    """

    model: ClassVar[str] = "facade"
    arguments: ClassVar = {"half_width": "thickness", "centroid_height": "height"}
    may_vanish = frozenset({"restitution", "thrust"})
    may_be_negative = frozenset({"thrust"})
    not_numbers = frozenset({"restraint", "loads"})
    thickness: float
    height: float
    mass: float
    restitution: float = 0.0
    thrust: float = 0.0
    thrust_height: float | None = None
    inertia: float | None = None
    restraint: Any = ()
    loads: Any = ()
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        attach(self, Strap)
        check_contact_law("Facade", self.restitution, "newton")

    @property
    def derivation(self) -> dict[str, Any]:
        return kinds_of(*self.restraint, *self.loads)

    @property
    def full_height(self) -> float:
        """Height of the wall [m]."""
        return self.height

    @property
    def unrestrained(self) -> Facade | None:
        attached = self.restraint or self.loads
        return dataclasses.replace(self, restraint=(), loads=()) if attached else None

    def strapped(self, height: float, stiffness: float) -> Facade:
        """The facade with one tie to the walls behind, and no other restraint.

        Parameters
        ----------
        height : float
            Height of the tie, which is three times as long as the facade is thick [m].
        stiffness : float
            Stiffness [N/m].

        Returns
        -------
        Facade
            Tied facade.
        """
        face = -self.thickness / 2
        tie = Strap(at=(face, height), to=(7 * face, height), stiffness=stiffness)
        return dataclasses.replace(self, restraint=tie)

    def changed(self, wider: float, lower: float) -> tuple[()]:
        """No other facade: neither its thickness nor its height is changed afterwards.

        Parameters
        ----------
        wider, lower : float
            Not used.

        Returns
        -------
        tuple of ()
            None.
        """
        return ()

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module of these ties."""
        return module_of(self.model, **self.derivation)

    def parameters(self) -> dict[str, float]:
        inertia = self.mass * (self.thickness**2 + self.height**2) / 12
        return {
            "mass": self.mass,
            "half_width": self.thickness / 2,
            "centroid_height": self.height / 2,
            "inertia": inertia if self.inertia is None else self.inertia,
            "gravity": self.gravity,
            "restitution": self.restitution,
            "thrust": self.thrust,
            "thrust_height": self.height if self.thrust_height is None else self.thrust_height,
        } | parameters_of(*self.restraint, *self.loads)
