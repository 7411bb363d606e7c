"""The laws of the package on the impacts of these tests: impulses from numbers alone."""

import numpy as np

from rockeom.codes import NEVER_SLIPS
from tests.contact.laws_alone import impulses
from tests.impacts.mechanics import Impact


def by_package(problem: Impact, law: str, **numbers: np.ndarray) -> np.ndarray:
    """(P, Q) of a law of the package, Q summed over contacts of one slip."""
    m, g, G = len(problem.normal), len(problem.slip), problem.delassus
    rows = [row for i in range(m) for row in (i, m + problem.slips_with[i])]
    if law in ("lzb", "pairwise"):
        numbers["k"] = problem.stiffness
    mu = np.where(np.isinf(problem.friction), NEVER_SLIPS, problem.friction)
    u, s = problem.rates[:m], problem.rates[m:]
    P, Q = impulses(
        law, G[np.ix_(rows, rows)], u, s[list(problem.slips_with)], problem.restitution, mu,
        **numbers,
    )  # fmt: skip
    sums = np.zeros(g)
    np.add.at(sums, list(problem.slips_with), Q)
    return np.concatenate([P, sums])
