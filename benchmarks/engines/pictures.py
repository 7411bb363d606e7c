"""The pictures of docs/reference-cases.md: the bodies at the start, errors against time step."""

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from benchmarks.engines import cases
from benchmarks.engines.tables import errors, worst
from rockeom.drawing import style

SHOWN = ("free-decay", "pulse-overturns", "stick-slip", "rocking-frame")
MARKERS = "osD^v"


def corners(body: Mapping) -> np.ndarray:
    b, h = body["half_width"], body["half_height"]
    sine, cosine = math.sin(body["rotation"]), math.cos(body["rotation"])
    own = np.array([(-b, -h), (b, -h), (b, h), (-b, h)])
    x = body["x"] + own[:, 0] * cosine + own[:, 1] * sine
    return np.column_stack([x, body["z"] - own[:, 0] * sine + own[:, 1] * cosine])


def draw_start(ax: Axes, case: Mapping) -> None:
    """The bodies of a case, the ground, and arrows for what moves it."""
    bodies = case["model"]["bodies"]
    points = np.concatenate([corners(body) for body in bodies])
    size = float(max(np.ptp(points[:, 0]), points[:, 1].max()))
    middle = 0.5 * float(points[:, 0].min() + points[:, 0].max())
    for body in bodies:
        if body["half_width"]:
            ax.add_patch(Polygon(corners(body), facecolor="0.85", edgecolor=style.INK, lw=0.8))
        else:
            base = bodies[0]
            ax.plot([base["x"], body["x"]], [base["z"], body["z"]], color=style.INK, lw=1.5)
            ax.plot(body["x"], body["z"], "o", color=style.INK, ms=6)
        if body["velocity"][0]:
            _arrow(ax, (body["x"], body["z"]), 0.35 * size)
    for spring in case["model"]["springs"]:
        if "point" in spring:
            x, z = bodies[0]["x"] + spring["point"][0], -0.12 * size
            zigzag = np.array([0, 0, 1, -1, 1, -1, 0, 0]) * 0.03 * size
            ax.plot(x + zigzag, np.linspace(z, 0.0, 8), color=style.INK, lw=0.8)
    ground = -0.12 * size if case["model"]["guides"] and not case["model"]["contacts"] else 0.0
    ax.axhline(ground, color=style.INK, lw=0.8)
    if case["model"]["ground_motion"]:
        _arrow(ax, (middle - 0.18 * size, ground - 0.1 * size), 0.36 * size, "<->")
    ax.set(xlim=(middle - 0.75 * size, middle + 0.75 * size), ylim=(-0.25 * size, 1.2 * size))
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.set_title(case["id"], fontsize=7)


def _arrow(ax: Axes, start: tuple[float, float], length: float, kind: str = "->") -> None:
    to = start[0] + length, start[1]
    ax.annotate("", to, start, arrowprops={"arrowstyle": kind, "color": style.LINES[1]})


def starts(path: Path) -> None:
    figure = style.new_figure(7.5, 6.4)
    for ax, case in zip(figure.subplots(4, 5).flat, cases(), strict=True):
        draw_start(ax, case)
    figure.savefig(path, dpi=110)


def convergence(found: Mapping, path: Path) -> None:
    """The worst relative error of each program by step, for some cases."""
    figure = style.new_figure(7.5, 5.4)
    by_id = {case["id"]: case for case in cases()}
    for ax, name in zip(figure.subplots(2, 2, sharex=True).flat, SHOWN, strict=True):
        for i, (engine, one) in enumerate(found["engines"].items()):
            rows = [row for row in one["cases"][name] if "values" in row]
            quantity = worst(by_id[name], rows)
            if quantity is None:
                continue
            sizes = [errors(by_id[name], row)[quantity] for row in rows]
            steps = [row["step"] for row in rows]
            ax.loglog(
                steps, sizes, marker=MARKERS[i], ms=4, lw=1,
                color=style.LINES[i % len(style.LINES)], label=f"{engine}: {quantity}",
            )  # fmt: skip
        ax.loglog([1e-4, 1e-2], [1e-4, 1e-2], color="0.7", lw=0.8, ls="--")
        ax.set(title=name, ylabel="relative error")
        ax.legend(fontsize=6, frameon=False)
    for ax in figure.axes[2:]:
        ax.set_xlabel("time step [s]")
    figure.savefig(path, dpi=110)


def draw(found: Mapping, folder: Path) -> None:
    starts(folder / "reference_cases.png")
    convergence(found, folder / "reference_errors.png")
