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
#     minutes: 45
# ---

# %% [markdown]
# # Why a block stops
#
# A rocking block comes to rest, as everyone has seen. Yet each impact of Housner's block leaves it
# a fixed part of its speed, and a positive number times a fixed part is never zero. So the block
# must hit the ground infinitely often, and still it stops after some seconds. This notebook finds
# out when, first exactly on paper and then with numbers, and shows why a general-purpose integrator
# cannot get there.
#
# ## Aims
#
# After this notebook you can
#
# 1. derive the exact map from one peak of a free motion to the next;
# 2. sum infinitely many half cycles to a finite time, with a proof that the sum converges;
# 3. compute the same for large rotations by quadrature;
# 4. explain what an event detector does near the end, and recognise three ways in which a program
#    goes wrong there.

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

p, alpha, release, e = 2.14, 0.25, 0.2, 0.9  # rad/s, rad, rad, -
r = e**2

# %% [markdown]
# ## 1. The motion
#
# We take the free block of [the first notebook](housner_block.py). Between impacts
#
# $$\ddot\theta = -s\,p^2\sin(\alpha - s\theta), \qquad s = \operatorname{sgn}\theta, \tag{1}$$
#
# and at an impact the angular velocity is multiplied by $e$, and the kinetic energy by $r = e^2$
# (see [energy lost in an impact](restitution.py)). In this notebook $e = 0.9$.

# %%
block = rk.RigidBlock.from_frequency(p=p, alpha=alpha)
quiet = rk.GroundMotion.none(12.0)
run = rk.simulate(block, quiet, impact=rk.VelocityRatio(e), initial={"theta": release})


# %% tags=["hide-input"] jupyter={"source_hidden": true}
def block_at(ax, theta, foot, half_width=0.25, height=1.6):
    """The block turned about the foot, -1 left or +1 right, at which it stands."""
    b = half_width
    corners = [(-b, 0), (b, 0), (b, height), (-b, height), (0, height / 2)]
    *corners, centre = fb.turned(corners, (foot * b, 0), theta)
    fb.ground(ax, -0.75, 0.75, depth=0.06)
    fb.body(ax, corners)
    fb.centroid(ax, centre)
    fb.pivot(ax, (foot * b, 0), "$O$" if foot > 0 else "$O'$", (12 * foot, 9))
    fb.bare(ax)
    ax.set(xlim=(-0.8, 0.8), ylim=(-0.5, 1.75))
    return corners, centre


figure = plt.figure(figsize=(7.6, 5.2), layout="constrained")
sketches, below = figure.subfigures(2, 1, height_ratios=[1, 1])
first, second, third = sketches.subplots(1, 3)

corners, centre = block_at(first, 0.2, 1)
fb.line(first, (0.25, 0), (0.25, 1.2))
fb.angle(first, (0.25, 0), (-0.25, 0), corners[0], 0.6, r"$\theta_0$", label_radius=1.2)
fb.arrow(first, centre, (centre[0], centre[1] - 0.45), "$mg$", offset=(-11, 4))
first.set_title("peak: at rest", fontsize=9)

corners, centre = block_at(second, 0.0, -1)
fb.angle(second, (0.25, 0), (0.2, 1), (-0.25, 1), 1.3, "", sense=True, color=fb.MOTION)
fb.arrow(second, (-0.25, -0.4), (-0.25, -0.1), "impulse", label_at="tail", offset=(25, 2))
second.set_title(r"impact: $\dot\theta \to e\,\dot\theta$", fontsize=9)

corners, centre = block_at(third, -0.14, -1)
fb.angle(third, (-0.25, 0), (0.25, 0), corners[1], 0.6, r"$\theta_1$", label_radius=1.2)
fb.arrow(third, centre, (centre[0], centre[1] - 0.45), "$mg$", offset=(11, 4))
third.set_title("next peak: at rest", fontsize=9)

