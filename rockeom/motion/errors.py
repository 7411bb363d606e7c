"""The one error of this layer, and what names the file that it tells of."""

from __future__ import annotations

import os

FilePath = str | os.PathLike[str]


class MotionError(ValueError):
    """A ground motion that cannot be had as asked; the message says what, where and the remedy."""

    @classmethod
    def at(cls, path: FilePath, line: int | None, what: str, remedy: str) -> MotionError:
        """The error of a file, at a line (counted from 1) where there is one."""
        name = os.fspath(path)
        where = name if name.isprintable() else repr(name)
        where += "" if line is None else f", line {line}"
        return cls(f"{where}: {what}. Remedy: {remedy}.")
