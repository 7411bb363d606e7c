"""Each format of a network gives the motion that was written, to its printed digit."""

import re

import numpy as np
import pytest

import rockeom as rk
from rockeom.motion.formats import read_components
from rockeom.motion.formats.text import opened
from tests.motion.networks.twins import DT, GRAVITY, SAMPLES, TWINS
from tests.refusals import told

NETWORKS = [name for name in TWINS if name != "peer"]
SEVERAL = [name for name in TWINS if len(TWINS[name]().directions) > 1]


def written(folder, name, text=None):
    path = folder / f"{name}.txt"
    path.write_text(TWINS[name]().text if text is None else text, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", NETWORKS)
def test_twin_is_read_whole(tmp_path, name):
    twin = TWINS[name]()
    components = read_components(opened(written(tmp_path, name)), GRAVITY)
    assert len(components) == len(twin.directions)
    for one, direction in zip(components, twin.directions, strict=True):
        assert len(one.acceleration) == SAMPLES
        assert one.dt == pytest.approx(DT, rel=1e-12)
        np.testing.assert_allclose(one.acceleration, direction.acceleration, rtol=1e-12, atol=1e-14)
        described = (one.name, one.azimuth, one.is_vertical, one.unit, one.station)
        assert described == (*direction[:3], twin.unit, twin.station)


@pytest.mark.parametrize("name", TWINS)
def test_component_is_chosen_by_number_name_or_azimuth(tmp_path, name):
    path = written(tmp_path, name)
    for n, direction in enumerate(TWINS[name]().directions, 1):
        choices = [n] if name == "peer" else [n, str(n), direction.name.lower(), direction.azimuth]
        for component in [choice for choice in choices if choice is not None]:
            motion = rk.GroundMotion.read(path, component=component, gravity=GRAVITY)
            np.testing.assert_allclose(
                motion.samples, direction.acceleration, rtol=1e-12, atol=1e-14
            )
            assert motion.is_vertical is direction.is_vertical


@pytest.mark.parametrize(
    "component", ["nowhere", 45, 7, 45.5, float("nan"), True, [1], b"N", "N-E"]
)
def test_component_that_is_none_is_refused(tmp_path, component):
    with pytest.raises(rk.InputError, match=r"1 U, 2 N, 3 E\. Remedy: give component= as a number"):
        rk.GroundMotion.read(written(tmp_path, "cwb"), component=component)


@pytest.mark.parametrize("name", SEVERAL)
def test_several_components_are_listed_and_none_is_taken(tmp_path, name):
    path, directions = written(tmp_path, name), TWINS[name]().directions
    error = told(rk.GroundMotion.read, path)
    assert "component" in error
    assert all(direction.name in error for direction in directions)


@pytest.mark.parametrize("name", [name for name in NETWORKS if name not in ("afad", "bhrc")])
def test_stated_peak_is_that_of_the_values(tmp_path, name):
    """Another gravity moves no peak: values and peak are compared in the unit of the file."""
    path, text = written(tmp_path, name), TWINS[name]().text
    for one in read_components(opened(path), 9.80665):
        lines = text.splitlines()
        other = _other(one.peak.text, -3 if name == "usc" else -1)
        lines[one.peak.line - 1] = lines[one.peak.line - 1].replace(one.peak.text, other)
        written(tmp_path, name, "\n".join(lines))
        error = told(read_components, opened(path), GRAVITY)
        assert "stated peak" in error
        assert "stated_peak=False" in error
        assert read_components(opened(path), GRAVITY, stated_peak=False)


def _other(number: str, place: int) -> str:
    """With another digit at a place; USC's peak has two more digits than its values."""
    return number[:place] + str((int(number[place]) + 4) % 10) + number[place:][1:]


def test_velocities_behind_accelerations_are_passed_over(tmp_path):
    twin = TWINS["cosmos_v1"]()
    velocity = re.sub(r"acceleration( pts.*)sec2\(04\)", r"velocity\1sec(05)", twin.text)
    path = written(tmp_path, "cosmos_v1", twin.text + velocity)
    assert len(rk.Recording.read(path).horizontal) == 1


MORE, SPACED = "ORIENTACION C7-C12 (rumbo;orientacion)", " SPACED AT .010 SEC.  (UNITS: G)"
# twin, a pattern of its text, and what replaces it everywhere
SPELLINGS = {
    "DYNA, one letter": ("dyna", r"STREAM: HNE", "STREAM: E"),
    "DYNA, power": ("dyna", r"cm/s\^2\n", "cm/s**2\n"),
    "DYNA, no peak": ("dyna", r"(PGA_CM/S\^2:).*", r"\1"),
    "SMC, acc": ("smc", r"pk     =", "pk acc ="),
    "SMC, no peak": ("smc", r"pk     =.*", "pk     ="),
    "SMC, no name": ("smc", r"component= .*", "component="),
    "BHRC, no azimuths": ("bhrc", r"L 50    T 140", "L       T"),
    "BHRC, no rate": ("bhrc", r"1\.00000E\+02", "0.00000E+00"),
    "AFAD, English": ("afad", r"TURKIYE", "TURKEY"),
    "UNAM, letters": ("unam", r"/V/N90E/N00E", "/V;V/N90E;L/N00E;T"),
    "UNAM, plus": ("unam", r"/V/", "/+V/"),
    "UNAM, second line": ("unam", r"/V(/N90E/N00E)", rf"/V\n{MORE} :\1"),
    "CDMG, raw": ("cesmd_v1", r"(400) A.* Format.*", r"\1 POINTS OF ACCEL DATA EQUALLY" + SPACED),
    "CDMG, corrected": ("cesmd_v2", r" in (cm\S*?)\.? +\(8.*", r" (UNITS: \1)"),
    "SCSN, station": ("cesmd_v1", r"Station No\.", "Station Id."),
    "COSMOS, units": ("cosmos_v1", r"cm/sec2\(04\),Format=", "cm/sec/sec. (04)Format = "),
    "COSMOS, exponents": ("cosmos_v1", r"\(8F10.5\)", "(8E10.3E1)"),
    "COSMOS, a scale and a comma": ("cosmos_v1", r"\(8F10.5\)", "(1p,8e10.3)"),
    "COSMOS, nested": ("cosmos_v1", r"\(8F10.5\)", "(8(F10.5))"),
}  # fmt: skip


@pytest.mark.parametrize("name", SPELLINGS)
def test_other_spelling_is_the_same_motion(tmp_path, name):
    form, pattern, replacement = SPELLINGS[name]
    text, times = re.subn(pattern, replacement, TWINS[form]().text)
    assert times
    read = [read_components(opened(written(tmp_path, form, t)), GRAVITY) for t in (text, None)]
    for other, usual in zip(*read, strict=True):
        np.testing.assert_array_equal(other.acceleration, usual.acceleration)
        assert (other.dt, other.is_vertical) == (usual.dt, usual.is_vertical)
