"""The constants that `radau.implicit_step_text` writes before the text of radau_step.py."""

from rockeom.compiler.decorators import Floats, Floats2

A: Floats2
A_SQUARED: Floats2
DENSE_PLACE: Floats2
DENSE_VELOCITY: Floats2
G: float
ERROR_PLACE: Floats
ERROR_VELOCITY: Floats
