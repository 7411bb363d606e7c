"""Checks of codes: formulas typed again, limits by mechanics, refusals."""

from math import cos, exp, hypot, inf, isnan, log, nan, pi, sin, sqrt

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import standards as st
from rockeom.analysis.design import MeanSpectrum
from rockeom.analysis.standards import KinematicChain
from rockeom.assessment.statics import statics_of
from tests.refusals import refused

G = 9.81
EXACT = 1e-12
BLOCKS = [
    rk.RigidBlock(half_width=0.3, half_height=1.0, mass=400.0),
    rk.RigidBlock(half_width=0.2, half_height=0.7, mass=90.0, inertia=15.0),
    rk.RigidBlock(half_width=1.0, half_height=5.0, mass=7e4, gravity=9.8),
]
NAMES = ["rectangle", "statue", "column"]
SPECTRUM = rk.DesignSpectrum.eurocode_8("0.3 g", "B")


def polar(block):
    """I_o/m [m2]."""
    own = block.inertia / block.mass if block.inertia is not None else block.radius**2 / 3
    return own + block.half_width**2 + block.half_height**2


# --- uplift and overturning by old criteria


@pytest.mark.parametrize("block", BLOCKS, ids=NAMES)
def test_old_criteria_are_their_formulas(block):
    b, h, g = block.half_width, block.half_height, block.gravity
    west = st.west_uplift(block, 2.0)
    assert (west.demand, west.capacity) == pytest.approx((2.0, g * b / h), rel=EXACT)
    assert west.verdict == ("a foot lifts" if g * b / h < 2.0 else "no foot lifts")
    radius = hypot(b, h)
    mallet = sqrt(2 * g * radius * (1 - h / radius) * polar(block) / h**2)
    assert st.mallet_overturning(block, 0.1).capacity == pytest.approx(mallet, rel=EXACT)
    if block.inertia is None:  # the rectangle
        rise = g * radius * (1 - h / radius) / (h / radius) ** 2
        assert mallet == pytest.approx(sqrt(8 / 3 * rise), rel=EXACT)
    # in cm and cm/s, as Ishiyama has it
    velocity = 10 * (100 * 2 * b) / sqrt(100 * 2 * h) / 100
    found = st.ishiyama_overturning(block, 100.0, 0.2)
    assert (found.quantity, found.unit) == ("peak ground velocity", "m/s")
    assert found.capacity == pytest.approx(velocity, rel=EXACT)
    found = st.ishiyama_overturning(block, "0.01 g", 100.0)
    assert (found.quantity, found.demand) == ("peak ground acceleration", pytest.approx(0.0981))
    assert found.capacity == pytest.approx(g * b / h, rel=EXACT)


@pytest.mark.parametrize("block", BLOCKS, ids=NAMES)
def test_sudden_velocity_of_mallet_is_the_least_that_overturns(block):
    """A ground at V at once is a block whose foot is struck: theta' = h V/(I_o/m)."""
    limit = st.mallet_overturning(block, 1.0).capacity
    for part, falls in ((0.9999, False), (1.0001, True)):
        rate = part * limit * block.half_height / polar(block)
        run = rk.simulate(
            block, rk.GroundMotion.none(60.0), initial={"theta": 1e-12, "theta_dot": rate}
        )
        assert (run.outcome == "overturned") == falls
        check = st.mallet_overturning(block, part * limit)
        assert check.verdict == ("overturns" if falls else "stands")


@pytest.mark.parametrize(
    ("acceleration", "velocity", "verdict"),
    [(3.0, 0.5, "overturns"), (2.9, 0.5, "stands"), (3.0, 0.4, "stands")],
)
def test_ishiyama_needs_both_acceleration_and_velocity(acceleration, velocity, verdict):
    """Limits of the rectangle: 2.943 m/s2 and 0.6/sqrt(2) = 0.424 m/s."""
    found = st.ishiyama_overturning(BLOCKS[0], acceleration, velocity)
    assert found.verdict == verdict


# --- ASCE 43


