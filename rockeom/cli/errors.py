"""What a user typed that no command understands."""

from __future__ import annotations


class UsageError(ValueError):
    """The message says what was typed, and what to type instead."""


def numbers(pairs: list[str], option: str, example: str) -> dict[str, float]:
    """name -> number of words such as "mass=122.6".

    Raises UsageError, naming the option and the word, for anything else and for a name given
    twice.
    """
    found: dict[str, float] = {}
    for pair in pairs:
        name, sign, text = pair.partition("=")
        if not (name and sign):
            raise UsageError(f"{option} {pair}: write name=value, as in {option} {example}")
        if name in found:
            raise UsageError(f"{option} {pair}: {name} is given twice")
        try:
            found[name] = float(text)
        except ValueError:
            raise UsageError(
                f"{option} {pair}: {text!r} is no number; write it with a decimal point and "
                f"without a unit, as in {option} {example}"
            ) from None
    return found
