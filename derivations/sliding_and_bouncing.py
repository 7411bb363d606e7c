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
# # Sliding and bouncing, and when they matter
#
# Housner's block stands on edges that neither slide nor jump. We wrote this down in
# [the first notebook](housner_block.py) and went on. Now we ask what it costs: how much friction a
# block that is pinned to the ground takes for granted, what the block does where there is less, and
# how to see from a response whether the pins were good enough.
#
# ## Aims
#
# After this notebook you can
#
# 1. give the friction that a pinned block needs, as it starts, as it rocks and as it lands;
# 2. say which of five motions a block begins from rest, and derive the borders between them;
# 3. derive an impact with friction, and say what its law may do wrong;
# 4. decide from a response whether sliding matters, and follow it where it does.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.teaching import Exercises

use_style()

p, alpha, gravity = 2.14, 0.25, 9.81  # rad/s, rad, m/s2
still = rk.GroundMotion.none(14.0)


def sliding(friction, restitution=0.0, alpha=alpha):
    """The block of this notebook on feet that may slide and bounce."""
    return rk.SlidingBlock.from_frequency(
        p=p, alpha=alpha, friction=friction, restitution=restitution
    )


pinned = rk.RigidBlock.from_frequency(p=p, alpha=alpha)
half_width, half_height = pinned.half_width, pinned.half_height

# %% [markdown]
# ## 1. Five motions
#
# A foot on rough ground has three states: it **sticks**, it **slips** to one side, or it is
# **open**, above the ground. Two feet of one rigid base slip together or not at all. So the block
# can do five things, which are called *rest*, *slide*, *rock*, *slide-rock* and *flight* (Shenton
# 1996).


# %% tags=["hide-input"] jupyter={"source_hidden": true}
def draw(ax, place, theta, title, b=0.25, h=0.62):
    """The block with the middle of its base at a place; its corners, from the left foot on."""
    x, y = place
    corners = [(x - b, y), (x + b, y), (x + b, y + 2 * h), (x - b, y + 2 * h), (x, y + h)]
    *corners, centre = fb.turned(corners, place, theta)
    fb.ground(ax, -0.62, 0.62, depth=0.06)
    fb.body(ax, corners)
    fb.centroid(ax, centre)
    fb.bare(ax)
    ax.set(xlim=(-0.65, 0.65), ylim=(-0.42, 1.6), title=title)
    return corners, centre


figure, axes = plt.subplots(1, 5, figsize=(8.6, 3.0), layout="constrained")
tilt, b = 0.16, 0.25
raised = b * math.sin(tilt)
for ax, place, theta, title in zip(
    axes,
    [(0, 0), (0, 0), (-0.05, raised), (-0.05, raised), (0, 0.18)],
    [0, 0, tilt, tilt, 0.1],
    ["rest", "slide", "rock", "slide-rock", "flight"],
    strict=True,
):
    (left, right, *_), centre = draw(ax, place, theta, title)
    standing = [foot for foot in (left, right) if foot[1] < 1e-3]
    for foot in standing:
        fb.arrow(ax, (foot[0], -0.36), (foot[0], -0.05), "$N$", label_at="tail", offset=(7, 4))
        if "slide" in title:
            fb.arrow(ax, (foot[0] + 0.22, -0.12), (foot[0], -0.12))
    if "slide" in title:
        fb.arrow(ax, centre, (centre[0] + 0.3, centre[1]), color=fb.MOTION)
        ax.annotate(r"$\mu N$", (right[0], -0.12), (13, -13), textcoords="offset points")
    if title == "rock":
        fb.pivot(ax, right)
plt.show()

# %% [markdown]
# *Figure 1. The five motions. Where a foot slips, its friction is $\mu N$ and opposes the slip;
# where it sticks, friction is what it must be, as long as it is less than $\mu N$.*
#
# ## 2. Friction that a pinned block needs
#
# Let the block rock about its right foot, $\varphi = \alpha - \theta$ the angle between the
# vertical and the line from the foot to the centroid. From the foot the centroid is at
# $R(-\sin\varphi, \cos\varphi)$. The free block falls by $\ddot\varphi = p^2\sin\varphi$, and from
# rest at $\varphi_0$ it has $\dot\varphi^2 = 2p^2(\cos\varphi_0 - \cos\varphi)$. The ground gives
# what the mass needs: $F = m\ddot x_G$ and $N = m(g + \ddot y_G)$, with $p^2 R = 3g/4$:
#
# $$\frac{F}{mg} = \tfrac34\sin\varphi\,(2\cos\varphi_0 - 3\cos\varphi), \qquad
#   \frac{N}{mg} = 1 - \tfrac34\left(\sin^2\varphi
#     + 2\cos\varphi\cos\varphi_0 - 2\cos^2\varphi\right). \tag{1}$$

