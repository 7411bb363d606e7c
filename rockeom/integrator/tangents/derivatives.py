"""Functions of numbers with derivatives, which a program that carries derivatives calls.

`f_of_duals` replaces a function f of the texts whose text is not its own derivative: it rounds
on its way, or is a series that was cut. `rockeom.numbers.derivatives` has those of `math.f`.
"""

import math

from rockeom.compiler.decorators import inlined, rule_of
from rockeom.generated.prelude import sine_cosine
from rockeom.integrator.ground import sine
from rockeom.integrator.provided import value
from rockeom.integrator.transitions.points import but_for_rounding


@inlined
@rule_of(sine_cosine)
def sine_cosine_of_duals(x):
    """They are polynomials about multiples of pi/2, to which x is rounded."""
    sin_x, cos_x = sine_cosine(value(x))
    moves = x - value(x)
    return sin_x + cos_x * moves, cos_x - sin_x * moves


@inlined
@rule_of(sine)
def sine_of_duals(x):
    value_there = sine(value(x))
    return value_there + sine(value(x) + 0.5 * math.pi) * (x - value(x))


@inlined
@rule_of(but_for_rounding)
def but_for_rounding_of_duals(sum_, size):
    """Where nothing is left of a sum, its derivatives may be anything."""
    return but_for_rounding(value(sum_), value(size)) + (sum_ - value(sum_))
