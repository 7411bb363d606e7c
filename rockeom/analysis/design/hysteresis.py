"""Hysteresis: the rules of thesis Figure 2-21, their loops and damping.

    from rockeom.analysis import design

    flag = design.FlagRule(yield_force=20e3, yield_displacement=2e-3, stiffness_ratio=0.05,
                             flag_height=0.35)
    flag.loop(ductility=4.0).damping  # of the closed loop, as a function
    flag.simulated_loop(ductility=4.0).damping  # of a displacement to and fro
    flag.damping(ductility=4.0)  # by thesis 2-32c

A rule goes from one displacement to the next; as long as it does not turn back in between, the
step may be of any length and the force is exact. The memory of a rule is an array (k, n) of n
springs, so that a time integration may try a step and reject it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.formulas import damping
from rockeom.numbers.checks import not_negative, numbers, positive, require


class HysteresisLoop(NamedTuple):
    """Closed loop of force against displacement, straight between its points.

    Parameters
    ----------
    displacement : ndarray
        Displacements of the points (n,) [m].
    force : ndarray
        Forces of the points (n,) [N].
    """

    displacement: np.ndarray
    force: np.ndarray

    @property
    def area(self) -> float:
        """Energy that a cycle loses [J]."""
        u, f = self
        return float(abs(((u + np.roll(u, 1)) * (f - np.roll(f, 1))).sum()) / 2)

    @property
    def damping(self) -> float:
        """The area over 2 pi F_m u_m, of the largest force and displacement; Jacobsen (1930)."""
        return self.area / (2 * np.pi * np.abs(self.force).max() * np.abs(self.displacement).max())


class HysteresisStep(NamedTuple):
    """Force after a step, and the memory of the rule then.

    Parameters
    ----------
    force : ndarray
        Force of each spring (n,) [N].
    memory : ndarray
        Memory of the rule (k, n).
    """

    force: np.ndarray
    memory: np.ndarray


@dataclass(frozen=True)
class HysteresisRule:
    """Common part of the rules: elastic up to yield, and a stiffness after it.

    Parameters
    ----------
    yield_force : float
        Force F_y at yield [N].
    yield_displacement : float
        Displacement u_y at yield [m].
    stiffness_ratio : float
        Ratio k_p/k_i in [0, 1) of the stiffness after yield and the initial one, F_y/u_y.

    Raises
    ------
    ValueError
        For a force or a displacement that is not positive, and a ratio outside its range.
    """

    yield_force: float
    yield_displacement: float
    stiffness_ratio: float

    def __post_init__(self) -> None:
        name = type(self).__name__
        positive(name, yield_force=self.yield_force, yield_displacement=self.yield_displacement)
        (ratio,) = not_negative(name, stiffness_ratio=self.stiffness_ratio)
        require(ratio < 1, name, "stiffness_ratio", ratio, "k_p/k_i lies in [0, 1)")

    @property
    def stiffness(self) -> float:
        """The initial one, k_i [N/m]."""
        return self.yield_force / self.yield_displacement

    def backbone(self, displacement: ArrayLike) -> np.ndarray:
        """Force of the first loading.

        Parameters
        ----------
        displacement : array_like
            Displacement [m], any shape.

        Returns
        -------
        ndarray
            Force [N], in the shape of the displacement.
        """
        (u,) = numbers(f"{type(self).__name__}.backbone", displacement=displacement)
        return self._envelope(u)

    def start(self, number: int = 1) -> np.ndarray:
        """Memory of some springs before any displacement.

        Parameters
        ----------
        number : int, optional
            Number n of springs.

        Returns
        -------
        ndarray
            Memory (k, n) of the rule.
        """
        raise NotImplementedError

    def step(self, memory: np.ndarray, displacement: np.ndarray) -> HysteresisStep:
        """Force after going straight to a displacement.

        Parameters
        ----------
        memory : ndarray
            Memory (k, n) of n springs.
        displacement : ndarray
            Displacement of each (n,) [m].

        Returns
        -------
        HysteresisStep
            Force of each spring (n,) [N] and the memory then.
        """
        raise NotImplementedError

    def along(self, displacement: ArrayLike) -> np.ndarray:
        """Force along a path of displacements, of a spring that was never moved.

        Parameters
        ----------
        displacement : array_like
            Path (n,) [m].

        Returns
        -------
        ndarray
            Force (n,) [N].
        """
        (path,) = numbers(f"{type(self).__name__}.along", displacement=displacement)
        memory, forces = self.start(), np.empty(len(path))
        for i, u in enumerate(path):
            force, memory = self.step(memory, np.array([u]))
            forces[i] = force[0]
        return forces

    def loop(self, ductility: float) -> HysteresisLoop:
        """Corners of the closed loop between -ductility u_y and ductility u_y.

        Parameters
        ----------
        ductility : float
            Largest displacement over that at yield.

        Returns
        -------
        HysteresisLoop
            Loop by its corners.
        """
        mu = self._ductility(ductility)
        corners = np.array(self._half_loop(mu)).T
        u, f = np.concatenate([corners, -corners], axis=1)
        return HysteresisLoop(u * self.yield_displacement, f * self.yield_force)

    def simulated_loop(self, ductility: float, points: int = 200) -> HysteresisLoop:
        """Path of the second of two cycles to and fro.

        Parameters
        ----------
        ductility : float
            Largest displacement over that at yield.
        points : int, optional
            Number of points of the cycle besides the corners of `loop`, which are among them:
            between its points the loop is then straight.

        Returns
        -------
        HysteresisLoop
            Loop by its points.
        """
        largest = self._ductility(ductility) * self.yield_displacement
        corners = self.loop(ductility).displacement
        levels = np.union1d(corners, largest * np.cos(np.linspace(0, np.pi, points // 2 + 1)))
        cycle = np.concatenate([levels[::-1], levels[1:-1]])
        forces = self.along(np.concatenate([levels[levels > 0], cycle, cycle]))
        return HysteresisLoop(cycle, forces[-len(cycle) :])

    def damping(self, ductility: ArrayLike) -> np.ndarray:
        """Hysteretic damping ratio, by thesis 2-32.

        Parameters
        ----------
        ductility : array_like
            Largest displacement over that at yield, any shape.

        Returns
        -------
        ndarray
            Damping ratio, in the shape of the ductility.
        """
        raise NotImplementedError

    def _envelope(self, u: np.ndarray) -> np.ndarray:
        k, r = self.stiffness, self.stiffness_ratio
        yielded = np.maximum(np.abs(u) - self.yield_displacement, 0.0)
        return np.sign(u) * k * (np.minimum(np.abs(u), self.yield_displacement) + r * yielded)

    def _half_loop(self, mu: float) -> Sequence[tuple[float, float]]:
        """Corners in units of yield, on the way from the largest displacement to the opposite."""
        raise NotImplementedError

    def _ductility(self, value: float) -> float:
        (mu,) = numbers(f"{type(self).__name__}.loop", ductility=value)
        require(mu.ndim == 0, "loop", "ductility", value, "give one number")
        require(mu > 1, "loop", "ductility", mu, "up to 1 nothing yields: give more than 1")
        return float(mu)


class _BetweenBounds(HysteresisRule):
    """A rule that is elastic between two bounds and follows them; its memory is F - k_i u."""

    def start(self, number: int = 1) -> np.ndarray:
        return np.zeros((1, number))

    def step(self, memory: np.ndarray, displacement: np.ndarray) -> HysteresisStep:
        elastic = self.stiffness * displacement
        low, high = self._bounds(displacement)
        force = np.clip(elastic + memory[0], low, high)
        return HysteresisStep(force, (force - elastic)[None])

    def _bounds(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        raise NotImplementedError


@dataclass(frozen=True)
class BilinearRule(_BetweenBounds):
    """Elastic and plastic with kinematic hardening; thesis Figure 2-21, 2-32a.

    It unloads with the initial stiffness over twice the yield force.

    Parameters
    ----------
    yield_force : float
        Force F_y at yield [N].
    yield_displacement : float
        Displacement u_y at yield [m].
    stiffness_ratio : float
        Ratio k_p/k_i in [0, 1) of the stiffness after yield and the initial one, F_y/u_y.
    """

    def damping(self, ductility: ArrayLike) -> np.ndarray:
        """Hysteretic damping ratio, by thesis 2-32a.

        Parameters
        ----------
        ductility : array_like
            Largest displacement over that at yield, any shape.

        Returns
        -------
        ndarray
            Damping ratio, in the shape of the ductility.
        """
        return damping.bilinear_damping(ductility, self.stiffness_ratio)

    def _bounds(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        hardened = self.stiffness_ratio * self.stiffness * u
        width = (1 - self.stiffness_ratio) * self.yield_force
        return hardened - width, hardened + width

    def _half_loop(self, mu: float) -> Sequence[tuple[float, float]]:
        force = 1 + self.stiffness_ratio * (mu - 1)
        return (mu, force), (mu - 2, force - 2)


@dataclass(frozen=True)
class FlagRule(_BetweenBounds):
    """Rule that returns to the origin: a controlled rocking structure; thesis Figure 2-21, 2-32c.

    Parameters
    ----------
    yield_force : float
        Force F_y at yield [N].
    yield_displacement : float
        Displacement u_y at yield [m].
    stiffness_ratio : float
        Ratio k_p/k_i in [0, 1) of the stiffness after yield and the initial one, F_y/u_y.
    flag_height : float, optional
        Height beta_FS of the flag: the gap between loading and unloading at the same displacement,
        over the yield force, up to 1 - k_p/k_i.
    """

    flag_height: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        (height,) = not_negative("FlagRule", flag_height=self.flag_height)
        rule = "above 1 - stiffness_ratio it does not return to the origin; it is no flag"
        require(height <= 1 - self.stiffness_ratio, "FlagRule", "flag_height", height, rule)

    def damping(self, ductility: ArrayLike) -> np.ndarray:
        """Hysteretic damping ratio, by thesis 2-32c.

        Parameters
        ----------
        ductility : array_like
            Largest displacement over that at yield, any shape.

        Returns
        -------
        ndarray
            Damping ratio, in the shape of the ductility.
        """
        return damping.flag_damping(ductility, self.stiffness_ratio, self.flag_height)

    def _bounds(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        side, size = np.sign(u), np.abs(u)
        outer = np.abs(self._envelope(u))
        unloading = (1 - self.stiffness_ratio - self.flag_height) * self.yield_force
        unloading = unloading + self.stiffness_ratio * self.stiffness * size
        inner = np.minimum(self.stiffness * size, unloading)
        return np.where(side > 0, inner, -outer), np.where(side > 0, outer, -inner)

    def _half_loop(self, mu: float) -> Sequence[tuple[float, float]]:
        r, height = self.stiffness_ratio, self.flag_height
        force, fall = 1 + r * (mu - 1), height / (1 - r)
        lowest = 1 - fall  # where the unloading meets the elastic line
        return (mu, force), (mu - fall, force - fall), (lowest, lowest), (-1.0, -1.0)


@dataclass(frozen=True)
class TakedaRule(HysteresisRule):
    """Rule softer on unloading that aims at the last peak; thesis Figure 2-21, 2-32b.

    Parameters
    ----------
    yield_force : float
        Force F_y at yield [N].
    yield_displacement : float
        Displacement u_y at yield [m].
    stiffness_ratio : float
        Ratio k_p/k_i in [0, 1) of the stiffness after yield and the initial one, F_y/u_y.
    unloading_exponent : float, optional
        Exponent alpha_T in [0, 1): from a peak of the ductility mu the rule unloads with k_i
        mu^-alpha_T.

    Notes
    -----
    From zero force it goes straight to the largest displacement that there was on the other side,
    or to yield. Otani's beta, which lets it aim at less, is 0, as in 2-32b.
    """

    unloading_exponent: float = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        (exponent,) = not_negative("TakedaRule", unloading_exponent=self.unloading_exponent)
        rule = "alpha_T lies in [0, 1)"
        require(exponent < 1, "TakedaRule", "unloading_exponent", exponent, rule)

    def damping(self, ductility: ArrayLike) -> np.ndarray:
        """Hysteretic damping ratio, by thesis 2-32b.

        Parameters
        ----------
        ductility : array_like
            Largest displacement over that at yield, any shape.

        Returns
        -------
        ndarray
            Damping ratio, in the shape of the ductility.
        """
        return damping.takeda_damping(ductility, self.stiffness_ratio, self.unloading_exponent)

    def start(self, number: int = 1) -> np.ndarray:
        """Memory of some springs before any displacement.

        Parameters
        ----------
        number : int, optional
            Number n of springs.

        Returns
        -------
        ndarray
            Displacement, force, largest displacement of either side, and that of zero force (5, n).
        """
        memory = np.zeros((5, number))
        memory[2:4] = self.yield_displacement
        return memory

    def step(self, memory: np.ndarray, displacement: np.ndarray) -> HysteresisStep:
        """Force after going straight to a displacement.

        Parameters
        ----------
        memory : ndarray
            Memory of n springs, as in `start`.
        displacement : ndarray
            Displacement of each (n,) [m].

        Returns
        -------
        HysteresisStep
            Force of each spring (n,) [N] and the memory then.
        """
        u0, f0, right, left, zero = memory
        way = np.sign(displacement - u0)
        side = np.where(f0 != 0, np.sign(f0), way)
        peak = np.where(side > 0, right, left)
        stiffness = self.stiffness * (self.yield_displacement / peak) ** self.unloading_exponent
        trial = f0 + stiffness * (displacement - u0)
        crossed = trial * side <= 0
        zero = np.where(crossed | (f0 == 0), u0 - f0 / stiffness, zero)
        side = np.where(crossed, way, side)
        aimed = self._reloading(side * displacement, side * zero, np.where(side > 0, right, left))
        kept = np.minimum(side * trial, aimed)
        force = side * np.maximum(np.where(crossed | (f0 == 0), aimed, kept), 0.0)
        right, left = np.maximum(right, displacement), np.maximum(left, -displacement)
        return HysteresisStep(force, np.array([displacement + 0 * u0, force, right, left, zero]))

    def _reloading(self, u: np.ndarray, zero: np.ndarray, peak: np.ndarray) -> np.ndarray:
        """Forces on the way from zero to the peak, and on the envelope beyond it."""
        line = self._envelope(peak) * (u - zero) / (peak - zero)
        return np.where(u < peak, line, self._envelope(u))

    def _half_loop(self, mu: float) -> Sequence[tuple[float, float]]:
        self.damping(mu)  # raises where the unloading would pass the origin
        force = 1 + self.stiffness_ratio * (mu - 1)
        return (mu, force), (mu - force * mu**self.unloading_exponent, 0.0)
