"""Unfinished work: users get what an interrupt leaves of it, and nothing else is made of that."""

import sys
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar, cast

from rockeom.numbers.callers import is_of_package

P = ParamSpec("P")
R = TypeVar("R")


class Unfinished(KeyboardInterrupt):
    """A keyboard interrupt with the part of the result that was done, which says that it is one.

    returnable : whether the next of the functions that return parts may return this one; it is the
        function whose result this is.
    """

    def __init__(self, part: Any) -> None:
        super().__init__()
        self.part, self.returnable = part, True


def part_for_users(function: Callable[P, R]) -> Callable[P, R]:
    """Let a function return to its user the part of its result that an interrupt leaves.

    Within the package the interrupt itself is raised, so that every dataset and branch there is
    whole, and no caller has to ask. It is also raised where a function that the package runs makes
    the call, such as the model of a likelihood. The outermost of all decorators.
    """

    @wraps(function)
    def entry(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return function(*args, **kwargs)
        except Unfinished as interrupt:
            frame = sys._getframe().f_back
            while frame is not None and not is_of_package(frame):
                frame = frame.f_back
            if frame is not None or not interrupt.returnable:
                interrupt.returnable = False
                raise
            return cast(R, interrupt.part)

    return entry
