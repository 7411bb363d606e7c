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
#     level: research
#     minutes: 60
# ---

# %% [markdown]
# # Derive your own structure
#
# The other notebooks are about structures that somebody chose. This one starts from a sketch: an
# L-shaped wall element that stands free, as it leaves the factory. It is neither symmetric nor held
# down, and it is in no book. We go from the sketch to a declaration, look at what is derived from
# it, check it before we believe it, and only then watch it move. The exercises do the same with
# structures of your own.
#
# ## Aims
#
# After this notebook you can
#
# 1. turn a sketch into bodies, coordinates and contacts, and say what is *not* to be declared;
# 2. read the modes and equations that follow, and compare them with your own;
# 3. find four checks for any structure that need no other program;
# 4. declare feet at different heights, a tendon, an elastic column.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.plots import draw_structure, free_body as fb, use_style
from rockeom.symbolic import Body, Contact, Model, Rigid, coordinate, feet, parameter, turned
from rockeom.symbolic.algebra import at_side
from rockeom.symbolic.model import GROUND_X, GROUND_Y

use_style()

# %% [markdown]
# ## 1. The sketch
#
# The element is cut from two rectangles of concrete, 0.5 m deep: a foot slab, 1 m wide and 0.25 m
# thick, and an upright, 0.3 m wide and 2.2 m high, on the right end of it. It stands on the two
# edges of the slab. For a rigid body only four numbers count: the mass $m$, where the centroid is,
# $d$ to the right of the slab's middle and $h$ above the ground, and the moment of inertia $I$
# about it. The rectangles give them:
#
# $$d = \frac{\sum m_i x_i}{m}, \qquad h = \frac{\sum m_i y_i}{m}, \qquad
#   I = \sum m_i\left(\frac{b_i^2 + h_i^2}{12} + (x_i-d)^2 + (y_i-h)^2\right). \tag{1}$$

# %%
DENSITY = 2400.0 * 0.5  # kg/m2 of the drawing
RECTANGLES = [(0.0, 0.125, 1.0, 0.25), (0.35, 1.35, 0.3, 2.2)]  # centre x, y, width, height [m]
OUTLINE = [(-0.5, 0), (0.5, 0), (0.5, 2.45), (0.2, 2.45), (0.2, 0.25), (-0.5, 0.25)]
B_ = 0.5  # m

masses = np.array([DENSITY * width * height for *_, width, height in RECTANGLES])
places = np.array([place for *place, _, _ in RECTANGLES])
sizes = np.array([width**2 + height**2 for *_, width, height in RECTANGLES])
mass = masses.sum()
d_, h_ = masses @ places / mass
inertia_ = masses @ (sizes / 12 + ((places - [d_, h_]) ** 2).sum(axis=1))

# another way: integrals over the outline, by Green's theorem
x0, y0 = np.transpose(OUTLINE)
x1, y1 = np.roll(x0, -1), np.roll(y0, -1)
cross = x0 * y1 - x1 * y0
area = cross.sum() / 2
polar = ((x0**2 + x0 * x1 + x1**2 + y0**2 + y0 * y1 + y1**2) * cross).sum() / 12
assert math.isclose(mass, DENSITY * area)
assert math.isclose(d_, ((x0 + x1) * cross).sum() / (6 * area))
assert math.isclose(h_, ((y0 + y1) * cross).sum() / (6 * area))
assert math.isclose(inertia_, DENSITY * (polar - area * (d_**2 + h_**2)))
print(f"m = {mass:.0f} kg, d = {d_:.4f} m, h = {h_:.4f} m, I = {inertia_:.1f} kg m2")


# %% tags=["hide-input"] jupyter={"source_hidden": true}
def draw(ax, x=0.0, y=0.0, theta=0.0):
    """The element with the middle of its base at (x, y): its corners, and the centroid."""
    points = [(x + a, y + b) for a, b in [*OUTLINE, (d_, h_)]]
    *corners, centre = fb.turned(points, (x, y), theta)
    fb.body(ax, corners)
    return np.array(corners), centre


figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 4.6), layout="constrained")
corners, centre = draw(left)
fb.ground(left, -0.9, 0.9, depth=0.07)
fb.centroid(left, centre, "$G$", (9, 7))
fb.dimension(left, (-0.5, 0), (0.5, 0), "$2B$", -0.22, (0, -8))
fb.dimension(left, (0, h_), (d_, h_), "$d$", 0.0, (0, 9))
fb.dimension(left, (-0.5, 0), (-0.5, h_), "$h$", 0.15, (-9, 0))
fb.line(left, (0, 0), (0, 1.2))
left.set_title("(a) the sketch")

place = (0.12, 0.32)
corners, centre = draw(right, *place, 0.17)
fb.ground(right, -0.9, 0.9, depth=0.07)
fb.centroid(right, centre, "$G$", (-11, 6))
fb.line(right, place, (place[0], 1.6))
top = fb.turned([(place[0], place[1] + 1.2)], place, 0.17)[0]
fb.line(right, place, top)
fb.angle(right, place, (place[0], 2), top, 0.9, r"$\theta$", sense=True, label_radius=1.1)
right.plot(*place, "s", ms=4, color=fb.INK, zorder=8)
right.annotate("$x, y$", place, (-4, -13), textcoords="offset points")
foot = corners[1]
fb.dimension(right, (foot[0], 0), tuple(foot), "", 0.0)
right.annotate("gap", (foot[0], foot[1] / 2), (6, -3), textcoords="offset points")
fb.arrow(right, (foot[0], -0.2), (foot[0] + 0.3, -0.2), "slip", color=fb.MOTION, offset=(0, -9))
right.set_title("(b) free: nothing holds it")
for ax in (left, right):
    fb.bare(ax)
plt.show()

# %% [markdown]
# *Figure 1. (a) The element. (b) Its coordinates when nothing holds it: place and height of the
# middle of the base, and the rotation, positive clockwise; gap and slip of the right foot.*
#
# ## 2. The declaration
#
# Think of the structure in flight. How many numbers say where it is? For a rigid body in the plane
# three: $x$, $y$, $\theta$. Everything else is *said in them*:
#
# - **bodies**: a mass, the place of its centroid, an inertia and the angle through which it turns;
# - **contacts**: of each point that may touch, the *gap*, which cannot become negative, the *slip*,
#   its place along the ground, and a *law*.
#
# The declaration does not say which foot stands, that it turns about it, when it lifts, slips or
# lands, and what an impact does. `feet` writes both points at once, with `side` $= \mp 1$.

# %%
x = coordinate("x", "x", "m", "place of the middle of the base, positive to the right")
y = coordinate("y", "y", "m", "height of the middle of the base")
theta = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
parameters = [
    parameter("m", "mass", "kg", "mass"),
    parameter("I", "inertia", "kg m2", "moment of inertia about the centroid"),
    parameter("d", "offset", "m", "of the centroid, to the right of the middle"),
    parameter("h", "height", "m", "of the centroid above the base"),
    parameter("B", "half_width", "m", "half of the distance between the feet"),
    parameter("mu", "friction", "-", "coefficient of friction of the feet"),
    parameter("g", "gravity", "m/s2", "acceleration of gravity"),
]
m, inertia, d, h, B, mu, g = (p.symbol for p in parameters)


def placed(across, up):
    """A point of the element, by its place when the element is upright at x = 0."""
    right, above = turned((across, up), (0, 0), theta.position)
    return x.position + right, y.position + above


corners = [(across - d, up - h) for across, up in OUTLINE]  # from the centroid, to be drawn


def declared(**more):
    """The element; `more` is what an exercise adds to it or changes."""
    given = {
        "name": "lopsided_block",
        "title": "Block with its centroid off the middle, on feet that slide",
        "parameters": parameters,
        "coordinates": [x, y, theta],
        "bodies": [Body("block", m, placed(d, h), inertia, theta.position, outline=corners)],
        "gravity": g,
        "rotation": theta,
        "contacts": feet(
            gap=lambda side: placed(side * B, 0)[1],
            slip=lambda side: placed(side * B, 0)[0],
            law=Rigid(restitution=0, friction=mu),
        ),
        "load_point": placed(d, h),
    }
    return Model(**(given | more))


element = declared()