@pytest.mark.parametrize("block", BLOCKS, ids=NAMES)
@pytest.mark.parametrize("part", [0.2, 1.0])
def test_asce_43_reads_the_spectrum_at_the_secant_of_equal_energy(block, part):
    b, h, g = block.half_width, block.half_height, block.gravity
    t, a, c3 = part * np.arctan2(b, h), b / h, polar(block) / h**2
    f = cos(t) + a * sin(t)
    frequency = sqrt(2 * g * (f - 1) / (c3 * h * t**2)) / (2 * pi)
    gamma = -2 * log(1 - 2 * a**2 / c3)
    damping = gamma / sqrt(4 * pi**2 + gamma**2)
    asked = []

    def spectrum(period, xi):
        asked.append((period, xi))
        return 0.1

    found = st.asce_43_rocking(block, spectrum, rotation=t)
    assert asked == [(pytest.approx(1 / frequency, rel=EXACT), pytest.approx(damping, rel=EXACT))]
    assert found.capacity == pytest.approx(2 * g * (f - 1) / t, rel=EXACT)
    assert found.demand == pytest.approx(0.1 * (2 * pi * frequency) ** 2, rel=EXACT)
    # the same by mechanics: potential energy of the turned block, two impacts a cycle
    alpha = np.arctan2(b, h)
    lifted = block.radius * (cos(alpha - t) - cos(alpha))
    assert 0.5 * found.capacity * h * t == pytest.approx(g * lifted, rel=1e-10)
    spent = np.prod([1 - x for x in two_losses(block)])
    assert exp(-2 * gamma) == pytest.approx(spent, rel=1e-9)


def two_losses(block):
    """Losses of energy at the first two impacts of a free motion, over that before each."""
    run = rk.simulate(block, rk.GroundMotion.none(30.0), initial={"theta": 0.5 * block.alpha})
    before, after = (
        np.array([getattr(one, side)["theta_dot"] for one in run.impacts[:2]])
        for side in ("before", "after")
    )
    return 1 - (after / before) ** 2


@pytest.mark.parametrize(
    ("pga", "verdict", "turned"),
    [
        ("0.1 g", "stands", "turns less than 0.1 rad"),
        ("0.9 g", "overturns", "turns beyond 0.1 rad"),
    ],
)
def test_asce_43_says_how_far_it_turns_and_whether_it_overturns(pga, verdict, turned):
    spectrum = rk.DesignSpectrum.eurocode_8(pga, "B")
    assert st.asce_43_rocking(BLOCKS[0], spectrum).verdict == verdict
    assert st.asce_43_rocking(BLOCKS[0], spectrum, rotation=0.1).verdict == turned


def hyperbola(period, xi):
    """Pseudo-acceleration 2/T, as a displacement, for 10 %."""
    assert xi == 0.1
    return 2.0 / period * (period / (2 * pi)) ** 2


@pytest.mark.parametrize(("mu", "vertical"), [(0.3, 0.0), (0.4, 3.0), (0.25, "0.5 g")])
def test_asce_43_slides_to_where_the_spectrum_is_c_s(mu, vertical):
    a_v = 0.5 * G if isinstance(vertical, str) else vertical
    c_s = 2 * mu * (1 - 0.4 * a_v / G) * G
    expected = c_s / (2 * pi * (c_s / 2.0)) ** 2  # 2/T = c_s
    found = st.asce_43_sliding(mu, vertical, hyperbola, room=0.1)
    assert found.demand == pytest.approx(expected, rel=EXACT)
    assert found.verdict == f"slides {'within' if expected < 0.1 else 'beyond'} its room"
    # the energy that friction takes is that of the spring with the force m c_s
    assert mu * (1 - 0.4 * a_v / G) * G * found.demand == pytest.approx(0.5 * c_s * expected)


def test_asce_43_takes_the_lowest_frequency_of_several():
    """A second hill of the spectrum, at 4 s, is lower in frequency than the first."""
    periods, accelerations = [0, 0.2, 0.5, 1, 3, 4, 6, 10], [3, 8, 8, 1, 1, 5, 1, 0.5]
    hills = rk.DesignSpectrum.from_table(periods, accelerations, damping_ratio=0.1)
    found, c_s = st.asce_43_sliding(0.2, 0.0, hills), 2 * 0.2 * G
    t = 4.0 + 2.0 * (5.0 - c_s) / 4.0
    assert found.demand == pytest.approx(c_s * (t / (2 * pi)) ** 2, rel=EXACT)


