"""The functions of a structure as one self-contained file of another language.

The file has the generated module that is simulated, and nothing else: its functions of the
parameters, the equations of motion, guards, impact map and energies of each mode. Structures whose
contacts open, slide and bounce have the search for the mode after a landing as well.
"""

import ast
import textwrap
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

from rockeom.codes import MOREAU, NEWTON
from rockeom.compiler.modules import Modules, Text, module_text, parsed, without
from rockeom.compiler.types import FLOAT, INT, Array, Type
from rockeom.exports import c, matlab
from rockeom.exports.closed import Function, Functions, Names, in_plain_letters, printable
from rockeom.integrator.linking import text_of_law, texts_of_modes
from rockeom.integrator.schema import (
    PRELUDE,
    PROVIDED,
    GeneratedModule,
    impact_law,
    in_space,
    name_of_law,
)
from rockeom.integrator.texts import source
from rockeom.modelling.declared import class_of_model
from rockeom.numbers.checks import InputError, InputTypeError, near
from rockeom.version import VERSION

WHOLE = ("mode", "guard", "law", "number")
ARRAYS = ("y", "p", "parameters", "out", "dy", "g", "matrix", "forces")
"""Arguments of what is called from outside that are whole numbers, and that are arrays."""
FILLED = ("out", "dy", "g", "matrix", "forces")

MEANINGS = {
    "mode": "number of the mode, see above",
    "guard": "number of the guard that fell, from 0",
    "law": "0: the angular velocity is multiplied by `ratio`; 1: the impulsive form of\n"
    "Lagrange's equations",
    "ratio": "of the angular velocities after and before the impact; used where law is 0",
    "number": "of the coordinate that may fall, from 0",
    "y": "states, in the order above",
    "p": "what `prepare` makes of the parameters",
    "parameters": "in the order above",
    "ax": "acceleration of the ground to the right [m/s2]",
    "ay": "acceleration of the ground upwards [m/s2]",
    "result": "the p of all other functions",
    "load": "horizontal force at the load point [N]",
}
_LEFT_OUT = ("shapes", "sizes", "full_contact_guards", "opening_acceleration")
"""Functions that only a sketch, a check of parameters or the integrator needs."""

_OF_POINTS = '''import numpy as np
from rockeom.integrator.transitions.candidates import pass_on
from rockeom.integrator.transitions.points import CONTACT_SIZE


def impact(mode, guard, y, p, ax, ay, out):
    """Pass through what a guard that fell leads to: state after into out (N,).

    At a landing all points that touch meet by their restitution and friction at once; the mode
    that follows is that whose impulses, and then forces, fit. Returns its number, -1 where
    none fits, -2 where several do that move differently.
    """
    contact, ground = np.empty(CONTACT_SIZE), np.empty(5)
    ground[0], ground[1], ground[2], ground[3] = ax, ay, ax, ay
    ground[4] = 1e-9  # s, for which the ground stays so
    follows, _ = pass_on(mode, guard, 1e-3, y, p, ground, 0.0, contact, out)
    return follows
'''


_SINE_COSINE = '''import math


def sine_cosine(x):
    """Sine and cosine."""
    return math.sin(x), math.cos(x)
'''
"""In place of the polynomials, which hold only where nothing is rounded otherwise."""


class _Spread(ast.NodeTransformer):
    """Writes out both items of tuples with a star, which are accelerations in the plane."""

    def visit_Starred(self, node: ast.Starred) -> Any:
        return [ast.Subscript(node.value, ast.Constant(i)) for i in range(2)]


def _written(name: str) -> Text:
    """A module of the integrator, without stars."""
    text = module_text(name)
    tree = _Spread().visit(ast.parse(text.source))
    return replace(text, source=ast.unparse(ast.fix_missing_locations(tree)))


