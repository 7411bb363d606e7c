"""Pages in real browsers: motions at random places of the sliders, compared with `rk.simulate`.

python -m tests.browser.browsers [NAME ...]   all structures in each browser; half an hour

A page is served by this process with a few lines more, which run the motions and send them back. So
any browser does that opens an address; it needs no driver.
"""

import base64
import contextlib
import hashlib
import json
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, NamedTuple

import numpy as np

import rockeom as rk
from rockeom.browser.page import Explorer
from rockeom.browser.program import METHOD
from rockeom.browser.traced import UntracedError
from rockeom.codes import OUTCOMES
from rockeom.integrator.schema import ground_axes, in_space
from rockeom.structures.classes import SHIPPED
from rockeom.sweeps.case_numbers import of_structure
from rockeom.symbolic import parameter
from tests.contact import declared
from tests.docs.test_docs import _module as docs_module
from tests.shipped import plain

BROWSERS = {
    "chromium": ["--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir={}",
                 "--no-first-run", "--disable-background-networking", "--disable-component-update",
                 "--disable-sync"],
    "firefox-esr": ["--headless", "--no-remote", "--profile", "{}"],
}  # fmt: skip
PLACES = 300
SAME = 1e-9
"""Difference of the largest rotations of two motions that are the same [rad], and relative to those
beyond 1."""
SAME_IN_SPACE = 1e-6
"""The same in space, where rounding may let a step be refused: motions then differ by its error."""
NEXT = 1.0 + 1e-12
"""A motion is sensitive if this factor of the ground motion changes it by more than `SAME`."""

_MOTIONS = """
(async () => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const module = await WebAssembly.compile(await unpacked(data.program));
  const runner = new Runner(module, data.of);
  const motions = PLACES.map((values) => {
    const fate = runner.follow(values);
    return [fate, Array.from(runner.readings), runner.run(values)];
  });
  await fetch("/results", { method: "POST", body: JSON.stringify(motions) });
})().catch((error) => fetch("/results", { method: "POST", body: JSON.stringify(String(error)) }));
"""


class Motion(NamedTuple):
    """A motion of a page: its outcome, when it is only followed and when it is recorded, and the
    readings of the page, of which the second is the largest rotation."""

    outcome: str
    recorded: str
    readings: list[float]


