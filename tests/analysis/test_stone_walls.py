"""Walls tested by others: the numbers that ship, strengths, stiffnesses, envelopes, bad files."""

import csv
from importlib.resources import files

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas, identification
from tests.refusals import refused, refuses

TESTS = identification.wall_tests()
DRY = {name: test for name, test in TESTS.items() if test.dry}
MORTAR = {name: test for name, test in TESTS.items() if not test.dry}


@pytest.fixture(scope="module")
def walls():
    return rk.WallOnBed.of_tests(TESTS)


@pytest.fixture(scope="module")
def errors(walls):
    return {name: error_of(walls[name], test) for name, test in DRY.items()}


def error_of(wall: rk.WallOnBed, test: identification.WallTest) -> float:
    path = wall.pushover(float(np.abs(test.envelope.displacement).max()))
    return test.envelope_error(path.displacement, path.force)


# --- the data


def test_walls_that_ship_are_24_of_which_14_are_dry_and_have_envelopes():
    assert len(TESTS) == 24
    assert len(DRY) == 14
    assert {n for n, t in TESTS.items() if t.envelope is not None} == DRY.keys()
    assert sum(len(t.envelope.force) for t in DRY.values()) == 672
    assert all(t.reported_mode.startswith("R") for t in TESTS.values())
    levels = {t.axial_force for t in DRY.values()}
    assert levels == {44.8e3, 104.8e3, 179.8e3, 254.8e3}


def test_units_are_si():
    wall = TESTS["WS1.100"]
    assert (wall.height, wall.length, wall.thickness, wall.shear_span) == (1.2, 1.0, 0.2, 1.325)
    assert (wall.compressive_strength, wall.axial_force) == (73e6, 104.8e3)
    assert wall.strengths == (39e3, 43.3e3)
    assert wall.strength == pytest.approx(41.15e3)
    assert wall.stiffness == pytest.approx(12.0e6)
    assert wall.ultimate_displacement == pytest.approx(0.02885 * 1.325)
    single = TESTS["WS.100"]
    assert np.isnan(single.strengths[1])
    assert single.strength == 37e3


def test_effective_stiffness_is_about_the_secant_at_seven_tenths_of_the_strength():
    """As the computed one is defined; in the positive direction, of the measured envelopes."""
    ratios = []
    for test in DRY.values():
        u, f = (x[test.envelope.force > 0] for x in test.envelope)
        first = np.argmax(f >= 0.7 * f.max())
        ratios.append(f[first] / u[first] / test.stiffnesses[0])
    assert 0.65 < min(ratios) < max(ratios) < 1.12
    assert np.mean(ratios) == pytest.approx(0.90, abs=0.02)


@pytest.mark.parametrize("name", DRY)
def test_largest_force_of_an_envelope_is_the_strength(name):
    """Two columns of the source that were measured once, within the thinning of the envelope."""
    test = TESTS[name]
    up, down = test.envelope.force.max(), -test.envelope.force.min()
    assert up == pytest.approx(test.strengths[0], rel=0.04)
    if np.isfinite(test.strengths[1]):
        assert down == pytest.approx(test.strengths[1], rel=0.07)


def test_licence_ships_with_the_numbers():
    text = files("rockeom.analysis").joinpath("data/stone_walls_LICENSE.txt").read_text("utf-8")
    assert "Copyright (c) 2021 EESD Department" in text
    assert "The above copyright notice and this permission notice shall be included" in text
    assert "F. Vanin, D. Zaganelli, A. Penna, K. Beyer" in text


# --- computed and measured


def test_rigid_rocking_with_a_crushed_corner_has_the_strength_of_dry_walls():
    ratios = [t.strength / t.rocking_strength for t in DRY.values()]
    assert round(min(ratios), 2) >= 0.91
    assert round(max(ratios), 2) <= 1.05
    assert np.mean(ratios) == pytest.approx(0.98, abs=0.005)


