# ---
# jupyter:
#   jupytext:
#     notebook_metadata_filter: rockeom
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
#   rockeom:
#     figure: 1
#     level: graduate
#     minutes: 75
# ---

# %% [markdown]
# # A flexible structure that rocks
#
# A column bends while it rocks. Model C of the thesis (Ma 2010, Section 5.3.3 and Appendix D) has
# two coordinates, the rotation $\theta$ of the base and the deformation $u$ of the column. The
# thesis derives their equations by Lagrange's method, because equilibrium "involves complex
# geometry". In a frame that turns with the base it does not, and every term has a name.
#
# ## Aims
#
# After this notebook you can
#
# 1. write the inertia forces in a rotating frame, with Coriolis and centrifugal forces by name;
# 2. derive both equations of motion by d'Alembert, and read each term of 5-34 and 5-35;
# 3. derive what an impact does to *both* velocities, from two conservation laws;
# 4. show that the thesis's rule for impacts can create energy, and when;
# 5. say when a foot cannot lift after an impact, so that both feet stay down.
#
# You should know [Model A](lumped_mass_structure.py), of which this is the flexible sister.

# %%
import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.teaching import Exercises
from rockeom.thesis import equation
from rockeom.thesis.notation import (
    B,
    H_b,
    H_e,
    I_bg,
    I_eg,
    R_b,
    R_e,
    a_g,
    alpha_b,
    alpha_e,
    c,
    g,
    k,
    m_b,
    m_e,
    theta,
    theta_d,
    theta_dd,
    u,
    u_d,
    u_dd,
)

use_style()
sp.init_printing()

# %% [markdown]
# ## Your equation first
#
# The column is the easier of the two coordinates. Write down the balance of forces across it while
# the structure rocks freely on its right foot, and type it in place of ours. `compare` reads
# symbols by their names: those of this notebook, or `theta_dot`, `u_ddot`, `mass` and so on.

# %%
model = rk.derive(rk.FlexibleStructure)
inertia = m_e * (u_dd + H_e * theta_dd)

yours = sp.Eq(inertia + m_e * (B - u) * theta_d**2 + c * u_d + k * u, m_e * g * sp.sin(theta))
print(model.compare(yours, mode="right", ground=()))

# %% [markdown]
# Now without the term of the velocity squared, which is easily overlooked. The comparison says what
# is missing: the centrifugal force away from the foot, a result of Section 2.

# %%
mistaken = sp.Eq(inertia + c * u_d + k * u, m_e * g * sp.sin(theta))
comparison = model.compare(mistaken, mode="right", ground=())
print(comparison)
assert model.compare(yours, mode="right", ground=())
assert set(comparison.difference) == {"velocities squared"}

# %% [markdown]
# ## 1. A frame that turns with the base
#
# Take axes fixed to the base: the origin at the pivot, $\boldsymbol e_1$ across the column and
# $\boldsymbol e_2$ along it (Figure 1). When the base has turned clockwise by $\theta$, so have
# they. The superstructure moves along $\boldsymbol e_1$ only. It turns with the base: $u$ displaces
# it at right angles to the column and does not incline it.
#
# With $s = \operatorname{sgn}\theta$ the centre line lies $sB$ *behind* the pivot, and the masses
# are at
#
# $$ \boldsymbol r_e = (u - sB)\,\boldsymbol e_1 + H_e\,\boldsymbol e_2, \qquad
#    \boldsymbol r_b = -sB\,\boldsymbol e_1 + H_b\,\boldsymbol e_2 . \tag{1} $$


# %% tags=["hide-input"] jupyter={"source_hidden": true}
b, h, low, tilt, bend = 0.4, 1.35, 0.12, 0.16, 0.26
pivot = np.array([b, 0.0])
z = np.linspace(0, 1, 40)
bent = np.column_stack([bend * z**2 * (3 - z) / 2, 2 * low + (h - 2 * low) * z])  # a cantilever


def turned(*points):
    return fb.turned(points, pivot, tilt)


figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 4.6), layout="constrained")
fb.ground(left, -0.75, 1.1)
fb.body(left, turned((-b, 0), (b, 0), (b, 2 * low), (-b, 2 * low)))
left.plot(*turned(*bent).T, color=fb.LINES[0], lw=2)
top, bottom, straight, high = turned((bend, h), (0, low), (0, h), (0, 1.2 * h))
corner, middle = turned((-b, 0), (0, 0))
e1, e2 = turned((b + 1, 0), (b, 1)) - pivot
fb.line(left, bottom, high)
fb.dimension(left, straight, top, "$u$", offset=(3, 8))
fb.dimension(left, corner, corner + h * e2, "$H_e$", 0.12, (-11, 3))
fb.dimension(left, corner, middle, "$B$", -0.12, (-2, -9))
fb.line(left, pivot, (b, 0.95))
fb.line(left, pivot, pivot + 0.95 * e2)
fb.angle(left, pivot, (b, 1), pivot + e2, 0.72, r"$\theta$", label_radius=1.14)
fb.arrow(left, pivot, pivot + 0.4 * e1, r"$e_1$", color=fb.MOTION, offset=(10, 0))
fb.arrow(left, pivot, pivot + 0.4 * e2, r"$e_2$", color=fb.MOTION, offset=(12, -2))
fb.mass(left, top, "$m_e$")
fb.mass(left, bottom, "$m_b$", (6, -6), size=7)
fb.pivot(left, pivot, "$O$", (-3, -12))
left.set_title(r"(a) coordinates, $\theta > 0$")

