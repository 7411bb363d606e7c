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
#     minutes: 60
# ---

# %% [markdown]
# # Which impact law?
#
# A stocky block rocks about its right corner and lands on its left one. For an instant *both*
# corners touch, and rigid mechanics does not say how they share the impulse. Newton's law answers
# that the block turns back the way it came. Blocks do not do that: they go on to rock over the
# corner on which they landed. This notebook puts springs under the corners, follows them through
# the impact, and then asks each law the same questions.
#
# ## Aims
#
# After this notebook you can
#
# 1. say why a block that lands on its second corner keeps its sense of rotation;
# 2. follow an impact on several points in the time that springs take, and in the impulse;
# 3. give the condition under which each law cannot gain energy, and an example where it does;
# 4. choose a law for a contact.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.teaching import Exercises

use_style()

# %% [markdown]
# ## 1. The landing
#
# A rectangle of half-width $b$ and half-height $h$, mass $m$, $I = \tfrac13 m(b^2+h^2)$, on smooth
# ground, has turned about its right corner, the old one. Its left corner, the new one, arrives with
# $2b\,|\omega|$. Let $u$ be the rates of both gaps, positive where a gap opens, and $P \ge 0$ the
# normal impulses. The mass centre is at the horizontal distance $b$ from each corner, so that
#
# $$u^+ = u^- + G P, \qquad
#   G = \begin{pmatrix} a & c\\ c & a\end{pmatrix}, \qquad
#   a = \frac1m + \frac{b^2}{I}, \quad c = \frac1m - \frac{b^2}{I}. \tag{1}$$
#
# An impulse at one corner *lifts* the other one where $c > 0$, and *presses* it where $c < 0$, that
# is for $h^2 < 2b^2$. Our block, $h = b/2$, is of the second kind.
#
# **Predict**, before you read on: what does the block do after the landing? Does it turn back,
# stop, or go on?
#
# Newton's law for both corners at once: a corner that takes an impulse leaves with $e$ times the
# speed of its arrival. The old corner has no speed, and it is pressed; so it stays, and the new one
# leaves with $e\,2b|\omega|$: the block turns back about its old corner, $\omega^+ = -e\,\omega$.

# %%
m, b, h = 1.0, 0.5, 0.25  # kg, m, m
inertia = m * (b**2 + h**2) / 3
e, omega = 0.8, -4.1307601  # -, rad/s: counterclockwise, towards the left corner

G = np.array([[1 / m + b**2 / inertia, 1 / m - b**2 / inertia]] * 2)
G[1] = G[1, ::-1]  # new corner first
arrives = np.array([2 * b * omega, 0.0])


def rotation(u):
    """Angular velocity of rates of the gaps: new corner left, clockwise positive."""
    return (u[0] - u[1]) / (2 * b)


newton = -e * arrives  # u+, with P >= 0 at both
impulses = np.linalg.solve(G, newton - arrives)
assert (impulses > 0).all()
assert math.isclose(rotation(newton), -e * omega)
print(f"Newton: omega goes from {omega:.3f} to {rotation(newton):+.3f} rad/s")

# one corner after the other, each as if it were alone
u = arrives.copy()
for corner in (0, 1):
    u = u - (1 + e) * u[corner] / G[corner, corner] * G[:, corner]
pairwise = u
assert (pairwise > 0).all()
print(f"one after the other: {rotation(pairwise):+.3f} rad/s, both corners up")

# %% [markdown]
# The two answers have different *signs*. Poisson's law (impulses of compression, then $e$ times as
# much) and Moreau's agree with Newton's here: all of them solve for both corners at once. So the
# question is the time at which impulses act, and rigid bodies know of none.
#
# ## 2. Springs in time
#
# Give each corner a linear spring of stiffness $k_i$, so stiff that nothing else moves meanwhile.
# Restitution: while a spring extends, its force falls along $k_i/e^2$, so that it gives $e^2$ of
# its energy back (Stronge's energetic restitution). For the forces $F = \dot P$ and the rates $u$
#
# $$\dot u = G F, \qquad
#   \dot F_i = \begin{cases} -k_i\,u_i & u_i < 0\\ -(k_i/e^2)\,u_i & u_i > 0,\ F_i > 0\\
#   0 & u_i > 0,\ F_i = 0.\end{cases} \tag{2}$$
#
# Times scale with $1/\sqrt{k}$, impulses do not: only the *ratio* of the stiffnesses matters, and
# that is left when the springs become rigid. Divided by each other the two rows are a law between
# impulses, $dP_1/dP_2 = \sqrt{k_1E_1/(k_2E_2)}$ with the energies $E_i = F_i^2/(2k_i)$: the law of
# Liu, Zhao and Brogliato (2008).
#
# **Predict**: the old corner has no speed, its spring no force. Does it take part at all?


