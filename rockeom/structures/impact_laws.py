"""Impact laws, each named by the quantity that it prescribes, so that none is confused.

A law prescribes a ratio of velocities e, of kinetic energies r = e**2, or the directions in which
momentum is conserved. A new one is a class of this file that `LAWS` lists, and a name in
`rockeom/__init__.py`; one whose ratio depends on the impact writes a `Table` of r, which the loop
and `after_impact` read by the same function.
"""

import inspect
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, is_dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple, Protocol, Self

import numpy as np

from rockeom.codes import IMPULSIVE, RATIO, TABULATED, UNEVEN
from rockeom.integrator.schema import GeneratedModule
from rockeom.integrator.transitions.restitution import tabulated_energy_ratio
from rockeom.numbers import explained
from rockeom.numbers.checks import (
    InputError,
    InputTypeError,
    array_of,
    described,
    is_number,
    number,
)
from rockeom.numbers.functions import isfinite, mathematics


class ImpactLaw(Protocol):
    """The velocities after an impact, by those before."""

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        """Code and ratio of the law for the compiled functions.

        Parameters
        ----------
        velocity_ratio : float
            Ratio of the angular velocities by the angular momentum of the rigid structure.
        has_impulsive : bool
            Whether the structure has the impulsive form.
        name : str
            Name of the structure.

        Returns
        -------
        code : int
            Code of the law.
        ratio : float
            Ratio of the angular velocities after and before an impact.

        Raises
        ------
        ValueError
            Where the structure cannot have the law.
        """
        ...


class Landing(Protocol):
    """The structure whose impacts an impact law describes.

    model : its name. speed_height [m] : of the point whose speed is meant, or None. rocking_inertia
    [kg m2] : twice the kinetic energy at an impact for a rotation of 1 rad/s and no other motion.
    """

    @property
    def model(self) -> str: ...
    @property
    def speed_height(self) -> float | None: ...
    @property
    def rocking_inertia(self) -> float: ...


class Row(NamedTuple):
    """r of the impacts up to a limit of the angular velocity w [rad/s].

    r = ratio + slope |w| + reciprocal/|w|
    """

    ratio: float
    slope: float = 0.0
    reciprocal: float = 0.0
    limit: float = math.inf


class Table(NamedTuple):
    """Ratios r of the kinetic energies of rocking after and before an impact, for the loop.

    left, right : rows of the impacts in which that foot lands, as many of one as of the other: of
    increasing limits, or numbers alone, one for each impact, behind which the first one follows.
    bounded : whether r below 0 counts as 0, and r above 1 as 1; else an impact that would give
    energy ends the motion as not finite.
    """

    left: Sequence[Row] | Sequence[float]
    right: Sequence[Row] | Sequence[float]
    bounded: bool = False

    def numbers(self) -> list[float]:
        """Numbers in the order of `tabulated_energy_ratio`, which reads them from their end."""
        rows = [
            (row.limit, row.ratio, row.slope, row.reciprocal) if isinstance(row, Row) else (row,)
            for row in (*self.left, *self.right)
        ]
        flat = [number for row in rows for number in row]
        return [*flat, float(len(self.left)), float(len(rows[0])), float(self.bounded)]

    def energy_ratio(self, rate: float, impact: int = 0) -> float:
        """r as tabulated, of an impact by the rate before it [rad/s] and its number."""
        r: float = tabulated_energy_ratio(impact, rate, np.array(self.numbers()))
        return min(max(r, 0.0), 1.0) if self.bounded else r


class TabulatedLaw:
    """An impact law whose ratio is not one number: the loop reads its table."""

    code = UNEVEN

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        """Code and ratio of the law for the compiled functions.

        Parameters
        ----------
        velocity_ratio : float
            Ratio of the angular velocities by the angular momentum of the rigid structure.
        has_impulsive : bool
            Whether the structure has the impulsive form.
        name : str
            Name of the structure.

        Returns
        -------
        code : int
            Code of the law.
        ratio : float
            Ratio of the angular velocities, NaN where the table has it.
        """
        return self.code, math.nan

    @property
    def table_needed(self) -> bool:
        """Whether the compiled loop reads the table of the law."""
        return True

    def table(self, structure: Landing) -> Table:
        """Energy ratios r of the impacts of a structure.

        Parameters
        ----------
        structure : Structure
            Structure whose impacts the law describes.

        Returns
        -------
        Table
            Table for the compiled loop.
        """
        raise NotImplementedError


