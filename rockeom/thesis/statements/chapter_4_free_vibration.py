"""Statements of sections 4.5.1 and 4.7 on the measured free vibration of the wall."""

import math

import numpy as np
from scipy.special import erf

from rockeom.analysis import identification
from rockeom.thesis.figures import chapter_4_free_vibration as figures
from rockeom.thesis.figures.chapter_4_wall import GAUGE, legible
from rockeom.thesis.free_vibration_table import PEAKS, WALL
from rockeom.thesis.printed import FIGURE_4_29
from rockeom.thesis.statements import statement as st
from rockeom.thesis.wall_tests import quarter_period_fit

statement = st.Register()

_TABLE = st.data("Table A-1")
_RECORD = "the record between the rows of Table A-1 is not printed"


def _measured() -> identification.FreeVibration:
    return identification.FreeVibration.table_a1()


# --- 4.5.1 the record


@statement(
    "4.5.1", "the effect of reducing the toe compression by up to 26%",
    st.at_most(26.5, "%", why="half of the last digit"),
    st.closed_form("4-3 and 4-4"), st.data("Table A-1, rotation centre at the first 13 peaks"),
    figure="4-11",
)  # fmt: skip
def correction_of_the_toe() -> st.Finding:
    taken = 100 * GAUGE / np.asarray(_measured().centre_from_edge)[figures.peaks()]
    return st.finding(
        taken.max(), f"by {taken.min():.0f} to {taken.max():.0f} % at the first 13 peaks"
    )


@statement(
    "4.5.1", "the centre of rotation remains relatively stationary once rocking is initiated",
    st.at_most(0.1 * 2e3 * WALL.half_width, "mm", why="relatively: 10 % of the wall's width"),
    st.data("Table A-1, rotation centre at the first 9 peaks"),
    figure="4-11",
)  # fmt: skip
def travel_of_the_centre_while_rocking() -> st.Finding:
    x = 1e3 * np.asarray(_measured().centre_from_edge)[figures.peaks()[:9]]
    return st.finding(float(np.ptp(x)), f"from {x.min():.0f} to {x.max():.0f} mm")


@statement(
    "4.5.1", "gradually migrates from the outer edge back towards the centreline",
    st.at_least(1.1, why="last legible peaks over the first nine: 10 % or more from the edge"),
    st.data("Table A-1, rotation centre at the peaks"),
    figure="4-11",
)  # fmt: skip
def centre_at_the_end() -> st.Finding:
    measured = _measured()
    x = 1e3 * np.asarray(measured.centre_from_edge)
    late, early = x[measured.at_peak & legible()][-3:], x[figures.peaks()[:9]]
    return st.finding(
        late.max() / early.max(),
        f"{late.min():.0f} to {late.max():.0f} mm at the last 3 legible peaks, {early.min():.0f} "
        f"to {early.max():.0f} mm at the first 9",
    )


@statement(
    "4.5.1", "a very good fit to the data with a R^2 value of 0.976",
    st.rounded("0.976"),
    st.closed_form("4-5"), st.data("Table A-1, legible quarters"),
    figure="4-13",
)  # fmt: skip
def fit_of_4_5() -> st.Finding:
    peak, time = figures.quarters()
    r2 = identification.coefficient_of_determination(time, quarter_period_fit(np.abs(peak)))
    return st.finding(r2, f"{r2:.4f} over {len(time)} quarters")


@statement(
    "4.5.1, at 4-5", "0.505 s and 5155 mm, 0.010 s",
    st.near([0.505 * math.sqrt(2 / 5.155), 0.010], [1e-3, 5e-4],
         why="factor of the root in s/sqrt(m), and seconds: half of the last digit"),
    st.data("Table A-1, legible quarters, least squares"),
    figure="4-13",
)  # fmt: skip
def coefficients_of_4_5() -> st.Finding:
    fit = figures.fitted_quarters()
    ends = [fit.interval(name) for name in ("k", "c")]
    k, c = (fit.values[name] for name in ("k", "c"))
    return st.ranging(
        list(zip(*ends, strict=True)),
        f"{k:.3f} s/sqrt(m), {ends[0][0]:.3f} to {ends[0][1]:.3f}; {1e3 * c:.1f} ms, "
        f"{1e3 * ends[1][0]:.1f} to {1e3 * ends[1][1]:.1f} ms with 95 % confidence",
    )


@statement(
    "4.5.1", "For a 1.2% lateral drift of the PCM wall, the rocking frequency of the system "
    "decreased from approximately 11 Hz to 4 Hz",
    st.about([11.0, 4.0], "Hz", why="approximately"),
    st.data("Table A-1, quarters at the smallest and the largest peak"),
    figure="4-13", lost="the rows of the smallest motions are legible in part",
)  # fmt: skip
def range_of_frequency() -> st.Finding:
    peak, time = figures.quarters()
    fast, slow = 1 / (4 * time[np.argmin(np.abs(peak))]), 1 / (4 * time[0])
    last = 1 / (4 * _measured().quarter_periods().time[-4:])
    drift = 100 * abs(peak[0]) / WALL.height
    return st.finding(
        [fast, slow],
        f"{fast:.1f} Hz at the smallest legible peak to {slow:.1f} Hz at {drift:.2f} %; "
        f"{last.min():.1f} to {last.max():.1f} Hz where rows had to be guessed",
    )


