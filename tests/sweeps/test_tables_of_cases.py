"""Tables of cases, and what a dataset says of itself: names, units, flags."""

import io
import math

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.stats import qmc

import rockeom as rk
from rockeom.sweeps.cases import Cases, Source
from rockeom.sweeps.dataset import Labels, dataset
from rockeom.sweeps.results import Results
from rockeom.sweeps.task import Task
from tests.sweeping import one_by_one

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
N = 40
DRAWN = qmc.scale(qmc.LatinHypercube(d=2, rng=1).random(N), [0.5, 1.0], [4.0, 8.0])
FRAME = pd.DataFrame(DRAWN, columns=["frequency", "amplitude"])
UNITS = {"frequency": "Hz", "amplitude": "m/s2"}


def pulse(frequency, amplitude):
    return rk.Case(BLOCK, rk.GroundMotion.half_sine(amplitude, 1 / frequency, duration=4.0))


def record(n, factor=1.0, name="record"):
    values = factor * np.sin((0.3 + 0.1 * n) * np.arange(60.0))
    return rk.GroundMotion.from_array(values, dt=0.02, name=name)


TABLES = {
    "DataFrame": FRAME,
    "of an index": FRAME.set_index(np.arange(N) * 10),
    "structured": FRAME.to_records(index=False),
    "rows": FRAME.to_dict("records"),
    "dataset": xr.Dataset({n: ("draw", FRAME[n], {"units": UNITS[n]}) for n in FRAME}),
}


@pytest.mark.parametrize("kind", TABLES)
def test_a_row_of_a_table_is_a_case(kind):
    """The bits of the case by itself, with its values as coordinates over `case`."""
    found = rk.simulate_many(pulse, TABLES[kind], impact_times=2)
    assert found.outcome.dims == ("case",)
    assert found.final.dims == ("case", "state")
    np.testing.assert_array_equal(found.case, np.arange(N))
    for name in FRAME:
        assert found[name].dims == ("case",)
        np.testing.assert_array_equal(found[name], FRAME[name])
        assert found[name].attrs.get("units") == (UNITS[name] if kind == "dataset" else None)
    assert len({*found.outcome.values.tolist()}) > 1
    if kind != "DataFrame":
        return
    for i in (0, 17, N - 1):
        alone = rk.simulate_many(pulse, {n: [FRAME[n][i]] for n in FRAME}, impact_times=2)
        assert found.final.values[i].tolist() == alone.final.values[0, 0].tolist()
        assert found.outcome.values[i] == alone.outcome.item()
        assert found.peak.isel(case=i).sel(state="theta") == alone.peak.sel(state="theta").item()


def test_a_table_of_words_records_and_structures_is_made_at_once_where_they_agree():
    blocks = [BLOCK, rk.RigidBlock(half_width=0.1, half_height=0.5)]
    records, random = [record(n) for n in range(3)], np.random.default_rng(3)
    rows = [
        {"motion": records[i % 3], "block": blocks[i % 2], "factor": x, "law": "hard" if i % 5
         else "soft"}
        for i, x in enumerate(random.uniform(1.0, 9.0, 120))
    ]  # fmt: skip
    calls = []

    def case(motion, block, factor, law):
        calls.append(1)
        ratio = {"hard": 0.9, "soft": 0.7}[law]
        return rk.Case(block, motion, rk.EnergyRatio(ratio), {"theta": 0.01 * factor})

    alone = rk.simulate_many(one_by_one(case), rows)
    calls.clear()
    at_once = rk.simulate_many(case, rows, sweep_options=rk.SweepOptions(threads=1))
    assert at_once.identical(alone)
    assert len(calls) < 60
    parts = [*Source(case, Cases.of(rows), None, BLOCK.module, True)]
    together = [part for part in parts if not part.cases]
    assert all(len(part.problems.horizontal) == len(records[0].segments) for part in together)
    assert sum(len(part.rows) for part in together) == 96  # and of others there are too few
    assert at_once.motion.values[:4].tolist() == [
        "record (1)", "record (2)", "record (3)", "record (1)",
    ]  # fmt: skip
    assert at_once.block.values[:3].tolist() == [
        "rigid_block (1)", "rigid_block (2)", "rigid_block (1)",
    ]  # fmt: skip
    assert at_once.law.values[:2].tolist() == ["soft", "hard"]