lean, outwards = 0.85, 0.3  # of the column and of the line from O, from the vertical
e1, e2 = np.array([[np.cos(lean), -np.sin(lean)], [np.sin(lean), np.cos(lean)]])
from_pivot = np.array([np.sin(outwards), np.cos(outwards)])
across = np.array([-from_pivot[1], from_pivot[0]])
forces = [
    ((0, -1), "$m_e g$", (14, 0)),
    ((-1, 0), r"$m_e\ddot u_g$", (-16, -3)),
    (across, r"Euler, $m_e\ddot\theta r$", (-33, 0)),
    (-e1, r"$ku,\ c\dot u$, relative, $m_e\ddot u$", (-18, 9)),
    (from_pivot, r"centrifugal, $m_e\dot\theta^2 r$", (4, 10)),
    (e2, r"Coriolis, $2m_e\dot\theta\dot u$", (14, 9)),
]
for direction, label, offset in forces:
    fb.arrow(right, (0, 0), direction, label, offset=offset)
right.plot(*np.transpose([(0, 0), -1.1 * e2]), color=fb.LINES[0], lw=2)
fb.line(right, (0, 0), -1.5 * from_pivot)
fb.pivot(right, -1.5 * from_pivot, "$O$", (12, 0))
fb.mass(right, (0, 0), size=13)
right.set_title("(b) forces on the superstructure")
right.set(xlim=(-1.9, 1.7), ylim=(-1.7, 1.4))
for ax in (left, right):
    fb.bare(ax)
plt.show()

# %% [markdown]
# *Figure 1. (a) The frame $(\boldsymbol e_1, \boldsymbol e_2)$ turns with the base about $O$; $u$
# is drawn far too large. (b) The superstructure alone, the column leaning still more: the column's
# forces, the weight, the inertia force against the ground's acceleration, and the inertia forces in
# the turning frame, for positive rates. The column's force along itself is left out.*
#
# The acceleration of a point at $\boldsymbol r$ that moves with the velocity $\boldsymbol v$ and
# the acceleration $\boldsymbol a$ *in the frame* is
#
# $$ \boldsymbol a_{\text{abs}} = \boldsymbol a +
#    \underbrace{\dot{\boldsymbol\omega}\times\boldsymbol r}_{\text{Euler}} +
#    \underbrace{2\,\boldsymbol\omega\times\boldsymbol v}_{\text{Coriolis}} +
#    \underbrace{\boldsymbol\omega\times(\boldsymbol\omega\times\boldsymbol r)
#      }_{\text{centripetal}} . \tag{2} $$
#
# The rotation is clockwise, so $\boldsymbol\omega = -\dot\theta\,\boldsymbol e_3$, and a cross
# product with $\boldsymbol e_3$ turns a vector by a right angle anticlockwise.

# %%
s = sp.Symbol("s", real=True)  # sgn(theta)


def quarter_turn(vector):
    """e_3 x vector."""
    return sp.Matrix([-vector[1], vector[0]])


def acceleration(place, velocity, relative):
    """The four parts of (2), each in the components of the frame."""
    return {
        "relative": relative,
        "Euler": -theta_dd * quarter_turn(place),
        "Coriolis": -2 * theta_d * quarter_turn(velocity),
        "centripetal": theta_d**2 * quarter_turn(quarter_turn(place)),
    }


r_e, r_b = sp.Matrix([u - s * B, H_e]), sp.Matrix([-s * B, H_b])
still = sp.zeros(2, 1)
parts_e = acceleration(r_e, sp.Matrix([u_d, 0]), sp.Matrix([u_dd, 0]))
parts_b = acceleration(r_b, still, still)
sp.Matrix.hstack(*parts_e.values())

# %% [markdown]
# The columns are the relative, the Euler, the Coriolis and the centripetal acceleration of the
# superstructure. Do not trust a rule that you have not tested: their sum must be the second
# derivative of the position in axes that do not turn.

# %%
t = sp.Symbol("t", real=True)
theta_of_t, u_of_t = sp.Function("theta")(t), sp.Function("u")(t)
plain = [
    (theta_of_t.diff(t, 2), theta_dd), (u_of_t.diff(t, 2), u_dd), (theta_of_t.diff(t), theta_d),
    (u_of_t.diff(t), u_d), (theta_of_t, theta), (u_of_t, u),
]  # fmt: skip
to_fixed_axes = sp.Matrix([[sp.cos(theta), sp.sin(theta)], [-sp.sin(theta), sp.cos(theta)]])
moving = to_fixed_axes.subs(theta, theta_of_t) * r_e.subs(u, u_of_t)
differentiated = moving.diff(t, 2).subs(plain)
total_e = sum(parts_e.values(), still)
assert (differentiated - to_fixed_axes * total_e).applyfunc(sp.expand) == still

