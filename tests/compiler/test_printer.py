"""Programs in plain Python, and the same as machine code: bit for bit, or refused by file and line.

The texts here are not those that the printer was written for. With contraction off each operation
is rounded as Python rounds it.
"""

import math
import multiprocessing
import os
import re
import time
import timeit
from dataclasses import replace

import numpy as np
import pytest

from rockeom.compiler import frontend, lines as machine_lines, parsed
from rockeom.compiler.lines import Lines
from rockeom.compiler.machine import Loaded, compiled
from rockeom.compiler.modules import Modules, Refused, Text
from rockeom.compiler.printer import GROWTH, Program
from tests.machine_code import HEAD, functions, importing

GREATEST_DIVISOR = """
@entry
def run(x: Floats, n: Ints, out: Floats):
    for i in range(len(n) - 1):
        a, b = abs(n[i]), abs(n[i + 1])
        while b != 0:
            rest = a
            while rest >= b:
                rest -= b
            a, b = b, rest
        out[i] = a
"""

COLLATZ = """
@entry
def run(x: Floats, n: Ints, out: Floats):
    for i in range(len(n)):
        m = abs(n[i]) + 1
        steps = 0
        while True:
            if m == 1 or steps > 40:
                break
            steps += 1
            half = 0
            while 2 * half + 1 < m:
                half += 1
            if 2 * half == m:
                m = half
                continue
            m = 3 * m + 1
        out[i] = float(steps)
"""

RECORDS = """
from typing import NamedTuple

class Place(NamedTuple):
    x: float
    turns: int
    known: bool

class Body(NamedTuple):
    place: Place
    sizes: Floats

class Two(NamedTuple):
    first: Place
    second: Place

def moved(body, by):
    at = body.place
    if at.known:
        at = at._replace(x=at.x + by, turns=at.turns + 1)
    return 2 * at.turns, body._replace(place=at)

@entry
def run(x: Floats, n: Ints, out: Floats):
    body = Body(sizes=x, place=Place(0, 0, n[0] > 0))
    for i in range(len(x)):
        doubled, body = moved(body, body.sizes[i])
        body = body._replace(place=body.place._replace(known=not body.place.known))
        if not body.place.known:
            body = body._replace(place=Place(x=body.place.x, turns=doubled, known=True))
        other = body if doubled > 4 else body._replace(place=Place(x[i], i, False))
        body, other = other, body
        two = Two(body.place, other.place)
        two = two._replace(first=two.second, second=two.first)
        out[i] = body.place.x + body[0].turns + two.first.x / 3.0 + 7 * two.second.turns
"""

HORNER = """
COEFFICIENTS = (0.3, -1.7, 2.9, 0.0, 1e-3)

@inlined
def value(x):
    total = 0.0
    for i in range(len(COEFFICIENTS) - 1, -1, -1):
        total = total * x + COEFFICIENTS[i]
    return total, x

@entry
def run(x: Floats, n: Ints, out: Floats):
    for i in range(len(x)):
        out[i], _ = value(x[i])
        out[i] -= value(-x[i])[0] / 3
"""

DETERMINANT = """
SIZE = 4

@entry
def run(x: Floats, n: Ints, out: Floats):
    m = np.zeros((SIZE, SIZE))
    for i in range(SIZE):
        for j in range(SIZE):
            m[i, j] = x[(SIZE * i + j) % 12]
        m[i, i] += 1.5
    sign = 1
    for c in range(SIZE):
        best = c
        for r in range(c + 1, SIZE):
            if abs(m[r, c]) > abs(m[best, c]):
                best = r
        if best != c:
            sign = -sign
            for j in range(SIZE):
                m[c, j], m[best, j] = m[best, j], m[c, j]
        row = m[c]
        for r in range(c + 1, SIZE):
            share = m[r, c] / row[c]
            for j in range(c, SIZE):
                m[r, j] -= share * row[j]
    product = sign
    for c in range(SIZE):
        product = product * m[c, c]
    out[0] = product
    out[1:3] = x[2]
    out[-1] = out[0] ** 3 - product**2 + abs(product) ** 0.37
"""

PLACES = """
NAMES = ((3, 1), (4, 1), (5, 9))

@entry
def run(x: Floats, n: Ints, out: Floats):
    later = x[2:]
    k = -1
    for i in range(len(NAMES)):
        for j in range(2):
            out[NAMES[i][j]] = later[k] + i - j
            k -= 1
    back = later.shape[0]
    out[0] = later[back - 1] + x[k]
"""

