"""A WebAssembly module in wasmtime, which is called as machine code is."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import wasmtime

from rockeom.browser.program import Portable
from rockeom.compiler.types import BOOL, FLOAT, NOTHING, Array, Entry
from rockeom.integrator.schema import GeneratedModule

STACK = 1 << 20
PAGES = 1024


class ProgramInWasmtime:
    """A program with the functions and tables of `rockeom.integrator.program.Program`."""

    def __init__(self, portable: Portable, generated: GeneratedModule) -> None:
        self.module = generated
        self.name = f"{generated.NAME}_wasmtime"
        self.__dict__ |= portable.sizes
        code, end = portable.webassembly()
        engine = wasmtime.Engine()
        self.store = wasmtime.Store(engine)
        wasm = wasmtime.Module(engine, code)
        self.free = self.start = (end + STACK + 15) & ~15
        limits = wasmtime.Limits(PAGES, None)
        self.memory = wasmtime.Memory(self.store, wasmtime.MemoryType(limits))
        i32 = wasmtime.GlobalType(wasmtime.ValType.i32(), True)
        pointer = wasmtime.Global(self.store, i32, wasmtime.Val.i32(self.start))
        given = {"__linear_memory": self.memory, "__stack_pointer": pointer}
        imports = [given[one.name or ""] for one in wasm.imports]
        exports = wasmtime.Instance(self.store, wasm, imports).exports(self.store)
        self.base = ctypes.addressof(self.memory.data_ptr(self.store).contents)
        for name, entry in portable.entries.items():
            setattr(self, name, Function(self, exports[name], entry))

    def __getattr__(self, name: str) -> Any:
        return getattr(self.__dict__["module"], name)

    def array(self, like: np.ndarray) -> tuple[int, np.ndarray]:
        """Room in the memory for an array: its address and itself."""
        at, self.free = self.free, (self.free + max(like.nbytes, 8) + 15) & ~15
        assert self.free < PAGES << 16
        whole = (ctypes.c_uint8 * max(like.nbytes, 1)).from_address(self.base + at)
        return at, np.frombuffer(whole, like.dtype, like.size).reshape(like.shape)


class Function:
    """A function that takes its arguments from a row of 64-bit places in the memory."""

    def __init__(self, program: ProgramInWasmtime, call: Any, entry: Entry) -> None:
        self.program, self.call, self.entry = program, call, entry

    def __call__(self, *given: Any) -> Any:
        return self.bound(*given)()

    def bound(self, *given: Any) -> Bound:
        return Bound(self, given)


class Bound:
    """A function with its arguments; arrays are copied into the memory, and back."""

    def __init__(self, function: Function, given: tuple[Any, ...]) -> None:
        self.function = function
        self.given = dict(zip((n for n, _ in function.entry.arguments), given, strict=True))

    def __setitem__(self, name: str, value: Any) -> None:
        self.given[name] = value

    def __call__(self) -> Any:
        program, entry = self.function.program, self.function.entry
        program.free = program.start
        row: list[tuple[bool, Any]] = []
        inside: dict[int, tuple[np.ndarray, int, np.ndarray]] = {}
        for name, type_ in entry.arguments:
            value = self.given[name]
            if isinstance(type_, Array):
                if id(value) not in inside:  # one array may be given twice
                    at, copy = program.array(value)
                    copy[...] = value
                    inside[id(value)] = value, at, copy
                row.append((False, inside[id(value)][1]))
                row += [(False, n) for n in value.shape[: type_.dimensions]]
            else:
                row.append((type_ == FLOAT, value))
        address, places = program.array(np.zeros(len(row) + 1, np.int64))
        for i, (is_float, value) in enumerate(row):
            (places.view(np.float64) if is_float else places)[i] = value
        self.function.call(program.store, address)
        for value, _, copy in inside.values():
            if value.flags.writeable:
                value[...] = copy
        if entry.returns == NOTHING:
            return None
        found = places.view(np.float64)[-1] if entry.returns == FLOAT else int(places[-1])
        return bool(found) if entry.returns == BOOL else found