@dataclass(frozen=True)
class Described:
    """A module and its functions, with their descriptions.

    name : of the file. entries : what is called from outside.
    """

    module: GeneratedModule
    name: str
    functions: Functions
    entries: tuple[str, ...]

    @property
    def title(self) -> str:
        return (self.module.__doc__ or "").partition("\n")[0]

    @property
    def source(self) -> str:
        """Where the structure is described, as it is declared; may be empty."""
        lines = (self.module.__doc__ or "").splitlines()
        return next((line for line in lines if line.startswith("Source: ")), "")

    @property
    def transition(self) -> str:
        """The function that gives the state after the end of a mode."""
        return "impact" if "impact" in self.entries else "jump"

    @property
    def mode_constants(self) -> dict[str, str]:
        """The name of the constant that is the number of each mode."""
        constants = {}
        for i, mode in enumerate(self.module.MODES):
            name = unicodedata.normalize("NFKC", mode.upper())
            while self.functions.constants.get(name) is not i:
                name += "_"
                if len(name) > 2 * len(mode) + 40:
                    raise AssertionError(f"no constant is the number of {mode}")
            constants[mode] = name
        return constants

    def size(self, function: Function, argument: str) -> int:
        """How many numbers a function puts into an argument."""
        m, half = self.module, self.module.N_STATES // 2
        sizes = {"g": m.N_GUARDS + m.N_PARTS, "matrix": half**2, "forces": half}
        sizes |= dict.fromkeys(("dy", "jump", "impact"), m.N_STATES)
        sizes |= {"energies": len(m.ENERGIES), "reactions": len(m.REACTIONS)}
        sizes |= {"kinematics": len(m.KINEMATICS), "positions": 3 * len(m.POSITIONS)}
        for name in (argument, function.name):
            if name in sizes:
                return sizes[name]
        indices = (getattr(i, "value", None) for i in _indices(function.tree, argument))
        return 1 + max((i for i in indices if isinstance(i, int)), default=-1)

    def prepared(self) -> int:
        """How many numbers `prepare` gives."""
        return self.functions.by_name["prepare"].lengths["p"]

    def head(self) -> list[str]:
        """Title, states, parameters and modes of the file, and how it is used."""
        m = self.module
        lines = [
            self.title,
            "",
            f"Written by rockeom {VERSION} out of the equations that it derives and simulates.",
            *([self.source] if self.source else []),
            "",
            "States y, in their order:",
            *_rows(m.STATES, _units(m.STATE_UNITS)),
            "",
            "Parameters, in their order:",
            *_rows(m.PARAMETERS, _units(m.PARAMETER_UNITS), m.PARAMETER_MEANINGS),
            "",
            "Modes, and how many guards end each:",
            *_rows(m.MODES, map(str, m.GUARDS)),
            "",
            "`prepare` is called once for a set of parameters; it gives the p of all others.",
            "Within a mode integrate `rates` while all its `guards` are positive. Where",
            f"the first of them falls to zero, `{self.transition}` gives the state after it.",
        ]
        return [printable(line) for line in lines]

    def arguments(self, function: Function, names: Sequence[str]) -> list[tuple[str, str]]:
        """Name and meaning of each; of arrays that are filled, their contents."""
        m = self.module
        sizes = {"y": m.N_STATES, "parameters": len(m.PARAMETERS)}
        sizes |= dict.fromkeys(("p", "result"), self.prepared())
        rows = []
        for name in names:
            if name in FILLED:
                size = self.size(function, name)
                columns: Any = getattr(m, function.name.upper(), None)
                named = isinstance(columns, tuple) and len(columns) == size
                named = named and all(isinstance(x, str) for x in columns)
                rows.append((name, f"({size}) {', '.join(columns) if named else 'what is found'}"))
            else:
                many = f"({sizes[name]}) " if name in sizes else ""
                rows.append((name, many + MEANINGS.get(name, "")))
        return rows


def code_of_model(model: Any, language: str) -> str:
    """Text of one file with the code of a RockingModel or Model, see `code`.

    Parameters
    ----------
    model : RockingModel or Model
        Model.
    language : str
        Language, as for `code`.

    Returns
    -------
    str
        Text of the file.
    """
    return code(class_of_model(model).module, language)


def code(module: GeneratedModule, language: str) -> str:
    """A generated module as the text of one file of "c" or "matlab".

    Both hold functions of plain numbers and arrays, by the names that they have in the module:
    prepare, rates, guards, jump (or impact, where contacts open, slide and bounce), energies,
    reactions, kinematics, positions and more, each with its arguments and units. They agree with
    those that are simulated but for the rounding of the language's own sine, cosine and powers.

    C: C99, nothing included but <math.h>; what is global begins with the structure's name. MATLAB:
    a function of the structure's name that gives a struct of function handles; runs in Octave as
    well. Raises TypeError for what is no text, and ValueError for another language, and for
    contacts whose impact law is followed through an impact: "poisson", "lzb" and "pairwise".
    """
    if not isinstance(language, str):
        raise InputTypeError("language", language).choose(LANGUAGES)
    if in_space(module):
        raise InputError("structure", of=module.NAME).says(
            "it moves in space, which is not written in other languages"
        )
    if hasattr(module, "BOUNDS"):
        raise InputError("structure", of=module.NAME).says(
            "its motion ends at bounds, which are not written in other languages"
        )
    if impact_law(module) not in (NEWTON, MOREAU):
        raise InputError("structure", of=module.NAME).says(
            f"its contacts have the impact law {name_of_law(module)!r}, which is not written in "
            'other languages: give law="newton" or "moreau"'
        )
    if language not in LANGUAGES:
        raise InputError("language", language).says(
            f"no language {language!r}{near(language, LANGUAGES)}: there are {', '.join(LANGUAGES)}"
        )
    return LANGUAGES[language](_described(module))