ROUNDS = """
WEIGHTS = np.array([[0.5, 0.0], [-1.5, 2.0]])
PLACES = (7, 3)

@entry
def run(x: Floats, n: Ints, out: Floats):
    for k in range(2):
        pair = (x[k], x[k + 4])
        for i in unrolled(range(2)):
            total = 0.0
            for j in unrolled(range(2)):
                if WEIGHTS[i, j] != 0.0:
                    total += WEIGHTS[i, j] * pair[j]
            for place in unrolled(PLACES):
                out[place + i] += total if place > 3 else k
"""

SPREAD = """
N = 3
HALVES = (0.5, -0.5, 0.25)

def shifted(k, a, b, c, at, out):
    out[k] += a - 2.0 * b + 3.0 * c
    out[k + 6] += at[1]

def halved(x, first):
    return tuple(HALVES[i] * x[first + i] for i in unrolled(range(N)))

@entry
def run(x: Floats, n: Ints, out: Floats):
    for k in range(3):
        parts, still = halved(x, k), tuple(0 if j == 1 else j for j in unrolled((2, 1, 0)))
        if x[k] < 0.0:
            parts = tuple(parts[place] + still[N - 1 - place] for place in unrolled(range(N)))
        shifted(k, *parts, tuple(part for part in unrolled((1.5, 2.5))), out)
        shifted(k, *HALVES, parts, out)
        shifted(k, x[k], *(x[k + 1], 4), (n[0], n[1]), out)
        out[k + 3] = max(0.0, *parts) - min(*parts, *still)
"""

CHOICES = """
@entry
def run(x: Floats, n: Ints, out: Floats):
    for i in range(len(x)):
        a, b = x[i], x[(i + 1) % len(x)]
        low, high = (a, b) if a < b else (b, a)
        inside = low < 0.0 <= high and not n[i % len(n)] in (1, 2, 3)
        outside = low > 1.0 or (i > 0 and x[i - 1] > 2.0) or high != high
        out[i] = (1 if inside else 2.5) if inside != outside else max(a, 0.25, b) - min(a, b, 0)
        if not inside and (outside or a > 0.0):
            pass
        elif inside | (a > b):
            out[i] += 100
        else:
            out[i] = -out[i]
"""

LIBRARY = """
def turned(x, y, angle):
    s, c = math.sin(angle), math.cos(angle)
    return (c * x - s * y, s * x + c * y), angle

@entry
def run(x: Floats, n: Ints, out: Floats):
    total = 0
    for i in range(len(x)):
        (a, b), c = turned(x[i], 0.3, 0.7 * i)
        total = total + a * b
        out[i] = total + math.exp(-c) + math.sqrt(abs(a)) + math.atan(b) + math.log(1.0 + c)
        out[i] += math.tanh(a) + math.expm1(b) + math.tan(c) + float(int(10.0 * a)) + math.pi
        if not math.isfinite(out[i]):
            out[i] = 0.0
"""

INFINITE = """
@entry
def run(x: Floats, n: Ints, out: Floats):
    zero = 0.0 * x[0]
    out[0] = x[1] / zero
    out[1] = -out[0] * zero
    out[2] = max(out[1], 1.0)
    out[3] = max(1.0, out[1])
    out[4] = min(out[1], 1.0)
    out[5] = 1.0 if out[1] == out[1] else 2.0
    out[6] = 1.0 if out[1] != out[1] else 2.0
    out[7] = 1.0 if math.isfinite(out[0]) else 2.0
    out[8] = np.inf
    out[9] = -(zero - zero)
"""

SIGNS = """
@entry
def run(x: Floats, n: Ints, out: Floats):
    for i in range(len(n)):
        out[i] = 1.0 if n[i] < 3 else 2.0
        if n[i] - n[i] <= 0 and 0.0 * x[i] <= 0.0:
            out[i] += 0.25
"""

WHOLE_TUPLES = """
def moved(point, by):
    (x, y), n = point
    return (x + by[0], y - by[1]), n + 1

def length(point):
    (x, y), n = point
    return n * math.sqrt(x * x + y * y)

def both(point, by):
    here = point
    there = moved(here, by)
    here = moved(there, (0.5, by[0]))
    return length(point) - length(there) + length(here)

@entry
def run(x: Floats, n: Ints, out: Floats):
    point = (x[0], x[1]), 1
    for i in range(len(x)):
        old = point
        point = moved(point, (x[i], 0.25))
        out[i] = length(point) - length(old) + both(point, (1.0, x[i]))
        if n[i % len(n)] > 0:
            point = old
"""

