"""Sweeps of a case by the names of its numbers: the bits of a function that makes each case."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from scipy import stats

import rockeom as rk
from rockeom import analysis
from rockeom.motion.formula import FORMULAS, formula_of
from rockeom.simulation.case import Problems
from rockeom.structures.classes import SHIPPED
from rockeom.sweeps.case_numbers import OtherCase, numbers_of
from rockeom.sweeps.cases import Cases, Source, sweep_of
from tests.shipped import plain
from tests.typical import S1

BLOCK = rk.RigidBlock(half_width=0.2, half_height=0.8)
SINE = rk.GroundMotion.single_sine(3.0, 0.8, duration=6.0)
RECORD = rk.GroundMotion.from_array(np.sin(0.3 * np.arange(200.0)), dt=0.02)
CASE = rk.Case(BLOCK, SINE)


def same_data(one, other):
    for name in one.data_vars:
        np.testing.assert_array_equal(one[name].values, other[name].values)
    return True


# -- the same as a function


OVER = {
    "half_width": np.linspace(0.1, 0.3, 5), "amplitude": np.linspace(2.0, 6.0, 7),
    "frequency": [0.7, 1.3], "restitution": [0.85, 0.95],
}  # fmt: skip


def function(half_width, amplitude, frequency, restitution):
    block = rk.RigidBlock(half_width=half_width, half_height=0.8)
    sine = rk.GroundMotion.single_sine(amplitude, 1 / frequency, duration=6.0)
    return rk.Case(block, sine, rk.VelocityRatio(restitution))


def test_widths_pulses_and_restitutions_have_the_bits_of_a_function():
    by_name = rk.simulate_many(CASE, OVER, impact_times=4)
    assert same_data(by_name, rk.simulate_many(function, OVER, impact_times=4))
    units = {name: by_name[name].attrs["units"] for name in OVER}
    assert units == {"half_width": "m", "amplitude": "m/s2", "frequency": "Hz", "restitution": "1"}
    assert by_name.restitution.attrs["long_name"] == "coefficient of restitution e"
    rows = [
        dict(zip(OVER, row, strict=True)) for row in ((0.1, 3.0, 1.0, 0.9), (0.2, 5.0, 0.5, 1.0))
    ]
    assert same_data(rk.simulate_many(CASE, rows), rk.simulate_many(function, rows))


def test_all_cases_are_made_at_once():
    other, cases = sweep_of(CASE, Cases.of(OVER))
    parts = list(Source(other, cases, None, BLOCK.module, True))
    assert sum(len(part.rows) for part in parts) == 140
    assert not any(part.cases for part in parts)


def bits(case):
    return Problems.of([case.problem()]).bits([0])


def test_a_record_is_scaled_and_the_vertical_one_with_it():
    case = rk.Case(BLOCK, RECORD, vertical=0.5 * RECORD)
    both = OtherCase(case, ("scale", "time_scale"))(scale=2.0, time_scale=0.5)
    assert bits(both) == bits(
        rk.Case(BLOCK, RECORD.scaled(2.0, 0.5), vertical=(0.5 * RECORD).scaled(2.0, 0.5))
    )
    one = OtherCase(case, ("vertical.scale",))(**{"vertical.scale": 2.0})
    assert bits(one) == bits(rk.Case(BLOCK, RECORD, vertical=(0.5 * RECORD).scaled(2.0)))
    found = rk.simulate_many(case, {"scale": [2.0, 5.0], "half_width": [0.1, 0.15]})
    assert same_data(
        found,
        rk.simulate_many(
            lambda scale, half_width: rk.Case(
                rk.RigidBlock(half_width=half_width, half_height=0.8), RECORD.scaled(scale),
                vertical=(0.5 * RECORD).scaled(scale),
            ),
            {"scale": [2.0, 5.0], "half_width": [0.1, 0.15]},
        ),
    )  # fmt: skip


def test_records_and_pairs_have_a_peak():
    """As `scaled_to` scales them, a vertical component along."""
    pairs = [rk.Recording(f"site {x}", (RECORD.scaled(x),), 0.5 * RECORD) for x in (1.0, 2.0)]
    for case, motions in ((CASE, [RECORD, *pairs]), (rk.Case(BLOCK, pairs[0]), pairs)):
        over = {"motion": motions, "pga": [4.0, 8.0]}
        found = rk.simulate_many(case, over)
        assert same_data(found, rk.simulate_many(
            lambda motion, pga: rk.Case(BLOCK, motion.scaled_to(pga=pga)), over
        ))  # fmt: skip
    assert found.pga.attrs["units"] == "m/s2"
    with pytest.raises(ValueError, match="pga and scale are one factor"):
        rk.simulate_many(CASE, {"pga": [4.0], "scale": [2.0]})


def test_start_duration_and_whole_parts():
    over = {"initial theta": [0.05, 0.1], "duration": [1.0, 2.0], "motion": [RECORD, SINE]}
    found = rk.simulate_many(CASE, over)
    assert same_data(found, rk.simulate_many(
        lambda theta, duration, motion: rk.Case(
            BLOCK, motion, initial={"theta": theta}, duration=duration
        ),
        dict(zip(("theta", "duration", "motion"), over.values(), strict=True)),
    ))  # fmt: skip
    assert found.motion.values.tolist() == ["array", SINE.name]
    assert found["initial theta"].attrs["units"] == "rad"


@pytest.mark.parametrize("model", SHIPPED)
def test_each_number_of_each_structure(model):
    """As its constructor has it, but for whole numbers that another module would follow from."""
    structure = rk.structure(model, **plain(model))
    case = rk.Case(structure, SINE)
    numbers = {n: x for n, x in numbers_of(case).items() if x.part == "structure"}
    assert {name.partition(".")[2].partition("[")[0] for name in numbers} >= {*plain(model)}
    names = [name for name, number in numbers.items() if number.smooth]
    for name in names:
        (_, argument) = name.split(".", 1)
        value = numbers[name].value
        x = 1.01 * value if value else 0.01
        other = OtherCase(case, (name,))(**{name: x})
        made = type(structure)(**{**vars_of(structure), argument: x})
        assert bits(other) == bits(rk.Case(made, SINE))


def vars_of(structure):
    return {name: getattr(structure, name) for name in type(structure).defaults()}


PULSES = {
    "none": (2.0,), "constant": (2.0, 0.5, 3.0), "half_sine": (2.0, 0.5), "single_sine": (2.0, 0.5),
    "single_cosine": (2.0, 0.5, 4.0), "ricker": (2.0, 0.5),
    "mavroeidis_papageorgiou": (0.3, 1.0, 2.0),
}  # fmt: skip


@pytest.mark.parametrize("name", FORMULAS)
def test_each_number_of_each_pulse(name):
    make = getattr(rk.GroundMotion, name)
    given = {"amplitude": 2.0, "duration": 3.0, "frequency": 1.5} if name == "harmonic" else {}
    motion = make(*PULSES.get(name, ()), **given)
    formula = formula_of(pickle.loads(pickle.dumps(motion)))
    for number, value in formula.numbers.items():
        x = 1.1 * value or 0.1
        made = formula.with_numbers({number: x})
        arguments = {**formula.arguments, number: x}
        if number == "frequency" and name != "harmonic":
            arguments = {**formula.arguments, "period": 1 / x}
        if number == "period" and name == "harmonic":
            arguments = {**formula.arguments, "frequency": 1 / x}
        assert made == make(**arguments)
        assert made != motion
    assert formula_of(2.0 * motion) is None  # whose amplitude is another
    assert formula_of(motion.padded_by(1.0)) is None


# -- whoever does the work


def test_an_executor_and_a_store_take_a_case(tmp_path):
    class Sending(ThreadPoolExecutor):
        def submit(self, function, *given):
            return super().submit(function, *pickle.loads(pickle.dumps(given)))

    over = {"amplitude": np.linspace(2.0, 6.0, 20), "structure.half_width": [0.1, 0.2]}
    whole = rk.simulate_many(CASE, over)
    how = {"store": tmp_path / "map.zarr", "chunk": 7}
    with Sending(1) as pool:
        sent = rk.simulate_many(CASE, over, sweep_options=rk.SweepOptions(executor=pool, **how))
    assert whole.identical(sent)
    assert whole.identical(rk.simulate_many(CASE, over, sweep_options=rk.SweepOptions(**how)))
    with pytest.raises(ValueError, match="holds another sweep"):
        rk.simulate_many(
            rk.Case(BLOCK, 1.1 * SINE), {"scale": over["amplitude"]},
            sweep_options=rk.SweepOptions(**how),
        )  # fmt: skip


# -- names that cannot be


ON_BASE = rk.Case(
    rk.LumpedMassStructure(**S1), SINE,
    impact=rk.EnergyRatioAtSpeed(((0.3, 0.8, 0.1), (np.inf, 0.7, 0.0)), height=0.4),
    vertical=rk.GroundMotion.single_sine(1.0, 0.3),
)  # fmt: skip

MISTAKES = {
    "half_widht": (CASE, r"did you mean half_width\?.*half_width \[m\], .*amplitude \[m/s2\]"),
    "alpha": (CASE, "follows from others: name those, or let a function make the case of it"),
    "theta": (CASE, r"did you mean 'initial theta'\?"),
    "r": (CASE, r"'restitution', which is the ratio e .* impact=rk.EnergyRatio\(r=0\.8\)"),
    "amplitude": (
        rk.Case(BLOCK, RECORD),
        "pulses have it, .*pga is the peak, scale and time_scale are factors",
    ),
    "period": (ON_BASE, r"several parts of the case: name 'motion\.period' or 'vertical\.period'"),
    "height": (ON_BASE, r"name 'structure\.height' or 'impact\.height'"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_name_that_no_number_has_alone(name):
    case, words = MISTAKES[name]
    with pytest.raises(ValueError, match=f"^over: '{name}' is .*{words}"):
        rk.simulate_many(case, {name: [1.0, 2.0]})


def test_one_number_under_two_names():
    with pytest.raises(ValueError, match="'half_width' is named twice"):
        rk.simulate_many(CASE, {"half_width": [0.1], "structure.half_width": [0.2]})
    with pytest.raises(ValueError, match="period and frequency are one number"):
        rk.simulate_many(CASE, {"period": [0.5], "frequency": [2.0]})
    law = rk.Case(BLOCK, SINE, impact=rk.EnergyRatio(0.8))
    with pytest.raises(ValueError, match="name one of both"):
        rk.simulate_many(law, {"restitution": [0.9], "r": [0.8]})


def test_a_case_that_cannot_be_is_named_by_its_values():
    with pytest.raises(ValueError, match=r"^case half_width = -0\.1 m, amplitude = 3 m/s2: Rigid"):
        rk.simulate_many(CASE, {"half_width": [0.1, -0.1], "amplitude": [3.0, 4.0]})


def test_a_structure_without_impacts_has_no_restitution():
    sprung = rk.TwoSpringStructure(**S1, foundation_stiffness=5e5, foundation_damping=1e3)
    with pytest.raises(ValueError, match="'restitution' is unknown"):
        rk.simulate_many(rk.Case(sprung, SINE), {"restitution": [0.9]})


# -- analyses that make sweeps


def test_boundaries_and_probabilities_of_a_case_are_those_of_a_function():
    def pushed(amplitude):
        return rk.Case(BLOCK, rk.GroundMotion.single_sine(amplitude, 0.8, duration=6.0))

    over = {"amplitude": np.linspace(2.0, 9.0, 30)}
    borders = [
        analysis.overturning_boundaries(case, rk.simulate_many(case, over), accuracy=1e-3)
        for case in (CASE, pushed)
    ]
    assert borders[0].sizes["boundary"] > 0
    assert same_data(*borders)
    random = {"amplitude": stats.norm(5.0, 1.5)}
    by_name, by_function = (analysis.risk.monte_carlo(case, random, 50) for case in (CASE, pushed))
    assert 0.0 < by_name.probability == by_function.probability < 1.0
    by_name, by_function = (analysis.risk.reliability_of(case, random) for case in (CASE, pushed))
    assert by_name.index == by_function.index


def test_a_case_that_fails_when_it_is_run_is_named_by_its_values():
    with pytest.raises(KeyError) as caught:
        rk.simulate_many(
            CASE, {"half_width": [0.1, 0.2]}, quantities=["drift"],
            sweep_options=rk.SweepOptions(threads=1),
        )  # fmt: skip
    assert "in the case half_width = 0.1 m" in caught.value.__notes__
