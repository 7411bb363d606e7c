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
#     figure: 5
#     level: graduate
#     minutes: 75
# ---

# %% [markdown]
# # Overturning, from Milne to maps
#
# How strong must shaking be to overturn a stone? In Japan, about 1880, John Milne asked it the
# other way round: a fallen gravestone should show how strong the earthquake was. The question has a
# simple answer that is only a bound, a good one that fits on a line, and an exact one that is a map
# with three coasts. This notebook goes from the first to the last.
#
# ## Aims
#
# After this notebook you can
#
# 1. derive West's formula, and say what it is a bound of and what it is not;
# 2. decide with one number, without following the fall, whether a block falls;
# 3. derive Housner's criteria for a push of finite duration, by his energy and without it;
# 4. explain why a simulation has trouble close to the border of overturning, and how much;
# 5. compute the border with ten digits by Newton's method, through an impact too;
# 6. read a map of overturning, and explain why a larger stone of the same shape is safer.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.optimize import brentq

import rockeom as rk
from rockeom import analysis
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.teaching import Exercises
from rockeom.thesis import equation

use_style()

# %% [markdown]
# ## 1. Statics: the formula of West
#
# The block has the half-width $B$ and its centroid at the height $H$. In axes that move with the
# ground two forces act at the centroid: the weight $mg$ with the lever $B$ about the edge $O$, and
# the inertia force $m\,a$ with the lever $H$. The block lifts where their moments are equal:
#
# $$m\,a\,H = m\,g\,B \quad\Longrightarrow\quad a = g\,\frac BH = g\tan\alpha. \tag{1}$$

# %% tags=["hide-input"] jupyter={"source_hidden": true}
b, h = 0.35, 0.88
upright = [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h), (0, h)]
figure, (lifting, balance, beyond) = plt.subplots(1, 3, figsize=(7.8, 3.4), layout="constrained")
tilts = (0.0, math.atan(b / h), math.atan(b / h) + 0.22)
for ax, tilt in zip((lifting, balance, beyond), tilts, strict=True):
    *corners, centre = fb.turned(upright, (b, 0), tilt)
    fb.bare(ax)
    fb.ground(ax, -0.65, 1.35, depth=0.08)
    if tilt:
        fb.body(ax, upright[:4], faint=True)
    fb.body(ax, corners)
    fb.centroid(ax, centre, "$G$", (-10, 7))
    fb.pivot(ax, (b, 0), "$O$", (13, 8))
    fb.arrow(ax, centre, (centre[0], centre[1] - 0.42), "$mg$", offset=(-13, 4))
    ax.set(xlim=(-0.7, 1.75), ylim=(-0.45, 2.05))
fb.arrow(lifting, (0, h), (0.6, h), "$m\\,a$", offset=(4, 8))
fb.dimension(lifting, (0, 0), (b, 0), "$B$", -0.2, (0, -8))
fb.dimension(lifting, (b, 0), (b, h), "$H$", -0.42, (9, 0))
fb.line(balance, (b, 0), (b, 1.2))
fb.angle(balance, (b, 0), (-b, 0), fb.turned(upright, (b, 0), tilts[1])[0], 0.5, r"$\alpha$",
         sense=True, label_radius=1.2)  # fmt: skip
lifting.set_title("it lifts", fontsize=9)
balance.set_title(r"the balance, $\theta = \alpha$", fontsize=9)
beyond.set_title("it falls", fontsize=9)
plt.show()

# %% [markdown]
# *Figure 1. Lifting is a matter of forces, falling one of position: a block at rest falls if its
# centroid is beyond the edge. On the way from the first picture to the third it needs time.*
#
# Milne gives (1) as due to C. D. West; it is thesis 2-1. The engine, which knows of virtual work
# only, has the same threshold: upright on its right edge the block stays where it is.

# %%
model = rk.derive("rigid_block")
B, H, m, g, a = sp.symbols("B H m g a", positive=True)
I_G = next(q.symbol for q in model.parameters if q.name == "inertia")
still = {GROUND_X: -a, GROUND_Y: 0}  # ground to the left is a push to the right
(turn,) = model.coordinates
still |= {turn.acceleration: 0, turn.velocity: 0, turn.position: 0}
(moments,) = model.equations("right").residual
(lifts_at,) = sp.solve(moments.subs(still), a)
assert sp.simplify(lifts_at - g * B / H) == 0
west = equation("2-1").right[0].rhs
assert sp.simplify(west.subs({q: sp.Symbol(q.name, positive=True) for q in west.free_symbols})
                   - lifts_at) == 0  # fmt: skip