ax = below.subplots()
ax.plot(run.t, run["theta"])
ax.axvline(run.events.rest_time, ls=":", color=fb.FORCE)
ax.annotate(
    "rest", (run.events.rest_time, 0.13), (5, 0), textcoords="offset points", color=fb.FORCE
)
ax.set(xlabel="time [s]", ylabel=r"$\theta$ [rad]")
plt.show()

# %% [markdown]
# *Figure 1. Above: one half cycle, from a peak through an impact to the next peak. Below: a free
# motion with $p = 2.14$ rad/s, $\alpha = 0.25$, released at $\theta_0 = 0.2$, with $e = 0.9$. The
# impacts crowd together, and then there is silence.*

# %% [markdown]
# ## 2. The slender block: the map of the peaks
#
# For small angles (1) is linear. In $x = |\theta|/\alpha$ and the time $\tau = pt$ it reads, on
# either side,
#
# $$x'' = x - 1. \tag{2}$$
#
# Multiply by $x'$ and integrate: $x'^2 - (1-x)^2$ is constant. At the peak $x_k$ the speed is zero,
# at the impact that follows $x = 0$ and the speed is $v_k$:
#
# $$v_k^2 = 1 - (1-x_k)^2. \tag{3}$$
#
# The impact leaves $v_{k+1} = e\,v_k$, and the block climbs to the peak with
# $v_{k+1}^2 = 1 - (1 - x_{k+1})^2$. Eliminate the speeds:
#
# $$1-(1-x_{k+1})^2 = r\,\bigl[1-(1-x_k)^2\bigr]. \tag{4}$$
#
# In the right variable the map is geometric. The speeds shrink by $e$ each time, and
#
# $$v_k = e^k v_0, \qquad x_k = 1 - \sqrt{1 - r^k v_0^2}. \tag{5}$$

# %%
x, x_next, v = sp.symbols("x_k x_next v_0", positive=True)
ratio, k = sp.Symbol("r", positive=True), sp.Symbol("k", integer=True, nonnegative=True)

peak = 1 - sp.sqrt(1 - ratio**k * v**2)
energy_map = 1 - (1 - x_next) ** 2 - ratio * (1 - (1 - x) ** 2)
assert sp.simplify(energy_map.subs({x_next: peak.subs(k, k + 1), x: peak})) == 0
assert sp.simplify((1 - peak.subs(k, 0)) ** 2 - (1 - v**2)) == 0  # (3) at the release

# %% [markdown]
# Compare with the engine: peaks of the simulated slender block, halfway between two impacts.

# %%
slender = rk.SlenderBlock.from_frequency(p=p, alpha=alpha)
slow_end = rk.GroundMotion.none(14.0)
linear_run = rk.simulate(slender, slow_end, impact=rk.VelocityRatio(e), initial={"theta": release})
v_0 = math.sqrt(1 - (1 - release / alpha) ** 2)

times = np.array([impact.time for impact in linear_run.impacts[:20]])
middles = (times[:-1] + times[1:]) / 2
simulated = np.abs(linear_run.at(middles)["theta"]) / alpha
count = np.arange(1, 20)
assert np.allclose(simulated, 1 - np.sqrt(1 - r**count * v_0**2), rtol=1e-8, atol=0)

speeds = np.array([abs(impact.before["theta_dot"]) for impact in linear_run.impacts[:20]])
assert np.allclose(speeds, p * alpha * v_0 * e ** np.arange(20), rtol=1e-8, atol=0)

# %% [markdown]
# ## 3. Infinitely many half cycles in a finite time
#
# A quarter cycle, from the peak $x_k$ down to the ground, lasts
# $\operatorname{arcosh}\frac1{1-x_k}$ in the time $\tau$ (thesis 2-5). With (3),
# $1 - x_k = \sqrt{1-v_k^2}$, so the hyperbolic cosine of this time is $1/\sqrt{1-v_k^2}$ and its
# hyperbolic tangent is simply $v_k$:
#
# $$p\,T_{1/4} = \operatorname{artanh} v_k. \tag{6}$$