def answered(html: str, browser: str, seconds: float = 300.0) -> Any:
    """What a page sends to /results when a browser opens it."""
    found: list[Any] = []
    done = threading.Event()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self._reply("text/html; charset=utf-8", html.encode())

        def do_POST(self) -> None:
            found.append(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
            self._reply("text/plain", b"")
            done.set()

        def _reply(self, kind: str, body: bytes) -> None:
            self.send_response(200)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: Any) -> None:
            pass

    with (
        ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server,
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
    ):
        threading.Thread(target=server.serve_forever, daemon=True).start()
        options = [option.format(folder) for option in BROWSERS[browser]]
        address = f"http://127.0.0.1:{server.server_port}/"
        process = subprocess.Popen(
            [browser, *options, address], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        try:
            assert done.wait(seconds), f"{browser} sent nothing within {seconds:g} s"
        finally:
            process.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(20)
            server.shutdown()
    (result,) = found[:1]
    assert not isinstance(result, str), result
    return result


def native(page: Explorer, samples: int = 0) -> Callable[..., dict[str, Any]]:
    """The motions of a page by machine code: the arrays that its program fills, by name.

    A function of the values of all controls, and of the time until which a motion goes on.
    """
    module = page.case(**page.controls.named(page.controls.start)).structure.module
    program, states = page.program.native(module), len(module.STATES)
    axes = len(ground_axes(module))

    def motion(place: Any, end: float = 0.0) -> dict[str, Any]:
        arrays = {
            "sliders": np.array(place, float), "end": end, "p": np.zeros(page.setup.sizes[0]),
            "numbers": np.zeros(page.setup.sizes[1]), "states": np.zeros((samples, states)),
            "modes": np.zeros(samples, np.int64), "ground": np.zeros((axes, samples)),
            "impacts": np.zeros(10), "spacing": np.zeros(3), "readings": np.zeros(5),
        }  # fmt: skip
        outcome = OUTCOMES.get(int(program.motion(*arrays.values())), "unknown")
        return {**arrays, "outcome": outcome, "program": program}

    return motion


def with_script(html: str, script: str) -> str:
    """A page with another script, which its policy allows, and which may send what it finds."""
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    allowed = html.replace("script-src", f"connect-src 'self'; script-src 'sha256-{digest}'", 1)
    return allowed.replace("</body>", f"<script>{script}</script></body>")


def motions(page: Explorer, places: np.ndarray, browser: str) -> Iterator[Motion]:
    """Motions of a page in a browser."""
    html = with_script(page.html, _MOTIONS.replace("PLACES", json.dumps(places.tolist())))
    for fate, readings, recorded in answered(html, browser):
        yield Motion(OUTCOMES.get(fate, "unknown"), OUTCOMES.get(recorded, "unknown"), readings)


def random_places(page: Explorer, n: int) -> np.ndarray:
    """Random values of all controls, of the hidden one as it is at first."""
    rng = np.random.default_rng(len(page.controls.of))
    shares = rng.random((n, len(page.controls.of)))
    controls = page.controls.of.values()
    rows = [[c.at(x) for c, x in zip(controls, row, strict=True)] for row in shares]
    hidden = page.setup.controls.start[len(page.controls.of) :]
    return np.array([[*row, *hidden] for row in rows])


def of_python(page: Explorer, place: np.ndarray, factor: float = 1.0) -> tuple[str, float]:
    """Outcome and largest rotation by `rk.simulate`, the ground motion times a factor.

    A case that is refused is unknown to the page.
    """
    try:
        case = page.case(**page.controls.named(place[: len(page.controls.of)]))
        case.problem()
    except ValueError:
        return "unknown", 0.0
    motion = case.motion if factor == 1.0 else case.motion.scaled(factor)
    run = rk.simulate(replace(case, motion=motion), options=rk.SolverOptions(method=METHOD))
    return str(run.outcome), abs(run.extremes(run.states[run.structure.module.ROTATION]).peak)


def report(name: str, page: Explorer, browser: str) -> bool:
    """Print how the motions of a page agree with Python; whether the page is right."""
    places = random_places(page, PLACES)
    wrong, sensitive, exact, of_machine = 0, 0, 0, native(page)
    same = SAME_IN_SPACE if page._spatial else SAME
    for place, motion in zip(places, motions(page, places, browser), strict=True):
        of_page = of_machine(place)
        readings = np.array(motion.readings, float)
        exact += motion.outcome == of_page["outcome"] and np.array_equal(
            readings, of_page["readings"], equal_nan=True
        )
        outcome, peak = of_python(page, place)
        near = outcome == "unknown" or abs(motion.readings[1] - peak) <= same * max(peak, 1.0)
        if motion.outcome == motion.recorded == outcome and near:
            continue
        other, moved = of_python(page, place, NEXT)
        if other != outcome or abs(moved - peak) > same * max(peak, 1.0):
            sensitive += 1
        else:
            wrong += 1
        print(f"  {name} at {place.tolist()}: {motion} not {outcome}, {peak!r}; {moved!r} next to")
    print(
        f"{name} in {browser}: {PLACES - wrong - sensitive} of {PLACES} the same, {sensitive} "
        f"sensitive, {wrong} differ; {exact} with the bits of machine code; "
        f"{len(page.html) / 1e3:.0f} kB",
        flush=True,
    )
    return wrong == 0 and exact == PLACES and sensitive <= 0.05 * PLACES


def pages() -> dict[str, rk.Case]:
    """A case of each shipped structure, of frames on three supports and of a declared block."""
    pulse = rk.GroundMotion.half_sine(1.0, 0.8, duration=5.0)
    structures: dict[str, rk.Structure] = {n: cls(**plain(n)) for n, cls in SHIPPED.items()}
    frame = {
        "masses": [20e3] * 3, "heights": [3.5, 7.0, 10.5], "stiffnesses": [2e7] * 3,
        "dampings": [12e4] * 3, "half_width": 2.0, "base_mass": 10e3, "base_inertia": 5e3,
    }  # fmt: skip
    structures["frame of three storeys"] = rk.ShearFrame(**frame)
    bed = rk.Winkler(springs=5, stiffness=2e7, damping=2e4)
    structures["frame on a bed"] = rk.ShearFrame(**frame, support=bed)
    structures["frame that slides"] = rk.ShearFrame(
        **frame, support=rk.Sliding(friction=0.3, restitution=0.0)
    )
    structures["declared block that slides"] = _declared_block()
    structures["prism"] = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)
    structures["prism that slides"] = replace(structures["prism"], height=1.0, friction=0.3)
    return {
        name: rk.Case(structure, pulse, azimuth=0.3 if in_space(structure.module) else 0.0)
        for name, structure in structures.items()
    }


def _declared_block() -> rk.Structure:
    """A block on feet that slide, declared by a user."""
    b = parameter("b", "half_width", "m", "half of the distance of the feet")
    feet = {"left": (-b.symbol, 0), "right": (b.symbol, 0)}
    return rk.structure(
        declared.on_points("declared_sliding_block", feet, b), mass=1.0, half_width=0.2,
        height=0.7, inertia=0.18, gravity=9.81, friction=0.4, restitution=0.0,
    )  # fmt: skip


def page_of(case: rk.Case) -> Explorer:
    """A page with the amplitude and two parameters of the structure."""
    module = case.structure.module
    least = case.structure.uplift_acceleration or 5.0
    lengths = [
        (name, number.value)
        for name, number in of_structure(case.structure).items()
        if number.value and number.unit in ("m", "kg", "N/m", "-") and number.smooth
    ][:2]
    sliders = {"amplitude": (0.5 * least, 3.0 * least)}
    sliders |= {"azimuth": (0.0, 1.5)} if in_space(module) else {}
    sliders |= {name: (0.8 * value, 1.25 * value) for name, value in lengths}
    return rk.explorer(case, sliders, module.NAME)


def main() -> int:
    asked = sys.argv[1:]
    right = True
    explorers = docs_module("explorers")
    made = {name: partial(page_of, case) for name, case in pages().items()}
    made |= {name: partial(explorers.in_space, name) for name in explorers.IN_SPACE}
    for name, make in made.items():
        if asked and name not in asked:
            continue
        page = make()
        try:
            _ = page.html
        except UntracedError as error:
            print(f"{name} has no page: {error}", flush=True)
            right = False
            continue
        for browser in filter(shutil.which, BROWSERS):
            right &= report(name, page, browser)
    return not right


if __name__ == "__main__":
    sys.exit(main())