@statement(
    "4.5.1", "likewise correlated to the horizontal displacements",
    st.at_least(0.95, why="R2 of a straight line of the uplift"),
    st.data("Table A-1, uplift of the edge that lifts"),
    figure="4-14",
)  # fmt: skip
def uplift_against_displacement() -> st.Finding:
    measured, chosen = _measured(), legible()
    left, right = np.asarray(measured.left_uplift), np.asarray(measured.right_uplift)
    uplift = np.where(measured.displacement > 0, left, right)[chosen]
    size = np.abs(measured.displacement[chosen])
    line = identification.fit(lambda k, c: k * size + c, uplift, {"k": 0.4, "c": 1e-4})
    return st.finding(
        line.r_squared,
        f"{line.r_squared:.3f}, {line.values['k']:.3f} of the displacement; about the far edge it "
        f"were {2 * WALL.half_width / WALL.height:.3f}",
    )


@statement(
    "4.5.1", "the tendon force increases slowly in a parabolic fashion",
    st.at_most(1.0, why="slope below 2 mm over that from 2 to 8 mm"),
    st.data("Table A-1, tendon force"),
    figure="4-15",
)  # fmt: skip
def slopes_of_the_tendon_force() -> st.Finding:
    measured, chosen = _measured(), legible()
    size, force = np.abs(measured.displacement[chosen]), np.asarray(measured.tendon_force)[chosen]
    slopes = []
    for rows in (size < 2e-3, (size > 2e-3) & (size < 8e-3)):
        x, y = size[rows], force[rows]
        slopes.append(identification.fit(lambda k, c, x=x: k * x + c, y, {"k": 1e6, "c": 75e3}))
    small, large = slopes
    ratios = [a / b for a in small.interval("k") for b in large.interval("k")]
    said = ", ".join(
        f"{s.values['k'] / 1e6:.2f} kN/mm ({s.interval('k')[0] / 1e6:.2f} to "
        f"{s.interval('k')[1] / 1e6:.2f})"
        for s in slopes
    )
    return st.ranging(ratios, f"{said} with 95 % confidence; the zero of the gauge is not upright")


@statement(
    "Table A-1", "the last column is the distance to the edge of the wall",
    st.near(0.0, 5.0, "mm", why="what its uplifts say of the distance, on the median"),
    st.data("Table A-1, uplifts of both edges at the peaks beyond 5 mm"),
    slip=True,
)  # fmt: skip
def column_of_the_rotation_centre() -> st.Finding:
    measured = _measured()
    rows = measured.at_peak & legible() & (np.abs(measured.displacement) > 5e-3)
    beside = measured.centre_from_edge - measured.rotation_centre(WALL.half_width)
    more = 1e3 * float(np.median(beside[rows]))
    return st.finding(more, f"{more:.0f} mm more than its uplifts say: the gauge is 30 mm outside")


@statement(
    "4.5.1", "when the wall is truly upright, or at the precise time of zero crossing",
    st.at_most(0.1, "mm", why="truly upright, where the acceleration vanishes"),
    st.data("Table A-1, crossings"),
    slip=True,
)  # fmt: skip
def displacement_at_the_crossings() -> st.Finding:
    measured = _measured()
    rows = ~measured.at_peak & legible()
    mean = 1e3 * float(np.mean(np.abs(measured.displacement[rows])))
    return st.finding(mean, f"there the wall is {mean:.1f} mm from the gauge's zero on average")


# --- 4.7 energy


@statement(
    "4.7", "energy dissipation begins when the instantaneous displacement is less than 25% of the "
    "peak initial displacement",
    st.near(25.0, 2.5, "%", why="10 %"),
    st.closed_form("4-23"), _TABLE,
    figure="4-26", lost=_RECORD,
)  # fmt: skip
def onset_of_dissipation() -> st.Finding:
    measured = _measured()
    lost = [
        100 * (1 - (measured.velocity[row + 1] / speed[-1]) ** 2)
        for row, (_, speed) in zip(figures.peaks()[:5], figures.paths_without_losses(), strict=True)
    ]
    return st.unknown(
        f"at the crossings of the first five half cycles {min(lost):.0f} to {max(lost):.0f} % of "
        "the kinetic energy without losses are missing",
    )


@statement(
    "4.7", "small displacements, less than 4 mm say, lose energy at any speed",
    st.at_least(90.0, "%", why="nearly all of the loss within 4 mm"),
    st.closed_form("4-28 with n of 4-7"),
    figure="4-27", lost=_RECORD,
)  # fmt: skip
def loss_within_four_millimetres() -> st.Finding:
    n = WALL.rotation_centre.epsilon
    within = 100 * float(erf(4e-3 / n))
    return st.finding(
        within, f"4-28 with n = {1e3 * n:.2f} mm has {within:.0f} % of its loss there"
    )