# %% [markdown]
# ## 2. Across the column: the equation of $u$
#
# By d'Alembert, the forces on the superstructure along $\boldsymbol e_1$ add up to zero: the
# column's spring and damper, the weight, and the inertia forces. In the frame the direction of the
# weight is $(\sin\theta, -\cos\theta)$, and that of the ground's acceleration $(\cos\theta,
# \sin\theta)$.

# %%
down = to_fixed_axes.T * sp.Matrix([0, -1])
forwards = to_fixed_axes.T * sp.Matrix([1, 0])
load_e = m_e * (g * down - a_g * forwards - total_e)
load_b = m_b * (g * down - a_g * forwards - sum(parts_b.values(), still))

equation_of_u = -sp.expand(load_e[0] - k * u - c * u_d)
sp.Eq(sp.collect(equation_of_u, [u_dd, theta_dd, theta_d]), 0)

# %% [markdown]
# $$ m_e\ddot u + \underbrace{m_e H_e\,\ddot\theta}_{\text{Euler}} -
#    \underbrace{m_e (u - sB)\,\dot\theta^2}_{\text{centrifugal}} -
#    m_e g\sin\theta + k u + c\dot u = -m_e\,\ddot u_g\cos\theta . \tag{3} $$
#
# The Coriolis force is missing: it acts along the column.
#
# ## 3. About the pivot: the equation of $\theta$
#
# For the whole structure the column's forces are internal, and the ground's act at the pivot. The
# moments about $O$ of weights and inertia forces, less the couples $I\ddot\theta$, vanish.


# %%
def clockwise(place, load):
    return place[1] * load[0] - place[0] * load[1]


moments = clockwise(r_e, load_e) + clockwise(r_b, load_b) - (I_eg + I_bg) * theta_dd
equation_of_theta = -sp.expand(moments).subs(s**2, 1)

inertia_about_pivot = I_eg + I_bg + m_b * (B**2 + H_b**2) + m_e * ((B - s * u) ** 2 + H_e**2)
coriolis = 2 * m_e * (u - s * B) * u_d * theta_d
weights = m_e * g * ((s * B - u) * sp.cos(theta) - H_e * sp.sin(theta))
weights += m_b * g * (s * B * sp.cos(theta) - H_b * sp.sin(theta))
shaking = m_e * (H_e * sp.cos(theta) - (u - s * B) * sp.sin(theta))
shaking += m_b * (H_b * sp.cos(theta) + s * B * sp.sin(theta))
by_name = inertia_about_pivot * theta_dd + m_e * H_e * u_dd + coriolis + weights + shaking * a_g
assert sp.expand(by_name - equation_of_theta).subs(s**2, 1).expand() == 0

# %% [markdown]
# $$ I(u)\,\ddot\theta + m_e H_e\,\ddot u +
#    \underbrace{2 m_e (u - sB)\,\dot u\,\dot\theta}_{\text{Coriolis}} +
#    M_{\text{weights}}(\theta, u) = -\ddot u_g\,\sum m\,y , \tag{4} $$
#
# with the moment of inertia about the pivot, which changes with $u$, and $y$ the heights of the
# masses. The centrifugal forces have no moment about $O$. The Euler forces are in $I(u)$.
#
# **Read 5-34 with this.** Its brackets are:
#
# | term of 5-34 | what it is |
# | --- | --- |
# | $m_e R_e^2 + m_e u^2 - 2 s\,m_e u R_e\sin\alpha_e + \dots$ | $I(u)$, by the law of cosines |
# | $(2 m_e u\dot u - 2 s\,m_e\dot u R_e\sin\alpha_e)\,\dot\theta$ | moment of the Coriolis force |
# | $m_e\ddot u R_e\cos\alpha_e$ | moment of the relative inertia force, with the lever $H_e$ |
# | $s\,m_e g\,[R_e\sin(\alpha_e - s\theta) - s\,u\cos\theta]$ | the weight, moved by $u$ |
# | right-hand side | the ground's inertia forces, by the heights of the masses |
#
# In the thesis's $R$ and $\alpha$ both equations agree with it, exactly:

# %%
levers = {
    sp.sin(alpha_e): B / R_e, sp.cos(alpha_e): H_e / R_e,
    sp.sin(alpha_b): B / R_b, sp.cos(alpha_b): H_b / R_b,
}  # fmt: skip
radii = {R_e: sp.sqrt(B**2 + H_e**2), R_b: sp.sqrt(B**2 + H_b**2)}


def less(relation, ours, side):
    """A relation of the thesis minus ours, on one side, in B and H; zero if they agree."""
    stated = (relation.lhs - relation.rhs).subs(sp.sign(theta), side)
    stated = sp.expand_trig(stated).subs(levers).subs(radii)
    return sp.expand(stated - ours.subs(s, side))


for number, ours in [("5-34", equation_of_theta), ("5-35", equation_of_u)]:
    (relation,) = equation(number).printed
    assert [less(relation, ours, side) for side in (1, -1)] == [0, 0]

# %% [markdown]
# Appendix D has them side by side for each sign. D-23, for $\theta < 0$, differs by a sign:

# %%
(printed,), (corrected,) = equation("D-23").printed, equation("D-23").right
assert less(corrected, equation_of_theta, -1) == 0
slip = less(printed, equation_of_theta, -1)
assert sp.expand(slip - 2 * m_e * g * u * sp.cos(theta)) == 0
sp.Eq(sp.Symbol("printed") - sp.Symbol("right"), slip)

# %% [markdown]
# A deformation $u > 0$ moves the weight to the right, on whichever foot the structure stands; its
# moment must have the same sign in both cases. That settles it without any derivation.
#
# ## 4. The engine
#
# The engine is given (1) in fixed axes, and uses energies. Its equations must be (3) and (4).

# %%
in_engine = {p.name: p.symbol for p in model.parameters}
names = {
    m_e: "mass", H_e: "height", I_eg: "inertia", m_b: "base_mass", H_b: "base_height",
    I_bg: "base_inertia", B: "half_width", g: "gravity", k: "stiffness", c: "damping",
}  # fmt: skip
back = {in_engine[name]: symbol for symbol, name in names.items()}
back |= {GROUND_X: a_g, GROUND_Y: 0}
for side, mode in [(1, "right"), (-1, "left")]:
    rows = model.equations(mode).residual.subs(back)
    for row, ours in zip(rows, (equation_of_theta, equation_of_u), strict=True):
        assert sp.simplify(row - ours.subs(s, side)) == 0

# %% [markdown]
# ## 5. The impact: two conservation laws
#
# At $\theta = 0$ the structure comes down on its left foot $O'$ (from $\theta > 0$). In an instant
# only impulses count. There are two velocities to find, and two laws:
#
# 1. The impulse of the ground acts at $O'$. So **angular momentum about $O'$** is conserved, as in
#    Model A.
# 2. The column's spring and damper have finite forces, which give no impulse, and nothing else acts
#    on the superstructure along $\boldsymbol e_1$. So its **momentum across the column** is
#    conserved too. (The column *can* give it an impulse along $\boldsymbol e_2$, and a couple.)
#
# $$ p_u = m_e\,(\dot u + H_e\,\dot\theta) . \tag{5} $$
#
# Before the impact the structure turns about $O$ at $x = +B$, afterwards about $O'$ at $x = -B$. At
# $\theta = 0$ the axes are horizontal and vertical.

# %%
before, after = sp.symbols(r"\dot{\theta}^- \dot{\theta}^+", real=True)
u_before, u_after = sp.symbols(r"\dot{u}^- \dot{u}^+", real=True)


def motion(rate, u_rate, pivot):
    """Mass, place and velocity of both bodies as the structure turns about x = pivot."""
    for m, x, y, slides in [(m_e, u, H_e, u_rate), (m_b, 0, H_b, 0)]:
        yield m, sp.Matrix([x, y]), sp.Matrix([rate * y + slides, -rate * (x - pivot)])


def angular_momentum(rate, u_rate, pivot, about):
    """Clockwise, about the point x = about on the ground."""
    orbital = sum(
        m * clockwise(place - sp.Matrix([about, 0]), velocity)
        for m, place, velocity in motion(rate, u_rate, pivot)
    )
    return orbital + (I_eg + I_bg) * rate


laws = [
    angular_momentum(before, u_before, B, -B) - angular_momentum(after, u_after, -B, -B),
    m_e * (u_before + H_e * before) - m_e * (u_after + H_e * after),
]
solved = sp.solve(laws, [after, u_after], dict=True)[0]
ratio = sp.factor(solved[after] / before)

numerator = I_eg + I_bg + m_b * (H_b**2 - B**2) - m_e * (B**2 - u**2)
denominator = I_eg + I_bg + m_b * (H_b**2 + B**2) + m_e * (B + u) ** 2
assert sp.simplify(ratio - numerator / denominator) == 0
assert sp.simplify(solved[u_after] - u_before - H_e * (before - solved[after])) == 0

# %% [markdown]
# $$ \rho = \frac{\dot\theta^+}{\dot\theta^-} =
#    \frac{I_{e,g} + I_{b,g} + m_b(H_b^2 - B^2) - m_e(B^2 - u^2)}
#         {I_{e,g} + I_{b,g} + m_b(H_b^2 + B^2) + m_e(B + u)^2}, \qquad
#    \dot u^+ = \dot u^- + H_e\,(\dot\theta^- - \dot\theta^+) . \tag{6} $$
#
# For the impact on the right foot $u$ changes its sign. Compare with Model A: $m_e H_e^2$ is
# **not** in it. Across the column the mass goes on as if nothing had happened, and only the rest
# is stopped. The column then vibrates. The engine finds the same by its own
# rule, the projection of momenta on the motions that are free after the impact:

# %%
of = {c_.name: c_ for c_ in model.coordinates}
arriving = {of["theta"].velocity: before, of["u"].velocity: u_before}
engine = model.impulse_map("right", "left").velocities().subs(back).subs(arriving)
assert sp.simplify(engine[0] - solved[after]) == 0
assert sp.simplify(engine[1] - solved[u_after]) == 0

