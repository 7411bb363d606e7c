"""Compare the bits of motions with those of a former commit, both computed here.

python -m tests.golden COMMIT [PART]    of those whose name has PART; minutes

Digests kept on disk would depend on the processor for which the machine code is made. The former
commit computes the motions that it names itself, if it has this package, or else those of today.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
ROOT = HERE.parent.parent


def checkout(commit: str, folder: Path) -> None:
    """The files of a commit, with the motions of today where it has none."""
    archive = subprocess.run(
        ["git", "archive", commit], cwd=ROOT, check=True, capture_output=True
    ).stdout
    subprocess.run(["tar", "-x", "-C", folder], input=archive, check=True)
    tests = folder / "tests"
    if not (tests / "golden").exists():
        shutil.copytree(HERE, tests / "golden")
    (tests / "__init__.py").touch()  # a folder without it is no match for the package of today


def computed(root: Path, folder: Path, part: str) -> subprocess.Popen[bytes]:
    """Compute the motions by the package in `root`, into a folder."""
    folder.mkdir()
    return subprocess.Popen(
        [sys.executable, "-m", "tests.golden.motions", str(folder), part],
        cwd=root, env={**os.environ, "PYTHONPATH": str(root)},
    )  # fmt: skip


def loaded(folder: Path) -> dict[str, dict[str, np.ndarray]]:
    files = (np.load(path) for path in sorted(folder.glob("*.npz")))
    return {str(arrays["name"]): dict(arrays) for arrays in files}


def difference(before: dict[str, np.ndarray], now: dict[str, np.ndarray]) -> str:
    """The first array that differs, and by how much, or an empty text."""
    for name in sorted(before.keys() | now.keys()):
        if name not in before or name not in now:
            return f"{name} only {'before' if name in before else 'now'}"
        old, new = before[name], now[name]
        if old.tobytes() == new.tobytes() and old.shape == new.shape:
            continue
        if old.shape != new.shape or old.dtype.kind not in "fi":
            return f"{name} {old.shape} {new.shape}: {old.ravel()[:1]} {new.ravel()[:1]}"
        size = np.nanmax(np.abs(old), initial=0.0)
        return f"{name} by {np.nanmax(np.abs(new - old), initial=0.0):.3g}, of {size:.3g}"
    return ""


def compared(commit: str, part: str) -> int:
    with tempfile.TemporaryDirectory() as place:
        former, before, now = (Path(place) / name for name in ("former", "before", "now"))
        former.mkdir()
        checkout(commit, former)
        runs = [computed(former, before, part), computed(ROOT, now, part)]
        failures = [run.wait() for run in runs]
        if any(failures):
            return 2
        old, new = loaded(before), loaded(now)
    texts = {name: difference(old[name], new[name]) for name in old if name in new}
    differ = {name: text for name, text in texts.items() if text}
    for name, text in differ.items():
        print(f"{name}: {text}")
    refused = sum("refused" in arrays for arrays in new.values())
    print(
        f"{len(texts)} motions compared, {len(differ)} differ; {refused} refused, "
        f"{len(old) - len(texts)} only before, {len(new) - len(texts)} only now"
    )
    return bool(differ) or not texts


if __name__ == "__main__":
    sys.exit(compared(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else ""))
