"""Records by column positions: what a file of each format holds, read by plain slices.

Written apart from the package. A function takes the lines of a file and gives (step, values) of
each component [s, m/s2]; where a line is not what it takes it for, it raises ValueError or
IndexError. It says nothing of what else stands in the file.
"""

import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

G = 9.81


class Read(NamedTuple):
    step: float
    values: np.ndarray


def cells(lines: list[str], first: int, count: int, *widths: int) -> np.ndarray:
    """Numbers in columns, from the line of index `first` on."""
    starts = np.cumsum([0, *widths])
    own = []
    for n in range(count):
        row, column = divmod(n, len(widths))
        text = lines[first + row][starts[column] : starts[column + 1]]
        own.append(number(text))
    return np.array(own)


def behind(lines: list[str], label: str) -> str:
    """The rest behind a mark of the one line that begins with a label."""
    return lines[only(lines, label)].split(":", 1)[1].strip()


def only(lines: list[str], label: str) -> int:
    """The index of the one line that begins with a label."""
    (line,) = [n for n, text in enumerate(lines) if text.lower().startswith(label.lower())]
    return line


def number(text: str) -> float:
    return float(re.sub("[dD]", "e", text))


def dyna(lines: list[str]) -> list[Read]:
    count = int(behind(lines[:64], "NDATA"))
    step = number(behind(lines[:64], "SAMPLING_INTERVAL_S"))
    return [Read(step, 0.01 * np.array([number(text) for text in lines[64 : 64 + count]]))]


