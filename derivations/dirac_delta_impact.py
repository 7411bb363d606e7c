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
#     level: research
#     minutes: 45
# ---

# %% [markdown]
# # An impact as a continuous force
#
# A rocking block is usually described by two equations of motion, one for each edge, and a rule
# for the jump from one to the other. Section 2.6 of the thesis (Ma 2010), after Prieto (2004),
# writes instead *one* equation, whose impact is a force that acts near the upright position only.
#
# ## Aims
#
# After this notebook you can
#
# 1. derive the force from one requirement: each passage multiplies the velocity by $\sqrt r$;
# 2. find its sign, and show that the printed one creates energy;
# 3. spread the force over a short distance $n$, so that it can be integrated;
# 4. say how far the answer then is from the one with jumps, by a formula and by numbers.
#
# You should know the slender block and the coefficient of restitution; see
# [Housner's block](housner_block.py) and [restitution](restitution.py).

# %%
import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.integrate import quad, solve_ivp
from scipy.special import erf

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.teaching import Exercises
from rockeom.thesis import equation

use_style()
sp.init_printing()

# %% [markdown]
# ## 1. The block with jumps
#
# Let $x = \theta/\alpha$ be the rotation in units of the one at which the block falls, and let
# time be counted in units of $1/p$. A slender block that rocks freely obeys 2-14 without shaking,
#
# $$ \ddot x - x + \operatorname{sgn}(x) = 0 . \tag{1} $$
#
# The thesis calls $r$ the ratio of *kinetic energies* at an impact, so that velocities are
# multiplied by $\sqrt r$.


# %% tags=["hide-input"] jupyter={"source_hidden": true}
b, h, rotation = 0.5, 1.5, 0.14
pivot = np.array([b, 0.0])
upright = [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h)]
(centre,) = fb.turned((0, h), pivot, rotation)
edge = pivot + 3.45 * np.array([np.sin(rotation), np.cos(rotation)])

figure, (left, right) = plt.subplots(
    1, 2, figsize=(7.6, 3.6), layout="constrained", width_ratios=(1, 1.3)
)
fb.bare(left)
fb.ground(left, -1.1, 1.6)
fb.body(left, upright, faint=True)
fb.body(left, fb.turned(upright, pivot, rotation))
fb.line(left, (b, 2.1), (b, 3.6))
fb.line(left, pivot, centre)
fb.line(left, pivot + 0.87 * (edge - pivot), edge)
fb.angle(left, pivot, (b, 1), edge, 3.25, label_radius=1.13)
left.annotate(r"$\theta=\alpha x$", edge, (8, -8), textcoords="offset points")
fb.angle(left, pivot, centre, edge, 0.95, r"$\alpha$", label_radius=1.19)
fb.centroid(left, centre)
fb.arrow(left, centre, centre - (0, 0.8), "$mg$", offset=(-12, 3))
fb.pivot(left, pivot, "$O$", (11, -8))
against = {"sense": True, "color": fb.FORCE, "label_radius": 1.14}
fb.angle(left, pivot, (-0.7, 1.45), (-1.2, 0.25), 1.75, r"$F_\delta$", **against)
fb.dimension(left, (-b, 0), (b, 0), "$2B$", shift=-0.42, offset=(0, 7))

distance = np.linspace(-0.4, 0.4, 801)
for width in (0.2, 0.1, 0.05):
    bell = np.exp(-((distance / width) ** 2)) / (width * np.sqrt(np.pi))
    right.plot(distance, bell, label=f"$n={width}$")
right.set(xlabel="rotation $x$", ylabel=r"$\delta_n(x)$", ylim=(0, None))
right.legend()
plt.show()

# %% [markdown]
# *Figure 1. Left: the block turns about its edge $O$; the weight brings it back, and near the
# upright position the moment $F_\delta$ acts against its motion. Right: what will stand for Dirac's
# function in Section 4 (the thesis's Figure 2-15).*
#
# Between impacts (1) has the solution $x = 1 - (1 - x_0)\cosh t$ from rest at $x_0 > 0$. With it
# everything is known in closed form: the first impact falls at $\cosh t_1 = 1/(1 - x_0)$, and as
# $\dot x^2 - x^2 + 2|x|$ is constant between impacts and multiplied by $r$ at each,
#
# $$ 1 - (1 - x_{k+1})^2 = r\,\bigl[1 - (1 - x_k)^2\bigr] \tag{2} $$
#
# gives one peak from the last. We take the numbers of Figure 2-16.

