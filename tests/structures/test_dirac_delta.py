"""The slender block with impacts as forces (thesis 2-29) against the block with sudden impacts."""

import math
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import quad, solve_ivp, trapezoid
from scipy.special import erf

import rockeom as rk
from rockeom.motion import STANDARD_GRAVITY
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.structures.dirac_delta import delta, impact_force, loss

START, RATIO = 0.4, 0.7225
"""x_0 and r of thesis Figure 2-16."""
ALPHA = math.atan(1 / 3)
PEAKS = 1 - np.sqrt(1 - 2 * (START - START**2 / 2) * RATIO ** np.arange(1, 4))
"""Each sudden impact multiplies the energy x - x^2/2 at the peak by r."""


def block(n, r=RATIO):
    return rk.DiracDeltaBlock(alpha=ALPHA, energy_ratio=r, regularisation=n)


def released(n, x=START, r=RATIO, duration=6.0, **options):
    return rk.simulate(
        block(n, r),
        rk.GroundMotion.none(duration),
        initial={"x": x},
        options=rk.SolverOptions(**options),
    )


def upright(run):
    """Times of the passages through x = 0."""
    core = {"left_core", "right_core"}
    return [e.time for e in run.events if {e.mode_before, e.mode_after} == core]


def peaks(run):
    between = [np.linspace(*pair, 4001) for pair in pairwise(upright(run))]
    return np.array([np.abs(run.at(t)["x"]).max() for t in between])


# -- the force


def test_equation_is_that_of_the_thesis_with_the_sign_mended():
    """2-29 with + ln(sqrt(r)): the printed minus sign would give energy to the block."""
    model = rk.derive("dirac_delta_block")
    (x,) = model.coordinates
    alpha, r, n = (p.symbol for p in model.parameters)
    equations = model.equations("right_core")
    still = {GROUND_X: 0, GROUND_Y: 0}
    found = sp.expand(equations.forcing[0] / equations.mass_matrix[0]).subs(still)
    q, v = x.position, x.velocity
    force = sp.log(sp.sqrt(r)) / (n * sp.sqrt(sp.pi)) * sp.tanh(v / n) * v**2
    expected = q - sp.tanh(q / n) + force * sp.exp(-(q**2) / n**2)
    assert sp.simplify(found - expected) == 0
    assert not found.has(alpha)


@pytest.mark.parametrize("direction", [1, -1])
def test_passage_multiplies_the_velocity_by_the_root_of_the_energy_ratio(direction):
    """2-22 for either direction: v dv/g(v) and delta_n(x) dx have the same integral."""
    r, n, v_0 = sp.symbols("r n v_0", positive=True)
    x, v = sp.symbols("x v", real=True)
    k = loss(r)
    assert sp.simplify(k - sp.log(sp.sqrt(r))) == 0
    way = sp.integrate(delta(x, n), (x, -direction * sp.oo, direction * sp.oo))
    ends = (direction * v_0, direction * sp.sqrt(r) * v_0)

    def passage(g):
        inside = sp.integrate(v / g, v)
        return sp.simplify(sp.expand_log(inside.subs(v, ends[1]) - inside.subs(v, ends[0])))

    assert passage(k * v**2 * direction) == way == direction
    assert passage(-k * v**2 * direction) == -way  # as printed in 2-26: the block would gain
    # far from v = 0 the force of the model is that g, times the delta
    force = impact_force(x, v, r, n) / delta(x, n) / (k * v**2)
    assert sp.limit(force.subs(v, direction * v_0), n, 0) == direction


# -- against the piecewise block


def test_released_block_of_the_thesis():
    """Figure 2-16: the first impact at ln 3, peaks 0.267, 0.184, 0.129."""
    run = released(1e-3)
    assert upright(run)[0] == pytest.approx(math.log(3), abs=1e-4)
    found = peaks(run)[:3]
    np.testing.assert_allclose(found, [0.267, 0.184, 0.129], atol=1e-3)
    np.testing.assert_allclose((found - PEAKS)[:2], [3.4e-4, 5.3e-4], atol=1e-5)


