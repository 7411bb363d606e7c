"""``rockeom completion``: what a shell offers after Tab, read from the commands themselves."""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from rockeom.cli.commands import HELP, OF_THESIS
from rockeom.cli.motions import PULSES
from rockeom.cli.simulate import LAWS
from rockeom.modelling.declared import module_of
from rockeom.modelling.named import FAMILIES, SUPPORTS, parameters_of, takes_support
from rockeom.motion import MotionError, library, units
from rockeom.structures.classes import SHIPPED
from rockeom.structures.units import main_units
from rockeom.thesis import EQUATIONS
from rockeom.thesis.figures import FIGURES
from rockeom.thesis.tables import TABLES

DESCRIPTION = """\
Print a script for bash, zsh or fish, by which Tab completes commands, options, structures, their
parameters, states and supports, impact laws, pulses, words of records, units, numbers of equations,
figures and tables, and files. The script asks nothing of this
program while you type; print it again after an update.
"""
EPILOG = """\
examples:
  source <(rockeom completion bash)        in this shell; in ~/.bashrc for all
  source <(rockeom completion zsh)         the same of zsh, in ~/.zshrc
  rockeom completion fish > ~/.config/fish/completions/rockeom.fish
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("shell", choices=tuple(_SHELLS), metavar="SHELL", help="bash, zsh or fish")


def run(args: argparse.Namespace) -> int:
    print(_SHELLS[args.shell](_commands(args.program)), end="")
    return 0


class Slot(NamedTuple):
    """A place on the command line: what may stand there.

    flags : of an option; none of a positional argument. takes : "nothing", "one" word or "several".
    words : offered there; of_each : those that depend on the structure named before. files :
    whether files are.
    """

    flags: tuple[str, ...]
    takes: str
    words: tuple[str, ...]
    of_each: Mapping[str, tuple[str, ...]]
    files: bool
    meaning: str


class Command(NamedTuple):
    """A command, its options and what stands without one."""

    name: str
    meaning: str
    slots: list[Slot]

    @property
    def options(self) -> list[Slot]:
        return [slot for slot in self.slots if slot.flags]

    @property
    def positional(self) -> Slot:
        """All that stands without an option, together."""
        slots = [slot for slot in self.slots if not slot.flags]
        words = dict.fromkeys(word for slot in slots for word in slot.words)
        return Slot((), "several", tuple(words), {}, any(slot.files for slot in slots), "")


def _commands(program: argparse.ArgumentParser) -> list[Command]:
    """All commands, "thesis" and "thesis figure" among them."""
    lines = {**HELP, **{f"thesis {name}": line for name, line in OF_THESIS.items()}}
    found = []
    for name, line in lines.items():
        parser = program
        for word in name.split():
            (group,) = (a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
            parser = group.choices[word]
        found.append(Command(name, line, [_slot(name, action) for action in parser._actions]))
    return found


def _slot(command: str, action: argparse.Action) -> Slot:
    takes = "nothing" if action.nargs == 0 else "several" if action.nargs in ("+", "*") else "one"
    names = action.metavar if isinstance(action.metavar, tuple) else (action.metavar,)
    words = tuple(map(str, action.choices)) if action.choices else _words(command, names)
    files = action.type is Path or not {"FILE", "DIR"}.isdisjoint(names)
    of_each = _OF_EACH[action.dest]() if action.dest in _OF_EACH else {}
    meaning = (action.help or "").partition(";")[0]
    return Slot(tuple(action.option_strings), takes, words, of_each, files, meaning)


def _words(command: str, names: tuple[str | None, ...]) -> tuple[str, ...]:
    """Words for a placeholder in capitals in the help of a command."""
    numbers: dict[str, Mapping[str, object]] = {
        "thesis equations": EQUATIONS,
        "thesis verify": EQUATIONS,
        "thesis figure": FIGURES,
        "thesis tables": TABLES,
    }
    if "NAME" in names:
        return tuple(SHIPPED) if command == "generate" else (*SHIPPED, *FAMILIES)
    if "KIND" in names:
        numbers_of = [f"{n}=" for _, must, may in PULSES.values() for n in sorted(must | may)]
        return (*PULSES, *dict.fromkeys(numbers_of))
    if "LAW" in names:
        return LAWS
    if "UNITS" in names:
        return units.NAMES
    if "WORD" in names:
        return _words_of_records()
    if "NAME=VALUE" in names:
        return ("storeys=", *_supports())
    if "FIGURE" in names:
        return tuple(FIGURES)
    return tuple(numbers[command]) if "NUMBER" in names and command in numbers else ()


def _words_of_records() -> tuple[str, ...]:
    """Words of the names of records, none where no library is installed."""
    try:
        return tuple(sorted({word for name in library.names("") for word in name.split("_")}))
    except MotionError:
        return ()


def _supports() -> tuple[str, ...]:
    """Supports, and the parameters of all of them."""
    parameters = (f"{name}=" for support in SUPPORTS for name in parameters_of(support))
    return (*(f"support={support}" for support in SUPPORTS), *dict.fromkeys(parameters))


def _parameters() -> dict[str, tuple[str, ...]]:
    """Parameters of each structure, and its supports."""
    every = {**SHIPPED, **FAMILIES}
    return {
        name: (
            *(f"{p}=" for p in of.defaults() if p != "support"),
            *(_supports() if takes_support(of) else ()),
        )
        for name, of in every.items()
    }


def _states() -> dict[str, tuple[str, ...]]:
    """States of each shipped structure."""
    return {name: tuple(f"{s}=" for s in module_of(name).STATES) for name in SHIPPED}


def _demands() -> dict[str, tuple[str, ...]]:
    """States and quantities of each shipped structure."""
    return {name: tuple(main_units(module_of(name))) for name in SHIPPED}


_OF_EACH = {"set": _parameters, "initial": _states, "demand": _demands}
"""Words that depend on the structure, by the options that take them."""


# --- bash, and zsh, which runs the same script

_BASH = """\
# Completion of the command rockeom for {shell}, written by: rockeom completion {shell}
_rockeom() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" command="${{COMP_WORDS[1]}}" of="${{COMP_WORDS[2]}}"
  local slot="" one="" words="" files="" key="" i first=2
  if [ "$word" = "=" ]; then  # bash takes support=winkler for three words
    key="${{COMP_WORDS[COMP_CWORD-1]}}=" word=""
  elif [ "${{COMP_WORDS[COMP_CWORD-1]}}" = "=" ]; then
    key="${{COMP_WORDS[COMP_CWORD-2]}}="
  fi
  COMPREPLY=()
  if [ "$command" = thesis ] && [ "$COMP_CWORD" -gt 2 ]; then
    command="thesis ${{COMP_WORDS[2]}}" of="${{COMP_WORDS[3]}}" first=3
  fi
  for ((i = first; i < COMP_CWORD; i++)); do  # whose word is it
    case "$command ${{COMP_WORDS[i]}}" in
{takes}
      *" -"*) slot="" one="" ;;
      *) if [ -n "$one" ]; then slot="" one=""; fi ;;
    esac
  done
  if [ "$COMP_CWORD" -eq 1 ]; then
    words={commands}
  else
    case "$word" in
      -*) case "$command" in
{options}
      esac ;;
      *) case "$command $slot" in
{words}
      esac ;;
    esac
  fi
  if [ -n "$files" ]; then
    if [ -n "$ZSH_VERSION" ]; then return; fi
    local IFS=$'\\n'  # names may hold blanks
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
  else
    COMPREPLY=($(compgen -W "$words" -- "$key$word"))
    COMPREPLY=("${{COMPREPLY[@]#"$key"}}")
    case "${{COMPREPLY[0]}}" in *=) compopt -o nospace 2>/dev/null ;; esac
  fi
}}
complete -F _rockeom rockeom
"""

# zsh itself completes files where nothing else is offered.
_ZSH = """\
autoload -U +X compinit && compinit
autoload -U +X bashcompinit && bashcompinit
{bash}complete -o default -F _rockeom rockeom
"""


def _bash(commands: list[Command], shell: str = "bash") -> str:
    takes, options, words = [], [], []
    for command in commands:
        for slot in command.options:
            if slot.takes != "nothing":
                keys = "|".join(f'"{command.name} {flag}"' for flag in slot.flags)
                one = "yes" if slot.takes == "one" else '""'
                takes.append(f'      {keys}) slot="{slot.flags[0]}" one={one} ;;')
        flags = [flag for slot in command.options for flag in slot.flags]
        options.append(f'        "{command.name}") words={_joined(flags)} ;;')
        words += [
            f'        "{command.name} {flag}") {offer} ;;'
            for slot in (command.positional, *command.options)
            for flag in slot.flags[:1] or ("",)
            if (offer := _offer(slot))
        ]
    return _BASH.format(
        shell=shell,
        takes="\n".join(takes),
        commands=_joined(HELP),
        options="\n".join(options),
        words="\n".join(words),
    )


def _offer(slot: Slot) -> str:
    if slot.files:
        return "files=yes"
    if slot.of_each:
        cases = [f"{of}) words={_joined(words)} ;;" for of, words in slot.of_each.items()]
        return f'case "$of" in {" ".join(cases)} esac'
    return f"words={_joined(slot.words)}" if slot.words else ""


def _joined(words) -> str:
    return shlex.quote(" ".join(words))


def _zsh(commands: list[Command]) -> str:
    return _ZSH.format(bash=_bash(commands, "zsh"))


# --- fish


def _fish(commands: list[Command]) -> str:
    return "\n".join(("complete -c rockeom -f", *_fish_lines(commands), ""))


def _fish_lines(commands: list[Command]) -> Iterator[str]:
    first = "__fish_use_subcommand"
    of_group = f"__fish_seen_subcommand_from {' '.join(OF_THESIS)}"
    for name, meaning, _ in commands:
        group, _, last = name.rpartition(" ")
        seen = f"__fish_seen_subcommand_from {group}; and not {of_group}" if group else first
        yield f"complete -c rockeom -n {shlex.quote(seen)} -a {last} -d {shlex.quote(meaning)}"
    for command in commands:
        names = command.name.split()
        seen = "; and ".join(f"__fish_seen_subcommand_from {name}" for name in names)
        start = f"complete -c rockeom -n '{seen}'"
        if command.positional.words and command.name != "thesis":
            yield f"{start} -a {_joined(command.positional.words)}"
        for slot in command.options:
            named = " ".join(
                f"-l {flag[2:]}" if flag.startswith("--") else f"-s {flag[1:]}"
                for flag in slot.flags
            )
            meaning = f"{named} -d {shlex.quote(slot.meaning)}"
            for of, words in slot.of_each.items():
                both = f"{seen}; and __fish_seen_subcommand_from {of}"
                yield f"complete -c rockeom -n '{both}' {named} -xa {_joined(words)}"
            if slot.takes == "nothing":
                yield f"{start} {meaning}"
            elif slot.files:
                yield f"{start} {meaning} -rF"
            else:
                yield f"{start} {meaning} -x" + (f"a {_joined(slot.words)}" * bool(slot.words))


_SHELLS = {"bash": _bash, "zsh": _zsh, "fish": _fish}
