"""Checks that codes of practice and old criteria ask of an object that stands free.

::

    import rockeom as rk
    from rockeom.analysis import standards

    rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0)
    print(standards.west_uplift(rack, "0.4 g"))

Each function returns a `Check`: the demand, the capacity, a verdict in words and the source. A code
is one file of this folder. `rockeom.assess` takes a function of PGA that returns checks, and shows
them next to the motions of the records. The docstring of a check says which part is second-hand.
"""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.standards.asce_7 import *
    from rockeom.analysis.standards.asce_43 import *
    from rockeom.analysis.standards.check import *
    from rockeom.analysis.standards.ishiyama import *
    from rockeom.analysis.standards.italy_2009 import *
    from rockeom.analysis.standards.mallet import *
    from rockeom.analysis.standards.west import *

__getattr__, __dir__ = attributes(__name__)
