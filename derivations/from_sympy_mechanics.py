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
#     minutes: 40
# ---

# %% [markdown]
# # From SymPy's mechanics to a rocking structure
#
# Many have the kinematics of a structure in `sympy.physics.mechanics` already: frames that turn,
# points that move with them, bodies with mass and inertia. Such bodies become a model here. We do
# it with a block, and with a tower in which a bell hangs, compare every equation with
# `LagrangesMethod`, and then do the part that `LagrangesMethod` leaves to you: uplift and impact.
#
# ## Aims
#
# After this notebook you can
#
# 1. turn bodies, points and frames of SymPy into a model with contacts;
# 2. show that two programs derive the same equations of motion, and say which equations those are;
# 3. couple a second body to a rocking one, and simulate both through uplift and impacts;
# 4. read the errors that a declaration outside the plane, or without a coordinate, gives.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from sympy.physics.mechanics import (
    LagrangesMethod,
    Lagrangian,
    Point,
    ReferenceFrame,
    RigidBody,
    dynamicsymbols,
    inertia,
)

import rockeom as rk
from rockeom.plots import draw_structure, use_style
from rockeom.symbolic import Model, Rigid, rectangle
from rockeom.symbolic.algebra import at_side
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.teaching import Exercises

use_style()

# %% [markdown]
# ## 1. A block in SymPy
#
# The frame $N$ rests on the ground, $\mathbf n_x$ to the right and $\mathbf n_y$ upwards. The block
# has a frame $A$ of its own, which turns about $\mathbf n_z$. SymPy counts angles counterclockwise;
# the rotation of a rocking structure is positive clockwise, hence the minus sign. With $C$ the
# middle of the base, the centroid and the feet are
#
# $$\mathbf r_G = x\,\mathbf n_x + y\,\mathbf n_y + h\,\mathbf a_y, \qquad
#   \mathbf r_{L,R} = x\,\mathbf n_x + y\,\mathbf n_y \mp b\,\mathbf a_x. \tag{1}$$

# %%
x, y, theta, phi = dynamicsymbols("x y theta phi")
m, b, h, J, g, mu = sp.symbols("m b h J g mu", positive=True)

N = ReferenceFrame("N")
O = Point("O")  # noqa: E741
O.set_vel(N, 0)


def block_at(base):
    """A block, and its left and right foot, with the middle of its base at a vector from O."""
    A = ReferenceFrame("A")
    A.orient_axis(N, N.z, -theta)
    C = O.locatenew("C", base(A))
    G = C.locatenew("G", h * A.y)
    G.set_vel(N, G.pos_from(O).dt(N))
    body = RigidBody("block", G, A, m, (inertia(A, 0, 0, J), G))
    return body, C.locatenew("L", -b * A.x), C.locatenew("R", b * A.x)


block, left, right = block_at(lambda A: x * N.x + y * N.y)
left.pos_from(O).express(N)

# %% [markdown]
# ## 2. The model
#
# `Model.from_mechanics` takes the bodies, and for each coordinate and each symbol what a reader of
# the response must know: a name, a unit, a meaning. Contacts are points with a law. A point may
# also be the place of a load or of a force.

# %%
COORDINATES = {
    x: ("x", "m", "place of the middle of the base, positive to the right"),
    y: ("y", "m", "height of the middle of the base"),
    theta: ("theta", "rad", "rotation, positive clockwise"),
}
PARAMETERS = {
    m: ("mass", "kg", "mass of the block"),
    b: ("half_width", "m", "half of the distance between the feet"),
    h: ("height", "m", "height of the centroid above the base"),
    J: ("inertia", "kg m2", "moment of inertia about the centroid"),
    g: ("gravity", "m/s2", "acceleration of gravity"),
}
on_ground = {"frame": N, "origin": O, "gravity": g, "rotation": theta}
feet = {foot: (point, Rigid(friction=mu)) for foot, point in (("left", left), ("right", right))}

model = Model.from_mechanics(
    [block],
    COORDINATES,
    **on_ground,
    name="block_of_sympy",
    title="A block declared in SymPy",
    parameters=PARAMETERS | {mu: ("friction", "-", "coefficient of friction of the feet")},
    contacts=feet,
    outlines={block: rectangle(b, h)},
)
print(", ".join(model.modes.names))

# %% [markdown]
# None of these modes was declared. Position, rotation and inertia of the body were read from its
# point and its frame:

# %%
(body,) = model.bodies
assert body.position == (
    h * sp.sin(model.rotation.position) + model.coordinates[0].position,
    h * sp.cos(model.rotation.position) + model.coordinates[1].position,
)
assert (body.rotation, body.inertia) == (model.rotation.position, J)
sp.Matrix(body.position)

# %% [markdown]
# ## 3. The same equations, by LagrangesMethod
#
# `LagrangesMethod` derives the equations of *one* mode, of which you must write the kinematics:
# which foot stands, and that it does not move. In SymPy the block that turns about its right foot
# is (1) with
#
# $$\mathbf r_C = b\,(\mathbf n_x - \mathbf a_x), \tag{2}$$
#
# with $\theta$ as its only coordinate. In the model it is the mode `right`. The difference of the
# two equations must be zero, as an expression, whatever the parameters are.

# %%
QUIET = {GROUND_X: 0, GROUND_Y: 0}


def by_sympy(bodies, coordinates):
    """Lagrange's equations of bodies under their weight, (n, 1), zero along a motion."""
    weights = [body.mass * g * body.masscenter.pos_from(O).dot(N.y) for body in bodies]
    own = [body.potential_energy for body in bodies]
    for body, weight in zip(bodies, weights, strict=True):
        body.potential_energy += weight
    energy = Lagrangian(N, *bodies)
    for body, potential in zip(bodies, own, strict=True):
        body.potential_energy = potential
    return LagrangesMethod(energy, coordinates).form_lagranges_equations()


def by_model(model, mode, coordinates):
    """The equations of a mode of a model on quiet ground, in the same symbols."""
    side = {"left": -1, "right": 1}.get(mode, 0)
    equations = model.mode(mode)
    names = [str(q.func) for q in coordinates]
    free = [next(c for c in model.coordinates if c.name == name) for name in names]
    accelerations = sp.Matrix([c.acceleration for c in free])
    residual = equations.mass_matrix * accelerations - equations.forcing
    in_time = {}
    for c, q in zip(free, coordinates, strict=True):
        in_time |= {c.position: q, c.velocity: q.diff(), c.acceleration: q.diff().diff()}
    return residual.applyfunc(lambda e: at_side(e, side).xreplace(QUIET).xreplace(in_time))


def difference(one, other):
    return (one - other).applyfunc(lambda e: sp.trigsimp(sp.expand(sp.expand_trig(e))))


rocking, *_ = block_at(lambda A: b * N.x - b * A.x)
about_right = by_sympy([rocking], [theta])
assert difference(about_right, by_model(model, "right", [theta])) == sp.zeros(1, 1)
assert difference(by_sympy([block], [x, y, theta]), by_model(model, "flight", [x, y, theta])) == (
    sp.zeros(3, 1)
)
sp.Eq(sp.collect(sp.expand(about_right[0]), theta.diff().diff()), 0)

# %% [markdown]
# The same by hand, with $I_o = J + m(b^2 + h^2)$:
#
# $$I_o\,\ddot\theta + m g\,(b\cos\theta - h\sin\theta) = 0. \tag{3}$$
#
# `LagrangesMethod` stops here. It does not know when the other foot lands, what the landing does,
# or when the foot begins to slip. The model does, since it knows the points that may touch.

# %%
by_hand = (J + m * (b**2 + h**2)) * theta.diff().diff() + m * g * (
    b * sp.cos(theta) - h * sp.sin(theta)
)
assert difference(about_right, sp.Matrix([by_hand])) == sp.zeros(1, 1)

values = {"mass": 1000.0, "half_width": 0.3, "height": 1.2, "inertia": 510.0, "gravity": 9.81}
release = {"theta": 0.1}
quiet = rk.GroundMotion.none(4.0)
run = rk.simulate(rk.structure(model, **values, friction=0.6), quiet, initial=release)
shipped = rk.SlidingBlock(
    half_width=0.3, half_height=1.2, mass=1000.0, inertia=510.0, friction=0.6, restitution=0.0
)
other = rk.simulate(shipped, quiet, initial=release)
times = np.linspace(0.0, 4.0, 200)
assert np.allclose(run.at(times)["theta"], other.at(times)["theta"], atol=1e-9)
print(f"{len(run.impacts)} impacts, the first at {run.impacts[0].time:.3f} s; {run.outcome}")

