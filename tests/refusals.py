"""Input that is refused: tests ask the error for its fields."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from rockeom import InputError


@contextmanager
def refuses(argument: str, value: Any = ..., kind: Any = InputError) -> Iterator[Any]:
    """What runs within must refuse this argument, with this value where one is named."""
    with pytest.raises(kind) as caught:
        yield caught
    error = caught.value
    assert isinstance(error, InputError), repr(error)
    assert error.argument == argument, str(error)
    assert value is ... or error.value == value, str(error)


def _refusal(call: Callable[..., Any], values: Any, named: Any) -> InputError:
    with pytest.raises(InputError) as caught:
        call(*values, **named)
    return caught.value


def refused(call: Callable[..., Any], *values: Any, **named: Any) -> tuple[str, Any]:
    """The argument that a call refuses, and its value."""
    error = _refusal(call, values, named)
    return error.argument, error.value


def told(call: Callable[..., Any], *values: Any, **named: Any) -> str:
    """What a call says that refuses its input."""
    return str(_refusal(call, values, named))
