"""Processes that fork, files that are whole or refused, and names that are data."""

import os
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from rockeom.numeric import machine, program
from rockeom.symbolic import coordinate, parameter
from rockeom.writing import written_whole


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_child_forked_while_another_thread_compiles(monkeypatch):
    inside, go_on = threading.Event(), threading.Event()

    def slow(*_):
        inside.set()
        go_on.wait(10)

    monkeypatch.setattr(program, "_of_parts", slow)
    thread = threading.Thread(target=program.program, args=(None, "DOP853"))
    thread.start()
    inside.wait(10)
    threading.Timer(0.3, go_on.set).start()
    pid = os.fork()
    if pid == 0:
        os._exit(0 if program._LOCK.acquire(timeout=5) else 1)
    thread.join()
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0


FULL_DISK = """
import resource, signal, sys
import rockeom as rk
run = rk.simulate(rk.RigidBlock(half_width=.5, half_height=2.), rk.GroundMotion.none(3.0),
                  initial={"theta": .1})
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
try:
    run.save(sys.argv[1])
except OSError as error:
    print("told", *error.__notes__)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no limits of files")
def test_full_disk_keeps_the_old_file_and_the_interpreter(tmp_path):
    pytest.importorskip("h5netcdf")
    path = tmp_path / "run.nc"
    path.write_text("old")
    done = subprocess.run(
        [sys.executable, "-c", FULL_DISK, path], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert "told" in done.stdout
    assert str(path) in done.stdout
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes")
def test_only_regular_files_are_replaced(tmp_path):
    pipe = tmp_path / "pipe.nc"
    os.mkfifo(pipe)
    for path in (pipe, tmp_path, Path("/dev/null")):
        with pytest.raises(OSError, match="no regular file"), written_whole(path):
            pass
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@pytest.mark.parametrize("symbol", [r"\input{secret}", r"x\write18{rm}", "<b>x</b>", "x$y", r"\\"])
def test_symbols_run_nothing_in_latex(symbol):
    for declare in (lambda: parameter(symbol, "size", "m", "size"),
                    lambda: coordinate(symbol, "size", "m", "size")):  # fmt: skip
        with pytest.raises(ValueError, match="symbol"):
            declare()


def test_hostile_words_are_data_in_markdown():
    from rockeom.symbolic.page import Heading, Table, to_markdown

    hostile = "<img src=x onerror=alert(1)>"
    page = to_markdown([Heading(1, hostile), hostile, Table(("Name",), (("$" + hostile + "$",),))])
    assert "<img" not in page
    assert page.count("&lt;img") == 3


def test_machine_is_loaded_under_the_lock_of_programs():
    """No other module loads machine code, so that no fork comes between."""
    calls = [
        p.name for p in Path(machine.__file__).parent.glob("*.py") if "Loaded(" in p.read_text()
    ]
    assert calls == ["program.py"]
