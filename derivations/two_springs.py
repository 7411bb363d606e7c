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
#     minutes: 60
# ---

# %% [markdown]
# # A rigid structure on two compression-only springs
#
# Ground yields. Under a structure that rocks on soil or on rubber, the pressure moves from one foot
# to the other *before* a foot lifts. Model B of the thesis (Ma 2010, Section 5.3.2) puts the two
# masses of [Model A](lumped_mass_structure.py) on two springs that can press and cannot pull, finds
# the curve of a pushover by statics, and then bases the dynamics on this curve.
#
# ## Aims
#
# After this notebook you can
#
# 1. find settlement, lift-off and the pushover curve from equilibrium, exactly;
# 2. say what linearising does, and explain a jump of 0.14 % where nothing jumps;
# 3. see that "rotates about its centre" and "rotates about its foot" are results, not assumptions,
#    and that they leave something open;
# 4. derive the dynamics of the structure, and say what an equivalent cart gets wrong.

# %%
import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.statics import LOAD, pushover
from rockeom.teaching import Exercises
from rockeom.thesis import equation
from rockeom.thesis.notation import (
    B,
    H_b,
    H_e,
    I_bg,
    I_eg,
    P,
    W,
    a_g,
    delta_0,
    f_L,
    f_R,
    g,
    k_f,
    m_b,
    m_e,
    theta,
    u,
)

use_style()
sp.init_printing()

# %% [markdown]
# ## Your equation first
#
# The structure stands on two springs $k_f$ with dampers $c_f$, a distance $2B$ apart, and the
# centre of its base is guided vertically. Write down the moments about this centre while both
# springs press and the ground rests, and type them in place of ours. `compare` reads symbols by
# their names: `theta`, `theta_dot`, `theta_ddot`, `heave_ddot` for the rise of the centre, and the
# letters of this notebook.

# %%
model = rk.derive(rk.TwoSpringStructure)
c_f, theta_dot, theta_ddot, heave_ddot = sp.symbols("c_f theta_dot theta_ddot heave_ddot")
first_moment = m_e * H_e + m_b * H_b
about_centre = I_eg + m_e * H_e**2 + I_bg + m_b * H_b**2

inertia = about_centre * theta_ddot - first_moment * sp.sin(theta) * heave_ddot
springs = 2 * B**2 * sp.cos(theta) * (k_f * sp.sin(theta) + c_f * sp.cos(theta) * theta_dot)
yours = sp.Eq(inertia + springs, first_moment * g * sp.sin(theta))
print(model.compare(yours, mode="both", ground=()))

# %% [markdown]
# Now with the moment of one foot instead of two. The comparison names the terms that differ. Try
# small rotations, too, with $\theta$ for $\sin\theta$: that is another equation, and it says so.

# %%
mistaken = sp.Eq(inertia + springs / 2, first_moment * g * sp.sin(theta))
comparison = model.compare(mistaken, mode="both", ground=())
print(comparison)
assert model.compare(yours, mode="both", ground=())
assert set(comparison.difference) == {"springs and forces", "damping"}

# %% [markdown]
# ## 1. The structure and its forces
#
# The superstructure $m_e$ is at the height $H_e$ above the feet, the base $m_b$ at $H_b$. Each foot
# stands on a spring of stiffness $k_f$. A horizontal force $P$ pushes at $m_e$. Together the masses
# have the weight $W = (m_e + m_b)\,g$ and, about the base, the first moment
#
# $$ S = m_e H_e + m_b H_b = \frac Wg\,H_c . \tag{1} $$
#
# Somebody must hold the structure horizontally. The thesis says that it does not slide, but not
# *where* it is held. We guide the centre of its base along a vertical line, and come back to this
# in Section 5.


# %% tags=["hide-input"] jupyter={"source_hidden": true}
DELTA = 0.08  # settlement in the drawing


def draw_on_springs(ax, angle, rise, title):
    """The structure turned about the centre of its base, which has risen; positions of interest."""
    b, h, low, soil = 0.42, 1.3, 0.12, -0.42
    centre = np.array([0.0, rise])
    points = [(-b, 0), (b, 0), (b, 2 * low), (-b, 2 * low), (0, 2 * low), (0, h), (0, low)]
    *base, foot, top, bottom = fb.turned(np.array(points) + centre, centre, angle)
    fb.ground(ax, -0.85, 0.85, level=soil, depth=0.1)
    fb.body(ax, base)
    ax.plot(*np.transpose([foot, top]), color=fb.LINES[0], lw=2.5)
    for spring_foot in base[:2]:
        end = min(spring_foot[1], DELTA)  # a spring that is left alone
        fb.spring(ax, (spring_foot[0], soil), (spring_foot[0], end), 0.12)
        ax.plot(*spring_foot, "o", color=fb.INK, ms=4, zorder=6)
    fb.mass(ax, top)
    fb.mass(ax, bottom, size=7)
    ax.set_title(title)
    fb.bare(ax)
    return centre, base[0], base[1], top, bottom


