"""The gallery: each structure, plot, command and figure of the thesis, with what it makes.

What is shown is made while the page is built: the examples below are run, the sketches drawn, the
commands called. A structure that is shipped and has no example here fails a test.
"""

import contextlib
import io
import re
import shlex
import tempfile
import textwrap
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import catalogue
import matplotlib.image
from matplotlib.figure import Figure

import rockeom as rk
from rockeom import cli, plots
from rockeom.cli.commands import HELP
from rockeom.plots import style
from rockeom.structures.classes import SHIPPED
from rockeom.thesis.figures import FIGURES

HERE = Path(__file__).parent
PICTURES = HERE / "_build" / "gallery"
WIDTH = 360  # of a thumbnail [pixels]
LINES_OF_OUTPUT = 10
EXPLORERS = "explorers"
"""The folder of the pages with sliders, see `explorers`."""

FIRST = """\
import rockeom as rk
from rockeom.cli.demo import COLUMN  # a steel column of shaking-table tests, in SI units

still = rk.GroundMotion.none(4.0)  # s
pulse = rk.GroundMotion.single_sine(amplitude=5.0, period=0.4, duration=3.0)  # m/s2, s, s"""
"""What all examples begin with."""


class Example(NamedTuple):
    """Two lines: the first makes `structure`, the second `run`; and the state that is sketched."""

    structure: str
    run: str
    state: dict[str, float]


PUSHED = "run = rk.simulate(structure, pulse)"
TILTED = {"theta": 0.12}
BENT = {"theta": 0.12, "u": 0.08}

STRUCTURES = {
    "rigid_block": Example(
        "structure = rk.RigidBlock(half_width=0.2, half_height=0.8)",
        'run = rk.simulate(structure, still, initial={"theta": 0.15})',
        TILTED,
    ),
    "offset_block": Example(
        "structure = rk.RigidBlock.from_dimensions(width=0.4, height=1.6, offset=0.05)",
        'run = rk.simulate(structure, still, initial={"theta": 0.15})',
        TILTED,
    ),
    "slender_block": Example(
        "structure = rk.SlenderBlock.from_frequency(p=3.0, alpha=0.2)",
        'run = rk.simulate(structure, still, initial={"theta": 0.15})',
        TILTED,
    ),
    "nondimensional_block": Example(
        "structure = rk.NondimensionalBlock(alpha=0.3)",
        'run = rk.simulate(structure, rk.GroundMotion.none(8.0), initial={"x": 0.7})',
        {"x": 0.5},
    ),
    "sliding_block": Example(
        "structure = rk.SlidingBlock(\n    half_width=0.2, half_height=0.5, friction=0.45, "
        "restitution=0\n)",
        PUSHED,
        {"theta": 0.15, "x": 0.1},
    ),
    "stacked_blocks": Example(
        "structure = rk.StackedBlocks(\n    lower_half_width=0.4, lower_half_height=0.4, "
        "upper_half_width=0.2, upper_half_height=0.5\n)",
        PUSHED,
        {"phi": 0.15},
    ),
    "dirac_delta_block": Example(
        "structure = rk.DiracDeltaBlock(alpha=0.25, energy_ratio=0.8, regularisation=0.01)",
        'run = rk.simulate(structure, rk.GroundMotion.none(8.0), initial={"x": 0.4})',
        {"x": 0.5},
    ),
    "lumped_mass_structure": Example(
        "structure = rk.LumpedMassStructure(**COLUMN)", PUSHED, TILTED
    ),
    "two_spring_structure": Example(
        "structure = rk.TwoSpringStructure(\n    **COLUMN, foundation_stiffness=550e3, "
        "foundation_damping=3e3\n)",
        PUSHED,
        TILTED,
    ),
    "two_spring_cart": Example(
        "structure = rk.TwoSpringCart(**COLUMN, foundation_stiffness=550e3)", PUSHED, {"u": 0.1}
    ),
    "uplifting_oscillator": Example(
        "structure = rk.UpliftingOscillator.from_frequency(20.0, 0.02, height=1.5, half_width=0.4)",
        PUSHED,
        BENT,
    ),
    "flexible_structure": Example(
        "structure = rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4)",
        "run = rk.simulate(structure, pulse, impact=rk.Impulsive())",
        BENT,
    ),
    "controlled_wall": Example(
        "structure = rk.ControlledWall.thesis()",
        'run = rk.simulate(structure, rk.GroundMotion.none(1.0), initial={"theta": 0.01})',
        {"theta": 0.08},
    ),
    "flexible_controlled_wall": Example(
        "structure = rk.FlexibleControlledWall.thesis(damping_ratio=0.02)",
        'run = rk.simulate(structure, rk.GroundMotion.none(1.0), initial={"theta": 0.01})',
        {"theta": 0.08, "u": 0.1},
    ),
    "controlled_wall_oscillator": Example(
        "structure = rk.ControlledWallOscillator.thesis(energy_ratio=0.88)",
        'run = rk.simulate(structure, rk.GroundMotion.none(2.0), initial={"u": 0.03})',
        {"u": 0.1},
    ),
    "substitute_gravity_wall": Example(
        "structure = rk.SubstituteGravityWall.thesis()",
        'run = rk.simulate(structure, rk.GroundMotion.none(1.0), initial={"theta": 0.01})',
        {"theta": 0.08},
    ),
    "simplified_substitute_gravity_wall": Example(
        "structure = rk.SimplifiedSubstituteGravityWall.thesis()",
        'run = rk.simulate(structure, rk.GroundMotion.none(1.0), initial={"theta": 0.01})',
        {"theta": 0.08},
    ),
    "rocking_frame": Example(
        "structure = rk.RockingFrame(\n    columns=3, column_mass=1e3, half_width=0.2, "
        "half_height=0.8, beam_mass=4e3\n)",
        PUSHED,
        {"theta": 0.12},
    ),
    "wall_with_frame": Example(
        "structure = rk.WallWithFrame(\n    mass=4e4, half_width=1.0, height=4.0, inertia=3e5, "
        "frame_mass=1e5, frame_stiffness=2e7,\n    frame_damping=6e4, link_height=8.0, "
        "link_stiffness=1e8, link_damping=1e5\n)",
        PUSHED,
        {"theta": 0.06},
    ),
}
"""Of each shipped structure."""