# %%
def through_springs(G, u, k, e, until=1e6, max_step=np.inf):
    """Times, rates and forces through an impact, equation (2), restarted where a branch changes."""
    n = len(u)
    k, e = np.broadcast_to(k, n), np.broadcast_to(e, n)
    x, t = np.concatenate([u, np.zeros(n)]), 0.0
    times, states = [0.0], [x]

    def branch(u, force):
        return np.where(u < 0, -k, np.where(force > 0, -k / e**2, 0.0))

    while t < until:
        begins = x[:n] + 1e-9 * (G @ x[n:] - 1e-9 * G @ (k * np.minimum(x[:n], 0.0)))
        slope = branch(np.where(x[:n] == 0, begins, x[:n]), x[n:])

        def rates(t, x, slope=slope):
            return np.concatenate([G @ x[n:], slope * x[:n]])

        def ends(i, sign):
            def quantity(t, state):
                return sign * state[i]

            quantity.terminal, quantity.direction = True, -1
            return quantity

        watched = [(i, 1.0 if begins[i] > 0 else -1.0) for i in range(n)]
        watched += [(n + i, 1.0) for i in range(n) if x[n + i] > 0]
        run = solve_ivp(
            rates, (t, until), x, "DOP853", events=[ends(*of) for of in watched],
            rtol=1e-11, atol=1e-13, max_step=max_step,
        )  # fmt: skip
        t, x = run.t[-1], run.y[:, -1].copy()
        times.extend(run.t[1:])
        states.extend(run.y.T[1:])
        for (i, _), at in zip(watched, run.t_events, strict=True):
            if len(at):
                x[i] = 0.0
        if (x[n:] == 0).all() and (x[:n] >= 0).all():
            break
    states = np.array(states)
    return np.array(times), states[:, :n], states[:, n:]


times, rates, forces = through_springs(G, arrives, 1.0, e, max_step=0.02)
springs = rates[-1]
assert (springs > 1.6).all()
assert math.isclose(rotation(springs), -0.4970557, abs_tol=1e-6)
print(f"equal springs: {rotation(springs):+.5f} rad/s, both corners up")

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, (block, pushes, speeds) = plt.subplots(
    1, 3, figsize=(9.0, 3.0), layout="constrained", width_ratios=(1.15, 1, 1)
)
fb.ground(block, -0.95, 0.95, depth=0.06)
fb.body(block, [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h)])
fb.centroid(block, (0, h))
for x, label in ((-b, "new "), (b, " old")):
    block.annotate(label, (x, 0.06), ha="right" if x < 0 else "left", fontsize=9)
lengths = {"Newton": newton, "one by one": pairwise, "springs": springs}
for row, (name, u) in enumerate(lengths.items()):
    level, color = -0.62 - 0.42 * row, fb.LINES[row]
    block.annotate(name, (0, level + 0.04), ha="center", fontsize=9, color=color)
    block.plot([-b, b], [level, level], color="0.8", lw=0.8)
    for x, value in zip((-b, b), u, strict=True):
        if value > 1e-9:
            fb.arrow(block, (x, level), (x, level + 0.11 * value), color=color)
        else:
            block.plot([x], [level], "o", ms=4, color=color)
fb.bare(block)
block.set(xlim=(-1.0, 1.0), ylim=(-1.6, 0.6), title="corners after the landing")
for i, name in enumerate(("new corner", "old corner")):
    pushes.plot(times, forces[:, i], color=fb.LINES[i + 1], label=name)
    speeds.plot(times, rates[:, i], color=fb.LINES[i + 1], label=name)
pushes.set(xlabel="time", ylabel="force", title="springs")
speeds.set(xlabel="time", ylabel="rate of the gap [m/s]", title="gaps")
speeds.axhline(0, color="0.8", lw=0.8)
pushes.legend()
plt.show()

