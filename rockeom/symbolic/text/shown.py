"""Objects of a derivation as notebooks and terminals show them."""

from rockeom.symbolic.text.page import Display, to_markdown, to_text

TEXT_WIDTH = 100
"""Columns of `str`, which goes to terminals, files and cells alike."""


class Shown:
    """An object that is some equations: `repr` is a line, a notebook and `str` show them all."""

    def equation_lines(self) -> list[str]:
        """LaTeX of each equation, with one sign of equality."""
        raise NotImplementedError

    def _repr_latex_(self) -> str:
        return to_markdown([Display(tuple(self.equation_lines()))])

    def __str__(self) -> str:
        return to_text([Display(tuple(self.equation_lines()))], TEXT_WIDTH).rstrip("\n")
