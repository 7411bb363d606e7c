"""Records read from files: what the formats allow, and how each bad file is refused."""

import os
import re
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rockeom import InputError
from rockeom.motion import GroundMotion, MotionSet
from tests.pipes import pipe
from tests.refusals import refused, refuses

TITLE = "Somewhere-01, 1/2/1999, Old Station #3, 45"
STEP_LINES = {
    "new": "NPTS=   {n}, DT=   {dt} SEC,                     ",
    "new without comma": "NPTS=  {n}, DT= {dt} SEC",
    "lower case": "npts= {n}, dt= {dt} sec",
    "without unit": "NPTS={n},DT={dt}",
    "glued unit": "NPTS={n}, DT={dt}SEC",
    "old": "  {n}    {dt}    NPTS, DT",
    "old with colon": " {n}  {dt} : NPTS, DT(SEC)",
}


def fortran(value: float, exponent: str = "E") -> str:
    """A number as Fortran prints it in 15 columns with 7 digits, without a leading zero."""
    if value == 0.0:
        return f"   .0000000{exponent}+00"
    digits, power = f"{abs(value):.6e}".split("e")
    sign = "-" if value < 0 else " "
    return f"  {sign}.{digits.replace('.', '')}{exponent}{int(power) + 1:+03d}"


def at2(
    values,
    step_line: str = "NPTS=   {n}, DT=   .0100 SEC",
    units: str = "ACCELERATION TIME SERIES IN UNITS OF G",
    exponent: str = "E",
) -> str:
    """The text of an .AT2 file."""
    fields = [fortran(value, exponent) for value in values]
    data = ["".join(fields[n : n + 5]) for n in range(0, len(fields), 5)]
    head = ["PEER NGA STRONG MOTION DATABASE RECORD", TITLE, units, step_line.format(n=len(values))]
    return "\n".join([*head, *data, ""])