# %%
assert sp.simplify(sp.cosh(sp.atanh(v)) - 1 / sp.sqrt(1 - v**2)) == 0

# %% [markdown]
# The first quarter cycle starts at the release; each later half cycle consists of two equal ones.
# The motion ends after
#
# $$p\,t_\infty = \operatorname{artanh} v_0 + 2\sum_{k=1}^{\infty}\operatorname{artanh}(e^k v_0).
#   \tag{7}$$
#
# **It converges.** On $[0, 1)$ the function artanh is convex and vanishes at zero, hence
# $\operatorname{artanh}(e z) \le e \operatorname{artanh} z$. The terms are below those of a
# geometric series, and what is left after $n$ half cycles is bounded:
#
# $$2\sum_{k=n}^{\infty}\operatorname{artanh}(e^k v_0)
#   \le \frac{2\operatorname{artanh}(e^n v_0)}{1-e}. \tag{8}$$
#
# **A faster series.** Put $\operatorname{artanh} z = z + z^3/3 + z^5/5 + \dots$ into (7) and sum
# over $k$ first. For each odd power $n$ that sum is geometric, $\sum_{k\ge1} e^{nk} =
# e^n/(1-e^n)$, and
#
# $$p\,t_\infty = \operatorname{artanh} v_0
#   + 2\sum_{n\ \mathrm{odd}} \frac{v_0^n}{n}\,\frac{e^n}{1-e^n}. \tag{9}$$
#
# All impacts are now in closed form. The first term of (9), for small $v_0$, gives
# $p\,t_\infty \approx v_0\,(1+e)/(1-e)$: the time of a bouncing ball.


# %%
def end_of_slender(v_0, e):
    """Equation (7) [1/p], summed until nothing changes."""
    terms = [math.atanh(v_0)]
    while terms[-1] > 1e-18 * terms[0]:
        terms.append(2 * math.atanh(e ** len(terms) * v_0))
    return math.fsum(terms)


def end_by_powers(v_0, e):
    """Equation (9) [1/p]."""
    n = np.arange(1, 4001, 2)
    powers = v_0**n / n * e**n / (1 - e**n)
    return math.atanh(v_0) + 2 * math.fsum(powers)


for start in (0.1, 0.5, 0.9, 0.99):
    assert math.isclose(end_of_slender(start, e), end_by_powers(start, e), rel_tol=1e-13)
assert math.isclose(end_by_powers(1e-3, e), 1e-3 * (1 + e) / (1 - e), rel_tol=1e-6)

tail = (
    end_of_slender(v_0, e) - math.atanh(v_0) - 2 * sum(math.atanh(e**k * v_0) for k in range(1, 9))
)
assert 0 < tail < 2 * math.atanh(e**9 * v_0) / (1 - e)  # (8) with n = 9

slender_end = end_by_powers(v_0, e) / p
assert math.isclose(linear_run.events.rest_time, slender_end, rel_tol=1e-10)
print(f"closed form {slender_end:.9f} s, simulated {linear_run.events.rest_time:.9f} s")

# %% [markdown]
# ## 4. Large rotations
#
# For the exact equation (1) nothing changes but the formulas. In units of $p^2$ the kinetic
# energy at the impact after a peak $\theta_k$ is
#
# $$E_k = \cos(\alpha-\theta_k) - \cos\alpha
#   = 2\sin\!\left(\alpha - \tfrac{\theta_k}2\right)\sin\tfrac{\theta_k}{2}, \tag{10}$$
#
# the impacts again make it geometric, $E_k = r^k E_0$, and (10) must be solved for the peak, which
# a few steps of Newton's method do. The second form in (10) has no cancellation, and we need that:
# the last peaks that matter are of $10^{-30}$ rad. The quarter period is the integral (12) of the
# first notebook, smooth after the substitution $\theta = \theta_k - u^2$.

