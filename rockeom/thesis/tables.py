"""Tables and lists of numbers of the thesis: as printed, and computed again.

    from rockeom.thesis.tables import TABLES, computed

    TABLES["2-1"].rows
    computed("2-1")  # the same rows; None where a cell is a measurement that no formula gives

Units are those of the page.
"""

import itertools
import math
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import formulas, identification
from rockeom.simulation.response import Response
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.thesis import printed, shaken
from rockeom.thesis.printed import TABLES, Cell, PrintedTable, Row, number

__all__ = ["TABLES", "PrintedTable", "computed"]

Columns = Mapping[str, Iterable[Any]]
"""Computed cells by the name of their column: numbers, or None where a row has none."""


def computed(number: str) -> tuple[Row, ...]:
    """Rows of a table by the formulas of `rockeom.analysis`, or by a simulation.

    Parameters
    ----------
    number : str
        Number of the table.

    Returns
    -------
    tuple of Row
        Rows, of the printed columns and of the table's `computed_columns`.

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
    table = TABLES[number]
    columns = {name: table.column(name) for name in table.names}
    columns |= {name: (None,) * len(table.rows) for name in table.measured}
    columns |= {
        name: tuple(x if x is None or isinstance(x, str) else float(x) for x in cells)
        for name, cells in _COMPUTE[number](table).items()
    }
    return tuple(zip(*columns.values(), strict=True))


def _restitution_of_blocks(table: PrintedTable) -> Columns:
    angles = (math.atan2(1.0, ratio) for ratio in table.numbers("H/B"))
    return {"r by 2-6": [formulas.energy_ratio_of_block(alpha) for alpha in angles]}


def _springs_of_mats(table: PrintedTable) -> Columns:
    """On ground of a shear modulus [Pa], Poisson's ratio and density [kg/m3], beta_z being 2.18."""
    ground = (20e6, 1 / 3, 1800.0)
    mats = (
        formulas.circular_mat(1.0, *ground),
        formulas.rectangular_mat(1.0, 1.0, 2.18, *ground),
    )
    values = (
        (m.vertical_stiffness, m.vertical_damping, m.stiffness, m.damping, m.half_spacing)
        for m in mats
    )
    return dict(zip(table.computed_columns, values, strict=True))


def _factors_of_grant(table: PrintedTable) -> Columns:
    factors = [formulas.damping.GRANT_FACTORS[str(name)] for name in table.column("model")]
    columns = {name: [getattr(f, name) for f in factors] for name in "abcdef"}
    return {**columns, "period factor at 2 s": [1 + (2 + f.c) ** -f.d for f in factors]}


def _factors_of_design(table: PrintedTable) -> Columns:
    rules = [str(name) for name in table.column("model")]
    factors = [formulas.damping.DESIGN_FACTORS[rule] for rule in rules]
    of_analysis = {"constant_damping": 0.0, "tangent_damping": 0.05}
    return {
        **{name: [getattr(f, name) for f in factors] for name in "abcd"},
        "damping by 2-35": [100 * formulas.design_damping(rule, 4.0, 2.0) for rule in rules],
        "damping by 2-33": [
            100 * formulas.grant_damping(rule, 4.0, 2.0, **of_analysis) for rule in rules
        ],
    }


def _damping_of_walls(table: PrintedTable) -> Columns:
    ratios = []
    wall_mass, added_mass, added_height, centroid = 577.56, 1438.5, 2.537, 2.173
    mass = wall_mass + added_mass
    for length, height in zip(table.numbers("length"), table.numbers("height"), strict=True):
        d, h = length / 1e3, height / 1e3
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
        ratios.append(r)
    damping = [100 * formulas.priestley_damping(r) for r in ratios]
    return {"r by 2-6": ratios, "damping by 2-16": damping}


