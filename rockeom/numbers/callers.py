"""Code outside the package that calls it: a warning at its line, and whether a frame is of it."""

import sys
import warnings
from types import FrameType


def warn_caller(message: str) -> None:
    """Give a UserWarning at the line outside the package that calls it."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and is_of_package(frame):
        level, frame = level + 1, frame.f_back
    warnings.warn(message, UserWarning, stacklevel=level)


def is_of_package(frame: FrameType) -> bool:
    """Whether the code that a frame runs is the package's own."""
    return bool(frame.f_globals.get("__name__", "").partition(".")[0] == "rockeom")
