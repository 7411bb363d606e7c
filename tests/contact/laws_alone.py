"""The impact laws of points as plain Python, by numbers alone: D, velocities, e, friction."""

from functools import cache

import numpy as np

from rockeom.codes import CONTACT_LAWS, NEVER_SLIPS
from tests.machine_code import plain_texts


@cache
def text(points, law):
    """The names of the texts, for so many points; each coordinate is a gap or a slip of its own."""
    names = {
        "N_STATES": 4 * points, "N_POINTS": points, "N_GUARDS": 1, "N_PARTS": 0, "ROTATION": 0,
        "N_ELEMENTS": 0, "IMPACT_LAW": law,
    }  # fmt: skip
    return plain_texts("transitions.impacts", **names)


def impulses(law, d, v, w, e, mu, k=None, e_t=None):
    """(P, Q) of m points: D (2m, 2m) in the order gap 1, slip 1, ...; rates v, w (m,) before.

    e, mu (None: never slips), k, e_t : of each, or of all. Raises ValueError where no impulses fit.
    """
    m = len(v)
    names = text(m, CONTACT_LAWS[law])
    known = np.zeros(names["CONTACT_SIZE"])
    rate = np.column_stack([v, w]).ravel().astype(float)
    known[names["COUPLING"] :] = np.asarray(d, float).ravel()
    laws = known[names["LAWS"] : names["LAWS"] + 2 * m]
    laws[::2] = e
    laws[1::2] = NEVER_SLIPS if mu is None else mu
    number = {"moreau": -1.0 if e_t is None else e_t}.get(law, 1.0 if k is None else k)
    numbers = np.broadcast_to(np.asarray(number, float), m).copy()
    whole = float(rate @ np.linalg.pinv(d, rcond=1e-10, hermitian=True) @ rate)
    near, sizes, impulse = np.ones(m, np.int64), np.empty(3 * m), np.zeros(2 * m)
    names["sizes_of"](whole, known, sizes)
    rate[np.abs(rate) <= 1e-11 * sizes[: 2 * m]] = 0.0
    if not names["impulses_grow"](near, numbers, whole, known, sizes, rate, impulse):
        raise ValueError(f"no impulses of {law} fit")
    return impulse[::2], impulse[1::2]