# %%
X0, R = 0.4, 0.7225
peaks = [X0]
for _ in range(3):
    peaks.append(1 - np.sqrt(1 - R * (1 - (1 - peaks[-1]) ** 2)))
first_impact = np.arccosh(1 / (1 - X0))

assert np.isclose(first_impact, np.log(3))
print("first impact at", first_impact, "and then peaks at", np.round(peaks[1:], 4))

# %% [markdown]
# ## 2. What force multiplies the velocity by $\sqrt r$?
#
# Let the impact be a force that acts at $x = 0$ and depends on the velocity,
#
# $$ \ddot x - x + \operatorname{sgn}(x) = F_\delta , \qquad
#    F_\delta = \delta(x)\, g(\dot x) . \tag{3} $$
#
# The weight is bounded and the passage takes no time, so the weight does not count while the
# force acts. Write $v = \dot x$ and $\ddot x = v\,\mathrm dv/\mathrm dx$. The equation is
# separable,
#
# $$ \frac{v}{g(v)}\,\mathrm dv = \delta(x)\,\mathrm dx . \tag{4} $$
#
# In a passage to the right the integral on the right-hand side is $+1$. The velocity goes from
# $v_0$ to $\sqrt r\,v_0$, *whatever $v_0$ is*:
#
# $$ \int_{v_0}^{\sqrt r\,v_0} \frac{v}{g(v)}\,\mathrm dv = 1
#    \quad\text{for all } v_0 > 0 . \tag{5} $$
#
# That holds for all $v_0$, so its derivative with respect to $v_0$ is zero. This is the step
# that finds the form of $g$ without guessing it.

# %%
v, v0, r, K, n = sp.symbols("v v_0 r K n", positive=True)
m = sp.Symbol("m", real=True)
g = sp.Function("g", positive=True)

passage = sp.Integral(v / g(v), (v, v0, sp.sqrt(r) * v0))
slope = sp.diff(passage, v0)
sp.Eq(slope, 0)

# %% [markdown]
# So $g(\sqrt r\,v_0) = r\,g(v_0)$: when the velocity is scaled by $\sqrt r$, the force is scaled by
# $r$. Among powers $g = K v^m$ only one does that, and it does it for every $r$.

# %%
power = sp.simplify(slope.subs(g, sp.Lambda(v, K * v**m)).doit() * K * v0 ** (m - 1))
exponents = sp.solve(sp.logcombine(sp.log(power + 1)), m)
assert exponents == [2]
sp.Eq(power, 0)

# %% [markdown]
# With $m = 2$ the requirement (5) fixes the constant, by one integral.

# %%
law = K * v**2
gained = sp.integrate(v / law, (v, v0, sp.sqrt(r) * v0))
(constant,) = sp.solve(sp.simplify(gained) - 1, K)
assert sp.simplify(constant - sp.log(sp.sqrt(r))) == 0
sp.Eq(K, constant)

# %% [markdown]
# ## 3. The sign
#
# $\log\sqrt r$ is negative, since $r < 1$: to the right the force points to the left, as it should.
# In a passage to the left, $\mathrm dx < 0$ and the integral of $\delta(x)\,\mathrm dx$ is $-1$, so
# that the constant changes sign. Both are contained in
#
# $$ g(v) = \log(\sqrt r)\,v^2 \operatorname{sgn}(v) . \tag{6} $$
#
# The power of this force, $\delta(x)\log(\sqrt r)\,|v|^3$, is never positive.
#
# The thesis argues that the logarithm is negative and *adds a minus sign* to make up for it
# (2-26 to 2-29). But the force stands on the right-hand side of (3), where a negative one is what
# is needed. What would the printed force do to the velocity?