TEXTS = {
    "whole tuples": WHOLE_TUPLES,
    "signs": SIGNS,
    "greatest common divisor": GREATEST_DIVISOR,
    "records": RECORDS,
    "Collatz": COLLATZ,
    "Horner": HORNER,
    "determinant": DETERMINANT,
    "places": PLACES,
    "loops that are written out": ROUNDS,
    "tuples of rounds, and their items as arguments": SPREAD,
    "choices": CHOICES,
    "library": LIBRARY,
    "infinite": INFINITE,
}


def given(seed):
    """Floats (12,), ints (9,) and room for results (12,)."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=12) * 2.0, rng.integers(-30, 30, 9), np.zeros(12)


def powers_are_products(source):
    """x**2 and x**3 as the printer has them: C's pow may round otherwise."""
    return re.sub(r"([\w.]+(?:\[0\])?) ?\*\* ?3", r"(\1 * (\1 * \1))", re.sub(
        r"([\w.]+(?:\[0\])?) ?\*\* ?2\b", r"(\1 * \1)", source
    ))  # fmt: skip


def differences(source):
    """Of Python and machine code, over random arguments."""
    names = {}
    exec(HEAD + powers_are_products(source), names)
    run = functions(HEAD + source, contract=False)["run"]
    found = []
    for seed in range(20):
        x, n, wanted = given(seed)
        with np.errstate(all="ignore"):
            names["run"](x, n, wanted)
        x, n, out = given(seed)
        run(x, n, out)
        if out.tobytes() != wanted.tobytes() and not np.array_equal(out, wanted, equal_nan=True):
            found.append((seed, wanted, out))
    return found


@pytest.mark.parametrize("source", TEXTS.values(), ids=TEXTS)
def test_text_runs_as_in_python_to_the_last_bit(source):
    assert not differences(source)


def test_what_would_make_a_program_long_is_called():
    """A short function is written out wherever it is called, a long one where that is once."""
    long = HORNER.replace("    return", "    total += x\n" * int(GROWTH) + "    return")
    once = long.replace("out[i] -= value(-x[i])[0] / 3", "pass")
    for source, written_out in ((HORNER, True), (long, False), (once, True)):
        ir = Program([Text("some file.py", HEAD + source)]).ir()
        assert ("alwaysinline" in ir) == written_out


def test_what_a_constant_rules_out_is_not_printed():
    """Not even where the rest of the condition is known only when the program runs."""
    lines = "    if COEFFICIENTS[3] > 0.0 and x > 0.0:\n        total = absent(x)\n    return"
    unused = HORNER.replace("    return", lines, 1)
    assert not differences(unused)
    with pytest.raises(Refused, match="no function absent"):
        Program([Text("some file.py", HEAD + unused.replace("COEFFICIENTS[3]", "x"))])


def test_loops_of_what_is_seldom_called_stay_loops():
    """They give the same numbers by less machine code; also where they are written out."""
    rolled = HORNER.replace("@inlined", "@inlined\n@rolled")
    sizes = [len(compiled(Program([Text("f.py", HEAD + t)]).ir())) for t in (HORNER, rolled)]
    assert sizes[1] < sizes[0]
    assert not differences(rolled)


def test_function_of_a_constant_is_written_out_where_it_is_called():
    """Little of it may be left there; where nothing is constant it is called as before."""
    often = HORNER.replace("value(-x[i])[0] / 3", " + ".join(["value(-x[i])[0]"] * 7))
    for argument, written_out in (("x[i]", 0), ("0.5", 1)):
        source = often.replace("_ = value(x[i])", f"_ = value({argument})")
        size = Program([Text("some file.py", HEAD + source)]).sizes["value.1"]
        ir = Program([Text("some file.py", HEAD + source)], growth=4.0 * size).ir()
        assert ir.count("alwaysinline") == written_out
        assert not differences(source)


# -- a printer that is wrong somewhere is noticed