@explained.record(e="rk.VelocityRatio(e)", restitution="rk.VelocityRatio(e)")
@dataclass(frozen=True, repr=False)
class EnergyRatio(TabulatedLaw):
    """Prescribed ratio r of the rocking motion's kinetic energies after and before an impact.

    The angular velocity is multiplied by sqrt(r), other rates are left (thesis 2-4).

    Parameters
    ----------
    r : float, optional
        Energy ratio of all impacts, 0 to 1; or `left` and `right`.
    left : float, optional
        Energy ratio of the impacts in which the left foot *lands*: the structure, leaning to the
        right, comes back upright; the rotation was positive, its rate is negative. Thesis section
        3.2.4 calls that an impact on the left edge.
    right : float, optional
        Energy ratio of the impacts in which the right foot lands.

    Raises
    ------
    TypeError
        Where neither r nor both feet are given.
    ValueError
        Outside 0 to 1.

    See Also
    --------
    VelocityRatio : The ratio e = sqrt(r) of the angular velocities.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse, impact=rk.EnergyRatio(0.81))  # r, of kinetic energies
    >>> of_each_foot = rk.EnergyRatio(left=0.83, right=0.93)
    """

    r: float | None = None
    left: float | None = None
    right: float | None = None

    def __post_init__(self) -> None:
        one_or_each_foot("EnergyRatio", "r", self.r, self.left, self.right)
        for name in ("r", "left", "right"):
            value = getattr(self, name)
            if value is not None:
                check_ratio(name, value, "EnergyRatio")

    def __repr__(self) -> str:
        if self.r is not None:
            return f"EnergyRatio(r={self.r!r})"
        return f"EnergyRatio(left={self.left!r}, right={self.right!r})"

    @property
    def table_needed(self) -> bool:
        """Whether the feet differ, so that the compiled loop reads the table of the law."""
        return self.r is None

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        if self.r is None:
            return super().resolve(velocity_ratio, has_impulsive, name)
        return RATIO, mathematics.sqrt(self.r)

    def of_foot(self, foot: str) -> float:
        """Energy ratio r where one of the feet lands.

        Parameters
        ----------
        foot : str
            "left" or "right".

        Returns
        -------
        float
            Energy ratio r.
        """
        r = self.r if self.r is not None else {"left": self.left, "right": self.right}[foot]
        assert r is not None
        return r

    def table(self, structure: Landing) -> Table:
        return Table([Row(self.of_foot("left"))], [Row(self.of_foot("right"))])


@explained.record(r="rk.EnergyRatio(r)", restitution="e=")
@dataclass(frozen=True)
class VelocityRatio:
    """Prescribed ratio e of the angular velocities after and before an impact, e = sqrt(r).

    Parameters
    ----------
    e : float
        Coefficient of restitution, 0 to 1.

    Raises
    ------
    ValueError
        Outside 0 to 1.

    See Also
    --------
    EnergyRatio : The ratio r of the kinetic energies.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse, impact=rk.VelocityRatio(0.9))  # e, of angular velocities
    """

    e: float

    def __post_init__(self) -> None:
        check_ratio("e", self.e, "VelocityRatio")

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        """Code and ratio of the law for the compiled functions.

        Parameters
        ----------
        velocity_ratio : float
            Ratio of the angular velocities by the angular momentum of the rigid structure.
        has_impulsive : bool
            Whether the structure has the impulsive form.
        name : str
            Name of the structure.

        Returns
        -------
        code : int
            Code of the law.
        ratio : float
            Ratio of the angular velocities after and before an impact.
        """
        return RATIO, self.e