# %%
nodes, weights = np.polynomial.legendre.leggauss(60)


def impact_energy(peak):
    """Equation (10) [p^2]."""
    return 2 * math.sin(alpha - peak / 2) * math.sin(peak / 2)


def peak_of(energy):
    """The peak from which the block lands with this energy [rad], by Newton's method."""
    peak = energy / math.sin(alpha)
    for _ in range(50):
        peak -= (impact_energy(peak) - energy) / math.sin(alpha - peak)
    return peak


def quarter_period(peak):
    """Time from rest at the peak to the impact [s]."""
    u = 0.5 * math.sqrt(peak) * (nodes + 1)
    integrand = u / np.sqrt(np.sin(alpha - peak + u**2 / 2) * np.sin(u**2 / 2))
    return 0.5 * math.sqrt(peak) * float(weights @ integrand) / p


energies = impact_energy(release) * r ** np.arange(400)
quarters = [quarter_period(peak_of(energy)) for energy in energies]
rigid_end = quarters[0] + 2 * math.fsum(quarters[1:])

assert math.isclose(quarters[0], 1.071994026, abs_tol=1e-9)
assert math.isclose(rigid_end, 10.648687, abs_tol=1e-6)
print(f"first impact {quarters[0]:.9f} s, rest at {rigid_end:.6f} s")

# %% [markdown]
# The engine gives the same impact times and the same end.

# %%
expected = quarters[0] + 2 * np.concatenate([[0.0], np.cumsum(quarters[1:40])])
found = np.array([impact.time for impact in run.impacts[:40]])
assert np.allclose(found, expected, rtol=1e-9, atol=0)
assert math.isclose(run.events.rest_time, rigid_end, rel_tol=1e-10)
assert run.outcome is rk.Outcome.CAME_TO_REST

after = run.t > run.events.rest_time
assert after.any()
assert not run["theta"][after].any()  # exactly zero, in full contact
assert set(run.mode[after]) == {"both"}
print(run.summary())

# %% tags=["hide-input"] jupyter={"source_hidden": true}
remaining = rigid_end - expected
figure, ax = plt.subplots(figsize=(5.4, 3.4), layout="constrained")
ax.semilogy(np.arange(40), remaining, "o", ms=3.5, label="simulated impacts")
limit = 2 * impact_energy(release) ** 0.5 * e ** np.arange(40) / (1 - e)
limit *= e * math.sqrt(2) / math.sin(alpha) / p
ax.semilogy(np.arange(40), limit, color=fb.INK, lw=0.9, label="bouncing ball, $e^k$")
ax.set(xlabel="number of impacts before", ylabel=r"$t_\infty - t$ [s]")
ax.legend()
plt.show()

# %% [markdown]
# *Figure 2. The time that is left at each impact. It shrinks by the factor $e$ from impact to
# impact, as for a ball that bounces: while the rotation is tiny, the righting moment is constant.*
#
# This is also how the engine gets past the end. Close to rest the block is a bouncing ball with the
# constant downward acceleration $a = p^2\sin\alpha$. After an impact that leaves the speed $v$ the
# remaining time is a geometric series,
#
# $$\frac{2v}{a}\,(1 + e + e^2 + \dots) = \frac{2v}{a\,(1-e)}. \tag{11}$$
#
# It is added in one stroke, and full contact begins: a state of its own, in which nothing moves
# until the ground pushes hard enough to lift a foot again.

# %%
last = run.impacts[-1]
speed = abs(last.after["theta_dot"])
acceleration = abs(block.accelerations({"theta": 0.0}, mode="right")["theta"])
assert math.isclose(acceleration, p**2 * math.sin(alpha), rel_tol=1e-12)
assert abs(rigid_end - last.time - 2 * speed / acceleration / (1 - e)) < 1e-9

# %% [markdown]
# ## 5. Three programs that go wrong
#
# Most integrators can stop at an *event*, a change of sign of some function: here $\theta$. Then
# one reverses the side, multiplies the speed by $e$ and starts again. Here is that program, with
# SciPy's `solve_ivp`. It has two options that a user will soon want.


