"""``rockeom simulate``: a structure under a ground motion."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rockeom.cli import output
from rockeom.cli.errors import UsageError, numbers
from rockeom.cli.models import add_structure, made
from rockeom.cli.motions import add_motion, motions, shaking
from rockeom.cli.text.options import add_number, add_pairs
from rockeom.files import check_target
from rockeom.integrator.schema import in_space
from rockeom.motion.slope import AXES, SLOPE
from rockeom.numbers.checks import near
from rockeom.simulation.case import Case
from rockeom.simulation.options import METHODS, SolverOptions
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.structures.impact_laws import (
    AngularMomentum,
    EnergyRatio,
    ImpactLaw,
    Impulsive,
    VelocityRatio,
)

DESCRIPTION = """\
Simulate a structure under a ground motion and say in words what happened; with --out,
write the response, a picture and a summary for other programs. All numbers are in SI units
(kg, m, s, N, rad, m/s2); `rockeom models NAME` explains the parameters of a structure.
"""
_USAGE = """\
rockeom simulate NAME --set PARAMETER=VALUE ... [--initial STATE=VALUE ...] [--impact LAW]
         (--motion FILE | --pulse KIND NUMBER=VALUE ... | --record WORD ... | --free)
         [--duration S] [--out DIR] [more options, see --help]
"""
EPILOG = """\
pulses (accelerations in m/s2, or as amplitude=0.3g; times in s; those in brackets may be left out):
  constant             acceleration= duration= [total_duration=]
  half-sine            amplitude= period= [duration=]
  single-sine          amplitude= period= [duration=]
  single-cosine        amplitude= period= [duration=]
  ricker               amplitude= period= [duration=]
  antisymmetric-ricker amplitude= period= [duration=]
  harmonic             amplitude= duration= [phase=] (an angle, rad) and one of
                       frequency= (Hz), angular_frequency= (rad/s), period= (s)

impact laws:
  angular-momentum     conserved about the new pivot, the structure taken as rigid; default of
                       rigid structures
  impulsive            the exact law, also for a flexible structure, whose default it is
  energy-ratio=R       kinetic energies after and before, between 0 and 1
  energy-ratio=R,R     of impacts of the left foot and of the right one
  velocity-ratio=E     angular velocities after and before, between 0 and 1; E squared is R

supports (of flexible_structure, lumped_mass_structure and shear_frame), within --set:
  support=two_springs  foundation_stiffness= foundation_damping= [guided=foot]
  support=winkler      springs= foundation_stiffness= foundation_damping=
  support=sliding      friction= restitution= [law=lzb]; laws: newton (if not given), moreau,
                       poisson, lzb, pairwise

examples:
  rockeom simulate rigid_block --free --duration 10 --set half_width=0.095 half_height=0.45 \\
      --initial theta=0.1 --impact energy-ratio=0.88
  rockeom simulate rigid_block --pulse single-sine amplitude=2.8 period=0.5 \\
      --set half_width=0.095 half_height=0.45 --out block
  rockeom simulate lumped_mass_structure --motion record.AT2 --pga 0.8g --time-scale 0.2 \\
      --set mass=122.6 height=1.05 inertia=44.8 base_mass=45.6 base_height=0.1 \\
      base_inertia=1.37 half_width=0.285 --out column
  rockeom simulate shear_frame --pulse single-sine amplitude=4 period=0.8 \\
      --set masses=20e3,20e3 heights=3.5,7 stiffnesses=2e7,2e7 dampings=12e4,12e4 \\
      half_width=1.2 base_mass=10e3 base_inertia=5e3 \\
      support=winkler springs=4 foundation_stiffness=1e8 foundation_damping=1e5