@explained.record()
@dataclass(frozen=True)
class AngularMomentum:
    """Impact law by which the angular momentum about the new pivot is conserved.

    The structure counts as rigid. It is the default of structures that rotate and do nothing else.

    Notes
    -----
    For a flexible structure this is the thesis's rule: the deformation's rate is left unchanged,
    and an impact may gain energy. `Impulsive` is the exact law there, and the default. For a rigid
    block with its centroid off the middle the two are one.

    References
    ----------
    Housner (1963); thesis 2-6 and 5-14.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse, impact=rk.AngularMomentum())
    >>> round(block.velocity_ratio, 4)  # its ratio e
    0.9118
    """

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        """Code and ratio of the law for the compiled functions.

        Parameters
        ----------
        velocity_ratio : float
            Ratio of the angular velocities by the angular momentum of the rigid structure.
        has_impulsive : bool
            Whether the structure has the impulsive form.
        name : str
            Name of the structure.

        Returns
        -------
        code : int
            Code of the law.
        ratio : float
            Ratio of the angular velocities after and before an impact.
        """
        if not isfinite(velocity_ratio):  # each foot has its own
            return IMPULSIVE, math.nan
        return RATIO, velocity_ratio


@explained.record()
@dataclass(frozen=True)
class Impulsive:
    """Impulsive form of Lagrange's equations: exact for a flexible structure as well.

    It is the default of a flexible structure. Where the old foot cannot lift, full contact follows.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse, impact=rk.Impulsive())  # for a rigid block AngularMomentum
    """

    def resolve(self, velocity_ratio: float, has_impulsive: bool, name: str) -> tuple[int, float]:
        """Code and ratio of the law for the compiled functions.

        Parameters
        ----------
        velocity_ratio : float
            Ratio of the angular velocities by the angular momentum of the rigid structure.
        has_impulsive : bool
            Whether the structure has the impulsive form.
        name : str
            Name of the structure.

        Returns
        -------
        code : int
            Code of the law.
        ratio : float
            Ratio of the angular velocities, of no use here.

        Raises
        ------
        ValueError
            Where the structure has no impulsive form.
        """
        if not has_impulsive:
            raise InputError(name).wrong(
                "has no impulsive law: its masses do not tell the impulses; use "
                "AngularMomentum(), EnergyRatio(r) or VelocityRatio(e)"
            )
        return IMPULSIVE, math.nan


