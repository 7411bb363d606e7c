"""`rockeom sweep`."""

import csv

import numpy as np
import pytest
import xarray as xr
from PIL import Image

import rockeom as rk
from rockeom.cli import main

BLOCK = ["rigid_block", "--set", "half_width=0.2", "half_height=0.9"]
PULSE = ["--pulse", "single-sine", "amplitude=1", "period=0.8", "--duration", "6"]


def test_rows_are_single_simulations_with_the_numbers_named(tmp_path, capsys):
    over = ["--over", "amplitude=2:6:3", "half_width=0.15,0.2"]
    assert main(["sweep", *BLOCK, *PULSE, *over, "--out", str(tmp_path)]) == 0
    with (tmp_path / "sweep.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[:3] == ["amplitude [m/s2]", "half_width [m]", "outcome"]
    assert header[-2:] == ["peak theta [rad]", "peak theta_dot [rad/s]"]
    assert len(rows) == 6
    for row in rows:
        block = rk.RigidBlock(half_width=float(row[1]), half_height=0.9)
        pulse = rk.GroundMotion.single_sine(float(row[0]), 0.8)
        run = rk.simulate(block, pulse, duration=6.0)
        assert row[2] == str(run.outcome)
        if row[2] != "overturned":
            assert float(row[-2]) == pytest.approx(abs(run.extremes("theta").peak), rel=1e-6)
    said = capsys.readouterr().out
    fell = sum(row[2] == "overturned" for row in rows)
    assert "6 motions of rigid_block over amplitude and half_width" in said
    assert f"{fell} overturned" in said
    with Image.open(tmp_path / "sweep.png") as picture:
        assert picture.width > 500


def test_netcdf_and_the_picture_of_one_name(tmp_path):
    over = ["--over", "half_width=0.15:0.3:4", "--format", "netcdf"]
    assert main(["sweep", *BLOCK, *PULSE, *over, "--out", str(tmp_path / "new")]) == 0
    with xr.open_dataset(tmp_path / "new" / "sweep.nc") as sweep:
        assert np.allclose(sweep["half_width"], [0.15, 0.2, 0.25, 0.3])
        assert sweep["half_width"].attrs["units"] == "m"
        assert sweep["peak"].dims == ("half_width", "state")
    assert (tmp_path / "new" / "sweep.png").exists()


def test_more_than_two_names_have_a_table_and_no_picture(tmp_path, capsys):
    over = ["--over", "amplitude=2,3", "period=0.5,1", "restitution=0.8,0.9"]
    assert main(["sweep", *BLOCK, *PULSE, *over, "--out", str(tmp_path)]) == 0
    assert "no picture" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.csv"]