WRONG = {
    "a minus is a plus": (machine_lines.OF_FLOATS, "Sub", "fadd", HORNER),
    "division multiplies": (machine_lines.OF_FLOATS, "Div", "fmul", DETERMINANT),
    "less or equal is less": (machine_lines.COMPARED, "LtE", ("olt", "slt"), SIGNS),
    "ints are compared without sign": (machine_lines.COMPARED, "Lt", ("olt", "ult"), SIGNS),
    "nan equals itself": (machine_lines.COMPARED, "Eq", ("ueq", "eq"), INFINITE),
    "nan does not differ": (machine_lines.COMPARED, "NotEq", ("one", "ne"), INFINITE),
    "a remainder is a quotient": (machine_lines.OF_INTS, "Mod", "sdiv", DETERMINANT),
    "ints are subtracted the other way": (
        machine_lines.OF_INTS, "Sub", "add nsw", PLACES,
    ),
    "a constant is negated": (parsed.OPERATORS, frontend.ast.USub, lambda a: a, HORNER),
    "the largest is the least": (frontend._BUILT_IN, "max", Lines.least, CHOICES),
}  # fmt: skip

forked = pytest.mark.skipif(
    "fork" not in multiprocessing.get_all_start_methods(),
    reason="what is made wrong here must be so in a process of its own, which may hang or crash",
)


def is_noticed(source):
    """Whether Python and machine code differ; what hangs or crashes does, too.

    In a process of its own, for machine code hears nothing.
    """
    child = multiprocessing.get_context("fork").Process(target=_tell, args=(source,))
    child.start()
    child.join(60)
    if child.is_alive():
        child.kill()
    return child.exitcode != 0


def _tell(source):
    import resource  # where processes fork, it is there

    resource.setrlimit(resource.RLIMIT_CPU, (4, 4))  # s, some twenty times what it needs
    try:
        os._exit(1 if differences(source) else 0)
    except BaseException:
        os._exit(2)


@forked
@pytest.mark.parametrize(("table", "key", "value", "source"), WRONG.values(), ids=WRONG)
def test_wrong_printer_is_noticed(monkeypatch, table, key, value, source):
    assert not is_noticed(source)
    monkeypatch.setitem(table, key, value)
    assert is_noticed(source)


WRONG_METHODS = {
    "negative indices stay so": ("_index", lambda right: lambda self, n, _: self._int(n), "places"),
    "tests are turned round": (
        "_branch", lambda right: lambda self, test, a, b: right(self, test, b, a), "choices",
    ),
    "tuples are read from behind": ("_tuple", lambda right: lambda self, n: right(
        self, frontend.ast.Tuple(n.elts[::-1], n.ctx)
    ), "library"),
}  # fmt: skip


@forked
@pytest.mark.parametrize(("name", "wrong", "text"), WRONG_METHODS.values(), ids=WRONG_METHODS)
def test_wrong_method_of_the_printer_is_noticed(monkeypatch, name, wrong, text):
    right = getattr(frontend.Function, name)
    monkeypatch.setattr(frontend.Function, name, wrong(right))
    assert is_noticed(TEXTS[text])


# -- what is refused

