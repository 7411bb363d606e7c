"""Pickles and copies of objects with cached properties."""

from functools import cached_property
from typing import Any


def made_of(self: object) -> dict[str, Any]:
    """The fields of an object without its cached properties: for `__getstate__`.

    Modules and machine code are among these: another process computes them again.
    """
    of = type(self)
    return {
        name: value
        for name, value in vars(self).items()
        if not isinstance(getattr(of, name, None), cached_property)
    }