OF_THE_THESIS = {
    "slender_block", "nondimensional_block", "dirac_delta_block", "two_spring_cart",
    "uplifting_oscillator", "controlled_wall_oscillator", "substitute_gravity_wall",
    "simplified_substitute_gravity_wall",
}  # fmt: skip
"""Shipped structures that approximate one of the others, as the thesis or a paper has them."""

PLOTS = {
    "draw_structure": 'figure = plots.draw_structure(column, state={"theta": 0.1, "u": 0.05})',
    "plot_response": "figure = run.plot()",
    "plot_comparison": 'figure = plots.plot_comparison([run, stiff], ["r = 0.8", "r = 0.95"])',
    "plot_phase_portrait": """\
block = rk.RigidBlock(half_width=0.2, half_height=0.8)
released = [rk.simulate(block, still, initial={"theta": at}) for at in (0.24, 0.15)]
figure = plots.plot_phase_portrait(released, separatrix=True)""",
    "plot_tracks": "figure = plots.plot_tracks(shaken_prism)",
    "plot_tilt": "figure = plots.plot_tilt(shaken_prism)",
    "design_report": "figure = plots.design_report(column, [pulse, stronger]).figures()",
    "poincare_section": """\
found = analysis.dynamics.poincare_sections(
    shaken(3.3), starts={"x": np.linspace(0.1, 0.2, 40)}, cycles=40, impacts=3
)
figure = plots.poincare_section(found, x="impact_time", y="x_dot", at="after")""",
    "bifurcation_diagram": """\
found = analysis.dynamics.poincare_sections(
    shaken, over={"beta": np.linspace(2.2, 3.3, 150)}, starts={"x": [-0.1, 0.1]}, impacts=3
)
start = found.strobe.isel(beta=0, x=0, look=-1).values
symmetric = analysis.dynamics.orbit_branch(shaken, between=(2.2, 3.3), guess=start)
broken = symmetric.switched(symmetric.bifurcations[0])
figure = plots.bifurcation_diagram(
    found, x="beta", y="x_dot", at="before", branches=[symmetric, broken]
)""",
    "basins_of_attraction": """\
starts = {"x": np.linspace(-1.0, 1.0, 120), "x_dot": np.linspace(-1.2, 1.2, 120)}
found = analysis.dynamics.poincare_sections(
    shaken(3.0, 1.0, 0.9), starts=starts, settling=150, cycles=12
)
figure = plots.basins_of_attraction(analysis.dynamics.basins(found), x="x", y="x_dot")""",
    "peak_distributions": """\
drawn = np.random.default_rng(1).lognormal([[-2.4], [-2.1]], 0.6, (2, 80))  # rad
one, other = (analysis.validation.Ensemble(peaks, peaks > 0.2) for peaks in drawn)
figure = plots.peak_distributions({"laboratory A": one, "laboratory B": other}, limit=0.2)""",
    "reliability_diagram": """\
probability, fate = np.random.default_rng(2).random((2, 150))
found = analysis.validation.calibration_of(fate < probability**1.5, probability)
figure = plots.reliability_diagram(found)""",
}
"""Of what `rockeom.plots` draws; what has no example is named by its first sentence."""

