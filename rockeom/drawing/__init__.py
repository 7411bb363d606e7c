"""Drawings of structures, ground motions and responses, by their attributes alone (`drawn`).

Motions, structures and responses import from here where they plot themselves; whatever needs an
analysis is in `rockeom.drawing`, which has the public names of both.
"""
