"""Free-body diagrams of the shipped structures, with the symbols of their equations.

A structure is drawn in a displaced state, with its lengths, the angles through which its bodies
turn, and the forces on it: weights, d'Alembert's forces of the ground's acceleration, and the
forces of the ground on the feet.
"""

import gallery
import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rockeom as rk
from rockeom.drawing import free_body, style
from rockeom.drawing.sketch import Sketch
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.model import GROUND_X, Body
from rockeom.symbolic.text.page import width
from rockeom.symbolic.write.notation import Notation

LONGEST = 40  # characters of LaTeX; a longer expression is no label
LARGER = 2.0  # than in the gallery are the displacements
RIGHT = np.array([1.0, 0.0])
LETTER = 2.8  # half of the width of a letter [points]


class Diagram:
    """The drawing of one structure.

    values : of parameters, and of the coordinates in the state that is drawn, by their symbols.
    """

    def __init__(self, name: str) -> None:
        structure, state = gallery.sketched(name)
        y = structure.state({name: LARGER * value for name, value in state.items()})
        self.model: HybridModel = rk.derive(name).hybrid
        self.mode = self.model.modes[0]
        self.notation = Notation(self.mode, self.model)
        self.sketch = Sketch(structure, y, structure.mode_number(y))
        self.values = {
            p.symbol: structure.vector[i] for i, p in enumerate(self.model.parameters)
        } | {c.position: y[i] for i, c in enumerate(self.model.coordinates)}
        self.values |= {d.symbol: d.value.subs(self.values) for d in self.model.definitions}
        self.rocks = self.model.search is None and bool(self.mode.feet) and self.mode.has_side
        self.arrow = 0.16 * self.sketch.size
        self.labels: set[str] = set()

    def draw(self, ax: Axes) -> None:
        self.sketch.draw(ax)
        for text in ax.texts:
            text.remove()
        heavy = [b for b in self.model.bodies if b.mass != 0]
        for body in heavy:
            self._weight(ax, body)
        for body in self.model.bodies:
            self._lengths(ax, body)
            self._angle(ax, body)
        feet = self.sketch.closed_feet or self.sketch.feet
        for name in ["right"] if self.rocks else reversed(feet):
            self._foot(ax, name)
        ax.set_aspect("equal", adjustable="datalim")
        ax.axis("off")

    def tex(self, expr: sp.Expr) -> str:
        """A label, empty for a repeated or a long one; mathtext has fewer commands than LaTeX."""
        return self.label(self.notation.write(sp.sympify(expr)))

    def label(self, tex: str) -> str:
        tex = tex.replace(r"\thinspace", r"\,").replace(r"\tfrac", r"\frac")
        short = len(tex) <= LONGEST and tex not in self.labels
        self.labels.add(tex)
        return f"${tex}$" if short else ""

    def number(self, expr: sp.Expr) -> float:
        return float(sp.sympify(expr).subs(self.values))

    # -- forces

    def _weight(self, ax: Axes, body: Body) -> None:
        at = self.sketch.now.places[body.name]
        outline = self.sketch.shapes.outlines.get(body.name, np.zeros((1, 2)))
        side = self.sketch.now.at(body.name, outline)[:, 0].max() + 0.12 * self.sketch.size
        side += self.sketch.copies.get(body.name, np.zeros(1)).max()
        pulled = np.array([max(side, at[0] + self.arrow), at[1]])
        weight, excitation = (self.tex(body.mass * a) for a in (self.mode.gravity, GROUND_X))
        tip = at - [0, self.arrow]
        free_body.arrow(ax, at, tip, weight, label_at="middle", offset=beside(weight, -5))
        free_body.arrow(ax, pulled, at, excitation, label_at="tail", offset=beside(excitation, 7))

    def _foot(self, ax: Axes, name: str) -> None:
        """The forces of the ground, or of another body, on a foot."""
        at = self.sketch.feet_at(name)[-1]
        words = name.replace("_", r"\ ")
        of = rf"_{{\mathrm{{{words}}}}}"
        normal = self.label("N" if self.rocks else f"N{of}")
        friction = self.label("F" if self.model.search is None else f"F{of}")
        below = (level for x, level in self.sketch.supports if abs(x - at[0]) < 1e-9)
        low = np.array([at[0], min([at[1], *below]) - self.arrow])
        free_body.arrow(ax, low, at, normal, label_at="tail", offset=beside(normal, 12))
        if friction:  # where a structure only has the sum, one arrow stands for it
            free_body.arrow(ax, at, at + self.arrow * RIGHT, friction, offset=beside(friction, 7))

    # -- lengths and angles

    def _lengths(self, ax: Axes, body: Body) -> None:
        """Half of the width of a body and the height of its centroid in it, or above the base."""
        away = 0.06 * self.sketch.size
        if not body.outline:
            self._height(ax, body, away)
            return
        corners = self.sketch.shapes.outlines[body.name]
        right, top = body.outline[int(np.argmax(corners @ [1.0, 1.0]))]
        low = min((y for _, y in body.outline), key=self.number)
        x, y, bottom = self.number(right), self.number(top), self.number(low)
        left = corners[:, 0].min()
        ends = np.array([(0, y), (x, y), (left, bottom), (left, 0)])
        a, b, c, d = self.sketch.now.at(body.name, ends)
        for start, end, label in ((a, b, self.tex(right)), (c, d, self.tex(-low))):
            if label and np.hypot(*(end - start)) > 0:
                free_body.dimension(ax, start, end, label, away, self._beside(start, end))

    def _height(self, ax: Axes, body: Body, away: float) -> None:
        """Of a lumped mass, along the axis of the base, and its displacement from that."""
        feet = [self.sketch.now.places[name] for name in self.sketch.feet]
        still = dict.fromkeys((c.position for c in self.model.coordinates), 0) | {SIDE: 1}
        places = [foot.position for foot in self.mode.feet.values()]
        middle = [sum(place[i] for place in places) / max(len(places), 1) for i in (0, 1)]
        x, y = (sp.expand((a - b).subs(still)) for a, b in zip(body.position, middle, strict=True))
        if not places or x != 0 or y == 0 or body.mass == 0:
            return
        foot, across = (feet[0] + feet[-1]) / 2, feet[-1] - feet[0]
        up = np.array([-across[1], across[0]]) / np.hypot(*across)
        top, at = foot + self.number(y) * up, self.sketch.now.places[body.name]
        out = away + np.hypot(*across) / 2
        free_body.dimension(ax, foot, top, self.tex(y), out, self._beside(foot, top))
        bends = [c.position for c in self.model.coordinates if c.unit == "m"]
        bends = [q for q in bends if not any(e.has(q) for e in middle)]
        if bends and np.hypot(*(at - top)) > 1e-6 * self.sketch.size:
            free_body.line(ax, foot, top)
            free_body.dimension(ax, top, at, self.tex(bends[0]), 0.7 * away, (0, 8))

    @staticmethod
    def _beside(start: np.ndarray, end: np.ndarray) -> np.ndarray:
        """Place of a label to the left of a line, in points."""
        way = (end - start) / np.hypot(*(end - start))
        return 9 * np.array([-way[1], way[0]])

    def _angle(self, ax: Axes, body: Body) -> None:
        """The rotation of a body, from the vertical to its axis."""
        turned = self.sketch.now.angles.get(body.name, 0.0)
        label = self.tex(body.rotation)
        if turned == 0.0 or not label:
            return
        at = self.sketch.now.places[body.name]
        up = np.array([0.0, 1.3 * self.arrow])
        along = at + free_body.turned([up], (0, 0), turned)[0]
        for end in (at + up, along):
            free_body.line(ax, at, end)
        free_body.angle(ax, at, at + up, along, self.arrow, label, sense=True)


def beside(label: str, y: float = 0.0) -> tuple[float, float]:
    """Place of a label to the right of an arrow, in points."""
    return 5 + LETTER * width(label.strip("$")), y


@style.styled
def diagram(name: str) -> Figure:
    """The free-body diagram of a shipped structure."""
    figure = style.new_figure(4.0, 4.0)
    figure.set_layout_engine("none")
    Diagram(name).draw(figure.add_axes((0.02, 0.02, 0.96, 0.96)))
    return figure