def test_error_is_in_proportion_to_the_width_as_perturbation_theory_says():
    """The excess of the potential n (ln(2 cosh(x/n)) - |x|/n) over |x| acts inside the width.

    To first order in n an impact leaves E+ = r E- + n C with E = v^2/2 + |x| - x^2/2 and
    C = -2K int phi(z) ln(2 cosh z) exp(2K (1 - Phi(z))) dz, phi the Gaussian and Phi its integral.
    """
    twice_k = math.log(RATIO)

    def excess(z):
        left = (1 - erf(z)) / 2
        potential = abs(z) + math.log1p(math.exp(-2 * abs(z)))
        return math.exp(-z * z) / math.sqrt(math.pi) * potential * math.exp(twice_k * left)

    gain = -twice_k * quad(excess, -8, 8, epsabs=1e-13)[0]
    energy, slopes = START - START**2 / 2, []
    change = 0.0
    for peak in PEAKS:
        energy, change = RATIO * energy, RATIO * change + gain
        slopes.append(change / (1 - peak))  # E = x - x^2/2 at a peak
    for n, far in ((1e-2, 0.02), (1e-3, 2e-3), (1e-4, 2e-4)):
        np.testing.assert_allclose((peaks(released(n))[:3] - PEAKS) / n, slopes, rtol=far)
    # at n = 0.1 the release itself lies in the width of the impact
    assert np.abs(peaks(released(0.1))[0] - PEAKS[0]) < 0.05


def test_shaken_block_follows_the_slender_one():
    """Scaled time, accelerations in g and rotation in alpha; with vertical shaking."""
    n, t = 1e-6, np.linspace(0, 12, 500)
    wave, shake = np.sin(5.0 * t), np.sin(7.0 * t)

    def motions(unit):
        dt = t[1]
        return (
            rk.GroundMotion.from_array(2.0 * ALPHA * unit * wave, dt=dt),
            rk.GroundMotion.from_array(0.2 * unit * shake, dt=dt),
        )

    record, vertical = motions(STANDARD_GRAVITY)
    run = rk.simulate(
        rk.SlenderBlock.from_frequency(p=1.0, alpha=ALPHA), record, vertical=vertical,
        impact=rk.EnergyRatio(RATIO), initial={"theta": 0.3 * ALPHA},
    )  # fmt: skip
    record, vertical = motions(1.0)
    spread = rk.simulate(block(n), record, vertical=vertical, initial={"x": 0.3})
    assert len(run.impacts) > 3
    times = np.linspace(0, min(run.t[-1], spread.t[-1]), 500)
    assert times[-1] > 11.0
    x = run.at(times)["theta"] / ALPHA
    np.testing.assert_allclose(spread.at(times)["x"], x, atol=100 * n)
    assert np.abs(x).max() > 0.3


@pytest.mark.parametrize("n", [0.3, 0.05])
def test_wide_impact_against_another_integrator(n):
    """2-29 typed by hand, integrated by SciPy; the release may lie inside the impact."""

    def rate(t, y):
        x, v = y
        force = math.log(math.sqrt(RATIO)) / (n * math.sqrt(math.pi)) * math.tanh(v / n) * v * v
        return [v, x - math.tanh(x / n) + force * math.exp(-((x / n) ** 2))]

    other = solve_ivp(
        rate, (0, 6), [START, 0.0], method="DOP853", rtol=1e-12, atol=1e-13, max_step=0.02,
        t_eval=np.linspace(0, 6, 200),
    )  # fmt: skip
    found = released(n).at(other.t)
    np.testing.assert_allclose(found["x"], other.y[0], atol=1e-9)
    np.testing.assert_allclose(found["x_dot"], other.y[1], atol=1e-9)


# -- failures


@pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])
@pytest.mark.parametrize("n", [1e-3, 1e-5, 1e-8])
def test_long_steps_without_error_control_do_not_leap_over_the_impact(method, n):
    """Steps of half a unit of time, in which the block moves up to 5e7 times the width."""
    still = rk.GroundMotion.from_array(np.zeros(8), dt=0.5)
    for start in np.linspace(0.1, 0.9, 12):
        run = rk.simulate(
            block(n), still, initial={"x": start},
            options=rk.SolverOptions(method=method, steps_per_segment=1),
        )  # fmt: skip
        enters = next(e for e in run.events if e.mode_before == "right")
        leaves = next(e for e in run.events if e.mode_after == "left")
        energies = [block(n).energies(e.before, e.mode_before) for e in (enters, leaves)]
        before, after = (sum(e.values()) - 1 for e in energies)
        assert after / before == pytest.approx(RATIO, abs=0.01)


def test_explicit_method_needs_few_steps_however_narrow_the_impact():
    steps = [released(n).statistics["steps"] for n in (1e-3, 1e-6)]
    assert max(steps) < 1000


def test_energy_is_kept_without_loss_and_never_grows_with_it():
    run = released(1e-3, r=1.0)
    energy = run["total_energy"] - 1
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)
    lossy = released(1e-3)["total_energy"]
    assert np.diff(lossy).max() < 1e-11
    assert lossy[-1] < lossy[0]


def test_mirrored_motion_is_the_mirror_image_to_the_last_bit():
    rng = np.random.default_rng(3)
    motion = rk.GroundMotion.from_array(rng.normal(scale=0.3, size=60), dt=0.1)
    start = {"x": 0.2, "x_dot": -0.1}
    run = rk.simulate(block(1e-3), motion, initial=start)
    image = rk.simulate(block(1e-3), -motion, initial={k: -v for k, v in start.items()})
    assert len(upright(run)) > 3
    for name in run.states:
        np.testing.assert_array_equal(image[name], -run[name])


def test_energy_ratio_above_one_is_refused():
    with pytest.raises(ValueError, match=r"energy_ratio is 1\.2: above 1"):
        block(1e-3, r=1.2)


def test_law_of_impact_is_refused():
    with pytest.raises(ValueError, match="dirac_delta_block has no impacts"):
        rk.simulate(block(1e-3), rk.GroundMotion.none(1.0), impact=rk.EnergyRatio(0.9))


# -- figures of the thesis


def test_figure_of_both_formulations_shows_them_alike_and_the_convergence():
    figures = pytest.importorskip("rockeom.thesis.figures")
    *axes, right = figures.FIGURES["2-16"]().axes
    sharp, smooth = axes[0].lines
    t = np.linspace(0, 6, 500)
    curves = [np.interp(t, line.get_xdata(), line.get_ydata()) for line in (sharp, smooth)]
    np.testing.assert_allclose(*curves, atol=5e-3)
    for line in right.lines:
        slopes = np.diff(np.log(line.get_ydata())) / np.diff(np.log(line.get_xdata()))
        np.testing.assert_allclose(slopes, 1.0, atol=0.06)


def test_figure_of_the_delta_has_unit_areas():
    figures = pytest.importorskip("rockeom.thesis.figures")
    for line in figures.FIGURES["2-15"]().axes[0].lines[1:]:  # the widest leaves the picture
        assert trapezoid(line.get_ydata(), line.get_xdata()) == pytest.approx(1.0, abs=1e-4)


def test_figure_of_the_widths_nears_the_piecewise_block():
    figures = pytest.importorskip("rockeom.thesis.figures")
    *spread, sharp = figures.FIGURES["2-17"]().axes[0].lines
    t = np.linspace(0, 8, 400)
    values = [np.interp(t, line.get_xdata(), line.get_ydata()) for line in (*spread, sharp)]
    errors = [np.abs(v - values[-1]).max() for v in values[:-1]]
    assert errors[0] > 3 * errors[1] > 9 * errors[2]
