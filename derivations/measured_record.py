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
#     level: research
#     minutes: 45
# ---

# %% [markdown]
# # Reading a measured record
#
# A test of a rocking block leaves a column of numbers: its rotation, a thousand times a second, and
# noise. We want to know its impacts: how much energy each leaves, whether both feet are alike,
# how large the force was. Between the column and the answer stand a filter, two differentiations
# and a division, and each of them makes something of the noise. This notebook follows it.
#
# ## Aims
#
# After this notebook you can
#
# 1. estimate the noise of a record from the record itself, and say why impacts do not spoil that;
# 2. say what a filter and a derivative make of noise, before you use them;
# 3. find the energy ratio of each impact with an interval, and distinguish two feet;
# 4. say what a record of the rotation shows of an impact force, and what it cannot show;
# 5. choose between resolution in time and in frequency.
#
# The record is a simulated one, so that we know what should come out. The block is that of the
# tests of Ma (2010), the ratios are about those of its two feet, and the noise is
# $\sigma$ = 0.02 degrees.

# %%
from math import comb

import matplotlib.pyplot as plt
import numpy as np

import rockeom as rk
from rockeom import analysis
from rockeom.plots import use_style
from rockeom.thesis.points_of_interest import points_by_prominence, points_by_score

use_style()

block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)  # m, kg
shape = {"mass": block.mass, "alpha": block.alpha, "radius": block.radius}
ratio = {"left": 0.77, "right": 0.93}  # by the foot that lands
sigma = np.radians(0.02)

run = rk.simulate(
    block,
    rk.GroundMotion.none(5.0),
    initial={"theta": np.radians(7.876)},
    impact=rk.EnergyRatio(**ratio),
)
t = np.arange(0.0, 5.0, 0.001)
exact = run.at(t)["theta"]
rng = np.random.default_rng(0)
record = analysis.MeasuredRecord(t, {"theta": exact + rng.normal(0.0, sigma, len(t))})

figure, ax = plt.subplots(figsize=(7.2, 2.8), layout="constrained")
ax.plot(t, np.degrees(record["theta"]), lw=0.7)
ax.set(xlabel="time [s]", ylabel=r"rotation $\theta$ [deg]")
plt.show()

# %% [markdown]
# *Figure 1. The record.*
#
# ## 1. How much of it is noise
#
# Let the samples be $x_i = \theta(t_i) + e_i$ with errors $e_i$ that know nothing of one another.
# Take differences of differences, six times:
#
# $$d_i = \sum_{j=0}^{6} (-1)^j \binom{6}{j} x_{i+j}. \tag{1}$$
#
# They vanish for a polynomial of degree five, and over seven milliseconds a smooth motion is one.
# The errors do not cancel. Their variances add with the squares of the weights,
#
# $$\operatorname{var} d = \sigma^2 \sum_j \binom{6}{j}^2 = \binom{12}{6}\,\sigma^2 = 924\,\sigma^2.
#   \tag{2}$$
#
# So the size of $d$ gives $\sigma$. At an impact the angular velocity jumps, and some seven of the
# $d_i$ are large for another reason; there are five thousand. The *median* of their sizes does not
# notice. For a normal distribution it is 0.6745 standard deviations.

# %%
d = np.diff(record["theta"], 6)
estimated = np.median(np.abs(d)) / 0.6745 / np.sqrt(924)
assert abs(estimated / sigma - 1) < 0.05
assert np.isclose(estimated, record.noise["theta"].level, rtol=1e-3)
print(f"noise {np.degrees(estimated):.4f} degrees, put in {np.degrees(sigma):.4f}")

# %% [markdown]
# ## 2. Noise behind a filter and a derivative
#
# Whatever we do next, a smoothed value or a derivative, is a sum of neighbouring samples with fixed
# weights $w_j$. Its noise is known before we look at the data:
#
# $$y_i = \sum_j w_j x_{i+j} \quad\Rightarrow\quad \operatorname{var} y = \sigma^2 \sum_j w_j^2.
#   \tag{3}$$
#
# Fit a parabola to $2n+1$ samples a step $h$ apart and take its slope in the middle. By symmetry
# the weights are $w_j = j/(h\sum_k k^2)$, so that
#
# $$\operatorname{var} \dot y = \frac{\sigma^2}{h^2 \sum_{k=-n}^{n} k^2}
#   = \frac{3\,\sigma^2}{h^2\,n(n+1)(2n+1)}. \tag{4}$$
#
# Halve the window and the noise of the rate grows by $2^{3/2}$; that of the second derivative by
# $2^{5/2}$. `with_derivatives` fits a polynomial of degree four and states its noise likewise.

