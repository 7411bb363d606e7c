"""Quasi-static tests of stone-masonry walls by others: their sizes, strengths and envelopes.

from rockeom.analysis import identification

walls = identification.wall_tests()  # of the database of Vanin, Zaganelli, Penna and Beyer (2017)
walls["WS1.100"].strength, walls["WS1.100"].rocking_strength  # N, measured and computed
"""

import csv
import io
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.formulas.masonry import rocking_strength
from rockeom.numbers.checks import InputError, numbers, require

_TEXTS = ("wall", "reference", "reported_mode", "joints", "stone")
_SIZES = {
    "height": ("height_mm", 1e-3),
    "length": ("length_mm", 1e-3),
    "thickness": ("thickness_mm", 1e-3),
    "shear_span": ("shear_span_mm", 1e-3),
    "compressive_strength": ("fc_MPa", 1e6),
    "axial_force": ("axial_force_base_kN", 1e3),
}
_OF_BOTH_WAYS = {
    "strengths": ("V_max_pos_kN", "V_max_neg_kN", 1e3),
    "ultimate_drifts": ("drift_ult_pos_pct", "drift_ult_neg_pct", 1e-2),
    "stiffnesses": ("K_eff_pos_kN_mm", "K_eff_neg_kN_mm", 1e6),
}
"""Columns by field, each with the unit in SI; the second of a pair may be empty."""
_ENVELOPE = ("wall", "top_displacement_mm", "horizontal_force_kN")


class Envelope(NamedTuple):
    """Measured envelope, (n,) each.

    Parameters
    ----------
    displacement : ndarray
        Displacement [m], of one sign or of both.
    force : ndarray
        Force [N].
    """

    displacement: np.ndarray
    force: np.ndarray


@dataclass(frozen=True)
class _Row:
    """A line of a table."""

    where: str
    values: Mapping[str, str]

    def number(self, column: str, unit: float = 1.0, may_lack: bool = False) -> float:
        """The number in a cell, positive, in SI; nan where it may lack and does."""
        value = self.signed(column, unit, may_lack)
        require(not value <= 0, self.where, column, self.values[column], "give a positive number")
        return value

    def signed(self, column: str, unit: float, may_lack: bool = False) -> float:
        """The number in a cell, in SI."""
        text = self.values[column].strip()
        if not text and may_lack:
            return float("nan")
        try:
            value = float(text) * unit
        except ValueError:
            value = float("nan")
        require(np.isfinite(value), self.where, column, text, "give a finite number")
        return value


@dataclass(frozen=True, eq=False)
class WallTest:
    """Wall that was tested in its plane under a constant axial force, and its results.

    Parameters
    ----------
    wall : str
        Name of the wall in the source.
    reference : str
        Reference in the words of the source.
    reported_mode : str
        Mode of failure in the words of the source; one that begins with R is rocking.
    joints : str
        Joints in the words of the source.
    stone : str
        Stone in the words of the source.
    height : float
        Height [m].
    length : float
        Length [m].
    thickness : float
        Thickness [m].
    shear_span : float
        Height of zero moment above the base [m].
    compressive_strength : float
        Compressive strength of the masonry [Pa].
    axial_force : float
        Axial force at the base with the wall's weight [N].
    strengths : tuple of (float, float)
        Measured strengths in the positive and the negative direction [N], NaN where one was not
        tested.
    ultimate_drifts : tuple of (float, float)
        Measured ultimate drifts in both directions, NaN where one was not tested.
    stiffnesses : tuple of (float, float)
        Measured effective stiffnesses in both directions [N/m], of the displacement at the higher
        of the wall's top and the shear span; NaN where one was not tested.
    envelope : Envelope, optional
        Envelope of the displacement at the end of the shear span; None where there is none.
    """

    wall: str
    reference: str
    reported_mode: str
    joints: str
    stone: str
    height: float
    length: float
    thickness: float
    shear_span: float
    compressive_strength: float
    axial_force: float
    strengths: tuple[float, float]
    ultimate_drifts: tuple[float, float]
    stiffnesses: tuple[float, float]
    envelope: Envelope | None = None

    @property
    def dry(self) -> bool:
        """Whether its joints are dry, and carry no tension."""
        return self.joints == "Dry"

    @property
    def strength(self) -> float:
        """Mean of the measured strengths [N]."""
        return float(np.nanmean(self.strengths))

    @property
    def stiffness(self) -> float:
        """Mean of the measured effective stiffnesses [N/m]."""
        return float(np.nanmean(self.stiffnesses))

    @property
    def ultimate_displacement(self) -> float:
        """Mean of the ultimate drifts times the shear span [m]: of the height of the force."""
        return float(np.nanmean(self.ultimate_drifts)) * self.shear_span

    @property
    def rise(self) -> float:
        """Height of the displacement of `stiffness` over the shear span, not less than 1.

        It is 2 for a wall in double bending, of which the shear span is one half.
        """
        return max(1.0, self.height / self.shear_span)

    @property
    def level(self) -> tuple[float, ...]:
        """Axial force, strength and sizes: the same for walls that were built and loaded alike."""
        return (
            self.axial_force, self.compressive_strength, self.height, self.length, self.thickness,
            self.shear_span,
        )  # fmt: skip

    @property
    def rocking_strength(self) -> float:
        """Strength of rigid rocking on a crushed corner, `formulas.rocking_strength` [N]."""
        return float(
            rocking_strength(
                self.axial_force, self.length, self.shear_span, self.thickness,
                self.compressive_strength,
            )
        )  # fmt: skip

    def envelope_error(self, displacement: ArrayLike, force: ArrayLike) -> float:
        """Root mean square of computed less measured force, over the measured strength.

        Parameters
        ----------
        displacement : array_like
            Displacements of a computed curve from zero (m,), rising [m]; it is the same to either
            side.
        force : array_like
            Forces of the curve (m,) [N].

        Returns
        -------
        float
            Error. The mean is that over the points of the envelope, of both signs.

        Raises
        ------
        ValueError
            For a wall without an envelope, and for a curve that ends before it does.
        """
        if self.envelope is None:
            raise InputError("wall", self.wall, "WallTest.envelope_error").says(
                f"{self.wall!r} has no measured envelope"
            )
        u, f = numbers("WallTest.envelope_error", displacement=displacement, force=force)
        require(np.diff(u) >= 0, "envelope_error", "displacement", u[1:], "displacements must rise")
        measured = np.abs(self.envelope.displacement)
        rule = f"the curve must reach {measured.max():.4g} m, where the envelope ends"
        require(u[-1] >= measured.max(), "envelope_error", "displacement", u[-1], rule)
        error = np.interp(measured, u, f) - np.abs(self.envelope.force)
        return float(np.sqrt(np.mean(error**2))) / self.strength

    @classmethod
    def _of_row(cls, row: _Row, envelope: Envelope | None) -> Self:
        values: dict[str, Any] = {name: row.values[name].strip() for name in _TEXTS}
        for name, (column, unit) in _SIZES.items():
            values[name] = row.number(column, unit)
        for name, (one, other, unit) in _OF_BOTH_WAYS.items():
            values[name] = row.number(one, unit), row.number(other, unit, may_lack=True)
        return cls(**values, envelope=envelope)