# %% [markdown]
# The stones that Milne measured were 1.5 m high and 0.6 m thick: they lift at 0.4 g. If the ground
# pushes for ever, lifting means falling, for the lever of the weight shrinks as the block turns. So
# (1) is the *least* acceleration that can overturn a stone. It says nothing on how long it must
# act.

# %%
gravestone = rk.RigidBlock(half_width=0.3, half_height=0.75)
threshold = gravestone.uplift_acceleration
assert math.isclose(threshold / gravestone.gravity, 0.4)
for factor, outcome in [(1 - 1e-6, rk.Outcome.CAME_TO_REST), (1 + 1e-6, rk.Outcome.OVERTURNED)]:
    forever = rk.GroundMotion.constant(factor * threshold, duration=20.0)
    assert rk.simulate(gravestone, forever).outcome is outcome

# %% [markdown]
# ## 2. One number decides
#
# For a slender block we measure the rotation as $x=\theta/\alpha$, time as $t=p\tau$ with
# $p=\sqrt{mgR/I_o}$, and the push $a(t)$ as a multiple of $g\alpha$; see
# [one block for all sizes](nondimensional_block.py). While it stands on its right edge
#
# $$\ddot x = x - 1 + a(t). \tag{2}$$
#
# Add $\dot x$ to both sides: the sum $q = x + \dot x$ obeys an equation of first order by itself,
#
# $$\dot q = q - 1 + a(t). \tag{3}$$
#
# When the push is over, $q - 1$ grows as $\mathrm e^{t}$ or falls as $-\mathrm e^{t}$. In the first
# case so does $x$: the block falls. In the second it comes back. There is nothing in between but
# the line
#
# $$x + \dot x = 1, \tag{4}$$
#
# on which the block creeps up to its balance and never gets there. It is the *separatrix*, and the
# part of it above $x=1$ is of blocks that are beyond the balance and return.

# %%
t = sp.Symbol("t", positive=True)
x = sp.Function("x")
A = sp.Symbol("A", positive=True)
q = x(t) + x(t).diff(t)
slender = {x(t).diff(t, 2): x(t) - 1 + A}
assert sp.simplify(q.diff(t).subs(slender) - (q - 1 + A)) == 0

# %% [markdown]
# **A push of finite duration.** Let $a(t) = A > 1$ for $0 < t < t_1$, then nothing. From (3),
# $q = (A-1)(\mathrm e^{t}-1)$, and the border $q(t_1) = 1$ is
#
# $$\mathrm e^{t_1} = \frac{A}{A-1}. \tag{5}$$
#
# Housner (1963) found it with energy. Up to $t_1$ the push does the work $A\,x(t_1)$; the block
# falls if that is the work to the balance, $\int_0^1 (1-x)\,\mathrm dx = \frac12$. With
# $x(t_1) = (A-1)(\cosh t_1 - 1)$
#
# $$\cosh t_1 = 1 + \frac{1}{2A(A-1)}. \tag{6}$$
#
# This is the same, for (5) makes $\cosh t_1 = \frac12\left(\frac A{A-1} + \frac{A-1}A\right)$.

# %%
rotation = (A - 1) * (sp.cosh(t) - 1)
assert sp.simplify(rotation.diff(t, 2) - (rotation - 1 + A)) == 0
assert sp.simplify((rotation + rotation.diff(t)).rewrite(sp.exp) - (A - 1) * (sp.exp(t) - 1)) == 0
by_number = (A / (A - 1) + (A - 1) / A) / 2
by_energy = 1 + 1 / (2 * A * (A - 1))
assert sp.simplify(by_number - by_energy) == 0

# %% [markdown]
# The engine falls on one side of (5) and stands on the other, a millionth apart. We take a block
# with $p = 1$ rad/s, so that seconds are units of $t$. (Under a ground acceleration to the right it
# falls to the left; signs of $x$ are turned round.)

# %%
unit_block = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)
unit = unit_block.alpha * unit_block.gravity  # A = 1
sparse = rk.SolverOptions(output_step=100.0)


def falls(motion, impact=None):
    run = rk.simulate(unit_block, motion, impact=impact, options=sparse)
    return run.outcome is rk.Outcome.OVERTURNED


def push(A, t_1):
    return rk.GroundMotion.constant(-A * unit, t_1, total_duration=t_1 + 40.0)


for A_run in (1.01, 1.5, 4.0, 30.0):
    t_1 = math.log(A_run / (A_run - 1))
    assert not falls(push(A_run, t_1 * (1 - 1e-6)))
    assert falls(push(A_run, t_1 * (1 + 1e-6)))
    needed = analysis.formulas.overturning_constant(t_1, unit_block.alpha, 1.0)
    assert math.isclose(needed, A_run * unit, rel_tol=1e-12)