def write(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def columns(t, a, form: str = "{:.2f} {:.6f}") -> str:
    return "\n".join(form.format(*row) for row in zip(t, a, strict=True)) + "\n"


TIMES = np.arange(120) * 0.01
VALUES = np.random.default_rng(3).normal(scale=0.2, size=120).round(6)


# -- .AT2 ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("step_line", STEP_LINES.values(), ids=STEP_LINES)
def test_at2_step_line_of_every_age_is_read(tmp_path, step_line):
    path = write(tmp_path, "r.AT2", at2(VALUES, step_line.replace("{dt}", ".00500")))
    motion = GroundMotion.from_at2(path)
    assert motion.dt == 0.005
    assert motion.samples == pytest.approx(9.81 * VALUES, rel=1e-6)
    assert motion.name == TITLE
    assert motion.source == f"r.AT2, line 2: {TITLE}"


@settings(max_examples=25)
@given(
    st.lists(st.floats(-2.0, 2.0).map(lambda x: float(f"{x:.6e}")), min_size=2, max_size=23),
    st.sampled_from("ED"),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.booleans(),
)
def test_at2_text_comes_back_as_it_was_written(tmp_path_factory, a, exponent, line_end, mark):
    text = at2(a, exponent=exponent).replace("\n", line_end)
    raw = (b"\xef\xbb\xbf" if mark else b"") + text.encode()
    path = write(tmp_path_factory.mktemp("at2"), "r.at2", raw)
    motion = GroundMotion.from_at2(path, gravity=1.0)
    assert np.array_equal(motion.samples, a)


def test_at2_fixed_width_fields_without_blanks_are_told_apart(tmp_path):
    head = at2([]).format(n=7).replace("NPTS=   0", "NPTS=   7")
    data = "-.1234567E-02-.5D-03 .25-.75\n-12.34567-12.34567 +.1E+01\n"
    motion = GroundMotion.from_at2(write(tmp_path, "r.AT2", head + data), gravity=1.0)
    assert np.array_equal(
        motion.samples, [-0.001234567, -0.0005, 0.25, -0.75, -12.34567, -12.34567, 1.0]
    )


def test_at2_fields_that_cannot_be_told_apart_are_refused(tmp_path):
    path = write(tmp_path, "r.AT2", at2([0.1, 0.2]) + "0.123450.23456\n")
    with pytest.raises(InputError, match=r"line 6: sample 3 is '0\.123450\.23456'.*no number"):
        GroundMotion.from_at2(path)


def test_at2_latin1_letters_in_the_header_and_a_dos_end_of_file_are_read(tmp_path):
    text = at2([0.1, 0.2]).replace("Old Station", "Caf\xe9")
    path = write(tmp_path, "r.AT2", text.encode("latin-1") + b"\x1a")
    assert GroundMotion.from_at2(path).name == "Somewhere-01, 1/2/1999, Caf\xe9 #3, 45"


@pytest.mark.parametrize("header", ["", "0.1 0.2 NPTS, DT\n"])
def test_name_of_a_file_that_is_not_utf8_is_text_wherever_it_goes(tmp_path, header):
    folder = Path(os.fsdecode(os.fsencode(tmp_path) + b"/caf\xe9"))
    folder.mkdir()
    path = Path(os.fsdecode(os.fsencode(folder) + b"/\xe9t\xe9.txt"))
    path.write_text(header.replace("0.1", "4", 1) + "0 0.1\n0.1 0.2\n")
    motion = GroundMotion.read(path, units="g")
    assert (motion.name, motion.source) == ("\xe9t\xe9", "\xe9t\xe9.txt")
    motions = MotionSet.from_folder(folder, "*.txt", units="g")
    assert (motions.name, motions.names) == ("caf\xe9", ("\xe9t\xe9",))
    with pytest.raises(InputError, match="no such file") as error:
        GroundMotion.read(f"{path}x")
    str(error.value).encode()


def test_at2_units_are_those_of_the_header(tmp_path):
    text = at2([0.0, 50.0], units="ACCELERATION TIME HISTORY IN UNITS OF CM/SEC/SEC. FILTERED")
    assert GroundMotion.from_at2(write(tmp_path, "r.AT2", text)).peak == pytest.approx(0.5)


@pytest.mark.parametrize(
    "units",
    ["ACCELERATION TIME HISTORY IN G", "Acceleration (g)", "UNITS: G", "Units = g", "ACCEL. [G]"],
)
@pytest.mark.parametrize("step_line", ["NPTS= {n}., DT= .0100 SEC", "NPTS={n}.0 , DT=1.E-2"])
def test_at2_header_of_another_writer_is_read(tmp_path, units, step_line):
    motion = GroundMotion.read(write(tmp_path, "r.AT2", at2(VALUES, step_line, units)))
    np.testing.assert_allclose(motion.samples, 9.81 * VALUES, rtol=1e-6)
    assert motion.dt == 0.01


@pytest.mark.parametrize("units", ["ACCELERATION IN ROOM 3", "Acceleration (corrected)"])
def test_at2_units_that_are_none_are_asked_for(tmp_path, units):
    with pytest.raises(InputError, match="does not say its units"):
        GroundMotion.read(write(tmp_path, "r.AT2", at2(VALUES, units=units)))


def test_at2_without_units_takes_those_of_the_caller(tmp_path):
    path = write(tmp_path, "r.AT2", at2([0.0, 0.5], units="ACCELERATION"))
    assert GroundMotion.from_at2(path, units="m/s2").peak == pytest.approx(0.5)


AT2_ERRORS = {
    "half a value": (at2(VALUES, "NPTS= {n}.5, DT= .01"), 4, "NPTS is '120.5' .* not a whole"),
    "velocity in short": (at2(VALUES, units="VELOCITY (CM/S)"), 3, "a record of velocity"),
    "cut short": (at2(VALUES)[:-50], 4, r"says 120 values, .* holds 11\d.*download it"),
    "one value too many": (at2(VALUES) + " .1E+00\n", 4, "120 values, but the file holds 121"),
    "NaN": (
        at2(VALUES).replace(fortran(VALUES[7]), "            NaN"),
        6,
        "8 is NaN.*Remedy: take",
    ),
    "infinity": (at2([0.1, 0.2]).replace(".2000000E+00", "-Inf"), 5, r"sample 2 is -Inf"),
    "overflow": (at2([0.1, 0.2]).replace(".2000000E+00", "1.0E+999"), 5, r"sample 2 is 1\.0E\+999"),
    "Fortran overflow": (
        at2([0.1, 0.2]).replace(".2000000E+00", "************"),
        5,
        r"'\*{12}'.*this",
    ),
    "text among the numbers": (at2(VALUES) + "end of record\n", 29, r"sample 121 is 'end'"),
    "underscore in a number": (at2([0.1, 0.2]).replace(".2000000E+00", "1_000"), 5, "2 is '1_000'"),
    "no DT": (at2(VALUES, "NPTS= {n}"), 4, "DT is missing: .*120'.*write the time step"),
    "DT without number": (at2(VALUES, "NPTS= {n}, DT= SEC"), 4, r"DT is missing.*DT= SEC"),
    "DT zero": (at2(VALUES, "NPTS= {n}, DT= .0000 SEC"), 4, r"DT is \.0000 s, not positive"),
    "DT negative": (at2(VALUES, "NPTS= {n}, DT= -.01"), 4, r"DT is -\.01 s, not positive"),
    "old header, DT zero": (at2(VALUES, "{n} 0.0 NPTS, DT"), 4, r"DT is 0\.0 s, not positive"),
    "DT in milliseconds": (
        at2(VALUES, "NPTS= {n}, DT= 10. MSEC"),
        4,
        "'msec'.*time step in seconds",
    ),
    "NPTS no whole number": (
        at2(VALUES, "NPTS= ****, DT= .01"),
        4,
        r"'\*{4}' .*correct the header",
    ),
    "no step line": (at2(VALUES).replace("NPTS", "POINTS"), None, "the first 28.*from_columns"),
    "velocity": (
        at2(VALUES, units="VELOCITY TIME SERIES IN UNITS OF CM/S"),
        3,
        r"this is a record of velocity, .*'VELOCITY TIME SERIES.*use the acceleration",
    ),
    "displacement": (
        at2(VALUES, units="DISPLACEMENT TIME HISTORY IN UNITS OF CM"),
        3,
        "of displacement, not",
    ),
    "no units": (at2(VALUES, units="ACCELERATION TIME SERIES"), None, "say units=, one of m/s2, g"),
    "unknown units": (
        at2(VALUES, units="ACCELERATION TIME SERIES IN UNITS OF FURLONGS"),
        3,
        r"the file states accelerations in 'FURLONGS', which is unknown.*one of m/s2",
    ),
    "empty": ("", None, r"the file is empty \(0 bytes\). Remedy: .*download"),
    "blank": ("\n \n\n", None, r"the file is empty \(4 bytes\)"),
    "web page": (
        "\n<!DOCTYPE html>\n<html><head><title>Sign in</title></head></html>\n",
        2,
        r"web page \(HTML\)",
    ),
    "binary": (b"PK\x03\x04" + bytes(range(256)), 1, r"not plain text \(byte 3\).*unpack it"),
    "UTF-16": (at2(VALUES).encode("utf-16"), 1, r"plain text \(byte 0\).*as text \(UTF-8\)"),
}


def assert_refused(read, path: Path, line: int | None, what: str, **units: str) -> None:
    """The error has the file and the line, says what is wrong with it, and a remedy."""
    with pytest.raises(InputError, match=what) as caught:
        read(path, **units)
    error = caught.value
    assert (error.file, error.line) == (path, line), str(error)
    assert error.remedy
    assert len(str(error)) < 1000


@pytest.mark.parametrize(("content", "line", "what"), AT2_ERRORS.values(), ids=AT2_ERRORS)
@pytest.mark.parametrize("reader", ["from_at2", "read"])
def test_bad_at2_file_is_refused(tmp_path, reader, content, line, what):
    path = write(tmp_path, "r.AT2", content)
    assert_refused(getattr(GroundMotion, reader), path, line, what)


@pytest.mark.parametrize("reader", ["from_at2", "read"])
def test_at2_file_without_values_is_refused_by_the_motion(tmp_path, reader):
    with refuses("acceleration"):
        getattr(GroundMotion, reader)(write(tmp_path, "r.AT2", at2([])))


@pytest.mark.parametrize(
    ("name", "quantity"), [("r.VT2", "velocity"), ("r.vt2", "velocity"), ("r.DT2", "displacement")]
)
@pytest.mark.parametrize("reader", ["from_at2", "from_columns", "read"])
def test_velocity_or_displacement_by_extension_is_refused(tmp_path, reader, name, quantity):
    path = write(tmp_path, name, at2(VALUES))
    with pytest.raises(InputError, match=rf"{name}: this is a record of {quantity}.*\.AT2"):
        getattr(GroundMotion, reader)(path)


def test_at2_units_that_contradict_the_caller_are_refused(tmp_path):
    path = write(tmp_path, "r.AT2", at2(VALUES))
    assert GroundMotion.from_at2(path, units="g") == GroundMotion.from_at2(path)
    with pytest.raises(InputError, match=r"line 3: .* in 'G', the caller in 'm/s2'.*leave units="):
        GroundMotion.from_at2(path, units="m/s2")


@pytest.mark.parametrize("reader", ["from_at2", "from_columns", "read"])
def test_missing_file_is_refused_with_the_folder_that_was_searched(reader):
    message = rf"nowhere/r\.AT2: there is no such file. Remedy: .*{re.escape(str(Path.cwd()))}"
    with pytest.raises(InputError, match=message):
        getattr(GroundMotion, reader)("nowhere/r.AT2")


def test_folder_in_place_of_a_file_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"cannot be read.*check the path"):
        GroundMotion.read(tmp_path)