@statement(
    "4.7", "over 80 % of the energy is elastic energy of the tendon at first",
    st.at_least(80.0, "%", why="the printed number"),
    st.closed_form("4-18 to 4-20"), st.data("Table A-1, first peak"),
    figure="4-28",
)  # fmt: skip
def share_of_the_tendon() -> st.Finding:
    energies = _measured().energies(WALL)
    share = 100 * float(energies.elastic[0] / energies.total[0])
    return st.finding(share, f"{share:.1f} %")


@statement(
    "4.7", "when upright the total erroneously increases",
    st.at_least(4, "of 6 crossings", why="more than half, above the peak before"),
    st.closed_form("4-18 to 4-20"), st.data("Table A-1, first three cycles"),
    figure="4-28",
)  # fmt: skip
def energy_at_the_crossings() -> st.Finding:
    total = _measured().energies(WALL).total[:13]
    rises = int(np.sum(total[1::2] > total[:-1:2]))
    most = 100 * float((total[1::2] / total[:-1:2]).max() - 1)
    return st.finding(rises, f"at {rises} of the 6, by up to {most:.0f} %")


@statement(
    "Figure 4-29", "617.9, 541.9, 488.9 ... 88.7 J at thirteen peaks",
    st.near(FIGURE_4_29.numbers("total energy"), 1.5, "J",
         why="what the last digit of the displacement and of the force leaves open"),
    st.closed_form("4-18 and 4-20"), st.data("Table A-1, peaks"),
    figure="4-29",
)  # fmt: skip
def energies_of_figure_4_29() -> st.Finding:
    energies = _measured().energies(WALL).total[figures.peaks()]
    off = np.abs(energies - FIGURE_4_29.numbers("total energy")).max()
    return st.finding(energies, f"off by {off:.1f} J at most")


@statement(
    "4.7", "a constant r value describes the nature of energy dissipation adequately, except for "
    "small vibrations",
    st.at_most(0.1, why="adequately: standard deviation of 10 % from peaks above 7 mm"),
    st.closed_form("energies of 4-18 to 4-20"), _TABLE,
    figure="4-30",
)  # fmt: skip
def scatter_of_restitution() -> st.Finding:
    lost = figures.losses()
    large = lost.chosen & (np.abs(lost.peak) > 7e-3)
    spread = [
        float(np.std(lost.energy_ratio[rows], ddof=1)) for rows in (large, lost.chosen & ~large)
    ]
    return st.finding(spread[0], f"{spread[0]:.3f}; {spread[1]:.3f} from smaller ones")


@statement(
    "4.7", "the experimental r values are generally close to the theoretical Housner r value",
    st.near(figures.HOUSNER, 0.1 * figures.HOUSNER,
            why="close: 10 %, on the mean of twelve passages"),
    st.closed_form("2-6 about the corner"), _TABLE,
    figure="4-31",
)  # fmt: skip
def mean_restitution() -> st.Finding:
    r = figures.losses().energy_ratio[: PEAKS - 1]
    low, high = identification.fit(lambda mean: np.full(len(r), mean), r, {"mean": 0.85}).interval(
        "mean"
    )
    return st.ranging(
        [low, high],
        f"{r.mean():.3f}, {low:.3f} to {high:.3f} with 95 % confidence; {figures.HOUSNER:.3f} by "
        "2-6",
    )


@statement(
    "4.7", "there is no apparent relationship between the impact speed or the initial energy "
    "content with the experimental r values",
    st.at_most(1.0, "half-widths", why="slope over the half-width of its 95 % interval"),
    st.closed_form("energies of 4-18 to 4-20"), _TABLE,
    figure="4-31",
)  # fmt: skip
def restitution_against_the_speed() -> st.Finding:
    r, speed = (x[: PEAKS - 1] for x in figures.losses()[:2])
    line = identification.fit(lambda r, slope: r + slope * speed, r, {"r": 0.85, "slope": 0.0})
    low, high = line.interval("slope")
    return st.finding(
        abs(low + high) / (high - low), f"slope {low:+.2f} to {high:+.2f} s/m with 95 % confidence"
    )


@statement(
    "4.7", "the numerically calculated boundary closely matched the experimental boundary",
    st.at_most(10.0, "%", why="closely: 10 %"),
    st.closed_form("4-25 and 4-26"), _TABLE,
    figure="4-34", lost="the boundary of the experiment is not printed",
)  # fmt: skip
def crossings_within_the_boundary() -> st.Finding:
    measured = _measured()
    rows = ~measured.at_peak & legible()
    size, speed = np.abs(measured.displacement[rows]), np.abs(measured.velocity[rows])
    limit = WALL.dissipation_limit(np.linspace(5e-4, 0.0325, 400))
    inside = size < np.interp(speed, limit.speed, limit.displacement)
    outside = 100 * float(1 - inside.mean())
    return st.finding(outside, f"{inside.sum()} of {len(inside)} measured crossings lie inside it")