@lru_cache(maxsize=1)  # of a structure that is written in both languages
def _described(module: GeneratedModule) -> Described:
    prelude = without(module_text(PRELUDE), "sine_cosine"), Text("sine and cosine", _SINE_COSINE)
    own = Text(f"{module.NAME}.py", source(module))
    texts, provided = [*prelude, own], [own, *texts_of_modes(module, _written)]
    if getattr(module, "N_POINTS", 0):  # and does not move through elements alone
        texts.append(Text("impact", _OF_POINTS))
        provided.append(_written(text_of_law(module)))
    modules = Modules({PRELUDE: prelude, PROVIDED: tuple(provided)}, _written)
    entries = _entries(texts, ("impact",))
    functions = Functions(texts, modules, entries)
    for name in entries:
        function = functions.by_name[name]
        function.fills |= {a for a in FILLED if a in function.arguments}
    return Described(module, in_plain_letters(module.NAME), functions, tuple(entries))


def _entries(texts: Sequence[Text], names: Sequence[str]) -> dict[str, list[Type]]:
    """The functions that a user calls, `prepare` first, with the types of their arguments.

    names : those that are wanted of other texts than that of the structure.
    """
    trees = {
        name: tree
        for i, text in enumerate(texts)
        for name, tree in parsed(text.source, text.name).functions.items()
        if i in (0, 2) or name in names
    }
    inner = {name for name, f in trees.items() if f.decorator_list}
    inner |= {name for name in trees if name.startswith("impulse_") or name in _LEFT_OUT}
    wanted = dict.fromkeys(("prepare", "rates", "guards"))
    wanted |= dict.fromkeys(name for name in trees if name not in inner)
    return {name: [_type(trees[name], a.arg) for a in trees[name].args.args] for name in wanted}


def _type(function: ast.FunctionDef, argument: str) -> Type:
    """The type of an argument of a function that is called from outside."""
    if argument in WHOLE:
        return INT
    return Array(FLOAT, 1) if argument in ARRAYS or any(_indices(function, argument)) else FLOAT


def _indices(function: ast.FunctionDef, argument: str) -> Iterator[ast.expr]:
    """The indices by which an argument is read and written."""
    for node in ast.walk(function):
        match node:
            case ast.Subscript(value=ast.Name(id=name), slice=index) if name == argument:
                yield index


def _units(units: Iterable[str]) -> list[str]:
    return [f"[{unit}]" for unit in units]


def _rows(*columns: Iterable[str]) -> list[str]:
    """Aligned columns, behind the numbers of their rows."""
    table = [(str(i), *row) for i, row in enumerate(zip(*columns, strict=True))]
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    cells = [[cell.ljust(w) for cell, w in zip(row, widths, strict=True)] for row in table]
    return [f"  {'  '.join(row)}".rstrip() for row in cells] or ["  none"]


def _explained(described: Described, function: Function, names: Sequence[str]) -> list[str]:
    """Description of a function and of its arguments."""
    rows = described.arguments(function, names)
    width = max((len(name) for name, _ in rows), default=0)
    lines = [printable(line) for line in function.doc.splitlines()]
    for name, meaning in rows:
        first, *more = meaning.split("\n")
        lines.append(f"  {name.ljust(width)}  {first}".rstrip())
        lines += [f"  {' ' * width}  {line}" for line in more]
    return lines


def _names(described: Described, reserved: Iterable[str]) -> Names:
    """Names for all in the functions; those of the functions that are called come first."""
    names = Names(frozenset(reserved))
    for name in described.entries:
        names.of(name)
    return names


# -- C -------------------------------------------------------------------------------------------


