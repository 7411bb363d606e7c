"""Slopes of functions, for numbers with derivatives: joined to a text that is printed for them.

Of `math.f` it is `f_slope`, by the chain rule; `f_of_duals` stands for a function f of the texts
that is not its own derivative: it rounds on its way, or is a series that was cut.
"""

import math
from typing import TYPE_CHECKING

from rockeom.compiler.decorators import inlined

if TYPE_CHECKING:  # joined before this text
    from rockeom.integrator.ground import sine
    from rockeom.integrator.interface import sine_cosine, value
    from rockeom.integrator.transitions.searched import but_for_rounding


def sqrt_slope(x):
    return 0.5 / math.sqrt(x)


def power_slope(x, n):
    return n * x ** (n - 1.0)


def exp_slope(x):
    return math.exp(x)


def expm1_slope(x):
    return math.exp(x)


def log_slope(x):
    return 1.0 / x


def log1p_slope(x):
    return 1.0 / (1.0 + x)


def sin_slope(x):
    return math.cos(x)


def cos_slope(x):
    return -math.sin(x)


def tan_slope(x):
    found = math.tan(x)
    return 1.0 + found * found


def asin_slope(x):
    return 1.0 / math.sqrt(1.0 - x * x)


def acos_slope(x):
    return -1.0 / math.sqrt(1.0 - x * x)


def atan_slope(x):
    return 1.0 / (1.0 + x * x)


def sinh_slope(x):
    return math.cosh(x)


def cosh_slope(x):
    return math.sinh(x)


def tanh_slope(x):
    found = math.tanh(x)
    return 1.0 - found * found


def asinh_slope(x):
    return 1.0 / math.sqrt(1.0 + x * x)


def acosh_slope(x):
    return 1.0 / math.sqrt(x * x - 1.0)


def atanh_slope(x):
    return 1.0 / (1.0 - x * x)


@inlined
def sine_cosine_of_duals(x):
    """They are polynomials about multiples of pi/2, to which x is rounded."""
    sin_x, cos_x = sine_cosine(value(x))
    moves = x - value(x)
    return sin_x + cos_x * moves, cos_x - sin_x * moves


@inlined
def sine_of_duals(x):
    found = sine(value(x))
    return found + sine(value(x) + 0.5 * math.pi) * (x - value(x))


@inlined
def but_for_rounding_of_duals(sum_, size):
    """Where nothing is left of a sum, its derivatives may be anything."""
    return but_for_rounding(value(sum_), value(size)) + (sum_ - value(sum_))
