"""The pictures that structures, motions, responses and sweeps show of themselves."""

from rockeom.drawing.animation import animate as animate
from rockeom.drawing.ground_motion import plot_motion as plot_motion, plot_spectra as plot_spectra
from rockeom.drawing.notebook import (
    page_of_motion as page_of_motion,
    page_of_response as page_of_response,
    page_of_structure as page_of_structure,
    page_of_sweep as page_of_sweep,
)
from rockeom.drawing.response import plot_response as plot_response
