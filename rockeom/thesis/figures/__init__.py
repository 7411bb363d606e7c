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
_ONE_BY_ONE = {
    "2-7": "a measured trace, which is lost; 2-6 has the oscillator that uplifts",
    "3-9": "3-10 has it: the energy with and without a spring",
    "3-23": "the tests have no relation; a simulation has that of its law, which 3-22 has",
    "4-8": f"{_TESTS}; 4-11 and 4-12 have the free vibration",
    "4-19": "a drawing of the turned wall: the notebook on the wall has it, 4-20 what comes of it",
    "4-16": "a drawing of a centre that shifts; 4-18 has what comes of it",
    "4-49": f"{_TESTS}, and the motions of the table; 4-66 and 4-67 have two runs in kind",
    "4-59": f"{_TESTS}; `slips_from_tendon_force` finds such shifts in a record",
    "4-70": f"{_TESTS}; 4-71 has simulations of the same run",
    "4-74": "two runs of another study, whose traces are lost",
    "5-4": "a measured curve of the rubber, of which no number is printed",
    "5-17": f"{_COLUMN}; 5-24 and 5-25 have the run simulated",
    "5-18": f"{_COLUMN}; 5-34 to 5-36 have the run simulated",
    "5-40": f"{_COLUMN}; 5-39 and 5-41 have the run simulated",
}
_ALIKE = {
    "a drawing of a frame of reference": "1-4 1-5 1-6 1-7",
    "a drawing of the structure or the specimen": "1-1 2-3 2-4 2-5 2-18 4-1 4-4 4-22a 5-1 5-2",
    "a photograph": "1-2 3-1 4-3 5-3",
    "a force against a displacement without numbers; 2-19 and 4-35 have numbers": "1-3 4-2",
    "a drawing of a base that turns: `rotation_centre` and others compute it": "4-10 5-11",
    "a drawing of the instruments or the rig": "3-2 4-5 4-9 4-21 5-5",
    "a drawing of forces: the notebook on Housner's block has one": "2-1 3-11",
    "a drawing of forces or velocities: `rockeom derive` has what follows": "5-20 5-21 5-28",
    "a picture of another program": "4-23 5-30",
    "a drawing of the wall's motion or of the pressure below it": "4-61 4-63 4-64 4-65",
    f"{_TESTS}; 4-75 has what Table 4-2 says of the centre": "4-60 4-62",
    "a drawing of the model; `rockeom derive` derives it": "5-8 5-19 5-26 5-27 5-37",
    "a diagram: its appendix in the catalogue derives what it shows": "B-1 D-1 D-2 D-3",
    "the law put into a simulation would come out again: 3-17, 3-22 have it": "3-18 3-19 3-20 3-21",
    f"{_TESTS}; 4-50 and 4-51 have windows on two simulations": "4-52 4-53 4-55",
    "a record that goes into simulations, or its spectrum, which 4-6 has": "A-1 A-2 A-3 A-4",
    "a record that goes into simulations, or its spectrum, which 4-7 has": "A-7 A-8",
    _NO_RECORD: "4-54 4-56 A-5 A-6 A-9 A-10 C-3 C-5 C-8 C-10 C-12 C-15",
}


def _place(number: str) -> tuple[str, int, str]:
    return number[0], int(number[2:].rstrip("ab")), number


_REASONS = {n: why for why, numbers in _ALIKE.items() for n in numbers.split()} | _ONE_BY_ONE
NOT_DRAWN: dict[str, str] = {n: _REASONS[n] for n in sorted(_REASONS, key=_place)}
"""Number of a figure that cannot be drawn from the text -> why."""