# %%
def naive(directed, wait, most_impacts, end=13.0):
    """Times of the impacts (n,) [s], and times and rotations of the last leg [s, rad].

    directed : look only for falls through zero; wait : time without event detection after an
    impact [s].
    """
    t, side, state, impacts = 0.0, 1, [release, 0.0], []

    def rates(_, y):
        return [y[1], -side * p**2 * math.sin(alpha - side * y[0])]

    def landing(_, y):
        return y[0]

    landing.terminal = True
    while t < end and len(impacts) < most_impacts:
        landing.direction = -side if directed else 0
        if wait and impacts:
            pause = solve_ivp(rates, (t, t + wait), state, rtol=1e-9, atol=1e-12)
            t, state = pause.t[-1], pause.y[:, -1]
        found = solve_ivp(rates, (t, end), state, events=landing, rtol=1e-9, atol=1e-12)
        t, state = found.t[-1], found.y[:, -1]
        leg = found.t, found.y[0]
        if found.status == 1:
            impacts.append(t)
            side, state = -side, [0.0, e * state[1]]
    return np.array(impacts), *leg


# %% [markdown]
# **A. The first attempt.** The block starts each half cycle on the ground, where the event function
# is zero. The integrator finds this zero at once and reports an impact, and so on. Time no longer
# moves.

# %%
impacts_a, *_ = naive(directed=False, wait=0.0, most_impacts=100)
assert np.ptp(impacts_a) < 1e-9  # a hundred "impacts" at one instant
print(f"A: after {len(impacts_a)} impacts the time is {impacts_a[-1]:.6f} s")

# %% [markdown]
# **B. Only falls count.** Tell the event in which direction to look, and the flights come out
# right. But the program goes from impact to impact, and infinitely many lie before it. Soon a
# flight lasts less than the spacing of floating-point numbers near $t = 10.6$. The clock stands
# still, and what comes after the rest is never reached.

# %%
impacts_b, *_ = naive(directed=True, wait=0.0, most_impacts=600)
assert abs(impacts_b[0] - quarters[0]) < 1e-7
assert impacts_b[-1] < rigid_end + 1e-5 < 13.0
assert np.ptp(impacts_b[-100:]) < 1e-9
print(f"B: after {len(impacts_b)} impacts the time is {impacts_b[-1]:.6f} s")

# %% [markdown]
# **C. Step off the ground first.** The usual remedy for A is to wait a moment before looking for
# the next landing. When a flight is shorter than the wait, the block is already below the floor as
# the look-out starts. It never falls *through* zero again, keeps its old pivot, and sinks.

# %%
impacts_c, time_c, sinking = naive(directed=True, wait=1e-4, most_impacts=600)
assert len(impacts_c) < 150
assert abs(sinking[-1]) > math.pi / 2  # flat on its side, and on
print(f"C: after {len(impacts_c)} impacts it ends at theta = {sinking[-1]:.2f} rad")

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, (whole, ends) = plt.subplots(1, 2, figsize=(7.6, 3.2), layout="constrained")
whole.plot(run.t, run["theta"], label="exact")
whole.plot(time_c, sinking, "--", label="program C")
whole.set(xlabel="time [s]", ylabel=r"$\theta$ [rad]", ylim=(-1.2, 1.2))
whole.legend(loc="upper left")
for times, name, marker in [(impacts_a, "A", "x"), (impacts_b, "B", "."), (impacts_c, "C", "+")]:
    ends.plot(np.arange(1, len(times) + 1), times, marker, ms=4, label=name)
ends.axhline(rigid_end, ls=":", color=fb.INK)
ends.annotate(r"$t_\infty$", (400, rigid_end), (0, 5), textcoords="offset points")
ends.set(xlabel="number of the impact", ylabel="its time [s]", ylim=(0, 12.5))
ends.legend(loc="center right")
plt.show()

