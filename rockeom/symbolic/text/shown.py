"""Objects of a derivation as notebooks and terminals show them."""

from rockeom.symbolic.text.page import Display, to_markdown, to_text

TEXT_WIDTH = 100
"""Columns of `str`, which goes to terminals, files and cells alike."""


NOTHING = r"\text{no coordinate moves}"


class Shown:
    """An object that is some equations: `repr` is a line, a notebook and `str` show them all."""

    def equation_lines(self) -> list[str]:
        """LaTeX of each equation, with one sign of equality."""
        raise NotImplementedError

    def _repr_latex_(self) -> str:
        return to_markdown([self._display()])

    def __str__(self) -> str:
        return to_text([self._display()], TEXT_WIDTH).rstrip("\n")

    def _display(self) -> Display:
        return Display(tuple(self.equation_lines()) or (NOTHING,))
