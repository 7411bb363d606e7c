"""Twenty motions of bodies in contact, with answers on which two derivations agree.

`reference-cases.json` is for the developers of other programs, `schema.json` describes it, and
docs/reference-cases.md explains both. `python -m benchmarks.reference_cases` computes each answer
twice, by rockeom and without it, and writes the file.

declared.py : the motions as data; independent.py : closed forms, and Newton and Euler's equations
of newton_euler.py in arithmetic of many digits; with_rockeom.py : the same by rockeom.
"""

from pathlib import Path

FILE = Path(__file__).parent / "reference-cases.json"
SCHEMA = Path(__file__).parent / "schema.json"
