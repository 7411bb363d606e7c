"""Output of commands: lines that fit the terminal."""

import shutil
import textwrap
from collections.abc import Sequence


def width() -> int:
    """Columns to write in: those of the terminal, from 60 to 110; 100 where there is none."""
    return min(max(shutil.get_terminal_size((100, 24)).columns, 60), 110)


def listing(rows: Sequence[tuple[str, ...]]) -> str:
    """Rows of words in columns, the last one shortened to what the others leave of the width."""
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)][:-1]
    room = max(width() - sum(wide) - 2 * len(wide), 30)
    lines = []
    for *short, last in rows:
        start = "".join(f"{cell:{w}}  " for cell, w in zip(short, wide, strict=True))
        lines.append(start + textwrap.shorten(last, room, placeholder=" ..."))
    return "\n".join(lines)
