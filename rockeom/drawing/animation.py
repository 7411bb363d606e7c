"""A response in motion: the structure drawn to scale, frame by frame, above the moving ground."""

from __future__ import annotations

import base64
import html
import io
import math
import os
import textwrap
import uuid
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from PIL import Image

from rockeom.drawing import film, free_body, style
from rockeom.drawing.checks import check_drawn
from rockeom.drawing.plan import tilts_of
from rockeom.drawing.scene import (
    LOOKS,
    VIEW,
    Scene,
    corners,
    ground_under,
    ring_of,
    view_from,
    work_of,
)
from rockeom.drawing.sketch import Sketch, all_points
from rockeom.files import check_path, check_target, write
from rockeom.integrator.schema import in_space
from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.slope import SLOPE, seen_from
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, number, require
from rockeom.simulation.response import Response
from rockeom.structures.positions import places

MOST_FRAMES = 2000
FLASH = 0.2
"""How long an impact is shown [s of the viewer]."""
FILES = (".gif", ".html", ".mp4")
_WIDTH, _DPI = 4.8, 100  # in, dots per in
_HEIGHTS = 2.6, 6.0  # in
_TOP, _BOTTOM = 0.62, 0.30  # in, above and below the drawing
_HISTORY = 1.15  # in, of the tilt against time


@explained.calls(fps="frames_per_second")
def animate(
    run: Response,
    path: str | os.PathLike[str] | None = None,
    *,
    start: float | None = None,
    end: float | None = None,
    frames_per_second: float = 20.0,
    speed: float = 1.0,
    ground: bool = True,
    view: Sequence[float] = VIEW,
) -> Animation:
    """Draw the response as an animation, in a file or a notebook.

    Parameters
    ----------
    run : Response
        Response.
    path : path_like, optional
        File to write: .gif; .html, a page that needs nothing else, with a slider; or .mp4, which
        needs ffmpeg, of the system or of the package imageio-ffmpeg. None writes none.
    start : float, optional
        Start of the part of the response that is shown [s]; that of the response if not given.
    end : float, optional
        End of the part [s]; that of the response if not given.
    frames_per_second : float, optional
        Number of frames in a second of the viewer's time.
    speed : float, optional
        Factor by which the animation runs faster than real time.
    ground : bool, optional
        Whether the ground moves, by the displacement that follows from its acceleration; else the
        drawing moves with it. Structures in pure numbers are drawn so in any case.
    view : tuple of (float, float), optional
        Azimuth from which a structure in space is seen, counter-clockwise from x seen from above,
        and elevation [rad].

    Returns
    -------
    Animation
        Animation, which Jupyter shows.

    Raises
    ------
    ValueError
        For times outside the response, more than 2000 frames, other files, and a view from below.
    FileNotFoundError
        For .mp4 without ffmpeg.

    Notes
    -----
    Bodies are where the generated module puts them, drawn as by `draw_structure`. White circles are
    feet in contact, stars those that have just landed; the dashed line stands still. In space feet
    that bear are orange, and the tilt stands below against time.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import plots
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> run = rk.simulate(block, rk.GroundMotion.none(2.0), initial={"theta": 0.1})  # s, rad
    >>> animation = plots.animate(run, start=0.0, end=1.0)  # s
    >>> len(animation.times)
    21
    >>> animation = plots.animate(run, "block.gif")  # doctest: +SKIP
    """
    check_drawn("run", run, Response)
    if path is not None:
        check_file(path)  # before the frames are drawn
    made = Animation(run, _times(run, start, end, frames_per_second, speed), speed, ground, view)
    if path is not None:
        check_path(path)
        made.save(path)
    return made


def check_file(path: str | os.PathLike[str]) -> None:
    """Raise ValueError for a file that is no film, OSError for one that cannot be written."""
    kind = Path(path).suffix.lower()
    if kind not in FILES:
        endings = f"{', '.join(FILES[:-1])} or {FILES[-1]}"
        raise InputError("path", path).says(f"{path}: the name of an animation ends in {endings}")
    check_target(path)
    if kind == ".mp4":
        film.ffmpeg()