# -- columns -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("form", "before"),
    [
        ("{:.2f} {:.6f}", ""),
        ("  {:.4e}\t{:.8e}", "% time, acceleration\n# of a table\n\n"),
        ("{:.2f},{:.6f}", "time,acceleration\n"),
        ("{:.2f} ; {:.6f}", '"time";"ground acceleration"\n'),
        ("{:.2f}, {:.6f},", "time, acceleration,\n"),
        ("{:.6g} {:.8g}", "Time [s]   Acc [m/s2]\n"),
        ("{:.2f}\t{:.6f}", "time (s)\tground acceleration (m/s^2)\n"),
    ],
)
@pytest.mark.parametrize("reader", ["from_columns", "read"])
def test_two_columns_of_every_make_are_read(tmp_path, reader, form, before):
    path = write(tmp_path, "quake.txt", before + columns(TIMES, VALUES, form))
    motion = getattr(GroundMotion, reader)(path, units="m/s2")
    assert motion.dt == 0.01
    assert motion.samples == pytest.approx(VALUES, abs=1e-12)
    assert (motion.name, motion.source) == ("quake", "quake.txt")


def test_units_in_the_heading_need_not_be_repeated(tmp_path):
    path = write(tmp_path, "r.csv", "time,acc (g)\n" + columns(TIMES, VALUES, "{:.2f},{:.6f}"))
    assert GroundMotion.read(path).samples == pytest.approx(9.81 * VALUES)
    with pytest.raises(InputError, match=r"r\.csv, line 1: .*in 'g', the caller in 'gal'"):
        GroundMotion.read(path, units="gal")


