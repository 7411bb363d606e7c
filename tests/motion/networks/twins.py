"""A file of invented stations in the format of each network, with one known motion."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

SAMPLES, DT, GRAVITY = 400, 0.01, 9.81
TIMES = DT * np.arange(SAMPLES)


class Direction(NamedTuple):
    """Component as a file must give it: name, azimuth [degrees] and accelerations [m/s2]."""

    name: str
    azimuth: float | None
    is_vertical: bool
    acceleration: np.ndarray


class Twin(NamedTuple):
    """A file, and what it holds. station : as it must appear; unit : as it must be named."""

    text: str
    unit: str
    station: str
    directions: list[Direction]


class Block(NamedTuple):
    """Values as they are printed: lines, numbers and their peak, in the unit of the file."""

    lines: list[str]
    values: np.ndarray
    peak: float


def sine(k: int, unit: float) -> np.ndarray:
    """The damped sine (n,) of component k, in a unit [m/s2]."""
    shape = np.exp(-TIMES / 2) * np.sin(2 * np.pi * (1.5 + k) * TIMES + 0.3)
    return (1 + 0.5 * k) * shape / unit


def rows(fields: Sequence[str], per_line: int) -> list[str]:
    return ["".join(fields[n : n + per_line]) for n in range(0, len(fields), per_line)]


def zeros(count: int, width: int, per_line: int, form: str = ".0f", **at: float) -> list[str]:
    """Numbers of a header, zero but for some: `_33=400` sets the one of index 33."""
    values = [at.get(f"_{n}", 0) for n in range(count)]
    return rows([format(value, f"{width}{form}") for value in values], per_line)


def block(numbers: np.ndarray, form: str, per_line: int) -> Block:
    fields = [format(value, form) for value in numbers]
    values = np.array([float(field) for field in fields])
    return Block(rows(fields, per_line), values, values[np.abs(values).argmax()])


def file(*parts: str | Sequence[str]) -> str:
    lines = [line for part in parts for line in ([part] if isinstance(part, str) else part)]
    return "\n".join(lines) + "\n"


def dyna() -> Twin:
    own = block(sine(0, 0.01), ".6f", 1)
    stated = {
        "EVENT_NAME": "NOWHERE", "NETWORK": "XX", "STATION_CODE": "ABC1",
        "SAMPLING_INTERVAL_S": DT, "NDATA": SAMPLES, "STREAM": "HNE", "UNITS": "cm/s^2",
        "PGA_CM/S^2": f"{own.peak:.6f}", "HEADER_FORMAT": "DYNA 1.2", "DATA_TYPE": "ACCELERATION",
    }  # fmt: skip
    stated |= {f"USER{n}": "" for n in range(64 - len(stated))}
    head = [f"{key}: {value}" for key, value in stated.items()]
    direction = Direction("HNE", 90.0, False, 0.01 * own.values)
    return Twin(file(head, own.lines), "cm/s^2", "XX.ABC1", [direction])


def geonet(is_raw: bool) -> Twin:
    lines, directions = [], []
    for k, (name, azimuth) in enumerate({"N28W": 332.0, "S62W": 242.0, "Up": None}.items()):
        own = block(sine(k, 0.001), "8.1f", 10)
        kind, step = "Corrected", f"Instrument corrected data at {DT:.3f} sec intervals"
        if is_raw:
            kind = "Uncorrected"
            step = "Raw readings in units of 1.000 mm/s/s at intervals of .01 s"
        lines += [
            f"{kind} accelerogram 20200101_000000_ABCD_20 GNS Science",
            "Site ABCD      42 00 00S  173 00 00E", *7 * ["Nowhere"],
            f"Number of points  {SAMPLES}    Duration 4.00 sec", step, "Band-pass filter",
            f"Component {name}  Axis", f"Acceleration:  peak {own.peak:8.1f} mm/s/s at 1.00 sec",
            "Velocity:", "Displacement:", *zeros(100, 8, 10, _33=SAMPLES), *own.lines,
        ]  # fmt: skip
        if not is_raw:
            lines += block(0.1 * own.values, "8.2f", 10).lines
            lines += block(0.01 * own.values, "8.3f", 10).lines
        directions.append(Direction(name, azimuth, azimuth is None, 0.001 * own.values))
    return Twin(file(lines), "mm/s2", "ABCD", directions)


def knet(direction: str, name: str, azimuth: float, place: str = "") -> Twin:
    scale = 2000 / 8388608
    own = block(np.round(sine(0, 0.01) / scale + 6900), "8.0f", 1)
    gal = scale * (own.values - own.values.mean())
    stated = {
        "Origin Time": "2020/01/01", "Lat.": "", "Long.": "", "Depth. (km)": "", "Mag.": "",
        "Station Code": "ABC001", "Station Lat.": "", "Station Long.": "",
        "Station Height(m)": "", "Record Time": "",
        "Sampling Freq(Hz)": "100Hz", "Duration Time(s)": "4", "Dir.": direction,
        "Scale Factor": "2000(gal)/8388608", "Max. Acc. (gal)": f"{np.abs(gal).max():.3f}",
        "Last Correction": "2020/01/01 00:00:00", "Memo.": "",
    }  # fmt: skip
    head = [f"{label:18s}{value}" for label, value in stated.items()]
    table = rows([f"{line} " for line in own.lines], 8)
    directions = [Direction(name, azimuth, False, 0.01 * gal)]
    return Twin(file(head, table), "gal", "ABC001" + place, directions)


def cesmd(is_raw: bool) -> Twin:
    lines, directions = [], []
    unit = GRAVITY if is_raw else 0.01
    names = {"360 Deg - roof": 0.0, "90 Deg - roof": 90.0, "Up - roof": None}
    for k, (name, azimuth) in enumerate(names.items()):
        own = block(sine(k, unit), "9.6f" if is_raw else "10.5f", 8)
        text = [
            "Uncorrected Accelerogram Data", *2 * ["Preliminary Processing"], "11111-L1-20001.00",
            "Station No. 11111   40.0N, 123.0W   (3 Chns of  3 at Sta)", "Nowhere",
            f"Chan  {k + 1}: {name}", "Record of Wed Jan 1, 2020 13:06:45.0 PST", "Hypocenter:",
        ]  # fmt: skip
        if is_raw:
            text += [f"Units are sec and g .  Max  = {own.peak:9.6f} g , at   1.0 sec."]
            head = f"{SAMPLES:6d} Accelerogram points at 100 pts/sec in units of g .  "
            data = [head + "Format: (8f9.6)", *own.lines]
        else:
            text.insert(0, f"Corrected accelerogram   11111-L1-20001.00   Chan  {k + 1}:  {name}")
            text += [f"Peak acceleration = {own.peak:9.5f}  cm/sec/sec  at 1.0   sec."]
            data = []
            for n, of in enumerate(("accel", "veloc", "displ")):
                head = f"{SAMPLES:6d} points of {of} data equally spaced at  {DT:.3f} sec, in "
                unit_of = ("cm/sec2.", "cm/sec. ", "cm.     ")[n]
                data += [f"{head}{unit_of} (8f10.5)"]
                data += block(own.values / 10**n, "10.5f", 8).lines
        text += ((13 if is_raw else 25) - len(text)) * [""]
        code = 500 if azimuth is None else azimuth
        lines += [*text, *zeros(100, 5, 16, _26=code), *zeros(66, 10, 8, ".6f"), *data]
        lines += [f"/&  ----------  End of data for channel  {k + 1}  ----------"]
        directions.append(Direction(name, azimuth, azimuth is None, unit * own.values))
    return Twin(file(lines), "g" if is_raw else "cm/s2", "11111 roof", directions)


def renadic() -> Twin:
    lines, directions = [], []
    for k, (name, azimuth) in enumerate({"N-S": 0.0, "E-W": 90.0, "V": None}.items()):
        own = block(sine(k, 0.1 * GRAVITY), "7.3f", 1)
        pairs = [field for t, a in zip(TIMES, own.lines, strict=True) for field in (f"{t:7.3f}", a)]
        lines += [
            "UNCORRECTED ACCELEROGRAM DATA", *4 * ["RENADIC"], "NOWHERE S/N 1",
            f"CHAN  {k + 1}: {name}", "UNIVERSIDAD", "HYPOCENTER:", "INSTR PERIOD = 0.0380 SEC",
            f"NO. OF POINTS = {SAMPLES:6d}  RECORD LENGTH = 4.0 SEC",
            f"UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = {own.peak / 10:7.4f} G, AT 1.0 SEC",
            "RMS ACCEL", *zeros(100, 5, 16), *zeros(50, 10, 8, ".3f"), *rows(pairs, 10),
            f"/&  ----------  END OF DATA FOR CHANNEL {k + 1}  ----------",
        ]  # fmt: skip
        directions.append(Direction(name, azimuth, azimuth is None, 0.1 * GRAVITY * own.values))
    return Twin(file(lines), "g/10", "NOWHERE S/N 1", directions)


def bhrc() -> Twin:
    lines, directions = [], []
    for k, (name, azimuth) in enumerate({"L": 50.0, "V": None, "T": 140.0}.items()):
        own = block(sine(k, 0.1 * GRAVITY), "13.5E", 10)
        lines += [
            "* VOL1DS FILE:  1111/01", "Inst Type = SSA-2", "Origin Time : 2020/01/01", "", name,
            "", f"COMP {name}1", "Abcd   Station   37.0 N 47.0 E   Azimuth L 50    T 140",
            "Epicenter", "INSTR PERIOD =  .020 SEC",
            f"NO. OF POINTS = {SAMPLES:6d}      DURATION = {DT * SAMPLES:7.3f}",
            "UNITS ARE SECONDS AND G/10", "", *zeros(98, 5, 14),
            *zeros(35, 13, 5, ".5E", _5=1 / DT), *own.lines, "/&",
        ]  # fmt: skip
        directions.append(Direction(name, azimuth, azimuth is None, 0.1 * GRAVITY * own.values))
    return Twin(file(lines), "g/10", "Abcd", directions)


def cosmos(code: str | None, per_line: int, form: str, fortran: str) -> Twin:
    """With a comment <SCNL> that names the code of the component, or without comments."""
    lines, directions = [], []
    for k, (name, azimuth) in enumerate({"340 deg": 340.0, "Up": None}.items()):
        own = block(sine(k, 0.01), form, per_line)
        comments = [f"|<SCNL>ABCD.{code}{'EZ'[k]}.XX.--"] if code else []
        lines += [
            "Corrected acceleration    (Format v01.20 with 13 text lines)", *3 * ["Nowhere"],
            "Statn No: 01-11111  Code:XX-ABCD  Nowhere", *3 * ["Coords:"],
            f"Sta Chan  {k + 1}: {name} (Rcrdr Chan  1) Location:", "Raw record length = 4 sec",
            f"Processed: 01/01/2020, Max = {own.peak:.5f} cm/sec2 at 1.0 sec", *2 * ["Filtered"],
            " 100 Integer-header values follow on  10 lines, Format= (10I8)",
            *zeros(100, 8, 10, _53=400 if azimuth is None else azimuth),
            " 100 Real-header values follow on  17 lines, Format= (6F13.6)",
            *zeros(100, 13, 6, ".6f", _61=1000 * DT),
            f"  {len(comments)} Comment line(s) follow, each starting with a \"|\":", *comments,
            f"{SAMPLES:7d} acceleration pts, approx  4 secs, units=cm/sec2(04),Format=({fortran})",
            *own.lines, f"/&  ----------  End of data for channel  {k + 1}  ----------",
        ]  # fmt: skip
        called = f"{code}{'EZ'[k]}" if code else name
        directions.append(Direction(called, azimuth, azimuth is None, 0.01 * own.values))
    return Twin(file(lines), "cm/s2", "XX-ABCD", directions)


def smc() -> Twin:
    own = block(sine(0, 0.01), "10.3E", 1)
    fields = [line.replace("E+0", "E+").replace("E-0", "E-") for line in own.lines]
    text = [
        "2 CORRECTED ACCELEROGRAM", "*", "ABCDE", "     2020  01  01    0000 Nowhere",
        "Moment Mag=      7.1", "station = Nowhere, 1 Main Street     component=    350",
        f"epicentral dist =     89.0       pk     = {own.peak:8.4f}", "inst type=", "*", "*", "*",
    ]  # fmt: skip
    whole = zeros(48, 10, 8, _0=-32768, _12=90, _13=350, _15=2, _16=SAMPLES)
    reals = zeros(50, 15, 5, ".7E", _1=1 / DT)
    values = rows([f"{field:>10s}" for field in fields], 8)
    directions = [Direction("350", 350.0, False, 0.01 * own.values)]
    written = file(text, whole, reals, ["|", "|a comment"], values)
    return Twin(written, "cm/s2", "Nowhere, 1 Main Street", directions)


def usc() -> Twin:
    own = block(sine(0, 0.01), "10.3f", 8)
    lines = [
        "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0  CORRESPONDING T",
        "FILE     0", "NOWHERE EARTHQUAKE", "JAN 1, 2020", "ABC",
        "STATION USC# 0001   34 00 00N, 118 00 00W", "NOWHERE", "COMP N08W", *7 * ["TEXT"],
        f"  {SAMPLES}  INSTRUMENT AND BASELINE CORRECTED DATA",
        f"PEAK ACCELERATION = {own.peak:11.5f}  CMS/SEC/SEC AT    1.0   SEC.", *7 * ["TEXT"],
        *zeros(100, 5, 16), *zeros(100, 10, 8, ".3f"),
    ]  # fmt: skip
    for n, unit in enumerate(("ACC", "VEL", "DIS")):
        of = ("CM/SEC/SEC", "CM/SEC", "CM")[n]
        lines += [
            f"  {SAMPLES} POINTS OF {unit} DATA EQUALLY SPACED AT   {DT:.3f} SEC.  IN UNITS {of}",
            *block(own.values / 10**n, "10.3f", 8).lines,
        ]
    directions = [Direction("N08W", 352.0, False, 0.01 * own.values)]
    return Twin(file(lines), "cm/s2", "USC# 0001   34 00 00N", directions)


def in_columns(forms: Sequence[str], names: dict[str, float | None]) -> tuple[list[str], list]:
    """Components side by side in gal: lines, and the components."""
    own = [block(sine(k, 0.01), form, 1) for k, form in enumerate(forms)]
    lines = ["".join(fields) for fields in zip(*(one.lines for one in own), strict=True)]
    named = zip(names.items(), own, strict=True)
    return lines, [Direction(n, az, az is None, 0.01 * one.values) for (n, az), one in named]


def peaks(directions: Sequence[Direction]) -> list[float]:
    return [100 * one.acceleration[np.abs(one.acceleration).argmax()] for one in directions]


def cwb() -> Twin:
    table, directions = in_columns(["10.3f"] * 3, {"U": None, "N": 0.0, "E": 90.0})
    ranges = [(100 * one.acceleration.max(), 100 * one.acceleration.min()) for one in directions]
    lines = [
        "#Earthquake Information", "#Origin Time(GMT+08): 2020/01/01-00:00:00", "",
        "#Station Information", "#StationCode: ABC", "#RecordLength(sec): 4",
        "#SampleRate(Hz): 100", "#AmplitudeUnit:  gal. DCoffset(corr)",
        *(f"#AmplitudeMAX. {d.name}: {high:8.3f}~ {low:8.3f}"
          for d, (high, low) in zip(directions, ranges, strict=True)),
        "#DataSequence: Time U(+); N(+); E(+)", "#Data: 4F10.3",
        *(f"{t:10.3f}{line}" for t, line in zip(TIMES, table, strict=True)),
    ]  # fmt: skip
    return Twin(file(lines), "gal", "ABC", directions)


def afad() -> Twin:
    names = {"N-S": 0.0, "E-W": 90.0, "U-D": None}
    table, directions = in_columns(["12.6f", "14.6f", "13.6f"], names)
    stated = {
        "EARTHQUAKE DATE": "2020/01/01 (GMT)", "STATION ID": 1111, "NUMBER OF DATA": SAMPLES,
        "SAMPLING INTERVAL (sec)": DT, "RAW PGA VALUES (gal)": "(N-S) 999 (E-W) 999 (U-D) 999",
    }  # fmt: skip
    head = [f"{label:24s}: {value}" for label, value in stated.items()]
    first, of_columns = "STRONG GROUND MOTION RECORDS OF TURKIYE", "    N-S         E-W         U-D"
    return Twin(file(first, 11 * [""], head, of_columns, table), "gal", "1111", directions)


def unam() -> Twin:
    table, directions = in_columns(["10.3f"] * 3, {"V": None, "N90E": 90.0, "N00E": 0.0})
    stated = {
        "CLAVE DE LA ESTACION": "ABC1", "ORIENTACION C1-C6 (rumbo;orientacion)": "/V/N90E/N00E",
        "INTERVALO DE MUESTREO, C1-C6 (s)": "/0.01/0.01/0.01",
        "FECHA DEL SISMO [GMT]": "2020/01/01", "HORA EPICENTRO (GMT)": "00:00",
        "NUM. TOTAL DE MUESTRAS, C1-C6": "/400/400/400",
        "ACEL. MAX.(Gal), C1-C6": "".join(f"/{peak:.2f}" for peak in peaks(directions)),
        "UNIDADES DE LOS DATOS": "Gal (cm/s/s)",
        "FORMATO DATOS (FORTRAN,10 campos/dato)": "3F10.3",
    }  # fmt: skip
    lines = [
        "*****", "ARCHIVO ESTANDAR DE ACELERACION:",
        *(f"{label:39s}: {value}" for label, value in stated.items()), *90 * [""],
        "DATOS DE ACELERACION:", "---------+", "   CANAL-1   CANAL-2   CANAL-3",
        "         V      N90E      N00E", "---------+", *table,
    ]  # fmt: skip
    return Twin(file(lines), "gal", "ABC1", directions)


def peer() -> Twin:
    own = block(sine(0, GRAVITY), "15.7E", 5)
    head = [
        "PEER NGA STRONG MOTION DATABASE RECORD", "Nowhere, 1/1/2020, Abcd, 045",
        "ACCELERATION TIME HISTORY IN UNITS OF G", f"NPTS=  {SAMPLES}, DT=   .0100 SEC",
    ]  # fmt: skip
    return Twin(file(head, own.lines), "g", "", [Direction("", None, False, GRAVITY * own.values)])


TWINS: dict[str, Callable[[], Twin]] = {
    "dyna": dyna, "renadic": renadic, "bhrc": bhrc, "smc": smc, "usc": usc, "cwb": cwb,
    "afad": afad, "unam": unam, "peer": peer,
    "geonet_v1a": lambda: geonet(is_raw=True), "geonet_v2a": lambda: geonet(is_raw=False),
    "knet": lambda: knet("E-W", "E-W", 90.0), "kik_net": lambda: knet("4", "N-S", 0.0, " surface"),
    "cesmd_v1": lambda: cesmd(is_raw=True), "cesmd_v2": lambda: cesmd(is_raw=False),
    "cosmos_v1": lambda: cosmos(None, 8, "10.5f", "8F10.5"),
    "cosmos_v2c": lambda: cosmos("HN", 1, "15.6E", "1E15.6"),
}  # fmt: skip
"""Writers by their formats."""
