"""Exports to C and MATLAB beside the generated functions, at random states of every structure.

All files of C are compiled by one call of the compiler, and all of MATLAB run in one process of
Octave; what a machine lacks of the two is skipped, and said so.
"""

import ctypes
import re
import shutil
import subprocess
import zlib
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.codes import LANDING
from rockeom.exports import LANGUAGES, code
from rockeom.exports.code import FILLED, file_name
from rockeom.modelling.declared import class_of_model
from rockeom.structures.classes import SHIPPED
from rockeom.symbolic.model import Body, coordinate, parameter, turned
from rockeom.symbolic.rocking import rocking_structure
from tests.shipped import plain

TOLERANCE = 1e-12
FLAGS = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O0", "-shared", "-fPIC")


def strange():
    """A block whose names mean something in C, in MATLAB, or in what is written of it."""
    rotation = coordinate("phi", "int", "rad", "rotation */ \\ %{ ??/")
    mass = parameter("m", "end", "kg", "mass'; quit /* and\n#error more")
    width = parameter("b", "sin", "m", "half of the width")
    height = parameter("h", "höhe_" + "h" * 70, "m", "height of the centroid")
    inertia = parameter("I", "pair_1_", "kg m2", "moment of inertia")
    gravity = parameter("g", "NAN", "m/s2", "gravity")
    theta = rotation.position

    def bodies(pivot):
        place = turned((0, height.symbol), pivot, theta)
        return [Body("block", mass.symbol, place, inertia.symbol, theta)]

    return rocking_structure(
        name="while", title="Strange names */", coordinates=(rotation,),
        parameters=(mass, width, height, inertia, gravity),
        bodies=bodies, half_width=width.symbol, gravity=gravity.symbol,
    )  # fmt: skip


ON_SPRINGS = rk.LumpedMassStructure(
    mass=3.0, height=1.0, inertia=0.5, base_mass=1.0, base_height=0.1, base_inertia=0.1,
    half_width=0.3, support=rk.TwoSprings(stiffness=1e3, damping=10.0),
)  # fmt: skip
STRAPPED = rk.LumpedMassStructure(
    mass=3.0, height=1.0, inertia=0.5, base_mass=1.0, base_height=0.1, base_inertia=0.1,
    half_width=0.3, support=rk.Sliding(friction=0.4, restitution=0.1),
    restraint=rk.Strap(
        at=(0.2, 1.5), to=(0.7, 1.4), stiffness=1e3, strength=50.0, breaks_at=rk.Break(energy=2.0)
    ),
)  # fmt: skip
COMPOSED = {"on springs": ON_SPRINGS, "strapped": STRAPPED}
NAMES = (*SHIPPED, *COMPOSED, "while")


@cache
def module(name):
    if name == "while":
        return class_of_model(strange()).module
    return structure(name).module


def structure(name):
    return COMPOSED[name] if name in COMPOSED else SHIPPED[name](**plain(name))


@cache
def texts(name):
    return {language: code(module(name), language) for language in LANGUAGES}


def text(name, language):
    return texts(name)[language]


def parameters(name):
    if name == "while":
        return np.array([3.0, 0.2, 0.7, 1.3, 9.81])
    given = structure(name).parameters()
    return np.array([given[n] for n in module(name).PARAMETERS])


def functions_of(name):
    """(name, names of arguments, what is returned) of all that a user calls, as C declares them."""
    found = []
    m = module(name)
    for line in re.findall(r"^(?:void|int|double) \w+\([^{]*\{$", text(name, "c"), re.M):
        returns, called, given = re.fullmatch(r"(\w+) (\w+)\(([^{]*)\) \{", line, re.S).groups()
        arguments = [a.split()[-1].lstrip("*") for a in given.split(",")]
        found.append((called.removeprefix(f"{called_in_c(m)}_"), arguments, returns))
    return found


def called_in_c(m):
    return m.NAME


class Call:
    """A function with arguments, and what the generated module makes of them."""

    def __init__(self, name, function, arguments, given):
        self.name, self.function, self.arguments, self.given = name, function, arguments, given
        m = module(name)
        self.filled = [a for a in arguments if a in FILLED]
        outs = {a: np.zeros(size(m, function, a)) for a in self.filled}
        returned = getattr(m, function)(*(outs.get(a, given.get(a)) for a in arguments))
        self.value = returned
        self.expected = [] if returned is None else [float(returned)]
        for a in self.filled:
            self.expected += outs[a].tolist()


