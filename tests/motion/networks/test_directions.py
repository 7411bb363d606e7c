"""Directions of components as files state them: fields of azimuth, codes, and names."""

import re

import numpy as np
import pytest

from rockeom.motion.readers import read_file
from tests.motion.networks.twins import GRAVITY, TWINS

# pattern of a twin and its replacement; component: azimuth, vertical, sign of its accelerations
DIRECTIONS = {
    "CESMD, down": ("cesmd_v1", r"Up - roof", "Down", 2, None, True, -1),
    "CESMD, azimuth without a name": ("cesmd_v1", r"90 Deg", "Left wall", 1, 90.0, False, 1),
    "COSMOS, down": ("cosmos_v1", r"(?m)^(.{24})     400", r"\1     401", 1, None, True, -1),
    "COSMOS, of no sense": ("cosmos_v1", r"(?m)^(.{24})     400", r"\1     402", 1, None, True, 1),
    "COSMOS, by name": ("cosmos_v1", r"(?m)^(.{24})     400", r"\1    -999", 1, None, True, 1),
    "COSMOS, by code": ("cosmos_v2c", r"(?m)^(.{24})     400", r"\1    -999", 1, None, True, 1),
    "COSMOS, no north": ("cosmos_v2c", r"(?m)^(.{24})     340", r"\1       0", 0, None, False, 1),
    "SMC, none": ("smc", r" {8}90 {7}350", "    -32768    -32768", 0, 350.0, False, 1),
    "SMC, down": ("smc", r"(?s)350(.*) 90 {7}350", r"DOWN\g<1>180         0", 0, None, True, -1),
    "CESMD, by name": ("cesmd_v1", r"(?s)Up - roof(.*?)  500", r"Down;\1 -999", 2, None, True, -1),
}  # fmt: skip


@pytest.mark.parametrize("name", DIRECTIONS)
def test_direction_is_that_of_the_format(tmp_path, name):
    form, pattern, replacement, n, azimuth, is_vertical, sign = DIRECTIONS[name]
    twin = TWINS[form]()
    text, found = re.subn(pattern, replacement, twin.text)
    assert found
    path = tmp_path / "record.txt"
    path.write_text(text)
    record = read_file(path, None, GRAVITY)[n]
    assert (record.azimuth, record.is_vertical) == (azimuth, is_vertical)
    np.testing.assert_allclose(record.acceleration, sign * twin.directions[n].acceleration)
    assert ("upwards" in record.source) == (sign < 0)
