"""Probabilities: fragility curves, reliability by first order and by Monte Carlo."""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.risk.fragility import *
    from rockeom.analysis.risk.reliability import *

__getattr__, __dir__ = attributes(__name__)
