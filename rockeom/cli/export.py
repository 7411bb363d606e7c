"""``rockeom export``: what was derived, for other programs."""

import argparse
import sys
from pathlib import Path

from rockeom.cli.errors import UsageError, numbers
from rockeom.cli.models import add_details, details, made
from rockeom.cli.motions import add_motion, motions
from rockeom.cli.text.options import add_number, add_pairs
from rockeom.exports.code import code, file_name
from rockeom.exports.opensees import script
from rockeom.files import check_target, write
from rockeom.modelling.declared import module_of
from rockeom.modelling.named import class_named

DESCRIPTION = """\
Write what is simulated for another program, as one self-contained file.

  c         equations of motion, guards, impact map and energies of each mode, as C99
  matlab    the same as a function that gives a struct of functions; runs in Octave as well
  opensees  a script for OpenSeesPy of two_spring_structure, or of flexible_structure with
            support=two_springs, under a ground motion: corotational elements on springs that
            press and never pull

For c and matlab arguments of a family and its support follow the name, as in `rockeom derive`;
for opensees the parameters and the motion, as in `rockeom simulate`.
"""
EPILOG = """\
examples:
  rockeom export c rigid_block                         rigid_block.c, here
  rockeom export matlab shear_frame storeys=3 --out frame
  rockeom export opensees two_spring_structure --free --duration 1 --initial theta=0.05 \\
      --set mass=122.6 height=1.05 inertia=44.8 base_mass=45.6 base_height=0.1 \\
      base_inertia=1.37 half_width=0.285 foundation_stiffness=5e5 foundation_damping=0
"""
_ENDINGS = {"c": "c", "matlab": "m", "opensees": "py"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("language", choices=tuple(_ENDINGS), help="what is written")
    parser.add_argument("name", metavar="NAME", help="a structure, as listed by: rockeom models")
    add_details(parser)
    parser.add_argument(
        "--out",
        type=Path,
        metavar="PATH",
        help="a file, or a folder for one of the structure's name; here if not given",
    )
    of_opensees = parser.add_argument_group("for opensees")
    add_pairs(of_opensees, "--set", "NAME=VALUE", "parameters of the structure")
    add_pairs(
        of_opensees, "--initial", "STATE=VALUE", "theta, heave and u at the start; rates are zero"
    )
    add_number(of_opensees, "--duration", "S", "of the simulation [s]")
    add_number(of_opensees, "--step", "S", "of Newmark's method; 1e-4 s", default=1e-4)
    add_motion(parser.add_argument_group("ground motion, for opensees"), required=False)


def run(args: argparse.Namespace) -> int:
    class_named(args.name)
    if args.language == "opensees":
        if args.arguments:
            raise UsageError(
                f"{' '.join(args.arguments)}: write it behind --set, as --set support=two_springs"
            )
        text, name = _opensees(args), f"{args.name}_opensees"
    else:
        text, name = _code(args)
    path = _path(args.out, f"{name}.{_ENDINGS[args.language]}", args.language)
    write(path, text)
    print(f"wrote {path}")
    return 0


def _path(out: Path | None, name: str, language: str) -> Path:
    """Where the file goes; a function of MATLAB is found by the name of its file."""
    if out is None:
        return Path(name)
    if out.suffix == f".{_ENDINGS[language]}":
        if language == "matlab" and out.name != name:
            raise UsageError(
                f"--out {out}: MATLAB finds a function by its file, which is called {name}: name "
                "a folder for it"
            )
        check_target(out)
        return out
    if out.exists() and not out.is_dir():
        raise UsageError(
            f"--out {out}: this is a file; name a folder, or end it with .{_ENDINGS[language]}"
        )
    out.mkdir(parents=True, exist_ok=True)
    return out / name


def _code(args: argparse.Namespace) -> tuple[str, str]:
    """The text of c or matlab, and the name of its file."""
    options = [
        option
        for option in ("set", "initial", "duration", "motion", "pulse", "record", "vertical")
        if getattr(args, option)
    ]
    if options or args.free:
        raise UsageError(
            f"--{(options or ['free'])[0]} is for opensees: {args.language} holds functions of any "
            "parameters; a family's own follow the name, as storeys=3"
        )
    arguments = details(args.arguments)
    if arguments.get("support") == "pinned":  # as if not given
        del arguments["support"]
    if arguments:
        print(f"deriving {' '.join([args.name, *args.arguments])} ...", file=sys.stderr)
    module = module_of(class_named(args.name).model, **arguments)
    return code(module, args.language), file_name(module, args.language)


def _opensees(args: argparse.Namespace) -> str:
    if not (args.motion or args.pulse or args.record or args.free):
        raise UsageError("opensees needs a ground motion: --motion, --pulse, --record or --free")
    motion, vertical = motions(args)
    if vertical is not None:
        raise UsageError(f"--vertical {args.vertical} is not written for opensees: leave it out")
    return script(
        made(args),
        motion,
        initial=numbers(args.initial, "--initial", "theta=0.05"),
        duration=args.duration,
        step=args.step,
    )
