"""Quasi-static tests of a rigid wall on a bed of springs: pushover and cycles, exact by events.

The equations are derived (`rockeom.symbolic.parts.walls`) and taken to first order in the
rotation. Between two events, at which a spring closes, opens, crushes or ceases to, all springs
keep their stiffness, and equilibrium is linear: the path is a polygon, and a step leads to its next
corner. The state of a spring is one number, its elastic compression. No modes are enumerated, and
a bed may have any number of springs; thousands take seconds.
"""

from __future__ import annotations

import dataclasses
import functools
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import sympy as sp

from rockeom.analysis.design.hysteresis import HysteresisLoop
from rockeom.analysis.formulas.masonry import rocking_strength
from rockeom.analysis.identification.stone_walls import WallTest
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, number, numbers, positive, require, whole_number
from rockeom.symbolic.parts import walls
from rockeom.symbolic.statics import small_rotations

SECANT = 0.7
"""Part of the strength at which an effective stiffness is the secant of a curve."""
_SOFTEST, _STIFFEST = 1e6, 1e15
"""Bed moduli that are tried [N/m3]: of peat, and a thousand times that of steel 0.1 m thick."""


@dataclass(frozen=True, eq=False)
class WallPath:
    """Quasi-static path of a wall, straight between its points, the events; (n,) each.

    Parameters
    ----------
    displacement : ndarray
        Displacement at the height of the loads [m].
    force : ndarray
        Horizontal force there [N].
    heave : ndarray
        Rise of the base's middle above the unloaded bed [m].
    reaction : ndarray
        Sum of the springs' forces [N].
    elastic_energy : ndarray
        Energy of the springs [J].
    plastic_work : ndarray
        Energy that crushing has taken since the start [J].
    """

    displacement: np.ndarray
    force: np.ndarray
    heave: np.ndarray
    reaction: np.ndarray
    elastic_energy: np.ndarray
    plastic_work: np.ndarray

    @property
    def strength(self) -> float:
        """The largest size of the force [N]."""
        return float(np.abs(self.force).max())

    @property
    def last_cycle(self) -> HysteresisLoop:
        """The loop since the largest displacement was reached the time before last."""
        (at_peak,) = np.nonzero(self.displacement == self.displacement.max())
        cycle = slice(at_peak[-2] if len(at_peak) > 1 else 0, at_peak[-1])
        return HysteresisLoop(self.displacement[cycle], self.force[cycle])


class _State(NamedTuple):
    """A wall at rest: its displacement, its heave, and the elastic compression of each spring (n,).

    That is negative by the gap of a spring that is open, and at most the one at which it crushes.
    """

    displacement: float
    heave: float
    elastic: np.ndarray
    plastic_work: float


class _Equations(NamedTuple):
    """Coefficients of the equilibrium of rotation and heave, to first order; see `_derived`.

    p_delta [N m], axial [N], height [m] : stiffness of the rotation without springs, force on the
    heave, lever of the horizontal force. turning (n,) [m], rising : compression of each spring by
    the rotation and by the heave.
    """

    p_delta: float
    axial: float
    height: float
    turning: np.ndarray
    rising: float


