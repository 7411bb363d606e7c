"""Draw the pictures of README.md and generated/ into docs/images: ``python docs/pictures.py``."""

import io
from pathlib import Path

import diagrams
import gallery
import numpy as np
from matplotlib.figure import Figure
from PIL import Image

import rockeom as rk
from rockeom.cli import demo
from rockeom.drawing import style
from rockeom.plots import animate, draw_structure
from rockeom.structures.classes import SHIPPED

FOLDER = Path(__file__).parent / "images"
FRAMES_PER_SECOND = 15.0
SKETCH = 1.5, 1.4  # in

EXAMPLES = (
    "rigid_block", "sliding_block", "stacked_blocks", "flexible_structure", "rocking_frame",
    "controlled_wall", "wall_with_frame",
)  # fmt: skip
"""Structures of README.md that are examples of the gallery, too."""


def shear_frame() -> tuple[rk.Structure, dict[str, float]]:
    """A frame of three storeys, and the state in which it is drawn."""
    frame = rk.ShearFrame(
        masses=[20e3, 20e3, 15e3],
        heights=[3.5, 7.0, 10.5],
        stiffnesses=[30e6, 30e6, 20e6],
        dampings=[150e3, 150e3, 100e3],
        half_width=2.5,
        base_mass=30e3,
        base_inertia=4e4,
    )
    return frame, {"theta": 0.06, "u_1": 0.2, "u_2": 0.4, "u_3": 0.5}


IN_SPACE = {
    "prism": (
        rk.Prism(width=0.5, depth=0.7, height=1.6, mass=1500.0),
        {"yaw": 0.3, "pitch": 0.16, "roll": -0.1},
    ),
    "wobbling_column": (
        rk.WobblingColumn(radius=0.4, height=1.7, mass=2000.0),
        {"tilt": 0.22, "direction": -0.2},
    ),
}  # fmt: skip
"""Bodies in space of README.md, and the states in which they are drawn."""


def sketch(structure: rk.Structure, state: dict[str, float]) -> Figure:
    figure = style.new_figure(*SKETCH)
    figure.set_layout_engine("none")
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    draw_structure(structure, state=state, ax=ax)
    for text in ax.texts:
        text.remove()
    ax.margins(0.15, 0.1)
    return figure


def free_body(name: str) -> Image.Image:
    """The free-body diagram of a shipped structure."""
    data = io.BytesIO()
    diagrams.diagram(name).savefig(data, dpi=110, bbox_inches="tight", facecolor="white")
    return Image.open(data).convert("RGB").convert("P", palette=Image.Palette.ADAPTIVE, colors=32)


def statue(end: float = 7.0) -> list[Image.Image]:
    """A statue under El Centro 1940, which rocks at a peak of 0.5 g and falls at 0.6 g."""
    block = rk.RigidBlock(half_width=0.25, half_height=0.9)
    record = rk.GroundMotion.from_library("El Centro 1940 180")
    runs = {g: rk.simulate(block, record.scaled_to(g * 9.81)) for g in (0.5, 0.6)}
    times = np.arange(0.0, end, 1.0 / FRAMES_PER_SECOND)
    return [_frame(runs, record, float(t)) for t in times]


def _frame(runs: dict[float, rk.Response], record: rk.GroundMotion, t: float) -> Image.Image:
    figure = style.new_figure(6.4, 3.4)
    figure.set_layout_engine("none")
    drawings = figure.subplots(
        1, 2, gridspec_kw={"bottom": 0.27, "top": 0.9, "left": 0.02, "right": 0.98, "wspace": 0.02}
    )
    for ax, (g, run) in zip(drawings, runs.items(), strict=True):
        now = min(t, float(run.t[-1]))
        animate(run, start=now - 1e-3 if now else 0.0, end=now or 1e-3).draw(0, ax)
        ax.set(xlim=(-2.2, 1.3), ylim=(-0.15, 2.1), title=f"peak {g} g")
    trace = figure.add_axes((0.08, 0.07, 0.86, 0.16))
    samples = np.linspace(0.0, 8.0, 1601)
    trace.plot(samples, record.acceleration(samples), color=style.INK, lw=0.7)
    trace.axvline(t, color=style.LINES[1], lw=1.5)
    trace.set(xlim=(0.0, 8.0), yticks=[], xlabel="")
    trace.text(1.01, -0.35, "s", transform=trace.transAxes)
    data = io.BytesIO()
    figure.savefig(data, dpi=80)
    return Image.open(data).convert("P", palette=Image.Palette.ADAPTIVE, colors=32)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    drawn = {name: gallery.sketched(name) for name in EXAMPLES} | {"shear_frame": shear_frame()}
    drawn |= IN_SPACE
    for name, (structure, state) in drawn.items():
        sketch(structure, state).savefig(FOLDER / f"{name}.png", dpi=110)
    (FOLDER / "free_body").mkdir(exist_ok=True)
    for name in SHIPPED:
        free_body(name).save(FOLDER / "free_body" / f"{name}.png", optimize=True)
    first, *others = statue()
    first.save(
        FOLDER / "statue.gif",
        save_all=True,
        append_images=[*others, *[others[-1]] * 15],
        duration=1000.0 / FRAMES_PER_SECOND,
        loop=0,
        optimize=True,
    )
    demo.draw(demo.simulate_all(demo.el_centro()), FOLDER / "el_centro.png", dpi=110)
