"""LLVM's representation as machine code of this processor, and machine code as functions."""

from __future__ import annotations

import ctypes
import ctypes.util
import struct
import sys
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import llvmlite
import llvmlite.binding as llvm
import numpy as np

from rockeom.numeric.machine_types import BOOL, FLOAT, LIBRARY, NOTHING, Array, Entry


def _machine() -> llvm.TargetMachine:
    """What compiles for this processor; an engine that it is given to owns it, and frees it."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=3,
        reloc="default",
        codemodel="jitdefault",
        jit=True,
    )


@cache
def target() -> str:
    """What machine code depends on besides its program."""
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
"""What is done to a program before it becomes machine code, in this order.

LLVM's own -O2 takes three times as long for code that is no faster. `reassociate` settles the order
of products, and by it which of them is part of a*b + c.
"""


def compiled(ir: str, lanes: bool = False) -> bytes:
    """An object file. lanes : loops are made vector instructions of.

    Straight lines are not: it would change the order of additions.
    """
    machine = _machine()
    module = llvm.parse_assembly(ir)
    module.triple = llvm.get_process_triple()
    module.data_layout = str(machine.target_data)
    options = llvm.create_pipeline_tuning_options(speed_level=2)
    options.loop_vectorization = lanes
    options.slp_vectorization = False
    builder = llvm.create_pass_builder(machine, options)
    if lanes:
        passes = builder.getModulePassManager()
    else:
        passes = llvm.create_new_module_pass_manager()
        for name in PASSES:
            getattr(passes, f"add_{name}_pass")()
    passes.run(module, builder)
    return machine.emit_object(module)


@cache
def _library_is_known() -> bool:
    """Tell LLVM where the functions of mathematics are, on whatever system."""
    name = "ucrtbase" if sys.platform == "win32" else ctypes.util.find_library("m")
    library = ctypes.CDLL(name)
    for function in LIBRARY:
        if hasattr(library, function):
            address = ctypes.cast(getattr(library, function), ctypes.c_void_p).value
            llvm.add_symbol(function, address)
    return True


class Loaded:
    """Machine code in memory, and its functions by name."""

    def __init__(self, code: bytes, entries: Mapping[str, Entry]) -> None:
        _library_is_known()
        self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())
        self._engine.add_object_file(llvm.ObjectFileRef.from_data(code))
        self._engine.finalize_object()
        self.functions: dict[str, Callable[..., Any]] = {
            name: _Function(name, entry, self._engine.get_function_address(name), self)
            for name, entry in entries.items()
        }


_CALLED = ctypes.CFUNCTYPE(None, ctypes.c_void_p)


class _Function:
    """A function of machine code that takes its arguments from a row of 64-bit places."""

    def __init__(self, name: str, entry: Entry, address: int, loaded: Loaded) -> None:
        self.name, self.entry, self.loaded = name, entry, loaded
        self.call = _CALLED(address)
        places = ""
        for _, type_ in entry.arguments:
            count = 1 + type_.dimensions if isinstance(type_, Array) else 1
            places += "d" if type_ == FLOAT else "q" * count
        self.row = struct.Struct(f"={places}{'d' if entry.returns == FLOAT else 'q'}")
        self.result = struct.Struct("=d" if entry.returns == FLOAT else "=q")
        self.at = self.row.size - 8

    def __call__(self, *given: Any) -> Any:
        """Raises TypeError for an array that the machine code would misread."""
        places: list[Any] = []
        for value, (name, type_) in zip(given, self.entry.arguments, strict=True):
            if isinstance(type_, Array):
                wanted = np.float64 if type_.element == FLOAT else np.int64
                if (
                    value.dtype != wanted
                    or value.ndim != type_.dimensions
                    or not value.flags.c_contiguous
                ):
                    raise TypeError(
                        f"{self.name}: {name} is {value.dtype}, {value.ndim} dimensions: an array "
                        f"of {np.dtype(wanted)}, {type_.dimensions} dimensions, in C order is "
                        "wanted"
                    )
                places.append(value.__array_interface__["data"][0])
                places += value.shape
            else:
                places.append(value)
        row = ctypes.create_string_buffer(self.row.size)
        self.row.pack_into(row, 0, *places, 0)
        self.call(row)
        if self.entry.returns == NOTHING:
            return None
        (found,) = self.result.unpack_from(row, self.at)
        return bool(found) if self.entry.returns == BOOL else found
