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
#     level: graduate
#     minutes: 50
# ---

# %% [markdown]
# # From edge to corner
#
# A record has two horizontal components, and a block has four corners. Does it need a model in
# space? Mostly not: it rocks about an edge as if there were no second component, until that one is
# strong enough to lift an end of the edge. We derive when. Then we ask what an impact on a corner
# costs, and why a can that seems to rock in a plane rolls around its rim instead.
#
# ## Aims
#
# After this notebook you can
#
# 1. derive the forces at both ends of an edge, and say which transverse acceleration lifts one;
# 2. derive the energy that the landing of a corner takes, and say where it is nothing;
# 3. derive the turn of the point of contact of a can that passes by flat.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.analysis import formulas
from rockeom.plots import use_style
from rockeom.teaching import Exercises

use_style()

b, c, h, mass, gravity = 0.25, 0.35, 1.5, 1000.0, 9.81  # m, kg, m/s2
prism = rk.Prism(width=2 * b, depth=2 * c, height=2 * h, mass=mass, gravity=gravity)
x, y = (rk.GroundMotion.from_library(f"El Centro 1940 {way}") for way in ("180", "270"))
tight = rk.SolverOptions(rtol=1e-12, atol=1e-15)

# %% [markdown]
# ## 1. Why a block stays on its edge
#
# The prism of $2b \times 2c \times 2h$ rocks about the edge at $x = b$, which is parallel to $y$,
# and leans by the pitch $\theta$. Its centroid is at the height
#
# $$z = h\cos\theta + b\sin\theta \tag{1}$$
#
# above the edge. Both ends of the edge press, with $N_s$ in the south, at $y = -c$, and $N_n$ in
# the north, at $y = c$. As long as the prism turns about the edge alone, its centroid does not move
# along $y$, and its angular momentum about the axis along $x$ stays zero. Then three equations
# hold: the vertical forces carry the weight, the friction $F_y$ accelerates the mass with the
# ground, and the moments about the centroid vanish,
#
# $$N_n + N_s = m\,(g + \ddot z), \qquad F_y = m\,a_y, \qquad
#   c\,(N_n - N_s) + z\,F_y = 0. \tag{2}$$
#
# So the second component changes the shares of both ends and nothing else:
#
# $$N_{n,s} = \frac m2\left(g + \ddot z \mp \frac zc\,a_y\right). \tag{3}$$
#
# Neither is negative, and the motion stays in the plane, as long as
#
# $$|a_y| \le \frac cz\,(g + \ddot z). \tag{4}$$
#
# For a slender block this is about $g\,c/h$, the acceleration that would lift it onto its other
# edge from rest. The pitch obeys Housner's equation meanwhile, whatever $a_y$ is:

# %%
theta, rate = sp.symbols("theta omega", real=True)
turn = -mass * (gravity * (b * sp.cos(theta) - h * sp.sin(theta)))  # and the shaking, below
height = h * sp.cos(theta) + b * sp.sin(theta)
slope, curvature = height.diff(theta), height.diff(theta, 2)
hinge = mass * sp.Rational(4, 3) * (b**2 + h**2)
a_x, a_y = sp.symbols("a_x a_y", real=True)
rising = slope * (turn - mass * a_x * height) / hinge + curvature * rate**2
ends = [mass / 2 * (gravity + rising + side * height / c * a_y) for side in (1, -1)]
forces = sp.lambdify((theta, rate, a_x, a_y), [*ends, rising])  # south, north, z''

both = rk.simulate(prism, x, transverse=y)
on_edge = both.mode == "south_east_north_east"
by_hand = np.array(
    forces(both["pitch"], both["pitch_dot"], x.acceleration(both.t), y.acceleration(both.t))
)[:, on_edge]
for end, values in zip(("south_east", "north_east"), by_hand[:2], strict=True):
    error = np.abs(both[f"{end}_reaction"][on_edge] - values).max()
    print(
        f"{end}: largest difference from (3) {error:.1e} N, of a weight of {mass * gravity:.0f} N"
    )
    assert error < 1e-6

# %% [markdown]
# Under both components of El Centro the force at no end falls to zero, and the pitch is the
# rotation of a planar block under the first component. One and a half times as strong, they lift an
# end of the edge just where (4) says so, and the prism rolls:

# %%
planar = rk.RigidBlock.from_dimensions(width=2 * b, height=2 * h, mass=mass, gravity=gravity)
plane = rk.simulate(planar, x)
peaks = both.extremes("pitch").peak, plane.extremes("theta").peak
print(f"peak in space {peaks[0]:.9f} rad, in the plane {peaks[1]:.9f} rad")
print(f"largest roll {both.extremes('roll').peak:.1e} rad")
assert math.isclose(*peaks, rel_tol=1e-8)