def test_csv_columns_are_chosen_by_name_or_number(tmp_path):
    rows = zip(range(120), TIMES, -VALUES, VALUES, strict=True)
    text = "no,time (s),up,east\n" + "\n".join("{},{:.2f},{},{}".format(*row) for row in rows)
    path = write(tmp_path, "r.csv", text)
    by_name = GroundMotion.from_csv(
        path, time_column="time (s)", acceleration_column="east", units="m/s2"
    )
    by_number = GroundMotion.from_csv(path, time_column=1, acceleration_column=3, units="m/s2")
    assert by_name == by_number
    assert by_name.samples == pytest.approx(VALUES, abs=1e-15)
    up = GroundMotion.from_csv(path, time_column=1, acceleration_column="up", units="m/s2")
    assert np.array_equal(up.samples, -by_name.samples)


def test_csv_headings_may_be_components_of_the_motion(tmp_path):
    path = write(tmp_path, "r.csv", "\ufefft,E,0deg\n0,1,2\n1,3,4\n")  # as a spreadsheet saves it
    for column, samples in (("E", [1, 3]), ("0deg", [2, 4])):
        motion = GroundMotion.from_csv(
            path, time_column="t", acceleration_column=column, units="m/s2"
        )
        assert np.array_equal(motion.samples, samples)


def test_time_that_does_not_start_at_zero_is_said_in_the_source(tmp_path):
    path = write(tmp_path, "r.txt", columns(TIMES - 5.0, VALUES))
    motion = GroundMotion.from_columns(path, units="m/s2")
    assert motion.duration == pytest.approx(1.19)
    assert motion.source == "r.txt, whose time -5 s is the start of the motion"


@pytest.mark.parametrize(
    ("dt", "form", "last_digit"),
    [
        (1 / 128, "{:.3f} {:.6f}", 1e-3),
        (1 / 256, "{:.3f} {:.6f}", 1e-3),
        (1 / 3, "{:.2f} {:.6f}", 1e-2),
        (1 / 256, "{:.6e} {:.6f}", 1e-5),
        (1 / 256, "{:.4e} {:.6f}", 1e-3),
        (1 / 256, "{} {:.6f}", 1e-8),
    ],
)
def test_rounded_times_of_a_uniform_record_are_accepted(tmp_path, dt, form, last_digit):
    a = np.random.default_rng(5).normal(size=3000)
    path = write(tmp_path, "r.txt", columns(dt * np.arange(3000), a, form))
    motion = GroundMotion.from_columns(path, units="m/s2")
    assert motion.dt == pytest.approx(dt, abs=last_digit / 2999)


def test_times_of_single_precision_are_accepted(tmp_path):
    t = (0.01 * np.arange(6000)).astype(np.float32).astype(float)
    path = write(tmp_path, "r.txt", columns(t, np.sin(t), "{:.17g} {:.17g}"))
    motion = GroundMotion.from_columns(path, units="m/s2")
    assert motion.dt == pytest.approx(0.01, rel=1e-6)