@explained.record()
@dataclass(frozen=True)
class EnergyRatioAtSpeed(TabulatedLaw):
    """Energy ratio r that depends on the speed at the impact, in straight pieces.

    Parameters
    ----------
    pieces : tuple of tuple of (float, float, float)
        Pieces of increasing speed, each (limit [m/s], r at no speed, slope [s/m]); r is theirs
        below the limit, which for the last one is infinite. At a limit the faster piece holds.
    height : float, optional
        Height above the base of the point whose speed it is [m]. None: the height that the
        structure names, as walls do; without one the law is refused.

    Raises
    ------
    ValueError
        For pieces that do not follow one another.

    Notes
    -----
    Where r would exceed 1, an impact would give energy; such a motion ends as not finite.
    """

    pieces: tuple[tuple[float, float, float], ...]
    height: float | None = None
    code = TABULATED

    def __post_init__(self) -> None:
        if not _are_pieces(self.pieces):
            raise InputTypeError("pieces", self.pieces).says(
                f"pieces of an energy ratio are {described(self.pieces)}: give three numbers for "
                "each, (limit [m/s], r at no speed, slope [s/m]), as ((math.inf, 0.865, 0.0441),)"
            )
        if self.height is not None:
            number("height", self.height, "EnergyRatioAtSpeed")
        limits = [limit for limit, _, _ in self.pieces]
        rises = all(a < b for a, b in pairwise(limits))
        if not limits or limits[-1] != math.inf or not rises:
            raise InputError("pieces").says(
                f"energy ratio in pieces with the limits {limits} m/s: they must increase, and the "
                "last one be infinite"
            )
        start, name = 0.0, "EnergyRatioAtSpeed"
        for limit, r, slope in self.pieces:
            check_ratio(f"pieces at {start} m/s", r + slope * start, name)
            if limit < math.inf:
                check_ratio(f"pieces below {limit} m/s", r + slope * limit, name)
                start = limit
        if limits[0] <= 0 or (self.height is not None and not self.height > 0):
            raise InputError("pieces", self.pieces).give("positive limits, and a positive height")

    @classmethod
    def equation_4_31(cls) -> Self:
        """Thesis 4-31, of the equivalent oscillator of a controlled wall.

        Returns
        -------
        EnergyRatioAtSpeed
            Impact law.
        """
        return cls(
            ((0.3, 0.85, 0.01 / 0.45), (0.47, 0.81, 0.0), (0.78, 0.852, 0.0), (math.inf, 0.95, 0.0))
        )

    @classmethod
    def equation_4_36(cls) -> Self:
        """Thesis 4-36, of the simplified substitute gravity; as printed.

        Returns
        -------
        EnergyRatioAtSpeed
            Impact law.
        """
        return cls(((math.inf, 0.865, 0.0441),))

    @classmethod
    def equation_4_38(cls) -> Self:
        """Thesis 4-38, of the substitute gravity with a rotation centre that moves.

        Returns
        -------
        EnergyRatioAtSpeed
            Impact law.
        """
        return cls(
            ((0.365, 0.445, 1.0), (0.47, 0.81, 0.0), (0.78, 0.85, 0.0), (math.inf, 0.94, 0.0))
        )

    @classmethod
    def from_data(
        cls,
        speed: Iterable[float],
        energy_ratio: Iterable[float],
        *,
        limits: Sequence[float] = (),
        slopes: bool = True,
        height: float | None = None,
    ) -> Self:
        """Pieces fitted to measured impacts, each by least squares to those in its own band.

        Parameters
        ----------
        speed : iterable of float
            Speed at each impact (n,), of either sign [m/s].
        energy_ratio : iterable of float
            Energy ratio r of each (n,).
        limits : sequence of float, optional
            Limits between the bands [m/s], increasing; none for one band.
        slopes : bool, optional
            Whether the pieces are straight lines; False for the mean of each band.
        height : float, optional
            Height above the base of the point whose speed it is [m], as for the class.

        Returns
        -------
        EnergyRatioAtSpeed
            Impact law.

        Raises
        ------
        ValueError
            For a band with fewer impacts than its line has numbers, and where a fitted line leaves
            0 to 1.

        Notes
        -----
        Impacts of r above 1, as measured ratios of small peaks may be, count as they are. Beyond
        the fastest impact the last line goes on.

        Examples
        --------
        With measured `speed` and `r`::

            rk.EnergyRatioAtSpeed.from_data(speed, r, limits=(0.3, 0.47, 0.78), slopes=False)
        """
        signed, r = _of_impacts("EnergyRatioAtSpeed", speed=speed, energy_ratio=energy_ratio)
        v = np.abs(signed)
        ends = [*(number("limit", limit) for limit in limits), math.inf]
        pieces = []
        for start, end in zip([0.0, *ends], ends, strict=False):
            inside = (v >= start) & (v < end)
            if len(set(v[inside].tolist())) < 1 + slopes:
                raise InputError("limits", of="EnergyRatioAtSpeed.from_data").says(
                    f"{inside.sum()} impacts from {start} to {end} m/s are too few for a piece: "
                    "move the limits, or take slopes=False"
                )
            line = np.polynomial.polynomial.polyfit(v[inside], r[inside], int(slopes)).tolist()
            pieces.append((end, line[0], line[1] if slopes else 0.0))
        return cls(tuple(pieces), height)

    def at(self, speed: float) -> float:
        """Energy ratio r at a speed.

        Parameters
        ----------
        speed : float
            Speed of either sign [m/s].

        Returns
        -------
        float
            Energy ratio r.
        """
        return self._at_height(1.0).energy_ratio(abs(number("speed", speed)))

    def lever(self, structure: Landing) -> float:
        """Height of the point whose speed it is.

        Parameters
        ----------
        structure : Structure
            Structure whose impacts the law describes.

        Returns
        -------
        float
            Height [m].

        Raises
        ------
        ValueError
            Where neither the law nor the structure has one.
        """
        lever = self.height if self.height is not None else structure.speed_height
        if lever is None:
            raise InputError("height").says(
                f"the energy ratio depends on a speed, and {structure.model} does not tell of "
                "which point: give EnergyRatioAtSpeed(..., height=...)"
            )
        return lever

    def _at_height(self, height: float) -> Table:
        """The table by the angular velocity; height [m] of the point whose speed it has now."""
        rows = [
            Row(r, slope * height, 0.0, limit / height if limit < math.inf else limit)
            for limit, r, slope in self.pieces
        ]
        return Table(rows, rows)

    def table(self, structure: Landing) -> Table:
        return self._at_height(self.lever(structure))