# %% [markdown]
# ## 4. Two bodies: a bell in its tower
#
# A bell of mass $m_b$ hangs at the height $c$ of the tower, its centroid the length $\ell$ below
# the hinge. Its angle $\varphi$ is measured from the vertical, clockwise as that of the tower, so
# that its frame is turned from $N$ and not from $A$. The clapper and the rope give no force; a
# spring of the stiffness $k$ at the hinge is the only link between the two rotations,
#
# $$V = \tfrac12\,k\,(\varphi - \theta)^2. \tag{4}$$
#
# In SymPy it is the `potential_energy` of a body. The weight does not belong there: a model has it
# from its gravity, and says so where it is given twice.

# %%
m_b, J_b, c, ell, k = sp.symbols("m_b J_b c ell k", positive=True)


def bell_in(tower):
    """The bell of a tower that is a body of section 1."""
    B = ReferenceFrame("B")
    B.orient_axis(N, N.z, -phi)
    hinge = tower.masscenter.locatenew("H", (c - h) * tower.frame.y)
    G_b = hinge.locatenew("G_b", -ell * B.y)
    G_b.set_vel(N, G_b.pos_from(O).dt(N))
    bell = RigidBody("bell", G_b, B, m_b, (inertia(B, 0, 0, J_b), G_b))
    bell.potential_energy = k * (phi - theta) ** 2 / 2
    return bell


bell = bell_in(block)
tower = Model.from_mechanics(
    [block, bell],
    COORDINATES | {phi: ("phi", "rad", "rotation of the bell, positive clockwise")},
    **on_ground,
    name="bell_tower",
    title="A rocking tower with a bell",
    parameters=PARAMETERS
    | {
        m_b: ("bell_mass", "kg", "mass of the bell"),
        J_b: ("bell_inertia", "kg m2", "moment of inertia of the bell about its centroid"),
        c: ("hinge_height", "m", "height of the hinge above the base"),
        ell: ("bell_length", "m", "distance of the bell's centroid from the hinge"),
        k: ("hinge_stiffness", "N m", "stiffness of the hinge"),
    },
    contacts={name: (point, Rigid(friction=None)) for name, (point, _) in feet.items()},
    outlines={
        block: rectangle(b, h),
        bell: ((-b / 2, -ell / 2), (b / 2, -ell / 2), (b / 4, ell / 2), (-b / 4, ell / 2)),
    },
)
print(", ".join(tower.modes.names))

# %% [markdown]
# The modes `right` and `left` have two coordinates now. Both equations agree with SymPy's, which
# are derived with the foot at rest, as before:

# %%
hanging = bell_in(rocking)
two = [theta, phi]
assert difference(by_sympy([rocking, hanging], two), by_model(tower, "right", two)) == (
    sp.zeros(2, 1)
)

# %% [markdown]
# ## 5. Motion
#
# The tower is 8 m high and 2.4 m wide and weighs 40 t, the bell 3 t.

# %%
VALUES = {
    "mass": 40e3, "half_width": 1.2, "height": 4.0, "inertia": 40e3 * (1.2**2 + 4.0**2) / 3,
    "gravity": 9.81, "bell_mass": 3e3, "bell_inertia": 400.0, "hinge_height": 6.5,
    "bell_length": 0.7, "hinge_stiffness": 0.0,
}  # fmt: skip
free = rk.structure(tower, **VALUES)
seized = rk.structure(tower, **(VALUES | {"hinge_stiffness": 1e8}))

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, axes = plt.subplots(1, 2, figsize=(5.6, 4.0), layout="constrained")
for ax, state, title in (
    (axes[0], {}, "(a) at rest"),
    (axes[1], {"theta": 0.12, "y": 1.2 * math.sin(0.12), "phi": -0.5}, "(b) on the right foot"),
):
    draw_structure(free, state=state, ax=ax)
    ax.set_title(title)
plt.show()

# %% [markdown]
# *Figure 1. The tower and its bell, drawn from the bodies, points and outlines of the model.*
#
# The ground moves by one sine with a period of 1.2 s. **Before you run the next cell: does a bell
# that swings freely make the tower rock more or less than one whose bearing has seized?**

# %%
pulse = rk.GroundMotion.single_sine(amplitude=4.5, period=1.2, duration=8.0)
runs = {"free": rk.simulate(free, pulse), "seized": rk.simulate(seized, pulse)}
for name, run in runs.items():
    peak = np.abs(run["theta"]).max()
    print(f"bell {name:6s}: largest rotation {math.degrees(peak):.2f} degrees, {run.outcome}")