# %% [markdown]
# *Figure 1. Left: velocities of both corners after the landing by three laws; a dot stays on the
# ground. Middle and right: springs of equal stiffness. The old corner is pressed by the impulse at
# the new one, later than that, and gives its energy back when the new one has left.*
#
# It does. The force at the new corner presses the old one, $\ddot u_2 = c\dot F_1 < 0$, whose
# force grows like $t^3$ while that of the new corner grows like $t$. Mind the law between
# impulses: at the start $E_2 = 0$, and $dP_2/dP_1 = 0$ solves it *too*, for ever. That false
# branch is one corner after the other, $-1.414$ rad/s; the true one carries load.
#
# So this is why the block keeps its sense of rotation. The old corner is not a hinge. It yields
# while it is pressed, and pushes back late. When it does, the new corner has already its impulse,
# and the old one's works *against* the reversal.
#
# ### The ratio of the stiffnesses

# %%
ratios = np.logspace(-3, 3, 25)  # old over new
after = np.array([through_springs(G, arrives, [1.0, r], e)[1][-1] for r in ratios])
turned = rotation(after.T)
assert math.isclose(turned[0], rotation(pairwise), abs_tol=0.01)
assert math.isclose(turned[-1], -e * omega, abs_tol=0.15)
border = np.interp(0.0, turned, ratios)
print(f"the block turns back where the old corner is more than {border:.1f} times as stiff")
assert 1.0 < border < 10.0

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(5.6, 3.4), layout="constrained")
ax.semilogx(ratios, turned, ".-", color=fb.LINES[0])
for value, name in ((-e * omega, "Newton, Poisson, Moreau"), (rotation(pairwise), "one by one")):
    ax.axhline(value, color=fb.FORCE, ls=":")
    ax.annotate(name, (1.3e-3, value), (0, 4), textcoords="offset points", color=fb.FORCE)
ax.axhline(0, color="0.8", lw=0.8)
ax.plot([1.0], [rotation(springs)], "o", color=fb.MOTION)
ax.annotate("equal springs", (1.0, rotation(springs)), (8, -10), textcoords="offset points")
ax.set(xlabel="stiffness of the old corner over that of the new", ylabel="$\\omega^+$ [rad/s]")
ax.set_ylim(-2.2, 4.2)
plt.show()

# %% [markdown]
# *Figure 2. The angular velocity after the landing, $-4.13$ rad/s before it. Below zero the block
# keeps its sense of rotation.*
#
# Both rigid answers are limits: a soft old corner is loaded when the new one has left, a stiff one
# is a hinge. Two equal corners of one block are alike, and there is no reason for either limit.
#
# ### The same in the package
#
# The law is chosen with the contact, `rk.Sliding(law=)` or `Rigid(law=)`. In the package *springs*
# is `"lzb"`, *one by one* is `"pairwise"`.


# %%
def landed(law, friction=0.0, restitution=e, b=b, h=h, omega=omega):
    """Angular velocity after over that before, in the engine: the block leans by 1e-6 rad."""
    block = rk.structure(
        rk.derive("sliding_block", law=law), half_width=b, height=h, mass=m,
        inertia=m * (b**2 + h**2) / 3, friction=friction, restitution=restitution,
    )  # fmt: skip
    start = {"theta": 1e-6, "theta_dot": omega}
    run = rk.simulate(block, rk.GroundMotion.none(1e-5), initial=start)
    impact = run.impacts[0]
    return impact.after["theta_dot"] / impact.before["theta_dot"]


by_law = {law: landed(law) for law in ("newton", "pairwise", "lzb")}
for law, by_hand in (("newton", newton), ("pairwise", pairwise), ("lzb", springs)):
    assert math.isclose(by_law[law], rotation(by_hand) / omega, rel_tol=1e-6)
    print(f"{law:10s}{by_law[law] * omega:+.5f} rad/s")

# %% [markdown]
# ## 3. Feet that stick: Housner's ratio, or rest
#
# Now rough ground: the corners do not slip, and $e = 0$. The friction at a corner turns the block,
# too; in (1) $I$ becomes $I + mh^2$, and
#
# $$c = \frac1m - \frac{b^2}{I + mh^2} > 0 \quad\Leftrightarrow\quad I + mh^2 > mb^2
#   \quad\Leftrightarrow\quad \frac hb > \frac1{\sqrt2}\ \text{(rectangle)}. \tag{3}$$
#
# Where $c > 0$ the impulse at the new foot *lifts* the old one. Nothing presses it, no law gives it
# an impulse, and all agree on an impact of the new foot alone: Housner's ratio
# $(I + m(h^2-b^2))/(I + m(h^2+b^2))$. Where $c < 0$ both feet are pressed until both are at rest.
# The question of this notebook is one of stocky blocks, or of smooth ground, or of more than two
# points.