# %%
phi, phi_0, rate, accel, R, w = sp.symbols("varphi varphi_0 rate accel R p", positive=True)
time = sp.Symbol("t")
angle = sp.Function("phi")(time)
known = {
    sp.diff(angle, time, 2): w**2 * sp.sin(phi),
    sp.diff(angle, time): sp.sqrt(2 * w**2 * (sp.cos(phi_0) - sp.cos(phi))),
}


def second_derivative(place):
    """Second derivative of a place R f(phi) along the fall from rest."""
    return sp.diff(R * place(angle), time, 2).subs(known).subs(angle, phi)


units = {R: sp.Rational(3, 4) / w**2}  # g = 1
horizontal = second_derivative(lambda a: -sp.sin(a)).subs(units)
vertical = 1 + second_derivative(sp.cos).subs(units)
c, c_0 = sp.cos(phi), sp.cos(phi_0)
F_1 = sp.Rational(3, 4) * sp.sin(phi) * (2 * c_0 - 3 * c)
N_1 = 1 - sp.Rational(3, 4) * (sp.sin(phi) ** 2 + 2 * c * c_0 - 2 * c**2)
assert sp.expand(horizontal - F_1) == 0
assert sp.expand(vertical - N_1) == 0

# %% [markdown]
# At the release $\varphi = \varphi_0$, and the ratio of the two is
# $3\sin\varphi_0\cos\varphi_0/(4 - 3\sin^2\varphi_0)$. The less the block leans the more friction
# it needs; from hardly any rotation, $\varphi_0 \to \alpha$, it is, with $s = \sin\alpha$ and
# $c = \cos\alpha$,
#
# $$\mu_0 = \frac{3sc}{4-3s^2}. \tag{2}$$
#
# Now the landing. Before it the block turns about its right foot with $\omega$, after it with
# $e\,\omega$, $e = 1 - \tfrac32 s^2$, about its left foot. The centroid, at the height $h$ and the
# distance $b$ from either foot, loses $(1-e)\,\omega h$ of its horizontal velocity and gains
# $(1+e)\,\omega b$ upwards. The two impulses of the ground have the ratio
#
# $$\frac{h}{b}\,\frac{1-e}{1+e} = \frac{c}{s}\,\frac{\tfrac32 s^2}{2-\tfrac32 s^2}
#   = \frac{3sc}{4-3s^2}: \tag{3}$$
#
# the same number. A free pinned block, unless it is very stocky, needs $\mu_0$ at each landing and
# never more between them.

# %%
s_, c_ = sp.symbols("s c", positive=True)
e_13 = 1 - sp.Rational(3, 2) * s_**2
assert sp.cancel(c_ / s_ * (1 - e_13) / (1 + e_13) - 3 * s_ * c_ / (4 - 3 * s_**2)) == 0
released = 3 * sp.sin(phi_0) * c_0 / (4 - 3 * sp.sin(phi_0) ** 2)
at_release = F_1.subs(phi, phi_0) + N_1.subs(phi, phi_0) * released  # F acts to the left
assert sp.cancel(at_release) == 0


def landing_friction(alpha):
    """Equations (2) and (3)."""
    s, c = math.sin(alpha), math.cos(alpha)
    return 3 * s * c / (4 - 3 * s**2)


run = rk.simulate(pinned, still, initial={"theta": 0.2})
assert math.isclose(run.support.impact_friction_demand, landing_friction(alpha), rel_tol=1e-9)
assert math.isclose(run.support.friction_demand, landing_friction(alpha), rel_tol=1e-6)
FORCES = "horizontal_reaction", "right_reaction"
forces = run.at(np.linspace(0.0, 1.07, 50), names=["theta", *FORCES])
ratio = sp.lambdify((phi, phi_0), F_1 / N_1)(alpha - forces["theta"], alpha - 0.2)
across, up = (forces[name] for name in FORCES)
assert np.allclose(across / up, ratio, atol=1e-9)
print(
    f"needed by forces {run.support.friction_demand:.6f}, "
    f"by impulses {run.support.impact_friction_demand:.6f}"
)

# %% [markdown]
# These are the two numbers to look at in the response of any pinned structure:
# `run.support.friction_demand`, the largest ratio of the *forces*, and
# `run.support.impact_friction_demand`, that of the *impulses*. With more friction than both
# the pinned motion is exact. With less than either it is not, and we can say when it first fails.

# %%
demand = max(run.support.friction_demand, run.support.impact_friction_demand)
enough = rk.simulate(sliding(1.0001 * demand), still, initial={"theta": 0.2})
assert not any(event.kind == "slip begins" for event in enough.events)
times = np.linspace(0.0, 12.0, 200)
assert np.allclose(enough.at(times)["theta"], run.at(times)["theta"], atol=1e-9)
assert math.isclose(enough.events.rest_time, run.events.rest_time, rel_tol=1e-9)

