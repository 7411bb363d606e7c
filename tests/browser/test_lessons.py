"""Lessons mark right what is right, in the teacher's words, and say so in any language."""

import base64
import hashlib
import json
import re
import shutil

import numpy as np
import pytest

import rockeom as rk
from rockeom.browser.lesson import COMPARED, ends_of
from rockeom.structures.positions import legs

from .browsers import BROWSERS, _declared_block, answered, with_script

SHORT = 8.0
"""Duration of the case of a lesson [s], in which most motions do not come to rest."""


def lesson(height, tilt, amplitude, r):
    block = rk.RigidBlock(half_width=height / 8, half_height=height / 2)
    pulse = rk.GroundMotion.single_cosine(amplitude, 0.8, duration=SHORT)
    return rk.Case(block, pulse, rk.EnergyRatio(r), initial={"theta": tilt * block.alpha})


SLIDERS = {
    "height": rk.Slider(0.4, 4.0, 1.2, "m", "height of the block"), "tilt": (0.0, 0.95, 0.5),
    "amplitude": (0.0, 16.0, 0.0), "r": (0.5, 1.0, 0.9),
}  # fmt: skip


@pytest.fixture(scope="module")
def page():
    return rk.explorer(lesson, SLIDERS)


def asked(page, question):
    """Times until which the motions of a question go on, and its readings there."""
    setup = page.setup
    ends = ends_of(question, setup.case, setup.controls, page._native)
    places = setup.controls.start + np.zeros((2, 1))
    for place, values in zip(places, question.motions(setup.controls), strict=True):
        place[list(values)] = [*values.values()]
    kind = COMPARED.index(question.compare)
    return ends, [page._native(p, end)[1][kind] for p, end in zip(places, ends, strict=True)]


def test_a_larger_block_of_one_shape_rocks_longer_by_the_root_of_its_size(page):
    """Rotations are a function of p t, with p = sqrt(3 g / 4 R): impacts are as many."""
    for compare, factor in (("duration", np.sqrt(4.0 / 1.2)), ("impacts", 1.0), ("peak", 1.0)):
        ends, (before, after) = asked(page, rk.Question("Higher?", {"height": 4.0}, compare))
        assert after == pytest.approx(factor * before, rel=1e-6)
        assert compare == "peak" or max(ends) > SHORT
    _, (duration, _) = asked(page, rk.Question("Higher?", {"height": 4.0}, "duration"))
    assert duration == pytest.approx(10.77, abs=0.01)


def test_the_period_of_free_rocking_is_that_of_housner(page):
    """From rest at a tilt to the first impact a quarter, then half a period for each energy."""
    slender = {"height": 1.2, "tilt": 0.5, "r": 1.0}
    _, (before, after) = asked(page, rk.Question("Why?", {"tilt": 0.1}, "period", slender))
    p = np.sqrt(0.75 * 9.81 / (0.6 * np.hypot(1.0, 0.25)))
    for found, tilt in ((before, 0.5), (after, 0.1)):
        assert found == pytest.approx(4.0 / p * np.arccosh(1.0 / (1.0 - tilt)), rel=0.02)


def choice(before, after):
    """What happens from before to after, within one percent."""
    change = after - before
    return 0.0 if abs(change) <= 0.01 * abs(before) else np.sign(change)


def by_python(compare, values, end):
    case = lesson(**values)
    more = {"impact": case.impact, "initial": case.initial, "duration": end}
    run = rk.simulate(case.structure, case.motion, **more)
    if compare == "peak":
        return abs(run.extremes("theta").peak)
    of_times = {"impacts": len, "period": lambda t: t[2] - t[0], "duration": max}
    overturned = {"overturns": lambda _: str(run.outcome) == "overturned"}
    return (of_times | overturned)[compare](run.impacts.times)


PAIRS = 8
GUIDE = [
    ("period", "tilt"), ("duration", "height"), ("duration", "r"), ("overturns", "height"),
    ("overturns", "amplitude"), ("peak", "amplitude"), ("impacts", "r"),
]  # fmt: skip
"""What the guide to teaching compares, and the slider that changes."""


