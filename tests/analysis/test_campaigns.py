"""Campaigns of tests: their tables, and the same tests simulated."""

import numpy as np
import pytest
from scipy import stats

import rockeom as rk
from rockeom import InputError
from rockeom.analysis.validation import Campaign, Ensemble, predictive_test, simulate_campaign
from rockeom.motion import JenningsEnvelope, MotionSet
from rockeom.motion.readers import read_channels, read_table
from tests.refusals import refused, refuses

HEADING = "test, record, peak (deg), outcome, scale (-), half_width (mm), remark"
ROWS = (
    'T1, weak, 2.0, stood, 1.0, 100, "first, of all"',
    "T2, strong, , overturned, 1.5, 95, ",
    "T3, weak, 3.5, came to rest, 1.2, 100, none",
)
KNOWN = ("scale", "half_width")


def noise(name: str, seed: int) -> rk.GroundMotion:
    motion = rk.GroundMotion.kanai_tajimi(0.008, duration=5.0, seed=seed)
    return rk.GroundMotion.from_array(motion.acceleration(np.arange(500) * 0.01), 0.01, name=name)


@pytest.fixture(scope="module")
def motions() -> MotionSet:
    return MotionSet([noise("weak", 1), noise("strong", 2)])


@pytest.fixture
def table(tmp_path):
    def written(heading: str = HEADING, rows=ROWS):
        path = tmp_path / "campaign.csv"
        path.write_text("\n".join(("# tests of a block", heading, *rows)), encoding="utf-8")
        return path

    return written


# --- tables


def test_a_table_is_a_campaign_in_si_units(table, motions):
    read = Campaign.from_csv(table(), motions, parameters=KNOWN)
    assert read.tests == ("T1", "T2", "T3")
    assert read.records == ("weak", "strong", "weak")
    assert read.motions.names == ("weak", "strong")
    assert read.measured.overturned.tolist() == [False, True, False]
    assert read.measured.peaks.tolist() == [np.radians(2.0), np.inf, np.radians(3.5)]
    assert read.parameters["scale"].tolist() == [1.0, 1.5, 1.2]
    assert read.parameters["half_width"].tolist() == pytest.approx([0.1, 0.095, 0.1])
    assert repr(read) == "Campaign('campaign': 3 tests of 2 motions, 1 overturned)"


def test_separators_order_and_units_of_a_table_may_be_others(table, motions):
    rows = ("stood;2.0;weak;T1", "OVERTURNED;;strong;T2")
    path = table("outcome;peak;record;test", rows)
    read = Campaign.from_csv(path, motions, units={"peak": "deg"})
    assert read.measured.peaks.tolist() == [np.radians(2.0), np.inf]
    assert read.parameters == {}
    rows = ("T1;weak;stood;2.0", "T2;strong;overturned;")  # a last cell that is empty
    read = Campaign.from_csv(table("test;record;outcome;peak (mrad)", rows), motions)
    assert read.measured.peaks.tolist() == [0.002, np.inf]


def test_records_are_files_beside_the_table_each_read_once(table, tmp_path, motions):
    for motion in motions:
        at = np.arange(500) * 0.01
        a = motion.acceleration(at) / 9.81
        lines = (f"{t:.2f}, {x:.9f}" for t, x in zip(at, a, strict=True))
        (tmp_path / f"{motion.name}.csv").write_text("\n".join(("t (s), a (g)", *lines)))
    rows = [row.replace("weak", "weak.csv").replace("strong", "strong.csv") for row in ROWS]
    read = Campaign.from_csv(table(rows=rows), parameters=KNOWN, gravity=9.81)
    assert read.motions.names == ("weak.csv", "strong.csv")
    assert read.motions[0].peak == pytest.approx(motions[0].peak, rel=1e-6)
    there = Campaign.from_csv(table(rows=rows), tmp_path, parameters=KNOWN, gravity=9.81)
    assert there.motions == read.motions
    (tmp_path / "weak.csv").unlink()
    with pytest.raises(InputError, match=r"csv, line 3: record is 'weak.csv': .*no such file"):
        Campaign.from_csv(table(rows=rows), parameters=KNOWN)


@pytest.mark.parametrize("name", ["{0}/secret.csv", "../secret.csv", "link.csv", "below/link.csv"])
def test_a_table_reads_no_files_outside_its_folder(table, tmp_path, name):
    heading, folder = "test, record, peak (rad), outcome", tmp_path / "tests"
    (folder / "below").mkdir(parents=True)
    for file in (tmp_path / "secret.csv", folder / "below" / "beside.csv"):
        file.write_text("t (s), a (g)\n0, 0\n0.01, 0.1\n0.02, 0.2")
    for link in (folder / "link.csv", folder / "below" / "link.csv"):
        link.symlink_to(tmp_path / "secret.csv")
    for inside in ("below/beside.csv", "below/../below/beside.csv"):
        path = table(heading, [f"T1, {inside}, 0.1, stood"])
        assert Campaign.from_csv(path, folder, gravity=9.81).motions.names == (inside,)
    path = table(heading, [f"T1, {name.format(tmp_path)}, 0.1, stood"])
    with pytest.raises(InputError, match=r"line 3: record is '.*', which is no file within"):
        Campaign.from_csv(path, folder, gravity=9.81)


