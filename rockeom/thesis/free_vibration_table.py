"""The free vibration of the wall of chapter 4, measured and by each model and restitution law.

    from rockeom.thesis.free_vibration_table import free_vibration_peaks

    for row in free_vibration_peaks():
        print(row.model, row.law, row.rms_time, row.rms_peak)

All are let go at rest at the first peak of Table A-1. Compared are its first 13 peaks, those whose
energies Figure 4-29 has; see `measured_peaks`.
"""

from typing import NamedTuple

import numpy as np

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import identification
from rockeom.structures.impact_laws import ImpactLaw

WALL = analysis.Wall.thesis()
STIFFER = 1.06
"""The factor of F_k of section 4.8.1."""
PEAKS = 13
"""How many peaks are compared, the first one included."""


class ModelPeaks(NamedTuple):
    """Peaks of one model, compared with the measured ones.

    Parameters
    ----------
    model : str
        Name of the class.
    law : str
        Restitution and other choices.
    time : ndarray
        Times of the peaks (13,) [s].
    peak : ndarray
        Peaks (13,) [m].
    rms_time : float
        Root mean square, over the 13 peaks, of the differences from the measured times [s]. The
        first peak is the start and adds nothing but its place among the 13.
    rms_peak : float
        Root mean square of the differences from the measured peaks [m].
    """

    model: str
    law: str
    time: np.ndarray
    peak: np.ndarray
    rms_time: float
    rms_peak: float

    def __str__(self) -> str:
        return f"{1e3 * self.rms_peak:.2f} mm and {1e3 * self.rms_time:.1f} ms"


def measured_peaks() -> tuple[np.ndarray, np.ndarray]:
    """First 13 peaks of Table A-1.

    Returns
    -------
    time : ndarray
        Times (13,) [s].
    peak : ndarray
        Displacements (13,) [m].

    Notes
    -----
    All 13 rows are legible as scanned. Six of the ten later peaks are in rows that are repaired or
    guessed (`FreeVibration.reading`); none of the ten counts.
    """
    table = identification.FreeVibration.table_a1()
    chosen = np.flatnonzero(table.at_peak)[:PEAKS]
    return table.time[chosen], table.displacement[chosen]


def free_vibration_peaks() -> tuple[ModelPeaks, ...]:
    """First 13 peaks of each model and restitution law compared with Table A-1, by simulation.

    The simulations take a second; before, each of the four structures is compiled once.

    Returns
    -------
    tuple of ModelPeaks
        Peaks of each model.
    """
    return tuple(released_peaks(structure, law, says) for structure, law, says in _cases())


def _cases() -> list[tuple[rk.Structure, ImpactLaw | None, str]]:
    """Each model with its impact law, if it has impacts, and its description."""
    at_speed, constant = rk.EnergyRatioAtSpeed, rk.EnergyRatio(0.88)
    oscillator, lighter = rk.ControlledWallOscillator.from_wall, WALL.mass / STIFFER
    stiffer = oscillator(WALL, 0.88, effective_mass=lighter)
    whole = oscillator(WALL, at_speed.equation_4_31(), effective_mass=lighter)
    instant = oscillator(WALL, at_speed.equation_4_31(), held=False, effective_mass=lighter)
    moving = rk.SubstituteGravityWall.from_wall(WALL)
    fixed = rk.SimplifiedSubstituteGravityWall.from_wall(WALL)
    return [
        (oscillator(WALL, 0.88), None, "r = 0.88"),
        (stiffer, None, "r = 0.88, F_k + 6 %"),
        (whole, None, "4-31, r of a whole passage, F_k + 6 %"),
        (instant, None, "4-31, r of the instant, F_k + 6 %"),
        (moving, at_speed.equation_4_38(), "4-38"),
        (fixed, constant, "r = 0.88"),
        (fixed, at_speed.equation_4_31(), "4-31"),
        (fixed, at_speed.equation_4_36(), "4-36"),
        (rk.ControlledWall.from_wall(WALL), constant, "r = 0.88"),
    ]


def let_go(
    structure: rk.Structure, duration: float, law: ImpactLaw | None = None, **initial: float
) -> rk.Response:
    """Motion of any structure from an initial state, on ground that stands still."""
    return rk.simulate(structure, rk.GroundMotion.none(duration), impact=law, initial=initial)


def from_first_peak(
    structure: rk.Structure, duration: float, law: ImpactLaw | None = None
) -> rk.Response:
    """Motion of a wall, or of its oscillator, let go from the first peak of Table A-1."""
    start = float(measured_peaks()[1][0])
    if isinstance(structure, rk.ControlledWallOscillator):
        return let_go(structure, duration, law, u=start)
    return let_go(structure, duration, law, theta=float(WALL.rotation(start)))


def released_peaks(structure: rk.Structure, law: ImpactLaw | None, says: str = "") -> ModelPeaks:
    """Peaks of a structure from the first one of Table A-1; says : its impact law, in words."""
    run = from_first_peak(structure, 1.6, law)
    t = np.linspace(0.0, float(run.t[-1]), 4001)  # between them splines are exact to 1e-9 s
    state = run.at(t)
    displacement = state["u"] if "u" in state else WALL.height * np.sin(state["theta"])
    vibration = identification.FreeVibration.from_samples(t, displacement)
    rows = np.flatnonzero(vibration.at_peak)[:PEAKS]
    time, peak = vibration.time[rows], vibration.displacement[rows]
    off = time - measured_peaks()[0], peak - measured_peaks()[1]
    errors = [float(np.sqrt(np.mean(x**2))) for x in off]
    return ModelPeaks(type(structure).__name__, says, time, peak, *errors)
