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
#     minutes: 50
# ---

# %% [markdown]
# # A boulder on a shaking table
#
# Others shook a granite boulder on a table, 582 times in each of two positions, and wrote down
# whether it fell. They published its scan and the motion of the table, but neither the direction in
# which the table shook it nor the points on which it stood. Can a model say what happened? We
# derive what direction and points decide, predict tests without knowing them, learn them from other
# tests, and say how good the predictions are. Last comes the boulder of granite.
#
# ## Aims
#
# After this notebook you can
#
# 1. derive the acceleration that lifts a body of any base, in every direction of the shaking;
# 2. predict an outcome without knowing all parameters, and say what the number means;
# 3. learn parameters from some records and judge them by others, and say why tests do not do;
# 4. compare two models on the same tests, with an interval that does not promise too much.
#
# The tests of this notebook are simulated, so that we know the truth. Those of the boulder were
# made by Z. Chen and others (Seismica, 2024; data under the GPL-3). They are not part of the
# program; `validation.BoulderTests` reads them.

# %%
import matplotlib.pyplot as plt
import numpy as np

import rockeom as rk
from rockeom.analysis import validation
from rockeom.plots import reliability_diagram, use_style
from rockeom.teaching import Exercises

use_style()

gravity, height = 9.81, 0.29  # m/s2, m
inertia = np.diag([11.8, 18.8, 25.2])  # kg m2


def boulder(points):
    """One that stands on these points (n, 2), counter-clockwise [m]."""
    feet = {f"point_{i + 1}": (x, y) for i, (x, y) in enumerate(points.tolist())}
    return rk.Boulder(
        feet=feet, mass=354.0, centroid=(0.0, 0.0, height), inertia=inertia, gravity=gravity
    )


def base(rng):
    """Five points (5, 2) somewhere on a long and narrow base [m]."""
    angle = np.radians(72 * np.arange(5) + rng.uniform(-20, 20, 5))
    part = rng.uniform(0.35, 1.0, 5)
    return part[:, None] * np.column_stack([0.24 * np.cos(angle), 0.09 * np.sin(angle)])


rng = np.random.default_rng(58)
true_base, true_azimuth = base(rng), np.radians(310.0)
true_boulder = boulder(true_base)

# %% [markdown]
# ## 1. What lifts a body from its base
#
# The body stands on the corners of a polygon. Edge $i$ has the outward normal $n_i$ and the
# distance $d_i$ from the point below the centroid, which lies at the height $h$. The ground
# accelerates by $a$ along the unit vector $u$, so that the force of inertia $-m a\,u$ acts at the
# centroid. About edge $i$ it overturns with the moment $-m a h\,(u\cdot n_i)$, and the weight holds
# the body down with $m g\,d_i$. The body lifts when the first edge gives way,
#
# $$a(u) = \min_{u\cdot n_i < 0} \frac{g\,d_i}{-h\,(u\cdot n_i)} \;\ge\; g\,\frac{\min_i d_i}{h}.
#   \tag{1}$$
#
# On the right is the planar block across the weakest edge. *No direction lifts a body at less
# acceleration than the plane says*, and only the normal of the weakest edge reaches the bound. The
# point $-a(u)\,u$ lies at the distance $g\,d_i/h$ along $n_i$: drawn over the direction, (1) is the
# base itself, times $g/h$ and turned by half a turn.


# %%
def lifting(points, azimuth):
    """Acceleration (1) along the azimuth from x of the body [m/s2]."""
    edge = np.roll(points, -1, axis=0) - points
    normal = np.column_stack([edge[:, 1], -edge[:, 0]]) / np.hypot(*edge.T)[:, None]
    distance = (normal * points).sum(axis=1)
    against = -normal @ [np.cos(azimuth), np.sin(azimuth)]
    return (gravity * distance / height / np.where(against > 0, against, np.nan))[against > 0].min()


ramp = rk.GroundMotion.from_array([0.0, 8.0], dt=8.0, name="1 m/s2 a second")
azimuths = np.radians(np.arange(0, 360, 15))
for azimuth in azimuths[::8]:
    run = rk.simulate(true_boulder, ramp, azimuth=-azimuth)  # of the body's x from the motion
    lifts = run.t[np.argmax(run.tilt > 1e-7)]  # 1 m/s2 a second
    print(f"{np.degrees(azimuth):3.0f} degrees: lifts at {lifts:.3f} m/s2, by (1) at "
          f"{lifting(true_base, azimuth):.3f}")  # fmt: skip
    assert abs(lifts / lifting(true_base, azimuth) - 1) < 0.02

# %% [markdown]
# The tests come next. Six pulses stand for six records; each is run at six scales. The boulder is
# shaken along eight directions, and its planar block along its own.

