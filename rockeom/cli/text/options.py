"""Options of several forms that commands have."""

from typing import Any


def add_number(group: Any, flag: str, metavar: str, help: str, **others: Any) -> None:
    """An option that takes a number."""
    group.add_argument(flag, type=float, metavar=metavar, help=help, **others)


def add_words(group: Any, flag: str, metavar: str | tuple[str, str], help: str) -> None:
    """An option that takes words, one or more."""
    group.add_argument(flag, nargs="+", metavar=metavar, help=help)


def add_pairs(group: Any, flag: str, metavar: str, help: str, required: bool = False) -> None:
    """An option that takes pairs of a name and a value, and that may be given several times."""
    group.add_argument(
        flag, nargs="+", action="extend", default=[], required=required, metavar=metavar, help=help
    )
