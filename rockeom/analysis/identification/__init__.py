"""From measurements to parameters: records and their noise, impacts, fits with confidence.

::

    from rockeom.analysis import identification

    record = identification.MeasuredRecord.from_csv("test.csv", units={"theta": "deg"})
    identification.Impacts.of_record(record, block, threshold=6.0)  # J
"""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.identification.bayes import *
    from rockeom.analysis.identification.energies import *
    from rockeom.analysis.identification.fitting import *
    from rockeom.analysis.identification.free_vibration import *
    from rockeom.analysis.identification.impacts import *
    from rockeom.analysis.identification.measured import *
    from rockeom.analysis.identification.measured_forces import *
    from rockeom.analysis.identification.noise import *
    from rockeom.analysis.identification.observed import *
    from rockeom.analysis.identification.pulses import *
    from rockeom.analysis.identification.records import *
    from rockeom.analysis.identification.sampling import *
    from rockeom.analysis.identification.slips import *
    from rockeom.analysis.identification.stone_walls import *
    from rockeom.analysis.identification.swings_of_response import *
    from rockeom.analysis.identification.windows import *

__getattr__, __dir__ = attributes(__name__)
