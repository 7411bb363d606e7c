"""Equations of the thesis, typed by hand from its pages, in its own symbols.

Nothing here is derived and nothing is imported from the engine. An entry holds what is printed
and, where that is wrong or not legible, what should stand there and why.

sgn and |.| are `sign` and `Abs`; of the signs +- and -+ the upper ones hold for theta > 0: `PM`
and `-PM`. A vector is a column (i, j), measured from the pivot of its side.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from sympy import Abs, Matrix, Rational, Symbol, asin, atan, cos, pi, sign, sin, sqrt

__all__ = ["EQUATIONS", "Equation"]

del asin, pi  # not used by any entry below
