"""Components of a recording: which are vertical, and which belong together, by the conventions of
databases (PEER, COSMOS, ESM, K-NET, AFAD) and of SEED.

The header decides, and the name of the file where the header says nothing. An ambiguous name counts
as horizontal.
"""

import re
from collections.abc import Iterable

from rockeom.files import in_text
from rockeom.motion.scaling import SCALE_IN_NAME
from rockeom.numbers.checks import FilePath

_CHANNEL = r"[bcdefhlms][hnlg]"
"""Band and instrument of a SEED channel code, such as HNZ; its third letter is the orientation."""

_LOCATION = r"(?:\d\d|--)"
"""The location code of SEED, in front of the channel code or behind it."""

_DOWN = r"up|ud|u-d|dwn|down|dn|ver|vrt|vert|vertical"
_VERTICAL = re.compile(
    rf"(?:{_DOWN}|(?-i:U)|v|z|{_CHANNEL}z)(?:\W*(?:and|&)?\W*down)?", re.IGNORECASE
)
"""A vertical component: a direction or a SEED code. A small u is a displacement as often."""

_HORIZONTAL = re.compile(
    r"\d{1,3}(?:\W*deg\w*)?|[ns]\W?\d{1,2}\W?[ew]|[news]|ns|ew|n-s|e-w|north|east|south|west|"
    rf"[lthxy]\d?|ln|lng|long\w*|tr|trn|tran\w*|hor\w*|fn|fp|{_CHANNEL}[xyne12]",
    re.IGNORECASE,
)
"""A horizontal component: an azimuth in degrees, a direction, a SEED code."""

_LABEL = re.compile(
    r"\b(?:stream|chan(?:nel)?|comp(?:onent)?|dir(?:ection)?|orientation)\b[.:= ]*(?:\d+ *: *)?"
    r"([a-z0-9][^,;|:=]*)",
    re.IGNORECASE,
)
"""The component in a line of a header: "STREAM: HNZ", "Dir.  U-D", "Chan  2:  Up"."""

_NO_COMPONENT = re.compile(
    r"acc\w*|asc|at2|cor(?:r\w*)?|csv|dat|filt\w*|g|gal|raw|scaled|txt|unscaled|"
    r"[cm]?m(?:ps2|/s.*)?|s(?:ec)?\^?2|\d{8,}\w*|",
    re.IGNORECASE,
)
"""Words behind the component in the name of a file or column: kinds, units, a date, none at all."""

_END = r"(?![^\W_])"  # of a word
_CODE = rf"{_CHANNEL}[xyzne12]"
_STATION_CODE = re.compile(rf"((?:[^.]*\.){{2,}}[^.]*)\.({_CODE}){_END}(.*)", re.IGNORECASE)
"""Network, station, location and SEED code: IT.AQV.00.HNZ, perhaps with a date behind it."""

_OPPOSITES = re.compile(rf"(?<![^\W_])(u(?=-d)|n(?=-s)|e(?=-w))-([dsw]){_END}", re.IGNORECASE)
"""Two directions that are one word: U-D."""

_NAMED_BY_ENDING = re.compile(rf"\.(?:(?:ns|ew|ud)[12]?|{_CODE})", re.IGNORECASE)
_KIK_NET = re.compile(r"(ns|ew|ud)([12])", re.IGNORECASE)  # 1 in the borehole, 2 at the surface
_AZIMUTH = r"(?!.*(?:19|20)\d\d$)(.*\D\d{0,3})([0-3]\d\d)"  # of a word that ends in no year
_GLUED = re.compile(rf"{_AZIMUTH}|(.{{2,}})(dwn)", re.IGNORECASE)
_GLUED_OF_PEER = re.compile(
    rf"{_AZIMUTH}|(.{{2,}}?)({_CHANNEL}[zne12]|{_DOWN}|[ns]\d\d[ew]|ns|ew|[lt])", re.IGNORECASE
)
"""A station and its component without a mark between them: ELC180, PULDWN, HECVER, SAOHLZ."""

_PEER = re.compile(r"(?:RSN_?\d+|NGA_?(?:no_)?\d+)[^_]*(?:_(?=[^_]*_)[^_]+)?", re.IGNORECASE)
"""The number of a record of PEER, which its three components share, and its earthquake."""

_SEED = re.compile(r"\bseed \d+$", re.IGNORECASE)
"""End of the name of a synthetic motion: its number is no azimuth."""

_SET = re.compile(r"(.+)_fema_p695_(.+)")
_VERB = re.compile(r"scaled?|ramp(?:ed)?|warm|run|start|step|speed|slow|cool", re.IGNORECASE)
"""Words with which "up" and "down" are no direction of the ground."""


def is_vertical(file_name: str, title: str = "", header: Iterable[str] = ()) -> bool:
    """Whether a record is the vertical component of its recording.

    file_name : as of `name_of`. title : of a PEER record; its last field is the component.
    header : other lines, of which one may name the component.
    """
    stated = [_last_field(title)[1], *map(_labelled, header), split(file_name)[1]]
    return bool(next((d for text in stated if (d := _direction(text)) is not None), False))