def test_a_megabyte_of_headings_is_read_in_proportion_to_its_length(tmp_path):
    """Minutes, if each name were looked for among all others."""
    n = 80_000
    heads, ones = ", ".join(f"h{i} (m)" for i in range(n)), ", ".join(["1"] * n)
    wide = tmp_path / "wide.csv"
    wide.write_text(f"time (s), {heads}\n0, {ones}\n0.1, {ones}\n0.2, {ones}\n")
    table = read_table(wide)
    assert table.number(2, f"h{n - 1}") == 1.0
    channels = read_channels(wide, {}, None, "time", 9.81)
    assert len(channels.values) == n


def changed(row: int, old: str, new: str) -> list[str]:
    rows = list(ROWS)
    assert old in rows[row]
    rows[row] = rows[row].replace(old, new)
    return rows


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (changed(0, "2.0", ""), r"line 3: the peak of test 'T1', which stood, is missing. Remedy"),
        (changed(0, "2.0", "-2.0"), r"line 3: peak is -2: give the size|line 3: peak is -2. Rem"),
        (changed(0, "2.0", "nan"), r"line 3: peak of row 1 is nan, not a finite number"),
        (changed(1, ", ,", ", 9O,"), r"line 4: peak of row 2 is '9O', which is no number"),
        (changed(2, "came to rest", "OK"), r"line 5: outcome is 'OK'. Remedy: write overturned or"),
        (changed(1, "overturned", "overturnd"), r"line 4: outcome is 'overturnd' \(did you mean"),
        (changed(2, "T3", "T1"), r"line 5: test is 'T1', as in line 3"),
        (changed(2, "T3", ""), r"line 5: test is ''"),
        (changed(2, "weak", "week"), r"line 5: record is 'week' \(did you mean weak\?\)"),
        (changed(2, "1.2", "x"), r"line 5: scale of row 3 is 'x', which is no number"),
        (changed(2, "1.2,", ""), r"line 5: half_width of row 3 is 'none', which is no number"),
        (changed(2, "1.2, 100,", ""), r"line 5: 5 cells, where the heading has 7"),
    ],
)
def test_a_wrong_cell_is_named_with_its_line_and_a_remedy(table, motions, rows, words):
    path = table(rows=rows)
    with pytest.raises(InputError, match=words) as raised:
        Campaign.from_csv(path, motions, parameters=KNOWN)
    assert str(path) in str(raised.value)
    assert "Remedy: " in str(raised.value)


@pytest.mark.parametrize(
    ("heading", "how", "words"),
    [
        (HEADING.replace("outcome", "outcomes"), {}, r"no column is called 'outcome' \(did you m"),
        (HEADING.replace(" (deg)", ""), {}, r"nothing says the unit of 'peak'"),
        (HEADING.replace("deg", "furlong"), {}, r"the unit of 'peak' is 'furlong'"),
        (HEADING.replace("remark", "test"), {}, r"2 column\(s\) are called 'test'"),
        (HEADING, {"parameters": ["scales"]}, r"no column is called 'scales' \(did you mean scale"),
        (HEADING, {"units": {"outcome": "m"}}, r"units has 'outcome'"),
        (HEADING, {"units": {"peak": "rad"}}, r"the heading states 'peak' in 'deg', the caller"),
        (HEADING, {"parameters": None}, r"nothing says the unit of 'remark'"),
    ],
)
def test_a_wrong_heading_is_named_with_a_remedy(table, motions, heading, how, words):
    with pytest.raises(InputError, match=rf"line 2: .*{words}|line 2: {words}"):
        Campaign.from_csv(table(heading), motions, **{"parameters": KNOWN} | how)


def test_a_campaign_of_arrays_is_checked(motions):
    measured = Ensemble([0.1, 0.2])
    assert refused(Campaign, ("T1",), ("weak",), motions, measured)[0] == "measured"
    assert refused(Campaign, ("T1", "T1"), ("weak", "weak"), motions, measured) == ("tests", "T1")
    assert refused(Campaign, ("T1", "T2"), ("weak", "wek"), motions, measured) == ("motions", "wek")
    with refuses("scale"):
        Campaign(("T1", "T2"), ("weak", "weak"), motions, measured, {"scale": [1.0]})


# --- simulated


BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)


