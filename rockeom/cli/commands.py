"""The commands: a line on each, and their modules, each imported only where it is needed.

So `rockeom --help` imports none of them, and `rockeom simulate` neither SymPy nor the thesis.
"""

import argparse
from importlib import import_module
from typing import Protocol, cast

GROUPS = {
    "Start here": {
        "assess": "will it overturn? a verdict, and a page, under a set of records",
        "models": "list the structures, or explain one and its parameters",
        "records": "list recorded earthquakes, or show one",
        "simulate": "simulate a structure under a ground motion",
        "animate": "make a film of a simulation (.gif, .html, .mp4)",
        "explore": "make a page with sliders that simulates in the browser (.html)",
    },
    "Many motions": {
        "sweep": "vary numbers of a simulation and map what happens",
        "fragility": "probability of overturning against intensity, from a set of records",
        "report": "write one page on a structure under a set of records",
    },
    "Equations": {
        "derive": "derive the equations of a structure and show them",
        "export": "write the equations as C or MATLAB, or a script for OpenSees",
        "thesis": "equations, figures and tables of the thesis behind this program, checked",
    },
    "Around the program": {
        "completion": "print the script by which a shell completes commands",
        "generate": "for developers: rewrite generated/ from the symbolic models, or check it",
    },
}
"""Each command in a line, in the order of the help."""

HELP = {name: line for group in GROUPS.values() for name, line in group.items()}

OF_THESIS = {
    "equations": "look up the equations of the thesis, as printed and as they should be",
    "verify": "run every check of the equations of the thesis",
    "figure": "draw a figure of the thesis again, from simulations and closed forms",
    "tables": "show tables of the thesis, printed numbers next to computed ones",
    "statements": "judge the sentences of the thesis that have a number",
}
"""The commands of `rockeom thesis`; for one release they answer without that word, too."""


class Command(Protocol):
    """A module of a command."""

    DESCRIPTION: str
    EPILOG: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None: ...

    def run(self, args: argparse.Namespace) -> int: ...


def command(name: str) -> Command:
    """The module of a command, "simulate" or "thesis figure"."""
    return cast(Command, import_module(f"rockeom.cli.{name.replace(' ', '.')}"))