@settings(max_examples=40)
@given(
    st.integers(8, 200),
    st.data(),
    st.sampled_from([(1 / 256, 3), (0.01, 2), (0.02, 3), (1 / 128, 4), (1 / 3, 1)]),
)
def test_missing_sample_does_not_hide_behind_rounded_times(tmp_path_factory, n, data, step):
    dt, decimals = step
    gap = data.draw(st.integers(1, n - 2))
    t = np.delete(dt * np.arange(n), gap)
    text = columns(t, np.zeros(n - 1), f"{{:.{decimals}f}} {{:.1f}}")
    path = write(tmp_path_factory.mktemp("gap"), "r.txt", text)
    with pytest.raises(InputError, match=rf"r\.txt, line {gap + 1}: the time column is not unif"):
        GroundMotion.from_columns(path, units="m/s2")


def with_line(number: int, line: str) -> str:
    """The good file of two columns with one of its lines replaced (None deletes it)."""
    lines = columns(TIMES, VALUES).split("\n")
    lines[number - 1] = line
    return "\n".join(lines)


COLUMN_ERRORS = {
    "non-uniform time": (
        "\n".join([*columns(TIMES, VALUES).split("\n")[:56], "0.57 0.1", "0.58 0.1"]),
        57,
        r"the time column is not uniform: the step to 0\.57 s is 0\.02 s, "
        r"the usual step 0\.01 s. Remedy: resample",
    ),
    "two time steps": (
        columns(np.concatenate([TIMES, 1.19 + 0.0101 * np.arange(1, 200)]), np.zeros(319), "{} {}"),
        120,
        r".*up to 1\.19 s the mean step is 0\.01 s, after it 0\.0101 s.*resample",
    ),
    "time that stands still": (
        with_line(31, "0.29 0.1"),
        31,
        r"0\.29 s .* 0\.29 s of line 30.*enough digits",
    ),
    "time that falls": (with_line(31, "0.03 0.1"), 31, r"0\.03 s .* after 0\.29 s of line 30"),
    "NaN": (with_line(40, "0.39 nan"), 40, r"acceleration of sample 40 is nan"),
    "NaN time": (with_line(40, "NaN 0.1"), 40, r"time of sample 40 is NaN, not a finite"),
    "text": (with_line(12, "0.11 strong"), 12, r"acceleration of sample 12 is 'strong'"),
    "decimal comma": (
        columns(TIMES, VALUES, "{:.2f};{:.6f}").replace(".", ","),
        1,
        "'0,00', .*decimal point",
    ),
    "decimal comma and blanks": (
        columns(TIMES, VALUES).replace(".", ","),
        1,
        "3 columns .*decimal point",
    ),
    "one column": (
        "\n".join(f"{a}" for a in VALUES),
        1,
        "one column, .* give dt=0.01; see .*from_csv",
    ),
    "three columns": (
        columns(TIMES, VALUES, "{0:.2f} {1:.6f} {1:.6f}"),
        1,
        "3 columns .*name the columns .*from_csv",
    ),
    "ragged": (with_line(9, "0.08"), 9, r"1 columns, where line 1 has 2. Remedy: complete"),
    "empty": ("", None, r"the file is empty"),
    "only comments": ("# time acceleration\n", None, r"the file holds nothing but comments"),
    "only a heading": ("time acceleration\n", 1, r"no numbers follow the heading"),
    "first line spoilt": (with_line(1, "*** ***"), 1, r"time of sample 1 is '\*\*\*', which"),
    "first line without a number": (with_line(1, "nan nan"), 1, r"time of sample 1 is nan"),
    "first line with decimal commas": (
        with_line(1, "0,0E+00;0,5E-03").replace(" ", ";"),
        1,
        r"is '0,0E\+00', which",
    ),
    "two headings": (
        "time acceleration\ns m/s2\n" + columns(TIMES, VALUES),
        2,
        r"time of sample 1 is 's'",
    ),
    "one row": ("0.0 1.0\n", 1, r"one sample, where a record needs two or more"),
    "milliseconds": ("t (ms),a\n0,1\n10,2\n", 1, "'ms'.*convert the time column to seconds"),
    "web page": ("<html>\n", 1, r"web page \(HTML\)"),
}


@pytest.mark.parametrize(("content", "line", "what"), COLUMN_ERRORS.values(), ids=COLUMN_ERRORS)
@pytest.mark.parametrize("reader", ["from_columns", "read"])
def test_bad_columns_are_refused(tmp_path, reader, content, line, what):
    path = write(tmp_path, "r.txt", content)
    assert_refused(getattr(GroundMotion, reader), path, line, what, units="m/s2")