# %% [markdown]
# ## 3. Derived modes and equations
#
# Each foot may be open, stick, or slip to either side; two level feet on one rigid base can only
# slip together. That makes ten modes.

# %%
print(", ".join(element.modes.names))
ways = "", "_slides_right", "_slides_left"
touching = {f"{feet_down}{way}" for feet_down in ("both", "left", "right") for way in ways}
assert set(element.modes.names) == touching | {"flight"}

# %% [markdown]
# The equations of each can be read. By hand: on its right foot, which sticks, the element is a
# pendulum about it. From the foot the centroid is at $(-(B-d), h)$ when upright, so
#
# $$\left(I + m\,[(B-d)^2 + h^2]\right)\ddot\theta =
#   -m(g+\ddot y_g)\,[(B-d)\cos\theta - h\sin\theta]
#   - m\ddot x_g\,[h\cos\theta + (B-d)\sin\theta]. \tag{2}$$
#
# On the left foot $B - d$ is replaced by $-(B + d)$: the derived equation serves both sides, with
# $s = \pm1$ in it.

# %%
sine, cosine = sp.sin(theta.position), sp.cos(theta.position)
for name, side, lever in [("right", 1, B - d), ("left", -1, -(B + d))]:
    mode = element.mode(name)
    matrix, forcing = (at_side(e[0], side) for e in (mode.mass_matrix, mode.forcing))
    pivot_inertia = inertia + m * (lever**2 + h**2)
    moment = -m * (g + GROUND_Y) * (lever * cosine - h * sine)
    moment -= m * GROUND_X * (h * cosine + lever * sine)
    assert sp.expand(matrix - pivot_inertia) == 0
    assert sp.expand(forcing - moment) == 0

# standing on both feet: statics
normal, friction = element.mode("both").forces
assert sp.expand(normal[1].subs({GROUND_X: 0, GROUND_Y: 0}) - m * g * (B + d) / (2 * B)) == 0
assert friction[0] == m * GROUND_X  # of both feet together; of each alone statics says nothing

# %% [markdown]
# `element.markdown()` and `element.latex()` show all of them, typeset.
#
# ## 4. Four checks before you believe it
#
# `rk.structure` compiles what was derived; from here on it is a structure like any other.

# %%
VALUES = {
    "mass": mass, "inertia": inertia_, "offset": d_, "height": h_, "half_width": B_,
    "gravity": 9.81,
}  # fmt: skip


def built(**changes):
    return rk.structure(element, **(VALUES | {"friction": 0.5} | changes))


wall = built()

# %% [markdown]
# **A picture.** The first thing to look at: what was declared, drawn in any state. The places of
# its points are there by name, too, and must be those of sketch (b) of Figure 1.

# %% tags=["hide-input"] jupyter={"source_hidden": true}
_, ax = plt.subplots(figsize=(2.6, 3.4))
draw_structure(wall, state={"x": 0.12, "y": 0.32, "theta": 0.17}, ax=ax)
plt.show()

# %% [markdown]
# *Figure 2. The declared element, drawn from its places, its outline and its contacts.*

# %%
places_now = wall.positions({"x": 0.12, "y": 0.32, "theta": 0.17})
(by_hand,) = fb.turned([(0.12 + d_, 0.32 + h_)], (0.12, 0.32), 0.17)
assert np.allclose(places_now["block"], by_hand)
assert math.isclose(wall.positions({"theta": 0.1})["left"][1], 2 * B_ * math.sin(0.1))

# %% [markdown]
# **Statics.** The forces at rest, and the acceleration of the ground that lifts a foot: $g(B-d)/h$
# if it pulls the ground away to the left, so that the element leans to the right, and $g(B+d)/h$
# to the other side.

# %%
at_rest = wall.reactions({})
assert math.isclose(at_rest["right_reaction"], mass * 9.81 * (B_ + d_) / (2 * B_))
assert math.isclose(at_rest["left_reaction"] + at_rest["right_reaction"], mass * 9.81)

grippy = built(friction=1.2)
for towards, lever in [("right", B_ - d_), ("left", -(B_ + d_))]:
    lifting = -9.81 * lever / h_
    for share, expected in [(0.999, "both"), (1.001, towards)]:
        pushed = rk.simulate(grippy, rk.GroundMotion.constant(share * lifting, 1e-4))
        assert pushed.mode[-1] == expected

