"""Errors of words that no command understands."""

from __future__ import annotations


class UsageError(ValueError):
    """The message says what was typed, and what to type instead."""


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


def _number(text: str, said: str, option: str, example: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(
            f"{said}: {text!r} is no number; write it with a decimal point and without a unit, as "
            f"in {option} {example}"
        ) from None