@pytest.mark.parametrize(("compare", "changed"), GUIDE)
def test_answers_are_those_of_motions_three_times_as_long_or_refused(page, compare, changed):
    places = map(page.controls.named, [*page.controls.spread(2 * PAIRS)][2:])
    answers = 0
    for before, after in zip(places, places, strict=True):
        if compare != "overturns" and changed != "amplitude":
            before["amplitude"] = 0.0  # as in the guide, the block is released
        question = rk.Question("Why?", {changed: after[changed]}, compare, before)
        try:
            ends, readings = asked(page, question)
        except ValueError:  # refused
            continue
        motions = before, before | question.after
        python = [by_python(compare, x, 3.0 * end) for x, end in zip(motions, ends, strict=True)]
        assert choice(*readings) == choice(*python)
        answers += 1
    assert answers >= 0.7 * PAIRS


@pytest.mark.parametrize(
    ("compare", "before", "message"),
    [
        ("duration", {"r": 1.0}, r"duration of a motion is .* until 1024 s, .* until 3072 s"),
        ("impacts", {"r": 1.0}, "ask of motions that come to rest, or compare something else"),
        ("period", {"tilt": 0.0}, "period of a motion is nan .*there is none"),
        ("duration", {"tilt": 0.0}, "ends as 'completed'|ends as 'came to rest'"),
    ],
)
def test_a_question_whose_answer_never_settles_is_refused(page, compare, before, message):
    with pytest.raises(ValueError, match=rf"question 'Why\?': .*{message}"):
        asked(page, rk.Question("Why?", {"height": 2.0}, compare, before))


# --- words


def test_arguments_of_a_function_have_the_words_of_the_teacher_alone():
    def of_sides(width, height):
        block = rk.RigidBlock(half_width=width / 2, half_height=height / 2)
        return rk.Case(block, rk.GroundMotion.half_sine(4.0, 0.8, duration=5.0))

    sliders = {"width": (0.1, 0.4), "height": rk.Slider(0.5, 2.0, unit="m", words="full height")}
    page = rk.explorer(of_sides, sliders)
    width, height = page.description()["sliders"]
    assert (width["unit"], width["meaning"], height["unit"], height["meaning"]) == ("", "", "m", "")
    assert page._words()["height"] == "full height"


def texts_of(page):
    """The table of texts in the script of a page."""
    return json.loads(re.search(r"^const TEXTS = (.*);$", page._script, re.MULTILINE)[1])


def translated(table):
    """A second language: every text in guillemets."""
    return {
        name: translated(text) if isinstance(text, dict) else f"«{text}»"
        for name, text in table.items()
    }


def test_all_texts_can_be_given():
    sliders = {"half_width": (0.05, 0.4), "half_height": (0.2, 1.5)}
    case = rk.Case(rk.RigidBlock(half_width=0.15, half_height=0.6), rk.GroundMotion.none(5.0))
    own = texts_of(rk.explorer(case, sliders))
    assert {"half_width", "theta", "server rack"} <= own["names"].keys()
    given = translated(own)
    assert texts_of(rk.explorer(case, sliders, texts=given)) == given


@pytest.mark.parametrize(
    ("texts", "error", "message"),
    [
        ({"pley": "Start"}, ValueError, "texts: a page has no 'pley' .did you mean play"),
        (
            {"summary": "{0}: {1}"},
            ValueError,
            r"summary is '\{0\}: \{1\}': give a text like '\{0\}: largest \{1\}",
        ),
        ({"outcomes": {"fell": "x"}}, ValueError, r"texts\['outcomes'\]: a page has no 'fell'"),
        ({"outcomes": "fell"}, TypeError, r"texts\['outcomes'\] is 'fell': give it by names"),
        ({"names": {"width": "Breite"}}, ValueError, r"texts\['names'\]: a page has no 'width'"),
        ({"play": 3}, ValueError, "texts: play is 3: give a text like 'Play'"),
        ("play", TypeError, "texts is 'play'"),
    ],
)
def test_a_text_that_no_page_has_or_that_loses_a_number_is_refused(texts, error, message):
    with pytest.raises(error, match=message):
        rk.explorer(lesson, SLIDERS, texts=texts)


