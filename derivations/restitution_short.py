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
#     figure: 2
#     level: first course
#     minutes: 25
# ---

# %% [markdown]
# # Energy lost in an impact, in 25 minutes
#
# A rocking block loses energy each time its pivot changes from one edge to the other. Housner
# (1963) found the loss by one principle. You derive it here, predict which blocks lose most, and
# learn to keep two coefficients apart that the literature calls by one name.
# [The long version](restitution.py) adds impulses, friction and experiments.
#
# ## Aims
#
# After this notebook you can
#
# 1. derive the ratio of the angular velocities after and before an impact;
# 2. say how the loss depends on the shape, and that it does not depend on size or material;
# 3. distinguish the ratio of energies $r$ from the ratio of velocities $e$.

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
b, h = 0.45, 0.9
outline = [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h)]
figure, axes = plt.subplots(1, 2, figsize=(6.0, 3.8), layout="constrained")
rows = (
    ("before: about $O$", b, "$O$", 11, r"$\dot\theta_1$", (-0.5, -0.25), "$v_1$"),
    ("after: about $O'$", -b, "$O'$", -11, r"$\dot\theta_2$", (-0.35, 0.18), "$v_2$"),
)
for ax, (title, x, name, offset, rate, (dx, dy), speed) in zip(axes, rows, strict=True):
    fb.ground(ax, -0.95, 0.95, depth=0.08)
    fb.body(ax, outline)
    fb.line(ax, (x, 0), (0, h))
    fb.centroid(ax, (0, h), "$G$", (10, -8))
    fb.pivot(ax, (x, 0), name, (offset, 9))
    ends = ((x, 2), (0, 2)) if x > 0 else ((0, 2), (x, 2))
    fb.angle(ax, (x, 0), *ends, 1.45, rate, sense=True, color=fb.MOTION, label_radius=1.13)
    fb.arrow(ax, (0, h), (dx, h + dy), speed, color=fb.MOTION, offset=(-6, 6))
    fb.bare(ax)
    ax.set(xlim=(-1.05, 1.05), ylim=(-0.3, 2.05), title=title)
plt.show()

# %% [markdown]
# *Figure 1. A block that swings back: velocities just before and just after its left edge $O'$
# lands. The centroid moves downwards before the impact and upwards after it.*
#
# ## 1. Angular momentum about the new pivot
#
# The impact takes no time, so that weight plays no part, and the impulse acts at $O'$, about which
# it has no moment. The angular momentum about $O'$ is the same before and after:
#
# $$\left[I_g + m(H^2 - B^2)\right]\dot\theta_1 = \left[I_g + m(H^2 + B^2)\right]\dot\theta_2.
#   \tag{1}$$
#
# Its left side is that of a body which turns about the *other* edge: the horizontal velocity
# $H\dot\theta_1$ of the centroid helps, the vertical one, $B\dot\theta_1$, hinders. Hence
#
# $$e = \frac{\dot\theta_2}{\dot\theta_1} = \frac{I_g + m(H^2-B^2)}{I_g + m(H^2+B^2)}, \qquad
#   r = e^2, \tag{2}$$
#
# where $r$ is the ratio of the kinetic energies. For a homogeneous rectangle,
# $e = 1 - \tfrac32\sin^2\alpha$.

# %%
m, B, H, I_g = sp.symbols("m B H I_g", positive=True)
e = (I_g + m * (H**2 - B**2)) / (I_g + m * (H**2 + B**2))
assert sp.simplify(rk.derive("rigid_block").velocity_ratio - e) == 0  # the engine's
rectangle = e.subs(I_g, m * (B**2 + H**2) / 3)
assert sp.simplify(rectangle - (1 - sp.Rational(3, 2) * B**2 / (B**2 + H**2))) == 0

# %% [markdown]
# ## 2. Which block loses most?
#
# **Before you run the cell:** three blocks are released, one twice as high as wide, one four times
# and one eight times. Which loses the largest part of its energy in an impact? And what changes if
# the blocks are of steel instead of stone, or twice as large?