figure, axes = plt.subplots(1, 3, figsize=(8.4, 4.2), layout="constrained")
centre, left, right, top, bottom = draw_on_springs(axes[0], 0.0, 0.0, "(a) settled")
axes[0].plot([-0.75, 0.75], [DELTA, DELTA], color="0.6", lw=0.8, ls=":")
fb.dimension(axes[0], (0.7, 0), (0.7, DELTA), "")
axes[0].annotate(r"$\delta_0$", (0.7, DELTA / 2), (6, -2), textcoords="offset points")
axes[0].plot([0.42, 0.75], [0, 0], color="0.6", lw=0.6)
fb.dimension(axes[0], (-0.42, 0), (-0.42, 1.3), "$H_e$", 0.25, (-11, 0))
fb.dimension(axes[0], (0, -0.6), (0.42, -0.6), "$B$", offset=(0, -8))

for ax, angle, rise, title in [
    (axes[1], 0.1, 0.0, "(b) both springs press"),
    (axes[2], 0.3, 0.42 * np.sin(0.3) - DELTA, "(c) lifted off"),
]:
    centre, left, right, top, bottom = draw_on_springs(ax, angle, rise, title)
    fb.line(ax, centre, (0, 1.55))
    fb.line(ax, centre, centre + 1.12 * (top - centre))
    fb.angle(ax, centre, (0, 2), top, 0.75)
    ax.annotate(r"$\theta$", (0, 0.75), (-10, 2), textcoords="offset points")
    fb.arrow(ax, top, np.add(top, (0.36, 0)), "$P$", offset=(-2, 9))
    fb.arrow(ax, top, np.add(top, (0, -0.3)), "$m_e g$", offset=(15, 2))
    fb.arrow(ax, bottom, np.add(bottom, (0, -0.22)), "$m_b g$", offset=(-2, -8))
    fb.arrow(ax, np.add(right, (0.15, -0.3)), np.add(right, (0.15, 0)), "$f_R$", offset=(4, 8))
    if title.startswith("(b)"):
        fb.arrow(ax, np.add(left, (-0.15, -0.2)), np.add(left, (-0.15, 0)), "$f_L$", offset=(-2, 8))
plt.show()

# %% [markdown]
# *Figure 1. (a) Both springs are pressed by $\delta_0$ under the weight. (b) Pushed, the structure
# turns about the centre of its base, and weight goes over to the right foot. (c) The left foot has
# lifted; the right spring carries everything. Rotations are drawn larger than they are.*
#
# ## 2. Settlement, and why the centre stays where it is
#
# Let $v$ be the rise of the base's centre above its settled position. Then the springs are pressed
# by
#
# $$ \delta_L = \delta_0 - v - B\sin\theta, \qquad
#    \delta_R = \delta_0 - v + B\sin\theta . \tag{2} $$
#
# Without a load, vertical equilibrium gives the settlement (thesis 5-16).

# %%
v = sp.Symbol("v", real=True)
S = m_e * H_e + m_b * H_b
weight = (m_e + m_b) * g
compression = {"left": delta_0 - v - B * sp.sin(theta), "right": delta_0 - v + B * sp.sin(theta)}

at_rest = {theta: 0, v: 0}
(settlement,) = sp.solve(2 * k_f * compression["left"].subs(at_rest) - W, delta_0)
assert settlement == equation("5-16").right[0].rhs
sp.Eq(delta_0, settlement)

# %% [markdown]
# Under a horizontal load the vertical forces still add up to zero. As long as both springs press,

# %%
force = {foot: k_f * value.subs(delta_0, settlement) for foot, value in compression.items()}
(rise_pressed,) = sp.solve(force["left"] + force["right"] - W, v)
assert rise_pressed == 0

# %% [markdown]
# the sines cancel and $v = 0$: **the structure turns about the centre of its base**. This is a
# result of symmetry. With two different springs it would turn about another point.
#
# ## 3. The pushover curve while both springs press
#
# Moments about the centre of the base (the guide's force passes through it):
#
# $$ P\,H_e\cos\theta + g\,S\sin\theta = (f_R - f_L)\,B\cos\theta . \tag{3} $$
#
# The second term is the weights': they have moved to the right by $H\sin\theta$, and help to
# overturn.


