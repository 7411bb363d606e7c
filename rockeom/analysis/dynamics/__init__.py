"""Motions over a range of parameters: spectra, overturning, periodic orbits, basins, exponents.

::

    from rockeom.analysis import dynamics

    stroboscope = dynamics.StroboscopicMap(structure, motion, period)
    dynamics.poincare_sections(stroboscope, starts=starts, settling=200, cycles=16)
"""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.dynamics.boundaries import *
    from rockeom.analysis.dynamics.branches import *
    from rockeom.analysis.dynamics.lyapunov import *
    from rockeom.analysis.dynamics.orbits import *
    from rockeom.analysis.dynamics.overturning import *
    from rockeom.analysis.dynamics.sections import *
    from rockeom.analysis.dynamics.spectra import *

__getattr__, __dir__ = attributes(__name__)
