"""Reference material that lies beside the project and is no part of it: scans, records of networks.

A test that needs a file of it is skipped where the folder `shared` does not lie beside the project.
"""

from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parent.parent.parent / "shared"


def path(name: str) -> Path:
    """A file or folder of it; skips the test where it is not at hand."""
    if not (FOLDER / name).exists():
        pytest.skip(f"{name} does not lie beside the project")
    return FOLDER / name
