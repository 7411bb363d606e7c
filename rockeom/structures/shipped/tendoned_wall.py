"""A wall that rocks on its base with tendons (thesis chapter 4, appendix B).

The wall is rigid. Its displacement D [m] is that of a point of the centreline at the height H, and
positive to the right; the rotation theta is clockwise, D = H sin(theta) (4-33). The rotation centre
is the point of the base whose vertical displacement is zero. It lies at the distance b(D) from the
centreline, towards the pressed edge, so that the base has lifted over the length d with
d cos(theta) = B + b (4-7). A position along the base is measured from the centreline and is
positive to the right.

The force of a pushover, the forces of the tendons and the energies are those of the derived wall
`rockeom.ControlledWallOscillator`, by the same functions as in a simulation. This file has the
thesis's forms of quantities that are not derived there: the path of the rotation centre that is
fitted to tests (4-7), the uplifts of a base (the oscillator has no feet), the variable inertia
(B-9; the oscillator has a constant mass), a single tendon, and the formulas of design.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import not_negative, numbers, positive, require
from rockeom.numbers.functions import gauss_rule
from rockeom.numbers.quadrature import integral
from rockeom.structures.base import generated_module
from rockeom.structures.evaluation import at_states

# --- the rotation centre and the tendon


@dataclass(frozen=True)
class RotationCentre:
    """Path of the rotation centre, out from the centreline; thesis 4-7 and 4-8.

    Parameters
    ----------
    C1 : float
        Largest distance from the centreline [m].
    C2 : float
        Distance inside the edge when rocking is developed [m]; may be zero.
    epsilon : float
        Displacement over which the centre moves out [m].

    Raises
    ------
    ValueError
        For a C1 or an epsilon that is not positive, and a negative C2.

    Notes
    -----
    The distance from the centreline is ``b(D) = C1 (1 - exp(-(D/epsilon)**2))``: on the centreline
    at rest, and C2 inside the edge when rocking is developed, so that the half-width of the base is
    B = C1 + C2.
    """

    C1: float
    C2: float
    epsilon: float

    def __post_init__(self) -> None:
        positive("RotationCentre", C1=self.C1, epsilon=self.epsilon)
        not_negative("RotationCentre", C2=self.C2)

    @classmethod
    def thesis_gauge(cls) -> Self:
        """Wall of 4-7 as printed, and used ever after: fitted to distances from the gauge.

        Returns
        -------
        RotationCentre
            Path of the rotation centre.
        """
        return cls(C1=0.412, C2=0.096, epsilon=3.551e-3)

    @classmethod
    def thesis_edge(cls) -> Self:
        """Wall of 4-7 referred to the edge of the wall, 30 mm inside the gauge.

        Returns
        -------
        RotationCentre
            Path of the rotation centre.
        """
        return cls(C1=0.442, C2=0.066, epsilon=3.551e-3)

    @property
    def half_width(self) -> float:
        """B of the base [m]."""
        return self.C1 + self.C2

    def distance(self, displacement: ArrayLike) -> np.ndarray:
        """Distance b from the centreline to the rotation centre.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Distance [m], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that is not finite.
        """
        (size,) = numbers("RotationCentre.distance", displacement=displacement)
        return -self.C1 * np.expm1(-((size / self.epsilon) ** 2))

    def distance_from_edge(self, displacement: ArrayLike) -> np.ndarray:
        """Distance B - b from the pressed edge to the rotation centre; the right side of 4-7.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Distance [m], in the shape of the displacement.
        """
        return self.half_width - self.distance(displacement)

    def slope(self, displacement: ArrayLike) -> np.ndarray:
        """Derivative db/dD of the distance.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Derivative, in the shape of the displacement.
        """
        (size,) = numbers("RotationCentre.slope", displacement=displacement)
        ratio = size / self.epsilon
        return 2 * self.C1 / self.epsilon * ratio * np.exp(-(ratio**2))


class TendonPath(NamedTuple):
    """Force of a tendon along a path of extensions.

    Parameters
    ----------
    force : ndarray
        Force (n,) [N].
    permanent_extension : ndarray
        Extension that yield has added (n,) [m].
    """

    force: np.ndarray
    permanent_extension: np.ndarray


@dataclass(frozen=True)
class Tendon:
    """Unbonded tendon, elastic up to its yield force; thesis B.3.

    Extensions are counted from the initial state, in which the force is P0.

    Parameters
    ----------
    stiffness : float
        Stiffness k = E A/L_T, L_T the unstressed length [N/m].
    initial_force : float
        Initial force P0 [N].
    yield_force : float
        Yield force F_y [N].
    eccentricity : float, optional
        Place along the base, from the centreline, positive to the right [m].

    Raises
    ------
    ValueError
        For numbers that are not positive, and an initial force that is not below the yield force.
    """

    stiffness: float
    initial_force: float
    yield_force: float
    eccentricity: float = 0.0

    def __post_init__(self) -> None:
        positive("Tendon", stiffness=self.stiffness, yield_force=self.yield_force)
        not_negative("Tendon", initial_force=self.initial_force)
        numbers("Tendon", eccentricity=self.eccentricity)
        force, rule = self.initial_force, "it must be below yield_force"
        require(force < self.yield_force, "Tendon", "initial_force", force, rule)

    @classmethod
    def thesis(cls, initial_force: float = 75.6e3) -> Self:
        """Tendon of thesis chapter 4.

        Parameters
        ----------
        initial_force : float, optional
            Initial force [N]; 111 kN is its other one (4.9.2).

        Returns
        -------
        Tendon
            Tendon.
        """
        modulus, area = 205e9, 176.7e-6
        return cls((modulus * area + 75.6e3) / 3.1, initial_force, 900e6 * area)

    @property
    def initial_extension(self) -> float:
        """x1, from the unstressed to the initial state [m]; thesis B-11."""
        return self.initial_force / self.stiffness

    @property
    def initial_energy(self) -> float:
        """P0**2/(2 k), stored in the initial state [J]: the 244.05 J of B-12."""
        return self.initial_force**2 / (2 * self.stiffness)

    @property
    def yield_extension(self) -> float:
        """Extension from the unstressed state to yield [m]."""
        return self.yield_force / self.stiffness

    def force(self, extension: ArrayLike) -> np.ndarray:
        """Force while the extension grows or the tendon has not yielded; thesis 4-16.

        Parameters
        ----------
        extension : array_like
            Extension [m], any shape.

        Returns
        -------
        ndarray
            Force [N], in the shape of the extension. It is not below zero, where the tendon is
            slack, nor above F_y.
        """
        (extension,) = numbers("Tendon.force", extension=extension)
        elastic = self.initial_force + self.stiffness * extension
        return np.clip(elastic, 0.0, self.yield_force)

    def energy(self, extension: ArrayLike) -> np.ndarray:
        """Work done on the tendon since the initial state; thesis 4-20, B-12, B-13.

        Parameters
        ----------
        extension : array_like
            Extension [m], any shape.

        Returns
        -------
        ndarray
            Work [J], in the shape of the extension: up to yield ``(P**2 - P0**2)/(2 k)``; after it
            ``F_y extension - (F_y - P0)**2/(2 k)``, part of which is lost.
        """
        (extension,) = numbers("Tendon.energy", extension=extension)
        force, k = self.force(extension), self.stiffness
        elastic = np.clip(extension, -self.initial_extension, self._reserve)
        work = elastic * (self.initial_force + k * elastic / 2)
        return work + force * (extension - elastic)

    def energy_at_force(self, force: ArrayLike) -> np.ndarray:
        """Work done on the tendon, from a measured force before yield, ``(P**2 - P0**2)/(2 k)``;
        B-12.

        Parameters
        ----------
        force : array_like
            Force P [N], any shape.

        Returns
        -------
        ndarray
            Work [J], in the shape of the force.

        Raises
        ------
        ValueError
            For a force below zero or above the yield force.
        """
        (force,) = not_negative("Tendon.energy_at_force", force=force)
        rule = "above yield_force the force does not determine the energy: use `energy`"
        require(force <= self.yield_force, "Tendon.energy_at_force", "force", force, rule)
        return (force - self.initial_force) * (force + self.initial_force) / (2 * self.stiffness)

    def along(self, extension: ArrayLike) -> TendonPath:
        """Forces along a path that may turn back after yield, elastic and perfectly plastic.

        Parameters
        ----------
        extension : array_like
            Extensions in the order in which they happen (n,) [m].

        Returns
        -------
        TendonPath
            Forces and permanent extensions (n,). Unloading is elastic; the extension by yield
            stays, and the tendon is slack where that exceeds the elastic extension.
        """
        (extension,) = numbers("Tendon.along", extension=extension)
        permanent = np.maximum.accumulate(np.maximum(extension - self._reserve, 0.0))
        return TendonPath(self.force(extension - permanent), permanent)

    @property
    def _reserve(self) -> float:
        """Extension from the initial state to yield [m]."""
        return (self.yield_force - self.initial_force) / self.stiffness


# --- the wall


class DissipationLimit(NamedTuple):
    """Place on the way back to upright at which a wall begins to lose energy.

    Parameters
    ----------
    displacement : ndarray
        Displacement D [m].
    speed : ndarray
        Speed dD/dt there [m/s].
    """

    displacement: np.ndarray
    speed: np.ndarray


@dataclass(frozen=True)
class Wall:
    """Rocking wall with tendons; thesis Figures 4-4, 4-19 and 4-22.

    Displacements [m] have any shape, which the result has too; one that reaches H is a ValueError.
    Loading is monotonic: a tendon that yields follows F_y and is not unloaded (see `Tendon.along`).

    Parameters
    ----------
    rotation_centre : RotationCentre
        Path of the rotation centre; its half_width is that of the wall.
    tendons : tuple of Tendon
        Tendons, may be empty.
    height : float
        Height H of the point whose displacement is D [m].
    centroid_height : float
        Height H_c of the centroid [m].
    panel_mass : float
        Mass of the panel [kg].
    added_mass : float
        Mass at the top [kg].
    added_height : float
        Height of the mass at the top [m].
    own_inertia : float
        Moment of inertia of the mass at the top about its own centroid [kg m2]. These four are the
        terms of B-9.
    fixed_base_period : float, optional
        Period on a fixed base [s], for 4-17 alone.
    gravity : float, optional
        Acceleration of gravity [m/s2].
    p_delta : bool, optional
        Whether the centroid's descent H_c (1 - cos(theta)) counts in the energy of gravity. 4-18
        leaves it out; at 30 mm it is 3.3 J out of 102 J.
    inertia : float, optional
        Moment of inertia I_o [kg m2], a constant in place of B-9.

    Raises
    ------
    ValueError
        For numbers that are not positive.

    Examples
    --------
    >>> from rockeom import analysis
    >>> wall = analysis.Wall.thesis()
    >>> round(float(wall.restoring_force(0.03)))  # N, at 30 mm
    26171
    """

    rotation_centre: RotationCentre
    tendons: tuple[Tendon, ...]
    height: float
    centroid_height: float
    panel_mass: float
    added_mass: float
    added_height: float
    own_inertia: float
    fixed_base_period: float = 0.0
    gravity: float = STANDARD_GRAVITY
    p_delta: bool = False
    inertia: float | None = None

    def __post_init__(self) -> None:
        positive(
            "Wall",
            height=self.height,
            centroid_height=self.centroid_height,
            panel_mass=self.panel_mass,
            gravity=self.gravity,
        )
        not_negative(
            "Wall",
            added_mass=self.added_mass,
            added_height=self.added_height,
            own_inertia=self.own_inertia,
            fixed_base_period=self.fixed_base_period,
        )
        if self.inertia is not None:
            positive("Wall", inertia=self.inertia)
        object.__setattr__(self, "tendons", tuple(self.tendons))  # which can be looked up

    @classmethod
    def thesis(cls, initial_force: float = 75.6e3) -> Self:
        """Wall of thesis chapter 4.

        Parameters
        ----------
        initial_force : float, optional
            Initial force of its tendon, 75.6 kN or 111 kN [N].

        Returns
        -------
        Wall
            Wall.
        """
        return cls(
            rotation_centre=RotationCentre.thesis_gauge(),
            tendons=(Tendon.thesis(initial_force),),
            height=2.438,
            centroid_height=2.173,
            panel_mass=577.56,
            added_mass=1438.5,
            added_height=2.537,
            own_inertia=686.0 + 442.0,
            fixed_base_period=0.0428,
        )

    def parameters_with(self, tendon: Tendon) -> dict[str, float]:
        """Parameters that all derived walls with one tendon share.

        Parameters
        ----------
        tendon : Tendon
            The tendon.

        Returns
        -------
        dict of str to float
            Parameters by name.
        """
        return {
            "mass": self.mass,
            "height": self.height,
            "half_width": self.half_width,
            "edge_distance": self.rotation_centre.C2,
            "transition": self.rotation_centre.epsilon,
            "tendon_stiffness": tendon.stiffness,
            "initial_force": tendon.initial_force,
            "yield_force": tendon.yield_force,
            "eccentricity": tendon.eccentricity,
            "gravity": self.gravity,
        }

    # - masses

    @property
    def mass(self) -> float:
        """m of wall and added mass [kg]."""
        return self.panel_mass + self.added_mass

    @property
    def half_width(self) -> float:
        """B of the base [m]."""
        return self.rotation_centre.half_width

    def moment_of_inertia(self, detached_length: ArrayLike) -> np.ndarray:
        """Moment of inertia I_o about the rotation centre; thesis B-9, put right, or the constant
        `inertia`.

        Parameters
        ----------
        detached_length : array_like
            Detached length d of the base [m], any shape; 2 B for the inertia about the corner.

        Returns
        -------
        ndarray
            Moment of inertia [kg m2], in the shape of the length.

        Raises
        ------
        ValueError
            For a negative length.

        Notes
        -----
        The added mass stands at the distance d - B from the centre. B-9 prints d there, which
        denies its 3 % of change of I_o.
        """
        (d,) = not_negative("Wall.moment_of_inertia", detached_length=detached_length)
        if self.inertia is not None:
            return np.full_like(d, self.inertia)
        panel = self.panel_mass / 3 * (self.height**2 + d**2)
        added = self.added_mass * (self.added_height**2 + (d - self.half_width) ** 2)
        return self.own_inertia + panel + added

    @property
    def corner_inertia(self) -> float:
        """I_o about a corner of the base [kg m2]."""
        return float(self.moment_of_inertia(2 * self.half_width))

    @property
    def corner_radius(self) -> float:
        """R, from a corner of the base to the centroid [m]."""
        return float(np.hypot(self.half_width, self.centroid_height))

    # - geometry

    def rotation(self, displacement: ArrayLike) -> np.ndarray:
        """Rotation theta = asin(D/H); thesis 4-33.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Rotation [rad], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        return np.arcsin(self._sine("Wall.rotation", displacement))

    def detached_length(self, displacement: ArrayLike) -> np.ndarray:
        """Length d from the lifted edge to the rotation centre, along the base; thesis 4-7.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Length [m], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        q = self._sine("Wall.detached_length", displacement)
        return self.half_width + self._lever(displacement, q)

    def uplift(self, displacement: ArrayLike, position: float | None = None) -> np.ndarray:
        """Upward displacement of a point of the base; thesis 4-6, 4-9, B-1 to B-3.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.
        position : float, optional
            Place of the point along the base, from the centreline, positive to the right [m]; the
            lifted edge if not given, where the uplift is ``d sin|theta|``.

        Returns
        -------
        ndarray
            Uplift [m], in the shape of the displacement; negative beyond the rotation centre.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        q = self._sine("Wall.uplift", displacement)
        if position is None:
            return self.detached_length(displacement) * np.abs(q)
        (at,) = numbers("Wall.uplift", position=position)
        return self._lever(displacement, q) * np.abs(q) - at * q

    def tendon_extension(self, displacement: ArrayLike, tendon: int = 0) -> np.ndarray:
        """Extension since the initial state, the uplift at the tendon over cos(theta); thesis 4-15.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.
        tendon : int, optional
            Number of the tendon, from 0 on.

        Returns
        -------
        ndarray
            Extension [m], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.

        Notes
        -----
        The tendon in its duct would grow by 2 (d - B) sin(theta/2), less by 6e-5 of it at 30 mm.
        """
        self._sine("Wall.tendon_extension", displacement)
        return _Held(self, self.tendons[tendon], displacement).extension

    def tendon_force(self, displacement: ArrayLike, tendon: int = 0) -> np.ndarray:
        """Force of one of the tendons; thesis 4-16.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.
        tendon : int, optional
            Number of the tendon, from 0 on.

        Returns
        -------
        ndarray
            Force [N], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        self._sine("Wall.tendon_force", displacement)
        return _Held(self, self.tendons[tendon], displacement).tendon_force

    def yield_displacement(self, tendon: int = 0) -> float:
        """Displacement D > 0 at which one of the tendons yields.

        Parameters
        ----------
        tendon : int, optional
            Number of the tendon, from 0 on.

        Returns
        -------
        float
            Displacement [m].

        Raises
        ------
        ValueError
            Where none below H/2 does.
        """
        from scipy.optimize import brentq  # takes long to import

        goal = self.tendons[tendon].yield_extension - self.tendons[tendon].initial_extension

        def missing(displacement: float) -> float:
            return float(self.tendon_extension(displacement, tendon)) - goal

        far = self.height / 2
        if missing(far) < 0:
            raise ValueError(
                f"Wall.yield_displacement: tendon {tendon} does not yield below {far} m, H/2"
            )
        return float(brentq(missing, 0.0, far, xtol=1e-14, rtol=1e-14))

    # - energies and the force of a pushover

    def gravity_energy(self, displacement: ArrayLike) -> np.ndarray:
        """Energy U of gravity, the weight times the centroid's rise; thesis 4-18, B-4; see
        `p_delta`.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Energy [J], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        q = self._sine("Wall.gravity_energy", displacement)
        energy = _Held(self, None, displacement).energy
        # the term that 4-18 leaves out is missing in the derived energy too
        if self.p_delta:
            energy = energy - self._descending_weight * q**2 / (1 + np.sqrt(1 - q**2))
        return energy

    def elastic_energy(self, displacement: ArrayLike) -> np.ndarray:
        """Energy U_E, the work done on all tendons since the initial state; thesis 4-20.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Energy [J], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        q = self._sine("Wall.elastic_energy", displacement)
        bare = _Held(self, None, displacement).energy
        work = np.zeros(np.shape(q))
        for tendon in self.tendons:
            held = _Held(self, tendon, displacement)
            work = work + (held.energy - bare - tendon.initial_energy) + held.work_of_yielding
        return work

    def potential_energy(self, displacement: ArrayLike) -> np.ndarray:
        """Energy U + U_E; thesis 4-21.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Energy [J], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        return self.gravity_energy(displacement) + self.elastic_energy(displacement)

    def kinetic_energy(self, displacement: ArrayLike, velocity: ArrayLike) -> np.ndarray:
        """Kinetic energy ``I_o v**2/(2 H**2)``; thesis 4-19, B-8.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m].
        velocity : array_like
            Velocity v = dD/dt [m/s].

        Returns
        -------
        ndarray
            Energy [J], in the shape of both arguments, broadcast.

        Raises
        ------
        ValueError
            For a displacement that reaches H.

        Notes
        -----
        I_o is that about the rotation centre at D, and ``cos(theta)**2`` is 1.
        """
        (velocity,) = numbers("Wall.kinetic_energy", velocity=velocity)
        return self._mass_at(displacement) * velocity**2 / 2

    def restoring_force(self, displacement: ArrayLike) -> np.ndarray:
        """Horizontal force F_k at the height H that holds the wall at D; thesis 4-29, 4-30.

        Parameters
        ----------
        displacement : array_like
            Displacement D [m], any shape.

        Returns
        -------
        ndarray
            Force [N], in the shape of the displacement: the exact derivative of U + U_E. Zero at D
            = 0 for tendons on the centreline.

        Raises
        ------
        ValueError
            For a displacement that reaches H.
        """
        q = self._sine("Wall.restoring_force", displacement)
        first, *others = self.tendons or (None,)
        force = _Held(self, first, displacement).force
        if others:  # the weight counts once
            bare = _Held(self, None, displacement).force
            force = force + sum(_Held(self, t, displacement).force - bare for t in others)
        if self.p_delta:
            force = force - self._descending_weight * q / (self.height * np.sqrt(1 - q**2))
        return force

    def uplift_acceleration(self) -> float:
        """Ground acceleration that starts rocking about a corner, statically; thesis 4.8.2.

        Returns
        -------
        float
            Acceleration [m/s2].

        Notes
        -----
        (m g + P0) B/(m H_c), each tendon with its own lever arm, towards the weaker side: the 11.1
        m/s2 of 4.8.2. A wall that rocks about its centreline at first resists no force.
        """
        # of a wall on fixed corners, which the walls that are derived with such tendons are not
        weight, b = self.mass * self.gravity, self.half_width
        moments = (
            weight * b + sum(t.initial_force * (b - side * t.eccentricity) for t in self.tendons)
            for side in (-1, 1)
        )
        return min(moments) / (self.mass * self.centroid_height)

    # - free motion from rest, without losses

    def phase_trajectory(
        self, initial_displacement: ArrayLike, displacement: ArrayLike
    ) -> np.ndarray:
        """Velocity dD/dt on the way from rest to upright and beyond; thesis 4-23.

        Parameters
        ----------
        initial_displacement : array_like
            Displacement D0 at rest [m].
        displacement : array_like
            Displacement D [m].

        Returns
        -------
        ndarray
            Velocity [m/s], in the shape of both arguments, broadcast. Its sign is that of the
            motion away from D0.

        Raises
        ------
        ValueError
            For a displacement that the energy at D0 does not reach.

        Notes
        -----
        I_o is that at D.
        """
        where = "Wall.phase_trajectory"
        initial, now = numbers(
            where, initial_displacement=initial_displacement, displacement=displacement
        )
        spare = self.potential_energy(initial) - self.potential_energy(now)
        rule = "the wall does not come there from rest at initial_displacement"
        require(spare >= 0, where, "displacement", now, rule)
        return -np.sign(initial) * np.sqrt(2 * spare / self._mass_at(now))

    def time_along_trajectory(
        self, initial_displacement: ArrayLike, displacement: ArrayLike
    ) -> np.ndarray:
        """Time from rest at D0 to D, without losses; thesis 4-24.

        Parameters
        ----------
        initial_displacement : array_like
            Displacement D0 at rest, not zero [m].
        displacement : array_like
            Displacement D [m].

        Returns
        -------
        ndarray
            Time [s], accurate to 1e-10 of it, in the shape of both arguments, broadcast.

        Raises
        ------
        ValueError
            For a displacement beyond upright, D/D0 < 0, and for one beyond D0.

        Notes
        -----
        With D = D0 cos(phi) the integrand D0 sin(phi)/v is smooth at the release.
        """
        where = "Wall.time_along_trajectory"
        initial, now = numbers(
            where, initial_displacement=initial_displacement, displacement=displacement
        )
        require(initial != 0, where, "initial_displacement", initial, "a wall at rest stays")
        ratio = now / initial
        rule = "give one between initial_displacement and 0"
        require((ratio >= 0) & (ratio <= 1), where, "displacement", now, rule)
        self._sine(where, initial)

        near = self.rotation_centre.epsilon / 4
        nodes, weights = gauss_rule(16)

        def time(d0: float, angle: float) -> float:
            def integrand(phi: np.ndarray) -> np.ndarray:
                d, way = d0 * np.cos(phi), 2 * d0 * np.sin(phi / 2) ** 2
                spare = self.potential_energy(d0) - self.potential_energy(d)
                # Next to the release the difference of energies is lost in rounding; there the
                # force hardly changes, and its mean over the way gives the work.
                beside = np.abs(way) < near
                points = d[beside, None] + way[beside, None] * (1 + nodes) / 2
                forces = self.restoring_force(points)
                spare[beside] = way[beside] * (forces * weights).sum(axis=-1) / 2
                return abs(d0) * np.sin(phi) / np.sqrt(2 * spare / self._mass_at(d))

            return integral(integrand, 0.0, angle, tolerance=1e-10) if angle else 0.0

        angle = 2 * np.arcsin(np.sqrt((1 - ratio) / 2))  # arccos, but exact next to the release
        return np.vectorize(time, otypes=[float])(initial, angle)

    def quarter_period_exact(self, displacement: ArrayLike) -> np.ndarray:
        """Time from rest at a displacement to upright, without losses; thesis 4-24.

        Parameters
        ----------
        displacement : array_like
            Displacement, not zero [m], any shape.

        Returns
        -------
        ndarray
            Time [s], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a displacement of zero, or one that reaches H.
        """
        (displacement,) = numbers("Wall.quarter_period_exact", displacement=displacement)
        return self.time_along_trajectory(displacement, np.zeros_like(displacement))

    def quarter_period_substitute_gravity(self, displacement: ArrayLike) -> np.ndarray:
        """Quarter period from a peak D, the tendon's force counted as weight; thesis 4-17.

        Parameters
        ----------
        displacement : array_like
            Peak D [m], any shape.

        Returns
        -------
        ndarray
            Quarter period [s], in the shape of the displacement.

        Raises
        ------
        ValueError
            For a peak of zero, or one that reaches H.

        Notes
        -----
        ``sqrt(I_o/(R (m g + P(D)))) acosh(1/(1 - |D|/(d cos(theta)))) + T_fixed/4``, with I_o and R
        about the corner.
        """
        where = "Wall.quarter_period_substitute_gravity"
        (size,) = numbers(where, displacement=np.abs(displacement))
        self._sine(where, size)
        load = self.mass * self.gravity * np.ones_like(size)
        for index in range(len(self.tendons)):
            load = load + self.tendon_force(displacement, index)
        reach = self.half_width + self.rotation_centre.distance(size)
        rule = "4-17 ends where the displacement is the length of base that has lifted"
        require(size < reach, where, "displacement", size, rule)
        pace = np.sqrt(self.corner_inertia / (self.corner_radius * load))
        return pace * np.arccosh(1 / (1 - size / reach)) + self.fixed_base_period / 4

    def dissipation_limit(self, peak: ArrayLike, fraction: float = 0.25) -> DissipationLimit:
        """Place where the loss of energy begins on the way back from a peak; thesis 4-25 and 4-26.

        Parameters
        ----------
        peak : array_like
            Peak [m], any shape.
        fraction : float, optional
            Part of the peak at which it begins.

        Returns
        -------
        DissipationLimit
            Displacement and speed, in the shape of the peak.

        Raises
        ------
        ValueError
            For a fraction outside 0 to 1, and a peak that reaches H.

        Notes
        -----
        Both equations are missing from the text; these follow its words: the wall keeps its energy
        until D is a `fraction`, a quarter, of the peak (4-25), and its speed there is that of 4-23
        (4-26). That energy is lost below about 4 mm whatever the speed, as Figure 4-27 suggests, is
        not in them.
        """
        (peak,) = numbers("Wall.dissipation_limit", peak=peak)
        rule = "it lies between 0 and 1"
        require(0 <= fraction <= 1, "Wall.dissipation_limit", "fraction", fraction, rule)
        limit = fraction * peak
        return DissipationLimit(limit, np.abs(self.phase_trajectory(peak, limit)))

    @property
    def _descending_weight(self) -> float:
        """m g H_c [J]."""
        return self.mass * self.gravity * self.centroid_height

    def _lever(self, displacement: ArrayLike, q: np.ndarray) -> np.ndarray:
        """d - B [m], without cancellation near upright; q = sin(theta)."""
        cosine = np.sqrt(1 - q**2)
        b = self.rotation_centre.distance(displacement)
        return b / cosine + self.half_width * q**2 / (cosine * (1 + cosine))

    def _mass_at(self, displacement: ArrayLike) -> np.ndarray:
        """I_o/H**2 [kg]."""
        return self.moment_of_inertia(self.detached_length(displacement)) / self.height**2

    def _sine(self, where: str, displacement: ArrayLike) -> np.ndarray:
        (displacement,) = numbers(where, displacement=displacement)
        rule = f"it must be less than the height, {self.height} m; give metres"
        require(np.abs(displacement) < self.height, where, "displacement", displacement, rule)
        return displacement / self.height


