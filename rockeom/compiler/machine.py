"""LLVM's representation as machine code of this processor, and machine code as functions."""

from __future__ import annotations

import ctypes
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import llvmlite
import llvmlite.binding as llvm
import numpy as np

from rockeom.compiler.types import (
    BOOL,
    DUAL,
    FLOAT,
    INT,
    LIBRARY,
    NOTHING,
    WIDTH,
    Array,
    Entry,
)

LINKED = sys.platform != "win32"
"""Whether a program and its constants lie side by side, as LLVM's own linker puts them.

Code then finds a constant by its distance, in half the instructions. That
linker does not know all of Windows' objects.
"""


def _machine(level: int = 2) -> llvm.TargetMachine:
    """The compiler for this processor; a linker that receives it owns it, and frees it.

    level : of LLVM's code generator, up to 3; above 1 it takes longer for a loop that is no faster.
    """
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=level,
        reloc="pic" if LINKED else "default",
        codemodel="small" if LINKED else "jitdefault",
        jit=True,
    )


@cache
def target() -> str:
    """All that machine code depends on besides its program."""
    return " ".join(
        (
            llvmlite.__version__,
            llvm.get_process_triple(),
            llvm.get_host_cpu_name(),
            llvm.get_host_cpu_features().flatten(),
        )
    )


PASSES = (
    "sroa", "simplify_cfg", "always_inliner", "global_dead_code_eliminate",
    "sroa", "simplify_cfg", "instruction_combine", "reassociate", "simplify_cfg",
    "loop_rotate", "loop_unroll", "sroa", "new_gvn",
    "ipsccp", "dead_arg_elimination", "instruction_combine", "dead_store_elimination",
    "simplify_cfg",
)  # fmt: skip
"""The passes over a program before it becomes machine code, in this order.

LLVM's own -O2 takes three times as long for code that is no faster. `reassociate` settles the order
of products, and by it which of them is part of a*b + c.
"""


def compiled(ir: str, lanes: bool = False, passes: Sequence[str] = PASSES) -> bytes:
    """An object file. lanes : loops become vector instructions.

    Straight lines do not: it would change the order of additions. passes : none for a program that
    runs a few times; without contractions it has the same bits.
    """
    machine = _machine(3 if lanes else 1 if passes else 0)
    return emitted(ir, machine, llvm.get_process_triple(), passes, lanes)


def emitted(
    ir: str, machine: llvm.TargetMachine, triple: str, passes: Sequence[str], lanes: bool = False
) -> bytes:
    """An object file for a machine, see `compiled`."""
    module = llvm.parse_assembly(ir)
    module.triple, module.data_layout = triple, str(machine.target_data)
    options = llvm.create_pipeline_tuning_options(speed_level=2)
    options.loop_vectorization = lanes
    options.slp_vectorization = False
    builder = llvm.create_pass_builder(machine, options)
    if lanes:
        manager = builder.getModulePassManager()
    else:
        manager = llvm.create_new_module_pass_manager()
        for name in passes:
            getattr(manager, f"add_{name}_pass")()
    manager.run(module, builder)
    return machine.emit_object(module)


@cache
def _library() -> dict[str, int]:
    """Where the functions of mathematics are, on whatever system."""
    # None: what this process has loaded, and Python needs the library of mathematics itself
    library = ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None)
    functions = {f: getattr(library, f) for f in LIBRARY if hasattr(library, f)}
    return {f: ctypes.cast(at, ctypes.c_void_p).value or 0 for f, at in functions.items()}


class OutOfBoundsError(IndexError):
    """An index that left its array, in a program that is compiled with checks of them."""


class _Reports(threading.local):
    """The first index that left its array in the call that this thread makes, as a sentence."""

    first: str | None = None


_REPORTS = _Reports()


@ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_int64, ctypes.c_char_p, ctypes.c_int64)
def _out_of_bounds(index: int, size: int, text: bytes, line: int) -> None:
    """Called by machine code."""
    if _REPORTS.first is None:
        where = f"{text.decode()}, line {line}"
        _REPORTS.first = f"{where}: index {index} is out of bounds for an axis of size {size}"


def _raising(call: Callable[[int], None]) -> Callable[[int], None]:
    """The same call, which raises OutOfBoundsError at its end for an index that left its array."""

    def checked(row: int) -> None:
        _REPORTS.first = None
        call(row)
        if _REPORTS.first is not None:
            raise OutOfBoundsError(_REPORTS.first)

    return checked


