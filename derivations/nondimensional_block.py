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
#     minutes: 60
# ---

# %% [markdown]
# # One block for all sizes
#
# A block has a mass, a size, a shape and an inertia; the shaking has an amplitude and a frequency.
# Most of these numbers do not matter one by one. Scaled well, the equation of motion keeps three:
# one for the shape, two for the shaking. Then one diagram holds for a paperweight and for a bridge
# pier, and we can ask what the equation *can do*. It can do a lot.
#
# ## Aims
#
# After this notebook you can
#
# 1. scale the equation of the block and name its dimensionless groups;
# 2. find a misprint by putting one equation into another;
# 3. compute the periodic response to harmonic shaking in closed form, and say which branch is real;
# 4. follow a period-doubling cascade, and know for which coefficient of restitution it holds;
# 5. say which pulses overturn a block, in closed form for one case and by simulation for all.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import rockeom as rk
from rockeom import analysis
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.teaching import Exercises
from rockeom.thesis import equation

use_style()

# %% [markdown]
# ## 1. Scales of length and time
#
# The ground moves with the acceleration $a_g = A\cos\Omega\tau$. In this notebook $\tau$ is the
# time in seconds, as in the thesis, and $t$ the scaled time.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
b, h, tilt = 0.4, 0.9, 0.14
upright = [(-b, 0), (b, 0), (b, 2 * h), (-b, 2 * h), (0, h)]
*corners, centre = fb.turned(upright, (b, 0), tilt)
x, y = centre

figure, (drawing, history) = plt.subplots(
    1, 2, figsize=(7.6, 3.6), width_ratios=[1, 1.3], layout="constrained"
)
fb.bare(drawing)
fb.ground(drawing, -0.9, 1.0, depth=0.08)
fb.body(drawing, upright[:4], faint=True)
fb.body(drawing, corners)
fb.line(drawing, (b, 0), (b, 1.3))
fb.dimension(drawing, (b, 0), centre, "$R$", 0.0, (-10, -2))
fb.angle(drawing, (b, 0), (b, 1), centre, 0.62, r"$\alpha-\theta$", label_radius=1.2)
fb.angle(drawing, (b, 0), (-b, 0), corners[0], 0.66, r"$\theta$", sense=True, label_radius=1.14)
fb.arrow(drawing, centre, (x - 0.62, y), r"$m\,a_g$", offset=(2, 9))
fb.arrow(drawing, centre, (x, y - 0.42), "$mg$", offset=(-12, 4))
fb.centroid(drawing, centre, "$G$", (9, 8))
fb.pivot(drawing, (b, 0), "$O$", (13, 8))
fb.arrow(drawing, (0.2, -0.26), (-0.25, -0.26), "", color=fb.MOTION)
label = r"$a_g = A\cos\Omega\tau$"
fb.arrow(drawing, (0.2, -0.26), (0.65, -0.26), label, color=fb.MOTION, label_at="tail",
         offset=(0, -12))  # fmt: skip

cycle = np.linspace(0, 2.2, 300)
history.plot(cycle, np.cos(2 * np.pi * cycle), color=fb.MOTION)
fb.dimension(history, (0, 1.0), (1, 1.0), r"$2\pi/\Omega$", 0.25)
fb.dimension(history, (1.5, -1.0), (1.5, 0), "$A$", 0.0, (8, 0))
history.axhline(0.45, color=fb.INK, ls=":")
history.annotate(r"uplift, $g\tan\alpha$", (0.5, 0.52), ha="center", fontsize=8.5)
history.set(xlabel=r"$\Omega\tau/2\pi$", ylabel="$a_g$", yticks=[], ylim=(-1.3, 1.6))
plt.show()

# %% [markdown]
# *Figure 1. The block under harmonic shaking.*
#
# From [Housner's block](housner_block.py), with $s = \operatorname{sgn}\theta$,
#
# $$I_o\,\frac{\mathrm d^2\theta}{\mathrm d\tau^2} + s\,mgR\sin(\alpha-s\theta)
#   + mA\cos(\Omega\tau)\,R\cos(\alpha-s\theta) = 0. \tag{1}$$
#
# Seven numbers: $I_o, m, g, R, \alpha, A, \Omega$. Divide by $mgR$. The factor of the acceleration
# is now $I_o/(mgR) = 1/p^2$, so the only time scale is $1/p$. The rotation at which something
# happens is $\alpha$, and the acceleration at which a slender block lifts is $\alpha g$. Hence we
# measure
#
# $$x = \frac{\theta}{\alpha}, \qquad t = p\,\tau, \qquad \omega = \frac{\Omega}{p}, \qquad
#   \beta = \frac{A}{\alpha g}, \qquad p = \sqrt{\frac{mgR}{I_o}}, \tag{2}$$
#
# the first three of which are thesis 2-10 to 2-12. In SymPy: replace $\theta(\tau)$ by
# $\alpha\,X(p\tau)$ and differentiate.

