"""Figures of the shaking-table tests of the wall of chapter 4, in kind, by the records intended.

The motions of the table and the traces are lost. El Centro 180 (runs 1, 2 and 7) and Sylmar 360
(runs 4 and 9) are at hand, Tabas and Llolleo (runs 3, 6 and 8) are not. Simulated is the wall by
4-27 (SDOF) and by 4-40 (MHSG), as for Tables 4-3 and 4-5; of the tests, Table 4-2 has the largest
displacements and tendon forces.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics, formulas, identification
from rockeom.plots import style
from rockeom.simulation.response import Response
from rockeom.thesis import shaken
from rockeom.thesis.figures.chapter_4_shaken import CYCLES, forces_when_still
from rockeom.thesis.figures.chapter_4_spectra import NOISE, RATE
from rockeom.thesis.figures.chapter_4_wall import MM, overview_and_origin, symmetric
from rockeom.thesis.figures.drawn import Drawn, Source, Statement, thesis_figure
from rockeom.thesis.free_vibration_table import STIFFER, WALL
from rockeom.thesis.printed import TABLE_4_1, TABLE_4_2, TABLE_4_3

NAMES = {"1": "El Centro 180, half", "2": "El Centro 180", "4": "Sylmar 360 in 0.6 of its time"}
ROCKING_PERIODS = (0.10, 0.24)
"""Period of the wall, section 4.4 [s]."""


def printed_peak(run: str) -> float:
    """Largest acceleration of the table, Table 4-1 [m/s2]."""
    return float(next(row[3] for row in TABLE_4_1.rows if row[0] == run) or 0.0)


def measured_peak(run: str) -> float:
    """Displacement of largest size in a test, Table 4-2 [m]."""
    return 1e-3 * float(next(row[1] for row in TABLE_4_2.rows if row[0] == run) or 0.0)


# --- the motions


@cache
def spectrum(run: str) -> dynamics.ResponseSpectrum:
    """Spectrum of the intended motion, damped by 5 %."""
    return analysis.response_spectrum(shaken.wall_motion(run), np.geomspace(0.03, 3.0, 120))


def nzs_1170_5(period: np.ndarray, hazard: float = 0.7) -> np.ndarray:
    """Elastic spectrum of NZS 1170.5 (2004) on very soft soil (class E) [m/s2].

    period (n,) [s]. hazard: Z R, at most 0.7. The shape factor is that of its commentary; far from
    a fault.
    """
    t = np.asarray(period)
    shape = np.select(
        [t < 0.1, t < 1.0, t < 1.5, t < 3.0],
        [1.12 + 18.8 * t, 3.0, 3.0 / t**0.75, 3.32 / t],
        9.96 / t**2,
    )
    return np.asarray(shaken.G * hazard * shape)


def draw_spectrum(ax: Axes, run: str, label: str, factor: float = 1.0, **look: object) -> None:
    curve = spectrum(run)
    ax.plot(curve.periods, factor * curve.pseudo_acceleration, label=label, **look)  # type: ignore[arg-type]


@thesis_figure(Source.IN_KIND)
def figure_4_6() -> Drawn:
    """Response spectrum of test run 2: the motion intended, and the same at the table's peak.

    The motion that the table made is lost; of it the peak is printed. Dashed is the record scaled
    to that peak: the table cannot be distinguished from it. The damping is 5 %, as in the appendix.
    """
    motion = shaken.wall_motion("2")
    factor = printed_peak("2") / motion.peak
    figure = style.new_figure(5.6, 3.4)
    ax = figure.add_subplot()
    draw_spectrum(ax, "2", "intended: El Centro 180")
    draw_spectrum(ax, "2", "intended, at the peak of the table", factor, ls="--")
    ax.axvspan(*ROCKING_PERIODS, color=style.LINES[4], alpha=0.25, lw=0)
    ax.set_xlim(0, 3)
    ax.set_ylim(0, None)
    ax.set_xlabel("period [s]")
    ax.set_ylabel(r"spectral acceleration [m/s$^2$]")
    ax.legend()
    others = {run: printed_peak(run) / shaken.wall_motion(run).peak - 1 for run in ("1", "4", "9")}
    deviations = {"2": factor - 1, **others}
    return Drawn(
        figure,
        (
            Statement(
                "section 4.4",
                "the peaks of the table are often inconsistent with those of the earthquakes",
                "the table's peak over the record's: "
                + ", ".join(f"run {run} {100 * x:+.1f} %" for run, x in sorted(deviations.items())),
                bool(max(abs(x) for x in deviations.values()) > 0.05),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_4_7() -> Drawn:
    """Response spectra of the tests and the elastic design spectrum of NZS 1170.5.

    Spectra of the motions intended, damped by 5 %, without those of Tabas and Llolleo, which are
    not at hand. The design spectrum is that of NZS 1170.5 for soil class E with Z R = 0.7, its
    largest value; the thesis prints no number of it. The band holds the rocking periods.
    """
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    runs = {"1": "run 1", "2": "runs 2, 7", "4": "runs 4, 9"}
    for run, label in runs.items():
        draw_spectrum(ax, run, f"{label}: {NAMES[run]}")
    t = spectrum("2").periods
    ax.plot(t, nzs_1170_5(t), color=style.INK, lw=1.5, label="NZS 1170.5, class E, Z R = 0.7")
    ax.axvspan(*ROCKING_PERIODS, color=style.LINES[4], alpha=0.25, lw=0)
    ax.set_xscale("log")
    ax.set_xlim(t[0], t[-1])
    ax.set_ylim(0, 32)
    ax.set_xticks([0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
    ax.set_xlabel("period [s]")
    ax.set_ylabel(r"spectral acceleration [m/s$^2$]")
    ax.legend(loc="upper right", fontsize=7.5)
    inside = (t >= ROCKING_PERIODS[0]) & (t <= ROCKING_PERIODS[1])
    ratio = {run: spectrum(run).pseudo_acceleration[inside] / nzs_1170_5(t[inside]) for run in runs}
    said = ", ".join(f"run {run} {x.min():.2f} to {x.max():.2f}" for run, x in ratio.items())
    return Drawn(
        figure,
        (
            Statement(
                "section 4.4",
                "from 0.10 to 0.24 s all but El Centro are near or in excess of the design level",
                f"over the design spectrum there: {said}",
                bool(ratio["4"].max() > 0.8 and ratio["2"].max() < 0.8),
            ),
        ),
    )


# --- moving windows


def oscillator_run(run: str) -> Response:
    """Motion by 4-27 with r of 4-31."""
    return shaken.oscillator_run(run, rk.EnergyRatioAtSpeed.equation_4_31())


def substitute_run(run: str) -> Response:
    """Motion by 4-40 with r of 4-38."""
    return shaken.substitute_gravity_run(run, rk.EnergyRatioAtSpeed.equation_4_38())


def displacement(run: Response, time: np.ndarray) -> np.ndarray:
    """Displacement of the point at height H (n,) [m]."""
    state = run.at(time)
    if "theta" in run.states:
        return np.asarray(run.structure.parameters()["height"] * np.sin(state["theta"]))
    return np.asarray(state["u"])


@cache
def windows(run: str) -> tuple[analysis.MeasuredRecord, identification.MovingWindow]:
    """A run of 4-27 as a test would have recorded it, and its transfer functions."""
    simulated = oscillator_run(run)
    t = np.arange(int(simulated.t[-1] * RATE)) / RATE
    u = displacement(simulated, t) + np.random.default_rng(0).normal(0.0, NOISE, len(t))
    record = analysis.MeasuredRecord(
        t, {"displacement": u, "table": shaken.wall_motion(run).acceleration(t)}
    )
    return record, identification.moving_window(
        record, "displacement", "table", segments=2, beta=2.0, frequencies=(1.0, 15.0)
    )


def draw_windows(run: str, until: float) -> tuple[Figure, np.ndarray]:
    """The trace and its spectrogram; the largest frequency of the windows that are shaken (n,)."""
    record, moving = windows(run)
    figure = style.new_figure(7.2, 4.8)
    trace, ax = figure.subplots(2, 1, sharex=True, height_ratios=(1.0, 1.6))
    trace.plot(record.time, record["displacement"] * MM, lw=0.7)
    trace.set_ylabel(r"displacement $\Delta$ [mm]")
    ax.pcolormesh(moving.time, moving.frequency, moving.amplitude.T, cmap="Greys", rasterized=True)
    ax.plot(moving.time, moving.dominant, ".", ms=2, color=style.LINES[1], label="largest")
    ax.set_xlabel("time, middle of the window [s]")
    ax.set_ylabel("frequency [Hz]")
    ax.grid(visible=False)
    ax.set_xlim(0, until)
    style.legend_above(ax, markerscale=4)
    table = np.abs(np.interp(moving.time, record.time, envelope(record)))
    strong = (table > 0.1 * table.max()) & (moving.time < until)
    return figure, moving.dominant[strong]


def envelope(record: analysis.MeasuredRecord) -> np.ndarray:
    """Mean size of the table's acceleration about each instant, over the length of a window."""
    samples = round(0.43 * RATE)
    return np.convolve(np.abs(record["table"]), np.ones(samples) / samples, mode="same")