# %% [markdown]
# *Figure 3. Left: program C lets the block sink through the floor at the moment at which it should
# come to rest: a false overturning. Right: times of the impacts that each program reports.*
#
# None of the three crashed or warned. Physics would have shown the mistake: after rest
# nothing can move, and the energy of a free block can never rise. Both are worth an assertion in
# any program that you write yourself.

# %% [markdown]
# ## Exercises
#
# 1. **Half the energy.** After how many impacts has the block lost half of its energy, and after
#    what part of $t_\infty$? *Hint: $r^n = 1/2$; then (7) with a finite sum.*
# 2. **Dead and perfect impacts.** What do (7) and (9) say for $e \to 0$ and for $e \to 1$?
#    *Hint: in the second case show $p\,t_\infty \sim c/(1-e)$, with
#    $c = 2\int_0^{v_0} z^{-1}\operatorname{artanh} z\,\mathrm dz$.*
# 3. **From the brink.** Release the block close to its balance, $v_0 \to 1$. Which part of (7)
#    diverges, and how fast? *Hint: only one term does.*
# 4. **Slender or not.** Compare `slender_end` with `rigid_end`. Which approximations make the
#    difference? *Hint: compare $p^2\sin\alpha$ with $p^2\alpha$ in the bouncing-ball limit.*
# 5. **Detect the fall.** Add to program C a test that stops it within one impact of the mistake.
#    *Hint: (10) bounds the energy after $n$ impacts.*
# 6. **Shaking.** Let the ground accelerate with $0.5\,g\tan\alpha$ all the time. Does the block
#    still stop in finite time? Derive the bouncing-ball time, and check it with
#    `rk.GroundMotion.constant`. *Hint: the acceleration differs on the two sides.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# $n = \ln\tfrac12/\ln r = 3.3$: the fourth impact takes it below a half. By (7) this is at 40 % of
# $t_\infty$: the slender block spends the longer part of its time with the smaller part of its
# energy.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# For $e\to0$ only the first quarter cycle is left, $p\,t_\infty = \operatorname{artanh}v_0$. For
# $e\to1$ the sum of (7) becomes an integral. With $z = e^kv_0$ the steps are $\mathrm dz =
# -(1-e)\,z\,\mathrm dk$, so that
#
# $$2\sum_k\operatorname{artanh}(e^kv_0) \approx
#   \frac2{1-e}\int_0^{v_0}\frac{\operatorname{artanh}z}{z}\,\mathrm dz .$$
#
# Its series is $c = 2\,(v_0 + v_0^3/9 + v_0^5/25 + \dots)$. A block that loses a hundredth of its
# speed at an impact rocks ten times as long as one that loses a tenth.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# Only $\operatorname{artanh}v_0$ diverges, as $\tfrac12\ln\frac2{1-v_0}$. All other terms start
# from $e^kv_0 < e$, and stay below those of $v_0 = 1$: once it has left the brink, the block needs
# no longer than from any other large peak.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# In the bouncing-ball limit the time that is left is in proportion to the speed of the impacts over
# the downward acceleration. The slender block has the larger acceleration, $p^2\alpha$ for
# $p^2\sin\alpha$, and so the shorter end. Its speed at the first impact differs as well, by the
# energy of the release: $\alpha\theta_0-\theta_0^2/2$ for $\cos(\alpha-\theta_0)-\cos\alpha$. The
# two together are the ratio of the times that are left after many impacts.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# After $n$ impacts the energy, with $|\theta|$ in the potential, is at most $r^nE_0$. Below the
# floor program C turns on about the old pivot, and that energy grows from step to step. The test
# finds it in the very leg in which the block sinks.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# Yes. At $\theta = 0$ the downward acceleration is $a\,(1\pm\tfrac12)$ with $a = p^2\sin\alpha$:
# more on the right foot, to which the inertia force pushes back, and less on the left one. A flight
# to the left after an impact that leaves $v$ lasts $2v/(\tfrac12a)$, the next one, to the right,
# $2ev/(\tfrac32a)$, and so on:
#
# $$t = \frac{2v}{a}\,\frac{2 + \tfrac23e}{1-e^2} .$$
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
needed = math.ceil(math.log(0.5) / math.log(r))
assert needed == 4
share = linear_run.impacts[needed - 1].time / linear_run.events.rest_time
print(f"below half of the energy after {share:.2f} of the time")
assert round(share, 1) == 0.4