# %%
m, R, alpha, I_O, g = sp.symbols("m R alpha I_o g", positive=True)
beta, omega, p, t, tau = sp.symbols("beta omega p t tau", positive=True)
X = sp.Function("X")
x, x_dd, s = sp.symbols(r"x \ddot{x} s", real=True)

theta = alpha * X(p * tau)
shaking = alpha * g * beta * sp.cos(omega * p * tau)  # A cos(Omega tau) by (2)
equation_1 = (
    I_O * theta.diff(tau, 2)
    + s * m * g * R * sp.sin(alpha - s * theta)
    + m * shaking * R * sp.cos(alpha - s * theta)
)
scaled = (equation_1.subs(tau, t / p).doit() / (m * g * R)).subs(p, sp.sqrt(m * g * R / I_O))
scaled = sp.simplify(scaled.subs(X(t).diff(t, 2), x_dd).subs(X(t), x))

ours = (
    alpha * x_dd
    + s * sp.sin(alpha * (1 - s * x))
    + alpha * beta * sp.cos(omega * t) * sp.cos(alpha * (1 - s * x))
)
assert sp.simplify(scaled - ours) == 0
sp.Eq(ours, 0)

# %% [markdown]
# $$\alpha\,\ddot x + s\sin[\alpha(1-sx)] = -\alpha\beta\cos(\omega t)\cos[\alpha(1-sx)]. \tag{3}$$
#
# Mass, size and gravity are gone, into the units of (2). The shape $\alpha$ stays, because sine and
# cosine are not linear. For a slender block that goes as well:
#
# $$\ddot x - x + s = -\beta\cos\omega t. \tag{4}$$

# %%
slender = sp.limit((ours / alpha).subs(s, 1), alpha, 0)
assert sp.simplify(slender - (x_dd - x + 1 + beta * sp.cos(omega * t))) == 0

definitions = {number: equation(number).right[0] for number in ("2-10", "2-11", "2-12")}
Omega = sp.Symbol("Omega", positive=True)
clock = definitions["2-12"].rhs
assert sp.simplify(clock - sp.sqrt(m * g * R / I_O) * tau) == 0
assert sp.simplify(definitions["2-11"].rhs * clock - Omega * tau) == 0

# %% [markdown]
# The engine's model `nondimensional_block` declares a block in these units from the start: mass 1,
# gravity 1. Its Lagrange equation is (3) times a constant. That of `rigid_block` becomes (3) by one
# call, too.

# %%
model = rk.derive("nondimensional_block")
rho = next(q.symbol for q in model.parameters if q.name == "radius_ratio")
harmonic = {GROUND_X: alpha * beta * sp.cos(omega * t), GROUND_Y: 0}
for side, name in [(1, "right"), (-1, "left")]:
    (engine,) = model.equations(name).residual
    assert sp.simplify(engine.subs(harmonic) - alpha * rho * ours.subs(s, side)) == 0
    (scaled,) = rk.derive(rk.RigidBlock).equations(name, form="nondimensional").residual
    assert sp.simplify(scaled.subs(harmonic) - ours.subs(s, side) / alpha) == 0

# %% [markdown]
# And in numbers: two blocks of one shape, one six times as large, and the scaled one.

# %%
shape, beta_run, omega_run = 0.2, 1.5, 5.0
scaled_motion = rk.GroundMotion.harmonic(
    shape * beta_run, angular_frequency=omega_run, duration=40.0
)
scaled_run = rk.simulate(rk.NondimensionalBlock(alpha=shape), scaled_motion)
instants = np.linspace(0, 30, 301)
for frequency in (1.0, math.sqrt(6.0)):
    block = rk.RigidBlock.from_frequency(p=frequency, alpha=shape)
    motion = rk.GroundMotion.harmonic(
        shape * beta_run * block.gravity,
        angular_frequency=omega_run * frequency,
        duration=40.0 / frequency,
    )
    run = rk.simulate(block, motion)
    rotation = run.at(instants / frequency)["theta"] / shape
    assert np.abs(rotation).max() > 0.05
    assert np.allclose(rotation, scaled_run.at(instants)["x"], rtol=0, atol=1e-6)

# %% [markdown]
# ## 2. A misprint found by substitution
#
# As thesis 2-13 this equation is printed with a second $\alpha$ inside the cosine:

