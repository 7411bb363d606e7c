"""python -m tests.impacts [COUNT]: gains of energy in random landings, and the package."""

import sys
import time

from tests.impacts.energy import (
    LAWS,
    block_on_unequal_feet,
    body_on_floor_and_wall,
    count_gains,
    double_pendulum,
)
from tests.impacts.mechanics import block
from tests.impacts.shipped import LAWS_OF_PACKAGE, package_study


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    print(f"{count} random landings; changes of kinetic energy over that before")
    print(f"{'law':24s}{'range':>9s}{'impacts':>9s}{'undecided':>11s}{'gains':>7s}{'largest':>12s}")
    for law in LAWS:
        for name, of in zip(("inside", "outside"), count_gains(law, 1, count), strict=True):
            print(
                f"{law:24s}{name:>9s}{of.impacts:9d}{of.undecided:11d}{of.gains:7d}{of.largest:12.3e}",
                flush=True,
            )
    print("\nexamples of a gain")
    for what, law, problem in (
        ("double pendulum, e = mu = .5", "newton", double_pendulum()),
        ("body on floor and wall, e = 1 and 0", "moreau", body_on_floor_and_wall()),
        ("block on unequal feet, e = 1 and 0", "poisson, two problems", block_on_unequal_feet()),
        ("block on level feet, e = 1", "poisson, path",
         block(0.25, 0.65, [-0.6, -1.4, -2.0], friction=0.5, restitution=1.0)),
    ):  # fmt: skip
        changes = [f"{100 * problem.gain(v):+.2f} %" for v in LAWS[law](problem)]
        print(f"{law:24s}{what:40s}{', '.join(changes)}")
    print("\nthe package, compiled: landings of a block on level feet")
    print(
        f"{'law':12s}{'range':>9s}{'impacts':>9s}{'gains':>7s}{'largest':>12s}{'difference':>12s}"
    )
    for law in LAWS_OF_PACKAGE:
        start = time.process_time()
        for row in package_study(law, 2, count):
            print(row, flush=True)
        print(f"{'':12s}{time.process_time() - start:.0f} s")


if __name__ == "__main__":
    main()
