"""Elements that carry forces, by name: springs and dampers, and what switches between states.

A state of an element is a number, its chi, with which its force, the rates of its internal
variables and its energy are written once for all. An ending ends a state: its guard falls through
zero. A `Spring` has one state, and its chi has no meaning. Elements add forces to a mode, and
change none of its constraints. `drawn` is what a sketch shows at its `place`, if it has one, and
from there to its `end`. A new element is a file here, and a line in the union below.
"""

from rockeom.numbers.breaks import Break
from rockeom.symbolic.elements.damper import Damper
from rockeom.symbolic.elements.pulse import Pulse
from rockeom.symbolic.elements.spring import Spring
from rockeom.symbolic.elements.states import Ending, switch_of
from rockeom.symbolic.elements.tie import Tie
from rockeom.symbolic.elements.unilateral import Unilateral
from rockeom.symbolic.elements.yielding import Yielding

Switching = Unilateral | Yielding | Tie | Damper | Pulse
Element = Spring | Switching

__all__ = [
    "Break",
    "Damper",
    "Element",
    "Ending",
    "Pulse",
    "Spring",
    "Switching",
    "Tie",
    "Unilateral",
    "Yielding",
    "switch_of",
]