# %%
exit_velocity = sp.Symbol("v_f", positive=True)
printed_law = -sp.log(sp.sqrt(r)) * v**2
balance = sp.integrate(v / printed_law, (v, v0, exit_velocity)) - 1
(printed_exit,) = sp.solve(balance, exit_velocity)
assert sp.simplify(printed_exit - v0 / sp.sqrt(r)) == 0
sp.Eq(exit_velocity, printed_exit)

# %% [markdown]
# It divides by $\sqrt r$: every impact *adds* energy, and the simulation of Section 5 shows the
# block of the thesis's Figure 2-16 overturn by itself. The thesis reports that force and jumps gave
# nearly the same motion; so the slip must be in the text, and not in the program behind it.

# %% [markdown]
# ## 4. A force that can be integrated
#
# Dirac's function is no function, and neither sign is smooth. Spread them over a distance $n$,
#
# $$ \delta_n(x) = \frac{1}{n\sqrt\pi}\,\mathrm e^{-x^2/n^2}, \qquad
#    \operatorname{sgn}(x) \approx \tanh\frac xn, \qquad
#    \operatorname{sgn}(v) \approx \tanh\frac vn , \tag{7} $$
#
# and (3) becomes one smooth equation, 2-29 with the sign put right:
#
# $$ \ddot x - x + \tanh\frac xn =
#    \frac{\log\sqrt r}{n\sqrt\pi}\,\tanh\frac{\dot x}n\;\dot x^2\,\mathrm e^{-x^2/n^2} . \tag{8} $$
#
# As printed, 2-29 has this force with the other sign:

# %%
x = sp.Symbol("x", real=True)
x_d, x_dd = sp.symbols(r"\dot{x} \ddot{x}", real=True)
delta_n = sp.exp(-(x**2) / n**2) / (n * sp.sqrt(sp.pi))
force = sp.log(sp.sqrt(r)) * delta_n * sp.tanh(x_d / n) * x_d**2
smooth_block = x_dd - x + sp.tanh(x / n) - force

(printed,), (corrected,) = equation("2-29").printed, equation("2-29").right
assert sp.expand(corrected.lhs - corrected.rhs - smooth_block) == 0
assert sp.expand(printed.lhs - printed.rhs - smooth_block - 2 * force) == 0
sp.Eq(printed.lhs, printed.rhs)

# %% [markdown]
# Does the spread force still multiply by $\sqrt r$? Equation (4) remains separable and $\delta_n$
# still has the integral one. In between, the velocity follows from the ordinary differential
# equation $\mathrm dv/\mathrm dx = \log(\sqrt r)\,\delta_n(x)\,v$.

# %%
velocity = sp.Function("v")
spread = sp.Eq(velocity(x).diff(x), sp.log(sp.sqrt(r)) * delta_n * velocity(x))

part = (1 + sp.erf(x / n)) / 2  # the part of the impulse that has been given at x
profile = v0 * r ** (part / 2)

assert sp.simplify(part.diff(x) - delta_n) == 0
assert sp.checkodesol(spread, sp.Eq(velocity(x), profile))[0]
assert sp.limit(profile, x, -sp.oo) == v0
assert sp.simplify(sp.limit(profile, x, sp.oo) - sp.sqrt(r) * v0) == 0
sp.Eq(velocity(x), profile)

# %% [markdown]
# The answer is yes, exactly, for any $n$: the velocity falls from $v_0$ to $\sqrt r\,v_0$ along an
# error function, and at $x = 0$ it is $\sqrt[4]{r}\,v_0$. The weight is *not* exact:
# over the distance $n$ it acts as well, and as $\tanh(x/n)$. That is the whole error, and we
# return to it.
#
# ## 5. The block of Figure 2-16
#
# Equation (8), integrated by SciPy; nothing of the engine is used here.


# %%
def spread_block(r, n, sign=1):
    """The rates of (8) as a function of t and (x, v); sign=-1 is the printed force."""
    strength = sign * np.log(np.sqrt(r)) / (n * np.sqrt(np.pi))

    def rates(t, state):
        x, v = state
        force = strength * np.tanh(v / n) * v**2 * np.exp(-((x / n) ** 2))
        return v, x - np.tanh(x / n) + force

    return rates