# --- the page as a whole


def test_a_page_runs_its_own_script_and_style_alone(page):
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page.html)[1]
    for of in ("script", "style"):
        (text,) = re.findall(rf"<{of}(?: id=\"code\")?>(.*?)</{of}>", page.html, re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"{of}-src 'sha256-{digest}'" in policy
    assert "default-src 'none'" in policy
    assert "unsafe-inline" not in policy


def test_the_first_map_shows_both_fates(page):
    """Without a pulse no height and no tilt overturns the block: the pulse is an axis."""
    axes = page._axes()
    assert "amplitude" in {[*SLIDERS][i] for i in axes}
    assert page._dependence(axes) >= (1, 0.2)


def test_a_declared_structure_is_drawn_by_lines_to_its_feet():
    block, names = _declared_block(), _declared_block().module.POSITIONS
    pairs = legs(block, 0, block.state({}))
    assert [[names[k] for k in leg] for leg in pairs] == [["block", "left"], ["block", "right"]]


@pytest.mark.parametrize(
    ("mass", "sliders", "assumed"),
    [(1.0, {}, True), (300.0, {}, False), (1.0, {"mass": (0.5, 2.0)}, False)],
)
def test_energies_are_over_m_g_r_where_the_mass_is_a_default(mass, sliders, assumed):
    block = rk.RigidBlock(half_width=0.15, half_height=0.6, mass=mass)
    case = rk.Case(block, rk.GroundMotion.half_sine(4.0, 0.8, duration=5.0))
    weight = rk.explorer(case, {"amplitude": (1.0, 8.0), **sliders})._assumed_weight()
    names = block.module.PARAMETERS
    assert weight == ([names.index("mass"), names.index("gravity")] if assumed else None)


_LESSON = """
const wait = (until) => new Promise((go) => {
  const look = () => (until() ? go() : setTimeout(look, 20));
  look();
});
const drawn = new Set();
const paint = CanvasRenderingContext2D.prototype.fillText;
CanvasRenderingContext2D.prototype.fillText = function (text, ...at) {
  drawn.add(text);
  paint.call(this, text, ...at);
};
(async () => {
  await wait(() => by("outcome").textContent);
  const image = await picture();
  const size = document.documentElement.getBoundingClientRect();
  by("mode-questions").click();
  document.querySelector("[name=choice][value=grows]").click();
  by("run").click();
  const shown = [...drawn, ...document.body.innerText.split("\\n")];
  await fetch("/results", { method: "POST", body: JSON.stringify({
    answer: by("answer").textContent, now: by("now").textContent, shown,
    image: [image.width, image.height], page: [size.width, size.height] }) });
})().catch((error) => fetch("/results", { method: "POST", body: JSON.stringify(String(error)) }));
"""


@pytest.fixture(scope="module")
def second_language(page):
    question = rk.Question("«Higher?»", {"height": 4.0}, "duration", explanation="«Why.»")
    words = translated(texts_of(page))
    return rk.explorer(lesson, SLIDERS, "«Title»", questions=[question], texts=words)


@pytest.mark.parametrize("browser", BROWSERS)
def test_a_browser_marks_a_right_prediction_in_a_second_language(second_language, browser):
    """Free rocking of 8 s: 1.2 m high it takes 10.8 s to rest, 4 m high 19.7 s."""
    if not shutil.which(browser):
        pytest.skip(f"{browser} is not installed")
    told = answered(with_script(second_language.html, _LESSON), browser)
    assert told["answer"] == "«It grows from 10.8 s to 19.7 s.» «You predicted it.»"
    assert "«32.00 s»" in told["now"] or "of 32 s" in told["now"]
    words = [text for text in told["shown"] if re.search("[a-z]{3}", text) and "«" not in text]
    assert not words
    assert told["image"] == pytest.approx(told["page"], abs=1)
