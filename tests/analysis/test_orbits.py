"""Periodic motions and their multipliers, against closed forms and SciPy."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import erf

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics
from tests.refusals import refused, refuses, told

# --- the slender block: periodic motion and multipliers in closed form


SLENDER = rk.SlenderBlock.from_frequency(p=1.0, alpha=0.1)
UNIT = SLENDER.alpha * SLENDER.gravity  # beta = 1


def symmetric_orbits(beta, omega, e):
    """Motions of two impacts a cycle and their multipliers in closed form, the fastest first.

    For x = theta/alpha > 0: x'' = x - 1 - beta cos(omega t + phi), from x = 0 with the speed v to
    x = 0 with -v/e half a cycle later. Each is (x and x' at time t, phi, multipliers).
    """
    half, size = math.pi / omega, beta / (1 + omega**2)
    ch, sh = math.cosh(half), math.sinh(half)

    def solved(c):
        """a, b, v, sigma for c = size cos(phi), sigma = omega size sin(phi)."""
        left = [[1, 0, 0, 0], [0, 1, -1, -1], [ch, sh, 0, 0], [sh, ch, 1 / e, 1]]
        return np.linalg.solve(left, [-1 - c, 0, c - 1, 0])

    at_0, slope = solved(0.0)[3], solved(1.0)[3] - solved(0.0)[3]
    squares = [1 + (slope / omega) ** 2, 2 * at_0 * slope / omega**2, (at_0 / omega) ** 2 - size**2]
    found = []
    for c in np.roots(squares):
        if abs(c.imag) > 0:
            continue
        a, b, v, sigma = solved(c.real)
        phi = math.atan2(sigma / omega, c.real)

        def motion(t, a=a, b=b, phi=phi):
            x = 1 + a * np.cosh(t) + b * np.sinh(t) + size * np.cos(omega * t + phi)
            rate = a * np.sinh(t) + b * np.cosh(t) - omega * size * np.sin(omega * t + phi)
            return np.array([x, rate])

        if v > 0 and motion(np.linspace(0, half, 200)[1:-1])[0].min() > 0:
            landing, push = -v / e, -beta * math.cos(math.pi + phi)
            kick = ((push + 1) - e * (push - 1)) / landing
            flight, impact = np.array([[ch, sh], [sh, ch]]), np.array([[e, 0], [kick, e]])
            found.append((v, motion, phi, np.linalg.eigvals(impact @ flight) ** 2))
    return [rest for _, *rest in sorted(found, key=lambda one: -one[0])]


def slender_map(beta, omega, e, phase):
    """Looks at the block when the ground's cosine has the given phase [rad]."""
    period = 2 * math.pi / omega
    motion = rk.GroundMotion.harmonic(
        beta * UNIT, angular_frequency=omega, phase=phase + math.pi / 2, duration=2 * period
    )
    return dynamics.StroboscopicMap(SLENDER, motion, period, impact=rk.VelocityRatio(e))


@pytest.mark.parametrize(("branch", "stable"), [(0, True), (1, False)])
def test_slender_block_has_the_orbits_and_multipliers_of_the_closed_form(branch, stable):
    beta, omega, e, look = 0.5, 2.0, 0.9, 0.4
    motion, phi, multipliers = symmetric_orbits(beta, omega, e)[branch]
    state = SLENDER.alpha * motion(look)
    stroboscope = slender_map(beta, omega, e, phi + omega * look)
    orbit = stroboscope.orbit(state * [1.002, 0.998])
    assert orbit.state == pytest.approx(state, rel=1e-8)
    assert sorted(orbit.multipliers.real) == pytest.approx(sorted(multipliers.real), rel=1e-6)
    assert np.abs(orbit.multipliers.imag).max() == pytest.approx(np.abs(multipliers.imag).max())
    assert orbit.stable is stable
    assert orbit.initial == dict(zip(("theta", "theta_dot"), orbit.state, strict=True))
    twice = stroboscope.orbit(state, cycles=2)
    squares = np.sort_complex(orbit.multipliers**2)
    assert np.sort_complex(twice.multipliers) == pytest.approx(squares, rel=1e-5)


def test_symmetry_breaks_where_the_closed_form_says():
    """A multiplier +1 of the symmetric orbit, which is -1 for half a cycle."""
    omega, e, phase, near = 2 * math.pi / 3, 0.5, -1.0, (1.9, 2.1)

    def beyond(beta):
        return np.prod(symmetric_orbits(beta, omega, e)[0][2] - 1).real

    motion, phi, _ = symmetric_orbits(near[0], omega, e)[0]
    look = (phase - phi) / omega
    assert 0 < look < math.pi / omega
    found = dynamics.bifurcation_value(
        lambda beta: slender_map(beta, omega, e, phase),
        near,
        SLENDER.alpha * motion(look),
        multiplier=1,
    )
    assert found == pytest.approx(brentq(beyond, *near), abs=1e-5)


def test_orbit_is_followed_to_where_it_ends():
    """A weaker shaking does not keep the block rocking: the roots become complex."""
    omega, e, phase = 2.0, 0.9, -1.0
    betas = np.arange(0.3, 0.0, -0.005)
    closed = [symmetric_orbits(beta, omega, e) for beta in betas]
    ends = next(i for i, orbits in enumerate(closed) if not orbits)
    expected = [
        SLENDER.alpha * motion((phase - phi) / omega)
        for motion, phi, _ in (o[0] for o in closed[:ends])
    ]
    found = dynamics.continued_orbits(
        lambda beta: slender_map(beta, omega, e, phase), betas, expected[0]
    )
    assert ends - 1 <= len(found) <= ends
    for orbit, state in zip(found, expected, strict=False):
        assert orbit.state == pytest.approx(state, rel=1e-7)


# --- thesis Figure 2-12: the cascade of Hogan (1989)


SQUAT = rk.NondimensionalBlock(alpha=math.atan(0.5))
E_HOGAN = 0.5


def hogan(beta):
    motion = rk.GroundMotion.harmonic(
        SQUAT.alpha * beta, angular_frequency=2 * math.pi / 3, phase=math.pi / 2, duration=6.0
    )
    return dynamics.StroboscopicMap(SQUAT, motion, period=3.0, impact=rk.VelocityRatio(E_HOGAN))


def settled(beta, cycles=300):
    return hogan(beta).points({"x_dot": -0.3}, cycles)


def test_each_impact_shrinks_areas_by_the_square_of_the_velocity_ratio():
    """Two impacts a cycle, and no losses between them: det A = e**4."""
    for orbit in dynamics.continued_orbits(hogan, np.linspace(3.0, 3.26, 6), settled(3.0)[-1]):
        assert np.linalg.det(orbit.derivative) == pytest.approx(E_HOGAN**4, rel=1e-6)
        assert np.prod(orbit.multipliers).real == pytest.approx(E_HOGAN**4, rel=1e-6)


# --- vibrations without jumps


def test_column_that_does_not_lift_is_a_linear_oscillator():
    omega, damping, period, size = 10.0, 0.05, 0.5, 0.1
    column = rk.UpliftingOscillator.from_frequency(omega, damping, height=2.0, half_width=1.0)
    motion = rk.GroundMotion.harmonic(size, period=period, duration=2 * period)
    stroboscope = dynamics.StroboscopicMap(column, motion, period, states=("u", "u_dot"))
    orbit = stroboscope.orbit({"u": 1e-3})
    damped = omega * math.sqrt(1 - damping**2)
    expected = np.exp((-damping * omega + 1j * damped * np.array([1, -1])) * period)
    assert np.sort_complex(orbit.multipliers) == pytest.approx(np.sort_complex(expected), rel=1e-6)
    drive = 2 * math.pi / period
    steady = -size / (omega**2 - drive**2 + 2j * damping * omega * drive)
    state = [steady.imag, (1j * drive * steady).imag]
    assert orbit.state == pytest.approx(state, rel=1e-8)


# --- thesis Figure 4-73: the equivalent oscillator of the wall at 8 Hz


RATIO, WIDTH, MASS = 0.852, 3.551e-3, 2016.06
WALL = analysis.Wall.thesis()


def wall_map(amplitude, frequency=8.0, factor=1.0):
    """`factor` raises F_k alone: the other forces are in proportion to M_e."""
    wall = rk.ControlledWallOscillator.from_wall(WALL, RATIO, effective_mass=MASS / factor)
    period = 1 / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=period, duration=2 * period)
    return dynamics.StroboscopicMap(wall, motion, period, states=("u", "u_dot"))