def _times(
    run: Response, start: float | None, end: float | None, frames_per_second: float, speed: float
) -> np.ndarray:
    """(n,) times of the frames [s], the last of which may fall short of the end."""
    rates = {"frames_per_second": frames_per_second, "speed": speed}
    for name, value in rates.items():
        require(0.0 < number(name, value) < math.inf, "", name, value, "give a number above zero")
    ends = run.t[0] if start is None else start, run.t[-1] if end is None else end
    first, last = (number(n, value) for n, value in zip(("start", "end"), ends, strict=True))
    if not run.t[0] <= first < last <= run.t[-1]:
        raise InputError("start", first).wrong(
            f"is {first:g} s, and the end {last:g} s: they lie within the response, from "
            f"{run.t[0]:g} to {run.t[-1]:g} s, start before end"
        )
    step = speed / frames_per_second
    n = math.floor((last - first) / step * (1 + 1e-12)) + 1
    if n > MOST_FRAMES:
        faster = f"{{speed:{speed * n / MOST_FRAMES:.2g}}}"
        raise InputError("frames_per_second", frames_per_second).says(
            f"{n} frames are more than {MOST_FRAMES}: show a part by {{start}} and {{end}}, run it "
            f"faster by {faster}, or draw fewer by {{frames_per_second}}"
        )
    return np.minimum(first + step * np.arange(n), last)


def ground_displacement(motion: GroundMotion, times: np.ndarray) -> np.ndarray:
    """Displacement (n,) [m] of the ground at times (n,) [s], which stops where the motion ends."""
    return motion.displacement(np.clip(times, 0.0, motion.duration))


