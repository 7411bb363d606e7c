"""The structures that the tests share: one of each kind, of plausible size."""

import rockeom as rk

S1 = {
    "mass": 122.6,
    "height": 1.05,
    "inertia": 44.8,
    "base_mass": 45.6,
    "base_height": 0.10,
    "base_inertia": 1.37,
    "half_width": 0.285,
}
"""The steel column of thesis chapter 5 as a lumped-mass structure."""

STIFFNESS, DAMPING = 571.8e3, 502.4
FOUNDATION_STIFFNESS = 550e3

TOTAL_MASS = S1["mass"] + S1["base_mass"]
FIRST_MOMENT = S1["mass"] * S1["height"] + S1["base_mass"] * S1["base_height"]
"""S = m_e H_e + m_b H_b [kg m]."""
PIVOT_INERTIA = (
    S1["inertia"]
    + S1["base_inertia"]
    + S1["mass"] * (S1["height"] ** 2 + S1["half_width"] ** 2)
    + S1["base_mass"] * (S1["base_height"] ** 2 + S1["half_width"] ** 2)
)
"""I_O of thesis 5-8 [kg m2]."""


def column(**changes):
    return rk.FlexibleStructure(**(S1 | {"stiffness": STIFFNESS, "damping": DAMPING} | changes))


def stack(**changes):
    """A statue on its pedestal."""
    values = {
        "lower_half_width": 0.25, "lower_half_height": 0.6, "lower_mass": 600.0,
        "upper_half_width": 0.15, "upper_half_height": 0.5, "upper_mass": 200.0,
    }  # fmt: skip
    return rk.StackedBlocks(**(values | changes))


def oscillator():
    """Its mass alone, on an elastic column."""
    shared = {name: S1[name] for name in ("mass", "height", "half_width")}
    return rk.UpliftingOscillator(**shared, stiffness=STIFFNESS, damping=DAMPING)


def on_springs(**changes):
    foundation = {"foundation_stiffness": FOUNDATION_STIFFNESS, "foundation_damping": 3e3}
    return rk.TwoSpringStructure(**(S1 | foundation | changes))


def every_structure():
    """One of each shipped kind, without damping."""
    return [
        rk.RigidBlock.from_frequency(p=2.14, alpha=0.25, mass=300.0),
        rk.SlenderBlock.from_frequency(p=2.14, alpha=0.25, mass=300.0),
        rk.NondimensionalBlock(alpha=0.3),
        rk.LumpedMassStructure(**S1),
        column(damping=0.0),
        on_springs(foundation_damping=0.0),
        rk.TwoSpringCart(**S1, foundation_stiffness=FOUNDATION_STIFFNESS),
    ]


def by_model(structure):
    """Name of a test's case."""
    return structure.model
