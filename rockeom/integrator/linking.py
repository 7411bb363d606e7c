"""The texts that a program is linked of: a structure's, a method's, and those of the integrator.

Nothing here asks for a compiler, so that machine code that is kept is found without one.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from rockeom.codes import MOREAU, NEWTON
from rockeom.compiler.modules import Modules, Text, module_text, without
from rockeom.integrator.schema import (
    PRELUDE,
    PROVIDED,
    GeneratedModule,
    angles,
    ground_axes,
    has_points,
    impact_law,
    is_by_code,
)
from rockeom.integrator.texts import source

INTEGRATOR = "rockeom.integrator"

LOOP, VECTORS, GLUE, TANGENTS = "loop", "vectors", "lanes", "derivatives"
"""The parts of a program, each compiled and kept by itself: a sweep in lanes finds the loop there
that a single motion has been run by. Vectors are the work on all lanes at once, and the third is
what it is called by. Derivatives are the texts of the loop once more, printed for duals."""
_ENTRIES = {
    LOOP: ("loop", "batches"), VECTORS: ("lanes.vectors",), GLUE: ("lanes.loop",),
    TANGENTS: ("tangents.variational",),
}  # fmt: skip
"""The modules of a part whose entries Python or another part calls. Vectors have one more: the step
of lanes, a text that is written for each structure."""
_DECLARED, _SEARCHED = ("table",), ("search", "landings")
"""The modules that say which mode follows an event."""
_OF_TANGENTS = (
    "rockeom.numbers.derivatives", f"{INTEGRATOR}.tangents.derivatives", f"{INTEGRATOR}.batches",
)  # fmt: skip
"""Modules by which numbers carry derivatives along, and the loop: its calls of a function count
where it is decided whether that is written out."""


class Linked(NamedTuple):
    """The texts whose entries a part of a program has, and the modules that they import.

    own : names of the texts that belong to the structure and the method.
    """

    roots: tuple[Text, ...]
    modules: Modules
    own: frozenset[str]


def linked(generated: GeneratedModule, method: str, part: str = LOOP, steps: bool = True) -> Linked:
    """A part of a program, which calls the entries of other parts.

    steps : with the text of the method's step, which only a compiler needs.
    """
    entries = [f"{INTEGRATOR}.{name}" for name in _ENTRIES[part]]

    def read(module: str) -> Text:
        text = module_text(module)
        # lanes do not have the loop's last digits in any case
        return replace(text, fused=text.fused or part == VECTORS, elsewhere=module not in entries)

    step = _step(generated, method, part, read) if steps else ()
    own = (Text(f"{generated.NAME}.py", source(generated), fused=part == VECTORS), *step)
    prelude: tuple[Text, ...] = (read(PRELUDE),)
    if part == VECTORS:  # a sine and a cosine without branches
        others = without(read(PRELUDE), "sine_cosine") if steps else read(PRELUDE)
        prelude = others, read(f"{INTEGRATOR}.lanes.sines")
    provided = {PROVIDED: (*own, *_transitions(generated, read)), PRELUDE: prelude}
    roots = [*step[-1:]] if part == VECTORS else []
    roots += map(read, [*entries, *(_OF_TANGENTS if part == TANGENTS else ())])
    names = frozenset(text.name for text in (*prelude, *own))
    return Linked(tuple(roots), Modules(provided, read), names)


def _transitions(generated: GeneratedModule, read: Callable[[str], Text]) -> list[Text]:
    """How the modes of a structure follow one another, and what the texts of that ask of it."""
    bounces = _has_points_that_open(generated)
    which = [read(f"{INTEGRATOR}.transitions.{n}") for n in (_SEARCHED if bounces else _DECLARED)]
    which += texts_of_modes(generated, read)
    if not has_points(generated):
        return [Text("what follows from a structure", "N_POINTS = CONTACT_SIZE = 0\n"), *which]
    facts = f"from {INTEGRATOR}.transitions.points import CONTACT_SIZE\n"
    facts += f"ANGLES = {angles(generated)!r}\n"
    which.append(read(text_of_law(generated)))
    return [Text("what follows from a structure", facts), *which]


def text_of_law(generated: GeneratedModule) -> str:
    """The text of the impact law: Moreau's in space has that of Newton's, whose search it is."""
    alike = impact_law(generated) == NEWTON or is_by_code(generated)
    return f"{INTEGRATOR}.transitions.{'newton' if alike else 'impacts'}"


def texts_of_modes(
    generated: GeneratedModule, read: Callable[[str], Text] = module_text
) -> list[Text]:
    """The texts by which modes have numbers and points touch, and the axes of the ground."""
    names = ["modes_by_table", *(["points_in_plane"] if _has_points_that_open(generated) else [])]
    if is_by_code(generated):
        names = ["modes_by_code", "points_in_space"]
    ground = f"AXES = {len(ground_axes(generated))}\nSTILL = (0.0,) * AXES\n"
    ground += f"DIRECTIONS = {3 if is_by_code(generated) else 2}\n"
    returns = is_by_code(generated) and impact_law(generated) == MOREAU
    ground += f"RETURNS_SLIPS = {returns}\n"
    texts = [read(f"{INTEGRATOR}.transitions.{name}") for name in names]
    return [*texts, Text("the ground", ground)]


def _has_points_that_open(generated: GeneratedModule) -> bool:
    """Whether points may open; a structure may move through elements alone."""
    return getattr(generated, "N_POINTS", 0) > 0


def _step(
    generated: GeneratedModule, method: str, part: str, read: Callable[[str], Text]
) -> tuple[Text, ...]:
    """The step of a method, and that of lanes."""
    from rockeom.integrator.methods.tableau import step_text, tableau

    n = generated.N_STATES // 2
    if method == "Radau":
        from rockeom.integrator.methods.radau import constants_text

        constants = Text("the constants of Radau", constants_text(n))
        return constants, read(f"{INTEGRATOR}.methods.radau_step")
    quick = getattr(generated, "QUICK", ())
    step = step_text(tableau(method), n, generated.ROTATION, quick)
    texts = [Text(f"the step of {method}", step, fused=True)]
    if part in (VECTORS, GLUE):
        from rockeom.integrator.lanes.step import lanes_text, numbers_text

        texts.append(Text("the numbers of lanes", numbers_text(tableau(method), generated)))
        step = lanes_text(tableau(method), generated)
        texts.append(Text(VECTORS, step, fused=True, elsewhere=part != VECTORS))
    return tuple(texts)