# %%
def pushed(rise, left, right):
    """The force P that balances the moments (3), at a rise of the centre."""
    weights = g * S * sp.sin(theta)
    springs = (right - left) * B * sp.cos(theta)
    (found,) = sp.solve(P * H_e * sp.cos(theta) + weights - springs.subs(v, rise), P)
    return sp.simplify(found)


P_pressed = pushed(0, force["left"], force["right"])
by_hand = (2 * k_f * B**2 * sp.sin(theta) - g * S * sp.tan(theta)) / H_e
assert sp.simplify(P_pressed - by_hand) == 0
sp.Eq(P, by_hand)

# %% [markdown]
# $$ P = \frac{2 k_f B^2\sin\theta - g\,S\tan\theta}{H_e}
#    \qquad\text{(both springs press)}. \tag{4} $$
#
# The thesis takes $\theta$ as small. Its forces (5-20, 5-21) and its $P$ (5-24) must be the first
# terms of the Taylor series of ours, and its 5-25 is the same by $u = H_e\theta$.


# %%
def linear(expression):
    """Up to the first order in theta."""
    return sp.series(expression, theta, 0, 2).removeO()


stated = {number: equation(number).right[0].rhs for number in ("5-20", "5-21", "5-24", "5-25")}
assert sp.simplify(linear(force["left"].subs(v, 0)) - stated["5-20"]) == 0
assert sp.simplify(linear(force["right"].subs(v, 0)) - stated["5-21"]) == 0
assert sp.simplify(linear(P_pressed) - stated["5-24"]) == 0
assert sp.simplify(stated["5-25"].subs(u, H_e * theta) - stated["5-24"]) == 0

# %% [markdown]
# ## 4. Lift-off, and after it
#
# The left spring comes free when $\delta_L = 0$, at
#
# $$ \sin\theta_l = \frac{W}{2 k_f B} = \frac{\delta_0}{B} , \tag{5} $$
#
# of which 5-22 is the small angle. From then on the right spring alone carries the weight:

# %%
sine = sp.Symbol("sigma", positive=True)
(lift_off,) = sp.solve(force["left"].subs(v, 0).subs(sp.sin(theta), sine), sine)
assert sp.simplify(lift_off - equation("5-22").right[0].rhs) == 0

(rise_lifted,) = sp.solve(force["right"] - W, v)
depth = (compression["right"].subs(delta_0, settlement)).subs(v, rise_lifted)
assert sp.simplify(depth - 2 * settlement) == 0
sp.Eq(v, rise_lifted)

# %% [markdown]
# The centre now rises by $B\sin\theta - \delta_0$, and the right spring stays pressed by
# $2\delta_0$: **the pressed foot stays at its level, the structure turns about it**. Put into (3)
# with $f_L = 0$ and $f_R = W$,
#
# $$ P = \frac{W B - g\,S\tan\theta}{H_e} \qquad\text{(lifted off)}. \tag{6} $$

# %%
P_lifted = pushed(rise_lifted, sp.Integer(0), W)
assert sp.simplify(P_lifted - (W * B - g * S * sp.tan(theta)) / H_e) == 0

at_lift_off = {theta: sp.asin(lift_off)}
assert sp.simplify((P_lifted - P_pressed).subs(at_lift_off)) == 0

# %% [markdown]
# The last line says that the force does **not** jump at lift-off. How could it: the spring's force
# goes to zero before the spring is gone. Still, the thesis has two different forces there, 5-26 and
# 5-32. To see why, we need the question that was left open.
#
# ## 5. Where is it held?
#
# In (3) the guide's force had no moment, because it passes through the centre of the base. The
# thesis takes moments about the *pressed foot* after lift-off (5-31): it lets the horizontal force
# act there. Then the foot stays, and the rest of the structure moves.
#
# We find the curve for this case by another method, virtual work, which does not ask for reactions:
# $P\,\mathrm dx = \mathrm dU$, with $x$ the displacement of $m_e$ and $U$ the energy of weights and
# springs.


# %%
def by_virtual_work(shift, rise, springs):
    """P for a structure whose centre moves by `shift` and `rise` as it turns."""
    x = shift + H_e * sp.sin(theta)
    height = sum(m * (rise + H * sp.cos(theta)) for m, H in [(m_e, H_e), (m_b, H_b)])
    energy = g * height + springs
    return energy.diff(theta) / x.diff(theta)


