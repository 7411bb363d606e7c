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
# # A rigid structure of two masses
#
# A bridge pier or a water tower is no homogeneous block: most of its mass is high up, and a base
# stands on the ground. Model A of the thesis (Ma 2010, Section 5.3.1) is the simplest that says
# so: two lumped masses on one rigid body that rocks about two pivots. It is also the model that the
# thesis compares first with a test, the release of a steel column by McManus (1980).
#
# ## Aims
#
# After this notebook you can
#
# 1. derive the equation of motion from moments about the pivot, for both signs of the rotation;
# 2. recognise a misprinted sign by what it would do to the structure;
# 3. derive the coefficient of restitution from angular momentum about the new pivot;
# 4. say which parameters of a specimen a published text determines, and which it does not;
# 5. judge a model by measured peaks, and not confuse a ratio of energies with one of velocities.
#
# You should know [Housner's block](housner_block.py) and its [impact](restitution.py).

# %%
from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from scipy.optimize import brentq, minimize_scalar

import rockeom as rk
from rockeom.plots import free_body as fb, use_style
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.teaching import Exercises
from rockeom.thesis import equation
from rockeom.thesis.notation import (
    I_O,
    B,
    H_b,
    H_e,
    I_bg,
    I_eg,
    R_b,
    R_e,
    a_g,
    alpha_b,
    alpha_e,
    g,
    m_b,
    m_e,
    theta,
    theta_d1,
    theta_d2,
    theta_dd,
)

use_style()
sp.init_printing()

# %% [markdown]
# ## 1. The structure and the forces on it
#
# The superstructure has the mass $m_e$ at the height $H_e$, and the moment of inertia $I_{e,g}$
# about its own centroid; the base has $m_b$, $H_b$ and $I_{b,g}$. The pivots $O$ and $O'$ are $2B$
# apart.
# Seen from a pivot, each mass has a distance and an angle,
#
# $$ R_e\sin\alpha_e = R_b\sin\alpha_b = B, \qquad R_e\cos\alpha_e = H_e, \qquad
#    R_b\cos\alpha_b = H_b . \tag{1} $$


# %% tags=["hide-input"] jupyter={"source_hidden": true}
def outline(b, h, low, angle):
    """Corners of the base, ends of the column, and both masses, turned about a pivot."""
    pivot = (b if angle >= 0 else -b, 0)
    base = [(-b, 0), (b, 0), (b, 2 * low), (-b, 2 * low)]
    masses = [(0, h), (0, low)]
    return (
        fb.turned(base, pivot, angle),
        fb.turned([(0, 2 * low), (0, h)], pivot, angle),
        (fb.turned(masses, pivot, angle)),
    )


b, h, low, tilt = 0.38, 1.25, 0.14, 0.12
figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 4.4), layout="constrained")

base, column, (top, bottom) = outline(b, h, low, 0.0)
fb.ground(left, -0.75, 0.75)
fb.body(left, base)
left.plot(*column.T, color=fb.LINES[0], lw=2.5, solid_capstyle="butt")
fb.line(left, (b, 0), (b, 1.1))
fb.line(left, (b, 0), top)
fb.angle(left, (b, 0), (b, 1), top, 0.9, r"$\alpha_e$", label_radius=1.12)
fb.mass(left, top, r"$m_e,\ I_{e,g}$", (9, 4))
fb.mass(left, bottom, r"$m_b,\ I_{b,g}$", (-45, 0), size=7)
fb.dimension(left, (-b, 0), (-b, h), "$H_e$", 0.25, (-11, 0))
fb.dimension(left, (-b, 0), (-b, low), "$H_b$", 0.06, (-11, 2))
fb.dimension(left, (0, 0), (b, 0), "$B$", -0.19, (0, -8))
fb.dimension(left, (-b, 0), (0, 0), "$B$", -0.19, (0, -8))
fb.dimension(left, top, (b, 0), "$R_e$", 0.0, (11, 4))
fb.pivot(left, (b, 0), "$O$", (12, 6))
fb.pivot(left, (-b, 0), "$O'$", (-11, -9))
left.set_title("(a) at rest")

