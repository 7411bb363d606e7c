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
#     figure: 4
#     level: graduate
#     minutes: 90
# ---

# %% [markdown]
# # Phase plane, saltation and chaos
#
# Two blocks start side by side. Do they stay side by side? Between impacts the equation of motion
# answers; at an impact a jump comes in, and the two do not even jump at the same time. One small
# matrix settles it. With it we find out which periodic motions last, where they give way to others,
# and whether what comes in the end is chaos: by formulas first, and then with the engine, which
# carries the same matrix through the impacts of every structure.
#
# ## Aims
#
# After this notebook you can
#
# 1. draw the phase portrait of the block, with its separatrix and what impacts do to it;
# 2. derive the saltation matrix of an impact, and say why it is not the derivative of the jump;
# 3. compute the multipliers of a periodic motion in closed form, and where its symmetry breaks;
# 4. follow a cascade of period doublings to its end, and say how well you know that end;
# 5. compute a Lyapunov exponent with its uncertainty, and check it without any theory.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom import analysis
from rockeom.plots import free_body as fb, use_style
from rockeom.teaching import Exercises

use_style()

# %% [markdown]
# ## 1. The phase plane
#
# In $x=\theta/\alpha$ and $t=p\tau$ the slender block obeys
# (see [one block for all sizes](nondimensional_block.py))
#
# $$\ddot x = x - s - \beta\cos\omega t, \qquad s = \operatorname{sgn}x, \tag{1}$$
#
# and at an impact, $x = 0$, its rate is multiplied by $e$. Without shaking, $\beta=0$, each half of
# the plane is filled by hyperbolas
#
# $$\dot x^2 - (1-|x|)^2 = \text{const}, \tag{2}$$
#
# about the balances $x=\pm1$. The asymptotes, where the constant is zero, are the *separatrices*.
# The impact is a jump along the axis $x = 0$, towards the origin. Which states fall? For $x>0$, by
# [overturning](overturning.py), those with $x + \dot x>1$, to the right; and to the left those that
# come down so fast that the impact leaves them more than the speed 1:
#
# $$\dot x < 0, \qquad e^2\left[\dot x^2 - (1-x)^2 + 1\right] > 1. \tag{3}$$

# %%
unit_block = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)  # seconds are units of t
alpha = unit_block.alpha
unit = alpha * unit_block.gravity  # beta = 1
sparse = rk.SolverOptions(output_step=100.0)

quiet = rk.GroundMotion.none(60.0)
lossy = rk.VelocityRatio(0.9)


def released(x, rate):
    start = {"theta": alpha * x, "theta_dot": alpha * rate}
    return rk.Case(unit_block, quiet, impact=lossy, initial=start)


def falls(x, rate, e):
    """Whether a slender block falls from a state, without shaking; (3) and its mirror image."""
    side = np.where(x == 0, np.sign(rate), np.sign(x))
    x, rate = side * x, side * rate
    landing = rate**2 - (1 - x) ** 2 + 1
    return (x + rate > 1) | ((rate < 0) & (e**2 * landing > 1))


starts = {"x": np.linspace(-1.5, 1.5, 41), "rate": np.linspace(-1.6, 1.6, 41)}
sweep = rk.simulate_many(released, over=starts)
fell = sweep.outcome.values == "overturned"
places, rates = np.meshgrid(*starts.values(), indexing="ij")
clear = np.abs(np.abs(places + rates) - 1) > 1e-9  # on the separatrix nobody falls or returns
assert (fell == falls(places, rates, 0.9))[clear].all()

# %%
figure, ax = plt.subplots(figsize=(5.8, 4.2), layout="constrained")
fine = np.meshgrid(np.linspace(-1.5, 1.5, 601), np.linspace(-1.6, 1.6, 601))
ax.contourf(*fine, falls(*fine, 0.9), levels=[0.5, 1.5], colors=["#f3d9c9"])
constant = fine[1] ** 2 - (1 - np.abs(fine[0])) ** 2
ax.contour(*fine, constant, [-0.75, -0.5, -0.25, 0.5, 1.0], colors="0.75", linewidths=0.7,
           linestyles="-")  # fmt: skip
ax.contour(*fine, constant, [0.0], colors=[fb.LINES[1]], linewidths=1.2)
case = released(0.97, 0.0)
run = rk.simulate(case.structure, quiet, impact=lossy, initial=case.initial)
ax.plot(run["theta"] / alpha, run["theta_dot"] / alpha, color=fb.LINES[0])
ax.plot([-1, 1], [0, 0], "o", color=fb.LINES[1], ms=5)
ax.annotate("balance", (1, 0), (6, 7), textcoords="offset points", color=fb.LINES[1], fontsize=8.5)
ax.annotate("falls", (0.85, 1.1))
ax.annotate("falls after\nan impact", (0.22, -1.45))
ax.set(xlabel=r"$x$", ylabel=r"$\dot x$")
plt.show()

