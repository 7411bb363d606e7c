"""Derivatives of answers by name, against closed forms, dimensional analysis and differences."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from tests.typical import S1

FINE = rk.SolverOptions(rtol=1e-12, atol=1e-15)
BLOCK = rk.RigidBlock(half_width=0.2, half_height=0.8, mass=300.0)
STILL = rk.GroundMotion.none(4.0)


def differences(make, values, of, h=1e-5):
    """(n, k) central differences of answers of cases, of the order h**4."""
    columns = []
    for name, value in values.items():
        step = h * max(abs(value), 0.1)

        def at(steps, name=name, value=value, step=step):
            case = make(**(values | {name: value + steps * step}))
            return rk.sensitivity(case, of, ["gravity"], FINE).values

        near, far = at(1) - at(-1), at(2) - at(-2)
        columns.append((8.0 * near - far) / (12.0 * step))
    return np.column_stack(columns)


# --- the linearised block let go: Housner (1963), quarter periods and rates in closed form


def decay(radius, alpha, gravity, theta_0, e, impacts):
    """(times, rates before) of the impacts of a slender block."""
    p = mp.sqrt(3 * gravity / (4 * radius))
    left = 1 - theta_0 / alpha  # cosh of p times the first quarter period is its inverse
    time, times, rates = mp.mpf(0), [], []
    for i in range(impacts):
        time += (1 if i == 0 else 2) * mp.acosh(1 / left) / p
        rate = p * alpha * mp.sqrt(1 - left**2)
        times.append(time)
        rates.append(-rate * (-1) ** i)
        left = mp.sqrt(1 - e**2 * (1 - left**2))
    return times, rates


def test_impacts_of_a_slender_block_let_go():
    numbers = {"radius": 1.3, "alpha": 0.2, "gravity": 9.81, "theta_0": 0.12, "e": 0.92}
    block = rk.SlenderBlock(radius=1.3, alpha=0.2)
    still = rk.GroundMotion.none(8.0)
    case = rk.Case(block, still, impact=rk.VelocityRatio(0.92), initial={"theta": 0.12})
    of = [f"impact {i} {what}" for i in range(1, 7) for what in ("time", "theta_dot")]
    to = ["radius", "alpha", "gravity", "initial theta", "restitution", "mass"]
    found = rk.sensitivity(case, of, to, FINE)
    with mp.workdps(30):
        for i in range(6):
            for part in (0, 1):
                row = 2 * i + part
                for j, name in enumerate(numbers):

                    def of_one(x, name=name, i=i, part=part):
                        return decay(**(numbers | {name: x}), impacts=6)[part][i]

                    expected = float(mp.diff(of_one, numbers[name]))
                    np.testing.assert_allclose(found.derivatives[row, j], expected, rtol=1e-9)
    np.testing.assert_array_equal(found.derivatives[:, 5], 0.0)  # mass, the inertia in proportion


def test_first_impact_of_a_block_by_energy_and_by_angular_momentum():
    """The rate before by the energy, after by Housner's e = 1 - 3/2 sin(alpha)**2."""

    def rate(b, h, g, theta_0):
        alpha, radius = mp.atan2(b, h), mp.hypot(b, h)
        fallen = mp.cos(alpha - theta_0) - mp.cos(alpha)
        return -mp.sqrt(2 * g * fallen / (mp.mpf(4) / 3 * radius))

    def after(b, h, g, theta_0):
        return rate(b, h, g, theta_0) * (1 - mp.mpf(3) / 2 * mp.sin(mp.atan2(b, h)) ** 2)

    case = rk.Case(BLOCK, STILL, initial={"theta": 0.1})
    to = ["half_width", "half_height", "gravity", "initial theta"]
    of = ["impact 1 theta_dot", "impact 1 theta_dot after"]
    found = rk.sensitivity(case, of, to, FINE)
    point = (0.2, 0.8, 9.81, 0.1)
    for row, function in enumerate((rate, after)):
        for j in range(4):
            order = tuple(int(i == j) for i in range(4))
            expected = float(mp.diff(function, point, order))
            np.testing.assert_allclose(found.derivatives[row, j], expected, rtol=1e-8)


# --- lengths and times in other units: sums of elasticities that no equation of motion enters


