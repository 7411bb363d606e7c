"""``rockeom derive``: the equations of a structure."""

import argparse
import sys
from pathlib import Path

from rockeom.cli.errors import UsageError
from rockeom.cli.models import add_details, details
from rockeom.cli.text.terminal import width
from rockeom.codegen import module_text
from rockeom.files import check_target, write
from rockeom.modelling.named import class_named
from rockeom.symbolic import derive
from rockeom.symbolic.text.page import to_text
from rockeom.symbolic.write.typeset import content

DESCRIPTION = """\
Derive the equations of motion, energies, support reactions, impact maps and uplift conditions
of a structure from the positions of its masses, and show them. Takes some seconds. Arguments
of a family and its support follow the name, see `rockeom models`.
"""
EPILOG = """\
examples:
  rockeom derive rigid_block                            read the equations here
  rockeom derive rigid_block --form polar               in R and alpha instead of B and H
  rockeom derive flexible_structure --latex --out c.tex  a document: pdflatex c.tex
  rockeom derive flexible_structure --code              the Python module that is simulated
  rockeom derive shear_frame storeys=3                  one of a family
  rockeom derive flexible_structure support=winkler springs=4
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="a structure, as listed by: rockeom models")
    add_details(parser)
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
    class_named(args.name)
    arguments = details(args.arguments)
    if args.form and (args.markdown or args.code):
        kind = "--markdown" if args.markdown else "--code"
        raise UsageError(f"--form {args.form} and {kind} do not go together: leave one out")
    if args.out is not None:
        check_target(args.out)
    print(f"deriving {' '.join([args.name, *args.arguments])} ...", file=sys.stderr)
    text = _text(args, arguments)
    if args.out is None:
        print(text, end="")
    else:
        write(args.out, text)
        print(f"wrote {args.out}", file=sys.stderr)
    return 0


def _text(args: argparse.Namespace, arguments: dict[str, int | str]) -> str:
    model = derive(args.name, **arguments)
    if args.latex:
        return model.latex(args.form or "width")
    if args.markdown:
        return model.markdown()
    if args.code:
        return module_text(model)
    return to_text(content(model, args.form or "width"), width())
