"""What all tests run under."""

import gc


def pytest_configure() -> None:
    """Look for garbage in cycles a hundred times less often.

    SymPy makes and drops millions of small objects, nearly all without cycles; to look through
    them by Python's own measure takes a tenth of the time of many tests.
    """
    gc.set_threshold(70_000, 20, 20)


def pytest_collection_finish() -> None:
    """What is imported and collected stays until the end, and need not be looked through."""
    gc.freeze()
