"""What all tests run under."""

import gc
import os
from pathlib import Path

import pytest
from hypothesis import settings

LONGEST = (
    "derivations/test_derivations.py",
    "symbolic/test_typeset.py",
    "thesis/test_equations.py",
    "analysis/test_bayes.py",
    "analysis/test_unfinished_work.py",
    "thesis/test_statements.py",
    "soak/test_soak.py",
)
"""Begun first, so that no worker is left with one of them at the end. Others may come in any
order."""

EQUATIONS, STATEMENTS = "tests/thesis/test_equations.py", "tests/thesis/test_statements.py"
TOGETHER = {
    EQUATIONS: EQUATIONS,
    "tests/thesis/test_checks_notice.py": EQUATIONS,
    "tests/thesis/test_mutations.py": EQUATIONS,
    "tests/codegen/test_generated_functions.py": "tests/symbolic/test_typeset.py",
    "tests/codegen/test_generated_text.py": "tests/symbolic/test_typeset.py",
    "tests/codegen/test_carried_functions.py": "tests/symbolic/test_typeset.py",
    "tests/symbolic/test_compare.py": "tests/symbolic/test_typeset.py",
    "tests/symbolic/test_reading.py": "tests/symbolic/test_typeset.py",
}
"""Files that go to the worker of another one, which has derived what both compare with. Others of
the thesis go to that of its statements, which has simulated what they draw."""


# SymPy, imported later, remembers 1,000 results of each of its functions where nothing is said, and
# forgets others that the next model asks for again.
os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")
# NumPy, imported later as well (pyproject.toml leaves out plugins of pytest that would import it),
# has small matrices here: other threads only wait for them, and as busily as if they worked.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# How long an example takes by the clock is what else the machine does.
settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")


def pytest_configure(config: pytest.Config) -> None:
    """Look for garbage in cycles a thousand times less often, and keep the order of files.

    SymPy makes and drops millions of small objects, nearly all without cycles; to look through
    them by Python's own measure takes a tenth of the time of many tests. Workers would be given
    the files with the most tests first, which are not those that take longest.
    """
    gc.set_threshold(700_000, 20, 20)
    config.option.loadscopereorder = False


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """As --dist loadfile, but that of two files of TOGETHER the worker is one."""
    if config.getvalue("dist") != "loadfile":
        return None
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = super()._split_scope(nodeid)
            return TOGETHER.get(file, STATEMENTS if file.startswith("tests/thesis/") else file)

    return Scheduling(config, log)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    places = {Path(__file__).parent / name: place for place, name in enumerate(LONGEST)}
    root = Path(__file__).parents[1]
    assert all(path.exists() for path in places)
    assert all((root / name).exists() for pair in TOGETHER.items() for name in pair)
    items.sort(key=lambda item: places.get(item.path, len(places)))


def pytest_collection_finish() -> None:
    """What is imported and collected stays until the end, and need not be looked through."""
    gc.freeze()


@pytest.fixture(scope="module")
def garbage_of_its_own() -> None:
    """Tests that look for garbage do not look through what SymPy remembers, each time anew."""
    gc.collect()
    gc.freeze()


def pytest_unconfigure() -> None:
    """Nor need it be looked through once more at the end of a process: that takes seconds."""
    gc.freeze()