# %% [markdown]
# **The rigid limit.** If the column is rigid it *does* transmit an impulse along $\boldsymbol e_1$.
# Then the second law is lost, $u = \dot u = 0$ takes its place, and the first alone gives 5-14:

# %%
rigid = {u: 0, u_before: 0, u_after: 0}
(rigid_after,) = sp.solve(laws[0].subs(rigid), after)
e = sp.factor(rigid_after / before)
(stated,) = equation("5-14").right
assert sp.simplify(stated.rhs - e**2) == 0
assert sp.simplify(model.velocity_ratio.subs(back) - e) == 0

# %% [markdown]
# So (6) does not tend to 5-14 as $k \to \infty$: an instantaneous impact is faster than any column.
# A real impact lasts a while. If that is long against the period of the column, the column acts as
# if rigid; if it is short, (6) holds.
#
# ## 6. The rule of the thesis
#
# The thesis multiplies $\dot\theta$ by the rigid $e = \sqrt r$ of 5-14, and leaves $\dot u$ as it
# is. The superstructure's absolute velocity $\dot u + H_e\dot\theta$ then jumps, which takes an
# impulse that no finite column force gives. What becomes of the energy?


# %%
def kinetic(rate, u_rate, pivot):
    total = sum(m * (velocity.T * velocity)[0] for m, _, velocity in motion(rate, u_rate, pivot))
    return (total + (I_eg + I_bg) * rate**2) / 2


e_ = sp.Symbol("e", positive=True)
gain = sp.expand(kinetic(e_ * before, u_before, -B) - kinetic(before, u_before, B)).subs(u, 0)
I_O = I_eg + I_bg + m_b * (B**2 + H_b**2) + m_e * (B**2 + H_e**2)
claim = -(1 - e_) * before * ((1 + e_) * I_O * before / 2 + m_e * H_e * u_before)
assert sp.expand(gain - claim) == 0

# %% [markdown]
# For an undeformed column ($u = 0$) the change of kinetic energy is
#
# $$ \Delta T = -(1 - e)\,\dot\theta^-\Bigl[\tfrac{1+e}{2}\,I_O\,\dot\theta^- +
#    m_e H_e\,\dot u^-\Bigr] . \tag{7} $$
#
# It is *positive*, energy out of nothing, if the column vibrates against the rotation fast enough:
#
# $$ -\frac{\dot u^-}{\dot\theta^-} > \frac{(1 + e)\,I_O}{2\,m_e H_e} . \tag{8} $$
#
# For the impulsive law nothing of the kind can happen. Its loss is the kinetic energy of the *lost
# velocities* (Carnot's theorem), a sum of squares:
#
# $$ T^- - T^+ = \tfrac12\sum m\,|\boldsymbol v^- - \boldsymbol v^+|^2 +
#    \tfrac12\,(I_{e,g} + I_{b,g})\,(\dot\theta^- - \dot\theta^+)^2 \;\ge\; 0 . \tag{9} $$

# %%
lost = sum(
    m * ((v1 - v2).T * (v1 - v2))[0]
    for (m, _, v1), (_, _, v2) in zip(
        motion(before, u_before, B), motion(after, u_after, -B), strict=True
    )
)
lost = (lost + (I_eg + I_bg) * (before - after) ** 2) / 2
difference = kinetic(before, u_before, B) - kinetic(after, u_after, -B) - lost
assert sp.simplify(difference.subs(solved)) == 0

# %% [markdown]
# The column of the thesis, asked for one impact on either side of (8):

# %%
COLUMN = {
    "mass": 122.6, "height": 1.05, "inertia": 44.8, "base_mass": 45.6, "base_height": 0.10,
    "base_inertia": 1.37, "half_width": 0.285, "gravity": 9.81,
}  # kg, m, kg m2, m/s2  # fmt: skip
column = rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4)  # N/m, N s/m
numbers = {symbol: COLUMN[name] for symbol, name in names.items() if name in COLUMN}
threshold = float(((1 + e) * I_O / (2 * m_e * H_e)).subs(numbers))
print(f"e = {float(e.subs(numbers)):.3f}, threshold of (8): {threshold:.3f} m")
print(f"ratio of (6) with u = 0: {float(ratio.subs(u, 0).subs(numbers)):.3f}")


def energy_change(law, state, mode):
    """Energy after an impact minus before it [J]."""
    then, follows = column.after_impact(state, mode=mode, impact=law)
    energy = [sum(column.energies(y, mode=m).values()) for y, m in [(state, mode), (then, follows)]]
    return energy[1] - energy[0]


for part in (0.9, 1.1):
    landing = {"theta_dot": -0.1, "u_dot": 0.1 * part * threshold}
    thesis = energy_change(rk.AngularMomentum(), landing, "right")
    impulsive = energy_change(rk.Impulsive(), landing, "right")
    print(f"{part} of the threshold: thesis {thesis:+.4f} J, impulsive {impulsive:+.4f} J")
    assert (thesis > 0) == (part > 1)
    assert impulsive < 0
    expected = float(claim.subs({e_: e, before: -0.1, u_before: landing["u_dot"]}).subs(numbers))
    assert np.isclose(thesis, expected, rtol=1e-9)

