"""Tables and lists of numbers of the thesis: as printed, and computed again.

    from rockeom.thesis.tables import TABLES, computed

    TABLES["2-1"].rows
    computed("2-1")  # the same rows; None where a cell is a measurement that no formula gives

Units are those of the page. This module needs no SymPy.
"""

import itertools
import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.thesis import printed, shaken
from rockeom.thesis.printed import TABLES, Cell, PrintedTable, Row, number

__all__ = ["TABLES", "PrintedTable", "computed"]


def computed(number: str) -> tuple[Row, ...]:
    """Rows of a table by the formulas of `rockeom.analysis`, or by a simulation.

    Parameters
    ----------
    number : str
        Number of the table.

    Returns
    -------
    tuple of Row
        Rows.

    Raises
    ------
    KeyError
        For an unknown number.

    Notes
    -----
    A cell that the computation starts from is repeated; one that was measured, and that no formula
    gives, is None. The remarks of the table name the quantities from which it is computed. A
    simulation takes seconds, the first time of a structure.
    """
    if number not in _COMPUTE:
        raise KeyError(f"no table {number!r}; there are {', '.join(_COMPUTE)}")
    return tuple(_COMPUTE[number]()[: len(TABLES[number].rows)])


def _restitution_of_blocks() -> list[Row]:
    rows: list[Row] = []
    for height, width, ratio, material, *_ in printed.TABLE_2_1.rows:
        r = formulas.energy_ratio_of_block(math.atan2(1.0, number(ratio)))
        rows.append((height, width, ratio, material, None, float(r)))
    return rows


def _springs_of_mats() -> list[Row]:
    ground = (printed.MAT["modulus"], printed.MAT["poisson"], printed.MAT["density"])
    half = printed.MAT["side"] / 2
    mats = (
        formulas.circular_mat(printed.MAT["radius"], *ground),
        formulas.rectangular_mat(half, half, printed.MAT["beta"], *ground),
    )
    values = zip(
        *(
            (m.vertical_stiffness, m.vertical_damping, m.stiffness, m.damping, m.half_spacing)
            for m in mats
        ),
        strict=True,
    )
    return [
        (row[0], row[1], float(circle), row[3], float(square))
        for row, (circle, square) in zip(printed.TABLE_2_2.rows, values, strict=True)
    ]


def _factors_of_grant() -> list[Row]:
    rows: list[Row] = []
    for name, *_ in printed.TABLE_2_4.rows:
        f = formulas.damping.GRANT_FACTORS[str(name)]
        rows.append((name, f.a, f.b, f.c, f.d, f.e, f.f, 1 + (2 + f.c) ** -f.d))
    return rows


def _factors_of_design() -> list[Row]:
    rows: list[Row] = []
    for name, *_ in printed.TABLE_2_5.rows:
        f = formulas.damping.DESIGN_FACTORS[str(name)]
        damping = formulas.grant_damping(
            str(name), 4.0, 2.0, constant_damping=0.0, tangent_damping=0.05
        )
        rows.append((name, f.a, f.b, f.c, f.d, 100 * float(damping)))
    return rows


def _damping_of_walls() -> list[Row]:
    rows: list[Row] = []
    wall_mass, added_mass, added_height, centroid = 577.56, 1438.5, 2.537, 2.173
    mass = wall_mass + added_mass
    for name, length, height, prestress, *_ in printed.TABLE_2_3.rows:
        d, h = number(length) / 1e3, number(height) / 1e3
        # B-9 about a corner, the added mass standing over the middle of the wall
        wall = 686 + wall_mass / 3 * (h**2 + d**2)
        added = 442 + added_mass * (added_height**2 + (d / 2) ** 2)
        radius = math.hypot(d / 2, centroid)
        r = formulas.energy_ratio_of_block(
            math.atan2(d / 2, centroid),
            inertia=wall + added - mass * radius**2,
            mass=mass,
            radius=radius,
        )
        damping = 100 * formulas.priestley_damping(r)
        rows.append((name, length, height, prestress, None, float(r), float(damping)))
    return rows