def test_a_part_of_the_cases_is_the_same_cases():
    """What is sent to a worker: values of the same types, and no more than are needed."""
    over = {
        "x": np.linspace(0.0, 1.0, 5), "n": [1, 2], "y": [0.5, 1.5],
        "motion": [record(n) for n in range(4)],
    }  # fmt: skip
    table = Cases.of([{"x": 0.1, "motion": over["motion"][i % 2]} for i in range(80)])
    for cases in (Cases.of(over), table):
        rows = np.array([3, 17, 18, 60, 77])
        part = cases.part(rows)
        assert part.total == 5
        for i, row in enumerate(rows.tolist()):
            there, here = part.named(i), cases.named(row)
            assert there == here
            assert [type(v) for v in there.values()] == [type(v) for v in here.values()]
    assert len(table.part(np.array([0, 2, 4])).values["motion"]) == 1


@pytest.mark.parametrize(
    ("over", "error", "words"),
    [
        (FRAME.rename(columns={"amplitude": "case"}), ValueError, "column case.*rows"),
        (FRAME.set_axis(["a", "a"], axis=1), ValueError, "several columns a"),
        (FRAME.set_axis([1, 2], axis=1), TypeError, "name 1.*argument"),
        (FRAME[:0], ValueError, "`over` is empty"),
        ([], ValueError, "`over` is empty"),
        ([{"a": 1.0}, {"b": 1.0}], ValueError, r"over\[1\] has b.*over\[0\] has a"),
        ([{"a": 1.0}, {}], ValueError, r"over\[1\] has no names"),
        ([{"a": 1.0}, 2.0], TypeError, "over is a list"),
        (np.zeros((2, 2)), TypeError, r"shape \(2, 2\).*DataFrame"),
        (xr.Dataset({"a": (("x", "y"), np.zeros((2, 2)))}), ValueError, "over x, y.*one dimension"),
        (xr.Dataset({"a": ("x", [1.0]), "b": 2.0}), ValueError, "one dimension"),
        ({"peak": [1.0]}, ValueError, "the name 'peak'.*another name"),
        ({"state": [1.0]}, ValueError, "the name 'state'"),
        ({"impact": [1.0]}, ValueError, "the name 'impact'"),
    ],
)
def test_what_is_neither_table_nor_grid_is_told(over, error, words):
    with pytest.raises(error, match=words):
        rk.simulate_many(lambda **_: rk.Case(BLOCK, record(1)), over, impact_times=1)


# -- names, units and flags


def test_things_go_by_their_names_which_are_told_apart():
    motions = [record(0, name="Tabas"), record(1, name="Kobe"), record(2, name="Kobe"),
               record(3, name="Kobe (1)")]  # fmt: skip
    laws = [rk.EnergyRatio(0.9), rk.EnergyRatio(0.8)]
    found = rk.simulate_many(
        lambda motion, law, block: rk.Case(block, motion, law),
        {"motion": motions, "law": laws, "block": [BLOCK]},
    )
    assert found.motion.values.tolist() == ["Tabas", "Kobe (2)", "Kobe (3)", "Kobe (1)"]
    assert found.law.values.tolist() == [0, 1]
    assert found.block.values.tolist() == ["rigid_block"]
    assert found.peak.sel(motion="Tabas", law=0).shape == (1, 2)
    nameless = rk.simulate_many(
        lambda motion: rk.Case(BLOCK, motion), {"motion": [record(0, name=""), motions[0]]}
    )
    assert nameless.motion.values.tolist() == [0, 1]


