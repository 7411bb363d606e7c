"""The equations of Ma's thesis (2010): as printed, as they should be, and what decides it.

    from rockeom import thesis

    thesis.equation("5-34")          # typeset in Jupyter
    thesis.equation("2-9").reason    # why the printed form is wrong
    thesis.decide("2-9").verdict     # runs its checks
    thesis.verify().counts           # all of them, in some seconds

Needs SymPy, as `rockeom.symbolic` does.
"""

from rockeom.thesis.catalogue import EQUATIONS, equation
from rockeom.thesis.checks import CHECKS, Check, Finding, Means
from rockeom.thesis.equation import Domain, Equation, Kind
from rockeom.thesis.notation import NOTATION, Entry, entry
from rockeom.thesis.verification import Decision, Report, Verdict, claim, decide, verify

__all__ = [
    "CHECKS", "EQUATIONS", "NOTATION", "Check", "Decision", "Domain", "Entry", "Equation",
    "Finding", "Kind", "Means", "Report", "Verdict", "claim", "decide", "entry", "equation",
    "verify",
]  # fmt: skip
