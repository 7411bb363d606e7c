"""Figures of the thesis, drawn again from printed numbers, closed forms and simulations.

    from rockeom.thesis.figures import FIGURES

    FIGURES["2-16"]().savefig("2-16.png")
    FIGURES["2-16"].text                      # its conventions, and what the thesis leaves open

Each figure states the assumptions for all that its caption and the text leave open. Its
statements are judged in `rockeom.thesis.statements`. A module here holds the figures of one
subject; `FIGURES` finds them by themselves.
"""

import pkgutil
from importlib import import_module

from rockeom.thesis.figures.drawn import Source, ThesisFigure, figures_of

__all__ = ["FIGURES", "NOT_DRAWN", "Source", "ThesisFigure"]

FIGURES: dict[str, ThesisFigure] = figures_of(
    tuple(import_module(f"{__name__}.{one.name}") for one in pkgutil.iter_modules(__path__))
)
"""Number of a figure -> the figure."""

_TESTS = "the traces of the tests on the wall are lost"
_COLUMN = "the traces of the tests on the column are lost"
_NO_RECORD = "neither the motion of the table nor the record that was meant is at hand"
_FRAME = "a drawing of a frame of reference"
NOT_DRAWN: dict[str, str] = {
    "1-1": "drawings of a block that rocks",
    "1-2": "photographs of a viaduct",
    "1-3": "a force against a displacement without numbers; 2-19 and 4-35 have numbers",
    **dict.fromkeys(("1-4", "1-5", "1-6", "1-7"), _FRAME),
    "2-1": "a drawing of the block and its forces: the notebook on Housner's block has one",
    "2-3": "a drawing of an impacting body",
    "2-4": "a drawing of a block on springs",
    "2-5": "drawings of three kinds of interface",
    "2-7": "a measured trace, which is lost; 2-6 has the oscillator that uplifts",
    "2-18": "a drawing of a wall with tendons",
    "3-1": "a drawing and a photograph of the specimen",
    "3-2": "a drawing of the steel mechanism",
    "3-11": "a diagram of forces: the notebook on Housner's block has one",
    "4-1": "a drawing of the construction",
    "4-2": "a photograph, and a force against a displacement without numbers",
    "4-3": "photographs of the specimens",
    "4-4": "a drawing of the wall with its measures",
    "4-5": "a drawing of the instruments",
    "4-8": f"{_TESTS}; 4-11 and 4-12 have the free vibration",
    "4-9": "a drawing of the gauges next to the wall",
    "4-10": "a drawing of a base that turns: `corrected_uplifts` and `rotation_centre` compute it",
    "4-16": "a drawing of a centre that shifts; 4-18 has what comes of it",
    "4-21": "drawings of the rigs of two other studies",
    "4-22a": "a drawing of the wall's measures; 4-22b is drawn",
    "4-23": "a picture of a finite element model",
    "4-49": f"{_TESTS}, and the motions of the table; 4-66 and 4-67 have two runs in kind",
    "4-54": f"{_NO_RECORD}: Tabas 344",
    "4-56": f"{_NO_RECORD}: Valparaiso, Llolleo 10",
    "4-59": f"{_TESTS}; `slips_from_tendon_force` finds such shifts in a record",
    "4-60": f"{_TESTS}; 4-75 has what Table 4-2 says of the centre",
    "4-61": "a drawing of the wall in free flight",
    "4-62": f"{_TESTS}; 4-75 has what Table 4-2 says of the centre",
    "4-63": "drawings of the pressure below the wall",
    "4-64": "drawings of the pressure below the wall",
    "4-65": "a drawing of the path of the centre",
    "5-1": "a drawing of two interfaces",
    "5-2": "a drawing of the column with its measures",
    "5-3": "photographs of the rig",
    "5-4": "a measured curve of the rubber, of which no number is printed",
    "5-5": "a drawing of where was measured",
    "5-8": "a drawing of the lumped masses",
    "5-11": "a drawing of a base that turns: `rotation_centre_between_gauges` computes it",
    "5-17": f"{_COLUMN}; 5-24 and 5-25 have the run simulated",
    "5-18": f"{_COLUMN}; 5-34 to 5-36 have the run simulated",
    "5-19": "a drawing of the model; `rockeom derive lumped_mass_structure` derives it",
    "5-20": "a diagram of forces",
    "5-21": "a diagram of velocities",
    "5-26": "a drawing of the model; `rockeom derive two_spring_structure` derives it",
    "5-27": "a drawing of the cart; `rockeom derive two_spring_cart` derives it",
    "5-30": "a picture of another program",
    "5-37": "a drawing of the model; `rockeom derive flexible_structure` derives it",
    "5-40": f"{_COLUMN}; 5-39 and 5-41 have the run simulated",
    **{f"A-{n}": _NO_RECORD for n in (5, 6, 9, 10)},
    "B-1": "a drawing of a wall that turns: Appendix B of the catalogue derives what it shows",
    **{f"C-{n}": _NO_RECORD for n in (3, 5, 8, 10, 12, 15)},
    **{f"D-{n}": "a diagram: Appendix D of the catalogue derives what it shows" for n in (1, 2, 3)},
}
"""Number of a figure that cannot be drawn from the text -> why."""