def between(values: np.ndarray, low: float, high: float) -> float:
    """Part of the values in an interval, in percent."""
    return 100 * float(np.mean((values >= low) & (values <= high)))


def of_el_centro(run: str, until: float) -> Drawn:
    figure, dominant = draw_windows(run, until)
    low, high = np.percentile(dominant, [10, 90])
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.1",
                "under El Centro the frequency fluctuates widely, from 7 to 12 Hz",
                f"four fifths of the shaken windows from {low:.1f} to {high:.1f} Hz, "
                f"{between(dominant, 7, 12):.0f} % of them between 7 and 12 Hz",
                bool(between(dominant, 7, 12) > 50),
            ),
            Statement(
                "section 4.9.1",
                "smooth rocking, at 3 to 5 Hz, was rarely initiated",
                f"{between(dominant, 3, 5):.0f} % of the shaken windows",
                bool(between(dominant, 3, 5) < 20),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_4_52() -> Drawn:
    """Moving window on test run 1: half of El Centro 180.

    Simulated by 4-27 with r of 4-31 and sampled as the tests were, 200 times a second, with noise
    of 0.05 mm. Beta and segments are not stated: with one segment, as in Figure 4-50, the quotient
    is largest wherever this record has a gap in its spectrum, so that there are two, beta is 2, and
    frequencies above 15 Hz are left out; the bandwidth is 3.7 Hz. With one to three segments and
    beta 2 or 6, from 39 to 74 % of the windows of runs 1 and 2 are between 7 and 12 Hz. Windows
    count as shaken where the table has more than a tenth of its largest mean acceleration. The
    oscillator cannot bend: its high frequencies are those of small turns about the middle.
    """
    return of_el_centro("1", 30.0)


@thesis_figure(Source.IN_KIND)
def figure_4_53() -> Drawn:
    """Moving window on test run 2: El Centro 180.

    As Figure 4-52. The caption is lost; the text has Figures 4-52 to 4-56 for the runs in order.
    """
    return of_el_centro("2", 30.0)


@thesis_figure(Source.IN_KIND)
def figure_4_55() -> Drawn:
    """Moving window on test run 4: Sylmar 360 in 0.6 of its time.

    As Figure 4-52, with the record that was meant in place of the table's own motion.
    """
    figure, dominant = draw_windows("4", 15.0)
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.1",
                "clear rocking under Northridge, with peaks between 3 and 5 Hz",
                f"{between(dominant, 3, 5):.0f} % of the shaken windows between 3 and 5 Hz, "
                f"{between(dominant, 7, 12):.0f} % between 7 and 12 Hz",
                bool(between(dominant, 3, 5) > 10),
            ),
        ),
    )