# %% [markdown]
# *Figure 1. The phase plane of a slender block, $e=0.9$. Grey: hyperbolas (2); orange:
# separatrices; blue: a motion released near the balance. From the coloured regions the block falls;
# the engine agrees on all points of a grid.*
#
# ## 2. Saltation: what an impact does to a small difference
#
# A motion lands at the time $t^*$ with the rate $v_-<0$. Its neighbour differs from it by a small
# $\boldsymbol\delta_- = (\delta x, \delta v)$. It is late or early by $\tau$, and for that short
# time one of the two has jumped and the other has not. We compare them when both have.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(6.4, 3.4), layout="constrained")
times = np.linspace(-1, 1, 401)


def leg(landing, speed, before, after):
    since = times - landing
    return np.where(
        since < 0, -speed * since + before * since**2, -0.62 * speed * since + after * since**2
    )


shown = [(0.0, 0.9, -0.1, 0.16), (0.27, 1.0, -0.12, 0.16)]
for (landing, *numbers), color, label in zip(
    shown, (fb.INK, fb.LINES[0]), ("motion", "neighbour"), strict=True
):
    x = leg(landing, *numbers)
    ax.plot(times, x, color=color, label=label)
ax.axhline(0, color=fb.INK, lw=0.8)
ax.axvline(0, color="0.7", lw=0.8, ls=":")
now = np.argmin(np.abs(times))
late = leg(*shown[1])
ax.annotate("", (0, late[now]), (0, 0), arrowprops={"arrowstyle": "<->", "color": fb.FORCE})
ax.annotate(r"$\delta x$", (-0.02, late[now] / 2), ha="right", va="center", color=fb.FORCE)
ax.annotate("", (0, -0.42), (0.27, -0.42), arrowprops={"arrowstyle": "<->", "color": fb.FORCE})
ax.annotate(r"$\tau$", (0.135, -0.4), ha="center", va="bottom", color=fb.FORCE)
ax.annotate(r"$v_-,\ a_-$", (-0.8, 0.3))
ax.annotate(r"$e\,v_-,\ a_+$", (0.62, 0.06))
ax.annotate(r"$t^*$", (0, -0.62), ha="center")
ax.set(xlabel="time", ylabel="$x$", xticks=[], yticks=[], ylim=(-0.66, 1.0))
ax.legend(loc="upper right")
plt.show()

# %% [markdown]
# *Figure 2. Two motions land. A difference of place before becomes one of time, and that becomes a
# difference of rate after, because the accelerations on both sides differ.*
#
# To first order the neighbour lands when $\delta x + v_-\tau = 0$. Then its rate is
# $v_- + \delta v + a_-\tau$; the impact multiplies it by $e$. Traced back to $t^*$ with the rate
# and the acceleration $a_+$ of *after* the impact, this is where the neighbour would have come
# from.

# %%
e, eps, dx, dv, v, before, after = sp.symbols("e epsilon delta_x delta_v v_- a_- a_+", real=True)
tau = -eps * dx / v  # late by so much
landed = e * (v + eps * dv + before * tau)  # its rate after its impact
traced_back = sp.Matrix([-landed * tau, landed - after * tau])
difference = traced_back.diff(eps).subs(eps, 0)
saltation = difference.jacobian([dx, dv]).applyfunc(sp.simplify)
claim = sp.Matrix([[e, 0], [(after - e * before) / v, e]])
assert sp.simplify(saltation - claim) == sp.zeros(2)
assert sp.simplify(claim.det() - e**2) == 0
sp.Eq(sp.MatrixSymbol("S", 2, 2), claim)

# %% [markdown]
# $$\boldsymbol\delta_+ = \mathbf S\,\boldsymbol\delta_-, \qquad
#   \mathbf S = \begin{bmatrix} e & 0 \\ \dfrac{a_+ - e\,a_-}{v_-} & e \end{bmatrix}, \qquad
#   \det\mathbf S = e^2. \tag{4}$$
#
# This is the *saltation matrix* (Aizerman and Gantmakher 1958; Müller 1995). The derivative of the
# jump itself, $\operatorname{diag}(1, e)$, has another determinant, and misses the entry below the
# diagonal. That entry is what makes rocking wild: the two accelerations have opposite signs, and a
# slow impact, small $v_-$, makes it large.
#
# Between impacts (1) is $\dot{\boldsymbol\delta} = \begin{bmatrix}0&1\\1&0\end{bmatrix}
# \boldsymbol\delta$ whatever the shaking, so that after the time $t$
#
# $$\boldsymbol\Phi(t) = \begin{bmatrix}\cosh t & \sinh t\\ \sinh t & \cosh t\end{bmatrix},
#   \qquad \det\boldsymbol\Phi = 1. \tag{5}$$
#
# Areas of the phase plane shrink at impacts, by $e^2$, and nowhere else. `rk.tangents` gives the
# derivatives of a motion along the directions of the `Dual` numbers in its case. We compare its
# product of all legs and impacts with ours.

# %%
t, lam = sp.symbols("t lambda", positive=True)
flow = sp.Matrix([[sp.cosh(t), sp.sinh(t)], [sp.sinh(t), sp.cosh(t)]])
assert flow.diff(t) == sp.Matrix([[0, 1], [1, 0]]) * flow
assert sp.simplify(flow.det()) == 1