# %%
stronger = rk.simulate(prism, 1.5 * x, transverse=1.5 * y, duration=4.0)
lifts = next(e for e in stronger.events if e.mode_after.count("_") == 1)  # one corner is left
shaking = 1.5 * x.acceleration(lifts.time), 1.5 * y.acceleration(lifts.time)
mirrored = [-lifts.before["pitch"], -lifts.before["pitch_dot"], -shaking[0], shaking[1]]
south, north, _ = forces(*mirrored)  # about the west edge
print(f"x 1.5: it rolls from {lifts.time:.4f} s on, with a_y = {shaking[1]:.3f} m/s2, "
      f"forces {south / 9810:.1e} and {north / 9810:.3f} of the weight")  # fmt: skip
assert lifts.mode_before == "south_west_north_west"
assert min(abs(south), abs(north)) < 1e-6 * mass * gravity

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, ax = plt.subplots(figsize=(6.4, 3.0), layout="constrained")
for end, style in (("south_east", "-"), ("north_east", "--")):
    share = np.where(on_edge, both[f"{end}_reaction"], np.nan) / (mass * gravity)
    ax.plot(both.t, share, style, lw=0.7, label=end.replace("_", " "))
ax.axhline(0, color="0.5", lw=0.7)
ax.set(xlabel="time [s]", ylabel="force over the weight", xlim=(2, 14), ylim=(-0.05, 1.05))
ax.legend()
plt.show()

# %% [markdown]
# *Figure 1. The forces at both ends of the east edge while the prism rocks about it, under both
# components of El Centro. Where one of the curves reached zero, it would go onto a corner.*
#
# ## 2. What a corner costs
#
# On a corner $A$ the prism turns about a point. The next corner, $B$, arrives with the velocity
#
# $$\boldsymbol u = \boldsymbol\omega \times (\boldsymbol r_B - \boldsymbol r_A). \tag{5}$$
#
# It sticks, and $A$ lifts. The impulse $\boldsymbol P$ at $B$ changes the velocity of $B$ by
# $\boldsymbol\Lambda\boldsymbol P$, with the centroid at $\boldsymbol s$ from $B$ and the tensor
# $\boldsymbol J$ about the centroid,
#
# $$\boldsymbol\Lambda = \frac1m\,\boldsymbol 1
#   + [\boldsymbol s]^{\mathsf T}\boldsymbol J^{-1}[\boldsymbol s],\qquad
#   [\boldsymbol s]\,\boldsymbol a = \boldsymbol s \times \boldsymbol a. \tag{6}$$
#
# After the impact $B$ rests, so that $\boldsymbol P = -\boldsymbol\Lambda^{-1}\boldsymbol u$, and
# the kinetic energy has lost
#
# $$\Delta T = \tfrac12\,\boldsymbol u^{\mathsf T}\boldsymbol\Lambda^{-1}\boldsymbol u. \tag{7}$$
#
# There is no ratio that fits all impacts of a prism. The loss vanishes with $\boldsymbol u$, where
# the prism turns about the line from $A$ to $B$, which is rocking about that edge; and it is
# largest where it turns about an axis at right angles to it. We push the prism onto a corner, and
# compare (7) with each of its impacts.


# %%
def turning(state):
    """Angular velocity along the axes of the ground."""
    yaw, pitch = state["yaw"], state["pitch"]
    about_y = np.array([-math.sin(yaw), math.cos(yaw), 0.0])
    about_x = np.array([math.cos(yaw), math.sin(yaw), -math.tan(pitch)]) * math.cos(pitch)
    about_z = np.array([0.0, 0.0, 1.0])
    rates = [state[f"{name}_dot"] for name in ("yaw", "pitch", "roll")]
    return rates @ np.array([about_z, about_y, about_x])


def cross(s):
    return np.array([[0.0, -s[2], s[1]], [s[2], 0.0, -s[0]], [-s[1], s[0], 0.0]])


def energy_ratio(impact):
    """Kinetic energy after over that before, by (5) to (7)."""
    state = impact.before
    places, axes = prism.positions(state), prism.rotations(state)["body"]
    moments = np.diag([prism.parameters()[f"inertia_{axis * 2}"] for axis in "xyz"])
    tensor = axes @ moments @ axes.T
    arrives = cross(turning(state)) @ (places[impact.contact] - places[impact.mode_before])
    s = cross(places["body"] - places[impact.contact])
    compliance = np.eye(3) / mass + s.T @ np.linalg.solve(tensor, s)
    lost = arrives @ np.linalg.solve(compliance, arrives) / 2
    return 1.0 - lost / prism.energies(state)["kinetic_energy"]