@explained.record()
@dataclass(frozen=True)
class EnergyLossAtSpeed(TabulatedLaw):
    """Energy that an impact takes, by the angular velocity w before it: ``a1 |w| + a2 w2 + a3
    |w|3``.

    Parameters
    ----------
    left : tuple of (float, float, float)
        Coefficients (a1, a2, a3) of the impacts in which the left foot lands [J s, J s2, J s3];
        `EnergyRatio` says which foot lands. A positive number is a loss.
    right : tuple of (float, float, float)
        Coefficients of the impacts in which the right foot lands.

    Raises
    ------
    TypeError
        For anything but three numbers each, and where it is used for a structure whose rotation is
        no angle in time.

    Notes
    -----
    The energy is that of the rocking motion, I w2/2, with the structure's moment of inertia I about
    its foot at the impact; other rates are left. A polynomial may ask for more than that, or for
    less than nothing, where it was not measured: then all of it is lost, or none.
    """

    left: tuple[float, float, float]
    right: tuple[float, float, float]

    def __post_init__(self) -> None:
        for foot in ("left", "right"):
            given = getattr(self, foot)
            if not (isinstance(given, Sequence) and len(given) == 3 and all(map(is_number, given))):
                raise InputTypeError(foot, given).says(
                    f"energy loss of the {foot} foot is {described(given)}: give three numbers, "
                    "those of |w|, w2 and |w|3 [J s, J s2, J s3], as (0.0, 9.7, 0.0)"
                )
            if not all(isfinite(number(foot, x)) for x in given):
                raise InputError(foot, given).give("finite numbers")
            object.__setattr__(self, foot, tuple(given))

    @classmethod
    def equation_3_17(cls) -> Self:
        """Thesis 3-17, fitted to all impacts of the block of chapter 3, of both feet.

        A cubic of the angular velocity with its sign: the left foot loses three times as much at 1
        rad/s.

        Returns
        -------
        EnergyLossAtSpeed
            Impact law.
        """
        return cls(left=(-0.6663, 9.661, 5.525), right=(0.6663, 9.661, -5.525))

    @classmethod
    def equation_3_18(cls) -> Self:
        """Thesis 3-18, the second trend of impacts on the right foot; the left one by 3-17.

        Returns
        -------
        EnergyLossAtSpeed
            Impact law.
        """
        return cls(left=(-0.6663, 9.661, 5.525), right=(0.0381, 7.576, -7.144))

    @classmethod
    def from_data(cls, rate: Iterable[float], loss: Iterable[float]) -> Self:
        """Law of measured impacts, each foot by itself, by least squares.

        Parameters
        ----------
        rate : iterable of float
            Angular velocities before each impact (n,) [rad/s], negative where the left foot lands.
        loss : iterable of float
            Losses of energy (n,) [J].

        Returns
        -------
        EnergyLossAtSpeed
            Impact law.

        Raises
        ------
        ValueError
            Where a foot has fewer than three impacts.
        """
        w, lost = _of_impacts("EnergyLossAtSpeed", rate=rate, loss=loss)
        feet = {}
        for foot, rows in (("left", w < 0), ("right", w > 0)):
            size = np.abs(w[rows])
            if len(set(size.tolist())) < 3:
                raise InputError("rate", of="EnergyLossAtSpeed.from_data").says(
                    f"{rows.sum()} impacts of the {foot} foot are too few for three numbers: "
                    "measure more"
                )
            powers = np.column_stack([size, size**2, size**3])
            feet[foot] = tuple(np.linalg.lstsq(powers, lost[rows], rcond=None)[0].tolist())
        return cls(**feet)

    def loss(self, rate: float) -> float:
        """Energy lost at an angular velocity before the impact, as fitted, without bounds.

        Parameters
        ----------
        rate : float
            Angular velocity [rad/s], negative where the left foot lands.

        Returns
        -------
        float
            Energy [J].
        """
        w = abs(number("rate", rate))
        a1, a2, a3 = getattr(self, landing_foot(rate))
        return w * (a1 + w * (a2 + w * a3))

    def at(self, rate: float, inertia: float) -> float:
        """Energy ratio r at an angular velocity before the impact.

        Parameters
        ----------
        rate : float
            Angular velocity [rad/s], negative where the left foot lands.
        inertia : float
            Moment of inertia about the foot [kg m2].

        Returns
        -------
        float
            Energy ratio r.
        """
        return self._with_inertia(inertia).energy_ratio(number("rate", rate))

    def _with_inertia(self, inertia: float) -> Table:
        half = 0.5 * inertia
        left, right = (
            [Row(1.0 - a2 / half, -a3 / half, -a1 / half)] for a1, a2, a3 in (self.left, self.right)
        )
        return Table(left, right, bounded=True)

    def table(self, structure: Landing) -> Table:
        return self._with_inertia(structure.rocking_inertia)