def phi(t):
    """(5)."""
    return np.array([[math.cosh(t), math.sinh(t)], [math.sinh(t), math.cosh(t)]])


def S(before, after, v, e):
    """(4)."""
    return np.array([[e, 0], [(after - e * before) / v, e]])


beta, omega, ratio = 2.0, 2 * math.pi / 3, 0.5
shaking = rk.GroundMotion.harmonic(
    beta * unit, angular_frequency=omega, phase=math.pi / 2, duration=6.5
)
start = {"theta": rk.Dual(-0.03, np.array([1.0, 0.0])),
         "theta_dot": rk.Dual(0.0, np.array([0.0, 1.0]))}  # fmt: skip
carried = rk.tangents(rk.Case(unit_block, shaking, impact=rk.VelocityRatio(ratio), initial=start))
product, now = np.eye(2), 0.0
for impact in carried.response.impacts:
    push = -beta * math.cos(omega * impact.time)
    side = -np.sign(impact.before["theta_dot"])  # where it comes from
    jump = S(-side + push, side + push, impact.before["theta_dot"] / alpha, ratio)
    product, now = jump @ phi(impact.time - now) @ product, impact.time
product = phi(6.5 - now) @ product
assert len(carried.response.impacts) >= 4
assert np.allclose(carried.end, product, rtol=1e-8, atol=0)
assert math.isclose(
    np.linalg.det(carried.end), ratio ** (2 * len(carried.response.impacts)), rel_tol=1e-6
)

# %% [markdown]
# The same matrix (4) is found at the impacts of a squat block, whose equation is not linear, under
# any shaking. The engine gives the derivatives *at* a passage, which itself moves; those at fixed
# time are less by the rate of the state times the derivative of the instant.

# %%
squat = rk.RigidBlock(half_width=0.3, half_height=0.5)
two_sines = rk.GroundMotion.harmonic(6.0, period=0.7, duration=3.0)
found = rk.tangents(rk.Case(squat, two_sines, initial=start))
checked = 0
for k, event in enumerate(found.response.events):
    if event.kind != "impact":
        continue
    ground = two_sines.acceleration(event.time)
    sides = ("right", "left") if event.before["theta_dot"] < 0 else ("left", "right")
    a_minus, a_plus = (
        squat.accelerations({"theta": 0.0}, ground_acceleration=ground, mode=side)["theta"]
        for side in sides
    )
    v_minus, v_plus = event.before["theta_dot"], event.after["theta_dot"]
    moved = found.event_times[k]
    fixed_before = found.before[k] - np.outer([v_minus, a_minus], moved)
    fixed_after = found.after[k] - np.outer([v_plus, a_plus], moved)
    ours = S(a_minus, a_plus, v_minus, v_plus / v_minus)
    assert np.allclose(fixed_after, ours @ fixed_before, rtol=1e-7, atol=1e-7)
    checked += 1
assert checked >= 3

# %% [markdown]
# ## 3. A periodic motion, and whether it lasts
#
# Under (1) there are symmetric motions with one impact on each side in a period: half a period
# later all is mirrored. Let one leave the ground to the right with the rate $v$ at the phase
# $\varphi$ of the ground. In [one block for all sizes](nondimensional_block.py) we had
#
# $$x = 1 + a\cosh t + b\sinh t + C\cos(\omega t+\varphi), \qquad C = \frac\beta{1+\omega^2},
#   \tag{6}$$
#
# with $x=0$ and $\dot x = v$ at the start, $x = 0$ and $\dot x = -v/e$ after half a period. With
# $T = \tanh\frac{\pi}{2\omega}$ these give
#
# $$C\cos\varphi = -\frac{1-e}{2e}\,T\,v, \qquad
#   \omega\,C\sin\varphi = T - \frac{1+e}{2e}\,v, \tag{7}$$
#
# and squared and added, how strong the ground must shake for a motion with $v$:
#
# $$\beta^2 = (1+\omega^2)^2\left[\left(\frac{1-e}{2e}\,T\,v\right)^2
#   + \frac1{\omega^2}\left(T - \frac{1+e}{2e}\,v\right)^2\right]. \tag{8}$$

# %%
a, b, c, sigma, speed = sp.symbols("a b c sigma v", real=True)
T, w, rho = sp.symbols("T omega e", positive=True)
ch, sh = (1 + T**2) / (1 - T**2), 2 * T / (1 - T**2)  # of pi/omega, T being tanh of its half
conditions = [
    1 + a + c,  # upright at the start
    b - sigma - speed,  # leaves with v
    1 + a * ch + b * sh - c,  # upright half a period later
    a * sh + b * ch + sigma + speed / rho,  # lands with v/e
]
(solved,) = sp.solve(conditions, [a, b, c, sigma], dict=True)
assert sp.simplify(solved[c] + (1 - rho) / (2 * rho) * T * speed) == 0
assert sp.simplify(solved[sigma] - (T - (1 + rho) / (2 * rho) * speed)) == 0