lacking = rk.simulate(sliding(0.15), still, initial={"theta": 0.2})
first = next(event for event in lacking.events if event.kind == "slip begins")
(theta_1,) = run.at([first.time])["theta"]
assert math.isclose(float((F_1 / N_1).subs({phi: alpha - theta_1, phi_0: alpha - 0.2})), -0.15)
print(f"with 0.15 the {first.contact} foot slips from {first.time:.7f} s on: {first.mode_after}")

# %% [markdown]
# ## 3. From rest: which motion begins?
#
# The ground begins to accelerate with $a$ to the right, and perhaps upwards; let $g'$ be gravity
# and that together. In axes that move with the ground the block is pushed to the left by $ma$. Four
# answers are quickly tried.
#
# - **Rest** needs $F = ma \le \mu N = \mu m g'$, and both feet pressed: $a h \le g' b$.
# - **Slide**: $F = \mu m g'$ at both feet; both are pressed as long as $\mu h < b$.
# - **Rock** about the left foot: $\tfrac43 m(b^2+h^2)\,\ddot\psi = m(ah - g'b)$, where $\psi$ grows
#   as the block leans to the left. The ground gives $F = m(a - h\ddot\psi)$ and
#   $N = m(g' + b\ddot\psi)$, and friction must suffice for them: $F \le \mu N$.
# - **Slide-rock**: $F = \mu N$, the centroid moves with $\xi$ and $\psi$, and
#
# $$m(a + \ddot\xi) = \mu N, \qquad m(g' + b\ddot\psi) = N, \qquad
#   \tfrac13 m(b^2+h^2)\,\ddot\psi = (\mu h - b)\,N. \tag{4}$$

# %%
m, a, g, b_, h_, mu = sp.symbols("m a g' b h mu", positive=True)
psi, xi, N = sp.symbols("psi xi N", real=True)
inertia = m * (b_**2 + h_**2) / 3

rocking = m * (a * h_ - g * b_) / (4 * inertia)
mu_c = sp.factor(sp.cancel((a - h_ * rocking) / (g + b_ * rocking)))
equations = [
    m * (a + xi) - mu * N,
    m * (g + b_ * psi) - N,
    inertia * psi - (mu * h_ - b_) * N,
]
slide_rock = sp.solve(equations, [xi, psi, N])
foot_slips = slide_rock[xi] + h_ * slide_rock[psi]  # acceleration of the foot, to the right

printed = (a * (4 * b_**2 + h_**2) + 3 * g * b_ * h_) / (g * (4 * h_**2 + b_**2) + 3 * a * b_ * h_)
pressed = m * g * (b_**2 + h_**2) / (4 * b_**2 + h_**2 - 3 * mu * b_ * h_)
assert sp.cancel(mu_c - printed) == 0
assert sp.cancel(slide_rock[N] - pressed) == 0
assert sp.cancel(foot_slips.subs(mu, mu_c)) == 0  # where slide-rock ends, rocking begins
assert sp.cancel(mu_c.subs(a, g * b_ / h_) - b_ / h_) == 0
assert sp.limit(mu_c, a, sp.oo) == (4 * b_**2 + h_**2) / (3 * b_ * h_)

# %% [markdown]
# Rocking needs
#
# $$\mu \ge \mu_c = \frac{a\,(4b^2+h^2) + 3g'bh}{g'\,(4h^2+b^2) + 3abh}, \tag{5}$$
#
# which is $b/h$ for the weakest push that lifts a foot and rises with $a$. In slide-rock
#
# $$N = \frac{m g' R^2}{4b^2 + h^2 - 3\mu bh}, \qquad R^2 = b^2 + h^2. \tag{6}$$
#
# Mind the denominator of (6): as $\mu$ grows to $(4b^2+h^2)/(3bh)$, which is also the limit of
# $\mu_c$ for large $a$, the force grows over all bounds. We come back to it in Section 6.
#
# Does the engine agree? It does not know which motion follows which: it has the gap and the slip of
# each foot, and tries all modes.


# %%
friction_to_rock = sp.lambdify(a, mu_c.subs({b_: half_width, h_: half_height, g: gravity}))


def begins(friction, a):
    """The motion that begins, by (4) and (5)."""
    lifts = a > gravity * half_width / half_height
    if not lifts:
        return "rest" if a <= gravity * friction else "slide"
    if friction < half_width / half_height:
        return "slide"
    return "rock" if friction >= friction_to_rock(a) else "slide-rock"


MOTIONS = {
    "both": "rest", "both_slides_left": "slide", "left": "rock", "left_slides_left": "slide-rock",
}  # fmt: skip
rng = np.random.default_rng(5)
cases = np.column_stack([rng.uniform(0.0, 0.7, 150), rng.uniform(0.0, 10.0, 150)])
found = []
for friction, push in cases:
    pushed = rk.simulate(sliding(friction), rk.GroundMotion.constant(push, 1e-6))
    found.append(MOTIONS[pushed.mode[-1]])
    assert found[-1] == begins(friction, push)
assert set(found) == set(MOTIONS.values())