# %%
(printed,), (right_form,) = equation("2-13").printed, equation("2-13").right
plus_minus = sp.Symbol(r"\pm", real=True)


def less_ours(relation, side):
    return sp.simplify((relation.lhs - relation.rhs - ours).subs({plus_minus: side, s: side}))


for side in (1, -1):
    assert less_ours(right_form, side) == 0
    assert less_ours(printed, side) != 0
sp.Eq(printed.lhs, printed.rhs)

# %% [markdown]
# Is it only a slip of the pen, or did the computations use it too? The limit $\alpha\to0$ cannot
# tell: $\alpha(1-x)$ and $\alpha^2(1-x)$ both vanish. A squat block can. For $\alpha =
# \arctan\tfrac12$ and an upright block the printed form pushes with $\cos\alpha^2/\cos\alpha$, nine
# per cent more. We integrate both forms, with a small program of our own (its weakness, explained
# in [why a block stops](why_a_block_stops.py), does no harm while the block keeps rocking).

# %%
squat, drive, restitution = math.atan(0.5), 2 * math.pi / 3, 0.5
assert round(math.cos(squat**2) / math.cos(squat) - 1, 2) == 0.09


def speeds_by_hand(beta, *, misprinted, periods=60):
    """Speeds after the impacts of the last ten periods, or None if the block falls."""
    inner = squat if misprinted else 1.0
    now, side, state, found = 0.0, -1, [0.0, -0.3], []

    def rates(t, y):
        angle = squat * (1 - side * y[0])
        push = squat * beta * math.cos(drive * t) * math.cos(inner * angle)
        return [y[1], -(side * math.sin(angle) + push) / squat]

    def landing(_, y):
        return y[0]

    def fallen(_, y):
        return abs(y[0]) - 3.0

    landing.terminal = fallen.terminal = True
    while now < 3.0 * periods:
        landing.direction = -side
        leg = solve_ivp(
            rates, (now, 3.0 * periods), state, events=[landing, fallen], rtol=1e-8, atol=1e-10
        )
        now, state = leg.t[-1], leg.y[:, -1]
        if len(leg.t_events[1]):
            return None
        if leg.status == 1:
            side, state = -side, [0.0, restitution * state[1]]
            if now > 3.0 * (periods - 10):
                found.append(abs(state[1]))
    return np.array(found)


def distinct(speeds):
    """The speeds that differ by more than 1e-3."""
    ordered = np.sort(speeds)
    return ordered[np.append(True, np.diff(ordered) > 1e-3)]


for beta_run in (2.75, 3.0):
    for misprinted in (False, True):
        speeds = speeds_by_hand(beta_run, misprinted=misprinted)
        outcome = "falls" if speeds is None else f"{len(distinct(speeds))} different speeds"
        print(f"beta = {beta_run}, {'printed' if misprinted else 'right':7s}  {outcome}")

by_hand = distinct(speeds_by_hand(3.0, misprinted=False))
assert len(by_hand) == 2
assert speeds_by_hand(3.0, misprinted=True) is None

# %% [markdown]
# With the printed form the block falls at $\beta = 3$, where Figure 2-12 of the thesis begins. Its
# computations used the right form; Section 4 draws that figure.

# %% [markdown]
# ## 3. The harmonic response in closed form
#
# The slender block (4) is linear between impacts, so a periodic motion can be found by hand. Look
# for one with two impacts per cycle of the ground, whose halves mirror each other:
# $x(t+\pi/\omega) = -x(t)$. Let it leave the ground at $t=0$ with the speed $v$, to the right, and
# let the phase angle $\varphi$ of the ground be unknown. For $0<t<\pi/\omega$
#
# $$x = 1 + a\cosh t + b\sinh t + C\cos(\omega t+\varphi), \qquad C = \frac{\beta}{1+\omega^2}.
#   \tag{5}$$
#
# Four conditions fix $a, b, v, \varphi$. The block is upright at both ends, leaves with $v$, and
# lands with the speed $v/e$, of which the impact leaves $v$ for the mirrored half:
#
# $$x(0)=0,\quad \dot x(0)=v,\quad x(\pi/\omega)=0,\quad \dot x(\pi/\omega) = -v/e. \tag{6}$$

# %%
a, b, C, c, sigma, v = sp.symbols("a b C c sigma v", real=True)
phi, e = sp.Symbol("varphi", real=True), sp.Symbol("e", positive=True)
motion = 1 + a * sp.cosh(t) + b * sp.sinh(t) + C * sp.cos(omega * t + phi)
forced = motion.diff(t, 2) - motion + 1 + beta * sp.cos(omega * t + phi)
assert sp.simplify(forced.subs(C, beta / (1 + omega**2))) == 0

