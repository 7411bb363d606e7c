"""A structure whose feet cannot lift: the one beside which rocking is judged.

It is the generated module of the rocking one without the guards that end its full contact: the same
equations, energies and forces, and no way out of the contact state in which both feet stand.
"""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from types import ModuleType
from typing import ClassVar

import numpy as np

from rockeom.numeric.impact import ImpactLaw
from rockeom.numeric.program import load_text, source
from rockeom.numeric.structures import Structure

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
        return m.CONTACTS.index(FULL_CONTACT)

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
        m.rates(m.CONTACTS.index(FULL_CONTACT), moving, p, 0.0, 0.0, rates)
        return np.tile(rates[:n] != 0.0, 2)

    @functools.cached_property
    def _modes(self) -> np.ndarray:
        """(n,) eigenvalues of small motion about standing, one of each pair, the slowest first."""
        m = self.module
        n = m.N_STATES // 2
        contact = m.CONTACTS.index(FULL_CONTACT)
        free = np.flatnonzero(self._free)

        def rates(y: np.ndarray) -> np.ndarray:
            out = np.zeros(m.N_STATES)
            m.rates(contact, y, self.vector, 0.0, 0.0, out)
            return out[free]

        # millimetres and mm/s, or thousandths of whatever a coordinate counts
        steps = 1e-3 * np.eye(2 * n)[free]
        matrix = np.transpose([(rates(h) - rates(-h)) / 2e-3 for h in steps])
        found = np.linalg.eigvals(matrix)
        return np.array(sorted(found[found.imag >= 0.0], key=abs))

    @property
    def periods(self) -> np.ndarray:
        """(n,) periods of its undamped modes, of small motion about standing, longest first [s]."""
        return 2.0 * np.pi / np.abs(self._modes)

    @property
    def damping_ratios(self) -> np.ndarray:
        """(n,) parts of critical damping of the modes, in the order of `periods`."""
        return np.array([-mode.real / abs(mode) for mode in self._modes])


def _held(rocking: ModuleType) -> ModuleType:
    """The module with no guard in full contact."""
    name = f"{rocking.NAME}_fixed_base"
    guards = tuple(
        0 if contact == FULL_CONTACT else count
        for contact, count in zip(rocking.CONTACTS, rocking.GUARDS, strict=True)
    )
    text = _with(source(rocking), "NAME", repr(name).replace("'", '"'))
    return load_text(name, _with(text, "GUARDS", repr(guards)))


def _with(text: str, name: str, value: str) -> str:
    """A module's text with another value of a constant, which is text or a flat tuple."""
    changed, times = re.subn(rf"(?m)^{name} = (\"\w+\"|\([^()]*\))", f"{name} = {value}", text)
    assert times == 1, f"a generated module says {name} once"
    return changed