base, column, (top, bottom) = outline(b, h, low, tilt)
pivot = np.array([b, 0])
fb.ground(right, -0.75, 1.0)
fb.body(right, base)
right.plot(*column.T, color=fb.LINES[0], lw=2.5, solid_capstyle="butt")
fb.mass(right, top)
fb.mass(right, bottom, size=7)
fb.line(right, pivot, pivot + 1.32 * (base[0] - pivot))
fb.angle(right, pivot, (-b, 0), base[0], 0.93, r"$\theta$", sense=True, label_radius=1.1)
fb.line(right, pivot, (b, 1.4))
fb.line(right, pivot, top)
fb.angle(right, pivot, (b, 1), top, 0.7)
right.annotate(r"$\alpha_e-\theta$", (b, 0.66), (5, 0), textcoords="offset points")
fb.arrow(right, top, np.add(top, (0, -0.3)), "$m_e g$", offset=(-22, 3))
fb.arrow(right, top, np.add(top, (-0.4, 0)), "$m_e\\ddot u_g$", offset=(-4, 10))
fb.arrow(right, bottom, np.add(bottom, (0, -0.13)), "$m_b g$", offset=(14, 3))
fb.arrow(right, bottom, np.add(bottom, (-0.22, 0)), "$m_b\\ddot u_g$", offset=(-2, 9))
fb.arrow(right, (0.62, 0.2), (0.92, 0.2), "$\\ddot u_g$", color=fb.MOTION, offset=(-12, 10))
fb.pivot(right, pivot, "$O$", (12, -9))
right.set_title(r"(b) rocking about $O$, $\theta > 0$")
for ax in (left, right):
    fb.bare(ax)
plt.show()

# %% [markdown]
# *Figure 1. (a) Dimensions. (b) The weights, and in axes that move with the ground the inertia
# forces against its acceleration. The forces of the ground act at $O$ and have no moment about it.*
#
# ## 2. Moments about the pivot
#
# By d'Alembert's principle, the moments about $O$ of the weights, of the inertia forces
# $-m(\boldsymbol a + \boldsymbol a_g)$ and of the inertia couples $-I_g\ddot\theta$ add up to zero.
# With $s = +1$ for rocking about $O$ and $s = -1$ about $O'$, a mass is at
#
# $$ \boldsymbol r = \bigl(-s R\sin(\alpha - s\theta),\; R\cos(\alpha - s\theta)\bigr) \tag{2} $$
#
# from its pivot: to the left of $O$, to the right of $O'$.

# %%
t = sp.Symbol("t", real=True)
rotation = sp.Function("theta")(t)


def from_pivot(R, alpha, s):
    """Equation (2)."""
    return sp.Matrix([-s * R * sp.sin(alpha - s * rotation), R * sp.cos(alpha - s * rotation)])


def clockwise(place, force):
    """Moment of a force about the origin, clockwise."""
    return place[1] * force[0] - place[0] * force[1]


def moments(s):
    """Sum of all moments about the pivot, clockwise; zero along a motion."""
    total = 0
    for m, R, alpha, I_g in [(m_e, R_e, alpha_e, I_eg), (m_b, R_b, alpha_b, I_bg)]:
        place = from_pivot(R, alpha, s)
        acceleration = place.diff(t, 2) + sp.Matrix([a_g, 0])
        force = -m * acceleration - m * g * sp.Matrix([0, 1])
        total += clockwise(place, force) - I_g * rotation.diff(t, 2)
    total = total.subs({rotation.diff(t, 2): theta_dd}).subs(rotation, theta)
    angles = [alpha_e - s * theta, alpha_b - s * theta]
    squares = {sp.cos(angle) ** 2: 1 - sp.sin(angle) ** 2 for angle in angles}
    return sp.expand(sp.expand(total).subs(squares))


about_O, about_O_dash = moments(+1), moments(-1)
sp.Eq(about_O, 0)

# %% [markdown]
# The squares of $\dot\theta$ have gone, because centripetal accelerations point at the pivot. The
# factor of $\ddot\theta$ is the moment of inertia about the pivot, the same for both pivots (thesis
# 5-8):

# %%
(pivot_inertia,) = (relation.rhs for relation in equation("5-8").right)
for residual in (about_O, about_O_dash):
    assert sp.simplify(residual.diff(theta_dd) + pivot_inertia) == 0
sp.Eq(I_O, pivot_inertia)

# %% [markdown]
# Solved for the angular acceleration, with $\sum$ over both masses,
#
# $$ I_O\,\ddot\theta = -\sum m R\,\bigl[\ddot u_g\cos(\alpha - s\theta) +
#    s\,g\sin(\alpha - s\theta)\bigr], \qquad s = \operatorname{sgn}\theta . \tag{3} $$
#
# The lever of a weight is $R\sin(\alpha - s\theta)$ and shrinks as the structure tilts; the lever
# of an inertia force is the mass's height $R\cos(\alpha - s\theta)$.