def test_walls_with_mortar_are_stronger_than_rigid_rocking():
    ratios = [t.strength / t.rocking_strength for t in MORTAR.values()]
    assert round(min(ratios), 2) == 1.04
    assert round(max(ratios), 2) == 1.56


def test_first_wall_of_each_level_gives_the_modulus_of_the_others(walls):
    first = ("WS1.100", "WS1.175", "WS1.250", "WS.40", "test 1")
    for name in first:
        alike = [n for n, t in TESTS.items() if t.level == TESTS[name].level]
        assert alike[0] == name
        assert {walls[n].bed_modulus for n in alike} == {walls[name].bed_modulus}
        assert walls[name].effective_stiffness() == pytest.approx(TESTS[name].stiffness, rel=0.01)
    moduli = [walls[n].bed_modulus / 1e9 for n in first]  # N/m3
    np.testing.assert_allclose(moduli, [2.88, 4.00, 3.47, 1.42, 0.72], rtol=0.01)


def test_stiffness_of_the_other_dry_walls_is_right_by_a_factor_of_two(walls):
    given = {"WS1.100", "WS1.175", "WS1.250", "WS.40"}
    ratios = [
        t.stiffness / walls[n].effective_stiffness() for n, t in DRY.items() if n not in given
    ]
    assert len(ratios) == 10
    assert 0.5 < min(ratios) < 0.6
    assert 1.4 < max(ratios) < 1.5


def test_wall_in_double_bending_is_as_stiff_at_its_top(walls):
    test = TESTS["CS00"]
    assert test.rise == 2.0
    of_top = walls["CS00"].effective_stiffness() / test.rise
    assert of_top == pytest.approx(test.stiffness, rel=0.01)


def test_envelopes_are_met_within_a_tenth_of_the_strength(errors):
    assert max(errors.values()) == errors["WS2.100"] < 0.175
    assert sum(e < 0.13 for e in errors.values()) == 13
    assert np.sqrt(np.mean(np.square([*errors.values()]))) == pytest.approx(0.1024, abs=5e-4)


def test_beds_crush_under_four_walls_with_mortar_alone(walls):
    crushed = {
        name
        for name, test in TESTS.items()
        if walls[name].pushover(test.ultimate_displacement).plastic_work[-1] > 0
    }
    assert crushed == {"E8", "CS00", "PR5", "PR6"}


def test_envelopes_do_not_fall_as_under_a_load_that_stays_vertical(errors):
    """P-delta would take 8 % of the strength at the end; each wall is met worse with it."""
    vertical = rk.WallOnBed.of_tests(DRY, following=False)
    worse = {name: error_of(vertical[name], test) for name, test in DRY.items()}
    assert all(worse[name] > errors[name] for name in DRY)
    assert np.sqrt(np.mean(np.square([*worse.values()]))) == pytest.approx(0.1220, abs=5e-4)


def test_error_hardly_depends_on_the_wall_that_gives_the_bed_of_a_level():
    own = {name: rk.WallOnBed.of_test(test) for name, test in DRY.items()}
    least, most = [], []
    for test in DRY.values():
        alike = [n for n, t in DRY.items() if t.level == test.level]
        of_walls = [error_of(own[n], test) for n in alike]
        least.append(min(of_walls))
        most.append(max(of_walls))
    # no choice of one wall a level is better or worse than that of the best or the worst for each
    assert 0.08 < np.sqrt(np.mean(np.square(least))) < 0.092
    assert 0.115 < np.sqrt(np.mean(np.square(most))) < 0.13


def test_error_of_an_envelope_is_that_of_its_points():
    """A curve that is the envelope has none, and one that is zero has the mean square of it."""
    test = TESTS["WS.250"]  # of one direction
    u, f = test.envelope
    order = np.argsort(u)
    assert test.envelope_error(u[order], f[order]) == pytest.approx(0.0, abs=1e-2)
    nothing = test.envelope_error([0.0, 1.0], [0.0, 0.0])
    assert nothing == pytest.approx(np.sqrt(np.mean(f**2)) / test.strength)


