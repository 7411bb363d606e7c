"""Figures: what they show is what the response says, and nothing hides anything."""

import gc
import warnings
from dataclasses import replace

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

import rockeom as rk
from rockeom.drawing.ground_motion import plot_spectra
from rockeom.drawing.style import FEET, contacts, full_contact, spans_in, symbol
from rockeom.plots import (
    design_report,
    draw_structure,
    plot_comparison,
    plot_phase_portrait,
    plot_response,
)
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain
from tests.typical import S1 as COLUMN, column, on_springs

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
FLEXIBLE, SPRINGS = column(), on_springs(foundation_damping=1e3)
STACK = rk.StackedBlocks(
    lower_half_width=0.4, lower_half_height=0.4, upper_half_width=0.2, upper_half_height=0.5
)
BED = rk.Winkler(springs=4, stiffness=550e3, damping=1e3)
PULSE = rk.GroundMotion.single_sine(2.8, 0.5, 3.0)
STRONG = rk.GroundMotion.single_sine(6.0, 0.3, 1.5)

RUNS = {
    "rigid block": lambda: rk.simulate(BLOCK, PULSE),
    "rigid block, both directions": lambda: rk.simulate(
        BLOCK, PULSE, vertical=PULSE.scaled(acceleration=0.5)
    ),
    "free rocking": lambda: rk.simulate(BLOCK, rk.GroundMotion.none(12.0), initial={"theta": 0.1}),
    "at rest": lambda: rk.simulate(BLOCK, PULSE.scaled(acceleration=0.1)),
    "overturned": lambda: rk.simulate(BLOCK, PULSE.scaled(acceleration=2.0)),
    "flexible": lambda: rk.simulate(FLEXIBLE, STRONG),
    "on springs": lambda: rk.simulate(SPRINGS, STRONG),
    "stack": lambda: rk.simulate(STACK, STRONG),
    "on a bed": lambda: rk.simulate(column(support=BED), STRONG),
    "cart": lambda: rk.simulate(rk.TwoSpringCart(**COLUMN, foundation_stiffness=550e3), STRONG),
    "without dimensions": lambda: rk.simulate(
        rk.NondimensionalBlock(alpha=0.2), rk.GroundMotion.single_sine(0.4, 3.0)
    ),
}


@pytest.fixture(scope="module")
def run_of():
    """The runs by name, each simulated at its first use."""
    done: dict[str, rk.Response] = {}

    def run(name: str) -> rk.Response:
        if name not in done:
            done[name] = RUNS[name]()
        return done[name]

    return run


@pytest.fixture(scope="module", params=RUNS)
def shown(request, run_of, garbage_of_its_own):
    """Each run and its figure, to be looked at only; one after the other, a figure is 40 MB."""
    run = run_of(request.param)
    yield run, drawn(plot_response(run))
    gc.collect()


