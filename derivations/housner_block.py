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
#     level: first course
#     minutes: 60
# ---

# %% [markdown]
# # Housner's block
#
# A rigid block stands on rigid ground. Tilt it and let go: it rocks from one bottom edge to the
# other until it comes to rest. Housner (1963) used this block to explain why tall water towers
# had survived an earthquake in which sturdier structures fell. Almost everything in the mechanics
# of rocking is a variation on it.
#
# ## Aims
#
# After this notebook you can
#
# 1. draw the free body of a rocking block and name its pivots, angles and forces;
# 2. derive its equation of motion by two routes, moments and energy, and say why they agree;
# 3. find the forces that the ground must supply;
# 4. compute how long a quarter of a rocking cycle takes, and why that depends on the amplitude;
# 5. read the phase portrait of the block, with its balance point and its separatrix.
#
# The engine of rockeom derives the same equations by a third route, Lagrange's. Wherever this
# notebook reaches a result, an assertion compares it with the engine's: exactly, as symbols, or
# as numbers with a stated tolerance.

# %%
import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.integrate import quad
from scipy.special import ellipk, ellipkinc

import rockeom as rk
from rockeom import analysis
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.reactions import reactions
from rockeom.teaching import Exercises
from rockeom.thesis import equation

use_style()

# %% [markdown]
# ## Your equation first
#
# Write down the equation of motion of a block that rocks freely about its right edge, $\theta > 0$
# clockwise, before you read on. Type it in place of ours, as an equation of SymPy. `compare` reads
# symbols by their names: `theta`, `theta_dot`, `theta_ddot`, `m`, `g`, `B`, `H`, `I_g`, and `R`,
# `alpha`, `I_o`, `p` of equations (1), (5) and (8) below. `ground=()` is for ground at rest.

# %%
model = rk.derive(rk.RigidBlock)
p, alpha, theta, theta_ddot = sp.symbols("p alpha theta theta_ddot")

yours = sp.Eq(theta_ddot, -(p**2) * sp.sin(alpha - theta))
print(model.compare(yours, mode="right", ground=()))

# %% [markdown]
# Equal, divided by the moment of inertia about the edge. Now with a mistake: the moment of the
# weight has the wrong sense. The comparison names the term that differs.

# %%
m, g, B, H, I_o = sp.symbols("m g B H I_o")
mistaken = sp.Eq(I_o * theta_ddot, m * g * (B * sp.cos(theta) - H * sp.sin(theta)))
comparison = model.compare(mistaken, mode="right", ground=())
print(comparison)
assert model.compare(yours, mode="right", ground=())
assert set(comparison.difference) == {"gravity"}

# %% [markdown]
# ## 1. Geometry, pivots and free body
#
# The block has the half-width $B$ and its centroid $G$ at the height $H$. Seen from a bottom edge,
# the centroid is at the distance $R$, in a direction that makes the angle $\alpha$ with the
# vertical:
#
# $$B = R \sin\alpha, \qquad H = R \cos\alpha. \tag{1}$$
#
# The rotation $\theta$ is positive clockwise. For $\theta > 0$ the block turns about its right
# edge $O$, for $\theta < 0$ about its left edge $O'$. We assume that the edge that touches the
# ground neither slides nor lifts; below we find the forces that this takes.


# %% tags=["hide-input"] jupyter={"source_hidden": true}
def block_corners(half_width, half_height, theta):
    """(4, 2) corners of the block and (2,) its centroid, turned about the edge it stands on."""
    b, h = half_width, half_height
    upright = [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h), (0, h)]
    *corners, centre = fb.turned(upright, (b if theta > 0 else -b, 0), theta)
    return np.array(corners), centre


b, h, tilt = 0.4, 0.8, 0.15
figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 4.4), layout="constrained")

corners, centre = block_corners(b, h, 0.0)
fb.ground(left, -0.85, 0.85, depth=0.07)
fb.body(left, corners)
fb.line(left, (b, 0), (b, 1.15))
fb.line(left, (b, 0), centre)
fb.centroid(left, centre, "$G$", (-10, 6))
fb.angle(left, (b, 0), (b, 1), centre, 0.42, r"$\alpha$", label_radius=1.18)
fb.dimension(left, (b, 0), centre, "$R$", 0.0, (-9, -3))
fb.dimension(left, (0, 0), (b, 0), "$B$", -0.19, (0, -8))
fb.dimension(left, (-b, 0), (-b, h), "$H$", 0.12, (-9, 0))
fb.pivot(left, (b, 0), "$O$", (11, -8))
fb.pivot(left, (-b, 0), "$O'$", (-11, -8))
left.set_title("(a) at rest")