# --- bad files


def copied(folder, name="stone_walls.csv", **cells):
    """A copy of the first two walls, or the first points, with cells of the second changed."""
    text = files("rockeom.analysis").joinpath(f"data/{name}").read_text("utf-8")
    rows = list(csv.reader(text.splitlines()))[:3]
    for column, cell in cells.items():
        if cell is None:
            at = rows[0].index(column)
            rows = [row[:at] + row[at + 1 :] for row in rows]
        else:
            rows[2][rows[0].index(column)] = cell
    path = folder / name
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    return path


@pytest.mark.parametrize(
    ("column", "cell", "message"),
    [
        ("length_mm", "1o00", "line 3: length_mm is '1o00': give a finite number"),
        ("fc_MPa", "", "line 3: fc_MPa is '': give a finite number"),
        ("V_max_pos_kN", "-3", r"stone_walls\.csv, line 3: V_max_pos_kN is '-3': give a"),
        ("V_max_pos_kN", "", "line 3: V_max_pos_kN is '': give a finite number"),
        ("K_eff_neg_kN_mm", "inf", "line 3: K_eff_neg_kN_mm is 'inf'"),
        ("wall", "WS1.100", r"stone_walls\.csv, line 3: wall is 'WS1\.100': it stands"),
        ("fc_MPa", None, "no column fc_MPa: there are wall, reference,"),
    ],
)
def test_bad_cell_is_named_by_file_line_and_column(tmp_path, column, cell, message):
    with pytest.raises(ValueError, match=message):
        identification.wall_tests(copied(tmp_path, **{column: cell}))


def test_comma_without_quotes_is_refused(tmp_path):
    path = copied(tmp_path)
    path.write_text(path.read_text("utf-8").replace('"R, TC"', "R, TC"), "utf-8")
    with pytest.raises(ValueError, match="line 3: it has more cells than there are columns"):
        identification.wall_tests(path)


def test_walls_of_a_file_may_lack_a_direction_and_envelopes(tmp_path):
    walls = identification.wall_tests(copied(tmp_path, V_max_neg_kN=""))
    assert [*walls] == ["WS1.100", "WS2.100"]
    assert walls["WS2.100"].strength == walls["WS2.100"].strengths[0]
    assert refused(walls["WS1.100"].envelope_error, [0.0, 1.0], [0.0, 1.0]) == ("wall", "WS1.100")


def test_bad_envelope_is_refused(tmp_path):
    walls = copied(tmp_path)
    name = "dry_wall_envelopes.csv"
    assert refused(identification.wall_tests, walls, copied(tmp_path, name)) == ("wall", "WS.100")
    assert refused(identification.wall_tests, envelopes=tmp_path / name)[0] == "walls"
    with refuses("displacement", 0.01):
        TESTS["WS.100"].envelope_error([0.0, 0.01], [0.0, 1.0])
    with refuses("displacement[1]", 0.05):
        TESTS["WS.100"].envelope_error([0.0, 0.1, 0.05], [0.0, 1.0, 1.0])


@pytest.mark.parametrize("stiffness", [1e16, 12.0])
def test_stiffness_that_no_bed_has_is_refused(stiffness):
    test = identification.WallTest(**vars(TESTS["WS1.100"]) | {"stiffnesses": (stiffness, np.nan)})
    with pytest.raises(ValueError, match=r"no bed of .* gives the stiffness .* give it in N/m"):
        rk.WallOnBed.of_test(test)


def test_strength_formula_broadcasts():
    forces = formulas.rocking_strength([100e3, 200e3], 1.0, 1.5, 0.2, 5e6)
    assert forces.shape == (2,)
    assert forces[0] == pytest.approx(100e3 / 3 * (1 - 0.5 / 4.25))