# %% [markdown]
# Such impacts are no curiosity. Release the column as in run 1 of the thesis, and look at each
# impact:

# %%
release = {"theta": 0.02636}  # rad; 27.93 mm at the gauge
still_ground = rk.GroundMotion.none(2.2)
laws_of = {"thesis": rk.AngularMomentum(), "impulsive": rk.Impulsive()}
runs, changes = {}, {}
for name, law in laws_of.items():
    run = runs[name] = rk.simulate(column, still_ground, impact=law, initial=release)
    changes[name] = np.array(
        [energy_change(law, impact.before, impact.mode_before) for impact in run.impacts]
    )
    gained = (changes[name] > 1e-9).sum()
    print(f"{name}: {gained} of {len(changes[name])} impacts add energy; rocks until", end=" ")
    print(f"{run.events[-1].time:.2f} s")

assert (changes["thesis"] > 1e-9).any()
assert not (changes["impulsive"] > 1e-9).any()

# %%
rigid_column = rk.LumpedMassStructure(**COLUMN)
runs["rigid"] = rk.simulate(rigid_column, still_ground, initial=release)
figure, axes = plt.subplots(2, 1, figsize=(7.0, 4.6), layout="constrained", sharex=True)
styles = [("rigid", "0.6"), ("thesis", fb.LINES[1]), ("impulsive", fb.LINES[0])]
for name, color in styles:
    label = {"rigid": "rigid, 5-14", "thesis": "flexible, thesis's rule"}.get(name, "flexible, (6)")
    axes[0].plot(runs[name].t, 1e3 * runs[name]["theta"], color=color, label=label)
    if name != "rigid":
        axes[1].plot(runs[name].t, 1e3 * runs[name]["u"], color=color)
axes[0].set(ylabel=r"rotation $\theta$ [mrad]")
axes[1].set(xlabel="time [s]", ylabel="deformation $u$ [mm]")
axes[0].legend(ncols=3)
plt.show()

# %% [markdown]
# *Figure 2. Release of run 1. The first fall is the same; then part of the energy goes into the
# column, which still vibrates when rocking has ended (thesis Figures 5-38 and 5-39).*
#
# The flexible column ceases to rock about half a second before the rigid one, as the thesis
# observes. This is so under either law, and therefore no artefact of the energy that the rule of
# the thesis creates.

# %%
ends = {name: run.events[-1].time for name, run in runs.items()}
print({name: round(end, 2) for name, end in ends.items()})
assert 0.4 < ends["rigid"] - ends["thesis"] < 0.8
assert 0.4 < ends["rigid"] - ends["impulsive"] < 0.8

# %% [markdown]
# ## 7. When a foot cannot lift
#
# The numerator of (6) need not be positive. Without rotary inertias and with $u = 0$ it is $m_b
# H_b^2 - (m_e + m_b)\,B^2$, which is negative for a base that is wider than high. Then (6) says
# that the structure turns about $O'$ *backwards*: its right foot would go into the ground. So the
# ground pushes there as well. Both feet stay: $\dot\theta^+ = 0$, and **full contact** begins.
#
# Is that consistent? In full contact impulses act at both feet. Angular momentum about $O'$ now
# changes by that of $J$, the impulse at the right foot $O$, with the lever $2B$ (anticlockwise).
# The second law holds as before.

# %%
J = sp.Symbol("J", real=True)
landed = {after: 0, u_after: u_before + H_e * before}
(impulse,) = sp.solve(laws[0].subs(landed) - 2 * B * J, J)
assert sp.simplify(impulse - numerator * before / (2 * B)) == 0
sp.Eq(J, sp.factor(impulse))

# %% [markdown]
# $$ J = \frac{\dot\theta^-}{2B}\,\bigl[\text{numerator of } \rho\bigr] . \tag{10} $$
#
# The structure arrives with $\dot\theta^- < 0$. So the right foot is *pushed*, $J > 0$, exactly
# when the numerator is negative. Where it is positive $J$ would have to pull, and the foot lifts
# instead. The two cases exclude each other and leave nothing out: the sign of one number decides.
#
# The same column with all mass in two points:

# %%
points = COLUMN | {"inertia": 0.0, "base_inertia": 0.0}
two_points = rk.FlexibleStructure(**points, stiffness=571.8e3, damping=502.4)
of_points = {symbol: points[name] for symbol, name in names.items() if name in points}
assert float(ratio.subs(u, 0).subs(of_points)) < 0

landing = {"theta_dot": -0.3, "u_dot": 0.02}
then, follows = two_points.after_impact(landing, mode="right", impact=rk.Impulsive())
assert follows == "both"
assert then["theta_dot"] == 0.0
assert np.isclose(then["u_dot"], 0.02 + 1.05 * -0.3, rtol=1e-12)

run = rk.simulate(two_points, rk.GroundMotion.none(0.7), impact=rk.Impulsive(), initial=release)
for event in run.events[:6]:
    print(f"{event.time:.4f} s  {event.kind:7s} {event.mode_before} -> {event.mode_after}")
assert [event.mode_after for event in run.events[:4]] == ["both", "left", "both", "right"]