values = {m: 1.0, b_: half_width, h_: half_height, g: gravity, mu: 0.3, a: 8.0}
engine = sliding(0.3)
state = engine.accelerations({}, ground_acceleration=8.0, mode="left_slides_left")
assert math.isclose(state["theta"], -slide_rock[psi].subs(values))
reaction = engine.reactions({}, ground_acceleration=8.0, mode="left_slides_left")
assert math.isclose(reaction["left_reaction"], slide_rock[N].subs(values))

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(5.6, 3.8), layout="constrained")
slim = half_width / half_height
pushes = np.linspace(gravity * slim, 10.0, 60)
borders = friction_to_rock(pushes)
ax.plot([0, slim, 0.7], np.array([0, slim, slim]) * gravity, color=fb.INK, lw=1)
ax.plot([slim, slim], [gravity * slim, 10.0], color=fb.INK, lw=1)
ax.plot(borders, pushes, color=fb.INK, lw=1)
for motion, mark in zip(MOTIONS.values(), "so^D", strict=True):
    chosen = [name == motion for name in found]
    ax.plot(*cases[chosen].T, mark, ms=3.5, label=motion)
ax.annotate(r"$\mu_c(a)$", (borders[30], pushes[30]), (8, -8), textcoords="offset points")
ax.set(xlabel=r"friction $\mu$", ylabel="ground acceleration $a$ [m/s2]", xlim=(0, 0.7))
ax.set_ylim(0, 10)
ax.legend(loc="upper center", bbox_to_anchor=(0.5, 1.14), ncols=4)
plt.show()

# %% [markdown]
# *Figure 2. Motions that begin from rest. Lines: the borders derived above. Marks: the mode that
# the engine found, at random.*
#
# Below $\mu = b/h$ the block never rocks from rest: it slides, whatever the ground does. The band
# of slide-rock is narrow, and wide only for pushes that are many times stronger than what lifts a
# foot.

# %% [markdown]
# ## 4. The same block, with friction
#
# So much for the start. Now a pulse shakes the block: one sine with a period of 0.8 s, with 1.5
# times the acceleration that lifts it, and then with twice that. Under the weaker pulse the pinned
# block rocks and comes to rest, under the stronger one it falls. We give it feet that may slide,
# and turn the friction down.

# %%
slim = half_width / half_height  # b/h, which is tan(alpha)
frictions = np.concatenate([np.linspace(0.15, 0.25, 8), np.linspace(0.252, 0.35, 50)])


def swept(strength):
    """Response and friction demand of the pinned block, and the responses for all frictions."""
    pulse = rk.GroundMotion.single_sine(strength * gravity * slim, 0.8, duration=12.0)
    held = rk.simulate(pinned, pulse)
    demand = max(held.support.friction_demand, held.support.impact_friction_demand)
    exact = rk.simulate(sliding(1.001 * demand), pulse)
    before = np.linspace(0.0, 1.2, 50)  # the fall is no concern of the pins
    assert np.allclose(exact.at(before)["theta"], held.at(before)["theta"], atol=1e-9)
    return held, demand, [rk.simulate(sliding(friction), pulse) for friction in frictions]


def peaks_of(runs):
    """Largest rotations over alpha, a fall counted as 1, and which fell."""
    fell = np.array([run.outcome is rk.Outcome.OVERTURNED for run in runs])
    return np.where(fell, 1.0, [np.abs(run["theta"]).max() / alpha for run in runs]), fell


held, demand, runs = swept(1.5)
peaks, fell = peaks_of(runs)
assert held.outcome is rk.Outcome.CAME_TO_REST
assert not fell.any()
assert not peaks[frictions < slim].any()  # it slides, and stays upright
enough = frictions > demand
assert np.allclose(peaks[enough], np.abs(held["theta"]).max() / alpha, rtol=1e-3)
between = (frictions > slim) & (frictions < demand)
assert np.all(np.diff(peaks[between]) > 0)

falling, more, pushed = swept(2.0)
strong, fell = peaks_of(pushed)
assert falling.outcome is rk.Outcome.OVERTURNED
assert fell[frictions > more].all()
assert not strong[frictions < slim].any()
survives = (frictions > slim) & ~fell
assert survives.any()
print(f"b/h = {slim:.3f}; the pinned block asks for {demand:.3f}, then for {more:.3f},")
print(f"where it falls from a friction of {frictions[fell].min():.3f} on")

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, (rotations, slides) = plt.subplots(
    2, 1, figsize=(6.2, 4.6), sharex=True, layout="constrained"
)
for strength, values, responses, asked, color in [
    (1.5, peaks, runs, demand, fb.LINES[0]),
    (2.0, strong, pushed, more, fb.LINES[1]),
]:
    stands = values < 1.0
    slid = np.array([1e3 * np.abs(run["x"]).max() for run in responses])
    rotations.plot(frictions, values, "-", lw=0.8, color=color)
    rotations.plot(frictions[stands], values[stands], ".", color=color, label=f"{strength} g b/h")
    rotations.plot(frictions[~stands], values[~stands], "x", ms=4, color=color)
    slides.plot(frictions[stands], slid[stands], ".-", lw=0.8, color=color)
    for ax in (rotations, slides):
        ax.axvline(asked, color=color, ls=":")