# %%
A_run = 1.5
border = math.log(A_run / (A_run - 1))
figure, ax = plt.subplots(figsize=(5.4, 4.0), layout="constrained")
for color, factor in zip(fb.LINES, (0.85, 1.0 - 1e-9, 1.15), strict=False):
    run = rk.simulate(unit_block, push(A_run, factor * border))
    shown = (run["theta"] > 0) & (run["theta"] < 2 * unit_block.alpha) & (run.t < 12)
    shown[0] = True
    first = run.impacts[0].time if run.impacts else math.inf
    shown &= run.t < first
    place, rate = run["theta"][shown] / unit_block.alpha, run["theta_dot"][shown] / unit_block.alpha
    ax.plot(place, rate, color=color, label=rf"$t_1$ = {factor:.2f} of (5)")
    ended = run.at([factor * border])
    ax.plot(
        ended["theta"] / unit_block.alpha, ended["theta_dot"] / unit_block.alpha, "o", color=color
    )
ax.plot([0, 2], [1, -1], "--", color=fb.INK, lw=1.0, label=r"$x+\dot x = 1$")
ax.plot(1, 0, "o", color="black", mfc="white", ms=6, zorder=3)
ax.annotate("balance", (1, 0), (6, -14), textcoords="offset points", fontsize=8.5)
ax.axhline(0, color=fb.INK, lw=0.6)
ax.set(xlabel=r"$x=\theta/\alpha$", ylabel=r"$\dot x$", xlim=(0, 2), ylim=(-1.0, 1.3))
ax.legend(loc="upper right", bbox_to_anchor=(1.0, 0.72))
plt.show()

# %% [markdown]
# *Figure 2. Three pushes with $A=1.5$ in the phase plane. Dots: the push ends. The side of the line
# on which the dot is decides.*
#
# **A short push** is strong, $A \gg 1$, and (5) becomes $A\,t_1 = 1$: only the impulse counts. In
# metres and seconds the ground must gain the velocity
#
# $$V = \frac{g\,\alpha}{p} \propto \alpha\sqrt R. \tag{7}$$
#
# So there are two regimes. Long pushes ask for an *acceleration*, $g\alpha$, whatever the size.
# Short ones ask for a *velocity*, and that grows with the square root of the size. A fallen stone
# tells of one or of the other, and by itself it does not say of which.

# %%
lowest_order = sp.limit(A * sp.log(A / (A - 1)), A, sp.oo)
assert lowest_order == 1
speed = analysis.formulas.overturning_spectral_velocity(
    gravestone.alpha, gravestone.frequency_parameter, gravestone.gravity
)
print(f"the gravestone: more than {threshold / gravestone.gravity:.2f} g, or {speed:.2f} m/s")

# %% [markdown]
# ## 3. Close to the border
#
# After the push $q - 1 = \delta\,\mathrm e^{t - t_1}$ with a small $\delta$: the block stays near
# its balance until this is no longer small. The nearer to the border, the longer it takes to know:
#
# $$t_{\text{fall}} - t_1 \approx \ln\frac1{|\delta|} + \text{const}. \tag{8}$$
#
# Three things follow for computations. Each further digit of the border costs $\ln 10 = 2.3$ units
# of time. A run that is cut off too early mistakes a falling block for a standing one. And an error
# of the integration acts as an error of $\delta$: a tolerance of $10^{-6}$ gives six digits and no
# more, however long one bisects.

# %%
distances = 10.0 ** -np.arange(1, 10)
falling = {}
for side in (1, -1):
    ends = []
    for distance in distances:
        run = rk.simulate(unit_block, push(A_run, border + side * distance), options=sparse)
        ends.append(run.t[-1] if side > 0 else run.impacts[0].time)
    falling[side] = np.array(ends)
    slope = np.polyfit(np.log(1 / distances), falling[side], 1)[0]
    assert math.isclose(slope, 1.0, abs_tol=0.02)

figure, ax = plt.subplots(figsize=(5.4, 3.2), layout="constrained")
for side, label in [(1, r"until it has fallen, $\theta=90°$"), (-1, "until it is back, upright")]:
    ax.semilogx(distances, falling[side], "o-", ms=4, label=label)
ax.set(xlabel=r"$|t_1 - t_1^{\rm border}|$", ylabel="time $t$")
ax.invert_xaxis()
ax.legend()
plt.show()

# %% [markdown]
# *Figure 3. The time that passes until the fate of a block is seen, against the distance of the
# push from the border. A straight line of slope one, on both sides.*