BEFORE_PLOTS = """\
import numpy as np
from rockeom import analysis, plots

column = rk.FlexibleStructure(**COLUMN, stiffness=571.8e3, damping=502.4)
run, stiff = (rk.simulate(column, pulse, impact=rk.EnergyRatio(r)) for r in (0.8, 0.95))
stronger = pulse.scaled(acceleration=1.5)

prism = rk.Prism(width=0.5, depth=0.7, height=2.0, mass=2000.0)
shaken_prism = rk.simulate(prism, pulse, transverse=0.7 * pulse, initial={"roll": 0.06})

squat = rk.NondimensionalBlock(alpha=np.arctan(0.5))


def shaken(beta, period=3.0, e=0.5):  # by beta cos(omega t)
    shaking = rk.GroundMotion.harmonic(
        beta * squat.alpha, period=period, phase=np.pi / 2, duration=300 * period
    )
    law = rk.VelocityRatio(e)
    return analysis.dynamics.StroboscopicMap(squat, shaking, period, impact=law, mirrored=True)"""


def gallery(part: str) -> str:
    """A part of the page, as Markdown."""
    return {"structures": _structures, "plots": _plots, "commands": _commands, "figures": _figures}[
        part
    ]()


# --- structures


def _structures() -> str:
    return _python(FIRST) + "\n\n" + _cards(_structure_card(name) for name in SHIPPED)


def sketched(name: str) -> tuple[rk.Structure, dict[str, float]]:
    """The structure of an example, and the state in which it is sketched."""
    example = STRUCTURES[name]
    return _executed(FIRST, example.structure)["structure"], example.state


def _structure_card(name: str) -> str:
    example, cls = STRUCTURES[name], SHIPPED[name]
    names = _executed(FIRST, example.structure, example.run)
    run = names["run"]
    picture = _structure_picture(names["structure"], run, example.state)
    text = f"{_first_sentence(cls)} *Here: {run.outcome}, {run.impacts.describe()}.*"
    return "\n\n".join(
        [
            f"**[{cls.__name__}](#rockeom.{cls.__name__})**",
            _image(picture, f"structure-{name}", f"{cls.__name__}, sketched, and its motion"),
            text,
            f"[Its equations](derived/{name}.md)",
            f'<a href="{EXPLORERS}/{name}.html">Move it on a page with sliders</a>',
            _python(f"{example.structure}\n{example.run}"),
        ]
    )


@style.styled
def _structure_picture(structure: rk.Structure, run: rk.Response, state: dict) -> Figure:
    """The sketch, and the coordinate that overturns against time."""
    figure = style.new_figure(4.6, 2.0)
    sketch, motion = figure.subplots(1, 2, width_ratios=(1, 1.5))
    plots.draw_structure(structure, state=state, ax=sketch)
    coordinate, unit = (
        run.states[run.structure.module.ROTATION],
        run.structure.module.STATE_UNITS[run.structure.module.ROTATION],
    )
    motion.plot(run.t, run[coordinate], color=style.LINES[0], lw=1.0)
    motion.set(xlabel=style.time_label(run), ylabel=f"{coordinate} [{unit}]")
    return figure


def reference(kind: str = "") -> str:
    """The directives of the reference that show the classes of shipped structures, with examples.

    kind : "main", "thesis" for approximations of those, or all.
    """
    thesis = {"main": (False,), "thesis": (True,)}.get(kind, (False, True))
    shown = [name for name in SHIPPED if (name in OF_THE_THESIS) in thesis]
    return "\n\n".join(_documented(name) for name in shown)