# %% [markdown]
# Now the derivative of half a period, seen in the mirror: $\mathbf M = -\mathbf S\,
# \boldsymbol\Phi(\pi/\omega)$. Its eigenvalues squared are Floquet's *multipliers*, by which a
# small difference changes in a period. Just before the landing the acceleration is $-1 +
# \beta\cos\varphi$, just after $1 + \beta\cos\varphi$. With (7)
#
# $$\det\mathbf M = e^2, \qquad \operatorname{tr}\mathbf M = \frac{e\,(1+e)}{v}\sinh\frac\pi\omega
#   - 2e\cosh\frac\pi\omega - \tfrac12(1-e)^2(1+\omega^2)\left(\cosh\frac\pi\omega - 1\right).
#   \tag{9}$$

# %%
push = (1 + w**2) * solved[c]  # beta cos(phi)
jump = claim.subs({e: rho, v: -speed / rho, before: -1 + push, after: 1 + push})
half = -jump * sp.Matrix([[ch, sh], [sh, ch]])
trace = (
    rho * (1 + rho) / speed * sh
    - 2 * rho * ch
    - sp.Rational(1, 2) * (1 - rho) ** 2 * (1 + w**2) * (ch - 1)
)
assert sp.simplify(half.det() - rho**2) == 0
assert sp.simplify(half.trace() - trace) == 0

# %% [markdown]
# The determinant is all that impacts take. The trace decides: the motion lasts while both
# eigenvalues are inside the unit circle, $|\operatorname{tr}\mathbf M| < 1+e^2$. So
#
# $$v_{\text{fold}} = \frac{e(1+e)\sinh\frac\pi\omega}{1+e^2+K}, \quad
#   v_{\text{sym}} = \frac{e(1+e)\sinh\frac\pi\omega}{K-1-e^2}, \quad
#   K = 2e\cosh\tfrac\pi\omega + \tfrac12(1-e)^2(1+\omega^2)(\cosh\tfrac\pi\omega-1). \tag{10}$$
#
# At $v_{\text{fold}}$ an eigenvalue is $+1$: the branch turns back, and two motions meet. At
# $v_{\text{sym}}$ one is $-1$: a difference changes its sign in each mirrored half, so that of the
# two halves one becomes larger than the other. The symmetry breaks. Hogan (1989) found both. With
# $e=0.5$ and $\omega=\frac23\pi$, the numbers of Figure 2-12 of the thesis:


# %%
def amplitude(v, e=ratio, omega=omega):
    """beta of (8)."""
    T = math.tanh(math.pi / (2 * omega))
    cosine, sine = (1 - e) / (2 * e) * T * v, (T - (1 + e) / (2 * e) * v) / omega
    return (1 + omega**2) * np.hypot(cosine, sine)


def trace_of(v, e=ratio, omega=omega):
    """(9)."""
    cosh, sinh = math.cosh(math.pi / omega), math.sinh(math.pi / omega)
    lasting = 2 * e * cosh + 0.5 * (1 - e) ** 2 * (1 + omega**2) * (cosh - 1)
    return e * (1 + e) * sinh / v - lasting


def limits(e=ratio, omega=omega):
    """v of the fold and of the break of symmetry (10)."""
    gain, K = e * (1 + e) * math.sinh(math.pi / omega), -trace_of(math.inf, e, omega)
    return gain / (1 + e**2 + K), gain / (K - 1 - e**2)


v_fold, v_sym = limits()
for name, speed_there in [("fold", v_fold), ("symmetry breaks", v_sym)]:
    print(f"{name:16s} v = {speed_there:.8f}, beta = {amplitude(speed_there):.10f}")

# %% [markdown]
# The engine knows nothing of (6) to (10). It finds the periodic motion by Newton's method with the
# derivative that it carries through the impacts, and follows it along the branch, past the fold
# too. A `mirrored` map looks every half period and then in a mirror.


# %%
def family(beta, shift=0.5, mirrored=True, options=None):
    """The map of the block under (1); it begins at another phase, at which no impact falls."""
    motion = rk.GroundMotion.harmonic(
        beta * unit, angular_frequency=omega, phase=math.pi / 2 - shift, duration=600.0
    )
    law = rk.VelocityRatio(ratio)
    return analysis.dynamics.StroboscopicMap(
        unit_block, motion, 3.0, impact=law, mirrored=mirrored, options=options
    )


settled = family(1.5).points({"theta": 0.03}, cycles=100)[-1]
symmetric = analysis.dynamics.orbit_branch(family, between=(1.5, 2.8), guess=settled, step=0.03)
(breaks,) = symmetric.bifurcations
assert breaks.kind == "symmetry breaking"
assert math.isclose(breaks.value, amplitude(v_sym), rel_tol=1e-9)


def early(beta):
    return family(beta, shift=1.3)