def drawn(figure: Figure) -> Figure:
    """Drawn once, as for a file; a layout that does not fit is an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figure.draw_without_rendering()
    return figure


def row(figure: Figure, label: str):
    (ax,) = (ax for ax in figure.axes if ax.get_ylabel().startswith(label))
    return ax


def values(line) -> np.ndarray:
    return np.asarray(line.get_ydata())


# --- quantities by name


def test_quantities_named_have_a_row_each_in_the_units_of_their_labels(run_of):
    run = run_of("flexible")
    figure = drawn(run.plot("theta", "left_uplift", start=0.1, end=0.4))
    above, below = figure.axes
    assert above.get_ylabel().endswith("[rad]")
    assert below.get_ylabel().endswith("[mm]")
    np.testing.assert_array_equal(values(above.lines[0]), run["theta"])
    np.testing.assert_array_equal(values(below.lines[0]), 1e3 * run["left_uplift"])
    assert below.get_xlim() == (0.1, 0.4)


def test_axes_of_the_caller_take_quantities_of_one_unit(run_of):
    run, figure = run_of("rigid block"), Figure()
    ax, other = figure.subplots(2)
    assert run.plot(ax=ax) is figure
    np.testing.assert_array_equal(values(ax.lines[0]), run["theta"])
    run.plot("left_uplift", "right_uplift", ax=other)
    assert len(other.lines) == 2
    assert other.get_ylabel() == "[mm]"
    with pytest.raises(ValueError, match=r"theta \[rad\], left_uplift \[m\] have not"):
        run.plot("theta", "left_uplift", ax=ax)


# --- what is shown


def test_figure_draws_and_names_structure_motion_and_outcome(shown):
    run, figure = shown
    title = " ".join(figure.get_suptitle().split())
    assert run.motion.name in title
    assert run.outcome.sentence in title
    assert run.structure.module.NAME.split("_")[0] in title.lower()
    for ax in figure.axes:
        label = ax.get_ylabel()
        assert ("[" in label and "]" in label) or label == "contact"


def test_rows_hold_the_response_in_the_units_of_their_labels(run_of):
    run = run_of("flexible")
    figure = plot_response(run)
    ground = row(figure, "ground")
    assert "[g]" in ground.get_ylabel()
    np.testing.assert_allclose(values(ground.lines[0]), run["ground_acceleration"] / 9.81)
    rotation = row(figure, "rotation")
    assert "[rad]" in rotation.get_ylabel()
    np.testing.assert_array_equal(values(rotation.lines[0]), run["theta"])
    lengths = row(figure, "displacement")
    assert "[mm]" in lengths.get_ylabel()
    np.testing.assert_allclose(values(lengths.lines[0]), 1e3 * run["displacement"])
    np.testing.assert_allclose(values(lengths.lines[1]), 1e3 * run["u"])
    feet = row(figure, "uplift")
    assert "[mm]" in feet.get_ylabel()
    for line, foot in zip(feet.lines, ("left", "right"), strict=True):
        assert foot in line.get_label()
        np.testing.assert_allclose(values(line), 1e3 * run[f"{foot}_uplift"])


def test_legend_tells_the_largest_value(run_of):
    run = run_of("flexible")
    label = row(plot_response(run), "displacement").lines[0].get_label()
    assert f"{1e3 * abs(run.extremes('displacement').peak):.3g} mm" in label


def test_every_impact_stands_at_its_instant_as_high_as_its_speed(run_of):
    run = run_of("free rocking")
    (bars,) = row(plot_response(run), "impact").collections
    ends = np.array([segment[1] for segment in bars.get_segments()])
    assert len(ends) == len(run.impacts)
    np.testing.assert_array_equal(ends[:, 0], [impact.time for impact in run.impacts])
    speeds = [abs(impact.before["theta_dot"]) for impact in run.impacts]
    np.testing.assert_allclose(ends[:, 1], speeds)


def test_rotation_over_alpha_has_an_axis_of_its_own(run_of):
    figure = drawn(plot_response(run_of("rigid block")))
    (right,) = row(figure, "rotation").child_axes
    left_limits = np.array(row(figure, "rotation").get_ylim())
    np.testing.assert_allclose(right.get_ylim(), left_limits / BLOCK.alpha)
    assert r"\alpha" in right.get_ylabel()


def test_vertical_acceleration_is_drawn_and_told_apart(run_of):
    ground = row(plot_response(run_of("rigid block, both directions")), "ground")
    assert [line.get_label() for line in ground.lines] == ["horizontal", "vertical"]
    np.testing.assert_allclose(np.abs(values(ground.lines[1])).max(), 1.4 / 9.81, rtol=1e-4)


def test_free_rocking_wastes_no_row_on_a_ground_that_stands_still(run_of):
    labels = [ax.get_ylabel() for ax in plot_response(run_of("free rocking")).axes]
    assert not any(label.startswith("ground") for label in labels)


@pytest.mark.parametrize("name", RUNS)
def test_modes_follow_one_another_without_gap(name, run_of):
    run = run_of(name)
    for states in contacts(run).values():
        closed, open_ = spans_in(run, states > 0), spans_in(run, states == 0)
        spans = np.sort(np.concatenate([closed, open_]), axis=0)
        assert (spans[0, 0], spans[-1, 1]) == (run.t[0], run.t[-1])
        np.testing.assert_array_equal(spans[1:, 0], spans[:-1, 1])


def within(run: rk.Response, spans: np.ndarray) -> np.ndarray:
    """The samples well inside of spans of time."""
    return np.any([np.zeros(len(run.t)), *((run.t > a) & (run.t < b) for a, b in spans)], axis=0)


@pytest.mark.parametrize("name", ["flexible", "on springs", "stack", "on a bed"])
def test_open_contacts_bear_nothing_and_each_has_its_curve_and_its_lane(name, run_of):
    run = run_of(name)
    figure = plot_response(run)
    names = [contact.replace("_", " ") for contact in contacts(run)]
    for (contact, states), label in zip(contacts(run).items(), names, strict=True):
        is_open, force = within(run, spans_in(run, states == 0)), run[f"{contact}_reaction"]
        assert is_open.any()
        assert not force[is_open].any()
        assert force[within(run, spans_in(run, states > 0))].min() > -1e-9
        assert (force[within(run, full_contact(run))] > 0.0).all()
        (line,) = (x for x in row(figure, "uplift").lines if x.get_label().startswith(label))
        np.testing.assert_allclose(values(line), 1e3 * run[f"{contact}_uplift"])
    assert [x.get_text() for x in row(figure, "contact").get_yticklabels()] == names


@pytest.mark.parametrize("name", ["stack", "on a bed"])
def test_no_two_curves_of_a_row_look_alike(name, run_of):
    for ax in plot_response(run_of(name)).axes[:-1]:
        looks = [(line.get_color(), line.get_linestyle()) for line in ax.lines]
        assert len({*looks}) == len(looks)


# Fails: the right foot is blue where it lifts and orange where it stands.
@pytest.mark.parametrize("name", ["flexible", "on springs", "rigid block, both directions"])
def test_each_foot_has_one_colour_and_nothing_else_has_it(name, run_of):
    figure = plot_response(run_of(name))
    feet = row(figure, "uplift")
    for foot, color in FEET.items():
        (line,) = (line for line in feet.lines if foot in line.get_label())
        assert line.get_color() == color
        lane = row(figure, "contact").collections[2 * [*FEET].index(foot)]
        assert mpl.colors.same_color(lane.get_facecolor()[0], color)
    for ax in figure.axes:
        if ax is not feet:
            assert not {line.get_color() for line in ax.lines} & set(FEET.values())


# Fails: it has states of elements, whose names are none.
def test_a_wall_with_a_cable_that_yields_shows_its_feet():
    still = rk.GroundMotion.none(0.1)
    run = rk.simulate(rk.ControlledWall.thesis(), still, initial={"theta": 0.01})
    labels = row(drawn(plot_response(run)), "contact").get_yticklabels()
    assert [label.get_text() for label in labels] == ["left", "right"]


def test_part_of_the_time_axis_on_request(run_of):
    figure = drawn(plot_response(run_of("flexible"), start=0.1, end=0.4))
    assert figure.axes[-1].get_xlim() == (0.1, 0.4)


# --- nothing hides anything


def test_no_legend_covers_a_curve(shown):
    _, figure = shown
    for ax in figure.axes:
        legend = ax.get_legend()
        if legend is not None:
            assert legend.get_window_extent().y0 >= ax.get_window_extent().y1 - 2.0


def test_everything_stands_inside_the_figure(shown):
    _, figure = shown
    page = figure.bbox
    for ax in figure.axes:
        box = ax.get_tightbbox()
        assert box.x0 >= page.x0 - 1
        assert box.x1 <= page.x1 + 1
        assert box.y0 >= page.y0 - 1
        assert box.y1 <= page.y1 + 1


def test_dollars_in_names_are_no_mathematics():
    record = replace(rk.GroundMotion.from_array(np.sin(np.arange(60.0)), 0.05), name=r"$\frac{$ a")
    run, spectrum = rk.simulate(BLOCK, record), record.response_spectrum([0.2, 1.0])
    report, spectra = design_report(FLEXIBLE, [record]), [spectrum, replace(spectrum, name="$_{$")]
    for draw, of in (
        (plot_response, run), (plot_comparison, [run]), (plot_phase_portrait, run),
        (rk.GroundMotion.plot, record), (plot_spectra, spectra), (type(report).figures, report),
    ):  # fmt: skip
        drawn(draw(of))
    assert record.name in {text.get_text() for text in drawn(report.page()).texts}


@pytest.mark.parametrize(
    ("name", "written"),
    [("u_1", "u_{1}"), ("u12", "u_{12}"), ("phi_2", r"\phi_{2}"), ("u_1_dot", r"\dot{u_{1}}"),
     ("theta_dot", r"\dot{\theta}"), ("tip__tilt_3", r"\mathrm{tip\ \ tilt}_{3}")],
)  # fmt: skip
def test_coordinates_are_letters_with_an_index_or_words(name, written):
    assert symbol(name) == f"${written}$"
    (figure := Figure()).suptitle(symbol(name))
    drawn(figure)


# --- how it fits into a program


def test_settings_stay_as_they_are(run_of):
    before = dict(mpl.rcParams)
    plot_response(run_of("rigid block"))
    plot_phase_portrait(run_of("rigid block"))
    draw_structure(BLOCK)
    assert dict(mpl.rcParams) == before


def test_response_plots_itself_and_a_notebook_shows_it(run_of):
    figure = run_of("rigid block").plot()
    assert figure._repr_png_().startswith(b"\x89PNG")


def test_figure_of_the_caller_is_drawn_in(run_of):
    mine = Figure(figsize=(12, 6), layout="constrained")
    left, right = mine.subfigures(1, 2)
    assert plot_response(run_of("rigid block"), figure=left) is left
    ax = right.add_subplot()
    assert plot_phase_portrait(run_of("rigid block"), ax=ax) is mine
    drawn(mine)
    assert len(left.axes) > 3
    assert ax.lines


# --- comparison


def test_comparison_shows_each_run_and_its_label(run_of):
    runs = [run_of("flexible"), rk.simulate(FLEXIBLE, STRONG, impact=rk.Impulsive())]
    figure = drawn(plot_comparison(runs, ["one", "two"]))
    shown = row(figure, "displacement")
    for line, run in zip(shown.lines, runs, strict=True):
        np.testing.assert_allclose(values(line), 1e3 * run["displacement"])
    ends = [text.get_text() for text in figure.legends[0].get_texts()]
    for end, name, run in zip(ends, ("one", "two"), runs, strict=True):
        largest = abs(run.extremes("rotation_ratio").peak)
        assert end == f"{name}: {run.outcome}, largest $\\theta/\\alpha$ {largest:.2f}"
    assert len(row(figure, "ground").lines) == 2  # one above the other
    lanes = [c for c in row(figure, "impacts").collections if hasattr(c, "get_segments")]
    counts = [len(c.get_segments()) for c in lanes if len(c.get_linewidths())]
    assert set(counts) >= {len(run.impacts) for run in runs}


def test_curves_of_a_motion_that_overturned_end_with_a_cross(run_of):
    stood, fell = run_of("rigid block"), run_of("overturned")
    figure = drawn(plot_comparison([stood, fell], ["one", "two"]))
    crosses = [line for line in row(figure, "displacement").lines if line.get_marker() == "X"]
    ends = [(line.get_xdata()[-1], values(line)[-1]) for line in crosses]
    assert ends == [(fell.t[-1], pytest.approx(1e3 * fell["displacement"][-1]))]
    assert figure.legends[0].get_texts()[1].get_text() == "two: overturned"
    for run, crossed in ((stood, False), (fell, True)):
        for shown in (row(drawn(plot_response(run)), "rotation"), *plot_phase_portrait(run).axes):
            assert any(line.get_marker() == "X" for line in shown.lines) == crossed


def test_comparison_of_structures_with_and_without_feet(run_of):
    drawn(plot_comparison([run_of("on springs"), run_of("cart")]))


@pytest.mark.parametrize(
    ("names", "labels", "message"),
    [
        ([], None, "0 runs"),
        (["flexible"], ["one", "two"], r"labels is \['one', 'two'\]: give one for"),
        (["flexible", "without dimensions"], None, "some have units and some none: compare"),
    ],
)
def test_comparison_of_what_cannot_be_compared(names, labels, message, run_of):
    with pytest.raises(ValueError, match=message):
        plot_comparison([run_of(name) for name in names], labels)


# --- portrait and sketch


def test_portrait_has_a_gap_at_each_impact(run_of):
    run = run_of("rigid block")
    (ax,) = plot_phase_portrait(run).axes
    curves = [
        line for line in ax.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 1
    ]
    jumps = [line for line in ax.lines if line.get_linestyle() == ":"]
    assert len(jumps) == len(run.impacts)
    assert sum(len(line.get_xdata()) for line in curves) <= len(run.t)
    for line, impact in zip(jumps, run.impacts, strict=True):
        rates = [impact.before["theta_dot"], impact.after["theta_dot"]]
        np.testing.assert_array_equal(values(line), rates)


@pytest.mark.parametrize("structure", [BLOCK, FLEXIBLE, rk.SlenderBlock(radius=1.0, alpha=0.2)])
@pytest.mark.parametrize("rotation", [0.2, -0.2])
def test_sketch_stands_on_one_foot_and_lifts_the_other(structure, rotation):
    (ax,) = draw_structure(structure, rotation=rotation).axes
    feet = [line for line in ax.lines if line.get_color() == "0.25" and len(line.get_xdata()) == 1]
    heights = sorted(float(line.get_ydata()[0]) for line in feet)
    values = structure.parameters()
    half_width = values.get("half_width") or values["radius"] * np.sin(values["alpha"])
    assert heights[0] == pytest.approx(0.0, abs=1e-12)
    assert heights[1] == pytest.approx(2 * half_width * np.sin(0.2))


FRAME = rk.ShearFrame(
    masses=[2e4, 2e4], heights=[3.0, 6.0], stiffnesses=[2e7, 2e7], dampings=[0.0, 0.0],
    half_width=2.0, base_mass=3e4, base_height=0.3, base_inertia=1e4,
)  # fmt: skip
COLUMNS = rk.RockingFrame(
    columns=3, column_mass=1e4, half_width=0.6, half_height=3.0, beam_mass=5e4
)


@pytest.mark.parametrize(
    ("structure", "top"),
    [(FRAME, "u_2"), (replace(FRAME, support=rk.Pinned()), "u_2"), (COLUMNS, None)],
)
@pytest.mark.parametrize("rotation", [0.1, -0.1])
def test_sketch_puts_the_highest_mass_where_the_generated_module_has_it(structure, top, rotation):
    state = {"theta": rotation} | ({top: 0.2} if top else {})
    (ax,) = draw_structure(structure, state=state).axes
    masses = [line for line in ax.lines if line.get_marker() == "o" and line.get_zorder() == 5]
    highest = max(masses, key=lambda line: line.get_ydata()[0])
    y = structure.state(state)
    out = np.zeros(len(structure.module.KINEMATICS))
    structure.module.kinematics(structure.mode_number(y), y, structure.vector, out)
    moved = out[structure.module.KINEMATICS.index("displacement")]
    assert highest.get_xdata()[0] == pytest.approx(moved, rel=1e-12)


def test_sketch_of_a_bed_has_all_its_springs():
    bed = replace(FRAME, support=rk.Winkler(springs=5, stiffness=1e8, damping=0.0))
    (ax,) = draw_structure(bed).axes
    springs = [line for line in ax.lines if len(line.get_xdata()) == 11]
    assert len(springs) == 5


def test_sketch_has_room_for_a_spring_however_far_its_foot_is_pressed():
    (ax,) = draw_structure(SPRINGS, rotation=0.7).axes
    springs = [line for line in ax.lines if len(line.get_xdata()) == 11]
    for spring in springs:
        assert spring.get_ydata()[0] > spring.get_ydata()[-1]
    assert len({round(spring.get_ydata()[-1], 12) for spring in springs}) == 1


def test_sketch_of_a_wall_and_its_frame():
    linked = rk.WallWithFrame(
        mass=2e4, half_width=1.0, height=4.5, inertia=1.5e5, frame_mass=5e4, frame_stiffness=3e6,
        frame_damping=0.0, link_height=7.0, link_stiffness=5e7, link_damping=0.0,
    )  # fmt: skip
    places = []
    for bent in (0.0, 0.3):
        (ax,) = draw_structure(linked, state={"theta": 0.05, "u": bent}).axes
        (floor,) = (line for line in ax.lines if line.get_markersize() == 11)
        places.append((floor.get_xdata()[0], floor.get_ydata()[0]))
        assert sum(line.get_marker() == "s" for line in ax.lines) == 2  # feet of its columns
    assert places[1] == pytest.approx((places[0][0] + 0.3, 7.0))


def faces(ax):
    """Corners of all bodies that are drawn."""
    return [patch.get_xy()[:-1] for patch in ax.patches]


def test_sketch_of_a_stack_turns_each_block():
    stack = rk.StackedBlocks(
        lower=rk.RigidBlock(half_width=0.5, half_height=0.4),
        upper=rk.RigidBlock(half_width=0.3, half_height=0.7),
    )
    state = {"theta": 0.1, "phi": 0.25}
    (ax,) = draw_structure(stack, state=state).axes
    for corners, angle in zip(faces(ax), (0.1, 0.25), strict=True):
        bottom = corners[1] - corners[0]
        assert np.arctan2(-bottom[1], bottom[0]) == pytest.approx(angle)
    lowest = min(corners[:, 1].min() for corners in faces(ax))
    assert lowest == pytest.approx(0.0, abs=1e-12)


def test_sketch_has_each_column_of_a_frame_under_its_beam():
    (ax,) = draw_structure(COLUMNS, rotation=0.1).axes
    beam, *columns = sorted(faces(ax), key=lambda corners: -corners[:, 1].max())
    assert len(columns) == COLUMNS.parameters()["columns"]
    for corners in columns:
        assert corners[:, 1].min() == pytest.approx(0.0, abs=1e-12)
        assert corners[:, 1].max() == pytest.approx(beam[:, 1].min())
        assert beam[:, 0].min() < corners[:, 0].min() < corners[:, 0].max() < beam[:, 0].max()
    feet = [line for line in ax.lines if line.get_color() == "0.25" and len(line.get_xdata()) == 1]
    assert len(feet) == 2 * len(columns)


def test_column_of_a_sketch_bends_as_a_cantilever_under_a_force_at_its_end():
    (ax,) = draw_structure(FLEXIBLE, state={"theta": 0.1, "u": 0.05}).axes
    (column,) = (line for line in ax.lines if len(line.get_xdata()) == 40)
    z = np.linspace(0.0, 1.0, 40)[:, None]
    up, across = np.array([np.sin(0.1), np.cos(0.1)]), np.array([np.cos(0.1), -np.sin(0.1)])
    told = FLEXIBLE.positions({"theta": 0.1, "u": 0.05})
    low, high = 2 * COLUMN["base_height"], COLUMN["height"]  # top of the base, and the mass
    foot = told["base"] + COLUMN["base_height"] * up
    bent = foot + z * (high - low) * up + 0.05 * z**2 * (3 - z) / 2 * across
    np.testing.assert_allclose(column.get_xydata(), bent, atol=1e-12)


def test_columns_of_a_storey_stay_at_right_angles_to_their_floors():
    state = {"theta": 0.1, "u_1": 0.2, "u_2": 0.3}
    (ax,) = draw_structure(replace(FRAME, support=rk.Pinned()), state=state).axes
    columns = [line.get_xydata() for line in ax.lines if len(line.get_xdata()) == 40]
    assert len(columns) == 4
    for line in columns:
        for a, b in (line[:2], line[-2:]):
            assert np.arctan2(*(b - a)) == pytest.approx(0.1, abs=0.01)


def test_sketch_of_a_declared_structure_joins_a_mass_without_a_size_to_its_feet():
    from tests.contact import declared

    stepped = rk.structure(
        declared.on_a_step(), mass=900.0, inertia=540.0, gravity=9.81, friction=0.3,
        restitution=0.0, height=1.0, half_width=0.4, step=0.2,
    )  # fmt: skip
    (ax,) = draw_structure(stepped).axes
    legs = [line.get_xydata() for line in ax.lines if line.get_linewidth() == 1.2]
    ends = {tuple(np.round(leg[1], 12)) for leg in legs if len(leg) == 2}
    assert {(-0.4, 0.0), (0.4, 0.2)} <= ends
    levels = {round(line.get_ydata()[0], 12) for line in ax.lines if line.get_color() == "0.25"}
    assert {0.0, 0.2} <= levels


@pytest.mark.parametrize("name", SHIPPED)
def test_sketch_of_every_shipped_structure_shows_all_its_bodies_and_feet(name):
    """Whatever it is, in a state that is none of rest, and nothing is left out."""
    structure = SHIPPED[name](**plain(name))
    figure = drawn(draw_structure(structure, rotation=0.02))
    (ax,) = figure.axes
    m, shapes = structure.module, structure.shapes
    state = {m.STATES[m.ROTATION]: 0.02}
    shown = np.array([line.get_xydata()[0] for line in ax.lines if len(line.get_xdata()) == 1])
    for at, kind in zip(structure.positions(state).values(), m.POSITION_KINDS, strict=True):
        if kind not in ("load", "massless") and not shapes.copies:
            assert np.abs(shown - at).max(axis=1).min() < 1e-12
    assert len(ax.collections) >= 1  # the ground
