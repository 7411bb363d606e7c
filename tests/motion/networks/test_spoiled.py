"""Spoiled files of networks: the error names the line, what is wrong there, and a remedy."""

import re
from typing import NamedTuple

import pytest

from rockeom import GroundMotion
from tests.motion.networks.twins import GRAVITY, TWINS
from tests.refusals import told


class Spoiled(NamedTuple):
    """A pattern of a twin, what replaces it once, and the line (0: none) and words of the error."""

    format: str
    pattern: str
    replacement: str
    line: int
    words: str
    remedy: str = "download the file again"


OTHER = "use the acceleration record of the station"
SPOILED = [
    Spoiled("dyna", r"INTERVAL_S: 0.01", "INTERVAL_S:", 4, "SAMPLING_INTERVAL_S is ''", "plain"),
    Spoiled("dyna", r"ACCELERATION", "VELOCITY", 10, "velocity, not of acceleration", OTHER),
    Spoiled("dyna", r"cm/s\^2\n", "cm/s\n", 7, "unit is 'cm/s', and cm/s^2 belongs"),
    Spoiled("dyna", r"(?s)(.{2400}).*", r"\1", 233, "ends here, where sample 170 of 400"),
    Spoiled("dyna", r"(S\^2:).*", r"\1 0E400", 8, "stated peak of HNE is 0E400", "stated_peak="),
    Spoiled("geonet_v2a", r"points  400", "points  399", 20, "400 points, where line 10 has 399"),
    Spoiled("geonet_v2a", r"    0\.", "\t0.", 86, "a tab, where 10 values in fixed columns"),
    Spoiled("knet", r"2000\(gal\)", "2000", 14, "not GAL(gal)/COUNTS"),
    Spoiled("knet", r"Time\(s\)  4", "Time(s)  5", 67, "ends here, where count 401 of 500"),
    Spoiled("knet", r"Station Code.*\n", "", 6, "'Station Code' is expected here"),
    Spoiled("kik_net", r"(Memo.*\n) ", r"\1", 18, "where 8 counts in fixed columns have 71"),
    Spoiled("cesmd_v1", r"units of g", "units of counts", 30, "unit is 'counts', not g"),
    Spoiled("cesmd_v2", r"\(8f10.5\)", "(free)", 42, "format is '(free)', not such", "one kind"),
    Spoiled("renadic", r"G\,", "CM/S2,", 12, "should give the unit and the peak"),
    Spoiled("renadic", r"  0.050 ", "  0.060 ", 29, "times are not even: 0.06 s", "resample"),
    Spoiled("bhrc", r"/&\n", "", 68, "should give the end of the component"),
    Spoiled("bhrc", r"4\.000", "4. 000", 11, "should give points and duration"),
    Spoiled("bhrc", r"1\.00000E\+02", "1.25000E+02", 22, "125 samples a second, where line 11 has"),
    Spoiled("unam", r"/V/", "/-V/", 4, "the direction is '-V', not V or such as N90E"),
    Spoiled("knet", r"\A", "\n", 1, "the first line is blank", "delete it"),
    Spoiled("cosmos_v1", r"acceleration pts", "velocity pts", 44, "velocity, not", OTHER),
    Spoiled("cosmos_v1", r"cm/sec2\(04\)", "counts(50)", 44, "a record of raw counts", OTHER),
    Spoiled("cosmos_v1", r"cm/sec2\(04\)", "cm/sec2(02)", 44, "cm/sec2 (02), and not", "in units"),
    Spoiled("smc", r"2 CORRECTED ACCELER.*", "5 SPECTRA", 1, "response spectra", OTHER),
    Spoiled("usc", r"CORRECTED ACC", "UNCORRECTED ACC", 1, "uncorrected", "take the corrected one"),
    Spoiled("cwb", r"gal", "count", 8, "the unit is 'count', not gal"),
    Spoiled("cwb", r"\n     0.050", "\n     0.500", 19, "0.5 s, 0.45 s off the 100 samples"),
    Spoiled("cwb", r"#SampleRate.*\n", "", 0, "should give SampleRate(Hz): none does"),
    Spoiled("afad", r"N-S  (.*)E-W  ", r"E-W  \1N-S  ", 18, "the columns, N-S E-W U-D"),
    Spoiled("afad", r"\Z", "   1.0\n", 419, "'1.0' follows the last value", "file of one record"),
    Spoiled("unam", r"/400/400/400", "/400/400/399", 8, "channels differ here, 400, 400, 399"),
    Spoiled("unam", r": Gal \(cm/s/s\)", ": Cuentas", 10, "the unit is 'Cuentas', not Gal"),
    Spoiled("peer", r"\.0100", ".010+0", 4, "DT is missing", "time step in seconds"),
]


@pytest.mark.parametrize("one", SPOILED, ids=lambda one: f"{one.format}: {one.words}")
def test_error_names_line_cause_and_remedy(tmp_path, one):
    text, times = re.subn(one.pattern, one.replacement, TWINS[one.format]().text, count=1)
    assert times == 1
    path = tmp_path / "record.txt"
    path.write_text(text, encoding="utf-8")
    error = told(GroundMotion.read, path, component=1, gravity=GRAVITY)
    at = f"record.txt, line {one.line}: " if one.line else "record.txt: "
    assert at in error
    assert one.words in error
    assert one.remedy in error.partition("Remedy: ")[2]


def test_rows_beyond_those_counted_are_left_out_with_a_warning(tmp_path):
    path, text = tmp_path / "more.txt", TWINS["unam"]().text
    path.write_text(text + text.splitlines()[-1] + "\n")
    with pytest.warns(UserWarning, match=r"more.txt: the header counts 400 rows, and 1 more from"):
        motion = GroundMotion.read(path, component="V")
    assert motion.samples is not None
    assert len(motion.samples) == 400