corners, (gx, gy) = block_corners(b, h, tilt)
pivot, centre = (b, 0), (gx, gy)
fb.ground(right, -0.85, 1.25, depth=0.07)
fb.body(right, block_corners(b, h, 0.0)[0], faint=True)
fb.body(right, corners)
fb.line(right, pivot, (b, 1.25))
fb.line(right, pivot, centre)
fb.angle(right, pivot, (b, 1), centre, 0.6, r"$\alpha-\theta$", label_radius=1.17)
fb.angle(right, pivot, (-b, 0), corners[0], 0.62, r"$\theta$", sense=True, label_radius=1.14)
fb.arrow(right, centre, (gx, gy - 0.36), "$mg$", offset=(-13, 4))
fb.arrow(right, centre, (gx - 0.62, gy), r"$m\,a_g$", offset=(-4, 9))
fb.arrow(right, (b, -0.42), pivot, "$N$", label_at="tail", offset=(9, 3))
fb.arrow(right, (b - 0.4, -0.13), (b, -0.13), "$F$", label_at="tail", offset=(-8, 0))
fb.arrow(right, (0.8, 0.12), (1.15, 0.12), "$a_g$", color=fb.MOTION, offset=(0, 9))
fb.centroid(right, centre, "$G$", (10, 7))
fb.pivot(right, pivot, "$O$", (13, 8))
right.set_title(r"(b) rocking about $O$, $\theta > 0$")
for ax in (left, right):
    fb.bare(ax)
plt.show()

# %% [markdown]
# *Figure 1. (a) The block and its two pivots. (b) The free body as it rocks about $O$: the weight
# $mg$, the ground's forces $F$ (to the right) and $N$ (upwards) at the pivot, and, in axes that
# move with the ground, the inertia force $m\,a_g$ against the ground's acceleration $a_g$.*
#
# Two things can be read from Figure 1 before any calculation. The lever of the weight about $O$ is
# $R\sin(\alpha - \theta)$: it shrinks as the block tilts and vanishes at $\theta = \alpha$, where
# the centroid stands above the pivot. And the lever of the inertia force is the height of the
# centroid, $R\cos(\alpha - \theta)$, *with the same angle*. Keep this in mind for Section 5.

# %% [markdown]
# ## 2. First route: Newton and Euler
#
# Let $x_g(t)$ be the ground's displacement, and $O$ the origin on the ground. From Figure 1 (b)
# the centroid is at
#
# $$x_G = x_g - R\sin(\alpha - \theta), \qquad y_G = R\cos(\alpha - \theta). \tag{2}$$

# %%
t = sp.Symbol("t", real=True)
m, R, alpha, I_G, g = sp.symbols("m R alpha I_g g", positive=True)
F, N = sp.symbols("F N", real=True)
theta_of_t, x_g = sp.Function("theta")(t), sp.Function("x_g")(t)

x_G = x_g - R * sp.sin(alpha - theta_of_t)
y_G = R * sp.cos(alpha - theta_of_t)

# %% [markdown]
# Differentiate twice, then write plain symbols $\theta, \dot\theta, \ddot\theta, a_g$ for the
# functions of time. The acceleration has a tangential part, with $\ddot\theta$, and a centripetal
# one, with $\dot\theta^2$.

# %%
theta, theta_d, theta_dd = sp.symbols(r"theta \dot{\theta} \ddot{\theta}", real=True)
a_g = sp.Symbol("a_g", real=True)


def without_time(expression):
    """The expression in theta, its rates and the ground's acceleration."""
    highest_first = [
        (theta_of_t.diff(t, 2), theta_dd),
        (theta_of_t.diff(t), theta_d),
        (theta_of_t, theta),
        (x_g.diff(t, 2), a_g),
    ]
    return expression.doit().subs(highest_first)


acceleration_x = without_time(x_G.diff(t, 2))
acceleration_y = without_time(y_G.diff(t, 2))
sp.Matrix([acceleration_x, acceleration_y])

# %% [markdown]
# Newton's law for the centroid gives the two forces of the ground,
#
# $$F = m\,\ddot x_G, \qquad N = m\,(g + \ddot y_G), \tag{3}$$
#
# and Euler's law for the rotation about the centroid, clockwise positive, is
#
# $$I_g\,\ddot\theta = -N\,R\sin(\alpha-\theta) - F\,R\cos(\alpha-\theta). \tag{4}$$
#
# Both forces act at $O$, to the right of and below $G$: pushed up there, and pushed to the right
# there, the block turns anticlockwise. Hence both minus signs.

