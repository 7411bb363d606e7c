"""What Jupyter shows: all there is, and names as data."""

import functools
import re
from html.parser import HTMLParser

import numpy as np
import pytest

import rockeom as rk
from rockeom import plots
from rockeom.sweeps.run import Sweep
from tests.contact import declared

NASTY = '<script>alert("a & b")</script> $\\frac{ $'
BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
PULSE = rk.GroundMotion.single_sine(2.8, 0.5, 3.0)
NAMED = rk.GroundMotion(PULSE.segments, name=NASTY, source=NASTY)
RUN = rk.simulate(BLOCK, NAMED)


class Page(HTMLParser):
    """The tags of a page, which must close as they open, and its words."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.words = ""
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        if tag not in ("img", "br", "input", "use", "path", "rect"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in ("img", "br", "input", "use", "path", "rect"):
            assert self.open.pop() == tag

    def handle_data(self, data):
        self.words += data


@functools.lru_cache(maxsize=1)
def of_the_run() -> str:
    return RUN._repr_html_()


def html_of(shown) -> str:
    return of_the_run() if shown is RUN else shown._repr_html_()


def sweep() -> Sweep:
    labels = np.array([["completed", "overturned"], ["overturned", "not run"]])
    return Sweep(
        {"outcome": (("record", "pga"), labels), "impacts": (("record", "pga"), np.eye(2))},
        coords={"record": [NASTY, "b"], "pga": [1.0, 2.0]}, attrs={"model": NASTY},
    )  # fmt: skip


@pytest.mark.parametrize("shown", [BLOCK, NAMED, RUN, sweep()], ids=lambda x: type(x).__name__)
def test_names_are_data_and_the_page_is_whole(shown):
    page = Page(html_of(shown))
    assert "script" not in page.tags
    if shown is not BLOCK:
        assert '<script>alert("a & b")</script>' in page.words


def test_structure_has_a_sketch_and_every_parameter_with_its_unit_and_meaning():
    page = Page(BLOCK._repr_html_())
    assert "img" in page.tags
    m = BLOCK.module
    for name, unit, meaning in zip(
        m.PARAMETERS, m.PARAMETER_UNITS, m.PARAMETER_MEANINGS, strict=True
    ):
        value = f"{BLOCK.parameters()[name]:.6g}"
        assert f"{name.replace('_', ' ')}{value}{unit}{meaning}" in page.words


def test_declared_structure_is_shown_alike():
    stepped = rk.structure(
        declared.on_a_step(), mass=900.0, inertia=540.0, gravity=9.81, friction=0.3,
        restitution=0.2, height=1.0, half_width=0.4, step=0.2,
    )  # fmt: skip
    page = Page(stepped._repr_html_())
    assert "height of the step" in page.words
    assert "img" in page.tags


def test_response_tells_its_summary():
    words = Page(html_of(RUN)).words
    for line in RUN.summary().splitlines():
        assert line in words


def test_motion_tells_its_numbers():
    record = rk.GroundMotion.from_array([0.0, 3.0, -4.0], 0.02, name="mine")
    words = Page(record._repr_html_()).words
    for part in ("mine", "duration0.04s", "peak4m/s2", "time step0.02s", "samples3", "array"):
        assert part in words


def test_sweep_counts_its_outcomes_above_the_dataset():
    page = Page(sweep()._repr_html_())
    assert "overturned2" in page.words
    assert "completed1" in page.words
    assert "not run1" in page.words
    assert "xarray" in page.words
    assert "xarray" in Page(sweep()[["impacts"]]._repr_html_()).words  # a part of it


def test_figures_take_names_of_any_letters():
    """That of the response has been drawn for the page."""
    assert "img" in Page(html_of(RUN)).tags
    plots.plot_phase_portrait(RUN).draw_without_rendering()
    plots.plot_comparison([RUN, RUN]).draw_without_rendering()


# --- what is offered after Tab


def test_keys_of_a_response_are_offered():
    assert RUN._ipython_key_completions_() == list(RUN.names)
    assert "theta" in RUN._ipython_key_completions_()


def test_package_lists_what_is_ours():
    public = {name for name in dir(rk) if not name.startswith("__")}
    assert public == {*rk.__all__, "analysis", "plots"}
    assert rk.plots is plots
    assert all(re.fullmatch(r"__\w+__", name) for name in set(dir(rk)) - public)


def test_names_are_data_in_pages_that_are_files(tmp_path):
    plots.design_report(BLOCK, [NAMED], duration=0.5).write(tmp_path / "report.html")
    RUN.animate(tmp_path / "block.html", end=0.2, frames_per_second=5)
    for name, scripts in (("report.html", 0), ("block.html", 1)):  # that of the player
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert text.count("<script") == scripts
        assert "&lt;script&gt;" in text
