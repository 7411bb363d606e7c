"""OpenSees: corotational elements on springs that take no tension, by rockeom's own script for it.

The script is that of `rockeom export opensees`; the method is Newmark's of constant acceleration.
Bodies that touch without a spring are left out: a contact in OpenSees is a stiff spring and a
damper, which are chosen for a structure and a restitution.
"""

import importlib.util
import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

import rockeom as rk
from benchmarks.engines.trace import Trace, UnsupportedError

NAME, PACKAGE = "OpenSees", "openseespy"
INSTALL = "pip install openseespy==3.7.1.2, on Python 3.11"
SETTINGS = "the script of rockeom export opensees; corotational elements, ENT springs, Newmark"


def sprung(case: Mapping) -> rk.TwoSpringStructure:
    """The structure of a case on springs, as two masses."""
    p = {name: one["value"] for name, one in case["parameters"].items()}
    if "half_height" in p:
        part, low = 0.5 * p["mass"], p["half_height"]
        inertia = 0.5 * case["model"]["bodies"][0]["inertia"] - part * (0.5 * low) ** 2
        p |= {"mass": part, "base_mass": part, "height": 1.5 * low, "base_height": 0.5 * low}
        p |= {"inertia": inertia, "base_inertia": inertia}
    names = ("mass", "height", "inertia", "base_mass", "base_height", "base_inertia", "half_width")
    return rk.TwoSpringStructure(
        **{name: p[name] for name in names}, gravity=p["gravity"],
        foundation_stiffness=p["stiffness"], foundation_damping=0.0,
    )  # fmt: skip


def run(case: Mapping, step: float) -> Trace:
    model = case["model"]
    if model["contacts"]:
        raise UnsupportedError("a contact is a spring and a damper, which have to be chosen")
    (body,), stiffness = model["bodies"], model["springs"][0]["stiffness"]
    low, turn = body["half_height"], body["rotation"]
    settled = body["mass"] * model["gravity"] / (2.0 * stiffness)
    heave = body["z"] - low * math.cos(turn) + settled
    start = {"theta": turn, "heave": heave if abs(heave) > 1e-12 else 0.0}
    t, turn, heave = rows_of(sprung(case), start, case["duration"], step)[:, :3].T
    rates = [np.gradient(values, t, edge_order=2) for values in (turn, heave)]
    sine, cosine = low * np.sin(turn), low * np.cos(turn)
    rows = [sine, heave - settled + cosine, turn, cosine * rates[0], rates[1] - sine * rates[0]]
    return Trace(t, {body["name"]: np.column_stack([*rows, rates[0]])})


def rows_of(structure: rk.Structure, initial: Mapping, duration: float, step: float) -> np.ndarray:
    """(n, 3): time, rotation and heave, by the script, in a process of its own."""
    from rockeom.exports.opensees import script

    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / "model.py", Path(folder) / "rows.csv"
        motion = rk.GroundMotion.none(duration)
        text = script(structure, motion, initial=initial, step=step, out=str(out))
        path.write_text(text, encoding="utf-8")
        done = subprocess.run(
            [sys.executable, path], env=environment(), capture_output=True, text=True
        )
        if not out.exists():
            raise ArithmeticError(f"OpenSees: {done.stderr.strip()[-300:]}")
        return np.loadtxt(out, delimiter=",", skiprows=1)


def environment() -> dict[str, str]:
    """That of this process; the wheel of OpenSees finds its libraries only where it is told."""
    spec = importlib.util.find_spec("openseespylinux")
    if spec is None or not spec.submodule_search_locations:
        return dict(os.environ)
    folder = os.path.join(next(iter(spec.submodule_search_locations)), "lib")
    known = os.environ.get("LD_LIBRARY_PATH")
    return {**os.environ, "LD_LIBRARY_PATH": f"{folder}:{known}" if known else folder}
