"""The tables of docs/reference-cases.md: the cases and their answers, and each program's errors."""

import math
from collections.abc import Mapping

from benchmarks.engines import cases
from benchmarks.report import scientific, table

MISSED = "missed"
"""An event that a motion has not."""


def answers() -> str:
    """All cases, and each of their answers."""
    head = ("motion", "quantity", "value", "unit", "digits", "sensitivity")
    rows = []
    for case in cases():
        for i, q in enumerate(case["quantities"]):
            rows.append(
                (
                    "" if i else f"`{case['id']}`",
                    f"`{q['name']}`",
                    f"{q['value']!r}",
                    q["unit"],
                    str(q["digits"]),
                    f"{q['sensitivity']:.{0 if q['sensitivity'] >= 10 else 1}f}",
                )
            )
    return table(head, rows)


def descriptions() -> str:
    """The cases in words."""
    lines = []
    for n, case in enumerate(cases(), 1):
        title = f"{case['title'][0].lower()}{case['title'][1:]}"
        how = "Closed form" if case["closed_form"] else "Newton and Euler"
        lines.append(f"{n}. `{case['id']}`: {title}. {case['description']} ({how}.)")
    return "\n".join(lines)


def references(case: Mapping) -> dict[str, float]:
    return {q["name"]: q["value"] for q in case["quantities"] if q["measure"]}


def errors(case: Mapping, row: Mapping) -> dict[str, float]:
    """Relative errors by quantity; infinite where an event is missed."""
    return {
        name: math.inf if row["values"][name] is None else abs(row["values"][name] / value - 1.0)
        for name, value in references(case).items()
    }


def cell(error: float | None) -> str:
    return "failed" if error is None else MISSED if math.isinf(error) else scientific(error)


def order(rows: list[Mapping], found: list[float | None]) -> str:
    """From the last but one step to the last."""
    if len(found) < 2 or not all(e and math.isfinite(e) for e in found[-2:]):
        return ""
    return f"{math.log(found[-2] / found[-1]) / math.log(rows[-2]['step'] / rows[-1]['step']):.1f}"


def worst(case: Mapping, rows: list[Mapping]) -> str | None:
    """The quantity whose error is the largest at the last step that gave values."""
    for row in reversed(rows):
        if "values" in row:
            found = errors(case, row)
            return max(found, key=found.__getitem__)
    return None


def few(names: list[str]) -> str:
    return ", ".join(names) if len(names) < 10 else f"the {len(names)} others"


def of_engine(found: Mapping) -> str:
    """Errors by case and step, each of the worst quantity; and the cases that are left out."""
    steps = sorted({r["step"] for rows in found["cases"].values() for r in rows if "step" in r})
    head = ("motion", "worst quantity", *(f"{s:g} s" for s in reversed(steps)), "order")
    body, left_out = [], {}
    for case in cases():
        rows = found["cases"].get(case["id"], [])
        if not rows:
            continue
        if "unsupported" in rows[0]:
            left_out.setdefault(rows[0]["unsupported"], []).append(f"`{case['id']}`")
            continue
        name = worst(case, rows)
        measured = [errors(case, row)[name] if "values" in row else None for row in rows]
        cells = (*map(cell, measured), order(rows, measured))
        body.append((f"`{case['id']}`", f"`{name}`" if name else "", *cells))
    without = [f"Without {few(names)}: {why}." for why, names in left_out.items()]
    return "\n\n".join([table(head, body), *without])


def side_by_side(found: Mapping, step: float) -> str:
    """The worst relative error of each program at one step."""
    engines = found["engines"]
    body = []
    for case in cases():
        cells = []
        for one in engines.values():
            rows = [r for r in one["cases"].get(case["id"], []) if r.get("step") == step]
            if not rows:
                cells.append("")
            elif "values" not in rows[0]:
                cells.append("failed")
            else:
                cells.append(cell(max(errors(case, rows[0]).values(), default=None)))
        body.append((f"`{case['id']}`", str(len(references(case))), *cells))
    return table(("motion", "measured", *engines), body)


def parts(found: Mapping) -> dict[str, str]:
    """The text between each pair of marks of a page, by the name of the mark."""
    engines = "\n\n".join(
        f"### {name} {one['version']}\n\nModel: {one['settings']}.\n\n{of_engine(one)}"
        for name, one in found["engines"].items()
    )
    lacking = [f"{name} is not installed: {how}." for name, how in found["missing"].items()]
    return {
        "descriptions": descriptions(),
        "answers": answers(),
        "side by side": side_by_side(found, 1e-3),
        "engines": "\n\n".join([engines, *lacking]),
    }


def whole(found: Mapping) -> str:
    return "\n\n".join(parts(found).values())


def marks(name: str) -> tuple[str, str]:
    return f"<!-- table of {name} -->", f"<!-- end of {name} -->"


def between(page: str, name: str) -> tuple[str, str, str]:
    """A page up to a mark, between it and its end, and behind; raises ValueError without them."""
    start, end = marks(name)
    before, at, rest = page.partition(start)
    inside, there, after = rest.partition(end)
    if not at or not there:
        raise ValueError(f"the page has no {start} and {end} between which a table stands")
    return before + start, inside, end + after


def written(found: Mapping, page: str) -> str:
    """A page with all parts between their marks."""
    for name, text in parts(found).items():
        before, _, after = between(page, name)
        page = f"{before}\n\n{text}\n\n{after}"
    return page