@pytest.mark.parametrize(
    ("peak", "slid", "verdict"),
    [(2.0, 0.0, "stays in its place"), (3.5, nan, "no answer: the spectrum stays below c_s")],
)
def test_asce_43_promises_no_rest_where_the_ground_exceeds_friction(peak, slid, verdict):
    """mu g = 2.94, c_s = 5.89: a spectrum of 4 never gets there."""
    flat = rk.DesignSpectrum.from_table([0.0, 0.1, 9.0], [peak, 4.0, 1.0], damping_ratio=0.1)
    found = st.asce_43_sliding(0.3, 0.0, flat)
    assert found.demand == pytest.approx(slid, nan_ok=True)
    assert found.verdict == verdict
    assert isnan(found.ratio)


# --- Italy 2009


def test_chain_of_three_parts_is_that_of_the_instructions():
    p, d = np.array([40e3, 25e3, 10e3]), np.array([0.5, 1.5, 2.1])
    chain = KinematicChain(0.15, p, d, confidence_factor=1.35)
    second = 40e3 * 0.25 + 25e3 * 2.25 + 10e3 * 4.41
    mass = (40e3 * 0.5 + 25e3 * 1.5 + 10e3 * 2.1) ** 2 / (G * second)
    fraction = G * mass / 75e3
    assert chain.mass == pytest.approx(mass, rel=EXACT)
    assert chain.mass_fraction == pytest.approx(fraction, rel=EXACT)
    assert chain.activation == pytest.approx(0.15 * G / (fraction * 1.35), rel=EXACT)
    linear = st.italy_2009_linear(chain, 2.0, q=2.0)
    assert (linear.demand, linear.capacity) == (1.0, chain.activation)
    aloft = st.italy_2009_aloft(chain, "0.6 g", height_ratio=0.5, participation=1.2)
    assert aloft.demand == pytest.approx(0.6 * G * 0.5 * 1.2 / 2, rel=EXACT)


def test_chain_of_two_parts_moves_at_alpha0_g_and_before_a0():
    """A stack that turns as one, by statics: the parts have the arm b and the heights d."""
    lower, upper = BLOCKS[0], rk.RigidBlock(half_width=0.3, half_height=0.5, mass=100.0)
    uplift = statics_of(rk.StackedBlocks(lower=lower, upper=upper)).uplift_acceleration
    p, d = G * np.array([400.0, 100.0]), np.array([1.0, 2.5])
    chain = KinematicChain(p.sum() * 0.3 / (p @ d), p, d)
    assert chain.multiplier * G == pytest.approx(uplift, rel=EXACT)
    assert chain.activation == pytest.approx(uplift / chain.mass_fraction, rel=EXACT)
    assert chain.mass_fraction < 0.9


@pytest.mark.parametrize("block", BLOCKS, ids=NAMES)
def test_chain_of_one_block_moves_at_its_uplift(block):
    chain = KinematicChain.from_block(block)
    assert chain.mass == pytest.approx(block.mass, rel=EXACT)
    assert chain.mass_fraction == pytest.approx(1.0, rel=EXACT)
    assert chain.activation == pytest.approx(block.uplift_accelerations[0], rel=1e-9)
    limit = chain.activation
    for demand, verdict in ((limit, "satisfied"), (1.001 * limit, "not satisfied")):
        assert st.italy_2009_linear(chain, 2 * demand).verdict == verdict


def test_nonlinear_check_reads_the_secant_period():
    chain = KinematicChain(0.2, [1e4], [1.0])
    d_u, d_s = 0.4 * 0.3, 0.4 * 0.4 * 0.3
    t_s = 2 * pi * sqrt(d_s / (0.2 * G * (1 - d_s / 0.3)))
    # the falling branch of EN 1998-1, ground B: 2.5 S a_g T_C/T, and 1/T**2 from 2 s
    assert 0.5 < t_s < 2.0
    for a_g, verdict in ((0.3 * G, "satisfied"), (0.6 * G, "not satisfied")):
        spectrum = rk.DesignSpectrum.eurocode_8(a_g, "B")
        found = st.italy_2009_nonlinear(chain, 0.3, spectrum)
        demand = 2.5 * 1.2 * a_g * 0.5 / t_s * (t_s / (2 * pi)) ** 2
        assert found.demand == pytest.approx(demand, rel=EXACT)
        assert (found.capacity, found.verdict) == (pytest.approx(d_u, rel=EXACT), verdict)


