"""The command line ``rockeom COMMAND``; `rockeom.cli.commands` lists the commands."""

import argparse
import os
import re
import sys
import warnings
from collections.abc import Mapping, Sequence
from types import ModuleType
from typing import Any

from rockeom.cli.commands import GROUPS, HELP, OF_THESIS, command
from rockeom.version import VERSION


def _listed(commands: Mapping[str, str]) -> str:
    """A line for each command, in columns."""
    wide = max(map(len, {**HELP, **OF_THESIS}))
    return "\n".join(f"  {name:{wide}}  {line}" for name, line in commands.items())


_GROUPS = "\n\n".join(f"{title}:\n{_listed(group)}" for title, group in GROUPS.items())
_DESCRIPTION = f"""\
Does a structure uplift, rock or overturn in an earthquake?

{_GROUPS}

A first simulation, and the options of a command:
  rockeom simulate rigid_block --set width=0.6 height=2.4 --record El Centro 1940 180 --pga 0.4g
  rockeom simulate --help
"""
_THESIS = f"""\
Look up what Ma's thesis (2010) states: derived, checked and drawn again.

{_listed(OF_THESIS)}
"""
_PLAIN = argparse.RawDescriptionHelpFormatter
_BELOW_ZERO = re.compile(r"-\.?\d")  # begins a value, such as -65deg or -1e-3, and no option


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command; the exit code is 0 done, 1 a check failed, 2 bad input, 130 interrupted.

    Bad input ends with one message on the standard error that says what, where and the remedy.
    """
    try:
        return _run(sys.argv[1:] if argv is None else argv)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130


def _run(argv: Sequence[str]) -> int:
    with warnings.catch_warnings():
        warnings.showwarning = _show_warning
        parser = _parser(argv)
        args, unknown = parser.parse_known_args(argv)
        if unknown:  # an error of the command itself, with its own usage
            getattr(args, "parser", parser).error(_errors().unknown(unknown))
        if getattr(args, "run", None) is None:  # `rockeom` or `rockeom thesis` alone
            getattr(args, "group", parser).print_help()
            return 2
        return _answer(args)


def _answer(args: argparse.Namespace) -> int:
    """The exit code of a command that was understood."""
    _write_any_letter()
    try:
        code = args.run(args)
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # `rockeom derive rigid_block | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError) as error:
        print(f"{args.parser.prog}: {_errors().message(error, args)}", file=sys.stderr)
        return 2


def _parser(words: Sequence[str] = ("completion",)) -> argparse.ArgumentParser:
    """The parser of some words: it knows the arguments of the commands that they name.

    Those of "completion" name all.
    """
    asked = [word for word in words if not word.startswith("-")][:2]
    first = asked[0] if asked else None
    parser = argparse.ArgumentParser(
        prog="rockeom",
        usage="rockeom COMMAND ...",
        description=_DESCRIPTION,
        formatter_class=_PLAIN,
    )
    parser.add_argument("--version", action="version", version=f"rockeom {VERSION}")
    if first is not None and first not in HELP:
        names = {name: f"thesis {name}" for name in OF_THESIS} | {name: name for name in HELP}
        parser.error(f"no command {_errors().meant(first, names)}; rockeom --help lists them")
    commands = parser.add_subparsers(metavar="COMMAND", help=argparse.SUPPRESS, prog="rockeom")
    for name in HELP:
        if name == "thesis":
            _add_thesis(commands, asked, parser)
        else:
            _add(commands, name, first in (name, "completion"), parser)
    return parser


def _add_thesis(commands: Any, asked: Sequence[str], program: argparse.ArgumentParser) -> None:
    """The group of commands on the thesis."""
    group = commands.add_parser(
        "thesis",
        help=HELP["thesis"],
        usage="rockeom thesis COMMAND ...",
        description=_THESIS,
        formatter_class=_PLAIN,
    )
    group.set_defaults(group=group)
    name = asked[1] if asked[0:1] == ["thesis"] and len(asked) > 1 else None
    if name is not None and name not in OF_THESIS:
        names = {name: name for name in OF_THESIS}
        group.error(f"no command {_errors().meant(name, names)}; there are {', '.join(OF_THESIS)}")
    of_group = group.add_subparsers(
        metavar="COMMAND", help=argparse.SUPPRESS, prog="rockeom thesis"
    )
    for one in OF_THESIS:
        wanted = name == one or asked[0:1] == ["completion"]
        _add(of_group, one, wanted, program, f"thesis {one}")


def _add(
    commands: Any, name: str, wanted: bool, program: argparse.ArgumentParser, module: str = ""
) -> None:
    """One command; with its arguments where they are wanted, which loads its module."""
    line = {**HELP, **OF_THESIS}[name]
    if not wanted:
        commands.add_parser(name, help=line)
        return
    home = command(module or name)
    parser = commands.add_parser(
        name,
        help=line,
        description=home.DESCRIPTION,
        epilog=home.EPILOG,
        formatter_class=_PLAIN,
        allow_abbrev=False,
    )
    parser._negative_number_matcher = _BELOW_ZERO
    home.add_arguments(parser)
    parser.set_defaults(run=home.run, parser=parser, program=program)


def _write_any_letter() -> None:
    """Greek letters must not end a command whose output goes to a pipe of few letters."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _errors() -> ModuleType:
    """The words of errors, which load NumPy: only where there is one."""
    from rockeom.cli import errors

    return errors


def _show_warning(message, category, filename, lineno, file=None, line=None) -> None:
    print(f"warning: {message}", file=sys.stderr)