REFUSED = {
    "x = [1.0, 2.0]": "List is not among the expressions",
    "x = {}": "Dict is not among the expressions",
    "x = y.sum()": "y.sum is not among the functions",
    "x = sum(y)": "no function sum is known",
    "x = y[0] % 2.0": "Mod of floats",
    "x = n // 2": "clearly cannot be negative",
    "x = n % 3": "clearly cannot be negative",
    "x = n if n else 1": "a test is a bool, and this is int",
    "while n:\n        n = n - 1": "a test is a bool",
    "x = n and 3": "a test is a bool",
    "if n > 0:\n        x = 1.0\n    z = x": "x may be read before it is assigned",
    "for i in range(n):\n        x = 1.0\n    z = x": "x may be read before it is assigned",
    "for i in range(n):\n        pass\n    z = i": "i may be read before it is assigned",
    "while n > 0:\n        x = 1.0\n        n -= 1\n    z = x": "may be read before",
    "x = 1.0\n    x = (1.0, 2.0)": "x was float, and would become (float, float)",
    "x = True\n    x = 1": "x was bool, and would become int",
    "n = 1.5": "the argument n is int, and would change that",
    "t = (y[0], 2.0)\n    x = t[n]": "the index of a tuple is a constant",
    "t = (1.0, 2.0)\n    x = t[2]": "a tuple of 2 has no item 2",
    "x = tupled((1.0, 2.0))": "the argument pair is a tuple, and stays what it is",
    "x = y[0, 1]": "2 indices of an array of float with 1 dimensions",
    "x = y[::2]": "a slice is array[first:last]",
    "x = np.empty(n)": "the shape of an array is constant",
    "for a in y:\n        pass": "a loop is `for name in range(...)`",
    "for i in range(0, 3, n):\n        pass": "the step of a range is a constant",
    "for i in unrolled(range(n)):\n        pass": "goes over all its constants",
    "for i in unrolled((1, 2)):\n        break": "goes over all its constants",
    "for i in unrolled((1, 2)):\n        pass\n    else:\n        x = 1": "without `else`",
    "i = 3\n    for i in unrolled((1, 2)):\n        pass": "no variable has it",
    "for i in unrolled((1, 2)):\n        pass\n    z = i": "i is not known",
    "x = tuple(i for i in unrolled(range(n)))": "goes over all its constants",
    "x = tuple(i for i in range(2))": "a tuple is written out, or tuple(x for i in unrolled",
    "x = tuple(i for i in unrolled((1, 2)) if i > 1)": "a tuple is written out, or",
    "i = 3\n    x = tuple(i for i in unrolled((1, 2)))": "no variable has it",
    "x = outer(*y)": "a tuple has a star, and no array of float with 1 dimensions",
    "x = outer(*(1.0, 2.0))": "it takes 1 arguments, and got 2",
    "x = other(1.0)": "no function other is known",
    "x = outer(1.0, 2.0)": "it takes 1 arguments, and got 2",
    "x = outer(x=1.0)": "arguments are given by their place",
    "x = recursive(1.0)": "recursive calls itself",
    "try:\n        x = 1\n    except ValueError:\n        x = 2": "Try is not among the statements",
    "with y:\n        pass": "With is not among the statements",
    "raise ValueError": "Raise is not among the statements",
    "global G": "Global is not among the statements",
    "x = lambda a: a": "Lambda is not among the expressions",
    "x = 'word'": "str is no number and no table of numbers",
    "x = f'{n}'": "JoinedStr is not among the expressions",
    "return 1.0\n    x = 2.0": "this is never reached",
    "x = y @ y": "no arithmetic with array of float",
    "x = y[0] < True": "no comparison with bool",
    "x = n & 1": "BitAnd of ints is not among the operations",
    "x = nothing(1.0)": "gives nothing back",
    "x = y.T": ".T is not known",
    "x = math.gamma(1.0)": "math.gamma of 1 is not among the functions",
    "x = math.sin()": "math.sin of 0 is not among the functions",
    "x = np.int64(1.0, 2.0)": "np.int64 of 2 is not among the functions",
    "x = np.empty()": "the shape of an array is constant",
    "x = np.array()": "a list of numbers that is written out",
    "x = abs(1.0, 2.0)": "abs of 2 is not among the functions",
    "x = max()": "max of 0 is not among the functions",
    "n //= 2": "clearly cannot be negative",
    "x = undefined": "undefined is not known",
    "x = Pair(1.0)": "Pair takes first, second, each once",
    "x = Pair(1.0, first=2.0)": "Pair takes first, second, each once",
    "x = Pair(1.0, True)": "Pair.second is int, not bool",
    "x = Pair(1.0, 2.0)": "Pair.second is int, not float",
    "x = Pair(1.0, 2)._replace(third=1)": "there is no field third, only first, second",
    "x = Pair(1.0, 2)._replace(second=1.5)": "second is int, not float",
    "x = Pair(1.0, 2).third": ".third is not known",
    "x = y._replace(first=1.0)": "._replace(field=value) is of a record",
    "del n": "Delete is not among the statements",
    "assert n > 0": "Assert is not among the statements",
}
FRAME = (
    HEAD
    + """
from typing import NamedTuple

class Pair(NamedTuple):
    first: float
    second: int

def outer(a):
    return a + 1.0

def recursive(a):
    return recursive(a)

def nothing(a):
    pass

def tupled(pair):
    pair = (pair[1], pair[0])
    return pair[0]

@entry
def run(y: Floats, n: int):
    {}
"""
)