def _forces_at_impact() -> list[Row]:
    half_width, half_height = printed.BLOCK["half_width"], printed.BLOCK["half_height"]
    alpha, radius = math.atan2(half_width, half_height), math.hypot(half_width, half_height)
    release = math.radians(number(printed.FIGURE_3_3.rows[0][1]))
    speed = formulas.impact_speed(release, alpha=alpha, radius=radius)
    horizontal, vertical = formulas.block_reactions_at_impact(
        speed, side=1, mass=printed.BLOCK["mass"], alpha=alpha, radius=radius, slender=True
    )
    rows: list[Row] = []
    for (name, baseline, peak, _), force in zip(
        printed.TABLE_3_1.rows, (vertical, horizontal), strict=True
    ):
        increase = 100 * (number(peak) / number(baseline) - 1)
        rows.append((name, abs(float(force)) / 1e3, peak, increase))
    return rows


def _scaled_motions() -> list[Row]:
    forces = printed.TABLE_4_2.by_row("tendon force before")
    whole: dict[Cell, Row] = {}
    for row in printed.TABLE_4_1.rows:
        if row[5] == 1.0:
            whole.setdefault(row[1], row)
    rows: list[Row] = []
    for run, source, date, *_, scale, time_scale, _force in printed.TABLE_4_1.rows:
        peaks = (number(scale) * number(peak) for peak in whole[source][3:5])
        rows.append((run, source, date, *peaks, scale, time_scale, forces[run]))
    return rows


def _tendon_forces() -> list[Row]:
    rows: list[Row] = []
    for run, displacement, before, *_ in printed.TABLE_4_2.rows:
        wall = analysis.Wall.thesis(initial_force=1e3 * number(before))
        force = float(wall.tendon_force(number(displacement) / 1e3)) / 1e3
        rows.append((run, displacement, before, force, None, None))
    return rows


def _shaken_walls() -> list[Row]:
    """Table 4-3."""

    at_speed = rk.EnergyRatioAtSpeed
    return _with_peaks(
        printed.TABLE_4_3,
        lambda run: shaken.oscillator_run(run, at_speed.equation_4_31()),
        lambda run: shaken.substitute_gravity_run(run, at_speed.equation_4_38()),
    )


def _shaken_walls_with_more_prestress() -> list[Row]:
    """Table 4-5."""

    return _with_peaks(
        printed.TABLE_4_5,
        lambda run: shaken.oscillator_run(run, rk.EnergyRatioAtSpeed.equation_4_31()),
        lambda run: shaken.oscillator_run(run, 0.852),
    )


def _with_peaks(table: PrintedTable, *simulations: Callable[[str], Any]) -> list[Row]:
    """Columns in threes: measured, and the peaks of two simulations where there is a record."""
    measured = printed.TABLE_4_2.by_row(_LARGEST)
    rows: list[Row] = []
    for run, *_ in table.rows:
        runs = [_if_recorded(simulate, str(run)) for simulate in simulations]
        one, other = (None if r is None else shaken.peaks_of(r) for r in runs)
        cells = itertools.chain.from_iterable(
            (None, one and factor * one[i], other and factor * other[i])
            for i, factor in enumerate((1e3, 1.0, 1.0))
        )
        rows.append((run, measured[run], *tuple(cells)[1:]))
    return rows


def _if_recorded(simulate: Callable[[str], Any], run: str) -> Any:
    """The response of a simulation; None where no record of the run is at hand."""
    try:
        return simulate(run)
    except rk.InputError:
        return None


def _measured_displacements(table: PrintedTable, *runs: tuple[str, ...]) -> list[Row]:
    """The first columns after the name by Table 4-2, one for each row of `runs`."""
    measured = printed.TABLE_4_2.by_row(_LARGEST)
    return [
        (row[0], *cells, *(None for _ in row[1 + len(cells) :]))
        for row, cells in zip(
            table.rows, zip(*((measured[r] for r in of) for of in runs), strict=True), strict=True
        )
    ]


_LARGEST = "largest displacement"


def _of_displacement() -> list[Row]:
    wall = analysis.Wall.thesis()
    record = identification.FreeVibration.table_a1()
    forces = wall.tendon_force(record.displacement) / 1e3
    uplifts = 1e3 * wall.uplift(record.displacement)
    centres = 1e3 * record.rotation_centre(wall.half_width) + 30
    rows: list[Row] = []
    for i, (event, *_, reading) in enumerate(printed.TABLE_A_1.rows):
        displacement = number(printed.TABLE_A_1.rows[i][2])
        edges = (float(uplifts[i]), None)
        left, right = edges if displacement > 0 else edges[::-1]
        centre = float(centres[i]) if event == "peak" else None
        force = float(forces[i])
        rows.append((event, None, displacement, None, None, force, left, right, centre, reading))
    return rows


