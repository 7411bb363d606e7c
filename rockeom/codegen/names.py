"""Names in the generated text: a user's can never be one of the program's own.

A user's name is written as it is, unless the program has the name itself or it is given already;
then it ends with underscores, and no name of the program does. `check_names` proves it of a text:
each name in it is one that was given here, or one of those declared here as the program's own.
"""

import ast
import keyword
import re
import unicodedata

_PROGRAM = """
abs float max min np math range __debug__

accelerations elements energies guards full_contact_guards jump kinematics masses momentum
opening_acceleration overturning positions powers prepare rates reactions shapes sine_cosine
sizes statics velocity_ratio inlined everywhere overturns_at

free_motion points point_laws point_numbers

mode s y p ax ay az dy g i number out law ratio guard load found value parameters total_gravity
matrix forces pattern equations

CLASS REVERSE MODES COPIES CORNERS ELEMENT_NAMES ENERGIES FALLS GROUND GUARDS HAS_IMPULSIVE
FULL_CONTACT IMPACT_LAW IMPULSIVE KINDS KINEMATICS MEMBERS MEMBER_ENDS NAME N_FALLS N_GUARDS N_PARTS
N_STATES LOCALISED
PARAMETERS PARAMETER_MEANINGS PARAMETER_SIGNS PARAMETER_UNITS PARTS POSITIONS POSITION_KINDS
RATIO REACTIONS ROTATION ROTATION_RATE SIDES SIZES SOURCE_HASH STATES STATE_UNITS TARGETS
TRANSITIONS

BOUNDS ELEMENTS ELEMENT_STATES EQUATIONS FEET_OF HELD_ACROSS IMAGES N_ELEMENTS N_INTERNAL
N_POINTS PATTERNS POINTS TIES POINT_STATES QUICK SHARED SIGMAS SUBJECTS

guards_in_code motion_in_code move_by_squares press_by_squares gaps_of_points rows_in rows pivots
squares slips_in solve_mode digit_of tables_by_code told share bears
BY_CODE FIRST_BOUND IDLES SMOOTH N_BOUNDS_OF_DECLARATION
"""
"""Names of Python and its libraries, of functions, their arguments and tables in the text."""
WORDS = frozenset(_PROGRAM.split())

_PATTERNS = re.compile(
    r"[xcfr]\d+|[ml]\d\d+|share_\d+(_\d+)?|angle_\d+"  # intermediate results
    r"|(sigma|chi|tie|drift|speed|normal|friction|total|part|det)_\d+(_\d+)?"
    r"|(sin|cos)_.*[^_]|.*_(ddot|after|alone)"  # what belongs to a coordinate
    r"|(accelerations|impulse|rates|forces)_.*[^_]",
    re.DOTALL,
)

_FEET = re.compile(r"(LEFT|RIGHT|BOTH|FLIGHT)(_[A-Z0-9]+)*")
"""Modes that are written without an underscore at their end: no other text that is joined
to the module begins a name like that."""


def is_own(name: str) -> bool:
    """Whether a name is reserved for the program itself."""
    return keyword.iskeyword(name) or name in WORDS or bool(_PATTERNS.fullmatch(name))


class Names:
    """The names given to what the user has named, each once."""

    def __init__(self) -> None:
        self.taken: set[str] = set()

    def of(self, name: str) -> str:
        """The Python name of a parameter or state."""
        name = unicodedata.normalize("NFKC", name)  # as Python reads it
        while is_own(name) or name in self.taken:
            name += "_"
        self.taken.add(name)
        return name

    def of_mode(self, mode: str) -> str:
        """The name of the constant that is the number of a mode."""
        name = unicodedata.normalize("NFKC", mode.upper())
        return self.of(name if _FEET.fullmatch(name) else f"{name}_")


def names_in(text: str | ast.Module) -> set[str]:
    """All names of variables, arguments, functions and imports in a text."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(text) if isinstance(text, str) else text):
        if isinstance(node, ast.Name):
            names.add(node.id)
        elif isinstance(node, ast.arg):
            names.add(node.arg)
        elif isinstance(node, ast.FunctionDef):
            names.add(node.name)
        elif isinstance(node, ast.alias):
            names.add(node.asname or node.name)
    return names


def check_names(text: str, names: set[str]) -> None:
    """Raise AssertionError if a module's text has a name that is neither given nor its own.

    Otherwise that name could be a user's, too: it belongs into the lists above.
    """
    strange = sorted(name for name in names_in(text) - names if not is_own(name))
    if strange:
        raise AssertionError(f"names of the generated text that users may give: {strange}")
    mixed = sorted(name for name in names if is_own(name))
    if mixed:
        raise AssertionError(f"given to what users named, and the program's own: {mixed}")


_LETTERS = {"\n": "\n", "\\": "\\\\"}


def _letter(c: str) -> str:
    return c if c.isprintable() else c.encode("unicode_escape").decode("ascii")


def docstring(text: str, indent: str = "") -> str:
    """A docstring that says `text`, whatever letters that has."""
    # A lone surrogate is shown by its escape: Python 3.13 compiles no docstring that has one.
    text = text.encode("utf-8", "backslashreplace").decode("utf-8")
    written = "".join(_LETTERS.get(c) or _letter(c) for c in text).replace('"""', r"\"\"\"")
    if written.endswith('"'):
        written = f'{written[:-1]}\\"'
    end = f"\n{indent}" if "\n" in text and not text.endswith("\n") else ""
    return f'{indent}"""{written}{end}"""'


def string(text: str) -> str:
    """A string literal of one line."""
    return '"' + "".join(_letter(c) for c in text.replace("\\", "\\\\").replace('"', r"\"")) + '"'
