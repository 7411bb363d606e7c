"""Statistical validation: measured ensembles of motions against simulated ones.

::

    from rockeom.analysis import validation

    campaign = validation.Campaign.from_csv("tests.csv", units={"peak": "deg"})
    simulated = validation.simulate_campaign(campaign, case, random, 500)
    validation.predictive_test(campaign.measured, simulated).p_value

Overturned motions are in every result. They have no peak, and exceed every rotation: distributions
and tests rank them above all others, as infinite; means and CRPS take each peak up to a limit, with
the overturned motions at the limit (`Ensemble`).
"""

from typing import TYPE_CHECKING

from rockeom.analysis.groups import attributes

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis.validation.boulder_tests import *
    from rockeom.analysis.validation.calibration import *
    from rockeom.analysis.validation.campaigns import *
    from rockeom.analysis.validation.comparison import *
    from rockeom.analysis.validation.ensembles import *
    from rockeom.analysis.validation.paired import *
    from rockeom.analysis.validation.sample_size import *
    from rockeom.analysis.validation.scores import *

__getattr__, __dir__ = attributes(__name__)
