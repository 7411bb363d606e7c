"""Refused input: the one error, whose fields each border prints in its words, and its checks."""

import os
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from functools import cache
from numbers import Real
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.functions import Compound, isfinite

T = TypeVar("T")
FilePath = str | os.PathLike[str]
Write = Callable[[str, str | None], str]
"""How a border writes an argument of a name: with a value, "" for none; None for the name alone."""
LARGEST_WHOLE = 2**63 - 1
"""The largest whole number of a compiled program."""
_LONGEST, _SHORT = 60, 24  # letters of a value in an error, and of a list that is shown whole
_ARGUMENT = re.compile(r"\{([a-z]\w*)(?::([^{}]*))?\}")


class InputError(ValueError):
    """Input that is refused, with the remedy.

    A remedy has an argument as ``{dt}``, or with a value as ``{dt:0.01}``, and each border writes
    it in its own way: ``dt=0.01`` in Python, ``--dt 0.01`` on the command line.

    Parameters
    ----------
    argument : str
        Name of the argument in Python, "" for none.
    value : object, optional
        Its value.
    of : str, optional
        Function, class or object that refuses it.

    Attributes
    ----------
    bounds : str or tuple of str
        What is allowed, in words, or the words to choose from.
    what : str
        What is wrong, as the predicate of the argument, where "is" and the value do not say it.
    remedy : str
        What else to do.
    python : str
        Remedy that Python alone has.
    file : path_like or None
        File that is refused.
    line : int or None
        Line of the file, counted from 1.
    case : str
        Case of a sweep.

    Examples
    --------
    >>> import rockeom as rk
    >>> try:
    ...     rk.GroundMotion.from_array([0.0, 1.0], dt=-0.01)
    ... except rk.InputError as error:
    ...     print(error, error.argument, error.value, sep="; ")
    dt is -0.01: give a positive number; dt; -0.01
    """

    bounds: str | tuple[str, ...] = ""
    what = remedy = python = case = _allowed = _sentence = ""
    file: FilePath | None = None
    line: int | None = None

    def __init__(self, argument: str, value: Any = None, of: str = "") -> None:
        super().__init__(argument, value, of)
        self.argument, self.value, self.of = argument, value, of

    def give(self, bounds: str, remedy: str = "", python: str = "") -> Self:
        """State the values that are allowed, as a noun phrase.

        Parameters
        ----------
        bounds : str
            Values that are allowed.
        remedy : str, optional
            Further remedy.
        python : str, optional
            Remedy that Python alone has.

        Returns
        -------
        InputError
            Error itself.
        """
        self.bounds, self._allowed = bounds, f"give {bounds}"
        return self.so(remedy, python)

    def hold(self, bounds: str) -> Self:
        """State a condition, as a sentence.

        Parameters
        ----------
        bounds : str
            Condition.

        Returns
        -------
        InputError
            Error itself.
        """
        self._allowed, self.bounds = bounds, bounds.removeprefix("give ")
        return self

    def choose(self, words: Iterable[Any], remedy: str = "") -> Self:
        """State the words that are allowed; the one that is most like the value is offered.

        Parameters
        ----------
        words : iterable of object
            Words that are allowed.
        remedy : str, optional
            Further remedy.

        Returns
        -------
        InputError
            Error itself.
        """
        self.bounds = tuple(map(str, words))
        self._allowed = f"give one of {', '.join(self.bounds)}"
        return self.so(remedy)

    def so(self, remedy: str, python: str = "") -> Self:
        """State the remedy, or why it cannot be.

        Parameters
        ----------
        remedy : str
            Remedy.
        python : str, optional
            Remedy that Python alone has.

        Returns
        -------
        InputError
            Error itself.
        """
        self.remedy, self.python = remedy, python
        return self

    def wrong(self, text: str, python: str = "") -> Self:
        """State "what is wrong: what to do", the first of which is a predicate of the argument.

        Parameters
        ----------
        text : str
            Both parts.
        python : str, optional
            Remedy that Python alone has.

        Returns
        -------
        InputError
            Error itself.
        """
        self.what, remedy = _parts(text)
        return self.so(remedy, python)

    def says(self, text: str, python: str = "") -> Self:
        """With a sentence of its own, in two parts: what is wrong, and what to do.

        Parameters
        ----------
        text : str
            Both parts, with a colon between them.
        python : str, optional
            Remedy that Python alone has.

        Returns
        -------
        InputError
            Error itself.
        """
        self._sentence, remedy = _parts(text)
        return self.so(remedy, python)

    @classmethod
    def at(
        cls, file: FilePath, line: int | None, what: str, remedy: str, argument: str = ""
    ) -> Self:
        """Error of a file, at a line where there is one, and of an argument if there is one.

        Parameters
        ----------
        file : path_like
            File.
        line : int
            Number of the line, counted from 1.
        what : str
            What is wrong.
        remedy : str
            What to do.
        argument : str, optional
            Name of the argument.

        Returns
        -------
        InputError
            Error to raise.
        """
        error = cls(argument)
        error._sentence, error.file, error.line = what, file, line
        return error.so(remedy)

    def __str__(self) -> str:
        return self.in_words(in_python, self.of, self.python)

    def in_words(self, write: Write, of: str = "", python: str = "") -> str:
        """Error as a border prints it.

        Parameters
        ----------
        write : Write
            Function that writes an argument and its value.
        of : str, optional
            The field, where the border prints it.
        python : str, optional
            The field, where the border prints it.

        Returns
        -------
        str
            Text.
        """
        hint = "" if isinstance(self.bounds, str) else near(self.value, self.bounds)
        wrong = (self.what or f"is {described(self.value)}") + hint
        wrong = self._sentence or f"{write(self.argument, None)} {wrong}"
        remedy = "; ".join(filter(None, (self._allowed, self.remedy, python)))
        remedy = with_arguments(remedy, write)
        if self.file is not None:
            return f"{self.place}: {wrong}. Remedy: {remedy}."
        return ": ".join(filter(None, (self.case, of, wrong, remedy)))

    @property
    def place(self) -> str:
        """The file and the line."""
        name = os.fspath(self.file or "")
        where = name if name.isprintable() else repr(name)
        return where if self.line is None else f"{where}, line {self.line}"

    def __reduce__(self) -> tuple[Any, ...]:
        """For other processes: a value that is no number and no text goes as its words."""
        plain = isinstance(self.value, int | float | str | None)
        value = self.value if plain else _Words(described(self.value))
        return type(self), (self.argument, value, self.of), {**vars(self), "value": value}


