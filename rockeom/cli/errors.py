"""Errors of words that no command understands, and those of the package in options."""

import argparse
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from rockeom.files import check_target
from rockeom.motion import units
from rockeom.numbers.checks import InputError, in_python, near


class UsageError(InputError):
    """The message says what was typed, and what to type instead."""

    def __init__(self, message: str) -> None:
        super().__init__("")
        self.says(message)


def message(error: Exception, args: argparse.Namespace) -> str:
    """An error of a command that was understood."""
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}. Check the path and the permissions."
    return in_options(error, args) if isinstance(error, InputError) else str(error)


def meant(name: str, commands: Mapping[str, str]) -> str:
    """An unknown command, and what to type for the one that is most like it."""
    return f"{name!r}{near(name, commands, commands)}"


def unknown(words: Sequence[str]) -> str:
    """An error of words that no option takes."""
    text = f"unrecognized arguments: {' '.join(words)}"
    if units.is_known(words[0]):
        text += f"; write a number and its unit without a blank, as 0.4{words[0]}"
    return text


_CALLED = {
    "acceleration": "acceleration_scale",
    "time": "time_scale",
    "periods": "floor",
    "height": "floor_height",
    "time_column": "columns",
    "acceleration_column": "columns",
    "column": "columns",
    "path": "out",
}
"""Arguments of Python whose option has another name."""
_MOST_LISTED = 6


def in_options(error: InputError, args: argparse.Namespace) -> str:
    """An error of the package as the options of a command say it.

    Long lists of records are cut: a command shows them.
    """
    settings = {pair.partition("=")[0] for pair in getattr(args, "set", [])}
    options = args.parser._option_string_actions

    def option(name: str, value: str | None) -> str:
        flag = f"--{name}".replace("_", "-")
        if name in settings:
            flag = f"--set {name}"
        elif flag not in options:
            flag = f"--{_CALLED.get(name, name)}".replace("_", "-")
            if flag not in options:
                return in_python(name, value)
        return f"{flag} {(value or '').replace(chr(34), '').replace(' ', '')}".rstrip()

    is_option = option(error.argument, None) != error.argument
    text = error.in_words(option, error.of if error.of[:2] == "--" or not is_option else "")
    first, *records = text.split("\n  ") if error.argument == "words" else [text]
    if len(records) > _MOST_LISTED:
        more = "... (rockeom records lists all, and searches them by words)"
        records = [*records[:_MOST_LISTED], more]
    return "\n  ".join([first, *records])


def numbers(pairs: list[str], option: str, example: str) -> dict[str, float]:
    """name -> number of words such as "mass=122.6".

    Raises InputError, naming the option and the word, for anything else and for a name given
    twice.
    """
    given = words(pairs, option, example)
    return {
        name: _number(text, f"{option} {name}={text}", option, example)
        for name, text in given.items()
    }


def words(pairs: list[str], option: str, example: str) -> dict[str, str]:
    """name -> what stands behind its =, of words such as "support=winkler".

    Raises InputError, naming the option and the word, for anything else and for a name given
    twice.
    """
    found: dict[str, str] = {}
    for pair in pairs:
        name, sign, text = pair.partition("=")
        said = f"{option} {pair}".strip()
        if not (name and sign):
            raise UsageError(f"{said}: write name=value, as in {f'{option} {example}'.strip()}")
        if name in found:
            raise UsageError(f"{said}: {name} is given twice")
        found[name] = text
    return found


def lists(text: str, said: str, option: str, example: str) -> list[float]:
    """The numbers of a list such as "20e3,20e3"."""
    return [_number(one, said, option, example) for one in text.split(",")]


def spread(text: str, said: str, example: str, of: Callable[[str], float] = float) -> list[float]:
    """The numbers of "0.1:0.3:5", five from 0.1 to 0.3 at even distances, or of "1,2,3".

    of : reads one number. Raises InputError, naming `said`, for another form, for what is no
    number, and for one that is named twice.
    """
    parts = text.split(":")
    if len(parts) == 1:
        found = [_read(one, said, of) for one in text.split(",")]
        if len({*found}) < len(found):
            raise UsageError(f"{said}: a value is named twice")
        return found
    if len(parts) != 3 or not parts[2].isdecimal() or int(parts[2]) < 2:
        raise UsageError(
            f"{said}: write first:last:number, two values or more, or a list, as in {example}"
        )
    first, last, number = _read(parts[0], said, of), _read(parts[1], said, of), int(parts[2])
    if first == last:
        raise UsageError(f"{said}: the first value is the last: write one that differs")
    return [first + (last - first) * i / (number - 1) for i in range(number)]


def _read(text: str, said: str, of: Callable[[str], float]) -> float:
    try:
        return of(text)
    except UsageError:
        raise
    except ValueError as error:
        why = f"{text!r} is no number" if of is float else str(error)
        raise UsageError(f"{said}: {why}") from None


PICTURES = (".png", ".pdf", ".svg")
"""Endings of pictures."""


def check_picture(path: Path) -> None:
    """Raise InputError for a file that is no picture, OSError for one that cannot be written."""
    if path.suffix.lower() not in PICTURES:
        raise UsageError(f"--out {path}: the name must end in {', '.join(PICTURES)}")
    check_target(path)


def _number(text: str, said: str, option: str, example: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(
            f"{said}: {text!r} is no number; write it with a decimal point and without a unit, as "
            f"in {option} {example}"
        ) from None
