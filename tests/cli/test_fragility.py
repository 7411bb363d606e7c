"""`rockeom fragility`."""

import csv

import numpy as np
import pytest
from PIL import Image

import rockeom as rk
from rockeom.analysis.risk import fit_fragility
from rockeom.cli import main

BLOCK = ["rigid_block", "--set", "half_width=0.2", "half_height=0.9"]
LEVELS = [0.4, 0.7, 1.0, 1.6]  # g


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Six records of noise that fades."""
    made = tmp_path_factory.mktemp("records")
    for seed in range(6):
        motion = rk.GroundMotion.kanai_tajimi(
            0.01, duration=6.0, seed=seed, dt=0.02, envelope=lambda t: t * np.exp(-t)
        )
        rows = zip(*motion.sampled(0.02), strict=True)
        text = "\n".join(f"{t:.2f} {a:.6f}" for t, a in rows)
        (made / f"noise_{seed}.at2.txt").write_text(text, "utf-8")
    return made


def files(folder):
    return ["--motion", *map(str, sorted(folder.iterdir())), "--units", "m/s2"]


def test_curve_is_that_of_single_simulations_and_is_written(folder, tmp_path, capsys):
    out = tmp_path / "out"
    words = [*BLOCK, *files(folder), "--pga", "0.4g,0.7g", "1.0g", "1.6 g", "--duration", "8"]
    assert main(["fragility", *words, "--out", str(out)]) == 0
    said = capsys.readouterr().out
    block = rk.RigidBlock(half_width=0.2, half_height=0.9)
    motions = [rk.GroundMotion.read(f, units="m/s2") for f in sorted(folder.iterdir())]
    fell = [
        sum(
            rk.simulate(block, m.scaled_to(pga=f"{level} g"), duration=8.0).outcome == "overturned"
            for m in motions
        )
        for level in LEVELS
    ]
    for level, hits in zip(LEVELS, fell, strict=True):
        assert f"{level:6.3g} g: {hits:3d} of 6 overturned" in said
    curve = fit_fragility(LEVELS, fell, 6)
    assert f"50%: {curve.median:.3g} g (" in said
    assert "maximum likelihood, 24 motions in 6 groups, intervals of 95 %:" in said
    with (out / "fragility.csv").open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[0] == "pga [g]"
    assert [float(row[3]) for row in rows] == pytest.approx(curve.probability(LEVELS), rel=1e-5)
    with Image.open(out / "fragility.png") as picture:
        assert picture.width > 500


def test_records_are_scaled_to_a_spectral_acceleration(folder, capsys):
    words = [*BLOCK, *files(folder), "--sa", "1.0,2.0", "--period", "0.5", "--duration", "7"]
    code = main(["fragility", *words, "--demand", "theta", "--limit", "0.01"])
    said = capsys.readouterr()
    assert "spectral acceleration at 0.5 s" in said.out
    assert code == 0 or "no curve fits these observations" in said.err


def test_none_overturned_is_said_with_the_option_that_changes_it(folder, capsys):
    words = [*BLOCK, *files(folder), "--pga", "0.01g,0.02g", "--duration", "7"]
    assert main(["fragility", *words]) == 2
    said = capsys.readouterr()
    assert "0 of 6 overturned" in said.out
    assert "none of 12 motions exceeded the limit" in said.err
    assert "--pga" in said.err