def test_columns_without_units_are_refused(tmp_path):
    path = write(tmp_path, "r.txt", columns(TIMES, VALUES))
    with pytest.raises(InputError, match=r"r\.txt: .*does not say its units.*Remedy: say units="):
        GroundMotion.from_columns(path)
    assert refused(GroundMotion.from_columns, path, units="mph") == ("units", "mph")


def test_at2_file_read_as_columns_is_told_its_reader(tmp_path):
    path = write(tmp_path, "r.txt", at2(VALUES))
    with pytest.raises(InputError, match=r"line 4: .*PEER record.*from_at2"):
        GroundMotion.from_columns(path, units="g")
    assert GroundMotion.read(path) == GroundMotion.from_at2(path)


def test_comment_that_mentions_npts_does_not_make_a_peer_record(tmp_path):
    path = write(tmp_path, "r.txt", "# made from NPTS= 120, DT= .01\n" + columns(TIMES, VALUES))
    assert len(GroundMotion.read(path, units="g").samples) == 120


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        ("north", r"r\.csv, line 1: no single column is called 'north'.*'time', 'a', 'a'.*number"),
        ("a", r"no single column is called 'a'"),
        (3, r"line 2: column 3 does not exist: there are 3. Remedy: count from 0 to 2"),
        (-1, r"column -1 does not exist"),
    ],
)
def test_column_that_is_not_there_or_not_single_is_refused(tmp_path, wanted, message):
    path = write(tmp_path, "r.csv", "time,a,a\n0,1,2\n0.1,3,4\n")
    with pytest.raises(InputError, match=message):
        GroundMotion.from_csv(path, time_column="time", acceleration_column=wanted, units="g")


# -- files of any size and shape -----------------------------------------------------------------

HEADER = at2([]).replace("NPTS=   0", "NPTS=   {n}")


def refusal(reader, path: Path, units: str | None = "g") -> str | None:
    """What is told of a file that cannot be read; no error but InputError."""
    try:
        motion = reader(path, units=units)
    except InputError as error:
        return str(error)
    assert np.isfinite(motion.segments).all()
    return None