# %% [markdown]
# **A limit that is known.** With $d = 0$ it is the block of
# [the notebook on sliding](sliding_and_bouncing.py), within the tolerance of the integration.

# %%
still = rk.GroundMotion.none(3.0)
middle = built(offset=0.0, friction=0.15)
block = rk.SlidingBlock(
    half_width=B_, half_height=h_, mass=mass, inertia=inertia_, friction=0.15, restitution=0.0
)
one, other = (rk.simulate(s, still, initial={"theta": 0.1}) for s in (middle, block))
assert any(event.kind == "slip begins" for event in one.events)
times = np.linspace(0.0, 3.0, 100)
for state in ("x", "y", "theta"):
    assert np.allclose(one.at(times)[state], other.at(times)[state], atol=1e-9)

# %% [markdown]
# **What a landing must conserve.** Landing on its left foot, with all else free to leave, the
# element keeps its angular momentum about that foot. Before, it turned about its right foot, and
#
# $$\frac{\dot\theta^+}{\dot\theta^-} =
#   \frac{I + m\,[h^2 - (B+d)(B-d)]}{I + m\,[h^2 + (B+d)^2]}. \tag{3}$$

# %%
run = rk.simulate(grippy, still, initial={"theta": 0.12})
landing = run.impacts[0]
assert landing.contact == "left"
kept = (inertia_ + mass * (h_**2 - (B_ + d_) * (B_ - d_))) / (
    inertia_ + mass * (h_**2 + (B_ + d_) ** 2)
)
assert math.isclose(landing.after["theta_dot"] / landing.before["theta_dot"], kept, rel_tol=1e-9)
print(f"a landing on the left foot keeps {kept:.3f} of the angular velocity")

# %% [markdown]
# **Energy.** Between impacts it falls only by the work of friction, $\mu N$ times the path that the
# foot slips, and no landing adds any.

# %%
slippery = built(friction=0.1)
run = rk.simulate(slippery, still, initial={"theta": 0.12})
t, energy = run.t, run["total_energy"]
slipping = np.char.find(run.mode.astype(str), "slides") >= 0
assert slipping.any()
points = {foot: (run[f"{foot}_friction"], run[f"{foot}_slip"]) for foot in ("left", "right")}
for first, last in zip(run.events[:-1], run.events[1:], strict=True):
    inside = np.linspace(first.time, last.time, 200)
    if last.time - first.time < 1e-3:
        continue
    names = ["total_energy", *(f"{f}_{w}" for f in points for w in ("friction", "slip"))]
    early = run.at(inside[:-1], names=names)
    late = run.at(inside[1:], side="left", names=names)
    work = sum(
        ((early[f"{f}_friction"] + late[f"{f}_friction"]) / 2
         * (late[f"{f}_slip"] - early[f"{f}_slip"])).sum()
        for f in points
    )  # fmt: skip
    change = late["total_energy"][-1] - early["total_energy"][0]
    assert math.isclose(change, work, rel_tol=1e-3, abs_tol=1e-6 * energy[0])
for impact in run.impacts:
    after, before = (
        sum(slippery.energies(state, mode=mode).values())
        for state, mode in (
            (impact.after, impact.mode_after),
            (impact.before, impact.mode_before),
        )
    )
    assert after <= before * (1 + 1e-12)

# %% [markdown]
# ## 5. Motion
#
# Now it may be shaken: by one sine, on feet with three frictions. What would it do? The ground
# starts to the left, and the element is pushed to the right, towards its short side: with
# $\mu < (B-d)/h$ it slides before it can lift, with more it leans.

# %%
pulse = rk.GroundMotion.single_sine(amplitude=-4.0, period=1.4, duration=6.0)
runs = {friction: rk.simulate(built(friction=friction), pulse) for friction in (0.2, 0.35, 0.6)}
for friction, run in runs.items():
    first = [f"{event.time:.3f} s {event.kind} ({event.contact})" for event in run.events[:3]]
    print(f"mu = {friction}: {run.outcome}; {', '.join(first)}")