settled_early = early(1.5).points({"theta": 0.03}, cycles=100)[-1]
downwards = analysis.dynamics.orbit_branch(
    early, between=(1.5, 0.4), guess=settled_early, step=0.05
)
fold = downwards.bifurcations[0]
assert fold.kind == "fold"
assert math.isclose(fold.value, amplitude(v_fold), rel_tol=1e-9)
for branch in (symmetric, downwards):
    for value, orbit in zip(branch.values, branch.orbits, strict=True):
        v_orbit = ratio * abs(orbit.at_impacts("theta_dot")[0]) / alpha
        assert math.isclose(amplitude(v_orbit), value, rel_tol=1e-7)
        assert math.isclose(np.linalg.det(orbit.derivative), ratio**2, rel_tol=1e-6)
        assert math.isclose(np.trace(orbit.derivative), trace_of(v_orbit), abs_tol=1e-5)

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, (curve, circle) = plt.subplots(
    1, 2, figsize=(8.0, 3.7), layout="constrained", width_ratios=[1.35, 1]
)
speeds = np.linspace(0.12, 1.15, 400)
for low, high, dashes in [(0, v_fold, "--"), (v_fold, v_sym, "-"), (v_sym, 2, "--")]:
    there = speeds[(speeds >= low) & (speeds <= high)]
    curve.plot(amplitude(there), there, dashes, color=fb.LINES[0])
for branch, every in ((symmetric, 4), (downwards, 4)):
    engine = ratio * np.abs(branch.at_impacts("theta_dot")[:, 0]) / alpha
    curve.plot(branch.values[::every], engine[::every], "o", ms=4, mfc="white", color="black")
for v_there, label, offset in [(v_fold, "fold", (-26, -4)), (v_sym, "symmetry breaks", (-80, 8))]:
    curve.plot(amplitude(v_there), v_there, "D", color=fb.LINES[1], ms=5, zorder=3)
    curve.annotate(label, (amplitude(v_there), v_there), offset, textcoords="offset points",
                   fontsize=8.5)  # fmt: skip
curve.set(xlabel=r"$\beta$", ylabel="$v$ after an impact", xlim=(0.3, 2.9), ylim=(0, 1.15))
angle = np.linspace(0, 2 * np.pi, 200)
circle.plot(np.cos(angle), np.sin(angle), color=fb.INK, lw=0.9)
circle.plot(ratio * np.cos(angle), ratio * np.sin(angle), ":", color=fb.INK, lw=0.9)
along = np.linspace(0.33, 0.85, 60)
roots = np.array([np.roots([1, -trace_of(one), ratio**2]) for one in along])
points = circle.scatter(
    roots.real, roots.imag, c=np.repeat(along, 2), s=12, cmap="viridis", zorder=3
)
figure.colorbar(points, ax=circle, label="$v$")
circle.set(aspect="equal", xlabel="real part", ylabel="imaginary part")
plt.show()

# %% [markdown]
# *Figure 3. Left: the symmetric motions, (8), full where they last; circles are the engine's.
# Right: the eigenvalues of $\mathbf M$ along the branch. They enter the unit circle at $+1$, run
# round the circle of radius $e$ (dotted), for their product is $e^2$, and leave at $-1$.*
#
# ## 4. The cascade
#
# Behind the break of symmetry there are two motions, each the other's mirror image. As the shaking
# grows, a multiplier of these passes $-1$, too: they double their period, and so on. Each of these
# points is a zero of a smooth function of $\beta$, and can be found with ten digits.

# %%
cascade = analysis.dynamics.period_doublings(family, between=(1.5, 2.8), guess=settled, number=4)
for one in cascade.bifurcations:
    print(f"{one.kind:18s} beta = {one.value:.9f}")
print("ratios of distances", np.round(cascade.ratios, 3))
print("accumulation", np.round(cascade.accumulations, 6))
assert [one.kind for one in cascade.bifurcations] == ["symmetry breaking", *["period doubling"] * 4]
assert abs(cascade.ratios[-1] - 4.669) < 0.05
end = cascade.accumulations[-1]
assert abs(end - cascade.accumulations[-2]) < 1e-4

# %% [markdown]
# The distances shrink by a factor that tends to Feigenbaum's 4.669, the same for all systems that
# do this. With it the end of the series is extrapolated; how far the last two extrapolations differ
# says how well it is known. Now the picture: the engine runs the block at many amplitudes, forgets
# the first 150 periods, and notes the rate at each impact of the next 32.

# %%
values = np.concatenate([np.linspace(1.5, 2.6, 45), np.linspace(2.6, 2.74, 57)[1:]])
rough = rk.SolverOptions(rtol=1e-8, atol=1e-10, output_step=100.0)
sections = analysis.dynamics.poincare_sections(
    lambda beta: family(beta, mirrored=False, options=rough),
    over={"beta": values},
    starts=[dict(zip(unit_block.states, settled, strict=True))],
    settling=150,
    cycles=32,
    impacts=2,
)
after_impacts = sections.impact_state.sel(state="theta_dot", side="after").values
dots = np.abs(after_impacts.reshape(len(values), -1)) / alpha
broken = symmetric.switched(breaks)
doubled = broken.switched(broken.bifurcations[0])

figure, ax = plt.subplots(figsize=(7.0, 4.2), layout="constrained")
ax.plot(values, dots, ".", ms=1.6, mew=0, color=fb.INK)
for branch, color in zip((symmetric, broken, doubled), fb.LINES, strict=False):
    lines = ratio * np.sort(np.abs(branch.at_impacts("theta_dot")), axis=1) / alpha
    next_to_it = np.convolve(~branch.stable, [1, 1, 1], "same") > 0  # no gap where it changes
    for there, dashes in ((branch.stable, "-"), (next_to_it, "--")):
        shown = np.where(there[:, None], lines, np.nan)
        ax.plot(branch.values, shown, dashes, color=color, lw=1.0, alpha=0.9)