def one_cycle_by_scipy(state, amplitude, frequency, factor=1.0):
    """The equation of thesis 4-43 with F_k of `analysis` and the sign of 4-28 mended."""
    loss = -math.log(math.sqrt(RATIO)) / (WIDTH * math.sqrt(math.pi))

    def rates(t, y):
        damping = loss * y[1] * abs(y[1]) * math.exp(-((y[0] / WIDTH) ** 2))
        ground = amplitude * math.sin(2 * math.pi * frequency * t)
        return [y[1], -factor * float(WALL.restoring_force(y[0])) / MASS - damping - ground]

    return solve_ivp(rates, (0, 1 / frequency), state, rtol=1e-9, atol=1e-11)


def test_wall_at_8_hz_has_one_symmetric_orbit_that_cannot_double():
    """From Z = 5 to 7 m/s2 its multipliers are complex, inside the circle of 4-28 (Liouville).

    The trace of the damping, integrated over the two passages, is ln(r) erf(D/n) for each, D the
    peak; so that the product of the multipliers is r**(2 erf(D/n)).
    """
    start = wall_map(5.0).points({"u": 0.004, "u_dot": 0.2}, 60)[-1]
    amplitudes = np.linspace(5.0, 7.0, 9)
    orbits = dynamics.continued_orbits(wall_map, amplitudes, start)
    assert len(orbits) == len(amplitudes)
    for amplitude, orbit in zip(amplitudes[::4], orbits[::4], strict=True):
        cycle = one_cycle_by_scipy(orbit.state, amplitude, 8.0)
        assert cycle.y[:, -1] == pytest.approx(orbit.state, rel=1e-5)
        peak = np.abs(cycle.y[0]).max()
        product = RATIO ** (2 * erf(peak / WIDTH))
        assert np.prod(orbit.multipliers).real == pytest.approx(product, rel=3e-4)
    for orbit in orbits:
        assert np.abs(orbit.multipliers.imag).min() > 0.4
        assert orbit.stable
    # the same from other states
    others = [{"u": -0.02}, {"u": 0.015, "u_dot": -0.6}, {}, {"u_dot": 0.5}]
    expected = wall_map(6.03).orbit(orbits[4].state).state
    for other in others:
        assert wall_map(6.03).points(other, 100)[-1] == pytest.approx(expected, abs=1e-5)


