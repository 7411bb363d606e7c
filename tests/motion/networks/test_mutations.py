"""A spoiled file is refused, or read as an independent reader by columns reads it."""

import pytest

from tests.motion.networks import oracle
from tests.motion.networks.mutations import fault, faults
from tests.motion.networks.twins import TWINS


@pytest.mark.filterwarnings("ignore:a.txt. the header counts")
@pytest.mark.parametrize("name", TWINS)
def test_spoiled_file_is_refused_or_read_as_it_is(name):
    assert not faults(name, range(200))


@pytest.mark.parametrize("name", TWINS)
def test_oracle_notices_another_value(tmp_path, monkeypatch, name):
    """A reader whose values differ in the last digit would not pass."""
    path = tmp_path / "a.txt"
    path.write_text(TWINS[name]().text)
    assert fault(name, path, stated_peak=True) is None
    own = oracle.read(name, path.read_bytes())
    own[-1].values[-1] += 1e-9
    monkeypatch.setattr(oracle, "read", lambda *_: own)
    assert fault(name, path, stated_peak=True)