# %% [markdown]
# Full contact lasts for three milliseconds. Then the column, which the mass has bent, lifts the
# other foot: the structure rocks on, although *every* impact stopped its base. The energy went
# through the column. A rigid body of the same masses would have kept 5-14's share instead.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, axes = plt.subplots(2, 1, figsize=(7.0, 4.2), layout="constrained", sharex=True)
axes[0].plot(run.t, 1e3 * run["theta"], color=fb.LINES[0])
axes[1].plot(run.t, 1e3 * run["u"], color=fb.LINES[0])
for ax in axes:
    edges = run.events[:6]
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        ax.axvspan(start.time, end.time, color=fb.LINES[1], alpha=0.4, lw=0)
axes[0].set(ylabel=r"rotation $\theta$ [mrad]")
axes[1].set(xlabel="time [s]", ylabel="deformation $u$ [mm]")
plt.show()

# %% [markdown]
# *Figure 3. The column with point masses. Bars mark full contact.*
#
# ## Exercises
#
# 1. Derive (3) again with $u$ measured horizontally instead of across the column. Which terms
#    become longer? *Hint: the column's force keeps its direction $\boldsymbol e_1$.*
# 2. Let the superstructure turn by $\beta u$ against the base, as the tip of a cantilever does.
#    What becomes of (5)? *Hint: $I_{e,g}$ joins the momentum that belongs to $u$.*
# 3. Find the two frequencies of small vibrations of the column in full contact and while it rocks.
#    Compare with the thesis's periods. *Hint: in full contact it is $\sqrt{k/m_e}$; while rocking
#    eliminate $\ddot\theta$ from (3) and (4).*
# 4. Show from (6) that a column without mass at its top impacts like the rigid block of its base.
#    *Hint: $m_e = I_{e,g} = 0$, and thesis 2-6.*
# 5. The split of $J = I_{e,g} + I_{b,g} + m_b H_b^2$ did not matter for Model A. Show that (6) and
#    $I(u)$ depend on $J$ alone as well. Is $\rho$ more sensitive to $J$ than 5-14 is?
#    *Hint: compare $\mathrm d\log\rho/\mathrm dJ$ with $u = 0$.*
# 6. Draw the region of $(\theta', u')$ in which the thesis's rule adds energy, for $u \neq 0$ as
#    well. *Hint: `gain` before `u` is set to zero.*
# 7. How do the number of impacts that add energy, and the energy they add, depend on the column's
#    damping? Raise it by factors of ten. *Hint: by (8) it takes a column that vibrates.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# The mass goes on sliding across the column, so that $u = w/\cos\theta$ with the horizontal $w$.
# Put into (3), the spring has $k w/\cos\theta$; the damper and the relative inertia force gain all
# terms that the derivatives of $1/\cos\theta$ make, up to
# $m_e w\,\ddot\theta\sin\theta/\cos^2\theta$ and one in $\dot\theta^2$. Nothing of it is physics.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# The superstructure spins with $\dot\theta + \beta\dot u$. The momentum that belongs to $u$ is the
# derivative of the kinetic energy with respect to $\dot u$, and what is conserved is
# $p_u = m_e(\dot u + H_e\dot\theta) + \beta I_{e,g}(\dot\theta + \beta\dot u)$.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# In full contact $\sqrt{k/m_e}$, the thesis's period of 0.092 s. While it rocks
# $I_O\ddot\theta = -m_eH_e\ddot u$ of the vibration, and (3) becomes
# $m_e(1 - m_eH_e^2/I_O)\,\ddot u + k u = 0$: 0.051 s. The base turns against the bending, and less
# of the mass has to move.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# $\rho = (I_{b,g} + m_b(H_b^2 - B^2))/(I_{b,g} + m_b(H_b^2 + B^2))$, which is the block's.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# The numerator is $J - m_bB^2 - m_e(B^2-u^2)$, the denominator $J + m_bB^2 + m_e(B+u)^2$. With
# $u = 0$ and $M = m_e + m_b$, $\mathrm d\log\rho/\mathrm dJ = 2MB^2/(J^2 - M^2B^4)$. In 5-14 the
# large $m_eH_e^2$ is added to $J$. For the column $\rho$ is 17 times as sensitive.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# For any $u$ the gain is $\dot\theta^-$ times an expression linear in $\dot\theta^-$ and
# $\dot u^-$. The region is a wedge between $\dot\theta^- = 0$ and the line
#
# $$-\frac{\dot u^-}{\dot\theta^-} = \frac{I_O(u)^- - e^2 I_O(u)^+}{2\,(1-e)\,m_eH_e},$$
#
# with the inertias about the old and the new pivot. A column that is bent away from the foot on
# which it lands has the larger one after the impact, and the wedge is wider.
#
# </details>
#
# <details><summary>Solution 7</summary>
#
# Among 95 impacts, 42 add 0.19 J in all; with ten times the damping 37 add 0.02 J, and with a
# hundred times 8 add $2\cdot10^{-8}$ J. The column must still vibrate when a foot lands: where the
# vibration has died away in between, the rule of the thesis takes energy as it should.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
w = sp.Function("w")(t)
slid = w / sp.cos(theta_of_t)
axes_of_t = to_fixed_axes.subs(theta, theta_of_t)
drawn = axes_of_t * sp.Matrix([-s * B, H_e]) + sp.Matrix([w, -w * sp.tan(theta_of_t)])
across = axes_of_t[:, 0]  # e_1
horizontally = m_e * across.dot(drawn.diff(t, 2) + sp.Matrix([a_g, g]))
horizontally += k * slid + c * slid.diff(t)
into_3 = {u: slid, u_d: slid.diff(t), u_dd: slid.diff(t, 2), theta: theta_of_t}
into_3 |= {theta_d: theta_of_t.diff(t), theta_dd: theta_of_t.diff(t, 2)}
gap = horizontally - equation_of_u.subs(into_3)
some = dict(
    zip([m_e, k, c, B, H_e, g, a_g, s], [1.2, 3.0, 0.4, 0.3, 1.1, 9.8, 0.7, 1], strict=True)
)
tilting, bending = 0.2 + 0.5 * t + 0.8 * t**2, 0.1 - 0.3 * t + 0.6 * t**2
assert abs(gap.subs(some).subs({theta_of_t: tilting, w: bending}).doit().subs(t, 0.1)) < 1e-12