class Loaded:
    """Machine code in memory, and its functions by name.

    others : further programs, whose entries it calls or which call its own. bounds : they were
    printed with checks of indices.
    """

    def __init__(
        self, code: bytes, entries: Mapping[str, Entry], *others: bytes, bounds: bool = False
    ) -> None:
        linker = llvm.create_lljit_compiler(_machine(), use_jit_link=LINKED)
        builder = llvm.JITLibraryBuilder().add_current_process()
        for part in (code, *others):
            builder.add_object_img(part)
        for name, address in _library().items():
            builder.import_symbol(name, address)
        if bounds:
            report = ctypes.cast(_out_of_bounds, ctypes.c_void_p).value
            builder.import_symbol("out_of_bounds", report)
        for name in entries:
            builder.export_symbol(name)
        self._linked = builder.link(linker, "program")
        self.functions: dict[str, Function] = {
            name: Function(name, entry, self._linked[name], self) for name, entry in entries.items()
        }
        if bounds:
            for function in self.functions.values():
                function.call = _raising(function.call)


_CALLED = ctypes.CFUNCTYPE(None, ctypes.c_void_p)


class Function:
    """A function of machine code that takes its arguments from a row of 64-bit places.

    Python's part of a call is in writing that row: whoever calls often binds the arguments once.
    """

    def __init__(self, name: str, entry: Entry, address: int, loaded: Loaded) -> None:
        self.name, self.entry, self.loaded = name, entry, loaded
        self.call: Callable[[int], None] = _CALLED(address)
        self.places: dict[str, tuple[int, Any]] = {}
        n = 0
        for argument, type_ in entry.arguments:
            self.places[argument] = n, type_
            n += 1 + type_.dimensions if isinstance(type_, Array) else 1
        self.integers, self.floats = ctypes.c_int64 * (n + 1), ctypes.c_double * (n + 1)
        self.convert = _CONVERTED.get(entry.returns)

    def __call__(self, *arguments: Any) -> Any:
        """Raises TypeError for an array that the machine code would misread."""
        return self.bound(*arguments)()

    def bound(self, *arguments: Any) -> Bound:
        """The function with its arguments, to be called again and again; raises as a call does."""
        bound = Bound(self)
        for name, value in zip(self.places, arguments, strict=True):
            bound[name] = value
        return bound


class Bound:
    """A function of machine code with its arguments, which it keeps; of one thread at a time.

    `bound[name] = value` gives an argument a new value; changes within a bound array need nothing.
    """

    def __init__(self, function: Function) -> None:
        self.function = function
        self.arrays: dict[str, np.ndarray] = {}
        self._integers = function.integers()
        self._floats = function.floats.from_buffer(self._integers)
        self._row, self._call = ctypes.addressof(self._integers), function.call
        self._results: Any = self._floats if function.entry.returns == FLOAT else self._integers

    def __setitem__(self, name: str, value: Any) -> None:
        """Raises TypeError for an array that the machine code would misread."""
        place, type_ = self.function.places[name]
        if not isinstance(type_, Array):
            row = self._floats if type_ == FLOAT else self._integers
            row[place] = value
        elif value is not self.arrays.get(name):
            wanted, behind = _ELEMENTS[type_.element]
            dimensions = type_.dimensions + len(behind)
            if (
                value.dtype != wanted
                or value.ndim != dimensions
                or value.shape[type_.dimensions :] != behind
                or not value.flags.c_contiguous
            ):
                raise TypeError(
                    f"{self.function.name}: {name} is {value.dtype}, {value.ndim} dimensions: an "
                    f"array of {wanted}, {dimensions} dimensions, in C order is wanted"
                )
            self._integers[place] = _address(value)
            for i, length in enumerate(value.shape[: type_.dimensions], place + 1):
                self._integers[i] = length
            self.arrays[name] = value

    def __call__(self) -> Any:
        self._call(self._row)
        result, convert = self._results[-1], self.function.convert
        return convert(result) if convert else result


def _address(array: np.ndarray) -> int:
    """Where the numbers of an array begin."""
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(array.data))  # in a fifth of the time
    except (TypeError, ValueError):  # it may not be written to, or is empty
        return array.__array_interface__["data"][0]


_ELEMENTS: dict[str, tuple[np.dtype, tuple[int, ...]]] = {
    FLOAT: (np.dtype(np.float64), ()),
    INT: (np.dtype(np.int64), ()),
    DUAL: (np.dtype(np.float64), (1 + WIDTH,)),
}
"""NumPy's type of each element of an array, and the dimension behind the others."""


def _nothing(_: Any) -> None:
    """The result of a function that returns nothing."""


_CONVERTED: dict[Any, Callable[[Any], Any]] = {BOOL: bool, NOTHING: _nothing}
