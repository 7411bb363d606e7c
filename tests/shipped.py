"""Parameters for a shipped structure of which nothing is known but what its module says."""

import dataclasses
import importlib
from collections.abc import Callable

from rockeom.numeric.structures import SHIPPED


def plain(name: str, size: Callable[[], float] = lambda: 1.0) -> dict[str, float]:
    """What the class must be given, each of some size; zero for what may be of either sign."""
    cls, module = SHIPPED[name], importlib.import_module(f"rockeom.generated.{name}")
    signs = dict(zip(module.PARAMETERS, module.PARAMETER_SIGNS, strict=True))
    return {
        parameter: size() if signs.get(parameter, "+") == "+" else 0.0
        for parameter, default in cls.defaults().items()
        if default is dataclasses.MISSING
    }