# %% [markdown]
# With $c = C\cos\varphi$ and $\sigma = \omega C\sin\varphi$ the conditions are linear. Solved for
# $a, b, v, \sigma$ they leave one unknown $c$, and the identity $\cos^2\varphi+\sin^2\varphi=1$ a
# quadratic equation for it:
#
# $$c^2 + \sigma(c)^2/\omega^2 = C^2. \tag{7}$$

# %%
ch, sh = sp.symbols("ch sh", positive=True)  # cosh and sinh of pi/omega
conditions = [
    1 + a + c,  # upright at the start
    b - sigma - v,  # leaves with v
    1 + a * ch + b * sh - c,  # upright half a cycle later
    a * sh + b * ch + sigma + v / e,  # lands with v/e
]
linear = sp.solve(conditions, [a, b, v, sigma], dict=True)[0]
as_functions = sp.lambdify((c, ch, sh, e), [linear[q] for q in (a, b, v, sigma)])


def symmetric_orbits(beta, omega, e):
    """[(v, phi, peak)] of the motions (5) that stay above the ground, the fastest first."""
    half = math.pi / omega
    hyperbolic = math.cosh(half), math.sinh(half)
    amplitude = beta / (1 + omega**2)
    sigma_0, sigma_1 = (as_functions(q, *hyperbolic, e)[3] for q in (0.0, 1.0))
    slope = sigma_1 - sigma_0  # sigma is linear in c
    quadratic = [
        1 + slope**2 / omega**2,
        2 * sigma_0 * slope / omega**2,
        sigma_0**2 / omega**2 - amplitude**2,
    ]
    found = []
    times = np.linspace(0, half, 402)[1:-1]
    for root in np.roots(quadratic):
        if abs(root.imag) > 0:
            continue
        root = float(root.real)
        a, b, v, sigma = as_functions(root, *hyperbolic, e)
        phase = math.atan2(sigma / omega, root)
        x = 1 + a * np.cosh(times) + b * np.sinh(times)
        x += amplitude * np.cos(omega * times + phase)
        if v > 0 and x.min() > 0:
            found.append((v, phase, x.max()))
    return sorted(found, reverse=True)


# %% [markdown]
# Is this what the engine does? Start its slender block on such an orbit and let it run for eighty
# cycles. An orbit that is unstable will not last that long, for rounding errors grow.

# %%
unit_block = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)
unit = unit_block.alpha * unit_block.gravity  # beta = 1


def speeds_from(orbit, beta, omega, e, cycles=80):
    """Scaled speeds after the impacts of a run that starts on an orbit."""
    v, phase, _ = orbit
    motion = rk.GroundMotion.harmonic(
        beta * unit,
        angular_frequency=omega,
        phase=phase + math.pi / 2,
        duration=cycles * 2 * math.pi / omega,
    )
    run = rk.simulate(
        unit_block,
        motion,
        impact=rk.VelocityRatio(e),
        initial={"theta": 0.0, "theta_dot": v * unit_block.alpha},
        mode="right",
        options=rk.SolverOptions(output_step=100.0),
    )
    return np.array([abs(i.after["theta_dot"]) for i in run.impacts]) / unit_block.alpha


fast, slow = symmetric_orbits(beta=0.5, omega=2.0, e=0.9)
assert np.allclose(speeds_from(fast, 0.5, 2.0, 0.9), fast[0], rtol=1e-7)  # it stays
left = speeds_from(slow, 0.5, 2.0, 0.9)
assert np.allclose(left[:3], slow[0], rtol=1e-6)  # it starts there,
assert np.allclose(left[-10:], fast[0], rtol=1e-6)  # and ends on the other
print(f"closed form: fast {fast[0]:.6f}, slow {slow[0]:.6f}")

# %%
figure, ax = plt.subplots(figsize=(5.6, 3.6), layout="constrained")
frequencies = np.linspace(0.8, 8, 300)
for color, beta_run in zip(fb.LINES, (0.5, 1.0, 2.0), strict=False):
    for branch, style in [(0, "-"), (1, ":")]:
        peaks = []
        for w in frequencies:
            orbits = symmetric_orbits(beta_run, w, 0.9)
            peaks.append(orbits[branch][2] if len(orbits) > branch else np.nan)
        label = rf"$\beta = {beta_run}$" if branch == 0 else None
        ax.plot(frequencies, peaks, style, color=color, label=label)
    for w in (2.5, 4.0, 6.0):
        orbit = symmetric_orbits(beta_run, w, 0.9)[0]
        final = speeds_from(orbit, beta_run, w, 0.9, cycles=20)[-1]
        assert math.isclose(final, orbit[0], rel_tol=1e-6)
        ax.plot(w, orbit[2], "o", color=color, mfc="white", ms=5)