def _forces_at_impact(table: PrintedTable) -> Columns:
    half_width, half_height = printed.BLOCK["half_width"], printed.BLOCK["half_height"]
    alpha, radius = math.atan2(half_width, half_height), math.hypot(half_width, half_height)
    release = math.radians(printed.FIGURE_3_3.numbers("rotation")[0])
    speed = formulas.impact_speed(release, alpha=alpha, radius=radius)
    horizontal, vertical = formulas.block_reactions_at_impact(
        speed, side=1, mass=printed.BLOCK["mass"], alpha=alpha, radius=radius, slender=True
    )
    forces = zip(table.numbers("baseline"), table.numbers("measured peak"), strict=True)
    return {
        "baseline": [abs(float(force)) / 1e3 for force in (vertical, horizontal)],
        "increase": [100 * (peak / baseline - 1) for baseline, peak in forces],
    }


def _scaled_motions(table: PrintedTable) -> Columns:
    sources, scales = table.column("source"), table.numbers("acceleration scale")
    before = printed.TABLE_4_2.by_row("tendon force before")
    columns = {"prestress": [before[run] for run in table.column("run")]}
    for name in ("PGA", "PGV"):
        runs = list(zip(sources, scales, table.numbers(name), strict=True))
        whole = {source: peak for source, scale, peak in reversed(runs) if scale == 1.0}
        columns[name] = [scale * whole[source] for source, scale, _ in runs]
    return columns


def _tendon_forces(table: PrintedTable) -> Columns:
    displacements = table.by_row("largest displacement").items()
    forces = (shaken.wall_of(str(run)).tendon_force(number(x) / 1e3) for run, x in displacements)
    return {"largest tendon force": [force / 1e3 for force in forces]}


def _shaken_walls(table: PrintedTable) -> Columns:
    """The measured displacement, and three columns of each model where there is a record."""
    runs = table.column("run")
    columns = {"displacement": _measured_displacements(runs)}
    for name, (simulate, law) in _MODELS.items():
        if f"displacement, {name}" in table.names:
            responses = [_if_recorded(partial(simulate, run, law)) for run in runs]
            peaks = [r if r is None else shaken.peaks_of(r) for r in responses]
            for i, (quantity, factor) in enumerate(_PEAKS.items()):
                columns[f"{quantity}, {name}"] = [peak and factor * peak[i] for peak in peaks]
    return columns


_MODELS: Mapping[str, tuple[Callable[..., Response], Any]] = {
    "SDOF": (shaken.oscillator_run, rk.EnergyRatioAtSpeed.equation_4_31()),
    "MHSG": (shaken.substitute_gravity_run, rk.EnergyRatioAtSpeed.equation_4_38()),
    "r by 4-31": (shaken.oscillator_run, rk.EnergyRatioAtSpeed.equation_4_31()),
    "constant r": (shaken.oscillator_run, 0.852),
}
"""Simulation of a run and restitution law, by the names of Tables 4-3 and 4-5."""

_PEAKS = {"displacement": 1e3, "velocity": 1.0, "acceleration": 1.0}
"""Units of a page [mm, m/s, m/s2] in one of `shaken.Peaks`."""


def _measured_displacements(runs: Iterable[Cell]) -> list[Cell]:
    measured = printed.TABLE_4_2.by_row("largest displacement")
    return [measured[run] for run in runs]


def _if_recorded(simulate: Callable[[], Response]) -> Response | None:
    """The response of a simulation; None where no record of the run is at hand."""
    try:
        return simulate()
    except rk.InputError:
        return None


def _more_prestress(table: PrintedTable) -> Columns:
    return {
        "displacement, 75 kN": _measured_displacements("234"),
        "displacement, 110 kN": _measured_displacements("789"),
    }


def _of_displacement(table: PrintedTable) -> Columns:
    wall = analysis.Wall.thesis()
    record = identification.FreeVibration.table_a1()
    uplifts = 1e3 * wall.uplift(record.displacement)
    centres = 1e3 * record.rotation_centre(wall.half_width) + 30
    return {
        "tendon force": wall.tendon_force(record.displacement) / 1e3,
        "left uplift": _where(record.displacement > 0, uplifts),
        "right uplift": _where(record.displacement <= 0, uplifts),
        "rotation centre": _where(record.at_peak, centres),
    }


def _where(chosen: np.ndarray, values: np.ndarray) -> list[Any]:
    return [value if here else None for here, value in zip(chosen, values, strict=True)]