# %%
def acceleration(s):
    """Equation (3) over I_O."""
    load = sum(
        m * R * (a_g * sp.cos(alpha - s * theta) + s * g * sp.sin(alpha - s * theta))
        for m, R, alpha in [(m_e, R_e, alpha_e), (m_b, R_b, alpha_b)]
    )
    return -load / I_O


for s, residual in [(1, about_O), (-1, about_O_dash)]:
    found = -residual.subs(theta_dd, 0) / residual.diff(theta_dd)  # which is linear in it
    assert sp.simplify(found - acceleration(s).subs(I_O, pivot_inertia)) == 0

# %% [markdown]
# ## 3. The thesis, and the engine
#
# The thesis has three equations: 5-9 for $\theta > 0$, which is not legible in our copy, 5-10 for
# $\theta < 0$, and 5-11 for both.


# %%
def stated(relation, s):
    """Right-hand side of a relation on one side."""
    return relation.rhs.subs({sp.sign(theta): s})


def spread(expression):
    """Sines of sums as products: of expressions linear in them, zero is then seen to be zero."""
    return sp.expand(sp.expand_trig(expression))


(nine,), (ten,) = equation("5-9").right, equation("5-10").printed
(printed,), (corrected,) = equation("5-11").printed, equation("5-11").right
assert spread(stated(nine, 1) - acceleration(1)) == 0
assert spread(stated(ten, -1) - acceleration(-1)) == 0
for s in (1, -1):
    assert spread(stated(corrected, s) - acceleration(s)) == 0
    assert spread(stated(printed, s) - acceleration(s)) != 0
sp.Eq(theta_dd, printed.rhs, evaluate=False)

# %% [markdown]
# This is 5-11 as printed. It has $\alpha + \operatorname{sgn}(\theta)\,\theta = \alpha + |\theta|$
# where (3) has $\alpha - |\theta|$. It contradicts 5-10, and it would be a strange structure: the
# lever of its weight would *grow* as it tilts, and it could not fall over (Figure 2).
#
# The engine knows positions only, and derives its equation from energies, by Lagrange. It uses $B$
# and the heights.

# %%
model = rk.derive("lumped_mass_structure")
in_engine = {p.name: p.symbol for p in model.parameters}
names = {
    m_e: "mass", H_e: "height", I_eg: "inertia", m_b: "base_mass", H_b: "base_height",
    I_bg: "base_inertia", B: "half_width", g: "gravity",
}  # fmt: skip
back = {in_engine[name]: symbol for symbol, name in names.items()}
back |= {GROUND_X: a_g, GROUND_Y: 0}
levers = {
    sp.sin(alpha_e): B / R_e, sp.cos(alpha_e): H_e / R_e,
    sp.sin(alpha_b): B / R_b, sp.cos(alpha_b): H_b / R_b,
}  # fmt: skip
radii = {R_e: sp.sqrt(B**2 + H_e**2), R_b: sp.sqrt(B**2 + H_b**2)}

for mode, residual in [("right", about_O), ("left", about_O_dash)]:
    (engine,) = model.equations(mode).residual
    ours = sp.expand_trig(-residual).subs(levers).subs(radii)
    assert sp.simplify(engine.subs(back) - ours) == 0

# %%
COLUMN = {
    "mass": 122.6, "height": 1.05, "inertia": 44.8, "base_mass": 45.6, "base_height": 0.10,
    "base_inertia": 1.37, "half_width": 0.285, "gravity": 9.81,
}  # kg, m, kg m2, m/s2; explained in Section 5  # fmt: skip
column = rk.LumpedMassStructure(**COLUMN)
numbers = {symbol: COLUMN[name] for symbol, name in names.items()}
numbers |= {R: float(radius.subs(numbers)) for R, radius in radii.items()}
numbers |= {alpha_e: np.arctan2(0.285, 1.05), alpha_b: np.arctan2(0.285, 0.10)}
numbers |= {I_O: float(pivot_inertia.subs(numbers))}

degrees = np.linspace(0, 25, 101)
righting = {}
for name, form in [("right, (3)", acceleration(1)), ("5-11 as printed", stated(printed, 1))]:
    at_rest = (-I_O * form).subs(a_g, 0).subs(numbers)
    righting[name] = sp.lambdify(theta, at_rest)(np.radians(degrees))
