"""The program of a page has the bits of machine code, whatever runs it."""

import importlib

import pytest

import rockeom as rk
from rockeom.browser.program import portable
from rockeom.browser.webassembly import module
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain

wasmtime = pytest.importorskip("wasmtime", reason="WebAssembly is run by wasmtime")
simulation = importlib.import_module("rockeom.simulation.simulate")

METHODS = ("DOP853", "RK45", "Radau")
RUNS = [
    *(("rigid_block", method) for method in METHODS),
    ("flexible_structure", "DOP853"),
    ("two_spring_structure", "Radau"),
    ("dirac_delta_block", "RK45"),
    ("controlled_wall_oscillator", "DOP853"),
    ("sliding_block", "RK45"),
]
"""`python -m tests.browser` runs each structure by each method."""


def motion_of(structure, method: str, program, monkeypatch) -> rk.Response:
    """A motion under a record by a program that is no other's."""
    monkeypatch.setattr(simulation, "program", lambda *_: program)
    turning = structure.states[structure.module.ROTATION]
    record = rk.GroundMotion.from_library("El Centro 1940 180").scaled(2.0)
    options = rk.SolverOptions(method=method)
    start = {turning: 0.2 * min(structure.overturning_rotation, 0.3)}
    return rk.simulate(structure, record, initial=start, duration=4.0, options=options)


def same_bits(name: str, method: str, monkeypatch) -> bool:
    """Whether a motion in WebAssembly is that of machine code, to the last bit."""
    from .in_wasmtime import ProgramInWasmtime

    structure = SHIPPED[name](**plain(name))
    program = portable(structure.module, method)
    native = motion_of(structure, method, program.native(structure.module), monkeypatch)
    wasm = motion_of(structure, method, ProgramInWasmtime(program, structure.module), monkeypatch)
    assert len(native.record) > 10
    return (
        native.outcome == wasm.outcome
        and bits(native.record) == bits(wasm.record)
        and bits(native.events.columns) == bits(wasm.events.columns)
    )


def bits(arrays) -> list[bytes]:
    return [getattr(arrays, name).tobytes() for name in arrays.__annotations__]


@pytest.mark.parametrize(("name", "method"), RUNS)
def test_motion_in_webassembly_has_the_bits_of_machine_code(name, method, monkeypatch):
    assert same_bits(name, method, monkeypatch)


def test_a_function_that_no_browser_has_is_refused():
    sine = "define double @f(double %x) {\n %y = call double @sin(double %x)\n ret double %y\n}\n"
    ir = "declare double @sin(double)\n" + sine
    with pytest.raises(ValueError, match="calls sin, which a browser does not have"):
        module(ir, ["f"])
