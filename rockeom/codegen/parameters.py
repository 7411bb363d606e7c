"""Functions of the parameters alone: overturning, ratio of rates, sizes, constants."""

import sympy as sp

from rockeom.codegen.outputs import into_out
from rockeom.codegen.printer import statements
from rockeom.codegen.text import Text
from rockeom.symbolic.checks.values import Size, sizes
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.outputs import drawn


def shapes(text: Text) -> dict[str, tuple[str, ...]]:
    """Add the sizes that a sketch shows; returns the tables that name them."""
    bodies = text.model.bodies
    members = [*text.model.members, *(m for m, _ in drawn(text.model))]
    several = [b for b in bodies if b.copies != 1]
    values = [
        *(e for b in bodies for corner in b.outline for e in corner),
        *(e for m in members for e in (*m.start_at, *m.end_at)),
        *(e for b in several for e in (b.copies, b.apart)),
    ]
    text.function(
        "shapes(p, out)",
        """Corners of bodies and ends of members [m], from the centres of bodies in their axes.

    Into out (x, y), in the order of CORNERS and MEMBER_ENDS, and then the number and the distance
    of each of COPIES.""",
        text.evaluate("shapes", into_out(values), "    ") or ["    pass"],
    )
    return {
        "CORNERS": tuple(b.name for b in bodies for _ in b.outline),
        "MEMBERS": tuple(m.kind for m in members),
        "MEMBER_ENDS": tuple(name for m in members for name in (m.start, m.end)),
        "COPIES": tuple(b.name for b in several),
    }


def functions_of_parameters(text: Text) -> None:
    """Comes last: `prepare` computes the constants that all others have named."""
    described = "Rotation at which the structure has overturned."
    _scalar(text, "overturning", described, text.model.overturning)
    _falls(text)
    _velocity_ratio(text)
    _sizes(text)
    _prepare(text)


def sizes_to_check(model: HybridModel) -> list[Size]:
    """Sizes that the signs of the parameters do not settle."""
    return [size for size in sizes(model) if not (size.may_vanish and size.value.is_nonnegative)]


def _falls(text: Text) -> None:
    """Sizes at which further coordinates have overturned."""
    if not text.model.falls:
        return
    lines = ["    value = 0.0"]
    for i, size in enumerate(text.model.falls.values()):
        evaluation = text.evaluate("overturns_at", {"value": size}, " " * 8)
        lines += [f"    if number == {i}:", *evaluation]
    text.function(
        "overturns_at(number, p)",
        "Size of a coordinate of FALLS, by its number, at which the structure has overturned.",
        [*lines, "    return value"],
    )


def _velocity_ratio(text: Text) -> None:
    ratio = text.model.velocity_ratio
    described = "Ratio of the rates of rotation at an impact of the structure taken as rigid."
    if ratio is sp.nan:
        text.function("velocity_ratio(p)", "Each foot has its own ratio.", ["    return math.nan"])
    else:
        value = sp.Integer(1) if ratio is None else ratio
        _scalar(text, "velocity_ratio", described, value)


def _sizes(text: Text) -> None:
    targets = {f"out[{i}]": size.value for i, size in enumerate(sizes_to_check(text.model))}
    text.function(
        "sizes(p, out)",
        "Values that must be positive, or not negative, into out, as SIZES.",
        text.evaluate("sizes", targets, "    ") or ["    pass"],
    )


def _scalar(text: Text, name: str, doc: str, value: sp.Expr) -> None:
    lines = text.evaluate(name, {"value": value}, "    ")
    text.function(f"{name}(p)", doc, [*lines, "    return value"])


def _prepare(text: Text) -> None:
    """The function that appends the constants to the parameters."""
    constants = text.constants.names
    first = len(text.parameters)
    total = first + len(constants)
    targets = {f"p[{first + i}]": e for i, e in enumerate(constants)}
    lines, before, after = statements(targets, "    ")
    text.count("prepare", before, after)
    used = {str(x) for e in constants for x in e.free_symbols}
    text.function(
        "prepare(parameters)",
        f"Parameters ({first},) with the constants that follow from them: p ({total},).",
        [
            f"    p = np.empty({total})",
            f"    p[:{first}] = parameters",
            *(f"    {n} = parameters[{i}]" for i, n in enumerate(text.parameters) if n in used),
            *lines,
            "    return p",
        ],
    )
