"""Checks of what is to be drawn."""

from typing import Any

from rockeom.motion.ground_motion import GroundMotion
from rockeom.numbers.checks import require_type
from rockeom.simulation.response import Response
from rockeom.structures.base import Structure

_REMEDIES = {
    Response: "the response of rk.simulate(structure, motion)",
    Structure: "a structure, such as rk.RigidBlock(half_width=0.1, half_height=0.4)",
    GroundMotion: "a ground motion, such as rk.GroundMotion.from_array(values, dt)",
}


def check_drawn(name: str, value: Any, cls: type) -> None:
    """Raise TypeError for an argument that is no response, structure or ground motion."""
    require_type(name, value, cls, _REMEDIES[cls])