def size(m, function, argument):
    known = {
        "dy": m.N_STATES,
        "g": m.N_GUARDS + m.N_PARTS,
        "matrix": (m.N_STATES // 2) ** 2,
        "forces": m.N_STATES // 2,
    }
    return known.get(argument, 200)


@cache
def calls(name):
    """Two random states in each of some modes, and all that may be asked of them."""
    m = module(name)
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    p = m.prepare(parameters(name))
    found = []
    modes = range(len(m.MODES))
    if len(modes) > 8:
        modes = sorted(rng.choice(modes, 8, replace=False).tolist())
    for mode in [*modes, *modes]:
        y = rng.uniform(-0.6, 0.6, m.N_STATES)
        if m.SIDES[mode] != 0.0:
            y[m.ROTATION] = m.SIDES[mode] * abs(y[m.ROTATION])
        ground = dict(zip(("ax", "ay", "load"), rng.uniform(-5, 5, 3).tolist(), strict=True))
        given = ground | {"mode": mode, "y": y, "p": p}
        for function, arguments, _ in functions_of(name):
            if function in ("prepare", "impact"):
                continue
            if "mode" not in arguments and mode != modes[0]:
                continue
            for more in choices(m, mode, arguments):
                found.append(Call(name, function, arguments, given | more))
    return found


def choices(m, mode, arguments):
    if "guard" in arguments:
        for guard in range(m.GUARDS[mode]):
            for law in range(1 + m.HAS_IMPULSIVE):
                yield {"guard": guard, "law": law, "ratio": 0.8}
    elif "number" in arguments:
        yield from ({"number": i} for i in range(m.N_FALLS))
    else:
        yield {}


def compare(call, found):
    """Relative to the largest number that a function gives; the rest of `out` is left as it was."""
    expected = np.array(call.expected)
    found = np.array(found)[: len(expected)]
    np.testing.assert_array_equal(np.isfinite(found), np.isfinite(expected))
    error = np.abs(found - expected)[np.isfinite(expected)].max(initial=0.0)
    largest = np.abs(expected)[np.isfinite(expected)].max(initial=0.0)
    assert error <= TOLERANCE * max(largest, 1e-300), (call.name, call.function, call.given)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        pytest.skip("there is no C compiler, gcc or cc")
    folder = tmp_path_factory.mktemp("c")
    files = []
    for i, name in enumerate(NAMES):
        files.append(folder / f"{i}.c")
        files[-1].write_text(text(name, "c"), encoding="utf-8")
    built = folder / "all.so"
    done = subprocess.run(
        [compiler, *FLAGS, "-o", built, *files, "-lm"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr[:3000]
    return ctypes.CDLL(str(built))


def call_c(library, name, function, arguments, returns, given, outs):
    target = getattr(library, f"{called_in_c(module(name))}_{function}")
    target.restype = {"void": None, "int": ctypes.c_int, "double": ctypes.c_double}[returns]
    values = []
    for a in arguments:
        value = outs.get(a, given.get(a))
        if isinstance(value, np.ndarray):
            values.append(value.ctypes.data_as(ctypes.c_void_p))
        elif a in ("mode", "guard", "law", "number"):
            values.append(ctypes.c_int(value))
        else:
            values.append(ctypes.c_double(value))
    return target(*values)


@pytest.mark.parametrize("name", NAMES)
def test_c_gives_the_numbers_of_the_generated_module(name, library):
    returned = {function: returns for function, _, returns in functions_of(name)}
    assert {"prepare", "rates", "guards", "energies"} <= set(returned)
    p = module(name).prepare(parameters(name))
    result = np.zeros(len(p))
    given = {"parameters": parameters(name)}
    call_c(library, name, "prepare", ["parameters", "result"], "void", given, {"result": result})
    np.testing.assert_allclose(result, p, rtol=TOLERANCE)
    for call in calls(name):
        outs = {a: np.zeros(size(module(name), call.function, a)) for a in call.filled}
        arguments = call.arguments
        value = call_c(
            library, name, call.function, arguments, returned[call.function], call.given, outs
        )
        found = [] if value is None else [float(value)]
        for a in call.filled:
            found += outs[a].tolist()
        compare(call, found)


@cache
def landings():
    """Of a block that slides and bounces: (mode, guard, before, after, mode after)."""
    block = rk.SlidingBlock(half_width=0.2, half_height=0.5, friction=0.3, restitution=0.4)
    run = rk.simulate(block, rk.GroundMotion.none(1.2), initial={"theta": 0.1, "x_dot": 0.3})
    found = []
    _, kinds, states = run.events.columns
    for (kind, old, new, guard), (before, after) in zip(kinds.tolist(), states, strict=True):
        if kind == LANDING:
            found.append((old, guard, before, after, new))
    assert len(found) > 4
    return block, found


def test_c_finds_what_follows_the_landings_of_a_simulated_block(library):
    block, found = landings()
    p = block.vector
    for mode, guard, before, after, follows in found:
        out = np.zeros(len(before))
        given = {"mode": mode, "guard": guard, "y": before, "p": p, "ax": 0.0, "ay": 0.0}
        arguments = ["mode", "guard", "y", "p", "ax", "ay", "out"]
        value = call_c(library, "sliding_block", "impact", arguments, "int", given, {"out": out})
        assert value == follows
        np.testing.assert_allclose(out, after, rtol=0, atol=1e-12 * np.abs(before).max())


def literal(value):
    if isinstance(value, np.ndarray):
        return f"[{'; '.join(map(repr, value.tolist()))}]"
    return repr(value)


def test_matlab_is_told_no_truth_of_python():
    for name in NAMES:
        assert not re.findall(r"\b(?:True|False|None)\b", text(name, "matlab")), name


@pytest.fixture(scope="module")
def octave(tmp_path_factory):
    """What each call of each structure gives, by name: all in one process."""
    program = shutil.which("octave-cli") or shutil.which("octave")
    if program is None:
        pytest.skip("there is no Octave, octave-cli or octave")
    folder = tmp_path_factory.mktemp("octave")
    lines = [f"addpath('{folder}');"]
    for name in NAMES:
        called = file_name(module(name), "matlab")
        (folder / f"{called}.m").write_text(text(name, "matlab"), encoding="utf-8")
        lines += [f"m = {called}();", f"p = m.prepare({literal(parameters(name))});", "told(p);"]
        for call in calls(name):
            given = [
                "p" if a == "p" else literal(call.given[a])
                for a in call.arguments
                if a not in FILLED
            ]
            outs = [f"o{i}" for i in range(len(call.filled) + (call.value is not None))]
            wanted = f"m.{call.function}({', '.join(given)})"
            lines += [f"[{', '.join(outs)}] = {wanted}; told({', '.join(outs)});"]
    told = "for i = 1:numel(varargin) fprintf('%.17g ', varargin{i}); end; fprintf('\\n');"
    p = literal(landings()[0].vector)
    lines.append("m = sliding_block();")
    for mode, guard, before, _, _ in landings()[1]:
        lines.append(
            f"[o1, o2] = m.impact({mode}, {guard}, {literal(before)}, {p}, 0, 0); told(o1, o2);"
        )
    (folder / "told.m").write_text(f"function told(varargin)\n  {told}\nend\n", encoding="utf-8")
    (folder / "every_structure.m").write_text("\n".join(lines), encoding="utf-8")
    done = subprocess.run(
        [program, "--no-gui", "--quiet", "--norc", folder / "every_structure.m"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr[:3000]
    assert "warning" not in done.stderr, done.stderr[:3000]
    rows = iter(done.stdout.splitlines())
    found = {
        name: [np.array(next(rows).split(), float) for _ in range(1 + len(calls(name)))]
        for name in NAMES
    }
    return found | {"landings": [np.array(row.split(), float) for row in rows]}


def test_matlab_finds_what_follows_the_landings_of_a_simulated_block(octave):
    for (_, _, before, after, follows), (value, *out) in zip(
        landings()[1], octave["landings"], strict=True
    ):
        assert value == follows
        np.testing.assert_allclose(out, after, rtol=0, atol=1e-12 * np.abs(before).max())


@pytest.mark.parametrize("name", NAMES)
def test_matlab_gives_the_numbers_of_the_generated_module(name, octave):
    p, *found = octave[name]
    np.testing.assert_allclose(p, module(name).prepare(parameters(name)), rtol=TOLERANCE)
    for call, values in zip(calls(name), found, strict=True):
        expected, given = [], iter(values.tolist())
        whole = call.expected if call.value is None else call.expected[1:]
        if call.value is not None:
            expected.append(next(given))
        for a in call.filled:
            # a file of MATLAB gives no more than there is
            wanted = size(module(name), call.function, a)
            rest = list(given) if len(call.filled) == 1 else [next(given) for _ in range(wanted)]
            expected += rest + [0.0] * (wanted - len(rest))
        assert len(expected) == len(whole) + (call.value is not None)
        compare(call, expected)
