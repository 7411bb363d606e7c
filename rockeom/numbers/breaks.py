"""`Break`: the limit at which a tie breaks, in a declaration or in numbers."""

from dataclasses import dataclass
from typing import Any, ClassVar

from rockeom.numbers import explained
from rockeom.numbers.checks import InputError


@explained.record()
@dataclass(frozen=True, kw_only=True)
class Break:
    """Limit at which a tie breaks: one of three, a number or, in a declaration, an expression.

    Parameters
    ----------
    force : float, optional
        Force [N].
    extension : float, optional
        Elongation, of which the slack length is a part [m].
    energy : float, optional
        Energy dissipated by yielding [J].

    Raises
    ------
    InputError
        For none of them, or several.

    Examples
    --------
    >>> import rockeom as rk
    >>> rk.Break(force=5e3).limits
    {'force': 5000.0}
    """

    kind: ClassVar[str] = "break"

    force: Any = None
    extension: Any = None
    energy: Any = None

    def __post_init__(self) -> None:
        if len(self.limits) != 1:
            raise InputError("breaks_at", [*self.limits], "Break").give(
                "one of force, extension and energy"
            )

    @property
    def limits(self) -> dict[str, Any]:
        """The limit that is given, by its name."""
        every = {"force": self.force, "extension": self.extension, "energy": self.energy}
        return {name: value for name, value in every.items() if value is not None}