def _energies_at_peaks(table: PrintedTable) -> Columns:
    record = identification.FreeVibration.table_a1()
    gravity, elastic, _ = record.energies(analysis.Wall.thesis())
    first = np.flatnonzero(record.at_peak)[: len(table.rows)]
    return {"time": record.time[first], "total energy": (gravity + elastic)[first]}


def _uplift_of_column(table: PrintedTable) -> Columns:
    foot, height = printed.GAUGE
    edge = 0.3
    uplifts = []
    for run, displacement in table.by_row("largest displacement").items():
        size = number(displacement) / 1e3
        if run == "2":
            arm = float(identification.rotation_centre(size))
            theta = identification.rotation_about_moving_centre(size, arm, height)
        else:
            pivot = edge if run == "4" else foot
            arm = edge + pivot
            theta = identification.rotation_from_displacement(size, pivot, height)
        uplifts.append(1e3 * arm * math.sin(theta))
    released = table.numbers("largest displacement")[:2]
    models = {"3": shaken.MODEL_A, "4": shaken.model_b()}
    displacements = [_peak_of_column(run, model) for run, model in models.items()]
    return {"largest displacement": [*released, *displacements], "largest uplift": uplifts}


def _peak_of_column(run: str, model: rk.Structure) -> float | None:
    """Displacement of a shaken column [mm], None where its record is not at hand."""
    response = _if_recorded(partial(shaken.column_run, run, model, 0.74))
    return None if response is None else 1e3 * abs(response.extremes("displacement").peak)


def _release_of_block(table: PrintedTable) -> Columns:
    release = math.radians(table.numbers("rotation")[0])
    block = rk.RigidBlock(**printed.BLOCK)
    time, theta = _free_decay(table, block, rk.AngularMomentum(), theta=release)
    return {"time": time, "rotation": [math.degrees(x) for x in theta]}


def _release_of_column(table: PrintedTable) -> Columns:
    alpha = math.atan2(printed.COLUMN["half_width"], printed.COLUMN["height"])
    release = identification.rotation_from_displacement(
        table.numbers("displacement")[0] / 1e3, *printed.GAUGE
    )
    column = rk.LumpedMassStructure(**printed.COLUMN)
    time, theta = _free_decay(table, column, rk.EnergyRatio(0.81), theta=float(release))
    gauge = [identification.displacement_from_rotation(x, *printed.GAUGE) for x in theta]
    return {
        "time": time,
        "displacement": [1e3 * float(x) for x in gauge],
        "theta/alpha_e": [x / alpha for x in theta],
    }


def _release_on_rubber(table: PrintedTable) -> Columns:
    cart = rk.TwoSpringCart(**printed.COLUMN, foundation_stiffness=550e3)
    release = table.numbers("displacement")[0] / 1e3
    time, u = _free_decay(table, cart, rk.EnergyRatio(0.74), u=release)
    return {"time": time, "displacement": [1e3 * x for x in u]}


def _free_decay(
    table: PrintedTable, structure: rk.Structure, impact: ImpactLaw, **release: float
) -> tuple[list[float], list[float]]:
    """Times and values of each peak and the zero after it, from rest: as many as the table has.

    Free motion without dissipation is symmetric in time about its peak, which so falls in the
    middle between two impacts.
    """
    ((state, first),) = release.items()
    run = rk.simulate(structure, rk.GroundMotion.none(4.0), impact=impact, initial=release)
    zeros = [event.time for event in run.impacts]
    points = [(0.0, first)]
    for before, after in itertools.pairwise(zeros):
        middle = (before + after) / 2
        points += [(before, 0.0), (middle, float(run.at(middle)[state]))]
    start = table.numbers("time")[0]
    times, values = zip(*points[: len(table.rows)], strict=True)
    return [start + time for time in times], list(values)


_COMPUTE: Mapping[str, Callable[[PrintedTable], Columns]] = MappingProxyType(
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
        "4-4": _more_prestress,
        "4-5": _shaken_walls,
        "5-1": _uplift_of_column,
        "A-1": _of_displacement,
        "Figure 3-3": _release_of_block,
        "Figure 4-29": _energies_at_peaks,
        "Figure 5-6": _release_of_column,
        "Figure 5-10": _release_on_rubber,
    }
)