def released(n, duration, sign=1):
    """The motion from rest at X0, and its later peaks |x|; it ends where the block has fallen."""

    def at_rest(t, state):
        return state[1]

    def fallen(t, state):
        return abs(state[0]) - 1.5

    fallen.terminal = True
    motion = solve_ivp(
        spread_block(R, n, sign), (0, duration), (X0, 0.0), method="DOP853", rtol=1e-10,
        atol=1e-12, max_step=0.05, events=(at_rest, fallen), dense_output=True,
    )  # fmt: skip
    turns = motion.t_events[0] > 0.1
    return motion, np.abs(motion.y_events[0][turns, 0])


right, right_peaks = released(n=1e-3, duration=6.0)
wrong, wrong_peaks = released(n=1e-3, duration=10.0, sign=-1)
print("with jumps  ", np.round(peaks[1:], 4))
print("spread force", np.round(right_peaks[:3], 4))
print("printed sign", np.round(wrong_peaks, 4), "and then it falls at t =", round(wrong.t[-1], 2))

assert np.allclose(right_peaks[:3], peaks[1:], atol=1e-3)
assert np.isclose(wrong_peaks[0], 0.661, atol=1e-3)
assert len(wrong.t_events[1]) == 1

# %% [markdown]
# The first of these peaks has a closed form. The printed force multiplies the energy by $1/r$, so
# (2) with $1/r$ gives $0.661$; at the next impact the right-hand side of (2) would exceed one, and
# there is no peak any more.

# %%
assert np.isclose(wrong_peaks[0], 1 - np.sqrt(1 - (1 - (1 - X0) ** 2) / R), atol=2e-3)
assert (1 - (1 - wrong_peaks[0]) ** 2) / R > 1


# %%
def with_jumps(duration):
    """Times and rotations of the block with jumps, by its closed form."""
    t, x, start, side = [], [], 0.0, 1
    for peak in [X0, *peaks[1:]]:
        quarter = np.arccosh(1 / (1 - peak))
        local = np.linspace(-quarter if t else 0.0, quarter, 200)
        start += quarter if t else 0.0
        t.append(start + local)
        x.append(side * (1 - (1 - peak) * np.cosh(local)))
        start, side = start + quarter, -side
    t, x = np.concatenate(t), np.concatenate(x)
    return t[t <= duration], x[t <= duration]


# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(7.0, 3.2), layout="constrained")
times = np.linspace(0, 4.9, 800)
for width, color in [(0.1, fb.LINES[5]), (0.03, fb.LINES[4]), (1e-3, fb.LINES[0])]:
    ax.plot(times, released(width, 5.0)[0].sol(times)[0], color=color, label=f"(8), $n={width:g}$")
ax.plot(*with_jumps(4.9), "k--", lw=0.9, label="with jumps")
ax.plot(times, wrong.sol(times)[0], color=fb.LINES[1], label="printed sign, $n=0.001$")
ax.axhline(0, color=fb.INK, lw=0.6)
ax.set(xlabel=r"time $p\,t$", ylabel=r"rotation $x=\theta/\alpha$", xlim=(0, 5))
ax.legend(ncols=3, loc="lower left", bbox_to_anchor=(0.0, 1.0))
plt.show()

# %% [markdown]
# *Figure 2. Release from $x_0 = 0.4$ with $r = 0.7225$ (the thesis's Figures 2-16 and 2-17).
# With the printed sign the next peak is higher than the release, and then the block falls.*

# %% [markdown]
# ## 6. How far off is the spread force?
#
# Count $w = \dot x^2$, twice the kinetic energy, as a function of $x$, in a passage to the right.
# With $X = x/n$ and $\Phi(X) = \tfrac12(1 + \operatorname{erf}X)$, (8) reads
#
# $$ \frac{\mathrm dw}{\mathrm dX} = \log(r)\,\Phi'(X)\,w + 2n\,(nX - \tanh X) . \tag{9} $$
#
# To order zero in $n$ this is the law above, $w = w_0\,r^{\Phi}$. Write
# $w = w_0\,r^{\Phi} + n\,[\,y(X) - 2\log(2\cosh X)\,]$. Far from the upright position
# $\log(2\cosh X) = |X|$, and $-2n|X| = -2|x|$ is the work of the weight that the block with
# jumps has as well. So $y(\infty)$ is the error. Put into (9), the terms of order $n$ are
#
# $$ y' = \log(r)\,\Phi'\,\bigl[\,y - 2\log(2\cosh X)\,\bigr], \qquad y(-\infty) = 0 . \tag{10} $$