assert righting["right, (3)"][-1] < 0 < righting["right, (3)"][0]
assert np.all(np.diff(righting["5-11 as printed"]) > 0)

figure, ax = plt.subplots(figsize=(5.4, 3.2), layout="constrained")
for (name, moment), color in zip(righting.items(), (fb.LINES[0], fb.LINES[1]), strict=True):
    ax.plot(degrees, moment, color=color, label=name)
ax.axhline(0, color=fb.INK, lw=0.6)
ax.set(xlabel=r"rotation $\theta$ [degrees]", ylabel="righting moment [N m]")
ax.legend()
plt.show()

# %% [markdown]
# *Figure 2. Moment that rights the column of Section 5. It must vanish where the centroid of the
# whole stands above the pivot, at 19.8 degrees; with the printed sign it never does.*

# %%
centroid_height = (m_e * H_e + m_b * H_b) / (m_e + m_b)
balance = np.degrees(float(sp.atan(B / centroid_height).subs(numbers)))
assert np.isclose(np.interp(0, -righting["right, (3)"], degrees), balance, atol=1e-3)
assert np.isclose(balance, 19.8, atol=0.05)

# %% [markdown]
# ## 4. The impact
#
# At $\theta = 0$ the left foot lands. Two assumptions (Housner's): the right foot lifts at once,
# and the impulse of the ground acts at $O'$. An impulse at $O'$ has no moment about $O'$, so the
# angular momentum *about the new pivot* is conserved.
#
# Before the impact the structure turns at $\dot\theta_1$ about $O$; a mass at the height $H$ on the
# centre line lies to the left of $O$ and has the velocity $\dot\theta_1\,(H,\,+B)$. After the
# impact it turns at $\dot\theta_2$ about $O'$, and has $\dot\theta_2\,(H,\,-B)$. Seen from $O'$
# it is at $(B, H)$ in both cases.

# %%
bodies = [(m_e, H_e, I_eg), (m_b, H_b, I_bg)]


def momentum_about_new_pivot(rate, upwards):
    """Angular momentum about O', clockwise: of the motion of the masses, and of their spin."""
    total = 0
    for m, H, I_g in bodies:
        velocity = rate * sp.Matrix([H, upwards * B])
        total += m * clockwise(sp.Matrix([B, H]), velocity) + I_g * rate
    return sp.expand(total)


before = momentum_about_new_pivot(theta_d1, +1)
after = momentum_about_new_pivot(theta_d2, -1)
sp.Eq(before, after)

# %% [markdown]
# The vertical velocities are the whole point. Their moment about $O'$ is $-mB^2\dot\theta_1$ before
# the impact and $+mB^2\dot\theta_2$ after it: as they turn about $O$, the masses circle $O'$ the
# wrong way. The ratio of the rates (thesis 5-12 to 5-14) is
#
# $$ e = \frac{\dot\theta_2}{\dot\theta_1} =
#    \frac{I_{e,g} + I_{b,g} + m_e(H_e^2 - B^2) + m_b(H_b^2 - B^2)}
#         {I_{e,g} + I_{b,g} + m_e(H_e^2 + B^2) + m_b(H_b^2 + B^2)} ,
#    \qquad r = e^2 . \tag{4} $$

# %%
(solution,) = sp.solve(sp.Eq(before, after), theta_d2)
e = sp.factor(solution / theta_d1)

for number, ours in [("5-12", before), ("5-13", after), ("5-14", e**2)]:
    for relation in equation(number).right:
        assert sp.simplify(relation.rhs.subs(levers) - ours) == 0
assert sp.simplify(model.velocity_ratio.subs(back) - e) == 0
sp.Eq(theta_d2 / theta_d1, e)

# %% [markdown]
# *Why not about $O$?* An impulse at $O'$ has a moment about $O$. *Why is $e < 1$?* The difference
# of denominator and numerator is $2(m_e + m_b)B^2$: the wider the base and the heavier the
# structure for its inertia, the more is lost. With $B \to 0$ nothing is.

# %%
numerator, denominator = sp.fraction(e)
assert sp.expand(denominator - numerator - 2 * (m_e + m_b) * B**2) == 0

