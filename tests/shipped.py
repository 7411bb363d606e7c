"""Parameters for a shipped structure of which nothing is known but what its module says."""

import dataclasses
import importlib
import zlib
from collections.abc import Callable

import numpy as np

from rockeom.structures.classes import SHIPPED


def plain(name: str, size: Callable[[], float] | None = None) -> dict[str, float]:
    """What the class must be given, of some size each; zero for what may be of either sign.

    size : draws one; about 1 if not given, and then always the same. Draws that contradict one
    another are drawn anew.
    """
    cls, module = SHIPPED[name], importlib.import_module(f"rockeom.generated.{name}")
    signs = dict(zip(module.PARAMETERS, module.PARAMETER_SIGNS, strict=True))
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    size = size or (lambda: float(rng.uniform(0.5, 2.0)))
    for _ in range(100):
        of_sign = {"+": size, "+-": lambda: 0.0, "n": lambda: float(rng.integers(1, 5))}
        values = {
            parameter: of_sign[signs.get(parameter, "+")]()
            for parameter, default in cls.defaults().items()
            if default is dataclasses.MISSING
        }
        try:
            cls(**values)
        except ValueError as error:
            said = error
        else:
            return values
    raise ValueError(f"no parameters about 1 make a {name}, give it some by hand: {said}")


def stands_on_points(name: str) -> bool:
    """Whether the contacts of a shipped structure were declared, and its modes derived."""
    return hasattr(importlib.import_module(f"rockeom.generated.{name}"), "POINTS")


PINNED = tuple(name for name in SHIPPED if not stands_on_points(name))
"""Those that were declared mode by mode: their feet do not slip, nor bounce."""
