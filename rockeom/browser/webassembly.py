"""LLVM's representation as a WebAssembly module, without a linker.

An object file of one translation unit is a module already: it imports its memory, its stack pointer
and the functions of others, and its data lie from address 0 on. It lacks exports; the index of each
function is in its custom section "linking", which a module does not need.
"""

from collections.abc import Collection, Iterator
from typing import NamedTuple

import llvmlite.binding as llvm

from rockeom.compiler.machine import PASSES, emitted

TRIPLE = "wasm32-unknown-unknown"
FEATURES = "+bulk-memory,+sign-ext,+nontrapping-fptoint"
"""Features of WebAssembly 2.0: copies of memory, and conversions that do not trap."""

_MAGIC = b"\0asm\1\0\0\0"
_CUSTOM, _IMPORT, _EXPORT, _DATA = 0, 2, 7, 11
_ORDER = (1, 2, 3, 4, 5, 13, 6, 7, 8, 9, 12, 10, 11)
"""Sections of a module by their numbers, in the order in which they have to be."""
_FUNCTIONS, _SYMBOL_TABLE = 0, 8
_UNDEFINED, _NAMED = 0x10, 0x40


class Module(NamedTuple):
    """A WebAssembly module. code : its bytes. data_end : the first address behind its data."""

    code: bytes
    data_end: int


def module(ir: str, exported: Collection[str]) -> Module:
    """The module of a program of LLVM, with the functions that it exports.

    Raises ValueError if it asks for functions that nobody has.
    """
    code = _object(ir)
    sections = list(_sections(code))
    linking = next(b for k, b in sections if k == _CUSTOM and _Reader(b).text() == "linking")
    missing = [name for kind, body in sections if kind == _IMPORT for name in _imports(body)]
    if missing:
        raise ValueError(f"the program calls {', '.join(missing)}, which a browser does not have")
    places = dict(_defined(linking))
    entries = [_text(name) + b"\0" + _number(places[name]) for name in exported]
    kept = {kind: body for kind, body in sections if kind != _CUSTOM}
    kept[_EXPORT] = _number(len(entries)) + b"".join(entries)
    parts = [bytes([k]) + _number(len(kept[k])) + kept[k] for k in _ORDER if k in kept]
    return Module(_MAGIC + b"".join(parts), _data_end(kept.get(_DATA, b"\0")))


def _object(ir: str) -> bytes:
    """An object file of WebAssembly, by the passes of native programs."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(
        cpu="generic", features=FEATURES, opt=2, reloc="static"
    )
    return emitted(ir, machine, TRIPLE, PASSES)


# --- the format


def _number(n: int) -> bytes:
    """A whole number in LEB128."""
    coded = bytearray()
    while True:
        n, low = n >> 7, n & 127
        coded.append(low | (128 if n else 0))
        if not n:
            return bytes(coded)


def _text(text: str) -> bytes:
    return _number(len(text.encode())) + text.encode()


class _Reader:
    """Reads numbers and texts, one behind the other."""

    def __init__(self, data: bytes, at: int = 0) -> None:
        self.data, self.at = data, at

    def bytes(self, n: int) -> bytes:
        self.at += n
        return self.data[self.at - n : self.at]

    def number(self) -> int:
        value = shift = 0
        while True:
            (byte,) = self.bytes(1)
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def text(self) -> str:
        return self.bytes(self.number()).decode()


def _sections(code: bytes) -> Iterator[tuple[int, bytes]]:
    """Number and content of each section."""
    reader = _Reader(code, len(_MAGIC))
    while reader.at < len(code):
        (kind,) = reader.bytes(1)
        yield kind, reader.bytes(reader.number())


def _imports(body: bytes) -> Iterator[str]:
    """Names of functions that a module imports."""
    reader = _Reader(body)
    for _ in range(reader.number()):
        reader.text()
        name, (kind,) = reader.text(), reader.bytes(1)
        if kind == _FUNCTIONS:
            reader.number()
            yield name
        elif kind == 3:  # a global, its type and whether it changes
            reader.bytes(2)
        else:  # a table, with its type first, or a memory: flags and limits
            reader.bytes(1 if kind == 1 else 0)
            flags = reader.number()
            for _ in range(1 + (flags & 1)):
                reader.number()


def _defined(linking: bytes) -> Iterator[tuple[str, int]]:
    """Names and indices of the functions that a module defines."""
    reader = _Reader(linking)
    reader.text()
    reader.number()  # of the version
    while reader.at < len(linking):
        kind, size = reader.bytes(1)[0], reader.number()
        if kind != _SYMBOL_TABLE:
            reader.bytes(size)
            continue
        for _ in range(reader.number()):
            (of,), flags = reader.bytes(1), reader.number()
            undefined = bool(flags & _UNDEFINED)
            if of == 1:  # data: a name, and where it lies
                reader.text()
                for _ in range(0 if undefined else 3):
                    reader.number()
            elif of == 3:  # a section
                reader.number()
            else:
                index = reader.number()
                name = reader.text() if not undefined or flags & _NAMED else ""
                if of == _FUNCTIONS and not undefined:
                    yield name, index


def _data_end(body: bytes) -> int:
    """The first address behind all data, which lie at constant addresses."""
    reader, end = _Reader(body), 0
    for _ in range(reader.number()):
        reader.bytes(2)  # active, and i32.const
        start = reader.number()
        reader.bytes(1)
        size = reader.number()
        reader.bytes(size)
        end = max(end, start + size)
    return end