for one in cascade.values:
    ax.axvline(one, color="0.8", lw=0.7, zorder=0)
ax.axvline(end, color=fb.FORCE, lw=0.9, ls=":")
ax.set(xlabel=r"$\beta$", ylabel="rate after an impact", xlim=(1.5, 2.8))
plt.show()

# %% [markdown]
# *Figure 4. Where the motion ends up (dots), and the motions that exist, lasting (full) or not
# (dashed): symmetric, with the symmetry broken, with the period doubled. Grey: the points of the
# cascade; dotted: their end. The branches go on where the dots have left them.*
#
# Figure 2-12 of the thesis shows this for a squat block, $\alpha=\arctan\frac12$;
# `rockeom thesis figure 2-12` draws it.
#
# ## 5. Chaos, and how to recognise it
#
# Behind the end of the cascade the dots fill bands. Is that chaos, or just a long period? A picture
# cannot decide. The mean rate at which small differences grow can,
#
# $$\lambda = \lim_{t\to\infty}\frac1t\,\ln\frac{|\boldsymbol\delta(t)|}{|\boldsymbol\delta(0)|},
#   \tag{11}$$
#
# the largest *Lyapunov exponent*. And we have $\boldsymbol\delta(t)$: it is what `rk.tangents`
# carries. As a check without any theory, two runs from starts that differ by $10^{-9}$.

# %%
length = 300 * 3.0


def motion(beta, duration=length):
    return rk.GroundMotion.harmonic(
        beta * unit, angular_frequency=omega, phase=math.pi / 2 - 0.5, duration=duration
    )


def growth(beta, times):
    """Logarithm of how much a small difference has grown at times (n,), from `settled` on."""
    begin = {
        name: rk.Dual(float(value), np.array([one]))
        for name, value, one in zip(unit_block.states, settled, (alpha, 0.0), strict=True)
    }
    case = rk.Case(unit_block, motion(beta), impact=rk.VelocityRatio(ratio), initial=begin)
    return np.log(np.abs(rk.tangents(case, sparse).at(times)[:, :, 0]).max(axis=1) / alpha)


def apart(beta, times, distance=1e-9):
    """The same of two runs, over their distance at the start."""
    ends = []
    for moved in (0.0, distance * alpha):
        begin = dict(zip(unit_block.states, settled + np.array([moved, 0.0]), strict=True))
        run = rk.simulate(
            unit_block, motion(beta), impact=rk.VelocityRatio(ratio), initial=begin,
            options=rk.SolverOptions(rtol=1e-12, atol=1e-14, output_step=1.0),
        )  # fmt: skip
        found = run.at(times)
        ends.append(np.array([found[name] for name in unit_block.states]))
    return np.log(np.abs(ends[1] - ends[0]).max(axis=0) / (distance * alpha))


# %%
times = 3.0 * np.arange(1, 90)
figure, ax = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
for beta_run, color in zip((2.7, 2.4), fb.LINES, strict=False):
    carried, measured = growth(beta_run, times), apart(beta_run, times)
    ax.plot(times, carried, color=color, label=rf"$\beta = {beta_run}$, carried")
    ax.plot(times, measured, ".", ms=4, color=color, label="two runs")
    if beta_run == 2.7:
        small = measured < math.log(1e6)  # then the two are no longer close
        first = np.argmin(small) if not small.all() else len(small)
        assert np.abs(measured - carried)[:first].max() < 0.05
ax.axhline(math.log(1e9), color=fb.INK, ls=":", lw=0.9)
ax.annotate(r"distance $\approx\alpha$", (3, math.log(1e9) + 1), fontsize=8.5)
ax.set(xlabel="time $t$", ylabel=r"$\ln(|\delta|/|\delta_0|)$", ylim=(-35, 52))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 5. The growth of a small difference. At $\beta = 2.4$ it dies: the motion is periodic. At
# 2.7 it grows steadily. Two runs (dots) follow the derivative until they are as far apart as the
# motion is wide; that of $\beta=2.4$ ends in rounding errors.*
#
# After some 110 units of time, or 37 periods of the ground, nothing is left of nine digits. With
# twice as many one would get twice as far. To say what $\lambda$ is, one needs a long mean and its
# uncertainty. `lyapunov_spectrum` carries two directions, made orthogonal once a period, and takes
# the scatter of the means of batches.

# %%
spectrum = analysis.dynamics.lyapunov_spectrum(family(2.7, mirrored=False), settled, cycles=600)
low, high = spectrum.bounds(0.95)
print(f"exponents {spectrum.exponents.round(4)}, 95 % of the first: {low[0]:.3f} to {high[0]:.3f}")
assert low[0] > 0  # chaos
assert math.isclose(spectrum.exponents.sum(), 4 * math.log(ratio) / 3.0, rel_tol=1e-6)

