"""The published reference cases: the file and its schema, and both derivations of each answer."""

import json

import jsonschema
import numpy as np
import pytest
from mpmath import mp, mpf

from benchmarks.reference_cases import FILE, SCHEMA, __main__ as suite, independent, newton_euler
from benchmarks.reference_cases.declared import CASES, unit_of

PUBLISHED = json.loads(FILE.read_text(encoding="utf-8"))
BY_ID = {case["id"]: case for case in PUBLISHED["cases"]}
EXPENSIVE = {"flexible-column", "pulse-overturns", "pulse-safe-window", "two-springs"}
"""Integrated in many digits: they take seconds, and the tool that writes the file does it."""


def valid(whole: object) -> None:
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.Draft202012Validator(schema).validate(whole)


def test_file_is_as_its_schema_says():
    valid(PUBLISHED)


@pytest.mark.parametrize(
    ("where", "value"),
    [
        (("model", "bodies", 0, "mass"), -1.0),
        (("model", "contacts", 0, "restitution"), 1.5),
        (("model", "contacts", 0, "friction"), "none"),
        (("quantities", 0, "digits"), 3),
        (("quantities", 0, "measure", "what"), "beauty"),
        (("id",), "Free Decay"),
        (("surplus",), 1),
    ],
)
def test_schema_refuses_a_file_that_is_wrong(where, value):
    wrong = json.loads(FILE.read_text(encoding="utf-8"))
    part = wrong["cases"][0]
    for key in where[:-1]:
        part = part[key]
    part[where[-1]] = value
    with pytest.raises(jsonschema.ValidationError):
        valid(wrong)


def test_file_has_all_that_is_declared():
    assert [case["id"] for case in PUBLISHED["cases"]] == [case.id for case in CASES]
    for case in CASES:
        published = BY_ID[case.id]
        assert published["parameters"] == {
            name: {"value": value, "unit": unit_of(name)} for name, value in case.parameters.items()
        }
        _close(published["model"], case.model(case.parameters))
        texts = {"title": case.title, "description": case.description}
        assert {name: published[name] for name in texts} == texts
        assert [q["name"] for q in published["quantities"]] == [q.name for q in case.quantities]


def _close(a, b):
    if isinstance(a, dict):
        assert a.keys() == b.keys()
        for key in a:
            _close(a[key], b[key])
    elif isinstance(a, list):
        for x, y in zip(a, b, strict=True):
            _close(x, y)
    elif isinstance(a, float):
        assert a == pytest.approx(b, rel=1e-14, abs=1e-15)
    else:
        assert a == b


def test_twenty_motions_of_which_nine_are_not_sensitive():
    assert len(CASES) == 20
    assert sum(not case["sensitive"] for case in PUBLISHED["cases"]) >= 9
    assert min(q["digits"] for case in PUBLISHED["cases"] for q in case["quantities"]) >= 12


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.id)
def test_rockeom_gives_the_published_answers(case):
    ours = suite.by_rockeom(case)
    for q in BY_ID[case.id]["quantities"]:
        # a unit of the last digit, for another processor or another method of the same order
        apart = abs(ours[q["name"]] - float(q["independent"]))
        assert apart <= 10.0 * 10.0 ** -q["digits"] * abs(float(q["independent"])), q["name"]


@pytest.mark.parametrize(
    "case", [case for case in CASES if case.id not in EXPENSIVE], ids=lambda case: case.id
)
def test_derivation_without_rockeom_gives_the_published_answers(case):
    answers = suite.independently(case, 22, step="0.03")
    for q in BY_ID[case.id]["quantities"]:
        assert float(answers[q["name"]]) == pytest.approx(float(q["independent"]), rel=1e-14), q


def test_published_value_has_the_digits_on_which_both_agree():
    with mp.workdps(30):
        for q in (q for case in PUBLISHED["cases"] for q in case["quantities"]):
            exact = mpf(q["independent"])
            assert abs(mpf(q["rockeom"]) / exact - 1) <= mpf(10) ** -q["digits"]
            assert abs(mpf(repr(q["value"])) / exact - 1) <= mpf(10) ** (1 - q["digits"])