# %% [markdown]
# ## 5. The data of the column
#
# McManus (1980) rocked a steel column. The thesis gives only some of its parameters. What can be
# found from its text?
#
# | quantity | follows from | value |
# | --- | --- | --- |
# | $m_e$ | 5-1: $k = 4\pi^2 m_e/T^2 = 571.8$ kN/m with $T = 0.092$ s | 122.6 kg |
# | $m_e + m_b$ | weight 1650 N (a settlement of about 1.5 mm) | 168.2 kg |
# | $B$ | Figure 5-5 | 0.285 m |
# | $H_e$ | rotations over $\alpha_e$, listed in Figure 5-6 | see below |
# | inertias | $r = 0.74$, stated with 5-14 | see below |
#
# **The height.** Figure 5-6 lists peaks of the displacement $\Delta$ and $\Phi = \theta/\alpha_e$,
# to three decimals. The gauge is $H' = 1056$ mm above the feet, so that by 5-2
# $\theta = \alpha' - \arcsin\frac{B' - \Delta}{R'}$. Each peak confines $\alpha_e$ to an interval.

# %%
mass = 571.8e3 * 0.092**2 / (4 * np.pi**2)
assert np.isclose(mass, COLUMN["mass"], atol=0.05)
assert np.isclose((mass + COLUMN["base_mass"]) * 9.81, 1650, atol=1)

TIMES = np.array([0.138, 0.453, 0.695, 0.901, 1.106, 1.274, 1.443, 1.590])  # s
PEAKS = np.array([27.93, -21.30, 17.42, -14.18, 12.16, -10.17, 8.88, -7.77])  # mm
CROSSINGS = np.array([0.339, 0.585, 0.809, 1.008, 1.194, 1.364, 1.522, 1.669])  # s
PHI = np.array([0.099, 0.076, 0.062, 0.051, 0.043, 0.036, 0.032, 0.028])
gauge_radius, gauge_angle = np.hypot(285.0, 1056.0), np.arctan2(285.0, 1056.0)  # mm, rad


def rotation_at(displacement):
    """Thesis 5-2: size of the rotation [rad] at a displacement [mm]."""
    return gauge_angle - np.arcsin((285.0 - np.abs(displacement)) / gauge_radius)


def displacement_at(rotation):
    """Its inverse, with the sign of the rotation [mm]."""
    size = 285.0 - gauge_radius * np.sin(gauge_angle - np.abs(rotation))
    return np.copysign(size, rotation)


rotations = rotation_at(PEAKS)
lowest = (rotations / (PHI + 5e-4)).max()
highest = (rotations / (PHI - 5e-4)).min()
heights = 0.285 / np.tan([highest, lowest])
print("alpha_e between", lowest.round(4), "and", highest.round(4), "rad")
print("H_e between", heights.round(3), "m")
assert heights[0] < 1.05 < heights[1]

# %% [markdown]
# Eight rounded numbers together fix the height to 2 mm.
#
# **The inertias.** They enter (4) only as the sum $J = I_{e,g} + I_{b,g} + m_b H_b^2$. One number,
# $r = 0.74$, gives one number:

# %%
J = sp.Symbol("J", positive=True)
known = {name: numbers[name] for name in (m_e, m_b, H_e, B)}
ratio = e.subs(I_eg, J - I_bg - m_b * H_b**2)
assert sp.simplify(ratio.diff(I_bg)) == 0
assert sp.simplify(ratio.diff(H_b)) == 0

J_of = {r: sp.solve(ratio.subs(known) - sp.sqrt(r), J)[0] for r in (0.735, 0.74, 0.745)}
print({r: round(float(value), 1) for r, value in J_of.items()}, "kg m2")
assert np.isclose(float(J_of[0.74]), 46.7, atol=0.1)
chosen = (
    COLUMN["inertia"] + COLUMN["base_inertia"] + COLUMN["base_mass"] * COLUMN["base_height"] ** 2
)
assert float(J_of[0.735]) < chosen < float(J_of[0.745])
assert np.isclose(column.velocity_ratio**2, 0.74, atol=5e-4)

# %% [markdown]
# The text does not say how $J$ is shared among its three parts, and it hardly matters: $H_b$
# enters the moment of the base's weight, which is small, and the rest nothing. The split that we
# use is one choice among many.
#
# ## 6. The release of run 1
#
# Between impacts energy is conserved, at each impact it is multiplied by $r$. So the peaks need no
# integration: with the potential energy (thesis 5-3)
#
# $$ U(\theta) = \sum m g R\,\bigl[\cos(\alpha - |\theta|) - \cos\alpha\bigr], \qquad
#    U(\theta_{i+1}) = r\,U(\theta_i) . \tag{5} $$

# %%
levers_of = [(COLUMN["mass"], 1.05), (COLUMN["base_mass"], 0.10)]


