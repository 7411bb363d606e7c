"""What all tests of pages run under."""

import pytest

from rockeom.browser import setup


@pytest.fixture(scope="package", autouse=True)
def fewer_places():
    """A page compares itself with Python at an eighth of the places, which take most of the time.

    Users have all of them, and so has `python -m tests.browser`.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(setup, "PLACES", setup.PLACES // 8)
        yield