# %%
mass, width, height, moment = sp.symbols("m b h I", positive=True)
stuck = moment + mass * height**2
a_, c_ = 1 / mass + width**2 / stuck, 1 / mass - width**2 / stuck
speed = sp.Symbol("omega")
u_new = 2 * width * speed  # arrives, downwards for omega < 0
P = -u_new / a_  # the new foot stops
left = (0 - (0 + c_ * P)) / (2 * width) / speed
housner = (moment + mass * (height**2 - width**2)) / (moment + mass * (height**2 + width**2))
assert sp.simplify(left - housner) == 0
slim = sp.solve(c_.subs(moment, mass * (width**2 + height**2) / 3), height)
assert slim == [width / sp.sqrt(2)]

for slender in (4.0, 0.72):
    ratio = float(housner.subs({mass: 1, width: 1, height: slender, moment: (1 + slender**2) / 3}))
    for law in ("newton", "lzb"):
        found = landed(law, friction=5.0, restitution=0.0, b=1.0, h=slender, omega=-0.1)
        assert math.isclose(found, ratio, rel_tol=1e-9)
for law in ("newton", "lzb"):
    assert abs(landed(law, friction=5.0, restitution=0.0, b=1.0, h=0.69, omega=-0.1)) < 1e-9

# %% [markdown]
# ## 4. Energy
#
# The work of impulses $p$, normal ones and friction, that act together is
# $\tfrac12\,p\cdot(w^- + w^+)$, $w = (u, s)$ with the slips $s$ (Kelvin).
#
# - **Springs, and one by one.** Each spring gives $e^2$ of what it took, and friction opposes the
#   slip of *each moment*. No term is positive: they never gain, whatever $e_i$, $\mu_i$, $k_i$.
# - **Newton, without friction.** $u_i^+ = -e_iu_i^-$ where $P_i > 0$:
#   $\Delta T = \tfrac12\sum P_i\,(1-e_i)\,u_i^- \le 0$. Never.
# - **Newton, with friction** opposed to the slip *after* the impact. The slip before it may have
#   been the other way, and then friction has worked *with* it. For one contact, with $G =
#   \begin{pmatrix} G_{nn} & G_{nt}\\ G_{nt} & G_{tt}\end{pmatrix}$, no gain is possible for
#
# $$e^2 \le 1 - \frac{G_{nt}^2}{G_{nn}G_{tt}}, \tag{4}$$
#
#   and beyond it there can be one (Exercise 3).
# - **Moreau.** Friction opposes $s^+ + e\,s^-$. With one $e$ for all contacts it never gains; with
#   unequal ones and friction it can.
# - **Poisson.** Never without friction, nor at one contact. With friction at several contacts it
#   can.
#
# **Predict**: Kane's double pendulum (1984). Two rods of 1 m and 1 kg, 20 and 30 degrees from the
# vertical, swing at $-0.1$ and $-0.2$ rad/s; the tip meets rough ground, $e = \mu = 0.5$. How
# much of the energy is left?

# %%
first, second = math.radians(20), math.radians(30)
M = np.array([[4 / 3, math.cos(first - second) / 2], [math.cos(first - second) / 2, 1 / 3]])
J = np.array([[math.sin(first), math.sin(second)], [math.cos(first), math.cos(second)]])
swing = np.array([-0.1, -0.2])  # rad/s
D = J @ np.linalg.solve(M, J.T)
(u_0, s_0), mu = J @ swing, 0.5
assert u_0 < 0
assert s_0 < 0  # it arrives, and slips to the left


def energy(p):
    """Kinetic energy after impulses (P, Q) over that before."""
    after = swing + np.linalg.solve(M, J.T @ p)
    return (after @ M @ after) / (swing @ M @ swing)


def path(P):
    """(u, s, Q) after a normal impulse P: friction against the slip of the moment (Routh)."""
    slides = D[:, 0] + mu * D[:, 1]  # to the left: friction pushes to the right
    stops = -s_0 / slides[1]
    here = np.minimum(P, stops)
    pull = -D[1, 0] / D[1, 1]  # friction that lets it stick
    assert slides[1] > 0
    assert abs(pull) > mu  # more than there is: the slip turns round
    turned = D[:, 0] - mu * D[:, 1]
    beyond = np.maximum(P - stops, 0.0)
    return (
        u_0 + slides[0] * here + turned[0] * beyond,
        s_0 + slides[1] * here + turned[1] * beyond,
        mu * (here - beyond),
    )


