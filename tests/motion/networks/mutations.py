"""python -m tests.motion.networks.mutations: files of networks spoiled at random, read or refused.

A reader must refuse a spoiled file with InputError, or give what the oracle reads from its bytes.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np

from rockeom import InputError
from rockeom.motion.readers import read_file
from tests.motion.networks import oracle
from tests.motion.networks.twins import GRAVITY, TWINS

SECONDS = 1.0
"""Longest time of a file of a few hundred samples."""
HEAD = 60
"""Lines that half of the mutations choose from."""
LETTERS = "0123456789 .-+eEDx,:=\té"


def place(lines: list[str], random: Random) -> int:
    return random.randrange(min(len(lines), HEAD) if random.random() < 0.5 else len(lines))


def truncated(text: str, random: Random) -> str:
    return text[: random.randrange(len(text))]


def by_line(change: Callable[[list[str], int, Random], None]) -> Callable[[str, Random], str]:
    """A mutation that changes the lines at one."""

    def mutation(text: str, random: Random) -> str:
        lines = text.split("\n")
        change(lines, place(lines, random), random)
        return "\n".join(lines)

    return mutation


def lost(lines: list[str], n: int, random: Random) -> None:
    del lines[n]


def doubled(lines: list[str], n: int, random: Random) -> None:
    lines.insert(n, lines[n])


def swapped(lines: list[str], n: int, random: Random) -> None:
    other = place(lines, random)
    lines[n], lines[other] = lines[other], lines[n]


def letter(lines: list[str], n: int, random: Random) -> None:
    """Lost, added or changed."""
    at = random.randrange(len(lines[n]) + 1)
    new, after = random.choice([("", 1), (random.choice(LETTERS), random.randrange(2))])
    lines[n] = lines[n][:at] + new + lines[n][at + after :]


def field_changed(lines: list[str], n: int, random: Random) -> None:
    """Another number of the same or of another length, or another word."""
    words = lines[n].split(" ")
    filled = [k for k, word in enumerate(words) if word]
    if filled:
        other = [
            "0",
            "-1",
            "399",
            "401",
            "1e9",
            ".02",
            "nan",
            "x",
            "1E400",
            "0.0",
            "9" * 5000,
            "1E-9999999",
        ]
        words[random.choice(filled)] = random.choice(other)
        lines[n] = " ".join(words)


def tabs(lines: list[str], n: int, random: Random) -> None:
    lines[n] = lines[n].replace("  ", "\t")


def carriage(text: str, random: Random) -> str:
    return text.replace("\n", random.choice(["\r\n", "\r", "\n\n", " \n", "\r\r\n"]))


def encoded(text: str, random: Random) -> bytes:
    at = random.randrange(len(text))
    codec = random.choice(["utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-32", "cp1252"])
    return (text[:at] + random.choice("é ° ³²") + text[at:]).encode(codec, "replace")


def appended(text: str, random: Random) -> str:
    at = random.choice([0, 0, text.find("\n") + 1, random.randrange(len(text))])
    return text + text[at:]


MUTATIONS: tuple[Callable[[str, Random], str | bytes], ...] = (
    truncated, carriage, encoded, appended, *map(by_line, (
        lost, doubled, swapped, letter, letter, letter, field_changed, tabs,
    )),
)  # fmt: skip


def spoiled(text: str, random: Random) -> bytes:
    """The bytes of a file, spoiled once, or now and then twice."""
    made: str | bytes = text
    for _ in range(1 + (random.random() < 0.2)):
        if isinstance(made, str) and made:
            made = random.choice(MUTATIONS)(made, random)
    return made if isinstance(made, bytes) else made.encode("utf-8")


def fault(name: str, path: Path, stated_peak: bool) -> str | None:
    """Fault of the reading of a file; None where it is refused, or read as it is."""
    begin = time.perf_counter()
    try:
        records = read_file(path, None, GRAVITY, stated_peak)
    except InputError:
        records = None
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    spent = time.perf_counter() - begin
    if spent > SECONDS:
        return f"{spent:.1f} s"
    if records is None:
        return None
    try:
        own = oracle.read(name, path.read_bytes())
    except (ValueError, IndexError, AssertionError, StopIteration) as error:
        return f"read, and not by the oracle: {type(error).__name__} {error}"
    same = len(own) == len(records) and all(
        len(a.acceleration) == len(b.values)
        and np.allclose(a.acceleration, b.values, rtol=1e-12, atol=1e-14)
        and abs(a.dt - b.step) <= 1e-12 * b.step
        for a, b in zip(records, own, strict=True)
    )
    return None if same else "read as other values, number or step than the oracle's"


def faults(name: str, seeds: range) -> list[tuple[int, str]]:
    """Seeds of a format whose spoiled file is neither refused nor read as it is."""
    text, wrong = TWINS[name]().text, []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / ("a.at2" if name == "peer" else "a.txt")
        for seed in seeds:
            random = Random(f"{name} {seed}")
            path.write_bytes(spoiled(text, random))
            if told := fault(name, path, stated_peak=bool(seed % 2)):
                wrong.append((seed, told))
    return wrong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=20_000, help="mutations of each format")
    parser.add_argument("--first", type=int, default=0, help="the first of them")
    parser.add_argument("formats", nargs="*", default=[*TWINS], help="only these")
    given = parser.parse_args()
    total = 0
    for name in given.formats:
        wrong = faults(name, range(given.first, given.first + given.runs))
        total += len(wrong)
        print(f"{name}: {given.runs} spoiled files, {len(wrong)} faults", *wrong[:20], sep="\n  ")
    return bool(total)


if __name__ == "__main__":
    sys.exit(main())
