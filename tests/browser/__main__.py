"""Motions of every shipped structure by every method, in WebAssembly and in machine code.

python -m tests.browser        list those whose bits differ; a few minutes
"""

import sys

import pytest

from rockeom.structures.classes import SHIPPED

from .test_bits import METHODS, same_bits


def main() -> int:
    differ = 0
    for name in SHIPPED:
        for method in METHODS:
            with pytest.MonkeyPatch.context() as patch:
                same = same_bits(name, method, patch)
            differ += not same
            print(f"{name} {method}: {'same bits' if same else 'DIFFERENT'}", flush=True)
    print(f"{differ} motions differ")
    return differ > 0


if __name__ == "__main__":
    sys.exit(main())