def geonet(lines: list[str], first: int) -> tuple[Read, int]:
    head = lines[first : first + 26]
    is_raw = head[0][:2].lower() == "un"
    count = int(head[9].split()[3])
    words = head[10].split()
    step = number(words[10 if is_raw else 4])
    scale = number(words[5]) if is_raw else 1.0
    own = cells(lines, first + 26, count, *10 * [8])
    return Read(step, 0.001 * scale * own), first + 26 + (1 if is_raw else 3) * -(-count // 10)


def knet(lines: list[str]) -> list[Read]:
    hertz, duration = number(lines[10][18:].lower().replace("hz", "")), number(lines[11][18:])
    gal, counts = lines[13][18:].split("(gal)/")
    own = cells(lines, 17, round(hertz * duration), *8 * [9])
    return [Read(1 / hertz, 0.01 * number(gal) / number(counts) * (own - own.mean()))]


def cesmd(lines: list[str], first: int) -> tuple[Read, int]:
    is_raw = lines[first][:2].lower() == "un"
    last = next(n for n in range(first, len(lines)) if lines[n].startswith("/&"))
    begins = next(
        n
        for n in range(first, last)
        if re.match(r"\s*\d+ (accelerogram points at|points of accel)", lines[n], re.I)
    )
    words = lines[begins].split()
    width = 9 if is_raw else 10
    assert f"8f{width}." in words[-1].lower()
    own = cells(lines, begins + 1, int(words[0]), *8 * [width])
    component = (
        Read(1 / number(words[4]), G * own) if is_raw else Read(number(words[8]), 0.01 * own)
    )
    return component, last + 1


def renadic(lines: list[str], first: int) -> tuple[Read, int]:
    count = int(lines[first + 10].split("=")[1].split()[0])
    pairs = cells(lines, first + 27, 2 * count, *10 * [7])
    step = round((pairs[-2] - pairs[0]) / (count - 1), 6)
    return Read(step, 0.1 * G * pairs[1::2]), first + 27 + -(-2 * count // 10) + 1


def bhrc(lines: list[str], first: int) -> tuple[Read, int]:
    _, points, duration = lines[first + 10].split("=")
    count = int(points.split()[0])
    own = cells(lines, first + 27, count, *10 * [13])
    rate = number(lines[first + 21][:13])
    step = 1 / rate if rate else number(duration) / count
    return Read(step, 0.1 * G * own), first + 27 + -(-count // 10) + 1


def cosmos(lines: list[str], first: int) -> tuple[Read, int]:
    reals = cells(lines, first + 25, 100, *6 * [13])
    comments = int(lines[first + 42].split()[0])
    begins = first + 43 + comments
    count = int(lines[begins].split()[0])
    per, width = (8, 10) if "8F10." in lines[begins].upper() else (1, 15)
    assert f"({per}{'F' if per == 8 else 'E'}{width}." in lines[begins].upper()
    own = cells(lines, begins + 1, count, *per * [width])
    unit = G if "g(02)" in lines[begins].lower() else 0.01
    return Read(reals[61] / 1000, unit * own), begins + 1 + -(-count // per) + 1


def smc(lines: list[str]) -> list[Read]:
    whole = cells(lines, 11, 48, *8 * [10])
    rate = cells(lines, 17, 50, *5 * [15])[1]
    return [Read(1 / rate, 0.01 * cells(lines, 27 + int(whole[15]), int(whole[16]), *8 * [10]))]


def usc(lines: list[str]) -> list[Read]:
    begins = next(n for n, text in enumerate(lines) if "POINTS OF ACC DATA" in text.upper())
    words = lines[begins].split()
    own = cells(lines, begins + 1, int(words[0]), *8 * [10])
    return [Read(number(words[8]), 0.01 * own)]


def side_by_side(step: float, table: np.ndarray) -> list[Read]:
    return [Read(step, 0.01 * column) for column in table.T]


def cwb(lines: list[str]) -> list[Read]:
    hertz, duration = (
        number(behind(lines, f"#{name}:")) for name in ("SampleRate(Hz)", "RecordLength(sec)")
    )
    begins, count = only(lines, "#Data:") + 1, round(hertz * duration)
    table = cells(lines, begins, 4 * count, 10, 10, 10, 10).reshape(-1, 4)
    return side_by_side(1 / hertz, table[:, 1:])


def afad(lines: list[str]) -> list[Read]:
    count = int(behind(lines[:17], "NUMBER OF DATA"))
    step = number(behind(lines[:17], "SAMPLING INTERVAL (sec)"))
    return side_by_side(step, cells(lines, 18, 3 * count, 12, 14, 13).reshape(-1, 3))


def unam(lines: list[str]) -> list[Read]:
    counts, steps = (
        behind(lines, name).strip("/ ").split("/")[0]
        for name in ("NUM. TOTAL DE MUESTRAS, C1-C6", "INTERVALO DE MUESTREO, C1-C6 (s)")
    )
    begins = only(lines, "DATOS DE ACELERACION:") + 5
    table = cells(lines, begins, 3 * int(counts), 10, 10, 10)
    return side_by_side(number(steps), table.reshape(-1, 3))


def peer(lines: list[str]) -> list[Read]:
    """Free of columns: numbers between blanks, or glued where a sign follows a digit."""
    head = next(n for n, text in enumerate(lines) if re.search(r"npts\s*=", text, re.I))
    step = re.split(r"dt\s*=", lines[head], flags=re.I)[1].split()[0].split(",")[0]
    count = int(re.split(r"npts\s*=", lines[head], flags=re.I)[1].split(",")[0].split()[0])
    fields = re.sub(r"([0-9.])([+-])", r"\1 \2", " ".join(lines[head + 1 :])).split()
    own = np.array([number(field) for field in fields])
    if len(own) != count:
        raise ValueError(f"{len(own)} values, not {count}")
    return [Read(number(re.sub(r"[a-z]+$", "", step.strip(","), flags=re.I)), G * own)]


ONE_AFTER_THE_OTHER: dict[str, Callable[[list[str], int], tuple[Read, int]]] = {
    "geonet_v1a": geonet, "geonet_v2a": geonet, "cesmd_v1": cesmd, "cesmd_v2": cesmd,
    "cosmos_v1": cosmos, "cosmos_v2c": cosmos, "renadic": renadic, "bhrc": bhrc,
}  # fmt: skip
"""The component that begins at a line, and the index of the line after it."""
WHOLE: dict[str, Callable[[list[str]], list[Read]]] = {
    "dyna": dyna, "knet": knet, "kik_net": knet, "smc": smc, "usc": usc, "cwb": cwb,
    "afad": afad, "unam": unam, "peer": peer,
}  # fmt: skip


def read(name: str, raw: bytes) -> list[Read]:
    """All components of the bytes of a file."""
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    lines = re.split(r"\r\n|\r|\n", text)
    while not lines[-1].strip():
        del lines[-1]
    if name in WHOLE:
        return WHOLE[name](lines)
    every, first = [], 0
    while first < len(lines):
        component, first = ONE_AFTER_THE_OTHER[name](lines, first)
        every.append(component)
    return every