def split(name: str) -> tuple[str, str]:
    """The recording of a record, which its components have in common, and the component.

    The component is empty where the name has none that is known. A location code of SEED, of one of
    several instruments at a station, belongs to the recording.

    >>> split("RSN6_IMPVALL.I_I-ELC180"), split("RSN6_IMPVALL.I_I-ELC-UP")
    (('RSN6_IMPVALL.I', '180'), ('RSN6_IMPVALL.I', 'UP'))
    """
    if scale := SCALE_IN_NAME.search(name):  # whose T1 is no transverse component
        recording, component = split(name[: scale.start()])
        return recording + scale[0], component
    if _SEED.search(name):
        return name, ""
    if of_peer := _PEER.match(name):
        rest, component = _split_words(name, of_peer=True)
        location = re.search(rf"\.{_LOCATION}$", rest)
        return of_peer[0] + (location[0] if location else ""), component
    if in_set := _SET.fullmatch(name):
        recording, component = _split_words(in_set[1])
        return f"{recording}, FEMA P695 {in_set[2].replace('_', ' ')}", component
    before, component = _last_field(name)
    if _direction(component) is not None:
        return before, component
    before, comma, last = name.rpartition(",")
    recording, component = _split_words(last.strip())
    return (f"{before}, {recording}" if comma else recording), component


def name_of(path: FilePath) -> str:
    """The name of a file without its ending, but with one that names a component: .UD2, .HNZ."""
    path = in_text(path)
    return path.name if _NAMED_BY_ENDING.fullmatch(path.suffix) else path.stem


def channel(component: str) -> str:
    """Band and instrument of a component that is a SEED code; else an empty text."""
    return component[:2].upper() if re.fullmatch(_CODE, component, re.IGNORECASE) else ""


def _last_field(title: str) -> tuple[str, str]:
    """A title in front of its last comma, and the field behind it without what is in brackets.

    A location code behind a SEED code, as in BH100, goes with the title.
    """
    before, comma, last = re.sub(r"\s*\([^()]*\)\s*$", "", title).rpartition(",")
    before, last = before.strip(), last.strip() if comma else ""
    located = re.fullmatch(_LOCATION, last[3:]) and channel(last[:3])
    return (f"{before}, {last[3:]}", last[:3]) if located else (before, last)


def _labelled(line: str) -> str:
    """The component that a line of a header names, or an empty text."""
    if not (found := _LABEL.search(line)):
        return ""
    text = found[1].strip()
    return text if _direction(text) is not None else text.split()[0]


def _direction(component: str) -> bool | None:
    """Whether a component is vertical; None for a text that is no component."""
    if _VERTICAL.fullmatch(component):
        return True
    return False if _HORIZONTAL.fullmatch(component) else None


def _split_words(name: str, of_peer: bool = False) -> tuple[str, str]:
    """See `split`; of a name in which marks separate the component."""
    if found := _STATION_CODE.fullmatch(name):
        return f"{found[1]}{found[3]}", found[2]
    parts = re.split(r"([-_. ]+)", _OPPOSITES.sub(r"\1\2", name))
    words = range(0, len(parts), 2)
    last = next((n for n in reversed(words) if not _NO_COMPONENT.fullmatch(parts[n])), 0)
    if last and re.fullmatch(_LOCATION, parts[last]) and channel(parts[last - 2]):
        last -= 2  # as in BHZ.00
    word, before = parts[last], parts[max(last - 2, 0)]

    def without(n: int, rest: str = "") -> str:
        end = n if rest else max(n - 1, 0)  # the mark before an empty word goes with it
        return "".join([*parts[:end], rest, *parts[n + 1 :]]).strip("-_. ")

    if found := _KIK_NET.fullmatch(word):
        return without(last, found[2]), found[1]
    is_number = word.isdigit() and len(word) < 3  # of a record; an azimuth has three digits
    if not is_number and not (word.lower() in ("up", "down") and _VERB.fullmatch(before)):
        if _direction(word) is not None:
            return without(last), word
        if of_peer and re.fullmatch(r"v\d", word, re.IGNORECASE):
            return without(last), word[0]
    if found := (_GLUED_OF_PEER if of_peer else _GLUED).fullmatch(word):
        rest, component = (part for part in found.groups() if part is not None)
        return without(last, rest), component
    for n in words:
        if parts[n].lower() in ("vertical", "vert") and parts[n + 2 : n + 3] != ["array"]:
            return without(n), parts[n]
    return name, ""


_UP_OR_DOWN = re.compile(r"(?:up|down|dwn|dn|u-?d|u|v|z|vert(?:ical)?|ver)\d*", re.IGNORECASE)
_BEARING = re.compile(r"([NS])\s*(\d{1,2})\s*([EW])", re.IGNORECASE)
_OF_DEGREES = re.compile(r"(\d{1,3})\s*(?:deg\w*|°)?", re.IGNORECASE)
_CARDINAL = {
    "n": 0.0,
    "n-s": 0.0,
    "ns": 0.0,
    "s": 180.0,
    "e": 90.0,
    "e-w": 90.0,
    "ew": 90.0,
    "w": 270.0,
}


def azimuth_and_vertical(name: str) -> tuple[float | None, bool]:
    """Azimuth [degrees] of a direction, if it has one, and whether it is vertical."""
    word = name.strip()
    if _UP_OR_DOWN.fullmatch(word):
        return None, True
    if bearing := _BEARING.fullmatch(word):
        north, angle, east = bearing[1].upper() == "N", float(bearing[2]), bearing[3].upper() == "E"
        return (
            angle if east else -angle
        ) % 360 if north else 180 - angle if east else 180 + angle, False
    if (degrees := _OF_DEGREES.fullmatch(word)) and int(degrees[1]) <= 360:
        return float(degrees[1]) % 360, False
    return _CARDINAL.get(word.lower()), False