def wall_tests(
    walls: str | os.PathLike[str] | None = None, envelopes: str | os.PathLike[str] | None = None
) -> dict[str, WallTest]:
    """Walls that were tested, by name, in the order of their table.

    Parameters
    ----------
    walls : path_like, optional
        File of walls with the columns of rockeom/analysis/data/stone_walls.csv, which is read if
        none is given. Units are in the names of columns: mm, MPa, kN. V_max_neg_kN,
        drift_ult_neg_pct and K_eff_neg_kN_mm may be empty.
    envelopes : path_like, optional
        File of envelopes with the columns of rockeom/analysis/data/dry_wall_envelopes.csv, which is
        read if no walls are given.

    Returns
    -------
    dict of str to WallTest
        Tests by the name of the wall.

    Raises
    ------
    ValueError
        With file and line, for a column that lacks, a cell that is no number, a wall that stands
        twice and an envelope of no wall.

    Notes
    -----
    The 24 walls that ship are those of stone masonry that their authors report as rocking, in
    plane, as cantilevers or in double bending. The envelopes are those of the fourteen with dry
    joints, of Vasconcelos (2005) and Vasconcelos and Lourenço (2009).

    References
    ----------
    F. Vanin, D. Zaganelli, A. Penna and K. Beyer, Estimates for the stiffness, strength and drift
    capacity of stone masonry walls based on 123 quasi-static cyclic tests reported in the
    literature, Bull. Earthquake Eng. 15 (2017), under the MIT licence (stone_walls_LICENSE.txt,
    next to the data); cite it where the numbers are used.

    Examples
    --------
    >>> from rockeom import analysis
    >>> tests = analysis.identification.wall_tests()
    >>> test = tests["WS1.100"]
    >>> len(tests), test.length, round(test.strength / test.rocking_strength, 2)
    (24, 1.0, 1.05)
    """
    if walls is None:
        require(envelopes is None, "wall_tests", "walls", walls, "give both files, or none")
        data = files("rockeom.analysis").joinpath("data")
        sources = [data.joinpath(n) for n in ("stone_walls.csv", "dry_wall_envelopes.csv")]
    else:
        sources = [Path(path) for path in (walls, envelopes) if path is not None]
    columns = [*_TEXTS, *(c for c, _ in _SIZES.values())]
    columns += [c for *pair, _ in _OF_BOTH_WAYS.values() for c in pair]
    rows: dict[str, _Row] = {}
    for row in _rows(sources[0].name, sources[0].read_text("utf-8-sig"), columns):
        if rows.setdefault(row.values["wall"], row) is not row:
            raise InputError("wall", row.values.get("wall"), row.where).so("it stands there twice")
    measured = {}
    if len(sources) > 1:
        measured = _envelopes(sources[1].name, sources[1].read_text("utf-8-sig"), rows)
    return {name: WallTest._of_row(row, measured.get(name)) for name, row in rows.items()}


def _envelopes(name: str, text: str, walls: Mapping[str, _Row]) -> dict[str, Envelope]:
    points: dict[str, list[tuple[float, float]]] = {}
    for row in _rows(name, text, _ENVELOPE):
        wall = row.values["wall"]
        if wall not in walls:
            raise InputError("wall", wall, row.where).choose(walls)
        point = row.signed(_ENVELOPE[1], 1e-3), row.signed(_ENVELOPE[2], 1e3)
        points.setdefault(wall, []).append(point)
    return {wall: Envelope(*np.array(of).T) for wall, of in points.items()}


def _rows(name: str, text: str, columns: Sequence[str]) -> Iterator[_Row]:
    reader = csv.DictReader(io.StringIO(text, newline=""), restval="")
    lacking = [c for c in columns if c not in (reader.fieldnames or ())]
    if lacking:
        there = ", ".join(reader.fieldnames or ()) or "none"
        raise InputError("walls", of=name).says(f"no column {lacking[0]}: there are {there}")
    for row in reader:
        where = f"{name}, line {reader.line_num}"
        if None in row:
            raise InputError("walls", of=where).says(
                "it has more cells than there are columns: quote commas"
            )
        yield _Row(where, row)
