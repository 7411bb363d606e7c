"""Files of results: a full disk, and paths that are no files, whatever writes there."""

import os
import re
import socket
import stat
import subprocess
import sys
from pathlib import Path

import pytest

import rockeom as rk
from rockeom import plots
from rockeom.cli import main, output
from rockeom.drawing.style import save_figure

if sys.platform == "win32":
    pytest.skip("limits, pipes and sockets are those of POSIX", allow_module_level=True)

PACKAGE = Path(rk.__file__).parent
BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)
MOTION = rk.GroundMotion.single_sine(3.0, 0.5, 1.0)
RUN = rk.simulate(BLOCK, MOTION, duration=0.5)
REPORT = plots.design_report(BLOCK, [MOTION], duration=1.0)
FIGURE = RUN.plot()


def command(*words):
    """A command, the error of which is printed and gives 2, as a function that raises."""

    def run(path):
        if main([*words, "--out", str(path)]) != 0:
            raise OSError(f"{path}: told by the command")

    return run


WRITERS = {
    "save.nc": RUN.save,
    "animation.html": lambda path: RUN.animate(path, frames_per_second=5),
    "animation.gif": lambda path: RUN.animate(path, frames_per_second=5),
    "report.html": REPORT.write,
    "report.pdf": REPORT.write,
    "figure.png": lambda path: save_figure(FIGURE, path),
    "figure.svg": lambda path: save_figure(FIGURE, path),
    "response.csv": lambda path: output.write_csv(RUN, path),
    "response.npz": lambda path: output.write_npz(RUN, path),
    "summary.json": lambda path: output.write_json(RUN, None, {}, path),
    "rigid_block.c": command("export", "c", "rigid_block"),
}


def written_on_a_full_disk(folder: Path) -> None:
    """Let every writer fail, in a process that may write files of 100 bytes alone."""
    import resource
    import signal

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    for name in WRITERS:
        (folder / name).write_text("the old file")
    unlimited = resource.getrlimit(resource.RLIMIT_FSIZE)
    for name, write in WRITERS.items():
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, unlimited[1]))
        try:
            with pytest.raises(OSError, match=re.escape(name)):
                write(folder / name)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, unlimited)
        assert (folder / name).read_text() == "the old file", name
    assert sorted(os.listdir(folder)) == sorted(WRITERS)


def test_a_full_disk_is_told_keeps_the_old_files_and_does_not_end_the_process(tmp_path):
    lines = [
        "from pathlib import Path",
        "from tests import test_files",
        f"test_files.written_on_a_full_disk(Path({str(tmp_path)!r}))",
        "print('alive')",
    ]
    done = subprocess.run(
        [sys.executable, "-B", "-c", "\n".join(lines)],  # bytecode would be cut off, too
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout.split()[-1:]) == (0, ["alive"]), done.stderr


@pytest.mark.parametrize("name", WRITERS)
def test_no_writer_replaces_a_pipe(name, tmp_path):
    os.mkfifo(tmp_path / name)
    with pytest.raises(OSError, match=re.escape(name)):
        WRITERS[name](tmp_path / name)
    assert [(path.name, path.is_fifo()) for path in tmp_path.iterdir()] == [(name, True)]


@pytest.mark.parametrize("kind", ["folder", "socket", "device", "link to a pipe"])
def test_only_a_file_is_replaced(kind, tmp_path, monkeypatch):
    path = tmp_path / (name := "run.nc")
    if kind == "folder":
        path.mkdir()
    elif kind == "socket":
        monkeypatch.chdir(tmp_path)  # paths of sockets are short
        with socket.socket(socket.AF_UNIX) as bound:
            bound.bind(name)
    elif kind == "device":
        try:
            os.mknod(path, 0o600 | stat.S_IFCHR, os.makedev(1, 3))  # as /dev/null
        except PermissionError:
            pytest.skip("devices are made by root alone")
    else:
        os.mkfifo(tmp_path / "pipe")
        path.symlink_to("pipe")
    before = [(one.name, one.lstat().st_mode) for one in tmp_path.iterdir()]
    with pytest.raises(FileExistsError, match=rf"run\.nc is a {kind.split()[-1]}"):
        RUN.save(path)
    assert [(one.name, one.lstat().st_mode) for one in tmp_path.iterdir()] == before


@pytest.mark.parametrize("name", WRITERS)
def test_a_file_is_replaced_whole_and_keeps_its_mode(name, tmp_path):
    path = tmp_path / name
    path.write_text("the old file")
    path.chmod(0o640)
    WRITERS[name](path)
    assert path.read_bytes() != b"the old file"
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert os.listdir(tmp_path) == [name]


def test_a_file_that_is_read_only_is_not_replaced(tmp_path, monkeypatch):
    path = tmp_path / "run.nc"
    path.write_text("the old file")
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write to any
    with pytest.raises(PermissionError, match=r"run\.nc is read-only"):
        RUN.save(path)
    assert path.read_text() == "the old file"


def test_a_path_that_cannot_be_written_is_told_before_the_work(tmp_path, monkeypatch):
    def worked(*_, **__):
        raise AssertionError("worked first")

    monkeypatch.setattr("rockeom.simulation.saved._arrays", worked)
    monkeypatch.setattr("rockeom.drawing.animation.Animation.frames", property(worked))
    monkeypatch.setattr(type(REPORT), "page", worked)
    monkeypatch.setattr("rockeom.cli.derive._text", worked)
    monkeypatch.setattr("rockeom.cli.simulate.simulate", worked)
    writers = WRITERS | {"derived.py": command("derive", "rigid_block", "--code")}
    for name in ("save.nc", "animation.gif", "report.pdf", "derived.py"):
        (tmp_path / name).mkdir()
        with pytest.raises(OSError, match=re.escape(name)):
            writers[name](tmp_path / name)
    (tmp_path / "response.png").mkdir()
    values = ["--set", "half_width=0.1", "half_height=0.4", "--free", "--duration", "1"]
    assert main(["simulate", "rigid_block", *values, "--out", str(tmp_path)]) == 2


def test_nothing_else_in_the_package_writes_files():
    """But the cache of machine code, which is private, and the stores of sweeps, which are zarr."""
    writes = re.compile(
        r"""\.write_(text|bytes)\(|\bopen\([^)]*["'][wxa]b?["']|\.savefig\(paths?\b"""
        r"""|to_netcdf\((?!engine)"""  # without a path it gives bytes
    )
    found = {
        path.relative_to(PACKAGE).as_posix()
        for path in PACKAGE.rglob("*.py")
        for line in path.read_text(encoding="utf-8").splitlines()
        if writes.search(line) and not line.startswith("with open(out")  # of a script, as text
    }
    assert found == {"files.py", "compiler/cache.py", "sweeps/store.py"}
