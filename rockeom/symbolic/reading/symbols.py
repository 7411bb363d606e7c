"""The symbols of a model by their names, for programs that go on with its expressions."""

from collections.abc import Iterator, Mapping

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.hybrid import HybridModel


class Symbols(Mapping[str, sp.Symbol]):
    """Symbols of a model, by name and as attributes.

    They are the coordinates with their velocities and accelerations, such as `theta`, `theta_dot`
    and `theta_ddot`; the parameters by the names of the arguments, such as `half_width`; constants
    that follow from these; `a_x` and `a_y`, the ground's acceleration; and the side `s`.

    Parameters
    ----------
    by_name : dict of str to sympy.Symbol
        Symbols by name.

    Examples
    --------
    >>> import rockeom as rk
    >>> symbols = rk.derive("rigid_block").symbols
    >>> symbols.half_width, symbols["theta_dot"]
    (B, \\dot{\\theta})
    """

    def __init__(self, by_name: Mapping[str, sp.Symbol]) -> None:
        self._by_name = dict(by_name)

    @classmethod
    def of(cls, model: HybridModel) -> "Symbols":
        """Symbols of a model.

        Parameters
        ----------
        model : HybridModel
            Model.

        Returns
        -------
        Symbols
            Symbols.
        """
        by_name: dict[str, sp.Symbol] = {}
        for c in model.coordinates:
            names = (c.name, f"{c.name}_dot", f"{c.name}_ddot")
            by_name |= zip(names, (c.position, c.velocity, c.acceleration), strict=True)
        by_name |= {z.name: z.symbol for z in model.internal}
        by_name |= {p.name: p.symbol for p in model.parameters}
        by_name |= {d.name: d.symbol for d in model.definitions}
        return cls(by_name | {str(a): a for a in model.shaking} | {"s": SIDE})

    def __getitem__(self, name: str) -> sp.Symbol:
        return self._by_name[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_name)

    def __len__(self) -> int:
        return len(self._by_name)

    def __getattr__(self, name: str) -> sp.Symbol:
        if name.startswith("_"):  # while it is copied it has no names yet
            raise AttributeError(name)
        if name not in self._by_name:
            letters = {str(symbol): own for own, symbol in self._by_name.items()}
            return explained.missing(self, name, lambda: {own: own for own in self} | letters)
        return self._by_name[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._by_name]

    def __repr__(self) -> str:
        return f"<Symbols {', '.join(f'{n}: {x}' for n, x in self._by_name.items())}>"