# %%
X, scale, w0 = sp.symbols("X n w_0", positive=True)
Phi = (1 + sp.erf(X)) / 2
y = sp.Function("y")
w = w0 * r**Phi + scale * (y(X) - 2 * sp.log(2 * sp.cosh(X)))
missing = w.diff(X) - sp.log(r) * Phi.diff(X) * w - 2 * scale * (scale * X - sp.tanh(X))
first_order = sp.expand(missing).coeff(scale, 1)
stated = y(X).diff(X) - sp.log(r) * Phi.diff(X) * (y(X) - 2 * sp.log(2 * sp.cosh(X)))

assert sp.expand(missing).coeff(scale, 0) == 0
assert sp.simplify((first_order - stated).rewrite(sp.exp)) == 0

# %% [markdown]
# This is linear, with the integrating factor $r^{-\Phi}$:
#
# $$ c = y(\infty) = -2\,r\log(r)\int_{-\infty}^{\infty} r^{-\Phi(X)}\,\Phi'(X)\,
#    \log(2\cosh X)\,\mathrm dX \;>\; 0 . \tag{11} $$
#
# So the block leaves the first impact with $w = r\,w_0 + n\,c$ instead of $r\,w_0$. The next peak
# satisfies $1 - (1 - x_1)^2 = r\,w_0 + n\,c$ with $w_0 = 1 - (1 - x_0)^2$, and therefore
#
# $$ x_1 = x_1^{\text{jumps}} + \frac{c}{2\,(1 - x_1^{\text{jumps}})}\;n + O(n^2) . \tag{12} $$
#
# The error is of **first order** in $n$, and too large a peak: the force acts partly where the
# block has not yet won its full speed or has lost some of it already, and takes less.


# %%
def weighted(X):
    return R ** -((1 + erf(X)) / 2) * np.exp(-(X**2)) / np.sqrt(np.pi) * np.log(2 * np.cosh(X))


c = -2 * R * np.log(R) * quad(weighted, -9, 9)[0]
predicted = c / (2 * (1 - peaks[1]))
widths = np.array([0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4])
errors = np.array([released(width, 2.5)[1][0] for width in widths]) - peaks[1]
for width, error in zip(widths, errors, strict=True):
    print(f"n = {width:7.4f}   error of the next peak {error:.3e} = {error / width:.5f} n")
print(f"predicted by (12): {predicted:.5f} n")

assert np.isclose(errors[-1] / widths[-1], predicted, rtol=3e-4)
assert np.allclose(errors / widths, predicted, rtol=0.02)


# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(4.8, 3.2), layout="constrained")
ax.loglog(widths, predicted * widths, color=fb.INK, lw=0.9, label="(12)")
ax.loglog(widths, errors, "o", color=fb.LINES[0], label="(8) by SciPy")
ax.set(xlabel="width $n$ of the impact", ylabel="error of the next peak")
ax.legend()
plt.show()

# %% [markdown]
# *Figure 3. The error of the next peak: of first order in $n$, with the coefficient of (12). With
# $n = 10^{-3}$, as in the thesis, it is $3.4\cdot10^{-4}$.*
#
# ## 7. Limits of the spread force
#
# The block with jumps comes to rest: its impacts follow each other faster and faster, infinitely
# many in a finite time. The smooth block does not. Once its energy is below about $n$ it stays
# in the bottom of the well $n\log\cosh(x/n) - x^2/2$, which is a parabola. There it vibrates at
# $\sqrt{1/n - 1}$, and the force, which is of the third power in the velocity, hardly damps it.

# %%
well = n * sp.log(sp.cosh(x / n)) - x**2 / 2
assert sp.simplify(sp.diff(well, x, 2).subs(x, 0) - (1 / n - 1)) == 0

