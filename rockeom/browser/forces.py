"""The forces of the elements that a page draws: which tie is tight, and where a push acts.

This text is joined to others, see `rockeom.browser.page`.
"""

from rockeom.compiler.decorators import Floats, entry
from rockeom.integrator.provided import elements


@entry
def forces(mode: int, y: Floats, p: Floats, out: Floats):
    """Deformation, force, energy and power lost of each element, one element after the other."""
    elements(mode, y, p, out)