pushed = rk.simulate(
    prism, rk.GroundMotion.none(4.0), initial={"pitch": 0.05, "roll": 0.03}, options=tight
)
landings = [e for e in pushed.impacts if e.mode_before.count("_") == 1]
ratios = np.array([energy_ratio(e) for e in landings])
engine = np.array([
    prism.energies(e.after)["kinetic_energy"] / prism.energies(e.before)["kinetic_energy"]
    for e in landings
])  # fmt: skip
print(f"{len(landings)} landings, ratios {ratios.min():.3f} to {ratios.max():.3f}")
assert np.abs(ratios - engine).max() < 1e-10

# %% tags=["hide-input"] jupyter={"source_hidden": true}
edge = planar.velocity_ratio**2
figure, ax = plt.subplots(figsize=(5.6, 3.0), layout="constrained")
ax.plot([e.time for e in landings], ratios, "o", ms=4, label="corner to corner, (7)")
ax.axhline(edge, color="0.5", ls="--", lw=0.8, label="edge to edge, over the width")
ax.set(xlabel="time of the impact [s]", ylabel="energy ratio")
ax.legend()
plt.show()

# %% [markdown]
# *Figure 2. Energy ratios of the impacts from corner to corner after a push. One ratio for all of
# them, as in the plane, is no model of this motion.*
#
# ## 3. The can that seems to rock
#
# Tip a can and let it go. It falls upright, and rises again on the other side: it seems to rock.
# But look where it rises. A round column of radius $b$ with its centroid at the height $H$, mass
# $m$ and moments of inertia $I_1$ about a diameter and $I_3$ about the axis rolls on its rim. Its
# tilt is $\theta$, the azimuth of the point of contact is $\psi$. The engine derives the kinetic
# energy:

# %%
model = rk.derive("wobbling_column")
tilt, azimuth = model.coordinates
motion = model.equations("right")
of = {p.name: p.symbol for p in model.parameters}
m, radius, centroid = of["mass"], of["radius"], of["centroid_height"]
i_1, i_3 = of["inertia_xx"], of["inertia_zz"]
straight = i_1 + m * (radius**2 + centroid**2)
cos, sin = sp.cos(tilt.position), sp.sin(tilt.position)
around = m * (radius * (1 - cos) + centroid * sin) ** 2 + i_1 * sin**2 + i_3 * (1 - cos) ** 2
by_hand = straight * tilt.velocity**2 / 2 + around * azimuth.velocity**2 / 2
rates = {tilt.velocity: 0.3, azimuth.velocity: 0.7, tilt.position: 0.2}
values = dict(zip((m, radius, centroid, i_1, i_3), (3.0, 0.25, 1.0, 1.1, 0.1), strict=True))
difference = (motion.kinetic_energy - by_hand).subs(rates | values)
assert abs(difference) < 1e-14
assert motion.mass_matrix[0, 1] == 0

# %% [markdown]
# $$T = \tfrac12 I_o\dot\theta^2 + \tfrac12 M(\theta)\dot\psi^2, \qquad
#   I_o = I_1 + m(H^2 + b^2), \tag{8}$$
#
# and close to upright $M \approx J\theta^2$ with $J = I_1 + mH^2$. Nothing depends on $\psi$, so
# that its momentum $p_\psi = M\dot\psi$ is constant. Near flat, gravity has no time to act: the can
# is there for an instant. The energy $I_o\dot\theta^2/2 + p_\psi^2/(2J\theta^2)$ is constant
# then, and the tilt turns back at the $\theta_m$ at which all of it is in the second part,
#
# $$\dot\theta^2 = \frac{p_\psi^2}{I_o J}
#   \left(\frac1{\theta_m^2} - \frac1{\theta^2}\right). \tag{9}$$
#
# It never comes flat. The azimuth turns by
# $\dot\psi\,dt = p_\psi\,d\theta/(J\theta^2\dot\theta)$ on the way in and as much on the way out,
#
# $$\Delta\psi = 2\sqrt{\frac{I_o}J}\int_{\theta_m}^\infty
#   \frac{\theta_m\,d\theta}{\theta\sqrt{\theta^2 - \theta_m^2}}
#   = \pi\sqrt{\frac{I_1 + m H^2 + m b^2}{I_1 + m H^2}}, \tag{10}$$
#
# whatever the momentum was: a smaller one makes the same turn in less time (Srinivasan and Ruina
# 2008).

# %%
part = sp.Symbol("u", positive=True)  # theta_m/theta
assert sp.integrate(1 / sp.sqrt(1 - part**2), (part, 0, 1)) == sp.pi / 2

