"""Checks of codes against simulation: 20 objects that stand free, under the 44 far-field records.

    python -m benchmarks.codes                              # about a minute
    python -m benchmarks.codes --write docs/codes-and-simulation.md

The simulated PGA are those at which 5 % and half of the motions overturn the object, the latter
with the 95 % interval of `rockeom.assess`. That of a check is where its demand is its limit: each
demand is proportional to the PGA. The peak velocity and the spectrum that checks take are means of
the records, scaled to one PGA.
"""

import argparse
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

import rockeom as rk
from rockeom.analysis import standards
from rockeom.analysis.design import MeanSpectrum
from rockeom.analysis.standards import Check

START, END = "<!-- table of codes -->", "<!-- end of codes -->"
G = 9.81
LEVELS = 1.05, 1.3, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.5, 8.0, 10.0
"""PGA over that of uplift."""
FRICTIONS = 0.2, 0.3, 0.4, 0.5
SHAKING = 0.6 * G
"""PGA of the sliding bodies [m/s2]."""


class Object(NamedTuple):
    """Name, width, height and height of the centroid [m]."""

    name: str
    width: float
    height: float
    centroid: float

    @property
    def block(self) -> rk.RigidBlock:
        return rk.RigidBlock.from_dimensions(
            width=self.width, height=self.height, centroid_height=self.centroid
        )


OBJECTS = (
    Object("vase", 0.18, 0.45, 0.20),
    Object("bronze figure", 0.15, 0.50, 0.24),
    Object("gas cylinder", 0.23, 1.50, 0.70),
    Object("gravestone", 0.20, 1.00, 0.50),
    Object("parapet", 0.25, 0.90, 0.45),
    Object("filing cabinet", 0.45, 1.32, 0.66),
    Object("bookcase", 0.30, 1.80, 0.90),
    Object("wardrobe", 0.60, 2.20, 1.00),
    Object("refrigerator", 0.65, 1.80, 0.80),
    Object("display case", 0.70, 1.60, 0.80),
    Object("server rack", 0.60, 2.00, 1.10),
    Object("switchgear", 0.80, 2.30, 1.15),
    Object("bust, pedestal", 0.35, 1.60, 0.95),
    Object("marble statue", 0.60, 1.80, 0.80),
    Object("chimney", 0.60, 2.40, 1.20),
    Object("wall panel", 0.30, 5.00, 2.50),
    Object("transformer", 1.60, 3.20, 1.40),
    Object("storage cask", 2.40, 5.80, 2.90),
    Object("temple column", 1.20, 7.50, 3.60),
    Object("obelisk", 1.60, 12.0, 4.80),
)


@cache
def records() -> tuple[rk.GroundMotion, ...]:
    """Far-field records, scaled to a PGA of 1 m/s2."""
    names = rk.GroundMotion.library("far field")
    return tuple(rk.GroundMotion.from_library(name).scaled_to(pga=1.0) for name in names)


@cache
def velocity() -> float:
    """Mean peak velocity over the PGA [s]."""
    return float(np.mean([one.peak_velocity for one in records()]))


def checks(block: rk.RigidBlock) -> tuple[Check, ...]:
    """Checks of a block at a PGA of 1 m/s2."""
    spectrum, chain = MeanSpectrum(records()), standards.KinematicChain.from_block(block)
    return (
        standards.west_uplift(block, 1.0),
        standards.ishiyama_overturning(block, 1.0, velocity()),
        standards.mallet_overturning(block, velocity()),
        standards.asce_43_rocking(block, spectrum),
        standards.italy_2009_linear(chain, 1.0),
        standards.italy_2009_nonlinear(chain, block.half_width, spectrum),
    )


def head(check: Check) -> str:
    """Short name of a check, for a narrow column."""
    return check.name.replace(" 2009,", "").replace(", rocking", "")


def row(one: Object) -> tuple[str, ...]:
    """Cells of an object: its size, the PGA at 5 and 50 % by simulation, and by each check [g]."""
    block = one.block
    answer = rk.assess(block, records(), pga=np.array(LEVELS) * block.uplift_accelerations[0])
    few, half = answer.pga_at(0.05), answer.pga_at(0.5)
    assert few is not None, one.name
    assert half is not None, one.name
    value, lower, upper = (f"{x / G:.2f}" for x in half)
    size = f"{one.width:g} x {one.height:g} ({one.centroid:g})"
    limits = (f"{1.0 / check.ratio / G:.2f}" for check in checks(block))
    return one.name, size, f"{few.value / G:.2f}", f"{value} ({lower} to {upper})", *limits


def sliding(friction: float) -> tuple[str, ...]:
    """Cells of a low body: the displacements of the motions, and that of ASCE 43 [m]."""
    body = rk.SlidingBlock(half_width=2.0, half_height=0.5, friction=friction, restitution=0.0)
    motions = [one.scaled_to(pga=SHAKING) for one in records()]
    sweep = rk.simulate_many(
        lambda motion: rk.Case(body, motion, duration=motion.duration + 5.0),
        over={"motion": motions},
        sweep_options=rk.SweepOptions(progress=False),
    )
    slid = np.abs(sweep.peak.sel(state="x").values)
    middle, high = np.quantile(slid, [0.5, 0.84])
    check = standards.asce_43_sliding(friction, 0.0, MeanSpectrum(motions))
    return f"{friction:g}", *(f"{x:.3f}" for x in (middle, high, slid.max(), check.demand))


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def report() -> str:
    """Both tables."""
    names = map(head, checks(OBJECTS[0].block))
    heads = ["object", "size [m]", "5 %", "50 % (interval)", *names]
    slid = ["friction", "median [m]", "84 % [m]", "largest [m]", "ASCE 43, sliding [m]"]
    return f"{table(heads, map(row, OBJECTS))}\n\n{table(slid, map(sliding, FRICTIONS))}"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", type=Path, help="page whose tables are replaced")
    page = parser.parse_args().write
    tables = report()
    if page is None:
        print(tables)
        return
    before, rest = page.read_text(encoding="utf-8").split(START)
    after = rest.split(END)[1]
    page.write_text(f"{before}{START}\n\n{tables}\n\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
