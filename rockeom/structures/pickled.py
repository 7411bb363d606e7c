"""What of an object is pickled and copied."""

from __future__ import annotations

from functools import cached_property
from typing import Any


def made_of(self: object) -> dict[str, Any]:
    """What an object was made of, without what was found out of it: for `__getstate__`.

    Modules and machine code are among what is found: another process finds them again.
    """
    of = type(self)
    return {
        name: value
        for name, value in vars(self).items()
        if not isinstance(getattr(of, name, None), cached_property)
    }