calm = analysis.dynamics.lyapunov_spectrum(family(2.4, mirrored=False), settled, cycles=60)
assert calm.exponents[0] < 0

# %% [markdown]
# The sum of both exponents needs no simulation: areas shrink by $e^2$ at each impact, of which
# there are two in a period of 3,
#
# $$\lambda_1 + \lambda_2 = \frac{4\ln e}{3} = -0.924. \tag{12}$$
#
# A positive $\lambda_1$ stretches, impacts fold and shrink. That is the recipe of a strange
# attractor. Now $\lambda$ over the amplitudes of Figure 4:

# %%
begun, ended = 300.0, length
late = values[values > 1.9]
exponents = np.array([np.diff(growth(one, [begun, ended]))[0] for one in late])
exponents /= ended - begun
figure, ax = plt.subplots(figsize=(7.0, 3.2), layout="constrained")
ax.plot(late, exponents, ".-", lw=0.8, ms=3)
ax.axhline(0, color=fb.INK, lw=0.8)
for one in cascade.values:
    ax.axvline(one, color="0.8", lw=0.7, zorder=0)
ax.axvline(end, color=fb.FORCE, lw=0.9, ls=":")
ax.set(xlabel=r"$\beta$", ylabel=r"$\lambda$ [1/t]")
plt.show()
assert (exponents[late < cascade.values[1]] < 0.01).all()
assert exponents[late > 2.66].max() > 0.1
assert math.isclose(
    exponents[np.argmin(np.abs(late - 2.26))], 2 * math.log(ratio) / 3, rel_tol=0.02
)

# %% [markdown]
# *Figure 6. The largest Lyapunov exponent. It touches zero where the period doubles (grey) and is
# positive behind the end of the cascade (dotted), but in windows. On the level in the middle the
# two multipliers are complex, of one size, and $\lambda$ is half of (12).*
#
# A little beyond the last of these amplitudes the chaotic motion reaches states from which the
# block falls. From states of the motion at 2.74 it rocks on at 2.76 as before, and then it
# overturns:

# %%
lasted = []
for state in sections.strobe.isel(beta=-1, start=0, look=slice(0, 30)).values:
    begin = dict(zip(unit_block.states, state, strict=True))
    run = rk.simulate(
        unit_block, motion(2.76, 1000 * 3.0), impact=rk.VelocityRatio(ratio), initial=begin,
        options=sparse,
    )  # fmt: skip
    assert run.outcome is rk.Outcome.OVERTURNED
    lasted.append(run.t[-1] / 3)
print(f"periods until it falls: {min(lasted):.0f}, ..., {np.median(lasted):.0f}, ..., "
      f"{max(lasted):.0f}")  # fmt: skip
assert max(lasted) > 10 * min(lasted)

# %% [markdown]
# The time of the fall depends on digits of the start that nobody knows: only the mean duration of
# such transient chaos can be given.
#
# ## Exercises
#
# 1. **A coefficient of restitution that depends on the speed.** Let the rate after an impact be a
#    function $g(v_-)$. What is the saltation matrix now, and its determinant? *Hint: in the
#    derivation $e\,v$ becomes $g$ at the rate of landing; use its derivative $g'$.*
# 2. **After infinitely many impacts.** A free block comes to rest at $p\,t_\infty =
#    \operatorname{artanh} v_0 + 2\sum_k\operatorname{artanh}(e^kv_0)$, see
#    [why a block stops](why_a_block_stops.py). What is left of a small difference of the starts?
#    *Hint: of the state, by (4); of the time, differentiate the sum.*
# 3. **No loss.** Let $e\to1$. Between which $v$ does the symmetric motion last, and at which
#    $\beta$ does its symmetry break? *Hint: (10), and $\tanh\frac y2 = \frac{\sinh y}{\cosh y+1}$.*
# 4. **The horizon.** How many periods of the ground at $\beta=2.7$ can be foretold with sixteen
#    digits? With how many digits a thousand? *Hint: (11).*
# 5. **Grazing.** What happens to (4) as $v_-\to0$, and how does the rate after the impact depend on
#    the place then? *Hint: near its lowest point a motion is $x = h + \frac12at^2$; let $h$ be
#    negative.*
# 6. **The squat block.** Find the break of symmetry and the first two doublings for the block of
#    Figure 2-12, $\alpha=\arctan\frac12$. *Hint: `rk.NondimensionalBlock`, whose accelerations are
#    in units of $g$, that is, $\alpha\beta$; begin at $\beta=2$.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# The neighbour leaves with $g + g'\,(\delta v + a_-\tau)$, so that
#
# $$\mathbf S = \begin{bmatrix} g/v_- & 0 \\ (a_+ - g' a_-)/v_- & g' \end{bmatrix},
#   \qquad \det\mathbf S = \frac{g\,g'}{v_-}.$$
#
# The ratio of the rates rules the first entry, their derivative the others. Where fast impacts lose
# more, $g' < g/v_-$, and areas shrink faster than by the loss of speed alone.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# Nothing of the state: the determinant is $e^{2n}\to0$, and all neighbours end in the same state of
# rest. The time is finite, and
#
# $$\frac{\mathrm d(p\,t_\infty)}{\mathrm dv_0} = \frac1{1-v_0^2}
#   + 2\sum_{k\ge1}\frac{e^k}{1-e^{2k}v_0^2}.$$
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $v_{\text{fold}} = \tanh\frac\pi{2\omega}$ and $v_{\text{sym}} = \coth\frac\pi{2\omega}$. With
# $e=1$ in (8), $v = \tanh\frac\pi{2\omega} + \frac{\omega\beta}{1+\omega^2}$ on the fast branch,
# and $\coth y-\tanh y = 2/\sinh2y$ leads to
#
# $$\beta_{\text{sym}} = \frac{2\,(1+\omega^2)}{\omega\,\sinh(\pi/\omega)}.$$
#
# Up to there both eigenvalues are *on* the unit circle: the motion lasts, but it attracts nothing.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# $\ln10^{16}/\lambda \approx 222$ units of time, or 74 periods. A thousand periods take
# $3000\,\lambda/\ln 10 \approx 216$ digits. The mean rate of growth, the picture of the bands and
# all averages are none the worse for it.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# It has no limit. The motion with $h<0$ lands with $v_- = -\sqrt{2a|h|}$: a square root, whose
# slope at $h=0$ is infinite. No derivative exists there, large or small. `rk.tangents` says so by
# name, in `grazing`.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# At 2.435274, 3.110601 and 3.206572.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
g, slope = sp.symbols("g g'", real=True)
landed = g + slope * (eps * dv + before * tau)
traced_back = sp.Matrix([-landed * tau, landed - after * tau])
matrix = traced_back.diff(eps).subs(eps, 0).jacobian([dx, dv]).applyfunc(sp.simplify)
general = sp.Matrix([[g / v, 0], [(after - slope * before) / v, slope]])
assert sp.simplify(matrix - general) == sp.zeros(2)
law = rk.EnergyRatioAtSpeed(((math.inf, 0.9, -1.5),), height=1.0)  # r = 0.9 - 1.5 |rate|
tilted = {"theta": rk.Dual(0.05, np.array([1.0, 0.0])),
          "theta_dot": rk.Dual(0.0, np.array([0.0, 1.0]))}  # fmt: skip