# %%
horizontal = m * acceleration_x
vertical = m * (g + acceleration_y)
euler = I_G * theta_dd + R * sp.sin(alpha - theta) * N + R * sp.cos(alpha - theta) * F

moments = sp.simplify(euler.subs({F: horizontal, N: vertical}))
sp.Eq(sp.collect(sp.expand(moments), theta_dd), 0)

# %% [markdown]
# The centripetal terms have cancelled: they act along the line from $O$ to $G$ and have no moment
# about $O$. With the moment of inertia about the pivot, $I_o = I_g + mR^2$ (Steiner), what is left
# is
#
# $$I_o\,\ddot\theta + mgR\sin(\alpha-\theta) + m\,a_g R\cos(\alpha-\theta) = 0
#   \qquad (\theta > 0). \tag{5}$$

# %%
I_O = sp.Symbol("I_o", positive=True)
about_right_edge = (
    I_O * theta_dd + m * g * R * sp.sin(alpha - theta) + m * a_g * R * sp.cos(alpha - theta)
)
assert sp.simplify(moments - about_right_edge.subs(I_O, I_G + m * R**2)) == 0

# %% [markdown]
# Moments about $O$ would have given (5) in one line, without $F$ and $N$. That short cut is right
# because $O$ is at rest relative to the ground, and because the inertia force $-m\,a_g$ acts at the
# centroid. The long way shows both, and yields the forces as well.
#
# **The other side.** Look at the block from behind: clockwise becomes anticlockwise and right
# becomes left. So if (5) holds for $\theta > 0$, it holds for $\theta < 0$ with $-\theta$ and
# $-a_g$ in the places of $\theta$ and $a_g$. With $s = \operatorname{sgn}\theta$ one line covers
# both:
#
# $$I_o\,\ddot\theta + s\,mgR\sin(\alpha - s\theta) + m\,a_g R\cos(\alpha - s\theta) = 0. \tag{6}$$

# %%
s = sp.Symbol("s", real=True)
both_sides = (
    I_O * theta_dd
    + s * m * g * R * sp.sin(alpha - s * theta)
    + m * a_g * R * sp.cos(alpha - s * theta)
)
from_behind = {theta: -theta, theta_dd: -theta_dd, a_g: -a_g}
mirrored = -about_right_edge.subs(from_behind, simultaneous=True)

assert both_sides.subs(s, 1) == about_right_edge
assert sp.simplify(both_sides.subs(s, -1) - mirrored) == 0

# %% [markdown]
# ## 3. Second route: energy
#
# On ground at rest nothing takes energy from the block between two impacts: the weight has a
# potential, and the forces at the pivot do no work because the pivot does not move. With the
# velocity of the centroid, $R\dot\theta$,
#
# $$E = \tfrac12 (mR^2 + I_g)\,\dot\theta^2 + mgR\cos(\alpha - \theta) \tag{7}$$
#
# is constant. Its time derivative contains $\dot\theta$ as a factor, and the other factor is (5)
# without shaking.

# %%
velocity_squared = sp.simplify((x_G - x_g).diff(t) ** 2 + y_G.diff(t) ** 2)
energy = m * velocity_squared / 2 + I_G * theta_of_t.diff(t) ** 2 / 2 + m * g * y_G
power = without_time(energy.diff(t))

still = about_right_edge.subs({a_g: 0, I_O: I_G + m * R**2})
assert sp.simplify(power - theta_d * still) == 0

# %% [markdown]
# One equation of energy can replace one equation of motion because the block has one degree of
# freedom. With two, energy no longer suffices, and moments or Lagrange's equations must help.

# %% [markdown]
# ## 4. The engine, by a third route
#
# rockeom needs only the position of the centroid when the block is turned about an edge, its mass
# and its inertia. From there Lagrange's equations are automatic. Its parameters are $B$ and $H$;
# equation (1) translates.

# %%
of = {parameter.name: parameter.symbol for parameter in model.parameters}
to_polar = {of["half_width"]: R * sp.sin(alpha), of["height"]: R * sp.cos(alpha)}
to_polar |= {GROUND_X: a_g, GROUND_Y: 0}