"""


_PLAIN: dict[str, ImpactLaw] = {"angular-momentum": AngularMomentum(), "impulsive": Impulsive()}
_RATIOS: dict[str, Callable[[float], ImpactLaw]] = {
    "energy-ratio": EnergyRatio,
    "velocity-ratio": VelocityRatio,
}
LAWS = (*_PLAIN, *(f"{ratio}=" for ratio in _RATIOS))
"""The words of --impact."""


def add_case(parser: argparse.ArgumentParser) -> None:
    """The options that `case` reads, and --method."""
    add_structure(parser)
    add_pairs(
        parser,
        "--initial",
        "STATE=VALUE",
        "states at the start, as theta=0.1 [rad] or theta_degrees=6; the others are zero",
    )
    parser.add_argument(
        "--impact",
        metavar="LAW",
        help="what an impact does: angular-momentum, impulsive, energy-ratio=R, velocity-ratio=E",
    )
    add_number(parser, "--duration", "S", "of the simulation [s]")
    add_slope(parser)
    add_azimuth(parser)
    parser.add_argument(
        "--ground-axes", choices=AXES, default=SLOPE,
        help="those of the ground motions: along and normal to the slope, or level and upright",
    )  # fmt: skip
    add_motion(parser.add_argument_group("ground motion (one of the first four)"))
    parser.add_argument(
        "--method",
        choices=METHODS,
        help="of integration; if not given, by the work: DOP853, or Radau where stiff and heavily "
        "damped springs would ask for very many of its steps; the summary says which and why",
    )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_case(parser)
    output = parser.add_argument_group("output")
    output.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="write response.csv, response.png and summary.json into this folder",
    )
    output.add_argument(
        "--format", choices=("csv", "npz"), default="csv", help="of the response; csv if not given"
    )
    add_number(
        output,
        "--output-step",
        "S",
        "largest spacing of the written samples [s]; 1/4000 of the duration if not given",
    )


def run(args: argparse.Namespace) -> int:
    one = case(args)
    if args.out is not None:
        check_folder(args.out)
        if args.out.is_dir():
            for path in _paths(args):
                check_target(path)
    options = SolverOptions(args.method, output_step=args.output_step)
    response = simulate(one, options=options)
    print(output.in_words(response))
    if args.out is not None:
        for path in _write(response, one, args):
            print(f"wrote {path}")
    return 0


def case(args: argparse.Namespace) -> Case:
    """The structure, its motion and its start, of the options of `add_case`."""
    structure = made(args)
    initial = numbers(args.initial, "--initial", "theta=0.1")
    law = impact_law(args.impact)
    motion: Any  # a recording, too
    motion, vertical = (shaking if in_space(structure.module) else motions)(args)
    start = initial or None  # none: at rest in equilibrium, on a slope
    of_ground = {"slope": args.slope, "ground_axes": args.ground_axes, "azimuth": args.azimuth}
    return Case(structure, motion, law, start, args.duration, vertical, **of_ground)


def add_azimuth(parser: argparse.ArgumentParser) -> None:
    """The option for structures in space that are turned."""
    parser.add_argument(
        "--azimuth", metavar="ANGLE", default=0.0,
        help="of the x axis of a structure in space from the first horizontal component, "
        "counter-clockwise seen from above: 30deg, or 0.5rad",
    )  # fmt: skip


def add_slope(parser: argparse.ArgumentParser) -> None:
    """The option for ground that slopes."""
    parser.add_argument(
        "--slope", metavar="SLOPE", default=0.0,
        help="of the ground, which falls to the right: 5deg, 0.09rad, or '1 in 20'",
    )  # fmt: skip


def check_folder(path: Path) -> None:
    """Raise InputError for what cannot become a folder, before anything is simulated."""
    if "\0" in str(path):
        raise UsageError(
            f"--out {str(path)!r}: no folder has a zero byte in its name; leave it out"
        )
    existing = next((p for p in (path, *path.parents) if p.exists()), path)
    if existing.exists() and not existing.is_dir():
        what = "this" if existing == path else str(existing)
        raise UsageError(f"--out {path}: {what} is a file; name a folder")


def _paths(args: argparse.Namespace) -> list[Path]:
    """The files that are written: the response, its picture and its summary."""
    return [args.out / name for name in (f"response.{args.format}", "response.png", "summary.json")]


def _write(response: Response, one: Case, args: argparse.Namespace) -> list[Path]:
    from rockeom.drawing.style import save_figure  # matplotlib takes long

    args.out.mkdir(parents=True, exist_ok=True)
    paths = _paths(args)
    (output.write_csv if args.format == "csv" else output.write_npz)(response, paths[0])
    save_figure(response.plot(), paths[1])
    output.write_json(response, one.impact, one.initial or {}, paths[2])
    return paths


def impact_law(text: str | None) -> ImpactLaw | None:
    """The law that "energy-ratio=0.74" and the like name; None for None.

    Raises InputError naming all laws for another text, and for a ratio that cannot be.
    """
    try:
        return None if text is None else _law(text)
    except UsageError:
        raise
    except ValueError as error:
        raise UsageError(f"--impact {text}: {error}") from None


def _law(text: str) -> ImpactLaw:
    if text in _PLAIN:
        return _PLAIN[text]
    name, sign, value = text.partition("=")
    if name == "energy-ratio" and "," in value:
        left, right = value.split(",", 1)
        feet = numbers([f"left={left}", f"right={right}"], "--impact", "energy-ratio=0.77,0.93")
        return EnergyRatio(**feet)
    if name in _RATIOS and sign:
        return _RATIOS[name](numbers([text], "--impact", f"{name}=0.8")[name])
    raise UsageError(
        f"--impact {text}{near(text, LAWS)}: there are {', '.join(_PLAIN)}, "
        f"{' and '.join(f'{ratio}=NUMBER' for ratio in _RATIOS)}"
    )