ax.set(xlabel=r"$\omega = \Omega/p$", ylabel=r"largest $x = \theta/\alpha$", ylim=(0, 1.2))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 2. Peaks of the symmetric periodic motions for $e = 0.9$. Full lines: the fast branch,
# circles: on it the engine stays. Dotted: the slow branch, from which every disturbance leads
# away.*
#
# There is no resonance peak. The response grows towards low frequencies until the block falls. And
# for $\beta = 0.5$ the ground is too weak to lift a block at rest, $\beta<1$, but keeps one rocking
# that has once been started. Two answers to the same shaking: which one you see depends on the
# past.

# %% [markdown]
# ## 4. Sub-harmonics: the period-doubling cascade
#
# Shake a squat block harder and the symmetric motion gives way to one whose halves differ, then to
# one that repeats after two cycles of the ground, then four, then never. Figure 2-12 of the thesis,
# after Hogan (1989), shows it for $\alpha = \arctan\tfrac12$, $\omega=\tfrac23\pi$, $3\le\beta\le
# 3.26$ and "$r = 0.5$". That $r$ multiplies *velocities*, Hogan's convention. As a ratio of
# energies, as $r$ is defined elsewhere in the thesis, it gives no cascade: from here the block
# falls over, and the periodic motion that others lead to does not double.

# %%
squat_block = rk.NondimensionalBlock(alpha=squat)


def last_speeds(beta, law, periods=120, kept=24):
    """Speeds after the impacts of the last cycles; none of a block that fell before."""
    motion = rk.GroundMotion.harmonic(
        squat * beta, angular_frequency=drive, phase=math.pi / 2, duration=3.0 * periods
    )
    options = rk.SolverOptions(output_step=100.0)
    run = rk.simulate(squat_block, motion, impact=law, options=options)
    late = [abs(i.after["x_dot"]) for i in run.impacts if i.time > 3.0 * (periods - kept)]
    return np.array(late)


assert np.allclose(distinct(last_speeds(3.0, rk.VelocityRatio(0.5))), by_hand, atol=1e-5)
for beta_run, number in [(3.05, 2), (3.18, 4), (3.22, 8)]:
    speeds = last_speeds(beta_run, rk.VelocityRatio(0.5), periods=300)
    assert len(distinct(speeds)) == number
    assert last_speeds(beta_run, rk.EnergyRatio(0.5)).size == 0  # fallen

# %% [markdown]
# Dots show what lasts, and only after long waiting. The periodic motions themselves, stable or not,
# are zeros of a function: let $P$ take the state at one half period of the ground to the mirror
# image of the state at the next. A symmetric motion is a fixed point of $P$, an asymmetric one of
# $P^2$, one of two cycles of $P^4$. Newton's method finds them from the derivative of $P$, which is
# carried through the impacts, and a step along the curve of solutions leads from one $\beta$ to the
# next. Where a multiplier, an eigenvalue of that derivative, passes $-1$, the motion ceases to last
# and another one, twice as long, leaves it.

# %%
squat_law = rk.VelocityRatio(0.5)


def stroboscope(beta):
    """Looks at the block every half period, at every second look into a mirror."""
    motion = rk.GroundMotion.harmonic(
        squat * beta, angular_frequency=drive, phase=math.pi / 2, duration=6.0
    )
    return analysis.dynamics.StroboscopicMap(squat_block, motion, 3.0, squat_law, mirrored=True)


settled = stroboscope(2.0).points({"x_dot": -0.3}, cycles=60)[-1]
branches = [
    analysis.dynamics.orbit_branch(stroboscope, between=(2.0, 3.26), guess=settled, step=0.05)
]
for _ in range(3):
    leaves = branches[-1].bifurcations[0]
    print(f"{leaves.kind} at beta = {leaves.value:.8f}, orbit {leaves.orbit.order}")
    branches.append(branches[-1].switched(leaves, step=0.05))

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
for beta_run in np.linspace(3.0, 3.26, 131):
    speeds = last_speeds(beta_run, rk.VelocityRatio(0.5))
    ax.plot(np.full_like(speeds, beta_run), speeds, ".", ms=1.2, color=fb.INK)
for branch in branches:
    after = 0.5 * np.abs(branch.at_impacts("x_dot"))
    stable = np.where(branch.stable[:, None], after, np.nan)
    ax.plot(branch.values, after, "--", color=fb.LINES[1], lw=0.8)
    ax.plot(branch.values, stable, color=fb.LINES[0], lw=1.2)