# %%
records, scales = 6, (0.15, 0.25, 0.35, 0.5, 0.7, 1.0)  # m/s, what the peak velocity goes with
motions = rk.MotionSet(
    [
        form(np.pi * scale / period, period, duration=5.0)
        for form in (rk.GroundMotion.single_sine, rk.GroundMotion.ricker)
        for period in (0.25, 0.4, 0.7)
        for scale in scales
    ]
)
record = np.repeat(np.arange(records), len(scales))
quiet = rk.SweepOptions(progress=False)


def falls(structure, azimuth=0.0):
    """Whether each motion overturns it (n,)."""
    case = rk.Case(structure, motions[0], azimuth=azimuth)
    found = rk.simulate_many(case, {"motion": motions}, sweep_options=quiet)
    return (found["outcome"] == "overturned").to_numpy()


turned = azimuths[::3]
share = np.array([falls(true_boulder, -azimuth).mean() for azimuth in turned])


def planar(points):
    """The planar block of the weakest edge, symmetric as if that edge had a twin."""
    edge = np.roll(points, -1, axis=0) - points
    x, y = (edge / np.hypot(*edge.T)[:, None]).T
    distance = points[:, 0] * y - points[:, 1] * x
    i = distance.argmin()
    about = inertia[0, 0] * x[i] ** 2 + inertia[1, 1] * y[i] ** 2  # the weakest edge
    return rk.RigidBlock(
        half_width=distance[i], half_height=height, mass=354.0, inertia=about, gravity=gravity
    )


in_plane = falls(planar(true_base)).mean()
print("in space", share.round(2), "in the plane", in_plane.round(2))
assert share.max() - share.min() > 0.05  # the direction matters

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, axes = plt.subplots(
    1, 2, figsize=(7.4, 4.1), subplot_kw={"projection": "polar"}, layout="constrained"
)
fine = np.radians(np.arange(0, 361, 3))
lifted = np.array([lifting(true_base, azimuth) for azimuth in fine]) / gravity
axes[0].plot(fine, lifted)
axes[0].plot(fine, np.full(len(fine), lifted.min()), "--", color="0.4")
axes[0].set_title("acceleration that lifts it [g]", fontsize=9, pad=12)
axes[1].bar(turned, share, width=np.radians(40), edgecolor="white", alpha=0.75)
axes[1].plot(fine, np.full(len(fine), in_plane), "--", color="0.4", label="plane")
axes[1].set_title("share of motions that overturn it", fontsize=9, pad=12)
axes[1].legend(loc="lower right", bbox_to_anchor=(1.1, -0.1), fontsize=8)
for ax in axes:
    ax.tick_params(labelsize=7)
    ax.set_rlabel_position(112.5)
plt.show()

# %% [markdown]
# *Figure 1. By the direction of the shaking. Left, the acceleration (1) that lifts the boulder;
# dashed, the bound of the plane. Right, how many of the motions overturn it; dashed, how many
# overturn the planar block of its weakest edge.*
#
# Lifting is bounded by the plane. Falling is not: once it rocks, the body lands on corners, turns
# about the vertical and meets other edges, and nothing like (1) holds. This one falls less often
# than its planar block in every direction, and not most where it lifts first.
#
# ## 2. A prediction without the parameters
#
# Neither the direction nor the points are known. What is known goes into a *prior*: any direction,
# five points on the base. Draw boulders from it, and let each say what happens in each test. The
# mean over draws is the probability that the test overturns the boulder, *given what we know*. It
# is not a frequency. The same test would end in the same way each time; one half says that half of
# the boulders that may stand there would fall.

# %%
fell = falls(true_boulder, true_azimuth)  # the measured outcomes
draws = 24
bases = [base(rng) for _ in range(draws)]
drawn_azimuths = rng.uniform(0.0, 2.0 * np.pi, draws)
space = np.array(
    [falls(boulder(b), azimuth) for b, azimuth in zip(bases, drawn_azimuths, strict=True)]
)
plane = np.array([falls(planar(b)) for b in bases])
of_prior = {"space": space.mean(axis=0), "plane": plane.mean(axis=0)}

# %% [markdown]
# A score must reward honesty. Say $p$ where the truth is $q$: the score of Brier, $(p - f)^2$ with
# $f = 1$ for a fall, is expected to be
#
# $$q\,(1-p)^2 + (1-q)\,p^2 = (p-q)^2 + q\,(1-q), \tag{2}$$
#
# least for $p = q$. The share of right outcomes has no such property: it asks only on which side of
# one half $p$ is. So a model that knows nothing and says the base rate $q$ of each test gets
# $q(1-q)$, and one that is always sure gets its share of errors.