# --- histories


def draw_run(ax: Axes, run: str, start: float, end: float) -> None:
    t = np.arange(start, end, 2e-3)
    peak = measured_peak(run) * MM
    ax.plot(t, displacement(oscillator_run(run), t) * MM, lw=0.9, label="SDOF, 4-27")
    ax.plot(t, displacement(substitute_run(run), t) * MM, lw=0.9, label="MHSG, 4-40")
    ax.axhline(peak, color=style.INK, lw=0.9, ls=":", label="measured peak")
    ax.set_xlim(start, end)
    ax.set_xlabel("time [s]")
    ax.set_ylabel(r"displacement $\Delta$ [mm]")
    style.legend_above(ax)


def peak_statements(run: str) -> tuple[Statement, Statement]:
    """Printed peaks of Table 4-3 and the simulated ones; as sizes, to a quarter."""
    row = next(row for row in TABLE_4_3.rows if row[0] == run)
    said = []
    for name, printed, simulated in (
        ("SDOF", float(row[2] or 0.0), oscillator_run(run)),
        ("MHSG", float(row[3] or 0.0), substitute_run(run)),
    ):
        peak = shaken.peaks_of(simulated).displacement * MM
        near = bool(abs(abs(peak) - abs(printed)) < 0.25 * abs(printed))
        said.append(Statement(
            "Table 4-3", f"run {run} by {name}: a largest displacement of {printed:.2f} mm",
            f"{peak:.2f} mm under the intended record", near,
        ))  # fmt: skip
    return said[0], said[1]


