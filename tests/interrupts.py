"""A keyboard interrupt in the midst of long work."""

import functools
import itertools
import math
import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
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


class Interrupting:
    """A block in which the n-th call of any function of the package is interrupted.

    In the thread of the caller, as by a signal: between any two calls, but not at a moment that the
    clock decides. calls : how many there were. called : file and name of each function.
    """

    def __init__(self, at: float = math.inf) -> None:
        self.at, self.calls = at, 0
        self.called: set[tuple[str, str]] = set()

    def __enter__(self) -> "Interrupting":
        sys.setprofile(self._look)
        return self

    def __exit__(self, *_: object) -> None:
        sys.setprofile(None)

    def _look(self, frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_globals.get("__name__", "").startswith("rockeom"):
            self.calls += 1
            self.called.add((Path(frame.f_code.co_filename).name, frame.f_code.co_name))
            if self.calls == self.at:
                raise KeyboardInterrupt
