"""``rockeom generate``: the folder generated/ of a checkout."""

import argparse
import sys
from collections.abc import Collection
from pathlib import Path

from rockeom.cli.errors import UsageError
from rockeom.codegen import write
from rockeom.numbers.checks import near

DESCRIPTION = """\
For who changes rockeom itself. Derive every shipped structure and rewrite generated/, a module
and a page for each, and their classes in rockeom/structures; or, with --check, compare and change
nothing. Takes half a minute, for one NAME a second or a few.
"""
EPILOG = """\
examples:
  rockeom generate           write what has changed, and name it
  rockeom generate rigid_block
  rockeom generate --check   show the difference and exit with 1 if there is one
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these structures")
    parser.add_argument("--check", action="store_true", help="compare only")


def run(args: argparse.Namespace) -> int:
    folder = write.GENERATED
    if not folder.is_dir():
        raise UsageError(
            f"there is no folder {folder}: this rockeom is installed, not checked out; "
            "run the command in a clone of its repository, installed with pip install -e ."
        )
    for name in args.names:
        if name not in write.SHIPPED:
            raise UsageError(
                f"no structure named {name!r}{near(name, write.SHIPPED)}; there are "
                f"{', '.join(write.SHIPPED)}"
            )
    print(f"deriving {', '.join(args.names) or 'all structures'} ...", file=sys.stderr)
    return (_check if args.check else _write)(folder, args.names)


def _write(folder: Path, names: Collection[str]) -> int:
    changed = write.write_generated(folder, names)
    for path in changed:
        print(f"wrote {path.relative_to(folder.parent).as_posix()}")
    if not changed:
        print("generated/ was up to date")
    return 0


def _check(folder: Path, names: Collection[str]) -> int:
    difference = write.check_generated(folder, names)
    if not difference:
        print("generated/ is what the models give")
        return 0
    print(difference, end="")
    print(
        "generated/ is not what the models give; the difference is above (- as it stands, "
        "+ as derived).\nTo mend it, change rockeom/symbolic or rockeom/codegen, never the files "
        "themselves, and run `make generated`.",
        file=sys.stderr,
    )
    return 1