def energy_of_springs(rise, feet):
    return sum(
        k_f * compression[foot].subs({delta_0: settlement, v: rise}) ** 2 / 2 for foot in feet
    )


def vanishes(expression):
    """Whether it is zero as a fraction of sines and cosines."""
    return sp.cancel(expression.replace(sp.tan, lambda a: sp.sin(a) / sp.cos(a))) == 0


shift = {"centre": sp.Integer(0), "foot": B - B * sp.cos(theta)}
rises = {"pressed": sp.Integer(0), "lifted": rise_lifted.subs(W, weight)}
curve = {}
for held, moved in shift.items():
    for state, feet in [("pressed", ["left", "right"]), ("lifted", ["right"])]:
        springs = energy_of_springs(rises[state], feet).subs(W, weight)
        curve[held, state] = by_virtual_work(moved, rises[state], springs)

assert vanishes(curve["centre", "pressed"] - P_pressed.subs(W, weight))
assert vanishes(curve["centre", "lifted"] - P_lifted.subs(W, weight))

# %% [markdown]
# With the foot held,
#
# $$ P = \frac{(2 k_f B^2\cos\theta - g S)\sin\theta}{H_e\cos\theta + B\sin\theta}
#    \quad\text{and}\quad
#    P = \frac{W B\cos\theta - g S\sin\theta}{H_e\cos\theta + B\sin\theta} . \tag{7} $$
#
# The numerators are those of (4) and (6), only the lever of $P$ is another: the mass now moves
# forward by $B(1 - \cos\theta)$ more. So all along
#
# $$ P_{\text{centre}} = P_{\text{foot}}\,\Bigl(1 + \frac{B}{H_e}\tan\theta\Bigr) . \tag{8} $$

# %%
factor = 1 + B / H_e * sp.tan(theta)
for state in ("pressed", "lifted"):
    assert vanishes(curve["centre", state] - curve["foot", state] * factor)

# %% [markdown]
# Equation 5-31, $P = W R_c\sin(\alpha_c - \theta)/[R_e\cos(\alpha_e - \theta)]$, is the second of
# (7), exactly:

# %%
(after_lift_off,) = equation("5-31").right
polar = {name: sp.Symbol(name, positive=True) for name in ("R_e", "alpha_e", "R_c", "alpha_c")}
H_c = S / (m_e + m_b)
heights = {"e": H_e, "c": H_c}
levers = {}
for index, height in heights.items():
    R, alpha = polar[f"R_{index}"], polar[f"alpha_{index}"]
    levers |= {sp.sin(alpha): B / R, sp.cos(alpha): height / R}
expanded = sp.expand_trig(after_lift_off.rhs).subs(levers).subs(W, weight)
assert vanishes(expanded - curve["foot", "lifted"])

# %% [markdown]
# ## 6. A jump of 0.14 %
#
# Now the two forces at lift-off can be named. 5-26 is the linear 5-24 at $\theta_l$, and that is
# (4) with the *centre* held, less terms of the third order. 5-32 is (7), with the *foot* held. By
# (8) the second is smaller, and to the first order in $\theta_l$, with $P \approx W B/H_e$ at
# lift-off,
#
# $$ P_{5\text{-}32} - P_{5\text{-}26} = -\frac{W B}{H_e}\,\frac{B}{H_e}\,\theta_l +
#    O(\theta_l^2) . \tag{9} $$
#
# Why then does 5-24 look the same for both restraints? As a series in $\theta$ it is: (8) changes
# the term of second order only. But at lift-off that term, $2 k_f B^3\theta^2/H_e^2$, is not small:
# with $k_f = W/(2 B\theta_l)$ it is of the first order in $\theta_l$.

# %%
angle = sp.Symbol("theta_l", positive=True)
stiff = {k_f: weight / (2 * B * angle)}  # the stiffness with this lift-off
P_26 = equation("5-26").right[0].rhs.subs(W, weight).subs(stiff)
P_32 = equation("5-32").right[0].rhs.subs(W, weight).subs(stiff)
jump = sp.series(sp.expand_trig(P_32).subs(levers) - P_26, angle, 0, 2).removeO()
assert sp.simplify(jump + weight * B**2 / H_e**2 * angle) == 0

# %% [markdown]
# Nothing jumps; two branches with different restraints were joined. With numbers, for the steel
# column of the thesis on rubber, $k_f = 550$ kN/m:

# %%
COLUMN = {
    "mass": 122.6, "height": 1.05, "inertia": 44.8, "base_mass": 45.6, "base_height": 0.10,
    "base_inertia": 1.37, "half_width": 0.285, "gravity": 9.81,
}  # kg, m, kg m2, m/s2  # fmt: skip
K_F = 550e3  # N/m
names = {
    m_e: "mass", H_e: "height", I_eg: "inertia", m_b: "base_mass", H_b: "base_height",
    I_bg: "base_inertia", B: "half_width", g: "gravity",
}  # fmt: skip
numbers = {symbol: COLUMN[name] for symbol, name in names.items()} | {k_f: K_F}
theta_l = float(sp.asin(lift_off).subs(W, weight).subs(numbers))
small_l = float(lift_off.subs(W, weight).subs(numbers))

P_crit = float(P_26.subs(angle, small_l).subs(numbers))
bent = sp.expand_trig(equation("5-32").right[0].rhs).subs(levers)
P_crit2 = float(bent.subs(W, weight).subs(numbers))
print(f"settlement {float(settlement.subs(W, weight).subs(numbers)) * 1e3:.2f} mm,", end=" ")
print(f"lift-off at {np.degrees(theta_l):.3f} degrees, {1.05e3 * np.sin(theta_l):.2f} mm")
print(f"5-26: {P_crit:.2f} N, 5-32: {P_crit2:.2f} N, jump {100 * (P_crit2 / P_crit - 1):.2f} %")
print(f"(9): {100 * float(jump.subs(angle, small_l).subs(numbers)) / P_crit:.2f} %")
assert np.isclose(P_crit2 / P_crit - 1, -0.0014, atol=5e-5)

# %% tags=["hide-input"] jupyter={"source_hidden": true}
evaluate = {key: sp.lambdify(theta, value.subs(numbers)) for key, value in curve.items()}
before = np.linspace(1e-9, theta_l, 60)
b, h = COLUMN["half_width"], COLUMN["height"]
H_C = float(H_c.subs(numbers))
after = np.linspace(theta_l, np.arctan(b / H_C), 300)

figure, (whole, near) = plt.subplots(1, 2, figsize=(8.0, 3.4), layout="constrained")
for held, style, color in [("centre", "-", fb.LINES[0]), ("foot", "--", fb.LINES[1])]:
    advance = sp.lambdify(theta, (shift[held] + H_e * sp.sin(theta)).subs(numbers))
    angles = np.concatenate([before, after])
    forces = np.concatenate([evaluate[held, "pressed"](before), evaluate[held, "lifted"](after)])
    for ax in (whole, near):
        ax.plot(1e3 * advance(angles), forces, style, color=color, label=f"{held} held, exact")
u_crit = h * small_l
radius, lean = np.hypot(b, h), np.arctan2(b, h)
u_top = radius * (np.sin(lean) + np.sin(np.arctan(b / H_C) - lean))  # 5-33
for ax in (whole, near):
    ax.plot(
        1e3 * np.array([0, u_crit, u_crit, u_top]), [0, P_crit, P_crit2, 0], ":", color="k",
        label="thesis 5-25, 5-33",
    )  # fmt: skip
whole.set(xlabel="displacement of $m_e$ [mm]", ylabel="$P$ [N]", title="(a) whole curve")
near.set(
    xlabel="displacement of $m_e$ [mm]", title="(b) near lift-off", xlim=(5.2, 6.2), ylim=(437, 442)
)
whole.legend()
plt.show()

# %% [markdown]
# *Figure 2. The force of a pushover on the column. (b) enlarges the corner: both exact curves are
# continuous, each has its own height, and the thesis goes from one (5-26) to the other (5-32).*

# %% [markdown]
# ## 7. The engine
#
# The engine has the same structure, its centre guided, and condenses the heave by itself. Its
# closed forms must be (4) and (6), and its numbers must lie on them.

# %%
in_engine = {p.name: p.symbol for p in model.parameters}
back = {in_engine[name]: symbol for symbol, name in names.items()}
back |= {in_engine["foundation_stiffness"]: k_f, LOAD: P}
for state, mode in [("pressed", "both"), ("lifted", "right")]:
    assert vanishes(pushover(model, mode).subs(back) - curve["centre", state])

structure = rk.TwoSpringStructure(**COLUMN, foundation_stiffness=K_F, foundation_damping=0.0)
np.testing.assert_allclose(
    structure.pushover(before[1:]), evaluate["centre", "pressed"](before[1:]), rtol=1e-9
)
np.testing.assert_allclose(
    structure.pushover(after[1:]), evaluate["centre", "lifted"](after[1:]), rtol=1e-9, atol=1e-7
)