@thesis_figure(Source.IN_KIND)
def figure_4_66() -> Drawn:
    """Test run 2, El Centro 180, simulated by 4-27 and by 4-40.

    The measured trace is lost; its largest displacement, Table 4-2, is the dotted line. r is
    that of 4-31 for the oscillator and of 4-38 for substitute gravity.
    """
    figure = style.new_figure(7.2, 3.2)
    draw_run(figure.add_subplot(), "2", 0.0, 30.0)
    return Drawn(figure, peak_statements("2"))


@thesis_figure(Source.IN_KIND)
def figure_4_67() -> Drawn:
    """Test run 4, Sylmar 360 in 0.6 of its time, simulated by 4-27 and by 4-40.

    As Figure 4-66. Under the record that was meant neither comes near the measured peak.
    """
    figure = style.new_figure(7.2, 3.2)
    draw_run(figure.add_subplot(), "4", 0.0, 15.0)
    return Drawn(figure, peak_statements("4"))


@thesis_figure(Source.IN_KIND)
def figure_4_68() -> Drawn:
    """Test run 4 while it moves most, by 4-27 and by 4-40: part of Figure 4-67.

    Which part the thesis shows is not stated; here it is two seconds about the largest
    displacement by 4-40.
    """
    t = np.arange(0.0, 15.0, 2e-3)
    one, other = displacement(oscillator_run("4"), t), displacement(substitute_run("4"), t)
    middle = float(t[np.abs(other).argmax()])
    start, end = middle - 1.0, middle + 1.0
    figure = style.new_figure(5.6, 3.2)
    draw_run(figure.add_subplot(), "4", start, end)
    inside = (t > start) & (t < end)
    alike = float(np.corrcoef(one[inside], other[inside])[0, 1])
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.1.3",
                "during moderate rocking both procedures track the test excellently",
                f"with each other they correlate by {alike:.2f}; the measured trace is lost",
                None,
            ),
        ),
    )


# --- sensitivity, section 4.9.1.5

HARMONIC = (5.88, 8.0)
"""Amplitude [m/s2] and frequency [Hz] of Figure 4-72."""


