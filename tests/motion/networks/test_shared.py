"""Real files of networks, where they lie beside the project: peak, step, number, unit."""

import numpy as np
import pytest

from rockeom.motion.readers import read_file
from tests.shared import FOLDER, path

GRAVITY = 9.81
README = FOLDER / "records" / "README.md"


def table() -> list[tuple[str, int, float, list[str]]]:
    """File, number, step and peaks [m/s2] of each row of the README."""
    text = README.read_text(encoding="utf-8") if README.exists() else ""
    rows = [line.strip(" |").split(" | ") for line in text.splitlines() if line.startswith("| ")]
    return [
        (file, int(samples), float(step), peaks.split(", "))
        for file, _, _, samples, step, peaks in rows[2:]
    ]


def test_table_of_the_readme_is_read():
    path("records")
    assert len(table()) == 17


@pytest.mark.filterwarnings("ignore:CUP50401.012. the header counts")
@pytest.mark.parametrize("row", table(), ids=lambda row: row[0])
def test_file_is_read_as_its_readme_has_it(row):
    file, samples, step, peaks = row
    (whole,) = path("records").glob(file.replace("...", "*"))  # some names are cut in the README
    records = read_file(whole, None, GRAVITY)
    first = 1 if file.startswith("CUP") else 0  # its README has the second column
    for one, peak in zip(records[first:], peaks, strict=False):
        assert len(one.acceleration) == samples
        assert one.dt == pytest.approx(step, rel=1e-9)
        digit = 10.0 ** -len(peak.partition(".")[2]) if "e" not in peak else 1e-6
        assert np.abs(one.acceleration).max() == pytest.approx(float(peak), abs=0.51 * digit)