for ax in (rotations, slides):
    ax.axvline(slim, color=fb.INK, ls=":")
rotations.annotate("$b/h$", (slim, 0.85), (-22, 0), textcoords="offset points")
rotations.set_ylabel(r"largest $|\theta|/\alpha$")
rotations.legend(loc="center left")
slides.set(xlabel=r"friction $\mu$", ylabel="the base's middle has\nmoved by at most [mm]")
plt.show()

# %% [markdown]
# *Figure 3. Two pulses, and the same block with other frictions; crosses: it falls. Left of $b/h$
# it slides. Right of what the pinned block asks for, the dotted lines, the pins are exact. In
# between it does both.*
#
# Three things can be read from Figure 3. Sliding is a fuse: with less friction than $b/h$ nothing
# rocks, at the price of some slip. More friction than the pinned block asks for changes nothing at
# all. And these two are close together, unless the push is very strong: what is in between is a
# small part of all blocks, but one of large changes. With a little slip the stronger pulse is
# survived.

# %% [markdown]
# ## 5. A landing with friction
#
# The block turns about its right foot with $\omega$, and its left foot lands. Newton's law of
# restitution says how fast that foot leaves, $e_n\,2b\omega$, and Coulomb's that the tangential
# impulse $P_t$ opposes the slip *after* the impact and is at most $\mu P_n$. The right foot is let
# go. With the velocity $(u, v)$ of the centroid and the rate $\omega'$ after it,
#
# $$m(u + \omega h) = P_t, \qquad m(v + \omega b) = P_n, \qquad
#   \tfrac13 m R^2(\omega' - \omega) = P_t h - P_n b, \qquad v - b\,\omega' = 2 e_n b\,\omega.
#   \tag{7}$$

# %%
u, v, rate_after, P_t, P_n = sp.symbols("u v omega' P_t P_n", real=True)
omega, e_n = sp.symbols("omega e_n", positive=True)
balance = [
    m * (u + omega * h_) - P_t,
    m * (v + omega * b_) - P_n,
    inertia * (rate_after - omega) - (P_t * h_ - P_n * b_),
    v - b_ * rate_after - 2 * e_n * b_ * omega,
]
unknown = [u, v, rate_after, P_t, P_n]
sticks = sp.solve([*balance, u + h_ * rate_after], unknown)  # the left foot does not slip after it
slips = sp.solve([*balance, P_t - mu * P_n], unknown)  # it slips to the left after it
half = sp.Symbol("t", positive=True)  # tan(alpha/2), which makes the sine and cosine rational
circle = {s_: 2 * half / (1 + half**2), c_: (1 - half**2) / (1 + half**2)}


def on_circle(expr):
    """b and h are s and c, times R, which cancels."""
    return sp.cancel(expr.subs({b_: s_, h_: c_}).subs(circle))


ratio_sticking = 1 - sp.Rational(3, 2) * (1 + e_n) * s_**2
lever = 3 * s_ * (s_ - mu * c_)
ratio_slipping = (1 - 3 * (1 + 2 * e_n) * s_ * (s_ - mu * c_)) / (1 + lever)
needed = 3 * s_ * c_ / (4 - 3 * s_**2)
assert on_circle(sticks[rate_after] / omega - ratio_sticking) == 0
assert on_circle(slips[rate_after] / omega - ratio_slipping) == 0
assert on_circle(sticks[P_t] / sticks[P_n] - needed) == 0  # whatever e_n is

# %% [markdown]
# The foot sticks where $\mu \ge \mu_0$ of (3), *whatever* $e_n$ is, and then
#
# $$\frac{\omega'}{\omega} = 1 - \tfrac32(1+e_n)\,s^2; \qquad\text{else}\qquad
#   \frac{\omega'}{\omega} = \frac{1 - 3(1+2e_n)\,s\,(s-\mu c)}{1 + 3s\,(s-\mu c)}. \tag{8}$$
#
# For $e_n = 0$ and a foot that sticks this is Housner's ratio. With less friction the block loses
# *more* of its rotation: in (7) it is the friction at the landing foot that turns the block on.


# %%
def landed(friction, restitution):
    """Rate after over rate before, of a landing in the engine."""
    start = {"theta": 1e-10, "theta_dot": -0.5}  # just above the ground, the right foot at rest
    run = rk.simulate(sliding(friction, restitution), still, initial=start, duration=1e-6)
    (impact,) = run.impacts
    return impact.after["theta_dot"] / impact.before["theta_dot"]


if_it_sticks, if_it_slips = (
    sp.lambdify((s_, c_, mu, e_n), form) for form in (ratio_sticking, ratio_slipping)
)


