"""Checks of codes next to the motions of an assessment."""

import re
from html import unescape

import pytest

import rockeom as rk
from rockeom.analysis import standards
from tests.assessment.test_assessment import BLOCK, PGA, RECORDS
from tests.refusals import refused

SPECTRUM = rk.DesignSpectrum.eurocode_8("0.5 g", "A")


def checks(pga):
    return [standards.west_uplift(BLOCK, pga), standards.asce_43_sliding(0.9, 0.0, SPECTRUM)]


@pytest.fixture(scope="module")
def answer():
    return rk.assess(BLOCK, RECORDS, pga=PGA, checks=checks)


def cells(page):
    table = page.partition("<h2>Checks of codes</h2>")[2].partition("</table>")[0]
    rows = [re.findall(r"<t[dh]>(.*?)</t[dh]>", row) for row in table.split("<tr>")[1:]]
    return [[unescape(x).replace("\xa0", " ") for x in row] for row in rows]


def test_page_has_motions_and_checks_at_each_pga(answer):
    heads, counts, west, sliding = cells(answer.html())
    assert heads == ["", "0.35 g", "0.45 g", "0.6 g"]
    for cell, row in zip(counts[1:], answer.trials.intensities, strict=True):
        assert cell.startswith(f"{row.overturned} of {row.number} (")
        assert cell.endswith(f"to {100 * row.upper:.0f} %)")
    # g b/h is 0.25 g
    assert west == ["West", *(f"{x / 0.25:.2f}, a foot lifts" for x in (0.35, 0.45, 0.6))]
    assert sliding[1:] == ["0 m, stays in its place"] * 3


def test_summary_has_the_same_and_the_sources(answer):
    said = " ".join(str(answer).split())
    assert "West: at 0.35 g 1.40, a foot lifts; at 0.45 g 1.80, a foot lifts" in said
    assert "ASCE 43, sliding: displacement. Source: ASCE 43-05, A.1, second-hand" in said
    assert "Checks of codes" not in str(rk.assess(BLOCK, RECORDS[:1], pga=PGA[:1]))


def test_checks_wait_for_units_in_doubt():
    block = rk.RigidBlock(half_width=300.0, half_height=1000.0)
    answer = rk.assess(
        block, RECORDS[:1], pga="0.4 g", checks=lambda pga: [standards.west_uplift(block, pga)]
    )
    assert "No verdict" in answer.verdict
    assert "West" not in str(answer)
    assert "Checks of codes" not in answer.html()


@pytest.mark.parametrize(
    "checks", [lambda pga: [], lambda pga: ["West"], lambda pga: checks(pga)[: 1 + (pga > 4)], 3]
)
def test_anything_but_the_same_checks_at_each_pga_is_refused(checks):
    assert refused(rk.assess, BLOCK, RECORDS[:1], pga=PGA, checks=checks)[0] == "checks"