ax.set(xlabel=r"$\beta$", ylabel=r"$|\dot x|$ after an impact", xlim=(3.0, 3.26))
plt.show()

# %% [markdown]
# *Figure 3. Speeds after the impacts, once the start is forgotten, against the amplitude of the
# shaking (dots), and periodic motions that last (full lines) or not (dashed). Two dots: the two
# halves of a cycle differ, and every cycle is like the last. Four: two cycles make one period.
# Towards $\beta\approx3.23$ the doublings pile up, and what follows is chaotic. The motions of the
# dashed lines are still there, but no disturbance leaves the block on them.*
#
# How such points are computed, where the doublings end, and how chaos differs from a long period:
# [phase plane, saltation and chaos](saltation_and_chaos.py).

# %% [markdown]
# ## 5. Overturning by a pulse
#
# **A half sine.** Let a slender block at rest be pushed by $\beta\sin\omega t$ for half a cycle.
# The sum $q = x+\dot x$ of (4) grows by itself: for a block that leans to the right,
#
# $$\dot q = q - 1 + \beta\sin\omega t \tag{8}$$
#
# (with the push towards the right). After the pulse only $q-1$ counts: positive it grows for ever
# and the block falls; negative, the block turns back, and every impact leaves it less. So the
# border is where $q$ reaches just 1 at the end. The block lifts at $t_0$, where $\beta\sin\omega
# t_0=1$. Multiply (8) by $\mathrm e^{-t}$ and integrate:
#
# $$\beta\int_{t_0}^{\pi/\omega}\sin(\omega t)\,\mathrm e^{-(t-t_0)}\,\mathrm dt = 1. \tag{9}$$
#
# The integral is elementary, and the border is
#
# $$\frac{\beta}{1+\omega^2}\left[\omega\,\mathrm e^{-(\pi/\omega-t_0)} + \frac1\beta
#   + \omega\sqrt{1-\frac1{\beta^2}}\right] = 1. \tag{10}$$

# %%
primitive = -sp.exp(-t) * (sp.sin(omega * t) + omega * sp.cos(omega * t)) / (1 + omega**2)
assert sp.simplify(primitive.diff(t) - sp.sin(omega * t) * sp.exp(-t)) == 0


def border(omega):
    """The beta of (10)."""

    def excess(beta):
        lift = math.asin(1 / beta) / omega
        decay = math.exp(-(math.pi / omega - lift))
        bracket = omega * decay + 1 / beta + omega * math.sqrt(1 - 1 / beta**2)
        return beta * bracket / (1 + omega**2) - 1

    return brentq(excess, 1 + 1e-12, 100, xtol=1e-14)


def falls(beta, omega):
    pulse = rk.GroundMotion.half_sine(beta * unit, 2 * math.pi / omega, duration=60.0)
    run = rk.simulate(unit_block, pulse, options=rk.SolverOptions(output_step=100.0))
    return run.outcome is rk.Outcome.OVERTURNED


for w in (0.5, 1.0, 2.0, 5.0, 10.0):
    assert not falls(border(w) * (1 - 1e-6), w)
    assert falls(border(w) * (1 + 1e-6), w)

# %% [markdown]
# The engine falls on one side of (10) and stands on the other, a millionth apart. For long pulses
# the border is $\beta = 1$, West's static criterion: lifting means falling. Short pulses must be
# ever stronger, in proportion to $\omega = \Omega/p$, and $p$ falls with size. This is Housner's
# scale effect: of two blocks of one shape the larger is safer.

# %% [markdown]
# **A full sine.** Now the push reverses, and the block may be hit at the right or the wrong moment.
# Nothing as simple as (10) holds. We let the engine try all combinations, for the block of Figure
# 2-13 of the thesis: $\alpha = 7.12°$ and the energy ratio $r = 0.954$. Its text calls the block "1
# m wide by 8 m high", which is an erratum: these are the half-dimensions. Only then is the period
# of its pulses, 2.192 s, a third of $2\pi/p$; a block of half the size is overturned by both of
# the pulses that we come to.

# %%
tall = rk.RigidBlock(half_width=1.0, half_height=8.0)
p_tall = tall.frequency_parameter
static = tall.gravity * math.tan(tall.alpha)


def full_sine(omega, strength):
    period = 2 * math.pi / (omega * p_tall)
    pulse = rk.GroundMotion.single_sine(strength * static, period, duration=period + 20.0)
    return rk.Case(tall, pulse, impact=rk.EnergyRatio(0.954))


