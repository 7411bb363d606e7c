"""UNAM, Mexico, the standard file 2.0: a header of 109 lines, columns of the channels in gal."""

import re
from collections.abc import Sequence

from rockeom.files import in_text
from rockeom.motion.components import azimuth_and_vertical
from rockeom.motion.formats.grammar import Component, Page, Peak, columns_of, in_si
from rockeom.motion.formats.text import short
from rockeom.numbers.callers import warn_caller


def recognises(head: Sequence[str]) -> bool:
    return any(line.startswith("ARCHIVO ESTANDAR DE ACELERACION") for line in head[:10])


def components(page: Page, gravity: float) -> list[Component]:
    """All components of a file."""
    head = next(
        (n for n, line in enumerate(page.lines, 1) if line.startswith("DATOS DE ACELERACION:")),
        None,
    )
    if head is None:
        raise page.error(None, "no line DATOS DE ACELERACION: in front of the values")

    def stated(label: str) -> tuple[int, str]:
        n, found = page.find(rf"^{re.escape(label)}\s*:\s*(.*?)\s*$", label, 1, head)
        return n, found[1]

    def each(label: str) -> tuple[int, list[str]]:
        n, text = stated(label)
        more = label.replace("C1-C6", "C7-C12")
        if any(line.startswith(more) for line in page.lines[:head]):
            text = f"{text.strip('/')}/{stated(more)[1].strip('/')}".rstrip("/")
        return n, [part.strip() for part in text.removeprefix("/").split("/")]

    n, unit = stated("UNIDADES DE LOS DATOS")
    if not unit.startswith("Gal"):
        raise page.error(n, f"the unit is {short(unit)}, not Gal")
    line, oriented = each("ORIENTACION C1-C6 (rumbo;orientacion)")
    names = [one.partition(";")[0].removeprefix("+") for one in oriented]
    for name in names:
        if azimuth_and_vertical(name) == (None, False):
            raise page.error(line, f"the direction is {short(name)}, not V or such as N90E")
    fields = {
        "steps": each("INTERVALO DE MUESTREO, C1-C6 (s)"),
        "counts": each("NUM. TOTAL DE MUESTRAS, C1-C6"),
        "peaks": each("ACEL. MAX.(Gal), C1-C6"),
    }
    for n, values in fields.values():
        if len(values) != len(names):
            raise page.error(n, f"{len(values)} values for {len(names)} channels of line {line}")
    n, form = stated("FORMATO DATOS (FORTRAN,10 campos/dato)")
    columns = columns_of(page, n, form)
    if len(columns) != len(names):
        raise page.error(n, f"the format is {short(form)}, for {len(names)} channels")
    for n, values in (fields["steps"], fields["counts"]):
        if len(set(values)) > 1:
            raise page.error(n, f"the channels differ here, {', '.join(values)}, and must not")
    dt = page.positive(fields["steps"][0], fields["steps"][1][0], "the step")
    count = page.whole(fields["counts"][0], fields["counts"][1][0], "the number of values")
    above = page.match(head + 3, r"^\s*(.*?)\s*$", "the directions")[1].split()
    if [one.partition(";")[0].removeprefix("+") for one in above] != names:
        raise page.error(
            head + 3, f"the directions are not those of line {line}, {', '.join(names)}"
        )
    table, after = page.fixed(head + 5, count * len(names), columns, "value")
    end = after
    while after <= len(page) and page.lines[after - 1].strip():
        _, after = page.fixed(after, len(names), columns, "value")
    page.ends(after)
    if after > end:
        warn_caller(
            f"{in_text(page.path).name}: the header counts {count} rows, and {after - end} more "
            f"from line {end} on are left out"
        )
    n, peaks = fields["peaks"]
    station, date = stated("CLAVE DE LA ESTACION")[1], stated("FECHA DEL SISMO [GMT]")[1]
    event = f"{date} {stated('HORA EPICENTRO (GMT)')[1]}"
    return [
        Component(
            in_si(column, "gal", gravity), dt, name, "gal", 1, station=station, event=event,
            peak=Peak(peak, "gal", n),
        ).directed()
        for name, peak, column in zip(names, peaks, table.reshape(-1, len(names)).T, strict=True)
    ]  # fmt: skip