ends = np.linspace(0.0, 3.0, 300001)
u_path, s_path, Q_path = path(ends)
work = np.concatenate([[0.0], np.cumsum((u_path[1:] + u_path[:-1]) / 2 * np.diff(ends))])
compressed = int(np.argmax(u_path >= 0))
newtons = np.linalg.solve(D, [-1.5 * u_0, -s_0])  # u+ = -u_0/2, and the tip sticks
assert abs(newtons[1]) < mu * newtons[0]  # friction suffices for that
energetic = compressed + int(np.argmax(work[compressed:] >= 0.75 * work[compressed]))
poisson = int(np.searchsorted(ends, 1.5 * ends[compressed]))
left_over = {
    "Newton": energy(newtons),
    "Poisson": energy([ends[poisson], Q_path[poisson]]),
    "energetic": energy([ends[energetic], Q_path[energetic]]),
}
assert left_over["Newton"] > 1.58
assert max(left_over["Poisson"], left_over["energetic"]) < 0.6
for name, ratio in left_over.items():
    print(f"{name:10s} energy after / before: {ratio:.3f}")

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(5.4, 3.6), layout="constrained")
shown = slice(0, int(1.5 * poisson))
ax.plot(s_path[shown], u_path[shown], color=fb.LINES[0])
ax.axhline(0, color="0.8", lw=0.8)
ax.axvline(0, color="0.8", lw=0.8)
ax.plot([s_0], [u_0], "o", color=fb.INK)
ax.annotate("arrives", (s_0, u_0), (6, -4), textcoords="offset points")
for i, name, place in (
    (compressed, "greatest compression", (8, -12)),
    (poisson, "Poisson", (8, 4)),
    (energetic, "energetic", (-58, -1)),
):
    ax.plot([s_path[i]], [u_path[i]], "o", ms=5, color=fb.LINES[1])
    ax.annotate(name, (s_path[i], u_path[i]), place, textcoords="offset points")
ax.plot([0.0], [-0.5 * u_0], "x", color=fb.FORCE)
ax.annotate("Newton", (0.0, -0.5 * u_0), (-12, 7), textcoords="offset points", color=fb.FORCE)
ax.set(xlabel="slip $s$ [m/s]", ylabel="rate of the gap $u$ [m/s]")
plt.show()

# %% [markdown]
# *Figure 3. The tip of the double pendulum through its impact. Friction stops the slip, which then
# turns, since more friction than there is would be needed to hold it. Newton's law knows the end
# alone: half the speed of arrival, and no slip.*
#
# Newton's law leaves 1.59 times the energy, by an impulse of the friction that has accelerated the
# tip all along. The two laws that follow the slip leave about half.

# %% [markdown]
# ## 5. Three balls
#
# The first of three equal elastic balls meets two that touch. Schoolbooks say $(0, 0, 1)$: one pair
# after the other. Momentum and energy allow a whole circle of answers, and Newton's law for both
# contacts at once gives another of them.

# %%
rows = np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]])
start = np.array([1.0, 0.0, 0.0])


def balls(ratio, e=1.0):
    """Velocities after; ratio: stiffness of the second contact over the first."""
    _, gaps, _ = through_springs(rows @ rows.T, rows @ start, [1.0, ratio], e)
    P = np.linalg.solve(rows @ rows.T, gaps[-1] - rows @ start)
    return start + rows.T @ P


for ratio in (1e-4, 1.0, 100.0):
    print(f"stiffness ratio {ratio:7g}:", np.round(balls(ratio), 4))
equal = balls(1.0)
assert np.allclose(equal, [-0.1303, 0.1502, 0.9800], atol=5e-5)
assert np.allclose(balls(1e-4), [0, 0, 1], atol=1e-3)
assert np.allclose(balls(100.0), [-1 / 3, 2 / 3, 2 / 3], atol=0.05)
assert math.isclose((equal**2).sum(), 1.0, rel_tol=1e-8)
newton_balls = start - 2 * rows.T @ np.linalg.solve(rows @ rows.T, np.minimum(rows @ start, 0.0))
assert np.allclose(newton_balls, [-1 / 3, 2 / 3, 2 / 3])

# %% [markdown]
# The soft limit is one pair after the other. The stiff one is *not*: two balls whose contact is
# very stiff move as one body of twice the mass, which is Newton's answer, $(-\tfrac13, \tfrac23,
# \tfrac23)$.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(5.6, 3.2), layout="constrained")
stiffness = np.logspace(-3, 2, 21)
found = np.array([balls(ratio) for ratio in stiffness])
for i, name in enumerate(("first", "second", "third")):
    ax.semilogx(stiffness, found[:, i], ".-", color=fb.LINES[i], label=name)