# %%
def kept(slenderness, size=1.0, density=2400.0):
    """Part of the energy that the first impact leaves, simulated."""
    half_width = 0.25 * size
    half_height = slenderness * half_width
    block = rk.RigidBlock(
        half_width=half_width, half_height=half_height, mass=4 * density * half_width * half_height
    )
    start = {"theta": 0.5 * block.alpha}
    impact = rk.simulate(block, rk.GroundMotion.none(5.0), initial=start).impacts[0]
    return (impact.after["theta_dot"] / impact.before["theta_dot"]) ** 2


for slenderness in (2, 4, 8):
    by_formula = (1 - 1.5 / (1 + slenderness**2)) ** 2
    print(f"height/width {slenderness}: r = {kept(slenderness):.3f}")
    assert math.isclose(kept(slenderness), by_formula, rel_tol=1e-9)
assert math.isclose(kept(4), kept(4, size=2.0, density=7850.0), rel_tol=1e-9)

# %% tags=["hide-input"] jupyter={"source_hidden": true}
shapes = np.linspace(1.5, 9, 200)
figure, ax = plt.subplots(figsize=(4.8, 3.0), layout="constrained")
ax.plot(shapes, (1 - 1.5 / (1 + shapes**2)) ** 2, label="$r$, energies")
ax.plot(shapes, 1 - 1.5 / (1 + shapes**2), "--", label="$e$, velocities")
ax.set(xlabel="height/width", ylabel="ratio after/before", ylim=(0.2, 1))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 2. Ratios of energies and of velocities against the shape.*
#
# <details><summary>Compare with your prediction</summary>
#
# The squat block loses most. Neither size nor material is in (2): the landing edge stops dead, and
# the energy of that motion is lost.
#
# </details>
#
# ## 3. r or e?
#
# **Before you run the cell:** a paper gives a "coefficient of restitution of 0.81" and does not say
# of what. One student reads it as a ratio of energies, another as a ratio of velocities. Whose
# block rocks longer, and by what factor: 1.1, 1.5 or 2?

# %%
block = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)  # rad/s, rad
ends = {}
for name, law in (("energies", rk.EnergyRatio(0.81)), ("velocities", rk.VelocityRatio(0.81))):
    run = rk.simulate(block, rk.GroundMotion.none(20.0), initial={"theta": 0.2}, impact=law)
    ends[name] = run.events.rest_time
    print(f"0.81 as a ratio of {name}: at rest after {ends[name]:.2f} s")
assert ends["energies"] > 1.5 * ends["velocities"]

# %% [markdown]
# <details><summary>Compare with your prediction</summary>
#
# An energy ratio of 0.81 is a velocity ratio of 0.9: that block rocks about twice as long. In
# rockeom the name of the impact law says which of the two is meant.
#
# </details>
#
# ## Exercises
#
# 1. **Half the energy.** At which angle $\alpha$ [rad] does one impact take half of the energy of a
#    homogeneous rectangle? *Hint: $r = 1/2$, and $e = 1 - \tfrac32\sin^2\alpha$.*
# 2. **A mass on a stick.** Set $I_g = 0$ and write $e$ as an expression in $\alpha$.
#    *Hint: $B = R\sin\alpha$, $H = R\cos\alpha$.*
# 3. **Ten per cent left.** After how many impacts has a block with $r = 0.81$ less than a tenth of
#    its energy? *Hint: after $n$ impacts $r^n$ is left.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# $1 - \tfrac32\sin^2\alpha = 1/\sqrt2$ gives $\alpha = 0.457$: a block twice as high as wide.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# $e = (H^2 - B^2)/(H^2 + B^2) = \cos2\alpha$.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $\ln 0.1/\ln 0.81 = 10.9$: after 11 impacts.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
half_lost = math.asin(math.sqrt(2 / 3 * (1 - 1 / math.sqrt(2))))
assert math.isclose(kept(1 / math.tan(half_lost)), 0.5)
alpha, R = sp.symbols("alpha R", positive=True)
stick = e.subs(I_g, 0).subs({B: R * sp.sin(alpha), H: R * sp.cos(alpha)})
assert sp.simplify(stick - sp.cos(2 * alpha)) == 0
impacts = math.ceil(math.log(0.1) / math.log(0.81))
assert impacts == 11
exercises = Exercises({1: half_lost, 2: sp.cos(2 * alpha), 3: impacts})

# %%
# your answers
exercises.check(1, ...)  # an angle in radians
exercises.check(2, ...)  # an expression in alpha
exercises.check(3, ...)  # a whole number
