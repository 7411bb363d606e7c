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
#     minutes: 25
# ---

# %% [markdown]
# # Why a block stops, in 25 minutes
#
# Each impact leaves a rocking block a fixed part of its speed, and a fixed part of a positive
# number is never zero. Still every block comes to rest. You find the time on paper, and see a
# program fail that does not know it. [The long version](why_a_block_stops.py) treats large
# rotations, and proves that the sum converges.
#
# ## Aims
#
# After this notebook you can
#
# 1. follow a free motion from peak to peak with one line of algebra;
# 2. add infinitely many half cycles to a finite time;
# 3. say why an event detector never reaches the rest, and what reaches it.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

import rockeom as rk
from rockeom.plots import use_style
from rockeom.teaching import Exercises

use_style()

p, alpha, e = 2.14, 0.25, 0.9  # rad/s, rad, -

# %% [markdown]
# ## 1. From peak to peak
#
# Between impacts a slender block obeys $x'' = x - 1$, where $x = |\theta|/\alpha$ and time is $pt$.
# Multiply by $x'$ and integrate: from rest at the peak $x_k$ it lands with
#
# $$v_k^2 = 1 - (1 - x_k)^2. \tag{1}$$
#
# The impact leaves $v_{k+1} = e\,v_k$, and the block climbs to the next peak. The speeds are
# $v_k = e^k v_0$, which is never zero.
#
# **Before you run the cell:** a block with $e = 0.9$ is released at $0.8\,\alpha$. How many impacts
# does the program record before the block stands still: about 20, about 150, or is the record
# at its end while impacts still go on?

# %%
block = rk.SlenderBlock.from_frequency(p=p, alpha=alpha)
run = rk.simulate(
    block, rk.GroundMotion.none(14.0), impact=rk.VelocityRatio(e), initial={"theta": 0.8 * alpha}
)
print(f"{len(run.impacts)} impacts recorded; {run.outcome} at {run.events.rest_time:.3f} s")
times = np.array([impact.time for impact in run.impacts])
print("times between impacts:", *np.diff(times)[[0, 10, 50, 100, 150]].round(6), "s")
assert run.outcome is rk.Outcome.CAME_TO_REST

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(6.4, 2.8), layout="constrained")
ax.plot(run.t, run["theta"] / alpha)
ax.axvline(run.events.rest_time, ls=":", color="C1")
ax.annotate("rest", (run.events.rest_time, 0.6), (5, 0), textcoords="offset points", color="C1")
ax.set(xlabel="time [s]", ylabel=r"$\theta/\alpha$")
plt.show()

# %% [markdown]
# *Figure 1. A free motion, and the time of rest.*
#
# <details><summary>Compare with your prediction</summary>
#
# About 150 are recorded. The impacts follow one another ever faster; when they have become tiny,
# the program adds the rest of them in one step, and full contact begins.
#
# </details>
#
# ## 2. A finite time
#
# From $x = 1 - (1 - x_k)\cosh pt$ and (1), a quarter cycle takes
# $p\,T_{1/4} = \operatorname{artanh} v_k$. The first one leads to the ground, and each half cycle
# after it has two:
#
# $$p\,t_\infty = \operatorname{artanh} v_0 + 2\sum_{k=1}^{\infty}\operatorname{artanh}(e^k v_0).
#   \tag{2}$$
#
# For small speeds $\operatorname{artanh} v \approx v$, and the sum is geometric: the time that
# remains after an impact which leaves the speed $v$ is
#
# $$p\,t \approx 2v\,(1 + e + e^2 + \dots) = \frac{2v}{1-e}, \tag{3}$$
#
# that of a bouncing ball. Infinitely many impacts take a finite time. The engine recognises this
# end and adds the sum in one step.

# %%
v_0 = math.sqrt(1 - (1 - 0.8) ** 2)
terms = [math.atanh(v_0)] + [2 * math.atanh(e**k * v_0) for k in range(1, 400)]
by_sum = math.fsum(terms) / p
print(f"by (2) {by_sum:.6f} s, simulated {run.events.rest_time:.6f} s")
assert math.isclose(by_sum, run.events.rest_time, rel_tol=1e-9)

# %% [markdown]
# ## 3. A program that fails
#
# The usual program integrates to the next zero of $\theta$, multiplies the velocity by $e$, and
# starts again.
#
# **Before you run the cell:** we let it run for at most 400 impacts. Does its clock pass the time
# $t_\infty$, at which the block stands still?


# %%
def landing(_, y):
    return y[0]


landing.terminal, landing.direction = True, -1
t, state, clock = 0.0, [0.8 * alpha, 0.0], []
while len(clock) < 400 and t < 14.0:  # on one side: x is the size of the rotation
    flight = solve_ivp(
        lambda _, y: [y[1], p**2 * (y[0] - alpha)], (t, 14.0), state, events=landing, rtol=1e-9,
        atol=1e-12,
    )  # fmt: skip
    t, state = flight.t[-1], [0.0, -e * flight.y[1, -1]]
    clock.append(t)
print(f"after {len(clock)} impacts the clock shows {clock[-1]:.6f} s; t_end is {by_sum:.6f} s")
assert len(clock) == 400
assert clock[-1] < by_sum + 1e-5
assert np.ptp(clock[-50:]) < 1e-6

# %% [markdown]
# <details><summary>Compare with your prediction</summary>
#
# It does not. The flights become shorter than the spacing of floating-point numbers, and the clock
# stands still. Nothing that happens after the rest, such as the next earthquake, is ever reached.
#
# </details>
#
# ## Exercises
#
# 1. **Half the energy.** After how many impacts has the block lost half of its energy?
#    *Hint: the energy is proportional to $v_k^2$.*
# 2. **The last second.** An impact leaves the speed $v = 0.05$. How long does the block rock on, in
#    seconds? *Hint: (3), and $p = 2.14$ rad/s.*
# 3. **A better floor.** By which factor is the time of exercise 2 longer if $e = 0.99$?
#    *Hint: (3).*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# $\ln\tfrac12/\ln e^2 = 3.3$: the fourth impact takes it below a half.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# $2\cdot0.05/(1-0.9)/2.14 = 0.467$ s.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $(1-0.9)/(1-0.99) = 10$.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
assert math.ceil(math.log(0.5) / math.log(e**2)) == 4
left = 2 * 0.05 / (1 - e) / p
start = {"theta": 0.0, "theta_dot": 0.05 * p * alpha}
on = rk.simulate(
    block, rk.GroundMotion.none(2.0), impact=rk.VelocityRatio(e), initial=start, mode="right"
)
assert math.isclose(on.events.rest_time, left, rel_tol=1e-2)
v = sp.Symbol("v", positive=True)
remaining = [2 * v / (1 - x) for x in (sp.Rational(99, 100), sp.Rational(9, 10))]
assert sp.cancel(remaining[0] / remaining[1]) == 10
exercises = Exercises({1: 4, 2: left, 3: 10})

# %%
# your answers
exercises.check(1, ...)  # a whole number
exercises.check(2, ...)  # in seconds
exercises.check(3, ...)  # a factor
