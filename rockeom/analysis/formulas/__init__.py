"""Formulas as functions of arrays: periods, restitution, damping, foundations, tendons and walls.

::

    from rockeom.analysis import formulas

    formulas.rocking_period([0.1, 0.5, 0.9], p=2.14)  # s, for theta_0/alpha

All arguments broadcast; an argument outside its range is a ValueError that names the function, the
argument, its value and the remedy.
"""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.formulas.contact_springs import *
    from rockeom.analysis.formulas.controlled_wall import *
    from rockeom.analysis.formulas.damping import *
    from rockeom.analysis.formulas.foundation import *
    from rockeom.analysis.formulas.masonry import *
    from rockeom.analysis.formulas.overturning import *
    from rockeom.analysis.formulas.periods import *
    from rockeom.analysis.formulas.restitution import *
    from rockeom.analysis.formulas.space import *
    from rockeom.analysis.formulas.stiffness import *
    from rockeom.analysis.formulas.support_forces import *
    from rockeom.analysis.formulas.uplift import *

__getattr__, __dir__ = attributes(__name__)
