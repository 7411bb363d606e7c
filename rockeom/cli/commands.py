"""The commands: a line on each, and their modules, each imported only where it is needed.

So `rockeom --help` imports none of them, and `rockeom simulate` neither SymPy nor the thesis.
"""

from __future__ import annotations

import argparse
from typing import Protocol

HELP = {
    "models": "list the structures, or explain one of them",
    "derive": "derive the equations of a structure and show them",
    "simulate": "simulate a structure under a ground motion",
    "report": "write one page on a structure under a set of records",
    "equations": "look up the equations of the thesis, as printed and as they should be",
    "verify": "run every check of the equations of the thesis",
    "figure": "draw a figure of the thesis anew, from simulations and closed forms",
    "tables": "show tables of the thesis, what is printed beside what is computed",
    "statements": "judge the sentences of the thesis that have a number",
    "export": "write the equations as C or MATLAB, or a script for OpenSees",
    "generate": "rewrite generated/ from the symbolic models, or check it",
    "completion": "print the script by which a shell completes commands",
}
"""Each command in a line, in the order of the help."""


class Command(Protocol):
    """A module of a command."""

    DESCRIPTION: str
    EPILOG: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None: ...

    def run(self, args: argparse.Namespace) -> int: ...


def command(name: str) -> Command:
    """The module of a command."""
    match name:
        case "models":
            from rockeom.cli import models

            return models
        case "derive":
            from rockeom.cli import derive

            return derive
        case "simulate":
            from rockeom.cli import simulate

            return simulate
        case "report":
            from rockeom.cli import report

            return report
        case "equations":
            from rockeom.cli import equations

            return equations
        case "verify":
            from rockeom.cli import verify

            return verify
        case "figure":
            from rockeom.cli import figure

            return figure
        case "tables":
            from rockeom.cli import tables

            return tables
        case "statements":
            from rockeom.cli import statements

            return statements
        case "export":
            from rockeom.cli import export

            return export
        case "generate":
            from rockeom.cli import generate

            return generate
    from rockeom.cli import completion

    return completion