@explained.record()
@dataclass(frozen=True, kw_only=True)
class WallOnBed:
    """Rigid wall under a constant axial force, on a bed that does not pull, and crushes.

    Parameters
    ----------
    length : float
        Length of the wall [m].
    thickness : float
        Thickness of the wall [m].
    shear_span : float
        Height of zero moment above the base, where the horizontal force and the axial one act [m].
    axial_force : float
        Axial force, constant, the wall's weight counted in [N].
    bed_modulus : float
        Pressure over compression of the bed, which has the flexibility of wall and joints [N/m3].
    strength : float
        Pressure at which the bed crushes, and which it keeps [Pa], such as 0.85 times the masonry's
        compressive strength: then the strength of the wall tends to `rocking_strength`.
    following : bool, optional
        Whether the axial force turns with the wall, and its line passes through the middle of the
        base; or stays vertical and moves with the wall. P-delta, that is -axial_force
        displacement/shear_span, is then a part of the force.
    springs : int, optional
        Number of springs, each of them in the middle of one of as many equal strips.

    Raises
    ------
    ValueError
        For numbers that are not positive, and for an axial force that crushes the bed.

    Notes
    -----
    Rotations are small: compressions are linear in the rotation, and besides P-delta nothing of the
    deformed shape is counted. Terms of the order of the rotation's square are left out. The base
    does not slide. ``rockeom.symbolic.parts.walls.wall_on_bed`` declares the same wall for
    `rk.structure` and `rk.simulate`, on up to seven springs.

    Examples
    --------
    >>> import rockeom as rk
    >>> wall = rk.WallOnBed(
    ...     length=1.0, thickness=0.2, shear_span=1.325, axial_force=104.8e3, bed_modulus=2.9e9,
    ...     strength=0.85 * 73e6,
    ... )  # m, N, N/m3, Pa
    >>> path = wall.pushover(0.04)  # m
    >>> round(path.strength), round(wall.rocking_strength)  # N
    (36651, 39213)
    >>> bool(wall.cycles([0.01, 0.02], repeat=2).last_cycle.damping < 1e-6)  # it hardly crushes
    True
    """

    length: float
    thickness: float
    shear_span: float
    axial_force: float
    bed_modulus: float
    strength: float
    following: bool = True
    springs: int = 100

    def __post_init__(self) -> None:
        what = type(self).__name__
        for name in ("length", "thickness", "shear_span", "axial_force", "bed_modulus", "strength"):
            value = number(name, getattr(self, name), what)
            positive(what, **{name: value})
            object.__setattr__(self, name, value)
        if not isinstance(self.following, bool):
            raise InputError("following", self.following, what).give("True or False")
        object.__setattr__(self, "springs", whole_number("springs", self.springs, 1, what))
        limit = self.strength * self.length * self.thickness
        require(
            self.axial_force < limit, what, "axial_force", self.axial_force,
            f"the bed crushes under {limit:.4g}, strength * length * thickness: give less, in N",
        )  # fmt: skip

    @classmethod
    def of_test(cls, test: WallTest, *, following: bool = True, springs: int = 100) -> WallOnBed:
        """Wall of a test, its bed from the measured effective stiffness.

        Parameters
        ----------
        test : WallTest
            Test, such as one of `analysis.identification.wall_tests`.
        following : bool, optional
            Whether the axial force turns with the wall, as for the class.
        springs : int, optional
            Number of springs.

        Returns
        -------
        WallOnBed
            Wall whose `effective_stiffness` is the measured one. The bed crushes at 0.85 times the
            compressive strength.

        Raises
        ------
        ValueError
            Where no bed is as stiff, or as soft.
        """
        rigid = cls(
            length=test.length, thickness=test.thickness, shear_span=test.shear_span,
            axial_force=test.axial_force, strength=0.85 * test.compressive_strength,
            bed_modulus=_STIFFEST, following=following, springs=springs,
        )  # fmt: skip
        return rigid._as_stiff_as(test.stiffness * test.rise)

    @classmethod
    def of_tests(
        cls, tests: Mapping[str, WallTest], *, following: bool = True, springs: int = 100
    ) -> dict[str, WallOnBed]:
        """Walls of tests by name: the first of each level gives the bed of all of it.

        Parameters
        ----------
        tests : dict of str to WallTest
            Tests by name, such as `analysis.identification.wall_tests`. Walls of one level have the
            same sizes, compressive strength and axial force, `WallTest.level`.
        following : bool, optional
            Whether the axial force turns with the wall, as for the class.
        springs : int, optional
            Number of springs.

        Returns
        -------
        dict of str to WallOnBed
            Walls by the names of the tests.

        Raises
        ------
        ValueError
            As `of_test`.

        Examples
        --------
        >>> import rockeom as rk
        >>> from rockeom import analysis
        >>> walls = rk.WallOnBed.of_tests(analysis.identification.wall_tests())
        >>> walls["WS2.100"].bed_modulus == walls["WS1.100"].bed_modulus  # those of one level
        True
        """
        of_level: dict[tuple[float, ...], WallOnBed] = {}
        for test in tests.values():
            if test.level not in of_level:
                of_level[test.level] = cls.of_test(test, following=following, springs=springs)
        return {name: of_level[test.level] for name, test in tests.items()}

    def _as_stiff_as(self, stiffness: float) -> WallOnBed:
        """The wall on the bed with which it has an effective stiffness [N/m]."""
        from scipy.optimize import brentq  # slow to import

        force = SECANT * self.rocking_strength

        def wall(logarithm: float) -> WallOnBed:
            return dataclasses.replace(self, bed_modulus=float(np.exp(logarithm)))

        def surplus(logarithm: float) -> float:
            return float(wall(logarithm).pushover(force / stiffness).force[-1]) - force

        ends = np.log([_SOFTEST, _STIFFEST])
        if not surplus(ends[0]) < 0 < surplus(ends[1]):
            raise InputError("stiffness", stiffness, "WallOnBed.of_test").says(
                f"no bed of {_SOFTEST:g} to {_STIFFEST:g} N/m3 gives the stiffness {stiffness:.4g} "
                f"N/m at a force of {force:.4g} N: give it in N/m"
            )
        return wall(brentq(surplus, *ends, xtol=1e-9))

    @property
    def rocking_strength(self) -> float:
        """Strength of rigid rocking on the crushed corner, `formulas.rocking_strength` [N]."""
        return float(
            rocking_strength(
                self.axial_force, self.length, self.shear_span, self.thickness, self.strength, 1.0
            )
        )

    def effective_stiffness(self) -> float:
        """Secant of the pushover at 0.7 of the rocking strength.

        Returns
        -------
        float
            Stiffness [N/m].

        Raises
        ------
        ValueError
            Where the wall does not reach that force.
        """
        force = SECANT * self.rocking_strength
        path = self.pushover(self.length / 2)
        if path.strength < force:
            raise InputError("bed", of="WallOnBed.effective_stiffness").says(
                f"up to a displacement of {self.length / 2:.4g} m, half the length, the force "
                f"stays below {force:.4g} N, {SECANT} of the rocking strength: give a stiffer bed"
            )
        end = int(np.argmax(path.force >= force)) + 1
        return force / float(np.interp(force, path.force[:end], path.displacement[:end]))

    def pushover(self, displacement: float) -> WallPath:
        """Path from upright to a displacement.

        Parameters
        ----------
        displacement : float
            Displacement of either sign [m].

        Returns
        -------
        WallPath
            Displacements and forces.
        """
        return self.along([number("displacement", displacement, "WallOnBed.pushover")])

    def cycles(self, amplitudes: Sequence[float], repeat: int = 1) -> WallPath:
        """Path of cycles to and fro.

        It ends at the last peak, as `last_cycle` begins.

        Parameters
        ----------
        amplitudes : sequence of float
            Amplitudes [m], to each of which and back to its negative the wall goes.
        repeat : int, optional
            Number of cycles of each amplitude.

        Returns
        -------
        WallPath
            Displacements and forces.

        Raises
        ------
        ValueError
            For an amplitude that is not positive.
        """
        (sizes,) = positive("WallOnBed.cycles", amplitudes=amplitudes)
        turns = whole_number("repeat", repeat, 1, "WallOnBed.cycles")
        return self.along([x for a in np.ravel(sizes) for x in (a, *(-a, a) * turns)])

    def along(self, displacements: Sequence[float]) -> WallPath:
        """Path from upright along displacements, between which it does not turn.

        Parameters
        ----------
        displacements : sequence of float
            Displacements (m,) [m].

        Returns
        -------
        WallPath
            Displacements and forces.

        Raises
        ------
        ValueError
            For displacements that are not finite.
        """
        (targets,) = numbers("WallOnBed.along", displacements=displacements)
        require(targets.ndim == 1, "WallOnBed.along", "displacements", targets, "give a list")
        of = _equations(self)
        states = [self._upright(of)]
        for target in targets:
            states += self._to(of, states[-1], float(target))
        displacement, heave, elastic, work = map(np.array, zip(*states, strict=True))
        pressed = np.maximum(elastic, 0.0)
        forces = self._stiffness * pressed
        moment = forces @ of.turning + of.p_delta * displacement / of.height
        energy = (forces * pressed).sum(axis=1) / 2
        return WallPath(displacement, moment / of.height, heave, forces.sum(axis=1), energy, work)

    @property
    def _stiffness(self) -> float:
        """Stiffness of each spring [N/m]."""
        return self.bed_modulus * self.length * self.thickness / self.springs

    @property
    def _limit(self) -> float:
        """Elastic compression at which a spring crushes [m]."""
        return self.strength / self.bed_modulus

    def _upright(self, of: _Equations) -> _State:
        settled = of.axial / (self.springs * self._stiffness)
        return _State(0.0, settled / of.rising, np.full(self.springs, settled), 0.0)

    def _to(self, of: _Equations, state: _State, target: float) -> Iterator[_State]:
        """States at the events on the way to a displacement, and there."""
        while state.displacement != target:
            way = float(np.sign(target - state.displacement))
            held = of.turning * way / of.height  # rates of compression, the heave held
            heave = _rate_of_heave(held, of.rising, state.elastic, self._limit)
            state = self._next(state, target, heave, held + of.rising * heave)
            yield state

    def _next(self, state: _State, target: float, heave: float, closing: np.ndarray) -> _State:
        """The state at the next event, or at the target. heave, closing (n,) : rates on the way."""
        now, limit = state.elastic, self._limit
        flows = (now == limit) & (closing > 0)
        ends = np.where(closing > 0, np.where(now < 0, 0.0, limit), np.where(now > 0, 0.0, -np.inf))
        moving = (closing != 0) & ~flows
        ways = np.full(now.shape, np.inf)
        np.divide(ends - now, closing, out=ways, where=moving)
        left = target - state.displacement
        step = min(ways.min(), abs(left))
        elastic = np.where(ways == step, ends, np.where(flows, now, now + closing * step))
        there = step == abs(left)
        return _State(
            target if there else state.displacement + np.copysign(step, left),
            state.heave + heave * step,
            elastic,
            state.plastic_work + self._stiffness * limit * closing[flows].sum() * step,
        )


