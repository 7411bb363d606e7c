"""Files of accelerations without a column of times: the step is given."""

import numpy as np
import pytest

from rockeom.motion import GroundMotion, MotionError

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


@pytest.mark.parametrize(
    ("text", "named", "message"),
    [
        ("1 2\n3 4\n", {"dt": 0.1}, "no column of 2 is named.*name acceleration_column"),
        ("1\n2\n", {}, "time_column and dt are both given, or neither.*the time step"),
        ("1 2\n3 4\n", {"dt": 0.1, "time_column": 0}, "time_column and dt are both given"),
        ("1 2\n3 4\n", {"time_column": 0}, "name acceleration_column"),
        ("1\n2\n", {"dt": -0.1}, "dt is -0.1: give a positive number"),
        ("1\nx\n", {"dt": 0.1}, "line 2: acceleration of sample 2 is 'x', which is no number"),
    ],
)
def test_a_step_that_is_missing_double_or_wrong_is_refused(file, text, named, message):
    with pytest.raises(MotionError, match=message):
        GroundMotion.from_csv(file(text), units="g", **named)