_NO_TENDON = Tendon(stiffness=1.0, initial_force=0.0, yield_force=1.0)


@lru_cache(maxsize=256)
def _with_constants(wall: Wall, tendon: Tendon) -> np.ndarray:
    """The parameters of the derived oscillator, with the constants that follow from them."""
    m = generated_module(_Held.model)
    # at rest its effective mass and its losses say nothing
    values = dict.fromkeys(m.PARAMETERS, 1.0) | wall.parameters_with(tendon)
    return m.prepare(np.array([values[name] for name in m.PARAMETERS]))


class _Held:
    """A wall with one tendon, or none, at rest at displacements, by its generated functions.

    displacement [m], of any shape, that of all results. Each is reached from upright by a growing
    one: a tendon that yields has its yield force. Energies and forces are sums over the weight and
    the tendons, so that several tendons need no model of their own.
    """

    model = "controlled_wall_oscillator"

    def __init__(self, wall: Wall, tendon: Tendon | None, displacement: ArrayLike) -> None:
        m = self._module = generated_module(self.model)
        self._tendon = tendon or _NO_TENDON
        self._p, self._shape = _with_constants(wall, self._tendon), np.shape(displacement)
        d = np.ravel(np.asarray(displacement, dtype=float))
        self._y = np.zeros((d.size, m.N_STATES))
        self._y[:, m.ROTATION] = d

        def modes(tendon: str) -> np.ndarray:
            left, right = (m.MODES.index(f"{side}{tendon}") for side in ("left", "right"))
            return np.where(d < 0, left, right)

        self._modes = modes("")
        if tendon is None:
            self._modes = modes("_slack")
            return
        # the elastic force of the tendon shows whether it yields or is slack
        elastic = tendon.initial_force + tendon.stiffness * self.extension.ravel()
        self._beyond = np.maximum(elastic - tendon.yield_force, 0.0)
        self._modes = np.where(elastic < 0, modes("_slack"), self._modes)
        self._modes = np.where(self._beyond > 0, modes("_yield"), self._modes)

    def _named(self, function: str, *arguments: float) -> dict[str, np.ndarray]:
        values = at_states(self._module, self._p, function, self._modes, self._y, *arguments)
        return {name: value.reshape(self._shape) for name, value in values.items()}

    @property
    def force(self) -> np.ndarray:
        """Force of the pushover [N]."""
        return self._named("statics", 0.0)[self._module.STATES[self._module.ROTATION]]

    @property
    def energy(self) -> np.ndarray:
        """Energy of the weight and of the tendon [J]."""
        return sum(self._named("energies").values(), start=np.zeros(self._shape))

    @property
    def work_of_yielding(self) -> np.ndarray:
        """Done on the tendon and not stored, its yield force times its permanent extension [J]."""
        permanent = self._beyond / self._tendon.stiffness
        return self._tendon.yield_force * permanent.reshape(self._shape)

    @property
    def extension(self) -> np.ndarray:
        """Extension of the tendon since the initial state [m]."""
        return self._named("kinematics")["tendon_extension"]

    @property
    def tendon_force(self) -> np.ndarray:
        """Force of the tendon [N]."""
        return self._named("reactions", 0.0, 0.0)["tendon_force"]