# %% [markdown]
# ## 8. Motion: two equations, not one
#
# Now let the ground shake. The structure has two freedoms, the rotation $\theta$ and the heave $v$.
# By d'Alembert, the vertical forces and the moments about the centre of the base must vanish, with
# the inertia force $-m\,\boldsymbol a$ of each mass and its couple $-I_g\ddot\theta$ included. In
# axes that move with the ground, a mass is at $(H\sin\theta,\; v + H\cos\theta)$.

# %%
t = sp.Symbol("t", real=True)
rotation, heave = sp.Function("theta")(t), sp.Function("v")(t)
bodies = [(m_e, H_e, I_eg), (m_b, H_b, I_bg)]


def clockwise(place, load):
    return place[1] * load[0] - place[0] * load[1]


about_centre, vertical = 0, 0
for m, H, I_g in bodies:
    from_centre = sp.Matrix([H * sp.sin(rotation), H * sp.cos(rotation)])
    acceleration = (from_centre + sp.Matrix([0, heave])).diff(t, 2)
    load = -m * (acceleration + sp.Matrix([a_g, g]))
    about_centre += clockwise(from_centre, load) - I_g * rotation.diff(t, 2)
    vertical += load[1]
about_centre += (f_L - f_R) * B * sp.cos(rotation)
vertical += f_L + f_R

# %% [markdown]
# Written out, with $I_C = I_{e,g} + m_e H_e^2 + I_{b,g} + m_b H_b^2$, the inertia about the centre
# of the base,
#
# $$ \begin{aligned}
# I_C\,\ddot\theta - S\sin\theta\,\ddot v - g\,S\sin\theta + (f_R - f_L)\,B\cos\theta
#    &= -S\,\ddot u_g\cos\theta \\
# (m_e + m_b)\,\ddot v - S\sin\theta\,\ddot\theta - S\cos\theta\,\dot\theta^2 + W - f_L - f_R &= 0 .
# \end{aligned} \tag{10} $$

# %%
rates = sp.symbols(r"\dot{\theta} \ddot{\theta} \dot{v} \ddot{v}", real=True)
theta_d, theta_dd, v_d, v_dd = rates
plain = [
    (rotation.diff(t, 2), theta_dd), (heave.diff(t, 2), v_dd), (rotation.diff(t), theta_d),
    (heave.diff(t), v_d), (rotation, theta), (heave, v),
]  # fmt: skip
turning, rising = about_centre.subs(plain), vertical.subs(plain)

I_C = I_eg + m_e * H_e**2 + I_bg + m_b * H_b**2
sin, cos = sp.sin(theta), sp.cos(theta)
rows = [
    I_C * theta_dd - S * sin * v_dd - g * S * sin + (f_R - f_L) * B * cos + S * a_g * cos,
    (m_e + m_b) * v_dd - S * sin * theta_dd - S * cos * theta_d**2 + weight - f_L - f_R,
]
assert sp.simplify(sp.expand(turning + rows[0])) == 0
assert sp.simplify(sp.expand(rising + rows[1])) == 0

# %% [markdown]
# Only the forces of the springs distinguish the modes. In flight both are
# zero. The engine's springs have dampers $c_f$ in parallel, which we let vanish here.

# %%
back |= {GROUND_X: a_g, GROUND_Y: 0, in_engine["foundation_damping"]: 0}
springs = {foot: value.subs(W, weight) for foot, value in force.items()}
feet_of = {"both": ("left", "right"), "right": ("right",), "left": ("left",), "flight": ()}
for mode, feet in feet_of.items():
    pressing = {f_L: springs["left"] if "left" in feet else 0}
    pressing |= {f_R: springs["right"] if "right" in feet else 0}
    engine = model.equations(mode).residual.subs(back)
    for row, ours in zip(engine, rows, strict=True):
        assert sp.simplify(row - ours.subs(pressing)) == 0

# %% [markdown]
# There is no impact law. A foot that lands meets a spring, and what is lost is lost in $c_f$.
#
# ## 9. Errors of the cart
#
# The thesis goes another way: it takes the pushover curve as the spring of a cart (5-15),
#
# $$ (m_e + m_b)\,\ddot u + k(u) = -(m_e + m_b)\,\ddot u_g , \tag{11} $$
#
# and justifies the mass by the base shear. Compare with (10) for small rotations with both springs
# pressed. There $v = 0$ and $u = H_e\theta$; divide the moments by $H_e$:

# %%
pressed_row = rows[0].subs({f_L: springs["left"], f_R: springs["right"]}).subs({v: 0, v_dd: 0})
small = linear(pressed_row) / H_e
u_dd = sp.Symbol(r"\ddot{u}", real=True)
in_u = sp.expand(small.subs({theta: u / H_e, theta_dd: u_dd / H_e}))
terms = {"inertia": in_u.coeff(u_dd), "drive": in_u.subs({u: 0, u_dd: 0}).coeff(a_g)}
assert sp.simplify(terms["inertia"] - I_C / H_e**2) == 0
assert sp.simplify(terms["drive"] - S / H_e) == 0
assert sp.simplify(in_u.coeff(u) - stated["5-25"].diff(u)) == 0

# %% [markdown]
# $$ \frac{I_C}{H_e^2}\,\ddot u + k\,u = -\frac{S}{H_e}\,\ddot u_g . \tag{12} $$
#
# The stiffness is the cart's. The other two coefficients are not:

# %%
total = numbers[m_e] + numbers[m_b]
overdriven = total / float(terms["drive"].subs(numbers))
too_inert = total / float(terms["inertia"].subs(numbers))
print(f"load:    cart / structure = {overdriven:.4f}")
print(f"inertia: cart / structure = {too_inert:.4f}")
assert np.isclose(overdriven, 1.325, atol=5e-4)
assert np.isclose(too_inert, 1.02, atol=1e-3)

# %% [markdown]
# The **load** is too large by $m_T H_e/S = H_e/H_c$, here by 32.5 %. The base's mass is at the
# ground, and its inertia force has hardly a moment; the cart lifts it to the top. The **inertia**
# is right within 2 %, by coincidence: the rotary inertias of this column make up for the base. A
# shear at the base is indeed $m_T\,\ddot u_g$, but what turns a structure over is a moment.
#
# The engine has both. Let the ground accelerate by a small constant amount, suddenly. Each system
# swings to twice its static displacement, whatever its inertia. The ratio of the two is the factor
# above:

# %%
cart = rk.TwoSpringCart(**COLUMN, foundation_stiffness=K_F)
step = rk.GroundMotion.constant(-0.05, 0.2)  # m/s2, s
swing = {
    "structure": h * np.abs(rk.simulate(structure, step)["theta"]).max(),
    "cart": np.abs(rk.simulate(cart, step)["u"]).max(),
}
print(f"cart / structure = {swing['cart'] / swing['structure']:.4f}")
assert np.isclose(swing["cart"] / swing["structure"], overdriven, rtol=2e-3)

# %% [markdown]
# In a pulse that makes the feet lift the difference grows, for the restoring force does not:

# %%
pulse = rk.GroundMotion.single_sine(3.2, 0.5, duration=1.2)
runs = {"structure, (10)": rk.simulate(structure, pulse), "cart, (11)": rk.simulate(cart, pulse)}

figure, ax = plt.subplots(figsize=(7.0, 3.2), layout="constrained")
for (name, run), color in zip(runs.items(), fb.LINES, strict=False):
    ax.plot(run.t, 1e3 * run["displacement"], color=color, label=name)
ax.axhline(0, color=fb.INK, lw=0.6)
ax.set(xlabel="time [s]", ylabel="displacement of $m_e$ [mm]")
ax.legend()
plt.show()

peak = [np.abs(run["displacement"]).max() for run in runs.values()]
print(f"peaks {1e3 * peak[0]:.1f} mm and {1e3 * peak[1]:.1f} mm")

# %% [markdown]
# *Figure 3. Column and cart under a single sine of 3.2 m/s2 and 0.5 s. The cart passes its upright
# position with an impact (5-14), the structure with springs that have no damping here.*

