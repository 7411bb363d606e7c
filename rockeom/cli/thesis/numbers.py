"""Numbers that the commands ``rockeom thesis ...`` take, for a shell that completes them."""

from rockeom.thesis import EQUATIONS
from rockeom.thesis.figures import FIGURES
from rockeom.thesis.tables import TABLES

NUMBERS = {"equations": EQUATIONS, "verify": EQUATIONS, "figure": FIGURES, "tables": TABLES}
"""Numbers of equations, figures and tables, by the command."""
