"""Branches of periodic motions, followed past folds and to where they change, against closed forms.

For x = theta/alpha > 0 the slender block is linear, x'' = x - 1 - beta cos(omega t + phi), so that
its motions of two mirrored halves, each from an impact to the next, follow from linear equations.
"""

import dataclasses
import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

import rockeom as rk
from rockeom.analysis import dynamics
from tests.interrupts import interrupted_at
from tests.refusals import refused, refuses, told

SLENDER = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)
UNIT = SLENDER.alpha * SLENDER.gravity  # beta = 1


class Half:
    """Half of a symmetric motion: from x = 0 with the speed v to x = 0 with -v/e."""

    def __init__(self, beta, omega, e, faster=True):
        half, size = math.pi / omega, beta / (1 + omega**2)
        ch, sh = math.cosh(half), math.sinh(half)
        left = [[1, 0, 0, 0], [0, 1, -1, -1], [ch, sh, 0, 0], [sh, ch, 1 / e, 1]]
        at_0, at_1 = (np.linalg.solve(left, [-1 - c, 0, c - 1, 0])[3] for c in (0.0, 1.0))
        slope = at_1 - at_0  # of omega size sin(phi) by c = size cos(phi)
        squares = [omega**2 + slope**2, 2 * at_0 * slope, at_0**2 - (omega * size) ** 2]
        self.discriminant = squares[1] ** 2 - 4 * squares[0] * squares[2]
        root = math.sqrt(max(self.discriminant, 0.0))
        both = [(-squares[1] + sign * root) / (2 * squares[0]) for sign in (1, -1)]
        found = [(np.linalg.solve(left, [-1 - c, 0, c - 1, 0]), c) for c in both]
        (self.a, self.b, self.v, sigma), c = sorted(found, key=lambda one: one[0][2])[faster]
        self.phi, self.omega, self.size = math.atan2(sigma / omega, c), omega, size
        kick = (beta * math.cos(self.phi) * (1 - e) + 1 + e) / (-self.v / e)
        self.derivative = np.array([[e, 0], [kick, e]]) @ np.array([[ch, sh], [sh, ch]])

    def at(self, t):
        wave = self.omega * t + self.phi
        x = 1 + self.a * np.cosh(t) + self.b * np.sinh(t) + self.size * np.cos(wave)
        rate = self.a * np.sinh(t) + self.b * np.cosh(t) - self.omega * self.size * np.sin(wave)
        return np.array([x, rate])

    def looked_at(self, phase):
        """(theta, theta_dot) when the ground's cosine has the phase, but for the sign."""
        return SLENDER.alpha * self.at(((phase - self.phi) % math.pi) / self.omega)

    def dip(self):
        """The lowest x between the impacts, where the rate passes zero upwards."""
        times = np.linspace(0, math.pi / self.omega, 400)[1:-1]
        rates = self.at(times)[1]
        i = np.flatnonzero((rates[:-1] < 0) & (rates[1:] > 0))[0]
        return self.at(brentq(lambda t: self.at(t)[1], times[i], times[i + 1], xtol=1e-14))[0]


def slender(beta, omega, e, phase, mirrored=True, p=1.0):
    """Looks at the block when the ground's cosine has the phase [rad]."""
    block = rk.SlenderBlock.from_frequency(p=p, alpha=SLENDER.alpha)
    period = 2 * math.pi / omega
    motion = rk.GroundMotion.harmonic(
        beta * UNIT, period=period, phase=phase + math.pi / 2, duration=2 * period
    )
    law = rk.VelocityRatio(e)
    return dynamics.StroboscopicMap(block, motion, period, law, mirrored=mirrored)


def expected_at(half, phase, orbit):
    """The closed form, of the same of two mirrored halves as an orbit."""
    state = half.looked_at(phase)
    return state * np.sign(state[0] * orbit.state[0])


# --- fold and grazing of the slender block


LONG, LOSS, LOOK = 0.5, 0.5, -1.79  # omega, e, and a phase at which no impact falls


