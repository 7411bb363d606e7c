"""Shaking-table tests of a granite boulder by others: outcomes, motions of the table, surfaces.

    from rockeom.analysis import validation

    tests = validation.BoulderTests.from_folder("boulders")
    tests.overturned["specimen_1"], tests.motion(0)

The data do not ship with the package: their authors publish them under the GPL-3 in the repository
virtual_shake_robot_pybullet of Z. Chen.
"""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

import numpy as np

from rockeom.motion import GroundMotion
from rockeom.motion.readers import read_table
from rockeom.numbers.checks import InputError, require_word

SPECIMENS = ("specimen_1", "specimen_2")
TREATMENTS = ("joined", "acceleration", "displacement")
CROSSOVER = 2.0  # [Hz] below it the displacement tells the motion, above it the acceleration
LOWEST, HIGHEST, HIGHEST_OF_DISPLACEMENT = 0.1, 25.0, 10.0  # [Hz]
RATE, KEPT = 200.0, 2  # [Hz] of the samples, and which of them are kept: each second one
ORDER = 4  # of Butterworth's filters, which run forward and backward
GRAVITY = 9.80665  # m/s2, of records in g
AROUND = 2000  # samples of rest before and after a record, in which the filters ring
OF_OTHERS = "dem: "


@dataclass(frozen=True, eq=False)
class BoulderTests:
    """Tests of one boulder in two orientations whose table motion is public, n of them.

    Parameters
    ----------
    tests : tuple of str
        Number of each test.
    records : tuple of str
        Earthquake of each test: most were run at many scales.
    folds : ndarray
        Fold of each test (n,), 0 to 4; tests of one record are in one fold.
    overturned : dict of str to ndarray
        Whether it overturned (n,), of "specimen_1" and "specimen_2".
    of_others : dict of str to dict of str to ndarray
        Outcomes (n,) that a discrete-element model of others gave, by specimen and stiffness.
    surfaces : dict of str to Path
        Closed surface of each specimen, metres, z upwards, as scanned.
    measured : tuple of tuple of (ndarray, ndarray)
        Acceleration of the table [g] and its displacement [mm] in each test, of opposite signs, 200
        a second: `motion` joins them.

    References
    ----------
    Z. Chen and others, Seismica (2024); data of the repository virtual_shake_robot_pybullet, GPL-3.
    """

    tests: tuple[str, ...]
    records: tuple[str, ...]
    folds: np.ndarray
    overturned: Mapping[str, np.ndarray]
    of_others: Mapping[str, Mapping[str, np.ndarray]]
    surfaces: Mapping[str, Path]
    measured: tuple[tuple[np.ndarray, np.ndarray], ...] = field(repr=False)

    @classmethod
    def from_folder(cls, folder: str | os.PathLike[str]) -> Self:
        """The tests of a folder with tests.csv, table_motions_200hz.npz, SP1.ply and SP2.ply.

        Parameters
        ----------
        folder : path_like
            Folder. In tests.csv the columns test, specimen_1 and specimen_2 (1: it overturned),
            record, fold and motion ("ok" where it is public) are read, and those that begin with
            "dem: ", then the number of the specimen. The archive has arrays aNNN of test NNN, the
            acceleration of the table [g], and dNNN, its displacement [mm], of opposite signs.

        Returns
        -------
        BoulderTests
            The tests with a public motion.

        Raises
        ------
        FileNotFoundError
            For a missing file.
        InputError
            For a column or an array that lacks, for outcomes other than 0 and 1, and for an
            acceleration and a displacement of two lengths.
        """
        at = Path(folder)
        surfaces = {name: at / f"SP{i + 1}.ply" for i, name in enumerate(SPECIMENS)}
        archive = at / "table_motions_200hz.npz"
        for path in (*surfaces.values(), archive, at / "tests.csv"):
            if not path.is_file():
                raise FileNotFoundError(
                    f"{path}: there is no such file. Remedy: give the folder of the boulder's tests"
                )
        table = read_table(at / "tests.csv")
        for name in ("test", *SPECIMENS, "record", "fold", "motion"):
            if name not in table.names:
                raise table.error(None, f"no column is called {name!r}", "give the file as it is")
        rows = [i for i in range(len(table.rows)) if table.text(i, "motion") == "ok"]

        def outcomes(column: str) -> np.ndarray:
            values = np.array([table.number(i, column) for i in rows])
            for i in np.flatnonzero((values != 0.0) & (values != 1.0)):
                said = f"{column} of test {table.text(rows[i], 'test')} is {values[i]:g}"
                raise table.error(rows[i], said, "give 1 where it overturned, 0 where it stood")
            return values == 1.0

        with np.load(archive, allow_pickle=False) as arrays:
            numbers = [table.text(i, "test") for i in rows]
            names = [(f"a{number:0>3}", f"d{number:0>3}") for number in numbers]
            lacks = sorted({name for pair in names for name in pair} - set(arrays.files))
            if lacks:
                raise InputError("folder", folder).says(
                    f"{archive} has no array {lacks[0]}: give the file as it is"
                )
            measured = tuple((arrays[a], arrays[d]) for a, d in names)
        for (a, d), pair in zip(names, measured, strict=True):
            shapes = [np.shape(values) for values in pair]
            if len(shapes[0]) != 1 or shapes[0] != shapes[1] or not np.isfinite(pair).all():
                raise InputError("folder", folder).says(
                    f"{a} and {d} of {archive} are no two histories of one length and of finite "
                    f"numbers, but of {shapes[0]} and {shapes[1]}: give the file as it is"
                )
        return cls(
            tests=tuple(numbers),
            records=tuple(table.text(i, "record") for i in rows),
            folds=np.array([int(table.number(i, "fold")) for i in rows]),
            overturned={name: outcomes(name) for name in SPECIMENS},
            of_others={
                name: {c: outcomes(c) for c in table.names if c.startswith(f"{OF_OTHERS}{i + 1} ")}
                for i, name in enumerate(SPECIMENS)
            },
            surfaces=surfaces,
            measured=measured,
        )

    def motion(self, test: int, treatment: str = "joined") -> GroundMotion:
        """Horizontal motion of the table in a test, 100 samples a second, below 25 Hz.

        Parameters
        ----------
        test : int
            Place of the test in `tests`.
        treatment : str, optional
            "joined": below 2 Hz the second derivative of the displacement, above the acceleration,
            by filters that add up to one. "acceleration": alone, above 0.1 Hz. "displacement":
            alone, below 10 Hz.

        Returns
        -------
        GroundMotion
            Motion [m/s2].

        Raises
        ------
        ValueError
            For another treatment.

        Notes
        -----
        The accelerometer leads the displacement by 36 degrees at 0.6 Hz, by 10 at 2 Hz and by none
        at 5 Hz (medians), as one does that does not measure slow motions. Filters are Butterworth's
        of order 4, forward and backward. The table is at rest before and after the record.
        """
        from scipy.signal import butter, sosfiltfilt  # takes long to import

        require_word("treatment", treatment, TREATMENTS, "motion")

        def passed(x: np.ndarray, corner: float, kind: str = "lowpass") -> np.ndarray:
            sos = butter(ORDER, corner, btype=kind, fs=RATE, output="sos")
            return sosfiltfilt(sos, x, padtype=None)

        def accelerations(x: np.ndarray) -> np.ndarray:
            return np.gradient(np.gradient(x, 1.0 / RATE), 1.0 / RATE)

        acceleration, displacement = self.measured[test]
        a = np.pad(np.asarray(acceleration, float) * GRAVITY, AROUND)
        u = np.pad(np.asarray(displacement, float) * -1e-3, AROUND, mode="edge")
        u -= u[0]
        if treatment == "joined":
            a += accelerations(passed(u, CROSSOVER)) - passed(a, CROSSOVER)
        elif treatment == "acceleration":
            a = passed(a, LOWEST, "highpass")
        else:
            a = accelerations(passed(u, HIGHEST_OF_DISPLACEMENT))
        kept = passed(a, HIGHEST)[AROUND:-AROUND:KEPT]
        return GroundMotion.from_array(
            kept, KEPT / RATE, name=f"{self.records[test]}, test {self.tests[test]}"
        )