HARD_TO_TELL_APART = {
    "numbers and commas": lambda n: ",".join(["1.25"] * n),
    "digits": lambda n: "1" * n + "x 1",
    "digits in a heading": lambda n: "-A" + "1" * n + "x t",
    "signs": lambda n: "+-" * n,
    "points": lambda n: "1." * n,
    "commas": lambda n: "," * n + "x",
    "blanks": lambda n: "1" + " " * n + ",x",
    "brackets": lambda n: "t,a" + "(" * n,
    "names with brackets": lambda n: "a[b " * n,
    "brackets and blanks": lambda n: "t a( " + " (" * n,
    "quotes": lambda n: '0,"' + '""' * n,
    "quotes and blanks": lambda n: '0,"' + '" ' * n,
    "letters": lambda n: "e" * n + " 1",
    "the header's words": lambda n: "NPTS DT IN UNITS VELOCITY TIME " * (n // 30),
}


@pytest.mark.parametrize("line", HARD_TO_TELL_APART.values(), ids=HARD_TO_TELL_APART)
def test_time_to_read_is_in_proportion_to_the_length_of_a_line(tmp_path, line):
    """Four times the letters, four times the time; a pattern that goes back takes 16 or 64."""

    def seconds(n):
        path = write(tmp_path, "r.csv", f"{line(n)}\n{line(n)}\n")
        start = time.process_time()
        for reader in (GroundMotion.read, GroundMotion.from_at2, GroundMotion.from_columns):
            assert len(refusal(reader, path) or "") < 1000
        return time.process_time() - start

    short, long = (min(seconds(n) for _ in range(3)) for n in (10_000, 40_000))
    assert long < 9 * short + 0.02


def test_time_to_read_is_in_proportion_to_the_number_of_lines(tmp_path):
    def seconds(n):
        content = columns(0.01 * np.arange(n), np.zeros(n))
        path = write(tmp_path, "r.txt", content)
        start = time.process_time()
        GroundMotion.read(path, units="g")
        return time.process_time() - start

    short, long = (min(seconds(n) for _ in range(3)) for n in (5_000, 20_000))
    assert long < 9 * short


def test_table_of_many_columns_is_refused_at_once(tmp_path):
    """Fifty lines of 2000 numbers with commas took 50 s."""
    rows = (",".join(f"{row + 0.1 * n:.2f}" for n in range(2000)) for row in range(50))
    path = write(tmp_path, "wide.csv", "\n".join(rows))
    start = time.process_time()
    with pytest.raises(InputError, match=r"wide\.csv, line 1: 2000 columns .*from_csv"):
        GroundMotion.read(path, units="g")
    motion = GroundMotion.from_csv(path, time_column=0, acceleration_column=1999, units="gal")
    assert time.process_time() - start < 5.0
    assert motion.samples == pytest.approx((np.arange(50) + 199.9) / 100)


def test_memory_to_read_is_in_proportion_to_the_file(tmp_path):
    """A table of which two columns of 41 count: its fields are not kept."""
    tracemalloc = pytest.importorskip("tracemalloc")
    rows = (",".join([f"{0.01 * n:.2f}", *["0.123456"] * 40]) for n in range(10_000))
    path = write(tmp_path, "r.csv", "\n".join(rows))
    tracemalloc.start()
    GroundMotion.from_csv(path, time_column=0, acceleration_column=1, units="g")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 10 * path.stat().st_size


def test_text_of_many_blocks_comes_back_as_it_was_written(tmp_path):
    """Rows are read some thousand at once; comments between them, and an odd last block."""
    a = np.random.default_rng(11).normal(size=9001).round(6)
    lines = columns(0.01 * np.arange(9001), a).replace("\n", "\n# next\n\n")
    motion = GroundMotion.read(write(tmp_path, "r.txt", lines), units="m/s2")
    assert np.array_equal(motion.samples, a)
    motion = GroundMotion.read(write(tmp_path, "r.AT2", at2(a)), gravity=1.0)
    assert motion.samples == pytest.approx(a, rel=1e-6)


def test_line_of_the_fault_is_told_in_a_later_block(tmp_path):
    lines = columns(0.01 * np.arange(9001), np.zeros(9001)).split("\n")
    for spoilt, message in (("79.99 x", "is 'x', which is no number"), ("79.99", "1 columns")):
        path = write(tmp_path, "r.txt", "\n".join([*lines[:7999], spoilt, *lines[8000:]]))
        with pytest.raises(InputError, match=rf"line 8000: .*{message}"):
            GroundMotion.read(path, units="g")


FOREIGN = {
    "NPTS of 5000 digits": (
        HEADER.format(n="9" * 5000) + "1 2\n",
        4,
        r"9{57}\.\.\. values, .* holds 2\.",
    ),
    "DT of 5000 digits": (
        HEADER.format(n=2).replace(".0100", "9" * 5000) + "1 2\n",
        4,
        r"DT is 9{57}\.\.\.",
    ),
    "other digits in NPTS": (HEADER.format(n="\u0662") + "1 2\n", 4, r"NPTS is .*whole number"),
    "other digits": ("0 1\n1 \u0662\n", 2, r"acceleration of sample 2 is '\u0662'"),
    "quoted field of 140 kB": (
        '0,"' + "1" * 140_000 + '"\n1,2\n',
        1,
        r"the fields of '0,\"1{54}\.\.\.' cannot be told apart .*Remedy: write plain",
    ),
    "field of 140 kB": ("0," + "1" * 140_000 + "\n1,2\n", 1, r"sample 1 is 1{57}\.\.\."),
    "line of 80 kB": (",".join(["1.2345678"] * 8000), 1, r"8000 columns .*where two are needed"),
    "line of 2 MB": ("1 " * 1_100_000, 1, r"a line of 2200000 letters, .*Remedy: break it"),
    "quotes within quotes": (
        '0,"1"2"\n1,2\n',
        1,
        r"the fields of '0,\"1\"2\"' cannot be told apart .*Remedy: write plain numbers",
    ),
    "quote that is not closed": ('0,"1\n1,2\n', 1, r"the fields of .*cannot be told apart"),
    "exponent of 22 digits": (
        "0e9999999999999999999999 1\n1 2\n",
        1,
        "0e9{22}, whose exponent no time has",
    ),
}


@pytest.mark.parametrize(("content", "line", "what"), FOREIGN.values(), ids=FOREIGN)
def test_no_error_but_that_of_the_motion(tmp_path, content, line, what):
    assert_refused(GroundMotion.read, write(tmp_path, "r.txt", content), line, what, units="g")


@pytest.mark.parametrize("path", ["a\0b.AT2", "\ud800.txt", "x" * 5000, ""])
@pytest.mark.parametrize("reader", ["from_at2", "from_columns", "read"])
def test_path_that_no_file_can_have(reader, path):
    with pytest.raises(InputError, match=r"Remedy: .*path") as caught:
        getattr(GroundMotion, reader)(path)
    assert "\0" not in str(caught.value)


@pytest.mark.parametrize("path", [5, None, b"r.AT2", [0.0, 1.0], np.zeros(3), Path, open])
@pytest.mark.parametrize("reader", ["from_at2", "from_columns", "read"])
def test_what_is_no_path(reader, path):
    with refuses("path"):
        getattr(GroundMotion, reader)(path)


@pytest.mark.parametrize("suffix", ["at2", "txt"])
def test_pipe_is_refused_at_once(tmp_path, suffix):
    with (
        pipe(tmp_path / f"record.{suffix}") as path,
        pytest.raises(InputError, match="a pipe or a device"),
    ):
        GroundMotion.read(path, units="g")


def test_file_without_an_end_is_given_up(tmp_path, monkeypatch):
    monkeypatch.setattr("rockeom.motion.formats.text._LARGEST_FILE", 2**21)
    path = write(tmp_path, "r.txt", b"0 1\n" * (2**20))
    with pytest.raises(InputError, match=r"holds more than 2097152 bytes. Remedy: cut it"):
        GroundMotion.read(path, units="g")


SEEDS = [
    "a\nb\nIN UNITS OF G\nNPTS= 3, DT= .01 SEC\n .1 -.2 .3\n",
    "a\nb\nIN UNITS OF G\n3 .01 NPTS, DT\n-.1234567E-02-.5D-03.25\n",
    "0 .1\n1 .2\n2 .3\n",
    "time (s),acc (g)\n0.0,.1\n0.1,-.2\n",
    '\ufeff"time";"a, b"\n"0";"1"\n"1";"2"\n',
]
EXTREMES = ["nan", "1e999", "0e" + "9" * 30, "9" * 5000]
PIECES = [
    *('"', '""', ",", ";", "\t", "\n", "\r", "\0", "\x1a", "\x0b", "\x85", "#", "%", "<", "-", "."),
    *("1_0", "(", ")", "[g]", "(ms)", "\u0662", "\xa0", "\ufeff", "\U0001f30d"),
    *("NPTS=", "NPTS, DT", "DT=", "IN UNITS OF CM/S2", "VELOCITY TIME SERIES"),
]


@settings(max_examples=300)
@given(st.data())
def test_spoilt_file_is_read_or_refused_with_the_error_of_the_motion(tmp_path_factory, data):
    """Words changed, bytes spoilt, the end cut off, other encodings: no other error comes up."""
    words = re.split(r"(\s+|[,;])", data.draw(st.sampled_from(SEEDS)))
    for _ in range(data.draw(st.integers(0, 4))):
        n = data.draw(st.integers(0, len(words) - 1))
        piece = data.draw(st.one_of(st.sampled_from(EXTREMES), st.sampled_from(PIECES)))
        words[n] = data.draw(st.sampled_from([piece, words[n] + piece, piece + words[n]]))
    text = "".join(words)
    raw = text.encode(data.draw(st.sampled_from(["utf-8", "utf-8", "utf-16", "utf-8-sig"])))
    if data.draw(st.booleans()):
        place = data.draw(st.integers(0, len(raw)))
        raw = raw[:place] + data.draw(st.binary(max_size=3)) + raw[place + 1 :]
    raw = raw[: data.draw(st.one_of(st.just(len(raw)), st.integers(0, len(raw))))]
    path = write(tmp_path_factory.mktemp("spoilt"), data.draw(st.sampled_from(["r", "r.AT2"])), raw)
    for reader in (GroundMotion.from_at2, GroundMotion.from_columns, GroundMotion.read):
        told = refusal(reader, path, data.draw(st.sampled_from([None, "g"])))
        assert told is None or (told.startswith(str(path)) and len(told) < 1000)


@settings(max_examples=60)
@given(
    st.lists(st.floats(-9.0, 9.0).map(lambda x: round(x, 5)), min_size=2, max_size=60),
    st.sampled_from([" ", "\t", ",", ";", " , "]),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["", "# a comment\n\n", "time (s){0}acceleration (m/s2)\n", '"t"{0}"a"\n']),
    st.sampled_from(["{:.2f}{}{:.5f}", "{:.4e}{}{:.9e}", '"{:.2f}"{}"{:.5f}"']),
)
def test_columns_come_back_as_they_were_written(
    tmp_path_factory, a, delimiter, line_end, head, form
):
    if '"' in head + form and delimiter.strip() not in (",", ";"):
        return  # quotes belong to tables with commas
    rows = "".join(form.format(0.25 * n, delimiter, x) + "\n" for n, x in enumerate(a))
    text = (head.format(delimiter) + rows).replace("\n", line_end)
    path = write(tmp_path_factory.mktemp("columns"), "r.txt", text)
    motion = GroundMotion.read(path, units="m/s2")
    assert np.array_equal(motion.samples, a)
    assert motion.dt == 0.25
