"""Pages of structures in space: the program in WebAssembly, and what it tells of a motion."""

import json
import re

import numpy as np
import pytest

import rockeom as rk
from rockeom.browser import setup
from rockeom.browser.places import NUMBERS
from rockeom.cli import main
from rockeom.numbers.checks import InputError
from tests.docs.test_docs import _module as docs_module

from .browsers import native, random_places
from .test_bits import bits

SAMPLES = 401
PULSE = rk.GroundMotion.single_sine(3.0, 0.8, duration=4.0)
STATUE = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)
SLIDERS = {
    "amplitude": (0.5, 8.0), "azimuth": (0.0, 1.6), "width": (0.3, 1.0), "depth": (0.4, 1.2),
    "period": (0.3, 2.0),
}  # fmt: skip


@pytest.fixture(scope="module")
def page():
    return rk.explorer(rk.Case(STATUE, PULSE, azimuth=0.5), SLIDERS)


def same_in_wasmtime(page, places) -> set[str]:
    """The outcomes of motions, whose bits and leans are asserted to be the same in WebAssembly."""
    pytest.importorskip("wasmtime", reason="WebAssembly is run by wasmtime")
    from .in_wasmtime import ProgramInWasmtime

    of_machine = native(page, SAMPLES)
    wasm = ProgramInWasmtime(page.program, page.setup.module)
    outcomes = set()
    for place in places:
        wanted, leans = of_machine(place), np.zeros((2, 8, SAMPLES))
        outcomes.add(wanted.pop("outcome"))
        machine = wanted.pop("program")
        again = {name: np.zeros_like(x) if np.ndim(x) else x for name, x in wanted.items()}
        again["sliders"][:] = place
        wasm.motion(*again.values())
        for name, x in wanted.items():
            assert np.asarray(again[name]).tobytes() == np.asarray(x).tobytes(), name
        for program, of, out in zip((machine, wasm), (wanted, again), leans, strict=True):
            program.leans(*(of[n] for n in ("states", "modes", "p", "spacing")), out)
        assert leans[0].tobytes() == leans[1].tobytes()
    return outcomes


def test_motions_in_webassembly_have_the_bits_of_machine_code(page):
    outcomes = same_in_wasmtime(page, random_places(page, 12))
    assert {"overturned", "came to rest"} <= outcomes


def test_motions_are_those_of_simulate_and_so_are_tilts_and_shapes(page):
    assert all(same for _, same in page._motions())
    place = page.setup.controls.start
    place[[0, 1, 2]] = 3.0, 0.3, 0.6
    found, leans = native(page, SAMPLES)(place), np.zeros((8, SAMPLES))
    history = (found[name] for name in ("states", "modes", "p", "spacing"))
    found["program"].leans(*history, leans)
    case = page.case(**page.controls.named(place))
    run = rk.simulate(case)
    between, n, _ = found["spacing"]
    assert n == SAMPLES
    tilt = np.arctan2(np.hypot(leans[3], leans[4]), leans[5])
    assert tilt.max() > 0.02
    wanted = run.at(between * np.arange(SAMPLES), names=["tilt", "tilt_direction", "x", "z"])
    assert tilt == pytest.approx(wanted["tilt"], abs=1e-6)
    assert leans[0] == pytest.approx(wanted["x"], abs=1e-6)
    assert leans[2] == pytest.approx(wanted["z"], abs=1e-6)
    leaning = tilt > 1e-3
    turn = np.arctan2(-leans[7], -leans[6]) - wanted["tilt_direction"]
    assert np.abs(np.sin(turn[leaning])).max() < 1e-4
    shape = case.structure.solids["body"].vertices
    assert found["numbers"][NUMBERS:] == pytest.approx(shape.ravel(), abs=1e-15)
    shaking = case.ground.shaking(between * np.arange(n))
    assert found["ground"] == pytest.approx(np.array(shaking), abs=1e-12)


def test_an_azimuth_of_zero_is_a_way_of_its_own(page):
    """There the tables of the ground have no row without end."""
    place = page.setup.controls.start
    for azimuth in (0.0, 0.5):
        place[1] = azimuth
        wanted = page.case(**page.controls.named(place)).problem().horizontal
        rows = page.setup.numbers(place).horizontal[: len(wanted)]
        assert rows == pytest.approx(wanted, rel=1e-12)


def test_a_page_is_small_and_has_the_surface_and_the_map_of_azimuth_and_intensity(page):
    text = page.html
    assert len(text.encode()) < 200e3
    assert "class Scene" in text
    assert "class Sketch" not in text
    of = json.loads(re.search(r'id="data">(.*?)</script>', text, re.DOTALL)[1])["of"]
    assert [of["sliders"][i]["name"] for i in of["axes"]] == ["azimuth", "amplitude"]
    assert of["ground"] == ["ground_x", "ground_y", "vertical"]
    assert of["space"]["feet"] == [1, 2, 3, 4]
    (solid,) = of["space"]["solids"]
    assert (solid["vertices"], solid["faces"], solid["at"]) == (8, 6, NUMBERS)
    assert not of["entries"].keys() & {"balance", "uplift_and_friction"}


