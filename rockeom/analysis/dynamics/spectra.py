"""Elastic response spectra of ground motions; `rockeom.motion.spectra` finds them."""

from __future__ import annotations

from collections.abc import Callable

from rockeom.motion.spectra import (
    OscillatorHistory as OscillatorHistory,
    ResponseSpectrum as ResponseSpectrum,
    oscillator_history as oscillator_history,
    response_spectrum as response_spectrum,
)

Spectrum = Callable[[float, float], float]
"""Largest displacement [m] as a function of the period [s] and the damping ratio."""
