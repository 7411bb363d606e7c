"""The command line.

``rockeom models | derive | simulate | report | equations | verify | figure | tables | statements
| export | generate | completion``
"""

from __future__ import annotations

import argparse
import os
import sys
import warnings
from collections.abc import Sequence

from rockeom.cli.commands import HELP, command
from rockeom.cli.errors import UsageError
from rockeom.renamed import VERSION

_DESCRIPTION = """\
Rocking structures: equations of motion derived symbolically, compiled, and integrated
through every impact.

  rockeom models                    which structures there are, and their parameters
  rockeom derive rigid_block        the equations of motion of one of them
  rockeom derive shear_frame storeys=3 support=winkler springs=4   of a family
  rockeom simulate rigid_block ...  its response to a ground motion
  rockeom report rigid_block ...    one page on it under a set of records
  rockeom equations 5-34            an equation of the thesis, as printed and as it should be
  rockeom verify                    every equation of the thesis, derived and compared
  rockeom figure 2-16               a figure of the thesis, drawn anew
  rockeom tables 2-1                a table of the thesis, printed beside computed
  rockeom statements                its sentences with a number, judged
  rockeom export c rigid_block      the equations as C, MATLAB, or a model for OpenSees
  rockeom generate                  rewrite generated/ from the symbolic models (developers)
  rockeom completion bash           what bash, zsh or fish offers after Tab

Each command explains itself: rockeom simulate --help
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command; the exit code is 0 done, 1 a check failed, 2 bad input, 130 interrupted.

    Bad input ends with one message on the standard error that says what, where and the remedy.
    """
    try:
        return _run(argv)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130


def _run(argv: Sequence[str] | None) -> int:
    words = sys.argv[1:] if argv is None else argv
    asked = next((word for word in words if not word.startswith("-")), None)
    parser = _parser([*HELP] if asked == "completion" else [asked])
    args, unknown = parser.parse_known_args(argv)
    if unknown:  # an error of the command itself, with its own usage
        getattr(args, "parser", parser).error(f"unrecognized arguments: {' '.join(unknown)}")
    if args.command is None:
        parser.print_help()
        return 2
    _write_any_letter()
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            code = args.run(args)
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # `rockeom derive rigid_block | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, UsageError, OSError) as error:
        print(f"rockeom {args.command}: {_message(error)}", file=sys.stderr)
        return 2
    except TypeError as error:
        if not isinstance(error, _of_arguments()):
            raise
        print(f"rockeom {args.command}: {error}", file=sys.stderr)
        return 2


def _of_arguments() -> tuple[type, ...]:
    """The errors of arguments that say what is wrong, of the modules that the command loaded."""
    homes = {
        "rockeom.structures.parameters": "ParameterError",
        "rockeom.symbolic.valid": "ArgumentError",
    }
    return tuple(getattr(sys.modules[home], e) for home, e in homes.items() if home in sys.modules)


def _parser(asked: Sequence[str | None] = tuple(HELP)) -> argparse.ArgumentParser:
    """The parser of all commands; asked : those whose arguments it knows."""
    parser = argparse.ArgumentParser(
        prog="rockeom",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"rockeom {VERSION}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    for name, line in HELP.items():
        if name not in asked:
            commands.add_parser(name, help=line)
            continue
        module = command(name)
        of_command = commands.add_parser(
            name,
            help=line,
            description=module.DESCRIPTION,
            epilog=module.EPILOG,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        module.add_arguments(of_command)
        of_command.set_defaults(run=module.run, parser=of_command, program=parser)
    return parser


def _write_any_letter() -> None:
    """Greek letters must not end a command whose output goes to a pipe of few letters."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _message(error: Exception) -> str:
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}. Check the path and the permissions."
    return str(error)


def _show_warning(message, category, filename, lineno, file=None, line=None) -> None:
    print(f"warning: {message}", file=sys.stderr)