def _parts(text: str) -> tuple[str, str]:
    what, colon, remedy = text.rpartition(": ")
    return (what, remedy) if colon else (remedy, "")


class InputTypeError(InputError, TypeError):
    """Input of a type that the argument does not take."""


class _Words(str):
    __slots__ = ()
    __repr__ = str.__str__


def in_template(name: str, value: str | None) -> str:
    """An argument as a remedy has it, for an error that quotes another one; see `Write`."""
    return name if value is None else f"{{{name}:{value}}}" if value else f"{{{name}}}"


def in_python(name: str, value: str | None) -> str:
    """An argument as Python writes it; see `Write`."""
    return name if value is None else f"{name}={value}"


def with_arguments(text: str, write: Write) -> str:
    """A text in which each `{name}` and `{name:value}` is an argument as `write` prints it."""
    return _ARGUMENT.sub(lambda place: write(place[1], place[2] or ""), text)


def described(value: Any) -> str:
    """A value in few words: a class as such, what has a shape by its shape."""
    if isinstance(value, os.PathLike):
        return repr(os.fspath(value))
    if isinstance(value, type):
        return f"the class {value.__name__}"
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape:
        return f"{_kind(value)} of shape {shape}"
    if isinstance(value, list | tuple | dict | set) and len(repr(value)) > _SHORT:
        return f"{_kind(value)} of length {len(value)}"
    if callable(value) and (name := getattr(value, "__name__", "")):
        return f"the function {name}"
    plain = value.item() if shape == () and hasattr(value, "item") else value
    short = isinstance(plain, float) and float(f"{plain:g}") == plain
    text = f"{plain:g}" if short else repr(plain)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def _kind(value: Any) -> str:
    name = type(value).__name__.removeprefix("nd")  # an array of NumPy
    return f"{'an' if name[0].lower() in 'aeiou' else 'a'} {name}"


