"""Pages for Jupyter: of a structure, a response, a ground motion and a sweep.

Names are the user's: they are data, and escaped.
"""

from collections import Counter
from functools import partial
from html import escape

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from rockeom.drawing import style
from rockeom.drawing.page import image, table
from rockeom.drawing.response import plot_response
from rockeom.drawing.sketch import draw_structure
from rockeom.motion.ground_motion import GroundMotion
from rockeom.simulation.response import Response
from rockeom.structures.base import Structure

_table = partial(table, style="text-align:left")


def page_of_structure(shown: Structure) -> str:
    """A sketch next to a table of the parameters, as HTML."""
    m, values = shown.module, shown.parameters()
    rows = [
        (name.replace("_", " "), _value(values[name], unit), unit, meaning)
        for name, unit, meaning in zip(
            m.PARAMETERS, m.PARAMETER_UNITS, m.PARAMETER_MEANINGS, strict=True
        )
        if name in values
    ]
    title = (m.__doc__ or m.NAME).partition("\n")[0]
    sketch = image(draw_structure(shown), f"sketch of {type(shown).__name__}")
    table = _table(("parameter", "value", "unit", "meaning"), rows)
    return _page(type(shown).__name__, _side_by_side(sketch, f"<p>{escape(title)}</p>{table}"))


def page_of_response(shown: Response) -> str:
    """The summary above a figure, as HTML."""
    first, *lines = shown.summary().split("\n")
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    figure = plot_response(shown)
    assert isinstance(figure, Figure)
    return _page(first, f"<ul>{items}</ul>{image(figure, f'response: {shown.outcome}', 'png', 75)}")


def page_of_motion(shown: GroundMotion) -> str:
    """The acceleration next to a table of properties, as HTML."""
    rows = [("duration", f"{shown.duration:.6g}", "s"), ("peak", f"{shown.peak:.6g}", "m/s2")]
    if shown.dt is not None and shown.samples is not None:
        rows.append(("time step", f"{shown.dt:.6g}", "s"))
        rows.append(("samples", str(len(shown.samples)), ""))
    rows.append(("source", shown.source, ""))
    figure = _history(shown)
    picture = image(figure, "acceleration against time")
    name = shown.name or "a ground motion"
    return _page(name, _side_by_side(picture, _table(("", "value", "unit"), rows)))


def page_of_sweep(shown: xr.Dataset) -> str:
    """A count of outcomes above the table of a dataset, as HTML."""
    table = xr.Dataset._repr_html_(shown)
    if "outcome" not in shown:  # a part of it
        return table
    counts = Counter(shown["outcome"].values.ravel().tolist())  # of a million in no time
    rows = [(label, f"{n:,}") for label, n in counts.most_common()]
    model = str(shown.attrs.get("model", "sweep")).replace("_", " ")
    counted = _table(("outcome", "motions"), rows)
    return _page(f"{model}, {counts.total():,} motions", counted + table)


@style.styled
def _history(motion: GroundMotion) -> Figure:
    figure, ax = style.new_axes(5.2, 1.6)
    t = np.union1d(motion.breakpoints, np.linspace(0.0, motion.duration, 1001))
    ax.plot(t, motion.acceleration(t), color=style.INK, lw=0.7)
    ax.set(xlabel="time [s]", ylabel="acceleration\n[m/s2]", xlim=(0.0, motion.duration))
    return figure


# --- pieces of a page


def _value(value: float, unit: str) -> str:
    """A number, that of an angle with its degrees."""
    return f"{value:.6g} ({np.degrees(value):.3g} degrees)" if unit == "rad" else f"{value:.6g}"


def _page(title: str, body: str) -> str:
    return f'<div class="rockeom"><div><strong>{escape(title)}</strong></div>{body}</div>'


def _side_by_side(*parts: str) -> str:
    inner = "".join(f"<div>{part}</div>" for part in parts)
    return f'<div style="display:flex;gap:16px;align-items:flex-start;flex-wrap:wrap">{inner}</div>'