def by_hand(friction, restitution):
    """Equation (8)."""
    sticks = friction >= landing_friction(alpha)
    values = math.sin(alpha), math.cos(alpha), friction, restitution
    return (if_it_sticks if sticks else if_it_slips)(*values)


rough = np.linspace(0.0, 0.4, 17)
ratios = {e: [landed(friction, e) for friction in rough] for e in (0.0, 0.3, 0.6)}
for e, column in ratios.items():
    assert np.allclose(column, [by_hand(friction, e) for friction in rough], rtol=1e-6)
for slenderness, value in [(0.15, 0.11271), (0.25, 0.18843), (0.40, 0.30353)]:
    assert round(landing_friction(slenderness), 5) == value

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(5.4, 3.4), layout="constrained")
fine = np.linspace(0.0, 0.4, 81)
for e, column in ratios.items():
    (line,) = ax.plot(fine, [by_hand(friction, e) for friction in fine], lw=1)
    ax.plot(rough, column, "o", ms=3.5, color=line.get_color(), label=f"$e_n = {e}$")
ax.axvline(landing_friction(alpha), color=fb.FORCE, ls=":")
ax.annotate(
    r"$\mu_0$", (landing_friction(alpha), 0.55), (4, 0), textcoords="offset points", color=fb.FORCE
)
ax.set(xlabel=r"friction $\mu$", ylabel=r"$\omega'/\omega$")
ax.legend()
plt.show()

# %% [markdown]
# *Figure 4. The angular velocity after a landing over that before. Lines: equation (8). Marks: the
# engine. Right of $\mu_0$ the landing foot sticks.*
#
# **An error of the law.** Newton's coefficient of restitution concerns the normal velocity alone.
# Where friction turns the slip round during the impact, this may be more than the energy allows. A
# cube in flight that turns, and lands on one corner:

# %%
cube = rk.SlidingBlock(half_width=0.4, half_height=0.4, friction=0.6, restitution=0.9)
lean, drift, fall, spin = -0.1, -0.12, -0.3, -1.5  # rad, m/s, m/s of the centroid, rad/s
down = np.array([-0.4 * math.sin(lean), -0.4 * math.cos(lean)])  # from the centroid to the base
start = {
    "theta": lean, "theta_dot": spin, "y": -0.4 * math.sin(lean) + 1e-9, "x": 0.0,
    "x_dot": drift + spin * down[1], "y_dot": fall - spin * down[0],
}  # fmt: skip
dropped = rk.simulate(cube, still, initial=start, duration=1e-6)
(impact,) = dropped.impacts


def kinetic(values):
    return cube.energies(values, mode="flight")["kinetic_energy"]


gain = kinetic(impact.after) / kinetic(impact.before)

# by hand: impulses at the corner, of a cube of mass 1
corner = fb.turned([(-0.4, -0.4)], (0, 0), lean)[0]
along = np.array([1.0, 0.0, corner[1]]), np.array([0.0, 1.0, -corner[0]])  # slip, gap: rows
inverse = np.diag([1.0, 1.0, 3 / (0.4**2 + 0.4**2)])
rows = np.array(along)
arriving = np.array([drift, fall, spin])
slip, gap = rows @ arriving
assert gap < 0
pushes = np.linalg.solve(rows @ inverse @ rows.T, [-slip, -1.9 * gap])  # the corner sticks
assert abs(pushes[0]) < 0.6 * pushes[1]
after = arriving + inverse @ rows.T @ pushes
weights = np.diag(np.linalg.inv(inverse))
assert math.isclose(gain, weights @ after**2 / (weights @ arriving**2), rel_tol=1e-6)
assert gain > 1.2
assert math.isclose(dropped.impacts.energy_gains[0], (1 - 1 / gain) * kinetic(impact.after))
print(f"kinetic energy after / before: {gain:.3f}")

# %% [markdown]
# No real impact does this. It is the price of a law with two numbers. It cannot happen with
# $e_n = 0$; where it happens the summary of the response says so. Then another law is wanted: one
# that follows slip and force *through* the impact (Routh). [Which impact law?](which_impact_law.py)
# compares them.
#
# ## 6. Bounces, and no solution
#
# Drop the block flat. Both corners land together, and must be solved together: one after the other
# they would spin it. It leaves with $e_n$ times its speed, again and again, $e_n^k$ times after $k$
# landings; the flights last $2v e_n^k/g$, and their sum is finite:
#
# $$t_\infty - t_1 = \frac{2v}{g}\,(e_n + e_n^2 + \dots) = \frac{2v}{g}\,\frac{e_n}{1-e_n}.
#   \tag{9}$$
#
# Where it moves sideways it slides in the landing; friction at the base turns it forwards, and the
# leading corner takes more: $P_R/P_L = (1 + \mu h/b)/(1 - \mu h/b)$, as long as $\mu h < b$.

