"""What is kept on disk is run as machine code: it is right and one's own, or it is not used."""

import os
import signal
import stat
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from rockeom.compiler import cache as store
from rockeom.compiler.cache import cache_folder, kept

ROOT = Path(__file__).resolve().parents[2]
CODE = b"machine code\n\0" + bytes(range(0, 256, 16))
NOBODY = 65534
TEMPORARY = tempfile.gettempdir()

posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such thing")
by_root = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give a file away"
)


class Maker:
    """Makes the bytes, and counts how often it had to."""

    def __init__(self, made: bytes = CODE) -> None:
        self.made, self.calls = made, 0

    def __call__(self) -> bytes:
        self.calls += 1
        return self.made


def calls_for(made: bytes = CODE, name: str = "block", digest: str = "0f3a") -> int:
    """How often the bytes had to be made; they are right in any case."""
    make = Maker(made)
    assert kept(name, digest, make) == made
    return make.calls


def names(folder: Path) -> list[str]:
    return sorted(os.listdir(folder))


@pytest.fixture(autouse=True)
def _nothing_said_yet():
    store._warn_once.cache_clear()


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """The cache's folder, not made yet."""
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def stored(folder) -> Path:
    """The file of a program that was stored."""
    assert calls_for() == 1
    (path,) = folder.iterdir()
    return path


@pytest.fixture
def as_plain_user() -> Iterator[Path]:
    """For whom permission bits bind, even if root runs the tests; an empty folder of this user."""
    root = os.geteuid() == 0
    with tempfile.TemporaryDirectory(dir=TEMPORARY) as name:  # pytest's are closed to this user
        if root:
            os.chown(name, NOBODY, NOBODY)
            os.seteuid(NOBODY)
        try:
            yield Path(name)
        finally:
            if root:
                os.seteuid(0)
            os.chmod(name, 0o700)


@contextmanager
def root_again() -> Iterator[None]:
    now = os.geteuid()
    os.seteuid(os.getuid())
    try:
        yield
    finally:
        os.seteuid(now)


