"""Classes by name, each imported when it is first asked for, so that a process starts sooner."""

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any

from rockeom.structures.base import Structure


class ImportedClasses(Mapping[str, type[Structure]]):
    """The classes of structures by the names of their structures.

    homes : the module in `rockeom.structures` of each class, by the name of the class. The module's
        own name is that of the structure.
    """

    def __init__(self, homes: Mapping[str, str]) -> None:
        self._homes = homes
        self._class_of = {home.rpartition(".")[2]: name for name, home in homes.items()}

    def __getitem__(self, name: str) -> type[Structure]:
        return self.of_class(self._class_of[name])

    def __contains__(self, name: object) -> bool:
        return name in self._class_of  # without an import

    def __iter__(self) -> Iterator[str]:
        return iter(self._class_of)

    def __len__(self) -> int:
        return len(self._class_of)

    def of_class(self, name: str) -> Any:
        """The class of that name. Raises AttributeError, as a module does."""
        if name not in self._homes:
            raise AttributeError(f"no structure has a class named {name!r}")
        return getattr(import_module(f"rockeom.structures.{self._homes[name]}"), name)
