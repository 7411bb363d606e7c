"""Ground motions: pulses, harmonic motion, records, synthetic ones and sets of them, in SI units.

Type: `GroundMotion`, a table of analytic segments. Error: `InputError`.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.segments import SegmentKind
from rockeom.motion.units import STANDARD_GRAVITY

if TYPE_CHECKING:  # and when a program runs, each where it is first asked for, see below
    from rockeom.motion.design.checks import SpectrumCheck
    from rockeom.motion.design.spectra import DesignSpectrum
    from rockeom.motion.intensity import Measures
    from rockeom.motion.motion_set import MotionSet
    from rockeom.motion.recording import Recording
    from rockeom.motion.synthetic import JenningsEnvelope, ShinozukaSatoEnvelope

__all__ = [
    "STANDARD_GRAVITY",
    "DesignSpectrum",
    "GroundMotion",
    "JenningsEnvelope",
    "Measures",
    "MotionSet",
    "Recording",
    "SegmentKind",
    "ShinozukaSatoEnvelope",
    "SpectrumCheck",
]

_HOMES = {
    "DesignSpectrum": "design.spectra",
    "JenningsEnvelope": "synthetic",
    "Measures": "intensity",
    "MotionSet": "motion_set",
    "Recording": "recording",
    "ShinozukaSatoEnvelope": "synthetic",
    "SpectrumCheck": "design.checks",
}


def __getattr__(name: str) -> Any:
    """Import on first use the names that a simulation under one motion does not need."""
    if name in _HOMES:
        return getattr(import_module(f"rockeom.motion.{_HOMES[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