assert 0.2 < (B_ - d_) / h_ < 0.35
first = [run.events[0].kind for run in runs.values()]
assert first == ["slip begins", "lifting", "lifting"]
began = 1.4 / math.tau * math.asin(0.2 * 9.81 / 4.0)  # when the push is mu g
assert math.isclose(runs[0.2].events[0].time, began, rel_tol=1e-9)
assert not runs[0.2]["theta"].any()
outcomes = [run.outcome for run in runs.values()]
assert outcomes == [rk.Outcome.CAME_TO_REST, rk.Outcome.CAME_TO_REST, rk.Outcome.OVERTURNED]
walked = [abs(runs[friction].final["x"]) for friction in (0.2, 0.35)]
assert walked[1] > 10 * walked[0]
leaning, landing = runs[0.35], runs[0.35].impacts[0]
assert landing.mode_before == "right"
assert landing.mode_after == "left_slides_left"
assert np.ptp(leaning["right_slip"][leaning.t < landing.time]) < 1e-9

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, (ax, below) = plt.subplots(2, 1, figsize=(6.2, 4.2), sharex=True, layout="constrained")
for friction, run in runs.items():
    stands = np.abs(run["theta"]) < 0.5
    ax.plot(run.t[stands], run["theta"][stands], label=rf"$\mu = {friction}$")
    below.plot(run.t[stands], 1e3 * run["x"][stands])
ax.set(ylabel=r"$\theta$ [rad]", xlim=(0, 4))
ax.legend()
below.set(xlabel="time [s]", ylabel="middle of the base [mm]", ylim=(-260, 300))
plt.show()

# %% [markdown]
# *Figure 3. The same pulse on three frictions, each followed until it leans by 0.5 rad. The
# slipperiest stays upright and slides there and back. The roughest falls. The one in between does
# not fall, and has walked to the left, although the pulse is the same both ways: in its first half
# it leans to the right on a foot that holds, in its second it slides to the left on the other one.*
#
# ## Exercises
#
# Each has an answer that you can check.
#
# 1. **A leg.** The right foot stands on a leg of the length $\ell$ below the base. Declare it: two
#    `Contact`s, no longer a mirrored pair. At which angle does the element stand? *Hint:
#    `model.modes.standing` must say $-\arctan\frac{\ell}{2B}$: it leans to the left.*
# 2. **A tendon.** An elastic tendon is anchored in the ground at $x = 0$ and ends at a point of the
#    element, at the height $H$ above the middle of its base. It pulls with $k$ times its
#    elongation, $k(L - H)$. Add `elastic_energy=`. By what does `forcing` of the mode "right"
#    change? *Hint: by $-k\,(L-H)\,\mathrm dL/\mathrm d\theta$ along the motion about the right
#    foot, where $x$ and $y$ follow $\theta$.*
# 3. **An elastic column.** Put a mass $m_1$ at the height $h_1$ on a column that bends by $u$, with
#    the stiffness $k_1$, and let the body be its base. Declare the coordinate $u$. What moves in
#    the mode "both"? *Hint: $m_1\ddot u + k_1 u = -m_1\ddot x_g$ and nothing else; in
#    "both_slides_left" the base moves along.*
# 4. **Ice.** Make the ground smooth, $\mu = 0$, and release the element from $\theta = 0.12$. Which
#    point moves on a vertical line? Check it in a simulation. *Hint: no horizontal force; the
#    built structure takes `friction=0.0`.*
# 5. **Three feet.** Add a foot under the middle of the base. Why is it refused, and what does the
#    message propose? *Hint: three normal forces, two equations of statics.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Two `Contact`s, one of them at `placed(B, -leg)`. In the position of rest both gaps are zero, and
# the line between the feet, which falls by $\ell$ over $2B$, is level.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# `elastic_energy=k * (length - H)**2 / 2`, with `length` the distance of the end from the anchor.
# About the right foot only $\theta$ is free, and `forcing` gets the derivative of that energy along
# this motion, with the opposite sign. Nobody had to find its lever.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# One more coordinate and one more body. In "both" the base cannot move, and $u$ alone is free; in
# "both_slides_left" $x$ is free, too, and friction couples the two.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# The centroid: no horizontal force acts on the element, and its horizontal velocity stays zero. The
# middle of the base goes to and fro by some centimetres below it.
#
# </details>
#
# <details><summary>Solution 5</summary>
#
# On three feet the two equations of statics leave one force open: each choice of it gives the same
# motion, but other feet that lift. The message proposes springs, whose compression gives the
# forces.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
# 1. a leg
leg = parameter("l", "leg", "m", "length of the right foot's leg")
law = Rigid(friction=mu)
ends = {"left": placed(-B, 0), "right": placed(B, -leg.symbol)}
on_a_leg = declared(
    name="on_a_leg",
    parameters=[*parameters, leg],
    contacts=[Contact(name, gap=up, slip=along, law=law) for name, (along, up) in ends.items()],
)
stands = on_a_leg.modes.standing[theta.position]
assert sp.simplify(stands + sp.atan(leg.symbol / (2 * B))) == 0