for side, name in [(1, "right"), (-1, "left")]:
    (engine,) = model.equations(name).residual
    ours = both_sides.subs({s: side, I_O: I_G + m * R**2})
    assert sp.simplify(engine.subs(to_polar) - ours) == 0
    (polar,) = model.equations(name, form="polar").residual
    assert sp.simplify(polar.subs({GROUND_X: a_g, GROUND_Y: 0}) - ours) == 0

# %% [markdown]
# The forces of the ground agree as well. On the right foot they are those of (3):

# %%
engine_forces = reactions(model, model.mode("right"))
for name, ours in [("horizontal_reaction", horizontal), ("right_reaction", vertical)]:
    engine = engine_forces[name].subs(sp.Symbol("s", real=True), 1).subs(to_polar)
    assert sp.simplify(engine - ours) == 0

# %% [markdown]
# ## 5. The thesis, and a sign to watch
#
# Ma (2010) states the free block as equation 2-2 and the shaken block as 2-9. The first agrees
# with (6). The second, as printed, does not: the sign inside its cosine is reversed.

# %%
shaken = equation("2-9")
(printed,), (right_form,) = shaken.printed, shaken.right
sp.Eq(printed.lhs, 0)

# %%
upper_lower, thesis_a_g = (sp.Symbol(name, real=True) for name in (r"\pm", r"\ddot{u}_g"))


def difference(relation, side):
    """The relation less equation (6), on one side; zero if they agree."""
    stated = relation.lhs - relation.rhs
    stated = stated.subs({upper_lower: side, thesis_a_g: a_g, sp.sign(theta): side})
    return sp.simplify(stated - both_sides.subs(s, side))


assert [difference(right_form, side) for side in (1, -1)] == [0, 0]
assert [difference(printed, side) for side in (1, -1)] != [0, 0]

(free,) = equation("2-2").right
for side, branch in [(1, 0), (-1, 1)]:
    moment = free.rhs.args[branch].expr
    assert sp.simplify(free.lhs - moment - both_sides.subs({s: side, a_g: 0})) == 0

difference(printed, 1)

# %% [markdown]
# The remainder is the difference between two levers, $R\cos(\alpha+\theta)$ and
# $R\cos(\alpha-\theta)$. Figure 1 (b) decides: the lever of $m\,a_g$ is the height of $G$, and it
# *grows* as the block starts to tilt. The slip is one of printing only. The results that the
# thesis computed belong to the right form, as [the non-dimensional block](nondimensional_block.py)
# shows for a similar case.
#
# The forces of Section 2 are thesis 3-8 and 3-9, whose $|\theta|$ and $\operatorname{sgn}\theta$
# are $\theta$ and 1 here.

# %%
thesis_a_gx = sp.Symbol(r"\ddot{u}_{gx}", real=True)
to_right = {thesis_a_gx: a_g, sp.sign(theta): 1, sp.Abs(theta): theta}
for number, ours in [("3-8", horizontal), ("3-9", vertical)]:
    (force,) = equation(number).right
    assert sp.simplify(force.rhs.subs(to_right) - ours) == 0

# %% [markdown]
# ## 6. The moment that rights the block
#
# Divide (6) by $I_o$ and stop the shaking. One number remains besides $\alpha$:
#
# $$\ddot\theta = -s\,p^2\sin(\alpha - s\theta), \qquad p = \sqrt{\frac{mgR}{I_o}}. \tag{8}$$
#
# For a homogeneous rectangle $I_o = \tfrac43 mR^2$, so $p^2 = 3g/(4R)$: the *frequency parameter*
# $p$ depends on size alone. It is not a natural frequency, for the block has none: nothing in
# Figure 2 looks like a spring.

# %%
block = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)  # rad/s, rad
p = block.frequency_parameter
inertia_about_edge = block.parameters()["inertia"] + block.mass * block.radius**2
assert np.isclose(inertia_about_edge, 4 / 3 * block.mass * block.radius**2, rtol=1e-14)
assert np.isclose(p, np.sqrt(0.75 * block.gravity / block.radius), rtol=1e-14)

# %% tags=["hide-input"] jupyter={"source_hidden": true}
rotations = np.linspace(1e-9, 1.4 * block.alpha, 200)
righting = np.sin(block.alpha - rotations) / np.sin(block.alpha)

