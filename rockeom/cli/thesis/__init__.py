"""The commands ``rockeom thesis ...``: equations, tables, figures and statements of Ma's thesis."""
