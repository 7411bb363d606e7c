"""`rockeom report`: one page on a structure under a set of records."""

import re
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

import rockeom as rk
from rockeom.cli import main
from rockeom.plots import design_report
from tests.typical import S1, column

SET = [f"{name}={value}" for name, value in column().parameters().items()]


def record(number: int) -> rk.GroundMotion:
    t = 0.005 * np.arange(160)
    a = (3.0 + number) * np.sin((30.0 + 9.0 * number) * t) * np.exp(-3.0 * t)
    return rk.GroundMotion.from_array(a, 0.005, name=f"record {number}")


@pytest.fixture(scope="module")
def page():
    return design_report(column(), [record(n) for n in range(3)], rk.EnergyRatio(0.74))


def test_page_lists_the_demands_of_each_record_the_largest_first(page):
    assert len(page.rows) == 3
    displacements = [float(row[2]) for row in page.rows]
    assert displacements == sorted(displacements, reverse=True)
    name, peak, *cells = page.rows[0]
    one = record(int(name.removeprefix("record ")))
    rocking = rk.simulate(column(), one, impact=rk.EnergyRatio(0.74))
    fixed = rk.simulate(column().fixed_base(), one)
    assert float(peak) == pytest.approx(one.peak / 9.81, rel=5e-3)
    shears = [abs(run.extremes("horizontal_reaction").peak) for run in (rocking, fixed)]
    expected = [
        1e3 * abs(rocking.extremes("displacement").peak),
        1e3 * abs(fixed.extremes("displacement").peak),
        1e3 * max(rocking.extremes(f"{foot}_uplift").maximum for foot in ("left", "right")),
        abs(rocking.extremes("theta").peak) / column().overturning_angles[0],
        1e-3 * shears[0],
        shears[0] / shears[1],
        abs(rocking.support.base_moment.peak) / abs(fixed.support.base_moment.peak),
        rocking.support.friction_demand,
    ]
    assert [float(cell) for cell in cells] == pytest.approx(expected, rel=0.02, abs=0.006)


def test_page_says_what_was_assumed_and_how_far_it_held(page):
    facts = dict(page.facts)
    assert facts["fixed-base period"] == "0.092 s"
    assert facts["law of impact"] == "EnergyRatio(r=0.74)"
    said = " ".join(page.assumptions)
    worst = max(one.run.support.friction_demand for one in page.results)
    assert f"friction coefficient of {worst:.2f} under the worst record" in said
    (error,) = re.findall(r"energy balances close to (\S+) or better", said)
    assert float(error) < 1e-6
    assert "under 3 of 3 records a foot lifted" in said


def test_page_has_whole_names_plain_numbers_and_no_text_over_another():
    heavy = rk.FlexibleStructure(**column().parameters() | {"mass": 1e6, "stiffness": 2e9})
    long = "Superstition Hills, 1987, El Centro Imp. Co. Cent, B-ICC000"
    result = design_report(heavy, [replace(record(n), name=long[: 59 - n]) for n in range(2)])
    assert {row[0] for row in result.rows} == {long, long[:58]}
    said = [*result.findings, *result.assumptions[:-1], *dict(result.facts).values()]
    assert not re.findall(r"\de\+\d", " ".join([*said, *sum(result.rows, ())]))
    assert dict(result.facts)["stiffness"] == "2000000000 N/m"
    page = result.page()
    page.draw_without_rendering()
    history = page.axes[0]
    boxes = [text.get_window_extent() for text in page.texts if text.get_text()]
    boxes += [history._left_title.get_window_extent(), history.get_legend().get_window_extent()]
    assert not any(a.shrunk(0.9, 0.9).overlaps(b) for a, b in combinations(boxes, 2))


@pytest.mark.filterwarnings("error")
def test_both_files_hold_the_same_and_the_pdf_has_one_page(page, tmp_path):
    for name in ("page.html", "page.pdf"):
        page.write(tmp_path / name)
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "data:image/svg+xml;base64," in text
    assert "http://" not in text.replace("http://www.w3.org", "")  # needs no other file
    for cell in (*page.rows[0], *page.findings, *page.assumptions):
        assert cell in text
    texts = page.page().texts
    drawn = {item.get_text() for item in texts}
    assert {cell for row in page.rows for cell in row} <= drawn
    joined = " ".join(" ".join(drawn).split())
    for sentence in page.assumptions:
        assert sentence in joined
    assert min(item.get_position()[1] for item in texts) > 0.03  # on the paper
    pdf = (tmp_path / "page.pdf").read_bytes()
    assert len(re.findall(rb"/Type /Page\b", pdf)) == 1


def test_fallen_structure_stands_first_and_counts():
    tall = rk.LumpedMassStructure(**S1 | {"half_width": 0.05})
    found = design_report(tall, [record(0).scaled(20.0), record(0).scaled(0.01)])
    assert found.rows[0][2] == "overturned"
    assert "Under 1 of 2: overturned." in found.findings
    assert found.rows[1][3] == "–"  # a rigid structure has no fixed base
    assert "fixed-base period" not in dict(found.facts)
    found.page()


def test_command_writes_the_page_and_says_it(tmp_path, capsys):
    path = tmp_path / "shaking.txt"
    one = record(1)
    lines = (f"{0.005 * i:.3f} {a:.9e}" for i, a in enumerate(one.samples))
    path.write_text("\n".join(lines))
    out = tmp_path / "column.html"
    arguments = ["--motion", str(path), "--units", "m/s2", "--set", *SET, "--out", str(out)]
    assert main(["report", "flexible_structure", *arguments]) == 0
    said = capsys.readouterr()
    assert "FlexibleStructure under 1 record\n" in said.out
    assert "Base shear, rocking over fixed base" in said.out
    assert f"wrote {out}" in said.out
    assert "simulating 1 record" in said.err
    assert out.exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["rigid_blok", "--records", "x", "--out", "a.pdf"], ["rigid_block"]),
        (["flexible_structure", "--set", *SET, "--out", "a.docx"], ["a.docx", ".html", ".pdf"]),
        (["flexible_structure", "--set", *SET, "--out", "no/such/a.pdf"], ["no/such", "make it"]),
        (["flexible_structure", "--set", "mass=1", "--out", "a.pdf"], ["missing", "half_width"]),
        (["two_spring_cart", "--set", "mass=-1", "--out", "a.pdf"], ["two", "mass"]),
        (["nondimensional_block", "--set", "alpha=0.2", "--out", "a.pdf"], ["in metres"]),
    ],
)
def test_what_cannot_be_reported_is_told_and_nothing_written(
    arguments, words, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "shaking.txt").write_text("0.00 0.0\n0.01 0.1\n0.02 0.0\n")
    if "--records" not in arguments:
        arguments = [*arguments, "--motion", "shaking.txt", "--units", "m/s2"]
    assert main(["report", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    for word in words:
        assert word.lower() in said.err.lower()
    assert [path.name for path in tmp_path.iterdir()] == ["shaking.txt"]


def test_report_without_motions_is_refused():
    with pytest.raises(ValueError, match="needs a motion"):
        design_report(column(), [])