run = runs["free"]
for first, last in zip(run.events[:-1], run.events[1:], strict=True):  # after the pulse
    if first.time > 1.2 and last.time - first.time > 0.05:
        inside = np.linspace(first.time, last.time, 20)[1:-1]
        energy = run.at(inside, names=["total_energy"])["total_energy"]
        assert np.ptp(energy) < 1e-6 * abs(energy[0])  # constant between impacts

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 4.4), sharex=True, layout="constrained")
for name, run in runs.items():
    above.plot(run.t, np.degrees(run["theta"]), label=f"bell {name}")
    below.plot(run.t, np.degrees(run["phi"]), lw=0.9)
above.set(ylabel=r"tower $\theta$ [degrees]", xlim=(0, 6))
below.set(ylabel=r"bell $\varphi$ [degrees]", xlabel="time [s]")
above.legend()
plt.show()

# %% [markdown]
# *Figure 2. Rotation of the tower and of the bell under one sine of 4.5 m/s2, with a free and with
# a seized bearing.*
#
# ## 6. Declarations that are refused
#
# A model is planar, on ground that the kinematics do not move, and written in coordinates. Each
# error names the item. A generalised speed, as Kane's method has, is no coordinate: write the
# derivative.


# %%
def refused(**changes):
    """The error of a declaration."""
    declared = {"bodies": [block], "coordinates": COORDINATES, "parameters": PARAMETERS}
    arguments = {"name": "refused", "title": "", **on_ground, **declared, **changes}
    try:
        Model.from_mechanics(**arguments)
    except ValueError as error:
        return str(error)
    raise AssertionError("nothing was refused")


tilted = ReferenceFrame("T")
tilted.orient_axis(N, N.x, theta)
leaning = RigidBody(
    "leaning", block.masscenter, tilted, m, (inertia(tilted, 0, 0, J), block.masscenter)
)
errors = [
    refused(bodies=[leaning]),
    refused(coordinates={q: COORDINATES[q] for q in (x, theta)}),
    refused(parameters={m: PARAMETERS[m], J: PARAMETERS[J]}),
    refused(origin=block.masscenter),
]
print(*errors, sep="\n")
words = (
    "not in the plane",
    "contains y(t)",
    "parameters lacks g, h",
    "origin is G, which moves",
)
assert all(word in error for word, error in zip(words, errors, strict=True))

# %% [markdown]
# ## Exercises
#
# 1. **The other side.** Derive the equation about the left foot by `LagrangesMethod` and compare it
#    with the mode `left`. *Hint: in (2) both signs change.*
# 2. **A bell that is a point.** Declare the bell as a `Particle`. Which term of the mass matrix
#    changes? *Hint: $J_b = 0$, and a particle has no rotation.*
# 3. **Two pendulums.** What is the period of the free bell when the tower does not move? Check it
#    by a simulation. *Hint: $\omega^2 = m_b g\ell/(J_b + m_b\ell^2)$; release the bell with a small
#    $\varphi$.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# $\mathbf r_C = -b\,(\mathbf n_x - \mathbf a_x)$ gives
# $I_o\,\ddot\theta - m g\,(b\cos\theta + h\sin\theta) = 0$, which is the mode `left`.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# Only the last one, of $\ddot\varphi$ in the equation of $\varphi$: $J_b + m_b\ell^2$ becomes
# $m_b\ell^2$.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# $2\pi\sqrt{(400 + 3000\cdot0.7^2)/(3000\cdot9.81\cdot0.7)} = 1.893$ s. The bell is too light to
# lift the tower, which stands on both feet.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
on_left, *_ = block_at(lambda A: b * A.x - b * N.x)
about_left = by_sympy([on_left], [theta])
assert difference(about_left, by_model(model, "left", [theta])) == sp.zeros(1, 1)

matrix = tower.mode("right").mass_matrix
changed = (matrix - matrix.subs(J_b, 0)).applyfunc(sp.expand)
assert changed == sp.Matrix([[0, 0], [0, J_b]])

swings = rk.simulate(free, rk.GroundMotion.none(6.0), initial={"phi": 1e-3})
assert set(swings.mode) == {"both"}
period = 2 * math.pi * math.sqrt((400 + 3000 * 0.7**2) / (3000 * 9.81 * 0.7))
assert round(period, 3) == 1.893
(after,) = swings.at([period])["phi"]
assert math.isclose(after, 1e-3, rel_tol=1e-4)
exercises = Exercises({2: m_b * ell**2, 3: period})

# %%
# your answers
exercises.check(2, ...)  # the term that changes, in m_b and ell
exercises.check(3, ...)  # in seconds