one = rk.tangents(rk.Case(unit_block, quiet, impact=law, initial=tilted, duration=2.5))
(impact,) = one.response.impacts
rate = abs(impact.before["theta_dot"])
lost = math.sqrt(0.9 - 1.5 * rate)
assert math.isclose(abs(impact.after["theta_dot"]), lost * rate, rel_tol=1e-9)
assert math.isclose(np.linalg.det(one.end), lost * (lost - 0.75 * rate / lost), rel_tol=1e-7)

tilted = {"theta": rk.Dual(0.3 * alpha, np.array([1.0]))}
rest = rk.tangents(rk.Case(unit_block, quiet, impact=lossy, initial=tilted))
v_0 = math.sqrt(1 - 0.7**2)
k = np.arange(1, 400)
series = 1 / (1 - v_0**2) + 2 * np.sum(0.9**k / (1 - 0.9 ** (2 * k) * v_0**2))
assert rest.response.events[-1].kind == "rest"
assert math.isclose(rest.event_times[-1, 0], series * 0.7 / v_0 / alpha, rel_tol=1e-8)

for w_run in (1.0, omega, 5.0):
    lossless = limits(1 - 1e-12, w_run)
    half_period = math.tanh(math.pi / (2 * w_run))
    assert np.allclose(lossless, [half_period, 1 / half_period], rtol=1e-9)
    breaks_at = 2 * (1 + w_run**2) / (w_run * math.sinh(math.pi / w_run))
    assert math.isclose(amplitude(lossless[1], 1 - 1e-12, w_run), breaks_at, rel_tol=1e-9)

assert abs(math.log(1e16) / spectrum.exponents[0] / 74 / 3 - 1) < 0.02
assert abs(3000 * spectrum.exponents[0] / math.log(10) / 216 - 1) < 0.02

h, a_n = sp.symbols("h a", positive=True)
assert sp.limit(sp.sqrt(2 * a_n * h).diff(h), h, 0) == sp.oo

squat_block = rk.NondimensionalBlock(alpha=math.atan(0.5))


def squat_family(beta):
    ground = rk.GroundMotion.harmonic(
        squat_block.alpha * beta, angular_frequency=omega, phase=math.pi / 2, duration=300.0
    )
    return analysis.dynamics.StroboscopicMap(
        squat_block, ground, 3.0, impact=rk.VelocityRatio(ratio), mirrored=True
    )


guess = squat_family(2.0).points({"x": 0.1}, cycles=60)[-1]
of_squat = analysis.dynamics.period_doublings(squat_family, (2.0, 3.26), guess, number=2)
assert np.allclose(of_squat.values, [2.435274, 3.110601, 3.206572], atol=1e-6)
exercises = Exercises({4: 216, 6: of_squat.values[0]})

# %%
# your answers
exercises.check(4, ...)  # number of digits for a thousand periods
exercises.check(6, ...)  # beta at which the symmetry breaks
