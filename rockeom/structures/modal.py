"""Small motion of a structure whose feet cannot lift: its modes of vibration, and its damping.

Such a structure has the generated module of the rocking one without the guards that end its full
contact: the same equations, energies and forces, and no way out of that mode.
"""

import functools
import re
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from rockeom.integrator.schema import GeneratedModule, still_ground
from rockeom.integrator.texts import load_text, source
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, array_of, require
from rockeom.numbers.functions import for_arrays

FULL_CONTACT = "both"


def free_states(module: GeneratedModule, p: np.ndarray) -> np.ndarray:
    """(N,) whether a state may differ from zero in full contact."""
    m = for_arrays(module, p)
    n = m.N_STATES // 2
    rates = np.zeros(m.N_STATES, p.dtype)
    moving = np.repeat([0.0, 1.0], n)
    m.rates(m.MODES.index(FULL_CONTACT), moving, p, *still_ground(m), rates)
    return np.tile(rates[:n] != 0.0, 2)


class Modal:
    """Modes of vibration about rest, n of them, the slowest first.

    module : that of the structure, p its parameters and constants, free (N,) the states that may
    differ from zero.
    """

    def __init__(self, module: GeneratedModule, p: np.ndarray, free: np.ndarray) -> None:
        self._module, self._p, self._free = module, p, free

    @functools.cached_property
    def _small_motion(self) -> np.ndarray:
        """(2 n, 2 n) of the rates by the states that move, about rest."""
        m = self._module
        n = m.N_STATES // 2
        mode = m.MODES.index(FULL_CONTACT)
        free = np.flatnonzero(self._free)

        def rates(y: np.ndarray) -> np.ndarray:
            out = np.zeros(m.N_STATES)
            m.rates(mode, y, self._p, *still_ground(m), out)
            return out[free]

        # millimetres and mm/s, or thousandths of whatever a coordinate counts
        steps = 1e-3 * np.eye(2 * n)[free]
        return np.transpose([(rates(h) - rates(-h)) / 2e-3 for h in steps])

    @functools.cached_property
    def _eigenvalues(self) -> np.ndarray:
        """(n,) of small motion about rest, one of each pair."""
        values = np.linalg.eigvals(self._small_motion)
        return np.array(sorted(values[values.imag >= 0.0], key=abs))

    @property
    def periods(self) -> np.ndarray:
        """(n,) of the undamped modes [s]."""
        return 2.0 * np.pi / np.abs(self._eigenvalues)

    @property
    def damping_ratios(self) -> np.ndarray:
        """(n,) parts of critical damping."""
        return np.array([-value.real / abs(value) for value in self._eigenvalues])

    @functools.cached_property
    def _shapes(self) -> np.ndarray:
        """(coordinates that move, n) of the undamped modes; the largest is 1."""
        n = len(self._small_motion) // 2
        squares, shapes = np.linalg.eig(-self._small_motion[n:, :n])
        shapes = shapes[:, np.argsort(squares.real)].real
        return shapes / shapes[np.abs(shapes).argmax(axis=0), np.arange(n)]

    @property
    def shapes_by_name(self) -> dict[str, np.ndarray]:
        """(n,) of each coordinate that moves."""
        half = self._free[: len(self._free) // 2]
        names = [self._module.STATES[i] for i in np.flatnonzero(half)]
        return dict(zip(names, self._shapes, strict=True))

    @property
    def effective_masses(self) -> np.ndarray:
        """(n,) [kg], see `FixedBase.effective_masses`."""
        m = self._module
        n = m.N_STATES // 2
        mode = m.MODES.index(FULL_CONTACT)
        free = np.flatnonzero(self._free[:n]).tolist()
        upright, shaken = np.zeros(m.N_STATES), np.zeros(m.N_STATES)
        m.rates(mode, upright, self._p, 1.0, 0.0, shaken)

        def twice_kinetic(*moving: int) -> float:
            y, out = np.zeros(m.N_STATES), np.zeros(len(m.ENERGIES))
            y[n + np.array(moving)] = 1.0
            m.energies(mode, y, self._p, out)
            return 2.0 * float(out[m.ENERGIES.index("kinetic_energy")])

        alone = {i: twice_kinetic(i) for i in free}

        def mass(i: int, j: int) -> float:
            return alone[i] if i == j else 0.5 * (twice_kinetic(i, j) - alone[i] - alone[j])

        masses = np.array([[mass(i, j) for j in free] for i in free])
        pushed = self._shapes.T @ masses @ -shaken[n + np.array(free)]
        return pushed**2 / np.einsum("im,ij,jm->m", self._shapes, masses, self._shapes)


class RayleighDamping(NamedTuple):
    """Damping alpha M + beta K.

    Parameters
    ----------
    alpha : float
        Factor of the masses [1/s].
    beta : float
        Factor of the stiffnesses [s].
    """

    alpha: float
    beta: float

    def ratio(self, period: ArrayLike) -> np.ndarray:
        """Parts of critical damping of modes.

        Parameters
        ----------
        period : array_like
            Undamped periods [s], any shape.

        Returns
        -------
        ndarray
            Parts, in the shape of the periods.
        """
        omega = 2.0 * np.pi / array_of("period", period, "RayleighDamping.ratio")
        return 0.5 * (self.alpha / omega + self.beta * omega)


@explained.calls()
def rayleigh_damping(periods: ArrayLike, ratios: ArrayLike) -> RayleighDamping:
    """Factors alpha and beta with which modes of two periods have parts of critical damping.

    Parameters
    ----------
    periods : array_like
        Periods of two modes [s]; or of one, whose damping is then of the stiffnesses alone.
    ratios : array_like
        Parts of critical damping of these modes.

    Returns
    -------
    RayleighDamping
        Factors alpha [1/s] and beta [s].

    Raises
    ------
    ValueError
        For other numbers of modes, for numbers that are not positive or finite, and for two equal
        periods.

    Notes
    -----
    A `ShearFrame` has a damper in each storey and none between a floor and the base. The part of
    beta, a damper of beta times the stiffness in each storey, comes from ``frame.damped(0.02)``.
    The part of alpha needs a damper of alpha times its mass between each floor and the base:
    declare it in a model of your own, ``Spring("held_1", u_1, damping=alpha * m_1)``.

    References
    ----------
    A. K. Chopra, Dynamics of Structures, section 11.4.1.

    Examples
    --------
    >>> import rockeom as rk
    >>> rayleigh = rk.rayleigh_damping(periods=(0.8, 0.2), ratios=(0.05, 0.05))
    >>> round(float(rayleigh.ratio(0.8)), 3)
    0.05

    For a frame on a fixed base::

        alpha, beta = rk.rayleigh_damping(frame.fixed_base().periods[:2], [0.02, 0.02])
    """
    t = np.atleast_1d(array_of("periods", periods, "rayleigh_damping"))
    zeta = np.atleast_1d(array_of("ratios", ratios, "rayleigh_damping"))
    if t.shape != zeta.shape or t.ndim != 1 or len(t) not in (1, 2):
        raise InputError("periods", of="rayleigh_damping").wrong(
            f"have the shape {t.shape}, ratios {zeta.shape}: give two of each, or one"
        )
    if not (np.isfinite([t, zeta]).all() and (t > 0).all() and (zeta >= 0).all()):
        raise InputError("periods", t.tolist(), "rayleigh_damping").wrong(
            f"are {t.tolist()} s, ratios {zeta.tolist()}: give positive periods and ratios that "
            "are not negative, such as 0.02"
        )
    omega = 2.0 * np.pi / t
    if len(t) == 1:
        return RayleighDamping(0.0, float(2.0 * zeta[0] / omega[0]))
    require(bool(t[0] != t[1]), "rayleigh_damping", "periods", periods, "give those of two modes")
    alpha, beta = np.linalg.solve(np.column_stack([0.5 / omega, 0.5 * omega]), zeta)
    return RayleighDamping(float(alpha), float(beta))


def held(rocking: GeneratedModule) -> GeneratedModule:
    """The module with no guard in full contact."""
    name = f"{rocking.NAME}_fixed_base"
    guards = tuple(
        0 if mode == FULL_CONTACT else count
        for mode, count in zip(rocking.MODES, rocking.GUARDS, strict=True)
    )
    text = _with(source(rocking), "NAME", repr(name).replace("'", '"'))
    return cast(GeneratedModule, load_text(name, _with(text, "GUARDS", repr(guards))))


def _with(text: str, name: str, value: str) -> str:
    """A module's text with another value of a constant, which is text or a flat tuple."""
    changed, times = re.subn(rf"(?m)^{name} = (\"\w+\"|\([^()]*\))", f"{name} = {value}", text)
    assert times == 1, f"a generated module says {name} once"
    return changed
