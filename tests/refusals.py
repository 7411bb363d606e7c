"""Input that is refused: tests ask the error for its fields."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from rockeom import InputError

ANY: Any = object()


def refused(call: Callable[..., Any], *values: Any, **named: Any) -> tuple[str, Any]:
    """The argument that a call refuses, and its value."""
    with pytest.raises(InputError) as caught:
        call(*values, **named)
    return caught.value.argument, caught.value.value


@contextmanager
def refuses(
    argument: str, value: Any = ANY, kind: type[Exception] = InputError
) -> Iterator[pytest.ExceptionInfo[Any]]:
    """What runs within must refuse this argument, with this value where one is named."""
    with pytest.raises(kind) as caught:
        yield caught
    error = caught.value
    assert isinstance(error, InputError), repr(error)
    assert error.argument == argument, str(error)
    assert value is ANY or error.value == value, str(error)


def told(call: Callable[..., Any], *values: Any, **named: Any) -> str:
    """What a call says that refuses its input."""
    with pytest.raises(InputError) as caught:
        call(*values, **named)
    return str(caught.value)