def potential(theta):
    """Equation (5) [J]."""
    total = 0.0
    for mass, height in levers_of:
        radius, angle = np.hypot(0.285, height), np.arctan2(0.285, height)
        total += mass * 9.81 * radius * (np.cos(angle - np.abs(theta)) - np.cos(angle))
    return total


def peaks_by_energy(r):
    """(8,) displacements at the peaks after the release [mm], with their signs."""
    found = [rotations[0]]
    while len(found) < len(PEAKS):
        left = r * potential(found[-1])
        found.append(brentq(lambda x, left=left: potential(x) - left, 0.0, found[-1]))
    return displacement_at(np.array(found) * np.sign(PEAKS))


def rms(peaks):
    """Root mean square error of the peaks that follow the release [mm]."""
    return np.sqrt(np.mean((peaks - PEAKS)[1:] ** 2))


# %% [markdown]
# The engine integrates (3) and finds the impacts. Its peaks must be those of (5).


# %%
def released(r):
    """The column let go from the first measured peak."""
    start = {"theta": rotations[0]}
    still = rk.GroundMotion.none(2.0)
    return rk.simulate(column, still, impact=rk.EnergyRatio(r), initial=start)


def peaks_of(run):
    """(8,) displacements at the gauge at the peaks of a simulation [mm]."""
    edges = [0.0, *(impact.time for impact in run.impacts[:8])]
    found = []
    for start, end in pairwise(edges):
        theta = run["theta"][(run.t >= start) & (run.t < end)]
        found.append(displacement_at(theta[np.abs(theta).argmax()]))
    return np.array(found)


runs = {r: released(r) for r in (0.74, 0.81)}
for r, run in runs.items():
    np.testing.assert_allclose(peaks_of(run), peaks_by_energy(r), atol=1e-3)
    print(f"r = {r}: rms error of seven peaks {rms(peaks_of(run)):.2f} mm")

assert np.isclose(rms(peaks_by_energy(0.74)), 3.6, atol=0.05)
assert np.isclose(rms(peaks_by_energy(0.81)), 0.96, atol=0.01)

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(7.0, 3.3), layout="constrained")
for (r, run), color in zip(runs.items(), (fb.LINES[1], fb.LINES[0]), strict=True):
    start = CROSSINGS[0] - run.impacts[0].time
    ax.plot(start + run.t, displacement_at(run["theta"]), color=color, label=f"Model A, $r={r}$")
ax.plot(TIMES, PEAKS, "o", color=fb.INK, ms=5, label="measured peaks")
ax.plot(CROSSINGS[0], 0, "s", color=fb.INK, ms=4, label="measured crossing")
ax.axhline(0, color=fb.INK, lw=0.6)
ax.set(xlabel="time [s]", ylabel="displacement at the gauge [mm]", xlim=(0.1, 1.9))
ax.legend(loc="upper right", ncols=2)
plt.show()

fall = runs[0.74].impacts[0].time
print(f"from release to first impact: model {fall:.3f} s, list {CROSSINGS[0] - TIMES[0]:.3f} s")

# %% [markdown]
# *Figure 3. Release of run 1 (thesis Figures 5-22 and 5-23), the time counted so that the first
# passages through the upright position coincide. The theoretical $r$ takes too much.*
#
# Why not count from the release? The list of Figure 5-6 puts the first peak 0.20 s before the first
# crossing, and the model needs 0.15 s, in which there is no impact. The column was held still and
# then let go: the curve is flat there, and when it was let go is hard to read.
#
# **Times are a test of their own.** Between two crossings there is no impact either. A half cycle
# with a given peak takes the model twice the time of a release from there, whatever $r$ is:

# %%
half_cycles = []
for angle in rotations[1:]:
    run = rk.simulate(column, rk.GroundMotion.none(1.0), initial={"theta": angle})
    half_cycles.append(2 * run.impacts[0].time)
ratios = np.diff(CROSSINGS) / half_cycles
print("measured over computed half cycles:", ratios.round(3))
assert np.all((ratios > 0.925) & (ratios < 0.945))

# %% [markdown]
# All measured half cycles are 6 to 7 % shorter. The coefficient of restitution is not the cause,
# and no fit of $r$ removes the difference. By (3), times are proportional to $\sqrt{I_O}$ and
# depend on the weights too. If the weights and heights are right, the test has a smaller moment of
# inertia:

