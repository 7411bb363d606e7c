"""A keyboard interrupt in the midst of long work."""

import functools
import inspect
import itertools
import math
import sys
from collections.abc import Callable
from pathlib import Path
from types import CodeType, FrameType
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
    clock decides. Generators do not count: what one raises as it is thrown away, Python ignores.
    calls : how many there were. called : file and name of each function.
    """

    def __init__(self, at: float = math.inf) -> None:
        self.at, self.calls = at, 0
        self._codes: set[CodeType] = set()

    @property
    def called(self) -> set[tuple[str, str]]:
        return {(Path(code.co_filename).name, code.co_name) for code in self._codes}

    def __enter__(self) -> "Interrupting":
        sys.setprofile(self._look)
        return self

    def __exit__(self, *_: object) -> None:
        sys.setprofile(None)

    def _look(self, frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_globals.get("__name__", "").startswith("rockeom"):
            self._codes.add(frame.f_code)
            if frame.f_code.co_flags & inspect.CO_GENERATOR:
                return
            self.calls += 1
            if self.calls == self.at:
                raise KeyboardInterrupt