can = rk.WobblingColumn(radius=0.033, height=0.12, mass=0.35, gravity=gravity)  # m, kg
inertia = can.parameters()["inertia_xx"]
upright = inertia + can.mass * 0.06**2
limit = math.pi * math.sqrt(1 + can.mass * can.radius**2 / upright)
print(f"by (10) {math.degrees(limit):.3f} degrees")
for precession in (1.0, 0.1, 0.01):  # rad/s
    start = {"tilt": 0.3 * can.alpha, "direction_dot": precession}
    run = rk.simulate(can, rk.GroundMotion.none(0.25), initial=start, options=tight)
    t = np.linspace(0.1, 0.25, 3001)
    highest = run.at(t)["tilt"].argmax()  # it stands highest there, and comes back
    turned = run.at(t)["direction"][highest]
    print(
        f"from {precession:g} rad/s {math.degrees(turned):.2f} degrees, {len(run.impacts)} impacts"
    )
    assert not len(run.impacts)
assert abs(turned - limit) < 0.01

# %% tags=["hide-input"] jupyter={"source_hidden": true}
start = {"tilt": 0.3 * can.alpha, "direction_dot": 0.1}
run = rk.simulate(can, rk.GroundMotion.none(0.87), initial=start, options=tight)
t = np.linspace(0.0, 0.87, 20000)
state = run.at(t)
figure, ax = plt.subplots(figsize=(4.0, 4.0), layout="constrained")
lean = np.degrees(state["tilt"])
ax.plot(lean * np.cos(state["direction"]), lean * np.sin(state["direction"]), lw=0.9)
ax.plot([math.degrees(start["tilt"])], [0], "o", ms=4)
ax.set(xlabel="tilt to x [degrees]", ylabel="tilt to y [degrees]", aspect="equal")
plt.show()

# %% [markdown]
# *Figure 3. The way to which a can leans, in five passages by flat, from the dot on. Each line
# seems to be one of rocking through upright; from one to the next it turns by 20 degrees more than
# half a turn.*
#
# Exactly in a plane, without any momentum, (10) says nothing: the can comes flat and strikes with
# the opposite rim. That is an impact, by the same momenta as that of a block of the same moment of
# inertia:

# %%
block = rk.RigidBlock(
    half_width=can.radius, half_height=0.06, mass=can.mass, inertia=inertia, gravity=gravity
)
struck = rk.simulate(can, rk.GroundMotion.none(0.2), initial={"tilt": 0.3 * can.alpha})
print(f"{len(struck.impacts)} impacts, ratio {can.velocity_ratio:.6f}, of the block "
      f"{block.velocity_ratio:.6f}")  # fmt: skip
assert math.isclose(can.velocity_ratio, block.velocity_ratio)
assert len(struck.impacts)

# %% [markdown]
# ## Exercises
#
# 1. **The other edge.** The prism of this notebook rocks about its east edge with
#    $\theta \approx 0$ and $\ddot z \approx 0$. Which transverse acceleration, in units of $g$,
#    lifts an end of the edge? *Hint: (4) with $z = h$.*
# 2. **The cost of nothing.** A square prism turns about its corner $A$ with $\boldsymbol\omega$
#    along the line from $A$ to the neighbour $B$. Which part of its kinetic energy does the landing
#    of $B$ take? *Hint: (5).*
# 3. **A coin.** A thin disc has $H = 0$ and $I_1 = m b^2/4$. By how many degrees does its point of
#    contact turn as it passes by flat? *Hint: (10).*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# $a_y/g = c/h = 0.35/1.5 \approx 0.233$.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# None: $\boldsymbol u = 0$. The corner $B$ is on the axis and does not move.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $\pi\sqrt{(1/4 + 1)/(1/4)} = \pi\sqrt5$, which is 402.5 degrees.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
for factor, lifts in ((0.99, False), (1.01, True)):
    pushes = {"transverse_ground_acceleration": factor * gravity * c / h}
    moves = prism.accelerations({}, ground_acceleration=-1.2 * gravity * b / h, **pushes)
    assert (abs(moves["roll"]) > 1e-9) == lifts
assert not np.any(cross([1.0, 0.0, 0.0]) @ np.array([2.0, 0.0, 0.0]))
coin = formulas.turn_of_contact(1.0, 1.0, 0.0, 0.25)
assert math.isclose(coin, math.pi * math.sqrt(5))
exercises = Exercises({1: c / h, 2: 0, 3: math.degrees(coin)})

# %%
# your answers
exercises.check(1, ...)  # acceleration in units of g
exercises.check(2, ...)  # part of the kinetic energy
exercises.check(3, ...)  # degrees