# %%
measured_inertia = float(numbers[I_O]) * ratios.mean() ** 2
implied_J = measured_inertia - float((pivot_inertia - I_eg - I_bg - m_b * H_b**2).subs(numbers))
implied_r = float(ratio.subs(known).subs(J, implied_J)) ** 2
print(f"I_O {float(numbers[I_O]):.0f} -> {measured_inertia:.0f} kg m2,", end=" ")
print(f"J {chosen:.1f} -> {implied_J:.1f} kg m2, r of (4) 0.74 -> {implied_r:.2f}")
assert 0.69 < implied_r < 0.72

# %% [markdown]
# Such a column should lose *more* at an impact than the thesis's 0.74 says, and it loses less.
# Times and amplitudes are two independent tests of a model; a fit to one must not hide the other.
#
# **Velocities or energies?** The thesis writes that the velocity was reduced "to $r$ (0.74) times"
# its value. By its own definition (2-4) $r$ is a ratio of energies, and the velocity should be
# multiplied by $\sqrt{0.74} = 0.86$. Which of the two was computed? To multiply the velocity by
# 0.74 is to multiply the energy by 0.55; the third peak would be half of the measured one.

# %%
literally = peaks_by_energy(0.74**2)
print("velocity times 0.74:", literally.round(1), " rms", rms(literally).round(1), "mm")
assert rms(literally) > 8.0

# %% [markdown]
# **What does the test say about $r$?** Read backwards, (5) gives one $r$ for each impact (thesis
# 5-4). They scatter, and they grow as the amplitude falls.

# %%
measured_r = potential(rotations[1:]) / potential(rotations[:-1])
best = minimize_scalar(lambda r: rms(peaks_by_energy(r)), bounds=(0.7, 0.95), method="bounded")
print("impact by impact:", measured_r.round(3), " mean", measured_r.mean().round(3))
print(f"least squares over all peaks: {best.x:.3f}, rms {best.fun:.2f} mm")

assert np.isclose(measured_r.mean(), 0.837, atol=2e-3)
assert 0.81 < best.x < 0.82

# %% [markdown]
# So a mean of ratios (0.837) and a fit of peaks (0.817) are different questions with different
# answers; the thesis's 0.81 is close to the second. Both are above what angular momentum allows a
# rigid structure with plastic impacts, 0.74. So an assumption does not hold in the test. A likely
# one is that the impulse acts at the very edge: a foot has some width (Exercise 2).

