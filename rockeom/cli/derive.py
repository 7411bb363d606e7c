"""``rockeom derive``: the equations of a structure."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from rockeom.cli.errors import UsageError
from rockeom.cli.models import shipped
from rockeom.cli.terminal import width

HELP = "derive the equations of a structure and show them"
DESCRIPTION = """\
Derive the equations of motion, energies, support reactions, impact maps and uplift conditions
of a shipped structure from the positions of its masses, and show them. Takes some seconds.
"""
EPILOG = """\
examples:
  rockeom derive rigid_block                            read the equations here
  rockeom derive rigid_block --form polar               in R and alpha instead of B and H
  rockeom derive flexible_structure --latex --out c.tex  a document: pdflatex c.tex
  rockeom derive flexible_structure --code              the Python module that is simulated
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="a structure, as listed by: rockeom models")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--latex", action="store_true", help="a complete LaTeX document")
    kind.add_argument("--markdown", action="store_true", help="a Markdown page")
    kind.add_argument("--code", action="store_true", help="the generated Python module")
    parser.add_argument(
        "--form",
        choices=("width", "polar"),
        help="parameters of the shape: width for B and H (if not given), polar for R and alpha",
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="write to FILE, not here")


def run(args: argparse.Namespace) -> int:
    shipped(args.name)
    if args.form and (args.markdown or args.code):
        kind = "--markdown" if args.markdown else "--code"
        raise UsageError(f"--form {args.form} and {kind} do not go together: leave one out")
    print(f"deriving {args.name} ...", file=sys.stderr)
    text = _text(args)
    if args.out is None:
        print(text, end="")
    else:
        args.out.write_text(text, encoding="utf-8")
        print(f"wrote {args.out}", file=sys.stderr)
    return 0


def _text(args: argparse.Namespace) -> str:
    from rockeom.symbolic import derive

    model = derive(args.name)
    if args.latex:
        return model.latex(args.form or "width")
    if args.markdown:
        return model.markdown()
    if args.code:
        from rockeom.codegen import module_text

        return module_text(model)
    from rockeom.cli.plain import to_text
    from rockeom.symbolic.typeset import content

    return to_text(content(model, args.form or "width"), width())
