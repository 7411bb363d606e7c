"""Other programs on the reference motions: error against time step, and what fails.

    python -m benchmarks.engines [NAME ...]    all that are installed, into out/engines.json
    python -m benchmarks.engines --read FILE --write PAGE    the tables of an earlier run, in a page

A runner reads reference-cases.json, builds the bodies by what a user of that program would write,
and measures the motion. Nothing of rockeom is in it, but that OpenSees gets the script which
`rockeom export opensees` writes. A program that is not installed is named.

trace.py : a motion and what is measured of it; with_*.py : one program each; tables.py : the page.
"""

import json

from benchmarks.reference_cases import FILE


def cases() -> list[dict]:
    """The reference cases, as they are published."""
    return json.loads(FILE.read_text(encoding="utf-8"))["cases"]


def case(name: str) -> dict:
    return next(one for one in cases() if one["id"] == name)