def turned(azimuth, offset):
    statue = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2e3, friction=0.4, offset_x=offset)
    pulse = rk.GroundMotion.single_sine(3.0, 0.8, duration=3.0)
    return rk.Case(statue, pulse, initial={"pitch": 0.02}, azimuth=azimuth)


def test_the_python_of_a_page_runs_the_same_case():
    sliders = {"azimuth": (0.1, 1.6, 0.4), "offset": (0.0, 0.1, 0.05)}
    code = rk.explorer(turned, sliders).description()["code"]
    names = {}
    values = {"0": "0.4", "1": "0.05"}
    exec(re.sub(r"\{(\d)\}", lambda k: values[k[1]], code).replace("print(", "str("), names)
    again = rk.simulate(turned(0.4, 0.05), options=rk.SolverOptions(method="DOP853"))
    assert bits(names["run"].record) == bits(again.record)


def test_a_question_of_the_largest_rotation_has_no_page_in_space():
    question = rk.Question("Does it lean further?", {"azimuth": 1.0}, compare="peak")
    with pytest.raises(InputError, match="pages compare no largest rotation: ask whether"):
        rk.explorer(rk.Case(STATUE, PULSE), {"azimuth": (0.1, 1.6)}, questions=[question])


def test_command_makes_a_page_of_a_prism(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(setup, "PLACES", 8)
    words = "explore prism --set width=0.5 depth=0.7 height=3 mass=2000 --pulse single-sine"
    words += " amplitude=3 period=0.8 --duration 3 --vary width=0.4..0.8 amplitude=1..6 --out"
    assert main([*words.split(), str(tmp_path / "statue.html")]) == 0
    assert "open it in a browser" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "outcomes"),
    [
        ("statue", {"overturned", "came to rest"}),
        ("wobbling_column", {"overturned", "completed"}),
        ("can", {"completed"}),
    ],
)
def test_pages_of_the_guides_have_the_motions_of_simulate_and_the_same_bits(name, outcomes):
    shown = docs_module("explorers").in_space(name)
    assert all(same for _, same in shown._motions())
    assert len(shown.html.encode()) < 250e3
    assert outcomes <= same_in_wasmtime(shown, random_places(shown, 12))


def test_a_column_whose_first_direction_depends_on_sliders_has_no_page():
    column = rk.WobblingColumn(radius=0.5, height=4.0, mass=8e3)
    case = rk.Case(column, rk.GroundMotion.single_sine(3.0, 0.8, duration=3.0), azimuth=0.4)
    with pytest.raises(InputError, match="follows no slider: name the initial direction"):
        _ = rk.explorer(case, {"amplitude": (2.0, 6.0)}).setup


def test_surfaces_of_a_page_are_those_of_the_mesh():
    vertices = [(0.0, 0.0, 0.9), (0.3, 0.0, -0.3), (-0.2, 0.3, -0.3), (-0.2, -0.3, -0.3)]
    faces = [(0, 1, 2), (0, 2, 3), (0, 3, 1), (3, 2, 1)]
    tripod = rk.LeggedStatue(
        feet={"a": (0.3, 0.0), "b": (-0.2, 0.3), "c": (-0.2, -0.3)}, centroid=(0.0, 0.0, 0.3),
        mass=100.0, inertia=np.diag([9.0, 9.0, 4.0]), shape=(vertices, faces),
    )  # fmt: skip
    rows, packed = rk.explorer(rk.Case(tripod, PULSE), {"amplitude": (1.0, 6.0)})._surfaces
    assert rows == [{"place": 0, "vertices": 4, "faces": 4, "corners": 3, "at": -1}]
    assert np.frombuffer(packed[:48], "<f4") == pytest.approx(np.ravel(vertices), rel=1e-6)
    assert np.frombuffer(packed[48:], "<u2").tolist() == np.ravel(faces).tolist()


def test_a_statue_under_three_components_of_a_record_is_turned_as_in_python():
    """Their tables are as long as the longest, with a row of quiet ground behind."""
    names = ("180", "270", "up")
    x, y, up = (rk.GroundMotion.from_library(f"El Centro 1940 {n}") for n in names)
    case = rk.Case(STATUE, x, transverse=y, vertical=up, azimuth=0.3, duration=10.0)
    record = rk.explorer(case, {"scale": (0.2, 3.0, 1.5), "azimuth": (0.0, 3.1)})
    place = record.setup.controls.start
    wanted = record.case(**record.controls.named(place)).problem()
    made = record.setup.numbers(place)
    for name in ("horizontal", "transverse", "vertical"):
        table = getattr(wanted, name)
        assert getattr(made, name)[: len(table)] == pytest.approx(table, rel=1e-12, abs=1e-12)
    assert native(record)(place)["outcome"] == str(
        rk.simulate(
            case.structure,
            x.scaled(1.5),
            transverse=y.scaled(1.5),
            vertical=up.scaled(1.5),
            azimuth=0.3,
            duration=10.0,
        ).outcome
    )