odd = np.arange(1, 400, 2)
c = 2 * (0.5**odd / odd**2).sum()
assert math.isclose(end_of_slender(0.5, 1e-9), math.atanh(0.5), rel_tol=1e-8)
assert math.isclose(end_of_slender(0.5, 0.9999) * 1e-4, c, rel_tol=1e-3)

later = [end_of_slender(1 - gap, e) - math.atanh(1 - gap) for gap in (1e-6, 1e-10)]
assert math.isclose(*later, rel_tol=1e-5)
assert math.isclose(math.atanh(1 - 1e-10), math.log(2 / 1e-10) / 2, rel_tol=1e-6)

by_speed = math.sqrt((alpha * release - release**2 / 2) / impact_energy(release))
by_acceleration = math.sin(alpha) / alpha
slender_left = slender_end - linear_run.impacts[35].time
print(f"slender {slender_end:.3f} s, rigid {rigid_end:.3f} s")
assert math.isclose(slender_left / remaining[35], by_speed * by_acceleration, rel_tol=1e-3)


def watched(wait=1e-4, most_impacts=600):
    """Program C; where its energy has grown, how often it has hit the ground and how deep it is."""
    t, side, state, hits = 0.0, 1, [release, 0.0], 0
    allowed = impact_energy(release)

    def rates(_, y):
        return [y[1], -side * p**2 * math.sin(alpha - side * y[0])]

    def landing(_, y):
        return y[0]

    landing.terminal = True
    while hits < most_impacts:
        if hits:
            pause = solve_ivp(rates, (t, t + wait), state, rtol=1e-9, atol=1e-12)
            t, state = pause.t[-1], pause.y[:, -1]
        size = abs(state[0])
        energy = state[1] ** 2 / (2 * p**2) + 2 * math.sin(alpha - size / 2) * math.sin(size / 2)
        if energy > 1.01 * allowed:
            return hits, state[0]
        landing.direction = -side
        found = solve_ivp(rates, (t, 13.0), state, events=landing, rtol=1e-9, atol=1e-12)
        t, state = found.t[-1], found.y[:, -1]
        hits, side, state, allowed = hits + 1, -side, [0.0, e * state[1]], r * allowed
    return None


hits, depth = watched()
assert abs(hits - len(impacts_c)) <= 1
assert abs(depth) < 1e-7

leaning = rk.GroundMotion.constant(0.5 * block.gravity * math.tan(alpha), 3.0)
pushed = rk.simulate(block, leaning, impact=rk.VelocityRatio(e), initial={"theta": 1e-5})
left = abs(pushed.impacts[0].after["theta_dot"])
bounces = 2 * left / (p**2 * math.sin(alpha)) * (2 + 2 * e / 3) / (1 - e**2)
assert math.isclose(pushed.events.rest_time - pushed.impacts[0].time, bounces, rel_tol=1e-3)
speed_left, e_symbol = sp.symbols("v e", positive=True)
leaning_time = speed_left * (4 + sp.Rational(4, 3) * e_symbol) / (1 - e_symbol**2)
exercises = Exercises({1: needed, 4: by_speed * by_acceleration, 6: leaning_time})

# %%
# your answers
exercises.check(1, ...)  # number of impacts
exercises.check(4, ...)  # remaining time of the slender block over that of the rigid one
exercises.check(6, ...)  # the time in units of 1/a, in the symbols speed_left and e_symbol