@settings(max_examples=6, deadline=None)
@given(st.floats(0.15, 0.35), st.floats(0.5, 2.0), st.floats(1.2, 3.0), st.floats(0.3, 1.2))
def test_elasticities_obey_dimensional_analysis(slenderness, height, amplitude, period):
    block = rk.RigidBlock(half_width=slenderness * height, half_height=height)
    pulse = rk.GroundMotion.single_sine(amplitude * 9.81 * slenderness, period, duration=4.0)
    case = rk.Case(block, pulse, initial={"theta": 0.02}, duration=0.8 * period)
    to = ["half_width", "half_height", "gravity", "amplitude", "time_scale", "mass", "duration"]
    found = rk.sensitivity(case, ["end theta", "end kinetic_energy"], to)
    width, tall, gravity, ground, time, mass, end = found.elasticities.T
    # lengths times k and times times sqrt(k) is the same angle, and k times the energy
    np.testing.assert_allclose(width + tall + 0.5 * (time + end), [0.0, 1.0], atol=1e-6)
    # accelerations times k and times by sqrt(k) as well
    np.testing.assert_allclose(gravity + ground - 0.5 * (time + end), [0.0, 1.0], atol=1e-6)
    np.testing.assert_allclose(mass, [0.0, 1.0], atol=1e-12)


# --- extremes, and places that move with what is turned


@pytest.mark.parametrize(("end", "places"), [(0.8, (0.25, 0.8)), (1.5, (0.845, 1.422))])
def test_extremes_at_corners_of_the_ground_at_the_end_and_at_impacts(end, places):
    def make(half_width, gravity, a, t, e):
        block = rk.RigidBlock(half_width=half_width, half_height=0.8, gravity=gravity)
        pulse = rk.GroundMotion.constant(4.0, 0.25, total_duration=1.5).scaled(a, t)
        return rk.Case(block, pulse, impact=rk.VelocityRatio(e), duration=end)

    values = {"half_width": 0.2, "gravity": 9.81, "a": 1.0, "t": 1.0, "e": 0.9}
    of = [
        "peak theta",
        "greatest theta_dot",
        "least theta_dot",
        "peak displacement",
        "peak theta_dot",
    ]
    to = ["half_width", "gravity", "scale", "time_scale", "restitution"]
    found = rk.sensitivity(make(**values), of, to, FINE)
    np.testing.assert_allclose(
        found.derivatives, differences(make, values, of), rtol=1e-6, atol=1e-7
    )
    of_rate = found.tangents.response.extremes("theta_dot")
    np.testing.assert_allclose(
        sorted([of_rate.minimum_time, of_rate.maximum_time]), places, atol=1e-3
    )


def test_answers_of_a_column_on_springs_that_falls():
    def make(mass, stiffness, support, e, gravity):
        column = rk.FlexibleStructure(
            **(S1 | {"mass": mass}), stiffness=stiffness, damping=300.0, gravity=gravity,
            support=rk.TwoSprings(stiffness=support, damping=1e3),
        )  # fmt: skip
        return rk.Case(column, rk.GroundMotion.single_sine(e, 1.2, duration=6.0))

    values = {"mass": 122.6, "stiffness": 5e5, "support": 5e6, "e": 5.0, "gravity": 9.81}
    case = make(**values)
    of = ["overturning time", "event 3 time", "u at 0.4", "end theta", "end theta_dot"]
    of += ["greatest column_force", "greatest kinetic_energy", "column_energy at 0.7"]
    to = ["mass", "stiffness", "support.stiffness", "amplitude", "gravity"]
    found = rk.sensitivity(case, of, to, FINE)
    expected = differences(make, values, of)
    expected *= found.parameters / found.values[:, None]
    np.testing.assert_allclose(found.elasticities, expected, rtol=1e-5, atol=1e-7)
    fallen = [found.of.index("end theta")]
    np.testing.assert_allclose(found.derivatives[fallen], 0.0, atol=1e-9)  # it is the bound


def test_numbers_of_laws_and_lists():
    frame = rk.ShearFrame(
        masses=[2e3, 1e3], heights=[3.0, 6.0], stiffnesses=[2e6, 1e6], dampings=[1e3, 1e3],
        half_width=1.0, base_mass=1e3,
    )  # fmt: skip
    case = rk.Case(
        frame, STILL, impact=rk.EnergyRatio(left=0.8, right=0.9), initial={"theta": 0.05}
    )
    with pytest.raises(ValueError, match=r"masses\[1\] .kg.*left .*right"):
        rk.sensitivity(case, ["end theta"], ["masses"])
    block = rk.Case(
        BLOCK, STILL, impact=rk.EnergyRatio(left=0.8, right=0.9), initial={"theta": 0.1}
    )
    found = rk.sensitivity(block, ["impact 2 time", "impact 3 time"], ["left", "right"])
    # the left foot lands first, the right one second
    assert found.derivatives[0, 1] == 0.0
    assert min(found.derivatives[0, 0], *found.derivatives[1]) > 0.0