figure, ax = plt.subplots(figsize=(5.2, 3.2), layout="constrained")
ax.plot(rotations / block.alpha, righting, color=fb.LINES[0])
ax.plot(-rotations / block.alpha, -righting, color=fb.LINES[0])
ax.plot([0, 0], [-1, 1], ":", color=fb.LINES[1])
ax.plot([1, -1], [0, 0], "o", color=fb.INK, ms=5)
ax.annotate("balance: it falls beyond", (1, 0), (0.52, 0.6), arrowprops={"arrowstyle": "->"})
ax.set(xlabel=r"$\theta/\alpha$", ylabel="righting moment / $mgB$")
plt.show()

# %% [markdown]
# *Figure 2. The righting moment. It jumps at $\theta = 0$, where the pivot changes, and then falls:
# the stiffness is negative. Beyond the balance point the moment overturns the block.*
#
# The jump also shows when the ground lifts a block at rest. At $\theta = 0$ the inertia force has
# the lever $H$ and the weight the lever $B$, so the block stays down until
#
# $$|a_g| > g\,\frac{B}{H} = g\tan\alpha, \tag{9}$$
#
# the criterion of West and Milne (thesis 2-1). It says when rocking starts, and *not* when a block
# overturns.

# %%
for factor, lifts in [(0.99, False), (1.01, True)]:
    push = rk.GroundMotion.constant(-factor * block.gravity * np.tan(block.alpha), 0.1)
    run = rk.simulate(block, push)
    assert (run["theta"].max() > 0) == lifts

# %% [markdown]
# ## 7. Free rocking: the quarter period
#
# Release the block at $\theta_0$. How long until it is upright? From (7), as a first integral of
# (8),
#
# $$\tfrac12\dot\theta^2 = p^2\left[\cos(\alpha-\theta_0) - \cos(\alpha-\theta)\right], \tag{10}$$
#
# and separating the variables
#
# $$T_{1/4} = \int_0^{\theta_0} \frac{\mathrm{d}\theta}
#   {p\sqrt{2\left[\cos(\alpha-\theta_0)-\cos(\alpha-\theta)\right]}}. \tag{11}$$
#
# The integrand is infinite at $\theta_0$, where the block is at rest. Put $\theta = \theta_0-u^2$
# and the singularity is gone, and write the difference of cosines as a product so that nothing
# cancels:
#
# $$T_{1/4} = \frac1p\int_0^{\sqrt{\theta_0}}\frac{u\,\mathrm{d}u}
#   {\sqrt{\sin(\alpha-\theta_0+u^2/2)\,\sin(u^2/2)}}. \tag{12}$$


# %%
def quarter_period(theta_0):
    """Equation (12) [s]."""

    def integrand(u):
        half = u**2 / 2
        return u / np.sqrt(np.sin(block.alpha - theta_0 + half) * np.sin(half))

    value, _ = quad(integrand, 0, np.sqrt(theta_0), epsabs=0, epsrel=1e-12)
    return value / p


# %% [markdown]
# The integral is an elliptic one. With $k = \cos\frac{\alpha-\theta_0}{2}$ and the incomplete and
# complete integrals $\mathcal F$ and $\mathcal K$ of the first kind,
#
# $$T_{1/4} = \frac1p\left[\mathcal K(k) -
#   \mathcal F\!\left(\arcsin\frac{\cos(\alpha/2)}{k},\,k\right)\right]. \tag{13}$$
#
# For small angles (8) becomes linear, $\ddot\theta = p^2(\theta-\alpha)$, with the solution
# $\theta = \alpha - (\alpha-\theta_0)\cosh pt$. It vanishes at
#
# $$T_{1/4} \approx \frac1p\operatorname{arcosh}\frac{1}{1-\theta_0/\alpha}, \tag{14}$$
#
# four of which are the period of thesis 2-5. SymPy confirms the solution:

# %%
P, theta_0 = sp.Symbol("p", positive=True), sp.Symbol("theta_0", real=True)
falling = alpha - (alpha - theta_0) * sp.cosh(P * t)
assert sp.simplify(falling.diff(t, 2) - P**2 * (falling - alpha)) == 0
assert (falling.subs(t, 0), falling.diff(t).subs(t, 0)) == (theta_0, 0)
upright = sp.acosh(1 / (1 - theta_0 / alpha)) / P
assert sp.simplify(falling.subs(t, upright)) == 0