def test_wall_doubles_its_period_at_a_lower_frequency():
    """At 4.553 Hz, F_k raised by 6 %, a motion of four passages a cycle doubles at 6.03 m/s2."""
    factor, guess = 1.06, [2.28e-4, 0.0340]

    def at(frequency):
        return wall_map(6.03, frequency, factor)

    found = dynamics.bifurcation_value(at, (4.55, 4.556), guess)
    assert found == pytest.approx(4.5529, abs=2e-4)
    orbit = at(found).orbit(guess)
    cycle = one_cycle_by_scipy(orbit.state, 6.03, found, factor)
    assert cycle.y[:, -1] == pytest.approx(orbit.state, rel=1e-4)
    assert np.sum(np.diff(np.sign(cycle.y[0])) != 0) == 4
    assert np.abs(orbit.multipliers + 1).min() < 1e-4


# --- what cannot be


def test_bad_input_is_refused_with_a_remedy():
    motion = rk.GroundMotion.harmonic(0.1, period=1.0, duration=3.0)
    make = dynamics.StroboscopicMap
    assert refused(make, SLENDER, motion, 0.7) == ("period", 0.7)
    assert "lasts 3.0 s: give two periods of 2.0 s" in told(make, SLENDER, motion, 2.0)
    assert refused(make, SLENDER, motion, -1.0) == ("period", -1.0)
    assert refused(make, SLENDER, motion, 1.0, states=("u",)) == ("states", "u")
    good = make(SLENDER, motion, 1.0)
    assert refused(good.points, {"thta": 0.1}, 1) == ("state", "thta")
    assert "shape (3,): give one number for each of theta" in told(good.orbit, [0.0, 0.0, 1.0])
    with refuses("multiplier", 0.5):
        dynamics.bifurcation_value(hogan, (3.0, 3.1), {"x_dot": -0.3}, multiplier=0.5)


def test_what_is_not_there_is_said():
    with pytest.raises(ArithmeticError, match="fell over"):
        hogan(6.0).points({"x_dot": -0.3}, 50)
    column = rk.UpliftingOscillator.from_frequency(10.0, 0.0, height=2.0, half_width=1.0)
    motion = rk.GroundMotion.harmonic(0.1, period=math.pi / 5, duration=4.0)  # at resonance
    with pytest.raises(ArithmeticError, match="resonance without damping"):
        dynamics.StroboscopicMap(column, motion, math.pi / 5, states=("u", "u_dot")).orbit({})
    with pytest.raises(ValueError, match="no multiplier passes -1"):
        dynamics.bifurcation_value(hogan, (3.0, 3.05), settled(3.0)[-1])
