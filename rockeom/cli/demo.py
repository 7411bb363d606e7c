"""The steel column of McManus (1980) under El Centro 1940: ``python -m rockeom.cli.demo``.

Its equations are derived, the generated code is compared with them, and it is simulated as a
flexible structure on two feet and as a rigid one, as in the thesis, 5.3.1.1 and 5.3.3: time scaled
to 1/5 and the largest acceleration to 0.8 g. A picture, tables and a summary are written.
"""

import argparse
import sys
import textwrap
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import rockeom as rk
from rockeom.cli import output
from rockeom.codegen import write as generated
from rockeom.drawing.style import save_figure
from rockeom.files import write
from rockeom.plots import plot_comparison
from rockeom.symbolic import derive

COLUMN = {
    "mass": 122.6,
    "height": 1.05,
    "inertia": 44.8,
    "base_mass": 45.6,
    "base_height": 0.10,
    "base_inertia": 1.37,
    "half_width": 0.285,
}
"""In SI units; one choice that meets what the thesis states of the specimen."""
STIFFNESS, DAMPING = 571.8e3, 502.4  # of the column [N/m], [N s/m]
TIME_SCALE, PEAK = 0.2, 0.8 * 9.81  # [-], [m/s2]
SHOWN = 6.0  # [s], what follows is small


def main(argv: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m rockeom.cli.demo", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out"), metavar="DIR", help="default: out")
    folder: Path = parser.parse_args(argv).out
    print("A steel column that stands free on two feet, in the El Centro earthquake of 1940.\n")
    try:
        motion = el_centro()
        folder.mkdir(parents=True, exist_ok=True)
        derive_and_check(folder / "equations.txt")
        start = time.perf_counter()
        runs = simulate_all(motion)
    except (rk.InputError, OSError) as error:
        print(f"rockeom.cli.demo: {error}", file=sys.stderr)
        return 2
    print("3. Simulated the column under the record, its time scaled to 1/5 and its peak to 0.8 g,")
    print(f"   through every uplift and impact, in {time.perf_counter() - start:.1f} s:\n")
    print(textwrap.indent(short(runs), "   "))
    for name, run in runs.items():
        output.write_csv(run, folder / f"{name.replace(', ', '_').replace(' ', '_')}.csv")
    write(folder / "summary.txt", in_words(motion, runs) + "\n")
    draw(runs, folder / "el_centro.png")
    print(f"\n4. Drew {folder / 'el_centro.png'}; summary.txt and three .csv files are next to it.")
    print(_NEXT, end="")
    return 0


_NEXT = """
Next: rockeom --help    lists the commands
      rockeom models    lists the structures
"""


def derive_and_check(path: Path) -> None:
    """Write the derived equations to a file, and compare the generated code with them."""
    start = time.perf_counter()
    model = derive("flexible_structure")
    write(path, f"{model}\n")
    print(f"1. Derived the equations of motion, impacts and uplift of {model.name} from")
    print(f"   the positions of its masses, in {time.perf_counter() - start:.1f} s: {path}")
    if not generated.GENERATED.is_dir():
        print("2. There is no checkout of rockeom whose generated code could be compared.")
    elif generated.check_generated(generated.GENERATED, [model.name]):
        print(
            f"2. The code in generated/ differs from them: rockeom generate {model.name} mends it."
        )
    else:
        print("2. Compared the generated code, which is simulated, with them: they agree.")


def el_centro() -> rk.GroundMotion:
    """El Centro 1940, component 180, scaled as in the thesis, 5.3.1.1."""
    record = rk.GroundMotion.from_library("El Centro 1940 180")
    return record.scaled(acceleration=PEAK / record.peak, time=TIME_SCALE)


def simulate_all(motion: rk.GroundMotion) -> dict[str, rk.Response]:
    """The rigid structure, and the flexible one under two laws of impact, by name."""
    rigid = rk.LumpedMassStructure(**COLUMN)
    flexible = rk.FlexibleStructure(**COLUMN, stiffness=STIFFNESS, damping=DAMPING)
    cases: dict[str, tuple[rk.Structure, rk.AngularMomentum | rk.Impulsive]] = {
        "rigid": (rigid, rk.AngularMomentum()),
        "flexible, angular momentum": (flexible, rk.AngularMomentum()),
        "flexible, impulsive": (flexible, rk.Impulsive()),
    }
    runs = {}
    for name, (structure, law) in cases.items():
        runs[name] = rk.simulate(structure, motion, impact=law)
    return runs


def picture(runs: dict[str, rk.Response]):
    """Displacement, uplift and impacts of all runs."""
    return plot_comparison(
        list(runs.values()),
        list(runs),
        end=SHOWN,
        title="Steel column on two feet under El Centro 1940 (180), time scaled to 1/5, peak 0.8 g",
    )


def draw(runs: dict[str, rk.Response], path: Path, **options: Any) -> None:
    """Save the picture with what it shows as its description, see `shown`."""
    save_figure(picture(runs), path, metadata={"Description": shown(runs)}, **options)


def shown(runs: dict[str, rk.Response]) -> str:
    """Peaks and impacts of the picture, a line each: by them a copy of it is compared with it."""
    lengths = ("displacement", "left_uplift", "right_uplift")
    return "\n".join(
        ", ".join(
            [f"{name}: {run.impacts.describe()}"]
            + [f"{length} {1e3 * abs(output.peak(run, length)[0]):.3g} mm" for length in lengths]
        )
        for name, run in runs.items()
    )


def short(runs: dict[str, rk.Response]) -> str:
    """The largest displacement and uplift, impacts and end of each run as a table."""
    rows = [("column taken as", "largest displacement", "uplift", "impacts", "end")]
    for name, run in runs.items():
        x, t = output.peak(run, "displacement")
        uplift = max(run.extremes(f"{foot}_uplift").maximum for foot in ("left", "right"))
        rest = run.events.rest_time
        end = str(run.outcome) if rest is None else f"came to rest at {rest:.4g} s"
        fast = len(run.impacts.above())
        rows.append(
            (name, f"{1e3 * x:.3g} mm at {t:.3g} s", f"{1e3 * uplift:.3g} mm", f"{fast}", end)
        )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    friction = max(run.support.friction_demand for run in runs.values())
    lines = [
        "  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    lines += ["", f"No foot slides where the coefficient of friction is at least {friction:.3g}."]
    return "\n".join(lines)


def in_words(motion: rk.GroundMotion, runs: dict[str, rk.Response]) -> str:
    """Peaks, uplifts, impacts, outcome and assumptions of all runs."""
    parts = [
        f"{motion.name}\nTime scaled to 1/5, largest acceleration {motion.peak:.4g} m/s2 (0.8 g), "
        f"{motion.duration:.4g} s."
    ]
    for name, run in runs.items():
        uplifts = sum(event.kind == "uplift" for event in run.events)
        _, *lines = output.in_words(run).split("\n")
        lines.append(f"Rocking began {uplifts} times from full contact.")
        parts.append("\n".join([f"{name}:", *(f"  {line}" for line in lines)]))
    parts.append(_compared(runs))
    return "\n\n".join(parts)


def _compared(runs: dict[str, rk.Response]) -> str:
    rigid, *flexible = (abs(output.peak(run, "displacement")[0]) for run in runs.values())
    ratios = " and ".join(f"{x / rigid:.2f}" for x in flexible)
    return (
        f"The load point of the flexible column moves {ratios} times as far as that of the rigid "
        "one, under angular momentum\n(the thesis's rule of impact) and the impulsive law in turn."
    )


if __name__ == "__main__":
    sys.exit(main())
