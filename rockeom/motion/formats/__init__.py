"""Files of records as networks give them, a grammar in a module each, recognised by content.

A new format is a module here with `recognises` and `components`, and a line in `GRAMMARS`.
"""

from itertools import dropwhile, islice
from types import ModuleType

from rockeom.motion.formats import (
    afad,
    bhrc,
    cesmd,
    cosmos,
    cwb,
    dyna,
    geonet,
    knet,
    renadic,
    smc,
    unam,
    usc,
)  # fmt: skip
from rockeom.motion.formats.grammar import Component, Page, checked
from rockeom.motion.formats.text import Text

GRAMMARS = (dyna, geonet, knet, cosmos, renadic, cesmd, usc, smc, bhrc, cwb, afad, unam)
"""Grammars in the order in which they are asked; each recognises its own files only."""


HEAD = 13
"""Lines by which a grammar recognises a file."""


def grammar_of(text: Text) -> ModuleType | None:
    """The grammar that recognises a file."""
    lines = dropwhile(str.isspace, (line for _, line in text.lines()))
    head = list(islice(lines, HEAD))
    return next((one for one in GRAMMARS if one.recognises(head)), None)


def read_components(text: Text, gravity: float, stated_peak: bool = True) -> list[Component] | None:
    """All components of a file of a network, vertical ones positive upwards.

    None for a file that no grammar recognises.

    stated_peak : whether a peak that the file states must be that of its values.
    """
    grammar = grammar_of(text)
    if grammar is None:
        return None
    page = Page(text)
    if not page.lines[0].strip():
        raise page.error(1, "the first line is blank, in front of the header", "delete it")
    found = grammar.components(page, gravity)
    return [(checked(page, one, gravity) if stated_peak else one).upward() for one in found]
