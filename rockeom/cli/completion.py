"""``rockeom completion``: what a shell offers after Tab, read from the commands themselves."""

import argparse
import shlex
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import shtab

from rockeom.cli.motions import PULSES
from rockeom.cli.simulate import LAWS
from rockeom.cli.thesis.numbers import NUMBERS
from rockeom.modelling import named
from rockeom.modelling.declared import module_of
from rockeom.motion import library, units
from rockeom.numbers.checks import InputError
from rockeom.structures.classes import SHIPPED
from rockeom.structures.units import main_units

DESCRIPTION = """\
Print a script for bash, zsh, fish or tcsh, by which Tab completes commands, options, structures,
their parameters, states and supports, impact laws, pulses, words of records, units, numbers of
equations, figures and tables, and files. The script asks nothing of this program while you type;
print it again after an update.
"""
EPILOG = """\
examples:
  source <(rockeom completion bash)        in this shell; in ~/.bashrc for all
  rockeom completion zsh > ~/.zfunc/_rockeom      a folder of $fpath
  rockeom completion fish > ~/.config/fish/completions/rockeom.fish
"""
_SHELLS = ("bash", "zsh", "fish", "tcsh")
_EQUALS = """
COMP_WORDBREAKS="${COMP_WORDBREAKS//=/}"
_rockeom() {
  _shtab_rockeom
  case "${COMPREPLY[0]}" in *=) compopt -o nospace 2>/dev/null ;; esac
}
complete -o bashdefault -F _rockeom rockeom
"""
"""For bash: support=winkler is one word, and no blank follows "half_width="."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("shell", choices=_SHELLS, metavar="SHELL", help="bash, zsh, fish or tcsh")


def run(args: argparse.Namespace) -> int:
    for command, action in _actions(args.program, ""):
        names = action.metavar if isinstance(action.metavar, tuple) else (action.metavar,)
        if action.type is Path or not {"FILE", "DIR"}.isdisjoint(names):
            action.complete = shtab.FILE  # type: ignore[attr-defined]
        elif words := _words(command, action.dest, names):
            said = shlex.join(dict.fromkeys(words))
            action.complete = shtab.cmd(rf"printf '%s\n' {said}")  # type: ignore[attr-defined]
    print(shtab.complete(args.program, args.shell))
    if args.shell == "bash":
        print(_EQUALS)
    return 0


def _actions(
    parser: argparse.ArgumentParser, command: str
) -> Iterator[tuple[str, argparse.Action]]:
    """Each option and positional argument, with the command that has it."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            action.help = "command"  # the description of the program lists them
            for name, of_command in action.choices.items():
                yield from _actions(of_command, f"{command} {name}".strip())
        elif not action.choices and action.nargs != 0:
            yield command, action


def _words(command: str, dest: str, names: Iterable[str | None]) -> Iterable[str]:
    """Words for an argument, by its name or by the placeholder in its help."""
    of_argument = {"set": _parameters, "initial": _states, "demand": _demands}
    if dest in of_argument:
        return of_argument[dest]()
    if "NAME" in names:
        return SHIPPED if command == "generate" else (*SHIPPED, *named.FAMILIES, *named.IN_SPACE)
    if "KIND" in names:
        numbers = (f"{n}=" for _, must, may in PULSES.values() for n in sorted(must | may))
        return (*PULSES, *numbers)
    if "WORD" in names:
        return _words_of_records()
    if "NAME=VALUE" in names:
        return ("storeys=", *_supports())
    placeholders: Mapping[str, Iterable[str]] = {
        "LAW": LAWS, "UNITS": units.NAMES, "FIGURE": NUMBERS["figure"],
    }  # fmt: skip
    words = [word for name, some in placeholders.items() if name in names for word in some]
    of_thesis = NUMBERS.get(command.removeprefix("thesis "), ()) if "NUMBER" in names else ()
    return words or of_thesis


def _words_of_records() -> Iterable[str]:
    """Words of the names of records, none where no library is installed."""
    try:
        return sorted({word for name in library.names("") for word in name.split("_")})
    except InputError:
        return ()


def _supports() -> Iterator[str]:
    """Supports, and the parameters of all of them."""
    for support in named.SUPPORTS:
        yield f"support={support}"
        yield from (f"{name}=" for name in named.parameters_of(support))


def _parameters() -> Iterator[str]:
    """Parameters of all structures, and their supports."""
    for of in map(named.class_named, (*SHIPPED, *named.FAMILIES, *named.IN_SPACE)):
        yield from (f"{name}=" for name in of.defaults() if name != "support")
        yield from _supports() if named.takes_support(of) else ()


def _states() -> Iterable[str]:
    """States of all shipped structures."""
    return (f"{state}=" for name in SHIPPED for state in module_of(name).STATES)


def _demands() -> Iterable[str]:
    """States and quantities of all shipped structures."""
    return (demand for name in SHIPPED for demand in main_units(module_of(name)))