beta = sp.Symbol("beta", positive=True)
spinning = m_e * ((u_d + H_e * theta_d) ** 2 + (theta_d * (u - B)) ** 2) / 2
spinning += I_eg * (theta_d + beta * u_d) ** 2 / 2
stated = m_e * (u_d + H_e * theta_d) + beta * I_eg * (theta_d + beta * u_d)
assert sp.expand(spinning.diff(u_d) - stated) == 0

I_O_ = float(I_O.subs(numbers))
lighter = 122.6 * (1 - 122.6 * 1.05**2 / I_O_)
periods = [2 * np.pi * np.sqrt(mass / 571.8e3) for mass in (122.6, lighter)]
assert [round(one, 3) for one in periods] == [0.092, 0.051]
on_one_foot = rk.simulate(
    column, rk.GroundMotion.none(0.2), initial={"theta": 0.15, "u": 0.003}, mode="right"
)
assert set(on_one_foot.mode) == {"right"}
times = np.linspace(0.0, 0.2, 4001)
rate = on_one_foot.at(times)["u_dot"]
turning = times[1:][rate[1:] * rate[:-1] < 0]
assert np.isclose(2 * np.diff(turning).mean(), periods[1], rtol=0.01)
assert np.isclose(column.fixed_base().periods[0], periods[0], rtol=1e-9)

bare = ratio.subs({m_e: 0, I_eg: 0})
assert sp.simplify(bare - (I_bg + m_b * (H_b**2 - B**2)) / (I_bg + m_b * (H_b**2 + B**2))) == 0

joint = sp.Symbol("joint", positive=True)
for of_J in (numerator / denominator, inertia_about_pivot):
    merged = of_J.subs(I_eg, joint - I_bg - m_b * H_b**2)
    assert not sp.cancel(merged).has(I_bg, H_b)
by_J = (numerator / denominator).subs(u, 0).subs(I_eg, joint - I_bg - m_b * H_b**2)
rigid_by_J = e.subs(I_eg, joint - I_bg - m_b * H_b**2)
at_column = {joint: float((I_eg + I_bg + m_b * H_b**2).subs(numbers))} | numbers
slopes = [float(sp.log(one).diff(joint).subs(at_column)) for one in (by_J, rigid_by_J)]
assert round(slopes[0] / slopes[1]) == 17

bent = sp.expand(kinetic(e_ * before, u_before, -B) - kinetic(before, u_before, B))
inertia_of = {pivot: 2 * kinetic(1, 0, pivot) for pivot in (B, -B)}
edge = -(inertia_of[B] - e_**2 * inertia_of[-B]) / (2 * (1 - e_) * m_e * H_e)
assert sp.cancel(bent.subs(u_before, edge * before)) == 0
wedge = {at: float(-edge.subs(e_, e).subs(numbers).subs(u, at)) for at in (-0.005, 0.0, 0.005)}
assert np.isclose(wedge[0.0], threshold)
assert wedge[0.005] < wedge[0.0] < wedge[-0.005]

added = []
for factor in (1, 10, 100):
    damped = rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4 * factor)
    run = rk.simulate(damped, still_ground, impact=rk.AngularMomentum(), initial=release)
    found = np.array([
        sum(damped.energies(impact.after, mode=impact.mode_after).values())
        - sum(damped.energies(impact.before, mode=impact.mode_before).values())
        for impact in run.impacts
    ])  # fmt: skip
    added.append(found[found > 1e-9])
print([f"{len(gained)} impacts add {gained.sum():.0e} J" for gained in added])
assert [len(gained) for gained in added] == [42, 37, 8]
assert 1e-8 < added[2].sum() < 1e-3 < added[1].sum() < 0.2 * added[0].sum()
exercises = Exercises({3: periods[1], 5: 17})

# %%
# your answers
exercises.check(3, ...)  # period while it rocks, in seconds
exercises.check(5, ...)  # sensitivity of rho over that of 5-14
