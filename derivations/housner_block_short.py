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
#     figure: 3
#     level: first course
#     minutes: 25
# ---

# %% [markdown]
# # Housner's block in 25 minutes
#
# A rigid block on rigid ground, in one lesson: its equation of motion, the acceleration that lifts
# it, the time that it takes to come back, and the pulse that overturns it. Three times you are
# asked for a prediction. Write it down before you run the cell below it.
# [The long version](housner_block.py) derives every step.
#
# ## Aims
#
# After this notebook you can
#
# 1. write the equation of motion of a rocking block from moments about its pivot;
# 2. say which acceleration lifts a block, and that size plays no part in it;
# 3. explain why a rocking block has no natural period, and why a larger one is safer.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.teaching import Exercises

use_style()

# %% tags=["hide-input"] jupyter={"source_hidden": true}
b, h, tilt = 0.4, 0.8, 0.15
outline = [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h), (0, h)]
*corners, (gx, gy) = fb.turned(outline, (b, 0), tilt)
figure, ax = plt.subplots(figsize=(4.2, 4.2), layout="constrained")
fb.ground(ax, -0.9, 1.1, depth=0.07)
fb.body(ax, corners)
fb.line(ax, (b, 0), (b, 1.2))
fb.line(ax, (b, 0), (gx, gy))
fb.angle(ax, (b, 0), (b, 1), (gx, gy), 0.55, r"$\alpha-\theta$", label_radius=1.2)
fb.angle(ax, (b, 0), (-b, 0), corners[0], 0.62, r"$\theta$", sense=True, label_radius=1.14)
fb.arrow(ax, (gx, gy), (gx, gy - 0.4), "$mg$", offset=(-13, 4))
fb.arrow(ax, (gx, gy), (gx - 0.55, gy), r"$m\,a_g$", offset=(-4, 9))
fb.centroid(ax, (gx, gy), "$G$", (10, 7))
fb.pivot(ax, (b, 0), "$O$", (13, 8))
fb.bare(ax)
plt.show()

# %% [markdown]
# *Figure 1. The block of half-width $B = R\sin\alpha$ and centroid height $H = R\cos\alpha$ turns
# about its right edge $O$; $\theta$ is positive clockwise. The inertia force $m\,a_g$ opposes the
# acceleration $a_g$ of the ground.*
#
# ## 1. Moments about the pivot
#
# The weight has the lever $R\sin(\alpha-\theta)$ about $O$, the inertia force the lever
# $R\cos(\alpha-\theta)$. With the moment of inertia $I_o$ about $O$,
#
# $$I_o\,\ddot\theta = -mgR\sin(\alpha-\theta) - m\,a_g R\cos(\alpha-\theta)
#   \qquad (\theta > 0). \tag{1}$$
#
# The equation for $\theta < 0$ is its mirror image. For a homogeneous rectangle
# $I_o = \tfrac43 mR^2$. We call $p = \sqrt{mgR/I_o} = \sqrt{3g/(4R)}$ the frequency parameter. The
# engine derives the same equation from the position of the centroid:

# %%
theta, theta_dd, a_g = sp.symbols(r"theta \ddot{\theta} a_g", real=True)
m, R, alpha, g, I_g = sp.symbols("m R alpha g I_g", positive=True)
by_hand = (I_g + m * R**2) * theta_dd + m * g * R * sp.sin(alpha - theta)
by_hand += m * a_g * R * sp.cos(alpha - theta)

model = rk.derive("rigid_block")
of = {parameter.name: parameter.symbol for parameter in model.parameters}
(engine,) = model.equations("right").residual
polar = {of["half_width"]: R * sp.sin(alpha), of["height"]: R * sp.cos(alpha)}
quiet = {symbol: 0 for symbol in engine.free_symbols if symbol.name == "a_y"}
engine = engine.subs(polar).subs(quiet).subs(sp.Symbol("a_x", real=True), a_g)
assert sp.simplify(engine - by_hand) == 0

# %% [markdown]
# ## 2. Does it lift?
#
# At rest the weight holds the block down with $mgB$, and the inertia force lifts it with
# $m\,a_g H$. It lifts where
#
# $$|a_g| > g\,\frac BH = g\tan\alpha. \tag{2}$$
#
# **Before you run the cell:** a second block has the same shape and twice the size. Does it need a
# stronger acceleration to lift, a weaker one, or the same?

# %%
small = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)  # rad/s, rad
large = rk.RigidBlock(half_width=2 * small.half_width, half_height=2 * small.half_height)


def lifts(block, acceleration):
    run = rk.simulate(block, rk.GroundMotion.constant(-acceleration, 0.1))
    return bool(run["theta"].max() > 0)


threshold = 9.81 * math.tan(0.25)
for name, block in (("small", small), ("large", large)):
    answers = [lifts(block, factor * threshold) for factor in (0.99, 1.01)]
    print(f"{name}, {2 * block.half_height:.2f} m high: {threshold:.3f} m/s2 less 1 % lifts it: "
          f"{answers[0]}, plus 1 %: {answers[1]}")  # fmt: skip
    assert answers == [False, True]