def _comment(lines: Sequence[str]) -> list[str]:
    """A comment of C, which nothing in it ends."""
    safe = [line.replace("??", "? ?").replace("*/", "* /").replace("/*", "/ *") for line in lines]
    return ["/*", *(f" * {line}".rstrip() for line in safe), " */"]


def _c(described: Described) -> str:
    names = _names(described, c.RESERVED)
    prefix = f"{described.name}_"
    bodies: list[str] = []
    used: list[str] = []
    for function in described.functions.ordered():
        entry = function.name in described.entries
        writer = c.CWriter(described.functions, function, names, prefix)
        arguments = [*function.arguments, *(["result"] if function.name == "prepare" else [])]
        description = _explained(described, function, arguments if entry else ())
        bodies += ["", *_comment(description), *writer.write("" if entry else "static ")]
        used += [name for name in writer.constants if name not in used]
    m = described.module
    constants = {names.of(n): m.MODES.index(mode) for mode, n in described.mode_constants.items()}
    constants |= {"N_STATES": m.N_STATES, "N_PARAMETERS": len(m.PARAMETERS)}
    constants |= {"N_PREPARED": described.prepared()}
    constants |= {names.of(name): described.functions.constants[name] for name in used}
    tables: list[str] = []
    for name, value in constants.items():
        tables += c.table(f"{prefix.upper()}{name}", value)
    head = [
        *described.head(),
        "",
        f"All names begin with {prefix}, as {prefix}rates.",
        "Compile it as C99, or include it in one file of a program.",
    ]
    return "\n".join([*_comment(head), "", "#include <math.h>", "", *tables, *bodies, ""])


# -- MATLAB --------------------------------------------------------------------------------------


_EITHER = """
function result = either(test, one, other)
    % One of two values.
    if test
        result = one;
    else
        result = other;
    end
end
"""


def _matlab(described: Described) -> str:
    names = _names(described, [*matlab.RESERVED, described.name])
    called = file_name(described.module, "matlab")
    bodies: list[str] = []
    handles: list[str] = []
    for function in described.functions.ordered():
        writer = matlab.MatlabWriter(described.functions, function, names)
        lines = writer.write()
        inputs = [a for a in function.arguments if a not in FILLED]
        filled = [a for a in function.arguments if a in FILLED]
        entry = function.name in described.entries
        description = _explained(described, function, [*inputs, *filled] if entry else ())
        if entry:
            sizes = {a: f"zeros({described.size(function, a)}, 1)" for a in filled}
            call = ", ".join(sizes.get(a, names.of(a)) for a in function.arguments)
            handles.append(
                f"    m.{names.of(function.name)} = @({', '.join(map(names.of, inputs))}) ..."
            )
            handles.append(f"        {names.of(function.name)}({call});")
        bodies += ["", lines[0], *(f"    % {line}".rstrip() for line in description), *lines[1:]]
    m = described.module
    head = [
        *described.head(),
        "",
        f"    m = {called}();  p = m.prepare(parameters);  dy = m.rates(mode, y, p, ax, ay);",
        "",
        "Arrays that a function fills are what it gives, behind a value of its own, as in",
        f"[follows, y] = m.{described.transition}(...).",
        "Modes, guards and impact laws are numbered from 0.",
    ]
    lines = [f"function m = {called}()", *(f"    % {line}".rstrip() for line in head)]
    for field in ("states", "parameters", "modes"):
        lines += _cells(f"    m.{field} = ", getattr(m, field.upper()))
    for mode, name in described.mode_constants.items():
        lines.append(f"    m.{names.of(name)} = {m.MODES.index(mode)};")
    text = "\n".join([*lines, *handles, "end", *bodies, ""])
    return text + _EITHER if "either(" in text else text


def _cells(head: str, words: Sequence[str]) -> list[str]:
    """A row of strings."""
    cells = [f"'{printable(word).replace(chr(39), chr(39) * 2)}'" for word in words]
    wrapped = textwrap.wrap(", ".join(cells), 84, break_long_words=False, break_on_hyphens=False)
    lines = [f"{head}{{ ..."]
    lines += [f"        {line} ..." for line in wrapped]
    return [*lines, "    };"]


def file_name(module: GeneratedModule, language: str) -> str:
    """The name of the file without its ending; in MATLAB that is the function's name."""
    return Names(matlab.RESERVED if language == "matlab" else ()).of(module.NAME)


LANGUAGES: Mapping[str, Callable[[Described], str]] = {"c": _c, "matlab": _matlab}
"""The writer of each language."""