# %% [markdown]
# ## Exercises
#
# 1. Take moments about the *centroid of the whole* instead of the pivot, with the ground's forces
#    as unknowns, and eliminate them. *Hint: Newton's law for the centroid gives both forces; see
#    Section 2 of [Housner's block](housner_block.py).*
# 2. Where would the impulse have to act for $r = 0.81$? *Hint: put the new pivot at a distance
#    $b < B$ from the centre, keep the old one, and repeat Section 4.*
# 3. Show that a single lumped mass without inertia ($m_b = I_{e,g} = 0$) has
#    $e = \cos 2\alpha_e$. For which shape does the impact stop it? *Hint: $H_e = B$.*
# 4. Which horizontal ground acceleration lifts a foot of the column? Compare with (3) and with
#    `column.pushover([0.0])`. *Hint: it depends on the centroid only.*
# 5. Replace the two masses by one at their common centroid with the same $I_O$. Is the motion the
#    same? And the impact? *Hint: what is the sum of $mR\sin(\alpha - s\theta)$ over both masses?*
# 6. Simulate run 3 of the thesis: El Centro with the time scaled to 1/5 and the peak to 0.8 g, with
#    both values of $r$. How much do they differ, and why more than in Figure 3?
#    *Hint: `rk.GroundMotion.from_library`, and the README.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Newton's law for all masses together gives $F = \sum m(\ddot x + \ddot u_g)$ and
# $N = \sum m(g + \ddot y)$ at the foot. Their moments about the centroid, put into Euler's law for
# the whole, are the moments of the single inertia forces and weights about the foot: (3) again, by
# a longer way.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# About a new pivot at $-b$ the masses have $m(H^2 - bB)\,\dot\theta_1$ before and
# $m(H^2 + b^2)\,\dot\theta_2$ after the impact. $e = 0.9$ is a quadratic equation for $b$, with the
# root 0.223 m: the impulse acts 62 mm inside the edge.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $e = (H_e^2 - B^2)/(H_e^2 + B^2) = \cos2\alpha_e$. At $H_e = B$ it is zero: the mass comes in
# along the line to the new pivot, and its momentum has no moment about it.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# $g\,B/H_c = 3.53$ m/s², where $H_c$ is the height of the common centroid: (3) at $\theta = 0$. The
# pushover gives the same moment $WB$ by a force at the height $H_e$ alone, 448 N.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# Both are the same. $mR\sin(\alpha - s\theta) = m(B\cos\theta - sH\sin\theta)$ is linear in $B$ and
# $H$, and so is the cosine: the sums are those of the centroid. And $e = 1 - 2(m_e+m_b)B^2/I_O$ has
# nothing but the total mass and $I_O$ in it. For a rigid structure three numbers are all there is.
#
# </details>
#
# <details><summary>Solution 6</summary>
#
# The mass moves by 6.4 mm with $r = 0.74$ and by 8.3 mm with 0.81, 30 % more. In a release each
# impact changes only what is left. Under shaking it also changes when the next one comes, and
# whether the ground then pushes or brakes: the two motions part company after a few impacts.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
one_by_one = [(m_e, R_e, alpha_e, I_eg), (m_b, R_b, alpha_b, I_bg)]
spots = [from_pivot(R, alpha, 1) for _, R, alpha, _ in one_by_one]
common = sum((m * r for (m, *_), r in zip(one_by_one, spots, strict=True)), sp.zeros(2, 1))
common /= m_e + m_b
pushes = [
    -m * (r.diff(t, 2) + sp.Matrix([a_g, g])) for (m, *_), r in zip(one_by_one, spots, strict=True)
]
foot = -(pushes[0] + pushes[1])  # F and N
about_G = clockwise(-common, foot) - (I_eg + I_bg) * rotation.diff(t, 2)
about_G += sum(clockwise(r - common, push) for r, push in zip(spots, pushes, strict=True))
about_G = about_G.subs(rotation.diff(t, 2), theta_dd).subs(rotation.diff(t), 0.7)
point = numbers | {theta: 0.11, theta_dd: -1.3, a_g: 0.4}
assert np.isclose(
    float(about_G.subs(rotation, theta).subs(point)), float(about_O.subs(point)), rtol=1e-9
)

about_centre = chosen + COLUMN["mass"] * COLUMN["height"] ** 2
total = COLUMN["mass"] + COLUMN["base_mass"]


def velocity_ratio_at(b):
    return (about_centre - total * b * 0.285) / (about_centre + total * b**2)


assert np.isclose(velocity_ratio_at(0.285), column.velocity_ratio)
inside = brentq(lambda b: velocity_ratio_at(b) - 0.9, 0.0, 0.285)
assert round(inside, 3) == 0.223

single = e.subs({m_b: 0, I_eg: 0, I_bg: 0}).subs(
    {B: R_e * sp.sin(alpha_e), H_e: R_e * sp.cos(alpha_e)}
)
assert sp.simplify(single - sp.cos(2 * alpha_e)) == 0

middle = float(centroid_height.subs(numbers))
assert np.isclose(column.uplift_acceleration, 9.81 * 0.285 / middle)
assert round(column.uplift_acceleration, 2) == 3.53
assert np.isclose(column.pushover([0.0])[0], total * 9.81 * 0.285 / 1.05)
assert round(float(column.pushover([0.0])[0])) == 448

merged = rk.RigidBlock(
    half_width=0.285, half_height=middle, mass=total,
    inertia=float(numbers[I_O]) - total * (0.285**2 + middle**2),
)  # fmt: skip
assert np.isclose(merged.velocity_ratio, column.velocity_ratio, rtol=1e-12)
here = {"theta": 0.05, "theta_dot": 0.3}
one, other = (s.accelerations(here, ground_acceleration=1.0)["theta"] for s in (merged, column))
assert np.isclose(one, other, rtol=1e-12)

shaking = rk.GroundMotion.from_library("El Centro 1940 180").scaled(time=0.2).scaled_to(0.8 * 9.81)
largest = {
    r: np.abs(rk.simulate(column, shaking, impact=rk.EnergyRatio(r))["displacement"]).max()
    for r in (0.74, 0.81)
}
assert [round(1e3 * value, 1) for value in largest.values()] == [6.4, 8.3]
exercises = Exercises({2: inside, 4: column.uplift_acceleration, 6: 1.3})

# %%
# your answers
exercises.check(2, ...)  # distance b in metres
exercises.check(4, ...)  # in m/s2
exercises.check(6, ...)  # largest displacement with r = 0.81 over that with 0.74