@cache
def folded():
    """From the faster motion at beta = 1.5 to weaker shaking, and back along the slower one."""
    return dynamics.orbit_branch(
        lambda beta: slender(beta, LONG, LOSS, LOOK),
        (1.5, 0.1),
        Half(1.5, LONG, LOSS).looked_at(LOOK),
        step=0.05,
    )


def test_branch_goes_around_the_fold_where_both_closed_forms_meet():
    branch = folded()
    (fold,) = [one.value for one in branch.bifurcations if one.kind == "fold"]
    expected = brentq(lambda beta: Half(beta, LONG, LOSS).discriminant, 0.2, 1.0, xtol=1e-14)
    assert fold == pytest.approx(expected, abs=1e-10)
    turn = int(branch.values.argmin())
    assert turn > 5
    for i, (beta, orbit) in enumerate(zip(branch.values, branch.orbits, strict=True)):
        if abs(beta - fold) > 1e-3:
            half = Half(beta, LONG, LOSS, faster=i < turn)
            assert orbit.state == pytest.approx(expected_at(half, LOOK, orbit), rel=1e-7)
            traces = np.trace(orbit.derivative), -np.trace(half.derivative)
            assert traces[0] == pytest.approx(traces[1], rel=1e-7)


def test_branch_ends_where_the_slower_motion_touches_the_ground_between_its_impacts():
    branch = folded()
    assert branch.ended.startswith("a grazing was reached")
    grazing = branch.bifurcations[-1]
    expected = brentq(lambda beta: Half(beta, LONG, LOSS, False).dip(), 1.08, 1.25, xtol=1e-13)
    assert grazing.kind == "grazing"
    assert grazing.value == pytest.approx(expected, abs=1e-8)
    assert "at a grazing no other branch begins" in told(branch.switched, grazing)


def test_half_period_shrinks_areas_by_the_square_of_the_velocity_ratio():
    """One impact without losses but its own, along stable and unstable motions alike."""
    for orbit in folded().orbits[::8]:
        assert np.linalg.det(orbit.derivative) == pytest.approx(LOSS**2, rel=1e-7)
        assert orbit.order == (1, 1)
        assert orbit.symmetric


# --- the break of symmetry


OMEGA, E = 2 * math.pi / 3, 0.5


def at_beta(mirrored):
    return lambda beta: slender(beta, OMEGA, E, -1.0, mirrored)


@cache
def symmetric(mirrored):
    start = Half(1.8, OMEGA, E).looked_at(-1.0)
    return dynamics.orbit_branch(at_beta(mirrored), (1.8, 2.2), start, step=0.1)


def where_symmetry_breaks():
    def beyond(beta):
        return np.linalg.det(Half(beta, OMEGA, E).derivative - np.eye(2))

    return brentq(beyond, 1.8, 2.2, xtol=1e-14)


def test_symmetry_breaks_where_the_closed_form_says():
    """A multiplier -1 in the mirror, +1 of the whole period, where the other branch crosses."""
    (seen,) = symmetric(True).bifurcations
    assert (seen.kind, seen.orbit.symmetric) == ("symmetry breaking", True)
    assert seen.value == pytest.approx(where_symmetry_breaks(), abs=1e-9)
    (unseen,) = symmetric(False).bifurcations
    assert unseen.kind == "branch point"
    assert unseen.value == pytest.approx(where_symmetry_breaks(), abs=1e-8)


def test_motions_behind_the_break_are_two_mirror_images():
    """Both maps find them, each from the bifurcation that it sees."""
    by_both = []
    for mirrored in (True, False):
        branch = symmetric(mirrored)
        broken = branch.switched(branch.bifurcations[0], step=0.1)
        by_both.append(broken.at(2.05))
        assert np.all(broken.stable[3:7])
        areas = [np.linalg.det(orbit.derivative) for orbit in broken.orbits[3:7]]
        assert areas == pytest.approx([E**4] * 4, rel=1e-7)
    one, other = by_both
    assert (one.order, one.symmetric) == ((1, 1), False)
    apart = [np.abs(other.state - image).max() for image in one.looks]
    assert min(apart) < 1e-9 < 1e-3 < max(apart)


