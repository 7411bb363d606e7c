"""``rockeom animate``: a simulation as a film."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from rockeom.cli.simulate import add_case, case
from rockeom.cli.text.options import add_number
from rockeom.drawing.animation import FILES, Animation, animate, check_file
from rockeom.drawing.scene import VIEW, view_from
from rockeom.integrator.schema import in_space
from rockeom.motion.slope import azimuth_angle
from rockeom.numbers.checks import InputError
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.simulate import simulate

DESCRIPTION = """\
Simulate a structure and draw its motion to scale above the moving ground, as a film: .gif, .html
(a page with a slider) or .mp4 (needs ffmpeg). The options of the structure, its motion and its
start are those of rockeom simulate, whose help lists pulses, impact laws and supports.
"""
_USAGE = f"""\
rockeom animate NAME --set PARAMETER=VALUE ... [--initial STATE=VALUE ...] [--impact LAW]
         (--motion FILE | --pulse KIND NUMBER=VALUE ... | --record WORD ... | --free)
         --out FILE{"|".join(FILES)} [--start S] [--end S] [--speed X] [more options, see --help]
"""
EPILOG = """\
examples:
  rockeom animate rigid_block --free --duration 5 --set half_width=0.095 half_height=0.45 \\
      --initial theta=0.15 --out block.gif
  rockeom animate rigid_block --record El Centro 1940 180 --pga 0.7g \\
      --set half_width=0.2 half_height=0.9 --end 12 --out block.html
  rockeom animate rigid_block --pulse single-sine amplitude=4 period=0.8 --duration 4 \\
      --set half_width=0.2 half_height=0.9 --speed 0.25 --out slow.mp4
  rockeom animate prism --set width=0.5 depth=0.7 height=3 mass=2000 --record El Centro 1940 \\
      --pga 0.5g --azimuth 60deg --end 6 --view 30deg 20deg --out statue.gif
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = _USAGE
    add_case(parser)
    film = parser.add_argument_group("film")
    film.add_argument(
        "--out", type=Path, required=True, metavar="FILE", help=f"the film: {', '.join(FILES)}"
    )
    add_number(film, "--start", "S", "of what is shown [s]")
    add_number(film, "--end", "S", "of what is shown [s]")
    add_number(film, "--speed", "X", "of the film; 0.25 is slow motion", default=1.0)
    add_number(film, "--frames-per-second", "N", "20 if not given", default=20.0)
    film.add_argument(
        "--view", nargs=2, metavar=("AZIMUTH", "ELEVATION"),
        help="from which a structure in space is seen, such as 30deg 20deg",
    )  # fmt: skip


def _view(args: argparse.Namespace, one: Case) -> Sequence[float]:
    """The view that was given [rad], or the usual one."""
    if args.view is None:
        return VIEW
    if not in_space(one.structure.module):
        raise InputError("--view", " ".join(args.view)).so("it moves in a plane: leave it out")
    view = [float(azimuth_angle(angle, "--view")) for angle in args.view]
    view_from(view)
    return view


def run(args: argparse.Namespace) -> int:
    one = case(args)
    view = _view(args, one)
    check_file(args.out)  # before the simulation, not after
    response = simulate(one, options=SolverOptions(args.method))
    print(response.outcome.sentence)
    last = float(response.t[-1])
    if args.end is not None and last < args.end <= response.duration:
        print(f"It ends there, at {last:.4g} s.")  # before the shaking, as who overturns
        args.end = last
    film: Animation = animate(
        response,
        start=args.start,
        end=args.end,
        speed=args.speed,
        frames_per_second=args.frames_per_second,
        view=view,
    )
    film.save(args.out)
    print(f"wrote {args.out}: {len(film)} frames, {len(film) / film.frames_per_second:.4g} s")
    return 0
