"""The words of a page: the table of `texts.js`, in which a user may give others."""

import json
import re
from collections.abc import Mapping
from typing import Any

from rockeom.browser.controls import check_mapping
from rockeom.numbers.checks import InputError, near

_TABLE = re.compile(r"(?<=^const TEXTS = )\{.*?^\}(?=;)", re.DOTALL | re.MULTILINE)


def with_texts(
    script: str, others: Mapping[str, Any], names: Mapping[str, str], spatial: bool = False
) -> str:
    """The script of the texts without comments and indents, with others in its table.

    names : words of the names of sliders, menus, states and presets. spatial : whether the page is
    of space, whose texts are a table within. Raises ValueError for a text
    that the table does not have, and for one that leaves out a place such as {0}.
    """
    source = _TABLE.findall(script)[0]
    table = re.sub(r"(^|[{,] )(\w+):", r'\1"\2":', source, flags=re.MULTILINE)
    own = {**json.loads(re.sub(r",(?=\n\})", "", table)), "names": dict(names)}
    in_space = own.pop("space", {})
    own |= in_space if spatial else {}
    text = json.dumps(_changed("texts", own, others)).replace("<", "\\u003c")
    return script.replace(source, text)


def _changed(where: str, own: Mapping[str, Any], others: Any) -> dict[str, Any]:
    """A table with other texts in their places."""
    check_mapping(where, others)
    table = dict(own)
    for name, text in others.items():
        if name not in own:
            raise InputError("texts", name, where).says(f"a page has no {name!r}{near(name, own)}")
        if isinstance(own[name], dict):
            table[name] = _changed(f"{where}[{name!r}]", own[name], text)
        elif isinstance(text, str) and _places(text) == _places(own[name]):
            table[name] = text
        else:
            raise InputError(name, text, where).give(f"a text like {own[name]!r}")
    return table


def _places(text: str) -> set[str]:
    return set(re.findall(r"\{\d\}", text))
