"""Errors of words that no command understands, and remedies in the words of the command line."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from rockeom.files import check_target


class UsageError(ValueError):
    """The message says what was typed, and what to type instead."""


_OPTIONS = (
    "columns|components|damping_ratio|dt|duration|end|frames_per_second|impact|initial|layout|"
    "output_step|period|pga|sa|speed|start|units|vertical"
)
"""Arguments of Python that an option of the same name gives."""

_REMEDIES = (
    (r"GroundMotion\.from_csv\(path, dt=(\S+)\)", r"--dt \1, with the time step of the file"),
    (r'GroundMotion\.from_csv\(path, dt=(\S+), layout="(\w+)"\)', r"--dt \1 --layout \2"),
    (r"with GroundMotion\.from_csv", "by --columns"),
    (r"with GroundMotion\.from_columns", "from a file whose name does not end in .AT2"),
    (r"read it with GroundMotion\.from_at2", "let its name end in .AT2"),
    (r"^start and end are", "--start and --end are"),
    (rf"^({_OPTIONS}) (?=is|has|needs)", r"--\1 "),
    (r"^over: ", "--over: "),
    (r"^periods are", "--floor: periods are"),
    (r"^assess: (?=level|friction)", "--"),
    (r"units_checked=True", "--units-checked"),
    (r"see MotionSet\.recordings\(\)", "with --components all of a folder"),
    (r"^time is", "--time-scale is"),
    (r"^acceleration is", "--acceleration-scale is"),
    (r"\(start, end\)", "(--start, --end)"),
    (r"draw fewer frames_per_second", "draw fewer --frames-per-second"),
    (r"name acceleration_column", "name it by --columns"),
    (r" \(numpy\.interp\) and give the arrays", ""),
    (r"give another pattern", "name the files themselves"),
    (r"give each one of its own, by dataclasses.replace\(motion, name=\.\.\.\)", "name it once"),
    (r'scaled_to\("([\d.]+) (\S+)"\)', r"--pga \1\2"),
    (r"got an unexpected keyword argument", "no argument is called"),
    (r"(?:rk\.)?GroundMotion\.none\(duration\)", "--free --duration S"),
    (r"support=rk\.Sliding\(\.\.\.\)", "--set support=sliding"),
    (r"rk\.SlidingBlock", "sliding_block"),
    (r"\bAngularMomentum\(\)", "angular-momentum"),
    (r"\bImpulsive\(\)", "impulsive"),
    (r"\bEnergyRatio\(r=([^)]*)\)", r"energy-ratio=\1"),
    (r"\bEnergyRatio\(left=([^,)]*), right=([^)]*)\)", r"energy-ratio=\1,\2"),
    (r"\bVelocityRatio\(e=([^)]*)\)", r"velocity-ratio=\1"),
    (rf'\b({_OPTIONS})="([\d.]+) (\S+)"', r"--\1 \2\3"),
    (rf"\b({_OPTIONS})=(?=[,.;:)\s]|$)", r"--\1"),
    (rf"\b({_OPTIONS})=(?=[\w(\"'.-])", r"--\1 "),
    ("--([a-z]+)_([a-z]+)(?:_([a-z]+))?", lambda m: "--" + "-".join(filter(None, m.groups()))),
)
"""Words of Python in errors, and those of the command line."""

_MOST_LISTED = 6


def in_options(message: str) -> str:
    """An error or a hint of the package, its remedies in the words of the command line.

    Long lists of records are cut: a command shows them.

    >>> in_options("the file does not say its units. Remedy: say units=, one of m/s2, g.")
    'the file does not say its units. Remedy: say --units, one of m/s2, g.'
    """
    for python, here in _REMEDIES:
        message = re.sub(python, here, message)
    first, *listed = message.split("\n  ")
    if len(listed) <= _MOST_LISTED or not first.endswith("choose from"):
        return message
    shown = [*listed[:_MOST_LISTED], "... (rockeom records lists all, and searches them by words)"]
    return "\n  ".join([first, *shown])


def numbers(pairs: list[str], option: str, example: str) -> dict[str, float]:
    """name -> number of words such as "mass=122.6".

    Raises UsageError, naming the option and the word, for anything else and for a name given
    twice.
    """
    given = words(pairs, option, example)
    return {
        name: _number(text, f"{option} {name}={text}", option, example)
        for name, text in given.items()
    }


def words(pairs: list[str], option: str, example: str) -> dict[str, str]:
    """name -> what stands behind its =, of words such as "support=winkler".

    Raises UsageError, naming the option and the word, for anything else and for a name given
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

    of : reads one number. Raises UsageError, naming `said`, for another form, for what is no
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
    """Raise UsageError for a file that is no picture, OSError for one that cannot be written."""
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