grid = {"omega": np.linspace(0.5, 9, 90), "strength": np.linspace(0.9, 9, 90)}
found = rk.simulate_many(full_sine, over=grid)
fell = found.outcome.values == "overturned"

# %%
figure, ax = plt.subplots(figsize=(6.0, 4.2), layout="constrained")
after_impact = fell & (found.impacts.values > 0)
colors = np.where(fell, np.where(after_impact, 2.0, 1.0), 0.0)
shades = plt.matplotlib.colors.ListedColormap(["white", "#9ecae1", "#fdae6b"])
ax.pcolormesh(grid["omega"], grid["strength"], colors.T, cmap=shades, rasterized=True)
w = np.linspace(0.5, 9, 100)
ax.plot(w, [border(q) for q in w], "--", color=fb.INK, lw=1.0)
ax.annotate("half sine, (10)", (7.3, 4.15), color=fb.INK, fontsize=8.5)
ax.annotate("falls at once", (2.2, 7.0))
ax.annotate("falls after impacts", (4.75, 5.3))
ax.annotate("stands", (7.0, 1.8))
tested = 2 * math.pi / (2.192 * p_tall)
assert math.isclose(tested, 3.0, rel_tol=1e-3)
half_as_large = rk.RigidBlock(half_width=0.5, half_height=4.0)
marks = [(0.172, rk.Outcome.OVERTURNED), (0.454, None)]
for in_g, expected in marks:
    strength = in_g * tall.gravity / static
    case = full_sine(tested, strength)
    outcome = rk.simulate(case.structure, case.motion, impact=case.impact).outcome
    assert (outcome is rk.Outcome.OVERTURNED) == (expected is rk.Outcome.OVERTURNED)
    as_stated = rk.simulate(half_as_large, case.motion, impact=case.impact)
    assert as_stated.outcome is rk.Outcome.OVERTURNED
    ax.plot(tested, strength, "x" if expected else "o", color="black", mfc="white", ms=7)
ax.set(xlabel=r"$\omega = \Omega/p$", ylabel=r"$A/(g\tan\alpha)$", ylim=(0.9, 9))
plt.show()

# %% [markdown]
# *Figure 4. Pulses of a full sine that overturn the block: without an impact (blue), after at least
# one (orange). The cross and the circle are two runs of Figure 2-13, with 0.172 g and 0.454 g: the
# weaker pulse overturns the block, the stronger does not.*
#
# More shaking is not more danger. Between the two ways to fall runs a thin seam of safety, in which
# the second half of the pulse catches a block that the first half has thrown. No design should rest
# upon it. But it shows how sensitive overturning is, and that the stones that stand or lie after an
# earthquake are a poor seismograph.
# The borders of Figure 4, with ten digits, are in [overturning](overturning.py).