class Animation:
    """Frames of a response; made by `animate`.

    Parameters
    ----------
    run : Response
        Response.
    times : ndarray
        Times of the frames (n,) [s].
    speed : float
        Factor by which the animation runs faster than real time.
    ground : bool
        Whether the ground moves.
    view : tuple of (float, float), optional
        Azimuth and elevation from which a structure in space is seen [rad].
    """

    def __init__(
        self,
        run: Response,
        times: np.ndarray,
        speed: float,
        ground: bool,
        view: Sequence[float] = VIEW,
    ) -> None:
        self.run, self.times, self.speed, self.view = run, times, speed, view
        self.states, self.modes = run.steps.at(times, "right")
        self.in_space = in_space(run.structure.module)
        motions = (run.motion, *(run.transverse,) * self.in_space, run.vertical)
        self.ground = np.zeros((len(times), len(motions)))
        if ground and not style.is_dimensionless(run):
            for i, motion in enumerate(motions):
                if motion is not None:
                    self.ground[:, i] = ground_displacement(motion, times)
        if self.in_space:
            self.ground[:, :2] = np.transpose(seen_from(run.azimuth, *self.ground[:, :2].T))
            self.ground = view_from(view).of(self.ground)
        if run.slope and run.ground_axes == SLOPE:
            self.ground = free_body.turned(self.ground, (0.0, 0.0), run.slope)

    def __len__(self) -> int:
        return len(self.times)

    @property
    def frames_per_second(self) -> float:
        """Number of frames shown in a second."""
        return self.speed / self._step

    @property
    def _step(self) -> float:
        return float(self.times[1] - self.times[0]) if len(self) > 1 else self.speed

    def __repr__(self) -> str:
        return (
            f"<Animation: {len(self)} frames, {self.frames_per_second:.4g} a second, "
            f"from {self.times[0]:.4g} to {self.times[-1]:.4g} s>"
        )

    # -- one frame

    def draw(self, i: int, ax: Axes) -> None:
        """Draw a frame into empty axes of equal scales.

        Parameters
        ----------
        i : int
            Number of the frame.
        ax : matplotlib.axes.Axes
            Axes.
        """
        sketch = self._sketch(i)
        sketch.draw(ax, self.run.slope)
        for foot in () if self.in_space else sketch.closed_feet:
            for at in self._feet(sketch, foot):
                free_body.pivot(ax, at)
        size = 12 if self.in_space else 17  # feet in space are many
        for foot in self._landing(i, sketch):
            for at in self._feet(sketch, foot):
                ax.plot(*at, "*", color=style.LINES[1], mec=style.INK, mew=0.5, ms=size, zorder=10)
        x, y = self.ground[i]
        (left, right), (low, high) = self.limits
        if self.ground.any():
            free_body.line(ax, (-x, low - y), (-x, high - y))
        ax.set(xlim=(left - x, right - x), ylim=(low - y, high - y), aspect="equal")
        ax.axis("off")

    def _sketch(self, i: int) -> Sketch | Scene:
        structure, y, mode = self.run.structure, self.states[i], int(self.modes[i])
        if self.in_space:
            return Scene(structure, y, mode, self.view, self._floor)
        return Sketch(structure, y, mode)

    def _feet(self, sketch: Sketch | Scene, foot: str) -> np.ndarray:
        """(k, 2) where a foot is drawn, and those of the copies of its body."""
        return free_body.turned(sketch.feet_at(foot), (0.0, 0.0), self.run.slope)

    def title(self, i: int) -> str:
        """Time, and how many impacts there have been.

        Parameters
        ----------
        i : int
            Number of the frame.

        Returns
        -------
        str
            Text.
        """
        digits = max(2, math.ceil(-math.log10(self._step)))
        unit = "" if style.is_dimensionless(self.run) else " s"
        text = f"t = {self.times[i]:.{digits}f}{unit}"
        if self.speed != 1.0:
            text += f" ({self.speed:g} times real time)"
        n = int(np.searchsorted(self.run.impacts.times, self.times[i], side="right"))
        return f"{text}, {n} impact{'s' * (n != 1)}"

    def _landing(self, i: int, sketch: Sketch | Scene) -> set[str]:
        """Feet that met the ground a moment ago."""
        before = self.times[i] - max(FLASH * self.speed, self._step)
        impacts = self.run.impacts
        which = (impacts.times > before) & (impacts.times <= self.times[i])
        landed: set[str] = set()
        for k in np.flatnonzero(which).tolist():
            impact = impacts[k]
            after = style.feet_of(impact.mode_after)
            named = impact.contact.split("+") if impact.contact else [after]
            landed |= {*named} & {*sketch.feet} or {*sketch.closed_feet}
        return landed

    @cached_property
    def limits(self) -> np.ndarray:
        """(2, 2) least and largest x and y of all that is drawn, where the ground stood at rest."""
        points = self._places_in_space() if self.in_space else self._places_in_plane()
        points = points + self.ground[:, None]
        low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
        size = float((high - low).max()) or 1.0
        beside = np.array([0.2 * size, 0.08 * size])
        return np.array([low - beside - [0.0, 0.1 * size], high + beside]).T

    def _places_in_plane(self) -> np.ndarray:
        """(n, k, 2) places of all that is drawn, relative to the ground."""
        points = all_points(self.run.structure, self._poses)
        turned = free_body.turned(points.reshape(-1, 2), (0.0, 0.0), self.run.slope)
        return turned.reshape(points.shape)

    def _places_in_space(self) -> np.ndarray:
        points = corners(self.run.structure, self._poses)
        ring = np.broadcast_to(ring_of(self._floor), (len(points), 4, 3))
        return view_from(self.view).of(np.concatenate([points, ring], axis=1))

    @cached_property
    def _poses(self) -> np.ndarray:
        structure = self.run.structure
        return places(structure.module, self.modes, self.states, structure.vector)

    @cached_property
    def _floor(self) -> np.ndarray:
        return ground_under(corners(self.run.structure, self._poses))

    # -- all of them

    @cached_property
    @style.styled
    def frames(self) -> tuple[bytes, ...]:
        """The frames as PNG, each drawn once."""
        (left, right), (low, high) = self.limits
        tall = (_WIDTH - 0.2) * (high - low) / (right - left)
        tall = min(max(tall, _HEIGHTS[0]), _HEIGHTS[1])
        below = _BOTTOM + _HISTORY * self.in_space
        height = tall + _TOP + below
        figure = Figure(figsize=(_WIDTH, height), dpi=_DPI)
        canvas = FigureCanvasAgg(figure)
        ax = figure.add_axes((0.02, below / height, 0.96, tall / height))
        name = textwrap.shorten(style.plain(style.title_of(self.run)), 62, placeholder=" ...")
        figure.text(0.5, 1 - 0.12 / height, name, ha="center", va="top", fontsize=9.5)
        clock = figure.text(0.5, 1 - 0.34 / height, "", ha="center", va="top", fontsize=9)
        signs = _signs(self)
        figure.legend(handles=signs, loc="lower center", ncols=max(3, len(signs)), fontsize=8)
        now = [self._history(figure, height)] if self.in_space else []
        pictures = []
        for i in range(len(self)):
            for artist in (*ax.lines, *ax.patches, *ax.collections, *ax.texts):
                artist.remove()  # to clear the axes takes as long as to draw them
            self.draw(i, ax)
            clock.set_text(self.title(i))
            for line in now:
                line.set_xdata(self.times[[i, i]])
            canvas.draw()
            pictures.append(_png(canvas))
        return tuple(pictures)

    def _history(self, figure: Figure, height: float) -> Line2D:
        """The tilt against time below the drawing, and the line that stands at a frame."""
        run = self.run
        (tilt, *_) = tilts_of(run.places.rotations()).values()
        first, last = np.searchsorted(run.t, self.times[[0, -1]], side="right")
        shown = slice(max(first - 1, 0), last + 1)  # from the sample before to the one after
        tilt = tilt[shown]
        ax = figure.add_axes((0.13, (_BOTTOM + 0.42) / height, 0.83, (_HISTORY - 0.5) / height))
        ax.plot(run.t[shown], tilt, color=style.LINES[0], lw=0.9)
        ax.set(xlim=self.times[[0, -1]], ylim=(0.0, 1.08 * tilt.max() or 1.0))
        ax.set(xlabel=style.time_label(run), ylabel="tilt [rad]")
        ax.yaxis.set_major_locator(MaxNLocator(3))
        return ax.axvline(float(self.times[0]), color=style.LINES[1], lw=1.2)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a .gif, a .html page or a .mp4.

        Parameters
        ----------
        path : path_like
            File.

        Raises
        ------
        ValueError
            For any other name.
        FileNotFoundError
            For .mp4 without ffmpeg.
        """
        check_file(path)
        kind = Path(path).suffix.lower()
        if kind == ".mp4":
            write(path, film.mp4(self.frames, self.frames_per_second))
            return
        if kind == ".html":
            title = html.escape(style.title_of(self.run))
            page = '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
            page += '<meta name="viewport" content="width=device-width, initial-scale=1">'
            page += f"<title>{title}</title></head>\n<body>{self._repr_html_()}</body></html>\n"
            write(path, page)
            return
        first, *rest = (Image.open(io.BytesIO(frame)) for frame in self.frames)
        # it counts hundredths of a second: rounded so that no frame is late
        ticks = np.round(100 * np.arange(len(self) + 1) / self.frames_per_second)
        lasting = [10 * int(n) for n in np.diff(ticks)]
        made = io.BytesIO()
        first.save(made, "GIF", save_all=True, append_images=rest, duration=lasting, loop=0)
        write(path, made.getvalue())

    def _repr_html_(self) -> str:
        return _player(self.frames, self.frames_per_second, self.run)


def _signs(animation: Animation) -> list[Line2D]:
    """Meanings of the marks that the structure has."""
    signs: list[Line2D] = []
    module: Any = animation.run.structure.module
    if animation.in_space:
        works = {
            work_of(module, foot, mode)
            for mode in np.unique(animation.modes)
            for foot in getattr(module, "POINTS", ())
        }
        works.update(["bears"] * ("massless" in module.POSITION_KINDS))  # of a rim
        signs += [_sign(work, ls="", **look) for work, look in LOOKS.items() if work in works]
    elif {"foot", "point"} & {*module.POSITION_KINDS}:
        signs.append(_sign("in contact", ls="", marker="o", color="white", ms=5.5))
    if len(animation.run.impacts):
        signs.append(_sign("impact", ls="", marker="*", color=style.LINES[1], ms=11))
    if animation.ground.any():
        signs.append(_sign("stands still", ls=(0, (6, 3)), color="0.45", lw=0.8))
    return signs


def _sign(label: str, **look: Any) -> Line2D:
    return Line2D([], [], mec=style.INK, label=label, **look)


def _png(canvas: FigureCanvasAgg) -> bytes:
    """The drawing in 64 colours: it has few."""
    image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    kept = io.BytesIO()
    image.quantize(64, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(kept, "PNG")
    return kept.getvalue()


_PLAYER = """\
<div id="{key}" style="display:inline-block;max-width:100%;font:13px sans-serif;color:#333">
<img alt="{title}" src="data:image/png;base64,{first}" style="display:block;max-width:100%">
<div style="display:flex;gap:8px;padding:4px">
<button type="button">pause</button>
<input type="range" aria-label="frame" min="0" max="{last}" value="0" style="flex:1">
</div>
<script>
(function () {{
  const box = document.getElementById("{key}"), image = box.querySelector("img");
  const button = box.querySelector("button"), slider = box.querySelector("input");
  const frames = [{frames}];
  let timer = null;
  function show(i) {{ slider.value = i; image.src = "data:image/png;base64," + frames[i]; }}
  function pause() {{ clearInterval(timer); timer = null; button.textContent = "play"; }}
  function play() {{
    button.textContent = "pause";
    timer = setInterval(() => show((Number(slider.value) + 1) % frames.length), {pause});
  }}
  button.onclick = () => timer === null ? play() : pause();
  slider.oninput = () => {{ pause(); show(Number(slider.value)); }};
  matchMedia("(prefers-reduced-motion: reduce)").matches ? pause() : play();
}})();
</script>
</div>
"""


def _player(frames: tuple[bytes, ...], frames_per_second: float, run: Response) -> str:
    """The frames with a button and a slider, as a piece of a page that needs nothing else."""
    coded = [base64.b64encode(frame).decode() for frame in frames]
    return _PLAYER.format(
        key=f"rockeom-{uuid.uuid4().hex}",
        title=html.escape(style.title_of(run), quote=True),
        first=coded[0],
        last=len(coded) - 1,
        frames=",".join(f'"{frame}"' for frame in coded),
        pause=f"{1000 / frames_per_second:.3f}",
    )