# %% [markdown]
# <details><summary>Compare with your prediction</summary>
#
# The same acceleration lifts both: only the shape enters (2).
#
# </details>
#
# ## 3. How long does it take to come back?
#
# Release the block at $\theta_0$. For small angles (1) is $\ddot\theta = p^2(\theta - \alpha)$, and
# from rest $\theta = \alpha - (\alpha - \theta_0)\cosh pt$. The block is upright again after
#
# $$T_{1/4} = \frac1p\operatorname{arcosh}\frac1{1-\theta_0/\alpha}. \tag{3}$$
#
# **Before you run the cell:** from half of the angle of balance, $\theta_0 = \alpha/2$, the first
# quarter cycle takes 0.62 s. How long does it take from $0.99\,\alpha$: about the same, about
# double, or four times as long?


# %%
def quarter(ratio):
    """Time of the first impact after a release at ratio * alpha [s]."""
    start = {"theta": ratio * small.alpha}
    return rk.simulate(small, rk.GroundMotion.none(10.0), initial=start).impacts[0].time


for ratio in (0.1, 0.5, 0.9, 0.99):
    formula = math.acosh(1 / (1 - ratio)) / 2.14
    print(f"from {ratio:.2f} alpha: {quarter(ratio):.2f} s, by (3) {formula:.2f} s")
    assert math.isclose(quarter(ratio), formula, rel_tol=0.02)

# %% tags=["hide-input"] jupyter={"source_hidden": true}
ratios = np.linspace(0.005, 0.998, 200)
figure, ax = plt.subplots(figsize=(4.8, 3.0), layout="constrained")
ax.plot(ratios, np.arccosh(1 / (1 - ratios)))
ax.set(xlabel=r"$\theta_0/\alpha$", ylabel=r"$p\,T_{1/4}$", ylim=(0, None))
plt.show()

# %% [markdown]
# *Figure 2. The quarter period against the amplitude of the release.*
#
# <details><summary>Compare with your prediction</summary>
#
# Four times as long. The quarter period grows from zero to infinity: a rocking block has no natural
# period, and cannot be tuned to resonate.
#
# </details>
#
# ## 4. Does it fall?
#
# **Before you run the cell:** one full sine with a period of 0.9 s and twice the acceleration of
# (2) shakes both blocks. Which of them overturns: the small one, the large one, both, or neither?

# %%
pulse = rk.GroundMotion.single_sine(amplitude=2 * threshold, period=0.9, duration=6.0)
runs = {name: rk.simulate(block, pulse) for name, block in (("small", small), ("large", large))}
for name, run in runs.items():
    print(f"{name}: {run.outcome}")
assert runs["small"].outcome is rk.Outcome.OVERTURNED
assert runs["large"].outcome is not rk.Outcome.OVERTURNED

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(6.0, 3.0), layout="constrained")
for name, run in runs.items():
    ax.plot(run.t, run["theta"] / small.alpha, label=f"{name} block")
ax.axhline(1, color=fb.INK, lw=0.7, ls=":")
ax.axhline(-1, color=fb.INK, lw=0.7, ls=":")
ax.set(xlabel="time [s]", ylabel=r"$\theta/\alpha$", xlim=(0, 5), ylim=(-2, 2))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 3. Two blocks of one shape under one pulse.*
#
# <details><summary>Compare with your prediction</summary>
#
# Only the small one falls. Both lift at the same instant, but the large one turns more slowly,
# since $p \propto 1/\sqrt R$, and the pulse is over before it has turned far.
#
# </details>
#
# ## Exercises
#
# 1. **The shape.** A block is three times as high as it is wide. Which acceleration, in units of
#    $g$, lifts it? *Hint: (2); $B/H$ is the width over the height.*
# 2. **The size.** A block is four times as large as another of the same shape. By which factor is
#    its quarter period longer, from the same $\theta_0/\alpha$? *Hint: (3) contains only $p$.*
# 3. **Small amplitudes.** Give $p\,T_{1/4}$ for small $x = \theta_0/\alpha$, as an expression in
#    $x$. *Hint: $\cosh z \approx 1 + z^2/2$.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# $a_g = g\,B/H = g/3$.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# $p \propto 1/\sqrt R$ is half as large: the quarter period is twice as long.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $1 + z^2/2 = 1/(1-x) \approx 1 + x$ gives $p\,T_{1/4} \approx \sqrt{2x}$.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
x = sp.Symbol("x", positive=True)
third = rk.RigidBlock(half_width=0.2, half_height=0.6)
assert lifts(third, 1.001 * 9.81 / 3)
assert not lifts(third, 0.999 * 9.81 / 3)
slow = rk.RigidBlock.from_frequency(p=2.14 / 2, alpha=0.25)
assert math.isclose(slow.radius / small.radius, 4)
assert sp.limit(sp.acosh(1 / (1 - x)) / sp.sqrt(2 * x), x, 0) == 1
exercises = Exercises({1: sp.Rational(1, 3), 2: 2, 3: sp.sqrt(2 * x)})

# %%
# your answers
exercises.check(1, ...)  # acceleration that lifts it, in units of g
exercises.check(2, ...)  # quarter period of the large block over that of the small one
exercises.check(3, ...)  # an expression in x