def test_restitution_is_the_ratio_of_the_rates_whatever_the_law_is_given():
    cases = [
        rk.Case(BLOCK, STILL, impact=law, initial={"theta": 0.1})
        for law in (rk.VelocityRatio(0.9), rk.EnergyRatio(0.81))
    ]
    by_e, by_r = (
        rk.sensitivity(case, ["impact 2 time"], ["restitution"]).derivatives[0] for case in cases
    )
    np.testing.assert_allclose(by_e, by_r, rtol=1e-12)
    of_r = rk.sensitivity(cases[1], ["impact 2 time"], ["r"]).derivatives[0, 0]
    np.testing.assert_allclose(of_r * 2 * 0.9, by_e[0], rtol=1e-12)  # r = e**2


# --- what it is beside


def test_the_motion_is_that_of_simulate_and_the_table_has_units():
    case = rk.Case(BLOCK, rk.GroundMotion.single_sine(3.0, 0.8))
    found = rk.sensitivity(case, ["peak theta"], ["half_height", "amplitude"])
    alone = rk.simulate(case.structure, case.motion)
    np.testing.assert_array_equal(found.tangents.response.y, alone.y)
    assert found.tangents.response.motion == case.motion
    assert found.values[0] == pytest.approx(abs(alone.extremes("theta").peak), abs=0)
    lines = repr(found).splitlines()
    assert "peak theta [rad]" in lines[0]
    assert lines[2].split()[:3] == ["half_height", "[m]", "0.8"]
    assert found.to_dataframe().loc["peak theta", "amplitude"] == found.derivatives[0, 1]


CASE = rk.Case(BLOCK, STILL, impact=rk.EnergyRatio(0.8), initial={"theta": 0.1})


@pytest.mark.parametrize(
    ("of", "to", "said"),
    [
        (["peak theta"], ["half_with"], "did you mean half_width"),
        (["peak thet"], ["mass"], "did you mean theta"),
        (["peak left_reaction"], ["mass"], "is none of them"),
        (["theta"], ["mass"], "is unknown; there are peak theta"),
        (["number of impacts"], ["mass"], "stays or it jumps"),
        (["impact 0 time"], ["mass"], "there is no impact 0"),
        (["impact 4000 time"], ["mass"], "there is no impact 4000"),
        (["overturning time"], ["mass"], "no overturning time: within its duration"),
        (["theta at 9"], ["mass"], "from 0 to 4 s"),
        (["peak theta"], ["inertia"], "'inertia' is unknown"),
        (["peak theta"], ["restitution", "r"], "name one of both"),
        (["peak theta"], ["mass", "mass"], "each of them once"),
        ([], ["mass"], "one name or more"),
    ],
)
def test_what_has_no_derivative_is_told(of, to, said):
    with pytest.raises(ValueError, match=said):
        rk.sensitivity(CASE, of, to)


def test_arguments_of_another_kind_are_refused():
    with pytest.raises(TypeError, match="give a list of names"):
        rk.sensitivity(CASE, "peak theta", ["mass"])
    with pytest.raises(TypeError, match="give a case"):
        rk.sensitivity(BLOCK, ["peak theta"], ["mass"])
    with pytest.raises(TypeError, match="holds duals already"):
        rk.sensitivity(
            rk.Case(rk.RigidBlock(**rk.duals(half_width=0.2, half_height=0.8)), STILL),
            ["peak theta"],
            ["mass"],
        )


def test_the_amplitude_of_a_pulse_and_a_factor_of_it():
    """Each by itself and together: neither takes the other's derivative away."""
    case = rk.Case(BLOCK, rk.GroundMotion.single_sine(3.0, 0.8), duration=1.0)
    found = rk.sensitivity(case, ["end theta"], ["amplitude", "scale", "motion.scale"])
    by_amplitude, by_scale, by_its_own = found.derivatives[0]
    assert found.parameter_units == ("m/s2", "-", "-")
    assert by_amplitude * 3.0 == pytest.approx(by_scale, rel=1e-12)
    assert by_scale == by_its_own
