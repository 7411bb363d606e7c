"""Sine and cosine of an angle, found together: the function itself, and where it is called."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from rockeom.codegen.printer import python
from rockeom.symbolic.algebra import angles_in

SINE_COSINE = '''
ROUNDER = 6755399441055744.0  # 1.5 * 2**52: what is added to it is rounded to a whole number


@inlined
@fused
def sine_cosine(x):
    """Sine and cosine, within 1.4e-16: fdlibm's polynomials about multiples of pi/2."""
    n = 0.0
    r = x
    turned = abs(x) > 0.7853981633974483
    if turned:
        n = (x * 0.6366197723675814 + ROUNDER) - ROUNDER
        r = (x - n * 1.5707963267341256) - n * 6.077100506506192e-11
    z = r * r
    zz = z * z
    # in pairs of terms, so that the processor need not wait for one after the other
    s0 = -0.16666666666666632 + z * 0.00833333333332249
    s1 = -0.0001984126982985795 + z * 2.7557313707070068e-06
    s2 = -2.5050760253406863e-08 + z * 1.58969099521155e-10
    c0 = 0.0416666666666666 - z * 0.001388888888887411
    c1 = 2.480158728947673e-05 - z * 2.7557314351390663e-07
    c2 = 2.087572321298175e-09 - z * 1.1359647557788195e-11
    sine = r + r * z * (s0 + zz * (s1 + zz * s2))
    cosine = 1.0 - (0.5 * z - zz * (c0 + zz * (c1 + zz * c2)))
    if turned:
        # by quarters of a turn: -2 to 2
        quarter = n - 4.0 * ((0.25 * n + ROUNDER) - ROUNDER)
        odd = quarter * quarter == 1.0
        sine, cosine = (cosine if odd else sine), (sine if odd else cosine)
        back = quarter * quarter == 4.0
        sine = -sine if back or quarter == -1.0 else sine
        cosine = -cosine if back or quarter == 1.0 else cosine
    return sine, cosine'''


def named_angles(exprs: Mapping[str, sp.Expr]) -> tuple[dict[str, sp.Expr], dict[sp.Expr, str]]:
    """The expressions with names for sines and cosines, and the name of each angle."""
    angles = {a for e in exprs.values() for a in angles_in(e)}
    names: dict[sp.Expr, str] = {}
    for angle in sorted(angles, key=sp.default_sort_key):
        plain = angle.is_Symbol and not str(angle).endswith("_")
        names[angle] = str(angle) if plain else f"angle_{len(names)}"
    named = {sp.sin(a): sp.Symbol(f"sin_{n}") for a, n in names.items()}
    named |= {sp.cos(a): sp.Symbol(f"cos_{n}") for a, n in names.items()}
    return {k: e.xreplace(named) for k, e in exprs.items()}, names


def assigned_angles(names: Mapping[sp.Expr, str], indent: str) -> list[str]:
    """Lines that find the sine and cosine of each angle."""
    return [
        f"{indent}sin_{name}, cos_{name} = sine_cosine({python(angle)})"
        for angle, name in names.items()
    ]
