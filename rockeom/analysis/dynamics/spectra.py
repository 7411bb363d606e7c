"""Elastic response spectra of ground motions; `rockeom.motion.spectra` computes them."""

from collections.abc import Callable

from rockeom.motion.spectra import (
    OscillatorHistory,
    ResponseSpectrum,
    oscillator_history,
    response_spectrum,
)

__all__ = ["OscillatorHistory", "ResponseSpectrum", "oscillator_history", "response_spectrum"]

Spectrum = Callable[[float, float], float]
"""Largest displacement [m] as a function of the period [s] and the damping ratio."""