# %% [markdown]
# ## Exercises
#
# 1. **Count the groups.** Buckingham's theorem promises how many dimensionless groups (1) has. Find
#    them, and find why one fewer remains in (3). *Hint: $m$ and $I_o$ enter only as $I_o/(mgR)$.*
# 2. **Vertical shaking.** Add $a_v(\tau)$ to (1) and scale. Which new group appears, and why is it
#    not $a_v/(\alpha g)$? *Hint: it multiplies the sine.*
# 3. **The end of the branch.** For which $\beta$ do the two branches of Figure 2 meet, at
#    $\omega=3$ and $e = 0.9$? Below it no symmetric motion exists. *Hint: the discriminant of (7).*
# 4. **Perfect impacts.** Let $e\to1$. What are the two motions (5) now, and what is $\varphi$?
#    *Hint: eliminate $a$ and $b$ from (6) for $e=1$; what remains is proportional to $c$.*
# 5. **A handy estimate.** Compare $\beta = \sqrt{1+\omega^2}$ with (10). Is this estimate on the
#    safe side? *Hint: the last two terms of (10) then make 1.*
# 6. **Feigenbaum.** Refine Figure 3 and find the values of $\beta$ of the first three doublings.
#    How does the ratio of their distances compare with 4.669? *Hint: bisect on the number of
#    distinct speeds; near a doubling let the block run longer.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Seven quantities in three units make four groups, such as $\alpha$, $A/g$, $\Omega^2R/g$ and
# $I_o/(mR^2)$. Divided by $mgR$, (1) holds $m$, $I_o$ and $R$ only as the length $I_o/(mR)$: five
# quantities in two units, which make three groups.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# $g$ becomes $g + a_v$, and in (3) the sine is multiplied by $1 + a_v/g$. It is compared with
# gravity itself. A horizontal acceleration is compared with $\alpha g$, because that is what lifts
# a slender block; a vertical one alone lifts nothing until it is $-g$.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# Let $\sigma = \sigma_0 + \sigma' c$. The roots of (7) meet where its discriminant vanishes,
# $C^2(\omega^2 + \sigma'^2) = \sigma_0^2$:
#
# $$\beta = (1+\omega^2)\,\frac{|\sigma_0|}{\sqrt{\omega^2+\sigma'^2}},$$
#
# which is 0.121 for $\omega = 3$, $e = 0.9$. To keep a block rocking takes far less than the
# $\beta = 1$ that starts it.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# From the second and fourth of (6) $b = -a\tanh\frac\pi{2\omega}$; with the first and third $c = 0$
# and $a = -1$. So $\cos\varphi = 0$: the ground is a quarter of its cycle ahead or behind, and puts
# no energy in, as none is lost. The two motions have
# $v = \tanh\frac\pi{2\omega} \pm \frac{\omega\beta}{1+\omega^2}$.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# With $\beta^2 = 1+\omega^2$ the last two terms of the bracket make $\beta$, and the left-hand side
# of (10) is 1 plus something positive. So the block has fallen before: the estimate is not on the
# safe side, by 1 % at $\omega = 0.5$, by 20 % at 2. For fast pulses the border tends to
# $\beta = \omega/2$, half of the estimate: only the impulse counts, $2\beta/\omega = 1$.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# The doublings are at 3.1106, 3.2066 and 3.2264, where a multiplier of the orbit passes -1;
# `analysis.dynamics.period_doublings` finds them with ten digits. The ratio of their distances is
# 4.83; 4.669 is the limit of such ratios.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
units = {  # of mass, length and time
    "I_o": (1, 2, 0), "m": (1, 0, 0), "g": (0, 1, -2), "R": (0, 1, 0), "alpha": (0, 0, 0),
    "A": (0, 1, -2), "Omega": (0, 0, -1), "I_o/(mR)": (0, 1, 0),
}  # fmt: skip
for chosen, groups in [
    (["I_o", "m", "g", "R", "alpha", "A", "Omega"], 4),
    (["I_o/(mR)", "g", "alpha", "A", "Omega"], 3),
]:
    rank = np.linalg.matrix_rank([units[name] for name in chosen])
    assert len(chosen) - rank == groups

upwards = sp.Symbol("a_v", real=True)  # over g
(engine,) = model.equations("right").residual
more = ours + s * upwards * sp.sin(alpha * (1 - s * x))
difference = engine.subs(harmonic | {GROUND_Y: upwards}) - alpha * rho * more.subs(s, 1)
assert sp.simplify(difference) == 0

w, restitution = 3.0, 0.9
sigma_0, sigma_1 = (
    as_functions(q, math.cosh(math.pi / w), math.sinh(math.pi / w), restitution)[3] for q in (0, 1)
)
least = (1 + w**2) * abs(sigma_0) / math.hypot(w, sigma_1 - sigma_0)
assert round(least, 3) == 0.121
assert len(symmetric_orbits(1.001 * least, w, restitution)) == 2
assert not symmetric_orbits(0.999 * least, w, restitution)

perfect = symmetric_orbits(0.5, 2.0, 1 - 1e-7)
for (speed, phase, _), side in zip(perfect, (1, -1), strict=True):
    assert math.isclose(abs(phase), math.pi / 2, abs_tol=1e-5)
    assert math.isclose(speed, math.tanh(math.pi / 4) + side * 2 * 0.5 / 5, rel_tol=1e-5)

borders = {w: border(w) / math.sqrt(1 + w**2) for w in (0.5, 2.0, 5.0, 50.0)}
assert np.allclose([borders[0.5], borders[2.0]], [0.99, 0.80], atol=6e-3)
assert all(one < 1 for one in borders.values())
assert math.isclose(borders[50.0], 0.5, rel_tol=0.05)

# at a doubling a multiplier of the orbit is -1
cascade = analysis.dynamics.period_doublings(stroboscope, (2.0, 3.26), settled, number=3)
broken, *doublings = cascade.values
assert np.allclose(doublings, [3.1106, 3.2066, 3.2264], atol=5e-5)
assert np.isclose((doublings[1] - doublings[0]) / (doublings[2] - doublings[1]), 4.83, atol=5e-3)
assert np.allclose([broken, *doublings[:2]], [b.bifurcations[0].value for b in branches[:3]])
exercises = Exercises({3: least, 6: doublings[0]})

# %%
# your answers
exercises.check(3, ...)  # beta at which the branches meet
exercises.check(6, ...)  # beta of the first doubling