# %% [markdown]
# ## 4. Pulses, as long as no impact happens
#
# With (3) any push is a quadrature. Multiply by $\mathrm e^{-t}$ and integrate from the instant
# $t_0$ at which the block lifts, $a(t_0) = 1$, to the end $t_e$ of the pulse:
#
# $$\int_{t_0}^{t_e} a(t)\,\mathrm e^{-(t-t_0)}\,\mathrm dt = 1. \tag{9}$$
#
# The factor $\mathrm e^{-(t-t_0)}$ says that early pushes count more than late ones: they have time
# to grow. For half a sine, $a = A\sin\omega t$, we did this in
# [one block for all sizes](nondimensional_block.py). The package has it, and the criterion that
# Housner gave, $A=\sqrt{1+\omega^2}$, in which the sine goes on and pulls the block back.
#
# For **a full sine** the end is $t_e = 2\pi/\omega$. The second half pulls back, but $\mathrm
# e^{-t}$ makes it count less:
#
# $$\frac{A}{1+\omega^2}\left[\frac1A + \omega\sqrt{1-\frac1{A^2}}
#   - \omega\,\mathrm e^{-(2\pi/\omega - t_0)}\right] = 1, \qquad A\sin\omega t_0 = 1.
#   \tag{10}$$
#
# That is right if $x$ stays positive to the end of the pulse, and (10) then is the border of
# overturning *without an impact*.

# %%
omega = sp.Symbol("omega", positive=True)
primitive = -sp.exp(-t) * (sp.sin(omega * t) + omega * sp.cos(omega * t)) / (1 + omega**2)
assert sp.simplify(primitive.diff(t) - sp.sin(omega * t) * sp.exp(-t)) == 0


def without_impact(omega):
    """The amplitude of (10)."""

    def excess(A):
        lift = math.asin(1 / A) / omega
        decay = math.exp(-(2 * math.pi / omega - lift))
        bracket = 1 / A + omega * (math.sqrt(1 - 1 / A**2) - decay)
        return A * bracket / (1 + omega**2) - 1

    return brentq(excess, 1 + 1e-12, 1e3, xtol=1e-14)


def full_sine(omega, A):
    period = 2 * math.pi / omega
    return rk.GroundMotion.single_sine(-A * unit, period, duration=period + 40.0)


for w in (0.7, 2.0, 6.0):
    assert not falls(full_sine(w, without_impact(w) * (1 - 1e-7)), rk.VelocityRatio(0.1))
    assert falls(full_sine(w, without_impact(w) * (1 + 1e-7)), rk.VelocityRatio(0.1))

# %%
lengths = np.geomspace(0.1, 8, 120)  # of the first push
constant = 1 / -np.expm1(-lengths)
assert np.allclose(np.exp(lengths), constant / (constant - 1))  # (5)
half = analysis.formulas.overturning_half_sine(lengths, unit_block.alpha, 1.0) / unit
full = [without_impact(math.pi / length) for length in lengths]
figure, ax = plt.subplots(figsize=(5.8, 3.8), layout="constrained")
ax.loglog(lengths, constant, label="constant, (5)")
ax.loglog(lengths, half, label="half sine")
ax.loglog(lengths, full, label="full sine, no impact, (10)")
ax.loglog(lengths, 1 / lengths, ":", color=fb.INK, label="impulse $A\\,t_1 = 1$")
ax.axhline(1, color=fb.INK, ls="--", lw=1.0, label="West, (1)")
ax.set(xlabel="duration of the push, $t_1 = p\\,\\tau_1$", ylabel=r"amplitude $A$ [$g\alpha$]",
       ylim=(0.7, 40))  # fmt: skip
ax.legend()
plt.show()

# %% [markdown]
# *Figure 4. The least amplitude that overturns a slender block, against the duration of the push
# (of its first half, for the full sine). Long pushes: West's acceleration. Short ones: a given
# impulse; but a full sine has none, and must be stronger by another power of $1/t_1$.*

# %% [markdown]
# ## 5. Pulses, with impacts: the map
#
# A full sine may also throw the block over on the *other* side: the first half lifts it, it comes
# back, hits the ground, and the second half takes it. Between impacts all is still linear,
#
# $$x = s - \frac{A}{1+\omega^2}\sin\omega t + c_1\cosh(t-t_0) + c_2\sinh(t-t_0),
#   \qquad s = \operatorname{sgn} x, \tag{11}$$
#
# but the instants of impact are roots of (11), which must be found numerically. They can be found
# up to rounding, and so the following short program is exact. It returns the number of impacts
# before the block falls, which we call its *fate*; infinite if it does not fall.