# --- any parameter


@settings(max_examples=6, deadline=None)
@given(
    st.floats(0.8, 1.2), st.floats(1.6, 2.4), st.floats(0.7, 0.9),
    st.sampled_from(["beta", "omega", "e", "p"]), st.floats(0.9, 1.1),
)  # fmt: skip
def test_branch_in_any_parameter_is_the_closed_form(beta, omega, e, name, factor):
    """Of the shaking, of the law, of the structure: of a larger block time goes slower by p."""
    given = {"beta": beta, "omega": omega, "e": e, "p": 1.0}

    def half(value):
        of = given | {name: value}
        return Half(of["beta"], of["omega"] / of["p"], of["e"])

    phase = half(given[name]).phi + 0.5 * math.pi

    def at(value):
        return slender(**given | {name: value}, phase=phase)

    ends = given[name], given[name] * (factor if abs(factor - 1) > 0.01 else 1.05)
    branch = dynamics.orbit_branch(at, ends, half(ends[0]).looked_at(phase), step=0.3)
    assert branch.values[-1] == ends[1]
    for value, orbit in zip(branch.values, branch.orbits, strict=True):
        clock = value if name == "p" else 1.0
        expected = expected_at(half(value), phase, orbit) * [1.0, clock]
        assert orbit.state == pytest.approx(expected, rel=1e-8)


# --- thesis Figure 2-12: the cascade of Hogan (1989)


SQUAT = rk.NondimensionalBlock(alpha=math.atan(0.5))


def hogan(beta, mirrored=True, options=None):
    motion = rk.GroundMotion.harmonic(
        SQUAT.alpha * beta, angular_frequency=2 * math.pi / 3, phase=math.pi / 2, duration=6.0
    )
    law = rk.VelocityRatio(0.5)
    return dynamics.StroboscopicMap(SQUAT, motion, 3.0, law, options=options, mirrored=mirrored)


@cache
def cascade():
    start = hogan(2.0).points({"x_dot": -0.3}, 60)[-1]
    return dynamics.period_doublings(hogan, (2.0, 3.26), start, number=4)


def test_cascade_doubles_the_order_and_tends_to_feigenbaum():
    found = cascade()
    assert [one.kind for one in found.bifurcations] == ["symmetry breaking"] + 4 * [
        "period doubling"
    ]
    assert [one.orbit.order for one in found.bifurcations] == [
        (1, 1), (1, 1), (2, 2), (4, 4), (8, 8)
    ]  # fmt: skip
    assert found.ratios[-1] == pytest.approx(dynamics.branches.FEIGENBAUM, rel=0.02)
    # a number found without any multiplier, from long runs
    assert found.accumulations[-1] == pytest.approx(3.2318, abs=5e-5)


def test_each_doubling_is_where_a_simulation_begins_to_need_twice_the_periods():
    first, second, third, _ = cascade().values[1:]
    for beta, cycles in (
        (first - 0.02, 1),
        (first + 0.02, 2),
        (second - 0.005, 2),
        (second + 0.005, 4),
        (third - 0.002, 4),
        (third + 0.001, 8),
    ):
        late = hogan(beta, False).points({"x_dot": -0.3}, 300)[-17:]
        repeats = [k for k in (1, 2, 4, 8) if np.abs(late[k:] - late[:-k]).max() < 1e-5]
        assert repeats[0] == cycles


def test_doublings_are_the_same_by_another_method_and_without_a_mirror():
    """To 1e-8: other steps, other tolerances, and shots twice as long."""
    other = rk.SolverOptions(method="RK45", rtol=1e-11, atol=1e-13)
    for bifurcation, cycles in zip(cascade().bifurcations[1:], (1, 2, 4, 8), strict=True):
        value, start = bifurcation.value, bifurcation.orbit.looks[::2]
        found = dynamics.bifurcation_value(
            lambda beta: hogan(beta, False, other), (value - 1e-4, value + 1e-4), start, cycles
        )
        assert found == pytest.approx(value, abs=1e-8)