DRAWS = 500
"""How many ratios are drawn for a motion; behind the last the first one follows."""


@explained.record()
@dataclass(frozen=True, repr=False)
class RandomEnergyRatio(TabulatedLaw):
    """Energy ratio r drawn at each impact from a measured distribution, by seed (thesis 6.4).

    Parameters
    ----------
    values : tuple of float, optional
        Measured energy ratios, each as likely as the others; or `left` and `right`.
    left : tuple of float, optional
        Energy ratios of the impacts in which the left foot lands, see `EnergyRatio`.
    right : tuple of float, optional
        Energy ratios of the impacts in which the right foot lands.
    seed : int, optional
        Whole number from 0 on; another seed is another motion.

    Raises
    ------
    TypeError
        Where neither values nor both feet are given.
    ValueError
        Where no value lies within 0 to 1.

    Notes
    -----
    The ratio follows from the seed and from the number of the impact in the motion alone: it is the
    same for any step, tolerance and method, in `simulate` and `simulate_many`. The 500 impacts that
    are drawn for begin again behind the last one, which only a chatter towards rest reaches.

    No impact gives energy or reverses: values outside 0 to 1, as apparent ratios of small peaks
    are, are never drawn, the others as much more often. This lowers the mean where values exceed 1;
    `mean` and `std` are those of the ratios that are drawn.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> law = rk.RandomEnergyRatio([0.76, 0.95, 0.77, 0.92], seed=1)  # r, drawn at each impact
    >>> run = rk.simulate(block, pulse, impact=law)
    >>> of_each_foot = rk.RandomEnergyRatio(left=[0.763, 0.769], right=[0.948, 0.922], seed=1)
    >>> normal = rk.RandomEnergyRatio.normal(mean=0.85, std=0.06, seed=1)
    """

    values: tuple[float, ...] | None = None
    left: tuple[float, ...] | None = None
    right: tuple[float, ...] | None = None
    seed: int = 0

    def __post_init__(self) -> None:
        one_or_each_foot("RandomEnergyRatio", "values", self.values, self.left, self.right)
        for name in ("values", "left", "right"):
            given = getattr(self, name)
            if given is None:
                continue
            ratios = array_of(name, given, "RandomEnergyRatio", "measured energy ratios")
            if ratios.ndim != 1 or not np.any((ratios >= 0) & (ratios <= 1)):
                raise InputError(name, given).says(
                    f"{name} of RandomEnergyRatio is {described(given)} without one from 0 (no "
                    "rebound) to 1 (no loss): give a list of measured energy ratios"
                )
            object.__setattr__(self, name, tuple(ratios.tolist()))
        if not (is_number(self.seed) and int(self.seed) == self.seed and self.seed >= 0):
            raise InputTypeError("seed", self.seed).give("a whole number from 0 on")
        object.__setattr__(self, "seed", int(self.seed))

    @classmethod
    def normal(cls, mean: float, std: float, *, seed: int = 0) -> Self:
        """Law of a normal distribution, cut off at 0 and 1: a thousand equally likely values.

        Parameters
        ----------
        mean : float
            Mean of the whole distribution; the cut changes it, see `mean`.
        std : float
            Standard deviation of the whole distribution; the cut changes it, see `std`.
        seed : int, optional
            Whole number from 0 on.

        Returns
        -------
        RandomEnergyRatio
            Impact law.

        Raises
        ------
        ValueError
            For a std that is not positive, and where next to nothing lies within 0 to 1.
        """
        from scipy.special import ndtr, ndtri

        middle, width = number("mean", mean), number("std", std)
        if not (width > 0 and math.isfinite(width) and math.isfinite(middle)):
            raise InputError("mean", mean).give(f"a finite mean, and a positive std, not {std}")
        low, high = ndtr((0.0 - middle) / width), ndtr((1.0 - middle) / width)
        if not high - low > 1e-6:
            raise InputError("std", std).says(
                f"a normal distribution of mean {mean} and std {std} has nothing from 0 to 1"
            )
        places = low + (high - low) * (np.arange(1000) + 0.5) / 1000
        return cls(tuple(np.clip(middle + width * ndtri(places), 0.0, 1.0).tolist()), seed=seed)

    def __repr__(self) -> str:
        if self.values is not None:
            return f"RandomEnergyRatio({_told_values(self.values)}, seed={self.seed})"
        left, right = (_told_values(getattr(self, foot)) for foot in ("left", "right"))
        return f"RandomEnergyRatio(left={left}, right={right}, seed={self.seed})"

    def of_foot(self, foot: str) -> np.ndarray:
        """Values of the impacts in which one of the feet lands.

        Parameters
        ----------
        foot : str
            "left" or "right".

        Returns
        -------
        ndarray
            Energy ratios from 0 to 1, sorted (m,).
        """
        given = self.values if self.values is not None else getattr(self, foot)
        ratios = np.sort(given)
        return ratios[(ratios >= 0) & (ratios <= 1)]

    @property
    def mean(self) -> float:
        """Mean of the ratios that are drawn, each foot as often as the other."""
        return float(np.mean([np.mean(self.of_foot(foot)) for foot in ("left", "right")]))

    @property
    def std(self) -> float:
        """Standard deviation of the ratios that are drawn, each foot as often as the other."""
        feet = [self.of_foot(foot) for foot in ("left", "right")]
        square = np.mean([np.mean(values**2) for values in feet])
        return float(np.sqrt(max(square - self.mean**2, 0.0)))

    @cached_property
    def drawn(self) -> dict[str, np.ndarray]:
        """(500,) energy ratios of each foot, by the number of the impact in the motion."""
        places = np.random.default_rng(self.seed).random(DRAWS)
        feet = {foot: self.of_foot(foot) for foot in ("left", "right")}
        return {foot: r[(places * len(r)).astype(int)] for foot, r in feet.items()}

    def table(self, structure: Landing) -> Table:
        return Table(self.drawn["left"].tolist(), self.drawn["right"].tolist())