# %%
for name, p in of_prior.items():
    right = ((p > 0.5) == fell).mean()
    print(f"{name}: right {right:.2f}, Brier {validation.brier_score(fell, p).mean():.3f}")
base_rate = validation.brier_score(fell, np.full(len(fell), fell.mean())).mean()
assert np.isclose(base_rate, fell.mean() * (1 - fell.mean()))  # (2)
assert max(validation.brier_score(fell, p).mean() for p in of_prior.values()) < base_rate

# %% [markdown]
# ## 3. What other tests tell
#
# Tests tell which draws are like the boulder. Give draw $k$ the weight $w_k$, and let a draw be
# wrong about a test with the probability $\varepsilon$, since no model is exact. With
# $l_{ki} = 1 - \varepsilon$ where draw $k$ is right about test $i$, else $\varepsilon$, the
# likelihood of the weights is
#
# $$\log L = \sum_i \log \sum_k w_k\,l_{ki}, \qquad
#   w_k \leftarrow \frac1n \sum_i \frac{w_k\,l_{ki}}{\sum_j w_j\,l_{ji}}. \tag{3}$$
#
# $\log L$ is concave in the weights, so that a maximum is the highest; no step of the right
# side (expectation and maximisation) lowers it. Predictions that are mixed so are called stacked.
#
# *Which* tests may be used? If a test is predicted by all others, the same record at the next scale
# is among them, and tells the outcome without any mechanics. Records, not tests, must be left out.

# %%
wrong = 0.1


def weights_of(right):
    """The weights (3) of draws that are right about tests (k, n)."""
    likely = np.where(right, 1.0 - wrong, wrong)
    weights = np.full(len(likely), 1.0 / len(likely))
    before = -np.inf
    for _ in range(200):
        mixed = weights @ likely
        assert np.log(mixed).sum() >= before - 1e-9  # it never falls
        before = np.log(mixed).sum()
        weights = (weights[:, None] * likely / mixed).mean(axis=1)
    return weights


def stacked(outcomes, observed):
    """Probabilities (n,) of each test by the draws that suit the other records."""
    found = np.empty(len(observed))
    for one in range(records):
        others = record != one
        weights = weights_of(outcomes[:, others] == observed[others])
        found[~others] = weights @ np.where(outcomes[:, ~others], 1.0 - wrong, wrong)
    return found


weighed = {"space": stacked(space, fell), "plane": stacked(plane, fell)}
for name, p in weighed.items():
    right = ((p > 0.5) == fell).mean()
    print(f"{name}: right {right:.2f}, Brier {validation.brier_score(fell, p).mean():.3f}")

by_scale = fell.reshape(records, -1)
as_below = np.column_stack([by_scale[:, 1], by_scale[:, :-1]]).ravel()
print(f"without any mechanics, as at the scale below: right {(as_below == fell).mean():.2f}")
assert (as_below == fell).mean() > 0.75

# %% tags=["hide-input"] jupyter={"source_hidden": true}
figure, axes = plt.subplots(1, 2, figsize=(7.6, 3.6), layout="constrained")
for ax, p, title in (
    (axes[0], of_prior["space"], "prior"), (axes[1], weighed["space"], "weighed by other records")
):  # fmt: skip
    reliability_diagram(validation.calibration_of(fell, p), ax=ax)
    ax.set_title(title, fontsize=9)
plt.show()

# %% [markdown]
# *Figure 2. Reliability of the predictions in space: how often tests fell to which one probability
# was given.*
#
# ## 4. Which of two models is better
#
# Both models see the same tests. Where both are right or both wrong, a test says nothing about
# which is better; if they are equally good, each of the others is a coin. That is the exact test of
# McNemar. It takes tests as independent. The interval of the difference leaves out one record after
# the other (the jackknife), and so counts records:

# %%
correct = {name: (p > 0.5) == fell for name, p in weighed.items()}
apart = validation.disagreement(correct["space"], correct["plane"])
print(apart)
difference = validation.paired_difference(correct["space"], correct["plane"], record)
print("space less plane: {:+.3f} ({:+.3f} to {:+.3f})".format(*difference))
# %% [markdown]
# The plane does not lose, although the truth is a body in space. Is that luck? Let each draw be the
# boulder once, and predict it by the others, which takes no further simulation.

# %%
twins = {"space": [], "plane": []}
for k in range(draws):
    if 0.15 < space[k].mean() < 0.6:  # it neither always stands nor always falls
        rest = np.arange(draws) != k
        for name, outcomes in (("space", space[rest]), ("plane", plane[rest])):
            p = stacked(outcomes, space[k])
            twins[name].append([((p > 0.5) == space[k]).mean(), np.mean((p - space[k]) ** 2)])