# --- sliding, frames


def test_block_that_slides_to_and_fro_is_den_hartogs():
    """Coulomb friction without sticking, after Den Hartog (1931); it never rocks.

    From rest at a phase phi of A sin, x' = A (cos(w t + phi) - cos(phi))/w - mu g t is zero again
    half a period later if cos(phi) = -pi mu g/(2 A). There the friction turns: the rate of x' just
    behind, over that just before, is the multiplier of the rate.
    """
    friction, size, period = 0.2, 9.0, 0.8
    block = rk.SlidingBlock(half_width=0.5, half_height=0.1, friction=friction, restitution=0.0)
    hold, w, look = friction * block.gravity, 2 * math.pi / period, 0.2
    phi = -math.acos(-math.pi * hold / (2 * size))
    motion = rk.GroundMotion.harmonic(
        size, period=period, phase=phi + w * look, duration=2 * period
    )
    rate = size * (math.cos(w * look + phi) - math.cos(phi)) / w - hold * look
    stroboscope = dynamics.StroboscopicMap(
        block, motion, period, states=("x", "x_dot"), mirrored=True
    )
    orbit = stroboscope.orbit({"x_dot": 1.1 * rate})
    assert orbit.state[1] == pytest.approx(rate, rel=1e-9)
    before, behind = (-size * math.sin(math.pi + phi) - sign * hold for sign in (1, -1))
    expected = sorted([-1.0, -behind / before])  # of where it lies, and of its rate
    assert sorted(orbit.multipliers.real) == pytest.approx(expected, rel=1e-7)


def test_frame_moves_as_the_block_it_is_equivalent_to():
    """A frame with a heavy beam rocks as a larger block of the same slenderness.

    Makris and Vassiliou (2013): its frequency parameter is p sqrt((1 + 2 gamma)/(1 + 3 gamma)).
    """
    gamma, width, height = 2.0, 0.2, 1.0
    frame = rk.RockingFrame(
        columns=2, column_mass=1.0, half_width=width, half_height=height, beam_mass=2 * gamma
    )
    larger = (1 + 3 * gamma) / (1 + 2 * gamma)
    block = rk.RigidBlock(half_width=larger * width, half_height=larger * height)
    motion = rk.GroundMotion.harmonic(2.5, period=1.2, phase=0.6, duration=2.4)
    law = rk.VelocityRatio(0.8)
    maps = [
        dynamics.StroboscopicMap(one, motion, 1.2, law, mirrored=True) for one in (frame, block)
    ]
    start = maps[1].points({"theta": 0.02}, 60)[-1]
    found, expected = (one.orbit(start) for one in maps)
    assert found.state == pytest.approx(expected.state, rel=1e-8)
    assert found.multipliers == pytest.approx(expected.multipliers, rel=1e-6)
    assert np.linalg.det(found.derivative) == pytest.approx(0.8**2, rel=1e-7)


# --- maps of one number, whose branches are known curves


class Formula:
    """A map x -> f(x) of one number, where a branch asks for a stroboscopic map."""

    def __init__(self, f):
        self.f = f

    def shooting(self, states, more=0):
        x = np.array(states, dtype=float)
        found = [self.f(rk.Dual(one, np.eye(1, 1 + more)[0])) for one in x[:, 0]]
        after, slopes = (
            np.array([getattr(y, part) for y in found]) for part in ("value", "tangent")
        )
        return dynamics.Shooting(
            x, after[:, None], slopes[:, None, :1], slopes[:, None, 1:], (), np.ones(1)
        )

    def orbit(self, guess, cycles):
        return self.closed(self.shooting(np.reshape(guess, (cycles, 1))))

    def closed(self, shot):
        return dynamics.PeriodicOrbit(
            ("x",), shot.x[0], len(shot.x), shot.derivative, shot.size, shot.residual, shot.x, ()
        )