speed = sp.Symbol("v", real=True)
force_at_bottom = sp.log(sp.sqrt(r)) / (n * sp.sqrt(sp.pi)) * sp.tanh(speed / n) * speed**2
leading = sp.series(force_at_bottom, speed, 0, 4).removeO()
assert sp.simplify(leading - sp.log(sp.sqrt(r)) * speed**3 / (n**2 * sp.sqrt(sp.pi))) == 0
sp.Eq(sp.Symbol("F_delta"), leading)

# %% [markdown]
# So the spread force is a good model of the impacts of a block that still rocks, and a poor one of
# how it comes to rest. It also makes the equation stiff: steps must be shorter than the time
# $n/|\dot x|$ of a passage.

# %% [markdown]
# ## 8. The engine
#
# In the engine the block is a mass at the centre of percussion, whose height follows from the lever
# of its weight, and (8) is derived from there. Its coordinate is $x$, times are $p\,t$. First the
# equation itself, symbol by symbol:

# %%
model = rk.derive("dirac_delta_block")
(alpha,) = (p.symbol for p in model.parameters if p.name == "alpha")
(row,) = model.equations("right_core").residual
engine = sp.expand(row.subs({GROUND_X: 0, GROUND_Y: 0}) / alpha**2)
assert sp.simplify(sp.expand_log(engine - smooth_block)) == 0
sp.Eq(engine, 0)

# %% [markdown]
# And now the motion, against SciPy, and against the engine's slender block with jumps.

# %%
still = rk.GroundMotion.none(5.0)
spread_run = rk.simulate(
    rk.DiracDeltaBlock(alpha=0.25, energy_ratio=R, regularisation=1e-3), still, initial={"x": X0}
)
when = np.linspace(0.0, 5.0, 200)
np.testing.assert_allclose(spread_run.at(when)["x"], right.sol(when)[0], atol=1e-7)

slender = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.25)
jumping_run = rk.simulate(
    slender, still, impact=rk.EnergyRatio(R), initial={"theta": X0 * slender.alpha}
)
difference = spread_run.at(when)["x"] - jumping_run.at(when)["theta"] / slender.alpha
print("largest difference between force and jumps:", np.abs(difference).max().round(5))
assert 1e-4 < np.abs(difference).max() < 5e-3