# 2. a tendon
k, H = parameter("k", "tendon", "N/m", "stiffness"), parameter("H", "top", "m", "tendon's end")
end = placed(0, H.symbol)
length = sp.sqrt(end[0] ** 2 + end[1] ** 2)
held = declared(
    name="held",
    parameters=[*parameters, k, H],
    elastic_energy=k.symbol * (length - H.symbol) ** 2 / 2,
)
stretched = held.mode("right").forcing[0] - element.mode("right").forcing[0]
start = {x.position: 0.02, theta.position: 0.1, B: 0.5, H.symbol: 2.0, k.symbol: 3e4}


def length_at(angle):
    """About the right foot, which stays where it is at the start."""
    pivot = 0.02 + 0.5 * math.cos(0.1)
    middle = np.array([pivot - 0.5 * math.cos(angle), 0.5 * math.sin(angle)])
    return math.hypot(*(middle + 2.0 * np.array([math.sin(angle), math.cos(angle)])))


slope = (length_at(0.1 + 1e-6) - length_at(0.1 - 1e-6)) / 2e-6
value = float(at_side(stretched, 1).subs(start))
assert math.isclose(value, -3e4 * (length_at(0.1) - 2.0) * slope, rel_tol=1e-6)

# 3. an elastic column
u = coordinate("u", "u", "m", "displacement of the column's end, at right angles to it")
m_1, h_1, k_1 = (
    parameter("m_1", "top_mass", "kg", "mass on the column"),
    parameter("h_1", "top_height", "m", "its height"),
    parameter("k_1", "stiffness", "N/m", "of the column"),
)
column = declared(
    name="column_on_feet",
    parameters=[*parameters, m_1, h_1, k_1],
    coordinates=[x, y, theta, u],
    bodies=[
        Body("top", m_1.symbol, placed(u.position, h_1.symbol)),
        Body("base", m, placed(d, h), inertia, theta.position),
    ],
    elastic_energy=k_1.symbol * u.position**2 / 2,
)
standing = column.mode("both")
assert [column.coordinates[i].name for i in standing.independent] == ["u"]
assert standing.mass_matrix == sp.Matrix([[m_1.symbol]])
lateral = -k_1.symbol * u.position - m_1.symbol * GROUND_X
assert sp.expand(standing.forcing[0] - lateral) == 0
slides = column.mode("both_slides_left")
assert [column.coordinates[i].name for i in slides.independent] == ["x", "u"]

# 4. ice
ice = rk.simulate(built(friction=0.0), still, initial={"theta": 0.12}, duration=1.0)
centroid = ice["x"] + d_ * np.cos(ice["theta"]) + h_ * np.sin(ice["theta"])
assert np.ptp(ice["x"]) > 0.05
assert np.ptp(centroid) < 1e-9

# 5. three feet
three = declared(
    name="three_feet",
    contacts=[
        Contact(name, gap=placed(across, 0)[1], slip=placed(across, 0)[0], law=law)
        for name, across in [("left", -B), ("middle", sp.S.Zero), ("right", B)]
    ],
)


def refusal(model):
    try:
        model.check_derived()
    except ValueError as refused:
        return str(refused)
    return ""


assert "statics leaves open" in refusal(three)
assert "springs" in refusal(three)
print(refusal(three))
