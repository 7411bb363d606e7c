"""Procedures of design: from a motion or a spectrum to a rotation, a displacement, a base shear."""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.design.displacement_based import *
    from rockeom.analysis.design.envelope import *
    from rockeom.analysis.design.fema_356 import *
    from rockeom.analysis.design.hysteresis import *
    from rockeom.analysis.design.isolation import *
    from rockeom.analysis.design.oscillator import *

__getattr__, __dir__ = attributes(__name__)