def given_units(found):
    return {name: found[name].attrs.get("units") for name in found.variables}


def test_every_variable_says_what_it_is_and_in_which_unit():
    frequency = xr.DataArray([1.0, 2.0], dims="f", attrs={"units": "Hz", "long_name": "frequency"})
    found = rk.simulate_many(
        pulse,
        {"frequency": frequency, "amplitude": [3.0, 6.0]},
        impact_times=2,
        quantities=["displacement", "left_uplift"],
        times=[0.5],
    )
    assert all(found[name].attrs["long_name"] for name in found.variables)
    units = given_units(found)
    assert units["frequency"] == "Hz"
    assert {units[n] for n in ("final_time", "impact_time", "time")} == {"s"}
    assert {units[n] for n in ("impacts", "refined")} == {"1"}
    assert {units[n] for n in ("peak_quantity", "minimum_quantity", "history")} == {"m"}
    assert found.state_unit.values.tolist() == ["rad", "rad/s"]
    assert found.peak.sel(state="theta").state_unit.item() == "rad"
    assert found.quantity_unit.values.tolist() == ["m", "m"]
    # what has no one unit says those of each
    without = {n for n, unit in units.items() if unit is None}
    labels = {"outcome", "outcome_flag", "final_mode", "state", "quantity"}
    assert without - labels == {
        "amplitude", "peak", "maximum", "minimum", "final", "state_unit", "quantity_unit",
    }  # fmt: skip


def test_a_structure_without_dimensions_has_none():
    module, asked = rk.NondimensionalBlock(alpha=0.2).module, ["displacement", "total_energy"]
    task = Task(rk.Case, rk.SolverOptions(), False, 1, False, asked, [0.5], "")
    labels = Labels.of(task, Cases.of({"a": [1.0]}), module, {})
    found = dataset(Results.of(task, 1, 2), labels, interrupted=False)
    units = given_units(found)
    names = ("final_time", "impact_time", "peak", "final", "history", "time")
    assert {units[n] for n in names} == {"1"}
    assert {*found.state_unit.values.tolist(), *found.quantity_unit.values.tolist()} == {"1"}


def test_outcomes_are_flags_that_plot_and_labels_that_compare():
    over = {"frequency": np.linspace(0.5, 4.0, 12), "amplitude": np.linspace(1.0, 8.0, 10)}
    found = rk.simulate_many(pulse, over)
    flag = found.outcome_flag
    words = flag.attrs["flag_meanings"].split()
    assert flag.attrs["flag_values"].tolist() == [*range(len(rk.Outcome) + 1)]
    assert flag.dtype == flag.attrs["flag_values"].dtype  # as the CF conventions ask
    assert words == ["not_run", *(str(outcome).replace(" ", "_") for outcome in rk.Outcome)]
    by_flags = np.array(words)[flag.values]
    np.testing.assert_array_equal(np.char.replace(by_flags, "_", " "), found.outcome)
    fell = found.outcome == "overturned"
    assert 0 < int(fell.sum()) < fell.size
    with mpl.rc_context({"backend": "Agg"}):
        from matplotlib import pyplot as plt

        drawn = flag.plot()
        np.testing.assert_array_equal(np.ma.getdata(drawn.get_array()).ravel(), flag.values.ravel())
        assert drawn.colorbar.ax.get_ylabel() == "outcome"
        plt.close("all")


def test_a_dataset_goes_to_a_file_and_back():
    found = rk.simulate_many(pulse, FRAME, impact_times=1)
    read = xr.load_dataset(io.BytesIO(found.to_netcdf(engine="scipy")))
    for name in found.variables:
        np.testing.assert_array_equal(read[name].values, found[name].values)
    assert read.outcome_flag.attrs["flag_meanings"] == found.outcome_flag.attrs["flag_meanings"]
    assert math.isnan(read.impact_time.values[0, 0]) or read.impact_time.values[0, 0] > 0
