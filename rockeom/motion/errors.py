"""The one error of this layer, and what names the file that it tells of."""

from __future__ import annotations

import os

FilePath = str | os.PathLike[str]


MEANT = {
    "load": "read(path)",
    "open": "read(path)",
    "from_file": "read(path)",
    "from_txt": "from_columns(path)",
    "from_peer": "from_at2(path)",
    "from_list": "from_array(values, dt)",
    "from_numpy": "from_array(values, dt)",
    "sine": "single_sine",
    "cosine": "single_cosine",
    "sinusoidal": "harmonic",
    "pulse": "single_sine",
    "noise": "kanai_tajimi",
    "pga": "peak",
    "pgv": "peak_velocity",
    "pgd": "peak_displacement",
    "t": "sampled(dt)",
    "time": "sampled(dt)",
    "times": "sampled(dt)",
    "a": "acceleration(t)",
    "values": "samples",
    "scale": "scaled_to(pga=...)",
    "spectrum": "response_spectrum(periods)",
    "filter": "filtered(low, high)",
}
"""Names that people ask a ground motion or its class for, and what to write for each."""


class MotionError(ValueError):
    """Ground motion that cannot be had as asked; the message says what, where and the remedy."""

    @classmethod
    def at(cls, path: FilePath, line: int | None, what: str, remedy: str) -> MotionError:
        """Error of a file, at a line where there is one.

        Parameters
        ----------
        path : path_like
            File.
        line : int
            Number of the line, counted from 1.
        what : str
            What is wrong.
        remedy : str
            What to do.

        Returns
        -------
        MotionError
            Error to raise.
        """
        name = os.fspath(path)
        where = name if name.isprintable() else repr(name)
        where += "" if line is None else f", line {line}"
        return cls(f"{where}: {what}. Remedy: {remedy}.")