# thesis 2-3, the linear equation; thesis 2-5, the period
(slender,) = equation("2-3").right
linear = I_O * theta_dd + m * g * R * (alpha - theta)
assert sp.simplify(slender.lhs - slender.rhs - linear) == 0
(by_one_call,) = model.equations("right", form="slender").residual
at_rest_below = {GROUND_X: 0, GROUND_Y: 0}
assert sp.simplify(by_one_call.subs(at_rest_below) - linear.subs(I_O, I_G + m * R**2)) == 0
period, frequency = equation("2-5").right
assert sp.simplify(period.rhs - 4 * upright) == 0
assert sp.simplify(frequency.rhs**2 - m * g * R / I_O) == 0


# %%
def elliptic(theta_0):
    """Equation (13) [s]; SciPy's parameter is the square of the modulus."""
    k = np.cos((block.alpha - theta_0) / 2)
    return (ellipk(k**2) - ellipkinc(np.arcsin(np.cos(block.alpha / 2) / k), k**2)) / p


def linearised(theta_0):
    """Equation (14) [s]."""
    return np.arccosh(1 / (1 - theta_0 / block.alpha)) / p


def simulated(structure, theta_0):
    """Time of the first impact after a release [s]."""
    run = rk.simulate(structure, rk.GroundMotion.none(10.0), initial={"theta": theta_0})
    return run.impacts[0].time


slender_block = rk.SlenderBlock.from_frequency(p=p, alpha=block.alpha)
for ratio in (0.1, 0.5, 0.8, 0.99):
    release = ratio * block.alpha
    exact = quarter_period(release)
    assert np.isclose(elliptic(release), exact, rtol=1e-9)
    assert np.isclose(
        analysis.formulas.exact_quarter_period(release, block.alpha, p), exact, rtol=1e-9
    )
    assert np.isclose(analysis.formulas.quarter_period(ratio, p), linearised(release), rtol=1e-12)
    assert np.isclose(simulated(block, release), exact, rtol=1e-9)
    assert np.isclose(simulated(slender_block, release), linearised(release), rtol=1e-9)
    assert abs(linearised(release) / exact - 1) < 0.012  # what linearising costs at 14 degrees

# %% tags=["hide-input"] jupyter={"source_hidden": true}
ratios = np.linspace(0.005, 0.998, 150)
marks = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 0.98])
figure, ax = plt.subplots(figsize=(5.2, 3.4), layout="constrained")
exact = np.array([quarter_period(x * block.alpha) for x in ratios])
ax.plot(ratios, p * exact, label="exact, (12)")
ax.plot(ratios, p * linearised(ratios * block.alpha), "--", label="linear, (14)")
simulations = np.array([simulated(block, x * block.alpha) for x in marks])
ax.plot(marks, p * simulations, "o", mfc="none", color=fb.INK, label="simulated")
ax.set(xlabel=r"$\theta_0/\alpha$", ylabel=r"$p\,T_{1/4}$", ylim=(0, None))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 3. The quarter period, for $\alpha = 0.25$; at this slenderness linearising costs about
# one per cent, which the eye cannot see. The quarter period grows from nothing, as
# $\sqrt{2\theta_0/\alpha}$, to infinity: released at the balance point the block never returns. So
# a rocking block cannot be tuned to resonate, and no single frequency describes it.*

# %% [markdown]
# ## 8. The phase portrait
#
# By (10) the motions between impacts are the level lines of the energy in the plane of $\theta$
# and $\dot\theta$. Let
#
# $$e(\theta,\dot\theta) = \frac{\dot\theta^2}{2p^2} + \cos(\alpha-|\theta|)-\cos\alpha. \tag{15}$$
#
# It is zero for the block at rest and $1-\cos\alpha$ at balance. The line of this value, the
# *separatrix*, divides the motions that return from those that fall. In Figure 4 a simulated motion
# runs along such lines; at each impact it drops to a lower one.

# %%
run = rk.simulate(block, rk.GroundMotion.none(6.0), initial={"theta": 0.9 * block.alpha})


def energy_level(theta, theta_dot):
    """Equation (15)."""
    height = np.cos(block.alpha - np.abs(theta)) - np.cos(block.alpha)
    return theta_dot**2 / (2 * p**2) + height


balance = 1 - np.cos(block.alpha)
levels = energy_level(run["theta"], run["theta_dot"])
times = [impact.time for impact in run.impacts[:6]]
for start, end in zip([0.0, *times], times, strict=False):
    between = levels[(run.t > start) & (run.t < end)]
    assert np.ptp(between) < 1e-9 * balance  # constant between impacts
assert levels.max() < balance  # and inside the separatrix