# %%
def fate(omega, A, e):
    """Impacts before a slender block at rest is overturned by A sin(omega t); inf if it is not."""
    end, C = 2 * math.pi / omega, A / (1 + omega**2)
    if A <= 1:
        return math.inf
    now, side, state, impacts = math.asin(1 / A) / omega, 1, (0.0, 0.0), 0
    while now < end:
        c_1 = state[0] - side + C * math.sin(omega * now)
        c_2 = state[1] + C * omega * math.cos(omega * now)

        def height(t, c=(side, now, c_1, c_2)):
            since = t - c[1]
            free = c[2] * np.cosh(since) + c[3] * np.sinh(since)
            return c[0] * (c[0] - C * np.sin(omega * t) + free)

        later = now + (end - now) * np.linspace(0, 1, 200)[1:] ** 2
        below = np.flatnonzero(height(later) < 0)
        start = now
        now = (
            brentq(height, later[below[0] - 1], later[below[0]], xtol=1e-14) if below.size else end
        )
        rate = -C * omega * math.cos(omega * now)
        rate += c_1 * math.sinh(now - start) + c_2 * math.cosh(now - start)
        state = (side * height(now), rate)
        if below.size:
            side, state, impacts = -side, (0.0, e * rate), impacts + 1
    x, v = side * state[0], side * state[1]
    if x + v > 1:
        return impacts
    landing = v**2 - (1 - x) ** 2 + 1  # the square of the speed at the next impact
    return impacts + 1 if e**2 * landing > 1 else math.inf


# %% [markdown]
# After the pulse a block falls at once if $q>1$, and after the next impact if it leaves that with
# more than the speed 1; later ones only get slower. Now the map: the engine runs all pulses of a
# grid, and between neighbours of different fates `overturning_boundaries` bisects.

# %%
e = 0.9


def pulse(omega, A):
    return rk.Case(unit_block, full_sine(omega, A), impact=rk.VelocityRatio(e))


grid = {"omega": np.linspace(0.5, 8, 61), "A": np.linspace(1.1, 9, 61)}
sweep = rk.simulate_many(pulse, over=grid)
found = analysis.dynamics.impacts_before_overturning(sweep)
exact = np.array([[fate(w, A, e) for A in grid["A"]] for w in grid["omega"]])
assert (found.values == exact).all()

borders = analysis.overturning_boundaries(pulse, sweep)
assert borders.sizes["boundary"] > 200
for k in range(borders.sizes["boundary"]):
    border = borders.isel(boundary=k)
    low, high = float(border.low), float(border.high)
    assert high - low <= 1e-6 * high
    at = {name: float(border[name]) for name in grid}
    for one, there in [(low, border.below), (high, border.above)]:
        assert fate(**(at | {border.along.item(): one}), e=e) == there

# %%
figure, ax = plt.subplots(figsize=(7.4, 4.2), layout="constrained")
sweep["omega"].attrs["long_name"] = "frequency of the pulse ω/p"
sweep["A"].attrs["long_name"] = "amplitude A / (g α)"
rk.plots.overturning_map(sweep, x="omega", y="A", boundaries=borders, ax=ax)
w = np.linspace(0.75, 5.75, 11)
ax.plot(w, [without_impact(one) for one in w], "o", color="black", mfc="white", ms=4)
ax.set(ylim=(1.1, 9), title="slender block, one sine, $e = 0.9$")
plt.show()

# %% [markdown]
# *Figure 5. The fate of a slender block under a full sine. Lines: borders to a millionth; circles:
# (10). Above (10) it falls without an impact. In the lobe below, which ends at a certain frequency,
# it falls after one (in the lower left corner after more). Between the two runs a thin seam of
# safety.*
#
# One coast of the map we know, (10). The lobe has two, and on the left all meet at West's $A=1$. A
# weak short pulse overturns by it, and only by it: of the two ways to fall, the one through an
# impact needs less. But it ends, and then there is only (10).
#
# The same map to be moved: the point is the pulse; sliders change the restitution and the size.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
rk.explorer(
    rk.Case(
        rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2),
        rk.GroundMotion.single_sine(6.0, 0.8, duration=8.0),
        rk.VelocityRatio(0.9),
    ),
    {
        "frequency": (0.3, 2.0),  # Hz
        "amplitude": (2.2, 18.0),  # m/s2
        "restitution": (0.6, 1.0),
        "radius": (0.5, 4.0),  # m
    },
    "A slender block under one sine: the safe window above overturning",
)

# %% [markdown]
# ## 6. Digits, by Newton's method
#
# A block that is not slender has (4) as well. Without shaking its energy is conserved between
# impacts, and the block creeps to its balance if it has the energy of the balance. As an angular
# velocity,
#
# $$\dot\theta = 2p\,\sin\frac{\alpha-\theta}2. \tag{12}$$

# %%
theta, rate, alpha, p = sp.symbols("theta thetadot alpha p", positive=True)
energy = rate**2 / (2 * p**2) + sp.cos(alpha - theta)
on_the_line = energy.subs(rate, 2 * p * sp.sin((alpha - theta) / 2))
assert sp.simplify(on_the_line - 1) == 0