# %% [markdown]
# ## Exercises
#
# 1. Let the springs differ, $k_L \ne k_R$. About which point does the structure turn while both
#    press? *Hint: solve the vertical equilibrium for $v(\theta)$ and look for the point of the base
#    that stays at its level.*
# 2. Find the vertical period of the column on its springs and the period of its rocking at small
#    rotations. Which of the two does the cart have? *Hint: linearise both rows of (10).*
# 3. How stiff must the springs be for the column to stand at all? *Hint: the slope of (4) at
#    $\theta = 0$.*
# 4. The second of (7) does not contain $k_f$. Show that it is the pushover of Model A on fixed
#    pivots. *Hint: moments about the pivot, and `rk.LumpedMassStructure(**COLUMN).pushover(...)`.*
# 5. Which height and mass would a cart need for its load *and* its inertia to be right? Can it have
#    both, after lift-off too? *Hint: after lift-off $I_C$ becomes $I_O$.*
# 6. At which ground acceleration does a foot of the column lift, if the shaking is slow? And of the
#    cart? *Hint: compare (12) with $P$ at lift-off.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# From the position of rest the forces change by $-k_L(v + B\sin\theta)$ and
# $-k_R(v - B\sin\theta)$. Their sum vanishes for $v = B\sin\theta\,(k_R-k_L)/(k_R+k_L)$. The point
# of the base at $x = B\,(k_R-k_L)/(k_R+k_L)$ keeps its level: it is nearer to the stiffer spring.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# The linear rows are $(m_e+m_b)\ddot v + 2k_fv = 0$ and
# $I_C\ddot\theta + (2k_fB^2 - gS)\,\theta = 0$, with periods of 0.078 s and 0.286 s. The cart has
# the second, 1 % too long, by its mass; it has no vertical motion at all.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $2k_fB^2 > gS$, that is $k_f > gS/(2B^2) = 8.0$ kN/m. On softer springs the weights overturn the
# column as soon as it leaves upright, though no foot has lifted.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# About the pivot the masses are at $(-B\cos\theta + H\sin\theta,\ B\sin\theta + H\cos\theta)$.
# Moments of $P$ and of the weights:
# $P\,(H_e\cos\theta + B\sin\theta) = WB\cos\theta - gS\sin\theta$. The spring under the foot is
# pressed by the same force all the time, and takes no part.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# A mass $M$ at the height $H$ has the load $MH$ and the inertia $MH^2$. Both are right for
# $H = I_C/S = 1.36$ m and $M = S^2/I_C = 98$ kg: the centre of percussion. After lift-off the
# structure turns about its foot, and $H$ would have to be $I_O/S = 1.47$ m. One cart cannot have
# both.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# For slow shaking the inertia forces act like $P$, but each at its own height: $a\,S = P\,H_e$ at
# lift-off, so that $a = P\,H_e/S = 3.48$ m/s². The cart lifts where $(m_e+m_b)\,a = P$, at 2.62
# m/s²: too early by the factor $H_c/H_e$ of its load.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
k_L, k_R, lean, across = sp.symbols("k_L k_R lean x", positive=True)  # lean: B sin(theta)
(risen,) = sp.solve(k_L * (v + lean) + k_R * (v - lean), v)
(still_at,) = sp.solve(risen - across / B * lean, across)
assert sp.simplify(still_at - B * (k_R - k_L) / (k_R + k_L)) == 0

I_C_, S_, total_ = (float(q.subs(numbers)) for q in (I_C, S, m_e + m_b))
turns = 2 * K_F * b**2 - 9.81 * S_
periods = 2 * np.pi * np.sqrt([total_ / (2 * K_F), I_C_ / turns])
for period, state in zip(periods, ("heave", "theta"), strict=True):
    start = {"theta": 0.0, "heave": 0.0} | {state: 1e-5}
    vibrates = rk.simulate(structure, rk.GroundMotion.none(1.01 * period), initial=start)
    moved = vibrates.at([0.5 * period, period], names=[state])[state]
    rest = vibrates.at([0.25 * period], names=[state])[state]
    assert np.allclose(moved - rest, [-1e-5, 1e-5], rtol=1e-2)
of_cart = 2 * np.pi * np.sqrt(total_ * h**2 / turns)
assert [round(one, 3) for one in periods] == [0.078, 0.286]
assert round(of_cart / periods[1], 2) == 1.01

softest = 9.81 * S_ / (2 * b**2)
assert round(softest / 1e3, 1) == 8.0
slope = P_pressed.diff(theta).subs(theta, 0).subs(W, weight).subs(numbers | {k_f: softest})
assert abs(float(slope)) < 1e-9

on_pivots = rk.LumpedMassStructure(**COLUMN)
np.testing.assert_allclose(
    on_pivots.pushover(after), evaluate["foot", "lifted"](after), rtol=1e-9, atol=1e-9
)

I_O_ = I_C_ + total_ * b**2
assert [round(one / S_, 2) for one in (I_C_, I_O_)] == [1.36, 1.47]
assert round(S_**2 / I_C_) == 98

slow = {"structure": P_crit * h / S_, "cart": P_crit / total_}
assert [round(one, 2) for one in slow.values()] == [3.48, 2.62]
exercises = Exercises({2: periods[1], 3: softest, 6: slow["structure"]})

# %%
# your answers
exercises.check(2, ...)  # period of rocking in seconds
exercises.check(3, ...)  # in N/m
exercises.check(6, ...)  # of the structure, in m/s2