ax.axhline(0, color="0.8", lw=0.8)
ax.set(xlabel="stiffness of the second contact over the first", ylabel="velocity after")
ax.legend(loc="center left")
plt.show()

# %% [markdown]
# *Figure 4. Three equal elastic balls, the first arrives with 1. Equal springs give
# $(-0.13, 0.15, 0.98)$.*
#
# ## 6. Which law?
#
# | | takes | never gains | order of contacts |
# | --- | --- | --- | --- |
# | Newton | $e$, $\mu$ | without friction, or $e = 0$, or (4) | does not matter |
# | Moreau | $e$, $\mu$ | without friction, or one $e$ | does not matter |
# | Poisson | $e$, $\mu$ | without friction, or one contact | does not matter |
# | springs (`lzb`) | $e$, $\mu$, ratios of stiffness | always | does not matter |
# | one by one (`pairwise`) | $e$, $\mu$ | always | is the law |
#
# Where a single point lands and nothing else is pressed, all agree but for slip that turns round:
# take Newton's with a small $e$. Where other points are pressed, take springs. The guide
# *Compare impact laws*, one of the guides, says which law for which contact.
#
# ## Exercises
#
# 1. **The elastic block.** Let $e = 1$ in Section 2. With equal springs, does the block keep its
#    sense of rotation? *Hint: `through_springs(G, arrives, 1.0, 1.0)`.*
# 2. **On ice.** For which $h/b$ of a rectangle does the landing of Section 1 not press the old
#    corner? *Hint: the sign of $c$ in (1).*
# 3. **The bound.** Derive (4). *Hint: write $u^+ + u^-$ as $-\frac{1-e}{1+e}(GP)_n$ and
#    $s^+ + s^-$ as $2s^+ - (GP)_t$, and ask when the quadratic form that is left cannot be
#    positive.*
# 4. **How bouncy may Kane's tip be?** Up to which $e$ is (4) fulfilled by the double pendulum?
#    *Hint: $G$ is `D`.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Yes: $-0.65$ of $-4.13$ rad/s are left, and both corners go up.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# $c > 0$ means $I > mb^2$, for a rectangle $h/b > \sqrt2$. Rough ground asks for half of that, (3).
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $u^+ = -e\,u^-$ and $u^+ - u^- = (Gp)_n$ give $u^+ + u^- = -\frac{1-e}{1+e}(Gp)_n$. With $s^- =
# s^+ - (Gp)_t$ the work is $\tfrac12\bigl[-\tfrac{1-e}{1+e}P(Gp)_n - Q(Gp)_t\bigr] + Q s^+$, and
# $Qs^+ \le 0$. The bracket is a quadratic form with the matrix $-\begin{pmatrix} dG_{nn} &
# \frac{1+d}2G_{nt}\\ \frac{1+d}2G_{nt} & G_{tt}\end{pmatrix}$, $d = \frac{1-e}{1+e}$. It is never
# positive where $4d\,G_{nn}G_{tt} \ge (1+d)^2G_{nt}^2$, and $4d/(1+d)^2 = 1-e^2$.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# $e \le 0.246$. With $0.5$ the tip's slip turns round, and the energy grows by more than half.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
elastic = through_springs(G, arrives, 1.0, 1.0)[1][-1]
assert round(rotation(elastic), 2) == -0.65
assert (elastic > 0).all()
d = sp.Symbol("d", positive=True)
ratio_e = sp.Symbol("e", positive=True)
assert (
    sp.simplify((4 * d / (1 + d) ** 2).subs(d, (1 - ratio_e) / (1 + ratio_e)) - (1 - ratio_e**2))
    == 0
)
bound = math.sqrt(1 - D[0, 1] ** 2 / (D[0, 0] * D[1, 1]))
assert round(bound, 3) == 0.246
smooth_c = 1 / mass - width**2 / moment
on_ice = sp.solve(smooth_c.subs(moment, mass * (width**2 + height**2) / 3), height)
assert on_ice == [sp.sqrt(2) * width]
exercises = Exercises({1: rotation(elastic), 2: math.sqrt(2), 4: bound})

# %%
# your answers
exercises.check(1, ...)  # rad/s, with its sign
exercises.check(2, ...)  # h/b
exercises.check(4, ...)  # e