# %%
n, h = 25, record.step
slope = record.with_derivatives("theta", window=2 * n * h, degree=2)
by_hand = np.sqrt(3 * estimated**2 / (h**2 * n * (n + 1) * (2 * n + 1)))
assert np.isclose(slope.noise["theta_dot"].level, by_hand, rtol=1e-3)

fine, wide = (record.with_derivatives("theta", window=w) for w in (0.04, 0.08))
growth = [fine.noise[name].level / wide.noise[name].level for name in ("theta_dot", "theta_ddot")]
assert np.allclose(growth, [2**1.5, 2**2.5], rtol=0.06)

# %% [markdown]
# Is a strange velocity in the record, or did the arithmetic make it? Resample and differentiate
# again. If it is still there, it was measured.

# %%
again = record.velocities_by_resampling("theta", window=0.06)
assert again.spread < 1.5 * again.noise

figure, axes = plt.subplots(2, 1, figsize=(7.2, 4.2), sharex=True, layout="constrained")
states = run.at(t, side="left")
for one, label in ((fine, "window 0.04 s"), (wide, "0.08 s")):
    axes[0].plot(t, one["theta_dot"], lw=0.8, label=label)
    axes[1].plot(t, one["theta_ddot"], lw=0.8, label=label)
axes[0].plot(t, states["theta_dot"], "k:", lw=0.8, label="exact")
axes[0].set(ylabel=r"$\dot\theta$ [rad/s]", xlim=(0, 2.2))
axes[1].set(xlabel="time [s]", ylabel=r"$\ddot\theta$ [rad/s$^2$]", ylim=(-12, 12))
axes[0].legend(loc="lower right", ncols=3)
plt.show()

# %% [markdown]
# *Figure 2. Rate and second derivative by two windows. The second derivative of the narrow one is
# noise for the most part; the wide one rounds the bends of the rate at the impacts.*
#
# ## 3. Restitution
#
# Between impacts the block keeps its energy, so that the ratio of kinetic energies at an impact is
# that of the potential energies at the peaks around it,
#
# $$r = \frac{U(\theta_2)}{U(\theta_1)}, \qquad
#   \left(\frac{\delta r}{r}\right)^2
#   = \left(\frac{U'(\theta_2)}{U(\theta_2)}\,\delta\theta_2\right)^2
#   + \left(\frac{U'(\theta_1)}{U(\theta_1)}\,\delta\theta_1\right)^2. \tag{5}$$
#
# For small rotations $U \propto \theta$, so $\delta r/r$ is about $\sqrt2\,\delta\theta/\theta$: it
# grows as the motion dies. That is why impacts below some energy are left out.
#
# And how well is a peak known? Not as badly as a sample. The polynomial of degree four through the
# $N$ samples about the peak has a value with the variance $\tfrac{225}{64}\sigma^2/N$ in its
# middle: of three hundred samples the peak is known ten times better than of one.

# %%
peaks = analysis.identification.fitted_peaks(record, "theta")
crossings = record.free_vibration("theta").time[1::2]
between = int(0.5 * (crossings[1] - crossings[0]) / h)
assert np.isclose(peaks.deviation[1], estimated * np.sqrt(225 / 64 / between), rtol=0.02)

found = analysis.identification.Impacts.of_record(record, block, threshold=6.0)  # J
true = np.array([ratio[foot] for foot in found.foot])
assert np.mean(np.abs(found.energy_ratio - true) < found.half_width) > 0.75

figure, ax = plt.subplots(figsize=(6.2, 3.0), layout="constrained")
for foot, mark in (("left", "<"), ("right", ">")):
    one = found.at_foot(foot)
    ax.errorbar(np.abs(one.speed), one.energy_ratio, one.half_width, fmt=mark, ms=4, capsize=2,
                label=f"{foot} foot lands")  # fmt: skip
    ax.axhline(ratio[foot], color="0.5", lw=0.7, ls="--")
ax.set(xlabel=r"speed before the impact $|\dot\theta|$ [rad/s]", ylabel="r [-]")
ax.legend(loc="center right")
plt.show()

# %% [markdown]
# *Figure 3. r of each impact with its 95 % interval, by the foot that lands; dashed, what was put
# in. The slower the impact, the wider the interval.*
#
# One interval in twenty misses: that is what 95 % means. The feet differ without doubt, and
# the mean over both would describe no impact of this block.

# %%
left, right = (found.at_foot(foot).mean() for foot in ("left", "right"))
for foot, mean in (("left", left), ("right", right)):
    print(f"{foot:5s} {mean.energy_ratio:.4f} ± {mean.half_width:.4f}, put in {ratio[foot]}")
    assert abs(mean.energy_ratio - ratio[foot]) < 2 * mean.half_width
assert left.energy_ratio + left.half_width < right.energy_ratio - right.half_width
print("all impacts alike?", found.mean())