def near(name: Any, names: Iterable[str], instead: Mapping[str, str] | None = None) -> str:
    """A hint at the name that is most like an unknown one, or nothing if none is.

    instead : what to write for names, where that is another.
    """
    import difflib  # only where there is an error

    fold = str.lower if len(str(name)) > 2 else str  # THETA is theta, and R is not r
    folded = {fold(candidate): candidate for candidate in names}
    matches = difflib.get_close_matches(fold(str(name)), folded, n=1)
    if not matches:
        return ""
    meant = folded[matches[0]]
    return f" (did you mean {(instead or {}).get(meant, meant)}?)"


def installed_by(extra: str) -> str:
    """The command that installs an extra of the package, quoted for every shell."""
    return f'pip install -e ".[{extra}]" in a clone of the repository of rockeom'


# -- types and words


def require_type(
    argument: str, value: Any, kind: Any, bounds: str, of: str = "", remedy: str = ""
) -> None:
    """Raise InputTypeError, which offers the bounds, for a value of another type."""
    if not isinstance(value, kind):
        raise InputTypeError(argument, value, of).give(bounds, remedy)


def require_word(argument: str, value: Any, words: Collection[Any], of: str = "") -> None:
    """Raise InputError, which lists the words, for a value that is none of them."""
    if value not in words:
        raise InputError(argument, value, of).choose(words)


def options_of(argument: str, options: Any, kind: type[T], example: str) -> T:
    """The options of a kind, or its defaults for None; raises InputTypeError for anything else."""
    chosen = _defaults(kind) if options is None else options  # type: ignore[arg-type]
    if not isinstance(chosen, kind):
        raise InputTypeError(argument, chosen).give(f"options, such as {example}")
    return chosen


@cache
def _defaults(kind: Any) -> Any:
    return kind()


# -- one number


def is_number(value: Any) -> bool:
    """Whether a value is one real number: of Python, of NumPy, or an array without dimensions.

    A word is none, whatever it says, nor is True.
    """
    dtype = getattr(value, "dtype", None)
    if dtype is not None:
        return getattr(dtype, "kind", None) in ("i", "u", "f") and value.ndim == 0
    return isinstance(value, Real) and not isinstance(value, bool)


def number(argument: str, value: Any, of: str = "", bounds: str = "a number") -> float:
    """The value of an argument as a number; infinite where a float cannot hold it.

    Raises InputTypeError for anything but a number.
    """
    if type(value) is float:
        return value
    if isinstance(value, Compound):
        return value.floats()  # it calculates as a number does
    if not is_number(value):
        raise InputTypeError(argument, value, of).give(bounds)
    try:
        return float(value)
    except OverflowError:
        return float("inf") if value > 0 else -float("inf")


def finite_number(argument: str, value: Any, of: str = "") -> float:
    """As `number`; raises InputError also for one that is not finite."""
    x = number(argument, value, of)
    if not isfinite(x):
        raise InputError(argument, x, of).give("a finite number")
    return x


def positive_number(argument: str, value: Any, of: str = "") -> float:
    """As `finite_number`; raises InputError also for one that is not positive."""
    x = finite_number(argument, value, of)
    if x <= 0.0:
        raise InputError(argument, x, of).give("a positive number")
    return x