# %% [markdown]
# So the distance from the border is a smooth function of the state, once the pulse is over:
#
# $$Q = \frac{|\dot\theta|}{2p} - \sin\frac{\alpha-|\theta|}2, \tag{13}$$
#
# positive for a block that falls. (This is for a block that moves away from the ground; one on its
# way back has $-|\dot\theta|$.) And the state is a smooth function of the amplitude, even through
# impacts: `rk.tangents` gives its exact derivative. Then $Q = 0$ is a case for Newton's method, and
# no run needs to last until the block has fallen.
#
# We do it for the block of Figure 2-13 of the thesis, $B=1$ m, $H=8$ m (called 1 m wide and 8 m
# high, an erratum), with the energy ratio $r=0.954$, under one sine of 2.192 s. The thesis finds
# that 0.172 g overturns it and that 0.454 g does not.

# %%
tall = rk.RigidBlock(half_width=1.0, half_height=8.0)
law, period, p_tall = rk.EnergyRatio(0.954), 2.192, tall.frequency_parameter


def sine(in_g, duration=60.0):
    motion = rk.GroundMotion.single_sine(in_g * tall.gravity, period, duration=duration)
    return rk.Case(tall, motion, impact=law)


def margin(in_g, impacts):
    """Q and dQ/d(in_g), when the pulse and so many impacts are over."""
    flow = rk.tangents(sine(rk.Dual(in_g, np.array([1.0])), duration=12.0))
    last = flow.response.impacts[impacts - 1].time if impacts else 0.0
    when = [max(period, last + 0.1)]
    state = np.concatenate([flow.response.at(when)[name] for name in ("theta", "theta_dot")])
    side = np.sign(state[0])
    theta, rate = side * state
    d_theta, d_rate = side * flow.at(when)[0, :, 0]
    lean = (tall.alpha - theta) / 2
    value = rate / (2 * p_tall) - math.sin(lean)
    return value, d_rate / (2 * p_tall) + math.cos(lean) * d_theta / 2


def newton(in_g, impacts):
    """The amplitude [g] at which Q is zero, and the steps on the way to it."""
    steps = []
    while not steps or abs(steps[-1]) > 1e-12:
        value, slope = margin(in_g, impacts)
        steps.append(-value / slope)
        in_g += steps[-1]
        assert len(steps) < 20
    return in_g, steps


changes = []
for guess, impacts in [(0.18, 1), (0.45, 1), (0.46, 0)]:
    value, steps = newton(guess, impacts)
    changes.append(value)
    sizes = ", ".join(f"{abs(step):.0e}" for step in steps)
    print(f"{value:.10f} g, after {impacts} impacts; steps {sizes}")

# %% [markdown]
# Each step doubles the number of digits. A simulation on either side, $10^{-8}$ g away, confirms
# them, and so does bisection.


# %%
def overturned(in_g):
    case = sine(in_g)
    run = rk.simulate(case.structure, case.motion, impact=case.impact, options=sparse)
    return run.outcome is rk.Outcome.OVERTURNED


for value, above in zip(changes, (True, False, True), strict=True):
    assert overturned(value + 1e-8) is above
    assert overturned(value - 1e-8) is not above

line = rk.simulate_many(sine, over={"in_g": np.linspace(0.1, 0.6, 501)})
bisected = analysis.overturning_boundaries(sine, line, accuracy=1e-9)
assert np.allclose(bisected["in_g"], changes, rtol=1e-9, atol=0)

# %%
figure, ax = plt.subplots(figsize=(6.6, 3.8), layout="constrained")
for (value, name), color in zip(
    zip(changes, ("first overturning", "safe again", "falls at once"), strict=True),
    fb.LINES,
    strict=False,
):
    for sign, dashes in [(-1, "-"), (1, "--")]:
        case = sine(value + sign * 1e-4, duration=14.0)
        run = rk.simulate(case.structure, case.motion, impact=case.impact)
        label = f"{name}, {value:.6f} g" if sign < 0 else None
        ax.plot(run.t, run["theta"] / tall.alpha, dashes, color=color, label=label)
ax.axvspan(0, period, color="0.93")
ax.axhline(1, color=fb.INK, ls=":", lw=0.9)
ax.axhline(-1, color=fb.INK, ls=":", lw=0.9)
ax.set(xlabel="time [s]", ylabel=r"$\theta/\alpha$", xlim=(0, 14), ylim=(-2.2, 2.2))
ax.legend(loc="upper left", fontsize=8)
plt.show()