# %%
height, e = 0.1, 0.6
dropped = rk.simulate(sliding(0.2, e), still, initial={"y": height, "x_dot": 1.5}, duration=2.0)
speed = math.sqrt(2 * gravity * height)
landing = dropped.impacts[0]
assert math.isclose(landing.time, speed / gravity, rel_tol=1e-9)
assert landing.contact == "left+right"
bouncing = dropped.events.rest_time - landing.time
assert math.isclose(bouncing, 2 * speed / gravity * e / (1 - e), rel_tol=1e-9)
assert np.abs(dropped["theta"]).max() < 1e-12
lost = landing.before["x_dot"] - landing.after["x_dot"]
assert math.isclose(lost, 0.2 * (1 + e) * speed, rel_tol=1e-9)  # mu P_n/m, as long as it slides

P_L, P_R = sp.symbols("P_L P_R")
no_rotation = sp.solve(
    [(P_R - P_L) * b_ - mu * (P_L + P_R) * h_, P_L + P_R - m], [P_L, P_R]
)  # about the centroid
shares = (1 + mu * h_ / b_) / (1 - mu * h_ / b_)
assert sp.cancel(no_rotation[P_R] / no_rotation[P_L] - shares) == 0

figure, ax = plt.subplots(figsize=(6.0, 2.8), layout="constrained")
ax.plot(dropped.t, 1e3 * dropped["y"])
ax.axvline(dropped.events.rest_time, ls=":", color=fb.FORCE)
ax.annotate(
    r"$t_\infty$",
    (dropped.events.rest_time, 80),
    (4, 0),
    textcoords="offset points",
    color=fb.FORCE,
)
ax.set(xlabel="time [s]", ylabel="height of the base [mm]", xlim=(0, 1.0))
plt.show()

# %% [markdown]
# *Figure 5. A flat drop from 0.1 m with $e_n = 0.6$: infinitely many bounces end in a finite
# time.*
#
# And the pole of (6)? A block slides to the right with $\mu > (4b^2 + h^2)/(3bh)$. Friction on its
# right corner turns it forwards and presses that corner down, and the more it is pressed the more
# friction there is. At the place $(r_x, r_y)$ from the centroid, with the force $N$ and the
# friction $-\mu N$, the corner has the acceleration upwards
#
# $$\ddot y = A\,N + \beta, \qquad A = \frac1m + \frac{r_x\,(r_x + \mu r_y)}{I}, \qquad
#   \beta = -g - \dot\theta^2 r_y. \tag{10}$$
#
# On the ground $\ddot y = 0$ with $N \ge 0$, or $\ddot y \ge 0$ with $N = 0$. While $A > 0$ there
# is just one of the two. But $r_y < 0$: with enough friction $A < 0$, and then slow blocks,
# $\beta < 0$, have *none*, and fast ones, $\beta > 0$, have *both*. Rigid bodies with Coulomb's
# friction have this property (Painlevé 1895), and the engine reports it instead of inventing a
# motion.


# %%
def corner_of(block, theta, theta_dot):
    """A (times the mass) and beta of (10), of the right corner."""
    b, h = block.half_width, block.half_height
    ((r_x, r_y),) = fb.turned([(b, -h)], (0, 0), theta)
    return 1 + 3 * r_x * (r_x + block.friction * r_y) / (b**2 + h**2), -gravity - theta_dot**2 * r_y


bound = (4 * half_width**2 + half_height**2) / (3 * half_width * half_height)
for friction, outcome in [(1.01 * bound, "no solution"), (0.99 * bound, "completed")]:
    thrown = rk.simulate(sliding(friction), still, initial={"x_dot": 0.2}, duration=0.01)
    A, beta = corner_of(sliding(friction), 0.0, 0.0)
    assert (A < 0) == (friction > bound)
    assert beta < 0
    assert str(thrown.outcome) == outcome

stocky = rk.SlidingBlock(half_width=0.5, half_height=1.0, friction=1.5, restitution=0.0)
spins = {"theta": 0.1, "theta_dot": 4.0, "x_dot": 8.0}
A, beta = corner_of(stocky, 0.1, 4.0)
assert A < 0 < beta
assert str(rk.simulate(stocky, still, initial=spins).outcome) == "several solutions"
print(f"for the block of this notebook from mu = {bound:.2f} on")
print(rk.Outcome.NO_SOLUTION.sentence, rk.Outcome.SEVERAL_SOLUTIONS.sentence, sep="\n")