@explained.record()
@dataclass(frozen=True)
class EnergyRatioByImpact(TabulatedLaw):
    """Energy ratio r of the first impact, of the second, and so on.

    For a test whose impacts were measured one by one, and for ratios that scatter where each is
    itself an unknown.

    Parameters
    ----------
    values : tuple of float
        Energy ratio of each, 0 to 1; they start again after the last one.

    Raises
    ------
    TypeError
        For anything but a list of numbers and for an empty one.
    ValueError
        For a ratio outside 0 to 1.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> law = rk.EnergyRatioByImpact([0.76, 0.95, 0.77])  # r of the first three impacts, and again
    >>> run = rk.simulate(block, pulse, impact=law)
    """

    values: tuple[float, ...]

    def __post_init__(self) -> None:
        listed = isinstance(self.values, list | tuple | np.ndarray)
        given = tuple(self.values) if listed else ()
        if not given:
            raise InputTypeError("values", self.values).says(
                f"values of EnergyRatioByImpact is {described(self.values)}: give the ratio of "
                "each impact, such as [0.82, 0.77, 0.9], or EnergyRatio(0.8) for all"
            )
        for place, r in enumerate(given):
            check_ratio(f"values[{place}]", r, "EnergyRatioByImpact")
        object.__setattr__(self, "values", given)

    def table(self, structure: Landing) -> Table:
        return Table(list(self.values), list(self.values))


