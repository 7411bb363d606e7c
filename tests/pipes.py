"""A named pipe, which a program that opens it waits for."""

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_RELEASE = 'sleep 5; while [ -p "$0" ]; do : > "$0"; done'


@contextmanager
def pipe(path: Path) -> Iterator[Path]:
    """A pipe that nothing is written to; who waits for it finds it empty after some seconds.

    Another process opens it then: the one that waits may hold the interpreter.
    """
    os.mkfifo(path)
    with subprocess.Popen(["sh", "-c", _RELEASE, str(path)]) as release:
        try:
            yield path
        finally:
            release.kill()