@pytest.mark.parametrize("line", REFUSED)
def test_what_is_no_plain_arithmetic_is_refused_by_file_and_line(line):
    with pytest.raises(Refused) as caught:
        Program([Text("some file.py", FRAME.format(line))])
    text = str(caught.value)
    assert REFUSED[line] in text
    number = int(re.match(r"some file.py, line (\d+), in ", text).group(1))
    lines = FRAME.format(line).splitlines()
    within = lines[number - 1].strip()
    assert within in line or within.startswith(
        ("def recursive", "return recursive", "def outer", "pair = ")
    )


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("@entry\ndef run(x):\n    pass", "x has no annotation that is known"),
        ("@entry\ndef run(x: list):\n    pass", "x has no annotation that is known"),
        ("@entry\ndef run(x: float) -> tuple:\n    return x, x", "an entry returns a number"),
        ("@entry\ndef run(x: float, *rest: float):\n    pass", "arguments have names"),
        ("@entry\ndef run(x: float = 1.0):\n    pass", "no default values"),
        (
            "@entry\ndef run(x: float) -> float:\n    if x > 0.0:\n        return x",
            "ends without `return`",
        ),
    ],
)
def test_entry_that_python_could_not_call_is_refused(text, word):
    with pytest.raises(Refused, match=re.escape(word)):
        Program([Text("some file.py", HEAD + text)])


FILLS = """
@entry
def fill(x: Floats, scale: float, upwards: bool, n: int) -> float:
    for i in range(n):
        x[i] = scale * i if upwards else -scale * i
    return x[n - 1]


@entry
def doubled(x: Floats):
    for i in range(len(x)):
        x[i] *= 2.0
"""
CALLS = """
@entry
def run(x: Floats, upwards: bool) -> float:
    found = fill(x, 1.5, upwards, 3)
    doubled(x)
    return found
"""


def of_two_programs(called: str, calls: str) -> tuple[Program, Program]:
    """A program, and another one whose text imports and calls the entries of the first."""
    there = Text("there.py", HEAD + called)
    modules = Modules({"rockeom.there": (replace(there, elsewhere=True),)})
    text = Text("here.py", importing(calls, [there], "rockeom.there") + HEAD + calls)
    return Program([there]), Program([text], modules)


def test_entry_of_another_program_is_called_and_not_compiled_again():
    there, here = of_two_programs(FILLS, CALLS)
    assert [*here.entries] == ["run"]
    codes = [compiled(program.ir()) for program in (there, here)]
    run = Loaded(codes[0], there.entries | here.entries, codes[1]).functions["run"]
    for upwards, sign in ((True, 1.0), (False, -1.0)):
        x = np.zeros(3)
        assert run(x, upwards) == sign * 3.0
        assert (x == sign * np.array([0.0, 3.0, 6.0])).all()


def test_entry_of_another_program_is_called_with_what_it_takes():
    for given in ("x, 2, upwards, 3", "x, 1.5, 1.0, 3"):
        with pytest.raises(Refused, match="arguments of fill are not as"):
            of_two_programs(FILLS, CALLS.replace("x, 1.5, upwards, 3", given))


OF_RECORDS = """
from typing import NamedTuple


class Scale(NamedTuple):
    n: int
    upwards: bool
    size: float


class Row(NamedTuple):
    x: Floats
    n: int


@entry
def fill(first: int, scale: Scale, row: Row) -> float:
    for i in range(first, scale.n):
        row.x[i] = scale.size * i if scale.upwards else -scale.size * i
    return row.x[row.n]
"""
GIVES_RECORDS = """
@entry
def run(x: Floats, upwards: bool) -> float:
    scale = Scale(len(x), not upwards, 1.5)
    return fill(1, scale._replace(upwards=upwards), Row(x, 2))
"""


def test_entry_takes_records_by_their_fields_of_python_and_of_another_program():
    there, here = of_two_programs(OF_RECORDS, GIVES_RECORDS)
    names = [name for name, _ in there.entries["fill"].arguments]
    assert names == ["first", "scale.n", "upwards", "size", "x", "row.n"]
    codes = [compiled(program.ir()) for program in (there, here)]
    calls = Loaded(codes[0], there.entries | here.entries, codes[1]).functions
    for upwards, sign in ((True, 1.0), (False, -1.0)):
        x, y = np.zeros(4), np.zeros(4)
        assert calls["fill"](1, 4, upwards, 1.5, x, 2) == calls["run"](y, upwards) == sign * 3.0
        assert (x == y).all()
        assert (x == sign * np.array([0.0, 1.5, 3.0, 4.5])).all()