# %% tags=["hide-input"] jupyter={"source_hidden": true}
x, y = np.meshgrid(np.linspace(-1.45, 1.45, 301), np.linspace(-1.5, 1.5, 301))
field = energy_level(x * block.alpha, y * p * block.alpha) / balance
figure, ax = plt.subplots(figsize=(5.6, 4.2), layout="constrained")
ax.contour(x, y, field, levels=[0.1, 0.3, 0.5, 0.7, 0.9, 1.3, 1.8], colors="0.75", linewidths=0.8)
ax.contour(x, y, field, levels=[1.0], colors=[fb.LINES[1]], linewidths=1.4)
ax.plot(run["theta"] / block.alpha, run["theta_dot"] / (p * block.alpha), color=fb.LINES[0])
ax.plot([1, -1], [0, 0], "o", color=fb.LINES[1], ms=5)
ax.annotate("balance", (1, 0), (8, 8), textcoords="offset points", color=fb.LINES[1])
ax.annotate("release", (0.9, 0), (-40, 6), textcoords="offset points", color=fb.LINES[0])
ax.set(xlabel=r"$\theta/\alpha$", ylabel=r"$\dot\theta/(p\,\alpha)$")
plt.show()

# %% [markdown]
# *Figure 4. Level lines of the energy (grey), the separatrix through the balance points (orange),
# and a free motion (blue) from $0.9\,\alpha$. The vertical steps at $\theta = 0$ are impacts, see
# [energy lost in an impact](restitution.py). Time runs clockwise.*
#
# The same to be moved: release the block elsewhere, and see where its line crosses the separatrix.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
rk.explorer(
    rk.Case(block, rk.GroundMotion.none(6.0), initial={"theta": 0.9 * block.alpha}),
    {
        "initial theta": (-0.95 * block.alpha, 0.95 * block.alpha),
        "initial theta_dot": (-1.5 * p * block.alpha, 1.5 * p * block.alpha),
        "half_width": (0.5 * block.half_width, 2 * block.half_width),
    },
    "The phase plane of a free block",
)

# %% [markdown]
# ## 9. Forces on the pivot
#
# The derivation took for granted that the edge neither slides nor lifts. The forces (3) show when
# that is so. At the release they follow from $\dot\theta = 0$ and (8). A slender block needs little
# friction, a squat one much:

# %%
at_rest = {theta_d: 0, a_g: 0, theta_dd: -m * g * R * sp.sin(alpha - theta) / I_O}
friction = (-horizontal / vertical).subs(at_rest).subs(I_O, sp.Rational(4, 3) * m * R**2)
needed = sp.simplify(friction.subs(theta, 0))
claim = 3 * sp.sin(alpha) * sp.cos(alpha) / (4 - 3 * sp.sin(alpha) ** 2)
assert sp.simplify(needed - claim) == 0

engine = block.reactions({"theta": 0.0}, mode="right")
ratio = -engine["horizontal_reaction"] / engine["right_reaction"]
assert np.isclose(ratio, float(needed.subs(alpha, block.alpha)), rtol=1e-12)
sp.Eq(F / N, needed)