def whole_number(argument: str, value: Any, least: int, of: str = "") -> int:
    """The value of an argument as a whole number, which may be written as a float.

    Raises InputTypeError for anything but a number and InputError for one that is not whole, is
    below the least or takes more than 64 bits.
    """
    bounds = f"a whole number of at least {least}"
    x = number(argument, value, of, bounds)
    if not (x >= least and x.is_integer()):
        raise InputError(argument, value, of).give(bounds)
    whole = int(value) if isinstance(value, int | np.integer) else int(x)  # no digit is lost
    if whole > LARGEST_WHOLE:
        raise InputError(argument, value, of).give(f"a whole number of at most {LARGEST_WHOLE}")
    return whole


# -- arrays


def array_of(argument: str, value: Any, of: str = "", bounds: str = "numbers") -> np.ndarray:
    """The value of an argument, of any shape, as an array of float.

    Raises InputTypeError where an element is no number, masked or complex.
    """
    if type(value) is np.ndarray and value.dtype == float:
        return value
    try:
        array = np.asarray(value)
    except ValueError as error:
        what = f"is {described(value)} ({error})"
        raise InputTypeError(argument, value, of).wrong(what, f"give {bounds}") from None
    if np.ma.is_masked(value) or np.iscomplexobj(array):
        raise InputTypeError(argument, value, of).wrong(
            "is masked or complex: fill the gaps, or take the real part, yourself"
        )
    if array.dtype.kind in "iuf":
        return array.astype(float)
    for index, element in np.ndenumerate(np.asarray(value, dtype=object)):
        if not (type(element) is float or isinstance(element, Compound) or is_number(element)):
            raise InputTypeError(_placed(argument, index), element, of).give(bounds)
    compounds = any(issubclass(kind, Compound) for kind in {*map(type, array.flat)})
    return array if compounds else array.astype(float)


def _placed(argument: str, index: tuple[int, ...]) -> str:
    return f"{argument}[{', '.join(map(str, index))}]" if index else argument


def require(right: Any, of: str, argument: str, value: Any, rule: str) -> None:
    """Raise InputError for the first value for which `right` is False.

    right, value : of shapes that broadcast; True and False are of the value as a whole. rule : what
    must hold, and the remedy.
    """
    if right is True:
        return
    if right is False:
        raise InputError(argument, value, of).hold(rule)
    rights, values = np.broadcast_arrays(right, value)
    if rights.all():
        return
    index = tuple(int(i) for i in np.argwhere(~rights)[0])
    raise InputError(_placed(argument, index), values[index], of).hold(rule)


def numbers(of: str, **values: ArrayLike) -> list[np.ndarray]:
    """The values of arguments as arrays of float, in their order.

    Raises InputError where one is not a finite number, and where they do not broadcast.
    """
    arrays = []
    for name, value in values.items():
        try:
            array = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            raise InputError(name, value, of).give("numbers, in SI units") from None
        require(np.isfinite(array), of, name, array, "give a finite number")
        arrays.append(array)
    try:
        np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        shapes = ", ".join(f"{n} {a.shape}" for n, a in zip(values, arrays, strict=True))
        raise InputError(", ".join(values), of=of).says(
            f"the shapes of {shapes} do not broadcast"
        ) from None
    return arrays


def positive(of: str, **values: ArrayLike) -> list[np.ndarray]:
    """As `numbers`; raises InputError also where one is not positive."""
    arrays = numbers(of, **values)
    for name, array in zip(values, arrays, strict=True):
        require(array > 0, of, name, array, "give a positive number, in SI units")
    return arrays


def not_negative(of: str, **values: ArrayLike) -> list[np.ndarray]:
    """As `numbers`; raises InputError also where one is negative."""
    arrays = numbers(of, **values)
    for name, array in zip(values, arrays, strict=True):
        require(array >= 0, of, name, array, "give zero or a positive number, in SI units")
    return arrays