@pytest.fixture(scope="module")
def campaign(motions) -> Campaign:
    records = ("weak", "strong", "weak", "weak")
    scale = {"scale": [1.0, 3.0, 1.3, 1.3]}
    return Campaign(("T1", "T2", "T3", "T4"), records, motions, Ensemble(np.zeros(4)), scale)


def test_simulated_tests_are_those_of_single_motions(campaign):
    case = rk.Case(BLOCK, campaign.motions[0], rk.EnergyRatio(0.85))
    found = simulate_campaign(campaign, case, number=2)
    assert found.peaks.shape == (4, 2)
    for i, (record, scale) in enumerate(zip(campaign.records, (1.0, 3.0, 1.3, 1.3), strict=True)):
        motion = campaign.motions[record].scaled(scale)
        run = rk.simulate(BLOCK, motion, impact=rk.EnergyRatio(0.85))
        fell = run.outcome == rk.Outcome.OVERTURNED
        assert found.overturned[i].tolist() == [fell, fell]
        expected = np.inf if fell else abs(run.extremes("theta").peak)
        assert found.peaks[i].tolist() == pytest.approx([expected, expected], rel=1e-6)


def test_a_function_makes_the_cases_and_other_quantities_count(campaign):
    def case(motion, scale, r):
        return rk.Case(BLOCK, motion.scaled(scale), rk.EnergyRatio(r))

    random = {"r": stats.uniform(0.8, 0.1)}
    rotation = simulate_campaign(campaign, case, random, 3)
    uplift = simulate_campaign(campaign, case, random, 3, quantity="left_uplift")
    assert (uplift.overturned == rotation.overturned).all()
    stood = ~rotation.overturned
    assert (uplift.peaks[stood] <= 0.2 * np.sin(rotation.peaks[stood]) + 1e-9).all()


def test_shared_parameters_are_those_of_the_specimen(campaign):
    """Tests 3 and 4 are alike: their peaks are, too, where no parameter differs between them."""
    case = rk.Case(BLOCK, campaign.motions[0], rk.EnergyRatio(0.85))
    random = {"half_width": stats.norm(0.1, 0.003)}
    shared = simulate_campaign(campaign, case, random, 8, shared=["half_width"])
    np.testing.assert_array_equal(shared.peaks[2], shared.peaks[3])
    assert len(np.unique(shared.peaks[2])) == 8
    own = simulate_campaign(campaign, case, random, 8)
    assert (own.peaks[2] != own.peaks[3]).all()
    again = simulate_campaign(campaign, case, random, 8)
    np.testing.assert_array_equal(own.peaks, again.peaks)
    assert (simulate_campaign(campaign, case, random, 8, seed=1).peaks != own.peaks).any()


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({"random": {"scale": stats.norm(1.0, 0.1)}}, "random"),
        ({"random": {"half_width": 0.1}}, "random"),
        ({"shared": ["half_width"]}, "shared"),
        ({"number": 0}, "number"),
        ({"random": {"halfwidth": stats.norm(0.1, 0.1)}}, "over"),
    ],
)
def test_wrong_names_and_distributions_are_refused(campaign, how, words):
    case = rk.Case(BLOCK, campaign.motions[0], rk.EnergyRatio(0.85))
    assert refused(simulate_campaign, campaign, case, **how)[0] == words


def test_a_narrow_base_and_a_low_restitution_are_seen_though_they_offset_each_other():
    """Most of ten campaigns reject the nominal model, and few the right one."""
    envelope = JenningsEnvelope(rise=2.0, until=6.0, decay=0.5)
    shaken = MotionSet(
        rk.GroundMotion.kanai_tajimi(0.016, duration=10.0, seed=i, envelope=envelope, dt=0.02)
        for i in range(50)
    )
    n = len(shaken)
    blank = Campaign([f"T{i}" for i in range(n)], shaken.names, shaken, Ensemble(np.zeros(n)))
    case = rk.Case(BLOCK, shaken[0], rk.EnergyRatio(0.85))
    nominal = {"half_width": stats.norm(0.1, 0.001), "r": stats.uniform(0.8, 0.1)}
    right = {"half_width": stats.norm(0.09, 0.001), "r": stats.norm(0.72, 0.02)}
    how = {"shared": ["half_width"]}
    tested = simulate_campaign(blank, case, right, 10, seed=1, **how)
    rejected = []
    for random in (nominal, right):
        model = simulate_campaign(blank, case, random, 99, seed=2, **how).resolved(0.003)
        measured = [
            Ensemble(tested.peaks[:, j], tested.overturned[:, j]).resolved(0.003) for j in range(10)
        ]
        found = [predictive_test(one, model, limit=np.arctan(0.25)) for one in measured]
        rejected.append(sum(one.p_value <= 0.05 for one in found))
    assert rejected[0] >= 7
    assert rejected[1] <= 3
