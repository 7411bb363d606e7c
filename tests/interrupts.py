"""A keyboard interrupt in the midst of long work."""

import functools
import itertools
from collections.abc import Callable
from typing import Any


def interrupted_at(call: int, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, the n-th call of which is interrupted."""
    calls = itertools.count(1)

    @functools.wraps(function)
    def counted(*args: Any, **kwargs: Any) -> Any:
        if next(calls) == call:
            raise KeyboardInterrupt
        return function(*args, **kwargs)

    return counted