LAWS: dict[str, Any] = {
    name: law
    for name, law in globals().items()
    if isinstance(law, type) and is_dataclass(law) and hasattr(law, "resolve")
}
"""The impact laws by name: those that a file of a response may hold."""


def default_law(module: GeneratedModule) -> ImpactLaw:
    """The impact law of a structure for which none is named, by what its module declares.

    The impulse at the new foot changes the rates of all coordinates. AngularMomentum changes that
    of the rotation alone: exact for a rigid body; with further coordinates, such as the bending of
    a column, it violates their conservation laws, and an impact may gain energy.
    """
    bends = module.HAS_IMPULSIVE and module.N_STATES > 2
    return Impulsive() if bends else AngularMomentum()


def check_law(impact: Any) -> None:
    """Raise TypeError for anything but an impact law; a number could be r or e."""
    if type(impact) in LAWS.values():
        return
    try:  # a law of the caller's own; a path, too, has a method of that name
        inspect.signature(impact.resolve).bind(1.0, True, "name")
    except (AttributeError, TypeError, ValueError):
        r = impact if is_number(impact) else 0.8
        raise InputTypeError("impact", impact).give(
            f"an impact law, such as rk.EnergyRatio({r}) or rk.VelocityRatio({r}), "
            "rk.AngularMomentum() or rk.Impulsive()"
        ) from None


def landing_foot(rate: float) -> str:
    """The foot that lands where the structure comes upright at this angular velocity."""
    return "right" if rate > 0 else "left"


def one_or_each_foot(what: str, name: str, one: Any, left: Any, right: Any) -> None:
    """Raise TypeError unless one is given for all impacts, or one for each foot."""
    feet = [value is not None for value in (left, right)]
    if (one is not None and any(feet)) or (one is None and not all(feet)):
        raise InputTypeError("impact").says(
            f"{what} takes {name} for all impacts, or left and right for those in which that foot "
            f"lands: give {what}({name}) or {what}(left=..., right=...)"
        )


def _told_values(values: tuple[float, ...]) -> str:
    if len(values) <= 8:
        return f"[{', '.join(f'{r:g}' for r in values)}]"
    return f"{len(values)} values of mean {np.mean(values):.4g} and std {np.std(values):.4g}"


def _of_impacts(what: str, **measured: Iterable[float]) -> list[np.ndarray]:
    """Two columns (n,) that were measured at impacts, for `from_data`."""
    x, y = columns = [array_of(name, values) for name, values in measured.items()]
    if x.ndim != 1 or x.shape != y.shape or not np.isfinite(columns).all():
        first, second = measured
        raise InputError(first, of=f"{what}.from_data").wrong(
            f"has the shape {x.shape}, {second} {y.shape}: give one finite number of each for "
            "every impact"
        )
    return columns


def _are_pieces(pieces: Any) -> bool:
    try:
        rows = [tuple(piece) for piece in pieces]
    except TypeError:
        return False
    return all(len(row) == 3 and all(map(is_number, row)) for row in rows)


def check_ratio(argument: str, value: float, of: str) -> None:
    if not 0.0 <= number(argument, value, of) <= 1.0:
        percent = f"; {value:g} % is {value / 100:g}" if 2.0 <= value <= 100.0 else ""
        raise InputError(argument, value, of).give(f"0 (no rebound) to 1 (no loss){percent}")