# %% [markdown]
# ## Exercises
#
# 1. Are the squares in (6) the only solution of $g(\sqrt r\,v) = r\,g(v)$? *Hint: try
#    $g = v^2\,h(\log v)$ with a periodic $h$. Which period? Why is it no use?*
# 2. At what $x$ is the force of (8) largest in a fast passage? *Hint: $F_\delta$ is proportional to
#    $\delta_n v^2$, and $v$ is known; you meet $X\mathrm e^{X^2} = \log(r)/(2\sqrt\pi)$.*
# 3. How long does a passage last, and what acceleration does the block of Figure 2-16 feel in its
#    first one? Compare with the spikes of that figure. *Hint: $\log(\sqrt r)\,v^2/(n\sqrt\pi)$.*
# 4. Find the error of the *second* peak after the release. *Hint: use (12) again, and let the first
#    error go through (2); the simulation gives $0.529\,n$.*
# 5. Multiply (8) by $\dot x$ and show that with $r = 1$ the energy is constant for every $n$. Does
#    $n$ then still change the time of the first impact? *Hint: which potential has the force
#    $x - \tanh(x/n)$, and how does it differ from that of (1) far from $x = 0$?*
# 6. In the thesis's 4-28 the same force stands on the *left* of the equation of a wall, without a
#    minus sign. Is it right there? *Hint: which sign must a damping force have on that side?*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Any $h(\log v)$ with the period $\log\sqrt r$ does:
# $g(\sqrt r\,v) = r\,v^2\,h(\log v + \log\sqrt r) = r\,g(v)$. But the period belongs to one $r$,
# and the force would go up and down with the speed, for which nothing in the impact is a reason.
# Only the constant works for every $r$.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# In a fast passage $v^2 = v_0^2\,r^\Phi$, and $\delta_n v^2 \propto \mathrm e^{-X^2}r^{\Phi(X)}$ is
# largest at $2X = \ln(r)\,\Phi'(X)$, which is the hint's equation. For $r = 0.7225$ it is at
# $x = -0.091\,n$: a little before upright, where the block is still faster.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# The force acts over some $2n$, for $2n/v = 0.0025$ in units of $1/p$. The speed at the first
# impact is $v_0 = \sqrt{1-(1-x_0)^2} = 0.8$, and upright it is $\sqrt[4]r\,v_0$. With $n = 10^{-3}$
# the acceleration is 50 in units of $\alpha p^2$, of which the weight gives 1 at the most. A spike
# of this height says what $n$ was, not what the ground did.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# By (11) $c$ is the same at each impact. At the second one (2) adds to it what the first has left,
# $r\cdot2(1-x_1)\,\delta x_1 = r\,c\,n$:
#
# $$\delta x_2 = \frac{(1+r)\,c}{2\,(1-x_2)}\,n = 0.529\,n .$$
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# With $r = 1$ the right-hand side is zero and $\tfrac12\dot x^2 + n\ln\cosh(x/n) - \tfrac12x^2$ is
# constant. Far from upright $n\ln\cosh(x/n) = |x| - n\ln2$: only a constant away from (1), which
# changes no force. Near upright the block is slower, by $\delta w = -2n\ln(1+\mathrm e^{-2x/n})$ in
# $w = \dot x^2$, and comes late by
#
# $$\int\frac{-\delta w}{2v_0^3}\,\mathrm dx = \frac{n^2}{v_0^3}\int_0^\infty
#   \ln(1+\mathrm e^{-2X})\,\mathrm dX = \frac{\pi^2}{24}\frac{n^2}{v_0^3} .$$
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# No. On the left a force that takes energy has the sign of the velocity, and $\ln r < 0$: there the
# minus sign is needed. The two slips are the same one, made on two sides of an equation.
#
# </details>


# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
def wavy(speed):
    """v/g(v) of a force with a periodic part."""
    return (1 + 0.5 * np.sin(2 * np.pi * np.log(speed) / np.log(np.sqrt(R)))) / speed


through = [quad(wavy, start, np.sqrt(R) * start)[0] for start in (0.3, 0.5, 0.8)]
assert np.allclose(through, np.log(np.sqrt(R)), rtol=1e-9)

grid = np.linspace(-1, 1, 200001)
highest = grid[np.argmax(np.exp(-(grid**2)) * R ** ((1 + erf(grid)) / 2))]
assert np.isclose(highest * np.exp(highest**2), np.log(R) / (2 * np.sqrt(np.pi)), atol=2e-5)
assert round(highest, 3) == -0.091

near = first_impact + np.linspace(-0.01, 0.01, 4001)
place, rate = right.sol(near)
spike = np.log(np.sqrt(R)) / (1e-3 * np.sqrt(np.pi)) * rate**2 * np.exp(-((place / 1e-3) ** 2))
assert round(np.abs(spike).max()) == 50

second = (1 + R) * c / (2 * (1 - peaks[2]))
late_errors = [(released(width, 4.5)[1][1] - peaks[2]) / width for width in (1e-3, 3e-4)]
assert round(second, 3) == 0.529
assert np.allclose(late_errors, second, rtol=5e-3)


def upright(t, state):
    return state[0]


upright.terminal = True
width = 0.005
lossless = solve_ivp(
    spread_block(1.0, width), (0, 2), (X0, 0.0), method="DOP853", rtol=1e-11, atol=1e-13,
    max_step=0.01, events=upright,
)  # fmt: skip
delay = lossless.t_events[0][0] - first_impact
assert np.isclose(delay, np.pi**2 / 24 * width**2 / 0.8**3, rtol=0.03)

(as_printed,), (as_it_should,) = equation("4-28").printed, equation("4-28").right
assert sp.simplify(as_printed.rhs + as_it_should.rhs) == 0
exercises = Exercises({2: highest, 3: 50, 4: second})

# %%
# your answers
exercises.check(2, ...)  # x over n
exercises.check(3, ...)  # in units of alpha p**2
exercises.check(4, ...)  # error of the peak over n