# --- ASCE 7


@pytest.mark.parametrize(
    ("a_p", "r_p", "i_p", "z", "expected"),
    [
        (2.5, 2.5, 1.0, 1.0, 0.4 * 2.5 * 1.2 * 3.0 / 2.5),
        (1.0, 6.0, 1.0, 0.0, 0.3 * 1.2),  # the least
        (2.5, 1.5, 1.5, 1.0, 1.6 * 1.2 * 1.5),  # the most
    ],
)
def test_force_of_asce_7_lies_between_its_limits(a_p, r_p, i_p, z, expected):
    choices = {"amplification": a_p, "response_modification": r_p, "importance": i_p}
    found = st.asce_7_attachment(800.0, "1.2 g", height_ratio=z, **choices)
    assert found.demand == pytest.approx(800.0 * expected, rel=EXACT)
    assert (isnan(found.ratio), found.verdict) == (True, "the force to resist")
    for part, verdict in ((1.0, "holds"), (0.99, "does not hold")):
        strength = part * found.demand
        other = st.asce_7_attachment(800.0, "1.2 g", height_ratio=z, strength=strength, **choices)
        assert other.verdict == f"the attachment {verdict}"


# --- refusals and words

BLOCK, CHAIN = BLOCKS[0], KinematicChain(0.2, [1e4], [1.0])
BROAD = rk.RigidBlock(half_width=2.0, half_height=1.0)
SHELF = rk.OffsetBlock(half_width=0.3, offset=0.1, half_height=1.0)
ATTACHED = {"amplification": 1.0, "response_modification": 2.5}
ALOFT = {"height_ratio": 1.5, "participation": 1.0}


@pytest.mark.parametrize(
    ("argument", "check", "values", "named"),
    [
        ("block", st.west_uplift, (SHELF, 1.0), {}),
        ("ground_acceleration", st.west_uplift, (BLOCK, -1.0), {}),
        ("rotation", st.asce_43_rocking, (BLOCK, SPECTRUM), {"rotation": 0.3}),
        ("block", st.asce_43_rocking, (BROAD, SPECTRUM), {}),
        ("shaking", st.asce_43_rocking, (BLOCK, lambda period, xi: nan), {}),
        ("shaking", st.italy_2009_nonlinear, (CHAIN, 0.3, "0.3 g"), {}),
        ("friction", st.asce_43_sliding, (0.0, 0.0, SPECTRUM), {}),
        ("vertical_acceleration", st.asce_43_sliding, (0.3, "2.5 g", SPECTRUM), {}),
        ("shaking", st.asce_43_sliding, (1e-6, 0.0, SPECTRUM), {}),
        ("weights", KinematicChain, (0.2, [1e4, 1e4], [1.0]), {}),
        ("weights[1]", KinematicChain, (0.2, [1e4, -1.0], [1.0, 1.0]), {}),
        ("displacements", KinematicChain, (0.2, [1e4], [-1.0]), {}),
        ("q", st.italy_2009_linear, (CHAIN, 1.0), {"q": 0.0}),
        ("height_ratio", st.italy_2009_aloft, (CHAIN, 1.0), ALOFT),
        ("ultimate_displacement", st.italy_2009_nonlinear, (CHAIN, inf, SPECTRUM), {}),
        ("height_ratio", st.asce_7_attachment, (1.0, 9.81), {"height_ratio": 2.0, **ATTACHED}),
    ],
)
def test_checks_refuse_what_cannot_be(argument, check, values, named):
    assert refused(check, *values, **named)[0] == argument


def test_motion_and_spectrum_of_the_same_motion_give_one_answer():
    motion = rk.GroundMotion.kanai_tajimi(0.05, duration=10.0, seed=1)
    spectrum = MeanSpectrum([motion])
    assert st.asce_43_rocking(BLOCK, motion) == st.asce_43_rocking(BLOCK, spectrum)
    by_motion, by_spectrum = (
        st.asce_43_sliding(0.1, 0.0, shaking, room=1.0) for shaking in (motion, spectrum)
    )
    assert by_motion == by_spectrum
