"""The real records that other packages carry, by words of their names."""

import re
from collections.abc import Iterable
from functools import cache

from rockeom.motion.stored import COLLECTIONS, Stored
from rockeom.numbers.checks import InputError, installed_by, near, require_type


@cache
def records() -> dict[str, Stored]:
    """Each record by a name made of its words: earthquake, year, station, component, set.

    Raises InputError where no package that carries records is installed.
    """
    found = {
        "_".join(_words(title)): record
        for collection in COLLECTIONS
        if collection.is_installed
        for title, record in collection.titles().items()
    }
    if not found:
        raise InputError("words").says(
            f"recorded ground motions come from packages that are not installed{_not_installed()}"
        )
    return found


def names(words: str) -> tuple[str, ...]:
    """Names of the records that have all these words, such as "far field"; all for no words.

    Raises InputError if none has them, with the names there are, and TypeError for what is no
    text.
    """
    require_type("words", words, str, "a text, such as 'El Centro 1940 180'")
    wanted = set(_words(words))
    matches = tuple(name for name in records() if wanted <= set(name.split("_")))
    if not matches:
        raise InputError("words", words).says(
            f"no record has all the words of {words!r}{_nearest(wanted)}"
        )
    return matches


def find(words: str) -> Stored:
    """The one record whose name has all these words, such as "El Centro 1940 180".

    Raises InputError if none or several have them, with the names there are, and TypeError for
    what is no text.
    """
    if isinstance(words, str) and words in records():
        return records()[words]
    matches = names(words)
    if len(matches) > 1:
        raise InputError("words", words).says(
            f"several records have all the words of {words!r}{_choose(matches)}"
        )
    return records()[matches[0]]


def _words(text: str) -> list[str]:
    """The words of a text; "no pulse" is one: its set has not all the words of the pulse set."""
    return re.findall(r"[a-z0-9]+", re.sub(r"\bno[ _-]pulse\b", "nopulse", text.lower()))


def _nearest(wanted: set[str]) -> str:
    """Words that no name has, with the ones meant, and the names that have all other words."""
    of_each = {name: set(name.split("_")) for name in records()}
    there = set[str]().union(*of_each.values())
    strange = "".join(f"; {w!r} is in no name{near(w, there)}" for w in sorted(wanted - there))
    others = [name for name, has in of_each.items() if wanted & there <= has]
    return strange + _choose(others or of_each)


def _choose(among: Iterable[str]) -> str:
    listed = "\n  ".join(among)
    return f": choose from\n  {listed}{_not_installed()}"


def _not_installed() -> str:
    """A line for each collection that could be had."""
    return "".join(
        f"\nThose of {collection.package} are not installed: {installed_by(collection.extra)}"
        for collection in COLLECTIONS
        if not collection.is_installed
    )
