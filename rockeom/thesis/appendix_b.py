"""Appendix B: the energies of the controlled rocking wall.

Typed by hand from the thesis, in its own symbols; see chapter_4.py for the units.
"""

from sympy import Abs, Add, Expr, Float, Integral, Mul, Pow, Rational, cos, sin

from rockeom.thesis import notation as th
from rockeom.thesis.chapter_4 import LEVEL, REACH
from rockeom.thesis.equation import POSITIVE, Kind, section

RISE = Abs(th.Delta) / LEVEL * REACH - th.B * Abs(th.Delta) / th.H
STIFFNESS = th.E_tendon * th.A_tendon / th.L_T
BEFORE, AT_YIELD = Float("6.4564"), Float("13.5814")
"""Extension of the tendon at 75.6 kN, and at yield [mm]."""


def _kept(kind: type[Expr], *parts: Expr) -> Expr:
    """A sum, product or power that SymPy leaves as it is printed."""
    return kind(*parts, evaluate=False)


def of_added_mass(across: Expr) -> Expr:
    """Squared distance of the added mass from O."""
    return _kept(Add, _kept(Pow, Float("2.537"), 2), across**2)


POTENTIAL_ENERGY = {
    "B-1 uplift of the base at the tendon, on the centreline": Kind.CLOSED_FORM(
        th.u_tendon, th.u_edge - th.B * sin(th.theta), sides=POSITIVE
    ),
    "B-2 B-1 by the displacement": Kind.CLOSED_FORM(
        th.u_tendon, th.u_edge - th.B * Abs(th.Delta) / th.H
    ),
    "B-3 B-2 with 4-9": Kind.CLOSED_FORM(th.u_tendon, RISE),
    "B-4 gravitational energy, as 4-18": Kind.APPROXIMATION(
        th.U_of, th.m_T * th.g * RISE, remark="In mJ where lengths are in mm."
    ),
}


KINETIC_ENERGY = {
    "B-5 rotation by the displacement": Kind.DEFINITION(sin(th.theta), th.Delta / th.H),
    "B-6 its rate": Kind.CLOSED_FORM(
        th.theta_d, th.Delta_d / (th.H * cos(th.theta)), th.Delta_d / LEVEL
    ),
    "B-7 the same for a small rotation": Kind.APPROXIMATION(th.theta_d, th.Delta_d / th.H),
    "B-8 kinetic energy, as 4-19": Kind.APPROXIMATION(
        th.E_k_of, Rational(1, 2) / th.H**2 * th.I_o * th.Delta_d**2
    ),
    (
        "B-9 moment of inertia about the centre of rotation, of the wall and of the added mass"
    ): Kind.DEFINITION(
        th.I_o,
        _kept(
            Add,
            _kept(Add, 686, _kept(Mul, Float("577.56"), (th.H**2 + th.d_lifted**2) / 3)),
            _kept(Add, 442, _kept(Mul, Float("1438.5"), of_added_mass(th.d_lifted))),
        ),
        correction={of_added_mass(th.d_lifted): of_added_mass(th.d_lifted - th.B)},
        reason="The added mass stands on the centreline, at the distance d - B from O. As printed "
        "the migration would change I_o by 7 %, and I_o/R by 8 %, where the text says 3 % and "
        "less than 2 %; and r of 2-6 would not be the 0.835 of section 4.9.2.1.",
        remark="Lengths in m. The text does not say what the 686 kg m2 are.",
    ),
}


TENDON_ENERGY = {
    "B-10 elastic energy stored between two extensions": Kind.DEFINITION(
        th.energy_stored, Integral(th.k * th.x, (th.x, th.x_1, th.x_2))
    ),
    "B-11 extension of the tendon by its force": Kind.CLOSED_FORM(
        th.x_2, th.P_tendon * th.L_T / (th.E_tendon * th.A_tendon)
    ),
    "B-12 elastic energy of the tendon before it yields": Kind.CLOSED_FORM(
        th.U_E_of,
        Integral(
            STIFFNESS * th.x, (th.x, BEFORE, th.P_tendon * th.L_T / (th.E_tendon * th.A_tendon))
        ),
        th.L_T / (2 * th.E_tendon * th.A_tendon) * th.P_tendon**2 - Float("244.050"),
        remark="The line between the two has 6.4564E-03, which is the same in metres.",
    ),
    "B-13 elastic energy of the tendon after it has yielded": Kind.CLOSED_FORM(
        th.U_E_of,
        _kept(
            Add,
            Integral(STIFFNESS * th.x, (th.x, BEFORE, AT_YIELD)),
            _kept(Mul, Float("159.03"), th.extension - (AT_YIELD - BEFORE)),
        ),
        Float("159.03") * th.extension - Float("297.22"),
        remark="For a displacement that grows. 159.03 kN are 900 MPa on 176.7 mm2; section 4.2 "
        "has 160 kN and 177 mm2.",
    ),
}

APPENDIX_B = (
    *section("B.1", POTENTIAL_ENERGY, units="920 mm, 412 mm"),
    *section("B.2", KINETIC_ENERGY, units="686 kg m2, 577.56 kg, 2.537 m, 442 kg m2, 1438.5 kg"),
    *section(
        "B.3", TENDON_ENERGY, units="6.4564 mm, 13.5814 mm, 7.125 mm, 159.03 kN, 244.05 J, 297.22 J"
    ),
)