def start(folder: Path, code: str) -> subprocess.Popen[str]:
    """A new process that stores in the folder; CODE, kept and say() are there for it."""
    lines = f"""
import os, signal, sys
from rockeom.compiler.cache import kept
CODE = {CODE!r}
def say(text):
    print(text, flush=True)
"""
    return subprocess.Popen(
        [sys.executable, "-c", lines + code],
        env={**os.environ, "PYTHONPATH": str(ROOT), "ROCKEOM_CACHE_DIR": str(folder)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


# --- what is stored is found


def test_stored_program_is_found_and_not_made_again(stored):
    assert [calls_for(), calls_for()] == [0, 0]
    assert names(stored.parent) == ["rockeom_block_0f3a.compiled"]


def test_later_process_finds_what_an_earlier_one_stored(stored):
    code = "say(kept('block', '0f3a', lambda: b'made again') == CODE)"
    out, errors = start(stored.parent, code).communicate(timeout=60)
    assert (out, errors) == ("True\n", "")


@pytest.mark.parametrize("made", [b"", b"\n", b"\n\n\0", bytes(3_000_000)])
def test_all_bytes_can_be_stored(folder, made):
    assert [calls_for(made), calls_for(made)] == [1, 0]


def test_name_and_digest_tell_programs_apart(folder):
    programs = [(name, digest) for name in ("a", "b") for digest in "01"]
    for expected in (1, 0):
        for name, digest in programs:
            assert calls_for(f"{name} {digest}".encode(), name, digest) == expected
    for _ in range(2):  # names that are one in ASCII: never the one for the other
        for name in ("ж", "щ"):
            assert calls_for(name.encode(), name) == 1


def test_long_name_in_letters_of_many_bytes_is_stored(folder):
    name = "ж" * 100  # as long as a name may be
    assert [calls_for(name=name), calls_for(name=name)] == [1, 0]


@pytest.mark.parametrize("name", ["../block", "a/b", "a\\b", "a b", "a\0b", "a.b", "C:a"])
def test_name_that_would_lead_out_of_the_folder_is_refused(folder, name):
    for names_ in ((name, "0f"), ("block", name)):
        with pytest.raises(ValueError, match="letters, digits and underscores"):
            kept(*names_, Maker())
    assert not folder.exists()


@posix
@pytest.mark.parametrize("umask", [0o000, 0o022, 0o077])
def test_folder_and_files_are_their_users_alone(folder, umask):
    before = os.umask(umask)
    try:
        assert calls_for() == 1
    finally:
        os.umask(before)
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert {stat.S_IMODE(path.stat().st_mode) for path in folder.iterdir()} == {0o600}


def test_what_stops_the_making_is_not_hidden_and_nothing_is_stored(folder):
    for error in (ZeroDivisionError, OSError, KeyboardInterrupt):

        def make(error=error):
            raise error

        with pytest.raises(error):
            kept("block", "0f3a", make)
        assert names(folder) == []


# --- where


def test_system_place_for_caches(monkeypatch, tmp_path):
    monkeypatch.delenv("ROCKEOM_CACHE_DIR", raising=False)
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    monkeypatch.setenv("LOCALAPPDATA", "")
    places = {"win32": "AppData/Local/rockeom/cache", "darwin": "Library/Caches/rockeom"}
    for chosen, linux in ((None, ".cache/rockeom"), ("", ".cache/rockeom"), ("x", "x/rockeom")):
        if chosen is None:
            monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
        else:
            monkeypatch.setenv("XDG_CACHE_HOME", chosen and str(tmp_path / chosen))
        for platform, place in {**places, "linux": linux}.items():
            monkeypatch.setattr(sys, "platform", platform)
            assert cache_folder() == tmp_path / place


def test_relative_folder_is_below_the_current_one(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", "here/cache")
    (tmp_path / "elsewhere").mkdir()

    def make():
        os.chdir("elsewhere")  # as a program may while it compiles
        return CODE

    assert kept("block", "0f3a", make) == CODE
    assert names(tmp_path / "here" / "cache") == ["rockeom_block_0f3a.compiled"]
    assert names(tmp_path / "elsewhere") == []


# --- files that are not what was stored


def test_file_cut_off_anywhere_is_made_again(stored):
    whole = stored.read_bytes()
    for length in range(len(whole)):
        stored.write_bytes(whole[:length])
        assert calls_for() == 1, length
        assert stored.read_bytes() == whole
    assert names(stored.parent) == [stored.name]


def test_file_with_one_bit_flipped_is_made_again(stored):
    whole = stored.read_bytes()
    for byte in range(len(whole)):
        flipped = bytearray(whole)
        flipped[byte] ^= 1 << byte % 8
        stored.write_bytes(flipped)
        assert calls_for() == 1, byte
        assert stored.read_bytes() == whole


@pytest.mark.parametrize(
    "foreign",
    [
        pytest.param(lambda whole: whole + b"\0", id="longer"),
        pytest.param(lambda whole: whole * 2, id="twice"),
        pytest.param(lambda whole: b"\n" + whole, id="shifted"),
        pytest.param(lambda whole: whole.replace(b"\n", b"\r\n"), id="line ends of Windows"),
        pytest.param(lambda whole: CODE, id="without the first line"),
        pytest.param(lambda whole: b"\x7fELF" + bytes(100_000), id="an object file"),
        pytest.param(lambda whole: b"import os\n", id="a text"),
    ],
)
def test_foreign_content_is_made_again(stored, foreign):
    whole = stored.read_bytes()
    stored.write_bytes(foreign(whole))
    assert [calls_for(), calls_for()] == [1, 0]
    assert stored.read_bytes() == whole


@pytest.mark.parametrize(("name", "digest"), [("wall", "0f3a"), ("block", "0f3b")])
def test_whole_file_of_another_program_under_this_name_is_not_used(stored, name, digest):
    assert calls_for(b"other code", name, digest) == 1
    (other,) = (path for path in stored.parent.iterdir() if path != stored)
    os.replace(other, stored)
    assert [calls_for(), calls_for()] == [1, 0]


@posix
def test_link_in_place_of_the_file_is_replaced_and_its_target_left_alone(stored):
    target = stored.with_name("target")
    stored.rename(target)
    stored.symlink_to(target)
    before = target.read_bytes(), target.stat().st_mtime_ns
    assert [calls_for(), calls_for()] == [1, 0]
    assert not stored.is_symlink()
    assert (target.read_bytes(), target.stat().st_mtime_ns) == before


@posix
@pytest.mark.parametrize("writers", [0, 1])
def test_pipe_in_place_of_the_file_keeps_nobody_waiting(stored, writers):
    stored.unlink()
    os.mkfifo(stored)
    opened = [os.open(stored, os.O_RDWR) for _ in range(writers)]
    assert [calls_for(), calls_for()] == [1, 0]
    for descriptor in opened:
        os.close(descriptor)


def test_folder_in_place_of_the_file_costs_speed_and_nothing_else(stored):
    stored.unlink()
    stored.mkdir()
    assert [calls_for(), calls_for()] == [1, 1]
    assert names(stored.parent) == [stored.name]


# --- others who may write


@contextmanager
def warned(*words: str) -> Iterator[None]:
    """One warning, however often the cache is used in here; it holds all the words."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        yield
    (warning,) = said
    assert warning.category is RuntimeWarning
    for word in words:
        assert word in str(warning.message)


@contextmanager
def silent() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


@posix
@pytest.mark.parametrize("mode", [0o720, 0o702, 0o770, 0o777, 0o1777])
def test_folder_that_others_may_write_to_is_neither_read_nor_written(stored, mode):
    folder = stored.parent
    folder.chmod(mode)
    with warned(f"{folder} ", "run as code", f"chmod go-w '{folder}'", "ROCKEOM_CACHE_DIR"):
        assert calls_for(b"not what is stored") == 1  # not read
        assert calls_for(b"never stored", "wall") == 1
        assert calls_for(b"never stored", "wall") == 1
    assert names(folder) == [stored.name]
    folder.chmod(mode & ~0o022)  # the remedy it names
    with silent():
        assert calls_for() == 0


@posix
def test_each_such_folder_is_named_once_in_a_process(tmp_path, monkeypatch):
    for name in "ab":
        folder = tmp_path / name
        folder.mkdir()
        folder.chmod(0o777)
        monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(folder))
        with warned(str(folder)):
            calls_for()
            calls_for()


@posix
@pytest.mark.parametrize("mode", [0o500, 0o555, 0o700, 0o755])
def test_folder_that_others_may_only_read_is_used_without_a_word(stored, mode):
    stored.parent.chmod(mode)
    with silent():
        assert calls_for() == 0
    stored.parent.chmod(0o700)


@posix
def test_link_to_a_folder_is_followed_and_judged_by_where_it_leads(stored):
    folder = stored.parent
    aside = folder.rename(folder.with_name("on another disk"))
    folder.symlink_to(aside)
    with silent():
        assert calls_for() == 0
    aside.chmod(0o777)
    with warned(str(folder)):
        assert calls_for() == 1


@posix
def test_folder_of_another_user_is_neither_read_nor_written(stored, as_plain_user, monkeypatch):
    if os.getuid() == 0:  # a folder of root, whole and open to read, used by a plain user
        with root_again():
            folder = as_plain_user / "of root"
            stored.parent.rename(folder)
            os.chmod(folder, 0o755)
            os.chmod(folder / stored.name, 0o644)
    else:
        folder = Path("/")
    before = names(folder)
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(folder))
    with warned(f"{folder} belongs to another user", "run as code", "ROCKEOM_CACHE_DIR"):
        assert [calls_for(), calls_for()] == [1, 1]
    assert names(folder) == before


@posix
@pytest.mark.parametrize("mode", [0o620, 0o602, 0o666, 0o777])
def test_file_that_others_may_write_to_is_not_read_but_replaced(stored, mode):
    stored.chmod(mode)
    was = stored.stat().st_ino
    with open(stored, "rb") as still_open, warned(str(stored), "run as code", "replaced"):
        assert calls_for(b"not what is stored") == 1  # though it was whole
        assert os.fstat(still_open.fileno()).st_ino == was
        assert stored.stat().st_ino != was  # who had it open for writing has the old one
        assert calls_for(b"not what is stored") == 0
    assert stat.S_IMODE(stored.stat().st_mode) == 0o600


@posix
@by_root
def test_file_of_another_user_is_not_read_but_replaced(stored):
    os.chown(stored, NOBODY, NOBODY)
    with warned(str(stored), "belongs to another user"):
        assert calls_for(b"not what is stored") == 1
    assert stored.stat().st_uid == os.geteuid()
    assert calls_for(b"not what is stored") == 0


# --- where nothing can be stored


@pytest.fixture
def no_leftovers(tmp_path, monkeypatch) -> Iterator[None]:
    """Nothing is put into the system's temporary directory, or warned of, instead."""
    empty = tmp_path / "temporary"
    empty.mkdir()
    for variable in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.setenv(variable, str(empty))
    monkeypatch.setattr(tempfile, "tempdir", None)
    with silent():
        yield
    assert names(empty) == []


@pytest.mark.usefixtures("no_leftovers")
@pytest.mark.parametrize("place", ["file", "file/cache", "file/a/b"])
def test_file_in_the_way_of_the_folder(tmp_path, monkeypatch, place):
    (tmp_path / "file").write_bytes(b"mine")
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path / place))
    assert [calls_for(), calls_for()] == [1, 1]
    assert (tmp_path / "file").read_bytes() == b"mine"


@posix
@pytest.mark.usefixtures("no_leftovers")
@pytest.mark.parametrize("place", ["/proc/cache", "/dev/null", "/dev/null/cache", "a" * 300])
def test_place_where_no_folder_can_be(tmp_path, monkeypatch, place):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", place)
    if Path(place).parent.exists():
        assert [calls_for(), calls_for()] == [1, 1]


@posix
@pytest.mark.usefixtures("no_leftovers")
def test_link_to_nowhere_in_place_of_the_folder(folder):
    folder.symlink_to(folder / "nowhere")
    assert [calls_for(), calls_for()] == [1, 1]


@posix
@pytest.mark.usefixtures("no_leftovers")
def test_read_only_folder_is_read(as_plain_user, monkeypatch):
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(as_plain_user))
    assert calls_for() == 1
    as_plain_user.chmod(0o500)
    with pytest.raises(PermissionError):  # it is one
        (as_plain_user / "probe").touch()
    assert calls_for() == 0
    assert [calls_for(name="wall"), calls_for(name="wall")] == [1, 1]
    as_plain_user.chmod(0o700)
    assert len(names(as_plain_user)) == 1