for name, scores in twins.items():
    print("{}: {} twins, right {:.2f}, Brier {:.3f}".format(
        name, len(scores), *np.mean(scores, axis=0)))  # fmt: skip
share_right = {name: np.mean(scores, axis=0)[0] for name, scores in twins.items()}
assert -0.02 < share_right["space"] - share_right["plane"] < 0.1

# %% [markdown]
# In the mean space wins, by less than thirty-six tests of six records can show. One number, the
# angle of the weakest edge, orders boulders and tests alike, and two dozen planar blocks cover it
# densely. In space the direction and five points are eleven unknowns; no draw has all of them
# right, and a body on corners is sensitive to each. A better model predicts better only as far as
# what it needs is known.
#
# ## 5. The boulder of granite
#
# The same was done with the boulder: its scan, with errors of 1 to 3 mm at each vertex, turned onto
# the face on which it rests; any direction; priors that were written down before the first score.
# `BoulderTests` reads a folder with the published files, and one command gives the tables of the
# page *Validation*:
#
# ```
# python -m benchmarks.boulders scores FOLDER
# ```
#
# The first attempt put the points on which it stands into one plane, as here, and failed: it was
# wrong about one test in five, less often right than the plane and than the discrete elements of
# others, and it was wrong on one side, for it missed more than half of the falls. Neither friction
# nor restitution nor the slow part of the motion explained that.
#
# The tests told. The boulder falls in them at a peak of 0.1 g if the record is slow, and stands at
# 1 g if it is fast. By (1) it lifts over an edge that is near; it falls like a body whose edges are
# far. It is round below: it lifts over three near points, and leans onto farther and higher ones. A
# body on points of their true heights, as `rk.Boulder.from_mesh` finds them, has the same unknowns.
# With nothing fitted it is about as often right as the plane; weighed by other records it is right
# about ten tests of eleven, more often than the plane and the discrete elements.
#
# ## Exercises
#
# 1. A body stands on a square of side $2b$ with its centroid in the middle. Along which direction
#    does it need the largest acceleration to lift, and how much more than along the weakest?
#    *Hint: (1) has two edges there.*
# 2. A fifth of the tests overturn. What is the Brier score of a model that says 0.2 for each, and
#    of one that says that all stand? *Hint: (2) with $q$ either 0 or 1.*
# 3. Two models differ on 16 tests; the first is right on 12 of them. How likely are coins to be as
#    unequal? *Hint: twice the tail of a binomial distribution, or `validation.disagreement`.*
# 4. In (3) let one draw be right about all tests, all others about none. What is its weight after
#    one step, with two draws and $\varepsilon = 0.1$? *Hint: both terms of the sum are known.*

# %% [markdown]
# <details><summary>Solution 1</summary>
#
# Along the diagonal $u\cdot n = -1/\sqrt2$ for both edges: $\sqrt2$ times as much.
#
# </details>
#
# <details><summary>Solution 2</summary>
#
# The first $0.2 \cdot 0.8^2 + 0.8 \cdot 0.2^2 = 0.16$, the second 0.2, its share of errors.
#
# </details>
#
# <details><summary>Solution 3</summary>
#
# The tail of 4 and less of 16 is 2517/65536, so that p = 0.077.
#
# </details>
#
# <details><summary>Solution 4</summary>
#
# Each term is $0.5\cdot0.9/(0.5\cdot0.9 + 0.5\cdot0.1) = 0.9$.
#
# </details>

# %% tags=["hide-cell"] jupyter={"source_hidden": true}
# the solutions, checked
square = 0.1 * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
all_round = [lifting(square, azimuth) for azimuth in np.radians(np.arange(0, 360, 5))]
assert np.isclose(max(all_round), lifting(square, np.radians(45)))
assert np.isclose(max(all_round) / min(all_round), np.sqrt(2))

fifth = np.arange(10) < 2
assert np.isclose(validation.brier_score(fifth, np.full(10, 0.2)).mean(), 0.16)
assert np.isclose(validation.brier_score(fifth, np.zeros(10)).mean(), 0.2)

first = np.arange(16) < 12
assert np.isclose(validation.disagreement(first, ~first).p_value, 2 * 2517 / 65536)

likely = np.where([[True], [False]], 1 - wrong, wrong)
assert np.isclose((0.5 * likely / (0.5 * likely).sum(axis=0))[0, 0], 0.9)

exercises = Exercises({1: np.sqrt(2), 2: 0.16, 3: 2 * 2517 / 65536, 4: 0.9})

# %%
# your answers
exercises.check(1, ...)  # the ratio
exercises.check(2, ...)  # the score of the first model
exercises.check(3, ...)  # the probability
exercises.check(4, ...)  # the weight
