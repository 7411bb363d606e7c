"""Files of accelerations without a column of times: the step is given."""

import numpy as np
import pytest

from rockeom import InputError
from rockeom.motion import GroundMotion

VALUES = [0.0, 0.1, -0.25, 0.05]


@pytest.fixture
def file(tmp_path):
    def written(text: str):
        path = tmp_path / "record.txt"
        path.write_text(text, encoding="utf-8")
        return path

    return written


def test_one_column_is_the_array_of_its_numbers(file):
    path = file("# digitised\n" + "\n".join(map(str, VALUES)))
    motion = GroundMotion.from_csv(path, dt=0.02, units="g")
    expected = GroundMotion.from_array(VALUES, 0.02, units="g")
    assert np.array_equal(motion.segments, expected.segments)
    assert motion.dt == 0.02


def test_one_column_of_several_by_its_heading_that_says_the_unit(file):
    path = file("n,ns (cm/s2),ew (cm/s2)\n1,1.0,4\n2,3.0,5\n3,2.0,6\n")
    motion = GroundMotion.from_csv(path, acceleration_column="ew (cm/s2)", dt=0.5)
    assert motion.samples == pytest.approx([0.04, 0.05, 0.06])


SEQUENCE = np.round(np.sin(0.2 * np.arange(160)) + 0.3 * np.sin(0.5 * np.arange(160)), 6)


def rows_of(values: np.ndarray, width: int, separator: str = " ") -> str:
    starts = range(0, len(values), width)
    return "\n".join(separator.join(f"{x:.6f}" for x in values[i : i + width]) for i in starts)


@pytest.mark.parametrize("separator", [" ", ",", "\t"])
@pytest.mark.parametrize(("width", "number"), [(2, 160), (5, 160), (8, 160), (8, 157), (160, 160)])
def test_values_that_run_on_over_columns_are_asked_for(file, width, number, separator):
    path = file("# a\n" + rows_of(SEQUENCE[:number], width, separator))
    wrapped = GroundMotion.from_csv(path, dt=0.02, units="g", layout="wrapped")
    assert np.array_equal(wrapped.samples, SEQUENCE[:number] * 9.81)
    for column in (None, 0, width - 1):
        with pytest.raises(InputError, match='layout="wrapped"'):
            GroundMotion.from_csv(path, dt=0.02, units="g", acceleration_column=column)


def test_channels_side_by_side_are_no_sequence_and_what_looks_like_one_may_be_channels(file):
    channels = np.column_stack([SEQUENCE, 0.4 * SEQUENCE[::-1], SEQUENCE**2])
    path = file(rows_of(channels.ravel(), 3))
    one = GroundMotion.from_csv(path, dt=0.02, units="m/s2", acceleration_column=1)
    assert one.samples == pytest.approx(channels[:, 1], abs=1e-6)
    path = file(rows_of(SEQUENCE, 8))
    every = {"dt": 0.16, "units": "m/s2", "acceleration_column": 2, "layout": "columns"}
    assert np.array_equal(GroundMotion.from_csv(path, **every).samples, SEQUENCE[2::8])


@pytest.mark.parametrize(
    ("text", "named", "message"),
    [
        ("1 9\n2 8\n", {"dt": 0.1}, "no column of 2 is named.*name it by acceleration_column="),
        ("1\n2\n", {}, "time_column and dt are both given, or neither.*the time step"),
        ("1 2\n3 4\n", {"dt": 0.1, "time_column": 0}, "time_column and dt are both given"),
        ("1 2\n3 4\n", {"time_column": 0}, "name it by acceleration_column="),
        ("1\n2\n", {"dt": -0.1}, "dt is -0.1: give a positive number"),
        ("1\nx\n", {"dt": 0.1}, "line 2: acceleration of sample 2 is 'x', which is no number"),
        ("1 2\n3 x\n", {"dt": 0.1, "layout": "wrapped"}, "line 2: sample 4 is 'x', which is no"),
        ("1 2\n3\n4 5\n", {"dt": 0.1, "layout": "wrapped"}, "line 3: 3 values stand above.*has 2"),
        ("1 2\n", {"time_column": 0, "layout": "wrapped"}, "no columns to name.*give dt=, and no"),
        ("1 2\n", {"dt": 0.1, "layout": "rows"}, "layout is 'rows': choose \"columns\" or"),
    ],
)
def test_a_step_that_is_missing_double_or_wrong_is_refused(file, text, named, message):
    with pytest.raises(InputError, match=message):
        GroundMotion.from_csv(file(text), units="g", **named)
