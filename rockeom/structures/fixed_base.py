"""A structure whose feet cannot lift: the one beside which rocking is judged.

It is the generated module of the rocking one without the guards that end its full contact: the same
equations, energies and forces, and no way out of the contact state in which both feet stand.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from types import ModuleType
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rockeom.integrator.texts import load_text, source
from rockeom.numbers.checks import numbers
from rockeom.structures.classes import Structure
from rockeom.structures.impact_laws import ImpactLaw

FULL_CONTACT = "both"


@dataclass(frozen=True)
class FixedBase(Structure):
    """What `structure.fixed_base()` makes: `rocking` with feet that are held down.

    Its forces on the feet may pull: `run.extremes("left_reaction").minimum` is what the ground has
    to hold. There are no impacts, and no rotation.

    Raises ValueError for a structure without full contact on rigid ground, and for one that cannot
    move in it.
    """

    pulled: ClassVar[str] = "it has to be held down"
    rocking: Structure

    def __post_init__(self) -> None:
        if not self.rocking.rocks_on_rigid_ground:
            raise ValueError(
                f"{self.rocking.model} has no full contact on rigid ground, in which its feet "
                "could be held: take a FlexibleStructure, a FlexibleControlledWall or a structure "
                "of your own"
            )
        if not self._free.any():
            raise ValueError(
                f"{self.rocking.model} is rigid: it has no degree of freedom left once its feet "
                "are held; take a structure with an elastic column, such as FlexibleStructure"
            )

    @functools.cached_property
    def module(self) -> ModuleType:
        return _held(self.rocking.module)

    @property
    def model(self) -> str:  # type: ignore[override]
        return self.module.NAME

    def parameters(self) -> dict[str, float]:
        """Those of the structure that rocks."""
        return self.rocking.parameters()

    @property
    def has_impacts(self) -> bool:
        return False

    @property
    def uplift_acceleration(self) -> None:
        """None: nothing lifts it."""
        return None

    def hints(self) -> tuple[str, ...]:
        return self.rocking.hints()

    def fixed_base(self) -> FixedBase:
        """Itself."""
        return self

    def contact(self, y: np.ndarray, phase: str | None = None, towards: float = 0.0) -> int:
        """Full contact; raises ValueError for a state that is turned, or for another phase."""
        m = self.module
        held = [m.STATES[i] for i in np.flatnonzero(~self._free) if y[i] != 0.0]
        if held:
            raise ValueError(f"{held[0]} is {y[m.STATES.index(held[0])]}: it is held at zero")
        if phase not in (None, FULL_CONTACT):
            raise ValueError(f"no phase {phase!r} of {self.model}: its feet stay on the ground")
        return m.MODES.index(FULL_CONTACT)

    def law(self, impact: ImpactLaw | None) -> tuple[int, float]:
        """Raises ValueError for a law: there are no impacts."""
        if impact is not None:
            raise ValueError(f"{self.model} has no impacts: leave `impact` out")
        return 0, 1.0

    def pushover(self, rotations) -> np.ndarray:
        """Raises ValueError: it has no rotation by which it could be pushed."""
        raise ValueError(f"{self.model} does not turn: ask the pushover of the one that rocks")

    @functools.cached_property
    def _free(self) -> np.ndarray:
        """(N,) whether a state may differ from zero in full contact."""
        p = self.rocking.vector
        m = self.rocking.module_for(p)
        n = m.N_STATES // 2
        rates = np.zeros(m.N_STATES, p.dtype)
        moving = np.repeat([0.0, 1.0], n)
        m.rates(m.MODES.index(FULL_CONTACT), moving, p, 0.0, 0.0, rates)
        return np.tile(rates[:n] != 0.0, 2)

    @functools.cached_property
    def _small_motion(self) -> np.ndarray:
        """(2 n, 2 n) of the rates by the states of what moves, about standing."""
        m = self.module
        n = m.N_STATES // 2
        contact = m.MODES.index(FULL_CONTACT)
        free = np.flatnonzero(self._free)

        def rates(y: np.ndarray) -> np.ndarray:
            out = np.zeros(m.N_STATES)
            m.rates(contact, y, self.vector, 0.0, 0.0, out)
            return out[free]

        # millimetres and mm/s, or thousandths of whatever a coordinate counts
        steps = 1e-3 * np.eye(2 * n)[free]
        return np.transpose([(rates(h) - rates(-h)) / 2e-3 for h in steps])

    @functools.cached_property
    def _modes(self) -> np.ndarray:
        """(n,) eigenvalues of small motion about standing, one of each pair, the slowest first."""
        found = np.linalg.eigvals(self._small_motion)
        return np.array(sorted(found[found.imag >= 0.0], key=abs))

    @property
    def periods(self) -> np.ndarray:
        """(n,) periods of its undamped modes, of small motion about standing, longest first [s]."""
        return 2.0 * np.pi / np.abs(self._modes)

    @functools.cached_property
    def _shapes(self) -> np.ndarray:
        """(coordinates that move, n) of the undamped modes, the slowest first; the largest is 1."""
        n = len(self._small_motion) // 2
        squares, shapes = np.linalg.eig(-self._small_motion[n:, :n])
        shapes = shapes[:, np.argsort(squares.real)].real
        return shapes / shapes[np.abs(shapes).argmax(axis=0), np.arange(n)]

    @property
    def mode_shapes(self) -> dict[str, np.ndarray]:
        """(n,) by coordinate: what it moves in each undamped mode, in the order of `periods`.

        The largest of a mode is 1. What a coordinate means `rockeom models NAME` tells: u_i of a
        frame is what floor i has moved relative to the base.
        """
        return dict(zip(self._moving, self._shapes, strict=True))

    @property
    def effective_masses(self) -> np.ndarray:
        """(n,) mass that the ground shakes in each mode [kg], in the order of `periods`.

        (phi' M r)**2/(phi' M phi), of a horizontal acceleration of the ground. Their sum is the
        mass of all that moves relative to a fixed base.
        Source: A. K. Chopra, Dynamics of Structures, section 13.2.
        """
        m = self.module
        n = m.N_STATES // 2
        contact = m.MODES.index(FULL_CONTACT)
        free = np.flatnonzero(self._free[:n]).tolist()
        upright, shaken = np.zeros(m.N_STATES), np.zeros(m.N_STATES)
        m.rates(contact, upright, self.vector, 1.0, 0.0, shaken)

        def twice_kinetic(*moving: int) -> float:
            y, out = np.zeros(m.N_STATES), np.zeros(len(m.ENERGIES))
            y[n + np.array(moving)] = 1.0
            m.energies(contact, y, self.vector, out)
            return 2.0 * float(out[m.ENERGIES.index("kinetic_energy")])

        alone = {i: twice_kinetic(i) for i in free}
        masses = np.array(
            [
                [
                    alone[i] if i == j else 0.5 * (twice_kinetic(i, j) - alone[i] - alone[j])
                    for j in free
                ]
                for i in free
            ]
        )
        pushed = self._shapes.T @ masses @ -shaken[n + np.array(free)]
        return pushed**2 / np.einsum("im,ij,jm->m", self._shapes, masses, self._shapes)

    @property
    def _moving(self) -> tuple[str, ...]:
        return tuple(
            self.module.STATES[i] for i in np.flatnonzero(self._free[: len(self._free) // 2])
        )

    @property
    def damping_ratios(self) -> np.ndarray:
        """(n,) parts of critical damping of the modes, in the order of `periods`."""
        return np.array([-mode.real / abs(mode) for mode in self._modes])


class RayleighDamping(NamedTuple):
    """Damping alpha M + beta K: alpha [1/s] of the masses, beta [s] of the stiffnesses."""

    alpha: float
    beta: float

    def ratio(self, period: ArrayLike) -> np.ndarray:
        """Parts of critical damping of modes of these undamped periods [s], of their shape."""
        omega = 2.0 * np.pi / numbers("RayleighDamping.ratio: period", period)
        return 0.5 * (self.alpha / omega + self.beta * omega)


def rayleigh_damping(periods: ArrayLike, ratios: ArrayLike) -> RayleighDamping:
    """alpha and beta that give modes of these periods these parts of critical damping.

    periods [s], ratios : of two modes; or of one, whose damping is then of the stiffnesses alone.

        held = frame.fixed_base()
        alpha, beta = rk.rayleigh_damping(held.periods[:2], [0.02, 0.02])

    A `ShearFrame` has a damper in each storey and none between a floor and the base: what beta
    asks for is beta times the stiffness of each, and `frame.damped(0.02)` gives it. What alpha asks
    for needs a damper alpha times the mass of each floor that holds it to the base: declare it in
    a model of your own, `Spring("held_1", u_1, damping=alpha * m_1)`.

    Raises ValueError for other numbers of modes, for what is not positive or finite, and for two
    equal periods.
    Source: A. K. Chopra, Dynamics of Structures, section 11.4.1.
    """
    given = (
        numbers("rayleigh_damping: periods", periods),
        numbers("rayleigh_damping: ratios", ratios),
    )
    t, zeta = (np.atleast_1d(x) for x in given)
    if t.shape != zeta.shape or t.ndim != 1 or len(t) not in (1, 2):
        raise ValueError(
            f"rayleigh_damping: periods have the shape {t.shape}, ratios {zeta.shape}: give two of "
            "each, or one"
        )
    if not (np.isfinite([t, zeta]).all() and (t > 0).all() and (zeta >= 0).all()):
        raise ValueError(
            f"rayleigh_damping: periods are {t.tolist()} s, ratios {zeta.tolist()}: give positive "
            "periods and ratios that are not negative, such as 0.02"
        )
    omega = 2.0 * np.pi / t
    if len(t) == 1:
        return RayleighDamping(0.0, float(2.0 * zeta[0] / omega[0]))
    if t[0] == t[1]:
        raise ValueError(f"rayleigh_damping: both periods are {t[0]} s: give those of two modes")
    alpha, beta = np.linalg.solve(np.column_stack([0.5 / omega, 0.5 * omega]), zeta)
    return RayleighDamping(float(alpha), float(beta))


def _held(rocking: ModuleType) -> ModuleType:
    """The module with no guard in full contact."""
    name = f"{rocking.NAME}_fixed_base"
    guards = tuple(
        0 if contact == FULL_CONTACT else count
        for contact, count in zip(rocking.MODES, rocking.GUARDS, strict=True)
    )
    text = _with(source(rocking), "NAME", repr(name).replace("'", '"'))
    return load_text(name, _with(text, "GUARDS", repr(guards)))


def _with(text: str, name: str, value: str) -> str:
    """A module's text with another value of a constant, which is text or a flat tuple."""
    changed, times = re.subn(rf"(?m)^{name} = (\"\w+\"|\([^()]*\))", f"{name} = {value}", text)
    assert times == 1, f"a generated module says {name} once"
    return changed