def test_array_that_machine_code_would_misread_is_refused():
    run = functions(HEAD + "@entry\ndef run(x: Floats2) -> float:\n    return x[1, 0]")["run"]
    assert run(np.array([[1.0, 2.0], [3.0, 4.0]])) == 3.0
    for wrong in (np.zeros(4), np.zeros((2, 2), int), np.ones((2, 4)).T):
        with pytest.raises(TypeError, match="run: x is"):
            run(wrong)


def added():
    """A function of a table, a vector and numbers, and its arguments."""
    text = (
        "@entry\ndef run(x: Floats2, y: Floats, a: float, n: int) -> float:\n"
        "    y[0] += 1.0\n    return x[n, 1] + y[0] + a + len(x)"
    )
    return functions(HEAD + text)["run"], (np.arange(4.0).reshape(2, 2), np.zeros(1), 0.5, 1)


def test_bound_arguments_are_those_of_the_call():
    """What changes in an array, and what is bound anew, is seen; arrays stay alive."""
    run, (x, y, a, n) = added()
    bound = run.bound(x, y, a, n)
    assert bound() == 3.0 + 1.0 + 0.5 + 2
    assert y[0] == 1.0
    y[0] = 10.0
    bound["a"], bound["n"] = np.float64(0.25), np.int64(0)
    assert bound() == 1.0 + 11.0 + 0.25 + 2
    bound["x"] = np.full((5, 2), 7.0)  # nobody else keeps it
    garbage = [np.zeros((5, 2)) for _ in range(100)]
    assert bound() == 7.0 + 12.0 + 0.25 + 5
    assert len(garbage) == 100
    other = run.bound(x, np.zeros(1), a, n)
    assert [other(), bound()] == [3.0 + 1.0 + 0.5 + 2, 7.0 + 13.0 + 0.25 + 5]


def test_array_that_is_bound_is_looked_at():
    run, (x, y, a, n) = added()
    bound = run.bound(x, y, a, n)
    for wrong in (np.zeros(4), np.zeros((2, 2), int), np.ones((2, 4)).T):
        with pytest.raises(TypeError, match="run: x is"):
            bound["x"] = wrong
        with pytest.raises(TypeError, match="run: x is"):
            run.bound(wrong, y, a, n)
    assert bound() == 3.0 + 1.0 + 0.5 + 2  # what was refused is not bound
    with pytest.raises(TypeError):
        bound["n"] = 0.5
    with pytest.raises(KeyError):
        bound["m"] = 1
    with pytest.raises(ValueError, match="argument"):
        run.bound(x, y, a)


def test_bound_call_writes_no_arguments():
    """It costs a small part of a call that does: the least of many of each, turn by turn."""
    run, arguments = added()
    bound = run.bound(*arguments)

    def least(call):
        return min(timeit.repeat(call, number=20, repeat=5, timer=time.process_time_ns))

    both = [(least(bound), least(lambda: run(*arguments))) for _ in range(100)]
    prepared, whole = np.min(both, axis=0)
    assert prepared < whole / 3


def test_results_come_back_in_their_types():
    run = functions(
        HEAD + "@entry\ndef a(x: float, n: int) -> float:\n    return x * n\n"
        "@entry\ndef b(x: float, n: int) -> int:\n    return n + int(x)\n"
        "@entry\ndef c(x: float, yes: bool) -> bool:\n    return x > 0.0 and yes\n"
        "@entry\ndef d(x: float):\n    pass\n"
    )
    assert run["a"](1.5, -3) == -4.5
    assert run["b"](-2.7, 2**40) == 2**40 - 2
    assert [run["c"](1.0, True), run["c"](1.0, False), run["c"](-1.0, True)] == [True, False, False]
    assert run["d"](1.0) is None
    assert math.isnan(run["a"](math.nan, 1))


def test_a_sum_of_more_terms_than_python_calls_functions_in_one_another_is_printed():
    terms = " + ".join(f"x[{i % 4}] * {i}.0" for i in range(900))
    run = functions(f"@entry\ndef run(x: Floats, n: Ints, out: Floats):\n    out[0] = {terms}\n")[
        "run"
    ]
    out = np.zeros(1)
    run(np.ones(4), np.zeros(1, dtype=np.int64), out)
    assert out[0] == sum(range(900))
