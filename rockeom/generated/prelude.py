"""What generated modules have in common: each imports it from here where it would say the same.

A part of every one of them: the hash that one carries is of this text and its own, and a program is
compiled of both.
"""

import math

from rockeom.codes import IMPULSIVE, RATIO
from rockeom.compiler.decorators import fused, inlined

__fused__ = False

ENERGIES = ("kinetic_energy", "gravitational_energy", "elastic_energy")

# -- of a structure that has none of them

ELEMENT_NAMES = ()
MEMBERS = ()
MEMBER_ENDS = ()
COPIES = ()
N_FALLS = 0
N_PARTS = 0
LOCALISED = False  # whether forces may act in a small part of a step
FULL_CONTACT = -1  # mode whose guards are sums of the state and the ground, or -1


@inlined
def full_contact_guards(y, p, ax, g):
    """Guards of the mode FULL_CONTACT into g, each divided by what is positive.

    Sums of the states and ax, while there is no vertical shaking.
    """
    pass


def elements(mode, y, p, out):
    """Deformation [m], force [N], energy [J] and power lost [W] of each of ELEMENT_NAMES.

    Into out, one element behind the other.
    """
    pass


def velocity_ratio(p):
    """Ratio of the rates of rotation at an impact of the structure taken as rigid."""
    value = 1
    return value


def overturning(p):
    """Rotation at which the structure has overturned."""
    value = (1 / 2) * math.pi
    return value


# -- sine and cosine of an angle, computed together

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
    return sine, cosine