# %% [markdown]
# ## 4. The force of an impact, and what the record knows of it
#
# The rotation has a bend at an impact: its rate falls from $v$ to $e v$ at once, $e = \sqrt r$. A
# derivative over a window $T$ makes of it an acceleration of about $(1-e)v/T$. Multiply by $m R$
# and you have a "force". It depends on $T$, which is ours, and not on the duration of the impact,
# which is the block's. It is a lower bound, and no more.
#
# The largest of many noisy samples is large by noise alone; to see the rest, this section has a
# tenth of it.

# %%
gain = np.array([analysis.identification.kink_gain(h, window) for window in (0.02, 0.04, 0.08)])
assert np.allclose(gain[:-1] / gain[1:], 2.0, rtol=0.06)  # half the window, twice the force

figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.0), layout="constrained")
calm = analysis.MeasuredRecord(t, {"theta": exact + rng.normal(0.0, sigma / 10, len(t))})
for window, mark in ((0.04, "o"), (0.08, "s")):
    forces = analysis.identification.impact_forces_of_record(calm, window=window, **shape)
    fast = np.abs(forces.speed) > 0.3
    for ax, force, base in (
        (axes[0], forces.horizontal, forces.baseline_horizontal),
        (axes[1], forces.vertical, forces.baseline_vertical),
    ):
        ax.plot(np.abs(forces.speed)[fast], np.abs(force)[fast] / 1e3, mark, ms=4,
                label=f"window {window} s")  # fmt: skip
        ax.plot(np.abs(forces.speed)[fast], np.abs(base)[fast] / 1e3, "k_", ms=6)
for ax, name in zip(axes, ("horizontal", "vertical"), strict=True):
    ax.set(xlabel="speed before the impact [rad/s]", ylabel=f"largest {name} force [kN]")
axes[0].legend()
plt.show()

# %% [markdown]
# *Figure 4. The largest force about each impact by two windows, and (dashes) the force of the block
# just before it. One and the same impact, without any duration, has two "forces".*
#
# Worse: look at the centroid. Just before the impact it falls with $R\sin\alpha\,v$, just after it
# rises with $R\sin\alpha\,e v$. The vertical impulse is
#
# $$J_V = m R \sin\alpha\,(1 + e)\,v, \tag{6}$$
#
# but in $\theta(t)$ there is only the bend $(1-e)v$. A record of the rotation shows the fraction
# $(1-e)/(1+e)$ of the vertical impulse, here a few hundredths, however fast it is sampled.

# %%
hit = run.impacts[0]
v, after = abs(hit.before["theta_dot"]), abs(hit.after["theta_dot"])
shown = (v - after) / (v + after)
print(f"shown of the vertical impulse: {100 * shown:.1f} %")
assert shown < 0.1

# %% [markdown]
# Away from the impacts the forces of 3-8 and 3-9 are good, and their interval says how good.

# %%
support = analysis.identification.support_forces_of_record(record, window=0.1, **shape)
rows = np.flatnonzero(support.smooth & (t < 3))[::5]
rates = run.at(t[rows])["theta_dot"]
vertical = np.array(
    [
        sum(block.reactions({"theta": x, "theta_dot": w})[f"{f}_reaction"] for f in ratio)
        for x, w in zip(exact[rows], rates, strict=True)
    ]
)
inside = np.abs(support.vertical[rows] - vertical) <= support.vertical_half_width[rows]
print(f"{100 * inside.mean():.0f} % within the interval")
assert inside.mean() > 0.9

# %% [markdown]
# ## 5. Frequencies that change
#
# The block rocks faster and faster. A spectrum of the whole record would mix all of it, so we take
# that of a window and move it along. A window of length $T$ cannot resolve frequencies nearer than
# about $1/T$,
#
# $$\Delta f \approx \frac{1}{T}, \tag{7}$$
#
# and what changes within it is averaged. There is no best window, only a choice.

# %%
figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.0), sharey=True, layout="constrained")
hits = np.array([hit.time for hit in run.impacts.above(0.02)])
middle, own = (hits[1:] + hits[:-1]) / 2, 0.5 / np.diff(hits)  # of a cycle, two half-cycles
for ax, window in zip(axes, (0.5, 1.5), strict=True):
    spectra = analysis.identification.moving_window(
        record, "theta", window=window, step=10, frequencies=(0.3, 8)
    )
    ax.pcolormesh(spectra.time, spectra.frequency, spectra.amplitude.T, cmap="Greys")
    ax.plot(spectra.time, spectra.dominant, label="largest")
    ax.plot(middle, own, "--", label="between impacts")
    ax.set(xlabel="time [s]", title=f"window {window} s, {spectra.bandwidth:.1f} Hz", ylim=(0, 8))
    inside = (spectra.time > 1.5) & (spectra.time < 3.2)
    error = spectra.dominant[inside] - np.interp(spectra.time[inside], middle, own)
    assert np.abs(error).max() < spectra.bandwidth / 2