# %% [markdown]
# ## 7. When does it matter?
#
# - Compare $\mu$ with `friction_demand` *and* `impact_friction_demand` of the pinned response.
#   Above both, the pinned motion is the motion.
# - Below $b/h$ a block at rest slides and does not rock. A pinned model of it is wrong from the
#   start, and on the side of caution for rotations, but silent on the slip.
# - In between, one slip moves everything that follows. Near overturning that decides.
# - Slender blocks ask for little: about $\tfrac34\alpha$ when free. Stocky ones, strong pushes and
#   upward accelerations that take the weight away ask for much.
#
# ## Exercises
#
# 1. **How little is enough?** Show that (2) is $\tfrac34\alpha$ for slender blocks, and largest at
#    $\tan\alpha = 2$. *Hint: divide by $\cos^2\alpha$; `landing_friction(math.atan(2.0))` is 0.75.*
# 2. **Vertical shaking.** How do the borders of Figure 2 move if the ground also accelerates
#    downwards with $0.3\,g$? Check with `vertical=` of `rk.simulate`. *Hint: only $g'$ changes, and
#    $a/g'$ is all that matters.*
# 3. **Ice.** What is $\omega'/\omega$ for $\mu = 0$, $e_n = 0$, and what of the block does not
#    change its horizontal velocity? When does the block stop turning at a landing? *Hint: (8) with
#    $3s^2 = 1$; `landed(0.0, 0.0)` is 0.690 here.*
# 4. **How far?** A flat block slides from the speed $v$ to rest. How far, and when? Check with
#    `initial={"x_dot": 0.5}` and $\mu = 0.2$. *Hint: $v^2/(2\mu g)$ is 63.7 mm.*
# 5. **Stop and go.** Under a sine of amplitude $A$ the block on $\mu g < A$ sticks in every half
#    cycle if and only if $A/(\mu g) < \sqrt{1 + \pi^2/4}$. Derive it. *Hint: it begins to slip at
#    $\sin\omega t = \mu g/A$; its velocity must be back at zero before the next such instant.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Divided by $\cos^2\alpha$, with $\tau = \tan\alpha$, (2) is $3\tau/(4+\tau^2)$. For small $\tau$
# it is $\tfrac34\tau$. Its derivative vanishes at $\tau = 2$, where it is $\tfrac34$: on a friction
# of 0.75 no block that is let go from rest slides.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# $g' = 0.7\,g$. All borders are functions of $\mu$ and $a/g'$, so that Figure 2 shrinks to 0.7 of
# its height: it takes 30 % less push for everything.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $\omega'/\omega = (1-3s^2)/(1+3s^2)$. Without friction nothing pushes the block sideways: its
# centroid keeps its horizontal velocity. It stops turning at $3s^2 = 1$, $\alpha = 35.3°$, and a
# stockier one keeps both feet down.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# Friction brakes with $\mu g$: $v^2/(2\mu g) = 63.7$ mm in $v/(\mu g) = 0.255$ s. The mass drops
# out.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# It begins to slip at $\sin\varphi_1 = \mu g/A$. From there its velocity over the ground is, to the
# left, $\frac A\omega(\cos\varphi_1 - \cos\omega t) - \mu g\,(t - t_1)$. Half a cycle later that is
# $\frac1\omega(2A\cos\varphi_1 - \pi\mu g)$. The block has stuck in between if this is negative:
# $2\cos\varphi_1 < \pi\sin\varphi_1$, that is $1/\sin^2\varphi_1 < 1 + \pi^2/4$.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
assert math.isclose(landing_friction(math.atan(2.0)), 0.75)
assert math.isclose(landing_friction(1e-4), 0.75e-4, rel_tol=1e-6)
assert round(landed(0.0, 0.0), 3) == 0.690
for friction, push in cases[:8]:
    lighter = rk.simulate(
        sliding(friction),
        rk.GroundMotion.constant(0.7 * push, 1e-6),
        vertical=rk.GroundMotion.constant(-0.3 * gravity, 1e-6),
    )
    assert MOTIONS[lighter.mode[-1]] == begins(friction, push)
slides = rk.simulate(sliding(0.2), still, initial={"x_dot": 0.5}, duration=1.0)
assert math.isclose(slides.final["x"], 0.5**2 / (2 * 0.2 * gravity), rel_tol=1e-9)
assert round(1e3 * slides.final["x"], 1) == 63.7
factor = math.sqrt(1 + math.pi**2 / 4)
for strength, sticks_at_all in [(0.99 * factor, True), (1.01 * factor, False)]:
    sine = rk.GroundMotion.harmonic(0.2 * gravity * strength, frequency=1.0, duration=20.0)
    late = [event for event in rk.simulate(sliding(0.2), sine).events if event.time > 15.0]
    assert any(event.mode_after == "both" for event in late) == sticks_at_all
flat = rk.simulate(
    sliding(0.0, alpha=0.7), still, initial={"theta": 1e-10, "theta_dot": -0.5}, duration=1e-6
)
assert flat.impacts[0].after["theta_dot"] == 0.0
exercises = Exercises({2: 0.7, 3: landed(0.0, 0.0), 4: slides.final["x"]})

# %%
# your answers
exercises.check(2, ...)  # factor of all borders
exercises.check(3, ...)  # angular velocity after over before, for this block
exercises.check(4, ...)  # in metres