# %% [markdown]
# ## Exercises
#
# 1. **Moments about the other pivot.** Write the moments about $O'$ while the block turns about
#    $O$, with $F$ and $N$ included. Do you recover (5)?
#    *Hint: the moments equal the rate of change of the angular momentum about $O'$, which is that
#    of the centroid's motion plus $I_g\dot\theta$, and not $I_o\dot\theta$. The lever of $N$ is
#    $2B$.*
# 2. **A vertical acceleration.** Let the ground move upwards with $a_v(t)$ as well. Show that $g$
#    becomes $g + a_v$, and check it with the engine. *Hint: add $y_g(t)$ to (2); do not set
#    `GROUND_Y` to zero in Section 4.*
# 3. **Size.** Two blocks have the same shape, and one is four times as large. Compare their quarter
#    periods from the same $\theta_0/\alpha$, and the speeds with which their top corners land.
#    *Hint: only $p$ and $R$ change.*
# 4. **Small amplitudes.** Show from (14) that $p\,T_{1/4} \to \sqrt{2\theta_0/\alpha}$, and find
#    the next term. *Hint: `sp.series` in $\epsilon$ with $\theta_0 = \epsilon^2\alpha$.*
# 5. **Sliding.** For which slenderness does a homogeneous block on a surface of friction
#    coefficient 0.3 slide at the end of a free rocking motion? *Hint: Section 9, the limit
#    $\theta\to0$.*
# 6. **The slowest return.** Fit the growth of $T_{1/4}$ as $\theta_0 \to \alpha$ in Figure 3.
#    *Hint: $\operatorname{arcosh} x \approx \ln 2x$.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Seen from $O'$ the centroid is at $(2B - R\sin(\alpha-\theta),\ R\cos(\alpha-\theta)) = (x', y)$.
# Weight, inertia force and $N$ have moments about $O'$, $F$ has none:
#
# $$I_g\ddot\theta + m\,(y\,\ddot x - x'\,\ddot y) = m g\,x' - m a_g\,y - 2B\,N.$$
#
# Put in $N = m(g + \ddot y)$: the terms with $2B$ cancel, and (5) is left. A second point gives no
# second equation, only the same with an unknown in it.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# The centroid rises by $y_g$ more, so that $N = m\,(g + a_v + \ddot y_G)$, and $F$ stays as it was.
# In (4) $g$ occurs in $N$ only, and is replaced by $g + a_v$. For a block, ground that accelerates
# upwards is the same as more gravity.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $p \propto 1/\sqrt R$ is half as large. All times are proportional to $1/p$: the quarter period
# doubles. Angular velocities are proportional to $p$, and the top corner is four times as far away,
# so that it lands twice as fast.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# With $\theta_0 = \epsilon^2\alpha$ the series is
# $p\,T_{1/4} = \sqrt2\,\epsilon\,\bigl(1 + \tfrac5{12}\epsilon^2 + \dots\bigr)$: the square root is
# 4 % too small at a tenth of $\alpha$.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# With $\tau = \tan\alpha$ the ratio is $3\tau/(4+\tau^2)$. It is 0.3 at $\tau = 5 - \sqrt{21} =
# 0.417$: blocks that are less than 2.4 times as high as wide slide.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# By (14) $p\,T_{1/4} \approx \ln\frac{2}{1-\theta_0/\alpha}$. Each tenth of what is left to the
# balance costs another $\ln 10 = 2.3$ of $1/p$. The exact period (13) grows at the same rate, for
# at the balance point the linear equation becomes exact.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
ahead, up = 2 * R * sp.sin(alpha) - R * sp.sin(alpha - theta), R * sp.cos(alpha - theta)
turning = I_G * theta_dd + m * (up * acceleration_x - ahead * (g + acceleration_y))
assert sp.simplify(turning + 2 * R * sp.sin(alpha) * vertical - moments) == 0

a_v = sp.Symbol("a_v", real=True)
lifted = euler.subs({F: horizontal, N: m * (g + a_v + acceleration_y)})
assert sp.simplify(lifted - moments.subs(g, g + a_v)) == 0
(engine,) = model.equations("right").residual
heavier = about_right_edge.subs({g: g + a_v, I_O: I_G + m * R**2})
assert sp.simplify(engine.subs(to_polar | {GROUND_Y: a_v}) - heavier) == 0

large = rk.RigidBlock.from_frequency(p=p / 2, alpha=block.alpha)
assert np.isclose(large.radius, 4 * block.radius)
first = {
    one: rk.simulate(one, rk.GroundMotion.none(6.0), initial={"theta": 0.5 * block.alpha}).impacts[
        0
    ]
    for one in (block, large)
}
landing = {one: one.half_height * impact.before["theta_dot"] for one, impact in first.items()}
assert np.isclose(first[large].time / first[block].time, 2.0)
assert np.isclose(landing[large] / landing[block], 2.0)

small = 1e-3
assert np.isclose((np.arccosh(1 / (1 - small)) / np.sqrt(2 * small) - 1) / small, 5 / 12, rtol=2e-3)
slides_at = needed.subs(alpha, sp.atan(5 - sp.sqrt(21)))
assert np.isclose(float(slides_at), 0.3, rtol=1e-12)
late = p * (elliptic((1 - 1e-5) * block.alpha) - elliptic((1 - 1e-3) * block.alpha))
assert np.isclose(late, np.log(100), rtol=1e-3)
exercises = Exercises({3: 2, 4: sp.Rational(5, 12), 5: 5 - sp.sqrt(21), 6: sp.log(10)})

# %%
# your answers
exercises.check(3, ...)  # quarter period of the large block over that of the small one
exercises.check(4, ...)  # the factor of epsilon**2 next to 1
exercises.check(5, ...)  # width over height below which it does not slide
exercises.check(6, ...)  # growth of p times T for each tenth of the rest to the balance