def bubble(value):
    """x -> -(1 + m) x + x**3 with m = (1 - value**2)/4: of two cycles are x**2 = m."""
    return Formula(lambda x: x**3 - (1 + (1 - value * value) / 4) * x)


def test_period_that_doubles_and_halves_again_is_a_loop():
    line = dynamics.orbit_branch(bubble, (-2.0, 2.0), [0.0])
    assert [one.kind for one in line.bifurcations] == ["period doubling"] * 2
    assert [one.value for one in line.bifurcations] == pytest.approx([-1.0, 1.0], abs=1e-9)
    loop = line.switched(line.bifurcations[0])
    assert [one.kind for one in loop.bifurcations] == ["branch point"]
    assert loop.bifurcations[0].value == pytest.approx(1.0, abs=1e-8)
    assert loop.ended == "it came back to its start"
    x = np.array([orbit.looks[:, 0] for orbit in loop.orbits])
    assert x[:, 0] == pytest.approx(-x[:, 1], abs=1e-8)
    assert x[:, 0] ** 2 == pytest.approx((1 - loop.values**2) / 4, abs=1e-8)
    assert x[:, 0].max() == pytest.approx(0.5, abs=0.01)
    assert x[:, 0].min() == pytest.approx(-0.5, abs=0.01)
    assert np.ptp(loop.values) == pytest.approx(2.0, abs=0.01)


def test_where_two_branches_cross_both_are_followed():
    """x**2 = value x: the motions 0 and value, whose multipliers pass 1 where they meet."""

    def crossing(value):
        return Formula(lambda x: x + x * x - value * x)

    line = dynamics.orbit_branch(crossing, (-1.0, 1.0), [0.0])
    (found,) = line.bifurcations
    assert (found.kind, found.value) == ("branch point", pytest.approx(0.0, abs=1e-9))
    other = line.switched(found)
    assert abs(other.values[-1]) == 1.0
    assert [orbit.state[0] for orbit in other.orbits] == pytest.approx(other.values, abs=1e-9)


def test_interrupted_branch_is_kept_and_goes_on():
    part = dynamics.orbit_branch(interrupted_at(60, bubble), (-2.0, 2.0), [0.0])
    assert part.ended == "it was interrupted"
    assert -2.0 < part.values[-1] < 2.0
    last = part.orbits[-1]
    rest = dynamics.orbit_branch(bubble, (part.values[-1], 2.0), last.looks, last.cycles)
    assert len(part.bifurcations) + len(rest.bifurcations) == 2


# --- what cannot be


def test_structure_that_prefers_a_side_has_no_mirror_image():
    even = slender(0.5, 2.0, 0.9, 0.4)
    start = even.orbit(Half(0.5, 2.0, 0.9).looked_at(0.4)).state
    law = rk.EnergyRatio(left=0.81, right=0.80)
    with pytest.raises(ValueError, match="the mirror image moves otherwise"):
        dataclasses.replace(even, impact=law).orbit(start)


def test_bad_input_is_refused_with_a_remedy():
    motion = rk.GroundMotion.harmonic(0.1, period=1.0, duration=3.0)
    uneven = rk.GroundMotion.from_array([0.0, 1.0, 0.0, 0.0] * 3 + [0.0], 0.25)
    with pytest.raises(ValueError, match="not its own negative half a period later"):
        dynamics.StroboscopicMap(SLENDER, uneven, 1.0, mirrored=True)
    with refuses("upward", "y"):
        dynamics.StroboscopicMap(SLENDER, motion, 1.0, mirrored=True, upward=("y",))
    assert refused(dynamics.orbit_branch, hogan, (2.0, 2.0), {"x_dot": -0.3})[0] == "between"
    with refuses("value", 3.0):
        folded().at(3.0)