def _documented(name: str) -> str:
    example = STRUCTURES[name]
    lines = f"{example.structure}\n{example.run}".replace("**COLUMN", "**column")
    code = ".. code-block:: python\n\n" + textwrap.indent(lines, "   ")
    return f".. autoclass:: rockeom.{SHIPPED[name].__name__}\n\n" + textwrap.indent(code, "   ")


# --- plots


def _plots() -> str:
    shown = [n for n in plots.__all__ if n in PLOTS or n.startswith(("plot_", "draw_"))]
    return _python(BEFORE_PLOTS) + "\n\n" + _cards(_plot_card(name) for name in shown)


def _plot_card(name: str) -> str:
    head = f"**[{name}](#rockeom.plots.{name})**"
    text = _first_sentence(getattr(plots, name))
    if name not in PLOTS:
        return f"{head}\n\n{text}"
    figure = _executed(FIRST, BEFORE_PLOTS, PLOTS[name])["figure"]
    picture = _image(figure, f"plot-{name}", text.rstrip("."))
    return "\n\n".join([head, picture, text, _python(PLOTS[name])])


# --- commands


def commands() -> dict[str, str]:
    """Each command with what it does."""
    return HELP


def examples_of_commands() -> dict[str, list[str]]:
    """The lines of the page of commands that call each of them."""
    page = (HERE / "reference" / "command-line.md").read_text(encoding="utf-8")
    found: dict[str, list[str]] = {}
    for block in re.findall(r"^```sh\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        for line in block.splitlines():
            if called := re.match(r"rockeom (\w+)", line):
                found.setdefault(called[1], []).append(line)
    return found


def _commands() -> str:
    examples = examples_of_commands()
    return "\n\n".join(
        _command(name, what, examples.get(name, [])) for name, what in commands().items()
    )


def _command(name: str, what: str, lines: list[str]) -> str:
    head = (
        f"**[rockeom {name}](reference/command-line.md#rockeom-{name})**: {catalogue.plain(what)}."
    )
    if not lines:
        return head
    return f"{head}\n\n```sh\n{lines[0]}\n```\n\n```text\n{_printed(lines[0])}\n```"


def _printed(line: str) -> str:
    """The first lines of what a command prints."""
    printed = io.StringIO()
    with (
        tempfile.TemporaryDirectory() as folder,
        contextlib.chdir(folder),
        contextlib.redirect_stdout(printed),
        contextlib.redirect_stderr(io.StringIO()),
    ):
        cli.main(shlex.split(line)[1:])
    lines = printed.getvalue().rstrip().splitlines()
    return "\n".join([*lines[:LINES_OF_OUTPUT], *(["..."] if lines[LINES_OF_OUTPUT:] else [])])


# --- figures of the thesis


def _figures() -> str:
    return _cards((_figure_card(number) for number in FIGURES), "small")


def _figure_card(number: str) -> str:
    one = FIGURES[number]
    picture = _image(catalogue.drawn(number), f"figure-{number}", f"Figure {number}")
    head = f"**[{number}](figures.md#figure-{number.lower()})** {catalogue.plain(one.title)}"
    return f"{picture}\n\n{head}"


# --- pieces


@cache
def _executed(*code: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    for text in code:
        exec(compile(text, "docs/gallery.py", "exec"), names)
    return names


def _image(figure: Figure, name: str, words: str) -> str:
    """A thumbnail of a figure, written beside the pages."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(PICTURES / f"{name}.png", dpi=WIDTH / figure.get_figwidth())
    return f"![{words}](_build/gallery/{name}.png)"


def thumbnail(source: Path, target: Path) -> None:
    """A picture, made as wide as a thumbnail."""
    with contextlib.suppress(FileNotFoundError):
        target.parent.mkdir(parents=True, exist_ok=True)
        width = matplotlib.image.imread(source).shape[1]
        matplotlib.image.thumbnail(str(source), str(target), scale=min(1.0, WIDTH / width))


def _cards(cards: Iterable[str], kind: str = "") -> str:
    inside = "\n".join(f":::{{container}} card\n{card}\n:::" for card in cards)
    return f"::::{{container}} cards {kind}\n{inside}\n::::"


def _python(code: str) -> str:
    return f"```python\n{code}\n```"


def _first_sentence(described: Any) -> str:
    text = re.split(r"\n\s*\n", (described.__doc__ or "").strip(), maxsplit=1)[0]
    return catalogue.plain(" ".join(text.split()))