def _rate_of_heave(held: np.ndarray, rising: float, elastic: np.ndarray, limit: float) -> float:
    """The rate at which the sum of the springs' forces stays as it is.

    held (n,) : rates of compression while the heave is held; rising : the one by the heave. A
    spring that just touches has a stiffness as it closes, and one that crushes as it opens, so that
    the rate of the sum is a polygon over the rate of heave, which does not fall.
    """
    touches, crushes = elastic == 0, elastic == limit

    def stiff(closing: np.ndarray) -> np.ndarray:
        return np.where(touches, closing > 0, np.where(crushes, closing < 0, elastic > 0))

    def gain(heave: float) -> float:
        closing = held + rising * heave
        return rising * closing[stiff(closing)].sum()

    still = -held / rising  # rates of heave at which each compression stays
    corners = np.sort([still.min(), *still[touches | crushes], still.max()])
    after = bisect_left(corners, 0.0, 1, len(corners) - 1, key=gain)
    middle = corners[after - 1 : after + 1].mean()
    acting = stiff(held + rising * middle)
    return float(-held[acting].mean() / rising if acting.any() else middle)


def _equations(wall: WallOnBed) -> _Equations:
    places = wall.length * ((np.arange(wall.springs) + 0.5) / wall.springs - 0.5)
    p_delta, axial, height, turning, rising = _derived(wall.following)(
        wall.axial_force, wall.shear_span, places
    )
    return _Equations(p_delta, axial, height, turning, rising)


@functools.cache
def _derived(following: bool) -> Callable[..., tuple]:
    """The coefficients as a function of (axial force, shear span, places of springs)."""
    model = walls.wall_on_bed(1, following)
    free = small_rotations(model.free)
    q = [c.position for c in model.coordinates]
    x = sp.Symbol("x", real=True)
    turning, rising = (sp.diff(walls.compression(x), c).subs(dict.fromkeys(q, 0)) for c in q)
    wanted = free.stiffness[0, 0], free.constant[1], free.lever[0], turning, rising
    weightless = sp.Tuple(*wanted).subs(walls.MASS.symbol, 0)  # the axial force has the weight
    return sp.lambdify([walls.AXIAL_FORCE.symbol, walls.SHEAR_SPAN.symbol, x], list(weightless))