@cache
def settled() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, velocity and speeds when upright of the last cycles, under `HARMONIC`."""
    amplitude, frequency = HARMONIC
    wall = rk.ControlledWallOscillator.from_wall(WALL, 0.852, effective_mass=WALL.mass / STIFFER)
    duration = (CYCLES + 40) / frequency
    motion = rk.GroundMotion.harmonic(amplitude, period=1 / frequency, duration=duration)
    run = rk.simulate(wall, motion, options=rk.SolverOptions(rtol=1e-9, atol=1e-11))
    last = run.at(np.linspace(duration - 4 / frequency, duration, 1601))
    late = [e.before for e in run.events if e.time > CYCLES / frequency]
    speeds = np.array([s["u_dot"] for s in late if abs(s["u"]) < 1e-9])
    return last["u"], last["u_dot"], speeds


@thesis_figure(Source.COMPUTED)
def figure_4_72() -> Drawn:
    """Phase diagram of the oscillator under 5.88 sin(16 pi t), when it has settled.

    From rest, after 120 cycles of the ground, four cycles; r = 0.852. The oscillator is that of
    4-37. The equation of the text has M_e Z sin(16 pi t), so that P_e of the caption is for a unit
    of mass. Dots are passages through upright, the points of Figure 4-73.
    """
    u, v, speeds = settled()
    figure = style.new_figure(4.6, 3.6)
    ax = figure.add_subplot()
    ax.plot(u * MM, v, lw=1.0)
    ax.plot(np.zeros_like(speeds), speeds, "o", ms=4, color=style.LINES[1])
    ax.axvline(0.0, color=style.INK, lw=0.5)
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel(r"velocity $\dot\Delta$ [m/s]")
    distinct = len(np.unique(np.round(speeds, 6)))
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.1.5",
                "for Z from 5.7 to 6.0 m/s2 a periodic motion that passes upright twice a cycle",
                f"{distinct} different velocities when upright in 40 cycles, at most "
                f"{np.abs(speeds).max():.3f} m/s, {np.abs(u).max() * MM:.1f} mm",
                bool(distinct == 2),
            ),
        ),
    )


BESIDE = 0.1e-3
"""How far from upright the second of two runs begins [m]."""


@thesis_figure(Source.IN_KIND)
def figure_4_74() -> Drawn:
    """The same motion twice, the wall once upright and once 0.1 mm from it.

    The two tests are lost, runs 18 and 19 of another study with the same motion and prestress; what
    was different in them is not known. In kind is test run 4 by 4-27 with r of 4-31, from upright
    and from 0.1 mm next to it: after a test up to 0.7 mm were left (Table 4-2).
    """
    first = oscillator_run("4")
    again = rk.simulate(first.structure, first.motion, initial={"u": BESIDE})
    t = np.arange(0.0, 15.0, 2e-3)
    one, other = displacement(first, t), displacement(again, t)
    figure = style.new_figure(7.2, 3.2)
    ax = figure.add_subplot()
    ax.plot(t, one * MM, lw=0.9, label="from upright")
    ax.plot(t, other * MM, lw=0.9, label="from 0.1 mm next to it")
    ax.set_xlim(0, 15)
    ax.set_xlabel("time [s]")
    ax.set_ylabel(r"displacement $\Delta$ [mm]")
    style.legend_above(ax)
    apart = float(np.abs(one - other).max())
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.1.5",
                "extreme sensitivity: two tests with the same motion differ",
                f"begun {BESIDE * MM:g} mm apart they come {apart * MM:.2f} mm apart; the largest "
                f"displacements are {np.abs(one).max() * MM:.2f} and "
                f"{np.abs(other).max() * MM:.2f} mm",
                bool(apart > 5 * BESIDE),
            ),
        ),
    )


# --- tests with 110 kN, section 4.9.2

MORE = analysis.Wall.thesis(111e3)
GROUPS = (("75 kN", ("1", "2", "3", "4", "6"), "o"), ("110 kN", ("7", "8", "9"), "s"))


def read_from_tendon(runs: tuple[str, ...]) -> dict[str, np.ndarray]:
    """Rotation centre and uplift by the largest displacement and tendon force of tests.

    The extension of the tendon by its stiffness places the rotation centre; both maxima count as
    simultaneous. Returns displacement and force [m, N], the distance of the centre from the
    edge and the edge's uplift [m]; (n,) each.
    """
    rows = [row for row in TABLE_4_2.rows if row[0] in runs]
    d, before, force = np.array([row[1:4] for row in rows], dtype=float).T * [[1e-3], [1e3], [1e3]]
    extension = (force - before) / MORE.tendons[0].stiffness
    turn = np.tan(MORE.rotation(np.abs(d)))
    beside = extension / turn  # of the tendon, in the middle
    half = MORE.half_width
    return {
        "displacement": d,
        "force": force,
        "from_edge": half - beside,
        "uplift": (beside + half) * turn,
    }


def draw_read(ax: Axes, quantity: str, unit: float) -> None:
    for (label, runs, mark), color in zip(GROUPS, (style.INK, style.LINES[1]), strict=True):
        values = read_from_tendon(runs)
        ax.plot(
            np.abs(values["displacement"]) * MM, values[quantity] / unit, mark, color=color, ms=5,
            mfc="white" if mark == "o" else color, zorder=5, label=f"tests with {label}",
        )  # fmt: skip
    ax.set_xlabel(r"displacement $|\Delta|$ [mm]")


@thesis_figure(Source.IN_KIND)
def figure_4_75() -> Drawn:
    """Distance of the rotation centre from the edge: 4-7, and what Table 4-2 says of the tests.

    The uplifts measured are lost. The points follow from the largest tendon force and displacement
    of each test, as the tendon's extension is the uplift of the middle: where bending or sliding
    is part of the displacement, the centre comes out too near the middle. 4-7 is drawn as seen
    from the edge, 442 and 66 mm, and as printed, from the gauge.
    """
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    d = np.linspace(0.0, 0.03, 600)
    edge, gauge = formulas.RotationCentre.thesis_edge(), formulas.RotationCentre.thesis_gauge()
    ax.plot(d * MM, edge.distance_from_edge(d) * MM, label="4-7 from the edge")
    ax.plot(d * MM, gauge.distance_from_edge(d) * MM, "--", color=style.LINES[5],
            label="4-7 as printed")  # fmt: skip
    draw_read(ax, "from_edge", 1e-3)
    ax.set_ylabel("distance from the edge [mm]")
    ax.legend()
    off = {}
    for label, runs, _ in GROUPS:
        values = read_from_tendon(runs)
        off[label] = (values["from_edge"] - gauge.distance_from_edge(values["displacement"])) * MM
    said = "; ".join(f"{k}: {x.min():+.0f} to {x.max():+.0f} mm" for k, x in off.items())
    few, many = off["110 kN"], off["75 kN"]
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.2",
                "the migration is relatively unchanged by the prestress, and predicted by 4-7",
                f"read from the tendon, farther from the edge than 4-7 as printed, {said}: nearer "
                "the middle with more prestress",
                bool(few.min() < many.max() and many.min() < few.max()),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_4_76() -> Drawn:
    """Uplift of the edge against the displacement: 4-9, and what Table 4-2 says of the tests.

    As Figure 4-75: the uplift of the edge follows from the tendon's extension and the rotation.
    """
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    d = np.linspace(0.0, 0.03, 600)
    ax.plot(d * MM, MORE.uplift(d) * MM, label="4-9")
    draw_read(ax, "uplift", 1e-3)
    ax.set_ylabel("uplift $u'$ [mm]")
    ax.legend()
    ratio = {}
    for label, runs, _ in GROUPS:
        values = read_from_tendon(runs)
        size = np.abs(values["displacement"])
        ratio[label] = values["uplift"] / MORE.uplift(size)
    said = "; ".join(f"{k}: {x.min():.2f} to {x.max():.2f}" for k, x in ratio.items())
    worst = {k: np.abs(x - 1).max() for k, x in ratio.items()}
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.2",
                "the deviations from 4-9 are not perceptibly higher than before",
                f"uplift read from the tendon over 4-9, {said}",
                bool(worst["110 kN"] < 1.25 * worst["75 kN"]),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_4_77() -> Drawn:
    """Tendon force against the displacement with 110 kN: 4-16, and the largest of each test.

    The traces are lost; Table 4-2 has the largest displacement and tendon force of each test.
    """
    figure = style.new_figure(6.0, 3.6)
    ax = figure.add_subplot()
    d = symmetric(0.012)
    for wall, label, color in (
        (MORE, "4-16, 111 kN", style.LINES[1]), (WALL, "4-16, 75.6 kN", style.INK),
    ):  # fmt: skip
        ax.plot(d * MM, wall.tendon_force(d) / 1e3, color=color, label=label)
    for (label, runs, mark), color in zip(GROUPS, (style.INK, style.LINES[1]), strict=True):
        values = read_from_tendon(runs)
        near = np.abs(values["displacement"]) < 0.012
        ax.plot(values["displacement"][near] * MM, values["force"][near] / 1e3, mark, color=color,
                mfc="white", label=f"tests with {label}")  # fmt: skip
    ax.set_xlabel(r"displacement $\Delta$ [mm]")
    ax.set_ylabel("tendon force $P$ [kN]")
    ax.set_ylim(70, 150)
    ax.legend(loc="upper center", ncols=2, fontsize=7.5)
    above = []
    for row in TABLE_4_2.rows:
        if row[0] in GROUPS[1][1]:
            d_of, before, largest = (float(x or 0.0) for x in row[1:4])
            force = float(analysis.Wall.thesis(1e3 * before).tendon_force(1e-3 * d_of))
            above.append(100 * (force / (1e3 * largest) - 1))
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.2",
                "4-16 with 111 kN models the tests well",
                f"4-16 lies {min(above):.1f} to {max(above):.1f} % above the largest "
                "force of the three tests",
                max(map(abs, above)) < 10,
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_4_78() -> Drawn:
    """Restoring force with 75.6 and with 111 kN, and what 4-42 reads from a dynamic response.

    The traces are lost. Points are those of `ControlledWall` with 111 kN and r = 0.852 under the
    motions of runs 7 and 9, where the wall turns back, as in Figure 4-69. The tendon of both yields
    at the same force.
    """
    figure, *axes = overview_and_origin()
    points = []
    for run, mark, color in (("7", "^", style.LINES[2]), ("9", "o", style.LINES[4])):
        response = rk.simulate(
            rk.ControlledWall.from_wall(shaken.wall_of(run)), shaken.wall_motion(run),
            impact=rk.EnergyRatio(0.852), options=rk.SolverOptions(output_step=1e-3),
        )  # fmt: skip
        d, force = forces_when_still(response)
        points.append((d, force))
        for ax in axes:
            ax.plot(d * MM, force / 1e3, mark, color=color, ms=3.2, mfc="none", mew=0.8,
                    label=f"4-42, run {run}")  # fmt: skip
    for ax, far in zip(axes, (0.07, 0.006), strict=True):
        d = symmetric(far)
        for wall, label, color in (
            (MORE, "111 kN", style.LINES[1]), (WALL, "75.6 kN", style.LINES[0]),
        ):  # fmt: skip
            ax.plot(d * MM, wall.restoring_force(d) / 1e3, color=color, zorder=1, label=label)
            limit = wall.yield_displacement()
            if limit < far:
                for end in (-limit, limit):
                    ax.plot(end * MM, wall.restoring_force(end) / 1e3, "|", ms=10, color=color)
        ax.set_xlim(-far * MM, far * MM)
    axes[0].set_ylabel("restoring force $F_k$ [kN]")
    axes[0].legend(loc="upper left", fontsize=7.5)
    yields = [wall.yield_displacement() * MM for wall in (WALL, MORE)]
    small = 2e-3
    threshold = [float(wall.restoring_force(small)) / 1e3 for wall in (WALL, MORE)]
    d, read = (np.concatenate(x) for x in zip(*points, strict=True))
    fit = float(identification.coefficient_of_determination(read, MORE.restoring_force(d)))
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.2",
                "more prestress raises the force threshold",
                f"at {small * MM:g} mm {threshold[1]:.1f} kN against {threshold[0]:.1f} kN",
                bool(threshold[1] > threshold[0]),
            ),
            Statement(
                "section 4.9.2",
                "more prestress reduces the displacement at which the tendon yields",
                f"{yields[1]:.1f} mm against {yields[0]:.1f} mm",
                bool(yields[1] < yields[0]),
            ),
            Statement(
                "section 4.9.2",
                "the pseudo-static properties can be estimated at another prestress",
                f"R2 = {fit:.3f} for {len(d)} turning points of the simulations",
                bool(fit > 0.9),
            ),
        ),
    )


@thesis_figure(Source.IN_KIND)
def figure_4_79() -> Drawn:
    """Test run 9, Sylmar 360 in 0.6 of its time with 111 kN, by 4-27 with a constant r = 0.852.

    The thesis shows one of its tests with 110 kN; which one is not stated, and its text has 0.835
    in place of the caption's 0.852. The measured trace is lost; its largest displacement is the
    dotted line.
    """
    figure = style.new_figure(7.2, 3.2)
    ax = figure.add_subplot()
    t = np.arange(0.0, 15.0, 2e-3)
    run = shaken.oscillator_run("9", 0.852)
    ax.plot(t, displacement(run, t) * MM, lw=0.9, label="SDOF, 4-27")
    measured = measured_peak("9") * MM
    ax.axhline(measured, color=style.INK, lw=0.9, ls=":", label="measured peak")
    ax.set_xlim(0, 15)
    ax.set_xlabel("time [s]")
    ax.set_ylabel(r"displacement $\Delta$ [mm]")
    style.legend_above(ax)
    peak = abs(shaken.peaks_of(run).displacement) * MM
    return Drawn(
        figure,
        (
            Statement(
                "section 4.9.2.1",
                "the simulations underestimate the largest displacements by a large margin",
                f"{peak:.2f} mm under the record that was meant, {-measured:.2f} mm measured",
                bool(peak < -0.75 * measured),
            ),
        ),
    )