axes[0].set_ylabel("frequency [Hz]")
axes[0].legend(loc="upper left")
plt.show()

# %% [markdown]
# *Figure 5. The spectrum of a moving window, of two lengths. Dashed: one over the time of two
# half-cycles.*
#
# ## Exercises
#
# 1. Show (2): the squares of the binomial coefficients of order $n$ add to $\binom{2n}{n}$.
#    *Hint: compare the coefficients of $x^n$ in $(1+x)^n(1+x)^n = (1+x)^{2n}$.*
# 2. Filter the record with `record.low_pass(25.0)` before `noise_level`. What is wrong with what
#    comes out, and what does `record.low_pass(25.0).noise` say instead?
#    *Hint: (2) needs errors that know nothing of one another.*
# 3. Give the block equal feet, r = 0.85, and noise of 0.2 degrees. Down to which energy do you know
#    r within 5 %? *Hint: (5) and `half_width`; use `threshold`.*
# 4. Let the impact last: replace the jump of the rate by a straight fall over 20 ms. Which windows
#    now give a force that is the impact's own?
#    *Hint: the acceleration is then finite; compare windows below and above 20 ms.*
# 5. Use `points_by_score` and `points_by_prominence` of `rockeom.thesis.points_of_interest` on the
#    record. Which peaks does the window of half a second miss, and why? *Hint: compare it with the
#    time between peaks.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# The coefficient of $x^n$ in $(1+x)^{2n}$ is $\binom{2n}n$. In $(1+x)^n(1+x)^n$ it is
# $\sum_j\binom nj\binom n{n-j}$, and $\binom n{n-j} = \binom nj$.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# Next to nothing comes out, a billionth of a degree. Differences of the sixth order see only what
# is fast, and that the filter has taken: what is left of the noise is slow, and its neighbouring
# samples know of one another. The record itself carries its noise through the filter by (3) and
# says 0.004 degrees.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# Down to about 9 J before the impact, a third of the first one. By (5) the limit is at a rotation
# of some fifty standard deviations of a fitted peak, which the half-cycles, ever shorter, determine
# less and less well.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# Windows up to the duration of the impact give its own acceleration, $(1-e)v$ over 20 ms, within
# some per cent. One of 80 ms gives three quarters of it, and knows it as little as before. But a
# window of 20 ms has eight times the noise in the rate of one of 80 ms, and thirty-two times in the
# acceleration.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# It misses the last three, from 4.5 s on. There a whole cycle takes 0.36 s and less, and the higher
# peak before, on the same side, stands within the window. Prominence has no window, and finds them
# until they drown in the noise.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
for order in range(1, 12):
    assert sum(comb(order, j) ** 2 for j in range(order + 1)) == comb(2 * order, order)

smooth = record.low_pass(25.0)
assert analysis.identification.noise_level(t, smooth["theta"]) < 1e-6 * sigma
assert 0.1 < smooth.noise["theta"].level / sigma < 0.3

equal = rk.simulate(
    block,
    rk.GroundMotion.none(5.0),
    initial={"theta": np.radians(7.876)},
    impact=rk.EnergyRatio(0.85),
)
coarse = equal.at(t)["theta"] + rng.normal(0.0, 10 * sigma, len(t))
noisy = analysis.MeasuredRecord(t, {"theta": coarse})
measured = analysis.identification.Impacts.of_record(noisy, block, threshold=1.0)
sure = measured.half_width < 0.05 * measured.energy_ratio
print(f"r to 5 % down to {measured.energy_before[sure].min():.1f} J")
assert 8.0 < measured.energy_before[sure].min() < 11.0
assert measured.energy_before[~sure].max() < 9.0

lasting, rate_before, share = 0.02, 0.4, 0.9  # s, rad/s, -
moments = np.arange(-0.2, 0.2, 1e-4)
fallen = np.clip(moments / lasting + 0.5, 0.0, 1.0)
rate = rate_before * (1 - (1 - share) * fallen)
turned = np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2) * 1e-4])
slow = analysis.MeasuredRecord(moments, {"theta": turned})
true = (1 - share) * rate_before / lasting
for window, least, most in [(0.01, 0.99, 1.1), (0.02, 0.99, 1.1), (0.08, 0.5, 0.8)]:
    largest = np.abs(slow.with_derivatives("theta", window=window)["theta_ddot"]).max()
    assert least < largest / true < most

by_score, by_prominence = (
    t[found.peaks]
    for found in (
        points_by_score(record, "theta"),
        points_by_prominence(record, "theta"),
    )
)
assert np.array_equal(by_prominence[:-3], by_score)
assert by_prominence[-3] - by_prominence[-5] < 0.36