@posix
@pytest.mark.usefixtures("no_leftovers")
@pytest.mark.parametrize("mode", [0o500, 0o000])
def test_home_that_cannot_be_written(as_plain_user, monkeypatch, mode):
    for variable in ("ROCKEOM_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("HOME", str(as_plain_user))
    as_plain_user.chmod(mode)
    assert [calls_for(), calls_for()] == [1, 1]
    as_plain_user.chmod(0o700)
    assert names(as_plain_user) == []


@pytest.mark.usefixtures("no_leftovers")
def test_user_without_a_home(monkeypatch):
    def nowhere():
        raise RuntimeError("Could not determine home directory.")  # as Path.home

    for variable in ("ROCKEOM_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr(Path, "home", nowhere)
    assert [calls_for(), calls_for()] == [1, 1]


@posix
@pytest.mark.usefixtures("no_leftovers")
@pytest.mark.parametrize("place", ["cache", "./cache", "../cache", "."])
def test_relative_folder_in_a_current_folder_that_was_deleted(tmp_path, monkeypatch, place):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    with pytest.raises(FileNotFoundError):  # it is gone
        os.getcwd()
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", place)
    assert [calls_for(), calls_for()] == [1, 1]
    assert names(tmp_path) == ["temporary"]


@posix
def test_absolute_folder_is_used_where_the_current_one_was_deleted(tmp_path, monkeypatch, stored):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert calls_for() == 0


@contextmanager
def room_for(size: int) -> Iterator[None]:
    """No file may grow beyond `size` bytes: what is written after fails, as on a full disk."""
    import resource

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@posix
@pytest.mark.usefixtures("no_leftovers")
@pytest.mark.parametrize("made", [CODE, CODE * 3000])
def test_full_disk(folder, made):
    """At once, in the first line, in the code, in its last byte."""
    assert calls_for(made) == 1
    (path,) = folder.iterdir()
    whole = path.stat().st_size
    for size in (0, 1, 50, whole - len(made) // 2, whole - 1):
        path.unlink(missing_ok=True)
        with room_for(size):
            assert [calls_for(made), calls_for(made)] == [1, 1]
        assert names(folder) == []
    with room_for(whole):
        assert [calls_for(made), calls_for(made)] == [1, 0]


@posix
def test_full_disk_leaves_what_was_stored(stored):
    with room_for(0):
        assert calls_for() == 0
        assert calls_for(name="wall") == 1
    assert names(stored.parent) == [stored.name]


# --- stopped in the middle


@posix
@pytest.mark.parametrize("size", [0, 50, 10_000])
def test_interrupt_in_the_middle_of_writing_leaves_no_file(folder, size):
    """A signal comes while the file is written, and its handler raises KeyboardInterrupt."""
    before = signal.signal(signal.SIGXFSZ, signal.default_int_handler)
    try:
        with room_for(size), pytest.raises(KeyboardInterrupt):
            kept("block", "0f3a", Maker(CODE * 3000))
    finally:
        signal.signal(signal.SIGXFSZ, before)
    assert names(folder) == []


@posix
def test_process_killed_while_it_compiles_leaves_nothing(folder):
    process = start(
        folder, "kept('block', '0f3a', lambda: (say('compiling'), signal.pause(), CODE)[-1])"
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "compiling\n"
    process.kill()
    process.communicate(timeout=60)
    assert process.returncode == -signal.SIGKILL
    assert names(folder) == []
    assert [calls_for(), calls_for()] == [1, 0]


@posix
def test_process_killed_while_it_writes_leaves_what_nobody_reads_and_a_later_one_removes(folder):
    code = """
import resource
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))
signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # it kills
kept("block", "0f3a", lambda: CODE * 3000)
"""
    process = start(folder, code)
    process.communicate(timeout=60)
    assert process.returncode == -signal.SIGXFSZ
    (left,) = folder.iterdir()
    assert left.stat().st_size == 200
    assert [calls_for(), calls_for()] == [1, 0]

    mine = folder / "rockeom_results.tmp"
    mine.touch()
    for age, remains in ((0.9, True), (1.1, False)):  # in days
        for path in folder.iterdir():
            os.utime(path, 2 * (time.time() - age * 86400.0,))
        assert calls_for(name=f"wall{remains}") == 1
        assert left.exists() == remains
    assert calls_for() == 0
    assert mine.exists()


# --- two at once


@posix
def test_two_processes_that_make_the_same_program_at_once_both_have_it(folder):
    """Both find nothing, both make it, and both write at the same time, many programs."""
    code = """
def make():
    say("making")
    sys.stdin.readline()
    return CODE
assert kept("block", "0f3a", make) == CODE
for i in range(200):
    made = CODE * 300 + bytes([i])
    assert kept("block", f"{i:04x}", lambda: made) == made
say("right")
"""
    processes = [start(folder, code) for _ in range(2)]
    for process in processes:
        assert process.stdout is not None
        assert process.stdout.readline() == "making\n"
    assert names(folder) == []
    for process in processes:
        assert process.stdin is not None
        process.stdin.write("go\n")
        process.stdin.flush()
    for process in processes:
        out, errors = process.communicate(timeout=60)
        assert (out, errors) == ("right\n", "")
    assert len(names(folder)) == 201
    assert all(name.endswith(".compiled") for name in names(folder))
    assert calls_for() == 0
    assert all(calls_for(CODE * 300 + bytes([i]), digest=f"{i:04x}") == 0 for i in range(200))