# -- the equations of the suite, by what is known of them ----------------------------------------


def test_impact_of_newton_and_euler_is_that_of_housner():
    with mp.workdps(25):
        p = {k: mpf(v) for k, v in (("half_width", "0.3"), ("half_height", "1.1"), ("mass", "2"),
                                    ("gravity", "9.81"))}  # fmt: skip
        block = independent.RockingBlock(p, None)
        rate = mpf(-1)
        state = newton_euler.State(mpf(0), [mpf(0), block.h, mpf(0)], [])
        state.v = [block.h * rate, block.b * rate, rate]  # about the right foot
        after = block.impact(state, 1).v[2] / rate
        alpha, _ = independent.pivoted(p)
        assert abs(after - independent.ratio_of_velocities(alpha)) < mpf(10) ** -23


def test_impact_of_the_frame_is_that_of_three_bodies():
    """Two columns and a beam, struck at the new feet and the new tops."""
    with mp.workdps(25):
        b, h, m, m_b = mpf("0.1"), mpf("0.5"), mpf(1), mpf(3)
        column = newton_euler.Body(m, m * (b * b + h * h) / 3)
        bodies = [column, column, newton_euler.Body(m_b, mpf(1))]
        apart, top = mpf("0.6"), 2 * h
        q = [-apart, h, 0, apart, h, 0, 0, top + h / 4, 0]
        rate = mpf(-1)  # about the right feet; the beam rides on the left tops
        of_column = [h * rate, b * rate, rate]
        v = [*of_column, *of_column, 2 * h * rate, 2 * b * rate, mpf(0)]
        state = newton_euler.State(mpf(0), [mpf(x) for x in q], v)
        rows = []
        for i, side in ((0, -1), (1, 1)):
            rows += newton_euler.at_ground(state, i, [-b, -h])
            rows += newton_euler.between(state, i, [b, h], 2, [side * apart + b, -h / 4])
        after = newton_euler.after_impact(bodies, rows, v)
        alpha = mp.atan(b / h)
        share = m_b / (2 * m)
        expected = independent.ratio_of_velocities(alpha) + 3 * share * mp.cos(2 * alpha)
        for i in (2, 5):
            assert abs(after[i] / rate - expected / (1 + 3 * share)) < mpf(10) ** -22
        assert abs(after[8]) < mpf(10) ** -22  # the beam stays level


def test_extrapolation_has_the_digits_that_are_asked_for():
    """A mass on a spring, whose motion is a cosine; and an event on it."""
    with mp.workdps(30):
        stage = newton_euler.Stage(
            [newton_euler.Body(mpf(1), mpf(1))], lambda s: [-4 * s.q[0], mpf(0), mpf(0)]
        )
        solver = newton_euler.Solver(mpf("0.1"), 25)
        start = newton_euler.State(mpf(0), [mpf(1), mpf(0), mpf(0)], [mpf(0)] * 3)
        end, which = solver.until(stage, start, [lambda s: s.q[0]], mpf(5))
        assert which == 0
        assert abs(end.t - mp.pi / 4) < mpf(10) ** -22


def test_friction_coefficient_of_one_excludes_slip(monkeypatch):
    """As the conventions say of cases without a coefficient; bodies on guides have none."""
    from benchmarks.reference_cases import with_rockeom

    runs, made = [], with_rockeom._run
    monkeypatch.setattr(
        with_rockeom, "_run", lambda *a, **more: runs.append(made(*a, **more)) or runs[-1]
    )
    for case in CASES:
        touching = BY_ID[case.id]["model"]["contacts"]
        if touching and touching[0]["friction"] is None:
            runs.clear()
            suite.by_rockeom(case)
            support = runs[-1].support
            demands = [support.friction_demand, support.impact_friction_demand]
            assert np.nanmax(demands) < 1.0, case.id