# %% [markdown]
# *Figure 6. The block of Figure 2-13 at the three amplitudes where its fate changes, 0.0001 g below
# (full lines) and above (dashed). Dotted: the balances. The pulse is the grey band.*
#
# From the first of them to the second the block falls after an impact; then there is a *safe
# window* of less than one hundredth of g, in which it swings far beyond its balance and is brought
# back; from the third on it falls at once. The same pulse, 2.6 times as strong, spares the block.
# Do not build on it: the window is real, but no ground keeps an amplitude to one per cent.

# %% [markdown]
# ## 7. Size
#
# In the 1940s Ikegami and Kishinouye went round graveyards after earthquakes and found slender
# stones that stood among squat ones that lay. By (1) that is impossible. By (7) it is not: a
# slender stone that is large enough needs the greater velocity.

# %%
heights = np.geomspace(0.2, 6.0, 80)
first_push = 0.2  # s, half a sine
stones = {"squat, 2 : 1": (2.0, 0.3), "slender, 4 : 1": (4.0, 5.0)}
strength = 1.15  # g
figure, ax = plt.subplots(figsize=(6.0, 3.8), layout="constrained")
for (label, (aspect, height)), color in zip(stones.items(), fb.LINES, strict=False):
    of_this_shape = [
        rk.RigidBlock(half_width=one / 2 / aspect, half_height=one / 2) for one in heights
    ]
    needed = [
        analysis.formulas.overturning_half_sine(first_push, one.alpha, one.frequency_parameter)
        / one.gravity
        for one in of_this_shape
    ]
    ax.semilogx(heights, needed, color=color, label=label)
    ax.axhline(1 / aspect, ls="--", lw=1.0, color=color)
    stone = rk.RigidBlock(half_width=height / 2 / aspect, half_height=height / 2)
    motion = rk.GroundMotion.half_sine(strength * stone.gravity, 2 * first_push, duration=20.0)
    outcome = rk.simulate(stone, motion).outcome
    assert (outcome is rk.Outcome.OVERTURNED) == (aspect == 2.0)
    mark = "x" if outcome is rk.Outcome.OVERTURNED else "o"
    ax.plot(height, strength, mark, color="black", mfc="white", ms=7)
marks = [0.2, 0.5, 1, 2, 5]
ax.set_xticks(marks, [f"{mark:g}" for mark in marks])
ax.minorticks_off()
ax.set(xlabel="height of the stone [m]", ylabel="least amplitude [g]", ylim=(0, 2))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 7. The least amplitude of half a sine of 0.2 s that overturns a stone, against its height.
# Dashed: West. The same pulse of 1.15 g overturns a squat stone of 0.3 m (cross) and spares a
# slender one of 5 m (circle); both were simulated as rigid blocks.*
#
# Milne's question has an answer after all, but of another kind: a field of stones of many sizes and
# shapes, some lying and some standing, encloses acceleration *and* velocity. One stone gives two
# bounds, and which of them is close it does not say.
#
# Size to be moved: "three sizes" shows a stone next to those of twice and four times its size.


# %% tags=["hide-input"] jupyter={"source_hidden": true}
def stone_of(height, slenderness, amplitude):
    """A stone under half a sine of 0.2 s."""
    block = rk.RigidBlock(half_width=height / 2 / slenderness, half_height=height / 2)
    return rk.Case(block, rk.GroundMotion.half_sine(amplitude, 2 * first_push, duration=12.0))


rk.explorer(
    stone_of,
    {"height": (0.2, 6.0, 0.5), "slenderness": (1.5, 6.0, 4.0), "amplitude": (1.0, 20.0, 6.0)},
    "The size of a stone",
)