def _energies_at_peaks() -> list[Row]:
    record = identification.FreeVibration.table_a1()
    gravity, elastic, _ = record.energies(analysis.Wall.thesis())
    return [
        (float(t), float(e))
        for t, e, peak in zip(record.time, gravity + elastic, record.at_peak, strict=True)
        if peak
    ]


def _uplift_of_column() -> list[Row]:

    models = {"3": shaken.MODEL_A, "4": shaken.model_b()}
    rows: list[Row] = []
    foot, height = printed.GAUGE
    edge = 0.3
    for run, description, displacement, _ in printed.TABLE_5_1.rows:
        size = number(displacement) / 1e3
        if run == "2":
            arm = float(identification.rotation_centre(size))
            theta = identification.rotation_about_moving_centre(size, arm, height)
        else:
            pivot = edge if run == "4" else foot
            arm = edge + pivot
            theta = identification.rotation_from_displacement(size, pivot, height)
        computed_displacement: Cell = displacement
        if isinstance(run, str) and run in models:
            response = _if_recorded(lambda r: shaken.column_run(r, models[r], 0.74), run)
            computed_displacement = None
            if response is not None:
                computed_displacement = 1e3 * abs(response.extremes("displacement").peak)
        rows.append((run, description, computed_displacement, 1e3 * arm * math.sin(theta)))
    return rows


def _release_of_block() -> list[Row]:

    start, release = printed.FIGURE_3_3.rows[0]
    decay = _free_decay(
        rk.RigidBlock(**printed.BLOCK),
        rk.AngularMomentum(),
        "theta",
        math.radians(number(release)),
        7,
    )
    return [(number(start) + time, math.degrees(theta)) for time, theta in decay]


def _release_of_column() -> list[Row]:

    start, displacement, _ = printed.FIGURE_5_6.rows[0]
    alpha = math.atan2(printed.COLUMN["half_width"], printed.COLUMN["height"])
    release = float(
        identification.rotation_from_displacement(number(displacement) / 1e3, *printed.GAUGE)
    )
    decay = _free_decay(
        rk.LumpedMassStructure(**printed.COLUMN), rk.EnergyRatio(0.81), "theta", release, 8
    )
    return [
        (
            number(start) + time,
            1e3 * float(identification.displacement_from_rotation(theta, *printed.GAUGE)),
            theta / alpha,
        )
        for time, theta in decay
    ]


def _release_on_rubber() -> list[Row]:

    start, displacement = printed.FIGURE_5_10.rows[0]
    cart = rk.TwoSpringCart(**printed.COLUMN, foundation_stiffness=550e3)
    decay = _free_decay(cart, rk.EnergyRatio(0.74), "u", number(displacement) / 1e3, 8)
    return [(number(start) + time, 1e3 * u) for time, u in decay]


def _free_decay(structure, impact, state: str, release: float, peaks: int):
    """(time, value) of each peak and the zero after it, from rest at `release`.

    Free motion without dissipation is symmetric in time about its peak, which so falls in the
    middle between two impacts.
    """

    run = rk.simulate(structure, rk.GroundMotion.none(4.0), impact=impact, initial={state: release})
    zeros = [event.time for event in run.impacts[:peaks]]
    points = [(0.0, release)]
    for before, after in itertools.pairwise(zeros):
        middle = (before + after) / 2
        points += [(before, 0.0), (middle, float(run.at(middle)[state]))]
    return [*points, (zeros[-1], 0.0)]


_COMPUTE: Mapping[str, Callable[[], list[Row]]] = MappingProxyType(
    {
        "2-1": _restitution_of_blocks,
        "2-2": _springs_of_mats,
        "2-3": _damping_of_walls,
        "2-4": _factors_of_grant,
        "2-5": _factors_of_design,
        "3-1": _forces_at_impact,
        "4-1": _scaled_motions,
        "4-2": _tendon_forces,
        "4-3": _shaken_walls,
        "4-4": lambda: _measured_displacements(printed.TABLE_4_4, ("2", "3", "4"), ("7", "8", "9")),
        "4-5": _shaken_walls_with_more_prestress,
        "5-1": _uplift_of_column,
        "A-1": _of_displacement,
        "Figure 3-3": _release_of_block,
        "Figure 4-29": _energies_at_peaks,
        "Figure 5-6": _release_of_column,
        "Figure 5-10": _release_on_rubber,
    }
)
