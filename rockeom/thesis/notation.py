"""The symbols of the thesis: one home for the meaning and the unit of each.

As in the thesis's Notations, one letter may mean different things in different chapters; then it
has an entry for each. Rates are symbols of their own, as the thesis writes them with dots. Others
call this module `th`; a chapter also imports the few symbols that most of its equations have.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy import Function, MatrixSymbol, Symbol, sign


@dataclass(frozen=True)
class Entry:
    """Meaning of a symbol.

    Parameters
    ----------
    symbol : sympy.Basic
        Symbol.
    unit : str
        SI unit, "1" for a pure number.
    meaning : str
        Meaning in words.
    chapters : tuple of str
        Chapters ("2", "D") in which it means this; empty for all others.
    """

    symbol: sp.Basic
    unit: str
    meaning: str
    chapters: tuple[str, ...]


NOTATION: list[Entry] = []


def _symbols(**assumption: bool) -> Callable[..., Symbol]:
    """Maker of symbols of an assumption; a second entry of the same name is for other chapters."""

    def named(name: str, unit: str, meaning: str, *chapters: str) -> Symbol:
        return _enter(Symbol(name, **assumption), unit, meaning, chapters)

    return named


real, positive, negative = _symbols(real=True), _symbols(positive=True), _symbols(negative=True)


def matrix(name: str, rows: int, columns: int, unit: str, meaning: str, *chapters: str) -> Any:
    """A matrix without named components, with its entry."""
    return _enter(MatrixSymbol(name, rows, columns), unit, meaning, chapters)


def _enter(symbol: Symbol, unit: str, meaning: str, chapters: tuple[str, ...]) -> Symbol:
    for entry in NOTATION:
        same_place = set(entry.chapters) & set(chapters) or not (entry.chapters or chapters)
        if entry.symbol == symbol and same_place:
            raise ValueError(f"{symbol} has two entries: {entry.meaning}; {meaning}")
    NOTATION.append(Entry(symbol, unit, meaning, chapters))
    return symbol


def entry(symbol: sp.Basic, chapter: str) -> Entry:
    """Entry of a symbol in a chapter.

    Parameters
    ----------
    symbol : sympy.Basic
        Symbol.
    chapter : str
        Chapter.

    Returns
    -------
    Entry
        Entry.

    Raises
    ------
    KeyError
        Where there is none.
    """
    general = None
    for one in NOTATION:
        if one.symbol == symbol:
            if chapter in one.chapters:
                return one
            if not one.chapters:
                general = one
    if general is None:
        raise KeyError(f"{symbol} has no entry for chapter {chapter} in rockeom.thesis.notation")
    return general


# --- everywhere

PM = real(r"\pm", "1", "double sign: the upper one for theta > 0, the lower one for theta < 0")
theta = real("theta", "rad", "rotation, positive clockwise, about the right edge O")
theta_d = real(r"\dot{\theta}", "rad/s", "angular velocity")
theta_dd = real(r"\ddot{\theta}", "rad/s2", "angular acceleration")
theta_0 = real("theta_0", "rad", "initial rotation")
a_g = real(r"\ddot{u}_g", "m/s2", "ground acceleration")
g = positive("g", "m/s2", "acceleration of gravity")
t = positive("t", "s", "time")
r = positive("r", "1", "apparent coefficient of restitution: ratio of kinetic energies")
alpha = positive("alpha", "rad", "angle between the vertical and the line from pivot to centroid")
R = positive("R", "m", "distance from the pivot to the centroid")
I_o = positive("I_o", "kg m2", "moment of inertia about the pivot")
m = positive("m", "kg", "mass")
s = sign(theta)

# --- chapter 2

beta = positive("beta", "1", "non-dimensional amplitude of the excitation", "2")
omega = positive("omega", "1", "non-dimensional frequency of the excitation", "2")
Omega = positive("Omega", "rad/s", "frequency of the excitation", "2")
tau = positive("tau", "s", "natural time", "2")
t_scaled = positive("t", "1", "non-dimensional time", "2")
x = real("x", "1", "rotation over alpha", "2")
x_d = real(r"\dot{x}", "1", "non-dimensional angular velocity", "2")
x_dd = real(r"\ddot{x}", "1", "non-dimensional angular acceleration", "2")
a_peak = positive(r"\ddot{u}_{g,peak}", "m/s2", "size of the peak ground acceleration", "2")
B = positive("B", "m", "half-width of the base; in 2-1 the width, with H the height", "2")
H = positive("H", "m", "height of the mass above the base; in 2-1 the height of the block", "2")
p = positive("p", "rad/s", "frequency parameter of the block", "2")
period = positive("T", "s", "period of free rocking", "2")
omega_n = positive(
    r"\omega_n", "rad/s", "natural frequency on a fixed base; omega in 2-8a, taken here", "2"
)
xi = positive(r"\xi", "1", "damping ratio on a fixed base", "2")
lambda_r = positive(r"\lambda_r", "rad/s", "natural frequency while a foot is lifted", "2")
zeta_r = positive(r"\zeta_r", "1", "damping ratio while a foot is lifted", "2")
xi_eq = positive(r"\xi_{eq}", "1", "equivalent viscous damping ratio", "2")
xi_el = positive(r"\xi_{el}", "1", "its elastic part", "2")
xi_hyst = positive(r"\xi_{hyst}", "1", "its hysteretic part", "2")
xi_bilinear = positive(r"\xi_{hyst,Bilinear}", "1", "that of the bilinear rule", "2")
xi_takeda = positive(r"\xi_{hyst,Takeda}", "1", "that of the Takeda rule", "2")
xi_flag = positive(r"\xi_{hyst,FS}", "1", "that of the flag-shaped rule", "2")
xi_const = positive(r"\xi_{el}^{const}", "1", "elastic part by a constant coefficient", "2")
xi_tang = positive(r"\xi_{el}^{tang}", "1", "that in proportion to the tangent stiffness", "2")
xi_v = positive(r"\xi_v", "1", "viscous damping ratio", "2")
recentring = positive(r"\lambda", "1", "re-centring ratio", "2")
M_AE = positive("M_{AE}", "N m", "moment of the added restoring element", "2")
M_N = positive("M_N", "N m", "moment of the axial load", "2")
M_ED = positive("M_{ED}", "N m", "moment of the added energy dissipaters", "2")
mu = positive("mu", "1", "displacement ductility", "2")
k_i = positive("k_i", "N/m", "initial stiffness", "2")
k_p = positive("k_p", "N/m", "stiffness after yield", "2")
alpha_T = positive("alpha_T", "1", "exponent of the unloading stiffness of the Takeda rule", "2")
beta_FS = positive("beta_FS", "1", "height of the flag over the force at yield", "2")
effective_period = positive("T_e", "s", "effective period, by the secant stiffness", "2")
C_i = positive("C_i", "1", "coefficient of a rule of hysteresis", "2")
fit_a = real("a", "1", "factor fitted to a rule of hysteresis, of the damping", "2")
fit_b = real("b", "1", "factor fitted to it, exponent of the ductility", "2")
fit_c = real("c", "s", "factor fitted to it, of the period", "2")
fit_d = real("d", "1", "factor fitted to it, exponent of the period", "2")
fit_e = real("e", "1", "factor fitted to it, exponent at xi_const", "2")
fit_f = real("f", "1", "factor fitted to it, exponent at xi_tang", "2")

# --- chapter 2, section 2.6: the impact as a force

F_delta = real(r"F_\delta", "1", "moment of an impact over m g R alpha", "2")
delta_n = real("delta_n", "1", "smooth function of x that stands for the delta", "2")
K = real("K", "1", "factor of the velocity function", "2")
exponent = real("m", "1", "exponent of the velocity function", "2")
n = positive("n", "1", "width of the approximate delta function, and of the tanh for a sign", "2")
below_zero = negative("a", "1", "rotation over alpha before an impact", "2")
above_zero = positive("b", "1", "rotation over alpha after an impact", "2")
x_0 = positive("x_0", "1", "distance from upright before an impact", "2")
x_f = positive("x_f", "1", "distance from upright after an impact", "2")
x_d0 = real(r"\dot{x}_0", "1", "non-dimensional angular velocity before an impact", "2")
x_df = real(r"\dot{x}_f", "1", "non-dimensional angular velocity after an impact", "2")
dt = real("dt", "1", "differential of the non-dimensional time", "2")
dx = real("dx", "1", "differential of x", "2")
dx_d = real(r"d\dot{x}", "1", "differential of the non-dimensional angular velocity", "2")
x_t = Function("x")(t_scaled)
DISPLACEMENT_FUNCTION, VELOCITY_FUNCTION = Function("f(x)"), Function(r"g(\dot{x})")

# --- chapter 3

_35 = "3", "5"
E_k = real("E_k", "J", "kinetic energy", "3")
E_before = positive("E_k^{i}", "J", "kinetic energy just before impact i", *_35)
E_after = positive("E_k^{i+1}", "J", "kinetic energy just after impact i", *_35)
U = real("U", "J", "gravitational energy above that of the upright block", "3")
U_before = positive("U^{i}", "J", "potential energy at the peak before impact i", *_35)
U_after = positive("U^{i+1}", "J", "potential energy at the peak after impact i", *_35)
U_rot = real("U_{rot}", "J", "energy of a hypothetical rotational spring", "3")
k_rot = positive("k_{rot}", "N m", "stiffness of a hypothetical rotational spring", "3")
theta_before = real(r"\theta_{peak}^{i}", "rad", "peak rotation before impact i", *_35)
theta_after = real(r"\theta_{peak}^{i+1}", "rad", "peak rotation after impact i", *_35)
u_c_dd = real(r"\ddot{u}_c", "m/s2", "acceleration of the centroid", "3")
u_cg_dd = real(r"\ddot{u}_{c/g}", "m/s2", "the same with respect to the pivot", "3")
theta_d_peak = real(r"\dot{\theta}_{peak}", "rad/s", "angular velocity just before an impact", "3")
energy_change = real(r"\Delta E", "J", "change of the energy at an impact", "3")

a_gx = real(r"\ddot{u}_{gx}", "m/s2", "horizontal ground acceleration", "3")
u_cx_dd = real(r"\ddot{u}_{cx}", "m/s2", "horizontal acceleration of the centroid", "3")
u_cy_dd = real(r"\ddot{u}_{cy}", "m/s2", "vertical acceleration of the centroid", "3")
F_H = real("F_H", "N", "horizontal force of the support", "3")
F_V = real("F_V", "N", "vertical force of the support", "3")
FH_impact = real("FH_{impact}", "N", "horizontal force of the support next to an impact", "3")
FV_impact = real("FV_{impact}", "N", "vertical force of the support next to an impact", "3")
FH_limit = real("FH_{lim}", "N", "its limit as the speed of the impact vanishes", "3")
FV_limit = real("FV_{lim}", "N", "its limit as the speed of the impact vanishes", "3")
theta_d_impact = real(r"\dot{\theta}_{impact}", "rad/s", "angular velocity at an impact", "3")
theta_dd_impact = real(r"\ddot{\theta}_{impact}", "rad/s2", "angular acceleration next to one", "3")
theta_d_max = real(r"\dot{\theta}_{max,impact}", "rad/s", "largest angular velocity at one", "3")

# --- chapter 4 and Appendix B: the controlled rocking wall
# Names that other chapters bind as well stand alone; B is the half-width in both.

_4B = "4", "B"
positive("B", "mm", "half of the width of the wall, 508 mm", *_4B)
positive("H", "mm", "height of the point whose displacement is measured", *_4B)
positive("T", "s", "period of free vibration, of growing amplitude", "4")
positive("n", "mm", "width of the Gaussian; the epsilon of 4-8", "4")
positive("k", "kN/mm", "axial stiffness of the tendon", "B")
real("x", "mm", "distance from the left gauge to the centre of rotation", "4")
real("x", "mm", "extension of the tendon", "B")
real("y", "mm", "distance from the right gauge to the centre of rotation", "4")
real("Delta", "mm", "horizontal displacement of the top of the wall, positive to the right", *_4B)
Delta_d = real(r"\dot{\Delta}", "m/s", "rate of Delta", *_4B)
Delta_dd = real(r"\ddot{\Delta}", "m/s2", "second derivative of Delta", "4")
u_L = real("u_L", "mm", "reading of the left gauge, positive upward", "4")
u_R = real("u_R", "mm", "reading of the right gauge, positive upward", "4")
u_L_edge = real("u'_L", "mm", "uplift of the left edge", "4")
u_R_edge = real("u'_R", "mm", "uplift of the right edge", "4")
u_edge = real("u'", "mm", "uplift of the edge that lifts", *_4B)
u_tendon = real("u'_T", "mm", "uplift of the base at the tendon", *_4B)
d_lifted = positive("d", "mm", "length of the base that has lifted", *_4B)
d_tendon = positive("d_T", "mm", "that between the tendon and the centre of rotation", "4")
distance = real("Distance", "mm", "from the pressed edge to the centre of rotation", "4")
C_1 = positive("C_1", "mm", "part of that distance which vanishes as the wall rocks", "4")
C_2 = positive("C_2", "mm", "part of it that remains", "4")
penalty = positive("epsilon", "mm", "penalty parameter, a displacement", *_4B)
extension = real(r"\Delta L_T", "mm", "extension of the tendon since the upright state", *_4B)
E_tendon = positive("E", "kN/mm2", "modulus of elasticity of the tendon", *_4B)
A_tendon = positive("A", "mm2", "cross-section of the tendon", *_4B)
L_T0 = positive("L_{T0}", "mm", "initial unbonded length of the tendon", "4")
L_T = positive("L_T", "mm", "length of the tendon without a force", *_4B)
P_tendon = real(r"P_{Tendon}(\Delta)", "kN", "force of the tendon", *_4B)
P_initial = positive("P_{Tendon}^{0}", "kN", "its force in the upright state", "4")
T_fixed_base = positive(r"T_{Fixed\,Base}", "s", "period of the wall on a fixed base", "4")
m_T = positive("m_T", "kg", "mass of the wall and of what stands on it", *_4B)
M_e = positive("M_e", "kg", "effective mass of the equivalent oscillator", "4")
U_of = real(r"U(\Delta)", "J", "gravitational energy above that of the upright wall", *_4B)
U_E_of = real(r"U_{E}(\Delta)", "J", "elastic energy of the tendon, above that at first", *_4B)
E_k_of = real(r"E_{k}(\dot{\Delta})", "J", "kinetic energy", *_4B)
U_start = real(r"U(\Delta_{0})", "J", "gravitational energy at the release", "4")
U_E_start = real(r"U_{E}(\Delta_{0})", "J", "elastic energy at the release", "4")
U_total_0 = real("U_{Total}^{0}", "J", "total energy at the release", "4")
U_total = real("U_{Total}", "J", "total energy", "4")
Delta_start = real(r"\Delta_{i}", "mm", "displacement at the start of a step", "4")
Delta_end = real(r"\Delta_{i+1}", "mm", "displacement at its end", "4")
step = real(r"\delta t", "s", "time that the step takes", "4")
Delta_peak = real(r"\Delta_{Peak}", "mm", "peak displacement", "4")
Delta_limit = real(r"\Delta_{limit}", "mm", "displacement at which the loss of energy begins", "4")
speed_limit = real(r"\dot{\Delta}_{limit}", "m/s", "speed at Delta_limit", "4")
U_peak = real(r"U(\Delta_{Peak})", "J", "gravitational energy at the peak", "4")
U_E_peak = real(r"U_{E}(\Delta_{Peak})", "J", "elastic energy at the peak", "4")
U_limit = real(r"U(\Delta_{limit})", "J", "gravitational energy at Delta_limit", "4")
U_E_limit = real(r"U_{E}(\Delta_{limit})", "J", "elastic energy at Delta_limit", "4")
dU = real(r"\delta U", "J", "increment of the gravitational energy", "4")
dU_E = real(r"\delta U_E", "J", "increment of the elastic energy", "4")
dDelta = real(r"\delta \Delta", "mm", "increment of the displacement", "4")
F_k = real(r"F_{k}(\Delta)", "N", "elastic restoring force, at the height of Delta", "4")
F_damp = real("F_{Damp}", "N", "damping force that stands for the impacts", "4")
F_D = real(r"F_{D}(\dot{\Delta})", "N", "damping force that depends on the velocity", "4")
P_e = real("P_{e}(t)", "N", "effective driving force", "4")
tau_t = real(r"\tau(t)", "N m", "moment of the ground's acceleration", "4")
b_moving = real("b'", "mm", "distance from the centreline to the centre of rotation", "4")
Z = positive("Z", "m/s2", "amplitude of the ground's acceleration", "4")
x_1 = real("x_1", "mm", "extension of the tendon in a first state", "B")
x_2 = real("x_2", "mm", "extension of the tendon in a second state", "B")
energy_stored = real(r"\Delta U_E", "J", "elastic energy stored between the two states", "B")

# --- chapter 5 and Appendix D: superstructure (e) on a base structure (b)

_5D = "5", "D"
m_e = positive("m_e", "kg", "lumped mass of the column, the superstructure", *_5D)
m_b = positive("m_b", "kg", "lumped mass of the base structure", *_5D)
R_e = positive("R_e", "m", "distance from the pivot to the superstructure", *_5D)
R_b = positive("R_b", "m", "distance from the pivot to the base structure", *_5D)
alpha_e = positive("alpha_e", "rad", "angle between the vertical and the line to m_e", *_5D)
alpha_b = positive("alpha_b", "rad", "angle between the vertical and the line to m_b", *_5D)
H_e = positive("H_e", "m", "height of the superstructure above the pivot", *_5D)
H_b = positive("H_b", "m", "height of the base structure above the pivot", *_5D)
B = positive("B", "m", "half of the distance between the two pivots", *_5D)
I_eg = positive("I_{e,g}", "kg m2", "inertia of the superstructure about its centroid", *_5D)
I_bg = positive("I_{b,g}", "kg m2", "inertia of the base structure about its centroid", *_5D)
I_O = positive("I_O", "kg m2", "inertia of the structure about the pivot", *_5D)
u = real("u", "m", "deformation of the column; of the rigid structure its displacement", "2", *_5D)
u_d = real(r"\dot{u}", "m/s", "rate of u", "2", *_5D)
u_dd = real(r"\ddot{u}", "m/s2", "second derivative of u", "2", *_5D)
k = positive("k", "N/m", "elastic stiffness of the column", *_5D)
c = positive("c", "N s/m", "viscous damping of the column", *_5D)
theta_d1 = real(r"\dot{\theta}_1", "rad/s", "angular velocity before an impact", "2", "5")
theta_d2 = real(r"\dot{\theta}_2", "rad/s", "angular velocity after an impact", "2", "5")
L_before = real("L_{before}", "kg m2/s", "angular momentum about O' before an impact", "5")
L_after = real("L_{after}", "kg m2/s", "angular momentum about O' after an impact", "5")
W = positive("W", "N", "weight of the structure", "5")
k_f = positive("k_f", "N/m", "stiffness of each of the two springs", "5")
H_c = positive("H_c", "m", "height of the centroid of both masses", "5")
alpha_c = positive("alpha_c", "rad", "angle between the vertical and the line to it", "5")
R_c = positive("R_c", "m", "distance from the pivot to it", "5")
delta_0 = positive("delta_0", "m", "settlement under self-weight", "5")
k_u = real("k(u)", "N", "restoring force of the cart", "5")
P_t = real("P(t)", "N", "driving force of the cart", "5")
P = real("P", "N", "pushover force at the height of m_e", "5")
P_crit = real("P_{crit}", "N", "pushover force at which a spring detaches", "5")
P_crit2 = real("P_{crit2}", "N", "pushover force just after a spring has detached", "5")
delta_change = real(r"\Delta\delta", "m", "change of the length of a spring", "5")
f_L = real("f_L", "N", "force of the left spring", "5")
f_R = real("f_R", "N", "force of the right spring", "5")
theta_crit = real("theta_{crit}", "rad", "rotation at which a spring detaches", "5")
u_crit = positive("u_{crit}", "m", "displacement of m_e at theta_crit", "5")
u_overturn = positive("u_{overturn}", "m", "displacement at which the structure overturns", "5")
displacement = real("Displacement", "m", "displacement of m_e", "5")
T_fixed = positive("T_{fixed}", "s", "period of the column on a fixed base", "5")
Delta = real("Delta", "mm", "measured horizontal displacement", "5")
Delta_i = positive(r"\Delta^{i}", "mm", "peak displacement of cycle i", "5")
Delta_next = positive(r"\Delta^{i+1}", "mm", "peak displacement of the next cycle", "5")
xi_i = positive(r"\xi^{i}", "1", "equivalent viscous damping ratio of cycle i", "5")
B_measured = positive("B'", "mm", "half-width of the base, at the point of measurement", "5")
H_measured = positive("H'", "mm", "height of the point of measurement above the pivot", "5")
R_measured = positive("R'", "mm", "distance from the pivot to the point of measurement", "5")
alpha_measured = positive(r"\alpha'", "rad", "angle between the vertical and the line to it", "5")
x_centre = real("x", "mm", "distance from the left edge to the centre of rotation", "5")
y_centre = real("y", "mm", "distance from the right edge to the centre of rotation", "5")
U_grav = real("U_{Grav}", "J", "gravitational energy above that of the upright structure", "5")
r_i = positive("r^{i}", "1", "ratio of kinetic energies at impact i", "5")
r_e = real("r_e", "m", "position of m_e", "D")
r_b = real("r_b", "m", "position of m_b", "D")
v_e = real("v_e", "m/s", "velocity of m_e", "D")
v_b = real("v_b", "m/s", "velocity of m_b", "D")
T = real("T", "J", "kinetic energy", "D")
T_e = real("T_e", "J", "kinetic energy of the superstructure", "D")
T_b = real("T_b", "J", "kinetic energy of the base structure", "D")
V = real("V", "J", "potential energy", "D")
L = real(r"\mathcal{L}", "J", "Lagrangian", "D")
F_nc = real("F_{nc}", "W", "Rayleigh's dissipation function", "D")
Q_theta = real(r"Q_\theta", "N m", "generalised force on theta", "D")
Q_u = real(r"Q_u", "N", "generalised force on u", "D")
Q_i = real("Q_i", "N or N m", "generalised force on the coordinate q_i", "D")
A_angle = real("A", "rad", "an angle", "D")
B_angle = real("B_1", "rad", "another angle, B in the thesis, which is the half-width here", "D")
y_1 = real("y_1", "m", "u, a state of the first-order form", "D")
y_2 = real("y_2", "m/s", "rate of u, a state", "D")
y_3 = real("y_3", "rad", "theta, a state", "D")
y_4 = real("y_4", "rad/s", "rate of theta, a state", "D")
y_1d = real(r"\dot{y}_1", "m/s", "rate of y_1", "D")
y_2d = real(r"\dot{y}_2", "m/s2", "rate of y_2", "D")
y_3d = real(r"\dot{y}_3", "rad/s", "rate of y_3", "D")
y_4d = real(r"\dot{y}_4", "rad/s2", "rate of y_4", "D")
f_1 = real("f_1", "kg m", "coefficient of the rate of y_2 in the rotation's row", "D")
f_2 = real("f_2", "kg m2", "coefficient of the rate of y_4 in the rotation's row", "D")
_ROWS = "1, 0, 0, 0; 0, kg, 0, kg m; 0, 0, 1, 0; 0, kg m, 0, kg m2"
M_matrix = matrix("M", 4, 4, _ROWS, "matrix of the first-order form", "D")
y_d_column = matrix(r"\dot{y}", 4, 1, "m/s; m/s2; rad/s; rad/s2", "rates of the states", "D")
f_column = matrix("f", 4, 1, "m/s; N; rad/s; N m", "right side of the first-order form", "D")
q_t = Function("q_i")(t)
LAGRANGIAN, DISSIPATION = Function(r"\mathcal{L}"), Function("F_{nc}")
