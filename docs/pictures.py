"""Draw the pictures of README.md into docs/images: ``python docs/pictures.py``."""

from pathlib import Path

import rockeom as rk
from rockeom.cli import demo
from rockeom.drawing.style import new_figure
from rockeom.plots import draw_structure

FOLDER = Path(__file__).parent / "images"


def structures():
    """The four kinds of structure, tilted so far that their feet can be told apart."""
    shown = {
        "RigidBlock": (rk.RigidBlock(half_width=0.095, half_height=0.45), {"theta": 0.1}),
        "LumpedMassStructure": (rk.LumpedMassStructure(**demo.COLUMN), {"theta": 0.1}),
        "TwoSpringStructure": (
            rk.TwoSpringStructure(
                **demo.COLUMN, foundation_stiffness=550e3, foundation_damping=3e3
            ),
            {"theta": 0.07},
        ),
        "FlexibleStructure": (
            rk.FlexibleStructure(**demo.COLUMN, stiffness=demo.STIFFNESS, damping=demo.DAMPING),
            {"theta": 0.1, "u": 0.1},
        ),
    }
    figure = new_figure(8.0, 2.5)
    for ax, (name, (structure, state)) in zip(
        figure.subplots(1, len(shown)), shown.items(), strict=True
    ):
        draw_structure(structure, state=state, ax=ax)
        ax.set_title(name, fontsize=8)
    return figure


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    structures().savefig(FOLDER / "structures.png", dpi=110)
    demo.draw(demo.simulate_all(demo.el_centro()), FOLDER / "el_centro.png", dpi=110)
