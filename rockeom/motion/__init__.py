"""Ground motions: pulses, harmonic motion and records, in SI units.

Type: `GroundMotion`, a table of analytic segments. Error: `MotionError`.
"""

from rockeom.motion.errors import MotionError
from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.segments import SegmentKind
from rockeom.motion.units import STANDARD_GRAVITY

__all__ = ["STANDARD_GRAVITY", "GroundMotion", "MotionError", "SegmentKind"]