# %% [markdown]
# ## Exercises
#
# 1. **Upwards.** The ground accelerates upwards by $a_v$ as well. When does the stone lift?
#    *Hint: `GROUND_Y` in Section 1.*
# 2. **Two bounds.** A push that never reverses overturns a slender block without an impact. Show
#    that its peak is more than 1 and its impulse more than 1, whatever its form. *Hint: (9) and
#    $\mathrm e^{-t}\le1$.*
# 3. **To and fro.** A push $A$ for the time $t_1$, then $-A$ for as long. What is the border
#    without an impact, and how much longer than in (5) must a push now be? *Hint: (3) twice; with
#    $E=\mathrm e^{t_1}$ a quadratic equation.*
# 4. **Housner, not slender.** Use energy for a block of any shape and a constant push $a$: at which
#    rotation $\theta_1$ must the push end? *Hint: the work of $m\,a$ is that on the way of the
#    centroid.*
# 5. **How long to wait.** For how many seconds after the pulse must the block of Figure 6 be
#    followed, for six digits by bisection? *Hint: (8), and $1/p$.*
# 6. **The end of the lobe.** At which frequency does the lobe of Figure 5 end, and which energy
#    ratio makes it vanish sooner: 0.81 or 0.64? *Hint: bisect on whether any amplitude below (10)
#    has the fate 1.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# At $a = (g + a_v)\tan\alpha$: the ground that accelerates upwards makes the stone heavier.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# Below 1 it does not even lift. In (9) the exponential is at most 1 and $a\ge0$, so that the
# integral of $a$ itself is at least 1. For the constant push these are $A>1$ and $A\,t_1 >1$, and
# (5) is above both: $\ln\frac{A}{A-1} > \frac1A$.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# After the first push $q = (A-1)(E-1)$, after the second
# $q = 1 + A + \bigl[(A-1)(E-1) - 1 - A\bigr]E$. It is 1 for $(A-1)E^2 - 2AE + A = 0$,
#
# $$t_1 = \ln\frac{\sqrt A}{\sqrt A-1}.$$
#
# This is (5) with $\sqrt A$ for $A$: to and fro, a push of amplitude $A$ is worth one of $\sqrt A$
# that does not reverse.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# The work of the push is $m\,a\,R\,[\sin\alpha - \sin(\alpha-\theta_1)]$, that to the balance
# $mgR\,(1-\cos\alpha)$. Hence $\sin(\alpha-\theta_1) = \sin\alpha - \frac ga(1-\cos\alpha)$.
# When the block gets there is another matter, and a quadrature.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# $\ln 10^6/p = 14.5$ s, and some $1/p$ more for the constant. Each digit costs 2.4 s. Newton's
# method needs none of them.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# At $\omega = 6.58\,p$ for $r = 0.81$ and $4.33\,p$ for $r = 0.64$: the more an impact takes,
# the sooner. Pulses of higher frequency overturn the block without an impact or not at all.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
upwards = sp.Symbol("a_v", positive=True)
(heavier,) = sp.solve(moments.subs(still | {GROUND_Y: upwards}), a)
assert sp.simplify(heavier - (g + upwards) * B / H) == 0

strengths = np.geomspace(1.001, 100, 50)
assert (np.log(strengths / (strengths - 1)) > 1 / strengths).all()
assert (half > 1).all()
assert (half * lengths * 2 / np.pi > 1).all()  # the impulse of half a sine

E = sp.Symbol("E", positive=True)
after = 1 + A + ((A - 1) * (E - 1) - 1 - A) * E
root = sp.sqrt(A) / (sp.sqrt(A) - 1)
assert sp.simplify(after.subs(E, root) - 1) == 0
A_run = 3.0
t_1 = math.log(root.subs(A, A_run))
for factor, outcome in [(1 - 1e-6, False), (1 + 1e-6, True)]:
    length = t_1 * factor
    there = (A_run - 1) * np.array([math.cosh(length) - 1, math.sinh(length)]) * unit_block.alpha
    back = rk.GroundMotion.constant(A_run * unit, length, total_duration=length + 40.0)
    start = dict(zip(("theta", "theta_dot"), there, strict=True))
    run = rk.simulate(unit_block, back, initial=start)
    early = len(run.impacts) == 0
    assert (early and run.outcome is rk.Outcome.OVERTURNED) == outcome

strong = 2 * tall.uplift_acceleration
sine_then = math.sin(tall.alpha) - (1 - math.cos(tall.alpha)) * tall.gravity / strong
theta_1 = tall.alpha - math.asin(sine_then)
pushed = rk.simulate(tall, rk.GroundMotion.constant(-strong, 5.0))
t_1 = brentq(lambda t: pushed.at([t])["theta"][0] - theta_1, 0.1, 2.0, xtol=1e-13)
for factor, outcome in [(1 - 1e-6, False), (1 + 1e-6, True)]:
    some = rk.GroundMotion.constant(-strong, factor * t_1, total_duration=40.0)
    assert (rk.simulate(tall, some).outcome is rk.Outcome.OVERTURNED) == outcome

assert round(math.log(1e6) / p_tall, 1) == 14.5
assert round(math.log(10) / p_tall, 1) == 2.4


def lobe(omega, e):
    """Whether an amplitude below (10) overturns after one impact."""
    below = np.linspace(1.1, without_impact(omega), 80)
    return any(fate(omega, A, e) == 1 for A in below)


for ratio, end in [(0.81, 6.58), (0.64, 4.33)]:
    assert lobe(end - 0.01, math.sqrt(ratio))
    assert not lobe(end + 0.01, math.sqrt(ratio))
exercises = Exercises({1: heavier, 5: math.log(1e6) / p_tall, 6: 6.58})

# %%
# your answers
exercises.check(1, ...)  # an expression in g, upwards, B and H
exercises.check(5, ...)  # in seconds
exercises.check(6, ...)  # omega over p of the end of the lobe for r = 0.81
